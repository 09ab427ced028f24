"""Constant fields as the user has them, and the laboratory frame of figure Lssc, in which the paper works."""

from dataclasses import dataclass
from dataclasses import field as attribute
from fractions import Fraction
from typing import Any, ClassVar, Self

import numpy as np

from atlas.arithmetic.annotations import RealArrayLike
from atlas.arithmetic.dimensions import NO_FIELDS, RATE, SI_FIELDS
from atlas.arithmetic.given import as_float_or_fraction
from atlas.arithmetic.inputs import FloatArray, finite, frozen, number, positive, real, vector, vectors
from atlas.arithmetic.numbers import cross, dot, nearest, root, unit, workprec
from atlas.arithmetic.uncertainty import CarriesUncertainty
from atlas.arithmetic.words import exact
from atlas.bodies import units as unit_systems
from atlas.bodies.display import call_text
from atlas.bodies.speeds import check_drift
from atlas.errors import AtlasError, DomainError


class Prime(np.ndarray[Any, np.dtype[np.float64]]):
    """The vector B' of a `Field`, an array (3,), in 1/time.

    Raises DomainError for the slice of B2 and B3, [1:], where B1 is not zero.
    """

    def __getitem__(self, key: Any) -> Any:
        if isinstance(key, slice) and self.shape == (3,) and key.indices(3) == (1, 3, 1) and self[0] != 0:
            raise DomainError(
                f"B1 = {float(self[0])} of this field is not zero, so that B2 and B3 are not all of it: take "
                "field.frame(axis).field, for a body whose axis points along `axis`."
            )
        return super().__getitem__(key)


