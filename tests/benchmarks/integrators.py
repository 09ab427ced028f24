"""The peers that step in time.

The question: how long do R(t) and y(t) take without the closed form?

SciPy's RK45, DOP853, LSODA and Radau, used as their documentation shows (rtol = atol = the tolerance, `t_eval` for the
samples), and heyoka's Taylor integrator. All start from the same state, rounded once to floats. Both are also tried at
their best: with a quaternion, 7 numbers in the place of 12, the right-hand side compiled by SymPy for SciPy's DOP853.
"""

import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from importlib.util import find_spec
from time import perf_counter
from typing import Any

import numpy as np
from flint import arb

from atlas.arithmetic.numbers import workprec
from benchmarks.case import Case, FloatArray, Solve, in_quaternions
from benchmarks.oracle import BITS, nearest

LEAST_RTOL = 100 * float(np.finfo(float).eps)
"""SciPy takes no smaller rtol: where less is asked for, this is used, and the record says so."""


OWN = (float(np.finfo(np.float64).eps),)
LONG = (float(np.finfo(np.longdouble).eps),)
"""The tolerances that heyoka takes by itself, in doubles and in long doubles."""


class TimedOutError(Exception):
    """The integrator was stopped at its time limit."""


class FailedError(Exception):
    """The integrator gave up, and says why."""


@dataclass(frozen=True)
class Integrator:
    """A method that steps in time: ``prepare(case, tolerance, limit)`` builds it, ``limit`` in seconds a solution."""

    name: str
    prepare: Callable[[Case, float, float], Solve]
    module: str = "scipy.integrate"
    tolerances: tuple[float, ...] = ()
    """Its own tolerances in the place of the plan's."""
    quaternions: bool = False
    """Whether it takes a quaternion in the place of R, for which a case must have Omega in its state."""

    def takes(self, case: Case) -> bool:
        """Whether a case is one for it."""
        return case.from_omega or not self.quaternions

    def solver(self, case: Case, tolerance: float, limit: float) -> Solve:
        """Build it for a case."""
        return self.prepare(in_quaternions(case) if self.quaternions else case, tolerance, limit)

    @property
    def present(self) -> bool:
        """Whether the library is installed."""
        return find_spec(self.module) is not None

    def note(self, tolerance: float) -> str:
        """Say where the tolerance used is not the one asked for."""
        is_clamped = self.module == "scipy.integrate" and tolerance < LEAST_RTOL
        return f"rtol held at {LEAST_RTOL:.2g}, the least that SciPy takes" if is_clamped else ""


def integrators() -> tuple[Integrator, ...]:
    """Return all of them, installed or not."""
    scipy = (Integrator(name, _scipy(name)) for name in ("RK45", "DOP853", "LSODA", "Radau"))
    return (
        *scipy,
        Integrator("DOP853_7", _scipy("DOP853", _compiled), tolerances=(1e-7, 1e-10, 1e-14), quaternions=True),
        Integrator("heyoka", partial(_heyoka, np.float64), "heyoka"),
        Integrator("heyoka_own", partial(_heyoka, np.float64), "heyoka", OWN),
        Integrator("heyoka_7", partial(_heyoka, np.float64), "heyoka", OWN, quaternions=True),
        Integrator("heyoka_long", partial(_heyoka, np.longdouble), "heyoka", LONG),
    )


def start(case: Case) -> list[float]:
    """Return the initial state, each number rounded once."""
    with workprec(BITS):
        return [nearest(x) for x in case.initial()]


def _right_hand_side(case: Case) -> Callable[[list[float]], list[float]]:
    """Return the right-hand side as it stands."""
    return lambda state: case.rates(state, case.parameters)


def _compiled(case: Case) -> Callable[[list[float]], list[float]]:
    """Return it compiled by SymPy, with common subexpressions taken out."""
    import sympy

    state = sympy.symbols(f"x:{len(case.initial())}")
    return sympy.lambdify([state], case.rates(state, case.parameters), "math", cse=True)  # type: ignore[no-any-return]


def _scipy(name: str, right_of: Callable[[Case], Callable[[list[float]], list[float]]] = _right_hand_side) -> Any:
    def prepare(case: Case, tolerance: float, limit: float) -> Solve:
        from scipy.integrate import solve_ivp

        initial, rates = start(case), right_of(case)

        def solve(times: FloatArray) -> FloatArray:
            deadline = perf_counter() + limit

            def right_hand_side(_t: float, state: FloatArray) -> list[float]:
                if perf_counter() > deadline:
                    raise TimedOutError
                return rates(state.tolist())

            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                solution = solve_ivp(
                    right_hand_side,
                    (times[0], times[-1]),
                    initial,
                    method=name,
                    t_eval=times,
                    rtol=max(tolerance, LEAST_RTOL),
                    atol=tolerance,
                )
            if not solution.success:
                raise FailedError("; ".join([solution.message, *(str(warning.message) for warning in caught)]))
            return case.values(solution.y.T)

        return solve

    return prepare


def _heyoka(kind: Any, case: Case, tolerance: float, _limit: float) -> Solve:
    import heyoka

    with workprec(BITS):
        initial = [
            kind(nearest(x)) + kind(nearest(x - nearest(x)) if kind is np.longdouble else 0)
            for x in map(arb, case.initial())
        ]
    unknowns = heyoka.make_vars(*(f"x{i}" for i in range(len(initial))))
    rates = case.rates(unknowns, case.parameters)
    python = float if kind is np.float64 else kind
    with _compiling(heyoka.llvm_state):
        integrator = heyoka.taylor_adaptive(
            list(zip(unknowns, rates, strict=True)), initial, fp_type=python, tol=python(tolerance)
        )

    def solve(times: FloatArray) -> FloatArray:
        integrator.time = python(times[0])
        integrator.state[:] = initial
        outcome, *_, states = integrator.propagate_grid(times.astype(kind))
        if outcome != heyoka.taylor_outcome.time_limit:
            raise FailedError(f"heyoka stopped early: {outcome.name}")
        return case.values(np.asarray(states, dtype=np.float64))

    return solve


@contextmanager
def _compiling(state: Any) -> Iterator[None]:
    """Have heyoka compile anew, where it would take the code of an earlier run from its caches."""
    cached = state.get_diskcache_enabled()
    state.set_diskcache_enabled(False)
    state.clear_memcache()
    try:
        yield
    finally:
        state.set_diskcache_enabled(cached)
