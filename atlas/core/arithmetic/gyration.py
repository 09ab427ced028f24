"""The functions of a phase x that motion in a magnetic field is made of, without cancellation at x = 0."""

from dataclasses import dataclass
from math import factorial

import numpy as np

from atlas.core.inputs import FloatArray

SERIES = np.array([(-1) ** n / factorial(2 * n + 3) for n in range(12, -1, -1)])
"""Coefficients of (x - sin x)/x^3 in powers of x^2, highest first: to the last digit for |x| < 2."""

TINY = 2.0**-500
"""Below it, 0 included, each function is its limit to far less than an ulp, while x^2 would underflow."""


@dataclass(frozen=True)
class Gyration:
    """Functions of x, each to a few ulp of its own size, but cos x and sin x to an ulp of 1 where they are small."""

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


def gyration(x: FloatArray, cos: FloatArray, sin: FloatArray, versine: FloatArray) -> Gyration:
    """Return the functions at x (m,), given cos x, sin x and 1 - cos x, found from a better reduced x than x itself."""
    tiny = np.abs(x) < TINY
    divisor = np.where(tiny, 1.0, x)
    s, g = sin / divisor, versine / divisor
    f, h = g / divisor, (1.0 - s) / divisor
    near = np.abs(x) < 2
    h[near] = x[near] * np.polyval(SERIES, x[near] ** 2)
    s[tiny], f[tiny], g[tiny] = 1.0, 0.5, x[tiny] / 2
    return Gyration(cos, sin, s, f, g, h)
