"""A panel with the three components of a vector over time."""

from typing import Any

import numpy as np

from atlas.scene.layers import Curve, Label, Layer, Plane
from atlas.scene.sample import curve, quarter_pixel

MARGIN = 10.0


def course(
    vector: Any,
    names: tuple[str, ...],
    stop: float,
    x_label: str,
    y_label: str,
    heading: str,
    *,
    size: tuple[float, float],
    level: float | None = None,
    level_name: str = "",
    pieces: int = 32,
) -> Plane:
    """Return the panel from t = 0 to `stop`, of that size in millimetres, each line with its name.

    `level` is that of a dashed line across the panel; the lines are first cut into so many `pieces`.
    """
    rough = vector(np.linspace(0.0, stop, 8 * pieces + 1))
    marks = rough if level is None else np.append(rough, level)
    low, high = float(marks.min()), float(marks.max())
    pad = (0.14 if level is None else 0.2) * (high - low) or 0.5 * abs(high) or 1.0
    limits = (low - pad, high + pad)
    wide, high = (size[0] - MARGIN) / stop, (size[1] - MARGIN) / (limits[1] - limits[0])
    scale, fine = np.array([wide, high, high, high]), quarter_pixel(1.0, 1.0)
    path = curve(lambda t: np.column_stack([t, vector(t)]), 0.0, stop, fine, pieces=pieces, scale=scale)
    layers: list[Layer] = [Curve(np.array([[0.0, 0.0], [stop, 0.0]]), "guide")]
    if level is not None:
        layers.append(Curve(np.array([[0.0, level], [stop, level]]), "reference"))
        layers.append(Label(np.array([0.3 * stop, level]), level_name, "reference", (0.0, 3.0)))
    for i, (name, role) in enumerate(zip(names, ("main", "second", "third"), strict=True), 1):
        line = path[:, [0, i]]
        at = line[0.86 * stop <= line[:, 0]][0]
        below = level is not None and 0.0 <= level - at[1] < 3.0 * pad
        layers += [Curve(line, role), Label(at, name, role, (0.0, -4.0 if below else 4.0))]
    return Plane(tuple(layers), x_label, y_label, (0.0, stop), limits, title=heading)
