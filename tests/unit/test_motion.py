"""`atlas.motion`: any body from any start, of the class that fits, in the axes that were given."""

import copy
import pickle
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

import atlas

EPS = 2.0**-52
FIELD_AND_START = (0.3, 1.0, 2.0), (0.1, 0.7, 0.2)


def turn(seed: int) -> Any:
    """Return some rotation matrix."""
    return Rotation.random(random_state=seed).as_matrix()


def tensor(seed: int, *moments: float) -> Any:
    """Return the tensor of a body with these moments in odd axes."""
    P = turn(seed)
    matrix = P @ np.diag(moments) @ P.T
    return (matrix + matrix.T) / 2


def integrated(I: Any, B: Any, omega: Any, attitude: Any, t: Any) -> tuple[Any, Any]:
    """Return R and Omega by SciPy's DOP853 of the Euler-Poisson equations, (12) and (16), and K = R^T B'."""
    torque = np.trace(I) * np.eye(3) - 2 * I

    def rate(_: float, y: Any) -> Any:
        R, W = y[:9].reshape(3, 3), y[9:]
        turning = np.array([[0, -W[2], W[1]], [W[2], 0, -W[0]], [-W[1], W[0], 0]])
        return np.append(R @ turning, np.linalg.solve(I, np.cross(I @ W - torque @ (R.T @ B), W)))

    start = np.append(attitude, omega)
    y = solve_ivp(rate, (0, t[-1]), start, method="DOP853", rtol=1e-13, atol=1e-14, t_eval=t).y.T
    return y[:, :9].reshape(-1, 3, 3), y[:, 9:]


BODIES = {
    "three moments": (tensor(1, 1.0, 1.3, 0.8), "asymmetric"),
    "flat": (tensor(2, 1.0, 1.5, 2.4), "asymmetric"),
    "free": (tensor(3, 1.0, 1.3, 0.8), "asymmetric"),
    "disk": (tensor(4, 1.0, 1.0, 1.9), "asymmetric"),  # rounded elements have three moments, here and below
    "rod": (tensor(5, 2.0, 0.3, 2.0), "asymmetric"),
    "ball": (tensor(6, 0.7, 0.7, 0.7), "asymmetric"),
}


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::atlas.errors.NearlySymmetricWarning")
@pytest.mark.parametrize("name", BODIES)
def test_bodies_in_any_axes_agree_with_an_integrator(name: str) -> None:
    """Attitude, both angular velocities, field in the body, quaternion, momentum, in the axes that were given."""
    I, family = BODIES[name]
    seed = list(BODIES).index(name)
    (B, omega), A = np.random.default_rng(seed).normal(size=(2, 3)).tolist(), turn(seed + 20)
    B = [0.0, 0.0, 0.0] if name == "free" else B
    m = atlas.motion(I, B, omega, A)
    t = np.linspace(0.0, 10.0, 21)[1:]
    R, Omega = integrated(I, B, omega, A, t)
    w = np.matvec(R, Omega)
    assert m.family == family
    for values, true in (
        (m.rotation(t), R), (m.rotation_grid(0.5, 0.5, 20), R), (m.column(2, t), R[:, :, 1]),
        (Rotation.from_quat(m.quaternion(t)).as_matrix(), R), (m.angular_velocity(t), Omega),
        (m.angular_velocity_in_laboratory(t), w), (m.field_in_body(t), np.vecmat(B, R)),
        (m.angular_momentum(t), np.matvec(R, np.matvec(I, Omega))),
    ):  # fmt: skip
        assert np.abs(values - true).max() <= 3e-12
    assert np.abs(m.rotation(0.0) - A).max() <= 8 * EPS
    assert np.abs(m.angular_velocity(0.0) - omega).max() <= 16 * EPS
    assert np.linalg.norm(np.diff(m.quaternion(np.linspace(0, 10, 1000)), axis=0), axis=-1).max() < 0.1


