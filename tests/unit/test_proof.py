"""The trial of the equations: proved verdicts are proved again here, refuted ones refuted by hand."""

import re
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest
import sympy
from tests_support import stale

from atlas.book.building.cache import Cache
from atlas.trial.ledger import EQUATIONS, equation, topic
from atlas.trial.proofs import recorded, run, verify
from atlas.trial.proofs.decide import decide
from atlas.trial.proofs.identity import positive, vanishes
from atlas.trial.proofs.model import Model, hat, rotation
from atlas.trial.proofs.run import trial, trials, try_one
from atlas.trial.proofs.trial import Falsehood
from atlas.trial.proofs.verdict import GRADES, slips

RECORDED = recorded.load()
REFUTED = [name for name, verdict in RECORDED.items() if verdict.verdict == "refuted"]
# every sixth of the quickly decided entries, and in the stress run every second; the slips are tried below
QUICK = [name for name in RECORDED if RECORDED[name].seconds < 1][::2]
AGAIN = [pytest.param(name, marks=[pytest.mark.slow] * (k % 6 > 0)) for k, name in enumerate(QUICK)]
# slips that readers of the paper had found before; the trial must find them, and more
KNOWN_SLIPS = ["(48)", "(46)", "(100)", "text-parallel-acceleration", "(97)", "(98)", "(99)", "text-constant-omega3"]
KNOWN_SLIPS += ["text-momentum-plane", "text-cone-semi-axes", "(102)"]
NEW_SLIPS = [
    "(9)",
    "(6)",
    "text-force-matrix",
    "text-combining",
    "text-ball-body-precession",
    "text-ball-centre",
    "text-along-field",
    "(101)",
]
SLIPS = [
    pytest.param(name, marks=[pytest.mark.slow] * (k % 3 > 0))
    for k, name in enumerate(dict.fromkeys(KNOWN_SLIPS + NEW_SLIPS + REFUTED))
]
# true as far as they go, and not the whole truth
UNFINISHED = [name for name, verdict in RECORDED.items() if verdict.grade and verdict.verdict == "proved"]
DEFINITIONS = ["(1)", "(2)", "(7)", "(8)", "(10)", "(58)"]
IN_WORDS = [name for name, entry in EQUATIONS.items() if entry.number is None and name not in REFUTED]


@pytest.mark.slow
def test_every_entry_of_the_ledger_has_a_trial_and_a_recorded_verdict() -> None:
    """Each name is tried in the file of its topic, and nothing else is."""
    tried = [name for stem in {topic(name) for name in EQUATIONS} for name in trials(stem)]
    assert sorted(tried) == sorted(EQUATIONS)
    assert list(RECORDED) == list(EQUATIONS)
    for name in EQUATIONS:
        assert trial(name).name == name


def test_the_recorded_verdicts_agree_with_the_present_proofs() -> None:
    """No proof has changed since its verdict was recorded; `atlas verify` records anew."""
    assert stale(RECORDED) == []


@pytest.mark.parametrize("stem", sorted({topic(name) for name in EQUATIONS}))
def test_a_recorded_verdict_quotes_its_trial(stem: str) -> None:
    """Texts of a record that need no proof stand in the trial or in the ledger, word for word."""
    for name in trials(stem):
        entry, case = EQUATIONS[name], trial(name)
        lines = [
            "; ".join(line_of_case.line for line_of_case in lines_of_case)
            for lines_of_case in (case.parts, case.corrected_parts)
        ]
        assert RECORDED[name] == replace(
            RECORDED[name],
            name=name,
            number=entry.number,
            section=entry.section,
            kind=entry.kind,
            follows=entry.follows,
            printed=lines[0],
            corrected=lines[1],
            corrected_tex=case.corrected_tex,
            grade=equation(entry.slip or name).grade,
            slip=entry.slip,
            note=entry.note,
            false=entry.false,
            false_line=case.false_part.line if case.false else "",
        )


def test_every_verdict_is_sound() -> None:
    """Each entry is proved as printed, a definition, or refuted; each with an erratum has a form that is proved."""
    for name, verdict in RECORDED.items():
        decisions = "proved definition".split() + ["refuted"] * bool(verdict.grade)
        assert verdict.verdict in decisions, name
        assert not verdict.grade or verdict.corrected_verdict == "proved", name
        assert not verdict.false or verdict.false_verdict == "refuted", name


