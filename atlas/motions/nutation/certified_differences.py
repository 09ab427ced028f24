"""Derivatives of a motion in its inputs at single times, by differences of its matrices in balls."""

from collections.abc import Callable, Sequence
from itertools import chain
from typing import Any

import numpy as np
from flint import arb, fmpq

from atlas.arithmetic.numbers import applied, dot, rational, workprec
from atlas.errors import DomainError
from atlas.motions.nutation.certified_derivatives import (
    MAX_RADIUS,
    MAX_TRIES,
    STEP_BITS,
    FloatArray,
    Row,
    radii_of,
    sizes_of,
)

SIDES = (((1, 0, -1), (1, 0, -1)), ((0, -1, -2), (3, -4, 1)), ((0, 1, 2), (-3, 4, -1)))
"""Steps h and the weights of twice a difference: on both sides, or on one at the border of possible bodies."""

MAX_DERIVATIVE_CHANGE = 2.0**-30
"""Largest relative change of a derivative over a step; the error of the difference is its square."""


class Differences:
    """Derivatives of R and Omega at single times by differences of the motion in balls, near any border.

    ``make`` makes the certified motion of all inputs, ``values``; ``places`` are the indices of the inputs that
    vary, ``scales`` the sizes of all. R is analytic in the inputs whatever its constants do: how far it bends
    depends on how fast neighbours depart.
    """

    def __init__(
        self, make: Callable[..., Any], values: Sequence[fmpq], places: Sequence[int], scales: Sequence[fmpq]
    ) -> None:
        self.make, self.values, self.places, self.scales = make, values, places, scales
        self._make_neighbours(STEP_BITS + 20)

    def _make_neighbours(self, bits: int) -> None:
        """Store in `here` the motion and in `neighbours` the result of `_neighbours` for each input.

        Neighbours differ by 2^-``bits`` of the input's scale.
        """
        self.bits = bits
        with workprec(8 * bits):
            self.here = self.make(*self.values)
            self.neighbours = [self._neighbours(i, self.scales[i] / fmpq(2) ** bits) for i in self.places]

    def _neighbours(self, place: int, h: fmpq) -> list[tuple[Any, arb, arb]]:
        """Return triples (motion, weight of the derivative, weight of its change over h) for the input ``place``.

        The motions have that input changed by multiples of h. Raises DomainError where inputs next to this one, on
        either side, start no motion of the family.
        """
        for steps, weights in SIDES:
            try:
                inputs = [[x + n * h if i == place else x for i, x in enumerate(self.values)] for n in steps]
                motions = [self.make(*x) if n else self.here for n, x in zip(steps, inputs, strict=True)]
            except DomainError:
                continue
            return [(x, w / arb(2 * h), n / arb(h)) for x, w, n in zip(motions, weights, (1, -2, 1), strict=True)]
        raise DomainError("No derivative: inputs on either side of this one start no motion of the family.")

    def at(self, t: float) -> tuple[FloatArray, ...]:
        """Return (v, R dOmega/dp, R e3, d(R e3)/dt) at a time t: (inputs, 3) twice, then (3,) twice; dR/dp = [v]x R.

        All are in the laboratory, the inputs p in the order of ``places``. v is in rad per unit of p, R dOmega/dp in
        rad/time per unit of p; Omega, along the body's axes, is differentiated before R turns it. The steps are made
        smaller until the differences are accurate; raises DomainError where no step is small enough.
        """
        time = rational(t)
        for _ in range(MAX_TRIES):
            with workprec(8 * self.bits):
                here = self._state(self.here, time)
                R, Omega = [here[i : i + 3] for i in (0, 3, 6)], here[9:]
                turns, changes, bends = zip(*(self._derivative(here, R, x, time) for x in self.neighbours), strict=True)
                axis = [row[2] for row in R], [row[0] * Omega[1] - row[1] * Omega[0] for row in R]
            v, faster = (np.array([[float(x.mid()) for x in row] for row in rows]) for rows in (turns, changes))
            sizes = 1 + abs(v).max(1)
            radii = np.array([radii_of(x).max() for x in turns])
            if ((radii <= MAX_RADIUS * sizes) & (np.array(bends) <= MAX_DERIVATIVE_CHANGE * sizes)).all():
                return v, faster, *(np.array([float(arb(x).mid()) for x in y]) for y in axis)
            self._make_neighbours(2 * self.bits)
        raise DomainError("The motion is too near to a case of its own for derivatives.")

    def _state(self, motion: Any, t: fmpq) -> Row:
        """Return twelve balls: the nine entries of R(t), by rows, then the three of Omega(t), of one motion."""
        return [*chain.from_iterable(motion.rotation(t)), *motion.angular_velocity(t)]

    def _derivative(
        self, here: Row, R: Sequence[Row], neighbours: Sequence[tuple[Any, arb, arb]], t: fmpq
    ) -> tuple[Row, Row, float]:
        """Return (v, R dOmega/dp, change) for one input p at time t, dR/dp = [v]x R: lists of three balls, a float.

        The last is the largest change of an entry of dR/dp over a step. ``here`` is the `_state` of the motion, R
        its matrix, and ``neighbours`` are the triples of `_neighbours`.
        """
        rows = [here if x is self.here else self._state(x, t) for x, _, _ in neighbours]
        _, slopes, bends = zip(*neighbours, strict=True)
        change, bend = ([dot(x, w) for x in zip(*rows, strict=True)] for w in (slopes, bends))
        spin = [[dot(change[3 * i : 3 * i + 3], R[j]) for j in range(3)] for i in range(3)]
        return [spin[2][1], spin[0][2], spin[1][0]], applied(R, change[9:]), sizes_of(bend[:9]).max()
