"""Objects that are made by the same call of the same numbers are equal, and have the same hash."""

import copy
import pickle
from typing import Any

import numpy as np
import pytest
from numpy import array

import atlas

OBJECTS: dict[str, Any] = {
    "motion": lambda: atlas.motion(1.4, (0.4, -0.9, 1.2), (0.5, 0.3, -1.1)),
    "tensor": lambda: atlas.motion([[2, 0.1, 0], [0.1, 1.5, 0.2], [0, 0.2, 1]], (0.3, 0.0, 1.0), (0.1, 0.2, 3.0)),
    "body": lambda: atlas.ElementaryMotion(atlas.SymmetricBody(2.0, 3.0), (1, 2), 0.7),
    "elementary": lambda: atlas.ElementaryMotion(1.5, (1, 2), [0.7, 0.8]),
    "free": lambda: atlas.FreeMotion(1.5, (0.1, 0.2, 0.3)),
    "general": lambda: atlas.GeneralMotion(1.5, (1, 2), (0.3, 0.7, 0.2)),
    "field": lambda: atlas.motion(1.4, atlas.Field((0.4, -0.9, 1.2), mu=3.0, c=1.0), (0.5, 0.3, -1.1)),
    "asymmetric": lambda: atlas.AsymmetricMotion((0.8, 1.0, 1.2), (0.2, 0.3, 0.4), (1.0, 2.0, 3.0)),
    "elliptic": lambda: atlas.EllipticMotion((0.8, 1, 1.2), (0.2, 1, 0.6), 1.7),
    "top": lambda: atlas.TopMotion((1.0, 0.5), (0.0, 0.0), (0.6, 0.8), (0.1, 0.2, 5.0), 3.0),
    "ball": lambda: atlas.BallMotion(1.0, 0.3, (1.0, 2.0)),
    "particle": lambda: atlas.ParticleMotion(1.0, (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (1.0, 0, 0), (0, 0.3, 0)),
    "hyperbola": lambda: atlas.Hyperbola(1.5, (1, 2)),
    "quadric": lambda: atlas.Quadric(1.5, (1, 2)),
    "hyperbola of a top": lambda: atlas.Hyperbola.of_top((1.0, 0.5), (0.0, 0.0), (0.6, 0.8), 3.0),
    "quadric of a top": lambda: atlas.Quadric.of_top((1.0, 0.5), (0.0, 0.0), (0.6, 0.8), 3.0),
    "closed": lambda: atlas.Hyperbola(0.7, (1, 2)).closed(1, 2),
}


@pytest.mark.parametrize("name", OBJECTS)
def test_copies_pickles_and_repr_are_equal(name: str) -> None:
    """With a hash, so that a set holds one of them; another number makes another object."""
    original = OBJECTS[name]()
    same = [OBJECTS[name](), copy.copy(original), copy.deepcopy(original), pickle.loads(pickle.dumps(original))]  # noqa: S301
    names = {name: getattr(atlas, name) for name in atlas.__all__} | {
        type(original).__name__: type(original),
        "array": array,
    }
    same.append(eval(repr(original), names))  # noqa: S307
    for twin in same:
        assert twin == original
        assert hash(twin) == hash(original)
    assert len({original, *same}) == 1
    assert all(original != OBJECTS[key]() for key in OBJECTS if key != name)


def test_numbers_are_compared_by_value() -> None:
    """Tuples, lists and arrays of the same numbers are the same; one last bit is not."""
    lists = [(0.4, -0.9, 1.2), [0.4, -0.9, 1.2], np.array([0.4, -0.9, 1.2])]
    assert len({atlas.motion(1.4, B, (0.5, 0.3, -1.1)) for B in lists}) == 1
    field_next = (np.nextafter(0.4, 1), -0.9, 1.2)
    assert atlas.motion(1.4, field_next, (0.5, 0.3, -1.1)) != atlas.motion(1.4, lists[0], (0.5, 0.3, -1.1))
    assert atlas.GeneralMotion(1.4, (0.0, 1.0), (1.0, 2.0, 3.0)) != "GeneralMotion"


@pytest.mark.parametrize("name", OBJECTS)
def test_a_misspelt_attribute_is_no_new_one(name: str) -> None:
    """It is refused, and the name that was meant is told."""
    with pytest.raises(AttributeError, match="has no attribute 'omgea'"):
        OBJECTS[name]().omgea = 3
    with pytest.raises(AttributeError, match=r"did you mean 'omega'\?"):
        atlas.GeneralMotion(1.5, (1, 2), (0.3, 0.7, 0.2)).omgea = 3
