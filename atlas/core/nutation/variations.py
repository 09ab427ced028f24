"""Derivatives of a motion of one nutation in its inputs: the vector v in the laboratory, dR/dp = [v]x R, and dv/dt.

Every motion of one nutation is R = exp(lambda t n) S(s) exp(sigma t e3), s = t + origin less whole periods T, so

    v = t lambda_p n + t sigma_p R e3 + (origin_p - count T_p) v_s + (what is bounded and periodic).

Whatever grows with time is in three derivatives of frequencies, which `atlas.exact.nutation.variations` makes in balls
with all other constants; v_s and the bounded part are those of the pair (alpha, beta) at a fixed place s in the period.
"""

from collections.abc import Sequence
from typing import Any, TypeAlias

import numpy as np
from flint import acb, arb

from atlas.core.arithmetic.phase import EVEN, Phases, room
from atlas.core.arithmetic.words import TURN
from atlas.core.inputs import FloatArray
from atlas.errors import DomainError
from atlas.exact.nutation.variations import Tables, Variation
from atlas.formulas.numbers import workprec

BLOCK = 512
"""Times at once: products of so few the library does not thread."""

NEGLIGIBLE = 2.0**-64
"""Part of the largest term of a sum below which a term is left out."""

SERIES, SMALL = 14, 0.1
"""Terms of the series in A u^2 of the derivative in A of the integral of nu, and up to where it is taken."""

Array: TypeAlias = np.ndarray[Any, Any]


