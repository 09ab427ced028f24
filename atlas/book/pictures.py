"""The pictures that a report wants: each figure block's recipe, renderer and parameters, each picture once."""

import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from atlas.book.blocks.figure import Figure, Picture
from atlas.book.body_and_field import chosen
from atlas.book.definition import Report
from atlas.errors import AtlasError, unknown


def pictures(report: Report) -> dict[str, Picture]:
    """Return the pictures of a report's figures and gallery, by a key (see `keys`), in the order of appearance.

    Nothing is drawn. A recipe that cannot be loaded leaves the reason in its pictures; a misspelt recipe or parameter
    raises AtlasError.
    """
    by_key: dict[str, Picture] = {}
    for page in report.pages:
        for place, block in enumerate(page.blocks):
            if not isinstance(block, Figure):
                continue
            try:
                for name, picture in _pictures_of_block(block, report):
                    if name not in by_key:
                        picture.stem = f"{len(by_key) + 1:02d}-{re.sub('[^A-Za-z0-9]+', '-', Path(block.recipe).stem)}"
                        by_key[name] = picture
            except AtlasError as error:
                raise AtlasError(f"{report.place(page, place)}: {error}") from error
    recipes_shown = {picture.recipe for picture in by_key.values()}
    for block in (Figure(recipe=name) for name in report.gallery if name not in recipes_shown):
        for name, picture in _pictures_of_block(block, report):
            picture.stem = f"gallery-{Path(block.recipe).stem}"
            by_key[name] = picture
    return by_key


def keys(block: Figure, report: Report) -> list[str]:
    """Return the keys of a figure block's pictures, texts; equal recipe, parameters and renderer give equal keys."""
    return [name for name, _ in _pictures_of_block(block, report)]


def on_cards(report: Report) -> set[str]:
    """Return the keys of the pictures that represent pages on the front page: of thumbnails, else first figures."""
    figures = [(page.slug, block) for page in report.pages for block in page.blocks if isinstance(block, Figure)]
    named = {page.slug: page.thumbnail.figure for page in report.pages}
    blocks = [
        next((block for slug, block in figures if (block.id == name if name else slug == page)), None)
        for page, name in named.items()
    ]
    return {keys(block, report)[0] for block in blocks if block}


def _pictures_of_block(block: Figure, report: Report) -> Iterator[tuple[str, Picture]]:
    """Yield (key, `Picture`) of a figure block: two with the renderer "both", else one; their `stem` is still "".

    Raises AtlasError for an unknown recipe, and for a parameter that the recipe lacks.
    """
    recipe, failure = _recipe(block.recipe)
    parameters = _parameters(block, recipe, report)
    for name in parameters if recipe else ():
        if name not in recipe.parameters:
            raise unknown("parameter", name, recipe.parameters, f"of the recipe {Path(block.recipe).name!r}")
    for renderer in ("shaded", "vector") if block.renderer == "both" else (block.renderer,):
        key = f"{block.recipe} {sorted(parameters.items(), key=str)} {renderer}"
        title = recipe.title if recipe else Path(block.recipe).stem
        yield key, Picture("", block.recipe, renderer, parameters, title, failure=failure)


def _parameters(block: Figure, recipe: Any, report: Report) -> Mapping[str, Any]:
    """Return the recipe's parameters by name: from the block's body and field, overridden by the block's own.

    Raises AtlasError for a body that the recipe does not take. `recipe` is None if it cannot be loaded. `report`
    has the bodies and fields that the block names.
    """
    cases = chosen(block, report.parameters)
    offered: dict[str, Any] = {}
    if block.body:
        offered["ratio"] = cases[0].ratio
    if block.bodies:
        offered["ratios"] = tuple(case.ratio for case in cases)
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
    """Return (recipe, "") for a name or a file, or (None, reason why it can't be loaded).

    Raises AtlasError for an unknown name.
    """
    from atlas.pictures import recipes

    if not name.endswith(".py") and name not in recipes.names():
        raise unknown("recipe", name, recipes.names(), "in figures/")
    try:
        return recipes.load(name), ""
    except Exception as error:  # noqa: BLE001  one figure's failure must not stop the others; it is reported
        return None, f"{type(error).__name__}: {error}"
