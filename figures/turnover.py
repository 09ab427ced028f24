"""Rest is not stable.

A body of three different moments at rest in the field is pushed. Its place in the field belongs to a whole curve of
places in which it could rest as well, and it runs along it, the slower the smaller the push, and just as far: against
the push times the time, the curves of all small pushes are one.
"""

from typing import Literal

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.errors import DomainError
from atlas.motions.torus.kernel import AsymmetricMotion
from atlas.pictures import Curve, Label, Plane, Scene
from atlas.pictures.captions import plain, tex, tex_vector

ROW = "three moments"
SEEN = "A body at rest turns over after any push: after a small one later, but just as far."
WIDTH, HEIGHT = 178.0, 62.0
POINTS = 600
ROLES = ("main", "second", "third")
RANGES = {"reach": (0.1, 100.0)}


def scene(
    *,
    inertia: tuple[float, float, float] = (0.5, 1.0, 1.25),
    field: tuple[float, float, float] = (0.25, 0.75, 0.375),
    pushes: tuple[float, ...] = (1e-3, 1e-2, 1e-1),
    reach: float = 12.0,
) -> Scene:
    """Draw how far K is from its start for each of ``pushes``, angular velocities about e2 in rad/time.

    K is the field in the body; time goes from 0 to ``reach`` divided by the push. ``inertia`` are the principal
    moments, ``field`` is B' along the principal axes, in 1/time. Raises DomainError for equal moments, without a
    field, and unless there are one to three pushes of at most 1.
    """
    if not 0 < len(pushes) <= len(ROLES) or not all(0 < abs(push) <= 1 for push in pushes) or not any(field):
        raise DomainError(
            f"figure turnover takes one to three pushes, from 0 to 1, and a field, not {pushes} and {field}."
        )
    if len(set(inertia)) == 1:
        raise DomainError(
            f"figure turnover needs moments that are not all equal, not {inertia}: a ball does not run away."
        )
    smallest, largest = min(pushes, key=abs), max(pushes, key=abs)
    b = float(np.linalg.norm(field))
    curves = [(push, departure(inertia, field, push, reach)) for push in pushes]
    farthest = float(dict(curves)[smallest][:, 1].max())
    named_curves = [
        (role, rf"$s={tex(push)}$", push, points) for role, (push, points) in zip(ROLES, curves, strict=False)
    ]
    in_time = [Curve(points[1:] * (b / abs(push), 1.0), role, name) for role, name, push, points in named_curves]
    in_turns = [Curve(points, role, name) for role, name, _, points in named_curves]  # dashes over the solid line
    over_time, over_turns = (0.01 * reach * b / abs(largest), reach * b / abs(smallest)), (0.0, reach)
    return Scene(
        caption=(
            r"In (b) the curves of small pushes coincide. The distance of the "
            r"field in the body from its initial value, for "
            rf"$I_i={tex_vector(inertia)}$ in $\mathbf{{B}}'={tex_vector(field)}$, $b=\lvert\mathbf{{B}}'\rvert$, "
            rf"pushed about $\mathbf{{e}}_2$ with $s$. With $s={tex(smallest)}$ it reaches ${tex(round(farthest, 2))}$."
        ),
        alt=(
            f"Curves of a distance for pushes {', '.join(map(plain, pushes))}, in two panels: against the time, where "
            "those of small pushes rise later, and against the push times the time, where they are one curve, which "
            f"rises from 0 to {plain(round(farthest, 2))}."
        ),
        panels=(
            panel("(a) against time", "$bt$", over_time, in_time, log=True),
            panel("(b) against push times time", "$st$", over_turns, in_turns, log=False),
        ),
        columns=2,
        size=(WIDTH, HEIGHT),
    )


def panel(title: str, x_label: str, view: tuple[float, float], curves: list[Curve], *, log: bool) -> Plane:
    """Return a `Plane` of the distances over one measure of time, with a line at 2: the body upside down.

    `view` is (first, last) abscissa, `curves` are the distances |K - K(0)|/b; with `log` the abscissa is logarithmic.
    """
    top = Curve(np.array([[view[0], 2.0], [view[1], 2.0]]), "limit")
    name = Label(np.array([view[0], 2.0]), "upside down", "note", (6.0, -6.0))
    scale: Literal["log", "linear"] = "log" if log else "linear"
    y_label = r"$|\mathbf{K}-\mathbf{B}'|/b$"
    return Plane((top, name, *curves), x_label, y_label, view, (0.0, 2.1), scale, title=title)


def departure(
    inertia: tuple[float, float, float], field: tuple[float, float, float], push: float, reach: float
) -> FloatArray:
    """Return the points (s t, |K - K(0)|/b), shape (N, 2), of the body pushed to omega = (0, s, 0), s = ``push``.

    `inertia` and `field` are as in `scene`, b is the field's length; s t goes from 0 to `reach`.
    """
    times = np.linspace(0.0, reach, POINTS)
    K = AsymmetricMotion(inertia, field, (0.0, push, 0.0)).field_in_body(times / abs(push))
    return np.column_stack([times, np.linalg.norm(K - np.array(field), axis=1) / np.linalg.norm(field)])
