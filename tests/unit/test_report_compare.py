"""Two built reports are compared number by number, figure by figure, and nothing that differs is passed over."""

import base64
import copy
import hashlib
import json
import re
from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from atlas.errors import AtlasError
from atlas.report.compare import Comparison, amount, compare, number
from atlas.report.compare_page import as_page
from atlas.report.manifest import read

THIN = "\N{NARROW NO-BREAK SPACE}"
MINUS = "\N{MINUS SIGN}"
SVG = '<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"><title>{}</title></svg>'
PNG = base64.b64decode(
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNkYPhfDwAChwGA60e6kgAAAABJRU5ErkJggg=="
)
SAMPLE: dict[str, Any] = {
    "format": 1,
    "name": "atlas",
    "title": "An Atlas",
    "pages": {"index": {"title": "The problem", "text": "a" * 64}, "loop": {"title": "The loop", "text": "b" * 64}},
    "tables": {
        "tab-points": {
            "page": "loop",
            "caption": r"Points of the hyperbola @mf72, $\omega_2$ chosen.",
            "columns": ["Point", r"$\omega_2$", r"$\omega_3$", "Nutation"],
            "units": ["", r"s$^{-1}$", r"s$^{-1}$", ""],
            "rows": [
                ["at rest", "0", "0", "stable"],
                [r"$\phi=0$", f"{MINUS}2", f"{MINUS}4.000{THIN}0", "stable"],
                ["", "0.7", f"0.658{THIN}823{THIN}529{THIN}4", "stable"],
                ["", "1.5", "1.2e-07", "marginal"],
            ],
        }
    },
    "figures": {
        "fig-bowl": {
            "page": "loop",
            "caption": "The bowl of $I=2$.",
            "recipe": "hyp_a",
            "renderer": "vector",
            "parameters": {"ratio": 2, "field": [1, 2]},
            "file": "figures/01-hyp-a.svg",
            "sha256": "",
        },
        "fig-shaded": {
            "page": "loop",
            "caption": "The same, shaded.",
            "recipe": "hyp_a",
            "renderer": "shaded",
            "parameters": {},
            "file": "figures/02-hyp-a.png",
            "sha256": "",
        },
    },
    "versions": {"atlas": "0.1.0", "numpy": "2.4.6"},
}

Change = Callable[[dict[str, Any]], object]
Pair = Callable[..., Comparison]


def report(where: Path, change: Change = lambda _: None, bowl: str = "one") -> Path:
    """Write a built report: the sample after a change, its pictures and their digests."""
    record = copy.deepcopy(SAMPLE)
    change(record)
    (where / "figures").mkdir(parents=True)
    for figure in record["figures"].values():
        if figure["file"] is not None:
            content = PNG if figure["file"].endswith("png") else SVG.format(bowl).encode()
            (where / figure["file"]).write_bytes(content)
            figure["sha256"] = hashlib.sha256(content).hexdigest()
    (where / "index.html").write_text("<p>The problem</p>")
    (where / "manifest.json").write_text(json.dumps(record), encoding="utf-8")
    return where


@pytest.fixture
def against(tmp_path: Path) -> Pair:
    """Return a function that compares the sample with the sample after a change."""

    def pair(change: Change = lambda _: None, bowl: str = "one") -> Comparison:
        return compare(report(tmp_path / "old"), report(tmp_path / "new", change, bowl))

    return pair


def rows(record: dict[str, Any]) -> list[list[str]]:
    """Return the rows of the sample's table."""
    found: list[list[str]] = record["tables"]["tab-points"]["rows"]
    return found


def told(found: Comparison) -> list[tuple[str, str, str, str]]:
    """Return all changes besides cells and figures."""
    return [(change.where, change.what, change.old, change.new) for change in found.others]


def test_a_report_is_the_same_as_itself(against: Pair) -> None:
    """Nothing changed between two copies, and the page says so."""
    found = against()
    assert not found.changed
    assert not found.notes
    assert found.extent == "1 table, 2 figures, 2 pages"
    assert "The two reports are the same: 1 table, 2 figures, 2 pages." in as_page(found)