def test_definitions_are_not_called_proved() -> None:
    """These entries only define their letters."""
    assert [name for name, verdict in RECORDED.items() if verdict.verdict == "definition"] == DEFINITIONS


def test_a_counterexample_names_its_numbers_and_its_time() -> None:
    """At t = 0 the particle is at a e2 of its circle; the sign of the charge and the field along B are told."""
    for name in ("(99)", "(101)", "text-ball-centre"):
        counterexample = RECORDED[name].counterexample
        assert (counterexample["t"], counterexample["yperp"]) == ("0", f"[0, {counterexample['a']}, 0]")
        assert counterexample["left"] != counterexample["right"]
    assert RECORDED["text-along-field"].counterexample["mu"] == "-1"
    assert RECORDED["text-parallel-acceleration"].counterexample["Epar"] == "[0, 0, 0]"


def test_slips_are_graded_and_counted_once() -> None:
    """Every refuted entry has a grade, several may share one slip, and the grave grades come first."""
    graded = {name: verdict for name, verdict in RECORDED.items() if verdict.grade}
    assert set(graded) == {*REFUTED, *UNFINISHED}
    assert all(graded[verdict.slip].slip == "" for verdict in graded.values() if verdict.slip)
    counts = slips(RECORDED.values())
    assert tuple(counts) == GRADES
    assert {grade: len(names) for grade, names in counts.items()} == {
        "sign of the charge": 1,
        "gap in the argument": 1,
        "missing case": 11,
        "misprint": 9,
        "wording": 7,
    }
    signs = {"(98)", "(99)", "(101)", "text-drift", "text-ball-centre", "text-along-field"}
    assert {name for name, verdict in graded.items() if verdict.slip == "(97)"} == signs


def test_an_exception_that_the_paper_does_not_state_leaves_a_claim_proved() -> None:
    """One policy for all: proved where it has a meaning, a missing case, and the whole form is proved."""
    names_missing = {name for name, verdict in RECORDED.items() if verdict.grade == "missing case"}
    assert {"(29)", "(42)", "(45)", "(52)", "(78)", "(83)", "text-rigid", "text-cubic-degree"} <= names_missing
    assert names_missing == {*UNFINISHED} - {"(5)"}


def test_every_claim_in_words_has_a_false_sentence_beside_it() -> None:
    """The trial refutes a false sentence near each claim, so it can fail; a claim refuted as printed has shown it."""
    assert [name for name in IN_WORDS if RECORDED[name].false_verdict != "refuted"] == []
    assert [name for name in IN_WORDS if not RECORDED[name].false] == []


@pytest.mark.slow
def test_a_trial_that_cannot_fail_is_found_out() -> None:
    """That the masses balance says nothing of the electric field: with unequal charges the trial must say no."""
    electric = trial("text-electric-field")
    assert electric.false_part.outcome(sample_only=True).decision == "refuted"
    vacuous = replace(electric, form=lambda _: "0 = m[N]*(dx[N] - dx[N])")
    assert vacuous.of_printed().decision == "proved"
    assert vacuous.false_part.outcome(sample_only=True).decision == "supported"


def test_a_false_sentence_that_changes_nothing_is_refused() -> None:
    """It must change the words of the claim, or say them of something else."""
    with pytest.raises(ValueError, match="not there"):
        _ = replace(trial("text-beta"), false=Falsehood("B3/(I*B4)", "B3")).false_part
    for false in (None, Falsehood()):
        with pytest.raises(ValueError, match="no false sentence"):
            _ = replace(trial("text-beta"), false=false).false_part


@pytest.mark.parametrize("name", [*REFUTED, *UNFINISHED])
def test_the_shown_correction_marks_the_changes(name: str) -> None:
    """Something is marked, but not all of it."""
    tex = RECORDED[name].corrected_tex
    assert r"\boxed{" in tex
    depth, remaining = 0, ""
    for piece in re.split(r"(\\boxed\{|\{|\})", tex):
        opens = piece.endswith("{") and (depth or piece != "{")
        depth += opens - bool(depth and piece == "}")
        remaining += "" if depth else piece
    assert len(remaining) > 4


