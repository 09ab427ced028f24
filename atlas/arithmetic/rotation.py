"""Two turns in a row, R = R_n(k t) R_z(phi t), (85): the matrix of every motion in elementary functions.

It is linear in a few functions of time. By Rodrigues R_n(x) = n n^T + cos x (1 - n n^T) + sin x [n, .], and
R_z(x) = cos x E + sin x J + e3 e3^T. So

    R(s + tau) = R_n(k s) R(tau) R_z(phi s) = sum over r of F_r(s) (L_r R(tau) Q_r),

F_r being products of functions of k s and phi s. With tau = 0 that gives R(s) itself.
"""

import reprlib
from collections.abc import Callable, Mapping
from math import prod
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from atlas.arithmetic.inputs import FloatArray, real
from atlas.arithmetic.lazy import cached_property
from atlas.arithmetic.machine import keep, shared
from atlas.arithmetic.numbers import Number, nearest, workprec
from atlas.arithmetic.phase import QUANTUM, Phases, room
from atlas.arithmetic.words import TURN, words
from atlas.errors import AtlasError

Axis = tuple[Number, Number, Number]
"""A unit vector of exact numbers."""

IDENTITY = np.eye(3)
E, J, E33 = np.diag([1.0, 1, 0]), np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 0]]), np.diag([0.0, 0, 1])

SCALE = np.array([2.0, 2, 2, 2, 2, 4, 4, 4, 4, 4, 4])
"""Factors of the functions of a basis, which come as halves and as products of halves."""


class Basis:
    """Workspace for the functions F_r at up to `size` times: of two phases, or cos, sin and 1 - cos of one.

    `count` is the number of functions, 3, 9 or 11. In the order of `resolution`: cos kt, cos phi t, sin kt, sin phi t,
    1 - cos kt; cos kt and sin kt times cos phi t, the same times sin phi t; and, if there are 11, 1 - cos kt times
    cos phi t and sin phi t. `phases` are `Phases` or a `Progression` of them.
    """

    def __init__(self, phases: Any, size: int, count: int = 3) -> None:
        self.phases = phases
        self.work = room(1 if count == 3 else 2, size)
        self.rows = np.empty((count, size))

    def at(self, t: FloatArray) -> FloatArray:
        """Return the functions divided by SCALE, shape (count, m), at times t (m,), or indices of a `Progression`.

        Valid until the next call.
        """
        rows, work = self.rows, self.work
        if t.shape[-1] < rows.shape[1]:
            rows, work = rows[:, : t.shape[-1]], work[:, :, : t.shape[-1]]
        if len(rows) == 3:
            self.phases.circle(t, work, rows[0:1], rows[1:2], rows[2])
            return rows
        self.phases.circle(t, work, rows[0:2], rows[2:4], rows[4])
        multiply(rows)
        return rows


def multiply(rows: NDArray[Any]) -> None:
    """Fill rows 5 to 8, or to 10, of the functions of `Basis`, (9 or 11, m), with products of rows 0 to 4, in place."""
    precession, proper = rows[0:4:2], rows[1:4:2]
    np.multiply(precession, proper[:, None], out=rows[5:9].reshape(2, 2, -1))
    if len(rows) == 11:
        np.multiply(rows[4], proper, out=rows[9:])


def rodrigues(axis: Axis) -> FloatArray:
    """Return the matrices 1, [n, .] and n n^T of a unit vector n = ``axis``, (3, 3, 3), each element rounded once.

    [n, .] is the matrix of the vector product with n.
    """
    n1, n2, n3 = map(nearest, axis)
    with workprec():
        dyad = [[nearest(a * b) for b in axis] for a in axis]
    return np.array([IDENTITY, [[0, -n3, n2], [n3, 0, -n1], [-n2, n1, 0]], dyad])


def generators(axis: Axis) -> FloatArray:
    """Return the matrices n n^T, 1 - n n^T, [n, .] and n n^T of a unit vector n = ``axis``, shape (4, 3, 3).

    The first two sum to 1 exactly, so that R(0) = 1; the first is adjusted for that, the last has its elements rounded
    once. [n, .] is the matrix of the vector product with n.
    """
    _, n_cross, dyad = rodrigues(axis)
    projector = dyad.copy()
    for i, n in enumerate(axis):
        if projector[i, i] < 0.5:
            with workprec():
                projector[i, i] = 1.0 - nearest(1 - n * n)
    return np.array([projector, IDENTITY - projector, n_cross, dyad])


