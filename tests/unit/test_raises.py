"""Errors that the public names raise on a wrong input stand in their docstrings."""

import inspect
from collections.abc import Callable, Iterator
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest
from stress.extreme import times

import atlas
from atlas.arithmetic.certified_inputs import rationals
from atlas.bodies.inertia import inertia_tensor
from atlas.bodies.units import larmor_field
from atlas.errors import AtlasError
from atlas.motions.elementary.certified_ball import BallMotion as Ball
from atlas.motions.elementary.certified_hyperbola import Hyperbola as Balls
from atlas.motions.particle.certified import ParticleMotion as Particle
from atlas.pictures import recipes
from atlas.sweeps.plan import Plan

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
"""Arguments that are objects of the atlas: a type checker knows their types."""


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
def test_errors_of_wrong_inputs_are_documented(call: Callable[..., Any], docstring: str) -> None:
    """With words in the place of numbers each raises an AtlasError, and says that or its kind where it is described."""
    parameters = list(inspect.signature(call).parameters.values())
    names_required = [x.name for x in parameters if x.default is x.empty and x.kind is not x.VAR_KEYWORD] or [
        parameters[0].name
    ]
    with pytest.raises(atlas.AtlasError) as raised:
        call(**{name: OBJECTS.get((call.__qualname__, name), "nonsense") for name in names_required})
    kinds = [kind.__name__ for kind in type(raised.value).__mro__ if issubclass(kind, atlas.AtlasError)]
    assert any(kind in docstring for kind in kinds), f"{raised.value!r} is not announced"


SPIN = (1.0, 2.0, 3.0)
TABLE = {"ratio": 1.5, "B2": 1.0, "B3": 2.0, "omega2": [0.5, 0.7]}


def swept(**changed: Any) -> Any:
    """Return the plan of a table."""
    arguments = {"parameters": TABLE, "quantities": ["k"]} | changed
    return Plan.of("elementary", **arguments)


def placed(attitude: Any) -> Any:
    """Return a motion that starts from an attitude."""
    return atlas.GeneralMotion.in_laboratory(1.5, SPIN, attitude, SPIN)


def of_top(kind: Any, direction: Any, inertia: Any = (1.0, 0.5), coupling: Any = (0, 0)) -> Any:
    """Return the quadric or the hyperbola of a top."""
    return kind.of_top(inertia, coupling, direction)


def fitted(**arguments: Any) -> Any:
    """Return a fit at nine times."""
    return atlas.fit(np.arange(9.0), **arguments)


