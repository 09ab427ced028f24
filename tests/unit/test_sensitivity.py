"""Derivatives of motions in their inputs, against differences of balls and against laws."""

from typing import Any

import numpy as np
import pytest
from flint import arb, fmpq
from scipy.spatial.transform import Rotation

import atlas
from atlas.arithmetic.numbers import rational, workprec
from atlas.motions.elementary.certified import ElementaryMotion, FreeMotion
from atlas.motions.elementary.certified_ball import BallMotion
from atlas.motions.nutation.certified_elliptic import EllipticMotion
from atlas.motions.nutation.certified_general import GeneralMotion
from atlas.motions.nutation.certified_top import TopMotion

STEP, BITS, BOUND = fmpq(1, 10**40), 1200, 1e-12
VECTORS = {"rotation": "rotation", "angular_velocity": "angular_velocity", "field": "field_in_body"}
TIMES = (0.0, 0.3, -7.0, 1e6)
GENERAL = ("ratio", "B2", "B3", "omega1", "omega2", "omega3")
TOP = ("I2", "I3", "k2", "k3", "n2", "n3", "omega1", "omega2", "omega3", "linear", "quadratic")
STEADY = atlas.ElementaryMotion(1.5, (1.0, 2.0), 0.7).omega3


class Differences:
    """Derivatives by two motions in balls that differ by 1e-40 in one input."""

    def __init__(self, make: Any, values: Any, place: int) -> None:
        exact = [rational(x) for x in values]
        self.motions = [make(*[x + (n * STEP if i == place else 0) for i, x in enumerate(exact)]) for n in (1, -1, 0)]

    def at(self, quantity: str, t: float) -> Any:
        """Return the derivative of a vector in the body, or v of the rotation."""
        with workprec(BITS):
            up, down, here = (getattr(x, quantity)(rational(t)) for x in self.motions)
            if quantity != "rotation":
                return np.array([float((arb(x - y) / (2 * arb(STEP))).mid()) for x, y in zip(up, down, strict=True)])
            turn = [
                [
                    sum((arb(up[i][k] - down[i][k]) * here[j][k] for k in range(3)), arb(0)) / (2 * arb(STEP))
                    for j in range(3)
                ]
                for i in range(3)
            ]
            return np.array([float(turn[i][j].mid()) for i, j in ((2, 1), (0, 2), (1, 0))])


def check(motion: Any, make: Any, values: Any, names: Any, times: Any = TIMES) -> None:
    """Compare each derivative at each time with the difference, of R, and of Omega and K at the last time."""
    differences = [Differences(make, values, i) for i in range(len(names))]
    for quantity, method in VECTORS.items():
        if not hasattr(differences[0].motions[0], method):
            continue
        when = times if quantity == "rotation" else times[-1:]
        derivatives, v = motion.sensitivity(np.array(when), names, quantity), motion.sensitivity(np.array(when), names)
        for j, name in enumerate(names):
            for i, t in enumerate(when):
                expected = differences[j].at(method, t)
                size = 1 + max(np.abs(expected).max(), np.abs(v[i, j]).max())
                if quantity != "rotation":
                    size *= 1 + np.abs(motion.angular_velocity(t)).max() + np.abs(getattr(motion, method)(t)).max()
                assert np.abs(derivatives[i, j] - expected).max() <= BOUND * size, (quantity, name, t)


