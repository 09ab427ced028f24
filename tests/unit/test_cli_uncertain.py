"""Numbers typed with an uncertainty: printed deviations against a Monte Carlo and against closed forms."""

import json
import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from uncertainties import ufloat

import atlas
from atlas.arithmetic import uncertainty
from atlas.arithmetic.uncertainty import concise
from atlas.cli.app import atlas as command
from atlas.motions.torus.certified_torus import Torus
from atlas.motions.torus.kernel import in_basis_near


@pytest.fixture(autouse=True)
def few(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let as few draws be made as make sense."""
    monkeypatch.setattr(uncertainty, "DRAWS", 50)


def run(words: str) -> tuple[int, str]:
    """Return status and output of a command."""
    outcome = CliRunner().invoke(command, words.split())
    return outcome.exit_code, outcome.output


def test_slow_answers_are_sampled_by_fewer_draws(monkeypatch: pytest.MonkeyPatch) -> None:
    """A hundred draws then, which is said, and a deviation to 7 %."""
    monkeypatch.setattr(uncertainty, "DRAWS", 150)
    words = "motion --ratio 1.3 --field 1 2 --omega 0.3 0.7(0.3) 0.2"
    for slow, draws in ((60.0, 150), (0.0, 100)):
        monkeypatch.setattr(uncertainty, "SLOW_ANSWER", slow)
        assert f"by sampling, {draws} draws" in run(words)[1]


def numbers(words: str) -> dict[str, Any]:
    """Return a command's output as JSON."""
    status, out = run(f"{words} --json")
    assert status == 0, out
    return dict(json.loads(out))


def test_deviations_agree_with_a_monte_carlo_sample() -> None:
    """Of a body and a field that are known within a percent; the numbers stay those of the middle."""
    record = numbers("motion --ratio 1.3(0.01) --field 1.00(2) 2 --omega 0.3 0.7 0.2 --times 3")
    draw = np.random.default_rng(3).normal
    many = atlas.GeneralMotion(draw(1.3, 0.01, 4000), (draw(1.0, 0.02, 4000), 2.0), (0.3, 0.7, 0.2))
    motion = atlas.GeneralMotion(1.3, (1.0, 2.0), (0.3, 0.7, 0.2))
    for name in ("period", "precession_per_period", "precession_rate", "spin_rate", "modulus"):
        assert record[name] == pytest.approx(getattr(motion, name), rel=1e-13), name
        assert record["sigma"][name] == pytest.approx(float(getattr(many, name).std()), rel=0.06), name
    R = np.array(record["sigma"]["samples"][0]["R"])
    assert pytest.approx(many.rotation(3.0).std(axis=0), rel=0.08) == R


def test_deviations_of_charge_and_radius_reach_the_larmor_frequency() -> None:
    """Larmor's frequency q B/(2 m) has the relative deviation of the charge, and of a sphere's mass three of r."""
    words = "--height 3um --density 1850kg/m3 --magnetic 0.4T 0.69T --spin 2MHz"
    record = numbers(f"motion --shape solid-cylinder --radius 1.20(3)um --charge 5000(200)e {words}")
    relative = math.hypot(200 / 5000, 2 * 0.03 / 1.2)
    assert record["sigma"]["larmor"] / record["larmor"] == pytest.approx(relative, rel=1e-3)
    status, out = run(f"motion --shape solid-cylinder --radius 1.20(3)um --charge 5000(200)e {words}")
    assert status == 0
    hertz = re.search(r"larmor/2 pi +([\d.]+)\((\d+)\) +Hz", out)
    assert hertz is not None
    assert float(hertz[1]) == pytest.approx(record["larmor"] / (2 * math.pi), abs=1e-4)
    assert "by derivatives" in out


@pytest.mark.parametrize("radius", ["1.20(0.03)um", "1.20±0.03um", "1.20+-3e-2um", "1.20+/-.03um"])
def test_an_uncertainty_is_read_in_brackets_or_after_a_sign(radius: str) -> None:
    """In brackets or after a sign, with a unit behind."""
    words = "motion --shape ring --mass 1kg --charge 1C --magnetic 0.1 0.2 --omega2 0.3 --radius"
    assert numbers(f"{words} {radius}") == numbers(f"{words} 1.20(3)um")


def test_deviations_of_strength_and_angle_of_a_field_reach_the_rates() -> None:
    """A precession's k = omega2/sin(angle), (79), has that of the angle alone, Larmor's frequency that of strength."""
    record = numbers("motion --ratio 1.3 --magnetic 0.8(1)T --angle 30(2)deg --mu 1C/kg --omega2 0.3")
    slope = 0.3 * math.cos(math.pi / 6) / math.sin(math.pi / 6) ** 2
    assert record["k"] == pytest.approx(0.6)
    assert record["sigma"]["k"] == pytest.approx(slope * math.pi / 90, rel=1e-2)
    assert record["larmor"] == pytest.approx(0.4)
    assert record["sigma"]["larmor"] == pytest.approx(0.05)


def test_deviations_of_the_field_reach_particles_and_balls() -> None:
    """A particle's e B/m has that of B, a ball's gamma = |(0, m2, m3 + larmor)| of its Larmor frequency, (29)."""
    record = numbers("particle --mass 1u --charge 1e --electric 0 0.5V/m 0 --magnetic 0 0 1.0(1)T --velocity 1km/s 0 0")
    assert record["sigma"]["cyclotron_frequency"] / record["cyclotron_frequency"] == pytest.approx(0.1)
    record = numbers("ball --larmor 0.50(1) --momentum 0.3 -0.7")
    assert record["sigma"]["gamma"] == pytest.approx(0.01 * 0.2 / math.hypot(0.3, 0.2), rel=1e-2)
    words = "top --inertia 1 0.5 --magnetic 1 2 --charged 0.1(0.01) 0.2 --omega 1 2 3"
    assert numbers(words)["sigma"]["period"] > 0


def test_quantities_beyond_first_order_are_sampled_and_named() -> None:
    """The modulus is not of first order in a wide omega2: that is said, and it has the same digits each time."""
    status, out = run("motion --ratio 1.3 --field 1 2 --omega 0.3 0.7(0.3) 0.2")
    assert (status, out) == run("motion --ratio 1.3 --field 1 2 --omega 0.3 0.7(0.3) 0.2")
    assert status == 0
    sampled = re.search(r"^Of (.+) by sampling, \d+ draws", out, re.MULTILINE)
    assert sampled is not None
    assert "modulus" in sampled[1]


def test_at_the_end_of_the_domain_the_derivative_is_one_sided() -> None:
    """By (71) omega3 = omega2 B3 (3 - I)/(2 I B2), of slope -3/I^2 here, and no body has I > 2; the modulus is bent."""
    record = numbers("motion --ratio 2.00(1) --field 1 2 --omega2 1")
    assert record["sigma"]["omega3"] == pytest.approx(0.01 * 3 / 2**2, rel=1e-3)
    assert record["sigma"]["phi"] == pytest.approx(0.01 * 3 / 2**2, rel=1e-3)
    assert "on one side" in record["notes"][1]
    record = numbers("motion --ratio 1.995(10) --field 1.00(1) 2 --omega 0.3 0.7 0.2")
    assert record["sigma"]["period"] > 0
    assert record["sigma"]["modulus"] is None
    assert "modulus, nome no deviation" in record["notes"][-1]


def test_an_input_of_a_negligible_share_does_not_ask_for_sampling() -> None:
    """The precession's rate hardly depends on B3, and that not to first order: by derivatives it is right."""
    status, out = run("motion --ratio 1.30(1) --field 1.00(1) 1.60(2) --omega 0.3 0.7 0.2")
    assert status == 0
    assert "0.8317(72)" in out
    assert "by sampling" not in out


def test_numbers_that_depend_on_all_inputs_together_have_a_deviation() -> None:
    """A product of two numbers about zero has that of either times that of the other."""
    record = numbers("motion --ratio 1.3 --magnetic 0.0(2) 0 --mu 0.0(1) --omega 0.3 0.7 0.2")
    assert record["sigma"]["larmor"] > 0


def test_a_sweep_has_a_column_for_each_deviation(tmp_path: Path) -> None:
    """A row's deviations are those that `atlas motion` prints, also of inputs that share a charge."""
    words = "--shape ring --radius 1.20(3) --mass 1 --charge 2.0(1) --magnetic 0.4 0.69"
    status, out = run(f"sweep elementary {words} --set omega2=0.2,0.3 --quantity phi case --out {tmp_path / 'a.csv'}")
    assert status == 0, out
    head, names, *rows = (tmp_path / "a.csv").read_text().splitlines()
    assert "B2 = 0.400(20)" in head
    assert names.endswith("phi [1/s],case,phi_sigma [1/s]")
    for omega2, row in zip((0.2, 0.3), rows, strict=True):
        sigma_phi = numbers(f"motion {words} --omega2 {omega2}")["sigma"]["phi"]
        assert float(row.split(",")[-1]) == pytest.approx(sigma_phi, rel=1e-6)
    table = atlas.sweep("elementary", {"ratio": ufloat(1.3, 0.1), "B2": 1, "B3": 2, "omega2": [0.2, 0.3]}, ["phi"])
    motions = [atlas.ElementaryMotion(ufloat(1.3, 0.1), (1, 2), omega2) for omega2 in (0.2, 0.3)]
    assert table["phi_sigma"] == pytest.approx([motion.phi.std_dev for motion in motions])


@pytest.mark.parametrize(("error", "text"), [(0.0, "12.57(31)"), (0.009, "12.57(31)"), (0.02, "12.6(3)")])
def test_a_digit_below_the_error_of_a_deviation_is_not_printed(error: float, text: str) -> None:
    """A deviation by sampling has as many digits as are known of it."""
    assert concise(12.5663, 0.31, error) == text


@pytest.mark.parametrize(
    ("value", "sigma", "text"),
    [
        (12.5663, 0.31, "12.57(31)"),
        (-0.01276, 5.1e-4, "-0.01276(51)"),
        (12566370.6, 2e4, "1.2566(20)e+07"),
        (1.0, 0.0, "1"),
        (5000.0, 2.3, "5000.0(2.3)"),
        (1e-9, 9.96e-11, "1.00(10)e-09"),
        (0.0, 0.02, "0.000(20)"),
    ],
)
def test_the_last_two_digits_have_the_deviation(value: float, sigma: float, text: str) -> None:
    """In brackets stands the standard deviation, in units of the last digit."""
    assert concise(value, sigma) == text


@pytest.mark.slow
def test_draws_of_a_torus_have_the_certified_frequencies(monkeypatch: pytest.MonkeyPatch) -> None:
    """Draws take them from theta functions, the first answer from proved periods, which a draw need not prove."""
    motion: Any = atlas.motion((0.9, 1.1, 1.45), (0, 1, 2), (0.3, 0.7, 0.2))
    np.testing.assert_allclose(motion._frequencies_near(motion.frequencies), motion.frequencies, rtol=1e-14)
    proofs = []
    proved = Torus._enclosed
    monkeypatch.setattr(Torus, "_enclosed", lambda *args: proofs.append(args) or proved(*args))
    record = numbers("motion --inertia 0.90(1) 1.1 1.45 --field 0 1 2 --omega 0.3 0.7 0.2")
    assert len(proofs) <= 2, "two periods of the middle"
    assert all(record["sigma"]["frequencies"])


@pytest.mark.slow
def test_frequencies_of_a_neighbour_are_in_the_same_basis() -> None:
    """The bases of I1 = 0.75 and 0.8 differ, f1 by f2: the deviation of f1 is that of its slope, not of a jump."""
    middle, neighbour = (atlas.AsymmetricMotion((I1, 1.1, 1.45), (0, 1, 2), (0.3, 0.7, 0.2)) for I1 in (0.8, 0.75))
    f1, f2, f3 = neighbour.frequencies
    assert abs(f1 - middle.frequencies[0]) > 0.5
    np.testing.assert_allclose(neighbour._frequencies_near(middle.frequencies), (f1 + f2, f2, f3), rtol=1e-13)


def test_the_basis_nearest_to_equal_frequencies_is_a_basis() -> None:
    """Both frequencies would be nearest as one combination, which generates no other."""
    root = 3.0**0.5
    f1, f2, _ = in_basis_near([2.0, root, 0.1], [root, root, 0.1])
    assert f1 != f2
    assert {round(x, 12) for x in (f1, f2)} <= {round(a * 2.0 + b * root, 12) for a in (-1, 0, 1) for b in (-1, 0, 1)}


def test_a_deviation_of_zero_is_none() -> None:
    """A number typed as 1.5(0) is 1.5."""
    words = "motion --ratio {} --field 1 2 --omega2 0.7 --times 1"
    assert run(words.format("1.5(0)")) == run(words.format("1.5"))
