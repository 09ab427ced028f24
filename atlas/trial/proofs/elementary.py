"""Section V, second half, on trial: the rotation matrix in elementary functions, (73) to (88)."""

from dataclasses import replace

import sympy

from atlas.trial.proofs.model import Model, Value, cross, direction, hat, rodrigues, turn, vector
from atlas.trial.proofs.notation import sides
from atlas.trial.proofs.quadric import SIGNS as QUADRIC_SIGNS
from atlas.trial.proofs.quadric import I, constant_omega3, omega1, omega2, omega3
from atlas.trial.proofs.tex import UnreadableError
from atlas.trial.proofs.trial import Falsehood, Part, Trial, read

b, I2 = sympy.symbols("b I2", positive=True)
B2, B3 = sympy.symbols("B2 B3", positive=True)
hB2, hB3, k, phi, t, k0, c, amplitude, u, p, q, h = sympy.symbols("hB2 hB3 k phi t k0 c amplitude u p q h", real=True)
ck, sk, cf, sf, c0, s0 = sympy.symbols("ck sk cf sf c0 s0", real=True)
gamma = g1, g2, g3 = vector("g")

SIGNS = QUADRIC_SIGNS | {
    r"\hat{\mathbf{B}}": "hat_B",
    r"\phi_B": "phiB",
    "k_B": "kB",
    r"R_{\hat{\mathbf{B}}}(t,k)": "P",
    r"R_{OZ}(t,\phi)": "Q",
    r"\lvert\mathbf{B}'\rvert": "b",
}

PHASES = {k * t: (ck, sk), phi * t: (cf, sf), k0: (c0, s0)}
FLOW = {ck: -k * sk, sk: k * ck, cf: -phi * sf, sf: phi * cf}
START = {ck: 1, sk: 0, cf: 1, sf: 0}
ANGLES = [(ck, turn(p)[0]), (sk, turn(p)[1]), (cf, turn(q)[0]), (sf, turn(q)[1]), (c0, turn(h)[0]), (s0, turn(h)[1])]
# the unit vector of the field by the tangent u of half its angle with e3, its length b
FIELD = [(B2, b * hB2), (B3, b * hB3), (hB2, turn(u)[1]), (hB3, turn(u)[0])]
K_OF_OMEGA2 = (k, omega2 / hB2)
ON_HYPERBOLA = [(omega3, constant_omega3().subs(omega1, 0))]
PHI = (phi, omega3 - B3 / B2 * omega2)
CONSTANTS = {"hB2": hB2, "hB3": hB3, "B2": B2, "B3": B3, "k": k, "phi": phi, "t": t, "k0": k0, "c": c}
CONSTANTS |= {"amp": amplitude, "I": I, "I2": I2, "omega2": omega2, "omega3": omega3, "Bp": sympy.Matrix([0, B2, B3])}
SPIN = sympy.Matrix([omega2 * sf, omega2 * cf, omega3])
TENSOR, MASS = I2 * sympy.diag(1, 1, I), I2 * sympy.diag(I, I, 2 - I) / 2
DOMAINS = {"u": "unit"}


def precession() -> Value:
    """Return the rotation matrix (3, 3) about the unit field (0, hB2, hB3) by the angle k t, as (85) prints it.

    ck and sk in it are the symbols of cos(k t) and sin(k t).
    """
    return sympy.Matrix(
        [
            [ck, -hB3 * sk, hB2 * sk],
            [hB3 * sk, hB2**2 + hB3**2 * ck, hB2 * hB3 * (1 - ck)],
            [-hB2 * sk, hB2 * hB3 * (1 - ck), hB3**2 + hB2**2 * ck],
        ]
    )


PROPER = sympy.Matrix([[cf, -sf, 0], [sf, cf, 0], [0, 0, 1]])


def _model(
    letters: dict[str, Value], bindings: list[tuple[Value, Value]], flow: dict[Value, Value] | None = None
) -> Model:
    return Model({**CONSTANTS, **letters}, bindings, flow or FLOW, START, PHASES, DOMAINS)


