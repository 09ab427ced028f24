"""The lattice of complex periods of a motion's torus, a symplectic basis of it, and its Riemann matrix.

Periods are triples T = (T_H, T_F, T_c) of times of the flows of H and F/2 and of the time T_c of the attitude, which
turns by -b T_c about the field. They come from integrals between zeros of eta, see
`atlas.motions.torus.approximate_periods`, and from relations with whole numbers that LLL finds, so nothing here is
proved. The polarization E is the alternating form with whole values that the bilinear relation singles out; that it is
of type (1,2) is the check that no period is missing: then

    E(a1, b1) = 1,    E(a2, b2) = 2,    0 for other pairs,    tau = X^-1 (b1 | b2),    X = (a1 | a2/2),

tau being symmetric with a positive imaginary part. Bases of that kind differ by moves that are Siegel's: they are made
until no single one makes det Im tau larger, so that theta series need few terms.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np
from flint import acb, acb_mat, arb, arb_mat, fmpq, fmpz_mat
from numpy.typing import NDArray

from atlas.arithmetic.numbers import workprec
from atlas.errors import NotCertifiedError
from atlas.motions.torus.approximate_periods import (
    BITS,
    PATHS_PER_ZERO,
    RELATION_BITS,
    Curve,
    Integrals,
    complex_of,
    generating,
    matrix_of,
    nearest,
    sums,
)

INTEGER_TOLERANCE = 1e-9
"""Largest distance from an integer of a coefficient of a conjugate period."""

MAX_PATHS_PER_ZERO, MIN_PATHS = 8, 4
"""Paths for each zero where fewer do not give all periods, and the fewest that may."""

MAX_PATH_PARTS = 100
"""Number of parts of all paths at which the search for paths ends, for time."""

AREA_BITS, AREA_INTEGER_BITS = 160, 8
"""Bits of areas in the search for the polarization, and of an integer there: near symmetry its values are large."""

NEARLY_A_BALL = fmpq(1, 2**27)
"""Relative spread of moments below which no lattice was found in any motion that was tried: the slowest period goes as
the inverse of the spread."""

MAX_REDUCTIONS = 60
"""Rounds of Siegel's reduction at most."""

Whole = NDArray[np.int64]
PAIRS = tuple(combinations(range(4), 2))


@dataclass(frozen=True)
class Lattice:
    """Periods of the torus, each a list [T_H, T_F, T_c] of complex balls, T_F in time/inertia; nothing is proved.

    `real` are two that generate the real periods, `other_periods` two that complete them to a basis of all. The
    symplectic basis is (a1, a2, b1, b2); `a` holds the first two, `b` the others. T_H and T_c are in the unit of
    time; in a period the attitude turns about the field by the angle -b T_c, b = |B'|. `paths` are triples (start
    u, stop u, T_H) of the paths that were integrated, and `weights` four rows of integers, by which their integrals
    sum to a1, a2, b1, b2.
    """

    real: tuple[list[acb], list[acb]]
    other_periods: tuple[list[acb], list[acb]]
    a: tuple[list[acb], list[acb]]
    b: tuple[list[acb], list[acb]]
    paths: tuple[tuple[acb, acb, acb], ...] = ()
    """Ends of the paths whose integrals the periods are sums of, each with its T_H, which tells its sign; and the whole
    weights of a1, a2, b1 and b2."""
    weights: tuple[tuple[int, ...], ...] = ()

    @property
    def X(self) -> acb_mat:
        """Period matrix (2, 2): columns are the cycles a1 and a2/2, rows T_H in time and T_F in time/inertia."""
        (p, q, _), (r, s, _) = self.a
        return acb_mat([[p, r / 2], [q, s / 2]])

    @property
    def tau(self) -> acb_mat:
        """Riemann matrix X^-1 (b1 | b2), (2, 2) without unit, its off-diagonal entries replaced by their mean."""
        (p, q, _), (r, s, _) = self.b
        tau = self.X.solve(acb_mat([[p, r], [q, s]]))
        off_diagonal = (tau[0, 1] + tau[1, 0]) / 2
        return acb_mat([[tau[0, 0], off_diagonal], [off_diagonal, tau[1, 1]]])


