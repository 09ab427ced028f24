"""What lies on paper: every artist of a figure with its place in points and its look, as it was when looked at.

`pytest tests/unit/test_draw_snapshots.py --snapshot-update` renews them. The scenes are those of `test_snapshots`; here
is kept what the drawing makes of them.
"""

import json
from collections.abc import Iterator
from dataclasses import astuple, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from drawing import draw
from matplotlib.artist import Artist
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.image import imread
from numpy.typing import NDArray
from syrupy.assertion import SnapshotAssertion
from syrupy.extensions.json import JSONSnapshotExtension

from atlas.draw import gl, labels, names, space, to_figure, to_plotter
from atlas.scene import Arrow, Curve, Image, Label, Plane, Points, Region, Scene, Space, recipes, solids

FloatArray = NDArray[np.float64]
POINTS = 0.05
"""What another processor's rounding may move, in printer's points: a fifth of a hair."""

NAMES = "colours cone hyperbola hyperbolas loop lssc magn motion_sphere quadric separatrix stability_map".split()
"""Hidden lines, glass and seams, arrows, names; curves, regions, legends, images, logarithms."""

MATERIAL = ("opacity", "ambient", "diffuse", "specular")
needs_gl = pytest.mark.skipif(gl.library() is None, reason="no GL library can draw off-screen here")

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


def in_plane() -> Scene:
    """Return a scene with each kind of axes, and with every layer that a plane can hold."""
    x = np.linspace(-0.7, 1.9, 40)
    curve = Curve(np.stack([x, 300.0 * x**3], axis=1), "main", "$x^3$")
    steep = Curve(np.stack([np.exp(4.0 * x), 3e-7 * np.exp(9.0 * x)], axis=1), "reference", "steep")
    low = Label(np.array([[0.7, -60.0], [1.1, -60.0]]), "low", offset=(-6.0, 4.0))
    layers = (
        Region(np.array([[0.2, 0.0], [0.4, 0.0], [0.4, 500.0]]), "unstable_region", "band"),
        curve,
        Points(np.array([[0.5, 37.5], [1.0, 300.0]]), "special", "$B'_2$"),
        Points(np.array([[-0.3, 700.0]]), "rest"),
        Points(np.array([[-0.3, 900.0]]), "sample"),
        Arrow(np.array([0.1, 100.0]), np.array([1.6, 800.0]), "field", r"$\mathbf{B}'$"),
        low,
    )
    values = np.array([[1e-3, np.nan, 0.1], [1.0, 10.0, 150.0]])
    image = Image(np.geomspace(0.1, 100.0, 4), np.array([-1.0, 0.5, 2.0]), values, "error", "log")
    panels = (
        Plane(layers, "$x$", "$y$", legend=True, title="(a)"),
        Plane(layers, "$x$", "$y$", x_limits=(-1.0, 2.5), y_limits=(-200.0, 1500.0), title="(b)"),
        Plane(layers[1:3], "$x$", "$y$", equal=True),
        Plane((curve, steep), "$x$", "$y$", y_scale="symlog", legend="beside"),
        Plane((steep,), "$x$", "$y$", x_scale="log", y_scale="log"),
        Plane((image,), "$x$", "$y$", x_scale="log"),
        Plane((Curve(x[:, None] * [1e6, 1.0] + [0.0, 2.0], "second", "line"),), "$x$", "", y_names=("one", "two")),
        Plane((replace(image, limits=(0.01, 20.0), scale="linear"),), "$x$", "$y$"),
    )
    return Scene("Flat", "A caption.", "An alternative.", panels, columns=2, size=(170.0, 260.0))


