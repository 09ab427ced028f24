"""The equations of section II on random clouds of points: the body is what (8) says, particles held together."""

from dataclasses import dataclass

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from atlas.core.bodies.inertia import mass_matrix, mass_matrix_of_points
from atlas.core.motions import euler_poisson as equations

EPS = float(np.finfo(float).eps)
seeds = st.integers(0, 2**32 - 1)


@dataclass
class Cloud:
    """Charged points about their centre of mass, turned by R, turning with Omega in the field B'."""

    rng: np.random.Generator
    masses: NDArray[np.float64]
    start: NDArray[np.float64]
    inertia: NDArray[np.float64]
    R: NDArray[np.float64]
    Omega: NDArray[np.float64]
    B: NDArray[np.float64]

    @classmethod
    def random(cls, seed: int, *, symmetric: bool = False, round_: bool = False) -> "Cloud":
        """Make a cloud of seven points, or one that is symmetric about the third axis, or about all."""
        rng = np.random.default_rng(seed)
        masses, start = rng.uniform(0.2, 1, 7), rng.normal(size=(7, 3))
        if symmetric:
            angles = 2 * np.pi * np.arange(4) / 4
            start = np.array(
                [[r * np.cos(a), r * np.sin(a), z] for r, z in rng.uniform(0.5, 2, (2, 2)) for a in angles]
            )
            masses = np.repeat(rng.uniform(0.2, 1, 2), 4)
        if round_:
            start, masses = np.concatenate([np.eye(3), -np.eye(3)]), np.full(6, 0.3)
        start = start - masses @ start / masses.sum()
        inertia = np.einsum("n,nij->ij", masses, [x @ x * np.eye(3) - np.outer(x, x) for x in start])
        inertia = (inertia + inertia.T) / 2
        return cls(
            rng, masses, start, inertia, Rotation.random(rng=rng).as_matrix(), rng.normal(size=3), rng.normal(size=3)
        )

    @property
    def K(self) -> NDArray[np.float64]:
        """The field in the body."""
        return self.B @ self.R

    @property
    def x(self) -> NDArray[np.float64]:
        """Positions."""
        return self.start @ self.R.T

    @property
    def v(self) -> NDArray[np.float64]:
        """Velocities of the points of a body that turns with R Omega."""
        return np.cross(self.R @ self.Omega, self.x)

    @property
    def force(self) -> NDArray[np.float64]:
        """Lorentz forces: (mu/c) m [v, B] = 2 m [v, B']."""
        return 2 * self.masses[:, None] * np.cross(self.v, self.B)

    @property
    def tolerance(self) -> float:
        """Rounding of sums of such sizes."""
        size = 1 + np.abs(self.Omega).max() + np.abs(self.B).max()
        return 1000 * EPS * np.linalg.cond(self.inertia) * np.trace(self.inertia) * size**2


@given(seeds)
def test_mass_matrix_and_energy_are_those_of_the_points(seed: int) -> None:
    """The mass matrix g of (8) is (tr I/2) 1 - I, and (Omega, I Omega)/2 is the points' kinetic energy."""
    c = Cloud.random(seed)
    assert np.abs(mass_matrix(c.inertia) - mass_matrix_of_points(c.masses, c.start)).max() < c.tolerance
    assert abs(equations.energy(c.inertia, c.Omega) - c.masses @ (c.v**2).sum(axis=1) / 2) < c.tolerance


@given(seeds)
def test_the_torque_is_that_of_the_lorentz_forces(seed: int) -> None:
    """The right-hand side of (17) is the sum of [x_N, f_N], since the constraints' forces have no torque."""
    c = Cloud.random(seed)
    m = (c.masses[:, None] * np.cross(c.x, c.v)).sum(axis=0)
    assert np.abs(m - c.R @ c.inertia @ c.Omega).max() < c.tolerance
    torque = np.cross(c.x, c.force).sum(axis=0)
    assert np.abs(equations.momentum_rate(c.inertia, c.B, c.R, m) - torque).max() < c.tolerance


@given(seeds)
def test_the_accelerations_need_only_symmetric_multipliers(seed: int) -> None:
    """With (16), the lambda of (6) = -R^T (R'' + A) g comes out symmetric, which is all that the constraints ask."""
    c = Cloud.random(seed)
    g = mass_matrix(c.inertia)
    R1 = equations.rotation_rate(c.R, c.Omega)
    R2 = equations.rotation_rate(R1, c.Omega) + equations.rotation_rate(
        c.R, equations.angular_acceleration(c.inertia, c.K, c.Omega)
    )
    A = 2 * np.cross(c.B, R1, axisb=0, axisc=0)  # (7)
    multipliers = -c.R.T @ (R2 + A) @ g
    assert np.abs(multipliers - multipliers.T).max() < c.tolerance


@given(seeds)
def test_the_three_forms_agree(seed: int) -> None:
    """The forms (16), (17) and (18) are one equation for Omega, m = R I Omega and M = I Omega."""
    c = Cloud.random(seed)
    M, K = c.inertia @ c.Omega, equations.field_in_body(c.R, c.B)
    body = equations.body_momentum_rate(c.inertia, K, M)
    assert np.abs(c.inertia @ equations.angular_acceleration(c.inertia, K, c.Omega) - body).max() < c.tolerance
    moving = equations.rotation_rate(c.R, c.Omega) @ M + c.R @ body
    assert np.abs(equations.momentum_rate(c.inertia, c.B, c.R, c.R @ M) - moving).max() < c.tolerance


