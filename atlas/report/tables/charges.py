"""The charge of each body, the field that it makes, and what the field does to a body that it magnetises."""

from math import hypot, inf, isfinite, pi

from atlas.core.bodies.body import SymmetricBody
from atlas.core.bodies.laboratory import diamagnetic_energy
from atlas.core.bodies.units import ELECTRIC_CONSTANT
from atlas.errors import AtlasError
from atlas.report.body_and_field import BodyAndField
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


class DiamagnetismParameters(StrictStruct, frozen=True):
    """The susceptibility of the material, and its density in kg/m^3."""

    susceptibility: float
    density: float


def magnetised(case: BodyAndField, asked: DiamagnetismParameters) -> tuple[str, SymmetricBody, float]:
    """Return the title of a body, the body, and the factor of nu^2 in the energy of its own magnetism."""
    record, body = case.body_record, case.body
    if record is None or body is None or case.physical is None or record.mass is None or record.shape is None:
        raise AtlasError("this table needs bodies with a shape and a mass, and a field with a charge-to-mass ratio.")
    field, volume = float(hypot(*case.physical.B)), record.mass / asked.density
    return record.title, body, diamagnetic_energy(asked.susceptibility, volume, field, record.shape)


def diamagnetism(request: Request) -> Data:
    """Return the factors of nu^2 in the energy of several bodies: by their charge, and by their own magnetism."""
    asked = request.take(DiamagnetismParameters)
    if asked.density <= 0:
        raise AtlasError("this table takes a positive density.")
    rows: list[tuple[str | Number, ...]] = []
    for one in request.cases:
        title, body, own = magnetised(one, asked)
        by_charge = (body.I3 - body.I2) * hypot(*one.components) ** 2 / 2
        rows.append((title, *(Number(f"{value:.1e}" if value else "0") for value in (by_charge, own))))
    return Data(
        (
            Column("Body"),
            Column(r"by the charge, $(I_3-I_2)b^2/2$", "J"),
            Column(r"by the magnetisation, $-\chi_m^2m_0B^2\,\Delta N/2\mu_0\rho$", "J"),
        ),
        tuple(rows),
        r"The factors of $\nu^2$ in the energy of the bodies: by their charge, and by their own magnetisation with "
        rf"a susceptibility $\chi_m$ of {Number(f'{asked.susceptibility:.1e}').tex()} and {asked.density:g} "
        "kg m$^{-3}$.",
        (r"Two digits: $\chi_m$ is known no better, and $\Delta N$ is that of a thin wall.",),
    )