@dataclass(frozen=True, eq=False)
class Field(CarriesUncertainty):
    """Constant fields B and E that act on matter of charge-to-mass ratio mu, eqs. (32), (89).

    Parameters
    ----------
    B, E : array_like, shape (3,)
        Magnetic and electric field, in any frame of the user.
    mu : float
        Charge-to-mass ratio, of either sign or 0.
    c : float
        Positive: 1 in SI, the speed of light in Gaussian units; see `atlas.bodies.units`.

    Attributes
    ----------
    prime : ndarray, shape (3,)
        B' = mu B/(2c), in 1/time; opposite to B for mu < 0.
    exact : tuple
        Components of B' without rounding, as floats or fractions.

    Raises
    ------
    AtlasError
        For an input that is not finite, and for c that is not positive.

    Examples
    --------
    >>> atlas.Field((0.0, 1.0, 2.0), mu=2.0).pair
    (1.0, 2.0)
    """

    B: FloatArray
    E: FloatArray
    mu: float
    c: float
    prime: FloatArray = attribute(init=False)
    """B' = mu B/(2c), (32), shape (3,), in 1/time: for mu < 0 opposite to B. Its part [1:] is refused for B1 != 0."""
    _ratio: ClassVar[float | Fraction] = 1.0
    exact: tuple[float | Fraction, ...] = attribute(init=False)
    """The components of B' without rounding, as motions take them: floats, or fractions where they are no floats."""

    def __init__(
        self, B: RealArrayLike, E: RealArrayLike = (0.0, 0.0, 0.0), mu: RealArrayLike = 1.0, c: RealArrayLike = 1.0
    ) -> None:
        object.__setattr__(self, "c", positive(c, "c"))
        unit = SI_FIELDS if self.c == 1 else NO_FIELDS
        object.__setattr__(self, "B", vector(B, "B", unit["B"]))
        object.__setattr__(self, "E", vector(E, "E", unit["E"]))
        object.__setattr__(self, "mu", number(mu, "mu", unit["mu"]))
        object.__setattr__(self, "_ratio", mu if isinstance(mu, Fraction) else self.mu)
        prime = unit_systems.prime(self._ratio, self.B, self.c)
        object.__setattr__(self, "exact", tuple(as_float_or_fraction(x) for x in prime))
        object.__setattr__(self, "prime", frozen(np.array([float(x) for x in self.exact]).view(Prime)))

    def __eq__(self, other: object) -> bool:
        """Whether both have the same B, E, mu and c, so that `eval(repr(field)) == field`."""
        return self._key() == other._key() if isinstance(other, Field) else NotImplemented

    def __hash__(self) -> int:
        """Return a hash of B, E, mu and c."""
        return hash(self._key())

    def _key(self) -> tuple[Any, ...]:
        return (*self.B.tolist(), *self.E.tolist(), self._ratio, self.c)

    def __repr__(self) -> str:
        text = call_text("Field", {"B": self.B, "E": self.E, "mu": self._ratio, "c": self.c})
        return f"{text}  # B' = {self.prime.tolist()}"

    @classmethod
    def si(
        cls,
        B: RealArrayLike,
        E: RealArrayLike = (0.0, 0.0, 0.0),
        *,
        mu: float | None = None,
        charge: float | None = None,
        mass: float | None = None,
    ) -> Self:
        """Fields in SI: B in T, E in V/m, mu in C/kg; B' of (32) in rad/s.

        Parameters
        ----------
        B, E : array_like, shape (3,)
            Magnetic field in T and electric field in V/m.
        mu : float, optional
            Charge-to-mass ratio in C/kg.
        charge, mass : float, optional
            Charge in C and mass in kg, in the place of `mu`; their quotient is not rounded.

        Returns
        -------
        Field
            Fields with c = 1.

        Raises
        ------
        DomainError
            If |E| across B is c |B| or more.
        AtlasError
            For an input that is not finite, and unless mu, or charge and mass, are given.

        Warns
        -----
        RelativisticWarning
            If the drift exceeds a tenth of the speed of light.
        """
        field = cls(B, E, unit_systems.ratio_of(mu, charge, mass), unit_systems.SI.c)
        check_drift(field.E, field.B, unit_systems.SI)
        return field

    @classmethod
    def gaussian(
        cls,
        B: RealArrayLike,
        E: RealArrayLike = (0.0, 0.0, 0.0),
        *,
        mu: float | None = None,
        charge: float | None = None,
        mass: float | None = None,
    ) -> Self:
        """Fields in Gaussian units: B in G, E in statV/cm, mu in statC/g; B' of (32) in rad/s.

        Parameters
        ----------
        B, E : array_like, shape (3,)
            Magnetic field in G and electric field in statV/cm.
        mu : float, optional
            Charge-to-mass ratio in statC/g.
        charge, mass : float, optional
            Charge in statC and mass in g, in the place of `mu`; their quotient is not rounded.

        Returns
        -------
        Field
            Fields with c in cm/s.

        Raises
        ------
        DomainError
            If |E| across B is |B| or more.
        AtlasError
            For an input that is not finite, and unless mu, or charge and mass, are given.

        Warns
        -----
        RelativisticWarning
            If the drift exceeds a tenth of the speed of light.
        """
        field = cls(B, E, unit_systems.ratio_of(mu, charge, mass), unit_systems.GAUSSIAN.c)
        check_drift(field.E, field.B, unit_systems.GAUSSIAN)
        return field

    @property
    def pair(self) -> tuple[float, float]:
        """Components (B2, B3) of B', (32), for a body whose axis points along e3, in 1/time.

        Raises
        ------
        DomainError
            For B1 != 0.
        """
        B2, B3 = self.prime[1:].tolist()
        return B2, B3

    @property
    def exact_pair(self) -> tuple[float | Fraction, ...]:
        """Components (B2, B3) of B', (32), without rounding: floats or fractions, in 1/time.

        Raises
        ------
        DomainError
            For B1 != 0.
        """
        _ = self.pair
        return self.exact[1:]

    def frame(self, axis: RealArrayLike) -> "LaboratoryFrame":
        """Laboratory frame of figure Lssc for a body whose symmetry axis points along `axis` at t = 0.

        Parameters
        ----------
        axis : array_like, shape (3,)
            Direction of the symmetry axis, of any length but zero.

        Returns
        -------
        LaboratoryFrame
            Frame with e3 along the axis.

        Raises
        ------
        AtlasError
            For an axis without a direction.
        """
        return LaboratoryFrame(axis, self.prime)


