"""Section III on trial: the charged ball, (19) to (30)."""

import ast

import sympy

from atlas.trial.proofs import euler_poisson as general
from atlas.trial.proofs.model import Model, Value, cross, hat, rodrigues, rotation_symbols, turn, vector
from atlas.trial.proofs.notation import parse
from atlas.trial.proofs.particle import SIGNED, TRAJECTORY, trajectory_model
from atlas.trial.proofs.particle import SIGNS as PARTICLE_SIGNS
from atlas.trial.proofs.trial import Falsehood, Part, Trial, mended, read

SIGNS = {r"\mathbf{B}": "Bf", r"\hat{k}_2": "k2", r"\hat{k}_3": "k3", r"\hat{\mathbf{k}}": "axis"}
(R, ROTATION), Omega, Bf = rotation_symbols(), vector("Omega"), vector("B")
I0, mu, c = sympy.symbols("I0 mu c", positive=True)
alpha, gamma, t, k2, k3, m2, m3 = sympy.symbols("alpha gamma t k2 k3 m2 m3", real=True)
ca, sa, cg, sg, p, q, h = sympy.symbols("ca sa cg sg p q h", real=True)
size = sympy.Symbol("s", positive=True)
E3, ANY = sympy.Matrix([0, 0, 1]), vector("m")

LARMOR = {ca: -alpha * sa, sa: alpha * ca}
TURNING = {cg: -gamma * sg, sg: gamma * cg}
START = {ca: 1, sa: 0, cg: 1, sg: 0}
ANGLES = [(ca, turn(p)[0]), (sa, turn(p)[1]), (cg, turn(q)[0]), (sg, turn(q)[1])]
UPRIGHT = {"alpha": "positive"}
AXIS = [(k2, turn(h)[1]), (k3, turn(h)[0])]


def kinematic_model() -> Model:
    """Three masses on the principal axes of a turning body."""
    masses = sympy.symbols("m1:4", positive=True)
    places = [sympy.diag(*sympy.symbols("x1:4", real=True)).col(n) for n in range(3)]
    g = sum((m * x * x.T for m, x in zip(masses, places, strict=True)), sympy.zeros(3, 3))
    dR = R * hat(Omega)
    spin = sum((m * cross(R * x, dR * x) for m, x in zip(masses, places, strict=True)), sympy.zeros(3, 1))
    letters = {"m": spin, "R": R, "I": g.trace() * sympy.eye(3) - g, "Omega": Omega, "omega": R * Omega}
    families = zip((1, 2, 3), masses, places, strict=True)
    letters |= {"mass": dict(enumerate(masses, 1)), "x": {n: R * place for n, _, place in families}}
    letters |= {"g": {n: g[n - 1, n - 1] for n in (1, 2, 3)}, "column": {n: R.col(n - 1) for n in (1, 2, 3)}}
    return Model(letters, ROTATION, dict(zip(R, dR, strict=True)), ranges={"N": (1, 2, 3)}, laws="R by (12)")


def uniform_ball_model() -> Model:
    """Moments of inertia of a uniform ball of radius r, each by its own integral."""
    r, s, u, w, mass = sympy.symbols("r s u w M", positive=True)
    x, y, z = s * sympy.sqrt(1 - u**2) * sympy.cos(w), s * sympy.sqrt(1 - u**2) * sympy.sin(w), s * u
    density = mass / (sympy.Rational(4, 3) * sympy.pi * r**3)

    def over(value: Value) -> Value:
        return sympy.integrate(density * s**2 * sympy.expand(value), (w, 0, 2 * sympy.pi), (u, -1, 1), (s, 0, r))

    letters = {"I1": over(y**2 + z**2), "I2": over(x**2 + z**2), "I3": over(x**2 + y**2), "M": mass, "r": r}
    return Model({**letters, "I0": sympy.Rational(2, 5) * mass * r**2})


def ball_model() -> Model:
    """(16) with I = I0 and so g = I0/2; m = I0 R Omega."""
    tensor = I0 * sympy.eye(3)
    rate = general.euler(tensor, tensor / 2, R.T * Bf) / I0
    columns = {n + 1: R.col(n) for n in range(3)}
    letters = {"R": R, "column": columns, "Bf": Bf, "mu": mu, "c": c, "I0": I0, "Omega": Omega, "m": I0 * R * Omega}
    letters |= {f"I{n + 1}": tensor[n, n] for n in range(3)}
    flow = dict(zip([*R, *Omega], [*(R * hat(Omega)), *rate], strict=True))
    return Model(letters, ROTATION, flow, laws="R by (12), Omega by (16)")


