"""Standard deviations of numbers that depend on uncertain inputs, and objects that are made of such inputs."""

import math
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial, wraps
from time import process_time
from typing import Any, NamedTuple, Self

from atlas.arithmetic.lazy import cached_property
from atlas.errors import AtlasError, AtlasWarning, DomainError

DERIVATIVE_STEP = 1 / 8
"""Part of a standard deviation over which a derivative is taken, by differences on both sides."""

MAX_CURVATURE = 0.03
"""Part of a deviation by which terms of second and third order may change it; beyond, the number is sampled."""

MAX_LOST = 0.05
"""Part of the draws that may lie outside a domain: the scatter of the others is still right to a tenth."""

ROUNDING = 1e-12
"""Part of a number, or of the largest component of a vector or a matrix, that is rounding and no uncertainty."""

DRAWS, MAX_DRAWN_NUMBERS, MIN_DRAWS = 500, 2_000_000, 25
"""Draws of the inputs; numbers in all of them, which fewer draws do not exceed; and draws that a deviation needs."""

SLOW_ANSWER = 0.05
"""Seconds of an answer above which 4 MIN_DRAWS draws are made, whose deviation is right to 7 %."""

BY_SAMPLING = "by sampling, {}, since they are not of first order."
BY_NEITHER = "no deviation: they are not of first order, and by sampling there are {}."
ONE_SIDED = "by derivatives on one side: on the other they have no value a standard deviation off."

Place = tuple[Any, ...]
Numbers = dict[Place, float]
"""Numbers of an answer by their place in it."""

Steps = Sequence[float]
"""Change of each independent input, in its standard deviations."""


@dataclass(frozen=True)
class Spread:
    """Numbers with their standard deviations, by place: the tuple of keys and indices of a number in an answer.

    Attributes
    ----------
    slopes : dict of place to list of float
        First-order change of each number over one standard deviation of each input.
    sigma, error : dict of place to float
        Standard deviation of each number, infinite where it is unknown; error of a sampled deviation.
    sampled : set of places
        Numbers whose deviation is not of first order.
    notes : list of str
        Sentences on deviations that are not derivatives on both sides.
    """

    slopes: dict[Place, list[float]]
    sigma: Numbers
    error: Numbers
    sampled: set[Place]
    notes: list[str]


