"""Gaussian and SI units: the one place where the factor c is put in or left out.

The paper is Gaussian: the force is e E + (e/c) [v, B], (89), so every B comes with mu/c, and B' = mu B/(2c), (32). In
SI the force is q E + q [v, B]: there is no c, and B' = mu B/2. The formulas of the paper are those of SI with c = 1,
and so `Field`, `ParticleMotion` take c: 29 979 245 800 cm/s with Gaussian quantities, 1 with those of SI.

|            | Gaussian               | SI                  | one SI unit in Gaussian ones    |
|------------|------------------------|---------------------|---------------------------------|
| mu = e/m   | statC/g                | C/kg                | 2 997 924.58 statC/g            |
| B          | G                      | T                   | 10 000 G                        |
| E          | statV/cm               | V/m                 | 1/29 979.2458 statV/cm          |
| length     | cm                     | m                   | 100 cm                          |
| B' and all | rad/s                  | rad/s               | 1                               |

Every frequency here is an angular one, in rad/s: divide by 2 pi for turns a second. The electromagnetic factors are
those with mu_0 = 4 pi 1e-7 N/A^2, which since 2019 is a measured value, right to 1.6e-10.
"""

import reprlib
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np
from flint import fmpq

from atlas.arithmetic.dimensions import CHARGE, MASS, NO_FIELDS, SI_FIELDS
from atlas.arithmetic.given import exact_number
from atlas.arithmetic.inputs import FloatArray, finite, number, plain, positive, real
from atlas.arithmetic.numbers import nearest
from atlas.errors import AtlasError, DomainError

SPEED_OF_LIGHT = 299_792_458.0
"""m/s, exact."""
ELEMENTARY_CHARGE = 1.602176634e-19
"""C, exact."""
BOLTZMANN = 1.380649e-23
"""J/K, exact."""
ELECTRIC_CONSTANT = 8.8541878188e-12
"""F/m, CODATA 2022."""
MAGNETIC_CONSTANT = 1.25663706127e-6
"""N/A^2, CODATA 2022."""


@dataclass(frozen=True)
class System:
    """A system of units: its name, the constant c of its formulas, and the names of its units.

    `c` is 1 in SI, the speed of light in cm/s in Gaussian units.
    """

    name: str
    c: float
    mu_unit: str
    B_unit: str
    E_unit: str
    length_unit: str


SI = System("SI", 1.0, "C/kg", "T", "V/m", "m")
GAUSSIAN = System("Gaussian", SPEED_OF_LIGHT * 100, "statC/g", "G", "statV/cm", "cm")


def system(name: str | System) -> System:
    """Return the system of units called "SI" or "Gaussian", in any case of letters; a `System` unchanged.

    Raises AtlasError for any other name.
    """
    if isinstance(name, System):
        return name
    for candidate in (SI, GAUSSIAN):
        if isinstance(name, str) and name.casefold() == candidate.name.casefold():
            return candidate
    text = reprlib.repr(name) if isinstance(name, str) else type(name).__name__
    raise AtlasError(f"Units are 'SI' or 'Gaussian', not {text}.")


def charge_to_mass(charge: Any, mass: Any) -> float:
    """Return the charge-to-mass ratio mu = e/m, (89), of either sign, in units of charge over mass.

    Quantities of pint or astropy are converted to SI. Raises DomainError unless ``mass`` is positive.
    """
    return number(charge, "The charge", CHARGE) / positive(mass, "The mass", MASS)


def ratio_of(mu: Any, charge: Any, mass: Any) -> Any:
    """Return ``mu`` as given, or charge over mass as a Fraction.

    Raises AtlasError unless either mu, or charge and mass, is given; DomainError for a mass that is not positive.
    """
    if (mu is None) == (charge is None and mass is None) or (mu is None and None in (charge, mass)):
        raise AtlasError("A field takes mu, or charge and mass, for the charge-to-mass ratio.")
    if mu is not None:
        return mu
    return Fraction(number(charge, "The charge", CHARGE)) / Fraction(positive(mass, "The mass", MASS))


def larmor_field(mu: Any, B: Any, units: str | System = SI) -> Any:
    """Return the vector B' = mu B/(2c), (32), in rad/s; in SI without c.

    ``mu`` and ``B`` (any shape) are in the units of that system; the result has the shape of B. |B'| is Larmor's
    frequency (27); for mu < 0 the vector B' is opposite to B.
    """
    c = system(units).c
    unit = SI_FIELDS if c == 1 else NO_FIELDS
    B = real(B, "B", unit["B"])
    components = [float(exact_number(x)) for x in prime(number(mu, "mu", unit["mu"]), B, c)]
    return plain(np.reshape(components, B.shape))


def cyclotron_frequency(mu: Any, B: Any, units: str | System = SI) -> Any:
    """Return the frequency omega = mu |B|/c of (97) in rad/s, with the sign of mu; twice Larmor's.

    ``B`` is the strength of the field, a number or an array; ``mu`` and ``B`` are in ``units``.
    """
    return 2 * larmor_field(mu, B, units)


def prime(mu: Any, B: FloatArray, c: float) -> list[Fraction]:
    """Return the components of the vector B' = mu B/(2c), (32), as exact fractions, a flat list, of checked numbers.

    Raises DomainError for one that is too large or too small for a float.
    """
    factor = Fraction(mu) / (2 * Fraction(c))
    components = [factor * Fraction(b) for b in B.ravel().tolist()]
    rounded = np.array([nearest(fmpq(x.numerator, x.denominator)) for x in components])
    finite(rounded, "B' = mu B/(2c)")
    if mu != 0 and ((rounded == 0) != (B.ravel() == 0)).any():
        raise DomainError("B' = mu B/(2c) is too small for a float: choose a larger unit of time.")
    return components
