"""The flow of a H + g F/2 on W = II^-1 M and K with the attitude it turns, by Taylor series, with a proven error.

    W_i' = -(I_j - I_k) [(a/I_i + g) K_j K_k - (a/I_i) W_j W_k],    V_i = (a + g I_i) W_i,
    K' = [K, V],    q' = q V/2 (a quaternion, scalar first; S' = S V^)

with (i, j, k) cyclic; for a = 1, g = 0 this is the motion as seen from Larmor's frame.
Numbers are integers in units of 2^-bits, and a step is any polynomial p(x), x from 0 to 1: its error follows
from its defect p' - h f(p), which is computed exactly. How errors of W and K grow from step to step follows from a
fundamental matrix, which floats give well enough: with e = X w,

    w(n+1) = w(n) + X(n+1)^-1 [(J X(n) - X(n+1)) w(n) + error of the step],

J the derivative of the step's flow, known to some ten digits, so that w hardly grows at all; each component of w has a
bound of its own, and X begins anew with orthogonal columns where they become nearly dependent. q, of length 1, takes up
half the errors of V, and its own.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice
from math import exp, inf, sqrt
from operator import mul

import numpy as np
from flint import arb, fmpq, fmpz, fmpz_poly
from numpy.typing import NDArray

from atlas.arithmetic.numbers import workprec
from atlas.errors import NotCertifiedError

Matrix = NDArray[np.float64]
Series = list[list[int]]
Rates = tuple[list[fmpq], list[fmpq], list[fmpq]]

TERMS_PER_BIT = 0.27
"""Terms of a series for each bit: a step is so short that the last one is less than a unit."""

PARTS = 1 << 20
"""The whole way is cut into steps that are multiples of this part."""

TERMS = 40
"""Terms of the derivative of a step, in floats."""

ROUNDING = 1e-12
"""Bound on the rounding errors of sums and products of floats in a step, as a part of the sums of their sizes."""

MAX_PRECISION, MIN_FLINT_PRECISION = 4000, 400
"""Binary digits beyond which a step takes too long, and those from which flint's integers are faster than Python's."""

MAX_STEPS = 4000
"""Steps of a way; a longer one is not gone."""

MIN_COEFFICIENT_BITS = 8
"""Binary digits of a coefficient above which rounding does not matter to its size."""

MAX_LIPSCHITZ = 8.0
"""Largest Lipschitz constant of the right-hand side times a step: TERMS give its derivative, and errors little room."""

MAX_CONDITION = 1e8
"""Largest condition number of a matrix of errors."""

BLOCK = 16
"""Coefficients of a block that are summed one by one."""

CYCLE = ((1, 2), (2, 0), (0, 1))

PRODUCTS = (
    *((j, k) for j, k in CYCLE),  # W_j W_k
    *((3 + j, 3 + k) for j, k in CYCLE),  # K_j K_k
    *((3 + j, 10 + k) for j, k in CYCLE),  # K_j U_k, U = V
    *((3 + k, 10 + j) for j, k in CYCLE),
    *((7 + i, 10 + i) for i in range(3)),  # q_i U_i
    *((6, 10 + i) for i in range(3)),  # q_0 U_i
    *((7 + j, 10 + k) for j, k in CYCLE),
    *((7 + k, 10 + j) for j, k in CYCLE),
)
"""Products of which the right-hand sides consist: rows are W, K, q and U, (i, j, k) cyclic."""


@dataclass(frozen=True)
class Arrival:
    """State after a flow, as balls: W = Omega + K, K, and the quaternion q = (w, x, y, z) of the rotation S.

    W and K are three balls each along the body's axes, in the unit of the flow; q has length 1 up to its radius.
    """

    W: list[arb]
    K: list[arb]
    q: list[arb]


class GrowthError(NotCertifiedError):
    """Errors of Taylor's series exceed their bounds: more bits give wider bounds."""


