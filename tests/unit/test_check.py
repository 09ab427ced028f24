"""`atlas check`: a trajectory is graded against the certified motion."""

import json
import math
import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from itertools import chain
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from flint import arb, ctx
from hypothesis import example, given, settings
from hypothesis import strategies as st
from oracles import closed_form
from stress import extreme
from stress.regimes import REGIMES

from atlas.arithmetic.certified_digits import enclosed
from atlas.checking import grades, trajectory, truth
from atlas.checking.check import Check
from atlas.checking.check import check_file as check
from atlas.checking.headings import MATRIX, OMEGA
from atlas.cli.app import atlas as program
from atlas.errors import AtlasError
from atlas.motions.elementary import certified as exact
from atlas.motions.elementary.kernel import ElementaryMotion
from atlas.motions.nutation.kernel_general import GeneralMotion
from atlas.pictures import Curve, Plane

SETTING = "# ratio = 1.5\n# field = 1 2\n# omega2 = 0.7\n"
HEAD = "# ratio = 1.5; field = 1 2; omega2 = 0.7\n"
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
    assert {d.name for d in result.drifts} == {"R^T R", "E'", "K^2", "c3", "c5", "(m,B')", "H", "F", "(M,K)"}
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


@pytest.mark.parametrize(("threshold", "fails"), [(0, False), (3, False), (3.02, True), (17, True)])
def test_a_column_passes_thresholds_up_to_its_digits(write: Writer, threshold: float, fails: bool) -> None:
    """R11 off by 2^-10 at t = 0, 3.01 digits, passes 0 and 3 and fails 3.02 and 17; its digits are those of 2^-10."""
    column = check(write(HEAD + "t,R11\n0,1.0009765625\n"), threshold=threshold).columns[0]
    assert (column.fails_at is not None) is fails
    assert column.worst == pytest.approx(10 * math.log10(2), abs=1e-12)
    assert column.median == 3.01


def test_a_digit_that_hangs_on_the_last_bit_is_decided_by_a_ball(write: Writer) -> None:
    """An error of 2^-10 fails the first threshold whose limit is below it, and no other."""
    threshold = 10 * math.log10(2) - 1e-14
    while 10.0**-threshold >= 2.0**-10:
        passes, threshold = threshold, math.nextafter(threshold, 17.0)
    path = write(HEAD + "t,R11\n0,1.0009765625\n")
    assert 2.0**-10 - 10.0**-threshold < truth.UNCERTAINTY
    assert check(path, threshold=threshold).columns[0].fails_at == 0.0
    assert check(path, threshold=passes).columns[0].fails_at is None


def test_an_error_of_any_size_can_be_drawn(write: Writer) -> None:
    """An error of 1e308 has -308 digits and is drawn at 1e17, as the caption says; a right value is not."""
    text = SETTING + table(["t", "R11", "Omega1"], [[0.0, 1e308, 0.0], [1.0, 0.5, -1e308]])
    result = check(write(text))
    assert [round(column.worst) for column in result.columns] == [-308, -308]
    scene = result.scene()
    (panel,) = scene.panels
    assert isinstance(panel, Plane)
    heights = [layer.points[:, 1].max() for layer in panel.layers if isinstance(layer, Curve)]
    assert heights == [1e17, 1e17, 1e-6]
    assert "Errors beyond 1e+17 are drawn there." in scene.caption
    assert "beyond" not in graded(write).scene().caption
    for R11, Omega1 in ((1e308, 0.0), (1.0, 1e308)):
        one = check(write(SETTING + table(["t", "R11", "Omega1"], [[0.0, 1.0, 0.0], [0.0, R11, Omega1]])))
        assert "Errors beyond 1e+17 are drawn there." in one.scene().caption


