"""The hyperbola (67) in the plane (omega2, omega3): the window it is shown in, and its branches there."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from atlas.arithmetic.inputs import FloatArray, number
from atlas.arithmetic.inputs import components as parts
from atlas.bodies.integrals import shape_factors
from atlas.errors import DomainError
from atlas.motions.elementary.kernel_hyperbola import Hyperbola
from atlas.pictures.layers import Label, Layer, Plane, Points
from atlas.pictures.sample import flat

NAMES = ("B2", "B3")


@dataclass(frozen=True)
class Window:
    """A rectangle of the plane (omega2, omega3), in 1/time, by its limits (lowest, highest) along x and y."""

    x: tuple[float, float]
    y: tuple[float, float]

    @property
    def half(self) -> tuple[float, float]:
        """Half the width and half the height of the window, in the unit of its limits."""
        return (self.x[1] - self.x[0]) / 2, (self.y[1] - self.y[0]) / 2

    @property
    def box(self) -> tuple[FloatArray, FloatArray]:
        """Corners (least x, least y) and (largest x, largest y), two arrays (2,)."""
        return np.array([self.x[0], self.y[0]]), np.array([self.x[1], self.y[1]])

    def upright(self, omega2: float) -> FloatArray:
        """Return the end points of the vertical line at omega2 across the window, the lower one first.

        They are rows (omega2, omega3) of an array (2, 2); omega2 may lie outside the window.
        """
        return np.array([[omega2, self.y[0]], [omega2, self.y[1]]])

    def level(self, height: float) -> FloatArray:
        """Return the end points of the horizontal line at omega3 = `height` across the window, the left one first.

        They are rows (omega2, omega3) of an array (2, 2); the height may lie outside the window.
        """
        return np.array([[self.x[0], height], [self.x[1], height]])

    def band(self, start: float, stop: float) -> FloatArray:
        """Return the corners (4, 2) of the upright band across the window between two values of omega2."""
        return np.vstack([self.upright(start), self.upright(stop)[::-1]])

    def panel(self, layers: Iterable[Layer], unit: str, **options: Any) -> Plane:
        """Return the `Plane` of (omega2, omega3) with these layers and the window's limits.

        The axes are in 1 over ``unit``, the word for the unit of time; `options` are further arguments of `Plane`.
        """
        return Plane(tuple(layers), rf"$\omega_2$ (1/{unit})", rf"$\omega_3$ (1/{unit})", self.x, self.y, **options)


def components(field: Any) -> tuple[float, float]:
    """Return (B2, B3) of B', in 1/time, from a `Field` or a pair. Raises DomainError if both vanish."""
    B2, B3 = map(number, parts(field, NAMES, "The field"), NAMES)
    if B2 == 0 and B3 == 0:
        raise DomainError(
            "Without a field every omega starts a free motion, and there is no hyperbola: give a field other than 0."
        )
    return B2, B3


def window(field: Any, reach: float = 2.6, *, square: bool = False) -> Window:
    """Return the `Window` about -B' that reaches ``reach`` times each component of the field from this centre.

    ``field`` is a `Field` or (B2, B3). For a component that is zero the larger one is taken; if ``square``, the
    larger one in both directions. Raises DomainError without a field.
    """
    B2, B3 = components(field)
    largest = max(abs(B2), abs(B3))
    half = (reach * largest,) * 2 if square else (reach * (abs(B2) or largest), reach * (abs(B3) or largest))
    return Window((-B2 - half[0], -B2 + half[0]), (-B3 - half[1], -B3 + half[1]))


def branches(ratio: Any, field: Any, view: Window, millimetres: tuple[float, float]) -> tuple[FloatArray, ...]:
    """Return the pieces (N, 2) of the curve (67) in the window `view`, as (omega2, omega3), a tuple.

    `ratio` is I3/I2 or a body, `field` a `Field` or (B2, B3), `millimetres` are (width, height) of the panel on
    paper. With x = (omega2 + B2)/B2 each branch (71) is sampled in log |x| from the edge of the window to the pole.
    For B2 = 0 the only piece is the line omega2 = 0; for I = 1 or B3 = 0 the pieces are a sloping or level line and
    the pole omega2 = -B2. Raises DomainError without a field.
    """
    B2, B3 = components(field)
    I, one_less, _ = shape_factors(ratio)
    pole = view.upright(-B2)
    if B2 == 0:
        return (pole,)
    if B3 == 0 or one_less == 0:
        return view.level(0.0) * [1.0, 0.0] + np.outer(view.x, [0.0, B3 / B2]), pole
    reach, rise = view.half[0] / abs(B2), view.half[1] * I / abs(B3)
    hyperbola = Hyperbola(ratio, field)

    def ordinate(x: FloatArray) -> FloatArray:
        omega2 = B2 * (x - 1)
        neighbour = np.nextafter(-B2, np.copysign(np.inf, B2 * x))  # x may be too small for a float omega2 to tell
        return np.asarray(hyperbola.omega3(np.where(omega2 == -B2, neighbour, omega2)))

    return graph(ordinate, B2, view, abs(one_less) / (rise + reach), millimetres)


