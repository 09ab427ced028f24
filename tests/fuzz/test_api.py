"""Every public quantity on extreme arguments: a number, inf where it is beyond the floats, or one line; never NaN."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from values import answered, arrays, no_numbers, numbers, ratios, share

import atlas
from atlas.bodies import integrals, units
from atlas.motions.nutation.pseudo_oscillator import PseudoOscillator
from atlas.motions.register import FAMILIES

pytestmark = [
    pytest.mark.filterwarnings("ignore::RuntimeWarning"),  # NumPy's, of a float that overflows to inf
    pytest.mark.filterwarnings("ignore::atlas.errors.AtlasWarning"),  # of moments that differ by little
]

times = arrays(st.one_of(st.floats(-1e3, 1e3), numbers))
pairs = st.tuples(arrays(numbers), arrays(numbers))
vectors = st.one_of(
    st.tuples(numbers, numbers, numbers),
    st.sampled_from([np.zeros((2, 3)), np.ones((3, 3)), np.ones((2, 1, 3)), (1.0, 2.0), np.ones((0, 3))]),
)
bodies = st.one_of(
    arrays(ratios),
    st.builds(lambda a, b: atlas.SymmetricBody(a, b * a), st.floats(1e-300, 1e300), st.floats(1e-3, 2.0)),
)


def check_answers(make: Any, quantities: dict[str, Any]) -> None:
    """Ask for everything that an object answers."""
    made = None

    def construct() -> float:
        nonlocal made
        made = make()
        return 0.0

    if answered(construct) is None:
        return
    for name, ask in quantities.items():
        answered(lambda ask=ask: ask(made), name)


def attributes(*names: str) -> dict[str, Any]:
    """Return functions that ask for attributes."""
    return {name: lambda obj, name=name: getattr(obj, name) for name in names}


def at_times(t: Any) -> dict[str, Any]:
    """Return the values of elementary and general motions at some times."""
    names = ("rotation", "third_axis", "angular_velocity", "field_in_body", "angular_momentum")
    return {name: lambda m, name=name: getattr(m, name)(t) for name in names} | {"invariants": lambda m: m.invariants()}


@pytest.mark.slow
@share(0.1, 60)
@given(bodies, pairs, arrays(numbers), st.none() | arrays(numbers), times, st.floats(-10, 10), st.integers(0, 9))
def test_any_elementary_motion_answers_or_refuses(
    I: Any, field: Any, omega2: Any, omega3: Any, t: Any, step: float, count: int
) -> None:
    """All that an elementary motion answers."""
    check_answers(
        lambda: atlas.ElementaryMotion(I, field, omega2, omega3),
        attributes("omega2", "omega3", "k", "phi")
        | at_times(t)
        | {
            "invariants at t": lambda m: m.invariants(t),
            "rotation_grid": lambda m: m.rotation_grid(step, step, count),
            "beside": lambda m: m.beside.k,
        },
    )


@st.composite
def families(draw: Any) -> tuple[str, list[Any]]:
    """Draw a family of the register and its parameters: as they stand there, ordinary or extreme."""
    family = draw(
        st.sampled_from([candidate for candidate in FAMILIES.values() if candidate.at_once > 1])
    )  # others take seconds
    arguments = []
    for p in family.parameters:
        component = st.one_of(st.floats(*p.range), st.floats(*p.range), numbers)
        usual = (st.just(p.default),) * bool(p.default)
        value = draw(st.one_of(*usual, *usual, st.tuples(*[component] * len(p.names))))
        arguments.append(value if p.columns else value[0])
    return family.name, arguments


@pytest.mark.slow
@share(0.1, 60)
@given(families(), times)
def test_any_member_of_a_family_answers_or_refuses(case: tuple[str, list[Any]], t: Any) -> None:
    """All that the register lists of a motion or surface, and a grid of its matrices."""
    family, arguments = FAMILIES[case[0]], case[1]
    functions = {s.name: lambda m, s=s: s.method_of(m)(t) for s in family.sampled}
    functions |= {"rotation_grid": lambda m: m.rotation_grid(-0.3, 0.7, 9)} if "R" in functions else {}
    check_answers(lambda: family.kernels()(*arguments), {q.name: q.value for q in family.quantities} | functions)


@pytest.mark.slow
@share(0.1, 40)
@given(bodies, pairs, vectors)
def test_any_quadric_answers_or_refuses(I: Any, field: Any, omega: Any) -> None:
    """All that a quadric answers."""
    check_answers(
        lambda: atlas.Quadric(I, field),
        attributes("beta", "a2", "a3", "semi_axes", "centre", "axes")
        | {"canonical": lambda q: q.canonical(omega), "residual": lambda q: q.residual(omega)},
    )


@pytest.mark.slow
@share(0.1, 40)
@given(bodies, st.tuples(numbers, numbers), arrays(numbers), st.sampled_from([2, 3, 7, 1, 0, 2.5, [0.0, 1.0], [800.0]]))
def test_any_hyperbola_answers_or_refuses(I: Any, field: Any, omega2: Any, points: Any) -> None:
    """All that a hyperbola answers."""
    check_answers(
        lambda: atlas.Hyperbola(I, field),
        attributes("pole", "unstable_band", "special", "asymptotes")
        | {
            "omega3": lambda h: h.omega3(omega2),
            "frequencies": lambda h: h.frequencies(omega2),
            "stability": lambda h: h.stability(omega2),
            "sample": lambda h: h.sample(points),
        },
    )


@pytest.mark.slow
@share(0.1, 40)
@given(arrays(numbers), arrays(numbers), pairs, times)
def test_any_ball_motion_answers_or_refuses(inertia: Any, larmor: Any, momentum: Any, t: Any) -> None:
    """All that a ball answers."""
    check_answers(
        lambda: atlas.BallMotion(inertia, larmor, momentum),
        attributes("gamma", "k_hat")
        | {
            "rotation": lambda m: m.rotation(t),
            "angular_momentum": lambda m: m.angular_momentum(t),
            "angular_velocity": lambda m: m.angular_velocity(t),
        },
    )


@pytest.mark.slow
@share(0.1, 40)
@given(arrays(numbers), vectors, vectors, vectors, vectors, st.one_of(st.just(1.0), numbers), times)
def test_any_particle_motion_answers_or_refuses(mu: Any, E: Any, B: Any, y: Any, v: Any, c: Any, t: Any) -> None:
    """All that a particle answers."""
    check_answers(
        lambda: atlas.ParticleMotion(mu, E, B, y, v, c),
        attributes("cyclotron_frequency", "period", "prime", "drift", "radius", "axes", "case", "kind")
        | {
            "position": lambda m: m.position(t),
            "velocity": lambda m: m.velocity(t),
            "guiding_centre": lambda m: m.guiding_centre(t),
        },
    )


@share(0.1, 40)
@given(bodies, pairs, vectors, vectors, arrays(numbers))
def test_any_integrals_and_cubic_answer_or_refuse(I: Any, field: Any, omega: Any, K: Any, u: Any) -> None:
    """The integrals of a state, the cubic and the quartic."""
    answered(lambda: list(vars(integrals.integrals(I, omega, K)).values()))
    check_answers(
        lambda: PseudoOscillator(I, field, omega),
        attributes("coefficients")
        | {
            "integrals": lambda p: vars(p.integrals),
            "acceleration": lambda p: p.acceleration(u),
            "stiffness": lambda p: p.stiffness(u),
            "quartic": lambda p: p.quartic(u),
        },
    )


@share(0.05, 40)
@given(vectors, vectors, numbers, numbers, vectors)
def test_any_field_and_frame_answer_or_refuse(B: Any, E: Any, mu: float, c: float, axis: Any) -> None:
    """A field, its frame, and its conversions by units."""
    check_answers(
        lambda: atlas.Field(B, E, mu, c),
        attributes("prime")
        | {
            "frame": lambda f: f.frame(axis).matrix,
            "(B2, B3)": lambda f: f.frame(axis).field,
            "to_user": lambda f: f.frame(axis).to_user(E),
        },
    )
    answered(lambda: units.charge_to_mass(mu, c))
    answered(lambda: units.cyclotron_frequency(mu, c))


@share(0.05, 40)
@given(vectors, vectors, numbers, numbers, numbers)
def test_any_body_answers_or_refuses(diagonal: Any, masses: Any, mass: float, radius: float, height: float) -> None:
    """Bodies by their shapes, their matrices, their points."""
    for make in (atlas.SymmetricBody.ring, atlas.SymmetricBody.disk, atlas.SymmetricBody.sphere):
        answered(lambda make=make: [make(mass, radius).I2, make(mass, radius).I3])
    for make in (atlas.SymmetricBody.cylindrical_shell, atlas.SymmetricBody.spheroid):
        answered(lambda make=make: [make(mass, radius, height).I2, make(mass, radius, height).I3])
    answered(lambda: atlas.SymmetricBody.from_mass_matrix(diagonal).axes)
    answered(lambda: atlas.SymmetricBody.from_point_masses(masses, np.eye(3)).axes)
    answered(lambda: atlas.SymmetricBody(mass, radius).ratio)


CALLS = {
    "ElementaryMotion.ratio": lambda x: atlas.ElementaryMotion(x, (1.0, 2.0), 0.7),
    "ElementaryMotion.field": lambda x: atlas.ElementaryMotion(1.5, x, 0.7),
    "ElementaryMotion.B3": lambda x: atlas.ElementaryMotion(1.5, (1.0, x), 0.7),
    "ElementaryMotion.omega2": lambda x: atlas.ElementaryMotion(1.5, (1.0, 2.0), x),
    "ElementaryMotion.omega3": lambda x: atlas.ElementaryMotion(1.5, (0.0, 2.0), 0.0, x),
    "rotation.t": lambda x: atlas.ElementaryMotion(1.5, (1.0, 2.0), 0.7).rotation(x),
    "rotation.out": lambda x: atlas.ElementaryMotion(1.5, (1.0, 2.0), 0.7).rotation(1.0, out=x),
    "rotation_grid.count": lambda x: atlas.ElementaryMotion(1.5, (1.0, 2.0), 0.7).rotation_grid(0.0, 1.0, x),
    "rotation_grid.out": lambda x: atlas.ElementaryMotion(1.5, (1.0, 2.0), 0.7).rotation_grid(0.0, 1.0, 3, out=x),
    "column.j": lambda x: atlas.ElementaryMotion(1.5, (1.0, 2.0), 0.7).column(x, 0.0),
    "Quadric.field": lambda x: atlas.Quadric(1.5, x),
    "Quadric.canonical": lambda x: atlas.Quadric(1.5, (1.0, 2.0)).canonical(x),
    "Hyperbola.ratio": lambda x: atlas.Hyperbola(x, (1.0, 2.0)),
    "Hyperbola.sample": lambda x: atlas.Hyperbola(1.5, (1.0, 2.0)).sample(x),
    "Hyperbola.reach": lambda x: atlas.Hyperbola(1.5, (1.0, 2.0)).sample(5, reach=x),
    "BallMotion.momentum": lambda x: atlas.BallMotion(1.0, 0.5, x),
    "ParticleMotion.mu": lambda x: atlas.ParticleMotion(x, [0, 0, 0], [0, 0, 1], [0, 0, 0], [1, 0, 0]),
    "ParticleMotion.B": lambda x: atlas.ParticleMotion(1.0, [0, 0, 0], x, [0, 0, 0], [1, 0, 0]),
    "ParticleMotion.position": lambda x: atlas.ParticleMotion(1, [0, 0, 0], [0, 0, 1], [0] * 3, [1, 0, 0]).position(x),
    "trochoid.radius": lambda x: atlas.ParticleMotion.trochoid(1.0, [0, 1, 0], [0, 0, 1], x),
    "Field.B": atlas.Field,
    "frame.axis": lambda x: atlas.Field([0, 0, 1.0]).frame(x),
    "SymmetricBody.I3": lambda x: atlas.SymmetricBody(1.0, x),
    "ring.radius": lambda x: atlas.SymmetricBody.ring(1.0, x),
    "from_mass_matrix": atlas.SymmetricBody.from_mass_matrix,
    "from_point_masses": lambda x: atlas.SymmetricBody.from_point_masses(x, np.eye(3)),
    "larmor_field.units": lambda x: units.larmor_field(1.0, 1.0, x),
}


@pytest.mark.slow
@share(0.1, 200)
@given(
    st.sampled_from(sorted(CALLS)), st.one_of(no_numbers, st.lists(no_numbers | numbers, max_size=4), arrays(numbers))
)
def test_non_numbers_are_refused(name: str, value: Any) -> None:
    """Text, None, NaN, objects and ragged lists in any place are told in one line."""
    answered(lambda: [CALLS[name](value), 0.0][1], name)