def test_all_forms_of_a_body_give_the_same_motion() -> None:
    """A ratio, a body, moments and a tensor; along another axis the same body is that with its axes renamed."""
    B, w, t = (0.3, -1.0, 2.0), (0.3, 0.7, 0.2), np.linspace(-3, 3, 7)
    R_ratio = atlas.motion(1.5, B, w).rotation(t)
    for body in (
        atlas.SymmetricBody(2.0, 3.0),
        (2.0, 2.0, 3.0),
        np.diag([2.0, 2.0, 3.0]),
        [[2, 0, 0], [0, 2, 0], [0, 0, 3]],
    ):
        m = atlas.motion(body, B, w)
        assert np.abs(m.rotation(t) - R_ratio).max() <= 32 * EPS
        assert np.abs(m.angular_momentum(0.0) - np.array([2.0, 2.0, 3.0]) * w).max() <= 8 * EPS
    order = [1, 2, 0]
    R_order = atlas.motion((3.0, 2.0, 2.0), np.array(B)[[2, 0, 1]], np.array(w)[[2, 0, 1]]).rotation(t)
    assert np.abs(R_order[:, order][:, :, order] - R_ratio).max() <= 64 * EPS


def test_the_class_that_fits_is_found() -> None:
    """By the start, too: the paper's family, a free body; and it is an instance of its class."""
    quarter = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    fraction = Fraction(7, 10), Fraction(56, 85)
    for inputs, kind_class, family, kind in (
        ((0.5, (0, 1, 1), (0, 1, 2.5)), atlas.ElementaryMotion, "elementary", "precession"),
        ((1.5, (0, 1, 2), (0, *fraction)), atlas.ElementaryMotion, "elementary", "precession"),
        ((0.5, (-1, 0, 1), (0, 1, 2.5), quarter), atlas.ElementaryMotion, "elementary", "precession"),
        ((0.5, (3, 4, 5), (3, 4, 12.5)), atlas.ElementaryMotion, "elementary", "precession"),
        ((0.5, turn(3) @ (0, 1, 1), (0, 0, 0), turn(3)), atlas.ElementaryMotion, "elementary", "at rest"),
        ((0.5, (0, 1, 1), (0, 1, np.nextafter(2.5, 3))), atlas.GeneralMotion, "general", "nutation, two real roots"),
        ((1.5, (0, 0, 2), (0, 0, 1)), atlas.ElementaryMotion, "elementary", "spin along the field"),
        ((1.5, (0, 1, 2), (0, 0.7, 0.1)), atlas.GeneralMotion, "general", "nutation, four real roots"),
        ((1.5, (0, 0, 0), (0.1, 0.7, 0.1)), atlas.FreeMotion, "free", "free body"),
        ((1.0, (0, 1, 2), (0.1, 0.7, 0.1)), atlas.BallMotion, "ball", "ball"),
        (((1.0, 1.2, 1.5), (0, 1, 2), (0, 0.7, 0.1)), atlas.AsymmetricMotion, "asymmetric", "on a torus"),
    ):
        m = atlas.motion(*inputs)  # type: ignore[arg-type]
        assert isinstance(m, kind_class)
        assert (m.family, m.kind) == (family, kind)
        assert np.array_equal(m.angular_velocity(0.0), np.asarray(inputs[2], dtype=float))


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::atlas.errors.NearlySymmetricWarning")
def test_a_disk_is_a_body_in_any_axes() -> None:
    """The rounding of its tensor makes I3 more than I1 + I2, or I2 other than I1: it moves as the disk does."""
    for turn in Rotation.random(3, random_state=1).as_matrix():
        tensor = turn @ np.diag([1.0, 1.0, 2.0]) @ turn.T
        start = (0.0, 0.0, 1.0), (0.1, 0.2, 0.3)
        disk = atlas.motion(atlas.SymmetricBody(1.0, 2.0, turn.T), *start)
        assert abs(atlas.motion((tensor + tensor.T) / 2, *start).rotation(7.0) - disk.rotation(7.0)).max() < 4e-14


def test_arrays_of_motions_have_a_kind_for_each_motion() -> None:
    """One name for each motion, whichever class they are of."""
    two = np.array([0.3, 0.7])
    for motions in (
        atlas.ElementaryMotion(1.5, (1.0, 2.0), two), atlas.FreeMotion(1.5, (0.1, 0.2, two)),
        atlas.BallMotion(1.0, two, (0.3, 0.4)), atlas.GeneralMotion(1.5, (1.0, 2.0), (0.3, two, 0.2)),
    ):  # fmt: skip
        assert motions.kind.shape == (2,)


