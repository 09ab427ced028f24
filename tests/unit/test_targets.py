"""Figures for journals, slides and posters: of the width that is asked, with its type and lines, no names that meet."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from drawing import scene_of
from marks import faults
from PIL import Image
from pypdf import PdfReader

import atlas
from atlas import AtlasError
from atlas.book.building.figures import build_figures
from atlas.book.tables import compute
from atlas.book.tables.table import Request
from atlas.cli.app import atlas as command
from atlas.pictures import Curve, Label, Plane, Scene, Space, recipes
from atlas.pictures.arrange import arranged, suited
from atlas.pictures.drawing.files import save
from atlas.pictures.drawing.panels import to_figure
from atlas.targets import TARGETS, TYPE, find

PAIRS = [(name, target) for name in recipes.names() for target in TARGETS]
FEW = PAIRS[:: len(PAIRS) // 7]
"""Pairs of a recipe and a target of the fast tests."""
WHOLE_PAGE = 170.0
WIDE = ["stability_map"]
MILLIMETRE = 72.0 / 25.4


@pytest.mark.parametrize(
    ("name", "target"),
    [pytest.param(*pair, marks=[pytest.mark.slow] * (pair not in FEW)) for pair in PAIRS],
)
def test_a_figure_keeps_the_limits_of_its_target_or_is_refused(name: str, target: str) -> None:
    """It has the width, the type and the lines that are asked; no text leaves the page or covers another.

    A figure that cannot is refused in one line; on a journal's whole page and on a poster none is.
    """
    medium, complaints, refused = find(target), [], ""
    try:
        complaints = faults(to_figure(scene_of(name), target=medium), medium)
    except AtlasError as error:
        refused = str(error)
    assert complaints == []
    assert not refused or re.fullmatch(r".+: it can't be read at .+\.", refused)
    assert not refused or medium.width < WHOLE_PAGE, refused


@pytest.mark.parametrize("name", ["bifurcation", "cusps", "monodromy"])
def test_panels_that_can_be_spared_are_left_out_of_a_slide_and_named(name: str) -> None:
    """The others keep their letters and have both labels; the caption names those that are missing."""
    scene = scene_of(name)
    slide = arranged(scene, find("beamer"))
    panels = [panel for k, panel in enumerate(scene.panels) if k not in scene.spare]
    assert [panel.title for panel in slide.panels] == [panel.title for panel in panels]
    sentence = slide.caption.partition(" Left out at this size: ")[2]
    assert re.findall(r"\(\w\)", sentence) == [scene.panels[k].title[:3] for k in scene.spare]
    assert all(panel.x_label and panel.y_label for panel in slide.panels if isinstance(panel, Plane))
    assert len(arranged(scene, find("aps-double")).panels) == len(scene.panels)


@pytest.mark.slow
def test_the_command_names_panels_that_are_left_out(tmp_path: Path) -> None:
    """A slide lacks panels, which a line on standard error names; a whole page has all, and no line."""
    letters = [scene_of("cusps").panels[k].title[:3] for k in scene_of("cusps").spare]
    for target, expected in (("beamer", letters), ("aps-double", [])):
        words = ["figure", "cusps", "--for", target, "--format", "svg", "--out", str(tmp_path)]
        message = CliRunner().invoke(command, words).stderr
        assert re.findall(r"\(\w\)", message) == expected
        assert ("atlas: figure cusps: Left out at this size: " in message) == bool(expected)


def test_faults_of_a_figure_are_listed() -> None:
    """A figure of its own size, with names too small and one over another, is told to break the law."""
    figure = to_figure(recipes.load("trochoids").scene(), {"xtick.labelsize": 5.0, "axes.linewidth": 0.2})
    for place in (0.5, 0.505):
        figure.text(place, 0.5, "a name")
    figure.text(0.99, 0.5, "off the page")
    complaints = " ".join(faults(figure, TARGETS["aps-double"]))
    for words in ("86.0 mm x", "5.00 pt", "0.20 to", "'a name' covers 'a name'", "'off the page' leaves the page"):
        assert words in complaints


def test_capitals_are_two_millimetres_high() -> None:
    """Letters of the least type have the height that the APS asks for, their subscripts 6 pt, as Elsevier does."""
    from matplotlib.font_manager import FontProperties
    from matplotlib.textpath import TextPath

    height = TextPath((0.0, 0.0), "E", size=TYPE, prop=FontProperties(family="STIXGeneral")).get_extents().height
    assert height >= 2.0 * MILLIMETRE
    assert 0.7 * TYPE >= 6.0
    assert all(target.type >= TYPE for target in TARGETS.values())


@pytest.mark.parametrize("name", WIDE)
def test_figures_too_wide_for_a_column_are_refused(name: str) -> None:
    """A recipe that can't be read in a column is refused there with the targets that will do, and made for those."""
    recipe = recipes.load(name)
    with pytest.raises(
        AtlasError, match=rf"can't be read at a width of 86 mm, for it needs {recipe.narrowest:g} mm.*aps-double"
    ):
        arranged(recipe.scene(), find("aps"))
    assert arranged(recipe.scene(), find("aps-double")).size[0] == 178.0


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "target"), [("motion_map", "iop"), ("quadrics_of_tops", "aps"), ("simulators", "beamer")]
)
def test_a_figure_of_many_panels_finds_a_layout(name: str, target: str) -> None:
    """It fits by fewer panels, by those for a narrow screen, or by panels side by side, and is not refused."""
    assert faults(to_figure(scene_of(name), target=find(target)), find(target)) == []


