"""Appendix: a point particle in constant fields, (89) to (104)."""

from atlas.trial.ledger.equation import Equation

_FIELDS = r"$\mathbf{B}$ along $\mathbf{e}_3$, $\mathbf{E}$ in the plane $(\mathbf{e}_2, \mathbf{e}_3)$"

EQUATIONS = {
    "(89)": Equation(
        alias="mf1",
        says="Lorentz force: the equation of motion of a charged particle",
        tex=r"\begin{aligned} "
        r"m\ddot{\mathbf{y}}&=e\mathbf{E}+\frac{e}{c}[\dot{\mathbf{y}}, \mathbf{B}],\\ "
        r"\text{or}\quad \ddot{\mathbf{y}}&=\mu\mathbf{E}+\frac{\mu}{c}[\dot{\mathbf{y}}, \mathbf{B}] "
        r"\end{aligned}",
    ),
    "(90)": Equation(
        alias="mf2",
        says="The equation of motion integrated once",
        tex=r"\dot{\mathbf{y}}=\mu\mathbf{E}t+\frac{\mu}{c}[\mathbf{y}, \mathbf{B}]+\mathbf{C}",
    ),
    "text-no-magnetic-field": Equation(
        says=r"Without a magnetic field the particle falls along $\mathbf{E}$",
        tex=r"\mathbf{y}(t)=\mathbf{y}_0+\mathbf{C}t+\frac12 \mu\mathbf{E}t^2",
        assumptions=(r"$\mathbf{B} = 0$",),
    ),
    "text-along-field": Equation(
        says=r"Without a magnetic field the acceleration has the direction of $\mathbf{E}$",
        tex=r"(\ddot{\mathbf{y}},\mathbf{E})>0",
        assumptions=(r"$\mathbf{B} = 0$",),
        quote=r"particle moves with the acceleration directed along $\mathbf{E}$",
    ),
    "text-helix": Equation(
        says=r"Without an electric field the particle moves on a helix about an axis along $\mathbf{B}$",
        tex=r"\frac{d}{dt}\lvert\mathbf{y}_2\rvert=0,\qquad\ddot{\mathbf{y}}_{\Vert}=0",
        assumptions=(r"$\mathbf{E} = 0$",),
        quote="particle moves along a helical line located on a cylinder",
    ),
    "(91)": Equation(
        alias="mf3",
        says=r"Motion along $\mathbf{B}$, integrated once",
        tex=r"\dot{\mathbf{y}}_{\Vert}=\mathbf{C}_{\Vert}+\mu\mathbf{E}_{\Vert}t",
        assumptions=(_FIELDS,),
    ),
    "(92)": Equation(
        alias="mf4",
        says=r"Motion across $\mathbf{B}$, integrated once",
        tex=r"\dot{\mathbf{y}}_{\bot}=\frac{\mu}{c}[\mathbf{y}_{\bot}, \mathbf{B}]+\mathbf{C}_{\bot}+\mu"
        r"\mathbf{E}_{\bot}t",
        assumptions=(_FIELDS,),
    ),
    "(93)": Equation(
        alias="mf5",
        says=r"Motion along $\mathbf{B}$",
        tex=r"\mathbf{y}_{\Vert}(t)=\mathbf{y}_{\Vert 0}+\mathbf{C}_{\Vert}t+\frac12 \mu\mathbf{E}_{\Vert}t^2",
        assumptions=(_FIELDS,),
    ),
    "text-parallel-acceleration": Equation(
        says=r"Along $\mathbf{B}$ the particle moves with the acceleration $|\mu \mathbf{E}_\bot|$",
        tex=r"\lvert\ddot{\mathbf{y}}_{\Vert}\rvert=\lvert\mu\mathbf{E}_{\bot}\rvert",
        assumptions=(_FIELDS,),
        quote=r"moves with the acceleration $\lvert\mu\mathbf{E}_{\bot}\rvert$ along the axis $\mathbf{B}$",
    ),
    "text-double-product": Equation(
        says=r"A vector orthogonal to $\mathbf{B}$ is minus its double product with $\mathbf{B}$ over $\mathbf{B}^2$",
        tex=r"\mathbf{E}_{\bot}=-[[\mathbf{E}_{\bot},\mathbf{B}],\mathbf{B}]/\mathbf{B}^2",
        assumptions=(r"$(\mathbf{E}_\bot, \mathbf{B}) = 0$",),
    ),
    "(94)": Equation(
        alias="mf6",
        says=r"The electric field across $\mathbf{B}$ absorbed by a uniform motion",
        tex=r"\begin{aligned} "
        r"\dot{\mathbf{y}}_{\bot}&=\frac{\mu}{c}[\mathbf{y}_{\bot}-\frac{c t[\mathbf{E}_{\bot}, \mathbf{B}"
        r"]}{\lvert \mathbf{B}\rvert^2}, \mathbf{B}]+\mathbf{C}_{\bot} "
        r"\end{aligned}",
        assumptions=(_FIELDS,),
    ),
    "(95)": Equation(
        alias="mf7",
        says="Equation for the first shifted variable",
        tex=r"\dot{\mathbf{y}}_1=\frac{\mu}{c}[\mathbf{y}_1,\mathbf{B}]+\mathbf{C}_{\bot}-\frac{c[\mathbf{E}_{"
        r"\bot},\mathbf{B}]}{\mathbf{B}^2},\quad\text{or}\quad\dot{\mathbf{y}}_1=\frac{\mu}{c}\Bigl["
        r"\mathbf{y}_1-\frac{c[\mathbf{C}_{\bot},\mathbf{B}]+c^2\mathbf{E}_{\bot}}{\mu\mathbf{B}^2},"
        r"\mathbf{B}\Bigr]",
        assumptions=(_FIELDS,),
    ),
    "(96)": Equation(
        alias="mf8",
        says=r"The twice shifted variable precesses about $\mathbf{B}$",
        tex=r"\dot{\mathbf{y}}_2=-\frac{\mu}{c}[\mathbf{B}, \mathbf{y}_2]",
        assumptions=(_FIELDS,),
    ),
    "(97)": Equation(
        alias="mf9",
        says="General solution for the twice shifted variable",
        tex=r"\begin{aligned} "
        r"\mathbf{y}_2(t)&=a\left\{\mathbf{e}_1\sin(\omega t+\omega_0)+\mathbf{e}_2\cos(\omega t+\omega_0)"
        r"\right\},\\ "
        r"\omega&=\frac{\lvert \mu\mathbf{B}\rvert}{c} "
        r"\end{aligned}",
        assumptions=(_FIELDS,),
    ),
    "text-drift-direction": Equation(
        says=r"$[\mathbf{E}_\bot, \mathbf{B}]$ points along $\mathbf{e}_1$",
        tex=r"[\mathbf{E}_{\bot},\mathbf{B}]=\lvert\mathbf{E}_{\bot}\rvert\lvert\mathbf{B}\rvert\mathbf{e}_1",
        assumptions=(_FIELDS,),
    ),
    "(98)": Equation(
        alias="mf10",
        says=r"General solution across $\mathbf{B}$",
        tex=r"\mathbf{y}_{\bot}(t)=\frac{[\mathbf{C}_{\bot},\mathbf{B}]+c\mathbf{E}_{\bot}}{\omega\lvert"
        r"\mathbf{B}\rvert}+\frac{\mu\lvert\mathbf{E}_{\bot}\rvert}{\omega}t\mathbf{e}_1+a\left\{\mathbf{e}"
        r"_1\sin(\omega t+\omega_0)+\mathbf{e}_2\cos(\omega t+\omega_0)\right\}",
        assumptions=(_FIELDS,),
    ),
    "text-time-shift": Equation(
        says="The phase $\\omega_0$ goes away with another origin of time",
        tex=r"\begin{aligned} &\mathbf{y}_{\bot}(t;\mathbf{C}_{\bot},\omega_0)=\mathbf{y}_{\bot}\Bigl(t+\frac{"
        r"\omega_0}{\omega};\mathbf{C}'_{\bot},0\Bigr),\\ &\mathbf{C}'_{\bot}=\mathbf{C}_{\bot}-\mu\mathbf{E}_{"
        r"\bot}\frac{\omega_0}{\omega} \end{aligned}",
        assumptions=(_FIELDS,),
        quote=r"By choosing the time reference point, we can give any desired value to the constant $\omega_0$",
    ),
    "text-first-two-terms": Equation(
        says=r"With $\mathbf{C}_\bot = c [\mathbf{E}_\bot, \mathbf{B}]/\mathbf{B}^2$ the first two terms of @(98) "
        "vanish",
        tex=r"\mathbf{C}_{\bot}=\frac{c[\mathbf{E}_{\bot},\mathbf{B}]}{\mathbf{B}^2}\implies\frac{[\mathbf{C}_{"
        r"\bot},\mathbf{B}]+c\mathbf{E}_{\bot}}{\omega\lvert\mathbf{B}\rvert}+\frac{\mu\lvert\mathbf{E}_{"
        r"\bot}\rvert}{\omega}t\mathbf{e}_1=0",
        assumptions=(_FIELDS,),
        quote="the first two terms in Eq. (98) vanish",
    ),
    "text-initial-position": Equation(
        says=r"That choice puts the particle at $\mathbf{y}_\bot(0) = a \mathbf{e}_2$",
        tex=r"\mathbf{y}_{\bot}(0)=a\mathbf{e}_2",
        assumptions=(_FIELDS, r"$\omega_0 = 0$"),
        quote="This corresponds to the choice of initial position",
    ),
    "(99)": Equation(
        alias="mf11",
        kind="claim",
        says="The trochoid: a uniform drift plus a rotation",
        tex=r"\begin{aligned} "
        r"\mathbf{y}_{\bot}(t)&=\frac{\mu \lvert \mathbf{E}_{\bot}\rvert}{\omega}t\mathbf{e}_1+ a\left\{"
        r"\mathbf{e}_1\sin\omega t+\mathbf{e}_2\cos\omega t\right\}\equiv \mathbf{O}(t)+\mathbf{P}(t) "
        r"\end{aligned}",
        assumptions=(_FIELDS,),
    ),
    "text-drift": Equation(
        says=r"The guiding centre moves along $\mathbf{e}_1$ with the speed $\mu |\mathbf{E}_\bot|/\omega$",
        tex=r"\dot{\mathbf{O}}=\frac{\mu\lvert\mathbf{E}_{\bot}\rvert}{\omega}\mathbf{e}_1",
        assumptions=(_FIELDS,),
        quote=r"the point $\mathbf{O}(t)$ moves in the direction of $\mathbf{e}_1$ with the speed equal to "
        r"$\mu\lvert\mathbf{E}_{\bot}\rvert/\omega$",
    ),
    "text-trochoid-constant": Equation(
        says=r"$\mathbf{C}_\bot = c [\mathbf{E}_\bot, \mathbf{B}]/\mathbf{B}^2 - \mu |\mathbf{E}_\bot| \mathbf{e}_1$ "
        "is a constant of @(90): a velocity",
        tex=r"\mathbf{C}_{\bot}=\frac{c[\mathbf{E}_{\bot},\mathbf{B}]}{\mathbf{B}^2}-\mu\lvert\mathbf{E}_{\bot}"
        r"\rvert\mathbf{e}_1",
        assumptions=(_FIELDS,),
    ),
    "(100)": Equation(
        alias="mf10.1",
        kind="claim",
        says="The trochoid in components",
        tex=r"x(t)=\frac{\mu \lvert \mathbf{E}_{\bot}\rvert}{\omega}t+a\sin\omega t, \qquad y(t)=\frac{\mu "
        r"\lvert \mathbf{E}_{\bot}\rvert}{\omega}+a\cos\omega t",
        assumptions=(_FIELDS,),
    ),
    "text-trochoid": Equation(
        says="The curve is a trochoid: the path of a point that a rolling circle carries along",
        tex=r"x=r\omega t+a\sin\omega t,\qquad y=r+a\cos\omega t,\qquad "
        r"r=\frac{\mu\lvert\mathbf{E}_{\bot}\rvert}{\omega^2}",
        assumptions=(_FIELDS,),
        quote="These are parametric equations of a plane curve called trochoid",
    ),
    "(101)": Equation(
        alias="mf10.2",
        kind="claim",
        says=r"The trajectory: motion along $\mathbf{B}$ by @(93) plus motion across $\mathbf{B}$ by @(99)",
        tex=r"\mathbf{y}(t)=\mathbf{y}_{\Vert}(t)+\mathbf{y}_{\bot}(t)",
        assumptions=(_FIELDS,),
    ),
    "(102)": Equation(
        alias="mf12",
        kind="definition",
        says="Scalar and vector potentials of constant fields",
        tex=r"A_0(\mathbf{y})=(\mathbf{y}, \mathbf{E}), \qquad \mathbf{A}(\mathbf{y})=\frac12 [\mathbf{B}, "
        r"\mathbf{y}]=\frac12 \begin{pmatrix} B_2 y_3-B_3 y_2 \\ B_3y_1-b_1 y_3 \\ B_1 y_2-B_2 y_1 "
        r"\end{pmatrix}",
    ),
    "text-potentials": Equation(
        says="The fields that these potentials give",
        tex=r"\mathbf{E}=-\frac1c\frac{\partial\mathbf{A}}{\partial t}+\nabla A_0,\qquad\mathbf{B}=[\nabla,"
        r"\mathbf{A}]",
        quote="This implies the standard agreement",
    ),
    "(103)": Equation(
        alias="mf13",
        kind="definition",
        says="Potential energy of a charged particle",
        tex=r"-U=eA_0+\frac{e}{c}(\mathbf{A}, \dot{\mathbf{y}})",
    ),
    "(104)": Equation(
        alias="mf14",
        kind="claim",
        says="Lagrangian of a charged particle; it implies @(89)",
        tex=r"L=K-U=\frac{m}{2}\dot{\mathbf{y}}^2+eA_0+\frac{e}{c}(\mathbf{A},\dot{\mathbf{y}})=\frac{m}{2}\dot{"
        r"\mathbf{y}}^2+e(\mathbf{y},\mathbf{E})+\frac{e}{2c}([\mathbf{y},\dot{\mathbf{y}}],\mathbf{B})",
    ),
}
