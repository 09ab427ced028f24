"""Numbers as they are typed: with a unit, an uncertainty, as a range, or a field at an angle to the axis."""

import math
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import chain
from typing import Any, NamedTuple, Self

import click

from atlas.errors import AtlasError
from atlas.measured import WANTED, in_si, split

MAX_RANGE_LENGTH = 10**7
"""Numbers in a range."""

RANGE = re.compile(r"(?P<start>[^:]+):(?P<stop>[^:]+):\s*0*(?P<count>\d+)\s*(?P<log>:log)?", re.ASCII)
"""A range START:STOP:COUNT, or with :log at its end."""

LONGEST = 2000
"""Characters of a number that is typed: beyond it, arithmetic with all digits takes its time."""

NUMBER = re.compile(
    r"""[+-]? (?: (?P<decimal> (?: \d+ \.? \d* | \.\d+ ) (?: e[+-]?0*\d{1,4} )? )
              | (?P<fraction> \d+/\d+ )
              | (?P<hexadecimal> 0x (?: [\da-f]+ \.? [\da-f]* | \.[\da-f]+ ) (?: p[+-]?0*\d{1,4} )? ) )""",
    re.ASCII | re.IGNORECASE | re.VERBOSE,
)
"""Ways to type a number, without the underscores and foreign digits that Python reads; exponents of four digits."""

LIKE_A_NUMBER = re.compile("[+\N{MINUS SIGN}-]?" + r"\.?\d[\w.+/()±^*·° -]*")
"""Text that looks like a number, valid or not."""

UNCERTAIN = re.compile(
    r"""(?P<size> [+-]? (?: \d+ (?: \. (?P<decimals> \d* ) )? | \. (?P<digits> \d+ ) ) )
        (?: \( (?P<last> \d+ (?: \. \d* )? | \.\d+ ) \)
          | (?: ± | \+/?- ) (?P<full> (?: \d+ \.? \d* | \.\d+ ) (?: e[+-]?\d+ )? ) ) (?P<rest> .* )""",
    re.ASCII | re.IGNORECASE | re.VERBOSE,
)
"""A number with its standard deviation in its last digits, 1.20(5)um, or in full, 1.2(0.05)um or 1.2±0.05um."""


class Typed(float):
    """A double with the text that was typed for it, in SI if the text has a unit.

    `sigma` is its standard deviation, 0 for none; `unit` the typed unit, "" for none; `exact` the value in SI as a
    fraction, None for a number without unit and for a unit with pi in it.
    """

    text: str
    sigma: float = 0.0
    unit: str = ""
    exact: Fraction | None = None

    def __new__(cls, text: str, option: str | None = None, place: int = 0) -> Self:
        """Return the number in a text: a decimal, a fraction 2/3, a hexadecimal float 0x1.8p0; or one with a unit.

        A unit is allowed only with an `option`, whose unit the number at `place` has. Raises ValueError for other text,
        AtlasError for a unit that does not fit, ZeroDivisionError and OverflowError for a number that is none.
        """
        form = NUMBER.fullmatch(text) if len(text) <= LONGEST else None
        unit, exact = "", None
        if form is not None:
            value = float.fromhex(text) if form["hexadecimal"] else float(Fraction(text) if form["fraction"] else text)
        elif option is not None and len(text) <= LONGEST and (number_and_unit := split(text)):
            value, exact = in_si(Fraction(number_and_unit[0]), unit := number_and_unit[1], option, place)
        else:
            raise ValueError(text)
        number = super().__new__(cls, value)
        number.text, number.unit, number.exact = text, unit, exact
        return number

    def with_value(self, value: float, **attributes: Any) -> Self:
        """Return a copy with another value; `attributes` replace some of its text, sigma, unit and exact."""
        number = float.__new__(type(self), value)
        vars(number).update(vars(self) | attributes)
        return number

    def exactly(self) -> Fraction:
        """Return the typed number as a fraction, not the nearest double. Raises click.UsageError if it involves pi."""
        if not self.unit:
            return Fraction(float(self) if "0x" in self.text.lower() else self.text)
        if self.exact is None:
            raise click.UsageError(f"{self.text} has pi in it and is no decimal: leave out --decimal.")
        return self.exact


