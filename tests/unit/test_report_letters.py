"""Plain letters become formulas, labels become citations, words stay words."""

import pytest

from atlas.paper import EQUATIONS
from atlas.proof import record
from atlas.report.letters import typeset

CASES = {
    "I > 1: a cone, mf62": "$I > 1$: a cone, @mf62",
    "omega2 differs from -B'2": r"$\omega_{2}$ differs from $-B'_{2}$",
    "B' = (0, B'2, B'3) with B'2 > 0, B'3 > 0": (
        r"$\mathbf{B}' = (0, B'_{2}, B'_{3})$ with $B'_{2} > 0$, $B'_{3} > 0$"
    ),
    "A vector orthogonal to B": r"A vector orthogonal to $\mathbf{B}$",
    "A is any matrix": "$A$ is any matrix",
    "A 1 stands for I.": "A 1 stands for $I$.",
    "a cone a = 1": "a cone $a = 1$",
    "1 < I <= 2": r"$1 < I \le  2$",
    "k = omega2/hat B2, phi of mf77": r"$k = \omega_{2}/\hat{B}_{2}$, $\phi$ of @mf77",
    "omega1 = ±sqrt(1-I) B'2 with any omega3": r"$\omega_{1} = \pm \sqrt{1-I} B'_{2}$ with any $\omega_{3}$",
    "I differs from 1, omega2 from 0": r"$I$ differs from 1, $\omega_{2}$ from 0",
    "Rodrigues' formula doesn't fail, see theorem-ball-rest.": (
        "Rodrigues' formula doesn't fail, see @theorem-ball-rest."
    ),
    "the charge-to-mass ratio mu": r"the charge-to-mass ratio $\mu$",
    "the action 1.6, varied": "the action @1.6, varied",
}


@pytest.mark.parametrize("plain", CASES)
def test_letters_are_told_from_words(plain: str) -> None:
    """A run of letters, numbers and signs is one formula."""
    assert typeset(plain) == CASES[plain]


def test_omega_is_the_angular_velocity_except_where_it_is_a_frequency() -> None:
    """In the appendix of the paper omega is the cyclotron frequency."""
    assert typeset("with omega = 0") == r"with $\boldsymbol{\omega} = 0$"
    assert typeset("with omega = 0", scalar_omega=True) == r"with $\omega = 0$"


def test_no_letter_of_the_ledger_or_of_the_trial_stays_plain() -> None:
    """Outside formulas no name of a Greek letter and no index is left."""
    texts = {text for entry in EQUATIONS.values() for text in (entry.says, *entry.assumptions)}
    texts |= {text for verdict in record.load().values() for text in (verdict.follows, verdict.note)}
    for text in texts:
        words = typeset(text).split("$")[::2]
        for word in " ".join(words).split():
            plain = word.strip(".,:;()")
            assert not plain.startswith(("omega", "Omega", "alpha", "phi", "hat(", "sqrt")), text
            assert plain.startswith("@") or "^" not in plain, text
        assert typeset(text).count("$") % 2 == 0
