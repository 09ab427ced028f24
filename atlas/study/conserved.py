"""The integrals of any inertia tensor along a trajectory, in extended precision: theorem-clebsch."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from atlas.core.motions.clebsch import cofactors

Value = tuple[str, str, str, Any, Any]


def conserved(J: Any, Omega: Any, K: Any) -> Iterator[Value]:
    """Yield name, meaning, label, values and size (the sum of the sizes of its terms) of each integral.

    `J` (3, 3), `Omega` and `K` (..., 3) in the body.
    """
    W = Omega + K
    M = _times(J, W)
    pull, core = _times(J, K), _times(cofactors(J), K)
    kinetic, potential = _dot(M, W), _dot(K, pull)
    H = (kinetic + potential) / 2
    yield "H", "Hamiltonian in Larmor's frame", "theorem-lie-poisson", H, H
    yield "F", "Clebsch's integral", "theorem-clebsch", _dot(M, M) - _dot(K, core), _dot(M, M) + _dot(K, core)
    yield "(M,K)", "canonical momentum along the field", "theorem-lie-poisson", _dot(M, K), np.abs(M * K).sum(-1)


def _times(J: Any, v: Any) -> Any:
    return np.einsum("ij,...j->...i", J, v)


def _dot(a: Any, b: Any) -> Any:
    return (a * b).sum(-1)