class TypedRange(NamedTuple):
    """A range as typed, START:STOP:COUNT: the texts of its two ends, which belong to it, and its length COUNT.

    `is_log` says whether its steps are even in the logarithm.
    """

    start: str
    stop: str
    length: int
    is_log: bool

    @classmethod
    def of(cls, text: str, longest: int = MAX_RANGE_LENGTH) -> "TypedRange | None":
        """Return the range in a text, None for a text without a colon.

        Raises click.UsageError for another text with a colon, and for a count below 2 or above `longest`.
        """
        if ":" not in text:
            return None
        if not (match := RANGE.fullmatch(text)):
            raise click.UsageError(
                f"a range is START:STOP:COUNT, COUNT an integer, with or without :log, not {text!r}."
            )
        start, stop, count, log = match.groups()
        if len(count) > len(str(longest)) or not 2 <= int(count) <= longest:
            raise click.UsageError(f"a range has at least 2 and at most {longest} values, not {count:.30}.")
        return cls(start, stop, int(count), log is not None)

    def check(self, start: float, stop: float) -> None:
        """Raise click.UsageError for steps of the logarithm between ends that are zero or of different signs."""
        if self.is_log and not start * stop > 0:
            raise click.UsageError(
                f"even steps of the logarithm need ends of one sign that are not zero, not {self.start}:{self.stop}."
            )


@dataclass(frozen=True)
class Steps(Sequence[Typed]):
    """Numbers of a range, each computed by `number` from its index in `places` when it is read; a sequence."""

    places: range
    number: Callable[[int], Typed]

    def __len__(self) -> int:
        """Return the number of numbers."""
        return len(self.places)

    def __getitem__(self, index: Any) -> Any:
        """Return the number at an index, or the `Steps` of a slice."""
        places = self.places[index]
        return replace(self, places=places) if isinstance(places, range) else self.number(places)


