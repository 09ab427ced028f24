"""Derivatives of a motion of one nutation in its inputs: the vector v in the laboratory, dR/dp = [v]x R, and dv/dt.

Every motion of one nutation is R = exp(lambda t n) S(s) exp(sigma t e3), s = t + origin less whole periods T, so

    v = t lambda_p n + t sigma_p R e3 + (origin_p - count T_p) v_s + (what is bounded and periodic).

Whatever grows with time is in three derivatives of frequencies, which `atlas.exact.nutation.variations` makes in balls
with all other constants; v_s and the bounded part are those of the pair (alpha, beta) at a fixed place s in the period.
"""

from collections.abc import Callable, Sequence
from functools import cached_property
from typing import Any, TypeAlias

import numpy as np
from flint import acb, arb

from atlas.core.arithmetic.phase import EVEN, Phases, room
from atlas.core.arithmetic.words import TURN
from atlas.core.inputs import FloatArray
from atlas.exact.nutation.variations import Differences, Tables, TooNearError, Variation
from atlas.formulas.numbers import workprec

BLOCK = 512
"""Times at once: products of so few the library does not thread."""

NEGLIGIBLE = 2.0**-64
"""Part of the largest term of a sum below which a term is left out."""

MUCH, LOST = 256.0, 4096.0
"""Sizes of terms in v, beside 1 and beside 1 + |v|, from which they may cancel, and from which they do too much."""

SERIES, SMALL = 14, 0.1
"""Terms of the series in A u^2 of the derivative in A of the integral of nu, and up to where it is taken."""

Array: TypeAlias = np.ndarray[Any, Any]


