"""``atlas general``: the motion from any initial angular velocity, its nutation and its rotation matrix."""

from math import isfinite
from typing import Any

import click

from atlas.cli.numbers import along, answer, body_parameters, certificate, in_threes, samples
from atlas.cli.options import (
    REAL,
    Command,
    body_options,
    chosen_body,
    chosen_field,
    chosen_times,
    exact_body,
    exact_field,
    exactly,
    examples,
    field_options,
    output_options,
    times_options,
)
from atlas.cli.present import Line, Printout, show
from atlas.errors import DomainError

SCALARS = {
    "period": ("period of nutation", "time"),
    "precession_per_period": ("turn about B in one period", ""),
    "spin_per_period": ("turn about the body's axis in one period", ""),
    "modulus": ("of the elliptic functions", ""),
    "nome": ("of the elliptic functions", ""),
}


SPARE = 1 << 12
"""Bits beyond those asked for in which digits are looked for: a zero of the motion has none."""

UNKNOWN = (
    f"with {SPARE} binary digits the number cannot be told from zero, and that it is zero does not follow from a "
    "symmetry of the motion."
)


@click.command(
    "general",
    cls=Command,
    epilog=examples(
        "atlas general --ratio 1.5 --field 1 2 --omega 0.3 0.7 0.2 --times 0 1 2.5 --json",
        "atlas general --ratio 1.5 --field 1 2 --omega 0.3 0.7 0.2 --times 1e6 --digits 50",
        "atlas general --ratio 2 --field 0 1 --omega 1e-4 0 -1 --grid 0 1 40",
    ),
)
@body_options
@field_options
@click.option(
    "--omega", type=REAL, nargs=3, metavar="W1 W2 W3", required=True, help="Initial angular velocity, in 1/time."
)
@times_options
@output_options
def command(**options: Any) -> None:
    """Nutation, rotation matrix R(t) and angular velocity from any initial angular velocity (not in the paper)."""
    times = chosen_times(options)

    def floats() -> dict[str, Any]:
        from atlas.core.general import GeneralMotion

        motion = GeneralMotion(chosen_body(options), chosen_field(options), options["omega"])
        methods = (motion.rotation, motion.angular_velocity, motion.angular_momentum)
        return described(motion, times, *(along(method, times) for method in methods))

    def balls() -> dict[str, Any]:
        from atlas.exact.general import GeneralMotion

        motion = GeneralMotion(exact_body(options), exact_field(options), exactly(options["omega"], options))
        methods = (motion.rotation, motion.angular_velocity, motion.angular_momentum)
        return described(motion, times, *([method(exactly(t, options)) for t in times] for method in methods))

    texts = answer(options, body_parameters(options) | {"omega": options["omega"]}, floats, balls, spare=SPARE)
    if texts is not None:
        show(printout(texts, options))


def described(motion: Any, times: list[float], R: Any, Omega: Any, m: Any) -> dict[str, Any]:
    """Return the quantities of a motion and its samples; roots as their real and imaginary parts."""
    found = {"kind": motion.kind, "turning_points": motion.turning_points}
    found["roots"] = [[root.real, root.imag] for root in motion.roots if isfinite(root.real)]
    for name in SCALARS:
        try:
            value = getattr(motion, name)
        except DomainError:  # there is no such number: on a separatrix none for a period, at a triple root no nome
            continue
        found[name] = value if isfinite(value) else "infinite"
    return found | {"samples": samples(times, R=R, Omega=Omega, m=m)}


def printout(texts: dict[str, Any], options: dict[str, Any]) -> Printout:
    """Lay the certified texts out, three rows a time."""
    low, high = texts["turning_points"]
    roots = ", ".join(_complex(*root) for root in texts["roots"])
    lines = [
        Line("Omega3", "least and largest", f"{low} ... {high}", "1/time"),
        Line("roots", "of Q(Omega3)", roots or "none", "1/time"),
    ]
    lines += [Line(name, *_says(name, texts[name])) for name in SCALARS if name in texts]
    rows = in_threes(texts["samples"])
    heading = ("t", "R_i1", "R_i2", "R_i3", "Omega_i [1/time]", "m_i/I2 [1/time]") if rows else ()
    from atlas.exact.digits import NOT_CERTIFIED

    notes = [certificate(options)]
    if any(NOT_CERTIFIED in row for row in rows):
        notes.append(f"{NOT_CERTIFIED}: {UNKNOWN}")
    return Printout(f"general motion: {texts['kind']}", lines, heading, rows, notes)


def _complex(x: str, y: str) -> str:
    return x if y == "0" else f"{x} {'-' if y.startswith('-') else '+'} {y.lstrip('-')} i"


def _says(name: str, value: str) -> tuple[str, str, str]:
    says, unit = SCALARS[name]
    return says, value, unit
