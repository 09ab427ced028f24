"""Steady precessions, their stability and the second elementary family on trial: a quartic with a double root."""

from dataclasses import replace

import sympy

from atlas.trial.proofs import general
from atlas.trial.proofs.general import QUARTIC, top_model
from atlas.trial.proofs.model import Model, Value, dot, functions, turn
from atlas.trial.proofs.trial import Falsehood, Part, Trial

SIGNS = {
    "B'_3": "B3",
    "q": "q()",
    "q'": "dq()",
    "q''": "ddq()",
    r"\lambda_-": "lam_minus",
    r"\lambda_+": "lam_plus",
    "e_+": "e_plus",
    "e_-": "e_minus",
    r"\begin{pmatrix}\xi\\\eta\end{pmatrix}\propto": "spinor =",
}
b = sympy.Symbol("b", positive=True)
nu, nu0, e, A, w, M3, c3, p, c, t, g = sympy.symbols("nu nu0 e A w M3 c3 p c t g", real=True)
T, C = sympy.symbols("T C", real=True)


def steady(rate: Value, leading: Value, double: Value = nu0) -> dict[str, Value]:
    """Return M3, p, G, and q, dq, ddq, dddq, by name, of a steady precession at nu = ``double``, by theorem-steady.

    ``rate`` is its angular velocity w, ``leading`` A; M3 and p are the momenta, G stands for g, and q is `QUARTIC` with
    these constants, a function of nu as are its derivatives.
    """
    momentum = double * (rate**2 + leading) / rate
    momentum_along_field = rate * (1 - double**2) + double * momentum
    remainder = leading * double**2 + rate**2 * (1 - double**2)
    basis = QUARTIC.xreplace(
        {general.p: momentum_along_field, general.M3: momentum, general.A: leading, general.g: remainder}
    )
    return {"M3": momentum, "p": momentum_along_field, "G": remainder, **functions("q", basis, nu)}


def any_model() -> Model:
    """Return the model of any constants of the quartic q, and any nu0, for the converse of theorem-steady.

    g is 2H - M3^2/I - b^2, w the angular velocity (p - M3 nu0)/(1 - nu0^2).
    """
    letters = {"nu0": nu0, "A": A, "M3": M3, "p": p, "g": g, "w": (p - M3 * nu0) / (1 - nu0**2)}
    return Model({**letters, **functions("q", QUARTIC.xreplace({general.g: g, general.A: A}), nu)})


def precession_model() -> Model:
    """Return the model of theorem-steady: an elementary motion, omega3 by (71), its rate k, and constants of its top.

    The constants are M3, p, H, A and nu0 = B3/b, in units of I2; w is the rate of precession in Larmor's frame.
    """
    I, B2, B3, omega2, q1 = sympy.symbols("I B2 B3 omega2 q1", real=True)
    h2, h3 = turn(q1)[::-1]
    omega3 = B3 * omega2 * (omega2 + (2 - I) * B2) / (I * B2 * (omega2 + B2))
    spin, field = sympy.Matrix([0, omega2, omega3]), sympy.Matrix([0, B2, B3])
    M = sympy.diag(1, 1, I) * (spin + field)
    H = dot(M, sympy.diag(1, 1, 1 / I) * M) / 2 + dot(field, sympy.diag(1, 1, I) * field) / 2
    letters = {"M3": M[2], "p": dot(M, field) / b, "H": H, "I": I, "b": b, "A": (I - 1) * b**2, "nu0": B3 / b}
    letters |= {"k": omega2 / h2, "hB3": h3, "w": (dot(M, field) / b - M[2] * B3 / b) / (1 - B3**2 / b**2)}
    state = {general.p: letters["p"], general.M3: M[2], general.A: letters["A"]}
    state[general.g] = 2 * H - M[2] ** 2 / I - b**2
    return Model({**letters, **functions("q", QUARTIC.xreplace(state), nu)}, [(B2, b * h2), (B3, b * h3)])


def nutation_model() -> list[Model]:
    """Return two models, of sign 1 and -1, of a steady precession with rate w at nu0, for theorem-nutation.

    nun2 is -q''(nu0)/2, the square of the frequency of nutation.
    """
    letters = {"nu0": nu0, "A": A, "w": w, **steady(w, A)}
    letters["nun2"] = -letters["ddq"](nu0) / 2
    return [Model({**letters, "sign": sympy.Integer(sign)}) for sign in (1, -1)]


