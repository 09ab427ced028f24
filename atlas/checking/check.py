"""Grade a user's trajectory against the certified motion: correct digits, first failing row, drifts."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any, Literal, Required, TypeAlias, TypedDict, Unpack, overload

import numpy as np
from numpy.typing import NDArray

from atlas.arithmetic.annotations import RealArrayLike
from atlas.arithmetic.inputs import number, real
from atlas.checking.conserved import Drift, Drifts
from atlas.checking.conventions import conventions_that_fit
from atlas.checking.grades import LINES, MAX_DIGITS, Column, Envelope, Errors, Grade
from atlas.checking.order import Convergence, convergence
from atlas.checking.reference import OF_TOPS, reference
from atlas.checking.trajectory import Trajectory, holes_left_out, of_arrays, opened, whole_rows, with_plurals
from atlas.checking.truth import truth_of
from atlas.errors import AtlasError
from atlas.motions.any_body import AnyMotion
from atlas.motions.nutation.kernel_top import TopMotion
from atlas.pictures import Curve, Plane, Scene
from atlas.trial.ledger.plain import html_table, printable, table

CheckedMotion: TypeAlias = AnyMotion | TopMotion


@dataclass(frozen=True)
class Check:
    """Errors and correct digits of a trajectory, as `atlas.check` returns them; `str` is the text of `atlas check`.

    Attributes
    ----------
    file, case : str
        Name of the trajectory, and type of the reference motion.
    parameters : mapping of str to object
        Parameters of the reference motion.
    frequencies : mapping of str to str
        omega3, k and phi of an elementary reference motion, in certified digits; empty for other motions.
    rows : int
        Number of rows that were compared.
    threshold : float
        Number of correct digits below which a column fails.
    columns : tuple of Column
        Median and least number of correct digits of each column, under its name in the input; see `Column`.
    drifts : tuple of Drift
        Largest relative deviation of each conserved quantity; see `Drift`.
    rows_a_point : int
        Number of consecutive rows that `errors` summarises in one value.
    times : tuple of float
        First time of each such group of rows.
    errors : mapping of str to tuple of float
        Largest error in each group, for "R", "Omega" and "quaternion"; that of Omega is in units of a rate of the
        motion, see `Reference.unit`.
    conventions : tuple of str
        Sentences on conventions in which columns that fail would be right.
    step : float
        Step of the integrator as given, else the mean spacing of the times.
    end : float
        Last time.
    notes : tuple of str
        Sentences on columns and rows that were left out.
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
    conventions: tuple[str, ...]
    step: float
    end: float
    notes: tuple[str, ...] = ()

    @property
    def _title(self) -> str:
        return f"{printable(self.file)}: {self.rows} row{'s' * (self.rows != 1)}, case {self.case}"

    def __str__(self) -> str:
        """Return the grades as text: digits of each column, then drifts of conserved quantities, then notes."""
        none = f"{self._title}: nothing to compare with, so no column is graded"
        lines = [f"{self._title}\n{table(*self.column_table())}" if self.columns else none]
        if self.drifts:
            lines += ["constants of the motion", table(*self.drift_table(), align_left=True)]
        lines += map(printable, (*self.conventions, *self.notes))
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        return html_table(self._title, *self.column_table()) + html_table(
            "constants of the motion", *self.drift_table()
        )

    def record(self) -> dict[str, Any]:
        """Return the grades as a dict for JSON, with the attributes as keys."""
        return asdict(self)

    def column_table(self) -> tuple[list[str], list[list[str]]]:
        """Return (heading, rows) of the table of columns, five texts each, one row for each column of the trajectory.

        They are the column's name, its median and its least number of correct digits, the time of the latter, and
        the time from which digits stay below the threshold, or "-".
        """
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
        """Return (heading, rows) of the table of conserved quantities: six texts, and six texts for each quantity.

        They are its symbol, its meaning, its equation, the magnitude of the largest relative deviation, the time of
        that, and the magnitude of the relative deviation in the last row.
        """
        heading = ["constant", "meaning", "equation", "largest deviation", "at t", "last deviation"]
        rows = [[d.name, d.says, d.label, f"{d.worst:.1e}", f"{d.worst_time:g}", f"{d.last:.1e}"] for d in self.drifts]
        return heading, rows

    def scene(self) -> Scene:
        """Return a `Scene` of the largest error of R, Omega and quaternion against time, with a line at the threshold.

        Raises AtlasError where no column is graded.
        """
        if not self.columns:
            raise AtlasError(
                f"{self.file} is without an initial angular velocity, and so without an error to plot: give --omega."
            )
        low, high = 10.0**-MAX_DIGITS, 10.0**MAX_DIGITS
        layers = tuple(
            Curve(np.column_stack([self.times, np.clip(errors, low, high)]), *LINES[name])
            for name, errors in self.errors.items()
        )
        beyond = f" Errors beyond {high:g} are drawn there." if max(map(max, self.errors.values())) > high else ""
        limit = 10.0**-self.threshold
        line = Curve(
            np.array([[min(self.times), limit], [max(self.times), limit]]), "limit", f"{self.threshold:g} digits"
        )
        worst_column = min(self.columns, key=lambda c: c.worst)
        rows_each = "each row" if self.rows_a_point == 1 else f"each {self.rows_a_point} rows"
        return Scene(
            title=f"Error of {self.file}",
            caption=(
                f"The largest error of {rows_each} of {self.file} against the certified motion; of a matrix and of a "
                f"quaternion in units of 1, of Omega in units of its length. The dotted line marks {self.threshold:g} "
                f"digits. The worst column is {worst_column.name}, with {worst_column.worst:.1f} correct digits at "
                f"t = {worst_column.worst_time:g}.{beyond}"
            ),
            alt=(
                f"Curves of error against time on a logarithmic scale, for {', '.join(self.errors)}; the worst column, "
                f"{worst_column.name}, has {worst_column.worst:.1f} correct digits at t = {worst_column.worst_time:g}."
            ),
            panels=(Plane((*layers, line), "$t$", "error", y_scale="log", legend=True),),
            size=(120.0, 75.0),
            parameters=dict(self.parameters),
        )


