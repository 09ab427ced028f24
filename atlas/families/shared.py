"""Parameters that several families share, and how values are written."""

from typing import Any

from atlas.families.model import RATE, Parameter, Sampled

RATIO = Parameter("ratio", "I = I3/I2, in (0, 2].", "", (1.5,), (0.05, 2.0), option=False)
FIELD = Parameter(
    "field", "Components of B' = mu B/(2c).", RATE, (1.0, 2.0), (-3.0, 3.0), columns=("B2", "B3"), option=False
)
OMEGA = Parameter(
    "omega",
    "Initial angular velocity, in 1/time.",
    RATE,
    (0.3, 0.7, 0.2),
    (-3.0, 3.0),
    columns=("omega1", "omega2", "omega3"),
    metavar="W1 W2 W3",
)


def rotation(equation: str, checked: str) -> Sampled:
    """Return the rotation matrix of a family."""
    return Sampled("R", "rotation", "rotation matrix", equation=equation, matrix=True, checked=checked)


def in_brackets(parts: Any) -> str:
    """Write a vector."""
    return f"({', '.join(parts)})"
