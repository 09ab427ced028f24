"""Any motion in given axes, from any attitude, as balls: the attitude and the inertia tensor exactly as they are given.

The principal moments and axes of a tensor T are algebraic numbers. A body near it, T~ = P^T diag(I) P with rational
moments and a rational rotation P, moves almost alike. With W = Omega + K, and S the rotation as seen from Larmor's
frame, Euler's equations with the torque of the charge are, along principal axes,

    W_i' = (I_j - I_k)/I_i (W_j W_k - K_j K_k),    K' = [K, W],    S' = S W^.

As |I_j - I_k| <= I_i, neighbouring states part at a rate of at most L = 2 (|W| + b), b = |K|, whatever the body. For
two bodies in the same state at t = 0, whose tensors differ by e, with moments from I_min to I_max and |Omega| <= w,
W and K together differ by at most x, and S by a turn of at most x |t|,

    x = n |t| exp(L |t|),    n = e (I_max w^2 + 2 I_max w b)/I_min^2 + e (w^2 + 5 w b)/I_min.

With I1 >= I2 >= I3, H = (I1 (W1^2 + K1^2) + ...)/2 bounds W1^2 + W2^2 by u^2 = 2 H/I2 and |W3| by sqrt(2 H/I3); on a
thin rod |W3| <= |W(0)| + (I1 - I2)/I3 (u^2 + b^2) |t|/2 is less.
"""

from collections.abc import Sequence
from itertools import chain
from typing import Any

from flint import arb, ctx, fmpq

from atlas.arithmetic.certified_inputs import Real, rational, rationals
from atlas.arithmetic.certified_rotation import Matrix, identity, product
from atlas.arithmetic.numbers import applied, dot, quaternion_products, workprec
from atlas.bodies.certified_inertia import principal_axes
from atlas.bodies.formula_integrals import clebsch
from atlas.errors import DomainError, NotCertifiedError
from atlas.motions.nutation.certified_cayley_klein import matrix
from atlas.motions.torus.certified import AsymmetricMotion

MAX_BITS = 1 << 13
"""Bits of moments and axes beyond which a time is too far."""

LEAST_BITS = 256
"""Bits of moments and axes for short times."""

MARGIN = fmpq((1 << 20) + 1, 1 << 20)
"""Factor by which bounds on moments hold for both bodies."""

ROOTS = (
    "Frequencies, period and mode depend on principal moments, which are roots: --inertia I1 I2 I3 has their digits."
)


OF_STATE = ("H", "F", "MK", "energy", "kind")
OF_MOMENTS = ("frequencies", "mode", "period", "precession_rate", "spin_rate")
"""Quantities that follow from the tensor, and those that need its principal moments."""


def transposed(M: Sequence[Sequence[Any]]) -> list[list[Any]]:
    """Return the transpose of a matrix M, as nested lists."""
    return [list(row) for row in zip(*M, strict=True)]


