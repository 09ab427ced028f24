"""Section IV, first half, on trial: the symmetric body and the cubic pseudo-oscillator, (31) to (49)."""

from dataclasses import replace
from functools import cache

import sympy

from atlas.trial.proofs import euler_poisson as general
from atlas.trial.proofs.model import Model, Value, cross, dot, hat, rotation_symbols, turn, vector
from atlas.trial.proofs.notation import conserved
from atlas.trial.proofs.trial import Falsehood, Part, Trial, read

Omega, K = vector("Omega"), vector("K")
I2, I3 = sympy.symbols("I2 I3", positive=True)
I1 = I2  # the symmetric body
B2, B3 = sympy.symbols("B2 B3", positive=True)
omega1, omega2, omega3 = omega = vector("omega")
tensor, mass = sympy.diag(I1, I2, I3), sympy.diag(I3, I3, 2 * I2 - I3) / 2
ratio = I3 / I2

SIGNS = {r"B'_2": "B2", r"B'_3": "B3", "E'": "E", r"{\mathbf{B}'}^2": "Bsquare", r"\mathbb{I}": "I"}

FLOW = dict(
    zip(
        [*Omega, *K],
        [*(tensor.inv() * (cross(tensor * Omega, Omega) - 2 * cross(mass * K, Omega))), *(-cross(Omega, K))],
        strict=True,
    )
)
START = dict(zip([*Omega, *K], [*omega, 0, B2, B3], strict=True))


def integrals(spin: Value, field: Value, scale: Value) -> dict[str, Value]:
    """Return E', c3 and c5 at a point as a dictionary "E", "c3", "c5": twice the energy over I2, (40) and (41).

    ``spin`` is Omega (3, 1), ``field`` K (3, 1), ``scale`` I = I3/I2.
    """
    c3 = field[2] + spin[2]
    return {
        "E": spin[0] ** 2 + spin[1] ** 2 + scale * spin[2] ** 2,
        "c3": c3,
        "c5": spin[0] * field[0] + spin[1] * field[1] - spin[2] ** 2 + (2 - scale) * c3 * spin[2],
    }


def cubic(values: dict[str, Value], square: Value, scale: Value) -> dict[str, Value]:
    """Return the coefficients of the cubic (48), as corrected, as a dictionary "a0" ... "a3" of expressions.

    ``values`` has "E" (E'), "c3" and "c5", see `integrals`; ``square`` is K^2, ``scale`` I = I3/I2.
    """
    E, c3, c5 = values["E"], values["c3"], values["c5"]
    return {
        "a0": ((2 - scale) * c5 + E) * c3,
        "a1": -2 * c5 + (scale - (2 - scale) ** 2) * c3**2 - E - scale * square,
        "a2": 6 * (1 - scale) * c3,
        "a3": -2 * (1 - scale),
    }


@cache
def state_model() -> Model:
    """Return the model of any Omega, K with rates (34), (35), and E', c3, c5, the cubic, phi and f at that state.

    The letters a0 ... a3 are the coefficients of the cubic (48), phi and f the functions (44); `rank` gives the
    rank of the gradients of functions at one point. Cached; it serves (33) to (47).
    """
    energy = (tensor * Omega).dot(Omega) / 2
    letters = {"omega": omega, "Omega": Omega, "K": K, "B2": B2, "B3": B3, "I": ratio, **integrals(Omega, K, ratio)}
    letters |= {"E": 2 * energy / I2, "energy": energy, "I1": I1, "I2": I2, "I3": I3, "Bsquare": dot(K, K)}
    letters |= cubic({name: letters[name] for name in ("E", "c3", "c5")}, dot(K, K), ratio)
    P = letters["c5"] + Omega[2] ** 2 - (2 - ratio) * letters["c3"] * Omega[2]
    N = letters["E"] - ratio * Omega[2] ** 2
    letters["phi"] = (1 - ratio) * Omega[2] + (2 - ratio) * K[2] - ratio * Omega[2] * P / N
    letters["f"] = sympy.log(N) / 2
    letters["rank"] = lambda functions: (
        functions.jacobian([*Omega, *K]).subs({s: n for n, s in enumerate([*Omega, *K], 1)}).rank()
    )
    return Model(letters, flow=FLOW, start=START, laws="Omega by (34), K by (35)")


