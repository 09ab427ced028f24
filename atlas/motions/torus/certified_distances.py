"""Proof that theta functions are a motion: how far from it they are at most, anywhere on its torus.

The forms of `atlas.motions.torus.approximate_theta` are entire functions, whatever their constants are. Those of K, M
and N over that of D, the denominator, put into the equations of the flows of H and of F/2, leave defects such as

    D^2 (K' - K x W) = n' D - n D' - n x II^-1 m,     K = n/D,  M = m/D,  W = II^-1 M.

With S the sum of the places of two forms, the Fourier coefficients of a defect obey c_(S+4j)/c_S = g_(S+4j)/g_S,

    g_S = exp(i pi (S hat S/8 + S (origin - shift/2))),

for whole j, so that the sixteen of a square, in balls, bound it everywhere: all terms of a defect change by one sign
with j, because the characteristics of D and of the three axes are all different and those of N are those of the axes
plus one, which is asserted. Terms left out are those far from all peaks of the cell; their own sum has a bound, which
is added. If the equations hold but for rates delta and the start but for epsilon, then on a straight way through a cell
of the periods M, K and N go away from the motion by at most exp(growth) (epsilon + delta); to growth a term such as
e x W, which turns an error e, adds nothing. Beyond the cell the periods tell all, which are proved in
`atlas.motions.torus.certified_torus`. Nothing is taken from the theory of the torus, and it does not matter how the
constants were found.

The weights are balls; sums of exponentials of them are taken in doubles. A product of few factors, an exponential of an
argument below `ARGUMENT` and a sum of fewer than `ARGUMENT` terms are off by less than 4 `ARGUMENT` 2^-53 < `FLOATS`
beside the sum of sizes, so that a sum of positive terms is off by a factor below `WIDENING` with ease; where arguments
or sums are larger there is no bound.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import cache, partial
from itertools import product

import numpy as np
from flint import acb, acb_mat, arb
from numpy.typing import NDArray

from atlas.arithmetic.numbers import dot, rational, workprec
from atlas.errors import NotCertifiedError
from atlas.motions.nutation.certified_cayley_klein import matrix
from atlas.motions.torus.approximate_periods import BITS, centre, complex_of, matrix_of, nearest
from atlas.motions.torus.approximate_theta import ThetaMotion
from atlas.motions.torus.approximate_theta_sums import CHARACTERISTICS, HALF_TURN, Array, places_near, weights_at
from atlas.motions.torus.certified_torus import Period, Torus

SPARE_BITS = 40
"""Bits beyond those of the constants."""

LEFT_OUT = 240.0
"""Logarithm of the ratio of the largest product of terms to the omitted products."""

FAINT_LOG = 90.0
"""Logarithm of the ratio of the largest term to omitted terms of D, and to the terms of a defect that have one bound in
the whole cell."""

ARGUMENT, FLOATS = 2000, 1e-12
"""Bounds on arguments and numbers of exponentials in a sum in doubles, and on its rounding errors beside the sum of
their sizes."""

WIDENING = 2.0
"""By how much bounds in doubles are widened: far more than their rounding can matter."""

MAX_DISTANCE, WANTED_BOUND = 1e-6, 1e-17
"""Distance from the motion up to which growth is bounded, and the bound on it that is wanted."""

PARTS = (1, 2, 3, 5)
"""Numbers of parts into which each period is divided, tried in this order."""

CELLS_PER_PERIOD, MAX_HALVINGS, MAX_SQUARES = 24, 8, 1 << 15
"""Parts of each period in which |D| is bounded from below, how often one is halved if need be, and how many squares of
them are looked at together at most: where D is no larger than its rounding errors, halving helps none."""

TURNS = 2.0**48
"""More turns than there are in a phase of 2^50."""

D, K, M, N = 0, (1, 2, 3), (4, 5, 6), (7, 8, 9)
"""Places of the forms in a row."""

Floats = NDArray[np.float64]
Place = tuple[int, int]


def distances(theta: ThetaMotion, torus: Torus, periods: Sequence[Period]) -> Floats:
    """Return proven bounds (3,) on |M|, |K| and |N| of theta functions minus motion, at all phases of a cell.

    M = II (Omega + K) and K are along the body's axes, N = S^T (e_x + i e_y) with the rotation S of `Arrival` and unit
    vectors e_x, e_y across the field; |.| is the Euclidean length. ``periods`` are the two proven ones of ``torus``,
    and all is in its scaled units. The cell reaches from -HALF_TURN to HALF_TURN turns of both phases, counted from
    the motion's state at t = 0. Errors grow along a straight path from that state. If they grow too much, the cell is
    divided into 4, 9 or 25 parts, and the paths start from their centres, which Taylor's series reaches. Raises
    NotCertifiedError where there is no bound.
    """
    _check_characteristics(theta)
    with workprec(BITS + SPARE_BITS), np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        cell = Cell(theta, periods)
        H, F = HALF_TURN * abs(cell.times).sum(axis=1)
        rates, sizes = cell.rates() * np.array([[H], [F]]), _sizes(theta)
        spread = HALF_TURN * np.sum([_growth(theta, sizes, *times) for times in cell.times.T], axis=0)
        widths = [max(float(x.rad()) for x in way) for way in zip(*((p.H, p.F, p.angle) for p in periods), strict=True)]
        drift_of_periods = _growth(theta, sizes, widths[0], 0.0) + _growth(theta, sizes, 0.0, widths[1])
        off = drift_of_periods @ sizes + np.array([0, 0, widths[2] * sizes[2]])
        for divisions in PARTS:
            growth = _exponential(spread / divisions)
            if np.max(growth @ rates.sum(axis=0)) < WANTED_BOUND:
                places = 2 * HALF_TURN * ((np.arange(divisions) + 0.5) / divisions - 0.5)
                deviations = [_deviation(theta, torus, cell.times @ x) for x in product(places, repeat=2)]
                arc = WIDENING * (growth @ (np.max(deviations, axis=0) + rates.sum(axis=0) / divisions) + off)
                if np.max(arc) < MAX_DISTANCE:
                    return np.asarray(arc)
    raise NotCertifiedError(
        "not certified: the defects of the theta functions might grow too much over the motion's torus."
    )


def drifts(theta: ThetaMotion, periods: Sequence[Period], rounded_periods: Sequence[Period]) -> Floats:
    """Return proven bounds (3,) on the errors of M, K and N of ``theta``, at all phases, by rounding the periods.

    ``rounded_periods`` are used in the place of the proved ``periods``; phases reach to `TURNS` turns, more than a
    phase of 2^50 rad has. Raises NotCertifiedError for an error beyond `MAX_DISTANCE`.
    """
    with workprec(BITS + SPARE_BITS):
        arc, turn = np.zeros(3), 2 * arb.pi()
        for p, q in zip(periods, rounded_periods, strict=True):
            turns = (p.angle - q.angle) / turn
            arc += [float(abs(x).upper()) for x in (p.H - q.H, p.F - q.F, (turns - nearest(turns)) * turn)]
    sizes = _sizes(theta)
    growth = TURNS * _growth(theta, sizes, arc[0], arc[1])
    if not growth.sum() < MAX_DISTANCE:
        raise NotCertifiedError("not certified: the periods are not known well enough for long times.")
    return np.asarray(WIDENING * (growth @ sizes + [0, 0, TURNS * arc[2] * sizes[2]]))


class Cell:
    """The forms of ``theta`` as exact functions of v = origin + into x/pi in the cell |x_k| <= HALF_TURN.

    x (2,) are the phases, in turns, of both ``periods``; `forms` are the ten of D, K, M, N, and `to_v` (2, 2) takes
    phases to pi v. Methods bound what the forms lack of a motion.
    """

    def __init__(self, theta: ThetaMotion, periods: Sequence[Period]) -> None:
        self.theta, inverse = theta, theta.X.inv()
        self.origin = centre(2 * theta.start[0]), centre(theta.start[1])
        self.shift = centre(2 * theta.w[0]), centre(theta.w[1])
        self.hat = acb_mat([[centre(theta.hat[i, j]) for j in range(2)] for i in range(2)])
        self.flows = [(centre(2 * inverse[0, k]), centre(inverse[1, k])) for k in range(2)]
        self.lines = [centre(theta.l[0] * inverse[0, k] + theta.l[1] * inverse[1, k]) for k in range(2)]
        self.times = np.array([[float(p.H.mid()) for p in periods], [float(p.F.mid()) for p in periods]])
        self.to_v: Array = np.array([[complex_of(x) for x in flow] for flow in self.flows]).T @ self.times * np.pi
        self.Y = matrix_of(self.hat).imag
        self.corners = self.to_v @ (HALF_TURN * np.array(list(product((-1, 1), repeat=2))).T)
        self.middle = np.round(-2 * np.linalg.solve(self.Y, self._imaginary(0.0)))
        self.places = near_hull(self.Y, self._peaks(0.0), 4 * FAINT_LOG / np.pi)
        turns = np.array([complex_of(x) for x in self.lines]) @ self.times
        self.narrow = float(np.linalg.eigvalsh(self.Y)[0])
        self.away = np.linalg.solve(self.Y, np.array([complex_of(s).imag for s in self.shift]))
        self.forms = [theta.denominator, *theta.K, *theta.M, *(replace(x, shift=self.shift) for x in theta.N)]
        self._terms: Callable[[Place], list[acb]] = cache(partial(weights_at, self.forms, self.hat, self.origin))
        sizes = [*theta.motion.moments, *(1 / I for I in theta.motion.moments), *self.lines, theta.motion.D, 1]
        weights = max(abs(complex_of(x)) for form in self.forms for x in form.weights)
        self.weight = 8 * weights**2 * max(abs(complex_of(acb(x))) for x in sizes) ** 2
        """Bound on the sum of factors of the products in a defect."""
        self.largest_factor = float(np.exp(HALF_TURN * np.abs(turns.imag).sum()))
        """Factor exp(i l (zeta - start)) of N."""

    def rates(self) -> Floats:
        """Return bounds (2, 3) on the defects of M, K and N over D^2 in the cell; inf where no bound is found.

        Row 0 is along the flow of H, row 1 along that of F/2.
        """
        S, size, beyond = self._defects()
        logs = size + HALF_TURN * abs((S - 2 * self.middle) @ self.to_v.imag).sum(axis=1)[:, None]
        top = logs.max()
        if not np.isfinite(top):
            return np.full((2, 3), np.inf)
        matters = logs.max(axis=1) > top - FAINT_LOG
        faint = np.exp(logs[~matters] - top).sum(axis=0) + np.exp(beyond - top)
        S, size = S[matters], np.exp(size[matters] - top)
        weights = np.array([complex_of(self._terms((int(P), int(Q)))[D]) for P, Q in self.places]) * np.exp(-top / 2)
        ways, twice = ((self.places - self.middle) @ self.to_v, ((S - 2 * self.middle) @ self.to_v).imag)
        weight = max(abs(complex_of(x)) for x in self.theta.denominator.weights)
        spare = weight * np.exp(self._highest(0.0) - top / 2) * _beyond(FAINT_LOG, np.pi / 4 * self.narrow)
        if max(2 * HALF_TURN * max(abs(ways).max(), abs(twice).max()), len(ways), len(S)) > ARGUMENT:
            return np.full((2, 3), np.inf)
        half, defect = HALF_TURN / CELLS_PER_PERIOD, np.zeros(6)
        line = np.arange(-CELLS_PER_PERIOD + 1, CELLS_PER_PERIOD, 2) * half
        x = np.stack(np.meshgrid(line, line), -1).reshape(-1, 2)
        for _ in range(MAX_HALVINGS):
            terms = weights * np.exp(1j * x @ ways.T)
            value, slopes, arc = (abs(terms.sum(axis=1)), abs(terms @ ways).sum(axis=1), half * abs(ways).sum(axis=1))
            below = value - half * slopes - abs(terms) @ (arc**2 / 2 * np.exp(arc) + FLOATS) - spare
            is_good = below > value / 2
            above = np.exp(-x[is_good] @ twice.T) @ (size * np.exp(half * abs(twice).sum(axis=1))[:, None]) + faint
            defect = np.maximum(defect, (above / below[is_good, None] ** 2).max(axis=0, initial=0.0))
            if is_good.all():
                return np.asarray(WIDENING * defect.reshape(2, 3) * [1, 1, self.largest_factor])
            half /= 2
            x = np.concatenate([x[~is_good] + half * np.array(sides) for sides in product((-1, 1), repeat=2)])
            if len(x) > MAX_SQUARES:
                break
        return np.full((2, 3), np.inf)

    def _defects(self) -> tuple[Floats, Floats, Floats]:
        """Return places S (n, 2), logarithms of coefficient bounds there (n, 6), and of the bounds on all others (6,).

        The six columns are M, K and N along the flow of H, then along that of F/2; the last array bounds sums
        anywhere in the cell.
        """
        low = np.round(-4 * np.linalg.solve(self.Y, self._imaginary(0.0))).astype(int) - 1
        sizes_found, beyond, divisions = [], [], np.array([0.0, 0.0, 0.5] * 2)
        peaks = {height: 2 * self._peaks(height) for height in (0.0, 0.5)}  # where coefficients are largest
        highest = np.array([2 * self._highest(height) for height in divisions])
        remainder = np.log(_beyond(LEFT_OUT, 2 * np.pi * self.narrow))
        for S in product(*(range(int(s), int(s) + 4) for s in low)):
            place: Floats = np.array(S)
            ways = [near_hull(self.Y, (peak - place) / 4, LEFT_OUT / (2 * np.pi)) for peak in peaks.values()]
            shifts = 4 * np.unique(np.concatenate(ways), axis=0)
            less = [self._left_out(place, height) for height in divisions]
            defects = [
                np.linalg.norm([float(abs(c).upper()) + spare for c in components])
                for components, spare in zip(self._coefficients(S), less, strict=True)
            ]
            sizes = np.array([self._size(place, height) for height in divisions])
            excess = np.column_stack([self._size(place + shifts, height) for height in divisions]) - sizes
            sizes_found.append((place + shifts, excess + np.log(defects)))
            beyond.append(np.log(defects) - sizes + highest + remainder)
        all_beyond = np.logaddexp.reduce(beyond, axis=0)
        return np.concatenate([x for x, _ in sizes_found]), np.concatenate([x for _, x in sizes_found]), all_beyond

    def _peaks(self, height: float) -> Floats:
        """Return the places (4, 2), real numbers, of the largest term of a form at the corners of the cell.

        ``height`` is the part of the form's shift that counts: 0 for D, K and M, 1/2 for products with N.
        """
        return np.asarray(-2 * np.linalg.solve(self.Y, self._heights(height)).T)

    def _heights(self, height: float) -> Floats:
        """Return Im v (2, 4) at the corners of the cell, less ``height`` times the imaginary part of the shift of N."""
        return np.asarray(self._imaginary(height)[:, None] + self.corners.imag / np.pi)

    def _highest(self, height: float) -> float:
        """Return the logarithm of the maximum of |exp(i pi (n hat n/4 + n v))| over real n and v in the cell.

        v is less ``height`` times the shift of N. It is pi (y, Y^-1 y), y = Im v, but for the power of the middle,
        which is taken out: convex, so largest in a corner.
        """
        y = self._heights(height)
        quadratic = np.pi * np.einsum("ik,ik->k", y, np.linalg.solve(self.Y, y))
        return float(np.max(quadratic + self.middle @ self.corners.imag))

    def _imaginary(self, height: float) -> Floats:
        """Return Im(origin - height shift), shape (2,), shift that of N."""
        return np.array([complex_of(v - height * s).imag for v, s in zip(self.origin, self.shift, strict=True)])

    def _size(self, S: Floats, height: float) -> Floats:
        """Return log |g_S| of the module, the logarithm of a coefficient's size, at places S (..., 2): shape (...).

        The shift of N counts by the part ``height``.
        """
        square = np.einsum("...i,ij,...j->...", S, self.Y, S)
        return np.asarray(-np.pi * (square / 8 + S @ self._imaginary(height)))

    def _coefficients(self, S: tuple[int, ...]) -> Iterator[list[acb]]:
        """Yield for each of six defects three complex balls, the coefficients at S (2,) of its components.

        The defects are those of M, K and N along the flow of H, then of M, K and N along that of F/2.
        """
        motion = self.theta.motion
        I = motion.moments
        A, J, unit = [1 / x for x in I], [-motion.D / x for x in I], [1, 1, 1]
        B, *slopes = self._products(S)

        def crossed(lefts: Sequence[int], rights: Sequence[int], by: Sequence[object]) -> list[acb]:
            return [
                B[lefts[j], rights[k]] * by[k] - B[lefts[k], rights[j]] * by[j] for j, k in ((1, 2), (2, 0), (0, 1))
            ]

        terms = (
            [[crossed(M, M, A), crossed(K, K, I)], [crossed(K, M, A)], [crossed(N, M, A)]],
            [[crossed(K, K, J)], [crossed(K, M, unit)], [crossed(N, M, unit)]],
        )
        for slope, line, rates in zip(slopes, self.lines, terms, strict=True):
            for rows, divisions in zip((M, K, N), rates, strict=True):
                excess = acb(0, 1) * line if rows is N else acb(0)
                changes = [slope[i, D] + excess * B[i, D] for i in rows]
                yield [x - sum(less, acb(0)) for x, *less in zip(changes, *divisions, strict=True)]

    def _products(self, S: tuple[int, ...]) -> list[acb_mat]:
        """Return three matrices (10, 7) of coefficients at S, of products of two forms f (row) and g (column).

        They are those of f g, of f' g - f g' along the flow of H, and of the same along that of F/2. Rows are D, K,
        M, N, columns D, K, M.
        """
        places = self._places(np.array(S) / 2)
        lefts = list(zip(*(self._terms(place) for place in places), strict=True))
        rights = acb_mat([self._terms((S[0] - P, S[1] - Q))[: N[0]] for P, Q in places])
        products = [acb_mat(lefts) * rights]
        for u, v in self.flows:
            rates = [acb(0, 1) * arb.pi() * ((2 * P - S[0]) * u + (2 * Q - S[1]) * v) for P, Q in places]
            products.append(acb_mat([[x * rate for x, rate in zip(row, rates, strict=True)] for row in lefts]) * rights)
        return products

    def _places(self, middle: Floats) -> list[Place]:
        """Return indices (P, Q) of the terms that are not negligible, near ``middle`` (2,) or that plus `away`."""
        near_places = places_near(self.Y, np.array([middle, middle + self.away]), 2 * LEFT_OUT / np.pi)
        return [(int(P), int(Q)) for P, Q in near_places]

    def _left_out(self, S: Floats, height: float) -> float:
        """Return a bound on the contribution of omitted terms to a coefficient at S (2,), ``height`` as in `_size`.

        Beyond LEFT_OUT a sum of exp(-q), q = pi/2 (p, Y p), is one of exp(-q/10) times exp(-9/10 LEFT_OUT); a tenth of
        that goes for the factor p of a rate.
        """
        sums = np.exp(-0.8 * LEFT_OUT) * (2 + np.sqrt(20 / self.narrow)) ** 2
        rate = max(abs(complex_of(x)) for flow in self.flows for x in flow)
        slopes = 8 * np.pi * rate * (abs(self.away).max() + 2 / np.sqrt(self.narrow))
        peak = np.pi / 2 * self.away @ self.Y @ self.away if height else 0.0
        return float(self.weight * sums * (1 + slopes) * np.exp(self._size(S, height) + peak))


def _check_characteristics(theta: ThetaMotion) -> None:
    """Raise NotCertifiedError unless the products in a defect of ``theta`` have one law of coefficients.

    From S to S + 4j the product of forms of characteristics d and d' takes the sign (-1)^(j_2 (d + d')), besides g.
    """
    axes = [form.place for form in theta.K]
    crossed = {form.place ^ place for form, place in zip(theta.N, axes, strict=True)}
    different = len({theta.denominator.place, *axes}) == len(CHARACTERISTICS)
    alike = [form.place for form in theta.M] == axes and len(crossed) == 1
    if not (different and alike) or any(
        abs(complex_of(x)) for form in (theta.denominator, *theta.K, *theta.M, *theta.N) for x in form.shift
    ):
        raise NotCertifiedError("not certified: the characteristics of the theta functions are not one for each axis.")


def near_hull(Y: Floats, corners: Floats, max_square: float) -> NDArray[np.int64]:
    """Return integer points n (k, 2): all with (n - p, Y (n - p)) < ``max_square`` for a p in a parallelogram, or more.

    Y (2, 2) is symmetric and positive. The ``corners`` (4, 2) belong to the parameters (-1, -1), (-1, 1), (1, -1),
    (1, 1) along the two sides. The result holds the points near a net in the parallelogram, so fine that each of
    its points is within half the diagonal of a mesh.
    """
    sides = corners[2] - corners[0], corners[1] - corners[0]
    lengths = [float(np.sqrt(side @ Y @ side)) for side in sides]
    steps = [int(np.ceil(min(length, 30.0))) + 1 for length in lengths]
    arc = sum(length / (count - 1) for length, count in zip(lengths, steps, strict=True) if count > 1) / 2
    s, t = np.meshgrid(*(np.linspace(0, 1, count) for count in steps))
    points = corners[0] + s.reshape(-1, 1) * sides[0] + t.reshape(-1, 1) * sides[1]
    return places_near(Y, points, (np.sqrt(max_square) + arc) ** 2 * (1 + 1e-9))


def _beyond(arc: float, narrow: float) -> float:
    """Return a bound on the sum of exp(-q(n - p)) over integer points n with q >= ``arc``, for any p.

    q is a quadratic form of two variables, q(n) >= ``narrow`` n^2. The bound is exp(-9/10 arc) times the sum of
    exp(-q/10), a square of a sum over a line, which is below its largest term and the integral.
    """
    return float(np.exp(-0.9 * arc) * (1 + np.sqrt(10 * np.pi / narrow)) ** 2)


def _deviation(theta: ThetaMotion, torus: Torus, times: Floats) -> Floats:
    """Return bounds (3,) on the distances of M, K and N of theta functions from the motion after flow times (H, F).

    The times (2,) count from the start; the motion goes there by the Taylor series of ``torus``.
    """
    H, F = map(rational, times.tolist())
    way = theta.zeta([acb(H), acb(F)])
    zeta = [x + y for x, y in zip(way, theta.start, strict=True)]
    pairs, shifted = theta.pairs(zeta), theta.pairs([x - y for x, y in zip(zeta, theta.w, strict=True)])
    below, factor = theta.denominator.value(pairs), (acb(0, 1) * dot(theta.l, way)).exp()
    state = torus.flow.go(H, F, BITS)
    S = matrix(state.q)
    expected = [
        [I * w for I, w in zip(torus.moments, state.W, strict=True)],
        state.K,
        [sum((S[i][j] * x for i, x in enumerate(theta.at_start.N)), acb(0)) for j in range(3)],
    ]
    sizes_found = [
        [form.value(pairs) / below for form in theta.M],
        [form.value(pairs) / below for form in theta.K],
        [factor * form.value(shifted) / below for form in theta.N],
    ]
    pairs_of_vectors = zip(sizes_found, expected, strict=True)
    return np.array([sum(float(abs(x - y).upper()) for x, y in zip(*pair, strict=True)) for pair in pairs_of_vectors])


def _sizes(theta: ThetaMotion) -> Floats:
    """Return bounds (3,) on |M|, |K| and |N|, both of the motion and of theta functions near it.

    |M|^2 = F + D (K, II^-1 K) <= F + D b^2/least moment, and |N|^2 = 2.
    """
    motion = theta.motion
    K, ratio = float(arb(motion.square).sqrt().upper()), float(arb(motion.D / min(motion.moments)).upper())
    M = np.sqrt(float(arb(motion.F).upper()) + ratio * K * K)
    return np.array([1e-9 + MAX_DISTANCE + (1 + 1e-9) * x for x in (M, K, 2**0.5)])


def _growth(theta: ThetaMotion, sizes: Floats, H: float, F: float) -> Floats:
    """Return the matrix (3, 3) of bounds: row i, column j bounds the growth of the error of vector i by that of j.

    The vectors are M, K and N of ``theta``, with lengths `sizes`; H and F are the times along both flows, floats. A
    multiple of 1 may be subtracted from II^-1 in M x II^-1 M, and from H II + F J in K x (H II + F J) K, J = -D II^-1.
    """
    I = np.array([float(arb(x).mid()) for x in theta.motion.moments])
    M, K, N = sizes
    turn = abs(H / I + F).max()
    return np.array(
        [[abs(H) * M * np.ptp(1 / I) / 2, K * np.ptp(H * I - F * I.prod() / I), 0], [K * turn, 0, 0], [N * turn, 0, 0]]
    )


def _exponential(growth: Floats) -> Floats:
    """Return the exponential of ``growth`` (3, 3), elements >= 0, by Taylor's series and squaring, in doubles."""
    halvings = max(0, int(np.ceil(np.log2(growth.sum())))) if growth.any() else 0
    term = total = np.eye(3)
    for n in range(1, 30):
        term = term @ growth / 2.0**halvings / n
        total = total + term
    return np.asarray(np.linalg.matrix_power(total, 2**halvings))
