"""The general motion in balls: enclosed by integrated equations, its laws, its cases decided exactly."""

from collections.abc import Iterator
from fractions import Fraction
from typing import Any

import mpmath
import pytest
from flint import acb, acb_poly, arb, ctx, fmpq
from oracles.balls import taylor
from oracles.taylor import taylor as integrated

from atlas.arithmetic.certified_digits import certified
from atlas.errors import DomainError
from atlas.motions.elementary.certified import ElementaryMotion, FreeMotion
from atlas.motions.nutation.certified_cayley_klein import matrix
from atlas.motions.nutation.certified_general import GeneralMotion
from atlas.motions.nutation.certified_top import TopMotion

KINDS: dict[str, tuple[float, tuple[float, float], tuple[float, float, float]]] = {
    "at rest": (1.5, (1, 2), (0, 0, 0)),
    "precession": (0.5, (3, 1), (0, -1.5, -2)),
    "spin along the field": (1.5, (0, 2), (0, 0, 0.4)),
    "free body": (1.5, (0, 0), (0.3, 0.7, 0.4)),
    "ball": (1, (1, 2), (0.3, 0.7, 0.2)),
    "nutation, four real roots": (1.5, (1, 2), (0.3, 0.7, 0.2)),
    "nutation, two real roots": (0.5, (1, 0.25), (0.1, -0.4, 0.3)),
    "separatrix": (0.75, (20, 15), (6, -24.5, -7)),
    "separatrix, triple root": (0.5, (1, -3), (0, 1.5, 2)),
    "separatrix between B and -B": (2, (1, 0.5), (1, -1, -0.5)),
}
"""One motion of every kind, in exact doubles."""

MORE = [
    (0.5, (3, 1), (1e-8, -1.5, -2)),  # beside a triple root
    (2, (0.3, 1), (0.5, 1.1, -0.3)),  # hyperbolic sums, four real roots
    (0.3, (-1, 0.05), (0.2, 0.7, -0.5)),  # hyperbolic sums, two real roots
    (0.8, (2, -1), (0.2, -3.7, 1)),
    (2, (20, 15), (12, -4, 1)),  # separatrix of a spin along B
    (2, (20, -15), (12, -4, -1)),  # and of one along -B
    (0.75, (2, 4), (2, -2, -4)),  # separatrix that passes through both poles
    (0.75, (2, 4), (2.0000000000000004, -2, -4)),  # both poles are turning points
    (0.75, (2, 4), (1.9999999999999998, -2, -4)),  # one of them is, the other is beyond a barrier
    (2, (1, 0.5), (0.9999999999999999, -1, -0.5)),  # neither is, both are roots
    (1.5, (0, 1), (0.3, 0.2, 0.1)),  # the axis starts along B
    (0.5, (0, -1), (0.3, 0.2, 0.1)),  # and along -B
    (2, (0, 1), (1e-4, 0, -1)),  # the disk that tips over
    (0.5, (1, 0), (0.2, -0.3, 0.7)),
]


@pytest.fixture(autouse=True)
def _precisely() -> Iterator[None]:
    """Compute with 400 binary digits."""
    with ctx.workprec(400):
        yield


def largest(differences: Any) -> float:
    """Return an upper bound on the largest of some balls."""
    return max(float(abs(arb(x)).upper()) for x in differences)


def ball(x: mpmath.mpf) -> arb:
    """Return an mpf as a ball of no radius."""
    sign, mantissa, exponent, _ = x._mpf_
    return arb(-int(mantissa) if sign else int(mantissa)) * arb(2) ** exponent


@pytest.mark.parametrize("kind", KINDS)
def test_the_kind_is_decided_on_the_exact_inputs(kind: str) -> None:
    """Each kind of motion is known by its name."""
    assert GeneralMotion(*KINDS[kind]).kind == kind


