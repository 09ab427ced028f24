"""Section II, first half, on trial: six constrained particles, varied from the action, (1) to (9).

Six particles are the fewest for which every sum of the paper has more than one term: particle 1, the frame 2, 3, 4, and
two more. Nothing in the derivation depends on their number.
"""

import ast
from dataclasses import replace
from functools import cache
from typing import Any

import sympy

from atlas.trial.proofs.model import Model, Value, cross, dot, matrix, partial, vector
from atlas.trial.proofs.notation import equations
from atlas.trial.proofs.trial import Falsehood, Part, Trial

ALL, FRAME, REST = (1, 2, 3, 4, 5, 6), (2, 3, 4), (5, 6)
RANGES = {"N": ALL, "A": FRAME, "B": FRAME, "alpha": REST, "beta": REST}
SIGNS = {
    r"\mathbf{B}": "Bf",
    "m": "m[]",
    r"\mathbf{y}": "y[]",
    r"\dot{\mathbf{y}}": "dy[]",
    r"\ddot{\mathbf{y}}": "ddy[]",
    r"\dot{\mathbf{y}}_0": "dy0",
    r"\ddot{\mathbf{y}}_0": "ddy0",
    r"\mathbf{y}_0": "y0",
    r"\mathbf{x}": "x[]",
    r"\dot{\mathbf{x}}": "dx[]",
    r"\ddot{\mathbf{x}}": "ddx[]",
    "x": "x[]",
    "a": "a[]",
    r"\lambda": "lam[]",
    r"\dot R": "dR[]",
    # the limits of sums, which are those of RANGES
    r"\sum_{N=1}^{n}": r"\sum_N",
    r"\sum_{N=1}^n": r"\sum_N",
    r"\sum_{A=2}^{4}": r"\sum_A",
    r"\sum_{A=2}^4": r"\sum_A",
    r"\sum_{B=2}^4": r"\sum_B",
    r"\sum_{A,B=2}^{4}": r"\sum_{AB}",
    r"\sum_{A,B=2}^4": r"\sum_{AB}",
    r"\sum_{\beta=5}^{n}": r"\sum_\beta",
    r"\sum_{\alpha=5}^n": r"\sum_\alpha",
}

m = {N: sympy.Symbol(f"m{N}", positive=True) for N in ALL}
y = {N: vector(f"y{N}_") for N in ALL}
dy = {N: vector(f"v{N}_") for N in ALL}
lam = {(A, C): sympy.Symbol(f"lam{min(A, C)}{max(A, C)}", real=True) for A in FRAME for C in FRAME}
lam |= {(A, N): sympy.Symbol(f"lam{A}{N}", real=True) for A in FRAME for N in REST}
distances = {key: sympy.Symbol(f"a{min(key)}{max(key)}", real=True) for key in lam}
E, Bf = vector("E"), vector("B")
mu, c = sympy.symbols("mu c", positive=True)
COMMON = {"m": m, "lam": lam, "mu": mu, "c": c, "E": E, "Bf": Bf, "a": distances}


def potential_energy(*, equal: bool = True) -> Value:
    """Return minus U of (2): the sum of e A0(y) + (e/c) (A(y), v) over particles, A0 = (y, E), A = [B, y]/2.

    The result is one SymPy expression in the symbols y, v, E, B. All particles have one ratio mu of charge to mass,
    as in the paper, or, unless ``equal``, each its own.
    """
    charges = {N: (mu if equal else sympy.Symbol(f"mu{N}", real=True)) * m[N] for N in ALL}
    return sum(charges[N] * (dot(y[N], E) + dot(cross(Bf, y[N]), dy[N]) / (2 * c)) for N in ALL)


def free_action() -> Value:
    """Return the Lagrangian without fields: kinetic energy plus half of each constraint times its multiplier."""
    kinetic = sum(m[N] * dot(dy[N], dy[N]) for N in ALL) / 2
    inner = {key: dot(y[key[0]] - y[1], y[key[1]] - y[1]) - distances[key] for key in lam}
    return kinetic + sum(lam[key] * inner[key] for key in lam) / 2


