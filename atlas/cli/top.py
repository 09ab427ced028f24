"""Options of ``atlas top`` in place of moments and couplings: a heavy body, or a charged one in a field."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from fractions import Fraction
from math import hypot
from pathlib import Path
from typing import Any

import click

from atlas.bodies.formula_domain import check_direction, check_moments
from atlas.cli.body import SECONDS, SIZES, F, in_one_system, one_of, size_options, start_of, units_of
from atlas.cli.options import FILE, given_options, numbers, stack
from atlas.cli.points import Masses, point_masses
from atlas.cli.typed import Real

WAYS = ("heavy", "magnetic")
BODY = ("inertia", "shape", "points")
CHARGES = ("charged", "coat", "points")
OF_HEAVY, OF_CHARGED = ("mass",), ("charged", "coat", "charge", "moment", "polarizability", "units")

top_options: Callable[[F], F] = stack(
    click.option("--heavy", type=(Real(0), Real(1)), metavar="G L", help="Heavy top: gravity G in m/s^2, "
                 "and the distance L in m along the axis from the fixed point to the centre of mass; --inertia, in "
                 "kg m^2, is about the centre of mass. Needs --mass or --points."),
    numbers("magnetic", "Charged body in this magnetic field, such as 0.8T, across and along the axis; n is the "
            "direction of the field. Needs --charged, --coat or --points. With --heavy, up is along the field, or "
            "against it by --direction.",
            "B2 B3"),
    numbers("mass", "Mass of the body, such as 50g; goes with --heavy or --shape."),
    click.option("--shape", metavar="NAME", help="Shape of the body instead of --inertia, such as disk; `atlas list "
                 "shapes` names them."),
    size_options,
    click.option("--points", type=FILE, metavar="FILE", help="CSV file of point "
                 "masses and charges, with the columns x, y, z, mass, charge; the axis is z."),
    numbers("charged", "Second moments of the charge, in C m^2 or statC cm^2, about the transverse axis and about "
            "the body's axis, through the centre of mass; with --heavy through the fixed point.", "J2 J3"),
    click.option("--coat", metavar="NAME", help="Shape over which the charge is spread, with the dimensions of the "
                 "body; needs --charge."),
    numbers("charge", "Charge spread over the shape of --coat, such as 5000e, of either sign."),
    numbers("moment", "Magnetic moment along the axis, in A m^2 or erg/G; goes with --magnetic."),
    numbers("polarizability", "Induced magnetic moment per unit field across and along the axis, in A m^2/T or erg/G^2;"
            " goes with --magnetic.", "A2 A3"),
    click.option("--units", type=click.Choice(["si", "gaussian"]), help="Units of --magnetic, its "
                 "options and --inertia: si (kg, m, C, T), the default, or gaussian (g, cm, statC, G)."),
)  # fmt: skip


def given_otherwise(options: Mapping[str, Any]) -> bool:
    """Return whether the top is given by --heavy or --magnetic, which replace its coefficients."""
    return bool(given_options(options, WAYS))


def top_units(options: Mapping[str, Any]) -> dict[str, str]:
    """Return {"time": "s", "1/time": "1/s", ...} for a top by --heavy or --magnetic, else `units_of(options)`.

    The keys are the units with a time in them, those of `SECONDS`. `options` are the command's, by name.
    """
    return SECONDS if given_otherwise(options) else units_of(options)


def needs_no_way(options: Mapping[str, Any]) -> None:
    """Raise click.UsageError for an option that needs --heavy or --magnetic, and for a missing required option."""
    for name in top_parameters(options):
        if name != "inertia":
            raise click.UsageError(f"--{name} goes with --heavy or --magnetic.")
    for name, form in (("inertia", "I2 I3"), ("direction", "N2 N3")):
        if options[name] is None:
            raise click.UsageError(f"--{name} is missing: give --{name} {form}, or a body by --heavy or --magnetic.")


def checks_of_top(options: Mapping[str, Any]) -> Iterator[tuple[Sequence[str], Callable[[], Any]]]:
    """Yield (names of its options, function that reads them) for each part of a top.

    The functions take no argument, and raise click.UsageError or AtlasError for a fault.
    """
    yield ("omega", "spin"), lambda: start_of(options)
    if options["direction"] is not None:
        yield ("direction",), lambda: check_direction(*options["direction"])
    if not given_otherwise(options):
        yield ("inertia", "direction", *top_parameters(options)), lambda: needs_no_way(options)
        if options["inertia"] is not None:
            yield ("inertia",), lambda: check_moments(*options["inertia"])
        return
    yield (*BODY, *SIZES, *OF_HEAVY, "heavy"), lambda: _body(options)
    if options["magnetic"] is not None:
        yield (*CHARGES, *SIZES, "charge"), lambda: _charges(options, None)


def top_parameters(options: Mapping[str, Any]) -> dict[str, Any]:
    """Return the given options of a top's body and its forces, by name; --points as text."""
    names = (*WAYS, *BODY, *SIZES, *OF_HEAVY, *OF_CHARGED)
    return given_options(options, dict.fromkeys(names)) | (
        {"points": str(options["points"])} if options["points"] else {}
    )


