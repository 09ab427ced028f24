"""A scene at another time: the layers that ride on a path are moved as it says."""

from dataclasses import replace
from typing import Any

import numpy as np

from atlas.motions.base import Motion
from atlas.pictures.layers import FloatArray, Layer, Panel, Plane, Scene, mapped, points_of

SEAM = 0.01
"""Distance, in units of the extent of the moving layers, below which the seam of a loop is not seen."""


def scene_at(scene: Scene, t: float) -> Scene:
    """Return a copy of a scene whose layers that ride on a path are moved to the time t of that path.

    A path is a function of any time, see `Path`. Panels for a narrow screen are moved too; other layers stay.
    """
    moves = {name: tuple(values[0] for values in path(np.array([t]))) for name, path in scene.paths.items()}

    def advanced(layers: tuple[Layer, ...]) -> tuple[Layer, ...]:
        return tuple(
            mapped(layer, *moves[rides]) if (rides := getattr(layer, "rides", "")) else layer for layer in layers
        )

    wide, small = (
        tuple(replace(panel, layers=advanced(panel.layers)) for panel in panels)
        for panels in (scene.panels, scene.narrow)
    )
    return replace(scene, panels=wide, narrow=small)


def rotations_about(centre: FloatArray, turns: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the rotations R = `turns` (N, 3, 3) about a point (3,) as maps x -> R x + d: the pair R, d (N, 3)."""
    return turns, centre - turns @ centre


def body_path(motion: Motion[Any], start: float, centre: FloatArray, t: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return rotations R (N, 3, 3) and shifts d (N, 3) that move a body drawn at time ``start``: x -> R x + d.

    Times t (N,) are counted from ``start``; R = R(start + t) R(start)^T, and ``centre`` (3,) stays where it is.
    """
    return rotations_about(centre, motion.rotation(start + t) @ motion.rotation(start).T)


def translations(places: FloatArray, start: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return identity matrices (N, D, D) and the translations (N, D) from the point ``start`` (D,) to N ``places``."""
    return np.broadcast_to(np.eye(len(start)), (*places.shape, len(start))), places - start


def riding(layers: list[Layer], path: str) -> list[Layer]:
    """Return copies of layers with their attribute `rides` set to the name `path`. A region or a map is a TypeError."""
    return [replace(layer, rides=path) for layer in layers]  # type: ignore[arg-type]  # no map or region rides


def closes(scene: Scene) -> bool:
    """Return whether all moving layers are at the end where they started, within `SEAM` of their extent.

    The end is t = `lasts` of the scene.
    """
    end = scene_at(scene, scene.lasts)
    for before, after in zip(map(_riders, scene.panels), map(_riders, end.panels), strict=True):
        if np.abs(after - before).max(initial=0.0) > SEAM * np.ptp(before, axis=0).max(initial=0.0):
            return False
    return True


def _riders(panel: Panel) -> FloatArray:
    """Return the points (N, 2) or (N, 3) of a panel's layers that ride on a path, (0, 2) or (0, 3) for none."""
    flat = 2 if isinstance(panel, Plane) else 3
    point_sets = [points for layer in panel.layers if getattr(layer, "rides", "") for points in points_of(layer)]
    return np.concatenate([np.empty((0, flat)), *(np.reshape(points, (-1, flat)) for points in point_sets)])
