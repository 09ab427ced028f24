from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from oracles.taylor import taylor
from scipy.spatial.transform import Rotation

import atlas
from atlas.bodies.field import Field
from atlas.errors import AtlasError
from atlas.motions.elementary.kernel import ElementaryMotion
from atlas.motions.particle.flight import AGREEMENT, Flight
from atlas.motions.particle.kernel import ParticleMotion
from atlas.pictures.flight import scene_of

EPS = float(np.finfo(float).eps)
FIELD = Field([0.3, -0.5, 1.1], [0.2, 0.1, -0.3], mu=-1.3, c=0.8)
FRAME = FIELD.frame([1.0, 2.0, -0.5])
ARGUMENTS = ((1, 1, 1.5), (0.0, *FRAME.field), (0.3, 0.7, -0.2))
TIMES = (0.0, 0.5, 1.25, 3.0)
STEP = 0.01
AROUND = 1 + STEP * np.arange(-3, 4)


class Tabulated:
    """A motion of the body by its Taylor series."""

    def _states(self, t: Any) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return R and Omega at the times, sorted."""
        states = taylor(*ARGUMENTS, np.ravel(t).tolist())
        R = np.array([np.array(s.R.tolist(), dtype=float) for s in states])
        Omega = np.array([[float(x) for x in s.Omega] for s in states])
        return R.reshape((*np.shape(t), 3, 3)), Omega.reshape((*np.shape(t), 3))

    def rotation(self, t: Any) -> NDArray[np.float64]:
        """R(t)."""
        return self._states(t)[0]

    def angular_velocity(self, t: Any) -> NDArray[np.float64]:
        """Omega(t)."""
        return self._states(t)[1]


PARTICLE = ParticleMotion.in_field(FIELD, [1.0, 2.0, 3.0], [0.1, -0.4, 0.2])


def test_a_point_of_a_flight_starts_at_its_given_position() -> None:
    """At t = 0 the point is at y_0 + x_N, in the user's frame, since R(0) = 1."""
    point = np.array([0.3, -0.1, 0.7])
    assert np.abs(Flight(PARTICLE, Tabulated(), point, FRAME).position(0.0) - (PARTICLE.y0 + point)).max() <= 4 * EPS


@pytest.mark.slow
def test_the_body_is_rigid() -> None:
    """Distances and handedness of three points about the centre of mass stay as they were, and the centre flies on."""
    points = np.array([[0.3, -0.1, 0.7], [1.0, 0.2, 0.1], [-0.4, 0.5, 0.6]])
    paths = np.array([Flight(PARTICLE, Tabulated(), p, FRAME).position(TIMES) for p in points])
    arms = paths - PARTICLE.position(TIMES)
    gram, start = np.einsum("ati,bti->tab", arms, arms), points @ points.T
    assert np.abs(gram - start).max() < 64 * EPS
    assert np.abs(np.linalg.det(arms.swapaxes(0, 1)) - np.linalg.det(points)).max() < 64 * EPS
    centre = Flight(PARTICLE, Tabulated(), np.zeros(3), FRAME)
    assert np.array_equal(centre.position(TIMES), PARTICLE.position(TIMES))


