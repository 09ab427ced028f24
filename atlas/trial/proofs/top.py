"""Every symmetric top in a uniform field on trial: its quartic, its steady precessions and the paper's quadric."""

import sympy

from atlas.trial.proofs.model import Model, Value, cross, direction, dot, functions, turn, vector
from atlas.trial.proofs.trial import Falsehood, Part, Trial

SIGNS = {"q": "q()", "q'": "dq()", "q''": "ddq()", "q'''": "dddq()", r"\dot\psi": "psi1", r"\dot\chi": "chi1"}
I = sympy.Symbol("I", positive=True)
k2, k3, a0, A0 = sympy.symbols("k2 k3 a0 A0", real=True)
omega1, omega2, omega3 = vector("omega")
nu, r, a, A, M3, p, x, y = sympy.symbols("nu nu0 a A M3 p x y", real=True)
J, COUPLING, E3 = sympy.diag(1, 1, I), sympy.diag(k2, k2, k3), sympy.Matrix([0, 0, 1])
KAPPA, LEADING = k2 - k3 / I, A0 + k3**2 / I - k2**2
LETTERS = {"I": I, "k2": k2, "k3": k3, "a0": a0, "A0": A0, "kappa": KAPPA, "A": LEADING}
LETTERS |= {"J": J, "k": COUPLING, "e3": E3, "k1": COUPLING[0, 0]}
LETTERS |= {f"J{n + 1}": J[n, n] for n in range(3)}
g = sympy.Symbol("g", real=True)
QUARTIC = (1 - nu**2) * (g - 2 * a * nu - A * nu**2) - (p - M3 * nu) ** 2
"""The quartic of every top, by theorem-every-top."""


def _force(b: Value) -> Value:
    """Return the derivative U'(nu) = a0 + A0 nu of the potential at a unit vector b (3, 1), nu = b3."""
    return a0 + A0 * b[2]


def state_model() -> Model:
    """Return the model of theorem-every-top: any state M, b of the top, |b| = 1, with its rates, and psi1, chi1.

    The constants at that state are h (twice the energy), p = (M, b), M3 and g; psi1 and chi1 are the rates of
    precession about the field and of rotation about the axis; nu = b3.
    """
    M, b = vector("M"), vector("b")
    Omega = J.inv() * (M - COUPLING * b)
    rates = cross(M, Omega) + cross(COUPLING * Omega - _force(b) * E3, b), cross(b, Omega)
    bindings = list(zip(b, direction(), strict=True))
    energy = dot(Omega, J * Omega) + 2 * a0 * b[2] + A0 * b[2] ** 2
    momentum, momentum_along_field = M[2], dot(M, b)
    turn = (Omega[0] * b[0] + Omega[1] * b[1]) / (1 - nu**2)
    letters = {
        **LETTERS,
        "M": M,
        "b": b,
        "Omega": Omega,
        "nu": nu,
        "M3": momentum,
        "p": momentum_along_field,
        "h": energy,
        "a": momentum * KAPPA + a0,
    }
    letters |= {"psi1": turn, "chi1": Omega[2] - nu * turn}
    letters["g"] = energy - momentum**2 / I + 2 * k2 * momentum_along_field - k2**2
    flow = dict(zip([*M, *b, nu], [*rates[0], *rates[1], rates[1][2]], strict=True))
    return Model(letters, [*bindings, (nu, b[2])], flow, laws="M and b by the assumed equations")


def start_model() -> Model:
    """Return the model of theorem-top-quadric: the start with b = (0, n2, n3) and Omega = (omega1, omega2, omega3).

    w and v are symbols that the line defines, D = A + kappa^2 + a0/n3.
    """
    basis, (n2, n3) = state_model(), turn(x)[::-1]
    omega, direction = sympy.Matrix([omega1, omega2, omega3]), sympy.Matrix([0, *sympy.symbols("n2 n3", real=True)])
    M, symbols = J * omega + COUPLING * direction, sympy.symbols("w v", real=True)
    values = dict(zip([*vector("M"), *vector("b")], [*M, *direction], strict=True))
    letters = {**LETTERS, "nu": vector("b")[2], "n2": direction[1], "n3": direction[2]}
    letters |= {"omega1": omega1, "omega2": omega2, "omega3": omega3, "w": symbols[0], "v": symbols[1]}
    letters["D"] = LEADING + KAPPA**2 + a0 / direction[2]
    return Model(letters, [(direction[1], n2), (direction[2], n3)], basis.flow, values)


def paper_model() -> Model:
    """Return `start_model` for the paper's body: k2 = b, k3 = I b, and no potential; for theorem-top-quadric."""
    b = sympy.Symbol("b", positive=True)
    bindings = [(k2, b), (k3, I * b), (a0, sympy.Integer(0)), (A0, sympy.Integer(0))]
    letters = {**start_model().letters, "b": b}
    return Model(letters, [*bindings, *start_model().bindings])


