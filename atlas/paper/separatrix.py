"""Where the quartic has a double root: steady precessions, their stability, and the second elementary family."""

from atlas.paper.equation import Equation

_BODY = r"$I_1 = I_2$, third axis of inertia along $\mathbf{e}_3$ at $t = 0$"
_LETTERS = r"units of $I_2$: $M_3 = I c_3$, $p = (\mathbf{M}, \mathbf{K})/b$, $A = (I - 1) b^2$, $q$ as in @theorem-top"
_FAMILY = (
    _BODY,
    _LETTERS,
    "$0 < I < 1$, $w^2 < (1-I) b^2$",
    r"$r$ is a double root of $q$, $e$ a simple one, $t = 0$ where $\nu = e$",
)

EQUATIONS = (
    Equation(
        label="theorem-steady",
        number=None,
        section="Atlas",
        kind="theorem",
        says="The double roots $r$ of $q$ with $|r| < 1$: steady precessions with the rate $w$ in Larmor's frame",
        tex=r"\begin{aligned} q(r)=q'(r)=0&\iff M_3w=r(w^2+A),\quad h-\frac{M_3^2}{I}-b^2-Ar^2=w^2(1-r^2),\\ w&="
        r"\frac{p-"
        r"M_3r}{1-r^2}=k+b,\qquad r=\hat B_3 \end{aligned}",
        assumptions=(
            _BODY,
            _LETTERS,
            r"$k$, $\hat{B}_3$ of the elementary motion with the same integrals, for the last two",
        ),
    ),
    Equation(
        label="theorem-nutation",
        number=None,
        section="Atlas",
        kind="theorem",
        says="Nutation frequency of a steady precession: a square and a bound, for every $I$ and both signs of $r$",
        tex=r"-\tfrac12q''(r)=w^2-A(3r^2-1)+\frac{A^2r^2}{w^2}=\left(w\mp\frac{Ar}{w}\right)^2+A(1\mp r)(1\pm3r)",
        assumptions=(_BODY, _LETTERS, "$r$, $w$ as in @theorem-steady, $w$ differs from 0"),
    ),
    Equation(
        label="theorem-companion-range",
        number=None,
        section="Atlas",
        kind="theorem",
        says=r"The other two roots of $q$ beside a double root $r$: real exactly if $r^2 \le z \le 1$",
        tex=r"q=A(\nu-r)^2(\nu-e_+)(\nu-e_-),\qquad e_\pm=-r\pm\sqrt{\frac{(1-z)(z-r^2)}{z}},\qquad z="
        r"\frac{w^2}{(1-I)b^2}",
        assumptions=(_BODY, _LETTERS, "$r$, $w$ as in @theorem-steady, $w$ differs from 0", "$0 < I < 1$"),
    ),
    Equation(
        label="theorem-companion-roots",
        number=None,
        section="Atlas",
        kind="theorem",
        says=r"All these motions by two angles: $e = \cos (2 \delta)$ where the axis turns back, and $z = \cos "
        r"(\gamma)^2$",
        tex=r"r=-\cos\gamma\cos(2\delta-\gamma),\qquad M_3=w\sin\gamma\tan\gamma\cos(2\delta-\gamma),\qquad A=-"
        r"\frac{w^2}{"
        r"\cos^2\gamma},\qquad c=A(r-e)(3r+e)",
        assumptions=_FAMILY,
    ),
    Equation(
        label="theorem-companion",
        number=None,
        section="Atlas",
        kind="theorem",
        says="The second elementary family: the Cayley–Klein parameters are turned vectors, linear in $C$ and $S$",
        tex=r"\begin{aligned} \begin{pmatrix}\xi\\\eta\end{pmatrix}&\propto\begin{pmatrix}\exp(i\lambda_-t)\left["
        r"\cos\delta"
        r"\,C-i\Lambda\cos(\delta-\gamma)\,S\right]\\ \exp(i\lambda_+t)\left[\sin\delta\,C+i\Lambda\sin(\delta-"
        r"\gamma)\,S\right]"
        r"\end{pmatrix},\qquad\Lambda=\frac{w(e-r)}{\cos\gamma},\\ C&=\cosh\frac{\sqrt ct}{2},\qquad S=\frac{1}{"
        r"\sqrt c}"
        r"\sinh\frac{\sqrt ct}{2},\\ 2\lambda_\mp&=\pm(c_3-M_3)-b+\frac{p\pm M_3}{1\pm r} \end{aligned}",
        assumptions=(*_FAMILY, "cosine and sine stand for cosh and sinh if $c < 0$, and $C = 1$, $S = t/2$ if $c = 0$"),
    ),
    Equation(
        label="theorem-companion-nutation",
        number=None,
        section="Atlas",
        kind="theorem",
        says="The nutation of the second elementary family, for any quartic with a double root $r$ and a simple root "
        "$e$",
        tex=r"\nu=r+\frac{e-r}{1+\left(c-A(e-r)^2\right)S^2},\qquad C^2=1+cS^2",
        assumptions=(
            r"$q = (\nu-r)^2 (c + d(\nu-r) + A(\nu-r)^2)$, zero at $\nu = e$",
            r"$t = 0$ where $\nu = e$, $S$ as in @theorem-companion",
        ),
    ),
    Equation(
        label="theorem-companion-triple",
        number=None,
        section="Atlas",
        kind="theorem",
        says="A triple root: the separatrix closes in rational functions of time",
        tex=r"\nu=r-\frac{4r}{1+4(1-I)b^2r^2t^2},\qquad e=-3r,\qquad q=-(1-I)b^2(\nu-r)^3(\nu+3r)",
        assumptions=(_BODY, _LETTERS, "$0 < I < 1$, $z$ at an end of the unstable band, $z^2 + (3r^2-1) z + r^2 = 0$"),
    ),
    Equation(
        label="theorem-axis-stable",
        number=None,
        section="Atlas",
        kind="theorem",
        says=r"A spin along the field is stable for $D \ge 0$, $M_3$ not 0, for all times: a conserved sum of squares",
        tex=r"\begin{aligned} M_1^2+M_2^2-A(1-\nu^2)-M_3(p-M_3)&=\left(M_1-\tfrac12M_3n_1\right)^2+\left(M_2-"
        r"\tfrac12M_3n_2"
        r"\right)^2+\tfrac14D(1-\nu^2)+\tfrac12M_3^2(1-\nu)^2,\\ D&=M_3^2-4A=I^2(\omega_3+B'_3)^2+4(1-I){B'_3}^2 "
        r"\end{aligned}",
        assumptions=(
            _BODY,
            _LETTERS,
            r"$n = \mathbf{K}/b$, $\nu = n_3$; the motion itself has $\nu = 1$, $M_1 = M_2 = 0$",
        ),
    ),
    Equation(
        label="theorem-axis-escape",
        number=None,
        section="Atlas",
        kind="theorem",
        says=r"For $D < 0$ it is not: one motion leaves it as $\exp (\sqrt{-D} t/2)$, turns where $\nu = e$, and "
        "comes back to it",
        tex=r"e=\frac{\lvert M_3\rvert}{b\sqrt{I-1}}-1,\qquad\begin{pmatrix}\xi\\\eta\end{pmatrix}\propto"
        r"\begin{pmatrix}\exp(i\lambda_-t)\left[C\cos\delta-iM_3\frac{e-1}{1+e}\cos\delta\,S\right]\\ "
        r"\exp(i\lambda_+t)\sin\delta"
        r"\end{pmatrix},\qquad"
        r" c=-D",
        assumptions=(
            _BODY,
            _LETTERS,
            "$I > 1$, $D < 0$, $M_3$ differs from 0, $p = M_3$",
            r"$e = \cos 2\delta$; $C$, $S$, $\lambda$ of @theorem-companion, $r = 1$, $\lambda_+ = (M_3 - c_3 - b)/2$",
        ),
    ),
    Equation(
        label="theorem-axis-pushed",
        number=None,
        section="Atlas",
        kind="theorem",
        says=r"Pushed across by $s_1$ a spin along the field turns back at a root of a cubic in $x = \tan "
        r"(\theta/2)^2$",
        tex=r"\dot x^2=x\left[s_1^2(1+x)^2+x\left(4A-M_3^2(1+x)^2\right)\right],\qquad\nu=\frac{1-x}{1+x}",
        assumptions=(_BODY, _LETTERS, r"$B'_2 = 0$, $\boldsymbol{\omega} = (s_1, 0, \omega_3)$ at $t = 0$"),
    ),
    Equation(
        label="theorem-axis-pendulum",
        number=None,
        section="Atlas",
        kind="theorem",
        says="A disk at rest in Larmor's frame, $M_3 = 0$: a plane pendulum that tips over from the field's axis to "
        "the other",
        tex=r"M_3=p=0,\quad h-b^2=A:\qquad\nu=-\tanh\sqrt At",
        assumptions=(_BODY, _LETTERS, "$I > 1$"),
    ),
)
