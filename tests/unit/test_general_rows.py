"""Many general motions in arrays: scalars with the bits of one by one, matrices within the promise, kinds exact."""

from functools import partial
from itertools import chain
from random import Random
from typing import Any

import numpy as np
import pytest
from stress.arrays import GENERAL_REGIME, check_general_rows, state
from stress.nutating import narrow
from stress.regimes import GENERAL
from stress.run import PROMISES
from ulps import ONE, absolute, error

import atlas
from atlas.errors import DomainError
from atlas.motions.nutation import kernel_general as general
from atlas.motions.nutation import rows_pair as nutation_pair
from atlas.motions.nutation.certified_cayley_klein import infinite
from atlas.motions.nutation.certified_general import GeneralMotion as Balls
from atlas.motions.nutation.kernel import NutatingMotion
from atlas.motions.nutation.kernel_general import GeneralMotion
from atlas.motions.nutation.rows import MotionsAtTimes, Rows
from atlas.motions.nutation.rows_blocks import Blocks
from atlas.motions.nutation.rows_scalars import Scalars

SCALARS = ("period", "modulus", "complementary_modulus", "nome", "precession_per_period", "spin_per_period")
PER_REGIME = 8


@pytest.fixture(autouse=True)
def every_array_by_rows(monkeypatch: pytest.MonkeyPatch) -> None:
    """Evaluate short arrays as long ones are."""
    monkeypatch.setattr(NutatingMotion, "_min_array_motions", 1)
    monkeypatch.setattr(NutatingMotion, "_min_array_scalars", 1)


def ordinary(count: int, seed: int = 0) -> Any:
    """Return inputs of ordinary motions."""
    r = np.random.default_rng(seed)
    return r.uniform(0.1, 2, count), r.normal(size=(2, count)), r.normal(size=(3, count))


def spins(count: int, tilt: float = 0.0) -> Any:
    """Return inputs of motions whose axis starts along the field, or nearly so."""
    I, B, omega = ordinary(count, 9)
    return I, B * [[tilt], [1.0]], omega


def extreme(seed: int = 0) -> Any:
    """Return inputs of motions of every regime, side by side in one array, those without a period left out."""
    random = Random(seed)  # noqa: S311  draws of test inputs
    draws = [draw(random) for draw in GENERAL.values() for _ in range(PER_REGIME)]
    nutating = (d for d in draws if Balls(*d).kind.startswith(("nutation", "ball", "precession")))
    I, B, omega = zip(*(d for d in nutating if not infinite(Balls(*d).period)), strict=True)
    return np.array(I), np.array(B).T, np.array(omega).T


def inputs_at(inputs: Any, i: int) -> Any:
    """Return the inputs of one motion of an array."""
    I, B, omega = inputs
    return float(I[i]), tuple(B[:, i].tolist()), tuple(omega[:, i].tolist())


def planar(count: int, seed: int = 6) -> Any:
    """Return inputs of motions that start in the plane of axis and field, where Omega3 turns, and with two wells."""
    r = np.random.default_rng(seed)
    omega = r.uniform(-3, 3, (3, count)) * [[0.0], [1.0], [1.0]]
    return r.uniform(0.1, 1, count), np.array([[1.0], [0.3]]) * np.ones(count), omega


def times(inputs: Any, seed: int) -> Any:
    """Return a time for each motion, from a thousandth to a million of its own unit."""
    _, B, omega = inputs
    r = np.random.default_rng(seed)
    size = abs(np.concatenate([B, omega])).max(axis=0)
    return r.choice([-1.0, 1.0], size.size) * 10.0 ** r.uniform(-3, 6, size.size) / size


