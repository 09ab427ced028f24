"""Are tops right? A thousand ordinary ones and three hundred that are hard, against an integrator that shares no code.

In the folder tests, `python -m stress.integrated_tops --ordinary 1000 --extreme 300 --seed 1`
draws tops of the regimes of `stress.tops`,
integrates the equations of motion with heyoka's Taylor series in numbers of 64 binary digits there and back, and prints
the worst errors of R and Omega in ulps of 1 and of the largest rate, with how far the integrator came back from its
start. The exit status is 1 if a top errs by more than it promises. It needs heyoka (requirements-bench.lock), and a
processor whose long double has 64 digits, as those of x86 have.
"""

import argparse
import sys
from collections.abc import Sequence
from itertools import cycle, islice
from random import Random
from typing import Any, NamedTuple

import click
import heyoka
import numpy as np

import atlas
from atlas.motions.register import FAMILIES
from stress.tops import TOPS, Top, rate_of

Long = np.longdouble
TIME, EPS = 6.0, 2.0**-52
"""Phases of the fastest rate to which a top is followed."""

ORDINARY = "top, ordinary"


class Errors(NamedTuple):
    """Errors of R, Omega and, of the integrator, the residual after there and back, in ulps."""

    R: float
    Omega: float
    back: float


def integrator() -> Any:
    """Return the integrator of R and Omega; its parameters are I3, k2, k3, n2, n3, linear and quadratic, I2 = 1."""
    Omega = heyoka.make_vars("w1", "w2", "w3")
    rows = [heyoka.make_vars(*(f"r{i}{j}" for j in range(3))) for i in range(3)]
    I3, k2, k3, n2, n3, linear, quadratic = (heyoka.par[i] for i in range(7))
    b = [n2 * rows[1][j] + n3 * rows[2][j] for j in range(3)]
    I, k = (1.0, 1.0, I3), (k2, k2, k3)
    M = [I[j] * Omega[j] + k[j] * b[j] for j in range(3)]
    force = [k2 * Omega[0], k2 * Omega[1], k3 * Omega[2] - linear - quadratic * b[2]]
    spun, pulled, swept = _cross(M, Omega), _cross(force, b), _cross(b, Omega)
    rates = [(spun[j] + pulled[j] - k[j] * swept[j]) / I[j] for j in range(3)]
    equations = list(zip(Omega, rates, strict=True))
    equations += [pair for row in rows for pair in zip(row, _cross(row, Omega), strict=True)]
    return heyoka.taylor_adaptive(
        equations, np.zeros(12, Long), pars=np.zeros(7, Long), fp_type=Long, tol=Long("1e-20")
    )


def _cross(a: Sequence[Any], b: Sequence[Any]) -> list[Any]:
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def errors(top: Top, solver: Any) -> Errors:
    """Return the errors of a top. Raises DomainError for one that `TopMotion` does not take."""
    motion = atlas.TopMotion(*top)
    exponent = int(np.floor(np.log2(rate_of(top))))
    unit, n = Long(2.0) ** exponent, np.array(top.direction, Long)
    n = n / np.abs(n).max()
    n = n / np.sqrt((n * n).sum())
    couplings = [Long(x) / unit for x in top.coupling]
    potential = [Long(x) / unit / unit for x in (top.linear, top.quadratic)]
    start = np.concatenate([np.array(top.omega, Long) / unit, np.eye(3, dtype=Long).ravel()])
    solver.time, solver.state[:] = Long(0), start
    solver.pars[:] = np.array([Long(top.inertia[1]), *couplings, *n, *potential], Long)
    solver.propagate_until(Long(TIME))
    Omega, R = solver.state[:3].copy(), solver.state[3:].reshape(3, 3).copy()
    solver.propagate_until(Long(0))
    back = np.abs(solver.state - start).max()
    t = float(TIME / unit)
    rate = Long(rate_of(top)) / unit
    change_of_omega = np.abs(motion.angular_velocity(t).astype(Long) / unit - Omega).max() / rate
    distance = np.abs(motion.rotation(t) - R).max(), change_of_omega, back
    return Errors(*(float(x) / EPS for x in distance))


def main() -> int:
    """Draw, compare and print."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--ordinary", type=int, default=1000)
    parser.add_argument("--extreme", type=int, default=300)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    random, solver = Random(options.seed), integrator()  # noqa: S311  draws, no secrets
    extreme = [name for name in TOPS if name != ORDINARY]
    names = [ORDINARY] * options.ordinary + list(islice(cycle(extreme), options.extreme))
    worst, refused = dict[str, Errors](), dict[str, int]()
    for name in names:
        try:
            change = errors(TOPS[name](random), solver)
        except atlas.DomainError:
            refused[name] = refused.get(name, 0) + 1
            continue
        worst[name] = Errors(*map(max, change, worst.get(name, change)))
    click.echo(f"{'regime':32} {'tops':>5} {'refused':>7} {'R':>8} {'Omega':>8} {'there and back':>15}   ulp")
    for name, change in worst.items():
        count, refusals = names.count(name), refused.get(name, 0)
        click.echo(f"{name:32} {count:5} {refusals:7} {change.R:8.3f} {change.Omega:8.3f} {change.back:15.4f}")
    most = max(FAMILIES["top"].promises[name] for name in ("top R", "top Omega"))
    return int(any(max(error.R, error.Omega) > most + error.back for error in worst.values()))


if __name__ == "__main__":
    sys.exit(main())
