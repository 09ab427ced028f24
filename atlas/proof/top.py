"""Every symmetric top in a uniform field on trial: its quartic, its steady precessions and the paper's quadric."""

from functools import cache

import sympy

from atlas.proof.model import Model, Value, cross, dot, turn, vector
from atlas.proof.trial import Falsehood, Part, Trial

I = sympy.Symbol("I", positive=True)
k2, k3, a0, A0 = sympy.symbols("k2 k3 a0 A0", real=True)
omega1, omega2, omega3 = vector("omega")
nu, r, a, A, M3, p, x, y = sympy.symbols("nu r a A M3 p x y", real=True)
J, COUPLING, E3 = sympy.diag(1, 1, I), sympy.diag(k2, k2, k3), sympy.Matrix([0, 0, 1])
KAPPA, LEADING = k2 - k3 / I, A0 + k3**2 / I - k2**2
LETTERS = {
    "I": I,
    "k2": k2,
    "k3": k3,
    "a0": a0,
    "A0": A0,
    "kappa": KAPPA,
    "A": LEADING,
    "J": J,
    "k": COUPLING,
    "e3": E3,
}
AT = {"at": lambda f, value: f.subs(nu, value), "slope": lambda f, value: f.diff(nu).subs(nu, value)}
AT |= {"bend": lambda f, value: f.diff(nu, 2).subs(nu, value), "third": lambda f, value: f.diff(nu, 3).subs(nu, value)}


def _force(b: Value) -> Value:
    """Return U'(nu)."""
    return a0 + A0 * b[2]


@cache
def state_model() -> Model:
    """Model any state M, b of the top, b a unit vector, with the rates of the equations; and the state at t = 0."""
    M, b = vector("M"), vector("b")
    Omega = J.inv() * (M - COUPLING * b)
    rates = cross(M, Omega) + cross(COUPLING * Omega - _force(b) * E3, b), cross(b, Omega)
    size = 1 + x**2 + y**2
    where = list(zip(b, (2 * x / size, 2 * y / size, (1 - x**2 - y**2) / size), strict=True))
    energy = dot(Omega, J * Omega) + 2 * a0 * b[2] + A0 * b[2] ** 2
    momentum, along = M[2], dot(M, b)
    letters = {**LETTERS, "nu": b[2], "M3": momentum, "p": along, "h": energy, "Omega3": Omega[2]}
    letters |= {"a": momentum * KAPPA + a0, "P": Omega[0] * b[0] + Omega[1] * b[1]}
    letters["g"] = energy - momentum**2 / I + 2 * k2 * along - k2**2
    return Model(letters, where, dict(zip([*M, *b], [*rates[0], *rates[1]], strict=True)))


@cache
def start_model() -> Model:
    """Model the start with b = (0, n2, n3), and what the rates of nu are there."""
    whole, (n2, n3) = state_model(), turn(x)[::-1]
    omega, direction = sympy.Matrix([omega1, omega2, omega3]), sympy.Matrix([0, *sympy.symbols("n2 n3", real=True)])
    M = J * omega + COUPLING * direction
    values = dict(zip([*vector("M"), *vector("b")], [*M, *direction], strict=True))
    letters = {**LETTERS, "nu": whole.letters["nu"], "start": lambda f: f.subs(values, simultaneous=True)}
    letters |= {"n2": direction[1], "n3": direction[2], "omega1": omega1, "omega2": omega2, "omega3": omega3}
    letters["D"] = LEADING + KAPPA**2 + a0 / direction[2]
    return Model(letters, [(direction[1], n2), (direction[2], n3)], whole.flow)


@cache
def paper_model() -> Model:
    """Model the paper's body with B' = b n: k2 = b, k3 = I b, no potential."""
    b = sympy.Symbol("b", positive=True)
    where = [(k2, b), (k3, I * b), (a0, sympy.Integer(0)), (A0, sympy.Integer(0))]
    letters = {**start_model().letters, "b": b}
    return Model(letters, [*where, *start_model().where])


