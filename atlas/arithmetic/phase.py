"""Phases f t of exact frequencies, reduced to half a turn without loss, and their cosines and sines.

A plain double k t has lost the phase once |k t| eps is of order one, and k itself has an error that t magnifies. Here a
frequency is made from the exact inputs, in turns, as a sum of words, P0 + P1; both products with t are formed with
their rounding errors, and the whole turns are dropped before anything is rounded.
"""

from collections.abc import Iterator, Sequence
from math import cos, frexp, inf, ldexp, nextafter, sin
from typing import Self

import numpy as np

from atlas.arithmetic.circle import circle_of, signs
from atlas.arithmetic.inputs import FloatArray
from atlas.arithmetic.lazy import cached_property
from atlas.arithmetic.machine import keep
from atlas.arithmetic.numbers import Number, nearest, workprec
from atlas.arithmetic.words import TURN, magnitude, middle, scaled, turn_of, units, words
from atlas.errors import AtlasError

MAX_PHASE = 2.0**50
"""Largest phase |f t| in radians: beyond it two words of f no longer hold the turn."""

SAFE_EXPONENT = 400
"""Frequencies outside 2^±400 are scaled, and times the other way, lest a product of words overflow or vanish."""

ZERO_EXPONENT = -4000
"""A power of two that makes any time zero: that of a frequency which is zero."""

SCALAR_BITS = 160
"""Binary digits of a frequency at a single time: 50 of the phase, 53 of the remainder, and those that cancel."""

# Constants that meet arrays are arrays without dimensions, see `atlas.arithmetic.circle`.
SPLITTER = np.array(2.0**27 + 1)
"""Veltkamp's: t SPLITTER cuts t into two halves of 26 digits, whose products with halves are exact."""

ROUNDER, QUANTUM = np.array(1.5 * 2.0**52), np.array(1.5 * 2.0**27)
"""Adding and subtracting them rounds to whole numbers, the last digit of the sum being the parity, and to 2^-25."""

EVEN = 2 * ROUNDER
"""The same for even numbers."""

MAX_NEAR_PHASE = 2.0**21
"""Half a phase, in radians, up to which three products of words hold it."""

NEAR_PHASE_RATIO = 4.0
"""How much further they do where the phase is rounded."""

TURN_OF_INTEGERS = units(TURN, SCALAR_BITS)
"""One turn in radians, in units of 2^-SCALAR_BITS."""

QUARTER = scaled(TURN, -2)
HEAD = round(nearest(QUARTER) * 2.0**26) / 2.0**26
with workprec():
    TAIL = nearest(QUARTER - HEAD)
MINUS_HEAD, MINUS_TAIL = np.array(-HEAD), np.array(-TAIL)
QUARTER_TURN, MINUS_BOTH = np.array(nearest(QUARTER)), np.array([MINUS_HEAD, MINUS_TAIL])[:, None, None]
"""pi/2, and -pi/2 as a head of 27 digits, whose product with a multiple of 2^-25 below one is exact, and a tail."""


MIN_LONGEST_TIME = 1e-290
"""Longest time below which it is the unit of frequency that is at fault."""


