"""The computed tables of a report, by name; one idea a file."""

from collections.abc import Mapping
from types import MappingProxyType

from atlas.errors import AtlasError
from atlas.report.load import nearest
from atlas.report.tables import ball, bodies, flight, motion, particle, points, quadric, setting
from atlas.report.tables.model import Data, Maker, Request

TABLES: Mapping[str, Maker] = MappingProxyType(
    {
        "setting": setting.setting,
        "bodies": bodies.bodies,
        "quadric": quadric.quadric,
        "points": points.points,
        "motion": motion.motion,
        "samples": motion.samples,
        "ball": ball.ball,
        "particle": particle.particle,
        "flight": flight.flight,
    }
)


def compute(name: str, request: Request) -> Data:
    """Compute a table. Raises AtlasError for a table or a parameter that there is not."""
    if name not in TABLES:
        raise AtlasError(
            f"there is no table {name!r}{nearest(name, list(TABLES))}; the tables are {', '.join(TABLES)}."
        )
    return TABLES[name](request)
