"""Objects as arrays: a pandas data frame with a row for each object or time, and the path of the third axis."""

from collections.abc import Iterator, Sequence
from contextlib import suppress
from math import isfinite
from typing import Any

import numpy as np

from atlas.arithmetic.dimensions import TIME
from atlas.arithmetic.inputs import FloatArray, positive, real
from atlas.bodies.display import Shown
from atlas.errors import AtlasError, DomainError, unknown
from atlas.libraries import of_sweeps
from atlas.pictures.any_motion import axis_period, pieces, turns
from atlas.pictures.sample import knots
from atlas.sweeps.families import FAMILIES, Swept


def frame(subject: Shown, times: Any, quantities: Sequence[str] | None) -> Any:
    """Return the pandas data frame of an object, see `Shown.to_dataframe`: a row per time, or per motion.

    Without `times` a row is a motion, with columns of its parameters and quantities; with times (N,) a row is a
    time. `quantities` are names of columns, None for all; units are in ``attrs["units"]``. Raises AtlasError for an
    object without a family, and for an unknown quantity.
    """
    swept = FAMILIES.get(subject.family)
    if swept is None:
        raise AtlasError(f"The register has no table of a {type(subject).__name__}.")
    quantities = [quantities] if isinstance(quantities, str) else quantities
    columns = dict(_quantities(subject, swept, quantities) if times is None else columns_at(subject, times, quantities))
    data_frame = of_sweeps("pandas", "A data frame").DataFrame(columns)
    data_frame.attrs["units"] = {name: swept.units.get(name, "") for name in columns}
    return data_frame


def _quantities(subject: Shown, swept: Swept, names: Sequence[str] | None) -> Iterator[tuple[str, Any]]:
    """Yield (name, array (N,)) for the parameters and the quantities `names` (None: all) of N motions in one object.

    NaN where a quantity has no value. Raises AtlasError for an unknown quantity.
    """
    quantities = {name: swept.quantities[name] for q in swept.family.quantities for name in q.names}
    shape = getattr(subject, "shape", ())
    if not subject.made_by and len(subject.arguments) == len(swept.family.parameters):
        for p, value in zip(swept.family.parameters, subject.arguments.values(), strict=True):
            if value is not None:
                components = np.moveaxis(np.asarray(value), -1, 0) if p.last else value if p.columns else [value]
                for name, component in zip(p.names, components, strict=True):
                    yield name, np.broadcast_to(getattr(component, "ratio", component), shape).ravel()
    for name in quantities if names is None else names:
        if name not in quantities:
            raise unknown("quantity", name, quantities, f"of a {type(subject).__name__}")
        value = np.nan
        with suppress(DomainError):  # where the register says that there may be none
            value = quantities[name].value(subject, {})
        yield name, np.broadcast_to(np.nan if value is None else value, shape).ravel()


def columns_at(subject: Shown, times: Any, names: Sequence[str] | None = None) -> Iterator[tuple[str, Any]]:
    """Yield ("t", times (N,)), then (name, column (N,)) for an object's functions of time, such as ("R11", ...).

    `names` selects columns, None takes all. Raises AtlasError for an unknown name, an array of motions, and an
    object that does not depend on time.
    """
    swept = FAMILIES[subject.family]
    if getattr(subject, "shape", ()):
        raise AtlasError(f"Rows by time are of one {type(subject).__name__}: make one with numbers in place of arrays.")
    functions = {name: s for s in swept.family.sampled for name in s.columns}
    if not functions:
        raise AtlasError(f"A {type(subject).__name__} has nothing that depends on time.")
    t = np.ravel(real(times, "The time", TIME))
    for name in names or ():
        if name not in functions:
            raise unknown("quantity", name, functions, f"at a time of a {type(subject).__name__}")
    chosen_names = tuple(functions if names is None else names)
    columns = {
        s.name: s.method_of(subject)(t).reshape(t.size, len(s.columns))
        for s in swept.family.sampled
        if {*s.columns} & {*chosen_names}
    }
    yield "t", t
    for name in chosen_names:
        yield name, columns[functions[name].name][:, [*functions[name].columns].index(name)]


def trace(motion: Any, periods: float, stop: float | None, tolerance: float) -> tuple[FloatArray, FloatArray]:
    """Return times (N,) and points (N, 3) of the body's axis R e3, see `Motion.trace`.

    The path from 0 to `stop`, by default `periods` periods of the axis, is sampled to `tolerance`, a distance on
    the unit sphere. Raises AtlasError for several motions, and without `stop` for a motion that has no period.
    """
    name = type(motion).__name__
    if motion.shape:
        raise AtlasError(f"A trace is of one {name}, not of several: make one with numbers in place of arrays.")
    period = axis_period(motion)
    if stop is None:
        if not isfinite(period) or not period:
            raise AtlasError(f"This {name} has no period: say stop=..., the time up to which its axis is followed.")
        stop = positive(periods, "periods") * period
    stop = positive(stop, "stop", TIME)
    rate = turns(motion, min(stop, period) if period else stop)
    times = knots(motion.third_axis, 0.0, stop, positive(tolerance, "tolerance"), pieces(rate * stop))
    return times, motion.third_axis(times)
