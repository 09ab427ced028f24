"""From symmetric to flat.

One launch of bodies whose first moment goes from that of a symmetric body, I1 = I2, to that of a flat one,
I1 = I3 - I2. While the body is symmetric each loop that the axis R_3 draws is as the one before it, from one parallel
about the field to the other; then a second period comes in, and no two loops are the same.
"""

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.checking.simulate import simulate
from atlas.errors import DomainError
from atlas.pictures import Scene, axis_trace
from atlas.pictures.captions import listed, plain, plain_vector, tex, tex_vector

ROW = "three moments"
SEEN = "With three different moments no two loops are alike."
SIZE, COLUMNS = 56.0, 3
STEPS = 40
"""Points of a trace for each radian of the fastest of the rates at the start."""
MAX_TURNS = 40
"""Turns, of the rates across the axis and of the field together, that one sphere can show."""
RANGES = {"stop": (0.1, 200.0)}


def scene(
    *,
    first: tuple[float, ...] = (1.0, 0.95, 0.85, 0.75, 0.62, 0.5),
    ratio: float = 1.5,
    field: tuple[float, float] = (1.0, 0.5),
    omega: tuple[float, float, float] = (0.0, 0.9, 3.0),
    stop: float = 13.0,
    elevation: float = 40.0,
    unit: str = "time",
) -> Scene:
    """Draw R_3(t) of the bodies (``first``, 1, ``ratio``) up to the time ``stop``; B stands upright.

    ``first`` are one to six values of I1, ``ratio`` is I3; ``field`` is (B2, B3) of B', ``omega`` the angular
    velocity at t = 0, in 1/time; the elevation of the view is in degrees, ``unit`` the word for the unit of time.
    Raises DomainError without a field and for more than 40 turns.
    """
    if not 0 < len(first) <= 6 or not any(field):
        raise DomainError(f"figure flattening takes one to six values of I1 and a field, not {first} and {field}.")
    longest = 2 * np.pi * MAX_TURNS / float(np.abs([*field, *omega[:2]]).sum())
    if stop > longest:
        raise DomainError(
            f"figure flattening: beyond {MAX_TURNS} turns of the axis nothing can be told apart: give a stop up to "
            f"{longest:.3g}, not {stop:g}."
        )
    panels = tuple(
        axis_trace.traced_sphere(
            f"({letter}) $I_1={tex(I1)}$",
            axis_trace.erected(trace((I1, 1.0, ratio), field, omega, stop), field),
            elevation=elevation,
        )
        for letter, I1 in zip("abcdef", first, strict=False)
    )
    columns = min(COLUMNS, len(panels))
    return Scene(
        caption=(
            rf"The third axis of bodies with $I_2=1$, $I_3={tex(ratio)}$ and the $I_1$ in the titles, launched "
            rf"with $\boldsymbol{{\omega}}={tex_vector(omega)}$ in "
            rf"$\mathbf{{B}}'={tex_vector((0.0, *field))}$ (1/{unit}), $\mathbf{{B}}$ upright, up to $t={tex(stop)}$. "
            rf"Dashed: the parallels that bound the trace.{special(first, ratio)}"
        ),
        alt=(
            f"Unit spheres with the trace of an axis for I1 = {listed([plain(I1) for I1 in first])}, all launched with "
            f"{plain_vector(omega)}: a row of even loops between two parallels that becomes uneven."
        ),
        panels=panels,
        columns=columns,
        named={"Dashed": "reference"},
        size=(SIZE * columns, (SIZE + 6.0) * -(-len(panels) // columns)),
    )


def special(I1_values: tuple[float, ...], ratio: float) -> str:
    """Return sentences on the panels in which the body (I1, 1, ``ratio``) is symmetric or flat, "" without any.

    `I1_values` are those of panels (a), (b), ... in order.
    """
    letters = {I1: f"({letter})" for letter, I1 in zip("abcdef", I1_values, strict=False)}
    symmetric = f" In {letters[1.0]} the body is symmetric, and every loop touches both." if 1.0 in letters else ""
    flat = f" In {letters[ratio - 1.0]} it is flat." if ratio - 1.0 in letters else ""
    return symmetric + flat


def trace(inertia: tuple[float, ...], field: tuple[float, float], omega: tuple[float, ...], stop: float) -> FloatArray:
    """Return R_3 (N, 3), the third axis, at N equal steps of time up to `stop`, by SciPy's integrator.

    `inertia` are the moments (3,), `field` is (B2, B3), `omega` the angular velocity (3,) at t = 0.
    """
    fastest = float(np.abs([*field, *omega]).sum())
    return simulate(inertia, field, omega, np.linspace(0.0, stop, int(STEPS * fastest * stop) + 2)).R[..., 2]
