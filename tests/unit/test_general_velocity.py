"""The angular velocity of the general motion: within 16 ulp of its largest component, however near to rest."""

from functools import partial
from math import ulp
from random import Random
from typing import Any

import mpmath
import numpy as np
import pytest
from flint import arb, ctx
from stress.regimes import GENERAL

from atlas.motions.nutation import rows, single
from atlas.motions.nutation.certified_general import GeneralMotion as Balls
from atlas.motions.nutation.kernel_general import GeneralMotion
from tests.oracles.taylor import taylor

WANTED = 16
"""The promise, in ulp of the largest component of Omega."""

POWERS = (-16, -12, -8, -4, -2, -1, 0, 1, 3)
"""Of |omega|/|B'|."""


def motions(power: float, count: int, seed: int, least: float = 0.1) -> Any:
    """Return inputs I, B', omega, (count,) each, |omega|/|B'| near a power of ten, and times that fit them."""
    r = np.random.default_rng(seed)
    I = 2 ** r.uniform(np.log2(least), 1, count)
    B, omega = r.normal(size=(2, count)), r.normal(size=(3, count)) * 10.0**power
    size = abs(np.concatenate([B, omega])).max(axis=0)
    return I, B, omega, r.choice([-1.0, 1.0], count) * 10 ** r.uniform(-3, 5, count) / size


def narrow(exact: Any, t: float) -> list[arb]:
    """Return three balls that are narrow beside the largest."""
    precision = 192
    while True:
        with ctx.workprec(precision):
            balls = [arb(x) for x in exact(t)]
            if max(x.rad() for x in balls) <= 2.0**-70 * max(abs(x).lower() for x in balls):
                return balls
        precision *= 2


def off(values: Any, true: Any) -> float:
    """Return the largest error of a vector in ulp of the largest component of the true one."""
    largest = max(abs(float(x)) for x in map(_middle, true))
    unit = ulp(largest)
    return max(float(abs(arb(float(x)) - arb(y)).upper()) for x, y in zip(values, true, strict=True)) / unit


def _middle(x: Any) -> Any:
    return x.mid() if isinstance(x, arb) else x


def inputs_at(inputs: Any, i: int) -> tuple[float, tuple[float, ...], tuple[float, ...]]:
    """Return the inputs of one motion of an array."""
    I, B, omega, *_ = inputs
    return float(I[i]), tuple(B[:, i].tolist()), tuple(omega[:, i].tolist())


@pytest.mark.parametrize("power", POWERS)
def test_omega_agrees_with_the_taylor_series(power: int) -> None:
    """Alone and in arrays Omega is that of the equations themselves, integrated to 40 digits of the fastest rate."""
    I, B, omega, _ = inputs = motions(power, 3, 1)
    t = 4.0 / abs(np.concatenate([B, omega])).max(axis=0)
    together = GeneralMotion(I, tuple(B), tuple(omega)).angular_velocity(t)
    for i, time in enumerate(t.tolist()):
        ratio, field, start = inputs_at(inputs, i)
        (state,) = taylor((1, 1, ratio), (0, *field), start, [time], digits=40)
        with ctx.workprec(200):
            true = [arb(mpmath.nstr(x, 40)) for x in state.Omega]
        assert off(together[i], true) <= WANTED
        assert off(GeneralMotion(ratio, field, start).angular_velocity(time), true) <= WANTED


@pytest.mark.parametrize("least", [0.1, 1e-6], ids=["ordinary", "slender"])
@pytest.mark.parametrize("power", [-300, -30, *POWERS])
def test_omega_keeps_its_digits_near_rest(power: int, least: float) -> None:
    """Alone and in arrays Omega is within the promise of the balls, for slender bodies and long times too."""
    *_, t = inputs = motions(power, 3, 2, least)
    I, B, omega, _ = inputs
    together = GeneralMotion(I, tuple(B), tuple(omega)).angular_velocity(t)
    for i, time in enumerate(t.tolist()):
        true = narrow(Balls(*inputs_at(inputs, i)).angular_velocity, time)
        assert off(together[i], true) <= WANTED
        assert off(GeneralMotion(*inputs_at(inputs, i)).angular_velocity(time), true) <= WANTED


@pytest.mark.parametrize("regime", GENERAL)
def test_omega_keeps_its_digits_in_every_regime(regime: str) -> None:
    """So it is next to separatrices and triple roots, along the field, and at any scale, over some periods."""
    random, draws = Random(3), []  # noqa: S311  draws of test inputs
    for _ in range(4):
        I, B, omega = GENERAL[regime](random)
        motion = GeneralMotion(I, B, omega)
        t = 10 ** random.uniform(-2, 2) * (
            motion.period if np.isfinite(motion.period) else 1 / max(map(abs, (*B, *omega)))
        )
        true = narrow(Balls(I, B, omega).angular_velocity, float(t))
        assert off(motion.angular_velocity(t), true) <= WANTED
        draws.append((I, B, omega, t, true))
    I, B, omega, t, true = zip(*draws, strict=True)
    together = GeneralMotion(np.array(I), np.array(B).T, np.array(omega).T).angular_velocity(np.array(t))
    assert max(map(off, together, true)) <= WANTED


