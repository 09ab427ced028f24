"""Section II, second half: the Euler-Poisson equations, (10) to (18)."""

from atlas.trial.ledger.equation import Equation

EQUATIONS = {
    "(10)": Equation(
        alias="The.1",
        kind="definition",
        says="Second-order system for $R$ and the multipliers with a given matrix $A$",
        tex=r"\ddot R_{ik}g_{kj}=-R_{ik}\lambda_{kj}-A_{ik}g_{kj}, \qquad R^TR=\mathbf{1}",
        assumptions=("$g$ is symmetric and non-degenerate", r"$\lambda$ is symmetric", "$A$ is a given matrix"),
    ),
    "text-affirmation": Equation(
        alias="Aff100",
        says="Affirmation: the second-order system @(10) is equivalent to the first-order system @(11), @(12)",
        tex=r"\text{(10)}\iff\text{(11), (12)}",
        assumptions=("$R$ is a rotation", "the inertia tensor is invertible"),
    ),
    "text-multipliers-algebraic": Equation(
        says="The multipliers are functions of $R$ and $\\dot R$ alone",
        tex=r"\lambda=-\bigl(\hat\Omega^2+\hat w+R^TA\bigr)g=\lambda^T,\qquad"
        r"\mathbf{w}=I^{-1}\{\text{right side of (11)}\}",
        assumptions=("$R$ is a rotation", "$I$ and $g$ are diagonal", "$\\hat v\\,x=[v,x]$"),
        quote=r"these equations determine $\lambda_{jk}$ algebraically, as some functions of $R$ and $\dot R$",
    ),
    "text-nondegenerate": Equation(
        says="The mass matrix of the body is not degenerate",
        tex=r"""\det g=g_1g_2g_3\ne0""",
        quote="as before, $g_{kj}$ is a numerical symmetric non-degenerate matrix",
    ),
    "(11)": Equation(
        alias="mf22",
        says="Euler equations for a given matrix $A$",
        tex=r"I_{ka}\dot\Omega_a=[I\boldsymbol{\Omega},\boldsymbol{\Omega}]_k+\frac12 \epsilon_{kij}\left"
        r"[(AI)_{ai}R_{aj}+(RI)_{ai}A_{aj}\right]-\frac12 I_{ka}\epsilon_{aij}A_{bi}R_{bj}",
        assumptions=("$R$ is a rotation", "$A$ is any matrix"),
    ),
    "(12)": Equation(
        alias="mf21",
        says="Poisson equations: the components of angular velocity in the body-fixed frame drive $R$",
        tex=r"\dot R_{ij}=-\epsilon_{jab}\Omega_a R_{ib}, \qquad R_{ij}(0)=\delta_{ij}",
        assumptions=("$R(t)$ is a rotation",),
    ),
    "text-inertia-tensor": Equation(
        says=r"The inertia tensor is $\operatorname{tr}(g) - g$: it gives the kinetic energy of the rotating particles",
        tex=r"I_{ij}=\Bigl(\sum_a g_{aa}\Bigr)\delta_{ij}-g_{ij}",
    ),
    "text-mass-moments": Equation(
        says="Moments of mass and of inertia: $2 g_1 = I_2 + I_3 - I_1$, and so on",
        tex=r"2g_1=I_2+I_3-I_1,\qquad 2g_2=I_3+I_1-I_2,\qquad 2g_3=I_1+I_2-I_3",
    ),
    "text-inertia-axes": Equation(
        says="The columns of $R$ are the axes of inertia, and at $t = 0$ the axes of the laboratory",
        tex=r"(R\,I\,R^T)\,\mathbf{R}_i=I_i\mathbf{R}_i,\qquad\mathbf{R}_i(0)=\mathbf{e}_i",
        assumptions=("$R$ is a rotation", "$I$ and $g$ are diagonal"),
        quote=r"at initial instant $t=0$ the Laboratory basis vectors $\mathbf{e}_i$ were taken in the directions of "
        r"axes of inertia $\mathbf{R}_i(t)$",
    ),
    "text-orthogonal": Equation(
        says="Poisson equations keep $R$ orthogonal: $R R^T$ stays what it is at $t = 0$",
        tex=r"\frac{d}{dt}(RR^T)=0",
    ),
    "text-covariance": Equation(
        says="The system is covariant under rotations of the laboratory",
        tex=r"\begin{aligned} &[I'\boldsymbol{\Omega}',\boldsymbol{\Omega}']-\frac{\mu}{c}[g'\mathbf{K}',"
        r"\boldsymbol{\Omega}']=S\Bigl\{[I\boldsymbol{\Omega},\boldsymbol{\Omega}]-\frac{\mu}{c}[g\mathbf{K},"
        r"\boldsymbol{\Omega}]\Bigr\},\\ &I'=SIS^T,\quad g'=SgS^T,\quad\boldsymbol{\Omega}'=S\boldsymbol{"
        r"\Omega},\quad\mathbf{K}'=S\mathbf{K} \end{aligned}",
        assumptions=("$S$ is a rotation", "$\\mathbf{K}=R^T\\mathbf{B}$, $R'=SRS^T$"),
        quote="Note that this system is composed of $SO(3)$ vectors and tensors, so it is covariant under the "
        "rotations",
    ),
    "text-force-matrix": Equation(
        alias="mf23",
        kind="derivation step",
        says=r"The matrix $A$ of the magnetic force written through $R$ and $\boldsymbol{\Omega}$, step by step",
        tex=r"\begin{aligned} "
        r"\epsilon_{ijk}B_j\dot R_{ka}&=\epsilon_{ijk}\epsilon_{abc}B_j\Omega_bR_{kc}=\epsilon_{ijk}\epsilon"
        r"_{\alpha\beta\gamma}R_{\alpha a}R_{\beta b}R_{\gamma c}B_j\Omega_bR_{kc}\\ "
        r"&=\epsilon_{ijk}\epsilon_{\alpha\beta\gamma}R_{\alpha a}B_j(R\boldsymbol{\Omega})_\beta(RR^T)_{"
        r"\gamma k}=\epsilon_{ijk}\epsilon_{\alpha\beta k}R_{\alpha a}B_j(R\boldsymbol{\Omega})_\beta\\ "
        r"&=R_{ia}(\mathbf{B}R\boldsymbol{\Omega})-(R\boldsymbol{\Omega})_i(\mathbf{B}R)_a "
        r"\end{aligned}",
        assumptions=("$R(t)$ is a rotation",),
    ),
    "(13)": Equation(
        alias="mf24",
        says=r"The matrix $A$ of the magnetic force through $R$ and $\boldsymbol{\Omega}$",
        tex=r"\begin{aligned} "
        r"A_{ia}&=-\frac{\mu}{c}\epsilon_{ijk}\epsilon_{abc}B_j\Omega_b R_{kc}=\frac{\mu}{c}\left[(R"
        r"\boldsymbol{\Omega})_i(\mathbf{B}R)_a-R_{ia}(\mathbf{B}R\boldsymbol{\Omega})\right] "
        r"\end{aligned}",
        assumptions=("$R(t)$ is a rotation",),
    ),
    "(14)": Equation(
        alias="mf25",
        says="Euler equations with the magnetic torque, through the inertia tensor",
        tex=r"\begin{aligned} "
        r"I\dot{\boldsymbol{\Omega}}&=[I\boldsymbol{\Omega}, \boldsymbol{\Omega}]-\frac{\mu}{2c}\left\{I[R^T"
        r"\mathbf{B}, \boldsymbol{\Omega}]-[IR^T\mathbf{B}, \boldsymbol{\Omega}]+[R^T\mathbf{B}, I"
        r"\boldsymbol{\Omega}]\right\} "
        r"\end{aligned}",
        assumptions=("$R(t)$ is a rotation",),
    ),
    "(15)": Equation(
        alias="mf26",
        says="First component of the magnetic torque, through the mass matrix",
        tex=r"\begin{aligned} "
        r"&(I[R^T\mathbf{B},\boldsymbol{\Omega}])_1-[IR^T\mathbf{B},\boldsymbol{\Omega}]_1+[R^T\mathbf{B},I"
        r"\boldsymbol{\Omega}]_1\\ "
        r"&\quad=(I_1-I_2+I_3)(R^T\mathbf{B})_2\Omega_3-(I_1-I_3+I_2)(R^T\mathbf{B})_3\Omega_2\\ "
        r"&\quad=2g_2(R^T\mathbf{B})_2\Omega_3-2g_3(R^T\mathbf{B})_3\Omega_2=2[gR^T\mathbf{B},\boldsymbol{"
        r"\Omega}]_1 "
        r"\end{aligned}",
        assumptions=("$I$ and $g$ are diagonal",),
    ),
    "text-other-components": Equation(
        says="What @(15) says of the first component holds for the second and third",
        tex=r"""I[R^T\mathbf{B},\boldsymbol{\Omega}]-[IR^T\mathbf{B},\boldsymbol{\Omega}]+[R^T\mathbf{B},I\boldsymbol{\Omega}]=2[gR^T\mathbf{B},\boldsymbol{\Omega}]""",
        assumptions=("$I$ and $g$ are diagonal",),
        quote="and similar expressions for the second and third components",
    ),
    "(16)": Equation(
        alias="mf27",
        says="Euler equations of the charged body in the magnetic field",
        tex=r"I\dot{\boldsymbol{\Omega}}=[I\boldsymbol{\Omega}, \boldsymbol{\Omega}]-\frac{\mu}{c}[gR^T"
        r"\mathbf{B}, \boldsymbol{\Omega}]",
        assumptions=("$R(t)$ is a rotation",),
    ),
    "(17)": Equation(
        alias="mf28",
        says="Rate of the angular momentum in the laboratory frame",
        tex=r"\dot{\mathbf{m}}=-\frac{\mu}{c}[RgR^T\mathbf{B}, RI^{-1}R^T\mathbf{m}]",
        assumptions=("$R(t)$ is a rotation",),
    ),
    "(18)": Equation(
        alias="mf29",
        says="Rate of the angular momentum in the body-fixed frame",
        tex=r"\dot{\mathbf{M}}=[\mathbf{M}, I^{-1}\mathbf{M}]-\frac{\mu}{c}[gR^T\mathbf{B}, I^{-1}\mathbf{M}]",
        assumptions=("$R(t)$ is a rotation",),
    ),
    "text-grioli": Equation(
        says=r"With $\mathbf{e}_3$ along $\mathbf{B}$ the magnetic torque holds the third row of $R$, the form "
        "deduced by Grioli",
        tex=r"I'\dot{\boldsymbol{\Omega}}=[I'\boldsymbol{\Omega},\boldsymbol{\Omega}]-\frac{\mu\lvert\mathbf{B}"
        r"\rvert}{c}[g'\mathbf{G}_3,\boldsymbol{\Omega}]",
        assumptions=(r"$\mathbf{B}$ along $\mathbf{e}_3$",),
    ),
    "text-flight": Equation(
        says="The path of any point of the body: flight and rotation together",
        tex=r"""\mathbf{y}_N(t)=\mathbf{y}_0(t)+R(t)\,\mathbf{x}_N(0)""",
        assumptions=("the constraint forces do no work in a rigid motion", "@(4), @(12) and @(16)"),
    ),
}
