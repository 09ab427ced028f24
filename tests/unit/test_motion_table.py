"""`atlas motion --out`: tables in the axes given, with their conventions, which `atlas check` reads again."""

import re
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from scipy.spatial.transform import Rotation

import atlas
from atlas.checking.check import check_file
from atlas.cli.app import atlas as program

TIMES = ["--times", "0", "0.7", "3.1", "12"]
COMMANDS = {
    "tensor": "motion --tensor 2 1.5 1 0.1 0 0.2 --field 0.3 0 1 --spin 3 --attitude 0.6 0 0 0.8",
    "elementary": "motion --ratio 1.5 --field 1 2 --omega2 0.7",
    "general": "motion --inertia 2 3 --field 1 2 --omega 0.1 0.2 0.7",
    "top": "top --inertia 1 0.5 --direction 0.6 0.8 --linear 3 --omega 0.1 0.2 5",
    "hertz": "motion --ratio 1.5 --field 0.1Hz 0.2Hz --omega 3rpm 1rpm 20rpm",
}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "kind"), [*((name, "csv") for name in COMMANDS), ("hertz", "npz"), ("top", "parquet")]
)
def test_a_table_is_graded_by_itself(tmp_path: Path, name: str, kind: str) -> None:
    """Its head has the motion: without an option all its columns have their digits."""
    out = tmp_path / f"att.{kind}"
    outcome = CliRunner().invoke(program, [*COMMANDS[name].split(), *TIMES, "--out", str(out)])
    assert outcome.output == f"{out}\n"
    assert b"whose scalar is qw" in out.read_bytes()
    result = check_file(out)
    assert {"R11", "qw", "Omega1"} <= {column.name for column in result.columns}
    assert min(column.worst for column in result.columns) > 13


def test_attitudes_of_a_tensor_are_in_the_axes_given(tmp_path: Path) -> None:
    """They are those of atlas.motion, and of SciPy's Rotation at the start."""
    out = tmp_path / "att.npz"
    CliRunner().invoke(program, [*COMMANDS["tensor"].split(), *TIMES, "--out", str(out)])
    start = Rotation.from_quat([0.6, 0, 0, 0.8]).as_matrix()
    motion = atlas.motion([[2, 0.1, 0], [0.1, 1.5, 0.2], [0, 0.2, 1]], (0.3, 0.0, 1.0), (0.0, 0.0, 3.0), start)
    with np.load(out) as columns:
        R = np.column_stack([columns[f"R{i}{j}"] for i in "123" for j in "123"]).reshape(-1, 3, 3)
        assert np.allclose(R, motion.rotation(columns["t"]), rtol=0, atol=1e-13)
    assert np.allclose(R[0], start, rtol=0, atol=1e-15)


@pytest.mark.parametrize(
    ("options", "words"),
    [((), "gives? it|give one of them"), (("--times", "1", "--digits", "9"), "--out writes doubles")],
)
def test_an_impossible_table_is_refused(tmp_path: Path, options: tuple[str, ...], words: str) -> None:
    """Without times, and with proven digits."""
    outcome = CliRunner().invoke(program, [*COMMANDS["general"].split(), *options, "--out", str(tmp_path / "att.csv")])
    assert re.search(words, str(outcome.exception) + outcome.output)
    assert not (tmp_path / "att.csv").exists()


@pytest.mark.parametrize("seq", ["ZXZ", "zyx", "XYZ"])
def test_euler_angles_agree_with_the_matrix(seq: str) -> None:
    """Turned back by SciPy they give R(t), for one time and for several motions at several."""
    motion = atlas.GeneralMotion(1.5, (1.0, 2.0), (0.3, [0.7, 0.8], 0.2))
    t = np.array([0.3, 1.0, 2.5])[:, None]
    angles = motion.euler_angles(t, seq)
    assert angles.shape == (3, 2, 3)
    R = Rotation.from_euler(seq, angles.reshape(-1, 3)).as_matrix().reshape(3, 2, 3, 3)
    assert np.allclose(R, motion.rotation(t), rtol=0, atol=1e-14)
    assert np.allclose(motion.euler_angles(1.0, seq, degrees=True), np.rad2deg(angles[1]), rtol=1e-13)
    with pytest.raises(atlas.AtlasError, match="three letters"):
        motion.euler_angles(t, "Zab")
