"""Bodies with three moments in units of their own: point masses from a file, B in tesla with a charge and a mass."""

import gc
import json
import re
from fractions import Fraction
from pathlib import Path
from typing import Any
from urllib.parse import parse_qs

import click
import numpy as np
import pytest
from click.testing import CliRunner
from scipy.spatial.transform import Rotation

import atlas
from atlas.cli.app import atlas as command
from atlas.cli.app import main
from atlas.cli.body_request import COMMANDS, ByOptions
from atlas.cli.body_request import report_request as page_asked
from atlas.cli.explore import started
from atlas.cli.points import oblique_tensor
from atlas.cli.typed import REAL, Typed
from atlas.errors import NearlySymmetricWarning
from atlas.motions.register import FAMILIES as REGISTER
from atlas.sweeps.families import FAMILIES

POINTS = np.array(
    [
        [1.0, 0.0, 0.0, 1.0, 1e-3],
        [-1.0, 0.0, 0.0, 1.0, 1e-3],
        [0.0, 2.0, 0.0, 0.5, 5e-4],
        [0.0, -2.0, 0.0, 0.5, 5e-4],
        [0.0, 0.0, 0.5, 2.0, 2e-3],
        [0.0, 0.0, -0.5, 2.0, 2e-3],
    ]
)
"""Point masses with the moments 5, 3, 6 about their centre, and a charge of 1e-3 of each mass."""

REST = "--omega 0.3 0.7 0.2 --times 1 --json"


def points_file(folder: Path, points: np.ndarray = POINTS, names: str = "x,y,z,mass,charge") -> str:
    """Write points, and return the name of the file."""
    path = folder / "points.csv"
    rows = [",".join(map(repr, row)) for row in points[:, : names.count(",") + 1].tolist()]
    path.write_text("\n".join([names, *rows]) + "\n", encoding="utf-8")
    return str(path)


def run(*words: str) -> tuple[int, str]:
    """Return status and output of a command, of which a file's name may have blanks."""
    outcome = CliRunner().invoke(command, list(words))
    return outcome.exit_code, outcome.output


def numbers(*words: str) -> dict[str, Any]:
    """Return a command's output as JSON without its parameters."""
    status, out = run(*words)
    assert status == 0, out
    return {name: value for name, value in json.loads(out).items() if name != "parameters"}


def test_a_symmetric_body_is_printed_in_its_own_and_in_the_given_axes() -> None:
    """The table has m over I2 in any axes; where the axis is not e3, it is said along which axes Omega3 is."""
    start = "--omega 1 2 3 --times 0".split()
    for inertia in ("--inertia 2 2 3", "--shape ring --radius 2"):
        words = "motion", *inertia.split(), *start
        m = [numbers(*words, "--field", *B.split(), "--json")["samples"][0]["m"] for B in ("0 1 2", "1e-30 1 2")]
        plane = numbers("motion", *inertia.replace("2 2 3", "2 3").split(), *start, "--field", "1", "2", "--json")
        assert np.allclose(m, plane["samples"][0]["m"], rtol=1e-14)
    two, three = (
        numbers("motion", *f"--inertia {J} --field 0.5 1 2".split(), *start, "--json") for J in ("2 3", "2 2 3")
    )
    assert two == three
    upright, lying = (run("motion", *f"--inertia {J} --field 0 1 2".split(), *start)[1] for J in ("1 1 .5", ".5 1 1"))
    assert "are along the axes" not in upright
    assert "(1, 0, 0) of the body, the last that of symmetry; columns along the axes given." in lying


@pytest.mark.slow
def test_points_and_tesla_give_moments_and_rates(tmp_path: Path) -> None:
    """Moved as a whole the points have their moments; B of 100, 200, 2000 T at 1e-3 C/kg is B' = (0.05, 0.1, 1) /s."""
    typed_record = numbers("motion", *"--inertia 5 3 6 --field 0.05 0.1 1".split(), *REST.split())
    moved_points = POINTS + np.array([8.0, -4.0, 2.0, 0.0, 0.0])
    tesla = "--magnetic 100 200 2000".split()
    units = "--magnetic 100 200 2000 --mass 2 --charge 2e-3".split()
    for body in (["--points", points_file(tmp_path, moved_points), *tesla], ["--inertia", "5", "3", "6", *units]):
        record = numbers("motion", *body, *REST.split())
        assert record["family"] == typed_record["family"]
        R, true = (np.array(x["samples"][0]["R"]) for x in (record, typed_record))
        assert np.abs(R - true).max() <= 1e-14  # 1e-3 times 100 over 2 is no float