def test_drift_of_an_integral_is_relative_and_dated(write: Writer) -> None:
    """Omega that grows by 1e-6 t raises E' by 2e-6 t of itself, most at the end."""

    def grow(t: float, row: list[float]) -> list[float]:
        return row[:9] + [x * (1 + 1e-6 * t) for x in row[9:]]

    energy = next(d for d in graded(write, grow).drifts if d.name == "E'")
    assert energy.worst == pytest.approx(2e-4, rel=1e-3)
    assert energy.worst_time == 100.0
    assert energy.last == energy.worst


def quaternion(t: float) -> Any:
    """Return a quaternion of the true matrix."""
    R = np.array(true_row(t)[:9]).reshape(3, 3)
    w = math.sqrt(max(0.0, 1 + np.trace(R))) / 2
    return np.array([w, *((R[j, k] - R[k, j]) / (4 * w) for j, k in ((2, 1), (0, 2), (1, 0)))])


def test_a_quaternion_of_either_sign_is_graded(write: Writer) -> None:
    """Both quaternions of R are right; one of norm 1 + 1e-8 is seen in the norm and in orthogonality."""
    rows = [[t, *((-1) ** i * quaternion(t) * (1 + 1e-8 * (t == 10.0))).tolist()] for i, t in enumerate(TIMES)]
    result = check(write(SETTING + table(["t", "w", "x", "y", "z"], rows)))
    assert [c.name for c in result.columns] == ["w", "x", "y", "z"]
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
    assert result.columns[0].name == "r_13"
    assert result.parameters == {"ratio": 1.5, "field": [1.0, 2.0], "omega2": 0.7}
    assert result.columns[0].worst > 15.9
    again = check(write("# solver: RK45\n# inertia: 2, 3 ; field = (1, 2)\n# omega2 = 5\n\n" + bare), omega2=0.7)
    assert again.columns[0].worst > 15.9
    assert json.loads(json.dumps(again.record()))["parameters"]["inertia"] == [2.0, 3.0]