@pytest.mark.parametrize(
    ("text", "value", "marked"),
    [
        ("0.6588235294", Fraction(6588235294, 10**10), False),
        (f"0.658{THIN}823{THIN}529{THIN}4", Fraction(6588235294, 10**10), False),
        ("-1.2e-07", Fraction(-12, 10**8), False),
        (f"{MINUS}1.2e{MINUS}7", Fraction(-12, 10**8), False),
        ("1.5?", Fraction(3, 2), True),
        ("1.5e+03?", Fraction(1500), True),
        (f"1.2 × 10^{MINUS}7", Fraction(12, 10**8), False),
        ("1.2\u2009×\u200910⁻⁷", Fraction(12, 10**8), False),
        (r"$1.2\times 10^{-7}$", Fraction(12, 10**8), False),
        ("3×10^2", Fraction(300), False),
        ("+.5", Fraction(1, 2), False),
        ("7.", Fraction(7), False),
        (" 0 ", Fraction(0), False),
    ],
)
def test_numbers_are_read_exactly(text: str, value: Fraction, marked: bool) -> None:
    """A printed number is read as the rational that it is, in every way of printing it."""
    found = number(text)
    assert found is not None
    assert (Fraction(found[0]), found[1]) == (value, marked)


@pytest.mark.parametrize(
    "text",
    [
        *("", "?", "??", "-", ".", "nan", "NaN", "inf", "-Infinity", "not certified", "stable", "s$^{-1}$", "1.5 s"),
        *(
            "1e",
            "e5",
            "1.2.3",
            "1 2",
            "0x10",
            "1,5",
            "5²",
            "3×107",
            "٣",
            "1/2",
            "--1",
            "1_000",
            "1e9999999999999999999",
        ),
    ],
)
def test_words_are_no_numbers(text: str) -> None:
    """What only looks like a number, such as NaN or a superscript, stays a word."""
    assert number(text) is None


DIGITS = st.integers(min_value=-(10**12), max_value=10**12)
POWERS = st.integers(min_value=-30, max_value=30)


@settings(max_examples=200)
@given(DIGITS, POWERS, DIGITS, POWERS)
def test_the_difference_is_exact(m: int, e: int, n: int, f: int) -> None:
    """Old plus the difference is new, in rational arithmetic, and the relative difference is right to 30 digits."""
    old, new = Fraction(m) * Fraction(10) ** e, Fraction(n) * Fraction(10) ** f
    found = amount(Decimal(f"{m}e{e}"), Decimal(f"{n}e{f}"))
    spread = len(f"{abs(m)}{abs(n)}") + 30
    if abs(e - f) + 13 <= spread:
        assert Fraction(found.difference) == new - old
    assert abs(Fraction(found.difference) - (new - old)) <= abs(new - old) * Fraction(10) ** (1 - spread)
    if old == 0:
        assert found.relative is None
    else:
        assert found.relative is not None
        relative = abs(new - old) / abs(old)
        assert abs(Fraction(found.relative) - relative) <= relative * Fraction(1, 10**30)


@pytest.mark.parametrize(
    ("old", "new", "digits"),
    [
        ("0.6588235294", "0.6588235301", 8),
        ("1.2341", "1.2349", 4),
        ("0.9999", "1.0001", 4),
        ("0.99999999", "1.00000001", 8),
        ("9.99e-5", "1.00e-4", 3),
        ("1.5", "2.5", 0),
        ("1.5", "15", 0),
        ("-1.5", "1.5", 0),
        ("1.5", "1.5000001", 2),
        ("1.50", "1.5", 2),
        ("0", "1e-300", 0),
        ("1e-300", "0", 0),
        ("100", "101", 2),
        ("-0.00123456", "-0.00123999", 3),
    ],
)
def test_leading_digits_that_agree_are_counted(old: str, new: str, digits: int) -> None:
    """The same leading digits count, also across a carry, but none that only one of the two prints."""
    assert amount(Decimal(old), Decimal(new)).digits == digits
    assert amount(Decimal(new), Decimal(old)).digits == digits


def test_exponents_may_be_enormous(against: Pair) -> None:
    """Numbers that no double holds are compared at once and without a flood of digits."""

    def change(record: dict[str, Any]) -> None:
        rows(record)[3][2] = "-3.25e-999999999999999"
        rows(record)[0][2] = "2e999999999999999"

    found = against(change)
    first, last = (cell.amount for cell in found.numbers)
    assert first is not None
    assert last is not None
    assert first.difference == Decimal("2e999999999999999")
    assert first.relative is None
    assert last.difference == Decimal("-1.2e-7")
    assert last.relative == 1
    assert len(as_page(found)) < 1_000_000


