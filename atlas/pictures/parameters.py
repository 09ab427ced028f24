"""Arguments of a recipe, converted to the types of its parameters, or refused in one sentence with the remedy."""

import reprlib
from collections.abc import Mapping
from numbers import Integral, Real
from types import GenericAlias, NoneType, UnionType
from typing import Any, Literal, Union, get_args, get_origin

from atlas.errors import AtlasError

RANGES: Mapping[str, tuple[float, float]] = {
    "azimuth": (-360.0, 360.0),
    "elevation": (-90.0, 90.0),
    "turns": (1e-3, 1e3),
    "periods": (1e-3, 1e3),
    "reach": (1e-2, 1e2),
    "horizon": (1e-3, 1e9),
    "columns": (1, 6),
}
"""Least and largest values of parameters common to all recipes; a recipe may set others by a RANGES of its own."""

MEANINGS: Mapping[str, str] = {
    "ratio": "I = I3/I2, above 0 and at most 2",
    "ratios": "I = I3/I2 of several bodies, each above 0 and at most 2",
    "field": "B' = (B2, B3), in 1/time",
    "omega": "angular velocity at t = 0, in 1/time",
    "omega2": "second component of the angular velocity at t = 0, in 1/time",
    "omega3": "third component of the angular velocity at t = 0, in 1/time",
    "mu": "charge over mass",
    "E": "electric field",
    "B": "magnetic field",
    "c": "speed of light",
    "turns": "length of the motion in turns",
    "azimuth": "azimuth of the view in degrees",
    "elevation": "elevation of the view in degrees",
    "reach": "extent of the axes, in a unit of the figure",
    "horizon": "longest time, in turns",
    "columns": "number of panels beside each other",
    "cells": "number of cells along a side of the map",
    "levels": "values of the level lines, or their number",
    "count": "number of attitudes drawn",
    "unit": "unit of time in the labels",
    "length": "unit of length in the labels",
    "b": "strength |B'| of the field, in 1/time",
    "larmor": "Larmor frequency, in 1/time",
    "electric": "electric field",
    "magnetic": "magnetic field",
    "inertia": "principal moments of inertia, in any one unit",
    "first": "moments I1 of several bodies",
    "omega1": "first component of the angular velocity at t = 0, in 1/time",
    "push": "angular velocity of the push, in 1/time",
    "pushes": "angular velocities of several pushes, in 1/time",
    "momentum": "angular momentum, in inertia/time",
    "M3": "angular momentum about the axis over I2, in 1/time",
    "velocity": "velocity of the centre at t = 0, in length/time",
    "position": "position at t = 0",
    "point": "point of the body at t = 0, from the centre of mass",
    "direction": "direction of field or vertical at t = 0, across and along the axis",
    "coupling": "coefficients (k2, k3) of a top in M = I Omega + k b",
    "linear": "linear coefficient of a top's potential",
    "quadratic": "quadratic coefficient of a top's potential",
    "z": "parameter z of an elliptic motion, in inertia^2",
    "branch": "sign of v of an elliptic motion, 1 or -1",
    "stop": "last time",
    "periods": "length of the motion in periods",
    "nutations": "length of the motion in periods of the nutation",
    "part": "elapsed fraction of the period",
    "decay": "time shown, times the rate of growth",
    "fractions": "ratios p/q of the two frequencies",
    "order": "largest p and q of the ratios marked",
    "speeds": "speeds of the circular motion over the drift",
    "cosines": "cosines of the steady inclinations",
    "least": "smallest amplitude shown, as a fraction of the root mean square",
    "names": "number of lines with labels",
}
"""Meaning of parameters that are common to all recipes."""

MAX_VALUES = 40
"""Largest number of values in a list: each is a curve or a panel."""

DRAWABLE_SIZES = 1e-60, 1e60
"""Least and largest magnitude, besides zero, of a number that can be drawn: fourth powers are floats."""

COUNTS = {2: "two", 3: "three", 4: "four"}


def fitted(name: str, value: Any, hint: Any, default: Any, ends: Mapping[str, tuple[float, float]] = RANGES) -> Any:
    """Return a parameter's value converted to the annotation `hint`, or if that is None to its default's type.

    A list becomes a tuple, an integer a float, one number a tuple of one where any length is allowed, and a flat
    list is divided into tuples of the annotated length. `ends` are (least, greatest) by name of parameter. Raises
    AtlasError, which names the parameter and the expected value, for another type and beyond the limits.
    """
    kind = _kind(default) if hint is None else hint
    try:
        result = _fit(value, kind)
    except _Unfit as wrong:
        raise AtlasError(f"{name} must be {wrong}, not {reprlib.repr(value)}.") from None
    if name in ends and result is not None:
        low, high = ends[name]
        if not all(low <= x <= high for x in (result if isinstance(result, tuple) else (result,))):
            raise AtlasError(f"{name} must lie between {low:g} and {high:g}, not {reprlib.repr(value)}.")
    return result


