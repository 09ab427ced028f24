"""The structure behind the motion on trial: Larmor's frame, the bracket of e(3), and the integral of Clebsch."""

import sympy

from atlas.trial.proofs.model import Model, Value, cross, dot, hat, partial, rotation_symbols, symmetric, turn, vector
from atlas.trial.proofs.pseudo_oscillator import state_model
from atlas.trial.proofs.trial import Falsehood, Trial

SIGNS = {
    r"R_{\hat{\mathbf{B}}}": "about_B()",
    "M": "M[]",
    "K": "K[]",
    r"\operatorname{rank}\frac{\partial(H,F,(\mathbf{M},\mathbf{K}),\mathbf{K}^2)}{\partial(\mathbf{M},\mathbf{K})}": (
        "rank(H, F, dot(M, K), dot(K, K))"
    ),
}
Omega, K, M = vector("Omega"), vector("K"), vector("M")
J = symmetric("J")
MASS = J.trace() / 2 * sympy.eye(3) - J
I1, I2, I3 = MOMENTS = sympy.symbols("I1:4", positive=True)
AXES = sympy.diag(*MOMENTS)


def determinant(tensor: Value) -> Value:
    """Return the determinant of a SymPy matrix ``tensor``, by Berkowitz's method without division."""
    return tensor.det(method="berkowitz")


def tensor_model() -> Model:
    """Return the model of any Omega, K and symmetric inertia tensor J, with the rates (16) and (35).

    Letters also: W = Omega + K, M = J W, and H = (W, J W)/2 + (K, J K)/2, the conserved energy of theorem-lie-poisson.
    """
    inverse = J.adjugate() / determinant(J)
    spin, field = inverse * (cross(J * Omega, Omega) - 2 * cross(MASS * K, Omega)), cross(K, Omega)
    letters = {"J": J, "Omega": Omega, "K": K, "W": Omega + K, "M": J * (Omega + K)}
    letters |= {"inv": lambda tensor: tensor.adjugate() / determinant(tensor)}
    letters["H"] = dot(Omega + K, J * (Omega + K)) / 2 + dot(K, J * K) / 2
    return Model(letters, flow=dict(zip([*Omega, *K], [*spin, *field], strict=True)), laws="Omega by (16), K by (35)")


def frame_model() -> Model:
    """Return the model of a rotation R with any Omega in the field B' = b (0, sin, cos), for theorem-larmor-frame.

    `about_B` is a function from an angle to the rotation matrix about B'; b t is a phase, K = R^T B'.
    """
    R, bindings = rotation_symbols()
    b, slope = sympy.Symbol("b", positive=True), sympy.Symbol("p", real=True)
    c, s, q, t = sympy.symbols("c1 s1 q t", real=True)
    cosine, sine = turn(slope)
    axis = sympy.Matrix([0, sine, cosine])
    flow = {c: -b * s, s: b * c} | dict(zip(R, R * hat(Omega), strict=True))
    letters = {"R": R, "Omega": Omega, "Bp": b * axis, "K": R.T * (b * axis), "b": b, "t": t}
    start = {c: 1, s: 0} | dict(zip(R, sympy.eye(3), strict=True))
    model = Model(
        letters, [*bindings, (c, turn(q)[0]), (s, turn(q)[1])], flow, start, {b * t: (c, s)}, laws="R by (12)"
    )
    model.letters["about_B"] = model.rotation_about(axis)
    return model


def reversed_model() -> Model:
    """Return the model of theorem-pair: R, Omega and K at time -t, with rates minus those of (12), (16) and (35)."""
    basis, frame = tensor_model(), frame_model()
    back = {symbol: -basis.flow[symbol] for symbol in (*Omega, *K)}
    R = frame.letters["R"]
    bindings = [*frame.bindings, *zip(K, frame.letters["K"], strict=True)]
    flow = {**frame.flow, **back, **dict(zip(R, -R * hat(Omega), strict=True))}
    letters = {**frame.letters, **basis.letters, "g": MASS}
    return Model(letters, bindings, flow, frame.start, frame.phases, laws="minus those of (12), (16) and (35)")


def poisson_model() -> Model:
    """Return the model of any M and K (3, 1) with rates by (16) and (35), on principal axes, for the bracket of e(3).

    Letters: H the energy and F = (M, M) - det(J) (K, J^-1 K) Clebsch's integral, Omega = J^-1 M - K, `br` the
    bracket as a function of two expressions, `rank` as `_rank`.
    """
    H = dot(M, AXES.inv() * M) / 2 + dot(K, AXES * K) / 2
    spin = AXES.inv() * M - K
    mass = AXES.trace() / 2 * sympy.eye(3) - AXES
    torque = cross(AXES * spin, spin) - 2 * cross(mass * K, spin)

    def bracket(f: Value, g: Value) -> Value:
        """Return {f, g} = -(M, [f_M, g_M]) - (K, [f_M, g_K] + [f_K, g_M]) of two expressions; f_M is a gradient."""
        (fM, fK), (gM, gK) = ((partial(component, M), partial(component, K)) for component in (f, g))
        return -dot(M, cross(fM, gM)) - dot(K, cross(fM, gK) + cross(fK, gM))

    letters = {"M": M, "K": K, "J": AXES, "H": H, "Omega": spin, "br": bracket}
    letters["F"] = dot(M, M) - determinant(AXES) * dot(K, AXES.inv() * K)
    letters["rank"] = _rank
    field = cross(K, spin)
    flow = dict(zip([*M, *K], [*(torque + AXES * field), *field], strict=True))
    return Model(letters, flow=flow, laws="M by (16) and (35), K by (35)")