def lattice(motion: Integrals) -> Lattice:
    """Return the periods of a motion's torus as a `Lattice`, computed along paths with `BITS` digits, not proved.

    ``motion`` are the `Integrals` of the motion. Raises NotCertifiedError for three moments that are nearly
    equal (`NEARLY_A_BALL`), and where periods cannot be distinguished.
    """
    if max(motion.moments) - min(motion.moments) < NEARLY_A_BALL * max(motion.moments):
        raise NotCertifiedError("not certified: the body is so nearly a ball that its slowest period is not found.")
    with workprec(BITS):
        curve = Curve(motion)
        try:
            return _of_paths(curve, PATHS_PER_ZERO)
        except NotCertifiedError:
            if sum(len(list(curve.intervals(*path))) for path in curve.paths(PATHS_PER_ZERO)) > MAX_PATH_PARTS:
                raise
            return _of_paths(curve, MAX_PATHS_PER_ZERO)


def _of_paths(curve: Curve, paths_per_zero: int) -> Lattice:
    """Return the `Lattice` that integrals along paths of a ``curve`` generate, with as few paths as possible.

    The best come first; for ``paths_per_zero`` see `Curve.paths`. Raises NotCertifiedError, with the last reason,
    if all paths do not suffice.
    """
    ways, why, paths = list[list[acb]](), "no paths between zeros were found.", curve.paths(paths_per_zero)
    for path in paths:
        ways.append(list(curve.integrals(*path)))
        if len(ways) >= MIN_PATHS:
            try:
                gone = zip(paths, ways, strict=False)
                return replace(_of_ways(ways), paths=tuple((*ends, way[0]) for ends, way in gone))
            except NotCertifiedError as reason:
                why = str(reason).removeprefix("not certified: ")
    raise NotCertifiedError(f"not certified: {why}")


def _of_ways(ways: list[list[acb]]) -> Lattice:
    """Return the `Lattice` that the integrals ``ways``, [T_H, T_F, T_c] along paths, generate.

    The ends of the paths are not stored. Raises NotCertifiedError unless they generate four periods with a
    polarization of type (1, 2).
    """
    weights = generating([_real(way) for way in ways])
    periods = sums(ways, weights)
    if len(periods) != 4:
        raise NotCertifiedError(f"not certified: {len(periods)} periods of the motion's torus were found, not four.")
    real = _real_first(_conjugation(periods))
    periods = sums(periods, real)
    basis = _reduced(periods, _symplectic(_polarization(periods)))
    of_paths = sums(sums(weights, real), basis.tolist())
    a1, a2, b1, b2 = sums(periods, basis.tolist())
    a_period, second = sums(periods[:2], _shortest(periods, basis))
    other_periods, integers = (periods[2], periods[3]), tuple(tuple(row) for row in of_paths)
    return Lattice((a_period, second), other_periods, (a1, a2), (b1, b2), weights=integers)


def _real(period: Sequence[acb]) -> list[arb]:
    """Return [Re T_H, Im T_H, Re T_F, Im T_F] of a period [T_H, T_F, T_c], four balls in the units of `Lattice`."""
    return [period[0].real, period[0].imag, period[1].real, period[1].imag]


def _conjugation(periods: Sequence[Sequence[acb]]) -> Whole:
    """Return the array (4, 4) of integers whose rows give the complex conjugates of four periods in terms of them.

    Raises NotCertifiedError if the periods are dependent, or the matrix is not integer within a tolerance.
    """
    rows = arb_mat([_real(x) for x in periods])
    conjugate = arb_mat([[x, -y, z, -w] for x, y, z, w in (_real(p) for p in periods)])
    try:
        conjugation = conjugate * rows.inv()
    except ZeroDivisionError as error:
        raise NotCertifiedError(
            "not certified: the periods found for the motion's torus depend on one another."
        ) from error
    integers = np.array([[round(float(conjugation[i, j].mid())) for j in range(4)] for i in range(4)])
    if not all(
        abs(float(conjugation[i, j].mid()) - integers[i, j]) < INTEGER_TOLERANCE for i in range(4) for j in range(4)
    ):
        raise NotCertifiedError(
            "not certified: the periods found for the motion's torus are no lattice with conjugates."
        )
    return integers