def turns_model() -> Model:
    """Return the model of theorem-top-hyperbola: b rotated about e3, and Omega = psi1 b + chi1 e3.

    w and v are the coordinates omega2 and omega3 shifted to the quadric's centre, U is U'(nu).
    """
    base = start_model().letters
    n2, n3 = base["n2"], base["n3"]
    c, s, w, v, psi, chi = sympy.symbols("c s w v psi1 chi1", real=True)
    b = sympy.Matrix([n2 * s, n2 * c, n3])
    letters = {**LETTERS, "b": b, "psi1": psi, "chi1": chi, "U": _force(b), "n2": n2, "n3": n3, "w": w, "v": v}
    letters |= {"omega2": w - n2 * k3 / I, "omega3": v - n3 / I * (k3 - 2 * KAPPA), "D": base["D"]}
    bindings = [*start_model().bindings, (c, turn(y)[0]), (s, turn(y)[1])]
    return Model(letters, bindings, flow={s: chi * c, c: -chi * s})


def quartic_model() -> Model:
    """Return the model of any constants of the quartic q, any nu0, and w = (p - M3 nu0)/(1 - nu0^2).

    It serves the converse of theorem-top-precession.
    """
    letters = {"nu0": r, "a": a, "A": A, "M3": M3, "p": p, "g": g, "w": (p - M3 * r) / (1 - r**2)}
    return Model({**letters, **functions("q", QUARTIC, nu)})


def precession_model() -> Model:
    """Return the model of theorem-top-precession: a steady precession with rate w at nu = nu0; M3, p and g follow."""
    w = sympy.Symbol("w", real=True)
    momentum = (r * w**2 + a + A * r) / w
    momentum_along_field, remainder = w * (1 - r**2) + r * momentum, 2 * a * r + A * r**2 + w**2 * (1 - r**2)
    letters = {"nu0": r, "a": a, "A": A, "w": w, "M3": M3, "p": p, "g": g}
    return Model(
        {**letters, **functions("q", QUARTIC, nu)}, [(M3, momentum), (p, momentum_along_field), (g, remainder)]
    )


def marginal_model() -> Model:
    """Return `precession_model` with nutation frequency 0, for the further statements of theorem-top-nutation.

    The coefficients A and a of the quartic follow from c = (a + A r)/w, r the cosine nu0, w the rate.
    """
    base = precession_model()
    w = base.letters["w"]
    c = sympy.Symbol("c", real=True)
    leading = (c * w - a) / r
    force = sympy.solve(w**2 + leading * (1 - 3 * r**2) - 2 * a * r + c**2, a)[0]
    return Model({**base.letters, "c": c}, [(A, leading), (a, force), *base.bindings])


def sleeping_model() -> list[Model]:
    """Return two models of theorem-sleeping-top: q of a top that spins upright at nu = sigma, sigma = 1 and -1."""
    models = []
    for sigma in (1, -1):
        letters = {"nu": nu, "a": a, "A": A, "M3": M3, "sigma": sympy.Integer(sigma)}
        models.append(Model({**letters, "q": QUARTIC.xreplace({p: sigma * M3, g: 2 * sigma * a + A})}))
    return models


def border_model() -> list[Model]:
    """Return the two models of `sleeping_model` at the border of stability, A = M3^2/4 - sigma a."""
    return [Model(model.letters, [(A, M3**2 / 4 - model.letters["sigma"] * a)]) for model in sleeping_model()]


TRIALS = {
    "theorem-every-top": Trial(
        model=state_model, defines=("q",), also=("d(M3) = 0; d(p) = 0; d(h) = 0",), false=Falsehood("2*a*nu", "2*a0*nu")
    ),
    "theorem-top-precession": Trial(
        model=precession_model,
        arrows={
            1: Part(
                line="q(nu0) = (1 - nu0^2)*(g - 2*a*nu0 - A*nu0^2 - w^2*(1 - nu0^2));"
                " dq(nu0) = -2*(1 - nu0^2)*(nu0*w^2 - M3*w + a + A*nu0) - 2*nu0*q(nu0)/(1 - nu0^2)",
                model=quartic_model,
            )
        },
        false=Falsehood("a + A*nu0", "a"),
    ),
    "theorem-top-nutation": Trial(
        model=precession_model,
        elsewhere={1: marginal_model, 2: marginal_model},
        also=("q(nu0) = 0; dq(nu0) = 0",),
        false=Falsehood("- 2*a*nu0", "- 0*a*nu0"),
    ),
    "theorem-sleeping-top": Trial(
        model=sleeping_model,
        signs={"q": "q"},
        elsewhere={1: border_model, 2: border_model},
        false=Falsehood("(1 + sigma*nu)*(2*sigma*a", "2*(2*sigma*a"),
    ),
    "theorem-top-quadric": Trial(
        model=start_model,
        defines=("w", "v"),
        also=(Part(line="n2*k3/I = b*n2; n3/I*(k3 - 2*kappa) = b*n3; D = (I - 1)*b^2", model=paper_model),),
        false=Falsehood("D = A + kappa^2 + a0/n3", "D = A + a0/n3"),
    ),
    "theorem-top-hyperbola": Trial(
        model=turns_model,
        defines=("v", "psi1", "chi1"),
        solves="d(b) = cross(b,psi1*b + chi1*e3); J*d(psi1*b + chi1*e3) + k*d(b)"
        " = cross(J*(psi1*b + chi1*e3) + k*b,psi1*b + chi1*e3) + cross(k*(psi1*b + chi1*e3) - U*e3,b)",
        false=Falsehood("n3*(w^2 + n2^2*D)", "n3*(w^2 + n2^2*A)"),
    ),
}
