"""Section II, first half: from the action of the particles to the equations for the rotation matrix, (1) to (9)."""

from atlas.trial.ledger.equation import Equation

EQUATIONS = {
    "(1)": Equation(
        alias="1.6",
        kind="definition",
        says="Action of $n$ free particles held together by Lagrange multipliers",
        tex=r"\begin{aligned} "
        r"S=\int dt\,&\frac12\sum_{N=1}^{n}m_N\dot{\mathbf{y}}_N^2+\frac12\sum_{A,B=2}^{4}\lambda_{AB}\left"
        r"[(\mathbf{y}_A-\mathbf{y}_1,\mathbf{y}_B-\mathbf{y}_1)-a_{AB}\right]\\ "
        r"&+\frac12\sum_{A=2}^{4}\sum_{\beta=5}^{n}\lambda_{A\beta}\left[(\mathbf{y}_A-\mathbf{y}_1,"
        r"\mathbf{y}_\beta-\mathbf{y}_1)-a_{A\beta}\right] "
        r"\end{aligned}",
        assumptions=(r"$\lambda_{AB}$ is symmetric",),
    ),
    "text-constraints": Equation(
        says="Varying the multipliers gives the constraints",
        tex=r"\frac{\partial L}{\partial\lambda_{AB}}=0\iff(\mathbf{y}_A-\mathbf{y}_1,\mathbf{y}_B-\mathbf{y}_1)"
        r"=a_{AB}",
        quote=r"The variations with respect to $\lambda_{AN}$ imply the constraints",
    ),
    "(2)": Equation(
        alias="mf15",
        kind="definition",
        says="Potential energy of the body: the sum over its particles of @(103)",
        tex=r"-U=\sum_{N=1}^n e_NA_0(\mathbf{y}_N)+\frac{e_N}{c}(\mathbf{A}(\mathbf{y}_N), \dot{\mathbf{y}}_N)",
    ),
    "(3)": Equation(
        alias="mf16",
        says="Equations of motion of the constrained particles, varied from the action",
        tex=r"\begin{aligned} "
        r"m_1\ddot{\mathbf{y}}_1&=-\sum_{AB}\lambda_{AB}[\mathbf{y}_B-\mathbf{y}_1]-\frac12\sum_{A\alpha}"
        r"\lambda_{A\alpha}[\mathbf{y}_A+\mathbf{y}_\alpha-2\mathbf{y}_1]+\mu m_1\mathbf{E}+\frac{\mu"
        r"}{c}m_1[\dot{\mathbf{y}}_1,\mathbf{B}],\\ "
        r"m_A\ddot{\mathbf{y}}_A&=\sum_{B}\lambda_{AB}[\mathbf{y}_B-\mathbf{y}_1]+\frac12\sum_{\alpha}"
        r"\lambda_{A\alpha}[\mathbf{y}_\alpha-\mathbf{y}_1]+\mu m_A\mathbf{E}+\frac{\mu}{c}m_A[\dot{"
        r"\mathbf{y}}_A,\mathbf{B}],\\ "
        r"m_\alpha\ddot{\mathbf{y}}_\alpha&=\frac12\sum_{A}\lambda_{A\alpha}[\mathbf{y}_A-\mathbf{y}_1]+\mu "
        r"m_\alpha\mathbf{E}+\frac{\mu}{c}m_\alpha[\dot{\mathbf{y}}_\alpha,\mathbf{B}] "
        r"\end{aligned}",
        assumptions=(r"$\lambda_{AB}$ is symmetric", r"all particles have the same charge-to-mass ratio $\mu$"),
    ),
    "(4)": Equation(
        alias="mf17",
        says="The centre of mass moves as one charged point particle",
        tex=r"\ddot{\mathbf{y}}_0=\mu\mathbf{E}+\frac{\mu}{c}[\dot{\mathbf{y}}_0, \mathbf{B}]",
        assumptions=(r"all particles have the same charge-to-mass ratio $\mu$",),
    ),
    "text-translation": Equation(
        says="The flight does not depend on the rotation: other places and velocities about the same centre of mass "
        "do not change its acceleration",
        tex=r"\frac{\partial\ddot{\mathbf{y}}_0}{\partial\mathbf{x}_N}=\frac{\partial\ddot{\mathbf{y}}_0}{\partial\dot{\mathbf{x}}_N}=0",
        assumptions=(r"all particles have the same charge-to-mass ratio $\mu$",),
        quote="rotational motion of the body does not affect its translational motion",
    ),
    "text-rigid": Equation(
        says=r"The constraints keep all distances and angles, so that every solution is $\mathbf{x}_N(t) = R(t) "
        r"\mathbf{x}_N(0)$ with an orthogonal $R$",
        tex=r"\mathbf{x}_N(t)=R(t)\,\mathbf{x}_N(0),\qquad R^TR=\mathbf{1}",
        assumptions=("the vectors from particle 1 to particles 2, 3, 4 are independent",),
        quote="guarantee that distances and angles among the particles do not change with time",
    ),
    "(5)": Equation(
        alias="mf18",
        says="Equations of motion of the particles about the centre of mass",
        tex=r"\begin{aligned} "
        r"m_1\ddot x_1^i&=-\sum_{A,B=2}^4\lambda_{AB}[x_B^i-x_1^i]-\frac12\sum_{A\alpha}\lambda_{A\alpha"
        r"}[x_A^i+x_\alpha^i-2x_1^i]+m_1\lambda^i+\mu m_1\mathbf{E}+\frac{\mu}{c}m_1[\dot{\mathbf{x}}_1,"
        r"\mathbf{B}],\\ "
        r"m_A\ddot x_A^i&=\sum_{B=2}^4\lambda_{AB}[x_B^i-x^i_1]+\frac12\sum_{\alpha=5}^n\lambda_{A\alpha}[x_"
        r"\alpha^i-x_1^i]+m_A\lambda^i+\mu m_A\mathbf{E}+\frac{\mu}{c}m_A[\dot{\mathbf{x}}_A,\mathbf{B}],\\ "
        r"m_\alpha\ddot x_\alpha^i&=\frac12\sum_{A=2}^4\lambda_{A\alpha}[x_A^i-x_1^i]+m_\alpha\lambda^i+\mu "
        r"m_\alpha\mathbf{E}+\frac{\mu}{c}m_\alpha[\dot{\mathbf{x}}_\alpha,\mathbf{B}] "
        r"\end{aligned}",
        assumptions=("@(3) and @(4)", r"all particles have the same charge-to-mass ratio $\mu$"),
    ),
    "(6)": Equation(
        alias="mf19",
        says="Second-order equations for the rotation matrix",
        tex=r"\ddot R_{ik}g_{kj}=-R_{ik}\lambda_{kj}+\mu E_i(\sum m_N\mathbf{x}_N)-A_{ia}g_{aj}, \qquad R^TR="
        r"\mathbf{1}, \qquad R(0)=\mathbf{1}",
        assumptions=(r"$\mathbf{x}_N(t) = R(t) \mathbf{x}_N(0)$", "the particles obey @(5)"),
    ),
    "(7)": Equation(
        alias="mf20",
        kind="definition",
        says="The magnetic force on the rotating body as a matrix",
        tex=r"A_{ia}=\frac{\mu}{c}\epsilon_{inp}B_n\dot R_{pa}",
    ),
    "(8)": Equation(
        alias="1.32",
        kind="definition",
        says="Mass matrix of the body",
        tex=r"g_{ij}\equiv\sum_{N=1}^{n}m_Nx_N^i(0)x_N^j(0)",
    ),
    "(9)": Equation(
        alias="1.38",
        says="The symmetric matrix of the constraint forces",
        tex=r"\begin{aligned} "
        r"\lambda_{jk}=&-\sum_{AB}\lambda_{AB}\left[x_1^jx_1^k+x_A^jx_B^k-x_B^{(j}x_1^{k)}\right]\\ "
        r"&-\frac12\sum_{A\alpha}\lambda_{A\alpha}\left[x_\alpha^{(j}x_A^{k)}-x_\alpha^{(j}x_1^{k)}-"
        r"x_A^{(j}x_1^{k)}-2x_1^{j}x_1^{k}\right] "
        r"\end{aligned}",
        assumptions=(r"$\lambda_{AB}$ is symmetric", "round brackets on indices: sum of both orders, no factor $1/2$"),
    ),
    "text-multipliers-symmetric": Equation(
        says="The matrix of the constraint forces is symmetric",
        tex=r"""\lambda_{jk}=\lambda_{kj}""",
        assumptions=(r"$\lambda_{AB}$ is symmetric",),
        quote=r"while $\lambda_{jk}(t)$ is the symmetric matrix",
    ),
    "text-electric-field": Equation(
        says="The electric field does not affect the rotation: in another one no relative acceleration changes",
        tex=r"\frac{\partial\ddot{\mathbf{x}}_N}{\partial\mathbf{E}}=0",
        assumptions=(r"all particles have the same charge-to-mass ratio $\mu$",),
        quote="the electric field do not affect the motion of rotational degrees of freedom",
    ),
    "text-rotation-apart": Equation(
        says="The rotation does not depend on the flight: another place and velocity of the whole body changes no "
        "relative acceleration",
        tex=r"\frac{\partial\ddot{\mathbf{x}}_N}{\partial\mathbf{y}_0}=\frac{\partial\ddot{\mathbf{x}}_N}{\partial\dot{\mathbf{y}}_0}=0",
        assumptions=(r"all particles have the same charge-to-mass ratio $\mu$",),
        quote="so the translational motion does not affect the rotational motion of the body",
    ),
}
