"""Theorems of the atlas that the paper does not have, on trial in the same way."""

from functools import cache

import sympy

from atlas.trial.proofs import ball, elementary, euler_poisson, pseudo_oscillator
from atlas.trial.proofs.model import Model, Value, cross, functions, hat, rodrigues, turn
from atlas.trial.proofs.notation import sides
from atlas.trial.proofs.particle import SIGNS as PARTICLE_SIGNS
from atlas.trial.proofs.particle import drift_model
from atlas.trial.proofs.pseudo_oscillator import cubic, integrals, state_model
from atlas.trial.proofs.quadric import B2, B3, LETTERS, I, at_start, constant_omega3, omega1, omega2, omega3
from atlas.trial.proofs.trial import Falsehood, Part, Trial, evaluated, read

SIGNS = pseudo_oscillator.SIGNS | {
    r"\hat{\mathbf{B}}": "hat_B",
    r"\nu_n^2": "nun2",
    "Q": "Q()",
    "Q'": "dQ()",
    "Q''": "ddQ()",
    "b^2": "Bsquare",
    r"R_{\hat{\mathbf{B}}}": "about_B()",
    "R_{OY}": "about_y()",
    "R_{OZ}": "about_z()",
}
tau, x = sympy.symbols("tau x", real=True)
U = sympy.Symbol("u", real=True)
r, z, excess, T2 = sympy.symbols("r z e T2", positive=True)
ROOTS = 1 / (1 + r), sympy.Integer(0)  # of 1 - 8 tau^2: any between 0 and 1, and 0


def quartic_model() -> Model:
    """Return the model of theorem-quartic: u = Omega3 at any state of the symmetric body, with its rate by (34).

    E, c3, c5, I and Bsquare = K^2 are symbols bound to the state, a0 ... a3 the cubic's coefficients; `leading`
    gives the coefficient of u^4.
    """
    basis = state_model().letters
    names = ("E", "c3", "c5", "I", "Bsquare")
    fixed = {name: sympy.Symbol(f"{name}_0", real=True) for name in names}
    letters = {**fixed, **cubic(fixed, fixed["Bsquare"], fixed["I"]), "u": U}
    letters["leading"] = lambda Q: sympy.Poly(Q, U).coeff_monomial(U**4)
    bindings = [(symbol, basis[name]) for name, symbol in fixed.items()]
    return Model(
        letters, [*bindings, (U, basis["Omega3"])], flow={U: basis["d"](basis["Omega3"])}, laws="u = Omega_3 by (34)"
    )


def quartic(spin: Value, scale: Value = I) -> dict[str, Value]:
    """Return Q of theorem-quartic and its derivatives by name (Q, dQ, ddQ, dddQ), and nun2 = -Q''(omega3)/2.

    The motion starts with ``spin`` (3, 1) in the field (0, B2, B3); ``scale`` is I. nun2 is the square of the frequency
    of nutation, an expression.
    """
    field = sympy.Matrix([0, B2, B3])
    letters = {**integrals(spin, field, scale), "Bsquare": field.dot(field), "I": scale, "u": U}
    Q = functions("Q", evaluated("theorem-quartic", SIGNS, letters, 2), U)
    return {**Q, "nun2": sympy.factor(-Q["ddQ"](spin[2]) / 2)}


def stability_model() -> Model:
    """Return the model of theorem-stability: Q on the hyperbola, in tau = B3/B2 and x = (omega2 + B2)/B2.

    w = k + b = x b; nun2 as in `quartic`.
    """
    b, hB3 = elementary.b, elementary.hB3
    bindings = [(omega3, constant_omega3().subs(omega1, 0)), (omega2, (x - 1) * B2), *elementary.FIELD]
    letters = {"tau": hB3 / elementary.hB2, "x": x, "w": x * b, "b": b, "Bsquare": b**2, "hB3": hB3}
    return Model({**LETTERS, **quartic(sympy.Matrix([0, omega2, omega3])), **letters}, bindings)


