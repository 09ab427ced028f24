"""``atlas hyperbola``: points of the hyperbola of elementary motions, with frequencies and stability."""

from typing import Any

import click

from atlas.cli.body import (
    as_typed,
    body_options,
    body_parameters,
    chosen_body,
    chosen_field,
    field_options,
    units_of,
)
from atlas.cli.options import examples, multiple_option, output_options
from atlas.cli.present import Line, Printout, answer, at_times, certificate, show
from atlas.cli.typed import REAL, exactly
from atlas.cli.words import Command

CROSS = "With B3 = 0 the curve is this line and another, omega2 = -B2, on which omega3 is free."
COLUMNS = ("omega2", "omega3", "k", "phi", "nutation_squared")


@click.command(
    "hyperbola",
    cls=Command,
    epilog=examples(
        "atlas hyperbola --ratio 0.5 --field 1 0.1 --count 20",
        "atlas hyperbola --ratio 1.5 --field 1 2 --omega2 -2 -0.5 0.7 --json",
    ),
)
@body_options
@field_options
@multiple_option("omega2", "W [W ...]", "Values of omega2, in 1/time, at which the curve is tabulated.", type=REAL)
@click.option(
    "--count",
    type=click.IntRange(2, 100_000),
    default=12,
    show_default=True,
    help="Number of points on both branches together, if --omega2 is not given.",
)
@output_options
def command(**options: Any) -> None:
    """Tabulate the hyperbola (67), the starts (0, omega2, omega3) of motions without nutation.

    The columns are omega2, omega3, the frequencies k of precession and phi of proper rotation, and the square of the
    frequency of small nutations, which is negative where the motion is unstable.
    """
    points = list(options["omega2"]) or sampled(curve_of(options), options["count"])

    def floats() -> dict[str, Any]:
        curve = curve_of(options)
        k, phi = at_times(curve.frequencies, points)
        return described(curve, points, at_times(curve.omega3, points), k, phi, at_times(curve.stability, points))

    def balls() -> dict[str, Any]:
        from atlas.motions.elementary.certified_hyperbola import Hyperbola

        typed_options = as_typed(options)
        curve = Hyperbola(chosen_body(typed_options), chosen_field(typed_options))
        abscissas = [exactly(x, options) for x in points]
        pairs = [curve.frequencies(x) for x in abscissas]
        columns = ([p[0] for p in pairs], [p[1] for p in pairs], [curve.stability(x) for x in abscissas])
        return described(curve, points, [curve.omega3(x) for x in abscissas], *columns)

    texts = answer(options, body_parameters(options), floats, balls)
    if texts is not None:
        show(printout(texts, options, [] if chosen_field(options)[1] else [CROSS]))


def curve_of(options: dict[str, Any]) -> Any:
    """Return the `Hyperbola` of the command's options by name, in doubles."""
    from atlas.motions.elementary.kernel_hyperbola import Hyperbola

    return Hyperbola(chosen_body(options), chosen_field(options))


def sampled(curve: Any, count: int) -> list[float]:
    """Return values of omega2 in 1/time on the curve (67), a `Hyperbola` in doubles, without the pole omega2 = -B2.

    They are on both branches, for B3 = 0 on the line omega3 = 0; there are `count` or more.
    """
    if curve.B3:
        return [float(x) for x in curve.sample(count)[0]]
    return [float(x) for x in curve.branches(2 * count)[0][0] if x != curve.pole]


def described(curve: Any, points: list[float], *columns: Any) -> dict[str, Any]:
    """Return a dict with "pole", "unstable_band" and "points", a list of dicts with the keys of COLUMNS.

    `points` are the values of omega2; `columns` are omega3, the rates k of precession and phi of proper rotation,
    all in 1/time, and the square of the nutation frequency in 1/time^2, each with a value for each point. "pole" is
    omega2 = -B2; "unstable_band" the interval of ((omega2 + B2)/B2)^2 with unstable motions, or None.
    """
    rows = [dict(zip(COLUMNS, row, strict=True)) for row in zip(points, *columns, strict=True)]
    return {"pole": curve.pole, "unstable_band": curve.unstable_band, "points": rows}


def printout(texts: dict[str, Any], options: dict[str, Any], notes: list[str]) -> Printout:
    """Return the `Printout` of certified texts by name, with a row for each point; `notes` stand below it.

    `options` decide on the units.
    """
    band, rate = texts["unstable_band"], units_of(options).get("1/time", "1/time")
    lines = [
        Line("-B2", "pole of omega3(omega2)", texts["pole"], rate, "(71)"),
        Line(
            "y", "((omega2 + B2)/B2)^2 where the motion is unstable", f"{band[0]} to {band[1]}" if band else "nowhere"
        ),
    ]
    heading = [f"{name} [{rate}]" for name in COLUMNS[:-1]] + [f"nutation^2 [{rate}^2]"]
    rows = [[f"{float(row['omega2'])!r}", *(row[name] for name in COLUMNS[1:])] for row in texts["points"]]
    return Printout("hyperbola of elementary motions, (67)", lines, heading, rows, [*notes, certificate(options)])
