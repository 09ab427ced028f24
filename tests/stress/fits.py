"""Does a fit find the motion without a start, and are its errors right? Made-up measurements of 16 kinds.

    python -m stress.fits [--samples 100] [--seed 0] [--record] [KIND...]

Each motion is integrated by SciPy (`atlas.simulate`), the axes' and rates' among them, and noise is added. Told are the
share that converges, how often the truth is within one standard error, over all parameters, and processor time. The
parameters of one motion are correlated: the error of that share is from its scatter between motions. With `--record`
the shares go to reports/data/fits.json.
"""

import argparse
import json
import os
import time
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from multiprocessing import get_context
from pathlib import Path
from typing import Any, NamedTuple

import click
import numpy as np
from scipy.spatial.transform import Rotation

import atlas
from atlas import files
from atlas.arithmetic.machine import processors

ATTITUDE = ("a1", "a2", "a3")
RECORD = Path(__file__).parents[2] / "reports" / "data" / "fits.json"


class Made(NamedTuple):
    """A made-up measurement: arguments of `atlas.fit`, and the true parameters."""

    t: Any
    given: dict[str, Any]
    truth: dict[str, float]


def attitudes_case(
    rng: np.random.Generator, *, kind: str = "rotation", count: int = 500, span: float = 200.0, noise: float = 0.01,
    even: bool = False, known: bool = True, outliers: float = 0.0, family: str = "general", spin: float = 1.5,
    omega3: float = 0.0,
) -> Made:  # fmt: skip
    """Return a measurement of a random motion."""
    I1, I3 = _moments(rng, family)
    B = np.zeros(3) if family == "free" else rng.normal(size=3)
    w, A = rng.normal(size=3) * spin + np.array([0.0, 0.0, omega3]), Rotation.random(random_state=rng)
    t = np.linspace(0, span, count) if even else np.sort(rng.uniform(0, span, count))
    truth = {"ratio": I3, "I1": I1, "I3": I3, "b": float(np.linalg.norm(B))}
    if family == "elementary":
        K = A.inv().apply(B)
        hyperbola, w2 = atlas.Hyperbola(I3, (float(np.hypot(K[0], K[1])), K[2])), float(rng.normal() * spin)
        while hyperbola.stability(w2) < 0:  # no integration stays there
            w2 = float(rng.normal() * spin)
        w = np.array([*(w2 * K[:2] / np.hypot(K[0], K[1])), hyperbola.omega3(w2)])
    if family == "top":
        B, pull = np.array([0.0, 0.0, 1.0]), float(rng.normal())
        truth |= {"linear": pull, "k2": 0.0, "k3": 0.0, "quadratic": 0.0}
        R, Omega = _heavy(I3, pull, A.as_matrix(), w, t)
    else:
        steps = atlas.simulate((I1, 1.0, I3), A.inv().apply(B), w, t, rtol=1e-11)
        R, Omega = A.as_matrix() @ steps.R, steps.Omega
    values = {"axis": R[:, :, 2], "angular_velocity": Omega, "field_in_body": np.vecmat(B, R)}.get(kind, R)
    if kind in ("rotation", "quaternion"):
        turns = rng.normal(0, noise, (count, 3))
        wrong = rng.random(count) < outliers
        turns[wrong] = rng.normal(size=(wrong.sum(), 3))
        values = Rotation.from_rotvec(turns).as_matrix() @ R
        values = Rotation.from_matrix(values).as_quat() if kind == "quaternion" else values
    else:
        values = values + rng.normal(0, noise, values.shape)
    truth |= {
        f"{x}{i}": float(v) for x, y in (("B", B), ("omega", w), ("a", A.as_rotvec())) for i, v in enumerate(y, 1)
    }
    if family == "elementary":
        truth["omega2"] = w2
    if kind in ("angular_velocity", "field_in_body"):
        truth |= {f"B{i}": float(v) for i, v in enumerate(A.inv().apply(B), 1)}
        truth = {name: value for name, value in truth.items() if name[0] != "a"}
    if kind == "axis":  # omega1 and omega2 are along axes of a convention
        truth = {name: truth[name] for name in ("ratio", "b", "B1", "B2", "B3", "omega3")}
    options: dict[str, Any] = {"sigma": noise if known else None, "family": family}
    if family == "elementary":  # which does not tell it from the field
        options["params"] = {"ratio": {"value": I3, "vary": False}}
    if family == "top":
        options["params"] = {name: {"value": 0.0, "vary": False} for name in ("k2", "k3", "quadratic")}
        options["params"]["linear"] = {"min": 0.0} if truth["linear"] > 0 else {"max": 0.0}  # its sign is that of n
    return Made(t, {kind: values, **options, **({"loss": "soft_l1"} if outliers else {})}, truth)


