"""The turning points of many tops in two words, and the sphere on which their axis moves.

In v = nu(0) - nu,

    Q(v) = (n2^2 + 2 n3 v - v^2)(g + 2 c v - A v^2) - (n2 M2 + M3 v)^2,    g = omega1^2 + M2^2,  c = a + A n3,

in units of I2 and n a unit vector; A = 0 leaves a cubic, whose fourth root is not asked for anywhere.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from flint import fmpq

from atlas.core.arithmetic.double_double import DoubleDouble, chosen
from atlas.core.arithmetic.words import words
from atlas.core.inputs import FloatArray
from atlas.core.nutation.roots import Turning, constant, stacked, turning
from atlas.core.nutation.spheres import ONE, Sphere


@dataclass(frozen=True)
class TopRoots(Turning):
    """The turning points of tops, with what else their sphere takes.

    `moving` is where nu is certain to vary, `twisted` where kappa is not zero; `largest` is the largest rate.
    """

    nu: DoubleDouble
    across: DoubleDouble
    M2: DoubleDouble
    M3: DoubleDouble
    spin: DoubleDouble
    k2: DoubleDouble
    omega: tuple[DoubleDouble, DoubleDouble]
    a: DoubleDouble
    A: DoubleDouble
    kappa: DoubleDouble
    twisted: Any
    moving: Any
    largest: FloatArray

    free = np.False_
    """Whether there is no direction."""

    @property
    def tilt(self) -> FloatArray:
        """Cosine and sine of theta at the start, (2, m)."""
        return np.array([self.nu.hi, abs(self.across).hi])


def top_roots(*given: DoubleDouble) -> TopRoots:
    """Return the turning points and the rest, from I2, I3, k2, k3, n2, n3, the three of omega, linear and quadratic."""
    I2, I3, k2, k3, n2, n3, w1, w2, w3, linear, quadratic = given
    twisted = (k3 * I2 - k2 * I3).hi != 0
    I, less, k = I3 / I2, (I2 - I3) / I2, k2 / I2
    size = (n2 * n2 + n3 * n3).sqrt()
    across, nu = n2 / size, n3 / size
    none, turn = constant(0.0, across), k3 / I3
    kappa = chosen(twisted, k - turn, none)
    M2, M3 = w2 + k * across, I * (w3 + chosen(twisted, turn, k) * nu)
    A = _sure(quadratic / I2 + chosen(twisted, I * turn * turn - k * k, -(less * k * k)) + none, given)
    a = linear / I2 + M3 * kappa
    square, c, g = across * across, a + A * nu, w1 * w1 + M2 * M2
    rate = across * w1
    q = (
        rate * rate,
        (nu * g + c * square - across * M2 * M3).scaled(1),
        (nu * c).scaled(2) - g - A * square - M3 * M3,
        -(c + A * nu).scaled(1),
        A,
    )
    longer = abs(nu) + ONE
    shorter = square / longer
    up = nu.hi > 0
    poles = stacked(chosen(up, longer, shorter), -chosen(up, shorter, longer))
    low, high, f = turning(q, poles)
    potential = (np.sqrt(abs(x.hi / I2.hi)) for x in (linear, quadratic))
    rates = np.broadcast_arrays(*(abs(x.hi) for x in (w1, w2, w3, k, turn, rate)), *potential)
    spin = M3 * less / I
    moving = (rate.hi != 0) | ((q[1].hi != 0) & (q[1].rel < 0.5))
    largest = np.max(rates, axis=0)
    return TopRoots(
        rate, low, high, f, poles, nu, across, M2, M3, spin, k, (w1, w2), a, A, kappa, twisted, moving, largest
    )


def _sure(A: DoubleDouble, given: Sequence[DoubleDouble]) -> DoubleDouble:
    """Return A, from exact numbers where it cancels: its sign says how many roots there are."""
    hi, low, rel = (np.array(np.broadcast_to(x, A.hi.shape)) for x in (A.hi, A.low, A.rel))
    for i in np.flatnonzero(~(rel < 0.5)).tolist():
        numbers = (float(np.broadcast_to(x.hi, A.hi.shape)[i]) for x in given)
        I2, I3, k2, k3, *_, quadratic = (fmpq(*x.as_integer_ratio()) for x in numbers)
        (hi[i], low[i]), rel[i] = words((k3 * k3 / I3 - k2 * k2 / I2 + quadratic) / I2, 2), 2.0**-105
    return DoubleDouble(hi, low, rel)


def sphere_of_axis(r: TopRoots) -> Sphere:
    """Return the sphere of n in the body, and of the axis: the torques are (M, n) - nu M3 where nu is -1 and 1."""
    torques = r.across * r.M2 + r.M3 * r.poles
    longer = (abs(r.nu) + ONE).scaled(-1).sqrt()
    shorter = abs(r.across) / longer.scaled(1)
    up, (w1, w2) = r.nu.hi >= 0, (w.hi for w in r.omega)
    there = (r.across.hi == 0) & (torques.hi == 0) & (torques.rel < 0.5)
    whole = np.ones_like(r.rate.hi)
    return Sphere(
        roots=r,
        poles=r.poles,
        torques=torques,
        amplitudes=stacked(chosen(up, longer, shorter), chosen(up, shorter, longer)),
        meets=there & np.array([~up, up]),
        slopes=np.array([1j * w2 - w1, 1j * w2 + w1]),
        frames=stacked(r.spin - r.k2, -(r.spin + r.k2)).scaled(-1),
        azimuth=(np.where(r.across.hi < 0, -1.0, 1.0), 0.0 * whole),
        sizes=(whole, whole),
    )
