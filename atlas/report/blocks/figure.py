"""A numbered figure: one picture, or two beside each other."""

from dataclasses import dataclass
from typing import Annotated, Any, Literal

import msgspec

from atlas.paper import EQUATIONS
from atlas.paper.citation import marked
from atlas.report.blocks.composer import Composer
from atlas.report.picture import Picture
from atlas.report.schema import Id, StrictStruct


class Figure(StrictStruct, frozen=True, tag_field="kind", tag="figure"):
    """A recipe with its parameters; ``both`` sets the shaded picture beside the line drawing."""

    recipe: str
    id: Id | None = None
    renderer: Literal["vector", "shaded", "both"] = "vector"
    body: str | None = None
    bodies: tuple[str, ...] = ()
    field: str | None = None
    sets: tuple[str, ...] = ()
    parameters: dict[str, Any] = msgspec.field(default_factory=dict)
    caption: str | None = None
    width: Annotated[float, msgspec.Meta(gt=0.0)] | None = None


@dataclass(frozen=True)
class FigureView:
    """A figure with its pictures; `width` and `height` in millimetres are those of each, `given` its parameters."""

    number: int
    id: str
    pictures: tuple[Picture, ...]
    caption: int
    alt: str
    width: float
    height: float
    given: int

    @property
    def failure(self) -> str:
        """Why there is no picture, or nothing."""
        return next((picture.failure for picture in self.pictures if picture.failure), "")

    @property
    def remark(self) -> str:
        """What the reader should know of how it was drawn, or nothing."""
        return next((picture.remark for picture in self.pictures if picture.remark), "")


def view(block: Figure, composer: Composer) -> FigureView:
    """Give a figure its number and take in its caption; where it could not be drawn, the view says why."""
    composer.figures += 1
    pictures = composer.pictures(block)
    first = pictures[0]
    caption = block.caption or marked(first.caption, EQUATIONS) or f"The recipe {first.called} failed."
    width, height = first.size
    shown = block.width or width
    anchor = composer.anchor("fig", block.id, "Figure", composer.figures)
    parameters = ", ".join(f"{name} = {value}" for name, value in first.given.items() if value != "None")
    return FigureView(
        composer.figures,
        anchor,
        pictures,
        composer.caption(caption, anchor, f"Figure {composer.figures}"),
        first.alt or first.failure,
        shown,
        height * shown / width,
        composer.text(parameters, inline=True),
    )
