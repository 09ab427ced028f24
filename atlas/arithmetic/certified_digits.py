"""Text with proven digits only: the one place where a certified number becomes decimal.

`certified` computes a quantity at rising precision until the digits asked for are proven, and returns their text.
`printed` prints one value. A digit is proven when both ends of the ball round to it, half to even, so that every
number inside does. A text that ends in `MARK` has fewer digits than asked for, all of them proven. A number that is
not told from zero, and proven to be smaller than 1e-30 in size, has the text ``0 within 1e-30``. `NOT_CERTIFIED` stands
where not even that is proven, and `INFINITE` for an infinite number.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

from flint import arb, fmpq

from atlas.arithmetic.certified_inputs import Real
from atlas.arithmetic.numbers import workprec
from atlas.errors import AtlasError

Layout: TypeAlias = Literal["plain", "scientific", "fixed", "tex"]
LAYOUTS = ("plain", "scientific", "fixed", "tex")
MARK = "?"
NOT_CERTIFIED, INFINITE, ZERO_WITHIN = "not certified", "infinite", "0 within "
BITS_A_DIGIT = 3.3220
NO_FLOAT = arb(2) ** -4000  # less than half of the least float
SPARE_BITS = 1 << 16  # bits of precision beyond those asked for at which the search for a proof ends


@dataclass(frozen=True)
class Printed:
    """A number as text, the count of its proven digits, and whether all requested digits are proven.

    `digits` counts significant digits, in the layout "fixed" decimals; it is 0 for a text such as "not certified".
    """

    text: str
    digits: int
    complete: bool


def certified(function: Callable[[], Any], digits: int, layout: Layout = "plain", spare: int = SPARE_BITS) -> Any:
    """Return the result of ``function``, each certified number in it as text with ``digits`` proven digits.

    ``function`` takes no argument and computes at the current precision. It returns a number or nested lists,
    tuples and dictionaries of numbers; other items (names, None) are unchanged. ``digits`` counts significant
    digits, in the layout ``fixed`` decimals. Only an exact zero has the text ``0``. The search for digits of any
    other number ends ``spare`` bits beyond; a number that is then not told from zero has the text ``0 within
    1e-k``, k >= ``digits``. Raises AtlasError for fewer than one digit (of decimals, none) and for a layout that is
    not in `LAYOUTS`.
    """
    _check(digits, layout)

    def complete(value: Any) -> bool:
        return all(printed(x, digits, layout).complete for x in numbers(value))

    value = _refined(function, int(digits * BITS_A_DIGIT) + 8, complete, spare)
    return _mapped(value, lambda x: printed(x, digits, layout).text)


def enclosed(function: Callable[[], Any], bits: int) -> Any:
    """Return the result of ``function``, its balls with relative radii below 2**-bits, or as near as the search comes.

    ``function`` takes no argument, computes at the current precision and returns a number or nested dictionaries, lists
    and tuples of numbers. The search ends at 4 ``bits`` + `SPARE_BITS` of precision. A ball about zero within 2**-4000
    suffices: zero is the float nearest to all its points.
    """

    def enough(x: Real) -> bool:
        return isinstance(x, fmpq) or x.rel_accuracy_bits() >= bits or bool(abs(x) < NO_FLOAT)

    def accurate(value: Any) -> bool:
        return all(map(enough, numbers(value)))

    return _refined(function, bits, accurate)


def printed(value: Real, digits: int, layout: Layout) -> Printed:
    """Return a ball or rational as `Printed`, with at most ``digits`` proven digits, a mark behind fewer.

    ``layout`` is one of `LAYOUTS`; "fixed" counts decimals. An infinite ball is the text `INFINITE`, complete; one
    without a proven digit or not finite is `NOT_CERTIFIED`. A ball about zero within 10^-digits is "0 within 1e-k".
    """
    if isinstance(value, arb) and value == arb("inf"):
        return Printed(INFINITE, digits, complete=True)
    if isinstance(value, arb) and not value.is_finite():
        return Printed(NOT_CERTIFIED, 0, complete=False)
    lower, upper = _ends(value)
    if layout == "fixed":
        return _fixed(lower, upper, digits)
    if lower == upper == 0:
        return Printed("0", digits, complete=True)
    for count in range(_max_digits(lower, upper, digits), 0, -1):
        low, high = _rounded(lower, count), _rounded(upper, count)
        if low == high:
            mark = "" if count == digits else MARK
            return Printed(_decimal_text(*low, count, layout, mark), count, complete=count == digits)
    power = _exponent(max(-lower, upper)) + 1 if lower <= 0 <= upper else 0
    return Printed(f"{ZERO_WITHIN}1e{power}" if power <= -digits else NOT_CERTIFIED, 0, complete=False)


def numbers(value: Any) -> Iterator[Real]:
    """Yield the balls and rationals in a nested structure of dictionaries, lists and tuples; skip other items."""
    if isinstance(value, arb | fmpq):
        yield value
    elif isinstance(value, dict):
        for item in value.values():
            yield from numbers(item)
    elif isinstance(value, list | tuple):
        for item in value:
            yield from numbers(item)


def _refined(function: Callable[[], Any], bits: int, enough: Callable[[Any], bool], spare: int = SPARE_BITS) -> Any:
    """Return function() at a precision at which ``enough`` of the result holds, doubled from bits + 64 (Ziv).

    Beyond 4 bits + spare the last result is returned, whether enough or not.
    """
    precision = bits + 64
    while True:
        with workprec(precision):
            value = function()
        if precision > 4 * bits + spare or enough(value):
            return value
        precision *= 2


def _mapped(value: Any, change: Callable[[Real], Any]) -> Any:
    """Return a copy of a nested dictionary, list or tuple with ``change`` applied to each ball or rational in it.

    Other items are unchanged.
    """
    if isinstance(value, arb | fmpq):
        return change(value)
    if isinstance(value, dict):
        return {name: _mapped(item, change) for name, item in value.items()}
    if isinstance(value, list | tuple):
        return type(value)(_mapped(item, change) for item in value)
    return value


def _check(digits: int, layout: str) -> None:
    if layout not in LAYOUTS:
        raise AtlasError(f"There is no layout {layout!r} of a number; the layouts are {', '.join(LAYOUTS)}.")
    if digits < (layout != "fixed"):
        raise AtlasError(f"A number has at least one digit, not {digits}.")


def _ends(value: Real) -> tuple[fmpq, fmpq]:
    """Return the lower and the upper end of a ball as exact rationals; for a rational the number twice."""
    if isinstance(value, fmpq):
        return value, value
    middle, radius = value.mid().fmpq(), value.rad().fmpq()
    return middle - radius, middle + radius


def _max_digits(lower: fmpq, upper: fmpq, digits: int) -> int:
    """Return an upper bound, at most ``digits``, on the number of digits that both ends share.

    It is ``digits`` for equal ends, else 0 if zero lies between them.
    """
    if lower == upper:
        return digits
    if lower <= 0 <= upper:
        return 0
    return min(digits, _exponent(max(abs(lower), abs(upper))) - _exponent(upper - lower) + 1)


def _exponent(x: fmpq) -> int:
    """Return the e with 10^e <= x < 10^(e+1), for x > 0."""
    e = int((int(x.p).bit_length() - int(x.q).bit_length()) / BITS_A_DIGIT) - 1
    power = fmpq(10) ** (e + 1)
    while x >= power:
        e, power = e + 1, power * 10
    while x * 10 < power:
        e, power = e - 1, power / 10
    return e


def _rounded(x: fmpq, count: int) -> tuple[int, int]:
    """Return (m, e) with m of ``count`` digits and x = m 10^(e+1-count) to half a unit, half to even; (0, 0) for 0."""
    if x == 0:
        return 0, 0
    e = _exponent(abs(x))
    m = round(x * fmpq(10) ** (count - 1 - e))
    return (m, e) if abs(m) < 10**count else (m // 10, e + 1)


def _fixed(lower: fmpq, upper: fmpq, decimals: int) -> Printed:
    """Return a number between two bounds as `Printed` with ``decimals`` proven decimals, or fewer and a mark.

    The text is `NOT_CERTIFIED` where the bounds do not round to the same integer.
    """
    for count in range(decimals, -1, -1):
        low, high = round(lower * 10**count), round(upper * 10**count)
        if low == high:
            integer_part, fraction = divmod(abs(int(low)), 10**count)
            text = f"{'-' * (low < 0)}{integer_part}" + (f".{fraction:0{count}d}" if count else "")
            return Printed(text + MARK * (count < decimals), count, complete=count == decimals)
    return Printed(NOT_CERTIFIED, 0, complete=False)


def _decimal_text(m: int, e: int, count: int, layout: Layout, mark: str) -> str:
    """Return the text of m 10^(e+1-count), where the integer m has ``count`` digits, with ``mark`` behind the digits.

    It is in scientific notation for the layout "scientific", for numbers below 1e-5, and for those with more than
    ``count`` digits before the point.
    """
    sign, text = "-" * (m < 0), str(abs(m))
    if layout != "scientific" and -5 <= e < count:
        text = "0" * -e + text
        point = max(e, 0) + 1
        return sign + text[:point] + ("." + text[point:] if text[point:] else "") + mark
    mantissa = sign + text[0] + ("." + text[1:] if count > 1 else "")
    return (f"{mantissa} \\times 10^{{{e}}}" if layout == "tex" else f"{mantissa}e{e:+03d}") + mark
