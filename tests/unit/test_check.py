"""`atlas check`: a trajectory is graded against the certified motion."""

import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from oracles import closed_form

from atlas.errors import AtlasError
from atlas.scene import Curve, Plane
from atlas.study.check import Check, check
from atlas.study.trajectory import MATRIX, OMEGA, read

SETTING = "# ratio = 1.5\n# field = 1 2\n# omega2 = 0.7\n"
TIMES = [0.0, 0.25, 1.0, 2.5, 10.0, 100.0]

Writer = Callable[[str], Path]


def true_row(t: float) -> list[float]:
    """Return R (9) and Omega (3) from mpmath, rounded to doubles."""
    R = closed_form.elementary_rotation(1, 1.5, 1, 2, 0.7, t)
    Omega = closed_form.elementary_angular_velocity(1, 1.5, 1, 2, 0.7, t)
    return [float(R[i, j]) for i in range(3) for j in range(3)] + [float(x) for x in Omega]


def table(names: list[str], rows: list[list[float]], separator: str = ",") -> str:
    """Write a table of numbers with all their digits."""
    return "\n".join([separator.join(names), *(separator.join(map(repr, row)) for row in rows)]) + "\n"


@pytest.fixture
def write(tmp_path: Path) -> Writer:
    """Return a function that writes a file and gives its path."""

    def writer(text: str) -> Path:
        path = tmp_path / "user.csv"
        path.write_text(text, encoding="utf-8")
        return path

    return writer


def graded(
    write: Writer, change: Callable[[float, list[float]], list[float]] = lambda _, row: row, **options: Any
) -> Check:
    """Grade the true trajectory after a change to its rows."""
    rows = [[t, *change(t, true_row(t))] for t in TIMES]
    return check(write(SETTING + table(["t", *MATRIX, *OMEGA], rows)), **options)


def test_the_true_motion_has_all_its_digits(write: Writer) -> None:
    """Correctly rounded doubles have at least 15.9 digits in every column, and nothing drifts."""
    result = graded(write)
    assert [c.name for c in result.columns] == [*MATRIX, *OMEGA]
    assert min(c.worst for c in result.columns) > 15.9
    assert all(c.fails_at is None for c in result.columns)
    assert {d.name for d in result.drifts} == {"R^T R", "E'", "K^2", "c3", "c5", "(m,B')"}
    assert max(d.worst for d in result.drifts) < 8 * 2.0**-52
    assert result.rows == len(TIMES)
    assert result.case == "precession"
    assert result.frequencies["k"] == "1.56524758424985"


def test_a_wrong_value_is_flagged_where_it_stands(write: Writer) -> None:
    """An entry that is off by 3e-5 from t = 2.5 on has 4.5 digits, and fails from there."""

    def spoil(t: float, row: list[float]) -> list[float]:
        return [x + (3e-5 if i == 4 and t >= 2.5 else 0) for i, x in enumerate(row)]

    result = graded(write, spoil)
    bad = {c.name: c for c in result.columns if c.fails_at is not None}
    assert list(bad) == ["R22"]
    assert bad["R22"].fails_at == 2.5
    assert bad["R22"].worst == pytest.approx(-math.log10(3e-5), abs=1e-6)
    assert next(c for c in graded(write, spoil, threshold=4).columns if c.name == "R22").fails_at is None
    drifts = {d.name: d for d in result.drifts}
    assert drifts["R^T R"].worst > 1e-6
    assert drifts["E'"].worst < 1e-15


@pytest.mark.parametrize("threshold", [-1.0, 17.5, math.inf, math.nan])
def test_a_threshold_counts_digits(write: Writer, threshold: float) -> None:
    """It lies between none and the 17 digits of a double."""
    with pytest.raises(AtlasError, match="from 0 to 17"):
        graded(write, threshold=threshold)


def test_an_error_of_any_size_can_be_drawn(write: Writer) -> None:
    """What is off by 1e308 has -308 digits and is drawn at 1e17, and the caption says so; what is right is not."""
    text = SETTING + table(["t", "R11", "Omega1"], [[0.0, 1e308, 0.0], [1.0, 0.5, -1e308]])
    result = check(write(text))
    assert [round(column.worst) for column in result.columns] == [-308, -308]
    scene = result.scene()
    (panel,) = scene.panels
    assert isinstance(panel, Plane)
    drawn = [layer.points[:, 1].max() for layer in panel.layers if isinstance(layer, Curve)]
    assert drawn == [1e17, 1e17, 1e-6]
    assert "Errors beyond 1e+17 are drawn there." in scene.caption
    assert "beyond" not in graded(write).scene().caption


def test_drift_of_an_integral_is_relative_and_dated(write: Writer) -> None:
    """Omega that grows by 1e-6 t raises E' by 2e-6 t of itself, most at the end."""

    def grow(t: float, row: list[float]) -> list[float]:
        return row[:9] + [x * (1 + 1e-6 * t) for x in row[9:]]

    energy = next(d for d in graded(write, grow).drifts if d.name == "E'")
    assert energy.worst == pytest.approx(2e-4, rel=1e-3)
    assert energy.worst_time == 100.0
    assert energy.last == energy.worst


