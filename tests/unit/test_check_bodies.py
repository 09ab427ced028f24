"""`atlas check` on bodies with three moments and on tops: against Taylor series, which share no code with either."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from oracles import taylor, top
from scipy.spatial.transform import Rotation

from atlas.checking.check import Check
from atlas.checking.check import check_file as check
from atlas.checking.headings import MATRIX, OMEGA, QUATERNION
from atlas.cli.app import atlas as command
from atlas.errors import AtlasError

BODY = {"inertia": (0.8, 1.0, 1.3), "field": (0.2, 1.0, 0.6), "omega": (0.3, 0.7, 0.2)}
TOP = {"inertia": (1.0, 0.5), "coupling": (0.3, 0.4), "direction": (0.6, 0.8), "omega": (0.1, 0.2, 5.0)}
POTENTIAL = (3.0, 0.5)
TIMES = [0.25, 1.0, 2.0, 3.5]
COLUMNS = [*MATRIX, *OMEGA]


def _rows(states: list[tuple[Any, Any]]) -> np.ndarray:
    return np.array([[float(R[i, j]) for i in range(3) for j in range(3)] + [*map(float, W)] for R, W in states])


@pytest.fixture(scope="module")
def of_body() -> np.ndarray:
    """Return R and Omega of the body with three moments at TIMES, (4, 12), each nearest to the true number."""
    return _rows([(state.R, state.Omega) for state in taylor.taylor(*BODY.values(), TIMES, digits=24)])


@pytest.fixture(scope="module")
def of_top() -> np.ndarray:
    """Return the same of the top."""
    return _rows(top.taylor((*TOP.values(), *POTENTIAL), TIMES, digits=18))


def trajectory_file(
    folder: Path, rows: np.ndarray, names: list[str] | tuple[str, ...] = COLUMNS, head: str = ""
) -> Path:
    """Write a trajectory with its times."""
    lines = [
        ",".join(["t", *names]),
        *(",".join(map(repr, [t, *row])) for t, row in zip(TIMES, rows.tolist(), strict=True)),
    ]
    path = folder / "mine.csv"
    path.write_text(head + "\n".join(lines) + "\n", encoding="utf-8")
    return path


def lines(parameters: dict[str, tuple[float, ...]]) -> str:
    """Return the lines of a file that describe its motion."""
    return "".join(f"# {name} = {' '.join(map(repr, values))}\n" for name, values in parameters.items())


def digits(result: Check) -> dict[str, float]:
    """Return the worst digits of each column."""
    return {column.name: column.worst for column in result.columns}


@pytest.mark.slow
def test_a_body_with_three_moments_has_its_digits(tmp_path: Path, of_body: np.ndarray) -> None:
    """Rounded true values have the digits to which the closed form is known, and nothing drifts."""
    result = check(trajectory_file(tmp_path, of_body), **BODY)
    assert result.case == "on a torus"
    assert list(digits(result)) == COLUMNS
    assert 14 < min(digits(result).values()) <= max(digits(result).values()) < 15
    assert {drift.name for drift in result.drifts} == {"R^T R", "H", "F", "(M,K)", "K^2", "T"}
    assert max(drift.worst for drift in result.drifts) < 1e-14
    assert check(trajectory_file(tmp_path, of_body, head=lines(BODY))) == result
    assert result.parameters == {name: list(values) for name, values in BODY.items()}


@pytest.mark.slow
def test_errors_for_three_moments_are_measured_by_balls(tmp_path: Path, of_body: np.ndarray) -> None:
    """R22 off by 2^-30 from the third row on has 9.03 digits there; Omega is measured by the largest rate."""
    rows_wrong = of_body.copy()
    rows_wrong[2:, COLUMNS.index("R22")] += 2.0**-30
    rows_wrong[3, COLUMNS.index("Omega1")] -= 2.0**-20
    result = check(trajectory_file(tmp_path, rows_wrong), **BODY, threshold=9.5)
    failed = {column.name: column for column in result.columns if column.fails_at is not None}
    assert {name: column.fails_at for name, column in failed.items()} == {"R22": TIMES[2], "Omega1": TIMES[3]}
    assert failed["R22"].worst == pytest.approx(30 * np.log10(2), abs=1e-6)
    assert failed["Omega1"].worst == pytest.approx(20 * np.log10(2), abs=1e-6)  # the largest rate is B2 = 1
    assert max(result.errors["R"]) == pytest.approx(2.0**-30, rel=1e-4)


@pytest.mark.slow
def test_quaternions_of_either_sign_are_accepted(tmp_path: Path, of_body: np.ndarray) -> None:
    """Both signs are right, and in each row another component that is off by 2^-30 is found."""
    signs = np.array([1, -1, 1, -1])[:, None]
    q = signs * Rotation.from_matrix(of_body[:, :9].reshape(-1, 3, 3)).as_quat(scalar_first=True)
    assert min(digits(check(trajectory_file(tmp_path, q, QUATERNION), **BODY)).values()) > 14
    result = check(trajectory_file(tmp_path, q + 2.0**-30 * np.eye(4), QUATERNION), **BODY)
    assert [column.worst_time for column in result.columns] == TIMES
    assert list(digits(result).values()) == pytest.approx([30 * np.log10(2)] * 4, abs=1e-5)


@pytest.mark.parametrize("inertia", [(1.0, 1.0, 0.5), (0.8, 1.0, 1.3)])
def test_where_balls_decide_each_row_all_digits_are_counted(tmp_path: Path, inertia: tuple[float, ...]) -> None:
    """A symmetric body by three moments, and Euler's top have no theta functions: balls decide each row."""
    field = (0.2, 1.0, 0.6) if inertia[0] == inertia[1] else (0.0, 0.0, 0.0)
    inputs = {"inertia": inertia, "field": field, "omega": (0.3, 0.7, 0.2)}
    rows = _rows([(state.R, state.Omega) for state in taylor.taylor(*inputs.values(), TIMES, digits=24)])
    assert min(digits(check(trajectory_file(tmp_path, rows), **inputs)).values()) > 15.9


