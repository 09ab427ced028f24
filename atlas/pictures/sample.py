"""Curves sampled and surfaces cut into faces to a tolerance: more points at bends, none outside the view."""

from collections.abc import Callable, Collection, Iterable

import numpy as np

from atlas.errors import DomainError
from atlas.pictures.layers import FloatArray

_ROUNDS = 40
MAX_POINTS = 1_000_000
"""Largest number of points of a curve."""
_INCH, _DPI = 25.4, 300.0
_LOOKS = np.array([0.2, 0.45, 0.75])[:, None]
"""Fractions of a piece at which its distance from the chord is measured: one of them shows 93 % of a simple bend's."""
_LEAVE, _AIM = 0.9, 0.8
"""Fraction of the tolerance below which a piece is not divided, and at which a division aims."""
_ARC, _EVEN, _FEW = 0.2, 1.5, 3
"""Limits for dividing a piece at once: distance over chord, spread of bends; else the largest number of cuts."""


def quarter_pixel(extent: float, millimetres: float) -> float:
    """Return the length of a quarter of a pixel, in the unit of ``extent``, a length drawn ``millimetres`` wide."""
    return 0.25 * extent * _INCH / (millimetres * _DPI)


def curve(
    function: Callable[[FloatArray], FloatArray],
    start: float,
    stop: float,
    tolerance: float,
    *,
    pieces: int = 8,
    box: tuple[FloatArray, FloatArray] | None = None,
    scale: FloatArray | float = 1.0,
) -> FloatArray:
    """Return points (N, D) of ``function`` from ``start`` to ``stop``, with chords within ``tolerance`` of the curve.

    ``function`` takes parameters (N,) and returns points (N, D). Its range is first cut into ``pieces`` equal parts,
    each of which is cut again until three inner points, placed without symmetry, lie on the chord. Parts that lie
    wholly on one outer side of ``box`` = (lowest, highest corner) are not cut. Distances are those of the points times
    ``scale`` (D,). Raises DomainError for more than a million points and for points that are not finite.
    """
    return _cut(function, start, stop, tolerance, pieces, box, scale)[1]


def room(values: Collection[float], share: float) -> tuple[float, float]:
    """Return limits (low, high) that hold all values, with the fraction ``share`` of their extent free on each side."""
    low, high = min(values), max(values)
    margin = share * (high - low)
    return float(low - margin), float(high + margin)


def flat(
    function: Callable[[FloatArray], FloatArray],
    start: float,
    stop: float,
    limits: tuple[tuple[float, float], tuple[float, float]],
    millimetres: tuple[float, float],
    *,
    pieces: int = 8,
) -> FloatArray:
    """Return points (N, 2) of a curve in a panel with the ``limits`` of x and y, sampled to a quarter of a pixel.

    Outside the limits the curve is not refined. ``millimetres`` are the panel's width and height on paper. Raises
    DomainError as `curve` does.
    """
    low, high = np.array(limits).T
    scale = np.array(millimetres) / (high - low)
    return curve(function, start, stop, quarter_pixel(1.0, 1.0), pieces=pieces, box=(low, high), scale=scale)


def knots(
    function: Callable[[FloatArray], FloatArray], start: float, stop: float, tolerance: float, pieces: int = 8
) -> FloatArray:
    """Return the parameter values (N,) at which `curve` places its points on `function`; arguments as there."""
    return _cut(function, start, stop, tolerance, pieces, None, 1.0)[0]