def in_space() -> Scene:
    """Return a scene of two panels with every layer that space can hold, off the origin, of another size than one."""
    at = np.array([3.0, -1.0, 2.0])

    def by(*step: float) -> Any:
        return at + np.array(step)

    ball = solids.sphere(at, 0.9, 2e-2)
    lid = solids.disk(by(0.0, 0.3, 1.1), np.array([0.0, 0.6, 0.8]), 0.7, 2e-2)
    layers = (
        ball,
        replace(lid, label="lid"),
        solids.cylinder(by(0.0, -1.7, 0.0), np.array([1.0, 0.0, 0.0]), 0.4, 1.1, 2e-2, role="solid"),
        Curve(at + np.array([[0.2, -1.6, 0.1], [0.2, 1.8, 0.1], [0.9, 1.8, 1.3]]), "asymptote", "line"),
        Curve(at + np.array([[1.4, -0.6, 0.0], [1.4, 0.7, 0.5]]), "trajectory"),
        Arrow(at, by(0.5, 1.1, 1.2), "field", r"$\mathbf{B}$"),
        Arrow(at, by(-2.1, 0.0, -0.3), "momentum", "$m$", offset=(3.0, -6.0)),
        Points(at + np.array([[1.2, 0.3, 0.4], [-1.2, 0.3, 0.4]]), "special", "$P$"),
        Label(by(0.0, -0.9, -0.4), "sphere", offset=(-9.0, 5.0)),
    )
    panels = (Space(layers, azimuth=35.0, elevation=20.0, title="(a)"), Space(layers[::-1], -110.0, -40.0))
    return Scene("Space", "A caption.", "An alternative.", panels, columns=2, size=(150.0, 80.0))


@pytest.mark.parametrize("make", [in_plane, in_space])
def test_every_layer_is_drawn_as_it_was(snapshot: SnapshotAssertion, make: Any) -> None:
    """The same of scenes that hold all that can be drawn, with no number in it that hides another."""
    figure = to_figure(make())
    figure.draw_without_rendering()
    assert [shown(artist, figure) for artist in artists(figure)] == snapshot.use_extension(OnPaper)


@pytest.mark.parametrize(
    ("make", "renderer"), [(in_plane, "vector"), (in_space, "vector"), pytest.param(in_space, "shaded", marks=needs_gl)]
)
def test_names_are_told_where_the_ink_is_as_they_were(
    snapshot: SnapshotAssertion, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, make: Any, renderer: str
) -> None:
    """What names keep clear of, kind by kind of its weight, and where each of them would like to stand."""
    asked: list[dict[str, Any]] = []

    def watched(
        tags: Any, ink: FloatArray, weights: FloatArray, window: Any, owners: NDArray[np.int64] | None = None
    ) -> Any:
        record: dict[str, Any] = {"window": plain(window), "tags": [plain(astuple(tag)) for tag in tags]}
        for weight in np.unique(weights):
            points = ink[(weights == weight) & np.isfinite(ink).all(axis=1)]
            places = np.stack([points.min(axis=0), points.max(axis=0), points.mean(axis=0), points.std(axis=0)])
            record[f"{weight:.6g}"] = {"count": len(points), "places": plain(places)}
        record["owners"] = None if owners is None else plain(np.bincount(owners + 1))
        asked.append(record)
        return labels.place(tags, ink, weights, window, owners)

    for module in (space, names):
        monkeypatch.setattr(module, "place", watched)
    draw(make(), tmp_path / "a.png", renderer, dpi=72.0)
    assert asked == snapshot.use_extension(OnPaper)


