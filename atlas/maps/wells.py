"""The potential in which the axis of a symmetric top nutates, its wells, rests and cusps, theorem-every-top.

In units of I2, with kappa = k2 - k3/I, a = M3 kappa + linear and A = k3^2/I - k2^2 + quadratic, at given momenta M3
along the axis and p along the constant direction n,

    dtheta^2 = g - V,     V = 2 a nu + A nu^2 + (p - M3 nu)^2/(1 - nu^2),     nu = cos theta.

a = 0, A = (I-1) b^2 is the paper's body, A = 0 Lagrange's heavy top. All is in plain floats and serves figures;
it certifies nothing.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from atlas.arithmetic.inputs import FloatArray, plain, real
from atlas.errors import DomainError
from atlas.motions.nutation.kernel_top import TopMotion

END_TOLERANCE = 2.0**-48
"""Distance, relative to the reach, below which two ends of branches are the same."""


@dataclass(frozen=True, eq=False)
class Branch:
    """Critical values of steady precessions at one M3, in units of I2: arrays (N,).

    `w` is the rate of precession plus k2 in 1/time, `r` the cosine between axis and n, `p` the momentum along n in
    1/time, `g` the energy in 1/time^2, `stable` the squared frequency of nutation in 1/time^2.
    """

    w: FloatArray
    r: FloatArray
    """Cosine between axis and n."""
    p: FloatArray
    g: FloatArray
    stable: FloatArray
    """Nutation frequency squared, theorem-top-nutation, in 1/time^2: negative where the precession is unstable."""


@dataclass(frozen=True)
class Wells:
    """The potentials V of all motions of a top with one momentum `M3` along the axis, in units of I2.

    `M3` is in 1/time, the coefficients `A` and `a` in 1/time^2: V = A nu^2 + 2 a nu + (p - M3 nu)^2/(1 - nu^2).
    """

    M3: float
    A: float
    a: float = 0.0

    @classmethod
    def of(cls, top: TopMotion) -> "Wells":
        """Return the potentials of all motions of the top of this motion with the same M3."""
        (I2, I3), (k2, k3) = top.inertia, top.coupling
        M3 = float(top.invariants()["M3"])
        A = (k3 / I3 * k3 - k2 / I2 * k2 + top.quadratic) / I2
        return cls(M3, A, M3 * (k2 / I2 - k3 / I3) + top.linear / I2)

    @classmethod
    def at(cls, M3: float, I: float, coupling: tuple[float, float], linear: float, quadratic: float) -> "Wells":
        """Return the potentials of a top at this M3 in units of I2, with I = I3/I2 and ``coupling`` (k2/I2, k3/I2).

        ``linear`` and ``quadratic`` are the coefficients of the potential over I2, in 1/time^2.
        """
        k2, k3 = coupling
        return cls(M3, k3 * k3 / I - k2 * k2 + quadratic, M3 * (k2 - k3 / I) + linear)

    def potential(self, p: Any, nu: Any) -> Any:
        """Return the potential V, in 1/time^2, of motions with the momentum p along n at nu = cos theta.

        Motions of the energy g have V <= g, theorem-every-top. ``p`` (1/time) and ``nu`` may be arrays, which
        broadcast. Raises DomainError unless |nu| < 1.
        """
        p, nu = real(p, "p"), real(nu, "nu")
        if (np.abs(nu) >= 1).any():
            raise DomainError("The potential is finite between nu = -1 and 1, both left out.")
        return plain(self.energy(nu, 0.0) + (p - self.M3 * nu) ** 2 / ((1 - nu) * (1 + nu)))

    def energy(self, nu: Any, w: Any) -> Any:
        """Return g = A nu^2 + w^2 (1 - nu^2) + 2 a nu, in 1/time^2, where theta rests at nu = cos theta.

        ``w`` is the rate of the axis' precession plus k2, in rad/time. Both may be arrays, which broadcast.
        """
        return self.A * nu * nu + w * w * (1 - nu) * (1 + nu) + 2 * self.a * nu

    def spin(self, end: int) -> tuple[float, float, float]:
        """Return p, g and D = M3^2 - 4 (end a + A) of the spin about n, nu = end = ±1, theorem-sleeping-top.

        p is in 1/time, g and D are in 1/time^2. The value is of focus-focus type where D < 0, theorem-focus. Raises
        DomainError for another ``end``.
        """
        if end not in {1, -1}:
            raise DomainError(f"The axis lies along the field, end = 1, or against it, end = -1, not {end!r}.")
        return end * self.M3, self.energy(end, 0.0), self.M3 * self.M3 - 4 * (self.A + end * self.a)

    def precessions(self, reach: float, points: int = 400) -> tuple[Branch, ...]:
        """Return the curves p(w), g(w) of critical values as `Branch`es of ``points`` points, theorem-top-precession.

        They are the bifurcation diagram at one M3. The cosine r = (M3 w - a)/(w^2 + A) must lie within [-1, 1];
        each branch is an interval of w where it does, up to |w| = ``reach`` (1/time), and ends on the axis, r = ±1,
        or at the reach. The curves have cusps where `stable` changes sign. Where w^2 = -A and M3 w = a, as of a
        free body that spins about its axis, any cosine goes with this w: such a branch comes last.
        """
        A, a, M3 = self.A, self.a, self.M3
        ends = [-reach, reach, 0.0] if A <= 0 and not M3 and not a else [-reach, reach]
        for sign in (1, -1):
            D = self.spin(sign)[2]
            if D >= 0:
                larger = (sign * M3 + np.copysign(np.sqrt(D), sign * M3)) / 2
                ends += [larger, (A + sign * a) / larger] if larger else [0.0]
        ends = sorted({float(x) for x in ends if abs(x) <= reach})
        # the two ways to an end differ by a rounding
        ends = [x for x, y in zip(ends, [-np.inf, *ends], strict=False) if x - y > END_TOLERANCE * reach]
        branches = []
        for low, high in pairwise(ends):
            middle = (low + high) / 2
            if abs(M3 * middle - a) >= abs(middle * middle + A):
                continue
            # Chebyshev points, dense at the ends, where the curves turn fast; w = 0 and w^2 = -A are no points of them
            w = middle - (high - low) / 2 * np.cos(np.pi * (np.arange(points) + 0.5) / points)
            w = w[(w != 0) & (w * w + A != 0)]
            r = np.clip((M3 * w - a) / (w * w + A), -1.0, 1.0)
            p = w * (1 - r * r) + r * M3
            branches.append(Branch(w, r, p, self.energy(r, w), np.asarray(nutation_squared(A, a, w, r))))
        return (*branches, *self._at_any_cosine(reach, points))

    def _at_any_cosine(self, reach: float, points: int) -> Iterator[Branch]:
        """Yield the `Branch`es of precessions with one rate at every cosine, w^2 = -A and M3 w = a; at most two.

        Each has ``points`` points, and |w| <= ``reach``. One is the free body, A = a = 0, that spins about its axis
        wherever that points: w = 0, p = M3 r, g = 0.
        """
        A, a, M3 = self.A, self.a, self.M3
        r, size = -np.cos(np.pi * (np.arange(points) + 0.5) / points), float(np.sqrt(max(-A, 0.0)))
        for w in () if A > 0 else (-size, size) if size else (0.0,):
            if M3 * w == a and abs(w) <= reach:
                p = w * (1 - r * r) + r * M3
                stable = w * w - A * (3 * r * r - 1) - 2 * a * r + (M3 - r * w) ** 2
                yield Branch(np.full(points, w), r, p, self.energy(r, w), stable)

    def cusps(self, nu: Any, k2: float = 0.0) -> tuple[Any, Any]:
        """Return (p, g) of the motion whose axis stops at nu = cos theta, a cusp of its trace, theorem-cusp.

        p is in 1/time, g in 1/time^2, of the shape of ``nu``. ``k2`` is the coupling across the axis over I2, in
        1/time.
        """
        return self.M3 * nu + k2 * (1 - nu) * (1 + nu), self.energy(nu, k2)


def nutation_squared(A: Any, a: Any, w: Any, r: Any) -> Any:
    """Nutation frequency squared, in 1/time^2, of a steady precession at the cosine r, theorem-top-nutation.

    `w`, not 0, is the rate of precession plus k2, in 1/time; `A` and `a` are those of `Wells`. Negative if unstable.
    """
    w, r = real(w, "The rate w"), real(r, "The cosine r")
    force = a + A * r
    return plain(w * w - A * (3 * r * r - 1) - 2 * a * r + (force / w) ** 2)


def steady_line(M3: float, p: float, nu: FloatArray) -> FloatArray:
    """Return a + A nu (N,), in 1/time^2, for which theta can be constant at nu (N,), theorem-top-precession.

    nu is cos theta. In the plane of (a, A) this is a line. ``M3`` and ``p`` are the momenta along the axis and along n,
    in 1/time.
    """
    w = (p - M3 * nu) / ((1 - nu) * (1 + nu))
    return M3 * w - nu * w * w


def border(M3: float, p: float, nu: FloatArray) -> FloatArray:
    """Return (a, A), shape (N, 2), in 1/time^2, of the potentials in which the rest at nu (N,) is a triple root of q.

    ``M3`` and ``p`` are the momenta along the axis and along n, in 1/time. The curve is the envelope of the lines
    `steady_line`: there a well and the barrier beside it appear or vanish. A < 0 on it.
    """
    w, force = (p - M3 * nu) / ((1 - nu) * (1 + nu)), steady_line(M3, p, nu)
    A = -(w * w - 2 * nu * force + (M3 - nu * w) ** 2) / ((1 - nu) * (1 + nu))
    return np.stack([force - A * nu, A], axis=-1)
