"""Derivatives of a motion of one nutation in its inputs: the vector v in the laboratory, dR/dp = [v]x R, and dv/dt.

Every motion of one nutation is R = exp(lambda t n) S(s) exp(sigma t e3), s = t + origin less whole periods T, so

    v = t lambda_p n + t sigma_p R e3 + (origin_p - count T_p) v_s + (bounded and periodic terms).

Whatever grows with time is in three derivatives of frequencies, which `atlas.motions.nutation.certified_derivatives`
makes in balls with all other constants; v_s and the bounded part are those of the pair (alpha, beta) at a fixed place s
in the period.
"""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from flint import acb

from atlas.arithmetic.inputs import FloatArray
from atlas.arithmetic.lazy import cached_property
from atlas.errors import DomainError
from atlas.motions.nutation.certified_derivatives import Variation
from atlas.motions.nutation.certified_differences import Differences
from atlas.motions.nutation.derivatives_pair import Array, VariedPair

BLOCK = 2048
"""Times at once: products of so few the library does not thread."""

LARGE_TERM, LOST_TERM = 256.0, 4096.0
"""Sizes of terms in v, beside 1 and beside 1 + |v|, from which they may cancel, and from which they do too much."""

LOST_TERM_OF_FITS = 2.0**26
"""The latter size where eight digits are enough."""


