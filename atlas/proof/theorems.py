"""What the atlas adds to the paper, on trial in the same way."""

from functools import cache

import sympy

from atlas.proof import ball, elementary, euler_poisson
from atlas.proof.model import Model, Value, cross, turn
from atlas.proof.particle import drift_model
from atlas.proof.pseudo_oscillator import cubic, integrals, state_model
from atlas.proof.quadric import B2, B3, LETTERS, I, at_start, constant_omega3, lines_case, omega1, omega2, omega3
from atlas.proof.trial import Falsehood, Part, Trial

tau, x = sympy.symbols("tau x", real=True)
r, z, excess, T2 = sympy.symbols("r z e T2", positive=True)
ROOTS = 1 / (1 + r), sympy.Integer(0)  # of 1 - 8 tau^2: any between 0 and 1, and 0


@cache
def quartic_model() -> Model:
    """Any state of the symmetric body; b^2 = K^2, and u a letter of its own in Q and in the cubic p."""
    whole = state_model()
    u = sympy.Symbol("u", real=True)
    names = ("E", "c3", "c5", "I")
    fixed = {name: sympy.Symbol(f"{name}_0", real=True) for name in names} | {
        "Bsquare": sympy.Symbol("b2_0", positive=True)
    }
    a = cubic({name: fixed[name] for name in ("E", "c3", "c5")}, fixed["Bsquare"], fixed["I"])
    letters = {**fixed, "u": u, "p": a["a0"] + a["a1"] * u + a["a2"] * u**2 + a["a3"] * u**3}
    letters |= {"udot": whole.letters["d"](whole.letters["Omega3"])}
    letters["slope"] = lambda Q: Q.diff(u)
    letters["leading"] = lambda Q: sympy.Poly(Q, u).coeff_monomial(u**4)
    state = {fixed[name]: whole.letters[name] for name in names} | {
        fixed["Bsquare"]: whole.letters["Bsquare"],
        u: whole.letters["Omega3"],
    }
    letters["here"] = lambda Q: Q.xreplace(state)
    return Model(letters)


def _slope(spin: Value, scale: Value) -> Value:
    """Return p'(omega3), p the cubic of the motion with these initial data in the field (0, B2, B3)."""
    u = sympy.Symbol("u", real=True)
    field = sympy.Matrix([0, B2, B3])
    a = cubic(integrals(spin, field, scale), field.dot(field), scale)
    return (a["a1"] + 2 * a["a2"] * u + 3 * a["a3"] * u**2).subs(u, spin[2])


@cache
def stability_model() -> Model:
    """Model the slope of the cubic on the hyperbola, in tau = B3/B2 and x = (omega2 + B2)/B2; kappa = k + b = x b."""
    where = [(omega3, constant_omega3().subs(omega1, 0)), (omega2, (x - 1) * B2), (B3, tau * B2)]
    square = B2**2 * (1 + tau**2)
    letters = {"minus_slope": -_slope(sympy.Matrix([0, omega2, omega3]), I), "tau": tau, "x": x, "X": x * B2}
    letters |= {"kappa2": x**2 * square, "b2": square, "hB3s": tau**2 / (1 + tau**2)}
    return Model({**LETTERS, **letters}, where)


@cache
def short_model() -> Model:
    """Model 1 <= I <= 2, any real X but 0."""
    X, more = sympy.Symbol("X", real=True, nonzero=True), sympy.Symbol("more", nonnegative=True)
    return Model({"X": X, "I": 1 + more, "B2": B2}, domains={"more": "unit"})


@cache
def _slope_in_squares() -> Value:
    """Return -p'(omega3) on the hyperbola as a function of z = x^2 and t2 = tau^2 alone."""
    model = stability_model()
    value = model.letters["minus_slope"]
    for symbol, meaning in model.where:
        value = value.subs(symbol, meaning)
    return sympy.cancel(sympy.cancel(value).subs({x: sympy.sqrt(z), tau: sympy.sqrt(T2)}))


def _band(t2: Value, **letters: Value) -> Model:
    """I < 1 and a given tau^2; z = x^2 is any positive number."""
    scale = 1 / (1 + excess)
    slope = _slope_in_squares().subs({T2: t2, I: scale})
    return Model({"minus_slope": slope, "I": scale, "z": z, "t2": t2, "B2": B2, **letters})


