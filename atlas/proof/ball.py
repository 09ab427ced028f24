"""Section III on trial: the charged ball, (19) to (30)."""

from functools import cache

import sympy

from atlas.proof import euler_poisson as general
from atlas.proof import units
from atlas.proof.model import Model, Value, cross, hat, rotation_symbols, turn, vector
from atlas.proof.particle import TRAJECTORY, trajectory_model
from atlas.proof.trial import Falsehood, Part, Trial

(R, ROTATION), Omega, Bf = rotation_symbols(), vector("Omega"), vector("B")
I0, mu, c = sympy.symbols("I0 mu c", positive=True)
alpha, gamma, t, k2, k3, m2, m3 = sympy.symbols("alpha gamma t k2 k3 m2 m3", real=True)
ca, sa, cg, sg, p, q, h = sympy.symbols("ca sa cg sg p q h", real=True)
size = sympy.Symbol("s", positive=True)

LARMOR = {ca: -alpha * sa, sa: alpha * ca}
TURNING = {cg: -gamma * sg, sg: gamma * cg}
START = {ca: 1, sa: 0, cg: 1, sg: 0}
ANGLES = [(ca, turn(p)[0]), (sa, turn(p)[1]), (cg, turn(q)[0]), (sg, turn(q)[1])]
UPRIGHT = {"alpha": "positive"}
AXIS = [(k2, turn(h)[1]), (k3, turn(h)[0])]


@cache
def kinematic_model() -> Model:
    """Three masses on the principal axes of a turning body."""
    masses = sympy.symbols("m1:4", positive=True)
    places = [sympy.diag(*sympy.symbols("x1:4", real=True)).col(n) for n in range(3)]
    g = sum((m * x * x.T for m, x in zip(masses, places, strict=True)), sympy.zeros(3, 3))
    dR = R * hat(Omega)
    spin = sum((m * cross(R * x, dR * x) for m, x in zip(masses, places, strict=True)), sympy.zeros(3, 1))
    letters = {"m": spin, "R": R, "I": g.trace() * sympy.eye(3) - g, "Omega": Omega, "omega": R * Omega}
    letters |= {f"g{n + 1}": g[n, n] for n in range(3)}
    letters |= {f"R{n + 1}": R.col(n) for n in range(3)} | {f"dR{n + 1}": dR.col(n) for n in range(3)}
    return Model(letters, ROTATION)


@cache
def uniform_ball_model() -> Model:
    """Moments of inertia of a uniform ball of radius r, each by its own integral."""
    r, s, u, w, mass = sympy.symbols("r s u w M", positive=True)
    x, y, z = s * sympy.sqrt(1 - u**2) * sympy.cos(w), s * sympy.sqrt(1 - u**2) * sympy.sin(w), s * u
    density = mass / (sympy.Rational(4, 3) * sympy.pi * r**3)

    def over(value: Value) -> Value:
        return sympy.integrate(density * s**2 * sympy.expand(value), (w, 0, 2 * sympy.pi), (u, -1, 1), (s, 0, r))

    letters = {"I1": over(y**2 + z**2), "I2": over(x**2 + z**2), "I3": over(x**2 + y**2), "M": mass, "r": r}
    return Model({**letters, "I0": sympy.Rational(2, 5) * mass * r**2})


@cache
def ball_model() -> Model:
    """(16) with I = I0 and so g = I0/2; m = I0 R Omega."""
    tensor = I0 * sympy.eye(3)
    rate = general.euler(tensor, tensor / 2, R.T * Bf) / I0
    dm = I0 * R * (hat(Omega) * Omega + rate)
    spin = I0 * R * Omega
    dR = R * hat(Omega)
    columns = {n + 1: R.col(n) for n in range(3)}
    rates = {n + 1: dR.col(n) for n in range(3)}
    letters = {"R": R, "dR": dR, "Rj": columns, "dRj": rates, "Bf": Bf, "mu": mu, "c": c, "I0": I0}
    letters |= {"Omega": Omega, "dOmega": rate, "m": spin, "dm": dm}
    return Model(letters, ROTATION, units=units.BALL)


