"""Errors of R in a table: those of the atlas and of the plain formula (84), row by row against balls."""

from collections.abc import Sequence
from functools import lru_cache, partial
from itertools import chain
from typing import Any

import numpy as np
from flint import arb

from atlas.arithmetic.certified_digits import enclosed
from atlas.arithmetic.inputs import FloatArray
from atlas.arithmetic.numbers import workprec
from atlas.arithmetic.phase import MAX_PHASE
from atlas.errors import DomainError
from atlas.motions.elementary import certified as exact
from atlas.motions.elementary.kernel import ElementaryMotion

BITS = 110
"""Relative accuracy of the true matrices, which are kept in two words."""


def constants(I: Any, B2: Any, B3: Any, omega2: Any) -> tuple[Any, Any, Any, Any]:
    """Return (B2/b, B3/b, k, phi), where b = |B'|, k is (79) and phi (72), of floats or arrays, in plain floats.

    Cancellation is not avoided. I is the ratio I3/I2.
    """
    b = np.hypot(B2, B3)
    phi = B3 * omega2 * (1 - I) * (omega2 + 2 * B2) / (I * B2 * (omega2 + B2))
    return B2 / b, B3 / b, omega2 * b / B2, phi


def formula(constants: Sequence[Any], t: FloatArray, out: FloatArray | None = None) -> FloatArray:
    """Return R (..., 3, 3) by (84) in plain NumPy at times t (...), from `constants` (B2/b, B3/b, k, phi).

    The result is a new array, or `out` if given.
    """
    h2, h3, k, phi = constants
    c, s, C, S = np.cos(k * t), np.sin(k * t), np.cos(phi * t), np.sin(phi * t)
    R = np.empty((*t.shape, 3, 3)) if out is None else out
    m = h2**2 + h3**2 * c
    v = h2 * h3 * (1 - c)
    R[..., 0, 0] = c * C - h3 * s * S
    R[..., 0, 1] = -c * S - h3 * s * C
    R[..., 0, 2] = h2 * s
    R[..., 1, 0] = h3 * s * C + m * S
    R[..., 1, 1] = -h3 * s * S + m * C
    R[..., 1, 2] = v
    R[..., 2, 0] = -h2 * s * C + v * S
    R[..., 2, 1] = h2 * s * S + v * C
    R[..., 2, 2] = h3**2 + h2**2 * c
    return R


def error(motion: ElementaryMotion, p: Any) -> FloatArray:
    """Largest error in any entry of the atlas's R(t), an array (N,), at most 1; NaN for phases beyond 2^50.

    `motion` has N elements, `p` their parameters and times by name, arrays (N,).
    """
    rows, is_near = _rows(motion, p)
    ratio, B2, B3, omega2, t, *omega3 = rows
    return _against_balls(ElementaryMotion(ratio, (B2, B3), omega2, *omega3).rotation(t), rows, is_near)


def plain_error(motion: ElementaryMotion, p: Any) -> FloatArray:
    """Largest error in any entry of R(t) by `formula`, an array (N,), at most 1; NaN for phases beyond 2^50.

    The arguments are those of `error`. Raises DomainError for B2 = 0.
    """
    if np.any(p["B2"] == 0):
        raise DomainError("The error of the plain formula needs B2 different from zero: (71) and (72) divide by it.")
    rows, is_near = _rows(motion, p)
    return _against_balls(formula(constants(*rows[:4]), rows[4]), rows, is_near)


def _rows(motion: ElementaryMotion, p: Any) -> tuple[list[FloatArray], Any]:
    """Return the parameters, arrays (m,), of the rows with phases up to MAX_PHASE, and the mask (N,) of these rows."""
    is_near = np.maximum(abs(motion.k * p["t"]), abs(motion.phi * p["t"])) <= MAX_PHASE
    names = ("ratio", "B2", "B3", "omega2", "t", *(name for name in ("omega3",) if name in p))
    return [p[name][is_near] for name in names], is_near


def _against_balls(R: FloatArray, rows: list[FloatArray], is_near: Any) -> FloatArray:
    errors = np.full(is_near.shape, np.nan)
    high, low = _true(*(np.ascontiguousarray(x).tobytes() for x in rows))
    errors[is_near] = np.fmin(abs((R.reshape(-1, 9) - high) - low).max(axis=1), 1.0)
    return errors


@lru_cache(maxsize=1)
def _true(*parameters: bytes) -> FloatArray:
    """Return the exact R of rows as high and low part, (2, m, 9); the latest call is cached.

    Each argument holds the bytes of an array (m,): ratio, B2, B3, omega2, t and, where given, omega3.
    """
    words = []
    for ratio, B2, B3, omega2, t, *omega3 in zip(*(np.frombuffer(x).tolist() for x in parameters), strict=True):
        motion = exact.ElementaryMotion(ratio, (B2, B3), omega2, *omega3)
        with workprec(BITS + 16):
            balls = [*chain(*enclosed(partial(motion.rotation, t), BITS))]
            high = [float(x) for x in balls]
            words.append((high, [float(arb(x) - y) for x, y in zip(balls, high, strict=True)]))
    return np.array(words, dtype=float).reshape(-1, 2, 9).swapaxes(0, 1)