@cache
def forces(*, equal: bool = True) -> dict[int, Value]:
    """Return by particle the mass times acceleration (3, 1), from the varied action d/dt dL/dv = dL/dy; cached.

    Unless ``equal`` each particle has its own ratio of charge to mass.
    """
    L = sympy.expand(free_action() + potential_energy(equal=equal))
    sums = {}
    for N in ALL:
        momentum = partial(L, dy[N])
        drift = sum((momentum.jacobian(y[M]) * dy[M] for M in ALL), sympy.zeros(3, 1))
        sums[N] = (partial(L, y[N]) - drift).applyfunc(sympy.expand)
    return sums


def action_model() -> Model:
    """Return the model of (1): places y, velocities dy (by particle) and the Lagrangian L without potential energy."""
    return Model({**COMMON, "y": y, "dy": dy, "L": free_action()}, ranges=RANGES)


def potential_model() -> Model:
    """Return the model of (2): places, velocities, the energy U, and by particle the potentials A0, A and charge e."""
    A0 = {N: dot(y[N], E) for N in ALL}
    A = {N: cross(Bf, y[N]) / 2 for N in ALL}
    e = {N: mu * m[N] for N in ALL}
    return Model({**COMMON, "y": y, "dy": dy, "U": -potential_energy(), "A0": A0, "A": A, "e": e}, ranges=RANGES)


def particles_model() -> Model:
    """Return the model of (3), (4): accelerations ddy of the particles from the action, rates dy0, ddy0 of the centre.

    The centre is that of mass; mu0 is the total mass.
    """
    forces_on_particles = forces()
    ddy = {N: forces_on_particles[N] / m[N] for N in ALL}
    mass = sum(m.values())
    centre = {"dy0": sum((m[N] * dy[N] for N in ALL), sympy.zeros(3, 1)) / mass, "mu0": mass}
    centre["ddy0"] = sum(forces_on_particles.values(), sympy.zeros(3, 1)) / mass
    return Model({**COMMON, "y": y, "dy": dy, "ddy": ddy, **centre}, ranges=RANGES)


@cache
def relative_model(*, equal: bool = True) -> Model:
    """Return the model of (5): places x, velocities dx and accelerations ddx about the centre of mass; cached.

    The centre has the acceleration (4), or, unless ``equal``, the mean of the particles'. Places and velocities of all
    particles but the last are letters; those of the last follow. `lami` is the multiplier lambda^i of (5).
    """
    mass = sum(m.values())
    y0, v0 = vector("y0_"), vector("v0_")
    x, dx = _about_centre(y), _about_centre(dy)
    swap = {old: new for N in ALL for old, new in zip([*y[N], *dy[N]], [*(y0 + x[N]), *(v0 + dx[N])], strict=True)}
    relative_forces = {N: force.xreplace(swap) for N, force in forces(equal=equal).items()}
    basis = sum(relative_forces.values(), sympy.zeros(3, 1))
    a0 = mu * E + mu / c * cross(v0, Bf) if equal else basis / mass
    # the multiplier of (5) that keeps the sum of m_N x_N zero: in the sum of its equations the others cancel
    push = mu * mass * E + mu / c * cross(sum((m[N] * dx[N] for N in ALL), sympy.zeros(3, 1)), Bf)
    letters = {"ddx": _components({N: relative_forces[N] / m[N] - a0 for N in ALL}), "x": _components(x), "dx": dx}
    letters |= {"y0": y0, "dy0": v0, "ddy0": basis / mass}
    letters["lami"] = {i + 1: sympy.cancel(component / mass) for i, component in enumerate(basis - mass * a0 - push)}
    return Model({**COMMON, **letters}, ranges=RANGES)


def _about_centre(places: dict[int, Value]) -> dict[int, Value]:
    """Return a copy of places (3, 1) by particle, the last replaced so that the centre of mass is 0."""
    remainder = -sum((m[N] * places[N] for N in ALL[:-1]), sympy.zeros(3, 1)) / m[ALL[-1]]
    return {**places, ALL[-1]: remainder}


def free_model(*, equal: bool = True) -> Model:
    """Return `relative_model` with the index N over all particles but the last, whose place follows from the others.

    ``equal`` as there. It serves text-translation, text-electric-field and text-rotation-apart.
    """
    basis = relative_model(equal=equal)
    return replace(basis, ranges={**RANGES, "N": ALL[:-1]})


