"""The equations of section II on random clouds of points: the body is that of (8), particles held together."""

from dataclasses import dataclass

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from atlas.bodies.inertia import mass_matrix, mass_matrix_of_points
from atlas.motions import euler_poisson as equations

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
    def random(cls, seed: int) -> "Cloud":
        """Make a cloud of seven points."""
        rng = np.random.default_rng(seed)
        masses, start = rng.uniform(0.2, 1, 7), rng.normal(size=(7, 3))
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
def test_the_mass_matrix_agrees_with_the_points(seed: int) -> None:
    """The mass matrix g of (8) is (tr I/2) 1 - I."""
    c = Cloud.random(seed)
    assert np.abs(mass_matrix(c.inertia) - mass_matrix_of_points(c.masses, c.start)).max() < c.tolerance


@given(seeds)
def test_the_torque_agrees_with_the_lorentz_forces(seed: int) -> None:
    """(16) makes dm/dt = R (I Omega' + [Omega, I Omega]) the sum of [x_N, f_N]: constraints have no torque."""
    c = Cloud.random(seed)
    m = (c.masses[:, None] * np.cross(c.x, c.v)).sum(axis=0)
    assert np.abs(m - c.R @ c.inertia @ c.Omega).max() < c.tolerance
    rate = c.inertia @ equations.angular_acceleration(c.inertia, c.K, c.Omega) + np.cross(c.Omega, c.inertia @ c.Omega)
    assert np.abs(c.R @ rate - np.cross(c.x, c.force).sum(axis=0)).max() < c.tolerance


@given(seeds)
def test_the_accelerations_need_only_symmetric_multipliers(seed: int) -> None:
    """With (16), the lambda of (6) = -R^T (R'' + A) g comes out symmetric, which is all that the constraints ask."""
    c = Cloud.random(seed)
    g = mass_matrix(c.inertia)
    R1 = c.R @ equations.hat(c.Omega)
    acceleration = equations.angular_acceleration(c.inertia, c.K, c.Omega)
    R2 = R1 @ equations.hat(c.Omega) + c.R @ equations.hat(acceleration)
    A = 2 * np.cross(c.B, R1, axisb=0, axisc=0)  # (7)
    multipliers = -c.R.T @ (R2 + A) @ g
    assert np.abs(multipliers - multipliers.T).max() < c.tolerance


@given(seeds)
def test_every_body_conserves_energy_field_and_momentum_along_the_field(seed: int) -> None:
    """The rates of (Omega, I Omega), K^2 and (K, I (Omega + K)) vanish for any cloud."""
    c = Cloud.random(seed)
    I, K, Omega = c.inertia, c.K, c.Omega
    dOmega, dK = equations.angular_acceleration(I, K, Omega), equations.field_rate(K, Omega)
    assert abs(Omega @ I @ dOmega) < 10 * c.tolerance
    assert abs(K @ dK) < c.tolerance
    assert abs(dK @ I @ (Omega + K) + K @ I @ (dOmega + dK)) < 10 * c.tolerance


def test_arrays_broadcast() -> None:
    """Many states of many bodies at once have the values of each alone."""
    clouds = [Cloud.random(seed) for seed in range(4)]
    I, K, Omega = (np.array([getattr(c, name) for c in clouds]) for name in ("inertia", "K", "Omega"))
    together = equations.angular_acceleration(I, K, Omega)
    for n, cloud in enumerate(clouds):
        alone = equations.angular_acceleration(I[n], K[n], Omega[n])
        assert np.abs(together[n] - alone).max() < cloud.tolerance
    assert equations.angular_acceleration(I[0], K[0], Omega).shape == (4, 3)
