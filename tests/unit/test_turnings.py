from random import Random
from typing import Any

import numpy as np
import pytest
from flint import arb, ctx
from stress import extreme
from stress.regimes import REGIMES

from atlas.errors import AtlasError, DomainError
from atlas.motions.elementary import certified as exact_elementary
from atlas.motions.elementary.kernel import ElementaryMotion, FreeMotion
from atlas.motions.elementary.kernel_ball import BallMotion
from atlas.motions.elementary.kernel_hyperbola import Hyperbola
from atlas.motions.particle.kernel import ParticleMotion
from atlas.surfaces.kernel import Quadric

ULP1 = 2.0**-52


def motions(count: int, seed: int = 1) -> list[extreme.Motion]:
    """Draw motions of every regime, on the curve and of a body whose I2 is 1."""
    random = Random(seed)  # noqa: S311  reproducible, not secret
    draws = [extreme.motion(regime, random) for _ in range(count) for regime in REGIMES]
    return [m for m in draws if m.omega3 is None and m.I2 == 1.0]


def inputs(draws: list[extreme.Motion]) -> tuple[Any, tuple[Any, Any], Any]:
    """Return ratio, field and omega2 as arrays."""
    I, B2, B3, w2 = (np.array([getattr(m, name) for m in draws]) for name in ("I3", "B2", "B3", "omega2"))
    return I, (B2, B3), w2


def motions_alone(draws: list[extreme.Motion]) -> list[ElementaryMotion]:
    """Make each motion by itself."""
    return [ElementaryMotion(m.I3, (m.B2, m.B3), m.omega2) for m in draws]


def moments(draws: list[extreme.Motion]) -> Any:
    """Return one time of each motion, of every clock in turn."""
    return np.array([m.times[i % len(m.times)] for i, m in enumerate(draws)])


def test_scalars_of_many_motions_have_the_bits_of_one_by_one() -> None:
    """In every extreme regime omega3, k, phi and the case are those of the motion made alone, to the bit."""
    draws = motions(12)
    many, motions_each = ElementaryMotion(*inputs(draws)), motions_alone(draws)
    for name in ("omega3", "k", "phi", "case", "omega2"):
        assert np.array_equal(getattr(many, name), [getattr(motion, name) for motion in motions_each])


def test_matrices_of_many_motions_have_errors_below_4_ulp() -> None:
    """At one time each, of any size of phase up to 2^50, every entry is within 4 ulp(1) of the ball."""
    draws = motions(6, seed=2)
    t = moments(draws)
    R = ElementaryMotion(*inputs(draws)).rotation(t)
    with ctx.workprec(200):
        for m, time, matrix in zip(draws, t.tolist(), R, strict=True):
            true = exact_elementary.ElementaryMotion(m.I3, (m.B2, m.B3), m.omega2).rotation(time)
            for i in range(3):
                for j in range(3):
                    assert float(abs(arb(true[i][j]) - arb(matrix[i, j])).upper()) <= 4 * ULP1


def test_small_entries_of_many_matrices_keep_their_digits() -> None:
    """R13 and R23 are within 8 ulp of their own size of those of the motion alone, where k t is small."""
    draws = [m for m in motions(6, seed=3) if 1e-100 < abs(m.omega2 / m.B2) < 1e100]
    many, motions_each = ElementaryMotion(*inputs(draws)), motions_alone(draws)
    t = 1e-8 / abs(many.k)
    for j in (0, 1):
        entries = many.rotation(t)[:, j, 2]
        true = np.array([motion.rotation(time)[j, 2] for motion, time in zip(motions_each, t.tolist(), strict=True)])
        assert (abs(entries - true) <= 8 * np.spacing(abs(true))).all()


def test_vectors_of_many_motions_agree_with_one_by_one() -> None:
    """Omega, K and m are within 16 ulp of their length of those of the motion alone, each within 8 of the truth."""
    draws = motions(8, seed=4)
    many, motions_each, t = ElementaryMotion(*inputs(draws)), motions_alone(draws), moments(draws)
    for name in ("angular_velocity", "field_in_body", "angular_momentum"):
        vectors = getattr(many, name)(t)
        for motion, time, vector in zip(motions_each, t.tolist(), vectors, strict=True):
            true = getattr(motion, name)(time)
            with np.errstate(over="ignore", under="ignore"):
                size = abs(true).max()
            assert (abs(vector - true) <= 16 * np.spacing(2 * size)).all()


