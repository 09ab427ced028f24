"""Types of public parameters and results: `mypy` and editors refuse text, None and other objects for numbers."""

from collections.abc import Mapping, Sequence
from os import PathLike
from typing import Any, Literal, Protocol, SupportsFloat, TypeAlias

import numpy as np
from numpy.typing import NDArray

from atlas.arithmetic.inputs import FloatArray

FloatOrArray: TypeAlias = float | FloatArray
"""A value of each object: a float for one object, an array for an array of objects."""

NameOrArray: TypeAlias = str | NDArray[np.str_]
"""A name for one object, an array of names for an array of objects."""


class NumberArray(Protocol):
    """An array of real numbers, or an object that NumPy converts to one: a data frame's column, a quantity."""

    def __array__(self) -> NDArray[np.floating[Any] | np.integer[Any] | np.object_]: ...


class NumberSequence(Protocol):
    """A list or tuple of numbers, or of lists of them, for type checkers; text and bytes do not match."""

    def __len__(self) -> int: ...

    def __getitem__(self, place: int, /) -> "RealArrayLike": ...

    def __contains__(self, value: object, /) -> bool: ...


RealArrayLike: TypeAlias = SupportsFloat | NumberArray | NumberSequence
"""A finite real number, as float, integer, Fraction or quantity with a unit, or an array of them."""


class Body(Protocol):
    """Object with moments of inertia I2 = I1 and I3, for type checkers: a `SymmetricBody`."""

    @property
    def I2(self) -> Any:
        """Moment of inertia perpendicular to the axis, a number or one for each body."""

    @property
    def I3(self) -> Any:
        """Moment of inertia along the axis, a number or one for each body."""


class VectorField(Protocol):
    """Object with the exact components of a constant field, for type checkers: a `Field`."""

    @property
    def exact_pair(self) -> tuple[Any, ...]:
        """Components (B2, B3) of B' = mu B/(2c), in 1/time."""


class AsMatrix(Protocol):
    """Object with a method `as_matrix`, for type checkers: a rotation such as SciPy's `Rotation`."""

    def as_matrix(self) -> Any:
        """Return the rotation matrix, shape (3, 3) or (N, 3, 3)."""


BodyLike: TypeAlias = Body | RealArrayLike
"""Ratio I3/I2, principal moments or inertia tensor, or a `SymmetricBody`."""

FieldLike: TypeAlias = VectorField | RealArrayLike
"""Components of B', or a `Field`."""

AttitudeLike: TypeAlias = AsMatrix | RealArrayLike
"""Rotation matrix, or a rotation of SciPy."""

StyleLike: TypeAlias = (
    str | PathLike[str] | Mapping[str, Any] | Sequence[str | PathLike[str] | Mapping[str, Any]] | None
)
"""Style of Matplotlib: its name, file or settings, several of them, or none."""

ShapeName: TypeAlias = Literal[
    "ring", "disk", "cylindrical_shell", "solid_cylinder", "thin_rod", "sphere", "spherical_shell", "spheroid"
]
"""Name of a shape, a constructor of `SymmetricBody`."""
