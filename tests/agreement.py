"""Ties of quantities of kernels and balls to the proved form of a ledger entry.

A floor is all that computes in doubles, or all in balls.
A tie names one quantity, reads it from a floor at seeded random points, and says by `proof.formula.value` what the
ledger makes it. `agree` compares: a double within a few ulp, a ball that contains the value.
"""

import ast
import dataclasses
import inspect
import math
import pkgutil
from collections.abc import Callable, Iterable, Iterator, Sequence
from fractions import Fraction
from functools import cache, partial
from importlib import import_module
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import sympy
from flint import arb, fmpq

from atlas.arithmetic.certified_digits import enclosed, numbers
from atlas.bodies.body import SymmetricBody
from atlas.trial.proofs.formula import value

DIGITS = 50
"""Decimal digits of the ledger's value where it isn't rational; a ball has a few more."""

FLOORS = ("kernel", "certified")


class Floor:
    """A floor of the package: its classes by name, and its modules, which hold functions."""

    def __init__(self, name: str) -> None:
        self.name = name

    def __getattr__(self, name: str) -> Any:
        """Return the class or the module of that name."""
        return getattr(self.module(name), name) if name[0].isupper() else import_module(dict(modules(self.name))[name])

    def module(self, cls: str) -> Any:
        """Return the module in which a class is defined."""
        return import_module(_homes(self.name)[cls])

    def owner(self, quantity: str) -> tuple[Any, str]:
        """Return the class or the module that has a quantity, and its name there."""
        owner, name = quantity.split(".")
        return getattr(self, owner), name


@cache
def _homes(floor: str) -> dict[str, str]:
    """Return the module of each class of a floor."""
    return {
        node.name: module
        for _, module in modules(floor)
        for node in ast.parse(source(module)).body
        if isinstance(node, ast.ClassDef)
    }


HOMES = ("bodies", "surfaces", "motions", "maps")
"""Folders of modules that hold quantities."""
NEITHER = ("approximate", "family", "formula", "register")
"""How files are named that hold neither kernels nor balls."""


def modules(floor: str) -> list[tuple[str, str]]:
    """Return the modules of a floor, each with the name of its file, without the floor's own prefix."""
    paths = [*(path for home in HOMES for path in import_module(f"atlas.{home}").__path__)]
    modules_named = [
        (module.name.rpartition(".")[2], module.name)
        for home, path in zip(HOMES, paths, strict=True)
        for module in pkgutil.walk_packages([path], f"atlas.{home}.")
        if not module.ispkg
    ]
    if floor == "certified":
        return [(stem.removeprefix("certified_"), name) for stem, name in modules_named if stem.startswith("certified")]
    return [(stem, name) for stem, name in modules_named if not stem.startswith((*NEITHER, "certified"))]


def source(module: str) -> str:
    """Return the text of a module."""
    return Path(str(import_module(module).__file__)).read_text("utf-8")


class Ledger:
    """Evaluates proved forms and notes their names."""

    def __init__(self) -> None:
        self.names: set[str] = set()

    def __call__(self, name: str, side: str, /, **letters: Any) -> Any:
        """Return the value that an equation gives to a side, see `proof.formula.value`."""
        self.names.add(name)
        return value(name, side, **letters)


Size = Callable[[list[Fraction], Any], float | None]
"""From the true numbers and the point to the size of which an ulp is meant; None for that of each number."""


def own_unit(_true: list[Fraction], _point: Any) -> float | None:
    """Measure every number by itself."""
    return None


def length(true: list[Fraction], _point: Any) -> float:
    """Measure the components of a vector by the largest of them."""
    return float(max(abs(x) for x in true))


def unit(_true: list[Fraction], _point: Any) -> float:
    """Measure the entries of a rotation by 1."""
    return 1.0


def power(degree: int) -> Size:
    """Measure by a power of the largest frequency of the point."""
    return lambda _true, p: float(p.scale**degree)