def velocity_model() -> Model:
    """Return the model of K = (B2 sin, B2 cos, B3) of (62) with the phase phi t, on the hyperbola (67); for (73).

    J is the inertia tensor, g the tensor of mass moments.
    """
    letters = {"K": sympy.Matrix([B2 * sf, B2 * cf, B3]), "J": TENSOR, "g": MASS}
    return _model(letters, [*ON_HYPERBOLA, PHI, *ANGLES, *FIELD])


def row_model() -> Model:
    """Return the model of a row gamma (3, 1) of a rotation matrix and its rate dgamma by (12), for (74) and (75)."""
    Omega, row = vector("Omega"), vector("gamma")
    rate = (row.T * hat(Omega)).T
    return Model({"gamma": row, "Omega": Omega, "dgamma": rate, "omega3": Omega[2]})


def integral_model() -> Model:
    """Return the model of any row gamma (3, 1) with the rates (75) for Omega of (73), for (76) to (79).

    c is the conserved sum (76) at that state.
    """
    rows = dict(zip(gamma, cross(gamma, SPIN), strict=True))
    letters = {"Omega": SPIN, "gamma": gamma}
    letters["c"] = SPIN[0] * g1 + SPIN[1] * g2 + hB3 * omega2 / hB2 * g3
    return _model(letters, [PHI, K_OF_OMEGA2, *ANGLES, *FIELD], {**FLOW, **rows})


def ratio_model() -> Model:
    """Return the model of (77): Bl2 and Bl3, the components of the field B = (2c/mu) B'."""
    mu, light = sympy.symbols("mu light", positive=True)
    letters = {"Bl2": 2 * light / mu * b * hB2, "Bl3": 2 * light / mu * b * hB3}
    return _model(letters, [*FIELD])


def rows_model() -> Model:
    """Return the model of text-row-constants: c is the column (3, 1) of constants (76) of the rows of R(0) = 1."""
    value = SPIN.subs(START)
    return _model({"c": sympy.Matrix([value[0], value[1], hB3 * omega2 / hB2])}, [*FIELD])


def _row(constant: Value, size: Value, phase: tuple[Value, Value]) -> Value:
    """Return a row (3, 1) of the rotation matrix by (78) and (80).

    ``constant`` is c of (76), ``size`` the amplitude b of (80), ``phase`` the pair (cos k0, sin k0).
    """
    third = size * (ck * phase[0] - sk * phase[1]) + constant * hB3 * omega2 / (hB2 * k**2)
    rate = -k * size * (sk * phase[0] + ck * phase[1])
    remainder = constant - hB3 * omega2 / hB2 * third
    return (
        sympy.Matrix([SPIN[0] * remainder + SPIN[1] * rate, SPIN[1] * remainder - SPIN[0] * rate, omega2**2 * third])
        / omega2**2
    )


def solution_model() -> Model:
    """Return the model of a row gamma by (78) and (80) for any constants c, amp (the printed b) and k0.

    It serves (80) to (83). `row` (c, amp, k0) is a function that gives the row (3, 1) at t = 0.
    """
    row = _row(c, amplitude, (c0, s0))
    letters = {"gamma": row, "Omega1": SPIN[0], "Omega2": SPIN[1]}

    def begin(constant: Value, size: Value, angle: Value) -> Value:
        return _row(constant, size, (sympy.cos(angle), sympy.sin(angle))).subs(START)

    letters["row"] = begin
    return _model(letters, [PHI, K_OF_OMEGA2, *ANGLES, *FIELD])