class Weighted:
    """v of N combinations of a pair's P inputs: sums of functions of time with constant weights.

    dR/dp = [v]x R for a combination p. In the frame whose third axis is the field, v has the component Im(a_p u* +
    b_p w*) along the third axis and b_p x - a_p y, the first component plus i times the second, across. a and b are
    alpha and beta without their phases, a_p and b_p their derivatives, u = 2 a/(|a|^2 + |b|^2), w = 2 b/(|a|^2 +
    |b|^2), x and y are u and w times exp(i f), f the sum of both phases. `to_lab` (3, 3) takes vectors into the
    laboratory, `input_weights` (N, P) are the weights of the inputs. Besides, p turns the body about axes of the
    laboratory by `turns` (N, 3) and about its own axis by `spins` (N,), in rad per unit of p.
    """

    def __init__(
        self, pair: VariedPair, to_lab: FloatArray, input_weights: FloatArray, turns: FloatArray, spins: FloatArray
    ) -> None:
        self.pair, self.axes, self.input_weights = pair, to_lab @ pair.axes, input_weights
        self.tables = []
        for i, table in enumerate(pair.tables):
            rows = np.concatenate([table[:2], input_weights @ table[2:]])
            sloped = np.array([rows, pair.slope(rows, i)])
            self.tables.append(np.stack([sloped.real, sloped.imag], 1))
        (twist_a, twist_b), turning, spun = (pair.twisting, pair.turning @ to_lab.T, np.outer(spins, np.eye(7)[3]))
        columns = np.column_stack(
            [
                pair.faster,
                -pair.cells,
                pair.rates[:, 1],
                pair.chi,
                twist_a - twist_b,
                pair.rates[:, 0],
                twist_a + twist_b,
            ]
        )
        self.fixed, combined = input_weights @ turning + turns, input_weights @ columns + spun
        self.columns = np.array([np.column_stack([combined, x]) for x in self.fixed.T])
        # of terms before they are combined, where cancellation may happen
        sizes, fixed = abs(input_weights), (abs(input_weights) @ abs(turning) + abs(turns)).max(1)
        self.sizes = np.column_stack([sizes @ abs(columns) + abs(spun), fixed])
        self.weights = [sizes @ (abs(x[2:].real) + abs(x[2:].imag)) for x in pair.tables]
        sizes = sum(x.sum(1) for x in self.weights) + self.sizes[:, 3::4].max(1)
        self.cancels = pair.hyperbolic or not (sizes < LARGE_TERM).all()

    def at(self, t: FloatArray, slopes: bool) -> tuple[list[FloatArray], Any]:
        """Return ([v] or [v, dv/dt] if ``slopes``, sizes of v's terms) at times t (m,).

        v is (3, N, m), in the laboratory, in rad per unit of the combination; sizes are (N, m), or 0.0 if no terms
        cancel.
        """
        pair = self.pair
        turn, s, count = pair.places(t)
        f, levels = self._functions(s), range(1 + slopes)
        # by level, part, row and time: a, its slope, its derivatives
        A, B = (np.matmul(x[: 1 + slopes], y) for x, y in zip(self.tables, f, strict=True))
        a, b = (x[:, 0, 0] + 1j * x[:, 1, 0] for x in (A, B))
        square = (a[0] * a[0].conj() + b[0] * b[0].conj()).real
        ways, axis, nu = self._directions(a, b, square, turn + pair.twist * s)
        derivatives = [np.array([x[i, j] for x in (A, B) for j in range(2)]) for i in levels]
        by_s = [self._sum(ways, derivatives, i, slice(1, 2))[:, 0] for i in levels]
        basis = [self._basis(t, s, count, by_s, axis, i) for i in levels]
        vectors = [np.matmul(self.columns, x) for x in basis]
        for i in levels:
            vectors[i] += self._sum(ways, derivatives, i, slice(2, None))
        if pair.swing:
            change = pair.swing.change(self.input_weights, s, count)
            for i in levels:
                vectors[i] += axis[i][:, None] * change
            if slopes:
                normal = np.cross(axis[0], self.axes[:, 2:], axis=0)
                changes = ((vectors[0] - self.fixed.T[:, :, None]) * normal[:, None]).sum(0)
                vectors[1] += axis[0][:, None] * pair.swing.slopes(self.input_weights, nu, changes)
        basis_size = abs(basis[0]).max(0)
        if not self.cancels and (self.sizes @ basis_size.max(1)).max() < LOST_TERM:
            return vectors, 0.0
        terms = sum(x @ abs(y) for x, y in zip(self.weights, f, strict=True)) * 2 / np.sqrt(square)
        return vectors, terms + self.sizes @ basis_size

    def _functions(self, s: FloatArray) -> list[FloatArray]:
        """Return the functions of time of alpha and of beta at times s (m,) in the period, two arrays (rows, m)."""
        doubled, counts = self.pair.doubled, [len(x) for x in self.pair.frequencies]
        if doubled[0] == doubled[1]:
            f = [self.pair.functions(s, doubled[0], max(counts))] * 2
        else:
            f = [self.pair.functions(s, x, n) for x, n in zip(doubled, counts, strict=False)]
        return [x[: 2 * n] for x, n in zip(f, counts, strict=True)]

    def _directions(
        self, a: Array, b: Array, square: FloatArray, angle: FloatArray
    ) -> tuple[list[FloatArray], list[FloatArray], FloatArray]:
        """Return (ways, axes, nu) at m times: the directions by which derivatives of alpha and beta move the body.

        ``ways`` (3, 4, m) are those of `_ways`, ``axes`` (3, m) the unit vector of the body's axis in the
        laboratory, nu (m,) its cosine to the frame's third axis. The first two are lists of one item, or of two if
        ``a`` and ``b`` (alpha and beta, (levels, m)) have slopes: then the second is the derivative by time.
        ``square`` is |a|^2 + |b|^2, ``angle`` that of the frame in rad.
        """
        phase = np.empty(angle.size, complex)
        phase.real, phase.imag = np.cos(angle), np.sin(angle)
        u, w = ([2 / square * x] for x in (a[0], b[0]))
        e, nu = [-1j * (u[0] * phase) * b[0]], [(a[0] * u[0].conj() - b[0] * w[0].conj()).real / 2]
        p, q = [u[0] * phase], [w[0] * phase]
        if len(a) > 1:
            less = (a[1] * u[0].conj() + b[1] * w[0].conj()).real
            by = 1j * self.pair.frame - less
            e.append(by * e[0] - 1j * (a[1] * q[0] + p[0] * b[1]))
            nu.append((a[1] * u[0].conj() - b[1] * w[0].conj()).real - less * nu[0])
            p.append(by * p[0] + 2 / square * a[1] * phase)
            q.append(by * q[0] + 2 / square * b[1] * phase)
            for x, y in ((u, a), (w, b)):
                x.append(2 / square * y[1] - less * x[0])
        ways = [self._ways(*x) for x in zip(p, q, u, w, strict=True)]
        return ways, [self.axes @ np.array([x.real, x.imag, y]) for x, y in zip(e, nu, strict=True)], nu[0]

    def _ways(self, p: Array, q: Array, u: Array, w: Array) -> FloatArray:
        """Return the factors (3, 4, m) of v, in the laboratory, for Re a_p, Im a_p, Re b_p and Im b_p.

        u and w are the arrays (m,) of the class, p and q its x and y, a_p and b_p the derivatives of alpha and beta.
        """
        ways = np.array([
            [-q.real, q.imag, p.real, -p.imag],
            [-q.imag, -q.real, p.imag, p.real],
            [-u.imag, u.real, -w.imag, w.real],
        ])  # fmt: skip
        return np.asarray(np.matmul(self.axes, ways.reshape(3, -1)).reshape(ways.shape))

    @staticmethod
    def _sum(ways: Sequence[FloatArray], factors: Sequence[FloatArray], level: int, rows: slice) -> FloatArray:
        """Return the terms of v (``level`` 0) or of dv/dt (1) from ``rows`` of the derivatives, shape (3, rows, m).

        ``ways`` are those of `_directions`; ``factors`` has, by level, the real and imaginary parts of a_p and b_p,
        (4, all rows, m).
        """
        pairs = [(ways[i], factors[level - i][:, rows]) for i in range(level + 1)]
        terms = [(way[:, j, None], derivative[j]) for way, derivative in pairs for j in range(4)]
        total = np.multiply(*terms[0])
        product = np.empty_like(total)
        for way, derivative in terms[1:]:
            total += np.multiply(way, derivative, out=product)
        return np.asarray(total)

    def _basis(
        self, t: FloatArray, s: FloatArray, count: FloatArray, by_s: Sequence[FloatArray], axis: Sequence[FloatArray],
        level: int,
    ) -> FloatArray:  # fmt: skip
        """Return the functions of time that `columns` weigh (``level`` 0), or their slopes (1), shape (3, 8, m).

        t are the times, s those in the period and ``count`` the whole periods, (m,) each; ``by_s`` has the vector
        v_s with dR/ds = [v_s]x R, ``axis`` the body's axis in the laboratory, (3, m) each, by level.
        """
        (v, e), n = (by_s[level], axis[level]), self.axes[:, 2:]
        basis = np.empty((3, 8, t.size))
        basis[:, 0], basis[:, 1], basis[:, 2], basis[:, 3], basis[:, 4] = s * v, count * v, t * e, e, s * e
        basis[:, 5], basis[:, 6], basis[:, 7] = (n, n, 0.0) if level else (n * t, n * s, 1.0)
        if level:
            basis[:, 0] += by_s[0]
            basis[:, 2] += axis[0]
            basis[:, 4] += axis[0]
        return basis