class Pair:
    """alpha and beta of one motion in doubles, with their derivatives in several inputs, at any time."""

    def __init__(self, variations: Sequence[Variation]) -> None:
        form, places, _, kinds, *_ = variations[0].form
        self.steady, self.hyperbolic = form == "steady", form == "hyperbolic"
        self.doubled = [doubled for doubled, _ in kinds]
        value, slopes = variations[0].values, [x.slopes for x in variations]
        self.rates = _doubles(slopes, "rates").real
        with workprec():
            cells = 1 if self.hyperbolic else 2
            half, origin = value["times"] or (arb(1), arb(0))
            self.cell = 2 * cells * half
            turns, starts = [value["rates"][0].mid() / TURN], [arb(0)]
            if not self.steady:
                turns, starts = [*turns, (1 / self.cell).mid()], [*starts, (origin / self.cell).mid()]
            self.phases = Phases(turns, starts, rounder=EVEN)
            self.start = float((origin / self.cell).mid())
            self.cell, self.origin = float(self.cell.mid()), float(origin.mid())
            self.rate, *self.twists = (float(x.mid()) for x in value["slopes"])
            self.twist = float((value["slopes"][1] + value["slopes"][2]).mid())
            self.frame = float(value["rates"][0].mid())
            self.tables, self.frequencies = list[Array](), list[FloatArray]()
            for i in range(2):
                self._weigh(i, value, slopes)
        times = np.zeros((len(slopes), 2)) if self.steady else _doubles(slopes, "times").real
        self.cells, self.origins = 2 * cells * times[:, 0], times[:, 1]
        rates, *twists = _doubles(slopes, "slopes").real.T
        self.faster = rates / (self.rate or 1)
        self.twisting = np.array([x - y * self.faster for x, y in zip(twists, self.twists, strict=True)])
        self._place(_double(value["tilt"]).real, _doubles(slopes, "tilt").real.T, np.eye(3)[list(places)].T)
        self.swing = Swing(value, slopes, self) if "swing" in value else None

    def _weigh(self, i: int, value: Tables, slopes: Sequence[Tables]) -> None:
        """Keep the weights of S, C by turns in alpha or beta, in its slope by s, and in its derivatives at rest."""
        rate, *twists = value["slopes"]
        row, twist, sign = value[f"sum {i}"], twists[i] * acb(0, 1), 1 if self.hyperbolic else -1
        k = [n - n % 2 + (not self.doubled[i]) for n in range(len(row))]
        # S and C change places: the derivative by rate s is odd C -+ even S
        turned = [k[n] * (row[n - 1] if n % 2 else sign * row[n + 1]) for n in range(len(row))]
        slope = [twist * x + rate * y for x, y in zip(row, turned, strict=True)]
        still = [slope]
        for x in slopes:
            origin = x["times"][1] if x["times"] else arb(0)
            # in balls: next to a steady motion the origin moves fast, and the weights against it
            still.append([y + origin * z for y, z in zip(x[f"sum {i}"], slope, strict=True)])
        rows = [row, *still]
        if self.hyperbolic:  # of exponentials: sinh and cosh would cancel
            rows = [[(x[n - n % 2 + 1] + (-1) ** n * x[n - n % 2]) / 2 for n in range(len(x))] for x in rows]
        table, frequencies = np.array([_double(x) for x in rows]), np.array(k[::2], dtype=float)
        reach = self.rate * self.cell / 2 if self.hyperbolic else 0.0
        size = abs(table).max(0).reshape(-1, 2).max(1)
        with np.errstate(over="ignore", invalid="ignore"):
            grown = size * np.exp(frequencies * reach)
            count = int(np.flatnonzero(grown > NEGLIGIBLE * grown.max()).max(initial=0)) + 1
        if not np.isfinite(grown).all():
            raise TooNearError("The motion is too near to a separatrix for derivatives in floats.")
        self.tables.append(table[:, : 2 * count])
        self.frequencies.append(frequencies[:count])

    def _place(self, tilt: FloatArray, tilts: FloatArray, order: FloatArray) -> None:
        """Keep what takes vectors out of the frame of the field, and how that turns for each input."""
        (c, sine, C, S), (dc, ds, dC, dS) = tilt, tilts
        cos, sin = c * c - sine * sine, 2 * c * sine
        self.chi, lean = C * dS - S * dC, -2 * (c * ds - sine * dc)
        self.axes = order @ np.array([[C, S * cos, S * sin], [-S, C * cos, C * sin], [0, -sin, cos]])
        self.turned = np.stack([C * lean, -S * lean, -self.chi], -1) @ order.T

    def places(self, t: FloatArray) -> tuple[Array, FloatArray, FloatArray]:
        """Return lambda t, s, and the count of whole cells."""
        half, rest, *_ = self.phases.reduced(t, room(1 + (not self.steady), t.size))
        turn = 2 * (half + rest)
        if self.steady:
            return turn[0], np.zeros(t.size), np.zeros(t.size)
        parts = turn[1] / float(TURN)
        return turn[0], parts * self.cell, np.rint(t / self.cell + self.start - parts)

    def functions(self, s: FloatArray, doubled: bool, count: int) -> FloatArray:
        """Return sin and cos of k x by turns, x = rate s, or exp(k x) and exp(-k x); k = 1, 3, ... or 0, 2, ...."""
        x = self.rate * s
        out = np.empty((count, 2, s.size))
        if self.hyperbolic:
            out[0] = 1.0 if doubled else np.exp([x, -x])
            if count > 1:
                twice = np.exp([2 * x, -2 * x])
                for n in range(1, count):
                    np.multiply(out[n - 1], twice, out=out[n])
            return out.reshape(2 * count, s.size)
        S, C = np.sin(x), np.cos(x)
        further, less = 2 * S * C, 1 - 2 * S * S
        out[0, 0], out[0, 1] = (0.0, 1.0) if doubled else (S, C)
        for n in range(1, count):
            (S, C), (up, down) = out[n - 1], out[n]
            np.add(S * less, C * further, out=up)
            np.subtract(C * less, S * further, out=down)
        return out.reshape(2 * count, s.size)

    def slope(self, table: Array, i: int) -> Array:
        """Return the weights of the slopes by s of what has some weights in alpha or beta."""
        k, pairs = self.rate * self.frequencies[i], table.reshape(len(table), -1, 2)
        first, second = (pairs[..., 0], -pairs[..., 1]) if self.hyperbolic else (-pairs[..., 1], pairs[..., 0])
        return 1j * self.twists[i] * table + np.stack([k * first, k * second], -1).reshape(table.shape)


