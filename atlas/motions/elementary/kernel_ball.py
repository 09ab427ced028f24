"""General motion of a charged ball, (20) to (30)."""

from typing import Any

import numpy as np

from atlas.arithmetic.annotations import FloatOrArray, RealArrayLike
from atlas.arithmetic.dimensions import INERTIA, MOMENTUM, RATE
from atlas.arithmetic.double_double import over
from atlas.arithmetic.given import exact_number
from atlas.arithmetic.inputs import FloatArray, as_given, components, frozen_property, numbers, plain
from atlas.arithmetic.numbers import (
    as_rational,
    cross,
    direction,
    dot,
    evaluate_rounded,
    length,
    nearest,
    unit,
    workprec,
)
from atlas.arithmetic.rotation import DoubleRotation
from atlas.arithmetic.rotation_rows import Group
from atlas.arithmetic.words import ONE, ZERO, exact
from atlas.bodies.formula_domain import check_ball
from atlas.motions.base import DoubleTurn
from atlas.motions.elementary.formula_ball import rates, turning
from atlas.motions.start import Start


class Ball(DoubleRotation):
    """Evaluator of one solid ball: R = R_z(-alpha t) R_k(-gamma t), the transpose of R_k(gamma t) R_z(alpha t), (28).

    The inputs are numbers taken as exact: inertia, alpha (rad/time), m2 and m3. `vectors` has "m" and "Omega" at t = 0.
    """

    def __init__(self, inertia: Any, larmor: Any, m2: Any, m3: Any) -> None:
        with workprec():
            axis_vector, gamma, alpha = turning(*exact(inertia, larmor, m2, m3))
            # (29) is 0/0 at m2 = 0, m3 = -alpha I0: gamma = 0 there, and any axis will do
            axis = (ZERO, *direction(axis_vector)) if gamma != 0 else (ZERO, ZERO, -ONE)
        self.vectors = {
            "m": (0.0, np.asarray(m2), np.asarray(m3)),
            "Omega": (0.0, *evaluate_rounded(rates, inertia, m2, m3)),
        }
        super().__init__(axis, gamma, alpha, inverse=True)