def _cut(
    function: Callable[[FloatArray], FloatArray],
    start: float,
    stop: float,
    tolerance: float,
    pieces: int,
    box: tuple[FloatArray, FloatArray] | None,
    scale: FloatArray | float,
) -> tuple[FloatArray, FloatArray]:
    """Return parameters (N,) and points (N, D) of a curve divided adaptively; the arguments are those of `curve`."""
    if pieces > MAX_POINTS:
        raise DomainError(
            f"A curve over that many turns needs more than {MAX_POINTS} points: ask for a shorter part of it."
        )
    s = np.linspace(start, stop, pieces + 1)
    x = function(s)
    open_ = np.ones(pieces, dtype=bool)
    for _ in range(_ROUNDS):
        i = np.flatnonzero(open_)
        if i.size == 0:
            break
        inner = function((s[i] + _LOOKS * (s[i + 1] - s[i])).ravel()).reshape(len(_LOOKS), i.size, -1)
        a, b = x[i] * scale, x[i + 1] * scale
        sags = np.stack([_distance(y * scale, a, b) for y in inner])
        sag, bend = sags.max(axis=0), sags / (_LOOKS * (1.0 - _LOOKS))
        plain = bend.max(axis=0) < _EVEN * bend.min(axis=0)
        plain &= sag < _ARC * np.linalg.norm(b - a, axis=1)
        in_view = np.ones(i.size, dtype=bool)
        if box is not None:
            corners = np.concatenate([x[None, i], inner, x[None, i + 1]])
            out = np.all(corners < box[0], axis=0) | np.all(corners > box[1], axis=0)
            in_view = ~np.any(out, axis=1)
        curved = in_view & ~(sag <= _LEAVE * tolerance)
        aims = np.ceil(np.sqrt(sag / (_AIM * tolerance)))
        if (
            not aims[curved & plain].sum() + _FEW * curved.sum() + len(s) < MAX_POINTS
            or not np.isfinite(sag[in_view]).all()
        ):
            raise DomainError(
                f"A curve needs more than {MAX_POINTS} points to be drawn to {tolerance:g}: its extent or "
                "its number of turns is too large for the view; choose less extreme parameters."
            )
        piece_counts = np.ones(len(open_), dtype=int)
        piece_counts[i[curved]] = np.maximum(np.where(plain, aims, np.minimum(aims, _FEW))[curved], 2)
        owner = np.repeat(np.arange(len(piece_counts)), piece_counts)
        number = np.arange(len(owner)) - np.repeat(np.cumsum(piece_counts) - piece_counts, piece_counts)
        fresh = np.flatnonzero(number)
        places = s[owner] + number / piece_counts[owner] * (s[owner + 1] - s[owner])
        points = np.concatenate([x[owner], x[-1:]])
        if fresh.size:
            points[fresh] = function(places[fresh])
        s, x, open_ = np.append(places, s[-1]), points, piece_counts[owner] > 1
    return s, x


def _distance(y: FloatArray, a: FloatArray, b: FloatArray) -> FloatArray:
    """Distances (N,) of the points ``y`` (N, D) from the segments from ``a`` to ``b`` (N, D), row by row."""
    chord = b - a
    length = np.einsum("ij,ij->i", chord, chord)
    shares = np.einsum("ij,ij->i", y - a, chord) / np.where(length > 0.0, length, 1.0)
    nearest = a + np.clip(shares, 0.0, 1.0)[:, None] * chord
    distance: FloatArray = np.linalg.norm(y - nearest, axis=1)
    return distance


SHADE = 1.0 / 512.0
"""Half of one of 256 shades: the largest error of the light between two corners of a face."""


def cuts(
    quadric: FloatArray,
    lines: Iterable[Callable[[FloatArray], FloatArray]],
    start: float,
    stop: float,
    tolerance: float,
) -> FloatArray:
    """Return parameters (N,), common to several ``lines`` on a quadric, at which the quadric's mesh is divided.

    ``quadric`` is its matrix (4, 4); a line maps parameters (N,), from ``start`` to ``stop``, to points (N, 3).
    Between two neighbours no chord of the lines is further than ``tolerance`` from the quadric, and the unit normal
    is linear up to `SHADE`, so that the shade of a face is right to its last bit.
    """

    def of_line(line: Callable[[FloatArray], FloatArray]) -> Callable[[FloatArray], FloatArray]:
        def point_and_normal(s: FloatArray) -> FloatArray:
            x = line(s)
            return np.concatenate([x / tolerance, normals(quadric, x) / SHADE], axis=1)

        return point_and_normal

    return np.unique(np.concatenate([knots(of_line(line), start, stop, 1.0) for line in lines]))


def normals(quadric: FloatArray, points: FloatArray) -> FloatArray:
    """Return the unit normals (..., 3) of a quadric, matrix (4, 4), at points (..., 3), to its outer side.

    The form of the quadric grows to that side. Normals are zero in the apex of a cone, where there is none.
    """
    gradient = points @ quadric[:3, :3] + quadric[:3, 3]
    length = np.linalg.norm(gradient, axis=-1, keepdims=True)
    return np.asarray(gradient / np.where(length > 0.0, length, 1.0))