def test_a_changed_number_is_told_with_its_place(against: Pair) -> None:
    """Table, row, column, unit, both texts, the exact difference and the digits that agree are there."""

    def change(record: dict[str, Any]) -> None:
        rows(record)[2][2] = "0.6588235301"

    found = against(change)
    (cell,) = found.numbers
    assert (cell.table, cell.page, cell.row, cell.column, cell.unit) == (
        "tab-points",
        "loop",
        "0.7",
        r"$\omega_3$",
        r"s$^{-1}$",
    )
    assert (cell.old, cell.new) == (f"0.658{THIN}823{THIN}529{THIN}4", "0.6588235301")
    assert cell.amount is not None
    assert cell.amount.difference == Decimal("7e-10")
    assert cell.amount.relative is not None
    assert abs(Fraction(cell.amount.relative) / Fraction(7, 6588235294) - 1) < Fraction(1, 10**30)
    assert cell.amount.digits == 8
    assert not found.words
    assert not found.figures
    assert not found.others


def test_signs_and_spaces_of_another_kind_are_no_change(against: Pair) -> None:
    """A hyphen for a minus sign, digits in groups or not, and a power written another way leave a number the same."""

    def change(record: dict[str, Any]) -> None:
        rows(record)[1][1:3] = ["-2", "-4.0000"]
        rows(record)[3][2] = "1.2 × 10⁻⁷"

    assert not against(change).changed


@pytest.mark.parametrize("text", ["-4.000", "-4.00000", "-4.0000?"])
def test_more_or_fewer_proven_digits_are_a_change(against: Pair, text: str) -> None:
    """A number that prints or proves other digits changed, by zero."""
    found = against(lambda record: rows(record)[1].__setitem__(2, text))
    (cell,) = found.numbers
    assert cell.amount is not None
    assert cell.amount.difference == 0
    assert found.changed


@pytest.mark.parametrize("text", ["NaN", "not certified", "??", "", "±0.66", "0,66"])
def test_a_number_that_became_a_word_is_told(against: Pair, text: str) -> None:
    """A cell that is no number any more is among the words, never skipped."""
    found = against(lambda record: rows(record)[2].__setitem__(2, text))
    assert not found.numbers
    assert [(cell.row, cell.new) for cell in found.words] == [("0.7", text)]


def test_rows_are_matched_by_their_first_cell(against: Pair) -> None:
    """Rows in another order keep their numbers; the order itself is the only change, with the one number that is."""

    def change(record: dict[str, Any]) -> None:
        rows(record).reverse()
        rows(record)[2][2] = "-4.0001"

    found = against(change)
    assert [(cell.row, cell.old, cell.new) for cell in found.cells] == [
        (r"$\phi=0$", f"{MINUS}4.000{THIN}0", "-4.0001")
    ]
    assert told(found) == [("tab-points", "order of rows", "", "")]


def test_rows_that_share_a_first_cell_are_told_apart_by_the_next(against: Pair) -> None:
    """Rows without a name are known by the number that follows, wherever they stand."""

    def change(record: dict[str, Any]) -> None:
        table = rows(record)
        table[2], table[3] = table[3], table[2]
        table[2][2] = "1.3e-07"

    found = against(change)
    assert [(cell.row, cell.old, cell.new) for cell in found.cells] == [("1.5", "1.2e-07", "1.3e-07")]


def test_a_row_that_has_no_match_is_paired_by_its_place(against: Pair) -> None:
    """A renamed row shows its name and its numbers as changed."""
    found = against(lambda record: rows(record).__setitem__(0, ["rest", "0", "0.1", "stable"]))
    assert [(cell.column, cell.old, cell.new) for cell in found.cells] == [
        ("Point", "at rest", "rest"),
        (r"$\omega_3$", "0", "0.1"),
    ]
    assert not found.others


@pytest.mark.parametrize(
    ("old", "new", "name"),
    [
        (["", "", "", ""], ["", "", "0.5", ""], "row 3"),
        (["", "", "0.5", ""], ["", "", "0.6", ""], "0.5"),
        (["", "0.7", "0.5", ""], ["", "0.7", "0.6", ""], "0.7"),
        (["p", "0.7", "0.5", ""], ["p", "0.8", "0.5", ""], "p"),
    ],
)
def test_a_changed_row_is_named_by_its_words(tmp_path: Path, old: list[str], new: list[str], name: str) -> None:
    """A row is named by the first cells that tell it apart, by its first words, or else by its number from one."""
    one, two = (
        report(tmp_path / where, lambda record, row=row: rows(record).__setitem__(2, row))  # type: ignore[misc]
        for where, row in (("old", old), ("new", new))
    )
    assert [cell.row for cell in compare(one, two).cells] == [name]


