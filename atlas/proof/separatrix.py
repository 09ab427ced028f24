"""Steady precessions, their stability and the second elementary family on trial: a quartic with a double root."""

from functools import cache

import sympy

from atlas.proof.general import top_model
from atlas.proof.model import Model, Value
from atlas.proof.trial import Falsehood, Trial

b, z = sympy.symbols("b z", positive=True)
nu, r, e, A, w, M3, c3, p, c, g, s, t = sympy.symbols("nu r e A w M3 c3 p c g s t", real=True)
T = sympy.Symbol("T", real=True)
AT = {"at": lambda f, value: f.subs(nu, value), "slope": lambda f, value: f.diff(nu).subs(nu, value)}
AT |= {"bend": lambda f, value: f.diff(nu, 2).subs(nu, value)}


@cache
def steady_model() -> Model:
    """Model any constants of the quartic q and a value r of nu; G is h - M3^2/I - b^2."""
    letters = {"nu": nu, "r": r, "A": A, "M3": M3, "p": p, "w": (p - M3 * r) / (1 - r**2), **AT}
    return Model({**letters, "G": A * r**2 + (p - M3 * r) ** 2 / (1 - r**2)})


@cache
def precession_model() -> Model:
    """Model a steady precession with the rate w at nu = r; and the point of the hyperbola (71) that has both."""
    I, B2, B3, omega2, q1 = sympy.symbols("I B2 B3 omega2 q1", real=True)
    hat = (2 * q1 / (1 + q1**2), (1 - q1**2) / (1 + q1**2))
    letters = {"nu": nu, "r": r, "A": A, "w": w, "M3": r * (w**2 + A) / w, "I": I, "b": b, **AT}
    letters["p"] = w * (1 - r**2) + r * letters["M3"]
    letters["G"] = A * r**2 + w**2 * (1 - r**2)
    omega3 = B3 * omega2 * (omega2 + (2 - I) * B2) / (I * B2 * (omega2 + B2))
    letters |= {"momentum": I * (omega3 + B3), "k": omega2 / hat[0], "hB3": hat[1]}
    where = [(B2, b * hat[0]), (B3, b * hat[1])]
    return Model(letters, where)


@cache
def range_model() -> Model:
    """Model a steady precession with A = -w^2/z."""
    letters = {"nu": nu, "r": r, "w": w, "z": z, "A": -(w**2) / z}
    letters["M3"] = r * (w**2 + letters["A"]) / w
    letters["p"] = w * (1 - r**2) + r * letters["M3"]
    letters["G"] = letters["A"] * r**2 + w**2 * (1 - r**2)
    return Model(letters)


@cache
def family_model() -> Model:
    """Model the family by g = tan(gamma), s = tan(delta), w, b: all its constants are rational in them.

    T is S/C of theorem-companion: tanh(sqrt(c) t/2)/sqrt(c), or tan, or t/2, so that dT = (1 - c T^2)/2.
    """
    turning, sine = (1 - s**2) / (1 + s**2), 2 * s / (1 + s**2)
    double, leading = -(turning + g * sine) / (1 + g**2), -(w**2) * (1 + g**2)
    I = 1 + leading / b**2
    momentum = double * (w**2 + leading) / w
    letters: dict[str, Value] = {"nu": nu, "g": g, "s": s, "w": w, "b": b, "T": T, "r": r, "e": e, "A": A, "c": c}
    letters |= {"M3": M3, "p": p, "c3": c3, "G": A * r**2 + w**2 * (1 - r**2), "I": I, **AT}
    letters["x"] = turning + g * sine  # cos(2 delta - gamma)/cos(gamma)
    where = [(e, turning), (r, double), (A, leading), (M3, momentum), (p, w * (1 - double**2) + double * momentum)]
    where += [(c3, momentum / I), (c, leading * (double - turning) * (3 * double + turning))]
    return Model(letters, where, flow={T: (1 - c * T**2) / 2})


@cache
def double_model() -> Model:
    """Model any quartic with a double root at nu = r and a root at nu = e = r + y."""
    y = sympy.Symbol("y", real=True)
    letters = {"nu": nu, "r": r, "e": r + y, "A": A, "c": c, "T": T, "d1": -(c + A * y**2) / y, **AT}
    return Model(letters, flow={T: (1 - c * T**2) / 2})