ROUND, RATES = atlas.ElementaryMotion(1.5, (1.0, 2.0), 0.7), np.ones((9, 3))
Q, H = atlas.Quadric, atlas.Hyperbola
REFUSED: list[tuple[Callable[[], Any], str]] = [
    (lambda: atlas.ElementaryMotion(1.5, (0.0, 2.0), 0.0, 1.0).beside, "has no omega3"),
    (lambda: atlas.ElementaryMotion(1e-5, (1e-300, 1e300), 1e10).beside, "too large for a float"),
    (lambda: atlas.ElementaryMotion(1.5, (1.0, 2.0), -1.0), "is the pole of omega3"),
    (lambda: atlas.ElementaryMotion(1.5, (1.0, 2.0), np.array([0.7, -1.0])), "is the pole of omega3"),
    (lambda: atlas.ElementaryMotion(1.5, (1.0, 2.0), np.array([-1.0, 0.7])), "is the pole of omega3"),
    (lambda: atlas.ElementaryMotion(1.5, (0.0, 2.0), 0.3), "B2 = 0"),
    (lambda: atlas.ElementaryMotion(1.5, ([1.0, 0.0], 2.0), [0.5, 0.1]), "B2 = 0"),
    (lambda: atlas.ElementaryMotion(1.5, (0.0, 0.0), 0.3), "free"),
    (lambda: atlas.ElementaryMotion(1.5, ([1.0, 0.0], 0.0), [0.5, 0.1]), "give it"),
    (lambda: atlas.ElementaryMotion(1.5, (1.0, 2.0), 0.7, 0.1), "follows"),
    (lambda: atlas.ElementaryMotion(1.5, ([1.0, 2.0], 2.0), [0.5, 0.1], [1.0, 1.0]), "leave it out"),
    (lambda: atlas.ElementaryMotion(2.1, (1.0, 2.0), 0.7), "No body"),
    (lambda: atlas.ElementaryMotion(0.0, (1.0, 2.0), 0.7), "positive"),
    (lambda: atlas.ElementaryMotion(1.5, (1.0, np.nan), 0.7), "finite"),
    (lambda: atlas.ElementaryMotion(1.5, (1.0, 2.0), np.inf), "finite"),
    (lambda: atlas.ElementaryMotion(1.5, (1.0, 2.0, 3.0), 0.7), "components"),
    (lambda: atlas.ElementaryMotion(1.5, 1.0, 0.7), "components"),
    (lambda: ROUND.rotation_grid(0.0, 1.0, 1e140), "is no memory for an"),
    (lambda: ROUND.rotation_grid(0.0, 1.0, 10**15), "(1000000000000000, 3"),
    (lambda: atlas.motion((1, 1, 5.0), (0, 0, 1), (0, 0, 1)), "5 exceeds 1 + 1 by 3"),
    (lambda: atlas.motion((1, 2), (0, 0, 1), (0, 0, 1)), "give ratios I3/I2 as a list"),
    (lambda: atlas.motion([[1, 0.2, 0], [0, 1, 0], [0, 0, 1]], SPIN, SPIN), "elements (1, 2) and (2, 1) differ by 0.2"),
    (
        lambda: atlas.motion([[1, 0.1, 0], [0.1 + 2e-6, 1, 0], [0, 0, 1]], SPIN, SPIN),
        "elements (1, 2) and (2, 1) differ by 2e-06: give one value",
    ),
    (
        lambda: atlas.SymmetricBody.from_mass_matrix((1.0, 1.0 + 6e-9, 3.0)),
        "the closest two differ by 6e-09 of the larger",
    ),
    (lambda: atlas.motion(-np.eye(3), (0, 0, 1), (0, 0, 1)), "must be positive"),
    (lambda: atlas.motion(1.5, (0, 1), (0, 0, 1)), "The field must have the 3 components (B1, B2, B3)"),
    (lambda: atlas.motion(1.5, SPIN, (0, 1)), "The angular velocity must have"),
    (lambda: atlas.motion(1.5, SPIN, SPIN, -np.eye(3)), "must be a rotation matrix"),
    (lambda: atlas.motion((1, 1, np.array([1.5, 1.0])), SPIN, SPIN, np.zeros((2, 2))), "must be a rotation matrix"),
    (lambda: atlas.motion((1, np.array([1.0, 1.2]), 1.5), SPIN, SPIN), "Some of these bodies are symmetric"),
    (lambda: H(1.5, (1.0, 2.0)).sample(10**400), "The points must be a real number"),
    (lambda: atlas.clebsch([[1], [1, 2]], SPIN, SPIN), "The inertia tensor must be a real number or an array"),
    (lambda: ROUND.euler_angles(1.0, 3), "seq is three letters"),
    (lambda: atlas.SymmetricBody.from_mass_matrix((1.0, 1.0, 3.0), tolerance=np.nan), "The tolerance must be finite"),
    (
        lambda: atlas.check([0.0], rotations=np.eye(3)[None], motion=ROUND, threshold=[6]),
        "correct digits, must be one number",
    ),
    (lambda: fitted(rotation=np.ones((9, 3, 3)), epoch=10**400), "The epoch must be a real number"),
    (lambda: fitted(rotation=np.array([np.eye(3)] * 9), fix={"ratio": 10**400}), "ratio: value must be a number"),
    (lambda: ROUND.spectrum(of=np.ones(2)), "A motion has no spectrum of"),
    (lambda: of_top(Q, (1.0, 1.0), inertia=(1.0, 2.5)), "at most 2 I2"),
    (lambda: of_top(Q, (0.0, 0.0)), "zero vector"),
    (lambda: of_top(Q, (0.0, 1.0), coupling=(0, float("nan"))), "finite"),
    (lambda: of_top(H, (0.0, 1.0)), "n2 = 0"),
    (lambda: of_top(H, (1.0, 1.0)).omega3(0.0), "pole"),
    (lambda: of_top(H, (1.0, 1.0)).stability([1.0, 0.0]), "pole"),
    (lambda: of_top(H, (1.0, 0.0)).branches(), "two lines"),
    (lambda: atlas.monodromy((1.0, 0.5), 3.0, linear=1.0), "no isolated one"),
    (lambda: atlas.monodromy((1.0, 3.0), 1.0), "I3 is at most 2 I2"),
    (lambda: atlas.monodromy((0.0, 0.0), 1.0), "both are positive"),
    (lambda: atlas.monodromy((1.0, 1.0), 1e308, linear=1e308), "too large or too small"),
    (lambda: atlas.monodromy((1.0, 1.0), 0.0, linear=5e-324), "too large or too small"),
    (lambda: atlas.monodromy((1.0, 0.5), 0.5, linear=1.0, points=3), "give more points"),
    (fitted, "exactly one of rotation"),
    (lambda: fitted(axis=np.ones((9, 2))), "an array"),
    (lambda: fitted(axis=np.zeros((9, 3))), "differs from a vector of length 1"),
    (lambda: fitted(rotation=np.zeros((9, 3, 3))), "differs from a rotation matrix"),
    (lambda: fitted(angular_velocity=np.nan * RATES), "no row with all its numbers"),
    (lambda: fitted(angular_velocity=RATES, sigma=-1.0), "sigma"),
    (lambda: fitted(angular_velocity=RATES, family="round"), "family"),
    (lambda: fitted(angular_velocity=RATES, params={"mass": 1.0}), "no 'mass'"),
    (lambda: fitted(angular_velocity=RATES, epoch=1e6), "epoch"),
    (lambda: fitted(signal=np.ones(9)), "function"),
    (lambda: larmor_field(1.0, 1.0, np.ma.masked_array([0.0], [True])), "not MaskedArray."),
    (lambda: larmor_field(1.0, 1.0, "x" * 5000), "Units are 'SI' or 'Gaussian'"),
    (lambda: recipes.load("tipping_disk").scene(count=-90), "count must lie between 2 and 24, not -90"),
    (lambda: recipes.load("phase_portrait").scene(levels=-1), "levels must lie between 1 and 40, not -1"),
    (lambda: atlas.Hyperbola(1.5, (1.0, 2.0)).sample(3e10), "at most 100000000, not 3e+10"),
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
    (lambda: placed(np.eye(3) * (1 + 1.1e-3)), "R^T R = 1 to 0.002"),
    (lambda: placed(np.eye(3) * (1 - 1.1e-3)), "R^T R = 1 to 0.002"),
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
    (lambda: swept(digits=0), "at least 1, not 0"),
    (lambda: swept(quantities=[]), "at least one quantity"),
    (lambda: atlas.sweep("elementary", TABLE, ["k"], out="a.txt"), "A table ends in .csv"),
    (lambda: atlas.sweep("elementary", TABLE, ["k"], rows=0), "rows of a part must be at least 1, not 0"),
    (lambda: atlas.animate("motion", "omega2"), "say through which values omega2 goes"),
    (lambda: atlas.figure("cone", style=str(Path(__file__).parent)), "it is no file, nor a name"),
    (lambda: atlas.figure("cone", style={"lines.linewidth": "inf"}), "no number to draw with"),
    (lambda: atlas.figure("cone", style={"lines.lynewidth": 1}), "cannot be used"),
    (lambda: times((1e300,), Random(1), 1e-320), "gave fewer than"),  # noqa: S311  reproducible, not secret
]


@pytest.mark.parametrize(("make", "says"), REFUSED, ids=[says for _, says in REFUSED])
def test_refusals_give_a_reason(make: Callable[[], Any], says: str) -> None:
    """One sentence, with the number or the name that is wrong."""
    with pytest.raises(AtlasError) as refused:
        make()
    assert says in str(refused.value)
    assert "\n" not in str(refused.value)
    assert len(str(refused.value)) < 300


@pytest.mark.parametrize("off", [1 + 0.4e-9, 1 - 0.4e-9])
def test_an_attitude_is_taken_up_to_the_edge(off: float) -> None:
    """Half of 1e-9 in each length, 1e-9 in R^T R, is rounding: the nearest rotation is taken."""
    assert np.abs(placed(np.eye(3) * off).rotation(0.0) - np.eye(3)).max() <= 4 * np.finfo(float).eps
