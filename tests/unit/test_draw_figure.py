"""Figures on paper: whole files, the same bytes, names that cover nothing."""

import os
import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from drawing import draw
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from pypdf import PdfReader

import atlas
from atlas import AtlasError, gl
from atlas.pictures import Arrow, Curve, Image, Label, Plane, Points, Region, Scene, Space, Surface, recipes, solids
from atlas.pictures.drawing.files import _short, choose, save
from atlas.pictures.drawing.labels import MARK, NOBODY, Tag, place
from atlas.pictures.drawing.panels import to_figure
from atlas.pictures.drawing.space import silhouette
from atlas.pictures.drawing.view import fit
from atlas.pictures.style import STYLES, WHITE, contrast

IN_SPACE = ["ball", "cone", "lssc", "magn", "motion_sphere", "quadric"]


def flat_scene() -> Scene:
    """Return a scene with a panel of each kind of axis and every layer that a plane can hold."""
    x = np.linspace(0.01, 1.0, 50)
    curve = Curve(np.stack([x, x**2], axis=1), "main", "$x^2$")
    layers = (
        curve,
        Points(np.array([[0.5, 0.25]]), "special", "$B'_2$"),
        Arrow(np.array([0.1, 0.1]), np.array([0.6, 0.8]), "field", r"$\mathbf{B}'$"),
        Region(np.array([[0.2, 0.0], [0.4, 0.0], [0.4, 1.0]]), "region", "band"),
        Label(np.array([0.7, 0.2]), "$O$", offset=(4.0, 4.0)),
    )
    image = Image(np.arange(4.0), np.arange(3.0), np.array([[1e-3, 1e-2, 0.1], [1.0, 10.0, 100.0]]), "error", "log")
    panels = (
        Plane(layers, "$x$", "$y$", legend=True, title="(a)"),
        Plane(layers, "$x$", "$y$", equal=True, x_limits=(0.0, 1.0), y_limits=(0.0, 1.0)),
        Plane((curve,), "$x$", "$y$", x_scale="log", y_scale="symlog", legend="beside"),
        Plane((image,), "$x$", "$y$"),
    )
    return Scene("Flat", "A caption.", "An alternative.", panels, columns=2, size=(150.0, 120.0))


def ball_scene(**options: Any) -> Scene:
    """Return a scene with a ball and an arrow."""
    ball = solids.sphere(np.zeros(3), 1.0, 1e-2)
    arrow = Arrow(np.zeros(3), np.array([0.0, 1.5, 1.0]), "field", r"$\mathbf{B}$")
    return Scene("Ball", "A caption.", "A ball.", (Space((ball, arrow), **options),), size=(50.0, 50.0))


@pytest.mark.slow
@pytest.mark.parametrize(("make", "kind"), [(flat_scene, "svg"), (flat_scene, "pdf"), (ball_scene, "png")])
def test_a_scene_drawn_twice_has_the_same_bytes(tmp_path: Path, make: Callable[[], Scene], kind: str) -> None:
    """No date, no random name, nothing left over from the first drawing."""
    picture, second = (draw(make(), tmp_path / f"{n}.{kind}").read_bytes() for n in "ab")
    assert picture == second
    assert len(picture) > 1000


@pytest.mark.slow
def test_another_process_writes_the_same_bytes(tmp_path: Path) -> None:
    """The seed of hashing, the locale, the time zone, a reader's settings and other figures before do not matter."""
    program = (
        "import sys; from pathlib import Path\n"
        "from atlas.pictures import recipes; from atlas.pictures.drawing.files import save\n"
        "for name in ('hyperbola', 'cone', 'kinds_of_quadric'):\n"
        "    scene = recipes.load(name).scene()\n"
        "    save(scene, {Path(sys.argv[1]) / f'{name}.{kind}': kind for kind in ('pdf', 'png', 'svg')})\n"
    )
    theirs = tmp_path / "theirs"
    theirs.mkdir()
    (tmp_path / "matplotlibrc").write_text(
        "font.family: monospace\nmathtext.fontset: cm\naxes.formatter.limits: 0, 0\n", encoding="utf-8"
    )
    environment = dict(os.environ, PYTHONHASHSEED="7", TZ="Pacific/Chatham", LC_ALL="C")
    environment["MATPLOTLIBRC"] = str(tmp_path / "matplotlibrc")
    subprocess.run([sys.executable, "-c", program, str(theirs)], env=environment, check=True)
    for name in ("cone", "hyperbola", "kinds_of_quadric"):
        ours = {tmp_path / f"{name}.{kind}": kind for kind in ("pdf", "png", "svg")}
        save(recipes.load(name).scene(), ours)
        for path in ours:
            assert path.read_bytes() == (theirs / path.name).read_bytes(), path.name


