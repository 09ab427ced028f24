"""Every peer of the benchmark, and the reference that measures them."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from atlas.study.bench import asymmetric, ball, elementary, general, heavy, particle
from atlas.study.bench.case import Case, Method, grid
from atlas.study.bench.integrators import Integrator, integrators
from atlas.study.bench.oracle import check, reference

EPS = 2.0**-52
CASES = [elementary.case(), general.case(), ball.case(), particle.case(), heavy.case()]
FASTEST = 3.0  # above the highest frequency of any case
CLOSED = [(case, method) for case in CASES for method in case.closed]
STEPPING = [(case, integrator) for case in CASES for integrator in integrators()]


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_reference_obeys_the_equations_of_motion(case: Case) -> None:
    """The closed form in balls meets a Taylor integration of the equations to 1e-40."""
    assert check(case, 2.0) < 1e-40


def test_reference_of_three_moments_obeys_the_equations_of_motion() -> None:
    """So does that of a body with three moments, for a while: its true values take longer than others."""
    assert check(asymmetric.case(), 0.25) < 1e-40


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_reference_that_runs_slow_is_found(case: Case) -> None:
    """A reference whose clock is wrong by one part in 2^70 does not pass."""
    slow = replace(case, exact=lambda t: case.exact(Fraction(t) * (1 + Fraction(1, 2**70))))
    assert check(slow, 2.0) > 1e-23


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_error_is_measured_below_one_ulp(case: Case) -> None:
    """The rounded truth errs by less than half an ulp but not by zero, and a change of one ulp is seen."""
    truth = reference(case, grid(100.0, 16))
    rounded = truth.error(truth.high)
    assert 0.0 < rounded <= EPS / 2
    assert truth.error(truth.high + 4 * EPS * np.abs(truth.high).max()) > 2 * EPS


def test_value_that_is_no_number_has_infinite_error() -> None:
    """One NaN among the values is not averaged away."""
    truth = reference(CASES[0], grid(10.0, 4))
    values = truth.high.copy()
    values[2, 1, 1] = np.nan
    assert truth.error(values) == float("inf")
    with pytest.raises(ValueError, match="shape"):
        truth.error(values[:2])


@pytest.mark.parametrize(("case", "method"), CLOSED, ids=lambda item: item.name)
def test_closed_form_errs_as_its_phase_is_rounded(case: Case, method: Method) -> None:
    """A peer errs by a few roundings of its largest phase; ours by four ulp of 1 whatever the phase."""
    horizon = 1e3
    g = grid(horizon, 64)
    error = reference(case, g).error(method.prepare()(g))
    allowed = 4 * EPS if method.name.startswith("ours") else 16 * EPS * FASTEST * horizon
    assert error <= allowed


@pytest.mark.parametrize(("case", "integrator"), STEPPING, ids=lambda item: item.name)
def test_integrator_errs_at_the_level_of_its_tolerance(case: Case, integrator: Integrator) -> None:
    """Up to t = 10 the error stays below a few hundred tolerances, and the tighter one does better."""
    if not integrator.present:
        pytest.skip(f"{integrator.module} is not installed")
    g = grid(10.0, 32)
    truth = reference(case, g)
    loose, tight = (truth.error(integrator.prepare(case, tol, 60.0)(g)) for tol in (1e-4, 1e-7))
    assert loose < 300 * 1e-4
    assert tight < 300 * 1e-7
    assert tight < loose


def test_sample_times_are_exact() -> None:
    """Every time of the benchmark is start + i step without rounding."""
    for horizon in (1e2, 1e8):
        g = grid(horizon, 1024)
        exact = [Fraction(g.start) + i * Fraction(g.step) for i in range(g.count)]
        assert [Fraction(t) for t in g.times.tolist()] == exact
        assert Fraction(g.step) * 1024 == Fraction(horizon)


def test_the_closed_form_of_three_moments_is_made_before_the_clock_runs() -> None:
    """What `motion` returns has found and proved it; a thousand matrices after that are no set-up."""
    assert "_choice" in vars(asymmetric.motion()._turnings[0])
