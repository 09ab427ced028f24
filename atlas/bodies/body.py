"""Symmetric bodies: the moments of inertia I1 = I2 and I3, and the mass matrix (8) behind them."""

import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, Self, TypeVar

import numpy as np
from flint import fmpq

from atlas.arithmetic.annotations import FloatOrArray, RealArrayLike
from atlas.arithmetic.dimensions import DENSITY, INERTIA, LENGTH, MASS
from atlas.arithmetic.double_double import exact_results, over
from atlas.arithmetic.given import exact_number as given_number
from atlas.arithmetic.inputs import FloatArray, as_given, common_shape, matrix, number, numbers, plain
from atlas.arithmetic.numbers import nearest
from atlas.arithmetic.uncertainty import CarriesUncertainty
from atlas.bodies import formula_shapes as formulas
from atlas.bodies.formula_domain import NO_SUCH_BODY, ROD, check_ratio
from atlas.bodies.inertia import (
    ROUNDING,
    diagonal_or_matrices,
    exact_mass_matrix,
    inertia_from_mass_matrix,
    mass_matrix_from_inertia,
    principal_values,
    rational_matrix,
    rounded,
)
from atlas.errors import AtlasError, DomainError, NearlySymmetricWarning
from atlas.viewers import notebook

__all__ = [
    "SHAPES", "SymmetricBody", "exact_moments", "from_shape", "inertia_from_mass_matrix", "mass_matrix_from_inertia",
    "moments",
]  # fmt: skip

Made = TypeVar("Made", bound="SymmetricBody")

NEARLY_EQUAL = 1e-9
"""Relative difference of principal values up to which a symmetric body is made of them, with a warning."""


def exact_moments(ratio: Any) -> tuple[Any, Any]:
    """Return (I2, I3) of a body or of an array of bodies, or (1.0, I) for numbers I = I3/I2, (33), without rounding.

    Each is a float or an array, or a `Given` where no double holds the number. A body is never rounded to its quotient.
    Domain: 0 < I3 <= 2 I2. Raises DomainError outside the domain, and for a thin rod (I3 = 0), whose turn about its own
    axis has no inertia; AtlasError for an input that is no number.
    """
    if isinstance(ratio, SymmetricBody):
        if not np.all(ratio.I3):
            raise DomainError(ROD)
        return ratio.exact
    I = as_given(numbers(ratio, "The ratio I = I3/I2"))
    check_ratio(plain(I) if np.ndim(I) else float(I))
    return 1.0, I


def moments(ratio: Any) -> tuple[Any, Any]:
    """Return (I2, I3) of `exact_moments` with each moment rounded once: floats or arrays.

    Raises as that function does.
    """
    I2, I3 = (float(x) if not np.ndim(x) else plain(x) for x in exact_moments(ratio))
    return I2, I3


def excess(I2: Any, I3: Any) -> Any:
    """Return I3 - I2 of floats, arrays or `Given`, rounded once, a float or an array: zero only for equal moments."""
    return over(lambda I2, I3: I3 - I2, I2, I3)


def shape_name(ratio: Any) -> str:
    """Return the name in `SHAPES` of the shape by which a body was given; "" for a number and for given moments."""
    shape = getattr(ratio, "_shape", None) if isinstance(ratio, SymmetricBody) else None
    return shape[0] if shape else ""


def kept_ratio(ratio: Any, I3: Any) -> Any:
    """Return the ratio that an object stores: the `SymmetricBody` itself, or for a number I3/I2 its copy ``I3``."""
    return ratio if isinstance(ratio, SymmetricBody) else I3


