"""The turning points of many general motions in two words, and what else the quartic Q has of roots.

In v = Omega3 - omega3 the quartic of `atlas.exact.nutation.quartic` starts with the square of dOmega3/dt at t = 0, so
that v = 0 lies between the turning points, however close these are: its coefficients are written anew, since a shift of
those of `atlas.formulas.integrals` would cancel. With the turning points Q = (v - low)(v - high)(f2 v^2 + f1 v + f0),
and all else follows from that, whether the other two roots are real or not.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from atlas.core.arithmetic.double_double import DoubleDouble, chosen
from atlas.core.inputs import FloatArray

STEPS = 60
"""Most steps to a turning point in doubles; next to a double root more would be needed."""

NEWTON = 2.0**-24
"""Largest last step, in parts of the root and of the distance to the next, that one Newton step makes good."""

ROUNDING = 2.0**-98
"""Bound on what Horner's rule in two words loses of each term."""


@dataclass(frozen=True)
class Turning:
    """Turning points `low` <= 0 <= `high`, where `exact`, and the other factor of Q, f0, f1, f2; f < 0 between them.

    `poles` (2, m) are where nu, the cosine of the angle between axis and field, is -1 and 1; `rate` that of v at 0.
    """

    rate: DoubleDouble
    low: DoubleDouble
    high: DoubleDouble
    f: tuple[DoubleDouble, DoubleDouble, DoubleDouble]
    poles: DoubleDouble

    @cached_property
    def exact(self) -> Any:
        """Where the turning points are the ones next to 0: f is negative at both, and between them."""
        f1, f2 = self.f[1].hi, self.f[2].hi
        vertex, low, high = -f1 / (2 * f2), self.low.hi, self.high.hi
        margin = 1e-9 * (high - low) + 1e-12 * abs(vertex)
        inside = (f2 < 0) & (vertex > low - margin) & (vertex < high + margin)
        apart = ~inside | ((self.discriminant.hi < 0) & (self.discriminant.rel < 0.5))
        return apart & ((self.ends.hi > 0) & (self.ends.rel < 0.5)).all(axis=0)

    @cached_property
    def width(self) -> DoubleDouble:
        """Distance of the turning points."""
        return self.high - self.low

    @cached_property
    def discriminant(self) -> DoubleDouble:
        """A quarter of the discriminant of the other factor: positive for four real roots."""
        f0, f1, f2 = self.f
        return f1.scaled(-1) * f1.scaled(-1) - f0 * f2

    @cached_property
    def ends(self) -> DoubleDouble:
        """Values of -f at low and high, (2, m)."""
        f0, f1, f2 = self.f
        v = stacked(self.low, self.high)
        return -((f2 * v + f1) * v + f0)

    @cached_property
    def others(self) -> tuple[DoubleDouble, DoubleDouble, DoubleDouble]:
        """Two real roots of the other factor, or their real part twice, and their imaginary part."""
        f0, f1, f2 = self.f
        half, real = -f1.scaled(-1), self.discriminant.hi > 0
        root = abs(self.discriminant).sqrt()
        larger = half + chosen(half.hi < 0, -root, root)
        middle = half / f2
        return (
            chosen(real, larger / f2, middle),
            chosen(real, f0 / larger, middle),
            chosen(real, constant(0.0, half), root / abs(f2)),
        )


@dataclass(frozen=True)
class Roots(Turning):
    """The turning points of general motions; `moving`, `steady` are where Omega3 is certain to vary, or not to."""

    I: DoubleDouble
    less: DoubleDouble
    B2: DoubleDouble
    B3: DoubleDouble
    omega: tuple[DoubleDouble, DoubleDouble, DoubleDouble]
    c3: DoubleDouble
    b: DoubleDouble
    steady: Any
    moving: Any

    @cached_property
    def free(self) -> Any:
        """Where there is no field."""
        return self.b.hi == 0

    @cached_property
    def ball(self) -> Any:
        """Where I = 1."""
        return self.less.hi == 0

    @cached_property
    def along(self) -> Any:
        """Where the axis starts along the field."""
        return self.B2.hi == 0

    @cached_property
    def still(self) -> Any:
        """Where the body starts at rest."""
        return np.logical_and.reduce([w.hi == 0 for w in self.omega])

    @property
    def tilt(self) -> FloatArray:
        """Cosine and sine of theta at the start, (2, m)."""
        return np.array([(self.B3 / self.b).hi, abs(self.B2 / self.b).hi])


