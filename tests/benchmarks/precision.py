"""Error against time: every method on every case, up to every horizon, at every tolerance; failures are kept.

`python -m benchmarks.precision` prints the runs of the closed forms of `NARROW`, for another process.
"""

import os
import subprocess
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from importlib import import_module
from statistics import median

import msgspec
import numpy as np
from msgspec.structs import replace

from atlas.checking.benchmark import Run, Status
from benchmarks.case import Case, FloatArray, Solve, even
from benchmarks.clock import interleave, once, ratio
from benchmarks.integrators import Integrator, TimedOutError
from benchmarks.oracle import Reference, reference
from benchmarks.results import ONE, Rows, Setup, sentence
from benchmarks.rotations import asymmetric_case, elementary_case, general_case, plain

NARROW = elementary_case, general_case, asymmetric_case
"""Cases that are measured without AVX-512 too."""

ONE_TIME = 1.7
"""The time of `one_time`."""

SHORT = 0.1
"""A solution that takes longer than this many seconds is timed once, a shorter one several times."""


@dataclass(frozen=True)
class Plan:
    """How far a run goes: horizons, tolerances, samples a horizon, rounds, and seconds for one integration."""

    horizons: tuple[float, ...]
    tolerances: tuple[float, ...]
    samples: int
    rounds: int
    limit: float


@dataclass(frozen=True)
class Bench:
    """One case, ready: the times up to each horizon, the true values there, and the plain formula to compare with."""

    case: Case
    plan: Plan
    times: dict[float, FloatArray]
    truths: dict[float, Reference]
    plain: Solve

    @classmethod
    def of(cls, case: Case, plan: Plan) -> "Bench":
        """Compute the values that all methods share."""
        times = {horizon: even(horizon, plan.samples) for horizon in plan.horizons}
        truths = {horizon: reference(case, t) for horizon, t in times.items()}
        plain = case.base or next(method for method in case.closed if method.name == "plain").prepare
        return cls(case, plan, times, truths, plain())


def closed(bench: Bench) -> Iterator[Setup | Run]:
    """Yield set-up, and error and time up to each horizon, of the closed forms of a case."""
    case, ready = bench.case, dict[str, Solve]()
    for method in case.closed:
        try:
            for module in method.modules:
                import_module(module)
            seconds, ready[method.name] = once(method.prepare)
            again = median(interleave({"setup": method.prepare}, bench.plan.rounds)["setup"])
            yield Setup(case.name, method.name, "done", seconds=seconds, again=again)
        except Exception as raised:  # noqa: BLE001  whatever a peer raises is what the record has to say about it
            yield Setup(case.name, method.name, "failed", note=sentence(raised))
    for horizon, t in bench.times.items():
        errors: dict[str, float] = {}
        for name, solve in ready.items():
            try:
                errors[name] = bench.truths[horizon].error(solve(t))
            except Exception as raised:  # noqa: BLE001  the same
                yield Run(case.name, name, horizon, len(t), "failed", note=sentence(raised))
        jobs = {name: partial(ready[name], t) for name in errors}
        times = interleave({"base": partial(bench.plain, t)} | jobs, bench.plan.rounds)
        for name, error in errors.items():
            yield _measured(Run(case.name, name, horizon, len(t), "done"), error, times[name])


def narrow() -> list[Run]:
    """Return the closed forms of `NARROW` in a process whose NumPy and C do without AVX-512."""
    held_back = os.environ | {"NPY_DISABLE_CPU_FEATURES": "X86_V4 AVX512_ICL AVX512_SPR"}
    command = [sys.executable, "-m", "benchmarks.precision"]
    output = subprocess.run(command, capture_output=True, check=True, env=held_back).stdout
    return msgspec.json.decode(output, type=list[Run])


def one_time(case: Case, rounds: int) -> Rows:
    """Return error and time of our R at one time, once the motion is made, beside plain NumPy for as many times."""
    times, plain_formula = np.array([ONE_TIME]), plain()
    ours = next(method for method in case.closed if method.name == "ours").prepare()
    seconds = interleave({"ours": lambda: ours(ONE_TIME), "plain": lambda: plain_formula(times)}, rounds)
    error = reference(case, times).error(ours(ONE_TIME)[None]) / 2.0**-52
    return Rows(
        ONE[case.name][0], "ours", 1, error, median(seconds["ours"]) * 1e9, ratio(seconds["ours"], seconds["plain"])
    )


def stepping(bench: Bench, integrator: Integrator) -> Iterator[Setup | Run]:
    """Yield the same for an integrator at each tolerance, up to the first horizon that it cannot reach in time."""
    case, plan = bench.case, bench.plan
    if not integrator.takes(case):
        return
    if not integrator.present:
        yield Setup(case.name, integrator.name, "skipped", note=f"{integrator.module} is not installed")
        return
    import_module(integrator.module)
    beaten = 0.0  # the loosest tolerance that did not even reach the first horizon in time
    for tolerance in integrator.tolerances or plan.tolerances:
        try:
            setup, solve = once(partial(integrator.solver, case, tolerance, plan.limit))
        except Exception as raised:  # noqa: BLE001  the same
            yield Setup(case.name, integrator.name, "failed", tolerance, note=sentence(raised))
            continue
        yield Setup(case.name, integrator.name, "done", tolerance, setup)
        pace = 0.0
        for horizon in plan.horizons:
            run = Run(case.name, integrator.name, horizon, len(bench.times[horizon]), "done", tolerance)
            if beaten and not pace:
                yield _unmeasured(run, "skipped", f"out of time at {beaten:.0e} already, so at longer horizons")
                break
            if pace * horizon > plan.limit:
                yield _unmeasured(run, "skipped", f"would take about {pace * horizon:.2g} s, so at longer horizons")
                break
            run = _timed(bench, run, solve, integrator.note(tolerance))
            yield run
            if run.status == "timed out" and not pace:
                beaten = tolerance
            if run.seconds is None:
                break
            pace = run.seconds / horizon


def _timed(bench: Bench, run: Run, solve: Solve, note: str) -> Run:
    """Solve, grade and time one run beside the plain formula."""
    t = bench.times[run.horizon]
    try:
        seconds, values = once(partial(solve, t))
        error = bench.truths[run.horizon].error(values)
        jobs = {"base": partial(bench.plain, t)} | ({"peer": partial(solve, t)} if seconds < SHORT else {})
        times = interleave(jobs, bench.plan.rounds if seconds < SHORT / 10 else 3)
    except TimedOutError:
        return _unmeasured(run, "timed out", f"stopped after {bench.plan.limit:g} s, so at longer horizons")
    except Exception as raised:  # noqa: BLE001  the same
        return _unmeasured(run, "failed", sentence(raised))
    peer = times.get("peer", [seconds] * len(times["base"]))
    return _measured(run, error, peer, note)


def _measured(run: Run, error: float, times: Sequence[float], note: str = "") -> Run:
    """Fill in error and time, always both; a method whose values are not numbers has failed."""
    if error == float("inf"):
        return _unmeasured(run, "failed", "a value is not finite")
    return replace(run, error=error, seconds=median(times), note=note)


def _unmeasured(run: Run, status: Status, note: str) -> Run:
    """Keep a run that has no error and no time, with the reason."""
    return replace(run, status=status, note=note)


if __name__ == "__main__":
    plan = Plan((1e4,), (), samples=1024, rounds=15, limit=3.0)
    runs = [item for case in NARROW for item in closed(Bench.of(case(), plan)) if isinstance(item, Run)]
    print(msgspec.json.encode(runs).decode())  # noqa: T201  what the other process reads
