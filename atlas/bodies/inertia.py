"""Inertia tensor and mass matrix (8), one from the other, for any body."""

from typing import Any

import numpy as np
from flint import fmpq

from atlas.arithmetic.dimensions import LENGTH, MASS
from atlas.arithmetic.inputs import FloatArray, finite, frozen, real
from atlas.arithmetic.numbers import as_rational, nearest, workprec
from atlas.bodies.certified_inertia import principal_axes
from atlas.errors import AtlasError, DomainError, tell_nearest

ROUNDING = 16 * float(np.finfo(float).eps)
"""Part of the largest principal value of a matrix by which rounded elements may make a principal value wrong."""

SINGLE = 1e-6
"""Part of its largest element by which a tensor in single precision may fail to be that of a body."""

PRECISION = 320
"""Bits of principal values and axes."""

MAX_EXACT_POINTS = 4096
"""Point masses up to which the sums over them are rational: in some tenths of a second."""

LARGEST = float(np.finfo(float).max) / 8
"""Sums of elements up to this are finite."""


def mass_matrix(inertia: Any) -> FloatArray:
    """Return the mass matrix g = (tr I / 2) 1 - I of inertia tensors (..., 3, 3), unchecked; see (12)."""
    inertia = np.asarray(inertia, dtype=np.float64)
    return np.asarray(np.trace(inertia, axis1=-2, axis2=-1)[..., None, None] / 2 * np.eye(3) - inertia)


def mass_matrix_from_inertia(inertia: Any) -> FloatArray:
    """Mass matrix g = (tr I / 2) 1 - I of an inertia tensor: 2 g1 = I2 + I3 - I1, and so on; see (11).

    `inertia` is a diagonal of shape (3,) or tensors of shape (..., 3, 3); the result has the same shape.
    """
    tensor, trace = diagonal_or_matrices(inertia, "The inertia tensor")
    return trace / 2 - tensor if tensor.ndim == 1 else mass_matrix(tensor)


def inertia_from_mass_matrix(mass_matrix: Any) -> FloatArray:
    """Inertia tensor I = (tr g) 1 - g of a mass matrix (8), as defined below (12).

    `mass_matrix` is a diagonal of shape (3,) or matrices of shape (..., 3, 3); the result has the same shape.
    """
    matrix, trace = diagonal_or_matrices(mass_matrix, "The mass matrix")
    return trace - matrix if matrix.ndim == 1 else trace * np.eye(3) - matrix


def mass_matrix_of_points(masses: Any, positions: Any) -> FloatArray:
    """Mass matrix g_ij = sum m_N x_N^i x_N^j, (8), of points counted from their centre of mass.

    `masses` (N,), all positive; `positions` (N, 3) in any frame and from any origin. Returns (3, 3).
    """
    return rounded(exact_mass_matrix(masses, positions))


def exact_mass_matrix(masses: Any, positions: Any) -> list[list[fmpq]]:
    """Return the matrix of `mass_matrix_of_points` as three rows of rationals, exact up to MAX_EXACT_POINTS points.

    Above that number the sums are made in doubles. Raises AtlasError for wrong shapes, DomainError for a mass that
    is not positive and for a sum too large for a float.
    """
    m, x = real(masses, "The masses", MASS), real(positions, "The positions", LENGTH)
    if m.ndim != 1 or x.shape != (m.size, 3) or not m.size:
        raise AtlasError(f"Point masses need masses (N,) and positions (N, 3), not {m.shape} and {x.shape}.")
    if m.min() <= 0:
        raise DomainError(f"Every mass must be positive, but one is {m.min()}.")
    if m.size > MAX_EXACT_POINTS:
        with np.errstate(over="ignore", invalid="ignore"):
            x = x - (m @ x) / m.sum()
            return rational_matrix(real((m[:, None] * x).T @ x, "The mass matrix"))
    mass = sum((fmpq(*value.as_integer_ratio()) for value in m.tolist()), fmpq(0))
    first, second = sums_over_points(m, x)
    matrix = [[y - first[i] * first[j] / mass for j, y in enumerate(row)] for i, row in enumerate(second)]
    finite(np.array([nearest(x) for row in matrix for x in row]), "The mass matrix")
    return matrix


def sums_over_points(weights: FloatArray, positions: FloatArray) -> tuple[list[fmpq], list[list[fmpq]]]:
    """Return (sum of a x, three rationals; sum of a x x^T, three rows of three), exact, of weights a (N,) at x (N, 3).

    ``positions`` are x.
    """
    a, *columns = [[fmpq(*value.as_integer_ratio()) for value in v] for v in (weights.tolist(), *positions.T.tolist())]
    weighted = [[p * q for p, q in zip(a, v, strict=True)] for v in columns]
    second = [[sum((p * q for p, q in zip(v, w, strict=True)), fmpq(0)) for w in columns] for v in weighted]
    return [sum(v, fmpq(0)) for v in weighted], second


def inertia_tensor(inertia: Any) -> FloatArray:
    """Return the inertia tensor (3, 3) of a body, from itself or from principal moments (3,), checked.

    Raises DomainError unless it is positive, with each principal moment at most the sum of the others: by (11),
    2 g1 = I2 + I3 - I1 is a sum of 2 m x^2. A plane body has equality, up to rounding: NearestInputWarning where a
    tensor is beyond by more than that of doubles, but not by more than that of single precision.
    """
    return checked_tensor(inertia)[0]


