"""Section III on trial: the charged ball, (19) to (30)."""

import ast

import sympy

from atlas.trial.proofs import euler_poisson as general
from atlas.trial.proofs.model import Model, Value, cross, hat, rodrigues, rotation_symbols, turn, vector
from atlas.trial.proofs.notation import parse
from atlas.trial.proofs.particle import SIGNS as PARTICLE_SIGNS
from atlas.trial.proofs.particle import TRAJECTORY, trajectory_model
from atlas.trial.proofs.trial import Falsehood, Part, Trial, read

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
    """Return the model of three masses on the principal axes of a body that rotates by R, for text-momentum.

    Letters: m the angular momentum (3, 1) as a sum over the masses, I the inertia tensor, omega = R Omega; by index
    `mass`, `x` (places in space), `g` (moments of mass) and `column` (of R).
    """
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
    """Return the model of a uniform ball of radius r and mass M for (19): I1, I2, I3 by integrals, I0 = 2 M r^2/5."""
    r, s, u, w, mass = sympy.symbols("r s u w M", positive=True)
    x, y, z = s * sympy.sqrt(1 - u**2) * sympy.cos(w), s * sympy.sqrt(1 - u**2) * sympy.sin(w), s * u
    density = mass / (sympy.Rational(4, 3) * sympy.pi * r**3)

    def over(value: Value) -> Value:
        return sympy.integrate(density * s**2 * sympy.expand(value), (w, 0, 2 * sympy.pi), (u, -1, 1), (s, 0, r))

    letters = {"I1": over(y**2 + z**2), "I2": over(x**2 + z**2), "I3": over(x**2 + y**2), "M": mass, "r": r}
    return Model({**letters, "I0": sympy.Rational(2, 5) * mass * r**2})


def ball_model() -> Model:
    """Return the model of a ball in the field B, for (21) to (25): R by (12), Omega by (16), m = I0 R Omega.

    The tensors in (16) are I = I0 and g = I0/2. Letters also: B as `Bf`, mu and c, and the columns of R.
    """
    tensor = I0 * sympy.eye(3)
    rate = general.euler(tensor, tensor / 2, R.T * Bf) / I0
    columns = {n + 1: R.col(n) for n in range(3)}
    letters = {"R": R, "column": columns, "Bf": Bf, "mu": mu, "c": c, "I0": I0, "Omega": Omega, "m": I0 * R * Omega}
    letters |= {f"I{n + 1}": tensor[n, n] for n in range(3)}
    flow = dict(zip([*R, *Omega], [*(R * hat(Omega)), *rate], strict=True))
    return Model(letters, ROTATION, flow, laws="R by (12), Omega by (16)")


def larmor_model() -> Model:
    """Return the model of the precession (26) of m in B = (0, 0, b), with alpha = mu b/(2c) and alpha t as a phase.

    `about_B` is a function from an angle to the rotation matrix about e3. m itself is defined by the line.
    """
    b = sympy.Symbol("b", positive=True)
    letters = {"alpha": alpha, "t": t, "m2": m2, "m3": m3, "mu": mu, "c": c, "b": b}
    bindings = [(alpha, mu * b / (2 * c)), *ANGLES[:2]]
    model = Model(letters, bindings, LARMOR, START, {alpha * t: (ca, sa)})
    model.letters["about_B"] = model.rotation_about(E3)
    return model


def larmor_frequency_model() -> Model:
    """Return the model of (27) whose alpha is the clockwise angular velocity of m about B by (22), in rad/time.

    alpha is computed as -(m x dm/dt)_3/(m1^2 + m2^2), for B = (0, 0, b) and any m.
    """
    m, b = vector("m"), sympy.Symbol("b", positive=True)
    field = sympy.Matrix([0, 0, b])
    dm = -mu / (2 * c) * cross(field, m)
    rate = -cross(m, dm)[2] / (m[0] ** 2 + m[1] ** 2)
    return Model({"alpha": sympy.cancel(rate), "mu": mu, "c": c, "Bf": field})


def _motion(spin: Value, bindings: list[tuple[Value, Value]]) -> Model:
    letters = {"alpha": alpha, "gamma": gamma, "t": t, "k2": k2, "k3": k3, "I0": I0, "m": spin, "m2": m2, "m3": m3}
    phases = {alpha * t: (ca, sa), gamma * t: (cg, sg)}
    model = Model(letters, bindings, {**LARMOR, **TURNING}, START, phases)
    model.letters |= {"about_B": model.rotation_about(E3), "about_k": model.rotation_about(sympy.Matrix([0, k2, k3]))}
    return model


def motion_model() -> Model:
    """Return the model of the ball's angular momentum (26), with m2 and m3 in gamma, k2 and k3 through (29); for (28).

    k = (0, k2, k3) is the unit axis of the second rotation, gamma its rate; alpha t and gamma t are phases.
    """
    spin = sympy.Matrix([m2 * sa, m2 * ca, m3])
    return _motion(spin, [*ANGLES, (m2, -gamma * I0 * k2), (m3, -gamma * I0 * k3 - alpha * I0), *AXIS])


