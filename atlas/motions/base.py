"""What all motions share: one plan for one motion and for an array of them, which broadcasts with the times."""

import reprlib
from collections.abc import Callable, Mapping
from functools import partial
from importlib import import_module
from math import prod
from numbers import Integral
from typing import Any, Generic, Self, TypeVar
from weakref import proxy

import numpy as np

from atlas.arithmetic.dimensions import TIME, bare
from atlas.arithmetic.given import element
from atlas.arithmetic.grid import fill_grid
from atlas.arithmetic.inputs import FloatArray, common_shape, finite, number, real, whole
from atlas.arithmetic.rotation import DoubleRotation, target
from atlas.arithmetic.rotation_rows import DoubleRotationRows, Group
from atlas.display import Shown, made
from atlas.errors import AtlasError
from atlas.lazy import cached_property
from atlas.motions.frames import Placement
from atlas.viewers import notebook

OTHERS = {
    "omega2": "atlas.ElementaryMotion(ratio, field, omega2), the paper's family",
    "omega": "atlas.motion(inertia, field, omega), any start",
    "z": "atlas.EllipticMotion(inertia, field, z)",
    "attitude": "atlas.motion(inertia, field, omega, attitude)",
}
"""What takes an argument that a class of motions does not."""


Single = TypeVar("Single")
"""One motion made by itself: it has the functions of time of its class, which take times and an array to fill."""

Rotation = TypeVar("Rotation", bound=DoubleRotation)

MIN_SINGLE_TIMES = 1000
"""Times a motion from which on each of several motions is made by itself: that takes as long as so many matrices do."""

MOTION_CACHE_SIZE = 1024
"""Motions made by themselves that are kept."""

BLOCK = 4096
"""Matrices of several motions made at once."""


def check_column(j: Any) -> None:
    """Raise AtlasError for what is no column of R."""
    if not isinstance(j, Integral) or isinstance(j, bool) or j not in {1, 2, 3}:
        raise AtlasError(f"The columns of R are 1, 2 and 3, not {reprlib.repr(j)}.")


