from collections.abc import Callable
from typing import Any

import mpmath
import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from mpmath import mp

from atlas.errors import AtlasError, DomainError
from atlas.motions.particle.kernel import ParticleMotion

EPS = float(np.finfo(float).eps)
vectors = arrays(np.float64, 3, elements=st.one_of(st.floats(-3, 3), st.just(0.0)))
charges = st.one_of(st.floats(-2, 2), st.sampled_from([1.0, -1.0, 0.0]))
ORIGIN = np.zeros(3)


def by_series(p: ParticleMotion, t: float) -> tuple[list[mpmath.mpf], list[mpmath.mpf]]:
    """Solve (89) by its Taylor series in t, summed until a term no longer counts; the working precision covers it."""
    mu, c, t = mp.mpf(p.mu), mp.mpf(p.c), mp.mpf(float(t))
    b = [mp.mpf(float(x)) * mu / c for x in p.B]
    y, v = ([mp.mpf(float(x)) for x in start] for start in (p.y0, p.v0))
    term, n = list(v), 0
    while n < 2 or max(map(abs, term)) > mp.eps * max(map(abs, v)):
        y = [s + x * t / (n + 1) for s, x in zip(y, term, strict=True)]
        force = [term[1] * b[2] - term[2] * b[1], term[2] * b[0] - term[0] * b[2], term[0] * b[1] - term[1] * b[0]]
        if n == 0:
            force = [f + mu * mp.mpf(float(e)) for f, e in zip(force, p.E, strict=True)]
        n += 1
        term = [f * t / n for f in force]
        v = [s + x for s, x in zip(v, term, strict=True)]
    return y, v


def sizes(p: ParticleMotion, t: float) -> tuple[float, float]:
    """Return the sizes of the terms of y(t) and y'(t)."""
    x, a, v = abs(p.cyclotron_frequency * t), np.hypot.reduce(p.mu * p.E), np.hypot.reduce(p.v0)
    direction = p.B / np.abs(p.B).max() if p.B.any() else p.B
    speed = abs(p.mu * p.E @ direction) / np.hypot.reduce(direction) if p.B.any() else a
    drift = abs(t) * a / max(x, 1)
    return np.hypot.reduce(p.y0) + abs(t) * (v + drift + speed * abs(t) / 2), v + drift + speed * abs(t)


@pytest.mark.slow
@given(charges, vectors, vectors, vectors, vectors, st.floats(0.5, 2), st.floats(-9, 9))
@example(1.0, np.array([0, 1.0, 0]), np.array([0, 0, 1.0]), ORIGIN, ORIGIN, 1.0, 6.283185307179586)
@example(-1.0, np.array([0, 1.0, 1e-9]), np.array([0, 0, 1e-9]), ORIGIN, np.array([1.0, 0, 0]), 1.0, 5.0)
@settings(max_examples=60)
def test_position_and_velocity_solve_the_equation(
    mu: float, E: Any, B: Any, y0: Any, v0: Any, c: float, t: float
) -> None:
    """The motion agrees with the Taylor series of (89), to 50 digits, to a few ulp of the size of its terms."""
    p = ParticleMotion(mu, E, B, y0, v0, c)
    with mp.workdps(50 + int(abs(p.cyclotron_frequency * t))):
        y, v = by_series(p, t)
        for got, true, size in zip((p.position(t), p.velocity(t)), (y, v), sizes(p, t), strict=True):
            assert max(abs(float(g) - w) for g, w in zip(got, true, strict=True)) <= 8 * EPS * size + 1e-300


@pytest.mark.slow
@given(vectors, vectors, st.sampled_from([1.0, -1.0]), st.integers(-1000, 0))
def test_a_particle_moves_continuously_as_the_field_goes_to_zero(E: Any, B: Any, mu: float, power: int) -> None:
    """As B -> 0 by powers of two, the path goes over to the parabola of (90), with no loss on the way."""
    y0, v0, t = np.array([0.3, -0.2, 0.1]), np.array([1.0, 2.0, -0.5]), 1.5
    weak = ParticleMotion(mu, E, B * 2.0**power, y0, v0).position(t)
    parabola = ParticleMotion(mu, E, ORIGIN, y0, v0).position(t)
    assert np.abs(parabola - (y0 + v0 * t + mu * E * t**2 / 2)).max() <= 4 * EPS * 20
    bend = 2.0**power * np.linalg.norm(B) * t * (np.linalg.norm(v0) * t + np.linalg.norm(E) * t**2)
    assert np.abs(weak - parabola).max() <= bend + 16 * EPS * 20


