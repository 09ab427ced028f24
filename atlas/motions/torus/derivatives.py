"""Derivatives of the motion of a body with three moments in its inputs, by theta functions, at any time.

N, K, W and their denominator are sums of exponentials exp(i (P v_1 + Q v_2)), v = ways x/2, at phases x of the torus,
see `atlas.motions.torus.theta`. So derivatives need those of the weights, of the ways and of the frequencies f:

    dv = (d ways) x/2 + ways (t df)/2,       d sum = sum of (d weight + i (P dv_1 + Q dv_2) weight) exp(...).

They are differences of constants that are known to some forty digits, over steps of 2^-56 of the inputs. Where one
changes by more than the step explains, the functions were found in another form, and the derivative is refused.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from flint import acb, arb, fmpq
from numpy.typing import NDArray

from atlas.arithmetic.inputs import FloatArray
from atlas.arithmetic.numbers import workprec
from atlas.errors import DomainError, NotCertifiedError
from atlas.motions.torus.approximate_lattice import Lattice
from atlas.motions.torus.approximate_periods import BITS, complex_of
from atlas.motions.torus.approximate_theta import ThetaMotion
from atlas.motions.torus.approximate_theta_sums import Array, weights_at
from atlas.motions.torus.certified_torus import Torus
from atlas.motions.torus.theta import Constants, ThetaKernel

STEP_BITS, WEAK_FIELD_BITS = 56, 28
"""Binary digits behind the point that a step leaves alone, and how many more in a weak field.

