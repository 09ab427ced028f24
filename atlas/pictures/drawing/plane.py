"""A panel with two axes, drawn by Matplotlib's own artists."""

from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.patheffects import withStroke
from matplotlib.ticker import NullLocator, ScalarFormatter

from atlas.errors import AtlasError
from atlas.pictures.drawing.style import dashes, stroke, style_of, zoom
from atlas.pictures.drawing.text import typeset
from atlas.pictures.layers import Arrow, Curve, Image, Label, Layer, Plane, Points, Region
from atlas.pictures.style import INK, WHITE

_AREAS, _LINES, _MARKS = 1.0, 2.0, 3.0
_DECADES = 6
"""Largest number of powers of ten on an axis with ticks between them."""
_NEAR, _TOUCH = 0.47, 1e-9
"""Distance from the middle, in sizes of the panel, above which a mark meets the frame; tolerance of being on it."""
_CASING = 0.7
"""Dark edge of a white line on a map, both sides together, in printer's points."""
_BAR = (1.03, 0.0, 1.0 / 30.0, 1.0)


def draw_plane(axes: Axes, panel: Plane, number: int = 1) -> None:
    """Draw into `axes` the layers of a panel, its scales, title, labels, legend and colorbar.

    Names of layers (`Label`, and labels without a legend) are not drawn. `number` is the panel's number in the figure,
    from 1, for the ids of the artists. Raises AtlasError for a layer that belongs into a panel in space.
    """
    _scale(axes, panel)
    axes.spines[:].set_in_layout(False)  # they are where the axes are
    entries: list[Any] = []
    nameless: dict[str, Any] = {}
    edge = WHITE if any(isinstance(layer, Image) for layer in panel.layers) else ""
    for order, layer in enumerate(panel.layers):
        artist = _draw(axes, layer, 1e-3 * order, edge)
        if artist is not None:
            artist.set_gid(gid(layer, number, order + 1))
        if artist is not None and layer.label and not isinstance(layer, Arrow | Image):
            artist.set_label(typeset(layer.label))
            entries.append(artist)
        elif artist is not None and isinstance(layer, Curve | Points):
            nameless[layer.role] = artist
        elif isinstance(layer, Label) and layer.role in nameless:
            nameless.pop(layer.role).set_label(typeset(layer.text))  # where a user asks for a legend
    axes.set(xlabel=typeset(panel.x_label), ylabel=typeset(panel.y_label))
    axes.set(
        **{key: limits for key, limits in (("xlim", panel.x_limits), ("ylim", panel.y_limits)) if limits is not None}
    )
    if panel.equal:
        axes.set_aspect("equal", adjustable="box" if panel.x_limits and panel.y_limits else "datalim")
    _unclip_marks(axes)
    _ticks(axes)
    above = _factor(axes.yaxis) or mpl.rcParams["xtick.labeltop"]
    axes.set_title(typeset(panel.title), y=None if above else 1.0)  # None: the numbers above the axes are measured
    if panel.legend == "beside":
        axes.legend(handles=entries, loc="upper left", bbox_to_anchor=(1.0, 1.0))
    elif panel.legend and entries:
        axes.legend(handles=entries, loc="best").set_in_layout(False)


def _unclip_marks(axes: Axes) -> None:
    """Draw marks on the frame of `axes` without clipping; a line of marks with one outside the frame stays clipped."""
    for line in axes.lines:
        away = np.abs((axes.transData - axes.transAxes).transform(line.get_xydata()) - 0.5)
        if line.get_marker() != "None" and _NEAR < np.max(away, initial=0.0) <= 0.5 + _TOUCH:
            line.set_clip_on(False)
            line.set_in_layout(False)


def _ticks(axes: Axes) -> None:
    """Remove minor ticks on axes of more than six powers of ten, and write linear axes' numbers as plain text."""
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_tick_params(labelsize=mpl.rcParams[f"{axis.axis_name}tick.labelsize"])
        if axis.get_scale() != "linear" and len(axis.get_major_locator()()) > _DECADES:
            axis.set_minor_locator(NullLocator())
        if type(axis.get_major_formatter()) is ScalarFormatter:
            axis.set_major_formatter(_Formatter())


def _scale(axes: Axes, panel: Plane) -> None:
    """Set the scales of both axes to those of the panel: logarithmic, symmetric logarithmic, or linear by default."""
    for column, (axis, scale) in enumerate(((axes.set_xscale, panel.x_scale), (axes.set_yscale, panel.y_scale))):
        if scale == "symlog":
            axis(scale, linthresh=_threshold(panel, column))
        elif scale == "log":
            axis(scale)


