"""Numbers typed with an uncertainty, 5000(200)e: what it does to each number that a command prints."""

import math
import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from atlas.cli.options import Typed
from atlas.errors import DomainError

STEP = 1 / 8
"""Part of a standard deviation over which a derivative is taken, by differences on both sides."""

BENT = 0.1
"""Part of an uncertainty up to which an input a standard deviation off may miss the straight line."""

NONE = 1e-12
"""Part of a number, or of the largest component of a vector or a matrix, that is rounding and no uncertainty."""

DRAWS, LEAST, SECONDS = 1000, 50, 3.0
"""Draws of the inputs, as many as these seconds of processor time allow, and at least some."""

Numbers = dict[tuple[Any, ...], float]
"""Numbers of an answer by their place in it."""


@dataclass(frozen=True)
class Spread:
    """An answer with the standard deviations of its numbers, and what is to be said of them."""

    found: dict[str, Any]
    sigma: Numbers
    notes: list[str]

    def texts(self) -> Any:
        """Return the answer with its numbers as texts, 12.57(3): in brackets the uncertainty of the last digits."""
        return mapped(self.found, lambda x, place: concise(x, self.sigma.get(place, 0.0)))

    def rates(self, names: list[str]) -> dict[str, str]:
        """Return rates among the numbers, by name, in turns a second."""
        known = {name: self.found[name] for name in names if isinstance(self.found.get(name), float)}
        turn = 2 * math.pi
        return {name: concise(x / turn, self.sigma.get((name,), 0.0) / turn) for name, x in known.items()}

    def record(self) -> dict[str, Any]:
        """Return the answer, and under sigma the same with the standard deviations in the place of its numbers."""
        return self.found | {"sigma": mapped(self.found, lambda _, place: self.sigma.get(place)), "notes": self.notes}


def uncertain(options: Mapping[str, Any]) -> list[tuple[str, int, Typed]]:
    """Return the numbers that have an uncertainty, each with the name of its option and its place in it."""
    values = ((name, _parts(value)) for name, value in options.items())
    return [(name, i, x) for name, several in values for i, x in enumerate(several) if getattr(x, "sigma", 0.0)]


def _parts(value: Any) -> tuple[Any, ...]:
    """Return the numbers that were typed for an option."""
    return getattr(value, "parts", value if isinstance(value, tuple) else (value,))


def spread(answer: Callable[[dict[str, Any]], dict[str, Any]], options: dict[str, Any]) -> Spread:
    """Return the answer to options with uncertainties, which are independent of one another.

    They are carried to first order, by derivatives. Where an input a standard deviation off is not on the straight line
    or has no answer, they are carried by sampling.
    """
    inputs = uncertain(options)
    answers = answer(options)
    middle = dict(_numbers(answers))
    sizes = _sizes(middle)
    lines, curved = [], set[tuple[Any, ...]]()
    for name in inputs:
        try:
            near, far = (
                [dict(_numbers(answer(_moved(options, {name: step_of_input})))) for step_of_input in (step, -step)]
                for step in (STEP, 1.0)
            )
        except DomainError:
            curved |= set(middle)
            continue
        slope = {key: (near[0][key] - near[1][key]) / (2 * STEP) for key in middle if _in_all(key, near)}
        lines.append(slope)
        curved |= {key for key in middle if key not in slope or not _in_all(key, far)}
        for key in slope.keys() - curved:
            off = max(abs(far[0][key] - middle[key] - slope[key]), abs(far[1][key] - middle[key] + slope[key]))
            if off > BENT * abs(slope[key]) + NONE * sizes[key]:
                curved.add(key)
    sigma = {key: math.hypot(*(line.get(key, 0.0) for line in lines)) for key in middle}
    notes = ["In brackets one standard deviation, in the last digits; of first order, by derivatives."]
    if curved:
        draws, failed = _draws(answer, options, inputs)
        sigma |= {key: _deviation([draw[key] for draw in draws if key in draw]) for key in curved}
        names = ", ".join(
            dict.fromkeys(str(key[2] if key[0] == "samples" else key[0]) for key in middle if key in curved)
        )
        lost = f", of which {failed} had no answer" if failed else ""
        notes.append(f"Of {names} by sampling, {len(draws) + failed} draws{lost}, since they are not of first order.")
    return Spread(answers, {key: x if x > NONE * sizes[key] else 0.0 for key, x in sigma.items()}, notes)


