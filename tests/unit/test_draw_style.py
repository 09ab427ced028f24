"""Objects that a user gets and may change: figures and plotters, style sheets, text that can be searched, PGF."""

import shutil
import subprocess
from itertools import combinations
from pathlib import Path

import matplotlib as mpl
import numpy as np
import pytest
from drawing import draw
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from pypdf import PdfReader

import atlas
from atlas import AtlasError, gl
from atlas.pictures import Curve, Image, Plane, Points, Scene, recipes
from atlas.pictures.drawing.files import save
from atlas.pictures.drawing.panels import to_figure
from atlas.pictures.drawing.style import context, style_of
from atlas.pictures.drawing.text import typeset
from atlas.pictures.style import LINES, STYLES, Style, contrast, readable


def lines(count: int = 1) -> Scene:
    """Return a scene with plotted lines in order of importance."""
    curves = tuple(Curve(np.array([[0.0, k], [1.0, k]]), role) for k, role in enumerate(LINES[:count]))
    return Scene("Lines", "A caption.", "An alternative.", (Plane(curves, "$x$", "height of lines"),))


def test_a_figure_by_name_is_an_ordinary_figure() -> None:
    """Its axes are Matplotlib's own, with the limits and the lines of the scene."""
    figure = atlas.figure("hyperbola", ratio=0.5, field=[1.0, 0.2])
    assert isinstance(figure, Figure)
    (axes,) = figure.axes
    assert isinstance(axes, Axes)
    (panel,) = recipes.load("hyperbola").scene(ratio=0.5, field=(1.0, 0.2)).panels
    assert isinstance(panel, Plane)
    assert axes.get_xlim() == panel.x_limits
    points_drawn = [line.get_xydata() for line in axes.lines]
    for layer in panel.layers:
        if isinstance(layer, Curve):
            assert any(np.array_equal(layer.points, points) for points in points_drawn)


@pytest.mark.parametrize(("name", "words"), [("hyperbola", "rest"), ("stability", "unstable"), ("flight", "in space")])
def test_the_text_of_a_pdf_can_be_searched(tmp_path: Path, name: str, words: str) -> None:
    """Titles, names and the letters of formulas are text, in embedded fonts."""
    (page,) = PdfReader(draw(recipes.load(name).scene(), tmp_path / "a.pdf")).pages
    text = page.extract_text()
    assert words in text
    assert any(letter in text for letter in "ωτE")
    fonts = page["/Resources"]["/Font"]
    assert fonts
    for font in fonts.values():
        one = font.get_object()
        one = one["/DescendantFonts"][0].get_object() if "/DescendantFonts" in one else one
        assert "/FontFile2" in one["/FontDescriptor"].get_object()


def test_the_look_of_plotted_lines_is_the_cycle_of_the_sheet() -> None:
    """Colours and widths of the lines are those of axes.prop_cycle, in its order."""
    with context():
        cycle = list(mpl.rcParams["axes.prop_cycle"])
    (axes,) = to_figure(lines(len(LINES))).axes
    for line, style in zip(axes.lines, cycle, strict=True):
        assert mpl.colors.same_color(line.get_color(), style["color"])
        assert line.get_linewidth() == style["linewidth"]
    (axes,) = to_figure(lines(len(LINES)), {"lines.linewidth": 3.25}).axes
    assert {line.get_linewidth() for line in axes.lines} == {3.25}


def test_dashes_of_a_sheet_agree_with_matplotlib() -> None:
    """By their sign and by their name, of the pattern that the settings have for them."""
    for linestyle in ("--", "dashed", "-.", "dashdot", ":", "dotted", "-", "solid"):
        word = {"--": "dashed", "-.": "dashdot", ":": "dotted"}.get(linestyle, linestyle)
        with context({"axes.prop_cycle": mpl.cycler(linestyle=[linestyle]), "lines.dotted_pattern": [1.5, 2.5]}):
            assert style_of("main").dash == tuple(mpl.rcParams.get(f"lines.{word}_pattern", ()))


