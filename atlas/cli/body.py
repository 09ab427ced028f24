"""The body and the field of a command: their options, and the arguments of kernels and certified classes."""

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from math import hypot
from typing import Any, TypeVar

import click

from atlas.bodies.formula_domain import check_ratio
from atlas.cli.nearest_body import nearest_moments, nearest_tensor
from atlas.cli.options import FILE, chosen_times, given_options, numbers, stack
from atlas.cli.points import exact_inertia, oblique_tensor, point_masses, points, principal_moments, ratio_of_points
from atlas.cli.typed import REAL, Inclined, Typed, exactly, measured, parts_of
from atlas.errors import DomainError, nearest
from atlas.measured import RATE, WANTED

F = TypeVar("F", bound=Callable[..., Any])

BODY = ("ratio", "inertia", "shape", "points")
"""Options of which exactly one gives the body."""
SIZES = ("radius", "height", "length", "equatorial", "polar")
TIMES = ("1/time", "1/time^2", "time", "inertia/time^2", "(inertia/time)^2")
SECONDS = {unit: unit.replace("time", "s") for unit in TIMES}
"""Units where the field is given as B, in gauss or tesla."""

LIKE = {
    "disc": "disk", "cylinder": "solid-cylinder or cylindrical-shell", "tube": "cylindrical-shell", "ball": "sphere",
    "loop": "ring", "ellipsoid": "spheroid", "solenoid": "cylindrical-shell",
}  # fmt: skip
"""Other names of shapes."""

ROD = "thin-rod"
ROD_REASON = (
    "a thin rod has I3 = 0 and so no ratio I = I3/I2 > 0: its turn about its own axis carries no inertia, and Omega3 "
    "is not determined; give it a radius with --shape solid-cylinder."
)


def points_option(axes: str) -> Callable[[F], F]:
    """Return the decorator of the option --points; `axes` is put at the end of its help."""
    says = (
        "CSV file of point masses, with the columns x, y, z, mass and, for --magnetic, charge; a name may have a unit, "
        f"as x [um]{axes}."
    )
    return click.option("--points", type=FILE, metavar="FILE", help=says)


size_options: Callable[[F], F] = stack(
    numbers("radius", "Radius of the shape, such as 1.2um, or a number in the unit of --units."),
    numbers("height", "Height of a cylinder or cylindrical shell, as --radius."),
    numbers("equatorial", "Equatorial semi-axis of a spheroid, such as 1.2um, or a number in the unit of --units."),
    numbers("polar", "Polar semi-axis of a spheroid, as --equatorial."),
)
shape_options: Callable[[F], F] = stack(
    numbers(
        "ratio",
        "Ratio I3/I2 of the moments of inertia about the axis and across it, in (0, 2], such as 1.5.",
        callback=nearest_moments,
    ),
    click.option("--shape", metavar="NAME", help="Shape of the body, such as ring; `atlas list shapes` names them."),
    size_options,
    click.option("--length", type=REAL, hidden=True),  # of a rod, which is refused with a reason
    numbers("density", "Mass density of a solid shape, instead of --mass, such as 2200kg/m3."),
)
body_options: Callable[[F], F] = stack(
    numbers(
        "inertia",
        "Principal moments of inertia, in any one unit, instead of --ratio.",
        "I2 I3",
        callback=nearest_moments,
    ),
    shape_options,
    points_option(""),
)


def field_options_of(components: str, axes: str) -> Callable[[F], F]:
    """Return a decorator that adds the options of the field to a command.

    The options are --field, --magnetic, --mass, --charge, --mu and --units. `components`, as "B2 B3", is the metavar of
    --field and --magnetic, and so their number of values; `axes` names the axes in the help.
    """
    return stack(
        numbers("field", f"Field B' = mu B/(2c), in 1/time: its components along {axes} at t = 0.", components),
        numbers("magnetic", f"Magnetic field B, such as 0.8T: its components along {axes} at t = 0; needs --mu, or "
                "--mass and --charge.", components),
        numbers("mass", "Mass of the body, such as 1.5pg."),
        numbers("charge", "Charge of the body, such as 5000e or -2fC; goes with --magnetic and --mass."),
        click.option(
            "--mu",
            "--charge-to-mass",
            type=REAL,
            help="Charge-to-mass ratio, of either sign, such as 1.3C/kg; instead of --mass and --charge.",
        ),
        click.option(
            "--units",
            type=click.Choice(["natural", "gaussian", "si"]),
            help="Units of numbers that are typed without one: si (tesla, C/kg, kg, C, m), gaussian (gauss, esu/g, g, "
            "esu, cm), natural (c = 1). Default: si with --charge or a typed unit, else natural.",
        ),
    )  # fmt: skip


