"""Scalars of every family against formulas typed anew in mpmath, which shares no code with the package.

`cd tests && python -m stress.scalars --samples 300 --seed 7` draws so many inputs of each kind, hostile and ordinary,
and prints how many values of each scalar were compared and the worst error in ulps of its size; the exit status is 1
where one exceeds 4, which the package promises for sizes from 1e-140 to 1e140.
"""

import argparse
import sys
from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from math import gcd
from random import Random
from typing import Any

import click
import numpy as np
from mpmath import mp, mpf
from oracles import closed_form
from oracles.nutation import Nutation, nutation

import atlas
from atlas.errors import AtlasError
from stress import extreme
from stress.elliptic import ELLIPTIC
from stress.regimes import GENERAL, REGIMES
from stress.tops import TOPS
from stress.worst import WorstErrors

PROMISED = 4.0
EDGE = 1e-140, 1e140
"""Sizes between which a scalar is promised; others are left out."""

Comparisons = Iterator[tuple[str, Any, Any]]


def of_motion(random: Random, regime: str) -> Comparisons:
    """Elementary motions, their hyperbola and quadric: (53), (54), (67), (71), (72), (79), theorem-stability."""
    m = extreme.motion(regime, random)
    I, B2, B3, w2 = mpf(m.I3) / mpf(m.I2), mpf(m.B2), mpf(m.B3), mpf(m.omega2)
    motion, field = atlas.ElementaryMotion(m.ratio, (m.B2, m.B3), m.omega2, m.omega3), (m.B2, m.B3)
    true = closed_form.elementary(m.I2, m.I3, m.B2, m.B3, m.omega2, m.omega3)
    yield from (("omega3", motion.omega3, true.omega3), ("k", motion.k, true.k), ("phi", motion.phi, true.phi))
    if true.k:
        yield "period", motion.period, 2 * mp.pi / abs(true.k)
    quadric = atlas.Quadric(m.ratio, field)
    shape = closed_form.quadric(m.I2, m.I3, m.B2, m.B3)
    yield from (("beta", quadric.beta, shape.beta), ("a2", quadric.a2, shape.a2), ("a3", quadric.a3, shape.a3))
    yield "semi-axes", quadric.semi_axes, [mp.sqrt(abs(x)) for x in shape.squares]
    if m.omega3 is None:
        curve, X = atlas.Hyperbola(m.ratio, field), w2 + B2
        k, phi = curve.frequencies(m.omega2)
        yield from (("hyperbola omega3", curve.omega3(m.omega2), true.omega3), ("hyperbola k", k, true.k))
        yield "hyperbola phi", phi, true.phi
        square = (B3 / B2) ** 2 * (X**2 + (1 - I) * B2**2) ** 2 / X**2 + X**2 - (1 - I) * B2**2
        yield "stability", curve.stability(m.omega2), square
        b = mp.sqrt(B2**2 + B3**2)
        yield "least stability", curve.least_stability, 2 * abs(1 - I) * abs(B3) * b - (1 - I) * (B2**2 - 2 * B3**2)


