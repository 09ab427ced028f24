"""Quartic and potential of the cubic pseudo-oscillator.

For any initial angular velocity u = Omega3 moves by (47) as a particle of unit mass with the potential
V(u) = -a0 u - a1 u^2/2 - a2 u^3/3 - a3 u^4/4, and (du/dt)^2 = Q(u) with a quartic Q; both with the coefficients (48).
"""

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.errors import DomainError
from atlas.motions.nutation.kernel_general import GeneralMotion
from atlas.motions.nutation.pseudo_oscillator import PseudoOscillator
from atlas.pictures import Curve, Layer, Plane, Points, Region, Scene
from atlas.pictures.captions import plain, plain_setting, plain_vector, tex, tex_equals, tex_setting, tex_vector
from atlas.pictures.sample import flat

ROW = "its map"
SEEN = r"The component $\Omega_3$ moves like a point mass in a potential."
WIDTH, HEIGHT, MARGIN = 178.0, 62.0, 10.0
SIZE = (WIDTH / 3 - MARGIN, HEIGHT - MARGIN)
PIECES = 32
"""Of a period at first: near a separatrix most of it is spent at one end."""
SMALL, SMALLEST = 1e-3, 2.0**-40
"""Widths of the interval, in parts of omega3, from which on it is counted from omega3, and is too small for doubles."""
Ends: TypeAlias = tuple[float, float]
Function: TypeAlias = Callable[[FloatArray], FloatArray]


def scene(
    *,
    ratio: float = 1.5,
    field: tuple[float, float] = (1.0, 2.0),
    omega: tuple[float, float, float] = (0.3, 0.7, 0.2),
    turns: float = 2.0,
    unit: str = "time",
) -> Scene:
    """Draw the quartic Q, the potential V and Omega3(t), over ``turns`` oscillations, for the start ``omega``.

    Q and V are functions of Omega3 with (dOmega3/dt)^2 = Q and Q + 2 V constant. ``ratio`` is I3/I2; ``field`` is (B2,
    B3) of B', ``omega`` the angular velocity at t = 0, in 1/time; ``unit`` is the word for the unit of time. If the
    oscillation is much smaller than omega3, Omega3 - omega3 is drawn. Raises DomainError on a separatrix and for a
    nutation that is too small.
    """
    oscillator = PseudoOscillator(ratio, field, omega)
    motion = GeneralMotion(ratio, field, omega)
    low, high = motion.turning_points
    if high > low and not np.isfinite(motion.period):
        raise DomainError(f"From omega = {omega} the motion runs on a separatrix: it has no period to be drawn.")
    is_at_rest = high == low
    span = (high - low) or max(np.abs((*omega, *field))) or 1.0
    if high - low < SMALLEST * abs(omega[2]) and str(motion.kind).startswith("nutation"):
        raise DomainError("figure pseudo_oscillator draws a nutation, and that of this motion is too small to be seen.")
    zero = float(omega[2]) if high - low < SMALL * abs(omega[2]) and not is_at_rest else 0.0
    view = window(oscillator, (low, high), span, zero)
    symbol = r"\Omega_3-\omega_3" if zero else r"\Omega_3"
    low, high = low - zero, high - zero
    allowed = rf"{tex(low)}\le{symbol}\le {tex(high)}"
    rest_sentence = "The motion is at equilibrium: $\\Omega_3$ is constant. "
    period = rf"It oscillates in ${allowed}$ with the period $T{tex_equals(motion.period)}$. "
    ends = f"{plain(low)} and {plain(high)}{f' off {plain(zero)}' if zero else ''}"
    spoken = "Omega 3 stays where it is" if is_at_rest else f"Omega 3 oscillates between {ends}"

    def Q(u: FloatArray) -> FloatArray:
        return np.asarray(oscillator.quartic(zero + u))

    start = np.array([oscillator.omega3 - zero, (oscillator.omega1 * oscillator.B2) ** 2])
    return Scene(
        caption=(
            rf"{tex_setting(ratio, field, article='A')} from "
            rf"$\boldsymbol{{\omega}}={tex_vector(omega)}$. (a) The quartic "
            r"$\dot\Omega_3^2=Q(\Omega_3)$. (b) The potential $V$ of (47) and the "
            r"energy of the motion. Dot: the start; the shaded "
            rf"interval is allowed. (c) $\Omega_3(t)$. {rest_sentence if is_at_rest else period}"
        ).rstrip(),
        alt=(
            f"Three panels for {plain_setting(ratio, field)}, started with the angular velocity "
            f"{plain_vector(omega)}: the quartic Q over Omega 3 with the interval where the motion goes on; the "
            f"potential with a level line over the same "
            f"interval; Omega 3 over time. {spoken}."
        ),
        panels=(
            quartic(Q, start, (low, high), view, f"${symbol}$ (1/{unit})", unit),
            potential(Q, start, (low, high), view, f"${symbol}$ (1/{unit})", unit),
            course(motion, turns, (low, high), view, zero, f"${symbol}$ (1/{unit})", unit),
        ),
        columns=3,
        named={"shaded": "region"},
        size=(WIDTH, HEIGHT),
    )