def test_figures_too_high_for_a_slide_are_refused() -> None:
    """A picture of an upright sheet would be too small in the height of a slide."""
    scene = recipes.load("work_precision").scene(cases=("elementary", "ball", "particle"))
    with pytest.raises(AtlasError, match=r"can't be read at a height of 68 mm; its panels would have only 0\.19"):
        arranged(replace(scene, size=(140.0, 480.0), columns=1, narrow=()), find("beamer"))


def test_a_figure_whose_names_would_stand_on_one_another_is_refused() -> None:
    """It says which names, and from which width on none do; there the figure is made, and nothing breaks the law."""
    x = np.array([[0.0, 0.0], [1.0, 1.0]])
    names = (
        Label(np.array([0.25, 0.5]), "a very long solenoid"),
        Label(np.array([0.75, 0.5]), "a very short solenoid"),
    )
    scene = Scene(
        "Two names", "A caption.", "Two.", (Plane((Curve(x, "main"), *names), "$x$", "$y$"),), size=(60.0, 50.0)
    )
    slim = replace(find("aps"), width=60.0)
    with pytest.raises(AtlasError, match="'a very long solenoid' and 'a very short solenoid' would stand on") as raised:
        to_figure(scene, target=slim)
    (width,) = re.findall(r"it can be from about (\d+) mm on", str(raised.value))
    wide = replace(slim, width=float(width))
    assert faults(to_figure(scene, target=wide), wide) == []


def test_panels_of_a_row_stand_below_one_another_with_their_labels() -> None:
    """In a column an axis has the label that it shared with its neighbour in the row."""
    before = recipes.load("kinds_of_quadric").scene()
    after = arranged(before, find("aps"))
    assert (before.columns, after.columns) == (3, 1)
    assert {panel.y_label for panel in after.panels if isinstance(panel, Plane)} == {r"$\beta$ (degrees)"}
    assert [panel.layers for panel in after.panels] == [panel.layers for panel in before.panels]


def test_a_shared_label_below_comes_along() -> None:
    """Panels that stood below one another have their label each when they stand side by side."""
    after = arranged(recipes.load("frequencies").scene(), find("beamer"))
    assert after.columns == 2
    assert len({panel.x_label for panel in after.panels if isinstance(panel, Plane)}) == 1


def test_a_drawing_keeps_its_shape_and_leaves_no_empty_rows() -> None:
    """A row of bodies is as high as they are at its width, with their names."""
    after = arranged(recipes.load("film_strip").scene(), find("aps"))
    assert len(after.panels) == 2
    assert all(isinstance(panel, Space) for panel in after.panels)
    assert sum(after.rows) == after.size[1] < 80.0


def test_a_poster_enlarges_text_lines_and_marks_alike() -> None:
    """Type, lines, marks and the page grow together: a line is as wide beside a letter as in a journal."""
    x = np.linspace(0.0, 1.0, 9)
    scene = Scene("A line", "A caption.", "A line.", (Plane((Curve(np.stack([x, x], axis=1), "main"),), "$x$", "$y$"),))
    zoom = TARGETS["poster"].zoom
    poster, paper = (to_figure(scene, target=TARGETS[name]).axes[0] for name in ("poster", "aps"))
    assert poster.xaxis.label.get_fontsize() == TARGETS["poster"].type
    assert poster.lines[0].get_linewidth() == pytest.approx(zoom * paper.lines[0].get_linewidth())
    assert poster.xaxis.get_major_ticks()[0].tick1line.get_markersize() == pytest.approx(3.0 * zoom)


@pytest.mark.parametrize(("name", "target"), [("hyperbola", "aps"), ("motion", "aps-double"), ("cone", "aps")])
def test_a_figure_of_a_report_gets_one_or_two_columns_by_its_width(name: str, target: str) -> None:
    """A figure not much wider than a column by itself is given one, others both."""
    assert suited(recipes.load(name).scene(), [find("aps"), find("aps-double")]) is find(target)


@pytest.mark.parametrize("name", WIDE)
def test_figures_too_wide_for_a_column_get_the_page(name: str) -> None:
    """Where there is a choice, a recipe that can't be read in a column is not put into one."""
    assert suited(recipes.load(name).scene(), [find("aps"), find("aps-double")]).width == 178.0


