"""Bodies and attitudes that are off by their last digits: at the shell the nearest one with a line, else an error."""

import json
import re
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from scipy.spatial.transform import Rotation

import atlas
from atlas.cli.app import atlas as program
from atlas.errors import DomainError, NearestInputWarning

FREE = ["--field", "0", "0", "0", "--omega", "0.3", "0.7", "0.2", "--times", "0", "--json"]


def run(*words: str) -> Any:
    """Return the outcome of atlas motion."""
    return CliRunner().invoke(program, ["motion", *words])


def plates(digits: int, count: int) -> Any:
    """Yield the moments of random plates a x b, printed with so many decimals, in random order."""
    rng = np.random.default_rng(digits)
    for a, b in rng.uniform(0.3, 3.0, (count, 2)).tolist():
        yield [f"{x:.{digits}f}" for x in rng.permutation([a * a / 12, b * b / 12, (a * a + b * b) / 12])]


@pytest.mark.parametrize("digits", [3, 4, 8])
def test_printed_plates_are_bodies(digits: int) -> None:
    """Those that rounding puts beyond all bodies are plates again, each moment by less than the unit of its digits."""
    count = 0
    for moments in plates(digits, 12):
        outcome = run("--inertia", *moments, *FREE)
        assert outcome.exit_code == 0, (moments, outcome.output)
        line = re.search(r"used instead is the plane body next to them, (\S+) (\S+) (\S+)", outcome.stderr)
        if line:
            count += 1
            moments_taken = np.array([*map(float, line.groups())])
            assert np.all(abs(moments_taken - [*map(float, moments)]) < 10.0**-digits)
            assert max(moments_taken) == pytest.approx(moments_taken.sum() / 2, rel=1e-9)
        else:
            assert max(map(float, moments)) <= sum(map(float, moments)) / 2 * (1 + 1e-14)
    assert count


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--inertia", ".281", ".563"), "used instead is the plane body next to them, .*0.2813333333 0.5626666667"),
        (("--ratio", "2.0000001"), "used instead is the largest, 2"),
        (("--tensor", "0.2083", "0.2083", "0.4167", "0.125", "0", "0"), "0.20835 0.20835 0.4167 0.125 0 0"),
    ],
)
def test_inputs_off_by_their_last_digits_are_corrected_with_a_warning(words: tuple[str, ...], message: str) -> None:
    """A disk, a ratio, a tensor."""
    outcome = run(*words, *FREE)
    assert outcome.exit_code == 0, outcome.output
    assert re.search(message, outcome.stderr)
    assert json.loads(outcome.stdout)


def test_a_quaternion_off_by_its_last_digits_is_divided_by_its_length() -> None:
    """The command warns as the motion in Python does."""
    with pytest.warns(NearestInputWarning, match="of the length 0.99999; used instead is the quaternion divided by it"):
        outcome = run("--ratio", "1.5", "--attitude", ".7071", "0", "0", ".7071", *FREE)
    assert json.loads(outcome.stdout)


@pytest.mark.parametrize("exact", [("0.0833", "0.3333", "0.4166"), ("1/12", "1/3", "5/12"), ("1", "1", "2")])
def test_bodies_are_taken_as_typed(exact: tuple[str, ...]) -> None:
    """Nothing is said of a plane body, nor is it moved."""
    assert "taken" not in run("--inertia", *exact, *FREE).stderr


@pytest.mark.parametrize(
    "words", [("--inertia", "1", "3"), ("--ratio", "2.1"), ("--ratio", "3"), ("--inertia", "0.8", "1", "1.9")]
)
def test_inputs_off_by_more_are_refused(words: tuple[str, ...]) -> None:
    """One digit that is off by a tenth is no matter of digits."""
    with pytest.raises(DomainError):
        program([*("motion", *words), *FREE], standalone_mode=False)
    outcome = run("--ratio", "1.5", "--attitude", ".707", "0", "0", ".7", *FREE)
    assert "length" in str(outcome.exception)


def test_the_error_names_a_possible_value() -> None:
    """In Python, where digits are not known, the sentence has the moment that mends it."""
    for inertia, words in (((0.0833, 0.3333, 0.4167), "0.4166 would do"), ((0.281, 0.563), "2 I2 = 0.562")):
        with pytest.raises(DomainError, match=words):
            atlas.motion(atlas.SymmetricBody(*inertia) if len(inertia) == 2 else inertia, (0, 0, 0), (1, 2, 3))


def test_a_tensor_of_single_precision_is_a_body() -> None:
    """A plate in any axes, in float32 and printed with all its digits."""
    rng, count = np.random.default_rng(4), 0
    for _ in range(8):
        A = Rotation.random(random_state=rng).as_matrix()
        tensor = (A * [1 / 12, 1 / 3, 5 / 12] @ A.T).astype(np.float32)
        entries = [repr(float(tensor[i, j])) for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))]
        outcome = run("--tensor", *entries, *FREE)
        assert outcome.exit_code == 0, outcome.output
        count += "used instead is the plane body next to it" in outcome.stderr
    assert count


@pytest.mark.slow
@pytest.mark.parametrize("body", [["--ratio", "1.5(1)"], ["--ratio", "1.5+-0.1"], ["--inertia", "1", "1", "1.3(1)"]])
def test_uncertain_bodies_are_no_printed_digits(body: list[str]) -> None:
    """Numbers with a standard deviation are taken as typed."""
    outcome = run(*body, "--field", "0", "1", "2", "--omega", "0.3", "0.7", "0.2", "--times", "0")
    assert (outcome.exit_code, outcome.stderr) == (0, ""), outcome.stderr


@pytest.mark.parametrize(
    ("entries", "question", "meant"),
    [
        ("1 0.1 0.2 1.2 0.15 1.4", "URDF", "1 1.2 1.4 0.1 0.2 0.15"),
        ("2.76 1.56 -1.58 5.82 -1.36 5.55", "izz, with products", "2.76 5.82 5.55 -1.56 1.58 1.36"),
        ("1.0 1.1 1.2 0.35 -0.4 -.35", "SolidWorks", "1.0 1.1 1.2 -0.35 0.4 .35"),
    ],
)
def test_a_tensor_in_another_order_is_asked_about(entries: str, question: str, meant: str) -> None:
    """The command that the error names is one of a body."""
    outcome = run("--tensor", *entries.split(), *FREE)
    assert outcome.exit_code == 2
    assert question in outcome.stderr
    assert outcome.stderr.rstrip().endswith(f"--tensor {meant}")
    assert run("--tensor", *meant.split(), *FREE).exit_code == 0


def test_a_tensor_of_no_body_in_any_order_is_refused() -> None:
    """No other reading is offered where none is a body."""
    outcome = run("--tensor", "1", "1", "3", "0", "0", "0.1", *FREE)
    assert isinstance(outcome.exception, DomainError)
    assert "did you mean" not in str(outcome.exception)
