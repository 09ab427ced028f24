"""The polynomial Q of a symmetric top: (du/dt)^2 = Q(u), u = -nu = -cos theta.

In units of I2, with M = I Omega + k b, p = (M, n), M3 = I Omega3 + k3 nu, kappa = k2 - k3/I, a = M3 kappa + linear and
A = k3^2/I - k2^2 + quadratic,

    (dnu/dt)^2 = (1 - nu^2)(2h - 2 a nu - A nu^2) - (p - M3 nu)^2.

A = 0 leaves a cubic, one of whose roots has gone to infinity, and a = A = 0 a quadratic with two there. The
coefficients are x + y sqrt(n2^2 + n3^2) with rational x, y, so that a multiple root is known exactly, without any
tolerance.
The sign of u is that of Omega3 in `atlas.exact.nutation.quartic`, which is largest where nu is least.
"""

from functools import cached_property
from typing import Any

from flint import acb, arb, fmpq

from atlas.exact.arithmetic.surd import Polynomial, Surd, derivative, evaluated, roots, sign_of, squarefree, trimmed
from atlas.exact.inputs import Real
from atlas.exact.nutation.quartic import Quartic, Root

INFINITY = acb(arb("inf"))


class TopQuartic(Quartic):
    """Q of a top with the moments (1, I), coupling (k2, k3), direction (n2, n3) and angular velocity at t = 0.

    `low` and `high` are the places, among the distinct real roots in ascending order, of those between which u moves;
    they are equal, and name a multiple root, where theta is constant.
    """

    rate: Surd
    polynomial: Polynomial

    def __init__(self, I: fmpq, coupling: Any, direction: Any, omega: Any, potential: Any) -> None:
        (w1, w2, w3), (k2, k3), (n2, n3), (linear, quadratic) = omega, coupling, direction, potential
        N = n2 * n2 + n3 * n3
        size = Surd.root(N)
        self.across, self.nu = size * (n2 / N), size * (n3 / N)
        M2 = self.across * k2 + w2
        self.M3 = self.nu * k3 + I * w3
        self.p = M2 * self.across + self.M3 * self.nu
        self.rate = self.across * w1
        self.kappa = k2 - k3 / I
        self.linear = linear
        self.a = self.M3 * self.kappa + linear
        self.A = k3 * k3 / I - k2 * k2 + quadratic
        p, M3, a, A = self.p, self.M3, self.a, self.nu.of(self.A)
        h2 = M2 * M2 + w1 * w1 + 2 * a * self.nu + self.nu * self.nu * A
        self.polynomial = trimmed([h2 - p * p, 2 * a - 2 * p * M3, -A - h2 - M3 * M3, -2 * a, A])
        self._known: dict[int, list[Root]] = {}

    @property
    def u(self) -> Real:
        """Value of u at t = 0."""
        return (-self.nu).value

    @cached_property
    def slope(self) -> Surd:
        """Q'(u) at t = 0, twice the second derivative of u."""
        return evaluated(derivative(self.polynomial), -self.nu)

    @cached_property
    def is_constant(self) -> bool:
        """Whether theta is constant."""
        return self.rate.is_zero and self.slope.is_zero

    @property
    def leading(self) -> Real:
        """The leading coefficient that is not zero."""
        return self.polynomial[-1].value

    @property
    def bend(self) -> int:
        """Sign of A."""
        return sign_of(self.A)

    @property
    def sense(self) -> int:
        """Sign of du/dt at t = 0."""
        return self.rate.sign

    @property
    def bias(self) -> int:
        """Sign of the second derivative of u at t = 0."""
        return self.slope.sign

    @property
    def curvature(self) -> Real:
        """Q''(u) at t = 0."""
        return evaluated(derivative(derivative(self.polynomial)), -self.nu).value

    def sign_beside(self, pole: int) -> int:
        """Return the sign of p + M3 for `pole` -1 and of p - M3 for +1; 0 exactly where the axis meets that pole."""
        beside: Surd = self.p - self.M3 * pole
        return beside.sign

    @cached_property
    def _factors(self) -> list[tuple[Polynomial, int]]:
        return squarefree(self.polynomial) if len(self.polynomial) > 1 else []

    def _isolated(self) -> list[Root]:
        """Isolate the roots."""
        found = [Root(z, n) for factor, n in self._factors for z in roots(factor)]
        real = [root for root in found if root.is_real]
        real.sort(key=lambda root: root.value.real.mid())
        lost = 5 - len(self.polynomial)
        return real + [root for root in found if root.is_complex] + [Root(INFINITY, lost)] * bool(lost)
