"""Closed motions on trial: the elementary motion with phi/k = r, and the free body beside it."""

import sympy

from atlas.trial.proofs.model import Model, turn
from atlas.trial.proofs.trial import Falsehood, Trial

SIGNS = {r"\hat B_3": "hB3", r"\varrho": "r"}
I, b = sympy.symbols("I b", positive=True)
omega2, r, k = sympy.symbols("omega2 r k", real=True)
h2, h3, p = sympy.symbols("h2 h3 p", real=True)


def closed_model() -> Model:
    """Return the model of a point of the hyperbola (67) with phi of (72) as a function of k (79), and any number r.

    `free` is the rate of proper rotation of the free body with this k; hB3 = B3/b. It serves theorem-closed and
    theorem-closed-free.
    """
    B2, B3 = b * h2, b * h3
    phi = B3 * omega2 * (1 - I) * (omega2 + 2 * B2) / (I * B2 * (omega2 + B2))
    letters = {"I": I, "b": b, "hB3": h3, "r": r, "k": k, "phi": sympy.cancel(phi.subs(omega2, k * h2))}
    return Model({**letters, "free": (1 - I) / I * h3 * k}, [(h2, turn(p)[1]), (h3, turn(p)[0])])


TRIALS = {
    "theorem-closed": Trial(
        model=closed_model,
        signs={r"\varrho\ne\frac{(1-I)\hat B_3}{I},\ \frac{2(1-I)\hat B_3}{I}": ""},
        defines=("k",),
        solves="I*(b + k)*((1 - I)*hB3 - I*r) = -I*b*(1 - I)*hB3",
        arrows={1: "I*(b + k)*(phi/k - r) = ((1 - I)*hB3 - I*r)*k + (2*(1 - I)*hB3 - I*r)*b"},
        false=Falsehood("k = -b*", "k = b*"),
    ),
    "theorem-closed-free": Trial(
        model=closed_model, signs={r"\phi_B": "phi", r"\phi": "free"}, false=Falsehood("(2*b + k)/(b + k)", "1")
    ),
}