def matrix_model() -> Model:
    """Return the model of the motion (84), (85): Omega of (73), R = P Q, the angular momentum m, its rate dm by (17).

    P is the precession about the field, Q the proper rotation about e3; J and g are the tensors of inertia and of mass.
    """
    letters = {"Omega": SPIN, "Bp": sympy.Matrix([0, B2, B3]), "J": TENSOR, "g": MASS, "R": precession() * PROPER}
    letters |= {
        "rod": rodrigues,
        "hat_B": sympy.Matrix([0, hB2, hB3]),
        "P": precession(),
        "Q": PROPER,
        "e3": sympy.Matrix([0, 0, 1]),
    }
    letters["m"] = precession() * PROPER * TENSOR * SPIN
    letters["dm"] = -2 * cross(letters["R"] * MASS * letters["R"].T * letters["Bp"], letters["R"] * SPIN)
    return _model(letters, [*ON_HYPERBOLA, PHI, K_OF_OMEGA2, *ANGLES, *FIELD])


def steady_momentum_model() -> list[Model]:
    """Return two models in which the angular momentum is constant: `matrix_model` with I = 1, and with omega2 = 0."""
    basis = matrix_model()
    vocabulary = (I, sympy.Integer(1)), (omega2, sympy.Integer(0))
    return [replace(basis, bindings=[*basis.bindings, pair]) for pair in vocabulary]


def resting_row_model() -> Model:
    """Return the model of a row's rates `dgamma1`, `dgamma2`, `dgamma3` for Omega = 0, for the corrected (78), (83)."""
    basis = row_model()
    remainder = dict.fromkeys(basis.letters["Omega"], sympy.Integer(0))
    return Model({f"dgamma{n}": basis.letters[f"dgamma{n}"].xreplace(remainder) for n in (1, 2, 3)})


def frequencies_model() -> Model:
    """Return the model of (86): phiB = omega3 - (B3/B2) omega2 on the hyperbola (67), with omega2 = kB hB2."""
    kB = sympy.Symbol("kB", real=True)
    I3 = sympy.Symbol("I3", positive=True)
    letters = {"phiB": omega3 - B3 / B2 * omega2, "kB": kB, "b": b, "I3": I3}
    return _model(letters, [*ON_HYPERBOLA, (omega2, kB * hB2), (I, I3 / I2), *FIELD])


def free_model() -> Model:
    """Return the model of a free body with Omega(0) = (0, omega2, I2 omega2 B3/(I3 B2)), R = P Q; for (87).

    P turns about B' by k t, Q about e3 by phi t; phi is a symbol that the line defines.
    """
    I3 = sympy.Symbol("I3", positive=True)
    spin = sympy.Matrix([omega2 * sf, omega2 * cf, I2 * omega2 * B3 / (I3 * B2)])
    body = sympy.diag(I2, I2, I3)
    letters = {"Omega": spin, "R": precession() * PROPER, "J": body, "I3": I3, "kB": k, "Bp": sympy.Matrix([0, B2, B3])}
    letters["Omega0"] = spin.subs(START)
    bindings = [K_OF_OMEGA2, *ANGLES, *FIELD]
    return _model(letters, bindings)


def free_frequency_model() -> list[Model]:
    """Return two models of a free body, omega2 > 0 and omega2 < 0; `size` is |m| for m = (I2 omega2/B2) B'.

    They serve text-free-frequency; k = omega2/hB2 is the rate of precession.
    """
    speed, hB2 = sympy.symbols("speed hB2", positive=True)
    cases = []
    for sign in (1, -1):
        k = sign * speed / hB2
        letters = {"size": I2 * speed / hB2, "omega2": sign * speed, "k": k, "kB": k, "hB2": hB2, "I2": I2}
        cases.append(Model(letters, [(hB2, turn(u)[1])], domains=DOMAINS))
    return cases


POISSON = "d(R[i,j]) = -eps[j,a,b]*Omega[a]*R[i,b]; at0(R) = one"
MOTION = f"{POISSON}; J*d(Omega) = cross(J*Omega,Omega) - 2*cross(g*T(R)*Bp,Omega)"


