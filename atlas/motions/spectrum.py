"""Lines of a motion: R(t), the body's axis, Omega and the field in the body as sums of exp(i f t).

Every motion but a separatrix is R(t) = R_n(p t) S(M t) R_a(s t): a turn about n in the laboratory, one about an axis a
of the body, and S of period 2 pi, of one nutation, of two phases for three moments, or none. By Rodrigues a turn has
the frequencies -1, 0 and 1: all are m M + l p + j s, of closed form. The amplitudes are Fourier integrals of S over its
phases; the trapezoidal rule has them to rounding, since its error falls as a power of the nome.
"""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, Literal, NamedTuple, TypeAlias, get_args

import numpy as np
from numpy.typing import NDArray

from atlas.arithmetic.annotations import RealArrayLike
from atlas.arithmetic.dimensions import TIME, bare
from atlas.arithmetic.inputs import FloatArray, number, real
from atlas.errors import AtlasError, DomainError

SpectrumOf: TypeAlias = Literal["rotation", "axis", "angular_velocity", "field"]
"""Functions of time that have a spectrum."""

MIN_AMPLITUDE = 1e-13
"""Least amplitude that rounding does not hide."""

MAX_OUTER_AMPLITUDE = 2.0**-46
"""Amplitude beside the largest below which the outermost ones must be."""

FIRST, LAST = {1: 64, 2: 16}, {1: 1 << 17, 2: 1 << 10}
"""Points along a phase with which amplitudes are tried first, and most of them, by the number of phases."""

FREQUENCY_TOLERANCE = 2.0**-44
"""Frequencies are one where they differ by less than this part of the largest."""

BLOCK = 1 << 14
"""Points of the torus at once."""

Array = NDArray[np.complex128]


@dataclass(frozen=True)
class Spectrum:
    """Lines of a function of time, f(t) = sum of amplitudes exp(i frequencies t), as `Motion.spectrum` returns them.

    An object of this class is callable: with times t it gives the sum over its N lines.

    Attributes
    ----------
    of : str
        Function: "rotation", "axis", "angular_velocity" or "field".
    names : tuple of str
        Names of the k basic rates that occur in some line, such as "nutation", "precession" and "spin".
    rates : ndarray, shape (k,)
        Basic rates, in rad/time.
    frequencies : ndarray, shape (N,)
        Frequencies, ascending, each with its negative, in rad/time.
    amplitudes : ndarray of complex128, shape (N, ...)
        Amplitudes in the unit and shape of f; conjugate at opposite frequencies.
    combinations : ndarray of int, shape (N, k)
        Integers m with frequency = (m, rates); the shortest where several agree.
    mean_square : float
        Mean over all times of the sum of the squared components of f.

    Notes
    -----
    By Parseval's theorem the sum of `power` is `mean_square` minus the power of the lines below the least amplitude.
    A component of f oscillates with twice the magnitude of its complex amplitude: the line at the opposite frequency
    adds as much.
    """

    of: str
    names: tuple[str, ...]
    rates: FloatArray
    frequencies: FloatArray
    amplitudes: Array
    combinations: NDArray[np.intp]
    mean_square: float

    @property
    def power(self) -> FloatArray:
        """Sum of the squared magnitudes of the amplitudes of each line, shape (N,), in the unit of f squared."""
        return _power(self.amplitudes)

    def __call__(self, t: RealArrayLike) -> FloatArray:
        """Sum of the lines at the times t.

        Parameters
        ----------
        t : array_like
            Times, of any shape.

        Returns
        -------
        ndarray, shape (..., *shape of f)
            Values of f, in its unit: (3, 3) matrices for "rotation", vectors (3,) otherwise.
        """
        times = real(bare(t, "The time", TIME), "The time")
        phases = np.exp(1j * np.multiply.outer(times, self.frequencies))
        return np.asarray(np.tensordot(phases, self.amplitudes, 1).real)

    def __repr__(self) -> str:
        """Return the function, the number of lines and the names of the rates, as one line of text."""
        return f"<Spectrum of {self.of}: {len(self.frequencies)} lines, {', '.join(self.names)}>"