def short_model() -> Model:
    """Return the model of theorem-stable-short: Q on the hyperbola for 1 <= I <= 2, omega2 = X - B2, any X but 0."""
    X, surplus = sympy.Symbol("X", real=True, nonzero=True), sympy.Symbol("more", nonnegative=True)
    bindings = [(omega3, constant_omega3().subs({omega1: 0, I: 1 + surplus})), (omega2, X - B2), (B3, tau * B2)]
    letters = {**quartic(sympy.Matrix([0, omega2, omega3]), 1 + surplus), "X": X, "tau": tau, "I": 1 + surplus}
    return Model({**LETTERS, **letters}, bindings, domains={"more": "unit"})


@cache
def _slope_in_squares() -> Value:
    """Return -Q''(omega3)/2 on the hyperbola, an expression in z = x^2, T2 = tau^2, I and B2; cached.

    tau = B3/B2, x = (omega2 + B2)/B2.
    """
    value = quartic(sympy.Matrix([0, omega2, omega3]))["nun2"]
    for symbol, meaning in ((omega3, constant_omega3().subs(omega1, 0)), (omega2, (x - 1) * B2), (B3, tau * B2)):
        value = value.subs(symbol, meaning)
    return sympy.cancel(sympy.cancel(value).subs({x: sympy.sqrt(z), tau: sympy.sqrt(T2)}))


def places_model(*, within: bool) -> list[Model]:
    """Return models of theorem-band with z = x^2 ``within`` the band, its ends among them, or below and above it.

    There are four, two for each root in `ROOTS`, where 8 tau^2 = 1 - root^2; t2 is tau^2, nun2 as in `quartic`.
    """
    share, surplus = sympy.Symbol("share", nonnegative=True), sympy.Symbol("more", positive=True)
    long, cases = 1 - 1 / (1 + excess), []
    for root in ROOTS:
        t2 = (1 - root**2) / 8
        low, high = (long * (1 - 2 * t2 + side * root) / (2 * (1 + t2)) for side in (-1, 1))
        inside = [(low + share * high) / (1 + share), (share * low + high) / (1 + share)]
        for place in inside if within else [low / (1 + surplus), high + surplus]:
            letters = {"nun2": _slope_in_squares().subs({T2: t2, I: 1 - long, z: place}), "t2": t2, "I": 1 - long}
            cases.append(Model({**letters, "z": place}, domains={"share": "positive"}))
    return cases


def above_model() -> Model:
    """Return the model of theorem-band above its tip: any z = x^2 > 0 with 8 tau^2 = 1 + gain and I < 1.

    nun2 as in `quartic`, t2 is tau^2.
    """
    t2, scale = (1 + r) / 8, 1 / (1 + excess)
    slope = _slope_in_squares().subs({T2: t2, I: scale})
    return Model({"nun2": slope, "I": scale, "z": z, "t2": t2, "B2": B2, "gain": r})


def root_model() -> list[Model]:
    """Return three models of theorem-root, Q for elementary motions: the hyperbola, and lines omega2 = -B2.

    On the two kinds of lines I = 1 with any omega3, or B3 = 0 with any I and omega3; v is u - omega3.
    """
    zero = sympy.Integer(0)
    letters = {**LETTERS, **quartic(sympy.Matrix([0, omega2, omega3])), "v": sympy.Symbol("v", real=True)}
    lines = [
        [(omega3, constant_omega3().subs(omega1, 0))],
        [(omega2, -B2), (I, sympy.Integer(1))],
        [(omega2, -B2), (B3, zero)],
    ]
    return [Model(letters, bindings) for bindings in lines]


def leaving_model() -> Model:
    """Return the model of theorem-band-ends: I < 1, the time t, and Q by theorem-root with nutation frequency 0."""
    t, v = sympy.symbols("t v", real=True)
    letters: dict[str, Value] = {"I": 1 / (1 + excess), "B3": B3, "t": t, "v": v, "omega3": omega3}
    basis = evaluated("theorem-root", SIGNS, {**letters, "nun2": sympy.Integer(0)})
    letters |= functions("Q", basis.xreplace({v: U - omega3}), U)
    return Model(letters, flow={t: sympy.Integer(1)}, start={t: sympy.Integer(0)})


