"""Two turns of a ball on a torus.

Every motion of a ball is R = R_z(-alpha t) R_k(-gamma t), (28): its attitude is a pair of angles, a point of a torus,
and moves on it along a line of constant slope. If gamma/alpha is rational the line closes and with it the trace of each
point of the ball; if not, both come as near as one likes to where they have been, and never come back.
"""

import numpy as np

from atlas.core.ball import BallMotion
from atlas.core.inputs import FloatArray, positive
from atlas.errors import DomainError
from atlas.scene import Arrow, Curve, Layer, Points, Scene, Space, quadric_panel, solids
from atlas.scene.camera import frame
from atlas.scene.sample import curve
from atlas.scene.words import listed, plain, tex, title

WIDTH, HEIGHT = 150.0, 128.0
TORUS = (1.0, 0.42)
"""Radii of the torus, and of its tube."""
VIEW = (25.0, 52.0)
MOST, GRAZE = 400.0, 1e-9
FEW = 40.0
"""Beyond so many radians of the Larmor turn the trace on the sphere is a thin line."""


def scene(
    *,
    larmor: float = 0.8,
    m3: float = 0.5,
    ratios: tuple[float, ...] = (2.5, 2.618034),
    turns: tuple[float, ...] = (2.0, 13.0),
) -> Scene:
    """Draw balls (I0 = 1) with gamma/alpha in ``ratios`` for ``turns`` of alpha = ``larmor``; m3 is that of m."""
    larmor = positive(larmor, "larmor")
    least = abs(1.0 + m3 / larmor)
    if not 0 < len(ratios) == len(turns) <= 4:
        raise DomainError(
            f"figure ball_torus takes one to four ratios and as many turns, not {len(ratios)} ratios and "
            f"{len(turns)} turns."
        )
    if min(ratios) < least:
        raise DomainError(
            f"gamma/alpha = {min(ratios):g} is below |1 + m3/alpha| = {least:g}, the least of a ball with m3 = {m3:g} "
            f"and alpha = {larmor:g} can have; give larger ratios, or m3 nearer to {-larmor:g}."
        )
    if max(abs(r * n) for r, n in zip(ratios, turns, strict=True)) > MOST:
        raise DomainError(f"figure ball_torus draws at most {MOST:g} turns.")
    panels: list[Space] = []
    for ratio, count in zip(ratios, turns, strict=True):
        m2 = larmor * float(np.sqrt(ratio * ratio - least * least))
        ball = BallMotion(1.0, larmor, momentum=(m2, m3))
        stop = count * 2 * np.pi / larmor
        panels += [torus(ball, larmor, stop), trace(ball, larmor, stop)]
    shown = listed([rf"${tex(r)}$ over {plain(n)} turns of the second" for r, n in zip(ratios, turns, strict=True)])
    return Scene(
        title=title(__doc__),
        caption=(
            r"Left, a ball's attitude on the torus of its two angles, $\alpha t$ the long way round and $\gamma t$ the "
            r"short way; right, the way of its point $\mathbf{R}_1$. From above, $\gamma/\alpha$ is "
            rf"{shown}, with $\alpha={tex(larmor)}$ and $m_3={tex(m3)}\,I_0$."
        ),
        alt=(
            f"{len(ratios)} rows of two pictures: a line that winds round a torus, closed in the first row and dense "
            "in the second, and beside it the trace of a point of a ball, a closed curve with loops in the first row "
            "and a net that fills a zone of the sphere in the second."
        ),
        panels=tuple(panels),
        columns=2,
        size=(WIDTH, HEIGHT * len(ratios) / 2),
    )


def on_torus(first: FloatArray, second: FloatArray) -> FloatArray:
    """Return the point (..., 3) of the torus with these angles, round its axis e3 and round its tube."""
    far = TORUS[0] + TORUS[1] * np.cos(second)
    return np.stack([far * np.cos(first), far * np.sin(first), TORUS[1] * np.sin(second)], axis=-1)