def test_rotations_of_an_array_are_the_identity_at_zero() -> None:
    """R(0) = 1 to the bit for every motion of an array, free and charged, and for balls."""
    draws = motions(4, seed=5)
    r = np.random.default_rng(0)
    for many in (
        ElementaryMotion(*inputs(draws)),
        FreeMotion(r.uniform(0.1, 2, 9), r.normal(size=(3, 9))),
        BallMotion(r.uniform(0.1, 2, 9), r.normal(size=9), r.normal(size=(2, 9))),
    ):
        assert np.array_equal(many.rotation(-0.0), np.broadcast_to(np.eye(3), (*many.shape, 3, 3)))


@pytest.mark.parametrize("seed", range(3))
def test_many_matrices_are_orthogonal(seed: int) -> None:
    """R^T R = 1 and det R = 1 within 8 ulp(1) for free bodies and balls at random times; columns are the matrix'."""
    r = np.random.default_rng(seed)
    t = r.uniform(-1e6, 1e6, 200)
    for many in (
        FreeMotion(r.uniform(0.1, 2, 200), r.normal(size=(3, 200))),
        BallMotion(r.uniform(0.1, 2, 200), r.normal(size=200), r.normal(size=(2, 200))),
    ):
        R = many.rotation(t)
        assert abs(R.swapaxes(1, 2) @ R - np.eye(3)).max() <= 8 * ULP1
        assert abs(np.linalg.det(R) - 1).max() <= 16 * ULP1
        for j in (1, 2, 3):
            assert np.array_equal(many.column(j, t), R[:, :, j - 1])


def test_free_bodies_and_balls_in_arrays_agree_with_one_by_one() -> None:
    """Frequencies to the bit, matrices to 8 ulp(1), each being within 4 of the truth; extreme inputs."""
    random = Random(6)  # noqa: S311  reproducible, not secret
    bodies = [extreme.free_motion(random) for _ in range(150)]
    many = FreeMotion([x.I for x in bodies], np.transpose([x.omega for x in bodies]))
    balls = [extreme.ball_motion(random) for _ in range(150)]
    turning = BallMotion(
        [x.inertia for x in balls], [x.larmor for x in balls], np.transpose([(x.m2, x.m3) for x in balls])
    )
    for draws, group, make, names in (
        (bodies, many, lambda x: FreeMotion(x.I, x.omega), ("k", "phi")),
        (balls, turning, lambda x: BallMotion(x.inertia, x.larmor, (x.m2, x.m3)), ("gamma",)),
    ):
        motions_each = [make(x) for x in draws]
        for name in names:
            assert np.array_equal(getattr(group, name), [getattr(motion, name) for motion in motions_each])
        t = moments(draws)  # type: ignore[arg-type]
        R = np.array([motion.rotation(time) for motion, time in zip(motions_each, t.tolist(), strict=True)])
        assert abs(group.rotation(t) - R).max() <= 8 * ULP1
    k2, k3 = turning.k_hat
    each_hat = np.array([BallMotion(x.inertia, x.larmor, (x.m2, x.m3)).k_hat for x in balls])
    assert np.array_equal(np.stack([k2, k3], -1), each_hat)


def test_one_array_may_hold_every_special_case() -> None:
    """An array that holds every case gives each its name, frequencies and matrix."""
    I = [0.5, 1.5, 0.5, 1.0, 1.5, 0.7]
    B2, B3 = [0.0, 0.0, 2.0, 2.0, 1.0, 1.0], [0.0, -3.0, 0.0, 1.0, 2.0, 2.0]
    w2 = [0.3, 0.0, -2.0, -2.0, 0.0, 0.4]
    omega3_free = [0.7, 0.2, -0.4, 0.6]
    omega3_curve = [Hyperbola(i, (b, c)).omega3(w) for i, b, c, w in zip(I[4:], B2[4:], B3[4:], w2[4:], strict=True)]
    many = ElementaryMotion(I, (B2, B3), w2, [*omega3_free, *omega3_curve])
    assert many.case.tolist() == [
        "free body", "spin along the field", "transverse field, free spin", "ball, free spin", "at rest", "precession",
    ]  # fmt: skip
    for i, w3 in enumerate([*omega3_free, *omega3_curve]):
        motion = ElementaryMotion(I[i], (B2[i], B3[i]), w2[i], w3)
        assert (many.k[i], many.phi[i], many.omega3[i]) == (motion.k, motion.phi, motion.omega3)
        assert abs(many.rotation(1.7)[i] - motion.rotation(1.7)).max() <= 8 * ULP1


