"""A motion at one time: the body, what its axis has drawn, and the field; of any motion that has a rotation matrix."""

from typing import Any

import numpy as np

from atlas.core.inputs import FloatArray
from atlas.errors import AtlasError
from atlas.scene import quadric_panel, solids
from atlas.scene.bodies import drawn_body
from atlas.scene.captions import quotient
from atlas.scene.layers import Arrow, Curve, Label, Layer, Scene, Space
from atlas.scene.sample import curve

_FINE = quadric_panel.tolerance(3.0)
_AXIS, _FIELD, _THIN, _FEW, _LONG = 1.35, 1.6, 0.02, 24, 1e12
SIZE = (90.0, 90.0)


def turning(motion: Any, t: float, length: float) -> Scene:
    """Draw a motion at the time t, with the trace of its axis over the ``length`` of time before."""
    R = np.asarray(motion.rotation(t))
    layers: list[Layer] = [*body(motion, R), Arrow(quadric_panel.O, _AXIS * R[:, 2], "body_axis", r"$\mathbf{R}_3$")]
    start = max(0.0, t - length)
    if t > start:
        trace = curve(lambda s: _AXIS * motion.third_axis(s), start, t, _FINE, pieces=_FEW)
        layers.append(Curve(trace, "trace"))
    along = direction(motion)
    if along.any():
        name = r"$\mathbf{n}$" if hasattr(motion, "direction") else r"$\mathbf{B}$"
        layers.append(Arrow(quadric_panel.O, _FIELD * along / np.linalg.norm(along), "field", name))
    layers.append(Label(_FIELD * np.concatenate([np.eye(3), -np.eye(3)]), ""))  # as far as it reaches at any time
    panel = Space(tuple(layers), azimuth=20.0, elevation=15.0, span=(2.0 * _FIELD, 2.0 * _FIELD))
    return Scene(
        title="A motion",
        caption=r"The body, its axis $\mathbf{R}_3$ with the trace of its tip, and the direction of the field.",
        alt="A body with its axis, the line that the tip of that has drawn, and an arrow along the field.",
        panels=(panel,),
        size=SIZE,
    )


def body(motion: Any, R: FloatArray) -> list[Layer]:
    """Return the body of a motion: a shell with its I, or a brick with its three moments."""
    inertia = getattr(motion, "inertia", None)
    if inertia is None or np.ndim(inertia) == 0:
        return drawn_body(quotient(getattr(motion, "ratio", 1.0)), R, quadric_panel.O, 1.0, _FINE)
    if len(inertia) == 2:
        return drawn_body(min(quotient(inertia[1] / inertia[0]), 2.0), R, quadric_panel.O, 1.0, _FINE)
    moments = np.array(inertia, dtype=float)
    sides = np.sqrt(np.maximum(moments.sum() - 2.0 * moments, 0.0))
    sides = np.maximum(sides / np.linalg.norm(sides), _THIN)
    faces = [(i, sign) for i in range(3) for sign in (1.0, -1.0)]
    return [
        solids.rectangle(sign * sides[i] * R[:, i], sides[j] * R[:, j], sign * sides[k] * R[:, k], role="solid")
        for i, sign in faces
        for j, k in [((i + 1) % 3, (i + 2) % 3)]
    ]


def direction(motion: Any) -> FloatArray:
    """Return the direction of the field in space, or of the potential of a top; zero where a motion has none."""
    given = getattr(motion, "direction", getattr(motion, "field", ()))
    return np.array([*[0.0] * (3 - len(given)), *given], dtype=float)


def period(motion: Any) -> float:
    """Return how long a motion takes to come back but for a turn: its period, or that of its precession.

    Raises AtlasError for an array of motions.
    """
    if motion.shape:
        raise AtlasError(f"one motion can be drawn at a time, not an array of the shape {motion.shape}.")
    found = float(getattr(motion, "period", 0.0)) or 2.0 * np.pi / max(abs(float(getattr(motion, "k", 0.0))), 1e-300)
    if np.isfinite(found) and found < _LONG:
        return found
    spin = float(np.linalg.norm(motion.angular_velocity(0.0)))
    return 2.0 * np.pi / spin if spin else 1.0
