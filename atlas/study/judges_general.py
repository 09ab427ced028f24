"""The judge of the general motion: matrices, vectors, structure and grid against balls, up to a million periods."""

from functools import partial
from itertools import chain
from math import isfinite
from random import Random
from typing import Any

import numpy as np
from flint import arb, ctx, fmpq

from atlas.core.general import GeneralMotion
from atlas.exact.digits import numbers
from atlas.exact.general import GeneralMotion as Balls
from atlas.exact.inputs import Real
from atlas.study.judging import judging, with_more
from atlas.study.regimes_general import Draw
from atlas.study.ulps import ONE, Tally, absolute, error

TIMES, GRID = 5, 8200
NARROW = 2.0**-80
"""Radius of the truth, beside 1 or beside the largest rate."""


def judge_general(draw: Draw, regime: str, random: Random, tally: Tally) -> None:
    """Judge one general motion."""
    I, field, omega = draw
    inputs = {"I": I.hex(), "field": [x.hex() for x in field], "omega": [x.hex() for x in omega]}
    with judging(tally, "general motion", regime, inputs):
        found, exact = GeneralMotion(I, field, omega), Balls(I, field, omega)
        size = max(map(abs, (*field, *omega))) or 1.0
        times = _times(found.period, size, random)
        R, Omega, K = found.rotation(times), found.angular_velocity(times), found.field_in_body(times)
        for i, t in enumerate(times.tolist()):
            true = narrow(partial(state, exact, t), size)
            described = inputs | {"t": t.hex()}
            tally.add("general R", regime, absolute(R[i].flat, chain(*true[0])), with_more(described))
            for name, values, balls in (("general Omega", Omega[i], true[1]), ("general K", K[i], true[2])):
                errors = [error(x, y, size * ONE) for x, y in zip(values, balls, strict=True)]
                tally.add(name, regime, errors, with_more(described))
        defect = np.abs(np.swapaxes(R, -1, -2) @ R - np.eye(3)).max(axis=(-1, -2)) / ONE
        tally.add("general orthogonality", regime, defect.tolist(), lambda i: inputs | {"t": float(times[i]).hex()})
        start = np.abs(found.rotation(0.0) - np.eye(3)).max() / ONE
        tally.add("general R(0) = 1", regime, [float(start)], lambda _: inputs)
        _grid(found, exact, times, size, regime, tally, inputs)


def _grid(
    found: GeneralMotion, exact: Balls, times: Any, size: float, regime: str, tally: Tally, inputs: dict[str, Any]
) -> None:
    """Judge a uniform grid that is long enough for polynomials, at a few of its times, at ends of windows too."""
    step = float(times[-1]) / GRID
    R = found.rotation_grid(0.0, step, GRID)
    for i in (0, 255, 511, 4099, GRID - 1):
        true = narrow(partial(exact.rotation, fmpq(*step.as_integer_ratio()) * i), size)
        where = inputs | {"step": step.hex(), "count": GRID, "index": i}
        tally.add("general R grid", regime, absolute(R[i].flat, chain(*true)), with_more(where))


def narrow(function: Any, size: float) -> Any:
    """Return nested lists of balls computed at a precision at which each is narrow beside 1, or beside the rates.

    An entry may be zero: so the radius is compared with the size of the whole, not of the entry.
    """
    precision = 256
    while True:
        with ctx.workprec(precision):
            value = function()
        if all(_radius(x) <= NARROW * min(1.0, size) for x in numbers(value)):
            return value
        precision *= 2


def state(exact: Balls, t: float) -> tuple[list[list[Real]], list[Real], list[Real]]:
    """Return R, Omega and K."""
    return exact.rotation(t), exact.angular_velocity(t), exact.field_in_body(t)


def _times(period: float, size: float, random: Random) -> Any:
    """Return times from a thousandth of a period to a million periods, within the phases that are promised."""
    unit = period if isfinite(period) else 10.0 / size
    drawn = [random.choice((1, -1)) * unit * 10 ** random.uniform(-3, 6) for _ in range(TIMES)]
    return np.clip(drawn, -(2.0**46) / size, 2.0**46 / size)


def _radius(x: Real) -> float:
    if not isinstance(x, arb):
        return 0.0
    return float(x.rad()) if x.is_finite() else float("inf")
