"""The elementary motions with sliders: the pages show them as they move, in print there is only a sentence."""

import json
from dataclasses import asdict, dataclass, replace
from itertools import product
from math import atan2, degrees, hypot
from typing import Any, Literal

from atlas.families import FAMILIES
from atlas.families.sliders import TIME, Slider, sliders_of
from atlas.report.blocks.composer import Composer
from atlas.report.schema import StrictStruct

_OBLIQUE, _STEP = (1.0, 89.0), 0.01
"""The angle between field and e2 in degrees, for which (71) has a pole and both asymptotes, and its step."""
_BODIES, _PUSHES, _NODES, _PLACES = (0.5, 1.0, 1.5, 2.0), 6, 60, 4
"""General motions: of these I, from so many starts, so many moments of a period, and decimals: what is drawn."""


class Explorer(StrictStruct, frozen=True, tag_field="kind", tag="explorer"):
    """A sentence in Markdown with TeX, and below it the motion that the sliders choose.

    ``elementary`` motions have sliders for I, the angle of the field and omega2; ``general`` ones, of a few bodies in
    one field, for I and the omega1 that they start with.
    """

    text: str
    motion: Literal["elementary", "general"] = "elementary"


@dataclass(frozen=True)
class ExplorerView:
    """The number of its text, its sliders, and for the script the tables of motions and the field (B2, B3).

    The field is exact until a slider turns it.
    """

    text: int
    motion: str
    sliders: tuple[Slider, ...]
    field: tuple[float, float]
    tables: str = ""

    @property
    def described(self) -> str:
        """The sliders for the script."""
        return json.dumps([asdict(one) for one in self.sliders], ensure_ascii=False)


def view(block: Explorer, composer: Composer) -> ExplorerView:
    """Take in the text; the ranges and starts of the sliders are those of the register."""
    text, (B2, B3) = composer.paragraphs(block.text), _parameter("elementary", "field").default
    known = {one.name: one for one in sliders_of(FAMILIES[block.motion])}
    ratio, time = replace(known["ratio"], name="I", symbol="I"), TIME
    if block.motion == "general":
        high = known["omega1"].high
        step = high / (_PUSHES - 1)
        body = replace(ratio, low=_BODIES[0], high=_BODIES[-1], step=_BODIES[1] - _BODIES[0], start=1.5)
        push = replace(known["omega1"], low=0.0, step=step, start=2.0 * step, symbol="ω₁")
        return ExplorerView(text, block.motion, (body, push, time), (B2, B3), tables())
    turned = "angle of the field with e2, in degrees"
    angle = Slider("angle", turned, *_OBLIQUE, _STEP, round(degrees(atan2(B3, B2)), 2), "∠(e₂, B)")
    chosen = ratio, angle, replace(known["omega2"], symbol="ω₂"), time
    return ExplorerView(text, block.motion, chosen, (B2, B3))


def tables() -> str:
    """Return the general motions of the sliders: R(t) = R_B(a t) Q(t) R_z(b t) with Q of the period of nutation.

    Each is {period, a, b, says, command, columns}; `columns` are the first and the third column of Q at `_NODES`
    moments of a period.
    """
    import numpy as np

    from atlas import GeneralMotion

    field, (_, *rest) = _parameter("general", "field").default, _parameter("general", "omega").default
    pushes, found = np.linspace(0.0, _parameter("general", "omega").range[1], _PUSHES).tolist(), []
    for ratio, omega1 in product(_BODIES, pushes):
        command = f"atlas motion --ratio {ratio:g} --field {field[0]:g} {field[1]:g} --omega"
        motion = GeneralMotion(ratio, field, (omega1, *rest))
        a, b = motion.precession_per_period / motion.period, motion.spin_per_period / motion.period
        t = np.arange(_NODES) * (motion.period / _NODES)
        Q = _turns((0.0, *field), -a * t) @ motion.rotation(t) @ _turns((0.0, 0.0, 1.0), -b * t)
        low, high = motion.turning_points
        found.append(
            {
                "period": float(motion.period),
                "a": float(a),
                "b": float(b),
                "says": f"{motion.kind}; period {motion.period:.4f}, Ω₃ from {low:.4f} to {high:.4f}".replace("-", "−"),
                "command": f"{command} {omega1:g} {rest[0]:g} {rest[1]:g}",
                # no -0.0, whose sign is that of a rounding error
                "columns": (np.round(Q[:, :, [0, 2]].swapaxes(1, 2).reshape(_NODES, 6), _PLACES) + 0.0).tolist(),
            }
        )
    return json.dumps(found, separators=(",", ":"), ensure_ascii=False)


def _parameter(family: str, name: str) -> Any:
    """Return a parameter of the register."""
    return next(one for one in FAMILIES[family].parameters if one.name == name)


def _turns(axis: tuple[float, ...], angles: Any) -> Any:
    """Return the turns (N, 3, 3) about an axis."""
    import numpy as np

    n = np.array(axis) / hypot(*axis)
    cross = np.cross(np.eye(3), n)
    cos, sin = np.cos(angles)[:, None, None], np.sin(angles)[:, None, None]
    return cos * np.eye(3) + (1.0 - cos) * np.outer(n, n) + sin * cross