def start_model() -> Model:
    """Return the model of text-ball-ansatz: m2, m3 are the angular momentum of the ansatz (28) at t = 0.

    This momentum is I0 times the axial vector of dR/dt.
    """
    attitude = rodrigues(E3, ca, -sa) * rodrigues(sympy.Matrix([0, k2, k3]), cg, -sg)
    model = _motion(sympy.zeros(3, 1), [])
    W = (model.letters["d"](attitude)).subs(START)
    return _motion(sympy.zeros(3, 1), [(m2, I0 * W[0, 2]), (m3, I0 * W[1, 0]), *AXIS])


def constants_model() -> tuple[Model, Model]:
    """Return two models that hold all initial data of (29): m2, m3 + alpha I0 = s (sin, cos) with s > 0, and s = 0."""
    vocabulary = {"alpha": alpha, "I0": I0}
    anywhere = {**vocabulary, "m2": size * turn(h)[1], "m3": size * turn(h)[0] - alpha * I0}
    remainder = {**vocabulary, "m2": sympy.Integer(0), "m3": -alpha * I0}
    return Model(anywhere, domains=UPRIGHT), Model(remainder, domains=UPRIGHT)


def true_constants_model() -> tuple[Model, Model]:
    """Return the two models of `constants_model` with k2, k3 (unit axis) and gamma (rate) of the corrected (29).

    For s = 0 gamma is 0 and k any unit vector.
    """
    anywhere, remainder = constants_model()
    axis = {"k2": -turn(h)[1], "k3": -turn(h)[0], "gamma": size / I0}
    return (
        Model({**anywhere.letters, **axis}),
        Model({**remainder.letters, "k2": turn(h)[1], "k3": turn(h)[0], "gamma": sympy.Integer(0)}),
    )


def parallel_model(sign: int = 1) -> Model:
    """Return the model of text-ball-parallel: m2 = 0 and m3 + alpha I0 = ``sign`` s with s > 0.

    The axis k is -``sign`` e3, and gamma = s/I0; ``sign`` is 1 or -1.
    """
    vocabulary = {"axis": -sign * E3, "gamma": size / I0, "sign": sympy.Integer(sign)}
    letters = {"alpha": alpha, "I0": I0, "m3": sign * size - alpha * I0, **vocabulary}
    return Model(letters, domains=UPRIGHT)


def parallel_motion_model() -> Model:
    """Return the model of (30): the constant momentum m = (0, 0, m3) and the phase m3 t/I0; the line defines R."""
    angle = m3 * t / I0
    flow = {cg: -m3 / I0 * sg, sg: m3 / I0 * cg}
    letters = {"m3": m3, "I0": I0, "t": t, "m": sympy.Matrix([0, 0, m3])}
    return Model(letters, ANGLES[2:], flow, START, {angle: (cg, sg)})


def _with_rotation(line: str) -> str:
    """Return the line "m = M m0; M = about_B(-alpha t)" for the line m = M m0 of (26), so that M itself is checked too.

    The first component of m0 is zero, so that m alone would leave the first column of M unchecked.
    """
    product = parse(line)[0].comparators[0]
    return f"{line}; {ast.unparse(product.left) if isinstance(product, ast.BinOp) else product} = about_B(-alpha*t)"


LINEAR = "d(R[i,j]) = 1/I0*eps[i,a,b]*m[a]*R[b,j]; at0(R) = one"


def round_model() -> Model:
    """Return `kinematic_model` with equal moments of mass for text-ball-axis: the inertia tensor is I0 times 1."""
    basis = kinematic_model()
    moment = sympy.Symbol("G", positive=True)
    masses, places = sympy.symbols("m1:4", positive=True), sympy.symbols("x1:4", real=True)
    bindings = [*ROTATION, *((mass, moment / place**2) for mass, place in zip(masses, places, strict=True))]
    return Model({**basis.letters, "I0": 2 * moment}, bindings)


def body_flow_model() -> Model:
    """Return the model of any Omega and K with the rates (21) and (35), for text-ball-body-precession.

    K is the field in the body's axes: B = (2c/mu) R K.
    """
    K = vector("K")
    flow = dict(zip([*Omega, *K], [*(-cross(K, Omega)), *(-cross(Omega, K))], strict=True))
    letters = {"Omega": Omega, "K": K, "R": R, "Bf": 2 * c / mu * R * K, "mu": mu, "c": c}
    return Model(letters, ROTATION, flow, laws="Omega by (21), K by (35)")


def any_momentum_model() -> Model:
    """Return the model of any vector m with any rate, and R by (12) with Omega = R^T m/I0; for text-ball-equivalent."""
    m, rate = vector("m"), vector("w")
    spin = R.T * m / I0
    letters = {"Omega": spin, "m": m, "R": R, "Bf": Bf, "mu": mu, "c": c, "I0": I0}
    flow = dict(zip([*R, *m], [*(R * hat(spin)), *rate], strict=True))
    return Model(letters, ROTATION, flow, laws="R by (12), m any")


