"""Grade a user's trajectory against the certified motion: correct digits, where it begins to fail, what drifts."""

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

from atlas.errors import AtlasError
from atlas.scene import Curve, Plane, Scene
from atlas.study.drift import Drift, Drifts
from atlas.study.grades import MOST, Column, Envelope, Errors, Grade, inverse_fits
from atlas.study.reference import reference
from atlas.study.trajectory import opened
from atlas.study.truth import truth_of

LINES = {"R": ("main", "$R$"), "Omega": ("second", r"$\boldsymbol{\Omega}$"), "quaternion": ("fourth", "quaternion")}


@dataclass(frozen=True)
class Check:
    """The grades of a trajectory.

    ``errors`` holds for R, Omega and quaternion the largest error of each ``rows_a_point`` rows that follow one
    another, ``times`` the time of the first of them: so few that a curve can be drawn through them. ``inverse`` says
    that the matrices or quaternions fail, and that those of the inverse rotations would not.
    """

    file: str
    case: str
    parameters: Mapping[str, Any]
    frequencies: Mapping[str, str]
    rows: int
    threshold: float
    columns: tuple[Column, ...]
    drifts: tuple[Drift, ...]
    rows_a_point: int
    times: tuple[float, ...]
    errors: Mapping[str, tuple[float, ...]]
    inverse: bool

    def record(self) -> dict[str, Any]:
        """Return the grades as plain data for JSON."""
        return asdict(self)

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
        if not self.columns:
            raise AtlasError(f"{self.file} is of a body without a certified motion: there is no error to draw.")
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
        each = "each row" if self.rows_a_point == 1 else f"each {self.rows_a_point} rows"
        return Scene(
            title=f"Error of {self.file}",
            caption=(
                f"The largest error of {each} of {self.file} against the certified motion; of a matrix and of a "
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


def check(path: Path, *, threshold: float = 6.0, **given: Any) -> Check:
    """Grade the trajectory in a CSV file, see `atlas.study.trajectory`; `given` parameters override its # lines.

    Their names are those of the lines: ratio (or a SymmetricBody) or inertia, field, omega or omega2 and omega3, and
    of a top direction, coupling, linear and quadratic; None is what is not given. With omega, all three components of
    the initial angular velocity, the trajectory is held against the general motion, with three moments of inertia
    against that of any body, with a direction against that of a top; with omega2 and, where it is free, omega3, against
    an elementary one.

    Three moments without omega, and the six elements of an inertia tensor, are of a body without a certified motion:
    only what should not change is reported, against the first row.

    A column fails from the first row on at which it has fewer than ``threshold`` correct digits, of the 17 that a
    double can have. The times and the parameters of the file are taken as the doubles nearest to what is written.
    The file is gone through once, in blocks. Raises AtlasError for what is no such file, or no such motion.
    """
    if not 0 <= threshold <= MOST:
        raise AtlasError(f"The threshold counts correct digits, from 0 to {MOST:g}; it cannot be {threshold:g}.")
    with opened(path) as trajectory:
        known = reference(trajectory.parameters, given, path.name)
        errors = Errors(known.motion, truth_of(known.motion, known.unit), known.unit) if known.motion else None
        if errors and 10.0**-threshold <= 2 * errors.floor:
            raise AtlasError(
                f"The threshold may be {-math.log10(2 * errors.floor) - 0.05:.1f} digits at most for this motion, "
                f"whose closed form is evaluated within {errors.floor:.1e}; it cannot be {threshold:g}."
            )
        graded = [name for name in trajectory.names if name != "t"] if errors else []
        grades = [Grade(name, threshold, errors) for name in graded if errors]
        drifts, envelope, rows, inverse = Drifts(known.deviations), Envelope(), 0, False
        for block in trajectory.blocks:
            if errors:
                found = errors.of(block)
                for grade in grades:
                    grade.add(block, found[grade.name])
                envelope.add(block["t"], found)
                inverse |= not rows and inverse_fits(errors, block, found, 10.0**-threshold)
            drifts.add(block)
            rows += len(block["t"])
    if not errors and not any(drift.label == "theorem-clebsch" for drift in drifts.found()):
        raise AtlasError(
            f"{path.name}: without a certified motion for this inertia tensor the integrals are all there is to test, "
            "and they need R11 to R33 or a quaternion, and Omega1 to Omega3. Three moments of inertia have one, with a "
            "line such as '# omega = 0.3 0.7 0.2', the angular velocity at t = 0."
        )
    return Check(
        file=path.name,
        case=known.case,
        parameters=known.parameters,
        frequencies=known.frequencies(),
        rows=rows,
        threshold=float(threshold),
        columns=tuple(grade.column() for grade in grades),
        drifts=drifts.found(),
        rows_a_point=envelope.rows,
        times=tuple(envelope.times()),
        errors={group: tuple(values) for group, values in envelope.errors().items()},
        inverse=inverse,
    )
