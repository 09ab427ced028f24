"""Formulas: one notation in, MathML and Typst out, and nothing lost on the way."""

import re
from collections import Counter
from xml.etree import ElementTree as ET

import pytest

from atlas.book.blocks.equation import Equation
from atlas.book.files import find
from atlas.book.load import load
from atlas.book.pandoc import Target, _upright
from atlas.book.texts import Link, Texts
from atlas.errors import AtlasError
from atlas.trial.ledger import EQUATIONS


def formula_in(tex: str, target: Target = "html") -> str:
    """Set one text."""
    texts = Texts()
    texts.add(tex, "here", inline=True)
    return texts.set({target: lambda name, _place: Link(name, "", name)})[target][0]


def test_every_equation_of_the_ledger_is_set_in_both_targets() -> None:
    """No formula of the paper stays behind as raw TeX, and none is lost."""
    texts = Texts()
    for name, entry in EQUATIONS.items():
        texts.add(f"$${entry.tex}$$", name)
    pages, print_ = texts.set(dict.fromkeys(("html", "typst"), lambda name, _place: Link(name))).values()
    assert len(pages) == len(print_) == len(EQUATIONS)
    for name, page, typst in zip(EQUATIONS, pages, print_, strict=True):
        assert page.count("<math") == 1, name
        assert not re.search(r"\\[a-z]|\$", page), name
        assert not re.search(r"\\[a-z]{2,}", typst), name


def test_a_formula_that_cannot_be_read_is_an_error_that_names_it() -> None:
    """An unknown command raises, with the formula and its place."""
    with pytest.raises(AtlasError, match=r"here: .*\\foo"):
        formula_in(r"$\foo{x}$")


@pytest.mark.parametrize(
    ("tex", "reason"),
    [
        (r"\frac{a", "it breaks off"),
        (r"\begin{pmatrix}a\end{matrix}+b", "unexpected .* at matrix"),
        (r"\frac{1}{2}+" * 80 + r"\foo", r"unexpected .*\\foo"),
    ],
)
def test_faults_of_a_formula_are_reported_in_a_line(tex: str, reason: str) -> None:
    """The message names the formula and the first thing that is wrong, in no more than 200 characters."""
    with pytest.raises(AtlasError, match=reason) as caught:
        formula_in(f"${tex}$")
    assert str(caught.value).startswith("here: the formula $")
    assert len(str(caught.value)) <= 200


def test_of_a_long_formula_a_message_shows_the_beginning_and_where_it_goes_wrong() -> None:
    """Ninety characters of it, with the mark of an omission, and twenty from the mistake on."""
    tail = "+b" * 60
    with pytest.raises(AtlasError) as caught:
        formula_in(rf"$\begin{{pmatrix}}a\end{{matrix}}{tail}$")
    match = re.fullmatch(r"here: the formula (.*) can't be read: unexpected .* at (.*)\.", str(caught.value))
    assert match
    assert (len(match[1]), match[1][-1], len(match[2])) == (90, "…", 20)


def test_a_fraction_below_a_fraction_is_refused_in_print() -> None:
    """Typst would read a/b/c from left to right, so the user is told."""
    with pytest.raises(AtlasError, match="slash"):
        formula_in(r"$\frac{a}{\frac{1}{2}}$", "typst")


def test_vectors_are_upright_and_primes_not_raised_twice() -> None:
    """B' is a bold upright letter with a prime beside it, before its index."""
    math = ET.fromstring(formula_in(r"$\mathbf{B}'_2$"))  # noqa: S314  our own output
    assert "".join(math.itertext()) == "\N{MATHEMATICAL BOLD CAPITAL B}\N{PRIME}2"
    assert math.find(".//msup") is None
    assert math.find(".//msubsup") is None


def test_bold_italic_letters_become_upright_and_no_others() -> None:
    """From A to z; Greek and script letters, which stand beside them in Unicode, stay."""
    assert "".join(map(_upright, "𝑨𝒁𝒂𝒛 𝑧𝒜𝜶")) == "𝐀𝐙𝐚𝐳 𝑧𝒜𝜶"


@pytest.mark.slow
def test_functions_have_their_spaces() -> None:
    """A thin space stands on both sides of sin in `a sin x`, and of ln, none before a bracket."""
    assert formula_in(r"$a\sin x$").count("mspace") == 4
    assert formula_in(r"$\sin(x)$").count("mspace") == 0
    assert formula_in(r"$\left[a\sin x\right]$").count("mspace") == 4
    assert formula_in(r"$\left[a\ln x\right]$").count("mspace") == 4
    assert formula_in(r"$(a)\sin x$").count("mspace") == 4
    assert formula_in(r"$(\sin x)$").count("mspace") == 2


def test_accents_do_not_stretch() -> None:
    """A hat is as wide as a hat."""
    math = ET.fromstring(formula_in(r"$\hat B$"))  # noqa: S314  our own output
    mark = math.find(".//mover/mo")
    assert mark is not None
    assert mark.get("stretchy") == "false"


def test_citations_become_links_but_not_in_code_or_formulas() -> None:
    """``@(67)`` is a link; in code it stays as it is."""
    html = formula_in("see @(50), `@(67)`")
    assert '<a href="#(50)">(50)</a>' in html
    assert "<code>@(67)</code>" in html


def test_thin_spaces_keep_their_width_in_print() -> None:
    r"""``\;`` is five eighteenths of an em, ``\!`` three eighteenths backwards."""
    typst = formula_in(r"$a\;b\!c$", "typst")
    assert "#h(0.278em)" in typst
    assert "#h(-0.167em)" in typst


