"""Families in elementary functions: motions (58) to (88), free bodies, hyperbolas (67) to (72), balls (20) to (30)."""

from typing import Any

from atlas.families.family import RATE, TIME, Command, Family, Parameter, Quantity, Sampled
from atlas.families.parameters import FIELD, OF_SYMMETRY, OMEGA, RATIO, in_brackets, integrals, rotation

OMEGA3, PRECESSION, PROPER = (
    "third component of Omega, constant", "frequency of precession about B", "frequency of proper rotation",
)  # fmt: skip
FREE_SPIN = ("spin along the field", "transverse field, free spin", "ball, free spin")
"""Cases in which omega3 is given and the paper has no equation."""


def _stability(motion: Any) -> Any:
    """Return the squared frequency of small nutations at the motion's omega2, in 1/time^2, a float or an array.

    ``motion`` is one or more elementary motions in doubles.
    """
    from atlas.motions.elementary.kernel_hyperbola import Hyperbola

    return Hyperbola(*_ratio_and_field(motion)).stability(motion.omega2)


def _curve(motion: Any) -> Any:
    """Return the certified `Hyperbola` of a single elementary motion, in doubles or certified."""
    from atlas.motions.elementary.certified_hyperbola import Hyperbola

    return Hyperbola(*((motion.I, (motion.B2, motion.B3)) if hasattr(motion, "I") else _ratio_and_field(motion)))


def _ratio_and_field(motion: Any) -> tuple[Any, Any]:
    """Return (ratio, (B2, B3)) of an elementary motion in doubles, along the axes of its class, as given."""
    arguments = motion.own.arguments
    return arguments["ratio"], arguments["field"]


def _verdict(motion: Any) -> str:
    """Return "stable" or "unstable", against small nutations, of a single elementary motion, decided exactly."""
    return "stable" if _curve(motion).stable(motion.omega2) else "unstable"


FAMILY = Family(
    "elementary",
    "steady precession of a charged symmetric body",
    "motions.elementary.{}.ElementaryMotion",
    (
        RATIO,
        FIELD,
        Parameter("omega2", "Second component of the initial angular velocity.", RATE, (0.7,), (-3.0, 3.0)),
        Parameter(
            "omega3", "Third component of the initial angular velocity; only where (71) leaves it free: B = 0, B2 = 0, "
            "or the pole omega2 = -B2.", RATE, (), (-3.0, 3.0),
            needed=False,
        ),
    ),
    (
        Quantity("case", "name of the case"),
        Quantity(
            "omega3", OMEGA3, RATE, "(71)", dict.fromkeys(("free body", *FREE_SPIN), (OMEGA3, "given")),
            checked="omega3", certified=True,
        ),
        Quantity(
            "k", PRECESSION, RATE, "(79)",
            {"free body": (PRECESSION.replace("B", "m"), "(87)")} | dict.fromkeys(FREE_SPIN, (PRECESSION, "")),
            checked="k", certified=True,
        ),
        Quantity(
            "phi", PROPER, RATE, "(72)", {"free body": (PROPER, "(87)")} | dict.fromkeys(FREE_SPIN, (PROPER, "")),
            checked="phi", certified=True,
        ),
        Quantity(
            "period", "period of precession, 2 pi/|k|", TIME, certified=True, printed=False,
        ),
        Quantity(
            "stability", "square of the frequency of small nutations", "1/time^2", "theorem-stability", get=_stability,
            exact=lambda motion: _curve(motion).stability(motion.omega2), certified=True, printed=False,
        ),
        Quantity("nutation", "stable or not against small nutations", "", "theorem-band", get=_verdict,
                 certified=True, printed=False, tabled=False),
        *integrals("m"),
    ),
    (
        *rotation("(84)", "R"),
        Sampled("Omega", "angular_velocity", "angular velocity in the body", RATE, "(73)", checked="Omega"),
        Sampled("K", "field_in_body", "field B' in the body", RATE, "(32)", checked="K", printed=False),
        Sampled("m", "angular_momentum", "angular momentum over I2", RATE, "(88)", "m_i/I2", checked="m"),
    ),
    {
        "R": 4, "R at one time": 4, "R grid": 4, "R orthogonality": 4, "R determinant": 4, "R(0) = 1": 0,
        "columns 1, 2": 4, "R13, R23 for |kt| < 1": 8, "R under scaling by 2^n": 0, "third axis": 4,
        "k": 4, "phi": 4, "omega3": 4, "Omega": 8, "K": 8, "m": 8,
    },
    Command(
        "motion",
        "Compute any motion of any body.",
        "Compute the rotation matrix R(t), the angular velocity and the constants of a motion.\n\n"
        "Give a body, a field and a start. A start --omega2 is an elementary motion, (71) to (85). A start --omega W1 "
        "W2 W3 or --spin W3 is any motion, not in the paper. Components are along the axes of the body at t = 0.\n\n"
        "A symmetric body (--ratio, --shape or --inertia I2 I3) in a field B2 B3 moves in elliptic functions. A body "
        "with three moments (--inertia I1 I2 I3, --points, --tensor), and any body in a field B1 B2 B3, moves in theta "
        "functions of two variables, which are proved for this motion or compared with certified digits. With --digits "
        "every digit printed is proven, at any time.",
        (
            "atlas motion --ratio 1.5 --field 1 2 --omega2 0.7 --times 0 1 2.5 --json",
            "atlas motion --ratio 1.5 --field 1 2 --omega2 0.7 --times 1e6 --digits 50",
        ),
        "elementary motion: ",
        "case",
    ),
    figures=("motion_sphere", "motion", "rolling_cones", "hyperbola", "quadric", "stability"),
    last_axis=OF_SYMMETRY,
    is_sensitive=True,
)  # fmt: skip

