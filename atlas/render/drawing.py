"""One scene into files, by either back end, whole or not at all."""

import os
from collections.abc import Mapping
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Literal, TypeAlias

from atlas.errors import AtlasError
from atlas.scene.layers import Scene, Space

Renderer: TypeAlias = Literal["vector", "shaded"]
FORMATS = ("svg", "pdf", "png")
LETTERS = ("matplotlib.textpath", "matplotlib.backends.backend_agg")
LIBRARIES = {"vector": LETTERS, "shaded": (*LETTERS, "pyvista")}
"""What each back end draws with; that of a PDF file comes when one is asked for."""

__all__ = ["FORMATS", "Drawn", "Renderer", "choose", "draw", "draw_all", "load", "prepare"]


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
    return draw_all(scene, {Path(path): format or Path(path).suffix.lstrip(".")}, renderer, dpi=dpi)[0]


def draw_all(
    scene: Scene, files: Mapping[Path, str], renderer: Renderer = "vector", *, dpi: float = 300.0
) -> list[Drawn]:
    """Draw a scene once into several files, each in its format; for the rest see `draw`."""
    kinds = {path: kind.lower() for path, kind in files.items()}
    for path, kind in kinds.items():
        if kind not in FORMATS:
            raise AtlasError(f"cannot draw the format {kind!r} of {path.name!r}; known: {', '.join(FORMATS)}")
    used, note = choose(scene, renderer)
    for path, kind in kinds.items():
        if used == "shaded" and kind != "png":
            raise AtlasError(f"a shaded figure is a PNG; {path.name!r} asks for {kind!r}")
    parts = {path.with_name(f".{path.name}.{os.getpid()}.part"): path for path in kinds}
    try:
        for path in kinds:
            path.parent.mkdir(parents=True, exist_ok=True)
        load(used).save(scene, {part: kinds[path] for part, path in parts.items()}, dpi=dpi)
        for part, path in parts.items():
            part.replace(path)
    finally:
        for part in parts:
            part.unlink(missing_ok=True)
    return [Drawn(path, used, note) for path in kinds]


def load(renderer: Renderer) -> ModuleType:
    """Load a back end with the libraries that it draws with."""
    for library in LIBRARIES[renderer]:
        import_module(library)
    if renderer == "shaded":
        from atlas.render import shaded as back_end
    else:
        from atlas.render import vector as back_end
    return back_end


def prepare(renderer: Renderer) -> None:
    """Load a back end and make it ready, while there is nothing to draw yet."""
    load(renderer)
    if renderer == "shaded":
        from atlas.render import studio

        studio.warm_up()


def choose(scene: Scene, renderer: str) -> tuple[Renderer, str]:
    """Return the renderer that will draw a scene when this one is asked for, and a line that says why not, if so."""
    if renderer not in {"vector", "shaded"}:
        raise AtlasError(f"no renderer {renderer!r}; known: vector, shaded")
    if renderer == "vector" or not any(isinstance(panel, Space) for panel in scene.panels):
        return "vector", ""
    from atlas.render import gl

    return ("vector", gl.advice()) if gl.prepare() is None else ("shaded", "")
