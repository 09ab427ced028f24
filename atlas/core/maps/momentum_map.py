"""The energy-momentum map of the symmetric body and its critical values, theorem-top, theorem-steady, theorem-nutation.

The map takes a state to the three conserved numbers (M3, p, h), in units of I2: M3 = I c3 = I (Omega3 + K3) the
momentum along the axis, p = (M, K)/b that along the field, both in 1/time, and h = 2H in 1/time^2, H as in
theorem-lie-poisson; b = |B'|. Its critical values are those of the motions at rest in nu = K3/b:

    steady precessions   nu = r with the rate w in Larmor's frame, r (w^2 + A) = M3 w, A = (I-1) b^2
    spins on the axis    nu = ±1, p = ±M3, h = M3^2/I + I b^2
    spins across it      nu = 0, w = 0, p = 0, h = M3^2/I + b^2: the free spin in a transverse field

All functions are pure, in plain floats, and broadcast: they serve figures and certify nothing.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from atlas.core.inputs import number, plain, real, vectors
from atlas.core.maps.wells import Wells
from atlas.core.motions.clebsch import clebsch
from atlas.core.motions.integrals import shape_factors
from atlas.errors import DomainError


@dataclass(frozen=True)
class Conserved:
    """A value of the map, or an array of them: `M3` and `p` in 1/time, `h` in 1/time^2."""

    M3: Any
    p: Any
    h: Any


def momentum_map(ratio: Any, Omega: Any, K: Any) -> Conserved:
    """Return (M3, p, h) of states, theorem-top; `Omega`, `K` (..., 3) in the body, 1/time, K not 0."""
    I = _ratio(ratio)
    spin, field = vectors(Omega, "Omega"), vectors(K, "K")
    found, b = clebsch(I, spin, field), np.linalg.norm(field, axis=-1)
    if not np.all(b):
        raise DomainError("The momentum along the field needs a field that is not zero.")
    return Conserved(plain(I * (spin[..., 2] + field[..., 2])), plain(found.MK / b), plain(2 * np.asarray(found.H)))


def potential(ratio: Any, b: Any, M3: Any, p: Any, nu: Any) -> Any:
    """Effective potential V = M3^2/I + b^2 + A nu^2 + (p - M3 nu)^2/(1 - nu^2) <= h of the nutation, theorem-top.

    Motions with the energy h are where V <= h; dtheta^2 = h - V. It is infinite at nu = ±1 unless p = ±M3: DomainError
    where |nu| >= 1.
    """
    I, less, _ = shape_factors(ratio)
    b, M3 = real(b, "b"), real(M3, "M3")
    return plain(M3 * M3 / I + b * b + Wells(M3, -less * b * b).potential(p, nu))


def _ratio(ratio: Any) -> float:
    """Return I as one float."""
    return number(shape_factors(ratio)[0], "The ratio I")
