"""What a tolerance costs: points drawn against the error of the drawn curve, beside points at equal steps.

`measure` samples a few curves of the atlas as the recipes do, to each of `TOLERANCES`, and measures how far each curve
leaves its chords, in final pixels at 300 dots an inch; the figure curve_points draws the stored record.
`python -m atlas.study.curves` renews it.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import msgspec
import numpy as np

from atlas import files
from atlas.core.elementary import ElementaryMotion
from atlas.core.hyperbola import Hyperbola
from atlas.core.inputs import FloatArray
from atlas.core.particle import ParticleMotion
from atlas.core.quadric import Quadric
from atlas.errors import AtlasError
from atlas.places import folder
from atlas.scene import Space, conics, quadric_panel, sample
from atlas.scene.camera import frame

TOLERANCES = (2.0, 1.0, 0.5, 0.25, 0.125, 0.0625)
RATIO, FIELD, OMEGA2 = 1.5, (1.0, 2.0), 0.7
_PIXELS = 300.0 / 25.4
_INNER = 64
MOST_POINTS = 1 << 22
"""Points at equal steps after which the search for a number that is enough ends."""


@dataclass(frozen=True)
class PixelCurve:
    """A curve in final pixels, ``point`` (N,) -> (N, D), from ``start`` to ``stop``, and how a recipe first cuts it.

    Equal steps are those that one would take without thought: of the parameter, or of its exponential.
    """

    name: str
    point: Callable[[FloatArray], FloatArray]
    start: float
    stop: float
    pieces: int
    logarithmic: bool = False

    def knots(self, tolerance: float) -> FloatArray:
        """Return the parameters at which it is drawn to a tolerance in pixels."""
        return sample.knots(self.point, self.start, self.stop, tolerance, self.pieces)

    def even(self, count: int) -> FloatArray:
        """Return the parameters of ``count`` points at equal steps."""
        if self.logarithmic:
            return np.log(np.linspace(np.exp(self.start), np.exp(self.stop), count))
        return np.linspace(self.start, self.stop, count)

    def error(self, s: FloatArray) -> float:
        """Return how far the curve leaves its own chords, which join the points at the parameters ``s``, in pixels."""
        inner = s[:-1] + (np.arange(1, _INNER) / _INNER)[:, None] * np.diff(s)
        y = self.point(inner.ravel()).reshape(*inner.shape, -1)
        x = self.point(s)
        chord = np.diff(x, axis=0)
        length = np.sum(chord * chord, axis=-1)
        along = np.clip(np.sum((y - x[:-1]) * chord, axis=-1) / np.where(length > 0.0, length, 1.0), 0.0, 1.0)
        return float(np.linalg.norm(y - x[:-1] - along[..., None] * chord, axis=-1).max())


class Row(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A tolerance with the points it took and the error they leave, both in pixels, and equal steps beside.

    ``even_error`` is that of as many points at equal steps, ``even_points`` how many of these leave no more than
    ``error``.
    """

    tolerance: float
    points: int
    error: float
    even_error: float
    even_points: int


class CurveErrors(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The rows of each curve by its name."""

    format: int
    curves: dict[str, list[Row]]


def curves() -> Iterator[PixelCurve]:
    """Yield a branch of the hyperbola mf72, a trace of mf89, a trochoid mf10.1, and an outline of the quadric mf58."""
    (B2, B3), reach = FIELD, 2.6
    hyperbola, rise = Hyperbola(RATIO, FIELD), reach * RATIO
    near = (rise - float(np.sqrt(rise * rise - 4.0 * (RATIO - 1.0)))) / 2.0  # x + (I - 1)/x = I reach: at the edge
    window = _PIXELS * np.array([76.0, 72.0]) / (2.0 * reach * np.array([B2, B3]))

    def branch(s: FloatArray) -> FloatArray:
        omega2 = B2 * (np.exp(s) - 1.0)
        return np.stack([omega2, hyperbola.omega3(omega2)], axis=1) * window

    yield PixelCurve("branch of the hyperbola", branch, float(np.log(near)), float(np.log(reach)), 16, logarithmic=True)

    motion = ElementaryMotion(RATIO, FIELD, OMEGA2)
    radius = 38.0 * _PIXELS
    period = 2.0 * np.pi / abs(motion.k)
    yield PixelCurve("trace of the third axis", lambda t: radius * motion.third_axis(t), 0.0, period, 8)

    particle = ParticleMotion.trochoid(1.0, (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), 1.0)
    turns, plane = 3.0, particle.axes[:2].T
    size = 75.0 * _PIXELS / (1.1 * turns * particle.period * float(np.linalg.norm(particle.drift)))
    stop = turns * particle.period
    yield PixelCurve("trochoid", lambda t: size * (particle.position(t) @ plane), 0.0, stop, round(8 * turns))

    yield outline()


def outline() -> PixelCurve:
    """Return the silhouette of the bowl of figure hyp_a: where grad F . d = 0 it is a plane section of the quadric."""
    field = (1.0, 1.0)
    (bowl,) = quadric_panel.sheets(RATIO, Quadric(RATIO, field), field, "origin")
    towards = frame(Space((), azimuth=25.0, elevation=14.0))[2]
    corners = bowl.grids[0].reshape(-1, 3)
    ball = corners.mean(axis=0), float(np.ptp(corners, axis=0).max())
    Q = bowl.quadric
    ((point, start, stop),) = conics.arcs(Q, Q[:3, :3] @ towards, -float(Q[:3, 3] @ towards), bowl.clip, ball)
    scale = 33.0 * _PIXELS
    return PixelCurve("outline of a quadric", lambda s: scale * point(s), start, stop, 8)


def measure() -> CurveErrors:
    """Measure all curves at all tolerances."""
    return CurveErrors(1, {drawn.name: [row(drawn, tolerance) for tolerance in TOLERANCES] for drawn in curves()})


def row(drawn: PixelCurve, tolerance: float) -> Row:
    """Measure one curve at one tolerance."""
    s = drawn.knots(tolerance)
    error = drawn.error(s)
    return Row(tolerance, len(s), _short(error), _short(drawn.error(drawn.even(len(s)))), even_points(drawn, error))


def even_points(drawn: PixelCurve, error: float) -> int:
    """Return the least number of points at equal steps that leave no more than this error, by bisection."""
    low, high = 1, 2
    while drawn.error(drawn.even(high)) > error:
        if high > MOST_POINTS:
            raise AtlasError(f"More than {MOST_POINTS} points at equal steps leave an error above {error:g}.")
        low, high = high, 2 * high
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if drawn.error(drawn.even(middle)) > error else (low, middle)
    return high


def _short(value: float) -> float:
    """Return four digits: more would differ between processors."""
    return float(f"{value:.4g}")


def stored() -> Path:
    """Return where the record of the repository lies."""
    return folder("reports") / "data" / "curves.json"


def read() -> CurveErrors:
    """Read the stored record."""
    path = stored()
    try:
        return msgspec.json.decode(path.read_bytes(), type=CurveErrors)
    except FileNotFoundError as error:
        raise AtlasError(f"There is no record {path.name}: run python -m atlas.study.curves first.") from error
    except msgspec.MsgspecError as error:
        raise AtlasError(f"{path.name} is not a record of drawn curves: {error}.") from error


def write(record: CurveErrors, path: Path) -> None:
    """Write a record, whole or not at all."""
    files.write(path, msgspec.json.format(msgspec.json.encode(record), indent=1) + b"\n")


if __name__ == "__main__":
    write(measure(), stored())
