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
from itertools import pairwise
from typing import Any

import numpy as np

from atlas.core.clebsch import clebsch
from atlas.core.inputs import FloatArray, number, plain, positive, real, vectors
from atlas.core.integrals import shape_factors
from atlas.errors import DomainError

NEAR = 2.0**-48
"""Part of the reach below which two ends of branches are one."""


@dataclass(frozen=True)
class Conserved:
    """A value of the map, or an array of them: `M3` and `p` in 1/time, `h` in 1/time^2."""

    M3: Any
    p: Any
    h: Any


@dataclass(frozen=True, eq=False)
class Branch:
    """Critical values of steady precessions at one M3: arrays (N,) over their rate `w` in Larmor's frame, 1/time."""

    w: FloatArray
    r: FloatArray
    """Cosine between axis and field."""
    p: FloatArray
    h: FloatArray
    stable: FloatArray
    """Nutation frequency squared, theorem-nutation, in 1/time^2: negative where the precession is unstable."""


def momentum_map(ratio: Any, Omega: Any, K: Any) -> Conserved:
    """Return (M3, p, h) of states, theorem-top; `Omega`, `K` (..., 3) in the body, 1/time, K not 0."""
    I = _ratio(ratio)
    spin, field = vectors(Omega, "Omega"), vectors(K, "K")
    found, b = clebsch(I, spin, field), np.linalg.norm(field, axis=-1)
    if not np.all(b):
        raise DomainError("The momentum along the field needs a field that is not zero.")
    return Conserved(plain(I * (spin[..., 2] + field[..., 2])), plain(found.MK / b), plain(2 * np.asarray(found.H)))


def steady(ratio: Any, b: Any, w: Any, r: Any) -> Conserved:
    """Return (M3, p, h) of the steady precession at nu = r with the rate w in Larmor's frame, theorem-steady.

    M3 = r (w^2 + A)/w, p = w (1 - r^2) + r M3, h = M3^2/I + b^2 + A r^2 + w^2 (1 - r^2). On the hyperbola (71) w is
    k + b and r is B3/b. DomainError where w = 0 or |r| > 1.
    """
    I, A, b = _constants(ratio, b)
    w, r = real(w, "The rate w"), real(r, "The cosine r")
    if (w == 0).any() or (np.abs(r) > 1).any():
        raise DomainError("A steady precession has a rate w that is not 0 and a cosine r between -1 and 1.")
    M3 = r * (w + A / w)
    return Conserved(plain(M3), plain(w * (1 - r * r) + r * M3), plain(_energy(I, A, b, M3, w, r)))


def nutation_squared(ratio: Any, b: Any, w: Any, r: Any) -> Any:
    """Nutation frequency squared w^2 - A (3 r^2 - 1) + A^2 r^2/w^2 of a steady precession, theorem-nutation."""
    _, A, _ = _constants(ratio, b)
    w, r = real(w, "The rate w"), real(r, "The cosine r")
    return plain(w * w - A * (3 * r * r - 1) + (A * r / w) ** 2)


def axis_spin(ratio: Any, b: Any, M3: Any, end: int = 1) -> tuple[Conserved, Any]:
    """Return (M3, p, h) of the spin about the field, nu = end = ±1, and D = M3^2 - 4 A, theorem-axis-stable.

    It is unstable where D < 0, which needs I > 1; sqrt(-D)/2 is the growth rate of its tilt, theorem-axis-escape.
    """
    I, A, b = _constants(ratio, b)
    if end not in {1, -1}:
        raise DomainError(f"The axis lies along the field, end = 1, or against it, end = -1, not {end!r}.")
    M3 = real(M3, "M3")
    return Conserved(plain(M3), plain(end * M3), plain(M3 * M3 / I + I * b * b)), plain(M3 * M3 - 4 * A)


def section(ratio: Any, b: Any, M3: Any, *, reach: float = 3.0, points: int = 400) -> tuple[Branch, ...]:
    """Return the curves p(w), h(w) of critical values at one M3, theorem-steady: the bifurcation diagram.

    The cosine r = M3 w/(w^2 + A) must lie within [-1, 1]; each branch is an interval of w where it does, up to |w| =
    `reach` times b, and ends on the axis, r = ±1, or at `reach`. `points` is the number on each. The curves have cusps
    where `stable` changes sign, theorem-companion-triple.
    """
    I, A, b = _constants(ratio, positive(b, "b"))
    M3, most = number(M3, "M3"), positive(reach, "reach") * b
    ends = [-most, most, 0.0] if A <= 0 and not M3 else [-most, most]
    for sign in (1, -1):
        inside = M3 * M3 - 4 * A
        if inside >= 0:
            larger = (sign * M3 + np.copysign(np.sqrt(inside), sign * M3)) / 2
            ends += [larger, A / larger] if larger else [0.0]
    ends = sorted({float(x) for x in ends if abs(x) <= most})
    # the two ways to an end differ by a rounding
    ends = [x for x, y in zip(ends, [-np.inf, *ends], strict=False) if x - y > NEAR * most]
    branches = []
    for low, high in pairwise(ends):
        middle = (low + high) / 2
        if abs(M3 * middle) >= abs(middle * middle + A):
            continue
        # Chebyshev points, dense at the ends, where the curves turn fast; w = 0 and w^2 = -A are no points of them
        w = middle - (high - low) / 2 * np.cos(np.pi * (np.arange(points) + 0.5) / points)
        w = w[(w != 0) & (w * w + A != 0)]
        r = np.clip(M3 * w / (w * w + A), -1.0, 1.0)
        p, h = w * (1 - r * r) + r * M3, _energy(I, A, b, M3, w, r)
        branches.append(Branch(w, r, p, h, np.asarray(nutation_squared(I, b, w, r))))
    return tuple(branches)


def potential(ratio: Any, b: Any, M3: Any, p: Any, nu: Any) -> Any:
    """Effective potential V = M3^2/I + b^2 + A nu^2 + (p - M3 nu)^2/(1 - nu^2) <= h of the nutation, theorem-top.

    Motions with the energy h are where V <= h; dtheta^2 = h - V. It is infinite at nu = ±1 unless p = ±M3: DomainError
    where |nu| >= 1.
    """
    I, A, b = _constants(ratio, b)
    M3, p, nu = real(M3, "M3"), real(p, "p"), real(nu, "nu")
    if (np.abs(nu) >= 1).any():
        raise DomainError("The potential is finite between nu = -1 and 1, both left out.")
    return plain(M3 * M3 / I + b * b + A * nu * nu + (p - M3 * nu) ** 2 / ((1 - nu) * (1 + nu)))


def _energy(I: Any, A: Any, b: Any, M3: Any, w: Any, r: Any) -> Any:
    """Return h of a steady precession."""
    return M3 * M3 / I + b * b + A * r * r + w * w * (1 - r) * (1 + r)


def _constants(ratio: Any, b: Any) -> tuple[Any, Any, Any]:
    """Return I, A = (I-1) b^2 and b."""
    I, one_less, _ = shape_factors(ratio)
    b = real(b, "b")
    return I, -one_less * b * b, b


def _ratio(ratio: Any) -> float:
    """Return I as one float."""
    return number(shape_factors(ratio)[0], "The ratio I")