@pytest.mark.parametrize("ratios", [[1.5], [1.5, 0.7], [1.5, 0.7, 1.2, 0.3], [[1.5, 0.7], [1.2, 0.3]]])
def test_a_list_of_ratios_is_an_array(ratios: list[Any]) -> None:
    """Lists and arrays of any shape but (..., 3) are ratios; three ratios are so in a SymmetricBody."""
    motions = atlas.motion(ratios, *FIELD_AND_START)
    assert motions == atlas.motion(np.array(ratios), *FIELD_AND_START)
    assert np.array_equal(
        motions.rotation(1.0), atlas.motion(atlas.SymmetricBody(1.0, ratios), *FIELD_AND_START).rotation(1.0)
    )


@pytest.mark.parametrize("kind", [list, np.array])
def test_three_numbers_last_are_moments(kind: Any) -> None:
    """A list or an array (..., 3) has the moments of bodies, as a tuple of three arrays; one tensor is (3, 3)."""
    rows = [[0.8, 1.0, 1.3], [0.7, 1.2, 0.9]]
    motions = atlas.motion(kind(rows), *FIELD_AND_START)
    assert motions.shape == (2,)
    assert np.array_equal(
        motions.rotation(1.0), atlas.motion(tuple(np.transpose(rows)), *FIELD_AND_START).rotation(1.0)
    )
    assert np.array_equal(motions.rotation(1.0)[0], atlas.motion(kind(rows[0]), *FIELD_AND_START).rotation(1.0))


def test_each_element_of_an_array_is_the_motion_of_its_inputs() -> None:
    """Ratios, fields, starts and attitudes broadcast, with each other and with times."""
    rng, t = np.random.default_rng(4), np.linspace(-2, 2, 5)
    ratios, B, w, A = (
        rng.uniform(0.2, 1.9, 6),
        rng.normal(size=(6, 3)),
        rng.normal(size=(6, 3)),
        [turn(i) for i in range(6)],
    )
    m = atlas.motion(ratios, B, w, A)
    R, q, Omega = m.rotation(t[:, None]), m.quaternion(t[:, None]), m.angular_velocity(t[:, None])
    assert R.shape == (5, 6, 3, 3)
    assert m.rotation_grid(-2, 1, 5).shape == (6, 5, 3, 3)
    for i in range(6):
        motion = atlas.motion(float(ratios[i]), B[i], w[i], A[i])
        assert np.abs(motion.rotation(t) - R[:, i]).max() <= 64 * EPS
        assert np.abs(motion.quaternion(t) - q[:, i]).max() <= 64 * EPS
        assert np.abs(motion.angular_velocity(t) - Omega[:, i]).max() <= 128 * EPS
    assert atlas.motion((1.0, 1.0, ratios), tuple(B.T), tuple(w.T)).shape == (6,)


def test_a_motion_in_given_axes_is_copied_and_has_a_repr() -> None:
    """By the call that makes it."""
    m = atlas.motion((1.0, 1.0, 1.5), (0.3, -1.0, 2.0), (0.3, 0.7, 0.2), Rotation.from_euler("x", 0.3))
    top = atlas.TopMotion.in_laboratory(
        (1.0, 0.5), (0.3, -1.0, 2.0), turn(1), (0.1, 0.2, 5.0), coupling=(0.0, 0.0), linear=3.0
    )
    for original in (m, top):
        for again in (copy.copy(original), pickle.loads(pickle.dumps(original))):  # noqa: S301  its own
            assert np.array_equal(again.rotation(1.3), original.rotation(1.3))
    assert repr(m).startswith("motion(inertia=(1.0, 1.0, 1.5), field=[0.3, -1.0, 2.0], omega=")
    assert m.kind == "nutation, four real roots"
    assert m.period > 0


@pytest.mark.parametrize(
    ("ratio", "field", "omega"),
    [(1.5, (600.0, 800.0), (3e-13, 1e-13, -2e-13)), (0.5, (1.0, 0.1), (1e-16, -0.5, -0.2))],
)
def test_a_start_near_an_elementary_motion_is_not_elementary(ratio: float, field: Any, omega: Any) -> None:
    """In the axes of its class nothing is rounded: a slow start in a strong field, a push off an unstable motion."""
    motion, true = atlas.motion(ratio, (0.0, *field), omega), atlas.GeneralMotion(ratio, field, omega)
    assert motion.family == "general"
    for t in (100.0, 1e11 if ratio > 1 else 60.0):
        assert np.array_equal(motion.rotation(t), true.rotation(t))