class Phases:
    """Phases of one or two frequencies, with the tables that evaluate them at times t.

    Made from `turns`, the frequencies, exact, in turns per unit of time, and `origins`, if given, phases at t = 0,
    in turns. P0 + P1 is the frequency in half turns to 2^-107 of itself. `rounder` (n, 1) rounds to the half turns that
    are left out: EVEN ones for whole turns. `longest` is the largest |t|.

        >>> t, cos, sin = np.array([1e15]), np.empty((1, 1)), np.empty((1, 1))
        >>> with workprec():
        ...     turns = [1 / TURN]
        >>> Phases(turns).circle(t, room(1, 1), cos, sin, np.empty(1))
        >>> 2 * float(cos[0, 0])  # that of 1e15
        -0.51319373778697...
    """

    def __init__(
        self, turns: Sequence[Number], origins: Sequence[Number] | None = None, rounder: FloatArray = ROUNDER
    ) -> None:
        halves = [scaled(middle(turn), 1) for turn in turns]
        exponents = _exponents(halves)
        small = halves
        self.exponents = None
        if any(exponents):
            small = [scaled(p, -x) for p, x in zip(halves, exponents, strict=True)]
            self.exponents = np.array(exponents)[:, None]
        self.rounder = rounder
        with workprec():
            fastest = max(abs(p * QUARTER) for p in halves)
            self._within(_reach(fastest))
            self.max_near_time = nearest(MAX_NEAR_PHASE / fastest) if fastest != 0 else inf
        self._small, self._starts = small, origins

    @cached_property
    def words(self) -> FloatArray:
        """Frequencies in half turns as double-double numbers P0 + P1: rows -P0 and P1, shape (2, n, 1)."""
        P0, P1 = _columns([words(p, 2) for p in self._small])
        return np.array([-P0, P1])

    @cached_property
    def halves(self) -> FloatArray:
        """P0 of `words` as a sum of two doubles of at most 26 binary digits, the larger first, shape (2, 1, n, 1)."""
        P0 = -self.words[0]
        head = P0 * SPLITTER - (P0 * SPLITTER - P0)
        return np.array([head, P0 - head])[:, None]

    @cached_property
    def origins(self) -> FloatArray | None:
        """Phases at t = 0 in half turns, a multiple of 2^-25 and the remainder, (2, n, 1); None if all are zero."""
        with workprec():
            return None if self._starts is None else _columns([_cut(turn) for turn in self._starts])

    @cached_property
    def starts(self) -> tuple[FloatArray, FloatArray]:
        """Half of `origins` in rad, (n, 1) each: the multiple of 2^-25 times the head of pi/2, and the rest."""
        multiple, low = _columns([(0.0, 0.0)]) if self.origins is None else self.origins
        return -multiple * MINUS_HEAD, low * QUARTER_TURN - multiple * MINUS_TAIL

    @cached_property
    def _turns_of_integers(self) -> list[tuple[int, int, int]]:
        """Triples (n, digits, start), one for each phase.

        The frequency is n/2^digits turns, to 2^-SCALAR_BITS; the phase at t = 0 is start/2^SCALAR_BITS turns.
        """
        turns = []
        starts = [turn_of(x) for x in self._starts] if self._starts else [None] * len(self._small)
        for half, start in zip(map(scaled, self._small, self._exponents_of_one()), starts, strict=True):
            after = max(SCALAR_BITS - magnitude(half), 3) if half != 0 else 3
            turns.append((units(half, after), after + 1, units(start, SCALAR_BITS) if start else 0))
        return turns

    def _exponents_of_one(self) -> list[int]:
        return [0] * len(self._small) if self.exponents is None else self.exponents[:, 0].tolist()

    def circle_of_one(self, t: float) -> list[tuple[float, float, float]]:
        """Return [(cos(x)/2, sin(x)/2, (1 - cos x)/2), ...] for each phase x = f t at one time, without origins.

        The product in turns is exact, and so is its distance from a quarter turn, |y| <= 1/8. The angle 2 pi y is
        rounded once, sine and cosine are within an ulp: cos and sin are within 2 w, w = 2^-53, where `circle` has 8.
        """
        functions = []
        for x, digits in self._phases_of_one(t):
            quarter = (x + (1 << digits - 3)) >> digits - 2
            angle = (x - (quarter << digits - 2)) * TURN_OF_INTEGERS / (1 << digits + SCALAR_BITS)
            c, s = cos(angle) / 2, sin(angle) / 2
            if quarter & 1:
                c, s = -s, c
            if quarter & 2:
                c, s = -c, -s
            functions.append((c, s, 0.5 - c if quarter & 3 else sin(angle / 2) ** 2))
        return functions

    def halves_of_one(self, t: float) -> list[float]:
        """Return a list of half of each phase at one time, in rad, less the turns that `rounder` leaves out.

        Each is rounded once.
        """
        return [half / unit for half, unit in self._exact_halves_of_one(t)]

    def words_of_one(self, t: float) -> tuple[list[float], list[float]]:
        """Return half of each phase at one time in two words: (`halves_of_one`, their rounding errors), in rad."""
        halves, low_words = list[float](), list[float]()
        for half, unit in self._exact_halves_of_one(t):
            halves.append(half / unit)
            p, q = halves[-1].as_integer_ratio()
            low_words.append((half - p * (unit // q)) / unit)
        return halves, low_words

    def _exact_halves_of_one(self, t: float) -> Iterator[tuple[int, int]]:
        """Yield each of `halves_of_one` in rad as (numerator, a power of two as denominator), to 2^-SCALAR_BITS."""
        for (x, digits), is_even in zip(self._phases_of_one(t), self._is_even, strict=True):
            half = 1 << digits - (1 if is_even else 2)
            yield (((x + half) % (2 * half)) - half) * TURN_OF_INTEGERS, 1 << digits + SCALAR_BITS + 1

    @cached_property
    def _is_even(self) -> list[bool]:
        """List with one boolean a phase: whether whole turns are left out, not half turns."""
        return [bool(x) for x in np.broadcast_to(np.ravel(self.rounder) == EVEN, len(self._small))]

    def _phases_of_one(self, t: float) -> Iterator[tuple[int, int]]:
        """Yield the phase of each frequency at one time as (n, digits): n/2^digits turns, with its origin.

        Raises AtlasError beyond `longest`.
        """
        if not abs(t) <= self.longest:
            self.check(np.array([t]))
        p, q = t.as_integer_ratio()
        for turns, after, start in self._turns_of_integers:
            exact_digits = after + q.bit_length() - 1
            digits = max(exact_digits, SCALAR_BITS) if start else exact_digits
            yield (turns * p << digits - exact_digits) + (start << digits - SCALAR_BITS if start else 0), digits

    @cached_property
    def radians(self) -> FloatArray:
        """Half of each of n frequencies, in rad per unit of time, (2, n, 1): a head of 26 binary digits, and the rest.

        Where `exponents` is not None, the numbers are scaled by 2^-exponents.
        """
        with workprec():
            return _columns([_head(p * QUARTER)[:2] for p in self._small])

    @cached_property
    def _sums(self) -> tuple[FloatArray, FloatArray]:
        """Leading 26 binary digits of P0 + P1, (n, 1), and the matrix (n, k) that sums the k rows of `halves_of`."""
        with workprec():
            head, *lows = _columns([_head(p) for p in self._small])
        columns = [] if self.origins is None else [self.origins[1]]
        return head, QUARTER_TURN * np.hstack([*columns, *lows, np.eye(len(head))])

    @classmethod
    def of_words(cls, words: FloatArray) -> Self:
        """Return phases of frequencies P0 + P1 in half turns, ``words`` (2, n, m), each for one time.

        Times have no limit.
        """
        self = cls.__new__(cls)
        self.words = np.array([-words[0], words[1]])
        is_still = words[0] == 0
        self.exponents = np.where(is_still, ZERO_EXPONENT, 0) if is_still.any() else None
        self.origins, self.rounder, self.max_near_time = None, ROUNDER, -1.0
        self._within(inf)
        return self

    def _within(self, reach: float) -> None:
        """Set `reach`, and `longest`, the smaller of it and the largest double."""
        self.reach, self.longest = reach, min(reach, float(np.finfo(float).max))

    def circle(self, t: FloatArray, work: FloatArray, cos: FloatArray, sin: FloatArray, versine: FloatArray) -> None:
        """Fill cos(x)/2 and sin(x)/2 (n, m), and (1 - cos x)/2 of the first phase (m,), for x = f t.

        `t` (m,) finite; `work` (8, n, m) is overwritten. Halves, since they come free of a rounding. The versine keeps
        its digits where x is small. Raises AtlasError if a phase is beyond MAX_PHASE or a time is not finite.

        Without origins cos and sin are within 8 units of w = 2^-53, four ulp of 1, if NumPy's tangent is within an ulp.
        Proof, to first order in w, |x| <= 1.8 as `angles` leaves it. The phase: P1 t, the last sum of `rest` (< 1/8)
        and the words left out are 0.35 w of x; y and its sum 0.25 w more. u = tan(x/2) <= 1.26 is within 1.5 ulp, one
        of the tangent and a half of the sum with e (1 + u^2): 1.5 w below 1, 3 w above. The roundings of u^2, 1 + u^2
        and the quotient: sin has the relative error (2 + q) w, q = u^2/(1 + u^2), and u sin has (3 + q) w; the last
        difference is half a unit of cos at most. So the error of cos = 1 - 2 q is below

            4 u/(1 + u^2)^2 du + 2 q (3 + q) w + 0.5 w + 0.6 w = 7.8 w at u = 1.26, 7.6 w at u = 1 from above,

        and less below; that of sin is below 2 |1 - u^2|/(1 + u^2)^2 du + (2 + q) w + 0.6 w < 5 w.
        """
        circle_of(*self.angles(t, work), cos, sin, versine)

    def angles(self, t: FloatArray, work: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Return x/2 for x = f t less whole half turns, its rounding error, the sign of those half turns, a free array.

        All are (n, m), the first two in radians, and lie in ``work`` (8, n, m). The sign is 1.0 for an even number
        of half turns, -1.0 for an odd one. At phases near MAX_PHASE the whole half turns are those nearest to P0 t,
        whose rounding and P1 t are up to 0.08 half turns: |x| <= 1.8.
        """
        half, remainder, half_turns, free_rows = self.reduced(t, work)
        return half, remainder, signs(half_turns), free_rows

    def reduced(self, t: FloatArray, work: FloatArray, low: FloatArray | None = None) -> tuple[FloatArray, ...]:
        """Return (x/2, its rounding error, half turns + `rounder`, spare array), as `angles` does with signs.

        ``low`` (m,) are low words of the times t (m,). The arrays are (n, m) and lie in ``work`` (8, n, m). Raises
        AtlasError for a time beyond `longest`.
        """
        farthest_time = farthest(t)
        if not farthest_time <= self.longest:
            self.check(t)
        if self.exponents is not None:
            t = np.ldexp(t, self.exponents)
            low = None if low is None else np.ldexp(low, self.exponents)
        halves = work[6:] if t.ndim > 1 else work[6:, :1]
        upper, lower = halves
        np.multiply(t, SPLITTER, out=upper)
        np.subtract(upper, t, out=lower)
        upper -= lower
        np.subtract(t, upper, out=lower)
        if farthest_time <= self.max_near_time:
            if low is not None:
                lower += low
                t = t + low
            return self._reduced_near(t, halves, work)
        # the sum of -P0 t, its four products of halves and P1 t, in this order, is the error of -P0 t, by Dekker
        products, remainder, multiple = work[:6], work[6], work[7]
        np.multiply(self.words, t, out=products[::5])
        np.multiply(self.halves, halves, out=products[1:5].reshape(2, 2, *remainder.shape))
        np.add.reduce(products, axis=0, out=remainder)
        if low is not None:
            np.multiply(self.words[0], low, out=multiple)
            remainder -= multiple
        # `half_turns` and the remainder `product` have the opposite sign
        product, half_turns, y = products[:3]
        np.add(product, self.rounder, out=half_turns)
        np.subtract(half_turns, self.rounder, out=multiple)
        product -= multiple
        # in half turns the phase is remainder - multiple, the latter of 2^-25
        np.add(product, QUANTUM, out=multiple)
        multiple -= QUANTUM
        product -= multiple
        remainder -= product
        if self.origins is not None:
            multiple -= self.origins[0]
            remainder += self.origins[1]
            np.add(multiple, self.rounder, out=y)
            half_turns.view(np.int64)[:] += y.view(np.int64)
            y -= self.rounder
            multiple -= y
        # in radians, and halved: multiple MINUS_HEAD is exact, y is small
        np.multiply(multiple, MINUS_TAIL, out=y)
        remainder *= QUARTER_TURN
        y += remainder
        multiple *= MINUS_HEAD
        np.add(multiple, y, out=product)
        multiple -= product
        multiple += y
        return product, multiple, half_turns, remainder

    def halves_of(
        self, t: FloatArray, work: FloatArray, low: FloatArray | None = None, turns: FloatArray | None = None
    ) -> FloatArray:
        """Return x/2 for x = f t less the half turns that `rounder` leaves out, (n, m) in rad, rounded once.

        ``t`` (m,) are times, ``low`` (m,) their low words. The result lies in ``work`` (8, n, m), whose last axis
        may be longer than t's. ``turns`` (n, m), if given, gets the number of half turns that are left out, plus
        `rounder`.

        For half phases up to NEAR_PHASE_RATIO MAX_NEAR_PHASE the head of the frequency times that of t is exact,
        and so is its remainder without whole half turns; the products of the rest are below 1/4. A matrix product
        sums them, the largest last. For other phases the result is that of `reduced`.
        """
        if self.exponents is not None or not farthest(t) <= NEAR_PHASE_RATIO * self.max_near_time:
            half, _, half_turns, _ = self.reduced(t, work[..., : t.size], low)
            if turns is not None:
                turns[:] = half_turns
            return half
        head, table = self._sums
        n, k = table.shape
        rows = work.reshape(-1, work.shape[-1])[:, : t.size]
        stack, half_turns, x = rows[:k], rows[k : k + n], rows[k + n : k + 2 * n]
        *origin_rows, upper, lower = stack[: k - n]
        p = stack[k - n :]
        np.multiply(t, SPLITTER, out=upper)
        np.subtract(upper, t, out=lower)
        upper -= lower
        np.subtract(t, upper, out=lower)
        if low is not None:
            lower += low
        np.multiply(head, upper, out=p)
        if self.origins is not None:
            origin_rows[0][:] = 1.0
            p += self.origins[0]
        np.add(p, self.rounder, out=half_turns)
        if turns is not None:
            turns[:] = half_turns
        half_turns -= self.rounder
        p -= half_turns
        return np.matmul(table, stack, out=x)

    def _reduced_near(self, t: FloatArray, halves: FloatArray, work: FloatArray) -> tuple[FloatArray, ...]:
        """Return the result of `reduced` for half phases up to MAX_NEAR_PHASE, by Cody and Waite.

        ``halves`` are the upper and lower halves of the times t. The half phase is half f t less w pi/2, both
        split. With F0 + F1 half the frequency and t0 + t1 the time, F0 t0 and w times the head of pi/2 have 53
        digits, and their difference, below 2, is exact. The rest, F0 t1 + F1 t less w times the tail, is below 1/8:
        two sums of it are within 2^-57, two products within 2^-59, and F1 and the tail lack 2^-59: in all 2^-55.7
        of x/2, 0.3 w of x. The low part of a time is in t1, whose sum and product are then within 2^-59 each: 0.1 w
        more.
        """
        products, product, half_turns, w = work[:2], work[2], work[3], work[7]
        np.multiply(self.radians[0], halves, out=products)
        np.multiply(self.words[0], t, out=product)
        if self.origins is not None:
            product -= self.origins[0]
        np.subtract(self.rounder, product, out=half_turns)
        np.subtract(half_turns, self.rounder, out=w)
        np.multiply(w, MINUS_BOTH, out=work[4:6])
        products += work[4:6]
        head, remainder = products
        np.multiply(self.radians[1], t, out=product)
        remainder += product
        if self.origins is not None:
            head += self.starts[0]
            remainder += self.starts[1]
        np.add(head, remainder, out=product)
        head -= product
        head += remainder
        return product, head, half_turns, remainder

    def check(self, t: FloatArray) -> None:
        """Raise AtlasError if |t| of a time is larger than `reach`, or a time is infinite or not a number."""
        far_times = t[~((np.abs(t) <= self.reach) & np.isfinite(t))]
        if far_times.size:
            units = (
                "" if self.reach > MIN_LONGEST_TIME else " A frequency is too large for a float: choose larger units."
            )
            raise AtlasError(
                f"A time is {far_times[0]}, but |t| may be {self.reach:.6g} at most, where a phase reaches 2^50 and is "
                f"lost.{units}"
            )


def _exponents(halves: Sequence[Number]) -> list[int]:
    """Return exponents of two by which frequencies, ``halves``, are divided: all zeros unless one is extreme.

    If one is beyond 2^±SAFE_EXPONENT, or all are zero, each frequency has its own, and a zero one ZERO_EXPONENT.
    """
    moving = [magnitude(p) for p in halves if p != 0]
    if moving and all(abs(x) <= SAFE_EXPONENT for x in moving):
        return [0] * len(halves)
    return [magnitude(p) if p != 0 else ZERO_EXPONENT for p in halves]


def room(frequencies: int, times: int) -> FloatArray:
    """Return scratch memory, uninitialised, (8, frequencies, times), the `work` of `Phases.angles`."""
    keep()
    return np.empty((8, frequencies, times))


def farthest(t: FloatArray) -> float:
    """Return the largest |t| of an array; NaN if it holds one, 0.0 if it is empty."""
    return max(t.item(t.argmax()), -t.item(t.argmin())) if t.size else 0.0


def _columns(rows: Sequence[Sequence[float]]) -> FloatArray:
    """Return rows of words, one row for each frequency, as an array (words, n, 1) to multiply with times."""
    return np.array(rows).T[:, :, None]


def _reach(fastest: Number) -> float:
    """Return the longest time for which 2 ``fastest`` t, a phase in rad, stays within MAX_PHASE; inf for 0."""
    return nextafter(nearest(MAX_PHASE / (2 * fastest)), inf) if fastest != 0 else inf


def _head(x: Number) -> tuple[float, float, float]:
    """Return three doubles: the leading 26 binary digits of x, the rest of x, and x itself, rounded."""
    value = nearest(x)
    size = frexp(value)[1]
    head = ldexp(round(ldexp(value, 26 - size)), size - 26)
    return head, nearest(x - head), value


def _cut(turn: Number) -> tuple[float, float]:
    """Return a phase in turns, less the nearest whole number, as (multiple of 2^-25, remainder) in half turns."""
    fraction = turn_of(turn)
    head = round(ldexp(nearest(fraction), 26)) / 2.0**25
    return head, 2 * nearest(fraction - head / 2)
