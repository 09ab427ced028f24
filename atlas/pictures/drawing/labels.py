"""Names beside things: where a label goes so that it covers neither another label nor a line."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patheffects import Stroke
from numpy.typing import NDArray

from atlas.pictures.drawing.style import ground, zoom
from atlas.pictures.drawing.text import line, typeset
from atlas.pictures.layers import FloatArray
from atlas.pictures.style import WHITE, readable

_TURNS = np.radians([0, 20, -20, 40, -40, 65, -65, 90, -90, 120, -120, 150, -150, 180])
_STEPS = (0.0, 3.0, 7.0, 12.0)
_TURN, _STEP, _ELSEWHERE, _DOUBT = 1.6, 0.35, 0.9, 8.0
_AIR, _APART = 1.2, 4.0
_FAR, _SIGHT = 5.0, 30.0
_KEPT = 100
_HEIGHT = 20.0
_HALO, _BOX = 2.2, 0.85
MARK = 6.0
"""Cost of covering a marked point; a name anchored at one should be nearer to it than to other marked points."""
NOBODY = -2
"""The owner of ink that a name is never taken for the name of."""
Ink: TypeAlias = tuple[FloatArray, float, int]
"""Points (N, 2) of a drawn layer, the cost of covering one of them, and the layer's number."""


@dataclass(frozen=True)
class Tag:
    """A text of known ``extent`` (width, height) that belongs at ``anchor``; all lengths in printer's points.

    ``anchor`` is (x, y) from the lower left corner of the axes, y upwards. ``offset`` is the preferred place of the
    text from the anchor; with (0, 0) the text is centred there and not moved. ``elsewhere`` has further anchors,
    each at a higher cost than the one before. ``owner`` is the index of the layer that the text names, -1 for none:
    the text should be nearer to that layer's lines and marks than to others. ``size`` is that of the type,
    ``colour`` that of the text.
    """

    text: str
    anchor: tuple[float, float]
    offset: tuple[float, float]
    extent: tuple[float, float]
    colour: str
    size: float
    elsewhere: tuple[tuple[float, float], ...] = ()
    owner: int = -1


def spot(tag: Tag) -> FloatArray:
    """Return the preferred centre (2,) of a tag's text, in printer's points, from the same origin as its anchor."""
    return _candidate_centres(tag, np.array([tag.anchor]), np.zeros(1), np.zeros(1))[0]


def _candidate_centres(tag: Tag, anchors: FloatArray, turns: FloatArray, steps: FloatArray) -> FloatArray:
    """Return text centres (N, 2) near anchors (N, 2), the tag's offset rotated and lengthened, in printer's points.

    `turns` (N,) are the angles in rad, `steps` (N,) the added lengths. Half of the text's size in that direction is
    added too, so that its edge, not its centre, is at the offset. A tag with the offset (0, 0) stays at its anchors.
    """
    length = float(np.hypot(*tag.offset))
    if length == 0.0:
        return anchors
    angle = np.arctan2(tag.offset[1], tag.offset[0]) + turns
    u = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    half = 0.5 * np.array(tag.extent)
    with np.errstate(divide="ignore"):
        reach = np.minimum((half / np.abs(u)).min(axis=1), np.hypot(*half))
    return anchors + (length + steps + reach)[:, None] * u


