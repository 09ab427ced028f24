"""Headings of a table: the columns of a trajectory, their units, and questions on misspelt names."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from atlas.errors import AtlasError
from atlas.measured import WANTED, heading, size

MATRIX = tuple(f"R{i}{j}" for i in "123" for j in "123")
OMEGA = ("Omega1", "Omega2", "Omega3")
QUATERNION = ("q0", "q1", "q2", "q3")
FIELD = ("K1", "K2", "K3")
"""Components of the field along the axes of the body, which only `atlas fit` reads."""
OPTIONS = {"t": "times", "sigma": "sigma"} | dict.fromkeys(OMEGA, "omega") | dict.fromkeys(FIELD, "field")
"""Name of the option whose units a column may have, by column."""
PLAIN = ("", "1", "time", "1/time")
"""Units in a heading that change no number."""

PREFIXES = ("q", "quat", "quaternion", "orientation", "")
SPELLINGS = ("q0 q1 q2 q3", *(" ".join(f"{prefix}{x}" for x in "wxyz") for prefix in PREFIXES))
"""Names of the four components of a quaternion, each scalar first."""
STARTS = {"ratio", "I1", "I2", "B2", "B3"}
"""Parameters in a sweep's table, whose omega1 to omega3 are those of the start."""
GYROSCOPES = ("gyroscope", "gyro", "gyr", "angularvelocity")
"""Beginnings of the names of a gyroscope's columns, followed by x, y or z."""
_NAMES = {name.lower(): name for name in (*MATRIX, *OMEGA)} | {"t": "t", "time": "t", "timestamp": "t"}
_NAMES |= {f"{gyro}{axis}": name for gyro in GYROSCOPES for axis, name in zip("xyz", OMEGA, strict=True)}

QUESTIONS = {
    r"(omega|w|rate)[xyz123]|[pqr](deg|rad).*|(omega|gyr|angvel|angularvel).*": "a rate along the axes of the body is "
    "called Omega1, Omega2, Omega3, with its unit, as Omega1 [deg/s]",
    r".*(quat|attitude|orient).*|.*q[0-4wxyz]|e[0-4]": "of a quaternion qw is the scalar, beside qx, qy, qz",
    r"r\w?\d+|rot.*|dcm.*|m\d\d": "matrices that take the body to the laboratory are R11 to R33, row and column",
    r"(roll|pitch|yaw|phi|theta|psi|euler).*": "of Euler angles SciPy makes x, y, z, w = Rotation.from_euler(...)"
    ".as_quat()",
    "[xyz]": "of a gyroscope x, y, z are called gyro_x, gyro_y, gyro_z, and a quaternion has a scalar w beside them",
    r"t([mnuµ]?s(ec)?|\d*|sim)|.*(time|sec|elapsed|clock|millis|micros|zeit|temps|tempo).*": ""
    "the time is called t, with its unit, as t [ms]",
}
"""Patterns of misspelt names of columns, with the sentence on each."""


@dataclass(frozen=True)
class Heading:
    """Columns of a table by canonical name: indices, names in the file, and factors to s and rad/s.

    `places` has the indices of the columns from 0, `labels` the names in the file, `sizes` the factors (1 without
    a unit), `units` the units as written, "" without one. `left_out` is a sentence on columns that are not used, ""
    without any.
    """

    places: Mapping[str, int]
    labels: Mapping[str, str]
    sizes: Mapping[str, Fraction]
    units: Mapping[str, str]
    left_out: str
    """A sentence on columns that are not used, empty without any."""


