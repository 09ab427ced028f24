"""The command line as a physicist types it."""

import contextlib
import json
import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path

import mpmath
import pytest
from click import UsageError
from click.testing import CliRunner

from atlas.cli import family, present
from atlas.cli.app import atlas as command
from atlas.cli.figure import setting
from atlas.cli.points import point_masses, points, ratio_of_points
from atlas.cli.typed import Typed

ATLAS = [sys.executable, "-m", "atlas"]
EPS = 2.0**-52
MOTION = "motion --ratio 1.5 --field 1 2 --omega2 1"


def run(*words: str) -> subprocess.CompletedProcess[str]:
    """Run the program as a process of its own."""
    return subprocess.run([*ATLAS, *words], capture_output=True, text=True, check=False)


def record(*words: str) -> dict:  # type: ignore[type-arg]
    """Run a command with --json inside this process and read its output."""
    result = CliRunner().invoke(command, [*words, "--json"], catch_exceptions=False)
    assert result.exit_code == 0, result.output
    return json.loads(result.stdout)


@pytest.mark.parametrize(
    ("words", "kind"),
    [
        (("--ratio", "1.5", "--field", "1", "2"), "two-sheet hyperboloid"),
        (("--ratio", "2", "--field", "1", "2"), "two-sheet hyperboloid"),
        (("--ratio", "1", "--field", "1", "2"), "cone"),
        (("--inertia", "3", "3", "--field", "-1", "2"), "cone"),
        (("--ratio", "0.5", "--field", "1", "-2"), "one-sheet hyperboloid"),
        (("--shape", "ring", "--radius", "2", "--field", "1", "2"), "two-sheet hyperboloid"),
        (("--ratio", "1.5", "--field", "1", "0"), "plane pair"),
        (("--ratio", "1.5", "--field", "0", "1"), "line"),
        (("--ratio", "1.5", "--field", "0", "0"), "all space"),
        (("--ratio", "1.5", "--magnetic", "1", "2", "--mu", "-3"), "two-sheet hyperboloid"),
    ],
)
def test_classify_names_the_quadric(words: tuple[str, ...], kind: str) -> None:
    """Each of the six kinds is named, from any way of giving the body and the field."""
    assert record("classify", *words)["kind"] == kind


def test_motion_agrees_with_fifty_digits() -> None:
    """The motion of the README agrees with the closed form at 50 digits to 1e-14."""
    out = record("motion", *"--ratio 1.5 --field 1 2 --omega2 0.7 --times 0 1 2.5".split())
    with mpmath.workdps(50):
        I, B2, B3, omega2 = (mpmath.mpf(x) for x in (1.5, 1, 2, 0.7))
        b = mpmath.sqrt(B2**2 + B3**2)
        s, c = B2 / b, B3 / b
        omega3 = B3 * omega2 * (omega2 + (2 - I) * B2) / (I * B2 * (omega2 + B2))
        k, phi = omega2 / s, omega3 - B3 / B2 * omega2
        for name, value in (("omega3", omega3), ("k", k), ("phi", phi)):
            assert abs(out[name] - value) <= 4 * EPS * abs(value)
        assert [sample["t"] for sample in out["samples"]] == [0, 1, 2.5]
        for sample in out["samples"]:
            ck, sk = mpmath.cos(k * sample["t"]), mpmath.sin(k * sample["t"])
            cp, sp = mpmath.cos(phi * sample["t"]), mpmath.sin(phi * sample["t"])
            precession = mpmath.matrix(
                [
                    [ck, -c * sk, s * sk],
                    [c * sk, s * s + c * c * ck, s * c * (1 - ck)],
                    [-s * sk, s * c * (1 - ck), c * c + s * s * ck],
                ]
            )
            R = precession * mpmath.matrix([[cp, -sp, 0], [sp, cp, 0], [0, 0, 1]])
            assert max(abs(R[i, j] - sample["R"][i][j]) for i in range(3) for j in range(3)) <= 4 * EPS
            Omega = (omega2 * sp, omega2 * cp, omega3)
            assert max(abs(a - b) for a, b in zip(Omega, sample["Omega"], strict=True)) <= 8 * EPS * 2