def _rank(*functions: Value) -> int:
    """Return the rank of the functions' gradients in (M, K) at M = (1, 2, 3), K = (4, 5, 6), with moments 2, 3, 4."""
    point = {s: n for n, s in enumerate([*M, *K], 1)} | dict(zip(MOMENTS, (2, 3, 4), strict=True))
    return int(sympy.Matrix(functions).jacobian([*M, *K]).subs(point).rank())


def symmetric_model() -> Model:
    """Return the model of any state of the symmetric body (see `state_model`), for theorem-clebsch-symmetric.

    Letters beside those of `state_model`: M = J (Omega + K), M3 its third component, H and F as in `poisson_model`.
    """
    basis = state_model()
    tensor = sympy.diag(basis.letters["I2"], basis.letters["I2"], basis.letters["I3"])
    W = basis.letters["Omega"] + basis.letters["K"]
    letters = {**basis.letters, "J": tensor, "M": tensor * W, "M3": (tensor * W)[2]}
    letters["H"] = dot(W, tensor * W) / 2 + dot(basis.letters["K"], tensor * basis.letters["K"]) / 2
    letters["F"] = dot(tensor * W, tensor * W) - determinant(tensor) * dot(
        basis.letters["K"], tensor.inv() * basis.letters["K"]
    )
    return Model(letters, flow=basis.flow, laws=basis.laws)


TRIALS = {
    "theorem-larmor-frame": Trial(
        model=frame_model, defines=("S",), false=Falsehood("(Omega + K)[a]", "(Omega - K)[a]")
    ),
    "theorem-larmor": Trial(model=tensor_model, false=Falsehood(" + cross(K, J*K)", "")),
    "theorem-momentum-canonical": Trial(
        also=("d(M) = cross(M,Omega) + cross(J*Omega,K)",),
        model=tensor_model,
        defines=("L",),
        false=Falsehood("M = partial", "J*Omega = partial"),
    ),
    "theorem-lie-poisson": Trial(
        model=poisson_model,
        defines=("H",),
        also=("d(H) = 0; d(dot(K,K)) = 0; d(dot(M,K)) = 0",),
        false=Falsehood("d(dot(M,K)) = 0", "d(dot(M,M)) = 0"),
    ),
    "theorem-bracket": Trial(
        also=(
            (
                "eps[i,j,k]*br(br(M[i],M[j]),M[k]) = 0;"
                " eps[l,i,j]*br(br(M[i],M[j]),K[k]) + 2*eps[l,i,j]*br(br(M[j],K[k]),M[i]) = 0;"
                " br(M[i],dot(K,K)) = 0; br(M[i],dot(M,K)) = 0; br(K[i],dot(M,K)) = 0"
            ),
        ),
        model=poisson_model,
        false=Falsehood("br(K[i],dot(M,K)) = 0", "br(K[i],dot(M,M)) = 0"),
    ),
    "theorem-kinetic-energy": Trial(
        also=("d(1/2*dot(Omega,J*Omega)) = 0",), model=tensor_model, false=Falsehood(" - dot(M, K)", "")
    ),
    "theorem-clebsch": Trial(
        also=("cross(J*Omega,J*K) = det(J)*inv(J)*cross(Omega,K)",),
        model=tensor_model,
        defines=("F",),
        false=Falsehood(" - det(J)*dot(K, J^(-1)*K)", ""),
    ),
    "theorem-involution": Trial(model=poisson_model, false=Falsehood("dot(K, K)) = 4", "dot(K, K)) = 3")),
    "theorem-clebsch-symmetric": Trial(
        also=("M3 = I3*c3; E = 2/I2*(H - dot(M,K))",),
        signs={"M_3": "M3"},
        model=symmetric_model,
        false=Falsehood(" + (1 - I2/I3)*M3^2", ""),
    ),
    "theorem-pair": Trial(
        signs={r"\boldsymbol{\Omega}(-t)": "Omega", r"\mathbf{K}(-t)": "K", "R(-t)": "R"},
        defines=("tildeOmega", "tildeR"),
        solves="J*d(tildeOmega) = cross(J*tildeOmega,tildeOmega) - 2*cross(g*K,tildeOmega); T(tildeR)*Bp = K;"
        " d(tildeR[i,j]) = -eps[j,a,b]*tildeOmega[a]*tildeR[i,b]; at0(tildeR) = one",
        model=reversed_model,
        false=Falsehood("about_B(-2*b*t)", "about_B(2*b*t)"),
    ),
}
