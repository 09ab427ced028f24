"""The motion of a charged particle.

The path in constant fields, (93) to (99): round the magnetic field with the frequency mu |B|/c, along it with constant
acceleration, and adrift across both fields.
"""

from dataclasses import replace

import numpy as np

from atlas.arithmetic.inputs import positive
from atlas.motions.particle.kernel import ParticleMotion
from atlas.pictures import Arrow, Curve, Layer, Points, Scene, Space
from atlas.pictures.any_motion import course
from atlas.pictures.captions import plain, plain_vector, tex, tex_equals, tex_vector
from atlas.pictures.flight import scale_bar
from atlas.pictures.layers import frame
from atlas.pictures.quadric_panel import tolerance
from atlas.pictures.sample import curve

ROW = "a body"
SEEN = "A charged particle circles about a magnetic field and drifts in an electric field across it."
SIZE = (124.0, 66.0)
Vector = tuple[float, float, float]


def scene(
    *,
    mu: float = 1.0,
    electric: Vector = (0.2, 0.5, 0.03),
    magnetic: Vector = (0.0, 0.0, 1.0),
    position: Vector = (0.0, 0.0, 0.0),
    velocity: Vector = (1.0, 0.0, 0.0),
    c: float = 1.0,
    turns: float = 3.0,
    azimuth: float = -65.0,
    elevation: float = 28.0,
    unit: str = "time",
    length: str = "length",
) -> Scene:
    """Draw path and velocity of a particle over ``turns`` turns about the magnetic field.

    Without that field a turn is the time in which E doubles or makes the speed. ``mu`` is charge over mass,
    ``electric`` and ``magnetic`` are the fields, ``position`` and ``velocity`` those at t = 0, ``c`` is the speed
    of light. Azimuth and elevation of the view are in degrees; ``unit`` and ``length`` are the words for the units
    of time and length.
    """
    particle = ParticleMotion(mu, electric, magnetic, position, velocity, c)
    stop = positive(turns, "turns") * _unit_of_time(particle)
    pieces = max(32, round(12 * turns))
    rough = particle.position(np.linspace(0.0, stop, 8 * pieces + 1))
    span = float(np.ptp(rough, axis=0).max()) or 1.0
    line = curve(particle.position, 0.0, stop, tolerance(span), pieces=pieces)
    view = Space((), azimuth=azimuth, elevation=elevation, title="(a) path")
    eye = frame(view)
    corner = ((line @ eye.T).min(axis=0) - (0.0, 0.1 * span, 0.0)) @ eye
    layers: list[Layer] = [Curve(line, "trajectory"), Points(line[:1], "start")]
    layers += scale_bar(corner, eye[0], 0.3 * span, length)
    for vector, role, name in ((magnetic, "field", r"$\mathbf{B}$"), (electric, "electric", r"$\mathbf{E}$")):
        if any(vector):
            layers.append(Arrow(line[0], line[0] + 0.4 * span * np.array(vector) / np.linalg.norm(vector), role, name))
    fields = rf"$\mathbf{{E}}={tex_vector(electric)}$, $\mathbf{{B}}={tex_vector(magnetic)}$"
    until = tex_equals(float(f"{stop:.3g}"))
    return Scene(
        caption=rf"(a) The path of a particle ({particle.kind}) up to $t{until}$; the "
        rf"arrows are not to scale. (b) Its velocity, at the dot "
        rf"${tex_vector(velocity)}$. {particle.case.capitalize()}: $\mu={tex(mu)}$, {fields}.",
        alt=f"The path in space of a particle with mu = {plain(mu)} in E = {plain_vector(electric)} and B = "
        f"{plain_vector(magnetic)}, and the three components of its velocity over time.",
        panels=(
            replace(view, layers=tuple(layers)),
            course(
                particle.velocity, tuple(f"$v_{i}$" for i in (1, 2, 3)), stop, f"$t$ ({unit})",
                rf"$\mathbf{{v}}$ ({length}/{unit})", "(b) velocity", size=(SIZE[0] / 2, SIZE[1]), pieces=pieces,
            ),
        ),
        columns=2,
        size=SIZE,
    )  # fmt: skip


def _unit_of_time(particle: ParticleMotion) -> float:
    """Return the period of the turn about B; without B the initial speed over the acceleration by E.

    A particle at rest in E has 1/sqrt(acceleration), a free particle 1.
    """
    if particle.cyclotron_frequency:
        return abs(float(particle.period))
    acceleration, speed = abs(particle.mu) * float(np.linalg.norm(particle.E)), float(np.linalg.norm(particle.v0))
    return (speed / acceleration if speed else acceleration**-0.5) if acceleration else 1.0