def test_the_unit_of_time_is_a_second_where_the_field_is_in_tesla() -> None:
    """Rates are per second and not per unit of time then, in the heading and beside the quantities."""
    words = "elliptic --inertia 5 3 6 --magnetic 1 2 3 --mass 1 --charge 1 --z 1.7 --times 1".split()
    status, out = run(*words)
    assert status == 0
    assert "[1/s]" in out
    assert "1/s^2" in out
    assert "/time" not in out


@pytest.mark.slow
def test_principal_axes_are_named_where_the_file_has_others(tmp_path: Path) -> None:
    """Points turned by 30 degrees about z: it says the axes, right-handed, and the moments 3, 5, 6."""
    c, s = np.sqrt(3) / 2, 0.5
    turned_points = POINTS.copy()
    turned_points[:, :3] = POINTS[:, :3] @ np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
    record = numbers(
        "motion", "--points", points_file(tmp_path, turned_points), "--field", "0", "1", "2", *REST.split()
    )
    axes = np.array(record["principal_axes"])
    assert np.linalg.det(axes) == pytest.approx(1, abs=1e-15)
    assert abs(axes[:, :2]) == pytest.approx(np.array([[s, c], [c, s], [0, 0]]), abs=1e-15)
    assert record["principal_moments"] == pytest.approx([3, 5, 6], rel=1e-15)


def turned_digits(digits: list[list[str]], turn: list[list[Fraction]], matrix: list[list[Fraction]]) -> list[Any]:
    """Return turn R other of printed digits, as fractions."""
    R = [[Fraction(x) for x in row] for row in digits]
    once = [[sum(a * b for a, b in zip(row, column, strict=True)) for column in zip(*R, strict=True)] for row in turn]
    columns = list(zip(*matrix, strict=True))
    return [[sum(a * b for a, b in zip(row, column, strict=True)) for column in columns] for row in once]


@pytest.mark.slow
def test_digits_are_proven_in_any_axes_and_from_any_attitude() -> None:
    """A tensor and an attitude of rational turns have the digits of the motion along its principal axes from R(0)=1."""
    turn = [[Fraction(x) for x in row] for row in (("0.6", "0.8", "0"), ("-0.8", "0.6", "0"), ("0", "0", "1"))]
    back, unit = [list(x) for x in zip(*turn, strict=True)], [[Fraction(i == j) for j in range(3)] for i in range(3)]
    options = "--times 3 --digits 25 --decimal --json".split()
    words = "--tensor 1.64 1.36 2.5 -0.48 0 0 --field 0.3 0.1 1 --omega 0.2 0.3 1".split()
    own_words = "--inertia 1 2 2.5 --field 0.26 -0.18 1 --omega 0.36 0.02 1".split()
    from_attitude = "--inertia 1 2 2.5 --field 0.3 -0.584 0.83 --omega 0.2 0.3 1 --attitude 0.6 0 0 0.8".split()
    entries, true = (numbers("motion", *x, *options)["samples"][0]["R"] for x in (words, own_words))
    for digits, digits_true in zip(entries, turned_digits(true, back, turn), strict=True):
        assert all(abs(Fraction(x) - y) < Fraction(1, 10**23) for x, y in zip(digits, digits_true, strict=True))
    start = [[Fraction(x) for x in row] for row in (("1", "0", "0"), ("0", "0.28", "-0.96"), ("0", "0.96", "0.28"))]
    B = [Fraction(x) for x in from_attitude[5:8]]
    K = [sum(row[i] * x for row, x in zip(start, B, strict=True)) for i in range(3)]
    free_words = [*"--inertia 1 2 2.5 --omega 0.2 0.3 1 --field".split(), *(str(x) for x in K)]
    entries, true = (numbers("motion", *x, *options)["samples"][0]["R"] for x in (from_attitude, free_words))
    for digits, digits_true in zip(entries, turned_digits(true, start, unit), strict=True):
        assert all(abs(Fraction(x) - y) < Fraction(1, 10**23) for x, y in zip(digits, digits_true, strict=True))