def test_json_is_alone_on_standard_output() -> None:
    """With --json, standard output is one JSON document and standard error is silent."""
    result = run(*"ball --inertia 2 --larmor 0.5 --momentum 0.3 -0.7 --times 0 1e-3 --json".split())
    assert result.returncode == 0
    assert result.stderr == ""
    assert set(json.loads(result.stdout)) >= {"gamma", "k_hat", "samples"}


def test_floats_in_json_read_back_the_same() -> None:
    """A parameter typed as a decimal comes back as the same double."""
    out = record("motion", *"--ratio 0.1 --field 0.3 1e-5 --omega2 -7e-5 --times 1e3".split())
    assert out["parameters"]["ratio"] == 0.1
    assert out["parameters"]["field"] == [0.3, 1e-5]
    assert out["samples"][0]["t"] == 1000.0


def test_point_masses_may_have_units_in_their_heading(tmp_path: Path) -> None:
    """They are converted; a unit of something else is refused."""
    file = tmp_path / "points.csv"
    for scale, heading in ((1, "x,y,z,mass,charge"), (1000, "x [mm],y [mm],z [mm],mass [g],charge [mC]")):
        rows = [(1, 0, 0, 1, 2), (-1, 0, 0, 1, 2), (0, 1, 0, 1, 2), (0, -1, 0, 1, 2), (0, 0, 1, 1, 2), (0, 0, -1, 1, 2)]
        file.write_text("\n".join([heading, *(",".join(str(x * scale) for x in row) for row in rows)]))
        assert (point_masses(file).masses.sum(), ratio_of_points(file)) == (6, 2)
        assert points(file).inertia == (4, 4, 4)
        for separator in ";\t":
            (file_other := tmp_path / "other.csv").write_text(file.read_text().replace(",", separator))
            assert points(file_other).inertia == (4, 4, 4)
    file.write_text("x,y,z [kg],mass\n0,0,1,1\n")
    with pytest.raises(UsageError, match=r"points\.csv: line 2: '1' under z \[kg\] is not a number in m, "):
        points(file)


def test_a_wrong_input_gets_one_line_and_status_two() -> None:
    """In a process of its own: on standard error, without a traceback. The others are in test_cli_refused."""
    result = run(*"classify --ratio 2.5 --field 1 2".split())
    assert (result.returncode, result.stdout, result.stderr.count("\n")) == (2, "", 1)
    assert "2.5" in result.stderr


def test_control_characters_are_not_printed() -> None:
    """Control characters in a wrong word are shown as such and not sent; a long word is shortened."""
    result = run("classify", "--ratio", "1\x1b[31m", "--field", "1", "2")
    assert "\x1b" not in result.stderr
    result = run("x" * 5000 + "\x1b[2J")
    assert result.returncode == 2
    assert "\x1b" not in result.stderr
    assert len(result.stderr) < 1000


@pytest.mark.parametrize(
    "words",
    [
        "figure lssc --out {}",
        "report short_solenoid --out {}",
        "check mine.csv --figure {}.svg",
    ],
)
def test_a_path_below_a_file_is_refused_before_any_work(words: str, tmp_path: Path) -> None:
    """A file that cannot be written is named as given, and no hidden file with it; a wrong place is a wrong input."""
    file = tmp_path / "mine.csv"
    file.write_text("t,R11\n0,1\n", encoding="utf-8")
    place = file / "sub" / "x"
    result = run(*words.replace("mine.csv", str(file), 1).format(place).split())
    assert (result.returncode, result.stdout) == (2, "")
    assert result.stderr.count("\n") == 1
    assert str(place) in result.stderr
    assert f"'{file}' is a file" in result.stderr
    assert ".part" not in result.stderr