@cache
def turns_model() -> Model:
    """Model b turned about the axis by an angle with cosine and sine, and Omega = psi b + chi e3 on the hyperbola."""
    base = start_model().letters
    n2, n3 = base["n2"], base["n3"]
    c, s, w = sympy.symbols("c s w", real=True)
    b = sympy.Matrix([n2 * s, n2 * c, n3])
    v = n3 * (w**2 + n2**2 * base["D"]) / (I * n2 * w)
    spun, turned = v - n3 / I * (k3 - 2 * KAPPA), w - n2 * k3 / I
    psi, chi = turned / n2, spun - n3 / n2 * turned
    letters = {**LETTERS, "b": b, "psi": psi, "chi": chi, "U": _force(b), "n2": n2, "n3": n3, "w": w, "v": v}
    letters |= {"omega2": turned, "omega3": spun, "D": base["D"]}
    where = [*start_model().where, (c, turn(y)[0]), (s, turn(y)[1])]
    return Model(letters, where, flow={s: chi * c, c: -chi * s})


@cache
def quartic_model() -> Model:
    """Model any constants of the quartic with a root at nu = r."""
    w = (p - M3 * r) / (1 - r**2)
    letters = {"nu": nu, "r": r, "a": a, "A": A, "M3": M3, "p": p, "w": w, **AT}
    return Model({**letters, "g": 2 * a * r + A * r**2 + (p - M3 * r) ** 2 / (1 - r**2)})


@cache
def precession_model() -> Model:
    """Model a steady precession with the rate w at nu = r."""
    w = sympy.Symbol("w", real=True)
    momentum = (r * w**2 + a + A * r) / w
    letters = {"nu": nu, "r": r, "a": a, "A": A, "w": w, "M3": momentum, "p": w * (1 - r**2) + r * momentum, **AT}
    return Model({**letters, "g": 2 * a * r + A * r**2 + w**2 * (1 - r**2)})


@cache
def marginal_model() -> Model:
    """Model a steady precession whose nutation has no frequency, c = (a + A r)/w."""
    base = dict(precession_model().letters)
    w = base["w"]
    c = sympy.Symbol("c", real=True)
    leading = (c * w - a) / r
    force = sympy.solve(w**2 + leading * (1 - 3 * r**2) - 2 * a * r + c**2, a)[0]
    return Model({**base, "c": c}, [(A, leading), (a, force)])


@cache
def sleeping_model() -> tuple[Model, ...]:
    """Model the state at rest at nu = sigma, and the border of its stability, M3 = 2 m, A = m^2 - sigma a."""
    models = []
    for sigma in (1, -1):
        letters = {"nu": nu, "a": a, "A": A, "M3": M3, "p": sigma * M3, "sigma": sympy.Integer(sigma)}
        models.append(Model({**letters, "g": 2 * sigma * a + A}))
    return tuple(models)


@cache
def border_model() -> tuple[Model, ...]:
    """Model the border of stability, A = M3^2/4 - sigma a."""
    return tuple(Model(model.letters, [(A, M3**2 / 4 - model.letters["sigma"] * a)]) for model in sleeping_model())


_q = "(1 - nu^2)*(g - 2*a*nu - A*nu^2) - (p - M3*nu)^2"
_W, _V = "w = omega2 + n2*k3/I", "v = omega3 + n3/I*(k3 - 2*kappa)"
_CURVE = "v = n3*(w^2 + n2^2*D)/(I*n2*w)"