def test_the_velocity_is_constant_without_force() -> None:
    """Without charge, or without fields, the particle keeps its velocity; at t = 0 it is where it was put."""
    y0, v0 = np.array([1.0, 2.0, 3.0]), np.array([0.5, 0.25, -1.0])
    for p in (ParticleMotion(0, [1, 2, 3], [3, 2, 1], y0, v0), ParticleMotion(1, ORIGIN, ORIGIN, y0, v0)):
        assert p.case == "no force"
        assert np.array_equal(p.position([0, 2, 4]), y0 + np.outer([0, 2, 4], v0))
        assert np.array_equal(p.velocity(7.0), v0)
    p = ParticleMotion(-1.3, [1, 2, 3], [3, 2, 1], y0, v0)
    assert np.array_equal(p.position(0), y0)
    assert np.array_equal(p.position(-0.0), y0)
    assert np.abs(p.velocity(0) - v0).max() <= EPS


def test_without_a_charge_there_is_no_frequency() -> None:
    """For mu = 0 and for B = 0 it is 0.0, not -0.0."""
    for mu, B in ((0.0, [0, 0, 2.0]), (0.7, ORIGIN), (0.0, ORIGIN)):
        frequency = ParticleMotion(mu, ORIGIN, B, ORIGIN, ORIGIN).cyclotron_frequency
        assert (frequency, np.signbit(frequency)) == (0.0, False)


@pytest.mark.parametrize(
    ("E", "B", "v", "kind", "case"),
    [
        ([0, 1, 0], [0, 0, 1], [0, 0, 0], "cycloid", "crossed fields"),
        ([0, 1, 5], [0, 0, 1], [0, 0, 7], "cycloid", "oblique fields"),
        ([0, 1, 0], [0, 0, 1], [1, 0, 0], "straight line", "crossed fields"),
        ([0, 1, 0], [0, 0, 1], [0.5, 0, 0], "curtate trochoid", "crossed fields"),
        ([0, 1, 0], [0, 0, 1], [-0.5, 0, 0], "prolate trochoid", "crossed fields"),
        ([0, 0, 0], [0, 0, 1], [1, 0, 3], "circle", "magnetic field alone"),
        ([0, 0, 2], [0, 0, 1], [1, 0, 3], "circle", "parallel fields"),
        ([0, 0, 2], [0, 0, -1], [0, 0, 3], "point", "parallel fields"),
        ([0, 1, 0], [0, 0, 0], [1, 0, 0], "parabola", "electric field alone"),
        ([0, 1, 0], [0, 0, 0], [0, 1, 0], "straight line", "electric field alone"),
        ([0, 0, 0], [0, 0, 0], [0, 0, 0], "point", "no force"),
    ],
)
def test_each_path_and_field_has_its_name(E: Any, B: Any, v: Any, kind: str, case: str) -> None:
    """Kinds and cases are decided exactly on the inputs, whichever axis is called the first."""
    for shift in range(3):
        p = ParticleMotion(1, *(np.roll(x, shift) for x in (E, B)), ORIGIN, np.roll(v, shift))
        assert (p.kind, p.case) == (kind, case)


@given(vectors, vectors.filter(lambda B: np.linalg.norm(B) > 0.1), vectors, charges.filter(lambda mu: abs(mu) > 0.1))
@settings(max_examples=50)
def test_the_particle_circles_its_guiding_centre(E: Any, B: Any, v: Any, mu: float) -> None:
    """The distance to O(t) is the radius at all times, and at right angles to B."""
    p = ParticleMotion(mu, E, B, [1.0, 2.0, 3.0], v)
    t = np.linspace(-3, 9, 13)
    arm = p.position(t) - p.guiding_centre(t)
    size = np.abs(p.position(t)).max() + np.abs(p.guiding_centre(t)).max()
    assert np.abs(np.linalg.norm(arm, axis=1) - p.radius).max() <= 32 * EPS * size
    assert np.abs(arm @ B).max() <= 32 * EPS * size * np.linalg.norm(B)


