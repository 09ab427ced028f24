"""Moments of inertia of homogeneous shapes, (8), from their mass and the squares of their dimensions."""

from collections.abc import Callable, Iterable, Mapping
from typing import Any

from atlas.errors import AtlasError


def _pi_like(length: Any) -> Any:
    """Return pi in the arithmetic of ``length``, see `numbers.pi_like`, which is imported only here.

    So the names of shapes are listed without loading flint.
    """
    from atlas.arithmetic.numbers import pi_like

    return pi_like(length)


SHAPES: Mapping[str, tuple[tuple[str, ...], Callable[..., tuple[Any, Any]]]] = {
    "ring": (("mass", "radius"), lambda m, R2: (m * R2 / 2, m * R2)),
    "disk": (("mass", "radius"), lambda m, R2: (m * R2 / 4, m * R2 / 2)),
    "cylindrical_shell": (("mass", "radius", "height"), lambda m, R2, h2: (m * (R2 / 2 + h2 / 12), m * R2)),
    "solid_cylinder": (("mass", "radius", "height"), lambda m, R2, h2: (m * (R2 / 4 + h2 / 12), m * (R2 / 2))),
    "thin_rod": (("mass", "length"), lambda m, l2: (m * l2 / 12, 0 * m)),
    "sphere": (("mass", "radius"), lambda m, R2: (2 * m * R2 / 5, 2 * m * R2 / 5)),
    "spherical_shell": (("mass", "radius"), lambda m, R2: (2 * m * R2 / 3, 2 * m * R2 / 3)),
    "spheroid": (("mass", "equatorial", "polar"), lambda m, a2, c2: (m * (a2 / 5 + c2 / 5), 2 * m * (a2 / 5))),
}
"""Dimensions and moments (I2, I3) of shapes by name, of the mass and the squares of the lengths."""

VOLUMES: Mapping[str, Callable[..., Any]] = {
    "solid_cylinder": lambda R, h: _pi_like(R) * (R * R * h),
    "sphere": lambda R: 4 * _pi_like(R) * (R * R * R) / 3,
    "spheroid": lambda a, c: 4 * _pi_like(a) * (a * a * c) / 3,
}
"""Volumes of the solid shapes by name, of their lengths."""

FLAT = ("height", "polar")
"""Dimensions that may be zero."""


def check_shape(name: str, dimensions: Iterable[str]) -> None:
    """Raise AtlasError for an unknown shape, and for dimensions other than those of the shape."""
    if name not in SHAPES:
        raise AtlasError(f"There is no shape {name!r}; the shapes are {', '.join(SHAPES)}.")
    names, given_names = SHAPES[name][0], list(dimensions)
    if set(given_names) != set(names):
        dimensions_given = ", ".join(given_names) or "nothing"
        raise AtlasError(f"The shape {name} is given by {', '.join(names)}, not by {dimensions_given}.")
