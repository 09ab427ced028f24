"""Closed motions on trial: the elementary motion with phi/k = r, and the free body beside it."""

from functools import cache

import sympy

from atlas.proof.model import Model, Value, turn
from atlas.proof.trial import Falsehood, Trial

I, b = sympy.symbols("I b", positive=True)
omega2, r, k = sympy.symbols("omega2 r k", real=True)
h2, h3, p = sympy.symbols("h2 h3 p", real=True)


@cache
def closed_model() -> Model:
    """Model a point of the hyperbola with phi of (72) and k of (79), and any number r."""
    B2, B3 = b * h2, b * h3
    phi = B3 * omega2 * (1 - I) * (omega2 + 2 * B2) / (I * B2 * (omega2 + B2))
    letters: dict[str, Value] = {"I": I, "b": b, "hB2": h2, "hB3": h3, "r": r, "k": omega2 / h2, "phi": phi}
    letters |= {"free": (1 - I) / I * h3 * omega2 / h2, "at": lambda f, value: f.subs(omega2, h2 * value)}
    return Model(letters, [(h2, turn(p)[1]), (h3, turn(p)[0])])


TRIALS = (
    Trial(
        name="theorem-closed",
        tried="I*(b + k)*(phi/k - r) = ((1 - I)*hB3 - I*r)*k + (2*(1 - I)*hB3 - I*r)*b;"
        " kr = -b*(2*(1 - I)*hB3 - I*r)/((1 - I)*hB3 - I*r); at(phi,kr)/kr = r; I*(b + kr)*((1 - I)*hB3 - I*r)"
        " = -I*b*(1 - I)*hB3",
        model=closed_model,
        follows="@(72) and @(79)",
        defines=("kr",),
        note="The first relation is linear in $k$: one root, none where the coefficient of $k$ is 0. By the last one "
        r"$b + k_\varrho$ is not 0 if $I$ differs from 1; $k_\varrho$ is 0 for the second $\varrho$ that is left out.",
        false=Falsehood(
            "The sense of precession is the other one",
            "kr = -b*(2*(1 - I)*hB3",
            "kr = b*(2*(1 - I)*hB3",
        ),
    ),
    Trial(
        name="theorem-closed-free",
        tried="phi/free = (2*b + k)/(b + k)",
        model=closed_model,
        follows="@(72), @(79) and @(87)",
        false=Falsehood(
            "The field does not change the proper rotation",
            "(2*b + k)/(b + k)",
            "1",
        ),
    ),
)
