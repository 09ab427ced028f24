"""Section II, second half, on trial: Euler-Poisson equations for any rotation and any inertia tensor, (10) to (18)."""

from functools import cache

import sympy

from atlas.trial.proofs.model import (
    Model,
    Value,
    cross,
    dot,
    hat,
    matrix,
    rotation,
    rotation_symbols,
    symmetric,
    vector,
)
from atlas.trial.proofs.notation import sides
from atlas.trial.proofs.trial import Falsehood, Trial, read

SIGNS = {
    "c": "light",
    "B": "Bf[]",
    r"\mathbf{B}": "Bf",
    r"\lambda": "Lam[]",
    r"\dot R": "dR[]",
    r"\ddot R": "ddR[]",
    r"I\dot{\boldsymbol{\Omega}}": "IdOmega",
    r"I_{ka}\dot\Omega_a": "IdOmega[k]",
    r"(\mathbf{B}R\boldsymbol{\Omega})": "dot(Bf, R*Omega)",
    r"(\mathbf{B}R)_a": "(T(R)*Bf)[a]",
}
RIGHT_OF_11 = sides(read("(11)", SIGNS))[1]

(R, ROTATION), Omega, Bf = rotation_symbols(), vector("Omega"), vector("B")
mu, c = sympy.symbols("mu c", positive=True)
g = symmetric("g")
moments = g.trace() * sympy.eye(3) - g
COMMON = {"R": R, "Omega": Omega, "Bf": Bf, "mu": mu, "light": c}


def _antisymmetric(S: Value) -> Value:
    return sympy.Matrix([S[1, 2] - S[2, 1], S[2, 0] - S[0, 2], S[0, 1] - S[1, 0]])


@cache
def multiplier_model() -> Model:
    """Return the model of (10) with any matrix A and multipliers Lam: (10) holds if and only if Lam is symmetric.

    `ddR` is the second rate of R: R^T d2R = hat(Omega)^2 + hat(w), with w the rate of Omega. `IdOmega` is I w,
    solved from the symmetry of Lam. Cached.
    """
    A, w = matrix("A"), vector("w")
    Lam = -(hat(Omega) ** 2 + hat(w) + R.T * A) * g
    skew = _antisymmetric(Lam)
    slope = skew.jacobian(w)
    remainder = skew.xreplace(dict.fromkeys(w, 0))
    solved = -(moments * slope.inv()).applyfunc(sympy.cancel) * remainder
    letters = {"A": A, "g": g, "I": moments, "Lam": Lam, "w": w, "IdOmega": solved}
    return Model({**COMMON, **letters, "ddR": R * (hat(Omega) ** 2 + hat(w))}, ROTATION)


def mirrored_model() -> Model:
    """Return `multiplier_model` with -R in the place of R, for the corrected text-affirmation.

    -R stands for the orthogonal matrices of determinant -1: all but those opposite to a half turn.
    """
    basis = multiplier_model()
    minus = {entry: -entry for entry in R}
    letters = {
        name: value.xreplace(minus) for name, value in basis.letters.items() if isinstance(value, sympy.MatrixBase)
    }
    return Model({**basis.letters, **letters}, ROTATION)


def magnetic_model() -> Model:
    """Return `multiplier_model` with the magnetic force of (7) as its matrix A, for (13) to (16); dR = R hat(Omega)."""
    letters, dR = multiplier_model().letters, R * hat(Omega)
    force = sympy.Matrix(3, 3, lambda i, a: (mu / c * Bf.cross(dR.col(a)))[i])
    return Model({**letters, "dR": dR}, [*zip(letters["A"], force, strict=True), *ROTATION])


def euler(tensor: Value, mass: Value, field: Value) -> Value:
    """Return I dOmega/dt by (16) as corrected, (3, 1), for the symbols Omega of this file.

    ``tensor`` is the inertia tensor I, ``mass`` the tensor g of mass moments, ``field`` is R^T B.
    """
    return cross(tensor * Omega, Omega) - mu / c * cross(mass * field, Omega)