@pytest.mark.slow
def test_a_threshold_beyond_the_digits_of_the_closed_form_is_refused(tmp_path: Path, of_body: np.ndarray) -> None:
    """The sentence says how many there may be."""
    with pytest.raises(AtlasError, match=r"may be 1\d\.\d digits at most"):
        check(trajectory_file(tmp_path, of_body), **BODY, threshold=15.0)


def test_the_digits_of_a_top_are_graded(tmp_path: Path, of_top: np.ndarray) -> None:
    """A top with a coupling and a potential: rounded true values, its three constants, and an error that is found."""
    inputs = TOP | {"linear": POTENTIAL[0], "quadratic": POTENTIAL[1]}
    result = check(trajectory_file(tmp_path, of_top), **inputs)
    assert result.case.startswith("top, nutation")
    assert min(digits(result).values()) > 15.9
    assert {drift.name for drift in result.drifts} == {"R^T R", "h", "M3", "p"}
    assert max(drift.worst for drift in result.drifts) < 1e-14
    head = lines(TOP | {"linear": POTENTIAL[:1], "quadratic": POTENTIAL[1:]})
    assert check(trajectory_file(tmp_path, of_top, head=head)) == result
    rows_wrong = of_top.copy()
    rows_wrong[1, COLUMNS.index("Omega3")] += 5e-6
    again = check(trajectory_file(tmp_path, rows_wrong), **inputs)
    assert digits(again)["Omega3"] == pytest.approx(6, abs=1e-3)  # the largest rate is omega3 = 5
    assert {drift.name: drift.worst_time for drift in again.drifts if drift.worst > 1e-8} == {
        "h": 1.0,
        "M3": 1.0,
        "p": 1.0,
    }


@pytest.mark.parametrize(
    ("inputs", "words"),
    [
        (BODY | {"omega": None, "omega2": 0.7}, "is started by omega, three components"),
        (TOP | {"field": (1.0, 2.0)}, "not field"),
        (TOP | {"inertia": (1.0, 1.1, 1.2)}, "of a top.*give inertia = I2 I3"),
        (TOP | {"omega": None}, "omega is missing"),
        (TOP | {"direction": None}, "direction is missing"),
        (BODY | {"inertia": (1.0, 1.1, 2.2)}, "moments of inertia|largest"),
        (BODY | {"omega": (float("nan"), 0.0, 0.0)}, "finite"),
    ],
)
def test_impossible_motions_are_refused(
    tmp_path: Path, of_body: np.ndarray, inputs: dict[str, Any], words: str
) -> None:
    """In one sentence that names the remedy."""
    with pytest.raises(AtlasError, match=words) as caught:
        check(trajectory_file(tmp_path, of_body), **inputs)
    assert "\n" not in str(caught.value)


@pytest.mark.slow
def test_the_command_checks_bodies_and_tops(tmp_path: Path, of_body: np.ndarray, of_top: np.ndarray) -> None:
    """`atlas check` with three moments, and with the direction of a top; a failed column is status 1."""
    for rows, options, digits_least in (
        (of_body, "--inertia 0.8 1 1.3 --field 0.2 1 0.6 --omega 0.3 0.7 0.2", 14.0),
        (
            of_top,
            "--inertia 1 0.5 --coupling 0.3 0.4 --direction 0.6 0.8 --omega 0.1 0.2 5 --linear 3 --quadratic 0.5",
            15.9,
        ),
    ):
        words = ["check", str(trajectory_file(tmp_path, rows)), *options.split()]
        outcome = CliRunner().invoke(command, [*words, "--json"], catch_exceptions=False)
        assert outcome.exit_code == 0
        assert min(column["worst"] for column in json.loads(outcome.stdout)["columns"]) > digits_least
        assert (
            CliRunner().invoke(command, [*words, "--omega", "0.3", "0.7", "0.3"], standalone_mode=False).return_value
            == 1
        )