FREE = Family(
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
    last_axis=OF_SYMMETRY,
    is_sensitive=True,
    axis_rate="k",
)

HYPERBOLA = Family(
    "hyperbola",
    "curve of elementary motions of a body in a field",
    "motions.elementary.{}_hyperbola.Hyperbola",
    (RATIO, FIELD),
    (
        Quantity("pole", "pole of omega3(omega2)", RATE, "(71)", symbol="-B2", tabled=False),
        Quantity(
            "unstable_band", "((omega2 + B2)/B2)^2 where the motion is unstable", symbol="y", text=" to ".join,
            tabled=False,
        ),
        Quantity(
            "least_stability", "least of the squared frequencies of small nutations", "1/time^2", certified=True,
            printed=False,
        ),
    ),
    promises={
        "omega3 of the hyperbola": 4, "stability": 4, "k of the hyperbola": 4, "phi of the hyperbola": 4,
        "points of the hyperbola": 4,
    },
    figures=("hyperbola", "frequencies", "stability"),
    typed=("hyperbola",),
)  # fmt: skip

MOMENT = "inertia/time"

BALL = Family(
    "ball",
    "motion of a charged ball, B along e3",
    "motions.elementary.{}_ball.BallMotion",
    (
        Parameter("inertia", "Moment of inertia I0.", "inertia", (1.0,), (0.1, 4.0), needed=False, omitted=1.0),
        Parameter("larmor", "Larmor frequency alpha = mu |B|/(2c); of either sign.", RATE, (0.5,), (-3.0, 3.0)),
        Parameter(
            "momentum", "Initial angular momentum (0, m2, m3); B is along e3.", MOMENT, (0.3, -0.7), (-3.0, 3.0),
            columns=("m2", "m3"), metavar="M2 M3",
        ),
    ),
    (
        Quantity("gamma", "frequency of the turn about k_hat", RATE, "(29)", checked="ball gamma", certified=True),
        Quantity(
            "k_hat", "its axis, B along the third", "", "(29)", columns=("k2", "k3"),
            text=lambda components: in_brackets(("0", *components)), checked="ball k_hat", certified=True,
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
        "Compute the rotation of a charged ball.",
        "Compute the rotation matrix R(t) and the angular momentum m(t) of a charged ball, (26) to (29).",
        ("atlas ball --larmor 0.5 --momentum 0.3 -0.7 --times 0 1 10",),
        "charged ball",
    ),
    figures=("ball_motion", "ball"),
    last_axis=", the last along the field at t = 0",
    is_sensitive=True,
)  # fmt: skip
