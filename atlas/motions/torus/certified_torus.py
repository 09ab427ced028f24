"""The torus of a body with three moments: pairs of times after which its motion repeats, enclosed by Newton's method.

The flows of H and F/2 commute, theorem-involution, and so do their attitudes. After a pair of times r = (T_H, T_F)
M and K are back, and S = R_B(bt) R has turned about the field by an angle theta; so S(n r + s) = R_B(n theta) S(s) for
whole n. That a pair r is one is proved by Newton's method in balls: with y where the flow of a start r~ arrives, there
is exactly one d in a box after which two components of the state are those of the start x, where

    N = -(X_H, X_F)^-1 (y - x)

over the box lies in the box: the derivative of the flow by its times is the field X itself at its end. The other four
components are then those of the start, since H, F and both Casimirs are, and they tell such states apart.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np
from flint import arb, arb_mat, fmpq

from atlas.arithmetic.lazy import cached_property
from atlas.arithmetic.numbers import Vector, cross, dot, workprec
from atlas.errors import NotCertifiedError
from atlas.motions.torus.approximate_lattice import Lattice, lattice
from atlas.motions.torus.approximate_periods import Integrals, nearest, real_periods
from atlas.motions.torus.certified_flow import CYCLE, MAX_STEPS, Arrival, Flow, jacobian

PERIOD_BITS, FIRST_FLOW_BITS = 320, 200
"""Bits to which periods are proved at once from where they start, and those of a first flow that improves them."""

GUARD_BITS = 40
"""Bits by which a flow is computed more precisely than its arrival must be known."""

MAX_PERIOD_ERROR = 1e-20
"""Largest error, in units of time, of a period that is improved."""

NEXT = fmpq(1, 2**40)
"""Components across a principal axis, beside those along it, up to which a motion is next to a spin."""

MAX_GROWTH, MIN_DETERMINANT = 1e-6, 1e-6
"""Largest growth of a small push beside its frequencies, and the least determinant of two pairs of these."""

MAX_LENGTH = 500.0
"""Largest length of a period's flow that is gone for a proof: some thirty flows of one to three seconds each."""

NEWTON_ROUNDS = 4
"""Rounds of Newton's method from the periods of small pushes."""


@dataclass(frozen=True)
class Period:
    """A period of a `Torus`: after the flow of H for a time and then that of F/2 for another, M and K are back.

    `H`, in the unit of time, and `F`, in time/inertia, are these times; `angle` is the angle in rad by which
    the rotation S = R_B(bt) R has then turned about the field, known up to whole turns. All three are balls.
    """

    H: arb
    F: arb
    angle: arb

    def least(self) -> "Period":
        """Return the same `Period` with its angle in rad reduced by whole turns, to at most half a turn either way."""
        turn = 2 * arb.pi()
        return replace(self, angle=self.angle - turn * nearest(self.angle / turn))


