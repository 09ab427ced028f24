"""A true form changed in one place, by a sign, a factor, an index or an exponent, is refuted, or it is true as well."""

import random

import pytest
from changes import changes

from atlas.paper import EQUATIONS
from atlas.proof import recorded
from atlas.proof.model import Model
from atlas.proof.run import trial
from atlas.proof.trial import Part

QUICK = [name for name in EQUATIONS if recorded.load()[name].seconds < 0.3]
SAMPLE = sorted(random.Random(1).sample(QUICK, 24))  # noqa: S311  a choice that is the same in every run


def letters(part: Part) -> frozenset[str]:
    """Return the names that the model of a part knows."""
    cases = part.model()
    return frozenset((cases if isinstance(cases, Model) else cases[0]).letters) | set(part.defines)


@pytest.mark.parametrize("name", SAMPLE)
def test_a_changed_form_is_refuted_or_true_as_well(name: str) -> None:
    """The trial finds a counterexample to each change, or proves it; it leaves none undecided."""
    for part in trial(name).true_parts:
        for line, what in changes(part.line, letters(part), most=6, seed=name):
            if part.outcome(line, sample_only=True).decision != "refuted":
                assert part.outcome(line).decision == "proved", (what, line)


def test_most_changes_are_refuted() -> None:
    """Nine of ten at least: a trial that never says no proves nothing."""
    tried = refuted = 0
    for name in SAMPLE:
        for part in trial(name).true_parts:
            for line, _ in changes(part.line, letters(part), most=2, seed=name):
                tried += 1
                refuted += part.outcome(line, sample_only=True).decision == "refuted"
    assert tried > 40
    assert refuted >= 0.9 * tried


def test_changes_are_of_one_sign_coefficient_index_or_exponent() -> None:
    """Every kind occurs, each line differs from the first, and the choice is the same in every run."""
    line = "d(K1) = Omega3*K2 - 2*Omega2^2*R[i,j]/K3"
    known = frozenset({"K1", "K2", "K3", "Omega2", "Omega3", "R"})
    found = changes(line, known, most=1000)
    assert {"sign", "term", "coefficient", "number", "index", "exponent"} <= {what for _, what in found}
    texts = [text for text, _ in found]
    assert len(set(texts)) == len(texts)
    assert "d(K1) = Omega3 * K2 + 2 * Omega2 ^ 2 * R[i, j] / K3" in texts
    assert "d(K2) = Omega3 * K2 - 2 * Omega2 ^ 2 * R[i, j] / K3" in texts