def described(hint: Any, default: Any) -> str:
    """Return the type of a parameter in a few words: "a number", "two numbers", "a list of numbers", "left or right".

    `hint` is its annotation, None for none: then the type of its `default` counts.
    """
    kind = _kind(default) if hint is None else hint
    origin, inner = get_origin(kind), get_args(kind)
    if origin in {Union, UnionType}:
        return described(next(option for option in inner if option is not NoneType), None)
    if origin is Literal:
        return " or ".join(map(str, inner))
    if origin is tuple:
        is_open, plain = inner[-1] is Ellipsis, inner[0] in _PLAIN and len({*inner} - {Ellipsis}) == 1
        plural = _PLURAL[inner[0]].partition(",")[0] if plain else "values"
        if is_open and get_origin(inner[0]) is tuple:
            return f"lists of {described(inner[0], None)}, one after the other"
        return f"a list of {plural}" if is_open else f"{COUNTS.get(len(inner), len(inner))} {plural}"
    return _PLAIN[float if kind is Any else kind][0].partition(",")[0] if kind in {Any, *_PLAIN} else "a value"


def typed_text(value: Any) -> str:
    """Return a value as it is typed after ``--set``: "1.5", "1,2", "true"; nested lists are flattened."""
    if isinstance(value, tuple | list):
        return ",".join(map(typed_text, value)) + (
            "," if len(value) == 1 and not isinstance(value[0], tuple | list) else ""
        )
    if isinstance(value, bool):
        return str(value).lower()
    return repr(float(value)).removesuffix(".0") if isinstance(value, float | int) else str(value)


class _Unfit(Exception):  # noqa: N818  it carries the remedy, and never leaves this file
    """A value does not fit its annotation; the message is the expected type, in words."""


def _kind(default: Any) -> Any:
    """Return the annotation inferred from a default value: its type, for a tuple the types of its items, else Any."""
    if isinstance(default, tuple) and default:
        return GenericAlias(tuple, tuple(map(_kind, default)))
    return Any if default is None or default == () else type(default)


def _fit(value: Any, kind: Any) -> Any:
    """Return a value converted to an annotation `kind`, NumPy's types to Python's.

    Annotations are float, int, bool, str, Literal, tuples of these, one of these or None, and Any, which counts as
    float; for another one the value is returned unchanged. A body, which stands for its ratio I3/I2, is returned
    unchanged where the kind is float or Any. Raises _Unfit, whose message is the expected type in words.
    """
    if hasattr(value, "tolist"):
        value = value.tolist()
    origin, inner = get_origin(kind), get_args(kind)
    if origin in {Union, UnionType}:
        is_missing = value is None and NoneType in inner
        return None if is_missing else _fit(value, next(kind for kind in inner if kind is not NoneType))
    if origin is Literal and value not in inner:
        raise _Unfit(" or ".join(map(str, inner)))
    if origin is tuple:
        return _list(value, inner)
    if kind in {Any, float} and hasattr(value, "I2"):  # a body may stand where a ratio does
        return value
    if kind is Any:
        kind = float
    if kind in _PLAIN:
        says, fits = _PLAIN[kind]
        if not fits(value):
            raise _Unfit(says)
        value = kind(value)
    return value


def _list(value: Any, inner: tuple[Any, ...]) -> tuple[Any, ...]:
    """Return a list as a tuple with items of the annotated types `inner`, whose last is Ellipsis for any length.

    A single value counts as a list of one if any length is allowed. Raises _Unfit for another length or type.
    """
    is_open = inner[-1] is Ellipsis
    kinds = set(inner) - {Ellipsis}
    plural = _PLURAL.get(inner[0], "values") if len(kinds) == 1 else "values"
    if is_open and not isinstance(value, list | tuple):
        value = (value,)
    lists = get_args(inner[0]) if get_origin(inner[0]) is tuple else ()
    if is_open and lists and Ellipsis not in lists:
        plural = f"lists of {described(inner[0], None)}"
        if not any(isinstance(item, list | tuple) for item in value):
            value = [value[i : i + len(lists)] for i in range(0, len(value), len(lists))]
    expected = f"a list of 1 to {MAX_VALUES} {plural}" if is_open else f"{COUNTS.get(len(inner), len(inner))} {plural}"
    if not isinstance(value, list | tuple) or not (
        0 < len(value) <= MAX_VALUES if is_open else len(value) == len(inner)
    ):
        raise _Unfit(expected)
    try:
        return tuple(map(_fit, value, inner[:1] * len(value) if is_open else inner))
    except _Unfit as wrong:
        raise _Unfit(expected) from wrong


def _drawable(value: Any) -> bool:
    """Return whether a value is 0 or a real number with a magnitude within DRAWABLE_SIZES, and no boolean."""
    return (
        isinstance(value, Real)
        and not isinstance(value, bool)
        and (
            value == 0 or DRAWABLE_SIZES[0] <= abs(value) <= DRAWABLE_SIZES[1]  # type: ignore[operator]
        )
    )


_PLAIN: Mapping[Any, tuple[str, Any]] = {
    float: (f"a number, 0 or of a size between {DRAWABLE_SIZES[0]:g} and {DRAWABLE_SIZES[1]:g}", _drawable),
    int: ("a whole number", lambda value: isinstance(value, Integral) and not isinstance(value, bool)),
    bool: ("true or false", lambda value: isinstance(value, bool)),
    str: ("a word", lambda value: isinstance(value, str)),
}

_PLURAL = {
    float: f"numbers, each 0 or of a size between {DRAWABLE_SIZES[0]:g} and {DRAWABLE_SIZES[1]:g}",
    int: "whole numbers",
    str: "words",
}
