"""The elementary motions with sliders: the pages show them as they move, in print there is only a sentence."""

from dataclasses import dataclass
from math import atan2, degrees, hypot

from atlas.families import FAMILIES
from atlas.report.blocks.composer import Composer
from atlas.report.schema import StrictStruct

_STEP, _OBLIQUE = 0.01, (1.0, 89.0)
"""Of all sliders; and the angle between field and e2 in degrees, for which (71) has a pole and both asymptotes."""


class Explorer(StrictStruct, frozen=True, tag_field="kind", tag="explorer"):
    """A sentence in Markdown with TeX, and below it the motion that the sliders choose."""

    text: str


@dataclass(frozen=True)
class Slider:
    """A number that is chosen: its name in the address, its symbol, what it is, its ends, and where it starts."""

    name: str
    symbol: str
    says: str
    low: float
    high: float
    start: float
    step: float = _STEP


@dataclass(frozen=True)
class ExplorerView:
    """The number of its text, its sliders, and the size of the field B'."""

    text: int
    sliders: tuple[Slider, ...]
    field: float


def view(block: Explorer, composer: Composer) -> ExplorerView:
    """Take in the text; the ranges and starts of the sliders are those of the register."""
    known = {one.name: one for one in FAMILIES["elementary"].parameters}
    ratio, omega2, (B2, B3) = known["ratio"], known["omega2"], known["field"].default
    angle = round(degrees(atan2(B3, B2)), 2)
    return ExplorerView(
        composer.paragraphs(block.text),
        (
            Slider("I", "I", "ratio of the moments of inertia, I3/I2", *ratio.range, *ratio.default),
            Slider("angle", "∠(e₂, B)", "angle of the field with e2, in degrees", *_OBLIQUE, angle),
            Slider("omega2", "ω₂", "second component of the initial angular velocity", *omega2.range, *omega2.default),
        ),
        hypot(B2, B3),
    )