def test_incomplete_equations_are_true_and_their_complete_form_is_proved() -> None:
    """(52), (71) leave out lines, each point of which is a solution, (29) a point; (5) has a letter without meaning."""
    assert {"(5)", "(29)", "(52)", "(71)"} <= {*UNFINISHED}
    for name in UNFINISHED:
        assert RECORDED[name].verdict == "proved"
        assert RECORDED[name].corrected_verdict == "proved"


@pytest.mark.parametrize("name", AGAIN)
def test_a_recorded_verdict_is_found_again(name: str) -> None:
    """The trial, held now, ends as recorded, with the same method and to the last digit of a counterexample."""
    assert replace(try_one(name), seconds=RECORDED[name].seconds) == RECORDED[name]


@pytest.mark.slow
@pytest.mark.parametrize("name", SLIPS)
def test_the_slips_of_the_paper_are_found(name: str) -> None:
    """Each is refuted as printed, with the values on record that show it, and its corrected form is proved."""
    verdict = try_one(name)
    assert replace(verdict, seconds=RECORDED[name].seconds) == RECORDED[name]
    assert verdict.verdict == "refuted"
    assert verdict.corrected_verdict == "proved"
    assert verdict.corrected_tex
    assert verdict.note
    counterexample = verdict.counterexample
    breaks = "!=" in counterexample.get("relation", "")
    assert breaks or counterexample["left"] != counterexample["right"] or "no value" in counterexample["left"]


@pytest.mark.parametrize("name", REFUTED)
def test_a_corrected_form_refutes_the_printed_one(name: str) -> None:
    """The corrected form differs from the printed one: in the lines, or in their subjects."""
    case = trial(name)
    assert case.corrected
    assert case.corrected != case.printed or case.corrected_model not in {None, case.model}


def test_the_counterexample_of_the_cubic_holds_by_hand() -> None:
    """The second derivative (46) agrees with the cubic (48) if that has (2-I)^2, not if (2-1)^2."""
    counterexample = RECORDED["(48)"].counterexample
    spin, field = (
        [Fraction(counterexample[f"Omega{n}"]) for n in (1, 2, 3)],
        [Fraction(counterexample[f"K{n}"]) for n in (1, 2, 3)],
    )
    ratio = Fraction(counterexample["I3"]) / Fraction(counterexample["I2"])
    c3 = field[2] + spin[2]
    energy = spin[0] ** 2 + spin[1] ** 2 + ratio * spin[2] ** 2
    c5 = spin[0] * field[0] + spin[1] * field[1] - spin[2] ** 2 + (2 - ratio) * c3 * spin[2]
    square = sum(k * k for k in field)
    u = spin[2]
    true = (-2 * u + (2 - ratio) * c3) * (spin[0] * field[0] + spin[1] * field[1])
    true += -ratio * u * (field[0] ** 2 + field[1] ** 2) + (c3 - u) * (spin[0] ** 2 + spin[1] ** 2)

    def cubic(slip: Fraction) -> Fraction:
        a1 = -2 * c5 + (ratio - (2 - slip) ** 2) * c3**2 - energy - ratio * square
        return ((2 - ratio) * c5 + energy) * c3 + a1 * u + 6 * (1 - ratio) * c3 * u**2 - 2 * (1 - ratio) * u**3

    assert cubic(ratio) == true == Fraction(counterexample["left"])
    assert cubic(Fraction(1)) == Fraction(counterexample["right"]) != true


def test_the_counterexample_of_the_multipliers_holds_by_hand() -> None:
    """1.38: one multiplier between particles 4 and 6, particle 1 at (1, 0, 0), all others at the origin."""
    counterexample = RECORDED["(9)"].counterexample
    assert counterexample["lam[4,6]"] == "1"
    assert counterexample["x[1]"] == "[1, 0, 0]"
    # forces of L = lam/2 (x4 - x1, x6 - x1): on 1 it is -(x4 + x6 - 2 x1)/2 = x1; lambda_kj = -sum of force_k x_j
    force_on_1 = -Fraction(1, 2) * (0 + 0 - 2 * 1)
    assert -force_on_1 * 1 == Fraction(counterexample["left"]) == -1
    assert -Fraction(1, 2) * (-2 * 1 * 1) == Fraction(counterexample["right"]) == 1


