"""Equations of motion, inertia and units: the kernels agree with the ledger's (8) to (18) and (32) to (39)."""

from functools import partial
from types import SimpleNamespace
from typing import Any

import numpy as np
import sympy
from agreement import Floor, Ledger, Tie, agree, bodies, each, letters, power, signed, vector


def states(seed: int, count: int) -> list[Any]:
    """Return states of bodies without symmetry: the inertia tensor of three masses, R any matrix, all else vectors."""
    draw, points = np.random.default_rng(seed), []
    for _ in range(count):
        p = SimpleNamespace(
            masses=draw.uniform(0.5, 2, 3), places=draw.uniform(-2, 2, (3, 3)), R=draw.normal(size=(3, 3))
        )
        centred = p.places - p.masses @ p.places / p.masses.sum()
        g = (p.masses[:, None] * centred).T @ centred
        g = (g + g.T) / 2 + np.diag(draw.uniform(0.1, 1, 3))
        p.inertia = g.trace() * np.eye(3) - g
        p.Omega, p.K, p.M, p.m, p.B = (np.array(vector(draw)) for _ in range(5))
        p.mu, p.c, p.mass, p.t = signed(draw), abs(signed(draw)), abs(signed(draw)), signed(draw)
        points.append(p)
    return points


POINTS = states(27, 6)
at_points = partial(Tie, points=POINTS)
in_core = partial(Tie, points=POINTS, floors=("kernel",))
of_symmetric = partial(Tie, points=bodies(46, 8), floors=("kernel",))


def exact(values: Any) -> Any:
    """Return a matrix of rationals, a vector as a column."""
    return sympy.Matrix(np.vectorize(sympy.Rational, otypes=[object])(values))


def norm(x: Any) -> float:
    """Return the size of a vector or a matrix."""
    return float(np.linalg.norm(np.asarray(x, dtype=float)))


def body(say: Ledger, p: Any) -> dict[str, Any]:
    """Return the tensor I and the mass matrix g, of which text-inertia-tensor makes I."""
    tensor = exact(p.inertia)
    g = tensor.trace() / 2 * sympy.eye(3) - tensor
    assert say("text-inertia-tensor", "I[i,j]", g=g) == tensor
    return {"I": tensor, "g": g}


def acceleration(say: Ledger, p: Any) -> Any:
    """Return dOmega/dt of (34)."""
    equations = body(say, p)
    return equations["I"].inv() * say("(34)", "IdOmega", K=p.K, Omega=p.Omega, **equations)


def acceleration_in_field(say: Ledger, p: Any) -> Any:
    """Return dOmega/dt of (16), in B' = mu B/(2c)."""
    equations = body(say, p)
    return equations["I"].inv() * say("(16)", "IdOmega", mu=2, light=1, R=p.R, Bf=p.B, Omega=p.Omega, **equations)


def tensor(p: Any) -> Any:
    """Return the inertia tensor of a symmetric body over I2, in floats."""
    return np.diag([float(p.I2), float(p.I2), float(p.I3)])


def symmetric(p: Any, sides: str) -> dict[str, Any]:
    """Return the letters of (38) to (41) that are in `sides`."""
    every = {f"Omega{n + 1}": x for n, x in enumerate(p.omega)} | {f"K{n + 1}": x for n, x in enumerate(p.K)}
    every |= {"I": p.I}
    return {name: every[name] for name in sides.split()}


STATE = "Omega1 Omega2 Omega3 K1 K2 K3"


def mass_elements(say: Ledger, moments: Any) -> list[Any]:
    """Return g1, g2, g3 of text-mass-moments."""
    equal_moments = {f"I{n + 1}": x for n, x in enumerate(moments)}
    return [say("text-mass-moments", f"2*g{n}", **equal_moments) / 2 for n in (1, 2, 3)]


def of_points(say: Ledger, p: Any) -> Any:
    """Return (8) of three masses, counted from their centre."""
    m, x = exact(p.masses), exact(p.places)
    centre = (m.T * x) / sum(m)
    return say("(8)", "g[i,j]", at0=lambda x: x, m=m, moved=sympy.Matrix(3, 3, lambda i, j: x[i, j] - centre[j]))


