"""Where elementary motions can be unstable.

With tau = |B3/B2| the least nutation frequency squared along the hyperbola (67) is, in units of B2^2,

    least = 2 tau sqrt(1 + tau^2) |1-I| - (1-I)(1 - 2 tau^2),        at x^2 = tau |1-I|/sqrt(1 + tau^2),

negative for I < 1 and tau < 1/(2 sqrt 2) only: there the root of its magnitude is the greatest rate of growth, drawn as
negative. Not in the paper. Each pixel is a row of a table.
"""

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.errors import DomainError
from atlas.pictures import Curve, Image, Label, Layer, Plane, Scene
from atlas.pictures.sample import flat
from atlas.sweeps.plan import Range, Tabulation

ROW = "its map"
SEEN = "Inside the vermilion line some motions of a body are unstable."
WIDTH, HEIGHT, MARGIN = 120.0, 88.0, 12.0
EDGE = 1.0 / (2.0 * np.sqrt(2.0))
TOP = 0.6
CELLS = (160, 96)
NARROWEST = 120.0
BODIES = ((0.0, "needle"), (0.5, "long solenoid"), (1.0, "ball"), (1.5, "short solenoid"), (2.0, "loop"))
ASIDE, UP = 0.14, 0.035
"""How far the names stand inside the map, in units of I and tau."""


def scene(*, rates: tuple[float, ...] = (0.2, 0.4, 0.6, 0.8)) -> Scene:
    """Draw where the greatest growth rate, or the least frequency of nutation, is one of ``rates`` times |B2|.

    The map is over I = I3/I2 and tau = |B3/B2|. Raises DomainError for rates outside 0 to 1.
    """
    if not all(0.0 < rate < 1.0 for rate in rates):
        raise DomainError(f"rates of figure stability_map lie between 0 and 1, in units of |B2|, not {rates}.")
    x, y = np.linspace(0.0, 2.0, CELLS[0] + 1), np.linspace(0.0, TOP, CELLS[1] + 1)
    inputs = {"ratio": Range.middles(x), "B2": 1.0, "B3": Range.middles(y)}
    table = Tabulation("hyperbola", inputs, ("least_stability",))
    square = table.columns()["least_stability"].T
    root = np.copysign(np.sqrt(np.abs(square)), square)
    layers: list[Layer] = [
        Image(x, y, root, r"frequency, or $-$growth, over $|B'_2|$"),
        *(Curve(np.array([[I, 0.0], [I, TOP]]), "guide") for I, _ in BODIES if 0 < I < 2),
        Curve(np.array([[0.0, EDGE], [1.0, EDGE], [1.0, 0.0]]), "unstable"),
        Label(np.array([0.21, 0.46 * EDGE]), "unstable"),
        Label(np.array([1.75, 0.5 * TOP]), "stable"),
    ]
    for value, side in ((sign * rate, side) for rate in rates for sign, side in ((-1, -1), (1, -1), (1, 1))):
        if len(line := level(value * abs(value), side)):
            layers += [Curve(line, "map_curve"), Label(on(line, abs(value)), f"${value:g}$")]
    layers += [Label(np.array([np.clip(I, ASIDE, 2.0 - ASIDE), UP]), name) for I, name in BODIES]
    return Scene(
        caption=(
            r"There, for $I<1$ and "
            r"$\tau=\lvert B'_3/B'_2\rvert<1/(2\sqrt2)$, the number on a line is minus the greatest rate of growth of "
            r"an elementary motion, from $-\nu_n^2/{B'_2}^2=(1-I)[1-2\tau^2-2\tau\sqrt{1+\tau^2}]$. "
            r"Outside, all elementary motions are stable, and it is the least frequency of their nutation."
        ),
        alt=(
            "A map over I, up to 2, and tau, up to 0.6. The rate of growth, for I up to 1 and tau up to 0.354, falls "
            "from the lower left corner to zero at the upper and the right edge of that rectangle; the least nutation "
            "frequency grows away from the rectangle. Five bodies are named."
        ),
        panels=(Plane(tuple(layers), r"$I=I_3/I_2$", r"$\tau=|B'_3/B'_2|$", (0.0, 2.0), (0.0, TOP)),),
        commands=(table.command("least_stability.csv"),),
        size=(WIDTH, HEIGHT),
    )


def on(line: FloatArray, rate: float) -> FloatArray:
    """Return the point (2,) of a level's line (N, 2) for its number; it is the higher, the larger `rate`.

    The rate is between 0 and 1. So the numbers of neighbouring lines do not collide.
    """
    low, high = line[:, 1].min(), line[:, 1].max()
    return line[int(np.argmin(np.abs(line[:, 1] - low - (0.15 + 0.6 * rate) * (high - low))))]


def level(value: float, side: int) -> FloatArray:
    """Return points (I, tau), shape (N, 2), where the least frequency squared is ``value`` B2^2; empty if nowhere.

    ``side`` is -1 for I < 1, 1 for I > 1. With tau = sinh s the least value is |1-I| (exp(2 s) - 2) for I < 1 and
    (I-1) (2 - exp(-2 s)) for I > 1.
    """

    def point(s: FloatArray) -> FloatArray:
        slope = np.exp(2 * s) - 2 if side < 0 else 2 - np.exp(-2 * s)
        return np.stack([1 + side * value / slope, np.sinh(s)], axis=1)

    top = float(np.arcsinh(TOP))
    start, stop = (0.0, top) if side > 0 else (0.0, np.log(2 + value) / 2)
    if side < 0 < value:
        start, stop = np.log(2 + value) / 2, top
    if start >= stop:
        return np.empty((0, 2))
    return flat(point, start, stop, ((0.0, 2.0), (0.0, TOP)), (WIDTH - MARGIN, HEIGHT - MARGIN))
