"""Laboratory system of a charged particle.

The paper's Figure Magn: z points along B, and E lies in the plane of y and z, so that [E, B] lies along x. A path of
the particle, (93) and (98), drifts along [E, B] while it goes round B and is drawn along B.
"""

import numpy as np

from atlas.errors import DomainError
from atlas.motions.particle.kernel import ParticleMotion
from atlas.pictures import Arrow, Curve, Label, Layer, Points, Scene, Space
from atlas.pictures.captions import plain, plain_vector, tex, tex_vector
from atlas.pictures.quadric_panel import E1, E2, E3, O, in_plane, tolerance
from atlas.pictures.sample import curve

ROW = "a body"
SEEN = "A charged particle winds about the magnetic field."
LEAN = 0.55
"""Radians from the axis y at which a field nearer to it is drawn."""


def scene(
    *,
    mu: float = 1.0,
    E: tuple[float, float] = (0.12, 0.012),
    B: float = 1.0,
    c: float = 1.0,
    speed: float = 0.8,
    turns: float = 3.72,
    azimuth: float = 32.0,
    elevation: float = 18.0,
) -> Scene:
    """Show E = (0, E_y, E_z), B = (0, 0, B) and a path that starts at the origin with ``speed`` along x.

    ``mu`` is charge over mass, ``c`` the speed of light; the path lasts ``turns`` turns about B. Azimuth and
    elevation of the view are in degrees. Raises DomainError for B = 0 and mu = 0.
    """
    if not (B and mu):
        raise DomainError(f"figure magn needs a field B and a ratio mu that are not zero, not B = {B} and mu = {mu}.")
    particle = ParticleMotion(mu, (0.0, *E), (0.0, 0.0, B), (0.0, 0.0, 0.0), (speed, 0.0, 0.0), c)
    rough = particle.position(np.linspace(0.0, turns * particle.period, 200))
    span = float(np.ptp(rough, axis=0).max()) or 1.0
    sag = tolerance(0.5 * span)
    path = curve(particle.position, 0.0, turns * particle.period, sag, pieces=max(8, round(8 * turns)))
    reach = 0.55 * span
    strength = float(np.hypot(*E))
    layers: list[Layer] = [
        Curve(path, "trajectory"),
        Points(path[:1], "start"),
        Arrow(O, 1.15 * reach * E1, "basis", r"$x,\ \mathbf{e}_1$"),
        Arrow(O, 1.45 * reach * E2, "basis", r"$y,\ \mathbf{e}_2$"),
        Arrow(O, 1.75 * reach * E3, "basis", r"$z,\ \mathbf{e}_3$"),
        Arrow(O, float(np.sign(B)) * 1.3 * reach * E3, "field", r"$\mathbf{B}$", offset=(7.0, 0.0)),
    ]
    if strength > 0.0 and all(E):
        steep = abs(E[0]) < 2.0 * abs(E[1])
        leaning_field = E if steep else np.copysign((np.cos(LEAN), np.sin(LEAN)), E)
        tip = 1.1 * reach * in_plane(*(float(component) for component in leaning_field / np.linalg.norm(leaning_field)))
        flat, tall = tip[1] * E2, tip[2] * E3
        layers += [
            Arrow(O, tip, "electric", r"$\mathbf{E}$"),
            Arrow(O, flat, "component"),
            Arrow(flat, tip, "component"),
            Label(0.62 * flat, r"$\mathbf{E}_{\!\perp}$", offset=(0.0, -5.0)),
            Label(flat + 0.5 * tall, r"$\mathbf{E}_{\!\parallel}$", offset=(5.0, 0.0)),
        ]
    elif strength > 0.0:  # along an axis, E is one of its own components
        name = r"$\mathbf{E}=\mathbf{E}_{\!\perp}$" if E[0] else r"$\mathbf{E}=\mathbf{E}_{\!\parallel}$"
        offset = (0.0, -8.0) if E[0] else (-16.0, 0.0)
        tip = 0.9 * reach * in_plane(float(np.sign(E[0])), float(np.sign(E[1])))
        layers.append(Arrow(O, tip, "electric", name, offset=offset))
    side = "along" if E[0] * B > 0 else "against"
    drift = rf" and drifts along $[\mathbf{{E}}, \mathbf{{B}}]$, {side} the axis $x$" if E[0] else ""
    vector = tex_vector((0.0, *E))
    return Scene(
        caption=rf"The path begins at the origin{drift}. "
        rf"Laboratory system for a particle with $\mu={tex(mu)}$ in $\mathbf{{E}}={vector}$ and "
        rf"$\mathbf{{B}}=(0, 0, {tex(B)})$: $z$ points along the axis of $\mathbf{{B}}$, and $\mathbf{{E}}$ lies in "
        rf"the plane of $y$ and $z$. The arrows of the fields are not to scale.",
        alt=f"Axes x towards the reader, y to the right and z up; B = {plain(B)} along z, "
        f"E = {plain_vector((0.0, *E))} in the plane of y and z{' with its two components' if all(E) else ''}, and the "
        f"spiral path of a particle{f' that drifts {side} x' if E[0] else ''}.",
        panels=(Space(tuple(layers), azimuth=azimuth, elevation=elevation),),
        size=(100.0, 88.0),
    )
