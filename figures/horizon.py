"""Error against the horizon: how long the digits last.

Drawn from the stored record of the benchmark, which `make bench` renews. Of an integrator each dot is the best
tolerance that came through in time.
"""

from collections.abc import Iterator

from atlas.scene.captions import listed, tex, title
from atlas.scene.layers import Curve, Layer, Plane, Scene
from atlas.study.benchmark import (
    OURS,
    Results,
    Run,
    by_method,
    case_title,
    decades,
    line,
    measured,
    pairs,
    read,
    runs_of,
)

RECORDS = ("bench.json",)
LIMIT = 4 * 2.0**-52
"""Four ulp of 1, within which the atlas keeps every entry of a rotation matrix."""


def scene(*, cases: tuple[str, ...] = ("elementary", "ball", "particle"), columns: int = 1) -> Scene:
    """Draw one panel for each of the cases."""
    record = read()
    worst = max(
        (run.error for run in record.runs if run.method in OURS and run.case in cases and run.error is not None),
        default=0.0,
    )
    shown = listed([f"the {case_title(case)}" for case in cases])
    return Scene(
        title=title(__doc__),
        caption=(
            f"Largest error up to a time $T$, for {shown}. The largest of the atlas is "
            f"${tex(float(f'{worst:.1e}'))}$ (dotted: four ulp of 1). Of an integrator each dot is the best tolerance "
            f"that came through in time. {measured(record)}"
        ),
        alt=(
            f"{'One panel' if len(cases) == 1 else f'{len(cases)} panels'} with two logarithmic axes, time to the "
            f"right and the largest error upwards: {listed([case_title(case) for case in cases])}. "
            f"{len(by_method(record.runs))} methods are drawn; the largest error of the atlas is {worst:.1e}."
        ),
        panels=panels(record, cases),
        columns=columns,
        named={"dotted": "limit"},
        size=(columns * 140.0, -(-len(cases) // columns) * 66.0),
    )


def panels(record: Results, cases: tuple[str, ...]) -> tuple[Plane, ...]:
    """Draw the runs of each case, all on the same axes."""
    layers = {case: tuple(drawn(runs_of(record, case))) for case in cases}
    points = [layer.points for case in cases for layer in layers[case]]
    x_limits = decades((x for some in points for x in some[:, 0]), 0.4, 0.6)
    limit = Curve(pairs(x_limits, float, lambda _: LIMIT), "limit", "four ulp of 1")
    return tuple(
        Plane(
            (*layers[case], limit),
            x_label="time $T$",
            y_label="largest error up to $T$",
            x_limits=x_limits,
            y_limits=decades((y for some in points for y in some[:, 1]), 1.2, 0.7),
            x_scale="log",
            y_scale="log",
            title=f"({letter}) {case_title(case)}",
        )
        for letter, case in zip("abcdefgh", cases, strict=False)
    )


def drawn(runs: list[Run]) -> Iterator[Layer]:
    """Yield the line of each method through its best run at each horizon."""
    for method, group in by_method(runs).items():
        horizons = sorted({run.horizon for run in group})
        best = [min((run for run in group if run.horizon == T), key=lambda run: run.error) for T in horizons]
        yield from line(pairs(best, lambda run: run.horizon, lambda run: run.error), method)
