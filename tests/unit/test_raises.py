"""What the public names raise on a wrong input stands in their docstrings."""

import inspect
from collections.abc import Callable, Iterator
from typing import Any

import pytest

import atlas

FIELD = atlas.Field.gaussian((0.3, 1.0, -2.0), mu=1.5)
PARTICLE = atlas.ParticleMotion(1.0, (0.0, 1.0, 0.0), (0.0, 0.0, 2.0), (0.0, 0.0, 0.0), (1.0, 0.0, 0.0))
MADE: dict[str, Any] = {
    "SymmetricBody": atlas.SymmetricBody(1.0, 1.5),
    "Field": FIELD,
    "LaboratoryFrame": FIELD.frame((0.0, 0.0, 1.0)),
    "Quadric": atlas.Quadric(1.5, (1.0, 2.0)),
    "Hyperbola": atlas.Hyperbola(1.5, (1.0, 2.0)),
    "ElementaryMotion": atlas.ElementaryMotion(1.5, (1.0, 2.0), 0.7),
    "FreeMotion": atlas.FreeMotion(1.5, (0.1, 0.2, 0.3)),
    "GeneralMotion": atlas.GeneralMotion(1.5, (1.0, 2.0), (0.1, 0.2, 0.3)),
    "BallMotion": atlas.BallMotion(1.0, 2.0, momentum=(0.5, 0.25)),
    "TopMotion": atlas.TopMotion((1.0, 1.5), (0.1, 0.2), (0.0, 1.0), (0.1, 0.2, 0.3)),
    "ChargeMoments": atlas.ChargeMoments(1.0, 0.5),
    "EllipticMotion": atlas.EllipticMotion((0.8, 1.0, 1.3), (0.2, 1.0, 0.6), 1.7),
    "AsymmetricMotion": atlas.AsymmetricMotion((0.8, 1.0, 1.3), (0.2, 1.0, 0.6), (0.3, 0.7, 0.2)),
    "ParticleMotion": PARTICLE,
}
MADE["Flight"] = atlas.Flight(PARTICLE, atlas.ElementaryMotion(1.5, (0.0, 1.0), 0.0, 0.5), (1.0, 0.0, 0.0))
"""One object of each public class."""
OBJECTS: dict[tuple[str, str], Any] = {
    ("ParticleMotion.in_field", "field"): FIELD,
    ("Flight", "particle"): PARTICLE,
    ("Flight", "motion"): MADE["ElementaryMotion"],
}
"""Arguments that are objects of the atlas: a type checker knows what these are."""


def calls() -> Iterator[Any]:
    """Go through the public functions, the classes, and the methods that take an argument."""
    for name in atlas.__all__:
        thing = getattr(atlas, name)
        if not callable(thing) or (inspect.isclass(thing) and issubclass(thing, BaseException)):
            continue
        yield pytest.param(thing, inspect.getdoc(thing) or "", id=name)
        for member in sorted(dir(thing)) if inspect.isclass(thing) else ():
            if member.startswith("_") or not callable(getattr(thing, member)):
                continue
            bound = getattr(MADE[name], member)
            if inspect.ismethod(bound) and inspect.signature(bound).parameters:
                yield pytest.param(bound, inspect.getdoc(bound) or "", id=f"{name}.{member}")


@pytest.mark.parametrize(("call", "docstring"), list(calls()))
def test_what_a_wrong_input_raises_stands_in_the_docstring(call: Callable[..., Any], docstring: str) -> None:
    """With words in the place of numbers each raises an AtlasError, and says that or its kind where it is described."""
    taken = list(inspect.signature(call).parameters.values())
    needed = [x.name for x in taken if x.default is x.empty] or [taken[0].name]
    with pytest.raises(atlas.AtlasError) as raised:
        call(**{name: OBJECTS.get((call.__qualname__, name), "nonsense") for name in needed})
    kinds = [kind.__name__ for kind in type(raised.value).__mro__ if issubclass(kind, atlas.AtlasError)]
    assert any(kind in docstring for kind in kinds), f"{raised.value!r} is not announced"
