"""A sweep as data: the family, its parameters by name, the quantities; and the rows of its table."""

import shlex
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from math import hypot, isfinite, nan, prod
from typing import Any

import numpy as np
from numpy.typing import NDArray

from atlas.arithmetic.inputs import FloatArray, real
from atlas.arithmetic.uncertainty import concise, in_independent_inputs, is_uncertain, spread
from atlas.errors import AtlasError, unknown
from atlas.families.family import TIME
from atlas.sweeps.families import FAMILIES, MISSING

Columns = dict[str, NDArray[Any]]

CONVENTIONS = (
    "R takes the body to the laboratory, and so does the quaternion, whose scalar is qw",
    "Omega, K and b are along the axes of the body, w and m along those of the laboratory, as these were given",
)
"""Conventions of the columns of a motion, as sentences."""

LAUNCH = ("B1", "B2", "B3", "omega1", "omega2", "omega3")
"""Components of the field and of the angular velocity at t = 0."""

MAX_ROWS = 10**11
"""Largest number of rows of a table, some 10 TB."""


@dataclass(frozen=True)
class Plan:
    """Rows of parameters of a family, and the quantities that each row is to have.

    `family` is a name in FAMILIES; `parameters` are arrays (n,) by name. The rows are all their combinations, the
    last name varying fastest; if `listed`, the rows are the elements of the arrays, and an array of one value holds
    for all rows. `quantities` are names of columns. With `digits` they are text with this number of certified
    digits. `time` is the unit of time in headings. `first_row` is the index of the first row in the whole table.
    `exact` has, as pairs (numerator, denominator), parameters of one value that no float holds: quantities are
    computed from these. `axes` describes the principal axes in those of the user, where these differ: columns that
    depend on the axes then end in "_principal". `slopes` are the changes of uncertain parameters over one standard
    deviation of each independent input; the quantities `deviating` have columns in "_sigma".
    """

    family: str
    parameters: Mapping[str, NDArray[np.float64]]
    quantities: tuple[str, ...]
    listed: bool = False
    digits: int | None = None
    time: str = TIME
    first_row: int = 0
    exact: Mapping[str, tuple[int, int]] = field(default_factory=dict)
    axes: str = ""
    slopes: Mapping[str, tuple[float, ...]] = field(default_factory=dict)
    deviating: tuple[str, ...] = ()

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
        axes: str = "",
    ) -> "Plan":
        """Return the plan of checked input; a parameter is a number, a sequence (n,), or a number with an uncertainty.

        A quantity may also name a function of time, which stands for all its components. Raises AtlasError for
        unknown or missing names, values that are no numbers, lists of different lengths, digits below 1, and too
        many rows.
        """
        if family not in FAMILIES:
            raise unknown("family", family, FAMILIES, "to sweep")
        quantities = [quantities] if isinstance(quantities, str) else quantities
        columns_of = {sampled.name: sampled.columns for sampled in FAMILIES[family].family.sampled}
        quantities = [column for name in quantities for column in columns_of.get(name, (name,))]
        FAMILIES[family].check(list(parameters), quantities, digits)
        parameters, slopes = _nominal(parameters, digits)
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
            raise AtlasError(f"The number of digits must be at least 1, not {digits}.")
        exact = {
            name: x.as_integer_ratio() for name, x in parameters.items() if isinstance(x, Fraction) and float(x) != x
        }
        plan = cls(family, arrays, tuple(dict.fromkeys(quantities)), listed, digits, time, exact=exact, axes=axes)
        if not 0 < plan.count <= MAX_ROWS:
            raise AtlasError(f"A table has from one row to {MAX_ROWS:.0e}, not {plan.count}.")
        return plan._with_deviations(slopes) if slopes else plan

    def _with_deviations(self, slopes: Mapping[str, tuple[float, ...]]) -> "Plan":
        """Return a copy with the `slopes` of uncertain inputs; each quantity of floats gets a column in "_sigma".

        `slopes` maps a parameter to its changes over one standard deviation of each independent input.
        """
        columns, is_asked = self.rows(0, 1), [name in self.quantities for name in self._names]
        requested = (name for name, is_requested in zip(self.names, is_asked, strict=True) if is_requested)
        return replace(self, slopes=slopes, deviating=tuple(x for x in requested if columns[x].dtype.kind == "f"))

    @property
    def count(self) -> int:
        """Number of rows of the table: the longest list if `listed`, else the product of the lengths."""
        sizes = [array.size for array in self.parameters.values()]
        return max(sizes) if self.listed else prod(sizes)

    @property
    def names(self) -> list[str]:
        """Names of the table's columns: parameters, quantities, "missing" if needed, then those in "_sigma".

        Columns that depend on the axes end in "_principal" if `axes` is set.
        """
        vectors = {*LAUNCH, *self._sampled} if self.axes else set()
        return [f"{name}_principal" if name in vectors else name for name in self._names] + [
            f"{name}_sigma" for name in self.deviating
        ]

    @property
    def conventions(self) -> list[str]:
        """Sentences on the columns of the table; an empty list where none applies.

        They are on frames if R and other functions of time are sampled, on `_principal` columns for turned axes, and on
        `_sigma` columns for uncertain inputs.
        """
        sentence = f"Columns in _principal are along the principal axes of the body, {self.axes} in those given"
        has_samples = "R11" in self._sampled and not self._sampled.isdisjoint(self._names)
        inputs = (f"{name} = {concise(float(self.parameters[name][0]), hypot(*x))}" for name, x in self.slopes.items())
        deviations = f"Columns in _sigma are standard deviations of first order, or sampled, for {', '.join(inputs)}"
        return [*CONVENTIONS * has_samples, *[sentence] * bool(self.axes), *[deviations] * bool(self.slopes)]

    @property
    def _sampled(self) -> set[str]:
        """Names of the columns of functions of time that the family has, such as "R11", without suffixes."""
        return {name for sampled in FAMILIES[self.family].family.sampled for name in sampled.columns}

    @property
    def _names(self) -> list[str]:
        """Names of parameters and quantities without suffixes, and "missing" if a quantity may have no value."""
        # an input that is also asked for, as omega3, stands once
        names = [*(name for name in self.parameters if name not in self.quantities), *self.quantities]
        return names + [MISSING] * any(FAMILIES[self.family].quantities[name].missing for name in self.quantities)

    @property
    def headings(self) -> list[str]:
        """Names of the columns as a CSV file has them: with their unit, `k [1/time]`, where there is one."""
        units = {name: unit.replace(TIME, self.time) for name, unit in FAMILIES[self.family].units.items()}
        own_names = [*self._names, *(name.removesuffix("_principal") for name in self.deviating)]
        columns = zip(self.names, map(units.get, own_names), strict=True)
        return [f"{name} [{unit}]" if unit else name for name, unit in columns]

    @property
    def latest(self) -> dict[str, float]:
        """Values by name of all parameters in the first row with the largest |t|.

        {} where no time is given or no function of time is asked for.
        """
        t = self.parameters.get("t")
        if t is None or self._sampled.isdisjoint(self.quantities):
            return {}
        place, values = int(np.argmax(abs(t))), self.parameters.items()
        return {name: float(x[place if name == "t" or (self.listed and x.size > 1) else 0]) for name, x in values}

    def list_of(self, start: int, stop: int) -> "Plan":
        """Return the plan of the rows start to stop - 1, listed row by row: small enough to be sent to a worker."""
        parameters = self._parameters(np.arange(start, stop))
        arrays = {
            name: self.parameters[name] if self.parameters[name].size == 1 else x for name, x in parameters.items()
        }
        return replace(self, parameters=arrays, listed=True, first_row=self.first_row + start)

    def rows(self, start: int = 0, stop: int | None = None) -> Columns:
        """Return the columns by name, arrays (stop - start,), of rows start to stop - 1, by default of all rows.

        Raises AtlasError, or its subclass, which names the first failing row and its inputs.
        """
        stop = self.count if stop is None else stop
        try:
            return self._columns(start, stop)
        except AtlasError as error:
            row = self._failing(start, stop)
            values = ", ".join(f"{name} = {value.item()}" for name, value in self._parameters(np.array([row])).items())
            reason = self._refusal(row, row + 1) or error
            raise type(error)(f"In row {self.first_row + row + 1} of the table, {values}: {reason}") from error

    def _failing(self, low: int, high: int) -> int:
        """Return the index of the first failing row in the half-open range low to high, in which some row fails."""
        while high - low > 1:
            middle = (low + high) // 2
            low, high = (low, middle) if self._refusal(low, middle) else (middle, high)
        return low

    def _refusal(self, low: int, high: int) -> AtlasError | None:
        """Return the AtlasError that evaluating the half-open range of rows low to high raises, or None."""
        try:
            self._columns(low, high)
        except AtlasError as error:
            return error
        return None

    def _columns(self, start: int, stop: int) -> Columns:
        """Return the columns (stop - start,) by name of rows start to stop - 1; errors do not name the row."""
        parameters = self._parameters(np.arange(start, stop))
        exact = {name: Fraction(*pair) for name, pair in self.exact.items()}
        quantities = self._quantities(parameters, exact)
        columns = [quantities[name] if name in quantities else parameters[name] for name in self._names]
        if self.deviating:
            columns += [*np.array([*map(self._deviations, range(start, stop))]).T]
        return dict(zip(self.names, columns, strict=True))

    def _quantities(self, parameters: Columns, exact: dict[str, Fraction]) -> Columns:
        """Return the quantities, and "missing", as arrays (N,) by name, for parameters (N,) by name.

        Parameters that were left out have their defaults. `exact` holds parameters as fractions that replace those
        of one value.
        """
        family, count = FAMILIES[self.family], next(iter(parameters.values())).size
        defaults = {name: value for name, value in family.optional.items() if value is not None}
        inputs: Columns = {name: np.full(count, value) for name, value in defaults.items()} | parameters
        if self.digits is None:
            return family.columns(inputs, self.quantities, exact)
        return family.digits(inputs, self.quantities, self.digits, exact)

    def _deviations(self, row: int) -> list[float]:
        """Return the standard deviations of the quantities `deviating` in a row (an index); NaN for an infinite one."""
        parameters, own_names = (
            self._parameters(np.array([row])),
            [x.removesuffix("_principal") for x in self.deviating],
        )

        def shifted(steps: Sequence[float]) -> Columns:
            changes = {name: np.dot(slopes, steps) for name, slopes in self.slopes.items()}
            columns = self._quantities({name: x + changes.get(name, 0.0) for name, x in parameters.items()}, {})
            return {name: columns[name] for name in own_names}

        count = len(next(iter(self.slopes.values())))
        sigma = spread(shifted([0.0] * count), shifted, count).sigma
        return [x if isfinite(x := sigma.get((name, 0), nan)) else nan for name in own_names]

    def _parameters(self, rows: NDArray[np.int64]) -> Columns:
        """Return the parameters by name, arrays (N,), at the row indices (N,)."""
        places = [rows * (array.size > 1) for array in self.parameters.values()]
        if not self.listed:
            places = list(np.unravel_index(rows, [array.size for array in self.parameters.values()]))
        return {name: array[i] for (name, array), i in zip(self.parameters.items(), places, strict=True)}


