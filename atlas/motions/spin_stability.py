"""Linear stability of a spin about a principal axis, of a free body or along the field."""

from collections.abc import Sequence
from fractions import Fraction


def spins_on(moments: Sequence[Fraction], field: Sequence[Fraction], omega: Sequence[Fraction]) -> bool | None:
    """Return whether a spin about a principal axis, along the field if there is one, is linearly stable.

    Principal ``moments``, ``field`` B' and ``omega`` are three numbers each along the principal axes; omega has one
    component that is not zero. Call its axis the third, K the field's component along it, and W the sum of K and that
    component. Small components W1, W2 of Omega + K and K1, K2 of the field in the body obey W1' = r1 (W W2 - K K2),
    W2' = r2 (W W1 - K K1), K1' = W K2 - K W2, K2' = K W1 - W K1, where r1 = (I2 - I3)/I1 and r2 = (I3 - I1)/I2.
    Solutions exp(s t) have s^4 + p s^2 + q = 0: they stay small where both s^2 are negative and different. None at a
    border, where the linear equations do not decide.
    """
    axis = next(i for i in range(3) if omega[i])
    I1, I2, I3 = (moments[(axis + i) % 3] for i in (1, 2, 3))
    W, K, r1, r2 = omega[axis] + field[axis], field[axis], (I2 - I3) / I1, (I3 - I1) / I2
    if not K:
        return r1 * r2 < 0 if r1 * r2 else None
    p, q = (1 - r1 * r2) * W * W + (r1 - r2) * K * K, -r1 * r2 * (W * W - K * K) ** 2
    gaps = p, q, p * p - 4 * q
    return all(x > 0 for x in gaps) if all(gaps) else None
