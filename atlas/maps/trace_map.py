"""Shapes of the axis's trace over a plane of initial data, in plain floats: for maps, not certified."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from atlas.arithmetic.inputs import components, number, vectors
from atlas.bodies.integrals import shape_factors
from atlas.errors import DomainError
from atlas.motions.nutation.kernel_general import GeneralMotion

TOLERANCE = 1e-7
"""A trace between cosines closer than this counts as steady."""


def trace_map(ratio: Any, field: Any, omega: Any, ends: tuple[Any, Any] | None = None) -> NDArray[np.int64]:
    """Return the shape of the trace about the field from each initial angular velocity: steady 0, waving 1, looping 2.

    The result is an integer array (...). The rate of precession is dpsi = (p - M3 nu)/(1 - nu^2) - b, theorem-top,
    nu = (c3 - Omega3)/b; the axis makes loops if it changes sign between the turning points. ``ratio`` is I3/I2 or
    a body, ``field`` = (B2, B3), not both 0; ``omega`` (..., 3) is in the same unit 1/time; ``ends`` are the least
    and the largest Omega3 (...), where they are known: those of `GeneralMotion`. Raises DomainError for the zero
    field.
    """
    I, _, _ = shape_factors(ratio)
    B2, B3 = (number(x, "The field") for x in components(field, ("B2", "B3"), "The field"))
    b, w = float(np.hypot(B2, B3)), vectors(omega, "omega")
    if not b:
        raise DomainError("The kinds of motion are told by the angle to the field, which must not be zero.")
    c3 = w[..., 2] + B3
    ends = ends or GeneralMotion(ratio, (B2, B3), tuple(np.moveaxis(w, -1, 0))).turning_points
    high, low = (np.clip((c3 - np.asarray(end)) / b, -1.0, 1.0) for end in ends)
    M3, p = I * c3, ((w[..., 1] + B2) * B2 + I * c3 * B3) / b

    def rate(nu: Any) -> Any:
        """Return (1 - nu^2) dpsi, in 1/time, at nu = cos theta: its sign is that of the rate of precession."""
        return p - M3 * nu - b * (1 - nu * nu)

    # it is convex in nu: its sign changes at the ends or below its least value between them
    min_rate = rate(np.clip(M3 / (2 * b), low, high))
    max_rate = np.maximum(rate(low), rate(high))
    return np.where(high - low <= TOLERANCE, 0, np.where((min_rate < 0) & (max_rate > 0), 2, 1))
