"""The PDF as a book: parts and appendices, lists and index, equations by number, no sentence said twice on a page."""

import re
from pathlib import Path
from typing import Any

import pytest
from pypdf import PdfReader

from atlas.book.appendices import Appendices
from atlas.book.building.composed import composed
from atlas.book.building.report import build_report
from atlas.book.compose import compose
from atlas.book.digits import Number
from atlas.book.load import load
from atlas.book.tables.table import Data
from atlas.errors import AtlasError

BOOK = r"""
name = "book"
title = "A Small Book"
front_matter = true

[parameters]
bodies.ball = { title = "charged ball", ratio = 1.0 }
fields.oblique = { title = "oblique field", prime = [1.0, 2.0] }

[index]
words = ["nutation", "proper rotation"]
symbols = [{ tex = "\\omega_3", at = ["(71)"] }]

[[pages]]
slug = "index"
title = "The first chapter"
part = "The motion"
blocks = [
  { kind = "prose", text = '''
Proper rotation, @(72), has no nutation; the hyperbola is @(71).

## A section
''' },
  { kind = "equation", name = "(71)" },
  { kind = "table", table = "quadric", body = "ball", field = "oblique" },
]

[[pages]]
slug = "second"
title = "The second chapter"
part = "Appendices"
appendix = true
blocks = [
  { kind = "prose", text = "In the appendix @theorem-points stands, and beta is @cell:1-3-3." },
]
"""


SECOND = ']\n\n[[pages]]\nslug = "second"'
FIGURES = """  { kind = "figure", recipe = "magn", width = 150.0 },
  { kind = "figure", recipe = "ball", width = 160.0 },
  { kind = "figure", recipe = "magn", width = 155.0 },
"""
"""Too tall for the rest of a page."""
THIRD = """
[[pages]]
slug = "third"
title = "The third chapter"
printed = false
blocks = [{ kind = "prose", text = "Read on a screen." }]
"""


