"""The paper's family for a body with any three moments of inertia."""

from atlas.trial.ledger.equation import Equation

EQUATIONS = {
    "theorem-elliptic": Equation(
        says="The paper's family for any body: wherever $v^2=P$, the angular velocity is one linear function of the "
        r"field for all times, and $\mathbf{K}$ turns like a free body",
        tex=r"\boldsymbol{\Omega}=-\left[1+v(zJ+D)^{-1}\right]\mathbf{K},\qquad\dot{\mathbf{K}}=[\mathbf{K},E\mathbf{K}"
        r"],\quad E=-v(zJ+D)^{-1},\qquad v^2=P=\prod_i\left(z+\frac{D}{I_i}\right)",
        assumptions=(
            r"$J = \text{diag}(I_1, I_2, I_3)$, any principal moments, $D = I_1 I_2 I_3$",
            "$z$ any number for which no $zI_i+D$ is 0",
        ),
    ),
    "theorem-splitting": Equation(
        says="$DH+zF/2$ is, but for the Casimirs, a sum of three squares that vanish on an elliptic motion; across the "
        "curve of the motion they are of one sign if $C>0$",
        tex=r"\begin{aligned} \sum_i\frac{(x_iM_i+vK_i)^2}{x_i}&=2DH+zF+2cv+b^2z(z+e_2),\qquad x_i=z+\frac{D}{I_i},\\ "
        r"\det(\lambda-\Lambda)&=\lambda^4(\lambda^2+C),\qquad C=\sum_i\frac{K_i^2}{x_i}\left(x_ix_j+x_ix_k-x_jx_k"
        r"\right)^2 \end{aligned}",
        assumptions=(
            r"$v^2=P=x_1x_2x_3$, $(i,j,k)$ all different, $c=(\mathbf{M},\mathbf{K})$, $e_2=I_1I_2+I_1I_3+I_2I_3$",
            r"$\Lambda$ the linearized flow of $DH+zF/2$ at an elliptic motion, $x_iM_i=-vK_i$",
        ),
    ),
    "theorem-bifurcation": Equation(
        says=r"At given $b$ and $c=(\mathbf{M},\mathbf{K})$ the integrals of the elliptic motions lie on a rational "
        "curve, whose slope is a function of $z$",
        tex=r"\begin{aligned} F&=-\frac{cP'}{v}-2b^2z-e_2b^2,\qquad 2DH=-2cv-b^2z^2-z(F+e_2b^2),\\ \frac{dF}{dz}&="
        r"-\frac{C}{2P},\qquad\frac{dH}{dF}=-\frac{z}{2D},\qquad\frac{d^2H}{dF^2}=\frac{P}{DC} \end{aligned}",
        assumptions=("$z$ and $v$ as in @theorem-elliptic, $P'=dP/dz$, $C$ and $e_2$ as in @theorem-splitting",),
    ),
    "theorem-edge": Equation(
        says=r"For $(\mathbf{M},\mathbf{K})=0$, Neumann's and Weber's case, the lower edge of all motions is a "
        "straight line, reached by plane pendulums",
        tex=r"2H-\frac{F}{I_3}-(I_1+I_2)\mathbf{K}^2=\left(\frac1{I_1}-\frac1{I_3}\right)M_1^2+\left(\frac1{I_2}"
        r"-\frac1{I_3}\right)M_2^2+\frac{(I_3-I_1)(I_3-I_2)}{I_3}K_3^2\ge0",
        assumptions=("$I_1\\le I_3$, $I_2\\le I_3$, for the sign", r"$H$, $F$, $\mathbf{M}$, $\mathbf{K}$ any"),
    ),
}
