"""The record of the benchmark, which `make bench` writes, read for figures and pages.

Figures and pages are drawn from the stored file, never from a fresh run, so they rebuild the same.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, Literal, TypeAlias

import msgspec
import numpy as np

from atlas.errors import AtlasError
from atlas.pictures.layers import Curve, FloatArray, Layer, Plane, Points
from atlas.places import folder

FORMAT = 2
Status: TypeAlias = Literal["done", "failed", "timed out", "skipped"]
Verdict: TypeAlias = Literal["met", "missed", "wrong values", "not measured"]

METHODS = {
    "ours": ("atlas", "main"),
    "ours_grid": ("atlas, grid", "seventh"),
    "alone": ("atlas, one by one", "eighth"),
    "plain": ("plain NumPy", "second"),
    "lambdify": ("sympy lambdify", "third"),
    "compiled": ("compiled C", "limit"),
    "rotation": ("SciPy Rotation", "sixth"),
    "ours_out": ("atlas, out=", "main"),
    "ours_out_far": ("atlas, out=, far", "eighth"),
    "grid": ("atlas, grid", "eighth"),
    "grid_out": ("atlas, grid, out=", "seventh"),
    "even_out": ("atlas, times of the grid, out=", "eighth"),
    "heyoka_own": ("heyoka, its own tolerance", "fourth"),
    "heyoka_7": ("heyoka, with a quaternion", "fourth"),
    "DOP853_7": ("DOP853, with a quaternion", "fifth"),
    "heyoka_long": ("heyoka, long double", "fourth"),
    "third_axis": ("atlas, third axis alone", "eighth"),
    "omega": ("atlas, Omega alone", "eighth"),
    "plain_out": ("plain NumPy, out=", "second"),
    "plain_out_far": ("plain NumPy, out=, far", "eighth"),
    "fill": ("filling the memory", "limit"),
    "RK45": ("RK45", "pole"),
    "DOP853": ("DOP853", "fifth"),
    "LSODA": ("LSODA", "eighth"),
    "Radau": ("Radau", "reference"),
    "heyoka": ("heyoka", "fourth"),
}
"""Name of each method, and the role of its line in a figure."""

CASES = {
    "elementary": "elementary motion",
    "general": "general motion",
    "ball": "charged ball",
    "particle": "charged particle",
    "heavy": "heavy top",
    "asymmetric": "three moments",
    "elliptic": "elliptic motion",
}

BESIDE = ("heyoka_own", "heyoka_7", "DOP853_7")
"""Variants of an integrator that stand in tables only: in a figure their lines would lie on the integrator's."""


def title(method: str) -> str:
    """Return the title of a method, a key of METHODS, for legends; an unknown method is its own title."""
    return METHODS[method][0] if method in METHODS else method


def role(method: str) -> str:
    """Return the role, and so the colour, of a method's line; "eighth" for an unknown method."""
    return METHODS[method][1] if method in METHODS else "eighth"


def case_title(case: str) -> str:
    """Return the name of a case, a key of CASES, in words; an unknown case is its own name."""
    return CASES.get(case, case)


class Item(msgspec.Struct, frozen=True, forbid_unknown_fields=True, omit_defaults=True):
    """Base class of the records of a benchmark: immutable, and decoding refuses a key that is no attribute."""


class Machine(Item, frozen=True):
    """Machine of a record: processor's name, usable cores, whether NumPy uses AVX-512, and operating system."""

    processor: str
    cores: int
    avx512: bool
    system: str


class Run(Item, frozen=True):
    """One method on one case up to the time `horizon`: largest error and computing time, or None and a reason.

    ``case`` is a key of CASES, ``method`` one of METHODS, ``samples`` the number of times, ``tolerance`` that of an
    integrator. ``error`` is the largest over the samples, or over a few of them where true values take long;
    ``seconds`` is the time for all samples once the method is set up. ``note`` is the reason where they are None.
    """

    case: str
    method: str
    horizon: float
    samples: int
    status: Status
    tolerance: float | None = None
    error: float | None = None
    seconds: float | None = None
    note: str = ""


class Cost(Item, frozen=True):
    """Time for ``count`` rotation matrices by a ``method``, in ``nanoseconds`` each, on ``threads`` threads.

    ``to_fill`` is the ratio to the time of filling the same memory, ``to_plain`` the ratio to the plain formula's
    time, ``to_times`` that of a grid to the time of `rotation` at the same times; all three are with one thread.
    ``error`` is the largest error in an entry, among a few of the matrices. Values are None where not measured;
    ``note`` says why.
    """

    method: str
    count: int
    threads: int
    status: Status
    error: float | None = None
    nanoseconds: float | None = None
    to_fill: float | None = None
    to_plain: float | None = None
    to_times: float | None = None
    note: str = ""


class Limit(Item, frozen=True):
    """A limit of speed: its meaning `says`, the limit `wanted`, the value `found`, the verdict and the reason `why`.

    Meaning, limit and reason are texts; the value is None where it was not measured.
    """

    says: str
    wanted: str
    found: float | None
    verdict: Verdict
    why: str = ""