def test_a_pdf_is_a_drawing_of_the_size_of_the_scene(tmp_path: Path) -> None:
    """It has one page of the scene's size and no picture of pixels, and says its title; the marks of SVG are on it."""
    scene = recipes.load("hyperbola").scene()
    pdf = PdfReader(draw(scene, tmp_path / "a.pdf"))
    (page,) = pdf.pages
    size = [float(length) for length in page.mediabox[2:]]
    assert size == pytest.approx([length * 72.0 / 25.4 for length in scene.size], abs=0.01)
    assert pdf.metadata is not None
    assert pdf.metadata.title == scene.title
    assert not page.images
    bare = draw(replace(scene, panels=(Plane((), "x", "y"),)), tmp_path / "b.pdf")
    assert (tmp_path / "a.pdf").stat().st_size > 2 * bare.stat().st_size


def test_the_page_has_the_size_of_the_scene(tmp_path: Path) -> None:
    """Sizes are in millimetres: at 254 dots an inch, ten dots each."""
    draw(ball_scene(), tmp_path / "ball.png", dpi=254.0)
    header = (tmp_path / "ball.png").read_bytes()[16:24]
    assert [int.from_bytes(header[i : i + 4], "big") for i in (0, 4)] == [500, 500]


def test_a_failing_drawing_keeps_the_old_file_alone(tmp_path: Path) -> None:
    """Whole or not at all."""
    path = tmp_path / "ball.svg"
    path.write_text("old", encoding="utf-8")
    broken = Scene("t", "c", "a", (Plane((Surface(np.eye(4), np.empty((0, 4)), ()),), "x", "y"),))
    with pytest.raises(AtlasError, match="plane panel cannot hold a Surface"):
        draw(broken, path)
    assert path.read_text(encoding="utf-8") == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_a_picture_in_space_cannot_hold_a_map(tmp_path: Path) -> None:
    """The error says where it belongs."""
    image = Image(np.arange(3.0), np.arange(3.0), np.ones((2, 2)), "error")
    with pytest.raises(AtlasError, match="panel in space cannot hold a map"):
        draw(Scene("t", "c", "a", (Space((image,)),)), tmp_path / "a.svg")


@pytest.mark.parametrize(
    ("name", "options", "words"),
    [
        ("a.gif", {}, "format 'gif'.*svg, pdf, png, pgf"),
        ("a.svg", {"renderer": "etching"}, "no renderer 'etching'; known: vector, shaded"),
        ("a.svg", {"renderer": "shaded"}, "a shaded figure is a PNG"),
    ],
)
def test_an_unknown_format_or_renderer_is_refused(
    tmp_path: Path, name: str, options: dict[str, Any], words: Any
) -> None:
    """The error says which there are."""
    if options.get("renderer") == "shaded" and gl.library() is None:
        pytest.skip("without GL the vector renderer takes over, which writes SVG")
    with pytest.raises(AtlasError, match=words):
        draw(ball_scene(), tmp_path / name, **options)


