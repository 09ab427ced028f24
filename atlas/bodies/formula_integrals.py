"""Conserved quantities of a body, (36) to (41) and theorem-clebsch, and the cubic and quartic of Omega3 that follow.

The cubic and the quartic are for exact rationals, and for floats where no values of them are wanted: these cancel, and
`pseudo_oscillator` and `nutation.roots` write them from the state at t = 0, in forms that don't.
"""

from atlas.arithmetic.numbers import Number, Vector, applied, cross, dot

NAMES = ("E'", "K^2", "c3", "c5", "(m,B')")
"""Names of the conserved quantities of an elementary motion, in order."""


def integrals(I: Number, Omega: Vector, K: Vector, factors: Vector = ()) -> tuple[Number, Number, Number, Number]:
    """Return E', (36), K^2, (37), c3, (40), and c5, (41), of a state Omega, K in the body, in 1/time.

    E', K^2 and c5 are in 1/time^2, c3 is in 1/time. ``I`` is I3/I2; ``factors`` are 1 - I and 2 - I where they have
    lost no digit. c5 is written as Omega1 K1 + Omega2 K2 + Omega3 [(1 - I) Omega3 + (2 - I) K3], in which c3 is
    gone and I = 1 exact.

        >>> integrals(1, (0, 2, 3), (0, 5, 7))
        (13, 74, 10, 31)
    """
    (w1, w2, w3), (K1, K2, K3), (less, further) = Omega, K, factors or (1 - I, 2 - I)
    c5 = w1 * K1 + w2 * K2 + w3 * (less * w3 + further * K3)
    return w1 * w1 + w2 * w2 + I * w3 * w3, dot(K, K), w3 + K3, c5


def along_field(I: Number, Omega: Vector, K: Vector) -> Number:
    """Return (m, B')/I2, (88), in 1/time^2, of Omega and K in the body, three numbers each, and I = I3/I2.

    With Omega + K for Omega it is (M, B')/I2, M the canonical momentum.
    """
    w1, w2, w3 = Omega
    return dot((w1, w2, I * w3), K)


def constants(I2: Number, I3: Number, *state: Number) -> tuple[Number, ...]:
    """Return E', K^2, c3, c5 and (M, B')/I2 of a ``state`` of six numbers: Omega1 to Omega3, K1 to K3, in 1/time.

    See `integrals`; M = II (Omega + K) is the canonical momentum.
    """
    I, Omega, K = I3 / I2, state[:3], state[3:]
    factors = (I2 - I3) / I2, (I2 + I2 - I3) / I2
    return *integrals(I, Omega, K, factors), along_field(I, [w + k for w, k in zip(Omega, K, strict=True)], K)


def clebsch(*numbers: Number) -> tuple[Number, ...]:
    """Return 2 H, F, (M, K), K^2 and twice the kinetic energy, theorem-clebsch, of fifteen numbers.

    The numbers are the nine entries of the inertia tensor J row by row, then the components of Omega, then those of K,
    both in the body. The canonical momentum is M = J (Omega + K).
    """
    J, Omega, K = (numbers[0:3], numbers[3:6], numbers[6:9]), numbers[9:12], numbers[12:15]
    W = [w + k for w, k in zip(Omega, K, strict=True)]
    M, cofactors = applied(J, W), (cross(J[1], J[2]), cross(J[2], J[0]), cross(J[0], J[1]))
    F = dot(M, M) - dot(K, applied(cofactors, K))
    return dot(M, W) + dot(K, applied(J, K)), F, dot(M, K), dot(K, K), dot(Omega, applied(J, Omega))


def cubic(I: Number, E: Number, K2: Number, c3: Number, c5: Number, factors: Vector = ()) -> tuple[Number, ...]:
    """Return (a0, a1, a2, a3) of (47), by (48) with its slip set right, from I = I3/I2, E', K^2, c3 and c5.

    The constants are those of `integrals`, and so are the ``factors``.
    a0 = [(2-I) c5 + E'] c3,  a1 = -2 c5 - (1-I)(4-I) c3^2 - E' - I K^2,  a2 = 6 (1-I) c3,  a3 = -2 (1-I).
    The printed a1 has [I - (2-1)^2] c3^2; true is [I - (2-I)^2] = -(1-I)(4-I), which does not cancel near I = 1.
    """
    less, further = factors or (1 - I, 2 - I)
    a1 = -2 * c5 - less * (2 + further) * (c3 * c3) - E - I * K2
    return (further * c5 + E) * c3, a1, 6 * less * c3, -2 * less


def quartic(I: Number, E: Number, K2: Number, c3: Number, c5: Number) -> tuple[Number, ...]:
    """Return (q0, ..., q4) of the quartic Q(u) = (dOmega3/dt)^2 at Omega3 = u, the constant first.

    Q(u) = (E' - I u^2)(K^2 - (c3 - u)^2) - (u^2 - (2-I) c3 u + c5)^2; the constants are those of `integrals`.
    Q' is twice the cubic of (47): so q4 = a3/2 = I - 1. Not in the paper: it follows from (36), (37), (40), (41) and
    (38), as (Omega1 K2 - Omega2 K1)^2 + (Omega1 K1 + Omega2 K2)^2 = (Omega1^2 + Omega2^2)(K1^2 + K2^2).
    """
    a0, a1, a2, a3 = cubic(I, E, K2, c3, c5)
    return E * (K2 - c3 * c3) - c5 * c5, 2 * a0, a1, 2 * a2 / 3, a3 / 2
