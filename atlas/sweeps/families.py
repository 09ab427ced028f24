"""Columns of a table over parameters of a family, by kernels and by balls."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from atlas.arithmetic.lazy import cached_property
from atlas.errors import AtlasError, DomainError, unknown
from atlas.families.family import TIME
from atlas.motions import register as families
from atlas.motions.register import Family, Quantity

Row = Mapping[str, Any]
NAME = "U28"
"""NumPy type of text in a table: no name of a case or kind is longer."""

MISSING = "missing"
"""Name of the column with the reason why a quantity of a row has no value."""


@dataclass(frozen=True)
class Column:
    """A quantity of a table: how its values are computed, and how they are printed.

    `value` maps a motion (or array of motions) and the row's parameters by name to the value; it takes `exact`, which
    says whether the motion is one in balls, not in doubles. `unit` is text, "" for a pure number. `certified` says
    whether there are certified digits. `missing` is the reason why the quantity may have no value in a row, whose
    cell is then NaN or an empty text; "" for a quantity that always has one.
    """

    value: Callable[..., Any]
    unit: str = ""
    certified: bool = False
    missing: str = ""


@dataclass(frozen=True)
class Swept:
    """A family of motions as a table: its parameters and quantities as columns by name.

    `family` is the family's entry in the register.
    """

    family: Family

    @cached_property
    def needed(self) -> tuple[str, ...]:
        """Names of the columns of parameters that every row must have, a vector by its components ("B2", "B3")."""
        return tuple(name for p in self.family.parameters if p.needed for name in p.names)

    @cached_property
    def optional(self) -> Mapping[str, float | None]:
        """Default values by name of the parameters that may be left out, None where there is no default.

        The time t = 0 is among them, if the family has functions of time.
        """
        defaults = {name: p.omitted for p in self.family.parameters if not p.needed for name in p.names}
        return defaults | ({"t": 0.0} if self.family.sampled else {})

    @cached_property
    def units(self) -> Mapping[str, str]:
        """Units by name of all columns, parameters, quantities and the time t; "" for a pure number."""
        units = {name: p.unit for p in self.family.parameters for name in p.names} | {"t": TIME}
        return units | {name: column.unit for name, column in self.quantities.items()}

    @cached_property
    def quantities(self) -> Mapping[str, Column]:
        """`Column` by name of every quantity and of every component of a function of time ("R11", "Omega1", ...)."""
        columns = {name: column for q in self.family.quantities for name, column in _columns(q)}
        for s in self.family.sampled:
            columns |= {name: Column(partial(_at_time, get), s.unit) for name, get in s.columns.items()}
        return columns

    def make(self, row: Row, *, exact: bool = False) -> Any:
        """Return the family's motion with the parameters in `row`, by name; N motions in one object for arrays (N,).

        With `exact` the class in balls is used, else the class in doubles. A DomainError of the class is passed on.
        """
        values = []
        for p in self.family.parameters:
            components: tuple[Any, ...] = tuple(row.get(name) for name in p.names)
            if p.last:
                components = (np.stack(np.broadcast_arrays(*(np.asarray(x, dtype=float) for x in components)), -1),)
            values.append(components if p.columns and not p.last else components[0])
        return (self.family.balls if exact else self.family.kernels)()(*values)

    def columns(
        self, parameters: Mapping[str, NDArray[Any]], names: Sequence[str], exact: dict[str, Fraction]
    ) -> dict[str, NDArray[Any]]:
        """Return the quantities `names` as arrays (N,) of floats or text by name, for parameters (N,) by name.

        If a quantity may have no value, a column "missing" has the reasons. `exact` holds parameters, the same in
        all rows, as fractions, which replace those in `parameters`.
        """
        size, at_once = next(iter(parameters.values())).size, self.family.at_once
        pieces: dict[str, list[NDArray[Any]]] = {name: [] for name in names}
        for start in range(0, size, at_once):
            rows = {name: x[start : start + at_once] for name, x in parameters.items()}
            motions, count = self.make(rows | exact), min(at_once, size - start)
            for name, column in pieces.items():
                values = np.broadcast_to(self.quantities[name].value(motions, rows), count)
                column.append(values.astype(NAME if values.dtype.kind == "U" else np.float64))
        return self._explained({name: np.concatenate(column) for name, column in pieces.items()})

    def digits(
        self, parameters: Mapping[str, NDArray[Any]], names: Sequence[str], digits: int, exact: dict[str, Fraction]
    ) -> dict[str, Any]:
        """Return the quantities `names` as arrays (N,) of text with `digits` certified digits, evaluated row by row.

        `parameters` are arrays (N,) by name; `exact` replaces some of them by fractions. A column "missing" has the
        reasons as in `columns`.
        """
        from atlas.arithmetic.certified_digits import certified

        texts: dict[str, list[str]] = {name: [] for name in names}
        for values in zip(*(x.tolist() for x in parameters.values()), strict=True):
            row = dict(zip(parameters, values, strict=True)) | exact
            for name, text in certified(partial(self._balls, row, names), digits).items():
                texts[name].append(text)
        return self._explained({name: np.array(column, dtype=f"U{digits + 16}") for name, column in texts.items()})

    def _balls(self, row: Row, names: Sequence[str]) -> dict[str, Any]:
        motion = self.make(row, exact=True)
        return {name: self._ball(self.quantities[name], motion, row) for name in names}

    @staticmethod
    def _ball(column: Column, motion: Any, row: Row) -> Any:
        """Return a quantity of a motion in balls: a ball, an exact number or text; "inf" if infinite.

        "" on a DomainError that the column's `missing` explains; another DomainError is passed on.
        """
        from flint import arb

        try:
            value = column.value(motion, row, exact=True)
        except DomainError:
            if not column.missing:
                raise
            return ""
        return "inf" if isinstance(value, arb) and value == arb("inf") else value

    def _explained(self, columns: dict[str, NDArray[Any]]) -> dict[str, NDArray[Any]]:
        """Return the columns (N,) by name; if a quantity may have no value, also "missing": reasons joined by ", ".

        The dict `columns` itself is extended; "missing" is "" in rows where no value is missing.
        """
        reasons_by_name = {name: self.quantities[name].missing for name in columns if self.quantities[name].missing}
        if reasons_by_name:
            reasons = np.zeros(next(iter(columns.values())).shape, dtype=NAME)
            for reason in dict.fromkeys(column.missing for column in self.quantities.values() if column.missing):
                gone = np.zeros(reasons.shape, dtype=bool)
                for name, why in reasons_by_name.items():
                    gone |= (why == reason) & empty(columns[name])
                reasons[gone] = [f"{text}, {reason}" if text else reason for text in reasons[gone].tolist()]
            columns[MISSING] = reasons
        return columns

    def check(self, parameters: Sequence[str], names: Sequence[str], digits: int | None) -> None:
        """Raise AtlasError for an unknown name in `parameters` or quantities `names`, a missing parameter, no quantity.

        With `digits` the quantities must have certified digits; None asks for none.
        """
        names_known = (*self.needed, *self.optional)
        certified = [name for name, column in self.quantities.items() if column.certified]
        lists = (
            ("parameter", [x for x in parameters if x not in names_known], names_known),
            ("quantity", [x for x in names if x not in self.quantities], self.quantities),
            ("quantity with certified digits", [x for x in names if digits and x not in certified], certified),
        )
        for subject, refused, known_names in lists:
            if refused:
                raise unknown(subject, refused[0], known_names, "here")
        missing_names = [name for name in self.needed if name not in parameters]
        if missing_names:
            raise AtlasError(f"The parameter {missing_names[0]} is missing: give {', '.join(self.needed)}.")
        if not names:
            raise AtlasError(f"Name at least one quantity: {', '.join(self.quantities)}.")


def empty(column: NDArray[Any]) -> NDArray[np.bool]:
    """Return a mask (N,) of the rows in which a column (N,) has no value: NaN, or an empty text in a column of text."""
    return np.asarray(column == "" if column.dtype.kind == "U" else np.isnan(column))


def _columns(q: Quantity) -> Iterator[tuple[str, Column]]:
    """Yield (name, `Column`) for a quantity of the register, or for each of its components if it is a vector."""
    for i, name in enumerate(q.names):
        yield name, Column(partial(_value, q, i if q.columns else None), q.unit, q.certified, q.missing)


def _value(q: Quantity, place: int | None, motion: Any, _: Row, *, exact: bool = False) -> Any:
    value = q.value(motion, exact=exact)
    if place is None:
        return value
    return value[place] if isinstance(value, tuple | list) else value[..., place]


def _at_time(get: Callable[[Any, Any], Any], motion: Any, row: Row, *, exact: bool = False) -> Any:
    del exact  # the methods of both have one name
    return get(motion, row["t"])


FAMILIES: Mapping[str, Swept] = {name: Swept(family) for name, family in families.FAMILIES.items()}
