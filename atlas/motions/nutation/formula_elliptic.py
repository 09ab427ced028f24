"""Where the curve of an elliptic motion splits, from the moments, K and z: exact rationals, or arrays.

The curve of a motion, eta^2 = Psi = b^2 z^2 + (F + e2 b^2) z + 2 D H + 2 c v over v^2 = P(z) = prod(z + D/I_i) with
c = (M, K), has a double point where the motion is one of the family: Psi = Psi' = 0 (the derivative is 2 v d/dz). There
the flow of D H + z F/2 stands still, and its linearization has the eigenvalues +-sqrt(-C) and four zeros,

    C = Psi''/2 = 4 b^2 P + 2 c v P'' - c P'^2/v = 4 b^2 P + s (P'^2 - 2 P P''),     s = sum K_i^2/(z + D/I_i),

theorem-splitting.

So C > 0 makes D H + z F/2 definite across the closed curve that K and M draw, and neighbours stay beside it; C < 0
makes it a saddle, which they leave; in time at another rate, which may be zero for single z, since the flow of F moves
along the curve and stretches too.
"""

from atlas.arithmetic.numbers import Number, Vector, dot


def splitting(moments: Vector, K: Vector, z: Number) -> Number:
    """Return C/D^2, the squared frequency of small departures in the flow of H + (z/D) F/2, in 1/time^2.

    ``moments`` are I1, I2, I3, K is the field in the body (1/time), z the motion's parameter. D = I1 I2 I3 and
    C = 4 K^2 P + s (P'^2 - 2 P P''), with P(z) = prod(z + D/I_i) and s = sum K_i^2/(z + D/I_i). H and F are those of
    `EllipticMotion.invariants`. Negative where neighbours leave the motion.
    """
    x = places(moments, z)
    return split(moments, dot(K, K), dot(K, [k / q for k, q in zip(K, x, strict=True)]), z)


def split(moments: Vector, square: Number, s: Number, z: Number) -> Number:
    """Return C/D^2 of `splitting` for any K with K^2 = ``square`` and sum K_i^2/(z + D/I_i) = s, in 1/time^2.

    ``moments`` are I1, I2, I3.
    """
    D = moments[0] * moments[1] * moments[2]
    x, y, w = places(moments, z)
    P, lower_sum, second = x * y * w, x * y + y * w + w * x, 2 * (x + y + w)
    return (4 * square * P + s * (lower_sum * lower_sum - 2 * P * second)) / (D * D)


def places(moments: Vector, z: Number) -> tuple[Number, ...]:
    """Return the three numbers z + D/I_i, D = I1 I2 I3, in inertia^2, for the ``moments`` I1, I2, I3."""
    D = moments[0] * moments[1] * moments[2]
    return tuple(z + D / I for I in moments)
