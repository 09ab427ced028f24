"""Figures of rounding errors and of roots: laws of what their snapshots leave out, since processors differ in it."""

import numpy as np
from drawing import made

from atlas import ElementaryMotion, GeneralMotion
from atlas.scene import Curve, Image, Points

FIELD, REACH, CELLS = (1.0, 0.3), 2.5, 60


def test_the_motion_map_has_the_hyperbola_and_what_is_special_on_it() -> None:
    """Its views have reach |B'| to each side of -B'; lines are elementary motions, 1e-9; rest and -2B' are marked."""
    scene = made("motion_map", field=FIELD, reach=REACH, cells=CELLS)
    half = REACH * np.hypot(*FIELD)
    bars = []
    for panel, I in zip(scene.panels, (2.0, 1.5, 1.0, 0.5), strict=True):
        assert np.allclose((panel.x_limits, panel.y_limits), [(-B - half, -B + half) for B in FIELD], rtol=1e-14)
        (image,) = (layer for layer in panel.layers if isinstance(layer, Image))
        assert image.values.shape == (CELLS, CELLS)
        assert np.nanmin(image.values) >= 0.0
        assert image.limits[1] - 10.0 < np.nanmax([one.layers[0].values for one in scene.panels]) <= image.limits[1]
        bars.append(bool(image.label))
        lines = [layer.points for layer in panel.layers if isinstance(layer, Curve) and layer.role == "map_curve"]
        assert len(lines) >= 2 * (I != 1.0) + (I == 1.0)
        for line in lines:
            omega2, omega3 = line[np.abs(line[:, 0] + FIELD[0]) > 0.05].T  # beside the pole
            if omega2.size:
                assert np.allclose(ElementaryMotion(I, FIELD, omega2).omega3, omega3, atol=1e-9 * half)
        marked = {layer.role: layer.points for layer in panel.layers if isinstance(layer, Points)}
        assert np.array_equal(marked["rest"], [[0.0, 0.0]])
        assert np.allclose(marked["special"], [[-2 * B for B in FIELD]], rtol=1e-14)
    assert bars == [False, True, False, False]


def loops(I: float, omega2: float, omega3: float) -> bool:
    """Return whether the axis goes round B' in both senses within a nutation, from the motion itself."""
    motion = GeneralMotion(I, FIELD, (0.0, omega2, omega3))
    t = np.linspace(0.0, motion.period, 801)
    up = np.array([0.0, *FIELD]) / np.hypot(*FIELD)
    axis = motion.rotation(t)[..., 2]
    turn = np.einsum("ni,ni->n", np.cross(axis[:-1], axis[1:]), np.broadcast_to(up, (800, 3)))
    return bool((turn > 0).any() and (turn < 0).any())


def test_the_dotted_edge_of_the_motion_map_is_between_loops_and_waves() -> None:
    """On one side of it, half a pixel away, the axis draws loops, on the other it does not."""
    scene = made("motion_map", field=FIELD, reach=REACH, cells=CELLS, ratios=(1.5,))
    (panel,) = scene.panels
    borders = [layer.points for layer in panel.layers if isinstance(layer, Curve) and layer.role == "map_border"]
    step = 2 * REACH * np.hypot(*FIELD) / CELLS
    assert borders
    assert min(map(len, borders)) > 8
    for line in borders:
        for i in (len(line) // 4, len(line) // 2):
            along = line[i + 2] - line[i - 2]
            across = np.array([-along[1], along[0]]) / np.hypot(*along)
            assert {loops(1.5, *(line[i] + side * step * across)) for side in (-0.6, 0.6)} == {True, False}
