"""The picture of an object, by a recipe that takes its parameters."""

from dataclasses import replace
from inspect import signature
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from atlas.bodies.display import Shown
from atlas.errors import AtlasError, unknown
from atlas.motions.particle.flight import Flight
from atlas.motions.register import FAMILIES, Family
from atlas.pictures import flight, recipes
from atlas.pictures.drawing.panels import draw_panel, to_figure
from atlas.pictures.layers import Scene
from atlas.targets import find


def plot(
    subject: Shown,
    figure: str | None,
    panel: int | None,
    ax: Any,
    style: Any,
    target: str | None,
    parameters: dict[str, Any],
) -> Figure:
    """Return the Matplotlib figure of an object, see `Shown.plot`.

    `figure` names a recipe (None: the family's first), `panel` one of its panels, from 1 (None: all), `style` and
    `target` are those of `atlas.figure`, `parameters` the recipe's further parameters. With `ax` only the panel
    (None: 1) is drawn, on that axes. Raises AtlasError for a panel that there is not, for `target` with `ax`, and
    as `scene_of` does.
    """
    scene = scene_of(subject, figure, parameters)
    if panel is not None and panel not in range(1, len(scene.panels) + 1):
        raise AtlasError(f"The figure has the panels 1 to {len(scene.panels)}, and no panel {panel!r}.")
    if ax is None:
        return to_figure(
            scene if panel is None else single_panel(scene, panel),
            style,
            target=None if target is None else find(target),
        )
    if target is not None:
        raise AtlasError("target is for a whole figure; axes of your own have the size that you gave them.")
    draw_panel(ax, scene.panels[(panel or 1) - 1], style)
    figure_drawn: Figure = ax.figure
    return figure_drawn


def animate(motion: Any, times: Any, fps: float, style: Any) -> Any:
    """Return the `FuncAnimation` of a motion at `times` (N,), None for whole periods, `fps` frames a second.

    `style` is as for `atlas.figure`. Raises AtlasError for an array of motions, see `Motion.animate`.
    """
    from atlas.pictures.drawing.animation import of_motion

    return of_motion(motion, times, fps=fps, style=style)


def scene_of(subject: Shown, figure: str | None, parameters: dict[str, Any]) -> Scene:
    """Return the `Scene` of an object by the recipe named `figure`, None for its family's first.

    `parameters` are the recipe's parameters by name that the object does not fix. Raises AtlasError for an object
    without a picture, several objects, an unknown figure, and a parameter that the object fixes.
    """
    family, name = FAMILIES.get(subject.family), type(subject).__name__
    figures = family.figures if family else ("flight",) if isinstance(subject, Flight) else ()
    if not figures:
        raise AtlasError(f"There is no picture of a {name} yet.")
    if getattr(subject, "shape", ()):
        raise AtlasError(f"A picture is of one {name}, not of several: make one with numbers in place of arrays.")
    if figure is not None and figure not in figures:
        raise unknown("figure", figure, figures, f"of {name}")
    if family is None:
        return _flight(subject, parameters)
    recipe = recipes.load(figure or figures[0])
    fixed_parameters = _object_parameters(subject, family)
    for key in parameters:
        if key in fixed_parameters:
            raise AtlasError(f"{key} is that of the {name}; make another one for another {key}.")
    return recipe.scene(
        **{key: value for key, value in fixed_parameters.items() if key in recipe.parameters} | parameters
    )


def _flight(subject: Any, parameters: dict[str, Any]) -> Scene:
    """Return the scene of a `Flight` with further `parameters` of `flight.scene_of` by name.

    Raises AtlasError for another parameter.
    """
    parameter_names = signature(flight.scene_of).parameters
    for key in parameters:
        if key not in parameter_names or key == "flight":
            raise unknown(
                "parameter", key, [name for name in parameter_names if name != "flight"], "of a picture of a Flight"
            )
    return flight.scene_of(subject, **parameters)


def single_panel(scene: Scene, panel: int) -> Scene:
    """Return a copy of a scene with only its panel number `panel`, from 1, at that panel's size."""
    rows = -(-len(scene.panels) // scene.columns)
    size = scene.size[0] / min(scene.columns, len(scene.panels)), scene.size[1] / rows
    return replace(scene, panels=(scene.panels[panel - 1],), columns=1, size=size, narrow=())


def _object_parameters(subject: Shown, family: Family) -> dict[str, Any]:
    """Return the values of an object's parameters by name of the family's parameters, arrays as tuples, None left out.

    They are the arguments that made the object; for an object made otherwise, its attributes, of required
    parameters only.
    """
    if not subject.made_by and len(subject.arguments) == len(family.parameters):
        arguments = dict(zip((p.name for p in family.parameters), subject.arguments.values(), strict=True))
    else:
        arguments = {p.name: getattr(subject, p.name) for p in family.parameters if p.needed}
    return {
        name: tuple(value.tolist()) if isinstance(value, np.ndarray) else value
        for name, value in arguments.items()
        if value is not None
    }
