"""Quadric: core and exact agree with the ledger's (51) to (57)."""

from typing import Any

import sympy
from agreement import Ledger, Tie, agree, bodies, each, length, letters, of

POINTS = bodies(58, 8)
TWO_SHEETS = bodies(61, 3, body=1.7)
ONE_SHEET = bodies(63, 3, body=0.3)


def beta(say: Ledger, p: Any) -> Any:
    """Angle of I^-1 B', whose tangent text-beta gives, in the quadrant of (I B2, B3)."""
    acute = sympy.atan(say("text-beta", "tan(beta)", **letters(p, "I B2 B3")))
    return acute if p.B2 > 0 else acute + (sympy.pi if p.B3 > 0 else -sympy.pi)


def coordinates(say: Ledger, p: Any, omega: Any) -> list[Any]:
    """Coordinates (53) of a point."""
    start = dict(zip(("omega1", "omega2", "omega3"), omega, strict=True))
    return [say("(53)", name, beta=beta(say, p), **start, **letters(p, "B2 B3")) for name in ("w1", "w2", "w3")]


def axes(say: Ledger, p: Any) -> Any:
    """Rows of (53): changes of the coordinates along e1, e2, e3."""
    steps = [[int(i == j) - sympy.Rational(b) for j, b in enumerate((0, p.B2, p.B3))] for i in range(3)]
    return sympy.Matrix([coordinates(say, p, omega) for omega in steps]).T


def centre(say: Ledger, p: Any) -> Any:
    """Point whose coordinates are zero, by those of the origin."""
    return -axes(say, p).T * sympy.Matrix(coordinates(say, p, (0, 0, 0)))


def semi_axes(say: Ledger, p: Any) -> list[Any]:
    """Roots of the squares of (55) or (57), which have the sign of B3."""
    entry = "(55)" if p.I > 1 else "(57)"
    squares = [say(entry, name, beta=beta(say, p), **letters(p, "I B2")) for name in ("C1s", "C2s", "C3s")]
    return [sympy.sqrt(abs(square)) for square in squares]


def off_canonical(say: Ledger, p: Any) -> Any:
    """Left side of (54) less the right one, times B3: the left side of (50)."""
    w = dict(zip(("w1", "w2", "w3"), coordinates(say, p, p.omega), strict=True))
    a = {name: say("(54)", name, beta=beta(say, p)) for name in ("a2", "a3")}
    left_side = say("(54)", "(1 - I)*B2^2", **w, **a)
    return ((left_side - (1 - p.I) * sympy.Rational(p.B2) ** 2) * sympy.Rational(p.B3)).evalf(60)


of_quadric = of(lambda f, p: f.Quadric(p.body, p.field), POINTS, at="omega")

TIES = (
    of_quadric("Quadric.beta", "text-beta", beta),
    of_quadric("Quadric.a2", "(54) text-beta", lambda say, p: say("(54)", "a2", beta=beta(say, p))),
    of_quadric("Quadric.a3", "(54) text-beta", lambda say, p: say("(54)", "a3", beta=beta(say, p))),
    of_quadric("Quadric.semi_axes", "(55) text-beta", semi_axes, TWO_SHEETS),
    of_quadric("Quadric.semi_axes", "(57) text-beta", semi_axes, ONE_SHEET),
    of_quadric("Quadric.centre", "(53) text-beta", centre),
    of_quadric("Quadric.axes", "(53) text-beta", axes),
    of_quadric("Quadric.canonical", "(53) text-beta", lambda say, p: coordinates(say, p, p.omega), size=length),
    of_quadric(
        "Quadric.residual", "(50)", lambda say, p: say("(50)", "0", **letters(p, "I B2 B3 omega1 omega2 omega3"))
    ),
    of_quadric("Quadric.residual", "(54) (53) text-beta", off_canonical, POINTS[:3]),
)


@each(TIES)
def test_the_quadric_agrees_with_the_ledger(tie: Tie, floor: str) -> None:
    """Shape, frame and residual of any point."""
    agree(tie, floor)
