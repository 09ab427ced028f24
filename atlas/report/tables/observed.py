"""What an experiment would see: bodies with their charge outside, and the swing of bodies that the field magnetises."""

from math import hypot, isfinite, pi, sqrt

from atlas.core.bodies.body import from_shape
from atlas.core.bodies.charge import ChargeMoments
from atlas.report.digits import Number
from atlas.report.schema import StrictStruct
from atlas.report.tables.charges import DiamagnetismParameters, magnetised
from atlas.report.tables.table import RATE, Column, Data, Request


class Coat(StrictStruct, frozen=True):
    """A body by the shapes over which its mass and its charge are spread, with their dimensions in one unit."""

    name: str
    mass: str
    charge: str
    dimensions: dict[str, float]
    charge_dimensions: dict[str, float] | None = None


class CoatParameters(StrictStruct, frozen=True):
    """The bodies, a row each."""

    coats: tuple[Coat, ...]


def coats(request: Request) -> Data:
    """Return what it changes that the charge is spread otherwise than the mass, in units of the body's e/m."""
    rows: list[tuple[str | Number, ...]] = []
    for one in request.take(CoatParameters).coats:
        body = from_shape(one.mass, mass=1.0, **one.dimensions)
        charges = ChargeMoments.shape(one.charge, 1.0, **(one.charge_dimensions or one.dimensions))
        across, along = charges.J2 / body.I2, charges.J3 / body.I3
        A = (along * charges.J3 - across * charges.J2) / body.I2
        values = (body.I3 / body.I2, across, along, across - along, A)
        rows.append((one.name, *(Number(f"{value + 0.0:.3f}") for value in values)))
    return Data(
        (
            Column("Body"),
            *map(Column, ("$I$", r"$g_\perp$", r"$g_\parallel$", r"$\kappa/b$", "$A/b^2$")),
        ),
        tuple(rows),
        r"Bodies whose charge is not spread like their mass, $b=eB/2m_0c$ with the whole charge: gyromagnetic factors "
        r"across and along the axis, and what stands in @theorem-every-top. For one charge-to-mass ratio throughout "
        r"both factors are 1, $\kappa=0$ and $A/b^2=I-1$.",
        ("Three decimals; dimensions in the text.",),
    )


def swings(request: Request) -> Data:
    """Return how bodies at rest in Larmor's frame swing there: by their charge alone, and magnetised too."""
    from atlas.core.motions.top import TopMotion

    asked = request.take(DiamagnetismParameters)
    rows: list[tuple[str | Number, ...]] = []
    for one in request.cases:
        title, body, own = magnetised(one, asked)
        I2, I3, (B2, B3) = body.I2, body.I3, one.components
        b = hypot(B2, B3)
        periods, rates = [], []
        for quadratic in (0.0, 2 * own):
            top = TopMotion((I2, I3), (b * I2, b * I3), (B2, B3), (0.0, -B2, -B3), 0.0, quadratic)
            rates.append(sqrt(abs((I3 - I2) * b * b + quadratic) / I2))
            # a ball is free but for the rounding of its coupling
            periods.append(float(top.period) if rates[-1] else 0.0)
        excess = (rates[1] / rates[0]) ** 2 if rates[0] else 0.0
        values = (2 * pi / b, rates[0], periods[0], rates[1], periods[1], excess)
        rows.append((title, *map(_three, values)))
    return Data(
        (
            Column("Body"),
            Column(r"$2\pi/b$", "s"),
            *(
                Column(f"{head}, {what}", unit)
                for what in ("charge alone", "magnetised")
                for head, unit in ((r"$\sqrt{\lvert A\rvert}$", RATE), ("$T$", "s"))
            ),
            Column(r"quotient of both $\lvert A\rvert$"),
        ),
        tuple(rows),
        r"Bodies that start at rest in Larmor's frame, $\boldsymbol\omega=-\mathbf{B}'$, in the field of the tables: "
        r"Larmor's period, the rate $\sqrt{\lvert A\rvert}$ of small swings of the axis and the period $T$ of its "
        rf"inclination, with the charge alone and with $\chi_m={Number(f'{asked.susceptibility:.1e}').tex()[1:]}.",
        ("Three digits; the ball does not swing.",),
    )


def _three(value: float) -> str | Number:
    """Return a number of three digits, or a dash for what there is not."""
    return Number(f"{value:.2e}") if value and isfinite(value) else "–"
