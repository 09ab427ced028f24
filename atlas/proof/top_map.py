"""The energy-momentum map of a symmetric top on trial: cusps, focus-focus values, and the residues of its angles."""

from functools import cache

import sympy

from atlas.proof.model import Model, Value, dot, vector
from atlas.proof.trial import Falsehood, Trial

nu, r, a, A, M3, p, g, k2, kappa, spin = sympy.symbols("nu r a A M3 p g k2 kappa spin", real=True)
AT = {"at": lambda f, value: f.subs(nu, value)}


@cache
def cusp_model() -> Model:
    """Model any constants of the quartic q, with p such that the axis would not precess at nu = r."""
    letters = {"nu": nu, "r": r, "a": a, "A": A, "M3": M3, "g": g, "k2": k2, **AT}
    return Model({**letters, "p": M3 * r + k2 * (1 - r**2)})


@cache
def spin_model() -> tuple[Model, ...]:
    """Model any state M, b, |b| = 1, near a spin about n in either sense s."""
    models = []
    for sense in (1, -1):
        M, b = vector("M"), vector("b")
        x, y = sympy.symbols("x y", real=True)
        size = 1 + x**2 + y**2
        unit = (2 * x / size, 2 * y / size, (1 - x**2 - y**2) / size)
        letters: dict[str, Value] = {"s": sympy.Integer(sense), "a": a, "A": A, "M": M, "b": b, "nu": b[2], "M3": M[2]}
        letters |= {f"M{k + 1}": M[k] for k in range(2)} | {f"b{k + 1}": b[k] for k in range(2)}
        letters |= {"p": dot(M, b), "g": M[0] ** 2 + M[1] ** 2 + 2 * a * b[2] + A * b[2] ** 2}
        models.append(Model(letters, list(zip(b, unit, strict=True))))
    return tuple(models)


@cache
def residue_model() -> tuple[Model, ...]:
    """Model any constants of the quartic q at either end s of its range, and the rates P of psi and C of chi."""
    q = (1 - nu**2) * (g - 2 * a * nu - A * nu**2) - (p - M3 * nu) ** 2
    turn = (p - M3 * nu) / (1 - nu**2)
    letters = {"nu": nu, "M3": M3, "p": p, "q": q, "P": turn - k2, "C": spin - nu * turn + kappa * nu, **AT}
    letters["limit"] = lambda f, value: sympy.cancel(f).subs(nu, value)
    return tuple(Model({**letters, "s": sympy.Integer(sense)}) for sense in (1, -1))


_q = "(1 - nu^2)*(g - 2*a*nu - A*nu^2) - (p - M3*nu)^2"

TRIALS = (
    Trial(
        name="theorem-cusp",
        tried=f"q = {_q}; at(q,r) = (1 - r^2)*(g - 2*a*r - A*r^2 - k2^2*(1 - r^2));"
        " p - M3*nu - k2*(1 - nu^2) = (nu - r)*(k2*(nu + r) - M3)",
        model=cusp_model,
        follows=r"@theorem-every-top: the axis stops where $\dot\nu$ and $\dot\psi$ vanish together",
        defines=("q",),
        note=r"At a simple root $\nu - \nu_c$ begins with $q'(\nu_c) t^2/4$ and $\psi$ with $t^3$, unless $M_3 = 2 k_2 "
        r"\nu_c$: a cusp along the meridian. For $k_2 = 0$, $\nu_c = p/M_3$, and Lagrange's top has cusps exactly if "
        r"$g = 2 a p/M_3$.",
        false=Falsehood(
            "The energy of a cusp does not depend on the coupling",
            " - k2^2*(1 - r^2)",
            "",
        ),
    ),
    Trial(
        name="theorem-focus",
        tried="D = M3^2 - 4*(s*a + A); u1 = M1 - 1/2*s*M3*b1; u2 = M2 - 1/2*s*M3*b2;"
        " g - 2*s*a - A - s*M3*(p - s*M3) = u1^2 + u2^2 + 1/4*D*(b1^2 + b2^2) + (1/2*M3^2 - s*a)*(1 - s*nu)^2;"
        " p - s*M3 = u1*b1 + u2*b2 - 1/2*s*M3*(1 - s*nu)^2",
        model=spin_model,
        follows=r"@theorem-every-top, where $g - 2a\nu - A\nu^2 = M_1^2 + M_2^2$, the square of the axis's velocity "
        "but for the turn by $-k_2$",
        defines=("D", "u1", "u2"),
        note=r"$1 - \sigma\nu$ is of second order. With $D = -4c^2$ the first form is $(\boldsymbol\pi - c\mathbf{z}, "
        r"\boldsymbol\pi + c\mathbf{z})$, and with the second it is the normal form of focus and focus. For $D > 0$ "
        "it is a sum of squares.",
        false=Falsehood(
            "The weight does not enter the second order",
            "4*(s*a + A)",
            "4*A",
        ),
    ),
    Trial(
        name="theorem-residue",
        tried="limit((nu - s)*P,s) = -1/2*s*(p - s*M3); at(q,s) = -(p - s*M3)^2;"
        " limit((nu - s)*C,s) = -s*limit((nu - s)*P,s)",
        model=residue_model,
        follows=r"@theorem-every-top, $q(\sigma) = -(p - \sigma M_3)^2$; $P$, $C$ are the rates "
        r"of $\psi$ and $\chi$",
        note=r"So a path of $\nu$ that is drawn across $\sigma$ changes an angle by $2\pi i r = \pm\pi$, and a period, "
        "which goes to and fro, by a full turn.",
        false=Falsehood(
            r"Both angles have the same residue at $\nu = 1$ and at $-1$",
            "-s*limit",
            "limit",
        ),
    ),
)
