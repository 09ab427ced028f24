"""The turning points of many motions in two words, and the other roots of the quartic Q.

In v = n3 - b nu, which for a body in a field is Omega3 - omega3, the quartic of
`atlas.motions.nutation.certified_quartic` starts with the square of dv/dt at t = 0, so that v = 0 lies between the
turning points, however close these are: its coefficients are written anew, since a shift of those of
`atlas.bodies.formula_integrals` would cancel. With the turning points Q = (v - low)(v - high)(f2 v^2 + f1 v + f0), and
all else follows from that, whether the other two roots are real or not.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from flint import fmpq

from atlas.arithmetic.double_double import ONE, DoubleDouble, chosen, constant, more_accurate, stacked
from atlas.arithmetic.inputs import FloatArray
from atlas.arithmetic.lazy import cached_property
from atlas.arithmetic.numbers import Number
from atlas.arithmetic.words import words

MAX_ROOT_STEPS = 60
"""Most steps to a turning point in doubles; next to a double root more would be needed."""

MAX_LAST_STEP = 2.0**-24
"""Largest last step, in parts of the root and of the distance to the next, that one Newton step makes good."""

ROUNDING = 2.0**-98
"""Bound on the relative error of each term in Horner's rule with two words."""


@dataclass(frozen=True)
class TurningPoints:
    """Turning points `low` <= 0 <= `high` of v, valid where `exact`, and the other factor f0 + f1 v + f2 v^2 < 0 of Q.

    v is zero at t = 0: n3 - b nu, see `roots_of`, for elliptic motions see `EllipticRoots`. Q(v) = (dv/dt)^2 is (v
    - low)(v - high)(f0 + f1 v + f2 v^2), `f` are f0, f1, f2; all are arrays (m,). `poles` (2, m) are the v at which
    nu, the cosine of the angle between axis and field, is -1 and 1; `rate` is dv/dt at v = 0.
    """

    rate: DoubleDouble
    low: DoubleDouble
    high: DoubleDouble
    f: tuple[DoubleDouble, DoubleDouble, DoubleDouble]
    poles: DoubleDouble

    @cached_property
    def exact(self) -> Any:
        """Mask (m,) of rows where f is certainly negative between the turning points: no other root is nearer to 0."""
        f1, f2 = self.f[1].hi, self.f[2].hi
        vertex, low, high = -f1 / (2 * f2), self.low.hi, self.high.hi
        margin = 1e-9 * (high - low) + 1e-12 * abs(vertex)
        inside = (f2 < 0) & (vertex > low - margin) & (vertex < high + margin)
        are_apart = ~inside | ((self.discriminant.hi < 0) & (self.discriminant.rel < 0.5))
        return are_apart & ((self.ends.hi > 0) & (self.ends.rel < 0.5)).all(axis=0)

    @cached_property
    def width(self) -> DoubleDouble:
        """Distance high - low of the turning points, (m,), in the scaled unit of v."""
        return self.high - self.low

    @cached_property
    def discriminant(self) -> DoubleDouble:
        """A quarter of the discriminant of the other factor f of Q, (m,): positive for four real roots."""
        f0, f1, f2 = self.f
        return f1.scaled(-1) * f1.scaled(-1) - f0 * f2

    @cached_property
    def ends(self) -> DoubleDouble:
        """Values of -f at low and high, (2, m), f the other quadratic factor of Q: positive where `exact`."""
        f0, f1, f2 = self.f
        v = stacked(self.low, self.high)
        return -((f2 * v + f1) * v + f0)

    @cached_property
    def other_roots(self) -> tuple[DoubleDouble, DoubleDouble, DoubleDouble]:
        """Roots (x, y, 0) of f, the other factor of Q, if they are real, else (real part, real part, imaginary part).

        Each is an array (m,), in the unit of v.
        """
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
class Roots(TurningPoints):
    """The turning points of motions, with further constants of their spheres, each an array (m,).

    I is I3/I2 and `less` (I2 - I3)/I2; (n2, n3) is the field or a top's direction, `b` its length, `omega` Omega at
    t = 0; A and a are coefficients of Q, see `roots_of`; `a` and `top` are of tops alone, otherwise None. `moving`,
    `steady` are masks where theta is certain to vary, or not to. I c3 is the momentum M3 along the axis, M2 that
    along e2; `frame` is the rate k2/I2 of the frame about n; `plane` (2, m) are cosine and sine of the turn about
    e3 that brought n into the plane of e2 and e3, None where there was none.
    """

    I: DoubleDouble
    less: DoubleDouble
    n2: DoubleDouble
    n3: DoubleDouble
    omega: Sequence[DoubleDouble]
    M2: DoubleDouble
    c3: DoubleDouble
    b: DoubleDouble
    frame: DoubleDouble
    A: DoubleDouble
    a: DoubleDouble | None
    top: "Top | None"
    plane: FloatArray | None
    steady: Any
    moving: Any

    @cached_property
    def is_excluded(self) -> Any:
        """Mask (m,) of rows without a field."""
        return self.b.hi == 0

    @cached_property
    def ball(self) -> Any:
        """Mask (m,) of rows with I = 1, solid balls; false for tops."""
        return (self.less.hi == 0) & (self.top is None)

    @cached_property
    def starts_on_field(self) -> Any:
        """Mask (m,) of rows whose axis starts along the field, n2 = 0."""
        return self.n2.hi == 0

    @cached_property
    def at_rest(self) -> Any:
        """Boolean mask (m,) of the rows whose angular velocity at t = 0 is exactly 0."""
        return np.logical_and.reduce([w.hi == 0 for w in self.omega])

    @property
    def tilt(self) -> FloatArray:
        """Cosine and sine of theta, the angle from field to axis, at the start, (2, m)."""
        return np.array([(self.n3 / self.b).hi, abs(self.n2 / self.b).hi])


