"""A picture of a report: what is drawn, what became of it, and the command that draws it."""

import shlex
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any


@dataclass
class Picture:
    """A picture that is drawn once for all the blocks that show it: what is wanted, and what became of it.

    stem        its name among the files of the report
    recipe, renderer, parameters    what to draw: a name in figures/ or a file; `title` is that of the recipe
    caption, alt, size    what the scene says of itself, and its size in millimetres
    given       all parameters of the scene as text
    file        its place in the report: SVG or PNG; `files` those of all its formats, the data as CSV among them
    tables      the commands that make tables of the numbers that it shows
    narrow      the place of the same for a narrow screen, if that is another picture
    scene       the place of the script with which the page turns it, if it is in space
    moves       the place of the script that tells how it moves, if it does
    failure     why there is none, or nothing; `remark` what the reader should know of how it was drawn
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
    narrow: str = ""
    scene: str = ""
    moves: str = ""
    tables: tuple[str, ...] = ()
    failure: str = ""
    remark: str = ""

    @property
    def beside(self) -> dict[str, str]:
        """The places of what else the page shows it with, by kind; "" of what there is not."""
        return {"narrow": self.narrow, "scene": self.scene, "moves": self.moves}

    @property
    def called(self) -> str:
        """The recipe as it stands in the report: its name, or that of its file beside the report."""
        return Path(self.recipe).name

    @property
    def printed(self) -> str:
        """The file that the PDF shows: PDF in the place of SVG."""
        return self.file.replace(".svg", ".pdf")

    @property
    def command(self) -> str:
        """The command that draws it."""
        from atlas.scene.parameters import typed

        settings = [f"{name}={typed(value)}" for name, value in self.parameters.items() if value is not None]
        words = ["atlas", "figure", self.called, *(["--set", *settings] if settings else [])]
        return shlex.join([*words, *(["--renderer", "shaded"] if self.renderer == "shaded" else [])])
