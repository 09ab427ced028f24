"""The eye of a panel in space: which way is right, up and towards the reader."""

import numpy as np
from numpy.typing import NDArray

from atlas.scene.layers import Space


def frame(space: Space) -> NDArray[np.float64]:
    """Return the rows right, up, towards the eye, in (e1, e2, e3)."""
    a, e = np.radians(space.azimuth), np.radians(space.elevation)
    towards = (np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e))
    right = (-np.sin(a), np.cos(a), 0.0)
    up = (-np.sin(e) * np.cos(a), -np.sin(e) * np.sin(a), np.cos(e))
    return np.array([right, up, towards])
