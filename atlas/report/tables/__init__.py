"""The computed tables of a report, by name; one idea a file."""

from collections.abc import Mapping
from types import MappingProxyType

from atlas.errors import unknown
from atlas.report.tables import (
    ball,
    body_and_field,
    charges,
    closed,
    companions,
    diamagnetism,
    families,
    flight,
    motion,
    observed,
    particle,
    points,
    properties,
    quadric,
    sheet,
    sizes,
    targets,
    three_moments,
    tops,
)
from atlas.report.tables.table import Data, Maker, Request

TABLES: Mapping[str, Maker] = MappingProxyType(
    {
        "body_and_field": body_and_field.body_and_field,
        "charges": charges.charges,
        "diamagnetism": diamagnetism.diamagnetism,
        "quadric": quadric.quadric,
        "points": points.points,
        "properties": properties.properties,
        "motion": motion.motion,
        "sheet": sheet.sheet,
        "quantities": families.quantities,
        "samples": motion.samples,
        "ball": ball.ball,
        "closed": closed.closed,
        "companions": companions.companions,
        "particle": particle.particle,
        "flight": flight.flight,
        "sizes": sizes.sizes,
        "targets": targets.targets,
        "radiation": sizes.radiation,
        "coats": observed.coats,
        "swings": observed.swings,
        "tops": tops.tops,
        "monodromy": tops.loops,
        "elliptic": three_moments.elliptic,
        "periods": three_moments.periods,
        "asymmetric": three_moments.asymmetric,
    }
)


def compute(name: str, request: Request) -> Data:
    """Compute a table. Raises AtlasError for a table that there is not, and for a parameter that does not fit it."""
    if name not in TABLES:
        raise unknown("table", name, TABLES)
    return TABLES[name](request)
