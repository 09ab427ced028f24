"""Sliders for the numbers of a family: names, ends and starts are those of the register, for pages and the explorer."""

import re
from dataclasses import dataclass
from math import log10

from atlas.families.family import Family

SLIDER_STEPS = 300
"""About so many has a slider from end to end, each a power of ten."""


@dataclass(frozen=True)
class Slider:
    """A slider: its name, meaning, ends `low` and `high`, step and start, in the unit of its parameter.

    `symbol` stands beside it, or "" where the name does.
    """

    name: str
    says: str
    low: float
    high: float
    step: float
    start: float
    symbol: str = ""


TIME = Slider("t", "time", 0.0, 60.0, 0.05, 0.0)


def sliders_of(family: Family) -> list[Slider]:
    """Return a list of the sliders of all parameters with a default, one a component, and of the time.

    The time has one only if the family has R.
    """
    sliders = [
        Slider(name, p.says, *p.range, step_of(*p.range), start, letters(name))
        for p in family.parameters
        for name, start in zip(p.names, p.default, strict=bool(p.default))
    ]
    return [*sliders, *([TIME] if any(sampled.name == "R" for sampled in family.sampled) else [])]


def step_of(low: float, high: float) -> float:
    """Return the step of a slider from `low` to `high`: a power of ten near a `SLIDER_STEPS`-th of the range."""
    return float(10.0 ** round(log10((high - low) / SLIDER_STEPS)))


def letters(name: str) -> str:
    """Return a parameter's name as a symbol, omega2 as ω₂, ratio as I, field.1 as B₂; other words unchanged."""
    name = {"ratio": "I", "field.1": "B2", "field.2": "B3"}.get(name, name)
    stem, _, index = re.sub(r"(?<=\D)\.?(\d*)$", r" \1", name).partition(" ")
    greek = {"omega": "ω", "Omega": "Ω", "phi": "ϕ", "mu": "μ", "nu": "ν", "beta": "β", "gamma": "γ"}
    if stem not in greek and len(stem) != 1:
        return name
    return greek.get(stem, stem) + index.translate({ord("0") + i: 0x2080 + i for i in range(10)})