field_options: Callable[[F], F] = stack(
    field_options_of("B2 B3", "the body's axes"),
    numbers(
        "angle",
        "Angle between field and axis, in radians or as 30deg; --field or --magnetic is then one number, the "
        "strength of the field.",
    ),
)
any_body_options: Callable[[F], F] = stack(
    numbers("inertia", "Principal moments of inertia, in any one unit.", "I1 I2 I3", callback=nearest_moments),
    points_option("; x, y, z are principal axes"),
    shape_options,
    field_options_of("B1 B2 B3", "the principal axes"),
)
"""Body and field where the three moments may differ."""
tensor_option: Callable[[F], F] = numbers(
    "tensor",
    "Inertia tensor along any axes of the body, in any one unit; I12 is the element of the matrix, -sum m x y.",
    "I11 I22 I33 I12 I13 I23",
    callback=nearest_tensor,
)
curve_option: Callable[[F], F] = click.option(
    "--curve", is_flag=True, help="Print the spectral curve of a motion on a torus: branch points, periods, actions."
)
attitude_option: Callable[[F], F] = numbers(
    "attitude",
    "Initial rotation R(0), a unit quaternion with the scalar last, such as 0.6 0 0 0.8; --field is then along the "
    "laboratory's axes.",
    "X Y Z W",
)
start_option: Callable[[F], F] = numbers(
    "omega", "Initial angular velocity, in 1/time or such as 2MHz: its components along the body's axes.", "W1 W2 W3"
)
spin_option: Callable[[F], F] = numbers(
    "spin", "Initial angular velocity about the body's axis e3 alone, in 1/time or such as 2MHz."
)


def body_parameters(options: dict[str, Any]) -> dict[str, Any]:
    """Return the given ones of a command's options of body and field by name; with --magnetic also the system of units.

    --points is a path as text.
    """
    names = (*BODY, "tensor", "attitude", *SIZES, "density", "field", "magnetic", "mass", "charge", "mu")
    parameters = given_options(options, names)
    parameters |= {"points": str(options["points"])} if "points" in parameters else {}
    return parameters | ({"units": system_of(options)} if options.get("magnetic") is not None else {})


def shapes() -> dict[str, list[str]]:
    """Return the names of the shapes that --shape takes, each with the options of its dimensions.

    The options are lists of names without dashes.
    """
    from atlas.bodies.formula_shapes import SHAPES

    named = {name.replace("_", "-"): names for name, (names, _) in SHAPES.items()}
    return {name: [size for size in names if size != "mass"] for name, names in named.items() if name != ROD}


def chosen_body(options: Mapping[str, Any]) -> Any:
    """Return the ratio I3/I2, a number, or the `SymmetricBody` that --inertia, --shape or --points describes.

    `options` are the command's, by name; exactly one of the four is needed. Raises click.UsageError when none or
    several are given, or when a dimension is missing or out of place; DomainError for a ratio outside (0, 2].
    """
    one_of(options, "body", (*BODY, "tensor"))
    sizes = given_options(options, SIZES)
    if sizes and options["shape"] is None:
        raise click.UsageError(f"--{next(iter(sizes))} goes with --shape only: add --shape NAME, or leave it out.")
    if options["ratio"] is not None:
        check_ratio(options["ratio"])
        return options["ratio"]
    if options["shape"] is not None:
        return _of_shape(options["shape"].replace("_", "-"), sizes, mass_of(options))
    if options["points"] is not None:
        return points(options["points"])
    from atlas.bodies.body import SymmetricBody

    return SymmetricBody(*options["inertia"])


def _of_shape(shape: str, sizes: Mapping[str, Any], mass: Any) -> Any:
    """Return the `SymmetricBody` of a shape from its dimensions by name; its mass is 1 if `mass` is None.

    Raises click.UsageError for an unknown shape, for other dimensions, and for sizes beyond 1e150 or below 1e-150.
    """
    from atlas.bodies.body import from_shape

    shapes_by_name = shapes()
    if shape == ROD:
        raise click.UsageError(ROD_REASON)
    if shape not in shapes_by_name:
        hint = f" (did you mean {LIKE[shape]}?)" if shape in LIKE else nearest(shape, shapes_by_name)
        raise click.UsageError(f"there is no shape {shape!r}{hint}; the shapes are {', '.join(shapes_by_name)}.")
    if set(sizes) != set(shapes_by_name[shape]):
        wanted_names, typed_options = (
            " ".join(f"--{size}" for size in names) or "none" for names in (shapes_by_name[shape], sizes)
        )
        raise click.UsageError(f"the shape {shape} takes {wanted_names}; found {typed_options}.")
    for name, size in sizes.items():
        if size and not 1e-150 < abs(size) < 1e150:
            text = getattr(size, "text", size)
            raise click.UsageError(f"--{name} {text} has a square beyond floats: choose another unit of length.")
    return from_shape(shape.replace("-", "_"), mass=1.0 if mass is None else mass, **sizes)


