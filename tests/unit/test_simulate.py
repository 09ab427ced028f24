from collections.abc import Callable
from types import SimpleNamespace
from typing import Any, get_args

import numpy as np
import pytest
import scipy.integrate
from numpy.typing import NDArray
from oracles import closed_form
from oracles.taylor import taylor

import atlas
from atlas.checking.simulate import Method, Simulation
from atlas.errors import AtlasError
from atlas.motions import euler_poisson as equations

TENSOR = np.array([[2.0, 0.3, -0.1], [0.3, 1.5, 0.2], [-0.1, 0.2, 1.7]])
B, OMEGA, TIMES = (0.3, 1.0, -2.0), (0.4, 0.5, -0.6), (0.0, 0.5, 3.0)


def truth(inertia: Any, field: Any, omega: Any, times: Any) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return R and Omega by the Taylor series, right to the last digit."""
    states = taylor(inertia, field, omega, times)
    return (
        np.array([np.array(s.R.tolist(), dtype=float) for s in states]),
        np.array([[float(x) for x in s.Omega] for s in states]),
    )


def error(simulation: Simulation, true: tuple[NDArray[np.float64], NDArray[np.float64]]) -> float:
    """Return the largest difference in any entry of R or Omega."""
    return float(max(np.abs(simulation.R - true[0]).max(), np.abs(simulation.Omega - true[1]).max()))


@pytest.mark.parametrize("method", get_args(Method))
def test_every_method_meets_the_taylor_series(method: str) -> None:
    """For a body without symmetry, each integrator is right to a hundred times its tolerance, and no better than 0."""
    simulation = atlas.simulate(TENSOR, B, OMEGA, TIMES, method=method, rtol=1e-7, atol=1e-9)
    off = error(simulation, truth(TENSOR.tolist(), B, OMEGA, TIMES))
    assert 0 < off < 1e-5
    assert simulation.evaluations > 0
    assert simulation.method == method


def test_a_tighter_tolerance_gives_more_digits() -> None:
    """The error falls with rtol, down to rounding, and costs more evaluations."""
    true = truth(TENSOR.tolist(), B, OMEGA, TIMES)
    runs = [atlas.simulate(TENSOR, B, OMEGA, TIMES, rtol=10.0**-n, atol=10.0**-n) for n in (4, 7, 10, 13)]
    errors = [error(run, true) for run in runs]
    assert errors == sorted(errors, reverse=True)
    assert errors[-1] < 1e-11
    assert np.all(np.diff([run.evaluations for run in runs]) > 0)


@pytest.mark.parametrize(("I", "omega2"), [(1.5, 0.7), (0.5, -0.4), (2.0, 1.1)])
def test_a_simulation_follows_the_elementary_motion(I: float, omega2: float) -> None:
    """Started on the hyperbola (71), the simulated body moves as (73) and (84) say."""
    B2, B3, times = 1.0, 2.0, np.linspace(0, 5, 6)
    start = [float(w) for w in closed_form.elementary_angular_velocity(1, I, B2, B3, omega2, 0)]
    got = atlas.simulate(I, (B2, B3), start, times, rtol=1e-11, atol=1e-13)
    for i, t in enumerate(times):
        R = closed_form.elementary_rotation(1, I, B2, B3, omega2, float(t), digits=20)
        Omega = closed_form.elementary_angular_velocity(1, I, B2, B3, omega2, float(t), digits=20)
        assert np.abs(got.R[i] - np.array(R.tolist(), dtype=float)).max() < 1e-9
        assert np.abs(got.Omega[i] - [float(w) for w in Omega]).max() < 1e-9


def test_the_body_may_be_given_in_four_ways() -> None:
    """A ratio, a SymmetricBody, principal moments and a tensor are one body; (B2, B3) and (0, B2, B3) one field."""
    forms: list[Any] = [1.5, atlas.SymmetricBody(2.0, 3.0), [2, 2, 3], np.diag([2.0, 2.0, 3.0])]
    runs = [atlas.simulate(form, (1.0, 2.0), OMEGA, TIMES) for form in forms]
    runs.append(atlas.simulate(1.5, (0.0, 1.0, 2.0), OMEGA, TIMES))
    for run in runs[1:]:
        assert np.abs(run.R - runs[0].R).max() < 1e-13


def test_conserved_quantities_drift_no_more_than_the_tolerance() -> None:
    """Energy and the momentum along B of a general body stay, and R stays orthogonal, to the integrator's error."""
    run = atlas.simulate(TENSOR, B, OMEGA, np.linspace(0, 20, 50))
    K = equations.field_in_body(run.R, B)
    energy = np.vecdot(run.Omega, run.Omega @ TENSOR) / 2
    for values in (energy, np.vecdot(K, (run.Omega + K) @ TENSOR)):
        assert np.abs(values - values[0]).max() < 1e-8
    assert np.abs(np.einsum("nij,nik->njk", run.R, run.R) - np.eye(3)).max() < 1e-8


