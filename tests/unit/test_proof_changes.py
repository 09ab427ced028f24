"""Mutants: each claim changed in one place at a time is noticed, or the reason why not is given."""

import pytest

from atlas.paper import EQUATIONS
from atlas.proof import record
from atlas.proof.changes import changes
from atlas.proof.run import try_mutants
from atlas.proof.survivors import REASONS

RECORDED = record.load_mutants()
AGAIN = [label for label, found in RECORDED.items() if found.seconds < 0.6][::10]


def test_every_claim_has_at_least_five_recorded_mutants() -> None:
    """All entries of the ledger, by the present proofs."""
    assert list(RECORDED) == list(EQUATIONS)
    assert [label for label, found in RECORDED.items() if found.tried < 5] == []
    assert record.stale(RECORDED) == []


def test_survivors_are_true_statements_and_explained() -> None:
    """A mutant that isn't refuted is proved to be true as well, and there is a reason."""
    for label, found in RECORDED.items():
        assert found.noticed + len(found.survivors) == found.tried
        assert all(decision == "proved" for _, _, decision in found.survivors), label
        assert bool(found.reason) == bool(found.survivors), label


def test_reasons_are_given_only_where_something_survives() -> None:
    """No reason outlives its survivors."""
    assert {label for label in REASONS if not RECORDED[label].survivors} == set()


@pytest.mark.parametrize("label", AGAIN)
def test_recorded_mutants_are_noticed_again(label: str) -> None:
    """The trial of the mutants, held now, ends as recorded."""
    found = try_mutants(label)
    assert (found.tried, found.noticed, found.survivors) == (
        RECORDED[label].tried,
        RECORDED[label].noticed,
        RECORDED[label].survivors,
    )


def test_changes_are_of_one_sign_coefficient_index_or_exponent() -> None:
    """Every kind occurs, each line differs from the first, and the choice is the same in every run."""
    line = "d(K1) = Omega3*K2 - 2*Omega2^2*R[i,j]/K3"
    letters = frozenset({"K1", "K2", "K3", "Omega2", "Omega3", "R"})
    found = changes(line, letters, most=1000)
    kinds = {what for _, what in found}
    assert {"sign", "term", "coefficient", "number", "index", "exponent"} <= kinds
    texts = [text for text, _ in found]
    assert len(set(texts)) == len(texts)
    assert "d(K1) = Omega3 * K2 + 2 * Omega2 ^ 2 * R[i, j] / K3" in texts
    assert "d(K1) = Omega3 * K2 - 2 * Omega2 ^ 2 * R[j, i] / K3" in texts
    assert "d(K1) = Omega3 * K2 - 2 * Omega2 ^ 3 * R[i, j] / K3" in texts
    assert "d(K2) = Omega3 * K2 - 2 * Omega2 ^ 2 * R[i, j] / K3" in texts
    assert changes(line, letters, most=7, seed="a") == changes(line, letters, most=7, seed="a")
    assert len(changes(line, letters, most=7, seed="a")) == 7


def test_changes_that_change_nothing_are_left_out() -> None:
    """The sign below a square or a cosine, and a factor of what equals 0."""
    texts = [text for text, _ in changes("x^2*cos(y) = z; d(x*y) = 0", frozenset({"x", "y", "z"}), most=1000)]
    assert not any("(-x) ^ 2" in text or "cos(-y)" in text or "d(2 * (x * y))" in text for text in texts)
    assert any("x ^ 3" in text for text in texts)
