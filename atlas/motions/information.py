"""Standard deviations of inputs that a measurement would have, from its Fisher matrix."""

from collections.abc import Sequence
from typing import Any, Literal

import numpy as np

from atlas.arithmetic.inputs import FloatArray

Reading = Literal["rotation", "axis", "angular_velocity"]

UNKNOWN = 1e-7
"""Singular value, beside the largest, below which a combination of inputs is not determined."""
SHARE = 1e-5
"""Share of an input in such a combination from which on the input is not determined."""
NUISANCES: dict[Reading, tuple[str, ...]] = {
    "rotation": ("a1", "a2", "a3"),
    "axis": ("a1", "a2"),
    "angular_velocity": (),
}
"""By the reading, inputs of the attitude at t = 0 that are found with the others."""


def expected_errors(motion: Any, names: Sequence[str], t: FloatArray, reading: Reading, sigma: float) -> FloatArray:
    """Return the standard deviations of inputs that a fit to readings of a motion would have.

    Parameters
    ----------
    motion : Motion
        Motion of `atlas.motion`, whose inputs have derivatives.
    names : sequence of str
        Inputs, as in `Motion.sensitivity`.
    t : ndarray, shape (n,)
        Times of the readings.
    reading : str
        "rotation", the attitude; "axis", the direction of the third axis; or "angular_velocity", along the body's axes.
    sigma : float
        Standard deviation of each component of a reading, in rad or in rad/time.

    Returns
    -------
    ndarray, shape (len(names),)
        Standard deviations, each in the unit of its input; inf for an input that the readings do not determine.

    Notes
    -----
    The Fisher matrix is J^T J / sigma^2 with the derivatives J of the readings. Rotations of R(0) are fitted along with
    the inputs: "a1" to "a3" for "rotation", "a1" and "a2" for "axis", none for "angular_velocity".
    """
    v = motion.sensitivity(t, [*names, *NUISANCES[reading]], "rotation" if reading == "axis" else reading)
    if reading == "axis":
        v = np.cross(v, motion.column(3, t)[:, None])
    J = np.moveaxis(v, 1, -1).reshape(3 * t.size, -1) / sigma
    scale = np.linalg.norm(J, axis=0)
    scale[scale == 0.0] = 1.0
    _, values, ways = np.linalg.svd(J / scale, full_matrices=False)
    is_known = values > UNKNOWN * values[0]
    spread = np.sqrt(np.sum((ways[is_known] / values[is_known, None]) ** 2, axis=0)) / scale
    spread[(np.abs(ways[~is_known]) > SHARE).any(axis=0)] = np.inf
    return np.asarray(spread[: len(names)])