def test_an_attitude_is_evaluated_as_typed() -> None:
    """At t = 1e8 doubles from an attitude whose length is not 1 have the proven digits; matrices stay as they are."""
    words = "motion --inertia 1 1 1.5 --attitude 0.6 0 0 0.8 --field .3 .1 1 --omega .2 .3 1 --times 1e8 --json"
    entries, proven = (numbers(*words.split(), *option)["samples"][0]["R"] for option in ([], ["--digits", "17"]))
    assert np.array(entries) == pytest.approx(np.array(proven, float), abs=4e-15)
    for R in Rotation.random(20, random_state=1).as_matrix():
        assert (atlas.motion(1.5, (0.3, 1, 2), (0.3, 0.7, 0.2), R).rotation(0.0) == R).all()


@pytest.mark.slow
def test_points_without_charges_are_a_body(tmp_path: Path) -> None:
    """They serve with --field."""
    file = points_file(tmp_path, names="x,y,z,mass")
    assert numbers("motion", "--points", file, "--field", "0", "1", "2", *REST.split())["kind"] == "on a torus"


@pytest.mark.slow
def test_a_simulation_is_checked_in_tesla(tmp_path: Path) -> None:
    """`atlas check` takes the same body and field; at t = 0 R = 1 and Omega = omega."""
    trajectory = tmp_path / "mine.csv"
    trajectory.write_text("t,R11,R12,Omega3\n0,1,0,0.2\n", encoding="utf-8")
    words = "--magnetic 100 200 2000 --omega 0.3 0.7 0.2 --json".split()
    status, out = run("check", str(trajectory), "--points", points_file(tmp_path), *words)
    assert status == 0
    record = json.loads(out)
    assert record["parameters"] == {"inertia": [5.0, 3.0, 6.0], "field": [0.05, 0.1, 1.0], "omega": [0.3, 0.7, 0.2]}
    assert [column["name"] for column in record["columns"]] == ["R11", "R12", "Omega3"]


@pytest.mark.slow
def test_frequencies_or_the_reason_for_none_are_printed() -> None:
    """A motion on a torus prints its three; of a symmetric body proven digits say that it has no torus."""
    words = "--field 0.2 1 0.6 --omega 1 2 3"
    status, out = run("motion", *f"--inertia 1 1.2 1.3 {words}".split())
    assert status == 0
    assert re.search(r"^f3 +-1\.154812784 +1/time", out, re.MULTILINE)
    record = numbers("motion", *f"--inertia 1 1 1.3 {words} --json --digits 9".split())
    assert "frequencies" not in record
    assert record["missing"]["frequencies"].startswith("There is no torus with three frequencies")


@pytest.mark.slow
def test_a_tensor_in_any_axes_agrees_with_its_principal_moments(tmp_path: Path) -> None:
    """Points turned by 30 degrees about z, or their tensor, in a field turned with them: the turned motion."""
    c, s = np.sqrt(3) / 2, 0.5
    P = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    turned_points = POINTS.copy()
    turned_points[:, :3] = POINTS[:, :3] @ P.T
    B, omega = P @ (0.05, 0.1, 1.0), P @ (0.3, 0.7, 0.2)
    J = P @ np.diag([5.0, 3.0, 6.0]) @ P.T
    places = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
    options = ["--field", *map(repr, B.tolist()), "--omega", *map(repr, omega.tolist()), "--times", "1", "--json"]
    records = [
        numbers("motion", *words, *options)
        for words in (
            ("--points", points_file(tmp_path, turned_points)),
            ("--tensor", *(repr(float(J[ij])) for ij in places)),
        )
    ]
    true = numbers("motion", *"--inertia 5 3 6 --field 0.05 0.1 1".split(), *REST.split())["samples"][0]
    for record in records:
        assert record["family"] == "asymmetric"
        assert record["principal_moments"] == pytest.approx([3, 5, 6], abs=1e-12)
        R, Omega = (np.array(record["samples"][0][name]) for name in ("R", "Omega"))
        assert pytest.approx(P @ np.array(true["R"]) @ P.T, abs=1e-12) == R
        assert Omega == pytest.approx(P @ np.array(true["Omega"]), abs=1e-12)
    status, out = run("motion", *"--tensor 1 1 1 0 0 0.2 --field 0 0 1 --spin 3 --times 0 1".split())
    assert status == 0
    assert "Computed in doubles" in out


