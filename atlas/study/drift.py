"""What a trajectory should conserve: the norm of its quaternion, orthogonality, the integrals of motion."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from flint import fmpq

from atlas.exact.elementary import ElementaryMotion
from atlas.study.trajectory import MATRIX, OMEGA, QUATERNION, Trajectory


@dataclass(frozen=True)
class Drift:
    """How far something that must not change leaves its true value: the largest relative deviation, and the last."""

    name: str
    says: str
    label: str
    worst: float
    worst_time: float
    last: float


def drifts_of(trajectory: Trajectory, motion: ElementaryMotion) -> Iterable[Drift]:
    """Yield what the columns allow to test: orthogonality, the norm, and the integrals of motion."""
    columns = {name: np.array(values, dtype=np.longdouble) for name, values in trajectory.columns.items()}
    count = len(trajectory.times)
    R = _matrices(columns, count)
    Omega = np.stack([columns[name] for name in OMEGA], axis=-1) if set(OMEGA) <= set(columns) else None
    if QUATERNION[0] in columns:
        norm = np.sqrt(sum(columns[name] ** 2 for name in QUATERNION))
        yield _drift("|q|", "norm of the quaternion", "mf21", norm - 1, trajectory)
    if R is not None:
        defect = np.abs(np.swapaxes(R, -1, -2) @ R - np.eye(3)).max(axis=(-1, -2))
        yield _drift("R^T R", "orthogonality of R", "mf21", defect, trajectory)
    I, B2, B3 = (_number(x) for x in (motion.I, motion.B2, motion.B3))
    K = None if R is None else B2 * R[:, 1] + B3 * R[:, 2]
    for name, says, label, value in _integrals(I, Omega, K):
        true = motion.invariants[name]
        scale = _scales(motion)[name]
        yield _drift(name, says, label, (value - _number(true)) / (_number(scale) or 1), trajectory)


def _integrals(I: Any, Omega: Any, K: Any) -> Iterable[tuple[str, str, str, Any]]:
    """Yield the integrals of motion that Omega and K determine."""
    if Omega is not None:
        yield "E'", "energy 2 E/I2", "mf44", Omega[:, 0] ** 2 + Omega[:, 1] ** 2 + I * Omega[:, 2] ** 2
    if K is not None:
        yield "K^2", "length of the field in the body, squared", "mf45", (K**2).sum(-1)
    if Omega is not None and K is not None:
        u, c3 = Omega[:, 2], K[:, 2] + Omega[:, 2]
        across = Omega[:, 0] * K[:, 0] + Omega[:, 1] * K[:, 1]
        yield "c3", "K3 + Omega3", "mf48", c3
        yield "c5", "the fourth integral", "mf49", across - u**2 + (2 - I) * c3 * u
        yield "(m,B')", "momentum along the field, over I2", "mf93", across + I * u * K[:, 2]


def _scales(motion: ElementaryMotion) -> dict[str, fmpq]:
    """Return the size of each integral: the sum of the absolute values of its terms."""
    I, B2, B3, w2, w3 = motion.I, abs(motion.B2), abs(motion.B3), abs(motion.omega2), abs(motion.omega3)
    return {
        "E'": w2**2 + I * w3**2,
        "K^2": B2**2 + B3**2,
        "c3": w3 + B3,
        "c5": w2 * B2 + w3**2 + (2 - I) * (w3 + B3) * w3,
        "(m,B')": w2 * B2 + I * w3 * B3,
    }


def _matrices(columns: Mapping[str, Any], count: int) -> Any:
    """Return the matrices (N, 3, 3) of the columns R11 to R33, else of the quaternion, else None."""
    if set(MATRIX) <= set(columns):
        return np.stack([columns[name] for name in MATRIX], axis=-1).reshape(count, 3, 3)
    if QUATERNION[0] not in columns:
        return None
    w, x, y, z = (columns[name] for name in QUATERNION)
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return np.moveaxis(np.array(rows), -1, 0)


def _drift(name: str, says: str, label: str, deviations: Any, trajectory: Trajectory) -> Drift:
    size = np.abs(deviations)
    worst = int(np.argmax(size))
    return Drift(name, says, label, float(size[worst]), trajectory.times[worst], float(size[-1]))


def _number(value: fmpq) -> np.longdouble:
    """Return a rational in extended precision."""
    head = int(value.p) / int(value.q)
    rest = value - fmpq(*head.as_integer_ratio())
    return np.longdouble(head) + np.longdouble(int(rest.p) / int(rest.q))