def _real_first(conjugation: Whole) -> list[list[int]]:
    """Return a list of four integer rows: a basis of the lattice whose first two rows span the real periods.

    ``conjugation`` is that of `_conjugation`. Raises NotCertifiedError unless there are two real periods.
    """
    rows = [
        [*(int(x) << RELATION_BITS for x in row), *(int(i == j) for j in range(4))]
        for i, row in enumerate(conjugation - np.eye(4, dtype=int))
    ]
    reduced = [[int(x) for x in row] for row in fmpz_mat(rows).lll().tolist()]
    real = [row[4:] for row in reduced if not any(row[:4])]
    if len(real) != 2:
        raise NotCertifiedError(f"not certified: the motion's torus has {len(real)} real periods, not two.")
    return real + [row[4:] for row in reduced if any(row[:4])]


def _shortest(periods: Sequence[Sequence[acb]], basis: Whole) -> list[list[int]]:
    """Return integer weights, two rows of two, of the two real periods that make them short and f1, f2 positive.

    The first two of the four ``periods`` are the real ones; ``basis`` (4, 4) is symplectic, in integer rows. It is
    Gauss's reduction by Riemann's form zeta* (Im tau)^-1 zeta; f1, f2 are the frequencies.
    """
    vectors = matrix_of(acb_mat(periods))[:, :2]
    a1, a2, _, _ = basis @ vectors
    zeta = np.linalg.solve(np.array([a1, a2 / 2]).T, vectors[:2].T)
    gram = (zeta.conj().T @ np.linalg.solve(_riemann(vectors, basis).imag, zeta)).real
    rows = np.eye(2, dtype=int)
    for _ in range(MAX_REDUCTIONS):
        (square, product), (_, second) = rows @ gram @ rows.T
        if second < square:
            rows = rows[::-1]
        elif n := round(float(product / square)):
            rows = np.array([rows[0], rows[1] - n * rows[0]])
        else:
            break
    # (f1, f2) is 2 pi times the first row of the inverse of the two periods, each of them (T_H, T_F) as a row
    signs = np.where(np.linalg.inv(rows @ vectors[:2].real)[0] < 0, -1, 1)
    return [[int(n * sign) for n in row] for row, sign in zip(rows, signs, strict=True)]


def _polarization(periods: Sequence[Sequence[acb]]) -> Whole:
    """Return the alternating form E of four ``periods`` [T_H, T_F, T_c], an array (4, 4) of integers E[i, j].

    Its sign is left open: `_reduced` chooses the basis for which Im tau is positive. Raises NotCertifiedError unless a
    form of type (1, 2) is found.
    """
    areas = [periods[i][0] * periods[j][1] - periods[i][1] * periods[j][0] for i, j in PAIRS]
    size = max(abs(complex_of(x)) for x in areas)
    rows = [
        [
            *(nearest(y / size * arb(2) ** AREA_BITS) for y in (x.real, x.imag)),
            *(int(i == j) << AREA_INTEGER_BITS for j in range(6)),
        ]
        for i, x in enumerate(areas)
    ]
    for row in fmpz_mat(rows).lll().tolist():
        integers = [int(x) >> AREA_INTEGER_BITS for x in row[2:]]
        n = dict(zip(PAIRS, integers, strict=True))
        pfaffian = n[0, 1] * n[2, 3] - n[0, 2] * n[1, 3] + n[0, 3] * n[1, 2]
        if max(abs(int(x)) for x in row[:2]) > 1 << AREA_BITS // 2 or abs(pfaffian) != 2:
            continue
        form = np.zeros((4, 4), dtype=int)
        for (i, j), sign in zip(PAIRS, (1, -1, 1, 1, -1, 1), strict=True):
            complement = [k for k in range(4) if k not in (i, j)]
            form[i, j] = sign * n[complement[0], complement[1]]
        return np.array(form - form.T)
    raise NotCertifiedError(
        "not certified: the periods found for the motion's torus have no polarization of type (1,2)."
    )


