"""The motion of a body with three moments by theta functions, at many times.

Times go to two phases of the torus and one about the field, each reduced to less than a turn without loss; on the torus
M, K and N = S^T (e_x + i e_y) are quotients of sums of exponentials, see `atlas.motions.torus.approximate_theta_sums`.
With x the phases in turns, n the whole ones that are left out of f t, and theta_k the angles of the periods,

    R^T (e_x + i e_y) = exp(i alpha) exp(-i theta x) N(x),    alpha = (theta f - b) t.
"""

from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
from flint import acb, arb, fmpq

from atlas.arithmetic.circle import signs
from atlas.arithmetic.grid import check_grid
from atlas.arithmetic.inputs import FloatArray, real
from atlas.arithmetic.lazy import cached_property
from atlas.arithmetic.numbers import workprec
from atlas.arithmetic.phase import EVEN, Phases, room
from atlas.arithmetic.quaternions import of_matrix, product
from atlas.arithmetic.rotation import BLOCK, combined, evaluate, target
from atlas.arithmetic.words import TURN, middle
from atlas.errors import NotCertifiedError
from atlas.motions.nutation.grid import moments
from atlas.motions.torus.approximate_periods import BITS, complex_of, matrix_of
from atlas.motions.torus.approximate_theta import ThetaMotion, frame
from atlas.motions.torus.approximate_theta_sums import HALF_TURN, Array, Sums, reciprocal, two_sum, wave
from atlas.motions.torus.certified import AsymmetricMotion
from atlas.motions.torus.certified_torus import Period, Torus, frequencies
from atlas.motions.torus.theta_rounding import D, Rounding

SUM_BLOCK = 768
"""Times whose sums are made at once, so that they stay in the second-level cache."""

UPPER_BITS = 24
"""Binary digits of upper words of angles and of their factors: sums of three of their products are exact."""

CUT = 1.5 * 2.0 ** (52 - UPPER_BITS)
"""Number whose addition and subtraction rounds another to 2^-24."""

ATTITUDE, VECTORS = slice(0, 7), slice(D, 10)
"""Places of the forms of R, and of K and W, each with the denominator."""

PERIOD_BITS = 160
"""Bits to which the real periods are proved."""

MAX_MISFIT = 1e-36
"""Largest misfit of theta functions that are taken before they are proved or held against the certified twin."""

MAX_PROVEN_ERROR = 2.0**-54
"""Largest bound on errors of the formulas that is a proof of them."""

RIEMANN_ZERO = 1e-35
"""Size below which a part of the Riemann matrix, known to some forty digits, is shown as zero."""

MAX_ROUNDING = 2e-13
"""Largest bound on rounding errors: those that are seen are some twenty times smaller."""


SIZES, NEIGHBOURS = (32, 64, 128, 256, 512), 0.5
"""Cells along a side of a table of quaternions, and the largest squared distance of two that are neighbours."""


