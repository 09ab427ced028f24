"""A real body in SI units: charge that it can hold, radiation, magnetisation, drag, and which of them outweighs.

All parts have one charge-to-mass ratio mu, so the electric dipole moment about the centre of mass is mu times the sum
of m x, which is zero: what turns about the centre radiates by its magnetic dipole mu m/2, m the angular momentum, and
by its electric quadrupole only. Not in the paper, which leaves radiation out.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import asin, atanh, cos, hypot, inf, pi, sin, sqrt
from typing import Any

from atlas.arithmetic.inputs import number, positive
from atlas.bodies.formula_shapes import VOLUMES
from atlas.bodies.units import BOLTZMANN, ELECTRIC_CONSTANT, MAGNETIC_CONSTANT, SPEED_OF_LIGHT
from atlas.errors import DomainError, unknown

DEMAGNETIZATION = {
    "ring": -1 / 4,
    "disk": -1.0,
    "cylindrical_shell": 1 / 2,
    "thin_rod": 1 / 2,
    "sphere": 0.0,
    "spherical_shell": 0.0,
}
"""N_perp - N_par of a shape made of a thin wall or wire, N the demagnetising factors across and along its axis.

A wall has the factor 1 along its normal n and 0 along itself, N = n n^T; a wire 1/2 across itself, N = (1 - t t^T)/2;
these are averaged over the body.
"""

GRAVITY, MOLECULE, ROOM_TEMPERATURE = 9.81, 4.65e-26, 300.0
"""In m/s^2; the mass of a molecule of nitrogen in kg, and the temperature of the gas in K."""
SMALL_SHARE = 0.01
"""Share of the effect that is shown below which another is called negligible."""
NEARLY_ROUND = 0.1
"""Squared eccentricity of a spheroid below which its demagnetizing factors are summed as a power series."""
TERMS = 16
"""Terms of that series, enough for a double: 0.1^16 is a sixteenth of its rounding."""


def greatest_charge(radius: Any, surface_field: float) -> float:
    """Return the charge 4 pi eps0 r^2 E, in C, of a sphere (radius in m) with the field E (V/m) at its surface."""
    r, E = positive(radius, "The radius"), positive(surface_field, "The surface field")
    return 4 * pi * ELECTRIC_CONSTANT * r * r * E


def greatest_ratio(radius: Any, density: Any, surface_field: float) -> float:
    """Charge-to-mass ratio 3 eps0 E/(rho r), in C/kg, of a sphere whose charge makes the field E at its surface.

    `radius` r is in m, `density` rho in kg/m^3, `surface_field` E in V/m.
    """
    r, rho = positive(radius, "The radius"), positive(density, "The density")
    return 3 * ELECTRIC_CONSTANT * positive(surface_field, "The surface field") / (rho * r)


def damping_of_flight(mu: Any, mass: Any, rate: Any) -> float:
    """Return the rate, in 1/s, at which a charge mu m circling with the frequency ``rate`` (rad/s) radiates its energy.

    ``mu`` is in C/kg, ``mass`` m in kg. By Larmor's formula P = e^2 a^2/(6 pi eps0 c^3), over m v^2/2 with a = v omega:
    mu^2 m omega^2/(3 pi eps0 c^3).
    """
    e_squared_over_m = number(mu, "mu") ** 2 * positive(mass, "The mass")
    return e_squared_over_m * number(rate, "The rate") ** 2 / (3 * pi * ELECTRIC_CONSTANT * SPEED_OF_LIGHT**3)


def magnetic_power(mu: Any, momentum: Any, rate: Any) -> float:
    """Return the power, in W, radiated by the dipole mu L/2 of an angular momentum L precessing at ``rate`` (rad/s).

    ``mu`` is in C/kg; ``momentum`` is the part of L across the axis of precession, in J s: P = (mu momentum
    rate^2/2)^2/(6 pi eps0 c^5).
    """
    moment = number(mu, "mu") * number(momentum, "The angular momentum") / 2
    return (moment * number(rate, "The rate") ** 2) ** 2 / (6 * pi * ELECTRIC_CONSTANT * SPEED_OF_LIGHT**5)


def quadrupole_power(mu: Any, moments: tuple[float, float], angle: Any, rate: Any) -> float:
    """Power, in W, of the electric quadrupole of a body with ``moments`` (I2, I3) whose axis runs on a cone.

    `mu` is in C/kg, the moments in kg m^2. The cone has the half-angle ``angle`` in rad and is run with the frequency
    ``rate`` k in rad/s. With D = mu (I2 - I3)(3 n n - 1) the power is |d^3 D/dt^3|^2/(720 pi eps0 c_0^5) =
    mu^2 (I2-I3)^2 k^6 s^2 (16 s^2 + c^2)/(40 pi eps0 c_0^5), with s and c the sine and cosine of the angle and c_0 the
    speed of light. The power of a sphere is 0.
    """
    I2, I3 = moments
    s, c = sin(angle), cos(angle)
    third = number(mu, "mu") * (I2 - I3) * number(rate, "The rate") ** 3 * s
    return third * third * (16 * s * s + c * c) / (40 * pi * ELECTRIC_CONSTANT * SPEED_OF_LIGHT**5)


def diamagnetic_energy(susceptibility: Any, volume: Any, B: Any, shape: str) -> float:
    """Factor of nu^2, in J, in the energy of a body that the field magnetises, nu the cosine of its axis and the field.

    The susceptibility chi, of either sign, is weak and the same everywhere; volume in m^3, B in T. The moment is
    chi V (1 - chi N) B/mu_0, and the energy -(m, B)/2 = const - chi^2 V B^2 (N_perp - N_par) nu^2/(2 mu_0). AtlasError
    for a shape that is not in DEMAGNETIZATION.
    """
    if shape not in DEMAGNETIZATION:
        raise unknown("shape", shape, DEMAGNETIZATION, "of a thin wall")
    strength = (number(susceptibility, "The susceptibility") * number(B, "B")) ** 2 * positive(volume, "The volume")
    return -strength * DEMAGNETIZATION[shape] / (2 * MAGNETIC_CONSTANT)


def anisotropy(susceptibility: Any, volume: Any, demagnetization: Any, gaussian: bool = False) -> float:
    """Return the polarizability along the axis of an ellipsoid less that across it: moments that a unit field induces.

    In A m^2/T, Gaussian in cm^3: V chi/(mu_0 (1 + chi N)) in each direction, with ``volume`` V in m^3,
    ``susceptibility`` chi strong or weak, ``demagnetization`` N along the axis and (1 - N)/2 across it; Gaussian V
    chi/(1 + 4 pi chi N), V in cm^3. DomainError for N outside 0...1 or a chi that no body has there.
    """
    unit, chi = (4 * pi, 4 * pi) if gaussian else (MAGNETIC_CONSTANT, 1.0)
    chi *= number(susceptibility, "The susceptibility")
    N3 = number(demagnetization, "The demagnetizing factor along the axis")
    if not 0 <= N3 <= 1:
        raise DomainError(f"The demagnetizing factor along the axis is in 0 ... 1 (a ball has 1/3), not {N3}.")
    N2 = (1 - N3) / 2
    if min(1 + chi * N3, 1 + chi * N2) <= 0:
        raise DomainError(f"With the susceptibility {susceptibility} and this shape 1 + chi N is not positive.")
    size = positive(volume, "The volume of the magnetised body", "m**3")
    return size * chi * chi * (N2 - N3) / (unit * (1 + chi * N3) * (1 + chi * N2))


def demagnetization(aspect: float) -> float:
    """Return the demagnetizing factor N3 along the axis of a spheroid; ``aspect`` is polar over equatorial semi-axis.

    It is 1/3 for a sphere, and N3 + 2 N2 = 1 with the factor N2 across the axis.
    """
    return (1 - 2 * demagnetization_difference(aspect)) / 3


def demagnetization_difference(aspect: float) -> float:
    """Return N2 - N3 of a spheroid, factors across and along its axis, with the sign of ``aspect`` - 1; 0 for a sphere.

    ``aspect`` is the polar over the equatorial semi-axis.
    """
    x = (aspect - 1) * (aspect + 1) / aspect**2
    if abs(x) < NEARLY_ROUND:  # the closed forms cancel here
        return 3 * sum(x**k / ((2 * k + 1) * (2 * k + 3)) for k in range(1, TERMS))
    if aspect > 1:
        e = sqrt(x)
        N3 = (1 - x) / e**3 * (atanh(e) - e)
    else:
        e = sqrt(1 - aspect**2)
        N3 = (1 - aspect / e * asin(e)) / e**2
    return (1 - 3 * N3) / 2


def gas_drag(radius: float, moment: float) -> float:
    """Return the damping rate of a sphere's spin in thin nitrogen at 300 K, divided by the pressure, in 1/(s Pa).

    `radius` is in m, `moment`, the moment of inertia, in kg m^2.
    """
    speed = sqrt(8 * BOLTZMANN * ROOM_TEMPERATURE / (pi * MOLECULE))
    return 2 * pi / 3 * MOLECULE / (BOLTZMANN * ROOM_TEMPERATURE) * speed * radius**4 / moment


@dataclass(frozen=True)
class Spinning:
    """A charged body of a shape that spins in a field, in SI units.

    `sizes` are the dimensions of the `shape` by name in m, `mass` is in kg, `mu` the charge-to-mass ratio in C/kg,
    `moments` (I2, I3) in kg m^2, `B` is |B| in T, `spin` |Omega| in rad/s. `rate` is the angular frequency of the
    effect of the charge, with which other effects are compared, in rad/s.
    """

    shape: str
    sizes: Mapping[str, float]
    mass: float
    mu: float
    moments: tuple[float, float]
    B: float
    spin: float
    rate: float

    @property
    def radius(self) -> float:
        """Largest distance of a point of the body from its centre, in m."""
        size = self.sizes
        lengths = max(size.get("radius", 0.0), size.get("equatorial", 0.0))
        return max(hypot(lengths, size.get("height", 0.0) / 2), size.get("polar", 0.0))

    @property
    def aspect(self) -> float:
        """Height over width of the spheroid that stands for the body in its magnetisation; 1 without a height."""
        size = self.sizes
        if "polar" in size:
            return size["polar"] / size["equatorial"]
        return size["height"] / (2 * size["radius"]) if "height" in size else 1.0

    @property
    def potential(self) -> float:
        """Factor |I3 - I2| b^2 of nu^2/2 in the energy of the charge in the field, in J; b = |B'| = |mu B|/2."""
        I2, I3 = self.moments
        return abs(I3 - I2) * (self.mu * self.B / 2) ** 2