@pytest.mark.slow
def test_files_have_the_size_the_fonts_and_the_resolution(tmp_path: Path) -> None:
    """A PDF of 86 mm with TrueType fonts alone; a PNG of 600 dots an inch without alpha, with its words; PGF too."""
    (build,) = build_figures(["hyperbola"], ["pdf", "png", "pgf"], tmp_path, target="aps")
    assert [file.name for file in build.files] == ["hyperbola-aps.pdf", "hyperbola-aps.png", "hyperbola-aps.pgf"]
    pdf, png, _ = build.files
    (page,) = PdfReader(pdf).pages
    assert float(page.mediabox.width) == pytest.approx(86.0 * MILLIMETRE, abs=0.01)
    fonts = [font.get_object() for font in page["/Resources"]["/Font"].values()]
    assert {font["/Subtype"] for font in fonts} <= {"/TrueType", "/Type0"}
    with Image.open(png) as picture:
        assert picture.mode == "RGB"
        assert picture.width == pytest.approx(86.0 / 25.4 * 600.0, abs=1.0)
        assert picture.info["dpi"] == pytest.approx((600.0, 600.0), abs=0.1)
        assert picture.info["Title"] == recipes.load("hyperbola").title


def test_savefig_keeps_the_settings_of_the_target(tmp_path: Path) -> None:
    """A user's own savefig writes TrueType fonts and 600 dots an inch, whatever Matplotlib's settings are."""
    figure = atlas.figure("cone", target="iop")
    figure.savefig(tmp_path / "a.pdf")
    figure.savefig(tmp_path / "a.png")
    (page,) = PdfReader(tmp_path / "a.pdf").pages
    assert all(font.get_object()["/Subtype"] != "/Type3" for font in page["/Resources"]["/Font"].values())
    with Image.open(tmp_path / "a.png") as picture:
        assert picture.width == pytest.approx(85.0 / 25.4 * 600.0, abs=1.0)


def test_a_style_of_the_user_does_not_break_the_limits_of_a_target(tmp_path: Path) -> None:
    """Demands of a target come after the style: small type, thin lines and Type 3 fonts are put right."""
    style = {"font.size": 4.0, "xtick.labelsize": 4.0, "axes.linewidth": 0.1, "pdf.fonttype": 3}
    scene = recipes.load("trochoids").scene()
    assert faults(to_figure(scene, style, target=find("aps")), find("aps")) == []
    save(scene, {tmp_path / "a.pdf": "pdf"}, style=style, target=find("aps"))
    (page,) = PdfReader(tmp_path / "a.pdf").pages
    assert all(font.get_object()["/Subtype"] != "/Type3" for font in page["/Resources"]["/Font"].values())


def test_an_unknown_target_is_named() -> None:
    """The error tells which there are."""
    with pytest.raises(AtlasError, match=r"there is no target 'elsewier'.*elsevier"):
        atlas.figure("cone", target="elsewier")


def test_the_least_width_of_a_recipe_is_written_as_a_number(tmp_path: Path) -> None:
    """The least width is a number written out."""
    file = tmp_path / "mine.py"
    file.write_text('"""Mine."""\nNARROWEST = "wide"\ndef scene(): ...\n', encoding="utf-8")
    with pytest.raises(AtlasError, match=r"NARROWEST in mine\.py is not a number"):
        recipes.load(str(file))


@pytest.mark.parametrize("line", ["NARROWEST, LOW = 99.0, 1.0", "NARROWEST = 99.0\nNARROWEST = 2.0"])
def test_a_constant_declared_twice_is_an_error(tmp_path: Path, line: str) -> None:
    """Two names on a line, or two lines for a name, are an error: the first was ignored, and so was the last."""
    file = tmp_path / "mine.py"
    file.write_text(f'"""Mine."""\n{line}\ndef scene(): ...\n', encoding="utf-8")
    with pytest.raises(AtlasError, match=r"NARROWEST in mine\.py is not assigned once, on a line of its own"):
        recipes.load(str(file))


def test_a_scene_without_a_name_is_laid_out_too() -> None:
    """A scene that no recipe made has no least width."""
    scene = replace(recipes.load("stability_map").scene(), narrowest=0.0)
    assert arranged(scene, find("aps")).size[0] == 86.0


def test_the_guide_lists_the_sizes_of_each_target() -> None:
    """Its table names every target with its sizes, its demands, and every source, which is an address or a class."""
    data = compute("targets", Request((), {}, 3))
    assert [row[0] for row in data.rows] == [f"`{name}`" for name in TARGETS]
    assert data.rows[0][1:] == ("86", "215", "8.6", "0.52", "600")
    assert len(data.columns) == len(data.rows[0])
    notes = " ".join(data.notes)
    assert all(medium.asks in notes and medium.source in notes for medium in TARGETS.values())
    assert [name for name, medium in TARGETS.items() if not medium.source.startswith("https://")] == [
        "beamer",
        "poster",
    ]