class Wheels(NamedTuple):
    """A motion as R_n(p t) S(phases) R_a(s t): a turn about n in the laboratory, one about a in the body, S periodic.

    `n` and `a` are unit vectors (3,), `p` and `s` rates in rad/time. `phases` (d,) are the rates of the d phases of
    S, in rad/time; d is 0, 1 or 2. ``at(name, x)`` takes a quantity of `SpectrumOf` and phases x (d, m) in rad, and
    returns S (m, 3, 3) for "rotation" and "axis", else Omega or the field in the body (m, 3) without the rotation
    about a. `actions`, for two phases, returns their actions from the principal moments; None otherwise.
    """

    n: FloatArray
    p: float
    a: FloatArray
    s: float
    phases: FloatArray
    at: Callable[[str, FloatArray], FloatArray]
    actions: Callable[[FloatArray], list[float]] | None = None

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the `rates`: "f1", "f2", "f3", "spin" for two phases, else "nutation", "precession", "spin".

        f1, f2 and f3 are `AsymmetricMotion.frequencies`, beside which the rate "spin" is 0. Without phases there is no
        "nutation".
        """
        return (
            ("f1", "f2", "f3", "spin")
            if len(self.phases) > 1
            else ("nutation", "precession", "spin")[-len(self.rates) :]
        )

    @property
    def rates(self) -> FloatArray:
        """Basic angular frequencies in rad/time, shape (d + 2,): those of the d phases, then p and s."""
        return np.array([*self.phases, self.p, self.s])


def spectrum(motion: Any, quantity: str, least: float) -> Spectrum:
    """Return the `Spectrum` of a ``quantity``, such as "axis", of one motion; see `Motion.spectrum`.

    Raises AtlasError for an array of motions, another name, and ``least`` outside [`MIN_AMPLITUDE`, 1).
    """
    if not isinstance(quantity, str) or quantity not in get_args(SpectrumOf):
        raise AtlasError(f"A motion has no spectrum of {quantity!r}: choose from {', '.join(get_args(SpectrumOf))}.")
    if motion.shape:
        raise AtlasError(f"A spectrum is that of one motion, not of an array of them, of shape {motion.shape}.")
    least = number(least, "least")
    if not MIN_AMPLITUDE <= least < 1:
        raise AtlasError(f"least is a fraction of the root mean square from {MIN_AMPLITUDE:g} to 1, not {least:g}.")
    wheels = motion._wheels()  # noqa: SLF001  of the same folder
    indices, S = coefficients(lambda x: wheels.at(quantity, x), len(wheels.phases))
    left, right, moves = _turn(wheels.n, wheels.p), _turn(wheels.a, wheels.s), quantity in ("rotation", "axis")
    combinations, amplitudes = [], []
    for l in left if moves else (0,):
        for j, after in right.items():
            amplitudes_of_line = left[l] @ S @ after if moves else S @ after  # that of R_a(-s t) at -j
            amplitudes.append(amplitudes_of_line[..., 2] if quantity == "axis" else amplitudes_of_line)
            combinations.append(np.column_stack([indices, np.full((len(indices), 2), (l, j))]))
    return _sorted(quantity, wheels, np.concatenate(combinations), np.concatenate(amplitudes), least)


def _sorted(quantity: str, wheels: Wheels, combinations: NDArray[np.intp], amplitudes: Array, least: float) -> Spectrum:
    """Return a `Spectrum` of lines by ascending frequency; amplitudes of equal frequencies are added.

    ``combinations`` (N, d + 2) are the integers of each line in the rates of ``wheels``, ``amplitudes`` (N, ...)
    complex. Lines below the fraction `least` of the root mean square are left out, and so are rates that no line
    contains. Raises DomainError where the mean square is no float.
    """
    frequencies, unit = combinations @ wheels.rates, _size(amplitudes)
    size = _power(amplitudes, unit)
    lines = np.flatnonzero(size > (MIN_AMPLITUDE * 1e-3) ** 2 * size.max())
    order = lines[np.lexsort((abs(combinations[lines]).sum(1), frequencies[lines]))]
    frequencies, combinations, amplitudes = frequencies[order], combinations[order], amplitudes[order]
    is_new_line = np.diff(frequencies, prepend=-np.inf) > FREQUENCY_TOLERANCE * abs(frequencies).max(initial=0.0)
    starts = np.flatnonzero(is_new_line)
    shortest = [i + int(np.argmin(abs(combinations[i:k]).sum(1))) for i, k in pairwise([*starts, len(frequencies)])]
    amplitudes = np.add.reduceat(amplitudes, starts)
    power = _power(amplitudes, unit)
    total = float(power.sum())
    mean_square = total * unit * unit
    if total and not np.finfo(float).tiny <= mean_square < np.inf:
        raise DomainError(
            f"The mean square of the {quantity} is too large or too small for a float: choose other units."
        )
    lines = np.flatnonzero(power >= least * least * total)
    combinations = combinations[shortest][lines]
    columns = np.flatnonzero(combinations.any(0))
    names = tuple(wheels.names[i] for i in columns)
    return Spectrum(
        quantity, names, wheels.rates[columns], combinations[:, columns] @ wheels.rates[columns], amplitudes[lines],
        combinations[:, columns], mean_square,
    )  # fmt: skip


def _power(amplitudes: Array, unit: float = 1.0) -> FloatArray:
    """Return the sum of squared magnitudes of each line's amplitudes (N, ...), over ``unit`` squared, shape (N,)."""
    return np.asarray(((abs(amplitudes) / unit) ** 2).sum(axis=tuple(range(1, amplitudes.ndim))))


