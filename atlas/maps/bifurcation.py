"""Critical values of the energy-momentum map: theorem-bifurcation, and theorem-top, -steady, -nutation.

Those of H and F of a charged body with three moments, at one b and one c = (M, K), are the values of elliptic motions,
a rational curve of the place z on v^2 = P = prod(z + D/I_i) with v of the sign of -c on the unbounded oval and of both
signs on the bounded one,

    F = -c P'/v - 2 b^2 z - e2 b^2,     2 D H = -2 c v - b^2 z^2 - z (F + e2 b^2),

where K is real: s = sum K_i^2/(z + D/I_i) = -c/v lies between the least and the largest b^2/(z + D/I_i). It is at one
of these bounds where K lies along an axis, in the values of a spin about that axis along the field, and there

    c^2 (z + D/I_i) = b^4 (z + D/I_j) (z + D/I_k).

Such a spin is stable if both roots z are real and above -D/I_i, theorem-splitting; where they are complex its values
stand alone. The map of the symmetric body takes a state to the three conserved numbers (M3, p, h), in units of I2: M3 =
I c3 = I (Omega3 + K3) the momentum along the axis, p = (M, K)/b that along the field, both in 1/time, and h = 2H in
1/time^2, H as in theorem-lie-poisson; b = |B'|. Its critical values are those of the motions at rest in nu = K3/b:

    steady precessions   nu = r with the rate w in Larmor's frame, r (w^2 + A) = M3 w, A = (I-1) b^2
    spins on the axis    nu = ±1, p = ±M3, h = M3^2/I + I b^2
    spins across it      nu = 0, w = 0, p = 0, h = M3^2/I + b^2: the free spin in a transverse field

All functions are pure, in plain floats, and broadcast: they serve figures and certify nothing.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from math import prod
from typing import Any, Literal

import numpy as np
from flint import fmpq_poly
from numpy.typing import NDArray

from atlas.arithmetic.inputs import FloatArray, number, plain, positive, real, vector, vectors
from atlas.arithmetic.lazy import cached_property
from atlas.arithmetic.words import exact
from atlas.bodies.clebsch_integrals import clebsch
from atlas.bodies.inertia import inertia_tensor
from atlas.bodies.integrals import shape_factors
from atlas.errors import DomainError
from atlas.maps.wells import Wells
from atlas.motions.nutation.formula_elliptic import split


@dataclass(frozen=True)
class Conserved:
    """Constants of a symmetric body in units of I2, each a number or an array.

    `M3` is the canonical momentum along the axis and `p` that along the field, in 1/time; `h` is twice the Hamiltonian,
    in 1/time^2.
    """

    M3: Any
    p: Any
    h: Any


def momentum_map(ratio: Any, Omega: Any, K: Any) -> Conserved:
    """Return the constants M3, p, h of states as `Conserved`, theorem-top, in units of I2: 1/time, 1/time, 1/time^2.

    ``ratio`` is I3/I2 or a body; `Omega`, `K` (..., 3) are in the body and in 1/time. Raises DomainError for K = 0.
    """
    I = number(shape_factors(ratio)[0], "The ratio I")
    spin, field = vectors(Omega, "Omega"), vectors(K, "K")
    invariants, b = clebsch(I, spin, field), np.linalg.norm(field, axis=-1)
    if not np.all(b):
        raise DomainError("The momentum along the field needs a field that is not zero.")
    return Conserved(
        plain(I * (spin[..., 2] + field[..., 2])), plain(invariants.MK / b), plain(2 * np.asarray(invariants.H))
    )


def potential(ratio: Any, b: Any, M3: Any, p: Any, nu: Any) -> Any:
    """Return the effective potential V = M3^2/I + b^2 + A nu^2 + (p - M3 nu)^2/(1 - nu^2) of the nutation, theorem-top.

    In units of I2, in 1/time^2, with A = (I-1) b^2; ``ratio`` is I, ``nu`` the cosine between axis and field.
    Motions with the energy h are where V <= h; (dtheta/dt)^2 = h - V. V is infinite at nu = ±1 unless p = ±M3.
    Raises DomainError where |nu| >= 1.
    """
    I, less, _ = shape_factors(ratio)
    b, M3 = real(b, "b"), real(M3, "M3")
    return plain(M3 * M3 / I + b * b + Wells(M3, -less * b * b).potential(p, nu))


Oval = Literal["bounded", "unbounded"]


@dataclass(frozen=True)
class Stretch:
    """Elliptic motions with z from `low` to `high` on one oval, "bounded" or "unbounded": all stable or all unstable.

    z and the cubic P are those of the module; `branch`, 1 or -1, is the sign of v = branch sqrt(P(z)).
    """

    oval: Oval
    branch: int
    low: float
    high: float
    stable: bool


@dataclass(frozen=True)
class Spin:
    """A spin about principal axis 0, 1 or 2 along the field: its constants `F`, `H`, and the `kind` of motions near it.

    F is Clebsch's integral and H the Hamiltonian, kinetic energy plus (M, K); see `atlas.clebsch`.
    """

    axis: int
    F: float
    H: float
    kind: Literal["stable", "saddle", "focus-focus"]


class Bifurcation:
    """The critical values of (F, H) of a body ``inertia`` (I1, I2, I3), all different, at b > 0 and c.

    F is Clebsch's integral and H the Hamiltonian, see `atlas.clebsch`. b = |B'| is in 1/time, and c = (M, K) the
    canonical momentum along the field times b. For c = 0, Neumann's and Weber's case, the curve is a piece of a
    parabola, of the bounded oval, and the `rays` of the plane pendulums. Raises DomainError for moments that no
    body has or of which two are equal.
    """

    def __init__(self, inertia: Any, b: float, c: float) -> None:
        self.inertia = vector(inertia, "inertia")
        inertia_tensor(self.inertia)
        self.b, self.c = positive(b, "b"), number(c, "c")
        if len(set(self.inertia)) < 3:
            raise DomainError(f"Two of the moments {self.inertia.tolist()} are equal: give three different ones.")
        self.D = float(self.inertia.prod())
        self.a = self.D / self.inertia
        self.e2 = float(self.a.sum())

    def values(self, z: FloatArray, branch: int) -> FloatArray:
        """Return F and H as columns, shape (N, 2), of the elliptic motions at z (N,) with v = branch sqrt(P(z)).

        z, v and P are those of the module; ``branch`` is 1 or -1.
        """
        P, slope, _ = self._cubic(z)
        v, square = branch * np.sqrt(P), self.b * self.b
        linear = -self.c * slope / v - 2 * square * z
        H = -(2 * self.c * v + square * z * z + z * linear) / (2 * self.D)
        return np.stack([linear - self.e2 * square, H], axis=-1)

    def splitting(self, z: FloatArray, branch: int) -> FloatArray:
        """Return C/D^2 (N,), in 1/time^2, at places z (N,): positive where the motion is stable, theorem-splitting.

        C is the constant of that theorem, D = I1 I2 I3, and C/D^2 the square of a frequency. ``branch`` is 1 or -1,
        the sign of v.
        """
        v = branch * np.sqrt(self._cubic(z)[0])
        return np.asarray(split(tuple(self.inertia), self.b * self.b, -self.c / v, z))

    def _cubic(self, z: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return P = (z + D/I1)(z + D/I2)(z + D/I3) at places z (N,), its derivative P' (N,), and the factors (N, 3).

        P (N,) that rounding makes negative is 0; D is I1 I2 I3.
        """
        x = np.asarray(z)[..., None] + self.a
        x1, x2, x3 = np.moveaxis(x, -1, 0)
        return (np.maximum(x1 * x2 * x3, 0.0), x1 * x2 + x2 * x3 + x3 * x1, x)

    def _roots(self, axis: int) -> NDArray[np.complex128]:
        """Return the z (2,), perhaps complex, where the curve meets the point (F, H) of a spin about axis 0, 1 or 2."""
        entry, (j, k), fourth = self.a[axis], (self.a[axis - 1], self.a[axis - 2]), self.b**4
        return np.asarray(np.roots([fourth, fourth * (j + k) - self.c**2, fourth * j * k - self.c**2 * entry]), complex)

    @cached_property
    def spins(self) -> tuple[Spin, ...]:
        """The spins along the field about the three principal axes, in their order, as `Spin`."""
        spins = []
        for axis, (I, entry) in enumerate(zip(self.inertia, self.a, strict=True)):
            roots, turn = self._roots(axis), self.c / self.b
            F, H = turn * turn - self.b**2 * entry, (turn * turn / I + I * self.b**2) / 2
            real = bool(np.isreal(roots).all())
            kind = "focus-focus" if not real else "stable" if (roots.real > -entry).all() else "saddle"
            spins.append(Spin(axis, float(F), float(H), kind))  # type: ignore[arg-type]  # one of the three
        return tuple(spins)

    def stretches(self) -> Iterator[Stretch]:
        """Yield the parts of both ovals of v^2 = P(z) on which K is real, as `Stretch`, cut where stability changes.

        For c = 0 the bounded oval alone.
        """
        low, middle, high = np.sort(-self.a)
        if not self.c:
            yield Stretch("bounded", 1, float(low), float(middle), stable=True)
            return
        roots = np.concatenate([self._roots(axis) for axis in range(3)])
        places = np.sort(roots[np.isreal(roots)].real)
        sides: tuple[tuple[Oval, int, list[float]], ...] = (
            ("unbounded", int(-np.sign(self.c)), [high, *places[places > high]]),
            ("bounded", 1, [low, *places[(places > low) & (places < middle)], middle]),
            ("bounded", -1, [low, *places[(places > low) & (places < middle)], middle]),
        )
        for oval, branch, ends in sides:
            for start, stop in pairwise(ends):
                P, _, x = self._cubic(np.array((start + stop) / 2))
                s = -self.c / (branch * float(np.sqrt(P)) * self.b**2)
                if start < stop and (1 / x).min() <= s <= (1 / x).max():
                    borders = [float(start), *self._borders(start, stop, branch), float(stop)]
                    for border, end in pairwise(borders):
                        stable = bool(self.splitting(np.array((border + end) / 2), branch) > 0)
                        yield Stretch(oval, branch, border, end, stable)

    def rays(self) -> Iterator[tuple[int, float, float, bool]]:
        """Yield (axis 0 to 2, first F, last F, is stable) of the plane pendulums about the three axes, for c = 0.

        With K across the axis i and M along it 2 H = F/I_i + (I_j + I_k) b^2, theorem-edge, from the least F on, at
        which the body rests in Larmor's frame. The last F may be infinite. By theorem-splitting the axes of the
        least and the middle moment change stability where z = -D/I_i is a place of the parabola, to which the line
        is a tangent.
        """
        square, order = self.b * self.b, np.argsort(self.inertia)
        for axis, before, after in zip(order, (False, True, True), (True, False, True), strict=True):
            entries = np.delete(self.a, axis)
            start, border = -square * float(entries.max()), square * float(self.a[axis] - entries.sum())
            yield int(axis), start, border, before
            yield int(axis), max(start, border), float("inf"), after

    @cached_property
    def _cusps(self) -> FloatArray:
        """Places z (n,), ascending, where C of `splitting` is zero on a branch: 16 b^4 P^3 = c^2 (P'^2 - 2 P P'')^2.

        P is that of `_cubic`. No root is missed, since all are isolated in balls.
        """
        b, c, *entries = exact(self.b, self.c, *self.a)
        P = prod((fmpq_poly([entry, 1]) for entry in entries), start=fmpq_poly([1]))
        slope = P.derivative()
        equation = 16 * b**4 * P**3 - c * c * (slope * slope - 2 * P * slope.derivative()) ** 2
        return np.sort([float(z.real.mid()) for z, _ in equation.complex_roots() if z.imag == 0])

    def _borders(self, start: float, stop: float, branch: int) -> list[float]:
        """Return a list of the places z between ``start`` and ``stop`` where stability changes: the cusps of the curve.

        ``branch`` is as for `splitting`.
        """
        z = self._cusps[(self._cusps > start) & (self._cusps < stop)]
        P, slope, x = self._cubic(z)
        return [float(x) for x in z[branch * self.c * (slope * slope - 4 * P * x.sum(-1)) > 0]]

    @property
    def rest(self) -> FloatArray | None:
        """Values (F, H), shape (2,), at rest for c > 0, or of Omega = -2 K for c < 0.

        None where |c|/b^2 lies outside the range of the moments of inertia, since no body rests there.
        """
        moment = abs(self.c) / self.b**2
        if not self.inertia.min() <= moment <= self.inertia.max():
            return None
        (value,) = self.values(np.zeros(1), int(-np.sign(self.c)))
        return np.asarray(value)