class Real(click.ParamType):  # type: ignore[type-arg]  # which takes one since click 8.4
    """Click's type of a finite real number; `place` is its index in an option whose numbers have different units."""

    name = "number"

    def __init__(self, place: int = 0) -> None:
        self.place = place

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return the `Typed` number, or several for an option of any length: a tuple, or `Steps` of a range.

        Raises click.UsageError for other text. `value` is the typed text, `param` click's option.
        """
        if param and param.multiple:
            return joined([self._listed(word, param, ctx) for word in re.split(r"[,\s]+", value)])
        return self._single(value, param, ctx)

    def _single(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Typed:
        text = str(value).replace("\N{MINUS SIGN}", "-").replace("\N{DEGREE SIGN}", "deg")  # as on a page
        if (match := UNCERTAIN.fullmatch(text)) is not None:
            return self._with_sigma(text, match, param, ctx)
        try:
            number = Typed(text, str(param.name) if param else "", self.place)
        except AtlasError as error:
            self.fail(str(error), param, ctx)
        except OverflowError:
            self.fail(f"{text!r} is beyond the largest float.", param, ctx)
        except (ValueError, ZeroDivisionError):
            if len(text) > LONGEST:
                self.fail(f"{text!r} has {len(text)} characters; a number has at most {LONGEST}.", param, ctx)
            if re.fullmatch(r"[+-]?[\d.]+e[+-]?\d+", text, re.ASCII | re.IGNORECASE):
                self.fail(f"{text!r} has an exponent of more than four digits: choose another unit.", param, ctx)
            remedy = "1.5, 3/2 or 1e-3" + ", or a range START:STOP:COUNT" * bool(param and param.multiple)
            if re.search(r"[(±]|\+/?-", text):
                remedy = "an uncertainty as 1.5(1) or 1.5±0.1"
            self.fail(f"{text!r} is not a finite number; write {remedy}.", param, ctx)
        if not math.isfinite(number):
            self.fail(f"{text!r} is beyond the largest float.", param, ctx)
        return number

    def _listed(self, word: str, param: click.Parameter, ctx: click.Context | None) -> Sequence[Typed]:
        """Return the numbers of START:STOP:COUNT[:log], ends included, as `Steps`; of a single number a tuple."""
        if (typed_range := TypedRange.of(word)) is None:
            return (self._single(word, param, ctx),)
        start, stop = (self._single(item, param, ctx) for item in typed_range[:2])
        check_units(param.opts[0], (start, stop))
        typed_range.check(start, stop)
        name, places = str(param.name), range(typed_range.length)
        unit, last_place = str(WANTED[name]) if start.unit or stop.unit else "", places[-1]
        ends = start.exactly(), stop.exactly()
        denominator = math.lcm(*(end.denominator for end in ends)) * last_place
        first_numerator, last_numerator = (int(end * denominator) for end in ends)
        # whole, so that each place is one division, rounded once
        step = (last_numerator - first_numerator) // last_place

        def number(i: int) -> Typed:
            if typed_range.is_log and i not in (0, last_place):
                low, high = math.log10(abs(start)), math.log10(abs(stop))
                x = math.copysign(10.0 ** (low + (high - low) * i / last_place), start)
            else:
                x = (first_numerator + i * step) / denominator
            return Typed(f"{x!r}{unit}", name, self.place) if unit else start.with_value(x, text=repr(x))

        return Steps(places, number)

    def _with_sigma(
        self, text: str, match: re.Match[str], param: click.Parameter | None, ctx: click.Context | None
    ) -> Typed:
        """Return the number of a text such as 1.20(5), with its standard deviation in `sigma`.

        `match` is that of `UNCERTAIN`. Raises click.UsageError for a command or an option that carries no
        uncertainties.
        """
        is_carried = getattr(ctx.command if ctx else None, "carries", False)
        if not is_carried or (param and param.name in {"times", "grid", "least"}):
            self.fail(
                f"{text!r} has an uncertainty, which is not carried here: leave it out; atlas motion carries those of "
                "body, field and start.", param, ctx,
            )  # fmt: skip
        decimals, sigma = len(match["decimals"] or match["digits"] or ""), match["last"] or match["full"]
        if match["last"] and "." not in sigma:
            sigma += f"e-{decimals}"
        ending = match["rest"]
        number: Typed
        number, size, scale = (self._single(x, param, ctx) for x in (match["size"] + ending, sigma, f"1{ending}"))
        number.sigma = float(size) * float(scale)
        number.text = text if number.sigma else number.text
        return number


REAL = Real()


class Inclined(tuple[Typed, ...]):  # noqa: SLOT001  it has its parts
    """Components (across, along) of a field at an angle to the axis, each rounded once; a tuple.

    `strength_and_angle` are (strength, angle in rad) as typed.
    """

    strength_and_angle: tuple[Typed, Typed]

    def __new__(cls, strength_and_angle: tuple[Typed, Typed], unit: str = "") -> Self:
        """Return (strength sin(angle), strength cos(angle)), each rounded once; an angle in degrees is taken exactly.

        `unit` is put to the components' texts.
        """
        from flint import arb, fmpq

        from atlas.arithmetic.numbers import rounded

        size, angle = strength_and_angle
        degrees = split(angle.text) if angle.unit == "deg" and not angle.sigma else None
        turn = fmpq(*Fraction(degrees[0]).as_integer_ratio()) / 180 if degrees else None
        components = rounded(
            lambda: [
                arb(float(size)) * x
                for x in (arb(float(angle)).sin_cos() if turn is None else arb.sin_cos_pi_fmpq(turn))
            ]
        )
        new = super().__new__(cls, [size.with_value(x, sigma=0.0, text=f"{x!r}{unit}") for x in components])
        new.strength_and_angle = strength_and_angle
        return new


def joined(numbers: Sequence[Sequence[Typed]]) -> Sequence[Typed]:
    """Return the numbers of several words, a sequence for each, as one tuple; of a single word as they are.

    A single range stays `Steps`.
    """
    return numbers[0] if len(numbers) == 1 else tuple(chain.from_iterable(numbers))


def parts_of(value: Any) -> tuple[Any, ...]:
    """Return the numbers of an option as a tuple: of a range its two ends, of a single number one.

    A tuple is returned as it is.
    """
    if isinstance(value, Steps):
        return value[0], value[-1]
    return value if isinstance(value, tuple) else (value,)


def check_units(option: str, value: Any) -> None:
    """Raise click.UsageError where some numbers of an option have units and other nonzero ones have none.

    `value` is that of the option: a number, a tuple or a range.
    """
    numbers = [x for x in parts_of(value) if isinstance(x, Typed) and x]
    bare, units = [x for x in numbers if not x.unit], [x for x in numbers if x.unit]
    if bare and units:
        raise click.UsageError(
            f"{option}: {bare[0].text} has no unit, and {units[0].text} beside it has one; give each its unit, or none."
        )


def measured(options: Mapping[str, Any]) -> list[tuple[str, Typed]]:
    """Return pairs (name of the option, number) for all numbers typed with a unit."""
    return [(name, x) for name, value in options.items() for x in parts_of(value) if isinstance(x, Typed) and x.unit]


def exactly(value: Any, options: dict[str, Any]) -> Any:
    """Return typed numbers for certified classes: as they are, doubles, or with --decimal exact fractions.

    `value` is a number, or a sequence of numbers, of which a list is returned; `options` are the command's, by
    name. Raises click.UsageError for a number with pi in its unit.
    """
    if isinstance(value, tuple | list | Steps):
        return [exactly(item, options) for item in value]
    return value.exactly() if options["decimal"] and isinstance(value, Typed) else value
