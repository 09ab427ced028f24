"""Monodromy of a heavy top and of a charged disk.

A motion with given momenta p, M3 and energy g comes back after a lattice of turns and times, atlas.maps.monodromy.
Followed once round the value of an unstable spin about the field or the vertical, the lattice comes back, but its basis
does not, theorem-residue.
"""

from typing import Any

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.errors import DomainError
from atlas.maps.monodromy import Monodromy, around, on_loop
from atlas.maps.wells import Wells
from atlas.pictures import Arrow, Curve, Label, Layer, Plane, Points, Scene
from atlas.pictures.captions import plain, tex
from atlas.pictures.sample import room

ROW = "its map"
SEEN = "Carried round an unstable spin, one of the periods comes back as another."
WIDTH, HEIGHT = 178.0, 122.0
RANGES = {"points": (24, 200)}
LOOP_POINTS = 480
"""Points of a drawn line through the points of a loop, by the Fourier series of the latter."""


def scene(*, ratio: float = 1.5, M3: float = 0.5, b: float = 1.0, points: int = 40, unit: str = "time") -> Scene:
    """Draw loops of ``points`` points round one spin of a heavy top, one of a disk, and both of a disk with M3 = 0.

    ``ratio`` is I3/I2, ``M3`` the momentum along the axis over I2, ``b`` the field, in 1/time; the weight of the
    heavy top, over I2, is b^2. ``unit`` is the word for the unit of time. Raises DomainError unless 1 < ratio <= 2,
    b > 0 and the spin is unstable.
    """
    if not (1 < ratio <= 2 and b > 0 and 0 < M3 * M3 < 4 * (ratio - 1) * b * b):
        raise DomainError(
            "figure monodromy needs a disk, 1 < ratio <= 2, in a field b > 0, and M3 with 0 < M3^2 < 4 (I-1) b^2, so "
            f"that its spin about the field is unstable, not ratio = {ratio}, b = {b}, M3 = {M3}."
        )
    disk, A = (b, ratio * b), (ratio - 1) * b * b
    cases: list[tuple[str, Any, Any]] = [
        ("heavy top", Wells(M3, 0.0, b * b), {"coupling": (0.0, 0.0), "linear": b * b}),
        ("disk", Wells(M3, A), {"coupling": disk}),
        ("disk, $M_3=0$", Wells(0.0, A), {"coupling": disk}),
    ]
    loops = [on_loop(ratio, M3=w.M3, loop=around(w, w.M3, points), **top) for _, w, top in cases]
    maps = [values(f"({'abc'[k]}) {cases[k][0]}", cases[k][1], loops[k], k == 0, unit) for k in range(3)]
    lattices = [lattice(f"({'def'[k]}) {words(loops[k])}", loops[k], k == 0) for k in range(3)]
    error = max(loop.step for loop in loops)
    return Scene(
        caption=(
            rf"Above: least energies (solid) for $I={tex(ratio)}$, $M_3={tex(M3)}$ and 0, and loops round "
            rf"crosses; $a_0={tex(b * b)}$ in (a), $b={tex(b)}$ in (b, c). Below: the angles of the periods, "
            "and their paths as the loop is followed (lines), "
            rf"$\mathbf{{g}}_3$ heavy. Largest step {error:.2g} of a turn."
        ),
        alt=(
            "Three diagrams with a loop round one or two isolated critical values, and three lattices of points, in "
            f"which a line leads from a point to another one: {', '.join(plain_words(loop) for loop in loops)}."
        ),
        panels=(*maps, *lattices),
        columns=3,
        named={
            "solid": "main",
            "crosses": "unstable_point",
            "lines": "fine_trajectory",
            "heavy": "trajectory",
        },
        spare=(1, 2, 4, 5),
        size=(WIDTH, HEIGHT),
    )


def words(loop: Monodromy) -> str:
    """Return the image of the period g3 after the loop as TeX, for a title: g3 -> g3 + m g1 + n g2.

    g1 and g2 are one turn about n and one about the axis, g3 is one nutation with its turns undone.
    """
    terms = ""
    for number, name in zip(loop.matrix[2], ("g_1", "g_2"), strict=False):
        if number:
            size = "" if abs(number) == 1 else f"{abs(number)}"
            terms += rf"{'-' if number < 0 else '+'}{size}\mathbf{{{name[0]}}}_{name[2]}"
    return rf"$\mathbf{{g}}_3\to\mathbf{{g}}_3{terms}$"


