r"""`atlas tex`: numbers by key with proven digits only, tables that fit their numbers, a paper."""

import re
import shutil
import subprocess
from decimal import Decimal
from pathlib import Path
from typing import Any

import pytest
from pypdf import PdfReader

from atlas.arithmetic.certified_digits import certified
from atlas.book.blocks.table import Cell, ColumnView, TableView
from atlas.book.building.composed import build_tex
from atlas.book.building.report import build_report
from atlas.book.latex import _numbers, _with_unit, table_of
from atlas.errors import AtlasError
from atlas.motions.elementary.certified import ElementaryMotion as Balls

REPORT = r"""
name = "small"
title = "Numbers & Figures for r^2, $\\nu\\in\\mathbb{R}$ and a~b"
authors = ["A. Author"]
abstract = "One body, $I=3/2$; see @fig:curves."
bibliography = "references.bib"
[parameters]
bodies.short = { title = "A short solenoid", ratio = 1.5 }
fields.up = { title = "up", prime = [1.0, 2.0] }
sets.one = { omega2 = 0.7 }
sets.two = { omega2 = 0.7, times = [0, 2.5] }
[[pages]]
slug = "index"
title = "Motions at x^2"
blocks = [
  { kind = "prose", text = '''
As in @clebsch1871, by @(72) in @tab:numbers: $k$ is @cell:numbers-3-3, 5 % off. A body of 1 µm:

- one
- two
''' },
  { kind = "equation", name = "(72)" },
  { kind = "equation", name = "longer", tex = "SUM" },
  { kind = "prose", text = "with eighteen terms, and" },
  { kind = "equation", name = "(71)" },
  { kind = "prose", text = "A new paragraph." },
  { kind = "table", table = "motion", id = "numbers", body = "short", field = "up", digits = 20, sets = ["one"] },
  { kind = "table", table = "samples", id = "samples", body = "short", field = "up", digits = 12, sets = ["two"] },
  { kind = "figure", recipe = "frequencies", id = "curves", parameters.ratio = 1.5 },
  { kind = "figure", recipe = "flight", id = "wide" },
  { kind = "bibliography" },
]
""".replace("SUM", " + ".join(f"c_{{{n}}}x^{{{n}}}" for n in range(18)))  # wider than the page, and less so at 9 points
WORK = """@article{clebsch1871, author = {Clebsch, Alfred}, title = {Ueber die Bewegung}, journal = {Math. Ann.},
  volume = {3}, year = {1871}}
"""
KEY = re.compile(r"\\atlasnumber\{([^}]+)\}\{(\d+)\}\{([^}]+)\}\{([^\n]*)\}")


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of a small report as LaTeX."""
    place = tmp_path_factory.mktemp("tex")
    (place / "small.toml").write_text(REPORT, encoding="utf-8")
    (place / "references.bib").write_text(WORK, encoding="utf-8")
    return build_tex(place / "small.toml", place / "out").parent


@pytest.fixture(scope="module")
def numbers(made: Path) -> dict[str, tuple[int, str, str]]:
    """Return the digits, the number and the unit of each key."""
    text = (made / "atlas-numbers.tex").read_text("utf-8")
    return {key: (int(digits), value, unit) for key, digits, value, unit in KEY.findall(text)}


def test_a_key_has_the_proven_digits_and_the_unit(numbers: dict[str, tuple[int, str, str]]) -> None:
    """K and phi are those of balls, to the last of the 20 digits; the unit is one that siunitx reads."""
    true = certified(lambda: {name: getattr(Balls(1.5, (1.0, 2.0), 0.7), name) for name in ("k", "phi")}, 30)
    for name in ("k", "phi"):
        digits, value, unit = numbers[f"numbers/{name}"]
        assert (digits, unit) == (20, "s^{-1}")
        assert abs(Decimal(value) - Decimal(true[name])) <= Decimal(1).scaleb(int(Decimal(value).as_tuple().exponent))
    assert numbers["samples/2/Omega1"][2] == "s^{-1}"
    assert numbers["samples/1/R_13"] == (99, "0", "")


def test_printed_numbers_of_tables_have_keys(made: Path, numbers: dict[str, tuple[int, str, str]]) -> None:
    """Every number of the two tables is there, and no other."""
    texts = [(made / "tables" / f"{name}.tex").read_text("utf-8") for name in ("numbers", "samples")]
    rows = [line for text in texts for line in text.partition(r"\midrule")[2].splitlines() if line.endswith(r"\\")]
    printed = [cell.strip() for row in rows for cell in row.removesuffix(r"\\").split("&")]
    numerals = [cell for cell in printed if re.fullmatch(r"-?\d[\d.]*(e-?\d+)?", cell)]
    assert sorted(numerals) == sorted(value for _, value, _ in numbers.values())


def test_words_formulas_and_citations_are_latex(made: Path) -> None:
    """Figures and tables are numbered where they stand, works cited by BibTeX, equations by their number.

    A sentence goes on after a displayed equation, with a small letter; another one begins a paragraph.
    """
    paper = (made / "paper.tex").read_text("utf-8")
    for piece in (
        r"\title{\texorpdfstring{Numbers \& Figures for r\^{}2, \(\nu\in\mathbb{R}\) and a\textasciitilde b}{Numbers",
        r"\section{Motions at x\^{}2}", r"\citet{clebsch1871}", r"Table~\ref{tab-numbers}", r"Figure~\ref{fig-curves}",
        r"by (72) in", r"5 \%", r"\atlasequation{(72)}{eq-72}", r"\input{tables/numbers}", r"\input{figures/curves}",
    ):  # fmt: skip
        assert piece in paper, piece
    assert re.search(r"[^\n]\nwith eighteen terms", paper)
    assert "\n\nA new paragraph." in paper
    assert "Clebsch" in (made / "references.bib").read_text("utf-8")
    figure = (made / "figures" / "curves.tex").read_text("utf-8")
    assert r"\label{fig-curves}" in figure
    assert (made / "figures" / "curves.pdf").read_bytes().startswith(b"%PDF")


@pytest.mark.parametrize(("name", "kind", "width"), [("curves", "figure", 86.0), ("wide", "figure*", 178.0)])
def test_a_figure_has_the_width_of_its_place_in_the_paper(made: Path, name: str, kind: str, width: float) -> None:
    """A column or both, and put there at the size it has: LaTeX scales nothing."""
    text = (made / "figures" / f"{name}.tex").read_text("utf-8")
    assert f"\\begin{{{kind}}}" in text
    assert f"\\includegraphics{{figures/{name}.pdf}}" in text
    (page,) = PdfReader(made / "figures" / f"{name}.pdf").pages
    assert float(page.mediabox.width) * 25.4 / 72.0 == pytest.approx(width, abs=0.01)


@pytest.mark.parametrize(
    ("number", "unit", "expected"),
    [
        ("1.5", "s$^{-1}$", ("1.5", "s^{-1}")),
        ("9.3", "kg m$^2$", ("9.3", "kg.m^2")),
        ("2.5", "$10^{-6}$ m", ("2.5e-6", "m")),
        ("2.5", "1", ("2.5", "")),
    ],
)
def test_units_agree_with_siunitx(number: str, unit: str, expected: tuple[str, str]) -> None:
    """A power of ten before a unit goes to the number; units are parted by points."""
    assert _with_unit(number, unit) == expected


LATEX, TO_TEXT, FIND = (shutil.which(name) or "" for name in ("pdflatex", "pdftotext", "kpsewhich"))
REVTEX = FIND and subprocess.run([FIND, "revtex4-2.cls", "siunitx.sty"], capture_output=True, text=True, check=False)
needs_latex = pytest.mark.skipif(
    not (LATEX and TO_TEXT and REVTEX and REVTEX.stdout.count("\n") == 2),
    reason="LaTeX with REVTeX and siunitx, and pdftotext, are not there",
)


def compiled(folder: Path, file: str) -> tuple[int, str, str]:
    """Compile a file; return the status, the log, and the words of the PDF."""
    options: dict[str, Any] = {"cwd": folder, "capture_output": True, "text": True, "errors": "replace"}
    done = subprocess.run([LATEX, "-interaction=nonstopmode", file], check=False, timeout=120, **options)
    words = subprocess.run([TO_TEXT, Path(file).with_suffix(".pdf").name, "-"], check=False, **options)
    return done.returncode, done.stdout, words.stdout


@pytest.mark.slow
@needs_latex
def test_the_paper_compiles(made: Path, numbers: dict[str, tuple[int, str, str]]) -> None:
    """REVTeX sets it without an error, a line that is too wide or a letter of pixels, and prints the numbers."""
    status, log, text = compiled(made, "paper.tex")
    assert status == 0, log[-2000:]
    assert "Overfull \\hbox" not in log
    assert "Float too large" not in log
    pages = PdfReader(made / "paper.pdf").pages
    kinds = {font["/Subtype"] for page in pages for font in page["/Resources"].get("/Font", {}).values()}
    assert kinds == {"/Type1"}
    assert numbers["numbers/k"][1] in re.sub(r"[\s\u2009\u202f]", "", text).replace("\N{MINUS SIGN}", "-")


@pytest.mark.slow
@needs_latex
def test_latex_rounds_a_number_and_refuses_more_than_is_proven(
    made: Path, numbers: dict[str, tuple[int, str, str]]
) -> None:
    """Three figures are printed of k; 21 are an error that names the key, and so is a key that is not there."""
    head = "\\documentclass{article}\\usepackage{siunitx}\\input{atlas-numbers}\\begin{document}"
    (made / "three.tex").write_text(rf"{head}\atlas[3]{{numbers/k}}\end{{document}}", encoding="utf-8")
    status, log, text = compiled(made, "three.tex")
    assert status == 0, log[-2000:]
    assert f"{float(numbers['numbers/k'][1]):.3g}" in text
    for words, reason in (
        (r"\atlas[21]{numbers/k}", "numbers/k has 20 proven digits, not 21"),
        (r"\atlas{numbers/K}", "there is no number numbers/K"),
    ):
        (made / "wrong.tex").write_text(rf"{head}{words}\end{{document}}", encoding="utf-8")
        status, log, _ = compiled(made, "wrong.tex")
        assert status != 0
        assert reason in log.replace("\n", "")


@pytest.mark.slow
@needs_latex
def test_the_report_of_a_page_has_keys_by_the_names_in_python(tmp_path: Path) -> None:
    """LaTeX prints such a number with its unit; a float that is not certified has no key."""
    blocks = "".join(
        f'[[pages.blocks]]\nkind = "table"\ntable = "properties"\nid = "{family}"\nbody = "b"\nfield = "f"\n'
        f'parameters = {{ family = "{family}", {parameters} }}\n'
        for family, parameters in (("general", "omega = [0.3, 0.7, 0.2]"), ("hyperbola", "given = false"))
    )
    text = f"""name = "own"
