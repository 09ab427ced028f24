"""Real bodies: their charge, frequencies and radiation, and the effect of their magnetisation by the field."""

from math import atan2, hypot, inf, isfinite, pi, sqrt
from typing import TYPE_CHECKING, cast

from atlas.bodies.body import SymmetricBody, from_shape
from atlas.bodies.charge import ChargeMoments
from atlas.bodies.laboratory import (
    damping_of_flight,
    diamagnetic_energy,
    greatest_charge,
    greatest_ratio,
    magnetic_power,
    quadrupole_power,
)
from atlas.bodies.units import BOLTZMANN, ELECTRIC_CONSTANT, ELEMENTARY_CHARGE, cyclotron_frequency
from atlas.book.body_and_field import BodyAndField
from atlas.book.digits import Number
from atlas.book.schema import StrictStruct
from atlas.book.tables.table import RATE, Data, Request, heads
from atlas.errors import AtlasError
from atlas.motions.elementary.kernel_hyperbola import Hyperbola

if TYPE_CHECKING:
    from atlas.arithmetic.annotations import ShapeName

RATIO, TILT = 1.5, 2.0
"""I3/I2 of the body and B3/B2 of the field, those of the short solenoid in the oblique field."""
YEAR = 31_557_600.0


class SizeParameters(StrictStruct, frozen=True):
    """Parameters of `sizes` and `radiation`: radii of solid spheres in m, density in kg/m^3, and two fields.

    `surface_field` in V/m is the electric field that the surface bears, `magnet` the magnetic field in T.
    """

    radii: tuple[float, ...]
    density: float
    surface_field: float
    magnet: float


def sizes(setup: SizeParameters) -> Data:
    """Return the table of balls with the largest charge that their surface bears, a row for each radius.

    The balls are solid spheres. The eight columns are r in m, e in C, e over the elementary charge, e/m0 in C/kg,
    Larmor's frequency b in 1/s, its period 2 pi/b in s, the angle in rad of `off_the_field`, and the temperature
    I2 b^2/k_B in K. Raises AtlasError unless there are radii and all parameters are positive.
    """
    _check(setup)
    rows = []
    for r in setup.radii:
        e, mu = greatest_charge(r, setup.surface_field), greatest_ratio(r, setup.density, setup.surface_field)
        b = cyclotron_frequency(mu, setup.magnet) / 2
        values = (r, e, e / ELEMENTARY_CHARGE, mu, b, 2 * pi / b)
        warmth = moment_of_inertia(e / mu, r) * b * b / BOLTZMANN
        rows.append(tuple(map(two, (*values, off_the_field(b), warmth))))
    return Data(
        heads(
            ("$r$", "m"),
            ("$e$", "C"),
            "$e/e_0$",
            (r"$\mu$", "C kg$^{-1}$"),
            ("$b$", RATE),
            (r"$2\pi/b$", "s"),
            (r"$\delta$", "rad"),
            (r"$I_2b^2/k_{\mathrm{B}}$", "K"),
        ),
        tuple(rows),
        f"Balls of {setup.density:g} kg m$^{{-3}}$ with the largest charge $e$ that a surface field of "
        f"{two(setup.surface_field).tex()} V m$^{{-1}}$ allows, in {setup.magnet:g} T: charge, charge-to-mass ratio, "
        r"Larmor's frequency and its period; the angle $\delta$ between $\mathbf{m}$ and $\mathbf{B}$ for "
        f"$k=2\\pi$ s$^{{-1}}$, $I={RATIO:g}$, $\\tau={TILT:g}$; and the temperature at "
        "which heat turns the ball at the rate $b$.",
        ("Two digits of doubles, not proven: the shape of a body changes the first.",),
    )


