"""Numbers with a unit, of pint or of astropy, as plain numbers in SI.

They are known by their methods: neither library is loaded here. Plain numbers beside them are in SI, and so are the
results: rates in rad/s, times in s.
"""

import reprlib
from typing import Any

import numpy as np

from atlas.errors import AtlasError

RATE, TIME, MASS, LENGTH, CHARGE = "rad/s", "s", "kg", "m", "C"
INERTIA, MOMENTUM, ENERGY = "kg m**2", "kg m**2 / s", "kg m**2 / s**2"
DENSITY = "kg / m**3"
SI_FIELDS = {"mu": "C/kg", "B": "T", "E": "V/m", "length": LENGTH, "velocity": "m/s"}
NO_FIELDS = dict.fromkeys(SI_FIELDS, "")
"""Units of a charge in fields where c = 1, and where it is not: Gaussian ones are given as plain numbers."""
_OTHER = {RATE: "1/s"}
"""Another unit of the same quantity, for a library that counts radians among the dimensions."""
_HERTZ = "hertz", "hz"


def is_quantity(value: Any) -> bool:
    """Whether a value has a unit: a quantity of pint or of astropy."""
    return (hasattr(value, "to_value") and hasattr(value, "unit")) or (
        hasattr(value, "magnitude") and hasattr(value, "units")
    )


def bare(value: Any, name: str, unit: str) -> Any:
    """Return a quantity as a number or array in the SI unit ``unit``; lists by component, other values unchanged.

    ``unit`` is "" for a number without a unit, ``name`` stands in errors. Raises AtlasError for another dimension,
    for a rate in hertz, and, without a unit, for a value with a dimension.
    """
    if isinstance(value, tuple | list):
        has_units = bool(value) and any(is_quantity(component) for component in value[:3])
        return [bare(component, name, unit) for component in value] if has_units else value
    if not is_quantity(value):
        return value
    unit_text = str(getattr(value, "units", None) or getattr(value, "unit", ""))
    if unit == RATE and any(word in unit_text.lower() for word in _HERTZ):
        raise AtlasError(f"{name} is an angular frequency: give it in rad/s, since 1 Hz may mean 2 pi rad/s.")
    for target in (unit, _OTHER.get(unit, unit)):
        try:
            magnitude = value.to_value(target) if hasattr(value, "to_value") else value.to(target).magnitude
        except (TypeError, ValueError, AttributeError):
            continue
        return np.asarray(magnitude) if np.ndim(magnitude) else magnitude
    wanted_unit = f"in {unit.replace('**', '^')}" if unit else "a number without a unit"
    raise AtlasError(f"{name} must be {wanted_unit}, or a unit that converts to it, not {reprlib.repr(str(value))}.")