@cache
def momentum_flow_model() -> Model:
    """Any vector m that obeys (22)."""
    m = vector("m")
    return Model({"m": m, "Bf": Bf}, flow=dict(zip(m, -mu / (2 * c) * cross(Bf, m), strict=True)))


@cache
def larmor_model() -> Model:
    """B = (0, 0, b), alpha t as an angle."""
    b = sympy.Symbol("b", positive=True)
    letters = {"alpha": alpha, "t": t, "m2": m2, "m3": m3, "mu": mu, "c": c, "b": b}
    where = [(alpha, mu * b / (2 * c)), *ANGLES[:2]]
    return Model(letters, where, LARMOR, START, {alpha * t: (ca, sa)}, units=units.BALL)


@cache
def larmor_frequency_model() -> Model:
    """Rate of the angle of m about B, from (22): (m x dm).B over |m_perp|^2 |B|, turned clockwise."""
    m, b = vector("m"), sympy.Symbol("b", positive=True)
    field = sympy.Matrix([0, 0, b])
    dm = -mu / (2 * c) * cross(field, m)
    rate = -cross(m, dm)[2] / (m[0] ** 2 + m[1] ** 2)
    return Model({"alpha": sympy.cancel(rate), "mu": mu, "c": c, "b": b}, units=units.BALL)


def _motion(spin: Value, where: list[tuple[Value, Value]]) -> Model:
    letters = {"alpha": alpha, "gamma": gamma, "t": t, "k2": k2, "k3": k3, "I0": I0, "m": spin, "m2": m2, "m3": m3}
    phases = {alpha * t: (ca, sa), gamma * t: (cg, sg)}
    letters["rod"] = rodrigues
    return Model(letters, where, {**LARMOR, **TURNING}, START, phases, units=units.BALL)


def rodrigues(axis: Value, cosine: Value, sine: Value) -> Value:
    """Rotation about a unit vector by the angle with that cosine and sine."""
    return cosine * sympy.eye(3) + (1 - cosine) * axis * axis.T + sine * hat(axis)


@cache
def motion_model() -> Model:
    """Model the angular momentum (26) and the constants (29), solved for m2, m3."""
    spin = sympy.Matrix([m2 * sa, m2 * ca, m3])
    return _motion(spin, [*ANGLES, (m2, -gamma * I0 * k2), (m3, -gamma * I0 * k3 - alpha * I0), *AXIS])


@cache
def start_model() -> Model:
    """Model the momentum that the ansatz (28) has at t = 0: I0 times the axial vector of dR/dt."""
    first = rodrigues(sympy.Matrix([0, 0, 1]), ca, -sa) * rodrigues(sympy.Matrix([0, k2, k3]), cg, -sg)
    model = _motion(sympy.zeros(3, 1), [])
    W = (model.letters["d"](first)).subs(START)
    return _motion(sympy.zeros(3, 1), [(m2, I0 * W[0, 2]), (m3, I0 * W[1, 0]), *AXIS])


@cache
def constants_model() -> tuple[Model, Model]:
    """All initial data: m2, m3 + alpha I0 = s (sin, cos) with s > 0, and the point s = 0."""
    known = {"alpha": alpha, "I0": I0}
    anywhere = {**known, "m2": size * turn(h)[1], "m3": size * turn(h)[0] - alpha * I0}
    rest = {**known, "m2": sympy.Integer(0), "m3": -alpha * I0}
    return Model(anywhere, domains=UPRIGHT, units=units.BALL), Model(rest, domains=UPRIGHT, units=units.BALL)


