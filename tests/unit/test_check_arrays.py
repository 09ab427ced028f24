"""`atlas.check`: arrays are graded as the command grades files, and runs with several steps have an order."""

import json
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from scipy.spatial.transform import Rotation

import atlas
from atlas.checking.check import Check, check_file
from atlas.checking.comparison import Comparison
from atlas.checking.headings import MATRIX, OMEGA
from atlas.checking.order import Convergence
from atlas.cli.app import atlas as command
from atlas.errors import AtlasError

MOTIONS = {
    "--ratio 1.5 --field 1 2 --omega2 0.7": atlas.ElementaryMotion(1.5, (1.0, 2.0), 0.7),
    "--ratio 1.5 --field 0 0 --omega 0.3 0.7 0.2": atlas.FreeMotion(1.5, (0.3, 0.7, 0.2)),
    "--ratio 1.5 --field 1 2 --omega 0.3 0.7 0.2": atlas.GeneralMotion(1.5, (1.0, 2.0), (0.3, 0.7, 0.2)),
    "--inertia 1 0.5 --coupling 0.3 0.4 --direction 0.6 0.8 --omega 0.1 0.2 5 --linear 3": atlas.TopMotion(
        (1.0, 0.5), (0.3, 0.4), (0.6, 0.8), (0.1, 0.2, 5.0), linear=3.0
    ),
    "--inertia 0.8 1 1.3 --field 0.2 1 0.6 --omega 0.3 0.7 0.2": atlas.AsymmetricMotion(
        (0.8, 1.0, 1.3), (0.2, 1.0, 0.6), (0.3, 0.7, 0.2)
    ),
}
TIMES = np.linspace(0.0, 8.0, 9)


def midpoint(motion: Any, count: int, place: float = 0.5) -> tuple[np.ndarray, np.ndarray]:
    """Return times and R by steps about Omega in the middle of each, of order 2; elsewhere in it of order 1."""
    t = np.linspace(0.0, 4.0, count + 1)
    turns = Rotation.from_rotvec(np.diff(t)[:, None] * motion.angular_velocity(t[:-1] + place * np.diff(t)))
    R = [Rotation.identity()]
    for turn in turns:
        R.append(R[-1] * turn)
    return t, np.array([rotation.as_matrix() for rotation in R])


def trajectory_file(path: Path, t: np.ndarray, R: np.ndarray, *more: np.ndarray) -> Path:
    """Write a trajectory with all digits."""
    names = ["t", *MATRIX, *OMEGA][: 10 + 3 * len(more)]
    rows = np.column_stack([t, R.reshape(-1, 9), *more]).tolist()
    path.write_text("\n".join([",".join(names), *(",".join(map(repr, row)) for row in rows)]) + "\n")
    return path


@pytest.mark.slow
@pytest.mark.parametrize("options", MOTIONS)
def test_arrays_are_graded_as_files_are(tmp_path: Path, options: str) -> None:
    """The command prints the object, which has the same numbers, for every class of motions."""
    motion = MOTIONS[options]
    R, Omega = motion.rotation(TIMES), motion.angular_velocity(TIMES)
    R[3, 1, 1] += 1e-4
    result = atlas.check(TIMES, R, motion=motion, angular_velocity=Omega)
    assert {column.name: column.fails_at for column in result.columns if column.fails_at is not None} == {"R22": 3.0}
    words = ["check", str(trajectory_file(tmp_path / "mine.csv", TIMES, R, Omega)), *options.split()]
    outcome = CliRunner().invoke(command, words)
    assert outcome.stdout == str(result).replace("the trajectory", "mine.csv") + "\n"
    record = json.loads(CliRunner().invoke(command, [*words, "--json"]).stdout)
    assert record | {"file": result.file} == json.loads(json.dumps(result.record()))
    assert "<td>R22</td>" in result._repr_html_()


def test_quaternions_are_graded_in_either_order_and_sign() -> None:
    """As SciPy gives them, scalar last, or scalar first."""
    motion = MOTIONS["--ratio 1.5 --field 1 2 --omega2 0.7"]
    q = Rotation.from_matrix(motion.rotation(TIMES)).as_quat() * np.where(TIMES % 2, -1, 1)[:, None]
    result_last = atlas.check(TIMES, quaternion=q, motion=motion)
    result_first = atlas.check(TIMES, quaternion=np.roll(q, 1, axis=1), motion=motion, scalar_first=True)
    assert sorted(result_last.columns, key=str) == sorted(result_first.columns, key=str)
    assert [column.name for column in result_first.columns] == ["w", "x", "y", "z"]
    assert min(column.worst for column in result_first.columns) > 15