def test_a_phase_too_long_in_one_row_is_an_error() -> None:
    """Beyond 2^50 one time of many is refused by name."""
    with pytest.raises(AtlasError, match="2\\^50"):
        ElementaryMotion([0.5, 1.5], (1.0, 2.0), 0.7).rotation([1.0, 1e17])


@pytest.mark.parametrize("power", [-1015, -905, 905, 1015])
def test_rates_at_the_ends_of_the_doubles_turn_as_others_do(power: int) -> None:
    """In another unit of time, a power of two, each matrix is the same within 8 ulp(1), beside ordinary ones."""
    r = np.random.default_rng(power + 2000)
    I, (B2, B3, w2), t = r.uniform(0.1, 2, 8), r.normal(size=(3, 8)), r.uniform(-3, 3, 8)
    unit = np.where(np.arange(8) % 2, 2.0**power, 1.0)
    R = ElementaryMotion(I, (B2 * unit, B3 * unit), w2 * unit).rotation(t / unit)
    assert np.abs(R - ElementaryMotion(I, (B2, B3), w2).rotation(t)).max() <= 8 * ULP1


def test_quadrics_and_hyperbolas_in_arrays_have_the_bits_of_one_by_one() -> None:
    """Every scalar of both, in all extreme regimes, to the bit."""
    draws = [m for m in motions(5, seed=7) if m.B3]
    I, field, w2 = inputs(draws)
    quadric, curve = Quadric(I, field), Hyperbola(I, field)
    quadrics, curves = ([kind(m.I3, (m.B2, m.B3)) for m in draws] for kind in (Quadric, Hyperbola))
    for name in ("kind", "beta", "a2", "a3", "semi_axes", "axes"):
        assert np.array_equal(getattr(quadric, name), [getattr(quadric_single, name) for quadric_single in quadrics])
    rows = list(zip(curves, w2.tolist(), strict=True))
    assert np.array_equal(curve.omega3(w2), [curve_single.omega3(w) for curve_single, w in rows])
    assert np.array_equal(
        np.transpose(curve.frequencies(w2)), [curve_single.frequencies(w) for curve_single, w in rows]
    )
    assert np.array_equal(curve.stability(w2), [curve_single.stability(w) for curve_single, w in rows])
    with pytest.raises(AtlasError, match="one curve"):
        curve.sample(10)


def test_particles_in_arrays_agree_with_one_by_one() -> None:
    """Names and constants to the bit, positions and velocities to 4 ulp of their length; extreme inputs."""
    random = Random(8)  # noqa: S311  reproducible, not secret
    draws = [extreme.particle_motion(random) for _ in range(300)]
    mu, c, E, B, y, v = (
        np.array([getattr(p, name) for p in draws]) for name in ("mu", "c", "E", "B", "position", "velocity")
    )
    mu[:9] = 0.0
    many = ParticleMotion(mu, E, B, y, v, c)
    particles = [ParticleMotion(*row) for row in zip(mu, E, B, y, v, c, strict=True)]
    for name in ("case", "kind", "cyclotron_frequency", "prime"):
        assert np.array_equal(getattr(many, name), [getattr(particle, name) for particle in particles])
    with pytest.raises(DomainError, match="no radius"):
        _ = many.radius
    t = moments(draws)  # type: ignore[arg-type]
    for name in ("position", "velocity"):
        true = np.array([getattr(particle, name)(time) for particle, time in zip(particles, t.tolist(), strict=True)])
        assert (abs(getattr(many, name)(t) - true) <= 4 * np.spacing(abs(true).max(axis=1))[:, None]).all()
    forced = [i for i, particle in enumerate(particles) if particle.cyclotron_frequency]
    particles_forced = ParticleMotion(mu[forced], E[forced], B[forced], y[forced], v[forced], c[forced])
    for name in ("radius", "drift"):
        assert np.array_equal(getattr(particles_forced, name), [getattr(particles[i], name) for i in forced])
    assert np.array_equal(
        particles_forced.guiding_centre(t[forced]), [particles[i].guiding_centre(t[i]) for i in forced]
    )