def _moments(rng: np.random.Generator, family: str) -> tuple[float, float]:
    """Return I1 and I3 of a random body, three of them not nearly equal."""
    if family != "asymmetric":
        return 1.0, 1.0 if family == "ball" else float(rng.uniform(0.4, 1.8))
    I1, I3 = 1.0, 1.0
    while min(abs(I1 - 1), abs(I3 - 1), abs(I3 - I1), I1 + I3 - 1, 1 - abs(I1 - I3)) < 0.1:
        I1, I3 = np.exp(rng.uniform(-0.7, 0.7, 2))
    return float(I1), float(I3)


def _heavy(I3: float, pull: float, A: Any, omega: Any, t: Any) -> tuple[Any, Any]:
    """Return R and Omega of Lagrange's top, I Omega' = I Omega x Omega + pull b x e3, by SciPy."""
    from scipy.integrate import solve_ivp

    def rates(_: float, y: Any) -> Any:
        R, w = y[:9].reshape(3, 3), y[9:]
        I = np.array([1.0, 1.0, I3])
        torque = np.cross(I * w, w) + pull * np.cross(R[2], [0.0, 0.0, 1.0])
        return np.concatenate([np.cross(R, w).ravel(), torque / I])

    start = np.concatenate([A.ravel(), omega])
    y = solve_ivp(rates, (0.0, t[-1]), start, "DOP853", t, rtol=1e-11, atol=1e-12).y.T
    return y[:, :9].reshape(-1, 3, 3), y[:, 9:]


KINDS: dict[str, Callable[[np.random.Generator], Made]] = {
    "general, attitudes": attitudes_case,
    "general, noise 0.1": lambda rng: attitudes_case(rng, noise=0.1),
    "general, 60 times": lambda rng: attitudes_case(rng, count=60, span=25.0),
    "general, sigma unknown": lambda rng: attitudes_case(rng, even=True, known=False),
    "general, outliers 5 %": lambda rng: attitudes_case(rng, outliers=0.05),
    "general, axes": lambda rng: attitudes_case(rng, kind="axis", span=120.0),
    "general, axes of fast spins": lambda rng: attitudes_case(rng, kind="axis", span=20.0, omega3=30.0),
    "general, rates": lambda rng: attitudes_case(rng, kind="angular_velocity", span=100.0),
    "general, fields": lambda rng: attitudes_case(rng, kind="field_in_body", span=100.0),
    "ball, attitudes": lambda rng: attitudes_case(rng, family="ball"),
    "free, attitudes": lambda rng: attitudes_case(rng, family="free"),
    "top, attitudes": lambda rng: attitudes_case(rng, family="top"),
    "top, rates": lambda rng: attitudes_case(rng, kind="angular_velocity", family="top", span=100.0),
    "asymmetric, attitudes": lambda rng: attitudes_case(rng, family="asymmetric", span=100.0),
    "asymmetric, rates": lambda rng: attitudes_case(rng, kind="angular_velocity", family="asymmetric", span=100.0),
    "elementary, attitudes": lambda rng: attitudes_case(rng, family="elementary"),
}
"""Kinds of measurements."""


class Outcome(NamedTuple):
    """Outcome of a fit: parameters with an error and those within one standard error, seconds, reason of failure."""

    told: int
    within: int
    seconds: float
    lost: str


