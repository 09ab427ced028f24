"""The letter on three different moments: a report that is whole, whose numbers are those of its data, into LaTeX."""

import re
from decimal import Decimal
from pathlib import Path

import numpy as np
import pytest
from scipy.special import ellipk

from atlas.arithmetic.certified_digits import certified
from atlas.book.blocks.figure import Figure
from atlas.book.blocks.table import Table
from atlas.book.building.composed import build_tex
from atlas.book.digits import Number
from atlas.book.files import find
from atlas.book.load import load
from atlas.book.tables import compute
from atlas.book.tables.table import Request
from atlas.motions.nutation.certified_elliptic import EllipticMotion
from atlas.motions.torus.approximate_periods import real_periods
from atlas.motions.torus.certified import AsymmetricMotion
from atlas.pictures import recipes

REPORT = load(find("three_moments"))
BLOCKS = [block for page in REPORT.pages for block in page.blocks]
DATA = [0.5, 1.0, 1.25], [0.5, 0.75, 0.5], [0.25, 0.5, 0.25]


def small(source: str) -> str:
    """Return the file of the report with the section of the family alone, without figures."""
    head, text = source.rsplit("+++\n", 1)
    head_text, *pages = re.split(r"(?m)^(?=# )", text)
    (kept,) = (page for page in pages if 'slug = "family"' in page)
    kept = re.sub(r"(?s)```\{figure\}\n.*?```\n", "", kept.replace('"family"', '"index"', 1))
    kept = kept.replace("@fig:family", "a figure")
    return f"{head}+++\n{head_text}{kept}\nHere $v=$ @cell:family-4-2, as @clebsch1871.\n\n```{{bibliography}}\n```\n"


def test_the_letter_uses_one_body_and_field_throughout() -> None:
    """Its figures are of recipes that are there; each table has the body and the field that the sentences speak of."""
    figures = [block for block in BLOCKS if isinstance(block, Figure)]
    assert figures
    assert {block.recipe for block in figures} <= set(recipes.names())
    tables = [block for block in BLOCKS if isinstance(block, Table)]
    bodies = [block.parameters.get("bodies", [block.parameters.get("inertia")])[0] for block in tables]
    assert bodies == len(tables) * [DATA[0]]
    fields = [block.parameters["field"] for block in tables if "field" in block.parameters]
    assert fields == 4 * [DATA[1]]


@pytest.mark.slow
@pytest.mark.parametrize("moment", [1.25, 1.125])
def test_a_number_changed_in_the_file_goes_through_to_the_paper(moment: float, tmp_path: Path) -> None:
    """The largest moment in the file: the keys have the digits of balls, and the sentence the number by its key."""
    source = find("three_moments")
    text = small(source.read_text("utf-8")).replace("1.25]", f"{moment}]")
    (tmp_path / "letter.md").write_text(text, encoding="utf-8")
    (tmp_path / "references.bib").write_bytes((source.parent / "references.bib").read_bytes())
    folder = build_tex(tmp_path / "letter.md", tmp_path / "out").parent
    numbers = dict(
        re.findall(r"\\atlasnumber\{([^}]+)\}\{\d+\}\{([^}]+)\}", (folder / "atlas-numbers.tex").read_text())
    )
    motion = EllipticMotion((0.5, 1.0, moment), DATA[1], -0.75, 1)
    true = certified(lambda: {"v": motion.v, "T": motion.period}, 20)
    for name in ("v", "T"):
        value = Decimal(numbers[f"family/4/{name}"])
        assert abs(value - Decimal(true[name])) <= Decimal(1).scaleb(int(value.as_tuple().exponent))
    paper, works = (folder / "paper.tex").read_text("utf-8"), (folder / "references.bib").read_text("utf-8")
    assert r"Here \(v=\) \atlas{family/4/v}, as \citet{clebsch1871}." in paper
    assert "title   = {{Ueber die Bewegung eines Körpers in einer Flüssigkeit}}," in works
    assert "archivePrefix = {arXiv}" in works
    assert re.findall(r"\\atlasequation\{(\(\w+\))\}", paper)[:2] == [
        "(1)",
        "(2)",
    ]  # no equation of the paper beside them
    assert re.search(r"exceed \\\(E_2b\^2\\\)\. Then\n\\atlasequations\{%\n\\atlasequation\{", paper)
    assert re.search(r"\n\nwith real|\n\\emph\{with real", paper).group() == "\n\\emph{with real"  # type: ignore[union-attr]


def test_the_rows_of_the_family_agree_with_the_formulas_of_the_letter() -> None:
    """v, omega, C/D^2 as the sum of squares, and T = 4 K(k)/lambda, 1e-9; who is stable."""
    (I, B, _), D = DATA, 0.625
    places = [[1.0, 1], [-0.25, -1], [-0.75, 1]]
    rows = compute("elliptic", Request((), {"inertia": I, "field": B, "places": places}, 12)).rows
    for (z, branch), row in zip(places, rows, strict=True):
        x = np.array([z + D / moment for moment in I])
        v = branch * np.sqrt(x.prod())
        E, square, twice = -v / (I * x), float(np.dot(B, B)), float(np.dot(B, -v / (I * x) * B))
        e = np.sort(E) if twice > np.median(E) * square else -np.sort(-E)
        rate = np.sqrt((e[2] - e[1]) * (twice - e[0] * square))
        modulus = (e[1] - e[0]) * (e[2] * square - twice) / rate**2
        C = np.sum(np.square(B) / x * (x * (x.sum() - x) - x.prod() / x) ** 2)
        true = [z, v, *((E - 1) * B), C / D**2, 4 * ellipk(modulus) / rate]
        numbers_found = [float(cell.digits) for cell in row if isinstance(cell, Number)]
        assert np.abs(np.array(numbers_found[:-1]) - true).max() <= 1e-9
        assert row[-1] == ("stable" if C > 0 else "unstable")


@pytest.mark.slow
def test_the_tables_of_the_letter_are_proven_to_the_last_digit() -> None:
    """The motion at t = 2 has the digits of balls; pairs of times found in another way are sums of these."""
    inertia, field, omega = DATA
    inputs = {"inertia": inertia, "field": field, "omega": omega}
    (row,) = compute("asymmetric", Request((), inputs | {"times": [2.0]}, 12)).rows
    exact = AsymmetricMotion(inertia, field, omega)
    true = certified(lambda: {str(i): x for i, x in enumerate(exact.column(3, 2.0))}, 20)
    for number, value in zip(row[1:4], true.values(), strict=True):
        assert isinstance(number, Number)
        assert number.proven
        assert abs(Decimal(number.digits) - Decimal(value)) <= Decimal(10) ** -12
    rows = compute("periods", Request((), inputs, 8)).rows
    values = np.array([[float(x.digits) for x in row[1:3] if isinstance(x, Number)] for row in rows])
    integers = np.linalg.solve(
        values.T, np.array([[float(x.mid()) for x in pair] for pair in real_periods(exact.invariants)]).T
    )
    assert np.abs(integers - np.round(integers)).max() <= 1e-6
