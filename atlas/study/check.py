"""Grade a user's trajectory against the certified motion: correct digits, where it begins to fail, what drifts."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from atlas.core.body import SymmetricBody
from atlas.core.inertia import inertia_tensor
from atlas.errors import AtlasError
from atlas.exact.digits import certified
from atlas.exact.elementary import ElementaryMotion
from atlas.exact.general import GeneralMotion
from atlas.scene import Curve, Plane, Scene
from atlas.study.drift import AnyBody, Drift, Drifts, of_motion
from atlas.study.grades import MOST, Column, Envelope, Errors, Grade
from atlas.study.trajectory import Trajectory, opened

LINES = {"R": ("main", "$R$"), "Omega": ("second", r"$\boldsymbol{\Omega}$"), "quaternion": ("fourth", "quaternion")}


@dataclass(frozen=True)
class Check:
    """The grades of a trajectory.

    ``errors`` holds for R, Omega and quaternion the largest error of each ``rows_a_point`` rows that follow one
    another, ``times`` the time of the first of them: so few that a curve can be drawn through them.
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


def check(
    path: Path,
    *,
    ratio: Any = None,
    field: tuple[float, float] | None = None,
    omega2: float | None = None,
    omega3: float | None = None,
    omega: tuple[float, float, float] | None = None,
    threshold: float = 6.0,
) -> Check:
    """Grade the trajectory in a CSV file, see `atlas.study.trajectory`; arguments override the file's # lines.

    With ``omega``, all three components of the initial angular velocity, it is held against the general motion; with
    ``omega2`` and, where it is free, ``omega3``, against an elementary one.

    A file with three moments or six elements of an inertia tensor in its line # inertia is of a body without a
    certified motion: only what should not change is reported, against the first row. The field is that of the file.

    A column fails from the first row on at which it has fewer than ``threshold`` correct digits, of the 17 that a
    double can have. The times and the parameters of the file are taken as the doubles nearest to what is written.
    The file is gone through once, in blocks.
    """
    if not 0 <= threshold <= MOST:
        raise AtlasError(f"The threshold counts correct digits, from 0 to {MOST:g}; it cannot be {threshold:g}.")
    with opened(path) as trajectory:
        given = dict(trajectory.parameters)
        if ratio is None and len(given.get("inertia", ())) > 2:
            return _any_body(trajectory, path.name, field, threshold)
        parameters = {
            "ratio": ratio if ratio is not None else _body(given, path.name),
            "field": field if field is not None else _needed(given, "field", path.name),
        } | _start(given, path.name, omega2, omega3, omega)
        motion = (GeneralMotion if "omega" in parameters else ElementaryMotion)(*parameters.values())
        errors, drifts, envelope = Errors(motion), Drifts(partial(of_motion, motion)), Envelope()
        grades = [Grade(name, threshold, errors) for name in trajectory.names if name != "t"]
        rows = 0
        for block in trajectory.blocks:
            found = errors.of(block)
            for grade in grades:
                grade.add(block, found[grade.name])
            drifts.add(block)
            envelope.add(block["t"], found)
            rows += len(block["t"])
    return Check(
        file=path.name,
        case=motion.case if isinstance(motion, ElementaryMotion) else motion.kind,
        parameters=_shown(parameters),
        frequencies=_frequencies(motion),
        rows=rows,
        threshold=float(threshold),
        columns=tuple(grade.column() for grade in grades),
        drifts=drifts.found(),
        rows_a_point=envelope.rows,
        times=tuple(envelope.times()),
        errors={group: tuple(values) for group, values in envelope.errors().items()},
    )


def _frequencies(motion: ElementaryMotion | GeneralMotion) -> dict[str, str]:
    """Return omega3, k and phi; of a general motion nothing, for its angles belong to a period."""
    if isinstance(motion, GeneralMotion):
        return {}
    found: dict[str, str] = certified(lambda: {"omega3": motion.omega3, "k": motion.k, "phi": motion.phi}, 15)
    return found


def _any_body(trajectory: Trajectory, file: str, field: Sequence[float] | None, threshold: float) -> Check:
    """Return what drifts in the motion of a body of any inertia tensor, with no column graded."""
    given = trajectory.parameters["inertia"]
    a, b, c, ab, ac, bc = (*given, 0.0, 0.0, 0.0)[:6]
    tensor = inertia_tensor([[a, ab, ac], [ab, b, bc], [ac, bc, c]])
    B = np.array(field if field is not None else _needed(trajectory.parameters, "field", file))
    B = B if B.size == 3 else np.array([0.0, *B])
    kept, rows, ends = Drifts(AnyBody(tensor, B)), 0, list[float]()
    for block in trajectory.blocks:
        kept.add(block)
        rows += len(block["t"])
        ends = [*ends[:1], float(block["t"][0]), float(block["t"][-1])]
    drifts = kept.found()
    if not any(drift.label == "theorem-clebsch" for drift in drifts):
        raise AtlasError(
            f"{file}: without a certified motion for this inertia tensor the integrals are all there is to test, and "
            "they need R11 to R33 or a quaternion, and Omega1 to Omega3."
        )
    shown = {"inertia": list(given), "field": B.tolist()}
    times = (ends[0], ends[-1])
    return Check(file, "any inertia tensor", shown, {}, rows, float(threshold), (), drifts, rows, times, {})


def _start(
    given: Mapping[str, tuple[float, ...]],
    file: str,
    omega2: float | None,
    omega3: float | None,
    omega: tuple[float, float, float] | None,
) -> dict[str, Any]:
    """Return the initial angular velocity: omega, or omega2 and omega3; what is an argument comes before the file."""
    one = omega2 is not None or omega3 is not None
    if omega is not None and one:
        raise AtlasError("The start is one of omega (three components) and omega2 with omega3: found both.")
    if omega is not None:
        return {"omega": omega}
    if not one and "omega" in given and "omega2" in given:
        raise AtlasError(f"{file} gives the start twice, by omega and by omega2: leave one of them out.")
    if not one and "omega" in given:
        return {"omega": given["omega"]}
    return {
        "omega2": omega2 if omega2 is not None else _needed(given, "omega2", file)[0],
        "omega3": omega3 if omega3 is not None else given.get("omega3", (None,))[0],
    }


def _shown(parameters: Mapping[str, Any]) -> dict[str, Any]:
    """Return the parameters as plain numbers, a body as its two moments."""
    body = parameters["ratio"]
    shown: dict[str, Any] = {"inertia": [body.I2, body.I3]} if hasattr(body, "I2") else {"ratio": float(body)}
    shown["field"] = [float(component) for component in parameters["field"]]
    if "omega" in parameters:
        return shown | {"omega": [float(w) for w in parameters["omega"]]}
    return shown | {name: float(parameters[name]) for name in ("omega2", "omega3") if parameters[name] is not None}


def _body(given: Mapping[str, tuple[float, ...]], file: str) -> Any:
    if "inertia" in given and "ratio" in given:
        raise AtlasError(f"{file} gives the body twice, by ratio and by inertia: leave one of them out.")
    if "inertia" in given:
        I2, I3 = given["inertia"]
        return SymmetricBody(I2, I3)
    return _needed(given, "ratio", file)[0]


def _needed(given: Mapping[str, tuple[float, ...]], name: str, file: str) -> tuple[float, ...]:
    if name not in given:
        example = {"field": "# field = 1 2"}.get(name, f"# {name} = 1.5")
        raise AtlasError(f"{file} does not say {name}: give the option, or a line such as '{example}' in the file.")
    return given[name]