def momentum_model() -> Model:
    """Return the model of angular momentum in the body's axes, M, and in space, m = R M, for (17) and (18).

    dM and dm are the rates by (16) and (12). M is any vector and J any symmetric matrix, the inverse of I: Omega = J M.
    The proof needs no more of them.
    """
    M, J = vector("M"), symmetric("J")
    spin = J * M
    rate = cross(M, spin) - mu / c * cross(g * R.T * Bf, spin)
    letters = {
        "I": sympy.ImmutableMatrix(moments),
        "inv": {sympy.ImmutableMatrix(moments): J}.__getitem__,
        "g": g,
        "M": M,
        "m": R * M,
    }
    return Model({**COMMON, **letters, "dm": R * (cross(spin, M) + rate), "dM": rate}, ROTATION)


def poisson_model() -> Model:
    """Return the model of (12): any rotation R(q1, q2, q3) with any rates of q; Omega (3, 1) is read off R^T dR/dt."""
    R = rotation()
    parameters = sympy.symbols("q1:4", real=True)
    flow = dict(zip(parameters, sympy.symbols("p1:4", real=True), strict=True))
    dR = R.applyfunc(lambda entry: sum((entry.diff(q) * p for q, p in flow.items()), sympy.Integer(0)))
    W = (R.T * dR).applyfunc(sympy.cancel)
    start = dict.fromkeys(parameters, sympy.Integer(0))
    return Model({"R": R, "Omega": sympy.Matrix([W[2, 1], W[0, 2], W[1, 0]])}, flow=flow, start=start)


def matrix_flow_model() -> Model:
    """Return the model of any matrix R with the rate R hat(Omega), (12); for text-orthogonal."""
    entries = matrix("R")
    return Model(
        {"R": entries, "Omega": Omega}, flow=dict(zip(entries, entries * hat(Omega), strict=True)), laws="R by (12)"
    )


def diagonal_model() -> Model:
    """Return the model of tensors I (inertia) and g (mass) on principal axes, any K and Omega, for (15)."""
    g1, g2, g3 = sympy.symbols("g1:4", positive=True)
    diagonal = sympy.diag(g1, g2, g3)
    tensor = diagonal.trace() * sympy.eye(3) - diagonal
    K = vector("K")
    letters = {"g": diagonal, "I": tensor, "K": K, "Omega": Omega, "g1": g1, "g2": g2, "g3": g3}
    letters |= {f"I{n + 1}": tensor[n, n] for n in range(3)}
    return Model(letters)


def axes_model() -> Model:
    """Return the model of text-inertia-axes: three masses on principal axes, rotated by R.

    `turned` is their inertia tensor in space, I that on principal axes, `moment` its entries by index; `column` are the
    columns of R, `e` the unit vectors.
    """
    masses, places = sympy.symbols("m1:4", positive=True), sympy.symbols("x1:4", positive=True)
    positions = [R.col(n) * x for n, x in enumerate(places)]
    tensor = sum((m * (dot(x, x) * sympy.eye(3) - x * x.T) for m, x in zip(masses, positions, strict=True)), R * 0)
    moments = [m * x**2 for m, x in zip(masses, places, strict=True)]
    letters = {"R": R, "turned": tensor, "I": sympy.diag(*(sum(moments) - moment for moment in moments))}
    letters |= {"column": {n + 1: R.col(n) for n in range(3)}, "e": {n + 1: sympy.eye(3).col(n) for n in range(3)}}
    letters["moment"] = {n + 1: letters["I"][n, n] for n in range(3)}
    start = dict(zip(R, sympy.eye(3), strict=True))
    return Model(letters, ROTATION, start=start, ranges={"i": (1, 2, 3)})


def inertia_model() -> Model:
    """Return the model of g and I of four particles, for text-inertia-tensor.

    I is the matrix (3, 3) of second derivatives of the kinetic energy by Omega, g the sum of m x x^T.
    """
    masses = sympy.symbols("m1:5", positive=True)
    places = [vector(f"x{n}_") for n in range(1, 5)]
    energy = sum(m * Omega.cross(x).dot(Omega.cross(x)) for m, x in zip(masses, places, strict=True)) / 2
    mass = sum((m * x * x.T for m, x in zip(masses, places, strict=True)), sympy.zeros(3, 3))
    return Model({"I": sympy.hessian(sympy.expand(energy), list(Omega)), "g": mass})


