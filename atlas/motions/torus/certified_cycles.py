"""Integrals over cycles of a motion's curve in balls: its periods, Riemann matrix and actions, with proven radii.

A path from a zero to a zero is u = start + way (1 - cos s)/2, as in `atlas.motions.torus.approximate_periods`, and

    (D, z, v) du/eta = way (D, z, v) ds/(2 r),    eta du = way r sin(s)^2 ds/2,    r^2 = Psi(u)/sin(s)^2,

are analytic on it. Gauss's rule with n + 1 nodes is off by 64/15 M rho^-2n/(1 - rho^-2) at most on a part of length 2
(L. N. Trefethen, Approximation Theory and Approximation Practice, theorem 19.3), where M bounds the integrand on the
ellipse rho with its foci in the ends: that is enclosed by balls on the ellipse. No other zero and no pole is in it, by
a margin. The root r is continued from node to node: between two of them r^2 over its value at the first has a positive
real part. The sums of paths that make a basis of type (1,2) are taken from `atlas.motions.torus.approximate_lattice`,
where integer relations tell them.

The derivatives of eta by H, F/2 and c are D/eta, z/eta and v/eta, so that with S the integral of eta du over a cycle

    dS = T_H dH + T_F d(F/2) + T_c dc,

which a cycle of the torus has for 2 pi times its action; both vanish with the cycle.
"""

from collections.abc import Callable
from math import ceil, log
from typing import TypeAlias

import numpy as np
from flint import acb, acb_mat, arb, ctx, fmpq

from atlas.arithmetic.numbers import workprec
from atlas.errors import NotCertifiedError
from atlas.motions.torus.approximate_lattice import Lattice
from atlas.motions.torus.approximate_periods import Curve, Integrals, centre, complex_of, rule, sums, value
from atlas.motions.torus.certified_torus import Period

RATE = 1.0
"""Logarithm of the ellipse on which integrands are bounded: smaller than that which is free of other zeros."""

GUARD_BITS = 96
"""Bits more than are wanted: next to a zero Psi and sin(s)^2 lose some."""

MAX_HALVINGS = 12
"""Halvings, at most, of the way between two nodes along which a root is continued."""

Forms: TypeAlias = Callable[[acb], tuple[list[acb], acb]]
"""The forms but for way ds/(2 r), and r^2, as functions of s."""

INTEGER_TOLERANCE = 1e-9
"""Largest distance from an integer of a coefficient of a period of the torus in a basis."""

MIN_S_BITS = 40
"""Bits of s from which on the value of eta on its ball is narrow."""

MIN_PATH_PART = 2.0**-10
"""Least part of a path that is gone at once."""

ELLIPSE_BALLS, MIN_TURN_PART = 64, 2.0**-12
"""Balls on an ellipse at first, and the least part of a turn that one covers."""


def cycles(motion: Integrals, lattice: Lattice) -> list[list[acb]]:
    """Return, for each of the cycles a1, a2, b1, b2, the integrals [T_H, T_F, T_c, S] as complex balls.

    ``motion`` are the motion's `Integrals`. S, the integral of eta du, eta^2 = Psi, is 2 pi times an action, and dS
    = T_H dH + T_F d(F/2) + T_c dc. Which paths make a cycle is taken from the ``lattice``, unproved. Raises
    NotCertifiedError where an integral is not proved.
    """
    with workprec(int(ctx.prec) + GUARD_BITS):
        curve, rough = Curve(motion, proven=True), Curve(motion)
        ways = [
            _integrals(curve, rough, *path) if any(row[k] for row in lattice.weights) else [acb(0)] * 4
            for k, path in enumerate(lattice.paths)
        ]
        return sums(ways, lattice.weights)