def radiation(setup: SizeParameters) -> Data:
    """Return the table of times, energy over power, in which the balls of `sizes` radiate their energy, in years.

    The balls are solid spheres. A row has the radius in m, then the times for flight (electric dipole) and for rotation
    (magnetic dipole, electric quadrupole). Raises AtlasError unless there are radii and all parameters are positive.
    """
    _check(setup)
    rows = []
    for r in setup.radii:
        mu = greatest_ratio(r, setup.density, setup.surface_field)
        mass = greatest_charge(r, setup.surface_field) / mu
        larmor = cyclotron_frequency(mu, setup.magnet) / 2
        inertia = moment_of_inertia(mass, r)
        energy = inertia * larmor * larmor / 2
        times = (
            1 / damping_of_flight(mu, mass, 2 * larmor),
            energy / magnetic_power(mu, inertia * larmor, larmor),
            energy / quadrupole_power(mu, (inertia, RATIO * inertia), pi / 2, larmor),
        )
        rows.append((two(r), *(two(time / YEAR) for time in times)))
    return Data(
        heads(
            ("$r$", "m"),
            ("flight, electric dipole", "years"),
            ("rotation, magnetic dipole", "years"),
            ("rotation, electric quadrupole", "years"),
        ),
        tuple(rows),
        "Times in which the bodies of @tab:real-sizes would radiate their energy: of the flight at the cyclotron "
        r"frequency $2b$; of the rotation at the rate $b$, by the moment $\mu\mathbf{m}/2$ that precesses across the "
        rf"field, and, with $I={RATIO:g}$, by the quadrupole of an axis that precesses at a right angle to it.",
        ("Two digits of doubles, not proven.", "Energy over power at the start, with the formulas of the text."),
    )


def moment_of_inertia(mass: float, radius: float) -> float:
    """Return the moment of inertia of a solid sphere, 0.4 mass radius^2, in kg m^2 for kg and m."""
    return 0.4 * mass * radius * radius


def off_the_field(b: float) -> float:
    """Return the angle in [0, pi] rad between m and B in the elementary motion with k = 2 pi 1/s, (67).

    m is the angular momentum and k the rate of precession about B. `b` is Larmor's frequency |B'| in 1/s; the body has
    I = I3/I2 = 1.5, the field B3/B2 = 2, and m/I2 = (0, omega2, I omega3).
    """
    unit = b / hypot(1.0, TILT)
    B2, B3 = unit, TILT * unit
    omega2 = 2 * pi * B2 / b
    third = RATIO * float(Hyperbola(RATIO, (B2, B3)).omega3(omega2))
    return abs(atan2(omega2 * B3 - third * B2, omega2 * B2 + third * B3))


def _check(setup: SizeParameters) -> None:
    """Raise AtlasError unless there are radii and all parameters are positive."""
    if not (setup.radii and min(*setup.radii, setup.density, setup.surface_field, setup.magnet) > 0):
        raise AtlasError("radii, density, surface_field and magnet of this table must be positive.")


def two(value: float) -> Number:
    """Return a number as a `Number` of two digits with a power of ten, such as "1.2e-05"."""
    return Number(f"{value:.1e}")


def charges(request: Request) -> Data:
    """Return the table of bodies with mass and radius: m0, r, charge e = mu m0, and the field e/(4 pi eps0 r^2).

    The units are kg, m, C and V/m, a row for each body. Raises AtlasError for a body without mass or radius, for a
    field without a charge-to-mass ratio, and for a field at the surface beyond the largest float.
    """
    rows: list[tuple[str | Number, ...]] = []
    for case in request.cases:
        body = case.body_record
        if body is None or case.physical is None or body.mass is None or body.radius is None:
            raise AtlasError("this table needs bodies with mass and radius, and a field with a charge-to-mass ratio.")
        charge = float(case.physical.mu) * body.mass
        area = 4 * pi * ELECTRIC_CONSTANT * body.radius**2
        field = charge / area if area else inf
        if not isfinite(field):
            raise AtlasError(
                f"the field at {body.radius} m from the charge of {body.title!r} is too large for a float."
            )
        rows.append((body.title, *(two(value) for value in (body.mass, body.radius, charge, field))))
    return Data(
        heads(
            "Body", ("$m_0$", "kg"), ("$r$", "m"), (r"$e=\mu m_0$", "C"), (r"$e/4\pi\varepsilon_0r^2$", "V m$^{-1}$")
        ),
        tuple(rows),
        "The charges of the bodies, and the field of such a point charge at the distance of the radius.",
        ("Two digits of doubles, not proven: the field at the surface is of this order, and depends on the shape.",),
    )


