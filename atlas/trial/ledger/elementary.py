"""Section V, second half: the elementary motion, (73) to (88)."""

from atlas.trial.ledger.equation import FIELD, OFF_LINES, Equation

EQUATIONS = {
    "(73)": Equation(
        alias="mf78",
        kind="claim",
        says="Angular velocity of the elementary motion",
        tex=r"\boldsymbol{\Omega}(t)=\begin{pmatrix} \omega_2\sin\phi t \\ \omega_2\cos\phi t \\ \omega_3(\omega"
        r"_2) \end{pmatrix}, \qquad \text{then} \quad \boldsymbol{\Omega}(0)=\begin{pmatrix} 0 \\ \omega_2 "
        r"\\ \omega_3(\omega_2) \end{pmatrix}",
        assumptions=(FIELD, OFF_LINES),
    ),
    "text-body-precession": Equation(
        says="In the body-fixed frame the angular velocity precesses about the third axis with the frequency $\\phi$",
        tex=r"""\dot{\boldsymbol{\Omega}}=-\phi\,[\mathbf{e}_3,\boldsymbol{\Omega}]""",
        assumptions=(FIELD, OFF_LINES),
        quote=r"vector of angular velocity in the body-fixed frame $\mathbf{R}_i$ precesses around the third axis "
        r"$\mathbf{R}_3$ with the frequency $\phi$",
    ),
    "(74)": Equation(
        alias="mf79",
        says="Poisson equations for a row of $R$",
        tex=r"\dot{\boldsymbol{\gamma}}=[\boldsymbol{\gamma}, \boldsymbol{\Omega}(t)]",
    ),
    "(75)": Equation(
        alias="mf80",
        says="Poisson equations for a row of $R$ in components",
        tex=r"\begin{aligned} "
        r"\dot\gamma_1&=\gamma_2\omega_3-\gamma_3\Omega_2(t),\\ "
        r"\dot\gamma_2&=\gamma_3\Omega_1(t)-\gamma_1\omega_3,\\ "
        r"\dot\gamma_3&=\gamma_1\Omega_2(t)-\gamma_2\Omega_1(t) "
        r"\end{aligned}",
    ),
    "(76)": Equation(
        alias="mf81",
        says="An integral of the rows",
        tex=r"\Omega_1\gamma_1+\Omega_2\gamma_2+\frac{\hat{B}_3\omega_2}{\hat{B}_2}\gamma_3=c",
        assumptions=(FIELD, OFF_LINES),
    ),
    "(77)": Equation(
        alias="mf82",
        says="One ratio of the components of the field",
        tex=r"\frac{B'_3}{B'_2}=\frac{B_3}{B_2}=\frac{\hat{B}_3}{\hat{B}_2}",
        assumptions=(FIELD,),
    ),
    "text-row-constants": Equation(
        says="The constants $c$ of the three rows",
        tex=r"c_1=0,\qquad c_2=\omega_2,\qquad c_3=\frac{\hat{B}_3\omega_2}{\hat{B}_2}",
        assumptions=(FIELD,),
    ),
    "(78)": Equation(
        alias="mf83",
        says="First two entries of a row through the third",
        tex=r"\gamma_1=\frac{1}{\omega_2^2}\Bigl[\Omega_1\Bigl(c-\frac{\hat{B}_3\omega_2}{\hat{B}_2}\gamma_3"
        r"\Bigr)+\Omega_2\dot\gamma_3\Bigr],\qquad\gamma_2=\frac{1}{\omega_2^2}\Bigl[\Omega_2\Bigl(c-\frac{"
        r"\hat{B}_3\omega_2}{\hat{B}_2}\gamma_3\Bigr)-\Omega_1\dot\gamma_3\Bigr]",
        assumptions=(r"$\omega_2$ differs from 0",),
    ),
    "(79)": Equation(
        alias="mf84",
        says="The third entry of a row is a harmonic oscillator with frequency $k$",
        tex=r"\ddot\gamma_3+k^2\gamma_3=c\frac{\hat{B}_3\omega_2}{\hat{B}_2}, \qquad \text{where} \quad k=\frac{"
        r"\omega_2}{\hat{B}_2}",
        assumptions=(FIELD, OFF_LINES),
    ),
    "(80)": Equation(
        alias="mf85",
        says="General solution for the third entry of a row",
        tex=r"\gamma_3(t)=b\cos(kt+k_0)+c\frac{\hat{B}_3\omega_2}{\hat{B}_2 k^2}",
        assumptions=(FIELD, r"$\omega_2$ differs from 0"),
    ),
    "(81)": Equation(
        alias="mf86",
        says="First two entries of a row at any time",
        tex=r"\begin{aligned} "
        r"\gamma_1(t)&=\frac{1}{\omega_2}\Bigl[c-b\frac{\hat{B}_3\omega_2}{\hat{B}_2}\cos(kt+k_0)-c\hat{B}"
        r"_3^2\Bigr]\sin\phi t-\frac{b}{\hat{B}_2}\sin(kt+k_0)\cos\phi t,\\ "
        r"\gamma_2(t)&=\frac{1}{\omega_2}\Bigl[c-b\frac{\hat{B}_3\omega_2}{\hat{B}_2}\cos(kt+k_0)-c\hat{B}"
        r"_3^2\Bigr]\cos\phi t+\frac{b}{\hat{B}_2}\sin(kt+k_0)\sin\phi t "
        r"\end{aligned}",
        assumptions=(FIELD, r"$\omega_2$ differs from 0"),
    ),
    "(82)": Equation(
        alias="mf87",
        says="A row at $t = 0$",
        tex=r"\begin{aligned} "
        r"\gamma_1(0)&=-\frac{b}{\hat{B}_2}\sin k_0,\\ "
        r"\gamma_2(0)&=\frac{1}{\omega_2}[c-b\frac{\hat{B}_3\omega_2}{\hat{B}_2}\cos k_0- c\hat{B}_3^2],\\ "
        r"\gamma_3(0)&=b\cos k_0+c\frac{\hat{B}_2\hat{B}_3}{\omega_2} "
        r"\end{aligned}",
        assumptions=(FIELD, r"$\omega_2$ differs from 0"),
    ),
    "(83)": Equation(
        alias="mf88",
        says="The constants of the three rows",
        tex=r"\begin{aligned} "
        r"c&=0,&b&=-\hat{B}_2,&k_0&=\frac{\pi}{2};\\ "
        r"c&=\omega_2,&b&=-\hat{B}_2\hat{B}_3,&k_0&=0;\\ "
        r"c&=\frac{\hat{B}_3\omega_2}{\hat{B}_2},&b&=1-\hat{B}_3^2=\hat{B}_2^2,&k_0&=0 "
        r"\end{aligned}",
        assumptions=("$\\omega_2$ differs from 0", FIELD),
    ),
    "(84)": Equation(
        alias="mf89",
        kind="claim",
        says="Rotation matrix of the elementary motion",
        tex=r"\begin{pmatrix} \cos kt\cos\phi t-\hat{B}_3\sin kt\sin\phi t & -\cos kt\sin\phi t-\hat{B}_3\sin kt"
        r"\cos\phi t & \hat{B}_2\sin kt \\ \hat{B}_3 \sin kt\cos\phi t+(\hat{B}_2^2 +\hat{B}_3^2\cos kt)\sin"
        r"\phi t & -\hat{B}_3 \sin kt\sin\phi t+(\hat{B}_2^2 +\hat{B}_3^2\cos kt)\cos\phi t & \hat{B}_2"
        r"\hat{B}_3(1-\cos kt) \\ -\hat{B}_2 \sin kt\cos\phi t+\hat{B}_2 \hat{B}_3(1-\cos kt)\sin\phi t & "
        r"\hat{B}_2 \sin kt\sin\phi t+\hat{B}_2 \hat{B}_3(1-\cos kt)\cos\phi t & \hat{B}_3^2 +\hat{B}_2^2"
        r"\cos kt \end{pmatrix}",
        assumptions=(FIELD, OFF_LINES, r"$k = \omega_2/\hat{B}_2$, $\phi$ of @(72)"),
    ),
    "text-hidden": Equation(
        says=r"Of the moments and of $\mu$ the matrix @(84) knows only through $\phi$: $k$ does not depend on them",
        tex=r"""k=\frac{\omega_2\lvert\mathbf{B}\rvert}{B_2}""",
        assumptions=(FIELD,),
        quote="The dependence of the rotation matrix on the inertia moments $I_2$, $I_3$ as well as on the "
        r"charge-mass ratio $\mu$ is hidden in the frequency $\phi$",
    ),
    "(85)": Equation(
        alias="mf90",
        kind="claim",
        says=r"The rotation matrix is a proper rotation followed by a precession about $\mathbf{B}$",
        tex=r"R(t)=R_{\hat{\mathbf{B}}}(t,k)\times R_{OZ}(t,\phi)=\begin{pmatrix}\cos kt&-\hat{B}_3\sin kt&"
        r"\hat{B}_2\sin kt\\\hat{B}_3\sin kt&\hat{B}_2^2+\hat{B}_3^2\cos kt&\hat{B}_2\hat{B}_3(1-\cos kt)\\-"
        r"\hat{B}_2\sin kt&\hat{B}_2\hat{B}_3(1-\cos kt)&\hat{B}_3^2+\hat{B}_2^2\cos kt\end{pmatrix}\times"
        r"\begin{pmatrix}\cos\phi t&-\sin\phi t&0\\\sin\phi t&\cos\phi t&0\\0&0&1\end{pmatrix}",
        assumptions=(FIELD,),
    ),
    "text-precession": Equation(
        says=r"The two factors of @(85) turn about $\mathbf{B}$ by $kt$ and about $OZ$ by $\phi t$",
        tex=r"R_{\hat{\mathbf{B}}}(t,k)=\cos kt\,\mathbf{1}+(1-\cos kt)\,\hat{\mathbf{B}}\hat{\mathbf{B}}^T+"
        r"\sin kt\,[\hat{\mathbf{B}},\cdot\,]",
        assumptions=(FIELD,),
        quote=r"first around the laboratory axis $OZ$ by the angle $\phi t$ and then around the $\mathbf{B}$-axis "
        "by the angle $kt$",
    ),
    "text-axis-precesses": Equation(
        says="The third inertia axis precesses about the field with the frequency $k$",
        tex=r"""\dot{\mathbf{R}}_3=k\,[\hat{\mathbf{B}},\mathbf{R}_3]""",
        assumptions=(FIELD, OFF_LINES),
        quote="the motion is the composition of a proper rotation around third inertia axis with precession of "
        "this axis around the vector of magnetic field",
    ),
    "text-ball-limit": Equation(
        says=r"For $I_2 = I_3$ there is no proper rotation: $\phi = 0$",
        tex=r"I_2=I_3\implies\phi=0",
        assumptions=(FIELD, OFF_LINES),
        quote=r"admits the limit of totally symmetric body $I_2=I_3$, this implies $\phi=0$",
    ),
    "(86)": Equation(
        alias="mf91",
        kind="claim",
        says="Relation between the two frequencies",
        tex=r"\phi_B=\frac{(I_2-I_3)\hat{B}_3(2\lvert \mathbf{B}'\rvert+k_B)}{I_3(\lvert \mathbf{B}'\rvert+"
        "k_B)}k_B",
        assumptions=(FIELD, OFF_LINES),
    ),
    "text-free-general": Equation(
        says="Every motion of a free symmetrical body is a precession without nutation: its axis turns about "
        "$\\mathbf{m}$ with the frequency $|\\mathbf{m}|/I_2$",
        tex=r"""\dot{\mathbf{R}}_3=\frac{1}{I_2}[\mathbf{m},\mathbf{R}_3],\qquad(\mathbf{m},\mathbf{R}_3)=\text{const}""",
        assumptions=("no magnetic field", "$I_1 = I_2$"),
        quote="the most general motion of a free symmetrical body is the precession without nutation",
    ),
    "(87)": Equation(
        alias="mf92",
        kind="claim",
        says="Proper rotation of the free body beside it",
        tex=r"\phi=\frac{I_2-I_3}{I_3}\hat{B}_3k_B",
        assumptions=(FIELD, "no magnetic field"),
    ),
    "text-affirmation-free": Equation(
        says="Affirmation: the matrix @(84) with the frequency @(87) is the motion of the free body launched "
        r"with $\boldsymbol{\Omega}(0) = (0, \omega_2, I_2 \omega_2 B_3/(I_3 B_2))$",
        tex=r"\boldsymbol{\Omega}(0)=\Bigl(0,\omega_2,\frac{I_2\omega_2B_3}{I_3B_2}\Bigr)^T,\qquad\mathbf{m}="
        r"\frac{I_2\omega_2}{B_2}\mathbf{B}",
        assumptions=(FIELD, "no magnetic field"),
    ),
    "text-free-frequency": Equation(
        says=r"The free body precesses with $k = |\mathbf{m}|/I_2 = \omega_2/\hat{B}_2$",
        tex=r"k=\frac{\lvert\mathbf{m}\rvert}{I_2}=\frac{\omega_2}{\hat{B}_2}=k_B",
        assumptions=(FIELD, "no magnetic field"),
    ),
    "text-free-proper": Equation(
        says="Proper rotation of the free body through its angular momentum",
        tex=r"""\phi=\frac{I_2-I_3}{I_2I_3}m_3=\frac{I_2-I_3}{I_3}\hat{B}_3\frac{\omega_2}{\hat{B}_2}=\frac{I_2-I_3}{I_3}\hat{B}_3k_B""",
        assumptions=(FIELD, "no magnetic field"),
    ),
    "text-momentum-moves": Equation(
        says="The components of angular momentum are not conserved in the elementary motion",
        tex=r"\dot{\mathbf{m}}\ne0",
        assumptions=(FIELD, OFF_LINES, "$I$ differs from 1, $\\omega_2$ from 0"),
        quote=r"Components of angular momentum $\mathbf{m}(t)$ for our solutions in elementary functions are not "
        "conserved quantities",
    ),
    "text-constant-omega3": Equation(
        says=r"In the elementary motion $\Omega_3(t) = \omega_2 = \text{const}$",
        tex=r"\Omega_3(t)=\omega_2=\text{const}",
        assumptions=(FIELD, OFF_LINES),
    ),
    "(88)": Equation(
        alias="mf93",
        kind="claim",
        says=r"The projection of the angular momentum on $\mathbf{B}$ is conserved in the elementary motion",
        tex=r"(\mathbf{m}(t), \mathbf{B})=\text{const}",
        assumptions=(FIELD, OFF_LINES),
    ),
    "text-momentum-plane": Equation(
        says=r"The angular momentum always lies in the plane orthogonal to $\mathbf{B}$",
        tex=r"(\mathbf{m}(t),\mathbf{B})=0",
        assumptions=(FIELD, OFF_LINES),
        quote="the angular momentum always lies in the plane orthogonal to the constant vector of magnetic field",
    ),
}
