"""Make a scene once for all tests, find its layers, draw one into one file, and measure how far off a line is."""

from functools import lru_cache
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from atlas.pictures import Scene, recipes
from atlas.pictures.drawing.files import save

FloatArray = NDArray[np.float64]


@lru_cache(maxsize=200)
def scene_of(name: str, **parameters: Any) -> Scene:
    """Return the scene of a recipe; tests look at it and leave it as it is."""
    return recipes.load(name).scene(**parameters)


def panels(name: str, **parameters: Any) -> Any:
    """Return the panels of a figure."""
    return recipes.load(name).scene(**parameters).panels


def layers(panel: Any, kind: Any, role: str = "") -> list[Any]:
    """Return the layers of one kind, and role, of a panel."""
    return [layer for layer in panel.layers if isinstance(layer, kind) and role in {"", getattr(layer, "role", "")}]


def draw(scene: Scene, path: Path | str, renderer: str = "vector", dpi: float = 300.0) -> Path:
    """Draw a scene in the kind that the path ends with, and return the path."""
    path = Path(path)
    save(scene, {path: path.suffix.lstrip(".")}, renderer, {"savefig.dpi": dpi})
    return path


def distance(points: FloatArray, line: FloatArray) -> float:
    """Return the largest distance of points from the nearest place of a polyline."""
    nearest = np.full(len(points), np.inf)
    for a, b in pairwise(line):
        chord = b - a
        fraction = np.clip((points - a) @ chord / (float(chord @ chord) or 1.0), 0.0, 1.0)
        nearest = np.minimum(nearest, np.linalg.norm(points - a - fraction[:, None] * chord, axis=1))
    return float(nearest.max())
