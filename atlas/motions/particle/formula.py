"""A charged point particle in constant E and B, (89) to (99), for any fields and any sign of mu.

The paper's solution divides by B and holds for mu > 0. Here, with w = -mu B/c, n its direction, x = |w| t and
a = mu E, every vector split along B and across it, (89) reads y'' = a + [w, y'] and integrates to

    y'(t) = v_par + cos x v_perp + sin x [n, v_perp] + t {a_par + s a_perp + g [n, a_perp]},
    y(t) = y(0) + t {v_par + s v_perp + g [n, v_perp]} + t^2 {a_par/2 + f a_perp + h [n, a_perp]},

    s = sin x / x,   f = (1 - cos x)/x^2,   g = (1 - cos x)/x,   h = (x - sin x)/x^2,

with v = y'(0). No term is larger than the motion itself, any sign of mu is right, and B -> 0 is the parabola of (90).

Each formula of the constants takes mu, c and the components of E, B, velocity and position.
"""

from typing import Any

from atlas.arithmetic.numbers import Number, Vector, cross, dot, length, root, select, unit


def rate(mu: Number, c: Number, *x: Number) -> Number:
    """Return the magnitude of the frequency omega = mu |B|/c of (97), in rad/time.

    Arguments of this and the other formulas are mu, c, and x = (E, B, velocity, position), twelve components.
    """
    return abs(mu) * length(*x[3:6]) / c


def prime(mu: Number, c: Number, *x: Number) -> Vector:
    """Return B' = mu B/(2c), (32), three components in 1/time; arguments as for `rate`."""
    return [mu * b / (c + c) for b in x[3:6]]


def crossed(_: Number, __: Number, *x: Number) -> Vector:
    """Return the vector product [E, B]: zero where the fields are parallel; arguments as for `rate`."""
    return cross(x[:3], x[3:6])


def scalar_product(_: Number, __: Number, *x: Number) -> Number:
    """Return the scalar product (E, B); arguments as for `rate`."""
    return dot(x[:3], x[3:6])


def bending(_: Number, __: Number, *x: Number) -> Vector:
    """Return [E, v], v the velocity: zero if E does not bend a path without magnetic force; arguments as for `rate`."""
    return cross(x[:3], x[6:9])


def circling(_: Number, c: Number, *x: Number) -> Vector:
    """Return B^2 times the velocity across B less the drift c [E, B]/B^2, three components; arguments as for `rate`."""
    B, v = x[3:6], x[6:9]
    return [a - c * e for a, e in zip(cross(cross(B, v), B), cross(x[:3], B), strict=True)]


def looping(mu: Number, c: Number, *x: Number) -> Number:
    """Return B^4 (u^2 - d^2), u the speed of circling and d that of the drift: positive if the path has loops.

    Arguments as for `rate`; the first, mu, does not matter.
    """
    force, drifting = circling(mu, c, *x), [c * e for e in cross(x[:3], x[3:6])]
    return dot(force, force) - dot(drifting, drifting)


def drift(_: Number, c: Number, *x: Number) -> Vector:
    """Return the velocity c [E, B]/B^2 of (94), three components, for B != 0; arguments as for `rate`."""
    return [c * e / dot(x[3:6], x[3:6]) for e in cross(x[:3], x[3:6])]


def radius(mu: Number, c: Number, *x: Number) -> Number:
    """Return the radius a of (97), |circling| c/(|mu| |B|^3), as a single root: rational where possible.

    `circling` is B^2 times a velocity, hence the third power. Arguments as for `rate`, with mu and B not zero.
    """
    force, b2 = circling(mu, c, *x), dot(x[3:6], x[3:6])
    return root(dot(force, force) * c * c / (mu * mu * b2 * b2 * b2))


def arm(mu: Number, c: Number, *x: Number) -> Vector:
    """Return y(0) less the point O(0) of (99), three components: [B, circling] c/(mu B^4).

    `circling` is B^2 times a velocity. Arguments as for `rate`, with mu and B not zero.
    """
    b2 = dot(x[3:6], x[3:6])
    return [c * a / (mu * b2 * b2) for a in cross(x[3:6], circling(mu, c, *x))]


def drift_velocity(_: Number, c: Number, *x: Number) -> Vector:
    """Return the velocity of the point O of (99) at t = 0: across B the drift, along B that of the particle.

    Three components; arguments as for `rate`, with B not zero.
    """
    B, b2, forward = x[3:6], dot(x[3:6], x[3:6]), dot(x[3:6], x[6:9])
    return [(forward * b + c * e) / b2 for b, e in zip(B, cross(x[:3], B), strict=True)]


def centre(mu: Number, c: Number, *x: Number) -> Vector:
    """Return six components: of the point O(0) of (99), then of its velocity; arguments as for `arm`."""
    return [*(y - a for y, a in zip(x[9:12], arm(mu, c, *x), strict=True)), *drift_velocity(mu, c, *x)]


def axes(_: Number, __: Number, *x: Number) -> Vector:
    """Return nine components of unit vectors along [E, B], [B, [E, B]] and B: the frame of figure Magn.

    Arguments as for `rate`; [E, B] is not zero.
    """
    first_axis, third = cross(x[:3], x[3:6]), x[3:6]
    return [n for row in (first_axis, cross(third, first_axis), third) for n in unit(row)]


def velocity_parts(mu: Number, _: Number, *x: Number) -> Vector:
    """Return nine components of v_par, v_perp and [n, v_perp], n the unit vector along B with the sign of -mu.

    v is the velocity at t = 0, split along and across B; arguments as for `rate`, with B not zero.
    """
    return _split(mu, x[3:6], x[6:9])


def acceleration_parts(mu: Number, _: Number, *x: Number) -> Vector:
    """Return nine components of a_par, a_perp and [n, a_perp] for a = mu E, as `velocity_parts` does for v."""
    return [mu * a for a in _split(mu, x[3:6], x[:3])]


def position(v: Any, a: Any, t: Number, s: Number, f: Number, g: Number, h: Number) -> Number:
    """Return one component of y(t) - y(0), (101) with (93) and (98).

    ``v`` and ``a`` are that component of the three parts of velocity and acceleration; s, f, g, h are the functions of
    `rows.Gyration` at the phase |w| t, w = mu B/c.
    """
    return t * (v[0] + s * v[1] + g * v[2] + t * (a[0] / 2 + f * a[1] + h * a[2]))


def velocity(v: Any, a: Any, t: Number, cos: Number, sin: Number, s: Number, g: Number) -> Number:
    """Return one component of y'(t), (90), from that component of the three parts of v and of a, see `position`.

    ``cos`` and ``sin`` are of the phase |w| t; s, g as in `Gyration`.
    """
    return v[0] + cos * v[1] + sin * v[2] + t * (a[0] + s * a[1] + g * a[2])


def _split(mu: Number, B: Vector, v: Vector) -> Vector:
    b2, side = dot(B, B), cross(B, v)
    share, b = dot(B, v) / b2, length(*B)
    return [*(share * x for x in B), *(x / b2 for x in cross(side, B)), *(select(mu, -x, x) / b for x in side)]
