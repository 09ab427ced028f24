"""Dimensions of the paper's letters as powers of (length, time, mass, charge), for the check of dimensions.

Gaussian units, where E and B are of one kind and c stands in the force. One letter may mean different things in
different sections; so each section has its own list.
"""

Power = tuple[int, int, int, int]

PLAIN: Power = (0, 0, 0, 0)
LENGTH, TIME, MASS = (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0)
SPEED, ACCELERATION, RATE, RATE2 = (1, -1, 0, 0), (1, -2, 0, 0), (0, -1, 0, 0), (0, -2, 0, 0)
FIELD, INERTIA, MOMENTUM, ENERGY = (1, -2, 1, -1), (2, 0, 1, 0), (2, -1, 1, 0), (2, -2, 1, 0)


def _all(kinds: dict[str, Power]) -> dict[str, Power]:
    """Spread "a b c": power over the letters a, b, c."""
    return {letter: power for letters, power in kinds.items() for letter in letters.split()}


PHYSICAL = _all(
    {"mu": (0, 0, -1, 1), "c light": SPEED, "E Bf b": FIELD, "t": TIME, "eps delta one R": PLAIN, "dR": RATE}
)

PARTICLES = PHYSICAL | _all(
    {
        "y x": LENGTH,
        "dy dx dy0": SPEED,
        "ddy ddx ddy0 lami": ACCELERATION,
        "m mu0": MASS,
        "lam": (0, -2, 1, 0),
        "a": (2, 0, 0, 0),
        "A": RATE2,
        "g": INERTIA,
        "total": (1, 0, 1, 0),
        "L lamM ddRg": ENERGY,
    }
)

PARTICLE = PHYSICAL | _all(
    {
        "e": (0, 0, 0, 1),
        "m": MASS,
        "Epar Eperp E2": FIELD,
        "y ypar yperp y1 y2 a x ypar0 y0": LENGTH,
        "v dy C Cpar Cperp dypar dyperp dy1 dy2 drift": SPEED,
        "ddy": ACCELERATION,
        "omega": RATE,
        "omega0 e1 e2": PLAIN,
        "A0 A": (2, -2, 1, -1),
        "L U": ENERGY,
    }
)

BODY = PHYSICAL | _all(
    {"Omega": RATE, "w A": RATE2, "I g": INERTIA, "G3": PLAIN, "Lam IdOmega ddRg dm dM": ENERGY, "m M": MOMENTUM}
)

BALL = PHYSICAL | _all(
    {
        "alpha gamma Omega dRj": RATE,
        "dOmega": RATE2,
        "k2 k3 Rj": PLAIN,
        "I0": INERTIA,
        "m m2 m3": MOMENTUM,
        "dm": ENERGY,
    }
)

ELEMENTARY = _all(
    {
        "omega2 omega3 k phi B2 B3 c Omega Omega0 Omega1 Omega2 K b kB phiB Bp c_1 c_2 c_3": RATE,
        "hB2 hB3 hat_B amp k0 pi I gamma1 gamma2 gamma3 start1 start2 start3 R P Q eps one": PLAIN,
        "t": TIME,
        "I2 I3 J g": INERTIA,
        "m": MOMENTUM,
        "dm": ENERGY,
    }
)

_COMMON = _all({"omega1 omega2 omega3 B2 B3 phi": RATE, "I pi beta": PLAIN})

OSCILLATOR = _COMMON | _all(
    {
        "Omega1 Omega2 Omega3 K1 K2 K3 c3 u a2 phip": RATE,
        "c5 E a1 Bsquare dOmega1 dOmega2 dOmega3 dK1 dK2 nu1 nu2": RATE2,
        "a0 ddOmega3": (0, -3, 0, 0),
        "a3 f0 Phi phi0": PLAIN,
    }
)

QUADRIC = _COMMON | _all({"w1 w2 w3": RATE, "a2 a3 sign": PLAIN, "C1s C2s C3s": RATE2})