def parameters_of_top(names: Sequence[str], options: Mapping[str, Any]) -> dict[str, Any]:
    """Return the typed options by name, and under "top" a dict of the computed top's attributes `names`."""
    top = chosen_top(options)
    typed_options = top_parameters(options) | given_options(options, ("omega", "spin", "direction"))
    return typed_options | {"top": {name: getattr(top, name) for name in names}}


def chosen_top(options: Mapping[str, Any]) -> Any:
    """Return the `TopMotion` that --heavy or --magnetic describes, from the command's options by name.

    Raises click.UsageError for contradicting or missing options.
    """
    if options.get("decimal"):
        raise click.UsageError("--decimal goes with --inertia, --coupling and --direction, not with --heavy or "
                               "--magnetic, from which these are computed.")  # fmt: skip
    for name in ("coupling", "linear", "quadratic"):
        if any(options[name] if isinstance(options[name], tuple) else [options[name]]):
            raise click.UsageError(f"--{name} is computed from --heavy or --magnetic: leave it out.")
    omega = tuple(map(float, start_of(options)))
    if options["magnetic"] is not None:
        return _charged(options, omega)
    _nothing_of(options, (*OF_CHARGED, "points"), "--magnetic", "--heavy")
    _needs(options, "direction", "--heavy")
    return _heavy(options, options["direction"], omega)


def _heavy(options: Mapping[str, Any], direction: tuple[float, float], omega: tuple[float, ...]) -> Any:
    """Return the `TopMotion` of a heavy top.

    `direction` (n2, n3) points upwards, n3 along the body's axis, at t = 0; `omega` has three components in rad/s along
    the body's axes. Raises click.UsageError without a mass, of --mass or of the points. `options` are the command's, by
    name.
    """
    from atlas.motions.nutation.kernel_top import TopMotion

    if options["points"] is None:
        _needs(options, "mass", "--heavy")
    body, (gravity, length) = _body(options), options["heavy"]
    mass = options["mass"] if options["points"] is None else sum(_points(options["points"]).masses.tolist())
    return TopMotion.heavy(body, gravity, length, direction, omega, mass=mass)