title = "Own"
parameters = {{ bodies.b = {{ title = "b", ratio = 1.5 }}, fields.f = {{ title = "f", prime = [1.0, 2.0] }} }}
[[pages]]
slug = "index"
title = "Own"
{blocks}"""
    (tmp_path / "own.toml").write_text(text, encoding="utf-8")
    folder = build_tex(tmp_path / "own.toml", tmp_path / "out").parent
    keys = {
        key: (value, unit) for key, _, value, unit in KEY.findall((folder / "atlas-numbers.tex").read_text("utf-8"))
    }
    assert {unit for _, unit in keys.values()} == {"", "rad", "time", "time^{-1}", "time^{-2}"}
    assert {"general/roots_0", "general/period", "hyperbola/pole"} < set(keys)
    assert "hyperbola/least_stability" in keys
    head = "\\documentclass{article}\\usepackage{siunitx}\\input{atlas-numbers}\\begin{document}"
    (folder / "all.tex").write_text(head + " ".join(rf"\atlas{{{key}}}" for key in keys) + r"\end{document}", "utf-8")
    status, log, printed = compiled(folder, "all.tex")
    assert status == 0, log[-2000:]
    assert keys["general/period"][0].replace(" ", "") in re.sub(r"[\s\u2009\u202f]", "", printed)


@pytest.mark.parametrize(
    "formula",
    [
        r"\input{/etc/passwd}",
        "x^",
        *(pytest.param(tex, marks=pytest.mark.slow) for tex in (r"\write18{ls}", r"\frac{\frac{a}{b}}{c}")),
    ],
)
def test_a_formula_that_pages_refuse_is_refused_here(formula: str, tmp_path: Path) -> None:
    """One rule for a report's formulas: none comes into the paper that the pages and the PDF would not take."""
    file = tmp_path / "own.toml"
    page = f"[[pages]]\nslug = 'index'\ntitle = 'Own'\nblocks = [{{ kind = 'prose', text = '${formula}$' }}]\n"
    file.write_text(f"name = 'own'\ntitle = 'Own'\n{page}", encoding="utf-8")
    messages = set()
    for make in (build_report, build_tex):
        with pytest.raises(AtlasError, match=r"block 1 \(prose\): ") as refused:
            make(file, tmp_path / "out")
        messages.add(str(refused.value))
    assert len(messages) == 1


