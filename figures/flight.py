"""Flight of a point of the body.

The path y_N(t) = y_0(t) + R(t) x_N(0), as below (18): the centre of mass flies as a charged particle, (4), and the
body turns about it by the elementary motion (84). Both feel one magnetic field, B = 2 c B'/mu, (32).
"""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import TypeAlias

import numpy as np

from atlas.core.elementary import ElementaryMotion
from atlas.core.flight import Flight
from atlas.core.inputs import FloatArray, number, positive, vector
from atlas.core.particle import ParticleMotion
from atlas.errors import DomainError
from atlas.scene import Arrow, Curve, Layer, Plane, Points, Scene, Space
from atlas.scene.camera import frame
from atlas.scene.captions import plain_setting, plain_vector, tex, tex_equals, tex_setting, tex_vector, title
from atlas.scene.hyperbola_plane import components
from atlas.scene.movement import along
from atlas.scene.sample import curve, quarter_pixel

WIDTH, HEIGHT = 178.0, 60.0
VIEW = Space((), azimuth=35.0, elevation=20.0, title="(a) in space")
MANY = 200
ASKEW = 25.0
CLEAR = 0.6
"""The arrows of the fields keep off the paths by this part of their length."""
Paths: TypeAlias = tuple[FloatArray, FloatArray, FloatArray]


def scene(
    *,
    ratio: float = 1.5,
    field: tuple[float, float] = (1.0, 2.0),
    omega2: float = -1.5,
    omega3: float | None = None,
    mu: float = 1.0,
    c: float = 1.0,
    E: tuple[float, float, float] = (-2.0, 0.0, 0.0),
    velocity: tuple[float, float, float] = (1.0, 0.5, 0.5),
    point: tuple[float, float, float] = (0.0, 0.3, 0.2),
    turns: float = 3.5,
    stop: float | None = None,
    unit: str = "length",
) -> Scene:
    """Draw the paths of the centre of mass and of x_N(0) = ``point``, for ``turns`` of the former or up to ``stop``."""
    mu, c, turns = number(mu, "mu"), positive(c, "c"), positive(turns, "turns")
    B2, B3 = components(field)
    if mu == 0:
        raise DomainError("A body with mu = 0 feels no field; give it a charge.")
    B = 2 * c / mu * np.array([0.0, B2, B3])
    particle = ParticleMotion(mu, E, B, (0.0, 0.0, 0.0), vector(velocity, "velocity"), c)
    motion = ElementaryMotion(ratio, field, omega2, omega3)
    flight = Flight(particle, motion, point)
    stop = turns * particle.period if stop is None else positive(stop, "stop")
    spun = (abs(motion.k) + abs(motion.phi)) * stop / (2 * np.pi) + stop / particle.period
    if not spun < MANY:
        raise DomainError(f"In this flight the body makes {spun:.3g} turns, and more than {MANY} cannot be drawn.")
    axes, view = across(flight, B), beside(flight, stop)
    drawn = paths(flight, axes, view, stop)
    return Scene(
        title=title(__doc__),
        caption=(
            rf"The flight of a point $\mathbf{{x}}_N={tex_vector(point)}$ of {tex_setting(ratio, field)}, "
            rf"$\mathbf{{E}}={tex_vector(E)}$, with $\omega_2={tex(motion.omega2)}$, "
            rf"$k{tex_equals(motion.k)}$ and $\phi{tex_equals(motion.phi)}$; the centre of mass circles with "
            rf"$2\lvert\mathbf{{B}}'\rvert{tex_equals(abs(particle.cyclotron_frequency))}$. (a) In space. (b) Along "
            r"$\mathbf{B}$. Thin lines join centre and point at equal steps of time."
        ),
        alt=(
            f"Two panels with the path of a point of {plain_setting(ratio, field)} in the electric field "
            f"{plain_vector(E)}: a curve that winds round the path of the centre of mass, drawn in space and projected "
            "on the plane across the magnetic field."
        ),
        panels=(space(flight, B, view, drawn), projection(flight, axes, drawn, unit)),
        columns=2,
        named={"Thin lines": "guide"},
        size=(WIDTH, HEIGHT),
        paths={
            "centre": partial(carried, particle.position, np.eye(3)),
            "point": partial(carried, flight.position, np.eye(3)),
            "centre below": partial(carried, particle.position, axes),
            "point below": partial(carried, flight.position, axes),
            "arm": partial(swung, flight),
        },
        lasts=stop,
    )


