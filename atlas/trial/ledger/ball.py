"""Section III: the charged ball, (19) to (30)."""

from atlas.trial.ledger.equation import Equation

EQUATIONS = {
    "text-momentum": Equation(
        says=r"Angular momentum of the rotating particles: $\mathbf{m} = \sum g_i [\mathbf{R}_i, \dot{\mathbf{R}}_i] "
        r"= R I R^T \boldsymbol{\omega} = R I \boldsymbol{\Omega}$",
        tex=r"\mathbf{m}=\sum_Nm_N[\mathbf{x}_N,\dot{\mathbf{x}}_N]=\sum_ig_i[\mathbf{R}_i,\dot{\mathbf{R}}_i]="
        r"RIR^T\boldsymbol{\omega}=RI\boldsymbol{\Omega}",
        assumptions=("$R(t)$ is a rotation", "$g$ is diagonal"),
    ),
    "(19)": Equation(
        alias="mf30.0",
        kind="definition",
        says="A totally symmetric body: the ball",
        tex=r"I_1=I_2=I_3\equiv I_0",
    ),
    "text-ball-centre": Equation(
        says="The centre of the ball moves as @(101) says",
        tex=r"\mathbf{y}_0(t)=\mathbf{y}_{\Vert}(t)+\mathbf{y}_{\bot}(t)",
        assumptions=("$I_1 = I_2 = I_3$", "@(93) for the part along the field, @(99) for that across it"),
        quote="Then its center moves according to Eq. (101)",
    ),
    "text-ball-axis": Equation(
        says="The angular momentum of a ball lies along its axis of rotation",
        tex=r"""\mathbf{m}=I_0\boldsymbol{\omega}=I_0R\boldsymbol{\Omega},\qquad[\boldsymbol{\omega},\mathbf{m}]=0""",
        assumptions=("$I_1 = I_2 = I_3$", "$R(t)$ is a rotation"),
        quote=r"for all t the instantaneous rotation axis $\boldsymbol{\omega}$ remains parallel with the vector "
        "of angular momentum",
    ),
    "(20)": Equation(
        alias="mf30",
        says="Poisson equations of the ball",
        tex=r"\dot R_{ij}=-\epsilon_{jab}\Omega_a R_{ib}, \qquad R_{ij}(0)=\delta_{ij}",
        assumptions=("$R(t)$ is a rotation",),
    ),
    "(21)": Equation(
        alias="mf31",
        says="Euler equations of the ball",
        tex=r"\dot{\boldsymbol{\Omega}}=-\frac{\mu}{2c}[R^T\mathbf{B}, \boldsymbol{\Omega}]",
        assumptions=("$I_1 = I_2 = I_3$",),
    ),
    "(22)": Equation(
        alias="mf32",
        says=r"The angular momentum of the ball precesses about $\mathbf{B}$",
        tex=r"\dot{\mathbf{m}}=-\frac{\mu}{2c}[\mathbf{B}, \mathbf{m}]",
        assumptions=("$I_1 = I_2 = I_3$",),
    ),
    "(23)": Equation(
        alias="mf33",
        says=r"Length of the angular momentum and its projection on $\mathbf{B}$ are conserved",
        tex=r"\mathbf{m}^2=\text{const}, \qquad (\mathbf{m}, \mathbf{B})=\text{const}",
        assumptions=("$I_1 = I_2 = I_3$",),
    ),
    "text-ball-body-precession": Equation(
        says="The components of angular velocity in the body-fixed frame precess with the frequency $\\alpha$ about "
        "those of the field",
        tex=r"""\ddot{\boldsymbol{\Omega}}=[\mathbf{K},[\mathbf{K},\boldsymbol{\Omega}]],\qquad\mathbf{K}=\frac{\mu}{2c}R^T\mathbf{B}""",
        assumptions=("$I_1 = I_2 = I_3$",),
        quote=r"Components $\Omega_i$ of angular velocity $\boldsymbol{\omega}$ with respect to body-fixed frame "
        r"precess with the same frequency around the components $(R^T\mathbf{B})_i$",
    ),
    "text-ball-equivalent": Equation(
        says=r"With $\mathbf{m}$ in the place of $\boldsymbol{\Omega}$ the Euler equations @(21) are @(22), and the "
        "other way round",
        tex=r"\boldsymbol{\Omega}=\frac{1}{I_0}R^T\mathbf{m}:\qquad\dot{\boldsymbol{\Omega}}+\frac{\mu}{2c}[R^T"
        r"\mathbf{B},\boldsymbol{\Omega}]=\frac{1}{I_0}R^T\Bigl\{\dot{\mathbf{m}}+\frac{\mu}{2c}[\mathbf{B},"
        r"\mathbf{m}]\Bigr\}",
        assumptions=("$I_1 = I_2 = I_3$", "@(20), $R(t)$ is a rotation"),
        quote="So the system (20), (21) is equivalent to",
    ),
    "text-linear-poisson": Equation(
        says=r"Within the rotations the Poisson equations, not linear once $\mathbf{m}$ is known, may be replaced by "
        "linear ones",
        tex=r"-\frac{1}{I_0}\epsilon_{jab}(R^T\mathbf{m})_aR_{ib}=\frac{1}{I_0}\epsilon_{iab}m_aR_{bj}",
        assumptions=("$I_1 = I_2 = I_3$",),
        quote="have the same solutions in the set of orthogonal matrices",
    ),
    "(24)": Equation(
        alias="mf34",
        says="Poisson equations of the ball, linear in $R$",
        tex=r"\dot R_{ij}=\frac{1}{I_0}\epsilon_{iab}m_aR_{bj},\qquad\text{or, equivalently}\quad\dot{\mathbf{R}"
        r"}_j=\frac{1}{I_0}[\mathbf{m},\mathbf{R}_j]",
        assumptions=("$I_1 = I_2 = I_3$", "$R(t)$ is a rotation"),
    ),
    "(25)": Equation(
        alias="mf35",
        says="Rate of the angular momentum of the ball",
        tex=r"\dot{\mathbf{m}}=-\frac{\mu}{2c}[\mathbf{B}, \mathbf{m}]",
        assumptions=("$I_1 = I_2 = I_3$",),
    ),
    "text-ball-frame": Equation(
        says="For a ball the axes of the laboratory may be chosen freely: the inertia tensor stays diagonal",
        tex=r"""R\,(I_0\mathbf{1})R^T=I_0\mathbf{1}""",
        assumptions=("$I_1 = I_2 = I_3$",),
        quote="we can choose the directions of Laboratory axes as convenient, this will not violate the diagonal "
        "form of inertia tensor",
    ),
    "(26)": Equation(
        alias="mf36",
        kind="claim",
        says="Angular momentum of the ball at any time",
        tex=r"\mathbf{m}(t)=\begin{pmatrix} \cos\alpha t & \sin\alpha t & 0 \\ -\sin\alpha t & \cos\alpha t & 0 "
        r"\\ 0 & 0 & 1 \end{pmatrix}\begin{pmatrix} 0 \\ m_2 \\ m_3 \end{pmatrix}=\begin{pmatrix} m_2\sin"
        r"\alpha t \\ m_2\cos\alpha t \\ m_3 \end{pmatrix}",
        assumptions=(
            "$I_1 = I_2 = I_3$",
            r"$\mathbf{B}$ along $\mathbf{e}_3$, $\mathbf{m}(0)$ in the plane $(\mathbf{e}_2, \mathbf{e}_3)$",
        ),
    ),
    "(27)": Equation(
        alias="mf37",
        kind="definition",
        says="Larmor frequency",
        tex=r"\alpha=\frac{\mu\lvert \mathbf{B}\rvert}{2c}",
    ),
    "text-ball-ansatz": Equation(
        says=r"At $t = 0$ the ansatz @(28) fixes $\hat{\mathbf{k}}$ and $\gamma$",
        tex=r"\hat{k}_2=-\frac{m_2}{\gamma I_0},\qquad\hat{k}_3=-\frac{\alpha I_0+m_3}{\gamma I_0},\qquad I_0^2"
        r"\gamma^2=m_2^2+(\alpha I_0+m_3)^2",
        assumptions=("$I_1 = I_2 = I_3$",),
    ),
    "(28)": Equation(
        alias="mf38",
        kind="claim",
        says="Rotation matrix of the ball: two rotations",
        tex=r"\begin{aligned} "
        r"&\begin{pmatrix}\cos\gamma t\cos\alpha t-\hat{k}_3\sin\gamma t\sin\alpha t&\hat{k}_3\sin\gamma t"
        r"\cos\alpha t+(\hat{k}_2^2+\hat{k}_3^2\cos\gamma t)\sin\alpha t&-\hat{k}_2\sin\gamma t\cos\alpha t+"
        r"\hat{k}_2\hat{k}_3(1-\cos\gamma t)\sin\alpha t\\-\cos\gamma t\sin\alpha t-\hat{k}_3\sin\gamma t"
        r"\cos\alpha t&-\hat{k}_3\sin\gamma t\sin\alpha t+(\hat{k}_2^2+\hat{k}_3^2\cos\gamma t)\cos\alpha t&"
        r"\hat{k}_2\sin\gamma t\sin\alpha t+\hat{k}_2\hat{k}_3(1-\cos\gamma t)\cos\alpha t\\\hat{k}_2\sin"
        r"\gamma t&\hat{k}_2\hat{k}_3(1-\cos\gamma t)&\hat{k}_3^2+\hat{k}_2^2\cos\gamma t\end{pmatrix}\\ &"
        r"\equiv\begin{pmatrix}\cos\alpha t&\sin\alpha t&0\\-\sin\alpha t&\cos\alpha t&0\\0&0&1\end{pmatrix}"
        r"\times\begin{pmatrix}\cos\gamma t&\hat{k}_3\sin\gamma t&-\hat{k}_2\sin\gamma t\\-\hat{k}_3\sin"
        r"\gamma t&\hat{k}_2^2+\hat{k}_3^2\cos\gamma t&\hat{k}_2\hat{k}_3(1-\cos\gamma t)\\\hat{k}_2\sin"
        r"\gamma t&\hat{k}_2\hat{k}_3(1-\cos\gamma t)&\hat{k}_3^2+\hat{k}_2^2\cos\gamma t\end{pmatrix} "
        r"\end{aligned}",
        assumptions=(
            "$I_1 = I_2 = I_3$",
            r"$\mathbf{B}$ along $\mathbf{e}_3$, $\mathbf{m}(0)$ in the plane $(\mathbf{e}_2, \mathbf{e}_3)$",
            r"$\hat{\mathbf{k}}$ and $\gamma$ of @(29)",
        ),
    ),
    "(29)": Equation(
        alias="mf39",
        kind="claim",
        says="Axis and frequency of the second rotation of the ball",
        tex=r"\hat{k}_2=-\frac{m_2}{\sqrt{m_2^2+(\alpha I_0+m_3)^2}},\quad\hat{k}_3=-\frac{m_3+\alpha I_0}{\sqrt"
        r"{m_2^2+(\alpha I_0+m_3)^2}},\quad\gamma=\frac{1}{I_0}\sqrt{m_2^2+(\alpha I_0+m_3)^2}",
        assumptions=("$I_1 = I_2 = I_3$",),
    ),
    "text-ball-two-rotations": Equation(
        says=r"The motion of the ball is a rotation about $\hat{\mathbf{k}}$ by $-\gamma t$, then one about "
        r"$\mathbf{B}$ by $-\alpha t$",
        tex=r"R(t)=R_{\hat{\mathbf{B}}}(-\alpha t)\,R_{\hat{\mathbf{k}}}(-\gamma t)",
        assumptions=("$I_1 = I_2 = I_3$",),
        quote="The total motion can be thought as a superposition of two rotations",
    ),
    "text-ball-parallel": Equation(
        says=r"A ball launched along $\mathbf{B}$: $\hat{\mathbf{k}} = (0, 0, -1)$ and $\gamma = \alpha + m_3/I_0$",
        tex=r"\hat{\mathbf{k}}=(0,0,-1)^T,\qquad\gamma=\alpha+\frac{m_3}{I_0}",
        assumptions=(
            "$I_1 = I_2 = I_3$",
            r"$\mathbf{m}(0)=(0,0,m_3)^T$",
            r"$m_3>-\alpha I_0$ (the paper does not except the rest)",
        ),
        quote=r"the ball launched with initial vector of angular velocity parallel to the vector of magnetic field",
    ),
    "(30)": Equation(
        alias="mf40",
        kind="claim",
        says=r"A ball launched along $\mathbf{B}$ turns about $\mathbf{B}$ steadily",
        tex=r"R=\begin{pmatrix} \cos(m_3t/I_0) & -\sin(m_3t/I_0) & 0 \\ \sin(m_3t/I_0) "
        r"& \cos(m_3t/I_0) & 0 \\ 0 & 0 & 1 \end{pmatrix}",
        assumptions=("$I_1 = I_2 = I_3$", r"$\mathbf{m}(0)$ along $\mathbf{B}$"),
    ),
}
