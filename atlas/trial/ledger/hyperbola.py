"""Section V, first half: the hyperbola of the motions, (58) to (72)."""

from atlas.trial.ledger.equation import FIELD, OFF_LINES, SYMMETRIC, Equation

EQUATIONS = {
    "(58)": Equation(
        alias="mf64",
        kind="definition",
        says="Motions with a constant third component of angular velocity are looked for",
        tex=r"\boldsymbol{\Omega}(t)=(\Omega_1(t), \Omega_2(t), \omega_3=\text{const})^T, \qquad \boldsymbol{"
        r"\Omega}(0)=(\omega_1, \omega_2, \omega_3)^T",
    ),
    "(59)": Equation(
        alias="mf65",
        says=r"Euler equations for a constant $\Omega_3$",
        tex=r"\begin{aligned} "
        r"\dot\Omega_1&=[(1-I)\omega_3+(2-I)B'_3]\Omega_2-I\omega_3K_2,\\ "
        r"\dot\Omega_2&=-[(1-I)\omega_3+(2-I)B'_3]\Omega_1+I\omega_3K_1,\\ "
        r"\Omega_1K_2-\Omega_2K_1&=0 "
        r"\end{aligned}",
        assumptions=(SYMMETRIC, r"$\Omega_3 = \omega_3 = \text{const}$"),
    ),
    "(60)": Equation(
        alias="mf66",
        says=r"Rate of the field seen from the body for a constant $\Omega_3$",
        tex=r"\dot K_1=\omega_3K_2-B'_3\Omega_2, \qquad \dot K_2=-\omega_3K_1+B'_3\Omega_1, \qquad K_3=B'_3",
        assumptions=(r"$\Omega_3 = \omega_3 = \text{const}$",),
    ),
    "(61)": Equation(
        alias="mf67",
        says=r"Three integrals for a constant $\Omega_3$",
        tex=r"\Omega_1^2(t)+\Omega_2^2(t)=\omega_1^2+\omega_2^2, \qquad K_1^2(t)+K_2^2(t)={B'_2}^2, \qquad "
        r"\Omega_1(t)K_1(t)+\Omega_2(t)K_2(t)=\omega_2B'_2",
        assumptions=(r"$\Omega_3 = \omega_3 = \text{const}$",),
    ),
    "(62)": Equation(
        alias="mf68",
        says=r"$K_1$, $K_2$ are proportional to $\Omega_1$, $\Omega_2$",
        tex=r"K_1=\frac{\omega_2B'_2}{\omega_1^2+\omega_2^2}\Omega_1, \qquad K_2=\frac{\omega_2B'_2}{\omega_1^2+"
        r"\omega_2^2}\Omega_2",
        assumptions=(r"$\Omega_3 = \omega_3 = \text{const}$", r"$\omega_1^2 + \omega_2^2 > 0$"),
    ),
    "(63)": Equation(
        alias="mf69",
        says=r"Precession of $\boldsymbol{\Omega}$ by the Euler equations",
        tex=r"\dot\Omega_1=\phi'\Omega_2,\quad\dot\Omega_2=-\phi'\Omega_1,\quad\text{where}\quad\phi'\equiv(1-I)"
        r"\omega_3+(2-I)B'_3-\frac{IB'_2\omega_2\omega_3}{\omega_1^2+\omega_2^2}",
        assumptions=("$\\omega_1^2+\\omega_2^2>0$", r"$\Omega_3 = \omega_3 = \text{const}$"),
    ),
    "(64)": Equation(
        alias="mf70",
        says=r"Precession of $\boldsymbol{\Omega}$ by the equations for $\mathbf{K}$",
        tex=r"\dot\Omega_1=\phi\Omega_2,\quad\dot\Omega_2=-\phi\Omega_1,\quad\text{where}\quad\phi\equiv\omega_3"
        r"-\frac{B'_3(\omega_1^2+\omega_2^2)}{B'_2\omega_2}",
        assumptions=(r"$\Omega_3 = \omega_3 = \text{const}$", r"$\omega_2$ differs from 0"),
    ),
    "(65)": Equation(
        alias="mf71",
        says="Both precessions agree",
        tex=r"B'_3(\omega_1^2+\omega_2^2)-IB'_2\omega_2\omega_3+(2-I)B'_2B'_3\omega_2-\frac{I{B'_2}^2\omega_2^2"
        r"\omega_3}{\omega_1^2+\omega_2^2}=0",
        assumptions=(r"$\omega_2$ differs from 0",),
    ),
    "(66)": Equation(
        alias="mf71.1",
        says="The necessary condition @(50) again",
        tex=r"B'_3(\omega_1^2+\omega_2^2)-IB'_2\omega_2\omega_3+(2-I)B'_2B'_3\omega_2-I{B'_2}^2\omega_3=0",
        assumptions=(FIELD,),
    ),
    "(67)": Equation(
        alias="mf72",
        says=r"The initial data of the motions: a hyperbola in the plane $\omega_1 = 0$",
        tex=r"B'_3\omega_2^2-IB'_2\omega_2\omega_3+(2-I)B'_2B'_3\omega_2-I{B'_2}^2\omega_3=0",
        assumptions=(FIELD, r"$\Omega_3 = \omega_3 = \text{const}$"),
    ),
    "text-combining": Equation(
        says=r"@(65) and @(66) together leave only $\omega_1 = 0$",
        tex=r"\text{(65), (66)}\implies\omega_1=0",
        assumptions=("$\\omega_2$ differs from 0", FIELD),
        quote="Combining this with the necessary condition [...], we conclude that the initial data should be "
        r"taken on the curve [...] that lie on the plane $\omega_1=0$",
    ),
    "(68)": Equation(
        alias="mf73",
        kind="claim",
        says="The hyperbola of the circular loop and the short solenoid",
        tex=r"\begin{aligned} "
        r"\frac{{\omega'_2}^2}{C_2^2}-\frac{{\omega'_3}^2}{C_3^2}&=1,\\ "
        r"\text{where}\quad C_2^2&\equiv\frac{2(I-1){B'_2}^2\sin\beta}{1-\sin\beta},\\ "
        r"C_3^2&\equiv\frac{2(I-1){B'_2}^2\sin\beta}{1+\sin\beta} "
        r"\end{aligned}",
        assumptions=(FIELD, r"$1 < I \le 2$"),
    ),
    "(69)": Equation(
        alias="mf74",
        kind="claim",
        says="The hyperbola of the long solenoid",
        tex=r"\begin{aligned} "
        r"-\frac{{\omega'_2}^2}{C_2^2}+\frac{{\omega'_3}^2}{C_3^2}&=1,\\ "
        r"\text{where}\quad C_2^2&\equiv\frac{2(1-I){B'_2}^2\sin\beta}{1-\sin\beta},\\ "
        r"C_3^2&\equiv\frac{2(1-I){B'_2}^2\sin\beta}{1+\sin\beta} "
        r"\end{aligned}",
        assumptions=(FIELD, "$0 < I < 1$"),
    ),
    "(70)": Equation(
        alias="mf75",
        kind="claim",
        says="The ball: the hyperbola degenerates into two lines",
        tex=r"\begin{aligned} "
        r"\frac{\omega'_2}{a_2}&=\pm\frac{\omega'_3}{a_3},\\ "
        r"\text{where}\quad a_2&\equiv\sqrt{\frac{2\sin\beta}{1-\sin\beta}},\\ "
        r"a_3&\equiv\sqrt{\frac{2\sin\beta}{1+\sin\beta}} "
        r"\end{aligned}",
        assumptions=(FIELD, "$I = 1$"),
    ),
    "(71)": Equation(
        alias="mf76",
        says=r"The hyperbola resolved for $\omega_3$",
        tex=r"\omega_3(\omega_2)=\frac{B'_3\omega_2[\omega_2+(2-I)B'_2]}{IB'_2(\omega_2+B'_2)}, \qquad \omega_2"
        r"\in\mathbb{R}\setminus\{-B'_2\}",
        assumptions=(FIELD,),
    ),
    "(72)": Equation(
        alias="mf77",
        says="Frequency of proper rotation",
        tex=r"\phi=\omega_3(\omega_2)-\frac{B'_3}{B'_2}\omega_2=\frac{B'_3\omega_2(1-I)(\omega_2+2B'_2)}{IB'_2("
        r"\omega_2+B'_2)}",
        assumptions=(FIELD, OFF_LINES),
    ),
}
