"""A proposed measurement: the standard deviations of body, field and start that readings of the motion would have."""

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Literal

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.book.card import has_card, object_of
from atlas.book.digits import Number
from atlas.book.parts import ReportRequest, case_of
from atlas.book.tables.elementary import NONE
from atlas.book.tables.laboratory import deviations
from atlas.errors import AtlasError
from atlas.families.family import ROUNDING
from atlas.motions.any_body import motion as any_motion
from atlas.motions.register import FAMILIES

Reading = Literal["rotation", "axis", "angular_velocity"]

NUISANCES: dict[Reading, tuple[str, ...]] = {
    "rotation": ("a1", "a2", "a3"),
    "axis": ("a1", "a2"),
    "angular_velocity": (),
}
"""By the reading, inputs of the attitude at t = 0 that are found with the others."""
READINGS, TURNS, SIGMA = 100, 5, 0.01
"""Readings at equal times over so many turns, each with this error, in rad or as a part of the angular velocity."""
KINDS: dict[Reading, str] = {
    "rotation": "From attitudes",
    "axis": "From the third axis",
    "angular_velocity": "From rates in the body",
}
"""Readings, with the heads of their columns."""
NAMES = {
    "ratio": ("$I$", ""), "I1": ("$I_1/I_3$", ""), "I2": ("$I_2/I_3$", ""),
    **{f"B{i}": (f"$B'_{i}$", "1/time") for i in (1, 2, 3)},
    **{f"omega{i}": (rf"$\omega_{i}$", "1/time") for i in (1, 2, 3)},
}  # fmt: skip
"""Inputs that are found, with their letters and units."""
CAPTION = (
    "What to measure: standard deviations of body, field and start, all found from {} readings of one kind at equal "
    "times up to {:.4g} {}, from the Fisher matrix. Each component of a reading has an error of {} rad, of a rate "
    "{:.3g} {}. The attitude at t = 0 is found with them; a bar stands where the readings do not tell an input."
)


def measurement_of(
    request: ReportRequest, card: Mapping[str, Mapping[str, Any]], left_out: list[str]
) -> Iterator[dict[str, Any]]:
    """Yield the listing block of a proposed measurement; where there is none, add the reason to `left_out`.

    The listing has a row for each input of body, field and start: its letter, its standard deviations from 100 readings
    of attitudes, of the third axis and of rates in the body over 5 turns, and its unit. `card` is the card of the
    request. Nothing is yielded or added for an object without a card, a start or a turn.
    """
    rates = [2 * math.pi / abs(x) for key in ("f1", "f2", "f3") if (x := card[key]["value"])]
    turn = card["turn"]["value"] or card["nutation"]["value"] or max(rates, default=0.0)
    if request.family.takes("coupling"):
        left_out.append("What to measure: errors are foreseen of bodies in a field or free, not yet of tops.")
        return
    if not (turn and request.family.sampled and has_card(request.family)):
        return
    case, unit = case_of(request), "s" if request.time in {"s", "1/s"} else request.time
    field = np.array((0.0, *(case.components if request.body else request.values.get("field", (0.0, 0.0))))[-3:])
    omega = request.family.kernels()(*object_of(request).floats).angular_velocity(0.0)
    body = case.body if request.body else np.array(request.values["inertia"]) / request.values["inertia"][-1]
    t, rate = (
        np.linspace(0.0, TURNS * turn, READINGS + 1)[1:],
        SIGMA * max(float(np.linalg.norm(omega)), 2 * math.pi / turn),
    )
    try:
        motion = any_motion(body, field, omega)
        is_symmetric = request.body or FAMILIES[motion.family].takes("ratio")
        names = [*(["ratio"] if is_symmetric else ["I1", "I2"]), *(["B1", "B2", "B3"] if field.any() else []),
                 "omega1", "omega2", "omega3"]  # fmt: skip
        columns = [expected_errors(motion, names, t, kind, SIGMA if kind != "angular_velocity" else rate)
                   for kind in KINDS]  # fmt: skip
        error = float(motion.input_error(t[-1]))
    except AtlasError as reason:
        left_out.append(f"What to measure: {reason}")
        return
    rows = [
        [NAMES[name][0], *(Number(f"{x:.2g}").words() if np.isfinite(x) else NONE for x in errors),
         NAMES[name][1].replace("time", unit)]
        for name, errors in zip(names, np.transpose(columns), strict=True)
    ]  # fmt: skip
    caption = CAPTION.format(READINGS, t[-1], unit.replace("time", "units of time"), SIGMA, rate, f"1/{unit}")
    if error > ROUNDING:
        caption += f" Rounding the inputs to floats turns the body by up to {error:.1g} rad in that time."
    yield {"kind": "listing", "id": "measurement", "columns": ["Input", *KINDS.values(), "Unit"], "rows": rows,
           "caption": caption}  # fmt: skip


def expected_errors(motion: Any, names: Sequence[str], t: FloatArray, reading: Reading, sigma: float) -> FloatArray:
    """Return the standard deviations of inputs that a fit to readings of a motion would have.

    Parameters
    ----------
    motion : Motion
        Motion of `atlas.motion`, whose inputs have derivatives.
    names : sequence of str
        Inputs, as in `Motion.sensitivity`.
    t : ndarray, shape (n,)
        Times of the readings.
    reading : str
        "rotation", the attitude; "axis", the direction of the third axis; or "angular_velocity", along the body's axes.
    sigma : float
        Standard deviation of each component of a reading, in rad or in rad/time.

    Returns
    -------
    ndarray, shape (len(names),)
        Standard deviations, each in the unit of its input; inf for an input that the readings do not determine.

    Notes
    -----
    The Fisher matrix is J^T J / sigma^2 with the derivatives J of the readings. Rotations of R(0) are fitted along with
    the inputs: "a1" to "a3" for "rotation", "a1" and "a2" for "axis", none for "angular_velocity".
    """
    v = motion.sensitivity(t, [*names, *NUISANCES[reading]], "rotation" if reading == "axis" else reading)
    if reading == "axis":
        v = np.cross(v, motion.column(3, t)[:, None])
    J = np.moveaxis(v, 1, -1).reshape(3 * t.size, -1) / sigma
    return deviations(J)[: len(names)]
