"""The appendix on trial: a point particle in constant fields, (89) to (104)."""

from collections.abc import Callable
from dataclasses import replace

import sympy

from atlas.trial.proofs.model import Model, Value, cross, dot, partial, turn, vector
from atlas.trial.proofs.trial import Falsehood, Trial, evaluated

SIGNS = {
    r"\mathbf{B}": "Bf",
    r"\dot{\mathbf{y}}": "dy",
    r"\dot{\mathbf{O}}": "drift",
    **{
        rf"{letter}_{{\{mark}}}": plain
        for mark, index in (("bot", "perp"), ("Vert", "par"))
        for letter, plain in (
            (r"\mathbf{C}", f"C{index}"),
            (r"\mathbf{E}", f"E{index}"),
            (r"\mathbf{y}", f"y{index}"),
            (r"\dot{\mathbf{y}}", f"dy{index}"),
        )
    },
    r"\ddot{\mathbf{y}}_{\Vert}": "d2(ypar)",
    r"\mathbf{y}_{\Vert 0}": "ypar0",
}
_LAGRANGIAN = {r"\dot{\mathbf{y}}": "v", r"\ddot{\mathbf{y}}": "ddy"}

E, B, y, v = vector("E"), vector("B"), vector("y"), vector("v")
m, c, b, E2 = sympy.symbols("m c b E2", positive=True)
e, mu, t, a, omega, omega0 = sympy.symbols("e mu t a omega omega0", real=True)
cw, sw, c0, s0, p, q = sympy.symbols("cw sw c0 s0 p q", real=True)
strength = sympy.Symbol("strength", positive=True)

E3 = sympy.Symbol("E3", real=True)
ALONG_Z, PARALLEL, ACROSS = sympy.Matrix([0, 0, b]), sympy.Matrix([0, 0, E3]), sympy.Matrix([0, E2, 0])
e1, e2 = sympy.Matrix([1, 0, 0]), sympy.Matrix([0, 1, 0])


def euler(lagrangian: Value) -> Value:
    """Return the acceleration (3, 1) by a Lagrangian of place y and velocity v: d/dt dL/dv = dL/dy, solved.

    ``lagrangian`` is an expression in the symbols of y and v.
    """
    momentum = partial(lagrangian, v)
    force = partial(lagrangian, y) - momentum.jacobian(y) * v
    return (momentum.jacobian(v).inv() * force).applyfunc(sympy.cancel)


def lagrangian_model() -> Model:
    """Return the model of the Lagrangian (104) with the potentials (102): K, U, and the acceleration ddy by variation.

    K is the kinetic, U the potential energy. `force`, `grad`, `curl` and `acceleration` are functions of
    expressions in y and v. It serves (89) and (102) to (104).
    """
    A0, A = dot(y, E), cross(B, y) / 2
    L = m * dot(v, v) / 2 + e * A0 + e / c * dot(A, v)
    letters = {"m": m, "e": e, "c": c, "E": E, "Bf": B, "y": y, "v": v, "A0": A0, "A": A, "ddy": euler(L), "mu": e / m}
    letters |= {f"B{n + 1}": B[n] for n in range(3)}
    letters |= {"K": m * dot(v, v) / 2, "U": -(e * A0 + e / c * dot(A, v)), "acceleration": euler}
    letters["force"] = lambda U: -partial(U, y) + partial(U, v).jacobian(y) * v
    letters["grad"] = lambda scalar: partial(scalar, y)
    letters["curl"] = lambda field: sympy.Matrix(
        [
            field[2].diff(y[1]) - field[1].diff(y[2]),
            field[0].diff(y[2]) - field[2].diff(y[0]),
            field[1].diff(y[0]) - field[0].diff(y[1]),
        ]
    )
    return Model(letters)


def potentials_model() -> Model:
    """Return the model of text-potentials: (102) with any share of E taken from A0 into an A that changes in time."""
    base, share = lagrangian_model().letters, sympy.Symbol("share", real=True)
    letters = {**base, "A0": (1 - share) * base["A0"], "A": base["A"] - share * c * t * E}
    return Model({**letters, "partial_t": lambda field: field.diff(t)})


def velocity_model() -> Model:
    """Return the model of (90): a particle at y in fields E and B (letter Bf), and a constant vector C.

    The rate of y is a vector of symbols; the line defines the velocity dy.
    """
    C = vector("C")
    letters = {"mu": mu, "c": c, "E": E, "Bf": B, "C": C, "t": t, "y": y, "dy": v}
    flow = {t: sympy.Integer(1), **dict(zip(y, v, strict=True))}
    return Model(letters, flow=flow, start={t: sympy.Integer(0)})