def chosen_moments(options: Mapping[str, Any]) -> tuple[Any, ...]:
    """Return three principal moments, of --inertia I1 I2 I3, of --points, or (I2, I2, I3) of a symmetric body about e3.

    `options` are the command's, by name. Raises click.UsageError unless one of them is given, and for points whose axes
    x, y, z are not principal.
    """
    option = one_of(options, "body", (*BODY, "tensor"))
    if option == "inertia":
        return tuple(options["inertia"])
    if option == "points":
        return principal_moments(options["points"])
    body = chosen_body(options)
    I2, I3 = (1.0, body) if option == "ratio" else body.exact
    return I2, I2, I3


def given_tensor(options: Mapping[str, Any]) -> Any:
    """Return the inertia tensor, three rows, of --tensor, or of --points whose axes are not principal; None for others.

    `options` are the command's, by name. Raises click.UsageError for another body beside --tensor.
    """
    if options.get("tensor") is not None:
        one_of(options, "body", (*BODY, "tensor"))
        a, b, c, d, e, f = options["tensor"]
        return [[a, d, e], [d, b, f], [e, f, c]]
    return oblique_tensor(options["points"]) if options.get("points") is not None else None


def tensor_or_moments(options: Mapping[str, Any]) -> Any:
    """Return six numbers I11 I22 I33 I12 I13 I23, of --tensor or of --points; else three moments.

    For any other body they are (I1, I2, I3), see `chosen_moments`. `options` are the command's, by name. Raises
    click.UsageError unless the body is given once.
    """
    if options["tensor"] is not None:
        one_of(options, "body", (*BODY, "tensor"))
        return options["tensor"]
    return exact_inertia(options["points"]) if options["points"] is not None else chosen_moments(options)


def given_attitude(options: Mapping[str, Any]) -> Any:
    """Return the `Attitude` R(0) of --attitude X Y Z W, scalar last, or None without the option.

    R(0) takes components along the body's axes to those in the laboratory. `options` are the command's, by name. Raises
    AtlasError unless the quaternion's length is 1 to 1e-3; a length off by more than rounding is told as a warning.
    """
    if options.get("attitude") is None:
        return None
    from atlas.arithmetic.quaternions import rotation_of

    return rotation_of(options["attitude"], "--attitude")


def one_of(options: Mapping[str, Any], subject: str, names: Sequence[str], remedy: str = "") -> str:
    """Return the name of the single given option among `names`. Raises click.UsageError for none and for several.

    `options` are the command's, by name; `subject` says what they give, as "body", in the message; `remedy` what to
    give where there is none, by default one of `names`.
    """
    names_given = list(given_options(options, names))
    if len(names_given) != 1:
        option_names = ", ".join(f"--{name}" for name in names if name in options)
        typed_options = " and ".join(f"--{name}" for name in names_given)
        if names_given:
            raise click.UsageError(f"the {subject} is given twice, by {typed_options}: leave one of them out.")
        raise click.UsageError(f"the {subject} is missing: give {remedy or f'one of {option_names}'}.")
    return names_given[0]


def as_typed(options: dict[str, Any]) -> dict[str, Any]:
    """Return the options by name; with --decimal the typed numbers of the body, the field and the start are fractions.

    Raises click.UsageError for --decimal with numbers that are computed from others in doubles. Without --decimal
    the options are returned unchanged.
    """
    if not options.get("decimal"):
        return options
    if options.get("points") is not None:
        raise click.UsageError("--decimal goes with numbers that are typed, not with --points.")
    if "field" in options and (options["field"] is None or isinstance(options["field"], Inclined)):
        raise click.UsageError("--decimal goes with --field and its components, not with --magnetic or --angle.")
    return {name: exactly(value, options) for name, value in options.items() if name not in ("times", "grid")}


