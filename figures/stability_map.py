"""Where elementary motions can be unstable.

With tau = |B3/B2| the least nutation frequency squared along the hyperbola (67) is, in units of B2^2,

    least = 2 tau sqrt(1 + tau^2) |1-I| - (1-I)(1 - 2 tau^2),        at x^2 = tau |1-I|/sqrt(1 + tau^2),

negative for I < 1 and tau < 1/(2 sqrt 2) only: there its root is the greatest rate of growth. Not in the paper. Each
pixel is a row of a table.
"""

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.errors import DomainError
from atlas.pictures import Curve, Image, Label, Layer, Plane, Scene
from atlas.pictures.sample import flat
from atlas.sweeps.plan import Range, Tabulation

WIDTH, HEIGHT, MARGIN = 120.0, 70.0, 12.0
EDGE = 1.0 / (2.0 * np.sqrt(2.0))
TOP = 0.6
CELLS = (160, 96)
NARROWEST = 120.0
BODIES = ((0.0, "needle"), (0.5, "long solenoid"), (1.0, "sphere"), (1.5, "short solenoid"), (2.0, "loop"))
ASIDE, UP = 0.1, 0.035
"""How far the names stand inside the map, in units of I and tau."""


def scene(*, rates: tuple[float, ...] = (0.2, 0.4, 0.6, 0.8)) -> Scene:
    """Draw where the greatest growth rate, or the least frequency, is one of ``rates`` times |B2|."""
    if not all(0.0 < rate < 1.0 for rate in rates):
        raise DomainError(f"rates of figure stability_map lie between 0 and 1, in units of |B2|, not {rates}.")
    growth, rising = mapped(1.0, EDGE, -1.0, r"$\sqrt{-\nu_n^2}/|B'_2|$")
    frequency, waving = mapped(2.0, TOP, 1.0, r"$\nu_n/|B'_2|$")
    unstable: list[Layer] = [rising]
    stable: list[Layer] = [
        waving,
        Curve(np.array([[0.0, EDGE], [1.0, EDGE], [1.0, 0.0]]), "unstable"),
        Label(np.array([0.5, 0.5 * EDGE]), "some unstable: (a)"),
        *(Curve(np.array([[I, 0.0], [I, TOP]]), "guide") for I, _ in BODIES if 0 < I < 2),
    ]
    for rate in rates:
        growing = level(-(rate**2), -1)
        unstable += [Curve(growing, "map_curve"), Label(growing[len(growing) // 2], f"${rate:g}$")]
        for line in filter(len, (level(rate**2, side) for side in (-1, 1))):
            stable += [Curve(line, "map_curve"), Label(on(line, rate), f"${rate:g}$")]
    stable += [Label(np.array([np.clip(I, ASIDE, 2.0 - ASIDE), UP]), name) for I, name in BODIES]
    views = ((0.0, 1.0), (0.0, EDGE)), ((0.0, 2.0), (0.0, TOP))
    names = "(a) greatest rate of growth", "(b) least nutation frequency"
    return Scene(
        caption=(
            r"The worst elementary motion of a body over $I$ and $\tau=\lvert B'_3/B'_2\rvert$. (a) Where some are "
            r"unstable: the greatest rate of growth, "
            r"$-\nu_n^2/{B'_2}^2=(1-I)[1-2\tau^2-2\tau\sqrt{1+\tau^2}]$. (b) Where all are stable: the least frequency "
            r"of their nutation."
        ),
        alt=(
            "Two maps over I and tau. The rate of growth, for I up to 1 and tau up to 0.354, falls from the lower left "
            "corner to zero at the upper and the right edge. The least nutation frequency, for I up to 2 and tau up to "
            "0.6, is empty there and grows away from that rectangle. Five bodies are named."
        ),
        panels=tuple(
            Plane(tuple(layers), r"$I=I_3/I_2$", r"$\tau=|B'_3/B'_2|$", *view, title=name)
            for layers, view, name in zip((unstable, stable), views, names, strict=True)
        ),
        commands=(growth.command("growth.csv"), frequency.command("frequency.csv")),
        size=(WIDTH, 2 * HEIGHT),
    )


def mapped(wide: float, high: float, sign: float, label: str) -> tuple[Tabulation, Image]:
    """Return the table of the least stability for I up to ``wide`` and tau up to ``high``, and its root as a map.

    Where it does not have the sign the map is empty.
    """
    x, y = np.linspace(0.0, wide, CELLS[0] + 1), np.linspace(0.0, high, CELLS[1] + 1)
    table = Tabulation(
        "hyperbola", {"ratio": Range.middles(x), "B2": 1.0, "B3": Range.middles(y)}, ("least_stability",)
    )
    square = sign * table.columns()["least_stability"].T
    return table, Image(x, y, np.sqrt(np.where(square < 0, np.nan, square)), label)


def on(line: FloatArray, rate: float) -> FloatArray:
    """Return the place of a number on its line: as high on each side as the number, so that none is beside another."""
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
