"""A user's trajectory from a file: columns by name, parameters from lines that begin with #.

NPZ and Parquet files have arrays by the names of columns, with the lines above as the comment of the archive, or as
the entry `head` of the metadata, where the atlas wrote them.

Columns, in any order and case: ``t``; any of ``R11`` to ``R33``; any of ``Omega1`` to ``Omega3`` (in the body's frame),
or a gyroscope's x, y, z; a quaternion that takes the body's frame to the laboratory, as ``w x y z``, ``qw qx qy qz``
or, scalar first, ``q0 q1 q2 q3``; other columns are left out. Names may have units, as ``t [ms]`` or ``Omega1 (Hz)``;
times are then in s, rates in rad/s. Lines such as ``# ratio = 1.5`` and ``# field: 1 2`` above the rows hold
parameters; other # lines are comments, and so is text behind a colon that does not begin with a number. How the cells
are written, says `atlas.text_tables`; an empty one is NaN. Rows are read in blocks, so that a file may be larger than
the memory.
"""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import chain, islice
from operator import itemgetter
from pathlib import Path
from typing import Any

import msgspec
import numpy as np

from atlas.arithmetic.inputs import FloatArray, real
from atlas.checking.binary_tables import READERS, head_and_columns
from atlas.checking.headings import FIELD, MATRIX, OMEGA, QUATERNION, Heading, headed
from atlas.errors import AtlasError, DomainError
from atlas.text_tables import number_of, opened_table, split_cells

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

NAMED = re.compile(
    r"# *(t|time)( *[\[(][^])]*[\])])?([\s,;]+(R_?\d\d|(Omega_?|K|q)\d|q?[w-z])( *[\[(][^])]*[\])])?)+", re.IGNORECASE
)
"""The names of columns in a comment, as NumPy's savetxt writes them."""

POLICIES = ("omit", "raise")
"""Policies for rows that lack a number."""


@dataclass(frozen=True)
class Trajectory:
    """A trajectory: its file, the names of its columns, its parameters, and an iterator over blocks of rows.

    The keys of `names` are canonical ("R11", "q0"), its values the names in the file. `parameters` are tuples of
    numbers by name. Each block has an array (m,) for each column, NaN where a number is missing; the blocks can be
    read once. `left_out` is a sentence on columns that are not used, `units` holds those of the headings by
    canonical name, None for arrays.
    """

    file: str
    names: Mapping[str, str]
    parameters: Mapping[str, tuple[float, ...]]
    blocks: Iterator[dict[str, FloatArray]]
    left_out: str = ""
    units: Mapping[str, str] | None = None


@contextmanager
def opened(path: Path, *, fields: bool = False) -> Iterator[Trajectory]:
    """Yield the `Trajectory` of a file, open while the context lasts.

    With `fields` K1 to K3 and sigma are columns too. Raises AtlasError, which names the line and the column, for a
    file that is no trajectory. Reading the blocks raises the same error for a mistake in the rows.
    """
    parameters: dict[str, tuple[float, ...]] = {}
    extra_names = (*FIELD, "sigma") if fields else ()
    if path.suffix in READERS:
        (*head, names), columns = head_and_columns(path)
        for line in head:
            parameters |= _parameters(line.lstrip("# "), path.name)
        title = headed(split_cells(names, ",", path.name, len(head) + 1), path.name, extra_names)
        yield Trajectory(
            path.name, title.labels, parameters, _sliced(columns, title, path.name), title.left_out, title.units
        )
        return

    def remark(number: int, text: str, above: bool) -> None:
        """Read the parameters of the remark `text` in line `number`; `above` says whether it is above the names.

        Raises AtlasError for a parameter below the names, and for one given twice with other numbers.
        """
        place = f"{path.name}, line {number}"
        for name, values in _parameters(text, place).items():
            if not above:
                raise AtlasError(f"{place}: a parameter stands below the line of names: move it above that line.")
            if parameters.setdefault(name, values) != values:
                raise AtlasError(f"{place}: {name} is there twice, with other numbers.")

    with opened_table(path, remark, NAMED) as table:
        title = headed(table.names, f"{path.name}, line {table.number}", extra_names)
        blocks = _blocks(table.rows, title, path.name)
        yield Trajectory(path.name, title.labels, parameters, blocks, title.left_out, title.units)


