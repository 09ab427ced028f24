"""A figure as data: its layers and their roles, without colours and line styles.

A recipe in ``figures/`` returns a `Scene`; the two back ends in `atlas.pictures.drawing` draw it. Coordinates are those
of the quantity shown (angular velocities in 1/time, unit vectors on the sphere). Text may hold TeX between dollar
signs. A layer that moves in time ``rides`` on a path of the scene, by its name.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

from atlas.errors import AtlasError

FloatArray: TypeAlias = NDArray[np.float64]
Path: TypeAlias = Callable[[FloatArray], tuple[FloatArray, FloatArray]]
"""A rigid motion of times (N,): the matrices R (N, D, D) and shifts s (N, D) of x -> R x + s, at t = 0 the identity."""


@dataclass(frozen=True, eq=False)
class Curve:
    """A polyline through ``points`` (N, 2) or (N, 3), drawn in the look of its ``role``, with a ``label`` at its end.

    ``rides`` names the path of the scene that moves it; "" for a curve at rest.
    """

    points: FloatArray
    role: str
    label: str = ""
    rides: str = ""


@dataclass(frozen=True, eq=False)
class Points:
    """Marked ``points`` (N, 2), (N, 3) or one (D,), drawn in the look of their ``role``, with a ``label`` at the first.

    ``rides`` names the path of the scene that moves them; "" for points at rest.
    """

    points: FloatArray
    role: str
    label: str = ""
    rides: str = ""


@dataclass(frozen=True, eq=False)
class Arrow:
    """A vector drawn from ``tail`` to ``tip``, points (2,) or (3,), its name ``offset`` printer's points from the tip.

    Without an offset the name stands just beyond the tip. The name is moved a little where it would cover
    something. ``role`` gives the look, ``rides`` names the path of the scene that moves the arrow, "" for none.
    """

    tail: FloatArray
    tip: FloatArray
    role: str
    label: str = ""
    offset: tuple[float, float] | None = None
    rides: str = ""


@dataclass(frozen=True, eq=False)
class Label:
    """Text at a position, ``offset`` printer's points away; with offset (0, 0) the text is centred there and fixed.

    ``at`` is a position (2,) or (3,), or several (N, 2) or (N, 3), the best first. In a panel with two axes the
    text is also the legend's label of the last preceding unlabelled curve or points of the same role. ``role``
    gives the colour, ``rides`` names the path of the scene that moves the text, "" for none.
    """

    at: FloatArray
    text: str
    role: str = "label"
    offset: tuple[float, float] = (0.0, 0.0)
    rides: str = ""


@dataclass(frozen=True, eq=False)
class Surface:
    """A piece of a quadric: the points x with (x, 1) Q (x, 1) = 0 that lie in every half space ``n . x <= d``.

    ``quadric`` is the symmetric (4, 4) matrix Q, ``clip`` holds rows (n1, n2, n3, d); both decide exactly which
    points the surface hides. A plane (no terms of second order) may also be cut out by quadrics ``within``, (x, 1)
    W (x, 1) <= 0: a disk, for one. ``grids`` are (M, N, 3) meshes for shading, ``wires`` curves (N, 3) on the
    surface, ``rims`` its edges. ``role`` gives the look, ``label`` the name, ``rides`` the path of the scene that
    moves the surface, "" for none.
    """

    quadric: FloatArray
    clip: FloatArray
    grids: tuple[FloatArray, ...]
    wires: tuple[FloatArray, ...] = ()
    rims: tuple[FloatArray, ...] = ()
    within: tuple[FloatArray, ...] = ()
    role: str = "surface"
    label: str = ""
    rides: str = ""


@dataclass(frozen=True, eq=False)
class Region:
    """A filled polygon ``points`` (N, 2) in the plane, in the look of its ``role``, with a ``label`` in its middle."""

    points: FloatArray
    role: str
    label: str = ""


@dataclass(frozen=True, eq=False)
class Image:
    """A map of ``values`` (len(y)-1, len(x)-1) over the cells between the edges ``x`` and ``y``, two arrays.

    On the scales of its panel the edges are at equal steps. ``label`` stands at the bar of colours, which is left
    out for ""; ``scale`` is that of the colours, ``limits`` their least and largest value, by default those of the
    values. NaN has no colour.
    """

    x: FloatArray
    y: FloatArray
    values: FloatArray
    label: str
    scale: Literal["linear", "log"] = "linear"
    limits: tuple[float, float] | None = None


Layer: TypeAlias = Curve | Points | Arrow | Label | Surface | Region | Image


@dataclass(frozen=True, eq=False)
class Plane:
    """A panel with two axes: its ``layers``, the axes' labels, limits and scales, and its ``title``.

    Limits are (lowest, highest), None for those that the layers need. With ``equal`` both axes have one scale on
    paper. With ``legend`` the layers' labels stand in a key (where there is most room, or beside the panel if that
    is not made narrower); without it they stand at the layers themselves.
    """

    layers: tuple[Layer, ...]
    x_label: str
    y_label: str
    x_limits: tuple[float, float] | None = None
    y_limits: tuple[float, float] | None = None
    x_scale: Literal["linear", "log", "symlog"] = "linear"
    y_scale: Literal["linear", "log", "symlog"] = "linear"
    equal: bool = False
    legend: bool | Literal["beside"] = False
    title: str = ""


@dataclass(frozen=True, eq=False)
class Space:
    """A panel in three dimensions, seen in parallel projection from ``azimuth`` and ``elevation`` (degrees).

    With azimuth 0 the eye looks along -e1: e2 points right and e3 up, as in the paper's figures. ``span`` is the least
    width and height shown, in units of the coordinates; panels of the same span have the same scale.
    """

    layers: tuple[Layer, ...]
    azimuth: float = 20.0
    elevation: float = 15.0
    title: str = ""
    span: tuple[float, float] = (0.0, 0.0)


Panel: TypeAlias = Plane | Space


@dataclass(frozen=True, eq=False)
class Scene:
    """One figure: its panels row by row, its size in millimetres, and its words.

    ``title`` is by default the recipe's, the first line of its docstring. ``caption`` and ``alt`` are complete
    sentences, ``alt`` without TeX; each figure with panels has both. ``parameters`` are the values used, in the order
    of the recipe. ``named`` maps words of the caption to roles, as in {"dashed": "asymptote"}: a line that a caption
    names must be visible. ``commands`` are command lines that make tables of the numbers drawn. ``narrow`` has the
    panels for a narrow screen, one below the other, each as high as a row of the figure. ``paths`` are motions (`Path`)
    by name; a path moves the layers with its name in ``rides``, from t = 0 to ``lasts``. ``narrowest`` is the width in
    millimetres below which the figure is unreadable. ``rows`` are relative heights of the rows; empty for equal ones.
    ``spare`` has the indices of panels left out of a slide or column in which all would be too small.
    """

    title: str = ""
    caption: str = ""
    alt: str = ""
    panels: tuple[Panel, ...] = ()
    columns: int = 1
    size: tuple[float, float] = (120.0, 100.0)
    parameters: Mapping[str, Any] = field(default_factory=dict)
    named: Mapping[str, str] = field(default_factory=dict)
    commands: tuple[str, ...] = ()
    narrow: tuple[Panel, ...] = ()
    paths: Mapping[str, Path] = field(default_factory=dict)
    lasts: float = 0.0
    narrowest: float = 0.0
    rows: tuple[float, ...] = ()
    spare: tuple[int, ...] = ()


def frame(space: Space) -> FloatArray:
    """Return the unit vectors to the right, upwards and towards the eye of a panel, as the rows of a matrix (3, 3)."""
    a, e = np.radians(space.azimuth), np.radians(space.elevation)
    towards = (np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e))
    rightward = (-np.sin(a), np.cos(a), 0.0)
    up = (-np.sin(e) * np.cos(a), -np.sin(e) * np.sin(a), np.cos(e))
    return np.array([rightward, up, towards])


def cloud(space: Space) -> FloatArray:
    """Return all points (N, 3) of a panel's layers, wires aside. Raises AtlasError for a `Region` or an `Image`."""
    return np.concatenate([np.reshape(points, (-1, 3)) for layer in space.layers for points in points_of(layer)])


