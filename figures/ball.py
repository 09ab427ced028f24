"""Laboratory system of a charged ball.

The paper's Figure Ball: e3 points along B, and the angular momentum m(0) lies in the plane of e2 and e3. It goes round
B with the Larmor frequency alpha, (26), while the ball turns about the axis k, (28), (29), which lies in that plane.
"""

import numpy as np

from atlas.errors import DomainError
from atlas.motions.elementary.kernel_ball import BallMotion
from atlas.pictures import Arrow, Curve, Layer, Points, Scene, Space, quadric_panel, solids
from atlas.pictures.captions import plain, tex
from atlas.pictures.quadric_panel import E3, O, in_plane, tolerance

ROW = "a body"
SEEN = r"The angular momentum $\mathbf{m}$ of a charged ball goes round the field on a circle."


def scene(
    *,
    inertia: float = 1.0,
    larmor: float = 0.8,
    momentum: tuple[float, float] = (1.0, 0.9),
    azimuth: float = 25.0,
    elevation: float = 16.0,
) -> Scene:
    """Show a solid ball with the moment ``inertia`` I0 and ``momentum`` (m2, m3) at t = 0 in a field along e3.

    ``larmor`` is Larmor's frequency, in rad/time; zero raises DomainError. Azimuth and elevation of the view are in
    degrees.
    """
    if not larmor:
        raise DomainError("figure ball needs a field, larmor other than 0: without one the momentum stays as it is.")
    ball = BallMotion(inertia, larmor, momentum=momentum)
    size = float(np.hypot(*momentum))
    radius, sag = 0.62, tolerance(2.0)
    layers: list[Layer] = [
        solids.sphere(O, radius, sag, role="ball"),
        *quadric_panel.basis((1.6, 1.75, 2.0)),
        Arrow(O, 1.6 * E3, "field", r"$\mathbf{B}$", offset=(-7.0, 0.0)),
        Points(O[None], "origin", r"$O$"),
    ]
    k = in_plane(*ball.k_hat)
    layers.append(Arrow(O, 1.35 * k, "turn", r"$\hat{\mathbf{k}}$"))
    if size > 0.0:
        m2, m3 = (1.65 / size * m for m in momentum)
        layers.append(Arrow(O, in_plane(m2, m3), "momentum", r"$\mathbf{m}(0)$"))
        if m2 != 0.0:
            layers.append(Curve(solids.circle(m3 * E3, E3, abs(m2), sag), "precession"))
            quarter = np.pi / 5.0 * float(np.sign(larmor))
            tips = np.array(
                [[m2 * np.sin(s), m2 * np.cos(s), m3] for s in (quarter - 0.24 * np.sign(quarter), quarter)]
            )
            layers.append(Arrow(tips[0], tips[1], "precession", r"$\mathbf{m}(t)$"))
    m2, m3 = momentum
    return Scene(
        caption=r"Meanwhile the ball turns about $\hat{\mathbf{k}}$. "
        rf"Laboratory system for a ball with $I_0={tex(inertia)}$, $\alpha={tex(larmor)}$ and "
        rf"$\mathbf{{m}}(0)=(0, {tex(m2)}, {tex(m3)})$: $\mathbf{{e}}_3$ points along $\mathbf{{B}}$, and "
        r"$\mathbf{m}(0)$ lies in the plane of $\mathbf{e}_2$ and $\mathbf{e}_3$. Lengths are not to scale.",
        alt=f"A ball at the origin with inertia {plain(inertia)} and Larmor frequency {plain(larmor)}; B and e3 point "
        f"up, the angular momentum (0, {plain(m2)}, {plain(m3)}) in the plane e2, e3 precesses round B on a horizontal "
        "circle.",
        panels=(Space(tuple(layers), azimuth=azimuth, elevation=elevation),),
        size=(100.0, 95.0),
    )