@pytest.mark.slow
def test_given_arrays_broadcast() -> None:
    """Arrays of moments in a tuple, of fields that are zero, of attitudes; columns of arrays."""
    a, b, c = np.array([0.8, 0.7]), np.array([1.0, 1.1]), np.array([1.3, 1.2])
    moments = atlas.motion((a, b, c), (0.3, 1.0, 2.0), (0.1, 0.7, 0.2))
    assert np.array_equal(moments.rotation(1.0), atlas.AsymmetricMotion((a, b, c), *FIELD_AND_START).rotation(1.0))
    fields = atlas.motion(1.3, np.ones((4, 3)), (0.1, 0.7, 0.2))
    assert np.array_equal(fields.third_axis(1.7), fields.rotation(1.7)[..., 2])
    assert atlas.motion(1.5, np.zeros((4, 3)), (0.1, 0.2, 0.3)).rotation(1.0).shape == (4, 3, 3)
    attitudes = Rotation.random(5, random_state=1)
    motion_free, slow = (atlas.motion(1.5, (0.0, 0.0, b), (0.1, 0.2, 0.3), attitudes) for b in (0.0, 1e-30))
    assert np.abs(motion_free.rotation(1.0) - slow.rotation(1.0)).max() < 8 * EPS


def test_later_changes_of_given_arrays_have_no_effect_on_copies() -> None:
    """Copies are of the inputs at that time; and of an attitude as it was, which is made orthogonal again."""
    moments, start = np.array([0.8, 1.0, 1.3]), np.array([0.1, 0.7, 0.2])
    motions = [
        atlas.motion(moments, *FIELD_AND_START),
        atlas.TopMotion.in_laboratory((1.0, 0.5), (0.3, 0.1, 0.9), turn(3) + 1e-11, start, coupling=(0.1, 0.2)),
    ]
    before = [motion.rotation(1e3) for motion in motions]
    moments[1] = start[1] = 1.1
    assert all(np.array_equal(copy.copy(m).rotation(1e3), R) for m, R in zip(motions, before, strict=True))


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda: atlas.GeneralMotion(1.5, (1, 2), omega2=3), "omega2, which is for atlas.ElementaryMotion"),  # type: ignore[call-arg]
        (lambda: atlas.ElementaryMotion(1.5, (1, 2), omega=(1, 2, 3)), "omega, which is for atlas.motion"),  # type: ignore[call-arg]
    ],
)
def test_an_argument_of_another_class_names_that_class(call: Any, says: str) -> None:
    """The line names the class that takes it, and the arguments of this one."""
    with pytest.raises(TypeError, match=says):
        call()


def test_every_class_takes_attitude_and_field_of_the_laboratory() -> None:
    """R(0) is the attitude, n or B' and the angular velocity are where they were given; a wrong class is refused."""
    A, B, w = turn(8), np.array([0.3, -1.0, 2.0]), np.array([0.3, 0.7, 0.2])
    for family_class, body, field, options in (
        (atlas.GeneralMotion, 1.5, B, {}), (atlas.BallMotion, 1.0, B, {}), (atlas.FreeMotion, 1.5, 0 * B, {}),
        (atlas.AsymmetricMotion, (0.8, 1.0, 1.3), B, {}),
        (atlas.TopMotion, (1.0, 0.5), B, {"coupling": (1.0, 0.3), "linear": 2.0}),
        (atlas.EllipticMotion, (0.8, 1.0, 1.3), B, {"z": 1.7}),
    ):  # fmt: skip
        start = () if family_class is atlas.EllipticMotion else (w,)
        m = family_class.in_laboratory(body, field, A, *start, **options)
        assert isinstance(m, family_class)
        assert np.abs(m.rotation(0.0) - A).max() <= 8 * EPS
        if start:
            assert np.abs(m.angular_velocity_in_laboratory(0.0) - w).max() <= 16 * EPS
        direction = field / np.linalg.norm(B) if family_class is atlas.TopMotion else field
        if hasattr(m, "field_in_body"):
            assert np.abs(np.matvec(m.rotation(0.7), m.field_in_body(0.7)) - direction).max() <= 32 * EPS
    with pytest.raises(atlas.DomainError, match=r"gives no ElementaryMotion: atlas.motion finds the class"):
        atlas.ElementaryMotion.in_laboratory(1.5, B, A, w)


