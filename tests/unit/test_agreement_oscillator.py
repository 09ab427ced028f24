"""Integrals and pseudo-oscillator: core agrees with the ledger's (36) to (49)."""

from functools import partial
from typing import Any

import pytest
import sympy
from agreement import Floor, Ledger, Tie, agree, bodies, disagree, each, letters, of, power

from atlas.motions.nutation import pseudo_oscillator

POINTS = bodies(55, 8)
in_core = partial(Tie, points=POINTS, floors=("kernel",))


def oscillator(f: Floor, p: Any) -> Any:
    """Return the oscillator of a point on a floor."""
    return f.PseudoOscillator(p.body, p.field, p.omega)


def state(p: Any) -> dict[str, Any]:
    """Return the letters Omega1 ... K3 of a moving body."""
    return {
        f"{name}{n + 1}": x for name in ("Omega", "K") for n, x in enumerate(getattr(p, name.replace("Omega", "omega")))
    }


def at_start(say: Ledger, p: Any) -> dict[str, Any]:
    """Return E', K^2, c3, c5 by their values at t = 0."""
    inputs = letters(p, "I B2 B3 omega1 omega2 omega3")
    sides = {"E": ("(36)", "at0(E)"), "Bsquare": ("(37)", "at0(K^2)")}
    sides |= {"c3": ("(40)", "at0(c3)"), "c5": ("(41)", "at0(c5)")}
    return {name: say(entry, side, **inputs) for name, (entry, side) in sides.items()}


def in_motion(say: Ledger, p: Any) -> dict[str, Any]:
    """Return the same of any state."""
    integrals = {"E": say("(36)", "E", I=p.I, **state(p)), "Bsquare": say("(37)", "0", d=lambda x: x, K=p.K)}
    integrals["c3"] = say("(40)", "c3", **state(p))
    return integrals | {"c5": say("(41)", "c5", I=p.I, c3=integrals["c3"], **state(p))}


def cubic(say: Ledger, p: Any, conserved: dict[str, Any]) -> dict[str, Any]:
    """Return a0 ... a3 of (48) as corrected."""
    return {name: say("(48)", name, I=p.I, **conserved) for name in ("a0", "a1", "a2", "a3")}


def acceleration(say: Ledger, p: Any, u: Any) -> Any:
    """Return the cubic of (47) at u."""
    return say("(47)", "d2(Omega3)", Omega3=u, **cubic(say, p, at_start(say, p)))


def stiffness(say: Ledger, p: Any) -> Any:
    """Return its slope at u."""
    u = sympy.Symbol("u")
    return acceleration(say, p, u).diff(u).subs(u, sympy.Rational(p.u))


def quartic(say: Ledger, p: Any, u: Any, conserved: dict[str, Any]) -> Any:
    """Return the first integral at u."""
    return say("theorem-quartic", "Q(u)", I=p.I, u=u, **conserved)


def powers(Q: Any, u: Any) -> list[Any]:
    """Return the coefficients of a quartic, the lowest first."""
    return [sympy.Poly(sympy.expand(Q), u).coeff_monomial(u**n) for n in range(5)]


INTEGRALS = "(36) (37) (40) (41)"

of_oscillator = partial(of(oscillator, POINTS, at="u"), floors=("kernel",))

TIES = (
    in_core(
        "integrals.integrals",
        INTEGRALS,
        lambda f, p: f.integrals.integrals(p.body, p.omega, p.K),
        lambda say, p: in_motion(say, p).values(),
        size=power(2),
    ),
    in_core(
        "integrals.shape_factors",
        "(33)",
        lambda f, p: f.integrals.shape_factors(p.body),
        lambda say, p: [n + s * say("(33)", "I", I3=p.I3, I2=p.I2) for n, s in ((0, 1), (1, -1), (2, -1))],
    ),
    of_oscillator("PseudoOscillator.integrals", INTEGRALS, lambda say, p: at_start(say, p).values(), size=power(2)),
    of_oscillator(
        "PseudoOscillator.coefficients",
        f"{INTEGRALS} (48)",
        lambda say, p: cubic(say, p, at_start(say, p)).values(),
        size=power(3),
        ulps=16,
    ),
    of_oscillator(
        "PseudoOscillator.acceleration",
        f"{INTEGRALS} (47) (48)",
        lambda say, p: acceleration(say, p, p.u),
        size=power(3),
        ulps=16,
    ),
    of_oscillator(
        "PseudoOscillator.acceleration",
        "(37) (49)",
        lambda say, p: say(
            "(49)",
            "ddOmega3",
            Omega3=p.u,
            Bsquare=say("(37)", "at0(K^2)", **letters(p, "B2 B3")),
            **letters(p, "I B2 B3 omega1 omega2 omega3"),
        ),
        size=power(3),
        ulps=16,
    ),
    of_oscillator("PseudoOscillator.stiffness", f"{INTEGRALS} (47) (48)", stiffness, size=power(2), ulps=64),
    of_oscillator(
        "PseudoOscillator.quartic",
        f"{INTEGRALS} theorem-quartic",
        lambda say, p: quartic(say, p, p.u, at_start(say, p)),
        size=power(4),
        ulps=64,
    ),
)


@each(TIES)
def test_the_motion_of_omega3_agrees_with_the_ledger(tie: Tie, floor: str) -> None:
    """Its integrals, its cubic and its quartic."""
    agree(tie, floor)


def test_the_paper_s_slip_in_equation_48_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    """(2-1)^2 for (2-I)^2, as printed: the kernel holds the corrected form, and so does the ledger."""
    cubic = pseudo_oscillator.cubic

    def printed(I: Any, E: Any, K2: Any, c3: Any, c5: Any, factors: Any) -> Any:
        a0, _, a2, a3 = cubic(I, E, K2, c3, c5, factors)
        return a0, -2 * c5 + (I - 1) * c3**2 - E - I * K2, a2, a3

    monkeypatch.setattr(pseudo_oscillator, "cubic", printed)
    disagree(TIES, "PseudoOscillator.coefficients", "PseudoOscillator.stiffness")