def of_closed(random: Random, regime: str) -> Comparisons:
    """Motions that close: by (72) and (79), phi/k = L (x + 2)/(I b (x + 1)) with L = (1 - I) B3 and x = omega2/B2."""
    m = extreme.motion(regime, random)
    p, q = random.choice((-7, -2, -1, 1, 2, 3, 355)), random.choice((1, 2, 3, 5, 113))
    curve, I, B2, B3 = atlas.Hyperbola(m.ratio, (m.B2, m.B3)), mpf(m.I3) / mpf(m.I2), mpf(m.B2), mpf(m.B3)
    L, turns, b = (1 - I) * B3, I * p * mp.sqrt(B2**2 + B3**2) / q, mp.sqrt(B2**2 + B3**2)
    closed, x = curve.closed(p, q), (turns - 2 * L) / (L - turns)
    k = x * b
    third = B3 * x * (x + 2 - I) / (I * (x + 1))
    yield from (("closed omega2", closed.omega2, x * B2), ("closed omega3", closed.omega3, third))
    yield from (("closed k", closed.k, k), ("closed phi", closed.phi, k * p / q))
    yield "closed period", closed.period, 2 * mp.pi * mpf(q // gcd(p, q)) / abs(k)


def of_flight(random: Random, _: str) -> Comparisons:
    """Points of a body in flight, one in ten since its oracle is slow, in ulps of the way that they may have gone."""
    m = extreme.motion("ordinary", random)
    if random.random() > 0.1:
        return
    mu, E = random.choice((1.0, -2.0)), [random.uniform(-1, 1) for _ in range(3)]
    B = [0.0, 2 * m.B2 / mu, 2 * m.B3 / mu]
    start, launch, point = ([random.uniform(-1, 1) for _ in range(3)] for _ in range(3))
    body = atlas.ElementaryMotion(m.ratio, (m.B2, m.B3), m.omega2, m.omega3)
    flight, t = atlas.Flight(atlas.ParticleMotion(mu, E, B, start, launch), body, point), random.uniform(-20, 20)
    R = closed_form.elementary_rotation(m.I2, m.I3, m.B2, m.B3, m.omega2, t, m.omega3)
    true = closed_form.particle(mu, E, B, start, launch, t).y
    true = [y + mp.fdot(R[i, :], point) for i, y in enumerate(true)]
    reach = sum(map(abs, (*start, *point))) + abs(t) * (sum(map(abs, launch)) + abs(t * mu) * sum(map(abs, E)))
    yield (
        "flight position",
        [reach] * 3,
        [reach + x - mpf(float(y)) for x, y in zip(true, flight.position(t), strict=True)],
    )


def of_free(random: Random, _: str) -> Comparisons:
    """Free bodies, (87)."""
    m = extreme.free_motion(random)
    I, (w1, w2, w3) = mpf(m.I), map(mpf, m.omega)
    motion, k = atlas.FreeMotion(m.I, m.omega), mp.sqrt(w1**2 + w2**2 + (I * w3) ** 2)
    yield from (("free k", motion.k, k), ("free phi", motion.phi, (1 - I) * w3))
    if k:
        yield "free period", motion.period, 2 * mp.pi / k


def of_ball(random: Random, _: str) -> Comparisons:
    """Charged balls, (29)."""
    m = extreme.ball_motion(random)
    motion = atlas.BallMotion(m.inertia, m.larmor, (m.m2, m.m3))
    true = closed_form.ball(m.inertia, m.larmor, m.m2, m.m3)
    yield from (("ball gamma", motion.gamma, true.gamma), ("ball k_hat", motion.k_hat, (true.k2, true.k3)))


def of_particle(random: Random, _: str) -> Comparisons:
    """Point charges, (94), (97): the radius is that of the velocity without the drift."""
    m = extreme.particle_motion(random)
    motion = atlas.ParticleMotion(m.mu, m.E, m.B, m.position, m.velocity, m.c)
    E, B, v = ([mpf(x) for x in vector] for vector in (m.E, m.B, m.velocity))
    b, c = mp.sqrt(mp.fdot(B, B)), mpf(m.c)
    yield "cyclotron frequency", motion.cyclotron_frequency, mpf(m.mu) * b / c
    if b:
        drift = [c * x / b**2 for x in _cross(E, B)]
        radial = _cross([x - y for x, y in zip(v, drift, strict=True)], B)
        yield "drift", motion.drift, drift
        yield "radius", motion.radius, mp.sqrt(mp.fdot(radial, radial)) * c / (abs(mpf(m.mu)) * b**2)
        yield "particle period", motion.period, 2 * mp.pi * c / (abs(mpf(m.mu)) * b)


def of_elliptic(random: Random, regime: str) -> Comparisons:
    """Elliptic motions, theorem-elliptic and theorem-splitting; K turns by Euler's equations with v/(z I_i + D)."""
    m = ELLIPTIC[regime](random)
    motion = atlas.EllipticMotion(*m)
    I, K, z = [mpf(x) for x in m.inertia], [mpf(x) for x in m.field], mpf(m.z)
    D = I[0] * I[1] * I[2]
    x = [z + D / moment for moment in I]
    v = m.branch * mp.sqrt(x[0] * x[1] * x[2])
    yield from (("elliptic v", motion.v, v),)
    yield "elliptic omega", motion.omega, [-(1 + v / (z * moment + D)) * k for moment, k in zip(I, K, strict=True)]
    pairs = ((i, x[i - 2], x[i - 1]) for i in range(3))
    C = sum(K[i] ** 2 / x[i] * (x[i] * (y + w) - y * w) ** 2 for i, y, w in pairs)
    yield "elliptic splitting", motion.splitting, C / D**2
    e = sorted((v / (z * moment + D), k) for moment, k in zip(I, K, strict=True))
    (e_last, _), (middle, _), (e_first, _) = e
    low = sum((moment - e_last) * k**2 for moment, k in e) * (e_first - middle)
    high = sum((e_first - moment) * k**2 for moment, k in e) * (middle - e_last)
    if low != high and low and high and motion.period < mp.inf:
        modulus = min(low, high) / max(low, high)
        yield "elliptic period", motion.period, 4 * mp.ellipk(modulus) / mp.sqrt(max(low, high))


def of_top(random: Random, regime: str) -> Comparisons:
    """Tops, by the integrals of the energy, of M3 and of (M, n) over a nutation."""
    m = TOPS[regime](random)
    motion, true = atlas.TopMotion(*m), nutation(*m)
    if true is not None:
        yield "top turning points", motion.turning_points, true.turning_points
        yield from _turns("top", motion, true)


def of_general(random: Random, regime: str) -> Comparisons:
    """General motions: a top whose M is II (Omega + K), without a potential."""
    I, field, omega = GENERAL[regime](random)
    b = mp.sqrt(mp.fdot(map(mpf, field), map(mpf, field)))
    motion, true = atlas.GeneralMotion(I, field, omega), nutation((1, I), (b, b * I), field, omega, 0, 0) if b else None
    if true is not None:
        third = mpf(omega[2]) + mpf(field[1])
        yield "general turning points", motion.turning_points, [third - b * nu for nu in true.turning_points[::-1]]
        yield from _turns("general", motion, true)


def _turns(name: str, motion: Any, true: Nutation) -> Comparisons:
    yield f"{name} period", motion.period, true.period
    if true.precession is not None and true.spin is not None:
        yield f"{name} precession per period", motion.precession_per_period, true.precession
        yield f"{name} precession rate", motion.precession_rate, true.precession / true.period
        yield f"{name} spin per period", motion.spin_per_period, true.spin
        yield f"{name} spin rate", motion.spin_rate, true.spin / true.period


def _cross(x: Sequence[Any], y: Sequence[Any]) -> list[Any]:
    return [x[i - 2] * y[i - 1] - x[i - 1] * y[i - 2] for i in range(3)]


KINDS: tuple[tuple[Callable[[Random, str], Comparisons], Sequence[str], int], ...] = (
    (of_motion, [*REGIMES], 1000),
    (of_closed, [*REGIMES], 1000),
    (of_flight, ["flight"], 60),
    (of_free, ["free"], 1000),
    (of_ball, ["ball"], 1000),
    (of_particle, ["particle"], 1000),
    (of_elliptic, [*ELLIPTIC], 1000),
    (of_top, [*TOPS], 400),
    (of_general, [*GENERAL], 400),
)
"""Functions that draw and compare, regimes in turn, and digits at which nothing that doubles hold cancels."""


def compare(values: Any, true: Any) -> list[float]:
    """Return errors in ulps, of each number in ulps of itself; numbers outside the doubles' range are left out."""
    errors = []
    for value, exact in zip(np.ravel(values), true if isinstance(true, list | tuple) else (true,), strict=True):
        size = abs(exact)
        if size == 0:
            errors.append(0.0 if value == 0 else float("inf"))
        elif EDGE[0] < size < EDGE[1]:
            unit = Fraction(float(np.spacing(float(size))))
            errors.append(float(abs(mpf(float(value)) - exact) / (mpf(unit.numerator) / unit.denominator)))
    return errors


def main() -> int:
    """Compare, and print each scalar with the worst regime and input."""
    parser = argparse.ArgumentParser(prog="stress.scalars", description=__doc__.partition("\n")[0])
    parser.add_argument("--samples", type=int, default=300)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--only", default="")
    options = parser.parse_args()
    worst, refused = WorstErrors(), dict[str, int]()
    for kind, regimes, digits in KINDS:
        if options.only not in kind.__name__:
            continue
        for number in range(options.samples):
            regime = regimes[number % len(regimes)]
            seed = f"scalars {kind.__name__} {options.seed} {number}"
            with mp.workdps(digits):
                try:
                    for name, value, true in kind(Random(seed), regime):  # noqa: S311  reproducible, not secret
                        worst.add(name, regime, compare(value, true), lambda _, seed=seed: {"seed": seed})
                except AtlasError as reason:
                    refused[str(reason)[:60]] = refused.get(str(reason)[:60], 0) + 1
    broken = False
    for name in dict.fromkeys(name for name, _ in worst.worst):
        rows = [largest for largest in worst.worst.values() if largest.quantity == name]
        largest, count = max(rows, key=lambda row: row.ulps), sum(row.samples for row in rows)
        broken |= not largest.ulps <= PROMISED
        click.echo(f"{name:28} {count:7} {largest.ulps:9.3g} ulp  {largest.regime}: {largest.input['seed']}")
    for reason, count in refused.items():
        click.echo(f"refused {count} times: {reason}")
    return int(broken)


if __name__ == "__main__":
    sys.exit(main())