def test_a_read_only_folder_is_refused_before_any_work(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where nothing may be written, the folder given is named."""
    monkeypatch.setattr(os, "access", lambda _path, _mode: False)
    result = CliRunner().invoke(command, ["figure", "lssc", "--out", str(tmp_path / "new")])
    assert result.exit_code == 2
    assert f"'{tmp_path / 'new'}' cannot be written, for its folder is read-only" in result.stderr


@pytest.mark.parametrize("place", ["/proc/x.csv", "/proc/y/x.csv", "{}.csv".format("x" * 300)])
def test_a_file_that_no_one_may_write_is_a_wrong_input(place: str) -> None:
    """Also of the superuser, whom only an attempt tells."""
    result = run(*f"motion --ratio 1.5 --field 1 2 --omega2 0.7 --times 0 1 --out {place}".split())
    assert (result.returncode, result.stdout, result.stderr.count("\n")) == (2, "", 1)
    assert "; choose another path" in result.stderr


@pytest.mark.slow
def test_a_missing_library_is_an_error_of_one_line() -> None:
    """As after new code came with new libraries: the missing library, and the command that installs it."""
    block = "import sys; sys.modules['pylatexenc'] = None; from atlas.cli.app import main; main(['verify', '71'])"
    result = subprocess.run([sys.executable, "-c", block], capture_output=True, text=True, check=False)
    assert result.returncode == 1
    assert result.stderr == "atlas: the library pylatexenc is not installed; in a checkout, `make setup` installs it\n"


def test_every_shape_that_is_listed_has_a_quadric() -> None:
    """`atlas classify` takes every shape of `atlas list`, with its listed dimensions."""
    for shape, sizes in record("list")["shapes"].items():
        dimensions = [word for size in sizes for word in (f"--{size}", "0.5")]
        kind = record("classify", "--shape", shape, *dimensions, "--field", "1", "2")["kind"]
        assert kind in {"two-sheet hyperboloid", "one-sheet hyperboloid", "cone"}


@pytest.mark.parametrize(
    ("words", "places"),
    [
        ("hyperbola --ratio 1.5 --field 1 2 --omega2 3 1e200", {"points[1].nutation_squared"}),
        ("classify --ratio 1.5 --field 1e-320 1", {"a2"}),
    ],
)
def test_no_float_is_left_out_in_silence(words: str, places: set[str]) -> None:
    """JSON holds no infinity: there is null in its place, and the reason under "missing"; NumPy warns of nothing."""
    result = run(*words.split(), "--json")
    assert (result.returncode, result.stderr) == (0, "")
    record = json.loads(result.stdout)
    assert record["missing"] == dict.fromkeys(places, "beyond the largest float")
    for place in places:
        value = record
        for key in re.findall(r"\w+", place):
            value = value[int(key) if key.isdigit() else key]
        assert value is None


def test_no_digit_is_cut_in_a_pipe() -> None:
    """A hundred digits asked for are a hundred digits printed, in every column."""
    words = "motion --ratio 1.5 --field 1 2 --omega2 0.7 --times 1e12 --digits 100".split()
    result = CliRunner().invoke(command, words, catch_exceptions=False)
    assert "…" not in result.stdout
    numbers = re.findall(r"-?0\.(0*)([1-9]\d*)", result.stdout)
    assert len(numbers) == 2 + 15
    assert {len(digits) for _, digits in numbers} == {100}


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="needs a pseudo-terminal")
def test_no_digit_is_cut_on_a_narrow_terminal() -> None:
    """Where the table does not fit, its lines get longer and its numbers stay whole."""
    import fcntl
    import pty
    import struct
    import termios

    ours, theirs = pty.openpty()
    fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 60, 0, 0))
    words = "motion --ratio 1.5 --field 1 2 --omega2 0.7 --times 1".split()
    with subprocess.Popen([*ATLAS, *words], stdout=theirs) as process:
        os.close(theirs)
        output = b""
        with contextlib.suppress(OSError):  # the end of a pseudo-terminal is an error
            while piece := os.read(ours, 65536):
                output += piece
    os.close(ours)
    assert process.returncode == 0
    assert "…" not in output.decode()
    assert "-0.008501748978" in output.decode()


def test_across_the_field_one_line_is_sampled_and_the_other_named() -> None:
    """For B3 = 0 the line omega3 = 0 is sampled, and the other line is told of."""
    words = "hyperbola --ratio 1.5 --field 1 0 --count 5".split()
    points = record(*words)["points"]
    assert len(points) >= 4
    assert all(point["omega3"] == 0.0 and point["omega2"] != -1.0 for point in points)
    assert "omega2 = -B2, on which omega3 is free" in CliRunner().invoke(command, words).stdout


@pytest.mark.parametrize(
    ("words", "says"),
    [
        ("--field 0 0 --omega2 1 --omega3 2", ("given", "frequency of precession about m")),
        ("--field 0 1 --omega2 0 --omega3 2", ("given", "frequency of precession about B")),
        ("--field 1 2 --omega2 0.7", ("(71)", "(79)", "(72)")),
    ],
)
def test_a_motion_is_labelled_by_its_case(words: str, says: tuple[str, ...]) -> None:
    """A free omega3 is not said to follow from (71), and without a field nothing precesses about it."""
    out = CliRunner().invoke(command, f"motion --ratio 1.5 {words}".split(), catch_exceptions=False).stdout
    assert all(phrase in out for phrase in says)
    assert ("(71)" in out) == ("(71)" in says)


def test_a_shared_reason_is_printed_once() -> None:
    """Where several quantities lack for the same reason, the reason stands there once."""
    out = CliRunner().invoke(command, "classify --ratio 1.5 --field 0 0".split(), catch_exceptions=False).stdout
    assert out.count("there is no angle beta") == 1


@pytest.fixture
def bad_recipe(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """Put a recipe that is no Python beside one that draws."""
    from atlas.book.building import figures
    from atlas.pictures import recipes

    folder = tmp_path / "figures"
    folder.mkdir()
    (folder / "aa_bad.py").write_text('"""Bad."""\ndef scene(:\n', encoding="utf-8")
    (folder / "lssc.py").write_text(recipes.load("lssc").source.read_text(encoding="utf-8"), encoding="utf-8")
    for module in (recipes, figures):
        monkeypatch.setattr(module, "folder", lambda _kind: folder)
    monkeypatch.setattr(figures.processes, "pool", lambda *_: None)  # another process would not know of it
    return tmp_path / "out"


def test_a_broken_recipe_hides_no_other(bad_recipe: Path) -> None:
    """`atlas list` and `atlas figure --all` tell of it in a line, go on, and end with status 1."""
    listing = CliRunner().invoke(command, ["list"], standalone_mode=False)
    drawing = CliRunner().invoke(
        command, ["figure", "--all", "--format", "svg", "--out", str(bad_recipe)], standalone_mode=False
    )
    for result in (listing, drawing):
        assert result.return_value == 1
        assert result.stderr.count("\n") == 1
        assert "figures/aa_bad.py, line 2: SyntaxError" in result.stderr
    assert "lssc" in listing.stdout
    assert (bad_recipe / "lssc.svg").exists()


@pytest.mark.slow
def test_without_gl_a_line_drawing_replaces_a_shaded_figure_with_a_notice(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A line drawing in place of a shaded figure is told in one line, with the command that brings the rest."""
    from atlas import gl

    monkeypatch.setenv(gl.CHOICE, gl.NONE)
    gl.library.cache_clear()
    words = ["figure", "quadric", "lssc", "--renderer", "shaded", "--out", str(tmp_path)]
    result = CliRunner().invoke(command, words, standalone_mode=False)
    assert result.return_value == 0
    lines = [line for line in result.stderr.splitlines() if not line.endswith(" s")]  # how far it is, on a busy machine
    assert lines == [f"atlas: {gl.advice()}"]
    gl.library.cache_clear()


@pytest.mark.slow
def test_a_figure_in_the_plane_is_never_shaded(tmp_path: Path) -> None:
    """ReportRequest for shaded, a figure without a panel in space says in one line which library drew it."""
    words = ["figure", "hyperbola", "--renderer", "shaded", "--out", str(tmp_path)]
    for _ in ("drawn", "taken from the store"):
        result = CliRunner().invoke(command, words, standalone_mode=False)
        assert result.return_value == 0
        assert "atlas: no panel in space, so drawn by the vector renderer: hyperbola\n" in result.stderr
    assert (tmp_path / "hyperbola.png").exists()


def test_a_failing_figure_names_the_fault_of_its_parameter(bad_recipe: Path) -> None:
    """A wrong parameter is told in its own sentence; only unexpected errors come with the name of their class."""
    (bad_recipe.parent / "figures" / "aa_bad.py").write_text(
        '"""Bad."""\ndef scene(*, ratio=1.0):\n    return 1 / 0\n', encoding="utf-8"
    )
    words = ["figure", "aa_bad", "lssc", "--format", "svg", "--set", "ratio=5/2", "--out", str(bad_recipe)]
    unexpected, message = CliRunner().invoke(command, words, standalone_mode=False).stderr.splitlines()
    assert unexpected == "atlas: figure aa_bad: figures/aa_bad.py, line 3: ZeroDivisionError: division by zero"
    assert message.startswith("atlas: figure lssc: No body has I = I3/I2 = 2.5")


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("x=3/2", 1.5),
        ("x=7", 7),
        ("x=1e-3", 1e-3),
        ("x=0.5,1/4", (0.5, 0.25)),
        ("x=[1]", (1,)),
        ("x=true", True),
        ("x=1/0", "1/0"),
        ("x=word", "word"),
    ],
)
def test_the_option_set_reads_numbers_lists_and_words(text: str, value: object) -> None:
    """--set reads numbers as every other option does, lists of them, true and false, and words."""
    assert setting(text) == ("x", value)