def riemann_matrix(basis: list[list[acb]]) -> acb_mat:
    """Return the Riemann matrix tau (2, 2), complex balls, of a basis of cycles a1, a2, b1, b2, see `cycles`.

    Of the four integrals of each cycle the first two count, (T_H, T_F): as columns, (b1 b2) = (a1 a2/2) tau, with
    half of a2, for the basis is of type (1,2). Raises NotCertifiedError where the periods have too few digits.
    """
    (p, q, *_), (r, s, *_), (x, y, *_), (z, w, *_) = basis
    try:
        return acb_mat([[p, r / 2], [q, s / 2]]).solve(acb_mat([[x, z], [y, w]]))
    except ZeroDivisionError as error:
        raise NotCertifiedError("not certified: the motion's torus has periods nearly along one another.") from error


def action(basis: list[list[acb]], period: Period, c: fmpq, b: arb) -> arb:
    """Return the action of a real period of the torus, a ball in inertia/time, from a ``basis`` of cycles.

    For the basis see `cycles`. ``c`` is (M, K), ``b`` the length of the field. Cycles that go otherwise round the
    pole of eta du, where its residue is c/b, turn by n whole turns more about the field, and have n c/b more: T_c
    tells n. Raises NotCertifiedError where it is not certain which cycle the period is.
    """
    places = np.array([[f(complex_of(x)) for x in row[:2] for f in (np.real, np.imag)] for row in basis])
    times = np.array([float(period.H.mid()), 0.0, float(period.F.mid()), 0.0])
    weights = np.linalg.solve(places.T, times)
    integers = [[round(x) for x in weights.tolist()]]
    ((T_H, T_F, T_c, S),) = sums(basis, integers)
    turn = 2 * arb.pi()
    turns = ((-b * T_c.real - period.angle) / turn).unique_fmpz()
    is_same_cycle = (
        abs(weights - integers[0]).max() < INTEGER_TOLERANCE
        and T_H.real.overlaps(period.H)
        and T_F.real.overlaps(period.F)
    )
    if turns is None or not is_same_cycle:
        raise NotCertifiedError("not certified: it is not certain which cycle of the curve a period of the torus is.")
    return S.real / turn + turns * arb(c) / b


def _integrals(curve: Curve, rough: Curve, start: acb, stop: acb, like: acb) -> list[acb]:
    """Return four complex balls: -2i times the integrals of (D, z, v) du/eta and eta du between two zeros.

    Here eta^2 = Psi, see the module. The zeros are those next to the places ``start`` and ``stop``; ``rough`` is
    the same curve without radii. The sign of all four is the one for which the first is nearer to ``like`` than to
    its negative. Raises NotCertifiedError where an integrand has no bound.
    """
    start_zero, stop_zero, D, c = _zero_at(curve, start), _zero_at(curve, stop), curve.motion.D, curve.motion.c
    g, dg, dP = curve.g, curve.g.derivative(), curve.motion.P.derivative()
    way, totals = stop_zero - start_zero, [acb(0)] * 4

    def values(s: acb) -> tuple[acb, acb, acb]:
        early = complex_of(s).real < 1.6  # a place next to either end is known relative to its distance from that
        z, v = curve.at(start_zero + way * (s / 2).sin() ** 2 if early else stop_zero - way * (s / 2).cos() ** 2)
        return z, v, value(g, z) + 2 * c * v

    def forms(s: acb) -> tuple[list[acb], acb]:
        z, v, eta = values(s)
        if not s.rel_accuracy_bits() > MIN_S_BITS:  # by the mean value: z and v are of one u
            middle = centre(s)
            eta = values(middle)[2] + 2 * (v * value(dg, z) + c * value(dP, z)) * way * (
                ((s + middle) / 2).sin() * ((s - middle) / 2).sin()
            )
        return [acb(D), z, v, eta], eta / s.sin() ** 2

    root, place, intervals = acb(0), acb(0), list(rough.intervals(start, stop))[::-1]
    nodes = rule(ceil(ctx.prec * log(2) / (2 * RATE)) + 4, int(ctx.prec))
    while intervals:
        low, high = intervals.pop()
        middle, half = arb.pi() * (low + high) / 2, arb.pi() * (high - low) / 2
        largest = _largest(forms, middle, half)
        if largest is None:
            if high - low < MIN_PATH_PART:
                raise NotCertifiedError("not certified: an integrand on the motion's torus has no bound.")
            intervals += [((low + high) / 2, high), (low, (low + high) / 2)]
            continue
        terms = [acb(0)] * 4
        for x, weight in nodes:
            s = acb(middle + half * x)
            numerators, r2 = forms(s)
            root, place = _root(r2) if root == 0 else _continued(forms, root, place, s), s
            terms = [total + weight * form / root for total, form in zip(terms, numerators, strict=True)]
        for k, bound in enumerate(largest):
            remainder = arb(64) / 15 * bound * arb(-2 * RATE * (len(nodes) - 1)).exp() / (1 - arb(-2 * RATE).exp())
            totals[k] += half * (terms[k] + acb(arb(0, remainder.upper()), arb(0, remainder.upper())))
    totals = [x * acb(0, -1) * way for x in totals]
    return totals if abs(complex_of(totals[0] - like)) < abs(complex_of(totals[0] + like)) else [-x for x in totals]


