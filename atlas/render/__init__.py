"""Two back ends for one scene: on paper (Matplotlib, hidden lines) and shaded (PyVista)."""

import os
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, TypeAlias

from atlas.errors import AtlasError
from atlas.scene.layers import Scene, Space

Renderer: TypeAlias = Literal["vector", "shaded"]
FORMATS = ("svg", "pdf", "png")

__all__ = ["FORMATS", "Drawn", "Renderer", "draw"]


@dataclass(frozen=True)
class Drawn:
    """What was done: the file, the renderer that drew it, and a line to tell the user if it is not the one asked."""

    path: Path
    renderer: Renderer
    note: str = ""


def draw(
    scene: Scene,
    path: Path | str,
    format: str | None = None,  # noqa: A002  the word of the public face
    renderer: Renderer = "vector",
    *,
    dpi: float = 300.0,
) -> Drawn:
    """Draw a scene into a file, whole or not at all.

    The ending of ``path`` decides the format (svg, pdf, png) unless ``format`` does. Shaded pictures are PNG. Where no
    GL library can draw, and for scenes without a panel in space, the vector renderer takes over.
    """
    path = Path(path)
    kind = (format or path.suffix.lstrip(".")).lower()
    if kind not in FORMATS:
        raise AtlasError(f"cannot draw the format {kind!r} of {path.name!r}; known: {', '.join(FORMATS)}")
    if renderer not in {"vector", "shaded"}:
        raise AtlasError(f"no renderer {renderer!r}; known: vector, shaded")
    used, note = renderer, ""
    if not any(isinstance(panel, Space) for panel in scene.panels):
        used = "vector"
    elif renderer == "shaded":
        from atlas.render import gl

        if kind != "png":
            raise AtlasError(f"a shaded figure is a PNG; {path.name!r} asks for {kind!r}")
        if gl.prepare() is None:
            used, note = "vector", gl.advice()
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        if used == "shaded":
            from atlas.render import shaded

            shaded.save(scene, part, dpi=dpi)
        else:
            from atlas.render import vector

            vector.save(scene, part, kind, dpi=dpi)
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)
    return Drawn(path, used, note)
