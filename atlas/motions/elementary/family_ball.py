"""The charged ball, (20) to (30)."""

from atlas.families.family import RATE, Command, Family, Parameter, Quantity, Sampled
from atlas.families.parameters import in_brackets, rotation

MOMENT = "inertia/time"


FAMILY = Family(
    "ball",
    "motion of a charged ball, B along e3",
    "motions.elementary.{}_ball.BallMotion",
    (
        Parameter("inertia", "Moment of inertia I0.", "inertia", (1.0,), (0.1, 4.0), needed=False, omitted=1.0),
        Parameter("larmor", "Larmor frequency alpha = mu |B|/(2c), either sign.", RATE, (0.5,), (-3.0, 3.0)),
        Parameter(
            "momentum", "m(0) = (0, m2, m3), B along e3.", MOMENT, (0.3, -0.7), (-3.0, 3.0), columns=("m2", "m3"),
            metavar="M2 M3",
        ),
    ),
    (
        Quantity("gamma", "frequency of the turn about k_hat", RATE, "(29)", checked="ball gamma", certified=True),
        Quantity(
            "k_hat", "its axis, B along the third", "", "(29)", columns=("k2", "k3"),
            text=lambda parts: in_brackets(("0", *parts)), checked="ball k_hat", certified=True,
        ),
    ),
    (
        *rotation("(28)", "ball R"),
        Sampled("m", "angular_momentum", "angular momentum", MOMENT, "(26)", checked="ball m"),
        Sampled("Omega", "angular_velocity", "angular velocity in the body", RATE, checked="ball Omega", printed=False),
    ),
    {"ball R": 4, "ball gamma": 4, "ball k_hat": 4, "ball m": 8, "ball Omega": 8},
    Command(
        "ball",
        "Rotate a charged ball (26) to (29).",
        "General motion of a charged ball: R(t) and m(t) (26) to (29).",
        ("atlas ball --larmor 0.5 --momentum 0.3 -0.7 --times 0 1 10",),
        "charged ball",
    ),
    figures=("ball_motion", "ball"),
)  # fmt: skip
