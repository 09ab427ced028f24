"""What a report says about its own making: versions and parameters, never a date or a machine."""

import atlas
from atlas import libraries
from atlas.report.body_and_field import BodiesAndFields, Body, Field
from atlas.report.digits import shown


def versions() -> dict[str, str]:
    """Return the versions of the atlas and of the libraries that it runs on."""
    return {"atlas": atlas.__version__} | libraries.versions()


def parameters(known: BodiesAndFields) -> list[str]:
    """Return each body and field in a line of Markdown."""
    records: list[Body | Field] = [*known.bodies.values(), *known.fields.values()]
    return [f"{record.title}: {_written_out(record)}" for record in records]


_UNITS = {
    "SI": {
        "mass": "kg",
        "charge": "C",
        "B": "T",
        "E": "V/m",
        "charge_to_mass": "C/kg",
        **dict.fromkeys(("radius", "height", "length", "equatorial", "polar"), "m"),
    },
    "Gaussian": {"B": "G", "E": "statV/cm", "charge_to_mass": "statC/g"},
}
_NAMES = {"prime": "B\u2032", "charge_to_mass": "e/m", "ratio": "I", "inertia": "(I2, I3)"}


def _written_out(record: Body | Field) -> str:
    """Write out what a record was given, with units."""
    units = _UNITS[getattr(record, "system", "SI")]
    parts = []
    for key in record.__struct_fields__:
        value, omitted = getattr(record, key), getattr(type(record)(title=""), key)
        if key in {"title", "system"} or value is None or (key in {"E", "axis"} and value == omitted):
            continue
        written = value.replace("_", " ") if isinstance(value, str) else _numbers(value)
        unit = f"\u202f{units[key]}" if key in units else ""
        parts.append(written if key == "shape" else f"{_NAMES.get(key, key)} = {written}{unit}")
    return ", ".join(parts)


def _numbers(value: float | tuple[float, ...]) -> str:
    """Write a number or a vector."""
    if isinstance(value, tuple):
        return f"({', '.join(map(shown, value))})"
    return shown(value)
