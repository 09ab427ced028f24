"""The bound on the width of a formula holds for all that is set, so that nothing runs over the margin unmeasured."""

import json
import math
from collections.abc import Sequence
from random import Random
from typing import Any

import pytest
import typst
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from atlas.build.appendices import gather
from atlas.paper import EQUATIONS
from atlas.proof import record
from atlas.report import fonts, numbers, pdf, widths
from atlas.report.colophon import colophon
from atlas.report.compose import Document, compose
from atlas.report.formulas import Manuscript
from atlas.report.gallery import gallery
from atlas.report.load import find, load, names
from atlas.report.views import TableView

FACES = f"""#set text(font: "{pdf.TEXT_FONT}", size: 10pt, number-width: "tabular", fallback: false)
#show math.equation: set text(font: "{pdf.MATH_FONT}")
"""
PICTURE = "#let image(path, width: auto, ..more) = rect(width: width, height: 60mm)\n"


def query(source: str) -> list[Any]:
    """Return the values that a Typst source notes under <w>."""
    folders = sorted({str(path.parent) for path in map(fonts.source, fonts.FACES.values())})
    paths: Any = folders
    compiler = typst.Compiler(source.encode(), font_paths=paths, ignore_system_fonts=True)
    found: list[Any] = json.loads(compiler.query("<w>", field="value"))
    return found


def measured(texts: Sequence[str]) -> list[float]:
    """Measure pieces of Markdown as they are set, in ems."""
    manuscript = Manuscript()
    for text in texts:
        manuscript.add(text, "a test", inline=True)
    lines = (f"#metadata(measure([{one}]).width.pt() / 10)<w>" for one in manuscript.set("typst", lambda name, _: name))
    return query(FACES + "#context [\n" + "\n".join(lines) + "\n]")


def test_no_formula_of_the_ledger_is_wider_than_its_bound() -> None:
    """The bound holds for each entry and each corrected form, and is less than twice the width."""
    forms = [entry.tex for entry in EQUATIONS.values()]
    forms += [verdict.corrected_tex for verdict in record.load().values() if verdict.corrected_tex]
    for tex, width in zip(forms, measured([f"$${tex.strip()}$$" for tex in forms]), strict=True):
        assert width <= widths.formula(tex) < 2 * width, tex


LETTERS = (
    r"a b m w x z B M W I 0 1 7 \omega \Omega \mu \phi \lambda \bot \partial \nabla \infty \lvert\omega\rvert".split()
)
SIGNS = r"= + - < > , ; ( ] \equiv \ne \pm \le \in \times \implies \iff \quad \, \sum \int \ldots \sin".split()
ACCENTS = ["mathbf", "boldsymbol", "hat", "ddot", "bar", "mathrm", "mathbb"]
SHAPES = (
    r"\sqrt{%s}",
    r"\left(%s\right)",
    r"{%s}_{%s}^{%s}",
    r"\begin{pmatrix}%s&%s\\%s&%s\end{pmatrix}",
    r"\frac{%s}{%s}",
)


def made(random: Random, depth: int, shapes: Sequence[str] = SHAPES) -> str:
    """Make a formula up; below a fraction there is none, for that print does not have."""
    kind = random.randrange(4) if depth else 0
    if kind == 0:
        letter = rf"\{random.choice(ACCENTS)}{{{random.choice('mWxB')}}}"
        word = rf"\text{{{''.join(random.choices('abmwMWRi ,', k=8))}}}"
        return random.choice([random.choice(LETTERS), letter, word])
    if kind == 1:
        shape = random.choice(shapes)
        inside = shapes[:-1] if "frac" in shape else shapes
        return shape % tuple(made(random, depth - 1, inside) for _ in range(shape.count("%s")))
    parts = [random.choice(SIGNS) if random.random() < 0.4 else made(random, depth - 1, shapes) for _ in range(5)]
    return " ".join(parts)