def test_a_style_sheet_of_the_user_changes_the_look(tmp_path: Path) -> None:
    """A file or a dict is layered over the sheet of the package: its settings hold, the others stay."""
    sheet = tmp_path / "mine.mplstyle"
    sheet.write_text("axes.labelsize: 13\naxes.prop_cycle: cycler('color', ['ff0000'])\n", encoding="utf-8")
    for style in (sheet, str(sheet), {"axes.labelsize": 13, "axes.prop_cycle": mpl.cycler(color=["#ff0000"])}):
        (axes,) = to_figure(lines(), style).axes
        assert axes.xaxis.label.get_fontsize() == 13.0
        assert axes.lines[0].get_color() == "#ff0000"
        assert axes.xaxis.label.get_fontfamily() == ["STIXGeneral"]
    plain, restyled = draw(lines(), tmp_path / "a.svg").read_bytes(), tmp_path / "b.svg"
    save(lines(), {restyled: "svg"}, style=str(sheet))
    assert restyled.read_bytes() != plain


def test_a_list_that_begins_with_default_replaces_the_sheet() -> None:
    """Then nothing of the package's fonts is left."""
    (axes,) = to_figure(lines(), ["default"]).axes
    assert axes.xaxis.label.get_fontfamily() == mpl.rcParamsDefault["font.family"]


def test_names_with_commas_are_layered() -> None:
    """As on the command line: --style ggplot,grayscale."""
    (axes,) = to_figure(lines(), "ggplot,grayscale").axes
    assert axes.lines[0].get_color() == "#000000"


def test_the_settings_of_the_user_stay_as_they_were() -> None:
    """Nothing that is set for a figure is left behind."""
    before = dict(mpl.rcParams)
    to_figure(lines(), "ggplot")
    assert dict(mpl.rcParams) == before


def test_a_style_that_cannot_be_used_is_one_line(monkeypatch: pytest.MonkeyPatch) -> None:
    """The error names the style; one that needs LaTeX says so where there is none."""
    for name in ("etching", "no.such"):
        with pytest.raises(AtlasError, match=rf"the style '{name}' .*: it is no file, nor a name of Matplotlib's\.$"):
            to_figure(lines(), name)
    monkeypatch.setattr(shutil, "which", lambda _: None)
    with pytest.raises(AtlasError, match=r"no LaTeX.*no-latex"):
        to_figure(lines(), {"text.usetex": True})


def test_a_style_is_never_fetched(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """An address is refused, one of a file of this machine as well; also among other names."""
    (tmp_path / "mine.mplstyle").write_text("lines.linewidth: 7")
    monkeypatch.setattr("urllib.request.urlopen", lambda *_: pytest.fail("it is fetched"))
    for style in ("http://127.0.0.1:9/a.mplstyle", "https://x", "ftp://x", (tmp_path / "mine.mplstyle").as_uri()):
        for style_list in (style, ["ggplot", style]):
            with pytest.raises(AtlasError, match="it is an address, and nothing is fetched"):
                to_figure(lines(), style_list)


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"\xff\xfe", r"is no text in UTF-8\.$"),
        (b"nosuch: 1", r"Bad key nosuch in file .*, line 1 \('nosuch: 1'\)$"),
        (b"lines.linewidth: fish", r"line 1 .*: Could not convert 'fish' to float$"),
    ],
)
def test_an_invalid_style_sheet_is_refused_with_its_line(tmp_path: Path, content: bytes, words: str) -> None:
    """The fault and its line, without advice about a file of Matplotlib's."""
    (tmp_path / "mine.mplstyle").write_bytes(content)
    with pytest.raises(AtlasError, match=words):
        to_figure(lines(), tmp_path / "mine.mplstyle")


