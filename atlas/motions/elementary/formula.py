"""The constants of the motions in elementary functions, (71), (72), (79), and of the free body beside them, (87).

Each formula takes I2, I3, B2, B3, omega2, and `omega3` where it is free, or the angular velocity of the free body.
"""

from atlas.arithmetic.numbers import Number, Vector, length
from atlas.bodies.formula_domain import CASES, FREE_CASES
from atlas.bodies.formula_integrals import along_field, integrals
from atlas.motions.elementary.formula_hyperbola import ordinate, precession, proper


def constants(
    case: str, I2: Number, I3: Number, B2: Number, B3: Number, omega2: Number, omega3: Number
) -> tuple[Number, tuple[Number, Number], Number, Number]:
    """Return (omega3, (x, y) along the precession's axis, k, phi): rates in rad/time, x and y along e2 and e3.

    I2, I3 are the moments in one unit, B2, B3 the components of B' in 1/time, the start is (0, omega2, omega3).
    ``case`` is one of `CASES`. In the first FREE_CASES of them omega3 is the input, in the others (71) gives it,
    and the input ``omega3`` is ignored.
    """
    if case == "free body":
        axis_vector = omega2, I3 * omega3 / I2
        return omega3, axis_vector, length(*axis_vector), (I2 - I3) * omega3 / I2
    if case == "spin along the field":
        return omega3, (B2, B3), omega2, omega3
    k = precession(B2, B3, omega2)
    if case in CASES[:FREE_CASES]:
        return omega3, (B2, B3), k, omega3 + B3
    curve = I2, I3, B2, B3, omega2
    return ordinate(*curve), (B2, B3), k, proper(*curve)


def scalars(case: str, *inputs: Number) -> tuple[Number, ...]:
    """Return (omega3, k, phi, I omega3) in rad/time, I = I3/I2, of the motion in one of `CASES`.

    ``inputs`` are I2, I3, B2, B3, omega2, omega3.
    """
    omega3, _, k, phi = constants(case, *inputs)
    return omega3, k, phi, inputs[1] * omega3 / inputs[0]


def turning(case: str, *inputs: Number) -> tuple[tuple[Number, Number], Number, Number]:
    """Return ((x, y) along the axis, k, phi), rates in rad/time, see `constants`; ``case`` is one of `CASES`.

    ``inputs`` are I2, I3, B2, B3, omega2, omega3.
    """
    return constants(case, *inputs)[1:]


def conserved(case: str, *inputs: Number) -> tuple[Number, ...]:
    """Return E', (36), K^2, (37), c3, (40), c5, (41), and (m, B')/I2, (88), of the motion from (0, omega2, omega3).

    ``inputs`` are I2, I3, B2, B3, omega2, omega3; ``case`` is one of `CASES`.
    """
    I2, I3, B2, B3, omega2, _ = inputs
    zero, omega3 = B2 - B2, constants(case, *inputs)[0]
    state, factors = (I3 / I2, (zero, omega2, omega3), (zero, B2, B3)), ((I2 - I3) / I2, (I2 + I2 - I3) / I2)
    return *integrals(*state, factors), along_field(*state)


def quotient(I2: Number, I3: Number, B2: Number, B3: Number, omega2: Number) -> Number:
    """Return omega3 = I2 omega2 B3/(I3 B2), in rad/time, of the free body beside the charged one, above (87).

    Both precess with the same k about the same axis; B2 is not zero.
    """
    return I2 * omega2 * B3 / (I3 * B2)


def axis_and_rates(I2: Number, I3: Number, *omega: Number) -> tuple[Vector, Number, Number]:
    """Return (m/I2, three components, k, phi) of a free body, all in rad/time, k = |m|/I2.

    ``omega`` are the three components of Omega(0).
    """
    w1, w2, w3 = omega
    momentum = w1, w2, I3 * w3 / I2
    return momentum, length(*momentum), (I2 - I3) * w3 / I2
