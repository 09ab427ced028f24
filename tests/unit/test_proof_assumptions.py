r"""Assumptions of an entry are held against the model of its trial: a changed definition or domain is noticed."""

import re
from dataclasses import replace

import pytest
from changes import changes

from atlas.trial.ledger import EQUATIONS
from atlas.trial.proofs import recorded
from atlas.trial.proofs import trial as trials
from atlas.trial.proofs.assumed import compare, formulas
from atlas.trial.proofs.run import trial

ANY = (r"\text{const}", r"\omega_0 = 0", "I_1 = I_2 = I_3")
"""In formulas whose letters are independent in the model, tried for all their values, or are all equal."""


OPPOSITE = {"<": ">", ">": "<", r"\le": r"\ge", r"\ge": r"\le", r"\ne": "=", "differs from": "is", "differ from": "is"}
DOMAIN = re.compile(r"<|>|\\(?:le|ge|ne)\b|differs? from")
TRUE_OUTSIDE = {
    *(("text-ball-parallel", clause) for clause in (r"$m_3>-\alpha I_0$ (the paper does not state this condition)",)),
    *((name, f"$B'_{n} > 0$") for name in ("text-beta", "theorem-stability", "theorem-stable-short") for n in (2, 3)),
    *((name, r"$\omega_2$ differs from 0") for name in ("(65)", "(78)", "(80)")),
    *((name, "$I$ differs from 1") for name in ("text-momentum-moves", "theorem-closed")),
    ("theorem-closed", "$k$ differs from 0"),
    ("theorem-points", "$B'_2$ differs from 0"),
    *(
        (name, rf"$I_{i}\ne I_{j}$")
        for name in ("theorem-involution", "theorem-critical")
        for i, j in ("12", "13", "23")
    ),
}
"""Domains outside which the tried line is true as well: other sentences of the entry need them."""


