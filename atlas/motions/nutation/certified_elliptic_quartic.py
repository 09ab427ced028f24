"""The polynomial Q of an elliptic motion: (dK_a/dt)^2 = Q(-K_a), K_a the component of the field along one axis.

K' = [K, E K] with E_i = -v e_i, e_i = 1/(z I_i + D), keeps N = (K, K) and h = sum e_i K_i^2. So the squares of the
other two components are affine in that of K_a, and with u = -K_a, (b, c, a) a cyclic order of the axes,

    (du/dt)^2 = v^2 [e_c N - h + (e_a - e_c) u^2] [h - e_b N - (e_a - e_b) u^2].

v^2 = prod(z + D/I_i) is rational with the inputs, and so is Q: which case it is, is known exactly.
"""

from itertools import combinations

from flint import acb, arb, ctx, fmpq, fmpq_poly

from atlas.arithmetic.certified_surd import Surd, sign_of
from atlas.arithmetic.numbers import root, workprec
from atlas.motions.nutation.certified_quartic import Quartic, Root, Vector, rational_polynomial


class EllipticQuartic(Quartic):
    """Quartic Q(u) = (du/dt)^2, u = -K_a, of an elliptic motion, a the nutating axis.

    ``e`` holds e_i = 1/(z I_i + D), D = I1 I2 I3, and ``K`` the field's components at t = 0, in the order (b, c, a) of
    the axes. ``square`` is v^2, v^2 = prod(z + D/I_i), ``sign`` the sign of v. `N` is K^2, `h` the sum of e_i K_i^2;
    ``rate`` and `torque` are du/dt at t = 0 and the torque at the poles, both over |v|.
    """

    def __init__(self, e: Vector, K: Vector, square: fmpq, sign: int) -> None:
        self.K, self._e = K, e
        self.N = sum((x * x for x in K), fmpq(0))
        self.h = sum((c * x * x for c, x in zip(e, K, strict=True)), fmpq(0))
        lower_factor = fmpq_poly([e[1] * self.N - self.h, 0, e[2] - e[1]])
        upper_factor = fmpq_poly([self.h - e[0] * self.N, 0, e[0] - e[2]])
        self.polynomial = rational_polynomial((square * lower_factor * upper_factor).coeffs())
        self.rate = Surd.rational(sign * K[0] * K[1] * (e[1] - e[0]))
        self.u = Surd.rational(-K[2])
        self.torque = sign * (e[2] * self.N - self.h)

    def _isolated(self) -> list[Root]:
        """Return the distinct roots of Q, a quadratic in u^2, as `Root`, in balls that do not overlap.

        Real ones come first, ascending.
        """
        (e_b, e_c, e_a), h, N = self._e, self.h, self.N
        if e_a in (e_b, e_c):
            return super()._isolated()
        squares = [(h - c * N) / (e_a - c) for c in (e_b, e_c)]
        counts = {x: squares.count(x) * (1 if x else 2) for x in squares}
        precision = ctx.prec
        while True:
            precision *= 2
            with workprec(precision):
                sizes = {x: arb(root(abs(x))) for x in counts}
                roots = [
                    Root(acb(sign * size) if x >= 0 else acb(0, sign * size), counts[x])
                    for x, size in sizes.items() for sign in ((-1, 1) if x != 0 else (1,))
                ]  # fmt: skip
            if not any(x.value.overlaps(y.value) for x, y in combinations(roots, 2)):
                real = sorted((x for x in roots if x.is_real), key=lambda x: x.value.real.mid())
                return real + [x for x in roots if not x.is_real]

    def sign_beside(self, pole: int) -> int:
        """Return the sign, -1, 0 or 1, of the torque at a pole; equal at both poles, so that `pole` is not used."""
        del pole
        return sign_of(self.torque)