def _sizes(numbers: Numbers) -> Numbers:
    """Return for each number its size: of a matrix or a vector at a time that of its largest component."""
    largest = dict[tuple[Any, ...], float]()
    for key, x in numbers.items():
        group = key[:3] if key[0] == "samples" else key
        largest[group] = max(largest.get(group, 0.0), abs(x))
    return {key: largest[key[:3] if key[0] == "samples" else key] for key in numbers}


def _in_all(key: tuple[Any, ...], several: list[Numbers]) -> bool:
    return all(key in numbers for numbers in several)


def _moved(options: dict[str, Any], by: Mapping[tuple[str, int, Typed], float]) -> dict[str, Any]:
    """Return the options with numbers moved by parts of their standard deviations."""
    moved = dict(options)
    for (name, i, x), step in by.items():
        new, several = x.moved(x + step * x.sigma), _parts(before := moved[name])
        moved[name] = type(before)((*several[:i], new, *several[i + 1 :])) if isinstance(before, tuple) else new
    return moved


def _draws(
    answer: Callable[[dict[str, Any]], dict[str, Any]], options: dict[str, Any], inputs: list[tuple[str, int, Typed]]
) -> tuple[list[Numbers], int]:
    """Return the numbers of normal draws of the inputs, and how many draws had no answer."""
    import random

    normal, draws, failed, start = random.Random(1).gauss, list[Numbers](), 0, time.process_time()  # noqa: S311
    while len(draws) + failed < DRAWS and (len(draws) + failed < LEAST or time.process_time() - start < SECONDS):
        try:
            draws.append(dict(_numbers(answer(_moved(options, {name: normal(0.0, 1.0) for name in inputs})))))
        except DomainError:
            failed += 1
    return draws, failed


def _deviation(values: list[float]) -> float:
    """Return the standard deviation of draws."""
    if len(values) < LEAST // 2:
        return math.inf
    mean = math.fsum(values) / len(values)
    return math.sqrt(math.fsum((x - mean) ** 2 for x in values) / (len(values) - 1))


def _numbers(value: Any, place: tuple[Any, ...] = ()) -> Iterator[tuple[tuple[Any, ...], float]]:
    """Yield the finite numbers of an answer, each with its place; times are none of them."""
    if isinstance(value, float):
        if math.isfinite(value):
            yield place, float(value)
    elif isinstance(value, Mapping):
        for key, entry in value.items():
            if key != "t":
                yield from _numbers(entry, (*place, key))
    elif not isinstance(value, str) and hasattr(value, "__iter__"):
        for i, entry in enumerate(value):
            yield from _numbers(entry, (*place, i))


def mapped(value: Any, function: Callable[[float, tuple[Any, ...]], Any], place: tuple[Any, ...] = ()) -> Any:
    """Return an answer with a function of each number, and of its place, for it."""
    if isinstance(value, float):
        return function(float(value), place)
    if isinstance(value, Mapping):
        return {key: entry if key == "t" else mapped(entry, function, (*place, key)) for key, entry in value.items()}
    if not isinstance(value, str) and hasattr(value, "__iter__"):
        return [mapped(entry, function, (*place, i)) for i, entry in enumerate(value)]
    return value


def concise(value: float, sigma: float) -> str:
    """Write a number with its standard deviation in its last two digits, 12.57(31) or 1.257(31)e-06."""
    if not 0 < sigma < math.inf or not math.isfinite(value):
        return f"{value:.10g}" if sigma == 0 else f"{value:.10g}(?)"
    last = math.floor(math.log10(sigma)) - 1
    if round(sigma / 10.0**last) == 100:
        last += 1
    first = math.floor(math.log10(max(abs(value), sigma)))
    if last <= 0 and -4 <= first < 10:
        return f"{value:.{-last}f}({round(sigma / 10.0**last)})"
    return f"{value / 10.0**first:.{first - last}f}({round(sigma / 10.0**last)})e{first:+03d}"