def test_the_lines_that_equation_52_leaves_out_obey_equation_50_by_hand() -> None:
    """Every point with omega2 = -B2, omega1^2 = (1-I) B2^2 obeys (50), whatever omega3 is."""
    B2, B3, ratio, w1, w2 = Fraction(2), Fraction(3), Fraction(3, 4), Fraction(1), Fraction(-2)
    assert w1**2 == (1 - ratio) * B2**2
    for w3 in (Fraction(0), Fraction(7), Fraction(-3, 5)):
        assert B3 * (w1**2 + w2**2) - ratio * B2 * w2 * w3 + (2 - ratio) * B2 * B3 * w2 - ratio * B2**2 * w3 == 0


def test_the_end_of_the_unstable_band_is_a_triple_root_by_hand() -> None:
    """I = 1/2, B' = (0, 3, 1), omega = (0, -3/2, -2): p = p' = 0, p'' = 6, and Q = (1-I) v^3 (4 B3 - v)."""
    ratio, B2, B3, w2, w3 = Fraction(1, 2), 3, 1, Fraction(-3, 2), Fraction(-2)
    c3, square, energy = w3 + B3, B2**2 + B3**2, w2**2 + ratio * w3**2
    c5 = w2 * B2 - w3**2 + (2 - ratio) * c3 * w3
    a0, a1 = ((2 - ratio) * c5 + energy) * c3, -2 * c5 + (ratio - (2 - ratio) ** 2) * c3**2 - energy - ratio * square
    a2, a3 = 6 * (1 - ratio) * c3, -2 * (1 - ratio)
    assert a0 + a1 * w3 + a2 * w3**2 + a3 * w3**3 == 0
    assert a1 + 2 * a2 * w3 + 3 * a3 * w3**2 == 0
    assert 2 * a2 + 6 * a3 * w3 == 6
    for v in (Fraction(1), Fraction(-2), Fraction(7, 3), Fraction(4)):
        u = w3 + v
        quartic = (energy - ratio * u**2) * (square - (c3 - u) ** 2) - (u**2 - (2 - ratio) * c3 * u + c5) ** 2
        assert quartic == (1 - ratio) * v**3 * (4 * B3 - v)


def test_the_counterexample_of_the_combined_conditions_holds_by_hand() -> None:
    """A point off omega1 = 0 obeys both (65) and (66)."""
    counterexample = RECORDED["text-combining"].counterexample
    w1, w2, w3, B2, ratio, B3 = (
        *(Fraction(counterexample[name]) for name in ("omega1", "omega2", "omega3", "B2", "I")),
        Fraction(2),
    )
    common = B3 * (w1**2 + w2**2) - ratio * B2 * w2 * w3 + (2 - ratio) * B2 * B3 * w2
    assert common - ratio * B2**2 * w2**2 * w3 / (w1**2 + w2**2) == 0
    assert common - ratio * B2**2 * w3 == 0
    assert w1 != 0


def _verdict_of(name: str, **changes: str) -> run.Verdict:
    """Try an entry with something else in its place."""
    broken = replace(trial(name), **changes)
    outcome = broken.of_printed()
    return replace(RECORDED[name], verdict=outcome.decision, counterexample=outcome.counterexample)


@pytest.mark.parametrize(
    ("name", "term", "term_changed"),
    [
        ("(72)", "2B'_2", "3B'_2"),
        ("(91)", "+", "-"),
        ("(16)", r"\frac{\mu}{c}", r"\frac{\mu}{2c}"),
        ("(86)", r"(2\lvert", r"(\lvert"),
        ("(28)", r"-\hat{k}_2\sin\gamma t\cos", r"\hat{k}_2\sin\gamma t\cos"),
        ("theorem-root", r"v^2\left[-", r"v^2\left[+"),
        ("theorem-pair", r"-\boldsymbol", r"+\boldsymbol"),
        ("theorem-stability", r"(2\tau^2-1)", r"(\tau^2-1)"),
        ("text-ball-equivalent", "R^T", "R"),
        ("text-inertia-axes", r"=I_i", r"=I_j"),
    ],
)
def test_a_broken_entry_turns_the_run_red(name: str, term: str, term_changed: str) -> None:
    """A formula of the ledger that is changed is refuted, and that differs from the record."""
    assert term in EQUATIONS[name].tex
    verdict = _verdict_of(name, tex=EQUATIONS[name].tex.replace(term, term_changed, 1))
    assert verdict.verdict == "refuted"
    assert [changed[0] for changed in recorded.differs([verdict], RECORDED)] == [name]