def spread(
    middle: Any, answer: Callable[[Steps], Any], count: int, progress: Callable[[int, int, str], None] | None = None
) -> Spread:
    """Return the `Spread` of the numbers in ``middle``, the answer at the nominal inputs.

    ``answer`` takes a step for each of ``count`` independent inputs, in standard deviations, and returns a nested
    answer as `numbers_of` takes; it may raise DomainError where there is no value. Deviations are of first order,
    by central differences, or one-sided where a number has no value a standard deviation off on one side. They are
    sampled where terms of second and third order would change them by more than `MAX_CURVATURE`, and where a number
    has no value on either side; a number that too many draws lack has an infinite deviation. ``progress`` gets
    (draw, draws, "").
    """
    numbers = numbers_of(middle)
    sizes = _sizes(numbers)
    directions = [tuple(float(i == j) for j in range(count)) for i in range(count)]
    together = [(count**-0.5,) * count] * (count > 1)
    began = process_time()
    terms = [_terms(answer, direction, numbers) for direction in directions + together]
    seconds = (process_time() - began) / (4 * len(terms))
    single_terms = terms[:count]
    slopes = {key: [x.line.get(key, 0.0) for x in single_terms] for key in numbers}
    sigma = {key: math.hypot(*slopes[key]) for key in numbers}
    curved_sigma = {
        key: math.hypot(*(x.second.get(key, 0.0) for x in terms), *(x.third.get(key, 0.0) for x in single_terms))
        for key in numbers
    }
    curved = {
        key
        for key in numbers
        if abs(curved_sigma[key] - sigma[key]) > MAX_CURVATURE * sigma[key] + ROUNDING * sizes[key]
    }
    curved |= {key for key in numbers if not all(key in x.line for x in terms)}
    ended = {key for x in terms for key in x.ended if sigma[key] > ROUNDING * sizes[key]} - curved
    error, sentences = Numbers(), {ONE_SIDED: ended}
    if curved:
        min_size = 4 * MIN_DRAWS
        size = min_size if seconds > SLOW_ANSWER else min(DRAWS, max(MAX_DRAWN_NUMBERS // len(numbers), min_size))
        draws = _draws(answer, count, curved, size, progress)
        deviations = {key: _deviation(values, size) for key, values in draws.items()}
        sigma |= {key: deviation for key, (deviation, _) in deviations.items()}
        error = {key: uncertainty for key, (_, uncertainty) in deviations.items()}
        sentences |= _sentences_on(draws, size)
    notes = list[str]()
    for text, keys in sentences.items():
        names = dict.fromkeys(str(key[2] if key[0] == "samples" else key[0]) for key in numbers if key in keys)
        notes += [f"Of {', '.join(names)} {text}"] * bool(names)
    sigma = {key: x if x > ROUNDING * sizes[key] else 0.0 for key, x in sigma.items()}
    return Spread(slopes, sigma, error, curved, notes)


class Terms(NamedTuple):
    """Terms of a Taylor series in one direction, for a step of one standard deviation, dictionaries by place.

    `line` is the first-order term; `second` is sqrt(2) times the second-order term, its standard deviation; `third`
    is the first-order term corrected by the third-order one. `ended` are the places of numbers that have a value on
    one side only.
    """

    line: Numbers
    second: Numbers
    third: Numbers
    ended: set[Place]


def _terms(answer: Callable[[Steps], Any], direction: Steps, middle: Numbers) -> Terms:
    """Return the `Terms` of the numbers in ``middle`` for a step of one standard deviation along ``direction``.

    A number with a value on one side only has terms of that side's parabola, without one on both sides no entry.
    """

    def off(step: float) -> Numbers:
        try:
            return numbers_of(answer([step * x for x in direction]))
        except DomainError:
            return {}

    terms, sides = Terms({}, {}, {}, set()), [[off(sign * step) for step in (DERIVATIVE_STEP, 1.0)] for sign in (1, -1)]
    for key, x in middle.items():
        differences = [
            [numbers[key] - x for numbers in side] for side in sides if all(key in numbers for numbers in side)
        ]
        if len(differences) == 2:
            (near_difference, after), (opposite_difference, before) = differences
            terms.line[key] = (near_difference - opposite_difference) / (2 * DERIVATIVE_STEP)
            terms.second[key] = (after + before) / 2**0.5
            terms.third[key] = 1.5 * (after - before) - 2 * terms.line[key]
        elif differences:  # of the parabola through three points; the sign follows the side
            terms.ended.add(key)
            ((near_difference, after),) = differences
            slope = (near_difference - DERIVATIVE_STEP**2 * after) / (DERIVATIVE_STEP - DERIVATIVE_STEP**2)
            terms.second[key] = (after - slope) * 2**0.5
            terms.line[key] = terms.third[key] = slope if key in sides[0][0] and key in sides[0][1] else -slope
    return terms


def _sizes(numbers: Numbers) -> Numbers:
    """Return the magnitude of each number by place; for an entry of a sampled vector or matrix the largest one's."""
    largest = dict[Place, float]()
    for key, x in numbers.items():
        group = key[:3] if key[0] == "samples" else key
        largest[group] = max(largest.get(group, 0.0), abs(x))
    return {key: largest[key[:3] if key[0] == "samples" else key] for key in numbers}


def _draws(
    answer: Callable[[Steps], Any],
    count: int,
    places: set[Place],
    size: int,
    progress: Callable[[int, int, str], None] | None,
) -> dict[Place, list[float]]:
    """Return by place the values of numbers, those in ``places``, for ``size`` normal draws of the ``count`` inputs.

    A draw without a value is left out. The draws are the same in every run. ``progress`` gets (draw, draws, "").
    """
    import random

    normal = random.Random(1).gauss  # noqa: S311
    draws: dict[Place, list[float]] = {key: [] for key in places}
    for i in range(size):
        if progress is not None:
            progress(i, size, "")
        try:
            numbers = numbers_of(answer([normal(0.0, 1.0) for _ in range(count)]))
        except DomainError:
            continue
        for key in draws.keys() & numbers.keys():
            draws[key].append(numbers[key])
    return draws


def _is_lost(values: list[float], size: int) -> bool:
    """Whether so many of ``size`` draws lack a value that the scatter of the others, ``values``, would be biased."""
    return len(values) < max(size - MAX_LOST * size, MIN_DRAWS)


def _sentences_on(draws: Mapping[Place, list[float]], size: int) -> dict[str, set[Place]]:
    """Return sets of places by sentence: of sampled deviations, and of numbers that too many draws lack.

    ``draws`` are the values by place, of ``size`` draws. A sentence names the number of draws, and the largest
    number of draws without a value.
    """
    lost_keys = {key for key, values in draws.items() if _is_lost(values, size)}
    sentences = {}
    for keys, text in ((draws.keys() - lost_keys, BY_SAMPLING), (lost_keys, BY_NEITHER)):
        failures = size - min((len(draws[key]) for key in keys), default=size)
        sentences[text.format(f"{size} draws" + f", {failures} of them without a value" * bool(failures))] = keys
    return sentences


def _deviation(values: list[float], size: int) -> tuple[float, float]:
    """Return (standard deviation of draws, its own standard error); inf if too many of ``size`` draws lack a value."""
    if _is_lost(values, size):
        return math.inf, math.inf
    mean, freedom = math.fsum(values) / len(values), len(values) - 1
    second, fourth = (math.fsum((x - mean) ** power for x in values) / freedom for power in (2, 4))
    return math.sqrt(second), math.sqrt(max(fourth / second - second, 0.0) / (4 * freedom)) if second else 0.0


def numbers_of(answer: Any) -> Numbers:
    """Return the finite floats of a nested answer by place, a tuple of keys and indices; entries "t" are left out.

    An answer is a float, or mappings and sequences of answers, integers and texts.
    """
    numbers = Numbers()
    mapped(answer, lambda x, place: numbers.update({place: x}))
    return {place: x for place, x in numbers.items() if math.isfinite(x)}


def mapped(value: Any, function: Callable[[float, Place], Any], place: Place = ()) -> Any:
    """Return a nested answer with each float replaced by function(float, place); entries "t", integers and texts stay.

    Sequences become lists.
    """
    if isinstance(value, float):
        return function(float(value), place)
    if isinstance(value, Mapping):
        return {key: entry if key == "t" else mapped(entry, function, (*place, key)) for key, entry in value.items()}
    if not isinstance(value, str) and hasattr(value, "__iter__"):
        return [mapped(entry, function, (*place, i)) for i, entry in enumerate(value)]
    return value


def is_uncertain(*arguments: Any) -> bool:
    """Whether an argument is, or holds in a tuple, list or array, a number with a standard deviation."""
    return any(True for _ in _uncertain(arguments))


def _listed(value: Any) -> Any:
    """Return an array of objects as a list, and any other value unchanged."""
    return value.tolist() if getattr(getattr(value, "dtype", None), "kind", "") == "O" else value


def _uncertain(value: Any) -> Iterator[Any]:
    """Yield the numbers with `nominal_value` and `std_dev` in a value, in nested lists and `UncertainObject`."""
    value = _listed(value)
    if isinstance(value, UncertainObject):
        value = value.inputs
    if isinstance(value, tuple | list):
        for entry in value:
            yield from _uncertain(entry)
    elif hasattr(value, "nominal_value") and hasattr(value, "std_dev"):
        yield value


def _replaced(value: Any, function: Callable[[Any], float]) -> Any:
    """Return a value with function(x) in the place of each number x that has a standard deviation.

    Such numbers stand alone, in lists and tuples, or in an `UncertainObject`, which is made anew.
    """
    value = _listed(value)
    if isinstance(value, UncertainObject):
        return value.made_of(function)
    if isinstance(value, tuple | list):
        entries = [_replaced(entry, function) for entry in value]
        return tuple(entries) if isinstance(value, tuple) else entries
    return function(value) if is_uncertain(value) else value


def in_independent_inputs(values: Mapping[str, Any]) -> tuple[dict[str, Any], dict[str, tuple[float, ...]]]:
    """Return (values with nominal numbers, slopes by name of each uncertain number).

    Slopes are the changes of the number over one standard deviation of each independent input; a number without any is
    left out.
    """
    numbers = {name: _with_derivatives(x) for name, x in values.items() if hasattr(x, "std_dev")}
    variables = _variables(numbers.values())
    slopes = {name: tuple(x.derivatives.get(v, 0.0) * v.std_dev for v in variables) for name, x in numbers.items()}
    nominal = {name: x.nominal_value for name, x in numbers.items()}
    return dict(values) | nominal, {name: x for name, x in slopes.items() if any(x)}


def _with_derivatives(x: Any) -> Any:
    """Return a number with a standard deviation as an object of the package `uncertainties`; unchanged if it is one.

    Other numbers become independent variables.
    """
    from uncertainties import ufloat

    return x if hasattr(x, "derivatives") else ufloat(x.nominal_value, x.std_dev)


def _variables(numbers: Iterable[Any]) -> list[Any]:
    """Return a list of the distinct independent variables with a nonzero deviation behind ``numbers``.

    These are numbers of the package `uncertainties`.
    """
    return list(dict.fromkeys(v for x in numbers for v in x.derivatives if v.std_dev))


class UncertainObject:
    """Motion, body or field from inputs with standard deviations, such as those of `uncertainties.ufloat`.

    Attributes and functions of time are those of the object: numbers and arrays of them come as `ufloat`, correlated
    with the inputs and with one another. Text, integers and booleans are those of the nominal object. A body or a field
    with standard deviations is an input like a number.

    Attributes
    ----------
    nominal_value : Motion, SymmetricBody or Field
        Object at the nominal values of the inputs.
    inputs : list
        Positional and named inputs.

    Raises
    ------
    AtlasError
        For an attribute that is no number, such as a picture: `nominal_value` has it.

    Warns
    -----
    AtlasWarning
        Where a deviation is not of first order: it is then sampled, and the number independent of the inputs.
    """

    def __init__(self, make: Callable[..., Any], arguments: Sequence[Any], named: Mapping[str, Any]) -> None:
        self._make, self._arguments, self._named = make, arguments, dict(named)
        self.inputs = [*arguments, *named.values()]
        self._inputs = {id(x): _with_derivatives(x) for x in _uncertain(self.inputs)}
        self._variables = _variables(self._inputs.values())
        self._objects = dict[tuple[float, ...], Any]()
        self.nominal_value = self._moved_object((0.0,) * len(self._variables))

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *dir(self.nominal_value)]

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self._make, self._arguments, self._named)

    def __repr__(self) -> str:
        texts = [*map(repr, self._arguments), *(f"{name}={x!r}" for name, x in self._named.items())]
        family = getattr(self._make, "__self__", None)  # of a class method
        name = f"{family.__name__}.{self._make.__name__}" if family else self._make.__name__
        return f"{name}({', '.join(texts)})"

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        value = getattr(self.nominal_value, name)
        if callable(value):
            return lambda *args, **how: self._uncertain_quantity(
                name, lambda instance: getattr(instance, name)(*args, **how)
            )
        return self._uncertain_quantity(name, lambda instance: getattr(instance, name))

    @cached_property
    def _units(self) -> list[Any]:
        """List of the independent inputs less their nominal values, in standard deviations."""
        return [(v - v.nominal_value) / v.std_dev for v in self._variables]

    def made_of(self, value_of: Callable[[Any], float]) -> Any:
        """Return the object of inputs whose uncertain numbers x are replaced by value_of(x), floats."""
        arguments, named = (_replaced(tuple(x), value_of) for x in (self._arguments, self._named.values()))
        return self._make(*arguments, **dict(zip(self._named, named, strict=True)))

    def _moved_object(self, steps: Steps) -> Any:
        """Return the object for ``steps`` of the independent inputs, in standard deviations.

        The first objects, as many as derivatives need, are kept.
        """
        key = tuple(steps)
        if key not in self._objects:
            by_variable = dict(zip(self._variables, steps, strict=True))

            def value(x: Any) -> float:
                uncertain_input = self._inputs[id(x)]
                changes = (d * v.std_dev * by_variable.get(v, 0.0) for v, d in uncertain_input.derivatives.items())
                return float(uncertain_input.nominal_value + math.fsum(changes))

            instance = self.made_of(value)
            if len(self._objects) > 4 * len(self._variables) + 4:
                return instance
            self._objects[key] = instance
        return self._objects[key]

    def _uncertain_quantity(self, name: str, get: Callable[[Any], Any]) -> Any:
        """Return a quantity of the object with its standard deviations, a `ufloat` or an object array of them.

        ``get`` takes the object and returns the quantity called ``name``; text, integers and booleans are returned
        unchanged. Raises AtlasError for a quantity that is no number. Warns (AtlasWarning) where a deviation is
        sampled.
        """
        import numpy as np

        nominal = get(self.nominal_value)
        array = np.asarray(nominal)
        if array.dtype.kind in "biU":
            return nominal
        if array.dtype.kind != "f":
            raise AtlasError(f"{name} carries no standard deviation: take nominal_value.{name}, of the nominal inputs.")

        def rows(values: Any) -> dict[str, Any]:
            values = np.asarray(values)
            return {"samples": [{name: row} for row in values.reshape(-1, *values.shape[-1:] or (1,))]}

        deviations = spread(rows(nominal), lambda steps: rows(get(self._moved_object(steps))), len(self._variables))
        for note in deviations.notes:
            warnings.warn(note, AtlasWarning, stacklevel=3)
        number = partial(self._number, deviations)
        entries = np.empty(array.size, dtype=object)
        entries[:] = [x for sample in mapped(rows(nominal), number)["samples"] for x in sample[name]]
        return entries.reshape(array.shape) if array.ndim else entries[0]

    def _number(self, deviations: Spread, value: float, place: Place) -> Any:
        """Return a number as a `ufloat`: the sum of its first-order terms, or independent where it is sampled.

        ``place`` is its place in ``deviations``. An unknown or infinite deviation becomes NaN.
        """
        from uncertainties import ufloat

        sigma = deviations.sigma.get(place, math.nan)
        if place in deviations.sampled or not math.isfinite(sigma):
            return ufloat(value, sigma if math.isfinite(sigma) else math.nan)
        slopes = deviations.slopes[place] if sigma else [0.0] * len(self._units)
        return sum((slope * unit for slope, unit in zip(slopes, self._units, strict=True)), value + 0 * self._units[0])


