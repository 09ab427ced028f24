"""What the atlas adds to the paper."""

from atlas.paper.equation import Equation

EQUATIONS = (
    Equation(
        label="theorem-quartic",
        number=None,
        section="Atlas",
        kind="theorem",
        says=(
            "First integral of the cubic pseudo-oscillator: a quartic with leading coefficient I - 1, and "
            "Q' is twice the cubic"
        ),
        tex=(
            r"\dot u^2=Q(u)=(E'-Iu^2)\left(b^2-(c_3-u)^2\right)-\left(u^2-(2-I)c_3u+c_5\right)^2,\qquad Q'(u)="
            "2(a_0+a_1u+a_2u^2+a_3u^3)"
        ),
        assumptions=("I1 = I2, third axis of inertia along e3 at t = 0", "u = Omega3, b = |B'|"),
    ),
    Equation(
        label="theorem-points",
        number=None,
        section="Atlas",
        kind="theorem",
        says=(
            "Omega3 stays constant exactly if omega1 B'2 = 0 and mf58.1 holds: of the quadric only the "
            "hyperbola omega1 = 0 is motions"
        ),
        tex=r"\dot\Omega_3(0)=\omega_1B'_2",
        assumptions=("I1 = I2, third axis of inertia along e3 at t = 0",),
    ),
    Equation(
        label="theorem-stability",
        number=None,
        section="Atlas",
        kind="theorem",
        says="Nutation frequency squared along the hyperbola",
        tex=r"-p'(\omega_3)={B'_2}^2\,\frac{(1+\tau^2)x^4+(1-I)(2\tau^2-1)x^2+\tau^2(1-I)^2}{x^2}",
        assumptions=(
            "I1 = I2, third axis of inertia along e3 at t = 0",
            "B' = (0, B'2, B'3) with B'2 > 0, B'3 > 0",
            "omega2 differs from -B'2",
            "tau = B'3/B'2, x = (omega2 + B'2)/B'2",
        ),
    ),
    Equation(
        label="theorem-stable-short",
        number=None,
        section="Atlas",
        kind="theorem",
        says="For I >= 1 the elementary motions are stable everywhere",
        tex=r"I\ge1\implies-p'(\omega_3)>0",
        assumptions=(
            "I1 = I2, third axis of inertia along e3 at t = 0",
            "B' = (0, B'2, B'3) with B'2 > 0, B'3 > 0",
            "omega2 differs from -B'2",
            "1 <= I <= 2",
        ),
    ),
    Equation(
        label="theorem-band",
        number=None,
        section="Atlas",
        kind="theorem",
        says="For I < 1 they are unstable exactly in a band of x^2, which is there exactly if tau < 1/(2 sqrt 2)",
        tex=(
            r"-p'(\omega_3)<0\iff y_-<x^2<y_+,\qquad y_\pm=(1-I)\frac{1-2\tau^2\pm\sqrt{1-8\tau^2}}{2(1+\tau^2)}"
            r",\qquad\tau<\frac{1}{2\sqrt2}"
        ),
        assumptions=(
            "I1 = I2, third axis of inertia along e3 at t = 0",
            "B' = (0, B'2, B'3) with B'2 > 0, B'3 > 0",
            "omega2 differs from -B'2",
            "0 < I < 1",
        ),
    ),
    Equation(
        label="theorem-ball-line",
        number=None,
        section="Atlas",
        kind="theorem",
        says="I = 1: every point of the line omega1 = 0, omega2 = -B'2 is a motion",
        tex=r"R=R_{\hat{\mathbf{B}}}(-bt)\,R_{OZ}\left((\omega_3+B'_3)t\right)",
        assumptions=("B' = (0, B'2, B'3) with B'2 > 0, B'3 > 0", "I = 1"),
    ),
    Equation(
        label="theorem-equatorial-field",
        number=None,
        section="Atlas",
        kind="theorem",
        says="B'3 = 0: every point of the line omega1 = 0, omega2 = -B'2 is a motion, for every I",
        tex=r"R=R_{\mathbf{e}_2}(-B'_2t)\,R_{OZ}(\omega_3t)",
        assumptions=("B' = (0, B'2, 0)",),
    ),
    Equation(
        label="theorem-quadric-lines",
        number=None,
        section="Atlas",
        kind="theorem",
        says=(
            "I < 1: the quadric holds the two lines omega2 = -B'2, omega1 = ±sqrt(1-I) B'2, omega3 free, "
            "which mf59 loses"
        ),
        tex=r"\omega_2=-B'_2,\qquad\omega_1=\pm\sqrt{1-I}\,B'_2",
        assumptions=("B' = (0, B'2, B'3) with B'2 > 0, B'3 > 0", "0 < I < 1"),
    ),
    Equation(
        label="theorem-momentum",
        number=None,
        section="Atlas",
        kind="theorem",
        says="In the elementary motion the angular momentum precesses about B with the frequency k",
        tex=r"\dot{\mathbf{m}}=k[\hat{\mathbf{B}},\mathbf{m}]",
        assumptions=("B' = (0, B'2, B'3) with B'2 > 0, B'3 > 0", "omega2 differs from -B'2"),
    ),
    Equation(
        label="theorem-drift",
        number=None,
        section="Atlas",
        kind="theorem",
        says="The guiding centre drifts with c [E, B]/B^2 whatever the charge",
        tex=r"\dot{\mathbf{O}}=\frac{c[\mathbf{E},\mathbf{B}]}{\mathbf{B}^2}",
        assumptions=("B along e3, E in the plane (e2, e3)",),
    ),
    Equation(
        label="theorem-ball-rest",
        number=None,
        section="Atlas",
        kind="theorem",
        says="m2 = 0, m3 = -alpha I0: gamma = 0 and the ball turns about B by -alpha t",
        tex=r"R=R_{OZ}(-\alpha t)",
        assumptions=("I1 = I2 = I3",),
    ),
    Equation(
        label="theorem-angles",
        number=None,
        section="Atlas",
        kind="theorem",
        says="Rates of the Euler angles about B",
        tex=r"\dot\psi=\frac{P/b}{1-\nu^2},\qquad\dot\chi=u-\nu\dot\psi,\qquad\nu=\frac{c_3-u}{b}",
        assumptions=(
            "I1 = I2, third axis of inertia along e3 at t = 0",
            "z along B, nu = K3/b, P = Omega1 K1 + Omega2 K2",
        ),
    ),
    Equation(
        label="theorem-cayley-klein",
        number=None,
        section="Atlas",
        kind="theorem",
        says="Logarithmic derivatives of the Cayley-Klein parameters of the general motion",
        tex=(
            r"\frac{\dot\alpha}{\alpha}=\frac12 \left[\frac{\dot\nu}{1+\nu}+i\left(\frac{P/b}{1+\nu}+u\right)"
            r"\right],\qquad\frac{\dot\beta}{\beta}=\frac12 \left[-\frac{\dot\nu}{1-\nu}+i\left(\frac{P/b}{1-\nu"
            r"}-u\right)\right]"
        ),
        assumptions=("I1 = I2, third axis of inertia along e3 at t = 0", "z along B"),
    ),
)
