"""A point of a flying body: the centre of mass, and the point that turns about it."""

from atlas.report.digits import Number
from atlas.report.schema import StrictStruct, Vector
from atlas.report.tables.particle import exact_particle
from atlas.report.tables.table import Column, Data, Request, certified, scaled


class FlightParameters(StrictStruct, frozen=True):
    """The elementary motion by its omega2, times in s, the point at t = 0, the start of the centre of mass."""

    omega2: float
    times: tuple[float, ...]
    point: Vector
    position: Vector = (0.0, 0.0, 0.0)
    velocity: Vector = (0.0, 0.0, 0.0)


def flight(request: Request) -> Data:
    """Positions y_0(t) and y_N(t) = y_0(t) + R(t) x_N(0) at some `times`, in the laboratory frame of figure Lssc."""
    from atlas.exact.motions.elementary import ElementaryMotion
    from atlas.exact.motions.particle import Flight

    asked, case = request.take(FlightParameters), request.case
    made = exact_particle(case, asked.position, asked.velocity)
    turning = ElementaryMotion(case.exact, case.components, asked.omega2)
    whole = Flight(made, turning, asked.point)
    unit = case.units.length_unit if case.units else ""
    values = certified(lambda: [(*made.position(t), *whole.position(t)) for t in asked.times], request.digits)
    unit, columns = scaled(list(zip(*values, strict=True)), unit, request.digits)
    return Data(
        (
            Column("$t$", "s"),
            *(Column(f"$y_{{0,{j}}}$", unit) for j in (1, 2, 3)),
            *(Column(f"$y_{{N,{j}}}$", unit) for j in (1, 2, 3)),
        ),
        tuple(zip(map(Number.given, asked.times), *columns, strict=True)),
        r"The flight of the centre of mass $\mathbf{y}_0$, @(101), and of the point $\mathbf{y}_N$ of the body.",
    )