@pytest.mark.parametrize(
    "inputs", [pytest.param(x, marks=[pytest.mark.slow] * (k % 2)) for k, x in enumerate([*KINDS.values(), *MORE])]
)
def test_certified_motions_agree_with_a_taylor_integration(inputs: Any) -> None:
    """R and Omega agree to 30 digits with a Taylor integration that shares no code, forwards and backwards."""
    I, B, omega = inputs
    motion, scale = GeneralMotion(*inputs), max(map(abs, (*B, *omega)))
    for sign in (1, -1):
        times = [Fraction(sign * n, int(8 * scale) + 1) for n in (3, 20, 40)]
        for state in integrated((1, 1, I), (0, *B), omega, times, digits=35):
            R, Omega = motion.rotation(state.t), motion.angular_velocity(state.t)
            assert largest(R[i][j] - ball(state.R[i, j]) for i in range(3) for j in range(3)) < 1e-30
            assert largest(a - ball(b) for a, b in zip(Omega, state.Omega, strict=True)) < 1e-30 * scale


@pytest.mark.parametrize("kind", KINDS)
def test_two_enclosures_overlap(kind: str) -> None:
    """The balls of the theta functions meet those of a Taylor series with its remainder, and both are narrow."""
    I, B, omega = KINDS[kind]
    t = Fraction(1, int(max(map(abs, (*B, *omega)))) + 1)
    with ctx.workprec(128):
        R, Omega = taylor(I, B, omega, t)
        motion = GeneralMotion(I, B, omega)
        pairs = [
            *zip((x for row in R for x in row), (x for row in motion.rotation(t) for x in row), strict=True),
            *zip(Omega, motion.angular_velocity(t), strict=True),
        ]
    assert all(a.overlaps(arb(b)) for a, b in pairs)
    assert max(float(a.rad()) for a, _ in pairs) < 1e-25


@pytest.mark.parametrize("sign", [1, -1])
def test_a_motion_to_a_triple_root_may_start_anywhere(sign: int) -> None:
    """A state in the middle of the separatrix of a triple root, in exact fractions, agrees with the integration."""
    K1, K2, K3, u = fmpq(8, 3), fmpq(5, 3), fmpq(-1, 3), fmpq(-2, 3)
    radial, rate = u * u + fmpq(3, 2) * u - fmpq(11, 2), sign * fmpq(16, 9)
    transverse = K1 * K1 + K2 * K2
    Omega = ((radial * K1 + rate * K2) / transverse, (radial * K2 - rate * K1) / transverse, u)
    motion = GeneralMotion.at_state(fmpq(1, 2), Omega, (K1, K2, K3))
    assert motion.kind == "separatrix, triple root"
    fractions = [[Fraction(int(x.p), int(x.q)) for x in v] for v in (Omega, (K1, K2, K3))]
    (state,) = integrated((1, 1, Fraction(1, 2)), fractions[1], fractions[0], [Fraction(7, 3)], digits=40)
    R = motion.rotation(Fraction(7, 3))
    assert largest(R[i][j] - ball(state.R[i, j]) for i in range(3) for j in range(3)) < 1e-30


@pytest.mark.parametrize("inputs", [KINDS["separatrix"], KINDS["nutation, two real roots"], MORE[0], MORE[1], MORE[12]])
def test_the_equations_hold_at_long_times(inputs: Any) -> None:
    """dR/dt = R hat(Omega) and the equation of dOmega3/dt hold at t = 1e5 by differences at 800 binary digits."""
    motion = GeneralMotion(*inputs)
    t, h = Fraction(10**5), Fraction(1, 1 << 160)
    with ctx.workprec(800):
        before, R, after = (motion.rotation(x) for x in (t - h, t, t + h))
        w, slower, faster = (motion.angular_velocity(x) for x in (t, t - h, t + h))
        K = motion.field_in_body(t)
        step = arb(2 * h.numerator) / h.denominator
        hat = [[arb(0), -w[2], w[1]], [w[2], arb(0), -w[0]], [-w[1], w[0], arb(0)]]
        rates = [
            (after[i][j] - before[i][j]) / step - sum(R[i][k] * hat[k][j] for k in range(3))
            for i in range(3)
            for j in range(3)
        ]
        rates.append((faster[2] - slower[2]) / step - (w[0] * K[1] - w[1] * K[0]))
        assert largest(rates) < 1e-60


