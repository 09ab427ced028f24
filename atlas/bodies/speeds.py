"""Speeds beside that of light, where units are known: all formulas of the atlas are non-relativistic.

A charge drifts across crossed fields with c [E, B]/B^2, (94), which is below the speed of light only while |E| across B
is below c |B| in SI, below |B| in Gaussian units. What is above a tenth of the speed of light is warned of once, by a
`RelativisticWarning`; a drift at or above it is refused.
"""

import warnings
from collections.abc import Mapping
from typing import Any

import numpy as np

from atlas.arithmetic.inputs import FloatArray, scaled
from atlas.bodies.units import SPEED_OF_LIGHT, System
from atlas.errors import DomainError, RelativisticWarning

MAX_SLOW_SPEED = 0.1
"""Part of the speed of light above which a speed is warned of: squares of it are beyond a percent."""

ELLIPSOIDS = "sphere", "spherical_shell", "spheroid"
"""Shapes without a rim."""

RIM = np.linspace(0.0, 2 * np.pi, 64, endpoint=False)
"""Angles of points of a rim at which its speed is taken."""


def speed_of_light(units: System) -> float:
    """Return the speed of light in a system's unit of length per second: m/s in SI, cm/s in Gaussian units."""
    return SPEED_OF_LIGHT if units.c == 1 else units.c


def check_drift(E: Any, B: Any, units: System) -> None:
    """Warn with RelativisticWarning if the drift c [E, B]/B^2 exceeds a tenth of the speed of light.

    ``E`` and ``B`` (3,) are in ``units``. Without one of them there is no drift. Raises DomainError for a drift at the
    speed of light or above.
    """
    e, n = (np.array(x, dtype=float) for x in (E, B))
    if not (n.any() and e.any()):
        return
    (n, up), (e, down) = scaled(n), scaled(e)
    with np.errstate(over="ignore"):
        drift = np.ldexp(np.linalg.norm(np.cross(e, n)) / (n @ n), down - up)
        beta = float(drift * units.c / speed_of_light(units))
    if beta >= 1:
        least = "c |B|" if units.c == 1 else "|B|"
        raise DomainError(
            f"electric field: the drift c [E, B]/B^2 would be {beta:.6g} times the speed of light: the part of E "
            f"across B must stay below {least}, for the atlas is non-relativistic."
        )
    warn_of("the drift c [E, B]/B^2", beta)


def warn_of(speed: str, beta: float) -> None:
    """Issue a RelativisticWarning that names `speed` if `beta`, its value over the speed of light, exceeds a tenth."""
    if beta > MAX_SLOW_SPEED:
        warnings.warn(
            f"non-relativistic: {speed} is {beta:.3g} times the speed of light, above {MAX_SLOW_SPEED:g}: formulas are "
            "off by about the square of that.",
            RelativisticWarning,
            stacklevel=4,
        )


def fastest_point(shape: str, sizes: Mapping[str, float], omega: Any) -> float:
    """Return the largest speed |[Omega, x]| of the points x of a shape about e3, in the unit of length times rad/time.

    ``shape`` is one of `SHAPES`, ``sizes`` are its dimensions by name, ``omega`` (3,) in rad/time is along the
    body's axes.
    """
    w, r = np.array(omega, dtype=float), float(sizes.get("radius", 0.0))
    if shape in ELLIPSOIDS:
        axes = [float(sizes.get(name, r)) for name in ("equatorial", "equatorial", "polar")]
        return float(np.linalg.norm(np.cross(w, np.diag(axes)), 2))
    half = float(sizes.get("height", sizes.get("length", 0.0))) / 2
    rim = np.stack([r * np.cos(RIM), r * np.sin(RIM), np.full_like(RIM, half)], -1)
    return fastest_of(rim, w)


def fastest_of(points: FloatArray, omega: Any) -> float:
    """Return the largest speed |[Omega, x]| of points x (..., 3), in length times rad/time.

    ``omega`` (3,) is in rad/time, along the axes of the points.
    """
    return float(np.linalg.norm(np.cross(np.array(omega, dtype=float), points), axis=-1).max())