@cache
def band_model() -> tuple[Model, Model]:
    """8 tau^2 = 1 - root^2 with 0 < root < 1, and with root = 0."""
    first, second = (_band((1 - root**2) / 8, root=root) for root in ROOTS)
    return first, second


@cache
def places_model(where: str) -> tuple[Model, ...]:
    """Model x^2 within the band, or outside, below and above it."""
    share, cases = sympy.Symbol("share", positive=True), []
    for root in ROOTS:
        t2, long = (1 - root**2) / 8, 1 - 1 / (1 + excess)
        low, high = (long * (1 - 2 * t2 + side * root) / (2 * (1 + t2)) for side in (-1, 1))
        places = [(low + share * high) / (1 + share)] if where == "within" else [low / (1 + share), high + share]
        slopes = [_slope_in_squares().subs({T2: t2, I: 1 - long, z: place}) for place in places]
        cases += [Model({f"minus_slope_{where}": slope}) for slope in slopes]
    return tuple(cases)


@cache
def above_model() -> Model:
    """8 tau^2 = 1 + gain."""
    return _band((1 + r) / 8, gain=r)


@cache
def signs_model() -> Model:
    """Model I < 1 and a positive gain."""
    return Model({"I": 1 / (1 + excess), "gain": r})


@cache
def root_model() -> tuple[Model, Model, Model]:
    """Q at omega3 + v, and p'(omega3), for every elementary motion: of the hyperbola, and of the lines omega2 = -B2.

    These are I = 1 with any omega3, and B3 = 0 with any I and omega3.
    """
    v, zero = sympy.Symbol("v", real=True), sympy.Integer(0)
    spin, field = sympy.Matrix([0, omega2, omega3]), sympy.Matrix([0, B2, B3])
    letters = {**LETTERS, **integrals(spin, field, I), "Bsquare": field.dot(field), "v": v, "slope": _slope(spin, I)}
    lines = [
        [(omega3, constant_omega3().subs(omega1, 0))],
        [(omega2, -B2), (I, sympy.Integer(1))],
        [(omega2, -B2), (B3, zero)],
    ]
    first, second, third = (Model(letters, where) for where in lines)
    return first, second, third


@cache
def leaving_model() -> Model:
    """Model I < 1 and time."""
    t = sympy.Symbol("t", real=True)
    return Model({"I": 1 / (1 + excess), "B3": B3, "t": t}, flow={t: sympy.Integer(1)}, start={t: sympy.Integer(0)})


@cache
def between_model() -> Model:
    """Model I < 1 and v between 0 and 4 B3."""
    return Model({"I": 1 / (1 + excess), "B3": B3, "v": 4 * B3 / (1 + r)})


@cache
def equatorial_model(line: str) -> Model:
    """B3 = 0: the line omega2 = -B2 with any omega3, or omega3 = 0 with any omega2."""
    spin = sympy.Matrix([0, *((-B2, omega3) if line == "upright" else (omega2, 0))])
    return Model({**LETTERS, "minus_slope": -_slope(spin, I), "X": omega2 + B2}, [(B3, sympy.Integer(0))])


@cache
def ball_nutation_model() -> Model:
    """I = 1 and any initial angular velocity."""
    one = sympy.Integer(1)
    slope = _slope(sympy.Matrix([omega1, omega2, omega3]), one)
    return Model({**LETTERS, "minus_slope": -slope, "I": one})


@cache
def cubic_model() -> Model:
    """Model the cubic of (47), its constants those at the start, at Omega3 = omega3."""
    return Model({**LETTERS, "p": at_start(omega3)})


@cache
def torque_model() -> Model:
    """(17) for any symmetric mass matrix and any Omega."""
    whole = euler_poisson.magnetic_model()
    R, tensor, mass = (whole.letters[name] for name in ("R", "I", "g"))
    spin, field = euler_poisson.Omega, euler_poisson.Bf
    torque = -euler_poisson.mu / euler_poisson.c * cross(R * mass * R.T * field, R * spin)
    return Model({**whole.letters, "m": R * tensor * spin, "dm": torque}, whole.where)


@cache
def lines_model() -> Model:
    """Model the points omega2 = -B2, omega1^2 = (1 - I) B2^2."""
    return Model(LETTERS, lines_case(), domains={"s": "unit"})


