"""A scene as a `matplotlib.figure.Figure` or as a `pyvista.Plotter`, and into files.

The libraries that draw are loaded by the first call.
"""

from os import PathLike
from typing import TYPE_CHECKING

from atlas.arithmetic.annotations import StyleLike

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from pyvista import Plotter


def figure(
    name: str | PathLike[str], style: StyleLike = None, target: str | None = None, **parameters: object
) -> "Figure":
    """Matplotlib figure of a recipe in figures/.

    Parameters
    ----------
    name : str or PathLike
        Name of the recipe, or a file NAME.py of your own.
    style : str or dict or list, optional
        Matplotlib style on top of the package's own; a list that begins with "default" replaces the package's.
    target : str, optional
        Publication target, such as "aps" or "beamer", that sets width, fonts, line widths and resolution; see
        `atlas.targets`.
    **parameters
        Parameters of the recipe; others keep their defaults.

    Returns
    -------
    matplotlib.figure.Figure
        Figure; ``savefig`` writes a file.

    Raises
    ------
    DomainError
        If the recipe has no picture at these parameters.
    AtlasError
        For an unknown name, parameter, style or target, and for a figure that is unreadable at its target.
    """
    from atlas.pictures import recipes
    from atlas.pictures.drawing.panels import to_figure
    from atlas.targets import find

    place = None if target is None else find(target)
    return to_figure(recipes.load(name).scene(**parameters), style, target=place)


def plotter(name: str | PathLike[str], *, off_screen: bool = True, **parameters: object) -> "Plotter":
    """PyVista plotter of the panels in space of a recipe in figures/.

    Parameters
    ----------
    name : str or PathLike
        Name of the recipe, or a file NAME.py of your own.
    off_screen : bool
        False for a window, opened by ``show``.
    **parameters
        Parameters of the recipe; others keep their defaults.

    Returns
    -------
    pyvista.Plotter
        Plotter in the coordinates of the scene, with depth peeling; ``screenshot`` and ``export_gltf`` write files.

    Raises
    ------
    AtlasError
        For an unknown name or parameter, for a recipe without a panel in space, and without a GL library.
    """
    from atlas.pictures import recipes
    from atlas.pictures.drawing.window import to_plotter

    return to_plotter(recipes.load(name).scene(**parameters), off_screen=off_screen)