class Top(NamedTuple):
    """Coupling and potential of a top, arrays (m,) in units of I2 and of b, the length of n.

    `kappa`, the difference of k2/(I2 b) and k3/(I3 b), is zero unless the mask `twisted` holds; `linear` and
    `quadratic` are those of the potential, A the leading coefficient of Q; `rates` is the largest of the rates that
    the top has.
    """

    kappa: DoubleDouble
    twisted: Any
    linear: DoubleDouble
    quadratic: DoubleDouble
    A: DoubleDouble
    rates: FloatArray


def roots_of(
    I2: DoubleDouble,
    I3: DoubleDouble,
    n: tuple[DoubleDouble, DoubleDouble],
    omega: Sequence[DoubleDouble],
    couplings: tuple[DoubleDouble, DoubleDouble] = (ONE, ONE),
    top: Top | None = None,
    plane: FloatArray | None = None,
) -> Roots:
    """Return the `Roots` of bodies in a field n = (B2, B3), or of tops in the direction n, arrays (m,).

    In v = n3 - b nu, b = |n|, which is Omega3 - omega3 for a body in a field,

        Q(v) = (n2^2 + 2 n3 v - v^2)(g + 2 c v - A v^2) - (n2 M2 + M3 v)^2,    g = omega1^2 + M2^2,  c = a + A n3,

    in units of I2, M2 and M3 being the canonical momenta along e2 and e3 at t = 0. A body in a field has a = 0 and
    A = I - 1; for tops see `Top`. No coefficient cancels for a body at rest in the field. A = 0 leaves a cubic,
    whose fourth root is not needed. The `couplings` are k2/(I2 b) and k3/(I3 b), one where M = II (Omega + K);
    ``top`` holds the potential of tops, ``plane`` is kept in the result.

        >>> I2, I3, B2, B3, *omega = (DoubleDouble(np.array([x])) for x in (1.0, 1.5, 1.0, 2.0, 0.3, 0.7, 0.2))
        >>> found = roots_of(I2, I3, (B2, B3), omega)
        >>> [0.2 + float(x.hi[0]) for x in (found.low, found.high)] == list(
        ...     atlas.GeneralMotion(1.5, (1.0, 2.0), omega=(0.3, 0.7, 0.2)).turning_points)
        True
    """
    I, less = I3 / I2, (I2 - I3) / I2
    (n2, n3), (w1, w2, w3), (k_across, k_along) = n, omega, couplings
    square, c3, M2, rate = n2 * n2, w3 + k_along * n3, w2 + k_across * n2, w1 * n2
    A, a = (top.A, top.linear + I * c3 * top.kappa) if top else (-less, None)
    q = from_start(I, n, omega, (M2, I * c3), couplings, A, a, top)
    b = (square + n3 * n3).sqrt()
    poles = poles_of(n3, square, b)
    starts_flat = q[0].hi == 0
    is_known = np.broadcast_to(q[1].rel, q[1].hi.shape) < 0.5
    low, high, f = turning(q, poles)
    steady, moving = starts_flat & (q[1].hi == 0) & is_known, ~starts_flat | ((q[1].hi != 0) & is_known)
    frame = k_across * b
    return Roots(rate, low, high, f, poles, I, less, n2, n3, omega, M2, c3, b, frame, A, a, top, plane, steady, moving)


