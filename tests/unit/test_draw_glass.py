"""Glass without depth peeling against rays: each pixel's quadratics are solved, its hits sorted and blended."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from drawing import draw
from numpy.typing import NDArray

from atlas import gl
from atlas.pictures import Scene, Space, Surface, recipes, solids
from atlas.pictures.drawing import space
from atlas.pictures.drawing.glass import cut, distinct_forms, places
from atlas.pictures.drawing.view import View, fit
from atlas.pictures.style import style

FloatArray = NDArray[np.float64]

E1, E2, E3 = np.eye(3)
O = np.zeros(3)
FINE = 1e-3
LAMPS = [((-0.55, 0.75, 0.9), 0.9), ((0.9, 0.15, 0.8), 0.26), ((0.1, 1.0, -0.5), 0.25), ((0.0, -0.35, 1.0), 0.2)]


def bare(surface: Surface) -> Surface:
    """Return a surface without the lines on it."""
    return replace(surface, wires=(), rims=(), label="")


def surfaces_of(name: str, **parameters: Any) -> list[Surface]:
    """Return the surfaces of a figure."""
    return [x for x in recipes.load(name).scene(**parameters).panels[0].layers if isinstance(x, Surface)]


def hits(surface: Surface, eye: FloatArray, towards: FloatArray) -> list[FloatArray]:
    """Return where the rays eye + t towards meet a surface: t (2, ...), not a number where they do not."""
    Q, d = surface.quadric, towards
    A = d @ Q[:3, :3] @ d
    B = 2.0 * (eye @ Q[:3, :3] @ d + Q[:3, 3] @ d)
    F = np.einsum("...i,ij,...j->...", eye, Q[:3, :3], eye) + 2.0 * eye @ Q[:3, 3] + Q[3, 3]
    with np.errstate(all="ignore"):
        half = -0.5 * (B + np.copysign(np.sqrt(B * B - 4.0 * A * F), B))
        roots = [half / A if abs(A) > 1e-9 else np.full_like(F, np.nan), F / half]
        for k, t in enumerate(roots):
            x = eye + t[..., None] * d
            inside = np.isfinite(t)
            for *n, distance in surface.clip:
                inside &= x @ np.array(n) <= distance + 1e-9
            for W in surface.within:
                homogeneous = np.concatenate([x, np.ones((*x.shape[:-1], 1))], axis=-1)
                inside &= np.einsum("...i,ij,...j->...", homogeneous, W, homogeneous) <= 0.0
            roots[k] = np.where(inside, t, np.nan)
    return roots


def colours(
    surface: Surface, x: FloatArray, view: View, focus: FloatArray
) -> tuple[FloatArray, FloatArray, NDArray[np.bool_]]:
    """Return the light (..., 3) from points of a surface, how dense it is there, and whether its outer side is seen."""
    look = style(surface.role)
    gradient = x @ surface.quadric[:3, :3] + surface.quadric[:3, 3]
    n = gradient / np.linalg.norm(gradient, axis=-1, keepdims=True)
    outer = n @ view.towards > 0.0
    n = np.where(outer[..., None], n, -n)
    front, back = (np.array([int(c[i : i + 2], 16) for i in (1, 3, 5)]) / 255.0 for c in (look.colour, look.back))
    tint = np.where(outer[..., None], front, back)
    dense = look.glass + (0.94 - look.glass) * (1.0 - np.abs(n @ view.towards)) ** 2.2
    light = 0.66 * tint
    seen_from = focus + 4.0 * view.towards - x
    seen_from /= np.linalg.norm(seen_from, axis=-1, keepdims=True)
    for place, strength in LAMPS:
        way = np.array(place) @ view.frame
        way /= np.linalg.norm(way)
        cosine = n @ way
        mirrored = 2.0 * cosine[..., None] * n - way
        shine = np.where(cosine > 0.0, np.maximum(np.sum(mirrored * seen_from, axis=-1), 1e-5) ** 40.0, 0.0)
        light = light + strength * 0.46 * np.maximum(cosine, 0.0)[..., None] * tint
        light = light + strength * 0.28 * shine[..., None] * np.ones(3)
    return light, dense, outer


def traced(view: View, width: int, height: int, dpi: float) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
    """Return the picture (height, width, 3) by rays through the middles of the pixels, and which are on no edge.

    On an edge are those that see other hits, sides of them or another order than some pixel next to them.
    """
    columns, rows = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
    paper = np.stack([columns, height - rows], axis=-1) * 72.0 / dpi
    eye = (paper - view.shift) / view.scale @ view.frame[:2]
    middle = (0.5 * np.array([width, height]) * 72.0 / dpi - view.shift) / view.scale @ view.frame[:2]
    times, light, dense, sides = [], [], [], []
    for surface in view.surfaces:
        for t in hits(surface, eye, view.towards):
            here = np.where(np.isfinite(t), t, 0.0)
            glow, opacity, outer = colours(surface, eye + here[..., None] * view.towards, view, middle)
            times.append(np.where(np.isfinite(t), t, -np.inf))
            light.append(glow)
            sides.append(outer)
            dense.append(np.where(np.isfinite(t), opacity, 0.0))
    order = np.argsort(np.array(times), axis=0)
    picture = np.ones((height, width, 3))
    inner = np.ones((height, width), dtype=bool)
    for k in order:
        pick = (k, *np.indices(k.shape))
        labels = np.where(np.isfinite(np.array(times)[pick]), 2 * k + np.array(sides)[pick], -1)
        for shift in ((0, 1), (0, -1), (1, 0), (-1, 0), (1, 1), (1, -1), (-1, 1), (-1, -1)):
            inner &= labels == np.roll(labels, shift, axis=(0, 1))
        opacity = np.array(dense)[pick][..., None]
        picture = np.minimum(np.array(light)[pick], 1.0) * opacity + (1.0 - opacity) * picture
    return np.round(255.0 * picture).astype(int), inner


SHEETS = ("quadric", {"ratio": 0.5, "field": (1.0, 1.0)})
GLASS: dict[str, tuple[Callable[[], list[Surface]], float, float]] = {
    "a ball along its axis": (lambda: [solids.sphere(O, 1.0, FINE)], 0.0, 90.0),
    "a ball from the side": (lambda: [solids.sphere(O, 1.0, FINE, role="ball")], 20.0, 15.0),
    "a hyperboloid of one sheet from the side": (
        lambda: surfaces_of("quadric", ratio=0.5, field=(1.0, 0.5)),
        20.0,
        15.0,
    ),
    "a hyperboloid of one sheet from within": (lambda: surfaces_of(SHEETS[0], **SHEETS[1]), 90.0, 63.0),
    "both sheets of a hyperboloid": (lambda: surfaces_of("quadric"), 20.0, 15.0),
    "both sheets of a hyperboloid, the one before the other": (lambda: surfaces_of("quadric"), 90.0, 58.0),
    "a cone": (lambda: surfaces_of("cone"), 25.0, 14.0),
    "a cone along its asymptote": (lambda: surfaces_of("cone", field=(1.0, 1.0)), 90.0, 45.0),
    "two sheets of a loop": (lambda: surfaces_of("quadric", ratio=2.0), 25.0, 14.0),
    "the same from below": (lambda: surfaces_of("quadric", ratio=2.0), -60.0, -35.0),
    "two planes": (lambda: surfaces_of("quadric", field=(1.0, 0.0)), 25.0, 14.0),
    "a cone in a ball": (lambda: surfaces_of("motion_sphere"), 25.0, 18.0),
    "a cone in a ball, from behind": (lambda: surfaces_of("motion_sphere"), 200.0, -30.0),
    "two balls that meet": (
        lambda: [solids.sphere(O, 1.0, FINE), solids.sphere(np.array([0.3, 0.9, 0.4]), 0.8, FINE, role="ball")],
        35.0,
        20.0,
    ),
    "a ball through a plane and through a cylinder": (
        lambda: [
            solids.sphere(O, 1.0, FINE),
            solids.rectangle(0.2 * E3, 1.6 * E1, 1.4 * E2, role="plane"),
            solids.cylinder(O, E3, 0.7, 2.6, FINE),
        ],
        35.0,
        20.0,
    ),
    "a shell with its lids": (
        lambda: [
            solids.cylinder(O, E3, 1.0, 1.5, FINE),
            solids.disk(0.75 * E3, E3, 1.0, FINE),
            solids.disk(-0.75 * E3, -E3, 1.0, FINE),
        ],
        20.0,
        25.0,
    ),
}


@pytest.mark.skipif(gl.library() is None, reason="no GL library can draw off-screen here")
@pytest.mark.parametrize(
    "case", [pytest.param(case, marks=[pytest.mark.slow] * (k % 2)) for k, case in enumerate(GLASS)]
)
def test_glass_agrees_with_sorted_rays(case: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Away from edges at most one pixel in 5000 is more than three grey levels from the exact picture."""
    make, azimuth, elevation = GLASS[case]
    views = []
    monkeypatch.setattr(space, "fit", lambda *words: views.append(fit(*words)) or views[-1])
    panel = Space(tuple(bare(surface) for surface in make()), azimuth=azimuth, elevation=elevation)
    draw(Scene("t", "c", "a", (panel,), size=(60.0, 60.0)), tmp_path / "a.png", renderer="shaded", dpi=150.0)
    from matplotlib.image import imread

    pixels = np.round(255.0 * imread(tmp_path / "a.png")[..., :3]).astype(int)
    exact, inner = traced(views[0], pixels.shape[1], pixels.shape[0], 150.0)
    inner &= (exact < 255).any(axis=2)
    away = np.abs(pixels - exact).max(axis=2)[inner]
    assert inner.mean() > 0.04
    assert (away > 3).mean() < 1.0 / 5000.0
    assert away.mean() < 1.0


