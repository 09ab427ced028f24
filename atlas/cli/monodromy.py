"""``atlas monodromy``: the integer matrix by which the periods of a top come back from a loop."""

import math

import click

from atlas.cli.options import REAL, Command, examples
from atlas.cli.present import Line, Printout, dump, show

LETTERS = ("g1", "g2", "g3")
LEAST = 1e-280
"""Least square of a rate, beside which an energy keeps its digits."""

NOTES = (
    "g1: one turn about n; g2: one about the axis; g3: one nutation, less its turns. Rows: what they become.",
    "Angles are balls; that the integers are these rests on no angle changing by half a turn between neighbours.",
)


@click.command(
    "monodromy",
    cls=Command,
    epilog=examples(
        "atlas monodromy --inertia 1 0.5 --linear 1 --M3 0.5",
        "atlas monodromy --inertia 1 1.5 --coupling 1 1.5 --M3 0 --p 0 --json",
    ),
)
@click.option(
    "--inertia", type=REAL, nargs=2, required=True, metavar="I2 I3", help="Moments across and along the axis."
)
@click.option(
    "--coupling", type=REAL, nargs=2, default=(0.0, 0.0), metavar="K2 K3", help="M = I Omega + k b, as in atlas top."
)
@click.option("--linear", type=REAL, default=0.0, help="Potential linear nu + quadratic nu^2/2; m g l of a heavy top.")
@click.option("--quadratic", type=REAL, default=0.0, help="Its other coefficient, of an anisotropy.")
@click.option("--M3", "along", type=REAL, required=True, help="Momentum along the axis, the same on the whole loop.")
@click.option(
    "--p", "p", type=REAL, help="Momentum along n in the middle of the loop; M3, of the upright spin, if left out."
)
@click.option("--points", type=click.IntRange(3, 10_000), default=48, show_default=True, help="Points of the loop.")
@click.option("--json", "as_json", is_flag=True, help="JSON on standard output, and nothing else there.")
def command(
    inertia: tuple[float, float],
    coupling: tuple[float, float],
    linear: float,
    quadratic: float,
    along: float,
    p: float | None,
    points: int,
    as_json: bool,
) -> None:
    """Carry the periods of a top round a loop of p and g, counter-clockwise, round the spin at p = M3 or -M3.

    p and M3 are the momenta along n and the axis, in the unit of inertia/time; g that of theorem-every-top. Round an
    unstable spin the lattice of periods comes back by an integer matrix that is not one: monodromy (not in the paper).
    """
    from atlas.core.bodies.symmetric_top import given
    from atlas.core.maps.monodromy import around, monodromy
    from atlas.core.maps.wells import Wells
    from atlas.errors import DomainError

    middle = along if p is None else p
    given(inertia, coupling, (0.0, 1.0), linear, quadratic)
    unit = float(inertia[0])
    I, twist, weight, lean = (
        inertia[1] / unit,
        (coupling[0] / unit, coupling[1] / unit),
        linear / unit,
        quadratic / unit,
    )
    M3 = along / unit
    wells = Wells.at(M3, I, twist, weight, lean)
    size = 4 * (abs(wells.A) + abs(wells.a)) + M3 * M3
    if size and not LEAST < max(size, abs(middle / unit)) < math.inf:
        raise DomainError("The rates of this top are too large or too small for floats: choose another unit of time.")
    loop = around(wells, middle / unit, points)
    found = monodromy(I, twist, M3, loop, weight, lean)
    if as_json:
        dump({
            "matrix": found.matrix,
            "loop": {"p": found.p * unit, "g": found.g * unit},
            "period": found.period,
            "turns": found.turns,
            "step": found.step,
            "radius": found.radius,
        })  # fmt: skip
        return
    ends = ((x.min() * scale, x.max() * scale) for x, scale in ((found.p, unit), (found.g, unit), (found.period, 1.0)))
    ranges = [f"{low:.6g} ... {high:.6g}" for low, high in ends]
    show(
        Printout(
            "monodromy of the periods of a top",
            [
                Line("p", "momentum along n on the loop", ranges[0], "inertia/time"),
                Line("g", "energy on the loop", ranges[1], "inertia/time^2", "theorem-every-top"),
                Line("T", "period of nutation on it", ranges[2], "time"),
                Line("step", "largest change of an angle from a point to the next", f"{found.step:.3f}", "turn"),
                Line("radius", "largest radius of the balls of the angles", f"{found.radius:.0e}", "turn"),
            ],
            ["new", *LETTERS],
            [[name, *map(str, row)] for name, row in zip(LETTERS, found.matrix, strict=True)],
            NOTES,
        )
    )
