"""Numbers a + b sqrt(N) with rational a, b, N, exactly: the numbers in which the length of a rational vector stands."""

from dataclasses import dataclass
from itertools import combinations
from typing import TypeAlias

from flint import acb, arb, ctx, fmpq

from atlas.arithmetic.certified_quartic_roots import discriminant, four_roots, three_roots, two_roots
from atlas.arithmetic.numbers import root, workprec
from atlas.errors import DomainError

MAX_BITS = 1 << 17
"""Bits at which the search for roots is given up, after less than a second."""

Polynomial: TypeAlias = tuple["Surd", ...]
"""Coefficients, the constant one first; the last one is not zero."""


@dataclass(frozen=True)
class Surd:
    """The number a + b sqrt(N), with rational a, b and N > 0; N is no square, or b is zero.

    Sums, products and quotients with a `Surd`, a rational or an integer are exact; both surds must have the same N
    unless one has b = 0 and stands on the right.
    """

    a: fmpq
    b: fmpq
    N: fmpq

    @classmethod
    def root(cls, N: fmpq) -> "Surd":
        """Return sqrt(N) of a rational N > 0 as a `Surd`: with b = 0 where N is a rational square."""
        exact = root(N)
        return cls(exact, fmpq(0), N) if isinstance(exact, fmpq) else cls(fmpq(0), fmpq(1), N)

    @classmethod
    def rational(cls, x: fmpq) -> "Surd":
        """Return a rational number as a `Surd` with b = 0 and N = 1."""
        return cls(x, fmpq(0), fmpq(1))

    def lift(self, x: "Surd | fmpq | int") -> "Surd":
        """Return a number as a `Surd` with the root sqrt(N) of this one; a `Surd` unchanged."""
        return x if isinstance(x, Surd) else Surd(fmpq(x), fmpq(0), self.N)

    def __add__(self, addend: "Surd | fmpq | int") -> "Surd":
        x = self.lift(addend)
        return Surd(self.a + x.a, self.b + x.b, self.N)

    def __neg__(self) -> "Surd":
        return Surd(-self.a, -self.b, self.N)

    def __sub__(self, subtrahend: "Surd | fmpq | int") -> "Surd":
        return self + (-self.lift(subtrahend))

    def __mul__(self, factor: "Surd | fmpq | int") -> "Surd":
        x = self.lift(factor)
        return Surd(self.a * x.a + self.b * x.b * self.N, self.a * x.b + self.b * x.a, self.N)

    def __truediv__(self, divisor: "Surd | fmpq | int") -> "Surd":
        x = self.lift(divisor)
        norm = x.a * x.a - x.b * x.b * self.N
        return self * Surd(x.a / norm, -x.b / norm, self.N)

    __radd__, __rmul__ = __add__, __mul__

    def __rsub__(self, minuend: "Surd | fmpq | int") -> "Surd":
        return self.lift(minuend) - self

    @property
    def sign(self) -> int:
        """The sign, -1, 0 or 1."""
        a, b = sign_of(self.a), sign_of(self.b)
        if a * b >= 0:
            return a or b
        return a * sign_of(self.a * self.a - self.b * self.b * self.N)

    @property
    def is_zero(self) -> bool:
        """Whether the number is zero."""
        return bool(self.a == 0 and self.b == 0)

    @property
    def value(self) -> fmpq | arb:
        """The number: an exact rational if b = 0, otherwise a ball accurate to the current precision less 8 bits."""
        if self.b == 0:
            return self.a
        precision = ctx.prec
        while True:  # where a and b sqrt(N) cancel
            with workprec(precision):
                value = arb(self.a) + self.b * arb(self.N).sqrt()
            if value.rel_accuracy_bits() >= ctx.prec - 8 or self.is_zero:
                return value
            precision *= 2


def evaluated(p: Polynomial, x: Surd) -> Surd:
    """Return p(x) as a `Surd`; ``p`` has the coefficients with the lowest power first."""
    value = x.lift(0)
    for c in reversed(p):
        value = value * x + c
    return value


def derivative(p: Polynomial) -> Polynomial:
    """Return the derivative p' of a polynomial, coefficients with the lowest power first; () for a constant."""
    return trimmed([c * n for n, c in enumerate(p)][1:])


def trimmed(p: "list[Surd] | Polynomial") -> Polynomial:
    """Return coefficients, the lowest power first, as a tuple without the zeros of the highest powers; () for zero."""
    c = list(p)
    while c and c[-1].is_zero:
        c.pop()
    return tuple(c)