def test_rows_that_came_or_went_are_listed(against: Pair) -> None:
    """A row inserted in the middle and one removed are told whole, and the rest is matched across them."""

    def change(record: dict[str, Any]) -> None:
        rows(record).insert(1, ["new point", "3", "4", "unstable"])
        del rows(record)[3:]
        rows(record).append(["", "1.5", "1.2e-07", "marginal"])

    found = against(change)
    assert not found.cells
    assert told(found) == [
        ("tab-points", "row removed", f" | 0.7 | 0.658{THIN}823{THIN}529{THIN}4 | stable", ""),
        ("tab-points", "row added", "", "new point | 3 | 4 | unstable"),
    ]


def test_rows_that_are_all_the_same_are_counted(tmp_path: Path) -> None:
    """Two equal rows are the same two behind a row that came before them."""
    same = ["x", "1", "2", "y"]
    old = report(tmp_path / "old", lambda record: rows(record).__setitem__(slice(None), [same, same]))
    new = report(
        tmp_path / "new", lambda record: rows(record).__setitem__(slice(None), [["w", "1", "2", "y"], same, same])
    )
    found = compare(old, new)
    assert not found.cells
    assert told(found) == [("tab-points", "row added", "", "w | 1 | 2 | y")]


def test_columns_are_matched_by_their_head(against: Pair) -> None:
    """A column may move, come or go, and change its unit; the numbers of the others are compared all the same."""

    def change(record: dict[str, Any]) -> None:
        table = record["tables"]["tab-points"]
        table["columns"] = ["Point", r"$\omega_3$", r"$\omega_2$", "$k$"]
        table["units"] = ["", "1", r"s$^{-1}$", ""]
        table["rows"] = [[point, third, second, "9"] for point, second, third, _ in table["rows"]]
        table["rows"][0][2] = "0.5"

    found = against(change)
    assert [(cell.row, cell.column, cell.old, cell.new) for cell in found.cells] == [
        ("at rest", r"$\omega_2$", "0", "0.5")
    ]
    assert told(found) == [
        ("tab-points", r"unit of $\omega_3$", r"s$^{-1}$", "1"),
        ("tab-points", "column removed", "Nutation", ""),
        ("tab-points", "column added", "", "$k$"),
        ("tab-points", "order of columns", "", ""),
    ]


def test_columns_with_the_same_head_are_counted(tmp_path: Path) -> None:
    """Two columns without a head are compared each with its own."""

    def blank(middle: str, last: str) -> Change:
        def change(record: dict[str, Any]) -> None:
            record["tables"]["tab-points"] |= {"columns": ["", "", "Value", ""], "rows": [["a", middle, "2", last]]}

        return change

    found = compare(report(tmp_path / "old", blank("1", "3")), report(tmp_path / "new", blank("5", "4")))
    assert [(cell.old, cell.new) for cell in found.cells] == [("1", "5"), ("3", "4")]
    assert not found.others


def test_tables_pages_titles_and_versions_are_listed(against: Pair) -> None:
    """Whatever came, went or was reworded is told once."""

    def change(record: dict[str, Any]) -> None:
        table = record["tables"].pop("tab-points")
        record["tables"]["tab-hyperbola"] = table
        record["title"] = "An Atlas, ünïcode ☄"
        record["pages"]["index"]["text"] = "c" * 64
        record["pages"]["ball"] = {"title": "The ball", "text": "d" * 64}
        del record["pages"]["loop"]
        record["versions"] = {"atlas": "0.2.0", "flint": "0.9"}

    caption = r"Points of the hyperbola @mf72, $\omega_2$ chosen."
    assert told(against(change)) == [
        ("report", "title", "An Atlas", "An Atlas, ünïcode ☄"),
        ("page index", "text", "", ""),
        ("page loop", "removed", "The loop", ""),
        ("page ball", "added", "", "The ball"),
        ("tab-points", "removed", caption, ""),
        ("tab-hyperbola", "added", "", caption),
        ("versions", "atlas", "0.1.0", "0.2.0"),
        ("versions", "numpy", "2.4.6", ""),
        ("versions", "flint", "", "0.9"),
    ]