def points_of(layer: Layer) -> Iterator[FloatArray]:
    """Yield arrays (..., 2) or (..., 3) of the points of a layer; of a `Surface` meshes and rims.

    Raises AtlasError for a `Region` or an `Image`.
    """
    if isinstance(layer, Curve | Points):
        yield layer.points
    elif isinstance(layer, Arrow):
        yield np.stack([layer.tail, layer.tip])
    elif isinstance(layer, Label):
        yield layer.at
    elif isinstance(layer, Surface):
        yield from (*layer.grids, *layer.rims)
    else:
        kind = "map" if isinstance(layer, Image) else "flat region"
        raise AtlasError(f"a panel in space cannot hold a {kind}; put it in a Plane")


_SIDES = np.array([1.0, 1.0, 1.0, -1.0])
"""A half space n . x <= d is one linear form of (x, 1), (n, -d)."""


def mapped(layer: Layer, A: FloatArray, s: FloatArray) -> Layer:
    """Return a copy of a layer under the map x -> A x + s, A (D, D) regular, s (D,).

    A region or a map stays as it is.
    """

    def image(points: FloatArray) -> FloatArray:
        return np.asarray(np.asarray(points, dtype=float) @ A.T + s)

    match layer:
        case Curve() | Points():
            return replace(layer, points=image(layer.points))
        case Arrow():
            return replace(layer, tail=image(layer.tail), tip=image(layer.tip))
        case Label():
            return replace(layer, at=image(layer.at))
        case Surface():
            return moved_surface(layer, A, s)
    return layer


def moved_surface(surface: Surface, A: FloatArray, s: FloatArray) -> Surface:
    """Return a copy of a surface, its quadrics and half spaces too, under the map x -> A x + s.

    A (3, 3) is regular, s is (3,).
    """
    back = np.eye(4)
    back[:3, :3] = np.linalg.inv(A)
    back[:3, 3] = -back[:3, :3] @ s
    return replace(
        surface,
        quadric=back.T @ surface.quadric @ back,
        clip=(surface.clip * _SIDES) @ back * _SIDES,
        grids=tuple(grid @ A.T + s for grid in surface.grids),
        wires=tuple(wire @ A.T + s for wire in surface.wires),
        rims=tuple(rim @ A.T + s for rim in surface.rims),
        within=tuple(back.T @ form @ back for form in surface.within),
    )