def plain_words(loop: Monodromy) -> str:
    """Return the image of the period g3 after the loop, for a sentence without TeX."""
    m, n, _ = loop.matrix[2]
    return f"g3 comes back as g3 with {plain(m)} of g1 and {plain(n)} of g2"


def values(name: str, wells: Wells, loop: Monodromy, is_first: bool, unit: str) -> Plane:
    """Return a `Plane` of the critical values (p, g) at one M3, with the loop about them.

    p is the momentum along the field, g the energy; the curves are those of `wells`. `name` is the title; the first
    panel has names and the label of its vertical axis; `unit` is the word for the unit of time.
    """
    ends = np.array([[p, g] for p, g, D in (wells.spin(end) for end in (1, -1)) if D < 0])
    p_limit = 1.25 * max(float(np.abs(loop.p).max()), float(np.abs(ends[:, 0]).max()))
    lines = [
        np.stack([x.p, x.g], axis=1) for x in wells.precessions(4 * p_limit + 4 * np.sqrt(abs(wells.A) + abs(wells.a)))
    ]
    inside = np.concatenate([line[np.abs(line[:, 0]) <= p_limit] for line in lines])
    low, high = float(inside[:, 1].min()), float(loop.g.max())
    layers: list[Layer] = [
        *(Curve(line, "main") for line in lines),
        Curve(smooth(np.stack([loop.p, loop.g], axis=1)), "trajectory"),
        Points(ends, "unstable_point", "spin" if is_first else ""),
        *([Label(np.array([0.4 * p_limit, low]), "no motion", "note")] if is_first else []),
        Points(np.array([[loop.p[0], loop.g[0]]]), "start"),
    ]
    y_label = f"$g$ (1/{unit}$^2$)" if is_first else ""
    return Plane(tuple(layers), f"$p$ (1/{unit})", y_label, (-p_limit, p_limit), room((low, high), 0.1), title=name)


def smooth(points: FloatArray) -> FloatArray:
    """Return a smooth closed line through `points` (M, 2), of `LOOP_POINTS` + 1 points, by Fourier series.

    The last of `points` is the first plus a constant step, which the line has too.
    """
    count = len(points) - 1
    drift = np.outer(np.arange(count) / count, points[-1] - points[0])
    waves = np.fft.rfft(points[:-1] - drift, axis=0)
    samples = np.fft.irfft(waves, LOOP_POINTS, axis=0) * (LOOP_POINTS / count)
    samples += np.outer(np.arange(LOOP_POINTS) / LOOP_POINTS, points[-1] - points[0])
    return np.concatenate([samples, samples[:1] + points[-1] - points[0]])


def lattice(name: str, loop: Monodromy, is_first: bool) -> Plane:
    """Return a `Plane` of the lattice of periods, with one nutation each, in turns, and the path of g3 in the loop.

    `name` is the title; the first panel has the label of its vertical axis.
    """
    track = smooth(-loop.turns)
    start, end = track[0], track[-1]
    middle, half = (track.min(axis=0) + track.max(axis=0)) / 2, 0.5 * float(np.ptp(track, axis=0).max()) + 0.7
    steps = np.arange(-4, 5)
    corners = start + np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2)
    grid = corners[(np.abs(corners - middle) <= half).all(axis=1)]
    ways = [track + corner - start for corner in corners]
    layers: list[Layer] = [
        *(Curve(way, "fine_trajectory") for way in ways if (np.abs(way - middle) <= half).all(axis=1).any()),
        Points(grid, "sample"),
        Curve(track, "trajectory"),
        Arrow(start, end, "component"),
        Points(track[:1], "start", r"$\mathbf{g}_3$"),
    ]
    integers = {tuple(np.rint(point - start)) for point in grid}
    corner = next((m, n) for m, n in sorted(integers) if {(m + 1, n), (m, n + 1)} <= integers) + start
    layers += [Arrow(corner, corner + np.eye(2)[i], "basis", rf"$\mathbf{{g}}_{i + 1}$") for i in range(2)]
    return Plane(
        tuple(layers),
        r"turns about $\mathbf{n}$",
        "turns about the axis" if is_first else "",
        (float(middle[0] - half), float(middle[0] + half)),
        (float(middle[1] - half), float(middle[1] + half)),
        equal=True,
        title=name,
    )