def carried(
    position: Callable[[FloatArray], FloatArray], axes: FloatArray, t: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return how a mark goes along a path, as it is seen along these axes (columns)."""
    return along(position(t) @ axes, position(np.zeros(1))[0] @ axes)


def swung(flight: Flight, t: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return how what is fixed in the body flies: its centre goes along, and it turns."""
    start = flight.particle.position(np.zeros(1))[0]
    turns = flight.motion.rotation(t)
    return turns, flight.particle.position(t) - turns @ start


def across(flight: Flight, B: FloatArray) -> FloatArray:
    """Return the axes of panel (b) as columns: x along the drift [E, B], or along e1 where there is none."""
    drifts = bool(flight.particle.drift.any())
    first = flight.particle.axes[0] if drifts else np.array([1.0, 0.0, 0.0])
    return np.stack([first, np.cross(B / np.linalg.norm(B), first)], axis=1)


def beside(flight: Flight, stop: float) -> Space:
    """Return the view of panel (a): nearly across the way that the centre of mass goes, so that it fills the panel."""
    way = np.diff(flight.particle.position(np.array([0.0, stop])), axis=0)[0]
    return replace(VIEW, azimuth=float(np.degrees(np.arctan2(-way[0], way[1]))) + ASKEW) if way[:2].any() else VIEW


def paths(flight: Flight, axes: FloatArray, view: Space, stop: float) -> Paths:
    """Return the path of the centre of mass, that of the point, and the arms between them, (M, 2, 3), for both panels.

    They are as fine as the panel asks for in which they are larger.
    """
    rough = flight.position(np.linspace(0.0, stop, 257))
    extents = (np.ptp(rough @ seen, axis=0) / [WIDTH / 2, HEIGHT] for seen in (frame(view)[:2].T, axes))
    fine = quarter_pixel(min(float(extent.max()) for extent in extents), 1.0)
    centre = curve(flight.particle.position, 0.0, stop, fine, pieces=64)
    point = curve(flight.position, 0.0, stop, fine, pieces=64)
    times = np.linspace(0.0, stop, 33)
    return centre, point, np.stack([flight.particle.position(times), flight.position(times)], axis=1)


def space(flight: Flight, B: FloatArray, view: Space, drawn: Paths) -> Space:
    """Panel (a): the paths in space, with the directions of the fields to the left of them."""
    layers, seen = bundle(*drawn)
    layers.append(Curve(drawn[2][0], "velocity", rides="arm"))
    eye = frame(view)
    flat = seen @ eye.T
    length = 0.25 * float(np.ptp(flat, axis=0).max())
    named = ((B, "field", r"$\mathbf{B}$"), (flight.particle.E, "electric", r"$\mathbf{E}$"))
    arrows = [(length * field / np.linalg.norm(field), role, name) for field, role, name in named if np.any(field)]
    ends = np.array([eye @ arrow for arrow, _, _ in arrows])
    left, low = flat.min(axis=0)[:2]
    corner = np.array([left - max(0.0, *ends[:, 0]) - CLEAR * length, low - min(0.0, *ends[:, 1]), 0.0]) @ eye
    layers += [Arrow(corner, corner + arrow, role, name) for arrow, role, name in arrows]
    return replace(view, layers=tuple(layers))


def projection(flight: Flight, axes: FloatArray, drawn: Paths, unit: str) -> Plane:
    """Panel (b): the paths on the plane across B."""
    centre, point, arms = (path @ axes for path in drawn)
    layers, _ = bundle(centre, point, arms, ("centre of mass", "point"), " below")
    drifts = bool(flight.particle.drift.any())
    along = r"[\mathbf{E},\mathbf{B}]" if drifts else r"\mathbf{e}_1"
    across = r"\mathbf{E}_\perp" if drifts else r"[\hat{\mathbf{B}},\mathbf{e}_1]"
    return Plane(
        tuple(layers),
        rf"along ${along}$ ({unit})",
        rf"along ${across}$ ({unit})",
        equal=True,
        legend="beside",
        title=r"(b) across $\mathbf{B}$",
    )


def bundle(
    centre: FloatArray, point: FloatArray, arms: FloatArray, names: tuple[str, str] = ("", ""), where: str = ""
) -> tuple[list[Layer], FloatArray]:
    """Return the layers of the two paths and the arms between them, and all their points."""
    layers: list[Layer] = [Curve(arm, "guide") for arm in arms]
    layers += [
        Curve(centre, "fourth", names[0]),
        Curve(point, "trajectory", names[1]),
        Points(point[:1], "start", rides=f"point{where}"),
        Points(centre[:1], "fourth", rides=f"centre{where}"),
    ]
    return layers, np.concatenate([centre, point])