@pytest.mark.slow
@pytest.mark.parametrize("draw", [partial(ordinary, 60), partial(planar, 60), extreme])
def test_scalars_of_many_motions_have_the_bits_of_one_by_one(draw: Any) -> None:
    """Kind, turning points, roots, period, moduli, nome and angles are those of each motion made alone, to the bit."""
    inputs = draw()
    motions = GeneralMotion(*inputs)
    for i in range(motions.shape[0]):
        motion = GeneralMotion(*inputs_at(inputs, i))
        assert motions.kind[i] == motion.kind
        for name in SCALARS:
            assert getattr(motions, name)[i] == getattr(motion, name), (name, inputs_at(inputs, i))
        assert [ends[i] for ends in motions.turning_points] == list(motion.turning_points)
        # a root that is zero is known to 1e-40 alone; a complex pair has no order
        ours, roots = np.sort_complex(motions.roots[i]), np.sort_complex(motion.roots)
        finite = np.isfinite(roots)
        assert np.array_equal(np.isfinite(ours), finite)
        assert (abs(ours[finite] - roots[finite]) <= 1e-35 * abs(roots[finite]).max()).all()


@pytest.mark.parametrize(
    "draw",
    [partial(ordinary, 200, 1), partial(spins, 40), partial(spins, 40, 1e-6), partial(extreme, 1)],
    ids=["ordinary", "along B", "near B", "extreme"],
)
def test_matrices_of_many_motions_keep_the_promised_error(draw: Any) -> None:
    """R, K and Omega at one time each are within 6 ulp of 1, and 12 ulp of the largest rate, of the balls."""
    inputs = draw()
    motion, t = GeneralMotion(*inputs), times(inputs, 2)
    R, K, Omega = motion.rotation(t), motion.field_in_body(t), motion.angular_velocity(t)
    for i, time in enumerate(t.tolist()):
        exact, (_, B, omega) = Balls(*inputs_at(inputs, i)), inputs_at(inputs, i)
        size = max(map(abs, (*B, *omega)))
        true = narrow(partial(state, exact, time), size)
        assert max(absolute(R[i].flat, chain(*true[0]))) <= 6
        for values, balls in ((Omega[i], true[1]), (K[i], true[2])):
            assert max(error(x, y, size * ONE) for x, y in zip(values, balls, strict=True)) <= 12


def test_a_kind_next_to_a_border_is_decided_exactly() -> None:
    """An ulp off a separatrix, a ball and a steady motion the kinds are those of the exact inputs."""
    steps = np.arange(-2, 3)
    omega3 = np.array([-7 + n * np.spacing(7.0) for n in steps])
    for ratio, B, omega in (
        (0.75, (20.0, 15.0), (6.0, -24.5, omega3)),
        (1 + steps * 2.0**-52, (1.0, 2.0), (0.3, 0.7, 0.2)),
        (0.5, (3.0, 1.0), (0.0, -1.5, -2 + steps * 2.0**-52)),
        (1.5, (0.0, 1.0), (0.0, steps * 1e-200, 0.4)),
        (1.5, (steps * 1.0, 0.0), (0.0, 0.0, 0.0)),
    ):
        motions = GeneralMotion(ratio, B, omega)
        for i, kind in enumerate(motions.kind):
            row = [float(np.broadcast_to(x, (5,))[i]) for x in (ratio, *B, *omega)]
            assert kind == Balls(row[0], row[1:3], row[3:]).kind


def test_rest_and_spin_along_the_field_are_recognised_in_arrays() -> None:
    """Arrays tell these kinds; a motion beside one is of another kind."""
    I, B, _ = ordinary(20, 4)
    none, push = np.zeros(20), np.array([[0.0], [1e-3], [0.0]])
    for field, omega, kind in (
        (B, np.array([none, none, none]), "at rest"),
        (np.array([none, none]), np.array([none, none, none]), "at rest"),
        (np.array([none, B[1]]), np.array([none, none, B[0]]), "spin along the field"),
    ):
        motion = GeneralMotion(I, field, omega)
        assert (motion.kind == kind).all()
        assert kind not in GeneralMotion(I, field, omega + push).kind


