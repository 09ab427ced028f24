"""Numbers that formulas are written for: exact rationals and balls of flint, and arrays in two words.

A formula uses + - * / and the functions below. So it gives the certified floor its balls, the kernels their floats of
one motion, rounded once, and by `atlas.arithmetic.double_double` those of a million.
"""

from collections.abc import Callable, Sequence
from math import inf, isqrt
from threading import RLock
from types import TracebackType
from typing import Any, Generic, Self, TypeAlias, TypeVar, overload

from flint import arb, ctx, fmpq

Number: TypeAlias = Any
"""fmpq, arb, or an array of `DoubleDouble`."""

Vector: TypeAlias = Sequence[Number]

BITS = 256
"""Digits of a ball from which a float of one motion is rounded: far more than cancel between exact inputs."""

_LOCK = RLock()


class workprec:  # noqa: N801  the name that flint has for it
    """Context manager that sets flint's precision to `bits` binary digits, for one thread at a time.

    flint has one precision for all threads of a process.
    """

    __slots__ = ("_before", "bits")

    def __init__(self, bits: int = BITS) -> None:
        self.bits = bits

    def __enter__(self) -> None:
        _LOCK.acquire()
        self._before = ctx.prec
        ctx.prec = self.bits

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        ctx.prec = self._before
        _LOCK.release()


Value = TypeVar("Value")


class by_precision(Generic[Value]):  # noqa: N801  used as a decorator
    """A cached property of exact or certified values, computed again for a precision above the cached value's."""

    def __init__(self, function: Callable[[Any], Value]) -> None:
        self._function, self.__doc__ = function, function.__doc__

    def __set_name__(self, _: type, name: str) -> None:
        self._place = f"{name} by precision"

    @overload
    def __get__(self, instance: None, owner: Any = None) -> Self: ...
    @overload
    def __get__(self, instance: object, owner: Any = None) -> Value: ...
    def __get__(self, instance: Any, owner: Any = None) -> Self | Value:
        """Return the cached value, computed again if the current precision exceeds that of the cached value.

        On a class the property itself.
        """
        if instance is None:
            return self
        with _LOCK:  # else the precision could be another thread's, or change while the value is made
            cached: tuple[int, Value] | None = vars(instance).get(self._place)
            if cached is None or cached[0] < ctx.prec:
                vars(instance)[self._place] = cached = ctx.prec, self._function(instance)
        return cached[1]


def rational(x: float | fmpq) -> fmpq:
    """Return a float as an exact rational number; a rational number unchanged.

    Raises OverflowError for an infinite float, ValueError for NaN.
    """
    return x if isinstance(x, fmpq) else fmpq(*x.as_integer_ratio())


def as_rational(x: fmpq | arb) -> fmpq:
    """Return the midpoint of a ball as an exact rational; a rational unchanged."""
    if isinstance(x, fmpq):
        return x
    m, e = (int(n) for n in x.mid().man_exp())
    return fmpq(m << e) if e >= 0 else fmpq(m, 1 << -e)


def root(x: Number) -> Number:
    """Return the square root of a nonnegative number: exact for the square of a rational, else of its own kind.

    That is a ball for a rational or a ball, a `DoubleDouble` for a `DoubleDouble`.
    """
    if not isinstance(x, fmpq):
        return x.sqrt()
    p, q = int(x.p), int(x.q)
    a, b = isqrt(p), isqrt(q)
    return fmpq(a, b) if a * a == p and b * b == q else arb(x).sqrt()


def pi_like(x: Number) -> Number:
    """Return the number pi as a ball for a rational or a ball x, else as a `DoubleDouble`."""
    return arb.pi() if isinstance(x, fmpq | arb) else x.pi


def select(x: Number, positive: Number, alternative: Number) -> Number:
    """Return ``positive`` if x > 0, ``alternative`` otherwise; element by element for `DoubleDouble`."""
    if isinstance(x, fmpq | arb):
        return positive if x > 0 else alternative
    return x.select(positive, alternative)


