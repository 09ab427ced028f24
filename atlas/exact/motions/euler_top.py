"""Euler's top, a free body of any inertia tensor, as balls: an elliptic motion without a field."""

from typing import Any

from flint import fmpq

from atlas.exact.inputs import rationals
from atlas.exact.motions.elliptic import EllipticMotion
from atlas.exact.motions.elliptic_curve import check_moments
from atlas.exact.nutation.elliptic_quartic import EllipticQuartic


class EulerTop(EllipticMotion):
    """The motion R(t), R(0) = 1, of a free body with moments (I1, I2, I3) that starts with ``omega``.

    The angular momentum m = II Omega in the body stands for the field, and E = II^-1: m' = [m, E m]. No frame turns.
    """

    frame = 0

    def __init__(self, inertia: Any, omega: Any) -> None:
        self.inertia = moments = rationals(inertia, "inertia (I1, I2, I3)", 3)
        check_moments(moments)
        self.field = tuple(I * w for I, w in zip(moments, rationals(omega, "omega", 3), strict=True))
        self._e = tuple(1 / I for I in moments)
        self.square, self.branch, self.z = fmpq(1), -1, fmpq(1)
        self.places = self._order()
        self.quartic = EllipticQuartic(self._turned(self._e), self._turned(self.field), self.square, self.branch)
        self.kind = self._kind()
        self._known = None

    @property
    def _rests(self) -> bool:
        """Whether there is no motion."""
        return not any(self.field)
