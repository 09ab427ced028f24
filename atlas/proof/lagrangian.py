"""Section II, first half, on trial: six constrained particles, varied from the action, (1) to (9).

Six particles are the fewest for which every sum of the paper has more than one term: particle 1, the frame 2, 3, 4, and
two more. Nothing in the derivation depends on their number.
"""

from functools import cache
from typing import Any

import sympy

from atlas.proof import units
from atlas.proof.model import Model, Value, cross, dot, matrix, vector
from atlas.proof.trial import Falsehood, Part, Trial

ALL, FRAME, REST = (1, 2, 3, 4, 5, 6), (2, 3, 4), (5, 6)
RANGES = {"N": ALL, "M": ALL, "A": FRAME, "C": FRAME, "al": REST}

m = {N: sympy.Symbol(f"m{N}", positive=True) for N in ALL}
y = {N: vector(f"y{N}_") for N in ALL}
dy = {N: vector(f"v{N}_") for N in ALL}
lam = {(A, C): sympy.Symbol(f"lam{min(A, C)}{max(A, C)}", real=True) for A in FRAME for C in FRAME}
lam |= {(A, N): sympy.Symbol(f"lam{A}{N}", real=True) for A in FRAME for N in REST}
held = {key: sympy.Symbol(f"a{min(key)}{max(key)}", real=True) for key in lam}
E, Bf = vector("E"), vector("B")
mu, c = sympy.symbols("mu c", positive=True)
COMMON = {"m": m, "lam": lam, "mu": mu, "c": c, "E": E, "Bf": Bf, "a": held}


def ratios(*, equal: bool = True) -> dict[int, Value]:
    """Return the charge-to-mass ratio of each particle: the same for all, as the paper supposes, or one for each."""
    return {N: mu if equal else sympy.Symbol(f"mu{N}", real=True) for N in ALL}


def potential_energy(*, equal: bool = True) -> Value:
    """Minus U of (2): for each particle e A0(y) + (e/c) (A(y), v), A0 = (y, E), A = [B, y]/2, e = mu m."""
    charges = {N: ratio * m[N] for N, ratio in ratios(equal=equal).items()}
    return sum(charges[N] * (dot(y[N], E) + dot(cross(Bf, y[N]), dy[N]) / (2 * c)) for N in ALL)


def free_action() -> Value:
    """Kinetic energy, and each constraint with its multiplier."""
    kinetic = sum(m[N] * dot(dy[N], dy[N]) for N in ALL) / 2
    inner = {key: dot(y[key[0]] - y[1], y[key[1]] - y[1]) - held[key] for key in lam}
    return kinetic + sum(lam[key] * inner[key] for key in lam) / 2


@cache
def forces(*, equal: bool = True) -> dict[int, Value]:
    """Return m times acceleration of each particle: the variation of the action, d/dt dL/dv = dL/dy."""
    L = sympy.expand(free_action() + potential_energy(equal=equal))
    found = {}
    for N in ALL:
        momentum = sympy.Matrix([L.diff(v) for v in dy[N]])
        drift = sum((momentum.jacobian(y[M]) * dy[M] for M in ALL), sympy.zeros(3, 1))
        found[N] = (sympy.Matrix([L.diff(x) for x in y[N]]) - drift).applyfunc(sympy.expand)
    return found


@cache
def action_model() -> Model:
    """Letters of the action."""
    slopes = {key: free_action().diff(multiplier) for key, multiplier in lam.items()}
    letters = {**COMMON, "y": y, "dy": dy, "L": free_action(), "dL": slopes}
    return Model(letters, ranges={**RANGES, "be": REST}, units=units.PARTICLES)


@cache
def potential_model() -> Model:
    """Letters of the potential energy."""
    A0 = {N: dot(y[N], E) for N in ALL}
    A = {N: cross(Bf, y[N]) / 2 for N in ALL}
    e = {N: mu * m[N] for N in ALL}
    return Model({**COMMON, "y": y, "dy": dy, "minusU": potential_energy(), "A0": A0, "A": A, "e": e}, ranges=RANGES)


