"""``atlas ball``: the charged ball, its axis and frequency, its rotation matrix at the times asked for."""

from typing import Any

import click

from atlas.cli.numbers import along, answer, certificate, in_threes, samples
from atlas.cli.options import REAL, Command, chosen_times, exactly, examples, output_options, times_options
from atlas.cli.present import Line, Printout, show

NAMES = ("inertia", "larmor", "momentum")


@click.command(
    "ball",
    cls=Command,
    epilog=examples(
        "atlas ball --larmor 0.5 --momentum 0.3 -0.7 --times 0 1 10",
    ),
)
@click.option("--inertia", type=REAL, default="1", show_default=True, help="Moment of inertia I0.")
@click.option("--larmor", type=REAL, required=True, help="Larmor frequency alpha = mu |B|/(2c), either sign.")
@click.option("--momentum", type=REAL, nargs=2, metavar="M2 M3", required=True, help="m(0) = (0, m2, m3), B along e3.")
@times_options
@output_options
def command(**options: Any) -> None:
    """General motion of a charged ball: R(t) and m(t) (mf36 to mf39)."""
    times = chosen_times(options)

    def floats() -> dict[str, Any]:
        from atlas.core.ball import BallMotion

        motion = BallMotion(options["inertia"], options["larmor"], momentum=tuple(options["momentum"]))
        return described(motion, times, along(motion.rotation, times), along(motion.angular_momentum, times))

    def balls() -> dict[str, Any]:
        from atlas.exact.ball import BallMotion

        motion = BallMotion(*(exactly(options[name], options) for name in NAMES))
        at = [exactly(t, options) for t in times]
        return described(motion, times, [motion.rotation(t) for t in at], [motion.angular_momentum(t) for t in at])

    texts = answer(options, {name: options[name] for name in NAMES}, floats, balls)
    if texts is not None:
        show(printout(texts, options))


def described(motion: Any, times: list[float], R: Any, m: Any) -> dict[str, Any]:
    """Return the quantities of a ball's motion and its samples."""
    return {"gamma": motion.gamma, "k_hat": motion.k_hat, "samples": samples(times, R=R, m=m)}


def printout(texts: dict[str, Any], options: dict[str, Any]) -> Printout:
    """Lay the certified texts out, three rows a time."""
    lines = [
        Line("gamma", "frequency of the turn about k_hat", texts["gamma"], "1/time", "mf39"),
        Line("k_hat", "its axis", f"(0, {', '.join(texts['k_hat'])})", "", "mf39"),
    ]
    rows = in_threes(texts["samples"])
    heading = ("t", "R_i1", "R_i2", "R_i3", "m_i") if rows else ()
    return Printout("charged ball, B along e3", lines, heading, rows, [certificate(options)])
