"""The Cayley-Klein parameters of a motion as functions of time, and the rotation matrix that they make."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from flint import acb, arb, fmpz

from atlas.exact.inputs import Real, rational
from atlas.exact.nutation.theta import Lattice, Sum, constant, infinite
from atlas.formulas.numbers import Number


@dataclass(frozen=True)
class Parameter:
    """A Cayley-Klein parameter up to the common factor: factor exp(i (rate t + twist s)) sum(s), s within a period.

    Its rate is its ``own`` and that of the frame, ``frame``. ``turn`` is the sense, -1, 0 or 1, in which ``sum`` goes
    half around zero in one period.
    """

    factor: acb
    own: arb
    frame: arb
    twist: arb
    sum: Sum
    turn: int

    @property
    def rate(self) -> arb:
        """The whole rate."""
        return self.own + self.frame

    def at(self, t: Any, s: arb) -> tuple[acb, acb]:
        """Return the parameter and its derivative at time t, which is s in its own period."""
        value, slope = self.sum.at(s)
        phase = self.factor * acb(0, self.rate * t + self.twist * s).exp()
        return phase * value, phase * (slope + acb(0, self.rate + self.twist) * value)


@dataclass(frozen=True)
class Solution:
    """All constants of a motion at one precision: ``origin`` is the time since the turning point at t = 0.

    ``precession`` and ``spin`` are the rates of the frame in which alpha and beta have their own: Larmor's, -b, and
    (1-I) c3; or all there is where theta is constant.
    """

    lattice: Lattice
    origin: arb
    alpha: Parameter
    beta: Parameter
    precession: Real
    spin: Real
    swing: Any = None

    @property
    def period(self) -> arb:
        """Period of nutation, infinite on a separatrix."""
        return 2 * self.lattice.half

    def parameters(self, t: Any, *, turning: bool = True) -> tuple[acb, acb, acb, acb]:
        """Return alpha and beta up to a common factor, and their derivatives by time.

        If not `turning`, these lack the rate at which `swing` turns the body about its own axis.
        """
        t = rational(t, "the time")
        return self._parameters(t, self.in_cell(arb(t) + self.origin), turning=turning)

    def _parameters(self, t: Any, s: arb, *, turning: bool) -> tuple[acb, acb, acb, acb]:
        """Return them at a time, which is s in its own period."""
        a, da = self.alpha.at(t, s)
        b, db = self.beta.at(t, s)
        if self.swing is None:
            return a, b, da, db
        turn = acb(0, (self.swing.at(arb(t), s) - self.swing.at(arb(0), self.origin)) / 2).exp()
        # a square as a product: a power of a ball about zero is no number
        up, down = (x.real * x.real + x.imag * x.imag for x in (a, b))
        rate = acb(0, self.swing.kappa * (up - down) / (up + down) / 2) if turning else acb(0)
        return a * turn, b / turn, (da + rate * a) * turn, (db - rate * b) / turn

    @property
    def alternates(self) -> bool:
        """Whether alpha and beta change their sign with each whole turn that is left out of the phase in a period."""
        if self.lattice.form != "hyperbolic":
            return not (self.alpha.sum.doubled or self.beta.sum.doubled)
        (a, b, *_), (c, d, *_) = (self._parameters(arb(0), s * self.lattice.half, turning=False) for s in (1, -1))
        return bool((a * c.conjugate() + b * d.conjugate()).real < 0)

    def in_cell(self, s: arb) -> arb:
        """Return the time since the turning point, less whole periods where the sums are for one period only."""
        whole = self._whole(s)
        if whole == 0:
            return s
        return arb("nan") if whole is None else s - self.period * whole

    def _whole(self, s: arb) -> fmpz | None:
        """Return how many whole periods are left out, None where that is not known."""
        if self.lattice.form != "hyperbolic" or infinite(self.lattice.half):
            return fmpz(0)
        return ((s / self.period).mid() + 0.5).floor().unique_fmpz()

    def is_flipped(self, t: Any) -> bool:
        """Whether alpha and beta lack a sign at time t, for the whole periods that are left out."""
        whole = self._whole(arb(t) + self.origin)
        return whole is not None and int(whole) % 2 == 1 and self.alternates


def steady(tilt: Sequence[Real], k: Real, phi: Real, half: arb) -> Solution:
    """Return the constants of a motion whose axis keeps its tilt: two turns at the rates k and phi.

    `half` is half the period of an infinitesimal nutation.
    """
    c, s, *_ = tilt
    lattice = Lattice("trigonometric", half, arb("inf"), oblique=False, rate=arb(0))
    alpha, beta = (
        Parameter(acb(x), arb(0), arb(k + sign * phi) / 2, arb(0), constant(lattice), 0)
        for x, sign in ((c, 1), (s, -1))
    )
    return Solution(lattice, arb(0), alpha, beta, k, phi)


def matrix(q: Sequence[Number]) -> list[list[Number]]:
    """Return the rotation matrix of a quaternion that need not be normalised."""
    w, x, y, z = q
    n = w * w + x * x + y * y + z * z
    return [
        [(w * w + x * x - y * y - z * z) / n, 2 * (x * y - w * z) / n, 2 * (x * z + w * y) / n],
        [2 * (x * y + w * z) / n, (w * w - x * x + y * y - z * z) / n, 2 * (y * z - w * x) / n],
        [2 * (x * z - w * y) / n, 2 * (y * z + w * x) / n, (w * w - x * x - y * y + z * z) / n],
    ]