@settings(max_examples=10, deadline=None, phases=[Phase.explicit, Phase.reuse, Phase.generate])
@given(st.integers(0, 2**32))
def test_no_formula_is_wider_than_its_bound(seed: int) -> None:
    """The bound holds for whatever is built of letters, signs, fractions, roots, indices and matrices."""
    random = Random(seed)  # noqa: S311  no secret
    forms = [made(random, 3) for _ in range(48)]
    lines = [tuple(made(random, 2) for _ in range(4)) for _ in range(12)]
    forms += [r"\begin{{aligned}}{}&={}\\{}&={}\end{{aligned}}".format(*four) for four in lines]
    for tex, width in zip(forms, measured([f"$${tex}$$" for tex in forms]), strict=True):
        assert width <= widths.formula(tex) < math.inf, tex


def test_no_line_is_wider_than_its_bound() -> None:
    """The bound holds for words with formulas and citations between them."""
    lines = [r"angle from $\mathbf{e}_2$ to $\mathbb{I}^{-1}\mathbf{B}'$", "WWW MMM mmm 12 345.678, (mf72)", "s$^{-1}$"]
    for text, width in zip(lines, measured(lines), strict=True):
        assert width <= widths.line(text), text
    assert widths.line("see @tab:points") == math.inf


TWICE = r"a+\begin{aligned}b&=c\end{aligned}"


@pytest.mark.parametrize(
    "tex", [r"\hspace{5cm}", r"a\xrightarrow{f}b", r"\unknown", r"\begin{pmatrix}a", r"\frac{a}", TWICE]
)
def test_what_is_not_known_has_no_bound(tex: str) -> None:
    """A macro that the bound does not know, a formula that breaks off, lines aligned in one: they are measured."""
    assert widths.formula(tex) == math.inf


@pytest.fixture(scope="module", params=names())
def document(request: pytest.FixtureRequest) -> Document:
    """Return a report as it is set, with stand-ins for its pictures."""
    report = load(find(request.param))
    wanted = gallery(report)
    for plate in wanted.values():
        plate.file = "x.svg"
    return compose(report, wanted, gather(report))


@pytest.fixture(scope="module")
def source(document: Document) -> str:
    """Return its Typst source, with frames in the place of the pictures."""
    document.set("typst")
    return PICTURE + pdf.source(document, colophon(document.report))


def test_what_is_set_unmeasured_finds_room(document: Document, source: str) -> None:
    """In every report, each table of numbers and each formula that is not measured is no wider than its room."""
    tables = [block for page in document.pages for block in page.blocks if isinstance(block, TableView) and block.name]
    computed = "".join(f'"{table.number}", ' for table in tables)
    for plain, condition, body, less in (
        ("if fits { made }", f"number in ({computed})", "made", "0pt"),
        ("if fits { body }", "true", "body", "0pt"),
        ("if fits {\n    place(right + horizon, tag)", "true", "formula", "2 * measure(tag).width"),
    ):
        assert source.count(plain) == 1
        note = f"[#metadata((measure({body}).width.pt(), (size.width - {less}).pt()))<w>]"
        noted = plain.replace("{", f"{{ if {condition} {{ layout(size => {note}) }}\n", 1)
        source = source.replace(plain, noted)
    found = query(source)
    assert len(found) > len(tables)
    assert [width for width, room in found if width > room] == []


def test_the_points_of_a_column_stand_below_one_another() -> None:
    """A digit, a point, a minus sign and a narrow space are as wide in print as the columns are reckoned with."""
    texts = ["7", ".", numbers.MINUS, ".123" + numbers.THIN + "456", numbers.MINUS + "10.25"]
    notes = "\n".join(f'#metadata(measure("{text}").width.pt() / 5)<w>' for text in texts)
    for text, width in zip(texts, query(FACES + f"#context [{notes}]"), strict=True):
        assert numbers.room(text, pdf.THIN_IN_PRINT) == pytest.approx(width, abs=0.01), text
