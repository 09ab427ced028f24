"""Subjects of the explorer: each family of the register and each recipe, with sliders for its numbers."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from atlas.arithmetic.lazy import cached_property
from atlas.errors import AtlasError, nearest
from atlas.families.sliders import Slider, letters, sliders_of, step_of
from atlas.motions.register import FAMILIES, Family
from atlas.pictures import recipes
from atlas.pictures.layers import Scene
from atlas.pictures.parameters import MEANINGS
from atlas.pictures.recipes import Recipe

FIGURE = "figure:"


@dataclass(frozen=True)
class OfFamily:
    """A family as a subject: sliders for its parameters; the picture is the moving body or the first figure."""

    family: Family

    @property
    def name(self) -> str:
        """Name of the family in the register."""
        return self.family.name

    @property
    def title(self) -> str:
        """Description of the family in words."""
        return self.family.says

    @property
    def moves(self) -> bool:
        """Return whether the family has a rotation matrix R(t), so that a body can be drawn at a time."""
        return any(sampled.name == "R" for sampled in self.family.sampled)

    @cached_property
    def sliders(self) -> list[Slider]:
        """Sliders of all parameters with a start value in the register; also of the time for families with R(t)."""
        return sliders_of(self.family)

    def arguments(self, values: Mapping[str, float]) -> dict[str, Any]:
        """Return the arguments of the family's class by name, vectors as tuples, from the sliders' `values` by name.

        A parameter without a slider has the value that stands for it when left out.
        """
        arguments: dict[str, Any] = {}
        for p in self.family.parameters:
            components = tuple(values[name] if p.default else p.omitted for name in p.names)
            arguments[p.name] = components if p.columns else components[0]
        return arguments

    def kernels(self, values: Mapping[str, float]) -> Any:
        """Return the motion or surface in doubles at the sliders' values by name; the last one is cached."""
        return _instance(self.family.kernels(), tuple(self.arguments(values).values()))

    def scene(self, values: Mapping[str, float]) -> Scene:
        """Return the `Scene`: the body at the time t with its trace for families with R(t), else the first figure.

        `values` are those of the sliders by name; the trace covers the last period before t, from 0 on.
        """
        arguments = self.arguments(values)
        if self.moves:
            from atlas.pictures import any_motion

            motion = self.kernels(values)
            return any_motion.scene_at(motion, t := values["t"], max(0.0, t - any_motion.period(motion)))
        recipe = recipes.load(self.family.figures[0])
        return recipe.scene(**{key: value for key, value in arguments.items() if key in recipe.parameters})

    def command(self, values: Mapping[str, float]) -> str:
        """Return the command line of the same numbers, as text; --times is added only if the family has R.

        `values` are those of the sliders by name.
        """
        arguments, words = self.arguments(values), ["atlas", *self.family.words]
        for p in self.family.parameters:
            value = arguments[p.name]
            if p.default and p.name != "c":
                words += [f"--{p.name}", *map(repr, value if isinstance(value, tuple) else (value,))]
        return " ".join([*words, *(["--times", repr(values["t"])] if self.moves else [])])


@dataclass(frozen=True)
class OfRecipe:
    """A recipe as a subject: sliders for its numerical parameters; the picture is its scene."""

    recipe: Recipe

    @property
    def name(self) -> str:
        """Name of the recipe."""
        return self.recipe.name

    @property
    def title(self) -> str:
        """The title of the figure."""
        return self.recipe.title

    @cached_property
    def sliders(self) -> list[Slider]:
        """Sliders of the recipe's parameters whose defaults are numbers or tuples of numbers, one for each component.

        Numbers of lines on a map have none.
        """
        return [slider for key, default in self.recipe.parameters.items() for slider in self._slider(key, default)]

    def _slider(self, key: str, default: Any) -> Iterator[Slider]:
        components = default if isinstance(default, tuple) else (default,)
        if (
            not components
            or not all(type(x) in {int, float} for x in components)
            or (components is default and key in CONTOURS)
        ):
            return
        names = [key] if not isinstance(default, tuple) else [f"{key}.{i}" for i in range(1, len(components) + 1)]
        size = 3.0 * max(1.0, *(abs(x) for x in components))
        start = -size if any(isinstance(x, float) for x in components) else 1.0  # of a number that has no range
        low, high = self.recipe.ranges.get(key) or KNOWN.get(key) or (start, size)
        low, high = min(low, *components), max(high, *components)
        for name, start in zip(names, components, strict=True):
            step = 1 if type(start) is int else step_of(low, high)
            yield Slider(name, MEANINGS.get(key, key), low, high, step, start, letters(name))

    def parameters(self, values: Mapping[str, float]) -> dict[str, Any]:
        """Return the parameters that have sliders, by name, from the sliders' values; integers stay integers."""
        parameters: dict[str, Any] = {}
        for key, default in self.recipe.parameters.items():
            defaults = default if isinstance(default, tuple) else (default,)
            names = [slider.name for slider in self._slider(key, default)]
            if names:
                components = tuple(type(x)(values[name]) for name, x in zip(names, defaults, strict=True))
                parameters[key] = components if isinstance(default, tuple) else components[0]
        return parameters

    def scene(self, values: Mapping[str, float]) -> Scene:
        """Return the `Scene` of the figure at the sliders' values by name."""
        return self.recipe.scene(**self.parameters(values))

    def command(self, values: Mapping[str, float]) -> str:
        """Return the command line "atlas figure ..." that draws the same figure, as text, from the sliders' values."""
        from atlas.pictures.parameters import typed_text

        settings = [f"{key}={typed_text(value)}" for key, value in self.parameters(values).items()]
        return " ".join(["atlas figure", self.name, *(["--set", *settings] if settings else [])])


KNOWN = {
    p.name: p.range for name in ("top", "particle", "general", "elementary") for p in FAMILIES[name].parameters
}  # the last ones are those that recipes mean
CONTOURS = frozenset({"C1", "C2", "levels", "rates", "cosines"})
"""Parameters whose numbers are those of lines on a map, which tell of no motion."""
Subject = OfFamily | OfRecipe


@lru_cache(maxsize=1)
def _instance(kernels: Any, arguments: tuple[Any, ...]) -> Any:
    return kernels(*arguments)


def subject(name: str) -> Subject:
    """Return the family or the recipe of a name, an `OfFamily` or `OfRecipe`.

    figure:NAME is the recipe where a family has the same name. A name is never a path. Raises AtlasError for an unknown
    name.
    """
    if name in FAMILIES:
        return OfFamily(FAMILIES[name])
    name, names = name.removeprefix(FIGURE), recipes.names()
    if name not in names:
        options = [*FAMILIES, *names]
        raise AtlasError(
            f"there is no family or figure {name!r}{nearest(name, options)}; families are {', '.join(FAMILIES)}, and "
            "`atlas list` names the figures."
        )
    return OfRecipe(recipes.load(name))


def subject_or_file(name: str) -> Subject:
    """Return the subject of a name, or of a user's recipe file NAME.py. Raises AtlasError if there is none."""
    return OfRecipe(recipes.load(name)) if name.endswith(".py") else subject(name)


def everything() -> dict[str, list[tuple[str, str]]]:
    """Return {"families": pairs, "figures": pairs} with pairs (name, title); "figure:" precedes a family's name."""
    return {
        "families": [(family.name, family.says) for family in FAMILIES.values()],
        "figures": [(FIGURE * (name in FAMILIES) + name, recipes.load(name).title) for name in recipes.names()],
    }
