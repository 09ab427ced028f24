"""What the drawing makes of each kind of layer: every artist with its place in points and its look, as when looked at.

`pytest tests/unit/test_draw_snapshots.py --snapshot-update` renews them.
"""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import lines
import numpy as np
import pytest
from drawing import draw
from matplotlib.artist import Artist
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.image import imread
from numpy.typing import NDArray
from syrupy.assertion import SnapshotAssertion

from atlas.draw import gl, labels, names, space, to_figure, to_plotter
from atlas.scene import Arrow, Curve, Image, Label, Plane, Points, Region, Scene, Space, solids

FloatArray = NDArray[np.float64]
MATERIAL = ("opacity", "ambient", "diffuse", "specular")
LOOKS = ("color", "facecolor", "edgecolor", "linewidth", "linestyle", "joinstyle", "alpha", "marker", "markersize")
needs_gl = pytest.mark.skipif(gl.library() is None, reason="no GL library can draw off-screen here")


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
        Plane((Curve(x[:, None] * [1e6, 1.0] + [0.0, 2.0], "second", "line"),), "$x$", ""),
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


@pytest.fixture
def kept(snapshot: SnapshotAssertion) -> SnapshotAssertion:
    """Give snapshots in lines."""
    return snapshot.use_extension(lines.Lines)


@pytest.mark.parametrize("make", [in_plane, in_space])
def test_every_layer_is_drawn_as_it_was(kept: SnapshotAssertion, make: Any) -> None:
    """Scenes that hold all that can be drawn, with no number in them that hides another."""
    figure = to_figure(make())
    figure.draw_without_rendering()
    assert list(lines.written(shown(artist, figure) for artist in artists(figure))) == kept


@pytest.mark.parametrize(
    ("make", "renderer"), [(in_plane, "vector"), (in_space, "vector"), pytest.param(in_space, "shaded", marks=needs_gl)]
)
def test_names_are_told_where_the_ink_is_as_they_were(
    kept: SnapshotAssertion, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, make: Any, renderer: str
) -> None:
    """What names keep clear of, kind by kind of its weight, and where each of them would like to stand."""
    asked: list[tuple[str, str, lines.Numbers]] = []

    def watched(
        tags: Any, ink: FloatArray, weights: FloatArray, window: Any, owners: NDArray[np.int64] | None = None
    ) -> Any:
        asked.append(("window", "", {"": on_paper(window)}))
        for tag in tags:
            numbers = {"at": on_paper([*tag.anchor, *tag.offset, *tag.extent, tag.size, *np.ravel(tag.elsewhere)])}
            asked.append(("name", f" {tag.text!r} {tag.colour} of {tag.owner}", numbers))
        for weight in np.unique(weights):
            points = ink[(weights == weight) & np.isfinite(ink).all(axis=1)]
            places = points.min(axis=0), points.max(axis=0), points.mean(axis=0), points.std(axis=0)
            asked.append((f"ink of weight {weight:.6g}", "", {"points": on_paper([len(points), *np.ravel(places)])}))
        if owners is not None:
            asked.append(("owners", "", {"": on_paper(np.bincount(owners + 1))}))
        return labels.place(tags, ink, weights, window, owners)

    for module in (space, names):
        monkeypatch.setattr(module, "place", watched)
    draw(make(), tmp_path / "a.png", renderer, dpi=72.0)
    assert list(lines.written(asked)) == kept