def hidden_model() -> Model:
    """Return the model of text-hidden: Bl2, a component of B = (2c/mu) B' for mu > 0, and its length Bl."""
    mu, light = sympy.symbols("mu light", positive=True)
    scale = 2 * light / mu * b
    return _model({"Bl2": scale * hB2, "Bl": scale}, [K_OF_OMEGA2, *FIELD])


def free_body_model() -> Model:
    """Return the model of text-free-general: any motion of a free symmetrical body, by axis a, momentum m and omega.

    a is a unit vector with the rate [omega, a]; all three are columns (3, 1) in space.
    """
    a, m = vector("a"), vector("m")
    I3 = sympy.Symbol("I3", positive=True)
    omega = m / I2 + (1 / I3 - 1 / I2) * a.dot(m) * a
    bindings = list(zip(a, direction(), strict=True))
    return Model(
        {"a": a, "m": m, "omega": omega, "I2": I2, "I3": I3, "B": hat},
        bindings,
        dict(zip(a, cross(omega, a), strict=True)),
    )


def free_proper_model() -> Model:
    """Return the model of text-free-proper: `free_model` with phi, the rate of proper rotation, as Omega3 - m3/I2."""
    model = free_model()
    I3 = model.letters["I3"]
    m = sympy.Matrix([0, I2 * omega2, I3 * model.letters["Omega0"][2]])
    letters = {"m3": m[2], "I3": I3, "phi": model.letters["Omega0"][2] - m[2] / I2, "kB": k}
    return _model(letters, [K_OF_OMEGA2, *FIELD])


def _rows(line: str) -> str:
    """Return statements "row(c, amp, k0) = [1, 0, 0]" and so on for the constants of three rows in the line of (83).

    Further sides of a chain are appended as equations. Raises UnreadableError unless the line gives c, amp, k0 three
    times, in this order.
    """
    letters, values = zip(*((sides(row)[0], sides(row)[1:]) for row in line.split("; ")), strict=True)
    if letters != ("c", "amp", "k0") * 3:
        raise UnreadableError("here must stand three rows of the constants c, b, k0")
    constants = [value[0] for value in values]
    rows = [f"row({', '.join(constants[3 * n : 3 * n + 3])}) = {[int(n == m) for m in range(3)]}" for n in range(3)]
    return "; ".join(rows + [" = ".join(value) for value in values if len(value) > 1])


