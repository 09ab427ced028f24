"""The hyperbola of elementary motions, (67) to (72), sampled by hyperbolic parameter, and its stability."""

from collections.abc import Callable
from math import inf, isfinite
from typing import TYPE_CHECKING, Any

import numpy as np

from atlas.arithmetic.annotations import BodyLike, FieldLike, FloatOrArray, RealArrayLike
from atlas.arithmetic.dimensions import RATE
from atlas.arithmetic.double_double import over
from atlas.arithmetic.inputs import FloatArray, as_given, components, integer, plain, positive, real
from atlas.arithmetic.lazy import cached_property
from atlas.arithmetic.numbers import Number, length, nearest, root, workprec
from atlas.arithmetic.words import exact
from atlas.bodies.body import exact_moments, kept_ratio
from atlas.bodies.display import Shown
from atlas.bodies.formula_domain import check_asymptotes, check_curve
from atlas.errors import AtlasError, DomainError
from atlas.motions.elementary.closed import ClosedMotion
from atlas.motions.elementary.formula_hyperbola import frequencies, least_stability, ordinate, stability
from atlas.motions.nutation.top_hyperbola import Branch, branch, halves

if TYPE_CHECKING:
    from atlas.motions.nutation.kernel_general import GeneralMotion
    from atlas.motions.nutation.top_hyperbola import TopHyperbola

MAX_POINTS = 10**8
"""Points of a curve that are sampled in one call."""


