"""Rotation matrices of many motions R = R_n(k t) R_z(phi t), (85), each at a few times: no motion is made alone.

The constants that `rotation` makes once for one motion, and evaluates as a matrix product, are here arrays over
motions: the axis, products of its components, both frequencies in two words. The entries are those of Rodrigues'
formula, 1 + sin x [n, .] + (1 - cos x)(n n^T - 1), times R_z. For phases up to 2^50 the frequencies have a bound on
their error.
"""

from collections.abc import Callable, Mapping, Sequence
from copy import copy
from dataclasses import dataclass
from functools import partial
from math import prod
from typing import Any

import numpy as np
from numpy.typing import NDArray

from atlas.arithmetic.double_double import DoubleDouble, blocks, over
from atlas.arithmetic.inputs import FloatArray
from atlas.arithmetic.numbers import Number, direction, workprec
from atlas.arithmetic.phase import MAX_PHASE, Phases, room
from atlas.arithmetic.words import TURN, exact, magnitude, middle, scaled, words
from atlas.errors import AtlasError, DomainError

with workprec():
    HEAD, TAIL = (np.float64(x) for x in words(2 / TURN, 2))
PER_RADIAN = DoubleDouble(HEAD, TAIL, 2.0**-105)
"""Half turns in a radian."""

MAX_EXPONENT = 1020
"""Power of two beyond which a frequency is none of several."""

MAX_LOST_PHASE = 2.0**-55
"""Half turns that a phase may lack by the error of its frequency: less than half an ulp of 1 in a matrix."""


@dataclass(frozen=True)
class Frequencies:
    """Frequencies in half turns per unit of time of m motions, n each.

    `words` (2, n, m) are P0 and P1, whose sum is the frequency; `errors` (n, m) bound its error. `exact(i)` returns
    the n frequencies of the i-th motion in rad/time, exact numbers.
    """

    words: FloatArray
    errors: FloatArray
    exact: Callable[[Any], Sequence[Number]]

    def at(self, index: Any, t: FloatArray) -> FloatArray:
        """Return the words (2, n, m) of the frequencies of motions ``index``, accurate enough for their times t (m,).

        They are computed anew from `exact` where `errors` times |t| exceeds MAX_LOST_PHASE. Raises AtlasError if a
        phase is beyond MAX_PHASE.
        """
        words = self.words[..., index].copy()
        with np.errstate(over="ignore", invalid="ignore"):
            doubtful = np.flatnonzero(~(self.errors[:, index] * abs(t) <= MAX_LOST_PHASE).all(axis=0))
            motions = np.arange(self.words.shape[2])[index]
            for i in doubtful.tolist():
                words[:, :, i] = np.transpose([_words(f) for f in self.exact(motions[i])])
            far_rows = np.flatnonzero((abs(words[0] * t) > MAX_PHASE / np.pi).any(axis=0))
        if far_rows.size:
            longest = MAX_PHASE / np.pi / abs(words[0][:, far_rows[0]]).max()
            raise AtlasError(
                f"A time is {t[far_rows[0]]}, but |t| may be {longest:.6g} at most, where a phase reaches "
                "2^50 and is lost."
            )
        return words


def _words(frequency: Number) -> list[float]:
    """Return an exact frequency in rad/time as two doubles whose sum is the frequency in half turns.

    Raises DomainError if it is too large for a float.
    """
    with workprec():
        halves = scaled(middle(frequency / TURN), 1)
    if halves != 0 and magnitude(halves) > MAX_EXPONENT:
        raise DomainError("A frequency of one of these motions is too large for a float: choose larger units.")
    return words(halves, 2)


def words_of(formula: Callable[..., Any], inputs: Sequence[Any], unit: slice) -> tuple[FloatArray, FloatArray]:
    """Return (`words`, `errors`) of `Frequencies`, (2, 2, m) and (2, m), for inputs that broadcast to m motions.

    ``formula`` returns two frequencies in rad/time; the inputs in the slice ``unit`` are themselves frequencies. Where
    inputs are out of range, `errors` is NaN.
    """
    shape = np.broadcast_shapes(*(np.shape(x) for x in inputs))
    words, errors = list[Any](), list[Any]()
    for rows, _, exponents, results in blocks(formula, inputs, shape, unit):
        turns = [frequency * PER_RADIAN for frequency in results]
        halves = np.array([[np.broadcast_to(x, rows.stop - rows.start) for x in (f.hi, f.low)] for f in turns])
        error = np.array([np.broadcast_to(f.rel * abs(f.hi), rows.stop - rows.start) for f in turns])
        if exponents is not None:
            halves, error = np.ldexp(halves, exponents[0]), np.ldexp(error, exponents[0])
            error[:, ~exponents[1]] = np.nan
        words.append(halves)
        errors.append(error)
    if not prod(shape):
        return np.empty((2, 2, 0)), np.empty((2, 0))
    return np.concatenate(words, axis=2).swapaxes(0, 1), np.concatenate(errors, axis=1)