def _root(square: acb) -> acb:
    """Return a square root of a complex ball, continuous across the negative real axis.

    There the library's root has its cut; the cut of this one is elsewhere.
    """
    return square.sqrt() if square.real > 0 else acb(0, 1) * (-square).sqrt()


def _continued(forms: Forms, root: acb, place: acb, to: acb, halvings: int = MAX_HALVINGS) -> acb:
    """Return the root r of r^2 at `to`, a complex ball, continued along the straight path from its value at `place`.

    ``root`` is that value, and ``forms`` returns (numerators, r^2) at a place. Raises NotCertifiedError where the root
    changes too fast for so many ``halvings`` of the path.
    """
    square = forms(place)[1]
    if (forms(place.union(to))[1] / square).real > 0:
        return root * (forms(to)[1] / square).sqrt()
    if not halvings:
        raise NotCertifiedError("not certified: a root on a path of the motion's torus changes too fast.")
    middle = (place + to) / 2
    return _continued(forms, _continued(forms, root, place, middle, halvings - 1), middle, to, halvings - 1)


def _zero_at(curve: Curve, place: acb) -> acb:
    """Return the zero of Psi on ``curve``, shifted by periods, that is nearest to a ``place`` u, a complex ball."""
    places = [zero + away - curve.in_cell(away) for zero in curve.zeros for away in (centre(place) - zero,)]
    return min(places, key=lambda u: abs(complex_of(u - place)))


def _largest(forms: Forms, middle: arb, half: arb) -> list[arb] | None:
    """Return bounds on the four forms divided by r on the ellipse about an interval of a path, a list of four balls.

    ``forms`` returns (numerators, r^2); ``middle`` and ``half`` are the interval's midpoint and half its length.
    None if r may be zero there.
    """
    maxima, remainder = [arb(0)] * 4, [(k / ELLIPSE_BALLS, 1 / ELLIPSE_BALLS) for k in range(ELLIPSE_BALLS)]
    long, short = (arb(RATE).exp() + arb(-RATE).exp()) / 2, (arb(RATE).exp() - arb(-RATE).exp()) / 2
    while remainder:
        place, width = remainder.pop()
        angle = 2 * arb.pi() * arb(place + width / 2, width / 2)
        numerators, r2 = forms(acb(middle + half * long * angle.cos(), half * short * angle.sin()))
        size = abs(r2)
        if not (size > 0 and numerators[1].is_finite() and float(size.rad()) < float(size.mid()) / 2):
            if width < MIN_TURN_PART:
                return None
            remainder += [(place, width / 2), (place + width / 2, width / 2)]
            continue
        maxima = [max(x, (abs(form) / size.sqrt()).upper()) for x, form in zip(maxima, numerators, strict=True)]
    return maxima