@pytest.fixture(scope="module")
def printed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Set the book and return its PDF."""
    folder = tmp_path_factory.mktemp("book")
    (folder / "book.toml").write_text(BOOK.replace(SECOND, FIGURES + SECOND) + THIRD, encoding="utf-8")
    return build_report(folder / "book.toml", folder, formats=("pdf",)).pdf


@pytest.fixture(scope="module")
def book(printed: Path) -> list[str]:
    """Return the text of the pages of the book."""
    return [" ".join(page.extract_text().split()) for page in PdfReader(printed).pages]


def test_no_figure_is_wider_than_the_text(printed: Path) -> None:
    """Three that ask for 150 to 160 mm: none has more than the 158 mm of a line."""
    widths = list[float]()
    for page in PdfReader(printed).pages:
        forms = page["/Resources"].get("/XObject", {})  # type: ignore[attr-defined]

        def measure(operator: bytes, operands: Any, matrix: Any, _text: Any, forms: Any = forms) -> None:
            if operator == b"Do":
                left, bottom, right, top = map(float, forms[operands[0]].get_object().get("/BBox", (0, 0, 1, 1)))
                widths.append((abs(matrix[0]) * (right - left) + abs(matrix[2]) * (top - bottom)) / 72 * 25.4)

        page.extract_text(visitor_operand_before=measure)
    assert len(widths) >= 3
    assert max(widths) <= 158.1


def test_contents_and_headings_are_numbered_alike(book: list[str]) -> None:
    """Part, chapter, section and appendix have one number in the contents and where they begin."""
    contents, body = book[1], " ".join(book[2:])
    for words in ("Part I The motion", "1 The first chapter", "1.1 A section", "A The second chapter"):
        assert words in contents
        assert words in body


def test_a_page_that_is_not_printed_is_named_in_the_contents(book: list[str]) -> None:
    """The PDF names it without a number, and has none of its text."""
    assert "In the HTML pages alone The third chapter" in book[1]
    assert not any("Read on a screen." in text for text in book)


def test_pages_that_are_not_printed_come_last(tmp_path: Path) -> None:
    """A chapter has one number in the pages and in the PDF."""
    report = tmp_path / "book.toml"
    report.write_text(
        BOOK.replace('slug = "second"', 'slug = "second"\nprinted = false') + THIRD.replace("printed = false", "")
    )
    with pytest.raises(AtlasError, match="must come last"):
        load(report)


def test_figures_stand_in_their_chapter_and_in_order(book: list[str]) -> None:
    """Figures too tall for one page float to the next ones, and the next chapter waits for them."""
    pages_of = {int(number): place for place, text in enumerate(book) for number in re.findall(r"Figure (\d)\. ", text)}
    chapter = max(place for place, text in enumerate(book) if "A The second chapter" in text)
    assert sorted(pages_of) == [1, 2, 3]
    assert len(set(pages_of.values())) > 1
    assert [pages_of[n] for n in (1, 2, 3)] == sorted(pages_of.values())
    assert max(pages_of.values()) <= chapter


def test_a_sentence_has_the_number_of_a_cell(book: list[str]) -> None:
    """The prose gives a computed number as the table does, with a power of ten only far from 1."""
    assert "and beta is 1.107148718." in " ".join(book[2:])
    assert Number("-1.2e-5").words() == "−1.2×10^−5^"
    assert [Number(digits).words() for digits in ("1.2e2", "-3.5e-2", "7", "")] == ["120", "−0.035", "7", "?"]
    assert [Number(digits).words() for digits in ("1e3", "1e4", "1e-3", "1e-4")] == [
        "1000",
        "1×10^4^",
        "0.001",
        "1×10^−4^",
    ]


def test_equations_are_cited_by_the_printed_number(book: list[str]) -> None:
    """The text has the number, and so has the display; no label of the source is printed."""
    body = " ".join(book[2:])
    assert "Proper rotation, (72), has no nutation; the hyperbola is (71)." in body
    assert body.count("(71)") == 2
    assert not re.search(r"\bmf\d", body)


def test_the_index_finds_words_and_symbols(book: list[str]) -> None:
    """Each word of the index has the pages of its paragraphs, each symbol that of its equation."""
    index = next(page for page in book if "Index" in page and "nutation" in page and "Contents" not in page)
    assert "nutation 1 proper rotation 1" in index
    assert "3 1 nutation" in index


def test_a_symbol_of_the_index_leads_somewhere(tmp_path: Path) -> None:
    """A name that there is not is told with the nearest one."""
    (tmp_path / "book.toml").write_text(BOOK.replace('at = ["(71)"]', 'at = ["(905)"]'), encoding="utf-8")
    with pytest.raises(AtlasError, match=r"the index: .*'@\(905\)'"):
        compose(load(tmp_path / "book.toml"), {}, Appendices())


def test_no_sentence_stands_below_two_tables_of_a_page(tmp_path: Path) -> None:
    """A note and the command that made a table are said once a page."""
    tables = "".join(f'  {{ kind = "recorded", source = "bench", table = "{name}" }},\n' for name in "AB")
    (tmp_path / "book.toml").write_text(BOOK.removesuffix("]\n") + tables + "]\n", encoding="utf-8")
    records = {f"bench: {name}": Data((), (), name, (f"Only {name}.", "Measured here.")) for name in "AB"}
    document = compose(load(tmp_path / "book.toml"), {}, Appendices({}, records))
    table_first, second = document.pages[1].blocks[1:]
    assert [document.texts[table.note].markdown for table in (table_first, second)] == [
        "Only A. Measured here.",
        "Only B.",
    ]
    assert (table_first.command, second.command) == ("make bench", "")


@pytest.mark.slow
def test_tables_stand_in_their_order(tmp_path: Path) -> None:
    """One of words, which stays in its place, does not overtake one of numbers that floats to the next page."""
    filler = "\n\n".join(["filled " * 90] * 6)
    table = '  { kind = "table", table = "quadric", body = "ball", field = "oblique" },\n'
    listing = '  { kind = "listing", id = "words", columns = ["C"], rows = [["d"]], caption = "Listed." },\n'
    (tmp_path / "book.toml").write_text(
        BOOK.replace("## A section", filler).replace(table, table + listing), encoding="utf-8"
    )
    built = build_report(tmp_path / "book.toml", tmp_path, formats=("pdf",))
    text = "".join(page.extract_text() for page in PdfReader(built.pdf).pages)
    assert re.findall(r"Table (\d)(?= ?\.)", text) == ["1", "2"]


@pytest.mark.slow
def test_an_option_is_not_broken_at_its_hyphens(tmp_path: Path) -> None:
    """No line of the PDF ends with one or two hyphens, however long the words before; in the page it is kept whole."""
    paragraphs = "\n\n".join("a" * n + " b" * 40 + " `--option 1` " + "c " * 9 for n in range(1, 25))
    (tmp_path / "book.toml").write_text(BOOK.replace("## A section", paragraphs), encoding="utf-8")
    built = build_report(tmp_path / "book.toml", tmp_path, formats=("html", "pdf"))
    lines = "\n".join(page.extract_text() for page in PdfReader(built.pdf).pages).splitlines()
    assert sum("--option" in line for line in lines) == 24
    assert not [line for line in lines if line.rstrip().endswith("-")]
    page = built.index.read_text(encoding="utf-8")
    assert page.count('<code><span class="option">--option</span> 1</code>') == 24


SHORT = """name = "short"
title = "A short report"