@pytest.mark.parametrize("kind", ["precession", "at rest", "spin along the field"])
def test_constant_omega3_is_the_elementary_motion(kind: str) -> None:
    """Where Omega3 is constant the motion is that of `ElementaryMotion`."""
    I, B, omega = KINDS[kind]
    general = GeneralMotion(I, B, omega)
    elementary = ElementaryMotion(I, B, omega[1], omega[2] if kind == "spin along the field" else None)
    t = Fraction(10**6 + 1, 3)
    R, S = general.rotation(t), elementary.rotation(t)
    assert largest(arb(a) - b for p, q in zip(R, S, strict=True) for a, b in zip(p, q, strict=True)) < 1e-30


def test_the_free_body_is_its_own_motion() -> None:
    """Without a field the motion is that of (87)."""
    I, B, omega = KINDS["free body"]
    t = Fraction(10**6 + 1, 3)
    R, S = GeneralMotion(I, B, omega).rotation(t), FreeMotion(I, omega).rotation(t)
    assert largest(arb(a) - b for p, q in zip(R, S, strict=True) for a, b in zip(p, q, strict=True)) < 1e-30


@pytest.mark.parametrize("inputs", [KINDS["nutation, four real roots"], KINDS["nutation, two real roots"], *MORE[:4]])
def test_after_one_period_the_body_has_turned_by_the_two_angles(inputs: Any) -> None:
    """R(T + t) = R_B(psi) R(t) R_z(chi) for the angles by which the body precesses and spins in a period."""
    motion, t = GeneralMotion(*inputs), arb(1) / 3
    T, psi, chi, solution = motion.period, motion.precession_per_period, motion.spin_per_period, motion.solution
    for parameter, sign in ((solution.alpha, 1), (solution.beta, -1)):
        value_first, later = (parameter.at(x, motion.solution.in_cell(x + solution.origin))[0] for x in (t, t + T))
        square, (sine, cosine) = (later / value_first) ** 2, (psi + sign * chi).sin_cos()
        assert largest([square.real - cosine, square.imag - sine]) < 1e-25


@pytest.mark.parametrize("kind", KINDS)
def test_digits_are_certified_at_any_time(kind: str) -> None:
    """Thirty digits at t = 1e9 are the first of fifty."""
    motion = GeneralMotion(*KINDS[kind])
    few, many = (certified(lambda: [row[2] for row in motion.rotation(10**9 + 1)], n, "fixed") for n in (20, 50))
    for a, b in zip(few, many, strict=True):
        assert abs(Fraction(a) - Fraction(b)) <= Fraction(1, 2 * 10**20)


def test_quantities_without_a_limit_are_refused_with_a_reason() -> None:
    """Angles of a period on a separatrix, and the nome at a triple root, raise DomainError."""
    with pytest.raises(DomainError, match="no period"):
        _ = GeneralMotion(*KINDS["separatrix"]).precession_per_period
    for motion in (KINDS["separatrix, triple root"], (1.5, (0, 0), (0, 0, 0)), (2, (0, 1), (0, 0, 0))):
        with pytest.raises(DomainError, match="triple root"):
            _ = GeneralMotion(*motion).nome


def test_the_nome_lies_between_0_of_elementary_motions_and_1_of_separatrices() -> None:
    """It is a limit at both ends; the precession here is at a triple root."""
    limited = {kind: motion for kind, motion in KINDS.items() if kind != "precession" and "triple" not in kind}
    nome = {kind: GeneralMotion(*motion).nome for kind, motion in limited.items()}
    assert all(nome[kind] == 0 for kind in ("at rest", "spin along the field", "free body", "ball"))
    assert all(0 < q < 1 for kind, q in nome.items() if kind.startswith("nutation"))
    assert nome["separatrix"] == nome["separatrix between B and -B"] == 1


@pytest.mark.parametrize(
    ("motion", "place"),
    [
        (GeneralMotion(1.5, (1, 0), (0.3, -1, 0)), (1, 0)),
        (GeneralMotion(1, (1, 0), (0.3, -1, 0)), (1, 0)),
        (GeneralMotion(2, (0, 1), (1e-4, 0, -1)), (2, 0)),
    ],
)
def test_entries_that_vanish_by_symmetry_are_exactly_zero(motion: GeneralMotion, place: tuple[int, int]) -> None:
    """Where the body swings in a plane of Larmor's frame, or is a ball, an entry that stays zero has no radius."""
    R = motion.rotation(7.3)
    assert [(i, j) for i in range(3) for j in range(3) if R[i][j] == 0] == [place]


