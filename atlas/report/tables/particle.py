"""A charged particle in constant fields: its frequency, its drift, and where it is at some times."""

from typing import Any

import numpy as np

from atlas.errors import AtlasError
from atlas.report.body_and_field import BodyAndField
from atlas.report.digits import Number
from atlas.report.schema import StrictStruct, Vector
from atlas.report.tables.table import Column, Data, Request, certified, column, scaled


def exact_particle(case: BodyAndField, position: Any, velocity: Any) -> Any:
    """Return the centre of mass of a body in a field that was given as B and E, as a certified motion, (101)."""
    from atlas.exact.motions.particle import ParticleMotion

    if case.physical is None:
        raise AtlasError("this needs a field that is given as B (and E), not as B'.")
    p = case.physical
    if case.frame is not None and not (case.frame.matrix == np.eye(3)).all():
        raise AtlasError("give B in the laboratory frame: e3 along the body's axis, B in the plane of e2 and e3.")
    return ParticleMotion(p.mu, tuple(p.E), tuple(p.B), position, velocity, p.c)


class ParticleParameters(StrictStruct, frozen=True):
    """Times in s, position and velocity at t = 0."""

    times: tuple[float, ...]
    position: Vector = (0.0, 0.0, 0.0)
    velocity: Vector = (0.0, 0.0, 0.0)


def particle(request: Request) -> Data:
    """Position at some `times` of a particle with this `position` and `velocity` at t = 0, (93) and (98)."""
    asked, case = request.take(ParticleParameters), request.case
    made = exact_particle(case, asked.position, asked.velocity)
    unit = speed = case.units.length_unit if case.units else ""
    values = certified(lambda: [made.position(t) for t in asked.times], request.digits)
    omega, drift = certified(lambda: (made.cyclotron_frequency, list(made.drift)), request.digits)
    unit, columns = scaled(list(zip(*values, strict=True)), unit, request.digits)
    frequency = column([omega], request.digits)[0].tex().strip("$")
    drifts = ",\\ ".join(number.tex().strip("$") for number in column(drift, min(request.digits, 8)))
    return Data(
        (Column("$t$", "s"), *(Column(f"$y_{j}$", unit) for j in (1, 2, 3))),
        tuple(zip(map(Number.given, asked.times), *columns, strict=True)),
        "The path of the particle, @(101), in the laboratory frame.",
        (
            (
                rf"Cyclotron frequency $\omega={frequency}$ s$^{{-1}}$, drift "
                rf"$c[\mathbf{{E}},\mathbf{{B}}]/\mathbf{{B}}^2=({drifts})$ {speed} s$^{{-1}}$."
            ),
        ),
    )
