"""alpha and beta of a general motion as sums of exponentials exp(i f_m t), where these are few and do not cancel."""

from math import inf

import numpy as np
from flint import acb, arb, fmpq

from atlas.arithmetic.inputs import FloatArray
from atlas.arithmetic.numbers import nearest, workprec
from atlas.arithmetic.phase import Phases, room
from atlas.arithmetic.words import middle, turn_of
from atlas.motions.nutation.certified import Nutating
from atlas.motions.nutation.certified_cayley_klein import Parameter, infinite

FINE_TIMES = 128
"""Times in the fine table."""

MAX_CANCELLATION = 8.0
"""Largest ratio of the sum of the weights to the sum of the terms at any time: beyond, digits cancel."""

MAX_PERIOD_RATIO = 6.0
"""Ratio of the real to the imaginary period from which on the sums are not even tried."""

MAX_TERMS = 24
"""Exponentials beyond which the product would cost more than it saves."""

NEGLIGIBLE = 2.0**-60


class Exponentials:
    """alpha or beta as a sum of z_m exp(i f_m t), frequencies in turns."""

    def __init__(self, parameter: Parameter, origin: arb, unit: arb) -> None:
        sum_, rate = parameter.sum, parameter.sum.lattice.rate
        terms: list[tuple[arb, acb]] = []
        for n, (a, b) in enumerate(zip(sum_.odd, sum_.even, strict=True)):
            k = sum_.frequency(n) * rate
            pairs = [(k, (b - acb(0, 1) * a) / 2), (-k, (b + acb(0, 1) * a) / 2)] if k != 0 else [(k, b)]
            terms += [(f, parameter.factor / unit * z * acb(0, f * origin).exp()) for f, z in pairs]
        largest = max(float(abs(z).mid()) for _, z in terms)
        terms = [(f, z) for f, z in terms if float(abs(z).mid()) >= NEGLIGIBLE * largest]
        self.turns = [middle((parameter.rate + f) / (2 * arb.pi())) for f, _ in terms]
        self.weights = np.array([complex(float(z.real.mid()), float(z.imag.mid())) for _, z in terms])

    def coarse_phases(self, start: fmpq, step: fmpq) -> Phases:
        """Return the phases at start + i step as functions of i."""
        return Phases(self._phases_at(step), self._phases_at(start))

    def fine_table(self, step: fmpq) -> FloatArray:
        """Return z_m exp(i f_m j step), j < FINE_TIMES, rows for cos and sin of coarse phases, (2 M, 2, FINE_TIMES)."""
        phases, work = Phases(self._phases_at(step)), room(len(self.turns), FINE_TIMES)
        half, errors, sign, _ = phases.angles(np.arange(float(FINE_TIMES)), work)
        angle = 2 * (half.astype(np.longdouble) + errors)
        z = 2 * self.weights[:, None] * (sign * np.cos(angle) + 1j * (sign * np.sin(angle))).astype(complex)
        return np.concatenate([np.stack([z.real, z.imag], 1), np.stack([-z.imag, z.real], 1)])

    def _phases_at(self, t: fmpq) -> list[arb]:
        """Return the phases at a time, less whole turns."""
        with workprec():
            return [turn_of(f * t) for f in self.turns]


def exponentials(exact: Nutating, precision: int) -> tuple[Exponentials, Exponentials] | None:
    """Return alpha and beta as sums of exponentials, None where there is no period or where they cancel or are many."""
    with workprec(precision):
        solution = exact.trigonometric()
        if solution.lattice.form != "trigonometric" or solution.swing:
            return None
        if (
            not (infinite(solution.lattice.half) or infinite(solution.lattice.imaginary))
            and float(solution.lattice.half / solution.lattice.imaginary) > MAX_PERIOD_RATIO
        ):
            return None
        parameters = (solution.alpha, solution.beta)
        unit = max(abs(x.factor * w) for x in parameters for w in (*x.sum.odd, *x.sum.even))
        pair = Exponentials(solution.alpha, solution.origin, unit), Exponentials(solution.beta, solution.origin, unit)
    return pair if all(len(x.turns) <= MAX_TERMS for x in pair) and cancelling(*pair) <= MAX_CANCELLATION else None


def cancelling(alpha: Exponentials, beta: Exponentials) -> float:
    """Return the largest ratio of the sum of the weights to the sum of the terms at any of many times."""
    phases = np.linspace(0, 1, 257)
    square = np.zeros(len(phases))
    for x in (alpha, beta):
        with workprec():
            relative = [nearest(f - x.turns[0]) for f in x.turns]
        unit = min((abs(f) for f in relative if f), default=1.0)
        turns = np.round(np.array(relative) / unit)
        square = square + np.abs(x.weights @ np.exp(2j * np.pi * np.outer(turns, phases))) ** 2
    least = np.sqrt(square.min())
    return float(max(np.abs(x.weights).sum() for x in (alpha, beta)) / least) if least else inf
