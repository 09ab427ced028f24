"""The Euler–Poisson equations of a charged body with any inertia tensor: (16), and (35) of the field in the body.

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


def field_rate(K: Any, Omega: Any) -> FloatArray:
    """Poisson equation of the field K in the body, (35), in components (39): dK/dt = -[Omega, K], shape (..., 3).

    Each row of R obeys the same equation, (74).
    """
    return bracket(K, Omega)


def angular_acceleration(inertia: Any, K: Any, Omega: Any) -> FloatArray:
    """Euler equations, (16) and (34), (38) if I1 = I2: dOmega/dt = I^-1 [I Omega - 2 g K, Omega], shape (..., 3).

    I is the tensor ``inertia``, g = (tr I/2) 1 - I, and K and Omega are along the body's axes.
    """
    torque = bracket(np.matvec(inertia, Omega) - 2 * np.matvec(mass_matrix(inertia), K), Omega)
    return np.asarray(np.linalg.solve(inertia, torque[..., None])[..., 0])
