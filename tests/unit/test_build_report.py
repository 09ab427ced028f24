"""A whole report on real input: the content of the pages and the PDF, and the same bytes for the same input."""

import re
import unicodedata
from collections.abc import Iterator
from html import unescape
from io import BytesIO
from pathlib import Path
from urllib.parse import unquote

import pytest
from fontTools.ttLib import TTFont
from lxml import html as reader
from pypdf import PdfReader

from atlas.book import files
from atlas.book.building.report import Built, build_report
from atlas.errors import AtlasError

PLANCK = "\N{PLANCK CONSTANT}"
MINE = r"""
name = "mine"
front_matter = true
title = "A Small Report"
authors = ["A. Author"]
abstract = "With a formula, $R(t)$."

[parameters]
bodies.shell = { title = "shell", shape = "cylindrical_shell", mass = 1.0, radius = 0.5, height = 1.0 }
fields.oblique = { title = "oblique field", prime = [1.0, 2.0] }

[[pages]]
slug = "index"
title = "The first page"
blocks = [
  { kind = "prose", text = '''
## A section of it

The root $\sqrt{a_2}$, the vector $\mathbf{B}'$, *emphasis*, @(71), @fig:curve, @tab:points and @page:second.
''' },
  { kind = "equation", name = "(71)" },
  { kind = "equation", name = "flight", tex = '\mathbf{y}=\mathbf{y}_0+R\,\mathbf{x}' },
  { kind = "figure", recipe = "hyperbola", id = "curve", body = "shell", field = "oblique" },
]

[[pages]]
slug = "second"
title = "The second page"
blocks = [
  { kind = "table", table = "points", id = "points", body = "shell", field = "oblique", parameters.omega2 = [0.7] },
  { kind = "listing", columns = ["Letter", "Meaning"], rows = [["$k$", "frequency of precession"]], caption = "All." },
  { kind = "note", text = "See @(71) and @flight again." },
  { kind = "figure", recipe = "trochoids", parameters = { mu = 0.0 } },
  { kind = "figure", recipe = "hyperbola", body = "shell", field = "oblique" },
]
"""