class Pair:
    """alpha and beta of one motion in doubles, with their derivatives in several inputs, at any time."""

    def __init__(self, variations: Sequence[Variation]) -> None:
        form, places, _, kinds, *_ = variations[0].form
        self.steady, self.hyperbolic = form == "steady", form == "hyperbolic"
        self.doubled, self.order = [doubled for doubled, _ in kinds], np.eye(3)[list(places)]
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
        times = np.zeros((len(slopes), 2)) if self.steady else _doubles(slopes, "times").real
        self.cells, self.origins = 2 * cells * times[:, 0], times[:, 1]
        self.tilt, self.tilts = _double(value["tilt"]).real, _doubles(slopes, "tilt").real
        with workprec():
            self._weigh(value, slopes)
        self.swing = Swing(value, slopes, self) if "swing" in value else None

    def _weigh(self, value: Tables, slopes: Sequence[Tables]) -> None:
        """Keep the weights of S, C, s S, s C in alpha and beta, in their slopes by s, and in their derivatives."""
        rate, *twists = value["slopes"]
        self.rate, self.twists = float(rate.mid()), [float(x.mid()) for x in twists]
        self.twist = float((twists[0] + twists[1]).mid())
        self.frame = float(value["rates"][0].mid())
        self.tables: list[Array] = []
        self.frequencies: list[FloatArray] = []
        sign = 1 if self.hyperbolic else -1
        for i in range(2):
            row, changes, twist = value[f"sum {i}"], [x[f"sum {i}"] for x in slopes], twists[i] * acb(0, 1)
            k = [n - n % 2 + (not self.doubled[i]) for n in range(len(row))]
            # S and C change places: the derivative by rate s is odd C -+ even S
            turned = [k[n] * (row[n - 1] if n % 2 else sign * row[n + 1]) for n in range(len(row))]
            slope = [twist * x + rate * y for x, y in zip(row, turned, strict=True)]
            still, moving = [slope], [[acb(0)] * len(row)]
            for x, change in zip(slopes, changes, strict=True):
                origin = x["times"][1] if x["times"] else arb(0)
                more, own = x["slopes"][0], x["slopes"][1 + i] * acb(0, 1)
                # in balls: next to a steady motion the origin moves fast, and the weights against it
                still.append([y + origin * z for y, z in zip(change, slope, strict=True)])
                moving.append([own * y + more * z for y, z in zip(row, turned, strict=True)])
            table = np.concatenate([[_double(x) for x in (row, *still)], [_double(x) for x in (row, *moving)]], 1)
            table[0, len(row) :] = 0
            self._keep(table, np.array(k[::2], dtype=float))

    def _keep(self, table: Array, k: FloatArray) -> None:
        """Keep the terms that matter. DomainError where none but huge ones do."""
        reach = self.rate * self.cell / 2 if self.hyperbolic else 0.0
        size = abs(table).max(0).reshape(2, -1, 2).max((0, 2))
        with np.errstate(over="ignore", invalid="ignore"):
            grown = size * np.exp(k * reach)
            count = int(np.flatnonzero(grown > NEGLIGIBLE * grown.max()).max(initial=0)) + 1
        if not np.isfinite(grown).all():
            raise DomainError("The motion is too near to a separatrix for derivatives in floats.")
        self.tables.append(table.reshape(len(table), 2, -1, 2)[:, :, :count].reshape(len(table), -1))
        self.frequencies.append(k[:count])

    def places(self, t: FloatArray) -> tuple[Array, FloatArray, FloatArray]:
        """Return exp(i lambda t), s, and the count of whole cells."""
        half, rest, *_ = self.phases.reduced(t, room(1 + (not self.steady), t.size))
        turn = 2 * (half + rest)
        if self.steady:
            return np.exp(1j * turn[0]), np.zeros(t.size), np.zeros(t.size)
        parts = turn[1] / float(TURN)
        return np.exp(1j * turn[0]), parts * self.cell, np.rint(t / self.cell + self.start - parts)

    def rows(self, s: FloatArray, i: int, slopes: bool) -> tuple[Array, Array]:
        """Return alpha (i = 0) or beta, its slope by s, its derivatives in the inputs, (2 + P, m); their slopes."""
        table = self.tables[i]
        if self.steady:
            found = table[:, 1:2] * np.ones(s.size)
            return found, 0 * found
        k, sign = self.rate * self.frequencies[i], 1 if self.hyperbolic else -1
        f = _functions(s, k, self.hyperbolic)
        found = _product(table, np.concatenate([f, f * s]))
        if not slopes:
            return found, found
        turned = np.empty_like(f)
        turned[::2], turned[1::2] = k[:, None] * f[1::2], sign * k[:, None] * f[::2]
        return found, _product(table, np.concatenate([turned, f + turned * s])) + 1j * self.twists[i] * found

    def vectors(self, t: FloatArray, slopes: bool) -> list[FloatArray]:
        """Return v of each input at times (m,), (P, m, 3), in the frame of the motion's body at t = 0, and dv/dt."""
        turn, s, count = self.places(t)
        along = count * self.cells[:, None]
        (a, a_p), (da, da_p), (b, b_p), (db, db_p) = (
            (x[0], x[2:] - along * x[1]) for i in range(2) for x in self.rows(s, i, slopes)
        )
        ac, bc = a.conj(), b.conj()
        square = (a * ac + b * bc).real
        turn = 2 * turn * np.exp(1j * self.twist * s) / square
        a2, b2 = a * turn, b * turn
        c, sine, C, S = self.tilt
        dc, ds, dC, dS = self.tilts.T
        chi = C * dS - S * dC
        across, third = b_p * a2 - a_p * b2, (a_p * (ac * (2 / square)) + b_p * (bc * (2 / square))).imag
        e, e3 = -1j * a2 * b, (a * ac - b * bc).real / square
        spin = t * self.rates[:, 1:] + chi[:, None]
        if self.swing:
            spin = spin + self.swing.change(s, count)
        found = [self._out(across + spin * e, third + spin * e3 + t * self.rates[:, :1])]
        found[0] += self._out(-2 * (c * ds - sine * dc)[:, None] + 0j, 0 * chi[:, None], -chi[:, None])
        if not slopes:
            return found
        dac, dbc = da.conj(), db.conj()
        less = 2 * (ac * da + bc * db).real / square
        by = 1j * self.frame - less
        d_across = by * across + db_p * a2 + b_p * (da * turn) - da_p * b2 - a_p * (db * turn)
        d_third = (da_p * ac + a_p * dac + db_p * bc + b_p * dbc).imag * (2 / square) - less * third
        d_e, d_e3 = by * e - 1j * (da * b2 + a2 * db), 2 * (ac * da - bc * db).real / square - less * e3
        d_spin = self.rates[:, 1:]
        if self.swing:
            e3_p = 2 * ((ac * a_p - bc * b_p).real - e3 * (ac * a_p + bc * b_p).real) / square
            d_spin = d_spin + self.swing.slopes(e3, e3_p)
        d_across = d_across + spin * d_e + d_spin * e
        return [*found, self._out(d_across, d_third + spin * d_e3 + d_spin * e3 + self.rates[:, :1])]

    def _out(self, across: Array, third: FloatArray, along: Any = 0.0) -> FloatArray:
        """Return vectors out of the frame of the field: R_z(-chi) R_x(-theta)."""
        c, sine, C, S = self.tilt
        cos, sin = c * c - sine * sine, 2 * c * sine
        y, z = cos * across.imag + sin * third, cos * third - sin * across.imag + along
        x = across.real
        return np.stack([C * x + S * y, C * y - S * x, z], -1) @ self.order


