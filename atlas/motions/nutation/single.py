"""One nutating motion: its constants in balls, and the evaluation of matrices and of Omega at times.

The angular velocity of a body in a field has a pair (alpha, beta) of its own; that of a top follows from the slopes of
the pair of its axis.
"""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
from flint import arb, fmpq

from atlas.arithmetic.certified_digits import enclosed
from atlas.arithmetic.given import exact_number
from atlas.arithmetic.inputs import FloatArray, largest, real
from atlas.arithmetic.lazy import cached_property
from atlas.arithmetic.numbers import nearest, workprec
from atlas.arithmetic.quaternions import between
from atlas.arithmetic.rotation import FEW_TIMES, combined, evaluate, target
from atlas.errors import DomainError
from atlas.motions.nutation.cayley_klein import Evaluation, entries, products_of_one
from atlas.motions.nutation.certified import Nutating
from atlas.motions.nutation.certified_cayley_klein import turning_rate
from atlas.motions.nutation.certified_general import GeneralMotion
from atlas.motions.nutation.certified_top import TopMotion
from atlas.motions.nutation.constants import FIRST_BITS, CayleyKlein

BITS = 60
"""Relative accuracy of a scalar before it is rounded, once."""

VECTOR = entries(np.eye(3), np.eye(3))[:, 6:]
"""Weights of the products in the vector of length 1 that a pair (alpha, beta) stands for."""