class Weighted:
    """v of some combinations of a pair's inputs: sums of what depends on time, with weights that do not.

    In the frame of the field, that of the body's axis where alpha and beta stand for R, v is across = b_p p - a_p q and
    along = Im(a_p u* + b_p w*), with u = 2 a/(|a|^2 + |b|^2), p = u times the phase of the frame, and w, q so from b;
    a_p and b_p are the derivatives. `left` (3, 3) takes vectors into the laboratory, `names` (N, P) are combinations of
    inputs; `turns` (N, 3) and `spins` (N,) turn the body about axes of the laboratory, and about its own, besides.
    """

    def __init__(self, pair: Pair, left: FloatArray, names: FloatArray, turns: FloatArray, spins: FloatArray) -> None:
        self.pair, self.axes, self.names = pair, left @ pair.axes, names
        self.parts = []
        for i, table in enumerate(pair.tables):
            rows = np.concatenate([table[:2], names @ table[2:]])
            both = np.array([rows, pair.slope(rows, i)])
            self.parts.append(np.stack([both.real, both.imag], 1))
        rates, (first, second) = names @ pair.rates, pair.twisting @ names.T
        chi, self.fixed = names @ pair.chi + spins, names @ pair.turned @ left.T + turns
        columns = [
            names @ pair.faster,
            -(names @ pair.cells),
            rates[:, 1],
            chi,
            first - second,
            rates[:, 0],
            first + second,
        ]
        self.columns = np.array([np.stack([*columns, x], -1) for x in self.fixed.T])
        sizes = sum(abs(x[0, :, 2:]).sum((0, 2)) for x in self.parts) + abs(self.columns[:, :, 3::4]).max((0, 2))
        self.cancels = pair.hyperbolic or not (sizes < MUCH).all()

    def at(self, t: FloatArray, slopes: bool) -> tuple[list[FloatArray], Any]:
        """Return v at times (m,), (3, N, m), dv/dt if asked for; and where their terms cancel, (m,), or None."""
        pair, counts = self.pair, [len(x) for x in self.pair.frequencies]
        turn, s, count = pair.places(t)
        if pair.doubled[0] == pair.doubled[1]:
            f = [pair.functions(s, pair.doubled[0], max(counts))] * 2
        else:
            f = [pair.functions(s, doubled, n) for doubled, n in zip(pair.doubled, counts, strict=False)]
        f = [x[: 2 * n] for x, n in zip(f, counts, strict=True)]
        levels = range(1 + slopes)
        # by level, part, row and time: a, its slope, its derivatives
        A, B = (np.matmul(x[: 1 + slopes], y) for x, y in zip(self.parts, f, strict=True))
        a, b = (x[:, 0, 0] + 1j * x[:, 1, 0] for x in (A, B))
        square = (a[0] * a[0].conj() + b[0] * b[0].conj()).real
        phase = np.empty(t.size, complex)
        angle = turn + pair.twist * s
        phase.real, phase.imag = np.cos(angle), np.sin(angle)
        u, w = ([2 / square * x] for x in (a[0], b[0]))
        e, nu = [-1j * (u[0] * phase) * b[0]], [(a[0] * u[0].conj() - b[0] * w[0].conj()).real / 2]
        p, q = [u[0] * phase], [w[0] * phase]
        if slopes:
            less = (a[1] * u[0].conj() + b[1] * w[0].conj()).real
            by = 1j * pair.frame - less
            e.append(by * e[0] - 1j * (a[1] * q[0] + p[0] * b[1]))
            nu.append((a[1] * u[0].conj() - b[1] * w[0].conj()).real - less * nu[0])
            p.append(by * p[0] + 2 / square * a[1] * phase)
            q.append(by * q[0] + 2 / square * b[1] * phase)
            for x, y in ((u, a), (w, b)):
                x.append(2 / square * y[1] - less * x[0])
        ways = [self._ways(*x) for x in zip(p, q, u, w, strict=True)]
        axis = [self.axes @ np.array([x.real, x.imag, y]) for x, y in zip(e, nu, strict=True)]
        derivatives = [np.array([x[i, j] for x in (A, B) for j in range(2)]) for i in levels]
        by_s = [self._sum(ways, derivatives, i, slice(1, 2))[:, 0] for i in levels]
        basis = [self._basis(t, s, count, by_s, axis, i) for i in levels]
        found = [np.matmul(self.columns, x) for x in basis]
        for i in levels:
            found[i] += self._sum(ways, derivatives, i, slice(2, None))
        if pair.swing:
            change = pair.swing.change(self.names, s, count)
            for i in levels:
                found[i] += axis[i][:, None] * change
            if slopes:
                normal = np.cross(axis[0], self.axes[:, 2:], axis=0)
                bent = ((found[0] - self.fixed.T[:, :, None]) * normal[:, None]).sum(0)
                found[1] += axis[0][:, None] * pair.swing.slopes(self.names, nu[0], bent)
        columns, basis_size = abs(self.columns).max(0), abs(basis[0]).max(0)
        if not self.cancels and (columns @ basis_size.max(1)).max() < LOST:
            return found, None
        terms = sum(abs(x[0, :, 2:]).sum(0) @ abs(y) for x, y in zip(self.parts, f, strict=True)) * 2 / np.sqrt(square)
        return found, (terms + columns @ basis_size > LOST * (1 + abs(found[0]).max(0))).any(0)

    def _ways(self, p: Array, q: Array, u: Array, w: Array) -> FloatArray:
        """Return what real and imaginary part of a_p and of b_p add to v, (3, 4, m)."""
        ways = np.array([
            [-q.real, q.imag, p.real, -p.imag],
            [-q.imag, -q.real, p.imag, p.real],
            [-u.imag, u.real, -w.imag, w.real],
        ])  # fmt: skip
        return np.asarray(np.matmul(self.axes, ways.reshape(3, -1)).reshape(ways.shape))

    @staticmethod
    def _sum(ways: Sequence[FloatArray], parts: Sequence[FloatArray], level: int, rows: slice) -> FloatArray:
        """Return what rows of derivatives add to v, or to dv/dt, (3, rows, m)."""
        pairs = [(ways[i], parts[level - i][:, rows]) for i in range(level + 1)]
        total = ways[0][:, 0, None] * pairs[0][1][0] if not level else np.zeros(1)
        for i, (way, part) in enumerate(pairs):
            for j in range(i == level == 0, 4):
                total = total + way[:, j, None] * part[j]
        return np.asarray(total)

    def _basis(
        self, t: FloatArray, s: FloatArray, count: FloatArray, by_s: Sequence[FloatArray], axis: Sequence[FloatArray],
        level: int,
    ) -> FloatArray:  # fmt: skip
        """Return what the columns weigh, or the slopes of it, (3, 8, m)."""
        (v, e), n = (by_s[level], axis[level]), self.axes[:, 2:]
        found = np.empty((3, 8, t.size))
        found[:, 0], found[:, 1], found[:, 2], found[:, 3], found[:, 4] = s * v, count * v, t * e, e, s * e
        found[:, 5], found[:, 6], found[:, 7] = (n, n, 0.0) if level else (n * t, n * s, 1.0)
        if level:
            found[:, 0] += by_s[0]
            found[:, 2] += axis[0]
            found[:, 4] += axis[0]
        return found


