"""The bodies, fields and sets of parameters of a report file, as they are given."""

from typing import Any, Literal

import msgspec

from atlas.report.schema import Pair, StrictStruct, Vector


class Body(StrictStruct, frozen=True):
    """A body: its ratio I = I3/I2, or both moments, or a shape with its dimensions (metres and kilograms in SI)."""

    title: str
    ratio: float | None = None
    inertia: Pair | None = None
    shape: str | None = None
    mass: float | None = None
    radius: float | None = None
    height: float | None = None
    length: float | None = None
    equatorial: float | None = None
    polar: float | None = None
    charge: float | None = None


class Field(StrictStruct, frozen=True):
    """A field: the components (B2, B3) of B' in 1/s, or B itself with the system of units that it is given in."""

    title: str
    prime: Pair | None = None
    B: Vector | None = None
    E: Vector = (0.0, 0.0, 0.0)
    axis: Vector = (0.0, 0.0, 1.0)
    charge_to_mass: float | None = None
    system: Literal["SI", "Gaussian"] = "SI"


class BodiesAndFields(StrictStruct, frozen=True):
    """The bodies, fields and sets of parameters that the blocks call by name."""

    bodies: dict[str, Body] = msgspec.field(default_factory=dict)
    fields: dict[str, Field] = msgspec.field(default_factory=dict)
    sets: dict[str, dict[str, Any]] = msgspec.field(default_factory=dict)
