"""The structure behind the motion on trial: Larmor's frame, the bracket of e(3), and the integral of Clebsch."""

from collections.abc import Callable
from functools import cache

import sympy

from atlas.proof.model import Model, Value, cross, dot, hat, rotation_symbols, symmetric, turn, vector
from atlas.proof.pseudo_oscillator import state_model
from atlas.proof.trial import Falsehood, Trial

Omega, K, M = vector("Omega"), vector("K"), vector("M")
J = symmetric("J")
MASS = J.trace() / 2 * sympy.eye(3) - J
I1, I2, I3 = MOMENTS = sympy.symbols("I1:4", positive=True)
AXES = sympy.diag(*MOMENTS)


def determinant(tensor: Value) -> Value:
    """Return the determinant of a tensor without a division."""
    return tensor.det(method="berkowitz")


def gradient(vectors: Value) -> Callable[[Value], Value]:
    """Return the gradient of a function with respect to a vector of symbols."""
    return lambda f: sympy.Matrix([sympy.diff(f, x) for x in vectors])


@cache
def tensor_model() -> Model:
    """Model any state Omega, K of a body of any inertia tensor J, with the rates (16) and (35)."""
    inverse = J.adjugate() / determinant(J)
    spin, field = inverse * (cross(J * Omega, Omega) - 2 * cross(MASS * K, Omega)), cross(K, Omega)
    letters = {"J": J, "Omega": Omega, "K": K, "W": Omega + K, "M": J * (Omega + K), "det": determinant}
    letters |= {"adj": lambda tensor: tensor.adjugate(), "energy": dot(Omega, J * Omega) / 2}
    letters["gradOmega"] = gradient(Omega)
    return Model(letters, flow=dict(zip([*Omega, *K], [*spin, *field], strict=True)))


@cache
def reversed_model() -> Model:
    """Model the state (-2K - Omega, K): J times its rate by (16), beside minus the rate of -2K - Omega itself."""
    other = -2 * K - Omega
    letters = {**tensor_model().letters, "other": other}
    letters["Jrate"] = cross(J * other, other) - 2 * cross(MASS * K, other)
    letters["Krate"] = cross(K, other)
    return Model(letters, flow=tensor_model().flow)


@cache
def frame_model() -> Model:
    """Model R with any spin, and the turn P = R_B(bt) about B' = b (0, sin, cos) of any inclination."""
    R, where = rotation_symbols()
    b, slope = sympy.Symbol("b", positive=True), sympy.Symbol("p", real=True)
    c, s, q = sympy.symbols("c1 s1 q", real=True)
    cosine, sine = turn(slope)
    axis = sympy.Matrix([0, sine, cosine])

    def about(c: Value, s: Value) -> Value:
        """Return the turn about the axis by the angle with this cosine and sine."""
        return c * sympy.eye(3) + s * hat(axis) + (1 - c) * axis * axis.T

    flow = {c: -b * s, s: b * c} | dict(zip(R, R * hat(Omega), strict=True))
    letters = {"R": R, "P": about(c, s), "P2": about(c**2 - s**2, 2 * c * s), "Omega": Omega}
    letters |= {"Bp": b * axis, "K": R.T * (b * axis), "b": b}
    return Model(letters, [*where, (c, turn(q)[0]), (s, turn(q)[1])], flow)


@cache
def poisson_model() -> Model:
    """Model any M and K as coordinates of e(3), principal moments, the bracket, and the rates of (16), (35)."""
    gM, gK = gradient(M), gradient(K)
    H = dot(M, AXES.inv() * M) / 2 + dot(K, AXES * K) / 2
    spin = AXES.inv() * M - K
    mass = AXES.trace() / 2 * sympy.eye(3) - AXES
    torque = cross(AXES * spin, spin) - 2 * cross(mass * K, spin)

    def bracket(f: Value, g: Value) -> Value:
        """Return {f, g} = -(M, [f_M, g_M]) - (K, [f_M, g_K] + [f_K, g_M])."""
        mixed = cross(gM(f), gK(g)) + cross(gK(f), gM(g))
        return -dot(M, cross(gM(f), gM(g))) - dot(K, mixed)

    letters = {"M": M, "K": K, "J": AXES, "H": H, "br": bracket, "gradM": gM, "gradK": gK}
    letters |= {"F": dot(M, M) - determinant(AXES) * dot(K, AXES.inv() * K), "det": determinant}
    letters["rank"] = _rank
    field = cross(K, spin)
    flow = dict(zip([*M, *K], [*(torque + AXES * field), *field], strict=True))
    return Model(letters, flow=flow)


