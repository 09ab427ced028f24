"""Parts of a motion made alone: lines in two words, the further turn of a top."""

from collections.abc import Callable, Iterator
from random import Random
from typing import Any

import numpy as np
import pytest
from flint import arb, ctx
from stress.regimes import GENERAL
from stress.tops import TOPS

import atlas
from atlas.bodies.inertia import mass_matrix_from_inertia
from atlas.errors import DomainError
from atlas.maps.bifurcation import momentum_map
from atlas.maps.wells import Wells
from atlas.motions.nutation.functions import Line
from atlas.motions.nutation.kernel_general import standing
from atlas.motions.nutation.kernel_top import balls
from atlas.motions.nutation.single import SingleMotion, SingleTop
from atlas.motions.nutation.swing import Swing

EPS = 2.0**-52


def top(*inputs: Any) -> SingleTop:
    """Return a top made alone."""
    return SingleTop(balls(*np.hstack(inputs).tolist()))


def draw_motions(regime: str, count: int) -> Iterator[SingleMotion]:
    """Yield motions of a regime, those left out that floats do not hold."""
    random = Random(3)  # noqa: S311  reproducible, not secret
    for _ in range(count):
        try:
            if regime in TOPS:
                yield top(*TOPS[regime](random))
            else:
                I, B, omega = GENERAL[regime](random)
                yield standing(1.0, I, 0.0, *B, *omega)
        except DomainError:
            continue


def swinging() -> Iterator[SingleTop]:
    """Yield tops with a further turn, first some ever nearer to the separatrix between n and -n."""
    for e, d in ((0.0, 1e-30), (1e-15, 0.0), (0.0, 1e-10), (1e-3, 0.0)):
        yield top((1.0, 1.0), (0.0, 1.0), (1.0, 0.0), (2.0 + e, 0.0, d), 0.0, 3.0)
    for regime in TOPS:
        for motion in draw_motions(regime, 29 if regime == "top, near the cubic" else 9):
            if isinstance(motion, SingleTop) and isinstance(motion.pair.swing, Swing):
                yield motion


@pytest.mark.slow
def test_the_additional_turn_of_a_top_agrees_with_balls() -> None:
    """Its part that is periodic, all through half a period, within 8 ulp of one or of itself, in all its forms."""
    forms = set()
    for motion in swinging():
        swing = motion.pair.swing
        with ctx.workprec(motion.pair.precision + 64):
            exact = motion.exact.solution.swing
            half, rate = exact.lattice.half, exact.lattice.rate
            forms.add((swing.form, swing.sign))
            ends = (half, exact.depth / rate if swing.form == "hyperbolic" and swing.sign > 0 else half / 3)
            for s in (end * k / 7 for end in ends for k in (-7, -5, 1, 2, 4, 6, 8) if abs(end * k / 7) <= half):
                x, true = rate * s, exact.kappa * exact.oscillation(s) / 2
                if swing.form == "trigonometric":
                    components = (2 * x).cos(), (2 * x).sin()
                    angle = swing.of_circle(*(np.asarray(swing._number(component)) for component in components))
                else:
                    angle = swing.of_line(np.asarray(swing._number(x)))
                assert abs(float(true) - float(angle)) <= 8 * EPS * max(1.0, abs(float(true)))
    assert {("hyperbolic", 1), ("hyperbolic", -1), ("trigonometric", -1), ("trigonometric", 1)} <= forms


@pytest.mark.parametrize("k3", [0.0, 1.25, 20.0])
def test_a_top_with_the_integrals_of_a_spin_moves_as_balls_do(k3: float) -> None:
    """One of its two parameters is constant; R is within 16 ulp(1) at any time, whatever the further turn."""
    omega, potential = (0.0, 0.5, 2.0 - 6.0 * k3 / 5.0), (1.5625 + 2.0 * k3, -1.5625 - 2.0 * k3 * k3)
    top_still = top((1.0, 0.5), (0.0, k3), (4.0, 3.0), omega, potential)
    assert top_still.pair.functions.constant
    assert (top_still.pair.swing and top_still.pair.swing.is_large) == {0.0: None, 1.25: False, 20.0: True}[k3]
    for t in (0.3, -7.7, 1e4):
        with ctx.workprec(300):
            true = [[float(x) for x in row] for row in top_still.exact.rotation(t)]
        assert np.abs(top_still.rotation(t) - true).max() <= 16 * EPS