MAX_FREQUENCY = 2.0**900
"""Frequencies between its inverse and itself: their products with times of phases up to MAX_PHASE keep their digits."""

Constants = Callable[..., tuple[Sequence[Any], Any, Any]]
"""A formula for a vector along n, in the plane (e2, e3) if it has two components, and for k and phi."""

Group = tuple[Constants, Any, Sequence[Any]]
"""A formula, the motions that it holds for (an index of them), and its inputs, which broadcast to these."""


class DoubleRotationRows:
    """Rotations R_n(k t) R_z(phi t), as `DoubleRotation`, of ``count`` motions, each evaluated at one time.

    `at(index, t)` pairs motions with their times; its result alone evaluates, and writes into the array ``out``.
    ``groups`` are triples (formula, indices of motions, inputs): formula(*inputs) returns (vector along n, k, phi),
    k and phi in rad/time, as are the inputs in the slice ``unit``. ``vectors()`` returns constant vectors by name,
    three components (count,) each. ``inverse`` transposes the matrices, (28).
    """

    def __init__(
        self,
        groups: Sequence[Group],
        count: int,
        unit: slice,
        vectors: Callable[[], Mapping[str, Sequence[FloatArray]]],
        *,
        inverse: bool = False,
    ) -> None:
        self.vectors, self.inverse, self.indices = vectors, inverse, np.arange(count)
        self.words = np.empty((2, 2, 0))
        self.axis, self.dyad, self.defect = np.zeros((3, 3, count))
        self.groups = np.empty(count, dtype=np.int8)
        words, errors = np.empty((2, 2, count)), np.empty((2, count))
        for number, (constants, index, inputs) in enumerate(groups):
            self.groups[index] = number
            planar = len(constants(*(DoubleDouble(np.float64(1)) for _ in inputs))[0]) == 2
            entries = over(partial(_axis, constants), *inputs, unit=unit, degree=(0,) * (5 if planar else 9))
            if planar:
                n2, n3, n23, square2, square3 = entries
                entries = [0.0, n2, n3, 0.0, 0.0, n23, 1.0, square3, square2]
            for row, entry in zip((*self.axis, *self.dyad, *self.defect), entries, strict=True):
                row[index] = np.ravel(entry)
            words[..., index], errors[:, index] = words_of(partial(_frequencies, constants), inputs, unit)
        # nothing here refers to itself: a long sweep's arrays are free as soon as they are not needed
        self.frequencies = Frequencies(words, errors, partial(_exact, groups, self.groups))

    def at(self, index: Any, t: FloatArray) -> "DoubleRotationRows":
        """Return a copy that holds the motions at ``index`` alone, paired with times t (m,).

        Raises AtlasError if a phase is beyond MAX_PHASE.
        """
        selection = copy(self)
        selection.indices, selection.words = self.indices[index], self.frequencies.at(index, t)
        selection.axis, selection.dyad, selection.defect = (x[:, index] for x in (self.axis, self.dyad, self.defect))
        return selection

    def vector(self, name: str) -> Sequence[Any]:
        """Return the three components, (m,) each, of the constant vector ``name`` of the selected motions.

        ``name`` is a key of `vectors`, such as "Omega".
        """
        return [x[self.indices] for x in self.vectors()[name]]

    @property
    def extreme(self) -> Any:
        """Indices of the selected motions with a frequency out of the range of MAX_FREQUENCY.

        These need the scalar path.
        """
        size = abs(self.words[0])
        return np.flatnonzero(~((size == 0) | ((size > 1 / MAX_FREQUENCY) & (size < MAX_FREQUENCY))).all(axis=0))

    def rotation(self, t: FloatArray, out: FloatArray) -> None:
        """Write R(t), (84), of the selected motions at one time each, t (m,), into ``out`` (m, 3, 3)."""
        for j, column in enumerate(self._columns(t)):
            for i, entry in enumerate(column):
                out[:, i, j] = entry

    def column(self, j: int, t: FloatArray, out: FloatArray) -> None:
        """Write the column R_j, ``j`` = 1, 2, 3, of each motion at its time t (m,) into ``out`` (m, 3)."""
        for i, entry in enumerate(self._columns(t)[j - 1]):
            out[:, i] = entry

    def quaternion(self, t: FloatArray, out: FloatArray) -> None:
        """Write the quaternions q_n(k t) q_z(phi t), (x, y, z, w), or their inverses, at t (m,) into ``out`` (m, 4)."""
        (c, s), (cos, sin) = (self._circle(i, t / 2)[:2] for i in range(2))
        x, y, z = self.axis * s
        q = np.array([x * cos + y * sin, y * cos - x * sin, z * cos + c * sin, c * cos - z * sin])
        q *= 1.5 - 0.5 * (q * q).sum(axis=0)
        if self.inverse:
            q[:3] *= -1
        out[:] = q.T

    def angular_velocity(self, t: FloatArray, out: FloatArray) -> None:
        """Write Omega(t) along the body's axes, in rad/time, at t (m,) into ``out`` (m, 3)."""
        (self.rotate if self.inverse else self.swung)(self.vector("Omega"), t, out)

    def rotate(self, vector: Any, t: FloatArray, out: FloatArray) -> None:
        """Write R_n(k t) v for constant vectors v (3, m), in their unit, at t (m,) into ``out`` (m, 3).

        Raises AtlasError if a result is not finite.
        """
        with np.errstate(over="ignore", invalid="ignore"):
            for i, row in enumerate(self._precession(*self._circle(0, t)[1:])):
                out[:, i] = row[0] * vector[0] + row[1] * vector[1] + row[2] * vector[2]
        if not np.isfinite(out).all():
            raise AtlasError("A vector that is to be turned is too large for a float: choose larger units.")

    def swung(self, vector: Any, t: FloatArray, out: FloatArray) -> None:
        """Write R_z(-phi t) v for constant vectors v (3, m), in their unit, at t (m,) into ``out`` (m, 3)."""
        (x, y, z), (cos, sin, _) = vector, self._circle(1, t)
        out[:, 0], out[:, 1], out[:, 2] = x * cos + y * sin, y * cos - x * sin, z

    def _columns(self, t: FloatArray) -> list[tuple[Any, Any, Any]]:
        """Return the three columns of R_n(k t) R_z(phi t), or of its transpose if `inverse`: components (m,) each.

        Each column is normalised by a step of Newton's iteration.
        """
        cos, sin, _ = self._circle(1, t)
        rows = [(x * cos + y * sin, y * cos - x * sin, z) for x, y, z in self._precession(*self._circle(0, t)[1:])]
        columns = rows if self.inverse else zip(*rows, strict=True)
        return [_unit(*column) for column in columns]

    def _precession(self, sin: FloatArray, versine: FloatArray) -> list[tuple[Any, Any, Any]]:
        """Return the three rows of R_n, the rotation about the axis, from sin and 1 - cos of its angle.

        Entries are (m,).
        """
        s1, s2, s3 = self.axis * sin
        v12, v13, v23 = self.dyad * versine
        d1, d2, d3 = 1.0 - self.defect * versine
        return [(d1, v12 - s3, v13 + s2), (v12 + s3, d2, v23 - s1), (v13 - s2, v23 + s1, d3)]

    def _circle(self, i: int, t: FloatArray) -> FloatArray:
        """Return cos, sin and 1 - cos of the phase k t (``i`` = 0) or phi t (``i`` = 1), (3, m)."""
        halves = np.empty((3, 1, t.size))
        Phases.of_words(self.words[:, i : i + 1]).circle(t, room(1, t.size), halves[0], halves[1], halves[2, 0])
        halves *= 2
        return halves[:, 0]