def roots_of(
    I2: DoubleDouble,
    I3: DoubleDouble,
    B2: DoubleDouble,
    B3: DoubleDouble,
    w1: DoubleDouble,
    w2: DoubleDouble,
    w3: DoubleDouble,
) -> Roots:
    """Return the turning points and the rest."""
    I, less = I3 / I2, (I2 - I3) / I2
    c3, X, across = w3 + B3, w2 + B2, B2 * B2
    rate = w1 * B2
    tilted = less * across
    inertial = I * c3
    q1 = B3 * (w1 * w1 + w2 * (X + B2)) - I * B2 * (w3 * X + w2 * B3)
    q2 = w1 * w1 + X * X - tilted + inertial * inertial + (less * B3 * B3).scaled(2)
    q = rate * rate, q1.scaled(1), -q2, (less * B3).scaled(2), -less
    b = (across + B3 * B3).sqrt()
    longer = b + abs(B3)
    shorter = -across / longer
    poles = stacked(chosen(B3.hi > 0, longer, -shorter), chosen(B3.hi > 0, shorter, -longer))
    still = q[0].hi == 0
    known = np.broadcast_to(q1.rel, q1.hi.shape) < 0.5
    low, high, f = turning(q, poles)
    steady, moving = still & (q1.hi == 0) & known, ~still | ((q1.hi != 0) & known)
    return Roots(rate, low, high, f, poles, I, less, B2, B3, (w1, w2, w3), c3, b, steady, moving)


def turning(
    q: tuple[DoubleDouble, ...], poles: DoubleDouble
) -> tuple[DoubleDouble, DoubleDouble, tuple[DoubleDouble, DoubleDouble, DoubleDouble]]:
    """Return the turning points and the other factor of quartics q0 + q1 v + ... between the poles."""
    still = q[0].hi == 0
    words = np.array([np.broadcast_to(x.hi, q[0].hi.shape) for x in q])
    low = _refined(-_first(words * ALTERNATING, -poles.hi[1], still), q)
    high = _refined(_first(words, poles.hi[0], still), q)
    s, t, f2 = low + high, low * high, q[4]
    f1 = q[3] + s * f2
    f0 = q[2] + s * f1 - t * f2
    # next to a separatrix f is small at 0, where its value and slope are those of Q over t; where 0 is a turning point,
    # t = 0 and s the other one, those of Q/v over -s
    f0 = better(f0, chosen(still, -(q[1] / s), q[0] / t))
    f1 = better(f1, chosen(still, (f0 - q[2]) / s, (q[1] + s * f0) / t))
    return low, high, (f0, f1, f2)


ALTERNATING = np.array([1.0, -1.0, 1.0, -1.0, 1.0])[:, None]


def _first(q: FloatArray, reach: FloatArray, still: Any) -> FloatArray:
    """Return the first root of polynomials q (5, m) above 0, in doubles; each is positive before and there is one.

    Where `still`, 0 is a root, and is what is looked for if q is negative beyond. No step goes too far: it is that to
    the root of a parabola below q, whose second derivative is the least that q has between here and `reach`.
    """
    q = np.where(still, np.concatenate([q[1:], 0 * q[:1]]), q)
    found, rows = np.zeros_like(reach), np.arange(reach.size)
    v = found
    for n in range(STEPS):
        value = np.maximum((((q[4] * v + q[3]) * v + q[2]) * v + q[1]) * v + q[0], 0.0)
        slope = ((4 * q[4] * v + 3 * q[3]) * v + 2 * q[2]) * v + q[1]
        places = v, reach, np.clip(-q[3] / (4 * q[4]), v, reach)
        least = np.fmin.reduce([(12 * q[4] * x + 6 * q[3]) * x + 2 * q[2] for x in places])
        bend = np.maximum(-least, 0.0)
        root = np.sqrt(slope * slope + 2 * bend * value)
        # of the two forms of the parabola's root the one that does not cancel
        step = np.where(slope > 0, (root + slope) / bend, 2 * value / (root - slope))
        new = np.minimum(v + np.where(value == 0, 0.0, step), reach)
        going, v = new > v, new
        if n % 6 == 5:
            found[rows] = v
            if not going.any():
                break
            q, reach, rows, v = q[:, going], reach[going], rows[going], v[going]
    return found