def test_a_comma_stays_on_the_line_of_its_formula() -> None:
    """Signs that follow a formula in a sentence without a space stay with it; a display formula stands alone."""
    assert re.search(r'<span class="together"><math[^>]*>.*</math>,</span> and', formula_in("With $a$, and so on"))
    assert "together" not in formula_in("With $a$ and so on")
    assert "together" not in formula_in("$$a$$, and so on")


def test_units_and_brackets_stay_on_the_line_of_their_formula() -> None:
    """A unit keeps number and exponent, a bracket its formula, both the end of the clause; a word and a space don't."""
    assert re.fullmatch(
        '30\xa0<span class="together">s<math.*</math>,</span> and', formula_in("30 s$^{-1}$, and"), re.DOTALL
    )
    assert formula_in("($x$)").startswith('<span class="together">(<math')
    assert formula_in("a $x$").startswith("a <math")


REPORT = load(find("atlas"))
BLOCKS = [block for page in REPORT.pages if page.slug != "letters" for block in page.blocks]
(TABLE,) = (block for page in REPORT.pages if page.slug == "letters" for block in page.blocks)
GREEK = re.compile(
    r"(?:var)?(?:alpha|beta|gamma|delta|epsilon|zeta|eta|theta|kappa|lambda|mu|nu|xi|rho|sigma|tau|phi|chi|psi|omega|wp)"
)
CONSTANTS = {"d", "i", "epsilon"}  # a differential, the imaginary unit, the symbol of Levi-Civita


def letters(tex: str) -> set[str]:
    """Return the letters of a formula without their indices, exponents, hats and dots; a bold one is another."""
    tex = re.sub(r"\\(?:text|operatorname|mathrm|begin|end)\*?\{[^{}]*\}", " ", tex)
    tex = re.sub(r"[_^]\s*(?:\{(?:[^{}]|\{[^{}]*\})*\}|\\[a-zA-Z]+|.)", " ", tex)
    letters_found = set()
    for bold, command, letter in re.findall(
        r"\\(?:mathbf|boldsymbol|mathbb)\s*\{\s*\\?([A-Za-z]+)\s*\}|\\([A-Za-z]+)|([A-Za-z])", tex
    ):
        if bold:
            letters_found.add(f"bold {bold}")
        elif letter or GREEK.fullmatch(command.lower()):
            letters_found.add(letter or command)
    return letters_found


def rows() -> list[set[str]]:
    """Return the letters that each row explains: those before the sign of equality."""
    heads = ["".join(re.findall(r"\$([^$]+)\$", row[0])) for row in TABLE.rows]
    return [set().union(*(letters(item.partition("=")[0]) for item in head.split(r",\ "))) for head in heads]


def used() -> dict[str, str]:
    """Return each letter of the prose, the captions and the displays, with a formula that has it."""
    letters_used: dict[str, str] = {}
    for block in BLOCKS:
        texts = [getattr(block, name, "") or "" for name in ("text", "caption")]
        formulas = [formula for text in texts for formula in re.findall(r"\$([^$]+)\$", text)]
        if isinstance(block, Equation):
            formulas.append(EQUATIONS[block.name].tex if block.name in EQUATIONS else block.tex)
        letters_used |= {letter: formula for formula in formulas for letter in letters(formula)}
    return letters_used


def test_every_letter_of_the_atlas_is_in_its_table() -> None:
    """No formula of a chapter has a letter that the table does not explain."""
    letters_known = set().union(*rows()) | CONSTANTS
    assert {letter: formula for letter, formula in used().items() if letter not in letters_known} == {}


def test_a_letter_has_one_row() -> None:
    """A letter with two meanings has them in one row, where both can be seen."""
    twice = {letter for letter, count in Counter(letter for row in rows() for letter in row).items() if count > 1}
    assert twice == set()


@pytest.mark.parametrize(
    ("tex", "letters_expected"),
    [
        (r"\dot{\mathbf{K}}=-[\boldsymbol{\Omega},\mathbf{K}]", {"bold K", "bold Omega"}),
        (r"\hat B_2\sin^2\vartheta\,e^{i\psi}", {"B", "vartheta", "e"}),
        (r"\text{for all } \nu_n", {"nu"}),
    ],
)
def test_letters_are_found_in_tex(tex: str, letters_expected: set[str]) -> None:
    """Functions and words are no letters, indices and exponents are left out."""
    assert letters(tex) == letters_expected


INDENTED, FLUSH = "#leading(true)[", "#leading(false)["


@pytest.mark.parametrize(
    ("markdown", "begins"),
    [
        ("A line:\n\n    code", FLUSH),
        ("One.\n\nTwo\nlines:\n\n    code", INDENTED),
        ("```\ncode\n```\n\nAgain:", FLUSH),
        ("One.\n\nTwo.", ""),
        ("A: b `c:`", ""),
        ("- a list:", ""),
    ],
)
def test_a_paragraph_that_ends_with_a_colon_is_kept_with_the_next(markdown: str, begins: str) -> None:
    """Indented where a paragraph stands before it, in a PDF only; its words are the same."""
    texts = Texts()
    texts.add(markdown, "here")
    cites = dict.fromkeys(("typst", "html"), lambda _name, _place: pytest.fail("nothing is cited"))
    (typst,), (html,) = texts.set(cites).values()
    assert [begin for begin in (INDENTED, FLUSH) if begin in typst] == [begins] * bool(begins)
    assert "leading" not in html