@cache
def turning_model(case: str) -> Model:
    """R = R_B(k t) R_z(phi t) and Omega = (w sin, w cos, omega3) with the constants of each extra line."""
    e = elementary
    whole = e.matrix_model()
    spin = e.SPIN.xreplace({omega2: -e.B2})
    where = [*e.ANGLES, *e.FIELD, (e.k, -e.b)]
    where += (
        [(e.phi, omega3 + e.B3), (I, sympy.Integer(1))]
        if case == "ball"
        else [(e.phi, omega3), (e.u, sympy.Integer(1))]
    )
    letters = {
        **e.CONSTANTS,
        "Omega": spin,
        "P": whole.letters["P"],
        "Q": whole.letters["Q"],
        "b": e.b,
        "J": e.TENSOR,
        "g": e.MASS,
    }
    letters["Bp"] = sympy.Matrix([0, e.B2, e.B3])
    return Model(letters, where, e.FLOW, e.START, e.PHASES, e.DOMAINS)


@cache
def rest_model() -> Model:
    """Model A ball with m = (0, 0, -alpha I0)."""
    b = ball
    letters = {"alpha": b.alpha, "t": b.t, "I0": b.I0, "m": sympy.Matrix([0, 0, -b.alpha * b.I0])}
    return Model(letters, b.ANGLES[:2], b.LARMOR, b.START, {b.alpha * b.t: (b.ca, b.sa)})


@cache
def angles_model() -> Model:
    """Model R = R_z(psi) R_x(theta) R_z(chi) with any rates of the angles; B = b e3, Omega from R^T dR/dt."""
    b = sympy.Symbol("b", positive=True)
    names = sympy.symbols("psi theta chi", real=True)
    rates = psi1, _, chi1 = sympy.symbols("psi1 theta1 chi1", real=True)
    halves = {name: sympy.symbols(f"c_{name} s_{name}", real=True) for name in names}
    tangents = sympy.symbols("p1:4", real=True)
    flow: dict[Value, Value] = {}
    where: list[tuple[Value, Value]] = []
    for name, rate, tangent in zip(names, rates, tangents, strict=True):
        cosine, sine = halves[name]
        flow |= {cosine: -rate / 2 * sine, sine: rate / 2 * cosine}
        where += [(cosine, turn(tangent)[0]), (sine, turn(tangent)[1])]
    whole = {name: (c**2 - s**2, 2 * c * s) for name, (c, s) in halves.items()}

    def about_z(c: Value, s: Value) -> Value:
        return sympy.Matrix([[c, -s, 0], [s, c, 0], [0, 0, 1]])

    c, s = whole[names[1]]
    R = about_z(*whole[names[0]]) * sympy.Matrix([[1, 0, 0], [0, c, -s], [0, s, c]]) * about_z(*whole[names[2]])
    model = Model({}, where, flow)
    W = R.T * R.applyfunc(model.rate)
    spin = sympy.Matrix([W[2, 1], W[0, 2], W[1, 0]])
    K = b * R.row(2).T
    letters = {"P": spin[0] * K[0] + spin[1] * K[1], "b": b, "u": spin[2], "nu": K[2] / b, "psi1": psi1, "chi1": chi1}
    letters |= {"ca": halves[names[1]][0], "sb": halves[names[1]][1], "R": R}
    return Model(letters, where, flow)


_Q = "(E - I*u^2)*(Bsquare - (c3 - u)^2) - (u^2 - (2 - I)*c3*u + c5)^2"
_CONDITION = "B3*(omega1^2 + omega2^2) - I*B2*omega2*omega3 + (2 - I)*B2*B3*omega2 - I*B2^2*omega3"
_YM, _YP = (f"(1 - I)*(1 - 2*t2 {sign} root)/(2*(1 + t2))" for sign in "-+")
_POISSON = "d(R[i,j]) = -eps[j,a,b]*Omega[a]*R[i,b]; at0(R) = one"
_MOTION = f"{_POISSON}; J*d(Omega) = cross(J*Omega,Omega) - 2*cross(g*T(R)*Bp,Omega)"