@dataclass(frozen=True)
class SymmetricBody(CarriesUncertainty):
    """Symmetric body with I1 = I2, eq. (33), or an array of such bodies.

    Parameters
    ----------
    I2 : float or array_like
        Moment of inertia across the symmetry axis, about the centre of mass; positive.
    I3 : float or array_like
        Moment along the symmetry axis, 0 <= I3 <= 2 I2, in the unit of `I2`.
    axes : ndarray, shape (3, 3)
        Principal axes as rows, the symmetry axis last, in the frame of the mass matrix; by default the unit matrix.
        It is not checked that the rows are orthonormal.

    Attributes
    ----------
    exact : tuple
        Moments (I2, I3) without rounding, as motions take them: the doubles given, or exact numbers of a Fraction or
        of a shape by its dimensions.

    Raises
    ------
    DomainError
        For moments that no body has.
    AtlasError
        For an input that is no number.

    Notes
    -----
    Moments broadcast, and so do masses and dimensions in `sphere` and the other shapes. Inputs with standard deviations
    give an `UncertainObject`. Functions that take a body take an array of bodies too.

    Examples
    --------
    >>> atlas.SymmetricBody(2.0, 3.0).ratio
    1.5
    """

    I2: FloatOrArray
    I3: FloatOrArray
    axes: FloatArray
    _exact: ClassVar[tuple[Any, ...]] = ()
    _shape: ClassVar[tuple[str, dict[str, Any]] | None] = None

    def __init__(self, I2: RealArrayLike, I3: RealArrayLike, axes: RealArrayLike | None = None) -> None:
        exact = numbers(I2, "I2", INERTIA), numbers(I3, "I3", INERTIA)
        common_shape(*(x.shape for x in exact))
        I2, I3 = np.broadcast_arrays(*map(np.asarray, exact))
        for moment2, moment3 in np.stack([I2, I3], -1).reshape(-1, 2)[((I2 <= 0) | (I3 < 0) | (I3 > 2 * I2)).ravel()][
            :1
        ]:
            if moment2 <= 0:
                says = "about an axis across it, every body has some inertia"
                raise DomainError(f"I2 must be positive, not {moment2}: {says}.")
            if moment3 < 0:
                raise DomainError(f"I3 must not be negative, but is {moment3}.")
            raise DomainError(
                f"No body has I2 = {moment2}, I3 = {moment3}: I3 is at most 2 I2 = {2 * moment2}, {NO_SUCH_BODY}."
            )
        object.__setattr__(self, "_exact", tuple(map(as_given, exact)))
        object.__setattr__(self, "I2", plain(I2))
        object.__setattr__(self, "I3", plain(I3))
        object.__setattr__(self, "axes", matrix(np.eye(3) if axes is None else axes, "The axes"))

    def __eq__(self, other: object) -> bool:
        """Whether all moments, each rounded once, are the same; the axes may differ."""
        if not isinstance(other, SymmetricBody):
            return NotImplemented
        return np.array_equal(self.I2, other.I2) and np.array_equal(self.I3, other.I3)

    def __repr__(self) -> str:
        """Return the call that makes the body, with its axes where these are not the unit vectors."""
        if self._shape:
            name, sizes = self._shape
            return f"{type(self).__name__}.{name}({', '.join(f'{key}={value!r}' for key, value in sizes.items())})"
        axes_text = f", axes={self.axes.tolist()}" * bool((self.axes != np.eye(3)).any())
        I2, I3 = self.exact
        return f"{type(self).__name__}(I2={I2!r}, I3={I3!r}{axes_text})"

    def __reduce__(self) -> tuple[Any, ...]:
        """Return the call that makes the body again, for copy and pickle."""
        return (_shaped, (type(self), *self._shape)) if self._shape else (type(self), (*self.exact, self.axes))

    def _repr_html_(self) -> str:
        """Return the moments of the body and a small picture as HTML, for a notebook."""
        html: str = notebook("show").body(self)
        return html

    @property
    def ratio(self) -> FloatOrArray:
        """Ratio I = I3/I2, (33), rounded to a float; kernels use the exact I2 and I3."""
        return self.I3 / self.I2

    @property
    def exact(self) -> tuple[Any, Any]:
        """Moments (I2, I3) without rounding: floats, arrays or exact numbers."""
        I2, I3 = self._exact
        return I2, I3

    @property
    def inertia(self) -> tuple[FloatOrArray, FloatOrArray, FloatOrArray]:
        """Diagonal (I2, I2, I3) of the inertia tensor, (33), in the unit of `I2`."""
        return self.I2, self.I2, self.I3

    @property
    def mass_matrix(self) -> tuple[FloatOrArray, FloatOrArray, FloatOrArray]:
        """Diagonal 1/2 (I3, I3, 2 I2 - I3) of the mass matrix (8)."""
        return self.I3 / 2, self.I3 / 2, self.I2 - self.I3 / 2

    @classmethod
    def ring(cls, mass: RealArrayLike, radius: RealArrayLike) -> Self:
        """Thin ring (a loop): I3 = m R^2 = 2 I2.

        Parameters
        ----------
        mass : float or array_like
            Mass m > 0.
        radius : float or array_like
            Radius R > 0.

        Returns
        -------
        SymmetricBody
            Body with moments in mass times length^2.

        Raises
        ------
        DomainError
            For a mass or dimension out of its domain.
        AtlasError
            For an input that is no number.
        """
        return _shaped(cls, "ring", {"mass": mass, "radius": radius})

    @classmethod
    def disk(cls, mass: RealArrayLike, radius: RealArrayLike) -> Self:
        """Thin disk: I3 = m R^2/2 = 2 I2.

        Parameters
        ----------
        mass : float or array_like
            Mass m > 0.
        radius : float or array_like
            Radius R > 0.

        Returns
        -------
        SymmetricBody
            Body with moments in mass times length^2.

        Raises
        ------
        DomainError
            For a mass or dimension out of its domain.
        AtlasError
            For an input that is no number.
        """
        return _shaped(cls, "disk", {"mass": mass, "radius": radius})

    @classmethod
    def cylindrical_shell(cls, mass: RealArrayLike, radius: RealArrayLike, height: RealArrayLike) -> Self:
        """Open cylindrical surface (a solenoid): I3 = m R^2, I2 = m (6 R^2 + h^2)/12; I = 1 at h = R sqrt(6).

        Parameters
        ----------
        mass : float or array_like
            Mass m > 0.
        radius : float or array_like
            Radius R > 0.
        height : float or array_like
            Height h >= 0.

        Returns
        -------
        SymmetricBody
            Body with moments in mass times length^2.

        Raises
        ------
        DomainError
            For a mass or dimension out of its domain.
        AtlasError
            For an input that is no number.
        """
        return _shaped(cls, "cylindrical_shell", {"mass": mass, "radius": radius, "height": height})

    @classmethod
    def solid_cylinder(
        cls,
        mass: RealArrayLike | None = None,
        radius: RealArrayLike | None = None,
        height: RealArrayLike | None = None,
        *,
        density: RealArrayLike | None = None,
    ) -> Self:
        """Solid cylinder: I3 = m R^2/2, I2 = m (3 R^2 + h^2)/12; I = 1 at h = R sqrt(3).

        Parameters
        ----------
        mass : float or array_like, optional
            Mass m > 0; in its place the density may be given.
        radius : float or array_like
            Radius R > 0.
        height : float or array_like
            Height h >= 0.
        density : float or array_like, optional
            Density > 0, mass over length^3, in the place of the mass.

        Returns
        -------
        SymmetricBody
            Body with moments in mass times length^2.

        Raises
        ------
        DomainError
            For a mass or dimension out of its domain.
        AtlasError
            For an input that is no number or missing, and for a mass beside a density.
        """
        return _shaped(cls, "solid_cylinder", {"mass": mass, "radius": radius, "height": height}, density)

    @classmethod
    def thin_rod(cls, mass: RealArrayLike, length: RealArrayLike) -> Self:
        """Rod without thickness: I2 = m l^2/12, I3 = 0; motions refuse the rod.

        Parameters
        ----------
        mass : float or array_like
            Mass m > 0.
        length : float or array_like
            Length l > 0.

        Returns
        -------
        SymmetricBody
            Body with moments in mass times length^2.

        Raises
        ------
        DomainError
            For a mass or dimension out of its domain.
        AtlasError
            For an input that is no number.
        """
        return _shaped(cls, "thin_rod", {"mass": mass, "length": length})

    @classmethod
    def sphere(
        cls,
        mass: RealArrayLike | None = None,
        radius: RealArrayLike | None = None,
        *,
        density: RealArrayLike | None = None,
    ) -> Self:
        """Solid ball: I2 = I3 = 2 m R^2/5.

        Parameters
        ----------
        mass : float or array_like, optional
            Mass m > 0; in its place the density may be given.
        radius : float or array_like
            Radius R > 0.
        density : float or array_like, optional
            Density > 0, mass over length^3, in the place of the mass.

        Returns
        -------
        SymmetricBody
            Body with moments in mass times length^2.

        Raises
        ------
        DomainError
            For a mass or dimension out of its domain.
        AtlasError
            For an input that is no number or missing, and for a mass beside a density.
        """
        return _shaped(cls, "sphere", {"mass": mass, "radius": radius}, density)

    @classmethod
    def spherical_shell(cls, mass: RealArrayLike, radius: RealArrayLike) -> Self:
        """Hollow sphere: I2 = I3 = 2 m R^2/3.

        Parameters
        ----------
        mass : float or array_like
            Mass m > 0.
        radius : float or array_like
            Radius R > 0.

        Returns
        -------
        SymmetricBody
            Body with moments in mass times length^2.

        Raises
        ------
        DomainError
            For a mass or dimension out of its domain.
        AtlasError
            For an input that is no number.
        """
        return _shaped(cls, "spherical_shell", {"mass": mass, "radius": radius})

    @classmethod
    def spheroid(
        cls,
        mass: RealArrayLike | None = None,
        equatorial: RealArrayLike | None = None,
        polar: RealArrayLike | None = None,
        *,
        density: RealArrayLike | None = None,
    ) -> Self:
        """Solid ellipsoid of revolution: I3 = 2 m a^2/5, I2 = m (a^2 + c^2)/5.

        Parameters
        ----------
        mass : float or array_like, optional
            Mass m > 0; in its place the density may be given.
        equatorial : float or array_like
            Equatorial radius a > 0.
        polar : float or array_like
            Polar radius c >= 0.
        density : float or array_like, optional
            Density > 0, mass over length^3, in the place of the mass.

        Returns
        -------
        SymmetricBody
            Body with moments in mass times length^2.

        Raises
        ------
        DomainError
            For a mass or dimension out of its domain.
        AtlasError
            For an input that is no number or missing, and for a mass beside a density.
        """
        return _shaped(cls, "spheroid", {"mass": mass, "equatorial": equatorial, "polar": polar}, density)

    @classmethod
    def from_point_masses(cls, masses: RealArrayLike, positions: RealArrayLike, *, tolerance: float = 0.0) -> Self:
        """Body of point masses with the mass matrix (8), by `from_mass_matrix`.

        Parameters
        ----------
        masses : array_like, shape (N,)
            Masses, positive.
        positions : array_like, shape (N, 3)
            Positions from any origin.
        tolerance : float
            Relative difference up to which two principal values count as equal, as for `from_mass_matrix`.

        Returns
        -------
        SymmetricBody
            Body about its centre of mass; of up to 4096 points the moments are exact.

        Raises
        ------
        DomainError
            If the body is not symmetric.
        AtlasError
            For arrays of other shapes, and for an entry that is no number.

        Warns
        -----
        NearlySymmetricWarning
            If the body is symmetric up to 1e-9 only.
        """
        return cls._of_masses(exact_mass_matrix(masses, positions), tolerance)

    @classmethod
    def from_mass_matrix(cls, mass_matrix: RealArrayLike, *, tolerance: float = 0.0) -> Self:
        """Body of a mass matrix (8): I2 = g1 + g3 and I3 = 2 g1, with principal values g1 = g2 and g3.

        Parameters
        ----------
        mass_matrix : array_like, shape (3, 3) or (3,)
            Mass matrix, or its diagonal.
        tolerance : float
            Difference, relative to the larger, up to which two principal values count as equal.

        Returns
        -------
        SymmetricBody
            Body with `axes`: the symmetry axis last, its largest component positive.

        Raises
        ------
        DomainError
            If the closest two principal values differ by more than the tolerance and 1e-9, or one is negative beyond
            rounding.
        AtlasError
            For an input that is no such matrix.

        Warns
        -----
        NearlySymmetricWarning
            If two principal values are joined that differ by more than the tolerance, but not by more than 1e-9.

        Notes
        -----
        Principal values that are joined are replaced by their mean; equal ones stay exact. A totally symmetric body
        keeps the axes of the matrix.
        """
        matrix, _ = diagonal_or_matrices(mass_matrix, "The mass matrix")
        if matrix.ndim > 2:
            raise AtlasError(f"A body has one mass matrix (3, 3) or diagonal (3,), not the shape {matrix.shape}.")
        return cls._of_masses(rational_matrix(np.diag(matrix) if matrix.ndim == 1 else matrix), tolerance)

    @classmethod
    def _of_masses(cls, mass_matrix: list[list[fmpq]], tolerance: float) -> Self:
        """Return the body of a mass matrix of rational numbers, three rows, see `from_mass_matrix`."""
        values, exact_axes = principal_values(mass_matrix)
        order = sorted(range(3), key=values.__getitem__)
        axes, exact = rounded([exact_axes[i] for i in order]), [max(values[i], fmpq(0)) for i in order]
        g, largest = np.array([nearest(values[i]) for i in order]), exact[2]
        if not any(map(any, mass_matrix)):
            raise DomainError("The mass matrix is zero: all of the body is in one point, and has no rotation.")
        if g[0] < -ROUNDING * abs(g[2]):
            raise DomainError(
                f"A mass matrix is a sum of m x x^T and so not negative, but its principal values are {g}."
            )
        tolerance = number(tolerance, "The tolerance")
        if nearest((exact[2] - exact[0]) / largest) <= tolerance:
            moment = given_number(2 * sum(exact, fmpq(0)) / 3)
            return cls(moment, moment)
        single = 0 if exact[2] - exact[1] < exact[1] - exact[0] else 2
        lower, upper = (exact[1], exact[2]) if single == 0 else (exact[0], exact[1])
        gap = nearest((upper - lower) / upper) if upper != 0 else 0.0
        difference = f"of its principal mass moments {g} the closest two differ by {gap:.3g} of the larger"
        if gap > max(tolerance, NEARLY_EQUAL):
            limit = max(tolerance, NEARLY_EQUAL)
            raise DomainError(f"The body is not symmetric: {difference}, more than the tolerance {limit:g}.")
        if gap > tolerance:
            warnings.warn(
                f"The body is nearly symmetric: {difference}, and are joined; say tolerance={NEARLY_EQUAL:g} if they "
                "are meant to be equal, else give the inertia tensor to atlas.motion.",
                NearlySymmetricWarning,
                stacklevel=3,
            )
        mean = (lower + upper) / 2
        return cls(given_number(mean + exact[single]), given_number(2 * mean), _frame(axes[single]))


