"""Errors of floats against balls, in units in the last place, and the worst of them."""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from flint import arb, fmpq

from atlas.core.inputs import FloatArray
from atlas.errors import AtlasError
from atlas.exact.inputs import Real
from atlas.formulas.numbers import workprec

ONE = 2.0**-52
"""A unit in the last place of 1."""

BITS = 80
"""Relative accuracy of the truth: a 2^-27th of a double's."""


@dataclass(frozen=True)
class Worst:
    """The largest error of a quantity in a regime, the exact input that gives it, and how many values were checked."""

    quantity: str
    regime: str
    ulps: float
    input: Mapping[str, Any]
    samples: int


@dataclass(frozen=True)
class Refusal:
    """An input that a kernel would not answer, and what it said."""

    quantity: str
    regime: str
    reason: str
    input: Mapping[str, Any]


@dataclass
class WorstErrors:
    """The worst errors found so far, by quantity and regime, and the refusals."""

    worst: dict[tuple[str, str], Worst] = field(default_factory=dict)
    refusals: list[Refusal] = field(default_factory=list)

    def add(self, quantity: str, regime: str, errors: Sequence[float], describe: Callable[[int], Any]) -> None:
        """Take errors in ulps; ``describe(i)`` gives the input of the i-th."""
        if errors:
            index = max(range(len(errors)), key=errors.__getitem__)
            self._take(Worst(quantity, regime, errors[index], describe(index), len(errors)))

    @contextmanager
    def checking(self, quantity: str, regime: str, inputs: Any) -> Iterator[None]:
        """Check at the precision of the truth, and keep what a kernel says when it will not answer."""
        try:
            with workprec(BITS + 16):
                yield
        except AtlasError as reason:
            self.refusals.append(Refusal(quantity, regime, str(reason), inputs))

    def merge(self, other: "WorstErrors") -> None:
        """Take over what others found."""
        for worst in other.worst.values():
            self._take(worst)
        self.refusals.extend(other.refusals)

    def _take(self, new: Worst) -> None:
        key = new.quantity, new.regime
        known = self.worst.get(key, Worst(*key, -1.0, {}, 0))
        larger = new if new.ulps > known.ulps else known
        self.worst[key] = Worst(*key, larger.ulps, larger.input, new.samples + known.samples)


UNDERFLOW = 2.0**-1010
"""Below it intermediate results may lose bits to underflow: errors are in ulps of this size."""


def ulp(value: Real) -> float:
    """Return the unit in the last place of the double nearest to a number; of the largest double beyond it."""
    size = abs(approximate(value))
    return math.ulp(max(size, UNDERFLOW)) if math.isfinite(size) else 2.0**971


def approximate(value: Real) -> float:
    """Return the double nearest to the middle of a ball, or inf."""
    if isinstance(value, arb):
        return float(value.mid())
    p, q = int(value.p), int(value.q)
    try:
        return p / q
    except OverflowError:
        return math.inf if p > 0 else -math.inf


def error(found: float, true: Real, unit: float) -> float:
    """Return an upper bound on |found - true| in units; 0 where an infinity stands for a number beyond the doubles."""
    if not math.isfinite(found):
        return 0.0 if found == approximate(true) else math.inf
    return float(abs((arb(float(found)) - true) / arb(unit)).upper())


def own(found: Iterable[float], true: Iterable[Real]) -> list[float]:
    """Return the errors of numbers, each in ulps of itself."""
    return [error(x, y, ulp(y)) for x, y in zip(found, true, strict=True)]


def absolute(found: Iterable[float], true: Iterable[Real]) -> list[float]:
    """Return the errors of numbers, each in ulps of 1."""
    return [error(x, y, ONE) for x, y in zip(found, true, strict=True)]


def of_length(found: Iterable[float], true: Sequence[Real]) -> float:
    """Return the largest error of a vector's components in ulps of its length."""
    square = sum((x * x for x in true), fmpq(0))
    unit = ulp(arb(square).sqrt())
    return max(error(x, y, unit) for x, y in zip(found, true, strict=True))


def rigidity(R: FloatArray) -> tuple[list[float], list[float]]:
    """Return by how much R^T R and det R of matrices (m, 3, 3) differ from 1, in ulps of 1, in extended precision."""
    long = R.astype(np.longdouble)
    defect = np.abs(np.swapaxes(long, 1, 2) @ long - np.eye(3, dtype=np.longdouble)).max(axis=(1, 2))
    determinant = np.abs(np.einsum("ni,ni->n", long[:, 0], np.cross(long[:, 1], long[:, 2])) - 1)
    return (defect / ONE).astype(float).tolist(), (determinant / ONE).astype(float).tolist()


def with_more(inputs: dict[str, Any], **more: Any) -> Callable[[int], dict[str, Any]]:
    """Return the description of an input with more of it, whichever of the values was the worst."""
    return lambda _: inputs | more
