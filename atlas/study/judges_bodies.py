"""Judges of the free body, of the ball and of the point charge."""

from functools import partial
from itertools import chain

import numpy as np

from atlas.core.ball import BallMotion
from atlas.core.elementary import FreeMotion
from atlas.core.particle import ParticleMotion
from atlas.exact import ball as exact_ball
from atlas.exact import free as exact_free
from atlas.exact import particle as exact_particle
from atlas.exact.digits import enclosed
from atlas.study import hostile
from atlas.study.judging import BITS, both, described, judging, with_more
from atlas.study.ulps import Tally, absolute, approximate, error, of_length, own


def judge_free(motion: hostile.Free, tally: Tally) -> None:
    """Judge a free body with any initial angular velocity."""
    inputs = described(motion)
    with judging(tally, "free body", "free body", inputs):
        exact, found = exact_free.FreeMotion(motion.I, motion.omega), FreeMotion(motion.I, motion.omega)
        k, phi = enclosed(lambda: (exact.k, exact.phi), BITS)
        tally.add("free k", "free body", own([found.k], [k]), with_more(inputs))
        tally.add("free phi", "free body", own([found.phi], [phi]), with_more(inputs))
        fastest = max(abs(approximate(k)), abs(approximate(phi)))
        R, Omega = found.rotation(np.array(motion.times)), found.angular_velocity(np.array(motion.times))
        for i, t in enumerate(motion.times):
            where = f"free body, {hostile.clock(fastest, t)}"
            true = enclosed(partial(both, exact.rotation, exact.angular_velocity, t), BITS)
            tally.add("free R", where, absolute(R[i].flat, chain(*true[0])), with_more(inputs, t=t.hex()))
            tally.add("free Omega", where, [of_length(Omega[i], true[1])], with_more(inputs, t=t.hex()))


def judge_ball(ball: hostile.Ball, tally: Tally) -> None:
    """Judge a charged ball: axis, frequency, matrix, momentum."""
    inputs = described(ball)
    with judging(tally, "ball", "ball", inputs):
        exact = exact_ball.BallMotion(ball.inertia, ball.larmor, (ball.m2, ball.m3))
        found = BallMotion(ball.inertia, ball.larmor, momentum=(ball.m2, ball.m3))
        gamma, k_hat = enclosed(lambda: (exact.gamma, exact.k_hat), BITS)
        tally.add("ball gamma", "ball", own([found.gamma], [gamma]), with_more(inputs))
        tally.add("ball k_hat", "ball", own(found.k_hat, k_hat), with_more(inputs))
        fastest = max(abs(approximate(gamma)), abs(ball.larmor))
        times = np.array(ball.times)
        R, m, Omega = found.rotation(times), found.angular_momentum(times), found.angular_velocity(times)
        for i, t in enumerate(ball.times):
            where = f"ball, {hostile.clock(fastest, t)}"
            true = enclosed(partial(both, exact.rotation, exact.angular_momentum, t), BITS)
            tally.add("ball R", where, absolute(R[i].flat, chain(*true[0])), with_more(inputs, t=t.hex()))
            tally.add("ball m", where, [of_length(m[i], true[1])], with_more(inputs, t=t.hex()))
            true = enclosed(partial(exact.angular_velocity, t), BITS)
            tally.add("ball Omega", where, [of_length(Omega[i], true)], with_more(inputs, t=t.hex()))


def judge_particle(particle: hostile.Particle, tally: Tally) -> None:
    """Judge a point charge, in ulps of the largest length (speed) that its start and its forces make by that time."""
    inputs = described(particle)
    arguments = (particle.mu, particle.E, particle.B, particle.position, particle.velocity, particle.c)
    with judging(tally, "particle", "particle", inputs):
        exact, found = exact_particle.ParticleMotion(*arguments), ParticleMotion(*arguments)
        y, v = found.position(np.array(particle.times)), found.velocity(np.array(particle.times))
        pull, speed = (np.linalg.norm(x) for x in (np.multiply(particle.mu, particle.E), particle.velocity))
        for i, t in enumerate(particle.times):
            true = enclosed(partial(both, exact.position, exact.velocity, t), BITS)
            reach = np.linalg.norm(particle.position) + abs(t) * (speed + abs(t) * pull)
            units = np.spacing(float(reach)), np.spacing(float(speed + abs(t) * pull))
            where = f"particle, {hostile.clock(abs(particle.mu) * float(np.linalg.norm(particle.B)), t)}"
            for name, values, balls, unit in zip(("particle y", "particle v"), (y[i], v[i]), true, units, strict=True):
                errors = [error(a, b, unit) for a, b in zip(values, balls, strict=True)]
                tally.add(name, where, errors, with_more(inputs, t=t.hex()))
