"""The general motion of the symmetric body on trial: the top of Larmor's frame, and its sigma functions."""

from functools import cache

import sympy

from atlas.proof.clebsch import symmetric_model
from atlas.proof.model import Model, Value, dot
from atlas.proof.trial import Falsehood, Trial

I, b = sympy.symbols("I b", positive=True)
nu, c3, h, p, M3, e, A, g, u = sympy.symbols("nu c3 h p M3 e A g u", real=True)
P, P1 = sympy.symbols("P P1", real=True)
QUARTIC = (1 - nu**2) * (g - A * nu**2) - (p - M3 * nu) ** 2
"""The quartic of the top, with A = (I - 1) b^2 and g = h - M3^2/I - b^2."""


@cache
def top_model() -> Model:
    """Model any state of the symmetric body in units of I2, K = b times a unit vector in stereographic coordinates."""
    whole = symmetric_model()
    x, y = sympy.symbols("x y", real=True)
    K = sympy.Matrix([whole.letters[f"K{n}"] for n in (1, 2, 3)])
    size = 1 + x**2 + y**2
    where = list(zip(K, (2 * b * x / size, 2 * b * y / size, b * (1 - x**2 - y**2) / size), strict=True))
    I2, M, H = (whole.letters[name] for name in ("I2", "M", "H"))
    letters = {**whole.letters, "b": b, "nu": K[2] / b, "M3": M[2] / I2, "p": dot(M, K) / (I2 * b), "h": 2 * H / I2}
    letters |= {"u": whole.letters["Omega3"], "P": whole.letters["Omega1"] * K[0] + whole.letters["Omega2"] * K[1]}
    return Model(letters, where, whole.flow)


@cache
def letters_model() -> Model:
    """Model the constants of the top as free letters, and u, with E' and c5 for them."""
    letters = {"I": I, "b": b, "c3": c3, "h": h, "p": p, "u": u, "M3": I * c3, "nu": (c3 - u) / b}
    return Model({**letters, "E": h - 2 * b * p, "c5": b * p - b**2 + (1 - I) * c3**2, "Bsquare": b**2})


@cache
def weierstrass_model() -> Model:
    """Model any quartic with a root e, and P, P1 for the function of Weierstrass and its rate, P1^2 = 4P^3-g2 P-g3."""
    a = sympy.symbols("a0:4", real=True)
    last = -(a[0] * e**4 + 4 * a[1] * e**3 + 6 * a[2] * e**2 + 4 * a[3] * e)
    letters = {f"a{n}": value for n, value in enumerate((*a, last))} | {"e": e, "u": u, "P": P, "P1": P1}
    letters |= {"slope": lambda Q: Q.diff(u).subs(u, e), "bend": lambda Q: Q.diff(u, 2).subs(u, e)}
    letters["at"] = lambda Q, value: Q.subs(u, value)
    return Model(letters, flow={P: P1})


@cache
def curve_model(s: int = 1) -> Model:
    """Model nu on its curve: dnu^2 = q(nu), so that the second rate of nu is q'/2; w is dnu."""
    w = sympy.Symbol("w", real=True)
    letters = {"nu": nu, "w": w, "A": A, "g": g, "p": p, "M3": M3, "c3": c3, "s": sympy.Integer(s)}
    letters |= {"at": lambda f, value: f.subs(nu, value)}
    root = sympy.sympify((w**2 + (p - M3 * nu) ** 2) / (1 - nu**2) + A * nu**2)
    return Model(letters, [(g, root)], flow={nu: w, w: QUARTIC.diff(nu) / 2})


@cache
def sigma_model() -> Model:
    """Model q with a root e, so that g is known; P and P1 as in `weierstrass_model`, nu by theorem-weierstrass."""
    root = A * e**2 + (p - M3 * e) ** 2 / (1 - e**2)
    q = QUARTIC.subs(g, root)
    letters: dict[str, Value] = {"nu": nu, "A": A, "g": root, "p": p, "M3": M3, "c3": c3, "e": e, "P": P, "P1": P1}
    letters |= {"slope": sympy.factor(q.diff(nu).subs(nu, e)), "bend": sympy.factor(q.diff(nu, 2).subs(nu, e))}
    a = [sympy.Poly(q, nu).coeff_monomial(nu**n) / sympy.binomial(4, n) for n in (4, 3, 2, 1, 0)]
    letters["g2"] = a[0] * a[4] - 4 * a[1] * a[3] + 3 * a[2] ** 2
    letters["g3"] = sympy.Matrix([[a[0], a[1], a[2]], [a[1], a[2], a[3]], [a[2], a[3], a[4]]]).det(method="berkowitz")
    return Model(letters, flow={P: P1})


_q = "(1 - nu^2)*(h - M3^2/I - b^2 - (I - 1)*b^2*nu^2) - (p - M3*nu)^2"
_Q = "(E - I*u^2)*(Bsquare - (c3 - u)^2) - (u^2 - (2 - I)*c3*u + c5)^2"


_SIGMA = (
    "x = e + slope/4/(P - bend/24); Z = bend/24 - slope/4/(1 + e); Y = -(p + M3)*slope/4/(1 + e)^2;"
    " -Y^2 = 4*Z^3 - g2*Z - g3; 1/2*d(x)/(1 + x) = 1/2*P1/(P - Z) - 1/2*P1/(P - bend/24);"
    " lam = 1/2*(c3 - M3 + (p + M3)/(1 + e)); 1/2*((p - M3*x)/(1 + x) + c3) = lam + 1/2*Y/(P - Z)"
)

