"""The charge of each body, and the electric field that it makes: what bounds the charge that a body can hold."""

from math import inf, isfinite, pi

from atlas.core.bodies.units import ELECTRIC_CONSTANT
from atlas.errors import AtlasError
from atlas.report.digits import Number
from atlas.report.schema import StrictStruct
from atlas.report.tables.table import Column, Data, Request


def charges(request: Request) -> Data:
    """Mass m0, radius r, charge e = mu m0 and the field e/(4 pi eps0 r^2) of several bodies with mass and radius."""
    request.take(StrictStruct)
    rows: list[tuple[str | Number, ...]] = []
    for one in request.cases:
        body = one.body_record
        if body is None or one.physical is None or body.mass is None or body.radius is None:
            raise AtlasError("this table needs bodies with mass and radius, and a field with a charge-to-mass ratio.")
        charge = float(one.physical.mu) * body.mass
        area = 4 * pi * ELECTRIC_CONSTANT * body.radius**2
        field = charge / area if area else inf
        if not isfinite(field):
            raise AtlasError(
                f"the field at {body.radius} m from the charge of {body.title!r} is too large for a float."
            )
        rows.append((body.title, *(Number(f"{value:.1e}") for value in (body.mass, body.radius, charge, field))))
    return Data(
        (
            Column("Body"),
            Column("$m_0$", "kg"),
            Column("$r$", "m"),
            Column(r"$e=\mu m_0$", "C"),
            Column(r"$e/4\pi\varepsilon_0r^2$", "V m$^{-1}$"),
        ),
        tuple(rows),
        "The charges of the bodies, and the field of a point charge as large at the distance of the radius.",
        ("Two digits: the field at the surface is of this order, and depends on the shape.",),
    )
