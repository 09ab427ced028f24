"""One axis of a panel: which place on paper a value has, and where the ticks are with their numbers."""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
Kind: TypeAlias = Literal["linear", "log", "symlog"]

_STEPS = (1.0, 2.0, 2.5, 5.0, 10.0)
_MOST = 9
_AROUND = 0.05
_FAR = 1e6


@dataclass(frozen=True)
class Ticks:
    """Places of the ticks in points along the axis, the long ones with their numbers, and a factor of all numbers."""

    long: tuple[tuple[float, str], ...]
    short: tuple[float, ...] = ()
    factor: str = ""


@dataclass(frozen=True)
class Axis:
    """The values from ``low`` to ``high`` on a ``length`` of paper; about ``room`` points are needed for a number.

    Between minus and plus ``linear`` a symmetric logarithm is linear.
    """

    kind: Kind
    low: float
    high: float
    length: float
    room: float
    linear: float = 1.0

    def place(self, values: FloatArray) -> FloatArray:
        """Return places in points of values; not a number where there is none, and never further than 1e6 away."""
        a, b = self._bent(np.array([self.low, self.high]))
        with np.errstate(all="ignore"):
            return np.clip(self.length * ((self._bent(values) - a) / (b - a)), -_FAR, _FAR)

    def value(self, place: float) -> float:
        """Return the value at a place in points."""
        a, b = self._bent(np.array([self.low, self.high]))
        bent = float(a + (b - a) * place / self.length)
        if self.kind == "linear":
            return bent
        return float(10.0**bent if self.kind == "log" else self._symmetric.inverted().transform(np.array([bent]))[0])

    @property
    def ticks(self) -> Ticks:
        """The ticks of Matplotlib's locators, with the numbers of its formatters."""
        from matplotlib import ticker

        view = _View(self)
        if self.kind == "linear":
            major: ticker.Locator = ticker.MaxNLocator(nbins=view.get_tick_space(), steps=_STEPS)
            number: ticker.Formatter = ticker.ScalarFormatter(useMathText=False)
            minor = None
        elif self.kind == "log":
            major, minor, number = ticker.LogLocator(), ticker.LogLocator(subs=None), ticker.LogFormatterSciNotation()
        else:
            major, number = ticker.SymmetricalLogLocator(self._symmetric), ticker.LogFormatterSciNotation()
            minor = None
        for helper in filter(None, (major, minor, number)):
            helper.set_axis(view)
        values = self._seen(major.tick_values(self.low, self.high))
        names = number.format_ticks(values)
        factor = ""
        if isinstance(number, ticker.ScalarFormatter):
            number.set_useMathText(True)
            factor = number.get_offset()
        long = [(float(place), name) for place, name in zip(self.place(values), names, strict=True)]
        if minor is None:
            return Ticks(tuple(long), factor=factor)
        between = self._seen(minor.tick_values(self.low, self.high))
        between = between[~np.isin(np.round(self.place(between), 6), np.round(self.place(values), 6))]
        second = ticker.LogFormatterSciNotation()
        second.set_axis(view)
        named = zip(self.place(between), second.format_ticks(between) if len(values) < 2 else (), strict=False)
        long += [(float(place), name) for place, name in named if name]
        return Ticks(tuple(long), tuple(float(place) for place in self.place(between)), factor)

    def _seen(self, values: Iterable[float]) -> FloatArray:
        """Return the values that are in view."""
        found = np.asarray(list(values), dtype=float)
        places = self.place(found)
        return found[(places > -1e-6) & (places < self.length + 1e-6)]

    def _bent(self, values: FloatArray) -> FloatArray:
        """Return what is proportional to the place."""
        if self.kind == "linear":
            return np.asarray(values, dtype=float)
        with np.errstate(all="ignore"):
            return np.asarray(np.log10(values) if self.kind == "log" else self._symmetric.transform(values))

    @cached_property
    def _symmetric(self):  # noqa: ANN202  a Matplotlib transform, whose module is loaded only here
        from matplotlib.scale import SymmetricalLogTransform

        return SymmetricalLogTransform(10, self.linear, 1)


class _View:
    """What Matplotlib's locators and formatters ask of an axis."""

    __name__ = "axis"

    def __init__(self, axis: Axis) -> None:
        self._axis = axis

    def get_view_interval(self) -> tuple[float, float]:
        return self._axis.low, self._axis.high

    get_data_interval = get_view_interval

    def get_minpos(self) -> float:
        return self._axis.low if self._axis.low > 0.0 else 1e-300

    def get_tick_space(self) -> int:
        return int(np.clip(self._axis.length // self._axis.room, 1 if self._axis.kind == "linear" else 2, _MOST))

    def get_transform(self) -> object:
        return self._axis._symmetric if self._axis.kind == "symlog" else None  # noqa: SLF001  its other half


def limits(kind: Kind, values: FloatArray) -> tuple[float, float]:
    """Return the limits of an axis that shows all values, with a little air on both sides."""
    axis = Axis(kind, 1.0, 10.0, 1.0, 1.0, linear(values))
    bent = axis._bent(values[(values > 0.0) | (kind != "log")])  # noqa: SLF001  the same file
    bent = bent[np.isfinite(bent)]
    low, high = (float(bent.min()), float(bent.max())) if bent.size else (0.0, 1.0)
    air = _AROUND * (high - low) or _AROUND * max(abs(low), 1.0)
    a, b = axis._bent(np.array([1.0, 10.0]))  # noqa: SLF001
    return axis.value(float((low - air - a) / (b - a))), axis.value(float((high + air - a) / (b - a)))


def linear(values: FloatArray) -> float:
    """Return where a symmetric logarithm turns linear: the power of ten below the smallest value."""
    sizes = np.abs(values)
    sizes = sizes[np.isfinite(sizes) & (sizes > 0.0)]
    return float(10.0 ** np.floor(np.log10(sizes.min()))) if sizes.size else 1.0
