"""Motions with sliders: the pages show them as they move; print leaves them out."""

import json
from dataclasses import asdict, dataclass, replace
from math import atan2, degrees
from typing import Any, Literal
from urllib.parse import urlencode

import msgspec

from atlas.book.blocks.composer import Composer
from atlas.book.schema import StrictStruct, TwoNumbers
from atlas.errors import AtlasError, unknown
from atlas.families.sliders import TIME, Slider
from atlas.families.sliders import sliders_of as sliders_of_family
from atlas.motions.register import FAMILIES

_OBLIQUE, _STEP = (1.0, 89.0), 0.01
"""The angle between field and e2 in degrees, for which (71) has a pole and both asymptotes, and its step."""
_PLANE = (-3.0, 3.0), (-5.0, 5.0)
"""Ranges of omega2 and omega3 in the plane, also in the script."""
IN_SPACE = ("space", "body")

Panel = Literal["plane", "space", "body", "frequencies", "portrait", "rosette"]


class Step(StrictStruct, frozen=True):
    """One step of a page that scrolls past a scene: title and text in Markdown, and the motion shown beside them.

    ``motion`` has values of sliders by name; where omega3 is left out, the start lies on the hyperbola (67).
    ``panel`` is the panel in space that is shown during this step.
    """

    title: str
    text: str
    motion: dict[str, float]
    panel: Literal["space", "body"] = "body"


class Explorer(StrictStruct, frozen=True, tag_field="kind", tag="explorer"):
    """A sentence in Markdown with TeX, and below it the motion that the sliders choose.

    ``panels`` are the pictures: the ``plane`` of omega2 and omega3 with the hyperbola, the ``space`` with the
    quadric, the ``body``; the ``frequencies`` over omega2, the phase ``portrait``, the ``rosette`` of a point, 40
    degrees from the axis, as seen along the field. With ``steps`` the page scrolls past one scene, where of the
    panels in space only the step's is seen; ``still`` is the id of the figure that stands there without script.
    ``sliders`` are among I, angle (of the field with e2, in degrees), omega1, omega2, omega3 (in units of 1/time), and
    p and q: turns of the body about its axis, and of the axis about the field, after which a motion closes. A parameter
    without a slider keeps the register's start, and omega3 is that of the hyperbola. ``start`` sets the starts of
    some sliders by name, ``at`` the field (B2, B3); None is the register's.
    """

    text: str
    panels: tuple[Panel, ...] = ("plane", "body")
    sliders: tuple[str, ...] = ("I", "angle", "omega2", "omega3")
    start: dict[str, float] = msgspec.field(default_factory=dict)
    at: TwoNumbers | None = None
    steps: tuple[Step, ...] = ()
    still: str | None = None


@dataclass(frozen=True)
class ExplorerView:
    """View of an explorer: index of its text among the texts, names of its panels, sliders, and the field (B2, B3).

    ``steps`` holds (index of the title, index of the text, motion as a query of a URL, panel in space). The field
    is exact until a slider turns it; ``free`` says that the sliders allow a start off the hyperbola; ``still`` is
    the id of a figure or None.
    """

    text: int
    panels: tuple[str, ...]
    sliders: tuple[Slider, ...]
    field: tuple[float, float]
    free: bool
    steps: tuple[tuple[int, int, str, str], ...] = ()
    still: str | None = None

    @property
    def described(self) -> str:
        """JSON text for the script: a list of the sliders, an object of the fields of `Slider` for each."""
        return json.dumps([asdict(slider) for slider in self.sliders], ensure_ascii=False)

    @property
    def in_space(self) -> bool:
        """Whether a panel, "space" or "body", is drawn in space."""
        return any(name in IN_SPACE for name in self.panels)


def view(block: Explorer, composer: Composer) -> ExplorerView:
    """Return the `ExplorerView`; sliders have the register's ranges and starts where the block sets none.

    A slider of time is added unless the only panel is "frequencies". Raises AtlasError for an unknown slider, and for a
    start of a slider that the block does not show.
    """
    B2, B3 = (
        block.at
        or next(parameter for parameter in FAMILIES["elementary"].parameters if parameter.name == "field").default
    )
    defaults = sliders_of(B2, B3)
    for name in (*block.sliders, *block.start, *(name for step in block.steps for name in step.motion)):
        if name not in defaults:
            raise unknown("slider", name, defaults)
    if any(name not in block.sliders for name in block.start):
        raise AtlasError(f"start: only what has a slider may be set, one of {', '.join(block.sliders)}.")
    chosen = [replace(defaults[name], start=block.start.get(name, defaults[name].start)) for name in block.sliders]
    moving = [] if block.panels == ("frequencies",) else [TIME]
    text, is_free = composer.paragraphs(block.text), "omega3" in block.start
    steps = tuple(
        (composer.text(step.title, inline=True), composer.paragraphs(step.text), urlencode(step.motion), step.panel)
        for step in block.steps
    )
    return ExplorerView(text, block.panels, (*chosen, *moving), (B2, B3), is_free, steps, block.still)


def sliders_of(B2: float, B3: float) -> dict[str, Slider]:
    """Return by name every `Slider` that an explorer can have, for a field with the components B2 and B3.

    The slider of the angle starts at atan2(B3, B2), in degrees.
    """
    defaults = {
        slider.name: slider for name in ("general", "elementary") for slider in sliders_of_family(FAMILIES[name])
    }
    (low2, high2), (low3, high3) = _PLANE
    bound = "angle of the field with e2, in degrees"
    sliders: list[Any] = [
        replace(defaults["ratio"], name="I", symbol="I"),
        Slider("angle", bound, *_OBLIQUE, _STEP, round(degrees(atan2(B3, B2)), 2), "∠(e₂, B)"),
        replace(defaults["omega1"], symbol="ω₁", start=0.0),
        replace(defaults["omega2"], symbol="ω₂", low=low2, high=high2),
        replace(defaults["omega3"], symbol="ω₃", low=low3, high=high3, step=_STEP, start=0.0),
        Slider("p", "turns of the body about its axis", -7.0, 7.0, 1.0, 1.0),
        Slider("q", "turns of the axis about the field", 1.0, 9.0, 1.0, 2.0),
    ]
    return {slider.name: slider for slider in sliders}