def place(tags: Sequence[Tag], inks: Iterable[Ink], window: tuple[float, float, float, float]) -> list[FloatArray]:
    """Return the centre (2,) of each tag's text, in points: the cheapest candidate, chosen in two rounds.

    ``inks`` are (points (N, 2), cost of covering one, index of the layer): lines and marks to be kept free.
    ``window`` is (left, bottom, right, top); texts should not leave it. All positions have the origin of the tags'
    anchors, in printer's points. Tags with the offset (0, 0) stay at their anchors.
    """
    point_sets, *attributes = zip((np.empty((0, 2)), 0.0, NOBODY), *inks, strict=True)
    ink, counts = np.concatenate(point_sets), list(map(len, point_sets))
    weights, owners = (np.repeat(values, counts) for values in attributes)
    marks = ink[weights == MARK]
    centres = np.array([spot(tag) for tag in tags]).reshape(-1, 2)
    sizes = np.array([tag.extent for tag in tags]).reshape(-1, 2)
    fixed = np.array([tag.offset == (0.0, 0.0) for tag in tags], dtype=bool)
    is_placed = fixed.copy()
    choices = {}
    for i in np.flatnonzero(~fixed):
        tag, anchors = tags[i], np.array([tags[i].anchor, *tags[i].elsewhere])
        index, steps, turns = (g.ravel() for g in np.meshgrid(np.arange(len(anchors)), _STEPS, _TURNS, indexing="ij"))
        candidates = _candidate_centres(tag, anchors[index], turns, steps)
        cost = _TURN * np.abs(turns) + _STEP * steps + _ELSEWHERE * index
        groups = np.split(candidates, len(anchors))  # about one anchor there is little ink
        cost += np.concatenate([_covers(group, tag.extent, ink, weights, window) for group in groups])
        best = np.argsort(cost, kind="stable")[:_KEPT]
        candidates, cost = candidates[best], cost[best]
        is_own, named = owners == tag.owner, owners != NOBODY
        if is_own.any():
            cost += _doubt(candidates, tag.extent, ink[named], is_own[named], _FAR)
        if not is_own.any() or MARK in weights[is_own]:
            max_gap = 1.0 + float(np.hypot(*tag.offset))
            cost += _doubt(
                candidates, tag.extent, marks, np.isclose(marks, tag.anchor, rtol=0.0, atol=1e-6).all(axis=1), max_gap
            )
        choices[i] = candidates, cost
    for _ in range(2):
        for i, (candidates, cost) in choices.items():
            is_placed[i] = False
            total = cost + _meets(candidates, tags[i].extent, centres[is_placed], sizes[is_placed])
            centres[i] = candidates[int(np.argmin(total))]
            is_placed[i] = True
    return list(centres)


def _doubt(
    centres: FloatArray, extent: tuple[float, float], ink: FloatArray, owned: NDArray[np.bool_], max_gap: float
) -> FloatArray:
    """Return the cost (N,) of centres (N, 2) of a text whose own ink is not clearly nearest, or beyond `max_gap`.

    `extent` is the text's (width, height); `owned` (M,) is the mask of the points `ink` (M, 2) that are its own;
    lengths are in printer's points. The cost is 0 if all or none of the points are its own.
    """
    if not owned.any() or owned.all():
        return np.zeros(len(centres))
    half = 0.5 * np.array(extent)
    own_gap, other_gap = (_gap(centres, half, ink[mask]) for mask in (owned, ~owned))
    return _DOUBT * np.clip(1.0 - (other_gap + 1.0) / (own_gap + 4.0), 0.0, 1.0) + _ELSEWHERE * np.maximum(
        own_gap - max_gap, 0.0
    )


def _gap(centres: FloatArray, half: FloatArray, ink: FloatArray) -> FloatArray:
    """Return the distances (N,), in points, from N equal boxes to the nearest of the points `ink` (M, 2).

    The boxes have half the width and half the height `half` (2,) and the centres (N, 2). A distance is 0 where a point
    is in the box, and `_SIGHT` where none is nearer.
    """
    reach = half + _SIGHT
    is_near = ((ink > centres.min(axis=0) - reach) & (ink < centres.max(axis=0) + reach)).all(axis=1)
    if not is_near.any():
        return np.full(len(centres), _SIGHT)
    beyond = [np.maximum(np.abs(ink[is_near, k] - centres[:, k, None]) - half[k], 0.0) for k in range(2)]
    return np.minimum(np.sqrt(beyond[0] ** 2 + beyond[1] ** 2).min(axis=1), _SIGHT)


