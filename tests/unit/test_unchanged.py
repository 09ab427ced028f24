"""Inputs and outputs of an object are apart from its own arrays: no array changes it later."""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

import atlas
from atlas.bodies.display import Shown
from atlas.families.family import Family
from atlas.motions.register import FAMILIES

MASSES, POINTS = np.ones(4), np.array([[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0]])
OTHERS = {
    "Field": lambda: atlas.Field([0.0, 1.0, 2.0], [0.5, 0.0, 0.0]),
    "frame": lambda: atlas.Field([0.0, 1.0, 2.0]).frame([1.0, 0.0, 1.0]),
    "SymmetricBody": lambda: atlas.SymmetricBody.from_point_masses(MASSES, POINTS),
    "in_laboratory": lambda: atlas.GeneralMotion.in_laboratory(1.5, [0.0, 1.0, 2.0], np.eye(3), [0.3, 0.7, 0.2]),
    "Hyperbola.of_top": lambda: atlas.Hyperbola.of_top((1.0, 0.5), (1.0, 0.5), (0.6, 0.8)),
    "Quadric.of_top": lambda: atlas.Quadric.of_top((1.0, 0.5), (1.0, 0.5), ([0.6, 0.8], [0.8, 0.6])),
    "closed": lambda: atlas.Hyperbola(1.5, (1.0, 2.0)).closed(3, 2),
}


SLOW = {"accuracy"}
"""One number, of a proof that takes a second."""


def arrays(value: Any) -> Iterator[np.ndarray]:
    """Return the arrays of numbers within an attribute."""
    if isinstance(value, np.ndarray):
        yield value
    elif isinstance(value, tuple | list | dict):
        for item in value.values() if isinstance(value, dict) else value:
            yield from arrays(item)


def arrays_of(instance: Any) -> dict[str, list[np.ndarray]]:
    """Return the arrays that an object hands out without a time, by the name that is asked for."""
    arrays_found = {}
    for name in dir(instance):
        if name.startswith("_") or name in SLOW:
            continue
        try:
            value = getattr(instance, name)
            arrays_found[name] = list(arrays(value() if name == "invariants" else value))
        except atlas.AtlasError:
            continue
    return arrays_found


def arguments_of(family: Family) -> list[Any]:
    """Return the parameters of two motions or surfaces, in arrays."""
    values = []
    for p in family.parameters:
        numbers = p.default or (p.omitted,) * len(p.names)
        if None in numbers:
            values.append(None)
        elif p.last:
            values.append(np.array([numbers, numbers]))
        else:
            pairs = tuple(np.array([x, x]) for x in numbers)
            values.append(pairs if p.columns else pairs[0])
    return values


def pairs() -> list[str]:
    """Return the families of which two are made at once."""
    return [name for name, family in FAMILIES.items() if family.at_once > 1]


def single(family: Family) -> Any:
    """Return one motion or surface."""
    values = [(p.default if p.columns else p.default[0]) if p.default else None for p in family.parameters]
    return family.kernels()(*values)


ALL = {
    **OTHERS,
    **{name: lambda family=family: single(family) for name, family in FAMILIES.items()},
    **{f"two of {name}": lambda name=name: FAMILIES[name].kernels()(*arguments_of(FAMILIES[name])) for name in pairs()},
}


@pytest.mark.parametrize("name", ALL)
def test_returned_arrays_change_no_object(name: str) -> None:
    """An array that an object keeps can't be written into; where one can, the object has made it for the asker."""
    instance = ALL[name]()
    for attribute, handed in arrays_of(instance).items():
        before = [array.copy() for array in handed]
        for array in handed:
            if array.flags.writeable:
                array[...] = -math.pi
        again = arrays_of(instance)[attribute]
        assert all(map(np.array_equal, before, again)), attribute


@pytest.mark.parametrize("name", pairs())
def test_later_changes_of_given_arrays_have_no_effect(name: str) -> None:
    """The numbers of an object are those of the arrays when it was made."""
    inputs = arguments_of(FAMILIES[name])
    motion = FAMILIES[name].kernels()(*inputs)
    assert isinstance(motion, Shown)
    for attribute, handed in arrays_of(motion).items():
        for array in handed:
            assert not any(np.shares_memory(array, array_input) for array_input in arrays(inputs)), attribute
