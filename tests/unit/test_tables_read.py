"""Tables that `check` and `fit` read: the package's own, to the same bits, and those of loggers and other programs."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from hypothesis import given, settings
from hypothesis import strategies as st

import atlas
from atlas.checking.check import Check, check_file
from atlas.checking.headings import MATRIX, OMEGA, QUATERNION
from atlas.checking.trajectory import opened
from atlas.cli.app import atlas as program
from atlas.errors import AtlasError
from atlas.fitting import fit_file
from atlas.fitting.data import of_arrays, of_file

MOTIONS = {
    "general": atlas.motion(1.4, (0.4, -0.9, 1.2), (0.5, 0.3, -1.1)),
    "elementary": atlas.ElementaryMotion(1.5, (1.0, 2.0), 0.7),
    "top": atlas.TopMotion((1.0, 0.5), (0.0, 0.0), (0.6, 0.8), (0.1, 0.2, 5.0), 3.0),
    "asymmetric": atlas.AsymmetricMotion((0.8, 1.0, 1.2), (0.2, 0.3, 0.4), (1.0, 2.0, 3.0)),
    "tensor": atlas.motion([[2, 0.1, 0], [0.1, 1.5, 0.2], [0, 0.2, 1]], (0.3, 0.0, 1.0), (0.1, 0.2, 3.0)),
}
TIMES = np.linspace(0.0, 7.3, 12)


def read(path: Path) -> dict[str, Any]:
    """Return all columns of a file by their canonical names."""
    with opened(path, fields=True) as file:
        blocks = list(file.blocks)
    return {name: np.concatenate([block[name] for block in blocks]) for name in file.names}


@pytest.mark.parametrize("index", [True, False])
@pytest.mark.parametrize("name", MOTIONS)
def test_own_tables_are_read_to_the_same_bits(tmp_path: Path, name: str, index: bool) -> None:
    """Files of to_dataframe and pandas, with an index or without, come back as they were."""
    motion, path = MOTIONS[name], tmp_path / "own.csv"
    motion.to_dataframe(TIMES).to_csv(path, index=index)
    columns = read(path)
    assert np.array_equal(columns["t"], TIMES)
    tables = {
        MATRIX: motion.rotation(TIMES).reshape(-1, 9),
        OMEGA: motion.angular_velocity(TIMES),
        QUATERNION: motion.quaternion(TIMES, scalar_first=True),
    }
    for names, values in tables.items():
        assert np.array_equal(np.column_stack([columns[name] for name in names]), values)


def test_a_sweep_of_times_is_read_to_the_same_bits(tmp_path: Path) -> None:
    """Its columns of parameters, omega2 among them, are no angular velocities of the body."""
    out, quantities = tmp_path / "sweep.csv", ("R", "Omega", "k", "case")
    parameters = {"ratio": 1.5, "B2": 1.0, "B3": 2.0, "omega2": 0.7, "t": TIMES}
    atlas.sweep("elementary", parameters, quantities, out=out)
    columns = read(out)
    swept = atlas.sweep("elementary", parameters, quantities)
    assert np.array_equal(columns["t"], TIMES)
    for name in (*MATRIX, *OMEGA):
        assert np.array_equal(columns[name], swept[name])
    result = check_file(out, ratio=1.5, field=(1.0, 2.0), omega2=0.7)
    assert min(column.worst for column in result.columns) > 15
    assert result.notes == ("columns left out: ratio, B2, B3, omega2, k, case",)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["sweep.csv", "sweep.npz", "sweep.parquet", "sweep.parquet/"])
def test_sweeps_of_every_kind_are_fitted_from_the_same_bits(tmp_path: Path, name: str) -> None:
    """A folder of Parquet files, too; a table without rows is refused."""
    options = "sweep general --ratio 1.5 --field 1 2 --omega .3 .7 .2 --set t=0:7.3:12 --quantity R --rows 5 --out"
    for place in (name, "reference.npz"):
        outcome = CliRunner().invoke(program, [*options.split(), f"{tmp_path}/{place}"])
        assert outcome.exit_code == 0, outcome.output
    table, reference = of_file(tmp_path / name, None), np.load(tmp_path / "reference.npz")
    assert np.array_equal(table.t, TIMES)
    assert np.array_equal(table.data["rotation"].reshape(-1, 9).T, [reference[entry] for entry in MATRIX])
    assert CliRunner().invoke(program, ["fit", f"{tmp_path}/{name}"]).exit_code == 0
    np.savez(tmp_path / "empty.npz")
    with pytest.raises(AtlasError, match="is empty"):
        of_file(tmp_path / "empty.npz", None)


def graded(path: Path, head: str, rows: Any, end: str = "\n", encoding: str = "utf-8") -> Check:
    """Grade rows of text cells below a head against the elementary motion."""
    path.write_bytes((head + "\n" + end.join(rows) + end).encode(encoding))
    return check_file(path, ratio=1.5, field=(1.0, 2.0), omega2=0.7)


def rates(unit: float = 1.0, time: float = 1.0) -> list[list[str]]:
    """Return cells t and Omega of the elementary motion."""
    Omega = MOTIONS["elementary"].angular_velocity(TIMES) * unit
    return [[repr(float(t * time)), *(repr(float(x)) for x in w)] for t, w in zip(TIMES, Omega, strict=True)]


@pytest.mark.parametrize(
    ("head", "unit", "time", "quote", "separator", "encoding"),
    [
        ('"Time (s)","Gyroscope x (rad/s)","Gyroscope y (rad/s)","Gyroscope z (rad/s)"', 1, 1, '"', ",", "utf-8"),
        ("Time (ms);gyro_x (°/s);gyro_y (°/s);gyro_z (°/s)", 180 / np.pi, 1e3, "", ";", "latin-1"),
        ("sep=;\nt [s];Omega_1 [deg/s];Omega_2 [deg/s];Omega_3 [deg/s]", 180 / np.pi, 1, "", ";", "utf-8"),
        ("timestamp (ms)\tgyr x (Hz)\tgyr y (Hz)\tgyr z (Hz)", 1 / (2 * np.pi), 1e3, "", "\t", "utf-16"),
        ("t\N{NO-BREAK SPACE}[s] Omega1 (1/s) Omega2 (1/s) Omega3 (1/s)", 1, 1, "", " ", "utf-8"),
        ("% log\nt;Omega1;Omega2;Omega3;\n[ms];[deg/s];[deg/s];[deg/s];", 180 / np.pi, 1e3, "", ";", "utf-16"),
        ("t,angular_velocity.x,angular_velocity.y,angular_velocity.z,", 1, 1, "", ",", "utf-8-sig"),
    ],
)
def test_heads_of_loggers_are_read(
    tmp_path: Path, head: str, unit: float, time: float, quote: str, separator: str, encoding: str
) -> None:
    """Round brackets, quotes, sep=, Latin-1, UTF-16, a separator at the end, degrees, units in a line of their own."""
    rows = [separator.join(f"{quote}{cell}{quote}" for cell in row) for row in rates(unit, time)]
    result = graded(tmp_path / "log.csv", head, rows, encoding=encoding)
    assert len(result.columns) == 3
    assert min(column.worst for column in result.columns) > 14
    assert not result.notes


@pytest.mark.parametrize("separator", [";", "\t", " "])
def test_decimal_commas_are_read(tmp_path: Path, separator: str) -> None:
    """A table with decimal commas is graded as the same table with points."""
    head, rows = separator.join(("t", "Omega1", "Omega2", "Omega3")), [separator.join(row) for row in rates()]
    assert graded(tmp_path / "log.csv", head, [row.replace(".", ",") for row in rows]) == graded(
        tmp_path / "log.csv", head, rows
    )


def test_numbers_of_fortran_are_read(tmp_path: Path) -> None:
    """1.5D-05 is 1.5e-05, and a separator at the end of rows alone is none."""
    rows = [",".join(f"{float(cell):.16e}".replace("e", "D") for cell in row) + "," for row in rates()]
    assert min(c.worst for c in graded(tmp_path / "f.csv", "t,Omega1,Omega2,Omega3", rows).columns) > 15


@settings(max_examples=25)
@given(
    st.lists(st.sampled_from(["", "nan", "NaN", "NA", "#N/A", "null", "-", " "]), min_size=1, max_size=5),
    st.integers(0, 6),
)
def test_rows_that_lack_a_number_are_counted(tmp_path_factory: pytest.TempPathFactory, holes: Any, start: int) -> None:
    """The other rows are graded as without them."""
    path = tmp_path_factory.mktemp("holes") / "log.csv"
    rows, head = rates(), "t,Omega1,Omega2,Omega3"
    for i, cell in enumerate(holes, start):
        rows[i][1 + i % 3] = cell
    result = graded(path, head, [",".join(row) for row in rows])
    rows_whole = [",".join(row) for i, row in enumerate(rows) if not start <= i < start + len(holes)]
    assert result.columns == graded(path, head, rows_whole).columns
    assert result.rows == len(TIMES) - len(holes)
    assert result.notes[0].startswith(f"{len(holes)} row")


def test_arrays_with_nan_are_graded_and_fitted_without_those_rows() -> None:
    """nan_policy="raise" refuses them."""
    motion, t = atlas.motion(1.4, (0.0, 0.0, 0.0), (0.5, 0.3, -1.1)), np.linspace(0, 8, 33)
    R = motion.rotation(t)
    R[[3, 20], 1, 2] = np.nan
    result = atlas.check(t, R, motion=motion)
    assert isinstance(result, Check)
    assert (result.rows, result.notes) == (31, ("2 rows left out, which lack a number",))
    data = of_arrays(t, {"rotation": R}, 1e-3, 0.0, scalar_first=False)
    assert data.t.size == 31
    assert data.notes == result.notes
    for call in (lambda: atlas.check(t, R, motion=motion, nan_policy="raise"),
                 lambda: atlas.fit(t, rotation=R, nan_policy="raise")):  # fmt: skip
        with pytest.raises(AtlasError, match="finite"):
            call()


@pytest.mark.slow
def test_standard_errors_stand_in_a_column_or_have_a_unit(tmp_path: Path) -> None:
    """A column sigma [deg] and the option 1deg are the same as radians; results are in s where times have a unit."""
    motion, t = MOTIONS["general"], np.linspace(0, 8, 41)
    path = tmp_path / "fit.csv"
    frame = motion.to_dataframe(t, quantities=["qx", "qy", "qz", "qw"]).rename(columns={"t": "t [ms]"})
    frame["t [ms]"] *= 1000
    frame["sigma [deg]"] = np.linspace(1.0, 2.0, 41)
    frame.to_csv(path, index=False)
    fit = fit_file(path)
    assert np.allclose(fit.sigma, np.deg2rad(np.linspace(1.0, 2.0, 41)), rtol=1e-15)
    assert fit.params["omega1"].value == pytest.approx(0.5, abs=1e-9)
    assert fit.time_unit == "s"
    outcome = [
        CliRunner().invoke(program, ["fit", str(path), "--sigma", s]).output for s in ("1deg", repr(np.pi / 180))
    ]
    assert "sigma 0.0175 given" in outcome[0]
    assert outcome[0] == outcome[1]


def test_unused_columns_are_named(tmp_path: Path) -> None:
    """Other columns are left out with one line, and a name that is nearly right is asked about."""
    rows = [",".join([*row, "x", "7"]) for row in rates()]
    notes = graded(tmp_path / "t.csv", "t,Omega1,Omega2,Omega3,label,Quat_q0", rows).notes
    assert len(notes) == 1
    assert notes[0].startswith("columns left out: label, Quat_q0 (of a quaternion qw is the scalar")
    for name, hint in {"omega_x": "called Omega1", "wx": "called Omega1", "Quat_q0": "qw is the scalar"}.items():
        with pytest.raises(AtlasError, match=f"There is '{name}' .*{hint}"):
            graded(tmp_path / "t.csv", f"t,{name}", ["0,1"])
    for other in ("Temp", "Torque1", "Battery"):
        with pytest.raises(AtlasError, match=r"there is no column t; name the times t\.$"):
            graded(tmp_path / "t.csv", f"{other},Omega1,Omega2,Omega3", rows)
    motion = MOTIONS["general"]
    motion.to_dataframe(np.linspace(0, 8, 41)).to_csv(tmp_path / "fit.csv", index=False)
    report = fit_file(tmp_path / "fit.csv", sigma=1e-3).report()
    assert "not fitted: quaternion, angular velocity, field in body" in report
