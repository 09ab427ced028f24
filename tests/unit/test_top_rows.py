"""Arrays of tops without a loop: against tops made alone, whatever stands beside them, and against an integration."""

from random import Random
from typing import Any

import numpy as np
import pytest
from oracles.top import integrated
from stress.tops import TOPS, Top, rate_of

import atlas
from atlas.motions.nutation.kernel import NutatingMotion

EPS = 2.0**-52


@pytest.fixture(autouse=True)
def every_array_by_rows(monkeypatch: pytest.MonkeyPatch) -> None:
    """Evaluate short arrays as long ones are."""
    monkeypatch.setattr(NutatingMotion, "_min_array_motions", 1)
    monkeypatch.setattr(NutatingMotion, "_min_array_scalars", 1)


def draw_tops(name: str, count: int, seed: int = 3) -> list[Top]:
    """Return tops of a regime: a third of them without coupling, a third with k3 = I k2, so that kappa is zero."""
    random, tops_drawn = Random(seed), list[Top]()  # noqa: S311  reproducible, not secret
    while len(tops_drawn) < count:
        top = TOPS[name](random)
        if len(tops_drawn) % 3:
            k2 = top.coupling[0] * (len(tops_drawn) % 3 - 1)
            top = top._replace(coupling=(k2, k2 * top.inertia[1]))
            if top.coupling[1] != k2 * top.inertia[1] or not (k2 or not top.coupling[1]):
                continue
        tops_drawn.append(top)
    return tops_drawn


def arrayed(tops: list[Top]) -> atlas.TopMotion:
    """Return an array of tops."""
    rows = [(*t.inertia, *t.coupling, *t.direction, *t.omega, t.linear, t.quadratic) for t in tops]
    x = np.array(rows).T
    return atlas.TopMotion(tuple(x[0:2]), tuple(x[2:4]), tuple(x[4:6]), tuple(x[6:9]), *x[9:])


def evaluated(motion: atlas.TopMotion, times: Any, quantity: str) -> tuple[Any, Any]:
    """Return R, Omega or b of rows, and the rows that have to be made alone."""
    rows, out = (
        motion._rows.at(slice(None), times),
        np.empty((len(times), *((3, 3) if quantity == "rotation" else (3,)))),
    )
    with np.errstate(all="ignore"):
        getattr(rows, quantity)(times, out)
    return out, rows.extreme


@pytest.mark.parametrize("name", TOPS)
def test_rows_are_within_16_ulp_of_single_tops(name: str) -> None:
    """R and b to 16 ulp of 1, Omega to 16 ulp of the largest rate, where a row is not left to be made alone."""
    tops = draw_tops(name, 16)
    motion, rates = arrayed(tops), np.array([rate_of(top) for top in tops])
    times = np.tile([1.0, 10.0, 1e6, -3.0], 4) / rates
    for quantity, unit in (("rotation", 1.0), ("angular_velocity", rates), ("field_in_body", 1.0)):
        values, extreme = evaluated(motion, times, quantity)
        for i in set(range(len(tops))) - set(extreme.tolist()):
            value = getattr(atlas.TopMotion(*tops[i]), quantity)(times[i])
            assert np.abs(values[i] - value).max() <= 16 * EPS * (unit if np.ndim(unit) == 0 else rates[i])


@pytest.mark.parametrize("couplings", [None, (0.0, 0.0)])
def test_most_ordinary_tops_are_made_in_arrays(couplings: tuple[float, float] | None) -> None:
    """Of two hundred random ones, with coupling or without, at most one in fifty has to be made alone."""
    random = Random(5)  # noqa: S311  reproducible, not secret
    tops = [TOPS["top, ordinary"](random) for _ in range(200)]
    tops = [top._replace(coupling=couplings, linear=2.0) if couplings else top for top in tops]
    times = np.array([3.0 / rate_of(top) for top in tops])
    for quantity in ("rotation", "angular_velocity"):
        _, extreme = evaluated(arrayed(tops), times, quantity)
        assert len(extreme) <= 4


@pytest.mark.slow
def test_a_row_does_not_depend_on_other_rows() -> None:
    """The bits of R and Omega in the whole array, in its halves and in reverse are the same."""
    tops = [top for name in ("top, ordinary", "top, near the cubic", "top, sleeping") for top in draw_tops(name, 12)]
    times = np.linspace(0.5, 9.0, len(tops))
    for quantity in ("rotation", "angular_velocity"):
        values = getattr(arrayed(tops), quantity)(times)
        halves = [getattr(arrayed(tops[i::2]), quantity)(times[i::2]) for i in (0, 1)]
        np.testing.assert_array_equal(values[0::2], halves[0])
        np.testing.assert_array_equal(values[1::2], halves[1])
        np.testing.assert_array_equal(values[::-1], getattr(arrayed(tops[::-1]), quantity)(times[::-1]))


def test_rows_move_as_the_equations_say() -> None:
    """Nu by DOP853 for heavy tops and charged ones with k3 = I k2, some of whose A is zero or nearly so."""
    tops = draw_tops("top, ordinary", 6) + draw_tops("top, near the cubic", 6)
    times = np.array([3.0 / rate_of(top) for top in tops])
    nu = arrayed(tops).field_in_body(times)[:, 2]
    for top, t, cosine in zip(tops, times, nu, strict=True):
        case = top.inertia, top.coupling, top.direction, top.omega, top.linear, top.quadratic
        assert cosine == pytest.approx(integrated(case, [t])[0], abs=1e-11)