def _symplectic(form: Whole) -> Whole:
    """Return the array (4, 4) of integer rows a1, a2, b1, b2, in which an alternating ``form`` (4, 4) has type (1, 2).

    The method is that of Frobenius.
    """
    rows, chosen = np.eye(4, dtype=int), list[tuple[Whole, Whole]]()
    while len(rows):
        E = rows @ form @ rows.T
        places = [(abs(int(E[i, j])), i, j) for i, j in combinations(range(len(rows)), 2) if E[i, j]]
        size, i, j = min(places)
        a_period, second = (rows[i], rows[j]) if E[i, j] > 0 else (rows[j], rows[i])
        remaining_rows = [row for k, row in enumerate(rows) if k not in (i, j)]
        # remainders of the others modulo the smallest value are smaller, and taken next
        less = [
            row - (row @ form @ second) // size * a_period + (row @ form @ a_period) // size * second
            for row in remaining_rows
        ]
        if any((row @ form @ second) % size or (row @ form @ a_period) % size for row in remaining_rows):
            rows = np.array([a_period, second, *less])
            continue
        chosen.append((a_period, second))
        rows = np.array(less).reshape(-1, 4)
    if chosen[0][0] @ form @ chosen[0][1] == 2:
        chosen.reverse()
    (a1, b1), (a2, b2) = chosen
    return np.array([a1, a2, b1, b2])


def _reduced(periods: Sequence[Sequence[acb]], basis: Whole) -> Whole:
    """Return a symplectic basis, an array (4, 4) of integer rows, for which no single move makes det Im tau larger.

    ``basis`` is the one to begin with, in terms of the four ``periods``; tau is the Riemann matrix.
    """
    vectors = matrix_of(acb_mat(periods))[:, :2]
    if _riemann(vectors, basis)[0, 0].imag < 0:
        basis = basis * np.array([[1], [1], [-1], [-1]])
    for _ in range(MAX_REDUCTIONS):
        basis = _shifted(vectors, _minkowski(vectors, basis))
        tau = _riemann(vectors, basis)
        sizes = abs(tau[0, 0]), abs(tau[1, 1]) / 2
        k = int(np.argmin(sizes))
        if not sizes[k] < 1 - 2.0**-20:
            break
        basis = basis.copy()
        basis[k], basis[k + 2] = basis[k + 2].copy(), -basis[k]
    return basis


def _riemann(vectors: NDArray[np.complex128], basis: Whole) -> NDArray[np.complex128]:
    """Return the Riemann matrix tau (2, 2) of a basis, integer rows.

    ``vectors`` (4, 2) are the periods' T_H and T_F.
    """
    a1, a2, b1, b2 = basis @ vectors
    return np.asarray(np.linalg.solve(np.array([a1, a2 / 2]).T, np.array([b1, b2]).T))


def _minkowski(vectors: NDArray[np.complex128], basis: Whole) -> Whole:
    """Return the symplectic ``basis`` (4, 4), integer rows in terms of the periods ``vectors``, with a small Im tau_12.

    The rows are a1, a2, b1, b2; the columns of ``vectors`` (4, 2) are T_H and T_F. At most MAX_REDUCTIONS single moves
    lead to the new basis; the given array is not changed.
    """
    for _ in range(MAX_REDUCTIONS):
        Y = _riemann(vectors, basis).imag
        a1, a2, b1, b2 = basis
        # b1 -> b1 - k b2 goes with a2 -> a2 + 2 k a1, and b2 -> b2 - 2 k b1 with a1 -> a1 + k a2
        k, m = round(Y[0, 1] / Y[1, 1]), round(Y[0, 1] / (2 * Y[0, 0]))
        if m:
            basis = np.array([a1 + m * a2, a2, b1, b2 - 2 * m * b1])
        elif k:
            basis = np.array([a1, a2 + 2 * k * a1, b1 - k * b2, b2])
        else:
            break
    return basis


def _shifted(vectors: NDArray[np.complex128], basis: Whole) -> Whole:
    """Return the symplectic basis (4, 4) with b1 and b2 shifted by a1 and a2 so that Re tau is small.

    ``vectors`` (4, 2) are the periods' T_H and T_F, ``basis`` has integer rows.
    """
    tau = _riemann(vectors, basis).real
    a1, a2, b1, b2 = basis
    x, y, z = round(tau[0, 0]), round(tau[0, 1] / 2), round(tau[1, 1] / 2)
    return np.array([a1, a2, b1 - x * a1 - y * a2, b2 - 2 * y * a1 - z * a2])
