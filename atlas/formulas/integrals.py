"""What a symmetric body conserves, (36) to (41), and the cubic and quartic of Omega3 that follow, from I, Omega and K.

For exact rationals. In floats and in two words these sums cancel: there `atlas.core.integrals`, `pseudo_oscillator` and
`nutation.roots` write them from the state at t = 0, in forms that don't.
"""

from atlas.formulas.numbers import Number, Vector, dot

NAMES = ("E'", "K^2", "c3", "c5", "(m,B')")
"""What an elementary motion conserves, in this order."""


def integrals(I: Number, Omega: Vector, K: Vector) -> tuple[Number, Number, Number, Number]:
    """Return E', (36), K^2, (37), c3, (40), and c5, (41)."""
    (w1, w2, w3), (K1, K2, K3) = Omega, K
    c3 = w3 + K3
    return w1 * w1 + w2 * w2 + I * w3 * w3, dot(K, K), c3, w1 * K1 + w2 * K2 - w3 * w3 + (2 - I) * c3 * w3


def along_field(I: Number, Omega: Vector, K: Vector) -> Number:
    """Return (m, B')/I2, (88); with Omega + K in the place of Omega (M, B')/I2."""
    w1, w2, w3 = Omega
    return dot((w1, w2, I * w3), K)


def cubic(I: Number, E: Number, K2: Number, c3: Number, c5: Number) -> tuple[Number, ...]:
    """Return a0..a3 of (48), with ``I - (2-I)^2`` in a1 where the paper prints ``I - (2-1)^2``."""
    a1 = -2 * c5 + (I - (2 - I) ** 2) * c3**2 - E - I * K2
    return ((2 - I) * c5 + E) * c3, a1, 6 * (1 - I) * c3, -2 * (1 - I)


def quartic(I: Number, E: Number, K2: Number, c3: Number, c5: Number) -> tuple[Number, ...]:
    """Return q0..q4 of Q(u) = (E' - I u^2)(K^2 - (c3 - u)^2) - (u^2 - (2-I) c3 u + c5)^2; Q' is twice (47)."""
    a0, a1, a2, a3 = cubic(I, E, K2, c3, c5)
    return E * (K2 - c3**2) - c5**2, 2 * a0, a1, 2 * a2 / 3, a3 / 2
