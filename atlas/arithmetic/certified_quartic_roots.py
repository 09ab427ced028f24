"""The roots of a quartic as balls, by Euler's solution: a cubic resolvent and square roots.

For Q = a0 u^4 + 4 a1 u^3 + 6 a2 u^2 + 4 a3 u + a4 with the invariants g2, g3 and the roots e_i of 4 e^3 = g2 e + g3,

    a0 u + a1 = s1 sqrt(A1) + s2 sqrt(A2) + s3 sqrt(A3),    A_i = H - a0 e_i,    H = a1^2 - a0 a2,

with signs such that the product of the three terms is -G/2, G = a0^2 a3 - 3 a0 a1 a2 + 2 a1^3. What is real, the sign
of the discriminant says, exactly. Roots that are close cost digits, and no time as in an isolation by iteration.
"""

from collections.abc import Callable, Sequence
from itertools import product
from typing import Any

from flint import acb, arb


def four_roots(a: Sequence[Any], sign: Callable[[Any], int], ball: Callable[[Any], arb]) -> list[acb]:
    """Return four complex balls, the roots of a0 x^4 + 4 a1 x^3 + 6 a2 x^2 + 4 a3 x + a4, if all are simple.

    ``a`` holds (a0, a1, a2, a3, a4), exact numbers or balls; ``sign`` gives the sign of one, -1, 0 or 1, ``ball``
    its ball. At too low a precision, or for double roots, balls may be infinite or overlap.
    """
    a0, a1, a2, a3, _ = a
    g2, g3 = _invariants(*a)
    H, G = a1 * a1 - a0 * a2, a0 * a0 * a3 - 3 * a0 * a1 * a2 + 2 * a1 * a1 * a1
    discriminant = g2 * g2 * g2 - 27 * g3 * g3
    lead, h, side = ball(a0), ball(H), -1 if sign(G) > 0 else 1
    if not sign(G):
        inner = _root(ball(12 * H * H - a0 * a0 * g2))
        squares = [3 * h + r * inner for r in (1, -1)]
        z = [s * (_root(x.real) if x.imag.is_zero() else x.sqrt()) for x, s in product(squares, (1, -1))]
    elif sign(discriminant) > 0:
        angle, size = arb.atan2((ball(discriminant) / 27).sqrt(), ball(g3)) / 3, (ball(g2) / 3).sqrt()
        x, y, w = (_root(h - lead * size * (angle - 2 * k * arb.pi() / 3).cos()) for k in range(3))
        # the product of the three is that of their sizes, or less it if two are imaginary
        side *= 1 if all(v.imag.is_zero() for v in (x, y, w)) else -1
        z = [s * x + r * y + s * r * side * w for s, r in product((1, -1), (1, -1))]
    else:
        w = abs(ball(g3)) / 8
        outer = (w + (-ball(discriminant) / 1728).sqrt()) ** (arb(1) / 3)
        quotient = ball(g2) / 12 / outer
        real = (outer + quotient) * (1 if sign(g3) >= 0 else -1)
        pair = acb(-real / 2, (outer - quotient) * arb(3).sqrt() / 2)
        sum1, sum2 = side * (h - lead * real).sqrt(), (h - lead * pair).sqrt() * 2
        z = [acb(sum1 + sum2.real), acb(sum1 - sum2.real), acb(-sum1, sum2.imag), acb(-sum1, -sum2.imag)]
    return [(x - ball(a1)) / lead for x in z]


def _invariants(a0: Any, a1: Any, a2: Any, a3: Any, a4: Any) -> tuple[Any, Any]:
    """Return the invariants (g2, g3) of the quartic a0 x^4 + 4 a1 x^3 + 6 a2 x^2 + 4 a3 x + a4."""
    g2 = a0 * a4 - 4 * a1 * a3 + 3 * a2 * a2
    return g2, a0 * a2 * a4 + 2 * a1 * a2 * a3 - a2 * a2 * a2 - a0 * a3 * a3 - a1 * a1 * a4


def three_roots(b: Sequence[Any], sign: Callable[[Any], int], ball: Callable[[Any], arb]) -> list[acb]:
    """Return three complex balls, the roots of b0 x^3 + 3 b1 x^2 + 3 b2 x + b3; arguments as in `four_roots`."""
    b0, b1, b2, b3 = b
    H, G = b1 * b1 - b0 * b2, b0 * b0 * b3 - 3 * b0 * b1 * b2 + 2 * b1 * b1 * b1
    discriminant, h = 4 * H * H * H - G * G, ball(H)
    if not sign(G):
        z = [acb(0), _root(3 * h), -_root(3 * h)]
    elif sign(discriminant) > 0:
        angle = arb.atan2(ball(discriminant).sqrt(), -ball(G))
        z = [acb(2 * h.sqrt() * ((angle + 2 * k * arb.pi()) / 3).cos()) for k in range(3)]
    else:
        outer = ((abs(ball(G)) + (-ball(discriminant)).sqrt()) / 2) ** (arb(1) / 3)
        quotient = h / outer
        real, imaginary = -sign(G) * (outer + quotient), arb(3).sqrt() / 2 * (outer - quotient)
        z = [acb(real), acb(-real / 2, imaginary), acb(-real / 2, -imaginary)]
    return [(x - ball(b1)) / ball(b0) for x in z]


def discriminant(c: Sequence[Any]) -> Any:
    """Return a positive multiple of the discriminant of a polynomial of degree at most four, c0 + c1 x + ...

    ``c`` holds the coefficients, the constant one first. The result is zero where a root is a double one, 1 for
    degree one or less; of the quartic it has the sign of 256 a0^6 times the product of the squared differences of
    the roots.

        >>> discriminant([2, -3, 1])
        1
    """
    if len(c) == 5:
        g2, g3 = _invariants(c[4], c[3] / 4, c[2] / 6, c[1] / 4, c[0])
        return g2 * g2 * g2 - 27 * g3 * g3
    if len(c) == 4:
        b3, b2, b1, b0 = c[0], c[1] / 3, c[2] / 3, c[3]
        H, G = b1 * b1 - b0 * b2, b0 * b0 * b3 - 3 * b0 * b1 * b2 + 2 * b1 * b1 * b1
        return 4 * H * H * H - G * G
    return c[1] * c[1] - 4 * c[0] * c[2] if len(c) == 3 else 1


def two_roots(b: Sequence[Any], sign: Callable[[Any], int], ball: Callable[[Any], arb]) -> list[acb]:
    """Return two complex balls, the roots of b0 x^2 + 2 b1 x + b2; of real roots the one of larger magnitude first.

    Arguments as in `four_roots`.
    """
    b0, b1, b2 = b
    root = _root(ball(b1 * b1 - b0 * b2))
    if root.imag.is_zero() and sign(b1):
        larger = -ball(b1) - sign(b1) * root
        return [larger / ball(b0), ball(b2) / larger]
    return [(s * root - ball(b1)) / ball(b0) for s in (1, -1)]


def _root(x: arb) -> acb:
    """Return the square root of a real number, exactly real or imaginary; NaN where the sign is unknown."""
    if x > 0:
        return acb(x.sqrt())
    return acb(0, (-x).sqrt()) if x < 0 else acb(arb("nan"))