def window(oscillator: PseudoOscillator, allowed: Ends, span: float, zero: float) -> Ends:
    """Return the interval (low, high) of Omega3 - `zero` to show: the allowed one, and the extrema of Q near it.

    `allowed` is (low, high) of Omega3 and `span` its width. Extrema count if they are within three spans, and not
    much larger than Q in the interval.
    """
    slope = np.polynomial.Polynomial(oscillator.coefficients).trim()
    extrema = slope.roots() if slope.degree() else np.empty(0)
    real = np.sort(extrema[np.isreal(extrema)].real)
    inside = real[(real >= allowed[0]) & (real <= allowed[1])]
    top = np.max(oscillator.quartic(inside), initial=0.0) or np.inf
    close_extrema = [u for u in real if abs(u - sum(allowed) / 2) < 3 * span and abs(oscillator.quartic(u)) <= 3 * top]
    low, high = min(allowed[0], *close_extrema, allowed[0]), max(allowed[1], *close_extrema, allowed[1])
    pad = max(0.5 * span, 0.25 * (high - low))
    return low - zero - pad, high - zero + pad


def quartic(Q: Function, start: FloatArray, allowed: Ends, view: Ends, x_label: str, unit: str) -> Plane:
    """Return panel (a), a `Plane`: the quartic `Q`, a function of u (N,), its zeros and the allowed interval.

    `start` (2,) is the point (u, Q) of the start, `allowed` and `view` are (low, high) of u: of the motion, and as
    drawn. `x_label` is that of u, `unit` the word for the unit of time.
    """
    inner = Q(np.linspace(*allowed, 65))
    top = float(max(inner.max(), 0.02 * np.abs(Q(np.array(view))).max())) or 1.0
    limits = (-1.1 * top, 1.6 * top)
    layers: list[Layer] = [
        Region(band(allowed, limits), "region"),
        Curve(np.array([[view[0], 0.0], [view[1], 0.0]]), "guide"),
        Curve(graph(Q, view, limits), "main"),
        Points(np.stack([allowed[::-1], np.zeros(2)], axis=1), "rest", "turning points"),
        Points(start[None], "start"),
    ]
    return Plane(tuple(layers), x_label, rf"$Q$ (1/{unit}$^4$)", view, limits, title="(a) first integral")


def potential(Q: Function, start: FloatArray, allowed: Ends, view: Ends, x_label: str, unit: str) -> Plane:
    """Return panel (b), a `Plane`: the potential V, with Q + 2 V = 2 level, and the level of the motion.

    The arguments are those of `quartic`; the level is Q/2 at the start.
    """
    level = float(start[1]) / 2

    def V(u: FloatArray) -> FloatArray:
        return level - Q(u) / 2

    inner = V(np.linspace(*allowed, 65))
    depth = float(max(level - inner.min(), 0.02 * np.abs(V(np.array(view))).max())) or 1.0
    limits = (level - 1.4 * depth, level + 1.2 * depth)
    level_line = np.array([[allowed[0], level], [allowed[1], level]])
    layers = (
        Region(band(allowed, limits), "region"),
        Curve(graph(V, view, limits), "main"),
        Curve(level_line, "reference", "level"),
        Points(level_line, "rest"),
        Points(np.array([[start[0], level]]), "start"),
    )
    return Plane(layers, x_label, rf"$V$ (1/{unit}$^4$)", view, limits, title="(b) potential")


def course(
    motion: GeneralMotion, turns: float, allowed: Ends, view: Ends, zero: float, y_label: str, unit: str
) -> Plane:
    """Return panel (c), a `Plane`: Omega3 - `zero` over `turns` periods of a motion.

    `allowed` and `view` are (low, high) of Omega3 - zero: of the motion, and in the other panels. `y_label` is that
    of the ordinate, `unit` the word for the unit of time.
    """
    low, high = allowed
    pad = 0.15 * (view[1] - view[0])
    limits = (low - pad, high + pad)

    def point(t: FloatArray) -> FloatArray:
        return np.stack([t, motion.angular_velocity(t)[:, 2] - zero], axis=1)

    if high == low:
        line = np.array([[0.0, low], [1.0, low]])
    else:
        stop = turns * motion.period
        line = flat(point, 0.0, stop, ((0.0, stop), limits), SIZE, pieces=max(PIECES, round(PIECES * turns)))
    ends = (float(line[0, 0]), float(line[-1, 0]))
    layers: tuple[Layer, ...] = (
        *(Curve(np.array([[ends[0], u], [ends[1], u]]), "reference") for u in dict.fromkeys((low, high))),
        Curve(line, "main"),
        Points(line[:1], "start"),
    )
    return Plane(layers, f"$t$ ({unit})", y_label, ends, limits, title="(c) course")


def band(interval: Ends, limits: Ends) -> FloatArray:
    """Return the corners (4, 2) of the rectangle over an interval (low, high) of abscissas, between two limits."""
    (a, b), (low, high) = interval, limits
    return np.array([[a, low], [b, low], [b, high], [a, high]])


def graph(function: Function, view: Ends, limits: Ends) -> FloatArray:
    """Return the graph of a function, which maps u (N,) to (N,), over the interval `view`: points (N, 2).

    It is sampled for the panel's size; outside the `limits` (low, high) of the ordinate the graph is coarse.
    """
    return flat(lambda u: np.stack([u, function(u)], axis=1), *view, (view, limits), SIZE, pieces=32)
