"""The ledger holds every equation of the paper, under the number that it has there."""

import json
import re
from collections import Counter

import pytest

from atlas.book.building.records import title
from atlas.errors import AtlasError
from atlas.motions.register import FAMILIES
from atlas.places import folder
from atlas.trial.ledger import EQUATIONS, equation, find
from atlas.trial.ledger.citation import cited
from atlas.trial.ledger.plain import plain
from atlas.trial.proofs import recorded

# Every equation label of the paper, in the paper's order; mf61 occurs twice there, mf47 twice in one equation.
LABELS = """
1.6 mf15 mf16 mf17 mf18 mf19 mf20 1.32 1.38 The.1 mf22 mf21 mf23 mf24 mf25 mf26 mf27 mf28 mf29
mf30.0 mf30 mf31 mf32 mf33 mf34 mf35 mf36 mf37 mf38 mf39 mf40
mf41.0 mf41 mf41.1 mf42 mf43 mf44 mf45 mf46 mf47 mf48 mf49 mf50 mf51 mf52 mf53 mf54 mf55 mf56 mf57 mf58.1 mf58 mf59
mf61a mf60 mf61b mf62 mf63
mf64 mf65 mf66 mf67 mf68 mf69 mf70 mf71 mf71.1 mf72 mf73 mf74 mf75 mf76 mf77 mf78 mf79 mf80 mf81 mf82 mf83 mf84 mf85
mf86 mf87 mf88 mf89 mf90 mf91 mf92 mf93
mf1 mf2 mf3 mf4 mf5 mf6 mf7 mf8 mf9 mf10 mf11 mf10.1 mf10.2 mf12 mf13 mf14
""".split()


NUMBERED = [label for label in LABELS if label != "mf23"]
TWICE = {"mf61a": "mf61", "mf61b": "mf61"}


def test_every_labelled_equation_of_the_paper_is_in_the_ledger() -> None:
    """No label is missing, and an entry without one is a claim in words or a theorem of our own."""
    aliases = [alias for entry in EQUATIONS.values() if (alias := entry.alias)]
    assert Counter(aliases) == Counter([*(TWICE.get(label, label) for label in LABELS), "Aff100"])
    unlabelled = [name for name, entry in EQUATIONS.items() if not entry.alias]
    assert all(name.startswith(("text-", "theorem-")) for name in unlabelled)


def test_equation_numbers_agree_with_the_printed_paper() -> None:
    r"""The numbered equations run from 1 to 104 in the paper's order; mf23 ends in \nonumber."""
    assert [name for name, entry in EQUATIONS.items() if entry.number is not None] == [f"({n})" for n in range(1, 105)]
    assert [EQUATIONS[f"({n})"].alias for n in range(1, 105)] == [TWICE.get(label, label) for label in NUMBERED]
    assert equation("mf23").number is None


@pytest.mark.parametrize("name", EQUATIONS)
def test_an_entry_is_described_in_one_line(name: str) -> None:
    """Every field is filled, no sentence runs over a line, none ends in a stop."""
    entry = equation(name)
    assert entry.name == name
    assert entry.kind in {"definition", "derivation step", "claim", "theorem"}
    assert entry.section in {"II", "III", "IV", "V", "VII", "Atlas"}
    assert (entry.kind == "theorem") == (entry.section == "Atlas") == name.startswith("theorem-")
    for words in (entry.says, *entry.assumptions):
        assert words
        assert "\n" not in words
        assert not words.endswith(".")


@pytest.mark.parametrize("word", ["72", "(72)", "mf77"])
def test_an_equation_is_found_by_its_number_and_by_its_label(word: str) -> None:
    """The printed number with and without brackets, and the label of the source, mean one entry."""
    assert equation(word) is EQUATIONS["(72)"]
    assert find(word) == (EQUATIONS["(72)"],)


@pytest.mark.parametrize(("word", "label"), [("A1", "mf1"), ("(A15)", "mf13"), ("A16", "mf14")])
def test_an_equation_of_the_appendix_is_found_by_its_published_number(word: str, label: str) -> None:
    """The preprint of 26 March 2024 (preprints.org 202403.1313) cites the energy (103), mf13, as (A15)."""
    assert find(word) == (equation(label),)