SHAPES: Mapping[str, tuple[Callable[..., SymmetricBody], tuple[str, ...]]] = {
    name: (getattr(SymmetricBody, name), names) for name, (names, _) in formulas.SHAPES.items()
}
"""Shapes by name: the constructor and the names of its dimensions."""


def from_shape(name: str, **dimensions: Any) -> SymmetricBody:
    """Return the `SymmetricBody` of `SHAPES[name]` with these dimensions by name.

    Of a solid shape ``density`` may replace ``mass``. Raises AtlasError for an unknown shape or other dimensions,
    DomainError for one that is not positive.
    """
    heavy = "density" if name in formulas.VOLUMES and "density" in dimensions else "mass"
    formulas.check_shape(name, ["mass" if key == heavy else key for key in dimensions])
    return SHAPES[name][0](**dimensions)


WORDS = {"equatorial": "equatorial radius", "polar": "polar radius"}
"""Dimensions whose names are other words."""


def _shaped(kind: type[Made], name: str, given_sizes: Mapping[str, Any], density: Any = None) -> Made:
    """Return the body of class ``kind`` of a shape from its sizes by name, numbers or arrays, or its density.

    The density stands in the place of the mass. The moments are exact; with a density they have 256 binary digits,
    since the volume has the factor pi.

    Raises DomainError for a size that is not positive (negative, for one in FLAT), AtlasError for a mass or size that
    is missing and for a mass beside a density.
    """
    names, formula = formulas.SHAPES[name]
    named = {key: f"The {WORDS.get(key, key)}" for key in names}
    absent = [key for key in names if given_sizes[key] is None and not (key == "mass" and density is not None)]
    if absent or (density is not None and given_sizes["mass"] is not None):
        needs = f"needs {' and '.join(absent)}" if absent else "takes a mass or a density, not both"
        raise AtlasError(f"SymmetricBody.{name} {needs}.")
    sizes = {
        key: numbers(x, named[key], MASS if key == "mass" else LENGTH)
        for key, x in given_sizes.items()
        if x is not None
    }
    if density is not None:
        sizes = {"density": numbers(density, "The density", DENSITY)} | sizes
    for key, value in sizes.items():
        array = np.asarray(value)
        for impossible in array[(array < 0) if key in formulas.FLAT else (array <= 0)].flat[:1]:
            raise DomainError(f"{named.get(key, 'The density')} must be positive, not {impossible}.")
    common_shape(*(np.shape(value) for value in sizes.values()))
    order = ("density" if key == "mass" and density is not None else key for key in names)

    def exact(mass_or_density: Any, *lengths: Any) -> tuple[Any, Any]:
        mass = mass_or_density if density is None else mass_or_density * formulas.VOLUMES[name](*lengths)
        return formula(mass, *(x * x for x in lengths))

    I2, I3 = exact_results(exact, *(sizes[key] for key in order), unit=slice(1), count=2)
    body = kind(I2, I3)
    object.__setattr__(body, "_shape", (name, {key: as_given(value) for key, value in sizes.items()}))
    return body


def _frame(axis: FloatArray) -> FloatArray:
    """Return the right-handed frame (3, 3) with the rows e1, e2, e3, and e3 the unit vector `axis` (3,) or -axis.

    The largest component of e3 is positive.
    """
    e3 = axis * np.sign(axis[np.argmax(np.abs(axis))])
    e1 = np.eye(3)[np.argmin(np.abs(e3))]
    e1 = e1 - (e1 @ e3) * e3
    e1 /= np.linalg.norm(e1)
    return np.array([e1, np.cross(e3, e1), e3])
