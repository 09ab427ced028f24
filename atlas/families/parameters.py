"""Parameters that several families share, and how values are written."""

from functools import partial
from typing import Any

from atlas.families.family import RATE, TIME, Parameter, Quantity, Sampled

OF_SYMMETRY = ", the last that of symmetry"
"""The last axis of the class of a symmetric body."""

RATIO = Parameter("ratio", "I = I3/I2, in (0, 2].", "", (1.5,), (0.05, 2.0), option=False)
FIELD = Parameter(
    "field", "Components of B' = mu B/(2c).", RATE, (1.0, 2.0), (-3.0, 3.0), columns=("B2", "B3"), option=False
)
OMEGA = Parameter(
    "omega",
    "Initial angular velocity; along the body's axes.",
    RATE,
    (0.3, 0.7, 0.2),
    (-3.0, 3.0),
    columns=("omega1", "omega2", "omega3"),
    metavar="W1 W2 W3",
)
MOMENTS = Parameter(
    "inertia",
    "Principal moments of inertia.",
    "inertia",
    (0.8, 1.0, 1.3),
    (0.5, 2.0),
    columns=("I1", "I2", "I3"),
    metavar="I1 I2 I3",
)
PRINCIPAL_FIELD = Parameter(
    "field",
    "Components of B' = mu B/(2c) along the principal axes at t = 0.",
    RATE,
    (0.2, 1.0, 0.6),
    (-3.0, 3.0),
    columns=("B1", "B2", "B3"),
    metavar="B1 B2 B3",
)


def rotation(equation: str, checked: str) -> tuple[Sampled, ...]:
    """Return three functions of time as `Sampled`: R, its quaternion, and the angular velocity in the laboratory.

    ``equation`` is that of R, ``checked`` its name in a stress run.
    """
    return (
        Sampled("R", "rotation", "rotation matrix", equation=equation, matrix=True, checked=checked),
        Sampled("q", "quaternion", "unit quaternion of R, continuous", components=tuple("xyzw"), uncertified=True),
        Sampled(
            "w", "angular_velocity_in_laboratory", "angular velocity in the laboratory", RATE, printed=False,
            uncertified=True,
        ),
    )  # fmt: skip


def nutation(axis: str) -> tuple[Quantity, ...]:
    """Return five quantities of nutation as `Quantity`: its period, precession and spin per period, their mean rates.

    ``axis`` names the axis of precession in words, such as "B".
    """
    turns = (("precession", axis), ("spin", "the body's axis"))

    def phrases(words: str) -> dict[str, Any]:
        return {"says": words, "cases": {"free body": (words.replace(f"about {axis}", "about the momentum"), "")}}

    return (
        Quantity("period", "period of nutation", TIME, certified=True, cases={"free body": ("period of Omega", "")}),
        *(
            Quantity(f"{name}_per_period", unit="rad", missing="no period", certified=True,
                     **phrases(f"turn about {axis_name} in one period"))
            for name, axis_name in turns
        ),
        *(
            Quantity(f"{name}_rate", unit=RATE, missing="no period", certified=True,
                     **phrases(f"mean rate about {axis_name}"))
            for name, axis_name in turns
        ),
    )  # fmt: skip


ELLIPTIC = tuple(
    Quantity(name, "of the elliptic functions", missing="triple root", certified=True) for name in ("modulus", "nome")
)


def in_brackets(components: Any) -> str:
    """Return texts ``components``, the components of a vector, joined in brackets: "(0.1, 0.2)"."""
    return f"({', '.join(components)})"


def integrals(letter: str) -> tuple[Quantity, ...]:
    """Return five constants of a motion as `Quantity`: E' (36), K^2 (37), c3 (40), c5 (41), momentum along the field.

    ``letter``, "m" or "M", says which momentum over I2: M = II (Omega + K) is the canonical one, m = II Omega the
    mechanical one; II is the inertia tensor, K the field in the body.
    """
    momentum = "II (Omega + K) along the field, over I2" if letter == "M" else "momentum along the field, over I2"
    return tuple(
        Quantity(
            name, says, unit, equation, get=partial(_integral, key), exact=partial(_constant, key), certified=True,
            printed=False,
        )
        for key, name, says, unit, equation in (
            ("E'", "energy", "energy 2 E/I2", "1/time^2", "(36)"),
            ("K^2", "field_squared", "square of the field in the body", "1/time^2", "(37)"),
            ("c3", "c3", "integral c3", RATE, "(40)"),
            ("c5", "c5", "integral c5", "1/time^2", "(41)"),
            (f"({letter},B')", "along_field", momentum, "1/time^2", "(88)" if letter == "m" else ""),
        )
    )  # fmt: skip


def _integral(key: str, motion: Any) -> Any:
    return motion.invariants()[key]


def _constant(key: str, motion: Any) -> Any:
    return motion.invariants[key]
