"""Invariants of an elementary motion in floating point.

How well the invariants (36) to (41) and (m, B'), evaluated from the motion (84) that the figures draw, stay what they
are: the largest change so far of each, as a part of the sum of the sizes of its terms.
"""

import numpy as np

from atlas.core.motions.elementary import ElementaryMotion
from atlas.core.motions.integrals import shape_factors
from atlas.scene import Curve, Label, Layer, Plane, Scene
from atlas.scene.captions import listed, plain, plain_setting, tex, tex_setting, title
from atlas.scene.sample import quarter_pixel

WIDTH, HEIGHT, MARGIN = 110.0, 70.0, 12.0
FIRST, LAST = 1e-2, 1e9
ULP = 2.0**-52 / 1e-16
NAMES = ("$E'$", r"$\mathbf{K}^2$", "$c_3$", "$c_5$", r"$(\mathbf{m},\mathbf{B}')$")
ROLES = ("main", "second", "third", "fourth", "sixth")


def scene(
    *,
    ratio: float = 1.5,
    field: tuple[float, float] = (1.0, 2.0),
    omega2: float = 0.7,
    unit: str = "time",
) -> Scene:
    """Draw the changes from a hundredth of a turn to 10^9 of them."""
    motion = ElementaryMotion(ratio, field, omega2)
    rate = max(abs(motion.k), abs(motion.phi)) or 1.0
    times = 2 * np.pi / rate * np.geomspace(FIRST, LAST, round(1 / quarter_pixel(1.0, WIDTH - MARGIN)) + 1)
    first, later, sizes = motion.invariants(), motion.invariants(times), term_sizes(motion)
    layers: list[Layer] = [
        Curve(np.array([[times[0], ULP], [times[-1], ULP]]), "limit"),
        Label(np.array([times[0], ULP]), "$2^{-52}$", "limit", (16.0, 6.0)),
    ]
    top, never = ULP, []
    for (name, value), role, text in zip(first.items(), ROLES, NAMES, strict=True):
        change = np.maximum.accumulate(np.abs(later[name] - value)) / (sizes[name] or 1.0) / 1e-16
        corner = np.flatnonzero(np.diff(change, prepend=np.nan))
        steps = np.repeat(corner, 2)
        line = np.stack([np.append(times[steps], times[-1])[1:], change[steps]], axis=1)
        if change[-1] == 0.0:
            never.append(text)
        else:
            layers.append(Curve(line, role, text))
        top = max(top, float(change[-1]))
    return Scene(
        title=title(__doc__),
        caption=(
            rf"The largest change so far of each invariant for {tex_setting(ratio, field)}, $\omega_2={tex(omega2)}$, "
            r"as a part of the sum of the sizes of its terms; dotted, $2^{-52}=2.2\times10^{-16}$."
            + (f" {listed(never)} never change." if len(never) > 1 else f" {never[0]} never changes." if never else "")
            + r" Nothing grows with time, as it would in a method that steps: each time is evaluated by itself."
        ),
        alt=(
            f"Five lines over the logarithm of time for {plain_setting(ratio, field)} with omega 2 = {plain(omega2)}: "
            "the largest changes so far of five invariants, each at a level of a few times ten to the minus sixteen, "
            "from the first moment to the last."
        ),
        panels=(
            Plane(
                tuple(layers),
                f"$t$ ({unit})",
                r"largest change so far ($10^{-16}$)",
                (float(times[0]), float(times[-1])),
                (0.0, 1.25 * top),
                x_scale="log",
            ),
        ),
        named={"dotted": "limit"},
        size=(WIDTH, HEIGHT),
    )


def term_sizes(motion: ElementaryMotion) -> dict[str, float]:
    """Return the sums of the sizes of the terms of the invariants at t = 0, in the order of `invariants`."""
    I, one_less, two_less = shape_factors(motion.ratio)
    (B2, B3), w2, w3 = np.abs(motion.field), abs(motion.omega2), abs(motion.omega3)
    return {
        "E'": w2 * w2 + I * w3 * w3,
        "K^2": B2 * B2 + B3 * B3,
        "c3": B3 + w3,
        "c5": w2 * B2 + w3 * (abs(one_less) * w3 + two_less * B3),
        "(m,B')": w2 * B2 + I * w3 * B3,
    }