def mass_of(options: Mapping[str, Any]) -> Any:
    """Return the mass of a shape, from --mass or from --density with pi in 512 bits; None without either.

    The second is a Fraction. Raises UsageError for a density besides a mass, of a shape that is no solid, or of one
    without all sizes; DomainError for a volume of zero. `options` are the command's, by name.
    """
    if options.get("density") is None:
        return options.get("mass")
    from atlas.arithmetic.numbers import as_rational, rational, workprec
    from atlas.bodies.formula_shapes import SHAPES, VOLUMES

    shape = str(options["shape"]).replace("-", "_")
    lengths = [options[name] for name in SHAPES[shape][0][1:]] if shape in VOLUMES else []
    if lengths and 0.0 in lengths:
        raise DomainError("--density: a shape without a height or radius has no volume, and so no mass; give --mass.")
    if options.get("mass") is not None or not all(lengths) or not lengths:
        solids = ", ".join(VOLUMES).replace("_", "-")
        if shape not in VOLUMES:
            reason = f"a {options['shape']} is without thickness and has no volume"
            raise click.UsageError(f"--density: {reason}; give --mass instead, or a solid --shape ({solids}).")
        raise click.UsageError(f"--density goes with all sizes of a {options['shape']} and without --mass.")
    with workprec(512):
        mass = as_rational(rational(options["density"]) * VOLUMES[shape](*map(rational, lengths)))
    return Fraction(int(mass.p), int(mass.q))


def system_of(options: Mapping[str, Any]) -> str:
    """Return the system of units: --units, or by default "si" with --charge, --points or a typed unit, else "natural".

    Raises click.UsageError for a typed unit with another system. `options` are the command's, by name.
    """
    charged = options["charge"] is not None or options.get("points") is not None
    has_unit = in_one_system(options)
    return options["units"] or ("si" if charged or has_unit else "natural")


def speed_of_light(options: Mapping[str, Any]) -> float:
    """Return the factor c of (32) and (93): in cm/s in Gaussian units, 1 in the others."""
    from atlas.bodies.units import GAUSSIAN

    return GAUSSIAN.c if system_of(options) == "gaussian" else 1.0


def in_one_system(options: Mapping[str, Any]) -> list[tuple[str, Typed]]:
    """Return the pairs (option, number) of numbers typed with a unit; [] for none.

    Raises click.UsageError for a unit beside a system other than SI.
    """
    numbers_with_units = measured(options)
    if numbers_with_units and options["units"] not in {None, "si"}:
        raise click.UsageError(f"{numbers_with_units[0][1].text} is in SI: leave out --units {options['units']}.")
    return numbers_with_units


def units_of(options: Mapping[str, Any]) -> dict[str, str]:
    """Return `SECONDS`, such as {"time": "s", "1/time": "1/s"}, if a unit or a system of units is known, else {}.

    `options` are the command's, by name.
    """
    has_units = options.get("magnetic") is not None and system_of(options) != "natural"
    return SECONDS if has_units or any(WANTED[name] in {RATE, "s"} for name, _ in measured(options)) else {}


def charge_to_mass_of(options: Mapping[str, Any], needs: str = "--magnetic") -> Fraction:
    """Return the charge-to-mass ratio mu, not rounded, from --mu, --mass and --charge, or --points.

    It is in C/kg in SI, in statC/g in Gaussian units. `options` are the command's, by name; `needs` names the
    option that requires mu, for the message. Raises click.UsageError where none of them or several are given.
    """
    from atlas.arithmetic.inputs import finite
    from atlas.bodies.units import charge_to_mass

    charge, mass = _charge_and_mass(options, needs)
    finite(charge_to_mass(charge, mass), "The charge-to-mass ratio")
    return Fraction(charge) / Fraction(mass)


def _charge_and_mass(options: Mapping[str, Any], needs: str) -> tuple[float | Fraction, float | Fraction]:
    """Return (charge, mass) as typed; (mu, 1.0) if --mu or --points gives the ratio mu.

    Raises click.UsageError for missing or contradicting options; `needs` names the option that requires the ratio.
    """
    mass = mass_of(options)
    option_names = [f"--{name}" for name, value in (("mass", mass), ("charge", options["charge"])) if value is not None]
    if options.get("points") is not None:
        if option_names or options["mu"] is not None:
            raise click.UsageError(f"--points holds masses and charges: leave out {(option_names or ['--mu'])[0]}.")
        return ratio_of_points(options["points"]), 1.0
    if options["mu"] is not None:
        if option_names:
            raise click.UsageError(f"--mu is the charge-to-mass ratio: leave out {option_names[0]}, or --mu.")
        return options["mu"], 1.0
    if mass is None or options["charge"] is None:
        missing_names = "--mass and --charge, or --mu" if not option_names else "--mass" if mass is None else "--charge"
        raise click.UsageError(f"{needs} needs {missing_names}, for the charge-to-mass ratio.")
    return options["charge"], mass