@given(seeds)
def test_three_terms_make_one_with_the_mass_matrix(seed: int) -> None:
    """In (15), I[K, Omega] - [I K, Omega] + [K, I Omega] = 2 [g K, Omega], also for a tensor that is not diagonal."""
    c = Cloud.random(seed)
    I, K, Omega = c.inertia, c.K, c.Omega
    three = I @ np.cross(K, Omega) - np.cross(I @ K, Omega) + np.cross(K, I @ Omega)
    assert np.abs(three - 2 * np.cross(mass_matrix(I) @ K, Omega)).max() < c.tolerance
    euler = np.cross(I @ Omega, Omega) - three
    assert np.abs(equations.body_momentum_rate(I, K, I @ Omega) - euler).max() < c.tolerance


@given(seeds)
def test_rotations_stay_rotations_and_carry_the_field(seed: int) -> None:
    """The rate of R^T R vanishes by (12), the rows turn as (74) says, and K = R^T B' changes as (35) says."""
    c = Cloud.random(seed)
    rate = equations.rotation_rate(c.R, c.Omega)
    assert np.abs(rate.T @ c.R + c.R.T @ rate).max() < c.tolerance
    assert np.abs(rate - np.cross(c.R, c.Omega)).max() < c.tolerance
    assert np.abs(c.B @ rate - equations.field_rate(c.K, c.Omega)).max() < c.tolerance
    assert np.abs(rate @ c.start.T - c.v.T).max() < c.tolerance


@given(seeds)
def test_every_body_conserves_energy_field_and_momentum_along_the_field(seed: int) -> None:
    """The rates of (Omega, I Omega), K^2 and (K, I (Omega + K)) vanish for any cloud."""
    c = Cloud.random(seed)
    I, K, Omega = c.inertia, c.K, c.Omega
    dOmega, dK = equations.angular_acceleration(I, K, Omega), equations.field_rate(K, Omega)
    assert abs(Omega @ I @ dOmega) < 10 * c.tolerance
    assert abs(K @ dK) < c.tolerance
    assert abs(dK @ I @ (Omega + K) + K @ I @ (dOmega + dK)) < 10 * c.tolerance
    laboratory = c.B @ (c.R @ I @ Omega + c.R @ I @ c.R.T @ c.B)
    assert abs(equations.momentum_along_field(I, K, Omega) - laboratory) < 10 * c.tolerance


@given(seeds)
def test_a_symmetric_body_conserves_one_more(seed: int) -> None:
    """With I1 = I2 the sum Omega3 + K3 is conserved, (40); without that symmetry it is not."""
    for symmetric in (True, False):
        c = Cloud.random(seed, symmetric=symmetric)
        dOmega, dK = equations.angular_acceleration(c.inertia, c.K, c.Omega), equations.field_rate(c.K, c.Omega)
        assert (abs(dOmega[2] + dK[2]) < c.tolerance) == symmetric


@given(seeds)
def test_the_momentum_of_a_ball_precesses_with_larmors_frequency(seed: int) -> None:
    """For I1 = I2 = I3, (17) is dm/dt = -[B', m], (22): m^2 and (m, B) are conserved, (23)."""
    c = Cloud.random(seed, round_=True)
    m = c.R @ c.inertia @ c.Omega
    rate = equations.momentum_rate(c.inertia, c.B, c.R, m)
    assert np.abs(rate + np.cross(c.B, m)).max() < c.tolerance
    assert abs(m @ rate) < c.tolerance
    assert abs(c.B @ rate) < c.tolerance


@given(seeds)
def test_the_components_of_a_symmetric_body(seed: int) -> None:
    """The forms (34) and (35) give the components (38) and (39) as printed."""
    rng = np.random.default_rng(seed)
    I, (O1, O2, O3), (K1, K2, K3) = rng.uniform(0.1, 2), rng.normal(size=3), rng.normal(size=3)
    angular = [
        (1 - I) * O3 * O2 - I * O3 * K2 + (2 - I) * O2 * K3,
        -(1 - I) * O3 * O1 + I * O3 * K1 - (2 - I) * O1 * K3,
        O1 * K2 - O2 * K1,
    ]
    field = [O3 * K2 - O2 * K3, -O3 * K1 + O1 * K3, -(O1 * K2 - O2 * K1)]
    K, Omega = np.array([K1, K2, K3]), np.array([O1, O2, O3])
    assert np.abs(equations.angular_acceleration(np.diag([1, 1, I]), K, Omega) - angular).max() < 1000 * EPS
    assert np.abs(equations.field_rate(K, Omega) - field).max() < 100 * EPS


def test_arrays_broadcast() -> None:
    """Many states of many bodies at once give what each gives alone."""
    clouds = [Cloud.random(seed) for seed in range(4)]
    I, R, K, Omega, B = (np.array([getattr(c, name) for c in clouds]) for name in ("inertia", "R", "K", "Omega", "B"))
    m = np.einsum("nij,njk,nk->ni", R, I, Omega)
    together = (
        equations.angular_acceleration(I, K, Omega),
        equations.body_momentum_rate(I, K, Omega),
        equations.momentum_rate(I, B, R, m),
        equations.rotation_rate(R, Omega),
        equations.energy(I, Omega),
        equations.momentum_along_field(I, K, Omega),
    )
    for n in range(4):
        alone = (
            equations.angular_acceleration(I[n], K[n], Omega[n]),
            equations.body_momentum_rate(I[n], K[n], Omega[n]),
            equations.momentum_rate(I[n], B[n], R[n], m[n]),
            equations.rotation_rate(R[n], Omega[n]),
            equations.energy(I[n], Omega[n]),
            equations.momentum_along_field(I[n], K[n], Omega[n]),
        )
        for many, one in zip(together, alone, strict=True):
            assert np.abs(many[n] - one).max() < clouds[n].tolerance
    assert equations.angular_acceleration(I[0], K[0], Omega).shape == (4, 3)