def launch_model() -> Model:
    """Return `state_model` at the start in the paper's field, for (48): K = B' = (0, B2, B3), both positive."""
    return replace(state_model(), bindings=[(K[0], sympy.Integer(0)), (K[1], B2), (K[2], B3)])


def field_model() -> Model:
    """Return the model of a symmetric body with K = mu/(2c) R^T B, for (34) and (35).

    IdOmega is I dOmega/dt by (16), dK the rate of K by (12), Bf the field B, Bp is B' = mu B/(2c). The model itself has
    no rates.
    """
    (R, bindings), B = rotation_symbols(), vector("B")
    mu, c = general.mu, general.c
    field_in_body = mu / (2 * c) * R.T * B
    rate = cross(tensor * Omega, Omega) - mu / c * cross(mass * R.T * B, Omega)
    letters = {
        "I": tensor,
        "I1": I1,
        "I2": I2,
        "g": mass,
        "Omega": Omega,
        "IdOmega": rate,
        "K": field_in_body,
        "R": R,
        "Bf": B,
        "mu": mu,
        "c": c,
    }
    letters |= {"dK": mu / (2 * c) * (R * hat(Omega)).T * B, "Bp": mu / (2 * c) * B}
    for n in range(3):
        letters[f"K{n + 1}"] = sum((letters["Bp"][i] * R[i, n] for i in range(3)), sympy.Integer(0))
    return Model(letters, bindings)


def frame_model() -> Model:
    """Return the model of (31), (32): K = R^T B' with B' = (0, B2, B3), B = (2c/mu) B', Omega = R^T omega; R(0) = 1.

    R is any rotation and has no rate; `Bf` is B, `Bp` is B', `omega` the angular velocity in the laboratory.
    """
    mu, c = general.mu, general.c
    field = sympy.Matrix([0, 2 * c * B2 / mu, 2 * c * B3 / mu])
    (R, bindings), w = rotation_symbols(), vector("w")
    field_in_body = sympy.Matrix(
        [sum((mu / (2 * c) * field[i] * R[i, n] for i in range(3)), sympy.Integer(0)) for n in range(3)]
    )
    letters = {
        "Bf": field,
        "Bp": sympy.Matrix([0, B2, B3]),
        "K": field_in_body,
        "R": R,
        "mu": mu,
        "c": c,
        "B2": B2,
        "B3": B3,
    }
    return Model({**letters, "omega": w, "Omega": R.T * w}, bindings, start=dict(zip(R, sympy.eye(3), strict=True)))


def symmetric_body_model() -> Model:
    """Return the model of text-mass-matrix: mass moments g1, g1, g3, so that I1 = I2 = g1 + g3, I3 = 2 g1."""
    g1, g3 = sympy.symbols("g1 g3", positive=True)
    return Model({"g": sympy.diag(g1, g1, g3), "I1": g1 + g3, "I2": g1 + g3, "I3": 2 * g1})


def passing_model() -> Model:
    """Return the model of the corrected (45): `quadrature_model` with a root rho of E' - I u^2 of either sign.

    rho has the rate -I u w/rho, and f is ln(rho).
    """
    basis = quadrature_model()
    rho, u, I, E = sympy.Symbol("rho", real=True), *(basis.letters[name] for name in ("u", "I", "E"))
    bindings = [(E, rho**2 + I * u**2), *basis.bindings[1:]]
    flow = {**basis.flow, rho: -I * u * basis.flow[u] / rho}
    return replace(basis, letters={**basis.letters, "rho": rho, "f": sympy.log(rho)}, bindings=bindings, flow=flow)