def uris(page: str, kind: str) -> list[bytes]:
    """Return the pictures that a page holds."""
    return [base64.b64decode(text) for text in re.findall(rf'<img src="data:{kind};base64,([^"]+)"', page)]


def test_a_changed_picture_stands_beside_the_old_one(against: Pair) -> None:
    """A figure with another picture and another parameter is told, and the page holds both pictures, old one first."""
    found = against(lambda record: record["figures"]["fig-bowl"]["parameters"].update(ratio=1.5), bowl="two")
    (drawing,) = found.figures
    assert drawing.id == "fig-bowl"
    assert [(change.what, change.old, change.new) for change in drawing.changes] == [
        ("ratio", "2", "1.5"),
        ("picture", "", ""),
    ]
    assert uris(as_page(found), r"image/svg\+xml") == [SVG.format(name).encode() for name in ("one", "two")]


def test_a_number_of_another_type_is_the_same_parameter(against: Pair) -> None:
    """2 and 2.0 are one ratio, and another file name is no other picture."""

    def change(record: dict[str, Any]) -> None:
        record["figures"]["fig-bowl"] |= {
            "parameters": {"field": [1.0, 2.0], "ratio": 2.0},
            "file": "figures/07-hyp-a.svg",
        }

    assert not against(change).changed


def test_a_figure_that_fails_now_is_told(against: Pair) -> None:
    """A figure that could be drawn before shows its old picture beside a framed note."""
    found = against(lambda record: record["figures"]["fig-bowl"].update(file=None, sha256=None))
    (drawing,) = found.figures
    assert [(change.what, change.old, change.new) for change in drawing.changes] == [("picture", "drawn", "failed")]
    page = as_page(found)
    assert uris(page, r"image/svg\+xml") == [SVG.format("one").encode()]
    assert page.count("This figure could not be drawn.") == 1


def test_figures_that_came_or_went_are_told(against: Pair) -> None:
    """A figure in only one of the reports stands beside an empty frame."""

    def change(record: dict[str, Any]) -> None:
        record["figures"]["fig-cup"] = record["figures"].pop("fig-shaded")

    found = against(change)
    assert [(drawing.id, drawing.changes[0].what) for drawing in found.figures] == [
        ("fig-shaded", "removed"),
        ("fig-cup", "added"),
    ]
    page = as_page(found)
    assert uris(page, "image/png") == [PNG, PNG]
    assert page.count("There is no such figure in this report.") == 2


def test_a_picture_that_is_not_there_is_noted(tmp_path: Path) -> None:
    """A lost or altered picture is no change of the report, but it is said, and the page has a note in its place."""
    old = report(tmp_path / "old")
    new = report(tmp_path / "new", bowl="two")
    (old / "figures/01-hyp-a.svg").unlink()
    (new / "figures/02-hyp-a.png").write_bytes(b"spilt coffee")
    found = compare(old, new)
    assert [drawing.id for drawing in found.figures] == ["fig-bowl"]
    assert found.notes == (
        f"{old}: lost or altered since the build: figures/01-hyp-a.svg.",
        f"{new}: lost or altered since the build: figures/02-hyp-a.png.",
    )
    page = as_page(found)
    assert "The picture figures/01-hyp-a.svg is not in the folder of this report." in page
    assert uris(page, r"image/svg\+xml") == [SVG.format("two").encode()]


def test_a_manifest_reaches_no_file_outside_its_folder(tmp_path: Path) -> None:
    """A picture is taken from the report's own folder or not at all."""
    (tmp_path / "secret.svg").write_text("secret")
    old = report(tmp_path / "old")
    new = report(tmp_path / "new", bowl="two")
    text = (new / "manifest.json").read_text(encoding="utf-8").replace("figures/01-hyp-a.svg", "../secret.svg")
    (new / "manifest.json").write_text(text, encoding="utf-8")
    found = compare(old, new)
    assert "lost or altered" in found.notes[0]
    assert uris(as_page(found), r"image/svg\+xml") == [SVG.format("one").encode()]