def test_a_sweep_near_rest_writes_true_numbers() -> None:
    """A body that turns 1e-12 as fast as its Larmor frame: Omega1 at t = 10 has the digits of the balls."""
    motion = GeneralMotion(1.5, (1.0, 2.0), (3e-12, 7e-12, np.array([2e-12, 3e-12])))
    assert motion.angular_velocity(10.0)[0, 0] == pytest.approx(-3.245150e-12, rel=1e-6, abs=0.0)


@pytest.mark.parametrize("power", [-16, -8, -1, 0, 3])
def test_field_and_momentum_are_within_their_promise(power: int) -> None:
    """K is within 1.8e-15 of |B'| and m within 7e-15 of its length, alone and in arrays."""
    *_, t = inputs = motions(power, 5, 4)
    together = GeneralMotion(inputs[0], tuple(inputs[1]), tuple(inputs[2]))
    for i, time in enumerate(t.tolist()):
        motion, exact = GeneralMotion(*inputs_at(inputs, i)), Balls(*inputs_at(inputs, i))
        for name, bound in (("field_in_body", 1.8e-15), ("angular_momentum", 7e-15)):
            true = narrow(getattr(exact, name), time)
            length = float(sum(x * x for x in true).sqrt().mid())
            for vector in (getattr(together, name)(t)[i], getattr(motion, name)(time)):
                errors = [float(abs(arb(float(x)) - y).upper()) for x, y in zip(vector, true, strict=True)]
                assert max(errors) <= bound * length


def test_many_times_of_a_slender_body_are_as_accurate_as_one(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where Omega3 is small beside its largest value it comes from two words or balls, for many times and for few."""
    motion, exact = GeneralMotion(1e-4, (1.0, 0.3), (2e-9, 1e-9, 3e-9)), Balls(1e-4, (1.0, 0.3), (2e-9, 1e-9, 3e-9))
    t = np.linspace(0.5, 400.0, 60)
    true = [narrow(exact.angular_velocity, time) for time in t.tolist()]
    assert max(map(off, motion.angular_velocity(t), true)) <= WANTED
    assert max(map(off, motion.angular_velocity(t.reshape(12, 5)).reshape(60, 3), true)) <= WANTED
    assert max(off(motion.angular_velocity(time), x) for time, x in zip(t[:9], true, strict=False)) <= WANTED
    monkeypatch.setattr(single, "MAX_OMEGA3_RATIO", np.inf)
    assert max(map(off, motion.angular_velocity(t), true)) > WANTED


def test_omega_in_the_laboratory_keeps_its_digits() -> None:
    """A motion that starts in any attitude, in a field of any direction, near rest: from its exact state."""
    attitude = np.array([[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]])
    for ratio in (1.5, 1e-3):
        motion = GeneralMotion.in_laboratory(ratio, (0.3, -1.0, 2.0), attitude, (1e-14, 3e-14, -2e-14))
        for time in (0.7, 40.0, 3e3):
            true = narrow(partial(motion._single().exact.angular_velocity), time)
            assert off(motion.angular_velocity(time), true) <= WANTED


def test_velocity_of_a_spin_about_the_axis_starts_with_the_fields_torque() -> None:
    """With omega along the axis one of the pair is zero at t = 0: by its slope Omega is true, in arrays and alone."""
    I, spins = np.array([1.5, 0.4, 1.0, 0.4]), np.array([0.7, -1.3, 0.9, -1e-9])
    t = np.array([3.0, 11.0, 0.3, 40.0])
    together = GeneralMotion(I, (1.0, np.array([2.0, -0.3, 0.5, 1.0])), (0.0, 0.0, spins)).angular_velocity(t)
    for i, B3 in enumerate((2.0, -0.3, 0.5, 1.0)):
        inputs = float(I[i]), (1.0, B3), (0.0, 0.0, float(spins[i]))
        true = narrow(Balls(*inputs).angular_velocity, float(t[i]))
        assert off(together[i], true) <= WANTED
        assert off(GeneralMotion(*inputs).angular_velocity(float(t[i])), true) <= WANTED


def test_needles_across_the_field_keep_their_digits_in_arrays(monkeypatch: pytest.MonkeyPatch) -> None:
    """Omega3 passes zero far below its largest values: such rows are made alone; were they not, it would show."""
    I, B, omega = 1e-6, (1.0, 0.1), (2e-6, 1e-6, 3e-7)
    t = np.linspace(5.0, 2000.0, 80)
    true = [narrow(Balls(I, B, omega).angular_velocity, time) for time in t.tolist()]

    def largest_error() -> float:
        return max(map(off, GeneralMotion(np.full(80, I), B, omega).angular_velocity(t), true))

    assert largest_error() <= WANTED / 2
    monkeypatch.setattr(rows, "MAX_OMEGA3_CHANGE", np.inf)
    assert largest_error() > WANTED / 2
