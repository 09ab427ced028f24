"""The Cayley-Klein parameters of one motion: constants made in balls, at rising precision until each is known.

alpha and beta, up to a common real factor, are sums of the functions of time of `functions` times phases exp(i f t).
"""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from flint import acb, arb, fmpq

from atlas.arithmetic.inputs import FloatArray
from atlas.arithmetic.lazy import cached_property
from atlas.arithmetic.numbers import rational, workprec
from atlas.arithmetic.phase import EVEN, ROUNDER, Phases
from atlas.arithmetic.words import ZERO, middle
from atlas.errors import DomainError
from atlas.motions.nutation.certified_cayley_klein import Solution, infinite
from atlas.motions.nutation.certified_swing import Crossing as ExactCrossing
from atlas.motions.nutation.functions import Functions, Hyperbolic, Linear, Steady, Trigonometric
from atlas.motions.nutation.swing import Crossing, Swing

FIRST_BITS = 256
"""Binary digits with which the constants are tried first."""

MAX_BITS = 1 << 17
"""Binary digits beyond which they are not tried."""

FREQUENCY_RADIUS, WEIGHT_RADIUS = 2.0**-120, 2.0**-80
"""Radius to which frequencies (of the largest) and weights (of themselves) are known before they are rounded."""

MIN_WEIGHT = 1e-70
"""Next to a separatrix alpha and beta may both become so small, over the common factor, that their squares vanish."""

KINDS: Mapping[str, Callable[..., Functions]] = {
    "trigonometric": Trigonometric,
    "hyperbolic": Hyperbolic,
    "linear": Linear,
}


