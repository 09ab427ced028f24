"""Every symmetric top in a uniform field, from any start: from the paper's body to Lagrange's heavy top."""

from typing import Any

from atlas.families.family import RATE, Command, Family, Parameter, Quantity, Sampled
from atlas.families.parameters import ELLIPTIC, OMEGA, nutation, rotation


def _rates(motion: Any) -> Any:
    """Return a list of the rates in rad/time of the steady precessions of ``motion``, or the string "none"."""
    return [precession.rate for precession in motion.steady_precessions] or "none"


def _stability(motion: Any) -> str:
    """Return "stable", "unstable", or, for a motion in which theta varies, "not steady"."""
    return {True: "stable", False: "unstable", None: "not steady"}[motion.stable]


FAMILY = Family(
    "top",
    "any motion of a symmetric top in a uniform field",
    "motions.nutation.{}_top.TopMotion",
    (
        Parameter(
            "inertia", "Moments of inertia across and along the axis, in any unit.", "inertia", (1.0, 0.5), (0.05, 2.0),
            columns=("I2", "I3"), metavar="I2 I3",
        ),
        Parameter(
            "coupling", "Coefficients k across and along the axis, M = I Omega + k b; default 0 0.", "inertia/time",
            (0.0, 0.0), (-3.0, 3.0), needed=False, omitted=0.0, columns=("k2", "k3"), metavar="K2 K3",
        ),
        Parameter(
            "direction", "Direction n of the field in the body at t = 0, across and along the axis; any length.", "",
            (0.6, 0.8), (-1.0, 1.0), columns=("n2", "n3"), metavar="N2 N3",
        ),
        OMEGA,
        Parameter(
            "linear", "Coefficient of nu in the potential; m g l of a heavy top.", "inertia/time^2", (3.0,),
            (-5.0, 5.0), needed=False, omitted=0.0,
        ),
        Parameter(
            "quadratic", "Coefficient of nu^2/2 in the potential; an anisotropy.", "inertia/time^2", (0.0,),
            (-5.0, 5.0), needed=False, omitted=0.0,
        ),
    ),
    (
        Quantity("kind", "type of motion"),
        Quantity(
            "turning_points", "least and largest", symbol="nu", columns=("least", "largest"), text=" ... ".join,
            certified=True,
        ),
        *nutation("n"),
        Quantity(
            "steady_precessions", "rates of steady precession at this inclination and omega3", RATE,
            "theorem-top-precession", get=_rates, exact=_rates, tabled=False,
            text=lambda rates: rates if isinstance(rates, str) else " and ".join(rates),
        ),
        Quantity(
            "stable", "this steady motion against nutation", "", "theorem-top-nutation", get=_stability,
            exact=_stability, tabled=False,
        ),
        *ELLIPTIC,
    ),
    (
        *rotation("", "top R"),
        Sampled("Omega", "angular_velocity", "angular velocity in the body", RATE, checked="top Omega"),
        Sampled("b", "field_in_body", "direction n in the body", checked="top b", printed=False),
    ),
    {"top R": 16, "top R grid": 24, "top Omega": 16, "top b": 16, "top orthogonality": 16, "top R(0) = 1": 8},
    Command(
        "top",
        "Compute any motion of a symmetric top: heavy, charged, magnetised.",
        "Compute the nutation, rotation matrix R(t) and angular velocity of a symmetric top in a uniform field.\n\n"
        "The top has the angular momentum M = I Omega + k b and the potential linear nu + quadratic nu^2/2. Here n is "
        "the direction of the field, b the same vector along the body's axes, nu the cosine of the angle between n and "
        "the axis. --heavy and --magnetic compute these coefficients from a body. Tops are not in the paper.",
        (
            "atlas top --inertia 1 0.5 --direction 0.6 0.8 --omega 0.1 0.2 5 --linear 3 --times 0 1 1e6",
            "atlas top --inertia 1 0.75 --coupling 1 1.5 --direction 1 2 --omega 0.3 0.7 0.2 --times 1e12 --digits 40",
            "atlas top --shape disk --radius 0.03 --mass 0.1 --heavy 9.81 0.04 --direction 0.3 1 --omega 0 0 150",
            "atlas top --inertia 1 0.5 --mass 1 --heavy 9.81 0.5 --charged 0.2 0.3 --magnetic 0.3 1 --omega 0 0 9",
            "atlas top --inertia 2e-27 1e-27 --charged 1e-23 2e-23 --magnetic 1 2 --omega 0.1 0.2 0.3",
            "atlas top --inertia 1 0.5 --direction 0 1 --omega 1e-3 0 1 --linear 2 --grid 0 1 40 --json",
        ),
        "top: ",
        "kind",
        undecided=True,
    ),
    at_once=8192,
    figures=("top_motion",),
    instead=("inertia", "direction", "omega"),
    is_sensitive=True,
)  # fmt: skip