def grioli_model() -> Model:
    """Return the model of (16) with B = (0, 0, b), for text-grioli.

    G3 is the third row of R as a column (3, 1), IdOmega is I dOmega/dt.
    """
    b = sympy.Symbol("b", positive=True)
    field = sympy.Matrix([0, 0, b])
    return Model(
        {**COMMON, "I": moments, "g": g, "Bf": field, "G3": R.row(2).T, "IdOmega": euler(moments, g, R.T * field)},
        ROTATION,
    )


def algebraic_model() -> Model:
    """Return `multiplier_model` on principal axes, for text-multipliers-algebraic: g and I diagonal, any matrix A."""
    basis = multiplier_model()
    swap = {g[i, j]: 0 for i in range(3) for j in range(3) if i != j}
    letters = {**basis.letters, "g": g.xreplace(swap), "I": moments.xreplace(swap)}
    return Model({**letters, "IdOmega": basis.letters["IdOmega"].xreplace(swap)}, ROTATION)


def moments_model() -> list[Model]:
    """Return two models of moments of mass g1, g2, g3 and of inertia I1, I2, I3: g3 > 0, and g3 = 0 (a plane body)."""
    g1, g2, g3 = sympy.symbols("g1:4", positive=True)
    cases = []
    for third in (g3, sympy.Integer(0)):
        letters = {"g1": g1, "g2": g2, "g3": third, "I1": g2 + third, "I2": g1 + third, "I3": g1 + g2}
        letters |= {"g": sympy.diag(g1, g2, third), "I": sympy.diag(g2 + third, g1 + third, g1 + g2)}
        cases.append(Model(letters))
    return cases


def covariance_model(sign: int = 1) -> Model:
    """Return the model of text-covariance: S is ``sign`` (1 or -1) times any rotation of the laboratory.

    Omega and K are any vectors, I and g any symmetric tensors.
    """
    symbols, bindings = rotation_symbols("S")
    letters = {"S": sign * symbols, "I": symmetric("I"), "g": symmetric("g"), "K": vector("K")}
    return Model({**letters, "Omega": Omega, "mu": mu, "light": c}, bindings)


def flight_model() -> Model:
    """Return the model of text-flight: four particles of a body in flight in fields E and B, with centre y0.

    By particle: `x` places from the centre of mass, `moved` those rotated by R, `y` those in space. w is any dOmega/dt,
    IdOmega is I dOmega/dt by (16).
    """
    masses = dict(enumerate(sympy.symbols("m1:5", positive=True), 1))
    places = {N: vector(f"x{N}_") for N in (1, 2, 3)}
    places[4] = -sum((masses[N] * places[N] for N in places), sympy.zeros(3, 1)) / masses[4]
    mass = sum((masses[N] * places[N] * places[N].T for N in masses), sympy.zeros(3, 3))
    inertia = mass.trace() * sympy.eye(3) - mass
    E, y0, velocity, w = vector("E"), vector("y"), vector("v"), vector("w")
    letters = {**COMMON, "m": masses, "x": places, "E": E, "y0": y0, "w": w, "I": inertia}
    letters["moved"] = {N: R * place for N, place in places.items()}
    letters |= {
        "y": {N: y0 + place for N, place in letters["moved"].items()},
        "IdOmega": euler(inertia, mass, R.T * Bf),
    }
    rates = [*velocity, *(mu * E + mu / c * cross(velocity, Bf)), *(R * hat(Omega)), *w]
    flow = dict(zip([*y0, *velocity, *R, *Omega], rates, strict=True))
    start = dict(zip(R, sympy.eye(3), strict=True))
    return Model(letters, ROTATION, flow, start, ranges={"N": (1, 2, 3, 4)})


_AFFIRMED = f"eps[k,i,j]*Lam[i,j] = I[k,a]*w[a] - ({RIGHT_OF_11})"

