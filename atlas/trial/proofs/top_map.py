"""The energy-momentum map of a symmetric top on trial: cusps, focus-focus values, and the residues of its angles."""

import sympy

from atlas.trial.proofs.model import Model, Value, direction, dot, functions, vector
from atlas.trial.proofs.top import M3, QUARTIC, A, a, g, nu, p
from atlas.trial.proofs.trial import Falsehood, Trial

SIGNS = {
    "q": "q()",
    r"\nu_c": "nuc",
    r"\dot\psi": "psi1",
    r"\boldsymbol\pi": "momentum",
    r"d\psi": "dpsi",
    r"\frac{d\nu}{\sqrt q}": "1",
    r"\operatorname{res}_{\sigma}^2d\psi": "res_dpsi^2",
    r"\operatorname{res}_\sigma d\psi": "res_dpsi",
    r"\operatorname{res}_\sigma d\chi": "res_dchi",
}
r, k2, kappa, spin = sympy.symbols("nuc k2 kappa spin", real=True)


def cusp_model() -> Model:
    """Return the model of theorem-cusp: any constants of q, and psi1, the rate of precession as a function of nu.

    nuc is the value of nu at the cusp.
    """
    letters = {"nu": nu, "nuc": r, "a": a, "A": A, "M3": M3, "g": g, "k2": k2, "p": p}
    return Model({**letters, "psi1": (p - M3 * nu) / (1 - nu**2) - k2, **functions("q", QUARTIC, nu)})


def spin_model() -> list[Model]:
    """Return two models of theorem-focus, sigma = 1 and -1: any state M, b (3, 1) with |b| = 1.

    sigma is the sense of the spin about e3 near which the state is; z is (b1, b2), `momentum` (M1, M2) less sigma
    M3 z/2.
    """
    models = []
    for sense in (1, -1):
        M, b = vector("M"), vector("b")
        letters: dict[str, Value] = {"sigma": sympy.Integer(sense), "a": a, "A": A, "nu": b[2], "M3": M[2]}
        tilt = sympy.Matrix(b[:2])
        letters |= {"z": tilt, "momentum": sympy.Matrix(M[:2]) - sense * M[2] * tilt / 2}
        letters |= {"p": dot(M, b), "g": M[0] ** 2 + M[1] ** 2 + 2 * a * b[2] + A * b[2] ** 2}
        models.append(Model(letters, list(zip(b, direction(), strict=True))))
    return models


def residue_model() -> list[Model]:
    """Return two models of theorem-residue, sigma = 1 and -1: residues of dpsi and dchi at nu = sigma.

    `res_dpsi` and `res_dchi` are those of the rates of psi and chi over sqrt(q), `root` is sqrt(q) there.
    """
    turn, cases = (p - M3 * nu) / (1 - nu**2), []
    for sense in (1, -1):
        letters = {"nu": nu, "M3": M3, "p": p, "k2": k2, "sigma": sympy.Integer(sense), **functions("q", QUARTIC, nu)}
        rates = {"dpsi": turn - k2, "dchi": spin - nu * turn + kappa * nu}
        root = sympy.I * (p - sense * M3)  # of q at nu = sigma
        letters |= {f"res_{name}": sympy.cancel((nu - sense) * f).subs(nu, sense) / root for name, f in rates.items()}
        cases.append(Model({**letters, "dpsi": rates["dpsi"], "root": root}))
    return cases


TRIALS = {
    "theorem-cusp": Trial(
        arrows={1: None}, model=cusp_model, defines=("p",), false=Falsehood(" - k2^2*(1 - nuc^2)", "")
    ),
    "theorem-focus": Trial(
        model=spin_model, excluded=(r"$g = 2 \sigma a + A$",), defines=("D",), false=Falsehood("4*(sigma*a + A)", "4*A")
    ),
    "theorem-residue": Trial(
        model=residue_model, also=("root^2 = q(sigma)",), false=Falsehood("-sigma*res_dpsi", "res_dpsi")
    ),
}
