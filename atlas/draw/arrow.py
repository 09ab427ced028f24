"""The heads of arrows in space, of one size on paper in a line drawing and in a shaded picture."""

import numpy as np

from atlas.scene.layers import FloatArray
from atlas.scene.style import Style

HEAD_LENGTH, HEAD_WIDTH = 5.0, 0.30
"""Points of paper, and the width of a head in units of its length."""


def head_base(tail: FloatArray, tip: FloatArray, look: Style, scale: float) -> FloatArray:
    """Where the head of an arrow begins; it has one length on paper, but never more than half of the arrow."""
    step = tip - tail
    length = float(np.linalg.norm(step))
    head = min((HEAD_LENGTH + 2.2 * look.width) / scale, 0.5 * length)
    return tip - step * (head / length) if length else tip
