"""The pair (alpha, beta) of a motion with its derivatives in several inputs, from constants differentiated in balls."""

from collections.abc import Sequence
from typing import Any, TypeAlias

import numpy as np
from flint import acb, arb

from atlas.arithmetic.inputs import FloatArray
from atlas.arithmetic.numbers import workprec
from atlas.arithmetic.phase import EVEN, Phases, room
from atlas.arithmetic.words import TURN
from atlas.motions.nutation.certified_derivatives import Tables, TooNearError, Variation

NEGLIGIBLE = 2.0**-64
"""Part of the largest term of a sum below which a term is left out."""

SERIES_TERMS, MAX_SERIES_ARGUMENT = 14, 0.1
"""Terms of the series in A u^2 of the derivative in A of the integral of nu, and up to where it is taken."""

Array: TypeAlias = np.ndarray[Any, Any]


class VariedPair:
    """alpha and beta of one motion in doubles at any times, with their derivatives in several inputs.

    ``variations`` has a `Variation` for each input, with equal constants. By the inputs (P,) `rates` (P, 2) are the
    derivatives of the sum and difference of the phases' rates, `cells` and `origins` (P,) those of the length of a
    cell (two periods, or one if hyperbolic) and of the time s since the turning point at t = 0. `tables` has for alpha
    and beta an array of weights (2 + P, functions), see `functions`: of the sum, of its derivative by s, and of its P
    derivatives in the inputs.
    """

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
        """Append to `tables` the weights of alpha (i = 0) or beta (1), of its slope by s and of its derivatives.

        Weights of S and C alternate. ``value`` and ``slopes`` are the constants and their derivatives by each
        input. Raises TooNearError where a weight on the period exceeds a float, near a separatrix.
        """
        rate, *twists = value["slopes"]
        row, twist, sign = value[f"sum {i}"], twists[i] * acb(0, 1), 1 if self.hyperbolic else -1
        k = [n - n % 2 + (not self.doubled[i]) for n in range(len(row))]
        # S and C change places: the derivative by rate s is odd C -+ even S
        turning = [k[n] * (row[n - 1] if n % 2 else sign * row[n + 1]) for n in range(len(row))]
        slope = [twist * x + rate * y for x, y in zip(row, turning, strict=True)]
        at_rest = [slope]
        for x in slopes:
            origin = x["times"][1] if x["times"] else arb(0)
            # in balls: next to a steady motion the origin moves fast, and the weights against it
            at_rest.append([y + origin * z for y, z in zip(x[f"sum {i}"], slope, strict=True)])
        rows = [row, *at_rest]
        if self.hyperbolic:  # of exponentials: sinh and cosh would cancel
            rows = [[(x[n - n % 2 + 1] + (-1) ** n * x[n - n % 2]) / 2 for n in range(len(x))] for x in rows]
        table, frequencies = np.array([_double(x) for x in rows]), np.array(k[::2], dtype=float)
        reach = self.rate * self.cell / 2 if self.hyperbolic else 0.0
        size = abs(table).reshape(len(table), -1, 2).max(2)
        with np.errstate(over="ignore", invalid="ignore"):
            growth = size * np.exp(frequencies * reach)
            largest = np.maximum(growth.max(1, keepdims=True), growth[0].max())  # of each: one may be 1e9 times another
            count = int(np.nonzero(growth > NEGLIGIBLE * largest)[1].max(initial=0)) + 1
        if not np.isfinite(growth).all():
            raise TooNearError("The motion is too near to a separatrix for derivatives in floats.")
        self.tables.append(table[:, : 2 * count])
        self.frequencies.append(frequencies[:count])

    def _place(self, tilt: FloatArray, tilts: FloatArray, order: FloatArray) -> None:
        """Store the axes of the frame of the field in the body, and its rotation vectors (inputs, 3) by each input.

        ``tilt`` are cosine and sine of half the angle between axis and field, then of the azimuth, at t = 0; ``tilts``
        (4, inputs) their derivatives; ``order`` (3, 3) takes the class's axes to the body's.
        """
        (c, sine, C, S), (dc, ds, dC, dS) = tilt, tilts
        cos, sin = c * c - sine * sine, 2 * c * sine
        self.chi, lean = C * dS - S * dC, -2 * (c * ds - sine * dc)
        self.axes = order @ np.array([[C, S * cos, S * sin], [-S, C * cos, C * sin], [0, -sin, cos]])
        self.turning = np.stack([C * lean, -S * lean, -self.chi], -1) @ order.T

    def places(self, t: FloatArray) -> tuple[Array, FloatArray, FloatArray]:
        """Return (phase of the frame in rad, time s since the turning point, count of whole cells) at times t (m,).

        Each is (m,). The phase is less whole turns, s less whole cells; s and count are zero for a steady motion.
        """
        half, errors, *_ = self.phases.reduced(t, room(1 + (not self.steady), t.size))
        turn = 2 * (half + errors)
        if self.steady:
            return turn[0], np.zeros(t.size), np.zeros(t.size)
        values = turn[1] / float(TURN)
        return turn[0], values * self.cell, np.rint(t / self.cell + self.start - values)

    def functions(self, s: FloatArray, doubled: bool, count: int) -> FloatArray:
        """Return ``count`` pairs of functions of x = rate s, s (m,): rows sin k x, cos k x by turns, (2 count, m).

        Of a hyperbolic pair they are exp(k x) and exp(-k x). k is 0, 2, 4, ... if ``doubled``, else 1, 3, 5, ....
        """
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
        """Return the weights of d/ds of sums of functions from their weights ``table`` (rows, 2 terms).

        The sums belong to alpha (i = 0) or beta (1); the result has the shape of ``table``.
        """
        k, pairs = self.rate * self.frequencies[i], table.reshape(len(table), -1, 2)
        upper_weights, lower_weights = (
            (pairs[..., 0], -pairs[..., 1]) if self.hyperbolic else (-pairs[..., 1], pairs[..., 0])
        )
        return 1j * self.twists[i] * table + np.stack([k * upper_weights, k * lower_weights], -1).reshape(table.shape)


