"""Checks of motions whose axis nutates: their family's promises, structure and a grid, see `stress.checks`."""

from collections.abc import Callable, Sequence
from functools import partial
from math import isfinite
from random import Random
from typing import Any

import numpy as np
from flint import arb
from ulps import ONE

from atlas.arithmetic.certified_digits import numbers
from atlas.arithmetic.certified_inputs import Real
from atlas.arithmetic.inputs import FloatArray
from atlas.arithmetic.numbers import workprec
from atlas.motions.register import FAMILIES
from stress.asymmetric import Asymmetric, size_of
from stress.checks import Inputs, Where, check, on_grid
from stress.elliptic import Elliptic, rates_of
from stress.regimes import General
from stress.tops import Top, rate_of
from stress.worst import WorstErrors

GRID = 8200
"""Matrices on a uniform grid, enough for polynomials; a few of them are checked."""
ALONE = {"top, slow nutation under a fast spin"}
"""Regimes whose times go by balls one by one: their grid is a short one."""

TIMES = 5
"""Times of each motion whose axis nutates."""

NARROW = 2.0**-80
"""Radius of the truth of a general motion, beside 1 or beside the largest rate."""


def check_general(draw: General, regime: str, random: Random, worst: WorstErrors) -> None:
    """Check a general motion, in ulps of its largest rate: beside the register, structure and a grid."""
    I, field, omega = draw
    inputs = {"I": I.hex(), "field": [x.hex() for x in field], "omega": [x.hex() for x in omega]}
    _nutation("general", draw, inputs, max(map(abs, (*field, *omega))) or 1.0, regime, random, worst)


def check_top(draw: Top, regime: str, random: Random, worst: WorstErrors) -> None:
    """Check a top, in ulps of its largest rate: beside the register, structure and a grid."""
    inputs = {
        name: value.hex() if isinstance(value, float) else [x.hex() for x in value]
        for name, value in draw._asdict().items()
    }
    _nutation("top", draw, inputs, rate_of(draw), regime, random, worst, b=1.0)


def check_elliptic(draw: Elliptic, regime: str, random: Random, worst: WorstErrors) -> None:
    """Check an elliptic motion, K in ulps of the field: beside the register, structure and a grid."""
    inputs: Inputs = {name: [x.hex() for x in getattr(draw, name)] for name in ("inertia", "field")}
    inputs |= {"z": draw.z.hex(), "branch": draw.branch}
    b, size = rates_of(draw)
    _nutation("elliptic", draw, inputs, size, regime, random, worst, K=b)


def check_asymmetric(draw: Asymmetric, regime: str, random: Random, worst: WorstErrors) -> None:
    """Check a motion of three moments, in ulps of its largest rate: beside the register, structure."""
    inputs: Inputs = {name: [x.hex() for x in vector] for name, vector in draw._asdict().items()}
    size, lengths = size_of(draw), ((-1, 2), (4, 9), (10, 14.5))
    times = [random.choice((1, -1)) * 10 ** random.uniform(*length) / size for length in lengths]
    check(
        "asymmetric", regime, draw, worst, inputs, times=times, unit=lambda *_: size * ONE,
        truth=partial(narrow, size=size, precision=112), more=_structure("asymmetric", regime, inputs, times, worst),
    )  # fmt: skip


def _structure(
    name: str, regime: str, inputs: Inputs, times: Sequence[float], worst: WorstErrors
) -> Callable[[Any, Any, Where], None]:
    """Return checks that R is orthogonal, and 1 at t = 0."""

    def compare_more(kernel: Any, *_: Any) -> None:
        R = kernel.rotation(np.array(times))
        defect = np.abs(np.swapaxes(R, -1, -2) @ R - np.eye(3)).max(axis=(-1, -2)) / ONE
        worst.add(f"{name} orthogonality", regime, defect.tolist(), lambda i: inputs | {"t": times[i].hex()})
        start = np.abs(kernel.rotation(0.0) - np.eye(3)).max() / ONE
        worst.add(f"{name} R(0) = 1", regime, [float(start)], lambda _: inputs)

    return compare_more


def _nutation(
    name: str,
    draw: Sequence[Any],
    inputs: Inputs,
    size: float,
    regime: str,
    random: Random,
    worst: WorstErrors,
    **lengths: float,
) -> None:
    """Check a motion whose axis nutates, vectors in ulps of their `lengths`, or of a rate."""
    truth = partial(narrow, size=size)

    def compare_more(kernel: Any, exact: Any, where: Where) -> None:
        _structure(name, regime, inputs, times, worst)(kernel, exact, where)
        # long enough for polynomials; at ends of their windows too
        places = (0, 255, 511, 4099, GRID - 1)[: 2 if regime in ALONE else None]
        grid = (0.0, times[-1] / GRID, places[-1] + 1)
        on_grid(f"{name} R grid", kernel, exact, grid, places, regime, worst, inputs, truth)

    def unit(vector: str, _: float) -> float:
        return lengths.get(vector, size) * ONE

    times: list[float] = []
    with worst.checking(name, regime, inputs):
        times += _times(FAMILIES[name].kernels()(*draw).period, size, random).tolist()
        check(name, regime, draw, worst, inputs, times=times, unit=unit, truth=truth, more=compare_more)


def narrow(function: Callable[[], Any], size: float, precision: int = 256) -> Any:
    """Return nested lists of balls computed at a precision at which each is narrow beside 1, or beside the rates.

    An entry may be zero: so the radius is compared with the size of the whole, not of the entry.
    """
    while True:
        with workprec(precision):
            value = function()
        if all(_radius(x) <= NARROW * min(1.0, size) for x in numbers(value)):
            return value
        precision *= 2


def _times(period: float, size: float, random: Random) -> FloatArray:
    """Return times from a thousandth of a period to a million periods, within the phases that are promised."""
    unit = period if isfinite(period) else 10.0 / size
    times_drawn = [random.choice((1, -1)) * unit * 10 ** random.uniform(-3, 6) for _ in range(TIMES)]
    return np.clip(times_drawn, -(2.0**46) / size, 2.0**46 / size)


def _radius(x: Real) -> float:
    if not isinstance(x, arb):
        return 0.0
    return float(x.rad()) if x.is_finite() else float("inf")
