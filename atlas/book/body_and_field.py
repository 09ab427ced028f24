"""The bodies and fields of a report: as records in its file, as arguments of kernels, and in print."""

from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Literal

import msgspec
import numpy as np

from atlas.arithmetic.certified_inputs import rational
from atlas.arithmetic.given import as_float_or_fraction
from atlas.bodies.body import SHAPES, SymmetricBody
from atlas.bodies.field import Field as PhysicalField
from atlas.bodies.field import LaboratoryFrame
from atlas.bodies.speeds import check_drift
from atlas.bodies.units import System, ratio_of, system
from atlas.book.digits import markdown_of
from atlas.book.schema import Exact, StrictStruct, Vector
from atlas.errors import AtlasError, unknown

DIMENSIONS = {
    "mass": ("mass", "$m_0$", "kg"),
    "radius": ("radius", "$r$", "m"),
    "height": ("height", "$h$", "m"),
    "length": ("length", "$l$", "m"),
    "equatorial": ("equatorial semi-axis", "$a$", "m"),
    "polar": ("polar semi-axis", "$c$", "m"),
    "charge": ("charge", "$e$", "C"),
}
"""Dimensions of a body: name in words, letter, unit in SI."""
GAUSSIAN_UNITS = {"kg": "g", "m": "cm", "C": "statC", "kg m$^2$": "g cm$^2$"}
"""Gaussian units in the place of those in SI."""


class Body(StrictStruct, frozen=True):
    """A body's record: the ratio I = I3/I2, or (I2, I3), or a shape with dimensions in metres and kilograms.

    Exactly one of `ratio`, `inertia` and `shape`, a key of `SHAPES`, is given; `inertia` may be in any unit, since
    the motion depends on the ratio alone; a shape takes its mass and its own
    lengths: `radius`, `height`, `length`, or the semi-axes `equatorial` and `polar`. `charge` is in C; in a
    Gaussian field lengths are in cm, masses in g and charges in statC. `title` names the body in sentences.
    """

    title: str
    ratio: float | None = None
    inertia: tuple[Exact, Exact] | None = None
    shape: str | None = None
    mass: float | None = None
    radius: float | None = None
    height: float | None = None
    length: float | None = None
    equatorial: float | None = None
    polar: float | None = None
    charge: float | None = None


class Field(StrictStruct, frozen=True):
    """A field's record: (B2, B3) of B' in 1/s, or the vector B with its system of units.

    Exactly one of `prime` = (B2, B3) and `B` is given. `B` in T and `E` in V/m, or in G and statV/cm, are vectors
    (3,) in the laboratory, and `axis` is the direction of the body's symmetry axis there at t = 0. `charge_to_mass` =
    mu, in C/kg or statC/g (None: that of the body), turns B into B' = mu B/(2c), with c = 1 in SI. `title` names the
    field in sentences.
    """

    title: str
    prime: tuple[Exact, Exact] | None = None
    B: Vector | None = None
    E: Vector = (0.0, 0.0, 0.0)
    axis: Vector = (0.0, 0.0, 1.0)
    charge_to_mass: Exact | None = None
    system: Literal["SI", "Gaussian"] = "SI"


class BodiesAndFields(StrictStruct, frozen=True):
    """The bodies, fields and sets of parameters that the blocks call by name, each a dict by that name.

    A set holds values by name of a parameter.
    """

    bodies: dict[str, Body] = msgspec.field(default_factory=dict)
    fields: dict[str, Field] = msgspec.field(default_factory=dict)
    sets: dict[str, dict[str, Any]] = msgspec.field(default_factory=dict)


