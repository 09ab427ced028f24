"""What the atlas adds to the paper."""

from atlas.trial.ledger.equation import FIELD, OFF_LINES, SYMMETRIC, Equation

EQUATIONS = {
    "theorem-quartic": Equation(
        says="First integral of the cubic pseudo-oscillator: a quartic with leading coefficient $I - 1$, and "
        "$Q'$ is twice the cubic",
        tex=r"\dot u^2=Q(u)=(E'-Iu^2)\left(b^2-(c_3-u)^2\right)-\left(u^2-(2-I)c_3u+c_5\right)^2,\qquad Q'(u)="
        "2(a_0+a_1u+a_2u^2+a_3u^3)",
        assumptions=(SYMMETRIC, r"$u = \Omega_3$, $b = |\mathbf{B}'|$"),
    ),
    "theorem-points": Equation(
        says="$\\Omega_3$ stays constant exactly if both its rates vanish at the start: of the quadric only the points"
        " with $\\omega_1=0$ are motions",
        tex=r"\begin{aligned} \Omega_3=\text{const}&\iff\dot\Omega_3(0)=0\ \text{and}\ \ddot\Omega_3(0)=0,\\ "
        r"\dot\Omega_3(0)&=\omega_1B'_2,\\ "
        r"\ddot\Omega_3(0)&=B'_3(\omega_1^2+\omega_2^2)-IB'_2\omega_2\omega_3+(2-I)B'_2B'_3\omega_2"
        r"-I{B'_2}^2\omega_3 \end{aligned}",
        assumptions=(SYMMETRIC, "$B'_2$ differs from 0, for the points of the quadric"),
    ),
    "theorem-stability": Equation(
        says="Square of the nutation frequency along the hyperbola, $Q$ being the quartic of @theorem-quartic",
        tex=r"\begin{aligned} \nu_n^2=-\tfrac12Q''(\omega_3)&={B'_2}^2\,\frac{(1+\tau^2)x^4+(1-I)(2\tau^2-1)x^2"
        r"+\tau^2(1-I)^2}{x^2}\\ &=w^2+(1-I)b^2(3\hat{B}_3^2-1)+(1-I)^2\frac{b^4\hat{B}_3^2}{w^2} \end{aligned}",
        assumptions=(
            SYMMETRIC,
            FIELD,
            OFF_LINES,
            "$\\tau=B'_3/B'_2$, $x=(\\omega_2+B'_2)/B'_2$, $b=|\\mathbf{B}'|$, $w=k+b$",
        ),
    ),
    "theorem-root": Equation(
        says="The quartic about an elementary motion: $\\omega_3$ is a double root of it, and a triple one where "
        "$\\nu_n$ vanishes",
        tex=r"Q(\omega_3+v)=v^2\left[-\nu_n^2+(1-I)\,v\,(4B'_3-v)\right],\qquad\nu_n^2=-\tfrac12Q''(\omega_3)",
        assumptions=(SYMMETRIC, "an elementary motion: $\\omega_1=0$ and @(50)"),
    ),
    "theorem-stable-short": Equation(
        says="For $I\\ge1$ the elementary motions are stable everywhere",
        tex=r"\nu_n^2=X^2+(I-1){B'_2}^2+\tau^2\,\frac{\left[X^2-(I-1){B'_2}^2\right]^2}{X^2}>(I-1){B'_2}^2\ge0,\qquad "
        r"X=\omega_2+B'_2",
        assumptions=(SYMMETRIC, FIELD, OFF_LINES, "$1\\le I\\le2$"),
    ),
    "theorem-band": Equation(
        says="For $I<1$ they are unstable exactly in a closed band of $x^2$, which is there exactly if"
        " $\\tau\\le1/(2\\sqrt2)$",
        tex=r"\nu_n^2\le0\iff y_-\le x^2\le y_+,\qquad y_\pm=(1-I)\frac{1-2\tau^2\pm\sqrt{1-8\tau^2}}{2(1+\tau^2)}"
        r",\qquad\tau\le\frac{1}{2\sqrt2}",
        assumptions=(SYMMETRIC, FIELD, OFF_LINES, "$0<I<1$"),
    ),
    "theorem-band-ends": Equation(
        says="The ends of the band belong to it: there $\\omega_3$ is a triple root of $Q$, and a motion with the same"
        " constants leaves the elementary one by $4B'_3$",
        tex=r"\nu_n=0:\qquad Q(\omega_3+v)=(1-I)\,v^3\,(4B'_3-v),\qquad "
        r"\Omega_3(t)=\omega_3+\frac{4B'_3}{1+4(1-I){B'_3}^2t^2}",
        assumptions=(SYMMETRIC, FIELD, "$0<I<1$"),
    ),
    "theorem-equatorial-stability": Equation(
        says="$B'_3=0$: nutation on the line $\\omega_2=-B'_2$ with any $\\omega_3$, and on the line $\\omega_3=0$",
        tex=r"\omega_2=-B'_2:\quad\nu_n^2=I^2\omega_3^2-(1-I){B'_2}^2,\qquad\omega_3=0:\quad\nu_n^2=(\omega_2+B'_2)^2"
        r"-(1-I){B'_2}^2",
        assumptions=(SYMMETRIC, "$\\mathbf{B}'=(0,B'_2,0)$"),
    ),
    "theorem-ball-nutation": Equation(
        says="$I=1$: a ball nutates with its angular velocity in Larmor's frame; only the motion"
        " $\\boldsymbol{\\omega}=-\\mathbf{B}'$ is unstable",
        tex=r"\nu_n^2=\lvert\boldsymbol{\omega}+\mathbf{B}'\rvert^2",
        assumptions=("$I=1$",),
    ),
    "theorem-ball-line": Equation(
        says=r"$I = 1$: every point of the line $\omega_1 = 0$, $\omega_2 = -B'_2$ is a motion",
        tex=r"R=R_{\hat{\mathbf{B}}}(-bt)\,R_{OZ}\left((\omega_3+B'_3)t\right)",
        assumptions=(FIELD, "$I = 1$"),
    ),
    "theorem-equatorial-field": Equation(
        says=r"$B'_3 = 0$: every point of the line $\omega_1 = 0$, $\omega_2 = -B'_2$ is a motion, for every $I$",
        tex=r"R=R_{OY}(-B'_2t)\,R_{OZ}(\omega_3t)",
        assumptions=(r"$\mathbf{B}' = (0, B'_2, 0)$",),
    ),
    "theorem-quadric-lines": Equation(
        says=r"$I < 1$: the quadric holds the two lines $\omega_2 = -B'_2$, $\omega_1 = \pm \sqrt{1-I} B'_2$, "
        r"$\omega_3$ free, which @(52) loses",
        tex=r"\omega_2=-B'_2,\qquad\omega_1=\pm\sqrt{1-I}\,B'_2",
        assumptions=(FIELD, "$0 < I < 1$"),
    ),
    "theorem-momentum": Equation(
        says=r"In the elementary motion the angular momentum precesses about $\mathbf{B}$ with the frequency $k$",
        tex=r"\dot{\mathbf{m}}=k[\hat{\mathbf{B}},\mathbf{m}]",
        assumptions=(FIELD, OFF_LINES),
    ),
    "theorem-moment": Equation(
        says="The torque on any charged body is that on the magnetic moment $(\\mu/2c)\\,\\mathbf{m}$ and a rate, which"
        " is zero for a ball",
        tex=r"\dot{\mathbf{m}}=\frac{\mu}{2c}\Bigl\{[\mathbf{m},\mathbf{B}]-\frac{d}{dt}\bigl(R\,\mathbb{I}\,R^T"
        r"\mathbf{B}\bigr)\Bigr\}",
        assumptions=(r"all particles have the same charge-to-mass ratio $\mu$",),
    ),
    "theorem-drift": Equation(
        says=r"The guiding centre drifts with $c [\mathbf{E}, \mathbf{B}]/\mathbf{B}^2$ whatever the charge",
        tex=r"\dot{\mathbf{O}}=\frac{c[\mathbf{E},\mathbf{B}]}{\mathbf{B}^2}",
        assumptions=(r"$\mathbf{B}$ along $\mathbf{e}_3$, $\mathbf{E}$ in the plane $(\mathbf{e}_2, \mathbf{e}_3)$",),
    ),
    "theorem-ball-rest": Equation(
        says=r"$m_2 = 0$, $m_3 = -\alpha I_0$: $\gamma = 0$ and the ball turns about $\mathbf{B}$ by $-\alpha t$",
        tex=r"R=R_{OZ}(-\alpha t)",
        assumptions=("$I_1 = I_2 = I_3$", r"$\mathbf{B}$ along $\mathbf{e}_3$"),
    ),
    "theorem-angles": Equation(
        says=r"Rates of the Euler angles about $\mathbf{B}$",
        tex=r"\dot\psi=\frac{P/b}{1-\nu^2},\qquad\dot\chi=u-\nu\dot\psi,\qquad\nu=\frac{c_3-u}{b}",
        assumptions=(
            SYMMETRIC,
            r"$z$ along $\mathbf{B}$, $\nu = K_3/b$, $P = \Omega_1 K_1 + \Omega_2 K_2$",
            "$b>0$, $|\\nu|<1$",
        ),
    ),
    "theorem-cayley-klein": Equation(
        says="Logarithmic derivatives of the Cayley–Klein parameters of the general motion",
        tex=r"\frac{\dot\xi}{\xi}=\frac12 \left[\frac{\dot\nu}{1+\nu}+i\left(\frac{P/b}{1+\nu}+u\right)"
        r"\right],\qquad\frac{\dot\eta}{\eta}=\frac12 \left[-\frac{\dot\nu}{1-\nu}+i\left(\frac{P/b}{1-\nu"
        r"}-u\right)\right]",
        assumptions=(
            SYMMETRIC,
            r"$z$ along $\mathbf{B}$",
            r"$\xi=\cos\frac{\theta}{2}\,e^{i(\psi+\chi)/2}$, $\eta=\sin\frac{\theta}{2}\,e^{i(\psi-\chi)/2}$",
            "$b>0$, $|\\nu|<1$",
        ),
    ),
}
