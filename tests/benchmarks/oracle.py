"""The true values as balls from the exact inputs, and a Taylor integration that checks them.

The question: is the reference right, and far more accurate than the measured methods?

The values are balls of `certified` modules, which share no code with the kernels, rounded to two words each (32
digits), so that errors far below one ulp can be measured. `check` integrates the equations of motion themselves.
"""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import numpy as np
from flint import arb, arb_poly, arb_series, ctx

from atlas.arithmetic.numbers import workprec
from benchmarks.case import Case, FloatArray
from benchmarks.results import spread

BITS = 256
ORDER = 40
STEP = 0.125


@dataclass(frozen=True)
class Reference:
    """True values ``high + low`` at the times number ``checked`` of ``count``, and the scale of the errors there."""

    high: FloatArray
    low: FloatArray
    scale: FloatArray
    checked: list[int]
    count: int

    def error(self, values: FloatArray) -> float:
        """Return the largest error of any entry of values (count, ...) where it is checked; infinite where none is."""
        shape = self.count, *self.high.shape[1:]
        if values.shape != shape:
            raise ValueError(f"values of shape {values.shape} where {shape} was asked for")
        difference = np.abs((values[self.checked] - self.high) - self.low) / self.scale
        return float(difference.max()) if np.isfinite(difference).all() else float("inf")


def reference(case: Case, times: FloatArray) -> Reference:
    """Return the true values of a case, at all times or at ``case.checked`` of them, spread evenly."""
    checked = spread(len(times), case.checked or len(times))
    with workprec(BITS):
        words = [_two_words(x) for t in times[checked].tolist() for x in case.exact(t)]
    high, low = np.array(words).T.reshape(2, len(checked), *case.shape)
    return Reference(high, low, case.scale(high), checked, len(times))


def check(case: Case, until: float) -> float:
    """Return the largest distance of the reference from a Taylor integration of the equations of motion to ``until``.

    Every step sums ``ORDER`` terms; the series come from Picard's iteration, which gains one term each time. A step
    starts at the centres of the balls that the last one made: their radii would grow far beyond the errors there are.
    """
    with workprec(BITS), _series(ORDER):
        parameters = {name: _balls(value) for name, value in case.parameters.items()}
        state, now = [arb(x) for x in case.initial()], 0.0
        distance = 0.0
        while now < until:
            state = [arb_poly(series.coeffs())(arb(STEP)).mid() for series in _picard(case, state, parameters)]
            now += STEP
            truth = case.exact(now)
            distance = max(distance, *(float(abs(a - b).upper()) for a, b in zip(state, truth, strict=False)))
    return distance


def _picard(case: Case, state: Sequence[Any], parameters: dict[str, Any]) -> list[Any]:
    """Return the power series in time that start at ``state`` and obey the equations."""
    start = [arb_series([x], ORDER) for x in state]
    series = start
    for _ in range(ORDER):
        series = [x + rate.integral() for x, rate in zip(start, case.rates(series, parameters), strict=True)]
    return series


@contextmanager
def _series(order: int) -> Iterator[None]:
    """Let power series keep ``order`` terms."""
    before, ctx.cap = ctx.cap, order
    try:
        yield
    finally:
        ctx.cap = before


def _balls(value: Any) -> Any:
    return tuple(arb(x) for x in value) if isinstance(value, tuple) else arb(value)


def nearest(value: Any) -> float:
    """Round a certified number to a float."""
    return float(arb(value).mid())


def _two_words(value: Any) -> tuple[float, float]:
    """Round a certified number to the sum of two floats."""
    high = nearest(value)
    return high, nearest(arb(value) - high)
