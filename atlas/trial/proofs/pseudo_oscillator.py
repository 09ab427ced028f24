"""Section IV, first half, on trial: the symmetric body and the cubic pseudo-oscillator, (31) to (49)."""

from dataclasses import replace
from functools import cache

import sympy

from atlas.trial.proofs import euler_poisson as general
from atlas.trial.proofs.model import Model, Value, cross, dot, hat, rotation_symbols, turn, vector
from atlas.trial.proofs.notation import conserved
from atlas.trial.proofs.trial import Falsehood, Part, Trial, mended, read

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
    """E', c3, c5 at a point: twice the energy over I2, and the conserved quantities of (40) and (41)."""
    c3 = field[2] + spin[2]
    return {
        "E": spin[0] ** 2 + spin[1] ** 2 + scale * spin[2] ** 2,
        "c3": c3,
        "c5": spin[0] * field[0] + spin[1] * field[1] - spin[2] ** 2 + (2 - scale) * c3 * spin[2],
    }


def cubic(values: dict[str, Value], square: Value, scale: Value) -> dict[str, Value]:
    """Coefficients of the cubic, (48) as corrected; square is that of the field."""
    E, c3, c5 = values["E"], values["c3"], values["c5"]
    return {
        "a0": ((2 - scale) * c5 + E) * c3,
        "a1": -2 * c5 + (scale - (2 - scale) ** 2) * c3**2 - E - scale * square,
        "a2": 6 * (1 - scale) * c3,
        "a3": -2 * (1 - scale),
    }


@cache
def state_model() -> Model:
    """Any state Omega, K of the system (34), (35) in vectors; with E', c3 and c5 as functions of the state."""
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
    """Model the state at the start, in the fields of the paper: K = B' = (0, B'2, B'3), both positive."""
    return replace(state_model(), bindings=[(K[0], sympy.Integer(0)), (K[1], B2), (K[2], B3)])


def field_model() -> Model:
    """(16) and (12) with K = mu/(2c) R^T B and a symmetric body."""
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
    """B' = (0, B'2, B'3), K = R^T B' with B = 2c/mu B', and R = 1 at t = 0."""
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
    """I1 = I2 and I = tr(g) - g."""
    g1, g3 = sympy.symbols("g1 g3", positive=True)
    return Model({"g": sympy.diag(g1, g1, g3), "I1": g1 + g3, "I2": g1 + g3, "I3": 2 * g1})


def passing_model() -> Model:
    """Model the motion with a root rho of either sign, whose rate is -I u w/rho; f is its logarithm."""
    basis = quadrature_model()
    rho, u, I, E = sympy.Symbol("rho", real=True), *(basis.letters[name] for name in ("u", "I", "E"))
    bindings = [(E, rho**2 + I * u**2), *basis.bindings[1:]]
    flow = {**basis.flow, rho: -I * u * basis.flow[u] / rho}
    return replace(basis, letters={**basis.letters, "rho": rho, "f": sympy.log(rho)}, bindings=bindings, flow=flow)


def quadrature_model() -> Model:
    """Omega3 = u is any function of time with u' = w; N = n^2 stands for E' - I u^2; Phi' = phi."""
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
    """Model any state with its E', and any f0, or f0 = 1 and -1 where f0 is fixed."""
    letters = state_model().letters
    values = map(sympy.Integer, (1, -1)) if fixed else [sympy.Symbol("f0", real=True)]
    return [Model({**letters, "f0": value}) for value in values]


def initial_model() -> Model:
    """Model the cubic (47), (48) as proved, with its integrals at t = 0: Omega = omega, K = B'."""
    u, field = sympy.Symbol("Omega3", real=True), sympy.Matrix([0, B2, B3])
    a = cubic(integrals(omega, field, ratio), dot(field, field), ratio)
    letters = {"omega": omega, "Omega3": u, "B2": B2, "B3": B3, "I": ratio}
    letters |= {"Bsquare": B2**2 + B3**2, "ddOmega3": a["a0"] + a["a1"] * u + a["a2"] * u**2 + a["a3"] * u**3}
    return Model(letters)


def laboratory_model(across: Value = B2, along: Value = B3) -> Model:
    """Model a field, its part across e3 of that length at an angle to e2; S turns about e3 by that angle."""
    cosine, sine = turn(sympy.Symbol("p", real=True))
    S = sympy.Matrix([[cosine, -sine, 0], [sine, cosine, 0], [0, 0, 1]])
    field = sympy.Matrix([across * sine, across * cosine, along])
    return Model({"S": S, "B": field, "I": tensor, "B2": across, "B3": along})