@dataclass(frozen=True)
class BodyAndField:
    """A body in a field, and the records from which both come; None for a body or field that is not given.

    `body` and `body_record` are the body and its record; `field` = (B2, B3), components of B' in 1/s. `physical`,
    the field B and E with the charge-to-mass ratio, `frame`, the laboratory's axes, and `units` are set if the
    field was given as B.
    """

    body: SymmetricBody | None = None
    body_record: Body | None = None
    field: tuple[float, float] | None = None
    field_record: Field | None = None
    physical: PhysicalField | None = None
    frame: LaboratoryFrame | None = None
    units: System | None = None

    @property
    def exact(self) -> Any:
        """The body's `Moments` (I2, I3) without rounding, as given; of a shape, computed from its dimensions.

        Raises AtlasError without a body.
        """
        from atlas.bodies.certified_body import Moments, shape_moments

        record = self.body_record
        if self.body is None or record is None:
            raise AtlasError("this needs a body: name one with the key 'body'.")
        if record.shape is None:
            return Moments(self.body.I2, self.body.I3)
        return Moments(*shape_moments(record.shape, **dimensions(record)))

    @property
    def components(self) -> tuple[float, float]:
        """Components (B2, B3) of B' in 1/s, as floats, along e2 and along the body's axis e3 at t = 0.

        B2 >= 0 for a field given as B. Raises AtlasError without a field.
        """
        if self.field is None:
            raise AtlasError("this needs a field: name one with the key 'field'.")
        return self.field

    @property
    def exact_components(self) -> tuple[float | Fraction, ...]:
        """Components (B2, B3) of B' in 1/s, along e2 and along the axis e3, see `LaboratoryFrame`: floats or fractions.

        They are not rounded if B' was given, or if B was with the body's axis along the third axis of its
        components, B1 = 0 and B'2 >= 0; else they are floats, each rounded once. Raises AtlasError without a field.
        """
        if self.field_record and self.field_record.prime is not None:
            return tuple(as_float_or_fraction(rational(x, "prime")) for x in self.field_record.prime)
        field, frame = self.physical, self.frame
        is_in_plane = field is not None and frame is not None and not (frame.axis[:2].any() or field.prime[0])
        return field.exact_pair if field and is_in_plane and field.prime[1] >= 0 else self.components

    @property
    def ratio(self) -> float:
        """The float nearest to the exact I = I3/I2, for figures. Raises AtlasError without a body."""
        from atlas.bodies.certified_body import ratio_of

        I = ratio_of(self.exact)
        return int(I.p) / int(I.q)


def body(record: Body) -> SymmetricBody:
    """Return the `SymmetricBody` of a record, from its ratio, its moments, or its shape and dimensions.

    Raises AtlasError unless exactly one of ratio, inertia and shape is given, for an unknown shape, for dimensions
    without a shape, and for dimensions that the shape lacks or does not have.
    """
    keys = [key for key in ("ratio", "inertia", "shape") if getattr(record, key) is not None]
    if len(keys) != 1:
        raise AtlasError(
            f"the body {record.title!r} must have exactly one of ratio, inertia and shape, not {keys or 'none'}."
        )
    sizes = dimensions(record)
    if record.shape is None:
        if set(sizes) - {"mass"}:
            raise AtlasError(f"the body {record.title!r} has dimensions, {', '.join(sizes)}, but no shape.")
        moments = (1.0, record.ratio) if record.ratio is not None else record.inertia or ()
        return SymmetricBody(*(as_float_or_fraction(rational(x, "inertia")) for x in moments))
    if record.shape not in SHAPES:
        raise AtlasError(f"the body {record.title!r}: {unknown('shape', record.shape, SHAPES)}")
    make, names = SHAPES[record.shape]
    if set(names) != set(sizes):
        raise AtlasError(
            f"the body {record.title!r}: the shape {record.shape!r} takes {', '.join(names)}, "
            f"not {', '.join(sizes) or 'nothing'}."
        )
    made_body: SymmetricBody = make(**sizes)
    return made_body


def dimensions(record: Body) -> dict[str, float]:
    """Return the given lengths in m and the mass in kg of a body's record by name, without its charge.

    {} without any.
    """
    values = {key: getattr(record, key) for key in DIMENSIONS if key != "charge"}
    return {key: value for key, value in values.items() if value is not None}


def chosen(block: Any, records: BodiesAndFields) -> tuple[BodyAndField, ...]:
    """Return a `BodyAndField` for each body that a block names by `bodies`, else `body`, all in the block's `field`.

    These are attributes of the block. If it names no body, there is one item without a body; without a field its
    `field` is None. Raises AtlasError for records that make no body or field, KeyError for a name that is not among
    the records, which is found on loading.
    """
    field = records.fields[block.field] if block.field else None
    bodies = block.bodies or ((block.body,) if block.body else (None,))
    return tuple(body_and_field(records.bodies[name] if name else None, field) for name in bodies)