def squarefree(p: Polynomial) -> list[tuple[Polynomial, int]]:
    """Return pairs (factor without multiple roots, multiplicity of its roots in p), by Yun's algorithm.

    A polynomial without multiple roots is returned itself, the only pair.
    """
    if discriminant([_ball(c) for c in p]) != 0:
        return [(p, 1)]
    factors, n = list[tuple[Polynomial, int]](), 1
    slope = derivative(p)
    common = gcd(p, slope)
    b, c = divided(p, common)[0], divided(slope, common)[0]
    while len(b) > 1:
        d = _minus(c, derivative(b))
        a = gcd(b, d)
        if len(a) > 1:
            factors.append((a, n))
        b, c, n = divided(b, a)[0], divided(d, a)[0], n + 1
    return factors


def roots(p: Polynomial) -> list[acb]:
    """Return the simple roots of a polynomial as disjoint balls: the real ones ascending, then the complex ones.

    The degree is one to four; coefficients have the lowest power first. The balls are as accurate as the current
    precision, for which it is raised as far as needed. Raises DomainError where roots are too many orders of
    magnitude apart.
    """
    if len(p) == 2:
        return [acb((-(p[0] / p[1])).value)]
    if p[0].is_zero:
        return _sorted([acb(0), *roots(p[1:])])
    digits = precision = ctx.prec
    while precision < MAX_BITS:
        precision *= 2
        with workprec(precision):
            # first from balls, in which most signs are known; exact arithmetic takes longer
            for exact in (True,) if precision > 2 * digits else (False, True):
                closed = _closed(p, exact=exact)
                are_apart = not any(x.overlaps(y) for x, y in combinations(closed, 2))
                if are_apart and all(z.is_finite() and z.rel_accuracy_bits() >= digits for z in closed):
                    return _sorted(closed)
    raise DomainError(
        "The roots of Q are too many orders of magnitude apart to be found: make the components more alike."
    )


def _sorted(values: list[acb]) -> list[acb]:
    real = sorted((z for z in values if z.imag.is_zero()), key=lambda z: z.real.mid())
    return real + [z for z in values if not z.imag.is_zero()]


def _closed(p: Polynomial, *, exact: bool) -> list[acb]:
    """Return the roots in closed form, a list of balls at the current precision, perhaps inaccurate.

    ``exact`` decides signs by exact arithmetic; otherwise by balls, and the list is [NaN] where a sign is unknown.
    """
    formula = {5: four_roots, 4: three_roots, 3: two_roots}[len(p)]
    weights = {5: (1, 4, 6, 4, 1), 4: (1, 3, 3, 1), 3: (1, 2, 1)}[len(p)]
    numbers = p if exact else [_ball(c) for c in p]
    try:
        a = [c / weight for c, weight in zip(reversed(numbers), weights, strict=True)]
        return formula(a, lambda x: x.sign, _ball) if exact else formula(a, _sure_sign, lambda x: x)
    except UnsureError:
        return [acb(arb("nan"))]


class UnsureError(Exception):
    """Raised where the sign of a ball is unknown: the ball contains zero."""


def _sure_sign(x: arb) -> int:
    if not x != 0:
        raise UnsureError
    return 1 if x > 0 else -1


def _ball(x: Surd) -> arb:
    return arb(x.value)


def divided(p: Polynomial, q: Polynomial) -> tuple[Polynomial, Polynomial]:
    """Return (quotient, remainder) of the polynomials p/q; q is not zero, () stands for zero."""
    remainder, quotient = list(p), [q[0].lift(0)] * max(len(p) - len(q) + 1, 0)
    for n in range(len(p) - len(q), -1, -1):
        factor = remainder[n + len(q) - 1] / q[-1]
        quotient[n] = factor
        for i, c in enumerate(q):
            remainder[n + i] = remainder[n + i] - factor * c
    return trimmed(quotient), trimmed(remainder[: len(q) - 1])


def gcd(p: Polynomial, q: Polynomial) -> Polynomial:
    """Return the greatest common divisor of two polynomials, p not zero, with leading coefficient one."""
    while q:
        p, q = q, divided(p, q)[1]
    return tuple(c / p[-1] for c in p)


def _minus(p: Polynomial, q: Polynomial) -> Polynomial:
    """Return the difference p - q of polynomials, not both zero; () if they are equal."""
    zero = (p or q)[0].lift(0)
    size = max(len(p), len(q))
    first_coefficient, second = ([*x, *[zero] * (size - len(x))] for x in (p, q))
    return trimmed([x - y for x, y in zip(first_coefficient, second, strict=True)])


def sign_of(x: fmpq) -> int:
    """Return the sign of a rational number, -1, 0 or 1."""
    return int(x > 0) - int(x < 0)