class PlacedMotion:
    """Motion of a body from the attitude of a quaternion (x, y, z, w), in the field B' of the laboratory.

    ``inertia`` are principal moments (3,), or six elements I11 I22 I33 I12 I13 I23 of a tensor; ``omega`` (rad/time) is
    along the body's given axes. The quaternion may have any length but zero. Quantities such as `H` are attributes, see
    `__getattr__`.
    """

    def __init__(self, inertia: Any, field: Any, omega: Any, attitude: Any = (0, 0, 0, 1)) -> None:
        x, y, z, w = rationals(attitude, "the attitude", 4)
        self.attitude: Matrix = matrix((w, x, y, z))
        self.omega = rationals(omega, "omega", 3)
        self.field = tuple(applied(transposed(self.attitude), rationals(field, "field (B1, B2, B3)", 3)))
        if len(inertia) == len("123"):
            a, b, c = rationals(inertia, "inertia (I1, I2, I3)", 3)
            d = e = f = fmpq(0)
        else:
            a, b, c, d, e, f = rationals(inertia, "the inertia tensor", 6)
        self.tensor = [[a, d, e], [d, b, f], [e, f, c]]
        self.is_diagonal = d == e == f == 0
        self._bodies: dict[int, tuple[AsymmetricMotion, Matrix, fmpq]] = {}

    def _body(self, bits: int) -> tuple[AsymmetricMotion, Matrix, fmpq]:
        """Return (motion along principal axes, these axes as rows, bound on the difference of the two tensors).

        The motion has rational moments near the eigenvalues, computed with ``bits`` binary digits; cached.
        """
        if bits not in self._bodies:
            axes: Matrix = identity()
            moments = [self.tensor[i][i] for i in range(3)]
            if not self.is_diagonal:
                with workprec(bits):
                    moments, rows = principal_axes(self.tensor)
                    products = quaternion_products(rows)
                    x, y, z, w = max(products, key=lambda row: max(abs(float(q.mid())) for q in row))
                    axes = matrix([q.mid().fmpq() for q in (w, x, y, z)])
                    moments = [I if isinstance(I, fmpq) else I.mid().fmpq() for I in moments]
            motion = AsymmetricMotion(moments, applied(axes, self.field), applied(axes, self.omega))
            rebuilt = product(transposed(axes), [[I * x for x in row] for I, row in zip(moments, axes, strict=True)])
            pairs = zip(chain(*rebuilt), chain(*self.tensor), strict=True)
            distance = sum((abs(a - b) for a, b in pairs), fmpq(0))
            self._bodies[bits] = motion, axes, distance
        return self._bodies[bits]

    def _sizes(self, t: arb) -> tuple[arb, arb, arb, arb]:
        """Return bounds for both bodies, four balls, until time t: least moment, largest moment, |W| and |K|.

        The two are the given body and the one near it of the module. Raises NotCertifiedError where the moments
        differ too much in size.
        """
        motion, _, distance = self._body(LEAST_BITS)
        I3, I2, I1 = sorted(motion.inertia)
        if distance > (MARGIN - 1) / 4 * I3:
            raise NotCertifiedError("not certified: the principal moments are of too different sizes.")
        K, W = self.field, [w + k for w, k in zip(self.omega, self.field, strict=True)]
        energy = sum((dot(v, applied(self.tensor, v)) + distance * dot(v, v) for v in (W, K)), fmpq(0)) * MARGIN
        squared = arb(energy / I2)
        steady = arb(dot(W, W)).sqrt() + arb(min((I1 - I2 + 2 * distance) / I3 * MARGIN, 1)) * t * (
            squared + arb(dot(K, K))
        )
        spin = min((steady.upper(), arb(energy / I3).sqrt().upper()), key=float)
        return arb(I3 / MARGIN), arb(I1 * MARGIN), squared.sqrt() + spin, arb(dot(K, K)).sqrt()

    def _deviation(self, t: Any) -> tuple[AsymmetricMotion, Matrix, arb, arb]:
        """Return (motion along principal axes, these axes as rows, error of Omega, error of R's entries) until time t.

        The errors are balls about 0, in rad/time and without unit. Raises NotCertifiedError where the bounds grow
        beyond `MAX_BITS` bits.
        """
        if self.is_diagonal:
            return *self._body(0)[:2], arb(0), arb(0)
        size = arb(abs(rational(t, "the time")))
        smallest, largest, W, b = self._sizes(size)
        w, rate = W + b, 2 * (W + b)
        growth, bits = float((rate * size).upper()) / 0.69, LEAST_BITS
        while bits < ctx.prec + growth + 64:
            bits *= 2
        if bits > MAX_BITS:
            raise NotCertifiedError(
                f"not certified: at t = {float(size):g} the difference of two bodies near the tensor may have grown "
                "beyond what is computed; its principal moments, by --inertia I1 I2 I3, have any times."
            )
        motion, axes, distance = self._body(bits)
        pull = distance * (largest * w * (w + 2 * b) / smallest**2 + w * (w + 5 * b) / smallest)
        apart_by = pull * size * (rate * size).exp()
        return motion, axes, arb(0, apart_by.upper()), arb(0, (apart_by * size).upper())

    def rotation(self, t: Any) -> Matrix:
        """Return R(t) as three rows of balls or rationals; R(0) is the given attitude."""
        motion, axes, _, error = self._deviation(t)
        R = product(self.attitude, product(transposed(axes), product(motion.rotation(t), axes)))
        return R if self.is_diagonal or rational(t, "the time") == 0 else [[x + error for x in row] for row in R]

    def angular_velocity(self, t: Any) -> list[Real]:
        """Return Omega(t) along the given axes of the body, three balls or rationals in rad/time; exact at t = 0."""
        motion, axes, error, _ = self._deviation(t)
        if rational(t, "the time") == 0:
            return list(self.omega)
        Omega = applied(transposed(axes), motion.angular_velocity(t))
        return Omega if self.is_diagonal else [x + error for x in Omega]

    def __getattr__(self, name: str) -> Any:
        """Return a quantity of `OF_STATE` or `OF_MOMENTS` by name: of the first also for a tensor that is not diagonal.

        `H`, `MK`, `energy` and `F` are rationals, `kind` and `mode` strings, the others balls, as in
        `AsymmetricMotion`. Raises DomainError for a quantity of principal moments if the tensor is not diagonal,
        AttributeError for other names.
        """
        if name in OF_STATE and not self.is_diagonal:
            J = [x for row in self.tensor for x in row]
            H, F, c, *_ = clebsch(*J, *self.omega, *self.field)
            return dict(zip(OF_STATE, (H / 2, F, c, H / 2 - c, "given by a tensor"), strict=True))[name]
        if name not in (*OF_STATE, *OF_MOMENTS):
            raise AttributeError(name)
        if not self.is_diagonal:
            raise DomainError(ROOTS)
        return getattr(self._body(0)[0], name)
