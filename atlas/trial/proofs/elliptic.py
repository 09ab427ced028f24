"""The paper's family for a body with any three moments of inertia, on trial."""

import sympy
from sympy.polys.matrices import DomainMatrix

from atlas.trial.proofs.clebsch import AXES, MOMENTS, K, M, determinant
from atlas.trial.proofs.model import Model, Value, cross, dot
from atlas.trial.proofs.notation import sides
from atlas.trial.proofs.trial import Falsehood, Part, Trial, read

SIGNS = {
    "M": "M[]",
    "K": "K[]",
    "I_i": "I[i]",
    "x": "x[]",
    "b^2": "dot(K, K)",
    r"\sum_i": "sum over i",
    "P'": "P1",
    # x_i (x_j + x_k) - x_j x_k, with i, j, k all different
    "x_ix_j+x_ix_k-x_jx_k": "(x[i]*(x[1] + x[2] + x[3] - x[i]) - x[1]*x[2]*x[3]/x[i])",
}
z = sympy.Symbol("z", positive=True)
v, D, ONE = sympy.Symbol("v", real=True), determinant(AXES), sympy.eye(3)
X = sympy.diag(*(z + D / moment for moment in MOMENTS))
P = sympy.expand(X.det())
LETTERS = {"M": M, "K": K, "J": AXES, "D": D, "z": z, "v": v, "P": P, "P1": P.diff(z), "P2": P.diff(z, 2)}
LETTERS |= {"I": dict(enumerate(MOMENTS, 1)), "x": dict(enumerate(X.diagonal(), 1)), "one": ONE}
LETTERS |= {"e2": sum(D / moment for moment in MOMENTS), "s": dot(K, X.inv() * K), "elliptic": -v * X.inv() * K}
LETTERS |= {f"I{n}": moment for n, moment in enumerate(MOMENTS, 1)} | {"g": AXES.trace() / 2 * ONE - AXES}


def energy(momentum: Value) -> Value:
    """Return the expression H = (M, J^-1 M)/2 + (K, J K)/2 of theorem-lie-poisson for a momentum M (3, 1).

    J is the diagonal tensor of inertia and K the field, both symbols of this file.
    """
    return dot(momentum, AXES.inv() * momentum) / 2 + dot(K, AXES * K) / 2


def clebsch(momentum: Value) -> Value:
    """Return the expression F = M^2 - det(J) (K, J^-1 K) of theorem-clebsch for a momentum M (3, 1).

    J and K are as for `energy`.
    """
    return dot(momentum, momentum) - D * dot(K, AXES.inv() * K)


def elliptic_model() -> Model:
    """Return the model of any K, z, v and principal moments, with the rate of K that theorem-elliptic claims.

    That rate is [K, Omega] for Omega = -v (z J + D)^-1 K - K; see `LETTERS` for the letters.
    """
    return Model(LETTERS, flow=dict(zip(K, cross(K, -v * (z * AXES + D * ONE).inv() * K), strict=True)))


def integrals_model() -> Model:
    """Return the model of any M, K, z, v, and any variations m, k (3, 1 each) of M and K, for theorem-splitting.

    X is the diagonal matrix of x_i = z + D/I_i; `normal` (3, 1) is a vector of the proof.
    """
    letters = {name: sympy.Matrix(sympy.symbols(f"{name}1:4", real=True)) for name in ("m", "k")}
    letters["normal"] = X.inv() * (LETTERS["P1"] * ONE - 2 * P * X.inv()) * K
    return Model({**LETTERS, **letters, "X": X})


def multipliers_model() -> Model:
    """Return the model of theorem-critical: any M, K with H, F, and the multipliers z, v, w of the critical points.

    H is `energy`, F is `clebsch`; w multiplies K^2/2; y_i = D I_i - z D/I_i + w are the coefficients of K_i.
    """
    w = sympy.Symbol("w", real=True)
    y = {n: D * moment - z * D / moment + w for n, moment in enumerate(MOMENTS, 1)}
    letters = {**LETTERS, "H": energy(M), "F": clebsch(M), "w": w, "y": y, "a": [D / moment for moment in MOMENTS]}
    return Model(letters, ranges={"i": (1, 2, 3)})


