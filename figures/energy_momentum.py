"""Energy-momentum map.

A symmetric top has three conserved numbers: the momentum M3 about its axis, p about the field or the vertical, and the
energy. The critical values of the map that takes a motion to them are those of the steady precessions,
theorem-top-precession; at one M3 they are curves in the plane of p and the energy. Above them lie all other motions.
"""

from dataclasses import replace
from itertools import pairwise

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.errors import DomainError
from atlas.maps.wells import Branch, Wells
from atlas.pictures import Curve, Label, Layer, Plane, Points, Region, Scene
from atlas.pictures.captions import listed, plain, tex
from atlas.pictures.sample import room

ROW = "its map"
SEEN = "Motions exist only in the shaded region; on the lines the axis precesses steadily."
WIDTH, HEIGHT = 88.0, 62.0


def scene(
    *,
    ratios: tuple[float, ...] = (0.5, 1.5),
    b: tuple[float, ...] = (1.0,),
    linear: tuple[float, ...] = (0.0,),
    M3: float = 0.25,
    reach: float = 1.6,
    unit: str = "time",
) -> Scene:
    """Draw the section M3 = const of the bifurcation diagram for each of the ``ratios``, up to |p| = ``reach`` scales.

    ``ratios`` are I3/I2; M3 and p are the momenta along the axis and the field over I2. The field ``b`` and the
    weight ``linear`` over I2 are one for all or one for each; the scale is the larger of b and the root of the
    weight. ``unit`` is the word for the unit of time.
    """
    tops = one_each(ratios, b, linear)
    alike = len(b) == 1 and not any(linear)
    top_names = [
        f"$I={tex(I)}$" + ("" if alike else f", $b={tex(field)}$, $a_0={tex(weight)}$") for I, field, weight in tops
    ]
    panels: list[Plane] = []
    for name, top in zip(top_names, tops, strict=True):
        diagram = panel(f"({'abcdef'[len(panels)]}) {name}", *top, M3, reach, unit)
        small = [layer for layer in diagram.layers if isinstance(layer, Label) and layer.role == "unstable_line"]
        layers = tuple(layer for layer in diagram.layers if layer not in small)  # the swallowtail has room for the rest
        panels += [replace(diagram, layers=layers), *swallowtail(diagram, "abcdef"[len(panels) + 1])]
    length_text = f", $b={tex(b[0])}$" if alike else ""
    drawn_roles = {getattr(layer, "role", "") for panel in panels for layer in panel.layers}
    stability_words = "stable (solid) or unstable (dashed)" if "unstable_line" in drawn_roles else "all stable (solid)"
    kinds = {"start": "stable (dots)", "unstable_point": "of focus-focus type (crosses)"}
    spins = " or ".join(words for role, words in kinds.items() if role in drawn_roles)
    return Scene(
        caption=(
            r"Lines: steady precessions, with their rate $w$ in Larmor's frame, "
            + stability_words
            + (f", and spins along the field or the vertical, {spins}." if spins else ".")
            + (" Inside a swallowtail two stable precessions share $p$." if "unstable_line" in drawn_roles else "")
            + f" $M_3={tex(M3)}${length_text}, {listed(top_names)}."
        ),
        alt=(
            f"Panels for I = {listed([plain(I) for I in ratios])} with the critical energies over p: a smooth curve, "
            "or for a long body one with a triangular fold, whose upper side is unstable; the spins along the axis are "
            "isolated points above it where they are unstable, and ends of a branch where they are stable."
        ),
        panels=tuple(panels),
        columns=min(len(panels), 3),
        spare=tuple(k for k, panel in enumerate(panels) if "swallowtail" in panel.title),
        named={
            word: role
            for word, role in {
                "shaded": "region",
                "solid": "main",
                "dashed": "unstable_line",
                "dots": "start",
                "crosses": "unstable_point",
            }.items()
            if role in drawn_roles
        },
        size=(min(WIDTH * len(panels), 178.0), HEIGHT * (1 + (len(panels) - 1) // 3)),
    )


def one_each(
    ratios: tuple[float, ...], b: tuple[float, ...], linear: tuple[float, ...]
) -> list[tuple[float, float, float]]:
    """Return a tuple (ratio I3/I2, field b, weight) for each top; a single b or weight holds for all.

    Raises DomainError for other counts, negative b, and a top with neither field nor weight.
    """
    count = len(ratios)
    if not (1 <= count <= 3 and len(b) in {1, count} and len(linear) in {1, count}):
        raise DomainError(
            f"figure energy_momentum needs 1 to 3 ratios, and one b and one weight linear for all or for each, not "
            f"{ratios}, {b} and {linear}."
        )
    tops = list(zip(ratios, b * (count // len(b)), linear * (count // len(linear)), strict=True))
    if not all(field >= 0 and (field or weight) for _, field, weight in tops):
        raise DomainError(f"figure energy_momentum needs b > 0, or b = 0 and a weight linear, not {b} and {linear}.")
    return tops


def panel(name: str, I: float, b: float, linear: float, M3: float, reach: float, unit: str) -> Plane:
    """Return the `Plane` of one top: energies 2H of its precessions over p, H in Larmor's frame and over I2.

    `name` is the title, `I` is I3/I2, `b` the field, `linear` the weight; p is drawn up to `reach` scales. `unit`
    is the word for the unit of time. Raises DomainError where no precession lies within reach.
    """
    scale = max(b, abs(linear) ** 0.5)
    wells, shift = Wells(M3, (I - 1.0) * b * b, linear), M3 * M3 / I + b * b
    branches = list(wells.precessions(3.0 * reach * scale))
    lines = [
        (run, "unstable_line" if unstable else "main") for branch in branches for run, unstable in runs(branch, shift)
    ]
    has_zero_rate = any(not branch.w.any() for branch in branches)  # w = 0 at any nu, as of a ball
    inside = np.concatenate([np.empty((0, 2)), *(line[np.abs(line[:, 0]) <= reach * scale] for line, _ in lines)])
    if not len(inside):
        raise DomainError(
            f"figure energy_momentum: with M3 = {M3:g} and b = {b:g} no steady precession at I = {I:g} has |p| below "
            f"{reach * scale:g}; give a larger reach, or an M3 nearer to {scale:g}."
        )
    spins = [(p, g + shift, D) for p, g, D in map(wells.spin, (1, -1)) if abs(p) <= reach * scale]
    inside = np.array([*inside, *(spin[:2] for spin in spins)])
    low, high = float(inside[:, 1].min()), float(inside[:, 1].max())
    high = high if high > low else low + scale * scale
    pad = 0.08 * (high - low)
    p, nu = np.linspace(-reach * scale, reach * scale, 401), np.tanh(np.linspace(-7.0, 7.0, 701))
    least = np.minimum(np.asarray(wells.potential(p[:, None], nu)).min(axis=1) + shift, high + pad)
    above = [[p[-1], high + pad], [p[0], high + pad]]
    layers: list[Layer] = [Region(np.array([*np.stack([p, least], axis=1), *above]), "region")]
    layers += [Curve(line, role) for line, role in lines]
    layers += [label for x in branches if x.w.any() for label in names(x, reach * scale, shift)]
    layers += [Label(np.array([0.0, shift]), "$w=0$", "note", (0.0, 6.0))] if has_zero_rate else []
    layers += [Points(np.array([[p, H2]]), "start" if D > 0 else "unstable_point") for p, H2, D in spins]
    spin_name = r"spin along $\mathbf{B}$" if b else "upright spin"
    layers += [Label(np.array(spin[:2]), spin_name, "note", (9, -4) if has_zero_rate else (5, 6)) for spin in spins[:1]]
    layers.append(Label(np.array([0.0, high - 0.1 * (high - low)]), "other motions", "note"))
    place = np.array([-0.95 * reach * scale, low + 0.04 * (high - low)])
    layers += [Label(place, "no motion", "note", (2.0, 0.0))] if least[0] > place[1] else []
    return Plane(
        tuple(layers),
        rf"$p$ (1/{unit})",
        rf"$2H$ (1/{unit}$^2$)",
        (-reach * scale, reach * scale),
        (low - pad, high + pad),
        title=name,
    )


def swallowtail(diagram: Plane, letter: str) -> list[Plane]:
    """Return a list of one panel, the part of `diagram` about its unstable precessions; [] where all are stable.

    `letter` is that of the panel.
    """
    curves = [layer for layer in diagram.layers if isinstance(layer, Curve)]
    folds = [curve.points for curve in curves if curve.role == "unstable_line"]
    if not folds:
        return []
    p, H2 = np.concatenate(folds).T
    x = room(p, 0.3)
    low = min(float(H2.min()), *(line[:, 1].min() for line in (fold.points for fold in curves) if len(line)))
    y = room([low, float(H2.max())], 0.3)
    ends = np.transpose([x, y])
    layers: list[Layer] = []
    for layer in diagram.layers:
        if isinstance(layer, Label):
            places = np.atleast_2d(layer.at)
            inside = places[((places > ends[0]) & (places < ends[1])).all(axis=1)]
            layers += [replace(layer, at=inside)] if len(inside) else []
        else:
            layers.append(layer)
    title = f"({letter}) swallowtail of {diagram.title.partition(' ')[0]}"
    return [replace(diagram, layers=tuple(layers), x_limits=x, y_limits=y, title=title)]


def names(branch: Branch, reach: float, shift: float) -> list[Layer]:
    """Return labels at the visible parts of a curve: "unstable", and the sign of the rate w at stable parts.

    w is the rate of precession in Larmor's frame. `reach` is the limit of |p|, `shift` is added to the energy g to
    give 2H.
    """
    w, stable, is_visible = np.asarray(branch.w), np.asarray(branch.stable) >= 0, np.abs(branch.p) <= 0.75 * reach
    order = np.argsort(-branch.g, kind="stable")
    points = np.stack([branch.p, branch.g + shift], axis=1)
    kinds = (
        ("$w<0$", "note", stable & (w < 0), (-6.0, 0.0), 1),
        ("$w>0$", "note", stable & (w > 0), (6.0, 0.0), 1),
        ("unstable", "unstable_line", ~stable, (0.0, 5.0), -1),
    )
    return [
        Label(points[order[(is_kind & is_visible)[order]]][::step][:40:10], text, role, offset)
        for text, role, is_kind, offset, step in kinds
        if (is_kind & is_visible).any()
    ]


def runs(branch: Branch, shift: float) -> list[tuple[FloatArray, bool]]:
    """Return pairs (piece (N, 2) of the curve (p, 2H), whether unstable), cut where stability changes.

    `shift` is added to the energy g of the branch to give 2H.
    """
    unstable = np.asarray(branch.stable) < 0
    points = np.stack([branch.p, branch.g + shift], axis=1)
    cuts = np.flatnonzero(np.diff(unstable)) + 1
    edges = [0, *cuts.tolist(), len(points)]
    return [(points[a : b + 1], bool(unstable[a])) for a, b in pairwise(edges)]
