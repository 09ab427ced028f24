"""Cost of a rotation matrix against their number, and against the memory limit.

Drawn from the stored record of the benchmark, which `make bench` renews.
"""

from atlas.scene.captions import listed, title
from atlas.scene.layers import Layer, Plane, Scene
from atlas.study.benchmark import Results, decades, line, measured, pairs, read
from atlas.study.benchmark import title as name

RECORDS = ("bench.json",)
SHOWN = ("plain_out", "lambdify", "rotation", "ours_out", "grid_out", "fill")
LARGE = 10_000


def scene(*, columns: int = 1) -> Scene:
    """Draw nanoseconds a matrix for all methods, and the multiples of filling the memory for large numbers."""
    record = read()
    return Scene(
        title=title(__doc__),
        caption=(
            "(a) Time for one rotation matrix of the elementary motion among $N$, on one core. (b) The same over "
            "the time in which one core fills that memory with a constant, on one core and on two. "
            f"{measured(record)}"
        ),
        alt=(
            "Two panels with logarithmic axes, the number of matrices to the right. Above, the time for one matrix "
            f"by {listed([name(method) for method in SHOWN])}. Below, multiples of the time that filling the memory "
            "takes, for the plain formula and for the atlas on one core and on two."
        ),
        panels=(each(record), multiples(record)),
        columns=columns,
        size=(columns * 140.0, 2 // columns * 74.0),
    )


def each(record: Results) -> Plane:
    """Draw nanoseconds a matrix on one thread."""
    layers: list[Layer] = []
    for method in SHOWN:
        rows = [r for r in record.costs if r.method == method and r.threads == 1 and r.nanoseconds is not None]
        if rows:
            layers.extend(line(pairs(rows, lambda row: row.count, lambda row: row.nanoseconds), method))
    return _plane("(a) time for one matrix", layers, "time for one matrix (ns)")


def multiples(record: Results) -> Plane:
    """Draw the multiples of filling the memory."""
    layers: list[Layer] = []
    for method, threads in (("plain_out", 1), ("ours_out", 1), ("ours_out", 2), ("grid_out", 1), ("grid_out", 2)):
        rows = [
            r
            for r in record.costs
            if (r.method, r.threads) == (method, threads) and r.count >= LARGE and r.to_fill is not None
        ]
        if rows:
            points = pairs(rows, lambda row: row.count, lambda row: row.to_fill)
            label = name(method) + (", two cores" if threads == 2 else "")
            layers.extend(line(points, f"{method}/{threads}" if threads == 2 else method, label))
    return _plane("(b) over the memory limit", layers, "multiples of filling the memory")


def _plane(name: str, layers: list[Layer], y_label: str) -> Plane:
    drawn = [layer.points for layer in layers]
    return Plane(
        tuple(layers),
        x_label="number of matrices $N$",
        y_label=y_label,
        x_limits=decades((x for points in drawn for x in points[:, 0]), 0.2, 1.0),
        y_limits=decades((y for points in drawn for y in points[:, 1]), 0.4, 0.4),
        x_scale="log",
        y_scale="log",
        title=name,
    )