def extended(axis: Axis) -> NDArray[np.longdouble]:
    """Return the matrices n n^T, 1 - n n^T, [n, .] and n n^T of a unit vector n in long doubles, shape (4, 3, 3)."""
    n1, n2, n3 = (np.longdouble(head) + np.longdouble(tail) for head, tail in (words(n, 2) for n in axis))
    dyad = np.outer([n1, n2, n3], [n1, n2, n3])
    n_cross = np.array([[0, -n3, n2], [n3, 0, -n1], [-n2, n1, 0]])
    return np.array([dyad, IDENTITY - dyad, n_cross, dyad])


def resolution(matrices: NDArray[Any], *, third_row: bool) -> tuple[NDArray[Any], FloatArray]:
    """Return factors L_r and Q_r of the matrix of each function F_r of `Basis`: two arrays (9, 3, 3), or (11, 3, 3).

    ``matrices`` (4, 3, 3) are those of `generators`. The third column, small when k t is, comes from sin and 1 -
    cos and keeps its digits. With ``third_row`` so does the third row, by two functions more: it is the third
    column of the transpose.
    """
    projector, complement, n_cross, dyad = matrices
    upper = E if third_row else IDENTITY
    C, aC = upper @ projector, upper @ complement + (IDENTITY - upper)
    pairs = [(IDENTITY, E33), (C, E), (n_cross, E33), (C, J), (dyad, E33), (aC, E), (n_cross, E), (aC, J), (n_cross, J)]
    if third_row:
        pairs += [(E33 @ dyad, E), (E33 @ dyad, J)]
    return np.array([pair[0] for pair in pairs]), np.array([pair[1] for pair in pairs])


BLOCK, PRODUCT_MATRICES = 6000, 3000
"""Times evaluated at once, so that their arrays stay in the second-level cache, and matrices made from them at once,
so few that the library does not thread the product. No powers of two, whose multiples a cache takes for one another."""

FEW_TIMES = 4
"""Times up to which functions of each time by itself are faster than those of an array."""

LARGEST = float(np.finfo(float).max) / 4
"""Size of a component that turns: a sum of two, times two, is a float."""


