"""A user's trajectory from a CSV file: columns by name, parameters from lines that begin with #.

Columns, in any order and case: ``t``; any of ``R11`` to ``R33``; any of ``Omega1`` to ``Omega3`` (in the body's frame);
a quaternion that takes the body's frame to the laboratory, scalar first, as ``q0 q1 q2 q3``, ``w x y z`` or ``qw qx qy
qz``. Names may have units, as ``t [ms]`` or ``Omega1 [Hz]``; times are then in s, rates in rad/s. Lines such as ``#
ratio = 1.5`` and ``# field: 1 2`` above the rows hold parameters; other # lines are comments, and so is what follows a
colon and does not begin with a number. The numbers are separated by commas, or by semicolons, tabs or spaces where the
line of names has no comma. Rows are read in blocks, so that a file may be larger than the memory.
"""

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from fractions import Fraction
from itertools import islice
from pathlib import Path
from typing import Any, TextIO

import msgspec
import numpy as np

from atlas.arithmetic.inputs import FloatArray, real
from atlas.errors import AtlasError
from atlas.files import lines_of
from atlas.measured import WANTED, heading, size

BLOCK = 8192
"""Lines read at once."""

PARAMETERS: Mapping[str, tuple[int, ...]] = {
    "ratio": (1,),
    "inertia": (2, 3, 6),
    "field": (2, 3),
    "omega2": (1,),
    "omega3": (1,),
    "omega": (3,),
    "attitude": (4,),
    "direction": (2,),
    "coupling": (2,),
    "linear": (1,),
    "quadratic": (1,),
    "step": (1,),
    "sigma": (1,),
}
"""Parameters with the counts of numbers they may have: moments I2, I3, or I1, I2, I3, or J11 J22 J33 J12 J13 J23."""

MATRIX = tuple(f"R{i}{j}" for i in "123" for j in "123")
OMEGA = ("Omega1", "Omega2", "Omega3")
QUATERNION = ("q0", "q1", "q2", "q3")
FIELD = ("K1", "K2", "K3")
"""The field along the axes of the body, which `atlas fit` reads beside."""
OPTIONS = {"t": "times"} | dict.fromkeys(OMEGA, "omega") | dict.fromkeys(FIELD, "field")
"""Options that have the units of columns, by name."""
PLAIN = ("", "1", "time", "1/time")
"""Units that are taken as they are."""
EULER = ("roll", "pitch", "yaw", "phi", "theta", "psi")
"""How names of Euler angles begin."""
_OTHER_NAMES = dict(zip(("w", "x", "y", "z", "qw", "qx", "qy", "qz"), QUATERNION * 2, strict=True)) | {"time": "t"}
NAMED = re.compile(r"# *(t|time)( *\[[^]]*\])?([\s,;]+(R_?\d\d|(Omega_?|K|q)\d|q?[w-z])( *\[[^]]*\])?)+", re.IGNORECASE)
"""The names of columns in a comment, as NumPy's savetxt writes them."""
_NAMES = {name.lower(): name for name in ("t", *MATRIX, *OMEGA, *QUATERNION)} | _OTHER_NAMES


@dataclass(frozen=True)
class Trajectory:
    """A trajectory: where it is from, its columns as they were called, its parameters, and the rows, block by block.

    The keys of `names` are canonical. Each block has a column (m,) for each; together they can be gone through once.
    """

    file: str
    names: Mapping[str, str]
    parameters: Mapping[str, tuple[float, ...]]
    blocks: Iterator[dict[str, FloatArray]]


