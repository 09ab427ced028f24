"""Two turns of a ball on a torus.

Every motion of a ball is R = R_z(-alpha t) R_k(-gamma t), (28): its attitude is a pair of angles, a point of a torus,
and moves on it along a line of constant slope. If gamma/alpha is rational the line closes and with it the trace of each
point of the ball; if not, both come as near as one likes to where they have been, and never come back.
"""

import numpy as np

from atlas.arithmetic.inputs import positive
from atlas.errors import DomainError
from atlas.motions.elementary.kernel_ball import BallMotion
from atlas.pictures import Arrow, Curve, Layer, Points, Scene, Space, solids
from atlas.pictures.captions import listed, plain, tex
from atlas.pictures.quadric_panel import E3, O, in_plane, tolerance
from atlas.pictures.sample import curve
from atlas.pictures.torus import VIEW, net, on_torus, visible

ROW = "a body"
SEEN = "The attitude of a ball moves on a torus with two constant rates."
WIDTH, HEIGHT = 150.0, 128.0
MAX_TURNS = 400.0
MAX_BOLD_PHASE = 40.0
"""Beyond so many radians of the Larmor turn the trace on the sphere is a thin line."""


def scene(
    *,
    larmor: float = 0.8,
    m3: float = 0.5,
    ratios: tuple[float, ...] = (2.5, 2.618034),
    turns: tuple[float, ...] = (2.0, 13.0),
) -> Scene:
    """Draw torus and solid ball (I0 = 1) for each gamma/alpha in ``ratios``, over ``turns`` of alpha = ``larmor``.

    gamma is the rate about the vector k, alpha Larmor's frequency, see `BallMotion`; ``m3`` is the momentum along B at
    t = 0. Raises DomainError unless there are one to four ratios, as many turns, 400 turns of gamma at most, and a body
    with each ratio.
    """
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
    if max(abs(r * n) for r, n in zip(ratios, turns, strict=True)) > MAX_TURNS:
        raise DomainError(f"figure ball_torus draws at most {MAX_TURNS:g} turns.")
    panels: list[Space] = []
    for ratio, count in zip(ratios, turns, strict=True):
        m2 = larmor * float(np.sqrt(ratio * ratio - least * least))
        ball = BallMotion(1.0, larmor, momentum=(m2, m3))
        stop = count * 2 * np.pi / larmor
        letters = "abcdefgh"[len(panels) :]
        names = rf"({letters[0]}) $\gamma/\alpha={tex(ratio)}$", rf"({letters[1]}) path of $\mathbf{{R}}_1$"
        panels += pair(names, ball, larmor, stop, named=not panels)
    phrase = listed([rf"${tex(r)}$ over {plain(n)} turns of the second" for r, n in zip(ratios, turns, strict=True)])
    return Scene(
        caption=(
            r"Left, $\alpha t$ is the long way round, $\gamma t$ the short way; hidden parts of "
            r"short lines are dashed. Right, the path of $\mathbf{R}_1$. "
            rf"Here $\gamma/\alpha$ is {phrase}, with $\alpha={tex(larmor)}$ and $m_3={tex(m3)}\,I_0$."
        ),
        alt=(
            f"{len(ratios)} rows of two pictures: a line that winds round a torus, closed in the first row and dense "
            "in the second, and beside it the trace of a point of a ball, a closed curve with loops in the first row "
            "and a net that fills a zone of the sphere in the second."
        ),
        panels=tuple(panels),
        columns=2,
        named={"dashed": "hidden_trace"} if min(turns) * 2 * np.pi < MAX_BOLD_PHASE else {},
        size=(WIDTH, HEIGHT * len(ratios) / 2),
    )


def pair(names: tuple[str, str], ball: BallMotion, larmor: float, stop: float, *, named: bool) -> list[Space]:
    """Return two panels: the torus with its net and the line of the motion, and the solid ball with the path of R_1.

    `names` are their titles, `larmor` is alpha in rad/time, `stop` the last time. The second panel shows the field, and
    the axis k at t = 0; the start of the path has a name if `named`.
    """
    sag, is_bold = tolerance(1.5), larmor * stop < MAX_BOLD_PHASE
    pieces = max(16, int(4 * (larmor + ball.gamma) * stop / np.pi))
    line = curve(lambda t: on_torus(larmor * t, ball.gamma * t), 0.0, stop, sag, pieces=pieces)
    path = curve(lambda t: ball.rotation(t)[..., 0], 0.0, stop, sag, pieces=pieces)
    layers: list[Layer] = [
        solids.sphere(O, 1.0, sag, role="ball"),
        Curve(path, "second_trace" if is_bold else "fine_trace"),
        Points(path[:1], "start", r"$\mathbf{R}_1(0)$" if named else ""),
        Arrow(E3, 1.5 * E3, "field", r"$\mathbf{B}$"),
    ]
    k = in_plane(*ball.k_hat)
    layers.append(Arrow(k, 1.5 * k, "turn", r"$\hat{\mathbf{k}}$"))
    winding = [*net(), *visible(line, "second_trace", "hidden_trace" if is_bold else ""), Points(line[:1], "start")]
    s = np.linspace(0.0, 1.0, 25) if named else np.empty(0)
    for u, v, role, name in ((0.5 * s, 0 * s, "field", r"$\alpha t$"), (0 * s, s, "turn", r"$\gamma t$")):
        arc = on_torus(u, v)
        winding += [Curve(arc[:-8], role), Arrow(arc[-9], arc[-1], role, name)] if named else []
    return [Space(tuple(winding), *VIEW, title=names[0]), Space(tuple(layers), 25.0, 20.0, title=names[1])]
