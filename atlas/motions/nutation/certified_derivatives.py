"""Derivatives of the constants of a motion in its inputs, by differences of balls.

The constants are analytic in the inputs as long as the kind of motion stays. So a central difference over a step h is
wrong by a relative (h/d)^2, d the distance of the next border; with h = 2^-80 of the inputs and as many more digits in
the balls that is nothing to a double. On a border (a ball, a body that precesses steadily) the constants are taken from
the side on which they are those of a nutation, over h, 2h and 3h: the motion itself is smooth there, so its derivative
is the one of either side.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import chain
from typing import Any, TypeAlias

import numpy as np
from flint import acb, arb, fmpq
from numpy.typing import NDArray

from atlas.arithmetic.numbers import workprec
from atlas.errors import DomainError
from atlas.motions.nutation.certified_cayley_klein import Solution, Sum, infinite

STEP_BITS = 80
"""Binary digits of the inputs that a step leaves alone."""

MAX_RADIUS = 2.0**-66
"""Largest radius of a derivative that is rounded to a double, relative to the largest of its group."""

MAX_SLOPE_CHANGE = 2.0**-60
"""Largest relative change of the slope over a step that is far from any border."""

MAX_TRIES = 6

SEPARATRIX = "On a separatrix neighbours leave the motion for good: it has no sensitivity for all times."


class TooNearError(DomainError):
    """No derivatives of the constants are certified: the motion is too near a special case."""


Tables = dict[str, list[Any]]
"""Constants by groups, in which sizes are compared."""

FloatArray: TypeAlias = NDArray[np.float64]
Row: TypeAlias = list[Any]
"""All constants of one motion, one after the other."""


@dataclass(frozen=True)
class Constants:
    """Constants of a motion: `form` says which formulas hold, `tables` holds the numbers, balls in lists by group.

    The groups of `constants` are "tilt" (four, see `Nutating.tilt`), "rates" (of the sum and the difference of the
    phases of alpha and beta, rad/time), "times" (half the period and the time since the turning point at t = 0),
    "slopes" (the rate of the lattice and the twists of alpha and beta), and weights of sums: "sum 0" of alpha, "sum
    1" of beta. A top with a `swing` has "sum 2" and "sum 3", its odd and even sum, and some groups more. Two
    motions have comparable tables if their `form` is equal.
    """

    form: tuple[Any, ...]
    tables: Tables


@dataclass(frozen=True)
class Variation:
    """Constants of a motion (`values`) and their derivatives in one input (`slopes`), lists of balls by group.

    See `Constants` for the groups and `form`.
    """

    form: tuple[Any, ...]
    values: Tables
    slopes: Tables


def constants(tilt: Sequence[Any], solution: Solution, places: tuple[int, ...] = (0, 1, 2)) -> Constants:
    """Return the `Constants` of (alpha, beta) of a ``solution``, with the ``tilt`` at t = 0.

    For the tilt see `Nutating.tilt`; ``places`` order the body's axes, the nutating one last. Raises DomainError on a
    separatrix.
    """
    lattice, pair, swing = solution.lattice, (solution.alpha, solution.beta), solution.swing
    steady = lattice.rate.is_zero()
    if not steady and (infinite(lattice.half) or lattice.form == "linear"):
        raise DomainError(SEPARATRIX)
    sums = [x.sum for x in pair] + ([swing.odd, swing.even] if swing else [])
    kinds = tuple((x.doubled, x.shifted) for x in sums)
    rates = [pair[0].rate + pair[1].rate, pair[0].rate - pair[1].rate]
    tables: Tables = {
        "tilt": [arb(x) for x in tilt],
        "rates": rates,
        "times": [] if steady else [lattice.half, solution.origin],
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
    """Return the weights of a sum x times a ``factor``, odd and even alternating, a list of complex balls.

    Both are multiplied alike, since near a steady motion one of them vanishes.
    """
    return [y * factor for pair_of_weights in zip(x.odd, x.even, strict=True) for y in pair_of_weights]


def variations(
    make: Callable[..., Constants], values: Sequence[fmpq], places: Sequence[int], scales: Sequence[fmpq]
) -> list[Variation]:
    """Return a `Variation` for the input at each index in `places`; `scales` are sizes of the inputs, not zero.

    ``make`` takes all inputs, which are ``values`` or near these, and returns `Constants`. Where the formulas do not
    change, each derivative is one forward difference, and a step back in all inputs checks them. Raises DomainError
    where the constants have no derivatives.
    """
    h = [scale / fmpq(2) ** STEP_BITS for scale in scales]

    def constants_at(changed: Sequence[int], sign: int) -> Constants:
        return make(*(x + sign * h[i] if i in changed else x for i, x in enumerate(values)))

    with workprec(4 * STEP_BITS + 64):
        try:
            ways = [constants_at([], 0), *(constants_at([i], 1) for i in places), constants_at(places, -1)]
        except DomainError:
            ways = []
        if ways and all(x.form == ways[0].form for x in ways):
            groups = Groups(ways)
            base, *forward, back = groups.rows
            steps = [_combined((x, base), (1, -1)) for x in forward]
            together = [sum(x, arb(0)) for x in zip(*steps, strict=True)]
            slopes = [_scaled(x, 1 / arb(h[i])) for i, x in zip(places, steps, strict=True)]
            flat = groups.are_smooth(base, together, _combined((base, back), (1, -1)))
            if flat and groups.are_known(base, [(x, scales[i]) for i, x in zip(places, slopes, strict=True)]):
                tables = groups.tables(base)
                return [Variation(ways[0].form, tables, groups.tables(x)) for x in slopes]
    return [variation(make, values, i, scales) for i in places]


def variation(make: Callable[..., Constants], values: Sequence[fmpq], place: int, scales: Sequence[fmpq]) -> Variation:
    """Return the `Variation` of constants in the input number ``place``, also next to a border, by differences.

    ``make`` takes all inputs and returns `Constants`, ``values`` are the inputs and ``scales`` their sizes, not zero.
    Raises DomainError on a separatrix, TooNearError where no step is small enough.
    """
    small = min((abs(x) / size for x, size in zip(values, scales, strict=True) if x != 0), default=fmpq(1))
    lost_bits = max(0, int(small.q).bit_length() - int(small.p).bit_length())
    bits = STEP_BITS + lost_bits
    for _ in range(MAX_TRIES):
        h = scales[place] / fmpq(2) ** bits
        with workprec(4 * bits + 64):
            differences = _differences(make, values, place, h, scales[place])
        if differences is not None:
            return differences
        bits *= 2
    raise TooNearError("The motion is too near to a case of its own for derivatives of its constants.")


def _differences(
    make: Callable[..., Constants], values: Sequence[fmpq], place: int, h: fmpq, scale: fmpq
) -> Variation | None:
    """Return the `Variation` in the input number ``place`` by differences over h; None where it is not accurate enough.

    ``make`` and ``values`` are those of `variations`, ``scale`` is the size of the input. Raises DomainError on a
    separatrix, where the motion itself has no constants.
    """

    def constants_at(steps: int) -> Constants | None:
        changed = [*values[:place], values[place] + steps * h, *values[place + 1 :]]
        try:
            return make(*changed)
        except DomainError:
            return None

    ways: list[tuple[Sequence[int], Sequence[Any], Sequence[Any]]] = [
        ((-1, 0, 1), (0, 1, 0), (fmpq(-1, 2), 0, fmpq(1, 2))),
        ((1, 2, 3), (3, -3, 1), (fmpq(-5, 2), 4, fmpq(-3, 2))),
        ((-1, -2, -3), (3, -3, 1), (fmpq(5, 2), -4, fmpq(3, 2))),
    ]
    for nodes, weights, slopes in ways:
        three = [constants_at(n) for n in nodes]
        if nodes[1] == 0 and three[1] is None:
            raise DomainError(SEPARATRIX)
        complete = [x for x in three if x is not None]
        if len(complete) < len(three) or any(x.form != complete[0].form for x in complete):
            continue
        groups = Groups(complete)
        lower, second, third = groups.rows
        if not groups.are_smooth(second, *(_combined(x, (1, -1)) for x in ((third, second), (second, lower)))):
            continue
        mean, slope = _combined(groups.rows, weights), _scaled(_combined(groups.rows, slopes), 1 / arb(h))
        if not groups.are_known(mean, [(slope, scale)]):
            return None
        return Variation(complete[0].form, groups.tables(mean), groups.tables(slope))
    return None


class Groups:
    """Constants of several motions of one form as `rows` of equal length; missing terms of sums are zeros.

    `lengths` holds the number of entries of each group by name, `places` the number of the group of each entry; the
    sums of alpha and beta have one number.
    """

    def __init__(self, motions: Sequence[Constants]) -> None:
        tables = [x.tables for x in motions]
        self.lengths = {name: max(len(x[name]) for x in tables) for name in tables[0]}
        self.rows: list[Row] = [
            [*chain.from_iterable(x[name] + [acb(0)] * (n - len(x[name])) for name, n in self.lengths.items())]
            for x in tables
        ]
        # alpha and beta are one group
        self.places = np.repeat(
            [list(self.lengths).index(x.replace("sum 1", "sum 0")) for x in self.lengths], list(self.lengths.values())
        )

    def tables(self, row: Row) -> Tables:
        """Return a flat row of constants as a dict of lists by the name of their group."""
        entries = iter(row)
        return {name: [next(entries) for _ in range(n)] for name, n in self.lengths.items()}

    def are_smooth(self, middle: Row, ups: Row, downs: Row) -> bool:
        """Whether derivatives agree over two successive steps, relative to the largest of their group.

        ``ups`` and ``downs`` are the changes over the steps on both sides of ``middle``, three rows of balls.
        """
        size, up, down = (sizes_of(x) for x in (middle, ups, downs))
        bend = sizes_of(_combined((ups, downs), (1, -1)))
        largest, complete = self._largest(np.maximum(up, down)), self._largest(size)
        return bool(
            (bend <= MAX_SLOPE_CHANGE * (largest + np.ldexp(complete, -STEP_BITS))).all()
            and ((up <= MAX_SLOPE_CHANGE * complete) | (complete == 0)).all()
        )

    def are_known(self, mean: Row, slopes: Sequence[tuple[Row, fmpq]]) -> bool:
        """Whether all radii of ``mean`` and ``slopes`` are at most MAX_RADIUS times the group's largest value.

        ``slopes`` are pairs (row of derivatives, scale of the input), of which the product is compared.
        """
        size, radius = self._largest(sizes_of(mean)), radii_of(mean)
        for row, scale in slopes:
            unit = float(arb(scale).mid())
            least = np.where(size == 0, self._largest(sizes_of(row)) * unit, size)
            if not (
                (radius <= MAX_RADIUS * least) & (radii_of(row) * unit <= MAX_RADIUS * least) & (least < np.inf)
            ).all():
                return False
        return True

    def _largest(self, sizes: FloatArray) -> FloatArray:
        """Return for each entry the largest of ``sizes`` in its group, an array of the same shape."""
        largest = np.zeros(len(self.lengths))
        np.maximum.at(largest, self.places, sizes)
        return np.asarray(largest[self.places])


def _combined(rows: Sequence[Row], weights: Sequence[Any]) -> Row:
    """Return the linear combination of rows of balls with these weights, a list; rows with weight 0 are not read."""
    pairs = [(x, w) for x, w in zip(rows, weights, strict=True) if w != 0]
    if [w for _, w in pairs] == [1, -1]:
        return [x - y for x, y in zip(pairs[0][0], pairs[1][0], strict=True)]
    return [
        sum((x * arb(w) for x, (_, w) in zip(column, pairs, strict=True)), arb(0))
        for column in zip(*(x for x, _ in pairs), strict=True)
    ]


def _scaled(row: Row, factor: arb) -> Row:
    return [x * factor for x in row]


def sizes_of(row: Row) -> FloatArray:
    """Return the magnitudes of the midpoints of the balls in a row, a float array (n,)."""
    return np.array([float(abs(x).mid()) for x in row])


def radii_of(row: Row) -> FloatArray:
    """Return the radii of the balls in a row as a float array, for a complex ball the sum of two; NaN if not finite."""
    return np.array(
        [
            float(x.real.rad() + x.imag.rad() if isinstance(x, acb) else x.rad()) if x.is_finite() else np.nan
            for x in row
        ]
    )
