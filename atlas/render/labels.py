"""Names beside things: where a label goes so that it covers neither another label nor a line."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

_TURNS = np.radians([0, 20, -20, 40, -40, 65, -65, 90, -90, 120, -120, 150, -150, 180])
_STEPS = (0.0, 3.0, 7.0, 12.0)
_AIR, _APART = 1.2, 4.0


@dataclass(frozen=True)
class Tag:
    """A text of known ``extent`` (width, height) that belongs at ``anchor``; all in printer's points.

    ``offset`` is where it would like to stand as seen from the anchor; (0, 0) means centred there, come what may.
    """

    text: str
    anchor: tuple[float, float]
    offset: tuple[float, float]
    extent: tuple[float, float]
    colour: str
    size: float


def stand(tag: Tag, turn: float = 0.0, step: float = 0.0) -> FloatArray:
    """Return the centre of the text when its offset is turned by ``turn`` and lengthened by ``step``."""
    anchor = np.array(tag.anchor)
    length = float(np.hypot(*tag.offset))
    if length == 0.0:
        return anchor
    angle = np.arctan2(tag.offset[1], tag.offset[0]) + turn
    u = np.array([np.cos(angle), np.sin(angle)])
    half = 0.5 * np.array(tag.extent)
    with np.errstate(divide="ignore"):
        reach = np.min(half / np.abs(u))
    return anchor + (length + step + min(reach, float(np.hypot(*half)))) * u


def place(
    tags: Sequence[Tag], ink: FloatArray, weights: FloatArray, window: tuple[float, float, float, float]
) -> list[FloatArray]:
    """Return the centre of each tag: the cheapest of its candidates, in two rounds, always in the same order.

    ``ink`` (N, 2) are points of what is drawn and ``weights`` (N,) how much it hurts to cover them; ``window`` is
    (left, bottom, right, top).
    """
    centres = [stand(tag) for tag in tags]
    settled = [tag.offset == (0.0, 0.0) for tag in tags]
    for _ in range(2):
        for i, tag in enumerate(tags):
            if tag.offset == (0.0, 0.0):
                continue
            others = [(centres[j], tags[j].extent) for j in range(len(tags)) if j != i and settled[j]]
            candidates = [(stand(tag, turn, step), turn, step) for step in _STEPS for turn in _TURNS]
            costs = [
                _cost(c, tag.extent, others, ink, weights, window) + 1.6 * abs(turn) + 0.35 * step
                for c, turn, step in candidates
            ]
            centres[i] = candidates[int(np.argmin(costs))][0]
            settled[i] = True
    return centres


def _cost(
    centre: FloatArray,
    extent: tuple[float, float],
    others: Sequence[tuple[FloatArray, tuple[float, float]]],
    ink: FloatArray,
    weights: FloatArray,
    window: tuple[float, float, float, float],
) -> float:
    """Return what a text with this centre covers: other texts, ink, and the edge of the window."""
    half = 0.5 * np.array(extent) + _AIR
    low, high = centre - half, centre + half
    cost = 0.0
    for other, size in others:
        reach = 0.5 * np.array(size) + _APART
        overlap = np.minimum(high, other + reach) - np.maximum(low, other - reach)
        if (overlap > 0.0).all():
            cost += 30.0 + float(overlap.prod())
    if ink.size:
        covered = ((ink > low) & (ink < high)).all(axis=1)
        cost += float(weights[covered].sum())
    outside = np.maximum(0.0, [window[0] - low[0], window[1] - low[1], high[0] - window[2], high[1] - window[3]])
    return cost + 40.0 * float(np.sum(outside))


def along(points: FloatArray, step: float = 2.0) -> FloatArray:
    """Return points no further than ``step`` apart on a polyline (N, 2): its ink."""
    finite = points[np.isfinite(points).all(axis=1)]
    if len(finite) < 2:
        return finite
    length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(finite, axis=0), axis=1))])
    count = int(min(max(2.0, np.ceil(length[-1] / step) + 1.0), 4000.0))
    s = np.linspace(0.0, length[-1], count)
    return np.stack([np.interp(s, length, finite[:, k]) for k in range(2)], axis=1)