@pytest.mark.parametrize(("slope", "start"), [(0.7, 0.0), (0.7, 1.3), (-3e-5, 2e9), (1e120, -1e3), (2.0, -1e-30)])
def test_a_linear_phase_is_accurate_in_double_double(slope: float, start: float) -> None:
    """Slope times t + start at times in two words, to 2^-100 of its terms, the first word being their sum rounded."""
    with ctx.workprec(400):
        a, b = arb(slope) / 3, arb(start) / 7
        t = np.random.default_rng(0).normal(size=50) * 10.0 / (abs(slope) or 1.0)
        low_word = t * 2.0**-54
        x, deficit = Line(a, b).at(t, low_word)
        assert (abs(deficit) <= 4 * np.spacing(abs(x) + abs(float(b)))).all()
        for time, less, high, low in zip(t.tolist(), low_word.tolist(), x.tolist(), deficit.tolist(), strict=True):
            size = abs(a * time) + abs(b)
            assert abs(arb(high) + arb(low) - a * (arb(time) + arb(less)) - b) <= size * 2.0**-100


ZERO, UP = np.zeros(3), np.array([0.0, 0.0, 1.0])


def parallel_to(x: Any, unit: Any) -> Any:
    """Return a vector for each number of an array."""
    return np.asarray(x)[:, None] * np.array(unit)


def particle(mu: Any = 1.0, E: Any = (0.0, 1.0, 0.0), B: Any = UP, v: Any = ZERO, c: Any = 1.0) -> Any:
    """Return particles that start at the origin."""
    return atlas.ParticleMotion(mu, E, B, ZERO, v, c)


def skew(x: Any) -> Any:
    """Return tensors whose upper right corner is of this size, and symmetric if it is 1."""
    tensors = np.array([3.0 * np.eye(3) + 1.0] * 2)
    tensors[:, 0, 2] = x
    return tensors


CASES: list[tuple[Callable[[Any], Any], float, float, str]] = [
    (lambda x: atlas.BallMotion(x, 1.0, (1.0, 1.0)), 1.0, -1.5, "must be positive, not -1.5"),
    (lambda x: atlas.ElementaryMotion(x, (1.0, 2.0), 0.7), 1.0, 2.5, "I3/I2 = 2.5"),
    (lambda x: atlas.ElementaryMotion(x, (1.0, 2.0), 0.7), 1.0, -0.5, "not -0.5"),
    (lambda x: atlas.ElementaryMotion(1.5, (x, 2.0), 0.0, 0.0).beside, 1.0, 0.0, "has no omega3"),
    (lambda x: atlas.ElementaryMotion(1.5, (1.0, x), 5.0).beside, 1.0, 1.7e308, "too large"),
    (lambda x: atlas.GeneralMotion(1.5, (1.0, 2.0), (0.1, 0.2, x)), 1.0, np.inf, "must be finite, not inf"),
    (lambda x: atlas.GeneralMotion(1.5, (1.0, 2.0), (0.1, 0.2, x)).invariants(), 1.0, 1e200, "too large"),
    (lambda x: atlas.TopMotion((1.0, x), (0, 0), (0.6, 0.8), (1, 1, 1)), 1.0, 2.5, "I2 = 1.0, I3 = 2.5"),
    (lambda x: atlas.TopMotion((x, 0.5), (0, 0), (0.6, 0.8), (1, 1, 1)), 1.0, -1.0, "I2 = -1.0, I3 = 0.5"),
    (lambda x: atlas.TopMotion((1.0, 0.5), (0, 0), (0.0, x), (1, 1, 1)), 1.0, 0.0, "zero vector"),
    (lambda x: atlas.Quadric.of_top((1.0, 0.5), (0, 0), (1.0, x), 3.0).D, 1.0, 0.0, "infinite"),
    (lambda x: atlas.Quadric(1.5, (x, 2.0)).a2, 1.0, 0.0, "a2 of (54) is infinite"),
    (lambda x: atlas.Quadric(1.5, (x, -2.0)).a3, 1.0, 0.0, "a3 of (54) is infinite"),
    (lambda x: atlas.Quadric(1.5, (x, 0.0)).beta, 1.0, 0.0, "no direction"),
    (lambda x: atlas.Hyperbola(1.5, (x, 2.0)).omega3(0.7), 1.0, 0.0, "omega3 is free"),
    (lambda x: atlas.Hyperbola(1.5, (x, 2.0)).least_stability, 1.0, 0.0, "omega3 is free"),
    (lambda x: atlas.Hyperbola(1.5, (1.25, 2.0)).omega3(x), 1.0, -1.25, "-B2 = -1.25 is the pole"),
    (lambda x: particle(c=x), 1.0, -2.0, "c must be positive, not -2.0"),
    (lambda x: particle(mu=x).drift, 1.0, 0.0, "no drift"),
    (lambda x: particle(E=parallel_to(x, (0.0, 1.0, 0.0))).axes, 1.0, 0.0, "no axis along"),
    (lambda x: particle(B=ZERO, v=parallel_to(x, UP)).position(10.0), 1.0, 1.7e308, "The position is too large"),
    (lambda x: particle(B=ZERO, E=parallel_to(x, UP), mu=4.0), 1.0, 1.7e308, "The acceleration mu E is too large"),
    (lambda x: Wells(0.3, 0.5).potential(0.2, x), 0.5, -1.0, "both left out"),
    (lambda x: momentum_map(1.5, UP, parallel_to(x, UP)), 1.0, 0.0, "needs a field"),
    (lambda x: atlas.Field(B=(*x, 1.0), mu=0.5), 1.0, 5e-324, "too small"),
    (lambda x: atlas.SymmetricBody.from_point_masses((*x, 1, 1), np.eye(4, 3)), 1.0, -1.0, "one is -1.0"),
    (lambda x: mass_matrix_from_inertia(skew(x)), 1.0, 2.0, "must be symmetric"),
]