class DoubleRotation:
    """Rotation matrix R(t) = R_n(k t) R_z(phi t), (85), of a body that precesses about n and turns about its axis.

    `axis` n is a unit vector (3,), `precession` k and `proper` phi are frequencies in rad/time, all exact:
    rationals or balls of flint. If `inverse`, the matrix is the transposed one, as for the ball, (28). Each entry
    is a constant linear combination of functions of time, see `Basis`: one small matrix product makes all of them.
    `vectors`, set by the subclasses, are constant vectors by name, three components each: `angular_velocity` needs
    "Omega".
    """

    vectors: Mapping[str, tuple[Any, ...]] = MappingProxyType({})
    """Constant vectors of the motion, by name."""

    def __init__(self, axis: Axis, precession: Number, proper: Number, *, inverse: bool = False) -> None:
        self.axis, self.frequencies, self.inverse = axis, (precession, proper), inverse
        with workprec():
            self.turns = [f / TURN for f in self.frequencies]
        self.phases = Phases(self.turns)
        weights = SCALE[:, None, None][: None if inverse else 9] * np.matmul(
            *resolution(generators(axis), third_row=inverse)
        )
        self.weights = np.ascontiguousarray(weights.swapaxes(1, 2)) if inverse else weights
        self.entries = self.weights.reshape(-1, 9)

    @cached_property
    def rodrigues(self) -> FloatArray:
        """Twice the matrices 1, [n, .] and n n^T that go with cos k t, sin k t and 1 - cos k t, shape (3, 3, 3)."""
        return 2 * rodrigues(self.axis)

    @cached_property
    def precession(self) -> Phases:
        """The `Phases` of k t alone."""
        return Phases(self.turns[:1])

    @cached_property
    def proper(self) -> Phases:
        """The `Phases` of phi t alone."""
        return Phases(self.turns[1:])

    @cached_property
    def composition(self) -> tuple[FloatArray, FloatArray]:
        """Matrices L_r L_q Q_q Q_r of `Basis`, times SCALE of r, cut into multiples of 2^-25 and rests: two arrays.

        With n functions, 9 or 11, the first array (n, n, 9) holds the multiples by r, q and entry. The second (n, 2
        n, 9) has for each r the multiples above the rests, for factors that are small.
        """
        L, Q = resolution(extended(self.axis), third_row=self.inverse)
        exact = np.matmul(np.matmul(L[:, None], np.matmul(L, Q)), Q[:, None])
        exact = (exact.swapaxes(2, 3) if self.inverse else exact).reshape(len(L), len(L), 9)
        large = exact.astype(np.float64) + QUANTUM - QUANTUM
        small = np.concatenate([large, (exact - large).astype(np.float64)], axis=1)
        scale = SCALE[: len(L), None, None]
        return large * scale, small * scale

    def rotation(self, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return R(t), (84), body to laboratory, shape (..., 3, 3) for times t (...); `out`, if given, is filled."""
        return combinations(self.phases, self.entries, t, (3, 3), out)

    def column(self, j: int, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return the column R_j(t), ``j`` = 1, 2, 3: the body's axis j in the laboratory, shape t.shape + (3,).

        ``out``, if given, is filled and returned.
        """
        if j == 3 and not self.inverse:
            return combinations(self.precession, self.rodrigues[:, :, 2], t, (3,), out)
        return combinations(self.phases, np.ascontiguousarray(self.weights[:, :, j - 1]), t, (3,), out)

    @cached_property
    def _products(self) -> FloatArray:
        """Weights (9, 4) of the functions of `Basis`, at half the phases, in the quaternion (x, y, z, w) of R(t).

        Only the last four functions, products of cosines and sines, have weights other than zero.
        """
        x, y, z = map(nearest, self.axis)
        weights = np.zeros((9, 4))
        weights[5:] = 4 * np.array([[0, 0, 0, 1], [x, y, z, 0], [0, 0, 1, 0], [y, -x, 0, -z]])
        if self.inverse:
            weights[:, :3] *= -1
        return weights

    def quaternion(self, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return the quaternion (x, y, z, w) of R(t), continuous in t, shape (..., 4).

        ``out``, if given, is filled and returned.
        """
        return combinations(self.phases, self._products, real(t, "The time") / 2, (4,), out)

    def vector(self, name: str) -> Any:
        """Return the components (3,) of the constant vector ``name`` in `vectors`. Raises KeyError for another name."""
        return self.vectors[name]

    def angular_velocity(self, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return Omega(t) along the body's axes, shape t.shape + (3,), in rad/time.

        ``out``, if given, is filled and returned.
        """
        return (self.rotate if self.inverse else self.swung)(self.vector("Omega"), t, out)

    def rotate(self, vector: Any, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return R_n(k t) v for a constant vector v (3,), shape t.shape + (3,), in the unit of v.

        Only one phase is evaluated. Raises AtlasError if v is too large for floats. ``out``, if given, is filled and
        returned.
        """
        with np.errstate(over="ignore", invalid="ignore"):
            weights = self.rodrigues @ np.asarray(vector)
        if not np.isfinite(weights).all():
            raise AtlasError(f"The vector {vector} that is to be turned is too large for a float: choose larger units.")
        return combinations(self.precession, weights, t, (3,), out)

    def swung(self, vector: tuple[float, float, float], t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return R_z(-phi t) v for a constant vector v, shape t.shape + (3,), in the unit of v.

        Raises AtlasError if v is too large for floats. ``out``, if given, is filled and returned.
        """
        x, y, z = vector
        if max(abs(x), abs(y)) > LARGEST:
            raise AtlasError(f"The vector {vector} that turns is too large for a float: choose larger units.")
        out = combinations(self.proper, 2 * np.array([[x, y, 0], [y, -x, 0], [0, 0, 0]]), t, (3,), out)
        out[..., 2] = z
        return out


def combinations(
    phases: Phases, weights: FloatArray, t: Any, shape: tuple[int, ...], out: FloatArray | None
) -> FloatArray:
    """Return weighted sums of the functions of `Basis` at times t, shape t.shape + ``shape``.

    ``weights`` (3, 9 or 11, prod(shape)) hold one row for each function; since `Basis` returns functions divided by
    SCALE, a weight is SCALE times the coefficient. 3 rows need one phase, 9 or 11 two. ``out``, if given, is
    filled. Raises AtlasError for a time that is no number or a phase that is too long.
    """
    times = t if type(t) is np.ndarray and t.dtype == np.float64 else real(t, "The time")
    if 0 < times.size <= FEW_TIMES:
        out = target(out, times.shape + shape)
        rows = [functions_of_one(phases.circle_of_one(x), len(weights)) for x in times.ravel().tolist()]
        np.matmul(rows, weights, out=out.reshape(times.size, -1))
        return out
    if times.size <= PRODUCT_MATRICES:
        out = target(out, times.shape + shape)
        functions = Basis(phases, times.size, len(weights)).at(times.reshape(-1))
        np.matmul(functions.T, weights, out=out.reshape(-1, weights.shape[1]))
        return out

    def prepare(size: int) -> Callable[[FloatArray, FloatArray], None]:
        """Return the function (times, rows) that fills ``rows`` for a block of at most ``size`` times."""
        basis = Basis(phases, size, len(weights))
        return lambda times, rows: combined(basis.at(times), weights, rows)

    return evaluate(times, shape, out, prepare)


def functions_of_one(circle: list[tuple[float, float, float]], count: int) -> tuple[float, ...]:
    """Return the first ``count`` functions of `Basis`, divided by SCALE, at one time, as floats.

    ``circle`` is the result of `Phases.circle_of_one`.
    """
    c, s, v = circle[0]
    if count == 3:
        return c, s, v
    C, S, _ = circle[1]
    return (c, C, s, S, v, c * C, s * C, c * S, s * S, v * C, v * S)[:count]


def combined(functions: FloatArray, weights: FloatArray, rows: FloatArray) -> None:
    """Write functions (k, m) transposed times ``weights`` (k, n) into ``rows`` (m, n), in blocks."""
    for i in range(0, len(rows), PRODUCT_MATRICES):
        np.matmul(functions[:, i : i + PRODUCT_MATRICES].T, weights, out=rows[i : i + PRODUCT_MATRICES])


def evaluate(
    times: FloatArray,
    shape: tuple[int, ...],
    out: FloatArray | None,
    prepare: Callable[[int], Callable[[FloatArray, FloatArray], None]],
) -> FloatArray:
    """Return an array of shape times.shape + ``shape``, filled block by block.

    ``prepare(size)`` returns a function (times, rows) that fills rows for at most ``size`` times. Blocks may run in
    two threads. ``out``, if given, is filled and returned.
    """
    out = target(out, times.shape + shape)
    rows = out.reshape(times.size, prod(shape))
    flat: Any = times.reshape(-1) if times.flags.c_contiguous else times.flat

    def fill_blocks(low: int, high: int) -> None:
        fill = prepare(min(high - low, BLOCK))
        for i in range(low, high, BLOCK):
            j = min(i + BLOCK, high)
            fill(flat[i:j], rows[i:j])

    shared(fill_blocks, times.size, BLOCK)
    return out


def target(out: FloatArray | None, shape: tuple[int, ...]) -> FloatArray:
    """Return the float64 array of this shape to fill: a new one, or ``out``.

    Raises AtlasError if there is no memory, or ``out`` is not a writable C-contiguous float64 array of that shape.
    """
    keep()
    if out is None:
        try:
            return np.empty(shape)
        except (ValueError, MemoryError) as error:  # more than NumPy can count, more than there is
            raise AtlasError(
                f"there is no memory for an array of shape {reprlib.repr(shape)}: ask for less."
            ) from error
    if not isinstance(out, np.ndarray) or isinstance(out, np.ma.MaskedArray):
        raise AtlasError(f"out must be a NumPy array of shape {shape}, not of type {type(out).__name__}.")
    if out.shape != shape or out.dtype != np.float64 or not out.flags.c_contiguous or not out.flags.writeable:
        kind = f"{'' if out.flags.writeable else 'read-only '}{out.dtype} of shape {out.shape}"
        raise AtlasError(f"out must be a writable C-contiguous float64 array of shape {shape}, not {kind}.")
    return out
