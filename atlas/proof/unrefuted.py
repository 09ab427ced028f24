"""Why some mutants are not refuted: what they say is true as well, or cannot be told apart from what is meant."""

import re

_SYMMETRIC = "The indices of a symmetric matrix are exchanged, which changes nothing."
_CONSTANTS = "A constant of integration is arbitrary: its sign, a factor or a shift gives another one."
_FIRST_K = r"At $t = 0$ the first component of $\mathbf{K}$ is 0, whatever multiplies it."
_ZERO = "A number that is 0 remains so, whatever multiplies it."
_EVEN = r"$H$ and $F$ are even in $\mathbf{M}$."
_AT_REST = "At rest the rate of every component is 0, so one may stand for another."

REASONS: dict[str, tuple[tuple[str, str], ...]] = {
    "(1)": (("", _SYMMETRIC),),
    "text-constraints": (("", _SYMMETRIC),),
    "(3)": (("", _SYMMETRIC),),
    "(5)": (("", _SYMMETRIC),),
    "(6)": (("", _SYMMETRIC),),
    "(8)": (("", _SYMMETRIC),),
    "(9)": (("", _SYMMETRIC),),
    "text-multipliers-symmetric": (("", "A matrix is equal to itself."),),
    "(10)": (("", _SYMMETRIC),),
    "text-affirmation": (("", _SYMMETRIC),),
    "text-nondegenerate": (("", "All three moments are positive, and so is the product of any three of them."),),
    "(11)": (("", _SYMMETRIC),),
    "text-inertia-tensor": (("", _SYMMETRIC),),
    "text-force-matrix": (("", "$R R^T$ is symmetric: its indices are exchanged, which changes nothing."),),
    "text-flight": (
        ("", r"What is linear in $\mathbf{x}_N$ sums to zero about the centre of mass, whatever multiplies it."),
    ),
    "(19)": (("", "Every moment of a ball is the same number, so one may stand for another."),),
    "text-ball-body-precession": (
        ("", r"The vector product of $\boldsymbol{\Omega}$ with itself is 0, whatever multiplies it."),
    ),
    "(26)": (
        ("", r"The first column of the matrix is multiplied by the first component of $\mathbf{m}(0)$, which is 0."),
    ),
    "text-mass-matrix": (("", "$g_1 = g_2$, so one may stand for the other."),),
    "(37)": (("", _FIRST_K),),
    "text-quadric-origin": (
        (r"\(omega2 (\+ -|- )B2\) \^ 2", "At the origin only the square of $B'_2$ is left of that bracket."),
        ("", r"At the origin $\boldsymbol{\omega} = 0$, whatever multiplies or exchanges its components."),
    ),
    "(52)": (("", "For $I > 1$ both terms stay positive with this change, and so does their sum."),),
    "(53)": (("", r"Only the square of $\omega'_1$ occurs."),),
    "text-beta-range": (
        (r"-\(pi / 4\)|pi / 5", "The lower bound is a weaker one."),
        (r"< 2 \* \(pi / 2\)|< pi \* 2", "The upper bound is a weaker one."),
        ("beta / 3", r"A third of $\beta$ lies between the same bounds as half of it."),
    ),
    "text-not-all": (("", "$B'_3$ is positive as $B'_2$ is."),),
    "text-cubic-degree": (("", "The square of twice a number is positive as well."),),
    "(58)": (("", "Any of the initial components is a constant."),),
    "(61)": (("", _FIRST_K),),
    "(78)": (("", _AT_REST),),
    "(83)": (("", _AT_REST),),
    "(88)": (("", r"The first component of $\mathbf{B}'$ is 0, whatever multiplies it."),),
    "(90)": (("", _CONSTANTS),),
    "(97)": (("", _CONSTANTS),),
    "(98)": (("", _CONSTANTS),),
    "text-first-two-terms": (("", "The numerator is 0, so that it may be multiplied by what divides it."),),
    "text-trochoid-constant": (("", "With the factor put right both sides are 0, whatever multiplies one of them."),),
    "text-potentials": (
        ("", "At a fixed place the vector potential doesn't change with time: its partial rate is 0."),
    ),
    "theorem-stable-short": (
        ("S = ", "Only the square of $S$ occurs."),
        ("", "What is positive or not negative stays so with this change."),
    ),
    "theorem-band": (
        ("<= 1", "What is not positive is below 1 as well."),
        ("", "What is positive stays so with this change."),
    ),
    "theorem-band-ends": (("", "All three factors stay positive with this change, and so does their product."),),
    "theorem-equatorial-field": (("", r"With $B'_3 = 0$ the component $\hat{B}_2$ is 1."),),
    "theorem-bracket": (
        (r"eps\[j, i, k\]", "A sum that is 0 may change its sign."),
        ("", "A multiple of a function that commutes with everything commutes with everything."),
    ),
    "theorem-clebsch": (("", "A tensor and its negative have the same cofactors."),),
    "theorem-involution": (("", "A multiple of a conserved function is conserved, and has the same level sets."),),
    "theorem-steady": (("", "At a root $q$ is 0, whatever multiplies it."),),
    "theorem-nutation": (
        (r"bend\(q, -r\)", "The second derivative of $q$ is an even function."),
        ("", "At a double root $q$ and its slope are 0, whatever multiplies them."),
    ),
    "theorem-companion": (("", "1 to any power is 1."),),
    "theorem-axis-stable": (("", "The rate of a constant is 0, whatever the constant."),),
    "theorem-axis-pendulum": (("", "The pendulum tips over in either sense."),),
    "theorem-top-precession": ((r"^q = .*; at\((-|2 \* )q, r\) = 0", _ZERO),),
    "theorem-top-nutation": (
        (r"(at|slope|bend)\((-|2 \* )q, r\) = 0", _ZERO),
        ("bend.*third", r"The third derivative of $(p - M_3 \nu)^2$ is 0, and its second one is free of $p$."),
    ),
    "theorem-splitting": ((r"[HF]\(-M\)", _EVEN),),
    "theorem-bifurcation": ((r"[HF]\(-elliptic\)", _EVEN),),
    "theorem-top-quadric": ((r"b \* n3", r"$\kappa = 0$ for the paper's body, whatever multiplies it."),),
}
"""For each entry, patterns of changed lines with the reason why these are true; the first that is found counts."""


def reason(name: str, line: str) -> str:
    """Return why a changed line of an entry is not refuted; empty if no reason is on record."""
    return next((why for pattern, why in REASONS.get(name, ()) if re.search(pattern, line)), "")
