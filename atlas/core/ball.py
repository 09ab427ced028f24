"""General motion of a charged ball, mf30 to mf40."""

from functools import cached_property
from typing import Any

from atlas.core.inputs import FloatArray, real
from atlas.core.motion import Motion, components
from atlas.core.rotation import DoubleRotation
from atlas.core.wide import ONE, ZERO, exact, length
from atlas.errors import DomainError


class Ball(DoubleRotation):
    """One ball: R = R_z(-alpha t) R_k(-gamma t), the transposed of R_k(gamma t) R_z(alpha t), mf38."""

    def __init__(self, inertia: float, larmor: float, m2: float, m3: float) -> None:
        if inertia <= 0:
            raise DomainError(f"The inertia of a ball must be positive, not {inertia}.")
        I0, alpha, n2, n3 = exact(inertia, larmor, m2, m3)
        along = n3 + alpha * I0
        size = length(n2, along)
        # mf39 is 0/0 at m2 = 0, m3 = -alpha I0: gamma = 0 there, and any axis will do
        axis = (ZERO, -n2 / size, -along / size) if size else (ZERO, ZERO, -ONE)
        self.momentum, self.omega = (0.0, m2, m3), (0.0, float(n2 / I0), float(n3 / I0))
        super().__init__(axis, size / I0, alpha, inverse=True)


class BallMotion(Motion[Ball]):
    """Motion of a ball with the field along e3 and m(0) = (0, m2, m3): R = R_z(-alpha t) R_k(-gamma t), mf38.

    `inertia` I0 > 0; `larmor` alpha = mu |B|/(2c), mf37, of either sign, in 1/time; `momentum` (m2, m3) in
    inertia/time. Arrays broadcast; the inputs are taken as exact. The frame is that of Figure Ball, e3 along the field
    and m(0) in the plane (e2, e3), not that of the symmetric body. For m2 = 0 the two turns are one, mf40.
    """

    def __init__(self, inertia: Any, larmor: Any, momentum: Any) -> None:
        m2, m3 = components(momentum, ("m2", "m3"), "The momentum")
        super().__init__(Ball, real(inertia, "The inertia"), real(larmor, "The Larmor frequency"), m2, m3)

    @cached_property
    def gamma(self) -> Any:
        """Frequency gamma = sqrt(m2^2 + (alpha I0 + m3)^2)/I0 of the turn about k_hat, mf39."""
        return self._each(lambda one: float(one.frequencies[0]))

    @cached_property
    def k_hat(self) -> tuple[Any, Any]:
        """Axis (k2, k3) of mf39; (0, -1) where gamma = 0, and mf39 is 0/0."""
        return self._each(lambda one: float(one.axis[1])), self._each(lambda one: float(one.axis[2]))

    def angular_momentum(self, t: Any) -> FloatArray:
        """Angular momentum m(t) = (m2 sin alpha t, m2 cos alpha t, m3) in the laboratory, mf36; shape (..., 3)."""
        return self._spread(lambda one, t, out: one.swung(one.momentum, t, out), t, (3,))

    def angular_velocity(self, t: Any) -> FloatArray:
        """Angular velocity in the body, Omega = R^T m/I0 = R_k(gamma t) m(0)/I0, below mf35; shape (..., 3)."""
        return self._spread(lambda one, t, out: one.turned(one.omega, t, out), t, (3,))
