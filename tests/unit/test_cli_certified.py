"""Floats and certified digits come from two floors that share no code; they must say the same."""

import json
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner
from flint import arb, ctx
from tests_support import ulps_apart

from atlas.cli.app import atlas as command
from atlas.cli.family import Best, sample
from atlas.errors import NotCertifiedError
from atlas.motions.register import Sampled

COMMANDS = [
    "classify --ratio 1.5 --field 1 2",
    "classify --ratio 2 --field -1e100 2e99",
    "classify --ratio 0.5 --field 1 -2",
    "classify --ratio 1 --field -3 -0.1",
    "classify --ratio 0.3 --field 1 0",
    "classify --ratio 0.3 --field 0 1",
    "classify --ratio 0.3 --field 0 -1",
    "classify --ratio 0.3 --field 0 0",
    "classify --shape cylindrical-shell --radius 0.1 --height 0.3 --field 1e-9 1",
    "classify --inertia 3 5 --field 1 2",
    "hyperbola --ratio 0.5 --field 1 0.1 --count 9",
    "hyperbola --ratio 1.9 --field -1e-3 7 --omega2 -1 0 2e-3 5e9",
    "hyperbola --ratio 1 --field 1 2 --omega2 -0.9999999999999999",
    "motion --ratio 1.5 --field 1 2 --omega2 0.7 --times 0 1 2.5 -1e8",
    "motion --ratio 0.1 --field 1e-3 -2e5 --omega2 0.7 --times 0 1e-9 2.5",
    "motion --ratio 1 --field 1 2 --omega2 -1 --omega3 0.3 --times 0 3",
    "motion --ratio 1.2 --field 0 2 --omega2 0 --omega3 0.3 --times 0 3",
    "motion --ratio 1.2 --field 0 0 --omega2 0.5 --omega3 0.3 --times 0 3",
    "motion --ratio 1.2 --field -2 0 --omega2 2 --omega3 0.3 --times 0 3",
    "ball --inertia 2 --larmor 0.5 --momentum 0.3 -0.7 --times 0 1 1e9",
    "ball --inertia 2 --larmor 0.5 --momentum 0 -1 --times 0 1",
    "ball --larmor -0.5 --momentum 0 3 --times 2",
    "particle --mu -2 --electric 0.1 0.5 -1 --magnetic 0.3 -0.2 1 --velocity 1 2 3 --times 0 1 50",
    "particle --mu 2 --electric 0.1 0.5 -1 --velocity 1 2 3 --position 1 1 1 --times 0 1 50",
    "particle --mu 1.7e11 --magnetic 0 0 1e-3 --electric 10 0 0 --velocity 1e5 0 0 --times 1e-9 --units si",
    "particle --mass 9.1e-31 --charge -1.6e-19 --magnetic 0 0 1e-3 --velocity 1e5 0 0 --times 1e-9 --units si",
    "particle --mu 5e17 --magnetic 0 0 1e2 --velocity 1e5 0 0 --times 1e-9 --units gaussian",
]


def answer(words: str) -> Any:
    """Run a command inside this process and read the JSON it prints."""
    result = CliRunner().invoke(command, [*words.split(), "--json"], catch_exceptions=False)
    assert result.exit_code == 0, result.output
    return json.loads(result.stdout)


@pytest.mark.parametrize("words", COMMANDS)
def test_floats_are_the_certified_digits_rounded(words: str) -> None:
    """Every float in the JSON of a command is within a few ulps of the certified value under the same key."""
    floats, texts = answer(words), answer(f"{words} --digits 25")
    for name in ("certified_digits", "inputs"):
        del texts[name]
    floats.pop("input_error", None)  # of floats alone: typed numbers are exact where digits are proven
    compare(floats, texts, "")


