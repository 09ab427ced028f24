"""What a symmetric top in a uniform field is given by, without its motion."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from atlas.core.inputs import FloatArray, common_shape, plain
from atlas.core.motion import components
from atlas.core.quantities import ENERGY, INERTIA, MOMENTUM
from atlas.errors import DomainError


def given(inertia: Any, coupling: Any, direction: Any, linear: Any, quadratic: Any) -> list[FloatArray]:
    """Return I2, I3, k2, k3, n2, n3, a0, A0 of tops as arrays.

    Raises DomainError for moments that no body has and for a direction that is zero, AtlasError for what is no finite
    number.
    """
    parts = [
        *components(inertia, ("I2", "I3"), "The inertia", INERTIA),
        *components(coupling, ("k2", "k3"), "The coupling", MOMENTUM),
        *components(direction, ("n2", "n3"), "The direction"),
        *components((linear, quadratic), ("linear", "quadratic"), "The potential", ENERGY),
    ]
    common_shape(*(np.shape(x) for x in parts))
    I2, I3, _, _, n2, n3 = np.broadcast_arrays(*parts)[:6]
    wrong = ~((I3 > 0) & (I2 > 0) & (I3 <= 2 * I2))
    if wrong.any():
        raise DomainError(
            f"No body has I2 = {I2[wrong].flat[0]}, I3 = {I3[wrong].flat[0]}: both are positive and I3 is at most 2 I2."
        )
    if ((n2 == 0) & (n3 == 0)).any():
        raise DomainError("The direction (n2, n3) must not be the zero vector.")
    return parts


def arguments_of(top: Sequence[Any]) -> dict[str, Any]:
    """Return what `given` took, by name, from what it returns."""
    I2, I3, k2, k3, n2, n3, linear, quadratic = map(plain, top)
    return {
        "inertia": (I2, I3), "coupling": (k2, k3), "direction": (n2, n3), "linear": linear, "quadratic": quadratic,
    }  # fmt: skip
