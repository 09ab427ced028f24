"""``atlas classify``: which quadric a body and a field have, with its canonical form."""

from typing import Any

import click

from atlas.cli.numbers import answer, body_parameters, certificate
from atlas.cli.options import (
    Command,
    body_options,
    chosen_body,
    chosen_field,
    exact_body,
    exact_field,
    examples,
    field_options,
    output_options,
)
from atlas.cli.present import Line, Printout, show
from atlas.errors import DomainError

QUANTITIES = ("beta", "a2", "a3", "semi_axes", "centre", "axes")


@click.command(
    "classify",
    cls=Command,
    epilog=examples(
        "atlas classify --ratio 1.5 --field 1 2",
        "atlas classify --shape cylindrical-shell --radius 1 --height 0.5 --field 1 2 --json",
    ),
)
@body_options
@field_options
@output_options
def command(**options: Any) -> None:
    """Name the quadric of constant Omega3 and give its canonical form.

    The kind is decided on I3 against I2 and the components of the field as given.
    """

    def floats() -> dict[str, Any]:
        from atlas.core.quadric import Quadric

        return described(Quadric(chosen_body(options), chosen_field(options)))

    def balls() -> dict[str, Any]:
        from atlas.exact.quadric import Quadric

        return described(Quadric(exact_body(options), exact_field(options)))

    texts = answer(options, body_parameters(options), floats, balls)
    if texts is not None:
        show(printout(texts, options))


def described(quadric: Any) -> dict[str, Any]:
    """Return the quadric's kind and quantities; where one does not exist, None, and the reason under its name."""
    record: dict[str, Any] = {"kind": quadric.kind}
    missing: dict[str, str] = {}
    for name in QUANTITIES:
        try:
            record[name] = getattr(quadric, name)
        except DomainError as reason:
            record[name] = None
            missing[name] = str(reason)
    return record | ({"missing": missing} if missing else {})


def printout(texts: dict[str, Any], options: dict[str, Any]) -> Printout:
    """Lay the certified texts out."""
    lines = [
        _line("beta", texts["beta"], "rad", "angle from e2 to I^-1 B'", "mf61a"),
        _line("a2", texts["a2"], "", "2 sin(beta)/(1 - sin(beta))", "mf60"),
        _line("a3", texts["a3"], "", "2 sin(beta)/(1 + sin(beta))", "mf60"),
    ]
    says = ("along omega'_1", "along omega'_2", "along omega'_3")
    for index, where in enumerate(says):
        C = texts["semi_axes"]
        lines.append(_line(f"C{index + 1}", C and C[index], "1/time", f"semi-axis {where}", "mf61b, mf63"))
    lines.append(_line("centre", _tuple(texts["centre"]), "1/time", "-B', the centre", "mf58"))
    for index in range(3):
        rows = texts["axes"]
        lines.append(_line(f"e'_{index + 1}", rows and _tuple(rows[index]), "", "canonical axis", "mf61a"))
    notes = [*dict.fromkeys(texts.get("missing", {}).values()), certificate(options)]
    return Printout(title=texts["kind"], lines=lines, notes=notes)


def _line(symbol: str, value: str | None, unit: str, says: str, label: str) -> Line:
    return Line(symbol, says, "-" if value is None else value, unit if value is not None else "", label)


def _tuple(values: Any) -> str | None:
    return None if values is None else "(" + ", ".join(values) + ")"
