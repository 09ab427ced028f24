"""What the atlas adds to the paper, on trial in the same way."""

from functools import cache

import sympy

from atlas.proof import ball, elementary
from atlas.proof.model import Model, Value, turn
from atlas.proof.particle import charges_model
from atlas.proof.pseudo_oscillator import cubic, integrals, state_model
from atlas.proof.quadric import B2, B3, LETTERS, I, constant_omega3, lines_case, omega1, omega2, omega3
from atlas.proof.trial import Trial

tau, x = sympy.symbols("tau x", real=True)
r, z, excess = sympy.symbols("r z e", positive=True)


@cache
def quartic_model() -> Model:
    """Any state of the symmetric body; b^2 = K^2, and u a letter of its own in Q and in the cubic p."""
    whole = state_model()
    u = sympy.Symbol("u", real=True)
    names = ("E", "c3", "c5", "I")
    fixed = {name: sympy.Symbol(f"{name}_0", real=True) for name in names} | {
        "Bsquare": sympy.Symbol("b2_0", positive=True)
    }
    a = cubic({name: fixed[name] for name in ("E", "c3", "c5")}, fixed["Bsquare"], fixed["I"])
    letters = {**fixed, "u": u, "p": a["a0"] + a["a1"] * u + a["a2"] * u**2 + a["a3"] * u**3}
    letters |= {"udot": whole.letters["d"](whole.letters["Omega3"])}
    letters["slope"] = lambda Q: Q.diff(u)
    letters["leading"] = lambda Q: sympy.Poly(Q, u).coeff_monomial(u**4)
    state = {fixed[name]: whole.letters[name] for name in names} | {
        fixed["Bsquare"]: whole.letters["Bsquare"],
        u: whole.letters["Omega3"],
    }
    letters["here"] = lambda Q: Q.xreplace(state)
    return Model(letters)


@cache
def stability_model() -> Model:
    """Model the slope of the cubic at Omega3 = omega3, on the hyperbola, in tau = B3/B2 and x = (omega2 + B2)/B2."""
    u = sympy.Symbol("u", real=True)
    field = sympy.Matrix([0, B2, B3])
    a = cubic(integrals(sympy.Matrix([0, omega2, omega3]), field, I), field.dot(field), I)
    slope = (a["a1"] + 2 * a["a2"] * u + 3 * a["a3"] * u**2).subs(u, omega3)
    where = [(omega3, constant_omega3().subs(omega1, 0)), (omega2, (x - 1) * B2), (B3, tau * B2)]
    return Model({**LETTERS, "minus_slope": -slope, "tau": tau, "x": x}, where)


@cache
def short_model() -> tuple[Model, Model]:
    """Model N = -p' x^2/B2^2 with z = x^2, I >= 1: a sum of squares if tau^2 >= 1/8, of positive terms if <= 1/2."""
    cases = []
    for square in (sympy.Rational(1, 8) + r, 1 / (2 * (1 + r))):
        N = (1 + square) * z**2 + (1 - I) * (2 * square - 1) * z + square * (1 - I) ** 2
        cases.append(
            Model(
                {"N": N, "z": z, "I": I, "t2": square, "gain": 8 * square - 1, "rest": 1 - 2 * square},
                [(I, 1 + excess)],
            )
        )
    return cases[0], cases[1]


@cache
def band_model() -> Model:
    """8 tau^2 = 1 - r^2 with 0 < r < 1, I < 1."""
    root = 1 / (1 + r)
    letters = {"I": 1 / (1 + excess), "z": z, "t2": (1 - root**2) / 8, "root": root}
    return Model(letters)


@cache
def lines_model() -> Model:
    """Model the points omega2 = -B2, omega1^2 = (1 - I) B2^2."""
    return Model(LETTERS, lines_case(), domains={"s": "unit"})


@cache
def turning_model(case: str) -> Model:
    """R = R_B(k t) R_z(phi t) and Omega = (w sin, w cos, omega3) with the constants of each extra line."""
    e = elementary
    whole = e.matrix_model()
    spin = e.SPIN.xreplace({omega2: -e.B2})
    where = [*e.ANGLES, *e.FIELD, (e.k, -e.b)]
    where += (
        [(e.phi, omega3 + e.B3), (I, sympy.Integer(1))]
        if case == "ball"
        else [(e.phi, omega3), (e.u, sympy.Integer(1))]
    )
    letters = {
        **e.CONSTANTS,
        "Omega": spin,
        "P": whole.letters["P"],
        "Q": whole.letters["Q"],
        "b": e.b,
        "J": e.TENSOR,
        "g": e.MASS,
    }
    letters["Bp"] = sympy.Matrix([0, e.B2, e.B3])
    return Model(letters, where, e.FLOW, e.START, e.PHASES, e.DOMAINS)