def test_a_correction_that_is_wrong_too_turns_the_run_red() -> None:
    """A refuted entry whose corrected form isn't proved doesn't count as settled."""
    broken = replace(trial("(48)"), corrected_tex=trial("(48)").corrected_tex.replace("6(1-I)", "5(1-I)"))
    assert broken.true_form is not None
    assert broken.true_form.of_printed().decision == "refuted"


def test_a_trial_out_of_time_is_undecided(monkeypatch: pytest.MonkeyPatch) -> None:
    """A proof that takes too long proves nothing."""

    def forever() -> Model:
        while True:
            pass

    monkeypatch.setattr(run, "LIMIT", 0.05)
    monkeypatch.setattr(run, "trial", lambda name: replace(trials(topic(name))[name], model=forever))
    verdict = run.try_one("(72)")
    assert verdict.verdict == "undecided"
    assert "out of time" in verdict.method


def test_sampling_is_no_proof() -> None:
    """A sampled claim is supported, with the count."""
    x = sympy.Symbol("x", real=True)
    outcome = decide("x = 2*x - x", Model({"x": x}), sample_only=True)
    assert outcome.decision == "supported"
    assert "5 exact points" in outcome.method


def test_unrefuted_and_unproved_claims_are_undecided() -> None:
    """An inequality that is true but not term by term is left undecided, not called proved."""
    x = sympy.Symbol("x", positive=True)
    assert decide("x^2 - x + 1 > 0", Model({"x": x})).decision == "undecided"


def test_an_undefined_letter_is_read_as_a_free_letter() -> None:
    """An unknown name isn't read as its neighbour."""
    x = sympy.Symbol("B1", real=True)
    assert decide("B1 = b1", Model({"B1": x})).decision == "refuted"


def test_a_line_that_checks_nothing_is_not_proved() -> None:
    """Definitions alone, or one on which nothing that is checked depends, hold whatever they say."""
    letters = {"I": sympy.Symbol("I"), "x": sympy.Symbol("x")}
    assert decide("a2 = 17; a3 = 42", Model(letters), defines=("a2", "a3")).decision == "undecided"
    outcome = decide("a2 = 17; x = 2*x - x", Model(letters), defines=("a2",))
    assert outcome.decision == "undecided"
    assert "a2" in outcome.method
    assert decide("a2 = 17; x*a2 = 17*x", Model(letters), defines=("a2",)).decision == "proved"
    assert decide("a2 = 17; a3 = 2*a2; a3*x = 34*x", Model(letters), defines=("a2", "a3")).decision == "proved"


def test_a_chain_that_defines_a_letter_is_checked_from_its_second_side_on() -> None:
    """In R = a product = another one the second side defines, and the third one must be the same."""
    x = sympy.Symbol("x", real=True)
    outcome = decide("a2 = x + 1 = x + 2; a2 - 1 = x", Model({"x": x}), defines=("a2",))
    assert (outcome.decision, outcome.counterexample["relation"]) == ("refuted", "x + 1 = x + 2")
    assert decide("a2 = x + x = 2*x; a2 - x = x", Model({"x": x}), defines=("a2",)).decision == "proved"


def test_a_letter_that_is_defined_twice_is_refused() -> None:
    """The second definition doesn't silently replace the first."""
    letters = {"I": sympy.Symbol("I")}
    outcome = decide("a2 = 17*I; a2 = 2*I; a2 = 2*I", Model(letters), defines=("a2",))
    assert outcome.decision == "refuted"
    assert "defined twice" in outcome.counterexample["reason"]


def test_a_letter_that_is_compared_with_itself_is_refused() -> None:
    """A definition is not checked by the letter that it defines; it may be by a function of that."""
    x = sympy.Symbol("x", real=True)
    outcome = decide("a2 = 17 = a2", Model({"x": x}), defines=("a2",))
    assert outcome.decision == "undecided"
    assert "itself" in outcome.method
    assert decide("a2 = x - 1 = abs(a2)", Model({"x": 1 + x**2}), defines=("a2",)).decision != "refuted"