def range_model() -> Model:
    """Return the model of theorem-companion-range: a steady precession with A = -w^2/z, any z > 0, and q at nu."""
    z = sympy.Symbol("z", positive=True)
    letters = {"nu": nu, "nu0": nu0, "w": w, "z": z, "A": -(w**2) / z, "b": b, "I": 1 - w**2 / z / b**2}
    letters |= steady(w, -(w**2) / z)
    return Model({**letters, "q": letters["q"](nu)})


def _spinors(model: Model) -> Model:
    """Return the same model, changed in place, with functions of a pair of complex numbers added to its letters.

    `height` (pair) is (|a|^2 - |b|^2)/(|a|^2 + |b|^2), `argument` (pair, 1 or 2) the rate of that number's argument.
    """

    def size(value: Value) -> Value:
        return sympy.expand(value * value.xreplace({sympy.I: -sympy.I}))

    def height(pair: Value) -> Value:
        upper, lower = size(pair[0]), size(pair[1])
        return (upper - lower) / (upper + lower)

    def argument(pair: Value, place: Value) -> Value:
        spinor = pair[int(place) - 1]
        product = sympy.expand(spinor.xreplace({sympy.I: -sympy.I}) * model.rate(spinor))
        return (product - product.xreplace({sympy.I: -sympy.I})) / (2 * sympy.I * size(spinor))

    model.letters |= {"height": height, "argument": argument}
    return model


def family_model() -> Model:
    """Return the model of theorem-companion's family, in tangents of half the angles kappa and delta, w and b.

    All its constants are rational in these. With T = S/C of the theorem, dT/dt = (1 - c T^2)/2 and dC/dt = c S/2.
    """
    kappa, delta, x, y = sympy.symbols("kappa delta x y", real=True)
    ck, sk, cd, sd = sympy.symbols("ck sk cd sd", real=True)
    turning, sine = cd**2 - sd**2, 2 * cd * sd
    double, leading = -ck * (turning * ck + sine * sk), -(w**2) / ck**2
    I = 1 + leading / b**2
    letters: dict[str, Value] = {"kappa": kappa, "delta": delta, "w": w, "b": b, "t": t, "nu0": nu0, "e": e, "A": A}
    letters |= {"nu": nu, "M3": M3, "p": p, "c3": c3, "c": c, "C": C, "S": T * C, "lam_minus": (c3 - M3 - b) / 2}
    letters["lam_minus"] += (p + M3) / (1 + nu0) / 2
    letters["lam_plus"] = (M3 - c3 - b + (p - M3) / (1 - nu0)) / 2
    remainder = A * nu0**2 + w**2 * (1 - nu0**2)
    letters |= functions("q", QUARTIC.xreplace({general.g: remainder, general.A: A, general.p: p, general.M3: M3}), nu)
    letters["cosh"] = lambda argument: C if argument == sympy.sqrt(c) * t / 2 else sympy.cosh(argument)
    letters["sinh"] = lambda argument: (
        sympy.sqrt(c) * T * C if argument == sympy.sqrt(c) * t / 2 else sympy.sinh(argument)
    )
    rates = steady(w, leading, double)
    bindings = [(ck, turn(x)[0]), (sk, turn(x)[1]), (cd, turn(y)[0]), (sd, turn(y)[1]), (e, turning), (nu0, double)]
    bindings += [(A, leading), (M3, rates["M3"]), (p, rates["p"]), (c3, rates["M3"] / I)]
    bindings += [(c, leading * (double - turning) * (3 * double + turning))]
    flow = {T: (1 - c * T**2) / 2, C: c * T * C / 2, t: sympy.Integer(1)}
    return _spinors(Model(letters, bindings, flow, phases={kappa: (ck, sk), delta: (cd, sd)}))


