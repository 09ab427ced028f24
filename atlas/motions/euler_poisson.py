"""The Euler–Poisson equations of a charged body with any inertia tensor: (12), (16) and their momentum forms.

Everything is a pure function of arrays that broadcast: `inertia` (..., 3, 3) is a symmetric positive tensor I in the
laboratory axes at t = 0, not only a diagonal one, with the mass matrix g = (tr I / 2) 1 - I. Vectors are (..., 3),
rotations (..., 3, 3). `B` is B' = mu B/(2c), (32), in the laboratory, and `K` = R^T B' in the body. All frequencies
share one unit. These functions check nothing: the integrators call them often.

Conserved for every body: the energy (Omega, I Omega)/2; K^2; and, since the fields don't change when the whole is
turned about B, the canonical momentum along B',

    (K, I (Omega + K)) = (B', m + R I R^T B'),

which for the ball says (m, B') = const, (23). A body with I1 = I2 also conserves I3 (Omega3 + K3), that is c3 of
(40), and c5 of (41) is then (K, I (Omega + K))/I2 - K^2 + (1 - I3/I2) c3^2. The ball also conserves m^2, (23). For a
body without symmetry no fourth integral is known.
"""

from typing import Any

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.bodies.inertia import mass_matrix


def hat(omega: Any) -> FloatArray:
    """Return antisymmetric matrices (..., 3, 3) of vectors omega (..., 3): a row v times the matrix is [v, omega]."""
    omega = np.asarray(omega, dtype=np.float64)
    matrix = np.zeros((*omega.shape, 3))
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        matrix[..., j, k] = -omega[..., i]
        matrix[..., k, j] = omega[..., i]
    return matrix


def bracket(a: Any, b: Any) -> FloatArray:
    """Return the vector products [a, b], shape (..., 3); a and b broadcast."""
    return np.asarray(np.vecmat(np.asarray(a, dtype=np.float64), hat(b)))


def field_in_body(R: Any, B: Any) -> FloatArray:
    """Field K = R^T B' in the body, (32); R (..., 3, 3) and B' (3,) give (..., 3)."""
    return np.asarray(np.vecmat(np.asarray(B, dtype=np.float64), R))


def rotation_rate(R: Any, Omega: Any) -> FloatArray:
    """Poisson equations, (12): dR_ij/dt = -eps_jab Omega_a R_ib, shape (..., 3, 3); each row of R obeys (74).

    R (..., 3, 3) is the attitude, Omega (..., 3) the angular velocity in the body.
    """
    return np.asarray(np.matmul(R, hat(Omega)))


def field_rate(K: Any, Omega: Any) -> FloatArray:
    """Poisson equation of the field K in the body, (35), in components (39): dK/dt = -[Omega, K], shape (..., 3)."""
    return bracket(K, Omega)


def angular_acceleration(inertia: Any, K: Any, Omega: Any) -> FloatArray:
    """Euler equations, (16) and (34), (38) if I1 = I2: dOmega/dt = I^-1 [I Omega - 2 g K, Omega], shape (..., 3).

    I is the tensor ``inertia``, g = (tr I/2) 1 - I, and K and Omega are along the body's axes.
    """
    return _solve(inertia, _torque(inertia, K, Omega))


def body_momentum_rate(inertia: Any, K: Any, M: Any) -> FloatArray:
    """Rate of M = I Omega in the body, (18): dM/dt = [M - 2 g K, I^-1 M], shape (..., 3).

    I is the tensor ``inertia``, g = (tr I/2) 1 - I, and K the field in the body.
    """
    return _torque(inertia, K, _solve(inertia, M))


def momentum_rate(inertia: Any, B: Any, R: Any, m: Any) -> FloatArray:
    """Rate of m = R I Omega in the laboratory, (17): dm/dt = -2 [R g R^T B', R I^-1 R^T m], (..., 3).

    I is the tensor ``inertia``, g = (tr I/2) 1 - I, and `B` is B' in the laboratory.
    """
    omega = np.matvec(R, _solve(inertia, np.vecmat(m, R)))
    return bracket(-2 * np.matvec(R, np.matvec(mass_matrix(inertia), field_in_body(R, B))), omega)


def energy(inertia: Any, Omega: Any) -> FloatArray:
    """Kinetic energy (Omega, I Omega)/2, the E of (33), shape (...), in inertia/time^2.

    Omega (..., 3) is along the axes of the tensor I, ``inertia``. A magnetic field does no work on the body.
    """
    return np.asarray(np.vecdot(Omega, np.matvec(inertia, Omega)) / 2)


def momentum_along_field(inertia: Any, K: Any, Omega: Any) -> FloatArray:
    """Return (K, I (Omega + K)), shape (...): |B'| times the canonical momentum along B', conserved for every body.

    K is the field in the body, I the tensor ``inertia``; the unit is inertia/time^2.
    """
    return np.asarray(np.vecdot(K, np.matvec(inertia, np.add(Omega, K))))


def _torque(inertia: Any, K: Any, Omega: Any) -> FloatArray:
    """Return the right-hand side [I Omega - 2 g K, Omega] of I dOmega/dt in (16), shape (..., 3).

    I is the tensor ``inertia``, g = (tr I/2) 1 - I, and K the field in the body.
    """
    return bracket(np.matvec(inertia, Omega) - 2 * np.matvec(mass_matrix(inertia), K), Omega)


def _solve(inertia: Any, M: Any) -> FloatArray:
    """Return the solution I^-1 M of I Omega = M, shape (..., 3).

    I is the tensor ``inertia``, (..., 3, 3); M is (..., 3).
    """
    return np.asarray(np.linalg.solve(inertia, np.asarray(M)[..., None])[..., 0])