def fall_model() -> Model:
    """Return the model of text-no-magnetic-field: constants y0, C (3, 1), E and mu; the line defines y."""
    C, y0 = vector("C"), vector("yo")
    letters = {"mu": mu, "E": E, "C": C, "t": t, "y0": y0}
    return Model(letters, flow={t: sympy.Integer(1)}, start={t: sympy.Integer(0)})


def _split() -> dict[str, Value]:
    C, place = vector("C"), vector("y")
    flat = sympy.diag(1, 1, 0)
    up = sympy.diag(0, 0, 1)
    rate = mu * (ACROSS + PARALLEL) * t + mu / c * cross(place, ALONG_Z) + C
    components = {"Cpar": up * C, "Cperp": flat * C, "ypar": up * place, "yperp": flat * place, "y": place}
    components |= {"dypar": up * rate, "dyperp": flat * rate, "Epar": PARALLEL, "Eperp": ACROSS, "Bf": ALONG_Z}
    components |= {"E": PARALLEL + ACROSS, "E3": E3}
    components["ypar0"] = sympy.Matrix([0, 0, sympy.Symbol("z0", real=True)])
    return {**components, "mu": mu, "c": c, "t": t, "b": b, "E2": E2}


def split_model() -> Model:
    """Return the model of (90) in parts along and across B = (0, 0, b), E in the plane (e2, e3), mu of any sign.

    It serves (91), (92), (94). Letters end in `par` or `perp`: Cpar, ypar, dypar, Epar and so on, (3, 1) each.
    """
    components = _split()
    flow = dict(zip(components["y"], components["dypar"] + components["dyperp"], strict=True))
    start = {t: sympy.Integer(0), components["y"][2]: components["ypar0"][2]}
    return Model(components, flow={t: sympy.Integer(1), **flow}, start=start, domains={"mu": "real"})


def parallel_model() -> Model:
    """Return the model of (93): all letters of `split_model` but ypar, which the printed line of (93) itself defines.

    That line has the constants ypar0, Cpar, Epar and mu, and the time t, the only symbol that moves.
    """
    letters = _split()
    del letters["ypar"]
    return Model(letters, flow={t: sympy.Integer(1)}, start={t: sympy.Integer(0)})


def fall_along_model() -> Model:
    """Return the model of text-parallel-acceleration: the part ypar along B by (93), as a function of t."""
    components = _split()
    ypar = components["ypar0"] + components["Cpar"] * t + mu * PARALLEL * t**2 / 2
    return Model({**components, "ypar": ypar}, flow={t: sympy.Integer(1)})


def helix_model() -> Model:
    """Return the model of text-helix, E = 0: y2, the part across B from its centre, and ypar, of velocity C3."""
    place, rise = vector("y"), sympy.Symbol("C3", real=True)
    speed_across = sympy.diag(1, 1, 0) * place
    flow = dict(zip(place, mu / c * cross(speed_across, ALONG_Z) + sympy.Matrix([0, 0, rise]), strict=True))
    return Model({"y2": speed_across, "ypar": sympy.diag(0, 0, 1) * place, "mu": mu, "b": b, "c": c}, flow=flow)


def along_field_model() -> list[Model]:
    """Return two models with B = 0, mu > 0 and mu < 0, of y by text-no-magnetic-field, with E along e3.

    They serve text-along-field.
    """
    C, y0, field = vector("C"), vector("yo"), sympy.Matrix([0, 0, sympy.Symbol("E0", positive=True)])
    cases = []
    for mu in (strength, -strength):
        letters = {"mu": mu, "E": field, "y": y0 + C * t + mu * field * t**2 / 2}
        cases.append(Model(letters, flow={t: sympy.Integer(1)}))
    return cases


def shifted_model() -> Model:
    """Return the model of (95), (96): the shifted variables y1, y2 of the part across B, with their rates by (92)."""
    components = _split()
    drift = c * cross(ACROSS, ALONG_Z) / b**2
    second = (c * cross(components["Cperp"], ALONG_Z) + c**2 * ACROSS) / (mu * b**2)
    y1 = components["yperp"]
    rate1 = mu / c * cross(y1 + drift * t, ALONG_Z) + components["Cperp"] + mu * ACROSS * t - drift
    y2 = sympy.diag(1, 1, 0) * vector("z")
    rate2 = rate1.xreplace(dict(zip(components["y"], y2 + second, strict=True)))
    flow = dict(zip([*y1[:2], *y2[:2]], [*rate1[:2], *rate2[:2]], strict=True))
    letters = {name: value for name, value in components.items() if name not in {"y", "yperp"}}
    return Model({**letters, "y1": y1, "y2": y2}, flow=flow)