def test_a_label_that_stands_twice_in_the_source_means_both_equations() -> None:
    """mf61 is on (53) and (55): both are found, and one alone cannot be meant."""
    assert [entry.name for entry in find("mf61")] == ["(53)", "(55)"]
    with pytest.raises(AtlasError, match=r"^mf61 is the label of \(53\) and of \(55\): say which\.$"):
        equation("mf61")


@pytest.mark.parametrize(
    ("word", "answer"),
    [
        ("mf77x", r"'mf77x' in the ledger \(did you mean 'mf77'\?\)"),
        ("theorem-pear", r"'theorem-pear' in the ledger \(did you mean 'theorem-pair'\?\)"),
        ("105", r"no equation \(105\) in the ledger; the nearest is \(104\)"),
        pytest.param("9" * 5000, r"no equation \(9+\) in the ledger; the nearest is \(104\)", id="5000 digits"),
        ("A17", "'A17' in the ledger"),
        ("(0)", r"no equation \(0\) in the ledger; the nearest is \(1\)"),
        ("\N{SUPERSCRIPT TWO}", "there is no equation"),
    ],
)
def test_a_misspelt_name_is_answered_with_the_nearest(word: str, answer: str) -> None:
    """An unknown number, name or label is an error that says the nearest one."""
    with pytest.raises(AtlasError, match=answer):
        find(word)


WORST = json.loads((folder("reports") / "data" / "worst_errors.json").read_text())["worst"]
TEXTS = [
    *(text for entry in EQUATIONS.values() for text in (entry.says, *entry.assumptions)),
    *(text for verdict in recorded.load().values() for text in (verdict.method, verdict.follows, verdict.note)),
    *(title(name) for family in FAMILIES.values() for name in family.promises),
    *(title(name) for pair in WORST.items() for name in (pair[0], pair[1][1])),
]
LETTER = re.compile(r"alpha|beta|gamma|lambda|omega|Omega|theta|tau|phi|psi|^sqrt|^hat|[A-Z]'?\d|[a-z]\d|[_^<>=]")


def test_no_letter_stands_outside_a_formula() -> None:
    """Outside dollar signs there is no name of a Greek letter, no index, no power, no relation and no bare label."""
    for text in TEXTS:
        words = re.sub(r"@(\(\d+\)|[\w-]+)", "", "".join(text.split("$")[::2]))
        assert text.count("$") % 2 == 0, text
        assert not [word for word in re.findall(r"[\w'^=<>]+", words) if LETTER.search(word)], text
        assert not cited(words), text


def test_every_citation_is_one_of_the_ledger() -> None:
    """After a sign of citation stands the name of an entry."""
    names = [name for text in TEXTS for name in re.findall(r"@(\(\d+\)|[\w-]+)", text)]
    assert len(names) > 200
    assert set(names) <= set(EQUATIONS)


@pytest.mark.slow
def test_nothing_of_a_text_is_lost_on_a_terminal() -> None:
    """No TeX is left, and every letter, digit and sign of a formula is still there."""
    for text in TEXTS:
        terminal_text = plain(text)
        assert not re.search(r"[\\$@]", terminal_text), text
        signs = re.sub(r"\\[A-Za-z]+|[@${}\\,\s]", "", text)
        assert [sign for sign in signs if sign not in terminal_text] == [], text


@pytest.mark.parametrize(
    ("tex", "unicode_text"),
    [
        (r"$\omega_2\ne-B'_2$, see @(71).", "ω_2≠-B'_2, see (71)."),
        (r"$[\mathbf{E}_\bot,\mathbf{B}]$", "[E_⊥,B]"),
        (r"$\operatorname{tr}(g)-g$, $\det R=1$, $e^{i\xi}$", "tr(g)-g, det R=1, e^{iξ}"),
    ],
)
def test_tex_is_shown_in_unicode(tex: str, unicode_text: str) -> None:
    """Letters, relations and citations as one would type them."""
    assert plain(tex) == unicode_text
