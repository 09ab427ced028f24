"""A scene at another time: the layers that ride on a path are moved as it says."""

from dataclasses import replace

import numpy as np

from atlas.scene.layers import Arrow, Curve, FloatArray, Label, Layer, Points, Scene, Surface


def at(scene: Scene, t: float) -> Scene:
    """Return a scene at the time t; at t = 0 it is the scene itself."""
    moves = {name: tuple(part[0] for part in path(np.array([t]))) for name, path in scene.paths.items()}

    def moved(layers: tuple[Layer, ...]) -> tuple[Layer, ...]:
        return tuple(_moved(one, *moves[rides]) if (rides := getattr(one, "rides", "")) else one for one in layers)

    wide, small = (
        tuple(replace(one, layers=moved(one.layers)) for one in panels) for panels in (scene.panels, scene.narrow)
    )
    return replace(scene, panels=wide, narrow=small)


def _moved(layer: Layer, R: FloatArray, s: FloatArray) -> Layer:
    """Return a layer moved by x -> R x + s."""
    if isinstance(layer, Curve | Points):
        return replace(layer, points=layer.points @ R.T + s)
    if isinstance(layer, Arrow):
        return replace(layer, tail=R @ layer.tail + s, tip=R @ layer.tip + s)
    if isinstance(layer, Label):
        return replace(layer, at=layer.at @ R.T + s)
    return _carried(layer, R, s) if isinstance(layer, Surface) else layer


def _carried(surface: Surface, R: FloatArray, s: FloatArray) -> Surface:
    """Return a surface moved by x -> R x + s: its form is that of the points that come to a place."""
    back = np.eye(4)
    back[:3, :3], back[:3, 3] = R.T, -R.T @ s
    clip = surface.clip.copy()
    clip[:, :3] = surface.clip[:, :3] @ R.T
    clip[:, 3] += clip[:, :3] @ s
    return replace(
        surface,
        quadric=back.T @ surface.quadric @ back,
        clip=clip,
        grids=tuple(grid @ R.T + s for grid in surface.grids),
        wires=tuple(wire @ R.T + s for wire in surface.wires),
        rims=tuple(rim @ R.T + s for rim in surface.rims),
        within=tuple(back.T @ form @ back for form in surface.within),
    )


def about(centre: FloatArray, turns: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the rigid motions of a body that turns by ``turns`` (N, 3, 3) about a point (3,)."""
    return turns, centre - turns @ centre


def along(places: FloatArray, start: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the rigid motions of what goes from a place (D,) to others (N, D), and does not turn."""
    return np.broadcast_to(np.eye(len(start)), (*places.shape, len(start))), places - start


def riding(layers: list[Layer], path: str) -> list[Layer]:
    """Return layers that ride on a path."""
    return [replace(layer, rides=path) for layer in layers]  # type: ignore[arg-type]  # no map or region rides
