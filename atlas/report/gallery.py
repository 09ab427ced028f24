"""The plates that a report wants: each figure block's recipe, renderer and parameters, each plate once."""

from collections.abc import Iterator, Mapping
from typing import Any, TypeAlias

from atlas.errors import AtlasError
from atlas.report import records, views
from atlas.report.load import nearest
from atlas.report.settings import Setting, setting

Gallery: TypeAlias = dict[str, views.Plate]


def gallery(report: records.Report) -> Gallery:
    """Return the plates that the figures of a report show, by name, in the order of their first showing.

    Nothing is drawn. A recipe that can't be loaded leaves the reason in its plates; a misspelt recipe or parameter
    raises AtlasError.
    """
    plates: Gallery = {}
    for page in report.pages:
        for place, block in enumerate(page.blocks, 1):
            if not isinstance(block, records.Figure):
                continue
            try:
                for plate in _wanted(block, report):
                    name = plate_name(block, plate.renderer, report)
                    if name not in plates:
                        plate.stem = f"{len(plates) + 1:02d}-{block.recipe.replace('_', '-')}"
                        plates[name] = plate
            except AtlasError as error:
                raise AtlasError(f"page {page.slug!r}, block {place} (figure): {error}") from error
    return plates


def plate_name(block: records.Figure, renderer: str, report: records.Report) -> str:
    """Name a plate of a figure block: the same for the same recipe, parameters and renderer."""
    recipe, _ = _recipe(block.recipe)
    return f"{block.recipe} {sorted(_parameters(block, recipe, report).items(), key=str)} {renderer}"


def renderers(block: records.Figure) -> tuple[str, ...]:
    """Return by which renderers a figure block is drawn."""
    return ("shaded", "vector") if block.renderer == "both" else (block.renderer,)


def settings_of(block: records.Figure | records.Table, report: records.Report) -> tuple[Setting, ...]:
    """Return the bodies of a block, each in its field."""
    known = report.parameters
    chosen = known.fields[block.field] if block.field else None
    bodies = block.bodies or ((block.body,) if block.body else (None,))
    return tuple(setting(known.bodies[name] if name else None, chosen) for name in bodies)


def _wanted(block: records.Figure, report: records.Report) -> Iterator[views.Plate]:
    """Go through the plates of a figure block; a misspelt parameter is an error."""
    recipe, failure = _recipe(block.recipe)
    parameters = _parameters(block, recipe, report)
    for name in parameters if recipe else ():
        if name not in recipe.parameters:
            guess = nearest(name, list(recipe.parameters))
            raise AtlasError(f"the recipe {block.recipe!r} has no parameter {name!r}{guess}.")
    for renderer in renderers(block):
        yield views.Plate("", block.recipe, renderer, parameters, failure=failure)


def _parameters(block: records.Figure, recipe: Any, report: records.Report) -> Mapping[str, Any]:
    """Turn the bodies and the field that a figure names into those parameters that its recipe takes."""
    settings = settings_of(block, report)
    offered: dict[str, Any] = {}
    if block.body:
        offered["ratio"] = settings[0].ratio
    if block.bodies:
        offered["ratios"] = tuple(one.ratio for one in settings)
    takes = recipe.parameters if recipe else offered
    for name in offered:
        if name not in takes:
            raise AtlasError(f"the recipe {block.recipe!r} takes no parameter {name!r}, so don't name a body.")
    if block.field:
        offered["field"] = settings[0].components
        physical = settings[0].physical
        if physical is not None:
            offered |= {"mu": physical.mu, "E": tuple(physical.E), "B": tuple(physical.B), "c": physical.c}
        if takes.get("unit") == "time":
            offered["unit"] = "s"
    return {name: value for name, value in offered.items() if name in takes} | block.parameters


def _recipe(name: str) -> tuple[Any, str]:
    """Load a recipe, or return why it can't be loaded; a name that there is not is an error."""
    from atlas.scene import recipes

    if name not in recipes.names():
        raise AtlasError(f"there is no recipe {name!r}{nearest(name, recipes.names())} in figures/.")
    try:
        return recipes.load(name), ""
    except Exception as error:  # noqa: BLE001  one figure's failure must not stop the others; it is reported
        return None, f"{type(error).__name__}: {error}"