def charges_model(choice: str = "any") -> list[Model]:
    """Return two models, mu > 0 and mu < 0, with B along e3 and E_perp along e2; omega t and omega0 are phases.

    omega is |mu| b/c in both. ``choice`` sets the constant C_perp: "any" vector across B, or the vector in the text for
    (99), "origin", or for (100), "trochoid". O = (mu E2/omega) t e1 and P are parts of the solution (98).
    """
    cases = []
    for sign in (1, -1):
        angles = [(cw, turn(p)[0]), (sw, turn(p)[1]), (c0, turn(q)[0]), (s0, turn(q)[1])]
        flow = {t: sympy.Integer(1), cw: -omega * sw, sw: omega * cw}
        letters = {**_split(), "a": a, "omega": omega, "omega0": omega0, "mu": sign * strength, "e1": e1, "e2": e2}
        del letters["yperp"], letters["y"]
        drift = c * cross(ACROSS, ALONG_Z) / b**2
        chosen = {"any": letters["Cperp"], "origin": drift, "trochoid": drift - sign * strength * E2 / omega * e1}
        letters["Cperp"] = chosen[choice]
        letters |= {"O": sign * strength * E2 / omega * t * e1, "P": a * (e1 * sw + e2 * cw)}
        bindings = [(omega, strength * b / c), *angles]
        start = {t: sympy.Integer(0), cw: sympy.Integer(1), sw: sympy.Integer(0)}
        phases = {omega * t: (cw, sw), omega0: (c0, s0)}
        cases.append(Model(letters, bindings, flow, start, phases))
    return cases


def drift_model() -> list[Model]:
    """Return two models, mu > 0 and mu < 0, of the constant velocity `drift` across B for which (89) gives no force."""
    cases = []
    for case in charges_model():
        remainder = sympy.symbols("rest1:3", real=True)
        velocity = sympy.Matrix([*remainder, 0])
        rate = case.letters["mu"] * (case.letters["Eperp"] + cross(velocity, case.letters["Bf"]) / case.letters["c"])
        solved = sympy.solve(list(rate[:2]), remainder, dict=True)[0]
        letters = {**case.letters, "drift": velocity.subs(solved)}
        cases.append(Model(letters, case.bindings))
    return cases


def signed_model(choice: str = "any") -> list[Model]:
    """Return the two models of `charges_model` with omega = mu b/c, of the sign of mu, as the corrections have it.

    ``choice`` as there.
    """
    model, second = charges_model(choice)
    return [model, replace(second, bindings=[(omega, -strength * b / c), *second.bindings[1:]])]


def _general(model: Model, **letters: Value) -> Value:
    """Return the right side (3, 1) of (98) at the model's letters; ``letters`` replace some of them by name."""
    return evaluated("(98)", SIGNS, {**model.letters, **letters})


def start_model() -> list[Model]:
    """Return two models of text-initial-position: yperp by the corrected (98) with omega0 = 0.

    C_perp is chosen so that the first term of (98) vanishes.
    """
    return [
        replace(model, letters={**model.letters, "yperp": _general(model, omega0=sympy.Integer(0))})
        for model in signed_model("origin")
    ]


_TURNING = "at0(d({})[2]) = -omega*a*sin(omega0)"
_SOLVES = "d(yperp) = mu/c*cross(yperp,Bf) + Cperp + mu*Eperp*t"


def trajectory_model(*, signed: bool = True) -> list[Model]:
    """Return two models, mu > 0 and mu < 0, of ypar of (93) and yperp of (99), for (101) and text-ball-centre.

    omega has the sign of mu if ``signed``; otherwise it is positive as in (97), and the models are those of t = 0.
    """
    cases = []
    for model in signed_model("origin") if signed else charges_model("origin"):
        letters = dict(model.letters)
        letters |= {"ypar": evaluated("(93)", SIGNS, letters), "yperp": evaluated("(99)", SIGNS, letters)}
        bindings = model.bindings if signed else [*model.bindings, (p, sympy.Integer(0)), (t, sympy.Integer(0))]
        cases.append(replace(model, letters=letters, bindings=bindings))
    return cases


def later_model() -> list[Model]:
    """Return two models of text-time-shift: `place` is the corrected (98) as a function of time, C_perp and omega0."""

    def place(model: Model) -> Callable[..., Value]:
        return lambda time, constant, angle: _general(model, t=time, Cperp=constant, omega0=angle)

    return [replace(model, letters={**model.letters, "place": place(model)}) for model in signed_model()]


def rolling_model() -> list[Model]:
    """Return two models of text-trochoid: x, y of the corrected (100), a point at distance a from a circle's centre.

    The circle, of radius r, rolls along e1.
    """
    cases = []
    for model in signed_model("trochoid"):
        mu_ = model.letters["mu"]
        place = {"x": mu_ * E2 / omega * t + a * sw, "y": mu_ * E2 / omega**2 + a * cw}
        letters = {**model.letters, **place, "r": mu_ * E2 / omega**2}
        cases.append(Model(letters, model.bindings, phases=model.phases))
    return cases


