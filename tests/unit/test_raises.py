"""What the public names raise on a wrong input stands in their docstrings."""

import inspect
from collections.abc import Callable, Iterator
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest
from stress.extreme import times

import atlas
from atlas.core.bodies.inertia import inertia_tensor
from atlas.errors import AtlasError
from atlas.exact.inputs import rationals
from atlas.exact.motions.ball import BallMotion as Ball
from atlas.exact.motions.particle import ParticleMotion as Particle
from atlas.exact.surfaces.hyperbola import Hyperbola as Balls
from atlas.study.sweep.plan import Plan

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


SPIN = (1.0, 2.0, 3.0)
TABLE = {"ratio": 1.5, "B2": 1.0, "B3": 2.0, "omega2": [0.5, 0.7]}


def swept(**changed: Any) -> Any:
    """Return what a table would be made of."""
    given = {"parameters": TABLE, "quantities": ["k"]} | changed
    return Plan.of("elementary", **given)


def placed(attitude: Any) -> Any:
    """Return a motion that starts from an attitude."""
    return atlas.GeneralMotion.in_laboratory(1.5, SPIN, attitude, SPIN)


REFUSED: list[tuple[Callable[[], Any], str]] = [
    (lambda: atlas.ElementaryMotion(1.5, (0.0, 2.0), 0.0, 1.0).beside, "has no omega3"),
    (lambda: atlas.ElementaryMotion(1e-5, (1e-300, 1e300), 1e10).beside, "too large for a float"),
    (lambda: atlas.Hyperbola(1.5, (0.0, 1.0)).asymptotes(), "asymptotes only if"),
    (lambda: atlas.Hyperbola(1.5, (1.0, 0.0)).asymptotes(), "asymptotes only if"),
    (lambda: atlas.Hyperbola(1.5, (1e300, 1e300)).sample(10, reach=1e10), "The field must be smaller"),
    (lambda: atlas.Hyperbola(1.5, (1.0, 1.0)).sample(10**8 + 1), "must be at most"),
    (lambda: atlas.Hyperbola(1.5, (1.0, 1.0)).sample(np.array([800.0])), "beyond the largest float"),
    (lambda: atlas.Hyperbola(np.ones(2), (1.0, 1.0)).sample(10), "asked of one curve"),
    (lambda: atlas.Hyperbola(1.5, (np.ones(2), 1.0)).sample(10), "asked of one curve"),
    (lambda: atlas.Hyperbola(1.5, (1.0, np.ones(2))).sample(10), "asked of one curve"),
    (lambda: inertia_tensor(np.ones((2, 3, 3))), "not the shape (2, 3, 3)"),
    (lambda: placed(np.eye(2)), "rotation matrix (3, 3), not of shape"),
    (lambda: placed(-np.eye(3)), "and det R = 1"),
    (lambda: placed(np.eye(3) * (1 + 0.6e-9)), "R^T R = 1 to 1e-9"),
    (lambda: placed(np.eye(3) * (1 - 0.6e-9)), "R^T R = 1 to 1e-9"),
    (lambda: Particle(1, SPIN, SPIN, SPIN, SPIN, 0), "speed of light"),
    (lambda: Particle(0, SPIN, SPIN, SPIN, SPIN).drift, "Without a magnetic force"),
    (lambda: atlas.ElementaryMotion(1.5, (1.0, 2.0), 0.7).column(0, 1.0), "are 1, 2 and 3, not 0"),
    (lambda: atlas.ElementaryMotion(1.5, (1.0, 2.0), 0.7).column(4, 1.0), "are 1, 2 and 3, not 4"),
    (lambda: Ball(0, 1, (1, 1)), "must be positive"),
    (lambda: Balls(1.5, (0, 1)).omega3(1), "is the line omega2 = 0"),
    (lambda: Balls(1.5, (1, 1)).omega3(-1), "is the pole"),
    (lambda: rationals("123", "x", 3), "must hold 3 numbers"),
    (lambda: rationals((1, 2), "x", 3), "3"),
    (lambda: swept(parameters={"ratio": [[1.5]], "B2": 1, "B3": 2, "omega2": 1}), "one number or a list"),
    (lambda: swept(parameters={"ratio": [1, 1.5], "B2": [1] * 3, "B3": 2, "omega2": 1}, listed=True), "has 2 values"),
    (lambda: swept(digits=0), "at least one digit, not 0"),
    (lambda: swept(quantities=[]), "at least one quantity"),
    (lambda: atlas.sweep("elementary", TABLE, ["k"], out="a.txt"), "A table ends in .csv"),
    (lambda: atlas.sweep("elementary", TABLE, ["k"], rows=0), "at least one row, not 0"),
    (lambda: atlas.animate("motion", "omega2"), "say through which values omega2 goes"),
    (lambda: atlas.figure("loop", style=str(Path(__file__).parent)), "it is no file, nor a name"),
    (lambda: atlas.figure("loop", style={"lines.linewidth": "inf"}), "no number to draw with"),
    (lambda: atlas.figure("loop", style={"lines.lynewidth": 1}), "cannot be used"),
    (lambda: times((1e300,), Random(1), 1e-320), "gave fewer than"),  # noqa: S311  reproducible, not secret
]


@pytest.mark.parametrize(("make", "says"), REFUSED, ids=[says for _, says in REFUSED])
def test_what_is_refused_says_why(make: Callable[[], Any], says: str) -> None:
    """One sentence, with the number or the name that is wrong."""
    with pytest.raises(AtlasError) as told:
        make()
    assert says in str(told.value)
    assert "\n" not in str(told.value)


@pytest.mark.parametrize("off", [1 + 0.4e-9, 1 - 0.4e-9])
def test_an_attitude_is_taken_up_to_the_edge(off: float) -> None:
    """Half of 1e-9 in each length, 1e-9 in R^T R, is rounding: the nearest rotation is taken."""
    assert np.abs(placed(np.eye(3) * off).rotation(0.0) - np.eye(3)).max() <= 4 * np.finfo(float).eps
