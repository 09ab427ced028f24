"""Typed inputs are evaluated: any field, any attitude and products of inputs reach the constants unrounded."""

import json
from fractions import Fraction
from functools import reduce
from operator import mul
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from scipy.spatial.transform import Rotation

import atlas
from atlas.arithmetic.certified_digits import enclosed
from atlas.arithmetic.numbers import nearest
from atlas.cli.app import atlas as command
from atlas.errors import NearlySymmetricWarning
from atlas.motions.frames import turned_by
from atlas.motions.nutation.certified_general import GeneralMotion as Balls
from atlas.motions.torus.approximate_periods import Curve
from atlas.sweeps.plan import Plan

EPS = 2.0**-52
RATIO = 0.7157322617930502
FIELD = (-0.765050795081338, 1.0200677267751173, 0.19211036905670717)
OMEGA = (0.8801646474639836, -1.1735528632853114, 0.2745993411764893)
"""A start beside the paper's curve, where that is unstable: it leaves it as exp(0.52 t)."""


def taylor(ratio: float, field: Any, omega: Any, t: float, bits: int = 220, order: int = 50) -> np.ndarray:
    """Return the third row of R(t) by Taylor series of (12), (21) and (27) in integers over 2^bits."""
    I, unity = Fraction(ratio), 1 << bits
    rows = [[int(Fraction(x) * unity) for x in v] for v in (field, omega, (0, 0, 1))]
    steps = int(np.ceil(abs(t) * 5 * max(map(abs, (*field, *omega)))))
    h = int(Fraction(t) / steps * unity)

    def times(x: list[int], factor: Fraction) -> list[int]:
        return [y * factor.numerator // factor.denominator for y in x]

    for _ in range(steps):
        series = [[[x] for x in row] for row in rows]
        momentum = [[], [], []]  # type: list[list[int]]
        for n in range(order):
            K, w, e = series
            for i, (moment, pull) in enumerate(((Fraction(1), I), (Fraction(1), I), (I, 2 - I))):
                momentum[i] += [*times(w[i][n:], moment)]
                momentum[i][n] -= times(K[i][n:], pull)[0]

            def crossed(a: Any, b: Any) -> list[int]:
                """Return the next coefficients of a vector product."""
                return [
                    (sum(map(mul, a[i - 2], b[i - 1][::-1])) - sum(map(mul, a[i - 1], b[i - 2][::-1]))) >> bits
                    for i in range(3)
                ]

            spin = crossed(momentum, w)
            rates = [crossed(K, w), [spin[0], spin[1], times(spin[2:], 1 / I)[0]], crossed(e, w)]
            for row, rate in zip(series, rates, strict=True):
                for x, y in zip(row, rate, strict=True):
                    x.append(y // (n + 1))
        rows = [[reduce(lambda value, c: c + (value * h >> bits), x[::-1]) for x in row] for row in series]
    return np.array([x / unity for x in rows[2]])


def balls(ratio: float, field: Any, omega: Any, t: float) -> np.ndarray:
    """Return R(t) of the certified counterpart, each entry rounded once."""
    exact = Balls.at_state(ratio, omega, field)
    return np.array([[nearest(x) for x in row] for row in enclosed(lambda: exact.rotation(t), 60)])


@pytest.mark.slow
def test_an_unstable_start_beside_the_curve_departs() -> None:
    """R33 at t = 30, 60, 100 is that of Taylor series, of proven digits and of the motion of three moments."""
    m = atlas.motion(RATIO, FIELD, OMEGA)
    three = atlas.AsymmetricMotion((1.0, 1.0, RATIO), FIELD, OMEGA)
    assert m.family == "general"
    assert np.abs(m.rotation(60.0)[2] - taylor(RATIO, FIELD, OMEGA, 60.0)).max() <= 16 * EPS
    for t in (30.0, 60.0, 100.0):
        assert np.abs(m.rotation(t) - three.rotation(t)).max() <= 16 * EPS
        assert np.abs(m.rotation(t) - balls(RATIO, FIELD, OMEGA, t)).max() <= 16 * EPS
    assert round(m.rotation(100.0)[2, 2], 9) == 0.981765980


def unstable(seed: int) -> tuple[float, np.ndarray, np.ndarray]:
    """Return a start on the unstable band, rounded, turned about the body's axis by some angle."""
    rng = np.random.default_rng(seed)
    ratio, slope, angle = rng.uniform(0.3, 0.95), rng.uniform(0.02, 0.3), rng.uniform(0, 2 * np.pi)
    bend = np.sqrt(1 - 8 * slope**2)
    ends = [(1 - ratio) * (1 - 2 * slope**2 + s * bend) / (2 * (1 + slope**2)) for s in (-1, 1)]
    x = np.sqrt(rng.uniform(*ends))
    field = atlas.ElementaryMotion(ratio, (1.0, slope), x - 1)
    turn = Rotation.from_euler("z", angle).as_matrix()
    return ratio, turn @ (0.0, 1.0, slope), turn @ (0.0, x - 1, field.omega3)


@pytest.mark.slow
def test_sixty_turned_starts_on_the_unstable_band_agree_with_proven_digits() -> None:
    """In the body's axes and from an attitude, whose rotation is that of its quaternion, up to t = 100."""
    for seed in range(60):
        ratio, B, w = unstable(seed)
        for t in (30.0, 100.0):
            assert np.abs(atlas.motion(ratio, B, w).rotation(t) - balls(ratio, B, w, t)).max() <= 16 * EPS
        if seed < 10:
            A = Rotation.random(random_state=seed).as_matrix()
            m = atlas.motion(ratio, A @ B, w, A)
            A = m.given[2]
            K = turned_by(m.given[1].tolist(), A.T)
            R = balls(ratio, K, w, 100.0)
            assert np.abs(m.rotation(100.0) - A @ R).max() <= 32 * EPS


@pytest.mark.slow
def test_fields_of_three_components_move_a_body_as_taylor_series_do() -> None:
    """Any ratio, field and start; arrays have each motion as it is alone, at any time."""
    rng = np.random.default_rng(7)
    ratio, B, w = rng.uniform(0.3, 1.9, 2), rng.normal(size=(2, 3)), rng.normal(size=(2, 3))
    A = Rotation.random(2, random_state=2).as_matrix()
    motion_array, placed = atlas.motion(ratio, B, w), atlas.motion(ratio, B, w, A)
    for i in range(2):
        motion_alone = atlas.GeneralMotion(ratio[i], B[i], w[i])
        assert np.abs(motion_alone.rotation(30.0)[2] - taylor(ratio[i], B[i], w[i], 30.0)).max() <= 16 * EPS
        for t in (30.0, 1e9):
            assert np.abs(motion_array.rotation(t)[i] - motion_alone.rotation(t)).max() <= 64 * EPS
            motion = atlas.motion(ratio[i], B[i], w[i], A[i])
            assert np.abs(placed.rotation(t)[i] - motion.rotation(t)).max() <= 64 * EPS
            assert np.abs(placed.quaternion(t)[i] - motion.quaternion(t)).max() <= 64 * EPS
            assert np.abs(placed.angular_velocity(t)[i] - motion.angular_velocity(t)).max() <= 128 * EPS
        assert motion_array.period[i] == motion_alone.period


@pytest.mark.slow
@pytest.mark.parametrize("ratio", [1.0, 1.5, (0.8, 1.0, 1.3)])
def test_a_turned_laboratory_turns_the_motion_at_any_time(ratio: Any) -> None:
    """By a third of a turn about (1, 1, 1), which floats hold; by another turn the constants lose no digit."""
    B, w, t = (0.3, -1.0, 2.0), (0.3, 0.7, 0.2), 1e10
    third = np.eye(3)[[1, 2, 0]]
    plain = atlas.motion(ratio, B, w).rotation(t)
    assert np.abs(atlas.motion(ratio, third @ B, w, third).rotation(t) - third @ plain).max() <= 64 * EPS
    A = Rotation.from_euler("zyx", (0.1, 0.2, 0.3)).as_matrix()
    K = [float(x) for x in turned_by(list(B), A.T)]
    assert (
        np.abs(atlas.motion(ratio, B, w, A).rotation(1e3) - A @ atlas.motion(ratio, K, w).rotation(1e3)).max() < 1e-11
    )


def test_no_class_is_chosen_within_a_tolerance() -> None:
    """On the curve exactly a start is elementary, as a ball's is in its own class; an ulp beside it is not."""
    K, w = np.array([3.0, 4.0, 5.0]), np.array([3.0, 4.0, 12.5])
    assert atlas.motion(0.5, K, w).family == "elementary"
    for j in range(3):
        w_next = w.copy()
        w_next[j] = np.nextafter(w[j], 99)
        assert atlas.motion(0.5, K, w_next).family == "general"
    t = np.array([1.0, 1e6])
    motion, motion_general = atlas.motion(0.5, K, w), atlas.GeneralMotion(0.5, K, w)
    assert motion_general.kind == "precession"
    assert np.abs(motion.rotation(t) - motion_general.rotation(t)).max() <= 16 * EPS


def test_a_ball_in_any_field_agrees_with_its_general_motion() -> None:
    """Two turns whose rates are not rounded before they are multiplied by a time."""
    B, w, A = (0.3, -1.1, 2.3), (0.7, 0.2, -0.4), Rotation.random(random_state=4).as_matrix()
    for body in (1.0, (0.7, 0.7, 0.7)):
        ball, general = atlas.motion(body, B, w, A), atlas.GeneralMotion.in_laboratory(1.0, B, A, A @ w)
        assert ball.family == "ball"
        assert np.abs(ball.rotation(1e3) - general.rotation(1e3)).max() <= 1e-12
        exact = atlas.GeneralMotion(1.0, B, w).rotation(1e12)
        assert np.abs(atlas.motion(body, B, w).rotation(1e12) - exact).max() <= 32 * EPS


def test_a_product_of_inputs_is_not_rounded() -> None:
    """B' = mu B/2 at t = 1e9: a Field, fractions, the command in doubles and its proven digits say the same."""
    B, mu, w, t = (-1.429, 1.091), 1.5, (-0.1972, -0.7, 1.0000000000000002), 1e9
    K = [Fraction(mu) * Fraction(x) / 2 for x in B]
    true = balls(0.873, [Fraction(0), *K], w, t)
    field = atlas.Field((0.0, *B), mu=mu)
    for m in (
        atlas.GeneralMotion(0.873, field, w), atlas.GeneralMotion(0.873, K, w), atlas.motion(0.873, field, w),
        atlas.motion(0.873, [0, *K], w),
    ):  # fmt: skip
        assert np.abs(m.rotation(t) - true).max() <= 16 * EPS
    rows = atlas.GeneralMotion(0.873, field, (w[0], w[1], np.array([w[2], 0.5])))
    assert np.abs(rows.rotation(t)[0] - true).max() <= 64 * EPS
    words = f"motion --ratio 0.873 --magnetic {B[0]} {B[1]} --mu {mu} --omega {w[0]} {w[1]} {w[2]} --times {t} --json"
    matrix = json.loads(CliRunner().invoke(command, words.split()).stdout)["samples"][0]["R"]
    assert np.abs(np.array(matrix) - true).max() <= 16 * EPS


def test_the_moments_of_a_heavy_top_are_not_rounded() -> None:
    """I2 + m l^2 and m g l as fractions are those of `TopMotion.heavy`, at t = 1e9."""
    body, g, l, m = atlas.SymmetricBody(0.3, 0.2), 9.81, 0.7, 1.3
    top = atlas.TopMotion.heavy(body, g, l, (0.6, 0.8), (0.1, 0.2, 5.0), mass=m)
    I_pivot, linear = Fraction(0.3) + Fraction(m) * Fraction(l) ** 2, Fraction(m) * Fraction(g) * Fraction(l)
    same = atlas.TopMotion((I_pivot, 0.2), (0, 0), (0.6, 0.8), (0.1, 0.2, 5.0), linear=linear)
    rounded = atlas.TopMotion((float(I_pivot), 0.2), (0, 0), (0.6, 0.8), (0.1, 0.2, 5.0), linear=float(linear))
    assert np.abs(top.rotation(1e9) - same.rotation(1e9)).max() <= 8 * EPS
    assert np.abs(top.rotation(1e9) - rounded.rotation(1e9)).max() > 1e-9


@pytest.mark.slow
def test_the_error_of_rounded_inputs_bounds_the_effect_of_an_ulp() -> None:
    """On the unstable start each input moved by half an ulp, in twice the digits, turns the body by no more."""
    m = atlas.motion(RATIO, FIELD, OMEGA)
    t = 30.0
    bound, R, turn_sum = float(m.input_error(t)), m.rotation(t), 0.0
    for j in range(3):
        for input_index in (0, 1):
            state = [[Fraction(x) for x in v] for v in (FIELD, OMEGA)]
            state[input_index][j] += Fraction(float(np.spacing(abs((FIELD, OMEGA)[input_index][j])))) / 2
            rotation_moved = atlas.motion(RATIO, *state).rotation(t)
            turn_sum += Rotation.from_matrix(rotation_moved @ R.T).magnitude()
    assert 1e-12 < turn_sum <= 1.01 * bound <= 4 * turn_sum
    words = [
        "motion", "--ratio", repr(RATIO), "--field", *map(repr, FIELD), "--omega", *map(repr, OMEGA),
        "--times", "30", "145",
    ]  # fmt: skip
    assert m.input_error(145.0) < 1e-12  # far from the start, where neighbours meet again
    outputs = [CliRunner().invoke(command, [*words, *options]).stdout for options in ([], ["--json"])]
    assert outputs[0].count("Rounding the inputs to floats turns the body by up to 2e-09 rad at t = 30;") == 1
    assert json.loads(outputs[1])["input_error"] == bound


def test_a_sweep_reports_the_effect_of_rounded_inputs(tmp_path: Path) -> None:
    """Of the first of the latest rows, where functions of time are asked for and the turn can be felt."""
    start = [*"sweep general --ratio 1.5 --field 1 2 --set omega1=0.3 omega2=0.7 omega3=0.2".split(), "--out"]
    clause = "Rounding the inputs to floats turns the body by up to 1e-10 rad at t = 1e+06, in the first row"
    for quantity, end, is_reported in (("R33", "1e6", True), ("period", "1e6", False), ("R33", "10", False)):
        words = [*start, str(tmp_path / "table.csv"), "--set", f"t=0:{end}:3", "--quantity", quantity]
        assert (clause in CliRunner().invoke(command, words).stderr) is is_reported


def test_the_series_give_a_ball_its_two_turns() -> None:
    """The oracle of the laws above, where the answer is two rotations by hand."""
    B, w, t = (0.3, -1.0, 2.0), (0.3, 0.7, 0.2), 3.0
    rotations = Rotation.from_rotvec(-t * np.array(B)) * Rotation.from_rotvec(t * (np.array(B) + w))
    assert np.abs(taylor(1.0, B, w, t) - rotations.as_matrix()[2]).max() <= 16 * EPS


@pytest.mark.slow
def test_a_symmetric_tensor_turned_in_floats_has_its_three_moments_at_any_time() -> None:
    """Two of its moments differ by rounding: the warning names the symmetric body, near which it moves for long."""
    P = Rotation.random(random_state=2).as_matrix()
    tensor = P.T @ np.diag([1.0, 1.0, 1.5]) @ P
    with pytest.warns(NearlySymmetricWarning, match=r"atlas\.SymmetricBody\(0\.99.*third axis") as warned:
        m = atlas.motion((tensor + tensor.T) / 2, (0.3, 0.1, 1.0), (0.2, 0.3, 1.0))
    assert len(warned) == 1
    assert m.family == "asymmetric"
    same = atlas.motion(atlas.SymmetricBody(1.0, 1.5, P), (0.3, 0.1, 1.0), (0.2, 0.3, 1.0))
    assert np.abs(m.rotation(3.0) - same.rotation(3.0)).max() < 1e-14
    assert "proved for this motion" in m.agreement
    difference = np.abs(m.rotation(1e5) - same.rotation(1e5)).max()
    assert 0 < difference < 1e-8


def test_an_unknown_rounding_error_is_reported_as_unknown() -> None:
    """No derivatives are at hand of a motion with three moments, and none exist of one about a principal axis."""
    for words in ("--field 0.4 0.1 1.2 --omega 0.5 0.3 1.1", "--field 0 0 1.2 --omega 0 0 1.1"):
        words_motion = ["motion", "--inertia", "0.8", "1", "1.2", *words.split(), "--times"]
        output = CliRunner().invoke(command, [*words_motion, "1e9"], catch_exceptions=False).output
        assert "turns the body by an angle that is not known at t = 1e+09;" in " ".join(output.split())
        assert "not known" not in CliRunner().invoke(command, [*words_motion, "1"], catch_exceptions=False).output


@pytest.mark.filterwarnings("ignore::atlas.errors.NearlySymmetricWarning")
def test_a_ball_turned_in_floats_seeks_no_periods(monkeypatch: pytest.MonkeyPatch) -> None:
    """Its slowest period is out of reach: it is certified at once, without integrals along the paths of its torus."""
    monkeypatch.setattr(Curve, "integrals", lambda *_: pytest.fail("an integral was taken"))
    P, field, omega = Rotation.random(random_state=2).as_matrix(), (0.3, 0.1, 1.0), (0.2, 0.3, 1.0)
    tensor = P.T @ np.eye(3) @ P
    m = atlas.motion((tensor + tensor.T) / 2, field, omega)
    assert m.family == "asymmetric"
    assert np.abs(m.rotation(3.0) - atlas.motion(1, field, omega).rotation(3.0)).max() < 1e-14
    assert "so nearly a ball" in m.agreement


def test_a_sweep_evaluates_the_product_that_was_typed(tmp_path: Any) -> None:
    """B' of --magnetic and mu stays exact in doubles at t = 1e9; rows as a list, which a worker gets, have it too."""
    words = "--ratio 0.873 --magnetic -1.429 1.091 --mu 1.5 --omega -0.1972 -0.7 1.0000000000000002"
    table = tmp_path / "t.csv"
    options = ["--set", "t=1e9,5", "--quantity", "R33", "--out", str(table)]
    assert CliRunner().invoke(command, ["sweep", "general", *words.split(), *options]).exit_code == 0
    value = float(table.read_text().splitlines()[-2].split(",")[-1])
    m = atlas.GeneralMotion(0.873, (Fraction(-1.429) * 3 / 4, Fraction(1.091) * 3 / 4), (-0.1972, -0.7, 1 + EPS))
    assert abs(value - m.rotation(1e9)[2, 2]) <= 16 * EPS
    parameters = {"ratio": 0.873, "B2": Fraction(-1.429) * 3 / 4, "B3": Fraction(1.091) * 3 / 4}
    parameters |= {"omega1": -0.1972, "omega2": -0.7, "omega3": 1 + EPS, "t": [5.0, 1e9]}
    plan = Plan.of("general", parameters, ["R33"])
    assert plan.list_of(1, 2).rows()["R33"][0] == pytest.approx(value, abs=16 * EPS)


def test_fractions_of_a_diagonal_tensor_are_not_rounded() -> None:
    """Moments in a tuple, a list or a matrix are one body; equal ones are so as given, not by their doubles."""
    third, start = Fraction(1, 3), ((0.3, 0.0, 1.0), (0.0, 0.1, 3.0))
    for moments in ((third, third, 0.5), (third, Fraction(2, 3), 0.5)):
        inputs = [moments, [*moments], [[moments[0], 0, 0], [0, moments[1], 0], [0, 0, moments[2]]]]
        exact = [repr(atlas.motion(inertia, *start).own.arguments) for inertia in inputs]
        assert exact[0] == exact[1] == exact[2]
        assert "Fraction(1, 3)" in exact[0]
    assert atlas.motion((third, 1 / 3, 0.5), *start).family == "asymmetric"
