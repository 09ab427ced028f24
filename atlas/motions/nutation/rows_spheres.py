"""The two vectors of constant length that move with Omega3, in two words, as in `certified_spheres`.

Their poles are two values of v = Omega3 - omega3 beyond the turning points, one on each side: alpha is zero at
the upper, beta at the lower.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from atlas.arithmetic.double_double import ONE, DoubleDouble, chosen, constant, more_accurate, stacked
from atlas.arithmetic.inputs import FloatArray
from atlas.arithmetic.lazy import cached_property
from atlas.motions.nutation.rows_roots import Roots, TurningPoints


@dataclass(frozen=True)
class Sphere:
    """A vector of constant length that moves with Omega3, of m motions: where it meets the axis, and its start.

    `roots` are the turning points; arrays (2, m) are of alpha, then of beta. `poles` are the values of v = Omega3 -
    omega3 at which the vector would be along the axis, so that alpha (the upper pole) or beta (the lower one) is
    zero; `torques` are those there: -Q is the square of a torque. `amplitudes` are cosine and sine of half the
    polar angle at the start; `meets` is the mask of vectors that start at a pole, and for these `slopes` are twice
    the time derivatives of alpha or beta, whichever is zero. `frames` are the rates of the frame in which both are
    given. `azimuth` are cosine and sine, (m,) each, of the vector's azimuth at the start, from the second axis to
    the first; `sizes` are the factors from the unit sphere to the vector, across the axis and, with a sign, along
    it. Rates are in the scaled unit.
    """

    roots: TurningPoints
    poles: DoubleDouble
    torques: DoubleDouble
    amplitudes: DoubleDouble
    meets: Any
    slopes: Any
    frames: DoubleDouble
    azimuth: tuple[FloatArray, FloatArray]
    sizes: tuple[FloatArray, FloatArray]

    @cached_property
    def far_distance(self) -> DoubleDouble:
        """Distances in v of the poles from the turning point farther away, (2, m), in rad/time of the scaled unit."""
        return stacked(self.poles[0] - self.roots.low, self.roots.high - self.poles[1])

    @cached_property
    def near_distance(self) -> DoubleDouble:
        """Distances in v of the poles from the turning point that is nearer, (2, m), with their sign.

        Where that cancels, since the vector all but meets the pole, they are the square of the torque over -f far.
        """
        f0, f1, f2 = self.roots.f
        plain = stacked(self.poles[0] - self.roots.high, self.roots.low - self.poles[1])
        beyond = -((f2 * self.poles + f1) * self.poles + f0)
        by_torque = self.torques * self.torques / (beyond * self.far_distance)
        return more_accurate(plain, by_torque)


def sphere_of_field(r: Roots) -> Sphere:
    """Return the `Sphere` of K, or of n in the body, for the `Roots` r: the poles are where nu = cos theta is -1 and 1.

    The torques are b [(M, n) - nu M3] there. The frame is Larmor's, with the turn (1-I) c3 about the axis.
    """
    torques = r.n2 * r.M2 + r.I * r.c3 * r.poles
    up, spin = r.n3.hi >= 0, r.less * r.c3
    (w1, w2, _), starts_at_pole = (w.hi for w in r.omega), r.starts_on_field & (torques.hi == 0) & (torques.rel < 0.5)
    length = r.b.hi if r.top is None else np.ones_like(r.b.hi)
    return Sphere(
        roots=r,
        poles=r.poles,
        torques=torques,
        amplitudes=half_angles(r.n3, abs(r.n2), r.b),
        meets=starts_at_pole & np.array([~up, up]),
        slopes=np.array([1j * w2 - w1, 1j * w2 + w1]),
        frames=stacked(spin - r.frame, -(spin + r.frame)).scaled(-1),
        azimuth=(np.where(r.n2.hi < 0, -1.0, 1.0), np.zeros_like(length)),
        sizes=(length, length),
    )


def half_angles(axial: DoubleDouble, flat: DoubleDouble, b: DoubleDouble) -> DoubleDouble:
    """Return cosine and sine, (2, m), of half the angle whose cosine is ``axial``/b and whose sine is ``flat``/b."""
    longer = ((abs(axial) / b + ONE).scaled(-1)).sqrt()
    shorter = flat / (longer * b).scaled(1)
    up = axial.hi >= 0
    return stacked(chosen(up, longer, shorter), chosen(up, shorter, longer))


def sphere_of_velocity(r: Roots) -> Sphere:
    """Return the `Sphere` of (Omega2, Omega1, -sqrt(I) Omega3), of length sqrt(E'), for the `Roots` r.

    Its poles are Omega3 = ± sqrt(E'/I). The torques are P(u) = u^2 - (2-I) c3 u + c5, which starts as omega2 B2;
    there is no frame.
    """
    w1, w2, w3 = r.omega
    short, up = r.I.sqrt(), w3.hi <= 0
    square = w1 * w1 + w2 * w2
    end = (square / r.I + w3 * w3).sqrt()
    longer = end + abs(w3)
    shorter = square / (r.I * longer)
    poles = stacked(chosen(up, longer, shorter), -chosen(up, shorter, longer))
    torques = w2 * r.n2 + poles * (r.I * w3 - (r.less + ONE) * r.n3 + poles)
    twice, flat = end.scaled(1), square.sqrt()
    larger, smaller = (longer / twice).sqrt(), (shorter / twice).sqrt()
    starts_at_pole = (square.hi == 0) & (torques.hi == 0) & (torques.rel < 0.5)
    turn = short.hi * r.n2.hi
    return Sphere(
        roots=r,
        poles=poles,
        torques=torques,
        amplitudes=stacked(chosen(up, larger, smaller), chosen(up, smaller, larger)),
        meets=starts_at_pole & np.array([~up, up]),
        slopes=np.array([-turn, turn]) + 0j,
        frames=constant(0.0, poles),
        azimuth=(np.where(flat.hi == 0, 1.0, (w1 / flat).hi), np.where(flat.hi == 0, 0.0, (w2 / flat).hi)),
        sizes=((short * end).hi, -end.hi),
    )