def root_model(*, elliptic: bool = False) -> Model:
    """Return the model of v = sqrt(P) with H, F and c, the scalar product of M and K, at any M, without rates.

    If ``elliptic``, M is that of the elliptic motion, -v X^-1 K. P = x_1 x_2 x_3 with x_i = z + D/I_i, the diagonal of
    X, D = I1 I2 I3; H is `energy` and F is `clebsch`.
    """
    momentum = LETTERS["elliptic"] if elliptic else M
    letters = {"H": energy(momentum), "F": clebsch(momentum), "c": dot(momentum, K)}
    return Model({**LETTERS, **letters}, [(v, sympy.sqrt(P))], ranges={"i": (1, 2, 3)})


def edge_model() -> list[Model]:
    """Return two models of any M and K with I3 the largest moment, for theorem-edge: I1 <= I2 <= I3, I2 <= I1 <= I3."""
    gap, rise = sympy.symbols("first second", nonnegative=True)
    (I1, I2, I3), cases = MOMENTS, []
    for order in ({I2: I1 + gap, I3: I1 + gap + rise}, {I1: I2 + gap, I3: I2 + gap + rise}):
        letters = {**LETTERS, "H": energy(M), "F": clebsch(M)}
        swapped = {name: value.xreplace(order) for name, value in letters.items() if isinstance(value, sympy.Basic)}
        cases.append(Model({**letters, **swapped}, domains={"first": "positive", "second": "positive"}))
    return cases


def critical_model() -> Model:
    """Return the model of theorem-bifurcation: F and 2 D H on elliptic motions as functions of z, at any b and c.

    b is the length of K, c the scalar product of M and K, P is v^2. The time of the model is z, with v' = P'/2v, so
    that `d` of a line is the derivative by z.
    """
    b, c = sympy.symbols("b c", real=True)
    letters = {name: LETTERS[name] for name in ("z", "v", "D", "e2", "P1", "P2")} | {"b": b, "c": c, "P": v**2}
    letters["C"] = 4 * b**2 * v**2 - c / v * (LETTERS["P1"] ** 2 - 2 * v**2 * LETTERS["P2"])
    return Model(letters, flow={z: sympy.Integer(1), v: LETTERS["P1"] / (2 * v)})


def free_model() -> Model:
    """Return the model of a free body of moments J_i with Omega_i = s K_i/J_i, and any K with the rate [K, Omega].

    It serves theorem-free-body, whose line defines the moments I_i of a charged body that turns alike.
    """
    K, s, moments = LETTERS["K"], sympy.Symbol("s", real=True), sympy.symbols("J1:4", positive=True)
    letters = {"K": K, "s": s, **{f"J{n}": moment for n, moment in enumerate(moments, 1)}, "one": ONE}
    spin = sympy.Matrix([s * x / moment for x, moment in zip(K, moments, strict=True)])
    return Model(letters, flow=dict(zip(K, cross(K, spin), strict=True)))


def system_model() -> Model:
    """Return the model of any Omega and K with the rates (16), (35), and any diagonal matrices X and Y.

    It serves theorem-identifiable; x and y are the columns of their diagonals.
    """
    x, y, Omega = (sympy.Matrix(sympy.symbols(f"{name}1:4", real=True)) for name in ("x", "y", "Omega"))
    g, field = AXES.trace() * ONE - 2 * AXES, cross(K, Omega)
    rates = AXES.inv() * (cross(AXES * Omega, Omega) - cross(g * K, Omega))
    letters = {f"I{n}": moment for n, moment in enumerate(MOMENTS, 1)} | {"x": x, "y": y, "K": K, "Omega": Omega}
    letters |= {"X": sympy.diag(*x), "Y": sympy.diag(*y), "one": ONE}
    return Model(letters, flow=dict(zip([*Omega, *K], [*rates, *field], strict=True)), laws="Omega by (16), K by (35)")


def unidentified_model() -> Model:
    """Return the model of theorem-unidentified: K turns as the angular momentum s K of a free body with moments J_i.

    A is the diagonal matrix of J_i (J_j + J_k); alpha, beta, gamma are any numbers.
    """
    moments = J1, J2, J3 = sympy.symbols("J1:4", positive=True)
    names = ("s", "alpha", "beta", "gamma")
    letters = {name: sympy.Symbol(name, real=True) for name in names} | {"K": K, "J": sympy.diag(*moments), "one": ONE}
    letters["A"] = sympy.diag(J1 * (J2 + J3), J2 * (J1 + J3), J3 * (J1 + J2))
    return Model(letters, flow=dict(zip(K, cross(K, letters["s"] * letters["J"].inv() * K), strict=True)))