class Varied:
    """Derivatives of one motion in several inputs, from ``variations``, a `Variation` for each input.

    Inputs with equal constants are evaluated together. Where the constants have no derivatives (an empty list), or
    terms cancel, differences of the motion in balls, made by ``differences()``, replace them.
    """

    def __init__(self, variations: Sequence[Variation], differences: Callable[[], Differences]) -> None:
        self.pairs = [(group, VariedPair([variations[i] for i in group])) for group in _alike(variations)]
        self._make = differences

    @cached_property
    def differences(self) -> Differences:
        """The `Differences` of this motion, made once: derivatives in its inputs at single times."""
        return self._make()

    def weighted(
        self, to_lab: FloatArray, input_weights: FloatArray, turns: FloatArray, spins: FloatArray
    ) -> list[Weighted]:
        """Return the `Weighted` evaluators of N combinations of inputs, one for each group; v is the sum of all.

        ``to_lab``, ``input_weights``, ``turns`` and ``spins`` are those of `Weighted`; the list is empty where the
        constants have no derivatives.
        """
        weighted: list[Weighted] = []
        for group, pair in self.pairs:
            share = 0 if weighted else 1
            weighted.append(Weighted(pair, to_lab, input_weights[:, group], share * turns, share * spins))
        return weighted

    def vectors(
        self, t: FloatArray, slopes: bool, to_lab: FloatArray, input_weights: FloatArray, turns: FloatArray,
        spins: FloatArray,
        combinations: list[Weighted], *, certified: bool,
    ) -> list[FloatArray]:  # fmt: skip
        """Return [v], or [v, R dOmega/dp] if ``slopes``, of N combinations of inputs at times t (m,), (m, N, 3) each.

        They are in the laboratory. ``to_lab``, ``input_weights``, ``turns`` and ``spins`` are those of `Weighted`, and
        ``combinations`` is the list that `weighted` makes of them. Raises DomainError at a time where the motion is
        too near a special case, and, unless ``certified``, where fewer than eight digits remain.
        """
        out = [np.empty((t.size, len(input_weights), 3)) for _ in range(1 + slopes)]
        for i in range(0, t.size, BLOCK):
            block = slice(i, i + BLOCK)
            terms: Any = 0.0 if combinations else np.nan
            for n, combination in enumerate(combinations):
                values, sizes = combination.at(t[block], slopes)
                terms = terms + sizes
                for x, y in zip(out, values, strict=True):
                    if n:
                        x[block] += y.transpose(2, 1, 0)
                    else:
                        x[block] = y.transpose(2, 1, 0)
            if not np.any(terms):
                continue
            largest = LOST_TERM if certified else LOST_TERM_OF_FITS
            singles = ~(terms <= largest * (1 + abs(out[0][block]).max(2).T)).all(0)
            if singles.any() and not certified:
                raise DomainError("The terms of these derivatives cancel.")
            for j in (i + np.flatnonzero(singles)).tolist():
                v, faster, axis, rate = self.differences.at(float(t[j]))
                out[0][j] = input_weights @ v @ to_lab.T + turns + np.outer(spins, to_lab @ axis)
                if slopes:
                    out[1][j] = input_weights @ faster @ to_lab.T + np.outer(spins, to_lab @ rate)
        return out


def _alike(variations: Sequence[Variation]) -> list[list[int]]:
    """Return lists of indices of variations with equal constants, which together are all indices.

    At a special case each input may have its own constants.
    """
    groups: list[list[int]] = []
    for i, x in enumerate(variations):
        for group in groups:
            reference = variations[group[0]]
            is_alike = reference.values is x.values or (
                reference.form == x.form
                and all(
                    len(row) == len(x.values[name]) and all(map(_same, row, x.values[name]))
                    for name, row in reference.values.items()
                )
            )
            if is_alike:
                group.append(i)
                break
        else:
            groups.append([i])
    return groups


def _same(x: Any, y: Any) -> bool:
    return complex(acb(x).mid()) == complex(acb(y).mid())