class CayleyKlein:
    """Constants of alpha and beta of one motion as doubles, from balls at a precision where each is accurate.

    ``solution()`` makes the `Solution` at the current working precision. Up to a common factor, alpha and beta are sums
    of real functions of time, times phases exp(i f t). `functions`, from `atlas.motions.nutation.functions` and made
    here, writes the functions; `values` (4, rows) are their weights in Re alpha, Re beta, Im alpha, Im beta. With
    ``slopes`` four more rows are the weights in the derivatives by time, without the part that comes from the rate
    kappa nu of a top's `swing`. `frequencies`, in turns per unit of time, are a list of two, of the sum and of the
    difference of the phases of alpha and beta; with a period T a third is 1/T or 1/(2 T). `phases` is the `Phases` of
    these, which gives the phases at times in rad. Raises DomainError where `MAX_BITS` digits do not suffice.
    """

    def __init__(self, solution: Callable[[], Solution], *, slopes: bool = False) -> None:
        self.precision, self.sloping, self._solution = FIRST_BITS, slopes, solution
        while not self._are_constants_known(solution, self.precision):
            self.precision = _doubled(self.precision)

    def in_balls(self, t: FloatArray, low: FloatArray | None) -> FloatArray:
        """Return the array (4, m) or (8, m) of `Evaluation.components` from balls, normalised, at times t + low.

        t and low are (m,), low may be None. It is for tops whose swing is too fast for two words. Raises
        DomainError where `MAX_BITS` digits do not suffice.
        """
        self.phases.check(t)
        lacks = np.zeros(t.size) if low is None else np.broadcast_to(low, t.shape)
        times = [rational(x) + rational(y) for x, y in zip(t.tolist(), lacks.tolist(), strict=True)]
        return np.array([self._in_balls(x) for x in times]).T.reshape(8 if self.sloping else 4, t.size)

    def _in_balls(self, t: fmpq) -> list[float]:
        """Return [Re alpha, Re beta, Im alpha, Im beta] at time t, squares summing to one.

        With ``slopes`` the four derivatives by time follow, over the same factor, without the part that comes from the
        rate of a top's swing.
        """
        precision = self.precision
        while True:
            with workprec(precision):
                solution = self._solution()
                a, b, da, db = solution.parameters(t, turning=False)
                unit = (abs(a) ** 2 + abs(b) ** 2).sqrt() * (-1 if solution.is_flipped(t) else 1)
                groups = [[x / unit for x in (a.real, b.real, a.imag, b.imag)]]
                groups += [[x / unit for x in (da.real, db.real, da.imag, db.imag)]] * self.sloping
                sizes = [max((abs(x).mid() for x in four), default=arb(0)) for four in groups]
                if all(
                    _radius(x) <= WEIGHT_RADIUS * float(y) for four, y in zip(groups, sizes, strict=True) for x in four
                ):
                    return [float(x.mid()) for four in groups for x in four]
            precision = _doubled(precision)

    def _are_constants_known(self, solution: Callable[[], Solution], precision: int) -> bool:
        """Compute and store the constants at ``precision`` binary digits; return whether these suffice.

        ``solution()`` makes the `Solution`. Where the result is False, only some attributes are stored.
        """
        with workprec(precision):
            constants = solution()
            lattice, pair = constants.lattice, (constants.alpha, constants.beta)
            self.periodic = not infinite(lattice.half) and not lattice.rate.is_zero()
            turns, origin = _turns(constants, self.periodic)
            if not constants.origin.is_finite() or not _reducible(turns, origin):
                return False
            kind: Callable[..., Functions] = Steady if lattice.rate.is_zero() else KINDS[lattice.form]
            self.functions = kind(constants, [x.sum for x in pair])
            self.swing = _swing(constants.swing)
            self.by_balls = bool(self.swing and self.swing.is_coarse)
            tables = _weights(constants, self.functions, slopes=self.sloping)
            largest = max(abs(x).mid() for row in tables[0] for x in row)
            if not all(_is_known(x, largest) for table in tables for row in table for x in row):
                return False
            if self.swing and not self.swing.is_known:
                return False
            self.frequencies = [middle(x) for x in turns]
            self.origins = [ZERO, ZERO, middle(origin)] if self.periodic else _crossed(constants)
            self.phases = self._phases()
            self.values = np.concatenate([_real_parts(table, largest) for table in tables])
            self.is_lost = self._are_lost(tables[0])
            least = np.abs(self.values[:4]).min(where=self.values[:4] != 0, initial=1.0)
            self.faint = bool(least < MIN_WEIGHT or lattice.reach > -np.log(MIN_WEIGHT))
        return True

    @property
    def at_one_time(self) -> bool:
        """Whether `products_of_one` may evaluate alpha and beta: without `swing`, and away from separatrices.

        Near a separatrix the argument of the hyperbolic functions is large, and a double of it loses digits.
        """
        return not self.swing and isinstance(self.functions, Steady | Trigonometric)

    @cached_property
    def alternates(self) -> bool:
        """Whether alpha and beta change sign with each whole turn of the phase left out in a period."""
        with workprec(self.precision):
            return self.periodic and self._solution().alternates

    def _are_lost(self, values: list[list[acb]]) -> bool:
        """Whether alpha or beta is nonzero but too small for a float compared with the other.

        ``values`` (2, rows) are their exact weights.
        """
        pairs = zip(values, self.values[:4].reshape(2, 2, -1).swapaxes(0, 1), strict=True)
        return any(not weights.any() and not all(x.is_zero() for x in exact) for exact, weights in pairs)

    def _phases(self) -> Phases:
        """Return the `Phases` of `frequencies` and `origins`; the period's, if hyperbolic, is reduced by half turns.

        The hyperbolic functions' argument has a large slope, as has the swing of a top in a slow nutation: so that
        phase is reduced as if the times were long, without any loss.
        """
        hyperbolic = self.periodic and isinstance(self.functions, Hyperbolic)
        rounder = np.array([EVEN, EVEN, ROUNDER])[:, None] if hyperbolic else EVEN
        phases = Phases(self.frequencies, self.origins, rounder)
        if hyperbolic or (self.swing and self.swing.is_large):
            phases.max_near_time = -1.0
        return phases


def _doubled(precision: int) -> int:
    """Return twice the precision, in binary digits. Raises DomainError where that exceeds `MAX_BITS`."""
    if 2 * precision > MAX_BITS:
        raise DomainError(
            f"The constants of this motion are not known with {MAX_BITS} binary digits: it is too near to a case of "
            "its own, as is a separatrix, or its rates are of sizes too different."
        )
    return 2 * precision