class Swing:
    """What the integral of nu adds to the turn about a top's axis, and its derivatives."""

    def __init__(self, value: Tables, slopes: Sequence[Tables], pair: Pair) -> None:
        self.pair, self.A = pair, float(value["A"][0].mid())
        self.kappa, self.twist = (_double(value[x]).real[0] for x in ("swing", "twist"))
        kappas, twists, constants, As, rates = (
            _doubles(slopes, x).real[:, 0] for x in ("swing", "twist", "swing rate", "A", "slopes")
        )
        self.sums = [_double(value[x]).reshape(-1, 2).real for x in ("sum 2", "sum 3")]
        self.changes = [_doubles(slopes, x).real for x in ("sum 2", "sum 3")]
        self.spins = np.stack([kappas, -constants], -1)
        self.columns = np.stack([kappas, twists, As, rates, pair.origins, -pair.cells, np.zeros(len(As))], -1)
        start, zero = np.array([pair.origin]), np.zeros(1)
        self.columns[:, 6] = -self.change(np.eye(len(As)), start, zero)[:, 0]

    def change(self, names: FloatArray, s: FloatArray, count: FloatArray) -> Array:
        """Return the derivatives of the angle in combinations of inputs, but for what grows with time, (N, m)."""
        parts, bys, functions = [], [], []
        for i, both in enumerate(self.sums):
            doubled, hyperbolic = self.pair.doubled[2 + i], self.pair.hyperbolic
            k = np.arange(len(both), dtype=float) * 2 + (not doubled)
            f = self.pair.functions(s, doubled, len(both))
            if hyperbolic:
                up, down = f[::2], f[1::2]
                f = np.stack([(up - down) / 2, (up + down) / 2], 1).reshape(f.shape)
            turned = np.stack([(1 if hyperbolic else -1) * k * both[:, 1], k * both[:, 0]], 1)
            functions.append(f)
            parts.append(both.ravel() @ f)
            bys.append(turned.ravel() @ f)
        (o, e), (o_s, e_s) = parts, bys
        by_s = 2 * self.kappa * (o_s * e - o * e_s) / (e * e - self.A * o * o)
        slope = self.kappa * self.twist + self.pair.rate * by_s
        bent, by_A = self._bent(o, e)
        basis = np.array([
            self.twist * s + bent, self.kappa * s, self.kappa * by_A, s * by_s, slope, count * slope, np.ones(s.size)
        ])  # fmt: skip
        found = (names @ self.columns) @ basis
        weight = 2 * self.kappa / (e * e - self.A * o * o)
        for change, f, other in zip(self.changes, functions, (e, -o), strict=True):
            found += (names @ change) @ (f * (weight * other))
        return np.asarray(found)

    def _bent(self, o: FloatArray, e: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return 2 at(sqrt(|A|) o/e)/sqrt(|A|), and its derivative in A."""
        A, size = self.A, np.sqrt(abs(self.A))
        bent = 2 * o / e
        if A:
            bent = 2 * (np.arctanh(o / e * size) if A > 0 else np.arctan2(o * size, e)) / size
        by_A = (o * e / (e * e - A * o * o) - bent / 2) / A if A else 2 * (o / e) ** 3 / 3
        near = abs(A) * o * o < SMALL * e * e
        u = o[near] / e[near]
        square, series = A * u * u, np.zeros(u.size)
        for n in range(SERIES, 0, -1):
            series = series * square + 2 * n / (2 * n + 1)
        by_A[near] = series * u**3
        return bent, by_A

    def slopes(self, names: FloatArray, nu: FloatArray, changes: FloatArray) -> Array:
        """Return the rates of the derivatives of the angle, kappa nu, but for those that are constant."""
        varied = names @ self.spins
        return np.asarray(varied[:, :1] * nu + varied[:, 1:] + self.kappa * changes)


def _double(row: Sequence[Any]) -> Array:
    """Return balls as complex doubles."""
    return np.array([complex(acb(x).mid()) for x in row], dtype=complex)


def _doubles(tables: Sequence[Tables], name: str) -> Array:
    return np.array([_double(x[name]) for x in tables])


class Varied:
    """Derivatives of one motion in several inputs, of which those with the same constants are made at once.

    Where there are none, or where terms cancel, they are differences of the motion in balls.
    """

    def __init__(self, found: Sequence[Variation], differences: Callable[[], Differences]) -> None:
        self.pairs = [(group, Pair([found[i] for i in group])) for group in _alike(found)]
        self._make = differences

    @cached_property
    def differences(self) -> Differences:
        """What gives derivatives at single times."""
        return self._make()

    def weighted(self, left: FloatArray, names: FloatArray, turns: FloatArray, spins: FloatArray) -> list[Weighted]:
        """Return what gives v of combinations of inputs, see `Weighted`; v is the sum of all."""
        found: list[Weighted] = []
        for group, pair in self.pairs:
            rest = 0 if found else 1
            found.append(Weighted(pair, left, names[:, group], rest * turns, rest * spins))
        return found

    def vectors(
        self, t: FloatArray, slopes: bool, left: FloatArray, names: FloatArray, turns: FloatArray, spins: FloatArray,
        known: list[Weighted],
    ) -> list[FloatArray]:  # fmt: skip
        """Return v of combinations of inputs at times (m,), (m, N, 3), and dv/dt if asked for."""
        out = [np.empty((t.size, len(names), 3)) for _ in range(1 + slopes)]
        for i in range(0, t.size, BLOCK):
            part = slice(i, i + BLOCK)
            alone = np.full(t[part].size, not known)
            for n, one in enumerate(known):
                values, cancels = one.at(t[part], slopes)
                for x, y in zip(out, values, strict=True):
                    if n:
                        x[part] += y.transpose(2, 1, 0)
                    else:
                        x[part] = y.transpose(2, 1, 0)
                if cancels is not None:
                    alone |= cancels
            for j in (i + np.flatnonzero(alone)).tolist():
                v, faster, axis, more = self.differences.at(float(t[j]))
                out[0][j] = names @ v @ left.T + turns + np.outer(spins, left @ axis)
                if slopes:
                    out[1][j] = names @ faster @ left.T + np.outer(spins, left @ more)
        return out


def _alike(found: Sequence[Variation]) -> list[list[int]]:
    """Return the places of variations with the same constants: on a border each input has its own."""
    groups: list[list[int]] = []
    for i, x in enumerate(found):
        for group in groups:
            other = found[group[0]]
            same = other.values is x.values or (
                other.form == x.form
                and all(
                    len(row) == len(x.values[name]) and all(map(_same, row, x.values[name]))
                    for name, row in other.values.items()
                )
            )
            if same:
                group.append(i)
                break
        else:
            groups.append([i])
    return groups


def _same(x: Any, y: Any) -> bool:
    return complex(acb(x).mid()) == complex(acb(y).mid())