def slope(y: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the derivative in the middle of seven values a STEP apart, to sixth order."""
    return (-y[0] + 9 * y[1] - 45 * y[2] + 45 * y[4] - 9 * y[5] + y[6]) / (60 * STEP)


def test_the_velocity_is_the_derivative_of_the_path() -> None:
    """Differences of the position give the velocity."""
    flight = Flight(PARTICLE, Tabulated(), [0.3, -0.1, 0.7], FRAME)
    assert np.abs(flight.velocity(AROUND[3]) - slope(flight.position(AROUND))).max() < 1e-12


@pytest.mark.slow
def test_the_points_feel_the_lorentz_force_and_no_other() -> None:
    """Six points that make the body, each on its flight, gain the angular momentum and the momentum of their forces."""
    # Unit masses on the principal axes: 1.32 is diag(1.5, 1.5, 0.5), the inertia diag(2, 2, 3), as in ARGUMENTS.
    ends = FRAME.to_user(np.concatenate([np.eye(3), -np.eye(3)]) * np.sqrt([0.75, 0.75, 0.25]))
    flights = [Flight(PARTICLE, Tabulated(), p, FRAME) for p in ends]
    x = np.array([f.arm(AROUND) for f in flights])
    v = np.array([f.velocity(AROUND) for f in flights])
    force = FIELD.mu * FIELD.E + FIELD.mu / FIELD.c * np.cross(v[:, 3], FIELD.B)
    gain = slope(np.cross(x, v - PARTICLE.velocity(AROUND)).sum(axis=0))
    assert np.abs(gain - np.cross(x[:, 3], force).sum(axis=0)).max() < 1e-11
    assert np.abs(slope(v.sum(axis=0)) - force.sum(axis=0)).max() < 1e-11


@pytest.mark.slow
def test_without_a_frame_the_user_is_in_the_laboratory() -> None:
    """The arm is R(t) x_N(0) as it stands, for times of any shape."""
    flight, motion = Flight(PARTICLE, Tabulated(), [0.3, -0.1, 0.7]), Tabulated()
    assert np.abs(flight.arm(TIMES) - motion.rotation(TIMES) @ [0.3, -0.1, 0.7]).max() <= 2 * EPS
    flight_turned = Flight(PARTICLE, Tabulated(), [0.3, -0.1, 0.7], FRAME)
    assert np.abs(flight_turned.arm(TIMES) - flight_turned.rotation(TIMES) @ [0.3, -0.1, 0.7]).max() <= 4 * EPS
    assert flight.position(1.0).shape == (3,)
    assert flight.position(np.array([[0.0, 1.0], [1.5, 2.0]])).shape == (2, 2, 3)


def test_a_point_of_an_elementary_motion_flies_as_a_taylor_series_says() -> None:
    """With the closed form for R, the point of a body in the user's frame goes where the Taylor series says."""
    flight = Flight(PARTICLE, ElementaryMotion(1.5, FRAME.field, 0.7), [0.3, -0.1, 0.7], FRAME)
    start = (0.0, 0.7, flight.motion.omega3)
    R = [np.array(s.R.tolist(), dtype=float) for s in taylor((1, 1, 1.5), (0.0, *FRAME.field), start, TIMES)]
    path = PARTICLE.position(TIMES) + np.array([FRAME.rotation_to_user(r) @ flight.point for r in R])
    assert np.abs(flight.position(TIMES) - path).max() < 16 * EPS


def test_centre_and_body_must_be_in_one_field() -> None:
    """A body that turns in another field than the one its centre flies in is an error, not a picture."""
    with pytest.raises(AtlasError, match="must be the same"):
        Flight(PARTICLE, ElementaryMotion(1.5, (1.0, 2.0), 0.7), [1, 0, 0], FRAME)
    with pytest.raises(AtlasError, match="must be the same"):
        Flight(PARTICLE, ElementaryMotion(1.5, FRAME.field, 0.7), [1, 0, 0])


@pytest.mark.parametrize(("off", "agrees"), [(0.9 * AGREEMENT, True), (1.1 * AGREEMENT, False)])
def test_fields_agree_to_the_precision_of_typed_digits(off: float, agrees: bool) -> None:
    """A field off by less than 1e-9 of its size is taken for the same, by more it is not, on either side."""
    larger = np.abs(FRAME.field).max()
    for sign in (1, -1):
        motion = ElementaryMotion(1.5, (FRAME.field[0] + sign * off * larger, FRAME.field[1]), 0.7)
        if agrees:
            Flight(PARTICLE, motion, [1, 0, 0], FRAME)
        else:
            with pytest.raises(AtlasError, match="must be the same"):
                Flight(PARTICLE, motion, [1, 0, 0], FRAME)


ATTITUDE = Rotation.from_euler("xyz", [0.3, -0.7, 1.1])
START = (0.1, 0.7, 0.2)


@pytest.mark.parametrize(
    "motion",
    [
        atlas.AsymmetricMotion((0.8, 1.0, 1.3), FIELD.prime, START),
        atlas.EllipticMotion((0.8, 1.0, 1.3), FIELD.prime, 1.7),
        atlas.GeneralMotion.in_laboratory(1.3, FIELD.prime, ATTITUDE.as_matrix(), START),
        atlas.motion(1.3, FIELD, START, ATTITUDE),
        atlas.motion((0.8, 1.0, 1.3), FIELD, START, ATTITUDE),
        atlas.motion(np.array([1.3, 1.2]), FIELD, START),
    ],
)
def test_any_body_flies_in_its_field_and_in_no_other(motion: Any) -> None:
    """Its point starts where it is put, in any attitude, and moves as its velocity says; another field is refused."""
    flight = Flight(PARTICLE, motion, [0.3, -0.1, 0.7])
    assert np.abs(flight.position(0.0) - PARTICLE.y0 - [0.3, -0.1, 0.7]).max() <= 4 * EPS
    positions = np.array([flight.position(t) for t in AROUND])
    assert np.abs(flight.velocity(AROUND[3]) - slope(positions)).max() < 1e-11
    with pytest.raises(AtlasError, match="must be the same"):
        Flight(atlas.ParticleMotion(1.0, FIELD.E, 2 * FIELD.B, [1, 2, 3], [0, 0, 0]), motion, [0.3, -0.1, 0.7])


def test_the_field_of_a_turned_body_agrees_with_the_laboratory() -> None:
    """Components along the axes of the class, which are as those of the centre's field, are not taken for it."""
    field = Field((0, 1.0, 2.0), mu=2.0)
    motion = atlas.motion(1.3, ATTITUDE.apply((0, 1.0, 2.0)), START, ATTITUDE)
    with pytest.raises(AtlasError, match="must be the same"):
        Flight(atlas.ParticleMotion.in_field(field, (0, 0, 0), (1, 0, 0)), motion, (0.1, 0, 0))


def test_a_top_may_fly_in_a_field_of_any_direction() -> None:
    """Its direction, which is given as a field is, is none."""
    top = atlas.TopMotion.in_laboratory((1, 0.5), (0, 0, 1), ATTITUDE, START, coupling=(0, 0), linear=1.0)
    assert np.abs(Flight(PARTICLE, top, [0, 0, 1]).position(0.0) - PARTICLE.y0 - [0, 0, 1]).max() <= 4 * EPS


def test_a_flight_keeps_its_own_point() -> None:
    """An array that is changed later does not change the inputs of the flight."""
    point = np.array([0.3, -0.1, 0.7])
    flight = Flight(PARTICLE, Tabulated(), point)
    point[0] = 7.0
    assert np.asarray(flight.arguments["point"]).tolist() == [0.3, -0.1, 0.7]


def test_particles_motions_and_points_broadcast() -> None:
    """Two motions and three points do not."""
    with pytest.raises(AtlasError, match="do not broadcast"):
        Flight(PARTICLE, ElementaryMotion([1.5, 1.2], FRAME.field, 0.7), np.eye(3), FRAME)


def test_many_points_fly_at_once() -> None:
    """Points broadcast with times."""
    points = np.array([[0.3, -0.1, 0.7], [1.0, 0.2, 0.1]])
    motion = ElementaryMotion(1.5, FRAME.field, 0.7)
    paths = Flight(PARTICLE, motion, points, FRAME).position(np.array(TIMES)[:, None])
    assert paths.shape == (4, 2, 3)
    for n in range(2):
        path = Flight(PARTICLE, motion, points[n], FRAME).position(TIMES)
        assert np.abs(paths[:, n] - path).max() <= 4 * EPS * np.abs(path).max()


def test_a_point_has_three_components() -> None:
    """Anything else raises."""
    with pytest.raises(AtlasError, match="three components"):
        Flight(PARTICLE, Tabulated(), [1, 2])


def test_a_picture_is_of_one_flight() -> None:
    """Not of several points, motions or particles."""
    motion, motions = (ElementaryMotion(ratio, FRAME.field, 0.7) for ratio in (1.5, [1.5, 1.2]))
    particles = ParticleMotion.in_field(FIELD, [[1.0, 2.0, 3.0], [0.0, 0.0, 0.0]], [0.1, -0.4, 0.2])
    point = [0.3, -0.1, 0.7]
    assert scene_of(Flight(PARTICLE, motion, point, FRAME)).panels
    for flight_array in (
        Flight(PARTICLE, motion, [point, point], FRAME),
        Flight(PARTICLE, motions, point, FRAME),
        Flight(particles, motion, point, FRAME),
    ):
        with pytest.raises(AtlasError, match="shows one Flight"):
            scene_of(flight_array)
