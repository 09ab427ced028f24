"""A panel with two axes, drawn on Matplotlib axes."""

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from atlas.errors import AtlasError
from atlas.render.house import SMALL_SIZE, TEXT_SIZE
from atlas.render.labels import Tag, along, place
from atlas.render.text import extent, typeset, write
from atlas.scene.layers import Arrow, Curve, Image, Label, Layer, Plane, Points, Region
from atlas.scene.style import INK, style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.transforms import Transform

FloatArray = NDArray[np.float64]

_AREAS, _LINES, _MARKS = 1.0, 2.0, 3.0
_FAR = 1e5


def draw_plane(axes: "Axes", panel: Plane) -> None:
    """Draw everything but the labels; those wait until the layout is settled (see `label_plane`)."""
    _scales(axes, panel)
    for order, layer in enumerate(panel.layers):
        if type(layer) not in _BRUSHES:
            raise AtlasError(f"a plane panel cannot hold a {type(layer).__name__}; put it in a Space")
        _BRUSHES[type(layer)](axes, layer, bool(panel.legend), 1e-3 * order)
    axes.set_xlabel(typeset(panel.x_label))
    axes.set_ylabel(typeset(panel.y_label))
    if panel.title:
        axes.set_title(typeset(panel.title))
    if panel.x_limits is not None:
        axes.set_xlim(*panel.x_limits)
    if panel.y_limits is not None:
        axes.set_ylim(*panel.y_limits)
    if panel.y_names:
        axes.set_yticks(range(1, len(panel.y_names) + 1), [typeset(name) for name in panel.y_names])
        axes.tick_params(axis="y", which="both", length=0)
    if panel.legend == "beside":
        axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0.0)
    elif panel.legend:
        axes.legend(loc="best")


def _name(layer: Any, keyed: bool) -> str:
    """Return what stands in the key for a layer; an underscore keeps it out."""
    return (typeset(layer.label) if keyed else "") or "_"


def _curve(axes: "Axes", layer: Curve, keyed: bool, rise: float) -> None:
    look = style(layer.role)
    (line,) = axes.plot(*layer.points.T, color=look.colour, linewidth=look.width, zorder=_LINES + rise)
    line.set_label(_name(layer, keyed))
    if look.dash:
        line.set_dashes(look.dash)


def _points(axes: "Axes", layer: Points, keyed: bool, rise: float) -> None:
    look = style(layer.role)
    edge = INK if look.colour == "#ffffff" else look.colour
    (marks,) = axes.plot(*np.atleast_2d(layer.points).T, linestyle="none", zorder=_MARKS + rise)
    marks.set(marker=look.marker or "o", markersize=look.size, markerfacecolor=look.colour)
    marks.set(markeredgecolor=edge, markeredgewidth=0.7, label=_name(layer, keyed))


def _region(axes: "Axes", layer: Region, keyed: bool, rise: float) -> None:
    look = style(layer.role)
    (area,) = axes.fill(*layer.points.T, color=look.colour, alpha=look.fill, linewidth=0.0, zorder=_AREAS + rise)
    area.set_label(_name(layer, keyed))


def _arrow(axes: "Axes", layer: Arrow, _keyed: bool, rise: float) -> None:
    look = style(layer.role)
    shape = {"arrowstyle": "-|>,head_width=0.16,head_length=0.42", "color": look.colour, "lw": look.width}
    shape |= {"shrinkA": 0.0, "shrinkB": 0.0, "mutation_scale": 10.0}
    axes.annotate("", layer.tip, layer.tail, arrowprops=shape, zorder=_LINES + rise)
    axes.update_datalim(np.stack([layer.tail, layer.tip]))


def _image(axes: "Axes", layer: Image, _keyed: bool, _rise: float) -> None:
    from matplotlib.colors import LogNorm, Normalize

    low, high = layer.limits or (None, None)
    norm = LogNorm(low, high) if layer.scale == "log" else Normalize(low, high)
    mesh = axes.pcolormesh(layer.x, layer.y, layer.values, norm=norm, cmap="cividis", rasterized=True, zorder=0.5)
    bar = axes.figure.colorbar(mesh, ax=axes, pad=0.02, aspect=30)
    bar.set_label(typeset(layer.label))
    bar.outline.set_linewidth(0.5)


