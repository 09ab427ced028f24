"""Numbers typed with an uncertainty, 5000(200)e, and the deviation of each number that a command prints."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from atlas.arithmetic.uncertainty import Spread, concise, mapped, spread
from atlas.cli.present import bar
from atlas.cli.typed import Typed, parts_of

FIRST_ORDER = "In brackets one standard deviation, in the last digits; of first order, by derivatives."


@dataclass(frozen=True)
class UncertainAnswer:
    """Answer of a command, a nested dict of numbers and texts, and the standard deviations of its numbers."""

    answer: dict[str, Any]
    spread: Spread

    @classmethod
    def of(cls, answer: Callable[[dict[str, Any]], dict[str, Any]], options: dict[str, Any]) -> "UncertainAnswer":
        """Return the answer to these options with the standard deviations that their independent uncertainties cause.

        `answer` maps options, by name, to the answer, a nested dict, and is called again with moved options.
        """
        inputs, middle = uncertain(options), answer(options)
        with bar("draws", every=10) as tell:
            deviations = spread(middle, lambda steps: answer(_moved_options(options, inputs, steps)), len(inputs), tell)
        return cls(middle, deviations)

    @property
    def notes(self) -> list[str]:
        """Sentences on the standard deviations: that they are of first order, and on numbers that were sampled."""
        return [FIRST_ORDER, *self.spread.notes]

    def texts(self) -> Any:
        """Return the answer, nested as it is, with its numbers as texts, 12.57(3): the error of the last digits."""
        sigma, error = self.spread.sigma, self.spread.error
        return mapped(self.answer, lambda x, place: concise(x, sigma.get(place, 0.0), error.get(place, 0.0)))

    def rates(self, names: list[str]) -> dict[str, str]:
        """Return the rates among `names`, divided by 2 pi (in hertz for rad/s), as texts with deviations, by name.

        Names without a number in the answer are left out.
        """
        rates = {(name,): self.answer[name] for name in names if isinstance(self.answer.get(name), float)}
        sigma, error = self.spread.sigma, self.spread.error
        return {
            place[0]: concise(*(x / (2 * math.pi) for x in (rate, sigma.get(place, 0.0), error.get(place, 0.0))))
            for place, rate in rates.items()
        }

    def record(self) -> dict[str, Any]:
        """Return the answer for JSON, with "notes" and a copy under "sigma" that holds standard deviations.

        A deviation that is not known, or infinite, is None.
        """
        deviations = {place: x for place, x in self.spread.sigma.items() if x < math.inf}
        sigma = mapped(self.answer, lambda _, place: deviations.get(place))
        return self.answer | {"sigma": sigma, "notes": self.notes}


def uncertain(options: Mapping[str, Any]) -> list[tuple[str, int, Typed]]:
    """Return (option, index in the option, number) for each number of the options with an uncertainty.

    [] if none has.
    """
    values = ((name, _typed_numbers(value)) for name, value in options.items())
    return [(name, i, x) for name, numbers in values for i, x in enumerate(numbers) if getattr(x, "sigma", 0.0)]


def without_deviation(value: Any) -> Any:
    """Return the value of an option, a number or a tuple, with all standard deviations set to 0."""
    if isinstance(value, tuple):
        return type(value)(map(without_deviation, value))
    return value.with_value(float(value), sigma=0.0) if getattr(value, "sigma", 0.0) else value


def _typed_numbers(value: Any) -> tuple[Any, ...]:
    """Return the typed numbers of an option as a tuple; of a field at an angle its strength and angle."""
    return getattr(value, "strength_and_angle", parts_of(value))


def _moved_options(options: dict[str, Any], inputs: list[tuple[str, int, Typed]], steps: Any) -> dict[str, Any]:
    """Return a copy of the options with uncertain numbers changed by `steps` standard deviations.

    There is a step for each of `inputs`, which are those of `uncertain`.
    """
    new_options = dict(options)
    for (name, i, x), step in zip(inputs, steps, strict=True):
        new, numbers = x.with_value(x + step * x.sigma), _typed_numbers(before := new_options[name])
        new_options[name] = type(before)((*numbers[:i], new, *numbers[i + 1 :])) if isinstance(before, tuple) else new
    return new_options