def test_a_closed_standard_output_is_reported() -> None:
    """Without a standard output there is one line and no traceback."""
    result = subprocess.run(
        ["/bin/sh", "-c", 'exec "$@" >&-', "sh", *ATLAS, "list"], stderr=subprocess.PIPE, text=True, check=False
    )
    assert (result.returncode, result.stderr) == (1, "atlas: standard output is closed\n")


def test_negative_numbers_are_numbers() -> None:
    """Negative values, also in exponent notation, are values and not options."""
    out = record("motion", *"--ratio 1.5 --field -1 -2e0 --omega2 -7e-1 --times -1e-5 -2 3".split())
    assert [sample["t"] for sample in out["samples"]] == [-1e-5, -2.0, 3.0]


@pytest.mark.parametrize(
    "words",
    [
        "motion --ratio 1.5 --field -1 -2e0 --omega2 -7e-1 --times -1e-5 -2 3 --digits 30 --decimal",
        "motion --ratio 1.5 --field -0.2 1 --omega 0.3 -0.7 0.2 --times 1",
    ],
)
def test_a_typographic_minus_sign_is_read(words: str) -> None:
    """Numbers that were copied from a page, with a true minus sign, are read as the same numbers."""
    printed = re.sub(r" -(?=\d)", " \N{MINUS SIGN}", words)
    assert record(*printed.split()) == record(*words.split())


