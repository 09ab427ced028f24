"""Draw a scene into one file, as the tests do."""

from pathlib import Path

from atlas.draw import save
from atlas.scene import Scene


def draw(scene: Scene, path: Path | str, renderer: str = "vector", dpi: float = 300.0) -> Path:
    """Draw a scene in the kind that the path ends with, and return the path."""
    path = Path(path)
    save(scene, {path: path.suffix.lstrip(".")}, renderer, {"savefig.dpi": dpi})
    return path
