"""Measured data of a motion: differences from a motion, and their derivatives.

A small change of a parameter turns R by a vector v of the laboratory, dR/dp = [v]x R, see `Motion.sensitivity`; here
are the resulting derivatives of each kind of data.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from atlas.arithmetic.inputs import FloatArray, number, real
from atlas.checking.headings import FIELD, MATRIX, OMEGA, PLAIN, QUATERNION
from atlas.checking.trajectory import BLOCK, holes_left_out, measured, opened
from atlas.errors import AtlasError

KINDS: Mapping[str, tuple[int, ...]] = {
    "rotation": (3, 3), "quaternion": (4,), "axis": (3,), "angular_velocity": (3,), "field_in_body": (3,),
}  # fmt: skip
"""Shape of a datum at one time, by kind of data; a "signal" is any function of R."""

AXIS = ("R13", "R23", "R33")

FAR = 100
"""Largest distance of the data from t = 0, where the parameters hold, in spans of the data."""

LEAST = 5
"""Least number of times for a fit."""

STEP = 1e-6
"""Step of differences, in the natural unit of the varied quantity."""

SERIES = 1e-3
"""Angle in rad below which a coefficient of a Jacobian is that of angle zero: its error is rounding."""

NO_ROTATION = 1.1
"""Magnitude of an entry above which a matrix is no rotation: the integration lost the motion."""

NEARLY_OPPOSITE = -0.99999
"""Cosine of an angle below which the axis of a rotation is taken from its symmetric part, not its skew part."""

MAX_BLOCKS = 1200
"""Largest number of blocks of rows that are read: ten million rows."""
NEAR = 0.5
"""Largest distance of singular values of a measured matrix, or of a vector's length, from 1."""


@dataclass(frozen=True)
class Entries:
    """Signal of the entries R[rows[i], columns[i]], counted from 0.

    A class, not a function, so that a fit of a file can be pickled.
    """

    rows: tuple[int, ...]
    columns: tuple[int, ...]

    def __call__(self, R: FloatArray) -> FloatArray:
        """Return the k entries, shape (N, k), of rotations R (N, 3, 3)."""
        return R[:, self.rows, self.columns]