def double_model() -> Model:
    """Return the model of any quartic with a double root nu0 and a root e = nu0 + y, for theorem-companion-nutation.

    S and C move by dS/dt = C/2, dC/dt = c S/2, from 0 and 1.
    """
    y, S = sympy.symbols("y S", real=True)
    letters = {"nu0": nu0, "e": nu0 + y, "A": A, "c": c, "S": S, "C": C, "d": -(c + A * y**2) / y}
    shift = nu - nu0
    letters |= functions("q", shift**2 * (c - (c + A * y**2) / y * shift + A * shift**2), nu)
    return Model(letters, [(c, (C**2 - 1) / S**2)], {S: C / 2, C: c * S / 2}, {S: 0, C: 1})


def triple_model() -> Model:
    """Return the model of a quartic with the triple root nu0 and the root -3 nu0, for theorem-companion-triple.

    It is an end of the band of theorem-companion-range.
    """
    I = sympy.Symbol("I", positive=True)
    basis = (I - 1) * b**2 * (nu - nu0) ** 2 * ((nu + nu0) ** 2 - 4 * nu0**2)
    letters = {"nu0": nu0, "t": t, "I": I, "b": b, "e": -nu0 - 2 * nu0, **functions("q", basis, nu)}
    return Model(letters, flow={t: sympy.Integer(1)})


def axis_model() -> Model:
    """Return the model of any state of the top, in letters for the spin along the field; n = K/b, nu = n3.

    It serves theorem-axis-stable: M1, M2 and n1, n2 are the parts across the axis, A = (I - 1) b^2.
    """
    basis = top_model()
    M, K, letters = basis.letters["M"] / basis.letters["I2"], basis.letters["K"], dict(basis.letters)
    letters |= {"M1": M[0], "M2": M[1], "n1": K[0] / b, "n2": K[1] / b, "nu": K[2] / b}
    letters |= {"A": (letters["I"] - 1) * b**2, "B3": b, "omega3": M[2] / letters["I"] - b}
    return replace(basis, letters=letters)


def escape_model() -> list[Model]:
    """Return two models of theorem-axis-escape, a motion that leaves the axis, M3 > 0 and M3 < 0.

    A = a^2, e = cos(2 delta), T = S/C with dT/dt = (1 - c T^2)/2; `size` is |M3|.
    """
    a, delta = sympy.Symbol("a", positive=True), sympy.Symbol("delta", real=True)
    cosine = 1 / sympy.sqrt(1 - c * T**2)  # C, for C^2 = 1 + c S^2
    letters = {"delta": delta, "e": e, "c": c, "M3": M3, "c3": c3, "b": b, "I": 1 + a**2 / b**2, "t": t}
    letters |= {"D": M3**2 - 4 * a**2, "C": cosine, "S": T * cosine}
    letters |= {"lam_minus": (c3 - b) / 2, "lam_plus": (M3 - c3 - b) / 2}
    state = {general.p: M3, general.M3: M3, general.A: a**2, general.g: a**2}
    letters |= functions("q", QUARTIC.xreplace(state), nu)
    phases, flow = {delta: (sympy.sqrt((1 + e) / 2), sympy.sqrt((1 - e) / 2))}, {T: (1 - c * T**2) / 2, t: 1}
    cases = []
    for sign in (1, -1):
        bindings = [(M3, sign * a * (1 + e)), (c, 4 * a**2 - (a * (1 + e)) ** 2)]
        model = Model({**letters, "size": sign * M3}, bindings, flow, phases=phases, domains={"e": "unit"})
        cases.append(_spinors(model))
    return cases


def pushed_model() -> Model:
    """Return the model of theorem-axis-pushed: x = tan(theta/2)^2 and its rate.

    The state is Omega = (s1, 0, omega3), K = (0, 0, b).
    """
    x, s1 = sympy.symbols("x s1", real=True)
    place = (1 - x) / (1 + x)
    state = {general.p: M3, general.A: A, general.g: s1**2 + A, nu: place}
    rate = sympy.sqrt(QUARTIC.xreplace(state)) * (1 + x) ** 2 / 2
    return Model({"x": x, "s1": s1, "A": A, "M3": M3, "nu": place}, flow={x: rate})