class DiamagnetismParameters(StrictStruct, frozen=True):
    """Parameters of `diamagnetism`, `swings`: volume susceptibility in SI, either sign, and density in kg/m^3."""

    susceptibility: float
    density: float


def magnetised(case: BodyAndField, setup: DiamagnetismParameters) -> tuple[str, SymmetricBody, float]:
    """Return (title of the body, body, coefficient of nu^2 in the energy of its induced moment, in J).

    nu is the cosine between axis and field, `setup` the material. The volume is mass over density. Raises
    AtlasError for a body without shape or mass, and for a field without a charge-to-mass ratio.
    """
    record, body = case.body_record, case.body
    if record is None or body is None or case.physical is None or record.mass is None or record.shape is None:
        raise AtlasError("this table needs bodies with a shape and a mass, and a field with a charge-to-mass ratio.")
    field, volume = float(hypot(*case.physical.B)), record.mass / setup.density
    return record.title, body, diamagnetic_energy(setup.susceptibility, volume, field, record.shape)


def diamagnetism(request: Request, setup: DiamagnetismParameters) -> Data:
    """Return the table of the coefficients of nu^2 in the energy of each body, in J, nu being cos theta.

    theta is the angle between axis and field. A row has the body's title, the coefficient by its charge,
    (I3 - I2) b^2/2 with Larmor's frequency b = |B'|, and that by its induced moment. Raises AtlasError for a density
    that is not positive, for a body without shape or mass, and for a field without a charge-to-mass ratio.
    """
    if setup.density <= 0:
        raise AtlasError("this table takes a positive density.")
    rows: list[tuple[str | Number, ...]] = []
    for case in request.cases:
        title, body, magnetisation = magnetised(case, setup)
        by_charge = (body.I3 - body.I2) * hypot(*case.components) ** 2 / 2
        rows.append((title, *(Number(f"{value:.1e}" if value else "0") for value in (by_charge, magnetisation))))
    return Data(
        heads(
            "Body",
            (r"by the charge, $(I_3-I_2)b^2/2$", "J"),
            (r"by the magnetisation, $-\chi_m^2m_0B^2\,\Delta N/2\mu_0\rho$", "J"),
        ),
        tuple(rows),
        r"The factors of $\nu^2$ in the energy of the bodies: by their charge, and by their own magnetisation with "
        rf"a susceptibility $\chi_m$ of {Number(f'{setup.susceptibility:.1e}').tex()} and {setup.density:g} "
        "kg m$^{-3}$.",
        (r"Two digits of doubles, not proven: $\chi_m$ is known no better, and $\Delta N$ is that of a thin wall.",),
    )


class Coat(StrictStruct, frozen=True):
    """A body given by the shapes over which its mass and its charge are spread, with dimensions in one unit of length.

    `mass` and `charge` are names of shapes; `charge_dimensions` are those of the charge's shape, None for `dimensions`.
    """

    name: str
    mass: str
    charge: str
    dimensions: dict[str, float]
    charge_dimensions: dict[str, float] | None = None


class CoatParameters(StrictStruct, frozen=True):
    """Parameters of the table `coats`: the bodies, a row each."""

    coats: tuple[Coat, ...]


