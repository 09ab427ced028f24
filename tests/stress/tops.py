"""Regimes of symmetric tops: each a draw of a motion that is hard on the formulas, every border from both sides."""

from collections.abc import Callable, Mapping
from random import Random
from typing import NamedTuple

from stress.regimes import close_to, number, sign, size

TwoNumbers = tuple[float, float]


class Top(NamedTuple):
    """Inputs of `atlas.TopMotion`, I2 = 1."""

    inertia: TwoNumbers
    coupling: TwoNumbers
    direction: TwoNumbers
    omega: tuple[float, float, float]
    linear: float
    quadratic: float


def rate_of(top: Top) -> float:
    """Return the largest rate that enters, of the frame, of the spin and of the potential."""
    I3, (k2, k3) = top.inertia[1], top.coupling
    potential = abs(top.linear) ** 0.5, abs(top.quadratic) ** 0.5
    return max(*map(abs, top.omega), abs(k2), abs(k3) / I3, *potential) or 1.0


def _ordinary(random: Random) -> Top:
    def pair() -> TwoNumbers:
        return number(random), number(random)

    I3 = random.choice((random.uniform(0.05, 2.0), 0.5, 1.0, 2.0))
    coupling = random.choice((pair(), (0.0, 0.0), (0.0, number(random)), (number(random), 0.0)))
    potential = random.choice((pair(), (number(random), 0.0), (0.0, number(random)), (0.0, 0.0)))
    return Top((1.0, I3), coupling, pair(), (number(random), number(random), number(random)), *potential)


def _near_the_cubic(random: Random) -> Top:
    """Draw A near zero, on either side."""
    top = _ordinary(random)
    (_, I3), (k2, k3) = top.inertia, top.coupling
    return top._replace(quadratic=close_to(k2 * k2 - k3 * k3 / I3, random))


def _near_the_quadratic(random: Random) -> Top:
    """Draw a and A near zero."""
    top = _ordinary(random)
    (_, I3), (k2, k3), (n2, n3) = top.inertia, top.coupling, top.direction
    M3 = I3 * top.omega[2] + k3 * n3 / (n2 * n2 + n3 * n3) ** 0.5
    return top._replace(
        linear=close_to(-M3 * (k2 - k3 / I3), random), quadratic=close_to(k2 * k2 - k3 * k3 / I3, random)
    )


def _near_the_vertical(random: Random) -> Top:
    top = _ordinary(random)
    tilt = random.choice((0.0, sign(random) * size(random, -16, -1), sign(random) * size(random, -200, -16)))
    slow = size(random, -16, -1)
    omega = random.choice((top.omega, (slow * number(random), slow * number(random), top.omega[2])))
    return top._replace(direction=(tilt, sign(random)), omega=omega)


def _sleeping(random: Random) -> Top:
    """Draw a heavy top near the border of M3^2 = 4 m g l, pushed little."""
    top = _ordinary(random)
    spin = 2 * abs(top.linear) ** 0.5 / top.inertia[1]
    push = size(random, -14, -2)
    return top._replace(
        coupling=(0.0, 0.0), direction=(0.0, 1.0), omega=(push, 0.0, close_to(spin, random)), linear=abs(top.linear),
        quadratic=0.0,
    )  # fmt: skip


def _needle(random: Random) -> Top:
    top = _ordinary(random)
    return top._replace(inertia=(1.0, size(random, -3, -1)))


def _zero_momenta(random: Random) -> Top:
    """Draw a pendulum, or nearly one."""
    top = _ordinary(random)
    return top._replace(coupling=(0.0, 0.0), omega=(top.omega[0], 0.0, random.choice((0.0, size(random, -20, -3)))))


def _scales(random: Random) -> Top:
    top, unit = _ordinary(random), 2.0 ** random.randint(-400, 400)
    (k2, k3), (w1, w2, w3) = top.coupling, top.omega
    return top._replace(
        coupling=(k2 * unit, k3 * unit), omega=(w1 * unit, w2 * unit, w3 * unit), linear=top.linear * unit * unit,
        quadratic=top.quadratic * unit * unit,
    )  # fmt: skip


def _slow_nutation(random: Random) -> Top:
    """Draw a fast spin whose torques nearly cancel: M3, the potential and the push are small, A is near zero."""
    top = _ordinary(random)
    (_, I3), (n2, n3) = top.inertia, top.direction
    k2, k3 = random.choice((0.0, random.uniform(-3, 3))), random.uniform(-9, 9) * 10 ** random.uniform(-1, 2)
    spin = -k3 * n3 / (n2 * n2 + n3 * n3) ** 0.5 / I3 * random.choice((1.0, 1 + 10 ** random.uniform(-16, -3)))
    push = (random.choice((0.0, 10 ** random.uniform(-16, -1))) for _ in range(2))
    small = 10 ** random.uniform(-17, -4)
    return top._replace(
        coupling=(k2, k3), omega=(*push, spin), linear=random.choice((0.0, small)),
        quadratic=(k2 * k2 - k3 * k3 / I3) * random.choice((1.0, 1 + small, 1 - small)),
    )  # fmt: skip


TOPS: Mapping[str, Callable[[Random], Top]] = {
    "top, ordinary": _ordinary,
    "top, near the cubic": _near_the_cubic,
    "top, near the quadratic": _near_the_quadratic,
    "top, axis near the vertical": _near_the_vertical,
    "top, sleeping": _sleeping,
    "top, needle": _needle,
    "top, pendulum": _zero_momenta,
    "top, scales 1e-120 to 1e120": _scales,
    "top, slow nutation under a fast spin": _slow_nutation,
}
"""Regimes of tops."""
