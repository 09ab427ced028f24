"""Map of all motions that start in the plane of axis and field.

How far the axis of the body nods, the difference between the largest and the least angle to the field, over the initial
angular velocity (0, omega2, omega3). The map is zero on the hyperbola mf72 alone; its jumps are separatrices.
"""

import numpy as np
from contourpy import contour_generator

from atlas.core.inputs import FloatArray
from atlas.core.kind_map import trace_map, turning_points
from atlas.errors import DomainError
from atlas.scene import Curve, Image, Layer, Plane, Points, Scene
from atlas.scene.hyperbola_plane import Window, branches, places
from atlas.scene.words import body_name, listed, tex, tex_vector, title

WIDTH, HEIGHT, PANEL = 178.0, 144.0, 60.0


def scene(
    *,
    ratios: tuple[float, ...] = (2.0, 1.5, 1.0, 0.5),
    field: tuple[float, float] = (1.0, 0.3),
    reach: float = 3.0,
    cells: int = 240,
    unit: str = "time",
) -> Scene:
    """Draw the map for each of the ``ratios`` with ``cells`` by ``cells`` initial velocities."""
    if not (all(field) and 1 <= len(ratios) <= 4 and 2 <= cells <= 2000):
        raise DomainError(
            f"figure motion_map needs B2, B3 not zero, 1 to 4 ratios and 2 to 2000 cells, not field = {field}, "
            f"{ratios}, cells = {cells}."
        )
    panels = tuple(
        panel(f"({letter}) {body_name(I)}, $I={tex(I)}$", I, field, reach, cells, unit)
        for letter, I in zip("abcd", ratios, strict=False)
    )
    return Scene(
        title=title(__doc__),
        caption=(
            r"The amplitude of the nutation, the difference between the largest and the least angle of $\mathbf{R}_3$ "
            r"and $\mathbf{B}$, over the initial angular velocity $(0,\omega_2,\omega_3)$ in the field "
            rf"$\mathbf{{B}}'={tex_vector((0.0, *field))}$. It vanishes on the hyperbola (white) alone, which is all "
            r"that the paper solves; open dot: rest, diamond: $-2\mathbf{B}'$. Between the dotted lines the trace of "
            r"the axis makes loops, outside it waves; one of them is $\omega_2=0$, where it has cusps. For the long "
            "solenoid the map jumps: there are the separatrices, and they meet the hyperbola where it is unstable."
        ),
        alt=(
            f"Maps of the amplitude of nutation for I = {listed([f'{I:g}' for I in ratios])} over omega 2 and omega 3, "
            "dark along the two branches of the hyperbola; for the smallest I with sharp steps."
        ),
        panels=panels,
        columns=2,
        size=(WIDTH, HEIGHT),
    )


def panel(name: str, I: float, field: tuple[float, float], reach: float, cells: int, unit: str) -> Plane:
    """Return the map of one body."""
    half = reach * float(np.hypot(*field))
    x = np.linspace(-field[0] - half, -field[0] + half, cells + 1)
    y = np.linspace(-field[1] - half, -field[1] + half, cells + 1)
    middle = (x[1:] + x[:-1]) / 2, (y[1:] + y[:-1]) / 2
    second, third = np.meshgrid(*middle)
    omega = np.stack([np.zeros_like(second), second, third], axis=-1)
    low, high, _ = turning_points(I, field, omega)
    swing = np.degrees(np.arccos(low) - np.arccos(high))
    looping = (trace_map(I, field, omega) == 2).astype(float)
    view = Window((float(x[0]), float(x[-1])), (float(y[0]), float(y[-1])))
    layers: list[Layer] = [Image(x, y, swing, "amplitude (degrees)", limits=(0.0, 150.0))]
    layers += [Curve(line, "map_border") for line in edges(*middle, looping)]
    layers += [Curve(line, "map_curve") for line in branches(I, field, view, (PANEL, PANEL))]
    layers += [Points(np.array([place.at]), place.role) for place in places(I, field) if place.role != "point"]
    return Plane(
        tuple(layers),
        rf"$\omega_2$ (1/{unit})",
        rf"$\omega_3$ (1/{unit})",
        view.x,
        view.y,
        equal=True,
        title=name,
    )


def edges(x: FloatArray, y: FloatArray, inside: FloatArray) -> list[FloatArray]:
    """Return the borders, each (N, 2), between the cells where ``inside`` is 1 and those where it is 0."""
    lines = contour_generator(x, y, inside).lines(0.5)
    return [np.asarray(line) for line in lines if len(line) > 8]