TRIALS = (
    Trial(
        name="theorem-every-top",
        tried=f"d(nu)^2 = {_q}; P/(1 - nu^2) + k2 = (p - M3*nu)/(1 - nu^2);"
        " Omega3 - nu*P/(1 - nu^2) = M3/I - nu*(p - M3*nu)/(1 - nu^2) + kappa*nu; d(M3) = 0; d(p) = 0; d(h) = 0",
        model=state_model,
        follows=r"the equations at any state, $g = 2h - M_3^2/I + 2 k_2 p - k_2^2$ with the kinetic energy and $U$ in "
        "$h$, and the rates of @theorem-angles",
        false=Falsehood(
            "The coupling adds nothing to the linear term: $a = a_0$",
            "2*a*nu",
            "2*a0*nu",
        ),
    ),
    Trial(
        name="theorem-top-precession",
        tried=f"q = {_q}; at(q,r) = 0; slope(q,r) = -2*(1 - r^2)*(r*w^2 - M3*w + a + A*r);"
        " g - 2*a*r - A*r^2 = w^2*(1 - r^2)",
        model=quartic_model,
        follows=r"@theorem-every-top: $q(\nu_0) = 0$ is the last equation with $w = (p - M_3 \nu_0)/(1 - \nu_0^2)$, "
        r"and $q'(\nu_0)$ is then a multiple of the first",
        defines=("q",),
        false=Falsehood(
            "The two rates are those of the heavy top",
            "a + A*r)",
            "a)",
        ),
    ),
    Trial(
        name="theorem-top-nutation",
        tried=f"q = {_q}; at(q,r) = 0; slope(q,r) = 0; -1/2*bend(q,r) = w^2 + A*(1 - 3*r^2) - 2*a*r + (a + A*r)^2/w^2",
        model=precession_model,
        follows=r"@theorem-top-precession: $M_3 w = \nu_0 w^2 + a + A \nu_0$",
        defines=("q",),
        also=(
            Part(line=f"q = {_q}; bend(q,r) = 0; third(q,r) = 12*(a + 2*A*r)", model=marginal_model, defines=("q",)),
        ),
        note=r"Where $a = -2 A \nu_0$ too the root is fourfold, $q = A (\nu - \nu_0)^4$, and the sign of $A$ decides.",
        false=Falsehood(
            "The linear term makes no nutation faster or slower",
            "- 2*a*r",
            "- 0*a*r",
        ),
    ),
    Trial(
        name="theorem-sleeping-top",
        tried=f"{_q} = (1 - sigma*nu)^2*((1 + sigma*nu)*(2*sigma*a + A*(1 + sigma*nu)) - M3^2)",
        model=sleeping_model,
        follows=r"@theorem-every-top with $p = \sigma M_3$ and the energy of the spin",
        also=(Part(line=f"{_q} = -(1 - sigma*nu)^3*(2*sigma*a + A*(3 + sigma*nu))", model=border_model),),
        false=Falsehood(
            "The spin steadies the top as strongly at every angle",
            "(1 + sigma*nu)*(2*sigma*a",
            "2*(2*sigma*a",
        ),
    ),
    Trial(
        name="theorem-top-quadric",
        tried=f"{_W}; {_V}; D = A + kappa^2 + a0/n3 = k3/I*(k3*(1 + 1/I) - 2*k2) + A0 + a0/n3",
        model=start_model,
        follows=r"@theorem-every-top: the rates of $\nu$ by the equations, at $t = 0$; the quadratic form is that of "
        r"@(51) with $\mathbf{n}$ in the place of $\mathbf{B}'$",
        defines=("w", "v"),
        solves="start(d(nu)) = -n2*omega1; start(d2(nu)) = -n3*(omega1^2 + w^2 - I*n2/n3*w*v + n2^2*D)",
        also=(
            Part(
                line="n2*k3/I = b*n2; n3/I*(k3 - 2*kappa) = b*n3; D = (I - 1)*b^2",
                model=paper_model,
            ),
        ),
        false=Falsehood(
            "The kind is the sign of $A$ and of the weight alone",
            "D = A + kappa^2 + a0/n3",
            "D = A + a0/n3",
        ),
    ),
    Trial(
        name="theorem-top-hyperbola",
        tried=f"{_W}; v = omega3 + n3/I*(k3 - 2*kappa); {_CURVE}; psi = omega2/n2;"
        " chi = omega3 - n3/n2*omega2; Omega = psi*b + chi*e3; d(b) = cross(b,Omega);"
        " J*d(Omega) + k*d(b) = cross(J*Omega + k*b,Omega) + cross(k*Omega - U*e3,b)",
        model=turns_model,
        follows=r"the equations by substitution, at any phase of the turn about the axis",
        defines=("Omega",),
        false=Falsehood(
            "The paper's hyperbola is that of every top: the constant is $A$",
            "n3*(w^2 + n2^2*D)",
            "n3*(w^2 + n2^2*A)",
        ),
    ),
)