@dataclass(frozen=True)
class Data:
    """Data `values` (N, ...) of one `kind` at times `t` (N,), ascending, with standard errors `sigma` (N, 1).

    `kind` is a key of `KINDS`, but never "quaternion", or "signal", of which `function` maps rotations (M, 3, 3) to
    values (M,) or (M, k). Standard errors of rotations and axes are in rad, else in the unit of the values; `known`
    tells whether they were given. `notes` are sentences on rows and columns that were left out.
    """

    kind: str
    t: FloatArray
    values: FloatArray
    sigma: FloatArray
    function: Callable[[FloatArray], Any] | None = None
    known: bool = True
    """Whether the standard errors were given."""
    notes: tuple[str, ...] = ()
    """Sentences on rows and columns that were left out."""

    def subset(self, places: Any) -> "Data":
        """Return the `Data` at these times: `places` is an index array or a slice."""
        return replace(self, t=self.t[places], values=self.values[places], sigma=self.sigma[places])

    @property
    def spread(self) -> float:
        """Scale of variation: 1 for rotations and axes, else the largest standard deviation of a component.

        It is 1 also for data that do not vary.
        """
        return 1.0 if self.kind in ("rotation", "axis") else float(self.values.std(0).max()) or 1.0

    def of(self, motion: Any, t: FloatArray) -> FloatArray:
        """Return the noise-free data of a motion at times t (N,), shape (N, ...); for an axis all of R, (N, 3, 3).

        Of a `Flow` of S motions the shape is (S, N, ...). Raises AtlasError for a function of a signal that returns
        another count of numbers than of rotations.
        """
        if self.kind == "angular_velocity":
            return np.asarray(motion.angular_velocity(t))
        if self.kind == "field_in_body":
            return np.asarray(motion.field_in_body(t))
        R = motion.rotation(t)
        return self._signal(R) if self.kind == "signal" else R

    def _signal(self, R: FloatArray) -> FloatArray:
        function: Any = self.function
        flat = R.reshape(-1, 3, 3)
        is_lost = np.asarray(~(abs(flat) < NO_ROTATION).all((1, 2)))
        values = real(
            function(np.where(is_lost[:, None, None], np.eye(3), flat)), "What the function of a signal returns"
        )
        if values.shape[:1] != flat.shape[:1] or values.ndim > 2:
            raise AtlasError(
                f"The function of a signal takes rotations ({len(flat)}, 3, 3) and returns as many numbers, "
                f"not an array {values.shape}."
            )
        values = np.where(is_lost.reshape(-1, *[1] * (values.ndim - 1)), np.nan, values)
        return values.reshape(*R.shape[:-2], -1)

    def differences(self, motion: Any) -> FloatArray:
        """Return data minus motion at the times of the data, shape (N, k).

        For rotations these are the rotation vectors, along the axes of the laboratory, that turn the motion's
        attitude into the measured one, in rad; for axes the components along the body's first and second axis of
        the arc from the motion's axis to the measured one, in rad; for other kinds the components of the
        difference. Of a `Flow` of S motions the shape is (S, N, k).
        """
        values = self.of(motion, self.t)
        if self.kind == "rotation":
            return difference(self.values, values)
        if self.kind == "axis":
            x, y, z = np.moveaxis(np.vecmat(self.values, values), -1, 0)
            sine = np.hypot(x, y)
            angle = np.arctan2(sine, z) / np.where(sine > 0, sine, 1.0)
            return np.stack([x * angle, y * angle], -1)
        return np.asarray(self.values - values)

    def slopes(
        self, motion: Any, v: FloatArray, field: FloatArray, fields: FloatArray, differences: FloatArray
    ) -> FloatArray:
        """Return the derivatives of the measured quantity in P parameters, shape (N, k, P).

        They are minus the derivatives of what the method `differences` returns, and in its coordinates. `v` (N, P,
        3) has dR/dp = [v]x R; for angular velocities dv/dt is given instead. `fields` (P, 3) are the derivatives of
        the `field` (3,) in the laboratory. The argument `differences` (N, 3), from the method of this name, is used
        for rotations only.
        """
        if self.kind == "rotation":
            # log(D exp(-[v]x)) is log(D) minus the inverse of the transposed Jacobian times v
            return np.asarray(np.linalg.solve(left_jacobian(differences).swapaxes(1, 2), v.swapaxes(1, 2)))
        R = motion.rotation(self.t)
        turns_in_body = v @ R
        """The turns about the axes of the body, (N, P, 3)."""
        if self.kind == "axis":
            return np.stack([turns_in_body[..., 1], -turns_in_body[..., 0]], 1)
        if self.kind == "angular_velocity":
            return np.asarray(turns_in_body.swapaxes(1, 2))
        if self.kind == "field_in_body":
            return np.asarray(((fields - np.cross(v, field)) @ R).swapaxes(1, 2))
        h = STEP
        by = [
            (
                self._signal(Rotation.from_rotvec(h * e).as_matrix() @ R)
                - self._signal(Rotation.from_rotvec(-h * e).as_matrix() @ R)
            )
            / (2 * h)
            for e in np.eye(3)
        ]
        return np.asarray(np.einsum("ink,npi->nkp", np.stack(by), v))


def difference(rotations: FloatArray, origins: FloatArray) -> FloatArray:
    """Return the rotation vectors (..., 3), in rad, that turn `origins` into `rotations`, both (..., 3, 3).

    They are along the axes of the laboratory, of angles up to pi.
    """
    turn = rotations @ origins.swapaxes(-1, -2)
    skew = np.stack([turn[..., i, j] - turn[..., j, i] for i, j in ((2, 1), (0, 2), (1, 0))], -1) / 2
    sine, cosine = np.linalg.norm(skew, axis=-1), (np.trace(turn, axis1=-2, axis2=-1) - 1) / 2
    vectors = skew * (np.arctan2(sine, cosine) / np.where(sine > 0, sine, 1.0))[..., None]
    for place in np.argwhere(cosine < NEARLY_OPPOSITE):  # the axis is the largest column of the symmetric part
        i = tuple(place)
        twice = (turn[i] + turn[i].T) / 2 - cosine[i] * np.eye(3)
        axis = twice[np.argmax(np.diag(twice))]
        size = np.copysign(np.linalg.norm(axis), axis @ skew[i])
        vectors[i] = axis / size * np.arctan2(sine[i], cosine[i])
    return np.asarray(vectors)