@dataclass(frozen=True)
class Disturbance:
    """An effect that a motion leaves out, compared with the effect of the charge, which is shown.

    `says` names the effect. `value`, called `letter` (TeX), in `unit`, by the `formula` (TeX), is the body's own
    number, or where `usual` describes usual values in words the number from which on the effect outweighs the
    charge's. `least` and `greatest` are the ratios of the effect to the charge's, at the ends of the usual values.
    """

    says: str
    letter: str
    value: float
    unit: str
    formula: str
    usual: str
    least: float
    greatest: float

    @property
    def outweighs(self) -> bool:
        """Whether the effect is larger than that of the charge for all values that `usual` describes.

        Where `usual` is "", it is larger for the body's own number.
        """
        return self.least > 1

    @property
    def verdict(self) -> str:
        """The effect in words: negligible, a share of the charge's effect, or larger, always or from `value` on.

        Negligible is a share below SMALL_SHARE for all usual values.
        """
        suffix = f" for {self.usual}" if self.usual else ""
        if self.outweighs:
            return f"larger than the effect shown{suffix}"
        if self.greatest < SMALL_SHARE:
            return f"negligible{suffix}"
        if not self.usual:
            return f"{self.greatest:.2g} of the effect shown"
        return f"larger than the effect shown from this value on; usual values are {self.usual}"


