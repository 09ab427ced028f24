"""The quadric of initial data with constant Omega3, mf58, and its canonical form mf60 to mf63."""

from collections.abc import Callable
from functools import cached_property, partial
from math import atan2, copysign
from typing import Any

import numpy as np

from atlas.core.body import moments
from atlas.core.inputs import FloatArray, plain, vectors
from atlas.core.motion import components, over
from atlas.core.wide import ONE, ZERO, Wide, exact, length
from atlas.errors import DomainError


class Quadric:
    """The surface mf58: omega1^2 + (omega2+B2)^2 - (I B2/B3)(omega2+B2)(omega3+B3) = (1-I) B2^2.

    `ratio` I = I3/I2 or a SymmetricBody; `field` = (B2, B3), the components of B' in 1/time, of either sign; arrays
    broadcast. The inputs are taken as exact, the scalars are rounded once. In the coordinates mf61a about the centre,

        omega'_1^2 - omega'_2^2/a2 + omega'_3^2/a3 = (1 - I) B2^2,                                               mf60

    a2 and a3 as printed there. They have the sign of B3: the paper takes B3 > 0, and for B3 < 0 the axes 2 and 3
    interchange their roles. The cone's semi-axes are a2 and a3, mf62; its C1, C2, C3 are zero.

    Degenerate kinds: for B2 = 0 ("line") C1, C2, C3 are zero and the infinite one of a2, a3 raises DomainError; for
    B = 0 ("all space") beta, a2, a3 and the axes do, since I^-1 B' has no direction.
    """

    def __init__(self, ratio: Any, field: Any) -> None:
        B2, B3 = components(field, ("B2", "B3"), "The field")
        self._inputs = (*moments(ratio), plain(B2), plain(B3))
        self.field = self._inputs[2:]

    @cached_property
    def kind(self) -> Any:
        """Kind of the surface, decided on the inputs as given: I3 against I2, never a rounded quotient.

        One of "two-sheet hyperboloid" (I > 1), "cone" (I = 1), "one-sheet hyperboloid" (I < 1), "plane pair" (B3 = 0),
        "line" (B2 = 0), "all space" (B = 0).
        """
        return over(kind, *self._inputs)

    @cached_property
    def beta(self) -> Any:
        """Angle from e2 to I^-1 B', tan(beta) = B3/(I B2), in (-pi, pi], mf61a."""
        return over(beta, *self._inputs)

    @cached_property
    def a2(self) -> Any:
        """Coefficient a2 = 2 sin(beta)/(1 - sin(beta)), mf60."""
        return over(partial(_rounded, a2), *self._inputs)

    @cached_property
    def a3(self) -> Any:
        """Coefficient a3 = 2 sin(beta)/(1 + sin(beta)), mf60."""
        return over(partial(_rounded, a3), *self._inputs)

    @cached_property
    def semi_axes(self) -> Any:
        """Semi-axes C1, C2, C3 of mf61b, mf63: the roots of |1-I| B2^2 (1, |a2|, |a3|); a tuple, or shape (..., 3)."""
        return over(semi_axes, *self._inputs)

    @cached_property
    def centre(self) -> FloatArray:
        """Centre -B' = (0, -B2, -B3), shape (..., 3)."""
        _, I3, B2, B3 = self._inputs
        return 0.0 - np.stack(np.broadcast_arrays(0.0, B2, B3, I3)[:3], -1)

    @cached_property
    def axes(self) -> FloatArray:
        """Directions of omega'_1..3 as rows, mf61a: the angle beta/2 + pi/4 in the plane (e2, e3); (..., 3, 3)."""
        return np.asarray(over(axes, *self._inputs))

    def canonical(self, omega: Any) -> FloatArray:
        """Coordinates omega'_1..3, mf61a, of points `omega` (..., 3)."""
        return np.asarray(np.matvec(self.axes, vectors(omega, "omega") - self.centre))

    def residual(self, omega: Any) -> Any:
        """Left-hand side of mf58.1 at points `omega` (..., 3), in 1/time^3, rounded once: zero on the surface only.

        B3 (omega1^2 + omega2^2) - I B2 omega2 omega3 + (2-I) B2 B3 omega2 - I B2^2 omega3.
        """
        return over(partial(_rounded, residual), *self._inputs, *np.moveaxis(vectors(omega, "omega"), -1, 0))