@cache
def rest_model() -> Model:
    """Model A ball with m = (0, 0, -alpha I0)."""
    b = ball
    letters = {"alpha": b.alpha, "t": b.t, "I0": b.I0, "m": sympy.Matrix([0, 0, -b.alpha * b.I0])}
    return Model(letters, b.ANGLES[:2], b.LARMOR, b.START, {b.alpha * b.t: (b.ca, b.sa)})


@cache
def angles_model() -> Model:
    """Model R = R_z(psi) R_x(theta) R_z(chi) with any rates of the angles; B = b e3, Omega from R^T dR/dt."""
    b = sympy.Symbol("b", positive=True)
    names = sympy.symbols("psi theta chi", real=True)
    rates = psi1, _, chi1 = sympy.symbols("psi1 theta1 chi1", real=True)
    halves = {name: sympy.symbols(f"c_{name} s_{name}", real=True) for name in names}
    tangents = sympy.symbols("p1:4", real=True)
    flow: dict[Value, Value] = {}
    where: list[tuple[Value, Value]] = []
    for name, rate, tangent in zip(names, rates, tangents, strict=True):
        cosine, sine = halves[name]
        flow |= {cosine: -rate / 2 * sine, sine: rate / 2 * cosine}
        where += [(cosine, turn(tangent)[0]), (sine, turn(tangent)[1])]
    whole = {name: (c**2 - s**2, 2 * c * s) for name, (c, s) in halves.items()}

    def about_z(c: Value, s: Value) -> Value:
        return sympy.Matrix([[c, -s, 0], [s, c, 0], [0, 0, 1]])

    c, s = whole[names[1]]
    R = about_z(*whole[names[0]]) * sympy.Matrix([[1, 0, 0], [0, c, -s], [0, s, c]]) * about_z(*whole[names[2]])
    model = Model({}, where, flow)
    W = R.T * R.applyfunc(model.rate)
    spin = sympy.Matrix([W[2, 1], W[0, 2], W[1, 0]])
    K = b * R.row(2).T
    letters = {"P": spin[0] * K[0] + spin[1] * K[1], "b": b, "u": spin[2], "nu": K[2] / b, "psi1": psi1, "chi1": chi1}
    letters |= {"ca": halves[names[1]][0], "sb": halves[names[1]][1], "R": R}
    return Model(letters, where, flow)


_Q = "(E - I*u^2)*(Bsquare - (c3 - u)^2) - (u^2 - (2 - I)*c3*u + c5)^2"
_N = "(1 + t2)*z^2 + (1 - I)*(2*t2 - 1)*z + t2*(1 - I)^2"
_YM, _YP = (f"(1 - I)*(1 - 2*t2 {sign} root)/(2*(1 + t2))" for sign in "-+")
_POISSON = "d(R[i,j]) = -eps[j,a,b]*Omega[a]*R[i,b]; at0(R) = one"
_MOTION = f"{_POISSON}; J*d(Omega) = cross(J*Omega,Omega) - 2*cross(g*T(R)*Bp,Omega)"