class Constants:
    """Constants of a motion to some forty digits: `forms` of N, D, K and W, `ways` (3, 2), `frequencies`, `frame`.

    `ways` times half the phases gives the two arguments of the forms and the angle by which N turns; `frequencies`
    are f1, f2, f3 in rad/time. `frame` are e_x, e_y and B'/b^2: R is the sum of their products with Re N, Im N and
    K. ``rate`` is the unit of 1/time of ``theta`` and ``torus``; `b` and `periods` are in that unit.
    """

    def __init__(self, theta: ThetaMotion, torus: Torus, rate: fmpq) -> None:
        with workprec(BITS):
            motion, X = theta.motion, theta.X.inv()
            self.b = arb(motion.square).sqrt()
            periods = [Period(H.real, F.real, -self.b * T_c.real) for H, F, T_c in theta.lattice.real]
            if not theta.misfit < MAX_MISFIT:
                periods = [Period(p.H.mid(), p.F.mid(), p.angle.mid()) for p in torus.periods(PERIOD_BITS)]
            to_ways = [[X[i, 0] * p.H + X[i, 1] * p.F for p in periods] for i in range(2)]
            lines = [theta.l[0] * to_ways[0][k] + theta.l[1] * to_ways[1][k] for k in range(2)]
            # the angles of the periods are known but for whole turns
            angles = [
                p.angle + TURN * round(float(((x.real - p.angle) / TURN).mid()))
                for p, x in zip(periods, lines, strict=True)
            ]  # those nearest to the angles of N
            self.periods = [replace(p, angle=angle) for p, angle in zip(periods, angles, strict=True)]
            self.frequencies = [x * rate for x in frequencies(self.periods, self.b)]
            turning = [(x - a) / arb.pi() for x, a in zip(lines, angles, strict=True)]
            self.ways = [[2 * x for x in to_ways[0]], to_ways[1], turning]
            self.hat, self.start = theta.hat, (2 * theta.start[0], theta.start[1])
            *forms, M1, M2, M3 = theta.forms
            self.forms = [*forms, *(x.over(I) for x, I in zip((M1, M2, M3), motion.moments, strict=True))]
            self.frame = [*frame(theta.field), [x / arb(motion.square) for x in theta.field]]