def larmor_model() -> Model:
    """B = (0, 0, b), alpha t as an angle."""
    b = sympy.Symbol("b", positive=True)
    letters = {"alpha": alpha, "t": t, "m2": m2, "m3": m3, "mu": mu, "c": c, "b": b}
    bindings = [(alpha, mu * b / (2 * c)), *ANGLES[:2]]
    model = Model(letters, bindings, LARMOR, START, {alpha * t: (ca, sa)})
    model.letters["about_B"] = model.about(E3)
    return model


def larmor_frequency_model() -> Model:
    """Rate of the angle of m about B, from (22): (m x dm).B over |m_perp|^2 |B|, turned clockwise."""
    m, b = vector("m"), sympy.Symbol("b", positive=True)
    field = sympy.Matrix([0, 0, b])
    dm = -mu / (2 * c) * cross(field, m)
    rate = -cross(m, dm)[2] / (m[0] ** 2 + m[1] ** 2)
    return Model({"alpha": sympy.cancel(rate), "mu": mu, "c": c, "Bf": field})


def _motion(spin: Value, bindings: list[tuple[Value, Value]]) -> Model:
    letters = {"alpha": alpha, "gamma": gamma, "t": t, "k2": k2, "k3": k3, "I0": I0, "m": spin, "m2": m2, "m3": m3}
    phases = {alpha * t: (ca, sa), gamma * t: (cg, sg)}
    model = Model(letters, bindings, {**LARMOR, **TURNING}, START, phases)
    model.letters |= {"about_B": model.about(E3), "about_k": model.about(sympy.Matrix([0, k2, k3]))}
    return model


def motion_model() -> Model:
    """Model the angular momentum (26) and the constants (29), solved for m2, m3."""
    spin = sympy.Matrix([m2 * sa, m2 * ca, m3])
    return _motion(spin, [*ANGLES, (m2, -gamma * I0 * k2), (m3, -gamma * I0 * k3 - alpha * I0), *AXIS])


def start_model() -> Model:
    """Model the momentum that the ansatz (28) has at t = 0: I0 times the axial vector of dR/dt."""
    attitude = rodrigues(E3, ca, -sa) * rodrigues(sympy.Matrix([0, k2, k3]), cg, -sg)
    model = _motion(sympy.zeros(3, 1), [])
    W = (model.letters["d"](attitude)).subs(START)
    return _motion(sympy.zeros(3, 1), [(m2, I0 * W[0, 2]), (m3, I0 * W[1, 0]), *AXIS])


def constants_model() -> tuple[Model, Model]:
    """All initial data: m2, m3 + alpha I0 = s (sin, cos) with s > 0, and the point s = 0."""
    vocabulary = {"alpha": alpha, "I0": I0}
    anywhere = {**vocabulary, "m2": size * turn(h)[1], "m3": size * turn(h)[0] - alpha * I0}
    remainder = {**vocabulary, "m2": sympy.Integer(0), "m3": -alpha * I0}
    return Model(anywhere, domains=UPRIGHT), Model(remainder, domains=UPRIGHT)


def true_constants_model() -> tuple[Model, Model]:
    """Model all initial data, k and gamma solved from the motion at t = 0; for gamma = 0, k is any unit vector."""
    anywhere, remainder = constants_model()
    axis = {"k2": -turn(h)[1], "k3": -turn(h)[0], "gamma": size / I0}
    return (
        Model({**anywhere.letters, **axis}),
        Model({**remainder.letters, "k2": turn(h)[1], "k3": turn(h)[0], "gamma": sympy.Integer(0)}),
    )


def parallel_model(sign: int = 1) -> Model:
    """m2 = 0 and m3 + alpha I0 of one sign, with k and gamma of (29)."""
    vocabulary = {"axis": -sign * E3, "gamma": size / I0, "sign": sympy.Integer(sign)}
    letters = {"alpha": alpha, "I0": I0, "m3": sign * size - alpha * I0, **vocabulary}
    return Model(letters, domains=UPRIGHT)