@cache
def particles_model(*, equal: bool = True) -> Model:
    """Model the particles with accelerations from the action, with equal charge-to-mass ratios or any."""
    found = forces(equal=equal)
    ddy = {N: found[N] / m[N] for N in ALL}
    mass = sum(m.values())
    centre = {"dy0": sum((m[N] * dy[N] for N in ALL), sympy.zeros(3, 1)) / mass, "mu0": mass}
    centre["ddy0"] = sum(found.values(), sympy.zeros(3, 1)) / mass
    centre["stirred"] = stirred
    return Model({**COMMON, "y": y, "dy": dy, "ddy": ddy, **centre}, ranges=RANGES, units=units.PARTICLES)


def stirred(value: Value) -> Value:
    """Give the particles other places and velocities about the same centre of mass with the same velocity."""
    swap: dict[Value, Value] = {}
    for symbols, name in ((y, "s"), (dy, "u")):
        shift = {N: vector(f"{name}{N}_") for N in ALL[:-1]}
        shift[ALL[-1]] = -sum((m[N] * shift[N] for N in ALL[:-1]), sympy.zeros(3, 1)) / m[ALL[-1]]
        swap |= {old: old + new for N in ALL for old, new in zip(symbols[N], shift[N], strict=True)}
    return value.xreplace(swap)


def carried(value: Value) -> Value:
    """Shift the whole body, and give it another velocity."""
    swap: dict[Value, Value] = {}
    for symbols, name in ((y, "s"), (dy, "u")):
        swap |= {old: old + new for N in ALL for old, new in zip(symbols[N], vector(f"{name}_"), strict=True)}
    return value.xreplace(swap)


def other_field(value: Value) -> Value:
    """Put the particles into another electric field."""
    return value.xreplace(dict(zip(E, vector("E_"), strict=True)))


@cache
def relative_model(*, equal: bool = True) -> Model:
    """Model the particles seen from the centre of mass, whose acceleration is that of (4).

    Where each has a charge-to-mass ratio of its own, that acceleration is the mean of theirs.
    """
    found, mass = forces(equal=equal), sum(m.values())
    y0 = sum((m[N] * y[N] for N in ALL), sympy.zeros(3, 1)) / mass
    v0 = sum((m[N] * dy[N] for N in ALL), sympy.zeros(3, 1)) / mass
    whole = sum(found.values(), sympy.zeros(3, 1))
    a0 = mu * E + mu / c * cross(v0, Bf) if equal else whole / mass
    total = whole - mass * a0
    push = mu * mass * E + mu / c * cross(sum((m[N] * (dy[N] - v0) for N in ALL), sympy.zeros(3, 1)), Bf)
    letters = {
        "x": {N: y[N] - y0 for N in ALL},
        "dx": {N: dy[N] - v0 for N in ALL},
        "ddx": {N: found[N] / m[N] - a0 for N in ALL},
        "carried": carried,
        "other_field": other_field,
        # what keeps the sum of m_N x_N zero in (5): the sum of its equations, in which the other multipliers cancel
        "lami": ((total - push) / mass).applyfunc(sympy.cancel),
    }
    return Model({**COMMON, **letters}, ranges=RANGES, units=units.PARTICLES)


def _push(x: dict[int, Value]) -> dict[int, Value]:
    """Return forces of the constraints on particles at x."""
    no_field = dict.fromkeys((*E, *Bf), 0)
    places = {s: value for N in ALL for s, value in zip(y[N], x[N], strict=True)}
    return {N: forces()[N].xreplace(no_field).xreplace(places) for N in ALL}


def _components(x: dict[int, Value]) -> dict[Any, Value]:
    return {**dict[Any, Value](x), **{(N, i): x[N][i - 1] for N in ALL for i in (1, 2, 3)}}