@pytest.mark.parametrize(
    ("letters", "count", "says"),
    [
        ((20, 22), 1, r"{table}"),  # 46 letters with two between columns: in a column of the page, and no more
        ((20, 23), 1, r"\begin{table}[!htb]"),  # 84 letters do where it is made smaller
        ((20, 23), 1, r"\resizebox"),
        ((39, 41), 1, r"{table}"),
        ((39, 42), 1, r"{table*}"),
        ((26, 26, 27), 1, r"{table*}"),
        ((20, 91), 1, r"{tabular}{ll}"),  # 115 letters fit across the page
        ((20, 92), 1, r"{tabular}{l>{\raggedright\arraybackslash}p{0.81\textwidth}}"),
        ((28,) * 5, 1, r"{tabular}{lllll}"),  # short words stay whole, of longer ones some are left, 24 letters
        ((28, 28, 28, 28, 29), 1, r"{tabular}{llll>{\raggedright\arraybackslash}p{0.21\textwidth}}"),
        ((20, 20), 60, r"\begin{table}"),
        ((20, 20), 61, r"\begin{longtable*}"),
        ((20, 2 * 92 - 1), 31, r"\begin{longtable*}"),  # two lines each
    ],
)
def test_a_table_is_as_wide_and_as_high_as_its_words(letters: tuple[int, ...], count: int, says: str) -> None:
    """In a column of the page, across both or over several pages, with words broken where they do not fit."""
    texts = ["Head", *("x" * number for number in letters)]
    columns = tuple(ColumnView(0, None, numeric=False, before=0.0, after=0.0) for _ in letters)
    rows = tuple(tuple(Cell(n) for n in range(1, len(texts))) for _ in range(count))
    assert says in table_of(TableView(1, "tab-x", columns, rows, 0, 0, None, "x"), texts, texts)


