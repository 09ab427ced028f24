"""The texts of the ledger and of the trial: TeX and citations as a report reads them, plain Unicode on a terminal."""

import json
import re

import pytest

from atlas.build.appendices import title
from atlas.families import FAMILIES
from atlas.paper import EQUATIONS
from atlas.paper.citation import cited
from atlas.paper.plain import plain
from atlas.places import folder
from atlas.proof import recorded

WORST = json.loads((folder("reports") / "data" / "worst_errors.json").read_text())["worst"]
TEXTS = [
    *(text for entry in EQUATIONS.values() for text in (entry.says, *entry.assumptions)),
    *(text for verdict in recorded.load().values() for text in (verdict.method, verdict.follows, verdict.note)),
    *(title(name) for one in FAMILIES.values() for name in one.promises),
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
    """What follows a sign of citation is the name of an entry."""
    names = [name for text in TEXTS for name in re.findall(r"@(\(\d+\)|[\w-]+)", text)]
    assert len(names) > 200
    assert set(names) <= set(EQUATIONS)


def test_nothing_of_a_text_is_lost_on_a_terminal() -> None:
    """No TeX is left, and every letter, digit and sign of a formula is still there."""
    for text in TEXTS:
        shown = plain(text)
        assert not re.search(r"[\\$@]", shown), text
        kept = re.sub(r"\\[A-Za-z]+|[@${}\\,\s]", "", text)
        assert [sign for sign in kept if sign not in shown] == [], text


@pytest.mark.parametrize(
    ("tex", "shown"),
    [
        (r"$\omega_2\ne-B'_2$, see @(71).", "ω_2≠-B'_2, see (71)."),
        (r"$[\mathbf{E}_\bot,\mathbf{B}]$", "[E_⊥,B]"),
        (r"$\operatorname{tr}(g)-g$, $\det R=1$, $e^{i\xi}$", "tr(g)-g, det R=1, e^{iξ}"),
    ],
)
def test_tex_is_shown_in_unicode(tex: str, shown: str) -> None:
    """Letters, relations and citations as one would type them."""
    assert plain(tex) == shown