@contextmanager
def opened(path: Path, *, fields: bool = False) -> Iterator[Trajectory]:
    """Open a file and read what stands above its rows; with `fields` the columns K1 to K3 are known, too.

    Raises AtlasError, which names the line and the column, for what is not such a trajectory; the blocks do as well.
    """
    parameters: dict[str, tuple[float, ...]] = {}
    with path.open(encoding="utf-8-sig") as file:
        lines = _decoded(file, path.name)
        for number, raw in enumerate(lines, 1):
            line, where = raw.strip(), f"{path.name}, line {number}"
            line = line.lstrip("# ") if NAMED.fullmatch(line) else line
            if line.startswith("#"):
                for name, values in _parameters(line.lstrip("# "), where).items():
                    if parameters.setdefault(name, values) != values:
                        raise AtlasError(f"{where}: {name} is there twice, with other numbers.")
            elif line:
                separator = next((s for s in (",", ";", "\t") if s in line), None)
                cells = line.split(separator) if separator else re.sub(r"\s+\[", "[", line).split()
                titles = [heading(cell.strip(" \"'")) for cell in cells]
                names = _header([name for name, _ in titles], where, FIELD if fields else ())
                written = dict(zip(names, (name for name, _ in titles), strict=True))
                sizes = {name: _size(name, unit, where) for name, (_, unit) in zip(names, titles, strict=True)}
                blocks = _blocks(lines, number, written, sizes, separator, path.name)
                yield Trajectory(path.name, written, parameters, blocks)
                return
    raise AtlasError(f"{path.name} is empty; it needs a line of names such as t,R11,R12,R13 and rows of numbers.")


def of_arrays(t: Any, quantities: Mapping[str, Any], *, scalar_first: bool) -> Trajectory:
    """Return the trajectory of times (N,) and arrays, None where one is left out.

    They are rotation (N, 3, 3), quaternion (N, 4) and angular_velocity (N, 3). Raises AtlasError for another shape,
    and for what is no number.
    """
    times = real(t, "t")
    if times.ndim != 1 or not times.size:
        raise AtlasError(f"The times are one array (N,) of one number or more, not {times.shape}.")
    shapes = {"rotation": (3, 3), "quaternion": (4,), "angular_velocity": (3,)}
    order = QUATERNION if scalar_first else (*QUATERNION[1:], QUATERNION[0])
    columns = {"t": times}
    for (what, shape), names in zip(shapes.items(), (MATRIX, order, OMEGA), strict=True):
        if quantities[what] is None:
            continue
        values, wanted = real(quantities[what], what), (*times.shape, *shape)
        if values.shape != wanted:
            raise AtlasError(f"The {what} at {times.size} times is an array {wanted}, not {values.shape}.")
        columns |= dict(zip(names, values.reshape(times.size, -1).T, strict=True))
    if len(columns) == 1:
        raise AtlasError(f"There is nothing to grade: give {', '.join(shapes)}, at least one of them.")
    starts = range(0, times.size, BLOCK)
    blocks = ({name: x[start : start + BLOCK] for name, x in columns.items()} for start in starts)
    written = dict(zip(QUATERNION, "wxyz", strict=True))
    return Trajectory("the trajectory", {name: written.get(name, name) for name in columns}, {}, blocks)


def _decoded(file: TextIO, name: str) -> Iterator[str]:
    """Yield the lines of a text file."""
    try:
        yield from lines_of(file, name)
    except UnicodeDecodeError as error:
        raise AtlasError(f"{name} is not a text file in UTF-8.") from error


def _blocks(
    lines: Iterator[str],
    above: int,
    names: Mapping[str, str],
    sizes: Mapping[str, Fraction],
    separator: str | None,
    file: str,
) -> Iterator[dict[str, FloatArray]]:
    """Yield the rows below the line of names, the number `above`; messages have the names as they are written."""
    first, empty = above + 1, True
    while block := list(islice(lines, BLOCK)):
        numbered = [(i, line) for i, line in enumerate(block, first) if line.strip()]
        for i, line in numbered:
            if line.lstrip().startswith("#") and _parameters(line.strip().lstrip("# "), f"{file}, line {i}"):
                raise AtlasError(f"{file}, line {i}: a parameter stands above the line of names, not below it.")
        rows = [(i, line) for i, line in numbered if not line.lstrip().startswith("#")]
        if rows:
            empty = False
            columns = _rows(rows, [*names.values()], separator, file).T
            sized = zip(names, columns, strict=True)
            yield {name: x * float(sizes[name].numerator) / float(sizes[name].denominator) for name, x in sized}
        first += len(block)
    if empty:
        raise AtlasError(f"{file} has names but no rows of numbers.")


def _rows(rows: Sequence[tuple[int, str]], names: Sequence[str], separator: str | None, file: str) -> FloatArray:
    """Return the numbers of some lines, shape (rows, columns): as JSON, where they are; else each cell by itself."""
    lines = [",".join(line.split(separator)) if separator != "," else line for _, line in rows]
    if all(line.count(",") == len(names) - 1 for line in lines):
        try:
            return np.array(_DECODER.decode(f"[{','.join(lines)}]")).reshape(-1, len(names))
        except msgspec.DecodeError:
            pass  # 1., +1 and .5 are numbers but no JSON; and what is no number is told below
    return np.array([_cells(line, names, separator, f"{file}, line {i}") for i, line in rows])