@pytest.mark.parametrize(
    ("ratio", "field", "omega"),
    [
        (1.5, (1.0, 2.0), (0.3, 0.7, 0.2)),
        (0.5, (-1.0, 0.2), (0.3, 0.7, 2.0)),
        (1.0, (1.0, 2.0), (0.3, 0.7, 0.2)),  # a ball
        (1 + 1e-9, (1.0, 2.0), (0.3, 0.7, 0.2)),
        (1.5, (0.0, 0.0), (0.3, 0.7, 0.2)),  # no field
        (1.5, (1.0, 1e-9), (0.3, 0.7, 0.2)),
        (0.1, (0.1, 0.1), (1.0, 2.0, 300.0)),
        (1.5, (1.0, 2.0), (0.0, 0.7, STEADY)),  # within one rounding of a steady precession
        (1.5, (1.0, 0.0), (0.0, -1.0, 0.3)),  # a steady one
        (1.5, (0.0, 1.0), (0.0, 0.0, 0.3)),  # the axis along the field
        (1.5, (1.0, 1.0), (0.0, 0.0, 0.0)),  # at rest
        (0.5, (0.0, 0.6), (-0.1, 0.0, -0.2)),  # the field along the axis at the start only
        (1.5, (1e-17, 1.0), (0.3, 0.7, 0.2)),  # and but for rounding
        (0.5, (1.0, -3.0), (0.0, 1.5, 2.0 - 1e-8)),  # next to a triple root
        (1.5, (2e-13, 3.9), (0.0, 9e-11, -3.9)),  # a flat body, next to where it tips over
    ],
)
def test_sensitivity_of_a_general_motion_is_the_difference_of_two(ratio: float, field: Any, omega: Any) -> None:
    """Ordinary and hostile inputs, and borders between kinds, where constants are taken from one side."""
    values = (ratio, *field, *omega)
    check(
        atlas.GeneralMotion(ratio, field, omega), lambda I, B2, B3, *w: GeneralMotion(I, (B2, B3), w), values, GENERAL
    )


@pytest.mark.slow
@pytest.mark.parametrize(
    "values",
    [
        (1.0, 0.5, 0.0, 0.0, 0.6, 0.8, 0.1, 0.2, 5.0, 3.0, 0.0),  # Lagrange's
        (2.0, 1.5, 0.3, 0.9, 0.6, -0.8, 0.1, 0.2, 1.0, 0.2, -1.0),
    ],
)
def test_sensitivity_of_a_top_is_the_difference_of_two(values: Any) -> None:
    """Every input, also the coupling and the anisotropy that Lagrange's top has not."""
    x = values
    motion = atlas.TopMotion(x[:2], x[2:4], x[4:6], x[6:9], *x[9:])
    check(motion, lambda *x: TopMotion(x[:2], x[2:4], x[4:6], x[6:9], *x[9:]), values, TOP, (0.3, 1e6))


@pytest.mark.parametrize("values", [(0.8, 1.0, 1.3, 0.2, 1.0, 0.6, 1.7), (1.0, 1.0, 1.3, 0.2, 1.0, 0.6, 1.7)])
def test_sensitivity_of_an_elliptic_motion_is_the_difference_of_two(values: Any) -> None:
    """Three moments, and two equal ones: the border to elementary motions."""
    x = values
    names = ("I1", "I2", "I3", "B1", "B2", "B3", "z")
    check(atlas.EllipticMotion(x[:3], x[3:6], x[6]), lambda *x: EllipticMotion(x[:3], x[3:6], x[6]), values, names)


def test_sensitivity_of_two_turns_is_the_difference_of_two() -> None:
    """Elementary motions along their family, the free body and the ball."""
    for x in ((1.5, 1.0, 2.0, 0.7), (1.5, 1.0, 2.0, 0.0)):
        names = ("ratio", "B2", "B3", "omega2")
        check(
            atlas.ElementaryMotion(x[0], x[1:3], x[3]), lambda I, B2, B3, w: ElementaryMotion(I, (B2, B3), w), x, names
        )
    inputs_free = (0.7, 0.1, 0.2, 0.3)
    check(
        atlas.FreeMotion(inputs_free[0], inputs_free[1:]),
        lambda I, *w: FreeMotion(I, w),
        inputs_free,
        ("ratio", "omega1", "omega2", "omega3"),
    )
    ball = (1.0, 0.5, 0.3, -0.7)
    names = ("inertia", "larmor", "m2", "m3")
    check(atlas.BallMotion(*ball[:2], ball[2:]), lambda I, a, *m: BallMotion(I, a, m), ball, names)


