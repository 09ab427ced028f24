"""Symmetric bodies: the moments of inertia I1 = I2 and I3, and the mass matrix (8) behind them."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Self

import numpy as np

from atlas.arithmetic.annotations import FloatOrArray, RealArrayLike
from atlas.arithmetic.dimensions import INERTIA, LENGTH, MASS
from atlas.arithmetic.inputs import FloatArray, common_shape, matrix, plain, real
from atlas.bodies import formula_shapes as formulas
from atlas.bodies.formula_domain import NO_SUCH_BODY, ROD, check_ratio
from atlas.bodies.inertia import (
    ROUNDING,
    diagonal_or_matrices,
    inertia_from_mass_matrix,
    mass_matrix_from_inertia,
    mass_matrix_of_points,
    principal,
)
from atlas.errors import AtlasError, DomainError
from atlas.viewers import notebook

__all__ = ["SHAPES", "SymmetricBody", "from_shape", "inertia_from_mass_matrix", "mass_matrix_from_inertia", "moments"]


def moments(ratio: Any) -> tuple[Any, Any]:
    """Return (I2, I3) of a body or of an array of bodies, or (1.0, I) for numbers I = I3/I2, (33).

    The inputs stay exact: a body is never rounded to its quotient. Domain: 0 < I3 <= 2 I2.
    Raises DomainError outside it, and for a thin rod (I3 = 0), whose turn about its own axis has no inertia.
    """
    if isinstance(ratio, SymmetricBody):
        if not np.all(ratio.I3):
            raise DomainError(ROD)
        return ratio.I2, ratio.I3
    I = plain(real(ratio, "The ratio I = I3/I2"))
    check_ratio(I)
    return 1.0, I


def kept_ratio(ratio: Any, I3: Any) -> Any:
    """Return the ratio for storage: the body, or the I3 of `moments`, never an array of the user's."""
    return ratio if isinstance(ratio, SymmetricBody) else I3


