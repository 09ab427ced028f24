"""``atlas top`` with a heavy or a charged body: the numbers of Python, units, and faults in a line."""

import json
import math
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

import atlas
from atlas.cli.family import command

TOP = command("top")
HEAVY = "--shape disk --radius 0.03 --mass 0.1 --heavy 9.81 0.04 --direction 0.3 1 --omega 0 0 150"
CHARGED = "--inertia 2e-27 1e-27 --charged 1e-23 2e-23 --magnetic 1 2 --omega 0.1 0.2 0.3"


def record(words: str) -> dict[str, Any]:
    """Return the command's output as JSON."""
    outcome = CliRunner().invoke(TOP, [*words.split(), "--json"], catch_exceptions=False)
    assert outcome.exit_code == 0, outcome.output
    return json.loads(outcome.stdout)  # type: ignore[no-any-return]


def test_a_heavy_top_of_the_command_line_agrees_with_python() -> None:
    """Kind, period and rates of the top of a disk on a peg, those of `TopMotion.heavy` to the bit."""
    body = atlas.SymmetricBody.disk(0.1, 0.03)
    top = atlas.TopMotion.heavy(body, 9.81, 0.04, (0.3, 1.0), (0, 0, 150), mass=0.1)
    computed = record(HEAVY)
    assert (computed["kind"], computed["period"]) == (top.kind, top.period)
    assert computed["steady_precessions"] == [precession.rate for precession in top.steady_precessions]
    text = CliRunner().invoke(TOP, HEAVY.split()).stdout
    assert "1/s" in text
    assert "1/time" not in text


def test_a_top_takes_numbers_with_units_and_a_spin() -> None:
    """Gravity and the distance each in its own unit, in this order; a spin in Hz; none beside Gaussian units."""
    plain = record("--shape disk --radius 0.03 --mass 0.1 --heavy 9.81 0.04 --direction 0.3 1 --omega 0 0 150")
    typed_record = record(
        "--shape disk --radius 3cm --mass 100g --heavy 981cm/s2 4cm --direction 0.3 1 --spin 150rad/s"
    )
    assert typed_record["period"] == pytest.approx(plain["period"], rel=1e-14)
    by_energy = record("--inertia 1e-5kg*m2 5e-6kg*m2 --direction 0.6 0.8 --linear 15mJ --spin 40Hz")
    assert (
        by_energy["period"]
        == atlas.TopMotion((1e-5, 5e-6), (0, 0), (0.6, 0.8), (0, 0, 80 * math.pi), linear=0.015).period
    )
    assert "1/time" not in CliRunner().invoke(TOP, "--inertia 1 0.5 --direction 0.6 0.8 --spin 40Hz".split()).stdout
    swapped = HEAVY.replace("9.81 0.04", "4cm 9.81m/s2")
    words_both = HEAVY + " --spin 2"
    gaussian = "--inertia 2 1 --charged 1 2 --magnetic 1T 1T --spin 9 --units gaussian"
    for words, says in ((swapped, "m/s2 and m"), (words_both, "--spin"), (gaussian, "is in SI")):
        outcome = CliRunner().invoke(TOP, words.split())
        assert outcome.exit_code == 2, words
        assert says in outcome.output, words


def test_a_charged_top_takes_moments_in_si_or_in_gaussian_units() -> None:
    """The same body in both systems has the same period, to rounding; a coat has the moments of its shape."""
    c = 299_792_458.0
    si = record(CHARGED)
    charge = 10 * c * 1e4  # statC cm^2 in one C m^2
    gaussian = record(
        f"--inertia 2e-20 1e-20 --charged {1e-23 * charge!r} {2e-23 * charge!r} --magnetic 1e4 2e4 --omega 0.1 0.2 0.3 "
        "--units gaussian"
    )
    assert si["period"] == pytest.approx(gaussian["period"], rel=1e-14, abs=0.0)
    coat = record(
        "--shape solid-cylinder --coat cylindrical-shell --radius 2 --height 3 --mass 3 --charge 5 --magnetic 1 2 "
        "--omega 0 1 1"
    )
    body = atlas.SymmetricBody.solid_cylinder(3, 2, 3)
    charges = atlas.ChargeMoments.shape("cylindrical_shell", 5, radius=2, height=3)
    top = atlas.TopMotion.charged(body, charges, (1, 2), (0, 1, 1), units="SI")
    assert coat["turning_points"] == list(top.turning_points)
    assert coat["parameters"]["top"]["coupling"] == list(top.coupling)


