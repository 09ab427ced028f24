"""Section IV, second half, on trial: the surface of constant solutions, (50) to (57)."""

from functools import cache

import sympy

from atlas.trial.proofs import pseudo_oscillator
from atlas.trial.proofs.model import Model, Value, require, turn, vector
from atlas.trial.proofs.notation import sides
from atlas.trial.proofs.pseudo_oscillator import cubic, integrals, state_model
from atlas.trial.proofs.trial import Falsehood, Part, Trial, read

omega1, omega2, omega3 = vector("omega")
I, B2, B3 = sympy.symbols("I B2 B3", positive=True)
x, p, s = sympy.symbols("x p s", real=True)
delta = sympy.Symbol("delta", real=True)
cd, sd = sympy.symbols("cd sd", real=True)
excess = sympy.Symbol("e", positive=True)

SIGNS = pseudo_oscillator.SIGNS | {rf"\omega'_{n}": f"w{n}" for n in (1, 2, 3)}
SIGNS |= {f"C_{n}^2": f"C{n}s" for n in (1, 2, 3)} | {r"\omega_3(\omega_2)": "omega3"}
SIGNS |= {r"\omega_2\in\mathbb{R}\setminus\{-B'_2\}": "", r"\omega_1\in\mathbb{R}": ""}
SIGNS |= {r"\omega_3(\omega_1,\omega_2)": "omega3", r"\text{if}\quad\omega_2\ne-B'_2": ""}

LETTERS = {
    "omega1": omega1,
    "omega2": omega2,
    "omega3": omega3,
    "I": I,
    "B2": B2,
    "B3": B3,
    "Bp": sympy.Matrix([0, B2, B3]),
}


def at_start(u: Value) -> Value:
    """Return the cubic of (47), (48) as corrected, an expression in u = Omega3, with its integrals at t = 0.

    At t = 0 the state is Omega = (omega1, omega2, omega3) and K = B' = (0, B2, B3).
    """
    field = sympy.Matrix([0, B2, B3])
    a = cubic(integrals(sympy.Matrix([omega1, omega2, omega3]), field, I), field.dot(field), I)
    return a["a0"] + a["a1"] * u + a["a2"] * u**2 + a["a3"] * u**3


@cache
def constant_omega3() -> Value:
    """Return the root omega3 of `at_start` (omega3) = 0, an expression in omega1, omega2, I, B2, B3; cached.

    The condition is linear in omega3. The root is infinite where omega2 = -B2.
    """
    condition = sympy.Poly(sympy.expand(at_start(omega3)), omega3)
    slope, remainder = condition.all_coeffs()
    return sympy.factor(-remainder / slope)


def condition_model() -> tuple[Model, Model]:
    """Return the two models of (50), (51): all points at which Omega3 = omega3 solves the cubic (47) for all times.

    The first has omega3 of `constant_omega3`, the second the lines omega2 = -B2, omega1 = s B2, I = 1 - s^2 with any
    omega3. Raises ArithmeticError if the cubic had other zeros at omega2 = -B2.
    """
    require(sympy.expand(at_start(omega3).subs(omega2, -B2) - B3 * (omega1**2 - (1 - I) * B2**2)) == 0)
    resolved = Model({**LETTERS, "Omega3": omega3}, [(omega3, constant_omega3())])
    lines = [(omega2, -B2), (omega1, s * B2), (I, 1 - s**2)]  # where omega3 has the coefficient 0
    return resolved, Model(LETTERS, lines, domains={"s": "unit"})


def free_model() -> Model:
    """Return the model of any initial angular velocity (omega1, omega2, omega3), on the surface (50) or not.

    It serves the corrected (52), (71) and the equivalence of (50) and (51).
    """
    return Model(LETTERS)


def lost_lines_model() -> list[Model]:
    """Return two models, of sign 1 and -1, of the lines omega2 = -B2 of the quadric for I < 1, with any omega3.

    On them omega1 = sign sqrt(1 - I) B2; I is written 1 - s^2. They serve the corrected (52).
    """
    root = sympy.Symbol("s", positive=True)
    cases = []
    for sign in (1, -1):
        bindings = [(omega2, -B2), (omega1, sign * root * B2)]
        letters = {**LETTERS, "sign": sympy.Integer(sign), "I": 1 - root**2}
        cases.append(Model(letters, bindings, domains={"s": "unit"}))
    return cases