class Swing:
    """What the integral of nu adds to the turn about a top's axis, and its derivatives."""

    def __init__(self, value: Tables, slopes: Sequence[Tables], pair: Pair) -> None:
        self.pair, self.A = pair, float(value["A"][0].mid())
        self.kappa, self.twist = (_double(value[x]).real[0] for x in ("swing", "twist"))
        self.kappas, self.twists, self.constant = (
            _doubles(slopes, x).real[:, 0] for x in ("swing", "twist", "swing rate")
        )
        self.As = _doubles(slopes, "A").real[:, 0]
        self.rates = _doubles(slopes, "slopes").real[:, 0]
        names = ("sum 2", "sum 3")
        self.sums = [_double(value[x]).reshape(-1, 2).real for x in names]
        self.changes = [_doubles(slopes, x).reshape(len(slopes), -1, 2).real for x in names]
        zero = np.zeros(1)
        at_start = self._terms(zero + pair.origin)
        self.start = at_start[0] + pair.origins[:, None] * at_start[1]

    def _terms(self, s: FloatArray) -> tuple[Array, Array]:
        """Return the derivatives of the angle at a fixed place, (P, m), and its slope by s."""
        parts, bys, changes = [], [], []
        for i, (both, change) in enumerate(zip(self.sums, self.changes, strict=True)):
            doubled, hyperbolic = self.pair.doubled[2 + i], self.pair.hyperbolic
            k = np.arange(len(both), dtype=float) * 2 + (not doubled)
            f = _functions(self.pair.rate * s, k, hyperbolic)
            turned = np.stack([(1 if hyperbolic else -1) * k * both[:, 1], k * both[:, 0]], 1).ravel() @ f
            parts.append(both.ravel() @ f)
            bys.append(self.pair.rate * turned)
            changes.append(change.reshape(len(change), -1) @ f + self.rates[:, None] * s * turned)
        (o, e), (o_s, e_s), (o_p, e_p), A = parts, bys, changes, self.A
        square = e * e - A * o * o
        size = np.sqrt(abs(A))
        bent = 2 * o / e
        if A:
            bent = 2 * (np.arctanh(o / e * size) if A > 0 else np.arctan2(o * size, e)) / size
        by_A = (o * e / square - bent / 2) / A if A else 2 * (o / e) ** 3 / 3
        near = abs(A) * o * o < SMALL * e * e
        u = o[near] / e[near]
        by_A[near] = sum(2 * n / (2 * n + 1) * A ** (n - 1) * u ** (2 * n + 1) for n in range(1, SERIES))
        part = 2 * (o_p * e - o * e_p) / square + self.As[:, None] * by_A
        whole = self.kappas[:, None] * (self.twist * s + bent) + self.kappa * (self.twists[:, None] * s + part)
        return whole, self.kappa * (self.twist + 2 * (o_s * e - o * e_s) / square)

    def slopes(self, nu: FloatArray, changes: FloatArray) -> Array:
        """Return the rates of the derivatives of the angle, kappa nu, but for those that are constant."""
        return np.asarray(self.kappas[:, None] * nu + self.kappa * changes - self.constant[:, None])

    def change(self, s: FloatArray, count: FloatArray) -> Array:
        """Return the derivatives of the angle, but for what grows with time."""
        p = self.pair
        fixed, slope = self._terms(s)
        return np.asarray(fixed + (p.origins[:, None] - count * p.cells[:, None]) * slope - self.start)


def _product(table: Array, basis: FloatArray) -> Array:
    """Return a complex matrix times a real one."""
    found = np.empty((len(table), basis.shape[1]), complex)
    found.real, found.imag = table.real @ basis, table.imag @ basis
    return found


def _functions(x: FloatArray, k: FloatArray, hyperbolic: bool) -> Array:
    """Return S and C of k x by turns, (2 len(k), m)."""
    out = np.empty((2 * len(k), x.size))
    for i, n in enumerate(k.tolist()):
        out[2 * i], out[2 * i + 1] = (np.sinh(n * x), np.cosh(n * x)) if hyperbolic else (np.sin(n * x), np.cos(n * x))
    return out


def _double(row: Sequence[Any]) -> Array:
    """Return balls as complex doubles."""
    return np.array([complex(acb(x).mid()) for x in row], dtype=complex)


def _doubles(tables: Sequence[Tables], name: str) -> Array:
    return np.array([_double(x[name]) for x in tables])


class Varied:
    """Derivatives of one motion in several inputs, of which those with the same constants are made at once."""

    def __init__(self, found: Sequence[Variation]) -> None:
        self.count = len(found)
        self.pairs = [(group, Pair([found[i] for i in group])) for group in _alike(found)]

    def vectors(self, t: FloatArray, slopes: bool) -> list[FloatArray]:
        """Return v of each input at times (m,), (m, P, 3), and dv/dt if asked for."""
        out = [np.empty((t.size, self.count, 3)) for _ in range(1 + slopes)]
        for group, pair in self.pairs:
            for i in range(0, t.size, BLOCK):
                for part, values in zip(out, pair.vectors(t[i : i + BLOCK], slopes), strict=True):
                    part[i : i + BLOCK, group] = values.swapaxes(0, 1)
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
