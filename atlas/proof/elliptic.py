"""The paper's family for a body with any three moments of inertia, on trial."""

from functools import cache

import sympy

from atlas.proof.clebsch import AXES, MOMENTS, K, determinant
from atlas.proof.model import Model, cross
from atlas.proof.trial import Falsehood, Trial


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


TRIALS = (
    Trial(
        name="theorem-elliptic",
        printed="E = -v*inv(z*J + D*one); d(K) = cross(K,Omega) = cross(K,E*K);"
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
)