def test_a_free_body_needs_its_omega3(write: Writer) -> None:
    """Without a field omega3 is a parameter, and the grade is against (87)."""
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
        (HEAD + "t,R11\n", "no rows"),
        ("R11,R12\n1,2\n", "no column t"),
        ("t\n0\n", "there are no data beside t; add columns R11"),
        ("t,R44\n0,1\n", "line 1: there are no data beside t; .*'R44' .*row and column"),
        ("t,roll,pitch,yaw\n0,1,1,1\n", r"There is 'roll', 'pitch', 'yaw' .*from_euler"),
        ("t,phi_deg\n0,1\n", "There is 'phi_deg' .*from_euler"),
        ("t [kg],R11\n0,1\n", r"line 1: t is in s, or a unit that converts to it, not in 'kg'\."),
        ("t,R11 [m]\n0,1\n", "R11 has no unit, not in 'm'"),
        ("t,R11,r11\n0,1,1\n", "R11 is there twice"),
        ("0.0,1,0,0\n", "line 1: the first line must name the columns, .* but begins with '0.0'"),
        ("t,w,x,y\n0,1,0,0\n", "the axis is R13, R23, R33.*quaternion qw, qx, qy, qz. There is 'w', 'x', 'y'"),
        (HEAD + "t,R11\n0,1\n1\n", "line 4: 1 cells where the line of names has 2"),
        (HEAD + "t,R11\n0,1\n1,one\n", "line 4, column R11: 'one' is not a number"),
        (HEAD + "t,R11\n\n0,\n1,\n", "no row with all its numbers: 2 lack one"),
        (HEAD + "t;R11\n0,5;1\n1,5;.5\n", "line 3, column t: 0,5 has a comma, and .5 in line 4 has a point; write all"),
        (HEAD + "t;R11\n1,500;1\n", "line 3, column t: 1,500 has a comma, which may be of a decimal or of thousands"),
        (HEAD + "t,R11\n0,5,1,0\n", "line 3: 4 cells where the line of names has 2; separate cells with decimal"),
        (HEAD + "t,R11\n0,nan\n", "no row with all its numbers: 1 lack one"),
        (HEAD + "t,R11\n0,1\N{NO-BREAK SPACE}000\n", r"'1\\xa0000' is not a number; it has a no-break space"),
        ("log of today\nt,R11\n0,1\n", "line 1: there is no column t; .* begin lines above the names of columns"),
        ("millis,R11\n0,1\n", r"the time is called t, with its unit, as t \[ms\]"),
        ("timestamp,R11\n0,1\n", r"timestamp has no unit; call it t \[s\], t \[ms\]"),
        (HEAD + "t,R11\ninf,1\n", "line 3, column t: the cell is inf"),
        ("# field = 1\nt,R11\n0,1\n", "line 1: field takes 2 or 3 numbers, not 1"),
        ("# ratio = ?\nt,R11\n0,1\n", "line 1, parameter ratio"),
        ("t,R11\n0,1\n", "ratio is missing: give --ratio, or a line"),
        ("# ratio = 1.5\n# omega2 = 1\nt,R11\n0,1\n", "field is missing: give --field"),
        ("# ratio = 3\n# field = 1 2\n# omega2 = 1\nt,R11\n0,1\n", "No body has I"),
        ("# inertia = 0 1\n# field = 1 2\n# omega2 = 1\nt,R11\n0,1\n", "I2 must be positive"),
        ("# ratio = 1.5\n# field = 1 2\n# omega2 = -1\nt,R11\n0,1\n", "pole"),
        (HEAD + "t,R11\n0,1_0\n", "line 3, column R11: '1_0' is not a number"),
        (HEAD + "t,R11\n0,\N{ARABIC-INDIC DIGIT ONE}\n", "line 3, column R11: .* is not a number"),
        (HEAD + "t,R11\n0,1e999\n", "line 3, column R11: the cell is 1e999"),
        (HEAD + "# inertia = 2 3\nt,R11\n0,1\n", "by ratio and by inertia: leave one of them out"),
        (HEAD + "# omega2 = 0.8\nt,R11\n0,1\n", "line 2: omega2 is there twice, with other numbers"),
        (HEAD + "t,R11\n0,1\n# omega2 = 0.8\n1,1\n", "line 4: a parameter stands below the line of names"),
        ("# ratio: 1.5 roughly\nt,R11\n0,1\n", "line 1, parameter ratio: 'roughly' is not a number"),
    ],
)
def test_a_malformed_file_is_refused_in_one_sentence(write: Writer, text: str, words: str) -> None:
    """The sentence says which line and which column."""
    with pytest.raises(AtlasError, match=words) as caught:
        check(write(text))
    assert "\n" not in str(caught.value)


def test_a_comment_may_begin_like_a_parameter(write: Writer) -> None:
    """After a colon words are words; a byte order mark is no part of a line; the same parameter twice is no quarrel."""
    text = "\ufeff# field: along e3\n# ratio of inertia = none\n" + HEAD + "# omega2: 0.7\n" + "t,R11\n0,1\n# end\n"
    assert check(write(text)).parameters == {"ratio": 1.5, "field": [1.0, 2.0], "omega2": 0.7}


@pytest.mark.parametrize("delimiter", [" ", ",", ";"])
def test_a_file_of_numpy_is_read(tmp_path: Path, delimiter: str) -> None:
    """It has the names of its columns behind a #, and other words there are a comment."""
    rows = np.array([[t, *true_row(t)[:9]] for t in TIMES])
    names = delimiter.join(["t", *MATRIX])
    path = tmp_path / "numpy.csv"
    np.savetxt(path, rows, delimiter=delimiter, header=f"ratio = 1.5; field = 1 2; omega2 = 0.7\nt is time\n{names}")
    assert [column.name for column in check(path).columns] == [*MATRIX]


