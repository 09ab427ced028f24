"""Figures as data: layers with roles, how the roles look, and the recipes that make them."""

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
