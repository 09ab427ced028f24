"""An elementary motion.

The body precesses about the field with the frequency k, (79), while it turns about its third axis with the frequency
phi, (72): the body at the start with the way of that axis, (84); Omega(t), (73); and m(t), (88).
"""

from dataclasses import replace

import numpy as np

from atlas.arithmetic.inputs import positive
from atlas.motions.elementary.kernel import ElementaryMotion
from atlas.pictures import Arrow, Curve, Label, Layer, Plane, Points, Scene, Space
from atlas.pictures.any_motion import course
from atlas.pictures.bodies import drawn_body
from atlas.pictures.captions import plain, plain_setting, quotient, tex, tex_equals, tex_setting
from atlas.pictures.quadric_panel import E3, O
from atlas.pictures.sample import curve, quarter_pixel

ROW = "a body"
SEEN = "The axis keeps its angle with a fixed direction."
WIDTH, HEIGHT = 178.0, 62.0
COLUMNS = 3
PANEL = (WIDTH / COLUMNS, HEIGHT)
MAX_SPIN_TURNS = 25.0
BODY, SPOKES = 0.75, 24
"""Size of the drawn body, whose axis goes round on the unit sphere, and how many places of the axis are marked."""


def scene(
    *,
    ratio: float = 1.5,
    field: tuple[float, float] = (1.0, 2.0),
    omega2: float = 0.7,
    omega3: float | None = None,
    turns: float = 2.0,
    unit: str = "time",
) -> Scene:
    """Draw the motion for ``turns`` periods of its precession; ``omega3`` is given only where (71) leaves it free.

    ``ratio`` is I3/I2; ``field`` is (B2, B3) of B', ``omega2`` the component of the start, in 1/time; ``unit`` is
    the word for the unit of time on the axes. Omega(t) is drawn for 25 turns of the body at most.
    """
    motion = ElementaryMotion(ratio, field, omega2, omega3)
    turns = positive(turns, "turns")
    k, phi = abs(motion.k), abs(motion.phi)
    slow = 2 * np.pi * turns / (k or phi) if k or phi else 1.0
    # no more than MAX_SPIN_TURNS proper rotations: beyond, Omega(t) would be all ink
    stop = min(slow, 2 * np.pi * MAX_SPIN_TURNS / phi) if phi else slow
    is_free = not any(motion.field)
    projection_words = "" if is_free else r"; dashed: its projection on the field"
    turning = rf"The body at the start; its axis in {SPOKES} steps, half at $t_1$."
    return Scene(
        caption=(
            rf"{tex_setting(ratio, field, article='A')} from "
            rf"$\boldsymbol{{\omega}}=(0,\omega_2,\omega_3)$ with $\omega_2={tex(motion.omega2)}$, "
            rf"$\omega_3{tex_equals(motion.omega3)}$: {motion.case}, $k{tex_equals(motion.k)}$, "
            rf"$\phi{tex_equals(motion.phi)}$. "
            rf"(a) {turning if motion.k else 'The body.'} "
            r"(b) The angular velocity in the body. "
            rf"(c) $\mathbf{{m}}/I_2$ in the laboratory, (88){projection_words}."
        ),
        alt=(
            f"Three panels for the elementary motion of {plain_setting(ratio, field)} from the angular velocity "
            f"(0, {plain(motion.omega2)}, {plain(motion.omega3)}), {motion.case}: "
            + (
                "the body and the way of its third axis, a circle about "
                + ("the angular momentum; " if is_free else "the field; ")
                if motion.k
                else "the body, whose third axis does not move; "
            )
            + "the three components of the angular velocity over time, the third constant; and those of the angular "
            "momentum."
        ),
        panels=(
            trace(motion),
            marked(velocity(motion, stop, unit), motion),
            marked(momentum(motion, slow, unit), motion),
        ),
        columns=COLUMNS,
        named={"dashed": "reference"} if projection_words else {},
        size=(WIDTH, HEIGHT),
    )


def trace(motion: ElementaryMotion) -> Space:
    """Return panel (a), a `Space`: the body at t = 0, the field, and the path of the third axis on the unit sphere.

    Without a field the angular momentum takes its place.
    """
    is_free = not any(motion.field)
    axis = motion.angular_momentum(0.0) if is_free else np.array([0.0, *motion.field])
    size = quarter_pixel(2.6, WIDTH / COLUMNS)
    layers: list[Layer] = drawn_body(quotient(motion.ratio), np.eye(3), O, BODY, size)
    if motion.k:
        period = 2 * np.pi / abs(motion.k)
        tips = motion.third_axis(np.arange(SPOKES) * period / SPOKES)
        layers += [Curve(np.stack([BODY * tip, tip]), "guide") for tip in tips]
        layers.append(Curve(curve(motion.third_axis, 0.0, period, size), "trace"))
        layers.append(Points(motion.third_axis(np.array([period / 2])), "point"))
        layers.append(Label(motion.third_axis(period / 2), "$t_1$", "label", (6.0, 0.0)))
    if axis.any():
        name, role = (r"$\mathbf{m}$", "momentum") if is_free else (r"$\mathbf{B}$", "field")
        layers.append(Arrow(O, 1.5 * axis / np.linalg.norm(axis), role, name))
    layers.append(Arrow(O, 1.25 * E3, "body_axis", r"$\mathbf{R}_3(0)$"))
    layers.append(Points(E3[None], "start"))
    return Space(tuple(layers), title="(a) body and axis")


def marked(panel: Plane, motion: ElementaryMotion) -> Plane:
    """Return a panel over time with a vertical line at t1 = pi/|k|, half a precession.

    The panel is returned unchanged if t1 lies beyond it or there is no precession.
    """
    time = np.pi / abs(motion.k) if motion.k else np.inf
    if panel.x_limits is None or panel.y_limits is None or time > panel.x_limits[1]:
        return panel
    line = np.column_stack([np.full(2, time), panel.y_limits])
    return replace(panel, layers=(*panel.layers, Curve(line, "limit"), Label(line[1], "$t_1$", "note", (5.0, -6.0))))


def velocity(motion: ElementaryMotion, stop: float, unit: str) -> Plane:
    """Return panel (b), a `Plane`: the components of Omega(t) along the axes of the body, up to the time `stop`.

    `unit` is the word for the unit of time.
    """
    names = tuple(rf"$\Omega_{i}$" for i in (1, 2, 3))
    y_label = rf"$\boldsymbol{{\Omega}}$ (1/{unit})"
    return course(motion.angular_velocity, names, stop, f"$t$ ({unit})", y_label, "(b) angular velocity", size=PANEL)


def momentum(motion: ElementaryMotion, stop: float, unit: str) -> Plane:
    """Return panel (c), a `Plane`: the components of m(t)/I2 in the laboratory, and its projection on the field.

    Without a field there is no projection. `stop` is the last time, `unit` the word for the unit of time.
    """
    names = tuple(f"$m_{i}$" for i in (1, 2, 3))
    y_label = rf"$\mathbf{{m}}/I_2$ (1/{unit})"
    size = float(np.hypot(*motion.field))
    level = motion.invariants()["(m,B')"] / size if size else None
    return course(
        motion.angular_momentum, names, stop, f"$t$ ({unit})", y_label, "(c) angular momentum", size=PANEL,
        level=level, level_name=r"$(\mathbf{m},\hat{\mathbf{B}})$",
    )  # fmt: skip
