"""The free symmetric body beside the charged one, (87)."""

from typing import Any

from atlas.families.family import RATE, TIME, Family, Quantity, Sampled
from atlas.families.shared import OMEGA, RATIO, rotation


def _kernels() -> Any:
    from atlas.core.motions.elementary import FreeMotion

    return FreeMotion


def _balls() -> Any:
    from atlas.exact.motions.elementary import FreeMotion

    return FreeMotion


FAMILY = Family(
    "free",
    "motion of a free symmetric body",
    _kernels,
    _balls,
    (RATIO, OMEGA),
    (
        Quantity("k", "frequency of precession about m", RATE, "(87)", checked="free k", certified=True),
        Quantity("phi", "frequency of proper rotation", RATE, "(87)", checked="free phi", certified=True),
        Quantity("period", "period of precession, 2 pi/k", TIME, certified=True),
    ),
    (
        *rotation("(87)", "free R"),
        Sampled("Omega", "angular_velocity", "angular velocity in the body", RATE, checked="free Omega"),
    ),
    {"free R": 4, "free k": 4, "free phi": 4, "free Omega": 8},
    figures=("free_motion",),
)