def _refined(v: FloatArray, q: tuple[DoubleDouble, ...]) -> DoubleDouble:
    """Return roots in two words from doubles by one Newton step of third order, with a bound on the error."""
    x = DoubleDouble(v)
    value = q[4]
    for c in q[3::-1]:
        value = value * x + c
    q0, q1, q2, q3, q4 = (c.hi for c in q)
    size = abs(v)
    slope = ((4 * q4 * v + 3 * q3) * v + 2 * q2) * v + q1
    slopes = ((4 * abs(q4) * size + 3 * abs(q3)) * size + 2 * abs(q2)) * size + abs(q1)
    bends = (12 * abs(q4) * size + 6 * abs(q3)) * size + 2 * abs(q2)
    step = value.hi / slope
    step = step * (1 + step * ((6 * q4 * v + 3 * q3) * v + q2) / slope)
    lost = (q[0].rel + ROUNDING) * abs(q0)
    for n, c in enumerate(q[1:], 1):
        lost = lost + (c.rel + ROUNDING) * abs(c.hi) * size**n
    steep = abs(step) * (bends / abs(slope) + 1 / size)
    error = 2 * lost / abs(slope) + abs(step) * (2.0**-48 * slopes / abs(slope) + 4 * steep**2)
    hi = v - step
    lo = (v - hi) - step
    rel = np.where((v == 0) & (q0 == 0), 0.0, np.where(steep < NEWTON, error / abs(hi), np.inf))
    return DoubleDouble(np.where(v == 0, 0.0, hi), np.where(v == 0, 0.0, lo), rel)


def better(x: DoubleDouble, y: DoubleDouble) -> DoubleDouble:
    """Return of two forms of a number the one with the smaller bound."""
    return chosen(y.rel < x.rel, y, x)


def stacked(first: DoubleDouble, second: DoubleDouble) -> DoubleDouble:
    """Return two arrays of numbers as one, (2, m)."""
    shape = np.broadcast_shapes(np.shape(first.hi), np.shape(second.hi))
    pairs = zip(_words(first), _words(second), strict=True)
    return DoubleDouble(*(np.array([np.broadcast_to(x, shape) for x in pair]) for pair in pairs))


def part(x: DoubleDouble, i: int) -> DoubleDouble:
    """Return one of two stacked arrays."""
    return DoubleDouble(x.hi[i], None if x.lo is None else x.lo[i], x.rel[i] if np.ndim(x.rel) else x.rel)


def constant(value: float, like: DoubleDouble) -> DoubleDouble:
    """Return an array of one exact number."""
    return DoubleDouble(np.full_like(like.hi, value))


def joined(pair: DoubleDouble, other: DoubleDouble) -> DoubleDouble:
    """Return two stacked arrays and a third, (3, m)."""
    words = ((x, np.broadcast_to(y, pair.hi.shape[1:])) for x, y in zip(_words(pair), _words(other), strict=True))
    return DoubleDouble(*(np.concatenate([np.broadcast_to(x, pair.hi.shape), y[None]]) for x, y in words))


def signed(x: DoubleDouble, sign: Any) -> DoubleDouble:
    """Return numbers times 1 or -1."""
    return DoubleDouble(x.hi * sign, x.low * sign, x.rel)


def _words(x: DoubleDouble) -> tuple[Any, Any, Any]:
    return x.hi, x.low, x.rel


def taken(x: DoubleDouble, rows: Any) -> DoubleDouble:
    """Return some columns of an array."""
    return DoubleDouble(*(y if np.ndim(y) == 0 else y[..., rows] for y in _words(x)))