def _charged(options: Mapping[str, Any], omega: tuple[float, ...]) -> Any:
    """Return the `TopMotion` of a charged top; with --heavy it is held at a point and has a weight.

    Up is then --direction, by default the direction of the field, to which it must be parallel. `omega` (3,) is the
    initial angular velocity in rad/s along the body's axes. Raises click.UsageError for --direction without
    --heavy. `options` are the command's, by name.
    """
    from atlas.bodies.body import SymmetricBody
    from atlas.motions.nutation.kernel_top import TopMotion

    in_one_system(options)
    field, body, length, weight = options["magnetic"], _body(options), None, (0.0, 0.0)
    if options["heavy"] is not None:
        n2, n3 = options["direction"] or field
        moments, length, size = _heavy(options, (n2, n3), omega), float(options["heavy"][1]), hypot(n2, n3)
        body, weight = SymmetricBody(*moments.inertia), (moments.linear * (n2 / size), moments.linear * (n3 / size))
    elif options["direction"] is not None:
        raise click.UsageError("--direction is the direction of --magnetic here: leave it out.")
    return TopMotion.charged(
        body, _charges(options, length), field, omega, units=options["units"] or "si",
        moment=options["moment"] or 0.0, polarizability=options["polarizability"] or (0.0, 0.0), weight=weight,
    )  # fmt: skip


def _body(options: Mapping[str, Any]) -> Any:
    """Return the `SymmetricBody` of --inertia, --shape or --points.

    Raises click.UsageError unless one of them is given, for options of another, and for a shape without --mass.
    `options` are the command's, by name.
    """
    from atlas.bodies.body import SymmetricBody, from_shape

    one_of(options, "body", BODY)
    _goes_with(options, SIZES, ("shape", "coat"))
    if options["points"] is not None:
        if options["mass"] is not None:
            raise click.UsageError("--mass: the file of --points has the masses; leave it out.")
        read = _points(options["points"])
        return SymmetricBody.from_point_masses(read.masses, read.places)
    _goes_with(options, ("mass",), ("heavy", "shape"))
    if options["inertia"] is not None:
        return SymmetricBody(*options["inertia"])
    _needs(options, "mass", "--shape")
    return from_shape(options["shape"].replace("-", "_"), mass=options["mass"], **given_options(options, SIZES))


def _charges(options: Mapping[str, Any], length: float | None) -> Any:
    """Return the `ChargeMoments` from --charged, --coat or --points.

    `length` is the distance of the fixed point from the centre of mass, None for a free body. Raises
    click.UsageError unless one of them is given. `options` are the command's, by name.
    """
    from atlas.bodies.charge import ChargeMoments

    one_of(options, "charge", CHARGES)
    _goes_with(options, ("charge",), ("coat",))
    if options["points"] is not None:
        read = _points(options["points"])
        to_point = (0.0, 0.0, length or 0.0)
        return ChargeMoments.points(read.charges, read.places + to_point, held=length is not None)
    if options["charged"] is not None:
        return ChargeMoments(*options["charged"])
    _needs(options, "charge", "--coat")
    coat = ChargeMoments.shape(options["coat"].replace("-", "_"), options["charge"], **given_options(options, SIZES))
    return coat + ChargeMoments(Fraction(options["charge"]) * Fraction(length or 0) ** 2, 0.0)


def _points(path: Path) -> Masses:
    """Return the `Masses` of a file of points with charges. Raises click.UsageError without charges."""
    read = point_masses(path)
    if read.charges is None:
        raise click.UsageError(f"{path} must have the columns x, y, z, mass, charge; it has x, y, z, mass.")
    return read


def _needs(options: Mapping[str, Any], name: str, option: str) -> None:
    if options[name] is None:
        raise click.UsageError(f"{option} needs --{name}: add it.")


def _goes_with(options: Mapping[str, Any], names: Sequence[str], other_options: Sequence[str]) -> None:
    """Raise click.UsageError for a given option of `names` where none of `other_options`, which it needs, is given."""
    if not given_options(options, other_options):
        for name in given_options(options, names):
            raise click.UsageError(f"--{name} goes with {' or '.join(f'--{option}' for option in other_options)}.")


def _nothing_of(options: Mapping[str, Any], names: tuple[str, ...], way: str, option: str) -> None:
    for name in given_options(options, names):
        raise click.UsageError(f"--{name} goes with {way}, not with {option}.")
