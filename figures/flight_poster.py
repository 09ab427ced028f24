"""The flight of a solenoid.

A charged solenoid drawn at equal steps of time on its flight through constant E and B: its centre runs on the path of a
point charge, (4), (99), and about the centre it turns by the elementary motion (84); the painted seam shows how.
"""

import numpy as np

from atlas.arithmetic.inputs import FloatArray, integer, number, positive, vector
from atlas.errors import DomainError
from atlas.motions.elementary.kernel import ElementaryMotion
from atlas.motions.particle.kernel import ParticleMotion
from atlas.pictures import Arrow, Curve, Label, Layer, Scene, Space
from atlas.pictures.bodies import proportions, solenoid
from atlas.pictures.captions import plain, plain_setting, plain_vector, quotient, tex, tex_setting, tex_vector
from atlas.pictures.layers import frame
from atlas.pictures.quadric_panel import E3, in_plane
from atlas.pictures.sample import curve, quarter_pixel

ROW = "a body"
SEEN = "In flight the body's axis goes round the field at a constant angle and a constant rate."
WIDTH, HEIGHT = 66.0, 88.0
AXIS, CORNER = 1.7, 0.22
"""How far an axis is drawn in units of the body, and the length of the fields' arrows as a part of the height."""
HEADS = (3.5, 10.5)
"""Where on the path an arrowhead shows its sense, in steps of time: where no body covers it."""

MAX_SIZES_PER_PATH = 1.25
"""Sizes of all bodies together, in lengths of the path; hidden lines are found for each pair of bodies that overlap."""


def scene(
    *,
    ratio: float = 0.8,
    field: tuple[float, float] = (0.45, 1.0),
    omega2: float = 0.62,
    mu: float = 1.0,
    c: float = 1.0,
    E: tuple[float, float, float] = (0.6, 0.0, 0.1),
    velocity: tuple[float, float, float] = (0.0, 6.2, -0.6),
    size: float = 0.8,
    count: int = 15,
    turns: float = 2.25,
    azimuth: float = 40.0,
    elevation: float = 30.0,
) -> Scene:
    """Draw ``count`` attitudes of a body of this ``size`` in ``turns`` of its centre; the centre starts at 0.

    ``ratio`` is I3/I2; ``field`` is (B2, B3) of B', and ``omega2`` that of the start, in 1/time. ``mu`` is charge
    over mass, ``c`` the speed of light, ``E`` the electric field and ``velocity`` that of the centre at t = 0, in
    the laboratory and in Gaussian units of the same lengths and times. ``azimuth`` and ``elevation`` of the view
    are in degrees. Raises DomainError without charge or field, for a loop, and for bodies that cover one another.
    """
    mu, c, size, count = number(mu, "mu"), positive(c, "c"), positive(size, "size"), integer(count, "count")
    I = quotient(ratio)
    if not (mu and any(field) and I < 2 and 2 <= count <= 60):
        raise DomainError(
            f"figure flight_poster needs a charge, a field, a solenoid (I < 2) and 2 to 60 attitudes, not mu = {mu:g}, "
            f"field = {field}, I = {I:g}, count = {count}."
        )
    B = 2 * c / mu * in_plane(*field)
    particle = ParticleMotion(mu, E, B, (0.0, 0.0, 0.0), vector(velocity, "velocity"), c)
    motion = ElementaryMotion(ratio, field, omega2)
    stop = positive(turns, "turns") * particle.period
    times = np.linspace(0.0, stop, count)
    centres, attitudes = particle.position(times), motion.rotation(times)
    path = float(np.linalg.norm(np.diff(centres, axis=0), axis=1).sum())
    if size * count > MAX_SIZES_PER_PATH * path:
        raise DomainError(
            f"figure flight_poster needs bodies that do not all cover one another: for {count} on a path of {path:.3g} "
            f"the size is at most {MAX_SIZES_PER_PATH * path / count:.3g}, not {size:g}."
        )
    sag = quarter_pixel(float(np.ptp(centres, axis=0).max()), HEIGHT)
    end = 0.5 * size * proportions(I)[1]
    layers: list[Layer] = [Curve(curve(particle.position, 0.0, stop, sag, pieces=64), "flight_path")]
    for between in HEADS:  # the sense of the flight
        tail, tip = particle.position(stop / (count - 1) * np.array([between - 0.2, between + 0.2]))
        layers.append(Arrow(tail, tip, "flight_path"))
    layers.append(Label(centres[0] - size * E3, "start", "label", (0.0, -6.0)))
    sight = frame(Space((), azimuth=azimuth, elevation=elevation))[2]
    for i in np.argsort(centres @ sight):  # from the farthest to the nearest, as they cover one another
        centre, R = centres[i], attitudes[i]
        layers += solenoid(I, R, centre, size, sag)
        layers.append(Arrow(centre + end * R[:, 2], centre + AXIS * size * R[:, 2], "body_axis"))
    layers += fields(B, np.asarray(E, dtype=float), centres, size, (azimuth, elevation))
    return Scene(
        caption=(
            rf"The flight of {tex_setting(ratio, field)}, $\mu={tex(mu)}$, $c={tex(c)}$, through "
            rf"$\mathbf{{E}}={tex_vector(E)}$, launched with the velocity ${tex_vector(velocity)}$ and "
            rf"$\omega_2={tex(omega2)}$, at {count} equal steps of time."
        ),
        alt=(
            f"{count} drawings of {plain_setting(ratio, field)} with omega 2 = {plain(omega2)} along a helix that "
            f"widens upwards in the electric field {plain_vector(E)}: an open cylinder with windings and a dark seam, "
            "its axis leaning now to one side, now to another, always at one angle to the magnetic field."
        ),
        panels=(Space(tuple(layers), azimuth=azimuth, elevation=elevation),),
        size=(WIDTH, HEIGHT),
    )


def fields(B: FloatArray, E: FloatArray, centres: FloatArray, size: float, eye: tuple[float, float]) -> list[Layer]:
    """Return an arrow along each nonzero field, as layers, in the lower right corner of the bodies on paper.

    `B` and `E` are (3,), `centres` (N, 3) those of the bodies of this `size`, `eye` is (azimuth, elevation) in degrees.
    """
    view = frame(Space((), azimuth=eye[0], elevation=eye[1]))
    flat = centres @ view.T
    length = CORNER * float(np.ptp(flat[:, 1]))
    corner = np.array([flat[:, 0].max() - 0.4 * length, flat[:, 1].min() - size, 0.0]) @ view
    named = ((B, "field", r"$\mathbf{B}$"), (E, "electric", r"$\mathbf{E}$"))
    return [
        Arrow(corner, corner + length * field_vector / np.linalg.norm(field_vector), role, name)
        for field_vector, role, name in named
        if field_vector.any()
    ]
