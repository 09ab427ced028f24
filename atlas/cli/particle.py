"""``atlas particle``: a point charge in constant fields, and the body's centre of mass."""

from collections.abc import Callable
from typing import Any

import click

from atlas.cli.numbers import along, answer, certificate, in_threes, samples
from atlas.cli.options import REAL, Command, F, chosen_times, exactly, examples, output_options, times_options
from atlas.cli.present import Line, Printout, show

ZERO = ("0",) * 3
VECTORS = ("electric", "magnetic", "position", "velocity")


def _vector(name: str, text: str, **more: Any) -> Callable[[F], F]:
    return click.option(name, type=REAL, nargs=3, metavar="X Y Z", help=text, **more)


@click.command(
    "particle",
    cls=Command,
    epilog=examples(
        "atlas particle --mu 1 --electric 0 0.5 0 --magnetic 0 0 1 --velocity 1 0 0 --times 0 1 2",
    ),
)
@click.option("--mu", type=REAL, required=True, help="Charge-to-mass ratio, either sign.")
@_vector("--electric", "Electric field E; zero when left out.", default=ZERO)
@_vector("--magnetic", "Magnetic field B; zero when left out.", default=ZERO)
@_vector("--position", "Position at t = 0; the origin when left out.", default=ZERO)
@_vector("--velocity", "Velocity at t = 0.", required=True)
@click.option(
    "--units",
    type=click.Choice(["natural", "gaussian", "si"]),
    default="natural",
    show_default=True,
    help="c = 1; statvolt/cm, gauss, cm; volt/m, tesla, m (no factor c).",
)
@times_options
@output_options
def command(**options: Any) -> None:
    """Position and velocity of a point charge in any constant E and B (mf5 to mf11)."""
    times = chosen_times(options)
    c = speed_of_light(options["units"])

    def floats() -> dict[str, Any]:
        from atlas.core.particle import ParticleMotion

        E, B, position, velocity = (tuple(options[name]) for name in VECTORS)
        motion = ParticleMotion(options["mu"], E, B, position, velocity, c=c)
        return described(motion, times, along(motion.position, times), along(motion.velocity, times))

    def balls() -> dict[str, Any]:
        from atlas.exact.particle import ParticleMotion

        mu, E, B, position, velocity = (exactly(options[name], options) for name in ("mu", *VECTORS))
        motion = ParticleMotion(mu, E, B, position, velocity, c=c)
        at = [exactly(t, options) for t in times]
        return described(motion, times, [motion.position(t) for t in at], [motion.velocity(t) for t in at])

    parameters = {name: options[name] for name in ("mu", *VECTORS, "units")}
    texts = answer(options, parameters, floats, balls)
    if texts is not None:
        show(printout(texts, options))


def speed_of_light(units: str) -> float:
    """Return the factor c of mf5 in a system of units."""
    if units == "natural":
        return 1.0
    from atlas.core.units import system

    return system(units).c


def described(motion: Any, times: list[float], y: Any, v: Any) -> dict[str, Any]:
    """Return the quantities of a particle's motion and its samples; without B there is no drift."""
    drift = motion.drift if motion.cyclotron_frequency != 0 else None
    found = {"cyclotron_frequency": motion.cyclotron_frequency, "drift": drift}
    return found | {"samples": samples(times, position=y, velocity=v)}


def printout(texts: dict[str, Any], options: dict[str, Any]) -> Printout:
    """Lay the certified texts out, three rows a time."""
    time, speed, length = {
        "natural": ("1/time", "length/time", "length"),
        "gaussian": ("rad/s", "cm/s", "cm"),
        "si": ("rad/s", "m/s", "m"),
    }[options["units"]]
    drift = f"({', '.join(texts['drift'])})" if texts["drift"] else "-"
    lines = [
        Line("omega", "cyclotron frequency mu |B|/c, with the sign of mu", texts["cyclotron_frequency"], time, "mf9"),
        Line("drift", "c [E, B]/B^2", drift, speed if texts["drift"] else "", "mf6"),
    ]
    rows = in_threes(texts["samples"])
    heading = ("t", f"y_i [{length}]", f"v_i [{speed}]") if rows else ()
    return Printout("point charge in constant fields", lines, heading, rows, [certificate(options)])