def dot(a: Vector, b: Vector) -> Number:
    """Return the scalar product of two vectors of the same length."""
    first_product, *other_products = (x * y for x, y in zip(a, b, strict=True))
    return sum(other_products, first_product)


def applied(matrix: Sequence[Vector], vector: Vector) -> list[Number]:
    """Return a matrix, a sequence of rows, times a vector, as a list of components."""
    return [dot(row, vector) for row in matrix]


def quaternion_products(R: Sequence[Sequence[Number]]) -> tuple[tuple[Number, ...], ...]:
    """Return the matrix 4 q_i q_j, four rows, of the quaternion q = (x, y, z, w) of a rotation matrix.

    The row of the largest component has no cancellation.
    """
    trace = R[0][0] + R[1][1] + R[2][2]
    x, y, z = (2 * R[i][i] - trace for i in range(3))
    xy, yz, xz = (R[i][j] + R[j][i] for i, j in ((0, 1), (1, 2), (0, 2)))
    xw, yw, zw = (R[i][j] - R[j][i] for i, j in ((2, 1), (0, 2), (1, 0)))
    return (1 + x, xy, xz, xw), (xy, 1 + y, yz, yw), (xz, yz, 1 + z, zw), (xw, yw, zw, 1 + trace)


def cross(a: Vector, b: Vector) -> tuple[Number, Number, Number]:
    """Return the vector product [a, b] of vectors of three components, as a tuple."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def rotate(q: Vector, v: Vector) -> tuple[Number, ...]:
    """Return the components of v rotated by the quaternion q = (x, y, z, w) of any length but 0."""
    axis, w = q[:3], q[3]
    across_square, axis_square = w * w, dot(axis, axis)
    size, less, twice = across_square + axis_square, across_square - axis_square, dot(axis, v)
    components = zip(v, axis, cross(axis, v), strict=True)
    return tuple((less * x + (twice + twice) * n + (w + w) * y) / size for x, n, y in components)


def length(*components: Number) -> Number:
    """Return the length of the vector with these components: an exact rational where it is one, else as `root`."""
    return root(dot(components, components))


def direction(vector: Vector) -> tuple[Number, ...]:
    """Return the unit vector along a vector, a tuple; (0, ..., 0, 1) for the exact zero vector of rationals."""
    size = length(*vector)
    if isinstance(size, fmpq) and size == 0:
        return *vector[:-1], fmpq(1)
    return tuple(x / size for x in vector)


def unit(vector: Vector) -> list[Number]:
    """Return the unit vector along a nonzero vector, a list; each component is +- sqrt(x^2/|v|^2)."""
    square = dot(vector, vector)
    roots = [(x, root(x * x / square)) for x in vector]
    return [select(x, size, -size) for x, size in roots]


def evaluate_rounded(formula: Callable[..., Any], *inputs: float) -> Any:
    """Evaluate a formula at floats, taken as exact, in 256 binary digits, each result rounded once.

    The result is a float, or a list of floats if the formula returns several numbers.
    """
    return rounded(lambda *x: formula(*map(rational, x)), *inputs)


def rounded(function: Callable[..., Any], *inputs: Any) -> Any:
    """Return function(*inputs), evaluated in 256 binary digits, each result rounded once.

    Inputs are passed as they are: the function makes them exact numbers or balls. The result is a float, or a list of
    floats if the function returns several numbers in a tuple or list. Of a ball the midpoint is rounded, whatever its
    radius.
    """
    with workprec():
        values = function(*inputs)
        return [nearest(x) for x in values] if isinstance(values, tuple | list) else nearest(values)


def nearest(x: fmpq | arb) -> float:
    """Return the double nearest to a rational or a ball's midpoint; beyond the largest, inf of the same sign."""
    if isinstance(x, arb):
        return float(x.mid())
    try:
        return int(x.p) / int(x.q)
    except OverflowError:
        return inf if x > 0 else -inf
