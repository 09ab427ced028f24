"""Section IV, second half: the quadric of constant solutions, (50) to (57)."""

from atlas.trial.ledger.equation import FIELD, SYMMETRIC, Equation

EQUATIONS = {
    "(50)": Equation(
        alias="mf58.1",
        says=r"Condition on the initial data for a constant $\Omega_3$",
        tex=r"B'_3(\omega_1^2+\omega_2^2)-IB'_2\omega_2\omega_3+(2-I)B'_2B'_3\omega_2-I{B'_2}^2\omega_3=0",
        assumptions=(SYMMETRIC, FIELD),
    ),
    "(51)": Equation(
        alias="mf58",
        says="The same condition: a surface of second order",
        tex=r"\omega_1^2+(\omega_2+B'_2)^2-\frac{IB'_2}{B'_3}(\omega_2+B'_2)(\omega_3+B'_3)=(1-I){B'_2}^2",
        assumptions=(SYMMETRIC, FIELD),
    ),
    "text-quadric-origin": Equation(
        says="The surface passes through the origin",
        tex=r"\omega_1=\omega_2=\omega_3=0\quad\text{obeys (51)}",
        assumptions=(FIELD,),
        quote="the surface always pass through the origin of coordinate system",
    ),
    "(52)": Equation(
        alias="mf59",
        says=r"The condition resolved for $\omega_3$: a two-parametric family of constant solutions",
        tex=r"\begin{aligned} "
        r"\Omega_3(t)&=\omega_3(\omega_1, \omega_2)=\frac{B'_3[\omega_1^2+\omega_2^2+(2-I)B'_2\omega"
        r"_2]}{IB'_2(\omega_2+B'_2)},\\ "
        r"\omega_1&\in\mathbb{R},\\ "
        r"\omega_2&\in\mathbb{R}\setminus \{-B'_2\} "
        r"\end{aligned}",
        assumptions=(FIELD,),
    ),
    "(53)": Equation(
        alias="mf61",
        kind="definition",
        says="Canonical coordinates of the quadric",
        tex=r"\begin{aligned} "
        r"\omega'_1&=\omega_1,\\ "
        r"\omega'_2&=(\omega_2+B'_2)\cos\left(\frac{\beta}{2}+\frac{\pi}{4}\right)+(\omega_3+B'_3)\sin\left("
        r"\frac{\beta}{2}+\frac{\pi}{4}\right),\\ "
        r"\omega'_3&=-(\omega_2+B'_2)\sin\left(\frac{\beta}{2}+\frac{\pi}{4}\right)+(\omega_3+B'_3)\cos\left"
        r"(\frac{\beta}{2}+\frac{\pi}{4}\right) "
        r"\end{aligned}",
        assumptions=(FIELD, r"$\tan\beta = B'_3/(I B'_2)$"),
    ),
    "text-turned": Equation(
        says="The canonical coordinates are those from the origin $-\\mathbf{B}'$ along axes turned "
        "counter-clockwise by $\\beta/2+\\pi/4$",
        tex=r"""\boldsymbol{\omega}+\mathbf{B}'=\sum_i\omega'_i\mathbf{e}'_i,\qquad\mathbf{e}'_2=\cos\Bigl(\frac{\beta}{2}+\frac{\pi}{4}\Bigr)\mathbf{e}_2+\sin\Bigl(\frac{\beta}{2}+\frac{\pi}{4}\Bigr)\mathbf{e}_3""",
        assumptions=(FIELD,),
        quote=r"by shifting the origin of coordinate system to the point $-\mathbf{B}'$, and subsequent rotation "
        "counter-clockwise",
    ),
    "text-beta": Equation(
        says=r"$\beta$, the angle between $\mathbf{e}_2$ and $I^{-1} \mathbf{B}'$, has $\tan\beta = B'_3/(I B'_2)$",
        tex=r"\tan\beta=\frac{B'_3}{IB'_2}",
        assumptions=(FIELD,),
    ),
    "text-beta-range": Equation(
        says=r"The canonical axes are turned by more than $\pi/4$ and less than $\pi/2$",
        tex=r"\frac{\pi}{4}<\frac{\beta}{2}+\frac{\pi}{4}<\frac{\pi}{2}",
        assumptions=(FIELD,),
    ),
    "(54)": Equation(
        alias="mf60",
        says="The quadric in canonical form",
        tex=r"\begin{aligned} "
        r"{\omega'_1}^2-\frac{{\omega'_2}^2}{a_2}+\frac{{\omega'_3}^2}{a_3}&=(1-I){B'_2}^2,\\ "
        r"\text{where}\quad a_2&\equiv\frac{2\sin\beta}{1-\sin\beta},\\ "
        r"a_3&\equiv\frac{2\sin\beta}{1+\sin\beta} "
        r"\end{aligned}",
        assumptions=(FIELD,),
    ),
    "(55)": Equation(
        alias="mf61",
        kind="claim",
        says="$I > 1$: a hyperboloid of two sheets",
        tex=r"\begin{aligned} "
        r"\frac{{\omega'_1}^2}{C_1^2}-\frac{{\omega'_2}^2}{C_2^2}+\frac{{\omega'_3}^2}{C_3^2}&=-1,\\ "
        r"\text{where}\quad C_1^2&\equiv(I-1){B'_2}^2,\\ "
        r"C_2^2&\equiv\frac{2(I-1){B'_2}^2\sin\beta}{1-\sin\beta},\\ "
        r"C_3^2&\equiv\frac{2(I-1){B'_2}^2\sin\beta}{1+\sin\beta} "
        r"\end{aligned}",
        assumptions=(FIELD, r"$1 < I \le 2$"),
    ),
    "text-two-sheets": Equation(
        says="For $I > 1$ the squared semi-axes are positive: the surface is a hyperboloid of two sheets",
        tex=r"C_1^2>0,\qquad C_2^2>0,\qquad C_3^2>0",
        assumptions=(FIELD, r"$1 < I \le 2$"),
        quote="Hence the surface of initial data is a hyperboloid of two sheets",
    ),
    "text-short-cylinder": Equation(
        says="A sufficiently short cylindrical surface has $1 < I < 2$, a long one $0 < I < 1$",
        tex=r"I=\frac{12r^2}{6r^2+h^2}>1\iff h<\sqrt6\,r",
        assumptions=("shell of radius $r$, height $h$ and mass $m_0$: $I_3=m_0r^2$, $I_2=m_0r^2/2+m_0h^2/12$",),
        quote="This body could be a charged sufficiently short cylindrical surface",
    ),
    "text-plane-body": Equation(
        says="$I = 2$ is a plane body",
        tex=r"I=2\iff g_3=0",
        assumptions=("$I_1 = I_2$",),
    ),
    "text-tangent-planes": Equation(
        says=r"$I = 2$: the two sheets touch the planes $\omega_3 = 0$ and $\omega_3 = -2 B'_3$",
        tex=r"I=2:\quad\omega_3\ge0\ \text{or}\ \omega_3\le-2B'_3",
        assumptions=(FIELD, "$I = 2$"),
        quote="the sheets of the hyperboloid are tangent to the horizontal planes",
    ),
    "(56)": Equation(
        alias="mf62",
        kind="claim",
        says="$I = 1$: a cone",
        tex=r"{\omega'_1}^2+\frac{{\omega'_3}^2}{a_3}=\frac{{\omega'_2}^2}{a_2}",
        assumptions=(FIELD, "$I = 1$"),
    ),
    "text-cone-semi-axes": Equation(
        says="The cone @(56) has the semi-axes $a_2$ and $a_3$ of @(54)",
        tex=r"{\omega'_1}^2+\frac{{\omega'_3}^2}{a_3^2}=\frac{{\omega'_2}^2}{a_2^2}",
        assumptions=(FIELD, "$I = 1$"),
        quote="turn into the cone [...] with semi axes $a_2$ and $a_3$ written in equation (54)",
    ),
    "(57)": Equation(
        alias="mf63",
        kind="claim",
        says="$I < 1$: a hyperboloid of one sheet",
        tex=r"\begin{aligned} "
        r"\frac{{\omega'_1}^2}{C_1^2}-\frac{{\omega'_2}^2}{C_2^2}+\frac{{\omega'_3}^2}{C_3^2}&=1,\\ "
        r"\text{where}\quad C_1^2&\equiv(1-I){B'_2}^2,\\ "
        r"C_2^2&\equiv\frac{2(1-I){B'_2}^2\sin\beta}{1-\sin\beta},\\ "
        r"C_3^2&\equiv\frac{2(1-I){B'_2}^2\sin\beta}{1+\sin\beta} "
        r"\end{aligned}",
        assumptions=(FIELD, "$0 < I < 1$"),
    ),
    "text-one-sheet": Equation(
        says="For $I < 1$ the squared semi-axes are positive: the surface is a hyperboloid of one sheet",
        tex=r"C_1^2>0,\qquad C_2^2>0,\qquad C_3^2>0",
        assumptions=(FIELD, "$0 < I < 1$"),
        quote="Hence the surface of initial data is a hyperboloid of one sheet",
    ),
    "text-not-all": Equation(
        says="Not all constant solutions of the pseudo-oscillator are motions of the body",
        tex=r"\omega_1B'_2\ne0\implies\dot\Omega_3(0)\ne0",
        assumptions=(FIELD,),
        quote="Not all of them generate solutions to the original problem",
    ),
}
