"""A scene as a `matplotlib.figure.Figure` or as a `pyvista.Plotter`, and into files.

`figure`, `animate` and `plotter` take a recipe's name, `to_figure` and `to_plotter` a scene; `save` writes files. The
libraries that draw are loaded by the first call.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from pyvista import Plotter

_HOMES = {
    "animate": "atlas.pictures.drawing.animation",
    "context": "atlas.pictures.drawing.style",
    "save": "atlas.pictures.drawing.files",
    "to_figure": "atlas.pictures.drawing.panels",
    "to_plotter": "atlas.pictures.drawing.window",
}

__all__ = ["animate", "context", "figure", "plotter", "save", "to_figure", "to_plotter"]


def figure(name: str, style: Any = None, target: str | None = None, **parameters: Any) -> "Figure":
    """Return the Matplotlib figure of a recipe in figures/, with these parameters and the defaults for the rest.

    With a ``target``, such as "aps" or "beamer", see `atlas.targets`, it is laid out anew at that width, with the
    sizes of type, widths of lines, fonts and resolution that are asked there, which `savefig` keeps.

    ``style`` is what `matplotlib.style.use` takes (a name, a file, a dict, or a list of them), applied on top of the
    package's own sheet; a list that begins with "default" replaces it. The figure is one as any other: it is saved by
    ``f.savefig(...)``. Raises AtlasError for an unknown name, parameter, style or target, and for a figure that can't
    be read at its target, DomainError where the recipe has no picture.
    """
    from atlas.pictures import recipes
    from atlas.pictures.drawing.panels import to_figure
    from atlas.targets import find

    place = None if target is None else find(target)
    return to_figure(recipes.load(name).scene(**parameters), style, target=place)


def plotter(name: str, *, off_screen: bool = True, **parameters: Any) -> "Plotter":
    """Return the panels in space of a recipe in figures/ as a PyVista plotter.

    Coordinates are those of the scene. Translucent surfaces are depth-peeled, so that it may be turned: call ``show``
    (with ``off_screen=False``), ``screenshot`` or ``export_gltf``. Raises AtlasError for an unknown name or parameter,
    for a recipe without a panel in space, and where no GL library can draw.
    """
    from atlas.pictures import recipes
    from atlas.pictures.drawing.window import to_plotter

    return to_plotter(recipes.load(name).scene(**parameters), off_screen=off_screen)


def __getattr__(name: str) -> Any:
    """Load a public name from its module."""
    if name not in _HOMES:
        raise AttributeError(f"module 'atlas.pictures.drawing' has no attribute {name!r}")
    return getattr(import_module(_HOMES[name]), name)