def compare(values: Any, certified: Any, place: str) -> None:
    """Compare two nested records; vectors by their length, all else by its own size."""
    assert isinstance(values, dict) == isinstance(certified, dict), place
    if isinstance(values, dict):
        assert values.keys() == certified.keys(), place
        for key in values:
            compare(values[key], certified[key], f"{place}.{key}")
    elif isinstance(values, list):
        assert len(values) == len(certified), place
        if values and all(isinstance(x, float) for x in values) and all(isinstance(x, str) for x in certified):
            size = max(abs(float(x)) for x in certified)
            for x, text in zip(values, certified, strict=True):
                assert ulps_apart(x, text, size) <= 8, (place, x, text)
        else:
            for index, pair in enumerate(zip(values, certified, strict=True)):
                compare(*pair, f"{place}[{index}]")
    elif isinstance(values, float) and isinstance(certified, str):
        assert ulps_apart(values, certified, abs(float(certified))) <= 8, (place, values, certified)
    else:
        assert values == certified, place


@pytest.mark.parametrize(("digits", "more_digits"), list(pairwise([1, 5, 17, 60, 400])))
def test_more_digits_begin_with_the_same_ones(digits: int, more_digits: int) -> None:
    """Asking for more digits never changes those already printed, but for the rounding of the last."""
    words = "motion --ratio 0.3 --field 1 2 --omega2 0.7 --times 1e3"
    few, many = (answer(f"{words} --digits {n}")["samples"][0]["R"] for n in (digits, more_digits))
    for i in range(3):
        for j in range(3):
            assert abs(float(few[i][j]) - float(many[i][j])) <= 0.51 * 10.0 ** (1 - digits) + 1e-15


def test_decimals_are_taken_as_typed_when_asked() -> None:
    """With --decimal, 0.1 is 1/10: the ratio enters phi and its digits end where those of a rational do."""
    words = "motion --ratio 0.5 --field 1 1 --omega2 0.1 --digits 40"
    # phi = B3 w2 (1-I)(w2 + 2 B2)/(I B2 (w2 + B2)) = 0.1*2.1/1.1 = 21/110
    assert answer(f"{words} --decimal")["phi"] == "0.1909090909090909090909090909090909090909"
    assert answer(words)["phi"] != answer(f"{words} --decimal")["phi"]


def test_the_ratio_of_a_charge_to_a_mass_is_exact_in_decimals() -> None:
    """0.1/0.3 is 1/3 with --decimal, and else the quotient of the two doubles, not rounded."""
    words = "particle --mass 0.3 --charge 0.1 --magnetic 0 0 1 --digits 25"
    assert answer(f"{words} --decimal")["cyclotron_frequency"] == "0.3333333333333333333333333"
    assert answer(words)["cyclotron_frequency"] == "0.3333333333333333641728618"
    assert answer("particle --mu 0.1 --magnetic 0 0 1 --digits 25 --decimal")["cyclotron_frequency"].strip("0") == ".1"


def test_a_point_charge_in_si_is_shown_with_its_frequency() -> None:
    """Its table has Hz, and no Larmor frequency, which is of a body."""
    words = "particle --mass 9.11e-31 --charge -1.602e-19 --magnetic 0 0 1e-3 --velocity 1e5 0 0 --times 1e-9"
    outcome = CliRunner().invoke(command, words.split(), catch_exceptions=False)
    assert "cyclotron_frequency/2 pi  -2.79875e+07  Hz" in outcome.stdout
    assert "larmor" not in outcome.stdout


@pytest.mark.parametrize(
    ("units", "c"), [("--mu 3", 1), ("--mass 1 --charge 3", 1), ("--mu 3 --units gaussian", 29979245800)]
)
def test_the_field_of_a_charge_is_exact(units: str, c: int) -> None:
    """B' = mu B/(2c) is that of the doubles typed for mu and B; the pole of the hyperbola is -B2."""
    record = answer(f"hyperbola --ratio 0.5 --magnetic 0.1 0.2 {units} --digits 40")
    assert abs(Fraction(record["pole"]) / (3 * Fraction(0.1) / (2 * c)) + 1) < Fraction(1, 10**39)
    assert record["inputs"] == "the doubles nearest to what was typed"