def _draw(axes: Axes, layer: Layer, rise: float, edge: str = "") -> Any:
    """Draw one layer other than a label; return Matplotlib's artist of it, None for a label.

    `rise` is added to the order of drawing, `edge` is the edge colour of dark marks. Raises AtlasError for a layer of a
    `Space`.
    """
    if isinstance(layer, Label):
        return None
    if isinstance(layer, Image):
        return _map(axes, layer)
    look = style_of(layer.role)
    if isinstance(layer, Curve):
        line = {"color": look.colour, "lw": stroke(look.width), "ls": dashes(look.dash)}
        if look.colour == WHITE:
            line["path_effects"] = [withStroke(linewidth=stroke(look.width + _CASING), foreground=INK)]
        return axes.plot(*layer.points.T, zorder=_LINES + rise, **line)[0]
    if isinstance(layer, Points):
        return axes.plot(*np.atleast_2d(layer.points).T, ls="", zorder=_MARKS + rise, **marker(layer.role, edge))[0]
    if isinstance(layer, Region):
        shape = mpl.patches.Polygon(layer.points, facecolor=look.colour, alpha=look.fill, lw=0, zorder=_AREAS + rise)
        return axes.add_patch(shape)
    if isinstance(layer, Arrow):
        axes.update_datalim([layer.tail, layer.tip])
        arrow = {"arrowstyle": "-|>,head_length=0.42,head_width=0.16", "shrinkA": 0, "shrinkB": 0}
        arrow |= {"mutation_scale": 10 * zoom(), "color": look.colour, "lw": stroke(look.width)}
        return axes.annotate("", layer.tip, layer.tail, arrowprops=arrow)
    raise AtlasError(f"a plane panel cannot hold a {type(layer).__name__}; put it in a Space")


def gid(layer: Layer, panel: int, place: int, piece: int = 1) -> str:
    """Return the group id of a layer's artist: "ROLE-PANEL-LAYER", and "-PIECE" for pieces after the first.

    Panels and layers (`place`) count from 1; a map has "map" for a role.
    """
    name = f"{getattr(layer, 'role', 'map')}-{panel}-{place}"
    return name if piece == 1 else f"{name}-{piece}"


def marker(role: str, ring: str = "") -> dict[str, Any]:
    """Return a role's marker as keywords of Matplotlib's `Axes.plot`: "marker", "ms", "mfc", "mec", "mew".

    `ring` is the colour of the marker's edge, by default that of the marker (the ink for a white one).
    """
    look = style_of(role)
    edge = INK if look.colour == WHITE else ring or look.colour
    shape, size = ("o", 0.5 * look.size) if look.marker == "." else (look.marker or "o", look.size)
    return {"marker": shape, "ms": zoom() * size, "mfc": look.colour, "mec": edge, "mew": stroke(0.7)}


def _map(axes: Axes, image: Image) -> Any:
    """Draw an `Image` as pixels, with a colorbar if it has a label, and return Matplotlib's artist of the pixels."""
    low, high = image.limits or (np.nanmin(image.values), np.nanmax(image.values))
    norm = (mpl.colors.LogNorm if image.scale == "log" else mpl.colors.Normalize)(low, high)
    ends = [(edges[0], edges[-1]) for edges in (image.x, image.y)]
    axes.set(xlim=ends[0], ylim=ends[1])
    (x_low, y_low), (x_high, y_high) = axes.transScale.transform(np.transpose(ends))
    place = {"extent": (x_low, x_high, y_low, y_high), "transform": axes.transLimits + axes.transAxes}
    mesh = axes.imshow(image.values, norm=norm, origin="lower", aspect="auto", interpolation="none", **place)
    if image.label:
        bar = axes.figure.colorbar(mesh, cax=axes.inset_axes(_BAR), label=typeset(image.label))
        bar.minorticks_off()
    return mesh


class _Formatter(ScalarFormatter):
    """Formatter of ticks: numbers as plain text, drawn four times faster than a formula, their common factor as TeX."""

    def get_offset(self) -> str:
        self.set_useMathText(True)
        try:
            return str(super().get_offset())
        finally:
            self.set_useMathText(False)


def _factor(axis: Axis) -> str:
    """Return, as TeX, the power of ten that stands above the numbers of an axis; "" if there is none."""
    formatter = axis.get_major_formatter()
    formatter.format_ticks(axis.get_majorticklocs())
    return formatter.get_offset()


def _threshold(panel: Plane, column: int) -> float:
    """Return the end of a symmetric logarithmic axis' linear part: a power of ten at or below the least magnitude.

    `column` is 0 for x and 1 for y of the panel's curves and points. Zeros and values that are not finite do not
    count; 1.0 if no others are left.
    """
    columns = [np.atleast_2d(layer.points)[:, column] for layer in panel.layers if isinstance(layer, Curve | Points)]
    sizes = np.abs(np.concatenate([np.empty(0), *columns]))
    sizes = sizes[np.isfinite(sizes) & (sizes > 0.0)]
    return float(10.0 ** np.floor(np.log10(sizes.min()))) if sizes.size else 1.0
