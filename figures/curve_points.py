"""Points drawn against the error of the drawn curve.

Drawn from a stored record: curves of the atlas, cut until their chords are as near as asked, and the same number of
points at equal steps.
"""

import numpy as np

from atlas.scene import Curve, Label, Layer, Plane, Points, Scene
from atlas.scene.words import listed, plain, tex, title
from atlas.study.curves import Row, read

RECORDS = ("curves.json",)
DEFAULT = 0.25


def scene() -> Scene:
    """Draw one panel for each curve of the record, all on the same axes."""
    found = read().curves
    rows = [row for group in found.values() for row in group]
    saved = {name: 1.0 - group[-1].points / group[-1].even_points for name, group in found.items()}
    best, finest = max(saved, key=lambda name: saved[name]), rows[-1].tolerance
    counts = [count for row in rows for count in (row.points, row.even_points)]
    errors = [error for row in rows for error in (row.tolerance, row.error, row.even_error)]
    limits = ((min(10.0, 0.8 * min(counts)), 1.5 * max(counts)), (0.7 * min(errors), 2.0 * max(errors)))
    quarter = {name: next(row for row in group if row.tolerance == DEFAULT) for name, group in found.items()}
    listing = listed([f"{row.points} for the {name}" for name, row in quarter.items()])
    return Scene(
        title=title(__doc__),
        caption=(
            "The largest distance between a curve and the polyline that is drawn for it, in pixels of a figure with "
            "300 dots an inch, against the number of its points. Heavy line: cut until the chords are as near as "
            "asked; a circle marks the tolerance asked, and a dot below it the error that was left. Dashed line: "
            r"equal steps of $\omega_2$ for the hyperbola, of time for the trace and the trochoid, and of the "
            "hyperbolic angle for the outline. A trace that is a circle bends evenly, and equal steps are the best "
            f"there are. To a quarter of a pixel, dotted, which is what figures are drawn to, it takes {listing}."
        ),
        alt=(
            f"{len(found)} panels with two logarithmic axes, the number of points to the right and the largest error "
            f"upwards: {listed(list(found))}. All lines fall with the square of the number of points. The error left "
            f"is below the tolerance everywhere; for a tolerance of {plain(finest)} pixels the {best} "
            f"takes {plain(round(100.0 * saved[best]))} per cent fewer points than equal steps with the same error."
        ),
        panels=tuple(
            panel(f"({chr(ord('a') + order)}) {name}", group, limits, order)
            for order, (name, group) in enumerate(found.items())
        ),
        columns=2,
        size=(178.0, 112.0),
    )


def panel(heading: str, rows: list[Row], limits: tuple[tuple[float, float], tuple[float, float]], order: int) -> Plane:
    """Draw the errors by tolerance and by equal steps, and the tolerances; the first two panels have the names."""
    asked, left, even = (
        np.array([(row.points, getattr(row, name)) for row in rows]) for name in ("tolerance", "error", "even_error")
    )
    layers: list[Layer] = [
        Curve(np.array([[limits[0][0], DEFAULT], [limits[0][1], DEFAULT]]), "limit"),
        Curve(even, "second"),
        Curve(left, "main"),
        Points(asked, "rest"),
        Points(left, "start"),
    ]
    if order == 0:
        layers += [
            Label(even[-1], "equal steps", "second", (6.0, 0.0)),
            Label(left[-1], "cut to a tolerance", "main", (6.0, 0.0)),
            Label(np.array([limits[0][1], DEFAULT]), rf"${tex(DEFAULT)}$ pixel", "note", (-24.0, 6.0)),
        ]
    if order == 1:
        layers.append(Label(asked[0], "tolerance asked", "label", (6.0, 0.0)))
    return Plane(
        tuple(layers),
        x_label="points" if order >= 2 else "",
        y_label="largest error (pixels)" if order % 2 == 0 else "",
        x_limits=limits[0],
        y_limits=limits[1],
        x_scale="log",
        y_scale="log",
        title=heading,
    )