def test_rates_scaled_together_are_time_scaled() -> None:
    """Sum of rate times dR/drate = t dR/dt, for any body, at any time."""
    t = np.array([0.5, 40.0, 1e9])
    motion = atlas.GeneralMotion(0.8, (0.4, -1.3), (0.9, 0.1, 2.2))
    names = ("B2", "B3", "omega1", "omega2", "omega3")
    v = motion.sensitivity(t, [*names, "t"])
    scaled = np.tensordot(v[:, :5], (0.4, -1.3, 0.9, 0.1, 2.2), (1, 0))
    size = 1 + np.abs(v).max((1, 2)) + t * np.abs(v[:, 5]).max(1)
    assert (np.abs(scaled - t[:, None] * v[:, 5]).max(1) <= 1e-13 * size).all()


def test_turning_body_and_field_turns_the_motion() -> None:
    """With R(0) and the field turned together R turns with them, whatever the time."""
    field, turn = np.array([0.3, 0.5, 1.1]), np.eye(3)
    start = atlas.FreeMotion(1.2, (0.3, 0.1, 0.5)).rotation(2.0)
    motion = atlas.GeneralMotion.in_laboratory(0.7, field, start, (0.2, -0.3, 1.5))
    v = motion.sensitivity(np.array([0.0, 3.0, 1e4]), ["a1", "a2", "a3", "B1", "B2", "B3"])
    for i in range(3):
        change = v[:, i] + np.einsum("j,mjk->mk", np.cross(turn[i], field), v[:, 3:])
        assert (np.abs(change - turn[i]) <= BOUND * (1 + np.abs(v).max((1, 2)))[:, None]).all()


def test_arrays_have_the_sensitivity_of_each() -> None:
    """Motions in an array, which broadcasts with the times."""
    ratios, t = np.array([[0.7], [1.3]]), np.array([0.4, 9.0, 100.0])
    derivatives = atlas.GeneralMotion(ratios, (1.0, 2.0), (0.3, 0.7, 0.2)).sensitivity(t, ["ratio", "t"])
    assert derivatives.shape == (2, 3, 2, 3)
    for i, ratio in enumerate(ratios[:, 0]):
        derivatives_alone = atlas.GeneralMotion(ratio, (1.0, 2.0), (0.3, 0.7, 0.2)).sensitivity(t, ["ratio", "t"])
        assert np.array_equal(derivatives[i], derivatives_alone)


def test_motions_without_sensitivity_are_refused() -> None:
    """A separatrix, a name that is no input, a period that is infinite."""
    with pytest.raises(atlas.DomainError, match="separatrix"):
        atlas.TopMotion((1.0, 1.0), (0.0, 0.0), (1.0, 0.0), (2.0, 0.0, 0.0), 2.0).sensitivity(1.0, "linear")
    with pytest.raises(atlas.AtlasError, match="no input 'omega4'"):
        atlas.GeneralMotion(1.5, (1.0, 2.0), (0.3, 0.7, 0.2)).sensitivity(1.0, ["omega4"])
    with pytest.raises(atlas.AtlasError, match="no derivative of 'speed'"):
        atlas.GeneralMotion(1.5, (1.0, 2.0), (0.3, 0.7, 0.2)).sensitivity(1.0, "ratio", "speed")
    for motion_still in (
        atlas.ElementaryMotion(1.5, (1.0, 2.0), np.array([0.7, 0.0])),
        atlas.FreeMotion(1.5, (0.0, 0.0, 0.0)),
        atlas.motion(1.5, (0.0, 1.0, 2.0), (0.0, 0.0, 0.0)),
    ):
        with pytest.raises(atlas.DomainError, match="The period is infinite and has no derivatives"):
            motion_still.sensitivity(0.0, "ratio", "period")
    upright = atlas.TopMotion.in_laboratory(
        (1.0, 0.5), (0, 0, 1.0), np.eye(3), (0, 0, 3.0), coupling=(0, 0), linear=1.0
    )
    with pytest.raises(atlas.DomainError, match="axis is along n"):
        upright.sensitivity(1.0, "B1")


