"""What the number commands share: one description of the quantities, answered by floats or by certified digits."""

from collections.abc import Callable, Sequence
from itertools import chain
from typing import Any

import click

from atlas.cli.present import dump

TABLE_DIGITS = 10
"""Significant digits of a table when --digits does not say otherwise."""


def answer(
    options: dict[str, Any],
    parameters: dict[str, Any],
    floats: Callable[[], dict[str, Any]],
    balls: Callable[[], dict[str, Any]],
    spare: int = 1 << 16,
) -> dict[str, Any] | None:
    """Print the JSON that was asked for and return None, or return the quantities as certified texts for a table.

    ``floats`` computes the quantities with the kernels, ``balls`` with proven radii; they have the same keys.
    ``spare`` goes to `certified`.
    """
    if options["as_json"] and options["digits"] is None:
        if options["decimal"]:
            raise click.UsageError("--decimal needs --digits: floats in JSON are made from doubles.")
        dump({"parameters": parameters, **floats()})
        return None
    from atlas.exact.digits import certified

    texts: dict[str, Any] = certified(balls, options["digits"] or TABLE_DIGITS, spare=spare)
    if not options["as_json"]:
        return texts
    taken = "decimals as typed" if options["decimal"] else "the doubles nearest to what was typed"
    dump({"parameters": parameters, "certified_digits": options["digits"], "inputs": taken, **texts})
    return None


def certificate(options: dict[str, Any]) -> str:
    """Return the sentence under a table that says what its digits are worth."""
    taken = "decimals as typed" if options["decimal"] else "the doubles nearest to what was typed"
    return f"All digits printed are proven; inputs: {taken}."


IN_DOUBLES = "Computed in doubles: no digit is proven in axes that are not principal ones, or from another attitude."


def written(value: Any) -> Any:
    """Return numbers, in lists and dictionaries, as texts of so many digits as a table has."""
    if isinstance(value, dict):
        return {key: written(item) if key != "t" else item for key, item in value.items()}
    if hasattr(value, "tolist"):
        return written(value.tolist())
    if isinstance(value, list | tuple):
        return [written(item) for item in value]
    return f"{value:.{TABLE_DIGITS}g}" if isinstance(value, float) else value


def along(method: Callable[[Any], Any], times: Sequence[float]) -> Any:
    """Evaluate a method of a kernel at all times at once."""
    import numpy as np

    return method(np.array([float(t) for t in times]))


def samples(times: Sequence[float], **columns: Any) -> list[dict[str, Any]]:
    """Return a record for each time, of ``t`` and of each quantity under its name."""
    return [dict(zip(("t", *columns), row, strict=True)) for row in zip(times, *columns.values(), strict=True)]


def in_threes(records: Sequence[dict[str, Any]]) -> list[list[str]]:
    """Return three rows of a table for each record of texts: the rows of its matrix, the components of its vectors."""
    rows = []
    for t, *values in (record.values() for record in records):
        for i in range(3):
            parts = (value[i] if isinstance(value[i], list) else [value[i]] for value in values)
            rows.append([f"{float(t)!r}" if i == 0 else "", *chain(*parts)])
    return rows