class Torus:
    """The torus of all motions with the same integrals as a state (W, K), W = Omega + K, of a body; all is rational.

    ``moments``, W and K are three numbers each along the principal axes, of size one or so.
    """

    def __init__(self, moments: tuple[fmpq, ...], W: tuple[fmpq, ...], K: tuple[fmpq, ...]) -> None:
        self.moments, self.W, self.K = moments, W, K
        self.flow = Flow(moments, W, K)
        self._starts: list[tuple[fmpq, fmpq]] | None = None
        self._stored: dict[int, tuple[Period, Period]] = {}
        self._failure, self._no_lattice = (0, ""), ""

    @property
    def integrals(self) -> Integrals:
        """The exact `Integrals` of the state, rationals: H, F, c = (M, K) and K^2."""
        Omega = [w - k for w, k in zip(self.W, self.K, strict=True)]
        return Integrals.of_state(self.moments, Omega, self.K)

    def fields(self, W: Vector, K: Vector) -> tuple[list[arb], list[arb]]:
        """Return the rates of (W, K), lists of six balls: along the flow of H, and along that of F/2.

        W and K are three numbers each along the principal axes.
        """
        I, cycle = self.moments, ((1, 2), (2, 0), (0, 1))
        M = [x * w for x, w in zip(I, W, strict=True)]
        of_H = [(I[j] - I[k]) / I[i] * (W[j] * W[k] - K[j] * K[k]) for i, (j, k) in enumerate(cycle)]
        of_F = [(I[k] - I[j]) * (K[j] * K[k]) for j, k in cycle]
        return [*of_H, *cross(K, W)], [*of_F, *cross(K, M)]

    @cached_property
    def is_long(self) -> bool:
        """Whether a period is so long that to prove the motion's formulas would take minutes.

        Its `Flow.length` is then above `MAX_LENGTH`. False if no period is known.
        """
        try:
            return any(self.flow.length(H, F) > MAX_LENGTH for H, F in self._approximate())
        except NotCertifiedError:  # none is known
            return False

    def periods(self, bits: int) -> tuple[Period, Period]:
        """Return two proved `Period` that are independent, to ``bits`` binary digits; cached.

        Raises NotCertifiedError where none are proved.
        """
        bits = min((x for x in tuple(self._stored) if x >= bits), default=-(-bits // 32) * 32)
        if bits not in self._stored:
            failed_bits, reason = self._failure
            if bits <= failed_bits:  # a long way, which no fewer bits go
                raise NotCertifiedError(reason)
            try:
                period_1, period_2 = (self._enclosed(start, bits) for start in self._starts_of_proof())
            except NotCertifiedError as why:  # near an unstable spin errors may grow beyond the bounds of so few bits
                if bits >= PERIOD_BITS:
                    self._failure = bits, str(why)
                    raise
                period_1, period_2 = self.periods(PERIOD_BITS)
            self._stored[bits] = period_1, period_2
        return self._stored[bits]

    @cached_property
    def spin(self) -> int | None:
        """Axis (0, 1 or 2) about which the body spins, along the field, up to pushes as small as rounding.

        None for any other state.
        """
        sizes = [max(abs(w), abs(k)) for w, k in zip(self.W, self.K, strict=True)]
        axis = sizes.index(max(sizes))
        return axis if all(x <= NEXT * sizes[axis] for i, x in enumerate(sizes) if i != axis) else None

    @cached_property
    def pushed(self) -> list[tuple[float, float]] | None:
        """Approximate periods (T_H, T_F) of the two small oscillations next to a stable spin, a list of two pairs.

        None for a state that is not next to a spin, see `spin`, and next to an unstable spin.
        """
        if self.spin is None:
            return None
        state = np.array([[float(x) if i % 3 == self.spin else 0.0] for i, x in enumerate((*self.W, *self.K))])
        transverse = [*CYCLE[self.spin], *(3 + i for i in CYCLE[self.spin])]
        H, F = (
            jacobian(state, *(np.array([float(x) for x in row]) for row in self.flow.rates(*way)))[0]
            for way in ((fmpq(1), fmpq(0)), (fmpq(0), fmpq(1)))
        )
        H, F = (x[np.ix_(transverse, transverse)] for x in (H, F))
        size = np.linalg.norm(H), np.linalg.norm(F)
        values, vectors = np.linalg.eig(H / size[0] + F / (2 * size[1]))
        waves = vectors[:, values.imag > 0].T
        if abs(values.real).max() > MAX_GROWTH * abs(values).max() or len(waves) != 2:
            return None
        rates = np.array([[(w.conj() @ x @ w).imag / (w.conj() @ w).real for x in (H, F)] for w in waves])
        if abs(np.linalg.det(rates / size)) < MIN_DETERMINANT:
            return None
        period_1, period_2 = (2 * np.pi * np.linalg.inv(rates)).T.tolist()
        return [tuple(period_1), tuple(period_2)]

    def _approximate(self) -> list[tuple[fmpq, fmpq]]:
        if self._starts is None and self.pushed is not None:
            starts = []
            for T_H, T_F in self.pushed:
                r, step = (arb(T_H).fmpq(), arb(T_F).fmpq()), np.inf
                for _ in range(NEWTON_ROUNDS):
                    r, step = self._improved(r, FIRST_FLOW_BITS)
                if not step < MAX_PERIOD_ERROR:
                    break
                starts.append(r)
            else:
                self._starts = _signed(starts)
        if self._starts is None:
            try:
                rows = [(x.real, y.real) for x, y, _ in self.lattice.real]
            except NotCertifiedError:  # fewer will do here
                rows = real_periods(self.integrals)
            if len(rows) != 2:
                raise NotCertifiedError("not certified: no two periods of the motion's torus were found.")
            self._starts = _signed([(x.mid().fmpq(), y.mid().fmpq()) for x, y in rows])
        return self._starts

    def _starts_of_proof(self) -> list[tuple[fmpq, fmpq]]:
        """Return two approximate periods (T_H, T_F), a list of pairs of rationals.

        Raises NotCertifiedError where none are found, or one is too long for a proof.
        """
        starts = self._approximate()
        if any(self.flow.length(*start) > 2 * MAX_STEPS for start in starts):
            raise NotCertifiedError("not certified: a period of the motion's torus is too long for a proof.")
        return starts

    @cached_property
    def lattice(self) -> Lattice:
        """The `Lattice` of all periods, approximate, cached.

        Raises NotCertifiedError where none are found, again at each call.
        """
        if self._no_lattice:
            raise NotCertifiedError(self._no_lattice)
        try:
            return lattice(self.integrals)
        except NotCertifiedError as why:
            self._no_lattice = str(why)
            raise

    def _enclosed(self, start: tuple[fmpq, fmpq], bits: int) -> Period:
        """Return a proved `Period` near ``start``, (T_H, T_F), to ``bits`` binary digits.

        The start is first improved by Newton's method, with doubling bits. Raises NotCertifiedError where that does not
        converge, or the proof fails.
        """
        r, precision = start, bits if bits <= PERIOD_BITS else FIRST_FLOW_BITS
        while precision < bits:
            r, size = self._improved(r, precision)
            if not size < MAX_PERIOD_ERROR:
                raise NotCertifiedError("not certified: Newton's method does not find a period of the torus.")
            precision = 2 * precision - GUARD_BITS
        return self._proven(r, bits, self._coordinates())

    def _improved(self, r: tuple[fmpq, fmpq], precision: int) -> tuple[tuple[fmpq, fmpq], float]:
        """Return ((T_H, T_F) after a step of Newton's method from r, size of the step), to ``precision`` bits."""
        with workprec(precision + GUARD_BITS):
            step = self._newton(self.flow.go(*r, precision, proven=False), self.W, self.K, self._coordinates())
            H, F = (x.mid() for x in step)
            return (r[0] + H.fmpq(), r[1] + F.fmpq()), max(float(abs(H)), float(abs(F)))

    def _coordinates(self) -> tuple[int, int]:
        """Return the indices, 0 to 5, of the two components of (W, K) that best determine its position on the torus."""
        X, Y = ([float(arb(x).mid()) for x in row] for row in self.fields(self.W, self.K))
        return max(combinations(range(6), 2), key=lambda p: abs(X[p[0]] * Y[p[1]] - X[p[1]] * Y[p[0]]))

    def _newton(self, arrival: Arrival, W: Vector, K: Vector, chosen: tuple[int, int]) -> tuple[arb, arb]:
        """Return the Newton step, times (along H, along F/2) as balls, that takes an arrival y back to the start x.

        It solves the equations of the two components ``chosen``, -(X_H, X_F)^-1 (y - x), with the flows' rates X at
        W and K.
        """
        X, Y = self.fields(W, K)
        i, j = chosen
        state, start = [*arrival.W, *arrival.K], [*self.W, *self.K]
        f, g = (state[n] - start[n] for n in chosen)
        determinant = X[i] * Y[j] - X[j] * Y[i]
        return (g * Y[i] - f * Y[j]) / determinant, (f * X[j] - g * X[i]) / determinant

    def _proven(self, r: tuple[fmpq, fmpq], bits: int, chosen: tuple[int, int]) -> Period:
        """Return the proved `Period` near r = (T_H, T_F), to ``bits`` binary digits, by Newton's method in intervals.

        ``chosen`` are the indices of two components of the state that determine the position on the torus. Raises
        NotCertifiedError where the proof fails.
        """
        with workprec(bits + 2 * GUARD_BITS):
            arrival = self.flow.go(*r, bits + GUARD_BITS)
            step_1 = self._newton(arrival, self.W, self.K, chosen)
            reach = 4 * max((abs(x).upper() for x in step_1), key=float)
            box = arb(0, reach)
            X, Y = self.fields(arrival.W, arrival.K)
            y = [*arrival.W, *arrival.K]
            wide = [p + 2 * box * (abs(a) + abs(b)) + box for p, a, b in zip(y, X, Y, strict=True)]
            X, Y = self.fields(wide[:3], wide[3:])
            inside = all(w.contains_interior(p + box * a + box * b) for w, p, a, b in zip(wide, y, X, Y, strict=True))
            step = self._newton(arrival, wide[:3], wide[3:], chosen)
            if not (inside and all(box.contains_interior(x) for x in step) and self._are_told_apart(wide, chosen)):
                raise NotCertifiedError("not certified: that the motion's torus has this period could not be proved.")
            V = [(step[0] + step[1] * I) * w for w, I in zip(wide[:3], self.moments, strict=True)]
            q = rotated(arrival.q, V)
            b = arb(dot(self.K, self.K)).sqrt()
            line = dot(q[1:], [k / b for k in self.K])
            angle = 2 * arb.atan2(line, q[0])
            return Period(r[0] + step[0], r[1] + step[1], angle)

    def _are_told_apart(self, wide: list[arb], chosen: tuple[int, int]) -> bool:
        """Whether states from the start to ``wide`` with equal integrals and equal chosen components must be equal.

        ``wide`` are six balls W and K of states near the start, ``chosen`` two indices among the six components. It
        is proved by a determinant of the integrals' gradients that is not zero anywhere between; False says that
        this proof fails.
        """
        doubles = [arb(x).union(w) for x, w in zip((*self.W, *self.K), wide, strict=True)]
        W, K, J = doubles[:3], doubles[3:], self.moments
        D = J[0] * J[1] * J[2]
        M = [I * w for I, w in zip(J, W, strict=True)]
        gradients = [
            [*M, *(I * k for k, I in zip(K, J, strict=True))],
            [*(I * m for I, m in zip(J, M, strict=True)), *(-D * k / I for k, I in zip(K, J, strict=True))],
            [*(I * k for k, I in zip(K, J, strict=True)), *M],
            [arb(0)] * 3 + K,
        ]
        remaining = [n for n in range(6) if n not in chosen]
        return not arb_mat([[row[n] for n in remaining] for row in gradients]).det().contains(0)


def _signed(periods: list[tuple[fmpq, fmpq]]) -> list[tuple[fmpq, fmpq]]:
    """Return two periods (T_H, T_F), rationals, with the signs that make the frequencies f1 and f2 positive."""
    (H_1, F_1), (H_2, F_2) = periods
    area = H_1 * F_2 - H_2 * F_1
    signs = (1 if rate * area >= 0 else -1 for rate in (F_2, -F_1))
    return [(sign * H, sign * F) for sign, (H, F) in zip(signs, periods, strict=True)]


def frequencies(periods: Sequence[Period], b: arb) -> list[arb]:
    """Return [f1, f2, f3], balls in rad/time: f1, f2 of M and K, and f3 about the field of magnitude b.

    ``periods`` are two independent ones; f3 depends on the whole turns in their angles.
    """
    (period_1, period_2), turn = periods, 2 * arb.pi()
    area = period_1.H * period_2.F - period_1.F * period_2.H
    line = period_2.F / area, -period_1.F / area
    return [turn * line[0], turn * line[1], period_1.angle * line[0] + period_2.angle * line[1] - b]


def rotated(q: list[arb], V: list[arb]) -> list[arb]:
    """Return a unit quaternion q = (w, x, y, z) after unit time at the angular velocity V along the body's axes.

    V is three small balls about 0; the result, four balls, encloses all of these rotations.
    """
    radius = arb(0, sum((abs(x) for x in V), arb(0)).upper())
    w, *vector = (x + radius for x in q)  # wherever it is on the way
    rotated = [-dot(vector, V), *(w * x + y for x, y in zip(V, cross(vector, V), strict=True))]
    return [x + y / 2 for x, y in zip(q, rotated, strict=True)]
