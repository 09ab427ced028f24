"""An elementary motion.

The body precesses about the field with the frequency k, mf84, while it turns about its third axis with the frequency
phi, mf77: the trace of that axis on the unit sphere, mf89; Omega(t), mf78; m(t), mf93; and how well the invariants mf44
to mf49 and (m, B') stay what they are in the numbers that are drawn.
"""

from typing import Any

import numpy as np

from atlas.core.elementary import ElementaryMotion
from atlas.core.inputs import positive
from atlas.core.integrals import shape_factors
from atlas.scene import Arrow, Curve, Label, Layer, Plane, Points, Scene, Space
from atlas.scene.sample import curve, quarter_pixel
from atlas.scene.solids import cone, sphere
from atlas.scene.words import plain, plain_setting, tex, tex_equals, tex_setting, title

WIDTH, HEIGHT, MARGIN = 178.0, 140.0, 10.0
FEW = 25.0
LONG = 1e8
"""The last panel goes on for so many units of the others' time."""


def scene(
    *,
    ratio: float = 1.5,
    field: tuple[float, float] = (1.0, 2.0),
    omega2: float = 0.7,
    omega3: float | None = None,
    turns: float = 2.0,
    unit: str = "time",
) -> Scene:
    """Draw the motion for ``turns`` periods of its precession; ``omega3`` is given only where mf76 leaves it free."""
    motion = ElementaryMotion(ratio, field, omega2, omega3)
    turns = positive(turns, "turns")
    k, phi = abs(motion.k), abs(motion.phi)
    slow = 2 * np.pi * turns / (k or phi) if k or phi else 1.0
    # no more than FEW proper rotations: beyond, Omega(t) would be all ink
    stop = min(slow, 2 * np.pi * FEW / phi) if phi else slow
    free = not any(motion.field)
    axis = r"$\mathbf{m}$" if free else r"$\mathbf{B}$"
    along = "" if free else r"; dashed: its projection on the field, which is constant"
    turning = rf"The trace of the third inertia axis on the unit sphere and the cone of its precession about {axis}."
    return Scene(
        title=title(__doc__),
        caption=(
            rf"The elementary motion of {tex_setting(ratio, field)} from "
            rf"$\boldsymbol{{\omega}}=(0,\omega_2,\omega_3)$ with $\omega_2={tex(motion.omega2)}$, "
            rf"$\omega_3{tex_equals(motion.omega3)}$: {motion.case}, $k{tex_equals(motion.k)}$, "
            rf"$\phi{tex_equals(motion.phi)}$. "
            rf"(a) {turning if motion.k else 'The third inertia axis, which does not move.'} "
            r"(b) The angular velocity in the body. "
            rf"(c) The angular momentum in the laboratory, divided by $I_2$, mf93{along}. "
            r"(d) The largest change so far of each invariant as it is computed, as a part of the sum of the sizes of "
            r"its "
            r"terms, over a much longer time."
        ),
        alt=(
            f"Four panels for the elementary motion of {plain_setting(ratio, field)} from the angular velocity "
            f"(0, {plain(motion.omega2)}, {plain(motion.omega3)}), {motion.case}: "
            + (
                "the trace of the third axis on a sphere, a circle about "
                + ("the angular momentum; " if free else "the field; ")
                if motion.k
                else "the third axis on a sphere, which does not move; "
            )
            + "the three components of the angular velocity over time, the third constant; those of the angular "
            "momentum; and the changes of the five invariants, rounding errors that do not grow with time."
        ),
        panels=(
            trace(motion),
            velocity(motion, stop, unit),
            momentum(motion, slow, unit),
            residuals(motion, stop, unit),
        ),
        columns=2,
        size=(WIDTH, HEIGHT),
    )


def trace(motion: ElementaryMotion) -> Space:
    """Panel (a): the sphere, the field, the cone of precession and the trace of the third axis."""
    origin, up = np.zeros(3), np.array([0.0, 0.0, 1.0])
    free = not any(motion.field)
    axis = motion.angular_momentum(0.0) if free else np.array([0.0, *motion.field])
    size = quarter_pixel(2.6, HEIGHT / 2)
    layers: list[Layer] = [sphere(origin, 1.0, size)]
    if axis.any():
        along = axis / np.linalg.norm(axis)
        if abs(along[2]) < 1 and motion.k:
            middle = along * np.copysign(1.0, along[2])
            layers.append(cone(origin, middle, float(np.arccos(middle[2])), 1.0, size))
        name, role = (r"$\mathbf{m}$", "momentum") if free else (r"$\mathbf{B}$", "field")
        layers.append(Arrow(origin, 1.45 * along, role, name))
    if motion.k:
        path = curve(motion.third_axis, 0.0, 2 * np.pi / abs(motion.k), size)
        layers.append(Curve(path, "trace"))
    layers.append(Arrow(origin, 1.3 * up, "body_axis", r"$\mathbf{R}_3(0)=\mathbf{e}_3$"))
    layers.append(Points(up[None], "start"))
    return Space(tuple(layers), title="(a) third axis")