def with_plurals(function: str, columns: Mapping[str, Any], plural: Mapping[str, Any]) -> dict[str, Any]:
    """Return the arrays of `columns` by singular name, filled in from `plural`, such as {"rotations": R}.

    Raises
    ------
    TypeError
        For a plural name of none of the columns, in the words of Python on a call of `function`.
    AtlasError
        For data that are given in both numbers.
    """
    singular = {"axes" if name == "axis" else f"{name}s".replace("ys", "ies"): name for name in columns}
    for name in plural:
        if name not in singular:
            raise TypeError(f"{function}() got an unexpected keyword argument {name!r}")
        if columns[singular[name]] is not None:
            raise AtlasError(f"{singular[name]} and {name} are the same data: give one of them.")
    return dict(columns) | {singular[name]: values for name, values in plural.items()}


def of_arrays(t: Any, quantities: Mapping[str, Any], *, scalar_first: bool, nan_policy: str = "omit") -> Trajectory:
    """Return the `Trajectory` of times t (N,) and arrays by name in `quantities`, None for one that is left out.

    The arrays are rotation (N, 3, 3), quaternion (N, 4), its scalar first or last, and angular_velocity (N, 3).
    Raises AtlasError for another shape, for no array, and for an entry that is no number; with the policy "raise"
    also for NaN.
    """
    times = measured(t, "t", nan_policy)
    if times.ndim != 1 or not times.size:
        raise AtlasError(f"The times must be an array (N,) of at least one number, not of shape {times.shape}.")
    shapes = {"rotation": (3, 3), "quaternion": (4,), "angular_velocity": (3,)}
    order = QUATERNION if scalar_first else (*QUATERNION[1:], QUATERNION[0])
    columns = {"t": times}
    for (quantity, shape), names in zip(shapes.items(), (MATRIX, order, OMEGA), strict=True):
        if quantities[quantity] is None:
            continue
        values, required_shape = measured(quantities[quantity], quantity, nan_policy), (*times.shape, *shape)
        if values.shape != required_shape:
            raise AtlasError(f"The {quantity} at {times.size} times is an array {required_shape}, not {values.shape}.")
        columns |= dict(zip(names, values.reshape(times.size, -1).T, strict=True))
    if len(columns) == 1:
        raise AtlasError(f"There is nothing to grade: give {', '.join(shapes)}, at least one of them.")
    starts = range(0, times.size, BLOCK)
    blocks = ({name: x[start : start + BLOCK] for name, x in columns.items()} for start in starts)
    names_of_columns = dict(zip(QUATERNION, "wxyz", strict=True))
    return Trajectory("the trajectory", {name: names_of_columns.get(name, name) for name in columns}, {}, blocks)


def measured(value: Any, name: str, nan_policy: str) -> FloatArray:
    """Return numbers as an array of floats of the same shape; NaN is allowed unless `nan_policy` is "raise".

    Raises AtlasError for an unknown policy, infinities, and values that are no numbers; `name` names the value.
    """
    if nan_policy not in POLICIES:
        raise AtlasError(f"nan_policy is {' or '.join(map(repr, POLICIES))}, not {nan_policy!r}.")
    try:
        return real(value, name)
    except DomainError:
        array = np.array(value, dtype=np.float64)
        if nan_policy == "raise" or np.isinf(array).any():
            raise
        return array


def whole_rows(block: Mapping[str, FloatArray]) -> tuple[dict[str, FloatArray], int]:
    """Return (block of the rows without missing numbers, count of the rows left out).

    A block has columns (m,) by name.
    """
    is_whole = np.all([np.isfinite(x) for x in block.values()], axis=0)
    return {name: x[is_whole] for name, x in block.items()}, int(is_whole.size - is_whole.sum())


def holes_left_out(count: int, rows: int, file: str) -> str:
    """Return a sentence on the `count` rows left out for lack of a number, "" for none.

    `rows` is the number of the other rows. Raises AtlasError for `rows` = 0.
    """
    if not rows:
        raise AtlasError(f"{file} has no row with all its numbers: {count} lack one.")
    return f"{count} row{'s' * (count != 1)} left out, which lack{'s' * (count == 1)} a number" if count else ""


