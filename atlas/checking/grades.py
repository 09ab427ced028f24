"""Errors of a trajectory's columns against the true motion, and their summary, block by block."""

import math
from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from flint import arb

from atlas.arithmetic.certified_digits import numbers
from atlas.arithmetic.certified_inputs import Real
from atlas.arithmetic.inputs import FloatArray
from atlas.arithmetic.numbers import workprec
from atlas.arithmetic.quaternions import of_matrix
from atlas.checking.headings import MATRIX, OMEGA, QUATERNION
from atlas.checking.truth import KernelTruth, Long, Truth, long
from atlas.motions.nutation.certified_cayley_klein import quaternion

Block = Mapping[str, FloatArray]

MAX_DIGITS = 17.0
"""Largest number of correct digits counted: no double has more."""

LEAST, LARGEST = 10.0**-MAX_DIGITS, float(np.finfo(float).max)
BITS = 80
GROUPS: Mapping[str, tuple[str, ...]] = {"R": MATRIX, "Omega": OMEGA, "quaternion": QUATERNION}

LINES = {"R": ("main", "$R$"), "Omega": ("second", r"$\boldsymbol{\Omega}$"), "quaternion": ("fourth", "quaternion")}
"""How each group is drawn."""

POINTS = 2048
"""Half of the largest number of points that an `Envelope` keeps."""


@dataclass(frozen=True)
class Column:
    """Grade of one column: median and least number of correct digits, time of the least, time of the first failure.

    Digits are -log10 of the error; of an entry of R or of a quaternion in units of 1, of Omega in units of its
    length at t = 0, or for bodies with three moments and tops in units of a largest rate, see `Reference.unit`. The
    median is rounded to a thousandth; the worst digits, and whether a row fails, are decided by balls. Of a body
    with three moments errors below the bound on those of its closed form count as that bound. `fails_at` is the
    time of the first row below the threshold, None for a column without one.
    """

    name: str
    median: float
    worst: float
    worst_time: float
    fails_at: float | None


