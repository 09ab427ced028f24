"""The search box, headings with anchors, the front page, and the command under a figure."""

import json
import shlex
from pathlib import Path

import click
import pytest
from lxml import html as reader

from atlas.book import html, texts
from atlas.book.blocks.figure import Picture
from atlas.book.compose import compose
from atlas.book.html import sections as rows_of
from atlas.book.load import load
from atlas.book.pictures import pictures
from atlas.cli.app import atlas as command_line
from atlas.cli.figure import setting
from atlas.errors import AtlasError

REPORT = """
name = "mine"
title = "Mine"
cover = "curve"
[related]
atlas = "The atlas"
[parameters]
bodies.b = { title = "b", ratio = 1.5 }
fields.f = { title = "f", prime = [1.0, 2.0] }
[[pages]]
slug = "index"
title = "First"
blocks = [
  { kind = "prose", text = "@(71)\\n\\n## A heading of $\\\\omega_2$\\n\\n## A heading of $k$\\n\\n<words>" },
  { kind = "equation", name = "(71)" },
]
[[pages]]
slug = "second"
title = "Second"
blocks = [
  { kind = "figure", recipe = "hyperbola", id = "curve", body = "b", field = "f" },
  { kind = "table", table = "points", body = "b", field = "f" },
]
"""


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """Return the pages of a small report."""
    file = tmp_path_factory.mktemp("report") / "mine.toml"
    file.write_text(REPORT)
    report = load(file)
    document = compose(report, pictures(report))
    document.set("html")
    return html.pages(document)


def test_search_results_lead_to_anchors(files: dict[str, str]) -> None:
    """Each row of the index leads to an anchor of a page, and each heading, figure, table and equation has a row."""
    content = json.loads(files["index.js"].removeprefix("atlasIndex(").removesuffix(");\n"))
    anchors = {(file, anchor) for file, anchor, _, _ in content["sections"]}
    for file, anchor in anchors:
        assert reader.fromstring(files[file]).get_element_by_id(anchor) is not None
    assert anchors == {
        ("index.html", "page-index"),
        ("index.html", "a-heading-of"),
        ("index.html", "a-heading-of-2"),
        ("index.html", "eq-71"),
        ("second.html", "page-second"),
        ("second.html", "fig-curve"),
        ("second.html", "tab-1"),
    }
    words = {anchor: text for _, anchor, _, text in content["sections"]}
    assert "<words>" in words["a-heading-of-2"]
    assert content["equations"]["71"].startswith('<p><math display="block"')


@pytest.mark.parametrize(
    ("tex", "line"),
    [
        ("I=3/2", "I=3/2"),
        (r"I=\\frac{3}{2}", "I=3/2"),
        (r"\\omega_2=-B'_2", "ω2=-B'2"),
        (r"\\dot\\Omega_3^2", "3^2"),
        (r"\\boldsymbol{\\Omega}", "Ω"),
        (r"\\sqrt{1-I}", "sqrt(1-I)"),
    ],
)
def test_a_formula_can_be_searched(tmp_path: Path, tex: str, line: str) -> None:
    """Formulas are in the index as one types them: letters as they are, an index behind its letter, a slash."""
    (tmp_path / "mine.toml").write_text(REPORT.replace("A heading", f"A heading ${tex}$ of", 1))
    report = load(tmp_path / "mine.toml")
    document = compose(report, pictures(report))
    document.set("html")
    assert line in html.pages(document)["index.js"]


def test_a_table_is_found_by_its_number_whatever_follows_it() -> None:
    """The words of a table, and a heading without an anchor behind it, are not in the title of its row."""
    page = (
        '<main id="page-index"><h1>First</h1><figure class="table" id="tab-a"><figcaption><b>Table 3.</b> Slips.'
        '</figcaption><td>many words</td></figure><h3>Sign</h3><p>text</p><h2 id="b">Next</h2>more</main>'
    )
    rows = {anchor: (title, text) for _, anchor, title, text in rows_of("index.html", "1 First", page)}
    assert rows["tab-a"] == ("Table 3 — 1 First", "Table 3. Slips. many words Sign text")
    assert rows["b"] == ("Next — 1 First", "Next more")


