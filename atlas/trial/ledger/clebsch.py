"""The structure behind the motion: Larmor's frame, the Lie-Poisson form, and the integral of Clebsch."""

from atlas.trial.ledger.equation import SYMMETRIC, Equation

_ANY = (
    "$J$ any inertia tensor in the body",
    r"$\mathbf{K} = R^T \mathbf{B}'$, so that $d\mathbf{K}/dt = [\mathbf{K}, \boldsymbol{\Omega}]$",
)
_AXES = (
    r"$J = \text{diag}(I_1, I_2, I_3)$, any principal moments",
    r"$\mathbf{M} = J (\boldsymbol{\Omega} + \mathbf{K})$",
)

EQUATIONS = {
    "theorem-larmor-frame": Equation(
        says=r"$S = R_B(bt) R$ is the body seen from the frame that turns with $-\mathbf{B}'$, where it has the spin "
        r"$\boldsymbol{\Omega} + \mathbf{K}$",
        tex=r"S=R_{\hat{\mathbf{B}}}(bt)R,\qquad \dot S_{ij}=-\varepsilon_{jab}(\boldsymbol{\Omega}+\mathbf{K})_aS_{ib}"
        r",\qquad \mathbf{K}=S^T\mathbf{B}'",
        assumptions=("@(12)", r"$b = |\mathbf{B}'|$"),
    ),
    "theorem-larmor": Equation(
        says="Seen from that frame a body of any inertia tensor carries no charge and feels the potential "
        r"$(\mathbf{K}, J \mathbf{K})/2$",
        tex=r"J\dot{\mathbf{W}}=[J\mathbf{W},\mathbf{W}]+[\mathbf{K},J\mathbf{K}],\qquad\dot{\mathbf{K}}=[\mathbf{K},"
        r"\mathbf{W}],\qquad\mathbf{W}=\boldsymbol{\Omega}+\mathbf{K}",
        assumptions=_ANY,
    ),
    "theorem-momentum-canonical": Equation(
        says=r"$\mathbf{M} = J (\boldsymbol{\Omega} + \mathbf{K})$ is the canonical momentum, and the kinetic energy "
        "its Hamiltonian",
        tex=r"\mathbf{M}=\frac{\partial L}{\partial\boldsymbol{\Omega}},\qquad L=\frac12(\boldsymbol{\Omega},J"
        r"\boldsymbol{\Omega})+(\mathbf{K},J\boldsymbol{\Omega}),\qquad(\mathbf{M},\boldsymbol{\Omega})-L=\frac12("
        r"\boldsymbol{\Omega},J\boldsymbol{\Omega})",
        assumptions=_ANY,
    ),
    "theorem-lie-poisson": Equation(
        says="The Lie–Poisson equations of $e(3)$: Kirchhoff's equations of a body in a fluid",
        tex=r"\begin{aligned} \dot{\mathbf{M}}&=\left[\mathbf{M},\frac{\partial H}{\partial\mathbf{M}}\right]+\left["
        r"\mathbf{K},\frac{\partial H}{\partial\mathbf{K}}\right],\qquad\dot{\mathbf{K}}=\left[\mathbf{K},\frac{"
        r"\partial H}{\partial\mathbf{M}}\right],\\ H&=\frac12(\mathbf{M},J^{-1}\mathbf{M})+\frac12(\mathbf{K},J"
        r"\mathbf{K}) \end{aligned}",
        assumptions=_AXES,
    ),
    "theorem-bracket": Equation(
        says=r"The bracket of $e(3)$ obeys Jacobi's identity, and $\mathbf{K}^2$ and $(\mathbf{M}, \mathbf{K})$ "
        "commute with everything",
        tex=r"\{M_i,M_j\}=-\varepsilon_{ijk}M_k,\qquad\{M_i,K_j\}=-\varepsilon_{ijk}K_k,\qquad\{K_i,K_j\}=0",
        assumptions=(r"$\mathbf{M}$, $\mathbf{K}$ any vectors",),
    ),
    "theorem-kinetic-energy": Equation(
        says=r"The kinetic energy is $H$ less the Casimir $(\mathbf{M}, \mathbf{K})$",
        tex=r"\frac12(\boldsymbol{\Omega},J\boldsymbol{\Omega})=H-(\mathbf{M},\mathbf{K})",
        assumptions=_ANY,
    ),
    "theorem-clebsch": Equation(
        says="Clebsch's integral: a charged body of any inertia tensor in a homogeneous field is integrable",
        tex=r"F=\mathbf{M}^2-\det J\,(\mathbf{K},J^{-1}\mathbf{K}),\qquad\dot F=0",
        assumptions=_ANY,
    ),
    "theorem-involution": Equation(
        says="$H$ and $F$ are in involution, and with the Casimirs independent if the three moments differ",
        tex=r"\{F,H\}=0,\qquad\operatorname{rank}\frac{\partial(H,F,(\mathbf{M},\mathbf{K}),\mathbf{K}^2)}{\partial("
        r"\mathbf{M},\mathbf{K})}=4",
        assumptions=(*_AXES, "$I_1$, $I_2$, $I_3$ all different, for the rank"),
    ),
    "theorem-clebsch-symmetric": Equation(
        says=r"For $I_1 = I_2$ the integral $F$ is $H$, the square of $M_3 = I_3 c_3$, and $\mathbf{K}^2$",
        tex=r"F=2I_2H+\left(1-\frac{I_2}{I_3}\right)M_3^2-I_2(I_2+I_3)\mathbf{K}^2,\qquad c_5=\frac{(\mathbf{M},"
        r"\mathbf{K})}{I_2}-\mathbf{K}^2+(1-I)c_3^2",
        assumptions=(SYMMETRIC, r"$\mathbf{M} = J (\boldsymbol{\Omega} + \mathbf{K})$, $M_3 = I_3 c_3$"),
    ),
    "theorem-pair": Equation(
        says=r"$\boldsymbol{\omega}$ and $-2 \mathbf{B}' - \boldsymbol{\omega}$ are one initial spin in Larmor's "
        "frame, run in opposite senses of time",
        tex=r"\tilde{\boldsymbol{\Omega}}(t)=-2\mathbf{K}(-t)-\boldsymbol{\Omega}(-t),\qquad\tilde R(t)=R_{\hat{\mathbf"
        r"{B}}}(-2bt)R(-t)",
        assumptions=("$J$ any inertia tensor in the body", r"@(12) and @(16) for $R$, $\boldsymbol{\Omega}$"),
    ),
}