def _angles() -> list[tuple[Value, Value]]:
    """Return the bindings, pairs (symbol, value), of B3, cd = cos(delta), sd = sin(delta) and delta, in this order.

    The value of B3, from tan(beta) = B3/(I B2) with delta = beta/2 + pi/4, is in cd and sd, the others in
    p = tan(delta/2).
    """
    return [
        (B3, -I * B2 * (cd**2 - sd**2) / (2 * cd * sd)),
        (cd, turn(p)[0]),
        (sd, turn(p)[1]),
        (delta, 2 * sympy.atan(p)),
    ]


BETA = {"beta": 2 * delta - sympy.pi / 2}
PHASES = {delta: (cd, sd)}


def coordinates_model() -> Model:
    """Return the model of (53): values of the quadratic forms in which its coordinates w1, w2, w3 must agree.

    `form` is the quadratic form of (51), `length` the squared distance from -B', a2 and a3 are those of (54).
    `sense` is a function from the coordinates, a column (3, 1), to the determinant of their Jacobian.
    """
    form = omega1**2 + (omega2 + B2) ** 2 - I * B2 / B3 * (omega2 + B2) * (omega3 + B3)
    length = omega1**2 + (omega2 + B2) ** 2 + (omega3 + B3) ** 2
    sine = -(cd**2 - sd**2)
    letters = {**LETTERS, **BETA, "form": form, "length": length}
    letters |= {"a2": 2 * sine / (1 - sine), "a3": 2 * sine / (1 + sine)}
    letters["sense"] = lambda w: w.jacobian([omega1, omega2, omega3]).det()
    return Model(letters, _angles(), phases=PHASES, domains={"p": "oblique"})


@cache
def _axes() -> tuple[Value, Value]:
    """Return the unit eigenvectors (cos, sin) and (-sin, cos), (2, 1) each, of the form (51) in the plane omega1 = 0.

    Their components, along omega2 and omega3, are in the symbols cd and sd of `_angles`. Raises ArithmeticError if
    one is no eigenvector. Cached.
    """
    cotangent = I * B2 / B3
    form = sympy.Matrix([[1, -cotangent / 2], [-cotangent / 2, 0]])
    direction, normal = sympy.Matrix([cd, sd]), sympy.Matrix([-sd, cd])
    for axis in (direction, normal):
        image = form * axis
        residue = image[0] * axis[1] - image[1] * axis[0]
        for symbol, value in _angles():
            residue = residue.subs(symbol, value)
        require(sympy.cancel(residue) == 0)
    return direction, normal


def canonical_model(ratio: str = "any", plane: bool = False) -> Model:
    """Return the model of (54) to (57), (68), (69): points of the quadric in coordinates w1, w2, w3 about -B'.

    The coordinates are along the quadric's eigenvectors. ``ratio`` is "any", "one" (I = 1), "above" (I > 1) or "below"
    (I < 1); ``plane`` restricts to omega1 = 0.
    """
    direction, normal = _axes()
    shifted = sympy.Matrix([omega2 + B2, omega3 + B3])
    sine = -(cd**2 - sd**2)
    letters = {**LETTERS, **BETA, "w1": omega1, "w2": direction.dot(shifted), "w3": normal.dot(shifted)}
    letters |= {"a2": 2 * sine / (1 - sine), "a3": 2 * sine / (1 + sine)}
    scale = {"any": [], "one": [(I, sympy.Integer(1))], "above": [(I, 1 + excess)], "below": [(I, 1 / (1 + excess))]}[
        ratio
    ]
    bindings = [(omega3, constant_omega3()), *_angles(), *scale, *([(omega1, sympy.Integer(0))] if plane else [])]
    return Model(letters, bindings, phases=PHASES, domains={"p": "oblique"})


def axes_model(above: bool, sheets: int) -> Model:
    """Return the model of squared semi-axes C1s, C2s, C3s, of (55) for two ``sheets`` and of (57) for one.

    ``above`` has I > 1, otherwise I < 1; sin(beta) is any number in (0, 1).
    """
    sine = 1 / (1 + sympy.Symbol("r", positive=True))
    I = 1 + excess if above else 1 / (1 + excess)
    a2, a3, square = 2 * sine / (1 - sine), 2 * sine / (1 + sine), (I - 1 if sheets == 2 else 1 - I) * B2**2
    return Model({"I": I, "B2": B2, "a2": a2, "a3": a3, "C1s": square, "C2s": square * a2, "C3s": square * a3})