@cache
def rotation_model() -> Model:
    """Model the particles at x_N(t) = R x_N(0); R and its rate are any matrices, as linear algebra needs no more."""
    x = y
    R, dR = matrix("R"), matrix("W")
    push = _push(x)
    spun = {N: R * push[N] + mu * m[N] * E + mu / c * m[N] * cross(dR * x[N], Bf) for N in ALL}
    letters = {
        "x": _components(x),
        "R": R,
        "dR": dR,
        "total": sum((m[N] * x[N] for N in ALL), sympy.zeros(3, 1)),
        "g": sum((m[N] * x[N] * x[N].T for N in ALL), sympy.zeros(3, 3)),
        "lamM": -sum((x[N] * push[N].T for N in ALL), sympy.zeros(3, 3)),
        "ddRg": sum((spun[N] * x[N].T for N in ALL), sympy.zeros(3, 3)),
        "A": sympy.Matrix.hstack(*(-mu / c * cross(dR.col(a), Bf) for a in range(3))),
    }
    return Model({**COMMON, **letters}, ranges=RANGES, units=units.PARTICLES)


@cache
def rigid_model() -> Model:
    """Model the frame of particles 2, 3, 4 seen from particle 1, as columns of X at t and X0 at 0; R X0 = X."""
    X, X0 = matrix("X"), matrix("Y")
    return Model({"X": X, "X0": X0, "R": X * X0.adjugate() / X0.det(), "inverse": X0.adjugate() / X0.det()})


_RELATIVE = """m[1]*ddx[1] = -lam[A,C]*(x[C] - x[1]) - 1/2*lam[A,al]*(x[A] + x[al] - 2*x[1]){lost}
+ mu/c*m[1]*cross(dx[1],Bf);
m[A]*ddx[A] = lam[A,C]*(x[C] - x[1]) + 1/2*lam[A,al]*(x[al] - x[1]){lostA} + mu/c*m[A]*cross(dx[A],Bf);
m[al]*ddx[al] = 1/2*lam[A,al]*(x[A] - x[1]){lostal} + mu/c*m[al]*cross(dx[al],Bf)"""

_MULTIPLIERS = """lamM[j,k] = -lam[A,C]*(x[1,j]*x[1,k] + x[A,j]*x[C,k] - x[C,j]*x[1,k] - x[C,k]*x[1,j])
- 1/2*lam[A,al]*(x[al,j]*x[A,k] + x[al,k]*x[A,j] - x[al,j]*x[1,k] - x[al,k]*x[1,j] - x[A,j]*x[1,k] - x[A,k]*x[1,j]
{sign} 2*x[1,j]*x[1,k])"""


def _line(text: str) -> str:
    return " ".join(text.split())


@cache
def plane_model() -> Model:
    """Model a frame whose vectors X lie in one plane, a particle x0 in it, and x, lifted out of it by a height."""
    X = sympy.Matrix([[1, 0, sympy.Symbol("p3", real=True)], [0, 1, sympy.Symbol("p4", real=True)], [0, 0, 0]])
    x0, height = sympy.Matrix([*sympy.symbols("p1:3", real=True), 0]), sympy.Symbol("height", positive=True)
    return Model({"X": X, "x0": x0, "x": x0 + sympy.Matrix([0, 0, height]), "height": height})


@cache
def spatial_model() -> Model:
    """Model a frame of three independent vectors, a particle x0, and x, solved from the products that are kept."""
    X, x0 = matrix("X"), vector("p")
    return Model({"X": X, "x0": x0, "x": (X.T.adjugate() / X.det()) * (X.T * x0)})