@pytest.mark.parametrize(
    "motion", [GeneralMotion(1.5, (1, 2), (0.3, 0.7, 0.2)), TopMotion((1, 0.5), (0.3, 0.2), (0.6, 0.8), (0.1, 0, 2))]
)
def test_the_attitude_is_exactly_one_at_the_start(motion: GeneralMotion | TopMotion) -> None:
    """R(0) = 1 in whole numbers, where the sums would give balls."""
    assert motion.rotation(0) == [[1, 0, 0], [0, 1, 0], [0, 0, 1]]


@pytest.mark.parametrize("inputs", [KINDS["ball"], KINDS["separatrix between B and -B"], MORE[12]])
def test_two_turns_are_the_matrix_of_the_parameters(inputs: Any) -> None:
    """Both roads to R(t) enclose the same entries, narrowly."""
    motion = GeneralMotion(*inputs)
    two, turn_single = motion.rotation(2.7), matrix(motion.from_frame(*motion.solution.parameters(2.7)[:2]))
    assert (
        largest(arb(x) - arb(y) for a, b in zip(two, turn_single, strict=True) for x, y in zip(a, b, strict=True))
        < 1e-90
    )


@pytest.mark.parametrize(("omega3", "turns"), [(0.25, 0), (16, 1), (-16, -1)])
def test_a_ball_turns_about_its_axis_by_nothing_or_by_a_whole_turn(omega3: float, turns: int) -> None:
    """In a period, seen from the frame: exactly zero, and printed so, where |M3| < |p|; a top that is a ball too."""
    for ball in (
        GeneralMotion(1, (1, 2), (0.5, 0.75, omega3)),
        TopMotion((1, 1), (5, 5), (3, 4), (0.5, 0.75, omega3 - 4)),
    ):
        assert (ball.spin_per_period - 2 * turns * arb.pi()).contains(0)
        if not turns:
            assert ball.spin_per_period == 0


@pytest.mark.parametrize("omega1", [1, 1.999, 2.01, 2.5, 3, 10])
def test_a_passage_through_both_poles_counts_alike_in_both_forms_of_the_sums(omega1: float) -> None:
    """With p = M3 = 0 the axis meets the poles and precesses with Larmor's frame alone, whatever the nome."""
    motion = GeneralMotion(0.75, (2, 4), (omega1, -2, -4))
    assert (motion.precession_per_period + motion.b * motion.period).contains(0)
    assert motion.spin_per_period == 0


@pytest.mark.parametrize(
    ("ratio", "field", "omega", "multiplicities"),
    [
        (1, (1, 2), ("0.3", "0.7", "0.2"), [1, 1]),
        (1, (1e3, float.fromhex("0x1.fffp1023")), (1.5, 0.5, 1e308), [1, 1]),
        ("0.75", (20, 15), (6, "-24.5", -7), [1, 1, 2]),
        ("0.5", (1, -3), (0, "1.5", 2), [1, 3]),
        (2, (1, "0.5"), (1, -1, "-0.5"), [2, 2]),
        ("1.5", (1, 3), (0, 0, 0), [1, 1, 2]),
        ("1.5", (1, 2), ("0.3", "0.7", "0.2"), [1, 1, 1, 1]),
    ],
)
def test_the_roots_agree_with_the_polynomial(ratio: Any, field: Any, omega: Any, multiplicities: list[int]) -> None:
    """The product over all roots, each as often as it counts, has the coefficients of Q, at any scale."""
    with ctx.workprec(4000):
        quartic = GeneralMotion(ratio, field, omega).quartic
        roots = [root for root in quartic.roots() if not root.is_infinite]
        assert sorted(root.multiplicity for root in roots) == multiplicities
        coefficients = [acb(arb(c.value)) for c in quartic.polynomial]
        product = acb_poly(coefficients[-1:])
        for root in roots:
            product *= acb_poly([-root.value, 1]) ** root.multiplicity
        for n, c in enumerate(coefficients):
            assert product[n].contains(c)
