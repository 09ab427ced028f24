"""A torus with two flows.

Where H, F and the Casimirs of a body with three moments have given values, its M and K run over a torus, and the flows
of H and of F/2, which commute, are straight lines on it. The motion winds round for ever; but from any of its states
the flow of H for a time T_H, and then that of F/2 for T_F, lead back.
"""

import numpy as np

from atlas.arithmetic.inputs import FloatArray, positive, vector
from atlas.checking.simulate import flow
from atlas.errors import DomainError
from atlas.pictures import Arrow, Curve, Label, Points, Scene, Space, solids
from atlas.pictures.captions import plain, plain_vector, tex, tex_vector
from atlas.pictures.quadric_panel import O, tolerance
from atlas.pictures.torus import VIEW, net, on_torus, visible

ROW = "three moments"
SEEN = "The motion winds round a torus."
WIDTH, HEIGHT = 178.0, 80.0
POINTS_PER_TURN = 150
"""Points of a line for each of its turns round the torus."""
MAX_TURNS = 200.0


def scene(
    *,
    inertia: tuple[float, float, float] = (0.5, 1.0, 1.4),
    field: tuple[float, float, float] = (0.6, 0.6, 0.5),
    omega: tuple[float, float, float] = (0.3, 0.7, 0.2),
    turns: float = 18.0,
    stop: float | None = None,
) -> Scene:
    """Draw the motion from ``omega`` for ``turns`` or up to the time ``stop``, and one way back to its start.

    ``inertia`` are the principal moments; ``field`` is B' along the principal axes, in 1/time as ``omega``; turns
    are those round the torus. Raises DomainError for a motion that is not on a torus, and for more than 200 turns.
    """
    first_period, second_period = periods(inertia, field, omega)
    area = first_period[0] * second_period[1] - first_period[1] * second_period[0]
    rates = (
        np.array([[second_period[1], -first_period[1]], [-second_period[0], first_period[0]]]) * 2 * np.pi / area
    )  # of both angles, H and F/2
    fastest = float(np.abs(rates[0]).max()) / (2 * np.pi)
    stop = positive(turns, "turns") / fastest if stop is None else stop
    if not 0 < stop <= MAX_TURNS / fastest:
        raise DomainError(
            f"figure torus_of_flows draws up to {MAX_TURNS:g} turns: give a stop between 0 and "
            f"{MAX_TURNS / fastest:.3g}, not {stop:g}."
        )
    K = vector(field, "field")
    W, I = vector(omega, "omega") + K, vector(inertia, "inertia")
    orbit = flow(I, W, K, 1.0, 0.0, np.linspace(0.0, stop, int(POINTS_PER_TURN * fastest * stop) + 2))[1]
    shares = np.linspace(0.0, 1.0, 3 * POINTS_PER_TURN)
    out = flow(I, W, K, first_period[0], 0.0, shares)
    back = flow(I, out[0][-1], out[1][-1], 0.0, first_period[1], shares)[1]
    angles = (
        np.linspace(0.0, stop, 2 * len(orbit))[:, None] * rates[0],
        shares[:, None] * first_period[0] * rates[0],
        first_period[0] * rates[0] + shares[:, None] * first_period[1] * rates[1],
    )
    return Scene(
        caption=(
            rf"The motion (thin line) of a body with $I_i={tex_vector(inertia)}$ "
            rf"from $\boldsymbol{{\omega}}={tex_vector(omega)}$ in $\mathbf{{B}}'={tex_vector(field)}$ up to "
            rf"$t={tex(stop)}$: (a) in the angles of its two periods, (b) as the path of $\mathbf{{K}}$ in the body. "
            rf"From the start, $T_H={tex(round(first_period[0], 4))}$ along the motion (teal) and "
            rf"$T_F={tex(round(first_period[1], 4))}$ along the other flow (plum) lead back."
        ),
        alt=(
            f"A torus with a line wound round it many times, and a sphere with the trace that the same motion of a "
            f"body with moments {plain_vector(inertia)} draws on it up to t = {plain(stop)}, a net that fills a zone. "
            "On both a closed curve of two arcs through the start."
        ),
        panels=(winding(*angles), sphere(orbit, out[1], back)),
        columns=2,
        named={"thin line": "fine_trajectory", "teal": "trajectory", "plum": "turn"},
        size=(WIDTH, HEIGHT),
    )


