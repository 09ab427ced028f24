"""One motion in Jacobi's functions, elliptic or of a free body: evaluation of matrices and of Omega at times."""

from typing import Any

import numpy as np
from flint import arb

from atlas.arithmetic.certified_digits import enclosed
from atlas.arithmetic.inputs import FloatArray
from atlas.arithmetic.lazy import cached_property
from atlas.arithmetic.numbers import rounded
from atlas.arithmetic.rotation import target
from atlas.motions.nutation.certified_elliptic import EllipticMotion, EulerTop
from atlas.motions.nutation.single import BITS, SingleMotion

MAX_ERROR = 3.6e-15
"""Bound on errors of entries of R, and of the vector that turns like K, beside its length."""


class SingleElliptic(SingleMotion):
    """Evaluator of one elliptic motion; ``exact`` is the certified motion with R(0) = 1."""

    exact: EllipticMotion

    is_field_turning = True
    """Whether K has the rounding errors of the vector that turns like K; the K of a free body is constant."""

    @cached_property
    def sides(self) -> tuple[FloatArray, FloatArray]:
        """Matrices (left, right), (3, 3) each: R = left R(alpha, beta) right, with axes in the order of the moments."""
        (left, right), axes = super().sides, np.eye(3)[list(self.exact.places)]
        return axes.T @ left, np.asarray(right @ axes)

    @cached_property
    def _rates(self) -> FloatArray:
        """Factors E_i - frame, shape (3,), without unit: Omega_i = factor_i K_i along the principal axes.

        For a free body they are 1/I_i, and the angular momentum stands for K.
        """
        rates = enclosed(lambda: [arb(E - self.exact.frame) for E in self.exact.E], BITS)
        return np.array([float(x.mid()) for x in rates])

    def accuracy(self, size: float, *, has_omega: bool = True) -> float:
        """Return the bound, at any time, on errors of entries of R, and of K and Omega over ``size``, in rad/time.

        ``size`` is a rate of the motion, such as its largest component of field and angular velocity. Omega is left out
        unless ``has_omega``.
        """
        factors = [float(self.is_field_turning), *abs(self._rates) * has_omega]
        return float(MAX_ERROR * max(1.0, max(factors) * rounded(lambda: self.exact.b) / size))

    def angular_velocity(self, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return Omega(t) along the body's axes, shape t.shape + (3,), in rad/time.

        It is (E_i - 1) K_i, or II^-1 m of a free body. ``out``, if given, is filled and returned.
        """
        Omega = self._linear(self.field, t, (3,), out)
        Omega *= self._rates
        return Omega

    def fill_grid(self, start: float, step: float, out: FloatArray) -> None:
        """Write R at the exact numbers start + i step, i = 0, 1, ..., into ``out`` (count, 3, 3).

        Raises AtlasError for times that `rotation` refuses.
        """
        from atlas.motions.nutation.grid import fill_grid

        fill_grid(self, start, step, out)


class SingleEulerTop(SingleElliptic):
    """Evaluator of a free body, or of a spin about a principal axis along the field.

    ``exact`` is the free motion; ``field`` (3,) is K, which is constant in the body.
    """

    is_field_turning = False

    def __init__(self, exact: EulerTop, field: FloatArray) -> None:
        super().__init__(exact)
        self._constant = field

    def field_in_body(self, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return the constant K along the body's axes, shape t.shape + (3,), in 1/time.

        ``out``, if given, is filled and returned.
        """
        K = target(out, (*np.shape(t), 3))
        K[...] = self._constant
        return K
