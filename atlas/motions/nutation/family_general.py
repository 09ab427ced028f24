"""The motion of a charged symmetric body from any initial angular velocity, in elliptic functions."""

from math import hypot
from typing import Any

from atlas.families.family import RATE, Command, Family, Quantity, Sampled
from atlas.families.parameters import ELLIPTIC, FIELD, OF_SYMMETRY, OMEGA, RATIO, integrals, nutation, rotation


def _complex(x: str, y: str) -> str:
    return x if y == "0" else f"{x} {'-' if y.startswith('-') else '+'} {y.lstrip('-')} i"


def _in_plane(arguments: dict[str, Any]) -> tuple[dict[str, Any], Any]:
    """Return (arguments, turn): field and omega in axes in which the field is (0, B2, B3), rounded.

    ``arguments`` are those of the family by name. ``turn`` is the matrix (3, 3) about e3 to these axes; None where
    K1, the first component of the field, is 0 and nothing is turned.
    """
    import numpy as np

    K1, K2, K3 = [0.0, *map(float, arguments["field"])][-3:]
    if not K1:
        return arguments | {"field": arguments["field"][-2:]}, None
    size = hypot(K1, K2)
    turn = np.array([[K2 / size, -K1 / size, 0.0], [K1 / size, K2 / size, 0.0], [0.0, 0.0, 1.0]])
    omega = turn @ [float(x) for x in arguments["omega"]]
    return arguments | {"field": (size, K3), "omega": tuple(omega)}, turn


FAMILY = Family(
    "general",
    "any motion of a charged symmetric body",
    "motions.nutation.{}_general.GeneralMotion",
    (RATIO, FIELD, OMEGA),
    (
        Quantity("kind", "type of motion"),
        Quantity(
            "turning_points", "least and largest", RATE, symbol="Omega3", columns=("least", "largest"),
            text=" ... ".join, certified=True,
        ),
        Quantity(
            "roots", "of Q(Omega3)", RATE, tabled=False,
            get=lambda motion: [[z.real, z.imag] for z in motion.roots if abs(float(z.real)) != float("inf")],
            text=lambda roots: ", ".join(_complex(*z) for z in roots) or "none",
        ),
        *nutation("B"),
        *ELLIPTIC,
        *integrals("M"),
    ),
    (
        *rotation("", "general R"),
        Sampled("Omega", "angular_velocity", "angular velocity in the body", RATE, checked="general Omega"),
        Sampled("K", "field_in_body", "field B' in the body", RATE, checked="general K", printed=False),
        Sampled("m", "angular_momentum", "angular momentum over I2", RATE, symbol="m_i/I2"),
    ),
    {
        "general R": 8, "general R grid": 16, "general Omega": 16, "general K": 16, "general orthogonality": 8,
        "general R(0) = 1": 4,
    },
    Command(
        "motion",
        "",
        "",
        (
            "atlas motion --ratio 1.5 --field 1 2 --omega 0.3 0.7 0.2 --times 0 1 2.5 --json",
            "atlas motion --ratio 1.5 --field 1 2 --omega 0.3 0.7 0.2 --times 1e6 --digits 50",
            "atlas motion --ratio 2 --field 0 1 --omega 1e-4 0 -1 --grid 0 1 40",
        ),
        "general motion: ",
        "kind",
        undecided=True,
    ),
    at_once=8192,
    figures=("general_motion", "larmor_pair", "pseudo_oscillator", "spectrum", "quadric"),
    instead=("omega",),
    last_axis=OF_SYMMETRY,
    is_sensitive=True,
    in_plane=_in_plane,
)  # fmt: skip