def disturbances(body: Spinning) -> Iterator[Disturbance]:
    """Yield a `Disturbance` for each effect that the motion of a charged body in a field leaves out.

    Each is compared with the effect of the charge: magnetism by energies, gas and eddy currents by the rate at which
    they stop a turn, radiation by times. Bodies that are no spheres have the drag and the
    eddy currents of the sphere around them. Effects are left out where their number has no value: without a rate, a
    potential or a spin, and magnetism for a shape that is not solid.
    """
    r, (_, I3) = body.radius, body.moments
    aspect, potential, rate = body.aspect, body.potential, body.rate
    if body.shape in VOLUMES and aspect != 1 and potential:
        from flint import arb

        volume = float(VOLUMES[body.shape](*map(arb, body.sizes.values())))
        difference = abs(demagnetization_difference(aspect))
        chi = sqrt(potential * MAGNETIC_CONSTANT / (volume * difference)) / body.B
        yield _from(
            "magnetisation by the field, of a spheroid as high and wide", r"$\chi$", chi, "",
            r"$\sqrt{\mu_0|I_3-I_2|b^2/V|N_2-N_3|B^2}$", (1e-6, 1e-4), "diamagnets, 1e-6 to 1e-4", 2,
        )  # fmt: skip
    if rate:
        pressure = rate / (2 * pi) / gas_drag(r, I3)
        yield _from(
            "drag of thin nitrogen at 300 K, of a sphere around the body", "$p$", pressure, "Pa",
            r"$3kT\,I_3f/2\pi m\bar{v}r^4$", (1e-9, 1e5), "vacuum of 1e-9 Pa to air", 1,
        )  # fmt: skip
        conductivity = rate / (2 * pi) * I3 * 15 / (2 * pi * r**5 * body.B**2)
        yield _from(
            "eddy currents, of a sphere around the body", r"$\sigma$", conductivity, "S/m",
            r"$15\,I_3f/2\pi r^5B^2$", (1e-16, 6e7), "silica, 1e-16 S/m, to copper, 6e7 S/m", 1,
        )  # fmt: skip
    if potential:
        offset = potential / 2 / (body.mass * GRAVITY)
        yield _from(
            "weight, where the charge holds the body and its centre lies off that of mass", r"$\delta$", offset, "m",
            r"$|I_3-I_2|b^2/2m_0g$", (1e-3 * r, r), "offsets of a thousandth of the body to all of it", 1,
        )  # fmt: skip
    if body.spin:
        power = magnetic_power(body.mu, I3 * body.spin, body.spin)
        power += quadrupole_power(body.mu, body.moments, pi / 2, body.spin)
        time = I3 * body.spin**2 / 2 / power if power else inf
        if rate and time < inf:
            share = 2 * pi / (rate * time)
            yield Disturbance(
                "time in which radiation takes the energy, at least", r"$\tau$", time, "s",
                r"$I_3\Omega^2/2P$", "", share, share,
            )  # fmt: skip
        beta = r * body.spin / SPEED_OF_LIGHT
        yield Disturbance(
            "greatest speed beside that of light", r"$\Omega r/c$", beta, "", r"$\Omega r/c$", "", beta**2, beta**2
        )


def _from(
    says: str, letter: str, value: float, unit: str, formula: str, ends: tuple[float, float], usual: str, power: int
) -> Disturbance:
    """Return the `Disturbance` that outweighs the charge's effect from ``value`` on, and grows as its power ``power``.

    ``ends`` are the least and greatest usual value; the other arguments are the fields of `Disturbance`.
    """
    low, high = ((x / value) ** power for x in ends)
    return Disturbance(says, letter, value, unit, formula, usual, low, high)