def test_point_masses_may_have_any_charges(tmp_path: Path) -> None:
    """A ring of charges on heavy poles, from a file; charges off the centre of mass are refused with the reason."""
    rows = ["1,0,0,1,2", "-1,0,0,1,2", "0,1,0,1,2", "0,-1,0,1,2", "0,0,1,5,0", "0,0,-1,5,0"]
    path = tmp_path / "points.csv"
    path.write_text("\n".join(["x,y,z,mass,charge", *rows]), "utf-8")
    computed = record(f"--points {path} --magnetic 1 2 --omega 0.1 0.2 0.3")
    top = atlas.TopMotion.charged(
        atlas.SymmetricBody(12.0, 4.0), atlas.ChargeMoments(4.0, 8.0), (1, 2), (0.1, 0.2, 0.3), units="SI"
    )
    assert computed["period"] == pytest.approx(top.period, rel=1e-14, abs=0.0)
    path.write_text("\n".join(["x,y,z,mass,charge", *rows[:-1], "0,0,-1,5,3"]), "utf-8")
    outcome = CliRunner().invoke(TOP, f"--points {path} --magnetic 1 2 --omega 0.1 0.2 0.3".split())
    assert "centre of charge is off the centre of mass" in str(outcome.exception)
    assert "of a body held at a point, say held=True, or --heavy." in str(outcome.exception)


@pytest.mark.parametrize(("up", "sign"), [("", 1), ("--direction -3 -4", -1)])
def test_a_charged_heavy_top_has_both_forces(tmp_path: Path, up: str, sign: int) -> None:
    """A charged ring on a rod, from its shape, its moments and its points: the values of m, e, g, l and B by hand."""
    m, e, r, g, l, B = 3.0, 0.5, 2.0, 9.81, 0.7, 5.0
    J2, J3 = e * (r * r / 2 + l * l), e * r * r
    byhand = atlas.TopMotion(
        (m * (r * r / 2 + l * l), m * r * r), (J2 * B / 2, J3 * B / 2), (3, 4), (0.1, 0.2, 3), linear=sign * m * g * l
    )
    path = tmp_path / "points.csv"
    ring = "\n".join(f"{x},{y},9,{m / 4},{e / 4}" for x, y in ((r, 0), (-r, 0), (0, r), (0, -r)))
    path.write_text(f"x,y,z,mass,charge\n{ring}\n", "utf-8")
    ways = (
        f"--shape ring --radius {r} --mass {m} --coat ring --charge {e}",
        f"--inertia {m * r * r / 2} {m * r * r} --mass {m} --charged {J2} {J3}",
        f"--points {path}",
    )
    for way in ways:
        computed = record(f"{way} --heavy {g} {l} --magnetic 3 4 --omega 0.1 0.2 3 {up}")
        assert computed["period"] == pytest.approx(byhand.period, rel=1e-13)
        assert computed["precession_per_period"] == pytest.approx(byhand.precession_per_period, rel=1e-12)


def test_a_steady_motion_says_whether_it_is_stable() -> None:
    """The sleeping top beyond and within its band."""
    words = "--inertia 1 0.5 --direction 0 1 --linear 4 --omega 0 0"
    assert record(f"{words} 8.1")["stable"] == "stable"
    assert record(f"{words} 7.9")["stable"] == "unstable"
    assert record("--inertia 1 0.5 --direction 0.6 0.8 --linear 4 --omega 0 0 8")["stable"] == "not steady"
