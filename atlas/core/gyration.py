"""The functions of a phase x that motion in a magnetic field is made of, without cancellation at x = 0."""

from dataclasses import dataclass
from math import factorial
from typing import Any

import numpy as np

from atlas.core.inputs import FloatArray

SERIES = np.array([(-1) ** n / factorial(2 * n + 3) for n in range(12, -1, -1)])
"""Coefficients of (x - sin x)/x^3 in powers of x^2, highest first: to the last digit for |x| < 2."""


@dataclass(frozen=True)
class Gyration:
    """Functions of x, each to a few ulp of its own size but for zeros of cos x, where it is to an ulp of 1."""

    cos: FloatArray
    sin: FloatArray
    s: FloatArray
    """sin x / x"""
    f: FloatArray
    """(1 - cos x)/x^2"""
    g: FloatArray
    """(1 - cos x)/x"""
    h: FloatArray
    """(x - sin x)/x^2"""


def gyration(x: Any, sine: Any, cosine: Any) -> Gyration:
    """Return the functions at x, given sin(x/2) and cos(x/2): of an x reduced better than x itself, if it is large."""
    x, sine, cosine = np.broadcast_arrays(x, sine, cosine)
    # Below 2^-500 (0 included) every function equals its limit to far less than an ulp, and x^2 would underflow.
    tiny = np.abs(x) < 2.0**-500
    safe = np.where(tiny, 1.0, x)
    half = np.where(tiny, 1.0, sine / (safe / 2))
    sin = np.where(tiny, x, 2 * sine * cosine)
    near = np.where(np.abs(x) < 2, x, 0.0)
    return Gyration(
        cos=1 - 2 * sine * sine,
        sin=sin,
        s=half * cosine,
        f=half * half / 2,
        g=np.where(tiny, x / 2, half * sine),
        h=np.where(np.abs(x) < 2, near * np.polyval(SERIES, near * near), (1 - sin / safe) / safe),
    )
