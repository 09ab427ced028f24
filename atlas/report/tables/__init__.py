"""The computed tables of a report, each by the name of its function."""

from collections.abc import Mapping

from atlas.errors import unknown
from atlas.report.tables.bodies import charges, coats, diamagnetism, radiation, sizes, swings
from atlas.report.tables.closed import closed, companions
from atlas.report.tables.elementary import motion, points, quadric, samples, sheet
from atlas.report.tables.families import blocks, layers, quantities, report_keys, roles, targets
from atlas.report.tables.laboratory import beyond_larmor, fits, inferred, levitated, lines
from atlas.report.tables.particle import ball, flight, particle
from atlas.report.tables.properties import body_and_field, properties
from atlas.report.tables.table import Data, Maker, Request
from atlas.report.tables.tops import asymmetric, elliptic, monodromy, periods, tops

TABLES: Mapping[str, Maker] = {
    made.__name__: made
    for made in (
        *(body_and_field, charges, diamagnetism, quadric, points, properties, motion, sheet, quantities, samples, ball),
        *(closed, companions, particle, flight, sizes, targets, radiation, coats, swings, tops, monodromy, elliptic),
        *(periods, asymmetric, roles, layers, blocks, report_keys, levitated, lines, inferred, beyond_larmor),
        fits,
    )
}


def compute(name: str, request: Request) -> Data:
    """Compute a table. Raises AtlasError for a table that there is not, and for a parameter that does not fit it."""
    if name not in TABLES:
        raise unknown("table", name, TABLES)
    return TABLES[name](request)
