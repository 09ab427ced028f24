"""A sweep as data: the family, its parameters by name, the quantities; and any rows of its table."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import prod
from time import perf_counter, process_time
from typing import Any

import numpy as np
from numpy.typing import NDArray

from atlas.core.inputs import real
from atlas.errors import AtlasError
from atlas.families.family import TIME
from atlas.study.sweep.families import FAMILIES, MISSING

Columns = dict[str, NDArray[Any]]

LARGEST = 10**11
"""Rows of a table: some 10 TB of them."""
SAMPLE, SHORTEST = 0.1, 1e-9
"""Seconds that a sample of rows should take, to tell how long a row takes; the least that this is believed to be."""


@dataclass(frozen=True)
class Plan:
    """Rows of parameters of a family, and the quantities that each is to have.

    `parameters` are arrays by name: all their combinations, the last name varying fastest, or, if `listed`, row by row,
    one value for all rows. With `digits` the quantities are text with so many certified digits. `time` is the unit of
    time in headings.
    """

    family: str
    parameters: Mapping[str, NDArray[np.float64]]
    quantities: tuple[str, ...]
    listed: bool = False
    digits: int | None = None
    time: str = TIME

    @classmethod
    def of(
        cls,
        family: str,
        parameters: Mapping[str, Any],
        quantities: Sequence[str],
        *,
        listed: bool = False,
        digits: int | None = None,
        time: str = TIME,
    ) -> "Plan":
        """Check what a user gave. Raises AtlasError for what is unknown, missing, not a number or not of one length."""
        if family not in FAMILIES:
            raise AtlasError(f"There is no family {family!r} to sweep; there is {', '.join(FAMILIES)}.")
        quantities = [quantities] if isinstance(quantities, str) else quantities
        FAMILIES[family].check(list(parameters), quantities, digits)
        arrays = {name: np.atleast_1d(real(value, name)) for name, value in parameters.items()}
        for name, array in arrays.items():
            if array.ndim != 1:
                raise AtlasError(f"The values of {name} must be one number or a list of them, not {array.shape}.")
        if listed:
            count = max(array.size for array in arrays.values())
            for name, array in arrays.items():
                if array.size not in {1, count}:
                    raise AtlasError(f"{name} has {array.size} values, but the list has {count} rows.")
        if digits is not None and digits < 1:
            raise AtlasError(f"A number has at least one digit, not {digits}.")
        plan = cls(family, arrays, tuple(dict.fromkeys(quantities)), listed, digits, time)
        if not 0 < plan.count <= LARGEST:
            raise AtlasError(f"A table has from one row to {LARGEST:.0e}, not {plan.count}.")
        return plan

    @property
    def count(self) -> int:
        """How many rows the table has."""
        sizes = [array.size for array in self.parameters.values()]
        return max(sizes) if self.listed else prod(sizes)

    @property
    def names(self) -> list[str]:
        """Names of the columns: parameters, quantities, and why one of these has no value, if one may have none."""
        # an input that is also asked for, as omega3, stands once
        names = [*(name for name in self.parameters if name not in self.quantities), *self.quantities]
        return names + [MISSING] * any(FAMILIES[self.family].quantities[name].missing for name in self.quantities)

    @property
    def headings(self) -> list[str]:
        """The same as a CSV file has them: with their unit, `k [1/time]`, where there is one."""
        units = {name: unit.replace(TIME, self.time) for name, unit in FAMILIES[self.family].units.items()}
        return [f"{name} [{units[name]}]" if units.get(name) else name for name in self.names]

    def part(self, start: int, stop: int) -> "tuple[Plan, Span]":
        """Return a plan with no more of the parameters than some rows need, and where it has them: to be sent."""
        first, arrays, rest = start, {}, self.count
        for name, array in self.parameters.items():
            if self.listed:
                arrays[name] = array if array.size == 1 else array[first : first + stop - start]
                continue
            # of the outer parameters only those values that occur, as long as there is one
            rest //= array.size
            low, high = start // rest, (stop - 1) // rest
            arrays[name] = array[low : high + 1]
            start, stop = start - low * rest, stop - low * rest
            if high > low:
                arrays |= {other: self.parameters[other] for other in self.parameters if other not in arrays}
                break
        if self.listed:
            start, stop = 0, stop - start
        return Plan(self.family, arrays, self.quantities, self.listed, self.digits), Span(start, stop, first)

    def sample(self, size: int) -> "Plan":
        """Return a list of so many rows at most, spread over the table."""
        rows = np.linspace(0, self.count - 1, min(size, self.count)).astype(np.int64)
        return Plan(self.family, self._given(rows), self.quantities, True, self.digits)

    def seconds(self) -> float:
        """Return how long a row takes here beside others: as many rows are computed as tell it."""
        self.sample(1).columns()  # what is loaded for the first row is not of the rows
        size, took = 1, self._took(1)
        while True:
            size, less, before = 4 * size, size, took
            took = self._took(size)
            # what a call costs however few its rows are is not of the rows either
            if size >= self.count or (took > SAMPLE and took > 2 * before):
                more = min(size, self.count) - less
                return (max(took - before, 0.0) / more if more else took) or SHORTEST

    def _took(self, size: int) -> float:
        """Return the seconds that a sample takes, the smaller of two, without what others took of the machine."""
        rows, took = self.sample(size), []
        for _ in range(2):
            begin = perf_counter(), process_time()
            rows.columns()
            took += [perf_counter() - begin[0], process_time() - begin[1]]
        return min(took)

    def columns(self) -> Columns:
        """Return the table."""
        return self.at(np.arange(self.count))

    def rows(self, span: "Span") -> Columns:
        """Return some rows of the table. An AtlasError names the first of them that it is in, and its parameters."""
        try:
            return self.at(np.arange(span.start, span.stop))
        except AtlasError as error:
            row = self._failing(span.start, span.stop)
            given = ", ".join(f"{name} = {value.item()}" for name, value in self._given(np.array([row])).items())
            number = span.first + row - span.start + 1
            reason = self._refusal(row, row + 1) or error
            raise type(error)(f"In row {number} of the table, {given}: {reason}") from error

    def _failing(self, low: int, high: int) -> int:
        """Return the first of some rows for which there is no answer, as there is none for all of them together."""
        while high - low > 1:
            middle = (low + high) // 2
            low, high = (low, middle) if self._refusal(low, middle) else (middle, high)
        return low

    def _refusal(self, low: int, high: int) -> AtlasError | None:
        """Return why there is no answer for some rows, if there is none."""
        try:
            self.at(np.arange(low, high))
        except AtlasError as error:
            return error
        return None

    def at(self, rows: NDArray[np.int64]) -> Columns:
        """Return some rows of the table, by number."""
        given = self._given(rows)
        family = FAMILIES[self.family]
        defaults = {name: value for name, value in family.optional.items() if value is not None}
        full: Columns = {name: np.full(rows.size, value) for name, value in defaults.items()} | given
        found = (
            family.columns(full, self.quantities)
            if self.digits is None
            else family.digits(full, self.quantities, self.digits)
        )
        return {name: found[name] if name in found else given[name] for name in self.names}

    def _given(self, rows: NDArray[np.int64]) -> Columns:
        """Return the parameters of some rows."""
        places = [rows * (array.size > 1) for array in self.parameters.values()]
        if not self.listed:
            places = list(np.unravel_index(rows, [array.size for array in self.parameters.values()]))
        return {name: array[i] for (name, array), i in zip(self.parameters.items(), places, strict=True)}


@dataclass(frozen=True)
class Span:
    """Rows of a plan, `start` to `stop`; the first has the number `first` in the whole table."""

    start: int
    stop: int
    first: int