@pytest.fixture(scope="module")
def toml(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Write the report's file."""
    file = tmp_path_factory.mktemp("source") / "mine.toml"
    file.write_text(MINE, encoding="utf-8")
    return file


@pytest.fixture(scope="module")
def built(toml: Path, tmp_path_factory: pytest.TempPathFactory) -> Built:
    """Build the report once for all tests of this file."""
    return build_report(toml, tmp_path_factory.mktemp("out"))


def pages(built: Built) -> Iterator[tuple[Path, reader.HtmlElement]]:
    """Parse each page."""
    for path in sorted(built.index.parent.glob("*.html")):
        yield path, reader.fromstring(path.read_text(encoding="utf-8"))


def italic(letter: str) -> str:
    """Return the letter in which a browser shows a variable; Unicode has no mathematical italic h but Planck's."""
    case = "CAPITAL" if letter.isupper() else "SMALL"
    return PLANCK if letter == "h" else unicodedata.lookup(f"MATHEMATICAL ITALIC {case} {letter.upper()}")


def test_no_unrendered_markup_is_left_in_pages(built: Built) -> None:
    """No TeX, no Markdown, no template syntax, no citation is left in the reader's text."""
    for path, page in pages(built):
        for element in page.xpath(
            "//script[not(@src='page.js' or @src='minisearch.js' or @src='scene.js')] | //annotation"
        ):
            pytest.fail(f"{path.name} holds {element.tag}")
        text = page.text_content()
        assert not re.search(r"\\[a-zA-Z]+|\$|\{\{|\}\}|\{%|@\w|\*\*|::", text), path.name


def test_every_link_leads_to_a_file_of_the_report(built: Built) -> None:
    """Each href and src leads to a file of the report and to an anchor in it; nothing leads to the network."""
    anchors = {path.name: set(page.xpath("//@id")) for path, page in pages(built)}
    for path, page in pages(built):
        assert len(page.xpath("//@id")) == len(anchors[path.name]), "an id stands twice"
        for link in page.xpath("//@href | //@src"):
            file, _, anchor = unquote(link).partition("#")
            assert "://" not in link
            target = path.parent / file if file else path
            assert target.resolve().is_file(), link
            assert not anchor or anchor in anchors[target.name], link
    style = (built.index.parent / "style.css").read_text(encoding="utf-8")
    for link in re.findall(r'url\("([^"]+)"\)', style):
        assert (built.index.parent / link).is_file()


def test_every_figure_has_alternative_text_caption_and_command(built: Built) -> None:
    """A picture has alternative text without TeX; a figure a number, a caption, its recipe's name and its command."""
    numbers = []
    for _, page in pages(built):
        for image in page.xpath("//main//img"):
            assert len(image.get("alt")) > 20
            assert not re.search(r"[\\$]", image.get("alt"))
        for figure in page.xpath("//figure[not(contains(@class, 'table'))]"):
            (caption,) = figure.xpath("figcaption")
            numbers += re.findall(r"^\s*Figure (\d+)\.", caption.text_content())
            assert "Recipe" in caption.text_content()
            if figure.xpath(".//img"):
                assert f"atlas figure {caption.xpath('string(.//code)')}" in caption.text_content()
    assert sorted(numbers) == ["1", "2", "3"]


def test_formulas_are_mathml_and_equations_have_their_numbers(built: Built) -> None:
    """Display formulas are MathML; the paper's has its number in print, our own the letter A."""
    source = built.index.read_text(encoding="utf-8")
    assert source.count("<math") >= 5
    page = reader.fromstring(source)
    tags = [" ".join(tag.text_content().split()) for tag in page.xpath("//div[@class='tag']")]
    assert tags == ["(71)", "(A1) flight"]


def test_the_math_font_holds_radicals_and_all_characters_of_formulas(built: Built) -> None:
    """The embedded subset has a MATH table, U+221A, and every character of every formula."""
    with TTFont(built.index.parent / "fonts" / "math.woff") as font:
        covered = set(font.getBestCmap())
        assert "MATH" in font
    assert 0x221A in covered
    for path, page in pages(built):
        for formula in page.xpath("//*[local-name()='math']"):
            characters = {c for c in formula.text_content() if c.strip()}
            letters = {mi.text for mi in formula.xpath(".//*[local-name()='mi'][not(@mathvariant)]") if mi.text}
            characters |= {
                italic(letter) for letter in letters if len(letter) == 1 and letter.isascii() and letter.isalpha()
            }
            uncovered = {c for c in characters if ord(c) not in covered}
            assert not uncovered, (path.name, uncovered)


def test_a_report_with_a_failing_figure_is_built_with_a_note(built: Built) -> None:
    """A particle without charge draws no trochoid: the page says so, the build reports it, the rest is there."""
    assert not built.ok
    ((recipe, reason),) = built.failures
    assert recipe == "trochoids"
    assert "mu" in reason
    assert "Error" not in reason
    (note,) = reader.fromstring((built.index.parent / "second.html").read_text("utf-8")).xpath("//div[@role='note']")
    assert reason in " ".join(note.text_content().split())
    assert built.figures == 1
    assert "could not be drawn" in " ".join(page.extract_text() for page in PdfReader(built.pdf).pages)


def test_a_figure_shown_twice_is_drawn_once(built: Built) -> None:
    """The same recipe with the same parameters is one file."""
    assert sorted(path.suffix for path in (built.index.parent / "figures").iterdir()) == [
        ".gz",
        ".pdf",
        ".png",
        ".svg",
    ]


def test_the_pdf_has_the_same_content(built: Built) -> None:
    """Title page, contents, both sections, the numbers of the table and the numbered figures are in the PDF."""
    pdf = PdfReader(built.pdf)
    texts = [" ".join(page.extract_text().split()) for page in pdf.pages]
    assert len(texts) >= 4
    assert "A Small Report" in texts[0]
    assert "Contents" in texts[1]
    for title in ("The first page", "The second page", "A section of it"):
        assert title in texts[1]
        assert any(title in text for text in texts[2:])
    pdf_text = " ".join(texts)
    for words in ("Figure 1", "Table 1", "Table 2", "(71)", "(71)", "(A1)", "hyperbola", "stable"):
        assert words in pdf_text
    assert not re.search(r"\\[a-z]{2,}|\$|@mf", pdf_text)


@pytest.mark.parametrize(
    ("line", "line_wrong", "message"),
    [
        (
            'recipe = "hyperbola"',
            'recipe = "hyprbola"',
            r"page 'index', block \d+ \(figure\): .*'hyperbola'",
        ),
        ('name = "mine"', 'name = "other"', "the report's name is 'other', and must be that of its file, 'mine'"),
    ],
)
def test_a_mistake_names_the_file(tmp_path: Path, line: str, line_wrong: str, message: str) -> None:
    """Of several reports that are built at once it is known which to mend."""
    file = tmp_path / "mine.toml"
    file.write_text(MINE.replace(line, line_wrong), encoding="utf-8")
    with pytest.raises(AtlasError, match=rf"mine\.toml: {message}"):
        build_report(file, tmp_path / "out")


@pytest.mark.slow
def test_a_citation_that_leads_nowhere_is_an_error(tmp_path: Path) -> None:
    """A misspelt label names the file, the block and the nearest label, and nothing is written."""
    file = tmp_path / "mine.toml"
    file.write_text(MINE.replace("@fig:curve", "@fig:curv"), encoding="utf-8")
    with pytest.raises(AtlasError, match=r"^mine\.toml: page 'index', block 1 .*'@fig:curv' .*'@fig:curve'"):
        build_report(file, tmp_path / "out")
    assert not list((tmp_path / "out").rglob("*.html"))


def test_misspelt_recipes_and_parameters_are_errors(tmp_path: Path) -> None:
    """A recipe or parameter that there is not stops the build with the nearest name."""
    file = tmp_path / "mine.toml"
    file.write_text(MINE.replace('recipe = "trochoids"', 'recipe = "trochoid"'), encoding="utf-8")
    with pytest.raises(AtlasError, match="'trochoids'"):
        build_report(file, tmp_path / "out")
    file.write_text(MINE.replace("{ mu = 0.0 }", "{ speds = [1.0] }"), encoding="utf-8")
    with pytest.raises(AtlasError, match="'speeds'"):
        build_report(file, tmp_path / "out")


@pytest.mark.slow
def test_text_is_escaped_for_html(tmp_path: Path) -> None:
    """Signs that HTML and Typst give a meaning are only signs in a title."""
    file = tmp_path / "mine.toml"
    title = "I < 2 & [#this] $5 *now* <b>"
    short = MINE.split("blocks = [", maxsplit=1)[0].replace("The first page", title) + "blocks = []\n"
    file.write_text(short, encoding="utf-8")
    report = build_report(file, tmp_path / "out")
    heading = re.search(r"<h1>(.*?)</h1>", report.index.read_text(encoding="utf-8"))
    assert heading
    assert unescape(heading[1]) == title
    assert title in " ".join(PdfReader(BytesIO(report.pdf.read_bytes())).pages[2].extract_text().split())


@pytest.mark.slow
def test_pages_or_the_pdf_can_be_built_alone(tmp_path: Path) -> None:
    """With one format the other stays as it was; asked for both, only the one that is out of date is made."""
    file, out = tmp_path / "mine.toml", tmp_path / "out"
    file.write_text(MINE.replace("{ mu = 0.0 }", "{ }"), encoding="utf-8")
    report = build_report(file, out)
    assert build_report(file, out).reasons[0][2].startswith("taken")
    before = report.pdf.read_bytes()
    file.write_text(MINE.replace("{ mu = 0.0 }", "{ }").replace("A Small Report", "A New Title"), encoding="utf-8")
    build_report(file, out, formats=["html"])
    assert "A New Title" in report.index.read_text("utf-8")
    assert report.pdf.read_bytes() == before
    assert build_report(file, out, formats=["html"]).reasons[0][2].startswith("taken")
    pages = {path: path.stat().st_mtime_ns for path in report.index.parent.rglob("*") if path.is_file()}
    build_report(file, out, formats=["pdf"])
    assert "A New Title" in PdfReader(report.pdf).pages[0].extract_text()
    assert {path: path.stat().st_mtime_ns for path in report.index.parent.rglob("*") if path.is_file()} == pages
    assert build_report(file, out).reasons[0][2].startswith("taken")


@pytest.mark.slow
def test_a_report_is_built_again_where_one_beside_it_says_something_new(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What it does not ask may change; of what it asks, a change gives the pages and the PDF of a first build."""
    (tmp_path / "reports").mkdir()
    monkeypatch.setattr(files, "folder", lambda _: tmp_path / "reports")
    page = '+++\nname = "{}"\ntitle = "{}"\n{}+++\n\n# One\n\n{}\n'
    other, own = (tmp_path / "reports" / f"{name}.md" for name in ("other", "own"))
    own.write_text(page.format("own", "Own", '[related]\nother = "Other"\n', "See @(72) and @report:other."))

    def built_beside(title: str, text: str, out: Path) -> Built:
        other.write_text(page.format("other", title, "", text))
        return build_report(own, out)

    built_beside("Other", "Words.", tmp_path / "out")
    assert built_beside("Other", "Other words.", tmp_path / "out").reasons[0][2].startswith("taken")
    after, first = (built_beside("New", "Other words.", tmp_path / out) for out in ("out", "first"))
    assert "New" in after.index.read_text("utf-8")
    for one, two in ((after.index, first.index), (after.pdf, first.pdf)):
        assert one.read_bytes() == two.read_bytes()