class CarriesUncertainty:
    """Base of classes whose inputs, those of their class methods too, may have standard deviations.

    Such inputs give an `UncertainObject` in the place of an instance.
    """

    def __new__(cls, *inputs: Any, **named: Any) -> Self:
        """Return a new instance, or the `UncertainObject` of the inputs if one of them is uncertain."""
        if is_uncertain(*inputs, *named.values()):
            return UncertainObject(cls, inputs, named)  # type: ignore[return-value]  # its numbers vary
        return super().__new__(cls)

    def __init_subclass__(cls, **how: Any) -> None:
        """Let the public class methods of the subclass take uncertain inputs too, by `_carrying`."""
        super().__init_subclass__(**how)
        for name, method in [*vars(cls).items()]:
            if isinstance(method, classmethod) and not name.startswith("_"):
                setattr(cls, name, classmethod(_carrying(method.__func__)))


def _carrying(constructor: Callable[..., Any]) -> Callable[..., Any]:
    """Return a class method's function changed to return an `UncertainObject` where an input is uncertain."""

    @wraps(constructor)
    def construct(cls: type, *inputs: Any, **named: Any) -> Any:
        if is_uncertain(*inputs, *named.values()):
            return UncertainObject(getattr(cls, constructor.__name__), inputs, named)
        return constructor(cls, *inputs, **named)

    return construct


def concise(value: float, sigma: float, error: float = 0.0) -> str:
    """Return a number as text with its standard deviation in its last two digits, 12.57(31) or 1.257(31)e-06.

    The deviation has one digit, 12.6(3), where its second is less than its ``error``. A deviation 0 gives ten digits
    alone, an infinite or unknown one "(?)" behind them.
    """
    if not 0 < sigma < math.inf or not math.isfinite(value):
        return f"{value:.10g}" if sigma == 0 else f"{value:.10g}(?)"
    from uncertainties import ufloat

    digits = 1 if error > 10.0 ** (math.floor(math.log10(sigma)) - 1) else 2
    return f"{ufloat(value, sigma):.{digits}uS}"