def test_pgf_needs_no_latex_to_be_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Texts are written as TeX, primes too, and twice the same."""
    monkeypatch.setenv("PATH", str(tmp_path))
    pgf, second = (draw(recipes.load("cone").scene(), tmp_path / f"{n}.pgf").read_text("utf-8") for n in "ab")
    assert pgf == second
    assert r"\mathbf{B}'" in pgf
    assert "′" not in pgf


@pytest.mark.slow
@pytest.mark.skipif(not shutil.which("pdflatex"), reason="no pdflatex here")
def test_pgf_compiles(tmp_path: Path) -> None:
    """A document that inputs figures, one with underscores in its names, is set without an error."""
    names = ("cone", "stability", "motion")
    for name in names:
        draw(recipes.load(name).scene(), tmp_path / f"{name}.pgf")
    inputs = "".join(rf"\input{{{name}.pgf}}\newpage" for name in names)
    document = rf"\documentclass{{article}}\usepackage{{pgf,amsmath}}\begin{{document}}{inputs}\end{{document}}"
    (tmp_path / "all.tex").write_text(document, encoding="utf-8")
    words = ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "all.tex"]
    done = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, errors="replace", check=False)
    if "pgf.sty' not found" in done.stdout:
        pytest.skip("this LaTeX has no pgf")
    assert done.returncode == 0, done.stdout[-2000:]
    assert len(PdfReader(tmp_path / "all.pdf").pages) >= len(names)


def test_a_map_is_refused_as_pgf(tmp_path: Path) -> None:
    """PGF holds no pixels: the error names the format to ask for."""
    image = Image(np.arange(3.0), np.arange(3.0), np.ones((2, 2)), "error")
    line = Curve(np.eye(2), "main")
    with pytest.raises(AtlasError, match="ask for a PDF"):
        draw(Scene("t", "c", "a", (Plane((line,), "x", "y"), Plane((image, line), "x", "y"))), tmp_path / "a.pgf")
    assert not list(tmp_path.iterdir())


def test_a_plotter_needs_a_panel_in_space() -> None:
    """The error names the function that draws the scene."""
    with pytest.raises(AtlasError, match=r"atlas\.figure"):
        atlas.plotter("hyperbola")


@pytest.mark.slow
@pytest.mark.skipif(gl.library() is None, reason="no GL library can draw off-screen here")
def test_a_plotter_that_may_be_turned_peels() -> None:
    """Depth peeling is used in the picture, without antialiasing, in the coordinates of the scene; names are labels."""
    plotter = atlas.plotter("quadric")
    assert plotter.shape == (1, len(recipes.load("quadric").scene().panels))  # side by side
    try:
        picture = plotter.screenshot(return_img=True)
        assert plotter.renderer.GetLastRenderingUsedDepthPeeling()
        assert plotter.render_window.GetMultiSamples() == 0
        low, high = np.array(plotter.bounds).reshape(3, 2).T
        (panel,) = recipes.load("quadric").scene().panels
        for layer in panel.layers:
            if isinstance(layer, Curve):
                assert (layer.points >= low - 1e-6).all()
                assert (layer.points <= high + 1e-6).all()
        assert any(name.endswith("labels") for name in plotter.actors)
        plotter.camera.azimuth += 60.0
        plotter.render()
        assert (plotter.screenshot(return_img=True) != picture).any()
    finally:
        plotter.close()


VECTORS = ("field", "field_inverse", "electric", "momentum", "direction", "velocity", "body_axis")
# How red, green and blue (linear) are seen without the red, the green or the blue cones: Machado, Oliveira and
# Fernandes, IEEE Trans. Vis. Comput. Graph. 15 (2009) 1291, severity 1.
CONES = {
    "all": np.eye(3),
    "no red": np.array([[0.152, 1.053, -0.205], [0.115, 0.786, 0.099], [-0.004, -0.048, 1.052]]),
    "no green": np.array([[0.367, 0.861, -0.228], [0.280, 0.673, 0.047], [-0.012, 0.043, 0.969]]),
    "no blue": np.array([[1.256, -0.077, -0.179], [-0.078, 0.931, 0.148], [0.005, 0.691, 0.304]]),
}


def lab(linear: np.ndarray) -> np.ndarray:
    """Return the place of a linear RGB colour in CIELAB, whose distances are those of perception."""
    to_xyz = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])
    x, y, z = np.cbrt(to_xyz @ np.clip(linear, 0.0, 1.0) / to_xyz.sum(axis=1))
    return np.array([116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)])


@pytest.mark.parametrize("role", STYLES)
def test_a_name_can_be_read_on_white(role: str) -> None:
    """The text of every role has a contrast of 4.5 at least, by the luminance that Matplotlib's colours have."""
    red, green, blue = (((c + 0.055) / 1.055) ** 2.4 for c in mpl.colors.to_rgb(readable(STYLES[role].colour)))
    assert 1.05 / (0.05 + 0.2126 * red + 0.7152 * green + 0.0722 * blue) >= 4.5


