"""Bodies side by side in one field: what surface each has."""

from atlas.report.schema import StrictStruct
from atlas.report.tables.model import RATE, Column, Data, Request, certified, column


def bodies(request: Request) -> Data:
    """Ratio I, kind of the quadric, angle beta and semi-axes of several bodies, (33), (54) to (57)."""
    from atlas.exact.quadric import Quadric

    request.take(StrictStruct)
    made = [Quadric(one.exact, one.components) for one in request.cases]
    values = certified(lambda: [(q.I, q.beta, *q.semi_axes) for q in made], request.digits)
    columns = [column(values_of, request.digits) for values_of in zip(*values, strict=True)]
    names = [one.body_record.title if one.body_record else "" for one in request.cases]
    return Data(
        (
            Column("Body"),
            Column("$I$"),
            Column("Quadric"),
            Column(r"$\beta$", "rad"),
            *(Column(f"$C_{j}$", RATE) for j in (1, 2, 3)),
        ),
        tuple((name, ratio, q.kind, *rest) for name, q, ratio, *rest in zip(names, made, *columns, strict=True)),
        "The bodies in one field: ratio of the moments @(33), kind, angle and semi-axes of the quadric.",
    )