class ThetaKernel:
    """R, K and W = II^-1 M of one motion at arrays of times, by theta functions.

    ``theta`` are its functions, ``torus`` proves its periods. `rate` is the unit of 1/time, `size` the largest rate
    in that unit. `accuracy` bounds rounding errors, `proved` the errors of the formulas without rounding, at any
    time: None where there is no proof. Both are computed when first asked for.
    """

    def __init__(self, theta: ThetaMotion, torus: Torus, rate: fmpq, size: float) -> None:
        self.made_of = theta, torus
        self.constants = Constants(theta, torus, rate)
        with workprec(BITS):
            self.periods, self.frequencies, ways = (
                self.constants.periods, self.constants.frequencies, self.constants.ways,
            )  # fmt: skip
            self.phases = Phases([middle(x / TURN) for x in self.frequencies], rounder=EVEN)
            rounded: Array = np.array([[complex_of(x) for x in row] for row in ways])
            unit = 2.0 ** (np.ceil(np.log2(max(abs(rounded).max(), 2.0))) - UPPER_BITS)
            self.upper: Array = np.column_stack([np.round(rounded / unit) * unit, [0.0, 0.0, 2.0]])
            self.lower = np.zeros_like(self.upper)
            for i, j in np.ndindex(rounded.shape):
                self.lower[i, j] = complex_of(ways[i][j] - acb(self.upper[i, j]))
            self.ways: Array = self.lower + self.upper
            line = np.linspace(-HALF_TURN * np.pi, HALF_TURN * np.pi, 13)
            region = np.stack(np.meshgrid(line, line), 0).reshape(2, -1)
            self.sums = Sums(self.constants.hat, self.constants.forms, self.constants.start, rounded[:2] @ region)
            ex, ey, n = ([float(arb(x).mid()) for x in e] for e in self.constants.frame)
            b = float(self.constants.b.mid())
        self.rate, self.axis = int(rate.p) / int(rate.q), np.array(n) * b
        self.size = size / self.rate
        self.entries = np.array([np.outer(e, np.eye(3)[j]).ravel() for e in (ex, ey, n) for j in range(3)])
        self.rounding = Rounding(self.sums, rounded[:2], rounded[2], b, self.size)
        tau = matrix_of(theta.tau)
        self.riemann_matrix = np.where(abs(tau.real) < RIEMANN_ZERO, 0, tau.real) + 1j * np.where(
            abs(tau.imag) < RIEMANN_ZERO, 0, tau.imag
        )

    @property
    def fits(self) -> bool:
        """Whether the misfit of the linear fits behind the constants is below `MAX_MISFIT`."""
        return self.made_of[0].misfit < MAX_MISFIT

    @cached_property
    def accuracy(self) -> float:
        """Bound on rounding errors, to first order, at all phases.

        It is for entries of R, and for K and Omega relative to the largest rate.
        """
        return self.rounding.accuracy()

    @cached_property
    def proved(self) -> float | None:
        """Bound on the errors of the formulas at any time up to phases of 2^50; None where no bound is proved.

        It is for the entries of R, and for K and Omega relative to the largest rate, without rounding.
        """
        from atlas.motions.torus.certified_distances import distances, drifts

        theta, torus = self.made_of
        if torus.is_long:
            return None
        try:
            periods = torus.periods(PERIOD_BITS)
            M, K, N = distances(theta, torus, periods) + drifts(theta, periods, self.periods)
        except NotCertifiedError:
            return None
        error = max(N + K / float(self.constants.b.mid()), (K + M / float(arb(min(torus.moments)).mid())) / self.size)
        return error if error <= MAX_PROVEN_ERROR else None

    def rotation(self, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return R(t), body to laboratory, shape t.shape + (3, 3); ``out``, if given, is filled and returned."""
        return self._evaluate(ATTITUDE, self.entries, t, (3, 3), out)

    def column(self, j: int, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return column j = 1, 2 or 3 of R(t), the body's axis j in the laboratory, shape t.shape + (3,).

        ``out``, if given, is filled and returned. Raises DomainError for a time that is not finite.
        """
        return self._evaluate(ATTITUDE, self.entries[:, j - 1 :: 3], t, (3,), out)

    def field_in_body(self, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return K(t) along the body's axes, shape t.shape + (3,), in 1/time.

        ``out``, if given, is filled and returned.
        """
        return self._evaluate(slice(D, 7), self.rate * np.eye(3), t, (3,), out)

    def angular_velocity(self, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return Omega(t) = W - K along the body's axes, shape t.shape + (3,), in rad/time.

        ``out``, if given, is filled and returned.
        """
        return self._evaluate(VECTORS, self.rate * np.concatenate([-np.eye(3), np.eye(3)]), t, (3,), out)

    def _evaluate(
        self, forms: slice, weights: FloatArray, t: Any, shape: tuple[int, ...], out: FloatArray | None
    ) -> FloatArray:
        """Return ``weights`` times the `_functions` of ``forms`` at times t, shape t.shape + ``shape``.

        ``forms`` is a slice of the ten forms, ``weights`` (k, prod(shape)) belong to its k functions. ``out``, if
        given, is filled and returned.
        """
        times = real(t, "The time")
        if times.size != 1:
            return evaluate(times, shape, out, lambda _: partial(self._fill, forms, weights))
        out = target(out, times.shape + shape)
        half, low_word = np.array(self.phases.words_of_one(times.item()))
        np.matmul(self._functions(half, low_word, forms), weights, out=out.reshape(-1))
        return out

    def fill_grid(self, start: float, step: float, out: FloatArray) -> None:
        """Fill `out` (count, 3, 3) with R at the exact real numbers start + i step."""
        count, rows = len(out), out.reshape(-1, 9)
        check_grid(start, step, count, self.phases.reach)
        for i in range(0, count, BLOCK):
            index = np.arange(float(i), float(min(i + BLOCK, count)))
            t, low = moments(self.phases, start, step, index)
            self._fill(ATTITUDE, self.entries, t, rows[i : i + BLOCK], low)

    def on_torus(self, phases: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return (S (m, 3, 3), Omega (m, 3), K (m, 3)) at phases (2, m) in rad, R(t) = R_B(f3 t) S(f1 t, f2 t).

        Omega is in rad/time, K in 1/time. f3 is defined up to multiples of f1 and f2: it is that of
        `AsymmetricMotion.frequencies` in `certified`, and differs from the third of `frequencies` by whole turns of
        the `angle` of each `Period`.
        """
        half = np.concatenate([(phases + np.pi) % (2 * np.pi) - np.pi, np.zeros((1, phases.shape[1]))]) / 2
        for x, period in zip(half[:2], self.periods, strict=True):
            half[2] += x * round(float(period.angle.mid()) / (2 * np.pi))
        R, low_word = np.empty((phases.shape[1], 9)), np.zeros_like(half)
        combined(self._rows(half, low_word, ATTITUDE), self.entries, R)
        K, W = np.split(self.rate * self._rows(half, low_word, VECTORS).T, 2, axis=1)
        return R.reshape(-1, 3, 3), W - K, K

    def _fill(
        self, forms: slice, weights: FloatArray, t: FloatArray, rows: FloatArray, low: FloatArray | None = None
    ) -> None:
        """Write the `_functions` of ``forms`` times ``weights`` at times t + low (m,) into rows (m, n).

        See `_evaluate`; `low` may be None.
        """
        half, low_word, _ = self._phases(t, low)
        combined(self._rows(half, low_word, forms), weights, rows)

    def _rows(self, half: FloatArray, low_word: FloatArray, forms: slice) -> FloatArray:
        """Return the `_functions` (k, m) of ``forms`` at half phases ``half`` + ``low_word``, (3, m) each.

        They are evaluated in blocks of times.
        """
        if half.shape[1] == 1:
            return self._functions(half[:, 0], low_word[:, 0], forms)[:, None]
        blocks = [slice(i, i + SUM_BLOCK) for i in range(0, half.shape[1], SUM_BLOCK)]
        return np.concatenate([self._functions(half[:, x], low_word[:, x], forms) for x in blocks], axis=1)

    def _functions(self, half: FloatArray, low_word: FloatArray, forms: slice) -> FloatArray:
        """Return [Re N, Im N, K, W], three components of each that is among ``forms``, (k, m) at m times, (k,) at one.

        They are those at half phases ``half`` + ``low_word``, (3, m) or (3,) each, in rad.
        """
        upper = half + CUT - CUT
        x, low = two_sum(self.upper @ upper, self.ways @ (half - upper + low_word) + self.lower @ upper)
        sums = (self.sums.at if half.ndim > 1 else self.sums.at_one)(x[:2], low[:2], forms)
        place = D - forms.start
        inverse = reciprocal(sums[place])
        vectors = sums[place + 1 :]
        functions: FloatArray = vectors.real * inverse.real - vectors.imag * inverse.imag
        if not place:
            return functions
        N = sums[:place] * (wave(x[2], low[2]) * inverse)
        return np.concatenate([N.real, N.imag, functions])

    def quaternion(self, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return the quaternion (x, y, z, w) of R(t), continuous in t with w >= 0 at t = 0, shape t.shape + (4,).

        ``out``, if given, is filled and returned. Raises NotCertifiedError where the sign is not decided.
        """
        return evaluate(real(t, "The time"), (4,), out, lambda _: self._fill_quaternions)

    def _fill_quaternions(self, t: FloatArray, rows: FloatArray) -> None:
        """Write the quaternions (x, y, z, w) of R(t) at times t (m,) into rows (m, 4), continuous over the torus."""
        table, steps = self._lift
        half, low_word, turns = self._phases(t)
        quaternions = self._quaternions(half, low_word)
        index = np.rint((half[:2] / np.pi + 0.5) * (len(table) - 1)).astype(int).clip(0, len(table) - 1)
        reference = product(self._turn(half[2]), table[index[0], index[1]])
        np.multiply(quaternions, np.sign((quaternions * reference).sum(-1, keepdims=True)), out=rows)
        rows *= (signs(turns) ** steps).prod(axis=0)[:, None]

    def _quaternions(self, half: FloatArray, low_word: FloatArray) -> FloatArray:
        """Return a quaternion (x, y, z, w) of R, (m, 4), of either sign, at m half phases.

        These are ``half`` + ``low_word``, (3, m) each, in rad.
        """
        R = np.empty((half.shape[1], 9))
        combined(self._rows(half, low_word, ATTITUDE), self.entries, R)
        return of_matrix(R.reshape(-1, 3, 3))

    def _turn(self, half: FloatArray) -> FloatArray:
        """Return the quaternions (x, y, z, w), (m, 4), of turns about the field by twice the angles ``half`` (m,)."""
        return np.append(np.outer(np.sin(half), self.axis), np.cos(half)[:, None], axis=-1)

    @cached_property
    def _lift(self) -> tuple[FloatArray, FloatArray]:
        """Tuple (table of continuous quaternions (n, n, 4) over half the phases, signs of three turns).

        Half the phases reach from -pi/2 to pi/2. The second is an integer array (3, 1): 1 for a turn that changes the
        quaternion's sign, else 0. Raises NotCertifiedError where the sign is not decided on the finest table.
        """
        for size in SIZES:
            line = np.linspace(-np.pi / 2, np.pi / 2, size + 1)
            half = np.array([*np.meshgrid(line, line, indexing="ij"), np.zeros((size + 1, size + 1))]).reshape(3, -1)
            table = self._quaternions(half, np.zeros_like(half)).reshape(size + 1, size + 1, 4)
            table[0] = _joined(table[0])
            table = _joined(table)
            if max((np.diff(table, axis=k) ** 2).sum(-1).max() for k in (0, 1)) < NEIGHBOURS:
                break
        else:
            raise NotCertifiedError("not certified: the sign of a quaternion changes too fast over the torus.")
        table *= np.sign(table[size // 2, size // 2, 3])
        steps = [bool(table[0, 0] @ end < 0) for end in (table[-1, 0], table[0, -1])]
        return table, np.array([*steps, True], dtype=int)[:, None]

    def _phases(self, t: FloatArray, low: FloatArray | None = None) -> tuple[FloatArray, ...]:
        """Return (half the phases less half turns left out, rounding errors, half turns + `rounder`), (3, m) each.

        The first two are in rad, at times t + low (m,); `low` may be None. Raises AtlasError for a phase beyond
        MAX_PHASE.
        """
        return self.phases.reduced(t, room(3, t.size), low)[:3]


def _joined(q: FloatArray) -> FloatArray:
    """Return quaternions q (n, ..., 4), some negated so that each is less than a half turn from the row before."""
    signs = np.sign((q[1:] * q[:-1]).sum(-1, keepdims=True))
    return np.concatenate([q[:1], q[1:] * np.cumprod(signs, axis=0)])


def closed_form(exact: AsymmetricMotion, size: float) -> ThetaKernel:
    """Return the `ThetaKernel` of the motion ``exact`` on a torus, whose largest rate is ``size``, in 1/time.

    Raises NotCertifiedError, with the reason, where theta functions are missing or rounding would be too large.
    """
    motion = exact.on_torus
    if motion is None:
        raise NotCertifiedError(f"not certified: the kind of motion is {exact.kind!r}, not 'on a torus'.")
    torus = motion.torus
    if torus.spin is not None:
        raise NotCertifiedError("not certified: next to a spin along the field theta functions lose their digits.")
    try:
        theta = ThetaMotion(torus.integrals, torus.W, torus.K, torus.lattice)
        kernel = ThetaKernel(theta, torus, motion.rate, size)
    except NotCertifiedError:
        raise
    except (ArithmeticError, ValueError, np.linalg.LinAlgError) as error:
        raise NotCertifiedError("not certified: constants of the motion's torus are infinite or singular.") from error
    if not kernel.rounding.accuracy(MAX_ROUNDING) <= MAX_ROUNDING:
        raise NotCertifiedError(f"not certified: rounding would be wrong by up to {kernel.accuracy:.1e} in its sums.")
    return kernel