def test_times_may_go_back_and_repeat() -> None:
    """Negative times, times met twice, one time and the start alone all have their answer."""
    back = atlas.simulate(TENSOR, B, OMEGA, [-0.5, -0.5, -2])
    assert np.array_equal(back.R[0], back.R[1])
    assert error(back, truth(TENSOR.tolist(), B, OMEGA, [-0.5, -0.5, -2])) < 1e-8
    assert np.array_equal(atlas.simulate(TENSOR, B, OMEGA, 0.0).R, [np.eye(3)])
    assert np.array_equal(atlas.simulate(TENSOR, B, OMEGA, [0.0, 1.0]).R[0], np.eye(3))
    assert atlas.simulate(TENSOR, B, OMEGA, 1.0).Omega.shape == (1, 3)


def test_a_body_at_rest_stays_at_rest() -> None:
    """Without angular velocity nothing turns, with and without a field."""
    for field in ((1.0, 2.0), (0.0, 0.0)):
        run = atlas.simulate(1.5, field, (0, 0, 0), TIMES)
        assert np.array_equal(run.R, np.broadcast_to(np.eye(3), (3, 3, 3)))
        assert not run.Omega.any()


def test_units_change_no_bit() -> None:
    """A power of two in the unit of time, or in that of the moments, changes no bit of R."""
    trajectory = atlas.simulate(TENSOR, B, OMEGA, TIMES)
    scale = 2.0**300
    for inertia, rate in ((TENSOR, scale), (TENSOR * scale**3, 1.0), (TENSOR, 1 / scale)):
        trajectory_scaled = atlas.simulate(
            inertia, np.multiply(B, rate), np.multiply(OMEGA, rate), np.divide(TIMES, rate)
        )
        assert np.array_equal(trajectory.R, trajectory_scaled.R)
        assert np.array_equal(trajectory.Omega * rate, trajectory_scaled.Omega)


def test_a_drift_has_no_unit() -> None:
    """That of a simulation in units of time and of mass that are powers of two is the same, to the last bit."""
    trajectory = atlas.simulate(TENSOR, B, OMEGA, TIMES)
    trajectory_scaled = atlas.simulate(4 * TENSOR, np.multiply(B, 8), np.multiply(OMEGA, 8), np.divide(TIMES, 8))
    assert trajectory.drift() == trajectory_scaled.drift()


def test_a_failure_speaks_with_the_integrators_words(monkeypatch: pytest.MonkeyPatch) -> None:
    """If SciPy gives up, its message is in the error; nothing half-finished comes back."""
    monkeypatch.setattr(
        scipy.integrate, "solve_ivp", lambda *_, **__: SimpleNamespace(success=False, message="too stiff")
    )
    with pytest.raises(AtlasError, match="did not reach t = 3: too stiff"):
        atlas.simulate(TENSOR, B, OMEGA, TIMES)


@pytest.mark.parametrize(
    "make",
    [
        lambda: atlas.simulate(1.5, (1, 2), OMEGA, [2, 1]),
        lambda: atlas.simulate(1.5, (1, 2), OMEGA, [-1, 1]),
        lambda: atlas.simulate(1.5, (1, 2), OMEGA, []),
        lambda: atlas.simulate(1.5, (1, 2), OMEGA, [[1, 2]]),
        lambda: atlas.simulate(1.5, (1, 2), OMEGA, [np.nan]),
        lambda: atlas.simulate(1.5, (1, 2), OMEGA, [1], method="Euler"),
        lambda: atlas.simulate(1.5, (1, 2), OMEGA, [1], rtol=1e-16),
        lambda: atlas.simulate(1.5, (1, 2), OMEGA, [1], atol=0),
        lambda: atlas.simulate(1.5, (1, 2, 3, 4), OMEGA, [1]),
        lambda: atlas.simulate(1.5, (1, 2), (1, 2), [1]),
        lambda: atlas.simulate(2.5, (1, 2), OMEGA, [1]),
        lambda: atlas.simulate((1, 1, 3), (1, 2), OMEGA, [1]),
        lambda: atlas.simulate((1, 1, -1), (1, 2), OMEGA, [1]),
        lambda: atlas.simulate([[1, 2], [3, 4]], (1, 2), OMEGA, [1]),
        lambda: atlas.simulate("ball", (1, 2), OMEGA, [1]),
        lambda: atlas.simulate(atlas.SymmetricBody.thin_rod(1, 1), (1, 2), OMEGA, [1]),
    ],
)
def test_a_refused_simulation_is_an_error_of_one_sentence(make: Callable[[], object]) -> None:
    """Unsorted times, unknown methods, impossible bodies and tolerances raise one sentence."""
    with pytest.raises(AtlasError, match=r"^[^\n]*\.$"):
        make()