def headed(cells: Sequence[str], source: str, extra_names: Sequence[str] = ()) -> Heading:
    """Return the `Heading` of the cells of a line of names; `extra_names` are further known names, such as "sigma".

    Unknown columns are left out. Raises AtlasError, which names `source`, for a line of numbers, a column given
    twice, an unknown unit, no column of times, and no other known column.
    """
    titles = [heading(cell) for cell in cells]
    if all(re.fullmatch(r"[+-]?\.?\d.*", name) for name, _ in titles if name):
        first_cell = cells[0].strip()
        raise AtlasError(
            f"{source}: the first line must name the columns, such as t,R11,R12,R13, but begins with {first_cell!r}."
        )
    columns = _canonical([name for name, _ in titles], extra_names)
    places: dict[str, int] = {}
    for i, name in columns.items():
        if name in places:
            raise AtlasError(f"{source}: the column {name} is there twice: remove one.")
        places[name] = i
    unknown = [name for i, (name, _) in enumerate(titles) if name and i not in columns]
    hints = "; ".join(dict.fromkeys(filter(None, map(_hint, unknown))))
    ask = f" ({hints})" if hints else ""
    if "t" not in places:
        remedy = "; begin lines above the names of columns with #" * (not columns)
        raise AtlasError(f"{source}: there is no column t; name the times t{ask}{remedy}.")
    if not places.keys() - {"t", "sigma"}:
        remark = f" There is {', '.join(map(repr, unknown))}{ask}." if unknown else ""
        raise AtlasError(
            f"{source}: there are no data beside t; add columns R11 to R33 (the axis is R13, R23, R33), Omega1 to "
            f"Omega3, {'K1 to K3, ' if extra_names else ''}or the quaternion qw, qx, qy, qz.{remark}"
        )
    titles_used = {name: titles[i][0] for name, i in places.items()}
    units = {name: titles[i][1] for name, i in places.items()}
    if titles_used["t"].lower() == "timestamp" and not units["t"]:
        raise AtlasError(f"{source}: timestamp has no unit; call it t [s], t [ms], t [us] or t [ns].")
    sizes = {name: _size(name, unit, source) for name, unit in units.items()}
    left_out = f"columns left out: {', '.join(unknown)}{ask}" if unknown else ""
    return Heading(places, titles_used, sizes, units, left_out)


def _canonical(names: Sequence[str], extra_names: Sequence[str]) -> dict[int, str]:
    """Return the canonical names, such as "R11" or "q0", of the known columns by index; unknown ones are left out.

    `names` are the columns' names in the file, `extra_names` further known ones. omega1 to omega3 in a sweep's
    table are parameters, not columns.
    """
    bare = [re.sub(r"[\s_.]+", "", name).lower() for name in names]
    by_spelling = _NAMES | {name.lower(): name for name in extra_names}
    spelling = next((s.split() for s in SPELLINGS if set(s.split()) <= set(bare)), ())
    by_spelling |= dict(zip(spelling, QUATERNION, strict=False))
    start = {name for name in ("omega1", "omega2", "omega3") if STARTS & {*names}}  # of a sweep, beside Omega
    return {i: by_spelling[name] for i, name in enumerate(bare) if name in by_spelling and names[i] not in start}


def _hint(name: str) -> str:
    """Return the sentence on a misspelt name of a column, such as "omegax"; "" for other names."""
    bare = re.sub(r"[\s_.]+", "", name).lower()
    if re.fullmatch(r"[wmbk][123]|omega[123]|theta|phi|psi", name, re.IGNORECASE):
        return ""  # of the atlas's own tables: rates and momenta in the laboratory, the field in the body, angles
    return next((text for pattern, text in QUESTIONS.items() if re.fullmatch(pattern, bare)), "")


def _size(name: str, unit: str, place: str) -> Fraction:
    """Return the factor from the unit in a column's heading to s or rad/s, exactly; 1 where no unit is given.

    Raises AtlasError, which begins with `place`, for an unknown unit.
    """
    if unit in PLAIN:
        return Fraction(1)
    option = OPTIONS.get(name, "")
    try:
        return Fraction(size(unit, option))
    except AtlasError as error:
        remedy = f"is in {WANTED[option]}, or a unit that converts to it" if option else "has no unit"
        raise AtlasError(f"{place}: {name} {remedy}, not in {unit!r}.") from error
