"""The worst errors found, by quantity and regime, and the inputs that kernels refuse."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

from ulps import BITS

from atlas.arithmetic.numbers import workprec
from atlas.errors import AtlasError


@dataclass(frozen=True)
class Worst:
    """The largest error of a quantity in a regime, the exact input that gives it, and how many values were checked."""

    quantity: str
    regime: str
    ulps: float
    input: Mapping[str, Any]
    samples: int


@dataclass(frozen=True)
class Refusal:
    """An input that a kernel refused, and the message."""

    quantity: str
    regime: str
    reason: str
    input: Mapping[str, Any]


@dataclass
class WorstErrors:
    """The worst errors found so far, by quantity and regime, and the refusals."""

    worst: dict[tuple[str, str], Worst] = field(default_factory=dict)
    refusals: list[Refusal] = field(default_factory=list)

    def add(self, quantity: str, regime: str, errors: Sequence[float], describe: Callable[[int], Any]) -> None:
        """Take errors in ulps; ``describe(i)`` gives the input of the i-th."""
        if errors:
            index = max(range(len(errors)), key=errors.__getitem__)
            self._take(Worst(quantity, regime, errors[index], describe(index), len(errors)))

    @contextmanager
    def checking(self, quantity: str, regime: str, inputs: Any) -> Iterator[None]:
        """Check at the precision of the truth, and keep the message of a kernel that refuses."""
        try:
            with workprec(BITS + 16):
                yield
        except AtlasError as reason:
            self.refusals.append(Refusal(quantity, regime, str(reason), inputs))

    def merge(self, other: "WorstErrors") -> None:
        """Take over the errors of others."""
        for worst in other.worst.values():
            self._take(worst)
        self.refusals.extend(other.refusals)

    def _take(self, new: Worst) -> None:
        key = new.quantity, new.regime
        previous = self.worst.get(key, Worst(*key, -1.0, {}, 0))
        larger = new if new.ulps > previous.ulps else previous
        self.worst[key] = Worst(*key, larger.ulps, larger.input, new.samples + previous.samples)


def with_more(inputs: dict[str, Any], **extra: Any) -> Callable[[int], dict[str, Any]]:
    """Return the description of an input with more of it, whichever of the values was the worst."""
    return lambda _: inputs | extra