class Hyperbola(Shown):
    """Hyperbola of elementary motions in the plane omega1 = 0, eqs. (67)-(72), and its stability.

    Its equation is B3 w2^2 - I B2 w2 w3 + (2-I) B2 B3 w2 - I B2^2 w3 = 0.

    Parameters
    ----------
    ratio : float or array_like or SymmetricBody
        I = I3/I2, in (0, 2].
    field : (B2, B3), array_like, or Field
        Components of B' = mu B/(2c), of either sign, in 1/time.

    Raises
    ------
    DomainError
        For a ratio that no body has.
    AtlasError
        For an input that is no number.

    Notes
    -----
    About the centre -B', with X = omega2 + B2 and Y = omega3 + B3, the curve is

        Y = (B3/(I B2)) (X - (1-I) B2^2/X),     X = ± sqrt|1-I| |B2| e^s,

    with the hyperbolic parameter s. The vertical asymptote X = 0 is the pole. Special cases:

    - B3 = 0: the two lines omega3 = 0 and omega2 = -B2;
    - B2 = 0: the line omega2 = 0;
    - B = 0: the whole plane;
    - I = 1: the line Y = (B3/B2) X, and the pole as a second line.

    Arrays of parameters broadcast in `omega3`, `frequencies`, `stability` and `least_stability`. The other members
    need one curve.

    Examples
    --------
    >>> round(atlas.Hyperbola(1.5, (1.0, 2.0)).omega3(0.7), 9)
    0.658823529
    """

    family = "hyperbola"

    def __init__(self, ratio: BodyLike, field: FieldLike) -> None:
        I2, I3 = exact_moments(ratio)
        B2, B3 = map(as_given, components(field, ("B2", "B3"), "The field", RATE))
        self._inputs = I2, I3, B2, B3
        self.I2, self.I3, self.B2, self.B3 = map(plain, self._inputs)
        self.arguments = {"ratio": kept_ratio(ratio, I3), "field": (B2, B3)}

    @classmethod
    def of_top(
        cls,
        inertia: BodyLike,
        coupling: RealArrayLike,
        direction: RealArrayLike,
        linear: float = 0.0,
        quadratic: float = 0.0,
    ) -> "TopHyperbola":
        """Hyperbola of the steady precessions of one symmetric top (not in the paper).

        Parameters
        ----------
        inertia : (I2, I3)
            Moments across and along the axis.
        coupling : (k2, k3)
            Gyroscopic coupling, in inertia/time.
        direction : (n2, n3)
            Constant vector n in the body at t = 0.
        linear, quadratic : float
            Coefficients of the potential, in inertia/time^2, as in `TopMotion`.

        Returns
        -------
        TopHyperbola
            Hyperbola of this top.

        Raises
        ------
        DomainError
            For n2 = 0.
        AtlasError
            As for `TopMotion`.
        """
        from atlas.motions.nutation.top_hyperbola import TopHyperbola

        return TopHyperbola(inertia, coupling, direction, linear, quadratic)

    @cached_property
    def _exact(self) -> tuple[Number, ...]:
        """Exact (I2, I3, B2, B3) of one curve, rationals. Raises AtlasError for arrays."""
        if np.ndim(self.I3) or np.ndim(self.B2) or np.ndim(self.B3):
            raise AtlasError("This is asked of one curve: give the ratio and the field as numbers, not as arrays.")
        return exact(*self._inputs)

    @property
    def pole(self) -> FloatOrArray:
        """Pole omega2 = -B2, excluded from (71), in rad/time."""
        pole: FloatOrArray = 0.0 - self.B2
        return pole

    @property
    def asymptotes(self) -> tuple[FloatArray, FloatArray]:
        """Unit vectors (2,) in the plane (omega2, omega3) of the asymptotes of (67): the pole's, then that of I^-1 B'.

        Raises
        ------
        DomainError
            For B2 = 0 or B3 = 0, where the curve consists of lines.
        """
        I2, I3, B2, B3 = self._exact
        check_asymptotes(B2, B3)
        with workprec():
            x, y = I3 * B2, I2 * B3
            h = length(x, y)
            return np.array([0.0, 1.0]), np.array([nearest(x / h), nearest(y / h)])

    @property
    def special(self) -> dict[str, tuple[float, float]]:
        """Points (omega2, omega3) of (67) in rad/time: rest, -2 B' (phi = 0), and the other zero of omega3.

        Notes
        -----
        Their names are "omega2 = 0", "omega2 = -2 B2" and "omega2 = -(2-I) B2".
        """
        I2, I3, B2, _ = self._exact
        zero = (I3 - I2 - I2) * B2 / I2
        return {
            "omega2 = 0": (0.0, 0.0),
            "omega2 = -2 B2": (-2 * self.B2, -2 * self.B3),
            "omega2 = -(2-I) B2": (nearest(zero), 0.0),
        }

    def omega3(self, omega2: RealArrayLike) -> FloatOrArray:
        """Ordinate omega3 of the curve at omega2, eq. (71).

        Parameters
        ----------
        omega2 : float or array_like
            Abscissa, in rad/time.

        Returns
        -------
        float or ndarray
            omega3 in rad/time, rounded once.

        Raises
        ------
        DomainError
            At the pole, for B2 = 0, and for an infinite omega2 or NaN, of any element.
        AtlasError
            For an input that is no number.
        """
        values: FloatOrArray = self._over(ordinate, omega2)
        return values

    def frequencies(self, omega2: RealArrayLike) -> tuple[FloatOrArray, FloatOrArray]:
        """Frequencies k = omega2/B2hat, eq. (79), and phi, eq. (72), at omega2.

        Parameters
        ----------
        omega2 : float or array_like
            Abscissa, in rad/time.

        Returns
        -------
        k, phi : float or ndarray
            Frequencies in rad/time, each rounded once.

        Raises
        ------
        DomainError
            At the pole, for B2 = 0, and for an infinite omega2 or NaN, of any element.
        AtlasError
            For an input that is no number.
        """
        k, phi = self._over(frequencies, omega2, degree=(1, 1))
        return k, phi

    def closed(self, p: int, q: int) -> ClosedMotion:
        """Motion of the curve with phi/k = p/q exactly, theorem-closed, which closes after q precessions.

        Parameters
        ----------
        p, q : int
            Numerator and denominator.

        Returns
        -------
        ClosedMotion
            The only such motion.

        Raises
        ------
        DomainError
            For p/q = (1-I) B3hat/I or twice this value; for I = 1, B2 = 0 or B3 = 0.
        AtlasError
            Unless p and q are integers.
        """
        return ClosedMotion(self.arguments["ratio"], self._inputs[2:], p, q)

    def stability(self, omega2: RealArrayLike) -> FloatOrArray:
        """Squared frequency of nutation -p'(omega3), with the cubic p of (47), theorem-stability (not in the paper).

        Parameters
        ----------
        omega2 : float or array_like
            Abscissa, in rad/time.

        Returns
        -------
        float or ndarray
            Squared frequency in 1/time^2, inf where it overflows: positive for stable, negative for unstable motions.

        Raises
        ------
        DomainError
            At the pole, for B2 = 0, and for an infinite omega2 or NaN, of any element.
        AtlasError
            For an input that is no number.

        Notes
        -----
        With X = omega2 + B2 and tau = B3/B2 the value is tau^2 [X^2 + (1-I) B2^2]^2/X^2 + X^2 - (1-I) B2^2. At a zero,
        an end of the unstable band, the motion is unstable, theorem-band-ends, unless B3 = 0,
        theorem-equatorial-stability.
        """
        values: FloatOrArray = self._over(stability, omega2, degree=2)
        return values

    def growth_rate(self, omega2: RealArrayLike) -> FloatOrArray:
        """Growth rate of a small departure from the motion at omega2: sqrt(-`stability`), or 0 where positive.

        Parameters
        ----------
        omega2 : float or array_like
            Abscissa, in rad/time.

        Returns
        -------
        float or ndarray
            Rate in 1/time; 0 also at the ends of the unstable band, where departures grow as a power of time.

        Raises
        ------
        DomainError
            At the pole, for B2 = 0, and for an infinite omega2 or NaN, of any element.
        AtlasError
            For an input that is no number.
        """
        values: FloatOrArray = plain(np.sqrt(np.maximum(-np.asarray(self.stability(omega2)), 0.0)))
        return values

    def escape(self, omega2: float, omega1: float) -> "GeneralMotion":
        """General motion that starts next to the curve, at (omega1, omega2, omega3 by (71)).

        Parameters
        ----------
        omega2 : float
            Abscissa, in rad/time.
        omega1 : float
            Small departure from the plane omega1 = 0, in rad/time.

        Returns
        -------
        GeneralMotion
            Motion with its `period` and `turning_points`. In the unstable band Omega3 moves to the next root of
            the quartic Q, Q(Omega3) = (dOmega3/dt)^2, and back.

        Raises
        ------
        DomainError
            At the pole, for B2 = 0, and for an infinite omega2 or NaN.
        AtlasError
            For an input that is no number.
        """
        from atlas.motions.nutation.kernel_general import GeneralMotion

        omega3 = self.omega3(omega2)
        return GeneralMotion(self.arguments["ratio"], self._inputs[2:], (omega1, omega2, omega3))

    @property
    def least_stability(self) -> FloatOrArray:
        """Infimum of `stability` on the curve, in 1/time^2, rounded once (not in the paper).

        Raises
        ------
        DomainError
            For B2 = 0.

        Notes
        -----
        The value is 2 |1-I| |B3| b - (1-I)(B2^2 - 2 B3^2) with b = |B'|, at ((omega2 + B2)/B2)^2 = |1-I| |B3|/b. For I
        = 1 or B3 = 0 the infimum is approached at the pole. The root of a negative value is the largest growth rate.
        """
        if np.any(np.equal(self.B2, 0)):
            raise DomainError("With B2 = 0 the curve (67) is the line omega2 = 0, and omega3 is free on it.")
        return over(least_stability, *self._inputs, unit=slice(2, None), degree=2) + 0.0

    @property
    def unstable_band(self) -> tuple[float, float] | None:
        """Interval [y-, y+] of ((omega2 + B2)/B2)^2 with unstable motions, theorem-band; None if all are stable.

        Notes
        -----
        For I < 1 and |tau| = |B3/B2| <= 1/(2 sqrt 2): y± = (1-I)[1 - 2 tau^2 ± sqrt(1 - 8 tau^2)]/(2 (1 + tau^2)). The
        ends belong to the band unless B3 = 0.
        """
        I2, I3, B2, B3 = self._exact
        disc = B2 * B2 - 8 * B3 * B3
        if I3 >= I2 or disc <= 0:
            return None
        tau2, one_less = B3 * B3 / (B2 * B2), (I2 - I3) / I2
        with workprec():
            # y- y+ = (1-I)^2 tau^2/(1 + tau^2): y- from y+ does not cancel
            sum_ = 1 - 2 * tau2 + root(disc / (B2 * B2))
            return nearest(2 * one_less * tau2 / sum_), nearest(one_less * sum_ / (2 + 2 * tau2))

    def sample(self, points: RealArrayLike = 200, *, reach: float = 4.0) -> Branch:
        """Points (omega2, omega3) of all branches of (67), one branch after the other; see `branches`.

        Parameters
        ----------
        points : int or array_like
            Number of points, or values of the hyperbolic parameter s.
        reach : float
            Extent of the curve, in units of |B'|.

        Returns
        -------
        omega2, omega3 : ndarray
            Coordinates in rad/time.

        Raises
        ------
        DomainError, AtlasError
            As for `branches`.
        """
        omega2, omega3 = zip(*self.branches(points, reach=reach), strict=True)
        return np.concatenate(omega2), np.concatenate(omega3)

    def branches(self, points: RealArrayLike = 200, *, reach: float = 4.0) -> tuple[Branch, ...]:
        """Branches of (67) sampled by the hyperbolic parameter s, X = ± sqrt|1-I| |B2| e^s; X > 0 first.

        Parameters
        ----------
        points : int or array_like
            Total number of points, uniform in s, or the values of s. For I = 1, X = ± |B2| e^s. Lines need a number.
        reach : float
            Extent of |X| and |Y|, in units of |B'|.

        Returns
        -------
        tuple of (omega2, omega3)
            Pair of arrays for each branch, in rad/time; each omega3 is that of the float omega2, rounded once.

        Raises
        ------
        DomainError
            For B = 0, where every point is a motion, and for extents beyond the largest float.
        AtlasError
            For fewer than two or more than 10^8 points, and for values of s on a line.
        """
        points = points if isinstance(points, int) and points <= MAX_POINTS else plain(real(points, "The points"))
        if np.ndim(points) == 0 and points > MAX_POINTS:
            raise AtlasError(f"The number of points must be at most {MAX_POINTS}, not {points:g}.")
        with workprec():
            b = nearest(length(*self._exact[2:]))
        extent = positive(reach, "reach") * b
        if not isfinite(extent):
            raise DomainError(f"The field must be smaller: {reach} times |B'| = {b} is beyond the largest float.")
        if b == 0:
            raise DomainError("With B = 0 every point (omega2, omega3) is a motion: there is no curve to sample.")
        if self.B2 and self.B3:
            right, left = self._distances(points, extent)
            return branch(self, 1, right), branch(self, -1, left)
        if np.ndim(points):
            raise AtlasError(
                "With B2 = 0 or B3 = 0 the curve is straight and has no parameter: give a number of points."
            )
        if self.B2 == 0:
            y = np.linspace(-extent, extent, integer(points, "The number of points"))
            return ((np.zeros_like(y), y - self.B3),)
        x, y = (np.linspace(-extent, extent, n) for n in halves(points))
        return (x - self.B2, np.zeros_like(x)), (np.full_like(y, -self.B2), y)

    def _distances(self, points: Any, extent: float) -> list[FloatArray]:
        """Return |X| on the branch X > 0 and on the branch X < 0, two arrays in rad/time.

        ``points`` is their total number, spread evenly in s, or s itself for both; ``extent`` bounds |X| and |Y|, in
        rad/time. Raises DomainError where B2 and B3 are too far apart for floats, AtlasError for parameters that
        lead beyond all floats.
        """
        if np.ndim(points):
            s = real(points, "The parameter")
            with np.errstate(over="ignore", invalid="ignore"):
                w = self._scale() * np.exp(s)
            if not np.isfinite(w).all():
                raise AtlasError(f"A parameter of {np.max(s)} leads beyond the largest float.")
            return [w, w]
        I2, I3, b2, b3 = self._exact
        B2, tangent = abs(self.B2), nearest(abs(I2 * b3 / (I3 * b2)))
        scale = self._scale()
        if not 0 < tangent * B2 / extent < inf or not 0 < extent / scale < inf:
            raise DomainError(f"B2 = {self.B2} and B3 = {self.B3} are too far apart: B3/(I B2) must be a float.")
        high = np.log(extent / scale)
        low = np.log(scale / B2) + np.log(tangent * B2 / extent) if I2 != I3 else high - np.log(1e3)
        return [scale * np.exp(np.linspace(min(low, high - 1), high, n)) for n in halves(points)]

    def _scale(self) -> float:
        """Return |X| at s = 0, in rad/time: the vertical semi-axis of the curve, or |B2| for I = 1."""
        I2, I3, B2, _ = self._exact
        with workprec():
            return nearest(root(abs(I2 - I3) / I2 * B2 * B2)) or abs(self.B2)

    def _over(self, formula: Callable[..., Any], omega2: Any, **options: Any) -> Any:
        """Return the results of a formula of I2, I3, B2, B3 and omega2 (rad/time, any shape), each rounded once.

        Raises DomainError at an omega2 where (71) does not hold. ``options`` is passed to `over`.
        """
        omega2 = real(omega2, "omega2", RATE)
        check_curve(self.B2, omega2)
        return over(formula, *self._inputs, omega2, unit=slice(2, None), **options)