def test_tops_beyond_the_rows_are_evaluated_singly_and_once() -> None:
    """A top next to a separatrix beside an ordinary one: the bits of the top by itself."""
    top_near = Top((1.0, 0.5), (0.0, 0.0), (0.0, 1.0), (1e-9, 0.0, 1.0), 3.0, 0.0)
    motion = arrayed([top_near, draw_tops("top, ordinary", 1)[0]])
    assert 0 in evaluated(motion, np.full(2, 2.5), "rotation")[1]
    motion_alone = atlas.TopMotion(*top_near)
    np.testing.assert_array_equal(motion.rotation(2.5)[0], motion_alone.rotation(2.5))
    np.testing.assert_array_equal(motion.angular_velocity(2.5)[0], motion_alone.angular_velocity(2.5))
    assert motion._single(0) is motion._single(0)


def test_the_turn_about_the_axis_is_continuous_where_the_quartic_becomes_a_cubic() -> None:
    """A = 0 exactly, 1e-6 to 1e-15 on both sides of it, and far below, where two roots are complex: none made alone."""
    small = [side * 10.0**-n for n in range(6, 16) for side in (-1, 1)]
    tops = [
        Top((1.0, 0.5), (0.5, 1.0), (0.6, 0.8), (0.3, 0.7, 0.2), 0.7, -1.75 + A)
        for A in (0.0, *small, -4.0, -6.0, -8.0)
    ]
    times = np.linspace(1.0, 20.0, len(tops))
    rotations, extreme = evaluated(arrayed(tops), times, "rotation")
    assert not len(extreme)
    for i, top in enumerate(tops):
        assert np.abs(rotations[i] - atlas.TopMotion(*top).rotation(times[i])).max() <= 16 * EPS


@pytest.mark.slow
@pytest.mark.parametrize("name", ["top, ordinary", "top, near the cubic", "top, near the quadratic", "top, sleeping"])
def test_scalars_in_arrays_agree_with_single_tops_to_the_bit(name: str) -> None:
    """Kind, period, modulus and turning points of tops with any kappa, and of two that start at a turning point."""
    random = Random(11)  # noqa: S311  reproducible, not secret
    tops = [TOPS[name](random) for _ in range(6)]
    tops += [top._replace(omega=(0.0, *top.omega[1:])) for top in tops[:2]]
    tops = [top for top in tops if rate_of(top) > 1e-140]  # the period of slower ones may be beyond all floats
    many = arrayed(tops)
    for quantity in ("kind", "period", "modulus", "nome"):
        single = [getattr(atlas.TopMotion(*top), quantity) for top in tops]
        np.testing.assert_array_equal(getattr(many, quantity), single)
    tops = [top for top, period in zip(tops, many.period, strict=True) if np.isfinite(period)]
    for quantity in ("precession_per_period", "spin_per_period"):
        single = [getattr(atlas.TopMotion(*top), quantity) for top in tops]
        np.testing.assert_array_equal(getattr(arrayed(tops), quantity), single)
    tops, many = tops[:4], arrayed(tops[:4])
    np.testing.assert_array_equal(np.transpose(many.turning_points), [atlas.TopMotion(*x).turning_points for x in tops])


def test_tops_nearly_upright_are_evaluated_singly() -> None:
    """Tops all but upright, whose theta functions would need more terms than rows have: the bits of the top alone."""
    random = Random(7)  # noqa: S311  reproducible, not secret
    tops = [TOPS["top, axis near the vertical"](random) for _ in range(37)]
    tops = [tops[18], tops[36]]
    errors = [block.swing.w_error for block in arrayed(tops)._scalars.blocks]
    assert not np.isfinite(errors).any()
    np.testing.assert_array_equal(
        arrayed(tops).spin_per_period, [atlas.TopMotion(*top).spin_per_period for top in tops]
    )


def test_most_ordinary_tops_have_their_period_in_arrays() -> None:
    """Of thirty at least twenty-five, and their angles of spin, with kappa and without, at a turning point or not."""
    random = Random(5)  # noqa: S311  reproducible, not secret
    tops = [TOPS["top, ordinary"](random) for _ in range(30)]
    tops_resting = [top._replace(omega=(0.0, *top.omega[1:])) for top in tops]
    for tops_either in (tops, tops_resting):
        for quantity in ("period", "spin_per_period"):
            assert np.count_nonzero(arrayed(tops_either)._scalars[quantity].is_certain) >= 25


def in_units(top: Top, body: float, rate: float) -> Top:
    """Return a top in other units of moments and rates."""
    (I2, I3), (k2, k3), direction, (w1, w2, w3), linear, quadratic = top
    coupling, omega = (k2 * body * rate, k3 * body * rate), (w1 * rate, w2 * rate, w3 * rate)
    unit = body * rate * rate
    return Top((I2 * body, I3 * body), coupling, direction, omega, linear * unit, quadratic * unit)


def test_tops_in_si_units_are_made_in_arrays() -> None:
    """Molecules, 1e-46 kg m^2 at 1e12 a second, and planets: the matrices and rates of the same tops in other units."""
    tops = draw_tops("top, ordinary", 9)
    for body, rate in ((2.0**-152, 2.0**40), (2.0**120, 2.0**-40)):
        scaled = arrayed([in_units(top, body, rate) for top in tops])
        for quantity, unit in (("rotation", 1.0), ("angular_velocity", rate), ("field_in_body", 1.0)):
            small, extreme = evaluated(scaled, np.full(9, 2.0 / rate), quantity)
            assert not len(extreme)
            np.testing.assert_allclose(small / unit, evaluated(arrayed(tops), np.full(9, 2.0), quantity)[0], atol=1e-13)


def test_a_scale_of_moments_changes_no_bit() -> None:
    """Moments, couplings and potential times 8 are the same top."""
    tops = draw_tops("top, ordinary", 8)
    larger = [in_units(top, 8.0, 1.0) for top in tops]
    np.testing.assert_array_equal(arrayed(tops).rotation(2.0), arrayed(larger).rotation(2.0))
