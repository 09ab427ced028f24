"""The table of letters: every letter of the atlas's prose and displays stands in it, each in one row."""

import re
from collections import Counter

import pytest

from atlas.paper import EQUATIONS
from atlas.report.blocks.equation import Equation
from atlas.report.load import load
from atlas.report.toml import find

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
    found = set()
    for bold, command, letter in re.findall(
        r"\\(?:mathbf|boldsymbol|mathbb)\s*\{\s*\\?([A-Za-z]+)\s*\}|\\([A-Za-z]+)|([A-Za-z])", tex
    ):
        if bold:
            found.add(f"bold {bold}")
        elif letter or GREEK.fullmatch(command.lower()):
            found.add(letter or command)
    return found


def rows() -> list[set[str]]:
    """Return the letters that each row explains: what stands before the sign of equality."""
    heads = ["".join(re.findall(r"\$([^$]+)\$", row[0])) for row in TABLE.rows]
    return [set().union(*(letters(item.partition("=")[0]) for item in head.split(r",\ "))) for head in heads]


def used() -> dict[str, str]:
    """Return each letter of the prose, the captions and the displays, with a formula that has it."""
    found: dict[str, str] = {}
    for block in BLOCKS:
        texts = [getattr(block, name, "") or "" for name in ("text", "caption")]
        formulas = [formula for text in texts for formula in re.findall(r"\$([^$]+)\$", text)]
        if isinstance(block, Equation):
            formulas.append(EQUATIONS[block.name].tex if block.name in EQUATIONS else block.tex)
        found |= {letter: formula for formula in formulas for letter in letters(formula)}
    return found


def test_every_letter_of_the_atlas_is_in_its_table() -> None:
    """No formula of a chapter has a letter that the table does not explain."""
    known = set().union(*rows()) | CONSTANTS
    assert {letter: formula for letter, formula in used().items() if letter not in known} == {}


def test_a_letter_has_one_row() -> None:
    """What has two meanings has them in one row, where both can be seen."""
    twice = {letter for letter, count in Counter(letter for row in rows() for letter in row).items() if count > 1}
    assert twice == set()


@pytest.mark.parametrize(
    ("tex", "found"),
    [
        (r"\dot{\mathbf{K}}=-[\boldsymbol{\Omega},\mathbf{K}]", {"bold K", "bold Omega"}),
        (r"\hat B_2\sin^2\vartheta\,e^{i\psi}", {"B", "vartheta", "e"}),
        (r"\text{for all } \nu_n", {"nu"}),
    ],
)
def test_letters_are_found_in_tex(tex: str, found: set[str]) -> None:
    """Functions and words are no letters, indices and exponents are left out."""
    assert letters(tex) == found
