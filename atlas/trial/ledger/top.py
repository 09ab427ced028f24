"""Every symmetric top in a uniform field: its potential, its steady precessions, and the paper's quadric for all."""

from atlas.trial.ledger.equation import Equation

_BODY = (
    r"$\mathbf{M} = J\boldsymbol{\Omega} + k\mathbf{b}$, $J$ and $k$ diagonal, $J_1 = J_2$, $k_1 = k_2$, "
    r"$U = a_0 \nu + A_0 \nu^2/2$"
)
_RATES = (
    r"$\mathbf{M}' = [\mathbf{M}, \boldsymbol{\Omega}] + [k\boldsymbol{\Omega} - U'(\nu)\mathbf{e}_3, "
    r"\mathbf{b}]$, $\mathbf{b}' = [\mathbf{b}, \boldsymbol{\Omega}]$, $|\mathbf{b}| = 1$"
)
_LETTERS = (
    r"units of $J_2$: $I = J_3/J_2$, $\nu = b_3$, $p = (\mathbf{M}, \mathbf{b})$, $\kappa = k_2 - k_3/I$, "
    r"$a = M_3 \kappa + a_0$, $A = A_0 + k_3^2/I - k_2^2$"
)
_CURVE = r"$q(\nu)$ is the square of the rate of $\nu$, as in @theorem-every-top"

EQUATIONS = {
    "theorem-every-top": Equation(
        says="Every symmetric top whose forces come from the direction of its axis against one constant direction "
        r"$\mathbf{n}$: one quartic. The paper's body is $a=0$, $A=(I-1)b^2$, Lagrange's heavy top $A=0$",
        tex=r"\begin{aligned} \dot\nu^2=q(\nu)&=(1-\nu^2)\left(g-2a\nu-A\nu^2\right)-(p-M_3\nu)^2,\\ "
        r"\dot\psi+k_2&=\frac{p-M_3\nu}{1-\nu^2},\qquad\dot\chi=\frac{M_3}{I}-\nu(\dot\psi+k_2)+\kappa\nu"
        r"\end{aligned}",
        assumptions=(_BODY, _LETTERS, _RATES, r"$z$ along $\mathbf{n}$, $|\nu| < 1$ for the angles"),
    ),
    "theorem-top-precession": Equation(
        says=r"The double roots $\nu_0$ of $q$ with $|\nu_0| < 1$: steady precessions with the rate $w - k_2$ about "
        r"$\mathbf{n}$",
        tex=r"q(\nu_0)=q'(\nu_0)=0\iff\nu_0w^2-M_3w+a+A\nu_0=0,\quad g-2a\nu_0-A\nu_0^2=w^2(1-\nu_0^2),\qquad w="
        r"\frac{p-M_3\nu_0}{1-\nu_0^2}",
        assumptions=(_BODY, _LETTERS, _CURVE),
    ),
    "theorem-top-nutation": Equation(
        says="Frequency of small nutations about a steady precession; where it is zero a push grows, unless $a = "
        r"-2 A \nu_0$",
        tex=r"-\tfrac12q''(\nu_0)=w^2+A(1-3\nu_0^2)-2a\nu_0+\frac{(a+A\nu_0)^2}{w^2},\qquad q'''(\nu_0)="
        r"12(a+2A\nu_0)\quad\text{where}\quad q''(\nu_0)=0",
        assumptions=(_BODY, _LETTERS, _CURVE, r"$\nu_0$, $w$ as in @theorem-top-precession, $w$ differs from 0"),
    ),
    "theorem-sleeping-top": Equation(
        says=r"The spin about $\mathbf{n}$, upright ($\sigma = 1$) or turned over ($\sigma = -1$): stable for $M_3^2 > "
        r"4(\sigma a + A)$, unstable for the opposite sign; at the border the sign of $\sigma a + 2 A$ decides",
        tex=r"q=(1-\sigma\nu)^2\left[(1+\sigma\nu)\left(2\sigma a+A(1+\sigma\nu)\right)-M_3^2\right],\qquad q=-(1-"
        r"\sigma\nu)^3\left(2\sigma a+A(3+\sigma\nu)\right)\quad\text{where}\quad M_3^2=4(\sigma a+A)",
        assumptions=(_BODY, _LETTERS, _CURVE, r"$p=\sigma M_3$, $g=2\sigma a+A$, as at rest at $\nu=\sigma$"),
    ),
    "theorem-top-quadric": Equation(
        says=r"The paper's quadric exists for every symmetric top: where the second rate of $\nu$ is 0 at $t = "
        r"0$. Its kind is the sign of $D$: two sheets for $D > 0$, a cone for $D = 0$, one sheet for $D < 0$",
        tex=r"\begin{aligned} \ddot\nu(0)&=-n_3\left[\omega_1^2+w^2-I\frac{n_2}{n_3}wv+n_2^2D\right],\qquad"
        r"\dot\nu(0)=-n_2\omega_1,\\ w&=\omega_2+n_2\frac{k_3}{I},\qquad v=\omega_3+\frac{n_3}{I}(k_3-2\kappa),\\ "
        r"D&=A+\kappa^2+\frac{a_0}{n_3}="
        r"\frac{k_3}{I}\left[k_3\left(1+\frac1I\right)-2k_2\right]+A_0+\frac{a_0}{n_3} \end{aligned}",
        assumptions=(
            _BODY,
            _LETTERS,
            r"$\mathbf{b} = (0, n_2, n_3)$ at $t = 0$, $n_2^2 + n_3^2 = 1$, $n_3$ differs from 0",
        ),
    ),
    "theorem-top-hyperbola": Equation(
        says="The true motions of the quadric, with $\\omega_1 = 0$: a hyperbola of steady precessions, elementary "
        r"motions in two turns, and the paper's hyperbola for $k_2 = b$, $k_3 = I b$ without a potential",
        tex=r"v=\frac{n_3(w^2+n_2^2D)}{I\,n_2w},\qquad \dot\psi=\frac{\omega_2}{n_2},\qquad\dot\chi=\omega_3-"
        r"\frac{n_3}{n_2}\omega_2",
        assumptions=(_BODY, _LETTERS, "letters of @theorem-top-quadric", "$w$ and $n_2$ differ from 0"),
    ),
}