class _Options(TypedDict, total=False):
    motion: Required[CheckedMotion]
    quaternion: RealArrayLike | None
    angular_velocity: RealArrayLike | None
    rotations: RealArrayLike | None
    quaternions: RealArrayLike | None
    angular_velocities: RealArrayLike | None
    scalar_first: bool
    step: RealArrayLike | None
    threshold: float
    nan_policy: Literal["omit", "raise"]


@overload
def check(  # type: ignore[overload-overlap]
    t: Sequence[NDArray[Any] | Sequence[float]], rotation: RealArrayLike | None = None, **how: Unpack[_Options]
) -> Convergence: ...
@overload
def check(t: RealArrayLike, rotation: RealArrayLike | None = None, **how: Unpack[_Options]) -> Check: ...
def check(
    t: RealArrayLike,
    rotation: RealArrayLike | None = None,
    *,
    motion: CheckedMotion,
    quaternion: RealArrayLike | None = None,
    angular_velocity: RealArrayLike | None = None,
    scalar_first: bool = False,
    step: RealArrayLike | None = None,
    threshold: float = 6.0,
    nan_policy: Literal["omit", "raise"] = "omit",
    **plural: RealArrayLike | None,
) -> Check | Convergence:
    """Errors and correct digits of a trajectory computed elsewhere, against a certified motion.

    Parameters
    ----------
    t : array_like, shape (N,), or list of such arrays
        Times. A list holds runs of one integrator with several steps; the data are then lists too.
    rotation : array_like, shape (N, 3, 3)
        Matrices R(t) from the body to the laboratory. At least one of rotation, quaternion and angular velocity is
        needed.
    motion : ElementaryMotion, FreeMotion, GeneralMotion, TopMotion or AsymmetricMotion
        One reference motion, also from `atlas.motion`.
    quaternion : array_like, shape (N, 4)
        Unit quaternions of either sign, scalar last as in `scipy.spatial.transform.Rotation.as_quat`.
    angular_velocity : array_like, shape (N, 3)
        Omega along the axes of the body, in rad/time.
    scalar_first : bool
        True if the scalar is the first component of a quaternion.
    step : float or list of float, optional
        Steps of the integrator; by default the mean differences of the times.
    threshold : float
        Number of correct digits below which a column fails, from the first such row on.
    nan_policy : {"omit", "raise"}
        Whether rows that hold NaN are left out, which `notes` of the result count, or raise an error.
    **plural
        `rotations`, `quaternions`, `angular_velocities`: other names of the data.

    Returns
    -------
    Check or Convergence
        Errors and digits by column; for several runs the order of convergence. Both have `str`, `record()` for JSON
        and `scene()` for a figure.

    Raises
    ------
    AtlasError
        For arrays of another shape, for an entry that is no number, for a motion of another class or several motions,
        for a threshold outside 0 to 17 or beyond the accuracy of the motion, and for runs without a common order.
    TypeError
        For a keyword that is no other name of the data.

    Notes
    -----
    For a motion of `atlas.motion`, errors below 4e-14 + 9e-16 f t, with the largest rate f, count as rounding.

    Examples
    --------
    >>> motion, t = atlas.ElementaryMotion(1.5, (1.0, 2.0), omega2=0.7), [0.0, 1.0]
    >>> atlas.check(t, motion.rotation(t), motion=motion).rows
    2
    """
    columns = {"rotation": rotation, "quaternion": quaternion, "angular_velocity": angular_velocity}
    columns = with_plurals("check", columns, plural)
    if isinstance(t, list | tuple) and t and np.ndim(t[0]):
        runs: dict[str, Any] = columns | {"step": step}
        for name, values in runs.items():
            if values is not None and (not hasattr(values, "__len__") or len(values) != len(t)):
                raise AtlasError(f"For {len(t)} runs {name} must be a list of {len(t)}, one for each.")
        run_arguments: list[dict[str, Any]] = [
            {name: None if x is None else x[i] for name, x in runs.items()} for i in range(len(t))
        ]
        settings = {"motion": motion, "scalar_first": scalar_first, "threshold": threshold, "nan_policy": nan_policy}
        return convergence([check(times, **(run | settings)) for times, run in zip(t, run_arguments, strict=True)])
    trajectory = of_arrays(t, columns, scalar_first=scalar_first, nan_policy=nan_policy)
    if step is not None:
        trajectory = replace(trajectory, parameters={"step": (float(real(step, "step")),)})
    return _graded(trajectory, threshold, _arguments(motion))