@pytest.mark.slow
@pytest.mark.skipif(gl.library() is None, reason="no GL library can draw off-screen here")
@pytest.mark.parametrize("dpi", [100.0, 300.0, 900.0])
@pytest.mark.parametrize("slope", [0.0, 0.3, 1.0])
def test_a_wire_covers_as_much_as_its_style_says(dpi: float, slope: float, tmp_path: Path) -> None:
    """Across a wire on a pane, thinner than a pixel or wider, the ink adds up to its width, in its unlit colour.

    Within an eighth: a pixel has four samples, which all are as dark as its middle, or not covered.
    """
    pane = replace(solids.rectangle(O, E2, E3, role="plane"), rims=())
    wire = np.array([[0.0, -0.7, -0.7 * slope], [0.0, 0.7, 0.7 * slope]])
    pictures = []
    for wires in ((), (wire,)):
        panel = Space((replace(pane, wires=wires),), azimuth=0.0, elevation=0.0)
        draw(Scene("t", "c", "a", (panel,), size=(25.4, 25.4)), tmp_path / "a.png", renderer="shaded", dpi=dpi)
        from matplotlib.image import imread

        pictures.append(255.0 * imread(tmp_path / "a.png")[..., :3].astype(float))
    middle = pictures[0].shape[1] // 2
    look = style("wire")
    pale = pictures[0][middle, middle]
    ink_full = pale - [int(look.colour[i : i + 2], 16) for i in (1, 3, 5)]
    columns = slice(middle - middle // 3, middle + middle // 3)
    ink = (pictures[0] - pictures[1])[:, columns].sum(axis=0).mean(axis=0)
    width = look.tube * dpi / 72.0 * np.hypot(1.0, slope)
    assert ink == pytest.approx(width * ink_full, rel=0.125)


def random_quadrics(rng: np.random.Generator, count: int) -> list[FloatArray]:
    """Return quadrics and planes through the middle of things, the largest coefficient one."""
    forms = []
    for k in range(count):
        Q = rng.normal(size=(4, 4))
        Q = Q + Q.T
        if k % 3 == 2:
            Q[:3, :3] = 0.0
        Q[3, 3] *= 0.1
        forms.append(Q / np.abs(Q).max())
    return forms


@pytest.mark.parametrize("seed", range(10))
def test_hits_of_every_ray_are_in_order_of_distance(seed: int) -> None:
    """For any quadrics and any eye, with a second-order term along the ray of either sign, or of none."""
    rng = np.random.default_rng(seed)
    forms = random_quadrics(rng, 4)
    towards = rng.normal(size=3)
    towards /= np.linalg.norm(towards)
    if seed % 4 == 0:  # along an asymptote of the first
        values, axes = np.linalg.eigh(np.diag([1.0, 0.7, -0.4]))
        forms[0] = np.diag([1.0, 0.7, -0.4, 0.2])
        towards = axes @ np.where(values > 0.7, np.sqrt(0.4), np.where(values < 0.0, 1.0, 0.0))
        towards /= np.linalg.norm(towards)
    eye = rng.uniform(-1.0, 1.0, size=(400, 3))
    when, rays, rank = [], [], []
    for index, form in enumerate(forms):
        for t in hits(Surface(form, np.empty((0, 4)), ()), eye, towards):
            is_hit = np.abs(t) < 50.0
            x = eye[is_hit] + t[is_hit, None] * towards
            rank.append(places(np.repeat(x[:, None], 3, axis=1), forms, index, towards))
            when.append(t[is_hit])
            rays.append(np.flatnonzero(is_hit))
    ray, t, place = (np.concatenate(column) for column in (rays, when, rank))
    assert len(ray) > 800
    order = np.lexsort((t, ray))
    same = np.diff(ray[order]) == 0
    is_apart = np.diff(t[order]) > 1e-7
    assert (np.diff(place[order])[same & is_apart] > 0.0).all()


def area(corners: FloatArray) -> float:
    """Return the area of triangles (T, 3, K)."""
    x = corners[..., :3]
    return float(0.5 * np.linalg.norm(np.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0]), axis=1).sum())


