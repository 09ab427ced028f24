"""Figures as data: layers with roles, how the roles look, and the recipes that make them.

Classes of layers are loaded when they are first used: the names of recipes need no NumPy.
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from atlas.pictures.layers import (
        Arrow,
        Curve,
        Image,
        Label,
        Layer,
        Panel,
        Plane,
        Points,
        Region,
        Scene,
        Space,
        Surface,
    )

__all__ = [
    "Arrow",
    "Curve",
    "Image",
    "Label",
    "Layer",
    "Panel",
    "Plane",
    "Points",
    "Region",
    "Scene",
    "Space",
    "Surface",
]

if not TYPE_CHECKING:

    def __getattr__(name: str) -> Any:
        """Return a class of layers."""
        if name not in __all__:
            raise AttributeError(f"module 'atlas.pictures' has no attribute {name!r}")
        import atlas.pictures.layers as classes

        return globals().setdefault(name, getattr(classes, name))
