"""Inputs of a symmetric top in a uniform field, without its motion."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from flint import fmpq

from atlas.arithmetic.dimensions import ENERGY, INERTIA, MOMENTUM
from atlas.arithmetic.inputs import FloatArray, common_shape, components, number, plain
from atlas.arithmetic.numbers import as_rational, length, rational, workprec
from atlas.bodies.body import exact_moments
from atlas.bodies.formula_domain import check_direction, check_moments
from atlas.errors import DomainError

PARALLEL_TOLERANCE = 1e-14
"""Sine of the angle up to which a weight counts as parallel to the field."""


def inputs_of_top(inertia: Any, coupling: Any, direction: Any, linear: Any, quadratic: Any) -> list[FloatArray]:
    """Return [I2, I3, k2, k3, n2, n3, a0, A0] of tops, a list of arrays (or `Given`) that broadcast with each other.

    ``inertia`` is (I2, I3), ``coupling`` (k2, k3) in inertia/time, ``direction`` (n2, n3); a0 and A0 are ``linear`` and
    ``quadratic``, in inertia/time^2. Raises DomainError for moments that no body has and for a direction
    that is zero, AtlasError for an input that is no finite number.
    """
    columns = [
        *components(inertia, ("I2", "I3"), "The inertia", INERTIA),
        *components(coupling, ("k2", "k3"), "The coupling", MOMENTUM),
        *components(direction, ("n2", "n3"), "The direction"),
        *components((linear, quadratic), ("linear", "quadratic"), "The potential", ENERGY),
    ]
    common_shape(*(np.shape(x) for x in columns))
    I2, I3, _, _, n2, n3 = np.broadcast_arrays(*columns)[:6]
    check_moments(I2, I3)
    check_direction(n2, n3)
    return columns


def arguments_of(top: Sequence[Any]) -> dict[str, Any]:
    """Return by name the arguments of `inputs_of_top` from its result: inertia, coupling, direction, linear, quadratic.

    The first three are pairs; values are floats or arrays.
    """
    I2, I3, k2, k3, n2, n3, linear, quadratic = map(plain, top)
    return {
        "inertia": (I2, I3), "coupling": (k2, k3), "direction": (n2, n3), "linear": linear, "quadratic": quadratic,
    }  # fmt: skip


def moments_of_one(body: Any) -> tuple[Any, Any]:
    """Return I2 and I3 of one body without rounding: floats or `Given`. Raises AtlasError for an array of bodies."""
    I2, I3 = exact_moments(body)
    for I in (I2, I3):
        number(plain(I), "A moment of inertia of the body")
    return I2, I3


def signed_weight(field: tuple[float, float], weight: Any) -> fmpq:
    """Return |weight| with the sign of (weight, field), for a weight (w2, w3) parallel to the field (B2, B3).

    The result is a rational to 256 binary digits, in the unit of the weight, for a quantity of pint or astropy in SI.
    Raises DomainError where the weight is not parallel to the field.
    """
    w2, w3 = (number(x, "A component of the weight") for x in components(weight, ("w2", "w3"), "The weight", ENERGY))
    (B2, B3), size = field, float(np.hypot(w2, w3))
    if abs(w2 * B3 - w3 * B2) > PARALLEL_TOLERANCE * size * float(np.hypot(B2, B3)):
        raise DomainError(
            f"The weight {(w2, w3)} is not parallel to the field {field}: with two fixed directions the momentum along "
            "neither is constant, and the motion is not that of a top in one potential."
        )
    with workprec():
        exact = as_rational(length(rational(w2), rational(w3)))
    return exact if w2 * B2 + w3 * B3 >= 0 else -exact