TRIALS = (
    Trial(
        name="(1)",
        tried="L = 1/2*m[N]*dot(dy[N],dy[N]) + 1/2*lam[A,C]*(dot(y[A] - y[1], y[C] - y[1]) - a[A,C])"
        " + 1/2*lam[A,be]*(dot(y[A] - y[1], y[be] - y[1]) - a[A,be])",
        model=action_model,
        follows="kinetic energy of six particles, and each constraint with its multiplier",
        definition=True,
    ),
    Trial(
        name="text-constraints",
        tried="2*dL[A,be] = dot(y[A] - y[1], y[be] - y[1]) - a[A,be];"
        " (1 + delta[A,C])*dL[A,C] = dot(y[A] - y[1], y[C] - y[1]) - a[A,C]",
        model=action_model,
        follows="the action @(1) for six particles, differentiated",
        false=Falsehood(
            "The constraints fix how far the further particles are from particle 1",
            "dot(y[A] - y[1], y[be] - y[1])",
            "dot(y[be] - y[1], y[be] - y[1])",
        ),
    ),
    Trial(
        name="(2)",
        tried="minusU = e[N]*A0[N] + e[N]/c*dot(A[N],dy[N])",
        model=potential_model,
        follows="the sum of @(103) over the particles, with the potentials @(102)",
        definition=True,
    ),
    Trial(
        name="(3)",
        tried="m[1]*ddy[1] = -lam[A,C]*(y[C] - y[1]) - 1/2*lam[A,al]*(y[A] + y[al] - 2*y[1]) + mu*m[1]*E +"
        " mu/c*m[1]*cross(dy[1],Bf);"
        " m[A]*ddy[A] = lam[A,C]*(y[C] - y[1]) + 1/2*lam[A,al]*(y[al] - y[1]) + mu*m[A]*E + mu/c*m[A]*cross(dy[A],Bf);"
        " m[al]*ddy[al] = 1/2*lam[A,al]*(y[A] - y[1]) + mu*m[al]*E + mu/c*m[al]*cross(dy[al],Bf)",
        model=particles_model,
        follows="the variation of the action @(1), @(2) for six particles",
    ),
    Trial(
        name="(4)",
        tried="ddy0 = mu*E + mu/c*cross(dy0,Bf)",
        model=particles_model,
        follows="the sum of @(3) over six particles",
    ),
    Trial(
        name="text-translation",
        tried="stirred(ddy0) = ddy0",
        model=particles_model,
        follows="@(3) summed over six particles, at two states with the same centre of mass",
        false=Falsehood(
            "The flight does not depend on the rotation, whatever the charges of the particles",
            model=lambda: particles_model(equal=False),
        ),
    ),
    Trial(
        name="text-rigid",
        tried="T(R)*R = T(inverse)*(T(X)*X)*inverse; T(inverse)*(T(X0)*X0)*inverse = one",
        model=rigid_model,
        follows="the constraints keep the products $X^T X$ of the frame, so that $R = X X_0^{-1}$ is orthogonal",
        grade="missing case",
        corrected_tried="T(R)*R = T(inverse)*(T(X)*X)*inverse; T(inverse)*(T(X0)*X0)*inverse = one",
        corrected_also=(
            Part(line="T(X)*x = T(X)*x0; dot(x,x) = dot(x0,x0)", model=spatial_model),
            Part(line="T(X)*x = T(X)*x0; dot(x,x) = dot(x0,x0) + height^2", model=plane_model),
        ),
        corrected_tex=(
            r"\boxed{\det(\mathbf{y}_2-\mathbf{y}_1,\mathbf{y}_3-\mathbf{y}_1,\mathbf{y}_4-\mathbf{y}_1)\ne0}\implies"
            r"\mathbf{x}_N(t)=R(t)\,\mathbf{x}_N(0)"
        ),
        note="Three fixed products with an independent frame fix every further particle in it. Particles 1 to 4 must "
        "not lie in one plane, as they do in the loop of Section IV: there @(1) leaves every further particle free to "
        "rise out of the plane, by any height. One particle beside the plane, however light, mends it.",
        false=Falsehood(
            "The matrix that carries the frame along is orthogonal, constraints or not",
            "T(R)*R = T(inverse)*(T(X)*X)*inverse",
            "T(R)*R = one",
        ),
    ),
    Trial(
        name="(5)",
        tried=_line(
            _RELATIVE.format(
                lost=" + m[1]*lami + mu*m[1]*E", lostA=" + m[A]*lami + mu*m[A]*E", lostal=" + m[al]*lami + mu*m[al]*E"
            )
        ),
        model=relative_model,
        follows="@(3) less $m_N$ times @(4), for six particles",
        corrected_tried=_line(
            _RELATIVE.format(
                lost=" + m[1]*lami + mu*m[1]*E", lostA=" + m[A]*lami + mu*m[A]*E", lostal=" + m[al]*lami + mu*m[al]*E"
            )
        ),
        corrected_tex=(
            r"m_1\ddot x_1^i=\ldots+m_1\lambda^i+\mu m_1E^i+\ldots,\qquad\ldots,\qquad\boxed{\lambda^i=-\mu E^i}"
        ),
        corrected_also=(Part(line="lami = -mu*E", model=relative_model),),
        grade="wording",
        note=r"The letter $\lambda^i$ is defined nowhere. As the multiplier that keeps the sum of $m_N \mathbf{x}_N$ "
        r"zero it is $-\mu \mathbf{E}^i$, and then the printed form is right: the two terms cancel, and the "
        "electric field is gone already here. The vectors of the last two terms lack the index that the others have.",
    ),
    Trial(
        name="(6)",
        tried="ddRg[i,j] = -R[i,k]*lamM[k,j] + mu*E[i]*total - A[i,a]*g[a,j]",
        model=rotation_model,
        follows=r"the equations of six particles at $\mathbf{x}_N = R \mathbf{x}_N(0)$, times $\mathbf{x}_N^j(0)$, "
        "summed; the electric force kept",
        corrected_tried="ddRg[i,j] = -R[i,k]*lamM[k,j] + mu*E[i]*total[j] - A[i,a]*g[a,j]",
        corrected_tex=r"\ddot R_{ik}g_{kj}=-R_{ik}\lambda_{kj}+\mu E_i\Bigl(\sum m_N\boxed{x_N^j}\Bigr)-A_{ia}g_{aj}",
        grade="misprint",
        note="The second term lacks its index $j$. It vanishes about the centre of mass, so nothing later suffers.",
    ),
    Trial(
        name="(7)",
        tried="A[i,a] = mu/c*eps[i,n,p]*Bf[n]*dR[p,a]",
        model=rotation_model,
        follows=r"the magnetic force on six particles at $\mathbf{x}_N = R \mathbf{x}_N(0)$",
        definition=True,
    ),
    Trial(
        name="(8)",
        tried="g[i,j] = m[N]*x[N,i]*x[N,j]",
        model=rotation_model,
        follows="the matrix that multiplies the second derivative of $R$ in @(6)",
        definition=True,
    ),
    Trial(
        name="(9)",
        tried=_line(_MULTIPLIERS.format(sign="-")),
        model=rotation_model,
        follows=r"the forces of the constraints on six particles, times $\mathbf{x}_N^j(0)$, summed",
        corrected_tried=_line(_MULTIPLIERS.format(sign="+")),
        corrected_tex=(
            r"\begin{aligned}"
            r" \lambda_{jk}=&-\sum_{AB}\lambda_{AB}\left[x_1^jx_1^k+x_A^jx_B^k-x_B^{(j}x_1^{k)}\right]\\ "
            r"&-\frac12\sum_{A\alpha}\lambda_{A\alpha}\left[x_\alpha^{(j}x_A^{k)}-x_"
            r"\alpha^{(j}x_1^{k)}-x_A^{(j}x_1^{k)}"
            r"\boxed{+}2x_1^{j}x_1^{k}\right] \end{aligned}"
        ),
        grade="misprint",
        note=r"The last sign is wrong: the products of $\mathbf{x}_1$ with itself add.",
    ),
    Trial(
        name="text-multipliers-symmetric",
        tried="lamM[j,k] = lamM[k,j]",
        model=rotation_model,
        follows=r"the forces of the constraints on six particles, times $\mathbf{x}_N^j(0)$, summed",
        false=Falsehood(
            "With the magnetic force added the matrix is symmetric as well",
            "lamM[j,k] = lamM[k,j]",
            "lamM[j,k] + (T(R)*A*g)[j,k] = lamM[k,j] + (T(R)*A*g)[k,j]",
        ),
    ),
    Trial(
        name="text-electric-field",
        tried="other_field(ddx[N]) = ddx[N]",
        model=relative_model,
        follows="@(3) less @(4) for six particles, in two electric fields",
        false=Falsehood(
            "The electric field does not affect the rotation, whatever the charges of the particles",
            model=lambda: relative_model(equal=False),
        ),
    ),
    Trial(
        name="text-rotation-apart",
        tried="carried(ddx[N]) = ddx[N]",
        model=relative_model,
        follows="@(3) less @(4) for six particles, at two states that differ by a shift and a velocity",
        false=Falsehood(
            "The rotation does not depend on the flight, whatever the charges of the particles",
            model=lambda: relative_model(equal=False),
        ),
    ),
)
