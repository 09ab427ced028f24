"""Conserved quantities of a trajectory: the norm of its quaternion, orthogonality, the integrals of motion."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from itertools import islice
from typing import Any, TypeAlias

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.bodies import formula_integrals as formulas
from atlas.checking.headings import MATRIX, OMEGA, QUATERNION
from atlas.checking.truth import long
from atlas.motions.elementary.certified import ElementaryMotion
from atlas.motions.nutation.certified_general import GeneralMotion
from atlas.motions.nutation.certified_top import TopMotion


@dataclass(frozen=True)
class Drift:
    """Relative deviation of a conserved quantity from its initial value: the largest, its time, and the last.

    `name` is the symbol, `says` its meaning in words, `label` its equation; both deviations are magnitudes.
    """

    name: str
    says: str
    label: str
    worst: float
    worst_time: float
    last: float


Value: TypeAlias = tuple[str, str, str, Any, Any]
"""Of a conserved quantity: name, meaning, equation, values (m,), and the sum of the magnitudes of its terms."""

Deviation: TypeAlias = tuple[str, str, str, Any]
"""Of a conserved quantity: name, meaning, equation, and the deviation in each row (m,)."""


class Drifts:
    """Deviations of the conserved quantities that follow from the columns of a trajectory, block by block.

    Made from a function that maps a block of columns (m,) by name to tuples (name, meaning, equation, deviations (m,)).
    """

    def __init__(self, deviations: Callable[[Mapping[str, FloatArray]], Iterable[Deviation]]) -> None:
        self._deviations, self._drifts = deviations, dict[str, Drift]()

    def add(self, block: Mapping[str, FloatArray]) -> None:
        """Take a block of columns (m,) by name: update the largest deviation, its time, and the last deviation."""
        for name, says, label, deviations in self._deviations(block):
            size = np.abs(deviations)
            i = int(np.argmax(size))
            worst_row, time = float(size[i]), float(block["t"][i])
            drift = self._drifts.get(name)
            if drift is not None and drift.worst >= worst_row:
                worst_row, time = drift.worst, drift.worst_time
            self._drifts[name] = Drift(name, says, label, worst_row, time, float(size[-1]))

    def drifts(self) -> tuple[Drift, ...]:
        """Return a `Drift` for each conserved quantity that the blocks so far determine."""
        return tuple(self._drifts.values())


def of_motion(motion: ElementaryMotion | GeneralMotion, block: Mapping[str, FloatArray]) -> Iterable[Deviation]:
    """Yield (name, meaning, equation, deviations (m,)) for a motion of a symmetric body and a block of columns (m,).

    Deviations from the motion's exact values are relative to the sum of the magnitudes of the terms. First come the
    norm of the quaternion and the orthogonality of R, then the integrals of motion; those with the field need R,
    those with Omega its three components. Quantities that the columns do not determine are left out.
    """
    columns, R, Omega = _read(block)
    yield from _rigid(columns, R)
    I, B2, B3 = (long(x) for x in (motion.I, motion.B2, motion.B3))
    K = None if R is None else B2 * R[:, 1] + B3 * R[:, 2]
    for name, says, label, value, size in _integrals(motion, Omega, K):
        if name in motion.invariants:
            yield name, says, label, (value - long(motion.invariants[name])) / (long(size) or 1)
    if Omega is not None and K is not None:
        tensor = np.diag([np.longdouble(1), np.longdouble(1), I])
        spin = np.array([long(w) for w in motion.omega])
        start = conserved(tensor, spin, np.array([np.longdouble(0), B2, B3]))
        yield from islice(_against(conserved(tensor, Omega, K), start), 3)


def conserved(J: Any, Omega: Any, K: Any) -> Iterable[Value]:
    """Yield (name, meaning, equation, values, size) of five conserved quantities, for an inertia tensor J (3, 3).

    They are the Hamiltonian H in Larmor's frame, Clebsch's integral F, (M,K), K^2 and the kinetic energy T, as
    `atlas.clebsch` has them. Omega and K, the field in the body, have the shape (..., 3); M = J (Omega + K) is the
    canonical momentum; sizes are sums of the magnitudes of the terms.
    """
    M = (Omega + K) @ J
    H2, F, component, square, energy2 = formulas.clebsch(*J.flat, *np.moveaxis(Omega, -1, 0), *np.moveaxis(K, -1, 0))
    yield "H", "Hamiltonian in Larmor's frame", "theorem-lie-poisson", H2 / 2, H2 / 2
    yield "F", "Clebsch's integral", "theorem-clebsch", F, 2 * (M * M).sum(-1) - F
    yield "(M,K)", "canonical momentum along the field", "theorem-lie-poisson", component, np.abs(M * K).sum(-1)
    yield "K^2", "length of the field in the body, squared", "(37)", square, square
    yield "T", "kinetic energy", "theorem-kinetic-energy", energy2, energy2


class AnyBody:
    """Conserved quantities of a body of any inertia tensor (3, 3) in the field B' (3,): those of `conserved`.

    Deviations are from the values at `start`, a pair (Omega, K), else from the values in the first row of the file.
    Instances are functions of a block of columns.
    """

    def __init__(self, inertia: Any, field: Any, start: tuple[Any, Any] | None = None) -> None:
        self._J, self._field = np.asarray(inertia, dtype=np.longdouble), np.asarray(field, dtype=np.longdouble)
        self._start = start

    def __call__(self, block: Mapping[str, FloatArray]) -> Iterable[Deviation]:
        """Yield (name, meaning, equation, relative deviations (m,)) of a block; integrals only if it has R and Omega.

        Without `start` the first row of the first block becomes the start.
        """
        columns, R, Omega = _read(block)
        yield from _rigid(columns, R)
        if R is None or Omega is None:
            return
        K, J = self._field @ R, self._J
        if self._start is None:
            self._start = Omega[0], K[0]
        start, field = self._start
        yield from _against(conserved(J, Omega, K), conserved(J, start, field))


def of_top(motion: TopMotion, block: Mapping[str, FloatArray]) -> Iterable[Deviation]:
    """Yield (name, meaning, equation, relative deviations (m,)) of a top: norm, orthogonality, h, M3 and p.

    h is the energy, M3 and p the momenta along the axis and the field, all over I2; they need R, or a quaternion,
    and Omega among the columns of the block.
    """
    columns, R, Omega = _read(block)
    yield from _rigid(columns, R)
    if R is None or Omega is None:
        return
    I, k2, k3, a0, A0 = map(long, (motion.I, *motion.coupling, *motion.potential))
    n = np.array([long(x) for x in motion.field]) / long(motion.b)
    start = np.array([long(w) for w in motion.omega])
    yield from _against(*(_of_top(I, k2, k3, a0, A0, *state) for state in ((Omega, n @ R), (start, n))))


def _of_top(I: Any, k2: Any, k3: Any, a0: Any, A0: Any, Omega: Any, b: Any) -> Iterable[Value]:
    """Yield (name, meaning, equation, values, size) of a top's constants h, M3 and p, for Omega and b (..., 3).

    h is the energy, M3 and p are the momenta along the axis and the field, all over I2. Moments, couplings k2, k3 and
    potentials a0 (linear), A0 (quadratic) are divided by I2; b is the unit vector of the field in the body.
    """
    w, nu = np.moveaxis(Omega, -1, 0), b[..., 2]
    M = np.stack([w[0] + k2 * b[..., 0], w[1] + k2 * b[..., 1], I * w[2] + k3 * nu], axis=-1)
    kinetic = (w[0] ** 2 + w[1] ** 2 + I * w[2] ** 2) / 2
    h = kinetic + a0 * nu + A0 * nu * nu / 2
    yield "h", "energy over I2", "theorem-top", h, kinetic + abs(a0 * nu) + abs(A0) * nu * nu / 2
    yield "M3", "momentum along the axis, over I2", "theorem-top", M[..., 2], abs(I * w[2]) + abs(k3 * nu)
    yield "p", "momentum along n, over I2", "theorem-top", (M * b).sum(-1), np.abs(M * b).sum(-1)


def _read(block: Mapping[str, FloatArray]) -> tuple[dict[str, Any], Any, Any]:
    """Return (columns (m,) by name in extended precision, R (m, 3, 3), Omega (m, 3)) of a block of columns.

    R is None without all nine entries and without a quaternion, Omega without all three components.
    """
    columns = {name: values.astype(np.longdouble) for name, values in block.items()}
    R = _matrices(columns, len(block["t"]))
    return columns, R, np.stack([columns[name] for name in OMEGA], axis=-1) if set(OMEGA) <= set(columns) else None


def _rigid(columns: Mapping[str, Any], R: Any) -> Iterable[Deviation]:
    """Yield (name, meaning, equation, deviations (m,)) of the quaternion's norm and of R^T R, both from 1.

    `columns` are arrays (m,) by name, R is (m, 3, 3) or None. A quantity that they do not determine is left out; of
    R^T R the largest entry of the difference counts.
    """
    if QUATERNION[0] in columns:
        norm = np.sqrt(sum(columns[name] ** 2 for name in QUATERNION))
        yield "|q|", "norm of the quaternion", "(12)", norm - 1
    if R is not None:
        defect = np.abs(np.swapaxes(R, -1, -2) @ R - np.eye(3)).max(axis=(-1, -2))
        yield "R^T R", "orthogonality of R", "(12)", defect


def _against(values: Iterable[Value], start: Iterable[Value]) -> Iterable[Deviation]:
    """Yield (name, meaning, equation, (value - start)/size) for each pair of quantities in `values` and `start`.

    The size is that of the start; size 0 counts as 1.
    """
    for (name, says, label, value, _), (_, _, _, true, size) in zip(values, start, strict=True):
        yield name, says, label, (value - true) / (size or 1)


def _integrals(motion: ElementaryMotion | GeneralMotion, Omega: Any, K: Any) -> Iterable[Value]:
    """Yield (name, meaning, equation, values (m,), size) of the integrals that Omega and K (m, 3) determine.

    They are E', K^2, c3, c5 and (m,B') over I2, by (36), (37), (40), (41), (88). K is the field in the body; each of
    Omega and K may be None. Sizes are sums of the magnitudes of the terms at the start.
    """
    w, k = ([0, 0, 0] if x is None else list(np.moveaxis(x, -1, 0)) for x in (Omega, K))
    E, K2, c3, c5 = formulas.integrals(long(motion.I), w, k)
    I, B2, B3 = motion.I, abs(motion.B2), abs(motion.B3)
    w1, w2, w3 = (abs(w) for w in motion.omega)
    if Omega is not None:
        yield "E'", "energy 2 E/I2", "(36)", E, w1**2 + w2**2 + I * w3**2
    if K is not None:
        yield "K^2", "length of the field in the body, squared", "(37)", K2, B2**2 + B3**2
    if Omega is not None and K is not None:
        yield "c3", "K3 + Omega3", "(40)", c3, w3 + B3
        yield "c5", "the fourth integral", "(41)", c5, w2 * B2 + w3**2 + (2 - I) * (w3 + B3) * w3
        component = formulas.along_field(long(I), w, k)
        yield "(m,B')", "momentum along the field, over I2", "(88)", component, w2 * B2 + I * w3 * B3


def _matrices(columns: Mapping[str, Any], count: int) -> Any:
    """Return the matrices (count, 3, 3) of the columns R11 to R33, else of the quaternion, None without both.

    The quaternion is not normalised.
    """
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