TRIALS = {
    "(73)": Trial(
        model=velocity_model,
        defines=("Omega",),
        solves="J*d(Omega) = cross(J*Omega,Omega) - 2*cross(g*K,Omega); d(K) = -cross(Omega,K)",
    ),
    "text-body-precession": Trial(model=matrix_model, false=Falsehood("-phi*cross", "phi*cross")),
    "(74)": Trial(model=row_model, signs={r"\dot{\boldsymbol{\gamma}}": "dgamma"}),
    "(75)": Trial(model=row_model, signs={rf"\dot\gamma_{n}": f"dgamma{n}" for n in (1, 2, 3)}),
    "(76)": Trial(model=integral_model, defines=("c",), solves="d(c) = 0"),
    "(77)": Trial(model=ratio_model, signs={"B_2": "Bl2", "B_3": "Bl3"}),
    "text-row-constants": Trial(model=rows_model, false=Falsehood("c2 = omega2", "c2 = omega3")),
    "(78)": Trial(
        model=integral_model,
        corrected_also=(Part(line="dgamma1 = 0; dgamma2 = 0; dgamma3 = 0", model=resting_row_model),),
        corrected_signs={r"\text{and}\quad\boldsymbol{\gamma}=\text{const}\quad\text{if}\quad\omega_2=0": ""},
    ),
    "(79)": Trial(model=integral_model),
    "(80)": Trial(model=solution_model, signs={"b": "amp"}, solves=read("(79)", SIGNS), corrected_solves=""),
    "(81)": Trial(
        model=solution_model,
        signs={"b": "amp"},
        defines=("gamma1", "gamma2"),
        solves=read("(75)", SIGNS),
        corrected_defines=(),
        corrected_solves="",
    ),
    "(82)": Trial(model=solution_model, signs={"b": "amp"}),
    "(83)": Trial(
        model=solution_model,
        signs={"b": "amp"},
        corrected_also=(Part(line="dgamma1 = 0; dgamma2 = 0; dgamma3 = 0", model=resting_row_model),),
        corrected_signs={r"\text{if}\quad\omega_2\ne0": ""},
        form=_rows,
    ),
    "(84)": Trial(model=matrix_model, signs={"": "R"}, defines=("R",), solves=MOTION),
    "text-hidden": Trial(
        model=hidden_model,
        signs={r"\lvert\mathbf{B}\rvert": "Bl", "B_2": "Bl2"},
        false=Falsehood("omega2*Bl/Bl2", "omega2*Bl2/Bl"),
    ),
    "(85)": Trial(model=matrix_model, defines=("R",), solves=POISSON),
    "text-precession": Trial(
        model=matrix_model,
        also=("Q = rod(e3,cos(phi*t),sin(phi*t))",),
        signs={r"[\hat{\mathbf{B}},\cdot\,]": "hat(hat_B)"},
        false=Falsehood("rod(e3,cos(phi*t),sin(phi*t))", "rod(e3,cos(phi*t),-sin(phi*t))"),
    ),
    "text-axis-precesses": Trial(
        model=matrix_model, signs={r"\mathbf{R}_3": "(R*e3)"}, false=Falsehood("k*cross(hat_B", "k*cross(e3")
    ),
    "text-ball-limit": Trial(
        model=lambda: _model({}, [*ON_HYPERBOLA, PHI, (I, sympy.Integer(1)), *FIELD]),
        signs={r"I_2=I_3\implies": ""},
        false=Falsehood(model=velocity_model),
    ),
    "(86)": Trial(model=frequencies_model),
    "text-free-general": Trial(
        model=free_body_model, signs={r"\mathbf{R}_3": "a"}, false=Falsehood("1/I2*cross", "1/I3*cross")
    ),
    "(87)": Trial(model=free_model, defines=("phi",), solves=f"{POISSON}; J*d(Omega) = cross(J*Omega,Omega)"),
    "text-affirmation-free": Trial(
        model=free_model,
        signs={r"\mathbf{m}": "J*at0(Omega)", r"\mathbf{B}": "Bp", "B_2": "B2", "B_3": "B3"},
        false=Falsehood("I2*omega2*B3/(I3*B2)]", "omega2*B3/B2]"),
    ),
    "text-free-frequency": Trial(
        model=lambda: free_frequency_model()[0],
        signs={r"\lvert\mathbf{m}\rvert": "size", "k_B": "kB"},
        corrected_model=free_frequency_model,
        false=Falsehood("abs(k)", "k"),
    ),
    "text-free-proper": Trial(
        model=free_proper_model, false=Falsehood("= (I2 - I3)/(I2*I3)*m3", "= (I3 - I2)/(I2*I3)*m3")
    ),
    "text-momentum-moves": Trial(
        model=matrix_model,
        signs={r"\dot{\mathbf{m}}\ne0": "dot(dm, dm) = (I2*k*hB3*omega2*(1 - I)*B2/(omega2 + B2))^2"},
        corrected_also=(Part(line="dm = 0", model=steady_momentum_model),),
        corrected_signs={r"\text{if}\quad I\ne1,\ \omega_2\ne0": ""},
        false=Falsehood("(I2*k*hB3*omega2*(1 - I)*B2/(omega2 + B2))^2", "0"),
    ),
    "text-constant-omega3": Trial(model=matrix_model, signs={r"\Omega_3": "Omega[3]"}),
    "(88)": Trial(model=matrix_model, signs={r"\mathbf{B}": "Bp"}),
    "text-momentum-plane": Trial(model=matrix_model, signs={r"\mathbf{B}": "Bp"}),
}