def _arguments(motion: Any) -> dict[str, Any]:
    """Return the parameters of a motion as keywords of `check_file`, a top's as inertia, direction, coupling and so on.

    A motion made by `atlas.motion` gives {"motion": motion}. Raises AtlasError for a motion of another class or made by
    another function, and for an array of motions.
    """
    from atlas import AsymmetricMotion, ElementaryMotion, FreeMotion, GeneralMotion, TopMotion

    classes = (ElementaryMotion, FreeMotion, GeneralMotion, TopMotion, AsymmetricMotion)
    if not isinstance(motion, classes) and getattr(motion, "made_by", "") != "motion":
        names = ", ".join(kind.__name__ for kind in classes)
        raise AtlasError(f"A trajectory is graded against one of {names}, not {type(motion).__name__}.")
    if motion.shape:
        raise AtlasError(f"A trajectory is graded against one motion, not against {motion.shape} of them.")
    if motion.made_by == "motion":
        return {"motion": motion}
    if isinstance(motion, TopMotion):
        return {name: getattr(motion, name) for name in ("inertia", *OF_TOPS, "omega")}
    if motion.made_by:
        raise AtlasError(
            f"A trajectory is graded against a motion of its class or of atlas.motion, not one by {motion.made_by}: "
            "atlas.motion(inertia, field, omega, attitude) is the same motion."
        )
    return dict[str, Any](motion.arguments, **({"field": (0.0, 0.0)} if isinstance(motion, FreeMotion) else {}))


