"""What was given: a body and a field in the user's units, and what the formulas take of them."""

from collections.abc import Iterator
from typing import Any

from atlas.errors import AtlasError
from atlas.report.body_and_field import BodyAndField
from atlas.report.digits import Number
from atlas.report.schema import StrictStruct
from atlas.report.tables.table import RATE, Column, Data, Request, certified, quantity

_WORDS = {
    "mass": ("mass", "$m_0$", "kg"),
    "radius": ("radius", "$r$", "m"),
    "height": ("height", "$h$", "m"),
    "length": ("length", "$l$", "m"),
    "equatorial": ("equatorial semi-axis", "$a$", "m"),
    "polar": ("polar semi-axis", "$c$", "m"),
    "charge": ("charge", "$e$", "C"),
}


def body_and_field(request: Request) -> Data:
    """Dimensions, mass and charge, fields, and from them I, the moments, mu and B', (32) and (33)."""
    request.take(StrictStruct)
    one = request.case
    body, field = one.body_record, one.field_record
    if body is None or field is None:
        raise AtlasError("this table needs a body and a field.")
    rows = [(words, symbol, Number.given(value), unit, "given") for words, symbol, value, unit in _given(one)]
    rows += [
        (words, symbol, quantity(value, request.digits), unit, "follows")
        for words, symbol, value, unit in _follows(one, request.digits)
    ]
    return Data(
        (Column("Quantity"), Column("Symbol"), Column("Value"), Column("Unit"), Column("")),
        tuple(rows),
        f"The {body.title} in the {field.title}, and what follows from them by @(32) and @(33).",
        (
            "The moments and $I$ are proven to the last digit printed.",
            r"$\mu$ and $\mathbf{B}'$ are rounded once, to the nearest double.",
            "All further numbers of this report take that double as exact.",
        ),
    )


def _given(one: BodyAndField) -> Iterator[tuple[str, str, float, str]]:
    """Go through what the user gave."""
    for key, (words, symbol, unit) in _WORDS.items():
        value = getattr(one.body_record, key)
        if value is not None:
            yield words, symbol, value, unit
    if one.physical is not None and one.units is not None:
        for words, letter, vector, unit in (
            ("magnetic field", "B", one.physical.B, one.units.B_unit),
            ("electric field", "E", one.physical.E, one.units.E_unit),
        ):
            for j, component in enumerate(vector, 1):
                yield words if j == 1 else "", f"${letter}_{j}$", float(component), unit


def _follows(one: BodyAndField, digits: int) -> Iterator[tuple[str, str, Any, str]]:
    """Go through what the formulas take of it."""
    from atlas.exact.bodies.body import ratio_of

    exact = one.exact
    if one.body_record is not None and one.body_record.shape:
        I2, I3 = certified(lambda: (exact.I2, exact.I3), digits)
        yield "moment of inertia", "$I_2$", I2, "kg m$^2$"
        yield "", "$I_3$", I3, "kg m$^2$"
    yield "ratio of the moments", "$I=I_3/I_2$", certified(lambda: ratio_of(exact), digits), "1"
    if one.physical is not None and one.units is not None:
        yield "charge-to-mass ratio", r"$\mu$", one.physical.mu, one.units.mu_unit
    B2, B3 = one.components
    yield "field as a frequency", "$B'_2$", B2, RATE
    yield "", "$B'_3$", B3, RATE
