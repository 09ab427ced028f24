"""The quadric and the hyperbola of every symmetric top, theorem-top-quadric: exact but for square roots."""

from typing import Any

from flint import arb, fmpq

from atlas.arithmetic.certified_inputs import Real, rational, rationals
from atlas.arithmetic.certified_surd import Polynomial, Surd, divided, evaluated, gcd, roots, squarefree, trimmed
from atlas.arithmetic.numbers import root
from atlas.bodies.formula_domain import check_D, check_direction, check_moments
from atlas.errors import DomainError
from atlas.surfaces import formula_top as top
from atlas.surfaces.certified import Quadric


def inputs_of_top(
    inertia: Any, coupling: Any, direction: Any, linear: Any, quadratic: Any
) -> tuple[fmpq, tuple[fmpq, ...], tuple[fmpq, ...], tuple[fmpq, ...]]:
    """Return (I3/I2, coupling (k2, k3)/I2, direction as given, potential (linear, quadratic)/I2), as rationals.

    Raises DomainError for moments that no body has and for a direction that is zero.
    """
    I2, I3 = rationals(inertia, "inertia (I2, I3)", 2)
    k2, k3 = rationals(coupling, "coupling (k2, k3)", 2)
    n = rationals(direction, "direction (n2, n3)", 2)
    check_moments(I2, I3)
    check_direction(*n)
    return I3 / I2, (k2 / I2, k3 / I2), n, (rational(linear, "linear") / I2, rational(quadratic, "quadratic") / I2)


def constants(
    inertia: Any, coupling: Any, direction: Any, linear: Any, quadratic: Any
) -> tuple[fmpq, fmpq, fmpq, Surd, Surd, fmpq, fmpq]:
    """Return (I, k2, k3, n2, n3, a0, A0) in units of I2, n of length 1, for the functions of `formula_top`.

    n2 and n3 are `Surd`s, the others rationals; the arguments are those of `inputs_of_top`.
    """
    I, (k2, k3), (n2, n3), potential = inputs_of_top(inertia, coupling, direction, linear, quadratic)
    N = n2 * n2 + n3 * n3
    size = Surd.root(N)
    return I, k2, k3, size * (n2 / N), size * (n3 / N), *potential


