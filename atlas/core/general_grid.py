"""Rotation matrices of the general motion on a uniform grid.

In trigonometric form alpha and beta are sums of exponentials exp(i f_m t), so that their values at s + tau are a
product of a coarse table of exp(i f_m s) and a fine one of z_m exp(i f_m tau): one matrix product instead of phases
and tangents at every time. Where the sums would cancel, next to a separatrix, and on it, the grid is evaluated time by
time.
"""

from fractions import Fraction
from math import ceil, inf

import numpy as np
from flint import acb, arb, ctx

from atlas.core.cayley_klein import BLOCK, CayleyKlein, Evaluation, Products, combined
from atlas.core.general import General
from atlas.core.inputs import FloatArray
from atlas.core.nutation import wide
from atlas.core.phase import LIMIT, Phases
from atlas.core.threads import shared
from atlas.core.wide import Wide
from atlas.errors import AtlasError
from atlas.exact.cayley_klein import Parameter
from atlas.exact.general import GeneralMotion
from atlas.exact.theta import infinite

FINE, COARSE = 128, 34
"""Times in the fine table, and coarse times in one product."""

GROUP = 16 * COARSE
"""Coarse times whose exponentials are made at once."""

FEW = 30_000
"""Shorter grids are evaluated time by time: their tables would cost more."""

CANCELLING = 8.0
"""The sums are used where the weights exceed what they leave at any time by no more than this factor."""

STEEP = 6.0
"""Ratio of the real to the imaginary period from which on the sums are not even tried."""

TERMS = 24
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
        self.turns = [wide((parameter.rate + f) / (2 * arb.pi())) for f, _ in terms]
        self.weights = np.array([complex(float(z.real.mid()), float(z.imag.mid())) for _, z in terms])

    def coarse(self, start: Wide, step: Wide) -> Phases:
        """Return the phases at start + i step as functions of i."""
        return Phases([(f * step).turn() for f in self.turns], [(f * start).turn() for f in self.turns])

    def fine(self, step: Wide) -> FloatArray:
        """Return z_m exp(i f_m j step), j < FINE, as rows for cos and for sin of the coarse phase, (2 M, 2, FINE)."""
        phases, work = Phases([(f * step).turn() for f in self.turns]), np.empty((8, len(self.turns), FINE))
        half, rest, sign, _ = phases.angles(np.arange(float(FINE)), work)
        angle = 2 * (half.astype(np.longdouble) + rest)
        z = 2 * self.weights[:, None] * (sign * np.cos(angle) + 1j * (sign * np.sin(angle))).astype(complex)
        return np.concatenate([np.stack([z.real, z.imag], 1), np.stack([-z.imag, z.real], 1)])


def exponentials(exact: GeneralMotion, precision: int) -> tuple[Exponentials, Exponentials] | None:
    """Return alpha and beta as sums of exponentials, None where there is no period or where they cancel or are many."""
    with ctx.workprec(precision):
        found = exact.trigonometric()
        if found.lattice.form != "trigonometric":
            return None
        if (
            not (infinite(found.lattice.half) or infinite(found.lattice.imaginary))
            and float(found.lattice.half / found.lattice.imaginary) > STEEP
        ):
            return None
        parts = (found.alpha, found.beta)
        unit = max(abs(x.factor * w) for x in parts for w in (*x.sum.odd, *x.sum.even))
        pair = Exponentials(found.alpha, found.origin, unit), Exponentials(found.beta, found.origin, unit)
    return pair if all(len(x.turns) <= TERMS for x in pair) and cancelling(*pair) <= CANCELLING else None


def cancelling(alpha: Exponentials, beta: Exponentials) -> float:
    """Return the largest ratio of the sum of the weights to what is left of it at any of many times."""
    phases = np.linspace(0, 1, 257)
    square = np.zeros(len(phases))
    for x in (alpha, beta):
        relative = [float(f - x.turns[0]) for f in x.turns]
        unit = min((abs(f) for f in relative if f), default=1.0)
        turns = np.round(np.array(relative) / unit)
        square = square + np.abs(x.weights @ np.exp(2j * np.pi * np.outer(turns, phases))) ** 2
    least = np.sqrt(square.min())
    return float(max(np.abs(x.weights).sum() for x in (alpha, beta)) / least) if least else inf


def fill_grid(one: General, start: float, step: float, out: FloatArray) -> None:
    """Fill `out` (count, 3, 3) with R at the exact real numbers start + i step."""
    count = len(out)
    if not count:
        return
    first, stride = Wide.exactly(start), Wide.exactly(step)
    last = first + stride * Wide(count - 1)
    if max(abs(float(f * t)) for f in one.parts.frequencies for t in (first, last)) * 2 * np.pi > LIMIT:
        raise AtlasError(f"The grid from {start} by {step} to {float(last)} leaves the phases up to 2^50.")
    sums = one.exponentials if count >= FEW else None
    if sums is None:
        fill_each(one, one.parts.on_grid(first, stride), out)
        return
    blocks, rest = divmod(count, FINE)
    fill_products(one, sums, first, stride, out[: blocks * FINE])
    if rest:
        fill_each(one, one.parts.on_grid(first + stride * Wide(blocks * FINE), stride), out[count - rest :])
    if step and 0 <= Fraction(-start) / Fraction(step) < count:
        i = ceil(Fraction(-start) / Fraction(step))
        fill_each(one, one.parts.on_grid(first + stride * Wide(i), stride), out[i : i + 1])


def fill_each(one: General, parts: CayleyKlein, out: FloatArray) -> None:
    """Fill the matrices time by time, i = 0, 1, ..."""
    rows = out.reshape(len(out), 9)

    def fill(low: int, high: int) -> None:
        evaluation = Evaluation(parts, min(high - low, BLOCK))
        for i in range(low, high, BLOCK):
            j = min(i + BLOCK, high)
            combined(evaluation.at(np.arange(float(i), float(j))), one.entries, rows[i:j])

    shared(fill, len(out), BLOCK)


def fill_products(
    one: General, sums: tuple[Exponentials, Exponentials], start: Wide, step: Wide, out: FloatArray
) -> None:
    """Fill the matrices by products of coarse and fine tables; len(out) is a multiple of FINE."""
    phases = [x.coarse(start, step * Wide(FINE)) for x in sums]
    tables = [np.ascontiguousarray(x.fine(step).swapaxes(0, 1)) for x in sums]
    rows = out.reshape(-1, 9)

    def fill(low: int, high: int) -> None:
        """Fill the blocks low to high."""
        q, products = np.empty((4, COARSE, FINE)), Products(COARSE * FINE)
        for i in range(low, high, GROUP):
            j = min(i + GROUP, high)
            coarse = [circles(x, np.arange(float(i), float(j))) for x in phases]
            for k in range(i, j, COARSE):
                m = min(COARSE, j - k)
                for place, (functions, table) in enumerate(zip(coarse, tables, strict=True)):
                    for part in (0, 1):
                        np.matmul(functions[k - i : k - i + m], table[part], out=q[place + 2 * part, :m])
                found = products.of(q[:, :m].reshape(4, m * FINE))
                combined(found, one.entries, rows[k * FINE : (k + m) * FINE])

    shared(fill, len(out) // FINE, GROUP, FINE)


def circles(phases: Phases, i: FloatArray) -> FloatArray:
    """Return cos and sin of all phases, halved, (m, 2 M)."""
    count, m = phases.words.shape[1], i.size
    table = np.empty((2, count, m))
    phases.circle(i, np.empty((8, count, m)), table[0], table[1], np.empty(m))
    return np.ascontiguousarray(table.reshape(2 * count, m).T)
