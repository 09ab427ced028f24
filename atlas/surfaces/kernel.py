"""The quadric of initial data with constant Omega3, (51), its canonical form (54) to (57), and that of every top."""

from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from flint import fmpq

from atlas.arithmetic.annotations import BodyLike, FieldLike, FloatOrArray, NameOrArray, RealArrayLike
from atlas.arithmetic.dimensions import RATE
from atlas.arithmetic.double_double import BLOCK, over
from atlas.arithmetic.given import Given
from atlas.arithmetic.inputs import FloatArray, as_given, common_shape, components, frozen_property, plain, vectors
from atlas.arithmetic.numbers import rounded
from atlas.bodies.body import exact_moments, excess, kept_ratio
from atlas.bodies.display import Shown
from atlas.bodies.formula_domain import check_a2, check_a3, check_beta, check_D
from atlas.bodies.symmetric_top import arguments_of, inputs_of_top
from atlas.surfaces import formula as quadric
from atlas.surfaces import formula_top as top

if TYPE_CHECKING:
    from atlas.surfaces.certified_top import TopQuadric as Exact

KINDS = ("all space", "line", "plane pair", "cone", "two-sheet hyperboloid", "one-sheet hyperboloid")


class Quadric(Shown):
    """Quadric of initial data with constant Omega3, eqs. (51)-(57).

    Its equation is omega1^2 + (omega2+B2)^2 - (I B2/B3)(omega2+B2)(omega3+B3) = (1-I) B2^2.

    Parameters
    ----------
    ratio : float or array_like or SymmetricBody
        I = I3/I2, in (0, 2].
    field : (B2, B3), array_like, or Field
        Components of B' = mu B/(2c), of either sign, in 1/time.

    Raises
    ------
    DomainError
        For a ratio that no body has. Attributes raise where they are infinite or undefined, see Notes.
    AtlasError
        For an input that is no number.

    Notes
    -----
    Inputs are taken as exact and broadcast; scalars are rounded once. In the coordinates (53) about the centre,

        omega'_1^2 - omega'_2^2/a2 + omega'_3^2/a3 = (1 - I) B2^2.                                               (54)

    a2 and a3 have the sign of B3. The paper takes B3 > 0; for B3 < 0 the axes 2 and 3 interchange their roles. The
    cone has the semi-axes (70), while its C1, C2, C3 are zero.

    - B2 = 0 ("line"): C1, C2, C3 are zero, and the infinite one of a2, a3 raises DomainError.
    - B = 0 ("all space"): beta, a2, a3 and the axes raise DomainError, since I^-1 B' has no direction.

    Examples
    --------
    >>> atlas.Quadric(1.5, (1.0, 2.0)).kind
    'two-sheet hyperboloid'
    """

    family = "quadric"

    def __init__(self, ratio: BodyLike, field: FieldLike) -> None:
        B2, B3 = components(field, ("B2", "B3"), "The field", RATE)
        I2, I3 = exact_moments(ratio)
        self._inputs = (I2, I3, as_given(B2), as_given(B3))
        self.shape = common_shape(*map(np.shape, self._inputs))
        self.field = (plain(B2), plain(B3))
        self.arguments = {"ratio": kept_ratio(ratio, I3), "field": self._inputs[2:]}

    @classmethod
    def of_top(
        cls,
        inertia: BodyLike,
        coupling: RealArrayLike,
        direction: RealArrayLike,
        linear: RealArrayLike = 0.0,
        quadratic: RealArrayLike = 0.0,
    ) -> "TopQuadric":
        """Quadric of starts with nu'' = 0 of a symmetric top, theorem-top-quadric.

        Parameters
        ----------
        inertia : (I2, I3), array_like
            Moments across and along the axis.
        coupling : (k2, k3), array_like
            Gyroscopic coupling, in inertia/time.
        direction : (n2, n3), array_like
            Constant vector n in the body at t = 0.
        linear, quadratic : float or array_like
            Coefficients of the potential, in inertia/time^2, as in `TopMotion`.

        Returns
        -------
        TopQuadric
            Quadric of this top.

        Raises
        ------
        DomainError, AtlasError
            As for `TopMotion`.
        """
        return TopQuadric(inertia, coupling, direction, linear, quadratic)

    @frozen_property
    def kind(self) -> NameOrArray:
        """Type of the surface, decided exactly on I2, I3, B2, B3: a string, or an array of strings.

        Notes
        -----
        One of "two-sheet hyperboloid" (I > 1), "cone" (I = 1), "one-sheet hyperboloid" (I < 1), "plane pair" (B3 = 0),
        "line" (B2 = 0) and "all space" (B = 0).
        """
        B2, B3, difference = np.broadcast_arrays(*self._inputs[2:], excess(*self._inputs[:2]))
        names = np.select(
            [(B2 == 0) & (B3 == 0), B2 == 0, B3 == 0, difference == 0, difference > 0], KINDS[:-1], KINDS[-1]
        )
        return names if names.ndim else str(names)

    @frozen_property
    def beta(self) -> FloatOrArray:
        """Angle beta from e2 to I^-1 B', tan(beta) = B3/(I B2), (53), in (-pi, pi] rad.

        Raises
        ------
        DomainError
            For B = 0.
        """
        I2, I3, B2, B3 = self._directed()
        is_upright = np.equal(B2, 0)
        slope = over(quadric.tangent, I2, I3, _replaced(B2, is_upright), B3, unit=slice(2, None), degree=0)
        rise, run = np.where(is_upright, 1.0, slope), np.where(is_upright, 0.0, np.copysign(1.0, B2))
        values: FloatOrArray = plain(np.arctan2(np.copysign(rise, B3), run))
        return values

    @frozen_property
    def a2(self) -> FloatOrArray:
        """Coefficient a2 = 2 sin(beta)/(1 - sin(beta)), (54).

        Raises
        ------
        DomainError
            For B2 = 0 with B3 >= 0.
        """
        I2, I3, B2, B3 = self._directed()
        check_a2(*map(np.asarray, (B2, B3)))
        return over(quadric.a2, I2, I3, B2, B3, unit=slice(2, None), degree=0)

    @frozen_property
    def a3(self) -> FloatOrArray:
        """Coefficient a3 = 2 sin(beta)/(1 + sin(beta)), (54).

        Raises
        ------
        DomainError
            For B2 = 0 with B3 <= 0.
        """
        I2, I3, B2, B3 = self._directed()
        check_a3(*map(np.asarray, (B2, B3)))
        return over(quadric.a3, I2, I3, B2, B3, unit=slice(2, None), degree=0)

    @frozen_property
    def semi_axes(self) -> tuple[float, float, float] | FloatArray:
        """Semi-axes C1, C2, C3 = sqrt(|1-I| B2^2 (1, |a2|, |a3|)), (55), (57), in 1/time; shape (..., 3)."""
        I2, I3, B2, B3 = self._inputs
        is_upright = np.equal(B2, 0)
        semi_axes = over(
            quadric.semi_axes, I2, I3, _replaced(B2, is_upright), B3, unit=slice(2, None), degree=(1, 1, 1)
        )
        C1, C2, C3 = (plain(np.where(is_upright, 0.0, C)) for C in semi_axes)
        return (C1, C2, C3) if isinstance(C1, float) else np.stack((C1, C2, C3), axis=-1)

    @frozen_property
    def centre(self) -> FloatArray:
        """Centre -B' = (0, -B2, -B3), (53); shape (..., 3), in 1/time."""
        _, I3, B2, B3 = self._inputs
        return 0.0 - np.stack(np.broadcast_arrays(0.0, B2, B3, I3)[:3], -1)

    @frozen_property
    def axes(self) -> FloatArray:
        """Unit vectors of the coordinates omega'_1, omega'_2, omega'_3 as rows, (53); shape (..., 3, 3).

        Raises
        ------
        DomainError
            For B = 0.

        Notes
        -----
        Axes 2 and 3 are rotated by beta/2 + pi/4 in the plane (e2, e3).
        """
        I2, I3, B2, B3 = self._directed()
        cos, sin = over(quadric.half_angle, I2, I3, B2, B3, unit=slice(2, None), degree=(0, 0))
        is_left, is_below = np.less(B2, 0), np.less(B3, 0)
        cos, sin = np.where(is_left & ~is_below, -cos, cos), np.where(is_left & is_below, -sin, sin)
        axes = np.zeros((*cos.shape, 3, 3))
        rows, flat = axes.reshape(-1, 9), np.stack([cos, sin]).reshape(2, -1)
        for i in range(0, len(rows), BLOCK):  # a part at a time stays in the cache
            row, (c, s) = rows[i : i + BLOCK], flat[:, i : i + BLOCK]
            row[:, 0] = 1.0
            row[:, 4], row[:, 5], row[:, 7], row[:, 8] = c, s, 0.0 - s, c
        return axes

    def canonical(self, omega: RealArrayLike) -> FloatArray:
        """Canonical coordinates omega'_1, omega'_2, omega'_3 of points, eq. (53).

        Parameters
        ----------
        omega : array_like, shape (..., 3)
            Points, in rad/time.

        Returns
        -------
        ndarray, shape (..., 3)
            Coordinates, in rad/time; inf beyond the largest float.

        Raises
        ------
        DomainError
            For B = 0.
        AtlasError
            For an input that is no vector.
        """
        omega = vectors(omega, "omega", RATE)
        common_shape(self.shape, omega.shape[:-1])
        # the difference and its turn may be larger than the coordinates: a quarter of each is not
        power = -2 if max(np.abs(omega).max(initial=0.0), np.abs(self.centre).max(initial=0.0)) > 1.0 else 0
        coordinates = np.matvec(self.axes, np.ldexp(omega, power) - np.ldexp(self.centre, power))
        with np.errstate(over="ignore"):
            return np.asarray(np.ldexp(coordinates, -power))

    def residual(self, omega: RealArrayLike) -> FloatOrArray:
        """Residual of eq. (50) at points, zero on the surface only.

        Parameters
        ----------
        omega : array_like, shape (..., 3)
            Points, in rad/time.

        Returns
        -------
        float or ndarray
            B3 (omega1^2 + omega2^2) - I B2 omega2 omega3 + (2-I) B2 B3 omega2 - I B2^2 omega3, in 1/time^3, rounded
            once.

        Raises
        ------
        AtlasError
            For an input that is no vector.
        """
        points = np.moveaxis(vectors(omega, "omega", RATE), -1, 0)
        return over(quadric.residual, *self._inputs, *points, unit=slice(2, None), degree=3)

    def _directed(self) -> tuple[Any, ...]:
        """Return the inputs (I2, I3, B2, B3). Raises DomainError if I^-1 B' has no direction, for B = 0."""
        check_beta(*map(np.asarray, self._inputs[2:]))
        return self._inputs


