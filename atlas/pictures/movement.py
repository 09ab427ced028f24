"""A scene at another time: the layers that ride on a path are moved as it says."""

from dataclasses import replace

import numpy as np

from atlas.pictures.layers import FloatArray, Layer, Scene, moved


def scene_at(scene: Scene, t: float) -> Scene:
    """Return a scene at the time t; at t = 0 it is the scene itself."""
    moves = {name: tuple(values[0] for values in path(np.array([t]))) for name, path in scene.paths.items()}

    def carried(layers: tuple[Layer, ...]) -> tuple[Layer, ...]:
        return tuple(
            moved(layer, *moves[rides]) if (rides := getattr(layer, "rides", "")) else layer for layer in layers
        )

    wide, small = (
        tuple(replace(panel, layers=carried(panel.layers)) for panel in panels)
        for panels in (scene.panels, scene.narrow)
    )
    return replace(scene, panels=wide, narrow=small)


def about(centre: FloatArray, turns: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the rigid motions of a body that turns by ``turns`` (N, 3, 3) about a point (3,)."""
    return turns, centre - turns @ centre


def along(places: FloatArray, start: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the rigid motions of what goes from a place (D,) to others (N, D), and does not turn."""
    return np.broadcast_to(np.eye(len(start)), (*places.shape, len(start))), places - start


def riding(layers: list[Layer], path: str) -> list[Layer]:
    """Return layers that ride on a path."""
    return [replace(layer, rides=path) for layer in layers]  # type: ignore[arg-type]  # no map or region rides
