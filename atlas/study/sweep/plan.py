"""A sweep as data: the family, its parameters by name, the quantities; and any part of its table."""

import hashlib
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import prod
from typing import Any

import numpy as np
from numpy.typing import NDArray

from atlas.core.inputs import real
from atlas.errors import AtlasError
from atlas.study.sweep.families import FAMILIES, MISSING

Columns = dict[str, NDArray[Any]]


@dataclass(frozen=True)
class Plan:
    """Rows of parameters of a family, and the quantities that each is to have.

    `parameters` are arrays by name: all their combinations, the last name varying fastest, or, if `listed`, row by row.
    With `digits` the quantities are text with so many certified digits. A part of the table has `rows` rows.
    """

    family: str
    parameters: Mapping[str, NDArray[np.float64]]
    quantities: tuple[str, ...]
    listed: bool = False
    digits: int | None = None
    rows: int = 50_000

    @classmethod
    def of(
        cls,
        family: str,
        parameters: Mapping[str, Any],
        quantities: Sequence[str],
        *,
        listed: bool = False,
        digits: int | None = None,
        rows: int = 50_000,
    ) -> "Plan":
        """Check what a user gave. Raises AtlasError for what is unknown, missing, not a number or not of one length."""
        if family not in FAMILIES:
            raise AtlasError(f"There is no family {family!r} to sweep; there is {', '.join(FAMILIES)}.")
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
            arrays = {name: np.broadcast_to(array, count) for name, array in arrays.items()}
        if rows < 1 or (digits is not None and digits < 1):
            raise AtlasError(f"A part has at least one row, and a number one digit, not {rows} and {digits}.")
        return cls(family, arrays, tuple(dict.fromkeys(quantities)), listed, digits, rows)

    @property
    def count(self) -> int:
        """How many rows the table has."""
        sizes = [array.size for array in self.parameters.values()]
        return max(sizes) if self.listed else prod(sizes)

    @property
    def parts(self) -> int:
        """How many parts the table has."""
        return -(-self.count // self.rows)

    @property
    def key(self) -> str:
        """Digest of all that the table depends on, the version of the package included."""
        from atlas import __version__

        told = [__version__, self.family, self.quantities, self.listed, self.digits, self.rows, list(self.parameters)]
        digest = hashlib.sha256(json.dumps(told).encode())
        for array in self.parameters.values():
            digest.update(np.ascontiguousarray(array).tobytes())
            digest.update(b"|")
        return digest.hexdigest()

    @property
    def names(self) -> list[str]:
        """Names of the columns: parameters, quantities, and why one of these has no value, if one may have none."""
        # an input that is also asked for, as omega3, stands once
        names = [*(name for name in self.parameters if name not in self.quantities), *self.quantities]
        return names + [MISSING] * any(FAMILIES[self.family].quantities[name].missing for name in self.quantities)

    @property
    def headings(self) -> list[str]:
        """The same as a CSV file has them: with their unit, `k [1/time]`, where there is one."""
        units = FAMILIES[self.family].units
        return [f"{name} [{units[name]}]" if units.get(name) else name for name in self.names]

    def part(self, index: int) -> "Plan":
        """Return the plan of one part: a list of its rows."""
        rows = np.arange(index * self.rows, min((index + 1) * self.rows, self.count))
        places = [rows] * len(self.parameters)
        if not self.listed:
            places = list(np.unravel_index(rows, [array.size for array in self.parameters.values()]))
        given = {name: array[i] for (name, array), i in zip(self.parameters.items(), places, strict=True)}
        return Plan(self.family, given, self.quantities, True, self.digits, self.rows)

    def whole(self) -> "Plan":
        """Return the plan of the table in one part."""
        return replace(self, rows=self.count).part(0)

    def columns(self) -> Columns:
        """Return the table."""
        family = FAMILIES[self.family]
        defaults = {name: value for name, value in family.optional.items() if value is not None}
        rows: Columns = {name: np.full(self.count, value) for name, value in defaults.items()} | dict(self.parameters)
        found = (
            family.columns(rows, self.quantities)
            if self.digits is None
            else family.digits(rows, self.quantities, self.digits)
        )
        return {name: found[name] if name in found else self.parameters[name] for name in self.names}