def _size(amplitudes: Array) -> float:
    """Return the largest power of two up to the largest amplitude; squares of amplitudes over it are floats."""
    return float(np.ldexp(1.0, np.frexp(abs(amplitudes).max())[1] - 1))


def _turn(n: FloatArray, rate: float) -> dict[int, Array]:
    """Return the Fourier coefficients of the rotation about n (3,) by the angle ``rate`` t: matrices (3, 3).

    They stand in a dict by the multiple of the rate, -1, 0 and 1; for rate 0 the unit matrix alone, under 0.
    """
    if not rate:
        return {0: np.eye(3, dtype=complex)}
    parallel, transverse = np.outer(n, n), np.cross(n, np.eye(3)).T
    matrices = np.array(
        [(np.eye(3) - parallel) / 2 + 0.5j * transverse, parallel, (np.eye(3) - parallel) / 2 - 0.5j * transverse]
    )
    return dict(zip((-1, 0, 1), matrices, strict=True))


def coefficients(function: Callable[[FloatArray], FloatArray], d: int) -> tuple[NDArray[np.intp], Array]:
    """Return (integers m (n, d), complex Fourier coefficients (n, ...)) of a function of d phases, 0, 1 or 2.

    ``function`` takes phases (d, m) in rad and returns (m, ...). The number of points along a phase is doubled
    until the outer coefficients, which are left out, are below `MAX_OUTER_AMPLITUDE`. Raises DomainError if a phase
    would need more than `LAST` points.
    """
    if not d:
        return np.zeros((1, 0), dtype=int), function(np.zeros((0, 1))).astype(complex)
    count = FIRST[d]
    while count <= LAST[d]:
        line = np.arange(count) * (2 * np.pi / count)
        grid = np.stack(np.meshgrid(*[line] * d, indexing="ij")).reshape(d, -1)
        values = np.concatenate([function(grid[:, i : i + BLOCK]) for i in range(0, grid.shape[1], BLOCK)])
        amplitudes = np.fft.fftn(values.reshape(*[count] * d, *values.shape[1:]), axes=range(d), norm="forward")
        m = np.fft.fftfreq(count, 1 / count).astype(int)
        indices = np.stack(np.meshgrid(*[m] * d, indexing="ij"), -1).reshape(-1, d)
        coefficients = amplitudes.reshape(len(indices), *values.shape[1:])
        size, outer = _power(coefficients, _size(coefficients)), abs(indices).max(1) > 3 * count // 8
        if size[outer].max() <= MAX_OUTER_AMPLITUDE**2 * size.max():
            return indices[~outer], coefficients[~outer]
        count *= 2
    raise DomainError(f"The motion has more than {LAST[d] // 2} lines of each phase: it is too near to a separatrix.")


def function_of(motion: Any, quantity: str) -> Any:
    """Return the bound method of the motion for "angular_velocity" or "field"; `rotation` for any other name."""
    names = {"angular_velocity": "angular_velocity", "field": "field_in_body"}
    return getattr(motion, names.get(quantity, "rotation"))


def mean(function: Callable[[FloatArray], FloatArray]) -> float:
    """Return the mean over one period of a function of one phase, which takes phases (1, m) in rad and returns (m,)."""
    indices, amplitudes = coefficients(function, 1)
    return float(amplitudes[np.flatnonzero(indices[:, 0] == 0)[0]].real)


def rodrigues(n: FloatArray, angle: Any) -> FloatArray:
    """Return the rotation matrices (..., 3, 3) about a unit vector n (3,) by ``angle`` (...) in rad."""
    angle = np.asarray(angle)[..., None, None]
    parallel, transverse = np.outer(n, n), np.cross(n, np.eye(3)).T
    return np.asarray(parallel + np.cos(angle) * (np.eye(3) - parallel) + np.sin(angle) * transverse)
