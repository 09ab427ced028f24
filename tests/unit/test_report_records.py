"""The content of a report file, and the messages about mistakes."""

import re
from pathlib import Path

import pytest

from atlas.book import bibliography
from atlas.book.building.cache import Cache
from atlas.book.building.records import gather
from atlas.book.building.report import outlines
from atlas.book.compose import compose
from atlas.book.files import find, names
from atlas.book.load import load
from atlas.book.pictures import pictures
from atlas.errors import AtlasError
from atlas.pictures import recipes
from atlas.places import folder
from atlas.sources import Sources

HEAD = 'name = "a"\ntitle = "A"\n'
PAGE = '[[pages]]\nslug = "index"\ntitle = "T"\n'
MISTAKES = {
    "a misspelt key at the top": (HEAD + 'titel = "x"\n' + PAGE + "blocks = []", "line 3", "'titel'", "'title'"),
    "a misspelt key of a body": (
        HEAD + '[parameters.bodies.ring]\ntitle = "x"\nradus = 2.0\n' + PAGE + "blocks = []",
        "line 5",
        "bodies 'ring'",
        "'radus'",
        "'radius'",
    ),
    "a misspelt key of a block": (
        HEAD + PAGE + '[[pages.blocks]]\nkind = "figure"\nrecpe = "x"',
        "page 'index', block 1 (figure)",
        "'recpe'",
        "'recipe'",
    ),
    "a misspelt kind": (HEAD + PAGE + '[[pages.blocks]]\nkind = "figur"', "block 1", "'figur'", "'figure'"),
    "a kind that is no text": (HEAD + PAGE + "[[pages.blocks]]\nkind = [1]", "block 1", "no block kind [1]"),
    "no kind": (HEAD + PAGE + '[[pages.blocks]]\ntext = "x"', "block 1", "'kind'"),
    "a missing key": (HEAD + PAGE + '[[pages.blocks]]\nkind = "prose"', "block 1 (prose)", "'text'"),
    "a wrong type": (
        HEAD + '[[pages]]\nslug = "index"\ntitle = 3\nblocks = []',
        "page 'index', title",
        "must be a text, not 3",
    ),
    "a misspelt renderer": (
        HEAD + PAGE + '[[pages.blocks]]\nkind = "figure"\nrecipe = "x"\nrenderer = "shadd"',
        "'shadd'",
        "renderer",
    ),
    "a field of three components": (
        HEAD + '[parameters.fields.f]\ntitle = "x"\nprime = [1.0, 2.0, 3.0]\n' + PAGE + "blocks = []",
        "fields 'f'",
        "prime",
    ),
    "a body that is not there": (
        HEAD
        + '[parameters.bodies.ring]\ntitle = "x"\nratio = 2.0\n'
        + PAGE
        + '[[pages.blocks]]\nkind = "table"\ntable = "quadric"\nbody = "rng"',
        "block 1",
        "no body 'rng'",
        "'ring'",
    ),
    "two tables of one id": (
        HEAD
        + PAGE
        + '[[pages.blocks]]\nkind = "listing"\nid = "a"\ncolumns = []\nrows = []\ncaption = ""\n'
        + '[[pages.blocks]]\nkind = "recorded"\nid = "a"\nsource = "trial"\ntable = "totals"',
        "two tables",
        "'a'",
    ),
    "too many digits": (
        HEAD + PAGE + '[[pages.blocks]]\nkind = "table"\ntable = "quadric"\ndigits = 1001',
        "page 'index', block 1 (table)",
        "from 1 to 1000",
        "1001",
    ),
    "no digits": (HEAD + PAGE + '[[pages.blocks]]\nkind = "table"\ntable = "quadric"\ndigits = 0', "block 1", "not 0"),
    "no first page": (HEAD + '[[pages]]\nslug = "x"\ntitle = "T"\nblocks = []', "'index'"),
    "two pages of one name": (HEAD + (PAGE + "blocks = []\n") * 2, "'index'", "two"),
    "no TOML": (HEAD + "a =", "not TOML"),
}


@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_mistake_is_reported_with_file_place_and_nearest_key(tmp_path: Path, mistake: str) -> None:
    """Every mistake names the file, the place, and the probable meaning."""
    text, *expected = MISTAKES[mistake]
    file = tmp_path / "mine.toml"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(AtlasError) as caught:
        load(file)
    sentence = str(caught.value)
    assert str(file) in sentence
    assert "\n" not in sentence
    for words in expected:
        assert words in sentence


def test_all_mistakes_of_a_report_are_reported_at_once(tmp_path: Path) -> None:
    """Keys, types, names and files are checked whole; each mistake is a sentence with its line, in their order."""
    file = tmp_path / "mine.toml"
    file.write_text(
        'name = "mine"\ntitel = "T"\ntitle = "T"\nbibliography = "no.bib"\nstyle = "nosuch"\ngallery = ["hyperbol"]\n'
        "[related]\nguied = 'x'\n" + PAGE + "[[pages.blocks]]\nkind = 'figure'\nrecipe = './no.py'\nid = 'a'\n"
        "caption = ''\n[[pages.blocks]]\nkind = 'figure'\nrecipe = 'hyperbola'\nid = 'a'\ncaption = ''\nbody = 'rng'\n"
        "[parameters.bodies.ring]\ntitle = 'r'\nratio = 1\n",
        encoding="utf-8",
    )
    with pytest.raises(AtlasError) as caught:
        load(file)
    complaints = ("'title'", "'no.bib'", "'nosuch'", "'hyperbola'", "'guide'", "no.py", "two figures", "'ring'")
    sentences = caught.value.sentences
    assert len(sentences) == len(complaints)
    for words in complaints:
        assert sum(words in sentence for sentence in sentences) == 1
    lines = [int(line[1]) for sentence in sentences if (line := re.search(r", line (\d+)", sentence))]
    assert len(lines) == 6
    assert lines == sorted(lines)


@pytest.mark.parametrize("name", names())
def test_figures_and_tables_have_names_of_their_own(name: str) -> None:
    """A figure or table keeps its name when another is put before it, so that a link finds it again."""
    for page in load(find(name)).pages:
        for block in page.blocks:
            assert not hasattr(block, "id") or block.id, (page.slug, block)


def test_an_unknown_report_is_answered_with_the_nearest_name() -> None:
    """A misspelt name of a report names the one that was probably meant."""
    with pytest.raises(AtlasError, match="'atlas'"):
        find("atls")


def test_a_file_of_another_kind_is_no_report(tmp_path: Path) -> None:
    """A file that is there but bears another ending is told the form of a report."""
    (tmp_path / "data.csv").write_text("1,2\n")
    with pytest.raises(AtlasError, match=r"data\.csv is no report: a report is a \.md or a \.toml file\.$"):
        find(str(tmp_path / "data.csv"))


@pytest.mark.parametrize(
    "name",
    [pytest.param(name, marks=[pytest.mark.slow] * (name in {"atlas", "trial", "three_moments"})) for name in names()],
)
def test_every_report_of_the_folder_is_sound(name: str, tmp_path: Path) -> None:
    """Each is named like its file, all its tables and scenes can be made, and every citation leads somewhere."""
    report = load(find(name))
    figures = pictures(report)
    works = bibliography.read(folder("reports") / report.bibliography) if report.bibliography else None
    document = compose(report, figures, gather(report), works, outlines(find(name), Cache(tmp_path), Sources()))
    assert report.name == name
    for picture in figures.values():
        assert not picture.failure
        assert recipes.load(picture.recipe).scene(**picture.parameters).alt
    assert len(document.texts.set({"html": document.cite("html")})["html"]) == len(document.texts.texts)
