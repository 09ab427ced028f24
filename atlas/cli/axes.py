"""A motion in axes that were given, and the options that ask for it in those of its class, or in principal ones."""

from fractions import Fraction
from typing import Any, NamedTuple

from atlas.cli import body
from atlas.cli.typed import parts_of
from atlas.families.family import RATE
from atlas.motions.register import FAMILIES, Family

OWN_AXES = "(1, 0, 0), (0, 1, 0), (0, 0, 1)"
"""Principal axes that are those of the body."""


def motion_in_given_axes(options: dict[str, Any]) -> Any:
    """Return the motion in the given axes where they differ from those of its class, else None.

    `options` are the command's, by name. The axes differ for a tensor that is not diagonal, for a start from an
    attitude, and for a symmetric body in a field of three components. The motion is in doubles: a certified motion
    has principal axes, and R(0) = 1.
    """
    tensor, attitude = body.given_tensor(options), body.given_attitude(options)
    J = body.chosen_moments(options) if tensor is None else tensor
    if tensor is None and attitude is None and len({*map(float, J)}) == len(J):
        return None
    from atlas.motions.any_body import motion

    return motion(J, body.chosen_field(options), body.start_of(options), attitude)


class Principal(NamedTuple):
    """A motion along the axes of its class, as options of a command and as numbers.

    `family` is its family, `options` are words such as "--omega", "0.3rad/s", `values` the numbers of each
    parameter by name, in a tuple, and `axes` the text of the axes in terms of the given ones. `is_rounded` tells
    whether numbers along these axes are rounded to floats.
    """

    family: Family
    options: list[str]
    values: dict[str, tuple[float | Fraction, ...]]
    axes: str
    is_rounded: bool

    @property
    def note(self) -> str:
        """Sentence on the principal axes; "" where they are the given axes."""
        if self.axes == OWN_AXES:
            return ""
        rounded = "; numbers along them are rounded to floats" * self.is_rounded
        return f"The axes are principal ones: {self.axes} in those of the body that were given{rounded}."


def in_principal_axes(motion: Any, unit: str = "", *, fitted: bool = False) -> Principal:
    """Return a motion in given axes as a `Principal`, along the axes of its class; `unit` is written behind its rates.

    `unit` is a text only: nothing is converted. The family is that of any three moments where the class has no
    command, where floats do not hold its inputs, and where its field is given by three numbers; but a field (0, K2,
    K3) of a symmetric body counts as two. A motion that was `fitted`, which is rounded anyway, keeps a family with
    a command in both of the latter cases; the axes of a symmetric body are then turned about the third so that its
    field has two components.
    """
    from atlas.arithmetic.given import Given

    family, arguments, axes = FAMILIES[motion.family], dict(motion.own.arguments), motion.axes
    if family.in_plane and (fitted or not float([0.0, *arguments["field"]][-3])):
        arguments, turn = family.in_plane(arguments)
        axes = axes if turn is None else turn @ axes
    numbers = [x for value in arguments.values() for x in parts_of(value)]
    is_typed = len(parts_of(arguments.get("field", 0.0))) < 3 and not any(isinstance(x, Given) for x in numbers)
    if not (family.command and (fitted or is_typed)):
        return along_principal_axes(motion, unit)
    return _principal(family, arguments, axes, unit)


def along_principal_axes(motion: Any, unit: str = "") -> Principal:
    """Return a motion in given axes as a `Principal` of a body with three moments.

    `unit` is written behind its rates.
    """
    from atlas.motions.start import start_of

    start = start_of(**motion.arguments)
    axes = start.body.axes
    field, omega = start.components_along(axes)
    arguments = {"inertia": start.moments, "field": tuple(field), "omega": tuple(omega)}
    return _principal(FAMILIES["asymmetric"], arguments, axes, unit)


def _principal(family: Family, arguments: dict[str, Any], axes: Any, unit: str) -> Principal:
    """Return the `Principal` of an object: its family, options of a command, and values by parameter.

    `arguments` are the parameters of `family` by name; those that are missing or None give no option. `axes` (3, 3) has
    the axes as rows, in terms of the given ones. `unit`, such as "rad/s" or "", is written behind each rate.
    """
    from atlas.arithmetic.given import Given

    words, values = list[str](), dict[str, tuple[float | Fraction, ...]]()
    rounded = any(x not in {-1, 0, 1} for x in axes.ravel())
    for p in family.parameters:
        value: Any = arguments.get(p.name)
        if p.name == "ratio" and hasattr(value, "I2"):
            words += ["--inertia", repr(float(value.I2)), repr(float(value.I3))]
            value = value.ratio
        elif value is not None:
            words += [f"--{p.name}", *(repr(float(x)) + unit * (p.unit == RATE) for x in parts_of(value))]
        if value is not None:
            values[p.name] = tuple(
                Fraction(*x.as_integer_ratio()) if isinstance(x, Given) else float(x) for x in parts_of(value)
            )
            rounded |= any(isinstance(x, Given) for x in parts_of(value))
    return Principal(family, words, values, axes_text(axes), rounded)


def axes_text(axes: Any) -> str:
    """Return axes, the rows of a matrix (3, 3), as text: "(1, 0, 0), (0, 1, 0), (0, 0, 1)", to ten digits."""
    return ", ".join(f"({', '.join(f'{x:z.10g}' for x in axis)})" for axis in axes)
