"""Closed motions of the elementary family, and the free body beside each."""

from atlas.trial.ledger.equation import FIELD, OFF_LINES, Equation

EQUATIONS = {
    "theorem-closed": Equation(
        says=r"One elementary motion, and no other, has $\phi/k = \varrho$, for every $\varrho$ but two",
        tex=r"\frac{\phi}{k}=\varrho\iff k=-b\,\frac{2(1-I)\hat B_3-I\varrho}{(1-I)\hat B_3-I\varrho},\qquad\varrho\ne"
        r"\frac{(1-I)\hat B_3}{I},\ \frac{2(1-I)\hat B_3}{I}",
        assumptions=(FIELD, OFF_LINES, "$I$ differs from 1", "$k$ differs from 0, the motion at rest"),
    ),
    "theorem-closed-free": Equation(
        says="What the field does to the proper rotation at the same precession depends on $k$ alone",
        tex=r"\frac{\phi_B}{\phi}=\frac{2b+k}{b+k}",
        assumptions=(
            FIELD,
            OFF_LINES,
            r"$\phi$ of @(87) for the same $k$, $I$ differs from 1",
            "$k$ differs from 0, the motion at rest",
        ),
    ),
}