def test_a_cut_keeps_the_area_and_leaves_no_triangle_across() -> None:
    """Triangles of a plane are cut by a ball and by the plane of its outline, none is across, and their area stays."""
    rng = np.random.default_rng(1)
    corners = np.concatenate([rng.uniform(-1.0, 1.0, size=(500, 3, 2)), np.full((500, 3, 1), 0.2)], axis=2)
    plane, ball = np.zeros((4, 4)), np.diag([1.0, 1.0, 1.0, -0.5])
    plane[2, 3] = plane[3, 2] = 0.5
    plane[3, 3] = -0.2
    towards = np.array([0.48, 0.6, 0.64])
    pieces = cut(corners, [plane, ball], 0, towards)
    assert len(pieces) > 1.3 * len(corners)
    assert area(pieces) == pytest.approx(area(corners), rel=1e-12)
    for height in (np.sum(pieces * pieces, axis=2) - 0.5, pieces @ towards):
        assert not ((height > 1e-9).any(axis=1) & (height < -1e-9).any(axis=1)).any()


def test_equal_quadrics_count_once() -> None:
    """Both sheets of a hyperboloid are one quadric."""
    forms, numbers = distinct_forms(surfaces_of("quadric"))
    assert (len(forms), numbers) == (1, [0, 0])
