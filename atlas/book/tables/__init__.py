"""The computed tables of a report, each by the name of its function."""

from inspect import get_annotations
from typing import Any

from atlas.book.schema import StrictStruct, convert
from atlas.book.tables.bodies import charges, coats, diamagnetism, radiation, sizes, swings
from atlas.book.tables.closed import closed, companions
from atlas.book.tables.elementary import motion, points, quadric, samples, sheet
from atlas.book.tables.families import quantities, roles, targets
from atlas.book.tables.laboratory import beyond_larmor, fits, inferred, levitated, lines
from atlas.book.tables.particle import ball, flight, particle
from atlas.book.tables.properties import FamilyObject, body_and_field, properties
from atlas.book.tables.table import Data, Maker, Request
from atlas.book.tables.tops import asymmetric, critical, elliptic, identified, monodromy, periods, tops
from atlas.errors import unknown

TABLES: dict[str, Maker] = {
    maker.__name__: maker
    for maker in (
        *(body_and_field, charges, diamagnetism, quadric, points, properties, motion, sheet, quantities, samples, ball),
        *(closed, companions, particle, flight, sizes, targets, radiation, coats, swings, tops, monodromy, elliptic),
        *(periods, asymmetric, critical, identified, roles, levitated, lines, inferred, beyond_larmor, fits),
    )
}
"""The tables by name; `atlas.book.keys` adds those that explain the records of a report file."""


def compute(name: str, request: Request) -> Data:
    """Return the computed table `name`, a `Data`, for a request.

    Raises AtlasError for an unknown table, and for a parameter, body or field that it does not take or lacks.
    """
    if name not in TABLES:
        raise unknown("table", name, TABLES)
    arguments = {argument: kind for argument, kind in get_annotations(TABLES[name]).items() if argument != "return"}
    if not arguments.keys() - {"request"}:
        _converted_request(StrictStruct, request)  # no further parameters
    return TABLES[name](**{argument: _converted_request(kind, request) for argument, kind in arguments.items()})


def _converted_request(kind: type, request: Request) -> Any:
    """Return the request itself, the `FamilyObject` of its parameters, or these as a record, whichever `kind` is.

    Raises AtlasError for parameters that the kind does not take.
    """
    if kind is Request:
        return request
    return (
        FamilyObject.from_request(request)
        if kind is FamilyObject
        else convert(dict(request.parameters), kind, "parameters")
    )
