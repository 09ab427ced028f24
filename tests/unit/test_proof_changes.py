"""Mutants: each claim changed in one place at a time is noticed, or the reason why not is given."""

import pytest
from tests_support import stale

from atlas.paper import EQUATIONS
from atlas.proof import recorded
from atlas.proof.changes import changes
from atlas.proof.quick import Numbers
from atlas.proof.run import trial, try_mutants
from atlas.proof.unrefuted import REASONS, reason

RECORDED = recorded.load_mutants()
# statements of invariance and symmetry, in which there is little to change
SHORT = {
    "text-translation",
    "text-rotation-apart",
    "text-electric-field",
    "text-multipliers-symmetric",
    "text-ball-frame",
}
AGAIN = [name for name, found in RECORDED.items() if found.seconds < 0.6][::10]


def test_all_mutants_of_every_claim_are_recorded() -> None:
    """At least five for each entry of the ledger, all that the grammar yields, by the present proofs."""
    assert list(RECORDED) == list(EQUATIONS)
    assert [name for name, found in RECORDED.items() if found.tried < 5 and name not in SHORT] == []
    assert stale(RECORDED) == []
    every = sum(
        len(changes(part.line, frozenset(letters(part)) | set(part.defines)))
        for name in AGAIN
        for part in trial(name).true_parts
    )
    assert every == sum(RECORDED[name].tried for name in AGAIN)


def letters(part: object) -> set[str]:
    """Return the names that the model of a part knows."""
    cases = part.model()  # type: ignore[attr-defined]
    return set((cases[0] if isinstance(cases, tuple) else cases).letters)


def test_survivors_are_true_statements_and_explained() -> None:
    """A mutant that isn't refuted is proved to be true as well, and there is a reason for each."""
    for name, found in RECORDED.items():
        assert found.noticed + len(found.unrefuted) == found.tried
        assert all(decision == "proved" for _, _, decision in found.unrefuted), name
        assert [line for _, line, _ in found.unrefuted if not reason(name, line)] == [], name


def test_reasons_are_given_only_where_something_survives() -> None:
    """No reason stands for a change that is refuted."""
    used = {(name, reason(name, line)) for name, found in RECORDED.items() for _, line, _ in found.unrefuted}
    assert {(name, why) for name, cases in REASONS.items() for _, why in cases} == used


@pytest.mark.parametrize("name", AGAIN)
def test_recorded_mutants_are_noticed_again(name: str) -> None:
    """The trial of the mutants, held now, ends as recorded."""
    found = try_mutants(name, every=True)
    assert (found.tried, found.noticed, found.unrefuted) == (
        RECORDED[name].tried,
        RECORDED[name].noticed,
        RECORDED[name].unrefuted,
    )


@pytest.mark.parametrize("name", ["(38)", "(50)", "(16)", "(52)", "theorem-stable-short"])
def test_what_is_refuted_in_numbers_is_not_proved_in_symbols(name: str) -> None:
    """The quick trial at exact points refutes nothing that the full trial proves, and not the line itself."""
    for part in trial(name).true_parts:
        numbers = Numbers(part)
        assert not numbers.refute(part.line)
        for line, _ in changes(part.line, frozenset(letters(part)), most=12, seed=name):
            if numbers.refute(line):
                assert part.outcome(line).decision != "proved"


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