def test_a_motion_without_a_period_does_not_stop_the_others() -> None:
    """An array has NaN where a motion made alone says that it has no number, there only, and else the same bits."""
    rows = [
        (1.5, (1.0, 2.0), (0.3, 0.7, 0.2)),
        (0.75, (20.0, 15.0), (6.0, -24.5, -7.0)),  # a separatrix
        (0.5, (1.0, -3.0), (0.0, 1.5, 2.0)),  # that of a triple root
        (0.5, (3.0, 1.0), (0.0, -1.5, -2.0)),  # an unstable precession, at a triple root
        (2.0, (1.0, 0.5), (1.0, -1.0, -0.5)),  # from B to -B
        (1.5, (0.0, 0.0), (0.0, 0.0, 0.0)),  # at rest without a field
    ]
    I, B, omega = zip(*rows, strict=True)
    motions, count = GeneralMotion(np.array(I), np.array(B).T, np.array(omega).T), 0
    for i, row in enumerate(rows):
        motion = GeneralMotion(*row)
        assert motions.kind[i] == motion.kind
        for name in SCALARS:
            try:
                assert getattr(motions, name)[i] == getattr(motion, name)
            except DomainError:
                count += 1
                assert np.isnan(getattr(motions, name)[i])
    assert count == 5 * 2 + 3 * 3