class TopQuadric(Quadric):
    """The surface n3 (omega1^2 + w^2) - I n2 w v = -n2^2 n3 D of starts at which nu'' = 0, nu = cos theta.

    w, v and D are those of `atlas.surfaces.kernel.TopQuadric`, and so are the arguments, taken as exact.
    """

    def __init__(self, inertia: Any, coupling: Any, direction: Any, linear: Any = 0, quadratic: Any = 0) -> None:
        self.I, _, (self.B2, self.B3), _ = inputs_of_top(inertia, coupling, direction, linear, quadratic)
        self.top = constants(inertia, coupling, direction, linear, quadratic)

    @property
    def _excess(self) -> Surd:
        """Product n3 D, a `Surd`; its sign with that of n3 tells the kind."""
        return self.top[3].lift(top.excess(*self.top))

    @property
    def kind(self) -> str:
        """Type of the surface by the sign of D, decided exactly; see `atlas.surfaces.kernel.TopQuadric.kind`."""
        if self.B2 == 0:
            return "line"
        sign = self._excess.sign
        if self.B3 == 0:
            return "hyperbolic cylinder" if sign else "plane pair"
        if sign == 0:
            return "cone"
        return "two-sheet hyperboloid" if sign == self.top[4].sign else "one-sheet hyperboloid"

    @property
    def D(self) -> Real:
        """D = A + kappa^2 + a0/n3 over I2, in 1/time^2, which is (I - 1) b^2 for the paper's body.

        Raises DomainError for n3 = 0 with a linear potential, where D is infinite.
        """
        I, k2, k3, n2, n3, a0, A0 = self.top
        check_D(self.B3, a0)
        unit = n3.lift(1)
        return (unit.lift(top.excess(I, k2, k3, n2, unit, a0, A0)) if n3.is_zero else self._excess / n3).value

    @property
    def semi_axes(self) -> tuple[Real, Real, Real]:
        """Semi-axes C1, C2, C3 in rad/time, the roots of |D| n2^2 (1, |a2|, |a3|); zeros for n2 = 0.

        Raises DomainError where D is infinite.
        """
        if self.B2 == 0:
            return fmpq(0), fmpq(0), fmpq(0)
        square = abs(self.D) * (self.top[3] * self.top[3]).value
        return root(square), root(square * abs(self.a2)), root(square * abs(self.a3))

    @property
    def centre(self) -> tuple[Real, Real, Real]:
        """Centre (omega1, omega2, omega3) of the quadric, where w = v = 0, in rad/time."""
        second, third = top.centre(*self.top)
        return fmpq(0), second.value, third.value

    def residual(self, omega: Any) -> Real:
        """Return -nu'' at t = 0, in 1/time^2, for a start with omega, three numbers in rad/time; 0 on the surface only.

        Floats are taken as exact. Raises AtlasError for anything but three finite numbers.
        """
        residual: Surd = top.residual(*self.top, *map(self.top[3].lift, rationals(omega, "omega", 3)))
        return residual.value

    def canonical(self, omega: Any) -> list[Real]:
        """Return the three coordinates, in rad/time, of a point ``omega`` (3,) along the axes (53), from the centre."""
        shifted = [x - c for x, c in zip(rationals(omega, "omega", 3), self.centre, strict=True)]
        return [sum((a * x for a, x in zip(axis, shifted, strict=True)), fmpq(0)) for axis in self.axes]