[[pages]]
slug = "index"
title = "Only page"
blocks = [
  { kind = "figure", recipe = "hyperbola" },
  { kind = "prose", text = "What it says." },
]
"""


@pytest.mark.slow
def test_a_short_report_has_its_title_first_and_no_empty_head(tmp_path: Path) -> None:
    """No cover, and no heading for an abstract that is not there, in a bound one neither; a figure stays below."""
    (tmp_path / "short.toml").write_text(SHORT, encoding="utf-8")
    built = build_report(tmp_path / "short.toml", tmp_path, formats=("pdf",))
    pages = [page.extract_text() for page in PdfReader(built.pdf).pages]
    assert len(pages) == 1
    assert pages[0].startswith("A short report")
    (tmp_path / "short.toml").write_text(SHORT.replace("[[", "front_matter = true\n[[", 1), encoding="utf-8")
    bound = build_report(tmp_path / "short.toml", tmp_path, formats=("pdf",))
    pages = [page.extract_text() for page in PdfReader(bound.pdf).pages]
    assert any("Contents" in page for page in pages)
    assert not any("Abstract" in page for page in pages)


@pytest.mark.slow
def test_a_short_report_names_its_authors_and_counts_only_tables_with_a_caption(tmp_path: Path) -> None:
    """The authors stand below the title; a table of the text takes no number from those that have one."""
    sentence = 'What it says, @tab:here.\\n\\n| a | b |\\n|---|---|\\n| 1 | 2 |" },\n'
    listing = '  { kind = "listing", id = "here", columns = ["C"], rows = [["d"]], caption = "Listed." },\n'
    short = SHORT.replace('What it says." },\n', sentence + listing).replace(
        "[[", 'authors = ["Ada Roe", "B Doe"]\n[[', 1
    )
    (tmp_path / "short.toml").write_text(short, encoding="utf-8")
    built = build_report(tmp_path / "short.toml", tmp_path, formats=("pdf",))
    text = " ".join(PdfReader(built.pdf).pages[0].extract_text().split())
    assert text.startswith("A short report Ada Roe, B Doe")
    assert "Table 1 . Listed" in text.replace("1.", "1 .")
    assert "Table 2" not in text


def test_an_unknown_style_is_refused_before_files_are_written(tmp_path: Path) -> None:
    """Typed or in the file: the report that is there stays."""
    report_style = SHORT.replace("[[", 'style = "nope.mplstyle"\n[[', 1)
    for style, text, message in (
        (None, report_style, "style: 'nope.mplstyle' is no file in"),
        ("none", SHORT, "the style 'none' cannot be used"),
    ):
        (tmp_path / "short.toml").write_text(text, encoding="utf-8")
        with pytest.raises(AtlasError, match=message):
            build_report(tmp_path / "short.toml", tmp_path / "out", style=style)
    assert not list((tmp_path / "out").glob("short*"))


@pytest.mark.slow
def test_a_report_has_its_style_wherever_it_is_drawn(tmp_path: Path) -> None:
    """`style` in the file, a sheet beside it, draws as `--style` does, in LaTeX, data and pages; the latter wins."""
    (tmp_path / "short.toml").write_text(SHORT, encoding="utf-8")
    (tmp_path / "wide.mplstyle").write_text("axes.linewidth: 3", encoding="utf-8")

    def pdf_of(style: str | None = None) -> bytes:
        file = tmp_path / "short.toml"
        _, figures, _ = composed(file, tmp_path, lambda _: ("pdf",), lambda *_: None, 1, style=style)
        return bytes(next(iter(figures.values())).contents["pdf"])

    plain, pdf_typed = pdf_of(), pdf_of(str(tmp_path / "wide.mplstyle"))
    assert plain != pdf_typed
    (tmp_path / "short.toml").write_text('style = "wide.mplstyle"\n' + SHORT, encoding="utf-8")
    assert pdf_of() == pdf_typed
    assert pdf_of("default") != pdf_typed
    build_report(tmp_path / "short.toml", tmp_path, formats=("html",))
    (page,) = (tmp_path / "short").glob("figures/*.pdf")
    assert page.read_bytes() == pdf_typed
