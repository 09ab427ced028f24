"""Energy-momentum map.

A symmetric body has three conserved numbers: the momentum M3 about its axis, p about the field, and the energy h. The
critical values of the map that takes a motion to them are those of the steady precessions, theorem-steady; at one M3
they are curves in the plane (p, h). Above them lie all other motions.
"""

from itertools import pairwise

import numpy as np

from atlas.core.inputs import FloatArray
from atlas.core.momentum_map import Branch, axis_spin, section
from atlas.errors import DomainError
from atlas.scene import Curve, Label, Layer, Plane, Points, Scene
from atlas.scene.words import listed, plain, tex, title

WIDTH, HEIGHT = 178.0, 78.0


def scene(
    *,
    ratios: tuple[float, ...] = (0.5, 1.5),
    b: float = 1.0,
    M3: float = 0.25,
    reach: float = 1.6,
    unit: str = "time",
) -> Scene:
    """Draw the section M3 = const of the bifurcation diagram for each of the ``ratios``, up to |p| = ``reach`` b."""
    if not (b > 0 and 1 <= len(ratios) <= 3):
        raise DomainError(f"figure energy_momentum needs b > 0 and 1 to 3 ratios, not b = {b} and {ratios}.")
    panels = tuple(
        panel(f"({letter}) $I={tex(I)}$", I, b, M3, reach, unit) for letter, I in zip("abc", ratios, strict=False)
    )
    return Scene(
        title=title(__doc__),
        caption=(
            rf"Critical values of the energy $2H$ over the momentum $p$ about the field, at $M_3={tex(M3)}$ and "
            rf"$b={tex(b)}$, for {listed([f'$I={tex(I)}$' for I in ratios])}: steady precessions, stable (solid) or "
            r"unstable (dashed), and spins about the field (dots). Inside the swallowtail two stable precessions share "
            r"$p$."
        ),
        alt=(
            f"Panels for I = {listed([plain(I) for I in ratios])} with the critical energies over p: for the long body "
            "a curve with a triangular fold, whose upper side is unstable; for the short one a smooth curve."
        ),
        panels=panels,
        columns=len(panels),
        named={"solid": "main", "dashed": "unstable_line", "dots": "special"},
        size=(WIDTH, HEIGHT),
    )


def panel(name: str, I: float, b: float, M3: float, reach: float, unit: str) -> Plane:
    """Return the curves of one body."""
    branches = section(I, b, M3, reach=3.0 * reach)
    ends = [axis_spin(I, b, M3, end) for end in (1, -1)]
    lines = [(part, "unstable_line" if unstable else "main") for one in branches for part, unstable in runs(one)]
    near = np.concatenate([np.empty((0, 2)), *(line[np.abs(line[:, 0]) <= reach * b] for line, _ in lines)])
    if not len(near):
        raise DomainError(
            f"figure energy_momentum: with M3 = {M3:g} and b = {b:g} no steady precession at I = {I:g} has |p| below "
            f"reach b = {reach * b:g}; give a larger reach, or an M3 nearer to b."
        )
    low, high = float(near[:, 1].min()), float(near[:, 1].max())
    pad = 0.08 * (high - low)
    layers: list[Layer] = [Curve(line, role) for line, role in lines]
    for spin, D in ends:
        layers.append(Points(np.array([[float(spin.p), float(spin.h)]]), "start" if D > 0 else "special"))
    layers.append(
        Label(np.array([float(ends[0][0].p), float(ends[0][0].h)]), r"spin along $\mathbf{B}$", "note", (5, 6))
    )
    return Plane(
        tuple(layers),
        rf"$p$ (1/{unit})",
        rf"$2H$ (1/{unit}$^2$)",
        (-reach * b, reach * b),
        (low - pad, high + pad),
        title=name,
    )


def runs(branch: Branch) -> list[tuple[FloatArray, bool]]:
    """Return the pieces (N, 2) of a curve (p, h) that are stable or unstable throughout, each with whether unstable."""
    unstable = np.asarray(branch.stable) < 0
    points = np.stack([branch.p, branch.h], axis=1)
    cuts = np.flatnonzero(np.diff(unstable)) + 1
    edges = [0, *cuts.tolist(), len(points)]
    return [(points[a : b + 1], bool(unstable[a])) for a, b in pairwise(edges)]