def test_ordinary_motions_of_an_array_are_not_evaluated_singly(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of 3000 ordinary motions, and as many that start at a turning point, none is made alone for kind and period."""
    made_singly = []
    standing = general.standing
    monkeypatch.setattr(general, "standing", lambda *row: made_singly.append(row) or standing(*row))
    inputs = ordinary(3000, 3)
    motions = GeneralMotion(*inputs)
    assert motions.kind.shape == motions.period.shape == motions.nome.shape == (3000,)
    flat = GeneralMotion(*planar(3000))
    assert flat.kind.shape == flat.period.shape == flat.spin_per_period.shape == (3000,)
    assert not made_singly
    motions.rotation(times(inputs, 4))
    assert len(made_singly) <= 60
    for tilt in (0.0, 1e-6):
        GeneralMotion(*spins(500, tilt)).rotation(1.0)
    assert len(made_singly) <= 80
    # balls on a grid of round numbers: only those whose Omega3 is constant
    made_singly.clear()
    x = np.linspace(-3, 3, 21)
    GeneralMotion(1.0, (1.0, 0.5), (0.0, x[:, None], x)).rotation(1.0)
    assert len(made_singly) <= 40


def test_empty_arrays_have_empty_scalars() -> None:
    """Arrays without rows give arrays without rows."""
    none = GeneralMotion(np.ones(0), (1.0, 2.0), (0.3, 0.7, 0.2))
    assert none.kind.shape == none.period.shape == none.spin_per_period.shape == (0,)
    assert none.roots.shape == (0, 4)
    assert none.rotation(1.0).shape == (0, 3, 3)


@pytest.mark.slow
def test_stress_of_arrays_keeps_the_promises_and_finds_a_slip(monkeypatch: pytest.MonkeyPatch) -> None:
    """An array of extreme and ordinary rows is within every promise; were the sums cut short, R would not be."""

    def broken() -> set[str]:
        return {w.quantity for w in check_general_rows(3, 0).worst.values() if w.ulps > PROMISES[w.quantity]}

    assert {w.regime for w in check_general_rows(3, 0).worst.values()} == {GENERAL_REGIME}
    assert not broken()
    monkeypatch.setattr(nutation_pair, "NEGLIGIBLE", 1.0)
    assert {"general R", "general integrals"} <= broken()


@pytest.mark.parametrize("power", [-90, 40, 90])
def test_rows_do_not_depend_on_the_unit(power: int) -> None:
    """Rows whose frequencies are all that small or large have matrices and periods of those near one, to the bit."""
    (I, B, omega), unit = ordinary(40, 11), 2.0**power
    t = times((I, B, omega), 12)
    motion, motion_scaled = GeneralMotion(I, B, omega), GeneralMotion(I, B * unit, omega * unit)
    assert np.array_equal(motion.rotation(t), motion_scaled.rotation(t / unit))
    assert np.array_equal(motion.angular_velocity(t) * unit, motion_scaled.angular_velocity(t / unit))
    assert np.array_equal(motion.period, motion_scaled.period * unit)


def motions(inputs: Any, t: Any, rows: Any) -> list[Any]:
    """Return values of some rows in arrays, none of them alone: columns, Omega, and scalars that are sure."""
    I, B, omega = (x[..., rows] for x in inputs)
    blocks, values = Blocks((1.0, I, 0.0, *B, *omega), I.shape), []
    for name in ("rotation", "angular_velocity"):
        out, rows_at = np.zeros((rows.size, *((3, 3) if name == "rotation" else (3,)))), Rows(blocks, MotionsAtTimes).at
        row_motions = rows_at(slice(None), t[rows])
        with np.errstate(all="ignore"):
            getattr(row_motions, name)(t[rows], out)
        out[row_motions.extreme] = 0.0
        values.append(out)
    scalars = Scalars(blocks)
    return values + [np.where(x.is_certain, x.values, 0.0).T for x in map(scalars.__getitem__, SCALARS)]


@pytest.mark.slow
def test_a_motion_does_not_depend_on_those_beside_it() -> None:
    """In any order and any part of an array, extreme neighbours or none, each row has the same bits."""
    r = np.random.default_rng(0)
    balls, neighbours, (_, B, omega) = ordinary(300, 0), ordinary(100, 10), ordinary(100, 20)
    balls[0][:] = 1.0
    extremes = r.choice([0.5, 1.0, 1 + 2.0**-40], 100), *(x * 10.0 ** r.uniform(-12, 40, x.shape) for x in (B, omega))
    inputs = tuple(np.concatenate(x, axis=-1) for x in zip(balls, neighbours, extremes, strict=True))
    t, order = times(inputs, 0), r.permutation(inputs[0].size)
    results = motions(inputs, t, np.arange(order.size))
    for rows in (*np.array_split(order, 5), order[:1], np.arange(300)):
        for all_rows, rows_picked in zip(results, motions(inputs, t, rows), strict=True):
            assert np.array_equal(rows_picked, all_rows[rows])


def test_a_body_in_a_field_is_a_top_bit_for_bit() -> None:
    """M = II (Omega + K) is the coupling k = |B'| II: where |B'| is a double, so are matrix and scalars the same."""
    rng = np.random.default_rng(5)
    sides = np.array([(3, 4, 5), (5, 12, 13), (8, 15, 17), (7, 24, 25), (20, 21, 29)])[rng.integers(0, 5, 500)].T
    B2, B3, b = sides * 2.0 ** rng.integers(-8, 8, 500) * rng.choice([-1, 1], (3, 500))
    b, I = abs(b), rng.integers(20, 250, 500) / 128
    omega = tuple(rng.uniform(-1, 1, (3, 500)) * b * 2.0 ** rng.integers(-6, 6, 500))
    body = GeneralMotion(I, (B2, B3), omega)
    top = atlas.TopMotion((np.ones(500), I), (b, I * b), (B2, B3), omega)
    for name in ("period", "modulus", "nome", "precession_per_period", "spin_per_period"):
        np.testing.assert_array_equal(getattr(body, name), getattr(top, name))
    np.testing.assert_array_equal(body.rotation(3.7 / b), top.rotation(3.7 / b))
    for i in range(3):
        motion = GeneralMotion(I[i], (B2[i], B3[i]), [w[i] for w in omega])
        other = atlas.TopMotion((1.0, I[i]), (b[i], I[i] * b[i]), (B2[i], B3[i]), [w[i] for w in omega])
        np.testing.assert_array_equal(motion.rotation([1.3, 1e9]), other.rotation([1.3, 1e9]))