def coats(setup: CoatParameters) -> Data:
    """Return the table of gyromagnetic factors, in units of e/m, of bodies whose charge is not spread like the mass.

    A row has the name, I = I3/I2, the factors g across and along the axis, and two pure numbers, coefficients of
    the top of theorem-every-top in units of Larmor's frequency b: kappa/b = g_across - g_along of its gyroscopic
    term, and A/b^2 of nu^2/2 in its potential, nu the cosine between axis and field. With one charge-to-mass ratio
    throughout they are 0 and I - 1.
    """
    rows: list[tuple[str | Number, ...]] = []
    for coat in setup.coats:
        body = from_shape(coat.mass, mass=1.0, **coat.dimensions)
        charges = ChargeMoments.shape(
            cast("ShapeName", coat.charge), 1.0, **(coat.charge_dimensions or coat.dimensions)
        )
        I2, I3 = float(body.I2), float(body.I3)
        factor_across, factor_along = charges.J2 / I2, charges.J3 / I3
        A = (factor_along * charges.J3 - factor_across * charges.J2) / I2
        values = (I3 / I2, factor_across, factor_along, factor_across - factor_along, A)
        rows.append((coat.name, *(Number(f"{value + 0.0:.3f}") for value in values)))
    return Data(
        heads("Body", "$I$", r"$g_\perp$", r"$g_\parallel$", r"$\kappa/b$", "$A/b^2$"),
        tuple(rows),
        r"Bodies whose charge is not spread like their mass, $b=eB/2m_0c$ with the whole charge: gyromagnetic factors "
        r"across and along the axis, and the coefficients of @theorem-every-top. For one charge-to-mass ratio "
        r"throughout both factors are 1, $\kappa=0$ and $A/b^2=I-1$.",
        ("Three decimals of doubles, not proven; dimensions in the text.",),
    )


def swings(request: Request, setup: DiamagnetismParameters) -> Data:
    """Return the table of swings of bodies released at rest in Larmor's frame: by charge, and with induced moment.

    A row has the title, Larmor's period in s, then, by the charge alone, the angular rate of small swings of the
    axis in 1/s and the period of its inclination in s, both with the induced moment, and the quotient of the
    squared rates; a dash for zero. Raises the errors of `magnetised`.
    """
    from atlas.motions.nutation.kernel_top import TopMotion

    rows: list[tuple[str | Number, ...]] = []
    for case in request.cases:
        title, body, potential = magnetised(case, setup)
        I2, I3, (B2, B3) = float(body.I2), float(body.I3), case.components
        b = hypot(B2, B3)
        periods, rates = [], []
        for quadratic in (0.0, 2 * potential):
            top = TopMotion((I2, I3), (b * I2, b * I3), (B2, B3), (0.0, -B2, -B3), 0.0, quadratic)
            rates.append(sqrt(abs((I3 - I2) * b * b + quadratic) / I2))
            # a ball is free but for the rounding of its coupling
            periods.append(float(top.period) if rates[-1] else 0.0)
        excess = (rates[1] / rates[0]) ** 2 if rates[0] else 0.0
        values = (2 * pi / b, rates[0], periods[0], rates[1], periods[1], excess)
        rows.append((title, *map(_three, values)))
    return Data(
        heads(
            "Body",
            (r"$2\pi/b$", "s"),
            *(
                (f"{head}, {words}", unit)
                for words in ("charge alone", "magnetised")
                for head, unit in ((r"$\sqrt{\lvert A\rvert}$", RATE), ("$T$", "s"))
            ),
            r"ratio of both $\lvert A\rvert$",
        ),
        tuple(rows),
        r"Bodies that start at rest in Larmor's frame, $\boldsymbol\omega=-\mathbf{B}'$, in the field of the tables: "
        r"Larmor's period, the rate $\sqrt{\lvert A\rvert}$ of small swings of the axis and the period $T$ of its "
        rf"inclination, with the charge alone and with $\chi_m={Number(f'{setup.susceptibility:.1e}').tex()[1:]}.",
        ("Three digits of doubles, not proven; the ball does not swing.",),
    )


def _three(value: float) -> str | Number:
    """Return a `Number` of three digits; a dash for zero and for what is not finite."""
    return Number(f"{value:.2e}") if value and isfinite(value) else "–"
