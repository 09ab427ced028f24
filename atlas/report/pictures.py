"""The pictures that a report wants: each figure block's recipe, renderer and parameters, each picture once."""

import re
import shlex
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from atlas.errors import AtlasError, unknown
from atlas.report.body_and_field import chosen

if TYPE_CHECKING:
    from atlas.report.blocks.figure import Figure
    from atlas.report.definition import Report


@dataclass
class Picture:
    """A picture that is drawn once for all the blocks that show it: what is wanted, and what became of it.

    stem        its name among the files of the report
    recipe, renderer, parameters    what to draw: a name in figures/ or a file; `title` is that of the recipe
    caption, alt, size    what the scene says of itself, and its size in millimetres
    given       all parameters of the scene as text
    file        its place in the report: SVG or PNG; `files` those of all its formats, the data as CSV among them
    narrow      the place of an SVG with its panels below one another, if it has several beside each other
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
    failure: str = ""
    remark: str = ""

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


def pictures(report: "Report") -> dict[str, Picture]:
    """Return the pictures that the figures of a report show, by `key`, in the order of their first showing.

    Nothing is drawn. A recipe that can't be loaded leaves the reason in its pictures; a misspelt recipe or parameter
    raises AtlasError.
    """
    from atlas.report.blocks.figure import Figure

    found: dict[str, Picture] = {}
    for page in report.pages:
        for place, block in enumerate(page.blocks, 1):
            if not isinstance(block, Figure):
                continue
            try:
                for name, picture in _wanted(block, report):
                    if name not in found:
                        picture.stem = f"{len(found) + 1:02d}-{re.sub('[^A-Za-z0-9]+', '-', Path(block.recipe).stem)}"
                        found[name] = picture
            except AtlasError as error:
                raise AtlasError(f"page {page.slug!r}, block {place} (figure): {error}") from error
    return found


def keys(block: "Figure", report: "Report") -> list[str]:
    """Return the keys of the pictures of a figure block: the same for the same recipe, parameters and renderer."""
    return [name for name, _ in _wanted(block, report)]


def _wanted(block: "Figure", report: "Report") -> Iterator[tuple[str, Picture]]:
    """Go through the pictures of a figure block with their keys; a misspelt parameter is an error."""
    recipe, failure = _recipe(block.recipe)
    parameters = _parameters(block, recipe, report)
    for name in parameters if recipe else ():
        if name not in recipe.parameters:
            raise unknown("parameter", name, recipe.parameters, f"of the recipe {Path(block.recipe).name!r}")
    for renderer in ("shaded", "vector") if block.renderer == "both" else (block.renderer,):
        key = f"{block.recipe} {sorted(parameters.items(), key=str)} {renderer}"
        title = recipe.title if recipe else Path(block.recipe).stem
        yield key, Picture("", block.recipe, renderer, parameters, title, failure=failure)


def _parameters(block: "Figure", recipe: Any, report: "Report") -> Mapping[str, Any]:
    """Turn the bodies and the field that a figure names into those parameters that its recipe takes."""
    cases = chosen(block, report.parameters)
    offered: dict[str, Any] = {}
    if block.body:
        offered["ratio"] = cases[0].ratio
    if block.bodies:
        offered["ratios"] = tuple(one.ratio for one in cases)
    takes = recipe.parameters if recipe else offered
    for name in offered:
        if name not in takes:
            raise AtlasError(f"the recipe {block.recipe!r} takes no parameter {name!r}, so don't name a body.")
    if block.field:
        offered["field"] = cases[0].components
        physical = cases[0].physical
        if physical is not None:
            offered |= {"mu": physical.mu, "E": tuple(physical.E), "B": tuple(physical.B), "c": physical.c}
        if takes.get("unit") == "time":
            offered["unit"] = "s"
    return {name: value for name, value in offered.items() if name in takes} | block.parameters


def _recipe(name: str) -> tuple[Any, str]:
    """Load a recipe, or return why it can't be loaded; a name that there is not is an error."""
    from atlas.scene import recipes

    if not name.endswith(".py") and name not in recipes.names():
        raise unknown("recipe", name, recipes.names(), "in figures/")
    try:
        return recipes.load(name), ""
    except Exception as error:  # noqa: BLE001  one figure's failure must not stop the others; it is reported
        return None, f"{type(error).__name__}: {error}"
