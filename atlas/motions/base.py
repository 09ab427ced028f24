"""Base of all classes of motions: one interface for one motion and for an array, which broadcasts with the times."""

import reprlib
import warnings
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from math import prod
from numbers import Integral
from typing import TYPE_CHECKING, Any, Generic, Literal, Self, TypeVar
from weakref import proxy

import numpy as np
from numpy.typing import NDArray

from atlas.arithmetic.annotations import AttitudeLike, BodyLike, FieldLike, NameOrArray, RealArrayLike, StyleLike
from atlas.arithmetic.dimensions import TIME, bare
from atlas.arithmetic.given import element
from atlas.arithmetic.grid import fill_grid
from atlas.arithmetic.inputs import FloatArray, common_shape, finite, integer, number, real
from atlas.arithmetic.lazy import cached_property
from atlas.arithmetic.numbers import nearest
from atlas.arithmetic.rotation import DoubleRotation, target
from atlas.arithmetic.rotation_rows import DoubleRotationRows, Group
from atlas.bodies.display import Shown, made
from atlas.errors import AtlasError
from atlas.motions.actions import Actions, actions
from atlas.motions.frames import Placement
from atlas.motions.spectrum import Spectrum, SpectrumOf, Wheels, function_of, spectrum
from atlas.viewers import notebook

if TYPE_CHECKING:
    from matplotlib.animation import FuncAnimation

OTHERS = {
    "omega2": "atlas.ElementaryMotion(ratio, field, omega2), the paper's family",
    "omega": "atlas.motion(inertia, field, omega), any start",
    "z": "atlas.EllipticMotion(inertia, field, z)",
    "attitude": "atlas.motion(inertia, field, omega, attitude)",
}
"""Classes and functions that take an argument which another class refuses, by the name of the argument."""


Value = TypeVar("Value")

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
    """Raise AtlasError unless j is 1, 2 or 3, the number of a column of R."""
    if not isinstance(j, Integral) or isinstance(j, bool) or j not in {1, 2, 3}:
        raise AtlasError(f"The columns of R are 1, 2 and 3, not {reprlib.repr(j)}.")