TRIALS = (
    Trial(
        label="theorem-quartic",
        printed=f"Q = {_Q}",
        model=quartic_model,
        follows="mf46 to mf49, for any state",
        defines=("Q",),
        solves="here(Q) = udot^2; slope(Q) = 2*p; leading(Q) = I - 1",
    ),
    Trial(
        label="theorem-points",
        printed="at0(d(Omega3)) = omega1*B2",
        model=state_model,
        follows="the last equation of mf46 at t = 0",
        note="A constant Omega3 needs omega1 B'2 = 0, and mf58.1 by mf57. With B'2 > 0 that is the hyperbola mf72,"
        " and mf78,"
        " mf89 show that each of its points is a motion.",
    ),
    Trial(
        label="theorem-stability",
        printed="minus_slope = B2^2*((1 + tau^2)*x^4 + (1 - I)*(2*tau^2 - 1)*x^2 + tau^2*(1 - I)^2)/x^2",
        model=stability_model,
        follows="mf56 as corrected, on the hyperbola mf76",
        note="Omega3 = omega3 + eps obeys eps'' = p'(omega3) eps to first order.",
    ),
    Trial(
        label="theorem-stable-short",
        printed=f"N = {_N} = ((2*(1 + t2)*z + (1 - I)*(2*t2 - 1))^2 + (1 - I)^2*gain)/(4*(1 + t2))"
        " = (1 + t2)*z^2 + (I - 1)*rest*z + t2*(I - 1)^2",
        model=short_model,
        follows="theorem-stability with z = x^2, t2 = tau^2; gain = 8 tau^2 - 1, rest = 1 - 2 tau^2",
        note="For tau^2 > 1/8 the second form is a sum of squares, for tau^2 < 1/2 the third one a sum of positive"
        " terms: one of"
        " the two always holds, so that N > 0 for I >= 1 and z > 0.",
    ),
    Trial(
        label="theorem-band",
        printed=f"{_N} = (1 + t2)*(z - ym)*(z - yp); ym = {_YM}; yp = {_YP}; 8*t2 = 1 - root^2",
        model=band_model,
        follows="theorem-stability with z = x^2, t2 = tau^2 = (1 - root^2)/8",
        defines=("ym", "yp"),
        solves="ym > 0; yp > ym",
        note="Negative exactly between two positive roots, which are there for 0 < 8 tau^2 < 1. For 8 tau^2 > 1"
        " the second form of"
        " theorem-stable-short is positive whatever I is.",
    ),
    Trial(
        label="theorem-ball-line",
        printed="k = -b; phi = omega3 + B3; R = P*Q",
        model=lambda: turning_model("ball"),
        follows="mf21 and mf27 by substitution, omega2 = -B2, I = 1, any omega3",
        defines=("R",),
        solves=_MOTION,
    ),
    Trial(
        label="theorem-equatorial-field",
        printed="k = -B2/hB2; phi = omega3; R = P*Q",
        model=lambda: turning_model("equator"),
        follows="mf21 and mf27 by substitution, B3 = 0, omega2 = -B2, any I and omega3",
        defines=("R",),
        solves=_MOTION,
    ),
    Trial(
        label="theorem-quadric-lines",
        printed="B3*(omega1^2 + omega2^2) - I*B2*omega2*omega3 + (2 - I)*B2*B3*omega2 - I*B2^2*omega3 = 0;"
        " omega1^2 = (1 - I)*B2^2; omega2 = -B2",
        model=lines_model,
        follows="mf58.1 by substitution, any omega3",
    ),
    Trial(
        label="theorem-momentum",
        printed="dm = k*cross(hat_B,m)",
        model=elementary.matrix_model,
        follows="mf28 with R of mf89 and Omega of mf78",
    ),
    Trial(
        label="theorem-drift",
        printed="drift = c*cross(Eperp,Bf)/b^2; mu/c*cross(drift,Bf) = -mu*Eperp",
        model=charges_model,
        follows="the electric force is balanced by the magnetic one, for either sign of the charge",
    ),
    Trial(
        label="theorem-ball-rest",
        printed="R = [[cos(alpha*t), sin(alpha*t), 0], [-sin(alpha*t), cos(alpha*t), 0], [0, 0, 1]]",
        model=rest_model,
        follows="mf34 by substitution with m = (0, 0, -alpha I0)",
        defines=("R",),
        solves="d(R[i,j]) = 1/I0*eps[i,a,b]*m[a]*R[b,j]; at0(R) = one",
    ),
    Trial(
        label="theorem-angles",
        printed="psi1 = P/b/(1 - nu^2); chi1 = u - nu*psi1",
        model=angles_model,
        follows="R = R_z(psi) R_x(theta) R_z(chi) with any rates",
    ),
    Trial(
        label="theorem-cayley-klein",
        printed="d(ca)/ca = 1/2*d(nu)/(1 + nu); 1/2*(psi1 + chi1) = 1/2*(P/b/(1 + nu) + u);"
        " d(sb)/sb = -1/2*d(nu)/(1 - nu); 1/2*(psi1 - chi1) = 1/2*(P/b/(1 - nu) - u)",
        model=angles_model,
        follows="alpha = cos(theta/2) exp(i (psi + chi)/2), beta = sin(theta/2) exp(i (psi - chi)/2): moduli and"
        " arguments",
    ),
)
