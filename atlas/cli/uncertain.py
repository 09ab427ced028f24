"""Numbers typed with an uncertainty, 5000(200)e, and the deviation of each number that a command prints."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from time import process_time
from typing import Any, NamedTuple

from atlas.cli.present import bar
from atlas.cli.typed import Typed, parts_of
from atlas.errors import DomainError

STEP = 1 / 8
"""Part of a standard deviation over which a derivative is taken, by differences on both sides."""

BENT = 0.03
"""Part of the uncertainty of a number by which second and third derivatives may change it; beyond, it is sampled."""

LOST = 0.05
"""Part of the draws that may lie where a number is not there: the scatter of the others is still right to a tenth."""

NONE = 1e-12
"""Part of a number, or of the largest component of a vector or a matrix, that is rounding and no uncertainty."""

DRAWS, NUMBERS, LEAST = 500, 2_000_000, 25
"""Draws of the inputs; numbers in all of them, which fewer draws do not exceed; and draws that a deviation needs."""

SLOW = 0.05
"""Seconds that an answer takes from which on there are but 4 LEAST draws, whose deviation is right to 7 %."""

BY_SAMPLING = "by sampling, {}, since they are not of first order."
BY_NEITHER = "no deviation: they are not of first order, and by sampling there are {}."

Numbers = dict[tuple[Any, ...], float]
"""Numbers of an answer by their place in it."""


@dataclass(frozen=True)
class Spread:
    """An answer with the standard deviations of its numbers, the errors of sampled ones, and notes on the method."""

    found: dict[str, Any]
    sigma: Numbers
    error: Numbers
    notes: list[str]

    def texts(self) -> Any:
        """Return the answer with its numbers as texts, 12.57(3): in brackets the uncertainty of the last digits."""
        return mapped(self.found, lambda x, place: concise(x, self.sigma.get(place, 0.0), self.error.get(place, 0.0)))

    def rates(self, names: list[str]) -> dict[str, str]:
        """Return rates among the numbers, by name, in turns a second."""
        numbers = {
            name: (self.found[name], self.sigma.get((name,), 0.0), self.error.get((name,), 0.0))
            for name in names
            if isinstance(self.found.get(name), float)
        }
        return {name: concise(*(x / (2 * math.pi) for x in three)) for name, three in numbers.items()}

    def record(self) -> dict[str, Any]:
        """Return the answer, and under sigma the same with the standard deviations in the place of its numbers."""
        deviations = {place: x for place, x in self.sigma.items() if x < math.inf}
        return self.found | {"sigma": mapped(self.found, lambda _, place: deviations.get(place)), "notes": self.notes}


def uncertain(options: Mapping[str, Any]) -> list[tuple[str, int, Typed]]:
    """Return the numbers that have an uncertainty, each with the name of its option and its place in it."""
    values = ((name, _parts(value)) for name, value in options.items())
    return [(name, i, x) for name, numbers in values for i, x in enumerate(numbers) if getattr(x, "sigma", 0.0)]


def _parts(value: Any) -> tuple[Any, ...]:
    """Return the numbers that were typed for an option."""
    return getattr(value, "parts", parts_of(value))


def spread(answer: Callable[[dict[str, Any]], dict[str, Any]], options: dict[str, Any]) -> Spread:
    """Return the answer to options with uncertainties, which are independent of one another.

    They are carried to first order, by derivatives, on one side where a number is there only on that a standard
    deviation off; and by sampling to a number whose deviation terms of second and third order would change, or that is
    not there on either side of one input, or of all together. Where draws are lost by that it has none.
    """
    inputs = uncertain(options)
    answers = answer(options)
    middle = _numbers(answers)
    sizes = _sizes(middle)
    ways: list[Mapping[tuple[str, int, Typed], float]] = [{name: 1.0} for name in inputs]
    together = [dict.fromkeys(inputs, len(inputs) ** -0.5)] if len(inputs) > 1 else []
    began = process_time()
    terms = [_terms(answer, options, way, middle) for way in [*ways, *together]]
    seconds = (process_time() - began) / (4 * len(terms))
    lines, higher_terms = (
        [x.line for x in terms[: len(ways)]],
        [x.second for x in terms] + [x.third for x in terms[: len(ways)]],
    )
    sigma, bent = (
        {key: math.hypot(*(part.get(key, 0.0) for part in several)) for key in middle}
        for several in (lines, higher_terms)
    )
    curved = {key for key in middle if abs(bent[key] - sigma[key]) > BENT * sigma[key] + NONE * sizes[key]}
    curved |= {key for key in middle if not all(key in x.line for x in terms)}
    ended = {key for x in terms for key in x.ended if sigma[key] > NONE * sizes[key]} - curved
    says = {"by derivatives on one side: on the other they have no value a standard deviation off.": ended}
    error = Numbers()
    if curved:
        count = 4 * LEAST if seconds > SLOW else min(DRAWS, max(NUMBERS // len(middle), 4 * LEAST))
        draws = _draws(answer, options, inputs, curved, count)
        lost = {key for key, values in draws.items() if len(values) < count - LOST * count}
        for key, values in draws.items():
            sigma[key], error[key] = (math.inf, math.inf) if key in lost else _deviation(values)
        for keys, text in ((curved - lost, BY_SAMPLING), (lost, BY_NEITHER)):
            most = count - min((len(draws[key]) for key in keys), default=count)
            says[text.format(f"{count} draws" + f", {most} of them without a value" * bool(most))] = keys
    notes = ["In brackets one standard deviation, in the last digits; of first order, by derivatives."]
    for text, keys in says.items():
        names = dict.fromkeys(str(key[2] if key[0] == "samples" else key[0]) for key in middle if key in keys)
        notes += [f"Of {', '.join(names)} {text}"] * bool(names)
    return Spread(answers, {key: x if x > NONE * sizes[key] else 0.0 for key, x in sigma.items()}, error, notes)


class Terms(NamedTuple):
    """How numbers change along one way, and which are there only on one side of it.

    `line` is the term of first order, `second` that of second, `third` the sum of those of first and third order.
    """

    line: Numbers
    second: Numbers
    third: Numbers
    ended: set[tuple[Any, ...]]


def _terms(
    answer: Callable[[dict[str, Any]], dict[str, Any]],
    options: dict[str, Any],
    way: Mapping[tuple[str, int, Typed], float],
    middle: Numbers,
) -> Terms:
    """Return the terms of numbers along one way, a standard deviation long, of those that are there on a side of it."""

    def off(step: float) -> Numbers:
        try:
            return _numbers(answer(_moved(options, {name: step * x for name, x in way.items()})))
        except DomainError:
            return {}

    terms, sides = Terms({}, {}, {}, set()), [[off(sign * step) for step in (STEP, 1.0)] for sign in (1.0, -1.0)]
    for key, x in middle.items():
        differences = [
            [numbers[key] - x for numbers in side] for side in sides if all(key in numbers for numbers in side)
        ]
        if len(differences) == 2:
            (near_difference, after), (far, before) = differences
            terms.line[key], terms.second[key] = (near_difference - far) / (2 * STEP), (after + before) / 2**0.5
            terms.third[key] = 1.5 * (after - before) - 2 * terms.line[key]
        elif differences:  # of the parabola through three points; the sign does not matter
            terms.ended.add(key)
            ((near_difference, after),) = differences
            terms.line[key] = terms.third[key] = (near_difference - STEP**2 * after) / (STEP - STEP**2)
            terms.second[key] = (after - terms.line[key]) * 2**0.5
    return terms


def _sizes(numbers: Numbers) -> Numbers:
    """Return for each number its size: of a matrix or a vector at a time that of its largest component."""
    largest = dict[tuple[Any, ...], float]()
    for key, x in numbers.items():
        group = key[:3] if key[0] == "samples" else key
        largest[group] = max(largest.get(group, 0.0), abs(x))
    return {key: largest[key[:3] if key[0] == "samples" else key] for key in numbers}


def _moved(options: dict[str, Any], by: Mapping[tuple[str, int, Typed], float]) -> dict[str, Any]:
    """Return the options with numbers moved by parts of their standard deviations."""
    new_options = dict(options)
    for (name, i, x), step in by.items():
        new, numbers = x.moved(x + step * x.sigma), _parts(before := new_options[name])
        new_options[name] = type(before)((*numbers[:i], new, *numbers[i + 1 :])) if isinstance(before, tuple) else new
    return new_options


def _draws(
    answer: Callable[[dict[str, Any]], dict[str, Any]],
    options: dict[str, Any],
    inputs: list[tuple[str, int, Typed]],
    places: set[tuple[Any, ...]],
    count: int,
) -> dict[tuple[Any, ...], list[float]]:
    """Return the numbers at these places for normal draws of the inputs, where they are there."""
    import random

    normal = random.Random(1).gauss  # noqa: S311
    draws: dict[tuple[Any, ...], list[float]] = {key: [] for key in places}
    with bar("draws") as tell:
        for i in range(count):
            tell(i, count, "")
            try:
                numbers = _numbers(answer(_moved(options, {name: normal(0.0, 1.0) for name in inputs})))
            except DomainError:
                continue
            for key in draws.keys() & numbers.keys():
                draws[key].append(numbers[key])
    return draws


def _deviation(values: list[float]) -> tuple[float, float]:
    """Return the standard deviation of draws, and its own: about 1/sqrt(2 N) of it, more where the tails are long."""
    if len(values) < LEAST:
        return math.inf, math.inf
    mean, few = math.fsum(values) / len(values), len(values) - 1
    second, fourth = (math.fsum((x - mean) ** power for x in values) / few for power in (2, 4))
    return math.sqrt(second), math.sqrt(max(fourth / second - second, 0.0) / (4 * few)) if second else 0.0


def _numbers(value: Any) -> Numbers:
    """Return the finite numbers of an answer by their places; times are none of them."""
    numbers = Numbers()
    mapped(value, lambda x, place: numbers.update({place: x}))
    return {place: x for place, x in numbers.items() if math.isfinite(x)}


def mapped(value: Any, function: Callable[[float, tuple[Any, ...]], Any], place: tuple[Any, ...] = ()) -> Any:
    """Return an answer with a function of each number, and of its place, for it."""
    if isinstance(value, float):
        return function(float(value), place)
    if isinstance(value, Mapping):
        return {key: entry if key == "t" else mapped(entry, function, (*place, key)) for key, entry in value.items()}
    if not isinstance(value, str) and hasattr(value, "__iter__"):
        return [mapped(entry, function, (*place, i)) for i, entry in enumerate(value)]
    return value


def concise(value: float, sigma: float, error: float = 0.0) -> str:
    """Write a number with its standard deviation in its last two digits, 12.57(31) or 1.257(31)e-06.

    In one digit, 12.6(4), where the second is less than the error of the deviation.
    """
    if not 0 < sigma < math.inf or not math.isfinite(value):
        return f"{value:.10g}" if sigma == 0 else f"{value:.10g}(?)"
    last_power = math.floor(math.log10(sigma)) - 1
    if error > 10.0**last_power or round(sigma / 10.0**last_power) == 100:
        last_power += 1
    first = math.floor(math.log10(max(abs(value), sigma)))
    if last_power <= 0 and -4 <= first < 10:
        return f"{value:.{-last_power}f}({round(sigma / 10.0**last_power)})"
    return f"{value / 10.0**first:.{first - last_power}f}({round(sigma / 10.0**last_power)})e{first:+03d}"