@dataclasses.dataclass(frozen=True)
class Tie:
    """One quantity, the names that it is tied to, and how.

    quantity  "Class.name" or "module.function"
    names    of the ledger's entries that `truth` evaluates
    read      (floor, point) -> the quantity on a floor
    truth     (ledger, point) -> the value by the entries
    points    where they are compared
    size, ulps  how near a double must be: `ulps` units in the last place of a number of that size
    """

    quantity: str
    names: str
    read: Callable[[Any, Any], Any]
    truth: Callable[[Ledger, Any], Any]
    points: Sequence[Any]
    size: Size = own_unit
    ulps: float = 4.0
    floors: tuple[str, ...] = FLOORS

    def __str__(self) -> str:
        return f"{self.quantity} {self.names}"


def of(make: Callable[[Any, Any], Any], points: Sequence[Any], at: str = "t") -> Callable[..., Tie]:
    """Return a function that ties an object's own quantities, read as they are, a method at the value of a letter.

    make      (floor, point) -> the object
    """

    def tie(quantity: str, names: str, truth: Any, points: Sequence[Any] = points, **more: Any) -> Tie:
        def read(floor: Any, point: Any) -> Any:
            quantity_value = getattr(make(floor, point), quantity.partition(".")[2])
            return quantity_value(getattr(point, at)) if callable(quantity_value) else quantity_value

        return Tie(quantity, names, read, truth, points, **more)

    return tie


GRID = (0.7, 0.31, 3)
"""Start, step and count of the times at which a grid is compared."""


def matrices(
    motion: str, names: str, read: Callable[[Any, Any], Any], truth: Callable[[Ledger, Any, Any], Any],
    points: Sequence[Any], floors: tuple[str, ...] = ("kernel",),
) -> tuple[Tie, ...]:  # fmt: skip
    """Return the ties of R(t): at a time and on a grid, and of its columns, these on some floors.

    read      (floor, point) -> the motion
    truth     (ledger, point, t) -> the matrix that the entries make
    """
    start, step, count = GRID
    times = [sympy.Rational(start) + i * sympy.Rational(step) for i in range(count)]
    tie = partial(Tie, names=names, points=points, size=unit)
    return (
        tie(
            f"{motion}.rotation",
            read=lambda f, p: read(f, p).rotation(p.t),
            truth=lambda say, p: truth(say, p, p.t),
        ),
        tie(
            f"{motion}.rotation_grid",
            read=lambda f, p: read(f, p).rotation_grid(*GRID),
            truth=lambda say, p: [truth(say, p, t) for t in times],
            floors=("kernel",),
        ),
        tie(
            f"{motion}.column",
            read=lambda f, p: [read(f, p).column(j, p.t) for j in (1, 2, 3)],
            truth=lambda say, p: truth(say, p, p.t).T,
            floors=floors,
        ),
        tie(
            f"{motion}.third_axis",
            read=lambda f, p: read(f, p).third_axis(p.t),
            truth=lambda say, p: truth(say, p, p.t).col(2),
            floors=floors,
        ),
    )


def each(ties: Iterable[Tie]) -> Any:
    """Run a test for every tie on every floor that has its quantity."""
    cases = [pytest.param(tie, floor, id=f"{floor} {tie}") for tie in ties for floor in tie.floors]
    return pytest.mark.parametrize(("tie", "floor"), cases)


def agree(tie: Tie, floor: str, points: Sequence[Any] | None = None) -> None:
    """Hold a floor against the ledger at all points of a tie."""
    for point in tie.points if points is None else points:
        ledger = Ledger()
        true = [_fraction(x) for x in _flat(tie.truth(ledger, point))]
        assert ledger.names == set(tie.names.split())
        if floor == "kernel":
            _compare_doubles(tie, point, true)
        else:
            _compare_balls(tie, point, true)