def pendulum_model() -> Model:
    """Return the model of theorem-axis-pendulum: T = tanh(a t), a^2 = A, for M3 = p = 0 and 2H - b^2 = A.

    The line defines nu as a function of T.
    """
    a = sympy.Symbol("a", positive=True)
    zero = sympy.Integer(0)
    state = {general.p: zero, general.M3: zero, general.A: a**2, general.g: a**2}
    letters = {"A": a**2, "M3": zero, "p": zero, "t": t, "b": b, "H": (a**2 + b**2) / 2}
    letters["tanh"] = lambda argument: T if argument == a * t else sympy.tanh(argument)
    letters |= functions("q", QUARTIC.xreplace(state), nu)
    return Model(letters, flow={T: a * (1 - T**2)}, start={T: zero})


_SPINOR = (
    "d(height(spinor))^2 = q(height(spinor));"
    " argument(spinor,1) = 1/2*((p - M3*height(spinor))/(1 + height(spinor)) + c3 - b);"
    " argument(spinor,2) = 1/2*((p - M3*height(spinor))/(1 - height(spinor)) - c3 - b)"
)

TRIALS = {
    "theorem-steady": Trial(
        model=precession_model,
        signs={r"\hat B_3": "hB3"},
        arrows={
            1: Part(
                line="q(nu0) = (1 - nu0^2)*(g - A*nu0^2 - w^2*(1 - nu0^2));"
                " dq(nu0) = 2*(1 - nu0^2)*(M3*w - nu0*(w^2 + A)) - 2*nu0*q(nu0)/(1 - nu0^2)",
                model=any_model,
            )
        },
        false=Falsehood("nu0*(w^2 + A)", "nu0*w^2"),
    ),
    "theorem-nutation": Trial(
        model=nutation_model, signs={r"\nu_n^2": "nun2"}, false=Falsehood("A*(3*nu0^2 - 1)", "A*(3*nu0^2 + 1)")
    ),
    "theorem-companion-range": Trial(
        model=range_model,
        signs={"q": "q"},
        defines=("e_plus", "e_minus"),
        false=Falsehood("(z - nu0^2)/z", "(z + nu0^2)/z"),
    ),
    "theorem-companion-roots": Trial(
        model=family_model,
        also=("q(nu) = A*(nu - nu0)^2*(nu - e)*(nu + 2*nu0 + e)",),
        false=Falsehood("(3*nu0 + e)", "(3*nu0 - e)"),
    ),
    "theorem-companion": Trial(
        model=family_model,
        signs={r"\Lambda": "L"},
        defines=("spinor", "L"),
        solves=_SPINOR,
        false=Falsehood("sin(delta - kappa)", "sin(delta + kappa)"),
    ),
    "theorem-companion-nutation": Trial(
        model=double_model,
        defines=("nu",),
        solves="d(nu)^2 = q(nu); 2*d2(nu) = dq(nu); q(e) = 0",
        false=Falsehood("(c - A*(e - nu0)^2)*S^2", "c*S^2"),
    ),
    "theorem-companion-triple": Trial(
        model=triple_model,
        signs={"q": "q(nu)"},
        defines=("nu",),
        solves="d(nu)^2 = q(nu); 2*d2(nu) = dq(nu)",
        false=Falsehood("4*nu0/(1 + 4", "2*nu0/(1 + 4"),
    ),
    "theorem-axis-stable": Trial(
        excluded=(r"$p = (\mathbf{M}, \mathbf{K})/b$", "$M_1 = M_2 = 0$"),
        model=axis_model,
        defines=("D",),
        also=("d(M1^2 + M2^2 - A*(1 - nu^2)) = 0; d(p) = 0",),
        false=Falsehood("1/4*D*(1 - nu^2)", "1/4*M3^2*(1 - nu^2)"),
    ),
    "theorem-axis-escape": Trial(
        excluded=("$M_3 = I c_3$",),
        model=escape_model,
        signs={r"\lvert M_3\rvert": "size"},
        defines=("spinor",),
        solves=_SPINOR.replace("p - M3", "M3 - M3"),
        false=Falsehood("size/(b*sqrt(I - 1)) - 1", "1 - size/(b*sqrt(I - 1))"),
    ),
    "theorem-axis-pushed": Trial(model=pushed_model, false=Falsehood("M3^2*(1 + x)^2", "M3^2")),
    "theorem-axis-pendulum": Trial(
        model=pendulum_model,
        defines=("nu",),
        solves="d(nu)^2 = q(nu); at0(d(nu)) < 0",
        false=Falsehood("nu = -tanh", "nu = tanh"),
    ),
}
