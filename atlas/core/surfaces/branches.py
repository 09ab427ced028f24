"""What curves of two branches share."""

from typing import Any

from atlas.core.inputs import FloatArray, whole

Branch = tuple[FloatArray, FloatArray]
"""Points (omega2, omega3) of one branch."""


def halves(points: Any) -> tuple[int, int]:
    """Split a number of points between two branches."""
    count = whole(points, "The number of points of two branches", 2)
    return count - count // 2, count // 2
