"""Bodies and fields on the command line in SI units: shapes with mass and charge, and point masses from a file."""

import json
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

import atlas
from atlas.book.body_and_field import body_and_field
from atlas.book.files import find
from atlas.book.load import load
from atlas.cli import family
from atlas.cli.app import atlas as command
from atlas.motions.register import FAMILIES, Command

SHELL = "--shape cylindrical-shell --radius 1e-6 --height 1.2e-6 --mass 1.5e-15 --charge 2e-15 --magnetic 0.75 1.3"
TETRAGON = "x [m],y,z,mass [kg],charge\n1e-6,0,0,1,-2\n0,1e-6,0,1,-2\n-1e-6,0,0,1,-2\n0,-1e-6,0,1,-2\n"


def record(*words: str) -> dict:  # type: ignore[type-arg]
    """Read a command's output with --json."""
    result = CliRunner().invoke(command, [*words, "--json"], catch_exceptions=False)
    assert result.exit_code == 0, result.output
    return json.loads(result.stdout)


def test_a_family_without_a_field_may_have_a_command(monkeypatch: pytest.MonkeyPatch) -> None:
    """A line in the register is all that it takes: the body may be a shape, and nothing of a field is asked for."""
    family_free = replace(FAMILIES["free"], command=Command("free", "", "", (), "free body"))
    monkeypatch.setattr(family, "FAMILIES", {"free": family_free})
    words = "--shape ring --radius 2 --omega 0.1 0.2 0.3 --json".split()
    record_free = json.loads(CliRunner().invoke(family.command("free"), words, catch_exceptions=False).stdout)
    motion = atlas.FreeMotion(2.0, (0.1, 0.2, 0.3))
    assert (record_free["k"], record_free["phi"]) == (motion.k, motion.phi)


def test_the_shell_of_a_report_is_the_same_in_a_command() -> None:
    """Shape, mass, charge and B of short_solenoid in options give its quadric, of B' not rounded, rates in 1/s."""
    parameters = load(find("short_solenoid")).parameters
    case = body_and_field(parameters.bodies["shell"], parameters.fields["magnet"])
    from atlas.arithmetic.certified_digits import certified
    from atlas.surfaces.certified import Quadric

    field = [Fraction(2e-15) / Fraction(1.5e-15) * Fraction(B) / 2 for B in (0.75, 1.3)]
    assert [float(x) for x in field] == pytest.approx(case.components, rel=1e-15)
    quadric = Quadric(case.exact, field)
    classified = record("classify", *SHELL.split(), "--digits", "40")
    assert classified["semi_axes"] == certified(lambda: list(quadric.semi_axes), 40)
    assert classified["parameters"]["units"] == "si"
    result = CliRunner().invoke(command, ["motion", *SHELL.split(), "--omega2", "1", "--times", "0"])
    assert " 1/s " in result.stdout
    assert "1/time" not in result.stdout
    assert "1/time" not in CliRunner().invoke(command, ["hyperbola", *SHELL.split()]).stdout


def test_decimals_of_a_shape_are_taken_as_typed() -> None:
    """With --decimal the ratio of a shell of radius 1/10 and height 1/5 is the rational 12/10, in 60 digits."""
    words = "--shape cylindrical-shell --radius 0.1 --height 0.2 --field 0.1 0.2 --omega2 0.3 --decimal --digits 60"
    I, B2, B3, w2 = Fraction(12, 10), Fraction(1, 10), Fraction(2, 10), Fraction(3, 10)
    omega3 = B3 * w2 * (w2 + (2 - I) * B2) / (I * B2 * (w2 + B2))
    assert abs(Fraction(record("motion", *words.split())["omega3"]) - omega3) < Fraction(1, 10**59)


@pytest.mark.parametrize("units", [["--units", "gaussian"], []])
def test_mass_and_charge_act_as_their_ratio(units: list[str]) -> None:
    """--mass and --charge act as --mu with their quotient; without --units they are in SI."""
    base = "motion --ratio 1.5 --magnetic 1 2 --omega2 0.7".split()
    by_charge = record(*base, "--mass", "4", "--charge", "-3", *units)
    by_ratio = record(*base, "--mu", "-0.75", *(units or ["--units", "si"]))
    assert by_charge["k"] == by_ratio["k"]
    assert by_charge["omega3"] == by_ratio["omega3"]


def test_points_on_a_ring_are_a_ring(tmp_path: Path) -> None:
    """Four points on a ring are a ring, with the charge-to-mass ratio of each; their place does not matter."""
    (tmp_path / "ring.csv").write_text(TETRAGON, encoding="utf-8")
    points = record("motion", "--points", str(tmp_path / "ring.csv"), *"--magnetic 1 2 --omega2 0.7".split())
    assert points["omega3"] == pytest.approx(atlas.ElementaryMotion(2.0, (-1.0, -2.0), 0.7).omega3, rel=1e-14, abs=0.0)
    mass, positions = np.array([1.0, 1.0, 2.0]), np.array([[1.0, 0, 0], [-1.0, 0, 0], [0, 0, 1.0]])
    four = np.concatenate([positions[:2], positions[:2][:, [1, 0, 2]], positions[2:]]) + np.array([3.0, -2.0, 7.0])
    rows = [",".join(map(repr, map(float, (*x, m)))) for x, m in zip(four, [1, 1, 1, 1, 2], strict=True)]
    (tmp_path / "kite.csv").write_text("\n".join(["x,y,z,mass", *rows]), encoding="utf-8")
    body = atlas.SymmetricBody.from_point_masses([1, 1, 1, 1, mass[2]], four)
    classified = record("classify", "--points", str(tmp_path / "kite.csv"), "--field", "1", "2")
    assert classified["beta"] == pytest.approx(atlas.Quadric(body.ratio, (1.0, 2.0)).beta, rel=1e-13, abs=0.0)


def test_a_sweep_takes_body_and_field_by_the_same_options(tmp_path: Path) -> None:
    """`atlas sweep` with SHELL has its ratio and its field in each row, and names the unit 1/s."""
    out = tmp_path / "table.csv"
    words = ["sweep", "elementary", *SHELL.split(), "--set", "omega2=0.5,1", "--quantity", "k", "--out", str(out)]
    assert CliRunner().invoke(command, words).exit_code == 0
    heading, row, _ = out.read_text(encoding="utf-8").splitlines()
    assert heading == "ratio,B2 [1/s],B3 [1/s],omega2 [1/s],k [1/s]"
    expected = record("motion", *SHELL.split(), "--omega2", "0.5")["k"]
    assert float(row.rpartition(",")[2]) == pytest.approx(expected, rel=1e-15, abs=0.0)