TRIALS = {
    "(10)": Trial(model=multiplier_model, definition=True),
    "text-affirmation": Trial(
        signs={r"\text{(10)}\iff\text{(11), (12)}": _AFFIRMED},
        corrected_signs={r"\text{(10)},\ R_{ij}(0)=\delta_{ij}\iff\text{(11), (12)}": _AFFIRMED},
        model=multiplier_model,
        corrected_model=lambda: (multiplier_model(), mirrored_model()),
        false=Falsehood(" - 1/2*I[k, a]*eps[a, i, j]*A[b, i]*R[b, j]", ""),
    ),
    "text-multipliers-algebraic": Trial(
        signs={
            r"\lambda": "lam",
            r"\hat\Omega": "hat(Omega)",
            r"\hat w": "hat(w)",
            r"\{\text{right side of (11)}\}": "IdOmega",
        },
        model=algebraic_model,
        defines=("lam", "w"),
        solves="R*(hat(Omega)^2 + hat(w))*g = -R*lam - A*g",
        false=Falsehood("hat(Omega)^2 + ", ""),
    ),
    "text-nondegenerate": Trial(
        model=lambda: moments_model()[0],
        corrected_model=moments_model,
        false=Falsehood("det(I) = I1*I2*I3 != 0", "det(g) = g1*g2*g3 != 0"),
    ),
    "(11)": Trial(model=multiplier_model),
    "(12)": Trial(signs={r"\dot R": "d(R)"}, model=poisson_model),
    "text-inertia-tensor": Trial(model=inertia_model, false=Falsehood("g[a, a]*delta[i, j] - g[i, j]", "g[i, j]")),
    "text-mass-moments": Trial(model=diagonal_model, false=Falsehood("I2 + I3 - I1", "I2 + I3 + I1")),
    "text-inertia-axes": Trial(
        signs={r"\mathbf{R}": "column[]", r"\mathbf{e}": "e[]", "I_i": "moment[i]"},
        also=("turned = R*I*T(R)",),
        model=axes_model,
        false=Falsehood("turned = R*I*T(R)", "turned = T(R)*I*R"),
    ),
    "text-orthogonal": Trial(model=matrix_flow_model, false=Falsehood("R*T(R)", "T(R)*R")),
    "text-covariance": Trial(
        defines=("Ip", "gp", "Omegap", "Kp"),
        also=("hat(S*Omega) = S*hat(Omega)*T(S)",),
        model=covariance_model,
        false=Falsehood(model=lambda: covariance_model(-1)),
    ),
    "text-force-matrix": Trial(model=magnetic_model),
    "(13)": Trial(model=magnetic_model),
    "(14)": Trial(model=magnetic_model),
    "(15)": Trial(signs={r"R^T\mathbf{B}": "K"}, model=diagonal_model),
    "text-other-components": Trial(
        signs={r"R^T\mathbf{B}": "K"},
        model=diagonal_model,
        false=Falsehood("2*cross(g*K, Omega)", "2*cross(K, g*Omega)"),
    ),
    "(16)": Trial(model=magnetic_model),
    "(17)": Trial(signs={r"\dot{\mathbf{m}}": "dm"}, model=momentum_model),
    "(18)": Trial(signs={r"\dot{\mathbf{M}}": "dM"}, model=momentum_model),
    "text-grioli": Trial(
        signs={"I'": "I", "g'": "g", r"I'\dot{\boldsymbol{\Omega}}": "IdOmega"},
        model=grioli_model,
        false=Falsehood("cross(g*G3, Omega)", "cross(g*[R[1,3], R[2,3], R[3,3]], Omega)"),
    ),
    "text-flight": Trial(
        signs={r"\mathbf{y}_0": "y0", r"\mathbf{y}": "y[]", r"\mathbf{x}": "moved[]"},
        model=flight_model,
        also=(
            "R*(I*w - IdOmega) = m[N]*cross(R*x[N], d2(y[N]) - mu*E - mu/light*cross(d(y[N]),Bf))",
            "0 = m[N]*(d2(y[N]) - mu*E - mu/light*cross(d(y[N]),Bf))",
        ),
        false=Falsehood("mu/light*cross(d(y[N]),Bf)", "mu*E"),
    ),
}