def check_file(path: Path, *, threshold: float = 6.0, **parameters: Any) -> Check:
    """Return the `Check` of the trajectory in a CSV file, see `atlas.checking.trajectory`.

    `parameters` replace those in the file's # lines, by the same names: ratio (or a SymmetricBody) or inertia, field,
    omega or omega2 and omega3, and of a top direction, coupling, linear and quadratic; None stands for no value. With
    omega, all three components of the initial angular velocity, the reference is the general motion; with three moments
    of inertia the motion of any body; with a direction that of a top; with omega2 (and omega3 where free) an elementary
    motion.

    Three moments without omega, and the six elements of an inertia tensor, are of a body without a certified motion:
    only conserved quantities are reported, against the first row.

    A column fails from the first row on at which it has fewer than ``threshold`` correct digits, of the 17 that a
    double can have. The times and the parameters of the file are rounded to doubles.
    The file is read once, in blocks. Raises AtlasError for a file that is no trajectory, and for parameters that are
    missing, contradictory or of no motion.
    """
    with opened(path) as trajectory:
        return _graded(trajectory, threshold, parameters)


def _graded(trajectory: Trajectory, threshold: float, parameters: Mapping[str, Any]) -> Check:
    """Return the `Check` of a trajectory, which is read once; `threshold` is in correct digits.

    `parameters` replace those of the trajectory, by the names in `check_file`. Raises AtlasError for a threshold out of
    range, and where there is nothing to compare.
    """
    threshold = number(threshold, f"The threshold, from 0 to {MAX_DIGITS:g} correct digits,")
    if not 0 <= threshold <= MAX_DIGITS:
        raise AtlasError(f"The threshold counts correct digits, from 0 to {MAX_DIGITS:g}; it cannot be {threshold:g}.")
    target = reference(trajectory.parameters, parameters, trajectory.file)
    errors = Errors(target.motion, truth_of(target.motion, target.unit), target.unit) if target.motion else None
    graded = [name for name in trajectory.names if name != "t"] if errors else []
    if errors:
        _within(threshold, errors.floor)
    grades = [Grade(name, threshold, errors) for name in graded if errors]
    drifts, envelope, rows, conventions = Drifts(target.deviations), Envelope(), 0, list[str]()
    start, end, holes = 0.0, 0.0, 0
    for read in trajectory.blocks:
        block, hole_count = whole_rows(read)
        holes += hole_count
        if not block["t"].size:
            continue
        if errors:
            differences = errors.of_block(block)
            _within(threshold, errors.floor)
            for grade in grades:
                grade.add(block, differences[grade.name])
            envelope.add(block["t"], differences)
            if not rows and max(map(np.median, differences.values())) > 10.0**-threshold:
                conventions += conventions_that_fit(block, errors, 10.0**-threshold)
        drifts.add(block)
        start, end = (start if rows else float(block["t"][0])), float(block["t"][-1])
        rows += len(block["t"])
    notes = trajectory.left_out, holes_left_out(holes, rows, trajectory.file)
    if not errors and not any(drift.label == "theorem-clebsch" for drift in drifts.drifts()):
        raise AtlasError(
            f"{trajectory.file}: without an initial angular velocity only the integrals can be tested, and their "
            "columns are missing: give --omega, or a line such as '# omega = 0.3 0.7 0.2', or columns R11 to R33 (or a "
            "quaternion) and Omega1 to Omega3."
        )
    return Check(
        file=trajectory.file,
        case=target.case,
        parameters=target.parameters,
        frequencies=target.frequencies(),
        rows=rows,
        threshold=float(threshold),
        columns=tuple(replace(grade.column(), name=trajectory.names[grade.name]) for grade in grades),
        drifts=drifts.drifts(),
        rows_a_point=envelope.rows,
        times=tuple(envelope.times()),
        errors={group: tuple(values) for group, values in envelope.errors().items()},
        conventions=tuple(conventions),
        step=trajectory.parameters.get("step", (abs(end - start) / max(rows - 1, 1),))[0],
        end=end,
        notes=tuple(filter(None, notes)),
    )


def _within(threshold: float, floor: float) -> None:
    """Raise AtlasError if 10^-threshold is at most twice `floor`, the accuracy of the reference motion."""
    if 10.0**-threshold <= 2 * floor:
        raise AtlasError(
            f"The threshold may be {-math.log10(2 * floor) - 0.05:.1f} digits at most for this motion at these times, "
            f"which is evaluated within {floor:.1e}, not {threshold:g}."
        )
