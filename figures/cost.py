"""Cost of a rotation matrix against their number, and against the memory limit.

Drawn from the stored record of the benchmark, which `make bench` renews.
"""

from dataclasses import replace

from atlas.checking import benchmark
from atlas.pictures.captions import listed
from atlas.pictures.layers import Layer, Plane, Scene

ROW = "a body"
SEEN = "More matrices at once take less time each."
RECORDS = ("bench.json",)
SHOWN = ("plain_out", "lambdify", "rotation", "ours_out", "grid_out", "fill")
MIN_COUNT = 10_000
ROOM = (0.2, 0.3), (0.4, 0.4)


def scene(*, columns: int = 1) -> Scene:
    """Draw nanoseconds a matrix for all methods, and the multiples of filling the memory for large numbers.

    ``columns`` is the number of panels side by side, 1 or 2. The numbers are those of the stored benchmark.
    """
    record = benchmark.read()
    return Scene(
        caption=(
            "(a) One of $N$ matrices of the elementary motion, on one core. (b) This time over the time in which "
            "one core fills that memory, on one core and, open dots, on two. "
            f"{benchmark.measured(record)}"
        ),
        alt=(
            "Two panels with logarithmic axes, the number of matrices to the right. Above, the time for one matrix "
            f"by {listed([benchmark.title(method) for method in SHOWN])}. Below, multiples of the time that filling "
            "the memory takes, for the plain formula and for the atlas on one core and on two."
        ),
        panels=(matrix_times(record), multiples(record)),
        columns=columns,
        spare=(1,),
        size=(columns * 140.0, 2 // columns * 66.0),
    )


def matrix_times(record: benchmark.Results) -> Plane:
    """Return panel (a), a `Plane`: nanoseconds for one matrix on one thread, over the number of matrices.

    Methods without a time in the record are left out.
    """
    layers: list[Layer] = []
    for method in SHOWN:
        rows = [r for r in record.costs if r.method == method and r.threads == 1 and r.nanoseconds is not None]
        if rows:
            layers.extend(
                benchmark.line(benchmark.pairs(rows, lambda row: row.count, lambda row: row.nanoseconds), method)
            )
    return benchmark.panel(
        layers, layers, ("number of matrices $N$", "time for one matrix (ns)"), ROOM, "(a) time for one matrix"
    )


def multiples(record: benchmark.Results) -> Plane:
    """Return panel (b), a `Plane`: times in multiples of filling the memory, over the number of matrices.

    Numbers below MIN_COUNT are left out; times on two cores have open dots.
    """
    layers: list[Layer] = []
    for method, threads in (("plain_out", 1), ("ours_out", 1), ("ours_out", 2), ("grid_out", 1), ("grid_out", 2)):
        rows = [
            r
            for r in record.costs
            if (r.method, r.threads) == (method, threads) and r.count >= MIN_COUNT and r.to_fill is not None
        ]
        if rows:
            points = benchmark.pairs(rows, lambda row: row.count, lambda row: row.to_fill)
            curve, dots = benchmark.line(points, method)
            if threads == 2:
                curve, dots = replace(curve, label=f"{curve.label}, two cores"), replace(dots, role="rest")
            layers += [curve, dots]
    return benchmark.panel(
        layers,
        layers,
        ("number of matrices $N$", "time over time to fill the memory"),
        ROOM,
        "(b) over the memory limit",
    )
