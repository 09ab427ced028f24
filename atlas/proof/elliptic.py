"""The paper's family for a body with any three moments of inertia, on trial."""

from functools import cache

import sympy
from sympy.polys.matrices import DomainMatrix

from atlas.proof.clebsch import AXES, MOMENTS, K, M, determinant
from atlas.proof.model import Model, cross, dot
from atlas.proof.trial import Falsehood, Part, Trial


@cache
def elliptic_model() -> Model:
    """Model any K of a body with principal moments, any z and v, and Omega as a linear function of K."""
    z, v = sympy.symbols("z v", real=True)
    D = determinant(AXES)
    E = -v * (z * AXES + D * sympy.eye(3)).inv()
    letters = {"J": AXES, "K": K, "z": z, "v": v, "D": D, "Omega": (E - sympy.eye(3)) * K}
    letters["g"] = AXES.trace() / 2 * sympy.eye(3) - AXES
    letters["P"] = sympy.prod(z + D / moment for moment in MOMENTS)
    return Model(letters, flow=dict(zip(K, cross(K, E * K), strict=True)))


@cache
def integrals_model() -> Model:
    """Model any M and K of a body with principal moments, any z and v, and the integrals H and F."""
    z, v = sympy.symbols("z v", real=True)
    D = determinant(AXES)
    x = sympy.diag(*(z + D / moment for moment in MOMENTS))
    P = sympy.expand(x.det())
    letters = {"M": M, "K": K, "J": AXES, "D": D, "z": z, "v": v, "x": x, "P": P, "P1": P.diff(z), "P2": P.diff(z, 2)}
    letters |= {"e2": sum(D / moment for moment in MOMENTS), "s": dot(K, x.inv() * K), "elliptic": -v * x.inv() * K}
    letters["H"] = lambda M: dot(M, AXES.inv() * M) / 2 + dot(K, AXES * K) / 2
    letters["F"] = lambda M: dot(M, M) - D * dot(K, AXES.inv() * K)
    letters |= dict(zip(("x1", "x2", "x3"), x.diagonal(), strict=True)) | dict(
        zip(("I1", "I2", "I3"), MOMENTS, strict=True)
    )
    letters |= {name: sympy.Matrix(sympy.symbols(f"{name}1:4", real=True)) for name in ("m", "k")}
    letters["normal"] = x.inv() * (letters["P1"] * sympy.eye(3) - 2 * P * x.inv()) * K
    return Model(letters)


@cache
def critical_model() -> Model:
    """Model the values of F and 2 D H on the elliptic motions as functions of z, with v' = P'/2v, at any b and c."""
    whole = integrals_model().letters
    b, c = sympy.symbols("b c", real=True)
    letters = {name: whole[name] for name in ("z", "v", "D", "e2", "P", "P1", "P2")} | {"b": b, "c": c}
    return Model(letters, flow={whole["z"]: sympy.Integer(1), whole["v"]: whole["P1"] / (2 * whole["v"])})


@cache
def linear_model() -> Model:
    """Model the flow of half the sum of squares, linear about x_i M_i = -v K_i.

    Here x_i = w_i^2, v = w1 w2 w3 and K_i = w_i k_i, which makes all of it polynomials.
    """
    w, k, lam = sympy.symbols("w1:4"), sympy.symbols("k1:4"), sympy.Symbol("lam")
    first, second, third = (root**2 for root in w)
    x, y = sympy.diag(first, second, third), sympy.diag(second * third, first * third, first * second)
    rates = sympy.Matrix([*(cross(M, x * M) + cross(K, y * K)), *cross(K, x * M)])
    start = {M[i]: -k[i] * w[i - 1] * w[i - 2] for i in range(3)} | {K[i]: k[i] * w[i] for i in range(3)}
    flow = DomainMatrix.from_Matrix(rates.jacobian([*M, *K]).subs(start, simultaneous=True))
    letters = {"lam": lam, "rates": rates.subs(start, simultaneous=True)}
    letters["char"] = sum(flow.domain.to_sympy(c) * lam**n for n, c in enumerate(reversed(flow.charpoly())))
    letters["C"] = sum(k[i] ** 2 * (y.trace() - 2 * y[i, i]) ** 2 for i in range(3))
    return Model(letters)