def left_jacobian(a: FloatArray) -> FloatArray:
    """Return the matrices J (..., 3, 3) with R(a + da) = (1 + [J da]x) R(a), for rotation vectors a (..., 3) in rad."""
    angle = np.linalg.norm(a, axis=-1)[..., None, None]
    hat = np.cross(np.eye(3), a[..., None, :])
    is_small = angle < SERIES
    cubic = np.where(is_small, 1 / 6, (1 - np.sinc(angle / np.pi)) / np.where(is_small, 1.0, angle) ** 2)
    return np.asarray(np.eye(3) + np.sinc(angle / (2 * np.pi)) ** 2 / 2 * hat + cubic * (hat @ hat))


def of_arrays(
    t: Any, data: Mapping[str, Any], sigma: Any, epoch: float, *, scalar_first: bool, nan_policy: str = "omit"
) -> Data:
    """Return the `Data` of the one array in `data`, by kind, that is not None, sorted by time, with t = 0 at `epoch`.

    `t` (N,) are the times, `sigma` standard errors, a number or (N,), None for unknown ones, which become 1.
    Quaternions, scalar first or last, become rotation matrices of the kind "rotation". Times with NaN are left out or
    refused by `nan_policy`. Raises AtlasError for no array or several, a wrong shape, fewer than `LEAST` times, equal
    times, and where the whole of the data is farther from `epoch` than `FAR` times the span of the times.
    """
    kinds = [name for name, x in data.items() if x is not None]
    if len(kinds) != 1:
        raise AtlasError(f"The data must be exactly one of {', '.join(data)}, not {' and '.join(kinds) or 'none'}.")
    kind, times = kinds[0], measured(t, "t", nan_policy)
    if times.ndim != 1 or times.size < LEAST:
        raise AtlasError(f"The times have the shape {times.shape}: a fit needs {LEAST} times or more, (N,).")
    values, function = _values(kind, data[kind], times, nan_policy)
    is_known = sigma is not None
    errors = measured(1.0 if sigma is None else sigma, "sigma", nan_policy)
    if errors.shape not in ((), times.shape) or (errors <= 0).any():
        raise AtlasError(f"sigma is one positive standard error, or {times.size} of them, not {sigma!r}.")
    errors = np.broadcast_to(errors, times.shape)
    rows = np.flatnonzero(np.isfinite(np.column_stack([times, values.reshape(times.size, -1), errors])).all(-1))
    note = holes_left_out(times.size - rows.size, rows.size, "The data")
    times, errors, values = times[rows], errors[rows], _unit(kind, values[rows], scalar_first, rows)
    if times.size < LEAST:
        raise AtlasError(f"Only {times.size} times have all their numbers: a fit needs {LEAST} times or more.")
    order = np.argsort(times, kind="stable")
    times = times[order] - number(epoch, "epoch")
    span = times[-1] - times[0]
    if span <= 0:
        raise AtlasError("All times are equal: a fit needs times that differ.")
    if min(abs(times)) > FAR * span and not times[0] <= 0 <= times[-1]:
        raise AtlasError(
            f"The data begin {abs(times).min():.3g} from t = 0, where the parameters hold, and span {span:.3g} only: "
            "give epoch = t[0] (--epoch), the time at which the parameters hold, or subtract it from t."
        )
    kind = kind.replace("quaternion", "rotation")
    return Data(kind, times, values[order], errors[order, None], function, is_known, tuple(filter(None, [note])))


def _values(kind: str, value: Any, times: FloatArray, nan_policy: str) -> tuple[FloatArray, Any]:
    """Return (values (N, ...), function of a signal or None) of the measured ``value`` of a ``kind``.

    Values of a signal get the shape (N, k). Raises AtlasError for another shape than N ``times`` ask for, and for a
    signal that is no pair (values, function).
    """
    if kind != "signal":
        values, shape = measured(value, f"The {kind}", nan_policy), (times.size, *KINDS[kind])
        if values.shape != shape:
            raise AtlasError(f"The {kind} at {times.size} times is an array {shape}, not {values.shape}.")
        return values, None
    if not (isinstance(value, tuple) and len(value) == 2 and callable(value[1])):
        raise AtlasError(
            "The signal must be a pair (values, function): (N,) numbers, and the function that maps "
            "rotations (N, 3, 3) to them."
        )
    values = measured(value[0], "The signal", nan_policy)
    if values.shape[:1] != times.shape or values.ndim > 2:
        raise AtlasError(f"The signal at {times.size} times is an array ({times.size},), not {values.shape}.")
    return values.reshape(times.size, -1), value[1]