def _push(x: dict[int, Value]) -> dict[int, Value]:
    """Return by particle the force (3, 1) of the constraints, with the particles at places ``x`` and without fields."""
    no_field = dict.fromkeys((*E, *Bf), 0)
    places = {s: value for N in ALL for s, value in zip(y[N], x[N], strict=True)}
    return {N: forces()[N].xreplace(no_field).xreplace(places) for N in ALL}


def _components(x: dict[int, Value]) -> dict[Any, Value]:
    return {**dict[Any, Value](x), **{(N, i): x[N][i - 1] for N in ALL for i in (1, 2, 3)}}


def rotation_model() -> Model:
    """Return the model of (6) to (9): particles at x_N(t) = R x_N(0), with any matrices R and dR.

    R need not be a rotation: the proofs are linear algebra. g is the sum of m x x^T, lamM the matrix of multipliers
    (9), ddRg is d2R g by (6), A the force matrix (7).
    """
    x = y
    R, dR = matrix("R"), matrix("W")
    push = _push(x)
    spun = {N: R * push[N] + mu * m[N] * E + mu / c * m[N] * cross(dR * x[N], Bf) for N in ALL}
    letters = {
        "x": _components(x),
        "moved": _components({N: R * x[N] for N in ALL}),
        "R": R,
        "dR": dR,
        "total": sum((m[N] * x[N] for N in ALL), sympy.zeros(3, 1)),
        "g": sum((m[N] * x[N] * x[N].T for N in ALL), sympy.zeros(3, 3)),
        "lamM": -sum((x[N] * push[N].T for N in ALL), sympy.zeros(3, 3)),
        "ddRg": sum((spun[N] * x[N].T for N in ALL), sympy.zeros(3, 3)),
        "A": sympy.Matrix.hstack(*(-mu / c * cross(dR.col(a), Bf) for a in range(3))),
    }
    return Model({**COMMON, **letters}, start=dict(zip(R, sympy.eye(3), strict=True)), ranges=RANGES)


def rigid_model() -> Model:
    """Return the model of text-rigid: vectors from particle 1 to 2, 3, 4 as columns of X at t, X0 at 0; R = X X0^-1."""
    X, X0 = matrix("X"), matrix("Y")
    letters = {"X": X, "X0": X0, "R": X * X0.adjugate() / X0.det(), "inverse": X0.adjugate() / X0.det()}
    letters["x"] = {N: X.col(N - 2) for N in FRAME}
    return Model(letters, start=dict(zip(X, X0, strict=True)), ranges={"N": FRAME})


def plane_model() -> Model:
    """Return the model of text-rigid's exception: vectors X in one plane, x0 in the plane, and x above x0.

    x is x0 plus ``height`` times the normal e3.
    """
    X = sympy.Matrix([[1, 0, sympy.Symbol("p3", real=True)], [0, 1, sympy.Symbol("p4", real=True)], [0, 0, 0]])
    x0, height = sympy.Matrix([*sympy.symbols("p1:3", real=True), 0]), sympy.Symbol("height", positive=True)
    return Model({"X": X, "x0": x0, "x": x0 + sympy.Matrix([0, 0, height]), "height": height})


def spatial_model() -> Model:
    """Return the model of three independent vectors X, a place x0, and the x with the same products: X^T x = X^T x0.

    It serves the corrected text-rigid: x is x0.
    """
    X, x0 = matrix("X"), vector("p")
    return Model({"X": X, "x0": x0, "x": (X.T.adjugate() / X.det()) * (X.T * x0)})


def _equivalent(line: str) -> str:
    """Return the line "(1 + delta) (X - 0) = P - Q" for the line "X = 0; P = Q".

    Each of the two equations then follows from the other.
    """
    slope, held_ = equations(line)
    minuend, subtrahend = (ast.unparse(side) for side in (held_.left, held_.comparators[0]))
    zero = ast.unparse(slope.comparators[0])
    return f"(1 + delta[A,B])*({ast.unparse(slope.left)} - {zero}) = {minuend} - {subtrahend}"


