"""What theta functions make of one motion, proved for it: a bound on their error over the torus, so at any time.

Nothing is taken from their theory. K, M and N of the closed form are quotients k/d, m/d, exp(i lambda T) n/d of finite
sums of exponentials in the times T = (t, g) of the flows of H and F/2, with known numbers as weights; times reduced
modulo the proved periods lie in a parallelogram about the start. There

    d k' - k d' - [k, w],    d m' - m d' - [m, w] - [k, II k],    d n' - n d' - [n, w]      (w = II^-1 m; for H)

and those for F are again such sums: their weights, whole numbers here, are computed without an error, and so is a bound
on their size. A lower bound on |d| makes of it what the quotients miss in the equations of motion. With (M, s K),
errors of M and K grow by exp(mu_H |t| + mu_F |g|) at most, where on the level of H, F and the Casimirs

    mu = (p + sqrt(p^2 + q^2))/2,    p_H = |M| max(A_i - A_j)/2,    q_H = b (max(I_i - I_j)/s + s max A_i),
                                     p_F = 0,                       q_F = b (D max(A_i - A_j)/s + s),

A = II^-1: of what a flow makes of an error turns add nothing to its length. An error of N does not grow at all.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import ceil, exp, frexp, hypot, inf, log, sqrt
from typing import TypeAlias

import numpy as np
from flint import acb, arb, fmpq, fmpz, fmpz_poly
from numpy.typing import NDArray

from atlas.errors import NotCertifiedError
from atlas.exact.clebsch_periods import BITS, Integrals, centre, complex_of
from atlas.exact.clebsch_theta import ThetaMotion
from atlas.exact.theta_sums import needed
from atlas.exact.torus import Period
from atlas.formulas.numbers import workprec

HALF = 0.55
"""Phases of a reduced time, in turns: half a turn, and what rounding may add to it near the longest times."""

FINE = 320
"""Binary digits of the numbers in the equations of motion."""

LEFT_OUT = 120.0
"""Logarithm of what terms that are left out are smaller by than the largest one."""

SAFE = 1.01
"""Factor for the rounding of bounds in doubles, and for what errors change of the numbers that bound their growth."""

FIRST, MOST = 16, 200_000
"""Cells along each phase, and small ones in all, in which |d| is to vary by half at most."""

EDGES = np.linspace(-HALF, HALF, FIRST + 1)
POINTS = np.stack(np.meshgrid(EDGES, EDGES, indexing="ij")).reshape(2, -1)
"""Corners of the cells, in turns."""

FLOATS = 1e-12
"""Bound on rounding errors of a sum of exponentials in doubles, as a part of the sum of their sizes."""

SCALES = np.exp(np.linspace(-4, 4, 81))
"""Values of s that are tried."""

LONGEST = 300.0
"""Largest exponent of the growth of errors that is looked at."""

CYCLE = ((1, 2), (2, 0), (0, 1))

Floats: TypeAlias = NDArray[np.float64]
Complexes: TypeAlias = NDArray[np.complex128]
Powers: TypeAlias = NDArray[np.int64]


@dataclass(frozen=True)
class Bounds:
    """Bounds on what K, W and N of the closed form are wrong by at any time, in the units of the torus."""

    K: float
    W: float
    N: float


@dataclass(frozen=True)
class Whole:
    """A polynomial of two variables with complex whole weights, one variable being a high power of the other."""

    real: fmpz_poly
    imag: fmpz_poly

    def __add__(self, other: "Whole") -> "Whole":
        return Whole(self.real + other.real, self.imag + other.imag)

    def __sub__(self, other: "Whole") -> "Whole":
        return Whole(self.real - other.real, self.imag - other.imag)

    def __mul__(self, other: "Whole") -> "Whole":
        first, second = self.real * other.real, self.imag * other.imag
        return Whole(first - second, (self.real + self.imag) * (other.real + other.imag) - first - second)

    def times(self, x: acb) -> "Whole":
        """Return the product with a number in units of 2^-FINE, rounded to a whole one."""
        a, b = (fmpz(_whole(part * arb(2) ** FINE)) for part in (x.real, x.imag))
        return Whole(self.real * a - self.imag * b, self.real * b + self.imag * a)

    def weighted(self, weights: Powers) -> "Whole":
        """Return the polynomial with each weight times a whole number."""
        whole = weights.tolist()
        parts = ([x * n for x, n in zip(part.coeffs(), whole, strict=False)] for part in (self.real, self.imag))
        return Whole(*map(fmpz_poly, parts))

    def total(self) -> acb:
        """Return the sum of the weights."""
        return acb(arb(self.real(1)), arb(self.imag(1)))

    def weights(self, count: int, shift: int = 0) -> Complexes:
        """Return so many weights over 2^shift, without what is then behind the point."""
        found = np.zeros(count, complex)
        for part, unit in ((self.real, 1.0), (self.imag, 1j)):
            whole = [float(int(x) >> shift) for x in part.coeffs()]
            found[: len(whole)] += unit * np.array(whole)
        return found


Pairs = list[tuple[Whole, Whole]]


class Quotients:
    """Numerators n, k, m and the denominator d with whole weights, in units of 2^-bits of the largest.

    Their exponentials grow over the torus, by the more bits there are.
    """

    def __init__(self, theta: ThetaMotion, periods: tuple[Period, Period]) -> None:
        X, l, start = theta.X.inv(), theta.l, theta.start
        self.motion, self.start = theta.motion, theta.at_start
        self.rates = [[centre(X[0, j] * 2), centre(X[1, j])] for j in range(2)]
        self.turning = [centre(l[0] * X[0, j] + l[1] * X[1, j]) for j in range(2)]
        self.times = np.array([[float(p.H.mid()), float(p.F.mid())] for p in periods]).T
        self.into = np.pi * np.array([[complex_of(x) for x in row] for row in self.rates]).T @ self.times
        forms, origin = theta.forms, (2 * start[0], start[1])
        places = needed(theta.hat, forms, origin, self.into @ POINTS, LEFT_OUT)
        self.low, self.high = places.min(axis=0), places.max(axis=0)
        self.row = 2 * int(self.high[1] - self.low[1] + 1)
        terms = [list(form.terms(theta.hat, origin, places.tolist())) for form in forms]
        growth = float(abs(places @ (self.into @ POINTS).imag).max())
        self.bits = BITS + ceil(growth / log(2))
        unit = arb(2) ** (self.bits - frexp(max(abs(complex_of(x)) for row in terms for _, _, x in row))[1])
        whole = [self._whole(row, unit) for row in terms]
        self.n, self.d, self.k, self.m = whole[:3], whole[3], whole[4:7], whole[7:]
        self.size = np.max([self._most(x, 1) for x in whole], axis=0)
        self.least = self._least()

    def _whole(self, terms: Iterable[tuple[int, int, acb]], unit: arb) -> Whole:
        real, imag = ([0] * (self.row * int(self.high[0] - self.low[0] + 1)) for _ in range(2))
        for P, Q, weight in terms:
            place = int(P - self.low[0]) * self.row + int(Q - self.low[1])
            real[place], imag[place] = _whole((weight * unit).real), _whole((weight * unit).imag)
        return Whole(fmpz_poly(real), fmpz_poly(imag))

    def powers(self, n: int) -> Powers:
        """Return P and Q of all weights of a product of n sums, (2, terms)."""
        rows = n * int(self.high[0] - self.low[0]) + 1
        return np.asarray(np.array(np.divmod(np.arange(rows * self.row), self.row)) + n * self.low[:, None])

    def _most(self, x: Whole, n: int, shift: int = 0) -> Floats:
        """Return a bound on a product of n sums over 2^shift at the corners of cells; inside, it is convex."""
        powers = self.powers(n)
        sizes = abs(x.weights(powers.shape[1], shift))
        kept = sizes > 0  # those that lost less than a unit to the shift are added below
        found = (sizes[kept] + 2) @ np.exp(-powers[:, kept].T @ (self.into @ POINTS).imag)
        return np.asarray(SAFE * found * 2.0**-self.bits)

    def residuals(self) -> list[dict[str, float]]:
        """Return bounds on what N, K and M miss in the equations of the flows of H and of F/2."""
        I, n, k, m = self.motion.moments, self.n, self.k, self.m
        A, J, one = [1 / x for x in I], [-self.motion.D / x for x in I], [fmpq(1)] * 3
        n_m, k_m = ([(x[j] * m[l], x[l] * m[j]) for j, l in CYCLE] for x in (n, k))
        k_k, m_m = ([(p, p) for p in (x[j] * x[l] for j, l in CYCLE)] for x in (k, m))
        slopes = {name: [self._slopes(x) for x in rows] for name, rows in (("N", n), ("K", k), ("M", m))}
        laws: list[dict[str, list[tuple[Pairs, Sequence[fmpq]]]]] = [
            {"N": [(n_m, A)], "K": [(k_m, A)], "M": [(m_m, A), (k_k, I)]},
            {"N": [(n_m, one)], "K": [(k_m, one)], "M": [(k_k, J)]},
        ]
        return [{name: self._missed(slopes[name], law[name], name, j) for name in law} for j, law in enumerate(laws)]

    def _slopes(self, x: Whole) -> tuple[Whole, Whole, Whole]:
        """Return x d, and d dx - x dd for the derivatives that bring P and Q down."""
        product, pairs = x * self.d, zip(self.powers(1), self.powers(2), strict=True)
        first, second = (x.weighted(2 * once) * self.d - product.weighted(both) for once, both in pairs)
        return product, first, second

    def _missed(
        self, slopes: list[tuple[Whole, Whole, Whole]], terms: list[tuple[Pairs, Sequence[fmpq]]], name: str, flow: int
    ) -> float:
        """Return a bound on the length of what one of N, K and M misses in one flow."""
        i_pi, rates, reach = acb(0, 1) * arb.pi(), self.rates[flow], float(abs(self.powers(1)).max())
        turning = acb(0, 1) * self.turning[flow] if name == "N" else acb(0)
        factor = np.exp(-(np.array([complex_of(x) for x in self.turning]) @ self.times @ POINTS).imag * (name == "N"))
        found, rounding = np.zeros(POINTS.shape[1]), (8 * reach + 5) * self.size**2 / 2.0**FINE
        for i, (j, l) in enumerate(CYCLE):
            product, first, second = slopes[i]
            rest = first.times(i_pi * rates[0]) + second.times(i_pi * rates[1]) + product.times(turning)
            for pairs, c in terms:
                x, y = pairs[i]
                rest = rest - x.times(acb(c[l])) + y.times(acb(c[j]))
            found = np.hypot(found, (self._most(rest, 2, FINE + self.bits) + rounding) * factor)
        at = found.reshape(FIRST + 1, FIRST + 1)
        corners = np.max([at[:-1, :-1], at[1:, :-1], at[:-1, 1:], at[1:, 1:]], axis=0)
        return float((SAFE * corners / self.least**2).max())

    def defects(self) -> dict[str, float]:
        """Return bounds on what is wrong of N, K and M at the start."""
        d, start = self.d.total(), self.start
        triples = {"N": (self.n, start.N), "K": (self.k, start.K), "M": (self.m, start.M)}
        return {
            name: SAFE * hypot(*(float((x.total() / d - y).abs_upper()) for x, y in zip(found, true, strict=True)))
            for name, (found, true) in triples.items()
        }

    def _least(self) -> Floats:
        """Return a lower bound on |d| in each cell, in units; where it varies much they are cut in four."""
        powers = self.powers(1)
        weights = self.d.weights(powers.shape[1])
        slopes = 1j * powers[:, weights != 0].T @ self.into
        weights, half, total = weights[weights != 0], HALF / FIRST, 0
        least, owner = np.full(FIRST**2, np.inf), np.arange(FIRST**2)
        line = EDGES[:-1] + half
        cells = np.stack(np.meshgrid(line, line, indexing="ij"), -1).reshape(-1, 2)
        while len(cells):
            total += len(cells)
            if total > MOST:
                raise NotCertifiedError("not certified: a denominator is too small somewhere on the motion's torus.")
            terms = weights * np.exp(cells @ slopes.T)
            value = abs(terms.sum(axis=1))
            change = abs(terms) @ (np.expm1(half * abs(slopes).sum(axis=1)) + FLOATS)
            good = change < value / 2
            np.minimum.at(least, owner[good], (value - change)[good])
            half /= 2
            cells = (cells[~good][:, None] + half * np.array([[1, 1], [1, -1], [-1, 1], [-1, -1]])).reshape(-1, 2)
            owner = np.repeat(owner[~good], 4)
        return least.reshape(FIRST, FIRST) / SAFE * 2.0**-self.bits


def bounds(theta: ThetaMotion, periods: tuple[Period, Period]) -> Bounds:
    """Return bounds on the errors of the closed form at any time; NotCertifiedError where there are none."""
    with workprec(BITS):
        quotients = Quotients(theta, periods)
    with workprec(FINE + BITS):
        missed, start = quotients.residuals(), quotients.defects()
        return _grown(theta.motion, missed, start, HALF * abs(quotients.times).sum(axis=1) * SAFE, periods)


def _grown(
    motion: Integrals,
    missed: list[dict[str, float]],
    start: dict[str, float],
    reach: Floats,
    periods: tuple[Period, Period],
) -> Bounds:
    """Return what errors become at times up to `reach`."""
    I, D, square = motion.moments, motion.D, motion.square
    low, high = min(I), max(I)
    size = min(high * (2 * motion.H - low * square), motion.F + D * square / low)
    b, M, A, first, second, third = (
        float(arb(x).sqrt().upper()) * SAFE if n < 2 else float(arb(x).upper()) * SAFE
        for n, x in enumerate((square, size, 1 / low, high - low, 1 / low - 1 / high, D * (1 / low - 1 / high)))
    )
    t, g = reach
    tried = []
    for s in SCALES * sqrt(first / A):
        p, q = M * second / 2, b * (first / s + s * A)
        growth = t * (p + hypot(p, q)) / 2 + g * b * (third / s + s) / 2
        parts = [hypot(x["M"], s * x["K"]) for x in (start, *missed)]
        factor = exp(growth * SAFE) if growth < LONGEST else inf
        tried.append((factor * (parts[0] + t * parts[1] + g * parts[2]), s))
    e, s = min(tried, key=lambda x: x[0] * (1 + 1 / x[1]))
    if not e <= min(b * s, M) / 1000:
        raise NotCertifiedError(f"not certified: what theta functions miss might grow to {e:.1e}.")
    # times are off by the radii of the periods, and their angles by their own
    off = max(float(x.rad()) for period in periods for x in (period.H, period.F)) * (1 + A) * (M + b)
    turned = start["N"] + t * (missed[0]["N"] + 2 * A * e) + g * (missed[1]["N"] + 2 * e)
    turned += 2 * off + max(float(period.angle.rad()) for period in periods) * 2
    return Bounds(e / s + off * b, A * e + off * (first + third + second * M) * (M + b) * A, turned)


def _whole(x: arb) -> int:
    """Return a whole number less than one away from the middle of a ball."""
    mantissa, exponent = (int(part) for part in x.mid().man_exp())
    return mantissa << exponent if exponent >= 0 else mantissa >> -exponent