@cache
def triple_model() -> Model:
    """Model a quartic with a triple root at r, so that e = -3r, and a = (1-I) b^2."""
    return Model({"r": r, "t": t, "a": -A}, flow={t: sympy.Integer(1)})


@cache
def axis_model() -> Model:
    """Model any state near the spin along the field, in the letters of the top; n = K/b."""
    whole = top_model()
    letters = dict(whole.letters)
    M, K = whole.letters["M"] / whole.letters["I2"], whole.letters["K"]
    letters |= {"M1": M[0], "M2": M[1], "n1": K[0] / letters["b"], "n2": K[1] / letters["b"]}
    letters["A"] = (letters["I"] - 1) * letters["b"] ** 2
    letters["start"] = lambda f: f.subs({K[0]: 0, K[1]: 0, K[2]: letters["b"]})
    return Model(letters, whole.where, whole.flow)


@cache
def escape_model() -> tuple[Model, ...]:
    """Model the motion that leaves the axis: A = a^2, M3 of either sign, s = tan(delta), T as in `family_model`."""
    a = sympy.Symbol("a", positive=True)
    turning = (1 - s**2) / (1 + s**2)
    letters = {"nu": nu, "A": a**2, "a": a, "s": s, "T": T, "e": e, "c": c, "M3": M3, "p": M3, "c3": c3, **AT}
    letters |= {"G": a**2, "D": M3**2 - 4 * a**2}
    models = []
    for sign in (1, -1):
        momentum = sign * a * (1 + turning)
        where = [(e, turning), (M3, momentum), (c, 4 * a**2 - momentum**2)]
        models.append(Model({**letters, "abs3": sign * M3}, where, flow={T: (1 - c * T**2) / 2}))
    return tuple(models)


@cache
def pushed_model() -> Model:
    """Model x = tan(theta/2)^2 for the state Omega = (s1, 0, omega3), K = (0, 0, b) and what follows from it."""
    x, s1 = sympy.symbols("x s1", real=True)
    flow = {x: sympy.Symbol("dx", real=True)}
    letters = {"x": x, "s1": s1, "A": A, "M3": M3, "p": M3, "G": s1**2 + A, "nu": (1 - x) / (1 + x), "dx": flow[x]}
    return Model(letters, flow=flow)


@cache
def pendulum_model() -> Model:
    """Model nu = -tanh(a t), a^2 = A, with T for the tanh."""
    a = sympy.Symbol("a", positive=True)
    letters = {"T": T, "A": a**2, "G": a**2, "M3": sympy.Integer(0), "p": sympy.Integer(0)}
    return Model(letters, flow={T: a * (1 - T**2)})


_q = "(1 - nu^2)*(G - A*nu^2) - (p - M3*nu)^2"
_qx = "(1 - x^2)*(G - A*x^2) - (p - M3*x)^2"
_SPINOR = (
    "L = w*(e - r); ar = 1; ai = -L*(1 + g*s)*T; br = s; bi = L*(s - g)*T;"
    " N1 = ar^2 + ai^2; N2 = br^2 + bi^2; x = (N1 - N2)/(N1 + N2)"
)
_TURNED = (
    f"d(x)^2 = {_qx};"
    " (ar*d(ai) - ai*d(ar))/N1 + 1/2*(c3 - M3 + (p + M3)/(1 + r)) = 1/2*(c3 + (p - M3*x)/(1 + x));"
    " (br*d(bi) - bi*d(br))/N2 + 1/2*(M3 - c3 + (p - M3)/(1 - r)) = 1/2*((p - M3*x)/(1 - x) - c3)"
)