class Motion(Shown, Generic[Single]):
    """Motions R(t) of the shape of the parameters, which broadcasts with the times.

    One motion is evaluated by what `_single` makes of its inputs. So is each of an array of them at many times, and at
    few where there are no `_rows`, or where these do not hold a motion.
    """

    _rows: Any = None
    """All motions in arrays, for a few times each: `at(index, t)` gives what is evaluated as one motion is."""
    _placement: Placement | None = None
    """Where the motion stands, if not along the axes of its class with R(0) = 1."""

    def __new__(cls, *_: Any, **arguments: Any) -> Self:
        """Tell who gives a start that is another class's which one takes it."""
        code = cls.__init__.__code__
        known = code.co_varnames[1 : code.co_argcount + code.co_kwonlyargcount]
        for name in arguments.keys() - set(known) & OTHERS.keys():
            raise TypeError(f"{cls.__name__} takes {', '.join(known)}, not {name}, which is for {OTHERS[name]}.")
        return super().__new__(cls)

    def __init__(self, make: Callable[..., Single], *inputs: Any) -> None:
        self._make, self._inputs = make, inputs
        self._made: dict[int, Single] = {}
        self.shape = common_shape(*(getattr(x, "shape", ()) for x in inputs))

    def _single(self, i: int = 0) -> Single:
        """Return the i-th motion, made by itself."""
        single = self._made.get(i)
        if single is None:
            if len(self._made) >= MOTION_CACHE_SIZE:
                self._made.clear()
            single = self._made.setdefault(i, self._make(*self._row(i)))
        return single

    def _row(self, i: int = 0) -> list[Any]:
        """Return the inputs of the i-th motion: floats, rational numbers that no float holds, or None."""
        index = tuple(map(int, np.unravel_index(i, self.shape))) if self.shape else ()
        return [element(x, index) for x in self._inputs]

    def _of_each(self, value: Callable[[Single], Any]) -> Any:
        """Return a value of each motion made by itself: plain for one motion, else an array."""
        if not self.shape:
            return value(self._single())
        values = np.array([value(self._single(i)) for i in range(prod(self.shape))])
        return values.reshape(self.shape + values.shape[1:])

    def _place(self, placement: Placement, arguments: Mapping[str, Any], made_by: str) -> Self:
        """Put a motion that nobody has yet where it was asked for, by what made it; return the motion."""
        self._placement, self.made_by, self.arguments = placement, made_by, arguments
        return self

    @property
    def is_placed(self) -> bool:
        """Whether axes or an attitude were given, as for `atlas.motion` and `in_laboratory`."""
        return self._placement is not None

    @property
    def axes(self) -> FloatArray:
        """Axes of the class as rows, in those of the body that were given; shape (..., 3, 3)."""
        return np.eye(3) if self._placement is None else self._placement.sides[1]

    @property
    def given(self) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Inertia tensor, field in the laboratory, R(0) and Omega(0) of `atlas.motion`, as arrays in the given axes."""
        p = self._placement
        if p is None:
            raise AtlasError(f"A {type(self).__name__} by its class has its parameters, and R(0) = 1.")
        return p.tensor, p.field, p.attitude, p.omega

    @cached_property
    def own(self) -> Self:
        """The same motion along the axes of its class, with R(0) = 1."""
        if self._placement is None:
            return self
        own = type(self)(**self._placement.arguments)
        own._made = self._made  # noqa: SLF001  of this class
        return own

    def __reduce__(self) -> tuple[Any, ...]:
        """Let it be copied, and sent to another process, as the call that makes it."""
        return super().__reduce__() if self._placement is None else (made, (self._placement.make, dict(self.arguments)))

    def rotation(self, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Rotation matrix R(t), (84), (85), with the body's axes as columns; shape (..., 3, 3).

        `t` of any shape, finite; its phases k t, phi t up to 2^50. `out`, C-contiguous float64, is filled if given.
        Each entry is within 8.9e-16 of the true one, of a `GeneralMotion` within 1.8e-15, of a `TopMotion` or an
        `EllipticMotion` within 3.6e-15, of an `AsymmetricMotion` within its own `accuracy`. Raises AtlasError beyond.
        """
        R, p = self._evaluate(lambda single, t, out: single.rotation(t, out), t, (3, 3), out), self._placement
        return R if p is None else p.started(p.matrices(R), p.attitude, 2, t)

    def column(self, j: int, t: Any) -> FloatArray:
        """Column j = 1, 2, 3 of R(t): the body's axis R_j in the laboratory, shape (..., 3).

        Raises AtlasError for another j, and for times as `rotation` does.
        """
        check_column(j)
        p = self._placement
        if p is None:
            return self._evaluate(lambda single, t, out: single.column(j, t, out), t, (3,))
        return np.ascontiguousarray(self.rotation(t)[..., j - 1])

    def quaternion(self, t: Any, *, scalar_first: bool = False) -> FloatArray:
        """Quaternion (x, y, z, w) of R(t), of length 1, its Cayley-Klein parameters; shape (..., 4).

        It is continuous in t: after a whole turn it has changed its sign, and comes back after two. At t = 0 w >= 0.
        `scalar_first` gives (w, x, y, z). SciPy reads it by ``Rotation.from_quat(q)``. Bounds are those of
        `rotation`. Raises AtlasError for times as that does.
        """
        quaternions = self._evaluate(lambda single, t, out: single.quaternion(t, out), t, (4,))
        if self._placement is not None:
            quaternions = self._placement.quaternions(quaternions, t)
        return np.roll(quaternions, 1, axis=-1) if scalar_first else quaternions

    def angular_velocity(self, t: Any) -> FloatArray:
        """Angular velocity Omega(t) in the body; shape (..., 3)."""
        raise NotImplementedError

    def _spun(self, Omega: FloatArray, t: Any) -> FloatArray:
        """Return angular velocities along the axes of the class along those of the body, that at t = 0 as given."""
        p = self._placement
        return Omega if p is None else p.started(p.vectors(Omega), p.omega, 1, t)

    def _in_body(self, v: FloatArray) -> FloatArray:
        """Return vectors along the axes of the class along those of the body."""
        return v if self._placement is None else self._placement.vectors(v)

    def _along_class(self, v: FloatArray) -> FloatArray:
        """Return vectors along the axes of the body along those of the class."""
        return v if self._placement is None else self._placement.along_class(v)

    def _momentum_of(self, factors: Callable[[FloatArray], FloatArray], t: Any, name: str = "m") -> FloatArray:
        """Return R II Omega in the laboratory; `factors` gives II Omega along the axes of the class."""
        Omega, p = self.angular_velocity(t), self._placement
        momentum = factors(Omega) if p is None else np.matvec(p.tensor, Omega)
        return np.asarray(finite(np.matvec(self.rotation(t), momentum), name))

    def angular_velocity_in_laboratory(self, t: Any) -> FloatArray:
        """Angular velocity R Omega in the laboratory; shape (..., 3). Raises AtlasError as `angular_velocity` does."""
        return np.asarray(finite(np.matvec(self.rotation(t), self.angular_velocity(t)), "R Omega"))

    @classmethod
    def in_laboratory(
        cls, body: Any, field: Any, attitude: Any, angular_velocity: Any = None, **parameters: Any
    ) -> Self:
        """Motion of this class with R(0) = `attitude`, in a field of any direction, as `atlas.motion` gives it.

        `body` as there, (I2, I3) for a top; `field` (..., 3), of a top its direction n, and `angular_velocity` are in
        the laboratory; `parameters` are the coupling and the potential of a top, or in the place of the angular
        velocity the z and branch of an `EllipticMotion`, or the omega2 and omega3 of an `ElementaryMotion`, for which
        e2 is where the field is at the start. Raises DomainError where the motion is not of this class, decided
        exactly, AtlasError for what is no number.
        """
        chosen = import_module("atlas.motions.any_body")
        motion: Self = chosen.in_laboratory(cls, body, field, attitude, angular_velocity, parameters)
        return motion

    def third_axis(self, t: Any) -> FloatArray:
        """Third inertia axis R_3(t) in the laboratory, the third column of (84); shape (..., 3).

        Raises AtlasError for a time that is not finite or whose phases exceed 2^50.
        """
        return self.column(3, t)

    def sensitivity(self, t: Any, names: Any, of: str = "rotation") -> FloatArray:
        """Vector v in the laboratory with dR/dp = [v]x R, for each input p by its name; shape (..., names, 3).

        `names` are those of the class: "ratio", "B2", "omega1", ..., "t" for time. Where the field may be of any
        direction, as in `atlas.motion`, "B1" to "B3" are its components in the laboratory, "omega1" to "omega3" those
        of the angular velocity along the body's axes at t = 0, and "a1" to "a3" turn R(0) about the axes of the
        laboratory. `of="angular_velocity"` gives dOmega/dp and `of="field"` dK/dp, both in the body; the name
        of a scalar, such as "period", "precession_rate" or "k", its derivatives, of shape (..., names), whatever `t`.

        Errors stay below 1e-12 of 1 + |v| at any time: what grows is made of derivatives of frequencies. A border
        between kinds, such as a ball or a steady precession, is no exception; next to one, where terms would cancel,
        each time is made by itself, in some milliseconds. Of a body with three moments the constants of theta functions
        are differentiated, in some seconds; in a field below a thousandth of the angular velocity errors of derivatives
        in it grow, and above 1e-9 they are refused. Raises DomainError on a separatrix, from which neighbours depart
        for good, and for three moments where there are no theta functions or they change their form
        next to the motion; AtlasError for another name and for times as `rotation` does.
        """
        from atlas.motions.derivatives import of as derivatives

        return derivatives(self, t, names, of)

    def input_error(self, t: Any) -> FloatArray:
        """Bound on what rounding each input to a float can turn the body by until t, in radians, to first order.

        It is the sum over the inputs of half an ulp of each times the length of its vector of `sensitivity`; the inputs
        are those of `atlas.motion`, or of the class where the motion was made by that. Values of the motion itself are
        those of the floats that were given, and have no such error: it says how far numbers that no float holds, as
        0.1, are represented. It grows as t, on an unstable motion as an exponential of t. Raises AtlasError
        and DomainError as `sensitivity` does.

            >>> unstable = atlas.motion(0.7, (-0.765, 1.02, 0.192), (0.88, -1.1735, 0.2746))
            >>> bool(unstable.input_error(100.0) > 1e-12)
            True
        """
        from atlas.motions.derivatives import of_rounding

        return of_rounding(self, t)

    def spectrum(self, of: str = "rotation", least: float = 1e-6) -> Any:
        """Lines of a function of time, the sum over all lines of amplitude exp(i frequency t): a `Spectrum`.

        `of` is "rotation", R(t); "axis", the third column of it; "angular_velocity" or "field", Omega(t) and K(t) in
        the body. Lines whose amplitude, the root of the sum of its squares, is below `least` of the root of the mean
        square are left out. Frequencies are combinations with whole numbers of those of nutation, 2 pi/period, of
        precession and of spin, see `precession_rate` and `spin_rate`; of an `AsymmetricMotion`, of its `frequencies`.
        They are of closed form; amplitudes are integrals over the phases, right to rounding.

        Raises DomainError for a motion on a separatrix or that has no closed form, AtlasError for an array of motions.

            >>> lines = atlas.GeneralMotion(1.5, (1.0, 2.0), omega=(0.3, 0.7, 0.2)).spectrum("axis", least=0.1)
            >>> lines.names, lines.combinations.tolist()
            (('precession',), [[-1], [0], [1]])
        """
        from atlas.motions.spectrum import spectrum

        return spectrum(self, of, least)

    @property
    def actions(self) -> Any:
        """Actions of one motion, an `Actions`: `names`, `values`, `rates` and the `energy`, d energy = rates d values.

        That of precession is (M, n), the canonical momentum along the field, that of spin M3, that of an
        `AsymmetricMotion` for each of its `frequencies`; in the unit of inertia by that of time, over I2 where the body
        has a ratio. A slow change keeps them, see `atlas.drift`. They are integrals over the phases, right to rounding;
        `curve.actions` of an `AsymmetricMotion` has them in proven digits.
        Raises DomainError and AtlasError as `spectrum` does.

            >>> found = atlas.GeneralMotion(1.5, (1.0, 2.0), omega=(0.3, 0.7, 0.2)).actions
            >>> found.names, found.values.round(6)
            (('nutation', 'precession', 'spin'), array([0.038207, 3.711873, 3.3     ]))
        """
        from atlas.motions.actions import actions

        return actions(self)

    def animate(self, times: Any = None, *, fps: float = 20.0, style: Any = None) -> Any:
        """Return the motion at these times, or over one period, as an animation of Matplotlib's.

        It shows the body, its axis with the trace of that, and the field; `fps` are its frames a second, `style` is as
        for `atlas.figure`; ``.save("x.gif")`` writes it. Raises AtlasError for an array of motions, and for times as
        `rotation` does.
        """
        moments = None if times is None else real(times, "The time", TIME).ravel()
        return notebook("pictures").animate(self, moments, number(fps, "fps"), style)

    def trace(self, periods: float = 1.0, *, stop: float | None = None, tolerance: float = 1e-4) -> Any:
        """Curve that the third axis draws on the unit sphere: times (N,) and points R_3(t), (N, 3), of one motion.

        It is drawn over so many `periods`, or from t = 0 to the time `stop`; the points lie as near to each other as
        keeps all chords within `tolerance` of the curve. Raises AtlasError where there is no finite period, for several
        motions, and times as `rotation` does.
        """
        return notebook("frames").trace(self, periods, stop, tolerance)

    def rotation_grid(self, start: float, step: float, count: int, out: FloatArray | None = None) -> FloatArray:
        """Rotation matrices on the uniform grid start + i step, i = 0 .. count - 1, shape (..., count, 3, 3).

        Each is that of the exact real number start + i step, which need not be a double. For a motion in elementary
        functions it is faster than `rotation` from 10 000 times on, twice as fast from 100 000 on, and about as fast or
        a little slower below. Raises AtlasError for a count that is no whole number, an `out` of another shape, and
        times as `rotation` does.
        """
        start, step = number(start, "The start of the grid", TIME), number(step, "The step of the grid", TIME)
        count = whole(count, "The count of the grid")
        out = target(out, (*self.shape, count, 3, 3))
        for i, matrices in enumerate(out.reshape(prod(self.shape), count, 3, 3)):
            self._fill_grid(self._single(i), start, step, matrices)
        return out if self._placement is None else self._placement.matrices(out, between=1)

    def _fill_grid(self, single: Single, start: float, step: float, out: FloatArray) -> None:
        """Fill the matrices of one motion on a grid."""
        raise NotImplementedError

    def _evaluate(
        self, function: Callable[..., Any], t: Any, shape: tuple[int, ...], out: FloatArray | None = None
    ) -> FloatArray:
        """Return a function of motions and times, function(motion, t, out), for each motion at the times it meets."""
        t = t if type(t) is np.ndarray else bare(t, "The time", TIME)
        if not self.shape:
            return np.asarray(function(self._single(), t, out))
        times = real(t, "The time")
        full = common_shape(self.shape, times.shape)
        times, out = np.broadcast_to(times, full), target(out, full + shape)
        own = (1,) * (len(full) - len(self.shape)) + self.shape
        if times.size < MIN_SINGLE_TIMES * prod(self.shape) and self._rows is not None:
            self._evaluate_rows(function, times, own, out.reshape(times.size, *shape))
            return out
        for i, index in enumerate(np.ndindex(own)):
            where = tuple(slice(None) if n == 1 else i for i, n in zip(index, own, strict=True))
            out[where] = function(self._single(i), times[where], None)
        return out

    def _evaluate_rows(
        self, function: Callable[..., Any], times: FloatArray, own: tuple[int, ...], out: FloatArray
    ) -> None:
        """Write what motions of shape `own` have at times that they broadcast with into (m, ...), by blocks of rows."""
        indices = np.broadcast_to(np.arange(prod(own)).reshape(own), times.shape)
        for start in range(0, times.size, BLOCK):
            block = slice(start, start + BLOCK)
            t = np.asarray(times.flat[block])
            rows = self._rows.at(block if times.shape == own else indices.flat[block], t)
            with np.errstate(over="ignore", invalid="ignore"):  # in extreme rows, which are made by themselves
                function(rows, t, out[block])
            for i in np.unique(rows.indices[rows.extreme]).tolist():
                places = rows.extreme[rows.indices[rows.extreme] == i]
                out[start + places] = function(self._single(i), t[places], None)


