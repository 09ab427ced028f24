"""Shapes of the axis's trace over a plane of initial data, in plain floats: for maps, not certified."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from atlas.core.inputs import FloatArray, components, number, vectors
from atlas.core.motions.integrals import shape_factors
from atlas.errors import DomainError

IntArray = NDArray[np.int64]

TOLERANCE = 1e-7
"""Roots closer than this, near the square root of eps, count as one."""


def quartic(ratio: Any, field: Any, omega: Any) -> FloatArray:
    """Coefficients of q(nu), theorem-top, highest power first, shape (..., 5), in 1/time^2.

    `field` = (B2, B3), not both 0; `omega` (..., 3) the initial angular velocity, in the same unit 1/time.
    """
    _, A, b, B3, w, M3, p = _state(ratio, field, omega)
    nu = B3 / b
    across = w[..., 0] ** 2 + (w[..., 1] + number(field[0], "B2")) ** 2
    g = across + A * nu * nu  # h - M3^2/I - b^2
    zero = 0 * g
    return np.stack([A + zero, zero, -g - A - M3 * M3, 2 * p * M3, g - p * p], axis=-1)


def turning_points(ratio: Any, field: Any, omega: Any) -> tuple[FloatArray, FloatArray]:
    """Return the range of nu = K3/b, theorem-top: the real roots of q next to the start.

    Arguments as for `quartic`. Returns the least and the largest nu, shape (...), equal in an equilibrium. Near a
    double root the error is the square root of eps.
    """
    q = quartic(ratio, field, omega)
    _, _, b, B3, w, _, _ = _state(ratio, field, omega)
    nu, B2 = B3 / b, number(field[0], "B2")
    slope = 4 * q[..., 0] * nu**3 + 2 * q[..., 2] * nu + q[..., 3]
    roots = _roots(q)
    real = np.abs(roots.imag) <= TOLERANCE
    found = np.where(real, roots.real, np.inf)
    # where the motion starts at a turning point that root is nu itself, and q' tells the side
    start = w[..., 0] * B2 == 0
    below = np.where(found <= nu - TOLERANCE, found, -np.inf).max(axis=-1)
    above = np.where(found >= nu + TOLERANCE, found, np.inf).min(axis=-1)
    size = np.abs(q).max(axis=-1)
    low = np.where(start & (slope > -TOLERANCE * size), nu, below)
    high = np.where(start & (slope < TOLERANCE * size), nu, above)
    return np.clip(low, -1.0, 1.0), np.clip(high, -1.0, 1.0)


def trace_map(ratio: Any, field: Any, omega: Any) -> IntArray:
    """Shape of the trace about the field from each initial angular velocity: steady, 0, waving, 1, or looping, 2.

    The rate of precession is dpsi = (p - M3 nu)/(1 - nu^2) - b, theorem-top; the axis makes loops if it changes sign
    between the turning points. Arguments as for `quartic`.
    """
    low, high = turning_points(ratio, field, omega)
    _, _, b, _, _, M3, p = _state(ratio, field, omega)

    def rate(nu: Any) -> Any:
        """Return (1 - nu^2) dpsi."""
        return p - M3 * nu - b * (1 - nu * nu)

    # it is convex in nu: its sign changes at the ends or below its least value between them
    least = rate(np.clip(M3 / (2 * b), low, high))
    most = np.maximum(rate(low), rate(high))
    return np.where(high - low <= TOLERANCE, 0, np.where((least < 0) & (most > 0), 2, 1))


def _state(ratio: Any, field: Any, omega: Any) -> tuple[Any, ...]:
    """Return I, A, b, B3, omega, M3 and p of the state K = (0, B2, B3)."""
    I, one_less, _ = shape_factors(ratio)
    B2, B3 = (number(x, "The field") for x in components(field, ("B2", "B3"), "The field"))
    b, w = float(np.hypot(B2, B3)), vectors(omega, "omega")
    if not b:
        raise DomainError("The kinds of motion are told by the angle to the field, which must not be zero.")
    M3 = I * (w[..., 2] + B3)
    return I, -one_less * b * b, b, B3, w, M3, ((w[..., 1] + B2) * B2 + M3 * B3) / b


def _roots(q: FloatArray) -> NDArray[np.complex128]:
    """Return the roots (..., 4) of quartics (..., 5), those at infinity as inf."""
    lead = 0 if np.all(q[..., 0]) else 2
    monic = q[..., lead + 1 :] / q[..., lead, None]
    degree = 4 - lead
    companion = np.zeros((*q.shape[:-1], degree, degree))
    companion[..., 0, :] = -monic
    companion[..., np.arange(1, degree), np.arange(degree - 1)] = 1
    roots = np.full((*q.shape[:-1], 4), complex(np.inf))
    roots[..., :degree] = np.linalg.eigvals(companion)
    return roots
