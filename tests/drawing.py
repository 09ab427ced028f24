"""Make a scene once for all tests, and draw one into one file."""

from functools import lru_cache
from pathlib import Path
from typing import Any

from atlas.draw import save
from atlas.scene import Scene, recipes


@lru_cache(maxsize=200)
def made(name: str, **parameters: Any) -> Scene:
    """Return the scene of a recipe; tests look at it and leave it as it is."""
    return recipes.load(name).scene(**parameters)


def draw(scene: Scene, path: Path | str, renderer: str = "vector", dpi: float = 300.0) -> Path:
    """Draw a scene in the kind that the path ends with, and return the path."""
    path = Path(path)
    save(scene, {path: path.suffix.lstrip(".")}, renderer, {"savefig.dpi": dpi})
    return path