TRIALS = (
    Trial(
        name="theorem-steady",
        tried=f"q = {_q}; at(q,r) = 0; slope(q,r) = 2*(1 - r^2)*(M3*w - r*(w^2 + A)); G - A*r^2 = w^2*(1 - r^2)",
        model=steady_model,
        follows=r"@theorem-top: $q(\nu_0) = 0$ is the last equation with $w = (p - M_3 \nu_0)/(1 - \nu_0^2)$, and "
        "$q'$ then has the factor",
        defines=("q",),
        note=r"With $|\nu_0| < 1$ the slope vanishes exactly if $M_3 w = \nu_0 (w^2 + A)$. See @theorem-nutation for "
        r"$k$ and $\hat{B}_3$.",
        false=Falsehood(
            "The condition is that of the free top",
            "r*(w^2 + A)",
            "r*w^2",
        ),
    ),
    Trial(
        name="theorem-nutation",
        tried=f"q = {_q}; at(q,r) = 0; slope(q,r) = 0; -1/2*bend(q,r) = w^2 - A*(3*r^2 - 1) + A^2*r^2/w^2;"
        " w^2 - A*(3*r^2 - 1) + A^2*r^2/w^2 = (w - A*r/w)^2 + A*(1 - r)*(1 + 3*r)"
        " = (w + A*r/w)^2 + A*(1 + r)*(1 - 3*r); momentum*(k + b) = hB3*((k + b)^2 + (I - 1)*b^2)",
        model=precession_model,
        follows="@theorem-steady; the last relation is @(71) in these letters, so that $w = k + b$ "
        r"and $\nu_0 = \hat{B}_3$",
        defines=("q",),
        note=r"For $I > 1$ take the upper sign with $|\nu_0|$: the bound $A (1 - \nu_0)(1 + 3\nu_0)$ is met at "
        r"$w^2 = A |\nu_0|$. For $I < 1$ take the sign that makes the last term $-|A|(1 + |\nu_0|)(1 - 3 |\nu_0|)$: "
        r"stable if $|\nu_0| > 1/3$.",
        false=Falsehood(
            "The term linear in $A$ has one sign, whatever the inclination",
            "A*(3*r^2 - 1)",
            "A*(3*r^2 + 1)",
        ),
    ),
    Trial(
        name="theorem-companion-range",
        tried=f"{_q} = A*(nu - r)^2*((nu + r)^2 - (1 - z)*(z - r^2)/z); z = -w^2/A",
        model=range_model,
        follows="@theorem-steady with $A = -w^2/z$, $z = w^2/((1-I) b^2)$",
        false=Falsehood(
            "The other roots are real for every $z < 1$",
            "(z - r^2)/z",
            "(z + r^2)/z",
        ),
    ),
    Trial(
        name="theorem-companion-roots",
        tried="(1 + g^2)*r = -x; M3 = w*g^2/(1 + g^2)*x; -A = w^2*(1 + g^2); c = A*(r - e)*(3*r + e);"
        f" {_q} = A*(nu - r)^2*(nu - e)*(nu + 2*r + e)",
        model=family_model,
        follows=r"@theorem-companion-range with $z = 1/(1 + g^2)$, $g = \tan\kappa$, $x = \cos (2 \delta - "
        r"\kappa)/\cos\kappa$",
        note=r"In @theorem-companion-range $(e + \nu_0)^2 = (1-z)(z-\nu_0^2)/z$ is $(e + \nu_0/z)^2 z = (1-z)(1-e^2)$, "
        "met by any two angles.",
        false=Falsehood(
            r"The exponent vanishes where $e = 3\nu_0$",
            "(3*r + e)",
            "(3*r - e)",
        ),
    ),
    Trial(
        name="theorem-companion",
        tried=_SPINOR,
        model=family_model,
        follows="@theorem-top and @theorem-cayley-klein by substitution, $T = S/C$",
        defines=("L", "ar", "ai", "br", "bi", "N1", "N2", "x"),
        solves=_TURNED,
        note=r"$x$ is $\nu=(|\xi|^2-|\eta|^2)/(|\xi|^2+|\eta|^2)$. Both turn in the laboratory by $-b t/2$ more. The "
        "formula holds for $c$ of either sign and 0; $c > 0$ is the separatrix of an unstable elementary motion.",
        false=Falsehood(
            "Both vectors are turned by the same angle",
            "bi = L*(s - g)*T",
            "bi = L*(s + g)*T",
        ),
    ),
    Trial(
        name="theorem-companion-nutation",
        tried="S2 = T^2/(1 - c*T^2);"
        " x = r + (e - r)*(1 - c*T^2)/(1 - A*(e - r)^2*T^2) = r + (e - r)/(1 + (c - A*(e - r)^2)*S2)",
        model=double_model,
        follows="$T' = (1 - c T^2)/2$, $T = S/C$, $S_2 = S^2$",
        defines=("S2", "x"),
        solves="d(x)^2 = (x - r)^2*(c + d1*(x - r) + A*(x - r)^2); c + d1*(e - r) + A*(e - r)^2 = 0",
        false=Falsehood(
            "The nutation does not depend on the strength of the potential",
            "(c - A*(e - r)^2)*S2",
            "c*S2",
        ),
    ),
    Trial(
        name="theorem-companion-triple",
        tried="x = r - 4*r/(1 + 4*a*r^2*t^2)",
        model=triple_model,
        follows=r"@theorem-companion-nutation with $c = 0$, $e = -3\nu_0$",
        defines=("x",),
        solves="d(x)^2 = -a*(x - r)^3*(x + 3*r)",
        false=Falsehood(
            "It reaches half as far",
            "4*r/(1 + 4*a",
            "2*r/(1 + 4*a",
        ),
    ),
    Trial(
        name="theorem-axis-stable",
        tried="D = M3^2 - 4*A; M1^2 + M2^2 - A*(1 - nu^2) - M3*(p - M3)"
        " = (M1 - 1/2*M3*n1)^2 + (M2 - 1/2*M3*n2)^2 + 1/4*D*(1 - nu^2) + 1/2*M3^2*(1 - nu)^2;"
        " d(M1^2 + M2^2 - A*(1 - nu^2)) = 0; d(p) = 0; start(D) = I^2*(Omega3 + b)^2 + 4*(1 - I)*b^2",
        model=axis_model,
        follows=r"@theorem-top; $p - M_3 = M_1 n_1 + M_2 n_2 - M_3 (1 - \nu)$",
        defines=("D",),
        note=r"Every term is positive away from $\nu = 1$, $M_1 = M_2 = 0$, so a small push stays small for all times.",
        false=Falsehood(
            "The spin is stable whatever the sign of $D$: its coefficient is $M_3^2$",
            "1/4*D*(1 - nu^2)",
            "1/4*M3^2*(1 - nu^2)",
        ),
    ),
    Trial(
        name="theorem-axis-escape",
        tried="e = abs3/a - 1; c = -D; ai = M3*(1 - e)/(1 + e)*T; N1 = 1 + ai^2;"
        " N2 = s^2*(1 - c*T^2); x = (N1 - N2)/(N1 + N2)",
        model=escape_model,
        follows="@theorem-top and @theorem-cayley-klein by substitution, $p = M_3$, $T = S/C$",
        defines=("ai", "N1", "N2", "x"),
        solves=f"d(x)^2 = {_qx}; {_q} = (1 - nu)^2*(A*(1 + nu)^2 - M3^2);"
        " d(ai)/N1 + 1/2*c3 = 1/2*(c3 + (p - M3*x)/(1 + x)); (p - M3*x)/(1 - x) = M3",
        note=r"As $t$ grows $1 - x$ tends to 0 as $\exp (-\sqrt{c} t)$: so the motion starts as near to the axis as "
        "one likes, and leaves it.",
        false=Falsehood(
            r"It turns where $\nu = 1 - |M_3|/(b\sqrt{I-1})$",
            "e = abs3/a - 1",
            "e = 1 - abs3/a",
        ),
    ),
    Trial(
        name="theorem-axis-pushed",
        tried="d(nu)^2 = 4*dx^2/(1 + x)^4;"
        " (1 - nu^2)*(G - A*nu^2) - (p - M3*nu)^2 = 4*x*(s1^2*(1 + x)^2 + x*(4*A - M3^2*(1 + x)^2))/(1 + x)^4",
        model=pushed_model,
        follows="@theorem-top with $p = M_3$ and $2 H - M_3^2/I - b^2 = s_1^2 + A$ at $t = 0$",
        false=Falsehood(
            "The momentum along the axis keeps it from tipping at every angle alike",
            "M3^2*(1 + x)^2",
            "M3^2",
        ),
    ),
    Trial(
        name="theorem-axis-pendulum",
        tried="x = -T",
        model=pendulum_model,
        follows=r"@theorem-top by substitution, $T = \tanh(\sqrt{A} t)$",
        defines=("x",),
        solves=f"d(x)^2 = {_qx}",
        false=Falsehood(
            "It comes back to the end from which it started",
            "x = -T",
            "x = T^2",
        ),
    ),
)