@pytest.mark.parametrize("text", ["0.1", "1/3", "1e-3", "-2.5", "0x1.8p1", "+1.", ".5E+3", "0X.8P-1"])
def test_a_typed_number_keeps_its_exact_value(text: str) -> None:
    """The double is the nearest one, and the exact number is kept."""
    number = Typed(text)
    exact = number.exactly()
    assert isinstance(exact, Fraction)
    assert float(exact) == float(number)


@pytest.mark.parametrize("times", ["--grid 1{} 1{} 3", "--times 0{} 2{}"])
def test_times_with_a_unit_are_exact(times: str) -> None:
    """With --decimal each row is that of its own time, as it is without a unit."""
    words = "motion --ratio 1.5 --field 1 2 --omega2 0.7 --json --digits 12 --decimal".split()
    samples, second = (record(*words, *times.replace("{}", unit).split())["samples"] for unit in ("s", ""))
    assert samples == second


def test_zero_may_have_a_unit() -> None:
    """It is read as any other number."""
    assert record(*"classify --ratio 1.5 --magnetic 1T 0T --mu 1 --json".split())["parameters"]["magnetic"] == [1, 0]


@pytest.mark.slow
@pytest.mark.parametrize("words", [f"{MOTION} --grid 0 1 20000 --json", f"{MOTION} --times 0:10:100000", "--help"])
def test_a_closed_pipe_ends_the_program_quietly(words: str) -> None:
    """A closed pipe ends the program quietly, as by SIGPIPE, and long before all of a long table is computed."""
    limited = ["/bin/sh", "-c", 'unset PYTHONUNBUFFERED; ulimit -t 30 && exec "$@"', "sh", *ATLAS, *words.split()]
    with subprocess.Popen(limited, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        assert process.stdout is not None
        assert process.stderr is not None
        process.stdout.close()
        assert process.stderr.read() == b""
    assert process.returncode == 128 + signal.SIGPIPE


def test_a_long_table_printed_in_parts_equals_the_whole_table(monkeypatch: pytest.MonkeyPatch) -> None:
    """Rows that are computed and printed a few at a time are those of one table; the heading stands once."""
    words, rows = f"{MOTION} --times 0:10:40".split(), []
    for few in (7, 1000):
        monkeypatch.setattr(family, "AT_ONCE", few)
        monkeypatch.setattr(present, "PIECE", few)
        out = CliRunner().invoke(command, words, catch_exceptions=False).stdout
        rows.append([line.split() for line in out.splitlines() if "\N{BOX DRAWINGS LIGHT HORIZONTAL}" not in line])
    assert rows[0] == rows[1]
    assert len(rows[0]) > 3 * 40


def test_check_shows_only_existing_digits_and_integrals(tmp_path: Path) -> None:
    """One row is a row, no digits are 0.0 digits, an integral that the columns do not give is not headed."""
    file = tmp_path / "one.csv"
    file.write_text("t,q0,q1,q2,q3\n0,0,0,0,0\n", encoding="utf-8")
    options = ["--ratio", "1.5", "--field", "1", "2", "--omega2", "0.7", "--figure", str(tmp_path / "one.svg")]
    out = CliRunner().invoke(command, ["check", str(file), *options], catch_exceptions=False).stdout
    assert "one.csv: 1 row," in out
    assert "-0.0" not in out
    assert str(tmp_path / "one.svg") in out
    file.write_text("t,R11\n0,1\n", encoding="utf-8")
    out = CliRunner().invoke(command, ["check", str(file), *options], catch_exceptions=False).stdout
    assert "constants of the motion" not in out


@pytest.mark.parametrize(
    ("rows", "options", "status", "says"),
    [
        ("t,R11\n0,1\n", "", 0, ""),
        ("t,R11\n0,1.001\n", "--threshold 2", 0, ""),
        ("t,R11,R22\n0,1,1\n1,0.5,0.5\n", "", 1, "fewer than 6 correct digits in R11 from t = 1, R22 from t = 1"),
        ("t,R11\n0,1.001\n", "--json", 1, "fewer than 6 correct digits in R11 from t = 0"),
        ("t,R11\n0,1e308\n", "", 1, "fewer than 6 correct digits in R11 from t = 0"),
        ("t,R11\n", "", 2, "no rows"),
        ("", "", 2, "is empty"),
    ],
)
def test_the_status_of_check_is_its_verdict(tmp_path: Path, rows: str, options: str, status: int, says: str) -> None:
    """0 if every column has the digits asked for, 1 with one line that names those that fail, 2 for a wrong input."""
    file = tmp_path / "mine.csv"
    file.write_text(rows, encoding="utf-8")
    result = run("check", str(file), *f"--ratio 1.5 --field 1 2 --omega2 0.7 {options}".split())
    assert result.returncode == status
    assert says in result.stderr
    assert result.stderr.count("\n") == bool(says)
    assert (result.stdout != "") == (status < 2)


def test_a_separatrix_lacks_angles_per_period_with_a_reason() -> None:
    """On a separatrix the period is infinite, and no angle belongs to it; at a triple root there is no nome."""
    out = record("motion", *"--ratio 3/4 --field 20 15 --omega 6 -24.5 -7".split())
    assert (out["kind"], out["period"], out["nome"]) == ("separatrix", "infinite", 1.0)
    assert "precession_per_period" not in out
    out = record("motion", *"--ratio 0.5 --field 1 -3 --omega 0 1.5 2".split())
    assert out["kind"] == "separatrix, triple root"
    assert "nome" not in out


def test_a_number_without_digits_is_printed_with_a_bound() -> None:
    """Quantities zero by symmetry are printed as 0; one that falls off as exp(-t) has a bound, as the table says."""
    motion = "--ratio 2 --field 1 0.5 --omega 1 -1 -0.5 --times 1e5"
    out = CliRunner().invoke(command, ["motion", *motion.split()], catch_exceptions=False).stdout
    assert len(re.findall(r"0 within 1e-\d{4}", out)) == 4
    assert "0 within 1e-k: proven to be smaller than that in size" in out
    motion = "--ratio 1.5 --field 1 0 --omega 0.3 -1 0 --times 1"
    assert "within" not in CliRunner().invoke(command, ["motion", *motion.split()]).stdout