def bodies_model(sign: int = 1) -> Model:
    """Return the model of I_i = J_i (J_j + J_k + s'), with s' of this ``sign`` (1 or -1), for theorem-free-body.

    Each J_i is a sum of two positive moments of mass.
    """
    (g1, g2, g3), s = sympy.symbols("g1:4", positive=True), sympy.Symbol("s", positive=True)
    moments = g2 + g3, g1 + g3, g1 + g2
    basis = sum(moments)
    return Model({f"I{n}": J * (basis - J + sign * s * basis) for n, J in enumerate(moments, 1)})


def linear_model() -> Model:
    """Return the model of theorem-splitting's flow of half the sum of squares, linearised about x_i M_i = -v K_i.

    `char` is the characteristic polynomial in lam of the linear flow's matrix (6, 6), `rates` the rates (6, 1) at
    the point. Here x_i = w_i^2, v = w1 w2 w3 and K_i = w_i k_i, so that all entries are polynomials.
    """
    w, k, lam = sympy.symbols("w1:4"), sympy.symbols("k1:4"), sympy.Symbol("lam")
    s1, s2, s3 = (root**2 for root in w)
    x, y = sympy.diag(s1, s2, s3), sympy.diag(s2 * s3, s1 * s3, s1 * s2)
    letters = {"lam": lam, "x": {1: s1, 2: s2, 3: s3}, "K": sympy.Matrix([k[i] * w[i] for i in range(3)])}
    rates = sympy.Matrix([*(cross(M, x * M) + cross(K, y * K)), *cross(K, x * M)])
    start = {M[i]: -k[i] * w[i - 1] * w[i - 2] for i in range(3)} | {K[i]: k[i] * w[i] for i in range(3)}
    flow = DomainMatrix.from_Matrix(rates.jacobian([*M, *K]).subs(start, simultaneous=True))
    letters["rates"] = rates.subs(start, simultaneous=True)
    letters["char"] = sum(flow.domain.to_sympy(c) * lam**n for n, c in enumerate(reversed(flow.charpoly())))
    return Model(letters)


_SYSTEM = {r"(\operatorname{tr}Y-2Y)": "(tr(Y)*one - 2*Y)", "J^{-1}": "inv(J)"}


def _component(i: int, j: int, k: int) -> str:
    """Return the line of component i of theorem-identifiable; (i, j, k) is (1, 2, 3) or a cyclic permutation."""
    share, half = f"x{i}/I{i}*(I{j} - I{k})", f"(y{i} - x{i})"
    field = f"({share} - y{j} + y{k} + {half})*K{j}*Omega{k} + ({share} - y{j} + y{k} - {half})*K{k}*Omega{j}"
    equation = "(X*d(Omega) - cross(X*Omega,Omega) + cross((tr(Y)*one - 2*Y)*K,Omega))"
    return f"{equation}[{i}] = ({share} - x{j} + x{k})*Omega{j}*Omega{k} + {field}"


_SPLITTING = read("theorem-splitting", SIGNS | {r"\det(\lambda-\Lambda)": "char", r"\lambda": "lam"})
_C = sides(_SPLITTING.split("; ")[3])[1]

