"""Any motion of a body with three different moments of inertia, by every road there is.

The question: what do theta functions of two variables cost beside integrators, and how true are they at long times?

The body, field and start of the guide: moments (0.8, 1, 1.3), B' = (0.2, 1, 0.6), omega = (0.3, 0.7, 0.2). No other
program is known that evaluates this motion, so that the peers are integrators; the plain formula of the elementary
motion, timed beside, stands for a second of work. True values are certified and take a while: there are few of them.
"""

from collections.abc import Sequence
from typing import Any

from atlas.core.motions import asymmetric as kernels
from atlas.core.motions.asymmetric import AsymmetricMotion
from atlas.exact.motions.asymmetric import AsymmetricMotion as Exact
from benchmarks import elementary
from benchmarks.case import Case, Parameters, cross, rotation_case

PARAMETERS: Parameters = {"inertia": (0.8, 1.0, 1.3), "field": (0.2, 1.0, 0.6), "omega": (0.3, 0.7, 0.2)}
SAMPLES = 16


def motion() -> AsymmetricMotion:
    """Make the motion, with its closed form, anew: motions that were made are kept."""
    kernels.forget()
    made = AsymmetricMotion(**PARAMETERS)
    made.rotation(1.0)
    return made


def rates(state: Sequence[Any], p: Parameters) -> list[Any]:
    """Rates of the rows of R, (12), and of Omega, (16), with K = R^T B'."""
    I, B = p["inertia"], p["field"]
    rows, Omega = (state[0:3], state[3:6], state[6:9]), state[9:12]
    K = [B[0] * rows[0][j] + B[1] * rows[1][j] + B[2] * rows[2][j] for j in range(3)]
    W = [w + k for w, k in zip(Omega, K, strict=True)]
    # M = II W: M' = [M, W] + [K, II K], K' = [K, W]
    M = [i * w for i, w in zip(I, W, strict=True)]
    both = zip(cross(M, W), cross(K, [i * k for i, k in zip(I, K, strict=True)]), cross(K, W), I, strict=True)
    return [*(rate for row in rows for rate in cross(row, Omega)), *((x + y) / i - z for x, y, z, i in both)]


def case() -> Case:
    """Return the case; its true values are those of `atlas.exact`."""
    exact = Exact(PARAMETERS["inertia"], PARAMETERS["field"], PARAMETERS["omega"])
    return rotation_case(
        motion,
        exact,
        exact.angular_velocity(0),
        name="asymmetric",
        parameters=PARAMETERS,
        rates=rates,
        from_omega=True,
        base=elementary.plain,
        samples=SAMPLES,
    )