class TopHyperbola:
    """The curve omega1 = 0 of `TopQuadric`: its points are steady precessions, theorem-top-hyperbola.

    The arguments are those of `TopQuadric`. Raises DomainError for n2 = 0; its methods raise DomainError at the pole.
    """

    def __init__(self, inertia: Any, coupling: Any, direction: Any, linear: Any = 0, quadratic: Any = 0) -> None:
        self.top = constants(inertia, coupling, direction, linear, quadratic)
        if self.top[3].is_zero:
            raise DomainError("With n2 = 0 the axis is along n: a spin with omega2 = 0, and omega3 is free.")

    @property
    def pole(self) -> Real:
        """Pole of the curve: the omega2 at which w = 0, in rad/time."""
        second: Surd = top.centre(*self.top)[0]
        return second.value

    def omega3(self, omega2: Any) -> Real:
        """Return omega3 on the curve at omega2, both in rad/time; a rational or a ball. DomainError at the pole."""
        omega3: Surd = top.omega3(*self.top, self._off_the_pole(omega2))
        return omega3.value

    def frequencies(self, omega2: Any) -> tuple[Real, Real]:
        """Return the rates (k of precession about n, phi of the turn about the body's axis) at omega2, in rad/time."""
        k, phi = top.frequencies(*self.top, self._off_the_pole(omega2))
        return k.value, phi.value

    def stability(self, omega2: Any) -> Real:
        """Return the square of the frequency of small nutations at omega2, in 1/time^2; negative if unstable."""
        square: Surd = top.stability(*self.top, self._off_the_pole(omega2))
        return square.value

    def stable(self, omega2: Any) -> bool:
        """Return whether the motion at omega2 (rad/time) is stable against nutation, decided exactly.

        At zero frequency `_holds` decides. Raises DomainError at the pole.
        """
        w2 = self._off_the_pole(omega2)
        squared: Surd = top.stability(*self.top, w2)
        return squared.sign > 0 or (squared.is_zero and self._holds(w2))

    def _holds(self, omega2: Surd) -> bool:
        """Whether a motion whose nutation frequency is zero is stable: at a fourfold root of the quartic with A < 0."""
        _, k2, _, n2, *_ = self.top
        return bool(evaluated(self._fourfold, omega2 / n2 + k2).is_zero and self._leading < 0)

    @property
    def _leading(self) -> fmpq:
        """Leading coefficient A = A0 + k3^2/I - k2^2 of the top's quartic, over I2, in 1/time^2."""
        I, k2, k3, _, _, _, A0 = self.top
        return A0 + k3 * k3 / I - k2 * k2

    @property
    def _fourfold(self) -> Polynomial:
        """The polynomial (a + 2 A n3) x in u, with x = u - kappa, u = omega2/n2 + k2 and a = M3 kappa + a0.

        M3 = (n3 u^2 + a0 + A n3)/x is the momentum along the axis on the curve; A, kappa and a0 are as in
        `TopQuadric`, in units of I2. The coefficients are at most three `Surd`s, the constant first.
        Where the `stability` is 0, off the pole x = 0, it vanishes just where the motion's quartic has a fourfold
        root.
        """
        I, k2, k3, _, n3, a0, _ = self.top
        kappa, A = k2 - k3 / I, self._leading
        linear = n3 * (2 * A) + a0
        return trimmed([n3 * (-kappa * A), linear, n3 * kappa])

    @property
    def unstable_bands(self) -> list[tuple[Real, Real]]:
        """Intervals of omega2 in rad/time, ascending, with unstable motions: a list of pairs of balls.

        The ends are roots of a quartic. The intervals are closed, except at a fourfold root; one may be a single
        point. The pole may lie inside. [] where all motions are stable.
        """
        I, k2, k3, n2, *_ = self.top
        quartic, x = self._quartic, (n2.lift(k3 / I - k2), n2.lift(1))
        if top.excess(*self.top).is_zero:  # two lines: of w = 0 nothing is left
            quartic = divided(divided(quartic, x)[0], x)[0]
        ends = []
        for factor, n in squarefree(quartic):
            if n % 2:
                ends += _real_roots(factor)
            else:  # the frequency touches zero: unstable at the point itself, but for a fourfold root
                factor_left = divided(factor, gcd(factor, self._fourfold))[0] if self._leading < 0 else factor
                ends += 2 * _real_roots(factor_left)
        ends_of_bands = sorted(((u - k2) * n2.value for u in ends), key=lambda end: end.mid())
        return list(zip(ends_of_bands[::2], ends_of_bands[1::2], strict=True))

    @property
    def _quartic(self) -> Polynomial:
        """The `stability` times x^2 as a polynomial of degree four in u = omega2/n2 + k2, x = u - kappa.

        A tuple of `Surd`, the constant first.
        """
        I, k2, k3, _, n3, a0, _ = self.top
        kappa, A = k2 - k3 / I, self._leading
        force, unit = n3 * A + a0, n3.lift(1)
        level = (unit - 3 * n3 * n3) * A - 2 * n3 * a0
        # x^2 (u^2 + level) - 2 n3 kappa x (n3 u^2 + force) + (kappa n3 u + force)^2, x = u - kappa
        square = kappa * kappa
        constant = level * square + 2 * square * n3 * force + force * force
        return constant, -2 * kappa * level, level + (3 * n3 * n3 + 1) * square, -2 * kappa * (n3 * n3 + 1), unit

    def _off_the_pole(self, omega2: Any) -> Surd:
        n2 = self.top[3]
        w2 = n2.lift(rational(omega2, "omega2"))
        if (w2 - top.centre(*self.top)[0]).is_zero:
            raise DomainError("omega2 = -n2 k3/I3 is the pole of omega3(omega2).")
        return w2


def _real_roots(p: Polynomial) -> list[arb]:
    """Return the real roots, ascending balls, of a polynomial with simple roots; [] for a constant."""
    return [z.real for z in roots(p) if z.imag == 0] if len(p) > 1 else []
