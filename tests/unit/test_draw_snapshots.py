"""What lies on paper: every artist of a figure with its place in points and its look, as it was when looked at.

`pytest tests/unit/test_draw_snapshots.py --snapshot-update` renews them. The scenes are those of `test_snapshots`; here
is kept what the drawing makes of them.
"""

import json
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from matplotlib.artist import Artist
from matplotlib.figure import Figure
from syrupy.assertion import SnapshotAssertion
from syrupy.extensions.json import JSONSnapshotExtension

from atlas.draw import to_figure
from atlas.scene import recipes

POINTS = 0.05
"""What another processor's rounding may move, in printer's points: a fifth of a hair."""

NAMES = "colours cone hyperbola hyperbolas loop lssc magn motion_sphere quadric separatrix stability_map".split()
"""Hidden lines, glass and seams, arrows, names; curves, regions, legends, images, logarithms."""

LOOKS = ("color", "facecolor", "edgecolor", "linewidth", "linestyle", "joinstyle", "alpha", "marker", "markersize")


class OnPaper(JSONSnapshotExtension):
    """Snapshots of numbers, to `POINTS`."""

    def matches(self, *, serialized_data: Any, snapshot_data: Any) -> bool:
        """Return whether two snapshots look the same."""
        return alike(json.loads(serialized_data), json.loads(snapshot_data))


def alike(a: Any, b: Any) -> bool:
    """Compare nested records, numbers to `POINTS`."""
    if isinstance(a, dict) and isinstance(b, dict):
        return a.keys() == b.keys() and all(alike(a[key], b[key]) for key in a)
    if isinstance(a, list) and isinstance(b, list):
        return len(a) == len(b) and all(alike(x, y) for x, y in zip(a, b, strict=True))
    if isinstance(a, int | float) and isinstance(b, int | float):
        return abs(a - b) <= POINTS
    return bool(a == b)


@pytest.mark.parametrize("name", NAMES)
def test_a_drawing_is_what_it_was(snapshot: SnapshotAssertion, name: str) -> None:
    """Every artist has the extent, the order and the look that it had."""
    figure = to_figure(recipes.load(name).scene())
    figure.draw_without_rendering()
    assert [shown(artist, figure) for artist in artists(figure)] == snapshot.use_extension(OnPaper)


def artists(figure: Figure) -> Iterator[Artist]:
    """Go through what is drawn, the texts of axes and legends included."""
    for artist in figure.findobj(include_self=False):
        if artist.get_visible() and not artist.get_children():
            yield artist


def shown(artist: Artist, figure: Figure) -> dict[str, Any]:
    """Return where an artist lies, in points, and how it looks."""
    extent = artist.get_window_extent().extents * 72.0 / figure.dpi
    record = {"is": type(artist).__name__, "order": round(artist.get_zorder(), 6), "clipped": artist.get_clip_on()}
    record |= {"extent": [round(float(x), 2) for x in extent] if np.isfinite(extent).all() else None}
    for look in LOOKS:
        if (read := getattr(artist, f"get_{look}", None)) is not None:
            record[look] = plain(read())
    if hasattr(artist, "get_text"):
        record |= {"text": artist.get_text(), "size": artist.get_fontsize(), "rotation": artist.get_rotation()}
    return record


def plain(value: Any) -> Any:
    """Return a look as JSON can hold it."""
    if isinstance(value, np.ndarray | list | tuple):
        return [plain(part) for part in value]
    return round(float(value), 3) if isinstance(value, int | float | np.number) else value and str(value)
