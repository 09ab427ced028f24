"""Words on a Matplotlib figure: how large they are, and writing them where they were placed."""

import re
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from atlas.render.labels import Tag

if TYPE_CHECKING:
    from matplotlib.figure import Figure


_MATH = re.compile(r"\$[^$]*\$")


def typeset(text: str) -> str:
    """Write primes as the character: mathtext's own superscript floats away from its letter."""
    return _MATH.sub(lambda math: math[0].replace(r"^{\prime}", "′").replace(r"^\prime", "′").replace("'", "′"), text)


def extent(figure: "Figure", text: str, size: float) -> tuple[float, float]:
    """Width and height of a text in printer's points."""
    from matplotlib.text import Text

    probe = Text(0.0, 0.0, typeset(text), fontsize=size, figure=figure)
    box = probe.get_window_extent(figure.canvas.get_renderer())
    return (box.width * 72.0 / figure.dpi, box.height * 72.0 / figure.dpi)


def write(
    figure: "Figure",
    tags: Sequence[Tag],
    centres: Sequence[NDArray[np.float64]],
    corner: tuple[float, float] = (0.0, 0.0),
) -> None:
    """Write the texts with a white halo, centred at places in printer's points from ``corner`` of the figure."""
    from matplotlib.patheffects import withStroke
    from matplotlib.transforms import Affine2D

    points = Affine2D().scale(1.0 / 72.0) + figure.dpi_scale_trans
    for tag, centre in zip(tags, centres, strict=True):
        x, y = centre[0] + corner[0], centre[1] + corner[1]
        text = figure.text(x, y, typeset(tag.text), fontsize=tag.size, color=tag.colour, ha="center", va="center")
        text.set(transform=points, zorder=20.0, path_effects=[withStroke(linewidth=2.2, foreground="white")])
        text.set_in_layout(False)