TRIALS = {
    "theorem-elliptic": Trial(
        model=elliptic_model,
        signs={
            "x": "x",
            r"v^2=P": "P",
            r"(zJ+D)^{-1}": "inv(z*J + D*one)",
            r"[1+v(zJ+D)^{-1}]": "(one + v*inv(z*J + D*one))",
        },
        defines=("Omega", "E", "P"),
        solves="d(K) = cross(K,Omega); J*d(Omega) - cross(J*Omega,Omega) + 2*cross(g*K,Omega)"
        " = (1 - v^2/P)*cross(J*K,K)",
        false=Falsehood("z + D/I[1]", "D/I[1]"),
    ),
    "theorem-free-body": Trial(
        model=free_model,
        defines=("Omega", "I1", "I2", "I3"),
        solves="d(K) = cross(K,Omega); diag(I1,I2,I3)*d(Omega) = cross(diag(I1,I2,I3)*Omega,Omega)"
        " - cross(((I1 + I2 + I3)*one - 2*diag(I1,I2,I3))*K,Omega)",
        also=(
            Part(
                line="I1 > 0; I2 > 0; I3 > 0; I2 + I3 - I1 > 0; I1 + I3 - I2 > 0; I1 + I2 - I3 > 0", model=bodies_model
            ),
        ),
        false=Falsehood("I2 + I3 - I1 > 0", "I2 + I3 - I1 > 0", lambda: bodies_model(-1)),
    ),
    "theorem-identifiable": Trial(
        model=system_model,
        signs=_SYSTEM | {"N": "N[]"},
        defines=("N",),
        also=(
            _component(2, 3, 1),
            _component(3, 1, 2),
            "(I2 - I3)*(I3 - I1) + I1*I2 = I3*(I1 + I2 - I3)",
            "-(I2 - I3)*I2 - I1*I2 = -I2*(I1 + I2 - I3)",
            "(I2 - I3)*I3 - I1*I3 = -I3*(I1 + I3 - I2)",
        ),
        false=Falsehood("- x[2] + x[3]", "- I2 + I3"),
    ),
    "theorem-unidentified": Trial(
        model=unidentified_model,
        signs=_SYSTEM,
        defines=("Omega", "X", "Y"),
        false=Falsehood("beta*A + alpha*s*J", "beta*A + gamma*s*J"),
    ),
    "theorem-splitting": Trial(
        model=root_model,
        excluded=("$x_iM_i=-vK_i$",),
        signs={r"\det(\lambda-\Lambda)": "char", r"\lambda": "lam"},
        defines=("C",),
        elsewhere={2: linear_model, 3: linear_model},
        also=(
            Part(line="rates[n] = 0", model=linear_model),
            Part(
                line=f"4*dot(K,K)*P + s*(P1^2 - 2*P*P2) = {_C};"
                " P1^2 - 2*P*P2 = (x[2]*x[3])^2 - 2*x[2]*x[3]*x[1]*(x[2] + x[3]) + x[1]^2*(x[2] - x[3])^2",
                model=integrals_model,
            ),
            Part(
                line="dot(normal,X*m + v*k) = 2*v*(dot(elliptic,m) - D*dot(K,inv(J)*k)) + P1*(dot(elliptic,k)"
                " + dot(K,m)) + 2*v*(2*z + e2)*dot(K,k) + 2*(v^2 - P)*dot(K,inv(X)*m);"
                " dot(normal,X*normal) = 4*dot(K,K)*P + s*(P1^2 - 2*P*P2)",
                model=integrals_model,
            ),
        ),
        false=Falsehood("lam^4*(lam^2 + C)", "lam^6"),
    ),
    "theorem-critical": Trial(
        model=multipliers_model,
        signs={
            r"\frac{\partial G}{\partial M_i}": "partial(G, M)[i]",
            r"\frac{\partial G}{\partial K_i}": "partial(G, K)[i]",
            "y_i": "y[i]",
        },
        defines=("G",),
        also=(
            "partial(F/2 + v*dot(M,K) + w/2*dot(K,K), M)[i] = M[i] + v*K[i]",
            "partial(F/2 + v*dot(M,K) + w/2*dot(K,K), K)[i] = (w - D/I[i])*K[i] + v*M[i]",
            "D*I[1] + 2*D^2/I[1]^2 - e2*D/I[1] = (D/I[1] - D/I[2])*(D/I[1] - D/I[3])",
        ),
        false=Falsehood("(w - z^2 - z*e2)", "w"),
    ),
    "theorem-bifurcation": Trial(
        model=critical_model,
        signs={
            "b^2": "b^2",
            "2DH": "G",
            r"\frac{dF}{dz}": "d(F)",
            r"\frac{dH}{dF}": "d(G)/(2*D*d(F))",
            r"\frac{d^2H}{dF^2}": "d(d(G)/(2*D*d(F)))/d(F)",
        },
        defines=("F", "G"),
        also=(
            Part(
                line="; ".join(read("theorem-bifurcation", SIGNS).split("; ")[:2]),
                model=lambda: root_model(elliptic=True),
            ),
        ),
        false=Falsehood(" = -z/(2*D)", " = -e2/(2*D)"),
    ),
    "theorem-edge": Trial(model=edge_model, false=Falsehood("(I1 + I2)*K^2", "I3*K^2")),
}