def test_names_in_a_crowd_stand_where_they_stood(snapshot: SnapshotAssertion) -> None:
    """Among ink and other names at random, each with an owner, or with another place for it, or neither."""
    rng = np.random.default_rng(5)
    found = []
    for _ in range(30):
        lines = [labels.along(rng.uniform(0.0, 120.0, (4, 2))) for _ in range(5)]
        ink, owners = np.concatenate(lines), np.repeat(np.arange(5), [len(line) for line in lines])
        tags = [
            labels.Tag(
                "name",
                anchor=tuple(lines[k][len(lines[k]) // 3]),
                offset=tuple(rng.uniform(-6.0, 6.0, 2)) if k != 2 else (0.0, 0.0),
                extent=tuple(rng.uniform(7.0, 30.0, 2)),
                colour="#000000",
                size=9.0,
                elsewhere=tuple(map(tuple, rng.uniform(10.0, 110.0, (k % 3, 2)))),
                owner=k if k < 4 else -1,
            )
            for k in range(5)
        ]
        centres = labels.place(tags, ink, rng.uniform(0.5, 4.0, len(ink)), (1.0, 1.0, 119.0, 119.0), owners)
        found.append([[round(float(x), 2) for x in centre] for centre in centres])
    assert found == snapshot.use_extension(OnPaper)


@needs_gl
def test_a_plotter_is_what_it_was(snapshot: SnapshotAssertion) -> None:
    """Every mesh with its extent and material, the lamps and the camera, in the coordinates of the scene."""
    plotter = to_plotter(in_space())
    try:
        panels = [lit(renderer) for renderer in plotter.renderers]
        assert {"size": plotter.window_size, "panels": panels} == snapshot.use_extension(OnPaper)
    finally:
        plotter.close()


def lit(renderer: Any) -> dict[str, Any]:
    """Return what a renderer shows; lengths in hundredths, so that `POINTS` is small beside them."""
    meshes = []
    for name, actor in renderer.actors.items():
        if name.endswith("labels"):
            meshes.append({"labels": True, "shown": actor.GetVisibility()})
            continue
        looks = [
            {
                "colour": prop.color.hex_rgb,
                "numbers": [100.0 * getattr(prop, look) for look in MATERIAL] + [prop.specular_power],
                "shading": str(prop.interpolation),
            }
            for prop in (actor.prop, actor.backface_prop)
            if prop is not None
        ]
        mesh = actor.mapper.dataset
        counts = [mesh.n_points, mesh.n_cells]
        meshes.append({"extent": [round(100.0 * x, 2) for x in actor.bounds], "counts": counts, "looks": looks})
    camera = renderer.camera
    places = [camera.position, camera.focal_point, camera.up, camera.clipping_range, [camera.parallel_scale]]
    lamps = [[*light.position, light.intensity] for light in renderer.lights]
    lengths = [[round(100.0 * float(x), 2) for x in place] for place in (*places, *lamps)]
    return {"meshes": meshes, "lengths": lengths, "parallel": camera.parallel_projection}


@needs_gl
def test_a_shaded_picture_is_what_it_was(snapshot: SnapshotAssertion, tmp_path: Path) -> None:
    """In squares of twelve pixels, each within three grey levels: light, material, thickness and place."""
    picture = 255.0 * imread(draw(in_space(), tmp_path / "a.png", "shaded", dpi=72.0))[..., :3].astype(float)
    rows, columns = (12 * (length // 12) for length in picture.shape[:2])
    squares = picture[:rows, :columns].reshape(rows // 12, 12, columns // 12, 12, 3).mean(axis=(1, 3))
    kept = snapshot.use_extension(OnPaper)
    assert [[round(POINTS / 3.0 * level, 4) for level in row.ravel()] for row in squares] == kept


def artists(figure: Figure) -> Iterator[Artist]:
    """Go through what is drawn, the texts of axes and legends included."""
    for artist in figure.findobj(include_self=False):
        if artist.get_visible() and not artist.get_children():
            yield artist


def shown(artist: Artist, figure: Figure) -> dict[str, Any]:
    """Return where an artist lies, in points, and how it looks."""
    extent = artist.get_window_extent().extents * 72.0 / figure.dpi
    lines = artist.get_segments() if isinstance(artist, LineCollection) else []
    if lines:  # it has no extent of its own
        lines = [artist.get_transform().transform(line) * 72.0 / figure.dpi for line in lines]
        extent = np.concatenate([np.min(np.concatenate(lines), axis=0), np.max(np.concatenate(lines), axis=0)])
    record = {"is": type(artist).__name__, "order": round(artist.get_zorder(), 6), "clipped": artist.get_clip_on()}
    record |= {"extent": [round(float(x), 2) for x in extent] if np.isfinite(extent).all() else None}
    if lines:  # as a logarithm, to a thousandth of itself: other samples of a curve make another length
        length = sum(np.linalg.norm(np.diff(line, axis=0), axis=1).sum() for line in lines)
        record["length"] = round(100.0 * float(np.log10(length)), 2)
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
