"""Section IV, first half: the symmetric body and the cubic pseudo-oscillator, (31) to (49)."""

from atlas.trial.ledger.equation import FIELD, SYMMETRIC, Equation

EQUATIONS = {
    "text-mass-matrix": Equation(
        says="Mass matrix of the symmetric body",
        tex=r"g=\frac12 \,\mathrm{diag}(I_3,I_3,2I_2-I_3)",
        assumptions=(SYMMETRIC,),
    ),
    "text-laboratory": Equation(
        says="The laboratory may be turned about $\\mathbf{e}_3$ until the field lies in the plane of "
        "$\\mathbf{e}_2$ and $\\mathbf{e}_3$",
        tex=r"""S\,\mathbb{I}\,S^T=\mathbb{I},\qquad S\mathbf{B}=(0,B_2,B_3)^T""",
        assumptions=(SYMMETRIC, r"$S$ is a rotation about $\mathbf{e}_3$"),
        quote="without spoiling the diagonal form of inertia tensor in our equations, the Laboratory system can "
        "be chosen as shown",
    ),
    "(31)": Equation(
        alias="mf41.0",
        kind="definition",
        says="Initial angular velocity: the same components in both frames",
        tex=r"\boldsymbol{\Omega}(0)=\boldsymbol{\omega}(0)=(\omega_1, \omega_2, \omega_3)^T",
    ),
    "(32)": Equation(
        alias="mf41",
        kind="definition",
        says=r"The field in units of a frequency, $\mathbf{B}'$, and its components $\mathbf{K}$ in the body-fixed "
        "frame",
        tex=r"\mathbf{B}'\equiv\frac{\mu}{2c}\mathbf{B}= \begin{pmatrix} 0\\ B'_2>0 \\ B'_3>0 \end{pmatrix}, "
        r"\qquad \mathbf{K}(t)\equiv\frac{\mu}{2c}\mathbf{B}R(t)=\begin{pmatrix} (\mathbf{B}'R)_1 \\ ("
        r"\mathbf{B}'R)_2 \\ (\mathbf{B}'R)_3 \end{pmatrix}, \qquad \text{then} \quad \mathbf{K}(0)="
        r"\mathbf{B}'",
        assumptions=(FIELD,),
    ),
    "(33)": Equation(
        alias="mf41.1",
        kind="definition",
        says="The ratio of moments $I$ and the energy $E'$",
        tex=r"I\equiv\frac{I_3}{I_2}, \qquad E'\equiv\frac{2E}{I_2}",
    ),
    "(34)": Equation(
        alias="mf42",
        says=r"Euler equations through $\mathbf{K}$",
        tex=r"\mathbb{I}\dot{\boldsymbol{\Omega}}=[\mathbb{I}\boldsymbol{\Omega}, \boldsymbol{\Omega}]-2["
        r"\mathbf{K}g, \boldsymbol{\Omega}]",
        assumptions=(SYMMETRIC,),
    ),
    "(35)": Equation(
        alias="mf43",
        says="Rate of the field seen from the body",
        tex=r"\dot{\mathbf{K}}=-[\boldsymbol{\Omega}, \mathbf{K}]",
        assumptions=("$R(t)$ is a rotation",),
    ),
    "(36)": Equation(
        alias="mf44",
        says="First integral: energy",
        tex=r"\Omega_1^2+\Omega_2^2+I\Omega_3^2=E'=\omega_1^2+\omega_2^2+I\omega_3^2",
        assumptions=(SYMMETRIC,),
    ),
    "(37)": Equation(
        alias="mf45",
        says="Second integral: length of the field",
        tex=r"\mathbf{K}^2={B'_2}^2+{B'_3}^2",
        assumptions=("$R(t)$ is a rotation",),
    ),
    "(38)": Equation(
        alias="mf46",
        says="Euler equations of the symmetric body in components",
        tex=r"\begin{aligned} "
        r"\dot\Omega_1&=(1-I)\Omega_3\Omega_2-I\Omega_3 K_2+(2-I)\Omega_2 K_3,\\ "
        r"\dot\Omega_2&=-(1-I)\Omega_3\Omega_1+I\Omega_3 K_1-(2-I)\Omega_1 K_3,\\ "
        r"\dot\Omega_3&=\Omega_1 K_2-\Omega_2 K_1 "
        r"\end{aligned}",
        assumptions=(SYMMETRIC,),
    ),
    "(39)": Equation(
        alias="mf47",
        says="Rate of the field seen from the body in components",
        tex=r"\begin{aligned} "
        r"\dot K_1&=\Omega_3 K_2-\Omega_2 K_3,\\ "
        r"\dot K_2&=-\Omega_3 K_1+\Omega_1 K_3,\\ "
        r"\dot K_3&=-(\Omega_1 K_2-\Omega_2 K_1) "
        r"\end{aligned}",
        assumptions=("$R(t)$ is a rotation",),
    ),
    "(40)": Equation(
        alias="mf48",
        says="Third integral $c_3$",
        tex=r"K_3+\Omega_3=c_3=\omega_3+B'_3",
        assumptions=(SYMMETRIC,),
    ),
    "(41)": Equation(
        alias="mf49",
        says="Fourth integral $c_5$",
        tex=r"\Omega_1 K_1+\Omega_2 K_2-\Omega_3^2+(2-I)c_3\Omega_3=c_5=\omega_2 B'_2-\omega_3^2+(2-I)(\omega_3+"
        r"B'_3)\omega_3",
        assumptions=(SYMMETRIC,),
    ),
    "text-four-integrals": Equation(
        says="The four integrals @(36), @(37), @(40), @(41) are independent",
        tex=r"\mathrm{rank}\,\frac{\partial(E',\mathbf{K}^2,c_3,c_5)}{\partial(\boldsymbol{\Omega},\mathbf{K})}="
        "4",
        assumptions=(SYMMETRIC,),
        quote="This system admits four integrals of motion",
    ),
    "(42)": Equation(
        alias="mf50",
        says="The field in the body-fixed frame through the angular velocity",
        tex=r"\begin{aligned} "
        r"K_1&=\frac{\Omega_1(\Omega_3^2-(2-I)c_3\Omega_3+c_5)-\Omega_2\dot\Omega_3}{E'-I\Omega_3^2},\\ "
        r"K_2&=\frac{\Omega_2(\Omega_3^2-(2-I)c_3\Omega_3+c_5)+\Omega_1\dot\Omega_3}{E'-I\Omega_3^2},\\ "
        r"K_3&=-\Omega_3+c_3 "
        r"\end{aligned}",
        assumptions=(SYMMETRIC, r"$E' - I \Omega_3^2$ differs from 0"),
    ),
    "(43)": Equation(
        alias="mf51",
        says=r"Linear equations for $\Omega_1$, $\Omega_2$ when $\Omega_3$ is known",
        tex=r"\dot\Omega_1=\phi(t)\Omega_2+\dot f(t)\Omega_1, \qquad \dot\Omega_2=-\phi(t)\Omega_1+\dot f(t)"
        r"\Omega_2",
        assumptions=("$E'-I\\Omega_3^2$ differs from 0", SYMMETRIC),
    ),
    "(44)": Equation(
        alias="mf52",
        says="Coefficients of these linear equations",
        tex=r"\phi(t)\equiv\frac{(2-I)c_3E'-(E'+Ic_5)\Omega_3(t)}{E'-I\Omega_3^2(t)}, \qquad f(t)=\ln\sqrt{E'-I"
        r"\Omega_3^2(t)}",
        assumptions=("$E'-I\\Omega_3^2$ differs from 0", SYMMETRIC, "$f$ is meant up to a constant"),
    ),
    "(45)": Equation(
        alias="mf53",
        says=r"$\Omega_1$, $\Omega_2$ by quadratures",
        tex=r"\Omega_1(t)=f_0\sqrt{E'-I\Omega_3^2(t)}\sin(\Phi(t)+\phi_0), \qquad \Omega_2(t)=f_0\sqrt{E'-I"
        r"\Omega_3^2(t)}\cos(\Phi(t)+\phi_0)",
        assumptions=("$E'-I\\Omega_3^2$ differs from 0", SYMMETRIC),
    ),
    "(46)": Equation(
        alias="mf54",
        says=r"Second derivative of $\Omega_3$",
        tex=r"\ddot\Omega_3=[-2\Omega_3+(2-I)c_3](\Omega_1 K_1+\Omega_2 k_2)-I\Omega_3(K_1^2+K_2^2)+[c_3-\Omega"
        r"_3](\Omega_1^2+\Omega_2^2)",
        assumptions=(SYMMETRIC,),
    ),
    "(47)": Equation(
        alias="mf55",
        kind="claim",
        says=r"$\Omega_3$ of any motion obeys a cubic pseudo-oscillator",
        tex=r"\ddot\Omega_3=a_0+a_1\Omega_3+a_2\Omega_3^2+a_3\Omega_3^3",
        assumptions=(SYMMETRIC,),
    ),
    "(48)": Equation(
        alias="mf56",
        says="Coefficients of the cubic",
        tex=r"\begin{aligned} "
        r"a_0(\boldsymbol{\omega}, \mathbf{B}')&=[(2-I)c_5+ E']c_3,\\ "
        r"a_1(\boldsymbol{\omega}, \mathbf{B}')&=-2c_5+[I-(2-1)^2]c_3^2-E'-I{\mathbf{B}'}^2,\\ "
        r"a_2(\boldsymbol{\omega}, \mathbf{B}')&=6(1-I)c_3,\\ "
        "a_3&=-2(1-I) "
        r"\end{aligned}",
        assumptions=(SYMMETRIC,),
    ),
    "text-cubic-degree": Equation(
        says="The polynomial on the right side of @(47) has the degree three",
        tex=r"""a_3=-2(1-I)\ne0""",
        assumptions=("$I$ differs from 1 (the paper does not except it)",),
        quote="a root of the third degree polynomial",
    ),
    "(49)": Equation(
        alias="mf57",
        says="The cubic through the initial data",
        tex=r"\begin{aligned} "
        r"\ddot\Omega_3=&[(2-I)B'_3-I\omega_3+2(\omega_3-\Omega_3)][\omega_2B'_2-(\omega_3^2-\Omega_3^2)+(2-"
        r"I)(B'_3+\omega_3)(\omega_3-\Omega_3)]\\ "
        r"&-I\Omega_3[{\mathbf{B}'}^2-(B'_3+(\omega_3-\Omega_3))^2]+[B'_3+(\omega_3-\Omega_3)][\omega_1^2+"
        r"\omega_2^2+I(\omega_3^2-\Omega_3^2)] "
        r"\end{aligned}",
        assumptions=(SYMMETRIC,),
    ),
}