@pytest.mark.parametrize(
    ("family_class", "options"),
    [(atlas.GeneralMotion, {"omega_laboratory": (0.3, 0.7, 0.2)}), (atlas.ElementaryMotion, {"omega2": 0.7})],
)
def test_three_different_moments_are_no_symmetric_body(family_class: Any, options: Any) -> None:
    """One of the moments is not left out: the class of symmetric bodies is refused."""
    with pytest.raises(atlas.DomainError, match=f"gives no {family_class.__name__}"):
        family_class.in_laboratory((1.0, 2.0, 2.5), (0.1, 0.2, 0.3), np.eye(3), **options)


@pytest.mark.parametrize("field", [(1.0, 2.0), (-0.4, 0.3)])
def test_mean_rates_agree_with_counted_turns(field: tuple[float, float]) -> None:
    """Over 50 periods the azimuth of the axis about B grows by the rate; without nutation they are k and phi."""
    m = atlas.GeneralMotion(1.5, field, (0.3, 0.7, 0.2))
    t = np.linspace(0, 50 * m.period, 20001)
    n = np.array([0.0, *field]) / np.hypot(*field)
    x, y = m.third_axis(t) @ [1.0, 0.0, 0.0], m.third_axis(t) @ np.cross(n, [1.0, 0.0, 0.0])
    angle = np.unwrap(np.arctan2(y, x))
    assert abs((angle[-1] - angle[0]) / t[-1] - m.precession_rate) <= 1e-9
    motion_elementary = atlas.ElementaryMotion(1.5, field, 0.7)
    same = atlas.GeneralMotion(1.5, field, (0.0, 0.7, motion_elementary.omega3))
    assert abs(same.precession_rate - motion_elementary.precession_rate) <= 16 * EPS * abs(motion_elementary.k)
    assert abs(same.spin_rate - motion_elementary.spin_rate) <= 16 * EPS * max(
        abs(motion_elementary.k), abs(motion_elementary.phi)
    )
    ball = atlas.BallMotion(1.0, 0.5, (0.3, -0.7))
    assert (ball.precession_rate, ball.spin_rate) == (-0.5, -ball.gamma)


@pytest.mark.parametrize("ratio", [1.0, 1.5])
def test_the_least_floats_are_a_field_that_the_body_does_not_feel(ratio: float) -> None:
    """In a field of whole multiples of the smallest float the body turns as a free one, by rotations."""
    omega, t = (0.25, -1.0, 0.75), np.array([0.0, 0.25, -1.5])
    R_free = atlas.motion(ratio, (0, 0, 0), omega).rotation(t)
    assert np.abs(atlas.motion(ratio, np.ldexp([1.0, 1.0, 2.0], -1074), omega).rotation(t) - R_free).max() <= 16 * EPS


@pytest.mark.parametrize("exponent", [-565, 565])
@pytest.mark.parametrize("ratio", [1.0, 1.5])
def test_a_field_along_any_axis_turns_the_body_in_any_unit_of_time(ratio: float, exponent: int) -> None:
    """Where squares of the rates are no floats each matrix is that of the same motion in another unit of time."""
    field, omega, t = np.array([1.0, 2.0, 0.5]), np.array([0.25, -1.0, 0.75]), np.array([0.0, 0.25, -1.5])
    m = atlas.motion(ratio, np.ldexp(field, exponent), np.ldexp(omega, exponent))
    R = atlas.motion(ratio, field, omega).rotation(t)
    assert np.abs(m.rotation(np.ldexp(t, -exponent)) - R).max() <= 16 * EPS


@pytest.mark.parametrize(
    "inputs",
    [
        ((1, [1, 2], np.array([1.0])), (1, 0, 1), (1, 0.2, 1)),
        ([1, [1, 2]], (1, 0, 1), (1, 0.2, 1)),
        (1.5, (1, [1, 2], [1, 2, 3]), (1, 0.2, 1)),
        ((0.8, [1, 1], [1.3, 1.3, 1.3]), (1, 0, 1), (1, 0.2, 1)),
    ],
)
def test_ragged_inputs_are_refused_in_one_line(inputs: Any) -> None:
    """Ragged lists and components that do not broadcast are AtlasErrors."""
    with pytest.raises(atlas.AtlasError, match=r"^The [^\n]*$"):
        atlas.motion(*inputs)