def test_the_phase_is_exact_over_many_turns() -> None:
    """After 1e14 radians the position on the circle still has all its digits."""
    B, mu, c = np.array([0.1, -0.7, 1.3]), -1.7, 0.9
    p = ParticleMotion(mu, ORIGIN, B, ORIGIN, [1.0, 0.5, 0.25], c)
    t = 1e14 / abs(p.cyclotron_frequency)
    with mp.workdps(60):
        b = mpmath.matrix([mp.mpf(float(x)) for x in B])
        omega, n, v = mp.mpf(mu) / mp.mpf(c) * mp.norm(b), b / mp.norm(b), mpmath.matrix([1, 0.5, 0.25])
        parallel = (n.T * v)[0] * n
        rotated = mpmath.matrix([n[1] * v[2] - n[2] * v[1], n[2] * v[0] - n[0] * v[2], n[0] * v[1] - n[1] * v[0]])
        true = parallel + mp.cos(omega * t) * (v - parallel) - mp.sin(omega * t) * rotated
        assert max(abs(float(g) - w) for g, w in zip(p.velocity(t), true, strict=True)) < 4 * EPS


def test_a_phase_beyond_reach_is_an_error() -> None:
    """Beyond 2^50 radians there is no digit to give."""
    with pytest.raises(AtlasError, match=r"2\^50"):
        ParticleMotion(1, ORIGIN, [0, 0, 1], ORIGIN, [1, 0, 0]).position(2.0**51)


def test_a_turn_that_takes_longer_than_any_float_is_refused() -> None:
    """A frequency below all floats has no period that is one; those of an array are refused with it."""
    slow = ParticleMotion(5e-324, np.zeros(3), (0.0, 0.5, 0.0), np.zeros(3), (1.0, 0.0, 0.0))
    fast = ParticleMotion([1.0, 5e-324], np.zeros(3), (0.0, 0.5, 0.0), np.zeros(3), (1.0, 0.0, 0.0))
    for motion in (slow, fast):
        with pytest.raises(DomainError, match="The period is too large for a float"):
            _ = motion.period


def test_times_may_have_any_shape() -> None:
    """A time gives a vector, an array of times an array of them, none of them none."""
    p = ParticleMotion(1, [1, 0, 0], [0, 0, 1], ORIGIN, ORIGIN)
    t = np.linspace(0, 1, 6).reshape(2, 3)
    assert p.position(1.0).shape == (3,)
    assert p.position(t).shape == p.velocity(t).shape == p.guiding_centre(t).shape == (2, 3, 3)
    assert p.position([]).shape == (0, 3)
    assert np.array_equal(p.position(t)[1, 2], p.position(1.0))


def test_many_times_agree_with_single_times() -> None:
    """More times than are evaluated at once have, one by one, the values of each alone."""
    p = ParticleMotion(-1.3, [0.2, 0.3, 0.4], [1, -2, 0.5], ORIGIN, [0.1, 0.2, -0.3], 2.0)
    t = np.linspace(-50, 50, 10001)
    position, velocity = p.position(t), p.velocity(t)
    for i in (0, 1, 4095, 4096, 5000, 8192, 10000):
        assert np.array_equal(position[i], p.position(t[i]))
        assert np.array_equal(velocity[i], p.velocity(t[i]))


def test_arrays_of_particles_broadcast() -> None:
    """Charges of both signs, by fields, by times: each value is that of the particle alone, to the last bit."""
    rng = np.random.default_rng(2)
    mu, c = np.array([[1.0], [-2.0]]), np.array([1.0, 0.5, 2.0])
    E, B, y, v = rng.normal(size=(3, 3)), rng.normal(size=(2, 1, 3)), rng.normal(size=3), rng.normal(size=(3, 3))
    many, t = ParticleMotion(mu, E, B, y, v, c), rng.normal(size=(4, 1, 3))
    assert many.shape == (2, 3)
    assert many.drift.shape == many.prime.shape == (2, 3, 3)
    assert many.kind.shape == many.cyclotron_frequency.shape == many.radius.shape == many.period.shape == (2, 3)
    assert many.axes.shape == (2, 3, 3, 3)
    position, velocity, centre = many.position(t), many.velocity(t), many.guiding_centre(t)
    assert position.shape == (4, 2, 3, 3)
    for i, j in np.ndindex(2, 3):
        particle = ParticleMotion(mu[i, 0], E[j], B[i, 0], y, v[j], c[j])
        assert np.array_equal(position[:, i, j], particle.position(t[:, 0, j]))
        assert np.array_equal(velocity[:, i, j], particle.velocity(t[:, 0, j]))
        assert np.array_equal(centre[:, i, j], particle.guiding_centre(t[:, 0, j]))
        assert (many.kind[i, j], many.case[i, j], many.radius[i, j]) == (particle.kind, particle.case, particle.radius)
    trochoids = ParticleMotion.trochoid(mu, [0, 1, 0], [0, 0, 1], np.array([0.5, 1.0, 2.0]))
    small, large = ["curtate trochoid", "cycloid", "prolate trochoid"], ["cycloid", *["prolate trochoid"] * 2]
    assert trochoids.kind.tolist() == [small, large]
    assert ParticleMotion(np.ones(0), E[0], B[0, 0], y, y).position(1.0).shape == (0, 3)


