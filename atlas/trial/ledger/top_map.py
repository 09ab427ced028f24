"""The energy-momentum map of a symmetric top: cusps of its axis's trace, focus-focus values, residues."""

from atlas.trial.ledger.equation import Equation

_TOP = r"letters of @theorem-every-top, units of $J_2$"
_SPIN = r"$\sigma = \pm 1$, the spin with $\nu = \sigma$ has $p = \sigma M_3$, $g = 2 \sigma a + A$"

EQUATIONS = {
    "theorem-cusp": Equation(
        says=r"The trace of the axis has cusps exactly if $\nu$ turns at some $\nu_c$ with $\dot\psi = 0$; it has "
        r"loops if $\dot\psi$ changes its sign inside the range of $\nu$, and waves otherwise",
        tex=r"\begin{aligned} p=M_3\nu_c+k_2(1-\nu_c^2)\implies q(\nu_c)&=(1-\nu_c^2)\left[g-2a\nu_c-A\nu_c^2-k_2^2"
        r"(1-\nu_c^2)\right],\\ (1-\nu^2)\dot\psi&=(\nu-\nu_c)\left[k_2(\nu+\nu_c)-M_3\right] \end{aligned}",
        assumptions=(_TOP, r"$\dot\psi$ is the rate of the axis about $\mathbf{n}$", r"$|\nu_c| < 1$"),
    ),
    "theorem-focus": Equation(
        says=r"Near a spin about $\mathbf{n}$ two integrals are, to second order, $\boldsymbol\pi^2 + D z^2/4$ and "
        r"$(\boldsymbol\pi, \mathbf{z})$: the spin is of focus-focus type for $D < 0$",
        tex=r"\begin{aligned} g-2\sigma a-A-\sigma M_3(p-\sigma M_3)&=\boldsymbol\pi^2+\tfrac14D\,\mathbf{z}^2+\left("
        r"\tfrac12M_3^2-\sigma a\right)(1-\sigma\nu)^2,\\ p-\sigma M_3&=(\boldsymbol\pi,\mathbf{z})-\tfrac12\sigma M_3"
        r"(1-\sigma\nu)^2,\qquad D=M_3^2-4(\sigma a+A) \end{aligned}",
        assumptions=(
            _TOP,
            _SPIN,
            r"$\mathbf{z} = (b_1, b_2)$, $\boldsymbol\pi = (M_1, M_2) - \sigma M_3 \mathbf{z}/2$, $\mathbf{b}^2 = 1$",
        ),
    ),
    "theorem-residue": Equation(
        says=r"Over $\nu$ the differentials of $\psi$ and $\chi$ have at $\nu = \sigma$ residues $r$ and $-\sigma r$ "
        r"with $r^2 = -1/4$, whatever $p$, $M_3$ and $g$ are",
        tex=r"d\psi=\left[\frac{p-M_3\nu}{1-\nu^2}-k_2\right]\frac{d\nu}{\sqrt q},\qquad \operatorname{res}_{\sigma}^2"
        r"d\psi=\frac{1}{q(\sigma)}\left(\frac{p-\sigma M_3}{2}\right)^2=-\frac14,\qquad \operatorname{res}_\sigma "
        r"d\chi=-\sigma\operatorname{res}_\sigma d\psi",
        assumptions=(_TOP, _SPIN, r"$p$ differs from $\sigma M_3$"),
    ),
}
