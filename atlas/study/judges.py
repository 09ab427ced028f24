"""Judges: each takes one hostile input, asks the kernels for every quantity, and tallies the errors against balls."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from fractions import Fraction
from functools import partial
from itertools import chain
from typing import Any

import numpy as np
from flint import ctx

from atlas.core.ball import BallMotion
from atlas.core.body import SymmetricBody
from atlas.core.elementary import ElementaryMotion, FreeMotion
from atlas.core.hyperbola import Hyperbola
from atlas.core.particle import ParticleMotion
from atlas.core.quadric import Quadric
from atlas.errors import AtlasError
from atlas.exact import ball as exact_ball
from atlas.exact import elementary as exact_elementary
from atlas.exact import free as exact_free
from atlas.exact import hyperbola as exact_hyperbola
from atlas.exact import particle as exact_particle
from atlas.exact import quadric as exact_quadric
from atlas.exact.digits import enclosed
from atlas.study import hostile
from atlas.study.ulps import ONE, Refusal, Tally, absolute, approximate, error, of_length, own

BITS = 80
"""Relative accuracy of the truth: a 2^-27th of a double's."""

SHIFTS = (1, -7, 60)
"""Powers of two by which all frequencies are scaled, and times the other way: no bit of R may change."""

POINTS = 8
"""Points of each hyperbola."""

GRID = 300
"""Matrices on a uniform grid; a few of them are judged."""


def judge_motion(motion: hostile.Motion, regime: str, tally: Tally) -> None:
    """Judge an elementary motion: scalars, matrix, vectors and the structure of the matrix."""
    inputs = _described(motion)
    with _refusals(tally, "elementary motion", regime, inputs), ctx.workprec(BITS + 16):
        exact = exact_elementary.ElementaryMotion(
            _body(motion.I2, motion.I3), (motion.B2, motion.B3), motion.omega2, motion.omega3
        )
        found = ElementaryMotion(_ratio(motion), (motion.B2, motion.B3), motion.omega2, motion.omega3)
        k, phi, omega3 = enclosed(lambda: (exact.k, exact.phi, exact.omega3), BITS)
        for name, true in (("k", k), ("phi", phi), ("omega3", omega3)):
            tally.add(name, regime, own([getattr(found, name)], [true]), _with(inputs))
        _structure(motion, found, regime, tally, inputs)
        fastest = max(abs(approximate(k)), abs(approximate(phi)))
        times = np.array(motion.times)
        methods: list[tuple[str, Callable[[Any], Any], Callable[[Any], Any]]] = [
            ("Omega", found.angular_velocity, exact.angular_velocity),
            ("K", found.field_in_body, exact.field_in_body),
            ("m", found.angular_momentum, exact.angular_momentum),
        ]
        for name, kernel, ball in methods:
            values = kernel(times)
            for t, value in zip(motion.times, values, strict=True):
                true = enclosed(partial(ball, t), BITS)
                where = f"{regime}, {hostile.clock(fastest, t)}"
                tally.add(name, where, [of_length(value, true)], _with(inputs, t=t.hex()))
        R, axis = found.rotation(times), found.third_axis(times)
        _orthogonality(R, motion.times, regime, tally, inputs)
        for i, t in enumerate(motion.times):
            where = f"{regime}, {hostile.clock(fastest, t)}"
            true = enclosed(partial(exact.rotation, t), BITS)
            tally.add("R", where, absolute(R[i].flat, chain(*true)), _with(inputs, t=t.hex()))
            third = [row[2] for row in true]
            tally.add("third axis", where, absolute(axis[i], third), _with(inputs, t=t.hex()))
            if abs(approximate(k) * t) < 1:
                small = own([*R[i, :2, 2], *axis[i, :2]], third[:2] * 2)
                tally.add("R13, R23 for |kt| < 1", where, small, _with(inputs, t=t.hex()))
        _grid(motion, found, exact, regime, tally, inputs)


def judge_hyperbola(motion: hostile.Motion, regime: str, tally: Tally) -> None:
    """Judge the hyperbola at the motion's omega2: ordinate, frequencies, stability."""
    inputs = _described(motion)
    if motion.omega2 == -motion.B2 or motion.B2 == 0:
        return
    with _refusals(tally, "hyperbola", regime, inputs), ctx.workprec(BITS + 16):
        exact = exact_hyperbola.Hyperbola(_body(motion.I2, motion.I3), (motion.B2, motion.B3))
        found = Hyperbola(_ratio(motion), (motion.B2, motion.B3))
        k, phi = found.frequencies(motion.omega2)
        true_k, true_phi = enclosed(lambda: exact.frequencies(motion.omega2), BITS)
        pairs = (
            ("omega3 of the hyperbola", found.omega3(motion.omega2), exact.omega3(motion.omega2)),
            ("k of the hyperbola", k, true_k),
            ("phi of the hyperbola", phi, true_phi),
            ("stability", found.stability(motion.omega2), exact.stability(motion.omega2)),
        )
        for name, value, true in pairs:
            tally.add(name, regime, own([value], [true]), _with(inputs))
        if motion.B3:
            points = [(x, y) for x, y in zip(*found.sample(POINTS), strict=True) if np.isfinite(y)]
            errors = own((y for _, y in points), (exact.omega3(x) for x, _ in points))
            tally.add("points of the hyperbola", regime, errors, lambda i: inputs | {"at": float(points[i][0]).hex()})


