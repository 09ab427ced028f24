"""Section II, second half, on trial: Euler-Poisson equations for any rotation and any inertia tensor, (10) to (18)."""

from functools import cache

import sympy

from atlas.proof import units
from atlas.proof.model import Model, Value, cross, dot, hat, matrix, rotation, rotation_symbols, symmetric, vector
from atlas.proof.trial import Falsehood, Part, Trial

(R, ROTATION), Omega, Bf = rotation_symbols(), vector("Omega"), vector("B")
mu, c = sympy.symbols("mu c", positive=True)
g = symmetric("g")
moments = g.trace() * sympy.eye(3) - g
COMMON = {"R": R, "Omega": Omega, "Bf": Bf, "mu": mu, "c": c}


def _antisymmetric(S: Value) -> Value:
    return sympy.Matrix([S[1, 2] - S[2, 1], S[2, 0] - S[0, 2], S[0, 1] - S[1, 0]])


@cache
def multiplier_model() -> Model:
    """(10) with any matrix A, and Lam, the multipliers that it needs: (10) holds if and only if Lam is symmetric.

    R^T d2R = hat(Omega)^2 + hat(w), w the rate of Omega. IdOmega is what the symmetry of Lam makes of I w.
    """
    A, w = matrix("A"), vector("w")
    Lam = -(hat(Omega) ** 2 + hat(w) + R.T * A) * g
    skew = _antisymmetric(Lam)
    slope = skew.jacobian(w)
    rest = skew.xreplace(dict.fromkeys(w, 0))
    solved = -(moments * slope.inv()).applyfunc(sympy.cancel) * rest
    ddRg = R * (hat(Omega) ** 2 + hat(w)) * g
    return Model(
        {**COMMON, "A": A, "g": g, "I": moments, "Lam": Lam, "w": w, "IdOmega": solved, "ddRg": ddRg},
        ROTATION,
        units=units.BODY,
    )


@cache
def mirrored_model() -> Model:
    """Model the same for minus a rotation: every orthogonal matrix of the determinant -1."""
    whole = multiplier_model()
    minus = {entry: -entry for entry in R}
    letters = {
        name: value.xreplace(minus) for name, value in whole.letters.items() if isinstance(value, sympy.MatrixBase)
    }
    return Model({**whole.letters, **letters}, ROTATION, units=units.BODY)


@cache
def magnetic_model() -> Model:
    """Model the magnetic force of (7) as the matrix A, and I times the rate of Omega from (11)."""
    dR = R * hat(Omega)
    A = sympy.Matrix(3, 3, lambda i, a: (mu / c * Bf.cross(dR.col(a)))[i])
    model = multiplier_model()
    free = model.letters["A"]
    rate = model.letters["IdOmega"].xreplace(dict(zip(free, A, strict=True)))
    return Model({**COMMON, "A": A, "dR": dR, "g": g, "I": moments, "IdOmega": rate}, ROTATION, units=units.BODY)


def euler(tensor: Value, mass: Value, field: Value) -> Value:
    """I times the rate of Omega, (16) as proved, with the field seen from the body."""
    return cross(tensor * Omega, Omega) - mu / c * cross(mass * field, Omega)