def _unit(kind: str, values: FloatArray, scalar_first: bool, rows: NDArray[np.int_]) -> FloatArray:
    """Return the data of a kind made exact: rotation matrices (N, 3, 3), axes of length 1; other kinds unchanged.

    Matrices become the nearest rotations, quaternions (scalar first if `scalar_first`) rotation matrices. `rows`
    (N,) are the numbers of the data's rows, for the error. Raises AtlasError for a matrix or a length farther than
    `NEAR` from a rotation or from 1.
    """
    if kind == "rotation":
        U, size, V = np.linalg.svd(values)
        bad = (abs(size - 1) > NEAR).any(-1) | (np.linalg.det(values) <= 0)
        values = U @ V
    elif kind in ("quaternion", "axis"):
        length = np.linalg.norm(values, axis=-1)
        bad = abs(length - 1) > NEAR
        values = values / np.where(bad, 1.0, length)[:, None]
        if kind == "quaternion":
            values = Rotation.from_quat(np.where(bad[:, None], 1.0, values), scalar_first=scalar_first).as_matrix()
    else:
        return values
    if bad.any():
        noun = {"rotation": "rotation matrix", "quaternion": "quaternion of length 1", "axis": "vector of length 1"}
        raise AtlasError(
            f"Row {int(rows[np.argmax(bad)])} (from 0) of the {kind} differs from a {noun[kind]} by more than {NEAR}: "
            "correct it or leave it out."
        )
    return values


@dataclass(frozen=True)
class Table:
    """Columns of a file: times (N,), data as keyword arguments of `fit`, `sigma` (a number, an array (N,) or None).

    `unit` is that of the times, "s" or "time"; `left_out` is a sentence on unused columns, or "".
    """

    t: FloatArray
    data: dict[str, Any]
    sigma: Any
    unit: str
    left_out: str


def of_file(path: Path, kind: str | None) -> Table:
    """Return the `Table` of the columns of a CSV file that a fit uses, see `atlas.checking.trajectory`.

    The kind of data is the first whose columns are complete, of rotations, quaternions, the axis R13, R23, R33, Omega
    and K, else the entries of R as a signal; or the given `kind`. Raises AtlasError for a file without such columns,
    and for one of more than ten million rows.
    """
    with opened(path, fields=True) as file:
        blocks = [*islice(file.blocks, MAX_BLOCKS)]
        if next(file.blocks, None) is not None:
            raise AtlasError(f"{file.file} has more than {MAX_BLOCKS * BLOCK} rows: fit a part of them.")
        names = list(file.names)
        sigma_written = file.parameters.get("sigma")
    x = {name: np.concatenate([block[name] for block in blocks]) for name in names}
    columns = {
        "rotation": MATRIX,
        "quaternion": QUATERNION,
        "axis": AXIS,
        "angular_velocity": OMEGA,
        "field_in_body": FIELD,
    }
    kinds = [name for name, required in columns.items() if set(required) <= set(names)]
    entries = [name for name in names if name in MATRIX]
    kinds += ["signal"] if entries and (kind == "signal" or not kinds) else []
    if not kinds or (kind is not None and kind not in kinds):
        raise AtlasError(
            f"{file.file} has no columns of {(kind or 'a kind of data').replace('_', ' ')}: there are "
            f"{', '.join(file.names.values())}. A fit takes R11 to R33, or only R13, R23, R33 of the axis, a "
            "quaternion, Omega1 to Omega3, or K1 to K3."
        )
    kind = kind or kinds[0]
    fitted_columns = entries if kind == "signal" else columns[kind]
    unused = [unused_kind.replace("_", " ") for unused_kind in kinds if unused_kind not in (kind, "axis")]
    left_out = [file.left_out] * bool(file.left_out) + [f"not fitted: {', '.join(unused)} (--of fits them)"] * bool(
        unused
    )
    data: dict[str, Any] = {
        kind: np.column_stack([x[name] for name in fitted_columns]),
        "scalar_first": kind == "quaternion",
    }
    if kind == "rotation":
        data[kind] = data[kind].reshape(-1, 3, 3)
    elif kind == "signal":
        rows, columns_of_R = zip(*((int(name[1]) - 1, int(name[2]) - 1) for name in entries), strict=True)
        data[kind] = data[kind], Entries(rows, columns_of_R)
    unit = "time" if (file.units or {}).get("t", "") in PLAIN else "s"
    return Table(x["t"], data, x.get("sigma", sigma_written and sigma_written[0]), unit, "; ".join(left_out))
