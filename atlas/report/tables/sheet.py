"""The data sheet of a body in a field, or of several side by side: its quadric and one motion."""

from atlas.report.digits import plain
from atlas.report.tables import motion, quadric
from atlas.report.tables.layout import side_by_side, titled
from atlas.report.tables.table import Data, Request


def sheet(request: Request) -> Data:
    """List what the tables `quadric` and `motion` have, for the motion that starts with `omega2`."""
    asked = request.take(motion.Motion)
    columns, rows = side_by_side(
        request,
        [
            [*quadric.quantities(one, request.digits), *motion.quantities(one, asked, request.digits)]
            for one in request.cases
        ],
    )
    return Data(
        columns,
        rows,
        f"Data sheet of {titled(request)}: the quadric of initial data, @(51) to @(57), and the motion that starts "
        rf"with $\omega_2={plain(asked.omega2)}$ s$^{{-1}}$.",
    )