def equatorial_model() -> Model:
    """Return the model of theorem-equatorial-stability: the squared nutation frequency for B3 = 0 on two lines.

    `upright` is that for omega2 = -B2 with any omega3, `level` for omega3 = 0 with any omega2.
    """
    lines = {"upright": sympy.Matrix([0, -B2, omega3]), "level": sympy.Matrix([0, omega2, 0])}
    rates = {name: quartic(spin)["nun2"] for name, spin in lines.items()}
    return Model({**LETTERS, **rates}, [(B3, sympy.Integer(0))])


def ball_nutation_model() -> Model:
    """Return the model of theorem-ball-nutation: nun2 of `quartic` for I = 1 and any initial angular velocity omega."""
    spin = sympy.Matrix([omega1, omega2, omega3])
    Q = quartic(spin, sympy.Integer(1))
    return Model({"nun2": Q["nun2"], "omega": spin, "Bp": sympy.Matrix([0, B2, B3])})


def torque_model() -> Model:
    """Return the model of theorem-moment: momentum m, rate dm by (17), for any symmetric mass matrix and any Omega."""
    basis = euler_poisson.magnetic_model()
    R, tensor, mass = (basis.letters[name] for name in ("R", "I", "g"))
    spin, field = euler_poisson.Omega, euler_poisson.Bf
    torque = -euler_poisson.mu / euler_poisson.c * cross(R * mass * R.T * field, R * spin)
    letters = {**basis.letters, "m": R * tensor * spin, "dm": torque, "c": euler_poisson.c}
    return Model(letters, basis.bindings, dict(zip(R, R * hat(spin), strict=True)))


def lines_model() -> list[Model]:
    """Return two models of theorem-quadric-lines, of sign 1 and -1: omega2 = -B2, omega1 = sign sqrt(1 - I) B2."""
    size = sympy.Symbol("size", positive=True)
    letters = {**LETTERS, "I": 1 - size**2, "omega2": -B2}
    return [Model({**letters, "sign": sympy.Integer(sign), "omega1": sign * size * B2}) for sign in (1, -1)]


def turning_model(case: str) -> Model:
    """Return the model of two rotations on the lines omega2 = -B2: about the field by -b t or e2 by -B2 t, and e3.

    ``case`` is "ball" (I = 1, about the field, theorem-ball-line), otherwise B3 = 0 and e2 (theorem-equatorial-field);
    Omega = (-B2 sin, -B2 cos, omega3). The line defines R.
    """
    e = elementary
    precession, axis, bindings = (
        (e.b, sympy.Matrix([0, e.hB2, e.hB3]), [(I, sympy.Integer(1))])
        if case == "ball"
        else (e.B2, sympy.Matrix([0, 1, 0]), [(e.u, sympy.Integer(1))])
    )
    spin_rate = omega3 + e.B3 if case == "ball" else omega3
    flow = {e.ck: -precession * e.sk, e.sk: precession * e.ck, e.cf: -spin_rate * e.sf, e.sf: spin_rate * e.cf}
    letters = {**e.CONSTANTS, "Omega": e.SPIN.xreplace({omega2: -e.B2}), "b": e.b, "J": e.TENSOR, "g": e.MASS}
    letters["Bp"] = sympy.Matrix([0, e.B2, e.B3])
    phases = {precession * e.t: (e.ck, e.sk), spin_rate * e.t: (e.cf, e.sf)}
    model = Model(letters, [*e.ANGLES, *e.FIELD, *bindings], flow, e.START, phases, e.DOMAINS)
    model.letters |= {
        "about_z": model.rotation_about(ball.E3),
        "about_B" if case == "ball" else "about_y": model.rotation_about(axis),
    }
    return model


def rest_model() -> Model:
    """Return the model of theorem-ball-rest: m = (0, 0, -alpha I0) and the phase alpha t; the line defines R."""
    b = ball
    letters = {"alpha": b.alpha, "t": b.t, "I0": b.I0, "m": sympy.Matrix([0, 0, -b.alpha * b.I0])}
    model = Model(letters, b.ANGLES[:2], b.LARMOR, b.START, {b.alpha * b.t: (b.ca, b.sa)})
    model.letters["about_z"] = model.rotation_about(b.E3)
    return model