def judge_free(motion: hostile.Free, tally: Tally) -> None:
    """Judge a free body with any initial angular velocity."""
    inputs = _described(motion)
    with _refusals(tally, "free body", "free body", inputs), ctx.workprec(BITS + 16):
        exact, found = exact_free.FreeMotion(motion.I, motion.omega), FreeMotion(motion.I, motion.omega)
        k, phi = enclosed(lambda: (exact.k, exact.phi), BITS)
        tally.add("free k", "free body", own([found.k], [k]), _with(inputs))
        tally.add("free phi", "free body", own([found.phi], [phi]), _with(inputs))
        fastest = max(abs(approximate(k)), abs(approximate(phi)))
        R, Omega = found.rotation(np.array(motion.times)), found.angular_velocity(np.array(motion.times))
        for i, t in enumerate(motion.times):
            where = f"free body, {hostile.clock(fastest, t)}"
            true = enclosed(partial(_both, exact.rotation, exact.angular_velocity, t), BITS)
            tally.add("free R", where, absolute(R[i].flat, chain(*true[0])), _with(inputs, t=t.hex()))
            tally.add("free Omega", where, [of_length(Omega[i], true[1])], _with(inputs, t=t.hex()))


def judge_quadric(motion: hostile.Motion, regime: str, tally: Tally) -> None:
    """Judge the quadric of the motion's body and field."""
    inputs = _described(motion)
    with _refusals(tally, "quadric", regime, inputs), ctx.workprec(BITS + 16):
        exact = exact_quadric.Quadric(_body(motion.I2, motion.I3), (motion.B2, motion.B3))
        found = Quadric(_ratio(motion), (motion.B2, motion.B3))
        pairs = (
            ("beta", [found.beta], lambda: [exact.beta]),
            ("a2", [found.a2], lambda: [exact.a2]),
            ("a3", [found.a3], lambda: [exact.a3]),
            ("semi-axes", found.semi_axes, lambda: exact.semi_axes),
            ("canonical axes", np.ravel(found.axes), lambda: list(chain(*exact.axes))),
        )
        for name, values, ball in pairs:
            tally.add(name, regime, own(values, enclosed(ball, BITS)), _with(inputs))


def judge_ball(ball: hostile.Ball, tally: Tally) -> None:
    """Judge a charged ball: axis, frequency, matrix, momentum."""
    inputs = _described(ball)
    with _refusals(tally, "ball", "ball", inputs), ctx.workprec(BITS + 16):
        exact = exact_ball.BallMotion(ball.inertia, ball.larmor, (ball.m2, ball.m3))
        found = BallMotion(ball.inertia, ball.larmor, momentum=(ball.m2, ball.m3))
        gamma, k_hat = enclosed(lambda: (exact.gamma, exact.k_hat), BITS)
        tally.add("ball gamma", "ball", own([found.gamma], [gamma]), _with(inputs))
        tally.add("ball k_hat", "ball", own(found.k_hat, k_hat), _with(inputs))
        fastest = max(abs(approximate(gamma)), abs(ball.larmor))
        times = np.array(ball.times)
        R, m, Omega = found.rotation(times), found.angular_momentum(times), found.angular_velocity(times)
        for i, t in enumerate(ball.times):
            where = f"ball, {hostile.clock(fastest, t)}"
            true = enclosed(partial(_both, exact.rotation, exact.angular_momentum, t), BITS)
            tally.add("ball R", where, absolute(R[i].flat, chain(*true[0])), _with(inputs, t=t.hex()))
            tally.add("ball m", where, [of_length(m[i], true[1])], _with(inputs, t=t.hex()))
            true = enclosed(partial(exact.angular_velocity, t), BITS)
            tally.add("ball Omega", where, [of_length(Omega[i], true)], _with(inputs, t=t.hex()))


def judge_particle(particle: hostile.Particle, tally: Tally) -> None:
    """Judge a point charge, in ulps of the largest length (speed) that its start and its forces make by that time."""
    inputs = _described(particle)
    arguments = (particle.mu, particle.E, particle.B, particle.position, particle.velocity, particle.c)
    with _refusals(tally, "particle", "particle", inputs), ctx.workprec(BITS + 16):
        exact, found = exact_particle.ParticleMotion(*arguments), ParticleMotion(*arguments)
        y, v = found.position(np.array(particle.times)), found.velocity(np.array(particle.times))
        pull, speed = (np.linalg.norm(x) for x in (np.multiply(particle.mu, particle.E), particle.velocity))
        for i, t in enumerate(particle.times):
            true = enclosed(partial(_both, exact.position, exact.velocity, t), BITS)
            reach = np.linalg.norm(particle.position) + abs(t) * (speed + abs(t) * pull)
            units = np.spacing(float(reach)), np.spacing(float(speed + abs(t) * pull))
            where = f"particle, {hostile.clock(abs(particle.mu) * float(np.linalg.norm(particle.B)), t)}"
            for name, values, balls, unit in zip(("particle y", "particle v"), (y[i], v[i]), true, units, strict=True):
                errors = [error(a, b, unit) for a, b in zip(values, balls, strict=True)]
                tally.add(name, where, errors, _with(inputs, t=t.hex()))