class Errors:
    """Errors of a trajectory's columns against the true motion; those of Omega are divided by `unit` in rad/time.

    Made from the certified `motion` and its fast evaluation `truth`. Whole blocks are compared to within
    `uncertainty`, a single row by balls; errors below `floor` count as `floor`.
    """

    def __init__(self, motion: Any, truth: Truth | KernelTruth, unit: Real) -> None:
        self._motion, self._truth, self._unit = motion, truth, unit
        self._length = long(unit)
        self.uncertainty, self.floor = truth.uncertainty, truth.floor

    def of_block(self, block: Block) -> dict[str, FloatArray]:
        """Return the magnitudes of the errors, an array (m,) by name of column, of a block of columns (m,) by name.

        A quaternion is compared with the true one of the nearer sign. Small errors, and times out of reach of the fast
        evaluation, are computed by balls; "t" itself has no entry.
        """
        t = block["t"]
        rows = self._truth.within(t)
        R, Omega, q = self._truth.values(np.where(rows, t, 0.0))
        if QUATERNION[0] in block:
            products = sum(block[name] * q[:, i] for i, name in enumerate(QUATERNION))
            q = np.where(np.asarray(products)[:, None] < 0, -q, q)
        true: dict[str, Long] = {}
        for names, values in zip(GROUPS.values(), (R, Omega, q), strict=True):
            true |= dict(zip(names, values.T, strict=True))
        differences = {
            name: self._difference(name, values, true[name]) for name, values in block.items() if name != "t"
        }
        differences = {name: np.maximum(errors, self._truth.floor) for name, errors in differences.items()}
        least = np.min(list(differences.values()), axis=0)
        for i in np.flatnonzero(~rows | (least < self._truth.ball_threshold)):
            for name, error in self.certified(block, int(i)).items():
                differences[name][i] = error
        return differences

    def true(self, t: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return R (m, 3, 3) and Omega (m, 3) in the body, in rad/time, at a few times (m,).

        They are from balls where the fast evaluation does not reach.
        """
        rows = self._truth.within(t)
        R, Omega, _ = self._truth.values(np.where(rows, t, 0.0)) if rows.any() else np.zeros((3, t.size, 9))
        R, Omega = R.reshape(-1, 3, 3).astype(np.float64), Omega[:, :3].astype(np.float64)
        for i in np.flatnonzero(~rows):
            R[i] = [[float(arb(x)) for x in row] for row in _precise(partial(self._motion.rotation, float(t[i])))]
            Omega[i] = [float(arb(x)) for x in _precise(partial(self._motion.angular_velocity, float(t[i])))]
        return R, Omega

    def _difference(self, name: str, values: FloatArray, true: Long) -> FloatArray:
        unit = self._length if name in OMEGA else np.longdouble(1)
        return np.asarray(np.minimum(np.abs(values - true) / unit, LARGEST), dtype=np.float64)

    def certified(self, block: Block, i: int) -> dict[str, float]:
        """Return proven upper bounds on the errors of row i of a block of columns (m,), by name of the column.

        They exceed the errors by 2^-80 at most; those of Omega are over the unit. For a motion in given axes, which
        has no balls, they are errors in doubles.
        """
        if not self._truth.in_balls:
            return {
                name: float(x[0])
                for name, x in self.of_block({name: x[i : i + 1] for name, x in block.items()}).items()
            }
        row = {name: float(values[i]) for name, values in block.items() if name != "t"}
        t, motion, truth = float(block["t"][i]), self._motion, dict[str, Real]()
        with workprec(BITS + 16):
            if any(name in row for name in MATRIX):
                R = _precise(partial(motion.rotation, t))
                truth |= dict(zip(MATRIX, (x for line in R for x in line), strict=True))
            if any(name in row for name in OMEGA):
                truth |= dict(zip(OMEGA, _precise(partial(motion.angular_velocity, t)), strict=True))
            if QUATERNION[0] in row:
                quaternion: list[Real] = _precise(partial(_quaternion, motion, t))
                product = sum((arb(row[n]) * x for n, x in zip(QUATERNION, quaternion, strict=True)), arb(0))
                truth |= dict(zip(QUATERNION, quaternion if product >= 0 else [-x for x in quaternion], strict=True))
            units = {name: arb(self._unit) if name in OMEGA else arb(1) for name in row}
            bounds = {name: (abs(arb(x) - truth[name]) / units[name]).upper() for name, x in row.items()}
        return {name: min(float(bound), LARGEST) for name, bound in bounds.items()}


class Grade:
    """Summary of the errors of the column `name`: rows counted by thousandths of a digit, worst row, first failure.

    `threshold` is the number of correct digits below which a row fails; `errors` decides close cases by balls.
    """

    def __init__(self, name: str, threshold: float, errors: Errors) -> None:
        self.name, self._errors, self._limit = name, errors, 10.0**-threshold
        self._thousandths: Counter[int] = Counter()
        self._largest_error, self._largest_row = 0.0, dict[str, FloatArray]()
        self._fails_at: float | None = None

    def add(self, block: Block, errors: FloatArray) -> None:
        """Take one more block of columns (m,) by name, and the errors (m,) of this column in it."""
        t, counted = block["t"], np.maximum(errors, LEAST)
        values, counts = np.unique(np.rint(-1000 * np.log10(counted)).astype(int), return_counts=True)
        self._thousandths.update(dict(zip(values.tolist(), counts.tolist(), strict=True)))
        i = int(np.argmax(counted))
        if counted[i] > self._largest_error:
            self._largest_error = float(counted[i])
            self._largest_row = {name: values[[i]] for name, values in block.items()}
        if self._fails_at is None:
            uncertain = self._errors.uncertainty
            for j in np.flatnonzero(errors > self._limit - uncertain).tolist():
                if errors[j] > self._limit + uncertain or self._errors.certified(block, j)[self.name] > self._limit:
                    self._fails_at = float(t[j])
                    break

    def column(self) -> Column:
        """Return the `Column` that grades all rows so far, of which there must be one."""
        values = np.array(sorted(self._thousandths))
        upto = np.cumsum([self._thousandths[value] for value in values.tolist()])
        middle = values[np.searchsorted(upto, [(upto[-1] - 1) // 2, upto[-1] // 2], side="right")]
        is_certain = self._largest_error > self._errors.floor
        largest_error = self._errors.certified(self._largest_row, 0)[self.name] if is_certain else self._errors.floor
        time = float(self._largest_row["t"][0])
        return Column(
            self.name, float(middle.mean()) / 1000, -math.log10(max(largest_error, LEAST)), time, self._fails_at
        )


class Envelope:
    """Largest error of each group of columns over `rows` consecutive rows, so many that at most 2 POINTS values remain.

    The groups are R, Omega and quaternion.
    """

    def __init__(self) -> None:
        self.rows = 1
        self._points_kept = self._waiting = np.empty((0, 0))
        self._groups: list[str] = []

    def add(self, t: FloatArray, errors: Mapping[str, FloatArray]) -> None:
        """Take times (m,) and errors (m,) by column of one more block.

        Where over `2 POINTS` points would be kept, the number of rows in a point doubles.
        """
        groups = {g: [errors[name] for name in names if name in errors] for g, names in GROUPS.items()}
        self._groups = [group for group, values in groups.items() if values]
        new = np.column_stack([t, *(np.max(groups[group], axis=0) for group in self._groups)])
        self._waiting = np.concatenate([self._waiting, new]) if self._waiting.size else new
        self._points_kept = self._points_kept if self._points_kept.size else new[:0]
        while len(self._waiting) >= self.rows:
            count = min(2 * POINTS - len(self._points_kept), len(self._waiting) // self.rows)
            row_count = count * self.rows
            self._points_kept = np.concatenate([self._points_kept, _largest(self._waiting[:row_count], self.rows)])
            self._waiting = self._waiting[row_count:]
            if len(self._points_kept) == 2 * POINTS:
                self._points_kept, self.rows = _largest(self._points_kept, 2), 2 * self.rows

    def times(self) -> list[float]:
        """Return the first time of each set of consecutive rows; [] where nothing is graded."""
        return list(map(float, self._points()[:, 0])) if self._groups else []

    def errors(self) -> dict[str, list[float]]:
        """Return, by group ("R", "Omega", "quaternion"), the largest errors in each set of consecutive rows.

        {} where nothing is graded.
        """
        return dict(zip(self._groups, self._points()[:, 1:].T.tolist(), strict=True)) if self._groups else {}

    def _points(self) -> FloatArray:
        count = len(self._waiting)
        return np.concatenate([self._points_kept, _largest(self._waiting, count)]) if count else self._points_kept


def _quaternion(motion: Any, t: float) -> list[Real]:
    """Return a unit quaternion of R(t) as four balls, scalar first; from the matrix for motions without one."""
    if hasattr(motion, "quaternion"):
        numbers: list[Real] = motion.quaternion(t)
        return numbers
    R = motion.rotation(t)
    x, y, z, w = quaternion(R, of_matrix([[float(arb(x)) for x in row] for row in R]).tolist())
    return [w, x, y, z]


def _precise(function: Callable[[], Any]) -> Any:
    """Return the result of `function`, nested lists of balls, with radii below 2^-BITS of the largest ball.

    The function is called at growing precision until then.
    """
    precision = 2 * BITS
    while True:
        with workprec(precision):
            value = function()
            balls = [arb(x) for x in numbers(value)]
        size = max((float(abs(x).mid()) for x in balls if x.is_finite()), default=0.0)
        if all(x.is_finite() and float(x.rad()) <= size * 2.0**-BITS for x in balls):
            return value
        precision *= 2


def _largest(rows: FloatArray, count: int) -> FloatArray:
    """Return rows (time, errors...) with the first time and the largest errors of each `count` consecutive rows.

    `rows` are (count n, columns), the result is (n, columns).
    """
    blocks = rows.reshape(-1, count, rows.shape[1])
    return np.column_stack([blocks[:, 0, 0], blocks[:, :, 1:].max(axis=1)])
