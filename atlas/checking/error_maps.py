"""Maps of the largest error in R over (omega2, t) and (I, t), of formula (84) as printed and of `ElementaryMotion`."""

import math
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from atlas.errors import DomainError
from atlas.pictures.layers import FloatArray
from atlas.sweeps.plan import Range, Tabulation

Field: TypeAlias = tuple[float, float]
CLOCK = (1e-3, 1e12)
"""First and last time, in units of 1/|B'|."""

QUANTITIES = ("error", "plain_error")


@dataclass(frozen=True, eq=False)
class ErrorMap:
    """Largest errors in any entry of R in the middles of the cells between the edges ``x`` and ``t``.

    ``plain`` and ``ours`` are arrays (len(t)-1, len(x)-1), of which `table` is the table; NaN where the phase is
    beyond 2^50, for which nothing is promised.
    """

    x: FloatArray
    t: FloatArray
    plain: FloatArray
    ours: FloatArray
    table: Tabulation


def over_omega2(ratio: float, field: Field, cells: tuple[int, int] = (80, 54)) -> ErrorMap:
    """Return the `ErrorMap` over omega2/|B2| from -3 to 1, which contains the pole -B2 and -2 B2 for B2 > 0, and t.

    Raises DomainError for B2 = 0. `cells` are the numbers of cells along x and t.
    """
    edges = np.linspace(-3.0, 1.0, cells[0] + 1)
    return _mapped(edges, ratio, field, Range.middles(edges * abs(field[0])), cells[1])


def over_ratio(field: Field, omega2: float, cells: tuple[int, int] = (80, 54)) -> ErrorMap:
    """Return the `ErrorMap` over I from 1e-3 to 2, evenly in log I, and over t. Raises DomainError for B2 = 0."""
    edges = np.geomspace(1e-3, 2.0, cells[0] + 1)
    return _mapped(edges, Range.middles(edges, log=True), field, omega2, cells[1])


def _mapped(x: FloatArray, ratio: float | Range, field: Field, omega2: float | Range, rows: int) -> ErrorMap:
    """Return the `ErrorMap` over time and the one parameter, `ratio` or `omega2`, that is a `Range`.

    x (n + 1,) are the edges of the cells of that parameter, `rows` is the number of cells in time. Raises DomainError
    for B2 = 0.
    """
    if field[0] == 0:
        raise DomainError("A map of errors needs B2 different from zero: (71) and (72) divide by it.")
    b = math.hypot(*field)
    t = np.geomspace(*CLOCK, rows + 1)
    settings = {"ratio": ratio, "B2": field[0], "B3": field[1], "omega2": omega2, "t": Range.middles(t / b, log=True)}
    table = Tabulation("elementary", settings, QUANTITIES)
    columns = table.columns()
    return ErrorMap(x, t, columns["plain_error"].T, columns["error"].T, table)