def in_given_axes(**x: float) -> Any:
    """Return a motion in any axes, from inputs by name; a1 to a3 turn the body in the laboratory."""
    turn = Rotation.from_rotvec([x[f"a{i}"] for i in (1, 2, 3)])
    field, omega = ([x[f"{name}{i}"] for i in (1, 2, 3)] for name in ("B", "omega"))
    attitude = (turn * Rotation.from_rotvec([0.4, 0.1, -0.6])).as_matrix()
    if "k2" in x:
        inertia, coupling = (x["I2"], x["I3"]), (x["k2"], x["k3"])
        return atlas.TopMotion.in_laboratory(inertia, field, attitude, attitude @ omega, coupling=coupling, linear=0.7)
    return atlas.motion(x["ratio"], field, omega, attitude)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("inputs", "size"),
    [
        ({"ratio": 1.5}, 0.5),
        ({"ratio": 1.5}, 0.0),
        ({"ratio": 1.0}, 0.5),
        ({"I2": 2, "I3": 1.5, "k2": 0.3, "k3": 1}, 1),
    ],
)
def test_sensitivity_in_given_axes_is_a_difference_quotient(inputs: Any, size: float) -> None:
    """Field in the laboratory, angular velocity in the body, the attitude: of any class that fits, in its own axes."""
    start = {f"{name}{i}": x for name, x in (("B", size), ("omega", 0.3), ("a", 0.0)) for i in (1, 2, 3)}
    start = {**inputs, **start, "omega2": 0.7, "B3": 4 * size}
    t, h, names = np.array([0.3, -7.0, 40.0]), 1e-3, list(start)
    motion = in_given_axes(**start)
    for j, name in enumerate(names):
        motions = [in_given_axes(**{**start, name: start[name] + n * h}) for n in range(-3, 4)]
        for quantity, method in VECTORS.items():
            values = [getattr(x, method)(t) for x in motions]
            slope = sum(c * (values[3 + n] - values[3 - n]) for n, c in ((1, 45), (2, -9), (3, 1))) / (60 * h)
            if quantity == "rotation":
                turn = slope @ motion.rotation(t).swapaxes(1, 2)
                slope = np.stack([turn[:, 2, 1], turn[:, 0, 2], turn[:, 1, 0]], -1)
            derivative = motion.sensitivity(t, names, quantity)[:, j]
            assert np.abs(derivative - slope).max() <= 1e-8 * (1 + np.abs(slope).max()), (quantity, name)


@pytest.mark.parametrize("turn", [(0.4, 0.1, -0.6), (0.0, 0.0, 0.0)])
@pytest.mark.parametrize("size", [1e-6, 1e-9, 1e-14])
def test_sensitivity_keeps_its_digits_along_a_weak_field(turn: Any, size: float) -> None:
    """ReportRequest for alone: terms of the size of 1/|B'| cancel where inputs of the class are combined."""
    A, omega = Rotation.from_rotvec(turn).as_matrix(), (0.2, -0.3, 0.9)
    columns = [[rational(x) for x in column] for column in A.T.tolist()]

    def make(*B: fmpq) -> GeneralMotion:
        return GeneralMotion.at_state(1.4, omega, [sum(map(fmpq.__mul__, x, B), fmpq(0)) for x in columns])

    for j, field in enumerate((size * np.eye(3)).tolist()):
        motion, difference = atlas.motion(1.4, field, omega, A), Differences(make, field, j)
        for quantity, frame in (("rotation", A), ("angular_velocity", np.eye(3))):
            expected = frame @ difference.at(quantity, 3.0)
            derivative = motion.sensitivity(3.0, f"B{j + 1}", quantity)[0]
            assert np.abs(derivative - expected).max() <= BOUND * (1 + np.abs(expected).max()), (quantity, j)
        top = atlas.TopMotion.in_laboratory((2.0, 1.5), field, A, A @ omega, coupling=(0.3, 1.0), linear=0.7)
        assert not top.sensitivity(3.0, f"B{j + 1}").any()  # only the direction counts