def angles_model() -> Model:
    """Return the model of R = R_z(psi) R_x(theta) R_z(chi) with any rates of the angles, for theorem-angles.

    Omega is read off R^T dR/dt; u = Omega3, K is b times the third row of R, nu = K3/b, P = Omega1 K1 + Omega2 K2.
    xi and eta are logarithmic rates of the Cayley-Klein parameters, for theorem-cayley-klein.
    """
    b = sympy.Symbol("b", positive=True)
    names = sympy.symbols("psi theta chi", real=True)
    rates = psi1, _, chi1 = sympy.symbols("psi1 theta1 chi1", real=True)
    halves = {name: sympy.symbols(f"c_{name} s_{name}", real=True) for name in names}
    tangents = sympy.symbols("p1:4", real=True)
    flow: dict[Value, Value] = {}
    bindings: list[tuple[Value, Value]] = []
    for name, rate, tangent in zip(names, rates, tangents, strict=True):
        cosine, sine = halves[name]
        flow |= {cosine: -rate / 2 * sine, sine: rate / 2 * cosine}
        bindings += [(cosine, turn(tangent)[0]), (sine, turn(tangent)[1])]
    basis = {name: (c**2 - s**2, 2 * c * s) for name, (c, s) in halves.items()}
    axes = ball.E3, sympy.Matrix([1, 0, 0]), ball.E3
    R_psi, R_theta, R_chi = (rodrigues(axis, *basis[name]) for name, axis in zip(names, axes, strict=True))
    R = R_psi * R_theta * R_chi
    model = Model({}, bindings, flow)
    W = R.T * R.applyfunc(model.rate)
    spin = sympy.Matrix([W[2, 1], W[0, 2], W[1, 0]])
    K = b * R.row(2).T
    letters = {"P": spin[0] * K[0] + spin[1] * K[1], "b": b, "u": spin[2], "nu": K[2] / b, "psi1": psi1, "chi1": chi1}
    letters |= {"c3": spin[2] + K[2], "i": sympy.I}
    for name, size, rate in zip(("xi", "eta"), halves[names[1]], (psi1 + chi1, psi1 - chi1), strict=True):
        letters[name] = model.rate(size) / size + sympy.I * rate / 2
    return Model(letters, bindings, flow)


def _and_only_there(line: str) -> str:
    """Return the line "a <= b; ..." with the reverse of its first statement, "a > b", added at its end."""
    return f"{line}; {line.split('; ', maxsplit=1)[0].replace('<=', '>')}"


_CONDITION = sides(read("theorem-points", SIGNS).split("; ")[-1])[1]

