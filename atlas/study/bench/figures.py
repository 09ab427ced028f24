"""What the three figures of the benchmark share: the runs of a case, the words, the lines of a method."""

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np

from atlas.errors import AtlasError
from atlas.scene.layers import Curve, FloatArray, Layer, Points
from atlas.study.bench.methods import LINES, title
from atlas.study.bench.results import Results, Run


def runs_of(record: Results, case: str) -> list[Run]:
    """Return the runs of a case that have an error and a time."""
    known = list(dict.fromkeys(run.case for run in record.runs))
    if case not in known:
        raise AtlasError(f"The benchmark record has no case {case!r}; it has {', '.join(known)}.")
    return [run for run in record.runs if run.case == case and run.error is not None]


def by_method(runs: Iterable[Run]) -> dict[str, list[Run]]:
    """Return the runs of each method, in the order of the record."""
    groups: dict[str, list[Run]] = {}
    for run in runs:
        groups.setdefault(run.method, []).append(run)
    return groups


def pairs(items: Iterable[Any], x: Callable[[Any], Any], y: Callable[[Any], Any]) -> FloatArray:
    """Return points (N, 2); a zero, which a logarithm cannot show, becomes the smallest error there is to see."""
    points = np.array([(x(item), y(item)) for item in items], dtype=np.float64).reshape(-1, 2)
    return np.asarray(np.maximum(points, 1e-18))


def line(points: FloatArray, method: str, label: str | None = None) -> tuple[Layer, ...]:
    """Return the line of a method with a dot where it was measured."""
    role = LINES.get(method, "eighth")
    return Curve(points, role, title(method) if label is None else label), Points(points, "sample")


def decades(values: Iterable[float], left: float = 1.0, right: float = 1.0) -> tuple[float, float]:
    """Return limits for a logarithmic axis with ``left`` and ``right`` decades of room for names."""
    logs = np.log10(np.fromiter(values, dtype=float))
    return float(10.0 ** (logs.min() - left)), float(10.0 ** (logs.max() + right))


def measured(record: Results) -> str:
    """Return the sentence that says where and when it was measured."""
    here = record.machine
    vector = "with" if here.avx512 else "without"
    versions = ", ".join(f"{name} {record.versions[name]}" for name in ("numpy", "scipy") if name in record.versions)
    return f"Measured on {here.processor}, {here.cores} cores, {vector} AVX-512, {versions}, on {record.date}."


def power(value: float) -> str:
    """Return a power of ten for a formula, or the number where it is none."""
    exponent = np.log10(value)
    return f"10^{{{exponent:.0f}}}" if exponent == round(exponent) else f"{value:g}"
