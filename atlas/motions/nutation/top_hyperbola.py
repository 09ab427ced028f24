"""The hyperbola of steady precessions of a symmetric top, theorem-top-hyperbola, and their stability."""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from atlas.arithmetic.certified_digits import enclosed
from atlas.arithmetic.dimensions import ENERGY, RATE
from atlas.arithmetic.double_double import over
from atlas.arithmetic.inputs import FloatArray, integer, number, plain, positive, real
from atlas.arithmetic.numbers import nearest, rounded
from atlas.bodies.display import Shown
from atlas.bodies.symmetric_top import arguments_of, inputs_of_top
from atlas.errors import DomainError
from atlas.motions.nutation.kernel_top import TopMotion
from atlas.surfaces import formula_top as top
from atlas.surfaces.certified_top import TopHyperbola as Exact
from atlas.surfaces.kernel import TopQuadric

Branch = tuple[FloatArray, FloatArray]
"""Points (omega2, omega3) of one branch."""


def halves(points: Any) -> tuple[int, int]:
    """Return a number of points as two numbers that add up to it, for two branches; the first is not the smaller.

    Raises AtlasError for fewer than two points.
    """
    count = integer(points, "The number of points of two branches", 2)
    return count - count // 2, count // 2


BITS = 64
"""Digits of the ends of a band, before they are rounded once."""


def branch(curve: Any, sign: int, w: FloatArray) -> Branch:
    """Return (omega2, omega3) of a `curve`, (m,) each, at the distances w (m,) > 0 from its pole, on the side +-1.

    The side is `sign`. An omega2 that rounds to the pole is replaced by the next float beside it.
    """
    omega2 = sign * w + curve.pole
    omega2 = np.where((omega2 - curve.pole) * sign > 0, omega2, np.nextafter(curve.pole, sign * np.inf))
    return omega2, np.asarray(curve.omega3(omega2))