def test_one_command_takes_any_body_and_any_start() -> None:
    """It says which family it found, and its help has the options of all."""
    for words, family in (
        ("--ratio 1.5 --field 1 2 --omega2 0.7", "elementary"), ("--ratio 1.5 --field 1 2 --omega 0 0.7 1", "general"),
        ("--shape ring --radius 1 --field 1 2 --spin 3", "general"), ("--ratio 1 --field 1 1 2 --spin 3", "ball"),
        ("--tensor 1 1 1.5 0 0 0 --field 0 0 0 --spin 1", "free"),
        ("--tensor 1 1 1.5 0 0 0 --field 0 1 1 --spin 1", "general"),
    ):  # fmt: skip
        assert numbers("motion", *words.split(), "--json")["family"] == family
        assert run("motion", *words.split())[1]
    help_text = run("motion", "--help")[1]
    for option in ("I2 I3 or I1 I2 I3", "--tensor", "--omega2", "--spin"):
        assert option in help_text


def test_a_symmetric_body_in_any_field_is_turned_into_the_plane_of_the_paper() -> None:
    """Late, too, where certified steps give no quaternion: `atlas.motion` has one; proven digits are of balls."""
    words = "motion --inertia 1 1 1.5 --field 0.3 1 2 --omega 0.3 0.7 0.2 --times".split()
    late = numbers(*words, "1e6", "--json")["samples"][0]
    R = atlas.motion((1, 1, 1.5), (0.3, 1, 2), (0.3, 0.7, 0.2)).rotation(1e6)
    assert R.tolist() == late["R"]
    assert pytest.approx(R, abs=1e-14) == Rotation.from_quat(late["q"]).as_matrix()
    soon = [numbers(*words, "1", "--json", *option)["samples"][0]["R"] for option in ([], ["--digits", "12"])]
    assert np.array(soon[0]) == pytest.approx(np.array(soon[1], float), abs=1e-12)
    assert "no digit is proven without --digits" in run(*words, "1")[1]


@pytest.mark.slow
def test_units_agree_with_si() -> None:
    """A cylinder in um, kg/m3, e, T and degrees is that in SI by hand, and turns a second are 2 pi as many radians."""
    words_typed = (
        "motion --shape solid-cylinder --radius 1.2um --height 3um --density 1850kg/m3 --charge 5000e --magnetic 0.8T "
        "--angle 30deg --spin 2MHz --times 1ms --json"
    )
    mass = 1850 * np.pi * 1.2e-6**2 * 3e-6
    b = 5000 * 1.602176634e-19 / mass * 0.8 / 2
    ratio = 1 / (0.5 + (3 / 1.2) ** 2 / 6)
    by_hand = f"motion --ratio {ratio!r} --field {b / 2!r} {b * 0.75**0.5!r} --spin {4e6 * np.pi!r} --times 1e-3 --json"
    record, true = numbers(*words_typed.split()), numbers(*by_hand.split())
    assert record["precession_rate"] == pytest.approx(true["precession_rate"], rel=1e-9)
    assert record["spin_rate"] == pytest.approx(true["spin_rate"], rel=1e-14)
    assert run(*words_typed.replace("30deg", "30°").split()) == run(*words_typed.split())
    assert np.array(record["samples"][0]["R"]) == pytest.approx(np.array(true["samples"][0]["R"]), abs=1e-9)
    assert "2MHz is 12566370.61 rad/s." in run(*words_typed.removesuffix("--json").split())[1]


@pytest.mark.parametrize(
    ("one", "words_other"),
    [
        ("--ratio 1.5 --field 5/s 3e-3/s --omega2 0.7/s", "--ratio 1.5 --field 5 3e-3 --omega2 0.7"),
        (
            "--ratio 1.5 --mu 2C/kg --magnetic 0.5T 10000G",
            "--ratio 1.5 --charge-to-mass 2 --magnetic 0.5 1 --units si --omega2 0.7",
        ),
        ("--inertia 2g*m^2 3g*m2 --field 1 2", "--inertia 2e-3 3e-3 --field 1 2"),
        (
            "--ratio 1.5 --field 90deg/s 1rad/s --omega2 0.7Hz",
            f"--ratio 1.5 --field {np.pi / 2!r} 1 --omega2 {1.4 * np.pi!r}",
        ),
        ("--ratio 1.5 --field 1rev/s 60rpm --omega2 6rpm", "--ratio 1.5 --field 1Hz 1Hz --omega2 0.1Hz"),
        (
            "--ratio 1.5 --field 2 --angle 90deg --omega2 0.7",
            "--ratio 1.5 --field 2 1.2246467991473532e-16 --omega2 0.7",
        ),
    ],
)
def test_numbers_with_units_equal_numbers_in_si(one: str, words_other: str) -> None:
    """Prefixes, powers and quotients; where no quantity of the kind has a unit, a bare number is in SI."""
    record, true = (
        numbers("motion", *f"--omega2 0.7 {words} --times 1 --json".split()) for words in (one, words_other)
    )
    assert record["k"] == pytest.approx(true["k"], rel=1e-15)


