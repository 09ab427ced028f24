"""Where the quartic has a double root: steady precessions, their stability, and the second elementary family."""

from atlas.trial.ledger.equation import SYMMETRIC, Equation

_LETTERS = (
    r"units of $I_2$: $M_3 = I c_3$, $p = (\mathbf{M}, \mathbf{K})/b$, $A = (I - 1) b^2$, $b > 0$, $q$ as in "
    "@theorem-top"
)
_FAMILY = (
    SYMMETRIC,
    _LETTERS,
    "$0 < I < 1$, $w^2 < (1-I) b^2$",
    r"$\nu_0$ is a double root of $q$, $e$ a simple one, $t = 0$ where $\nu = e$",
)

EQUATIONS = {
    "theorem-steady": Equation(
        says=r"The double roots $\nu_0$ of $q$ with $|\nu_0| < 1$: steady precessions with the rate $w$ in Larmor's "
        "frame",
        tex=r"\begin{aligned} q(\nu_0)=q'(\nu_0)=0&\iff M_3w=\nu_0(w^2+A),\quad 2H-\frac{M_3^2}{I}-b^2-A\nu_0^2=w^2(1-"
        r"\nu_0^2),\\ w&=\frac{p-M_3\nu_0}{1-\nu_0^2}=k+b,\qquad \nu_0=\hat B_3 \end{aligned}",
        assumptions=(
            SYMMETRIC,
            _LETTERS,
            r"$k$, $\hat{B}_3$ of the elementary motion with the same integrals, for the last two",
        ),
    ),
    "theorem-nutation": Equation(
        says=r"Nutation frequency of a steady precession: a square and a bound, for every $I$ and both signs of "
        r"$\nu_0$",
        tex=r"\nu_n^2=-\tfrac12q''(\nu_0)=w^2-A(3\nu_0^2-1)+\frac{A^2\nu_0^2}{w^2}=\left(w\mp\frac{A\nu_0}{w}\right)^2"
        r"+A(1\mp\nu_0)(1\pm3\nu_0)",
        assumptions=(SYMMETRIC, _LETTERS, r"$\nu_0$, $w$ as in @theorem-steady, $w$ differs from 0"),
    ),
    "theorem-companion-range": Equation(
        says=r"The other two roots of $q$ beside a double root $\nu_0$: real exactly if $\nu_0^2 \le z \le 1$",
        tex=r"q=A(\nu-\nu_0)^2(\nu-e_+)(\nu-e_-),\qquad e_\pm=-\nu_0\pm\sqrt{\frac{(1-z)(z-\nu_0^2)}{z}},\qquad z="
        r"\frac{w^2}{(1-I)b^2}",
        assumptions=(SYMMETRIC, _LETTERS, r"$\nu_0$, $w$ as in @theorem-steady, $w$ differs from 0", "$0 < I < 1$"),
    ),
    "theorem-companion-roots": Equation(
        says=r"All these motions by two angles: $e = \cos (2 \delta)$ where the axis turns back, and $z = \cos "
        r"(\kappa)^2$",
        tex=r"\nu_0=-\cos\kappa\cos(2\delta-\kappa),\qquad M_3=w\sin\kappa\tan\kappa\cos(2\delta-\kappa),\qquad A=-"
        r"\frac{w^2}{\cos^2\kappa},\qquad c=A(\nu_0-e)(3\nu_0+e)",
        assumptions=_FAMILY,
    ),
    "theorem-companion": Equation(
        says="The second elementary family: the Cayley–Klein parameters are turned vectors, linear in $C$ and $S$",
        tex=r"\begin{aligned} \begin{pmatrix}\xi\\\eta\end{pmatrix}&\propto\begin{pmatrix}\exp(i\lambda_-t)\left[\cos"
        r"\delta\,C-i\Lambda\cos(\delta-\kappa)\,S\right]\\ \exp(i\lambda_+t)\left[\sin\delta\,C+i\Lambda\sin(\delta-"
        r"\kappa)\,S\right]\end{pmatrix},\qquad\Lambda=\frac{w(e-\nu_0)}{\cos\kappa},\\ C&=\cosh\frac{\sqrt ct}{2},"
        r"\qquad S=\frac{1}{\sqrt c}\sinh\frac{\sqrt ct}{2},\\ 2\lambda_\mp&=\pm(c_3-M_3)-b+\frac{p\pm M_3}{1\pm "
        r"\nu_0} \end{aligned}",
        assumptions=(*_FAMILY, "cosine and sine stand for cosh and sinh if $c < 0$, and $C = 1$, $S = t/2$ if $c = 0$"),
    ),
    "theorem-companion-nutation": Equation(
        says=r"The nutation of the second elementary family, for any quartic with a double root $\nu_0$ and a simple "
        "root $e$",
        tex=r"\nu=\nu_0+\frac{e-\nu_0}{1+\left(c-A(e-\nu_0)^2\right)S^2},\qquad C^2=1+cS^2",
        assumptions=(
            r"$q = (\nu-\nu_0)^2 (c + d(\nu-\nu_0) + A(\nu-\nu_0)^2)$, zero at $\nu = e$",
            r"$t = 0$ where $\nu = e$, $S$ as in @theorem-companion",
        ),
    ),
    "theorem-companion-triple": Equation(
        says="A triple root: the separatrix closes in rational functions of time",
        tex=r"\nu=\nu_0-\frac{4\nu_0}{1+4(1-I)b^2\nu_0^2t^2},\qquad e=-3\nu_0,\qquad q=-(1-I)b^2(\nu-\nu_0)^3"
        r"(\nu+3\nu_0)",
        assumptions=(
            SYMMETRIC,
            _LETTERS,
            r"$0 < I < 1$, $z$ at an end of the unstable band, $z^2 + (3\nu_0^2-1) z + \nu_0^2 = 0$",
        ),
    ),
    "theorem-axis-stable": Equation(
        says=r"A spin along the field is stable for $D \ge 0$, $M_3$ not 0, for all times: a conserved sum of squares",
        tex=r"\begin{aligned} M_1^2+M_2^2-A(1-\nu^2)-M_3(p-M_3)&=\left(M_1-\tfrac12M_3n_1\right)^2+\left(M_2-"
        r"\tfrac12M_3n_2\right)^2+\tfrac14D(1-\nu^2)+\tfrac12M_3^2(1-\nu)^2,\\ D&=M_3^2-4A=I^2(\omega_3+B'_3)^2+4(1"
        r"-I){B'_3}^2 \end{aligned}",
        assumptions=(
            SYMMETRIC,
            _LETTERS,
            r"$n = \mathbf{K}/b$, $\nu = n_3$; the motion itself has $\nu = 1$, $M_1 = M_2 = 0$",
        ),
    ),
    "theorem-axis-escape": Equation(
        says=r"For $D < 0$ it is not: one motion leaves it as $\exp (\sqrt{-D} t/2)$, turns where $\nu = e$, and "
        "comes back to it",
        tex=r"e=\frac{\lvert M_3\rvert}{b\sqrt{I-1}}-1,\qquad\begin{pmatrix}\xi\\\eta\end{pmatrix}\propto"
        r"\begin{pmatrix}\exp(i\lambda_-t)\left[C\cos\delta-iM_3\frac{e-1}{1+e}\cos\delta\,S\right]\\ "
        r"\exp(i\lambda_+t)\sin\delta\end{pmatrix},\qquad c=-D",
        assumptions=(
            SYMMETRIC,
            _LETTERS,
            "$I > 1$, $D < 0$, $M_3$ differs from 0, $p = M_3$",
            r"$e = \cos 2\delta$; $C$, $S$, $\lambda$ of @theorem-companion, $\nu_0 = 1$",
            r"$\lambda_+ = (M_3 - c_3 - b)/2$",
        ),
    ),
    "theorem-axis-pushed": Equation(
        says=r"Pushed across by $s_1$ a spin along the field turns back at a root of a cubic in $x = \tan "
        r"(\theta/2)^2$",
        tex=r"\dot x^2=x\left[s_1^2(1+x)^2+x\left(4A-M_3^2(1+x)^2\right)\right],\qquad\nu=\frac{1-x}{1+x}",
        assumptions=(SYMMETRIC, _LETTERS, r"$B'_2 = 0$, $\boldsymbol{\omega} = (s_1, 0, \omega_3)$ at $t = 0$"),
    ),
    "theorem-axis-pendulum": Equation(
        says="A disk at rest in Larmor's frame, $M_3 = 0$: a plane pendulum that tips over from the field's axis to "
        "the other",
        tex=r"M_3=p=0,\quad 2H-b^2=A:\qquad\nu=-\tanh\sqrt At",
        assumptions=(SYMMETRIC, _LETTERS, "$I > 1$"),
    ),
}
