"""A nutation of a symmetric top in mpmath: turning points, period and turns from integrals, without theta functions.

With M3 and p = (M, n), (I2 nu')^2 = I2 (2E - (M3 - k3 nu)^2/I3 - 2 a nu - A nu^2)(1 - nu^2) - s^2 = P(nu), where
s = p - M3 nu - k2 (1 - nu^2); the axis turns about n at s/(I2 (1 - nu^2)), and the body about its axis at
(M3 - k3 nu)/I3 - nu s/(I2 (1 - nu^2)).
"""

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Any, NamedTuple

from mpmath import mp, mpf

MOST = 1024
"""Points of an integral over half a nutation, beyond which it is left out."""


class Nutation(NamedTuple):
    """Least and largest nu, the time between them twice, and the turns about n and about the axis in it."""

    turning_points: tuple[mpf, mpf]
    period: mpf
    precession: mpf | None
    spin: mpf | None


def nutation(
    inertia: Sequence[Any], coupling: Sequence[Any], direction: Sequence[Any], omega: Sequence[Any], a: Any, A: Any
) -> Nutation | None:
    """Return the nutation of a top as `atlas.TopMotion` takes it, to some digits fewer than those of mpmath now.

    None where its ends fall together, with one another or with other roots; no turns where the axis passes next to n,
    and where their integrals need too many points.
    """
    (I2, I3), (k2, k3), n, w = (list(map(mpf, x)) for x in (inertia, coupling, direction, omega))
    size = mp.sqrt(mp.fdot(n, n))
    n2, n3, a, A = n[0] / size, n[1] / size, mpf(a), mpf(A)
    M3 = I3 * w[2] + k3 * n3
    p = (I2 * w[1] + k2 * n2) * n2 + M3 * n3
    energy = I2 * (w[0] ** 2 + w[1] ** 2) + I3 * w[2] ** 2 + 2 * a * n3 + A * n3**2
    s = [k2, -M3, p - k2]
    kinetic = [-(k3**2) / I3 - A, 2 * M3 * k3 / I3 - 2 * a, energy - M3**2 / I3]
    P = [I2 * x - y for x, y in zip(_product(kinetic, [-1, 0, 1]), _product(s, s), strict=True)]
    P = P[next((i for i, x in enumerate(P) if abs(x) > max(map(abs, P)) * mpf(10) ** (20 - mp.dps)), 5) :]
    interval = _ends(P, n3) if len(P) > 3 else None
    if interval is None:
        return None
    low, high, roots = interval
    mean = _mean(low, high, roots)
    if not mean:
        return None

    def turn(nu: mpf) -> mpf:
        return mp.polyval(s, nu) / (1 - nu * nu) / I2

    def twist(nu: mpf) -> mpf:
        return (M3 - k3 * nu) / I3 - nu * turn(nu)

    is_bounded = low > -1 and high < 1
    turns = [_over(rate, low, high, P[0], roots) if is_bounded else None for rate in (turn, twist)]
    period = 2 * mp.pi / mean / mp.sqrt(abs(P[0]))
    return Nutation((low, high), I2 * period, *(x and I2 * x for x in turns))


def _ends(P: list[mpf], start: mpf) -> tuple[mpf, mpf, list[Any]] | None:
    """Return the roots about `start` between which P is positive, and the others."""
    tiny = mpf(10) ** -(mp.dps // 3)
    try:
        roots = mp.polyroots(P, maxsteps=300, extraprec=mp.prec)
    except mp.NoConvergence:  # roots that fall together
        return None
    roots = [mp.re(x) if abs(mp.im(x)) < tiny else x for x in roots]
    real = sorted(x for x in roots if mp.im(x) == 0)
    ends = [(x, y) for x, y in pairwise(real) if x - tiny <= start <= y + tiny and mp.polyval(P, (x + y) / 2) > 0]
    if len(ends) != 1 or ends[0][1] - ends[0][0] < mpf(10) ** -15:
        return None
    return *ends[0], sorted(roots, key=lambda x: min(abs(x - end) for end in ends[0]))[2:]


def _mean(low: mpf, high: mpf, roots: list[Any]) -> mpf:
    """Return Gauss' mean M for which the integral of 1/sqrt|(x - low)(high - x) ...| is pi/M."""
    if len(roots) == 1:
        return mp.agm(mp.sqrt(abs(low - roots[0])), mp.sqrt(abs(high - roots[0])))
    c, d = roots
    u, v = mp.sqrt((low - c) * (high - d)), mp.sqrt((low - d) * (high - c))
    if mp.im(c) == 0:
        return mp.agm(abs(u), abs(v))
    return mp.agm(abs(mp.re(u)), abs(u))


def _over(rate: Callable[[mpf], mpf], low: mpf, high: mpf, leading: mpf, roots: list[Any]) -> mpf | None:
    """Integrate 2 rate/sqrt(P) over nu, by equal steps of an angle of which nu is the cosine."""

    def value(angle: mpf) -> mpf:
        nu = (low + high) / 2 - (high - low) / 2 * mp.cos(angle)
        return rate(nu) / mp.sqrt(abs(mp.fprod([leading, *(nu - x for x in roots)])))

    count, before = 16, None
    total = (value(mpf(0)) + value(mp.pi)) / 2 + sum(value(mp.pi * j / count) for j in range(1, count))
    while count < MOST:
        total += sum(value(mp.pi * (j + mpf(1) / 2) / count) for j in range(count))
        count *= 2
        if before is not None and abs(total / count - before) <= abs(before) * mpf(10) ** -24:
            return 2 * mp.pi * total / count
        before = total / count
    return None


def _product(x: Sequence[Any], y: Sequence[Any]) -> list[Any]:
    coefficients = [mpf(0)] * (len(x) + len(y) - 1)
    for i, factor in enumerate(x):
        for j, factor_other in enumerate(y):
            coefficients[i + j] += factor * factor_other
    return coefficients