def _covers(
    centres: FloatArray,
    extent: tuple[float, float],
    ink: FloatArray,
    weights: FloatArray,
    window: tuple[float, float, float, float],
) -> FloatArray:
    """Return the cost (N,) of a text at centres (N, 2): the ink that it covers, and its part outside the window.

    `extent` is the text's (width, height), `ink` (M, 2) the points, `weights` (M,) their costs, `window` (left,
    bottom, right, top), all in printer's points.
    """
    half = 0.5 * np.array(extent) + _AIR
    low, high = centres - half, centres + half
    is_near = ((ink > low.min(axis=0)) & (ink < high.max(axis=0))).all(axis=1)
    x, y = ink[is_near].T
    covered = (x > low[:, :1]) & (x < high[:, :1]) & (y > low[:, 1:]) & (y < high[:, 1:])
    outside = np.maximum(0.0, np.concatenate([window[:2] - low, high - window[2:]], axis=1)).sum(axis=1)
    cost: FloatArray = covered @ weights[is_near] + 40.0 * outside
    return cost


def _meets(centres: FloatArray, extent: tuple[float, float], obstacles: FloatArray, sizes: FloatArray) -> FloatArray:
    """Return the cost (N,) of the overlap of a text at centres (N, 2) with other texts at centres ``obstacles`` (M, 2).

    `extent` is the text's (width, height), ``sizes`` (M, 2) are those of the others, in points of paper.
    """
    half, reach = 0.5 * np.array(extent) + _AIR, 0.5 * sizes + _APART
    high = np.minimum((centres + half)[:, None], obstacles + reach)
    overlap = high - np.maximum((centres - half)[:, None], obstacles - reach)
    cost: FloatArray = np.where((overlap > 0.0).all(axis=2), 30.0 + overlap.prod(axis=2), 0.0).sum(axis=1)
    return cost


def ink_points(points: FloatArray, step: float = 2.0) -> FloatArray:
    """Return points (M, 2), at most ``step`` apart, along a polyline (N, 2), which texts should not cover.

    Points that are not finite are left out; there are at most 4000 points, then farther apart.
    """
    finite = points[np.isfinite(points).all(axis=1)]
    if len(finite) < 2:
        return finite
    length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(finite, axis=0), axis=1))])
    count = int(min(max(2.0, np.ceil(length[-1] / step) + 1.0), 4000.0))
    s = np.linspace(0.0, length[-1], count)
    return np.stack([np.interp(s, length, finite[:, k]) for k in range(2)], axis=1)


def write(axes: Axes, tags: Sequence[Tag], centres: Sequence[FloatArray], *, boxed: bool = False) -> None:
    """Write the texts into `axes` about their centres (2,), in points from the lower left corner, as annotations.

    Each annotates the tag's anchor. Below each lies its outline in the background colour, which is no text, or if
    `boxed` a white box, for texts on a coloured image.
    """
    corner = axes.get_window_extent().p0
    face = WHITE if boxed else ground(axes.get_facecolor() if axes.axison else axes.figure.get_facecolor())
    scale = zoom() * axes.figure.dpi / 72.0
    anchors = axes.transData.inverted().transform([corner + scale * np.array(tag.anchor) for tag in tags])
    for tag, anchor, centre in zip(tags, anchors, centres, strict=True):
        _, ascent, descent = line(tag.text, tag.size)
        offset = zoom() * (centre - tag.anchor - (0.0, 0.5 * (ascent - descent)))
        outline = [] if boxed else [(_HEIGHT, [Stroke(linewidth=zoom() * _HALO, foreground=face)])]
        for height, effects in (*outline, (_HEIGHT + 1.0, [])):
            axes.annotate(
                typeset(tag.text),
                anchor,
                offset,
                textcoords="offset points",
                ha="center",
                va="baseline",
                fontsize=zoom() * tag.size,
                color=readable(tag.colour, face),
                zorder=height,
                path_effects=effects,
                annotation_clip=False,
                bbox={"fc": face, "alpha": _BOX, "lw": 0.0, "pad": 0.8 * zoom()} if boxed else None,
            )