_DECODER = msgspec.json.Decoder(list[float])


def _cells(line: str, names: Sequence[str], separator: str | None, where: str) -> list[float]:
    """Return the numbers of one line."""
    cells = line.strip().split(separator)
    if len(cells) != len(names):
        raise AtlasError(f"{where}: {len(cells)} cells where the line of names has {len(names)}.")
    return [_number(cell, f"{where}, column {name}") for name, cell in zip(names, cells, strict=True)]


def _parameters(line: str, where: str) -> dict[str, tuple[float, ...]]:
    """Return the parameters of a # line, none where it is a comment."""
    parameters: dict[str, tuple[float, ...]] = {}
    for item in line.split(";"):
        key = re.match(r"\s*(\w+)\s*([=:])\s*", item)
        if key is None or (name := key[1].lower()) not in PARAMETERS:
            continue
        words = re.split(r"[,\s]+", item[key.end() :].strip(" ()[]"))
        if key[2] == ":" and not re.match(r"[+-]?\.?\d", words[0]):
            continue  # "# field: along e3" is a comment
        values = tuple(_number(word, f"{where}, parameter {name}") for word in words)
        if len(values) not in PARAMETERS[name]:
            counts = " or ".join(map(str, PARAMETERS[name]))
            raise AtlasError(f"{where}: {name} takes {counts} numbers, not {len(values)}.")
        parameters[name] = values
    return parameters


def _header(cells: Sequence[str], where: str, more: Sequence[str]) -> list[str]:
    """Return the canonical names of the columns."""
    names = []
    for cell in cells:
        bare = cell.lower().replace("_", "")
        name = _NAMES.get(bare, bare.upper() if bare.upper() in more else None)
        if name is None and re.fullmatch(r"[+-]?\.?\d.*", cell):
            raise AtlasError(f"{where}: {cell!r} stands where the names of columns are wanted, such as t,R11,R12,R13.")
        if name is None:
            raise AtlasError(
                f"{where}: no column is called {cell!r}; "
                f"there are t, R11 to R33 (the axis is R13, R23, R33), Omega1 to Omega3, "
                f"{'K1 to K3, ' if more else ''}q0 to q3 (or w, x, y, z)."
                + " Of Euler angles SciPy makes these: x, y, z, w = Rotation.from_euler(...).as_quat()."
                * bare.startswith(EULER)
            )
        if name in names:
            raise AtlasError(f"{where}: the column {name} is there twice.")
        names.append(name)
    if "t" not in names:
        raise AtlasError(f"{where}: there is no column t.")
    if len(names) == 1:
        raise AtlasError(f"{where}: there is nothing to grade beside t; add R11 to R33, Omega1 to Omega3 or q0 to q3.")
    if 0 < len(set(QUATERNION) & set(names)) < 4:
        raise AtlasError(f"{where}: a quaternion has the four columns q0 to q3 (or w, x, y, z), an axis R13, R23, R33.")
    return names


def _size(name: str, unit: str, where: str) -> Fraction:
    """Return how many of the unit of a column, s or rad/s, that of its heading is, 1 where it has none."""
    if unit in PLAIN:
        return Fraction(1)
    option = OPTIONS.get(name, "")
    try:
        return Fraction(size(unit, option))
    except AtlasError as error:
        right = f"is in {WANTED[option]}, or what can be made of it" if option else "has no unit"
        raise AtlasError(f"{where}: {name} {right}, not in {unit!r}.") from error


def _number(cell: str, where: str) -> float:
    plain = cell.isascii() and "_" not in cell  # Python reads underscores and the digits of other scripts
    try:
        value = float(cell if plain else "")
    except ValueError as error:
        text = cell.strip()
        right = "; a decimal has a point" * bool(re.fullmatch(r"[+-]?\d+,\d+", text))
        right = right or "; leave out a row that lacks one" * (not text)
        raise AtlasError(f"{where}: {text!r} is not a number{right}.") from error
    if not math.isfinite(value):
        raise AtlasError(f"{where}: the cell is {cell.strip()}; every cell must be a finite number.")
    return value
