"""How a report prints the quantities and regimes of the stress runs that have letters in their names: as TeX."""

from collections.abc import Mapping

TITLES: Mapping[str, str] = {
    "R": "$R$",
    "R at one time": "$R$ at one time",
    "R grid": "$R$ grid",
    "R orthogonality": "$R$ orthogonality",
    "R determinant": "$R$ determinant",
    "R(0) = 1": "$R(0) = 1$",
    "R13, R23 for |kt| < 1": "$R_{13}$, $R_{23}$ for $|kt| < 1$",
    "R under scaling by 2^n": "$R$ under scaling by $2^n$",
    "k": "$k$",
    "phi": r"$\phi$",
    "omega3": r"$\omega_3$",
    "Omega": r"$\boldsymbol{\Omega}$",
    "K": r"$\mathbf{K}$",
    "m": r"$\mathbf{m}$",
    "beta": r"$\beta$",
    "a2": "$a_2$",
    "a3": "$a_3$",
    "omega3 of the hyperbola": r"$\omega_3$ of the hyperbola",
    "k of the hyperbola": "$k$ of the hyperbola",
    "phi of the hyperbola": r"$\phi$ of the hyperbola",
    "ball R": "ball $R$",
    "ball gamma": r"ball $\gamma$",
    "ball k_hat": r"ball $\hat{\mathbf{k}}$",
    "ball m": r"ball $\mathbf{m}$",
    "ball Omega": r"ball $\boldsymbol{\Omega}$",
    "free R": "free $R$",
    "free k": "free $k$",
    "free phi": r"free $\phi$",
    "free Omega": r"free $\boldsymbol{\Omega}$",
    "general R": "general $R$",
    "general R grid": "general $R$ grid",
    "general Omega": r"general $\boldsymbol{\Omega}$",
    "general K": r"general $\mathbf{K}$",
    "general R(0) = 1": "general $R(0) = 1$",
    "I near 1": "$I$ near 1",
    "I near 2": "$I$ near 2",
    "I near 0": "$I$ near 0",
    "omega2 near -B2": r"$\omega_2$ near $-B_2$",
    "omega2 near -2 B2": r"$\omega_2$ near $-2 B_2$",
    "omega2 near -(2-I) B2": r"$\omega_2$ near $-(2-I) B_2$",
    "omega2 near 0": r"$\omega_2$ near 0",
    "I near 1, omega2 near -B2": r"$I$ near 1, $\omega_2$ near $-B_2$",
    "B3/B2 from 1e-12 to 1e12": "$B_3/B_2$ from $10^{-12}$ to $10^{12}$",
    "B3 = 0, B2 = B3": "$B_3 = 0$, $B_2 = B_3$",
    "scales 1e-140 to 1e140": "scales $10^{-140}$ to $10^{140}$",
    "k and phi resonant": r"$k$ and $\phi$ resonant",
    "general, I near 1": "general, $I$ near 1",
    "general, I near 2": "general, $I$ near 2",
    "general, scales 1e-140 to 1e140": "general, scales $10^{-140}$ to $10^{140}$",
    "B2 = 0": "$B_2 = 0$",
    "particle y": r"particle $\mathbf{y}$",
    "particle v": r"particle $\mathbf{v}$",
}


def title(name: str) -> str:
    """Return the Markdown of a quantity, or of a regime, also with its times: ``I near 1, long times``."""
    regime, comma, times = name.rpartition(", ")
    if name in TITLES or not comma:
        return TITLES.get(name, name)
    return f"{TITLES.get(regime, regime)}, {times}"
