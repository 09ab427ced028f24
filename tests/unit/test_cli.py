"""The command line as a physicist types it."""

import contextlib
import json
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path

import mpmath
import pytest
from click.testing import CliRunner

from atlas.cli.app import atlas as command
from atlas.cli.options import Typed

ATLAS = [sys.executable, "-m", "atlas"]
EPS = 2.0**-52


def run(*words: str) -> subprocess.CompletedProcess[str]:
    """Run the program as a process of its own."""
    return subprocess.run([*ATLAS, *words], capture_output=True, text=True, check=False)


def record(*words: str) -> dict:  # type: ignore[type-arg]
    """Run a command with --json inside this process and read what it prints."""
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
            first = mpmath.matrix(
                [
                    [ck, -c * sk, s * sk],
                    [c * sk, s * s + c * c * ck, s * c * (1 - ck)],
                    [-s * sk, s * c * (1 - ck), c * c + s * s * ck],
                ]
            )
            R = first * mpmath.matrix([[cp, -sp, 0], [sp, cp, 0], [0, 0, 1]])
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


@pytest.mark.parametrize(
    ("words", "tells"),
    [
        ("classify --ratio 2.5 --field 1 2", "2.5"),
        ("classify --ratio 0 --field 1 2", "0"),
        ("classify --ratio -1 --field 1 2", "-1"),
        ("classify --field 1 2", "--ratio"),
        ("classify --ratio 1 --inertia 1 1 --field 1 2", "--inertia"),
        ("classify --ratio 1", "--field"),
        ("classify --ratio nan --field 1 2", "nan"),
        ("classify --ratio one --field 1 2", "one"),
        ("classify --ratio 1 --field 1", "--field"),
        ("classify --shape banana --field 1 2", "banana"),
        ("classify --shape ring --field 1 2", "--radius"),
        ("classify --shape ball --field 1 2", "cylindrical-shell"),
        ("classify --shape ring --radius 1 --height 1 --field 1 2", "--height"),
        ("classify --ratio 1.5 --field 1 2 --mu 3", "--mu goes with --magnetic"),
        ("classify --ratio 1.5 --field 1 2 --units si", "--units goes with --magnetic"),
        ("hyperbola --ratio 1.5 --field 1e300 1e-300", "too far apart"),
        ("hyperbola --ratio 1.5 --field 1e-300 1e300", "too far apart"),
        ("hyperbola --ratio 1.5 --field 1e308 1e308", "beyond the largest float"),
        ("check nosuch.csv", "nosuch.csv"),
        ("classify --ratio 1e-9999999999 --field 1 2 --decimal", "exponent"),
        ("motion --ratio 1.5 --field 1 2 --omega2 -1 --times 0", "-1"),
        ("motion --ratio 1.5 --field 1 2 --omega2 1 --times", "--times"),
        ("motion --ratio 1.5 --field 1 2 --omega2 1 --times 0 --grid 0 1 5", "--grid"),
        ("motion --ratio 1.5 --field 1 2 --omega2 1 --grid 0 1 2.5", "2.5"),
        ("motion --ratio 1.5 --field 1 2 --omega2 1e3 --times 1e30 --json", "2^50"),
        ("figure nosuchfigure", "nosuchfigure"),
        ("report nosuchreport", "nosuchreport"),
        ("clasify --ratio 1", "clasify"),
        ("classify --rato 1", "--rato"),
    ],
)
def test_a_wrong_input_gets_one_line_and_status_two(words: str, tells: str) -> None:
    """What was wrong stands in one line on standard error, without a traceback."""
    result = run(*words.split())
    assert result.returncode == 2
    assert result.stdout == ""
    assert result.stderr.count("\n") == 1
    assert tells in result.stderr


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
        said = b""
        with contextlib.suppress(OSError):  # the end of a pseudo-terminal is an error
            while piece := os.read(ours, 65536):
                said += piece
    os.close(ours)
    assert process.returncode == 0
    assert "…" not in said.decode()
    assert "-0.008501748978" in said.decode()


def test_the_plane_pair_has_a_hyperbola() -> None:
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
        ("--field 1 2 --omega2 0.7", ("mf76", "mf84", "mf77")),
    ],
)
def test_a_motion_is_labelled_by_its_case(words: str, says: tuple[str, ...]) -> None:
    """A free omega3 is not said to follow from mf76, and without a field nothing precesses about it."""
    out = CliRunner().invoke(command, f"motion --ratio 1.5 {words}".split(), catch_exceptions=False).stdout
    assert all(part in out for part in says)
    assert ("mf76" in out) == ("mf76" in says)


def test_a_reason_is_told_once() -> None:
    """Where several quantities lack for the same reason, the reason stands there once."""
    out = CliRunner().invoke(command, "classify --ratio 1.5 --field 0 0".split(), catch_exceptions=False).stdout
    assert out.count("there is no angle beta") == 1


@pytest.fixture
def bad_recipe(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """Put a recipe that is no Python beside one that draws."""
    from atlas.scene import recipes

    folder = tmp_path / "figures"
    folder.mkdir()
    (folder / "aa_bad.py").write_text('"""Bad."""\ndef scene(:\n', encoding="utf-8")
    (folder / "lssc.py").write_text(recipes.load("lssc").source.read_text(encoding="utf-8"), encoding="utf-8")
    monkeypatch.setattr(recipes, "folder", lambda _kind: folder)
    recipes.load.cache_clear()
    yield tmp_path / "out"
    recipes.load.cache_clear()


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


def test_without_gl_a_shaded_figure_says_what_it_is(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A line drawing in place of a shaded plate is told in one line, with the command that brings the rest."""
    from atlas.render import gl

    monkeypatch.setattr(gl, "prepare", lambda: None)
    words = ["figure", "hyp_a", "lssc", "--renderer", "shaded", "--out", str(tmp_path)]
    result = CliRunner().invoke(command, words, standalone_mode=False)
    assert result.return_value == 0
    assert result.stderr == f"atlas: {gl.advice()}\n"


def test_a_closed_standard_output_is_told() -> None:
    """Without a standard output there is one line and no traceback."""
    result = subprocess.run(
        ["/bin/sh", "-c", 'exec "$@" >&-', "sh", *ATLAS, "list"], stderr=subprocess.PIPE, text=True, check=False
    )
    assert (result.returncode, result.stderr) == (1, "atlas: standard output is closed\n")


def test_negative_numbers_are_numbers() -> None:
    """Negative values, also in exponent notation, are values and not options."""
    out = record("motion", *"--ratio 1.5 --field -1 -2e0 --omega2 -7e-1 --times -1e-5 -2 3".split())
    assert [sample["t"] for sample in out["samples"]] == [-1e-5, -2.0, 3.0]


@pytest.mark.parametrize("text", ["0.1", "1/3", "1e-3", "-2.5", "0x1.8p1"])
def test_a_typed_number_remembers_what_was_typed(text: str) -> None:
    """The double is the nearest one, and the exact number is kept."""
    number = Typed(text)
    exact = number.exactly()
    assert isinstance(exact, Fraction)
    assert float(exact) == float(number)


def test_the_reader_of_a_pipe_may_leave() -> None:
    """A closed pipe ends the program quietly."""
    words = "motion --ratio 1.5 --field 1 2 --omega2 1 --grid 0 1 20000 --json".split()
    with subprocess.Popen([*ATLAS, *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        assert process.stdout is not None
        assert process.stderr is not None
        process.stdout.read(10)
        process.stdout.close()
        assert process.stderr.read() == b""


def test_check_shows_what_there_is(tmp_path: Path) -> None:
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
    assert "what should not change" not in out