def from_start(
    I: Number,
    n: Sequence[Number],
    omega: Sequence[Number],
    momenta: Sequence[Number],
    couplings: Sequence[Number],
    A: Number,
    a: Number | None = None,
    top: Any = None,
) -> tuple[Number, ...]:
    """Return the five coefficients of Q(v), the constant one first.

    For I, n, ``omega`` and ``couplings`` see `roots_of`; `momenta` are M2 and M3. A, a and ``top`` are as in
    `Roots`, the last two None for a body in a field.
    """
    (n2, n3), (w1, w2, w3), (M2, M3), (k_across, k_along) = n, omega, momenta, couplings
    square, coupling, rate, bend = n2 * n2, k_across * n2, w1 * n2, A * n3
    q1 = n3 * (w1 * w1 + w2 * (M2 + coupling)) - I * n2 * (w3 * (w2 + k_along * n2) + k_along * w2 * n3)
    if top:
        q1 = q1 + square * (top.linear + top.quadratic * n3)
    q2 = w1 * w1 + M2 * M2 + A * square + M3 * M3 - (plus(a, bend) * n3).scaled(2)
    return rate * rate, q1.scaled(1), -q2, -plus(a, bend.scaled(1)).scaled(1), A


def in_plane(
    n1: DoubleDouble, n2: DoubleDouble, n3: DoubleDouble, *omega: DoubleDouble
) -> tuple[tuple[DoubleDouble, DoubleDouble], Sequence[DoubleDouble], FloatArray | None]:
    """Return ((n2, n3), omega, plane): both vectors rotated about e3 so that n1 = 0; ``plane`` is (cos, sin), (2, m).

    ``omega`` are its three components. The plane is None, and the vectors are unchanged, if n1 is zero in all rows.
    """
    turns = n1.hi != 0
    if not turns.any():
        return (n2, n3), omega, None
    w1, w2, w3 = omega
    zero = constant(0.0, n1)
    size = (n1 * n1 + n2 * n2).sqrt()
    unit = chosen(turns, size, constant(1.0, n1))
    c, s = chosen(turns, n2 / unit, constant(1.0, n1)), chosen(turns, n1 / unit, zero)
    return (chosen(turns, size, n2), n3), (c * w1 - s * w2, s * w1 + c * w2, w3), np.array([c.hi, s.hi])


def poles_of(k_along: DoubleDouble, square: DoubleDouble, b: DoubleDouble) -> DoubleDouble:
    """Return k + b and k - b, (2, m), k = `k_along`, both without cancellation; `square` is b^2 - k^2 >= 0."""
    up, longer = k_along.hi > 0, b + abs(k_along)
    shorter = -square / longer
    return stacked(chosen(up, longer, -shorter), chosen(up, shorter, -longer))


def plus(x: Number | None, y: Number) -> Number:
    """Return x + y; y if x is None."""
    return y if x is None else x + y


def roots_of_tops(*inputs: DoubleDouble) -> Roots:
    """Return the `Roots` of tops from arrays (m,) of eleven inputs.

    They are I2, I3, k2, k3, n2, n3, omega1, omega2, omega3, linear and quadratic.
    """
    I2, I3, k2, k3, n2, n3, w1, w2, w3, linear, quadratic = inputs
    twisted = (k3 * I2 - k2 * I3).hi != 0
    I, less, k, turn = I3 / I2, (I2 - I3) / I2, k2 / I2, k3 / I3
    b = (n2 * n2 + n3 * n3).sqrt()
    k_across, k_along, none = k / b, turn / b, constant(0.0, b)
    potential = quadratic / (I2 * b * b)
    A = chosen(twisted, I * k_along * k_along - k_across * k_across, -(less * k_across * k_across)) + potential
    rates = [abs(x.hi) for x in (w1, w2, w3, k, turn)] + [np.sqrt(abs(x.hi / I2.hi)) for x in (linear, quadratic)]
    top = Top(
        kappa=chosen(twisted, k_across - k_along, none),
        twisted=twisted,
        linear=linear / (I2 * b),
        quadratic=potential,
        A=_exact_where_it_cancels(A, inputs),
        rates=np.max(rates, axis=0),
    )
    return roots_of(I2, I3, (n2, n3), (w1, w2, w3), (k_across, chosen(twisted, k_along, k_across)), top)


