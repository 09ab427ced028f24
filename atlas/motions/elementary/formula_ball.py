"""The constants of a charged ball's motion, (29), from I0, alpha, m2 and m3."""

from atlas.arithmetic.numbers import Number, length


def turning(I0: Number, alpha: Number, m2: Number, m3: Number) -> tuple[tuple[Number, Number], Number, Number]:
    """Return ((x, y) along k_hat, of any length, gamma, alpha) of (29); x and y are along e2 and e3.

    I0 is the inertia, alpha the Larmor frequency and gamma that of the rotation about k_hat, in rad/time, (0, m2,
    m3) the initial angular momentum. Both x and y are zero for m2 = 0, m3 = -alpha I0.
    """
    total3 = m3 + alpha * I0
    return (-m2, -total3), length(m2, total3) / I0, alpha


def rates(I0: Number, m2: Number, m3: Number) -> tuple[Number, Number]:
    """Return (omega2, omega3) = (m2, m3)/I0, the initial angular velocity in rad/time."""
    return m2 / I0, m3 / I0