def hidden(points: FloatArray) -> FloatArray:
    """Tell which points x (N, 3) of the torus lie behind a part of it, as seen along the unit vector d to the eye.

    On the ray x + t d its equation (|x|^2 + R^2 - r^2)^2 = 4 R^2 (x_1^2 + x_2^2) has the root t = 0 and those of a
    cubic, of which one is positive if its value at t = 0, or the least one after that, is negative.
    """
    (R, r), d = TORUS, frame(Space((), *VIEW))[2]
    G, b = np.sum(points**2, axis=1) + R * R - r * r, points @ d
    c0 = 4 * b * G - 8 * R * R * (points[:, :2] @ d[:2])
    c1 = 4 * b * b + 2 * G - 4 * R * R * (d[:2] @ d[:2])
    least = np.maximum((np.sqrt(np.maximum(16 * b * b - 3 * c1, 0.0)) - 4 * b) / 3, 0.0)
    return np.asarray(np.minimum(c0, c0 + least * (c1 + least * (4 * b + least))) < -GRAZE)


def seen(points: FloatArray, role: str) -> list[Layer]:
    """Return the visible parts of a line on the torus."""
    gone = hidden(points)
    pieces = np.split(np.arange(len(points)), np.flatnonzero(np.diff(gone)) + 1)
    return [Curve(points[piece[0] : piece[-1] + 2], role) for piece in pieces if not gone[piece[0]]]


def outline(round_: FloatArray) -> list[Layer]:
    """Return the visible parts of the two lines along which rays to the eye graze the torus."""
    towards = frame(Space((), *VIEW))[2]
    slope = -np.arctan2(towards[0] * np.cos(round_) + towards[1] * np.sin(round_), towards[2])
    return [layer for turned in (slope, slope + np.pi) for layer in seen(on_torus(round_, turned), "silhouette")]


def torus(ball: BallMotion, larmor: float, stop: float) -> Space:
    """Return the panel of the torus with its net and the line of the motion."""
    round_ = np.linspace(0.0, 2 * np.pi, 181)
    layers: list[Layer] = []
    for angle in np.arange(24) * np.pi / 12:
        layers += seen(on_torus(np.full_like(round_, angle), round_), "guide")
    for angle in np.arange(8) * np.pi / 4:
        layers += seen(on_torus(round_, np.full_like(round_, angle)), "guide")
    fine = quadric_panel.tolerance(1.5)
    pieces = max(16, int(4 * (larmor + ball.gamma) * stop / np.pi))
    line = curve(lambda t: on_torus(larmor * t, ball.gamma * t), 0.0, stop, fine, pieces=pieces)
    layers += [*outline(round_), *seen(line, "trajectory")]
    layers.append(Points(line[:1], "start"))
    return Space(tuple(layers), *VIEW)


def trace(ball: BallMotion, larmor: float, stop: float) -> Space:
    """Return the panel of the ball with the way of R_1, the field and the axis k at t = 0."""
    fine = quadric_panel.tolerance(1.5)
    pieces = max(16, int(4 * (larmor + ball.gamma) * stop / np.pi))
    way = curve(lambda t: ball.rotation(t)[..., 0], 0.0, stop, fine, pieces=pieces)
    layers: list[Layer] = [
        solids.sphere(quadric_panel.O, 1.0, fine, role="ball"),
        Curve(way, "trajectory" if larmor * stop < FEW else "second_trace"),
        Points(way[:1], "start", r"$\mathbf{R}_1(0)$"),
        Arrow(quadric_panel.E3, 1.5 * quadric_panel.E3, "field", r"$\mathbf{B}$"),
    ]
    k = quadric_panel.in_plane(*ball.k_hat)
    return Space((*layers, Arrow(k, 1.5 * k, "turn", r"$\hat{\mathbf{k}}$")), 25.0, 20.0)