def test_derivatives_of_period_and_rates_agree_with_differences() -> None:
    """Of a nutation its period and rates, by differences of motions; of two turns the frequencies."""
    h, inputs = 1e-4, ((1.0, 2.0), (0.3, 0.7, 0.2))
    motions = [atlas.GeneralMotion(1.5 + n * h, *inputs) for n in (-2, -1, 0, 1, 2)]
    for name in ("period", "precession_rate", "spin_rate"):
        a, b, _, c, d = (getattr(x, name) for x in motions)
        assert motions[2].sensitivity(0, "ratio", name) == pytest.approx((a - 8 * b + 8 * c - d) / (12 * h), rel=1e-9)
    # k = omega2 b/B2, (79)
    derivatives = atlas.ElementaryMotion(1.5, (3.0, 4.0), 0.6).sensitivity(0, ["omega2", "ratio"], "k")
    assert derivatives == pytest.approx([5 / 3, 0], abs=1e-15)


@pytest.mark.slow
def test_sensitivity_of_three_moments_is_the_difference_of_two() -> None:
    """By theta functions: against a difference of motions in all inputs at once, and along the motion at any time."""
    x = np.array([0.8, 1.0, 1.3, 0.2, 1.0, 0.6, 0.3, 0.7, 0.2])
    names = [f"{name}{i}" for name in ("I", "B", "omega") for i in (1, 2, 3)]
    way, h, t = np.array([0.3, -0.2, 0.5, 0.7, -0.4, 0.1, -0.6, 0.2, 0.9]), 1e-5, np.array([0.7, -20.0, 1e9])
    motion, *motions = (atlas.AsymmetricMotion(y[:3], y[3:6], y[6:]) for y in (x, x + h * way, x - h * way))
    v, R = motion.sensitivity(t, [*names, "t"]), motion.rotation(t)
    up, down = (y.rotation(t) for y in motions)
    turn = ((up - down) / (2 * h)) @ R.swapaxes(1, 2)
    derivatives, slope = way @ v[:, :9], np.stack([turn[:, 2, 1], turn[:, 0, 2], turn[:, 1, 0]], -1)
    assert np.abs(derivatives - slope)[:2].max() <= 1e-7 * np.abs(slope)[:2].max()
    for quantity, method in list(VECTORS.items())[1:]:
        up, down = (getattr(y, method)(t) for y in motions)
        derivatives = way @ motion.sensitivity(t, names, quantity)
        assert np.abs(derivatives - (up - down) / (2 * h))[:2].max() <= 1e-7 * np.abs(derivatives)[:2].max(), quantity
    # started a little later, from where field and angular velocity have gone by then, it is the same motion
    rates = [motion.sensitivity(0.0, ["t"], quantity)[0] for quantity in ("field", "angular_velocity")]
    later = np.concatenate(rates) @ v[:, 3:9]
    size = 1 + np.abs(v).max((1, 2))
    assert (np.abs(later - (v[:, 9] - motion.angular_velocity(0.0))).max(1) <= BOUND * size).all()
    # f1 and f2 of both flows have the derivatives of the frequencies
    slopes = [way @ motion.sensitivity(0.0, names, f"f{i}") for i in (1, 2, 3)]
    assert slopes == pytest.approx((motions[0].frequencies - motions[1].frequencies) / (2 * h), rel=1e-7)


