"""The general motion of the symmetric body on trial: the top of Larmor's frame, and its sigma functions."""

import sympy

from atlas.trial.proofs.clebsch import symmetric_model
from atlas.trial.proofs.model import Model, Value, direction, dot, functions
from atlas.trial.proofs.trial import Falsehood, Trial, evaluated

SIGNS = {
    "E'": "E",
    "q": "q()",
    "Q": "Q()",
    "Q'": "dQ()",
    "Q''": "ddQ()",
    r"\dot\psi": "psi1",
    r"\dot\chi": "chi1",
    r"\zeta": "zeta()",
    r"\sigma": "sigma()",
    r"\lambda": "lam[]",
    r"\lambda_-": "lam_minus",
    r"\lambda_+": "lam_plus",
    "z_-": "z_minus",
    r"\wp(t)": "P",
}
I, b = sympy.symbols("I b", positive=True)
nu, c3, H, p, M3, e, A, g, u, t = sympy.symbols("nu c3 H p M3 e A g u t", real=True)
P, P1 = sympy.symbols("P P1", real=True)
QUARTIC = (1 - nu**2) * (g - A * nu**2) - (p - M3 * nu) ** 2
"""The quartic of the top, with A = (I - 1) b^2 and g = 2H - M3^2/I - b^2."""
G_AND_A = [(A, (I - 1) * b**2), (g, 2 * H - M3**2 / I - b**2)]


def top_model() -> Model:
    """Return the model of any state of the symmetric body, in units of I2, with the rates psi1 and chi1 of two angles.

    It serves theorem-top. K is b times a unit vector, nu = K3/b; M3, p = (M, K)/b and H are the constants of the
    top, psi1 the rate of precession about the field, chi1 that of the rotation about the axis.
    """
    basis = symmetric_model()
    K = sympy.Matrix([basis.letters[f"K{n}"] for n in (1, 2, 3)])
    bindings = list(zip(K, b * direction(), strict=True))
    I2, M, energy = (basis.letters[name] for name in ("I2", "M", "H"))
    turn = (basis.letters["Omega1"] * K[0] + basis.letters["Omega2"] * K[1]) / b / (1 - nu**2)
    letters = {**basis.letters, "b": b, "nu": nu, "M3": M[2] / I2, "p": dot(M, K) / (I2 * b), "H": energy / I2}
    letters |= {"psi1": turn, "chi1": basis.letters["Omega3"] - nu * turn}
    flow = {**basis.flow, nu: basis.flow[K[2]] / b}
    return Model(letters, [*bindings, (nu, K[2] / b)], flow, laws=basis.laws)


def letters_model() -> Model:
    """Return the model of theorem-top-quartic, with u, nu and the top's constants as free letters.

    `Q` is the quartic of u = Omega3 by theorem-quartic, `q` the quartic of nu by theorem-top, both as functions.
    """
    names = ("E", "c5", "Bsquare")
    letters = {name: sympy.Symbol(name, real=True) for name in names}
    letters |= {"I": I, "b": b, "c3": c3, "H": H, "p": p, "u": u, "M3": I * c3, "nu": nu}
    letters |= functions("Q", evaluated("theorem-quartic", SIGNS | {"b^2": "Bsquare"}, letters, 2), u)
    letters |= functions("q", evaluated("theorem-top", SIGNS, letters, 2), nu)
    return Model(letters, [(letters["Bsquare"], b**2)])


def weierstrass_model() -> Model:
    """Return the model of any quartic Q with a root e, for theorem-weierstrass; P is Weierstrass's function.

    P1 is its rate. That P1^2 = 4 P^3 - g2 P - g3 is the relation by which the line is solved; a0 to a4 are the
    coefficients of Q.
    """
    a = sympy.symbols("a0:4", real=True)
    remainder = -(a[0] * e**4 + 4 * a[1] * e**3 + 6 * a[2] * e**2 + 4 * a[3] * e)
    letters = {f"a{n}": value for n, value in enumerate((*a, remainder))} | {"e": e, "P": P, "P1": P1}
    basis = a[0] * u**4 + 4 * a[1] * u**3 + 6 * a[2] * u**2 + 4 * a[3] * u + remainder
    return Model({**letters, **functions("Q", basis, u)}, flow={P: P1})


def curve_model() -> Model:
    """Return the model of nu with the rate w, w^2 = q(nu), and Cayley-Klein parameters a, eta; for theorem-lame.

    Both parameters are those of the theorem up to a steady rotation; q is `QUARTIC`.
    """
    w, a, eta = sympy.symbols("w a eta", real=True)
    letters = {"nu": nu, "p": p, "M3": M3, "I": I, "b": b, "A": A, "a": a, "eta": eta}
    letters |= {"H": (g + M3**2 / I + b**2) / 2, "C": (g + M3**2) / 4}
    bindings = [(A, (I - 1) * b**2), (g, (w**2 + (p - M3 * nu) ** 2) / (1 - nu**2) + A * nu**2)]
    turn = (p - M3 * nu) / (1 - nu**2)
    flow = {nu: w, w: QUARTIC.diff(nu) / 2}
    flow |= {a: a / 2 * (w / (1 + nu) + sympy.I * ((1 - nu) * turn + M3))}
    flow |= {eta: eta / 2 * (-w / (1 - nu) + sympy.I * ((1 + nu) * turn - M3))}
    return Model(letters, bindings, flow)