def along_model() -> Model:
    """Return the model of (30) beside text-ball-parallel: R two rotations about e3, by -alpha t and gamma t.

    The momentum along the field is m3 = I0 (gamma - alpha).
    """
    letters = {"t": t, "m3": I0 * (gamma - alpha), "I0": I0}
    letters["R"] = rodrigues(E3, ca, -sa) * rodrigues(-E3, cg, -sg)
    return Model(letters, ANGLES, phases={alpha * t: (ca, sa), gamma * t: (cg, sg)})


def frame_model() -> Model:
    """Return the model of any rotation R of the laboratory's axes, I0 and J = diag(I2, I2, I3), for text-ball-frame."""
    I2, I3 = sympy.symbols("I2 I3", positive=True)
    return Model({"R": R, "I0": I0, "J": sympy.diag(I2, I2, I3)}, ROTATION)


def orthogonal_model(sign: int = 1) -> Model:
    """Return the model of any vector m and the orthogonal matrices R with determinant ``sign``, 1 or -1.

    It serves text-linear-poisson.
    """
    letters = {"R": sign * R, "m": vector("m"), "I0": I0, "det": lambda matrix: matrix.det(method="berkowitz")}
    return Model(letters, ROTATION)


TRIALS = {
    "text-momentum": Trial(
        signs={r"\mathbf{m}": "m", "m": "mass[]", r"\mathbf{R}": "column[]"},
        model=kinematic_model,
        false=Falsehood("R*I*Omega", "I*Omega"),
    ),
    "(19)": Trial(model=uniform_ball_model),
    "text-ball-centre": Trial(
        signs={**PARTICLE_SIGNS, r"\mathbf{y}_0": "y"},
        model=lambda: trajectory_model(signed=False),
        defines=("y",),
        solves=TRAJECTORY,
        corrected_model=trajectory_model,
    ),
    "text-ball-axis": Trial(
        model=round_model, false=Falsehood("m = I0*omega = I0*R*Omega; ", "", model=kinematic_model)
    ),
    "(20)": Trial(model=general.poisson_model),
    "(21)": Trial(model=ball_model),
    "(22)": Trial(model=ball_model),
    "(23)": Trial(
        model=lambda: Model({"m": ANY, "Bf": Bf}, flow=dict(zip(ANY, -mu / (2 * c) * cross(Bf, ANY), strict=True)))
    ),
    "text-ball-body-precession": Trial(signs={r"\dot{\boldsymbol{\Omega}}": "d(Omega)"}, model=body_flow_model),
    "text-ball-equivalent": Trial(
        model=any_momentum_model, false=Falsehood("d(m) + mu/(2*c)*cross(Bf, m)", "d(m) - mu/(2*c)*cross(Bf, m)")
    ),
    "text-linear-poisson": Trial(model=orthogonal_model, false=Falsehood(model=lambda: orthogonal_model(-1))),
    "(24)": Trial(signs={r"\mathbf{R}": "column[]"}, model=ball_model),
    "(25)": Trial(model=ball_model),
    "text-ball-frame": Trial(model=frame_model, false=Falsehood("R*(I0*one)*T(R) = I0*one", "R*J*T(R) = J")),
    "(26)": Trial(
        form=_with_rotation,
        model=larmor_model,
        defines=("m",),
        solves="d(m) = -mu/(2*c)*cross([0, 0, b],m); at0(m) = [0, m2, m3]",
    ),
    "(27)": Trial(model=larmor_frequency_model),
    "text-ball-ansatz": Trial(model=start_model, false=Falsehood("k2 = -m2", "k2 = m2")),
    "(28)": Trial(signs={"": "R"}, model=motion_model, defines=("R",), solves=LINEAR),
    "(29)": Trial(
        model=lambda: constants_model()[0],
        defines=("k2", "k3", "gamma"),
        solves="k2^2 + k3^2 = 1; gamma*k2 = -m2/I0; gamma*k3 = -(alpha*I0 + m3)/I0",
        corrected_model=true_constants_model,
        corrected_defines=(),
        corrected_solves="",
    ),
    "text-ball-two-rotations": Trial(
        signs={r"R_{\hat{\mathbf{B}}}": "about_B()", r"R_{\hat{\mathbf{k}}}": "about_k()"},
        defines=("R",),
        solves=LINEAR,
        model=motion_model,
        false=Falsehood("about_B(-alpha*t)*about_k(-gamma*t)", "about_k(-gamma*t)*about_B(-alpha*t)"),
    ),
    "text-ball-parallel": Trial(
        model=parallel_model,
        corrected_model=lambda: (parallel_model(), parallel_model(-1)),
        corrected_signs={r"\text{for}\quad m_3\gtrless-\alpha I_0": "sign*(m3 + alpha*I0) > 0"},
        false=Falsehood("(alpha + m3/I0)", "m3/I0"),
    ),
    "(30)": Trial(
        model=parallel_motion_model,
        defines=("R",),
        solves=LINEAR,
        also=(Part(line=read("(30)", SIGNS), model=along_model),),
    ),
}
