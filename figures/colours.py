"""The colours of the figures.

A vector, a curve or a body has the same colour in the whole atlas; this is the key to all of its figures.
"""

import numpy as np

from atlas.pictures import Arrow, Curve, Label, Layer, Points, Scene, solids
from atlas.pictures.arrange import stacked
from atlas.pictures.quadric_panel import E2, E3, in_plane

ROW = "a body"
SEEN = "Each vector, curve and body keeps its colour in all figures."
COLUMN, ROW_HEIGHT, LENGTH = 6.2, 1.0, 1.0
VECTORS = (
    ("field", r"$\mathbf{B}$ and $\mathbf{B}'$"),
    ("field_inverse", r"$\mathrm{I\!I}^{-1}\mathbf{B}'$"),
    ("electric", r"$\mathbf{E}$"),
    ("momentum", r"$\mathbf{m}$"),
    ("direction", r"$\mathbf{n}$ of a top"),
    ("velocity", r"$\boldsymbol{\omega}$, $\boldsymbol{\Omega}$, a rotation"),
    ("body_axis", r"the body's axis $\mathbf{R}_3$"),
)
CURVES = (
    ("hyperbola", "elementary"),
    ("trace", r"path of $\mathbf{R}_3$"),
    ("second_trace", r"path of $\mathbf{R}_1$"),
    ("trajectory", "path of a point"),
    ("unstable", "unstable"),
    ("asymptote", "asymptote, law"),
)
COMPONENTS = (("main", "first component"), ("second", "second component"), ("third", "third component"))
BODIES = (
    ("loop_body", "a loop"),
    ("short_body", "a short solenoid"),
    ("ball_body", "a ball"),
    ("long_body", "a long solenoid"),
)
MARKS = (
    ("rest", "rest"),
    ("centre", r"$-\mathbf{B}'$"),
    ("special", r"$-2\mathbf{B}'$"),
    ("unstable_point", "an unstable motion"),
)


def scene() -> Scene:
    """Draw each role that has a colour of its own beside its meaning, in four columns."""
    columns: list[list[Layer]] = [[], [], [], []]
    for row, (role, name) in enumerate(VECTORS):
        tail, tip = place(0, row)
        columns[0] += [Arrow(tail, tip, role), meaning(tip, name)]
    for column, roles in ((1, CURVES), (2, COMPONENTS), (3, BODIES)):
        for row, (role, name) in enumerate(roles):
            ends = place(column, row)
            columns[column] += [Curve(ends, role), meaning(ends[1], name)]
    for row, (role, name) in enumerate(MARKS, len(COMPONENTS)):
        ends = place(2, row)
        columns[2] += [Points(ends.mean(axis=0)[None], role), meaning(ends[1], name)]
    for row, (role, name) in enumerate((("surface", "initial data"), ("solid", "the body")), len(BODIES)):
        ends = place(3, row)
        half = 0.5 * (ends[1] - ends[0])
        columns[3] += [solids.rectangle(ends.mean(axis=0), half, 0.3 * E3, role=role), meaning(ends[1], name)]
    return Scene(
        caption="In grey print a vector is recognised by its name; two lines of a "
        "column differ in lightness, width or dashes, and marks in shape. The colours of bodies are for figures in "
        "which they are compared. Elementary motions are initial angular velocities, and have their hue.",
        alt="Four columns of arrows, lines and marks in their colours, each with its meaning: B crimson, its image "
        "under the inverse inertia tensor pink, E blue, m green, the direction n of a top gold, angular velocities "
        "plum, the elementary motions violet, the body's axis and its path navy, the path of a point teal, the "
        "unstable motions vermilion, a loop magenta, a short solenoid petrol, a ball olive, a long solenoid dark "
        "brown.",
        panels=stacked(columns, 1, 0.0, 0.0),
        size=(178.0, 52.0),
        narrow=stacked(columns, 2, 0.0, 0.0),
    )


def place(column: int, row: int) -> np.ndarray:
    """Return the two ends, (2, 3), of the sample line in a column and a row, both from 0."""
    return in_plane(COLUMN * column, -ROW_HEIGHT * row) + np.outer([0.0, LENGTH], E2)


def meaning(end: np.ndarray, name: str) -> Label:
    """Return the `Label` of a sample, the text `name` to the right of its end (3,)."""
    return Label(end, name, "label", (5.0, 0.0))
