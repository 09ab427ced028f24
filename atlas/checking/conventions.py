"""Other conventions in which a trajectory that fails would be right: each is tried on some rows of the first block."""

import math
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.checking.headings import MATRIX, OMEGA, QUATERNION

if TYPE_CHECKING:
    from atlas.checking.grades import Errors

ROWS, LEAST = 24, 3
"""Approximate and least number of rows of the first block on which conventions are tried."""

SCALES = {"": 1.0, "in degrees per unit of time": 180 / math.pi, "in turns per unit of time": 1 / (2 * math.pi)}
"""Units of a rate, as sizes of one rad/time."""

CHANGE = 0.01
"""Change of R below which the rows do not distinguish conventions."""


def conventions_that_fit(block: Mapping[str, FloatArray], errors: "Errors", limit: float) -> list[str]:
    """Return sentences on conventions in which half of the rows have errors below `limit`; [] if none fits.

    `block` has the columns (m,) by name, `errors` the true motion. At most one sentence each for matrices,
    quaternion and rates, and none for data that agree as given. Tried are transposed matrices, conjugate and
    reordered quaternions, a constant rotation, and rates in the laboratory or in other units. Fewer than three rows
    give [].
    """
    rows = slice(None, None, max(1, len(block["t"]) // ROWS))
    if len(block["t"]) < LEAST:
        return []
    R, Omega = errors.true(block["t"][rows])
    x = {name: values[rows] for name, values in block.items()}
    sentences: list[str] = []
    if set(MATRIX) <= x.keys():
        M = np.stack([x[name] for name in MATRIX], axis=-1).reshape(-1, 3, 3)
        sentences += _of_attitudes(
            {"R": M, "R, transposed (R takes the body to the laboratory),": M.swapaxes(1, 2)}, R, limit
        )
    if QUATERNION[0] in x:
        sentences += _of_attitudes(dict(_of_quaternions(np.stack([x[name] for name in QUATERNION], axis=-1))), R, limit)
    if set(OMEGA) <= x.keys():
        sentences += _of_rates(np.stack([x[name] for name in OMEGA], axis=-1), R, Omega, limit)
    return sentences


def quaternion_readings(q: FloatArray) -> Iterator[tuple[str, FloatArray]]:
    """Yield six pairs (words, quaternions (N, 4)), scalar first, of components (N, 4) in an unknown order.

    The components are taken as given, and rolled by one place to either side, each also conjugate; "" are the words
    of the first.
    """
    conjugate = np.array([1.0, -1.0, -1.0, -1.0])
    orders = {"": 0, "with the scalar last": 1, "with the scalar first": -1}
    for order, places in orders.items():
        for inverse, factors in (("", 1.0), ("conjugate (it takes the body to the laboratory)", conjugate)):
            yield ", ".join(filter(None, [order, inverse])), np.roll(q, places, axis=-1) * factors


def _of_quaternions(q: FloatArray) -> Iterator[tuple[str, FloatArray]]:
    """Yield (words, rotation matrices (N, 3, 3)) for each of the six readings of quaternions q (N, 4).

    The readings are those of `quaternion_readings`: three orders of the components, each also conjugate. Quaternions
    of any length are normalised. If any quaternion is zero, nothing is yielded at all.
    """
    from scipy.spatial.transform import Rotation

    if (np.linalg.norm(q, axis=-1) > 0).all():
        for words, p in quaternion_readings(q):
            yield (
                f"the quaternion, {words}," if words else "the quaternion",
                Rotation.from_quat(p, scalar_first=True).as_matrix(),
            )


def _of_attitudes(readings: Mapping[str, FloatArray], R: FloatArray, limit: float) -> list[str]:
    """Return [sentence] on the first reading, matrices (N, 3, 3) by words, that equals R up to a constant rotation.

    R are the true matrices (N, 3, 3), `limit` is the largest median error of an entry. The first reading is the data as
    given. Returns [] if these agree, if R hardly changes, and if no reading fits.
    """
    if not readings or _median_error(next(iter(readings.values())), R) <= limit or _median_error(R, R[0]) < CHANGE:
        return []
    for words, M in readings.items():
        if _median_error(M, R) <= limit:
            return [f"{words} fits"]
    from scipy.spatial.transform import Rotation

    for words, M in readings.items():
        start = M[0] @ R[0].T
        if _median_error(start.T @ M, R) <= limit:
            x, y, z, w = Rotation.from_matrix(start).as_quat(canonical=True)
            start_of = f"--attitude {x:.9g} {y:.9g} {z:.9g} {w:.9g}"
            return [f"{words} fits turned in the laboratory: give {start_of}, and the field along those axes"]
        if _median_error(M @ (M[0].T @ R[0]), R) <= limit:
            return [f"{words} fits turned in the body: its axes are others than those of the moments of inertia"]
    return []


def _of_rates(rates: FloatArray, R: FloatArray, Omega: FloatArray, limit: float) -> list[str]:
    """Return [sentence] on the first frame and unit in which the rates (N, 3) equal Omega, (N, 3) in the body.

    `limit` is the largest median error, in units of the largest component. Returns [] if the rates agree as given, and
    if no frame and unit fits.
    """
    size = float(np.abs(Omega).max()) or 1.0
    if _median_error(rates / size, Omega / size) <= limit:
        return []
    for frame, true in (("", Omega), ("R Omega, in the laboratory", np.matvec(R, Omega))):
        for unit, scale in SCALES.items():
            if _median_error(rates / (scale * size), true / size) <= limit:
                return [f"Omega fits as {', '.join(filter(None, [frame, unit]))}"]
    return []


def _median_error(x: FloatArray, y: FloatArray) -> float:
    """Return the median over the rows of x, (N, ...), of the largest absolute difference from y in a row."""
    return float(np.median(np.abs(x - y).reshape(len(x), -1).max(-1)))