@pytest.mark.parametrize(
    ("heads", "separator", "factors"),
    [
        (("t [s]", "Omega1 [1/s]", "Omega2 [rad/s]", "Omega3"), " ", (1.0, 1.0)),
        (("t [time]", "Omega1 [1/time]", "Omega2[1/time]", '"Omega3 [1/time]"'), ",", (1.0, 1.0)),
        (("time [ms]", "omega_1 [Hz]", "omega_2 [Hz]", "omega_3 [Hz]"), ";", (1e3, 1 / (2 * math.pi))),
    ],
)
def test_columns_may_have_units(write: Writer, heads: list[str], separator: str, factors: tuple[float, float]) -> None:
    """They are those of lists of a sweep: times in s, rates in rad/s, others are converted."""
    rows = [[factors[0] * t, *(factors[1] * x for x in true_row(t)[9:])] for t in TIMES]
    result = check(write(HEAD + table(list(heads), rows, separator)))
    assert min(c.worst for c in result.columns) > 13.5


def test_numbers_in_any_notation_are_the_same(write: Writer) -> None:
    """Numbers that JSON lacks, 1. or +1 or .5, are read as others are; separators and blank lines change nothing."""
    rows = [check(write(HEAD + text)) for text in ("t,R13\n1.0,0.5\n2,-1\n", "t;R13\n+1.;.5\n\n# x\n 2.\t;-01\n")]
    assert rows[0] == rows[1]


@pytest.fixture(scope="module")
def long_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Write 5000 rows with the errors of a code that drifts, by both R and Omega, times up to 1e9."""
    motion, rng = ElementaryMotion(1.5, (1.0, 2.0), 0.7), np.random.default_rng(0)
    t = np.sort(rng.uniform(0, 1e9, 5000))
    drift = 1e-15 * (1 + 1e-4 * t[:, None]) * rng.normal(size=(5000, 12))
    values = np.column_stack([motion.rotation(t).reshape(-1, 9), motion.angular_velocity(t)]) + drift
    path = tmp_path_factory.mktemp("check") / "long.csv"
    path.write_text(HEAD + table(["t", *MATRIX, *OMEGA], np.column_stack([t, values]).tolist()), encoding="utf-8")
    return path


def test_grades_do_not_depend_on_the_size_of_blocks(long_file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Digits, failures, drifts and the curve are the same in one block and in blocks of 97 lines."""
    result = check(long_file, threshold=11)
    monkeypatch.setattr(trajectory, "BLOCK", 97)
    assert check(long_file, threshold=11) == result