def chosen_field(options: Mapping[str, Any]) -> tuple[float | Fraction, ...]:
    """Return (B2, B3) or (B1, B2, B3) of B' in 1/time, from --field, or from --magnetic and the charge-to-mass ratio.

    --field is B' itself; --magnetic is B, from which B' = mu B/(2c). There are as many components as were typed;
    they are along the body's axes at t = 0. A product that is no float is a Fraction, and so not rounded.

    Raises click.UsageError when neither or both are given, or an option of the one stands beside the other.
    `options` are the command's, by name.
    """
    remedy = "B' by --field, or B by --magnetic with --mu, or with --mass and --charge"
    one_of(options, "field", ("field", "magnetic"), remedy)
    if options["field"] is not None:
        for name in ("mu", "mass", "charge", "units"):
            if options[name] is not None:
                raise click.UsageError(
                    f"--{name} goes with --magnetic only, for --field is B' in 1/time: leave it out."
                )
        return tuple(options["field"])
    from atlas.bodies.field import Field

    B = options["magnetic"]
    field = Field((0.0,) * (3 - len(B)) + B, mu=charge_to_mass_of(options), c=speed_of_light(options))
    return field.exact[3 - len(B) :]


def check_speeds(options: Mapping[str, Any], start: Sequence[float] | None = None) -> None:
    """Warn of speeds above a tenth of that of light, of a charge or of a body's points at t = 0, if units are known.

    Of a charge also at its times, since the part of E along B accelerates it for ever. `options` are the command's, by
    name; `start` (3,) is the angular velocity of the body, in rad/s, where no option gives it. Nothing is done where no
    unit is known. Raises DomainError where the drift in crossed fields is not below the speed of light.
    """
    has_units = options.get("magnetic") is not None and system_of(options) != "natural"
    charge, shape = "electric" in options and has_units, options.get("shape")
    extended = (shape is not None or options.get("points") is not None) and units_of(options)
    if not (charge or ("electric" not in options and extended)):
        return
    from atlas.bodies.speeds import check_drift, fastest_of, fastest_point, speed_of_light, warn_of
    from atlas.bodies.units import system

    units = system(system_of(options)) if has_units else system("SI")
    if charge:
        check_drift(options["electric"] or (0, 0, 0), options["magnetic"], units)
        speed, t = _fastest(options)
        place = f"the velocity at t = {t:g}"
    else:
        start = start or options.get("omega") or (0.0, options.get("omega2") or 0.0, options.get("spin") or 0.0)
        sizes = {name: float(size) for name, size in given_options(options, SIZES).items()}
        if shape is None:
            speed, place = fastest_of(point_masses(options["points"]).places, start), "a point of the body at t = 0"
        else:
            speed, place = fastest_point(shape.replace("-", "_"), sizes, start), "the surface at t = 0"
    warn_of(place, speed / speed_of_light(units))


def _fastest(options: Mapping[str, Any]) -> tuple[float, float]:
    """Return (largest speed of a charge, its time) among t = 0 and the times of --times.

    The speed is in the unit of --velocity, or m/s if that was typed with a unit; the time in that of --times, or s.
    Gyration is left out: the speed is that of the initial velocity and of the acceleration by E along B, or by E
    without B. `options` are the command's, by name.
    """
    velocity, E, B = ([*map(float, options[name] or (0, 0, 0))] for name in ("velocity", "electric", "magnetic"))
    square = hypot(*B) ** 2
    pull = sum(x * y for x, y in zip(E, B, strict=True)) / square if square else 0.0
    driving_field = [pull * x for x in B] if square else E
    mu = float(charge_to_mass_of(options, "A point charge"))
    times = [0.0, *map(float, parts_of(chosen_times(dict(options))))] if "times" in options else [0.0]
    speeds = [hypot(*(v + mu * a * t for v, a in zip(velocity, driving_field, strict=True))) for t in times]
    return max(speeds), times[speeds.index(max(speeds))]


def start_of(options: Mapping[str, Any], *, is_required: bool = True) -> Any:
    """Return the initial angular velocity, three numbers in rad/time, from --omega, or from --spin as (0, 0, W3).

    The numbers are components along the body's axes. None if neither is given and none `is_required`; click.UsageError
    for both, and for none if one is required. `options` are the command's, by name.
    """
    omega, spin = options["omega"], options["spin"]
    if is_required or spin is not None:
        one_of(options, "start", ("omega", "spin"), "--omega W1 W2 W3 or --spin W3")
    return omega if spin is None else (0.0, 0.0, spin)