def test_titles_have_the_apostrophes_of_print() -> None:
    """Behind a small letter one is curved, in headings and in navigation; a prime stays one."""
    assert texts.title_words("The bodies' own B' and Larmor's $B'_2$") == "The bodies’ own B' and Larmor’s B'_2"
    assert texts.title("Larmor's $B'_2$, or B'") == r"Larmor’s $B'_2$\, or B\'"


def test_the_search_box_needs_no_network(files: dict[str, str]) -> None:
    """Its library lies beside the page, with its licence, and is loaded before its users."""
    assert "Permission is hereby granted" in files["minisearch.js"]
    scripts = reader.fromstring(files["index.html"]).xpath("//script/@src")
    assert scripts == ["minisearch.js", "page.js"]


def test_an_equation_is_named_where_it_is_cited(files: dict[str, str]) -> None:
    """Without a script the link of a citation gives the equation in words."""
    (link,) = reader.fromstring(files["index.html"]).xpath("//main//a[@href='index.html#eq-71']")
    assert "hyperbola" in link.get("title").lower()


def test_the_front_page_shows_a_picture_of_each_page(files: dict[str, str]) -> None:
    """The figure that the report names, and a picture of each page that has one."""
    page = reader.fromstring(files["index.html"])
    assert page.xpath("//a[@class='cover']/@href") == ["second.html#fig-curve"]
    assert page.xpath("//nav[@class='cards']/a/@href") == []  # a single picture needs no list
    assert not reader.fromstring(files["second.html"]).xpath("//header")


def test_a_cover_must_be_a_figure(tmp_path: Path) -> None:
    """The message names the request."""
    (tmp_path / "mine.toml").write_text(REPORT.replace('cover = "curve"', 'cover = "curves"'))
    report = load(tmp_path / "mine.toml")
    document = compose(report, pictures(report))
    document.set("html")
    with pytest.raises(AtlasError, match=r"cover: .*curves"):
        html.pages(document)


def test_tables_are_readable_by_screen_readers(files: dict[str, str]) -> None:
    """A head that is a formula is there in plain letters too, and a table that scrolls has a name."""
    page = reader.fromstring(files["second.html"])
    heads = [head.text_content() for head in page.xpath("//th[.//*[local-name()='math']]/span[@class='spoken']")]
    assert "ω_2" in heads
    (box,) = page.xpath("//div[@class='scroll']")
    assert box.get("tabindex") == "0"
    assert page.get_element_by_id(box.get("aria-labelledby")).text_content().startswith("Table 1.")


def test_the_head_of_a_column_is_one_line(files: dict[str, str]) -> None:
    """Names and units of columns hold no paragraph."""
    heads = reader.fromstring(files["second.html"]).xpath("//thead//th")
    assert len(heads) > 5
    assert not [head for head in heads if head.xpath(".//p")]


def test_every_page_links_the_related_reports(files: dict[str, str], tmp_path: Path) -> None:
    """Each page leads to the reports that are named, whose indices its script reads; an unknown name is an error."""
    for name in ("index.html", "second.html"):
        assert reader.fromstring(files[name]).xpath("//nav//a/@data-beside") == ["../atlas/"]
        assert "The atlas" in reader.fromstring(files[name]).xpath("//nav//a[@href='../atlas/index.html']/text()")
    (tmp_path / "mine.toml").write_text(REPORT.replace("atlas =", "atlass ="))
    with pytest.raises(AtlasError, match=r"related: .*'atlass'"):
        load(tmp_path / "mine.toml")


@pytest.mark.parametrize(
    "parameters",
    [{}, {"ratio": 0.5, "field": (1.0, 1e-7)}, {"ratios": (0.3,), "unit": "s", "words": "a b", "on": True}],
)
def test_the_command_under_a_figure_makes_that_figure(parameters: dict[str, object]) -> None:
    """Typed words are read as the parameters that the figure has."""
    name, *arguments = shlex.split(Picture("", "quadric", "shaded", parameters).command)[1:]
    context = command_line.commands[name].make_context(name, arguments, click.Context(command_line, info_name="atlas"))
    assert context.params["names"] == ("quadric",)
    assert context.params["renderer"] == "shaded"
    assert dict(setting(word) for word in context.params["settings"]) == parameters