@dataclass(frozen=True, eq=False)
class LaboratoryFrame(CarriesUncertainty):
    """Laboratory frame of figure Lssc: e3 along the body's axis, B' in the plane (e2, e3), B2 >= 0, eq. (32).

    Parameters
    ----------
    axis : array_like, shape (3,)
        Symmetry axis at t = 0 in the user's frame, of any length but zero.
    B : array_like, shape (3,)
        Vector B' (not B) in the user's frame, in 1/time.

    Attributes
    ----------
    alignment : str
        Case of axis and field, see Notes.
    field : (float, float)
        (B2, B3), each rounded once.
    matrix : ndarray, shape (3, 3)
        Rows e1, e2, e3 in the user's frame, each component rounded once.

    Raises
    ------
    AtlasError
        For an axis or a field that is no vector.

    Notes
    -----
    Inputs are taken as exact. `alignment`, decided exactly, is `oblique`, `perpendicular` (B3 = 0), `parallel` or
    `antiparallel` (B2 = 0, B3 > 0 or < 0), or `no field`. In the last three cases the plane is free. e1 is then taken
    from the user's axis farthest from e3.
    """

    axis: FloatArray
    B: FloatArray
    alignment: str = attribute(init=False)
    field: tuple[float, float] = attribute(init=False)
    """(B2, B3), each rounded once."""
    matrix: FloatArray = attribute(init=False)
    """(3, 3); the rows are e1, e2, e3 in the user's frame, each component rounded once."""

    def __init__(self, axis: RealArrayLike, B: RealArrayLike) -> None:
        """Find the frame in rational numbers, where nearly parallel vectors lose no digits; see the class."""
        axis, B = vector(axis, "The axis"), vector(B, "B", RATE)
        n, b = exact(*axis), exact(*B)
        n2, b2, projection, normal = dot(n, n), dot(b, b), dot(n, b), cross(b, n)
        if n2 == 0:
            raise DomainError("The axis of the body must have a direction, but is the zero vector.")
        oblique = dot(normal, normal) != 0
        if oblique:
            alignment = "oblique" if projection != 0 else "perpendicular"
            e2 = [n2 * y - projection * x for x, y in zip(n, b, strict=True)]
        else:
            alignment = "no field" if b2 == 0 else "parallel" if projection > 0 else "antiparallel"
            e1 = exact(*np.eye(3)[np.argmin(np.abs(axis))])
            normal = tuple(n2 * y - dot(n, e1) * x for x, y in zip(n, e1, strict=True))
            e2 = list(cross(n, e1))
        with workprec():
            third = nearest(root(projection * projection / n2))
            field = (nearest(root(dot(normal, normal) / n2)) if oblique else 0.0, -third if projection < 0 else third)
            matrix = np.array([[nearest(x) for x in unit(row)] for row in (normal, e2, n)])
        object.__setattr__(self, "axis", axis)
        object.__setattr__(self, "B", B)
        object.__setattr__(self, "alignment", alignment)
        object.__setattr__(self, "field", finite(field, "A length or a frequency"))
        object.__setattr__(self, "matrix", frozen(matrix))

    def __repr__(self) -> str:
        text = call_text("LaboratoryFrame", {"axis": self.axis, "B": self.B})
        return f"{text}  # {self.alignment}, (B2, B3) = {self.field}"

    def to_laboratory(self, v: RealArrayLike) -> FloatArray:
        """Laboratory components of vectors in the user's frame, (32).

        Parameters
        ----------
        v : array_like, shape (..., 3)
            Vectors in the user's frame.

        Returns
        -------
        ndarray, shape (..., 3)
            Components in the laboratory.

        Raises
        ------
        AtlasError
            For an input that is no vector.
        """
        return vectors(v, "v") @ self.matrix.T

    def to_user(self, v: RealArrayLike) -> FloatArray:
        """User's components of vectors in the laboratory, (32).

        Parameters
        ----------
        v : array_like, shape (..., 3)
            Vectors in the laboratory.

        Returns
        -------
        ndarray, shape (..., 3)
            Components in the user's frame.

        Raises
        ------
        AtlasError
            For an input that is no vector.
        """
        return vectors(v, "v") @ self.matrix

    def rotation_to_user(self, R: RealArrayLike) -> FloatArray:
        """Rotations that act on the user's components as R acts on those of the laboratory.

        Parameters
        ----------
        R : array_like, shape (..., 3, 3)
            Rotation matrices in the laboratory.

        Returns
        -------
        ndarray, shape (..., 3, 3)
            Rotation matrices in the user's frame.

        Raises
        ------
        AtlasError
            For an input that is no matrix.
        """
        rotations = real(R, "R")
        if rotations.shape[-2:] != (3, 3):
            raise AtlasError(f"R must be matrices (..., 3, 3), not of shape {rotations.shape}.")
        return self.matrix.T @ rotations @ self.matrix