@pytest.mark.parametrize(
    ("words", "plain"),
    [
        ("motion --ratio 1.5 --magnetic 1T --angle 0deg --mu 1C/kg --omega 0.1 0.3 0Hz", {"0deg": "0", "0Hz": "0"}),
        ("motion --ratio 1.5 --magnetic 0T 1T --mu 1C/kg --spin 0Hz", {"0T": "0", "0Hz": "0"}),
        ("motion --ratio 1.5 --field 1 2 --omega2 0.7 --times 0:1s:3", {"0:1s:3": "0s 500ms 1s"}),
        ("motion --ratio 1.5 --field 1 2 --omega2 0.7 --grid 0:1ms:2", {"--grid": "--times", "0:1ms:2": "0s 1ms"}),
        ("particle --mu 1C/kg --electric 0V/m 5V/m 0V/m --magnetic 0 0T 1T", {"0V/m": "0", "0T": "0"}),
    ],
)
def test_a_zero_without_a_unit_may_stand_beside_units(words: str, plain: dict[str, str]) -> None:
    """It is that without: beside other numbers with units, in a range of times and among several."""
    words_plain = " ".join(plain.get(word, word) for word in words.split())
    assert words_plain != words
    assert numbers(*words.split(), "--json") == numbers(*words_plain.split(), "--json")


def test_help_and_list_take_a_name() -> None:
    """`atlas help motion` is its help, `atlas list shapes` the one list."""
    assert run("help", "motion")[1] == run("motion", "--help")[1]
    assert run("help")[1] == run("--help")[1]
    listing = run("list", "shapes")[1]
    assert "solid-cylinder" in listing
    assert "figure" not in listing
    assert json.loads(run("list", "reports", "--json")[1])["reports"]


@pytest.mark.parametrize("start", ["--ratio 1.5 --omega 0.1 0.2 0.3", "--inertia 1 2 2.5 --spin 0.4"])
def test_a_start_without_a_field_is_a_free_body(start: str) -> None:
    """A start along three axes needs no field: JSON and table are those of the field zero."""
    zeros = "--field 0 0 0" if "inertia" in start else "--field 0 0"
    for form in ("--json", "--times 1"):
        free_output, zero_output = (
            run("motion", *words.split(), *form.split()) for words in (start, f"{start} {zeros}")
        )
        assert free_output == zero_output
        assert free_output[0] == 0


@pytest.mark.slow
def test_the_table_of_a_tensor_has_its_principal_moments() -> None:
    """The printed moments and axes are those of the JSON."""
    words = "motion --tensor 1 1.2 1.1 .1 0 .05 --field 0 0 1 --omega .1 .2 .3".split()
    table, record = run(*words)[1], json.loads(run(*words, "--json")[1])
    lines = {line.split()[0]: line for line in table.splitlines() if line}
    for i, (moment, axis) in enumerate(zip(record["principal_moments"], record["principal_axes"], strict=True), 1):
        assert f" {moment:.10g} " in lines[f"I{i}"]
        assert f"({', '.join(f'{x:.10g}' for x in axis)})" in lines[f"I{i}"]


@pytest.mark.parametrize(
    ("name", "entry", "words"),
    [
        ("tables", "motion", "omega2*"),
        ("families", "elliptic", "z*"),
        ("quantities", "precession_rate", "[1/time]"),
        ("roles", "field", "#"),
        ("commands", "sweep", "parameters"),
    ],
)
def test_each_list_names_its_entries_with_their_keys(name: str, entry: str, words: str) -> None:
    """`atlas list tables` and so on print each entry with its keys or its meaning, and JSON has the same names."""
    lines = run("list", name)[1].splitlines()
    record = json.loads(run("list", name, "--json")[1])
    assert record.keys() == {name}
    start = next(i for i, line in enumerate(lines) if line.startswith(f"{entry} "))
    assert words in " ".join(lines[start : start + 4])
    assert set(record[name]) <= {line.split(" ")[0] for line in lines}


