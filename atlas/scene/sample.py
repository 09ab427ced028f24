"""Curves sampled to a tolerance: as many points as the bends need, none for what is not seen."""

from collections.abc import Callable
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

FloatArray: TypeAlias = NDArray[np.float64]

_ROUNDS = 24
_INCH = 25.4


def quarter_pixel(extent: float, millimetres: float, dpi: float = 300.0) -> float:
    """Return a quarter of a pixel in the units of ``extent``, which is drawn ``millimetres`` wide."""
    return 0.25 * extent * _INCH / (millimetres * dpi)


def curve(
    function: Callable[[FloatArray], FloatArray],
    start: float,
    stop: float,
    tolerance: float,
    *,
    pieces: int = 8,
    box: tuple[FloatArray, FloatArray] | None = None,
) -> FloatArray:
    """Sample ``function`` from ``start`` to ``stop`` so that no chord is further than ``tolerance`` from the curve.

    ``function`` takes parameters (N,) and returns points (N, D); it is first cut into ``pieces`` equal parts, each of
    which is halved until two inner points of it (at 0.35 and 0.61 of its length, so that no symmetry deceives) lie on
    the chord. Parts that lie wholly on one outer side of ``box`` = (lowest, highest corner) are left as they are.
    """
    s = np.linspace(start, stop, pieces + 1)
    x = function(s)
    open_ = np.ones(pieces, dtype=bool)
    for _ in range(_ROUNDS):
        i = np.flatnonzero(open_)
        if i.size == 0:
            break
        a, b = s[i], s[i + 1]
        inner = [function(a + w * (b - a)) for w in (0.35, 0.61)]
        bent = np.zeros(i.size, dtype=bool)
        for y in inner:
            bent |= _distance(y, x[i], x[i + 1]) > tolerance
        if box is not None:
            corners = np.stack([x[i], *inner, x[i + 1]])
            out = np.all(corners < box[0], axis=0) | np.all(corners > box[1], axis=0)
            bent &= ~np.any(out, axis=1)
        open_[i] = bent
        cut = i[bent]
        middle = 0.5 * (s[cut] + s[cut + 1])
        s = np.insert(s, cut + 1, middle)
        x = np.insert(x, cut + 1, function(middle), axis=0)
        open_ = np.insert(open_, cut + 1, True)
    return x


def _distance(y: FloatArray, a: FloatArray, b: FloatArray) -> FloatArray:
    """Distance of the points ``y`` from the segments ``a b``, row by row."""
    chord = b - a
    length = np.einsum("ij,ij->i", chord, chord)
    along = np.einsum("ij,ij->i", y - a, chord) / np.where(length > 0.0, length, 1.0)
    nearest = a + np.clip(along, 0.0, 1.0)[:, None] * chord
    distance: FloatArray = np.linalg.norm(y - nearest, axis=1)
    return distance
