"""Three ways to nutate.

Off the hyperbola (67) the axis R_3 nods while it goes round the field. If at a turning point it moves with the
precession, its trace waves; if it moves against it, the trace loops; if it stands still there, the trace has cusps.
"""

from typing import Any

from atlas.errors import DomainError
from atlas.maps.trace_map import trace_map
from atlas.motions.nutation.kernel_general import GeneralMotion
from atlas.pictures import Scene, axis_trace
from atlas.pictures.captions import listed, plain, plain_setting, tex, tex_setting

ROW = "its axis"
SEEN = "An axis released at rest draws cusps; pushed in one direction it draws waves, in the other loops."
SIZE = 58.0


def scene(
    *,
    ratio: Any = 1.5,
    field: tuple[float, float] = (1.0, 0.3),
    omega2: tuple[float, ...] = (-0.6, 0.0, 0.6),
    omega3: float = 5.0,
    nutations: float = 8.0,
    elevation: float = 25.0,
) -> Scene:
    """Draw R_3(t) from (0, omega2, omega3) for each ``omega2`` over ``nutations`` periods; B stands upright.

    ``ratio`` is I3/I2 or a body; ``field`` is (B2, B3) of B', in 1/time as the angular velocities; the elevation of
    the view is in degrees. Raises DomainError where B2 or B3 is 0.
    """
    if not all(field):
        raise DomainError(f"figure nutation_traces needs both components of the field, not field = {field}.")
    motions = [GeneralMotion(ratio, field, (0.0, start, omega3)) for start in omega2]
    panels = tuple(
        axis_trace.sphere(
            rf"({letter}) {shape(ratio, field, start, omega3)}, $\omega_2={tex(start)}$", field, motion.third_axis,
            nutations * motion.period,
            max(16, round(12 * nutations)), label=r"$\mathbf{B}$", elevation=elevation,
        )
        for letter, start, motion in zip("abcdef", omega2, motions, strict=False)
    )  # fmt: skip
    return Scene(
        caption=(
            r"At the start (dot) the third axis moves along the parallel with $\omega_2$."
            rf" {tex_setting(ratio, field, article='A')}, with "
            rf"$\omega_3={tex(omega3)}$, over {plain(nutations)} periods of the nutation, $\mathbf{{B}}$ upright."
        ),
        alt=(
            f"Unit spheres with the trace of the body's axis for {plain_setting(ratio, field)}, omega 3 = "
            f"{plain(omega3)} and omega 2 = {listed([plain(start) for start in omega2])}: a wave, a line with cusps "
            "and a line with loops between two parallels around the field."
        ),
        panels=panels,
        columns=len(panels),
        size=(SIZE * len(panels), SIZE + 10.0),
    )


def shape(ratio: Any, field: tuple[float, float], omega2: float, omega3: float) -> str:
    """Return "steady", "waves", "loops" or "cusps": the trace of an axis that starts at a turning point.

    `ratio` is I3/I2 or a body. The start is (0, omega2, omega3) in the field (B2, B3); omega2 = 0 gives "cusps".
    """
    return ("steady", "waves", "loops")[int(trace_map(ratio, field, (0.0, omega2, omega3)))] if omega2 else "cusps"
