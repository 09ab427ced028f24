"""Frequencies of many motions in two words, each with a bound on its error, for phases up to 2^50."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import prod
from typing import Any

import numpy as np

from atlas.core.arithmetic.double_double import DoubleDouble, blocks
from atlas.core.arithmetic.phase import LIMIT
from atlas.core.arithmetic.words import TURN, magnitude, middle, scaled, words
from atlas.core.inputs import FloatArray
from atlas.errors import AtlasError, DomainError
from atlas.formulas.numbers import Number, workprec

with workprec():
    HEAD, TAIL = (np.float64(x) for x in words(2 / TURN, 2))
PER_RADIAN = DoubleDouble(HEAD, TAIL, 2.0**-105)
"""Half turns in a radian."""

LARGEST = 1020
"""Power of two beyond which a frequency is none of several."""

LOST = 2.0**-55
"""Half turns that a phase may lack by the error of its frequency: less than half an ulp of 1 in a matrix."""


@dataclass(frozen=True)
class Frequencies:
    """Frequencies in half turns per unit of time: `words` (2, n, m) are P0 and P1, `lack` (n, m) bounds their error.

    `exact(i)` returns the n frequencies of the i-th motion in radians.
    """

    words: FloatArray
    lack: FloatArray
    exact: Callable[[Any], Sequence[Number]]

    def at(self, index: Any, t: FloatArray) -> FloatArray:
        """Return words of motions by their index, good for the times t that go with them.

        Raises AtlasError if a phase is too long.
        """
        words = self.words[..., index].copy()
        with np.errstate(over="ignore", invalid="ignore"):
            doubtful = np.flatnonzero(~(self.lack[:, index] * abs(t) <= LOST).all(axis=0))
            motions = np.arange(self.words.shape[2])[index]
            for i in doubtful.tolist():
                words[:, :, i] = np.transpose([_words(f) for f in self.exact(motions[i])])
            far = np.flatnonzero((abs(words[0] * t) > LIMIT / np.pi).any(axis=0))
        if far.size:
            longest = LIMIT / np.pi / abs(words[0][:, far[0]]).max()
            raise AtlasError(
                f"A time is {t[far[0]]}, but |t| may be {longest:.6g} at most, where a phase reaches 2^50 and is lost."
            )
        return words


def _words(frequency: Number) -> list[float]:
    """Return an exact frequency in radians as two words in half turns."""
    with workprec():
        halves = scaled(middle(frequency / TURN), 1)
    if halves != 0 and magnitude(halves) > LARGEST:
        raise DomainError("A frequency of one of these motions is too large for a float: choose larger units.")
    return words(halves, 2)


def words_of(formula: Callable[..., Any], inputs: Sequence[Any], unit: slice) -> tuple[FloatArray, FloatArray]:
    """Return the frequencies that a formula gives for inputs that broadcast: `words` and `lack` of `Frequencies`."""
    shape = np.broadcast_shapes(*(np.shape(x) for x in inputs))
    words, lack = list[Any](), list[Any]()
    for part, _, exponents, found in blocks(formula, inputs, shape, unit):
        turns = [frequency * PER_RADIAN for frequency in found]
        both = np.array([[np.broadcast_to(x, part.stop - part.start) for x in (f.hi, f.low)] for f in turns])
        error = np.array([np.broadcast_to(f.rel * abs(f.hi), part.stop - part.start) for f in turns])
        if exponents is not None:
            both, error = np.ldexp(both, exponents[0]), np.ldexp(error, exponents[0])
            error[:, ~exponents[1]] = np.nan
        words.append(both)
        lack.append(error)
    if not prod(shape):
        return np.empty((2, 2, 0)), np.empty((2, 0))
    return np.concatenate(words, axis=2).swapaxes(0, 1), np.concatenate(lack, axis=1)
