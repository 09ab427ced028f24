"""Error of R over the initial data and time.

Each cell is one motion at one time, a row of a table: the largest error in any entry of R, against a ball with a proven
radius.
"""

from typing import Literal

import numpy as np

from atlas.scene import Image, Plane, Scene
from atlas.scene.captions import tex, tex_setting, title
from atlas.study.maps import ErrorMap, over_omega2, over_ratio

LIMITS = (1e-17, 1.0)
NARROWEST = 139.0
TIME = r"$t\,|\mathbf{B}'|$"


def scene(*, ratio: float = 1.5, field: tuple[float, float] = (1.0, 2.0), omega2: float = 0.7) -> Scene:
    """Draw four maps: over omega2 and over I, for the plain formula and for the atlas."""
    first, second = over_omega2(ratio, field), over_ratio(field, omega2)
    measured = np.concatenate([first.ours.ravel(), second.ours.ravel()])
    worst = np.nanmax(measured)
    empty = " A cell without colour has a phase beyond $2^{50}$." if np.isnan(measured).any() else ""
    return Scene(
        title=title(__doc__),
        caption=(
            rf"Largest error in any entry of $R(t)$, (84), for {tex_setting(ratio, field)}: (a, b) over $\omega_2$, "
            rf"(c, d) over $I$ at $\omega_2={tex(omega2)}$. (a, c) The formula in double precision as anyone would "
            rf"write it. (b, d) The atlas: at most ${tex(float(f'{worst:.1e}'))}$.{empty}"
        ),
        alt=(
            "Four maps of error, from 1e-17 to 1, with time upwards on a logarithmic scale. For the plain formula the "
            "error rises with time up to 1; for the atlas both maps are even, "
            f"and the largest error in them is {worst:.1e}."
        ),
        panels=(
            panel(first, first.plain, r"$\omega_2/|B'_2|$", "(a) plain formula"),
            panel(first, first.ours, r"$\omega_2/|B'_2|$", "(b) the atlas"),
            panel(second, second.plain, "$I$", "(c) plain formula", "log"),
            panel(second, second.ours, "$I$", "(d) the atlas", "log"),
        ),
        columns=2,
        commands=(first.table.command("omega2.csv"), second.table.command("ratio.csv")),
        size=(178.0, 140.0),
    )


def panel(
    errors: ErrorMap, values: np.ndarray, x_label: str, name: str, x_scale: Literal["linear", "log"] = "linear"
) -> Plane:
    """Draw one map; all have one scale of colours, which stands beside (b)."""
    label = "error" if name.startswith("(b)") else ""
    image = Image(errors.x, errors.t, np.maximum(values, LIMITS[0]), label, "log", LIMITS)
    ends = (float(errors.x[0]), float(errors.x[-1])), (float(errors.t[0]), float(errors.t[-1]))
    return Plane((image,), x_label, TIME, *ends, x_scale=x_scale, y_scale="log", title=name)