def parallel_motion_model() -> Model:
    """m(0) = (0, 0, m3): the angle is m3 t/I0."""
    angle = m3 * t / I0
    flow = {cg: -m3 / I0 * sg, sg: m3 / I0 * cg}
    letters = {"m3": m3, "I0": I0, "t": t, "m": sympy.Matrix([0, 0, m3])}
    return Model(letters, ANGLES[2:], flow, START, {angle: (cg, sg)})


def _with_rotation(line: str) -> str:
    """Add to m = M m0 that the matrix M is the turn by -alpha t about the field: its first column meets a zero."""
    product = parse(line)[0].comparators[0]
    return f"{line}; {ast.unparse(product.left) if isinstance(product, ast.BinOp) else product} = about_B(-alpha*t)"


LINEAR = "d(R[i,j]) = 1/I0*eps[i,a,b]*m[a]*R[b,j]; at0(R) = one"


def round_model() -> Model:
    """Masses on the principal axes with equal moments; omega = R Omega."""
    basis = kinematic_model()
    moment = sympy.Symbol("G", positive=True)
    masses, places = sympy.symbols("m1:4", positive=True), sympy.symbols("x1:4", real=True)
    bindings = [*ROTATION, *((mass, moment / place**2) for mass, place in zip(masses, places, strict=True))]
    return Model({**basis.letters, "I0": 2 * moment}, bindings)


def body_flow_model() -> Model:
    """Omega by (21) and K = mu/(2c) R^T B by (35), for any state."""
    K = vector("K")
    flow = dict(zip([*Omega, *K], [*(-cross(K, Omega)), *(-cross(Omega, K))], strict=True))
    letters = {"Omega": Omega, "K": K, "R": R, "Bf": 2 * c / mu * R * K, "mu": mu, "c": c}
    return Model(letters, ROTATION, flow, laws="Omega by (21), K by (35)")


def any_momentum_model() -> Model:
    """Any vector m with any rate; Omega = R^T m/I0 with R of (20)."""
    m, rate = vector("m"), vector("w")
    spin = R.T * m / I0
    letters = {"Omega": spin, "m": m, "R": R, "Bf": Bf, "mu": mu, "c": c, "I0": I0}
    flow = dict(zip([*R, *m], [*(R * hat(spin)), *rate], strict=True))
    return Model(letters, ROTATION, flow, laws="R by (12), m any")


def along_model() -> Model:
    """Model gamma of text-ball-parallel, solved for m3."""
    letters = {"t": t, "m3": I0 * (gamma - alpha), "I0": I0}
    letters["R"] = rodrigues(E3, ca, -sa) * rodrigues(-E3, cg, -sg)
    return Model(letters, ANGLES, phases={alpha * t: (ca, sa), gamma * t: (cg, sg)})


def frame_model() -> Model:
    """Any other axes of the laboratory, and the tensor J of a body that is symmetric only."""
    I2, I3 = sympy.symbols("I2 I3", positive=True)
    return Model({"R": R, "I0": I0, "J": sympy.diag(I2, I2, I3)}, ROTATION)


def orthogonal_model(sign: int = 1) -> Model:
    """Model an orthogonal matrix of the determinant `sign`, and any m."""
    letters = {"R": sign * R, "m": vector("m"), "I0": I0, "det": lambda matrix: matrix.det(method="berkowitz")}
    return Model(letters, ROTATION)


