"""Grade a user's trajectory against the certified motion: correct digits, where it begins to fail, what drifts."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from functools import partial
from pathlib import Path
from statistics import median
from typing import Any, TypeAlias

import numpy as np
from flint import arb, ctx

from atlas.core.body import SymmetricBody
from atlas.errors import AtlasError
from atlas.exact.digits import certified, enclosed
from atlas.exact.elementary import ElementaryMotion
from atlas.exact.inputs import Real
from atlas.scene import Curve, Plane, Scene
from atlas.study.drift import Drift, drifts_of
from atlas.study.trajectory import MATRIX, OMEGA, QUATERNION, Trajectory, read

MOST = 17.0
"""Digits are counted up to here: no double has more."""

BITS = 80
GROUPS: Mapping[str, tuple[str, ...]] = {"R": MATRIX, "Omega": OMEGA, "quaternion": QUATERNION}
LINES = {"R": ("main", "$R$"), "Omega": ("second", r"$\boldsymbol{\Omega}$"), "quaternion": ("fourth", "quaternion")}
Row: TypeAlias = dict[str, float]


@dataclass(frozen=True)
class Column:
    """The grade of one column: digits that are correct, the worst place, and the time from which it fails, if it does.

    Digits are -log10 of the error; of an entry of R or of a quaternion in units of 1, of Omega in units of its length.
    """

    name: str
    median: float
    worst: float
    worst_time: float
    fails_at: float | None


@dataclass(frozen=True)
class Check:
    """The grades of a trajectory. ``errors`` holds for R, Omega and quaternion the largest error of each row."""

    file: str
    case: str
    parameters: Mapping[str, Any]
    frequencies: Mapping[str, str]
    rows: int
    threshold: float
    columns: tuple[Column, ...]
    drifts: tuple[Drift, ...]
    times: tuple[float, ...]
    errors: Mapping[str, tuple[float, ...]]

    def record(self) -> dict[str, Any]:
        """Return the grades as plain data for JSON."""
        return asdict(self) | {"columns": [asdict(c) for c in self.columns], "drifts": [asdict(d) for d in self.drifts]}

    def column_table(self) -> tuple[list[str], list[list[str]]]:
        """Return heading and rows of the grades by column."""
        heading = ["column", "median digits", "worst digits", "at t", f"below {self.threshold:g} digits from t"]
        rows = [
            [
                c.name,
                f"{c.median:z.1f}",
                f"{c.worst:z.1f}",
                f"{c.worst_time:g}",
                "-" if c.fails_at is None else f"{c.fails_at:g}",
            ]
            for c in self.columns
        ]
        return heading, rows

    def drift_table(self) -> tuple[list[str], list[list[str]]]:
        """Return heading and rows of what should not change."""
        heading = ["constant", "what", "equation", "largest deviation", "at t", "last deviation"]
        rows = [[d.name, d.says, d.label, f"{d.worst:.1e}", f"{d.worst_time:g}", f"{d.last:.1e}"] for d in self.drifts]
        return heading, rows

    def scene(self) -> Scene:
        """Draw the error of each group of columns against time."""
        least, most = 10.0**-MOST, 10.0**MOST
        layers = tuple(
            Curve(np.column_stack([self.times, np.clip(errors, least, most)]), *LINES[name])
            for name, errors in self.errors.items()
        )
        beyond = f" Errors beyond {most:g} are drawn there." if max(map(max, self.errors.values())) > most else ""
        limit = 10.0**-self.threshold
        line = Curve(
            np.array([[min(self.times), limit], [max(self.times), limit]]), "limit", f"{self.threshold:g} digits"
        )
        worst = min(self.columns, key=lambda c: c.worst)
        return Scene(
            title=f"Error of {self.file}",
            caption=(
                f"The largest error of each row of {self.file} against the certified motion; of a matrix and of a "
                f"quaternion in units of 1, of Omega in units of its length. The dotted line marks {self.threshold:g} "
                f"digits. The worst column is {worst.name}, with {worst.worst:.1f} correct digits at "
                f"t = {worst.worst_time:g}.{beyond}"
            ),
            alt=(
                f"Curves of error against time on a logarithmic scale, for {', '.join(self.errors)}; the worst column, "
                f"{worst.name}, has {worst.worst:.1f} correct digits at t = {worst.worst_time:g}."
            ),
            panels=(Plane((*layers, line), "$t$", "error", y_scale="log", legend=True),),
            size=(120.0, 75.0),
            parameters=dict(self.parameters),
        )


def check(
    path: Path,
    *,
    ratio: Any = None,
    field: tuple[float, float] | None = None,
    omega2: float | None = None,
    omega3: float | None = None,
    threshold: float = 6.0,
) -> Check:
    """Grade the trajectory in a CSV file, see `atlas.study.trajectory`; arguments override the file's # lines.

    A column fails from the first row on at which it has fewer than ``threshold`` correct digits, of the 17 that a
    double can have. The times and the parameters of the file are taken as the doubles nearest to what is written.
    """
    if not 0 <= threshold <= MOST:
        raise AtlasError(f"The threshold counts correct digits, from 0 to {MOST:g}; it cannot be {threshold:g}.")
    trajectory = read(path)
    given = dict(trajectory.parameters)
    parameters: dict[str, Any] = {
        "ratio": ratio if ratio is not None else _body(given, path.name),
        "field": field if field is not None else _needed(given, "field", path.name),
        "omega2": omega2 if omega2 is not None else _needed(given, "omega2", path.name)[0],
        "omega3": omega3 if omega3 is not None else given.get("omega3", (None,))[0],
    }
    motion = ElementaryMotion(*parameters.values())
    with ctx.workprec(BITS + 16):
        errors = _errors(trajectory, motion)
        drifts = tuple(drifts_of(trajectory, motion))
    times = tuple(trajectory.times)
    return Check(
        file=path.name,
        case=motion.case,
        parameters=_shown(parameters),
        frequencies=certified(lambda: {"omega3": motion.omega3, "k": motion.k, "phi": motion.phi}, 15),
        rows=len(times),
        threshold=float(threshold),
        columns=tuple(_grade(name, times, values, threshold) for name, values in errors.items()),
        drifts=drifts,
        times=times,
        errors={
            group: tuple(max(row) for row in zip(*(errors[n] for n in names if n in errors), strict=True))
            for group, names in GROUPS.items()
            if any(name in errors for name in names)
        },
    )


def _shown(parameters: Mapping[str, Any]) -> dict[str, Any]:
    """Return the parameters as plain numbers, a body as its two moments."""
    body = parameters["ratio"]
    shown: dict[str, Any] = {"inertia": [body.I2, body.I3]} if hasattr(body, "I2") else {"ratio": float(body)}
    shown["field"] = [float(component) for component in parameters["field"]]
    return shown | {name: float(parameters[name]) for name in ("omega2", "omega3") if parameters[name] is not None}


def _body(given: Mapping[str, tuple[float, ...]], file: str) -> Any:
    if "inertia" in given:
        I2, I3 = given["inertia"]
        return SymmetricBody(I2, I3)
    return _needed(given, "ratio", file)[0]


def _needed(given: Mapping[str, tuple[float, ...]], name: str, file: str) -> tuple[float, ...]:
    if name not in given:
        example = {"field": "# field = 1 2"}.get(name, f"# {name} = 1.5")
        raise AtlasError(f"{file} does not say {name}: give the option, or a line such as '{example}' in the file.")
    return given[name]


def _errors(trajectory: Trajectory, motion: ElementaryMotion) -> dict[str, list[float]]:
    """Return the errors of each column, row by row."""
    columns = {name: values for name, values in trajectory.columns.items() if name != "t"}
    errors: dict[str, list[float]] = {name: [] for name in columns}
    length = arb(motion.omega2**2 + motion.omega3**2).sqrt()
    for i, t in enumerate(trajectory.times):
        truth: dict[str, Real] = {}
        if any(name in columns for name in MATRIX + QUATERNION):
            R = enclosed(partial(motion.rotation, t), BITS)
            truth |= dict(zip(MATRIX, (x for row in R for x in row), strict=True))
        if any(name in columns for name in OMEGA):
            truth |= dict(zip(OMEGA, enclosed(partial(motion.angular_velocity, t), BITS), strict=True))
        if QUATERNION[0] in columns:
            found = [columns[name][i] for name in QUATERNION]
            truth |= dict(zip(QUATERNION, _quaternion(motion, t, found), strict=True))
        for name, values in columns.items():
            unit = length if name in OMEGA and length != 0 else arb(1)
            errors[name].append(float((abs(arb(values[i]) - truth[name]) / unit).upper()))
    return errors


def _quaternion(motion: ElementaryMotion, t: float, found: Sequence[float]) -> list[Real]:
    """Return the quaternion of R(t), of the two the one nearer to what was found."""
    quaternion: list[Real] = enclosed(lambda: motion.quaternion(t), BITS)
    same = sum((arb(a) * b for a, b in zip(found, quaternion, strict=True)), arb(0))
    return quaternion if same >= 0 else [-x for x in quaternion]


def _grade(name: str, times: Sequence[float], errors: Sequence[float], threshold: float) -> Column:
    digits = [min(MOST, -math.log10(error)) if error else MOST for error in errors]
    worst = min(range(len(digits)), key=digits.__getitem__)
    fails = next((t for t, d in zip(times, digits, strict=True) if d < threshold), None)
    return Column(name, median(digits), digits[worst], times[worst], fails)