def quadrature_model() -> Model:
    """Return the model of (45): any function Omega3 = u of time with rate w, and an angle Phi with rate phi.

    E' - I u^2 is n^2 with n > 0, and f is half its logarithm; Phi and phi0 are phases.
    """
    u, w, E, phi, Phi, phi0, f0 = sympy.symbols("u w E phi Phi phi0 f0", real=True)
    I, n = sympy.symbols("I n", positive=True)
    c1, s1, c2, s2, p, q = sympy.symbols("c1 s1 c2 s2 p q", real=True)
    letters = {"u": u, "E": E, "I": I, "phi": phi, "Phi": Phi, "phi0": phi0, "f0": f0}
    letters["f"] = sympy.log(E - I * u**2) / 2
    bindings = [(E, n**2 + I * u**2), (c1, turn(p)[0]), (s1, turn(p)[1]), (c2, turn(q)[0]), (s2, turn(q)[1])]
    flow = {u: w, c1: -phi * s1, s1: phi * c1}
    letters["sqrt"] = sympy.sqrt
    return Model(letters, bindings, flow, phases={Phi: (c1, s1), phi0: (c2, s2)})


def free_constant_model(*, fixed: bool = False) -> list[Model]:
    """Return one model of text-free-constant with any f0, or two with f0 = 1 and -1 if ``fixed``.

    Each is the letters of `state_model` without rates.
    """
    letters = state_model().letters
    values = map(sympy.Integer, (1, -1)) if fixed else [sympy.Symbol("f0", real=True)]
    return [Model({**letters, "f0": value}) for value in values]


def initial_model() -> Model:
    """Return the model of (49): the cubic (47), (48) as corrected in Omega3, with integrals at Omega = omega, K = B'.

    The letter ddOmega3 is the value of the cubic.
    """
    u, field = sympy.Symbol("Omega3", real=True), sympy.Matrix([0, B2, B3])
    a = cubic(integrals(omega, field, ratio), dot(field, field), ratio)
    letters = {"omega": omega, "Omega3": u, "B2": B2, "B3": B3, "I": ratio}
    letters |= {"Bsquare": B2**2 + B3**2, "ddOmega3": a["a0"] + a["a1"] * u + a["a2"] * u**2 + a["a3"] * u**3}
    return Model(letters)


def laboratory_model(B_across: Value = B2, B_along: Value = B3) -> Model:
    """Return the model of text-laboratory: a field B, and S, a rotation about e3.

    B has the part ``B_across`` across e3, at any angle to e2, and ``B_along`` along e3; S turns by this angle.
    """
    cosine, sine = turn(sympy.Symbol("p", real=True))
    S = sympy.Matrix([[cosine, -sine, 0], [sine, cosine, 0], [0, 0, 1]])
    field = sympy.Matrix([B_across * sine, B_across * cosine, B_along])
    return Model({"S": S, "B": field, "I": tensor, "B2": B_across, "B3": B_along})


def degree_model() -> list[Model]:
    """Return three models, I > 1, I < 1 and I = 1, of the cubic's coefficients, for text-cubic-degree.

    `leading` is that of Omega3^3, `square` of Omega3^2, `slope` of Omega3.
    """
    excess, u = sympy.Symbol("e", positive=True), sympy.Symbol("Omega3", real=True)
    cases = []
    for scale in (1 + excess, 1 / (1 + excess), sympy.Integer(1)):
        field = sympy.Matrix([0, B2, B3])
        a = cubic(integrals(omega, field, scale), dot(field, field), scale)
        basis = sympy.Poly(a["a0"] + a["a1"] * u + a["a2"] * u**2 + a["a3"] * u**3, u)
        degrees = {"leading": basis.coeff_monomial(u**3), "square": basis.coeff_monomial(u**2)}
        cases.append(Model({**degrees, "slope": basis.coeff_monomial(u), "I": scale}))
    return cases


