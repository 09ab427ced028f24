"""A charged ball, a charged particle and a body that flies: frequencies, the drift, where they are at some times."""

from typing import Any

import numpy as np

from atlas.book.body_and_field import BodyAndField
from atlas.book.digits import Number
from atlas.book.schema import StrictStruct, Vector
from atlas.book.tables.table import RATE, Data, Request, certified, column, heads, quantity, scaled
from atlas.errors import AtlasError


def exact_particle(case: BodyAndField, position: Any, velocity: Any) -> Any:
    """Return the certified `ParticleMotion` (101) of a body's centre of mass.

    `position` and `velocity` (3,) are those at t = 0 in the laboratory, in the units of the field's system. Raises
    AtlasError for a field that is not given as B, and for a laboratory frame that is not along the body's axes.
    """
    from atlas.motions.particle.certified import ParticleMotion

    if case.physical is None:
        raise AtlasError("this needs a field that is given as B (and E), not as B'.")
    p = case.physical
    if case.frame is not None and not (case.frame.matrix == np.eye(3)).all():
        raise AtlasError("give B in the laboratory frame: e3 along the body's axis, B in the plane of e2 and e3.")
    return ParticleMotion(p.mu, tuple(p.E), tuple(p.B), position, velocity, p.c)


class ParticleParameters(StrictStruct, frozen=True):
    """Parameters of the table `particle`: times in s, position and velocity (3,) at t = 0 in the field's units."""

    times: tuple[float, ...]
    position: Vector = (0.0, 0.0, 0.0)
    velocity: Vector = (0.0, 0.0, 0.0)


def particle(request: Request, setup: ParticleParameters) -> Data:
    """Return the table of positions, at the `times`, of a particle with `position`, `velocity` at t = 0, (93), (98).

    A row has t in s and three components in the laboratory, in the field's unit of length; cyclotron frequency and
    drift stand below. Raises AtlasError for a field that is not given as B.
    """
    case = request.case
    motion = exact_particle(case, setup.position, setup.velocity)
    unit = speed = case.units.length_unit if case.units else ""
    values = certified(lambda: [motion.position(t) for t in setup.times], request.digits)
    omega, drift = certified(lambda: (motion.cyclotron_frequency, list(motion.drift)), request.digits)
    unit, columns = scaled(list(zip(*values, strict=True)), unit, request.digits)
    frequency = column([omega], request.digits)[0].tex().strip("$")
    drifts = ",\\ ".join(number.tex().strip("$") for number in column(drift, min(request.digits, 8)))
    return Data(
        heads(("$t$", "s"), *((f"$y_{j}$", unit) for j in (1, 2, 3))),
        tuple(zip(map(Number.as_given, setup.times), *columns, strict=True)),
        "The path of the particle, @(101), in the laboratory frame.",
        (
            (
                rf"Cyclotron frequency $\omega={frequency}$ s$^{{-1}}$, drift "
                rf"$c[\mathbf{{E}},\mathbf{{B}}]/\mathbf{{B}}^2=({drifts})$ {speed} s$^{{-1}}$."
            ),
        ),
    )


class BallParameters(StrictStruct, frozen=True):
    """Parameters of the table `ball`: initial angular velocity (0, omega2, omega3) and Larmor's frequency, in 1/s."""

    omega2: float
    omega3: float
    larmor: float


def ball(request: Request, setup: BallParameters) -> Data:
    """Return the table of alpha, gamma, k_hat of a ball that starts with (0, omega2, omega3) in a field along e3.

    The ball is a body with three equal moments. alpha is Larmor's frequency, gamma the rate of the turn about the unit
    vector k_hat = (0, k2, k3), both in 1/s, (29). The columns are name, symbol, value and unit. Raises AtlasError for
    alpha = 0.
    """
    from atlas.motions.elementary.certified_ball import BallMotion

    if setup.larmor == 0:
        raise AtlasError("the ball's table is about a ball in a field: larmor must not be zero.")
    motion = BallMotion(1, setup.larmor, (setup.omega2, setup.omega3))
    gamma, k_hat = certified(lambda: (motion.gamma, motion.k_hat), request.digits)
    rows = (
        ("initial angular velocity", r"$m_2/I_0$", motion.m2, RATE),
        ("", r"$m_3/I_0$", motion.m3, RATE),
        ("Larmor's frequency @(27)", r"$\alpha$", motion.larmor, RATE),
        ("frequency of the turn about $\\hat{\\mathbf{k}}$, @(29)", r"$\gamma$", gamma, RATE),
        ("axis of that turn, @(29)", r"$\hat k_2$", k_hat[0], "1"),
        ("", r"$\hat k_3$", k_hat[1], "1"),
    )
    return Data(
        heads("Quantity", "Symbol", "Value", "Unit"),
        tuple((name, symbol, quantity(value, request.digits), unit) for name, symbol, value, unit in rows),
        r"The general motion of the ball, @(28), in a field along $\mathbf{e}_3$.",
    )


class FlightParameters(StrictStruct, frozen=True):
    """Parameters of the table `flight`: omega2 of the elementary motion in 1/s, times in s, and three vectors.

    `point` is the vector from the body's centre of mass to the point at t = 0, `position` and `velocity` are those of
    the centre at t = 0, all in the laboratory, in the field's units.
    """

    omega2: float
    times: tuple[float, ...]
    point: Vector
    position: Vector = (0.0, 0.0, 0.0)
    velocity: Vector = (0.0, 0.0, 0.0)


def flight(request: Request, setup: FlightParameters) -> Data:
    """Return the table of positions y_0(t), y_N(t) = y_0(t) + R(t) x_N(0) at the `times`, in figure Lssc's frame.

    That is the laboratory frame with e3 along the body's axis at t = 0 and B in the plane of e2 and e3. y_0 is the
    body's centre of mass and x_N(0) its `point`. A row has t in s, three components of y_0 and three of y_N, in the
    field's unit of length. Raises AtlasError for a field that is not given as B.
    """
    from atlas.motions.elementary.certified import ElementaryMotion
    from atlas.motions.particle.certified import Flight

    case = request.case
    motion = exact_particle(case, setup.position, setup.velocity)
    turning = ElementaryMotion(case.exact, case.components, setup.omega2)
    path = Flight(motion, turning, setup.point)
    unit = case.units.length_unit if case.units else ""
    values = certified(lambda: [(*motion.position(t), *path.position(t)) for t in setup.times], request.digits)
    unit, columns = scaled(list(zip(*values, strict=True)), unit, request.digits)
    return Data(
        heads(
            ("$t$", "s"), *((f"$y_{{0,{j}}}$", unit) for j in (1, 2, 3)), *((f"$y_{{N,{j}}}$", unit) for j in (1, 2, 3))
        ),
        tuple(zip(map(Number.as_given, setup.times), *columns, strict=True)),
        r"The flight of the centre of mass $\mathbf{y}_0$, @(101), and of the point $\mathbf{y}_N$ of the body.",
    )
