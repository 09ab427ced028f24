"""Error against time of the closed forms and of integrators.

Drawn from the stored record of the benchmark, which `make bench` renews: a method is better the further it lies to
the lower left. An integrator is a line with one dot a tolerance, from 1e-3 to 1e-14; a closed form is a point.
"""

from collections.abc import Iterator

from atlas.checking import benchmark
from atlas.errors import AtlasError
from atlas.pictures.captions import listed, plain
from atlas.pictures.layers import Layer, Plane, Points, Scene

ROW = "a body"
SEEN = "More digits cost an integrator more time, a closed form none."
RECORDS = ("bench.json",)
ROOM = (1.6, 0.5), (0.9, 0.5)


def scene(*, cases: tuple[str, ...] = ("elementary",), horizon: float = 100.0, columns: int = 1) -> Scene:
    """Draw one panel of time over error for each of the cases, with all runs up to the time ``horizon``.

    ``cases`` are keys of the benchmark's CASES, ``columns`` is the number of panels side by side. Raises AtlasError
    for a case or horizon that the stored record lacks.
    """
    record = benchmark.read()
    return Scene(
        caption=(
            f"Lines: integrators; marks: closed forms. Largest error up to "
            f"$t = {benchmark.power(horizon)}$ against the time for one sample, without set-up, for "
            f"{listed([f'the {benchmark.case_title(case)}' for case in cases])}. Each dot is a "
            "tolerance from $10^{-3}$ to $10^{-14}$. "
            f"{benchmark.measured(record)}"
        ),
        alt=(
            f"{'One panel' if len(cases) == 1 else f'{len(cases)} panels'} with two logarithmic axes, the largest "
            f"error up to t = {plain(horizon)} to the right and the time for one sample upwards: "
            f"{listed([benchmark.case_title(case) for case in cases])}. The lines of the integrators rise to the left; "
            "the closed forms are marks at the lower left."
        ),
        panels=panels(record, cases, horizon, columns),
        columns=columns,
        size=(columns * 140.0, -(-len(cases) // columns) * 66.0),
    )


def panels(record: benchmark.Results, cases: tuple[str, ...], horizon: float, columns: int) -> tuple[Plane, ...]:
    """Return a `Plane` for each case: time for a sample, in microseconds, over error, of all methods up to the horizon.

    `columns` is the number of panels side by side. Raises AtlasError for a case or a horizon that the record lacks.
    """
    layers = {
        case: tuple(run_lines([run for run in benchmark.runs_of(record, case) if run.horizon == horizon]))
        for case in cases
    }
    if not any(layers.values()):
        horizons = dict.fromkeys(f"{run.horizon:g}" for run in record.runs)
        raise AtlasError(f"The benchmark record has no horizon {horizon:g}; it has {', '.join(horizons)}.")
    labels = f"largest error up to $t = {benchmark.power(horizon)}$", "time for one sample (µs)"
    return benchmark.panels(layers, labels, ROOM, columns)


def run_lines(runs: list[benchmark.Run]) -> Iterator[Layer]:
    """Yield layers: a curve with dots for each integrator, and points for each closed form (runs without a tolerance).

    Points are (largest error, microseconds for a sample).
    """
    for method, group in benchmark.by_method(runs).items():
        points = benchmark.pairs(group, lambda run: run.error, lambda run: run.seconds / run.samples * 1e6)
        if group[0].tolerance is None:
            yield Points(points, benchmark.role(method), benchmark.title(method))
        else:
            yield from benchmark.line(points, method)