def checked_tensor(inertia: Any) -> tuple[FloatArray, list[fmpq], list[list[fmpq]]]:
    """Return (inertia tensor (3, 3), its principal values, its axes as rows) of a body, checked by `inertia_tensor`.

    Values and axes are rationals, as `principal_values` returns them.
    """
    tensor, _ = diagonal_or_matrices(inertia, "The inertia tensor")
    if tensor.ndim > 2:
        raise AtlasError(f"A body has one inertia tensor (3, 3) or diagonal (3,), not the shape {tensor.shape}.")
    tensor = np.diag(tensor) if tensor.ndim == 1 else tensor
    oblique = bool((tensor * (1 - np.eye(3))).any())
    values, axes = principal_values(rational_matrix(tensor))
    I = np.sort([*map(nearest, values)])
    if I[0] <= ROUNDING * oblique * I[2]:
        least = f": {I[2] - I[1]:.15g} is the least that any body has" if I[0] >= 0 and I[2] > I[1] > 0 else ""
        remedy = f"{least or ': give a thin body a radius'}" if I[0] == 0 else ""
        raise DomainError(f"The moments of inertia must be positive, but the principal ones are {I}{remedy}.")
    beyond = I[2] - I[1] - I[0]
    excess = f"{I[2]:.6g} exceeds {I[1]:.6g} + {I[0]:.6g} by {beyond:.2g}"
    if beyond > (SINGLE if oblique else ROUNDING) * I[2]:
        raise DomainError(
            f"No body has the principal moments {I}: the largest is at most the sum of the others, since 2 g1 = I2 + "
            f"I3 - I1 is a sum of 2 m x^2, but {excess}; {I[1] + I[0]:.15g} would do."
        )
    if beyond > ROUNDING * I[2]:
        tell_nearest(f"No body has this inertia tensor, by its last digits: {excess}", "a plane body")
    return tensor, values, axes


def principal_values(matrix: list[list[fmpq]]) -> tuple[list[fmpq], list[list[fmpq]]]:
    """Return (three principal values, three axes as rows), rationals, of a symmetric matrix of rationals.

    They are right to `PRECISION` bits; values that are equal are exactly equal. Values of a diagonal stay in their
    order; others ascend.
    """
    if not any(matrix[i][j] for i in range(3) for j in range(3) if i != j):
        return [matrix[i][i] for i in range(3)], [[fmpq(i == j) for j in range(3)] for i in range(3)]
    with workprec(PRECISION):
        values, axes = principal_axes(matrix)
        return [*map(as_rational, values)], [[*map(as_rational, axis)] for axis in axes]


def rounded(matrix: list[list[fmpq]]) -> FloatArray:
    """Return the floats nearest to the rational numbers of a matrix, an array of its rows."""
    return np.array([[nearest(x) for x in row] for row in matrix])


def rational_matrix(matrix: FloatArray) -> list[list[fmpq]]:
    """Return the floats of a matrix (N, M) as exact rational numbers, a list of N rows."""
    return [[fmpq(*x.as_integer_ratio()) for x in row] for row in matrix.tolist()]


def diagonal_or_matrices(value: Any, name: str) -> tuple[FloatArray, FloatArray]:
    """Return (diagonal (3,) or symmetric matrices (..., 3, 3), their trace shaped to broadcast with them).

    ``name`` stands in errors. Raises AtlasError for another shape and for matrices that are not symmetric to single
    precision, DomainError for entries too large. A matrix that is not symmetric to double precision is replaced by
    its mean with the transpose, with a NearestInputWarning.
    """
    tensor = real(value, name)
    if tensor.shape != (3,) and tensor.shape[-2:] != (3, 3):
        raise AtlasError(f"{name} must be a diagonal (3,) or matrices (..., 3, 3), not of shape {tensor.shape}.")
    if np.abs(tensor).max(initial=0.0) > LARGEST:
        raise DomainError(f"{name} is too large for a float: choose larger units.")
    if tensor.ndim == 1:
        return tensor, tensor.sum()
    size = np.abs(tensor).max(axis=(-2, -1))
    difference = np.abs(tensor - tensor.swapaxes(-2, -1))
    quotients = difference / np.where(size == 0, 1, size)[..., None, None]
    if (largest := quotients.max(initial=0.0)) > ROUNDING:
        index = np.unravel_index(quotients.argmax(), quotients.shape)
        i, j = int(index[-2]) + 1, int(index[-1]) + 1
        fault = f"its elements ({i}, {j}) and ({j}, {i}) differ by {difference[index]:.3g}"
        if largest > SINGLE:
            raise AtlasError(f"{name} must be symmetric, but {fault}: give one value for both.")
        tell_nearest(f"{name} is not symmetric: {fault}", "the mean of both")
        tensor = frozen((tensor + tensor.swapaxes(-2, -1)) / 2)
    return tensor, np.trace(tensor, axis1=-2, axis2=-1)[..., None, None]