def shell_ratio(f: Floor, p: Any) -> Any:
    """Return I3/I2 of a cylindrical surface by its exact moments."""
    I2, I3 = f.body.shape_moments("cylindrical_shell", mass=p.mass, radius=p.c, height=abs(p.mu))
    return I3 / I2


EQUATIONS = (
    in_core(
        "euler_poisson.hat",
        "(74)",
        lambda f, p: p.K @ f.euler_poisson.hat(p.Omega),
        lambda say, p: say("(74)", "dgamma", gamma=p.K, Omega=p.Omega),
        size=lambda _true, p: norm(p.K) * norm(p.Omega),
    ),
    in_core(
        "euler_poisson.bracket",
        "(74)",
        lambda f, p: f.euler_poisson.bracket(p.K, p.Omega),
        lambda say, p: say("(74)", "dgamma", gamma=p.K, Omega=p.Omega),
        size=lambda _true, p: norm(p.K) * norm(p.Omega),
    ),
    in_core(
        "euler_poisson.field_in_body",
        "(32)",
        lambda f, p: f.euler_poisson.field_in_body(p.R, p.B),
        lambda say, p: say("(32)", "K", Bp=p.B, R=p.R),
        size=lambda _true, p: norm(p.R) * norm(p.B),
    ),
    in_core(
        "euler_poisson.field_rate",
        "(35)",
        lambda f, p: f.euler_poisson.field_rate(p.K, p.Omega),
        lambda say, p: say("(35)", "dK", K=p.K, Omega=p.Omega),
        size=lambda _true, p: norm(p.K) * norm(p.Omega),
    ),
    of_symmetric(
        "euler_poisson.field_rate",
        "(39)",
        lambda f, p: f.euler_poisson.field_rate(p.K, p.omega),
        lambda say, p: [say("(39)", f"d(K{n})", **symmetric(p, STATE)) for n in (1, 2, 3)],
        size=power(2),
    ),
    in_core(
        "euler_poisson.angular_acceleration",
        "(34) text-inertia-tensor",
        lambda f, p: f.euler_poisson.angular_acceleration(p.inertia, p.K, p.Omega),
        acceleration,
        size=lambda _true, p: np.linalg.cond(p.inertia) * (norm(p.Omega) + norm(p.K)) * norm(p.Omega),
        ulps=8,
    ),
    in_core(
        "euler_poisson.angular_acceleration",
        "(16) text-inertia-tensor",
        lambda f, p: f.euler_poisson.angular_acceleration(p.inertia, f.euler_poisson.field_in_body(p.R, p.B), p.Omega),
        acceleration_in_field,
        size=lambda _true, p: np.linalg.cond(p.inertia) * (norm(p.Omega) + norm(p.R) * norm(p.B)) * norm(p.Omega),
        ulps=8,
    ),
    of_symmetric(
        "euler_poisson.angular_acceleration",
        "(38)",
        lambda f, p: f.euler_poisson.angular_acceleration(tensor(p), p.K, p.omega),
        lambda say, p: [say("(38)", f"d(Omega{n})", I=p.I, **symmetric(p, STATE)) for n in (1, 2, 3)],
        size=lambda true, p: power(2)(true, p) * max(1, 1 / float(p.I)),
        ulps=8,
    ),
)