def velocity(motion: ElementaryMotion, stop: float, unit: str) -> Plane:
    """Panel (b): Omega(t)."""
    names = tuple(rf"$\Omega_{i}$" for i in (1, 2, 3))
    y_label = rf"$\boldsymbol{{\Omega}}$ (1/{unit})"
    return course(motion.angular_velocity, names, stop, f"$t$ ({unit})", y_label, "(b) angular velocity")


def momentum(motion: ElementaryMotion, stop: float, unit: str) -> Plane:
    """Panel (c): m(t)/I2 and its projection on the field."""
    names = tuple(f"$m_{i}$" for i in (1, 2, 3))
    y_label = rf"$\mathbf{{m}}/I_2$ (1/{unit})"
    size = float(np.hypot(*motion.field))
    level = motion.invariants()["(m,B')"] / size if size else None
    return course(motion.angular_momentum, names, stop, f"$t$ ({unit})", y_label, "(c) angular momentum", level)


def course(
    vector: Any,
    names: tuple[str, ...],
    stop: float,
    x_label: str,
    y_label: str,
    heading: str,
    level: float | None = None,
) -> Plane:
    """Return a panel with the three components of a vector over time, each with its name."""
    rough = vector(np.linspace(0.0, stop, 257))
    marks = rough if level is None else np.append(rough, level)
    low, high = float(marks.min()), float(marks.max())
    pad = 0.14 * (high - low) or 0.5 * abs(high) or 1.0
    limits = (low - pad, high + pad)
    wide, high = (WIDTH / 2 - MARGIN) / stop, (HEIGHT / 2 - MARGIN) / (limits[1] - limits[0])
    scale, fine = np.array([wide, high, high, high]), quarter_pixel(1.0, 1.0)
    path = curve(lambda t: np.column_stack([t, vector(t)]), 0.0, stop, fine, pieces=32, scale=scale)
    layers: list[Layer] = [Curve(np.array([[0.0, 0.0], [stop, 0.0]]), "guide")]
    if level is not None:
        layers.append(Curve(np.array([[0.0, level], [stop, level]]), "reference", r"$(\mathbf{m},\hat{\mathbf{B}})$"))
    for i, (name, role) in enumerate(zip(names, ("main", "second", "third"), strict=True), 1):
        line = path[:, [0, i]]
        layers += [Curve(line, role), Label(line[0.86 * stop <= line[:, 0]][0], name, role, (0.0, 4.0))]
    return Plane(tuple(layers), x_label, y_label, (0.0, stop), limits, title=heading)


def residuals(motion: ElementaryMotion, stop: float, unit: str) -> Plane:
    """Panel (d): the running maximum of what each invariant has changed by, in units of 1e-16 of its terms."""
    fine = quarter_pixel(1.0, WIDTH / 2 - MARGIN)
    times = np.geomspace(1e-2 * stop, LONG * stop, round(1.0 / fine) + 1)
    first, later, sizes = motion.invariants(), motion.invariants(times), term_sizes(motion)
    layers: list[Layer] = []
    top = 1.0
    roles = ("main", "second", "third", "fourth", "sixth")
    for (name, value), role, text in zip(first.items(), roles, NAMES, strict=True):
        change = np.maximum.accumulate(np.abs(later[name] - value)) / (sizes[name] or 1.0) / 1e-16
        corner = np.flatnonzero(np.diff(change, prepend=-1.0, append=-1.0)[:-1])
        steps = np.repeat(corner, 2)
        line = np.stack([np.append(times[steps], times[-1])[1:], change[steps]], axis=1)
        layers.append(Curve(line, role, text))
        top = max(top, float(change[-1]))
    return Plane(
        tuple(layers),
        f"$t$ ({unit})",
        r"change ($10^{-16}$)",
        (float(times[0]), float(times[-1])),
        (-0.06 * top, 1.35 * top),
        x_scale="log",
        title="(d) invariants, largest change so far",
    )


NAMES = ("$E'$", r"$\mathbf{K}^2$", "$c_3$", "$c_5$", r"$(\mathbf{m},\mathbf{B}')$")


def term_sizes(motion: ElementaryMotion) -> dict[str, float]:
    """Return the sums of the sizes of the terms of the invariants at t = 0, in the order of `invariants`."""
    I, one_less, two_less = shape_factors(motion.ratio)
    (B2, B3), w2, w3 = np.abs(motion.field), abs(motion.omega2), abs(motion.omega3)
    return {
        "E'": w2 * w2 + I * w3 * w3,
        "K^2": B2 * B2 + B3 * B3,
        "c3": B3 + w3,
        "c5": w2 * B2 + w3 * (abs(one_less) * w3 + two_less * B3),
        "(m,B')": w2 * B2 + I * w3 * B3,
    }