TRIALS = (
    Trial(
        name="theorem-elliptic",
        tried="E = -v*inv(z*J + D*one); d(K) = cross(K,Omega) = cross(K,E*K);"
        " J*d(Omega) - cross(J*Omega,Omega) + 2*cross(g*K,Omega) = (1 - v^2/P)*cross(J*K,K)",
        model=elliptic_model,
        follows=r"@(16) and @(35), for any $v$",
        defines=("E",),
        note=r"What is left of @(16) vanishes for $v^2=P$, and from a start there is but one solution. For another $v$ "
        r"it vanishes only where $[J\mathbf{K},\mathbf{K}]=0$ for all times: the field along an axis, or a ball.",
        false=Falsehood(
            "Any $v$ will do",
            "(1 - v^2/P)*cross(J*K,K)",
            "0*cross(J*K,K)",
        ),
    ),
    Trial(
        name="theorem-splitting",
        tried="x1*(M[1] + v*K[1]/x1)^2 + x2*(M[2] + v*K[2]/x2)^2 + x3*(M[3] + v*K[3]/x3)^2"
        " = 2*D*H(M) + z*F(M) + 2*v*dot(M,K) + dot(K,K)*z*(z + e2) + (v^2 - P)*s",
        model=integrals_model,
        follows=r"$H$ and $F$; for $v^2=P$ the last term vanishes",
        also=(
            Part(line="rates[n] = 0; char = lam^4*(lam^2 + C)", model=linear_model),
            Part(
                line="4*dot(K,K)*P + s*(P1^2 - 2*P*P2) = K[1]^2/x1*(x1*x2 + x1*x3 - x2*x3)^2"
                " + K[2]^2/x2*(x2*x1 + x2*x3 - x1*x3)^2 + K[3]^2/x3*(x3*x1 + x3*x2 - x1*x2)^2;"
                " P1^2 - 2*P*P2 = (x2*x3)^2 - 2*x2*x3*x1*(x2 + x3) + x1^2*(x2 - x3)^2",
                model=integrals_model,
            ),
            Part(
                line="dot(normal,x*m + v*k) = 2*v*(dot(elliptic,m) - D*dot(K,inv(J)*k)) + P1*(dot(elliptic,k)"
                " + dot(K,m)) + 2*v*(2*z + e2)*dot(K,k) + 2*(v^2 - P)*dot(K,inv(x)*m);"
                " dot(normal,x*normal) = 4*dot(K,K)*P + s*(P1^2 - 2*P*P2)",
                model=integrals_model,
            ),
        ),
        note="The sum of squares is conserved, whatever the motion, because $H$, $F$ and the Casimirs are. If all "
        "$x_i>0$, on the unbounded oval, it is small only near the motions with $x_iM_i=-vK_i$, so that neighbours "
        r"stay near the curves that $\mathbf{K}$ draws on them. The motion itself is stable where it is all of its "
        r"curve: not for $z=0$, where $\mathbf{K}$ stands still at a place of a whole curve, and not where "
        r"$\mathbf{K}$ is on a separatrix or at its middle axis. On the bounded oval "
        "let $x_1>0>x_2,x_3$: there $P'^2-2PP''$ has positive terms only, and $C=4b^2P+s(P'^2-2PP'')>0$ wherever "
        r"$s=-(\mathbf{M},\mathbf{K})/v>0$. For $C>0$ the squares are of one sign across the curve of the motion: if "
        r"$F$ and the Casimirs do not change, the last line but one says for a small change $(\mathbf{m},\mathbf{k})$ "
        r"that $y_i=x_im_i+vk_i$ is across a vector $\mathbf{n}$, and the last one that $\sum x_in_i^2=C$. On the "
        r"plane across $\mathbf{n}$ the form $\sum y_i^2/x_i$ has the discriminant $\sum x_in_i^2/P$, but for a "
        "square, and so is definite if $C>0$, and has both signs if $C<0$, where the flow of $DH+zF/2$ has a saddle. "
        "Not proved is that neighbours leave *in time* at those single places of an unstable stretch "
        "where the rate in time is zero.",
        false=Falsehood(
            "The flow of $DH+zF/2$ has no eigenvalue but 0, so that stability is never decided by it",
            "lam^4*(lam^2 + C)",
            "lam^6",
        ),
    ),
    Trial(
        name="theorem-bifurcation",
        tried="F = -c*P1/v - 2*b^2*z - e2*b^2; G = -2*c*v - b^2*z^2 - z*(F + e2*b^2);"
        " C = 4*b^2*v^2 - c/v*(P1^2 - 2*v^2*P2); d(F) = -C/(2*v^2); d(G) = -z*d(F); d(-z/(2*D))/d(F) = v^2/(D*C)",
        model=critical_model,
        follows=r"$v^2=P$, of which $dv/dz=P'/2v$ is used; $G=2DH$",
        defines=("F", "G", "C"),
        also=(
            Part(
                line="c = dot(elliptic,K) = -v*s; F(elliptic) = -c*P1/v - 2*dot(K,K)*z - e2*dot(K,K)"
                " + (v^2 - P)*dot(inv(x)*K,inv(x)*K); 2*D*H(elliptic) = -2*c*v - dot(K,K)*z^2"
                " - z*(F(elliptic) + e2*dot(K,K)) - (v^2 - P)*s",
                model=integrals_model,
                defines=("c",),
            ),
        ),
        note="The second line is that an elliptic motion has these $F$ and $H$. The curve turns back in a cusp where "
        "$C=0$, and is convex, as $H$ over $F$, where $C>0$.",
        false=Falsehood(
            "The slope does not depend on the place on the curve",
            "d(G) = -z*d(F)",
            "d(G) = -e2*d(F)",
        ),
    ),
    Trial(
        name="theorem-edge",
        tried="2*(H(M) - F(M)/(2*I3)) - (I1 + I2)*dot(K,K) = (1/I1 - 1/I3)*M[1]^2 + (1/I2 - 1/I3)*M[2]^2"
        " + (I3 - I1)*(I3 - I2)/I3*K[3]^2",
        model=integrals_model,
        follows=r"$H$ and $F$",
        note=r"For $I_3$ the largest moment the right side is not negative, and it is 0 for $\mathbf{M}=(0,0,M_3)$, "
        r"$\mathbf{K}=(K_1,K_2,0)$, which is as $(\mathbf{M},\mathbf{K})=0$ asks: the body swings or turns about its "
        r"third axis, which stays across the field, as a plane pendulum.",
        false=Falsehood(
            "The bound is the energy of the spin about the axis of the largest moment along the field",
            "(I1 + I2)*dot(K,K)",
            "I3*dot(K,K)",
        ),
    ),
)
