"""The curve that a motion's third axis draws, as arrays."""

from math import isfinite
from typing import Any

from atlas.core.inputs import FloatArray, positive
from atlas.core.quantities import TIME
from atlas.errors import AtlasError
from atlas.families import FAMILIES
from atlas.scene.any_motion import pieces, turns
from atlas.scene.sample import knots


def trace(motion: Any, periods: float, stop: float | None, tolerance: float) -> tuple[FloatArray, FloatArray]:
    """Return times and points, see `Motion.trace`."""
    name = type(motion).__name__
    if motion.shape:
        raise AtlasError(f"A trace is of one {name}, not of several: make one with numbers in place of arrays.")
    quantities = FAMILIES[motion.family].quantities
    period = next((float(q.value(motion)) for q in quantities if q.name == "period"), 0.0)
    if stop is None:
        if not isfinite(period) or not period:
            raise AtlasError(f"This {name} has no period: say stop=..., the time up to which its axis is followed.")
        stop = positive(periods, "periods") * period
    stop = positive(stop, "stop", TIME)
    rate = turns(motion, min(stop, period) if period else stop)
    times = knots(motion.third_axis, 0.0, stop, positive(tolerance, "tolerance"), pieces(rate * stop))
    return times, motion.third_axis(times)
