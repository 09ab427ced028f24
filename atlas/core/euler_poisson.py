"""The Euler–Poisson equations of a charged body with any inertia tensor: mf21, mf27 and their momentum forms.

Everything is a pure function of arrays that broadcast: `inertia` (..., 3, 3) is a symmetric positive tensor I in the
laboratory axes at t = 0, not only a diagonal one, with the mass matrix g = (tr I / 2) 1 - I. Vectors are (..., 3),
rotations (..., 3, 3). `B` is B' = mu B/(2c), mf41, in the laboratory, and `K` = R^T B' in the body. All frequencies
share one unit. These functions check nothing: the integrators call them often.

Conserved for every body: the energy (Omega, I Omega)/2; K^2; and, since the fields don't change when the whole is
turned about B, the canonical momentum along B,

    (K, I (Omega + K)) = (B', m + R I R^T B'),

of which the (m, B') = const of the ball, mf33, and c5 of mf49 are special cases. A body with I1 = I2 has one more,
c3 = Omega3 + K3, mf48; a ball all three components of Omega + K along a frame that turns with Larmor's frequency.
"""

from typing import Any

import numpy as np

from atlas.core.inputs import FloatArray


def hat(omega: Any) -> FloatArray:
    """Return the antisymmetric matrices (..., 3, 3) for which v @ hat(omega) = [v, omega]."""
    omega = np.asarray(omega, dtype=np.float64)
    matrix = np.zeros((*omega.shape, 3))
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        matrix[..., j, k] = -omega[..., i]
        matrix[..., k, j] = omega[..., i]
    return matrix


def mass_matrix(inertia: Any) -> FloatArray:
    """Mass matrix g = (tr I / 2) 1 - I of inertia tensors (..., 3, 3), unchecked; see mf21."""
    inertia = np.asarray(inertia, dtype=np.float64)
    return np.trace(inertia, axis1=-2, axis2=-1)[..., None, None] / 2 * np.eye(3) - inertia


def field_in_body(R: Any, B: Any) -> FloatArray:
    """Field K = R^T B' as the body sees it, mf41."""
    return np.vecmat(np.asarray(B, dtype=np.float64), np.asarray(R))


def rotation_rate(R: Any, Omega: Any) -> FloatArray:
    """Poisson equations, mf21: dR_ij/dt = -eps_jab Omega_a R_ib; each row obeys mf79."""
    return np.asarray(np.matmul(R, hat(Omega)))


def field_rate(K: Any, Omega: Any) -> FloatArray:
    """Poisson equation of the field in the body, mf43: dK/dt = -[Omega, K]."""
    return np.vecmat(K, hat(Omega))


def angular_acceleration(inertia: Any, K: Any, Omega: Any) -> FloatArray:
    """Euler equations, mf27 and mf42: dOmega/dt = I^-1 [I Omega - 2 g K, Omega]."""
    torque = body_momentum_rate(inertia, K, np.matvec(inertia, Omega))
    return np.asarray(np.linalg.solve(inertia, torque[..., None])[..., 0])


def body_momentum_rate(inertia: Any, K: Any, M: Any) -> FloatArray:
    """Rate of M = I Omega in the body, mf29: dM/dt = [M - 2 g K, I^-1 M]."""
    M = np.asarray(M, dtype=np.float64)
    Omega = np.linalg.solve(inertia, M[..., None])[..., 0]
    return np.vecmat(M - 2 * np.matvec(mass_matrix(inertia), K), hat(Omega))


def momentum_rate(inertia: Any, B: Any, R: Any, m: Any) -> FloatArray:
    """Rate of m = R I Omega in the laboratory, mf28: dm/dt = -2 [R g R^T B', R I^-1 R^T m]."""
    R = np.asarray(R, dtype=np.float64)
    K, M = field_in_body(R, B), field_in_body(R, m)
    Omega = np.linalg.solve(inertia, M[..., None])[..., 0]
    return np.vecmat(-2 * np.matvec(R, np.matvec(mass_matrix(inertia), K)), hat(np.matvec(R, Omega)))


def energy(inertia: Any, Omega: Any) -> FloatArray:
    """Kinetic energy (Omega, I Omega)/2, the E of mf41.1; a magnetic field does no work on it."""
    return np.asarray(np.vecdot(Omega, np.matvec(inertia, Omega)) / 2)


def momentum_along_field(inertia: Any, K: Any, Omega: Any) -> FloatArray:
    """Return (K, I (Omega + K)), |B'| times the canonical momentum along B: conserved for every body."""
    return np.asarray(np.vecdot(K, np.matvec(inertia, np.add(Omega, K))))
