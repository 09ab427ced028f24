"""A numbered figure: one picture, or two side by side, each with its recipe and its files."""

import shlex
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any, Literal

import msgspec

from atlas.book.blocks.composer import Composer
from atlas.book.schema import Id, StrictStruct
from atlas.trial.ledger import EQUATIONS
from atlas.trial.ledger.citation import marked


class Figure(StrictStruct, frozen=True, tag_field="kind", tag="figure"):
    """A figure block: recipe with parameters; renderer ``both`` shows shaded picture and line drawing side by side.

    `recipe` is a name in figures/ or a file beside the report, `id` the name that ``@fig:ID`` cites (None: the figure's
    number). `body`, `bodies`, `field` and `sets` name the report's bodies, field and sets of parameters, which give
    parameters to the recipe; `parameters`, values by name, override those. `caption`, Markdown with TeX, replaces the
    scene's; `width` is the width shown in millimetres, None for the scene's own.
    """

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


@dataclass
class Picture:
    """A picture that is drawn once for all the blocks that show it: its recipe, and its files or failure.

    stem        its name among the files of the report
    recipe, renderer, parameters    the drawing: a name in figures/ or a file, vector or shaded, values by name
    title       title of the recipe
    caption, alt, size    caption and alternative text of the scene, and its (width, height) in millimetres
    given       all parameters of the scene as text, by name
    file        path in the report of the SVG or PNG; `files` the paths of all its formats by kind, data as CSV included
    tables      shell commands that make tables of the numbers that it shows
    beside      paths of further files for the page, where there are any: "narrow" for a narrow screen, "scene", the
                script with which the page turns it, "moves", the script of its motion
    failure     why it could not be drawn, or ""; `remark` a sentence for the reader on how it was drawn, or ""
    """

    stem: str
    recipe: str
    renderer: str
    parameters: Mapping[str, Any]
    title: str = ""
    caption: str = ""
    alt: str = ""
    size: tuple[float, float] = (120.0, 30.0)
    given: Mapping[str, str] = field(default_factory=dict)
    file: str = ""
    files: Mapping[str, str] = field(default_factory=dict)
    beside: Mapping[str, str] = field(default_factory=dict)
    tables: tuple[str, ...] = ()
    failure: str = ""
    remark: str = ""

    @property
    def called(self) -> str:
        """Name of the recipe as shown in the report; of a recipe in its own file the file name, without folders."""
        return Path(self.recipe).name

    @property
    def printed(self) -> str:
        """Path in the report of the file that the PDF shows: the PDF in the place of an SVG, otherwise `file`."""
        return self.file.replace(".svg", ".pdf")

    @property
    def command(self) -> str:
        """Shell command "atlas figure ..." that draws the picture; parameters that are None are left out."""
        from atlas.pictures.parameters import typed_text

        settings = [f"{name}={typed_text(value)}" for name, value in self.parameters.items() if value is not None]
        words = ["atlas", "figure", self.called, *(["--set", *settings] if settings else [])]
        return shlex.join([*words, *(["--renderer", "shaded"] if self.renderer == "shaded" else [])])


@dataclass(frozen=True)
class FigureView:
    """A figure with its pictures: `width` and `height` of each in millimetres, `alt` the first one's alternative text.

    `number` is that of the figure, `id` its anchor, such as "fig-3"; `caption` and `given` (the parameters of the first
    picture) are indices among the document's texts.
    """

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
        """Reason why a picture is missing, that of the first missing one; "" if none is missing."""
        return next((picture.failure for picture in self.pictures if picture.failure), "")

    @property
    def remark(self) -> str:
        """First remark on how a picture was drawn, a sentence for the reader, or ""."""
        return next((picture.remark for picture in self.pictures if picture.remark), "")


def view(block: Figure, composer: Composer) -> FigureView:
    """Return the `FigureView` with the report's next number, and make it the target of citations of its id.

    The caption is the block's, else the scene's, else says that the recipe failed. The scene's words name the shape of
    the body that the block names. A width set by the block scales the height in proportion.
    """
    composer.figures += 1
    pictures = tuple(composer.document.pictures_of(block))
    picture = pictures[0]
    words, alt = (_with_shape(text, block, composer) for text in (picture.caption, picture.alt))
    caption = block.caption or marked(words, EQUATIONS) or f"The recipe {picture.called} failed."
    width, height = picture.size
    shown_width = block.width or width
    anchor = composer.anchor("fig", block.id, "Figure", composer.figures)
    parameters = ", ".join(f"{name} = {value}" for name, value in picture.given.items() if value != "None")
    return FigureView(
        composer.figures,
        anchor,
        pictures,
        composer.caption(caption, anchor, f"Figure {composer.figures}"),
        alt or picture.failure,
        shown_width,
        height * shown_width / width,
        composer.text(parameters, inline=True),
    )


def _with_shape(text: str, block: Figure, composer: Composer) -> str:
    """Return a scene's caption or alternative text, which names the shape of the block's body if it was given by one.

    The recipe has the ratio of the body alone, and writes "body". Another ratio of the block has no shape.
    """
    shape = composer.parameters.bodies[block.body].shape if block.body else None
    if shape is None or "ratio" in block.parameters:
        return text
    from atlas.pictures.captions import with_body_name

    return with_body_name(text, shape.replace("_", " "))
