"""The paper's family for a body with any three moments of inertia."""

from atlas.paper.equation import Equation

EQUATIONS = (
    Equation(
        name="theorem-elliptic",
        section="Atlas",
        kind="theorem",
        says="The paper's family for any body: wherever $v^2=P$, the angular velocity is one linear function of the "
        r"field for all times, and $\mathbf{K}$ turns like a free body",
        tex=r"\boldsymbol{\Omega}=-\left[1+v(zJ+D)^{-1}\right]\mathbf{K},\qquad\dot{\mathbf{K}}=[\mathbf{K},E\mathbf{K}"
        r"],\quad E=-v(zJ+D)^{-1},\qquad v^2=P=\prod_i\left(z+\frac{D}{I_i}\right)",
        assumptions=(
            r"$J = \text{diag}(I_1, I_2, I_3)$, any principal moments, $D = I_1 I_2 I_3$",
            "$z$ any number for which no $zI_i+D$ is 0",
        ),
    ),
)