class Results(Item, frozen=True):
    """One run of the benchmark: the fields of its record that figures, pages and the README show.

    `format` is FORMAT, `command` the shell command that made the record, `date` is YYYY-MM-DD in universal time,
    `versions` are those of libraries by name. `runs` are pairs of error and time by case and method, `costs` the
    parts of a time, `limits` the times that were aimed at, with the measured ones, `narrow` some runs repeated
    without AVX-512.
    """

    format: int
    command: str
    date: str
    machine: Machine
    versions: dict[str, str]
    runs: list[Run]
    costs: list[Cost]
    limits: list[Limit] = []
    narrow: list[Run] = []
    """Closed forms of some cases once more, NumPy and C held back from AVX-512."""


def stored() -> Path:
    """Return the path of the benchmark record bench.json in the folder reports/data of the checkout or the package."""
    return folder("reports") / "data" / "bench.json"


def read(path: Path | None = None) -> Results:
    """Return the `Results` of a benchmark record, by default (None) the stored one, see `stored`.

    Raises AtlasError for a file that does not exist or is no such record.
    """
    path = path or stored()
    try:
        return msgspec.json.decode(path.read_bytes(), type=Results)
    except FileNotFoundError as error:
        raise AtlasError(f"There is no benchmark record {path.name}: run make bench first.") from error
    except msgspec.MsgspecError as error:
        raise AtlasError(f"{path.name} is not a benchmark record: {error}.") from error


def runs_of(record: Results, case: str) -> list[Run]:
    """Return the runs of a case that have an error. Raises AtlasError for a case that the record lacks."""
    names_known = list(dict.fromkeys(run.case for run in record.runs))
    if case not in names_known:
        raise AtlasError(f"The benchmark record has no case {case!r}; it has {', '.join(names_known)}.")
    return [run for run in record.runs if run.case == case and run.error is not None]


def by_method(runs: Iterable[Run]) -> dict[str, list[Run]]:
    """Return lists of runs by method, in the order of the record, without the methods of `BESIDE`."""
    groups: dict[str, list[Run]] = {}
    for run in runs:
        if run.method not in BESIDE:
            groups.setdefault(run.method, []).append(run)
    return groups


def pairs(items: Iterable[Any], x: Callable[[Any], Any], y: Callable[[Any], Any]) -> FloatArray:
    """Return the points (x(item), y(item)), shape (N, 2), of N items, for logarithmic axes.

    Values below 1e-18 become 1e-18, NaN stays; no items give the shape (0, 2).
    """
    points = np.array([(x(item), y(item)) for item in items], dtype=np.float64).reshape(-1, 2)
    return np.asarray(np.maximum(points, 1e-18))


def line(points: FloatArray, method: str) -> tuple[Curve, Points]:
    """Return (`Curve`, `Points`) of a method at its measured points (N, 2); the curve has its role and title."""
    return Curve(points, role(method), title(method)), Points(points, "sample")


def decades(values: Iterable[float], start: float = 1.0, end: float = 1.0) -> tuple[float, float]:
    """Return the limits (low, high) of a logarithmic axis: `start` decades below the values, `end` decades above.

    The values, one or more, are positive.
    """
    logs = np.log10(np.fromiter(values, dtype=float))
    return float(10.0 ** (logs.min() - start)), float(10.0 ** (logs.max() + end))


def panel(layers: Iterable[Layer], every: Iterable[Any], labels: tuple[str, str], room: Any, name: str) -> Plane:
    """Return a `Plane` of layers on logarithmic axes whose limits hold the points of all layers in `every`.

    `labels` are the texts of the horizontal and the vertical axis, `name` is the title. `room` is ((below, above) in x,
    (below, above) in y), the margins in powers of ten.
    """
    x, y = np.concatenate([layer.points for layer in every]).T
    return Plane(tuple(layers), *labels, decades(x, *room[0]), decades(y, *room[1]), "log", "log", title=name)


def panels(cases: Mapping[str, Sequence[Layer]], labels: tuple[str, str], room: Any, columns: int) -> tuple[Plane, ...]:
    """Return one `Plane` for each case, all with the same limits; only the lowest row labels the horizontal axis.

    `cases` maps names of cases to layers, `labels` and `room` are those of `panel`, `columns` is the number of
    panels in a row. Titles have letters (a), (b), ... where there are several cases, eight at most.
    """
    every, upper = [layer for runs in cases.values() for layer in runs], len(cases) - columns
    letters = [f"({letter}) " for letter in "abcdefgh"] if len(cases) > 1 else [""]
    return tuple(
        panel(runs, every, ("" if k < upper else labels[0], labels[1]), room, letters[k] + case_title(case))
        for k, (case, runs) in enumerate(cases.items())
    )


def measured(record: Results, libraries: Iterable[str] = ("numpy", "scipy")) -> str:
    """Return a sentence on machine, date and versions of a record; only `libraries` that the record has are named."""
    machine = record.machine
    vector = "with" if machine.avx512 else "without"
    versions = ", ".join(f"{name} {record.versions[name]}" for name in libraries if name in record.versions)
    return f"Measured on {machine.processor}, {machine.cores} cores, {vector} AVX-512, {versions}, on {record.date}."


def power(value: float) -> str:
    """Return a positive number as TeX: "10^{n}" for an exact power of ten, else its "%g" text."""
    exponent = np.log10(value)
    return f"10^{{{exponent:.0f}}}" if exponent == round(exponent) else f"{value:g}"
