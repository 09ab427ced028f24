"""Second moments of a charge distribution that is symmetric about the body's axis, apart from those of its mass."""

from dataclasses import dataclass
from dataclasses import field as attribute
from fractions import Fraction
from typing import Self

import numpy as np

from atlas.arithmetic.annotations import RealArrayLike, ShapeName
from atlas.arithmetic.dimensions import CHARGE, LENGTH
from atlas.arithmetic.given import as_float_or_fraction
from atlas.arithmetic.inputs import number, real, vectors
from atlas.bodies.body import SHAPES, from_shape
from atlas.bodies.inertia import MAX_EXACT_POINTS, sums_over_points
from atlas.errors import AtlasError, DomainError

CHARGE_MOMENT = "C m**2"
SYMMETRY_TOLERANCE = 1e-9
"""By how much moments about the axis may differ from symmetric ones, in parts of the largest."""


@dataclass(frozen=True)
class ChargeMoments:
    """Second moments of charge J = sum e (x^2 1 - x x^T) = diag(J2, J2, J3) (not in the paper).

    Parameters
    ----------
    J2, J3 : float
        Moments across and along the axis, of either sign, in charge times length^2; x counts from the centre of mass.

    Attributes
    ----------
    exact : tuple
        Moments (J2, J3) without rounding, as a charged top takes them: floats or fractions.

    Raises
    ------
    AtlasError
        For an input that is no finite number.

    Notes
    -----
    The sum of two objects belongs to both distributions together. The centre of charge must be the centre of mass,
    else flight and rotation are coupled. For a body held at a point of its axis the centre of charge may be anywhere
    on the axis; x then counts from that point.

    Examples
    --------
    >>> atlas.ChargeMoments(1.0, 2.0) + atlas.ChargeMoments(0.5, -1.0)
    ChargeMoments(J2=1.5, J3=1.0)
    """

    J2: float
    J3: float
    exact: tuple[float | Fraction, float | Fraction] = attribute(init=False, repr=False)
    """Moments (J2, J3) without rounding: floats or fractions."""

    def __init__(self, J2: float | Fraction, J3: float | Fraction) -> None:
        exact = (
            J if isinstance(J, Fraction) else number(J, name, CHARGE_MOMENT) for name, J in (("J2", J2), ("J3", J3))
        )
        object.__setattr__(self, "exact", tuple(exact))
        for name, J in zip(("J2", "J3"), self.exact, strict=True):
            object.__setattr__(self, name, number(J, name))

    def __add__(self, other: "ChargeMoments") -> "ChargeMoments":
        if not isinstance(other, ChargeMoments):
            return NotImplemented
        J2, J3 = (as_float_or_fraction(Fraction(x) + Fraction(y)) for x, y in zip(self.exact, other.exact, strict=True))
        return ChargeMoments(J2, J3)

    @classmethod
    def shape(cls, name: ShapeName, charge: float, **dimensions: RealArrayLike) -> Self:
        """Moments of a charge spread uniformly over a shape of `SymmetricBody`.

        Parameters
        ----------
        name : str
            Shape: "ring", "spherical_shell", ...
        charge : float
            Total charge, of either sign.
        **dimensions : float
            Dimensions of the shape without its mass, such as radius.

        Returns
        -------
        ChargeMoments
            Moments about the centre of the shape.

        Raises
        ------
        DomainError
            For a dimension that is not positive.
        AtlasError
            For another shape or other dimensions.
        """
        if "mass" in dimensions:
            raise AtlasError("Moments of a charge take no mass: give the charge and the dimensions of the shape.")
        if name in SHAPES and {*dimensions, "mass"} != {*SHAPES[name][1]}:
            sizes, given_sizes = (
                ", ".join(size for size in x if size != "mass") for x in (SHAPES[name][1], dimensions)
            )
            raise AtlasError(f"The moments of a charged {name} take {sizes}, not {given_sizes or 'nothing'}.")
        charge = number(charge, "The charge", CHARGE)
        body = from_shape(name, mass=abs(charge) or 1.0, **dimensions)
        sign = int(np.sign(charge))
        J2, J3 = (as_float_or_fraction(sign * Fraction(*I.as_integer_ratio())) for I in body.exact)
        return cls(J2, J3)

    @classmethod
    def points(cls, charges: RealArrayLike, positions: RealArrayLike, *, held: bool = False) -> Self:
        """Moments of point charges about the body's axis e3.

        Parameters
        ----------
        charges : array_like, shape (N,)
            Charges, of either sign.
        positions : array_like, shape (N, 3)
            Positions from the centre of mass, or from the fixed point of a held body.
        held : bool
            True for a body held at a point of its axis.

        Returns
        -------
        ChargeMoments
            Moments J2 and J3, of up to 4096 points without rounding.

        Raises
        ------
        DomainError
            If the moments are not symmetric about e3 to 1e-9 of the largest. For a free body also if the sum of e x is
            not 0.
        AtlasError
            For arrays of other shapes.
        """
        e, x = real(charges, "The charges", CHARGE), vectors(positions, "The positions", LENGTH)
        if e.ndim != 1 or x.shape != (*e.shape, 3):
            raise AtlasError(f"Point charges are given by (N,) charges and (N, 3) positions, not {e.shape}, {x.shape}.")
        dipole, reach = e @ x, np.abs(e) @ np.linalg.norm(x, axis=1)
        if not held and np.abs(dipole).max(initial=0.0) > SYMMETRY_TOLERANCE * reach:
            raise DomainError(
                f"The centre of charge is off the centre of mass: the sum of e x is {dipole.tolist()}, where it must "
                "be zero, lest the flight drive the rotation; of a body held at a point, say held=True, or --heavy."
            )
        moments = np.einsum("n,nk,nk->", e, x, x) * np.eye(3) - np.einsum("n,ni,nj->ij", e, x, x)
        symmetric = np.diag([moments[0, 0], moments[0, 0], moments[2, 2]])
        size = np.abs(e) @ np.einsum("nk,nk->n", x, x)
        if np.abs(moments - symmetric).max() > SYMMETRY_TOLERANCE * size:
            mixed = np.abs(moments[~np.eye(3, dtype=bool)]).max()
            raise DomainError(
                "The charges are not symmetric about e3, the body's axis: J1 and J2 differ by "
                f"{abs(moments[0, 0] - moments[1, 1]):.3g} and elements off the diagonal reach {mixed:.3g}, more than "
                f"{SYMMETRY_TOLERANCE * size:.3g} (1e-9 of the largest) for rounding."
            )
        if e.size > MAX_EXACT_POINTS:
            return cls(float(moments[0, 0] + moments[1, 1]) / 2, float(moments[2, 2]))
        _, ((a, *_), (_, b, _), (*_, c)) = sums_over_points(e, x)
        return cls(as_float_or_fraction((a + b) / 2 + c), as_float_or_fraction(a + b))
