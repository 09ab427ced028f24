"""Pieces of quadrics from back to front, exactly, along parallel rays.

On the ray x + t d to the eye F = F(x) + B t + A t^2, where A = d.Q.d is one number for the whole picture and
B = grad F . d is linear in x. Let s be the sign of A. A point has a place in front of a quadric:

    0  behind both hits: s F > 0, s B < 0       1  between them: s F < 0       2  before both: s F > 0, s B > 0

and on it, F = 0, one half at the hit farther from the eye (s B < 0), one and a half at the nearer. Along a ray it
never goes down: rays that miss the quadric go from 0 to 2 at B = 0, and for A = 0, as for a plane, the other hit is
infinitely far away. So the sum of the places in front of all quadrics goes up from hit to hit of every ray. Painted in
the order of this sum, translucent surfaces need no depth peeling, once they are cut where a place changes: at B = 0,
and where two of them meet.
"""

from collections.abc import Callable, Sequence

import numpy as np

from atlas.draw.hidden import values
from atlas.draw.outline import facing
from atlas.scene.layers import FloatArray, Surface

Field = Callable[[FloatArray], FloatArray]

_ON = 1e-9


def distinct_forms(surfaces: Sequence[Surface]) -> tuple[list[FloatArray], list[int]]:
    """Return the quadrics without repetition, and for each surface the number of its own."""
    forms: list[FloatArray] = []
    numbers = []
    for surface in surfaces:
        same = (k for k, form in enumerate(forms) if np.abs(form - surface.quadric).max() <= _ON)
        number = next(same, len(forms))
        if number == len(forms):
            forms.append(surface.quadric)
        numbers.append(number)
    return forms, numbers


def cut(corners: FloatArray, forms: Sequence[FloatArray], own: int, towards: FloatArray) -> FloatArray:
    """Return triangles (T, 3, K) cut so that each has one place in front of every quadric.

    The first three of the K numbers of a corner are a point of the quadric number ``own``; the others come along.
    """
    for number, form in enumerate(forms):
        corners = _cut(corners, lambda x, form=form: facing(form, x, towards))
        if number != own:
            corners = _cut(corners, lambda x, form=form: values(form, x))
    return corners


def places(corners: FloatArray, forms: Sequence[FloatArray], own: int, towards: FloatArray) -> FloatArray:
    """Return the sum of the places (T,) of triangles that `cut` has made."""
    total = np.zeros(len(corners))
    for number, form in enumerate(forms):
        sign = 1.0 if towards @ form[:3, :3] @ towards >= 0.0 else -1.0
        before = sign * facing(form, corners[..., :3], towards).sum(axis=1) > 0.0
        inside = (
            np.zeros(len(corners)) if number == own else sign * _snapped(values(form, corners[..., :3])).sum(axis=1)
        )
        total += np.where(inside == 0.0, before + 0.5, np.where(inside < 0.0, 1.0, 2.0 * before))
    return total


def _snapped(heights: FloatArray) -> FloatArray:
    """Return the heights, zero where they are zero but for rounding; panels have the size one, and so have forms."""
    return np.where(np.abs(heights) <= _ON, 0.0, heights)


def _cut(corners: FloatArray, field: Field) -> FloatArray:
    """Return triangles (T, 3, K) cut where a field of their points, at most of second order, is zero."""
    height = _snapped(field(corners[..., :3]))
    above, below = height > 0.0, height < 0.0
    split = above.any(axis=1) & below.any(axis=1)
    if not split.any():
        return corners
    alone = np.where((above.sum(axis=1) == 1)[:, None], above, below)[split]
    turn = (np.argmax(alone, axis=1)[:, None] + np.arange(3)) % 3
    row = np.arange(len(turn))[:, None]
    a, b, c = (corners[split][row, turn][:, k] for k in range(3))
    u, v, w = height[split][row, turn].T
    p, q = _between(a, b, u, v, field), _between(a, c, u, w, field)
    parts = [np.stack(part, axis=1) for part in ((a, p, q), (p, b, c), (p, c, q))]
    return np.concatenate([corners[~split], *parts])


def _between(a: FloatArray, b: FloatArray, u: FloatArray, v: FloatArray, field: Field) -> FloatArray:
    """Return the points between a and b (N, K) where a field with the values u and v there is zero."""
    middle = field(0.5 * (a + b)[:, :3])
    square, slope = 2.0 * (u - 2.0 * middle + v), 4.0 * middle - 3.0 * u - v
    with np.errstate(all="ignore"):
        half = -0.5 * (slope + np.copysign(np.sqrt(slope * slope - 4.0 * square * u), slope))
        first, second = half / square, u / half
    share = np.where((first >= 0.0) & (first <= 1.0), first, second)
    share = np.where(v == 0.0, 1.0, np.clip(share, 0.0, 1.0))
    return a + share[:, None] * (b - a)