@cache
def true_constants_model() -> tuple[Model, Model]:
    """Model the same with k and gamma solved from the motion at t = 0; where gamma = 0, k is any unit vector."""
    anywhere, rest = constants_model()
    axis = {"k2": -turn(h)[1], "k3": -turn(h)[0], "gamma": size / I0}
    return (
        Model({**anywhere.letters, **axis}),
        Model({**rest.letters, "k2": turn(h)[1], "k3": turn(h)[0], "gamma": sympy.Integer(0)}),
    )


@cache
def parallel_model(sign: int = 1) -> Model:
    """m2 = 0 and m3 + alpha I0 of one sign, with k and gamma of (29)."""
    axis = {"k2": sympy.Integer(0), "k3": -sympy.Integer(sign), "gamma": size / I0}
    letters = {"alpha": alpha, "I0": I0, "m3": sign * size - alpha * I0, **axis}
    return Model(letters, domains=UPRIGHT, units=units.BALL)


@cache
def parallel_motion_model() -> Model:
    """m(0) = (0, 0, m3): the angle is m3 t/I0."""
    angle = m3 * t / I0
    flow = {cg: -m3 / I0 * sg, sg: m3 / I0 * cg}
    letters = {"m3": m3, "I0": I0, "t": t, "m": sympy.Matrix([0, 0, m3])}
    return Model(letters, ANGLES[2:], flow, START, {angle: (cg, sg)}, units=units.BALL)


_EXPANDED = (
    "[[cos(gamma*t)*cos(alpha*t) - k3*sin(gamma*t)*sin(alpha*t),"
    " k3*sin(gamma*t)*cos(alpha*t) + (k2^2 + k3^2*cos(gamma*t))*sin(alpha*t),"
    " -k2*sin(gamma*t)*cos(alpha*t) + k2*k3*(1 - cos(gamma*t))*sin(alpha*t)],"
    " [-cos(gamma*t)*sin(alpha*t) - k3*sin(gamma*t)*cos(alpha*t),"
    " -k3*sin(gamma*t)*sin(alpha*t) + (k2^2 + k3^2*cos(gamma*t))*cos(alpha*t),"
    " k2*sin(gamma*t)*sin(alpha*t) + k2*k3*(1 - cos(gamma*t))*cos(alpha*t)],"
    " [k2*sin(gamma*t), k2*k3*(1 - cos(gamma*t)), k3^2 + k2^2*cos(gamma*t)]]"
)
_LEFT = "[[cos(alpha*t), sin(alpha*t), 0], [-sin(alpha*t), cos(alpha*t), 0], [0, 0, 1]]"
_RIGHT = (
    "[[cos(gamma*t), k3*sin(gamma*t), -k2*sin(gamma*t)],"
    " [-k3*sin(gamma*t), k2^2 + k3^2*cos(gamma*t), k2*k3*(1 - cos(gamma*t))],"
    " [k2*sin(gamma*t), k2*k3*(1 - cos(gamma*t)), k3^2 + k2^2*cos(gamma*t)]]"
)
_STEADY = "[[cos(m3/I0*t), -sin(m3/I0*t), 0], [sin(m3/I0*t), cos(m3/I0*t), 0], [0, 0, 1]]"
_LINEAR = "d(R[i,j]) = 1/I0*eps[i,a,b]*m[a]*R[b,j]; at0(R) = one"


@cache
def round_model() -> Model:
    """Masses on the principal axes with equal moments; omega = R Omega."""
    whole = kinematic_model()
    moment = sympy.Symbol("G", positive=True)
    masses, places = sympy.symbols("m1:4", positive=True), sympy.symbols("x1:4", real=True)
    where = [*ROTATION, *((mass, moment / place**2) for mass, place in zip(masses, places, strict=True))]
    return Model({**whole.letters, "I0": 2 * moment}, where)


@cache
def body_flow_model() -> Model:
    """Omega by (21) and K = mu/(2c) R^T B by (35), for any state."""
    K = vector("K")
    flow = dict(zip([*Omega, *K], [*(-cross(K, Omega)), *(-cross(Omega, K))], strict=True))
    return Model({"Omega": Omega, "K": K}, flow=flow)


