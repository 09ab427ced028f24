"""What a scene cost: which quantities its recipe asked for, how many points and faces it holds.

The quantities are counted at the doors of the public classes of `atlas.core`; nothing is counted outside a build.
"""

import inspect
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cached_property, wraps
from importlib import import_module
from typing import Any

from atlas.scene import Curve, Image, Points, Region, Scene, Surface

DOORS = {
    "quadric": "Quadric",
    "hyperbola": "Hyperbola",
    "elementary": "ElementaryMotion",
    "ball": "BallMotion",
    "particle": "ParticleMotion",
    "flight": "Flight",
}


@contextmanager
def counting() -> Iterator[Counter[str]]:
    """Count every public quantity that is asked for while the context lasts, as ``Class.quantity``."""
    counts: Counter[str] = Counter()
    owners = [getattr(import_module(f"atlas.core.{module}"), name) for module, name in DOORS.items()]
    watch = _Watch(counts)
    replaced: list[tuple[type, str, Any]] = []
    for cls in {base: None for owner in owners for base in owner.__mro__[:-1]}:
        for key, member in list(vars(cls).items()):
            counted = None if key.startswith("_") else _counted(member, key, watch)
            if counted is not None:
                replaced.append((cls, key, member))
                setattr(cls, key, counted)
    try:
        yield counts
    finally:
        for cls, key, member in reversed(replaced):
            setattr(cls, key, member)


class _Watch:
    """Counts calls from outside; a quantity that another one is made from was not asked for by the recipe."""

    def __init__(self, counts: Counter[str]) -> None:
        self.counts = counts
        self.depth = 0

    def __call__(self, function: Any, key: str) -> Any:
        """Return the function with a counter at its door."""

        @wraps(function)
        def call(owner: Any, *args: Any, **kwargs: Any) -> Any:
            if not self.depth:
                self.counts[f"{type(owner).__name__}.{key}"] += 1
            self.depth += 1
            try:
                return function(owner, *args, **kwargs)
            finally:
                self.depth -= 1

        return call


def _counted(member: Any, key: str, watch: _Watch) -> Any:
    """Return the member with a counter, or None when it is not a quantity."""
    if inspect.isfunction(member):
        return watch(member, key)
    if isinstance(member, property) and member.fget is not None:
        return property(watch(member.fget, key), doc=member.__doc__)
    if isinstance(member, cached_property):
        again = cached_property(watch(member.func, key))
        again.__set_name__(type(member), key)
        return again
    return None


def points(scene: Scene) -> int:
    """Return how many points of curves, regions and marks a scene holds."""
    count = 0
    for panel in scene.panels:
        for layer in panel.layers:
            if isinstance(layer, Curve | Points | Region):
                count += len(layer.points)
            elif isinstance(layer, Surface):
                count += sum(len(line) for line in (*layer.wires, *layer.rims))
    return count


def faces(scene: Scene) -> int:
    """Return how many faces of surfaces and cells of maps a scene holds."""
    count = 0
    for panel in scene.panels:
        for layer in panel.layers:
            if isinstance(layer, Surface):
                count += sum((grid.shape[0] - 1) * (grid.shape[1] - 1) for grid in layer.grids)
            elif isinstance(layer, Image):
                count += int(layer.values.size)
    return count
