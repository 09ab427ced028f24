"""Error against the horizon: how long the digits last.

Drawn from the stored record of the benchmark, which `make bench` renews. Of an integrator each dot is the best
tolerance that came through in time.
"""

from collections.abc import Iterator
from dataclasses import replace

from atlas.checking import benchmark
from atlas.pictures.captions import listed, tex
from atlas.pictures.layers import Curve, Layer, Plane, Scene

ROW = "a body"
SEEN = "Errors of integrators grow, those of closed forms do not."
RECORDS = ("bench.json",)
LIMIT = 4 * 2.0**-52
"""Four ulp of 1, within which the atlas keeps every entry of a rotation matrix."""
ROOM = (0.4, 0.6), (1.2, 0.7)


def scene(*, cases: tuple[str, ...] = ("elementary", "ball", "particle"), columns: int = 1) -> Scene:
    """Draw one panel for each of the cases."""
    record = benchmark.read()
    largest_error = max(
        (
            run.error
            for run in record.runs
            if run.method in benchmark.OURS and run.case in cases and run.error is not None
        ),
        default=0.0,
    )
    case_titles = listed([f"the {benchmark.case_title(case)}" for case in cases])
    return Scene(
        caption=(
            f"Largest error up to $T$ for {case_titles}; the atlas's largest is "
            f"${tex(float(f'{largest_error:.1e}'))}$ (dotted: four ulp of 1). Dots: the best tolerance "
            f"that came through. {benchmark.measured(record)}"
        ),
        alt=(
            f"{'One panel' if len(cases) == 1 else f'{len(cases)} panels'} with two logarithmic axes, time to the "
            f"right and the largest error upwards: {listed([benchmark.case_title(case) for case in cases])}. "
            f"{len(benchmark.by_method(record.runs))} methods are drawn; the largest error of the atlas is "
            f"{largest_error:.1e}."
        ),
        panels=panels(record, cases, columns),
        columns=columns,
        named={"dotted": "limit"},
        spare=tuple(range(1, len(cases))),
        size=(columns * 140.0, -(-len(cases) // columns) * 66.0),
    )


def panels(record: benchmark.Results, cases: tuple[str, ...], columns: int) -> tuple[Plane, ...]:
    """Return a `Plane` for each case: error over horizon of all methods, and the limit."""
    layers = {case: tuple(run_lines(benchmark.runs_of(record, case))) for case in cases}
    planes = benchmark.panels(layers, ("time $T$", "largest error up to $T$"), ROOM, columns)
    limit = Curve(benchmark.pairs(planes[0].x_limits or (), float, lambda _: LIMIT), "limit")
    return tuple(replace(plane, layers=(*plane.layers, limit)) for plane in planes)


def run_lines(runs: list[benchmark.Run]) -> Iterator[Layer]:
    """Yield layers, a curve with dots, for each method: its least error at each horizon."""
    for method, group in benchmark.by_method(runs).items():
        horizons = sorted({run.horizon for run in group})
        best = [min((run for run in group if run.horizon == T), key=lambda run: run.error) for T in horizons]
        yield from benchmark.line(benchmark.pairs(best, lambda run: run.horizon, lambda run: run.error), method)
