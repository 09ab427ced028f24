from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from oracles.taylor import taylor

import atlas
from atlas.bodies.body import SymmetricBody
from atlas.bodies.integrals import integrals, shape_factors
from atlas.errors import AtlasError

EPS = float(np.finfo(float).eps)
NAMES = ("E", "K2", "c3", "c5")


@pytest.mark.slow
@pytest.mark.parametrize("I", [0.25, 1.0, 1.5, 2.0])
def test_integrals_are_conserved_along_a_motion(I: float) -> None:
    """On the Taylor series' motion all four keep their value to rounding."""
    omega, field, times = (0.3, 0.7, -0.4), (0.0, 1.0, 0.5), [0, 0.5, 1.5, 4]
    states = taylor((1, 1, I), field, omega, times)
    Omega = np.array([[float(x) for x in s.Omega] for s in states])
    K = np.array([[float(x) for x in s.K] for s in states])
    got = integrals(I, Omega, K)
    for name in NAMES:
        values = getattr(got, name)
        assert values.shape == (4,)
        assert np.abs(values - values[0]).max() <= 16 * EPS


def test_the_differences_from_one_and_two_are_not_rounded() -> None:
    """One ulp from I = 1 and from I = 2, 1 - I and 2 - I are that ulp; of a body, they come from its moments."""
    assert shape_factors(1 + EPS)[1] == -EPS
    assert shape_factors(2 - 2 * EPS)[2] == 2 * EPS
    body = SymmetricBody(3.0, np.nextafter(3.0, 4))
    assert shape_factors(body)[1] == -np.spacing(3.0) / 3


def test_impossible_states_are_refused_in_one_sentence() -> None:
    """Vectors without three components raise."""
    with pytest.raises(AtlasError, match="three components"):
        integrals(1.5, [1, 2], [0, 1, 2])


def _products(a: Any, b: Any) -> Fraction:
    return sum((x * y for x, y in zip(a, b, strict=True)), Fraction(0))


@pytest.mark.parametrize("size", [1.0, 2.0**-400, 2.0**300])
def test_the_constants_of_a_general_motion_are_rounded_once(size: float) -> None:
    """Of one motion and of many, and where c5 and (M, B') cancel, they are the rational numbers in one rounding."""
    rng = np.random.default_rng(3)
    ratios, rows = rng.uniform(0.1, 2.0, 40), rng.normal(size=(5, 40)) * size
    rows[4, :10] = -rows[1, :10] * (1 + EPS)
    motions = atlas.GeneralMotion(ratios, tuple(rows[:2]), tuple(rows[2:]))
    for i, (I, row) in enumerate(zip(ratios, rows.T, strict=True)):
        I2, (B2, B3, w1, w2, w3) = Fraction(I), map(Fraction, row.tolist())
        c3 = w3 + B3
        p = (w2 + B2) * B2 + I2 * c3 * B3
        true = [w1**2 + w2**2 + I2 * w3**2, B2**2 + B3**2, c3, w2 * B2 - w3**2 + (2 - I2) * c3 * w3, p]
        motion = atlas.GeneralMotion(I, tuple(row[:2]), tuple(row[2:]))
        assert list(motion.invariants().values()) == [float(x) for x in true]
        assert [x[i] for x in motions.invariants().values()] == [float(x) for x in true]


def test_the_constants_of_a_top_are_rounded_once() -> None:
    """Energy, M3 and p of one top and of many, along a direction of rational length."""
    rng = np.random.default_rng(4)
    rows, n = rng.normal(size=(7, 30)), 2.0 ** rng.integers(-9, 9, 30)
    I2, I3 = 1 + rng.uniform(size=30), rng.uniform(0.1, 2.0, 30)
    linear, quadratic, k2, k3, w1, w2, w3 = rows
    w2[:9] = w3[:9] = k2[:9] = k3[:9] = 0.0  # p = 0
    tops = atlas.TopMotion((I2, I3), (k2, k3), (3 * n, 4 * n), (w1, w2, w3), linear, quadratic)
    n2, n3 = Fraction(3, 5), Fraction(4, 5)
    for i in range(30):
        exact = [Fraction(float(x[i])) for x in (I2, I3, k2, k3, w1, w2, w3, linear, quadratic)]
        J2, J3, c2, c3, x, y, z, a, A = exact
        M3 = (J3 * z + c3 * n3) / J2
        h = (x**2 + y**2 + J3 / J2 * z**2) / 2 + (a * n3 + A * n3**2 / 2) / J2
        true = [float(h), float(M3), float((y + c2 * n2 / J2) * n2 + M3 * n3)]
        constants = [value[i] for value in tops.invariants().values()]
        assert constants == true, i


@pytest.mark.parametrize(("unit", "size"), [(1.0, 1.0), (2.0**-150, 2.0**40), (2.0**150, 2.0**-200)])
def test_the_integrals_of_a_state_are_rounded_once(unit: float, size: float) -> None:
    """The five of `clebsch` are those of the exact inputs in one rounding, in any units and where they cancel."""
    tensor = np.array([[2.0, 0.3, -0.1], [0.3, 1.5, 0.2], [-0.1, 0.2, 1.7]]) * unit
    rng = np.random.default_rng(5)
    Omega, K = rng.normal(size=(2, 30, 3)) * size
    Omega[:10] = -K[:10] * (1 + EPS)
    result = atlas.clebsch(tensor, Omega, K)
    J = [[Fraction(x) for x in row] for row in tensor.tolist()]
    cofactors = [
        [J[i - 2][j - 2] * J[i - 1][j - 1] - J[i - 2][j - 1] * J[i - 1][j - 2] for j in range(3)] for i in range(3)
    ]
    for i, (spin, field) in enumerate(zip(Omega.tolist(), K.tolist(), strict=True)):
        w, k = [Fraction(x) for x in spin], [Fraction(x) for x in field]
        W = [x + y for x, y in zip(w, k, strict=True)]
        M, pulled, b_products, spun = (
            [_products(row, v) for row in m] for m, v in ((J, W), (J, k), (cofactors, k), (J, w))
        )
        true = {
            "H": (_products(M, W) + _products(k, pulled)) / 2,
            "F": _products(M, M) - _products(k, b_products),
            "MK": _products(M, k),
            "K2": _products(k, k),
            "energy": _products(w, spun) / 2,
        }
        result_alone = atlas.clebsch(tensor, Omega[i], K[i])
        for name, value in true.items():
            assert getattr(result, name)[i] == getattr(result_alone, name) == float(value), (name, i)


def test_the_constants_of_an_elliptic_motion_agree_with_its_state() -> None:
    """Rounded once from balls, alone and in an array; a state whose omega is rounded has them within some ulp."""
    body, field, z = (0.8, 1.0, 1.3), (0.2, 1.0, 0.6), np.array([1.7, 2.5])
    many = atlas.EllipticMotion(body, field, z).invariants()
    for i, place in enumerate(z):
        motion = atlas.EllipticMotion(body, field, place)
        assert {name: value[i] for name, value in many.items()} == motion.invariants()
        assert list(motion.invariants().values()) == pytest.approx(
            list(vars(atlas.clebsch(body, motion.omega, field)).values()), rel=16 * EPS
        )