@pytest.mark.parametrize("ground", ["#000000", "#30343c", "#767676", "#e5e5e5"])
def test_a_name_can_be_read_on_any_ground(ground: str) -> None:
    """It becomes lighter on a dark one, darker on a light one."""
    assert all(contrast(readable(look.colour, ground), ground) >= 4.5 for look in STYLES.values())


def test_on_a_dark_style_halos_are_dark_and_marks_are_light() -> None:
    """Below a name lies its outline in the colour of the ground, and no line or mark has the colour of it."""
    figure = to_figure(recipes.load("motion").scene(), "dark_background")
    halos = [text.get_path_effects() for axes in figure.axes for text in axes.texts if text.get_path_effects()]
    assert halos
    assert all(mpl.colors.to_hex(halo._gc["foreground"]) == "#000000" for (halo,) in halos)
    for dark in ("dark_background", {"axes.facecolor": "#000000", "figure.facecolor": "#000000"}):
        with context(dark):
            lit = [style_of(role).colour for role, look in STYLES.items() if not look.fill]
        assert all(contrast(colour, "#000000") >= 4.5 for colour in lit), dark
    with context({"axes.facecolor": "#000000", "axes.prop_cycle": "cycler(color=['#222222'])"}):
        assert style_of("main").colour == "#222222"
    assert style_of("start") == STYLES["start"]


@pytest.mark.parametrize("cones", CONES)
def test_vectors_of_the_physics_keep_apart_for_every_eye(cones: str) -> None:
    """Their colours stay 9 apart at least in CIELAB, of which 2 can just be seen, also without one kind of cones."""
    colours_seen = [
        lab(CONES[cones] @ (((np.array(mpl.colors.to_rgb(STYLES[role].colour)) + 0.055) / 1.055) ** 2.4))
        for role in VECTORS
    ]
    assert min(np.linalg.norm(a - b) for a, b in combinations(colours_seen, 2)) > 9.0


def test_the_field_keeps_apart_from_other_vectors_in_grey() -> None:
    """B differs by 10 in lightness from every vector that stands beside it."""
    light = {
        role: lab(((np.array(mpl.colors.to_rgb(STYLES[role].colour)) + 0.055) / 1.055) ** 2.4)[0] for role in VECTORS
    }
    field = light.pop("field")
    assert all(abs(field - lightness) > 10.0 for lightness in light.values()), light


def test_lines_that_are_components_keep_apart_in_grey() -> None:
    """Two of the three first lines of the cycle differ by 15 in lightness, or by their dashes."""
    with context():
        looks = [style_of(role) for role in LINES[:3]]
    light = [lab(((np.array(mpl.colors.to_rgb(look.colour)) + 0.055) / 1.055) ** 2.4)[0] for look in looks]
    for (a, one), (b, look_other) in combinations(zip(light, looks, strict=True), 2):
        assert abs(a - b) > 15.0 or one.dash != look_other.dash