@pytest.mark.parametrize(
    "times", ["--times 0,0.5,1", "--times 0 0.5,1", "--grid 0 0.5 3", "--grid 0:1:3", "--times 0:1:3"]
)
def test_lists_and_ranges_give_the_same_times(times: str) -> None:
    """Words, commas, a range and a grid give the same times; even steps of the logarithm their powers."""
    words = "motion --ratio 1.5 --field 1 2 --omega2 0.7"
    samples = numbers(*words.split(), *times.split(), "--json")["samples"]
    assert [sample["t"] for sample in samples] == [0.0, 0.5, 1.0]
    samples = numbers(*words.split(), *"--times 1:100:3:log --json".split())["samples"]
    assert [sample["t"] for sample in samples] == pytest.approx([1, 10, 100])
    for times_typed in ("--times 1ms:3ms:3", "--grid 1ms 1ms 3", "--times 1ms 2ms 3ms"):
        samples = numbers(*words.split(), *times_typed.split(), "--json")["samples"]
        assert [row["t"] for row in samples] == [1e-3, 2e-3, 3e-3]
        assert "Omega_i [1/s]" in run(*words.split(), *times_typed.split())[1]
    assert "Omega_i [1/s]" in run(*words.split(), *"--times 1ms:1s:4:log".split())[1]


def test_a_range_of_times_equals_its_list() -> None:
    """START:STOP:COUNT has both ends, beside single times, exact where decimals are not."""
    words = "motion --ratio 1.5 --field 1 2 --omega2 0.7 --json --times".split()
    assert numbers(*words, "0:0.3:4", "7") == numbers(*words, "0", "0.1", "0.2", "0.3", "7")


def test_a_long_range_is_read_by_one_division_each(monkeypatch: pytest.MonkeyPatch) -> None:
    """The first row of many is printed at once: a range takes no fraction's product or sum for each of its numbers."""
    option, start, step = click.Option(["--times"], multiple=True, type=REAL), Fraction(1, 3), Fraction(-7, 3000)
    expected = [float(start + i * step) for i in range(2001)]
    sums, add = list[Fraction](), Fraction.__add__
    monkeypatch.setattr(Fraction, "__add__", lambda x, y: sums.append(x) or add(x, y))
    assert [*REAL.convert("1/3:-13/3:2001", option, None)] == expected
    assert len(sums) < 10


