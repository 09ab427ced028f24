"""The general motion of the symmetric body: a top in a quadratic potential, and its solution in sigma functions."""

from atlas.trial.ledger.equation import SYMMETRIC, Equation

_LETTERS = r"units of $I_2$: $M_3 = I c_3$, $p = (\mathbf{M}, \mathbf{K})/b$, $\nu = K_3/b$, $b > 0$"
_CURVE = r"$q(\nu)$ is the square of the rate of $\nu$, as in @theorem-top"

EQUATIONS = {
    "theorem-top": Equation(
        says=r"In Larmor's frame: an uncharged symmetric top in the potential $(I_3 - I_2) b^2 \nu^2/2$, $\nu = \cos "
        r"(\theta)$",
        tex=r"\begin{aligned} \dot\nu^2=q(\nu)&=(1-\nu^2)\left(2H-\frac{M_3^2}{I}-b^2-(I-1)b^2\nu^2\right)"
        r"-(p-M_3\nu)^2,\\ \dot\psi+b&=\frac{p-M_3\nu}{1-\nu^2},\qquad\dot\chi=c_3-\nu(\dot\psi+b) \end{aligned}",
        assumptions=(SYMMETRIC, _LETTERS, r"$z$ along $\mathbf{B}$, $|\nu| < 1$ for the angles"),
    ),
    "theorem-top-quartic": Equation(
        says="The quartic $q$ of the top is the quartic $Q$ of the pseudo-oscillator in other letters",
        tex=r"Q(u)=b^2q\left(\frac{c_3-u}{b}\right),\qquad E'=2(H-bp),\qquad c_5=bp-b^2+(1-I)c_3^2",
        assumptions=(SYMMETRIC, _LETTERS),
    ),
    "theorem-weierstrass": Equation(
        says="From a root $e$ of any quartic $Q$ the solution of $du^2 = Q(u)$ in the function of Weierstrass",
        tex=r"\begin{aligned} u&=e+\frac{Q'(e)/4}{\wp(t)-Q''(e)/24},\\ g_2&=a_0a_4-4a_1a_3+3a_2^2,\qquad g_3=a_0a_2a_4"
        r"+2a_1a_2a_3-a_2^3-a_0a_3^2-a_1^2a_4 \end{aligned}",
        assumptions=(
            "$Q = a_0 u^4 + 4 a_1 u^3 + 6 a_2 u^2 + 4 a_3 u + a_4$",
            "$Q(e) = 0$, $Q'(e)$ differs from 0, $u = e$ at $t = 0$",
        ),
    ),
    "theorem-lame": Equation(
        says="Up to a steady turn the Cayley–Klein parameters obey real equations of Lamé's kind, the same for any $p$",
        tex=r"\ddot a=\left(\tfrac34A\nu^2-\tfrac12A\nu-C\right)a,\qquad\ddot\eta=\left(\tfrac34A\nu^2+\tfrac12A\nu-C"
        r"\right)\eta,\qquad A=(I-1)b^2,\quad 4C=2H-\frac{M_3^2}{I}-b^2+M_3^2",
        assumptions=(SYMMETRIC, _LETTERS, _CURVE, r"$a=\xi\exp(i(M_3-c_3)t/2)$, with $\eta$ the opposite sign"),
    ),
    "theorem-residues": Equation(
        says=r"Where $\nu = -1$ or 1 the rate $d\nu/dt$ is imaginary, and of its two signs one alone leaves a residue, "
        "which is 1",
        tex=r"q(\mp1)=-(p\pm M_3)^2,\qquad\operatorname{res}_{\nu=-1}\frac{\dot\xi}{\xi}=\frac{\dot\nu+i(p-M_3\nu)}{2"
        r"\dot\nu}=\frac{1\pm1}{2}\quad\text{where}\quad\dot\nu=\pm i(p+M_3)",
        assumptions=(SYMMETRIC, _LETTERS, _CURVE, r"$p$ differs from $M_3$ and from $-M_3$"),
    ),
    "theorem-sigma": Equation(
        says="The Cayley–Klein parameters in sigma functions, their exponents in closed form",
        tex=r"\begin{aligned} \frac{\dot\xi}{\xi}&=i\lambda_-+\zeta(z_-)+\zeta(t-z_-)-\tfrac12\zeta(t-z_0)-\tfrac12"
        r"\zeta(t+z_0),\qquad\xi=\xi_0\exp[(i\lambda_-+\zeta(z_-))t]\frac{\sigma(t-z_-)}{\sqrt{\sigma(t-z_0)\sigma(t"
        r"+z_0)}},\\ 2\lambda_-&=c_3-M_3-b+\frac{p+M_3}{1+e},\qquad2\lambda_+=M_3-c_3-b+\frac{p-M_3}{1-e} "
        r"\end{aligned}",
        assumptions=(
            SYMMETRIC,
            _LETTERS,
            r"$\nu = e$ at $t = 0$, $q(e) = 0$, $|e| < 1$",
            (
                r"$\nu=-1$ at the zero of $\xi$, $\nu=1$ at that of $\eta$, $\nu$ infinite at $\pm z_0$; $\eta$ with "
                "the other index"
            ),
        ),
    ),
}