TRIALS = (
    Trial(
        name="theorem-quartic",
        tried=f"Q = {_Q}",
        model=quartic_model,
        follows="@(38) to @(41), for any state",
        defines=("Q",),
        solves="here(Q) = udot^2; slope(Q) = 2*p; leading(Q) = I - 1",
        false=Falsehood(
            "The quartic is that of the ball for every body",
            "E - I*u^2",
            "E - u^2",
        ),
    ),
    Trial(
        name="theorem-points",
        tried=f"at0(d(Omega3)) = omega1*B2; at0(d2(Omega3)) = {_CONDITION}",
        model=state_model,
        follows=r"@(38) and @(39) at $t = 0$, and the cubic at $\omega_3$",
        also=(
            Part(line=f"p = {_CONDITION}", model=cubic_model),
            Part(line="d(d2(Omega3)) = (a1 + 2*a2*Omega3 + 3*a3*Omega3^2)*d(Omega3)", model=state_model),
        ),
        note=r"A constant $\Omega_3$ has both rates zero. Conversely, the two rates obey linear equations along every "
        r"motion: that of the first is the second, that of the second the first times the slope of the cubic @(47). "
        "So if both are zero at the start, they stay zero. With $B'_2 > 0$ these points are the hyperbola @(67) and, "
        "for $I = 1$, the line of @theorem-ball-line.",
        false=Falsehood(
            r"$\Omega_3$ starts with the rate $\omega_1 B'_3$",
            "at0(d(Omega3)) = omega1*B2",
            "at0(d(Omega3)) = omega1*B3",
        ),
    ),
    Trial(
        name="theorem-stability",
        tried="minus_slope = B2^2*((1 + tau^2)*x^4 + (1 - I)*(2*tau^2 - 1)*x^2 + tau^2*(1 - I)^2)/x^2"
        " = kappa2 + (1 - I)*b2*(3*hB3s - 1) + (1 - I)^2*b2^2*hB3s/kappa2",
        model=stability_model,
        follows="@(48) as corrected, on the hyperbola @(71)",
        note=r"$\Omega_3 = \omega_3 + \varepsilon$ obeys $\ddot\varepsilon = -\nu_n^2 \varepsilon$ to first order. By "
        "@theorem-quartic the second derivative of $Q$ is twice the slope of the cubic @(47).",
        false=Falsehood(
            "The square of the nutation frequency is a sum of positive terms for every $I < 1$",
            "(2*tau^2 - 1)",
            "(2*tau^2 + 1)",
        ),
    ),
    Trial(
        name="theorem-root",
        tried="(E - I*(omega3 + v)^2)*(Bsquare - (c3 - omega3 - v)^2)"
        " - ((omega3 + v)^2 - (2 - I)*c3*(omega3 + v) + c5)^2 = v^2*(slope + (1 - I)*v*(4*B3 - v))",
        model=root_model,
        follows=r"@theorem-quartic at $\omega_3 + v$, for every elementary motion",
        note=r"Where $\nu_n^2 > 0$ there is no other real $v$ near 0 with $Q \ge 0$: the motion is stable. Where "
        r"$\nu_n^2 < 0$ it is not. Where $\nu_n = 0$ the sign of the next term decides.",
        false=Falsehood(
            "At an end of the band the motion leaves by $2B'_3$",
            "(4*B3 - v)",
            "(2*B3 - v)",
        ),
    ),
    Trial(
        name="theorem-stable-short",
        tried="minus_slope - (I - 1)*B2^2 = X^2 + S^2; S = tau*(X^2 - (I - 1)*B2^2)/X",
        model=stability_model,
        follows=r"@theorem-stability, $X = \omega_2 + B'_2$",
        defines=("S",),
        also=(Part(line="X^2 > 0; (I - 1)*B2^2 >= 0", model=short_model),),
        false=Falsehood(
            "The bound holds from above",
            "= X^2 + S^2",
            "= X^2 - S^2",
        ),
    ),
    Trial(
        name="theorem-band",
        tried=f"minus_slope = B2^2*(1 + t2)*(z - ym)*(z - yp)/z; ym = {_YM}; yp = {_YP}; 8*t2 = 1 - root^2",
        model=band_model,
        follows=r"@theorem-stability with $z = x^2$, $t_2 = \tau^2 = (1 - \text{root}^2)/8$ and $0\le\text{root}<1$",
        defines=("ym", "yp"),
        solves="ym > 0; yp >= ym",
        also=(
            Part(line="minus_slope_within <= 0", model=lambda: places_model("within")),
            Part(line="minus_slope_outside > 0", model=lambda: places_model("outside")),
            Part(
                line="minus_slope = B2^2*(S^2 + (1 - I)^2*gain)/(4*(1 + t2)*z); S = 2*(1 + t2)*z + (1 - I)*(2*t2 - 1);"
                " 8*t2 = 1 + gain",
                model=above_model,
                defines=("S",),
            ),
            Part(line="1 - I > 0; gain > 0", model=signs_model),
        ),
        note=r"Positive below and above the two roots, not positive between them and at them; for $8 \tau^2 > 1$ "
        "positive everywhere. Inside the band the motion is unstable by @theorem-root, at its ends by "
        "@theorem-band-ends.",
        false=Falsehood(
            "Inside the band the motions are stable",
            "minus_slope_within <= 0",
            "minus_slope_within > 0",
        ),
    ),
    Trial(
        name="theorem-band-ends",
        tried="v = 4*B3/(1 + 4*(1 - I)*B3^2*t^2)",
        model=leaving_model,
        follows=r"@theorem-root with $\nu_n = 0$: $\omega_3$ is a triple root of $Q$",
        defines=("v",),
        solves="d(v)^2 = (1 - I)*v^3*(4*B3 - v); d2(v) = (1 - I)*v^2*(6*B3 - 2*v); at0(v) = 4*B3",
        also=(Part(line="(1 - I)*v^3*(4*B3 - v) > 0", model=between_model),),
        note="This motion has the constants of the elementary one, comes as near to it as one likes for $t$ to minus "
        r"infinity, and yet leaves it by $4 B'_3$. At the ends $E' - I \omega_3^2 = \omega_2^2 > 0$, so that "
        r"@(42) brings $\mathbf{K}$ near as well.",
        false=Falsehood(
            "It leaves to infinity in a finite time",
            "(1 + 4*(1 - I)",
            "(1 - 4*(1 - I)",
        ),
    ),
    Trial(
        name="theorem-equatorial-stability",
        tried="minus_slope = I^2*omega3^2 - (1 - I)*B2^2",
        model=lambda: equatorial_model("upright"),
        follows=r"@(48) as corrected, with $B'_3 = 0$ and $\omega_2 = -B'_2$, any $\omega_3$",
        also=(Part(line="minus_slope = X^2 - (1 - I)*B2^2", model=lambda: equatorial_model("level")),),
        note=r"With $B'_3 = 0$ the root of $Q$ that @theorem-root has where $\nu_n = 0$ is fourfold, and for "
        "$I < 1$ the quartic $Q$ is negative beside it: there the ends belong to the stable motions.",
        false=Falsehood(
            r"With $\omega_2 = -B'_2$ every spin is stable",
            "I^2*omega3^2 - (1 - I)*B2^2",
            "I^2*omega3^2 + (1 - I)*B2^2",
        ),
    ),
    Trial(
        name="theorem-ball-nutation",
        tried="minus_slope = omega1^2 + (omega2 + B2)^2 + (omega3 + B3)^2",
        model=ball_nutation_model,
        follows="@(48) as corrected, with $I = 1$",
        note=r"So every motion of the ball is stable but the one with $\boldsymbol{\omega} = -\mathbf{B}'$. There the "
        r"ball rests in Larmor's frame, and pushed by $\delta$ it turns in that frame with the angular velocity "
        r"$\delta$, however small.",
        false=Falsehood(
            "The ball nutates with its angular velocity in the laboratory",
            "omega1^2 + (omega2 + B2)^2 + (omega3 + B3)^2",
            "omega1^2 + omega2^2 + omega3^2",
        ),
    ),
    Trial(
        name="theorem-ball-line",
        tried="k = -b; phi = omega3 + B3; R = P*Q",
        model=lambda: turning_model("ball"),
        follows=r"@(12) and @(16) by substitution, $\omega_2 = -B_2$, $I = 1$, any $\omega_3$",
        defines=("R",),
        solves=_MOTION,
        false=Falsehood(
            r"The proper rotation is the spin $\omega_3$",
            "phi = omega3 + B3",
            "phi = omega3",
        ),
    ),
    Trial(
        name="theorem-equatorial-field",
        tried="k = -B2/hB2; phi = omega3; R = P*Q",
        model=lambda: turning_model("equator"),
        follows=r"@(12) and @(16) by substitution, $B_3 = 0$, $\omega_2 = -B_2$, any $I$ and $\omega_3$",
        defines=("R",),
        solves=_MOTION,
        false=Falsehood(
            "The proper rotation is counted from Larmor's frame",
            "phi = omega3",
            "phi = omega3 + B2",
        ),
    ),
    Trial(
        name="theorem-quadric-lines",
        tried="B3*(omega1^2 + omega2^2) - I*B2*omega2*omega3 + (2 - I)*B2*B3*omega2 - I*B2^2*omega3 = 0;"
        " omega1^2 = (1 - I)*B2^2; omega2 = -B2",
        model=lines_model,
        follows=r"@(50) by substitution, any $\omega_3$",
        false=Falsehood(
            r"The lines lie in the plane $\omega_1 = 0$",
            "omega1^2 = (1 - I)*B2^2",
            "omega1 = 0",
        ),
    ),
    Trial(
        name="theorem-momentum",
        tried="dm = k*cross(hat_B,m)",
        model=elementary.matrix_model,
        follows=r"@(17) with $R$ of @(84) and $\boldsymbol{\Omega}$ of @(73)",
        false=Falsehood(
            "The angular momentum precesses against the axis",
            "k*cross(hat_B,m)",
            "k*cross(m,hat_B)",
        ),
    ),
    Trial(
        name="theorem-moment",
        tried="dm = mu/(2*c)*(cross(m,Bf) - R*(hat(Omega)*I - I*hat(Omega))*T(R)*Bf)",
        model=torque_model,
        follows="@(17) and @(12), any inertia tensor; the bracket is $R$ times the rate of $R I R^T$ times $R^T$",
        false=Falsehood(
            "The equation of the magnetic moment holds for every body",
            " - R*(hat(Omega)*I - I*hat(Omega))*T(R)*Bf",
            "",
        ),
    ),
    Trial(
        name="theorem-drift",
        tried="drift = c*cross(Eperp,Bf)/b^2",
        model=drift_model,
        follows="@(89) solved for the velocity that does not change, for either sign of the charge",
        note=r"The rest of the velocity turns about $\mathbf{B}$ by @(96) and is zero in the mean.",
        false=Falsehood(
            "A negative charge drifts the other way",
            "c*cross(Eperp,Bf)/b^2",
            "mu/abs(mu)*c*cross(Eperp,Bf)/b^2",
        ),
    ),
    Trial(
        name="theorem-ball-rest",
        tried="R = [[cos(alpha*t), sin(alpha*t), 0], [-sin(alpha*t), cos(alpha*t), 0], [0, 0, 1]]",
        model=rest_model,
        follows=r"@(24) by substitution with $\mathbf{m} = (0, 0, -\alpha I_0)$",
        defines=("R",),
        solves="d(R[i,j]) = 1/I0*eps[i,a,b]*m[a]*R[b,j]; at0(R) = one",
        false=Falsehood(
            r"The ball turns by $+\alpha t$",
            "sin(alpha*t), 0], [-sin(alpha*t)",
            "-sin(alpha*t), 0], [sin(alpha*t)",
        ),
    ),
    Trial(
        name="theorem-angles",
        tried="psi1 = P/b/(1 - nu^2); chi1 = u - nu*psi1",
        model=angles_model,
        follows=r"$R = R_z(\psi) R_x(\theta) R_z(\chi)$ with any rates",
        false=Falsehood(
            "The proper rotation is the component of the angular velocity along the axis",
            "chi1 = u - nu*psi1",
            "chi1 = u",
        ),
    ),
    Trial(
        name="theorem-cayley-klein",
        tried="d(ca)/ca = 1/2*d(nu)/(1 + nu); 1/2*(psi1 + chi1) = 1/2*(P/b/(1 + nu) + u);"
        " d(sb)/sb = -1/2*d(nu)/(1 - nu); 1/2*(psi1 - chi1) = 1/2*(P/b/(1 - nu) - u)",
        model=angles_model,
        follows=r"$\xi = \cos (\theta/2) \exp (i (\psi + \chi)/2)$, $\eta = \sin (\theta/2) \exp (i (\psi - "
        r"\chi)/2)$: moduli and arguments",
        false=Falsehood(
            "The spin enters both arguments with the same sign",
            "1/2*(psi1 - chi1) = 1/2*(P/b/(1 - nu) - u)",
            "1/2*(psi1 - chi1) = 1/2*(P/b/(1 - nu) + u)",
        ),
    ),
)