TRIALS = {
    "theorem-quartic": Trial(
        model=quartic_model, defines=("Q",), solves="leading(Q(u)) = I - 1", false=Falsehood("E - I*u^2", "E - u^2")
    ),
    "theorem-points": Trial(
        signs={
            r"\Omega_3=\text{const}\iff\dot\Omega_3(0)=0\ \text{and}\ \ddot\Omega_3(0)=0": "d(d2(Omega3))"
            " = (a1 + 2*a2*Omega3 + 3*a3*Omega3^2)*d(Omega3)"
        },
        model=state_model,
        also=(Part(line=f"p = {_CONDITION}", model=lambda: Model({**LETTERS, "p": at_start(omega3)})),),
        false=Falsehood("omega1*B2", "omega1*B3"),
    ),
    "theorem-stability": Trial(model=stability_model, false=Falsehood("(2*tau^2 - 1)", "(2*tau^2 + 1)")),
    "theorem-root": Trial(defines=("nun2",), model=root_model, false=Falsehood("(4*B3 - v)", "(2*B3 - v)")),
    "theorem-stable-short": Trial(model=short_model, false=Falsehood("> (I", "< (I")),
    "theorem-band": Trial(
        model=lambda: places_model(within=True),
        signs={"x^2": "z", r"\tau^2": "t2", "y_-": "ym", "y_+": "yp", r"\tau\le\frac{1}{2\sqrt2}": "8*t2 <= 1"},
        defines=("ym", "yp"),
        form=_and_only_there,
        arrows={1: ""},
        elsewhere={5: lambda: places_model(within=False)},
        also=(
            Part(
                line="nun2 = B2^2*(S^2 + (1 - I)^2*gain)/(4*(1 + t2)*z); S = 2*(1 + t2)*z + (1 - I)*(2*t2 - 1);"
                " 8*t2 = 1 + gain",
                model=above_model,
                defines=("S",),
            ),
            Part(line="1 - I > 0; gain > 0", model=above_model),
        ),
        false=Falsehood("nun2 <= 0", "nun2 > 0"),
    ),
    "theorem-band-ends": Trial(
        model=leaving_model,
        signs={r"\nu_n=0": ""},
        defines=("Omega3",),
        solves="d(Omega3)^2 = Q(Omega3); 2*d2(Omega3) = dQ(Omega3); at0(Omega3) = omega3 + 4*B3",
        also=(
            Part(
                line="(1 - I)*v^3*(4*B3 - v) > 0",
                model=lambda: Model({"I": 1 / (1 + excess), "B3": B3, "v": 4 * B3 / (1 + r)}),
            ),
        ),
        false=Falsehood("(1 + 4*(1 - I)", "(1 - 4*(1 - I)"),
    ),
    "theorem-equatorial-stability": Trial(
        model=equatorial_model,
        signs={r"\omega_2=-B'_2:\quad\nu_n^2": "upright", r"\omega_3=0:\quad\nu_n^2": "level"},
        false=Falsehood("I^2*omega3^2 - (1 - I)*B2^2", "I^2*omega3^2 + (1 - I)*B2^2"),
    ),
    "theorem-ball-nutation": Trial(model=ball_nutation_model, false=Falsehood("omega + Bp", "omega")),
    "theorem-ball-line": Trial(
        model=lambda: turning_model("ball"),
        defines=("R",),
        solves=elementary.MOTION,
        false=Falsehood("(omega3 + B3)", "omega3"),
    ),
    "theorem-equatorial-field": Trial(
        model=lambda: turning_model("equator"),
        defines=("R",),
        solves=elementary.MOTION,
        false=Falsehood("omega3*t", "(omega3 + B2)*t"),
    ),
    "theorem-quadric-lines": Trial(
        model=lines_model, also=(read("(50)", SIGNS),), false=Falsehood("omega1 = sign*(sqrt(1 - I)*B2)", "omega1 = 0")
    ),
    "theorem-momentum": Trial(
        signs={r"\dot{\mathbf{m}}": "dm"},
        model=elementary.matrix_model,
        false=Falsehood("k*cross(hat_B, m)", "k*cross(m, hat_B)"),
    ),
    "theorem-moment": Trial(
        signs={r"\dot{\mathbf{m}}": "dm", r"\mathbf{B}": "Bf"},
        model=torque_model,
        false=Falsehood(" - d(R*I*T(R)*Bf)", ""),
    ),
    "theorem-drift": Trial(
        signs=PARTICLE_SIGNS | {r"\mathbf{E}": "E"},
        model=drift_model,
        false=Falsehood("c*cross(E, Bf)", "mu/abs(mu)*c*cross(E, Bf)"),
    ),
    "theorem-ball-rest": Trial(
        model=rest_model, defines=("R",), solves=ball.LINEAR, false=Falsehood("-alpha*t", "alpha*t")
    ),
    "theorem-angles": Trial(
        signs={r"\dot\psi": "psi1", r"\dot\chi": "chi1"},
        model=angles_model,
        false=Falsehood("chi1 = u - nu*psi1", "chi1 = u"),
    ),
    "theorem-cayley-klein": Trial(
        signs={r"\frac{\dot\xi}{\xi}": "xi", r"\frac{\dot\eta}{\eta}": "eta"},
        model=angles_model,
        false=Falsehood("(1 - nu) - u", "(1 - nu) + u"),
    ),
}