@cache
def momentum_model() -> Model:
    """Angular momentum in both frames, with the rates that (16) and (12) give them.

    M is any vector and J any symmetric matrix, the inverse of I: Omega = J M. More isn't needed of them.
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
    return Model({**COMMON, **letters, "dm": R * (cross(spin, M) + rate), "dM": rate}, ROTATION, units=units.BODY)


@cache
def poisson_model() -> Model:
    """Any moving rotation: R changes with its three parameters; Omega is read off R^T dR/dt."""
    R = rotation()
    parameters = sympy.symbols("q1:4", real=True)
    flow = dict(zip(parameters, sympy.symbols("p1:4", real=True), strict=True))
    dR = R.applyfunc(lambda entry: sum((entry.diff(q) * p for q, p in flow.items()), sympy.Integer(0)))
    W = (R.T * dR).applyfunc(sympy.cancel)
    return Model({"R": R, "Omega": sympy.Matrix([W[2, 1], W[0, 2], W[1, 0]])}, flow=flow)


@cache
def matrix_flow_model() -> Model:
    """Any matrix that obeys (12)."""
    free = matrix("R")
    return Model({"R": free, "Omega": Omega}, flow=dict(zip(free, free * hat(Omega), strict=True)))


@cache
def diagonal_model() -> Model:
    """Principal axes: I and g are diagonal, made of three masses on the axes."""
    g1, g2, g3 = sympy.symbols("g1:4", positive=True)
    diagonal = sympy.diag(g1, g2, g3)
    tensor = diagonal.trace() * sympy.eye(3) - diagonal
    K = vector("K")
    letters = {"g": diagonal, "I": tensor, "K": K, "Omega": Omega, "g1": g1, "g2": g2, "g3": g3}
    letters |= {f"I{n + 1}": tensor[n, n] for n in range(3)}
    letters |= {f"K{n + 1}": K[n] for n in range(3)} | {f"Omega{n + 1}": Omega[n] for n in range(3)}
    return Model(letters)


@cache
def axes_model() -> Model:
    """Three masses on the principal axes, turned by R: their inertia tensor in the laboratory."""
    masses, places = sympy.symbols("m1:4", positive=True), sympy.symbols("x1:4", positive=True)
    turned = [R.col(n) * x for n, x in enumerate(places)]
    tensor = sum((m * (dot(x, x) * sympy.eye(3) - x * x.T) for m, x in zip(masses, turned, strict=True)), R * 0)
    moments = [m * x**2 for m, x in zip(masses, places, strict=True)]
    letters = {"R": R, "turned": tensor, "I": sympy.diag(*(sum(moments) - moment for moment in moments))}
    letters |= {f"R{n + 1}": R.col(n) for n in range(3)} | {f"e{n + 1}": sympy.eye(3).col(n) for n in range(3)}
    letters |= {f"I{n + 1}": letters["I"][n, n] for n in range(3)}
    return Model(letters, ROTATION, start=dict(zip(R, sympy.eye(3), strict=True)))


@cache
def inertia_model() -> Model:
    """Model the inertia tensor from the kinetic energy of four particles that turn with Omega."""
    masses = sympy.symbols("m1:5", positive=True)
    places = [vector(f"x{n}_") for n in range(1, 5)]
    energy = sum(m * Omega.cross(x).dot(Omega.cross(x)) for m, x in zip(masses, places, strict=True)) / 2
    mass = sum((m * x * x.T for m, x in zip(masses, places, strict=True)), sympy.zeros(3, 3))
    return Model({"I": sympy.hessian(sympy.expand(energy), list(Omega)), "g": mass})


@cache
def grioli_model() -> Model:
    """B along e3; G3 is the third row of R."""
    b = sympy.Symbol("b", positive=True)
    field = R.T * sympy.Matrix([0, 0, b])
    return Model(
        {**COMMON, "I": moments, "g": g, "b": b, "G3": R.row(2).T, "IdOmega": euler(moments, g, field)},
        ROTATION,
        units=units.BODY,
    )


_EQUATION_11 = (
    "cross(I*Omega,Omega)[k] + 1/2*eps[k,i,j]*((A*I)[a,i]*R[a,j] + (R*I)[a,i]*A[a,j])"
    " - 1/2*I[k,a]*eps[a,i,j]*A[b,i]*R[b,j]"
)
_FORCE_MATRIX = (
    "eps[i,j,k]*Bf[j]*dR[k,a] = {sign}eps[i,j,k]*eps[a,b,l]*Bf[j]*Omega[b]*R[k,l]"
    " = {sign}eps[i,j,k]*eps[al,be,ga]*R[al,a]*R[be,b]*R[ga,l]*Bf[j]*Omega[b]*R[k,l]"
    " = {sign}eps[i,j,k]*eps[al,be,ga]*R[al,a]*Bf[j]*(R*Omega)[be]*(R*T(R))[ga,k]"
    " = {sign}eps[i,j,k]*eps[al,be,k]*R[al,a]*Bf[j]*(R*Omega)[be]"
)


@cache
def algebraic_model() -> Model:
    """Principal axes, any matrix A; IdOmega is what (11) makes of the rate of Omega."""
    whole = multiplier_model()
    swap = {g[i, j]: 0 for i in range(3) for j in range(3) if i != j}
    letters = {**whole.letters, "g": g.xreplace(swap), "I": moments.xreplace(swap)}
    return Model({**letters, "IdOmega": whole.letters["IdOmega"].xreplace(swap)}, ROTATION)


@cache
def moments_model() -> tuple[Model, Model]:
    """Any body with its three moments of mass, and a plane one."""
    g1, g2, g3 = sympy.symbols("g1:4", positive=True)
    cases = []
    for third in (g3, sympy.Integer(0)):
        letters = {"g1": g1, "g2": g2, "g3": third, "I1": g2 + third, "I2": g1 + third, "I3": g1 + g2}
        cases.append(Model(letters))
    return cases[0], cases[1]


@cache
def covariance_model(sign: int = 1) -> Model:
    """Model another rotation S of the laboratory, or minus one: what vectors and tensors of Section II are there."""
    symbols, where = rotation_symbols("S")
    other = sign * symbols
    inertia, mass, K = symmetric("I"), symmetric("g"), vector("K")
    letters = {"S": other, "I": inertia, "g": mass, "K": K, "Omega": Omega, "mu": mu, "c": c}
    letters["seen"] = lambda tensor: other * tensor * other.T
    letters["rate"] = lambda tensor, mass, field, spin: cross(tensor * spin, spin) - mu / c * cross(mass * field, spin)
    return Model(letters, where)


@cache
def flight_model() -> Model:
    """Four particles about their centre of mass; w is the rate of Omega, IdOmega that of (16) times I."""
    masses = dict(enumerate(sympy.symbols("m1:5", positive=True), 1))
    places = {N: vector(f"x{N}_") for N in (1, 2, 3)}
    places[4] = -sum((masses[N] * places[N] for N in places), sympy.zeros(3, 1)) / masses[4]
    mass = sum((masses[N] * places[N] * places[N].T for N in masses), sympy.zeros(3, 3))
    inertia = mass.trace() * sympy.eye(3) - mass
    E, velocity = vector("E"), vector("v")
    letters = {**COMMON, "m": masses, "x": places, "E": E, "dy0": velocity, "w": vector("w"), "I": inertia}
    letters |= {"ddy0": mu * E + mu / c * cross(velocity, Bf), "IdOmega": euler(inertia, mass, R.T * Bf)}
    return Model(letters, ROTATION, ranges={"N": (1, 2, 3, 4)})


TRIALS = (
    Trial(
        name="(10)",
        tried="ddRg[i,j] = -R[i,k]*Lam[k,j] - A[i,k]*g[k,j]",
        model=multiplier_model,
        follows="@(6) about the centre of mass, solved for the multipliers",
        definition=True,
        note="It leaves out the $R(0) = 1$ of @(6), see @text-affirmation.",
    ),
    Trial(
        name="text-affirmation",
        tried=f"eps[k,i,j]*Lam[i,j] = I[k,a]*w[a] - ({_EQUATION_11})",
        model=multiplier_model,
        follows=r"@(10) with $R^T \ddot R = \hat{\boldsymbol{\Omega}}^2 + d\hat{\boldsymbol{\Omega}}/dt$",
        note="The multipliers are symmetric if and only if @(11) holds: one identity proves both directions, for "
        "every rotation, every symmetric mass matrix and every matrix $A$. That $g$ be non-degenerate is not "
        "needed, only $I$. But @(10) says nothing of $R(0)$, where @(12) has 1: it admits any other orthogonal "
        "matrix at the "
        "start, one of the determinant $-1$ among them, for which the identity holds too.",
        grade="missing case",
        corrected_tried=f"eps[k,i,j]*Lam[i,j] = I[k,a]*w[a] - ({_EQUATION_11})",
        corrected_also=(Part(line=f"eps[k,i,j]*Lam[i,j] = I[k,a]*w[a] - ({_EQUATION_11})", model=mirrored_model),),
        corrected_tex=r"\text{(10)},\ \boxed{R_{ij}(0)=\delta_{ij}}\iff\text{(11), (12)}",
        false=Falsehood(
            "The Euler equations hold without their last term",
            " - 1/2*I[k,a]*eps[a,i,j]*A[b,i]*R[b,j]",
            "",
        ),
    ),
    Trial(
        name="text-multipliers-algebraic",
        tried="lam = -(hat(Omega)*hat(Omega) + hat(inv(I)*IdOmega) + T(R)*A)*g = T(lam)",
        model=algebraic_model,
        follows=r"@(10) with the rate of $\boldsymbol{\Omega}$ of @(11), for any matrix $A$",
        defines=("lam",),
        solves="R*(hat(Omega)*hat(Omega) + hat(inv(I)*IdOmega))*g = -R*lam - A*g",
        false=Falsehood(
            "The multipliers do not hold the centrifugal force: they are made of the angular acceleration and $A$",
            "hat(Omega)*hat(Omega) + ",
            "",
        ),
    ),
    Trial(
        name="text-nondegenerate",
        tried="g1*g2*g3 != 0",
        model=lambda: moments_model()[0],
        follows="the moments of mass of a body that is not plane",
        corrected_tried="I1*I2*I3 > 0",
        corrected_model=moments_model,
        corrected_tex=r"\boxed{\det I=I_1I_2I_3}\ne0",
        grade="missing case",
        slip="text-rigid",
        false=Falsehood("The mass matrix of a plane body is not degenerate", "I1*I2*I3 > 0", "g1*g2*g3 != 0"),
        note="For a plane body, the loop of Section IV, $g_3 = 0$. The Affirmation needs only that the inertia "
        "tensor be non-degenerate, which it is for every body that is no rod.",
    ),
    Trial(
        name="(11)",
        tried=f"IdOmega[k] = {_EQUATION_11}",
        model=multiplier_model,
        follows="the symmetry of the multipliers in @(10)",
    ),
    Trial(
        name="(12)",
        tried="d(R[i,j]) = -eps[j,a,b]*Omega[a]*R[i,b]",
        model=poisson_model,
        follows="any moving rotation, by its Cayley parameters",
    ),
    Trial(
        name="text-inertia-tensor",
        tried="I[i,j] = g[a,a]*delta[i,j] - g[i,j]",
        model=inertia_model,
        follows=r"the kinetic energy of four particles that turn with $\boldsymbol{\Omega}$",
        false=Falsehood(
            "The inertia tensor is the mass matrix",
            "g[a,a]*delta[i,j] - g[i,j]",
            "g[i,j]",
        ),
    ),
    Trial(
        name="text-mass-moments",
        tried="2*g1 = I2 + I3 - I1; 2*g2 = I3 + I1 - I2; 2*g3 = I1 + I2 - I3",
        model=diagonal_model,
        follows=r"$I = \operatorname{tr}(g) - g$",
        false=Falsehood(
            "A moment of mass is half the sum of all moments of inertia",
            "I2 + I3 - I1",
            "I2 + I3 + I1",
        ),
    ),
    Trial(
        name="text-inertia-axes",
        tried="turned = R*I*T(R); turned*R1 = I1*R1; turned*R2 = I2*R2; turned*R3 = I3*R3;"
        " at0(R1) = e1; at0(R2) = e2; at0(R3) = e3",
        model=axes_model,
        follows="the inertia tensor of three masses on the principal axes that are turned by $R$, and $R(0) = 1$",
        false=Falsehood(
            "The rows of $R$ are the axes of inertia",
            "turned = R*I*T(R)",
            "turned = T(R)*I*R",
        ),
    ),
    Trial(
        name="text-orthogonal",
        tried="d(R[i,1]*R[j,1] + R[i,2]*R[j,2] + R[i,3]*R[j,3]) = 0",
        model=matrix_flow_model,
        follows="@(12) for any matrix $R$",
        false=Falsehood(
            "$R^T R$ stays what it is as well, for any matrix $R(0)$",
            "R[i,1]*R[j,1] + R[i,2]*R[j,2] + R[i,3]*R[j,3]",
            "R[1,i]*R[1,j] + R[2,i]*R[2,j] + R[3,i]*R[3,j]",
        ),
    ),
    Trial(
        name="text-covariance",
        tried="rate(seen(I),seen(g),S*K,S*Omega) = S*rate(I,g,K,Omega); hat(S*Omega) = seen(hat(Omega))",
        model=covariance_model,
        follows="the right side of @(16) and that of @(12), for any rotation $S$",
        note="The rates go over into one another, and $R = 1$ at the start stays what it is.",
        false=Falsehood(
            "The system is covariant under reflections as well",
            model=lambda: covariance_model(-1),
        ),
    ),
    Trial(
        name="text-force-matrix",
        tried=_FORCE_MATRIX.format(sign="").replace("= ", "= ", 1)
        + " = R[i,a]*dot(Bf,R*Omega) - (R*Omega)[i]*(T(R)*Bf)[a]",
        model=magnetic_model,
        follows="@(12) and $R R^T = 1$",
        corrected_tried=_FORCE_MATRIX.format(sign="-") + " = (R*Omega)[i]*(T(R)*Bf)[a] - R[i,a]*dot(Bf,R*Omega)",
        corrected_tex=(
            r"\begin{aligned} \epsilon_{ijk}B_j\dot R_{ka}&=\boxed{-}\epsilon_{ijk}\epsilon_{abc}B_j\Omega_bR_{kc}="
            r"\ldots\\ "
            r"&=\boxed{-}\epsilon_{ijk}\epsilon_{\alpha\beta k}R_{\alpha a}B_j(R\boldsymbol{\Omega})_\beta"
            r"=\boxed{(R\boldsymbol{\Omega})_i(\mathbf{B}R)_a-R_{ia}(\mathbf{B}R\boldsymbol{\Omega})} \end{aligned}"
        ),
        grade="misprint",
        note="The minus of @(12) is lost at the first step and back in @(13).",
    ),
    Trial(
        name="(13)",
        tried="A[i,a] = -mu/c*eps[i,j,k]*eps[a,b,l]*Bf[j]*Omega[b]*R[k,l]"
        " = mu/c*((R*Omega)[i]*(T(R)*Bf)[a] - R[i,a]*dot(Bf,R*Omega))",
        model=magnetic_model,
        follows="@(7) and @(12)",
    ),
    Trial(
        name="(14)",
        tried="IdOmega = cross(I*Omega,Omega) - mu/(2*c)*(I*cross(T(R)*Bf,Omega) - cross(I*T(R)*Bf,Omega)"
        " + cross(T(R)*Bf,I*Omega))",
        model=magnetic_model,
        follows="@(11) with the matrix $A$ of @(7)",
    ),
    Trial(
        name="(15)",
        tried="(I*cross(K,Omega))[1] - cross(I*K,Omega)[1] + cross(K,I*Omega)[1]"
        " = (I1 - I2 + I3)*K2*Omega3 - (I1 - I3 + I2)*K3*Omega2 = 2*g2*K2*Omega3 - 2*g3*K3*Omega2 ="
        " 2*cross(g*K,Omega)[1]",
        model=diagonal_model,
        follows=r"$I = \operatorname{tr}(g) - g$, $\mathbf{K} = R^T \mathbf{B}$",
    ),
    Trial(
        name="text-other-components",
        tried="I*cross(K,Omega) - cross(I*K,Omega) + cross(K,I*Omega) = 2*cross(g*K,Omega)",
        model=diagonal_model,
        follows=r"$I = \operatorname{tr}(g) - g$, $\mathbf{K} = R^T \mathbf{B}$, all three components",
        false=Falsehood(
            "The mass matrix may act on the angular velocity instead",
            "2*cross(g*K,Omega)",
            "2*cross(K,g*Omega)",
        ),
    ),
    Trial(
        name="(16)",
        tried="IdOmega = cross(I*Omega,Omega) - mu/c*cross(g*T(R)*Bf,Omega)",
        model=magnetic_model,
        follows="@(11) with the matrix $A$ of @(7)",
    ),
    Trial(
        name="(17)",
        tried="dm = -mu/c*cross(R*g*T(R)*Bf,R*inv(I)*T(R)*m)",
        model=momentum_model,
        follows=r"$\mathbf{m} = R I \boldsymbol{\Omega}$, @(12) and @(16)",
    ),
    Trial(
        name="(18)",
        tried="dM = cross(M,inv(I)*M) - mu/c*cross(g*T(R)*Bf,inv(I)*M)",
        model=momentum_model,
        follows=r"$\mathbf{M} = I \boldsymbol{\Omega}$ and @(16)",
    ),
    Trial(
        name="text-grioli",
        tried="IdOmega = cross(I*Omega,Omega) - mu*b/c*cross(g*G3,Omega)",
        model=grioli_model,
        follows=r"@(16) with $\mathbf{B} = (0, 0, b)$",
        note="What is tried is the form. That Grioli deduced these equations is history, and not tried.",
        false=Falsehood(
            "The torque holds the third column of $R$",
            "cross(g*G3,Omega)",
            "cross(g*[R[1,3], R[2,3], R[3,3]],Omega)",
        ),
    ),
    Trial(
        name="text-flight",
        tried="R*(I*w - IdOmega) = m[N]*cross(R*x[N], R*(hat(Omega)*hat(Omega) + hat(w))*x[N]"
        " - mu/c*cross(R*hat(Omega)*x[N],Bf))",
        model=flight_model,
        follows=r"d'Alembert's principle for $\mathbf{y}_N = \mathbf{y}_0 + R \mathbf{x}_N(0)$, four particles: the "
        "force and the torque that are not those of the constraints",
        also=(
            Part(
                line="0 = m[N]*(ddy0 + R*(hat(Omega)*hat(Omega) + hat(w))*x[N] - mu*E"
                " - mu/c*cross(dy0 + R*hat(Omega)*x[N],Bf))",
                model=flight_model,
            ),
        ),
        note=r"Both vanish if @(4) holds and the rate $w$ of $\boldsymbol{\Omega}$ is that of @(16), and only then. "
        "A force that is for all particles in proportion to their masses has no torque about the centre of "
        "mass, and is left out of it.",
        false=Falsehood(
            "The magnetic force has no torque about the centre of mass",
            " - mu/c*cross(R*hat(Omega)*x[N],Bf)",
            "",
        ),
    ),
)
