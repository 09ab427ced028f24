"""The constants of a charged ball's motion, (29), from I0, alpha, m2 and m3."""

from atlas.arithmetic.numbers import Number, length


def turning(I0: Number, alpha: Number, m2: Number, m3: Number) -> tuple[tuple[Number, Number], Number, Number]:
    """Return a vector along k_hat, gamma and alpha, (29)."""
    total3 = m3 + alpha * I0
    return (-m2, -total3), length(m2, total3) / I0, alpha


def rates(I0: Number, m2: Number, m3: Number) -> tuple[Number, Number]:
    """Return the components m/I0 of the initial angular velocity."""
    return m2 / I0, m3 / I0
