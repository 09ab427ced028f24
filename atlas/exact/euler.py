"""The roots of a quartic with rational coefficients as balls, by Euler's solution: a cubic resolvent and square roots.

For Q = a0 u^4 + 4 a1 u^3 + 6 a2 u^2 + 4 a3 u + a4 with the invariants g2, g3 and the roots e_i of 4 e^3 = g2 e + g3,

    a0 u + a1 = s1 sqrt(A1) + s2 sqrt(A2) + s3 sqrt(A3),    A_i = H - a0 e_i,    H = a1^2 - a0 a2,

with signs such that the product of the three terms is -G/2, G = a0^2 a3 - 3 a0 a1 a2 + 2 a1^3. What is real, the sign
of the discriminant says, exactly. Roots that are close cost digits, and no time as in an isolation by iteration.
"""

from itertools import combinations, product

from flint import acb, arb, ctx, fmpq, fmpq_poly

from atlas.formulas.numbers import workprec


def quartic_roots(polynomial: fmpq_poly) -> list[acb]:
    """Return the four roots of a quartic that has no double root, real ones first; the balls do not overlap.

    At least two of the roots must be real. The precision is raised above that of the moment as far as it takes.
    """
    c = polynomial.coeffs()
    a = (c[4], c[3] / 4, c[2] / 6, c[1] / 4, c[0])
    precision = ctx.prec + 32
    while True:
        with workprec(precision):
            roots = _roots(*a)
            if all(x.is_finite() for x in roots) and not any(x.overlaps(y) for x, y in combinations(roots, 2)):
                return roots
        precision *= 2


def _roots(a0: fmpq, a1: fmpq, a2: fmpq, a3: fmpq, a4: fmpq) -> list[acb]:
    """Return the roots at the precision of the moment, which may not suffice."""
    g2 = a0 * a4 - 4 * a1 * a3 + 3 * a2 * a2
    g3 = a0 * a2 * a4 + 2 * a1 * a2 * a3 - a2**3 - a0 * a3**2 - a1**2 * a4
    H, G = a1 * a1 - a0 * a2, a0 * a0 * a3 - 3 * a0 * a1 * a2 + 2 * a1**3
    discriminant = g2**3 - 27 * g3**2
    sign = -1 if G > 0 else 1
    if G == 0:
        inner = arb(12 * H * H - a0 * a0 * g2).sqrt()
        z = [s * _root(3 * H + r * inner) for r, s in product((1, -1), (1, -1))]
        z.sort(key=lambda x: not x.imag.is_zero())
    elif discriminant > 0:
        angle, size = arb.atan2((arb(discriminant) / 27).sqrt(), arb(g3)) / 3, (arb(g2) / 3).sqrt()
        x, y, w = ((H - a0 * size * (angle - 2 * k * arb.pi() / 3).cos()).sqrt() for k in range(3))
        z = [acb(s * x + r * y + s * r * sign * w) for s, r in product((1, -1), (1, -1))]
    else:
        w = arb(abs(g3)) / 8
        outer = (w + (-arb(discriminant) / 1728).sqrt()) ** (arb(1) / 3)
        other = arb(g2) / 12 / outer
        real = (outer + other) * (1 if g3 >= 0 else -1)
        pair = acb(-real / 2, (outer - other) * arb(3).sqrt() / 2)
        first, second = sign * (H - a0 * real).sqrt(), (H - a0 * pair).sqrt() * 2
        z = [acb(first + second.real), acb(first - second.real), acb(-first, second.imag), acb(-first, -second.imag)]
    return [(x - a1) / a0 for x in z]


def _root(x: arb) -> acb:
    """Return the square root of a real number, real or imaginary exactly; not finite where its sign is not known."""
    if x > 0:
        return acb(x.sqrt())
    return acb(0, (-x).sqrt()) if x < 0 else acb(arb("nan"))
