"""Elementary motions of a needle and the motions with the same integrals that nutate, theorem-companion-range."""

from typing import Any

from atlas.errors import AtlasError
from atlas.report.digits import Number, plain
from atlas.report.schema import StrictStruct
from atlas.report.tables.table import RATE, Column, Data, Request, certified, column


class CompanionParameters(StrictStruct, frozen=True):
    """I3/I2 below 1, and (B2, B3, omega2) of some elementary motions, in 1/s."""

    ratio: float
    motions: tuple[tuple[float, float, float], ...]


def companions(request: Request) -> Data:
    """Return the angles between axis and field of the steady precessions and where their companions turn back."""
    asked = request.take(CompanionParameters)
    found = certified(lambda: [angles(asked.ratio, *motion) for motion in asked.motions], request.digits)
    columns = [column(values, request.digits) for values in zip(*found, strict=True)]
    given = [(f"$(0,{plain(B2)},{plain(B3)})$", Number.given(omega2)) for B2, B3, omega2 in asked.motions]
    return Data(
        (
            Column(r"$\mathbf{B}'$", RATE),
            Column(r"$\omega_2$", RATE),
            Column(r"$\theta$", "degrees"),
            Column(r"$\sqrt c$", RATE),
            Column(r"$\theta_+$", "degrees"),
            Column(r"$\theta_-$", "degrees"),
        ),
        tuple((*first, *rest) for first, rest in zip(given, zip(*columns, strict=True), strict=True)),
        f"Steady precessions of a body with $I={plain(asked.ratio)}$ that others leave and come back to: the angle "
        r"$\theta$ between axis and field, the rate $\sqrt c$ at which a push grows, and the angles $\theta_\pm$ at "
        r"which the companions turn, @theorem-companion-range.",
    )


def angles(ratio: float, B2: float, B3: float, omega2: float) -> tuple[Any, ...]:
    """Return theta, sqrt(c), theta_+ and theta_- in degrees and 1/s, as balls."""
    from flint import arb, fmpq

    I, B2, B3, omega2 = (fmpq(*value.as_integer_ratio()) for value in (ratio, B2, B3, omega2))
    if not (0 < I < 1 and B2):
        raise AtlasError("the companions are those of a body with 0 < I < 1 in a field with B2 other than 0.")
    b2 = B2 * B2 + B3 * B3
    r2, z = B3 * B3 / b2, ((omega2 + B2) / B2) ** 2 / (1 - I)
    c = (I - 1) * b2 * (4 * r2 - (1 - z) * (z - r2) / z) if z else fmpq(-1)
    if not (r2 <= z <= 1 and c >= 0):
        raise AtlasError(f"the elementary motion with omega2 = {omega2} has no companion that comes back to it.")
    r, half = arb(B3) / arb(b2).sqrt(), arb((1 - z) * (z - r2) / z).sqrt()
    theta, above, below = (nu.acos() * 180 / arb.pi() for nu in (r, half - r, -half - r))
    return theta, arb(c).sqrt() if c else fmpq(0), above, below
