"""Rest is not stable.

A body of three different moments at rest in the field is pushed. Its place in the field belongs to a whole curve of
places in which it could rest as well, and it runs along it, the slower the smaller the push, and just as far: against
the push times the time, the curves of all small pushes are one.
"""

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.errors import DomainError
from atlas.motions.torus.kernel import AsymmetricMotion
from atlas.pictures import Curve, Label, Plane, Scene
from atlas.pictures.captions import plain, tex, tex_vector

WIDTH, HEIGHT = 88.0, 62.0
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
    """Draw how far K is from its start for each of ``pushes``, angular velocities about e2, up to ``reach`` over it."""
    if not 0 < len(pushes) <= len(ROLES) or not all(0 < abs(push) <= 1 for push in pushes) or not any(field):
        raise DomainError(
            f"figure turnover takes one to three pushes, from 0 to 1, and a field, not {pushes} and {field}."
        )
    if len(set(inertia)) == 1:
        raise DomainError(
            f"figure turnover needs moments that are not all equal, not {inertia}: a ball does not run away."
        )
    smallest = min(pushes, key=abs)
    curves = [(push, departure(inertia, field, push, reach)) for push in pushes]
    farthest = float(dict(curves)[smallest][:, 1].max())
    layers = (
        Curve(np.array([[0.0, 2.0], [reach, 2.0]]), "limit"),
        Label(np.array([0.0, 2.0]), "upside down", "note", (6.0, -6.0)),
        *(Curve(points, role, rf"$s={tex(push)}$") for role, (push, points) in zip(ROLES, curves, strict=False)),
    )
    return Scene(
        caption=(
            rf"How far the field in the body is from where it was, for a body with $I_i={tex_vector(inertia)}$ at rest "
            rf"in $\mathbf{{B}}'={tex_vector(field)}$ that is pushed about $\mathbf{{e}}_2$ with the angular "
            rf"velocities $s$, against $st$: the curves of small pushes are one. With ${tex(smallest)}$ it reaches "
            rf"${tex(round(farthest, 2))}$."
        ),
        alt=(
            f"Curves of a distance against the push times the time, for pushes {', '.join(map(plain, pushes))}: those "
            f"of small pushes are one curve, which rises from 0 to {plain(round(farthest, 2))}."
        ),
        panels=(
            Plane(layers, "$st$", r"$|\mathbf{K}-\mathbf{B}'|/b$", (0.0, reach), (0.0, 2.1), legend=True),
        ),
        size=(WIDTH, HEIGHT),
    )  # fmt: skip


def departure(
    inertia: tuple[float, float, float], field: tuple[float, float, float], push: float, reach: float
) -> FloatArray:
    """Return s t and |K - K(0)|/b (N, 2) of the body that is pushed by s."""
    times = np.linspace(0.0, reach, POINTS)
    K = AsymmetricMotion(inertia, field, (0.0, push, 0.0)).field_in_body(times / abs(push))
    return np.column_stack([times, np.linalg.norm(K - np.array(field), axis=1) / np.linalg.norm(field)])