def _later(_axes: "Axes", _layer: Label, _keyed: bool, _rise: float) -> None:
    """Leave a label for when the layout is settled."""


_BRUSHES: dict[type, Callable[..., None]] = {
    Curve: _curve,
    Points: _points,
    Region: _region,
    Arrow: _arrow,
    Image: _image,
    Label: _later,
}


def label_plane(axes: "Axes", panel: Plane) -> None:
    """Place the labels of a panel whose axes have their final position."""
    from matplotlib.transforms import Affine2D

    figure = axes.figure
    per_point = figure.dpi / 72.0
    to_points = axes.transData + Affine2D().scale(1.0 / per_point)
    box = axes.get_window_extent().extents / per_point
    tags = []
    for layer in panel.layers:
        for text, at, offset, role in _requests(axes, layer, bool(panel.legend)):
            size = SMALL_SIZE if role == "note" else TEXT_SIZE
            x, y = to_points.transform(np.asarray(at, dtype=float))
            tags.append(Tag(text, (float(x), float(y)), offset, extent(figure, text, size), style(role).colour, size))
    if tags:
        write(figure, tags, place(tags, *_ink(panel, to_points, box), tuple(box)))


def _requests(axes: "Axes", layer: Layer, keyed: bool) -> Iterator[tuple[str, Any, tuple[float, float], str]]:
    """Yield (text, place, offset, role) for each name that a layer wants written in the panel."""
    if isinstance(layer, Label):
        yield layer.text, layer.at, layer.offset, layer.role
    elif isinstance(layer, Arrow) and layer.label:
        step = axes.transData.transform(layer.tip) - axes.transData.transform(layer.tail)
        beyond = 4.0 * step / max(float(np.hypot(*step)), 1e-9)
        yield layer.label, layer.tip, layer.offset or (float(beyond[0]), float(beyond[1])), layer.role
    elif isinstance(layer, Image) or keyed or not layer.label:
        return
    elif isinstance(layer, Points):
        yield layer.label, np.atleast_2d(layer.points)[0], (4.0, 4.0), "label"
    elif isinstance(layer, Curve):
        (x0, x1), (y0, y1) = sorted(axes.get_xlim()), sorted(axes.get_ylim())
        x, y = layer.points.T
        seen = layer.points[(x >= x0) & (x <= x1) & (y >= y0) & (y <= y1)]
        if len(seen):
            yield layer.label, seen[-1], (-4.0, 4.0), layer.role
    elif isinstance(layer, Region):
        yield layer.label, layer.points.mean(axis=0), (0.0, 0.0), "note"


def _ink(panel: Plane, to_points: "Transform", box: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return points of all lines and marks inside the box, and how much it hurts to cover each."""
    ink, weights = [np.empty((0, 2))], [np.empty(0)]
    for layer in panel.layers:
        if isinstance(layer, Curve):
            points = along(np.clip(to_points.transform(layer.points), -_FAR, _FAR))
        elif isinstance(layer, Points):
            points = to_points.transform(np.atleast_2d(layer.points))
        elif isinstance(layer, Arrow):
            points = along(to_points.transform(np.array([layer.tail, layer.tip])))
        else:
            continue
        points = points[((points >= box[:2] - 10.0) & (points <= box[2:] + 10.0)).all(axis=1)]
        ink.append(points)
        weights.append(np.full(len(points), 6.0 if isinstance(layer, Points) else 1.5))
    return np.concatenate(ink), np.concatenate(weights)


def _scales(axes: "Axes", panel: Plane) -> None:
    """Set the kind of each axis; a symmetric logarithm turns linear below the smallest value drawn."""
    drawn = [np.atleast_2d(layer.points) for layer in panel.layers if isinstance(layer, Curve | Points)]
    for column, (kind, change) in enumerate(((panel.x_scale, axes.set_xscale), (panel.y_scale, axes.set_yscale))):
        if kind == "symlog":
            values = np.abs(np.concatenate([np.ones(0), *(points[:, column] for points in drawn)]))
            sizes = values[np.isfinite(values) & (values > 0.0)]
            change("symlog", linthresh=10.0 ** np.floor(np.log10(sizes.min())) if sizes.size else 1.0)
        elif kind == "log":
            change("log")
    if panel.equal:
        axes.set_aspect("equal", adjustable="box" if panel.x_limits and panel.y_limits else "datalim")