def body_and_field(body_record: Body | None, field_record: Field | None) -> BodyAndField:
    """Return the `BodyAndField` of two records, either of which may be None.

    A field B becomes B' by the charge-to-mass ratio of the field's record, else of the body's. Raises AtlasError for a
    field given neither or both ways, for B without such a ratio, for B' with one, and for a drift as fast as light.
    """
    symmetric_body = body(body_record) if body_record else None
    if field_record is None:
        return BodyAndField(symmetric_body, body_record)
    if (field_record.prime is None) == (field_record.B is None):
        raise AtlasError(f"the field {field_record.title!r} must have exactly one of prime and B.")
    if field_record.prime is not None:
        if field_record.charge_to_mass is not None:
            raise AtlasError(
                f"the field {field_record.title!r} is given by B', which has the charge-to-mass ratio in it."
            )
        B2, B3 = (float(Fraction(x)) for x in field_record.prime)
        return BodyAndField(symmetric_body, body_record, (B2, B3), field_record)
    units = system(field_record.system)
    mu = _charge_to_mass(body_record, field_record)
    physical = PhysicalField(np.array(field_record.B), np.array(field_record.E), mu, units.c)
    check_drift(physical.E, physical.B, units)
    frame = physical.frame(field_record.axis)
    return BodyAndField(symmetric_body, body_record, frame.field, field_record, physical, frame, units)


def _charge_to_mass(body_record: Body | None, field_record: Field) -> float | Fraction:
    """Return the charge-to-mass ratio of the field's record, else charge over mass of the body's, in C/kg or statC/g.

    Raises AtlasError where neither record has it.
    """
    if field_record.charge_to_mass is not None:
        return as_float_or_fraction(rational(field_record.charge_to_mass, "charge_to_mass"))
    if body_record is None or body_record.charge is None or body_record.mass is None:
        raise AtlasError(f"the field {field_record.title!r} needs charge_to_mass, or a body with a charge and a mass.")
    exact: Fraction = ratio_of(None, body_record.charge, body_record.mass)
    return exact


def parameters(known_records: BodiesAndFields) -> list[str]:
    """Return lines of Markdown, one for each body, then one for each field: "title: name = value unit, ..."."""
    fields = [*known_records.fields.values()]
    is_gaussian = bool(fields) and all(field.system == "Gaussian" for field in fields)
    records: list[Body | Field] = [*known_records.bodies.values(), *fields]
    return [
        f"{record.title}: {_written_out(record, is_gaussian and getattr(record, 'charge', None) is not None)}"
        for record in records
    ]


_UNITS = {
    "SI": {
        "B": "T",
        "E": "V/m",
        "charge_to_mass": "C/kg",
        **{key: unit for key, (_, _, unit) in DIMENSIONS.items()},
    },
    "Gaussian": {
        "B": "G",
        "E": "statV/cm",
        "charge_to_mass": "statC/g",
        **{key: GAUSSIAN_UNITS[unit] for key, (_, _, unit) in DIMENSIONS.items()},
    },
}
_NAMES = {"prime": "B\u2032", "charge_to_mass": "e/m", "ratio": "I", "inertia": "(I2, I3)"}


def _written_out(record: Body | Field, is_gaussian: bool) -> str:
    """Return the inputs of a record as text, "name = value unit", separated by commas; defaults of E and axis left out.

    `is_gaussian` says that a body's dimensions are in Gaussian units, as its field's.
    """
    units = _UNITS["Gaussian" if is_gaussian else getattr(record, "system", "SI")]
    numbers = []
    for key in record.__struct_fields__:
        value, omitted = getattr(record, key), getattr(type(record)(title=""), key)
        if key in {"title", "system"} or value is None or (key in {"E", "axis"} and value == omitted):
            continue
        if key == "charge_to_mass":
            value = float(Fraction(value))
        elif key == "prime":
            value = tuple(float(Fraction(x)) for x in value)
        text = value.replace("_", " ") if isinstance(value, str) else markdown_of(value)
        unit = f"\u202f{units[key]}" if key in units else ""
        numbers.append(text if key == "shape" else f"{_NAMES.get(key, key)} = {text}{unit}")
    return ", ".join(numbers)