@pytest.mark.slow
def test_the_balls_agree_with_the_blocks_and_are_asked_seldom(long_file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Graded by balls alone every column has the same grade; with blocks, balls decide fewer than 1 row in 20."""
    times_certified, certified = [], grades.Errors.certified
    monkeypatch.setattr(grades.Errors, "certified", lambda *row: times_certified.append(row) or certified(*row))
    blocks = check(long_file, threshold=12)
    assert len(times_certified) < 250
    monkeypatch.setattr(truth, "EXTENDED", False)
    balls = check(long_file, threshold=12)
    assert len(times_certified) > 5000
    for ours, theirs in zip(blocks.columns, balls.columns, strict=True):
        assert (ours.worst, ours.worst_time, ours.fails_at) == (theirs.worst, theirs.worst_time, theirs.fails_at)
        assert ours.median == pytest.approx(theirs.median, abs=0.0011)


def test_a_curve_keeps_the_largest_errors_of_its_rows() -> None:
    """However many rows, no more than 4096 points; each has the largest error of its rows and their first time."""
    envelope, rng = grades.Envelope(), np.random.default_rng(1)
    t, errors = np.arange(30011.0), rng.random((2, 30011))
    for piece in np.array_split(np.arange(30011), 37):
        envelope.add(t[piece], {"R11": errors[0, piece], "R12": errors[1, piece]})
    assert envelope.rows == 8
    assert envelope.times() == t[::8].tolist()
    largest = [float(errors[:, i : i + 8].max()) for i in range(0, 30011, 8)]
    assert envelope.errors() == {"R": largest}


@pytest.mark.slow
@settings(max_examples=60)
@example("omega2 near -(2-I) B2", 1643)  # a phase of 2^22, which three words hold to 2^-59
@given(st.sampled_from(sorted(REGIMES)), st.integers(0, 10**6))
def test_reference_values_of_blocks_are_within_2e_18_of_the_balls(regime: str, seed: int) -> None:
    """R, Omega in units of its length, and the quaternion are within UNCERTAINTY of the balls, on extreme inputs."""
    inputs = extreme.motion(regime, Random(seed))  # noqa: S311  reproducible, not secret
    motion = exact.ElementaryMotion(inputs.exact_ratio, (inputs.B2, inputs.B3), inputs.omega2, inputs.omega3)
    checker = truth.Truth(motion)
    t = np.array(inputs.times)
    t = t[checker.within(t)]
    length = np.hypot(checker.omega2, checker.omega3) or 1
    for time, R, Omega, q in zip(t.tolist(), *checker.values(t), strict=True):
        balls = enclosed(lambda time=time: (motion.rotation(time), motion.angular_velocity(time)), 90)
        turned = enclosed(lambda time=time: motion.quaternion(time), 90)
        same = (
            1
            if sum(float(a) * float(b.mid() if isinstance(b, arb) else arb(b)) for a, b in zip(q, turned, strict=False))
            > 0
            else -1
        )
        assert max(map(difference, R, chain(*balls[0]))) <= truth.UNCERTAINTY
        assert max(map(difference, Omega, balls[1])) <= truth.UNCERTAINTY * float(length)
        assert max(difference(same * a, b) for a, b in zip(q, turned, strict=True)) <= truth.UNCERTAINTY


def difference(found: np.longdouble, ball: Any) -> float:
    """Return the distance of a long double from a ball."""
    head = float(found)
    with ctx.workprec(120):
        return float(abs(arb(head) + arb(float(found - np.longdouble(head))) - ball).upper())


def test_a_binary_file_is_no_trajectory(tmp_path: Path) -> None:
    """Bytes that are no text are refused by name."""
    path = tmp_path / "plot.png"
    path.write_bytes(b"\x89PNG\xff\xfe\x00")
    with pytest.raises(AtlasError, match=r"plot\.png is not a text file"):
        check(path)


@pytest.mark.parametrize(("name", "printed"), [(":smile:.csv", ":smile:.csv"), ("[b]\x1b[2J\n", "[b]\ufffd[2J\ufffd")])
def test_the_name_of_a_file_is_printed_as_it_is(tmp_path: Path, name: str, printed: str) -> None:
    """No markup, no picture, nothing that a terminal obeys."""
    path = tmp_path / name
    path.write_text(SETTING + table(["t", *MATRIX], [[t, *true_row(t)[:9]] for t in TIMES]), encoding="utf-8")
    done = CliRunner().invoke(program, ["check", str(path)])
    assert done.output.startswith(f"{printed}: {len(TIMES)} rows")


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


def test_a_body_without_symmetry_is_tested_by_its_integrals(write: Writer) -> None:
    """With three moments or a whole tensor no column is graded, and H, F, (M, K), K^2 and T are held constant."""
    import atlas

    tensor = np.array([[2.0, 0.3, -0.1], [0.3, 1.5, 0.2], [-0.1, 0.2, 1.7]])
    run = atlas.simulate(tensor, (0.3, 1.0, -2.0), (0.4, 0.5, -0.6), np.linspace(0, 20, 21), rtol=1e-12, atol=1e-14)
    rows = [[t, *R.ravel(), *Omega] for t, R, Omega in zip(run.t.tolist(), run.R, run.Omega, strict=True)]
    rows = [[float(x) for x in row] for row in rows]
    head = "# inertia = 2 1.5 1.7 0.3 -0.1 0.2\n# field = 0.3 1 -2\n"
    result = check(write(head + table(["t", *MATRIX, *OMEGA], rows)))
    assert result.columns == ()
    drifts = {d.name: d.worst for d in result.drifts}
    assert set(drifts) == {"R^T R", "H", "F", "(M,K)", "K^2", "T"}
    assert max(drifts.values()) < 1e-9
    wrong = check(write("# inertia = 2 1.5 1.6\n# field = 0.3 1 -2\n" + table(["t", *MATRIX, *OMEGA], rows)))
    assert {d.name: d.worst for d in wrong.drifts}["F"] > 1e-3
    with pytest.raises(AtlasError, match="without an error to plot"):
        result.scene()
    with pytest.raises(AtlasError, match="only the integrals can be tested"):
        check(write(head + table(["t", *OMEGA], [[row[0], *row[10:]] for row in rows])))


def test_three_moments_are_a_diagonal_tensor(write: Writer) -> None:
    """A body by I1, I2, I3 drifts as one by the six elements of its tensor, and another by other elements."""
    rows = [[t, *true_row(t)] for t in TIMES]
    text = table(["t", *MATRIX, *OMEGA], rows)
    result, second, third = (
        check(write(f"# inertia = {inertia}\n# field = 1 2\n" + text))
        for inertia in ("2 2.5 3", "2 2.5 3 0 0 0", "2 2.5 3 0.1 0 0")
    )
    assert result.drifts == second.drifts != third.drifts
    assert result.rows == len(TIMES)
    assert result.columns == ()


def general_table(omega: tuple[float, float, float], worse: float = 0.0) -> str:
    """Write the general motion of SETTING's body and field, one entry falsified by ``worse``."""
    motion, t = GeneralMotion(1.5, (1, 2), omega), np.array(TIMES)
    R, Omega = motion.rotation(t).reshape(-1, 9), motion.angular_velocity(t)
    R[3, 4] += worse
    return table(["t", *MATRIX, *OMEGA], np.column_stack([t, R, Omega]).tolist())


def test_a_general_trajectory_is_graded(write: Writer) -> None:
    """With three components of omega, in the file or as an option, the kernels have 15 digits, and 1e-8 is found."""
    omega = (0.3, 0.7, 0.2)
    head = "# ratio = 1.5\n# field = 1 2\n"
    true = check(write(head + "# omega = 0.3 0.7 0.2\n" + general_table(omega)))
    assert true.case == "nutation, four real roots"
    assert true.parameters == {"ratio": 1.5, "field": [1.0, 2.0], "omega": list(omega)}
    assert min(column.worst for column in true.columns) >= 14.8
    assert max(drift.worst for drift in true.drifts) <= 1e-14
    result = check(write(head + general_table(omega, 1e-8)), omega=omega, threshold=9.0)
    (found,) = [column for column in result.columns if column.fails_at is not None]
    assert (found.name, found.fails_at) == ("R22", TIMES[3])
    assert found.worst == pytest.approx(8, abs=1e-6)


def test_the_start_is_given_once(write: Writer) -> None:
    """Three components of omega beside omega2 are refused, among the options and in a file."""
    text = SETTING + general_table((0.3, 0.7, 0.2))
    with pytest.raises(AtlasError, match="given twice"):
        check(write(text), omega=(0.3, 0.7, 0.2), omega2=0.7)
    with pytest.raises(AtlasError, match="twice"):
        check(write("# omega = 0.3 0.7 0.2\n" + text))


def test_a_table_is_read_from_a_pipe(tmp_path: Path) -> None:
    """As of `program | atlas check /dev/stdin`: it is opened once, and its first bytes are not lost."""
    table = "t,R11\n" + 40 * "0,1\n"
    os.mkfifo(pipe := tmp_path / "pipe")
    with ThreadPoolExecutor(1) as writer:
        writer.submit(pipe.write_text, table)
        with trajectory.opened(pipe) as read:
            assert sum(len(block["t"]) for block in read.blocks) == 40