class Motion(Shown, Generic[Single]):
    """One motion R(t), or an array of motions; the `shape` of the array broadcasts with the times.

    ``make`` takes the inputs of one motion and returns its evaluator, whose `rotation`, `column`, `quaternion` and
    `angular_velocity` take times and an array to fill; ``inputs`` are the inputs of all motions, which broadcast. Each
    motion of an array at many times is evaluated by its own evaluator, see `_single`. At few times per motion the array
    `_rows` serves all motions at once, where the class has one; motions beyond its range are evaluated singly.
    """

    _rows: Any = None
    """All motions in arrays, for a few times each: `at(index, t)` returns an object with the methods of one motion."""
    _min_array_motions = 1
    """Number of motions from which `_rows` are faster than motion by motion."""
    _placement: Placement | None = None
    """Where the motion stands, if not along the axes of its class with R(0) = 1."""
    _is_exact_at_zero = True
    """Whether formulas of the class have R(0) = 1 and Omega(0) without rounding."""

    def __new__(cls, *inputs: Any, **arguments: Any) -> Self:
        """Return a new motion, which ``inputs`` and ``arguments`` are to initialize.

        Raises TypeError for a keyword of `OTHERS` that this class does not take; the message names the class or
        function that does.
        """
        code = cls.__init__.__code__
        parameters = code.co_varnames[1 : code.co_argcount + code.co_kwonlyargcount]
        for name in arguments.keys() - set(parameters) & OTHERS.keys():
            raise TypeError(f"{cls.__name__} takes {', '.join(parameters)}, not {name}, which is for {OTHERS[name]}.")
        return super().__new__(cls, *inputs, **arguments)

    def __init__(self, make: Callable[..., Single], *inputs: Any) -> None:
        shape = common_shape(*(getattr(x, "shape", ()) for x in inputs))
        singles: dict[int, Single] = {}
        self._make, self._inputs, self._singles, self.shape = make, inputs, singles, shape

    def _single(self, i: int = 0) -> Single:
        """Return the evaluator of the i-th motion alone, cached; the index i counts the flattened array."""
        single = self._singles.get(i)
        if single is None:
            if len(self._singles) >= MOTION_CACHE_SIZE:
                self._singles.clear()
            single = self._singles.setdefault(i, self._make(*self._row(i)))
        return single

    def _row(self, i: int = 0) -> list[Any]:
        """Return the inputs of the i-th motion, a list: floats, rationals (`fmpq`) that no float holds, or None.

        The index i counts the flattened array.
        """
        index = tuple(map(int, np.unravel_index(i, self.shape))) if self.shape else ()
        return [element(x, index) for x in self._inputs]

    def _of_each(self, value: Callable[[Single], Value]) -> Value | NDArray[Any]:
        """Return value(evaluator) of each motion: plain for one motion, else an array of shape (*shape, ...)."""
        if not self.shape:
            return value(self._single())
        values = np.array([value(self._single(i)) for i in range(prod(self.shape))])
        return values.reshape(self.shape + values.shape[1:])

    def _place(self, placement: Placement, arguments: Mapping[str, Any], made_by: str) -> Self:
        """Store where a new motion stands and the call that makes it, in place, and return the motion.

        ``placement`` is its `Placement`, ``arguments`` are those of the call by name, and ``made_by`` is the call's
        name.
        """
        self._placement, self.made_by, self.arguments = placement, made_by, arguments
        return self

    @property
    def is_placed(self) -> bool:
        """True if axes or an attitude were given, as for `atlas.motion` and `in_laboratory`."""
        return self._placement is not None

    @property
    def axes(self) -> FloatArray:
        """Axes of the class as rows, unit vectors along the body axes that were given; shape (..., 3, 3)."""
        return self._sides[1]

    @property
    def _sides(self) -> tuple[FloatArray, FloatArray]:
        """Constant rotations (L, C), (..., 3, 3) each, with R(t) = L R_class(t) C; unit matrices if not placed."""
        return (np.eye(3), np.eye(3)) if self._placement is None else self._placement.sides

    @property
    def given(self) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Inputs of `atlas.motion` as a tuple of four arrays: inertia tensor, field B', R(0) and Omega(0).

        `atlas.motion` takes the last two in the other order, omega before attitude. Tensor (..., 3, 3) and Omega(0)
        (..., 3), in rad/time, are along the body's given axes, the field (..., 3), in 1/time, along those of the
        laboratory; R(0) is (..., 3, 3). Raises AtlasError for a motion made by its class alone.
        """
        p = self._placement
        if p is None:
            raise AtlasError(f"A {type(self).__name__} by its class has its parameters, and R(0) = 1.")
        return p.tensor, p.field, p.attitude, p.omega

    @property
    def own(self) -> Self:
        """The same motion along the axes of its class, with R(0) = 1; the motion itself if no axes were given."""
        return self._unplaced or self  # a motion that kept itself would be garbage

    @cached_property
    def _unplaced(self) -> Self | None:
        """Motion along the axes of its class, with R(0) = 1; None if the motion is already given along them."""
        if self._placement is None:
            return None
        unplaced = type(self)(**self._placement.arguments)
        unplaced._singles = self._singles  # noqa: SLF001  of this class
        return unplaced

    def __reduce__(self) -> tuple[Any, ...]:
        """Return a callable and its arguments, by which copy and pickle make the motion again."""
        return super().__reduce__() if self._placement is None else (made, (self._placement.make, dict(self.arguments)))

    def rotation(self, t: RealArrayLike, out: FloatArray | None = None) -> FloatArray:
        """Rotation matrix R(t), eqs. (84), (85), whose columns are the body's axes in the laboratory.

        Parameters
        ----------
        t : array_like
            Times, of any shape that broadcasts with the motions. The phases k t and phi t may reach 2^50.
        out : ndarray of float64, optional
            C-contiguous array (..., 3, 3) that the matrices are written into.

        Returns
        -------
        ndarray, shape (..., 3, 3)
            Rotation matrices; `out` itself if given.

        Raises
        ------
        AtlasError
            For a time that is not finite or whose phases exceed 2^50.

        Notes
        -----
        Largest error of an entry:

        - 8.9e-16 for motions in elementary functions;
        - 1.8e-15 for a `GeneralMotion`;
        - 3.6e-15 for a `TopMotion` or an `EllipticMotion`;
        - its own `accuracy` for an `AsymmetricMotion`.
        """
        R, p = self._evaluate(lambda single, t, out: single.rotation(t, out), t, (3, 3), out), self._placement
        R = R if p is None else p.matrices(R)
        return self._started(R, lambda: np.eye(3) if p is None else p.attitude, t, 2)

    def column(self, j: Literal[1, 2, 3], t: RealArrayLike) -> FloatArray:
        """Column R_j(t) of the rotation matrix (84): one axis of the body in the laboratory.

        Parameters
        ----------
        j : {1, 2, 3}
            Number of the axis.
        t : array_like
            Times, as for `rotation`.

        Returns
        -------
        ndarray, shape (..., 3)
            Unit vectors in the laboratory.

        Raises
        ------
        AtlasError
            For another `j`, and for times that `rotation` refuses.
        """
        check_column(j)
        p = self._placement
        if p is None:
            R_j = self._evaluate(lambda single, t, out: single.column(j, t, out), t, (3,))
            return self._started(R_j, lambda: np.eye(3)[j - 1], t)
        return np.ascontiguousarray(self.rotation(t)[..., j - 1])

    def quaternion(self, t: RealArrayLike, *, scalar_first: bool = False) -> FloatArray:
        """Unit quaternion (x, y, z, w) of R(t): the Cayley-Klein parameters of the rotation.

        Parameters
        ----------
        t : array_like
            Times, as for `rotation`.
        scalar_first : bool
            True for the order (w, x, y, z).

        Returns
        -------
        ndarray, shape (..., 4)
            Unit quaternions; ``scipy.spatial.transform.Rotation.from_quat`` reads the default order.

        Raises
        ------
        AtlasError
            For times that `rotation` refuses.

        Notes
        -----
        The quaternion is continuous in t, with w >= 0 at t = 0. One full turn changes its sign. Error bounds are those
        of `rotation`.
        """
        quaternions = self._evaluate(lambda single, t, out: single.quaternion(t, out), t, (4,))
        if self._placement is not None:
            quaternions = self._placement.quaternions(quaternions, t)
        else:
            self._started(quaternions, lambda: np.eye(4)[3], t)
        return np.roll(quaternions, 1, axis=-1) if scalar_first else quaternions

    def euler_angles(self, t: RealArrayLike, seq: str, *, degrees: bool = False) -> FloatArray:
        """Euler angles of R(t), by the letters of SciPy's `Rotation.as_euler`.

        Parameters
        ----------
        t : array_like
            Times, as for `rotation`.
        seq : str
            Axes of the three turns: "ZXZ" for axes that turn with the body, "zxz" for those of the laboratory.
        degrees : bool
            True for degrees in place of radians.

        Returns
        -------
        ndarray, shape (..., 3)
            Angles in the order of `seq`; where only a sum of two is determined, SciPy warns and sets the third to 0.

        Raises
        ------
        AtlasError
            For other letters, and for times that `rotation` refuses.
        """
        from scipy.spatial.transform import Rotation as Rotations

        R = self.rotation(t)
        try:
            angles = Rotations.from_matrix(R.reshape(-1, 3, 3)).as_euler(seq, degrees=degrees)
        except (TypeError, ValueError) as error:
            raise AtlasError(f"seq is three letters of X, Y, Z or of x, y, z, not {seq!r}: {error}") from error
        return np.asarray(angles.reshape(*R.shape[:-2], 3))

    def angular_velocity(self, t: RealArrayLike) -> FloatArray:
        """Angular velocity Omega(t) along the axes of the body.

        Parameters
        ----------
        t : array_like
            Times, as for `rotation`.

        Returns
        -------
        ndarray, shape (..., 3)
            Components of Omega, in rad/time.

        Raises
        ------
        AtlasError
            For times that `rotation` refuses.
        """
        Omega = self._evaluate(lambda single, t, out: single.angular_velocity(t, out), t, (3,))
        return self._started(self._in_body(Omega), self._omega_at_zero, t)

    def _started(self, values: FloatArray, start: Callable[[], FloatArray], t: Any, rank: int = 1) -> FloatArray:
        """Return ``values`` at times t with those at t = 0 replaced by start(), where the formulas are not exact there.

        Values are vectors (..., 3) for ``rank`` 1, matrices (..., 3, 3) for rank 2, and are changed in place.
        """
        if (self._placement is None and self._is_exact_at_zero) or np.asarray(bare(t, "The time", TIME)).all():
            return values
        return Placement.started(values, start(), rank, t)

    def _omega_at_zero(self) -> FloatArray:
        """Angular velocity at t = 0 along the body's axes as it was given, shape (..., 3), in rad/time."""
        if self._placement is not None:
            return self._placement.omega
        omega: tuple[RealArrayLike, ...] = self.omega  # type: ignore[attr-defined]  # of classes that have it
        return np.stack(np.broadcast_arrays(*map(np.asarray, omega)), -1)

    def _in_body(self, v: FloatArray) -> FloatArray:
        """Return components (..., 3) along the given axes of the body from components v (..., 3) along the class's.

        That is v itself without a placement.
        """
        return v if self._placement is None else self._placement.vectors(v)

    def _along_class(self, v: FloatArray) -> FloatArray:
        """Return components (..., 3) along the axes of the class from components v (..., 3) along the given axes.

        The given axes are the body's. That is v itself without a placement.
        """
        return v if self._placement is None else self._placement.along_class(v)

    def _momentum_of(self, factors: Callable[[FloatArray], FloatArray], t: Any, name: str = "m") -> FloatArray:
        """Return the angular momentum R II Omega in the laboratory at times t, shape (..., 3), in inertia/time.

        ``factors`` maps Omega (..., 3) to II Omega along the axes of the class; with a placement the given inertia
        tensor II is used instead. Without field the momentum is that of t = 0 at all times. Raises DomainError,
        naming ``name``, if the momentum is too large for a float.
        """
        Omega, p = self.angular_velocity(t), self._placement
        momentum = factors(Omega) if p is None else np.matvec(p.tensor, Omega)
        m = np.asarray(finite(np.matvec(self.rotation(t), momentum), name))
        is_free = ~np.any(np.broadcast_arrays(*getattr(self, "field", (1.0,))), axis=0)
        if is_free.any() and np.any(t):  # it stays as it was, to the last digit
            np.copyto(m, self._momentum_of(factors, 0.0, name), where=is_free[..., None])
        return m

    def angular_velocity_in_laboratory(self, t: RealArrayLike) -> FloatArray:
        """Angular velocity R(t) Omega(t) in the laboratory.

        Parameters
        ----------
        t : array_like
            Times, as for `rotation`.

        Returns
        -------
        ndarray, shape (..., 3)
            Components of R Omega, in rad/time.

        Raises
        ------
        AtlasError
            For times that `rotation` refuses.
        """
        return np.asarray(finite(np.matvec(self.rotation(t), self.angular_velocity(t)), "R Omega"))

    @classmethod
    def in_laboratory(
        cls,
        body: BodyLike,
        field: FieldLike,
        attitude: AttitudeLike,
        omega_laboratory: RealArrayLike | None = None,
        **parameters: RealArrayLike,
    ) -> Self:
        """Motion of this class from any attitude, in a field of any direction, as `atlas.motion` gives it.

        Parameters
        ----------
        body : float or array_like or SymmetricBody
            Body as for `atlas.motion`; moments (I2, I3) for a `TopMotion`.
        field : array_like, shape (..., 3), or Field
            Components of B' in the laboratory, in 1/time. For a `TopMotion` the direction n in the laboratory.
        attitude : array_like
            Attitude R(0), as for `atlas.motion`.
        omega_laboratory : array_like, shape (..., 3), optional
            Angular velocity at t = 0 along the axes of the laboratory, in rad/time.
        **parameters : float or array_like
            Parameters of the class, see Notes.

        Returns
        -------
        Motion
            Motion of this class with R(0) = `attitude`.

        Raises
        ------
        DomainError
            If the motion is not of this class, which is decided exactly.
        AtlasError
            For an input that is no number.

        Notes
        -----
        A `TopMotion` takes the coupling and the potential as `parameters`. An `EllipticMotion` takes z and branch
        instead of the angular velocity. An `ElementaryMotion` takes omega2 and omega3 instead, with e2 along the part
        of the field across the axis at the start.
        """
        from atlas.motions.start import in_laboratory

        if "angular_velocity" in parameters:
            omega_laboratory = parameters.pop("angular_velocity")
            old = "in_laboratory(angular_velocity=) is now omega_laboratory=, the same vector."
            warnings.warn(old, DeprecationWarning, stacklevel=2)
        motion: Self = in_laboratory(cls, body, field, attitude, omega_laboratory, parameters)
        return motion

    @classmethod
    def _from_start(cls, start: Any, **parameters: Any) -> Any:
        """Return (motion, axes) of this class from ``start``, a `Start`; None where the class has no motion from there.

        The rows of `axes` (..., 3, 3) are the axes of the class, along those of the body. ``parameters`` are
        further inputs of the class. Raises NotImplementedError in the base.
        """
        raise NotImplementedError

    @staticmethod
    def _body_of(inertia: Any) -> Any:
        """Return the `Body` (moments, axes, tensor) for the inertia that `in_laboratory` of this class takes."""
        from atlas.motions.start import body_of

        return body_of(inertia)

    def third_axis(self, t: RealArrayLike) -> FloatArray:
        """Third inertia axis R_3(t) in the laboratory, the third column of (84).

        Parameters
        ----------
        t : array_like
            Times, as for `rotation`.

        Returns
        -------
        ndarray, shape (..., 3)
            Unit vectors in the laboratory.

        Raises
        ------
        AtlasError
            For a time that is not finite or whose phases exceed 2^50.
        """
        return self.column(3, t)

    def sensitivity(self, t: RealArrayLike, names: str | Sequence[str], of: str = "rotation") -> FloatArray:
        """Derivatives of the motion with respect to its inputs: rotation vectors v with dR/dp = [v]x R.

        Parameters
        ----------
        t : array_like
            Times, as for `rotation`; ignored for the derivatives of a scalar.
        names : str or sequence of str
            Names of the inputs p: those of the class, such as "ratio", "B2", "omega1", and "t" for the time.
        of : str
            Quantity that is differentiated: "rotation", "angular_velocity", "field", or a scalar such as "period" or
            "k".

        Returns
        -------
        ndarray, shape (..., names, 3)
            For "rotation" the vectors v in the laboratory. For "angular_velocity" and "field" dOmega/dp and dK/dp in
            the body. For a scalar its derivatives, of shape (..., names).

        Raises
        ------
        DomainError
            On a separatrix, and for three different moments where the theta functions are missing or change their
            form.
        AtlasError
            For an unknown name, and for times that `rotation` refuses.

        Notes
        -----
        In `atlas.motion` the field may have any direction. There "B1" to "B3" are its components in the laboratory.
        "omega1" to "omega3" are the components of Omega(0) along the body's axes, and "a1" to "a3" rotate R(0) about
        the laboratory axes.

        Errors stay below 1e-12 of 1 + |v| at any time. Next to a border between types of motion each time is evaluated
        alone, in some milliseconds. For three different moments the constants of the theta functions are
        differentiated, in some seconds. In a field below a thousandth of the angular velocity the errors of field
        derivatives grow; above 1e-9 such derivatives are refused.
        """
        from atlas.motions.derivatives import derivatives

        return derivatives(self, t, names, of)

    def input_error(self, t: RealArrayLike) -> FloatArray:
        """Bound, to first order, on the rotation error at t that rounding the inputs to floats causes.

        Parameters
        ----------
        t : array_like
            Times, as for `rotation`.

        Returns
        -------
        ndarray
            Angle in rad, of the shape of motions and times together.

        Raises
        ------
        DomainError, AtlasError
            As for `sensitivity`.

        Notes
        -----
        The bound sums half an ulp of each input times the length of the corresponding vector of `sensitivity`. It
        concerns decimal inputs that no float holds, such as 0.1. The motion of the floats themselves has no such
        error. The bound grows in proportion to t, on an unstable motion exponentially.

        Examples
        --------
        >>> motion = atlas.motion(1.5, (0.1, 1.0, 2.0), (0.3, 0.7, 0.2))
        >>> bool(motion.input_error(1.0) < 1e-14 < motion.input_error(1e6))
        True
        """
        from atlas.motions.derivatives import of_rounding

        return of_rounding(self, t)

    def spectrum(self, of: SpectrumOf = "rotation", least: float = 1e-6) -> Spectrum:
        """Spectral lines of a function of time: the terms amplitude exp(i frequency t) of its Fourier sum.

        Parameters
        ----------
        of : {"rotation", "axis", "angular_velocity", "field"}
            Function: R(t), its third column, Omega(t) in the body or K(t) in the body.
        least : float
            Smallest amplitude kept, relative to the root mean square of the function, from 1e-13 to below 1.

        Returns
        -------
        Spectrum
            Frequencies in rad/time, complex amplitudes, and the integer combinations behind each frequency.

        Raises
        ------
        DomainError
            On a separatrix, and for a motion without a closed form.
        AtlasError
            For an array of motions, and for another `of` or `least`.

        Notes
        -----
        Frequencies are integer combinations of 2 pi/period, `precession_rate` and `spin_rate`. For an
        `AsymmetricMotion` they combine its `frequencies`. Amplitudes are integrals over the phases, accurate to
        rounding. The lines at f and -f together move a component by twice the size of its complex amplitude.

        Examples
        --------
        >>> lines = atlas.GeneralMotion(1.5, (1.0, 2.0), omega=(0.3, 0.7, 0.2)).spectrum("axis", least=0.1)
        >>> lines.names, lines.combinations.tolist()
        (('precession',), [[-1], [0], [1]])
        """
        return spectrum(self, of, least)

    @property
    def actions(self) -> Actions:
        """Action variables of one motion with their rates: d energy = rates d values.

        Returns
        -------
        Actions
            Fields `names`, `values` (inertia/time), `rates` (rad/time) and `energy` (inertia/time^2). For a body given
            by its ratio, values and energy are divided by I2.

        Raises
        ------
        DomainError
            On a separatrix, and for a motion without a closed form.
        AtlasError
            For an array of motions.

        Notes
        -----
        The action of precession is (M, n), the canonical momentum along the field; that of spin is M3. An
        `AsymmetricMotion` has one action for each of its `frequencies`. Slow changes conserve the actions, see
        `atlas.drift`. Values are integrals over the phases, accurate to rounding; `AsymmetricMotion.curve` has
        certified digits of them.

        Examples
        --------
        >>> found = atlas.GeneralMotion(1.5, (1.0, 2.0), omega=(0.3, 0.7, 0.2)).actions
        >>> found.names, found.values.round(6)
        (('nutation', 'precession', 'spin'), array([0.038207, 3.711873, 3.3     ]))
        """
        return actions(self)

    def _inputs_of(self, i: int) -> Any:
        """Return the `Inputs` of the i-th motion: exact inputs by name, the certified counterpart, and scalars.

        The index i counts the flattened array. Raises NotImplementedError in the base.
        """
        raise NotImplementedError

    def _dynamics(self) -> Any:
        """Return (moments, coupling, linear, quadratic) of one motion, of which its angular acceleration is made.

        Moments I_i and coupling k_i, shape (3,) each, are along the axes of the class; the potential is
        linear nu + quadratic nu^2/2.
        """
        return self._inputs_of(0).dynamics

    def _wheels(self) -> Wheels:
        """Return one motion as two turns and a function S of phases, see `atlas.motions.spectrum.Wheels`.

        Raises NotImplementedError in the base.
        """
        raise NotImplementedError

    def animate(
        self, times: RealArrayLike | None = None, *, fps: float = 20.0, style: StyleLike = None
    ) -> "FuncAnimation":
        """Matplotlib animation of the body, its axis with a trace, and the field.

        Parameters
        ----------
        times : array_like, optional
            Times of the frames; by default as many periods, up to eight, as bring the body back, else one.
        fps : float
            Frames per second.
        style : str or dict or list, optional
            Matplotlib style, as for `atlas.figure`.

        Returns
        -------
        matplotlib.animation.FuncAnimation
            ``.save("x.gif")`` writes the animation to a file; ``jumps`` is true where its end does not lead back to
            its start.

        Raises
        ------
        AtlasError
            For an array of motions, and for times that `rotation` refuses.
        """
        moments = None if times is None else real(times, "The time", TIME).ravel()
        moving: FuncAnimation = notebook("pictures").animate(self, moments, number(fps, "fps"), style)
        return moving

    def trace(
        self, periods: float = 1.0, *, stop: float | None = None, tolerance: float = 1e-4
    ) -> tuple[FloatArray, FloatArray]:
        """Curve of the third axis R_3(t) of one motion on the unit sphere.

        Parameters
        ----------
        periods : float
            Number of periods that the curve covers, from t = 0.
        stop : float, optional
            End time, instead of `periods`.
        tolerance : float
            Largest distance between a chord of the points and the curve.

        Returns
        -------
        times : ndarray, shape (N,)
            Times, spaced as the tolerance requires.
        points : ndarray, shape (N, 3)
            Unit vectors R_3(t) in the laboratory.

        Raises
        ------
        AtlasError
            Without a finite period, for an array of motions, and for times that `rotation` refuses.
        """
        curve: tuple[FloatArray, FloatArray] = notebook("frames").trace(self, periods, stop, tolerance)
        return curve

    def rotation_grid(self, start: float, step: float, count: int, out: FloatArray | None = None) -> FloatArray:
        """Rotation matrices R(t), eq. (85), on the uniform grid t = start + i step.

        Parameters
        ----------
        start, step : float
            First time and spacing of the grid.
        count : int
            Number of times.
        out : ndarray of float64, optional
            C-contiguous array (..., count, 3, 3) that the matrices are written into.

        Returns
        -------
        ndarray, shape (..., count, 3, 3)
            Rotation matrices; `out` itself if given.

        Raises
        ------
        AtlasError
            For a count that is no integer, an `out` of another shape, and times that `rotation` refuses.

        Notes
        -----
        Each matrix belongs to the exact real number start + i step, which need not be a float. In elementary functions
        the grid is faster than `rotation` from 10 000 times on, and twice as fast from 100 000 on.
        """
        start, step = number(start, "The start of the grid", TIME), number(step, "The step of the grid", TIME)
        count = integer(count, "The count of the grid")
        out = target(out, (*self.shape, count, 3, 3))
        for i, matrices in enumerate(out.reshape(prod(self.shape), count, 3, 3)):
            self._fill_grid(self._single(i), start, step, matrices)
        return out if self._placement is None else self._placement.matrices(out, between=1)

    def _fill_grid(self, single: Single, start: float, step: float, out: FloatArray) -> None:
        """Fill ``out`` (count, 3, 3) with R of one motion at times start + i step; ``single`` is its evaluator.

        Raises NotImplementedError in the base.
        """
        raise NotImplementedError

    def _evaluate(
        self, function: Callable[..., Any], t: Any, shape: tuple[int, ...], out: FloatArray | None = None
    ) -> FloatArray:
        """Return function(evaluator, t, out) for all motions at times that broadcast with them, shape (..., *shape).

        ``shape`` is that of one value, (3, 3) for R. Below `MIN_SINGLE_TIMES` times per motion `_rows` evaluate all
        motions at once, if the class has them; otherwise motion by motion. ``out``, if given, is filled and
        returned.
        """
        t = t if type(t) is np.ndarray else bare(t, "The time", TIME)
        if not self.shape:
            return np.asarray(function(self._single(), t, out))
        times = real(t, "The time")
        full_shape = common_shape(self.shape, times.shape)
        times, out = np.broadcast_to(times, full_shape), target(out, full_shape + shape)
        motions_shape = (1,) * (len(full_shape) - len(self.shape)) + self.shape
        count = prod(self.shape)
        if self._min_array_motions <= count and times.size < MIN_SINGLE_TIMES * count and self._rows is not None:
            self._evaluate_rows(function, times, motions_shape, out.reshape(times.size, *shape))
            return out
        for i, index in enumerate(np.ndindex(motions_shape)):
            selection = tuple(slice(None) if n == 1 else i for i, n in zip(index, motions_shape, strict=True))
            out[selection] = function(self._single(i), times[selection], None)
        return out

    def _evaluate_rows(
        self, function: Callable[..., Any], times: FloatArray, shape: tuple[int, ...], out: FloatArray
    ) -> None:
        """Fill ``out`` (m, ...), m the number of times, by calls function(rows, t, out) for `BLOCK` times each.

        ``times`` have any shape with which the motions' ``shape`` broadcasts. Motions that `_rows` count as extreme
        are evaluated one by one.
        """
        indices = np.broadcast_to(np.arange(prod(shape)).reshape(shape), times.shape)
        for start in range(0, times.size, BLOCK):
            block = slice(start, start + BLOCK)
            t = np.asarray(times.flat[block])
            rows = self._rows.at(block if times.shape == shape else indices.flat[block], t)
            with np.errstate(over="ignore", invalid="ignore"):  # in extreme rows, which are made by themselves
                function(rows, t, out[block])
            for i in np.unique(rows.indices[rows.extreme]).tolist():
                places = rows.extreme[rows.indices[rows.extreme] == i]
                out[start + places] = function(self._single(i), t[places], None)


