"""Model of a trial: the letters of a claim with their values, rates, starts and domains."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import sympy

Value = Any


class _Indexed:
    """A function of two or more integer indices, called with square brackets as eps[i, j, k]."""

    def __init__(self, function: Callable[..., Value]) -> None:
        self.function = function

    def __getitem__(self, indices: tuple[int, ...]) -> Value:
        return self.function(*indices)


def require(fact: Any) -> None:
    """Raise ArithmeticError if ``fact``, a premise on which a model is built, is false."""
    if not fact:
        raise ArithmeticError("a model builds on something that isn't so")


def cross(a: Value, b: Value) -> Value:
    """Return the vector product [a, b] of two columns (3, 1), as a column."""
    return a.cross(b)


def partial(value: Value, by: Value) -> Value:
    """Return the derivative of ``value`` by a symbol, entry by entry, or by a column of N symbols.

    By a column it is the gradient (N, 1) of an expression, or the Jacobian of a column, entry (i, j) = d value_i/d
    by_j.
    """
    if not isinstance(by, sympy.MatrixBase):
        return sympy.diff(value, by)
    return sympy.Matrix([value]).jacobian(by).T if not isinstance(value, sympy.MatrixBase) else value.jacobian(by)


def dot(a: Value, b: Value) -> Value:
    """Return the scalar product (a, b) of two columns, one expression."""
    return a.dot(b)


def entrywise(act: Callable[[Value], Value]) -> Callable[[Value], Value]:
    """Return a function that applies ``act``, a function of one number, to a number or to every entry of a matrix."""
    return lambda value: value.applyfunc(act) if isinstance(value, sympy.MatrixBase) else act(sympy.sympify(value))


COMMON: dict[str, Value] = {
    "eps": _Indexed(sympy.LeviCivita),
    "delta": _Indexed(sympy.KroneckerDelta),
    "cross": cross,
    "dot": dot,
    "partial": partial,
    "det": lambda matrix: matrix.det(method="berkowitz"),
    "T": lambda matrix: matrix.T,
    "inv": lambda matrix: matrix.inv(),
    "diag": sympy.diag,
    "tr": lambda matrix: matrix.trace(),
    "abs": entrywise(sympy.Abs),
    "norm": lambda vector: sympy.sqrt(sympy.factor(vector.dot(vector))),
    "hat": lambda v: hat(v),  # noqa: PLW0108  hat is defined below
    "sqrt": entrywise(lambda x: sympy.sqrt(sympy.factor(x))),
    "ln": entrywise(sympy.log),
    "sin": entrywise(sympy.sin),
    "cos": entrywise(sympy.cos),
    "tan": entrywise(sympy.tan),
    "atan": entrywise(sympy.atan),
    **{name: getattr(sympy, name) for name in ("exp", "cosh", "sinh", "tanh")},
    "i": sympy.I,
    "pi": sympy.pi,
    "one": sympy.eye(3),
}


def vector(name: str, **assumed: bool) -> Value:
    """Return the column (3, 1) of symbols name1, name2, name3, real unless other assumptions of SymPy are given.

    ``assumed`` are such assumptions by name: positive=True.
    """
    return sympy.Matrix(sympy.symbols(f"{name}1:4", **(assumed or {"real": True})))


def matrix(name: str) -> Value:
    """Return the matrix (3, 3) of nine real symbols name11 ... name33."""
    return sympy.Matrix(3, 3, lambda i, j: sympy.Symbol(f"{name}{i + 1}{j + 1}", real=True))


def symmetric(name: str) -> Value:
    """Return the symmetric matrix (3, 3) of six real symbols name11, name12, ... name33."""
    return sympy.Matrix(3, 3, lambda i, j: sympy.Symbol(f"{name}{min(i, j) + 1}{max(i, j) + 1}", real=True))


def hat(v: Value) -> Value:
    """Return the antisymmetric matrix (3, 3) whose product with a column x is the vector product [v, x]."""
    return sympy.Matrix([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def direction() -> Value:
    """Return a unit vector (3, 1), rational in real symbols x, y: any but -e3 (stereographic projection)."""
    x, y = sympy.symbols("x y", real=True)
    return sympy.Matrix([2 * x, 2 * y, 1 - x**2 - y**2]) / (1 + x**2 + y**2)


def rotation(name: str = "q") -> Value:
    """Return a rotation matrix (3, 3), rational in three real symbols name1, name2, name3 (Cayley's formula).

    It is any rotation but one by a half turn.
    """
    x, y, z = sympy.symbols(f"{name}1:4", real=True)
    n = 1 + x**2 + y**2 + z**2
    return (
        sympy.Matrix(
            [
                [1 + x**2 - y**2 - z**2, 2 * (x * y - z), 2 * (x * z + y)],
                [2 * (x * y + z), 1 - x**2 + y**2 - z**2, 2 * (y * z - x)],
                [2 * (x * z - y), 2 * (y * z + x), 1 - x**2 - y**2 + z**2],
            ]
        )
        / n
    )


def rotation_symbols(name: str = "R") -> tuple[Value, list[tuple[Value, Value]]]:
    """Return (matrix (3, 3) of nine symbols, see `matrix`; nine pairs (symbol, entry of `rotation`)).

    ``name`` stands before the two digits of each symbol.
    """
    symbols = matrix(name)
    return symbols, list(zip(symbols, rotation(), strict=True))


def rodrigues(axis: Value, cosine: Value, sine: Value) -> Value:
    """Return the matrix (3, 3) of the right-handed rotation about a unit vector ``axis`` (3, 1).

    The angle is given by its cosine and sine.
    """
    return cosine * sympy.eye(3) + (1 - cosine) * axis * axis.T + sine * hat(axis)


def turn(p: Value) -> tuple[Value, Value]:
    """Return (cosine, sine) of the angle with tan(angle/2) = p: every angle but pi."""
    return (1 - p**2) / (1 + p**2), 2 * p / (1 + p**2)


def functions(name: str, value: Value, variable: Value) -> dict[str, Callable[[Value], Value]]:
    """Return four functions by name, q, dq, ddq, dddq for the name "q": an expression and its first three derivatives.

    q is ``value`` as a function of ``variable``, a symbol in it; each function takes one number or expression.
    """

    def derivative(order: int) -> Callable[[Value], Value]:
        return lambda argument: sympy.diff(value, variable, order).xreplace({variable: argument})

    return {"d" * order + name: derivative(order) for order in range(4)}


@dataclass
class Model:
    """Letters of a claim, and the symbols in them.

    letters  value of each name of the printed line: expressions, vectors and matrices in symbols, or functions;
             of a vector K its components K1, K2, K3 too, unless these are something else
    bindings pairs (symbol, value in free parameters): a value may contain other symbols of the list
    flow     rates in time of the symbols that move; `d` and `d2` of a line follow from it
    start    values at t = 0 of the symbols that move; `at0` of a line follows from it
    phases   angles whose cosine and sine are symbols: angle -> (cosine, sine)
    domains  where the free parameters may lie: a key of `decide.DOMAINS`; real if not said
    ranges   the values of indices that count particles
    laws     equations from which the rates are taken, by number; printed beside the rates in a script
    """

    letters: dict[str, Value]
    bindings: list[tuple[Value, Value]] = field(default_factory=list)
    flow: Mapping[Value, Value] = field(default_factory=dict)
    start: Mapping[Value, Value] = field(default_factory=dict)
    phases: Mapping[Value, tuple[Value, Value]] = field(default_factory=dict)
    domains: Mapping[str, str] = field(default_factory=dict)
    ranges: Mapping[str, tuple[int, ...]] = field(default_factory=dict)
    laws: str = ""

    def __post_init__(self) -> None:
        """Complete `letters` by `COMMON`, components K1, K2, K3 of each vector K, and functions of this model.

        These are `d` and `d2` where the model has a `flow`, `at0` where it has a `start`, and `cos`, `sin`, `tan` where
        it has `phases`. A letter given by the caller replaces one of `COMMON` or a component, but none of these
        functions.
        """
        vectors = [(name, value) for name, value in self.letters.items() if getattr(value, "shape", ()) == (3, 1)]
        operators: dict[str, Value] = {}
        if self.flow:
            time = self.letters.get("t")
            self.flow = {time: sympy.Integer(1), **self.flow} if isinstance(time, sympy.Symbol) else self.flow
            operators |= {"d": entrywise(self.rate), "d2": entrywise(lambda x: self.rate(self.rate(x)))}
        if self.start:
            operators["at0"] = entrywise(lambda x: x.subs(dict(self.start), simultaneous=True))
        if self.phases:
            operators["cos"] = entrywise(lambda angle: self._cosine_sine(angle)[0])
            operators["sin"] = entrywise(lambda angle: self._cosine_sine(angle)[1])
            operators["tan"] = entrywise(lambda angle: self._cosine_sine(angle)[1] / self._cosine_sine(angle)[0])
        components = {f"{name}{n}": value[n - 1] for name, value in vectors for n in (1, 2, 3)}
        self.letters = {**COMMON, **components, **self.letters, **operators}

    def rate(self, value: Value) -> Value:
        """Return the time derivative of an expression, by the rates of the symbols in `flow`."""
        return sum((sympy.diff(value, x) * rate for x, rate in self.flow.items() if value.has(x)), sympy.Integer(0))

    def rotation_about(self, axis: Value) -> Callable[[Value], Value]:
        """Return a function from an angle to the matrix (3, 3) of the right-handed rotation about a unit vector.

        Integer multiples of `phases` enter by the symbols of their cosines and sines.
        """
        return lambda angle: rodrigues(axis, *self._cosine_sine(angle))

    def _cosine_sine(self, angle: Value) -> tuple[Value, Value]:
        """Return (cosine, sine) of an angle; integer multiples of `phases` as polynomials in their cosines and sines.

        Of any other term of the angle these are SymPy's cos and sin.
        """
        c, s = sympy.Integer(1), sympy.Integer(0)
        basis = any(sympy.cancel(angle / phase).is_Integer for phase in self.phases)
        for term in [angle] if basis else sympy.Add.make_args(sympy.expand(angle)):
            for phase, (cosine, sine) in self.phases.items():
                times = sympy.cancel(term / phase)
                if times.is_Integer:
                    power = sympy.expand((cosine + sympy.I * sine * sympy.sign(times)) ** abs(int(times)))
                    pair = power.subs(sympy.I, 0), sympy.expand((power - power.subs(sympy.I, 0)) / sympy.I)
                    break
            else:
                pair = sympy.cos(term), sympy.sin(term)
            c, s = c * pair[0] - s * pair[1], s * pair[0] + c * pair[1]
        return c, s
