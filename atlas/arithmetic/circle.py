"""Cosines and sines of phases that were reduced to half a turn."""

import numpy as np

from atlas.arithmetic.inputs import FloatArray

# Constants that meet arrays are arrays without dimensions: NumPy takes a third less time for a call with few times.
HALF, WHOLE, NOTHING, ONE_BITS, SIGN_BIT = (np.array(x) for x in (0.5, 1.0, 0.0, np.float64(1.0).view(np.int64), 63))


def signs(sums: FloatArray) -> FloatArray:
    """Replace, in place, each integer + ROUNDER by 1.0 for an even integer, -1.0 for an odd one; return the array.

    ``sums`` is a float64 array of any shape; ROUNDER is that of `phase`.
    """
    parity = sums.view(np.int64)
    np.left_shift(parity, SIGN_BIT, out=parity)
    np.bitwise_or(parity, ONE_BITS, out=parity)
    return sums


def circle_of(
    u: FloatArray,
    e: FloatArray | None,
    sign: FloatArray,
    square: FloatArray,
    cos: FloatArray,
    sin: FloatArray,
    versine: FloatArray,
) -> None:
    """Fill ``cos``, ``sin`` and ``versine`` as `Phases.circle` does, from u = x/2, its rounding error e, and signs.

    All arrays are (n, m) but ``versine`` (m,); ``sign`` holds 1 or -1, the sign of the half turns that x leaves out.
    u, e and ``square`` are overwritten. Without e, x/2 is exactly u.
    """
    # u = tan(x/2), |u| <= 1: NumPy vectorises the tangent, and not the sine and cosine;
    # u then gets the rounding error of x
    np.tan(u, out=u)
    if e is not None:
        np.multiply(u, u, out=square)
        square += WHOLE
        e *= square
        u += e
    np.multiply(u, u, out=square)
    square += WHOLE
    np.divide(u, square, out=sin)
    half = np.multiply(u, sin, out=square)
    np.subtract(HALF, half, out=cos)
    cos *= sign
    sin *= sign
    np.multiply(half[0], sign[0], out=versine)
    versine += sign[0] < NOTHING
