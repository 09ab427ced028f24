"""One figure by itself, in the formats asked for."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any, Literal

OUT = Path("build/figures")


def build_figure(
    name: str,
    formats: Sequence[str] = ("svg", "pdf", "png"),
    out: Path = OUT,
    *,
    renderer: Literal["vector", "shaded"] = "vector",
    **parameters: Any,
) -> list[Path]:
    """Draw the recipe `name` into out/NAME.FORMAT for each format, each file whole or not at all; return the files."""
    from atlas.render.drawing import draw_all
    from atlas.scene import recipes

    scene = recipes.load(name).scene(**parameters)
    return [drawn.path for drawn in draw_all(scene, {out / f"{name}.{kind}": kind for kind in formats}, renderer)]