@cache
def any_momentum_model() -> Model:
    """Any vector m with any rate; Omega = R^T m/I0 with R of (20)."""
    m, rate = vector("m"), vector("w")
    spin = R.T * m / I0
    letters = {"Omega": spin, "dOmega": ((R * hat(spin)).T * m + R.T * rate) / I0, "m": m, "dm": rate}
    return Model({**letters, "R": R, "Bf": Bf, "mu": mu, "c": c, "I0": I0}, ROTATION, units=units.BALL)


@cache
def along_model() -> Model:
    """Model gamma of text-ball-parallel, solved for m3."""
    letters = {"alpha": alpha, "gamma": gamma, "t": t, "m3": I0 * (gamma - alpha), "I0": I0, "rod": rodrigues}
    return Model(letters, ANGLES, phases={alpha * t: (ca, sa), gamma * t: (cg, sg)}, units=units.BALL)


@cache
def frame_model() -> Model:
    """Any other axes of the laboratory, and the tensor J of a body that is symmetric only."""
    I2, I3 = sympy.symbols("I2 I3", positive=True)
    return Model({"R": R, "I0": I0, "J": sympy.diag(I2, I2, I3)}, ROTATION)


@cache
def orthogonal_model(sign: int = 1) -> Model:
    """Model an orthogonal matrix of the determinant `sign`, and any m."""
    return Model({"R": sign * R, "m": vector("m"), "I0": I0}, ROTATION)


