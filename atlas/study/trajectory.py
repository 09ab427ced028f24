"""A user's trajectory from a CSV file: columns by name, parameters from lines that begin with #.

Columns, in any order and case: ``t``; any of ``R11`` to ``R33``; any of ``Omega1`` to ``Omega3`` (in the body's frame);
a quaternion that takes the body's frame to the laboratory, scalar first, as ``q0 q1 q2 q3``, ``w x y z`` or
``qw qx qy qz``. Lines such as ``# ratio = 1.5`` and ``# field = 1 2`` hold parameters; other # lines are comments.
The numbers are separated by commas, or by semicolons, tabs or spaces where the line of names has no comma.
"""

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from atlas.errors import AtlasError

PARAMETERS: Mapping[str, int] = {"ratio": 1, "inertia": 2, "field": 2, "omega2": 1, "omega3": 1}
"""Parameters of an elementary motion, with the count of their numbers."""

MATRIX = tuple(f"R{i}{j}" for i in "123" for j in "123")
OMEGA = ("Omega1", "Omega2", "Omega3")
QUATERNION = ("q0", "q1", "q2", "q3")
_OTHER_NAMES = dict(zip(("w", "x", "y", "z", "qw", "qx", "qy", "qz"), QUATERNION * 2, strict=True)) | {"time": "t"}
_NAMES = {name.lower(): name for name in ("t", *MATRIX, *OMEGA, *QUATERNION)} | _OTHER_NAMES


@dataclass(frozen=True)
class Trajectory:
    """What a file holds: columns of equal length by canonical name, and the parameters of its # lines."""

    columns: Mapping[str, Sequence[float]]
    parameters: Mapping[str, tuple[float, ...]]

    @property
    def times(self) -> Sequence[float]:
        """The column t."""
        return self.columns["t"]


def read(path: Path) -> Trajectory:
    """Read a file.

    Raises AtlasError, which names the line and the column, for what is not such a trajectory.
    """
    try:
        text = path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        raise AtlasError(f"{path.name} is not a text file in UTF-8.") from error
    parameters: dict[str, tuple[float, ...]] = {}
    names: list[str] = []
    columns: dict[str, list[float]] = {}
    separator: str | None = None
    for number, raw in enumerate(text.splitlines(), 1):
        line = raw.strip()
        where = f"{path.name}, line {number}"
        if not line:
            continue
        if line.startswith("#"):
            parameters |= _parameters(line.lstrip("# "), where)
        elif not names:
            separator = next((s for s in (",", ";", "\t") if s in line), None)
            names = _header(line.split(separator), where)
            columns = {name: [] for name in names}
        else:
            cells = line.split(separator)
            if len(cells) != len(names):
                raise AtlasError(f"{where}: {len(cells)} cells where the line of names has {len(names)}.")
            for name, cell in zip(names, cells, strict=True):
                columns[name].append(_number(cell, f"{where}, column {name}"))
    if not names:
        raise AtlasError(f"{path.name} is empty; it needs a line of names such as t,R11,R12,R13 and rows of numbers.")
    if not columns["t"]:
        raise AtlasError(f"{path.name} has names but no rows of numbers.")
    return Trajectory(columns, parameters)


def _parameters(line: str, where: str) -> dict[str, tuple[float, ...]]:
    """Return the parameters of a # line, none where it is a comment."""
    found = {}
    for part in line.split(";"):
        name, equals, text = part.replace(":", "=", 1).partition("=")
        name = name.strip().lower()
        if not equals or name not in PARAMETERS:
            continue
        values = tuple(_number(word, f"{where}, parameter {name}") for word in re.split(r"[,\s]+", text.strip(" ()[]")))
        if len(values) != PARAMETERS[name]:
            raise AtlasError(f"{where}: {name} takes {PARAMETERS[name]} numbers, not {len(values)}.")
        found[name] = values
    return found


def _header(cells: Sequence[str], where: str) -> list[str]:
    """Return the canonical names of the columns."""
    names = []
    for cell in cells:
        plain = cell.strip().strip("\"'")
        name = _NAMES.get(plain.lower().replace("_", ""))
        if name is None:
            raise AtlasError(
                f"{where}: no column is called {plain!r}; "
                "there are t, R11 to R33, Omega1 to Omega3, q0 to q3 (or w, x, y, z)."
            )
        if name in names:
            raise AtlasError(f"{where}: the column {name} is there twice.")
        names.append(name)
    if "t" not in names:
        raise AtlasError(f"{where}: there is no column t.")
    if len(names) == 1:
        raise AtlasError(f"{where}: there is nothing to grade beside t; add R11 to R33, Omega1 to Omega3 or q0 to q3.")
    if 0 < len(set(QUATERNION) & set(names)) < 4:
        raise AtlasError(f"{where}: a quaternion has the four columns q0 to q3 (or w, x, y, z).")
    return names


def _number(cell: str, where: str) -> float:
    try:
        value = float(cell)
    except ValueError as error:
        raise AtlasError(f"{where}: {cell.strip()!r} is not a number.") from error
    if not math.isfinite(value):
        raise AtlasError(f"{where}: the cell is {cell.strip()}; every cell must be a finite number.")
    return value