@pytest.mark.parametrize(("place", "order"), [(0.0, 1), (0.5, 2)])
def test_several_steps_tell_the_order(tmp_path: Path, place: float, order: int) -> None:
    """Steps about Omega at their beginning are of first order, about that in their middle of second."""
    options = "--ratio 1.5 --field 1 2 --omega 0.3 0.7 0.2"
    motion = MOTIONS[options]
    runs = [midpoint(motion, count, place) for count in (400, 100, 200)]
    t, R = zip(*runs, strict=True)
    result = atlas.check(list(t), list(R), motion=motion)
    assert isinstance(result, Convergence)
    assert result.steps == pytest.approx((0.04, 0.02, 0.01))
    assert result.order["R"] == pytest.approx(order, abs=0.05)
    assert result.orders["R"] == pytest.approx((order, order), abs=0.05)
    files = [str(trajectory_file(tmp_path / f"{i}.csv", *run)) for i, run in enumerate(runs)]
    figure = tmp_path / "order.svg"
    outcome = CliRunner().invoke(command, ["check", *files, "--order", *options.split(), "--figure", str(figure)])
    assert outcome.exit_code == 0
    assert outcome.stdout == f"{result}\n{figure}\n"
    assert "largest error" in figure.read_text()
    assert atlas.check(list(t), list(R), motion=motion, step=[4, 16, 8]).steps == (16, 8, 4)


def test_several_integrators_are_compared_in_one_picture(tmp_path: Path) -> None:
    """Each file has its table, as alone, a curve in the picture, and a say in the exit status."""
    options = "--ratio 1.5 --field 1 2 --omega 0.3 0.7 0.2"
    motion = MOTIONS[options]
    files = [str(trajectory_file(tmp_path / f"{i}.csv", *midpoint(motion, 100, i / 2))) for i in (0, 1)]
    files += [str(trajectory_file(tmp_path / "exact.csv", TIMES, motion.rotation(TIMES)))]
    figure = tmp_path / "errors.svg"
    run = partial(CliRunner().invoke, command, standalone_mode=False)
    outputs = [run(["check", file, *options.split()]).stdout for file in files]
    together = run(["check", *files, *options.split(), "--figure", str(figure)])
    assert together.return_value == 1
    assert together.stdout == "".join([*outputs, f"{figure}\n"])
    assert "of 0.csv from t" in together.stderr
    assert "exact.csv" not in together.stderr
    assert run(["check", files[2], files[2], *options.split()]).return_value == 0
    body = {"ratio": 1.5, "field": (1.0, 2.0), "omega": (0.3, 0.7, 0.2)}
    checks = tuple(check_file(Path(file), **body) for file in files)
    (panel,) = Comparison(checks).scene().panels
    assert [curve.label for curve in panel.layers] == ["0.csv", "1.csv", "exact.csv"]
    assert [curve.points[-1, 1] for curve in panel.layers] == [max(x.errors["R"][-1], 1e-17) for x in checks]
    with pytest.raises(AtlasError, match="8 files at most, not 9"):
        Comparison(checks * 3).scene()


def test_a_comment_of_the_file_may_give_the_step(tmp_path: Path) -> None:
    """Rows that are saved seldom say nothing of the step: '# step = 0.001' does."""
    motion = MOTIONS["--ratio 1.5 --field 1 2 --omega2 0.7"]
    path = trajectory_file(tmp_path / "a.csv", TIMES, motion.rotation(TIMES))
    words = ["check", str(path), "--ratio", "1.5", "--field", "1", "2", "--omega2", "0.7", "--json"]
    assert json.loads(CliRunner().invoke(command, words).stdout)["step"] == 1.0
    path.write_text("# step = 0.001\n" + path.read_text())
    assert json.loads(CliRunner().invoke(command, words).stdout)["step"] == 0.001


GENERAL = MOTIONS["--ratio 1.5 --field 1 2 --omega 0.3 0.7 0.2"]
R = GENERAL.rotation(TIMES)


