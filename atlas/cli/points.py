"""Columns of numbers of a CSV file with a heading; point masses and charges of one as the body of a command."""

import warnings
from collections.abc import Mapping
from fractions import Fraction
from itertools import islice
from pathlib import Path
from typing import Any, NamedTuple

import click

from atlas.errors import AtlasError, NearlySymmetricWarning
from atlas.measured import WANTED, heading, size
from atlas.text_tables import opened_table

MAX_ROWS = 10**7
"""Rows of a table that are read."""

SYMMETRIC = 1e-9
"""By how much moments about the axis may differ, and how large products may be, in parts of the largest moment."""
OF_POINTS = {"x": "position", "y": "position", "z": "position", "mass": "mass", "charge": "charge"}
"""Options that have the units of point masses, by the names of the columns."""


class Masses(NamedTuple):
    """Point masses (N,), positions (N, 3) from the centre of mass, mass matrix (3, 3), charges (N,) or None.

    The mass matrix is sum m x x^T, x from the centre of mass; `exact` is the mass matrix as nested lists of rational
    numbers. Positions are along the file's axes x, y, z. Units are kg, m and C where the file has units, else those of
    the file.
    """

    masses: Any
    places: Any
    matrix: Any
    charges: Any
    exact: Any

    @property
    def inertia(self) -> Any:
        """Inertia tensor (3, 3) about the centre of mass, in units of mass times length squared."""
        from atlas.bodies.inertia import inertia_from_mass_matrix

        return inertia_from_mass_matrix(self.matrix)


def point_masses(path: Path) -> Masses:
    """Return the `Masses` of a CSV file with the columns x, y, z, mass and optionally charge.

    Raises click.UsageError for a missing or any other column, and for a cell that is no number.
    """
    import numpy as np

    from atlas.arithmetic.numbers import nearest
    from atlas.bodies.inertia import exact_mass_matrix

    columns, _ = measured_columns(path, OF_POINTS, {})
    if not {"x", "y", "z", "mass"} <= set(columns) <= {"x", "y", "z", "mass", "charge"}:
        raise click.UsageError(f"{path} must have the columns x, y, z, mass and may have charge; it has "
                               f"{', '.join(columns)}.")  # fmt: skip
    m = np.array(columns["mass"])
    x = np.transpose([columns[name] for name in "xyz"])
    exact = exact_mass_matrix(m, x)
    matrix = np.array([[nearest(value) for value in row] for row in exact])
    charges = np.array(columns["charge"]) if "charge" in columns else None
    return Masses(m, x - m @ x / m.sum(), matrix, charges, exact)


def points(path: Path) -> Any:
    """Return the `SymmetricBody` of a file of point masses, with the symmetry axis z.

    A deviation from symmetry of up to 1e-9 of the largest moment is allowed, with a warning. Raises click.UsageError if
    the masses are not symmetric about z, or if their charges are not in proportion to their masses.
    """
    import numpy as np

    from atlas.arithmetic.given import exact_number
    from atlas.bodies.body import SymmetricBody

    read = point_masses(path)
    g, inertia = read.matrix, read.inertia
    largest = np.abs(inertia).max()
    equal, upright = (abs(x) <= SYMMETRIC * largest for x in (g[0, 0] - g[1, 1], np.abs(np.triu(g, 1)).max()))
    if not (equal and upright):
        lacks = "I1 = I2" * (not equal) + " and " * (not equal and not upright) + "no products" * (not upright)
        raise click.UsageError(
            f"{path}: the points are not symmetric about the axis z: {lacks} would be needed, to {SYMMETRIC:g} of the "
            f"largest, but about their centre of mass I1 = {inertia[0, 0]:.10g}, I2 = {inertia[1, 1]:.10g}, "
            f"I3 = {inertia[2, 2]:.10g}, I12 = {inertia[0, 1]:.3g}, I13 = {inertia[0, 2]:.3g}, "
            f"I23 = {inertia[1, 2]:.3g}. Another body has --field B1 B2 B3."
        )
    if read.charges is not None:
        _one_ratio(path, read.masses, read.charges)
    if g[0, 0] != g[1, 1] or np.triu(g, 1).any():
        off = max(abs(g[0, 0] - g[1, 1]), np.abs(np.triu(g, 1)).max()) / largest
        joined = f"{path}: a body symmetric about z is taken, off by {off:.1g} of the largest moment."
        warnings.warn(joined, NearlySymmetricWarning, stacklevel=2)
    (a, *_), (_, b, _), (*_, c) = read.exact
    return SymmetricBody(exact_number((a + b) / 2 + c), exact_number(a + b))


def oblique_tensor(path: Path) -> Any:
    """Return the inertia tensor (3, 3) of a file of point masses about their centre of mass, along x, y, z.

    None where x, y, z are principal axes: all products are zero.
    """
    import numpy as np

    inertia = point_masses(path).inertia
    return inertia if np.triu(inertia, 1).any() else None