def disagree(ties: Iterable[Tie], *quantities: str, floor: str = "kernel") -> None:
    """Check that the agreement of these quantities, of all their ties, is gone."""
    chosen_ties = [tie for tie in ties if tie.quantity in quantities and floor in tie.floors]
    assert {tie.quantity for tie in chosen_ties} == set(quantities)
    for tie in chosen_ties:
        with pytest.raises(AssertionError):
            agree(tie, floor)


def _compare_doubles(tie: Tie, point: Any, true: list[Fraction]) -> None:
    kernel_numbers = [Fraction(x) for x in _flat(tie.read(Floor("kernel"), point))]
    assert len(kernel_numbers) == len(true), tie
    size = tie.size(true, point)
    for x, y in zip(kernel_numbers, true, strict=True):
        ulp = math.ulp(abs(float(y)) if size is None else size)
        assert abs(x - y) <= tie.ulps * ulp, (str(tie), float(x), float(y), float(abs(x - y)) / ulp)


def _compare_balls(tie: Tie, point: Any, true: list[Fraction]) -> None:
    balls = list(numbers(enclosed(lambda: tie.read(Floor("certified"), point), 200)))
    assert len(balls) == len(true), tie
    for ball, y in zip(balls, true, strict=True):
        middle, radius = (_dyadic(ball.mid()), _dyadic(ball.rad())) if isinstance(ball, arb) else (_dyadic(ball), 0)
        assert radius <= abs(middle) * Fraction(2) ** -199, tie
        assert abs(middle - y) <= radius + abs(y) * Fraction(10) ** (1 - DIGITS), (str(tie), float(middle), float(y))


def _dyadic(x: arb | fmpq) -> Fraction:
    if isinstance(x, fmpq):
        return Fraction(int(x.p), int(x.q))
    mantissa, exponent = x.man_exp()
    return Fraction(int(mantissa)) * Fraction(2) ** int(exponent)


def _fraction(x: Any) -> Fraction:
    """Return a real SymPy number exactly where it is rational, else to DIGITS digits."""
    x = sympy.sympify(x)
    if x.is_Rational:
        return Fraction(int(x.p), int(x.q))
    number = x.evalf(DIGITS, maxn=1000)
    assert number.is_Float, x
    sign, mantissa, exponent, _ = number._mpf_
    return Fraction(-int(mantissa) if sign else int(mantissa)) * Fraction(2) ** int(exponent)


def _flat(value: Any) -> Iterator[Any]:
    """Go through the numbers of whatever a quantity comes as."""
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        value = dataclasses.astuple(value)
    if isinstance(value, dict):
        value = value.values()
    if isinstance(value, np.ndarray):
        yield from value.ravel().tolist()
    elif isinstance(value, sympy.MatrixBase) or (hasattr(value, "__iter__") and not isinstance(value, sympy.Basic)):
        for entry in value:
            yield from _flat(entry)
    else:
        yield value


def negated(value: Any) -> Any:
    """Return a quantity with the sign turned round; of several numbers all but the first; of a motion all it says."""
    if isinstance(value, dict):
        return dict(zip(value, negated(list(value.values())), strict=True))
    if isinstance(value, list | tuple):
        return type(value)([*value[:1], *map(negated, value[1:])])
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        members = {field.name: getattr(value, field.name) for field in dataclasses.fields(value)}
        return dataclasses.replace(value, **negated(members))
    return -value if hasattr(value, "__neg__") else _Mirror(value)


class _Mirror:
    """A motion whose methods return the opposite."""

    def __init__(self, motion: Any) -> None:
        self._motion = motion

    def __getattr__(self, name: str) -> Any:
        """Return a method that negates."""
        return lambda *arguments: negated(getattr(self._motion, name)(*arguments))