TRIALS = (
    Trial(
        name="text-momentum",
        tried="m = g1*cross(R1,dR1) + g2*cross(R2,dR2) + g3*cross(R3,dR3) = R*I*T(R)*omega = R*I*Omega",
        model=kinematic_model,
        follows=r"$\mathbf{m} = \sum m_N [\mathbf{x}_N, \dot{\mathbf{x}}_N]$ for three masses on the principal axes",
        false=Falsehood(
            "The angular momentum has the same components in the laboratory and in the body",
            "R*I*Omega",
            "I*Omega",
        ),
    ),
    Trial(
        name="(19)",
        tried="I1 = I2 = I3 = I0",
        model=uniform_ball_model,
        follows=r"the moments of a uniform ball, integrated, $I_0 = 2 M r^2/5$",
    ),
    Trial(
        name="text-ball-centre",
        tried="y = ypar + yperp",
        model=lambda: trajectory_model(signed=False),
        follows="@(4) by substitution, for either sign of the charge",
        defines=("y",),
        solves=TRAJECTORY,
        corrected_tried="y = ypar + yperp",
        corrected_model=trajectory_model,
        corrected_tex=r"\mathbf{y}_0(t)=\mathbf{y}_{\Vert}(t)+\mathbf{y}_{\bot}(t),\qquad\omega=\boxed{\frac{\mu\lvert"
        r"\mathbf{B}\rvert}{c}}",
        grade="sign of the charge",
        slip="(97)",
        note="The centre of any body with one charge-to-mass ratio does, not only that of a ball; for a negative "
        "charge it "
        "takes the sign that @(99) takes.",
    ),
    Trial(
        name="text-ball-axis",
        tried="m = I0*omega = I0*R*Omega; cross(omega,m) = 0",
        model=round_model,
        follows=r"$\mathbf{m} = \sum m_N [\mathbf{x}_N, \dot{\mathbf{x}}_N]$ for three masses on the "
        "principal axes with equal moments",
        false=Falsehood(
            "The angular momentum of every body lies along its axis of rotation",
            "m = I0*omega = I0*R*Omega; ",
            "",
            model=kinematic_model,
        ),
    ),
    Trial(
        name="(20)",
        tried="d(R[i,j]) = -eps[j,a,b]*Omega[a]*R[i,b]",
        model=general.poisson_model,
        follows="@(12)",
    ),
    Trial(
        name="(21)",
        tried="dOmega = -mu/(2*c)*cross(T(R)*Bf,Omega)",
        model=ball_model,
        follows="@(16) with $g = I_0/2$",
    ),
    Trial(
        name="(22)",
        tried="dm = -mu/(2*c)*cross(Bf,m)",
        model=ball_model,
        follows=r"$\mathbf{m} = I_0 R \boldsymbol{\Omega}$, @(20) and @(21)",
    ),
    Trial(
        name="(23)",
        tried="d(m[1]^2 + m[2]^2 + m[3]^2) = 0; d(m[1]*Bf[1] + m[2]*Bf[2] + m[3]*Bf[3]) = 0",
        model=momentum_flow_model,
        follows="@(22)",
    ),
    Trial(
        name="text-ball-body-precession",
        tried="d2(Omega) = cross(K,cross(K,Omega))",
        model=body_flow_model,
        follows=r"@(21) and @(35): a precession about $\mathbf{K}$ with the frequency $|\mathbf{K}| = \alpha$ has this "
        "second rate",
        corrected_tried="d(Omega) = -cross(Omega + K,Omega); d(Omega + K) = 0",
        corrected_tex=(
            r"\dot{\boldsymbol{\Omega}}=-[\boxed{\boldsymbol{\Omega}+\mathbf{K}},\boldsymbol{\Omega}],\qquad"
            r"\boxed{\boldsymbol{\Omega}+\mathbf{K}=\text{const}}"
        ),
        grade="wording",
        note=r"It is so at each instant, but $R^T \mathbf{B}$ moves as well. What stands still in the body is "
        r"$\boldsymbol{\Omega} + \mathbf{K}$, and the components turn about that with the frequency $\gamma$ of "
        "@(29), not with Larmor's.",
    ),
    Trial(
        name="text-ball-equivalent",
        tried="dOmega + mu/(2*c)*cross(T(R)*Bf,Omega) = 1/I0*T(R)*(dm + mu/(2*c)*cross(Bf,m))",
        model=any_momentum_model,
        follows=r"$\boldsymbol{\Omega} = R^T \mathbf{m}/I_0$ differentiated by @(20), for any rate of $\mathbf{m}$",
        note="The left side vanishes if and only if the right one does.",
        false=Falsehood(
            r"The angular momentum turns about $\mathbf{B}$ in the other sense",
            "dm + mu/(2*c)*cross(Bf,m)",
            "dm - mu/(2*c)*cross(Bf,m)",
        ),
    ),
    Trial(
        name="text-linear-poisson",
        tried="-1/I0*eps[j,a,b]*(T(R)*m)[a]*R[i,b] = 1/I0*eps[i,a,b]*m[a]*R[b,j]",
        model=orthogonal_model,
        follows=r"$\det R = 1$",
        grade="missing case",
        slip="text-affirmation",
        corrected_tried="-1/I0*eps[j,a,b]*(T(R)*m)[a]*R[i,b] = 1/I0*eps[i,a,b]*m[a]*R[b,j]",
        corrected_also=(
            Part(
                line="1/I0*eps[j,a,b]*(T(R)*m)[a]*R[i,b] = 1/I0*eps[i,a,b]*m[a]*R[b,j]",
                model=lambda: orthogonal_model(-1),
            ),
        ),
        corrected_tex=(
            r"-\frac{\boxed{\det R}}{I_0}\epsilon_{jab}(R^T\mathbf{m})_aR_{ib}=\frac{1}{I_0}\epsilon_{iab}m_aR_{bj}"
        ),
        note="Said of all orthogonal matrices, it holds for the rotations; for the determinant $-1$ the sign "
        "changes. With "
        "$R(0) = 1$ no such matrix occurs.",
        false=Falsehood(
            "It holds for orthogonal matrices of the determinant $-1$ as well", model=lambda: orthogonal_model(-1)
        ),
    ),
    Trial(
        name="(24)",
        tried="dR[i,j] = 1/I0*eps[i,a,b]*m[a]*R[b,j]; dRj[j] = 1/I0*cross(m,Rj[j])",
        model=ball_model,
        follows=r"@(20) and $\mathbf{m} = I_0 R \boldsymbol{\Omega}$",
    ),
    Trial(
        name="(25)",
        tried="dm = -mu/(2*c)*cross(Bf,m)",
        model=ball_model,
        follows=r"$\mathbf{m} = I_0 R \boldsymbol{\Omega}$, @(20) and @(21)",
    ),
    Trial(
        name="text-ball-frame",
        tried="R*(I0*one)*T(R) = I0*one",
        model=frame_model,
        follows="$R R^T = 1$",
        false=Falsehood(
            "The inertia tensor of a symmetric body stays diagonal too",
            "R*(I0*one)*T(R) = I0*one",
            "R*J*T(R) = J",
        ),
    ),
    Trial(
        name="(26)",
        tried=f"m = {_LEFT}*[0, m2, m3] = [m2*sin(alpha*t), m2*cos(alpha*t), m3]",
        model=larmor_model,
        follows=r"@(25) by substitution, $\alpha$ of @(27)",
        defines=("m",),
        solves="d(m) = -mu/(2*c)*cross([0, 0, b],m); at0(m) = [0, m2, m3]",
    ),
    Trial(
        name="(27)",
        tried="alpha = mu*b/(2*c)",
        model=larmor_frequency_model,
        follows=r"the rate of the angle of $\mathbf{m}$ about $\mathbf{B}$ in @(22)",
    ),
    Trial(
        name="text-ball-ansatz",
        tried="k2 = -m2/(gamma*I0); k3 = -(alpha*I0 + m3)/(gamma*I0); I0^2*gamma^2 = m2^2 + (alpha*I0 + m3)^2",
        model=start_model,
        follows=r"the rate of the ansatz at $t = 0$ is $\mathbf{m}/I_0$",
        grade="missing case",
        slip="(29)",
        corrected_tried="gamma*k2 = -m2/I0; gamma*k3 = -(alpha*I0 + m3)/I0; I0^2*gamma^2 = m2^2 + (alpha*I0 + m3)^2",
        corrected_tex=(
            r"\boxed{\gamma\hat{k}_2=-\frac{m_2}{I_0},\qquad\gamma\hat{k}_3=-\frac{\alpha I_0+m_3}{I_0}},\qquad I_0^2"
            r"\gamma^2=m_2^2+(\alpha I_0+m_3)^2"
        ),
        note=r"Where $\gamma = 0$ the quotients have no value.",
        false=Falsehood(
            r"$\hat{\mathbf{k}}$ points along $\mathbf{m}$ and $\mathbf{B}$, not against them",
            "k2 = -m2",
            "k2 = m2",
        ),
    ),
    Trial(
        name="(28)",
        tried=f"R = {_EXPANDED} = {_LEFT}*{_RIGHT}",
        model=motion_model,
        follows=r"@(24) by substitution, with $\mathbf{m}$ of @(26) and $\hat{\mathbf{k}}$, $\gamma$ of @(29)",
        defines=("R",),
        solves=_LINEAR,
    ),
    Trial(
        name="(29)",
        tried="k2 = -m2/sqrt(m2^2 + (alpha*I0 + m3)^2); k3 = -(m3 + alpha*I0)/sqrt(m2^2 + (alpha*I0 + m3)^2);"
        " gamma = 1/I0*sqrt(m2^2 + (alpha*I0 + m3)^2)",
        model=lambda: constants_model()[0],
        follows=r"the rate of the ansatz at $t = 0$ is $\mathbf{m}/I_0$, for all initial data but one point",
        defines=("k2", "k3", "gamma"),
        solves="k2^2 + k3^2 = 1; gamma*k2 = -m2/I0; gamma*k3 = -(alpha*I0 + m3)/I0",
        corrected_tried=(
            "gamma*k2 = -m2/I0; gamma*k3 = -(m3 + alpha*I0)/I0; gamma = 1/I0*sqrt(m2^2 + (alpha*I0 + m3)^2);"
            " k2^2 + k3^2 = 1"
        ),
        corrected_model=true_constants_model,
        corrected_defines=(),
        corrected_solves="",
        corrected_tex=(
            r"\boxed{\gamma\hat{k}_2=-\frac{m_2}{I_0},\quad\gamma\hat{k}_3=-\frac{m_3+\alpha I_0}{I_0},\quad"
            r"\hat{k}_2^2+\hat{k}_3^2=1},\quad\gamma=\frac{1}{I_0}\sqrt{m_2^2+(\alpha I_0+m_3)^2}"
        ),
        grade="missing case",
        note=r"Right but for one point, $m_2 = 0$ and $m_3 = -\alpha I_0$, where it reads $0/0$: there $\gamma = 0$ "
        r"and $\hat{\mathbf{k}}$ is any unit vector, see @theorem-ball-rest.",
    ),
    Trial(
        name="text-ball-two-rotations",
        tried=f"{_LEFT}*{_RIGHT} = rod([0, 0, 1],cos(alpha*t),-sin(alpha*t))*rod([0, k2,"
        f" k3],cos(gamma*t),-sin(gamma*t))",
        model=motion_model,
        follows="Rodrigues' formula for a rotation about a unit vector",
        false=Falsehood(
            r"The turn about $\mathbf{B}$ comes first, then the one about $\hat{\mathbf{k}}$",
            "rod([0, 0, 1],cos(alpha*t),-sin(alpha*t))*rod([0, k2, k3],cos(gamma*t),-sin(gamma*t))",
            "rod([0, k2, k3],cos(gamma*t),-sin(gamma*t))*rod([0, 0, 1],cos(alpha*t),-sin(alpha*t))",
        ),
    ),
    Trial(
        name="text-ball-parallel",
        tried="k2 = 0; k3 = -1; gamma = alpha + m3/I0",
        model=parallel_model,
        follows=r"@(29) with $m_2 = 0$, $m_3 > -\alpha I_0$",
        grade="missing case",
        corrected_tried="k2 = 0; k3 = -1; gamma = alpha + m3/I0",
        corrected_also=(Part(line="k2 = 0; k3 = 1; gamma = -(alpha + m3/I0)", model=lambda: parallel_model(-1)),),
        corrected_tex=(
            r"\hat{\mathbf{k}}=(0,0,\boxed{\mp1})^T,\qquad\gamma=\boxed{\pm}\Bigl(\alpha+\frac{m_3}{I_0}\Bigr)\quad"
            r"\boxed{\text{for}\quad m_3\gtrless-\alpha I_0}"
        ),
        note=r"For a fast spin against $\mathbf{B}$, $m_3 < -\alpha I_0$, both signs turn round, since $\gamma$ is a "
        r"root and never negative. The product, and so @(30), is the same; for $m_3 = -\alpha I_0$ see "
        "@theorem-ball-rest.",
        false=Falsehood(
            "The frequency is the spin alone",
            "gamma = alpha + m3/I0",
            "gamma = m3/I0",
        ),
    ),
    Trial(
        name="(30)",
        tried=f"R = {_STEADY}",
        model=parallel_motion_model,
        follows=r"@(24) by substitution with $\mathbf{m} = (0, 0, m_3)$, and @text-ball-two-rotations with the "
        "constants of @text-ball-parallel",
        defines=("R",),
        solves=_LINEAR,
        also=(
            Part(
                line="rod([0, 0, 1],cos(alpha*t),-sin(alpha*t))*rod([0, 0, -1],cos(gamma*t),-sin(gamma*t))"
                f" = {_STEADY}",
                model=along_model,
            ),
        ),
    ),
)