@pytest.mark.parametrize("omega", [(0.3, 0.7, 0.2), (0.1, 2.0, 0.3), (0.0, 0.0, 0.9)])
def test_sensitivity_of_a_free_body_of_three_moments_is_the_difference_of_two(omega: tuple[float, ...]) -> None:
    """By differences of motions, and along the motion at any time; its neighbours in a field are on a torus."""
    x, names = np.array([0.8, 1.0, 1.3, *omega]), [f"{name}{i}" for name in ("I", "omega") for i in (1, 2, 3)]
    way, h, t = np.array([0.3, -0.2, 0.5, -0.6, 0.2, 0.9]), 1e-5, np.array([0.7, -20.0, 1e9])
    motion, *motions = (atlas.AsymmetricMotion(y[:3], np.zeros(3), y[3:]) for y in (x, x + h * way, x - h * way))
    v, R = motion.sensitivity(t, [*names, "t"]), motion.rotation(t)
    turn = ((motions[0].rotation(t) - motions[1].rotation(t)) / (2 * h)) @ R.swapaxes(1, 2)
    slope = np.stack([turn[:, 2, 1], turn[:, 0, 2], turn[:, 1, 0]], -1)
    assert np.abs(way @ v[:, :6] - slope)[:2].max() <= 1e-7 * np.abs(slope)[:2].max()
    later = motion.sensitivity(0.0, ["t"], "angular_velocity")[0] @ v[:, 3:6]
    assert (
        np.abs(later - (v[:, 6] - motion.angular_velocity(0.0))).max(1) <= BOUND * (1 + np.abs(v).max((1, 2)))
    ).all()
    with pytest.raises(atlas.AtlasError, match="no input 'B1'"):
        motion.sensitivity(1.0, "B1")


def test_rates_among_all_motions_of_a_body_agree_with_its_class() -> None:
    """Of a ball they are -|B| and -|B + Omega|, by central differences; a period goes with the rate of precession."""
    names, h = ["omega1", "omega2", "omega3", "B1", "B2", "B3"], 1e-5
    start = np.array([0.2, 0.7, 0.3, 0.0, 1.0, 2.0])

    def motion_of(x: np.ndarray) -> Any:
        return atlas.motion(1.0, x[3:], x[:3])

    for quantity in ("precession_rate", "spin_rate"):
        steps = [
            (getattr(motion_of(start + e), quantity) - getattr(motion_of(start - e), quantity)) / (2 * h)
            for e in h * np.eye(6)
        ]
        np.testing.assert_allclose(motion_of(start).sensitivity(0.0, names, quantity), steps, atol=1e-9)
    elementary = atlas.motion(0.5, (0, 1, 1), (0, 1, 2.5))
    assert elementary.family == "elementary"
    rate, period = (elementary.sensitivity(0.0, names, quantity) for quantity in ("precession_rate", "period"))
    np.testing.assert_allclose(period, -rate * elementary.period / elementary.precession_rate, rtol=1e-12, atol=1e-20)


@pytest.mark.parametrize("quantity", ["rotation", "angular_velocity", "field"])
@pytest.mark.parametrize("exponent", [-530, 530])
def test_derivatives_that_floats_do_not_hold_are_refused(exponent: int, quantity: str) -> None:
    """Where products of rates are no floats there are no derivatives, nor is an infinite one given for a scalar."""
    K, w = (tuple(np.ldexp(x, exponent).tolist()) for x in ((0.2, 0.6, 0.8), (0.3, 0.7, 0.2)))
    for motion, name in (
        (atlas.EllipticMotion((0.8, 1.0, 1.3), K, 1.7), "I2"),
        (atlas.GeneralMotion(1.5, K[1:], w), "ratio"),
        (atlas.FreeMotion(1.5, w), "ratio"),
    ):
        with pytest.raises(atlas.DomainError, match="too large or too small for derivatives"):
            motion.sensitivity(0.0, [name], of=quantity)
    slow = atlas.GeneralMotion(1.5, np.ldexp([1.0, 2.0], -565), np.ldexp([0.3, 0.7, 0.2], -565))
    with pytest.raises(atlas.DomainError, match="derivative of the period is too large"):
        slow.sensitivity(0.0, ["B2"], of="period")