class DoubleTurn(Motion[Rotation]):
    """Motions in elementary functions, R(t) = R_n(k t) R_z(phi t), (85)."""

    _frequencies: slice
    """Which of the inputs are frequencies."""
    _inverse = False
    """Whether the matrix is the transposed one, (28)."""
    _kind: str

    @property
    def kind(self) -> Any:
        """Name of the kind of motion, a string, or an array of them."""
        return np.full(self.shape, self._kind) if self.shape else self._kind

    @cached_property
    def _rows(self) -> DoubleRotationRows:
        """All motions in arrays, for a few times each."""
        # by a weak reference: in a circle of references, memory would wait for the collector of garbage
        vectors = partial(getattr, proxy(self), "_flat_vectors")
        return DoubleRotationRows(self._groups(), prod(self.shape), self._frequencies, vectors, inverse=self._inverse)

    @cached_property
    def _flat_vectors(self) -> Mapping[str, Any]:
        """Constant vectors of the motions in a row."""
        return {
            name: [np.broadcast_to(x, self.shape).reshape(-1) for x in vector]
            for name, vector in self._vectors().items()
        }

    def _groups(self) -> list[Group]:
        """Return the motions by the formulas that hold for them."""
        raise NotImplementedError

    def _vectors(self) -> Mapping[str, Any]:
        """Return constant vectors of the motions by name, three components each."""
        raise NotImplementedError

    def _fill_grid(self, single: Rotation, start: float, step: float, out: FloatArray) -> None:
        """Fill the matrices of one motion on a grid."""
        fill_grid(single, start, step, out)