@dataclass(frozen=True)
class SymmetricBody:
    """Symmetric body with I1 = I2, eq. (33), or an array of such bodies.

    Parameters
    ----------
    I2 : float or array_like
        Moment of inertia across the symmetry axis, about the centre of mass; positive.
    I3 : float or array_like
        Moment along the symmetry axis, 0 <= I3 <= 2 I2, in the unit of `I2`.
    axes : ndarray, shape (3, 3)
        Principal axes as rows, the symmetry axis last, in the frame of the mass matrix; by default the unit matrix.

    Raises
    ------
    DomainError
        For moments that no body has.
    AtlasError
        For an input that is no number.

    Notes
    -----
    Moments, masses and dimensions broadcast. Functions that take a body take an array of bodies too.

    Examples
    --------
    >>> atlas.SymmetricBody(2.0, 3.0).ratio
    1.5
    """

    I2: FloatOrArray
    I3: FloatOrArray
    axes: FloatArray

    def __init__(self, I2: RealArrayLike, I3: RealArrayLike, axes: RealArrayLike | None = None) -> None:
        I2, I3 = real(I2, "I2", INERTIA), real(I3, "I3", INERTIA)
        common_shape(I2.shape, I3.shape)
        I2, I3 = np.broadcast_arrays(I2, I3)
        for across, along in np.stack([I2, I3], -1).reshape(-1, 2)[((I2 <= 0) | (I3 < 0) | (I3 > 2 * I2)).ravel()][:1]:
            if across <= 0:
                says = "about an axis across it, every body has some inertia"
                raise DomainError(f"I2 must be positive, not {across}: {says}.")
            if along < 0:
                raise DomainError(f"I3 must not be negative, but is {along}.")
            raise DomainError(
                f"No body has I2 = {across}, I3 = {along}: I3 is at most 2 I2 = {2 * across}, {NO_SUCH_BODY}."
            )
        object.__setattr__(self, "I2", plain(I2))
        object.__setattr__(self, "I3", plain(I3))
        object.__setattr__(self, "axes", matrix(np.eye(3) if axes is None else axes, "The axes"))

    def __eq__(self, other: object) -> bool:
        """Whether all moments are the same."""
        if not isinstance(other, SymmetricBody):
            return NotImplemented
        return np.array_equal(self.I2, other.I2) and np.array_equal(self.I3, other.I3)

    def __repr__(self) -> str:
        """Return the call that makes it; its axes, where they are not those of the frame."""
        turned = f", axes={self.axes.tolist()}" * bool((self.axes != np.eye(3)).any())
        return f"{type(self).__name__}(I2={self.I2!r}, I3={self.I3!r}{turned})"

    def _repr_html_(self) -> str:
        """Return the moments of the body and a small picture, for a notebook."""
        html: str = notebook("show").body(self)
        return html

    @property
    def ratio(self) -> FloatOrArray:
        """Ratio I = I3/I2, (33), rounded to a float; kernels use the exact I2 and I3."""
        return self.I3 / self.I2

    @property
    def inertia(self) -> tuple[FloatOrArray, FloatOrArray, FloatOrArray]:
        """Diagonal (I2, I2, I3) of the inertia tensor, (33)."""
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
        return cls(*_of_shape("ring", mass, radius))

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
        return cls(*_of_shape("disk", mass, radius))

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
            Height h.

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
        return cls(*_of_shape("cylindrical_shell", mass, radius, height))

    @classmethod
    def solid_cylinder(cls, mass: RealArrayLike, radius: RealArrayLike, height: RealArrayLike) -> Self:
        """Solid cylinder: I3 = m R^2/2, I2 = m (3 R^2 + h^2)/12; I = 1 at h = R sqrt(3).

        Parameters
        ----------
        mass : float or array_like
            Mass m > 0.
        radius : float or array_like
            Radius R > 0.
        height : float or array_like
            Height h.

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
        return cls(*_of_shape("solid_cylinder", mass, radius, height))

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
        return cls(*_of_shape("thin_rod", mass, length))

    @classmethod
    def sphere(cls, mass: RealArrayLike, radius: RealArrayLike) -> Self:
        """Solid ball: I2 = I3 = 2 m R^2/5.

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
        return cls(*_of_shape("sphere", mass, radius))

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
        return cls(*_of_shape("spherical_shell", mass, radius))

    @classmethod
    def spheroid(cls, mass: RealArrayLike, equatorial: RealArrayLike, polar: RealArrayLike) -> Self:
        """Solid ellipsoid of revolution: I3 = 2 m a^2/5, I2 = m (a^2 + c^2)/5.

        Parameters
        ----------
        mass : float or array_like
            Mass m > 0.
        equatorial : float or array_like
            Equatorial radius a > 0.
        polar : float or array_like
            Polar radius c.

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
        return cls(*_of_shape("spheroid", mass, equatorial, polar))

    @classmethod
    def from_point_masses(cls, masses: RealArrayLike, positions: RealArrayLike, *, tolerance: float = 1e-9) -> Self:
        """Body of point masses with the mass matrix (8), by `from_mass_matrix`.

        Parameters
        ----------
        masses : array_like, shape (N,)
            Masses, positive.
        positions : array_like, shape (N, 3)
            Positions from any origin.
        tolerance : float
            Relative difference up to which principal values count as equal.

        Returns
        -------
        SymmetricBody
            Body about its centre of mass.

        Raises
        ------
        DomainError
            If the body is not symmetric.
        AtlasError
            For arrays of other shapes, and for an entry that is no number.
        """
        return cls.from_mass_matrix(mass_matrix_of_points(masses, positions), tolerance=tolerance)

    @classmethod
    def from_mass_matrix(cls, mass_matrix: RealArrayLike, *, tolerance: float = 1e-9) -> Self:
        """Body of a mass matrix (8): I2 = g1 + g3 and I3 = 2 g1, with principal values g1 = g2 and g3.

        Parameters
        ----------
        mass_matrix : array_like, shape (3, 3) or (3,)
            Mass matrix, or its diagonal.
        tolerance : float
            Difference, relative to the largest principal value, up to which two of them count as equal.

        Returns
        -------
        SymmetricBody
            Body with `axes`: the symmetry axis last, its largest component positive.

        Raises
        ------
        DomainError
            If no two principal values are equal, or one is negative beyond rounding.
        AtlasError
            For an input that is no such matrix.

        Notes
        -----
        Equal principal values are replaced by their mean. A totally symmetric body keeps the axes of the matrix.
        """
        matrix, _ = diagonal_or_matrices(mass_matrix, "The mass matrix")
        if matrix.ndim > 2:
            raise AtlasError(f"A body has one mass matrix (3, 3) or diagonal (3,), not the shape {matrix.shape}.")
        g, axes = principal(np.diag(matrix) if matrix.ndim == 1 else matrix)
        order = np.argsort(g, kind="stable")
        g, axes = g[order], axes[order]
        largest = g[2]
        if not matrix.any():
            raise DomainError("The mass matrix is zero: all of the body is in one point, and has no rotation.")
        if g[0] < -ROUNDING * abs(largest):
            raise DomainError(
                f"A mass matrix is a sum of m x x^T and so not negative, but its principal values are {g}."
            )
        g = np.where(g < ROUNDING * largest, 0.0, g)
        if g[2] - g[0] <= tolerance * largest:
            moment = float(2 * g.mean())
            return cls(moment, moment)
        third = 0 if g[2] - g[1] < g[1] - g[0] else 2
        first, second = (g[1], g[2]) if third == 0 else (g[0], g[1])
        if second - first > tolerance * largest:
            raise DomainError(
                f"The body is not symmetric: of its principal mass moments {g} the closest two differ by "
                f"{(second - first) / largest:.3g} of the largest, more than the tolerance {tolerance:g}."
            )
        across = float((first + second) / 2)
        return cls(across + float(g[third]), 2 * across, _frame(axes[third]))


SHAPES: Mapping[str, tuple[Callable[..., SymmetricBody], tuple[str, ...]]] = {
    name: (getattr(SymmetricBody, name), names) for name, (names, _) in formulas.SHAPES.items()
}
"""Shapes by name: the constructor and the names of its dimensions."""


def from_shape(name: str, **dimensions: Any) -> SymmetricBody:
    """Make the body `SHAPES[name]` from its dimensions, all of them and no others."""
    formulas.check_shape(name, dimensions)
    return SHAPES[name][0](**dimensions)


WORDS = {"equatorial": "equatorial radius", "polar": "polar radius"}
"""Dimensions whose names are other words."""


def _of_shape(name: str, *given: Any) -> Any:
    """Return I2 and I3 of a shape of these sizes, numbers or arrays. Raises AtlasError unless they are positive."""
    names, formula = formulas.SHAPES[name]
    named = {key: f"The {WORDS.get(key, key)}" for key in names}
    sizes = [real(x, named[key], MASS if key == "mass" else LENGTH) for key, x in zip(names, given, strict=True)]
    for key, value in zip(names, sizes, strict=True):
        for impossible in value[(value < 0) if key in formulas.FLAT else (value <= 0)].flat[:1]:
            raise DomainError(f"{named[key]} must be positive, not {impossible}.")
    common_shape(*(value.shape for value in sizes))
    m, *lengths = map(plain, sizes)
    with np.errstate(over="ignore"):  # what is too large is refused as a moment
        return formula(m, *(x * x for x in lengths))


def _frame(axis: FloatArray) -> FloatArray:
    """Complete the symmetry axis to a right-handed frame whose rows are e1, e2, e3 = axis."""
    e3 = axis * np.sign(axis[np.argmax(np.abs(axis))])
    e1 = np.eye(3)[np.argmin(np.abs(e3))]
    e1 = e1 - (e1 @ e3) * e3
    e1 /= np.linalg.norm(e1)
    return np.array([e1, np.cross(e3, e1), e3])