def angle_model() -> Model:
    """Return the model of text-beta: beta is the angle in I^-1 B' = r (0, cos beta, sin beta), with I = I3/I2."""
    I2, I3, r = sympy.symbols("I2 I3 r", positive=True)
    letters = {"I": I3 / I2, "B2": I2 * r * cd, "B3": I3 * r * sd, "beta": delta}
    return Model(letters, [(cd, turn(p)[0]), (sd, turn(p)[1]), (delta, 2 * sympy.atan(p))], phases=PHASES)


def range_model() -> Model:
    """Return the model of text-beta-range: beta in (0, pi/2); `at0` and `at_end` give limits at both ends."""
    beta, s = sympy.Symbol("beta", positive=True), sympy.Symbol("s", positive=True)
    letters = {"beta": beta, "at_end": lambda x: x.subs(beta, sympy.pi / 2)}
    return Model(letters, [(beta, sympy.pi / 2 * s / (1 + s))], start={beta: 0})


def _sharp(line: str) -> str:
    """Return the line "a < f < b; a = at0(f); b = at_end(f)" for a line a < f < b: its bounds are the limits of f.

    Raises ValueError for another number of sides.
    """
    lower, middle, upper = sides(line.replace("<", "="))
    return f"{line}; {lower} = at0({middle}); {upper} = at_end({middle})"


def shell_model() -> Model:
    """Return the model of text-short-cylinder: I = I3/I2 of a shell of radius r and height h, by surface integrals."""
    r, h, z, w, M = sympy.symbols("r h z w M", positive=True)
    density = M / (2 * sympy.pi * h)
    bounds = ((w, 0, 2 * sympy.pi), (z, -h / 2, h / 2))
    I2 = sympy.integrate(density * ((r * sympy.sin(w)) ** 2 + z**2), *bounds)
    I3 = sympy.integrate(density * r**2, *bounds)
    return Model({"I": sympy.cancel(I3 / I2), "r": r, "h": h})


def plane_body_model() -> Model:
    """Return the model of text-plane-body: two equal moments of mass g1, and g3 along the axis: I = 2 g1/(g1 + g3)."""
    g1, g3 = sympy.symbols("g1 g3", positive=True)
    return Model({"I": 2 * g1 / (g1 + g3), "g3": g3, "I2": g1 + g3})


def leaving_points_model() -> Model:
    """Return the model of text-not-all: points of the quadric with omega1 > 0; `rate` is dOmega3/dt at t = 0, by (38).

    Raises ArithmeticError unless that rate is omega1 B2.
    """
    away = sympy.Symbol("omega1", positive=True)
    rate = state_model().letters["at0"](state_model().letters["d"](state_model().letters["Omega3"]))
    require(sympy.expand(rate - omega1 * B2) == 0)
    return Model(
        {**LETTERS, "omega1": away, "rate": rate.subs(omega1, away)}, [(omega3, constant_omega3().subs(omega1, away))]
    )


_EQUATION_50, _EQUATION_51, _EQUATION_52 = (read(name, SIGNS) for name in ("(50)", "(51)", "(52)"))
AXES = ("C1s", "C2s", "C3s")


def turned_model() -> Model:
    """Return the model of text-turned: axes e'_1, e'_2, e'_3, rotated by delta about e1, and components of omega + B'.

    By index 1, 2, 3: `axis` are the rotated axes (3, 1), `w` the components along them.
    """
    rolled = sympy.Matrix([[1, 0, 0], [0, cd, -sd], [0, sd, cd]])
    shifted = sympy.Matrix([omega1, omega2 + B2, omega3 + B3])
    letters = {**LETTERS, **BETA, "Bp": sympy.Matrix([0, B2, B3]), "omega": sympy.Matrix([omega1, omega2, omega3])}
    letters["axis"] = {n: rolled.col(n - 1) for n in (1, 2, 3)}
    letters["w"] = {n: axis.dot(shifted) for n, axis in letters["axis"].items()}
    letters |= {f"w{n}": w for n, w in letters["w"].items()} | {f"e{n + 1}": sympy.eye(3).col(n) for n in range(3)}
    return Model(letters, _angles(), phases=PHASES, domains={"p": "oblique"})


