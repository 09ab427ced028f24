"""The polynomial Q of nutation: (du/dt)^2 = Q(u), its roots, and the interval in which u moves.

With u = Omega3, M3 = I c3 and p = (M, K)/b, in units of I2,

    Q(u) = (E' - I u^2)(K^2 - (c3 - u)^2) - (u^2 - (2-I) c3 u + c5)^2,

of which (47) is half the derivative. Its coefficients are rational for rational inputs, so that a multiple root is
known exactly and not to within a tolerance.

Of a top u = -nu = -cos theta, largest where nu is least as Omega3 is. With M = I Omega + k b, p = (M, n), M3 = I Omega3
+ k3 nu, kappa = k2 - k3/I, a = M3 kappa + linear and A = k3^2/I - k2^2 + quadratic,

    (dnu/dt)^2 = (1 - nu^2)(2h - 2 a nu - A nu^2) - (p - M3 nu)^2.

A = 0 leaves a cubic, one of whose roots has gone to infinity, and a = A = 0 a quadratic with two there. The
coefficients are x + y sqrt(n2^2 + n3^2) with rational x, y, so that a multiple root is known exactly too.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from flint import acb, arb, ctx, fmpq

from atlas.arithmetic.certified_inputs import Real
from atlas.arithmetic.certified_surd import Polynomial, Surd, derivative, evaluated, roots, squarefree, trimmed
from atlas.arithmetic.lazy import cached_property
from atlas.arithmetic.numbers import by_precision, workprec
from atlas.bodies.formula_integrals import along_field, integrals, quartic

Vector = tuple[fmpq, fmpq, fmpq]


@dataclass(frozen=True)
class Root:
    """A root of Q as a complex ball `value`, +inf for a root at infinity, and its `multiplicity`."""

    value: acb
    multiplicity: int

    @property
    def is_real(self) -> bool:
        """Whether the root is proven to be real, and finite."""
        return bool(self.value.imag.is_zero()) and not self.is_infinite

    @property
    def is_complex(self) -> bool:
        """Whether the root is one of a complex pair."""
        return not (self.is_real or self.is_infinite)

    @property
    def is_infinite(self) -> bool:
        """Whether the root is at infinity, where the quartic's leading coefficients are zero."""
        return bool(self.value.real > 0) and not self.value.real.is_finite()


INFINITY = acb(arb("inf"))


class Quartic:
    """Q(u) = (dOmega3/dt)^2, u = Omega3, of a body of ratio I, from Omega and K along the body's axes at t = 0.

    `polynomial` is a tuple of `Surd`, the constant first. `E`, `K2`, `c3`, `c5` are the integrals (36) to (41), and
    `rate` is du/dt at t = 0. ``low`` and ``high`` are indices, among the distinct real roots in ascending order, of
    the two between which Omega3 moves. They are equal where Omega3 is constant: at a multiple root or an isolated
    point.
    """

    def __init__(self, I: fmpq, Omega: Vector, K: Vector) -> None:
        (w1, w2, w3), (K1, K2, _) = Omega, K
        self.I, self.u, self.Omega, self.K = I, Surd.rational(w3), Omega, K
        self.E, self.K2, self.c3, self.c5 = conserved = integrals(I, Omega, K)
        self.transverse_square = K1**2 + K2**2
        self.transverse_product = w1 * K1 + w2 * K2
        self.rate = Surd.rational(w1 * K2 - w2 * K1)
        self.momentum = along_field(I, (w1 + K1, w2 + K2, self.c3), K)
        self.polynomial = rational_polynomial(quartic(I, *conserved))

    @property
    def leading(self) -> Real:
        """The leading coefficient of Q, the last one that is not zero, a rational or a ball."""
        return self.polynomial[-1].value

    @property
    def bend(self) -> int:
        """Sign of the coefficient of u^4, 0 for a cubic.

        It is 1 if u becomes infinite at real times, -1 if at imaginary ones.
        """
        return self.polynomial[4].sign if len(self.polynomial) == 5 else 0

    @property
    def sense(self) -> int:
        """Sign of du/dt at t = 0: -1, 0 or 1."""
        return self.rate.sign

    @cached_property
    def slope(self) -> Surd:
        """Q'(u) at t = 0, exactly, in the unit of Q over that of u: twice the second derivative of u."""
        return evaluated(derivative(self.polynomial), self.u)

    @property
    def curvature(self) -> Real:
        """Second derivative Q''(u) at t = 0, a rational or a ball, in the unit of Q over that of u squared."""
        return evaluated(derivative(derivative(self.polynomial)), self.u).value

    @property
    def is_constant(self) -> bool:
        """Whether u, the variable of the quartic, is constant in time."""
        return self.rate.is_zero and self.slope.is_zero

    def sign_beside(self, pole: int) -> int:
        """Return the sign of p + M3 for ``pole`` -1 and of p - M3 for +1; 0 exactly where the axis meets that pole.

        M3 = I c3 is the canonical momentum along the axis, p = (M, K)/b along the field. The pole -1 is theta = pi,
        where nu = K3/b is -1.
        """
        torque: Surd = Surd.root(self.K2) * (-pole * self.I * self.c3) + self.momentum
        return torque.sign

    def roots(self) -> list[Root]:
        """Return the distinct roots as `Root`, at the current working precision: the real ones ascending, then a pair.

        Roots that have gone to infinity, where the leading coefficient is zero, come last.
        """
        return self._roots

    @by_precision
    def _roots(self) -> list[Root]:
        return self._isolated()

    @cached_property
    def _factors(self) -> list[tuple[Polynomial, int]]:
        """Square-free factors of Q as pairs (polynomial, multiplicity of its roots in Q); [] for a constant."""
        return squarefree(self.polynomial) if len(self.polynomial) > 1 else []

    def _isolated(self) -> list[Root]:
        """Return the distinct roots as `Root`, each in a ball of its own, in the order of `roots`."""
        isolated = [Root(z, n) for factor, n in self._factors for z in roots(factor)]
        real = [root for root in isolated if root.is_real]
        real.sort(key=lambda root: root.value.real.mid())
        infinite = 5 - len(self.polynomial)
        return real + [root for root in isolated if root.is_complex] + [Root(INFINITY, infinite)] * bool(infinite)

    @cached_property
    def _interval(self) -> tuple[int, int]:
        """Indices (low, high), among the real roots ascending, of those that enclose u, decided at rising precision."""
        precision = ctx.prec
        while True:
            with workprec(precision):
                u = arb(self.u.value)
                real = [root.value.real for root in self.roots() if root.is_real]
                hits = [i for i, x in enumerate(real) if x.overlaps(u)]
                if self.sense and not hits:
                    high = next(i for i, x in enumerate(real) if x > u)
                    return high - 1, high
                if not self.sense and len(hits) == 1:
                    place, second = hits[0], hits[0] + self.slope.sign
                    return min(place, second), max(place, second)
            precision *= 2

    @property
    def low(self) -> int:
        """Index, among the real roots ascending, of the lower end of u's range."""
        return self._interval[0]

    @property
    def high(self) -> int:
        """Index, among the real roots ascending, of the upper end of u's range."""
        return self._interval[1]