def _nominal(parameters: Mapping[str, Any], digits: int | None) -> tuple[dict[str, Any], dict[str, tuple[float, ...]]]:
    """Return the nominal values of parameters by name, and the `slopes` of a `Plan`, {} without uncertain parameters.

    Raises AtlasError for an uncertain parameter with several values, and for uncertainties where `digits` is not None.
    """
    nominal, slopes = in_independent_inputs(parameters)
    for name, value in nominal.items():
        if is_uncertain(value):
            raise AtlasError(
                f"{name} has an uncertainty and several values: a parameter with an uncertainty takes one value."
            )
    if slopes and digits:
        raise AtlasError(f"{next(iter(slopes))} has an uncertainty, which has no certified digits: leave out digits.")
    return nominal, slopes


@dataclass(frozen=True)
class Range:
    """`count` numbers from `start` to `stop`, both included, in even steps; with `log` in even steps of the logarithm.

    ``str(range)`` is "START:STOP:COUNT" or "START:STOP:COUNT:log", as `atlas sweep` takes it.
    """

    start: float
    stop: float
    count: int
    log: bool = False

    @classmethod
    def middles(cls, edges: FloatArray) -> "Range":
        """Return the middles of the cells between evenly spaced edges (N,), as a range of N - 1 numbers.

        Its ends are rounded to 7 digits.
        """
        start, stop = (float(f"{x:.7g}") for x in (edges[1:] + edges[:-1])[[0, -1]] / 2)
        return cls(start, stop, len(edges) - 1)

    @property
    def values(self) -> FloatArray:
        """The numbers from `start` to `stop`, shape (count,), descending if `stop` is less."""
        return (np.geomspace if self.log else np.linspace)(self.start, self.stop, self.count)

    def __str__(self) -> str:
        return f"{_text(self.start)}:{_text(self.stop)}:{self.count}" + ":log" * self.log