def test_the_key_to_the_colours_holds_in_grey_print() -> None:
    """Two lines in a column of figure colours differ by 8 in lightness, or in width or dashes; all marks in shape."""
    (panel,) = recipes.load("colours").scene().panels
    columns: dict[float, list[tuple[float, float, tuple[float, ...]]]] = {}
    with context():
        for layer in panel.layers:
            if isinstance(layer, Curve):
                look = style_of(layer.role)
                light = lab(((np.array(mpl.colors.to_rgb(look.colour)) + 0.055) / 1.055) ** 2.4)[0]
                columns.setdefault(round(float(layer.points[0, 1]), 6), []).append((light, look.width, look.dash))
    assert sorted(map(len, columns.values())) == [3, 4, 6]
    for column in columns.values():
        for entry, entry_other in combinations(column, 2):
            assert (
                abs(entry[0] - entry_other[0]) > 8.0
                or abs(entry[1] - entry_other[1]) > 0.25
                or entry[2] != entry_other[2]
            ), (entry, entry_other)
    marks = [STYLES[layer.role] for layer in panel.layers if isinstance(layer, Points)]
    assert len({(look.marker, look.colour == "#ffffff") for look in marks}) == len(marks) == 4


@pytest.mark.slow
def test_the_key_of_a_tinted_surface_holds_on_both_sides() -> None:
    """Of a rate on the ribbon the key, the outside and the inside have one colour, to 0.06 of its opacity."""
    with context():
        (axes,) = to_figure(recipes.load("ribbon").scene()).axes
        for k in range(5):
            colour = mpl.colors.to_rgb(STYLES[f"rate_{k}"].colour)
            areas = [patch for patch in axes.patches if patch.get_facecolor()[:3] == colour]
            opacities = [area.get_alpha() for area in areas]
            assert len(opacities) > 4
            assert min(opacities) > max(opacities) - 0.06


def test_tubes_are_as_wide_as_lines_and_marks_on_paper() -> None:
    """In shaded pictures a line is 1 to 2.6 times as wide as on paper, a mark up to 1.2 points wider; all print."""
    for role, look in STYLES.items():
        assert look.width >= 0.25, role  # as journals print
        if look.marker:
            assert look.size <= look.tube <= look.size + 1.2, role
        elif role != "silhouette" and not look.fill and look.tube != Style(look.colour).tube:
            assert look.width <= look.tube <= 2.6 * look.width, role
        assert 0.0 <= look.fill <= 1.0, role
        assert 0.0 < look.glass <= 1.0, role


def test_line_widths_follow_importance() -> None:
    """Vectors of the physics have one weight within 30 %, auxiliary lines are thinner, no curve is twice as wide."""
    wide = {role: look.width for role, look in STYLES.items()}
    thinnest, widest = min(wide[role] for role in VECTORS), max(wide[role] for role in VECTORS)
    assert widest <= 1.3 * thinnest
    helping = "basis axis canonical component asymptote pole second_trace map_border angle construction guide rim wire"
    assert max(wide[role] for role in (*helping.split(), "silhouette", "coil", "reference", "limit")) < thinnest
    assert max(wide.values()) < 2.0 * thinnest


def test_dashes_gaps_and_tints_can_be_seen() -> None:
    """A dot is as long as a line is wide, a dash three times that; ink is read on a tint."""
    for role, look in STYLES.items():
        assert all(1.0 <= on <= 1.2 or 3.0 <= on <= 5.0 for on in look.dash[::2]), role
        assert all(1.5 <= off <= 2.5 for off in look.dash[1::2]), role
    assert all(0.1 < STYLES[role].fill < 0.4 for role in ("region", "unstable_region", "shade"))


@pytest.mark.parametrize("role", ["surface", "sphere", "ball", "cone", "plane"])
def test_curves_behind_two_walls_are_seen(role: str) -> None:
    """Where curves run on and behind a surface its near wall and the far one, of half its tint, pass 2/5 of the light.

    Both tint: together they take a tenth of it away at least.
    """
    fill = STYLES[role].fill
    assert 0.4 <= (1.0 - fill) * (1.0 - 0.5 * fill) <= 0.9


def test_words_have_apostrophes_and_formulas_primes() -> None:
    """A straight quotation mark is neither: in words it is an apostrophe, in a formula a prime."""
    assert typeset(r"the paper's body in $\mathbf{B}'$ and $B^\prime$") == r"the paper’s body in $\mathbf{B}′$ and $B′$"