def _structure(motion: hostile.Motion, found: Any, regime: str, tally: Tally, inputs: Any) -> None:
    """Judge what must hold to the bit: R(0) = 1, and R unchanged when all frequencies are scaled by a power of two."""
    start = np.abs(found.rotation(np.array([0.0, -0.0])) - np.eye(3)).max() / ONE
    tally.add("R(0) = 1", regime, [float(start)], _with(inputs))
    times = np.array(motion.times)
    for shift in SHIFTS:
        parts = (motion.B2, motion.B3, motion.omega2, motion.omega3 or 0.0)
        scaled = [float(np.ldexp(x, shift)) for x in parts]
        slow = np.ldexp(times, -shift)
        if any(np.ldexp(x, -shift) != y for x, y in zip(scaled, parts, strict=True)):
            continue  # a part would leave the range of doubles
        exactly = np.ldexp(slow, shift) == times
        other = ElementaryMotion(
            _ratio(motion), (scaled[0], scaled[1]), scaled[2], None if motion.omega3 is None else scaled[3]
        )
        # the same number of times in both: a matrix product may round its last rows in another way
        before, after = found.rotation(times[exactly]), other.rotation(slow[exactly])
        normal = np.abs(before) >= np.finfo(float).tiny  # smaller entries have lost bits to underflow
        changed = np.abs(after - before).max(initial=0.0, where=normal) / ONE
        tally.add("R under scaling by 2^n", regime, [float(changed)], _with(inputs, n=shift))


def _orthogonality(R: Any, times: Sequence[float], regime: str, tally: Tally, inputs: Any) -> None:
    """Judge R^T R = 1 and det R = 1, evaluated in extended precision."""
    long = R.astype(np.longdouble)
    defect = np.abs(np.swapaxes(long, -1, -2) @ long - np.eye(3, dtype=np.longdouble)).max(axis=(-1, -2))
    determinant = np.einsum("ni,ni->n", long[:, 0], np.cross(long[:, 1], long[:, 2])) - 1
    for name, values in (("R orthogonality", defect), ("R determinant", np.abs(determinant))):
        errors = [float(x / np.longdouble(ONE)) for x in values]
        tally.add(name, regime, errors, lambda i: inputs | {"t": times[i].hex()})


def _grid(motion: hostile.Motion, found: Any, exact: Any, regime: str, tally: Tally, inputs: Any) -> None:
    """Judge a uniform grid at its ends, at its seams and in between, at the exact times start + i step."""
    start, end = motion.times[4], motion.times[5]
    step = (end - start) / GRID
    if step == 0 or start + GRID * step == start:
        return
    R = found.rotation_grid(start, step, GRID)
    for i in (0, 1, 2, 15, 16, 31, 100, 127, 128, 255, 256, GRID - 1):
        t = Fraction(start) + i * Fraction(step)
        true = enclosed(partial(exact.rotation, t), BITS)
        where = {"start": start.hex(), "step": step.hex(), "count": GRID, "index": i}
        tally.add("R grid", regime, absolute(R[i].flat, chain(*true)), _with(inputs, **where))


@contextmanager
def _refusals(tally: Tally, quantity: str, regime: str, inputs: Any) -> Iterator[None]:
    """Keep what a kernel says when it will not answer."""
    try:
        yield
    except AtlasError as reason:
        tally.refusals.append(Refusal(quantity, regime, str(reason), inputs))


def _described(record: Any) -> dict[str, Any]:
    """Return an input without its times, as hexadecimal text."""
    return {
        name: [x.hex() for x in value] if isinstance(value, tuple) else value.hex()
        for name, value in vars(record).items()
        if name != "times" and value is not None
    }


def _with(inputs: dict[str, Any], **more: Any) -> Callable[[int], dict[str, Any]]:
    """Return the description of an input with more of it, whichever of the values was the worst."""
    return lambda _: inputs | more


def _both(first: Callable[[Any], Any], second: Callable[[Any], Any], t: Any) -> tuple[Any, Any]:
    return first(t), second(t)


def _ratio(motion: hostile.Motion) -> Any:
    """Return the float I where I2 = 1, and a body otherwise."""
    return motion.I3 if motion.I2 == 1.0 else SymmetricBody(motion.I2, motion.I3)


class _Body:  # the exact floor needs no more of a body than its two moments
    def __init__(self, I2: float, I3: float) -> None:
        self.I2, self.I3 = I2, I3


def _body(I2: float, I3: float) -> _Body:
    return _Body(I2, I3)