def _blocks(rows: Iterator[tuple[int, list[str]]], title: Heading, file: str) -> Iterator[dict[str, FloatArray]]:
    """Yield blocks of at most BLOCK rows, arrays (m,) by column, from pairs (line number, cells).

    Times are in s and rates in rad/s where the heading `title` has units. Raises AtlasError, which names `file`,
    without rows, and for a text that is no number.
    """
    block = [*islice(rows, BLOCK)]
    if not block:
        raise AtlasError(f"{file} has a line of names, but no rows of numbers: add them.")
    while block:
        yield _in_units(title, _numbers(block, title, file).T)
        block = [*islice(rows, BLOCK)]


def _sliced(columns: Mapping[str, FloatArray], title: Heading, file: str) -> Iterator[dict[str, FloatArray]]:
    """Yield blocks of at most BLOCK rows, arrays (m,) by canonical name, of columns (N,) by the names in the file.

    Times are in s and rates in rad/s where the heading `title` has units. Raises AtlasError, which names `file`,
    for a column without numbers.
    """
    names = [*columns]
    used = {name: columns[names[i]] for name, i in title.places.items()}
    for name, x in used.items():
        if x.dtype.kind not in "iuf":
            raise AtlasError(f"{file}: the column {title.labels[name]} does not hold numbers.")
    for start in range(0, len(used["t"]), BLOCK):
        yield _in_units(title, [x[start : start + BLOCK] for x in used.values()])


def _in_units(title: Heading, columns: Iterable[FloatArray]) -> dict[str, FloatArray]:
    """Return columns (m,) by canonical name, times converted to s and rates to rad/s where the heading has a unit.

    `columns` stand in the order of `title.places`.
    """
    sizes = ((name, title.sizes[name]) for name in title.places)
    return {
        name: x * float(size.numerator) / float(size.denominator)
        for (name, size), x in zip(sizes, columns, strict=True)
    }


def _numbers(rows: Sequence[tuple[int, list[str]]], title: Heading, file: str) -> FloatArray:
    """Return the numbers in the known columns, shape (rows, columns), from pairs (line number, cells).

    Cells are decoded as JSON if possible, else one by one; empty cells are NaN. Raises AtlasError, which names
    `file`, for a cell with another text.
    """
    places = title.places.items()
    used = itemgetter(*title.places.values())  # t and another, so of tuples
    text = ",".join(chain.from_iterable([used(cells) for _, cells in rows]))
    try:
        numbers = np.array(_DECODER.decode(f"[{text}]"))
        if numbers.size == len(rows) * len(places):  # not for cells with a comma
            return numbers.reshape(-1, len(places))
    except msgspec.DecodeError:
        pass  # 1., +1 and .5 are numbers but no JSON; and a text that is no number is refused below
    return np.array(
        [
            [number_of(cells[i], f"{file}, line {number}, column {title.labels[name]}") for name, i in places]
            for number, cells in rows
        ]
    )


_DECODER = msgspec.json.Decoder(list[float])


def _parameters(line: str, place: str) -> dict[str, tuple[float, ...]]:
    """Return the parameters in the text of a # line, tuples of floats by name; {} for a comment.

    Items such as "ratio = 1.5" or "field: 1 2" are separated by semicolons; other items are left out. Raises
    AtlasError, which begins with `place`, for a wrong count of numbers and for a text in their place.
    """
    parameters: dict[str, tuple[float, ...]] = {}
    for item in line.split(";"):
        key = re.match(r"\s*(\w+)\s*([=:])\s*", item)
        if key is None or (name := key[1].lower()) not in PARAMETERS:
            continue
        words = re.split(r"[,\s]+", item[key.end() :].strip(" ()[]"))
        if key[2] == ":" and not re.match(r"[+-]?\.?\d", words[0]):
            continue  # "# field: along e3" is a comment
        values = tuple(number_of(word, f"{place}, parameter {name}") for word in words)
        if len(values) not in PARAMETERS[name]:
            counts = " or ".join(map(str, PARAMETERS[name]))
            raise AtlasError(f"{place}: {name} takes {counts} numbers, not {len(values)}.")
        parameters[name] = values
    return parameters