def _replaced(numbers: Any, places: Any) -> Any:
    """Return a copy of numbers (an array or a `Given`) with 1 where the mask ``places`` is true.

    Without such a place the numbers are returned unchanged.
    """
    if not np.any(places):
        return numbers
    if not isinstance(numbers, Given):
        return np.where(places, 1.0, numbers)
    hi, low = np.where(places, 1.0, numbers.hi), np.where(places, 0.0, numbers.lo)
    return Given(hi, low, numbers.rel, lambda index: fmpq(1) if places[index] else numbers.at(index))


def _exactly(row: Any) -> "Exact":
    """Return the certified `TopQuadric` of one row of inputs: I2, I3, k2, k3, n2, n3, a0, A0, floats taken as exact."""
    from atlas.surfaces.certified_top import TopQuadric as Exact

    I2, I3, k2, k3, n2, n3, a0, A0 = (float(x) for x in row)
    return Exact((I2, I3), (k2, k3), (n2, n3), a0, A0)


class TopQuadric(Quadric):
    """The surface n3 (omega1^2 + w^2) - I n2 w v + n2^2 n3 D = 0 of starts of a top at which nu'' = 0, nu = cos theta.

    theta is the angle between the axis and n. The inputs are those of `TopMotion` without omega, and broadcast. In
    units of I2, with n a unit vector,

        w = omega2 + n2 k3/I,    v = omega3 + n3 (k3 - 2 kappa)/I,    D = A + kappa^2 + a0/n3,

    kappa = k2 - k3/I, A = A0 + k3^2/I - k2^2, (k2, k3) the coupling, a0 and A0 the `linear` and the `quadratic`
    potential. The surface is (51) for k2 = b, k3 = I b, n = B'/b without a potential, and D is in the place of (I -
    1) b^2. `beta`, `a2`, `a3` and `axes` are as in (53) and (54) with n in the place of B', `semi_axes` the square
    roots of |D| n2^2 (1, |a2|, |a3|), all 0 for the cone, D = 0. Steady motions, see `Hyperbola.of_top`, have
    omega1 = 0: for omega1 != 0 the axis leaves its start although nu'' = 0 there.

    Degenerate kinds: for n2 = 0 ("line") as in `Quadric`; for n3 = 0 "plane pair", with a linear potential
    "hyperbolic cylinder", for which D is infinite: the object is made, and `D` and `semi_axes` raise DomainError
    when they are read.
    """

    family = ""
    made_by = "Quadric.of_top"

    def __init__(
        self,
        inertia: BodyLike,
        coupling: RealArrayLike,
        direction: RealArrayLike,
        linear: RealArrayLike,
        quadratic: RealArrayLike,
    ) -> None:
        self._top = inputs_of_top(inertia, coupling, direction, linear, quadratic)
        self._inputs = tuple(plain(self._top[i]) for i in (0, 1, 4, 5))  # n in the place of B'
        self.shape = common_shape(*map(np.shape, self._top))
        self.direction = self._inputs[2:]
        self.arguments = arguments_of(self._top)

    @frozen_property
    def kind(self) -> NameOrArray:
        """Kind of the surface, the sign of D: decided exactly on the inputs as given.

        One of "two-sheet hyperboloid" (D > 0), "cone" (D = 0), "one-sheet hyperboloid" (D < 0); for n3 = 0 "plane pair"
        or, with a linear potential, "hyperbolic cylinder"; "line" for n2 = 0.
        """
        rows = zip(*(x.flat for x in np.broadcast_arrays(*self._top)), strict=True)
        names = np.array([_exactly(row).kind for row in rows]).reshape(self.shape)
        return names if names.ndim else str(names)

    @frozen_property
    def D(self) -> FloatOrArray:
        """D = A + kappa^2 + a0/n3, over I2, in 1/time^2, rounded once.

        Raises DomainError for n3 = 0 with a linear potential.
        """
        self._needs_finite()
        values: FloatOrArray = self._over(top.D, lambda exact: exact.D)
        return values

    @frozen_property
    def semi_axes(self) -> tuple[float, float, float] | FloatArray:
        """Semi-axes C1, C2, C3, the roots of |D| n2^2 (1, |a2|, |a3|), in rad/time; a tuple, or shape (..., 3).

        Zeros for n2 = 0. Raises DomainError for n3 = 0 with a linear potential.
        """
        self._needs_finite()
        semi_axes = self._over(top.semi_axes, lambda exact: exact.semi_axes, degree=(1, 1, 1), upright=True)
        C1, C2, C3 = (plain(np.where(np.asarray(self._top[4]) == 0, 0.0, C)) for C in semi_axes)
        return (C1, C2, C3) if isinstance(C1, float) else np.stack((C1, C2, C3), axis=-1)

    @frozen_property
    def centre(self) -> FloatArray:
        """Centre (0, omega2, omega3) of the surface, w = v = 0, shape (..., 3), in rad/time; for n2 = 0 too."""
        second, third = self._over(top.centre, lambda exact: exact.centre[1:], degree=(1, 1))
        return np.stack(np.broadcast_arrays(0.0, second, third), -1)

    def residual(self, omega: RealArrayLike) -> FloatOrArray:
        """Left-hand side at points ``omega`` (..., 3) in rad/time, rounded once: -nu'' at the start, in 1/time^2.

        Zero on the surface only. Raises AtlasError for an input that is no vector.
        """
        points = np.moveaxis(vectors(omega, "omega", RATE), -1, 0)
        values: FloatOrArray = self._over(top.residual, lambda exact, *w: exact.residual(w), *points)
        return values

    def _over(self, formula: Any, exact: Any, *points: Any, degree: Any = 1, upright: bool = False) -> Any:
        """Return results of a ``formula`` of `formula_top` for each top, each rounded once, as `over` does.

        ``exact`` takes the certified quadric and the points, and replaces the formula where rounding is in doubt.
        ``points`` are further arguments, ``degree`` is as for `over`; with ``upright`` n2 = 0 is replaced by 1.
        """
        inputs = list(self._top)
        if upright:
            inputs[4] = np.where(np.asarray(inputs[4]) == 0, 1.0, inputs[4])
        exactly = partial(rounded, lambda *row: exact(_exactly(row[:8]), *row[8:]))
        return over(top.of_given(formula), *inputs, *points, degree=degree, scalar_path=exactly)

    def _needs_finite(self) -> None:
        """Raise DomainError where D is infinite: n3 = 0 with a linear potential."""
        check_D(np.asarray(self._top[5]), np.asarray(self._top[6]))