def test_a_quaternion_of_either_sign_is_graded(write: Writer) -> None:
    """Both quaternions of R are right; one of norm 1 + 1e-8 is seen in the norm and in orthogonality."""
    rows = []
    for i, t in enumerate(TIMES):
        R = np.array(true_row(t)[:9]).reshape(3, 3)
        w = math.sqrt(max(0.0, 1 + np.trace(R))) / 2
        q = np.array([w, *((R[j, k] - R[k, j]) / (4 * w) for j, k in ((2, 1), (0, 2), (1, 0)))])
        rows.append([t, *((-1) ** i * q * (1 + 1e-8 * (t == 10.0))).tolist()])
    result = check(write(SETTING + table(["t", "w", "x", "y", "z"], rows)))
    assert [c.name for c in result.columns] == ["q0", "q1", "q2", "q3"]
    assert min(c.median for c in result.columns) > 14
    drifts = {d.name: d for d in result.drifts}
    assert drifts["|q|"].worst == pytest.approx(1e-8, rel=1e-5)
    assert drifts["|q|"].worst_time == 10.0
    assert drifts["R^T R"].worst > 1e-8


def test_parameters_come_from_options_or_from_the_file(write: Writer) -> None:
    """Options override the file; a body may be given by its two moments; units of separators do not matter."""
    rows = [[t, true_row(t)[2]] for t in TIMES]
    bare = table(["Time", "r_13"], rows, ";")
    result = check(write(bare), ratio=1.5, field=(1.0, 2.0), omega2=0.7)
    assert result.columns[0].name == "R13"
    assert result.parameters == {"ratio": 1.5, "field": [1.0, 2.0], "omega2": 0.7}
    assert result.columns[0].worst > 15.9
    again = check(write("# solver: RK45\n# inertia: 2, 3 ; field = (1, 2)\n# omega2 = 5\n\n" + bare), omega2=0.7)
    assert again.columns[0].worst > 15.9
    assert json.loads(json.dumps(again.record()))["parameters"]["inertia"] == [2.0, 3.0]


def test_a_free_body_needs_its_omega3(write: Writer) -> None:
    """Without a field omega3 is a parameter, and the grade is against mf92."""
    text = "# ratio = 0.5\n# field = 0 0\n# omega2 = 0.7\n# omega3 = 0.3\n"
    t = 3.0
    Omega = closed_form.elementary_angular_velocity(1, 0.5, 0, 0, 0.7, t, 0.3)
    result = check(write(text + table(["t", *OMEGA], [[t, *map(float, Omega)]])))
    assert result.case == "free body"
    assert min(c.worst for c in result.columns) > 15.5


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "is empty"),
        ("# ratio = 1\n", "is empty"),
        ("t,R11\n", "no rows"),
        ("R11,R12\n1,2\n", "no column t"),
        ("t\n0\n", "nothing to grade"),
        ("t,R11,R44\n0,1,1\n", "line 1: no column is called 'R44'"),
        ("t,R11,r11\n0,1,1\n", "R11 is there twice"),
        ("t,w,x,y\n0,1,0,0\n", "a quaternion has the four columns"),
        ("t,R11\n0,1\n1\n", "line 3: 1 cells where the line of names has 2"),
        ("t,R11\n0,1\n1,one\n", "line 3, column R11: 'one' is not a number"),
        ("t,R11\n0,1\n1,\n", "line 3, column R11: '' is not a number"),
        ("t,R11\n0,nan\n", "line 2, column R11: the cell is nan"),
        ("t,R11\ninf,1\n", "line 2, column t: the cell is inf"),
        ("# field = 1\nt,R11\n0,1\n", "line 1: field takes 2 numbers, not 1"),
        ("# ratio = ?\nt,R11\n0,1\n", "line 1, parameter ratio"),
        ("t,R11\n0,1\n", "does not say ratio"),
        ("# ratio = 1.5\n# omega2 = 1\nt,R11\n0,1\n", "does not say field"),
        ("# ratio = 3\n# field = 1 2\n# omega2 = 1\nt,R11\n0,1\n", "No body has I"),
        ("# inertia = 0 1\n# field = 1 2\n# omega2 = 1\nt,R11\n0,1\n", "I2 must be positive"),
        ("# ratio = 1.5\n# field = 1 2\n# omega2 = -1\nt,R11\n0,1\n", "pole"),
    ],
)
def test_a_malformed_file_is_refused_in_one_sentence(write: Writer, text: str, words: str) -> None:
    """The sentence says which line and which column."""
    with pytest.raises(AtlasError, match=words) as caught:
        check(write(text))
    assert "\n" not in str(caught.value)


def test_a_binary_file_is_no_trajectory(tmp_path: Path) -> None:
    """Bytes that are no text are refused by name."""
    path = tmp_path / "plot.png"
    path.write_bytes(b"\x89PNG\xff\xfe\x00")
    with pytest.raises(AtlasError, match=r"plot\.png is not a text file"):
        read(path)


def test_the_record_is_json_and_the_scene_shows_the_errors(write: Writer) -> None:
    """The record reads back the same; the scene has a curve for R, one for Omega and the threshold."""
    result = graded(write)
    assert json.loads(json.dumps(result.record()))["columns"][0]["name"] == "R11"
    heading, rows = result.column_table()
    assert {len(row) for row in rows} == {len(heading)}
    heading, rows = result.drift_table()
    assert {len(row) for row in rows} == {len(heading)}
    (panel,) = result.scene().panels
    assert isinstance(panel, Plane)
    curves = [layer for layer in panel.layers if isinstance(layer, Curve)]
    assert [curve.label for curve in curves] == ["$R$", r"$\boldsymbol{\Omega}$", "6 digits"]
    assert curves[0].points.shape == (len(TIMES), 2)
    assert (curves[0].points[:, 1] <= 2.0**-53).all()
