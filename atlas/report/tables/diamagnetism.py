"""What the field does to a body that it magnetises, beside what it does to the body's charge."""

from math import hypot

from atlas.core.bodies.body import SymmetricBody
from atlas.core.bodies.laboratory import diamagnetic_energy
from atlas.errors import AtlasError
from atlas.report.body_and_field import BodyAndField
from atlas.report.digits import Number
from atlas.report.schema import StrictStruct
from atlas.report.tables.table import Column, Data, Request


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