def negate(monkeypatch: pytest.MonkeyPatch, quantity: str, floor: str) -> None:
    """Put a quantity of a floor under the wrong sign."""
    owner, name = Floor(floor).owner(quantity)
    was = inspect.getattr_static(owner, name, None)
    if was is None:
        _negate_attribute(monkeypatch, owner, name)
    elif isinstance(was, classmethod):
        negated_method = classmethod(lambda cls, *a, **k: negated(was.__func__(cls, *a, **k)))
        monkeypatch.setattr(owner, name, negated_method)
    elif callable(was):
        monkeypatch.setattr(owner, name, lambda *a, **k: negated(was(*a, **k)))
    else:
        monkeypatch.setattr(owner, name, property(lambda self: negated(was.__get__(self, type(self)))))


def _negate_attribute(monkeypatch: pytest.MonkeyPatch, owner: Any, name: str) -> None:
    """Negate the fields that `__init__` sets."""
    begin = owner.__init__

    def begin_wrongly(self: Any, *arguments: Any, **named: Any) -> None:
        begin(self, *arguments, **named)
        object.__setattr__(self, name, negated(getattr(self, name)))

    monkeypatch.setattr(owner, "__init__", begin_wrongly)


def signed(draw: np.random.Generator) -> float:
    """Return a number of either sign, of the size of 1."""
    return float(draw.choice((-1, 1)) * draw.uniform(0.1, 4))


def vector(draw: np.random.Generator) -> tuple[float, ...]:
    """Return three such numbers."""
    return tuple(signed(draw) for _ in range(3))


def bodies(seed: int, count: int = 6, **fixed: Any) -> list[Any]:
    """Return states of symmetric bodies in a field: letters as in the paper, B2 and B3 of either sign.

    The body is a ratio, 1 and 2 among them, or its two moments, which no double has the quotient of; `I` is exact.
    `fixed` are letters with the same value at every point, or with that of a function of the point.
    """
    draw, points = np.random.default_rng(seed), []
    for n in range(count):
        I2 = draw.uniform(0.5, 3)
        body = (draw.uniform(0.05, 2), SymmetricBody(I2, I2 * draw.uniform(0.05, 1.95)), 1.0, 2.0)[n % 4]
        p = SimpleNamespace(body=body, B2=signed(draw), B3=signed(draw), t=5 * signed(draw), u=signed(draw))
        p.omega, p.K, p.point = vector(draw), vector(draw), vector(draw)
        for name, entry in fixed.items():
            setattr(p, name, entry(p) if callable(entry) else entry)
        moments = (p.body.I2, p.body.I3) if isinstance(p.body, SymmetricBody) else (1.0, p.body)
        p.I2, p.I3 = (sympy.Rational(x) for x in moments)
        p.I, p.field = p.I3 / p.I2, (p.B2, p.B3)
        p.omega1, p.omega2, p.omega3 = p.omega
        p.scale = max(map(abs, (*p.omega, *p.K, *p.field, p.u)))
        points.append(p)
    return points


def letters(p: Any, names: str) -> dict[str, Any]:
    """Return the values of some letters of a point."""
    return {name: getattr(p, name) for name in names.split()}


def unit_field(p: Any) -> dict[str, Any]:
    """Return the letters hB2 and hB3: B'/|B'|."""
    B2, B3 = sympy.Rational(p.B2), sympy.Rational(p.B3)
    b = sympy.sqrt(B2**2 + B3**2)
    return {"hB2": B2 / b, "hB3": B3 / b}


def elementary(say: Ledger, p: Any) -> dict[str, Any]:
    """Return the letters omega3, phi and k of the elementary motion that starts with omega2, by (71), (72), (79)."""
    inputs = letters(p, "omega2 I B2 B3")
    k = say("(79)", "k", omega2=p.omega2, **unit_field(p))
    return {"omega3": say("(71)", "omega3", **inputs), "phi": say("(72)", "phi", **inputs), "k": k}


def rotation(say: Ledger, p: Any, t: Any) -> Any:
    """Return R(t) of (84)."""
    constants = elementary(say, p)
    return say("(84)", "R", k=constants["k"], phi=constants["phi"], t=t, **unit_field(p))
