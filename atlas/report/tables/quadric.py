"""The quadric of initial data of a body, or of several: its kind and its canonical form, (51) to (57)."""

from atlas.report.body_and_field import BodyAndField
from atlas.report.schema import StrictStruct
from atlas.report.tables.layout import NONE, Quantity, side_by_side, titled
from atlas.report.tables.table import RATE, Data, Request, certified


def quadric(request: Request) -> Data:
    """Ratio I, kind, angle beta, coefficients a2, a3, semi-axes and centre of the quadric, (51) to (57)."""
    request.take(StrictStruct)
    columns, rows = side_by_side(request, [quantities(one, request.digits) for one in request.cases])
    return Data(columns, rows, f"The quadric of initial data of {titled(request)}, @(51), in canonical form.")


def quantities(case: BodyAndField, digits: int) -> list[Quantity]:
    """Return what belongs to the quadric of a body in a field: along or across the axis its kind alone."""
    from flint import arb

    from atlas.exact.surfaces.quadric import Quadric

    q = Quadric(case.exact, case.components)
    first = [
        Quantity("ratio of the moments @(33)", "$I=I_3/I_2$", certified(lambda: q.I, digits)),
        Quantity("quadric @(51)", "", q.kind),
    ]
    if q.B2 == 0 or q.B3 == 0:
        return first
    beta, turn, a2, a3, axes, centre = certified(
        lambda: (q.beta, arb(q.beta) / 2 + arb.pi() / 4, q.a2, q.a3, q.semi_axes, q.centre), digits
    )
    return [
        *first,
        Quantity(r"angle from $\mathbf{e}_2$ to $\mathbb{I}^{-1}\mathbf{B}'$", r"$\beta$", beta, "rad"),
        Quantity(r"angle from $\mathbf{e}_2$ to the axis of $\omega'_2$", r"$\beta/2+\pi/4$", turn, "rad"),
        Quantity("coefficient of @(54)", "$a_2$", a2),
        Quantity("coefficient of @(54)", "$a_3$", a3),
        *(Quantity("semi-axis", f"$C_{j}$", NONE if q.I == 1 else axes[j - 1], RATE) for j in (1, 2, 3)),
        *(Quantity("centre", rf"$\omega_{j}$", centre[j - 1], RATE) for j in (2, 3)),
    ]