TRIALS = {
    "(1)": Trial(signs={r"S=\int dt": "L ="}, model=action_model, definition=True),
    "text-constraints": Trial(
        also=("2*partial(L,lam[A,beta]) = dot(y[A] - y[1], y[beta] - y[1]) - a[A,beta]",),
        model=action_model,
        form=_equivalent,
        arrows={1: ""},
        false=Falsehood("dot(y[A] - y[1], y[beta] - y[1])", "dot(y[beta] - y[1], y[beta] - y[1])"),
    ),
    "(2)": Trial(
        signs={r"A_0(\mathbf{y}_N)": "A0[N]", r"\mathbf{A}(\mathbf{y}_N)": "A[N]"},
        model=potential_model,
        definition=True,
    ),
    "(3)": Trial(model=particles_model),
    "(4)": Trial(model=particles_model),
    "text-translation": Trial(model=free_model, false=Falsehood(model=lambda: free_model(equal=False))),
    "text-rigid": Trial(
        signs={
            r"R^TR=\mathbf{1}": "T(R)*R - one = T(inverse)*(T(X)*X - T(X0)*X0)*inverse",
            r"\det(\mathbf{y}_2-\mathbf{y}_1,\mathbf{y}_3-\mathbf{y}_1,\mathbf{y}_4-\mathbf{y}_1)\ne0\implies": "",
        },
        model=rigid_model,
        corrected_also=(
            Part(line="T(X)*x = T(X)*x0; dot(x,x) = dot(x0,x0)", model=spatial_model),
            Part(line="T(X)*x = T(X)*x0; dot(x,x) = dot(x0,x0) + height^2", model=plane_model),
        ),
        false=Falsehood("T(R)*R - one = T(inverse)*(T(X)*X - T(X0)*X0)*inverse", "T(R)*R = one"),
    ),
    "(5)": Trial(
        signs={
            r"\mathbf{E}": "E[i]",
            "E^i": "E[i]",
            r"\ddot x": "ddx[]",
            r"\lambda^i": "lami[i]",
            "x^i_1": "x[1,i]",
            **{
                rf"[\dot{{\mathbf{{x}}}}_{N},\mathbf{{B}}]{up}": f"cross(dx[{N.strip(chr(92))}], Bf)[i]"
                for N in ("1", "A", r"\alpha")
                for up in ("", "{}^i")
            },
        },
        model=relative_model,
    ),
    "(6)": Trial(
        excluded=(r"$\mathbf{x}_N(t) = R(t) \mathbf{x}_N(0)$",),
        signs={
            "E": "E[]",
            r"\ddot R_{ik}g_{kj}": "ddRg[i,j]",
            r"\lambda": "lamM[]",
            r"R^TR=\mathbf{1}": "",
            r"R(0)=\mathbf{1}": "",
        },
        corrected_signs={"x": "moved[]"},
        model=rotation_model,
    ),
    "(7)": Trial(signs={"B": "Bf[]"}, model=rotation_model, definition=True),
    "(8)": Trial(signs={"x": "moved[]"}, model=rotation_model, definition=True),
    "(9)": Trial(
        signs={
            r"\lambda_{jk}": "lamM[j,k]",
            **{
                f"x_{N}^{{(j}}x_{M}^{{k)}}": f"(x[{n},j]*x[{m},k] + x[{n},k]*x[{m},j])"
                for N, M, n, m in (
                    ("B", "1", "B", "1"),
                    (r"\alpha", "A", "alpha", "A"),
                    (r"\alpha", "1", "alpha", "1"),
                    ("A", "1", "A", "1"),
                )
            },
        },
        model=rotation_model,
    ),
    "text-multipliers-symmetric": Trial(
        signs={r"\lambda": "lamM[]"},
        model=rotation_model,
        false=Falsehood("lamM[j, k] = lamM[k, j]", "lamM[j, k] + (T(R)*A*g)[j, k] = lamM[k, j] + (T(R)*A*g)[k, j]"),
    ),
    "text-electric-field": Trial(model=free_model, false=Falsehood(model=lambda: free_model(equal=False))),
    "text-rotation-apart": Trial(model=free_model, false=Falsehood(model=lambda: free_model(equal=False))),
}
