"""The curve v^2 = P(z) = prod(z + D/I_i), which a body's moments make, and its ovals."""

from flint import fmpq

from atlas.errors import DomainError
from atlas.formulas.numbers import nearest

Vector = tuple[fmpq, ...]

ROUNDING = fmpq(1, 2**48)
"""By so much of itself the largest moment of a plane body may exceed the sum of the others."""


def check_moments(moments: Vector) -> None:
    """Raise DomainError for what are no moments of a body."""
    shown = ", ".join(str(nearest(I)) for I in moments)
    if min(moments) <= 0:
        raise DomainError(f"No body has the moments of inertia {shown}: all three are positive.")
    if max(moments) * (2 - ROUNDING) > sum(moments):
        raise DomainError(f"No body has the moments of inertia {shown}: the largest is at most the sum of the others.")


def square_of_v(moments: Vector, z: fmpq) -> fmpq:
    """Return v^2 = prod(z + D/I_i); DomainError where it is not positive."""
    D = moments[0] * moments[1] * moments[2]
    zeros = sorted(-D / I for I in moments)
    if not (z > zeros[2] or zeros[0] < z < zeros[1]):
        low, middle, high = map(nearest, zeros)
        oval = f" and between {low} and {middle}" if zeros[0] < zeros[1] else ""
        raise DomainError(
            f"There is no elliptic motion with z = {nearest(z)}: v^2 = prod(z + D/I_i) is positive for z above "
            f"{high}{oval}, the ends excluded."
        )
    return (z - zeros[0]) * (z - zeros[1]) * (z - zeros[2])
