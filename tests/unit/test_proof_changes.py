r"""A formula of the ledger changed in one place, by a sign, a number, a letter or an index, is not proved."""

import random
from dataclasses import replace
from functools import cache

import pytest
from changes import changes
from rewritings import rewritings

from atlas.trial.ledger import EQUATIONS
from atlas.trial.proofs import recorded, tex
from atlas.trial.proofs.run import trial

COUNT = 40


@cache
def sample() -> list[str]:
    """Return names of formulas that are proved quickly, COUNT of them, each by its own number, whatever the others."""
    quick = [name for name, verdict in recorded.load().items() if verdict.seconds < 0.5 and verdict.verdict == "proved"]
    return sorted(quick, key=lambda name: random.Random(name).random())[:COUNT]  # noqa: S311  same in every run


@pytest.mark.parametrize("place", [pytest.param(k, marks=[pytest.mark.slow] * (k % 2)) for k in range(COUNT)])
def test_a_changed_formula_is_refuted_or_unreadable(place: int) -> None:
    """The trial reads the TeX that is shown: none of its signs can be changed and the verdict stay."""
    name = sample()[place]
    case = trial(name)
    for form, change in changes(EQUATIONS[name].tex, most=8, seed=name):
        assert replace(case, tex=form).of_printed().decision != "proved", (name, change)


@pytest.mark.parametrize("place", range(0, COUNT, 3))
def test_a_rewritten_formula_is_refuted_or_unreadable(place: int) -> None:
    """Letters exchanged, a term dropped, another bracket, a lost dot or prime: other mistakes are noticed too."""
    name = sample()[place]
    case = trial(name)
    for form, change in rewritings(EQUATIONS[name].tex, most=5, seed=name):
        assert replace(case, tex=form).of_printed().decision != "proved", (name, change)


@pytest.mark.parametrize(
    ("name", "term", "term_changed"),
    [
        ("theorem-bracket", r"\{K_i,K_j\}", r"\{K_i,K_i\}"),
        ("theorem-bracket", r"\{K_i,K_j\}", r"\{K_1,K_j\}"),
        ("theorem-involution", r"\{F,H\}", r"\{F,F\}"),
        ("text-electric-field", r"\ddot", r"\dot"),
        ("text-electric-field", r"\mathbf{x}}_N", r"\mathbf{x}}_2"),
        ("text-constraints", "=a", r"\ne a"),
        ("(8)", "x_N^i(0)", "x_N^i"),
        ("(37)", "=", r"\ne "),
        ("(72)", "-\\frac{B'_3}", "-\\frac{B_3}"),
        ("(16)", r"gR^T\mathbf{B}", "gR^TB"),
        ("(88)", r"=\text{const}", r"\ne\text{const}"),
        ("(88)", r"\mathbf{m}(t)", r"\mathbf{m}(2t)"),
        ("(95)", r"[\mathbf{y}_1,", r"[\mathbf{y},"),
        ("text-ball-parallel", "^T", ""),
        ("text-covariance", r"g'\mathbf{K}'", "g'K'"),
        ("theorem-quartic", "=Q", r"\ne Q"),
        ("theorem-every-top", r"q(\nu)", r"q(\kappa)"),
        ("theorem-band", r"\le0", r"\le1"),
        ("theorem-clebsch", r"\dot F", r"\ddot F"),
        ("theorem-sigma", r"\zeta(t+z_0)", r"\zeta(-t+z_0)"),
        ("text-initial-position", r"\mathbf{e}_2", r"\mathbf{e}_3"),  # a letter in the place of a vector
        ("theorem-companion-triple", r"1+4(1-I)b^2\nu_0^2t^2", "1"),  # a constant
        ("theorem-cusp", r"\implies", r"\iff"),
        ("theorem-cusp", r"\implies", r",\quad "),
        ("theorem-clebsch", r",\qquad\dot F", r"\iff\dot F"),
        ("theorem-closed", r"\iff k", r"\implies k"),
        ("theorem-closed", r",\qquad\varrho", r"\iff\varrho"),
        ("theorem-top-precession", r"\iff", r",\quad "),
        ("theorem-points", r"\iff", r"\implies"),
        ("text-ball-limit", r"\implies", r"\iff"),
    ],
)
def test_weakened_equations_are_not_proved(name: str, term: str, term_changed: str) -> None:
    """A bracket of something with itself, one index for all, a denied equation, a lost mark: none is proved."""
    assert term in EQUATIONS[name].tex
    trial_changed = replace(trial(name), tex=EQUATIONS[name].tex.replace(term, term_changed, 1))
    assert trial_changed.of_printed().decision not in {"proved", "definition"}


@pytest.mark.parametrize("name", [name for name, entry in EQUATIONS.items() if "\\iff" in entry.tex])
def test_an_equivalence_is_tried_in_both_directions(name: str) -> None:
    """A double arrow that is read has a line for the other direction, or a form of the line; another is named."""
    case = trial(name)
    double = [line for line in case.arrows.values() if line is not None]
    assert len(double) + sum("\\iff" in phrase for phrase in tex.unread_phrases(case.formula, case.signs)) == EQUATIONS[
        name
    ].tex.count("\\iff")
    assert all(line or case.form is not str for line in double)


def test_changes_are_of_one_sign_number_letter_or_index() -> None:
    """Every kind occurs, and each formula differs from the first."""
    formula = r"\dot K_1=\Omega_3 K_2-2\sin\phi t"
    changes_of = dict(changes(formula))
    assert {change.split()[1] for change in changes_of.values()} == {"sign", "number", "letter", "index", "function"}
    assert formula not in changes_of
    assert r"\dot K_1=\Omega_3 K_2+2\sin\phi t" in changes_of
    assert r"\dot K_1=\Omega_2 K_2-2\sin\phi t" in changes_of
