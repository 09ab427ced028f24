"""One body's quadric of initial data: its kind and its canonical form, (51) to (57)."""

from atlas.report.schema import StrictStruct
from atlas.report.tables.model import RATE, Column, Data, Request, certified, quantity


def quadric(request: Request) -> Data:
    """Angle beta, coefficients a2, a3, semi-axes and centre of the quadric, (51) to (57)."""
    from flint import arb

    from atlas.exact.quadric import Quadric

    request.take(StrictStruct)
    q = Quadric(request.case.exact, request.case.components)
    if q.B2 == 0 or q.B3 == 0:
        rows = [("kind", "", q.kind, "")]
    else:
        I, beta, turn, a2, a3, axes, centre = certified(
            lambda: (q.I, q.beta, arb(q.beta) / 2 + arb.pi() / 4, q.a2, q.a3, q.semi_axes, q.centre), request.digits
        )
        rows = [
            ("kind", "", q.kind, ""),
            ("ratio of the moments", "$I=I_3/I_2$", I, ""),
            (r"angle from $\mathbf{e}_2$ to $\mathbb{I}^{-1}\mathbf{B}'$", r"$\beta$", beta, "rad"),
            (r"angle from $\mathbf{e}_2$ to the axis of $\omega'_2$", r"$\beta/2+\pi/4$", turn, "rad"),
            ("coefficient of @(54)", "$a_2$", a2, ""),
            ("coefficient of @(54)", "$a_3$", a3, ""),
        ]
        if q.I != 1:
            rows += [("semi-axis", f"$C_{j}$", axes[j - 1], RATE) for j in (1, 2, 3)]
        rows += [("centre", rf"$\omega_{j}$", centre[j - 1], RATE) for j in (2, 3)]
    return Data(
        (Column("Quantity"), Column("Symbol"), Column("Value"), Column("Unit")),
        tuple(
            (
                name,
                symbol,
                value if isinstance(value, str) else quantity(value, request.digits),
                unit or "1" * bool(symbol),
            )
            for name, symbol, value, unit in rows
        ),
        f"The quadric of initial data of the {_title(request)}, @(51), in canonical form.",
    )


def _title(request: Request) -> str:
    """Name the body."""
    record = request.case.body_record
    return record.title if record else "body"
