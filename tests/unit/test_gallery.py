"""The gallery: every recipe once, with a sentence, a call and a command that hold, and the user's own beside them."""

import ast
import re
import shlex
from html import unescape
from pathlib import Path

import pytest

from atlas.book.building.report import build_report
from atlas.book.files import find
from atlas.book.load import load
from atlas.cli import main
from atlas.pictures import recipes

OWN = '''"""One line."""

import numpy as np

from atlas.pictures import Curve, Plane, Scene

ROW = "its map"


def scene(*, height: float = 1.0) -> Scene:
    """Draw a line."""
    line = Curve(np.array([[0.0, 0.0], [1.0, height]]), "main", "line")
    return Scene(caption="A line rises. It is straight.", alt="A line.", panels=(Plane((line,), "x", "y"),))
'''


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of a gallery of two recipes of the package and one of the user's, built by the command."""
    out = tmp_path_factory.mktemp("gallery")
    (out / "mine.py").write_text(OWN, "utf-8")
    with pytest.raises(SystemExit) as ended:
        main(["figure", "--gallery", "tops", "simulators", str(out / "mine.py"), "--out", str(out), "--jobs", "1"])
    assert ended.value.code == 0
    return out


def page(out: Path) -> str:
    """Return the text of the gallery."""
    return (out / "gallery" / "gallery.html").read_text("utf-8")


def test_every_recipe_has_a_row_and_stands_in_the_gallery_of_the_atlas() -> None:
    """In one of five rows."""
    assert set(load(find("atlas")).gallery) == set(recipes.names())
    assert {recipes.load(name).row for name in recipes.names()} == set(recipes.ROWS)


def test_links_of_a_gallery_lead_somewhere(built: Path) -> None:
    """To an anchor of the page, or to a file beside it; only the PDF of a report is beside its folder."""
    text = page(built)
    anchors = set(re.findall(r' id="([^"]+)"', text))
    for link in re.findall(r'(?:href|src)="([^"]+)"', text):
        file, _, anchor = link.partition("#")
        assert anchor in anchors if not file else (built / "gallery" / file).exists(), link


def test_rows_are_in_order_and_own_recipes_join_them(built: Path) -> None:
    """The row of the user's recipe is the third of five."""
    headings = re.findall(r'<section class="row" aria-label="([^"]+)">', page(built))
    assert headings == ["its map", "tops", "three moments"]
    assert "A line rises." in page(built)
    assert "It is straight." not in page(built)


def test_code_and_command_of_a_plate_make_its_figure(built: Path) -> None:
    """The call names the recipe, and the command line the same."""
    blocks = [unescape(block) for block in re.findall(r"<pre><code>(.*?)</code></pre>", page(built), re.DOTALL)]
    calls, commands = blocks[::2], blocks[1::2]
    for call, command in zip(calls, commands, strict=True):
        expression = ast.parse(call).body[-1]
        assert isinstance(expression, ast.Expr)
        assert isinstance(expression.value, ast.Call)
        assert ast.literal_eval(expression.value.args[0]) == shlex.split(command)[2]


@pytest.mark.slow
def test_a_gallery_follows_an_edited_recipe(built: Path) -> None:
    """Its own recipe is drawn anew, and the other two are taken."""
    (built / "mine.py").write_text(OWN.replace("A line rises.", "A line falls."), "utf-8")
    with pytest.raises(SystemExit):
        main(["figure", "--gallery", "tops", "simulators", str(built / "mine.py"), "--out", str(built), "--jobs", "1"])
    assert "A line falls." in page(built)


@pytest.mark.slow
def test_the_pdf_has_no_gallery_and_the_first_page_leads_to_it(tmp_path: Path) -> None:
    """A report names recipes beside it by a pattern."""
    (tmp_path / "mine.py").write_text(OWN, "utf-8")
    head = '+++\nname = "own"\ntitle = "Own"\ngallery = ["*.py"]\n+++\n'
    (tmp_path / "own.md").write_text(f"{head}\n# One\n\nText.\n\n# Two\n\nMore.\n", "utf-8")
    report = build_report(tmp_path / "own.md", tmp_path / "out", jobs=1)
    assert report.ok
    page_first = (tmp_path / "out" / "own" / "index.html").read_text("utf-8")
    assert 'href="gallery.html"' in page_first.partition("<ol>")[0]
    assert report.pdf.exists()


def test_a_recipe_that_is_not_there_is_named(tmp_path: Path) -> None:
    """In the head of a report, and on the command line."""
    (tmp_path / "own.md").write_text('+++\nname = "own"\ntitle = "Own"\ngallery = ["nosuch"]\n+++\n\n# One\n', "utf-8")
    with pytest.raises(Exception, match="no figure 'nosuch'"):
        load(tmp_path / "own.md")