def test_a_definition_may_be_used_through_another_letter() -> None:
    """The checked side depends on z, z on a, and nothing on b."""
    z, s = sympy.Symbol("z", positive=True), sympy.Symbol("s", positive=True)
    model = Model({"z": z, "s": s, "square": z**2})
    assert decide("a = 2*s; z = a; square = 4*s^2", model, defines=("a", "z")).decision == "proved"
    outcome = decide("a = 2*s; b = s; z = a; square = 4*s^2", model, defines=("a", "b", "z"))
    assert outcome.decision == "undecided"
    assert outcome.method.endswith(" b")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "term", "term_changed"),
    [
        ("theorem-band", "8*t2 = 1 + gain", "8*t2 = 1 - gain"),
        ("theorem-steady", "M3*w - nu0", "M3*w + nu0"),
        ("text-inertia-axes", "R*I*T(R)", "T(R)*I*R"),
    ],
)
def test_the_other_half_of_a_theorem_is_tried_too(name: str, term: str, term_changed: str) -> None:
    """The sign beyond the band's ends, the converse about steady precessions, the inertia tensor in the laboratory."""
    case = trial(name)
    further = case.parts[-len(case.also) :]
    assert [line_further.line.count(term) for line_further in further].count(1) == 1
    lines_changed = tuple(
        replace(line_further, line=line_further.line.replace(term, term_changed)) for line_further in further
    )
    assert replace(case, also=lines_changed).of_printed().decision == "refuted"


def test_a_further_line_must_hold_too() -> None:
    """An entry is proved only if all its lines are."""
    case = trial("(51)")
    assert case.also
    line_changed = replace(case.parts[1], line=case.parts[1].line.replace("(1 - I)*B2^2", "(2 - I)*B2^2"))
    assert replace(case, also=(line_changed,)).of_printed().decision == "refuted"


def test_a_claim_false_in_one_case_is_refuted() -> None:
    """A claim that is true in one case and false in the other is refuted."""
    s = sympy.Symbol("s", positive=True)
    cases = [Model({"x": s, "size": s}), Model({"x": -s, "size": s})]
    assert decide("x = size", cases[:1]).decision == "proved"
    outcome = decide("x = size", cases)
    assert outcome.decision == "refuted"
    assert decide("abs(x) = size", cases).decision == "proved"


def test_a_formula_without_a_value_is_refuted() -> None:
    """0/0 at every point of a case isn't an equality."""
    zero = sympy.Integer(0)
    assert "0/0" in decide("x/y = 1", Model({"x": zero, "y": zero})).counterexample["left"]


def test_identities_of_rotations_are_decided() -> None:
    """R R^T = 1 for every rotation of Cayley's formula, and R isn't symmetric."""
    R = rotation()
    assert all(vanishes(entry) for entry in R * R.T - sympy.eye(3))
    assert not vanishes(R[0, 1] - R[1, 0])
    assert vanishes(R.det() - 1)
    v, w = sympy.Matrix(sympy.symbols("v1:4")), sympy.Matrix(sympy.symbols("w1:4"))
    assert hat(v) * w == v.cross(w)


def test_signs_are_decided_term_by_term() -> None:
    """A sum of positive terms is positive, a difference isn't known to be."""
    x, y = sympy.symbols("x y", positive=True)
    assert positive(x / (y + 1), strict=True)
    assert not positive(x - y, strict=True)
    assert positive(x * 0, strict=False)
    assert not positive(x * 0, strict=True)


def test_verify_reports_progress_and_uses_its_cache(tmp_path: Path) -> None:
    """Labels come back in the ledger's order; a second run reads the verdicts that the first has written."""
    progress: list[tuple[str, int, int]] = []
    store = Cache(tmp_path)
    verdicts = verify(["(77)", "(39)"], lambda *call: progress.append(call), store=store)
    assert [verdict.name for verdict in verdicts] == ["(39)", "(77)"]
    assert progress == [("(39)", 1, 2), ("(77)", 2, 2)]
    assert verify(["(77)", "(39)"], lambda *call: progress.append(call), store=store) == verdicts
    assert len(progress) == 2
    file_a, file_b = store.folder.glob("??/*")
    file_a.rename(tmp_path / "one")
    file_b.rename(file_a)
    (tmp_path / "one").rename(file_b)
    again = verify(["(77)", "(39)"], lambda *call: progress.append(call), store=store)
    assert [(verdict.name, verdict.printed) for verdict in again] == [
        (verdict.name, verdict.printed) for verdict in verdicts
    ]
    assert len(progress) == 4  # entries that were exchanged are made anew