TRIALS = {
    "text-mass-matrix": Trial(
        model=symmetric_body_model, signs={r"\mathrm{diag}": "diag()"}, false=Falsehood("2*I2 - I3", "I2 - I3")
    ),
    "text-laboratory": Trial(
        signs={"B_2": "B2", "B_3": "B3"},
        model=laboratory_model,
        corrected_also=(
            Part(line="S*B = [0, 0, B3]", model=lambda: laboratory_model(B_across=sympy.Integer(0))),
            Part(line="S*B = [0, B2, 0]", model=lambda: laboratory_model(B_along=sympy.Integer(0))),
        ),
        corrected_signs={r"B_2\ge0,\quad B_3\ge0": ""},
        false=Falsehood("S*B = [0, B2, B3]", "S*B = [B2, 0, B3]"),
    ),
    "(31)": Trial(model=frame_model, signs={r"\boldsymbol{\omega}": "(R*Omega)"}),
    "(32)": Trial(
        model=frame_model,
        signs={
            r"\mathbf{B}": "Bf",
            r"B'_2>0": "B2",
            r"B'_3>0": "B3",
            r"\mathbf{B}R(t)": "T(R)*Bf",
            r"\mathbf{B}'R": "T(R)*Bp",
        },
    ),
    "(33)": Trial(
        model=state_model, signs={"E": "energy"}, defines=("I", "E"), solves="Omega1^2 + Omega2^2 + I*Omega3^2 = E"
    ),
    "(34)": Trial(model=field_model, signs={r"\mathbb{I}\dot{\boldsymbol{\Omega}}": "IdOmega", r"\mathbf{K}g": "g*K"}),
    "(35)": Trial(model=field_model, signs={r"\dot{\mathbf{K}}": "dK"}),
    "(36)": Trial(model=state_model, form=conserved),
    "(37)": Trial(model=state_model, form=conserved),
    "(38)": Trial(model=state_model),
    "(39)": Trial(model=state_model),
    "(40)": Trial(model=state_model, form=conserved),
    "(41)": Trial(model=state_model, form=conserved),
    "text-four-integrals": Trial(
        model=state_model,
        also=("d([E, dot(K, K), c3, c5]) = 0",),
        signs={
            r"\mathrm{rank}\,\frac{\partial(E',\mathbf{K}^2,c_3,c_5)}{\partial(\boldsymbol{\Omega},"
            r"\mathbf{K})}": "rank([E, dot(K, K), c3, c5])"
        },
        false=Falsehood("d([E,", "d([dot(Omega, K),"),
    ),
    "(42)": Trial(model=state_model),
    "(43)": Trial(model=state_model),
    "(44)": Trial(
        model=state_model, defines=("phi", "f"), solves=read("(43)", SIGNS), corrected_defines=(), corrected_solves=""
    ),
    "(45)": Trial(
        model=quadrature_model,
        signs={r"\Omega_3": "u"},
        defines=("Omega1", "Omega2"),
        solves=read("(43)", SIGNS),
        corrected_model=passing_model,
    ),
    "text-free-constant": Trial(model=free_constant_model, corrected_model=lambda: free_constant_model(fixed=True)),
    "(46)": Trial(model=state_model),
    "(47)": Trial(model=state_model),
    "(48)": Trial(
        model=launch_model,
        signs={rf"a_{n}(\boldsymbol{{\omega}}, \mathbf{{B}}')": f"a{n}" for n in (0, 1, 2)},
        corrected_model=state_model,
        defines=("a0", "a1", "a2", "a3"),
        solves=read("(47)", SIGNS),
    ),
    "text-cubic-degree": Trial(
        model=lambda: degree_model()[:2],
        signs={"a_3": "leading"},
        corrected_also=(Part(line="leading = 0; square = 0", model=lambda: degree_model()[2]),),
        corrected_signs={r"\text{if}\quad I\ne1": ""},
        false=Falsehood(model=lambda: degree_model()[2]),
    ),
    "(49)": Trial(model=initial_model, signs={r"\ddot\Omega_3": "ddOmega3"}),
}
