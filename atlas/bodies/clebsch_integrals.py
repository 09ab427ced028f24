"""Integrals of a charged body of any inertia tensor: Clebsch's case of e(3), theorem-lie-poisson to theorem-clebsch."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from atlas.arithmetic.annotations import BodyLike, FloatOrArray, RealArrayLike
from atlas.arithmetic.double_double import over
from atlas.arithmetic.inputs import FloatArray, common_shape, plain, real, vectors
from atlas.bodies import formula_integrals as formulas
from atlas.bodies.body import SymmetricBody
from atlas.bodies.inertia import inertia_tensor
from atlas.bodies.symmetric_top import moments_of_one


@dataclass(frozen=True)
class Clebsch:
    """Conserved quantities of a charged body of any inertia tensor J, as `atlas.clebsch` returns them.

    Each is a float, or an array for an array of states. With the field K in the body, M = J (Omega + K) is the
    canonical momentum.

    Attributes
    ----------
    H : float or ndarray
        (M, J^-1 M)/2 + (K, J K)/2, theorem-lie-poisson, in inertia/time^2.
    F : float or ndarray
        Clebsch's integral M^2 - det J (K, J^-1 K), theorem-clebsch, in (inertia/time)^2.
    MK : float or ndarray
        Casimir (M, K): |B'| times the canonical momentum along B', in inertia/time^2.
    K2 : float or ndarray
        Casimir K^2 = B'^2, (37), in 1/time^2.
    energy : float or ndarray
        Kinetic energy (Omega, J Omega)/2 = H - (M, K), theorem-kinetic-energy, in inertia/time^2.

    Notes
    -----
    The four integrals are independent if the three principal moments differ. A symmetric body conserves M3 too, and F
    follows from M3, theorem-clebsch-symmetric.
    """

    H: FloatOrArray
    F: FloatOrArray
    MK: FloatOrArray
    K2: FloatOrArray
    energy: FloatOrArray


def clebsch(inertia: BodyLike, Omega: RealArrayLike, K: RealArrayLike) -> Clebsch:
    """Integrals H, F, (M, K), K^2 and kinetic energy of a state, theorem-clebsch.

    Parameters
    ----------
    inertia : float or array_like or SymmetricBody
        Inertia tensor (3, 3), principal moments (3,), a body, or the ratio I = I3/I2 with I2 = 1.
    Omega : array_like, shape (..., 3)
        Angular velocity in the body, in rad/time.
    K : array_like, shape (..., 3)
        Field R^T B' in the body, in 1/time.

    Returns
    -------
    Clebsch
        Fields `H`, `F`, `MK`, `K2` and `energy`: floats or arrays, each rounded once from the exact state.

    Raises
    ------
    DomainError
        For a tensor that no body has.
    AtlasError
        For arrays of other shapes, and for an entry that is no number.

    Examples
    --------
    >>> atlas.clebsch((0.8, 1.0, 1.3), (0.0, 0.0, 2.0), (0.0, 0.0, 1.0)).energy
    2.6
    """
    spin, field = vectors(Omega, "Omega"), vectors(K, "K")
    common_shape(spin.shape, field.shape)
    return conserved([*body_tensor(inertia).flat], spin, field)


def conserved(J: Sequence[Any], Omega: FloatArray, K: FloatArray) -> Clebsch:
    """Return the integrals of states as `Clebsch`, floats or arrays, each rounded once.

    ``J`` are the nine entries of the inertia tensor row by row, numbers or arrays that broadcast with ``Omega`` and
    ``K`` (..., 3), both in the body and in 1/time.
    """
    unit = -int(np.frexp(max(np.abs(x).max(initial=0.0) for x in J))[1])
    inputs = (*(np.ldexp(x, unit) for x in J), *np.moveaxis(Omega, -1, 0), *np.moveaxis(K, -1, 0))
    integrals = over(formulas.clebsch, *inputs, unit=slice(9, None), degree=(2,) * 5)
    powers = (-1 - unit, -2 * unit, -unit, 0, -1 - unit)
    return Clebsch(*(plain(np.ldexp(x, power)) for x, power in zip(integrals, powers, strict=True)))


def body_tensor(inertia: Any) -> FloatArray:
    """Return the inertia tensor (3, 3), checked, of a tensor, principal moments (3,), a SymmetricBody or a ratio I3/I2.

    Of a ratio it is (1, 1, I). Raises DomainError for a tensor that no body has.
    """
    if isinstance(inertia, SymmetricBody) or not np.ndim(real(inertia, "The inertia tensor")):
        I2, I3 = map(float, moments_of_one(inertia))
        inertia = (I2, I2, I3)
    return inertia_tensor(inertia)
