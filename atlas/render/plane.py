"""A panel with two axes, drawn on Matplotlib axes."""

from typing import TYPE_CHECKING

import numpy as np

from atlas.errors import AtlasError
from atlas.render.house import SMALL_SIZE, TEXT_SIZE
from atlas.render.labels import Tag, along, place
from atlas.render.text import extent, typeset, write
from atlas.scene.layers import Arrow, Curve, Image, Label, Plane, Points, Region
from atlas.scene.style import INK, style

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_HEAD = 7.0


def draw_plane(axes: "Axes", panel: Plane) -> None:
    """Draw everything but the labels; those wait until the layout is settled (see `label_plane`)."""
    _scales(axes, panel)
    for order, layer in enumerate(panel.layers):
        zorder = 2.0 + 1e-3 * order
        if isinstance(layer, Curve):
            look = style(layer.role)
            name = typeset(layer.label) if panel.legend else ""
            (line,) = axes.plot(*layer.points.T, color=look.colour, linewidth=look.width, zorder=zorder)
            if look.dash:
                line.set_dashes(look.dash)
            line.set_label(name or "_")
        elif isinstance(layer, Points):
            look = style(layer.role)
            edge = INK if look.colour == "#ffffff" else look.colour
            (marks,) = axes.plot(*np.atleast_2d(layer.points).T, linestyle="none", zorder=zorder + 1.0)
            marks.set(marker=look.marker or "o", markersize=look.size, markerfacecolor=look.colour)
            marks.set(
                markeredgecolor=edge, markeredgewidth=0.7, label=(typeset(layer.label) if panel.legend else "") or "_"
            )
        elif isinstance(layer, Region):
            look = style(layer.role)
            name = typeset(layer.label) if panel.legend else ""
            axes.fill(*layer.points.T, color=look.colour, alpha=look.fill, linewidth=0.0, zorder=1.0, label=name or "_")
        elif isinstance(layer, Arrow):
            look = style(layer.role)
            arrow = {"arrowstyle": "-|>,head_width=0.16,head_length=0.42", "color": look.colour, "lw": look.width}
            arrow |= {"shrinkA": 0.0, "shrinkB": 0.0, "mutation_scale": 10.0}
            axes.annotate("", layer.tip, layer.tail, arrowprops=arrow, zorder=zorder)
        elif isinstance(layer, Image):
            _image(axes, layer)
        elif not isinstance(layer, Label):
            raise AtlasError(f"a plane panel cannot hold a {type(layer).__name__}; put it in a Space")
    axes.set_xlabel(typeset(panel.x_label))
    axes.set_ylabel(typeset(panel.y_label))
    if panel.title:
        axes.set_title(typeset(panel.title))
    if panel.x_limits is not None:
        axes.set_xlim(*panel.x_limits)
    if panel.y_limits is not None:
        axes.set_ylim(*panel.y_limits)
    if panel.legend == "beside":
        axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0.0)
    elif panel.legend:
        axes.legend(loc="best")


def label_plane(axes: "Axes", panel: Plane) -> None:
    """Place the labels of a panel whose axes have their final position."""
    from matplotlib.transforms import Affine2D

    figure = axes.figure
    per_point = figure.dpi / 72.0
    requests = [request for layer in panel.layers for request in _requests(axes, layer, panel.legend)]
    if not requests:
        return
    to_points = axes.transData + Affine2D().scale(1.0 / per_point)
    box = axes.get_window_extent().extents / per_point
    ink, weights = _ink(panel, to_points, box)
    tags = []
    for text, at, offset, role in requests:
        size = SMALL_SIZE if role == "note" else TEXT_SIZE
        anchor = to_points.transform(np.asarray(at, dtype=float))
        box_size = extent(figure, text, size)
        tags.append(Tag(text, (float(anchor[0]), float(anchor[1])), offset, box_size, style(role).colour, size))
    write(figure, tags, place(tags, ink, weights, tuple(box)))


def _requests(axes, layer, legend):
    """Yield (text, place, offset, role) for each name that a layer wants written in the panel."""
    if isinstance(layer, Label):
        yield layer.text, layer.at, layer.offset, layer.role
    elif isinstance(layer, Arrow) and layer.label:
        step = axes.transData.transform(layer.tip) - axes.transData.transform(layer.tail)
        beyond = tuple(4.0 * step / max(float(np.hypot(*step)), 1e-9))
        yield layer.label, layer.tip, layer.offset or beyond, layer.role
    elif isinstance(layer, Points) and layer.label and not legend:
        yield layer.label, np.atleast_2d(layer.points)[0], (4.0, 4.0), "label"
    elif isinstance(layer, Curve) and layer.label and not legend:
        seen = layer.points[_inside(axes, layer.points)]
        if len(seen):
            yield layer.label, seen[-1], (-4.0, 4.0), layer.role
    elif isinstance(layer, Region) and layer.label and not legend:
        yield layer.label, layer.points.mean(axis=0), (0.0, 0.0), "note"


def _inside(axes, points):
    """Which points lie in the window."""
    (x0, x1), (y0, y1) = sorted(axes.get_xlim()), sorted(axes.get_ylim())
    return (points[:, 0] >= x0) & (points[:, 0] <= x1) & (points[:, 1] >= y0) & (points[:, 1] <= y1)


def _ink(panel, to_points, box):
    """Return points of all lines and marks inside the box, and how much it hurts to cover each."""
    ink, weights = [np.empty((0, 2))], [np.empty(0)]
    for layer in panel.layers:
        if isinstance(layer, Curve | Points):
            with np.errstate(all="ignore"):
                seen = to_points.transform(np.atleast_2d(layer.points))
            points = along(np.clip(seen, -1e5, 1e5)) if isinstance(layer, Curve) else seen
        elif isinstance(layer, Arrow):
            points = along(to_points.transform(np.array([layer.tail, layer.tip])))
        else:
            continue
        points = points[((points >= box[:2] - 10.0) & (points <= box[2:] + 10.0)).all(axis=1)]
        ink.append(points)
        weights.append(np.full(len(points), 6.0 if isinstance(layer, Points) else 1.5))
    return np.concatenate(ink), np.concatenate(weights)


def _scales(axes, panel):
    """Set the kind of each axis; a symmetric logarithm turns linear below the smallest value drawn."""
    for which, kind in (("x", panel.x_scale), ("y", panel.y_scale)):
        options = {}
        if kind == "symlog":
            column = 0 if which == "x" else 1
            values = np.concatenate(
                [np.atleast_2d(layer.points)[:, column] for layer in panel.layers if isinstance(layer, Curve | Points)]
                or [np.ones(1)]
            )
            size = np.abs(values[np.isfinite(values) & (values != 0.0)])
            options = {"linthresh": 10.0 ** np.floor(np.log10(size.min())) if size.size else 1.0}
        if kind != "linear":
            getattr(axes, f"set_{which}scale")(kind, **options)
    if panel.equal:
        axes.set_aspect("equal", adjustable="box" if panel.x_limits and panel.y_limits else "datalim")


def _image(axes, layer):
    """Draw a map with its scale of colours."""
    from matplotlib.colors import LogNorm, Normalize

    low, high = layer.limits or (None, None)
    norm = LogNorm(low, high) if layer.scale == "log" else Normalize(low, high)
    mesh = axes.pcolormesh(layer.x, layer.y, layer.values, norm=norm, cmap="cividis", rasterized=True, zorder=0.5)
    bar = axes.figure.colorbar(mesh, ax=axes, pad=0.02, aspect=30)
    bar.set_label(typeset(layer.label))
    bar.outline.set_linewidth(0.5)
