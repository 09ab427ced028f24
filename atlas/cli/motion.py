"""``atlas motion``: an elementary motion, its frequencies and its rotation matrix at the times asked for."""

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

LABELS = {
    "precession": ("mf76", "mf84", "mf77"),
    "at rest": ("mf76", "mf84", "mf77"),
    "free body": ("given", "mf92", "mf92"),
}
"""Equations of omega3, k and phi by case; where omega3 is free, the paper has none."""


@click.command(
    "motion",
    cls=Command,
    epilog=examples(
        "atlas motion --ratio 1.5 --field 1 2 --omega2 0.7 --times 0 1 2.5 --json",
        "atlas motion --ratio 1.5 --field 1 2 --omega2 0.7 --times 1e6 --digits 50",
    ),
)
@body_options
@field_options
@click.option("--omega2", type=REAL, required=True, help="Second component of the initial angular velocity.")
@click.option("--omega3", type=REAL, help="Third component, where mf76 leaves it free (B = 0, B2 = 0, the pole).")
@times_options
@output_options
def command(**options: Any) -> None:
    """Frequencies, rotation matrix R(t) and angular velocity of an elementary motion (mf76 to mf90)."""
    times = chosen_times(options)
    start = (options["omega2"], options["omega3"])

    def floats() -> dict[str, Any]:
        from atlas.core.elementary import ElementaryMotion

        motion = ElementaryMotion(chosen_body(options), chosen_field(options), *start)
        methods = (motion.rotation, motion.angular_velocity, motion.angular_momentum)
        return described(motion, times, *(along(method, times) for method in methods))

    def balls() -> dict[str, Any]:
        from atlas.exact.elementary import ElementaryMotion

        motion = ElementaryMotion(
            exact_body(options), exact_field(options), *(None if x is None else exactly(x, options) for x in start)
        )
        methods = (motion.rotation, motion.angular_velocity, motion.angular_momentum)
        return described(motion, times, *([method(exactly(t, options)) for t in times] for method in methods))

    given = {name: options[name] for name in ("omega2", "omega3") if options[name] is not None}
    texts = answer(options, body_parameters(options) | given, floats, balls)
    if texts is not None:
        show(printout(texts, options))


def described(motion: Any, times: list[float], R: Any, Omega: Any, m: Any) -> dict[str, Any]:
    """Return the quantities of a motion and its samples."""
    names = ("case", "omega3", "k", "phi")
    return {name: getattr(motion, name) for name in names} | {"samples": samples(times, R=R, Omega=Omega, m=m)}


def printout(texts: dict[str, Any], options: dict[str, Any]) -> Printout:
    """Lay the certified texts out, three rows a time."""
    omega3, k, phi = LABELS.get(texts["case"], ("given", "", ""))
    axis = "m" if texts["case"] == "free body" else "B"
    lines = [
        Line("omega3", "third component of Omega, constant", texts["omega3"], "1/time", omega3),
        Line("k", f"frequency of precession about {axis}", texts["k"], "1/time", k),
        Line("phi", "frequency of proper rotation", texts["phi"], "1/time", phi),
    ]
    rows = in_threes(texts["samples"])
    heading = ("t", "R_i1", "R_i2", "R_i3", "Omega_i [1/time]", "m_i/I2 [1/time]") if rows else ()
    return Printout(f"elementary motion: {texts['case']}", lines, heading, rows, [certificate(options)])