TRIALS = {
    "text-momentum": Trial(
        signs={r"\mathbf{m}": "m", "m": "mass[]", r"\mathbf{R}": "column[]"},
        model=kinematic_model,
        follows=r"$\mathbf{m} = \sum m_N [\mathbf{x}_N, \dot{\mathbf{x}}_N]$ for three masses on the principal axes",
        false=Falsehood(
            "The angular momentum has the same components in the laboratory and in the body", "R*I*Omega", "I*Omega"
        ),
    ),
    "(19)": Trial(model=uniform_ball_model, follows=r"the moments of a uniform ball, integrated, $I_0 = 2 M r^2/5$"),
    "text-ball-centre": Trial(
        signs={**PARTICLE_SIGNS, r"\mathbf{y}_0": "y"},
        model=lambda: trajectory_model(signed=False),
        follows="@(4) by substitution, for either sign of the charge",
        defines=("y",),
        solves=TRAJECTORY,
        corrected_model=trajectory_model,
        corrected_tex=mended("text-ball-centre", {}, SIGNED),
        slip="(97)",
        note="The centre of any body with one charge-to-mass ratio does, not only that of a ball; for a negative "
        "charge it takes the sign that @(99) takes.",
    ),
    "text-ball-axis": Trial(
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
    "(20)": Trial(model=general.poisson_model, follows="@(12)"),
    "(21)": Trial(model=ball_model, follows="@(16) with $g = I_0/2$"),
    "(22)": Trial(model=ball_model, follows=r"$\mathbf{m} = I_0 R \boldsymbol{\Omega}$, @(20) and @(21)"),
    "(23)": Trial(
        model=lambda: Model({"m": ANY, "Bf": Bf}, flow=dict(zip(ANY, -mu / (2 * c) * cross(Bf, ANY), strict=True))),
        follows="@(22)",
    ),
    "text-ball-body-precession": Trial(
        signs={r"\dot{\boldsymbol{\Omega}}": "d(Omega)"},
        model=body_flow_model,
        follows=r"@(21) and @(35): a precession about $\mathbf{K}$ with the frequency $|\mathbf{K}| = \alpha$ has this "
        "second rate",
        corrected_tex=r"\dot{\boldsymbol{\Omega}}=-[\boxed{\boldsymbol{\Omega}+\mathbf{K}},\boldsymbol{\Omega}],\qquad"
        r"\boxed{\boldsymbol{\Omega}+\mathbf{K}=\text{const}}",
        grade="wording",
        note=r"It is so at each instant, but $R^T \mathbf{B}$ moves as well. At rest in the body is "
        r"$\boldsymbol{\Omega} + \mathbf{K}$, and the components turn about that with the frequency $\gamma$ of "
        "@(29), not with Larmor's.",
    ),
    "text-ball-equivalent": Trial(
        model=any_momentum_model,
        follows=r"$\boldsymbol{\Omega} = R^T \mathbf{m}/I_0$ differentiated by @(20), for any rate of $\mathbf{m}$",
        note="The left side vanishes if and only if the right one does.",
        false=Falsehood(
            r"The angular momentum turns about $\mathbf{B}$ in the other sense",
            "d(m) + mu/(2*c)*cross(Bf, m)",
            "d(m) - mu/(2*c)*cross(Bf, m)",
        ),
    ),
    "text-linear-poisson": Trial(
        model=orthogonal_model,
        follows=r"$\det R = 1$",
        note="It is tried for the rotations, to which $R(0) = 1$ keeps both systems; for the determinant $-1$ the sign "
        "would change.",
        false=Falsehood("It holds for the determinant $-1$ too", model=lambda: orthogonal_model(-1)),
    ),
    "(24)": Trial(
        signs={r"\mathbf{R}": "column[]"},
        model=ball_model,
        follows=r"@(20) and $\mathbf{m} = I_0 R \boldsymbol{\Omega}$",
    ),
    "(25)": Trial(model=ball_model, follows=r"$\mathbf{m} = I_0 R \boldsymbol{\Omega}$, @(20) and @(21)"),
    "text-ball-frame": Trial(
        model=frame_model,
        follows="$R R^T = 1$",
        false=Falsehood(
            "The inertia tensor of a symmetric body stays diagonal too", "R*(I0*one)*T(R) = I0*one", "R*J*T(R) = J"
        ),
    ),
    "(26)": Trial(
        form=_with_rotation,
        model=larmor_model,
        follows=r"@(25) by substitution, $\alpha$ of @(27)",
        defines=("m",),
        solves="d(m) = -mu/(2*c)*cross([0, 0, b],m); at0(m) = [0, m2, m3]",
    ),
    "(27)": Trial(
        model=larmor_frequency_model,
        follows=r"the rate of the angle of $\mathbf{m}$ about $\mathbf{B}$ in @(22)",
    ),
    "text-ball-ansatz": Trial(
        model=start_model,
        follows=r"the rate of the ansatz at $t = 0$ is $\mathbf{m}/I_0$",
        slip="(29)",
        corrected_tex=r"\boxed{\gamma\hat{k}_2=-\frac{m_2}{I_0},\qquad\gamma\hat{k}_3=-\frac{\alpha I_0+m_3}{I_0}},"
        r"\qquad I_0^2\gamma^2=m_2^2+(\alpha I_0+m_3)^2",
        note=r"Where $\gamma = 0$ the quotients have no value.",
        false=Falsehood(
            r"$\hat{\mathbf{k}}$ points along $\mathbf{m}$ and $\mathbf{B}$, not against them", "k2 = -m2", "k2 = m2"
        ),
    ),
    "(28)": Trial(
        signs={"": "R"},
        model=motion_model,
        follows=r"@(24) by substitution, with $\mathbf{m}$ of @(26) and $\hat{\mathbf{k}}$, $\gamma$ of @(29)",
        defines=("R",),
        solves=LINEAR,
    ),
    "(29)": Trial(
        model=lambda: constants_model()[0],
        follows=r"the rate of the ansatz at $t = 0$ is $\mathbf{m}/I_0$, for all initial data but one point",
        defines=("k2", "k3", "gamma"),
        solves="k2^2 + k3^2 = 1; gamma*k2 = -m2/I0; gamma*k3 = -(alpha*I0 + m3)/I0",
        corrected_model=true_constants_model,
        corrected_defines=(),
        corrected_solves="",
        corrected_tex=r"\boxed{\gamma\hat{k}_2=-\frac{m_2}{I_0},\quad\gamma\hat{k}_3=-\frac{m_3+\alpha I_0}{I_0},\quad"
        r"\hat{k}_2^2+\hat{k}_3^2=1},\quad\gamma=\frac{1}{I_0}\sqrt{m_2^2+(\alpha I_0+m_3)^2}",
        grade="missing case",
        note=r"Right but for one point, $m_2 = 0$ and $m_3 = -\alpha I_0$, where it reads $0/0$: there $\gamma = 0$ "
        r"and $\hat{\mathbf{k}}$ is any unit vector, see @theorem-ball-rest.",
    ),
    "text-ball-two-rotations": Trial(
        signs={r"R_{\hat{\mathbf{B}}}": "about_B()", r"R_{\hat{\mathbf{k}}}": "about_k()"},
        defines=("R",),
        solves=LINEAR,
        model=motion_model,
        follows="Rodrigues' formula for a rotation about a unit vector",
        corrected_tex=r"R(t)=R_{\hat{\mathbf{B}}}(\boxed{-}\alpha t)\,R_{\hat{\mathbf{k}}}(\boxed{-}\gamma t)",
        grade="wording",
        note="Both turns go against the sense in which @(85) counts a rotation with a frequency about a vector: with "
        r"$\alpha,\gamma>0$ they are left-handed about $\mathbf{B}$ and $\hat{\mathbf{k}}$.",
        false=Falsehood(
            r"The turn about $\mathbf{B}$ comes first, then the one about $\hat{\mathbf{k}}$",
            "about_B(-alpha*t)*about_k(-gamma*t)",
            "about_k(-gamma*t)*about_B(-alpha*t)",
        ),
    ),
    "text-ball-parallel": Trial(
        model=parallel_model,
        follows=r"@(29) with $m_2 = 0$, $m_3 > -\alpha I_0$",
        grade="missing case",
        corrected_model=lambda: (parallel_model(), parallel_model(-1)),
        corrected_signs={r"\text{for}\quad m_3\gtrless-\alpha I_0": "sign*(m3 + alpha*I0) > 0"},
        corrected_tex=r"\hat{\mathbf{k}}=(0,0,\boxed{\mp1})^T,\qquad\gamma=\boxed{\pm}\Bigl(\alpha+\frac{m_3}{I_0}"
        r"\Bigr)\quad\boxed{\text{for}\quad m_3\gtrless-\alpha I_0}",
        note=r"For a fast spin against $\mathbf{B}$, $m_3 < -\alpha I_0$, both signs turn round, since $\gamma$ is a "
        r"root and never negative. The product, and so @(30), is the same; for $m_3 = -\alpha I_0$ see "
        "@theorem-ball-rest.",
        false=Falsehood("The frequency is the spin alone", "(alpha + m3/I0)", "m3/I0"),
    ),
    "(30)": Trial(
        model=parallel_motion_model,
        follows=r"@(24) by substitution with $\mathbf{m} = (0, 0, m_3)$, and @text-ball-two-rotations with the "
        "constants of @text-ball-parallel",
        defines=("R",),
        solves=LINEAR,
        also=(Part(line=read("(30)", SIGNS), model=along_model),),
    ),
}