@given(st.integers(-130, 130))
def test_the_unit_of_time_changes_no_bit(power: int) -> None:
    """Scaling the fields and the velocity by powers of two, and the time back, leaves the path as it is."""
    E, B, v, t, scale = (
        np.array([0.3, 0.7, -0.1]),
        np.array([1.1, -0.2, 0.4]),
        np.array([0.1, 0.2, 0.3]),
        2.7,
        2.0**power,
    )
    path = ParticleMotion(-1.1, E, B, ORIGIN, v).position(t)
    path_scaled = ParticleMotion(-1.1, E * scale**2, B * scale, ORIGIN, v * scale).position(t / scale)
    assert np.array_equal(path, path_scaled)


@pytest.mark.parametrize("name", ["drift", "period", "radius", "axes"])
def test_quantities_of_a_magnetic_force_are_refused_without_a_field(name: str) -> None:
    """Without B there is no drift, period, radius or frame: an error, not a NaN."""
    p = ParticleMotion(1, [1, 0, 0], ORIGIN, ORIGIN, ORIGIN)
    assert p.cyclotron_frequency == 0
    with pytest.raises(DomainError, match="Without a magnetic force"):
        getattr(p, name)


@pytest.mark.parametrize(
    "make",
    [
        lambda: ParticleMotion("e", ORIGIN, ORIGIN, ORIGIN, ORIGIN),
        lambda: ParticleMotion(1, [1, 2], ORIGIN, ORIGIN, ORIGIN),
        lambda: ParticleMotion(1, ORIGIN, ORIGIN, ORIGIN, [0, 0, np.nan]),
        lambda: ParticleMotion(1, ORIGIN, ORIGIN, ORIGIN, ORIGIN, c=-1),
        lambda: ParticleMotion([1, 2], np.ones((3, 3)), ORIGIN, ORIGIN, ORIGIN),
        lambda: ParticleMotion(1e200, [1e200, 0, 0], ORIGIN, ORIGIN, ORIGIN),
        lambda: ParticleMotion(1, [0, 0, 1], [0, 0, 1], ORIGIN, ORIGIN).axes,
        lambda: ParticleMotion(1, [0, 0, 1], [0, 0, 1], ORIGIN, ORIGIN).position(np.nan),
        lambda: ParticleMotion(1, [0, 1, 0], [0, 0, 0], ORIGIN, ORIGIN).guiding_centre(1),
        lambda: ParticleMotion(1, [0, 1e200, 0], [0, 0, 1e-200], ORIGIN, ORIGIN).drift,
        lambda: ParticleMotion(1, [1e308, 0, 0], ORIGIN, ORIGIN, ORIGIN).position(1e200),
        lambda: ParticleMotion(1, [1e308, 0, 0], ORIGIN, ORIGIN, ORIGIN).velocity([0.0, 1e200]),
        lambda: ParticleMotion(1, [1e308, 0, 0], [0, 0, 1e-300], ORIGIN, ORIGIN).position(1e200),
        lambda: ParticleMotion(1, [0, 0, 1e308], [0, 0, 1], ORIGIN, ORIGIN).guiding_centre(1e200),
    ],
)
def test_impossible_motions_are_refused_in_one_sentence(make: Callable[[], object]) -> None:
    """Wrong shapes, text, NaN and overflows raise one sentence."""
    with pytest.raises(AtlasError, match=r"^[^\n]*\.$"):
        make()