@pytest.mark.parametrize(
    ("make", "value_good", "bad", "says"), CASES, ids=[f"{k}: {case[3]}" for k, case in enumerate(CASES)]
)
def test_one_bad_entry_of_an_array_is_refused(
    make: Callable[[Any], Any], value_good: float, bad: float, says: str
) -> None:
    """Whether it comes first or last, or all are bad."""
    make(np.array([value_good, value_good]))
    for entries in ([bad, value_good], [value_good, bad], [bad, bad]):
        with pytest.raises(atlas.AtlasError) as refused, np.errstate(all="ignore"):
            make(np.array(entries))
        assert says in str(refused.value)


TWO = np.array([0.7, 1.2])
FAMILIES: list[Callable[[Any], Any]] = [
    lambda x: atlas.ElementaryMotion(x, (1.0, 2.0), 0.7),
    lambda x: atlas.FreeMotion(x, (0.3, 0.7, 0.2)),
    lambda x: atlas.BallMotion(x, 0.5, (0.3, -0.7)),
    lambda x: atlas.GeneralMotion(x, (1.0, 2.0), (0.3, 0.7, 0.2)),
    lambda x: atlas.TopMotion((1.0, x), (0.5, 0.25), (0.6, 0.8), (0.3, 0.7, 0.2), 3.0),
    lambda x: particle(mu=x, v=(0.3, 0.7, 0.2)),
]
OF_TIME = (
    "rotation", "third_axis", "angular_velocity", "field_in_body", "angular_momentum", "position", "velocity",
    "guiding_centre",
)  # fmt: skip


@pytest.mark.parametrize("make", FAMILIES, ids=lambda make: type(make(1.0)).__name__)
@pytest.mark.parametrize("shape", [(), (1,), (0, 2), (3, 2), (1001, 2)], ids=str)
def test_functions_of_time_of_an_array_agree_with_each_motion(make: Callable[[Any], Any], shape: Any) -> None:
    """Shapes too, at no, a few and many times each, within 24 ulp(1); constants are so to the bit."""
    many, motions = make(TWO), [make(float(x)) for x in TWO]
    t = np.linspace(-2.0, 3.0, int(np.prod(shape))).reshape(shape)
    for name in OF_TIME:
        if not hasattr(many, name):
            continue
        values, true = (
            getattr(many, name)(t),
            [getattr(motion, name)(np.broadcast_to(t, (*shape[:-1], 2))[..., i]) for i, motion in enumerate(motions)],
        )
        assert values.shape == np.stack(true, axis=len(shape[:-1])).shape
        assert np.abs(values - np.stack(true, axis=len(shape[:-1]))).max(initial=0.0) <= 24 * 2.0**-52 * 4, name