@pytest.mark.parametrize(
    ("t", "data", "words"),
    [
        (TIMES, {}, "nothing to grade"),
        (TIMES, {"rotation": R[:5]}, r"\(9, 3, 3\), not \(5, 3, 3\)"),
        (TIMES, {"rotation": R * np.nan}, "no row with all its numbers"),
        (TIMES, {"quaternion": R[:, 0]}, r"\(9, 4\)"),
        (TIMES, {"rotation": R, "rotations": R}, "give one of them"),
        (TIMES[:, None], {"rotation": R}, r"an array \(N,\)"),
        ([], {"rotation": R[:0]}, r"an array \(N,\)"),
        (TIMES, {"rotation": R, "motion": None}, "one of ElementaryMotion"),
        (TIMES, {"rotation": R, "motion": atlas.GeneralMotion([1.5, 1.2], (1, 2), (0.3, 0.7, 0.2))}, "one motion"),
        (TIMES, {"rotation": R, "step": "a"}, "step"),
        ([TIMES, TIMES], {"rotation": [R]}, "a list of 2"),
        ([TIMES, TIMES], {"rotation": [R, R]}, "each with another step"),
        ([TIMES], {"rotation": [R]}, "two runs or more"),
        ([TIMES, TIMES[:5]], {"rotation": [R, R[:5]], "step": [1, 0.5]}, "over the same time"),
    ],
)
def test_ungradable_data_are_refused_in_one_sentence(t: Any, data: dict[str, Any], words: str) -> None:
    """Arrays of other shapes, no motion, runs without an order."""
    with pytest.raises(AtlasError, match=words) as caught:
        atlas.check(t, **({"motion": GENERAL} | data))
    assert "\n" not in str(caught.value)


def test_the_names_of_a_fit_agree_with_a_check() -> None:
    """The plurals are taken as well; another name is none."""
    graded = [atlas.check(TIMES, **{name: R}, motion=GENERAL).record() for name in ("rotation", "rotations")]
    assert graded[0] == graded[1]
    with pytest.raises(TypeError, match="rotatoins"):
        atlas.check(TIMES, rotatoins=R, motion=GENERAL)


def test_a_motion_that_starts_turned_is_refused() -> None:
    """The certified motions begin with R(0) = 1: another attitude is that of `atlas.motion`, which is graded."""
    motion_turned = atlas.GeneralMotion.in_laboratory(
        1.5, (0.3, 1.0, 2.0), Rotation.from_rotvec([0.1, 0.2, 0.3]).as_matrix(), (0.3, 0.7, 0.2)
    )
    with pytest.raises(AtlasError, match=r"atlas\.motion"):
        atlas.check(TIMES, motion_turned.rotation(TIMES), motion=motion_turned)


def test_runs_without_errors_have_no_order() -> None:
    """Where nothing is wrong no order is told."""
    result = atlas.check([TIMES[:1], TIMES[:1]], [R[:1], R[:1]], motion=GENERAL, step=[1, 2])
    assert result.order == {"R": None}
    assert "not told" in str(result)
    assert isinstance(atlas.check(TIMES, R, motion=GENERAL), Check)


TENSOR = [[2.0, 0.1, 0.05], [0.1, 1.5, 0.2], [0.05, 0.2, 1.0]]
TURNED = atlas.motion(TENSOR, (0.3, 0.0, 1.0), (0.0, 0.0, 3.0), Rotation.from_quat([0.6, 0.0, 0.0, 0.8]))


def test_a_motion_in_any_axes_and_from_any_attitude_is_graded(tmp_path: Path) -> None:
    """An error of 1e-7 in one column is seen in it alone; the command says the same, by options or by the file."""
    times = np.linspace(0.0, 20.0, 41)
    R, Omega = TURNED.rotation(times), TURNED.angular_velocity(times)
    R[7:, 0, 2] += np.linspace(1e-7, 5e-8, 34)
    result = atlas.check(times, R, angular_velocity=Omega, motion=TURNED)
    digits_lost = {column.name: column.worst for column in result.columns}
    assert digits_lost.pop("R13") == pytest.approx(7.0, abs=0.01)
    assert min(digits_lost.values()) > 12
    path = trajectory_file(tmp_path / "a.csv", times, R)
    options = "--tensor 2 1.5 1 0.1 0.05 0.2 --field 0.3 0 1 --spin 3 --attitude 0.6 0 0 0.8".split()
    outcome = CliRunner().invoke(command, ["check", str(path), *options])
    assert outcome.exit_code == 0, outcome.output
    assert str(atlas.check(times, R, motion=TURNED)).partition("\n")[2] in outcome.stdout
    lines = "# inertia = 2 1.5 1 0.1 0.05 0.2; field = 0.3 0 1; omega = 0 0 3; attitude = 0.6 0 0 0.8\n"
    path.write_text(lines + path.read_text())
    assert CliRunner().invoke(command, ["check", str(path)]).stdout == outcome.stdout