def test_without_gl_a_shaded_figure_is_drawn_on_paper(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The same file in the other style, and a line with the fact and the remedy."""
    monkeypatch.setenv(gl.CHOICE, "none")
    gl.library.cache_clear()
    try:
        done = draw(ball_scene(), tmp_path / "ball.png", "shaded").read_bytes()
        used, note = choose(ball_scene(), "shaded")
    finally:
        gl.library.cache_clear()
    assert used == "vector"
    assert "apt-get install" in note
    assert "\n" not in note
    assert done == draw(ball_scene(), tmp_path / "paper.png").read_bytes()


def test_a_flat_figure_asked_for_shaded_is_drawn_on_paper(tmp_path: Path) -> None:
    """There is nothing to shade, and nothing to say."""
    assert draw(flat_scene(), tmp_path / "flat.svg", "shaded").exists()
    assert choose(flat_scene(), "shaded") == ("vector", "")


def boxes(figure: Figure) -> list[tuple[str, Any]]:
    """Return the extents of all names of a figure, in pixels, with their text."""
    renderer = FigureCanvasAgg(figure).get_renderer()
    names = [text for axes in figure.axes for text in axes.texts if text.get_text() and not text.get_path_effects()]
    return [(text.get_text(), text.get_window_extent(renderer).extents) for text in names]


def test_a_label_beside_the_panel_is_drawn() -> None:
    """Beside the panel, too."""
    curve = Curve(np.array([[0.0, 0.0], [1.0, 1.0]]), "main")
    label = Label(np.array([1.02, 0.5]), "beside")
    panel = Plane((curve, label), "$x$", "$y$", (0.0, 1.0), (0.0, 1.0))
    figure = to_figure(Scene("A line", "A caption.", "A line.", (panel,)))
    renderer = FigureCanvasAgg(figure).get_renderer()
    boxes_drawn = [text.get_tightbbox(renderer) for text in figure.axes[0].texts if text.get_text() == "beside"]
    assert boxes_drawn
    assert all(box.width > 0.0 for box in boxes_drawn)


@pytest.mark.parametrize("name", IN_SPACE)
def test_names_on_a_plate_stay_on_the_page_and_do_not_overlap(name: str) -> None:
    """Each name of the default figure is inside the page and clear of every other."""
    figure = to_figure(recipes.load(name).scene())
    text_boxes = boxes(figure)
    assert len(text_boxes) >= 4
    for text, (x_left, bottom, x_right, top) in text_boxes:
        assert x_left >= 0.0, text
        assert x_right <= figure.bbox.width, text
        assert bottom >= 0.0, text
        assert top <= figure.bbox.height, text
    for i, (text, a) in enumerate(text_boxes):
        for name_other, b in text_boxes[i + 1 :]:
            overlap = (min(a[2], b[2]) - max(a[0], b[0]), min(a[3], b[3]) - max(a[1], b[1]))
            assert min(overlap) <= 0.0, (text, name_other)


@pytest.mark.parametrize("name", IN_SPACE)
def test_a_plate_fills_its_page(name: str, tmp_path: Path) -> None:
    """Marks reach within a tenth of the page's width or height from both edges, and are not cut off."""
    from matplotlib.image import imread

    picture = imread(draw(recipes.load(name).scene(), tmp_path / "figure.png", dpi=50.0))
    ink = picture[..., :3].min(axis=2) < 250.0 / 255.0
    rows, columns = np.flatnonzero(ink.any(axis=1)), np.flatnonzero(ink.any(axis=0))
    height, width = ink.shape
    margins = [rows[0] / height, 1.0 - rows[-1] / height, columns[0] / width, 1.0 - columns[-1] / width]
    assert min(margins) > 0.0
    assert max(margins[:2]) < 0.1 or max(margins[2:]) < 0.1


@pytest.mark.parametrize("name", ["quadric", "cone", "motion_sphere"])
def test_the_silhouette_lies_on_the_surface_where_the_line_of_sight_grazes_it(name: str) -> None:
    """Each of its points has F = 0 and grad F . d = 0, to eps times the size of their terms."""
    (panel,) = recipes.load(name).scene().panels
    assert isinstance(panel, Space)

    view = fit(panel, (300.0, 250.0))
    count = 0
    for surface in view.surfaces:
        for line in silhouette(surface, view):
            count += len(line)
            x = np.concatenate([line, np.ones((len(line), 1))], axis=1)
            d = np.append(view.towards, 0.0)
            size = np.sum((np.abs(x) @ np.abs(surface.quadric)) * np.abs(x), axis=1).max()
            assert np.abs(np.sum((x @ surface.quadric) * x, axis=1)).max() < 1e-12 * size
            assert np.abs(x @ surface.quadric @ d).max() < 1e-12 * size
            assert (line @ surface.clip[:, :3].T <= surface.clip[:, 3] + 1e-12).all()
    assert count > 10


def test_pieces_of_a_line_too_short_to_see_are_not_drawn() -> None:
    """Rounding may leave a piece of a line where it touches a surface: that is not drawn, on no machine."""
    (ball, arrow) = ball_scene().panels[0].layers
    bit = Curve(np.array([[0.0, 0.0, 1.0], [0.0, 0.0, 1.0 + 1e-9]]), "loop")
    segments = []
    for layers in ((ball, arrow), (ball, arrow, bit)):
        axes = to_figure(replace(ball_scene(), panels=(Space(layers),))).axes[0]
        segments.append([len(lines.get_segments()) for lines in axes.collections])
    assert segments[0] == segments[1]


def test_a_name_moves_away_from_ink() -> None:
    """Placed on a dense patch of ink it finds a place beside it; one that must stay stays."""
    patch = np.stack(np.meshgrid(np.linspace(50.0, 70.0, 30), np.linspace(50.0, 70.0, 30)), axis=-1).reshape(-1, 2)
    moving = Tag("a", (50.0, 50.0), (3.0, 3.0), (12.0, 8.0), "#000000", 9.0)
    fixed = Tag("b", (60.0, 60.0), (0.0, 0.0), (12.0, 8.0), "#000000", 9.0)
    centres = place([moving, fixed], [(patch, 1.0, NOBODY)], (0.0, 0.0, 100.0, 100.0))
    low, high = centres[0] - (6.0, 4.0), centres[0] + (6.0, 4.0)
    assert not ((patch > low) & (patch < high)).all(axis=1).any()
    assert centres[1].tolist() == [60.0, 60.0]


@pytest.mark.parametrize("seed", range(4))
def test_a_name_leaves_marks_whole(seed: int) -> None:
    """Where there is room, the box of a name begins beyond the rims of all marks, not only beyond their middles."""
    places = np.random.default_rng(seed).uniform(0.2, 0.8, (7, 2))
    marks = tuple(Points(place[None], "main", "plain name") for place in places)
    panel = Plane(marks, "$x$", "$y$", (0.0, 1.0), (0.0, 1.0))
    figure = to_figure(Scene("Marks", "A caption.", "Marks.", (panel,), size=(110.0, 60.0)))
    figure.draw_without_rendering()
    renderer, axes = FigureCanvasAgg(figure).get_renderer(), figure.axes[0]
    for box in (text.get_window_extent(renderer) for text in axes.texts):
        for line in axes.lines:
            middle = axes.transData.transform(line.get_xydata())[0]
            away = np.maximum(0.0, np.maximum(box.min - middle, middle - box.max))
            assert np.hypot(*away) >= 0.5 * line.get_markersize() * figure.dpi / 72.0


@pytest.mark.parametrize("role", list(STYLES))
def test_every_style_can_be_drawn(role: str) -> None:
    """Colours are those of a printer: six hexadecimal digits; widths and opacities are in their range."""
    look = STYLES[role]
    for colour in filter(None, (look.colour, look.back)):
        assert len(colour) == 7
        assert int(colour[1:], 16) >= 0
    assert 0.0 <= look.fill <= 1.0
    assert 0.0 <= look.glass <= 1.0
    assert look.width > 0.0
    assert len(look.dash) % 2 == 0


@pytest.mark.parametrize("mapped", [False, True])
def test_dark_marks_stand_off_a_map_by_a_white_ring(mapped: bool) -> None:
    """On a map of values the edge of a dark mark is white, so that it is seen in grey print; elsewhere its own."""
    edges = np.array([0.0, 1.0, 2.0])
    under = (Image(edges, edges, np.zeros((2, 2)), ""),) if mapped else ()
    panel = Plane((*under, Points(np.array([[1.0, 1.0]]), "special")), "$x$", "$y$")
    (mark,) = to_figure(Scene("a", "b", "c", (panel,))).axes[0].get_lines()
    assert (mark.get_markeredgecolor() == WHITE) is mapped
    assert mark.get_markerfacecolor() != WHITE


def test_a_path_of_an_svg_is_short_and_the_same() -> None:
    """To a hundredth of a point, each point from the one before, none twice; other text stays."""
    path = (
        '<path d="M 1.234567 2 \nL 1.2349 2.001 \nL 3.5 -0.001 \nQ 1 2 3.14159 4 \nL 5 6 \nz\nM 1 1 \n" '
        'style="w: 1.2345"/>'
    )
    assert _short(path) == '<path d="m1.23 2 2.27-2q-2.5 2-.36 4l1.86 2zm-.23-1" style="w: 1.2345"/>'


ROD = np.array([[0.0, 0.0], [1.0, 1.0]])


def plane_of(*layers: Curve | Points | Label) -> Plane:
    """Return a panel of the unit square."""
    return Plane(layers, "$x$", "$y$", (0.0, 1.0), (0.0, 1.0))


@pytest.mark.parametrize(
    ("place", "is_whole"), [((0.0, 0.5), True), ((0.5, 1.0), True), ((0.5, 0.5), False), ((-0.1, 0.5), False)]
)
def test_a_mark_on_the_frame_is_drawn_whole(place: tuple[float, float], is_whole: bool) -> None:
    """Not cut in two by the frame; marks within may be moved out of sight, and one outside is not drawn."""
    axes = to_figure(Scene("a", "b", "c", (plane_of(Curve(ROD, "main"), Points(np.array([place]), "start")),))).axes[0]
    line, mark = axes.get_lines()
    assert mark.get_clip_on() is not is_whole
    assert line.get_clip_on()


def test_a_legend_finds_curves_named_by_a_label() -> None:
    """A label names the last curve or points of its role that have no name: ``axes.legend()`` lists them."""
    layers = (Curve(ROD, "guide"), Curve(ROD, "main"), Points(ROD, "rest"), Label(ROD[0], "$a$", "main"))
    panel = plane_of(*layers, Curve(ROD, "second", "$b$"), Label(ROD[1], "rest", "rest"), Label(ROD[1], "note", "main"))
    handles, labels = to_figure(Scene("a", "b", "c", (panel,))).axes[0].get_legend_handles_labels()
    assert labels == ["$a$", "rest", "$b$"]
    assert [handle.get_gid() for handle in handles] == ["main-1-2", "rest-1-3", "second-1-5"]


def test_the_components_of_a_motion_are_in_a_legend() -> None:
    """The plot of a motion has the names of the three components of its angular velocity."""
    axes = atlas.GeneralMotion(1.5, (1.0, 2.0), (0.3, 0.7, 0.2)).plot(panel=2).axes[0]
    assert [text.get_text() for text in axes.legend().get_texts()] == [rf"$\Omega_{i}$" for i in (1, 2, 3)]


def test_an_unlabelled_line_displaces_no_label() -> None:
    """A line with no name does not drive another line's name away, where a line that may have one does."""
    line_own, line_other = (
        np.stack([np.linspace(0.0, 90.0, 91), np.full(91, height)], axis=1) for height in (50.0, 62.5)
    )
    tag = Tag("a", (45.0, 50.0), (0.0, 4.0), (12.0, 8.0), "#000000", 9.0, owner=0)
    window = (0.0, 0.0, 90.0, 90.0)
    place_beside, away = (
        place([tag], [(line_own, 1.5, 0), (line_other, 0.2, whose)], window)[0] for whose in (NOBODY, 1)
    )
    assert place_beside[1] > 50.0 > away[1]


def test_a_name_of_a_point_stands_beside_that_point() -> None:
    """A marked point above the name drives it to another side, where a line would not."""
    window = (0.0, 0.0, 90.0, 90.0)
    tag = Tag("a", (45.0, 45.0), (0.0, 4.0), (12.0, 8.0), "#000000", 9.0)
    points_own, points_other = np.array([[45.0, 45.0]]), np.array([[45.0, 58.5]])
    place_alone, place_beside = (
        place([tag], [(points_own, MARK, 0), (points_other, cost, 1)], window)[0] for cost in (1.5, MARK)
    )
    assert place_beside[1] < place_alone[1] == 53.0


def test_curves_on_a_sphere_stand_off_its_graticule_in_grey() -> None:
    """The thinnest of them is darker and at least twice as wide as meridians and parallels."""
    wire = STYLES["wire"]
    for role in ("trace", "second_trace", "trajectory", "reference"):
        assert contrast(STYLES[role].colour) >= 1.5 * contrast(wire.colour), role
        assert STYLES[role].width >= 2.0 * wire.width, role