MATTER = (
    in_core(
        "inertia.mass_matrix",
        "text-inertia-tensor",
        lambda f, p: f.inertia.mass_matrix(p.inertia),
        lambda say, p: body(say, p)["g"],
        size=lambda _true, p: norm(p.inertia),
    ),
    in_core(
        "inertia.mass_matrix_from_inertia",
        "text-mass-moments",
        lambda f, p: f.inertia.mass_matrix_from_inertia(p.inertia.diagonal()),
        lambda say, p: mass_elements(say, p.inertia.diagonal()),
        size=lambda _true, p: norm(p.inertia),
    ),
    in_core(
        "inertia.inertia_from_mass_matrix",
        "text-inertia-tensor",
        lambda f, p: f.inertia.inertia_from_mass_matrix(p.inertia),
        lambda say, p: say("text-inertia-tensor", "I[i,j]", g=p.inertia),
        size=lambda _true, p: norm(p.inertia),
    ),
    in_core(
        "inertia.mass_matrix_of_points",
        "(8)",
        lambda f, p: f.inertia.mass_matrix_of_points(p.masses, p.places),
        of_points,
        size=lambda _true, p: norm(p.masses) * norm(p.places) ** 2,
        ulps=8,
    ),
    of_symmetric(
        "SymmetricBody.ratio",
        "(33)",
        lambda f, p: f.SymmetricBody(float(p.I2), float(p.I3)).ratio,
        lambda say, p: say("(33)", "I", **letters(p, "I2 I3")),
    ),
    of_symmetric(
        "SymmetricBody.mass_matrix",
        "text-mass-matrix",
        lambda f, p: f.SymmetricBody(float(p.I2), float(p.I3)).mass_matrix,
        lambda say, p: say("text-mass-matrix", "g", diag=sympy.diag, **letters(p, "I2 I3")).diagonal(),
        size=lambda _true, p: float(p.I2),
    ),
    in_core(
        "SymmetricBody.cylindrical_shell",
        "text-short-cylinder",
        lambda f, p: f.SymmetricBody.cylindrical_shell(p.mass, p.c, abs(p.mu)).ratio,
        lambda say, p: say("text-short-cylinder", "I", r=p.c, h=abs(p.mu)),
    ),
    at_points(
        "body.shape_moments",
        "text-short-cylinder",
        shell_ratio,
        lambda say, p: say("text-short-cylinder", "I", r=p.c, h=abs(p.mu)),
        floors=("certified",),
    ),
    in_core(
        "Field.prime",
        "(32)",
        lambda f, p: f.Field(p.B, mu=p.mu, c=p.c).prime,
        lambda say, p: say("(32)", "Bp", mu=p.mu, c=p.c, Bf=p.B),
    ),
    in_core(
        "units.prime",
        "(32)",
        lambda f, p: f.units.prime(p.mu, p.B, p.c),
        lambda say, p: say("(32)", "Bp", mu=p.mu, c=p.c, Bf=p.B),
    ),
    in_core(
        "units.larmor_field",
        "(27) (32)",
        lambda f, p: [f.units.larmor_field(p.mu, p.B), f.units.larmor_field(p.mu, p.c, "Gaussian")],
        lambda say, p: [
            *say("(32)", "Bp", mu=p.mu, c=1, Bf=p.B),
            say("(27)", "alpha", mu=p.mu, Bf=[0, 0, p.c], c=29_979_245_800),
        ],
    ),
    in_core(
        "units.cyclotron_frequency",
        "(97)",
        lambda f, p: f.units.cyclotron_frequency(p.mu, p.c),
        lambda say, p: say("(97)", "omega", mu=p.mu, Bf=[0, 0, p.c], c=1),
    ),
    in_core(
        "units.charge_to_mass",
        "(89)",
        lambda f, p: f.units.charge_to_mass(p.mu, p.mass),
        lambda say, p: (
            say("(89)", "m*ddy", e=p.mu, c=1, E=[1, 0, 0], v=[0, 0, 0], Bf=[0, 0, 0])[0] / sympy.Rational(p.mass)
        ),
    ),
)

TIES = (*EQUATIONS, *MATTER)


@each(EQUATIONS)
def test_the_equations_of_motion_agree_with_the_ledger(tie: Tie, floor: str) -> None:
    """For any inertia tensor, and in components for a symmetric body."""
    agree(tie, floor)


@each(MATTER)
def test_ingredients_of_the_equations_agree_with_the_ledger(tie: Tie, floor: str) -> None:
    """Inertia tensors, mass matrices, and the field B' in both systems of units."""
    agree(tie, floor)