def exact_inertia(path: Path) -> list[Any]:
    """Return the inertia tensor of a file of points about their centre: six rationals I11 I22 I33 I12 I13 I23."""
    (a, d, e), (_, b, f), (*_, c) = point_masses(path).exact
    return [b + c, a + c, a + b, -d, -e, -f]


def principal_moments(path: Path) -> tuple[float | Fraction, ...]:
    """Return the moments (I1, I2, I3) about x, y, z of a file of point masses, about their centre of mass.

    They are floats, or fractions where no float is equal. Raises click.UsageError unless x, y, z are principal axes.
    """
    import numpy as np

    from atlas.arithmetic.given import as_float_or_fraction

    read = point_masses(path)
    inertia = read.inertia
    if np.triu(inertia, 1).any():
        moments, axes = np.linalg.eigh(inertia)
        axes *= np.linalg.det(axes)  # right-handed
        words = ", ".join(f"({', '.join(f'{x:z.10g}' for x in axis)})" for axis in axes.T)
        raise click.UsageError(
            f"{path}: x, y, z are not principal axes, for I12 = {inertia[0, 1]:.3g}, I13 = {inertia[0, 2]:.3g}, I23 = "
            f"{inertia[1, 2]:.3g}; those are along {words}, with the moments "
            f"{', '.join(f'{x:.10g}' for x in moments)}: give the points in them, and the field and omega too."
        )
    (a, *_), (_, b, _), (*_, c) = read.exact
    return tuple(map(as_float_or_fraction, (b + c, a + c, a + b)))


def ratio_of_points(path: Path) -> Fraction:
    """Return the charge-to-mass ratio of a file of points, exactly, as a Fraction.

    Raises click.UsageError without charges, or with several ratios.
    """
    read = point_masses(path)
    if read.charges is None:
        raise click.UsageError(f"--magnetic needs the charges of the points: {path} has no column charge.")
    return _one_ratio(path, read.masses, read.charges)


def _one_ratio(path: Path, masses: Any, charges: Any) -> Fraction:
    """Return the sum of the charges over that of the masses, exactly.

    Raises click.UsageError where the ratios of the points differ by more than 1e-9 of the largest.
    """
    ratios = charges / masses
    if ratios.max() - ratios.min() > SYMMETRIC * abs(ratios).max():
        raise click.UsageError(
            f"{path}: charge/mass must be the same for all points, but goes from {ratios.min():.6g} to "
            f"{ratios.max():.6g}; other charges are those of atlas.TopMotion.charged."
        )
    charge, mass = (sum(map(Fraction, x.tolist())) for x in (charges, masses))
    return Fraction(charge) / mass


def cells_of(path: Path) -> tuple[dict[str, str], list[tuple[int, list[str]]]]:
    """Return (units of a text table's columns by name, rows as pairs of the number of the line and the cells as texts).

    Raises click.UsageError for a file that cannot be read, names that are not different, and no row; AtlasError for
    another fault of the file.
    """
    try:
        with opened_table(path) as table:
            lines = [*islice(table.rows, MAX_ROWS + 1)]
    except OSError as error:
        raise click.UsageError(f"{path} cannot be read: {error.strerror}.") from error
    if len(lines) > MAX_ROWS:
        raise click.UsageError(f"{path} has more than {MAX_ROWS} rows: split it.")
    units = dict(map(heading, table.names))
    if not lines or len(units) != len(table.names):
        raise click.UsageError(f"{path} must have a heading of different names, as ratio,radius [um], and at least one "
                               "row.")  # fmt: skip
    return units, lines


def measured_columns(
    path: Path, options: Mapping[str, str], plain: Mapping[str, tuple[str, ...]]
) -> tuple[dict[str, list[float]], set[str]]:
    """Return the columns of a CSV file as lists of floats by name, and the set of the units in its heading.

    The heading is its first line after those with #. `options` gives the option that has the units of a name. A
    number with a unit is converted to that of its option, but for the units in `plain`, by name, which are taken as
    they are; names that are not in `options` keep their numbers. Raises click.UsageError, with the line.
    """
    units, lines = cells_of(path)
    units_and_options = [
        (name, unit, None if unit in ("", "1", *plain.get(name, ())) else options.get(name))
        for name, unit in units.items()
    ]
    columns: dict[str, list[float]] = {name: [] for name in units}
    for number, line in lines:
        for (name, unit, option), cell in zip(units_and_options, line, strict=True):
            try:
                x = float(cell)
                columns[name].append(float(Fraction(x) * size(unit, option)) if option else x)
            except (ValueError, OverflowError, AtlasError) as error:
                unit_text = (
                    f" in {WANTED[option]}, or a unit that converts to it" if option in WANTED else " without a unit"
                )
                under = f"{name} [{unit}] is not a number{unit_text}" if option else f"{name} is not a number"
                raise click.UsageError(f"{path}: line {number}: {cell!r} under {under}.") from error
    return columns, {*units.values()}
