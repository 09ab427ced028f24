"""The charged particle by every road there is.

The question: how long do y(t) and v(t), (98), take, and how large are their errors?

E is orthogonal to B, so that the particle drifts but is not accelerated without end, and nothing hides the turning.
The error of the position is compared to its distance from the origin (at least one radius of the turning), that of
the velocity to the speed.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from atlas.motions.particle.certified import ParticleMotion as Exact
from atlas.motions.particle.kernel import ParticleMotion
from benchmarks.case import Case, FloatArray, Method, Parameters, Solve, cross

PARAMETERS: Parameters = {
    "mu": 1.0,
    "E": (1.0, 1.0, -1.0),
    "B": (0.5, 1.5, 2.0),
    "position": (1.0, -0.5, 0.25),
    "velocity": (0.3, 1.1, -0.4),
}


def rates(state: Sequence[Any], p: Parameters) -> list[Any]:
    """Rates of y and v: the Lorentz force, (89), with c = 1."""
    force = cross(state[3:6], p["B"])
    return [*state[3:6], *(p["mu"] * (p["E"][i] + force[i]) for i in range(3))]


def constants() -> tuple[FloatArray, FloatArray, FloatArray, FloatArray, float]:
    """Return the start, the steady velocity, the turning velocity u, [u, b] for the direction b of B, and omega."""
    E, B, start, launch = (np.array(PARAMETERS[name]) for name in ("E", "B", "position", "velocity"))
    strength = float(np.linalg.norm(B))
    b = B / strength
    steady = np.cross(E, B) / strength**2 + (launch @ b) * b
    return start, steady, launch - steady, np.cross(launch - steady, b), float(PARAMETERS["mu"]) * strength


def plain() -> Solve:
    """Evaluate the trochoid, (98), in NumPy as anyone would write it."""
    start, steady, u, radial, omega = constants()

    def solve(times: FloatArray) -> FloatArray:
        t = times[:, None]
        c, s = np.cos(omega * t), np.sin(omega * t)
        position = start + steady * t + (u * s + radial * (1 - c)) / omega
        return np.concatenate([position, steady + u * c + radial * s], axis=1)

    return solve


def lambdified() -> Solve:
    """Compile the same from SymPy, with common subexpressions taken out."""
    import sympy

    start, steady, u, radial, omega = constants()
    t = sympy.symbols("t", real=True)
    c, s = sympy.cos(omega * t), sympy.sin(omega * t)
    y = [start[i] + steady[i] * t + (u[i] * s + radial[i] * (1 - c)) / omega for i in range(3)]
    entries = sympy.lambdify(t, y + [sympy.diff(x, t) for x in y], "numpy", cse=True)
    return lambda times: np.stack(np.broadcast_arrays(*entries(times)), axis=-1)


def rotations() -> Solve:
    """Turn u and [u, b] by SciPy's rotations about B."""
    from scipy.spatial.transform import Rotation

    start, steady, u, radial, omega = constants()
    axis = -omega * np.array(PARAMETERS["B"]) / np.linalg.norm(PARAMETERS["B"])

    def solve(times: FloatArray) -> FloatArray:
        t = times[:, None]
        turn = Rotation.from_rotvec(t * axis)
        position = start + steady * t + (radial - turn.apply(radial)) / omega
        return np.concatenate([position, steady + turn.apply(u)], axis=1)

    return solve


def ours() -> Solve:
    """Evaluate `ParticleMotion.position` and `.velocity`."""
    motion = ParticleMotion(*PARAMETERS.values())
    return lambda times: np.concatenate([motion.position(times), motion.velocity(times)], axis=1)


def scale(values: FloatArray) -> FloatArray:
    """Return the sizes to which errors are compared, (N, 6)."""
    _, _, u, _, omega = constants()
    distance = np.maximum(np.linalg.norm(values[:, :3], axis=1), np.linalg.norm(u) / omega)
    return np.repeat(np.stack([distance, np.linalg.norm(values[:, 3:], axis=1)], axis=1), 3, axis=1)


def case() -> Case:
    """Return the case; its true values are balls."""
    exact = Exact(*PARAMETERS.values())
    return Case(
        name="particle",
        parameters=PARAMETERS,
        shape=(6,),
        rates=rates,
        initial=lambda: [*PARAMETERS["position"], *PARAMETERS["velocity"]],
        exact=lambda t: [*exact.position(t), *exact.velocity(t)],
        scale=scale,
        closed=(
            Method("plain", plain),
            Method("lambdify", lambdified, ("sympy",)),
            Method("rotation", rotations, ("scipy.spatial.transform",)),
            Method("ours", ours),
        ),
    )