class TopHyperbola(Shown):
    """The curve omega1 = 0 of `TopQuadric`: n3 w^2 - I n2 w v + n2^2 n3 D = 0, each point a steady precession.

    ``inertia`` (I2, I3), ``coupling`` (k2, k3), ``direction`` (n2, n3), ``linear`` and ``quadratic`` are those of
    `TopMotion`, of one top with n2 not zero; w, v and D are as in `TopQuadric`; in the formulas n is the unit
    vector and k the coupling over I2. The motion at omega2 is R(t) = R_n(k t) R_z(phi t), k = omega2/n2, phi =
    omega3 - n3 k: the paper's (85) for every top. Its pole w = 0, omega2 = -n2 k3/I, is left out. Raises
    DomainError for n2 = 0, AtlasError as `TopMotion` does.
    """

    made_by = "Hyperbola.of_top"

    def __init__(self, inertia: Any, coupling: Any, direction: Any, linear: float, quadratic: float) -> None:
        linear, quadratic = number(linear, "linear", ENERGY), number(quadratic, "quadratic", ENERGY)
        self._top = [number(x, "A parameter") for x in inputs_of_top(inertia, coupling, direction, linear, quadratic)]
        I2, I3, k2, k3, n2, n3, *_ = self._top
        self.given = (I2, I3), (k2, k3), (n2, n3), linear, quadratic
        self.quadric = TopQuadric(*self.given)
        self.arguments = arguments_of(self._top)
        self._exact = Exact(*self.given)

    @property
    def pole(self) -> float:
        """Value -n2 k3/I3 of omega2 in rad/time, rounded once: it is left out of the curve, one branch on each side."""
        return float(self.quadric.centre[1])

    @property
    def asymptotes(self) -> tuple[FloatArray, FloatArray]:
        """Unit directions (2,) in the plane (omega2, omega3) of both asymptotes: (0, 1), and along (I n2, n3).

        The first one is at the pole.
        """
        I2, I3, _, _, n2, n3, *_ = self._top
        axial = np.array([I3 * n2, I2 * n3])
        return np.array([0.0, 1.0]), axial / np.hypot(*axial)

    def omega3(self, omega2: Any) -> Any:
        """Return omega3 on the curve at omega2, rounded once, in rad/time: a float, or an array.

        Raises DomainError at the pole, AtlasError unless omega2 is a number or an array.
        """
        return self._over(top.omega3, self._exact.omega3, omega2)

    def frequencies(self, omega2: Any) -> tuple[Any, Any]:
        """Return (k = omega2/n2, phi = omega3 - n3 k): rates about n and about the axis, in rad/time, floats or arrays.

        Raises DomainError at the pole, AtlasError for an input that is no number.
        """
        k, phi = self._over(top.frequencies, self._exact.frequencies, omega2, degree=(1, 1))
        return k, phi

    def stability(self, omega2: Any) -> Any:
        """Square of the frequency of small nutations, in 1/time^2, theorem-top-nutation; unstable where negative.

        A float, or an array of the shape of omega2. Where it is zero see `stable`. Raises DomainError at the pole,
        AtlasError for an input that is no number.
        """
        return self._over(top.stability, self._exact.stability, omega2)

    def stable(self, omega2: Any) -> Any:
        """Whether the motion at omega2 is stable against nutation, decided exactly: a boolean, or an array of booleans.

        Raises DomainError at the pole, AtlasError for an input that is no number.
        """
        values = real(omega2, "omega2", RATE)
        stable = np.array([self._exact.stable(float(x)) for x in values.flat], dtype=bool).reshape(values.shape)
        return stable if stable.ndim else bool(stable)

    @property
    def unstable_bands(self) -> list[tuple[float, float]]:
        """List of intervals (low, high) of omega2, at most two, where the motions are unstable, ends included.

        They are in rad/time. Their ends are real roots of a quartic with exact coefficients, rounded once;
        `atlas.surfaces.certified_top` has them as balls.
        """
        ends = enclosed(lambda: self._exact.unstable_bands, BITS)
        return [(nearest(low), nearest(high)) for low, high in ends]

    def motion(self, omega2: float, omega1: float = 0.0) -> TopMotion:
        """Return the `TopMotion` at omega2, omega3 on the curve and rounded once; `omega1` perturbs it.

        Raises DomainError at the pole, AtlasError for an input that is no number.
        """
        inertia, coupling, direction, linear, quadratic = self.given
        return TopMotion(inertia, coupling, direction, (omega1, omega2, self.omega3(omega2)), linear, quadratic)

    def sample(self, points: int = 200, *, reach: float = 4.0) -> Branch:
        """Return (omega2, omega3), in rad/time, arrays of all ``points`` of both branches, one after the other.

        For the largest |w|, given by ``reach``, and for errors see `branches`.
        """
        start, second = zip(*self.branches(points, reach=reach), strict=True)
        return np.concatenate(start), np.concatenate(second)

    def branches(self, points: int = 200, *, reach: float = 4.0) -> tuple[Branch, Branch]:
        """Return two pairs of arrays (omega2, omega3), the branch w > 0 first, even in the logarithm of |w|.

        Both are in rad/time, and ``points`` is the number of points of both branches together. For w, v and D see
        the class. |w| runs from where |v| to where |w| is ``reach`` times b, the largest of three rates: the
        distance of the centre from rest, sqrt|D|, and the root of I |w v| near the pole (b is 1 if all are zero).
        Each omega3 is that of the double omega2, rounded once. Raises DomainError where the curve is two straight
        lines, n3 = 0 without a linear potential, AtlasError for fewer than two points.
        """
        I2, I3, _, _, n2, n3, a0, _ = self._top
        if n3 == 0 and a0 == 0:
            raise DomainError("With n3 = 0 and no linear potential the curve is the two lines w = 0 and v = 0.")
        transverse = abs(n2) / np.hypot(n2, n3)
        D = 0.0 if n3 == 0 else abs(float(self.quadric.D))
        push = abs(a0) / I2 * transverse if n3 == 0 else D * abs(n3 / n2) * transverse**2
        b = max(float(np.hypot(*self.quadric.centre[1:])), D**0.5, push**0.5)
        high = positive(reach, "reach") * (b or 1.0)
        low = min(push * I2 / I3 / high or 1e-3 * high, high / np.e)
        upper, lower = (np.geomspace(low, high, n) for n in halves(points))
        return branch(self, 1, upper), branch(self, -1, lower)

    def _over(self, formula: Any, exact: Callable[[float], Any], omega2: Any, degree: Any = 1) -> Any:
        """Return a formula of `formula_top` at omega2, each result rounded once: a float or array, or a list of these.

        ``degree`` is its power of rates, a sequence for several results. ``exact`` is its certified counterpart at
        one omega2. Raises DomainError at the pole.
        """
        values, is_single = real(omega2, "omega2", RATE), partial(rounded, lambda *row: exact(row[8]))
        return over(top.of_given(formula), *self._top, plain(values), degree=degree, scalar_path=is_single)