def _rank(*functions: Value) -> int:
    """Return the rank of the gradients at M = (1, 2, 3), K = (4, 5, 6), with the moments 2, 3, 4."""
    point = {s: n for n, s in enumerate([*M, *K], 1)} | dict(zip(MOMENTS, (2, 3, 4), strict=True))
    return int(sympy.Matrix(functions).jacobian([*M, *K]).subs(point).rank())


@cache
def symmetric_model() -> Model:
    """Model the symmetric body, with c3 and c5 as they are at any state."""
    whole = state_model()
    tensor = sympy.diag(whole.letters["I2"], whole.letters["I2"], whole.letters["I3"])
    W = whole.letters["Omega"] + whole.letters["K"]
    letters = {**whole.letters, "J": tensor, "M": tensor * W, "M3": (tensor * W)[2], "det": determinant}
    letters["H"] = dot(W, tensor * W) / 2 + dot(whole.letters["K"], tensor * whole.letters["K"]) / 2
    letters["F"] = dot(tensor * W, tensor * W) - determinant(tensor) * dot(
        whole.letters["K"], tensor.inv() * whole.letters["K"]
    )
    return Model(letters, flow=whole.flow)


_L = "1/2*dot(Omega,J*Omega) + dot(K,J*Omega)"

TRIALS = (
    Trial(
        name="theorem-larmor-frame",
        tried="S = P*R; d(S[i,j]) = -eps[j,a,b]*(Omega[a] + K[a])*S[i,b]; T(S)*Bp = K;"
        " S2 = P2*R; d(S2[i,j]) = -eps[j,a,b]*(Omega[a] + 2*K[a])*S2[i,b]; T(S2)*Bp = K",
        model=frame_model,
        follows="@(12), with $P = R_B(bt)$ and $P_2 = R_B(2bt)$",
        defines=("S", "S2"),
        note="The last equation, in the reversed time, is what @theorem-pair needs.",
        false=Falsehood(
            r"The frame turns with $+\mathbf{B}'$",
            "(Omega[a] + K[a])*S",
            "(Omega[a] - K[a])*S",
        ),
    ),
    Trial(
        name="theorem-larmor",
        tried="J*d(W) = cross(J*W,W) + cross(K,J*K); d(K) = cross(K,W); W = Omega + K",
        model=tensor_model,
        follows="@(16) and @(35)",
        note=r"Larmor's theorem, exact in the field and for every inertia tensor. The torque $[\mathbf{K}, J "
        r"\mathbf{K}]$ is that of the potential $(\mathbf{K}, J \mathbf{K})/2$, quadratic in the field.",
        false=Falsehood(
            "In Larmor's frame every body is free",
            " + cross(K,J*K)",
            "",
        ),
    ),
    Trial(
        name="theorem-momentum-canonical",
        tried=f"L = {_L}; M = gradOmega(L); dot(M,Omega) - L = 1/2*dot(Omega,J*Omega);"
        " d(M) = cross(M,Omega) + cross(J*Omega,K)",
        model=tensor_model,
        follows="@(16), with the Lagrangian @(104) summed over the body",
        defines=("L",),
        note=r"The last equation is that of Euler and Poincaré for $L$, in which $\mathbf{K}$ moves with the body.",
        false=Falsehood(
            r"The kinetic momentum $J\boldsymbol{\Omega}$ is the canonical one",
            "M = gradOmega(L)",
            "J*Omega = gradOmega(L)",
        ),
    ),
    Trial(
        name="theorem-lie-poisson",
        tried="H = 1/2*dot(M,inv(J)*M) + 1/2*dot(K,J*K); d(M) = cross(M,gradM(H)) + cross(K,gradK(H));"
        " d(K) = cross(K,gradM(H)); d(H) = 0; d(dot(K,K)) = 0; d(dot(M,K)) = 0",
        model=poisson_model,
        follows=r"@(16) and @(35) with $\boldsymbol{\Omega} = J^{-1} \mathbf{M} - \mathbf{K}$",
        defines=("H",),
        false=Falsehood(
            r"$\mathbf{M}^2$ is conserved",
            "d(dot(M,K)) = 0",
            "d(dot(M,M)) = 0",
        ),
    ),
    Trial(
        name="theorem-bracket",
        tried="br(M[i],M[j]) = -eps[i,j,k]*M[k]; br(M[i],K[j]) = -eps[i,j,k]*K[k]; br(K[i],K[j]) = 0;"
        " eps[i,j,k]*br(br(M[i],M[j]),M[k]) = 0;"
        " eps[l,i,j]*br(br(M[i],M[j]),K[k]) + 2*eps[l,i,j]*br(br(M[j],K[k]),M[i]) = 0;"
        " br(M[i],dot(K,K)) = 0; br(M[i],dot(M,K)) = 0; br(K[i],dot(M,K)) = 0",
        model=poisson_model,
        follows="the bracket with which $H$ generates the equations of @theorem-lie-poisson",
        note=r"Jacobi's identity, here contracted with $\varepsilon$, which loses nothing since the bracket is "
        "antisymmetric, for the coordinates is that for all functions, since a bracket is a derivation.",
        false=Falsehood(
            r"$\mathbf{M}^2$ commutes with everything",
            "br(K[i],dot(M,K)) = 0",
            "br(K[i],dot(M,M)) = 0",
        ),
    ),
    Trial(
        name="theorem-kinetic-energy",
        tried="energy = 1/2*dot(W,J*W) + 1/2*dot(K,J*K) - dot(M,K); d(energy) = 0",
        model=tensor_model,
        follows=r"$\mathbf{M} = J \mathbf{W}$, $\mathbf{W} = \boldsymbol{\Omega} + \mathbf{K}$, @(16) and @(35)",
        note="$F$ is not needed. The two Hamiltonians differ by a Casimir, which generates the turn of Larmor's frame.",
        false=Falsehood(
            "The kinetic energy is $H$",
            " - dot(M,K)",
            "",
        ),
    ),
    Trial(
        name="theorem-clebsch",
        tried="F = dot(M,M) - dot(K,adj(J)*K); adj(J)*J = det(J)*one; d(F) = 0;"
        " cross(J*Omega,J*K) = adj(J)*cross(Omega,K)",
        model=tensor_model,
        follows=r"@(16) and @(35); $\det J J^{-1}$ is the matrix of cofactors",
        defines=("F",),
        note=r"The last identity is why: $(J \mathbf{W}, [\mathbf{K}, J \mathbf{K}]) = (\mathbf{K}, \det J J^{-1} "
        r"[\mathbf{K}, \mathbf{W}])$.",
        false=Falsehood(
            r"$\mathbf{M}^2$ is the further integral",
            " - dot(K,adj(J)*K)",
            "",
        ),
    ),
    Trial(
        name="theorem-involution",
        tried="F = dot(M,M) - det(J)*dot(K,inv(J)*K); br(F,H) = 0; d(F) = 0; rank(H,F,dot(M,K),dot(K,K)) = 4",
        model=poisson_model,
        follows="the bracket of @theorem-bracket; the gradients at one point, moments 2, 3, 4",
        defines=("F",),
        note="Independent at one point, so at all but those of a set of measure zero.",
        false=Falsehood(
            "$F$ follows from $H$ and the Casimirs",
            "dot(K,K)) = 4",
            "dot(K,K)) = 3",
        ),
    ),
    Trial(
        name="theorem-clebsch-symmetric",
        tried="F = 2*I2*H + (1 - I2/I3)*M3^2 - I2*(I2 + I3)*dot(K,K); M3 = I3*c3;"
        " c5 = dot(M,K)/I2 - dot(K,K) + (1 - I)*c3^2; E = 2/I2*(H - dot(M,K))",
        model=symmetric_model,
        follows="@(36), @(40) and @(41) at any state",
        false=Falsehood(
            r"$F$ is made of $H$ and $\mathbf{K}^2$ alone",
            " + (1 - I2/I3)*M3^2",
            "",
        ),
    ),
    Trial(
        name="theorem-pair",
        tried="other = -2*K - Omega; Jrate = -J*d(other); Krate = -d(K)",
        model=reversed_model,
        follows=r"@(16) and @(35) at the state $(-2\mathbf{K} - \boldsymbol{\Omega}, \mathbf{K})$, against their rates "
        "along the motion, time reversed",
        note="$R$ follows: by @theorem-larmor-frame $S$ is one motion for both, and $R(t)$ of the other is $R_B(-bt) "
        "S(-t) = R_B(-2bt) R(-t)$, the $S_2$ of @theorem-larmor-frame at $-t$.",
        false=Falsehood(
            "The two motions run in the same sense",
            "Krate = -d(K)",
            "Krate = d(K)",
        ),
    ),
)
