"""One figure by itself, in the formats asked for."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

if TYPE_CHECKING:
    from atlas.render.drawing import Drawn

OUT = Path("build/figures")


def build_figure(
    name: str,
    formats: Sequence[str] = ("svg", "pdf", "png"),
    out: Path = OUT,
    *,
    renderer: Literal["vector", "shaded"] = "vector",
    **parameters: Any,
) -> "list[Drawn]":
    """Draw the recipe `name` into out/NAME.FORMAT for each format, each file whole or not at all.

    Return for each format the file, and a line to tell if another renderer drew it than the one asked for.
    """
    from atlas.render.drawing import draw_all
    from atlas.scene import recipes

    scene = recipes.load(name).scene(**parameters)
    return draw_all(scene, {out / f"{name}.{kind}": kind for kind in formats}, renderer)