def graph(
    function: Callable[[FloatArray], Any], B2: float, view: Window, inner: float, millimetres: tuple[float, float]
) -> tuple[FloatArray, ...]:
    """Return the pieces (N, 2), in the window `view`, of a graph over omega2 with a pole at -B2, a tuple.

    ``function`` maps x = (omega2 + B2)/B2 (N,) to ordinates (N,). It is sampled in log |x| from |x| = ``inner``,
    where the graph has left the window near the pole. ``millimetres`` are (width, height) of the panel on paper.
    """
    outer = max(abs(edge + B2) for edge in view.x) / abs(B2)
    inner = min(inner, outer / 2)
    pieces = []
    for side in (1.0, -1.0):

        def points(s: FloatArray, side: float = side) -> FloatArray:
            x = side * np.exp(s)
            return np.stack([B2 * (x - 1), function(x)], axis=1)

        curve = flat(points, float(np.log(inner)), float(np.log(outer)), (view.x, view.y), millimetres, pieces=16)
        pieces.append(curve[visible_mask(curve, view)])
    return tuple(piece for piece in pieces if len(piece))


def visible_mask(points: FloatArray, view: Window) -> NDArray[np.bool_]:
    """Return a mask (N,) of the points (N, 2) of a polyline in the window `view`, or adjacent to a point in it."""
    low, high = view.box
    inside = np.asarray(((points >= low) & (points <= high)).all(axis=1))
    chosen = inside.copy()
    chosen[1:] |= inside[:-1]
    chosen[:-1] |= inside[1:]
    return chosen


def unstable(ratio: Any, field: Any) -> tuple[tuple[float, float], ...]:
    """Return the intervals (low, high) of omega2, in rad/time, of unstable elementary motions: none, one or two.

    ``ratio`` is I3/I2 or a body, ``field`` a `Field` or (B2, B3). For B2 = 0 the tuple is empty.
    """
    B2, _ = components(field)
    band = Hyperbola(ratio, field).unstable_band if B2 else None
    if band is None:
        return ()
    inner, outer = (float(np.sqrt(y)) for y in band)
    if inner == 0:
        return ((-B2 - abs(B2) * outer, -B2 + abs(B2) * outer),)
    return tuple(
        (min(ends), max(ends)) for ends in ((B2 * (side * inner - 1), B2 * (side * outer - 1)) for side in (-1, 1))
    )


def asymptote(ratio: Any, field: Any, view: Window) -> FloatArray:
    """Return two points (2, 2), (omega2, omega3) each, of the asymptote through -B' along I^-1 B'.

    ``ratio`` is I3/I2 or a body, ``field`` a `Field` or (B2, B3). The points lie at the border of the window ``view``.
    """
    I, _, _ = shape_factors(ratio)
    B2, B3 = components(field)
    direction = np.array([I * B2, B3])
    with np.errstate(divide="ignore"):
        reach = float(np.min(np.array(view.half) / np.abs(direction)))
    return np.array([-B2, -B3]) + np.outer([-reach, reach], direction)


@dataclass(frozen=True)
class Place:
    """A named point of the hyperbola: name in a figure (TeX), name in a sentence, (omega2, omega3) in 1/time, role."""

    text: str
    words: str
    point: tuple[float, float]
    role: str


def places(ratio: Any, field: Any) -> tuple[Place, ...]:
    """Return two or three named points of the hyperbola (67): rest, -2 B', and the second point with omega3 = 0.

    ``ratio`` is I3/I2 or a body, ``field`` a `Field` or (B2, B3). The third, omega2 = -(2-I) B2, is left out for I
    = 2, where it is the state of rest, for I = 1, where it is the pole, and for B2 = 0 or B3 = 0.
    """
    B2, B3 = components(field)
    special = Hyperbola(ratio, field).special
    labels = [
        Place("rest", "the state of rest at 0", special["omega2 = 0"], "rest"),
        Place(r"$-2\mathbf{B}'$", "the point \N{MINUS SIGN}2B'", special["omega2 = -2 B2"], "special"),
    ]
    zero = special["omega2 = -(2-I) B2"]
    if B2 and B3 and zero[0] not in {0.0, -B2}:
        labels.append(Place(r"$\omega_3=0$", "the second point with omega 3 = 0", zero, "point"))
    return tuple(labels)


def marked(named: Sequence[Place], field: Any) -> list[Layer]:
    """Return layers: points at the centre -B' and at the `named` places, and labels of the centre and three places.

    ``field`` is a `Field` or (B2, B3).
    """
    centre, (s2, s3) = -np.array(components(field)), np.copysign(1.0, field)
    return [
        Points(centre[None], "centre"),
        *(Points(np.array([place.point]), place.role) for place in named),
        Label(centre, r"$-\mathbf{B}'$", "centre", (5 * s2, -5 * s3)),
        *(
            Label(np.array(place.point), place.text, place.role, (x * s2, y * s3))
            for place, (x, y) in zip(named, ((5, -5), (-5, 4), (5, 6)), strict=False)
        ),
    ]