TRIALS = {
    "(50)": Trial(model=condition_model),
    "(51)": Trial(
        model=condition_model,
        also=(Part(line=f"{sides(_EQUATION_50)[0]} = B3*({sides(_EQUATION_51)[0]} - (1 - I)*B2^2)", model=free_model),),
    ),
    "text-quadric-origin": Trial(
        model=lambda: Model({**LETTERS, **dict.fromkeys(("omega1", "omega2", "omega3"), sympy.Integer(0))}),
        signs={r"\omega_1=\omega_2=\omega_3=0\quad\text{obeys (51)}": _EQUATION_51},
        false=Falsehood(model=lambda: Model({**LETTERS, "omega1": 0 * B2, "omega2": -B2, "omega3": -B3})),
    ),
    "(52)": Trial(
        model=lambda: condition_model()[0],
        signs={r"\Omega_3": "Omega3"},
        corrected_also=(
            Part(line="omega2 = -B2; omega1 = sign*sqrt(1 - I)*B2; " + _EQUATION_50, model=lost_lines_model),
            Part(
                line=f"{sides(_EQUATION_50)[0]} = I*B2*(omega2 + B2)*({sides(_EQUATION_52)[-1]} - omega3)",
                model=free_model,
            ),
            Part(
                line="condition = B3*(omega1^2 - (1 - I)*B2^2)",
                model=lambda: Model({**LETTERS, "condition": at_start(omega3)}, [(omega2, -B2)]),
            ),
            Part(line="omega1^2 - (1 - I)*B2^2 > 0", model=lambda: Model({**LETTERS, "I": 1 + excess})),
        ),
        corrected_signs={
            r"\text{or}\quad\omega_2=-B'_2,\quad\omega_1=\pm\sqrt{1-I}\,B'_2,\quad\omega_3\in\mathbb{R}\quad"
            r"\text{if}\quad I\le1": ""
        },
    ),
    "(53)": Trial(
        model=coordinates_model,
        defines=("w1", "w2", "w3"),
        solves="w1^2 + w2^2 + w3^2 = length; w1^2 - w2^2/a2 + w3^2/a3 = form; sense([w1, w2, w3]) = 1",
    ),
    "text-turned": Trial(
        model=turned_model,
        also=(read("(53)", SIGNS),),
        signs={r"\omega'_i": "w[i]", r"\mathbf{e}'_i": "axis[i]", r"\mathbf{e}'_2": "axis[2]"},
        false=Falsehood("*e2 + sin", "*e2 - sin"),
    ),
    "text-beta": Trial(model=angle_model, false=Falsehood("B3/(I*B2)", "B3/B2")),
    "text-beta-range": Trial(model=range_model, form=_sharp, false=Falsehood("< pi/2", "< pi/3")),
    "(54)": Trial(model=canonical_model, defines=("a2", "a3")),
    "(55)": Trial(model=lambda: canonical_model("above"), defines=AXES),
    "text-two-sheets": Trial(
        model=lambda: axes_model(above=True, sheets=2), false=Falsehood(model=lambda: axes_model(above=False, sheets=2))
    ),
    "text-short-cylinder": Trial(
        model=shell_model,
        signs={r">1\iff h<\sqrt6\,r": "I - 1 = (6*r^2 - h^2)/(6*r^2 + h^2)"},
        false=Falsehood("(6*r^2 - h^2)", "(4*r^2 - h^2)"),
    ),
    "text-plane-body": Trial(
        model=plane_body_model, signs={r"I=2\iff g_3=0": "2 - I = 2*g3/I2"}, false=Falsehood("2 - I =", "1 - I =")
    ),
    "text-tangent-planes": Trial(
        model=lambda: Model({**LETTERS, "I": sympy.Integer(2)}, [(omega3, constant_omega3()), (I, sympy.Integer(2))]),
        signs={
            r"I=2:\quad\omega_3\ge0\ \text{or}\ \omega_3\le-2B'_3": (
                "(omega3 + B3)^2 - B3^2 = B3^2*(omega1^2 + omega2^2)*(omega1^2 + (omega2 + "
                "2*B2)^2)/(4*B2^2*(omega2 + B2)^2)"
            )
        },
        false=Falsehood("(omega3 + B3)^2 - B3^2", "(omega3 + B3/2)^2 - (B3/2)^2"),
    ),
    "(56)": Trial(model=lambda: canonical_model("one")),
    "text-cone-semi-axes": Trial(model=lambda: canonical_model("one")),
    "(57)": Trial(model=lambda: canonical_model("below"), defines=AXES),
    "text-one-sheet": Trial(
        model=lambda: axes_model(above=False, sheets=1), false=Falsehood(model=lambda: axes_model(above=True, sheets=1))
    ),
    "text-not-all": Trial(
        model=leaving_points_model,
        also=(_EQUATION_50,),
        signs={r"\omega_1B'_2\ne0\implies": "", r"\dot\Omega_3(0)": "rate"},
        false=Falsehood("rate != 0", "rate = 0"),
    ),
}