def test_rounding_of_typed_numbers_is_reported(tmp_path: Path) -> None:
    """The sentence on the inputs names the values in doubles first, in a table as in JSON; none is a decimal."""
    (tmp_path / "ring.csv").write_text("x,y,z,mass\n1,0,0,1\n0,1,0,1\n-1,0,0,1\n0,-1,0,1\n", encoding="utf-8")
    start = "motion --digits 40"
    for words, says in (
        ("--ratio 1.5 --omega2 0.1 --field 2 --angle 1", "a field at an angle"),
        ("--ratio 1.5 --omega2 0.1 --magnetic 2 --mu 1 --angle 30deg", "a field at an angle"),
        ("--ratio 1.5 --omega2 0.1rad/s --field 1Hz 2Hz", "numbers in turns or degrees"),
        (f"--points {tmp_path / 'ring.csv'} --omega2 0.1 --field 1 2", "sums over more than 4096 points"),
    ):
        sentence = f"the doubles nearest to what was typed, and, rounded to doubles, {says}"
        assert answer(f"{start} {words}")["inputs"] == sentence
        assert f"inputs: {sentence}." in CliRunner().invoke(command, [*start.split(), *words.split()]).stdout
    angle = CliRunner().invoke(
        command, [*start.split(), *"--ratio 1.5 --omega2 0.1 --field 2 --angle 1 --decimal".split()]
    )
    assert "or --angle" in angle.output
    heavy = "top --inertia 1 0.5 --mass 1 --heavy 9.81 0.5 --direction 0 1 --omega 0 0 9 --digits 20"
    assert answer(heavy)["inputs"].endswith("the moments and couplings of the top")


def test_times_by_a_step_are_exact() -> None:
    """The last of four times by a step of 0.1 is 0.3, to the last digit; of one third it is 1."""
    words = "motion --ratio 1.5 --field 1 2 --omega2 0.7 --decimal --digits 25"
    for grid, times in (("0 0.1 4", "0:0.3:4"), ("0 1/3 4", "0 1/3 2/3 1")):
        assert answer(f"{words} --grid {grid}")["samples"] == answer(f"{words} --times {times}")["samples"]
    large = CliRunner().invoke(command, [*words.split(), *"--grid 1e308 1e308 4".split()])
    assert "must be finite" in str(large.exception)


@pytest.mark.parametrize(
    ("words", "system"),
    [("--mu 2", "natural"), ("--mass 1 --charge 2", "si"), ("--mass 1 --charge 2 --units gaussian", "gaussian")],
)
def test_a_charge_is_in_coulomb_unless_another_system_is_named(words: str, system: str) -> None:
    """SI where a charge is given, as in every other command; of mu alone nothing is known."""
    record = answer(f"particle {words} --magnetic 0 0 3")
    assert record["parameters"]["units"] == system
    c = 2.99792458e10 if system == "gaussian" else 1.0
    assert record["cyclotron_frequency"] == pytest.approx(6.0 / c, rel=1e-15)


def test_one_time_that_cannot_be_had_does_not_lose_the_others() -> None:
    """Where a higher precision can't be had a row keeps its last value; else it says so, with a reason."""
    best, vector = Best(), Sampled("Omega_i", "angular_velocity", "")

    class Motion:
        """Has one time, and this at low precision only."""

        def angular_velocity(self, t: int) -> list[arb]:
            """Return Omega."""
            if t or ctx.prec > 100:
                raise NotCertifiedError("too far")
            return [arb(1)] * 3

    with ctx.workprec(64):
        vector_sample = sample(vector, Motion(), 0, best)
    with ctx.workprec(128):
        assert sample(vector, Motion(), 0, best) is vector_sample
        assert sample(vector, Motion(), 1, best) == ["not certified"] * 3
    assert best.reason == "too far"


def test_rows_with_long_numbers_stay_on_one_line() -> None:
    """A row a quantity, however many digits it has."""
    words = "motion --ratio 1.5 --field 1 2 --omega 0.3 0.7 0.2 --digits"
    few, many = (CliRunner().invoke(command, [*words.split(), digits]).stdout.splitlines() for digits in ("5", "120"))
    assert len(few) == len(many) == 11
    assert max(map(len, many)) > 4 * 120
    assert all(a.split()[0] == b.split()[0] for a, b in zip(few, many, strict=True))