TRAJECTORY = "d2(y) = mu*E + mu/c*cross(d(y),Bf)"
"""Equation for the place of a charged particle, (89)."""

TRIALS = {
    "(89)": Trial(signs=_LAGRANGIAN, model=lagrangian_model),
    "(90)": Trial(
        model=velocity_model, defines=("dy",), solves="d(dy) = mu*E + mu/c*cross(dy,Bf); at0(dy) - mu/c*cross(y,Bf) = C"
    ),
    "text-no-magnetic-field": Trial(
        model=fall_model,
        defines=("y",),
        solves="d2(y) = mu*E; at0(y) = y0; at0(d(y)) = C",
        false=Falsehood("1/2*mu*E*t^2", "mu*E*t^2"),
    ),
    "text-along-field": Trial(
        solves="d2(y) = mu*E", corrected_solves="", signs={r"\ddot{\mathbf{y}}": "d2(y)"}, model=along_field_model
    ),
    "text-helix": Trial(
        also=("d2(y2) = -(mu*b/c)^2*y2",), model=helix_model, false=Falsehood("-(mu*b/c)^2*y2", "-(mu*b/(2*c))^2*y2")
    ),
    "(91)": Trial(model=split_model),
    "(92)": Trial(model=split_model),
    "(93)": Trial(model=parallel_model, defines=("ypar",), solves="d(ypar) = Cpar + mu*Epar*t; at0(ypar) = ypar0"),
    "text-parallel-acceleration": Trial(solves="d2(ypar) = mu*Epar", model=fall_along_model),
    "text-double-product": Trial(
        model=lambda: Model({"Eperp": cross(B, vector("w")), "Bf": B}),
        false=Falsehood(model=lambda: Model({"Eperp": vector("w"), "Bf": B})),
    ),
    "(94)": Trial(model=split_model),
    "(95)": Trial(model=shifted_model),
    "(96)": Trial(model=shifted_model),
    "(97)": Trial(
        model=charges_model, defines=("y2", "omega"), solves="d(y2) = -mu/c*cross(Bf,y2); " + _TURNING.format("y2")
    ),
    "text-drift-direction": Trial(model=charges_model, false=Falsehood("norm(Bf)*e1", "norm(Bf)*e2")),
    "(98)": Trial(
        model=charges_model,
        defines=("yperp",),
        solves=f"{_SOLVES}; {_TURNING.format('yperp')}",
        corrected_model=signed_model,
    ),
    "text-time-shift": Trial(
        signs={r"\mathbf{y}_{\bot}": "place()", r"\mathbf{C}'_{\bot}": "Clater"},
        defines=("Clater",),
        model=later_model,
        false=Falsehood("Cperp - mu*Eperp*(omega0/omega)", "Cperp"),
    ),
    "text-first-two-terms": Trial(arrows={1: None}, defines=("Cperp",), model=lambda: signed_model("origin")),
    "text-initial-position": Trial(model=start_model, false=Falsehood("a*e2", "a*e1")),
    "(99)": Trial(
        model=lambda: charges_model("origin"),
        defines=("yperp",),
        solves=f"{_SOLVES}; at0(yperp) = a*e2",
        corrected_model=lambda: signed_model("origin"),
    ),
    "text-drift": Trial(model=drift_model),
    "text-trochoid-constant": Trial(model=lambda: signed_model("trochoid")),
    "(100)": Trial(
        model=lambda: charges_model("trochoid"),
        defines=("x", "y"),
        solves="d(x) = mu/c*b*y + dot(Cperp,e1); d(y) = -mu/c*b*x + mu*E2*t",
        corrected_model=lambda: signed_model("trochoid"),
    ),
    "text-trochoid": Trial(model=rolling_model, false=Falsehood("y = r + a*cos", "y = a*cos")),
    "(101)": Trial(
        model=lambda: trajectory_model(signed=False),
        defines=("y",),
        solves=TRAJECTORY,
        corrected_model=trajectory_model,
    ),
    "(102)": Trial(signs={r"\mathbf{A}(\mathbf{y})": "A", r"A_0(\mathbf{y})": "A0"}, model=lagrangian_model),
    "text-potentials": Trial(
        signs={
            r"\frac{\partial\mathbf{A}}{\partial t}": "partial_t(A)",
            r"\nabla A_0": "grad(A0)",
            r"[\nabla,\mathbf{A}]": "curl(A)",
        },
        model=potentials_model,
        false=Falsehood("+ grad(A0)", "- grad(A0)"),
    ),
    "(103)": Trial(signs=_LAGRANGIAN, model=lagrangian_model, solves="force(U) = e*E + e/c*cross(v,Bf)"),
    "(104)": Trial(
        signs=_LAGRANGIAN, model=lagrangian_model, defines=("L",), solves="m*acceleration(L) = e*E + e/c*cross(v,Bf)"
    ),
}