def periods(
    inertia: tuple[float, ...], field: tuple[float, ...], omega: tuple[float, ...]
) -> list[tuple[float, float]]:
    """Return two pairs (T_H, T_F) that generate all times after which M and K are back, as floats, by rising |T_H|.

    M and K are the canonical momentum and the field in the body, T_H and T_F times of the flows of H and of F/2.
    ``inertia``, ``field`` and ``omega`` have three components each, along the principal axes. The periods are
    approximate. Raises DomainError unless the motion is on a torus, and NotCertifiedError where no periods are
    found.
    """
    from atlas.motions.torus.certified import AsymmetricMotion
    from atlas.motions.torus.certified_torus import Torus

    motion = AsymmetricMotion(inertia, field, omega)
    if motion.kind != "on a torus":
        raise DomainError(
            f"figure torus_of_flows needs a motion on a torus, of three different moments, and not {motion.kind!r}."
        )
    W = tuple(w + k for w, k in zip(motion.omega, motion.field, strict=True))
    lattice = Torus(motion.inertia, W, motion.field).lattice.real
    return sorted(((float(H.real.mid()), float(F.real.mid())) for H, F, _ in lattice), key=lambda pair: abs(pair[0]))


def winding(orbit: FloatArray, out: FloatArray, back: FloatArray) -> Space:
    """Return panel (a), a `Space`: the torus with three lines, each by its two angles in rad at N points, (N, 2).

    They are the orbit, and the period in two arcs: ``out`` along the flow of H, ``back`` along that of F/2.
    """
    roles = ("fine_trajectory", "trajectory", "turn")
    layers = net()
    for line, role in zip((orbit, out, back), roles, strict=True):
        layers += visible(on_torus(*line.T), role)
    for line, role, name in ((out, "trajectory", "$T_H$"), (back, "turn", "$T_F$")):
        longest = max((arc.points for arc in visible(on_torus(*line.T), role) if isinstance(arc, Curve)), key=len)
        layers.append(Label(middle(longest), name, role, (-5.0, -5.0)))
    return Space((*layers, Points(on_torus(*orbit[:1].T), "start")), *VIEW, title="(a) torus of the motion")


def sphere(orbit: FloatArray, out: FloatArray, back: FloatArray) -> Space:
    """Return panel (b), a `Space`: the unit sphere of K/b with the lines of orbit and periods, vectors K (N, 3).

    K is the field in the body and b its length; the three lines are those of `winding`.
    """
    b = float(np.linalg.norm(orbit[0]))
    sag = tolerance(1.4)
    layers = [
        solids.sphere(O, 1.0, sag),
        Curve(orbit / b, "fine_trajectory"),
        Curve(out / b, "trajectory"),
        Curve(back / b, "turn"),
        Points(orbit[:1] / b, "start"),
        *(Arrow(axis, 1.35 * axis, "body_axis", rf"$\mathbf{{e}}_{n}$") for n, axis in enumerate(np.eye(3), 1)),
        Label(orbit[0] / b, r"$\mathbf{K}(0)$", "label", (6, -4)),
        Label(middle(out) / b, "$T_H$", "trajectory", (5, 5)),
        Label(middle(back) / b, "$T_F$", "turn", (5, -5)),
    ]
    return Space(tuple(layers), 62.0, 18.0, title=r"(b) $\mathbf{K}$ in the body")


def middle(line: FloatArray) -> FloatArray:
    """Return five points (5, 3) in the inner third of a line (N, 3), the middle first, as places for its name."""
    return line[(len(line) * np.array([0.5, 0.4, 0.6, 0.35, 0.65])).astype(int)]