def degree_model() -> list[Model]:
    """I below and above 1, and I = 1."""
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
        model=symmetric_body_model,
        signs={r"\mathrm{diag}": "diag()"},
        follows=r"$I = \operatorname{tr}(g) - g$ with $I_1 = I_2$",
        false=Falsehood("The third moment of mass of a ball is zero", "2*I2 - I3", "I2 - I3"),
    ),
    "text-laboratory": Trial(
        signs={"B_2": "B2", "B_3": "B3"},
        model=laboratory_model,
        follows=r"a rotation about $\mathbf{e}_3$ by the angle between $\mathbf{e}_2$ and the part of $\mathbf{B}$ "
        r"across $\mathbf{e}_3$",
        grade="missing case",
        corrected_also=(
            Part(line="S*B = [0, 0, B3]", model=lambda: laboratory_model(across=sympy.Integer(0))),
            Part(line="S*B = [0, B2, 0]", model=lambda: laboratory_model(along=sympy.Integer(0))),
        ),
        corrected_signs={r"B_2\ge0,\quad B_3\ge0": ""},
        corrected_tex=mended("text-laboratory", {}, r",\qquad\boxed{B_2\ge0,\quad B_3\ge0}"),
        note=r"$B_3 \ge 0$ is a choice of the sense of $\mathbf{e}_3$. But a field along the axis of the body has "
        "$B_2 = 0$ and one across it $B_3 = 0$; the choice with $B_2 > 0$, $B_3 > 0$ does not reach them, and the "
        "motions of the body in them are others: see @theorem-axis-stable and @theorem-equatorial-field.",
        false=Falsehood(
            r"The same turn puts the field into the plane of $\mathbf{e}_1$ and $\mathbf{e}_3$",
            "S*B = [0, B2, B3]",
            "S*B = [B2, 0, B3]",
        ),
    ),
    "(31)": Trial(
        model=frame_model,
        signs={r"\boldsymbol{\omega}": "(R*Omega)"},
        follows=r"$\boldsymbol{\Omega} = R^T \boldsymbol{\omega}$ and $R(0) = 1$",
    ),
    "(32)": Trial(
        model=frame_model,
        signs={
            r"\mathbf{B}": "Bf",
            r"B'_2>0": "B2",
            r"B'_3>0": "B3",
            r"\mathbf{B}R(t)": "T(R)*Bf",
            r"\mathbf{B}'R": "T(R)*Bp",
        },
        follows="$K_j = B'_i R_{ij}$ and $R(0) = 1$",
    ),
    "(33)": Trial(
        model=state_model,
        signs={"E": "energy"},
        follows=r"the energy is $(I_2 \Omega_1^2 + I_2 \Omega_2^2 + I_3 \Omega_3^2)/2$ and makes @(36)",
        defines=("I", "E"),
        solves="Omega1^2 + Omega2^2 + I*Omega3^2 = E",
    ),
    "(34)": Trial(
        model=field_model,
        signs={r"\mathbb{I}\dot{\boldsymbol{\Omega}}": "IdOmega", r"\mathbf{K}g": "g*K"},
        follows="@(16) and @(32)",
    ),
    "(35)": Trial(model=field_model, signs={r"\dot{\mathbf{K}}": "dK"}, follows="@(12) and @(32)"),
    "(36)": Trial(model=state_model, form=conserved, follows="@(34), @(35)"),
    "(37)": Trial(model=state_model, form=conserved, follows="@(35)"),
    "(38)": Trial(model=state_model, follows="@(34) in components"),
    "(39)": Trial(model=state_model, follows="@(35) in components"),
    "(40)": Trial(model=state_model, form=conserved, follows="@(38) and @(39)"),
    "(41)": Trial(model=state_model, form=conserved, follows="@(38) and @(39)"),
    "text-four-integrals": Trial(
        model=state_model,
        also=("d([E, dot(K, K), c3, c5]) = 0",),
        signs={
            r"\mathrm{rank}\,\frac{\partial(E',\mathbf{K}^2,c_3,c_5)}{\partial(\boldsymbol{\Omega},"
            r"\mathbf{K})}": "rank([E, dot(K, K), c3, c5])"
        },
        follows=r"their rates, and their gradients at one point, $\boldsymbol{\Omega} = (1, 2, 3)$, $\mathbf{K} = (4, "
        "5, 6)$",
        note="Independent at one point, so at all but those of a set of measure zero.",
        false=Falsehood(
            "The component of the angular velocity along the field is conserved", "d([E,", "d([dot(Omega, K),"
        ),
    ),
    "(42)": Trial(
        model=state_model,
        follows="@(38), @(40) and @(41)",
        grade="missing case",
        corrected_tex=r"\begin{aligned} \boxed{(E'-I\Omega_3^2)}K_1&=\Omega_1(\Omega_3^2-(2-I)c_3\Omega_3+c_5)-"
        r"\Omega_2\dot\Omega_3,\\ \boxed{(E'-I\Omega_3^2)}K_2&=\Omega_2(\Omega_3^2-(2-I)c_3\Omega_3+c_5)+\Omega_1\dot"
        r"\Omega_3,\qquad K_3=-\Omega_3+c_3 \end{aligned}",
        note=r"Where $\Omega_1 = \Omega_2 = 0$ it reads $0/0$. That happens at the start of every launch $(0, 0, "
        r"\omega_3)$, and again whenever $\Omega_3$ comes back: for $I = 3/2$, $\mathbf{B}' = (0, 1, 1)$, $\omega_3 = "
        "1$ at $t = 2.347$.",
    ),
    "(43)": Trial(
        model=state_model,
        follows=r"@(38) with $\mathbf{K}$ of @(42), $\phi$ and $f$ of @(44)",
        slip="(42)",
        corrected_tex=r"\begin{aligned} \boxed{(E'-I\Omega_3^2)}\dot\Omega_1&=[(2-I)c_3E'-(E'+Ic_5)\Omega_3]\Omega_2-I"
        r"\Omega_3\dot\Omega_3\Omega_1,\\ \boxed{(E'-I\Omega_3^2)}\dot\Omega_2&=-[(2-I)c_3E'-(E'+Ic_5)\Omega_3]"
        r"\Omega_1-I\Omega_3\dot\Omega_3\Omega_2 \end{aligned}",
        note=r"Where $\Omega_1 = \Omega_2 = 0$ neither $\phi$ nor $\dot f$ of @(44) has a value.",
    ),
    "(44)": Trial(
        model=state_model,
        follows="@(43) by substitution",
        defines=("phi", "f"),
        solves=read("(43)", SIGNS),
        slip="(42)",
        corrected_defines=(),
        corrected_solves="",
        corrected_tex=r"\boxed{(E'-I\Omega_3^2)}\phi=(2-I)c_3E'-(E'+Ic_5)\Omega_3,\qquad\boxed{(E'-I\Omega_3^2)}\dot f="
        r"-I\Omega_3\dot\Omega_3",
        note=r"Where $\Omega_1 = \Omega_2 = 0$ the quotient reads $0/0$ and the logarithm has no value. "
        "$f$ counts up to a constant: the logarithm of a quantity with a dimension.",
    ),
    "(45)": Trial(
        model=quadrature_model,
        signs={r"\Omega_3": "u"},
        follows="@(43) by substitution, with two constants",
        defines=("Omega1", "Omega2"),
        solves=read("(43)", SIGNS),
        slip="(42)",
        corrected_model=passing_model,
        corrected_tex=r"\Omega_1=f_0\,\boxed{\rho}\sin(\Phi+\phi_0),\qquad\Omega_2=f_0\,\boxed{\rho}\cos(\Phi+\phi_0),"
        r"\qquad\boxed{\rho^2=E'-I\Omega_3^2}",
        note=r"Where $\Omega_1 = \Omega_2 = 0$ the vector passes through zero, but the root does not change its sign: "
        r"with it the angle would have to jump by $\pi$. With a $\rho$ of either sign, which passes through zero too, "
        "all is smooth. General for @(43) alone, see @text-free-constant.",
    ),
    "text-free-constant": Trial(
        model=free_constant_model,
        follows=r"@(45) and @(36), $\Omega_1$ and $\Omega_2$ squared and added",
        corrected_tex=r"\Omega_1^2+\Omega_2^2=f_0^2(E'-I\Omega_3^2),\qquad\boxed{f_0^2=1}",
        corrected_model=lambda: free_constant_model(fixed=True),
        grade="wording",
        note=r"@(43) is linear in $\Omega_1$ and $\Omega_2$ and leaves a factor free. But $E'$ in it is that of the "
        "motion, and @(36) fixes the factor: another one solves @(43) and is no motion with these integrals.",
    ),
    "(46)": Trial(
        model=state_model,
        follows="the rate of the last equation of @(38), with @(38), @(39) and @(40)",
        corrected_tex=mended("(46)", {"k_2": "K_2"}),
        grade="misprint",
        note="A lower-case $k_2$ that means nothing here stands for $K_2$.",
    ),
    "(47)": Trial(model=state_model, follows="@(46) and the four integrals, with @(48) as corrected"),
    "(48)": Trial(
        model=launch_model,
        signs={rf"a_{n}(\boldsymbol{{\omega}}, \mathbf{{B}}')": f"a{n}" for n in (0, 1, 2)},
        follows="@(46) and the four integrals",
        corrected_model=state_model,
        defines=("a0", "a1", "a2", "a3"),
        solves=read("(47)", SIGNS),
        corrected_tex=mended("(48)", {"(2-1)": r"(2-\boxed{I})"}),
        grade="misprint",
        note="A 1 stands for $I$.",
    ),
    "text-cubic-degree": Trial(
        model=lambda: degree_model()[:2],
        signs={"a_3": "leading"},
        follows="@(47) with @(48) as corrected",
        grade="missing case",
        corrected_also=(Part(line="leading = 0; square = 0", model=lambda: degree_model()[2]),),
        corrected_signs={r"\text{if}\quad I\ne1": ""},
        corrected_tex=mended("text-cubic-degree", {}, r"\quad\boxed{\text{if}\quad I\ne1}"),
        note="For the ball, $I = 1$, both $a_2$ and $a_3$ vanish, and @(47) is a harmonic oscillator.",
        false=Falsehood("The degree is three for the ball too", model=lambda: degree_model()[2]),
    ),
    "(49)": Trial(
        model=initial_model,
        signs={r"\ddot\Omega_3": "ddOmega3"},
        follows="@(47), @(48) as corrected, and the integrals at $t = 0$",
    ),
}