class Swing:
    """Rotation of a top about its axis by kappa times the integral of nu, and its derivatives in the inputs.

    ``value`` and ``slopes`` are the constants and their derivatives by each input, ``pair`` the `VariedPair` of the
    top.
    """

    def __init__(self, value: Tables, slopes: Sequence[Tables], pair: VariedPair) -> None:
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

    def change(self, input_weights: FloatArray, s: FloatArray, count: FloatArray) -> Array:
        """Return derivatives of the swing's angle, in rad, without terms linear in t, by N combinations, (N, m).

        ``input_weights`` is (N, inputs), ``s`` (m,) the times in the period, ``count`` (m,) the whole periods before.
        """
        values, bys, functions = [], [], []
        for i, weights in enumerate(self.sums):
            doubled, hyperbolic = self.pair.doubled[2 + i], self.pair.hyperbolic
            k = np.arange(len(weights), dtype=float) * 2 + (not doubled)
            f = self.pair.functions(s, doubled, len(weights))
            if hyperbolic:
                up, down = f[::2], f[1::2]
                f = np.stack([(up - down) / 2, (up + down) / 2], 1).reshape(f.shape)
            turning = np.stack([(1 if hyperbolic else -1) * k * weights[:, 1], k * weights[:, 0]], 1)
            functions.append(f)
            values.append(weights.ravel() @ f)
            bys.append(turning.ravel() @ f)
        (o, e), (o_s, e_s) = values, bys
        by_s = 2 * self.kappa * (o_s * e - o * e_s) / (e * e - self.A * o * o)
        slope = self.kappa * self.twist + self.pair.rate * by_s
        integral, by_A = self._integral_of_nu(o, e)
        basis = np.array([
            self.twist * s + integral, self.kappa * s, self.kappa * by_A, s * by_s, slope, count * slope,
            np.ones(s.size),
        ])  # fmt: skip
        changes = (input_weights @ self.columns) @ basis
        weight = 2 * self.kappa / (e * e - self.A * o * o)
        for change, f, factor in zip(self.changes, functions, (e, -o), strict=True):
            changes += (input_weights @ change) @ (f * (weight * factor))
        return np.asarray(changes)

    def _integral_of_nu(self, o: FloatArray, e: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return (y, dy/dA), (m,) each: y = 2 at(sqrt(|A|) o/e)/sqrt(|A|); at is artanh for A > 0, arctan for A < 0.

        o and e (m,) are the odd and even sums of the swing. Near A = 0, y is 2 o/e and dy/dA a series.
        """
        A, size = self.A, np.sqrt(abs(self.A))
        integral = 2 * o / e
        if A:
            integral = 2 * (np.arctanh(o / e * size) if A > 0 else np.arctan2(o * size, e)) / size
        by_A = (o * e / (e * e - A * o * o) - integral / 2) / A if A else 2 * (o / e) ** 3 / 3
        is_small = abs(A) * o * o < MAX_SERIES_ARGUMENT * e * e
        u = o[is_small] / e[is_small]
        square, series = A * u * u, np.zeros(u.size)
        for n in range(SERIES_TERMS, 0, -1):
            series = series * square + 2 * n / (2 * n + 1)
        by_A[is_small] = series * u**3
        return integral, by_A

    def slopes(self, input_weights: FloatArray, nu: FloatArray, changes: FloatArray) -> Array:
        """Return the rates (N, m), in rad/time, of the derivatives of the angle, without their constant parts.

        The angle's own rate is kappa nu. ``input_weights`` is (N, inputs), ``nu`` (m,) the cosine of axis and field,
        ``changes`` (N, m) are its derivatives.
        """
        varied = input_weights @ self.spins
        return np.asarray(varied[:, :1] * nu + varied[:, 1:] + self.kappa * changes)


def _double(row: Sequence[Any]) -> Array:
    """Return the midpoints of a ``row`` of n real or complex balls as a complex array (n,)."""
    return np.array([complex(acb(x).mid()) for x in row], dtype=complex)


def _doubles(tables: Sequence[Tables], name: str) -> Array:
    return np.array([_double(x[name]) for x in tables])