@dataclass(frozen=True)
class Tabulation:
    """A table of a family over all combinations of settings, the last setting varying fastest.

    `family` is a name in FAMILIES, `settings` are numbers, lists or ranges by name of parameter, `quantities` are
    names of columns.
    """

    family: str
    settings: Mapping[str, float | tuple[float, ...] | Range]
    quantities: tuple[str, ...]

    def columns(self) -> Columns:
        """Return parameters and quantities by name, each an array with one axis for every setting of several values.

        The axes stand in the order of the settings. Errors are those of `Plan.of` and `Plan.rows`.
        """
        parameters = {name: x.values if isinstance(x, Range) else x for name, x in self.settings.items()}
        plan = Plan.of(self.family, parameters, self.quantities)
        sizes = [x.size for x in plan.parameters.values() if x.size > 1]
        return {name: column.reshape(sizes) for name, column in plan.rows().items()}

    def command(self, out: str) -> str:
        """Return the `atlas sweep` command, quoted for a shell, that writes this table into the file `out`."""
        words = ["atlas", "sweep", self.family]
        for name, x in self.settings.items():
            words += ["--set", f"{name}={','.join(map(_text, x)) if isinstance(x, tuple) else _text(x)}"]
        return shlex.join([*words, *(word for name in self.quantities for word in ("--quantity", name)), "--out", out])


def _text(x: float | Range) -> str:
    """Return a number with the shortest digits that read back the same, or a range."""
    return str(x) if isinstance(x, Range) else repr(float(x)).removesuffix(".0")
