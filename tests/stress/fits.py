"""Does a fit find the motion without a start, and are its errors right? Made-up measurements of 15 kinds.

    python -m stress.fits [--samples 10] [--seed 0] [KIND...]

Each motion is integrated by SciPy (`atlas.simulate`), the axes' and rates' among them, and noise is added. Told are the
share that converges, how often the truth is within one standard error, over all parameters, and processor time.
"""

import argparse
import time
from collections.abc import Callable
from typing import Any, NamedTuple

import click
import numpy as np
from scipy.spatial.transform import Rotation

import atlas


class Made(NamedTuple):
    """A made-up measurement: arguments of `atlas.fit`, and the true parameters."""

    t: Any
    given: dict[str, Any]
    truth: dict[str, float]


def made(
    rng: np.random.Generator, *, kind: str = "rotation", count: int = 500, span: float = 200.0, noise: float = 0.01,
    even: bool = False, known: bool = True, outliers: float = 0.0, family: str = "general", spin: float = 1.5,
) -> Made:  # fmt: skip
    """Return a measurement of a random motion."""
    ratio = 1.0 if family == "ball" else rng.uniform(0.4, 1.8)
    B = np.zeros(3) if family == "free" else rng.normal(size=3)
    w, A = rng.normal(size=3) * spin, Rotation.random(random_state=rng)
    t = np.linspace(0, span, count) if even else np.sort(rng.uniform(0, span, count))
    steps = atlas.simulate(ratio, A.inv().apply(B), w, t, rtol=1e-11)
    R = A.as_matrix() @ steps.R
    values = {"axis": R[:, :, 2], "angular_velocity": steps.Omega, "field_in_body": np.vecmat(B, R)}.get(kind, R)
    if kind in ("rotation", "quaternion"):
        turns = rng.normal(0, noise, (count, 3))
        turns[rng.random(count) < outliers] = rng.normal(size=3)
        values = Rotation.from_rotvec(turns).as_matrix() @ R
        values = Rotation.from_matrix(values).as_quat() if kind == "quaternion" else values
    else:
        values = values + rng.normal(0, noise, values.shape)
    truth = {"ratio": ratio, "b": float(np.linalg.norm(B))}
    truth |= {
        f"{x}{i}": float(v) for x, y in (("B", B), ("omega", w), ("a", A.as_rotvec())) for i, v in enumerate(y, 1)
    }
    if kind in ("angular_velocity", "field_in_body"):
        truth |= {f"B{i}": float(v) for i, v in enumerate(A.inv().apply(B), 1)}
    if kind == "axis":  # omega1 and omega2 are along axes of a convention
        truth = {name: truth[name] for name in ("ratio", "b", "B1", "B2", "B3", "omega3")}
    options: dict[str, Any] = {"sigma": noise if known else None, "family": family}
    return Made(t, {kind: values, **options, **({"loss": "soft_l1"} if outliers else {})}, truth)


KINDS: dict[str, Callable[[np.random.Generator], Made]] = {
    "attitudes": made,
    "attitudes, evenly": lambda rng: made(rng, even=True),
    "attitudes, dense": lambda rng: made(rng, even=True, span=20.0),
    "attitudes, noise 0.1": lambda rng: made(rng, noise=0.1),
    "attitudes, 60 times": lambda rng: made(rng, count=60, span=25.0),
    "attitudes, 1e-4": lambda rng: made(rng, noise=1e-4),
    "attitudes, sigma unknown": lambda rng: made(rng, known=False),
    "attitudes, outliers 5 %": lambda rng: made(rng, outliers=0.05),
    "attitudes, long": lambda rng: made(rng, count=1500, span=600.0),
    "quaternions": lambda rng: made(rng, kind="quaternion", span=60.0),
    "axes": lambda rng: made(rng, kind="axis", count=600, span=120.0),
    "angular velocities": lambda rng: made(rng, kind="angular_velocity", span=100.0),
    "fields in the body": lambda rng: made(rng, kind="field_in_body", span=100.0),
    "balls": lambda rng: made(rng, family="ball"),
    "free bodies": lambda rng: made(rng, family="free"),
}
"""Kinds of measurements."""


def main() -> None:
    """Fit them, and print a line a kind."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--samples", type=int, default=10)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("kinds", nargs="*", metavar="KIND")
    asked = parser.parse_args()
    click.echo(f"{'kind':26} samples  converge  within 1 sigma  CPU median, s   worst")
    for kind, make in KINDS.items():
        if asked.kinds and kind not in asked.kinds:
            continue
        good, pulls, seconds, lost = 0, [], [], []
        for i in range(asked.samples):
            one = make(np.random.default_rng([asked.seed, i]))
            began = time.process_time()
            try:
                found = atlas.fit(one.t, **one.given)
            except atlas.AtlasError as error:
                lost.append(f"{i}: {error}")
                continue
            finally:
                seconds.append(time.process_time() - began)
            own = {
                n: (found.params[n].value - x, found.params[n].stderr) for n, x in one.truth.items() if n in found.names
            }
            # in the false minimum next to the true one, a parameter is off by far more than its error
            if all(error is not None and abs(off) < 8 * error + 1e-9 for off, error in own.values()):
                good += 1
                pulls += [abs(off / error) < 1 for off, error in own.values()]
            else:
                lost.append(f"{i}: chi square {found.redchi:.3g}")
        share = 100 * np.mean(pulls) if pulls else float("nan")
        click.echo(
            f"{kind:26} {asked.samples:7} {good:9} {share:13.0f} % {np.median(seconds):12.2f} {max(seconds):9.1f}"
            f"   {'; '.join(lost)}"
        )


if __name__ == "__main__":
    main()