class DoubleTurn(Motion[Rotation]):
    """Motions in elementary functions, R(t) = R_n(k t) R_z(phi t), (85): a turn about a fixed n after one about e3.

    n is a unit vector in the laboratory, k and phi are rates in rad/time. A subclass with `_inverse` has the transposed
    matrix instead, R(t) = R_z(-phi t) R_n(-k t). Subclasses give the formulas in `_groups` and the constant vectors in
    `_vectors`.
    """

    _frequencies: slice
    """Which of the inputs are frequencies."""
    _inverse = False
    """Whether the matrix is the transposed one, (28)."""
    _kind: str

    @property
    def kind(self) -> NameOrArray:
        """Type of the motion: a string, or for an array of motions an array of strings."""
        return np.full(self.shape, self._kind) if self.shape else self._kind

    @cached_property
    def _rows(self) -> DoubleRotationRows:
        """The `DoubleRotationRows` of all motions, which evaluate each motion at a few times."""
        # by a weak reference: in a circle of references, memory would wait for the collector of garbage
        vectors = partial(getattr, proxy(self), "_flat_vectors")
        return DoubleRotationRows(self._groups(), prod(self.shape), self._frequencies, vectors, inverse=self._inverse)

    @cached_property
    def _flat_vectors(self) -> Mapping[str, Any]:
        """Constant vectors of the motions by name: a list of three components, each an array flattened to (count,)."""
        return {
            name: [np.broadcast_to(x, self.shape).reshape(-1) for x in vector]
            for name, vector in self._vectors().items()
        }

    def _groups(self) -> list[Group]:
        """Return the motions grouped by the formulas that hold for them, as triples (formula, indices, inputs).

        See `DoubleRotationRows`.
        """
        raise NotImplementedError

    def _vectors(self) -> Mapping[str, Any]:
        """Return constant vectors of the motions by name, such as "omega": three components each, which broadcast."""
        raise NotImplementedError

    def _fill_grid(self, single: Rotation, start: float, step: float, out: FloatArray) -> None:
        """Write R of one motion at times start + i step into ``out`` (count, 3, 3), by `atlas.arithmetic.grid`.

        ``single`` is the `DoubleRotation` of the motion.
        """
        fill_grid(single, start, step, out)

    def _wheels(self) -> Wheels:
        """Return the `Wheels` of one motion: a rotation by k about the axis n, one by phi about e3, and no phases.

        With `_inverse` they are by -phi about e3, then by -k about n.
        """
        single, (L, C), e3 = self._single(), self._sides, np.array([0.0, 0.0, 1.0])
        n = np.array([nearest(x) for x in single.axis])
        k, phi = (nearest(x) for x in single.frequencies)
        turns = (e3, -phi, n, -k) if single.inverse else (n, k, e3, phi)
        start = np.empty(0)
        return Wheels(
            L @ turns[0], turns[1], turns[2] @ C, turns[3], start, lambda name, _: function_of(self, name)(0.0)[None]
        )