class BallMotion(DoubleTurn[Ball]):
    """Motion of a charged ball, R(t) = R_z(-alpha t) R_k(-gamma t), eqs. (20)-(30).

    Parameters
    ----------
    inertia : float or array_like
        Moment of inertia I0 > 0.
    larmor : float or array_like
        Larmor frequency alpha = mu |B|/(2c), (27), of either sign, in rad/time.
    momentum : (m2, m3), array_like
        Initial angular momentum, in inertia/time.

    Raises
    ------
    DomainError
        For an inertia that is not positive.
    AtlasError
        For an input that is no number.

    Notes
    -----
    The frame is that of Figure Ball: e3 along the field, m(0) in the plane (e2, e3). For m2 = 0 both rotations have
    one axis, (30). Inputs are taken as exact and broadcast with one another and with the times.

    Examples
    --------
    >>> round(atlas.BallMotion(1.0, 0.5, momentum=(0.3, -0.7)).gamma, 9)
    0.360555128
    """

    family = _kind = "ball"
    _frequencies = slice(1, None)
    _inverse = True

    def __init__(self, inertia: RealArrayLike, larmor: RealArrayLike, momentum: RealArrayLike) -> None:
        m2, m3 = components(momentum, ("m2", "m3"), "The momentum", MOMENTUM)
        inertia = numbers(inertia, "The inertia", INERTIA)
        check_ball(np.asarray(inertia))
        larmor = numbers(larmor, "The Larmor frequency", RATE)
        super().__init__(Ball, inertia, larmor, m2, m3)
        self.inertia, self.larmor, self.momentum = plain(inertia), plain(larmor), (plain(m2), plain(m3))
        momentum = (as_given(m2), as_given(m3))
        self.arguments = {"inertia": as_given(inertia), "larmor": as_given(larmor), "momentum": momentum}

    @frozen_property
    def gamma(self) -> FloatOrArray:
        """Frequency gamma = sqrt(m2^2 + (alpha I0 + m3)^2)/I0 of the rotation about k_hat, (29), in rad/time."""
        return over(lambda *inputs: turning(*inputs)[1], *self._inputs, unit=self._frequencies)

    @property
    def precession_rate(self) -> FloatOrArray:
        """Rate -alpha of the rotation about the field, (28), in rad/time."""
        values: FloatOrArray = plain(-np.asarray(self.larmor))
        return values

    @property
    def spin_rate(self) -> FloatOrArray:
        """Rate -gamma of the rotation about the axis k_hat in the body, (28), in rad/time."""
        values: FloatOrArray = plain(-np.asarray(self.gamma))
        return values

    @frozen_property
    def k_hat(self) -> tuple[FloatOrArray, FloatOrArray]:
        """Components (k2, k3) of the unit axis (29); (0, -1) for gamma = 0, where (29) is 0/0."""
        k2, k3 = over(
            lambda *inputs: direction(turning(*inputs)[0]), *self._inputs, unit=self._frequencies, degree=(0, 0)
        )
        return k2, plain(np.where(self.gamma == 0, -1.0, k3))

    def angular_momentum(self, t: RealArrayLike) -> FloatArray:
        """Angular momentum m(t) = (m2 sin alpha t, m2 cos alpha t, m3) in the laboratory, eq. (26).

        Parameters
        ----------
        t : array_like
            Times, as for `rotation`.

        Returns
        -------
        ndarray, shape (..., 3)
            Components of m, in inertia/time.

        Raises
        ------
        AtlasError
            For a time that is not finite or whose phases exceed 2^50.
        """
        if self.is_placed:
            return self._momentum_of(lambda Omega: Omega, t)
        return self._evaluate(lambda single, t, out: single.swung(single.vector("m"), t, out), t, (3,))

    def angular_velocity(self, t: RealArrayLike) -> FloatArray:
        """Angular velocity Omega = R^T m/I0 = R_k(gamma t) m(0)/I0 in the body, below eq. (25).

        Parameters
        ----------
        t : array_like
            Times, as for `rotation`.

        Returns
        -------
        ndarray, shape (..., 3)
            Components of Omega, in rad/time.

        Raises
        ------
        AtlasError
            For a time that is not finite or whose phases exceed 2^50.
        """
        return super().angular_velocity(t)

    def field_in_body(self, t: RealArrayLike) -> FloatArray:
        """Field K(t) = R^T B' in the body with B' = (0, 0, alpha), eq. (32).

        Parameters
        ----------
        t : array_like
            Times, as for `rotation`.

        Returns
        -------
        ndarray, shape (..., 3)
            Components of K, in 1/time, each within 1e-15 of |alpha|.

        Raises
        ------
        AtlasError
            For a time that is not finite or whose phases exceed 2^50.
        """
        if self._placement is not None:
            return np.asarray(np.vecmat(self._placement.field, self.rotation(t)))
        return np.asarray(np.asarray(self.larmor)[..., None] * self.rotation(t)[..., 2, :])

    @classmethod
    def _from_start(cls, start: Start) -> tuple[Any, FloatArray] | None:  # type: ignore[override]
        """Return (motion, axes) of a start, with the third axis along the field and m(0) across the first.

        The axes (3, 3) are rows. None for an array, without a field, and for moments that are not all equal.
        """
        if start.shape or not start.has_field or len({exact(x) for x in start.moments}) > 1:
            return None
        _, axes, field, omega = start.symmetric
        K, w = exact(*field), exact(*omega)
        square, projection, size = dot(K, K), dot(w, K), exact(start.moments[2])[0]
        aside = [square * x - projection * y for x, y in zip(w, K, strict=True)]
        with workprec():
            b, side = as_rational(length(*K)), as_rational(length(*aside))
            if side == 0:
                e = exact(*np.eye(3)[np.argmin([abs(nearest(x / b)) for x in K])])
                aside = [square * x - dot(e, K) * y for x, y in zip(e, K, strict=True)]
            turn = np.array([[nearest(x) for x in unit(row)] for row in (cross(aside, K), aside, K)])
        larmor, m2, m3 = (exact_number(x) for x in (b, size * side / square, size * projection / square * b))
        return cls(start.moments[2], larmor, (m2, m3)), turn @ axes

    def _inputs_of(self, i: int) -> Any:
        """Return the `Inputs` of the i-th motion, see `of_ball`."""
        from atlas.motions.elementary.derivatives import of_ball

        return of_ball(self, i)

    def _groups(self) -> list[Group]:
        return [(turning, slice(None), self._inputs)]

    def _vectors(self) -> dict[str, Any]:
        inertia, _, m2, m3 = self._inputs
        return {
            "m": (0.0, np.asarray(m2), np.asarray(m3)),
            "Omega": (0.0, *over(rates, inertia, m2, m3, unit=slice(1, None), degree=(1, 1))),
        }