def kind(I2: float, I3: float, B2: float, B3: float) -> str:
    """Name the surface mf58.1."""
    if B2 == 0:
        return "line" if B3 else "all space"
    if B3 == 0:
        return "plane pair"
    if I3 == I2:
        return "cone"
    return "two-sheet hyperboloid" if I3 > I2 else "one-sheet hyperboloid"


def beta(I2: float, I3: float, B2: float, B3: float) -> float:
    """Return the angle of I^-1 B' from e2; only its tangent is rounded before."""
    x, y, _ = _direction(*exact(I2, I3, B2, B3))
    if not x:
        return atan2(B3, 0.0)
    return atan2(copysign(abs(float(y / x)), B3), copysign(1.0, B2))


def a2(I2: Wide, I3: Wide, B2: Wide, B3: Wide) -> Wide:
    """Return a2 of mf60: with (x, y) along I^-1 B' and h its length, 2 y/(h - y)."""
    x, y, h = _direction(I2, I3, B2, B3)
    if not x and y.m > 0:
        raise DomainError("With B2 = 0 and B3 > 0 sin(beta) = 1, and a2 of mf60 is infinite.")
    return (y + y) / _less(x, y, h)


def a3(I2: Wide, I3: Wide, B2: Wide, B3: Wide) -> Wide:
    """Return a3 of mf60: 2 y/(h + y)."""
    x, y, h = _direction(I2, I3, B2, B3)
    if not x and y.m < 0:
        raise DomainError("With B2 = 0 and B3 < 0 sin(beta) = -1, and a3 of mf60 is infinite.")
    return (y + y) / _less(x, -y, h)


def semi_axes(*inputs: float) -> tuple[float, float, float]:
    """Return C1, C2, C3 of mf61b, mf63."""
    I2, I3, B2, B3 = exact(*inputs)
    square = abs(ONE - I3 / I2 if I2.m != I3.m or I2.e != I3.e else ZERO) * B2 * B2
    if not square:
        return 0.0, 0.0, 0.0
    C1, C2, C3 = (float((square * abs(a)).sqrt()) for a in (ONE, a2(I2, I3, B2, B3), a3(I2, I3, B2, B3)))
    return C1, C2, C3


def axes(*inputs: float) -> list[list[float]]:
    """Return the rows omega'_1..3 of mf61a: cos^2 and sin^2 of beta/2 + pi/4 are (1 -+ sin beta)/2."""
    _, _, B2, B3 = inputs
    x, y, h = _direction(*exact(*inputs))
    cos, sin = (float((_less(x, s, h) / (h + h)).sqrt()) for s in (y, -y))
    cos, sin = copysign(cos, 1.0 if B2 >= 0 or B3 < 0 else -1.0), copysign(sin, 1.0 if B2 >= 0 or B3 >= 0 else -1.0)
    return [[1.0, 0.0, 0.0], [0.0, cos, sin], [0.0, 0.0 - sin, cos]]


def residual(I2: Wide, I3: Wide, B2: Wide, B3: Wide, w1: Wide, w2: Wide, w3: Wide) -> Wide:
    """Return the left-hand side of mf58.1."""
    times_I2 = B3 * (w1 * w1 + w2 * w2) * I2 + ((I2 + I2 - I3) * B3 * w2 - I3 * w3 * (w2 + B2)) * B2
    return times_I2 / I2


def _rounded(function: Callable[..., Wide], *inputs: float) -> float:
    """Return a function of exact numbers as the nearest double."""
    return float(function(*exact(*inputs)))


def _direction(I2: Wide, I3: Wide, B2: Wide, B3: Wide) -> tuple[Wide, Wide, Wide]:
    """Return a vector (x, y) along I^-1 B' in the plane (e2, e3), and its length."""
    x, y = I3 * B2, I2 * B3
    if not x and not y:
        raise DomainError("With B = 0 there is no angle beta: I^-1 B' has no direction.")
    return x, y, length(x, y)


def _less(x: Wide, y: Wide, h: Wide) -> Wide:
    """Return h - y for h^2 = x^2 + y^2, without cancellation."""
    return x * x / (h + y) if y.m > 0 else h - y