TRIALS = (
    Trial(
        name="theorem-top",
        tried=f"d(nu)^2 = {_q}; P/b/(1 - nu^2) + b = (p - M3*nu)/(1 - nu^2);"
        " u - nu*P/b/(1 - nu^2) = c3 - nu*(p - M3*nu)/(1 - nu^2); d(M3) = 0; d(p) = 0; d(h) = 0; M3 = I*c3",
        model=top_model,
        follows="@(34) and @(35) at any state, and the rates of @theorem-angles",
        false=Falsehood(
            "The potential is linear, as that of the heavy top",
            "(I - 1)*b^2*nu^2",
            "(I - 1)*b^2*nu",
        ),
    ),
    Trial(
        name="theorem-top-quartic",
        tried=f"{_Q} = b^2*({_q})",
        model=letters_model,
        follows=r"$E'$ and $c_5$ by @theorem-clebsch-symmetric, for all $u$, $\nu = (c_3 - u)/b$",
        false=Falsehood(
            "The two quartics are equal",
            "= b^2*(",
            "= (",
        ),
    ),
    Trial(
        name="theorem-weierstrass",
        tried="Q = a0*u^4 + 4*a1*u^3 + 6*a2*u^2 + 4*a3*u + a4; x = e + slope(Q)/4/(P - bend(Q)/24);"
        " g2 = a0*a4 - 4*a1*a3 + 3*a2^2; g3 = a0*a2*a4 + 2*a1*a2*a3 - a2^3 - a0*a3^2 - a1^2*a4",
        model=weierstrass_model,
        follows="$P' = P_1$ with $P_1^2 = 4 P^3 - g_2 P - g_3$, the equation of Weierstrass",
        defines=("Q", "x", "g2", "g3"),
        solves="d(x) = -slope(Q)/4*P1/(P - bend(Q)/24)^2;"
        " (slope(Q)/4)^2*(4*P^3 - g2*P - g3)/(P - bend(Q)/24)^4 = at(Q,x)",
        false=Falsehood(
            "The function of Weierstrass is shifted the other way",
            "(P - bend(Q)/24)",
            "(P + bend(Q)/24)",
        ),
    ),
    Trial(
        name="theorem-lame",
        tried="C = 1/4*(g + M3^2); x = 1/2*w/(1 + nu);"
        " y = 1/2*(p + M3)/(1 + nu) = 1/2*((p - M3*nu)/(1 + nu) + M3);"
        " d(x) + x^2 - y^2 = 3/4*A*nu^2 - 1/2*A*nu - C; d(y) + 2*x*y = 0;"
        " x2 = -1/2*w/(1 - nu); y2 = 1/2*(p - M3)/(1 - nu) = 1/2*((p - M3*nu)/(1 - nu) - M3);"
        " d(x2) + x2^2 - y2^2 = 3/4*A*nu^2 + 1/2*A*nu - C; d(y2) + 2*x2*y2 = 0",
        model=curve_model,
        follows="$a'/a = x + i y$ by @theorem-cayley-klein in Larmor's frame, so $a''/a = (x + i y)' + (x + i y)^2$",
        defines=("C", "x", "y", "x2", "y2"),
        note=r"The potentials have no pole where $\nu = -1$ or 1. So $\xi$ and $\eta$ are regular there, and their "
        "zeros are simple.",
        false=Falsehood(
            "Both parameters obey the same equation",
            "d(x2) + x2^2 - y2^2 = 3/4*A*nu^2 + 1/2*A*nu - C",
            "d(x2) + x2^2 - y2^2 = 3/4*A*nu^2 - 1/2*A*nu - C",
        ),
    ),
    Trial(
        name="theorem-residues",
        tried="q = (1 - nu^2)*(g - A*nu^2) - (p - M3*nu)^2 = w^2; at(q,-1) = -(p + M3)^2; at(q,1) = -(p - M3)^2;"
        " 1/2*(s*(p + M3) + p + M3)/(s*(p + M3)) = 1/2*(1 + s); 1/2*(-s*(p - M3) + p - M3)/(-s*(p - M3)) = 1/2*(1 - s)",
        model=lambda: tuple(curve_model(s) for s in (1, -1)),
        follows="@theorem-top, with $A = (I - 1) b^2$ and $g = 2 H - M_3^2/I - b^2$",
        defines=("q",),
        note=r"At $\nu = -1$, with $w_0 = i s (p + M_3)$ the rate of $\nu$ and $s = \pm 1$, the logarithmic rate of "
        r"$\xi$ is $[w_0 + i(p + M_3)]/(2 w_0 (t - z))$: residue 1 or 0.",
        false=Falsehood(
            r"The rate of $\nu$ is real there",
            "at(q,-1) = -(p + M3)^2",
            "at(q,-1) = (p + M3)^2",
        ),
    ),
    Trial(
        name="theorem-sigma",
        tried=_SIGMA,
        model=sigma_model,
        follows="@theorem-cayley-klein, @theorem-top and @theorem-weierstrass, with the addition theorem of zeta",
        defines=("x", "Z", "Y", "lam"),
        note="By the addition theorem, which is taken from the textbooks, the four zeta functions sum to $(P_1 + "
        "Z_1)/(2(P - Z)) - P_1/(2(P - P(z_0)))$. Here $Z_1 = i Y$ is the rate at the zero $z$. Tried for "
        r"$\alpha$; $\beta$ is its mirror image: $\nu$, $e$, $M_3$, $c_3$ with the opposite signs.",
        false=Falsehood(
            "The zero lies on the opposite half period",
            "Y = -(p + M3)",
            "Y = (p + M3)",
        ),
    ),
)