class _Way:
    """Integration of a flow in progress: the current state in integers, and the bound on its error.

    ``rates`` are those of `Flow.rates`, ``start`` the six numbers W, K in units of 2^-``bits``, and ``first_step`` the
    first step that is tried, in `PARTS`. `state` has W, K and q, ten integers, `remaining` the part of the
    way not gone, in `PARTS`. Without ``proven`` no errors are bounded.
    """

    def __init__(self, rates: Rates, start: list[int], bits: int, first_step: int, *, proven: bool) -> None:
        self.rates, self.bits, self.proven = rates, bits, proven
        self.state = [*start, 1 << bits, 0, 0, 0]
        self.remaining, self.steps = PARTS, 0
        self.guess = first_step
        self.order = max(12, int(TERMS_PER_BIT * bits))
        self.X: Matrix = np.eye(6)
        self.w: Matrix = np.ones(6)  # the start is rounded
        self.q_error = 1.0
        self.rows: Series = []
        self.error_in_step = 0.0

    def step(self) -> None:
        """Go one step of Taylor's series, as long as its terms and error bounds allow.

        Raises NotCertifiedError beyond `MAX_STEPS`, GrowthError where errors grow too much.
        """
        self.steps += 1
        if self.steps > MAX_STEPS:
            raise NotCertifiedError(f"not certified: more than {MAX_STEPS} steps of Taylor's series would be needed.")
        h = fmpq(self.guess, PARTS)
        rows = self._series(h)
        sizes = [max(abs(row[n]) for row in rows).bit_length() for n in range(self.order + 1)]
        last_term = max((n for n, size in enumerate(sizes) if size > MIN_COEFFICIENT_BITS), default=0)
        falls = (sizes[0] - sizes[last_term]) / last_term if last_term else 2.0 * sizes[0]
        scale = 2.0 ** min(1.0, falls - sizes[0] / self.order)  # the last terms become a unit
        step_parts = max(
            1, min(self.remaining, int(self.guess * min(1.0, scale)))
        )  # larger ones would swell the roundings
        factor = fmpq(step_parts, self.guess)
        rows = [_scaled(row, factor) for row in rows]
        if self.proven and (lipschitz := self._sizes(rows, fmpq(step_parts, PARTS))[3]) > MAX_LIPSCHITZ:
            factor = fmpq(max(1, int(step_parts * MAX_LIPSCHITZ / lipschitz)), step_parts)
            step_parts, rows = int(step_parts * factor), [_scaled(row, factor) for row in rows]
        if self.proven:
            self._account(rows, fmpq(step_parts, PARTS))
        self.rows = rows
        self.state = [sum(row) for row in rows]
        self.remaining -= step_parts
        self.guess = max(1, min(PARTS, int(self.guess * scale)))

    def _scaled_rates(self, h: fmpq) -> tuple[list[int], ...]:
        """Return the three rows of rates times h, lists of three integers in units of 2^-bits."""
        return tuple([_units(h * x, self.bits) for x in row] for row in self.rates)

    def _series(self, h: fmpq) -> Series:
        """Return Taylor coefficients of W, K and q over a step h: ten lists of integers in units of 2^-bits."""
        b = self.bits
        V, w_rates, k_rates = self._scaled_rates(h)
        rows = [[x] for x in (*self.state, *(v * w >> b for v, w in zip(V, self.state, strict=False)))]
        for n, c in enumerate(_products(rows, self.order, BLOCK if b >= MIN_FLINT_PRECISION else self.order)):
            for i in range(3):
                rows[i].append((w_rates[i] * c[i] + k_rates[i] * c[3 + i]) // ((n + 1) << 2 * b))
                rows[3 + i].append((c[6 + i] - c[9 + i]) // ((n + 1) << b))
                rows[7 + i].append((c[15 + i] + c[18 + i] - c[21 + i]) // ((n + 1) << b + 1))
                rows[10 + i].append(V[i] * rows[i][-1] >> b)
            rows[6].append(-(c[12] + c[13] + c[14]) // ((n + 1) << b + 1))
        return rows[:10]

    def _account(self, rows: Series, h: fmpq) -> None:
        """Add the errors of a step h with the Taylor coefficients ``rows`` to the bounds `X`, `w` and `q_error`.

        Raises NotCertifiedError for a step too long, GrowthError for errors that grow too much.
        """
        W, K, size_V, lipschitz, bend = self._sizes(rows, h)
        if not lipschitz < 2 * MAX_LIPSCHITZ:
            raise NotCertifiedError("not certified: a step of Taylor's series is too long for a bound on its error.")
        state, turn = self._defect(rows, h, W, K)
        spread = exp(lipschitz)
        J, eta = self._derivative(rows, h, spread)
        before = float(np.linalg.norm(abs(self.X) @ self.w))
        if not before * spread * sqrt(bend) < 2.0 ** (self.bits / 2):
            raise GrowthError("not certified: the errors of Taylor's series grow beyond their bounds.")
        added = state * spread + len(rows[0]) * 6 + 1  # the 1 is for terms of second order, bend (before spread)^2 / 2
        if not np.linalg.cond(J @ self.X) < MAX_CONDITION:
            self._straighten()
        following: Matrix = J @ self.X
        self.error_in_step = (before + added) * spread
        self.w = self.w + _inverse_rows(following) * ((eta + ROUNDING * np.linalg.norm(J)) * before + added)
        self.X = following
        self.q_error += turn + len(rows[0]) * 4 + size_V * (before + added) * spread

    def _straighten(self) -> None:
        """Enclose the box X w of the errors by one with orthogonal edges, the longest first (Lohner).

        So X stays invertible in floats where errors grow in one direction and shrink in another.
        """
        longest_first = np.argsort(-np.linalg.norm(self.X, axis=0) * self.w)
        Q, R = np.linalg.qr(self.X[:, longest_first])
        edges = abs(R) @ self.w[longest_first]
        self.X, self.w = Q, 1.01 * edges + ROUNDING * edges.max()

    def _sizes(self, rows: Series, h: fmpq) -> tuple[float, float, float, float, float]:
        """Return five bounds: |W| and |K| in the step, h max|V_i/W_i|, the Lipschitz constant and second derivatives.

        The last two are of the right-hand side times h, the length of the step; ``rows`` are its Taylor coefficients.
        """
        size = [_float(sum(map(abs, row)), self.bits) for row in rows[:6]]
        W, K = 1.01 * sqrt(sum(x * x for x in size[:3])), 1.01 * sqrt(sum(x * x for x in size[3:]))
        V_rate, w_rates, k_rates = (1.01 * max(abs(float(h * x)) for x in row) for row in self.rates)
        return W, K, V_rate, 2 * w_rates * W + 2 * k_rates * K + V_rate * (W + K), 2 * (w_rates + k_rates + V_rate)

    def _defect(self, rows: Series, h: fmpq, W: float, K: float) -> tuple[float, float]:
        """Return two bounds, in units of 2^-bits, on p' - h f(p) over the step: of (W, K) together, and of q.

        p are the polynomials with coefficients ``rows``, h is the length of the step, W and K bound |W| and |K| there.
        """
        b = self.bits
        V, w_rates, k_rates = self._scaled_rates(h)
        p = [fmpz_poly(row) for row in rows]
        p += [v * x for v, x in zip(V, p, strict=False)]  # U in units of 2^-2b
        c = [p[x] * p[y] for x, y in PRODUCTS]
        unit = 1 << 2 * b
        defects = [_size(p[i].derivative() * unit - w_rates[i] * c[i] - k_rates[i] * c[3 + i], 2 * b) for i in range(3)]
        defects += [_size(p[3 + i].derivative() * unit - c[6 + i] + c[9 + i], 2 * b) for i in range(3)]
        turn = [_size(p[6].derivative() * (2 * unit) + c[12] + c[13] + c[14], 2 * b + 1)]
        turn += [
            _size(p[7 + i].derivative() * (2 * unit) - c[15 + i] - c[18 + i] + c[21 + i], 2 * b + 1) for i in range(3)
        ]
        rounded = 4 * (W + K) * (W + K) + 4  # the rates are rounded to a unit
        return 1.01 * (sqrt(sum(x * x for x in defects)) + rounded), 1.01 * (sqrt(sum(x * x for x in turn)) + 4 * W + 4)

    def _derivative(self, rows: Series, h: fmpq, spread: float) -> tuple[Matrix, float]:
        """Return (derivative (6, 6) of the step's flow of (W, K) by its start, a bound on its error in norm).

        ``rows`` are the step's Taylor coefficients, ``h`` is its length, ``spread`` the factor by which an error
        may grow in the step.
        """
        floats = np.array([[_float(x, self.bits) for x in row] for row in rows[:6]])
        changes = jacobian(floats, *(np.array([float(h * x) for x in row]) for row in self.rates))
        terms = min(TERMS, len(changes))
        X = np.zeros((terms, 6, 6))
        X[0] = np.eye(6)
        for n in range(terms - 1):
            X[n + 1] = np.einsum("nij,njk->ik", changes[: n + 1], X[n::-1]) / (n + 1)
        sizes_J, sizes_X = np.linalg.norm(changes, axis=(1, 2)), np.linalg.norm(X, axis=(1, 2))
        product = np.convolve(sizes_J, sizes_X)
        defect = float(product[terms - 1 :].sum()) + 10 * ROUNDING * float(product.sum())
        return X.sum(axis=0), 1.01 * defect * spread + ROUNDING * float(sizes_X.sum())

    def arrival(self) -> Arrival:
        """Return the current state as an `Arrival`, with radius 0 unless `proven`."""
        error = abs(self.X) @ self.w * 1.01
        errors = [*(error * self.proven).tolist()] + [self.q_error * 1.01 * self.proven] * 4
        balls = [_ball(x, e, self.bits) for x, e in zip(self.state, errors, strict=True)]
        return Arrival(balls[:3], balls[3:6], balls[6:])

    def passed(self, fraction: fmpq) -> Arrival:
        """Return the state at a ``fraction``, 0 to 1, of the last step as an `Arrival`.

        Its radii are the error of the whole step.
        """
        state = [int(fmpz_poly(row)(fraction).floor()) for row in self.rows]
        errors = [1.01 * self.error_in_step + 1] * 6 + [1.01 * self.q_error + 1] * 4
        balls = [_ball(x, e, self.bits) for x, e in zip(state, errors, strict=True)]
        return Arrival(balls[:3], balls[3:6], balls[6:])


class Flow:
    """Flows of H and F/2 from a state (W, K) with rational components, of a body with rational moments.

    W = Omega + K and K are along the principal axes.
    """

    def __init__(self, moments: Sequence[fmpq], W: Sequence[fmpq], K: Sequence[fmpq]) -> None:
        self.moments = list(moments)
        self.start = [*W, *K]

    def rates(self, a: fmpq, g: fmpq) -> Rates:
        """Return coefficients of the flow of a H + g F/2, three lists of three rationals.

        They are V_i/W_i of the angular velocity V, and the factors of W_j W_k and of K_j K_k in the rate of W_i.
        """
        I = self.moments
        moment_ratios = [(I[j] - I[k]) / I[i] for i, (j, k) in enumerate(CYCLE)]
        return (
            [a + g * x for x in I],
            [a * x for x in moment_ratios],
            [-(a + g * x) * y for x, y in zip(I, moment_ratios, strict=True)],
        )

    def length(self, a: fmpq, g: fmpq) -> float:
        """Return the largest coefficient of the flow of a H + g F/2 times the size of (W, K), dimensionless.

        A unit of this length takes one to five steps.
        """
        return float(max(abs(x) for row in self.rates(a, g) for x in row)) * float(sum(abs(x) for x in self.start))

    def go(self, a: fmpq, g: fmpq, bits: int, *, proven: bool = True) -> Arrival:
        """Return the state of the flow of a H + g F/2 at time 1 as an `Arrival`, with radius 0 unless ``proven``.

        ``bits`` is the number of binary digits. Raises NotCertifiedError where that would take too many steps, or
        digits, or the error cannot be bounded.
        """
        if bits > MAX_PRECISION:
            raise NotCertifiedError(
                f"not certified: so many digits would take more than {MAX_PRECISION} binary ones; of three moments "
                "some 1000 decimal ones can be had, fewer of numbers near zero."
            )
        way = self._way(a, g, bits, proven=proven)
        while way.remaining:
            way.step()
        with workprec(2 * bits):
            return way.arrival()

    def pass_by(self, a: fmpq, fractions: Sequence[fmpq], bits: int) -> Iterator[Arrival]:
        """Yield an `Arrival` of the flow of a H at each of ascending ``fractions`` in (0, 1] of its time.

        ``bits`` is the number of binary digits; the integration goes one path. Raises NotCertifiedError, as `go`
        does, where the integration cannot continue.
        """
        way, k = self._way(a, fmpq(0), bits, proven=True), 0
        while k < len(fractions):
            start = PARTS - way.remaining
            way.step()
            while k < len(fractions) and fractions[k] * PARTS <= PARTS - way.remaining:
                with workprec(2 * bits):
                    arrival = way.passed((fractions[k] * PARTS - start) / (PARTS - way.remaining - start))
                yield arrival
                k += 1

    def _way(self, a: fmpq, g: fmpq, bits: int, *, proven: bool) -> _Way:
        guess = max(1, min(PARTS, int(PARTS / max(self.length(a, g), 1e-9))))
        return _Way(self.rates(a, g), [_units(x, bits) for x in self.start], bits, guess, proven=proven)


def _products(rows: Series, count: int, shortest_block: int) -> Iterator[list[int]]:
    """Yield the coefficients 0 to ``count`` - 1 of PRODUCTS, lists of integers, from the coefficients of `rows` so far.

    The caller appends a coefficient to each row after each item. In blocks longer than ``shortest_block``, the
    contribution of the first half to the second is one product of polynomials.
    """
    size = shortest_block
    while size < count:
        size *= 2
    sums = [[0] * size for _ in PRODUCTS]

    def block(start: int, stop: int) -> Iterator[list[int]]:
        if stop - start <= shortest_block:
            for n in range(start, stop):
                back = [row[n - start :: -1] for row in rows]
                for total, (x, y) in zip(sums, PRODUCTS, strict=True):
                    total[n] += sum(map(mul, rows[x][start:], back[y]))
                    if start:
                        total[n] += sum(map(mul, rows[y][start:], back[x]))
                yield [total[n] for total in sums]
            return
        middle = (start + stop) // 2
        yield from block(start, middle)
        factors = [fmpz_poly(row[start:middle]) for row in rows]
        lower_factors = [fmpz_poly(row[: stop - start]) for row in rows] if start else factors
        for total, (x, y) in zip(sums, PRODUCTS, strict=True):
            product = factors[x] * lower_factors[y] + (factors[y] * lower_factors[x] if start else 0)
            for n in range(middle, stop):
                total[n] += product[n - start]
        yield from block(middle, stop)

    yield from islice(block(0, size), count)


def jacobian(state: Matrix, V: Matrix, w_rates: Matrix, k_rates: Matrix) -> Matrix:
    """Return the Taylor coefficients (terms, 6, 6) of the derivative of the right-hand side, times h, by (W, K).

    ``state`` (6, terms) are the coefficients of W and K in a step of length h. ``V``, ``w_rates`` and ``k_rates``, (3,)
    each, are the three rows of `Flow.rates` times h.
    """
    W, K = state[:3], state[3:]
    J = np.zeros((state.shape[1], 6, 6))
    for i, (j, k) in enumerate(CYCLE):
        J[:, i, j], J[:, i, k] = w_rates[i] * W[k], w_rates[i] * W[j]
        J[:, i, 3 + j], J[:, i, 3 + k] = k_rates[i] * K[k], k_rates[i] * K[j]
        J[:, 3 + i, 3 + j], J[:, 3 + i, 3 + k] = V[k] * W[k], -V[j] * W[j]
        J[:, 3 + i, k], J[:, 3 + i, j] = V[k] * K[j], -V[j] * K[k]
    return J


def _inverse_rows(X: Matrix) -> Matrix:
    """Return bounds (6,) on the norms of the rows of X^-1. Raises NotCertifiedError for a nearly singular X."""
    try:
        Y = np.linalg.inv(X)
    except np.linalg.LinAlgError as error:
        raise NotCertifiedError("not certified: the errors of Taylor's series cannot be bounded.") from error
    unit_defect = float(np.linalg.norm(np.eye(6) - Y @ X)) + ROUNDING * float(np.linalg.norm(X) * np.linalg.norm(Y))
    if not unit_defect < 0.5:
        raise NotCertifiedError("not certified: the errors of Taylor's series cannot be bounded.")
    rows = np.linalg.norm(Y, axis=1)
    return np.asarray(1.01 * (rows + unit_defect / (1 - unit_defect) * rows.max() * 6))


def _units(x: fmpq, bits: int) -> int:
    units = (int(x.p) << bits) // int(x.q)
    return units if bits < MIN_FLINT_PRECISION else fmpz(units)


def _scaled(row: list[int], factor: fmpq) -> list[int]:
    """Return the integer coefficients of p(factor x), rounded down, from the ``row`` of coefficients of p(x)."""
    if factor == 1:
        return row
    p, q, powers, up, down = int(factor.p), int(factor.q), [], 1, 1
    for x in row:
        powers.append(x * up // down)
        up, down = up * p, down * q
    return powers


def _float(x: int, bits: int) -> float:
    """Return x 2^-bits as a double, inf if it is too large."""
    try:
        return x / (1 << bits) if bits < MIN_FLINT_PRECISION else float(fmpq(x, 1 << bits))
    except OverflowError:
        return inf


def _size(polynomial: fmpz_poly, bits: int) -> float:
    """Return the sum of magnitudes of the coefficients of a polynomial, in units of 2^bits, rounded up."""
    return float((sum(abs(int(x)) for x in polynomial) >> bits) + 1)


def _ball(value: int, error: float, bits: int) -> arb:
    unit = arb(2) ** -bits
    return arb(value) * unit + arb(0, error) * unit