def test_logarithmic_ranges_have_exact_ends_and_powers_of_ten() -> None:
    """Even steps of the logarithm have both ends as typed, and powers of ten between these."""
    option = click.Option(["--times"], multiple=True, type=REAL)
    assert [*REAL.convert("1:1000:4:log", option, None)] == [1, 10, 100, 1000]
    assert [*REAL.convert("-3e-300:-3e300:3:log", option, None)] == pytest.approx([-3e-300, -3, -3e300], rel=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("start", ["--omega 0 0.7 1", "--omega 0 0.7 1 --attitude 0 0 0 1"])
@pytest.mark.parametrize("times", ["--times 0:10:200000", "--grid 0 1e-3 200000"])
def test_few_rows_are_computed_beyond_those_printed(monkeypatch: pytest.MonkeyPatch, start: str, times: str) -> None:
    """A reader who goes after the first rows, as head does, had nothing computed that is not printed."""
    printed, numbers_there = list[str](), list[int]()

    def echo(text: str = "", **_: bool) -> None:
        printed.append(text)
        if len(printed) == 3:  # the title, quantities, and the first rows
            numbers_there.append(sum(isinstance(x, Typed) for x in gc.get_objects()))
            raise BrokenPipeError

    monkeypatch.setattr(click, "echo", echo)
    with pytest.raises(SystemExit):
        main(f"motion --ratio 1.5 --field 0 1 2 {start} {times}".split())
    assert printed[2].lstrip().startswith("t ")
    assert numbers_there[0] < 3000


TENSOR = "--tensor 2 1.5 1 0.1 0.05 0.2 --field 0.3 0 1 --spin 3"


@pytest.mark.slow
def test_a_tensor_is_the_same_body_for_every_command(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Digits, a page, sliders and a sweep are of the motion along its principal axes, which they name."""
    monkeypatch.chdir(tmp_path)
    request = in_group(["page", *TENSOR.split()])[1:-1]
    moments, field, omega = (request[i : i + 3] for i in (1, 5, 9))
    motion = atlas.motion([[2.0, 0.1, 0.05], [0.1, 1.5, 0.2], [0.05, 0.2, 1.0]], (0.3, 0.0, 1.0), (0.0, 0.0, 3.0))
    assert in_group(["page", *TENSOR.split(), "--name", "mine"]) == ["asymmetric", *request, "--name", "mine", "--note"]
    name, numbers_of = started(TENSOR.split())
    assert name == "asymmetric"
    names = [f"{x}{i}" for x in ("I", "B", "omega") for i in "123"]
    assert parse_qs(numbers_of.lstrip("#")) == {"subject": [name]} | dict(
        zip(names, ([x] for x in (*moments, *field, *omega)), strict=True)
    )
    status, out = run("sweep", "motion", *TENSOR.split(), "--quantity", "f1", "--out", "f.csv")
    assert status == 0, out
    assert float(Path("f.csv").read_text().splitlines()[-1].split(",")[-2]) == pytest.approx(motion.frequencies[0])


def test_sweep_columns_along_principal_axes_have_a_suffix(tmp_path: Path) -> None:
    """R, Omega, the field and the start of a tensor are named for the principal axes that the head of the file has."""
    words = "--set t=0,0.7 --quantity R Omega energy --out".split()
    status, out = run("sweep", "motion", *TENSOR.split(), *words, str(tmp_path / "r.csv"))
    assert status == 0, out
    *head, heading, _, row = (tmp_path / "r.csv").read_text().splitlines()
    values = dict(zip((name.split(" ")[0] for name in heading.split(",")), row.split(","), strict=True))
    axes = np.array([[float(x) for x in axis.split(",")] for axis in re.findall(r"\((.+?)\)", head[-1])])
    motion = atlas.motion([[2.0, 0.1, 0.05], [0.1, 1.5, 0.2], [0.05, 0.2, 1.0]], (0.3, 0.0, 1.0), (0.0, 0.0, 3.0))
    R = np.array([[float(values[f"R{i}{j}_principal"]) for j in "123"] for i in "123"])
    np.testing.assert_allclose(axes.T @ R @ axes, motion.rotation(0.7), atol=1e-8)
    Omega, B = (np.array([float(values[f"{x}{i}_principal"]) for i in "123"]) for x in ("Omega", "B"))
    np.testing.assert_allclose(axes.T @ Omega, motion.angular_velocity(0.7), atol=1e-8)
    np.testing.assert_allclose(axes.T @ B, (0.3, 0.0, 1.0), atol=1e-8)
    assert {"I1", "energy", "t"} <= values.keys()
    status, out = run(
        "sweep", "motion", *"--inertia 2 1.5 1 --field 0.3 0 1 --spin 3".split(), *words, str(tmp_path / "s.csv")
    )
    assert "_principal" not in (tmp_path / "s.csv").read_text()


def test_all_commands_evaluate_an_unstable_start_as_typed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Page, sliders and sweep evaluate a symmetric body as typed: after t = 60 it still agrees."""
    monkeypatch.chdir(tmp_path)
    I, field, omega = 0.7157322617930502, (-0.765050795081338, 1.0200677267751173, 0.19211036905670717), (
        0.8801646474639836, -1.1735528632853114, 0.2745993411764893
    )  # fmt: skip
    R33 = atlas.motion(I, field, omega).rotation(60.0)[2, 2]
    words = [f"--{name}" if x is None else repr(x) for name, xs in (("field", field), ("omega", omega))
             for x in (None, *xs)]  # fmt: skip
    for body in (["--ratio", repr(I)], ["--tensor", "1", "1", repr(I), "0", "0", "0"]):
        name, numbers_of = started([*body, *words])
        slid = {key: float(x) for key, (x,) in parse_qs(numbers_of.lstrip("#")).items() if key != "subject"}
        assert FAMILIES[name].make(slid).rotation(60.0)[2, 2] == pytest.approx(R33, abs=1e-14)
        assert run("sweep", "motion", *body, *words, *"--set t=60 --quantity R33 --out x.csv".split())[0] == 0
        assert float(Path("x.csv").read_text().splitlines()[-1].split(",")[-1]) == pytest.approx(R33, abs=1e-14)
        with COMMANDS["asymmetric"].make_context("asymmetric", page_of([*body, *words])[1:]) as context:
            values = page_asked(REGISTER["asymmetric"], context.params).values
        assert atlas.AsymmetricMotion(**values).rotation(60.0)[2, 2] == pytest.approx(R33, abs=1e-14)


def page_of(words: list[str]) -> list[str]:
    """Return the command of a page and its arguments, but for the sentence on its axes."""
    context = ByOptions("page", commands=COMMANDS).make_context("page", words)
    request = [*context._protected_args, *context.args]
    return request[: request.index("--note")] if "--note" in request else request


@pytest.mark.slow
def test_an_attitude_turns_the_laboratory() -> None:
    """A motion that starts from R(0) in a field of the laboratory is R(0) times that in the field of the body."""
    Q = Rotation.from_quat([0.6, 0.0, 0.0, 0.8]).as_matrix()
    samples = numbers("motion", *TENSOR.split(), *"--attitude 0.6 0 0 0.8 --times 0 2 --json".split())["samples"]
    words_there = [
        *"--tensor 2 1.5 1 0.1 0.05 0.2 --spin 3 --field".split(),
        *map(repr, (Q.T @ (0.3, 0.0, 1.0)).tolist()),
    ]
    samples_own = numbers("motion", *words_there, "--times", "0", "2", "--json")["samples"]
    assert samples[0]["R"] == Q.tolist()
    assert pytest.approx(Q @ np.array(samples_own[1]["R"]), abs=1e-13) == np.array(samples[1]["R"])


def in_group(words: list[str]) -> list[str]:
    """Return the arguments with which the command of a page is called in the end, but for the sentence on its axes."""
    context = ByOptions("page", commands=COMMANDS).make_context("page", words[1:], resilient_parsing=False)
    return [*context._protected_args, *context.args][:-1]


def test_a_vector_in_one_word_may_have_uncertainties() -> None:
    """A bracket at the end of a word is that of the last component."""
    options = "--ratio 1.5 --omega2 0.7 --json".split()
    outcome = run("motion", "--field=1.0(1),2.0(2)", *options)
    assert outcome == run("motion", "--field", "1.0(1)", "2.0(2)", *options)
    assert outcome[0] == 0


def test_help_is_printed_despite_other_wrong_words() -> None:
    """Neither an option that there is not nor too few numbers stand in its way."""
    assert run("classify", "--rato", "1", "--field", "1", "--help") == run("classify", "--help")


def test_a_file_after_a_vector_may_begin_with_a_digit(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A file that is there is none of the numbers; too many numbers before it are told."""
    monkeypatch.chdir(tmp_path)
    Path("3.csv").write_text("t,Omega1,Omega2,Omega3\n0,0.3,0.7,0.2\n", encoding="utf-8")
    words = "check --ratio 1.5 --omega 0.3 0.7 0.2 --field".split()
    assert "Omega1" in run(*words, "1,2", "3.csv")[1]
    assert run(*words, "1", "3.csv")[1].endswith("--field takes 2 numbers, B2 B3; found 1.\n")


def test_points_off_symmetry_are_reported(tmp_path: Path) -> None:
    """Products of 1e-10 stay where the body may have three moments; where it must be symmetric it is said once."""
    square = np.array([[1.0, 0, 0, 1], [-1, 0, 0, 1], [0, 1, 0, 1], [0, -1, 0, 1], [0, 0, 0.5, 1], [0, 0, -0.5, 1]])
    words = "--field 1 2 --omega 0.1 0.2 0.3 --json".split()
    assert "off by" not in run("motion", "--points", points_file(tmp_path, square, "x,y,z,mass"), *words)[1]
    square[0, 1] = 1e-10
    with pytest.warns(NearlySymmetricWarning, match=r"symmetric about z is taken, off by \de-1\d of the largest"):
        assert run("motion", "--points", points_file(tmp_path, square, "x,y,z,mass"), *words)[0] == 0
    assert oblique_tensor(Path(points_file(tmp_path, square, "x,y,z,mass")))[0, 1] == pytest.approx(-1e-10)