@pytest.mark.slow
@needs_latex
def test_a_table_higher_than_a_page_continues_on_the_next(made: Path) -> None:
    """All its rows are printed, with the heads again on the second page; a lower one stays in one piece."""
    column = ColumnView(0, None, numeric=False, before=0.0, after=0.0)
    words = "words that are broken into several lines, " * 4

    def of(count: int) -> str:
        rows = tuple((Cell(2 + n), Cell(1)) for n in range(count))
        return table_of(TableView(1, "tab-high", (column, column), rows, 0, 0, None, "high"), texts, texts)

    texts = ["Head", words, *(f"row{n}." for n in range(40))]
    assert r"\begin{table*}" in of(20)
    (made / "high.tex").write_text(of(40), encoding="utf-8")
    paper = (made / "paper.tex").read_text("utf-8").replace(r"\input{figures/wide}", r"\input{high}")
    (made / "longer.tex").write_text(paper, encoding="utf-8")
    status, log, text = compiled(made, "longer.tex")
    assert status == 0, log[-2000:]
    assert "Float too large" not in log
    assert {f"row{n}." for n in range(40)} <= set(text.split())
    assert text.count("Head") >= 4


def test_a_number_that_is_not_proven_has_no_key() -> None:
    """Of two numbers of a column only the proven one can be printed by its key."""
    cells = [(Cell(None, "1", ".5"),), (Cell(None, "2", ".5", "", proven=False),)]
    table = TableView(
        1, "tab-x", (ColumnView(0, None, numeric=True, before=0.0, after=0.0),), tuple(cells), 0, 0, None, "x"
    )
    assert [entry.value for entry in _numbers(table, ["k"])] == ["1.5"]
