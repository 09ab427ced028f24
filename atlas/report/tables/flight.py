"""A point of a flying body: the centre of mass, and the point that turns about it."""

from atlas.report.numbers import plain
from atlas.report.tables.model import CERTIFIED, Column, Data, Request, certified, column, scaled
from atlas.report.tables.particle import exact_particle


def flight(request: Request) -> Data:
    """Positions y_0(t) and y_N(t) = y_0(t) + R(t) x_N(0) at some `times`, in the laboratory frame of figure Lssc."""
    from atlas.exact.elementary import ElementaryMotion
    from atlas.exact.flight import Flight

    omega2, times, point, position, velocity = request.take(
        omega2=None, times=None, point=None, position=(0.0, 0.0, 0.0), velocity=(0.0, 0.0, 0.0)
    )
    setting = request.setting
    made = exact_particle(setting, position, velocity)
    turning = ElementaryMotion(setting.exact, setting.components, omega2)
    whole = Flight(made, turning, point)
    unit = setting.units.length_unit if setting.units else ""
    values = certified(lambda: [(*made.position(t), *whole.position(t)) for t in times], request.digits)
    unit, columns = scaled(list(zip(*values, strict=True)), unit, request.digits)
    return Data(
        (
            Column("$t$", "s"),
            *(Column(f"$y_{{0,{j}}}$", unit) for j in (1, 2, 3)),
            *(Column(f"$y_{{N,{j}}}$", unit) for j in (1, 2, 3)),
        ),
        tuple(zip(column([plain(t) for t in times], request.digits), *columns, strict=True)),
        r"The flight of the centre of mass $\mathbf{y}_0$, @mf10.2, and of the point $\mathbf{y}_N$ of the body.",
        CERTIFIED,
    )
