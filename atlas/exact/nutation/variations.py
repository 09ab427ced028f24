"""Derivatives of the constants of a motion in its inputs, by differences of balls.

The constants are analytic in the inputs as long as the kind of motion stays. So a central difference over a step h is
wrong by a relative (h/d)^2, d the distance of the next border; with h = 2^-80 of the inputs and as many more digits in
the balls that is nothing to a double. On a border (a ball, a body that precesses steadily) the constants are taken from
the side on which they are those of a nutation, over h, 2h and 3h: the motion itself is smooth there, so its derivative
is the one of either side.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from flint import acb, arb, fmpq

from atlas.errors import DomainError
from atlas.exact.nutation.cayley_klein import Solution, Sum, infinite
from atlas.formulas.numbers import workprec

STEP = 80
"""Binary digits of the inputs that a step leaves alone."""

KNOWN = arb(2) ** -66
"""Radius of a derivative, beside the largest of its group, with which it is good for a double."""

FLAT = arb(2) ** -60
"""Largest change of the slope over a step, in parts of it: the step is then far from any border."""

TRIES = 6

Tables = dict[str, list[Any]]
"""Constants by groups, in which sizes are compared."""


@dataclass(frozen=True)
class Constants:
    """Constants of a motion: `form` is what does not vary, `tables` are the numbers, by groups."""

    form: tuple[Any, ...]
    tables: Tables


@dataclass(frozen=True)
class Variation:
    """Constants of a motion, and their derivatives in one input."""

    form: tuple[Any, ...]
    values: Tables
    slopes: Tables


def constants(tilt: Sequence[Any], found: Solution, places: tuple[int, ...] = (0, 1, 2)) -> Constants:
    """Return the constants of a pair (alpha, beta) whose axis has some tilt at t = 0; `places` are the body's axes.

    DomainError on a separatrix.
    """
    lattice, pair, swing = found.lattice, (found.alpha, found.beta), found.swing
    steady = lattice.rate.is_zero()
    if not steady and (infinite(lattice.half) or lattice.form == "linear"):
        raise DomainError("On a separatrix neighbours leave the motion for good: it has no sensitivity for all times.")
    sums = [x.sum for x in pair] + ([swing.odd, swing.even] if swing else [])
    kinds = tuple((x.doubled, x.shifted) for x in sums)
    rates = [pair[0].rate + pair[1].rate, pair[0].rate - pair[1].rate]
    tables: Tables = {
        "tilt": [arb(x) for x in tilt],
        "rates": rates,
        "times": [] if steady else [lattice.half, found.origin],
        "slopes": [lattice.rate, pair[0].twist, pair[1].twist],
    }
    if swing:
        tables["rates"][1] += swing.kappa * swing.rate
        # each with a size to compare with, since all may be zero
        tables["swing"], tables["twist"] = [swing.kappa, lattice.rate], [swing.twist, arb(1)]
        tables["swing rate"] = [swing.kappa * swing.rate, lattice.rate]
        tables["A"] = [swing.A, lattice.rate**2]
    factors = [x.factor for x in pair] + [acb(1)] * 2
    tables |= {f"sum {i}": _flat(x, factor) for i, (x, factor) in enumerate(zip(sums, factors, strict=False))}
    form = "steady" if steady else lattice.form
    return Constants((form, places, lattice.oblique, kinds, bool(swing), tuple(x.turn for x in pair)), tables)


def _flat(x: Sum, factor: acb) -> list[acb]:
    """Return the weights of a sum times a factor, odd and even ones by turns: next to a steady motion one vanishes."""
    return [y * factor for both in zip(x.odd, x.even, strict=True) for y in both]


def variations(
    make: Callable[..., Constants], values: Sequence[fmpq], places: Sequence[int], scales: Sequence[fmpq]
) -> list[Variation]:
    """Return the derivatives of constants in the inputs at some places; `scales` are sizes of the inputs, not zero.

    Far from borders one step forward in each input will do, and one backward in all, which must undo the others. Raises
    DomainError where there are none.
    """
    h = [scale / fmpq(2) ** STEP for scale in scales]

    def at(moved: Sequence[int], sign: int) -> Constants:
        return make(*(x + sign * h[i] if i in moved else x for i, x in enumerate(values)))

    with workprec(4 * STEP + 64):
        try:
            ways = [at([], 0), *(at([i], 1) for i in places), at(places, -1)]
        except DomainError:
            ways = []
        if ways and all(x.form == ways[0].form for x in ways):
            base, *forward, back = (_even_out(x.tables, ways) for x in ways)
            steps = [_combined((x, base), (1, -1), arb(1)) for x in forward]
            together = _combined(steps, [1] * len(steps), arb(1))
            if _smooth([base, _combined((base, together), (1, 1), arb(1)), back], central=True):
                slopes = [_combined([x], [1], 1 / arb(h[i])) for i, x in zip(places, steps, strict=True)]
                if all(_known(base, x, arb(scales[i])) for i, x in zip(places, slopes, strict=True)):
                    return [Variation(ways[0].form, base, x) for x in slopes]
    return [variation(make, values, i, scales) for i in places]


def variation(make: Callable[..., Constants], values: Sequence[fmpq], place: int, scales: Sequence[fmpq]) -> Variation:
    """Return the derivatives of constants in the input at a place, also next to a border, by central differences."""
    small = min((abs(x) / size for x, size in zip(values, scales, strict=True) if x != 0), default=fmpq(1))
    lost = max(0, int(small.q).bit_length() - int(small.p).bit_length())
    bits = STEP + lost
    for _ in range(TRIES):
        h = scales[place] / fmpq(2) ** bits
        with workprec(4 * bits + 64):
            found = _differences(make, values, place, h, scales[place])
        if found is not None:
            return found
        bits *= 2
    raise DomainError("The motion is too near to a case of its own for derivatives of its constants.")


def _differences(
    make: Callable[..., Constants], values: Sequence[fmpq], place: int, h: fmpq, scale: fmpq
) -> Variation | None:
    """Return values and slopes by differences over h; None where they are not known well enough."""

    def at(steps: int) -> Constants | None:
        moved = [*values[:place], values[place] + steps * h, *values[place + 1 :]]
        try:
            return make(*moved)
        except DomainError:
            return None

    ways: list[tuple[Sequence[int], Sequence[Any], Sequence[Any]]] = [
        ((0, 1, -1), (1, 0, 0), (0, fmpq(1, 2), fmpq(-1, 2))),
        ((1, 2, 3), (3, -3, 1), (fmpq(-5, 2), 4, fmpq(-3, 2))),
        ((-1, -2, -3), (3, -3, 1), (fmpq(5, 2), -4, fmpq(3, 2))),
    ]
    for nodes, weights, slopes in ways:
        three = [at(n) for n in nodes]
        if nodes[0] == 0 and three[0] is None:
            raise DomainError(
                "On a separatrix neighbours leave the motion for good: it has no sensitivity for all times."
            )
        if any(x is None or x.form != three[0].form for x in three):  # type: ignore[union-attr]
            continue
        whole = [x for x in three if x is not None]
        tables = [_even_out(x.tables, whole) for x in whole]
        if not _smooth(tables, nodes[0] == 0):
            continue
        mean = _combined(tables, weights, arb(1))
        slope = _combined(tables, slopes, 1 / arb(h))
        return Variation(whole[0].form, mean, slope) if _known(mean, slope, arb(scale)) else None
    return None


def _even_out(tables: Tables, all_of: Sequence[Constants]) -> Tables:
    """Return tables of equal lengths: terms that are left out are zero."""
    length = {name: max(len(x.tables[name]) for x in all_of) for name in tables}
    return {name: row + [acb(0)] * (length[name] - len(row)) for name, row in tables.items()}


def _combined(tables: Sequence[Tables], weights: Sequence[Any], factor: arb) -> Tables:
    """Return a linear combination of tables."""
    return {
        name: [
            sum((table[name][i] * arb(w) for table, w in zip(tables, weights, strict=True) if w != 0), arb(0)) * factor
            for i in range(len(row))
        ]
        for name, row in tables[0].items()
    }


def _smooth(tables: Sequence[Tables], central: bool) -> bool:
    """Return whether the slopes do not change over the steps, beside the sizes of the constants and of the slopes."""
    first, second, third = tables
    for name in first:
        a, b = ((second, first), (first, third)) if central else ((second, first), (third, second))
        ups = [x - y for x, y in zip(a[0][name], a[1][name], strict=True)]
        downs = [x - y for x, y in zip(b[0][name], b[1][name], strict=True)]
        largest, size = max(map(_size, [*ups, *downs]), default=arb(0)), _largest(first, name)
        if any(_size(x - y) > FLAT * (largest + size * arb(2) ** -STEP) for x, y in zip(ups, downs, strict=True)):
            return False
        if any(x > FLAT * size for x in map(_size, ups)) and size != 0:
            return False
    return True


def _known(mean: Tables, slope: Tables, scale: arb) -> bool:
    """Return whether values and slopes are known well enough, beside the largest value of their groups."""
    for name, row in mean.items():
        size = _largest(mean, name)
        if size == 0:
            size = max((_size(x) * scale for x in slope[name]), default=arb(0))
        if any(not _radius(x) <= KNOWN * size for x in [*row, *(x * scale for x in slope[name])]):
            return False
    return True


def _largest(tables: Tables, name: str) -> arb:
    """Return the size of the largest constant of a group; alpha and beta are one."""
    names = ("sum 0", "sum 1") if name in ("sum 0", "sum 1") else (name,)
    return max((_size(x) for group in names for x in tables[group]), default=arb(0))


def _size(x: Any) -> arb:
    return abs(x).mid()


def _radius(x: Any) -> arb:
    """Return the radius of a ball, infinite for what is not a number."""
    parts = (x.real, x.imag) if isinstance(x, acb) else (x,)
    return max((y.rad() if y.is_finite() else arb("inf") for y in parts), key=float)