def _swing(exact: Any) -> Any:
    """Return the evaluator in doubles of an exact `Swing` or `Crossing`, None for None."""
    if exact is None:
        return None
    return Crossing(exact) if isinstance(exact, ExactCrossing) else Swing(exact)


def _crossed(solution: Solution) -> list[arb] | None:
    """Return the phases at t = 0 of a ``solution`` on the separatrix from n to -n, in turns; None for any other.

    They are a list of two, of the sum and of the difference of the phases of alpha and beta: zero, and kappa s over
    2 pi, s the time at t = 0 since the axis crossed the equator.
    """
    if not isinstance(solution.swing, ExactCrossing):
        return None
    return [ZERO, middle(solution.swing.kappa * solution.swing.origin / (2 * arb.pi()))]


def _turns(solution: Solution, periodic: bool) -> tuple[list[arb], arb]:
    """Return (list of frequencies of a ``solution`` in turns per unit of time, phase of the period at t = 0 in turns).

    The frequencies are of the sum and the difference of the phases of alpha and beta, and, if ``periodic``, 1/T, or
    1/(2 T) where the functions need half the angle; otherwise the phase is 0.
    """
    pair, swing = (solution.alpha, solution.beta), solution.swing
    rates = [pair[0].rate + pair[1].rate, pair[0].rate - pair[1].rate]
    if swing:
        rates[1] += swing.kappa * swing.rate
    turns = [x / (2 * arb.pi()) for x in rates]
    if not periodic:
        return turns, arb(0)
    # the phase is 2v where only sin v / cos v is wanted, else v
    odd = solution.lattice.form == "trigonometric" and not any(x.sum.doubled for x in pair)
    cell = (2 if odd else 4) * solution.lattice.half
    return [*turns, 1 / cell], solution.origin / cell


def _reducible(turns: list[arb], origin: arb) -> bool:
    """Whether frequencies and origin, all in turns, are finite and accurate enough for the reduction of phases."""
    if not all(x.is_finite() for x in turns):
        return False
    scale = max(abs(x) for x in turns)
    return all(_radius(x) <= FREQUENCY_RADIUS * scale.mid() for x in turns) and bool(
        _radius(origin) <= FREQUENCY_RADIUS
    )


def _weights(solution: Solution, functions: Functions, *, slopes: bool) -> list[list[list[acb]]]:
    """Return one table (2, rows) of complex balls: weights of ``functions`` in alpha and in beta of a ``solution``.

    With ``slopes`` the list of tables has a second one, for their derivatives by time.
    """
    swing, start = solution.swing, acb(1)
    if swing:
        start = acb(0, -swing.at(arb(0), solution.origin) / 2).exp()
    pair = [(solution.alpha, solution.alpha.factor * start), (solution.beta, solution.beta.factor / start)]
    plain = [functions.weights(x.sum) for x, _ in pair]
    tables = [[[factor * w for w in row] for (_, factor), row in zip(pair, plain, strict=True)]]
    if slopes:
        rising = [functions.weights(x.sum.derivative) for x, _ in pair]
        tables.append([
            [factor * (acb(0, x.rate + x.twist) * v + w) for v, w in zip(row, change, strict=True)]
            for (x, factor), row, change in zip(pair, plain, rising, strict=True)
        ])  # fmt: skip
    return tables


def _radius(x: arb) -> float:
    return float(x.rad()) if x.is_finite() else float("inf")


def _is_known(x: acb, largest: arb) -> bool:
    """Whether a weight x is accurate relative to itself, or negligible compared with the ``largest``."""
    radius = max(_radius(x.real), _radius(x.imag))
    return radius <= WEIGHT_RADIUS * float(abs(x).mid()) or radius <= WEIGHT_RADIUS**2 * float(largest)


def _real_parts(pair: list[list[acb]], largest: arb) -> FloatArray:
    """Return Re alpha, Re beta, Im alpha, Im beta of the weights over the ``largest``, an array (4, rows).

    ``pair`` (2, rows) are the complex weights of alpha and of beta.
    """
    rows = [[x / largest for x in row] for row in pair]
    return np.array(
        [[float(x.real.mid()) for x in row] for row in rows] + [[float(x.imag.mid()) for x in row] for row in rows]
    )