def test_the_page_needs_no_other_file(against: Pair) -> None:
    """Style, fonts and pictures are inside; formulas are MathML; words are escaped, and no script may run."""

    def change(record: dict[str, Any]) -> None:
        record["figures"]["fig-bowl"]["caption"] = "<script>alert(1)</script> $\\frac{1}{2}<\\beta$ costs $5 & ☄"
        rows(record)[2][2] = "0.66"

    page = as_page(against(change, bowl="two"))
    assert not re.findall(r"""(?:src|href)=["'](?!data:|#)""", page)
    assert not re.findall(r"url\((?!\"data:font/woff2)", page)
    assert page.count("@font-face") == 4
    assert "<script" not in page
    assert "&lt;script&gt;alert(1)&lt;/script&gt;" in page
    assert "<mfrac>" in page
    assert "$5 &amp; ☄" in page
    assert "0.6<mark>58\u202f823\u202f529\u202f4</mark>" in page
    assert 'http-equiv="Content-Security-Policy" content="default-src \'none\'; img-src data:;' in page


def test_citations_are_written_in_words(against: Pair) -> None:
    """No citation is shown as the report's file has it: equations, figures, tables and pages have their names."""

    def change(record: dict[str, Any]) -> None:
        caption = "The bowl of @mf72 and @theorem-points, see @fig:cup, @tab:points and *@page:loop*, "
        caption += "10^\N{MINUS SIGN}6^ high."
        record["figures"]["fig-bowl"]["caption"] = caption

    page = as_page(against(change))
    assert "The bowl of (mf72) and (theorem-points), see fig-cup, tab-points and <i>The loop</i>, " in page
    assert "10<sup>\N{MINUS SIGN}6</sup> high." in page
    assert "@" not in re.sub(r"<style>.*?</style>", "", page, flags=re.DOTALL)


def test_the_same_comparison_gives_the_same_page(against: Pair) -> None:
    """A page depends on nothing but the two reports."""
    found = against(bowl="two")
    assert as_page(found) == as_page(found)


@pytest.mark.parametrize("name", ["", "index.html", "manifest.json"])
def test_a_report_is_named_by_its_folder_or_a_file_in_it(tmp_path: Path, name: str) -> None:
    """The folder, its index.html and its manifest.json mean the same report."""
    assert read(report(tmp_path / "old") / name).folder == tmp_path / "old"


def spoilt(where: Path, text: str) -> Path:
    """Write a folder with such a manifest."""
    where.mkdir()
    (where / "manifest.json").write_bytes(text.encode("utf-8", "surrogateescape"))
    return where


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("", "is not the manifest of a report"),
        ("[]", "is not the manifest of a report"),
        ("{", "is not the manifest of a report"),
        ("\udcff", "is not the manifest of a report"),
        ('{"name": "atlas"}', "has format None; this atlas reads format 1"),
        (json.dumps(SAMPLE | {"format": 2}), "has format 2; this atlas reads format 1"),
        (json.dumps(SAMPLE | {"format": "1"}), "has format '1'; this atlas reads format 1"),
        (json.dumps(SAMPLE | {"tables": 3}), r"Expected `object`, got `int` - at `\$\.tables`"),
        (json.dumps(SAMPLE).replace('"2.4.6"', "NaN"), "is not the manifest of a report"),
        (json.dumps(SAMPLE).replace('"at rest", ', ""), "in table tab-points not every row has 4 cells"),
        (json.dumps(SAMPLE).replace('"sha256": ""', '"sha256": null'), "only one of file and sha256"),
        (json.dumps(SAMPLE).replace("a.svg", "a.exe"), "neither SVG nor PNG"),
    ],
)
def test_a_spoilt_manifest_is_one_sentence(tmp_path: Path, text: str, complaint: str) -> None:
    """A manifest that can't be read is named, with what is wrong with it."""
    folder = spoilt(tmp_path / "old", text)
    with pytest.raises(AtlasError, match=complaint) as caught:
        read(folder)
    assert str(folder) in str(caught.value)
    assert "\n" not in str(caught.value)


def test_what_is_no_built_report_is_one_sentence(tmp_path: Path) -> None:
    """A folder that is not there, has no manifest, or is a file, is named."""
    (tmp_path / "empty").mkdir()
    (tmp_path / "atlas.pdf").write_text("")
    for name, reason in (
        ("nowhere", "No such file or directory"),
        ("empty", "No such file or directory"),
        ("atlas.pdf", "Not a directory"),
    ):
        with pytest.raises(AtlasError, match=f"{name} is not a built report.*: {reason}"):
            read(tmp_path / name)
