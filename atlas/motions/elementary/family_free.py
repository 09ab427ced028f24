"""The free symmetric body beside the charged one, (87)."""

from atlas.families.family import RATE, TIME, Family, Quantity, Sampled
from atlas.families.parameters import OMEGA, RATIO, rotation

FAMILY = Family(
    "free",
    "motion of a free symmetric body",
    "motions.elementary.{}.FreeMotion",
    (RATIO, OMEGA),
    (
        Quantity("k", "frequency of precession about m", RATE, "(87)", checked="free k", certified=True),
        Quantity("phi", "frequency of proper rotation", RATE, "(87)", checked="free phi", certified=True),
        Quantity("mode", "axis that the momentum goes round", tabled=False),
        Quantity("period", "period of Omega, 2 pi/|phi|", TIME, certified=True),
        Quantity("precession_rate", "about the momentum, k", RATE, certified=True),
        Quantity("spin_rate", "about the body's axis, phi", RATE, certified=True),
    ),
    (
        *rotation("(87)", "free R"),
        Sampled("Omega", "angular_velocity", "angular velocity in the body", RATE, checked="free Omega"),
    ),
    {"free R": 4, "free k": 4, "free phi": 4, "free Omega": 8},
    figures=("free_motion",),
    typed=("motion", "--field", "0", "0"),
)
