"""Error of R over the initial data and time.

Each cell is one motion at one time, a row of a table: the largest error in any entry of R, against a ball with a proven
radius.
"""

from typing import Literal

import numpy as np

from atlas.checking.error_maps import ErrorMap, over_omega2, over_ratio
from atlas.pictures import Image, Label, Plane, Scene
from atlas.pictures.captions import tex, tex_setting

ROW = "a body"
SEEN = "The map is bright where (84), written as it stands, loses digits."
LIMITS = (1e-17, 1.0)
LOW = 1e-2
TIME = r"$t\,|\mathbf{B}'|$"


def scene(*, ratio: float = 1.5, field: tuple[float, float] = (1.0, 2.0), omega2: float = 0.7) -> Scene:
    """Draw two maps, over omega2 and over I, of the plain formula."""
    omega2_errors, ratio_errors = over_omega2(ratio, field), over_ratio(field, omega2)
    measured = np.concatenate([omega2_errors.ours.ravel(), ratio_errors.ours.ravel()])
    largest_error, sign = np.nanmax(measured), float(np.sign(field[0]))
    empty = " A cell without colour has a phase beyond $2^{50}$." if np.isnan(measured).any() else ""
    return Scene(
        caption=(
            r"Largest error in any entry of $R(t)$ in "
            r"double precision for "
            rf"{tex_setting(ratio, field)}: (a) over $\omega_2$, (b) over $I$ at $\omega_2={tex(omega2)}$. At the same "
            rf"times the atlas errs by at most ${tex(float(f'{largest_error:.1e}'))}$.{empty}"
        ),
        alt=(
            "Two maps of error, from 1e-17 to 1, with time upwards on a logarithmic scale. The error rises with time "
            f"up to 1; the largest error of the atlas in the same cells is {largest_error:.1e}."
        ),
        panels=(
            panel(omega2_errors, r"$\omega_2/|B'_2|$", "(a) all motions of a body", "", {-sign: "pole", 0.0: "rest"}),
            panel(ratio_errors, "$I$", "(b) all bodies", "largest error", {3e-3: "needle", 1.0: "ball"}, "log"),
        ),
        columns=2,
        commands=(omega2_errors.table.command("omega2.csv"), ratio_errors.table.command("ratio.csv")),
        size=(178.0, 72.0),
    )


def panel(
    errors: ErrorMap,
    x_label: str,
    name: str,
    label: str,
    places: dict[float, str],
    x_scale: Literal["linear", "log"] = "linear",
) -> Plane:
    """Return the `Plane` of one map over x and the time, with words at the values ``places`` of x.

    The map with a ``label`` has the colour bar of both.
    """
    image = Image(errors.x, errors.t, np.maximum(errors.plain, LIMITS[0]), label, "log", LIMITS)
    ends = (float(errors.x[0]), float(errors.x[-1])), (float(errors.t[0]), float(errors.t[-1]))
    words = [Label(np.array([x, LOW]), word) for x, word in places.items()]
    return Plane((image, *words), x_label, TIME if not label else "", *ends, x_scale=x_scale, y_scale="log", title=name)