def rational_polynomial(coefficients: Iterable[fmpq]) -> Polynomial:
    """Return a polynomial, a tuple of `Surd` with the constant first, from rational coefficients."""
    return trimmed([Surd.rational(c) for c in coefficients])


class TopQuartic(Quartic):
    """Q of u = -nu of a top, with moments (1, I), coupling (k2, k3), direction (n2, n3), and omega at t = 0.

    ``potential`` is (linear, quadratic); moments, coupling and potential are over I2. `nu` and `transverse` are cos and
    sin of theta at t = 0; `M3` is the canonical momentum along the axis, `p` along n. `kappa` is k2 - k3/I, `a` is
    M3 kappa + linear, `A` is k3^2/I - k2^2 + quadratic, the coefficient of u^4. `low` and `high` are indices, among the
    distinct real roots in ascending order, of the two between which u moves; they are equal, the index of a multiple
    root, where theta is constant.
    """

    def __init__(self, I: fmpq, coupling: Any, direction: Any, omega: Any, potential: Any) -> None:
        (w1, w2, w3), (k2, k3), (n2, n3), (linear, quadratic) = omega, coupling, direction, potential
        N = n2 * n2 + n3 * n3
        size = Surd.root(N)
        self.transverse, self.nu = size * (n2 / N), size * (n3 / N)
        self.u = -self.nu
        M2 = self.transverse * k2 + w2
        self.M3 = self.nu * k3 + I * w3
        self.p = M2 * self.transverse + self.M3 * self.nu
        self.rate = self.transverse * w1
        self.kappa = k2 - k3 / I
        self.linear = linear
        self.a = self.M3 * self.kappa + linear
        self.A = k3 * k3 / I - k2 * k2 + quadratic
        p, M3, a, A = self.p, self.M3, self.a, self.nu.lift(self.A)
        h2 = M2 * M2 + w1 * w1 + 2 * a * self.nu + self.nu * self.nu * A
        self.polynomial = trimmed([h2 - p * p, 2 * a - 2 * p * M3, -A - h2 - M3 * M3, -2 * a, A])

    def sign_beside(self, pole: int) -> int:
        """Return the sign of p + M3 for `pole` -1 and of p - M3 for +1; 0 exactly where the axis meets that pole.

        M3 and p are the canonical momenta along the axis and along n.
        """
        torque: Surd = self.p - self.M3 * pole
        return torque.sign