def _unit(x: FloatArray, y: FloatArray, z: FloatArray) -> tuple[Any, Any, Any]:
    """Return the three components of a vector, of length 1 up to rounding, normalised by one step of Newton."""
    factor = 1.5 - 0.5 * (x * x + y * y + z * z)
    return x * factor, y * factor, z * factor


def _axis(constants: Constants, *inputs: Any) -> Sequence[Any]:
    """Return the nine numbers n, n_i n_j for i < j and 1 - n_i^2 of the unit vector n along the formula's vector.

    ``constants`` is the formula, ``inputs`` its inputs. Where n is in the plane (e2, e3) the numbers are five: n2, n3,
    n2 n3, n2^2 and n3^2.
    """
    n = direction(constants(*inputs)[0])
    squares = [x * x for x in n]
    if len(n) == 2:
        return *n, n[0] * n[1], *squares
    (x, y, z), (xx, yy, zz) = n, squares
    return x, y, z, x * y, x * z, y * z, yy + zz, xx + zz, xx + yy


def _frequencies(constants: Constants, *inputs: Any) -> Sequence[Any]:
    """Return the frequencies (k, phi) in rad/time, numbers of the kind of ``inputs``, by the formula ``constants``."""
    return constants(*inputs)[1:]


def _exact(groups: Sequence[Group], places: NDArray[np.int8], i: int) -> Sequence[Number]:
    """Return (k, phi) of motion number ``i`` in rad/time, as exact as the formula of its group gives them.

    ``groups`` are those of `DoubleRotationRows`, ``places`` has the number of each motion's group.
    """
    constants, index, inputs = groups[places[i]]
    place = i if isinstance(index, slice) else np.searchsorted(index, i)
    shape = np.broadcast_shapes(*(np.shape(x) for x in inputs))
    with workprec():
        return _frequencies(constants, *exact(*(np.broadcast_to(x, shape).flat[place] for x in inputs)))