def _exact_where_it_cancels(A: DoubleDouble, inputs: Sequence[DoubleDouble]) -> DoubleDouble:
    """Return A, (m,), with the rows whose relative error is 1/2 or more computed anew from the inputs, exactly.

    The result has two words. The sign of A decides the number of roots. ``inputs`` are (I2, I3, k2, k3, n2, n3, ...,
    the quadratic term).
    """
    hi, low, rel = (np.array(np.broadcast_to(x, A.hi.shape)) for x in (A.hi, A.low, A.rel))
    for i in np.flatnonzero(~(rel < 0.5)).tolist():
        numbers = (float(np.broadcast_to(x.hi, A.hi.shape)[i]) for x in inputs)
        I2, I3, k2, k3, n2, n3, *_, quadratic = (fmpq(*x.as_integer_ratio()) for x in numbers)
        exact = (k3 * k3 / I3 - k2 * k2 / I2 + quadratic) / (I2 * (n2 * n2 + n3 * n3))
        (hi[i], low[i]), rel[i] = words(exact, 2), 2.0**-105
    return DoubleDouble(hi, low, rel)


def turning(
    q: tuple[DoubleDouble, ...], poles: DoubleDouble
) -> tuple[DoubleDouble, DoubleDouble, tuple[DoubleDouble, DoubleDouble, DoubleDouble]]:
    """Return turning points (low, high) and the other factor (f0, f1, f2) of quartics q0 + q1 v + ... + q4 v^4.

    All are arrays (m,); ``poles`` (2, m) bound the turning points. Where v = 0 is a root, it is one of them.
    """
    starts_flat = q[0].hi == 0
    words = np.array([np.broadcast_to(x.hi, q[0].hi.shape) for x in q])
    low = _refined(-_first_root(words * ALTERNATING, -poles.hi[1], starts_flat), q)
    high = _refined(_first_root(words, poles.hi[0], starts_flat), q)
    s, t, f2 = low + high, low * high, q[4]
    f1 = q[3] + s * f2
    f0 = q[2] + s * f1 - t * f2
    # next to a separatrix f is small at 0, where its value and slope are those of Q over t; where 0 is a turning point,
    # t = 0 and s the other one, those of Q/v over -s
    f0 = more_accurate(f0, chosen(starts_flat, -(q[1] / s), q[0] / t))
    f1 = more_accurate(f1, chosen(starts_flat, (f0 - q[2]) / s, (q[1] + s * f0) / t))
    return low, high, (f0, f1, f2)


ALTERNATING = np.array([1.0, -1.0, 1.0, -1.0, 1.0])[:, None]


def _first_root(q: FloatArray, reach: FloatArray, starts_flat: Any) -> FloatArray:
    """Return the first root above 0, at most ``reach``, of polynomials q (5, m) positive before it, in doubles, (m,).

    q has the constant coefficient first. Where ``starts_flat``, 0 is a root, and the result if q is negative beyond. No
    step passes the root: each goes to the root of a parabola below q, whose second derivative is the least of q between
    here and ``reach``. After `MAX_ROOT_STEPS` steps the last point is returned.
    """
    q = np.where(starts_flat, np.concatenate([q[1:], 0 * q[:1]]), q)
    roots, rows = np.zeros_like(reach), np.arange(reach.size)
    v = roots
    for n in range(MAX_ROOT_STEPS):
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
            roots[rows] = v
            if not going.any():
                break
            q, reach, rows, v = q[:, going], reach[going], rows[going], v[going]
    return roots


def _refined(v: FloatArray, q: tuple[DoubleDouble, ...]) -> DoubleDouble:
    """Return roots of polynomials q as `DoubleDouble` from doubles v (m,), by one Newton step of third order.

    Bounds are inf where the step is too large for that.
    """
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
    rounding = (q[0].rel + ROUNDING) * abs(q0)
    for n, c in enumerate(q[1:], 1):
        rounding = rounding + (c.rel + ROUNDING) * abs(c.hi) * size**n
    steep = abs(step) * (bends / abs(slope) + 1 / size)
    error = 2 * rounding / abs(slope) + abs(step) * (2.0**-48 * slopes / abs(slope) + 4 * steep**2)
    hi = v - step
    lo = (v - hi) - step
    rel = np.where((v == 0) & (q0 == 0), 0.0, np.where(steep < MAX_LAST_STEP, error / abs(hi), np.inf))
    return DoubleDouble(np.where(v == 0, 0.0, hi), np.where(v == 0, 0.0, lo), rel)