def outcome(kind: str, seed: int, i: int) -> Outcome:
    """Fit one measurement."""
    case = KINDS[kind](np.random.default_rng([seed, i]))
    began = time.process_time()
    try:
        fit = atlas.fit(case.t, **case.given)
    except atlas.AtlasError as error:
        return Outcome(0, 0, time.process_time() - began, f"{i}: {error}")
    seconds = time.process_time() - began
    truth = case.truth
    if "a1" in truth:  # a rotation by nearly half a turn has two vectors
        a = np.array([truth[name] for name in ATTITUDE])
        a_equivalent = a * (1 - 2 * np.pi / np.linalg.norm(a))
        nearest = min(
            (a, a_equivalent), key=lambda v: float(np.linalg.norm(v - [fit.params[name].value for name in ATTITUDE]))
        )
        truth = truth | dict(zip(ATTITUDE, nearest.tolist(), strict=True))
    deviations = [(fit.params[n].value - x, fit.params[n].stderr) for n, x in truth.items() if n in fit.names]
    scores = [(abs(off), error) for off, error in deviations if error is not None]  # of the others it says so
    # in the false minimum next to the true one, a parameter is off by far more than its error; of a motion that hardly
    # nutates it may be that none is determined, and the fit says so
    if fit.redchi > 1.5 or any(off > 8 * error + 1e-9 for off, error in scores):
        return Outcome(0, 0, seconds, f"{i}: chi square {fit.redchi:.3g}{', doubted' if fit.warnings else ''}")
    return Outcome(len(scores), sum(off < error for off, error in scores), seconds, "")


def measured(outcomes: list[Outcome]) -> dict[str, float]:
    """Return the shares in percent, the standard error of the second, and the median of seconds."""
    claimed, within = (
        np.array([(outcome.told, outcome.within) for outcome in outcomes if not outcome.lost], float).reshape(-1, 2).T
    )
    share = within.sum() / max(claimed.sum(), 1.0)
    return {
        "samples": len(outcomes),
        "found": round(100 * claimed.size / len(outcomes), 1),
        "within": round(100 * share, 1),
        "error": round(100 * float(np.linalg.norm(within - share * claimed)) / max(claimed.sum(), 1.0), 1),
        "seconds": round(float(np.median([outcome.seconds for outcome in outcomes])), 2),
    }


def main() -> None:
    """Fit them, and print a line a kind."""
    parser = argparse.ArgumentParser(prog="stress.fits", description=__doc__.partition("\n")[0])
    parser.add_argument("--samples", type=int, default=100)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--jobs", type=int, default=processors())
    parser.add_argument("--record", action="store_true")
    parser.add_argument("kinds", nargs="*", metavar="KIND")
    options = parser.parse_args()
    record = json.loads(RECORD.read_text(encoding="utf-8")) if RECORD.exists() else {}
    click.echo(f"{'kind':26} samples   found  within 1 sigma  CPU median, s   lost")
    os.environ["OPENBLAS_NUM_THREADS"] = "1"  # of the processes: a second thread would count twice
    with ProcessPoolExecutor(options.jobs, get_context("spawn")) as pool:
        for kind in options.kinds or KINDS:
            outcomes = list(pool.map(partial(outcome, kind, options.seed), range(options.samples)))
            m = measured(outcomes)
            within = f"{m['within']:.1f} +- {m['error']:.1f} %"
            failures = "; ".join(outcome.lost for outcome in outcomes if outcome.lost)
            click.echo(f"{kind:26} {m['samples']:7} {m['found']:5.0f} % {within:>15} {m['seconds']:14.2f}   {failures}")
            record[kind] = m
            if options.record:
                rows = ",\n".join(
                    f"  {json.dumps(name)}: {json.dumps(record[name])}" for name in KINDS if name in record
                )
                files.write(RECORD, f"{{\n{rows}\n}}\n")


if __name__ == "__main__":
    main()