Moments and rates are near 1 in the units of the torus.
"""

MAX_CHANGE = 2.0**-20
"""Largest change of a constant, beside the largest of its kind, that a step explains."""

INTEGER_TOLERANCE = 1e-3
"""Largest distance from an integer of an entry of the matrix between two bases."""

BLOCK = 512
"""Number of times that are evaluated at once."""

ROUNDING, MAX_ERROR = 2.0**-52, 1e-9
"""Relative error of a term of v, and the largest error of v, relative to 1 + |v|, that is accepted."""

GROUPS = (0, 1, 2), (3, 4, 5, 6, 7, 8)
"""Places of the moments and of the rates among the inputs."""


class TorusVaried:
    """Derivatives of one motion on a torus in some of nine inputs, with ``exact`` its certified counterpart.

    ``places`` are the indices of the inputs in (moments, field, omega), three each; ``kernel`` evaluates the
    motion. Raises DomainError as `Neighbours.slopes` does.
    """

    def __init__(self, exact: Any, kernel: ThetaKernel, places: Sequence[int]) -> None:
        self.kernel = kernel
        with workprec(BITS):
            neighbours = Neighbours(exact, kernel)
            weights, ways, _, frame = neighbours.constants
            d_weights, d_ways, d_frequencies, d_frame = neighbours.slopes(places)
        weights, d_weights = weights.reshape(10, -1), d_weights.reshape(len(places), 10, -1)
        matters = (weights != 0).any(0) | (d_weights != 0).any((0, 1))
        self.P, self.Q = neighbours.orders[:, matters]
        self.weights, self.d_weights = weights[:, matters], d_weights[:, :, matters]
        self.ways, self.d_ways = ways.reshape(3, 2), d_ways.reshape(-1, 3, 2)
        self.d_frequencies = d_frequencies.real
        self.frame, self.d_frame = frame.real.reshape(3, 3), d_frame.real.reshape(-1, 3, 3)

    @property
    def of_frequencies(self) -> FloatArray:
        """Derivatives of the frequencies f1, f2 and f3 (rad/time) in each of the inputs: shape (inputs, 3).

        The frequencies are those of `AsymmetricMotion.frequencies`, which tells the choice of f3.
        """
        turns = [round(float(x.angle.mid()) / (2 * np.pi)) for x in self.kernel.periods]
        return np.column_stack([self.d_frequencies[:, :2], self.d_frequencies @ [-turns[0], -turns[1], 1]])

    def weighted(self, *_: Any) -> None:
        """Return None: nothing is prepared for combinations of inputs; the arguments are not used."""

    def vectors(
        self, t: FloatArray, slopes: bool, to_laboratory: FloatArray, input_weights: FloatArray, turns: FloatArray,
        *_: Any, certified: bool,  # noqa: ARG002  floats have the digits, or the derivatives are refused
    ) -> list[FloatArray]:  # fmt: skip
        """Return [v], or [v, R dOmega/dp] if ``slopes``, of N combinations of inputs at times t (m,), (m, N, 3) each.

        v is the rotation vector in the laboratory with dR/dp = [v]x R; ``to_laboratory`` (3, 3) takes vectors
        there. ``input_weights`` is (N, inputs), ``turns`` (N, 3) are added to v; ``certified`` is not used.
        Raises DomainError where the field is too weak for derivatives in floats.
        """
        out = [np.empty((t.size, len(input_weights), 3)) for _ in range(1 + slopes)]
        for i in range(0, t.size, BLOCK):
            for block, values in zip(out, self._block(t[i : i + BLOCK], slopes), strict=True):
                block[i : i + BLOCK] = np.einsum("np,pmk->mnk", input_weights, values) @ to_laboratory.T
        out[0] += turns
        return out

    def _block(self, t: FloatArray, slopes: bool) -> list[FloatArray]:
        """Return [v], or [v, R dOmega/dp] if ``slopes``, for each input at times t (m,), shape (inputs, m, 3).

        They are along the axes of the laboratory in which R(0) = 1. Raises DomainError where too many digits cancel.
        """
        half, low_words, _ = self.kernel._phases(t)  # noqa: SLF001  of the same floor
        half = half + low_words
        x = self.ways @ half[:2]
        phase_slopes = self.d_frequencies[:, :, None] * t / 2
        dx = self.d_ways @ half[:2] + self.ways @ phase_slopes[:, :2]
        turn = np.exp(1j * (x[2].real + 2 * half[2]) - x[2].imag)
        d_turn = 1j * (dx[:, 2] + 2 * phase_slopes[:, 2])
        waves = self._waves(self.P, x[0]) * self._waves(self.Q, x[1])
        inputs, forms = len(self.d_ways), 10 if slopes else 7
        table = [self.weights, 1j * self.P * self.weights, 1j * self.Q * self.weights, *self.d_weights]
        sums = np.concatenate([x[:forms] for x in table]) @ waves
        S, by_P, by_Q, *by_inputs = sums.reshape(3 + inputs, forms, -1)
        D = S[3]
        changed = np.array(by_inputs).reshape(inputs, forms, -1) + dx[:, :1] * by_P + dx[:, 1:2] * by_Q
        values = S / D
        sizes = (abs(changed) + abs(values * changed[:, 3:4])) / abs(D)
        sizes = np.stack([sizes[:, :3].max(1), sizes[:, 4:7].max(1)], 1)
        changed = (changed - values * changed[:, 3:4]) / D
        N, K = values[:3] * turn, values[4:7].real
        dN = changed[:, :3] * turn + N * d_turn[:, None]
        dK = changed[:, 4:7].real
        rows, d_rows = np.array([N.real, N.imag, K]), np.stack([dN.real, dN.imag, dK], 1)
        R = np.einsum("ka,kbm->mab", self.frame, rows)
        dR = np.einsum("pka,kbm->pmab", self.d_frame, rows) + np.einsum("ka,pkbm->pmab", self.frame, d_rows)
        spins = dR @ R.swapaxes(-1, -2)
        v = np.stack([spins[..., 2, 1], spins[..., 0, 2], spins[..., 1, 0]], -1)
        terms = abs(self.d_frame).max(2) @ abs(rows).max(1)
        terms += np.tensordot(sizes[:, [0, 0, 1]], abs(self.frame).max(1), (1, 0))
        if not (ROUNDING * terms <= MAX_ERROR * (1 + abs(v).max(2))).all():
            raise DomainError("The field is too weak beside the angular velocity for derivatives in it in floats.")
        if not slopes:
            return [v]
        return [v, np.matvec(R, (changed[:, 7:].real - dK).swapaxes(1, 2)) * self.kernel.rate]

    @staticmethod
    def _waves(orders: NDArray[np.int64], x: Array) -> Array:
        """Return exp(i n x), shape (k, m), for the n of ``orders`` (k,) and complex phases x (m,) in radians."""
        least = int(orders.min())
        powers = np.exp(1j * np.arange(least, int(orders.max()) + 1)[:, None] * x)
        return np.asarray(powers[orders - least])


class Neighbours:
    """Constants of a motion on a torus, and their derivatives in nine inputs: three moments, field K and omega.

    ``exact`` is the certified motion, ``kernel`` its evaluator. `values` are the inputs, rationals in the units of the
    torus; `constants` are four flat complex arrays: weights of the theta sums over the largest of the denominator, ways
    (coefficients of the half angles f1 t/2 and f2 t/2 in the sums' phases), frequencies f1, f2, f3 and frame. The sums'
    terms have the `orders` P, Q, shape (2, terms), counted from the centre of the sums.
    """

    def __init__(self, exact: Any, kernel: ThetaKernel) -> None:
        torus, sums = exact.on_torus.torus, kernel.sums
        self.kernel, self.rate = kernel, exact.on_torus.rate
        self.values = [*torus.moments, *torus.K, *(w - k for w, k in zip(torus.W, torus.K, strict=True))]
        self.sizes = [float(arb(x).mid()) for x in self.values]
        self.unit = float(arb(exact.inertia[0] / torus.moments[0]).mid())
        self.orders = np.array([(P, Q) for P in sums.P for Q in sums.Q]).T
        self.box = [(int(P + sums.centre[0]), int(Q + sums.centre[1])) for P, Q in self.orders.T]
        self.peak = int(np.argmax(abs(sums.table[3]).ravel()))
        self.exact = self._tables(kernel.constants)
        self.constants = [np.array([complex_of(x) for x in kind]) for kind in self.exact]

    def slopes(self, places: Sequence[int]) -> list[Array]:
        """Return [weights, ways, frequencies, frame]: their derivatives in the inputs at ``places``, (places, n) each.

        ``places`` are indices in `values`; the derivatives are by the caller's units of inertia and of 1/time. They
        are difference quotients. Where ``places`` hold all inputs of a group, moments or rates, the derivative in
        the largest of them follows from the others by homogeneity. Raises DomainError where a neighbour has no
        theta functions, or those of another form.
        """
        # the largest of all moments, and of all rates, follows from the others: constants are homogeneous
        to_laboratory = {max(group, key=lambda i: abs(self.values[i])) for group in GROUPS if set(group) <= set(places)}
        slopes_by_place = {place: self._by_step(place) for place in set(places) - to_laboratory}
        slopes_by_place |= {place: self._by_scale(place, slopes_by_place) for place in to_laboratory}
        units = [self.kernel.rate if place > 2 else self.unit for place in places]
        return [
            np.array([slopes_by_place[place][kind] / unit for place, unit in zip(places, units, strict=True)])
            for kind in range(4)
        ]

    def _by_step(self, place: int) -> list[Array]:
        """Return the derivatives [weights, ways, frequencies, frame], (n,) each, in the scaled input at ``place``.

        They are difference quotients; in a weak field the step in one of its components is shorter. Raises
        DomainError as `slopes` does.
        """
        field = max(map(abs, self.sizes[3:6]))
        weak = min(max(round(-2 * np.log2(field)), 0), WEAK_FIELD_BITS)
        step = STEP_BITS + weak * (place in (3, 4, 5))
        values_there = _neighbour(self.values, place, step, self.rate, self.kernel.made_of[0])
        return _slopes(self.exact, self._tables(values_there), step)

    def _by_scale(self, place: int, slopes_by_place: Mapping[int, Sequence[Array]]) -> list[Array]:
        """Return the derivatives [weights, ways, frequencies, frame], (n,) each, in an input by homogeneity.

        ``place`` is the index of the input; ``slopes_by_place`` has those in the others of its group. If all rates
        are scaled, K, W and the frequencies grow and the frame shrinks; if all moments are, nothing changes.
        """
        weights, ways, frequencies, frame = self.constants
        count = len(self.box)
        by_rates = [
            weights * np.repeat([0, 1], [4 * count, 6 * count]), 0 * ways, frequencies,
            -frame * np.repeat([0, 1], [6, 3]),
        ]  # fmt: skip
        by_scale = by_rates if place > 2 else [0 * x for x in by_rates]
        group_rest = [i for i in GROUPS[place > 2] if i != place]
        return [
            (x - sum(self.sizes[i] * slopes_by_place[i][kind] for i in group_rest)) / self.sizes[place]
            for kind, x in enumerate(by_scale)
        ]

    def _tables(self, constants: Constants) -> list[list[Any]]:
        """Return four flat lists of the balls in ``constants``: theta coefficients, ways, frequencies, frame.

        The first are divided by the denominator's largest. Raises DomainError where that coefficient is zero.
        """
        places = [weights_at(constants.forms, constants.hat, constants.start, place) for place in self.box]
        unit = places[self.peak][3]
        if unit == 0:
            raise _other_form()
        weights = [x / unit for row in zip(*places, strict=True) for x in row]
        return [
            weights,
            *([x for row in kind for x in row] for kind in (constants.ways, [constants.frequencies], constants.frame)),
        ]


def _neighbour(values: Sequence[fmpq], place: int, step: int, rate: fmpq, motion: ThetaMotion) -> Constants:
    """Return the `Constants` of the motion with the input number ``place`` of ``values`` larger by 2^-``step``.

    ``motion`` is the motion itself, ``rate`` the unit of 1/time. Raises DomainError where the neighbour has no theta
    functions.
    """
    values_there = [x + fmpq(1, 2**step) if i == place else x for i, x in enumerate(values)]
    K, omega = values_there[3:6], values_there[6:]
    torus = Torus(tuple(values_there[:3]), tuple(w + k for w, k in zip(omega, K, strict=True)), tuple(K))
    try:
        with workprec(BITS):
            lattice = _followed(torus.lattice, motion.lattice)
        theta = ThetaMotion(torus.integrals, torus.W, torus.K, lattice, motion)
    except NotCertifiedError as reason:
        raise DomainError(f"A neighbour of the motion has no theta functions: {reason}") from reason
    return Constants(theta, torus, rate)


def _followed(lattice: Lattice, like: Lattice) -> Lattice:
    """Return a ``lattice`` in the basis whose periods are nearest to those of ``like``, a neighbour's.

    Raises DomainError where no combination with whole coefficients is near.
    """
    periods = [*lattice.real, *lattice.other_periods]

    def reals(rows: Sequence[Sequence[acb]]) -> FloatArray:
        return np.array([[complex_of(x) for x in row[:2]] for row in rows]).view(float)

    def next_to(rows: tuple[list[acb], list[acb]]) -> tuple[list[acb], list[acb]]:
        by_scale = np.linalg.solve(reals(periods).T, reals(rows).T).T
        if not abs(by_scale - np.rint(by_scale)).max() < INTEGER_TOLERANCE:
            raise _other_form()
        period_1, period_2 = (
            [sum((round(n) * period[k] for n, period in zip(row, periods, strict=True)), acb(0)) for k in range(3)]
            for row in by_scale.tolist()
        )
        return period_1, period_2

    return Lattice(next_to(like.real), next_to(like.other_periods), next_to(like.a), next_to(like.b))


def _slopes(here: list[list[Any]], row_there: list[list[Any]], step: int) -> list[Array]:
    """Return difference quotients (there - here) 2^step, a complex array (n,) for each of four lists of constants.

    ``here`` and ``row_there`` are those of the motion and of its neighbour. Raises DomainError where a constant changes
    more than the step explains.
    """
    slopes: list[Array] = []
    for row_here, second in zip(here, row_there, strict=True):
        change = np.array([complex_of(acb(y - x)) for x, y in zip(row_here, second, strict=True)], dtype=complex)
        if not abs(change).max() <= MAX_CHANGE * max(abs(complex_of(acb(x))) for x in row_here):
            raise _other_form()
        slopes.append(np.asarray(change * 2.0**step, dtype=np.complex128))
    return slopes


def _other_form() -> DomainError:
    return DomainError(
        "The theta functions of a neighbour have another form: there is no derivative in closed form here."
    )