def test_names_in_a_crowd_stand_where_they_stood(kept: SnapshotAssertion) -> None:
    """Among ink and other names at random, each with an owner, or with another place for it, or neither."""
    rng = np.random.default_rng(5)
    found = []
    for _ in range(30):
        drawn = [labels.along(rng.uniform(0.0, 120.0, (4, 2))) for _ in range(5)]
        ink, owners = np.concatenate(drawn), np.repeat(np.arange(5), [len(line) for line in drawn])
        tags = [
            labels.Tag(
                "name",
                anchor=tuple(drawn[k][len(drawn[k]) // 3]),
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
        found += list(lines.written([("names", "", {"at": on_paper(centres)})]))
    assert found == kept


@needs_gl
def test_a_plotter_is_what_it_was(kept: SnapshotAssertion) -> None:
    """Every mesh with its extent and material, the lamps and the camera, in the coordinates of the scene."""
    plotter = to_plotter(in_space())
    try:
        found = [f"{plotter.window_size}"]
        found += [line for renderer in plotter.renderers for line in lines.written(lit(renderer))]
        assert found == kept
    finally:
        plotter.close()


def lit(renderer: Any) -> Iterator[tuple[str, str, lines.Numbers]]:
    """Yield what a renderer shows; lengths in hundredths, so that a twentieth is small beside them."""
    for name, actor in renderer.actors.items():
        if name.endswith("labels"):
            size = actor.mapper.GetInputAlgorithm().GetTextProperty().GetFontSize()
            yield "labels", f" {actor.GetVisibility()} of {size} points", {}
            continue
        mesh = actor.mapper.dataset
        props = [prop for prop in (actor.prop, actor.backface_prop) if prop is not None]
        looks = [100.0 * getattr(prop, look) for prop in props for look in MATERIAL]
        words = "".join(f" {prop.color.hex_rgb} {prop.interpolation} {prop.specular_power:g}" for prop in props)
        counts = f" {mesh.n_points} points {mesh.n_cells} cells"
        numbers = {"extent": on_paper(100.0 * np.array(actor.bounds)), "looks": on_paper(looks)}
        yield f"mesh{words}", counts, numbers
    camera = renderer.camera
    places = [*camera.position, *camera.focal_point, *camera.up, *camera.clipping_range, camera.parallel_scale]
    yield "camera", f" {camera.parallel_projection}", {"places": on_paper(100.0 * np.array(places))}
    for light in renderer.lights:
        yield "lamp", "", {"at": on_paper([100.0 * x for x in (*light.position, light.intensity)])}


@needs_gl
def test_a_shaded_picture_is_what_it_was(kept: SnapshotAssertion, tmp_path: Path) -> None:
    """In squares of twenty-four pixels, each within three grey levels: light, material, thickness and place."""
    picture = 255.0 * imread(draw(in_space(), tmp_path / "a.png", "shaded", dpi=72.0))[..., :3].astype(float)
    rows, columns = (24 * (length // 24) for length in picture.shape[:2])
    squares = picture[:rows, :columns].reshape(rows // 24, 24, columns // 24, 24, 3).mean(axis=(1, 3))
    assert [f"«{' '.join(f'{level / 60.0:.3f}' for level in row.ravel())}»" for row in squares] == kept


def artists(figure: Figure) -> Iterator[Artist]:
    """Go through what is drawn, the texts of axes and legends included."""
    for artist in figure.findobj(include_self=False):
        if artist.get_visible() and not artist.get_children():
            yield artist


def shown(artist: Artist, figure: Figure) -> tuple[str, str, lines.Numbers]:
    """Return how an artist looks, its text, and where it lies, in points."""
    extent = artist.get_window_extent().extents * 72.0 / figure.dpi
    drawn = artist.get_segments() if isinstance(artist, LineCollection) else []
    numbers = {}
    if drawn:  # it has no extent of its own
        drawn = [artist.get_transform().transform(line) * 72.0 / figure.dpi for line in drawn]
        extent = np.concatenate([np.min(np.concatenate(drawn), axis=0), np.max(np.concatenate(drawn), axis=0)])
        # as a logarithm, to a thousandth of itself: other samples of a curve make another length
        length = sum(np.linalg.norm(np.diff(line, axis=0), axis=1).sum() for line in drawn)
        numbers["length"] = on_paper(100.0 * np.log10(length))
    if np.isfinite(extent).all():
        numbers["extent"] = on_paper(extent)
    words = [type(artist).__name__, f"order {artist.get_zorder():g}", "clipped" * artist.get_clip_on()]
    words += [f"{look}={plain(getattr(artist, f'get_{look}')())}" for look in LOOKS if hasattr(artist, f"get_{look}")]
    text = ""
    if hasattr(artist, "get_text"):
        text = f" {artist.get_text()!r}"
        words.append(f"size {artist.get_fontsize():g} rotation {artist.get_rotation():g}")
    return " ".join(filter(None, words)), text, numbers


def on_paper(numbers: Any) -> tuple[str, FloatArray]:
    """Return numbers that are compared to a part of a printer's point."""
    return "«»", np.asarray(numbers, dtype=float)


def plain(value: Any) -> Any:
    """Return a look as it can be written, colours to a thousandth."""
    if isinstance(value, np.ndarray | list | tuple):
        return [plain(part) for part in value]
    return float(f"{float(value):.3f}") if isinstance(value, int | float | np.number) else value and str(value)
