"""The Riemann matrix of a motion's torus in balls: integrals between zeros of eta, with proven radii.

A path from a zero to a zero is u = start + way (1 - cos s)/2, as in `atlas.exact.motions.clebsch_periods`, and

    (D, z) du/eta = way (D, z) ds/(2 r),     r^2 = Psi(u)/sin(s)^2,

is analytic on it. Gauss's rule with n + 1 nodes is off by 64/15 M rho^-2n/(1 - rho^-2) at most on a part of length 2
(L. N. Trefethen, Approximation Theory and Approximation Practice, theorem 19.3), where M bounds the integrand on the
ellipse rho with its foci in the ends: that is enclosed by balls on the ellipse. No other zero and no pole is in it, by
a margin. The root r is continued from node to node: between two of them r^2 over its value at the first has a positive
real part. What sums of paths make a basis of type (1,2) is taken from `atlas.exact.motions.clebsch_lattice`, where
integer relations tell it.
"""

from collections.abc import Callable
from functools import lru_cache
from math import ceil, log
from typing import TypeAlias

from flint import acb, acb_mat, arb, ctx

from atlas.errors import NotCertifiedError
from atlas.exact.motions.clebsch_lattice import Lattice
from atlas.exact.motions.clebsch_periods import Curve, Integrals, complex_of, sums, value
from atlas.formulas.numbers import workprec

RATE = 1.0
"""Logarithm of the ellipse on which integrands are bounded: smaller than that which is free of other zeros."""

GUARD = 96
"""Bits more than are wanted: next to a zero Psi and sin(s)^2 lose some."""

HALVINGS = 12
"""Halvings, at most, of the way between two nodes along which a root is continued."""

Square: TypeAlias = Callable[[acb], tuple[acb, acb]]
"""z and r^2 as a function of s."""

AROUND, FINEST = 64, 2.0**-14
"""Balls on an ellipse at first, and the least part of a turn that one covers."""


def riemann_matrix(motion: Integrals, lattice: Lattice) -> acb_mat:
    """Return tau at the precision of the moment; NotCertifiedError where an integral is not proved."""
    bits = int(ctx.prec)
    with workprec(bits + GUARD):
        curve, near = Curve(motion, proven=True), Curve(motion)
        ways = [
            _integrals(curve, near, *path) if any(row[k] for row in lattice.weights) else [acb(0), acb(0)]
            for k, path in enumerate(lattice.paths)
        ]
        (p, q), (r, s), *others = sums(ways, lattice.weights)
        return acb_mat([[p, r / 2], [q, s / 2]]).solve(acb_mat([list(x) for x in zip(*others, strict=True)]))


def _integrals(curve: Curve, near: Curve, start: acb, stop: acb) -> list[acb]:
    """Return -2i times the integrals of (D, z) du/eta between the zeros next to two places."""
    first, last = _zero_at(curve, start), _zero_at(curve, stop)
    way, totals = last - first, [acb(0), acb(0)]

    def square(s: acb) -> tuple[acb, acb]:
        early = complex_of(s).real < 1.6  # a place next to either end is known relative to its distance from that
        z, v = curve.at(first + way * (s / 2).sin() ** 2 if early else last - way * (s / 2).cos() ** 2)
        return z, (value(curve.g, z) + 2 * curve.motion.c * v) / s.sin() ** 2

    root, place = acb(0), acb(0)
    for low, high in near.parts(start, stop):
        middle, half = arb.pi() * (low + high) / 2, arb.pi() * (high - low) / 2
        found = [acb(0), acb(0)]
        for x, weight in _rule(int(ctx.prec)):
            s = acb(middle + half * x)
            z, r2 = square(s)
            root, place = r2.sqrt() if root == 0 else _continued(square, root, place, s), s
            found = [y + weight * form / root for y, form in zip(found, (acb(1), z), strict=True)]
        for k, most in enumerate(_largest(square, middle, half)):
            n = len(_rule(int(ctx.prec))) - 1
            left = arb(64) / 15 * most * arb(-2 * RATE * n).exp() / (1 - arb(-2 * RATE).exp())
            totals[k] += half * (found[k] + acb(arb(0, left.upper()), arb(0, left.upper())))
    factor = acb(0, -1) * way
    made = [totals[0] * factor * curve.motion.D, totals[1] * factor]
    like = complex_of(near.along(start, stop)[0])
    return made if abs(complex_of(made[0]) - like) < abs(complex_of(made[0]) + like) else [-x for x in made]


def _continued(square: Square, root: acb, place: acb, to: acb, halvings: int = HALVINGS) -> acb:
    """Return the root of r^2 at a place, continued from another one on the path."""
    here = square(place)[1]
    if (square(place.union(to))[1] / here).real > 0:
        return root * (square(to)[1] / here).sqrt()
    if not halvings:
        raise NotCertifiedError("not certified: a root on a path of the motion's torus changes too fast.")
    middle = (place + to) / 2
    return _continued(square, _continued(square, root, place, middle, halvings - 1), middle, to, halvings - 1)


def _zero_at(curve: Curve, place: acb) -> acb:
    """Return the zero of Psi, in a ball, that is next to a place."""
    found = []
    for zero in curve.zeros:
        away = place - zero
        n = round(float(away.imag.mid()) / float(curve.imaginary.imag.mid()))
        m = round(float((away - n * curve.imaginary).real.mid()) / float(curve.real.mid()))
        found.append(zero + m * curve.real + n * curve.imaginary)
    return min(found, key=lambda u: abs(complex_of(u - place)))


def _largest(square: Square, middle: arb, half: arb) -> list[arb]:
    """Return what (1, z)/r is at most on the ellipse about a part of a path."""
    most, left = [arb(0), arb(0)], [(k / AROUND, 1 / AROUND) for k in range(AROUND)]
    long, short = (arb(RATE).exp() + arb(-RATE).exp()) / 2, (arb(RATE).exp() - arb(-RATE).exp()) / 2
    while left:
        at, width = left.pop()
        angle = 2 * arb.pi() * arb(at + width / 2, width / 2)
        z, r2 = square(acb(middle + half * long * angle.cos(), half * short * angle.sin()))
        size = abs(r2)
        if not (size > 0 and z.is_finite() and float(size.rad()) < float(size.mid()) / 2):
            if width < FINEST:
                raise NotCertifiedError("not certified: an integrand on the motion's torus has no bound.")
            left += [(at, width / 2), (at + width / 2, width / 2)]
            continue
        for k, form in enumerate((arb(1), abs(z))):
            here = (form / size.sqrt()).upper()
            most[k] = max(most[k], here)
    return most


@lru_cache(maxsize=2)
def _rule(bits: int) -> list[tuple[arb, arb]]:
    """Return nodes and weights of Gauss's rule on (-1, 1), from the left, for so many bits."""
    nodes = ceil(bits * log(2) / (2 * RATE)) + 4
    return [arb.legendre_p_root(nodes, k, weight=True) for k in range(nodes - 1, -1, -1)]