@pytest.mark.parametrize(
    ("name", "clause", "clause_changed"),
    [
        ("theorem-quadric-lines", "$0 < I < 1$", "$I > 1$"),
        ("theorem-band", "$0<I<1$", "$1<I<2$"),
        ("theorem-band", "$0<I<1$", "$0<I<2$"),
        ("theorem-edge", r"$I_1\le I_3$", r"$I_1\ge I_3$"),
        ("theorem-stable-short", r"$1\le I\le2$", r"$0\le I\le2$"),
        ("(42)", "differs from 0", "is 0"),
        ("(55)", r"$1 < I \le 2$", r"$0 < I \le 2$"),
        ("(57)", "$0 < I < 1$", "$0 < I < 2$"),
        ("(64)", r"differs from 0", "is 0"),
        ("(72)", "differs from", "is"),
        ("theorem-nutation", "$w$ differs from 0", "$w$ is 0"),
        ("theorem-identifiable", "(y_1,y_2,y_3)", "(y_1,y_3,y_2)"),
        ("theorem-unidentified", "J_2(J_1+J_3)", "J_2(J_1-J_3)"),
        ("theorem-every-top", r"J\boldsymbol{\Omega} + k", r"J\boldsymbol{\Omega} - k"),
        ("text-mass-matrix", "$I_1 = I_2$", "$I_1 = I_3$"),
        ("(53)", r"B'_3/(I B'_2)", r"B'_2/(I B'_3)"),
        ("theorem-every-top", "A_0 + k_3^2/I - k_2^2", "A_0 - k_3^2/I + k_2^2"),
        ("theorem-elliptic", "I_1 I_2 I_3$", "I_1 + I_2 + I_3$"),
        ("theorem-splitting", "I_1I_2+I_1I_3+I_2I_3", "I_1I_2+I_1I_3-I_2I_3"),
    ],
)
def test_a_changed_assumption_is_not_proved(
    name: str, clause: str, clause_changed: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A domain that the model does not cover, or a definition that it does not have, leaves the entry undecided."""
    entry = EQUATIONS[name]
    entry_changed = replace(
        entry, assumptions=tuple(words.replace(clause, clause_changed, 1) for words in entry.assumptions)
    )
    assert entry_changed != entry
    monkeypatch.setattr(trials, "EQUATIONS", {**EQUATIONS, name: entry_changed})
    assert trial(name).of_printed().decision == "undecided"


@pytest.mark.parametrize("name", [name for name, entry in EQUATIONS.items() if entry.assumptions])
def test_a_definition_that_is_changed_does_not_hold(name: str) -> None:
    """Each equation that is read and holds, changed by a sign, number, letter or index, holds no longer."""
    case = trial(name)
    models = trials._models_of((case.true_form or case).model)
    pairs = [pair for words in EQUATIONS[name].assumptions for pair in formulas(words)]
    for clause, formula in pairs:
        if "=" not in formula or any(mark in formula for mark in ANY):
            continue
        if compare([clause], case.signs, models, case.excluded).satisfied:
            for form, change in changes(formula, most=3, seed=name):
                again = compare([f"${form}$"], case.signs, models, case.excluded)
                assert again.broken or not again.satisfied, (formula, change)


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name, entry in EQUATIONS.items() if DOMAIN.search(str(entry.assumptions))])
def test_the_opposite_domain_is_not_proved(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each domain that is read, turned round, leaves the entry undecided, but where the claim is true there, too."""
    entry, unread = EQUATIONS[name], trial(name).assumed.unread
    clauses = [clause for words in entry.assumptions for clause, formula in formulas(words) if formula]
    for clause in clauses:
        if clause in unread or not DOMAIN.search(clause) or (name, clause) in TRUE_OUTSIDE:
            continue
        entry_changed = replace(entry, assumptions=(DOMAIN.sub(lambda mark: OPPOSITE[mark[0]], clause),))
        monkeypatch.setattr(trials, "EQUATIONS", {**EQUATIONS, name: entry_changed})
        case = trial(name)
        assert case.assumed.broken or case.of_printed().decision == "undecided", clause


@pytest.mark.slow
def test_unread_assumptions_are_recorded() -> None:
    """Clauses of an entry that are not held against its model stand in its record, and no others do."""
    for name, entry in EQUATIONS.items():
        unread = trial(name).assumed.unread
        assert recorded.load()[name].not_read == "; ".join(unread)
        assert set(unread) <= {clause for words in entry.assumptions for clause, _ in formulas(words)}
    assert r"$1 < I \le 2$" not in recorded.load()["(55)"].not_read


@pytest.mark.parametrize("name", [name for name, entry in EQUATIONS.items() if entry.outside])
def test_nothing_is_proved_in_the_false_domain_beside_an_entry(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """The false domain takes the place of an assumption, is read, and leaves the whole trial undecided."""
    entry = EQUATIONS[name]
    domain_true, domain_false = entry.outside
    false = replace(
        entry, assumptions=tuple(clause.replace(domain_true, domain_false) for clause in entry.assumptions), outside=()
    )
    assert recorded.load()[name].outside == trial(name).outside != ""
    monkeypatch.setattr(trials, "EQUATIONS", {**EQUATIONS, name: false})
    assert trial(name).of_printed().decision == "undecided"


def test_each_theorem_with_a_domain_has_a_false_domain_beside() -> None:
    """But for domains that are not read, and those outside which the line is true."""
    for name, entry in EQUATIONS.items():
        clauses = [clause for words in entry.assumptions for clause, formula in formulas(words) if formula]
        matter = [clause for clause in clauses if DOMAIN.search(clause) and (name, clause) not in TRUE_OUTSIDE]
        if entry.kind == "theorem" and not entry.outside:
            assert set(matter) <= {*trial(name).assumed.unread}, name


def test_a_false_domain_that_changes_nothing_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """A domain that no assumption has, or in which the proof holds as well, is no false domain."""
    for outside in (("$I > 7$", "$I < 7$"), ("$0<I<1$", "$0<I<1/2$"), ("$0<I<1$", "$I$ is small")):
        entry_changed = replace(EQUATIONS["theorem-band"], outside=outside)
        monkeypatch.setattr(trials, "EQUATIONS", {**EQUATIONS, "theorem-band": entry_changed})
        with pytest.raises(ValueError, match="changes nothing"):
            _ = trial("theorem-band").outside