class SingleMotion:
    """Evaluator of one motion whose axis nutates; ``exact`` is the certified motion with R(0) = 1.

    Methods take times t of any shape, an array or a number, and return arrays; t has to be finite.
    """

    def __init__(self, exact: Nutating) -> None:
        self.exact = exact

    @cached_property
    def pair(self) -> CayleyKlein:
        """Constants of (alpha, beta), a `CayleyKlein`. Raises DomainError where alpha or beta underflows."""
        exact = self.exact  # not of self, which holds the parts: memory would wait for the collector of garbage
        pair = CayleyKlein(lambda: exact.solution)
        if pair.is_lost:
            raise DomainError(
                "The body's axis passes the line of the field at an angle too small for a float: give a larger "
                "angular velocity across the axis, or none."
            )
        return pair

    @cached_property
    def sides(self) -> tuple[FloatArray, FloatArray]:
        """Matrices (left, right), (3, 3) each, with R = left R(alpha, beta) right; `right` is a rotation about e3."""
        # at the precision of the other constants, which share the sphere
        c, s, C, S = enclosed(lambda: [arb(x) for x in self.exact.tilt()], FIRST_BITS - 64)
        with workprec(2 * BITS):  # else it would be that of the caller
            cos, sin, C, S = [nearest(x) for x in (c * c - s * s, 2 * c * s, C, S)]
        right = np.array([[C, -S, 0], [S, C, 0], [0, 0, 1]])
        return np.asarray(right.T @ np.array([[1, 0, 0], [0, cos, sin], [0, -sin, cos]])), right

    @cached_property
    def entries(self) -> FloatArray:
        """Weights (10, 9) with which the ten products of (alpha, beta) sum to the entries of R, by rows."""
        return entries(*self.sides)

    @cached_property
    def field(self) -> FloatArray:
        """Weights (10, 3) with which the ten products of (alpha, beta) sum to K in 1/time; for tops to unit n."""
        with workprec(2 * BITS):
            b = nearest(arb(self.exact.b))
        return np.asarray(b * VECTOR @ self.sides[1])

    def rotation(self, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return R(t), body to laboratory, shape t.shape + (3, 3); ``out``, if given, is filled and returned."""
        return self._linear(self.entries, t, (3, 3), out)

    def column(self, j: int, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return the column R_j(t), j = 1, 2, 3, shape t.shape + (3,); ``out``, if given, is filled and returned."""
        return self._linear(np.ascontiguousarray(self.entries[:, j - 1 :: 3]), t, (3,), out)

    def quaternion(self, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return the quaternion (x, y, z, w) of R(t), continuous in t with w >= 0 at t = 0, shape t.shape + (4,).

        ``out``, if given, is filled and returned.
        """

        def prepare(size: int) -> Any:
            """Return the function that writes quaternions (m, 4) at a block of m <= ``size`` times."""
            evaluation = Evaluation(self.pair, size, signed=True)

            def fill(times: FloatArray, rows: FloatArray) -> None:
                q = evaluation.components(times)
                q /= np.sqrt((q * q).sum(axis=0))
                np.matmul(q.T, self._to_quaternion, out=rows)

            return fill

        return evaluate(real(t, "The time"), (4,), out, prepare)

    @cached_property
    def _to_quaternion(self) -> FloatArray:
        """Matrix (4, 4) that takes a row (Re alpha, Re beta, Im alpha, Im beta) to (x, y, z, w).

        Its sign makes w >= 0 at t = 0.
        """
        matrix = between(*self.sides)[[3, 0, 2, 1]]
        start = Evaluation(self.pair, 1, signed=True).components(np.zeros(1))[:, 0] @ matrix
        return np.asarray(-matrix if start[3] < 0 else matrix)

    def field_in_body(self, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return K(t) along the body's axes, shape t.shape + (3,), in 1/time; of a top the unit vector n in the body.

        ``out``, if given, is filled and returned.
        """
        return self._linear(self.field, t, (3,), out)

    def _linear(
        self,
        weights: FloatArray,
        t: Any,
        shape: tuple[int, ...],
        out: FloatArray | None,
        pair: CayleyKlein | None = None,
    ) -> FloatArray:
        """Return linear combinations, shape t.shape + ``shape``, of the ten products of (alpha, beta) at times t.

        ``weights`` (10, prod(shape)) are constant; ``pair`` replaces (alpha, beta) of the motion. ``out``, if given,
        is filled and returned.
        """
        times, pair = real(t, "The time"), pair or self.pair
        if 0 < times.size <= FEW_TIMES and pair.at_one_time:
            out = target(out, times.shape + shape)
            products = [products_of_one(pair, x) for x in times.ravel().tolist()]
            np.matmul(products, weights, out=out.reshape(times.size, -1))
            return out

        def prepare(size: int) -> Any:
            """Return the function that writes the combinations (m, ...) at a block of m <= ``size`` times."""
            evaluation = Evaluation(pair, size)
            return lambda times, rows: combined(evaluation.products_at(times), weights, rows)

        return evaluate(times, shape, out, prepare)


MAX_OMEGA3_RATIO, MAX_SLENDER_RATIO = 2.3, 1.45
"""By how much the largest value that Omega3 could have may exceed the largest component of Omega at a time, and, of the
largest Omega across the axis, where it never does: sqrt(1/I) for I > 0.48."""

BALL_BLOCK = 16
"""Times for which balls are made at once."""


class SingleGeneral(SingleMotion):
    """Evaluator of one general motion; ``exact`` is the certified motion with R(0) = 1."""

    exact: GeneralMotion

    @cached_property
    def velocity(self) -> tuple[CayleyKlein, FloatArray, float, float]:
        """The pair of (Omega2, Omega1, -sqrt(I) Omega3), the weights of its products in Omega, and two sizes.

        The pair has alpha and beta as for R, with this vector in the field's place, see `GeneralMotion.velocity`.
        The tuple is (`CayleyKlein`, array (10, 3), sqrt(E'), sqrt(E'/I)): the sizes are the largest that Omega
        across and along the axis could be, in rad/time; E' is the integral of (36) to (41).
        """
        pair = CayleyKlein(lambda: self.exact.velocity)
        sizes = enclosed(lambda: [arb(x) for x in self.exact.velocity_sizes()], 2 * BITS)
        C, S, equatorial, axial = (float(x.mid()) for x in sizes)
        turn = np.array([[-S * equatorial, C * equatorial, 0], [C * equatorial, S * equatorial, 0], [0, 0, -axial]])
        return pair, VECTOR @ turn, equatorial, axial

    def quaternion(self, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return the quaternion (x, y, z, w) of R(t), continuous in t with w >= 0 at t = 0, shape t.shape + (4,).

        Components zero at all times are exactly zero. ``out``, if given, is filled and returned.
        """
        q = super().quaternion(t, out)
        q[..., self._zeros] = 0.0
        return q

    @cached_property
    def _zeros(self) -> list[int]:
        """Indices in the quaternion (x, y, z, w) of the components that vanish at all times, all from 0 to 2.

        A motion of constant theta is a rotation at the rate k about `turning_axis` times one at the rate phi about e3.
        The list is empty for other motions.
        """
        if not self.exact.is_steady:
            return []
        n1, n2, n3 = self.exact.turning_axis
        k, phi = self.exact.steady_rates()
        terms = ((n1, n2 * phi), (n2, n1 * phi), (n3, phi))
        return [i for i, (a, b) in enumerate(terms) if a * k == 0 and (b if i == 2 else b * k) == 0]

    def angular_velocity(self, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return Omega(t) along the axes of the body, shape t.shape + (3,), in rad/time.

        ``out``, if given, is filled and returned. Where Omega3 is far below the largest value that it could have, it is
        evaluated anew, see `_third`.
        """
        pair, weights, equatorial, axial = self.velocity
        Omega = self._linear(weights, t, (3,), out, pair)
        # Omega3 is within some u of the largest that it could be; of a slender body that exceeds all there is of Omega
        if axial > MAX_SLENDER_RATIO * equatorial:
            rows = Omega.reshape(-1, 3)
            small = np.flatnonzero(axial > MAX_OMEGA3_RATIO * largest(rows))
            rows[small, 2] = self._third(np.ravel(real(t, "The time"))[small])
        return Omega

    def _third(self, t: FloatArray) -> FloatArray:
        """Return Omega3 at times t (m,) in rad/time, in double-double, or from balls where that is not accurate."""
        out, uncertain = np.empty((t.size, 3)), np.arange(t.size)
        if t.size > BALL_BLOCK:
            from atlas.motions.nutation.rows import MotionsAtTimes, Rows
            from atlas.motions.nutation.rows_blocks import Blocks

            exact = self.exact
            inputs = [exact_number(x) for x in (fmpq(1), exact.I, *exact.field, *exact.omega)]
            rows = Rows(Blocks(inputs, (1,)), MotionsAtTimes).at(np.zeros(t.size, dtype=int), t)
            rows.angular_velocity(t, out)
            uncertain = rows.extreme
        for i in uncertain.tolist():
            third = partial(lambda time: self.exact.angular_velocity(time)[2], float(t[i]))
            out[i, 2] = nearest(enclosed(third, BITS))
        return out[:, 2]


class SingleTop(SingleMotion):
    """Evaluator of one motion of a top; ``exact`` is the certified motion with R(0) = 1."""

    exact: TopMotion

    @cached_property
    def _sloping(self) -> CayleyKlein:
        """`CayleyKlein` constants of alpha and beta, and of their derivatives by time, eight rows."""
        return CayleyKlein(lambda: self.exact.solution, slopes=True)

    def angular_velocity(self, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return Omega(t) along the body's axes, shape t.shape + (3,), in rad/time.

        It is twice the vector part of the quaternion's logarithmic derivative. ``out``, if given, is filled and
        returned.
        """
        kappa = nearest(self.exact.quartic.kappa) if self._sloping.swing else 0.0

        def prepare(size: int) -> Callable[[FloatArray, FloatArray], None]:
            """Return the function that writes Omega (m, 3) at a block of m <= ``size`` times."""
            evaluation = Evaluation(self._sloping, size)

            def fill(times: FloatArray, rows: FloatArray) -> None:
                q = evaluation.components(times)
                w, x, z, y = q[:4]
                up, down = w * w + z * z, x * x + y * y
                turn = turning_rate((w, x, y, z), tuple(q[[4, 5, 7, 6]]))
                turn[2] += kappa * (up - down) / (up + down)
                np.matmul(np.array(turn).T, self.sides[1], out=rows)

            return fill

        return evaluate(real(t, "The time"), (3,), out, prepare)