def residue_model() -> list[Model]:
    """Return two models of theorem-residues at nu = -1, for dnu/dt of sign 1 and -1.

    `residue` is the residue of the logarithmic rate of xi, `w` is dnu/dt.
    """
    w, cases = sympy.Symbol("w", real=True), []
    rate = (
        w + sympy.I * (p - M3 * nu)
    ) / 2  # times 1/(1 + nu): the part that is not finite there, by theorem-cayley-klein
    for sign in (1, -1):
        letters = {"nu": sympy.Integer(-1), "w": w, "p": p, "M3": M3, "sign": sympy.Integer(sign)}
        letters |= {"residue": (rate / w).subs(nu, -1), **functions("q", QUARTIC, nu)}
        cases.append(Model(letters, G_AND_A))
    return cases


def sigma_model() -> Model:
    """Return the model of theorem-sigma: q with a root e, P and P1 as in `weierstrass_model`, zeta and sigma.

    Both are functions: zeta(t - z) is zeta(t) - zeta(z) + (P'(t) + P'(z))/(P(t) - P(z))/2, and sigma gives a letter
    whose logarithmic rate is zeta. At the zero z of xi nu is -1, and P'(z) is i Y.
    """
    root = A * e**2 + (p - M3 * e) ** 2 / (1 - e**2)
    q = functions("q", QUARTIC.subs(g, root), nu)
    slope, bend = sympy.factor(q["dq"](e)), sympy.factor(q["ddq"](e))
    zt, zminus, z0, logarithm = sympy.symbols("zt z_minus z0 zeta_z", real=True)
    Z, Y = bend / 24 - slope / 4 / (1 + e), -(p + M3) * slope / 4 / (1 + e) ** 2
    W, w0 = bend / 24, sympy.Symbol("w0", real=True)
    vocabulary = {zminus: (logarithm, Z, sympy.I * Y), z0: (zt, W, w0)}
    factors: dict[Value, Value] = {}

    def zeta(argument: Value) -> Value:
        """Return Weierstrass's zeta of a place z, or of t + z or t - z by the addition theorem.

        Raises ValueError for any other argument.
        """
        if argument.coeff(t) == -1:
            return -zeta(-argument)
        place = next((symbol for symbol in vocabulary if argument.has(symbol)), t)
        value, height, rate = vocabulary[place]
        sign = argument.coeff(place)
        if sign**2 != 1 or argument not in {sign * place, t + sign * place}:
            raise ValueError(f"the addition theorem does not give zeta of {argument}")
        if not argument.has(t):
            return sign * value
        return sympy.Symbol("zeta_t", real=True) + sign * value + (P1 - sign * rate) / (P - height) / 2

    def sigma(place: Value) -> Value:
        """Return the letter for Weierstrass's sigma of ``place``, such as t - z; its logarithmic rate is zeta."""
        return factors.setdefault(place, sympy.Symbol(f"sigma{len(factors)}", positive=True))

    x = e + slope / 4 / (P - bend / 24)
    a = [sympy.Poly(q["q"](nu), nu).coeff_monomial(nu**n) / sympy.binomial(4, n) for n in (4, 3, 2, 1, 0)]
    letters: dict[str, Value] = {"p": p, "M3": M3, "c3": c3, "b": b, "e": e, "x": x, "Z": Z, "Y": Y, "t": t}
    letters |= {"z_minus": zminus, "z0": z0, "zeta": zeta, "sigma": sigma, "xi0": sympy.Symbol("xi0", positive=True)}
    letters["g2"] = a[0] * a[4] - 4 * a[1] * a[3] + 3 * a[2] ** 2
    letters["g3"] = sympy.Matrix([[a[0], a[1], a[2]], [a[1], a[2], a[3]], [a[2], a[3], a[4]]]).det(method="berkowitz")
    letters["lam_minus"] = (c3 - M3 - b + (p + M3) / (1 + e)) / 2
    letters["lam_plus"] = (M3 - c3 - b + (p - M3) / (1 - e)) / 2
    for argument in (t - zminus, t - z0, t + z0):
        sigma(argument)
    rates = {symbol: zeta(argument) * symbol for argument, symbol in factors.items()}
    return Model(letters, flow={P: P1, t: sympy.Integer(1), **rates})


TRIALS = {
    "theorem-top": Trial(
        excluded=(r"$p = (\mathbf{M}, \mathbf{K})/b$",),
        model=top_model,
        defines=("q",),
        also=("d(M3) = 0; d(p) = 0; d(H) = 0; M3 = I*c3",),
        false=Falsehood("(I - 1)*b^2*nu^2", "(I - 1)*b^2*nu"),
    ),
    "theorem-top-quartic": Trial(model=letters_model, defines=("E", "c5"), false=Falsehood("= b^2*q(", "= q(")),
    "theorem-weierstrass": Trial(
        model=weierstrass_model,
        defines=("u", "g2", "g3"),
        solves="(d(u)/P1)^2*(4*P^3 - g2*P - g3) = Q(u)",
        false=Falsehood("(P - ddQ(e)/24)", "(P + ddQ(e)/24)"),
    ),
    "theorem-lame": Trial(model=curve_model, false=Falsehood("3/4*A*nu^2 + 1/2*A*nu", "3/4*A*nu^2 - 1/2*A*nu")),
    "theorem-residues": Trial(
        model=residue_model,
        signs={r"\operatorname{res}_{\nu=-1}\frac{\dot\xi}{\xi}": "residue", r"\dot\nu": "w"},
        defines=("w",),
        false=Falsehood("= -(p + sign*M3)^2", "= (p + sign*M3)^2"),
    ),
    "theorem-sigma": Trial(
        model=sigma_model,
        defines=("xi",),
        solves="d(xi)/xi = 1/2*d(x)/(1 + x) + i/2*((p - M3*x)/(1 + x) + c3 - b)",
        also=("-Y^2 = 4*Z^3 - g2*Z - g3",),
        false=Falsehood("sigma(t - z_minus)", "sigma(t + z0)"),
    ),
}
