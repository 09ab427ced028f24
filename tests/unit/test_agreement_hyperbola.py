"""Hyperbola: core and exact agree with the ledger's (67) to (79) and the theorems on stability."""

import dataclasses
from typing import Any

import pytest
import sympy
from agreement import Floor, Ledger, Tie, agree, bodies, disagree, each, elementary, letters, of

from atlas.trial.ledger import EQUATIONS
from atlas.trial.proofs import formula
from atlas.trial.proofs.run import trial

POINTS = bodies(72, 8)
BAND = [*bodies(8, 3, body=0.3, B3=lambda p: p.B2 / 4), *bodies(9, 3, body=0.85, B3=lambda p: -p.B2 / 9)]
FOLDED = [p for p in [*POINTS, *BAND] if p.I != 1 and p.B3]
"""Points whose curve has a least stability, and not at the pole."""


def ordinate(say: Ledger, p: Any, omega2: Any) -> Any:
    """Return omega3 of (71) at another omega2."""
    return say("(71)", "omega3", omega2=omega2, **letters(p, "I B2 B3"))


def zeros(curve: Any, omega2: Any) -> list[Any]:
    """Return where a rational function vanishes, the origin apart."""
    return [x for x in sympy.roots(sympy.numer(sympy.cancel(curve)), omega2) if x != 0]


def special(say: Ledger, p: Any) -> list[Any]:
    """Rest; the other point where phi of (72) is zero; the other one where omega3 of (71) is."""
    omega2 = sympy.Symbol("omega2")
    generic = say("(72)", "phi", omega2=omega2, I=sympy.Rational(1, 2), **letters(p, "B2 B3"))  # for I = 1 phi is 0
    (omega2_still,) = zeros(generic, omega2)
    level = zeros(ordinate(say, p, omega2) * (omega2 + sympy.Rational(p.B2)), omega2) or [0]
    return [0, ordinate(say, p, 0), omega2_still, ordinate(say, p, omega2_still), *level, 0]


def pole(say: Ledger, p: Any) -> Any:
    """Return the pole of (71)."""
    omega2 = sympy.Symbol("omega2")
    generic = say(
        "(71)", "omega3", omega2=omega2, I=sympy.Rational(1, 2), **letters(p, "B2 B3")
    )  # for I = 1 it cancels
    return sympy.solve(sympy.denom(sympy.cancel(generic)), omega2)


def asymptotes(say: Ledger, p: Any) -> list[Any]:
    """Directions in which (67) is satisfied far away: the zeros of its terms of the second degree."""
    x, y, scale = sympy.symbols("x y far")
    curve = say("(67)", "0", omega2=scale * x, omega3=scale * y, **letters(p, "I B2 B3"))
    form = sympy.Poly(sympy.expand(curve), scale).coeff_monomial(scale**2)
    assert form.subs(x, 0) == 0
    slope = sympy.solve(sympy.cancel(form / x), y)[0] / x
    cosine = 1 / sympy.sqrt(1 + slope**2) * (1 if p.B2 > 0 else -1)
    return [0, 1, cosine, cosine * slope]


def stability(say: Ledger, p: Any) -> Any:
    """Return minus the slope of the cubic."""
    B2, B3, omega2 = (sympy.Rational(x) for x in (p.B2, p.B3, p.omega2))
    return say("theorem-stability", "nun2", I=p.I, B2=B2, tau=B3 / B2, x=(omega2 + B2) / B2)


def least(say: Ledger, p: Any) -> Any:
    """Return the least of minus the slope, at a zero of its derivative by x."""
    B2, B3, I = (sympy.Rational(value) for value in (p.B2, p.B3, p.I))
    x = sympy.Symbol("x", positive=True)
    curve = say("theorem-stability", "nun2", I=I, B2=B2, tau=B3 / B2, x=x)
    (place,) = (root for root in sympy.real_roots(sympy.numer(sympy.together(sympy.diff(curve, x)))) if root > 0)
    return curve.subs(x, place)


def band(say: Ledger, p: Any) -> list[Any]:
    """Return y-, y+."""
    t2 = (sympy.Rational(p.B3) / sympy.Rational(p.B2)) ** 2
    return [say("theorem-band", name, I=p.I, t2=t2) for name in ("ym", "yp")]


def curve(f: Floor, p: Any) -> Any:
    """Return the curve of a point on a floor."""
    return f.Hyperbola(p.body, p.field)


of_curve = of(curve, POINTS, at="omega2")

TIES = (
    of_curve("Hyperbola.omega3", "(71)", lambda say, p: ordinate(say, p, p.omega2)),
    of_curve(
        "Hyperbola.frequencies", "(71) (72) (79)", lambda say, p: [elementary(say, p)[name] for name in ("k", "phi")]
    ),
    of_curve("Hyperbola.pole", "(71)", pole),
    of_curve("Hyperbola.special", "(71) (72)", special),
    of_curve("Hyperbola.asymptotes", "(67)", asymptotes),
    of_curve("Hyperbola.stability", "theorem-stability", stability, [*POINTS, *BAND]),
    of_curve("Hyperbola.least_stability", "theorem-stability", least, FOLDED),
    of_curve("Hyperbola.unstable_band", "theorem-band", band, BAND),
    Tie(
        "Hyperbola.sample",
        "(71)",
        lambda f, p: curve(f, p).sample(7)[1],
        lambda say, p: [ordinate(say, p, x) for x in curve(Floor("kernel"), p).sample(7)[0]],
        POINTS[:4],
        floors=("kernel",),
    ),
    Tie(
        "Hyperbola.branches",
        "(71)",
        lambda f, p: [omega3 for _, omega3 in curve(f, p).branches(6)],
        lambda say, p: [ordinate(say, p, x) for omega2, _ in curve(Floor("kernel"), p).branches(6) for x in omega2],
        POINTS[:4],
        floors=("kernel",),
    ),
)


@each(TIES)
def test_the_hyperbola_agrees_with_the_ledger(tie: Tie, floor: str) -> None:
    """Its points, where it begins and ends, its frequencies and its stability."""
    agree(tie, floor)


def test_a_wrong_sign_in_the_ledger_is_noticed_in_doubles_and_in_balls(monkeypatch: pytest.MonkeyPatch) -> None:
    """Doubles and balls notice (omega2 - 2 B2) for (omega2 + 2 B2) in the tried form of (72)."""
    trial_right = formula.trial("(72)")
    trial_wrong = dataclasses.replace(trial_right, tex=EQUATIONS["(72)"].tex.replace("+2B", "-2B"))
    assert trial_wrong.printed != trial_right.printed
    monkeypatch.setattr(formula, "trial", lambda name: trial_wrong if name == "(72)" else trial(name))
    disagree(TIES, "Hyperbola.frequencies", "Hyperbola.special")
    disagree(TIES, "Hyperbola.frequencies", "Hyperbola.special", floor="certified")
