"""Even steps of a parameter, and a table over them: as numbers and as the command that makes it."""

import shlex
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from atlas.core.inputs import FloatArray
from atlas.study.sweep.plan import Columns, Plan


@dataclass(frozen=True)
class Range:
    """So many numbers from `start` to `stop`, both among them, at even steps or, with `log`, at those of the logarithm.

    `str` writes START:STOP:COUNT or START:STOP:COUNT:log, as `atlas sweep` takes it.
    """

    start: float
    stop: float
    count: int
    log: bool = False

    @classmethod
    def middles(cls, edges: FloatArray, *, log: bool = False) -> "Range":
        """Return the middles of the cells between edges at even steps; the first and the last to seven digits."""
        even = np.log(edges) if log else edges
        start, stop = (float(f"{np.exp(x) if log else x:.7g}") for x in (even[1:] + even[:-1])[[0, -1]] / 2)
        return cls(start, stop, len(edges) - 1, log)

    @property
    def values(self) -> FloatArray:
        """The numbers, (count,)."""
        return (np.geomspace if self.log else np.linspace)(self.start, self.stop, self.count)

    def __str__(self) -> str:
        return f"{_text(self.start)}:{_text(self.stop)}:{self.count}" + ":log" * self.log


@dataclass(frozen=True)
class Tabulation:
    """Quantities of a family over all combinations of settings, the last one varying fastest."""

    family: str
    settings: Mapping[str, float | tuple[float, ...] | Range]
    quantities: tuple[str, ...]

    def columns(self) -> Columns:
        """Return the columns of the table, each with an axis for every setting that has several values."""
        given = {name: x.values if isinstance(x, Range) else x for name, x in self.settings.items()}
        plan = Plan.of(self.family, given, self.quantities)
        sizes = [x.size for x in plan.parameters.values() if x.size > 1]
        return {name: column.reshape(sizes) for name, column in plan.columns().items()}

    def command(self, out: str) -> str:
        """Return the command that writes the table into a file."""
        words = ["atlas", "sweep", self.family]
        for name, x in self.settings.items():
            words += ["--set", f"{name}={','.join(map(_text, x)) if isinstance(x, tuple) else _text(x)}"]
        return shlex.join([*words, *(word for name in self.quantities for word in ("--quantity", name)), "--out", out])


def _text(x: float | Range) -> str:
    """Return a number with the shortest digits that read back the same, or a range."""
    return str(x) if isinstance(x, Range) else repr(float(x)).removesuffix(".0")
