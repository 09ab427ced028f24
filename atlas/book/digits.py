"""Numbers in print: a string of proven digits cut at its decimal point, so that a column can be aligned on it."""

import re
from dataclasses import dataclass
from decimal import Decimal
from typing import Any

MINUS = "\N{MINUS SIGN}"
THIN = "\N{NARROW NO-BREAK SPACE}"


@dataclass(frozen=True)
class Number:
    """A number as its proven digits, "" if there are none; `proven` says that all requested digits are proven.

    `digits` is ASCII text such as ``-1.25e-7``, or with a standard deviation in its last digits ``-1.25(17)e-7``.
    """

    digits: str
    proven: bool = True

    @classmethod
    def as_given(cls, value: float) -> "Number":
        """Return the `Number` with the shortest digits that read back as the float."""
        return cls(plain(value))

    def parts(self) -> tuple[str, str, str]:
        """Return three texts: the integer part, the point with the fraction, the exponent of the power of ten.

        The last two are "" if there is no fraction, no power. The digits after the point are grouped in threes if
        there are more than four; "?" for the first means that no digit is proven.
        """
        if not self.digits:
            return "?", "", ""
        mantissa, _, power = self.digits.lower().partition("e")
        integer, point, fraction = mantissa.replace("-", MINUS).partition(".")
        step = 3 if len(fraction) > 4 else 4
        grouped = THIN.join(fraction[i : i + step] for i in range(0, len(fraction), step))
        return integer, point + grouped, str(int(power)).replace("-", MINUS) if int(power or 0) else ""

    def words(self) -> str:
        """Return the number as Markdown for a sentence: "?" without digits, "1.2×10^5^" if far from 1, else a decimal.

        Far from 1 is an exponent beyond -3 to 3, or any exponent with a standard deviation.
        """
        mantissa, _, power = self.digits.lower().partition("e")
        if not self.digits:
            return "?"
        if not power:
            return mantissa.replace("-", MINUS)
        if -4 < int(power) < 4 and "(" not in mantissa:
            return format(Decimal(self.digits), "f").replace("-", MINUS)
        return f"{mantissa}\N{MULTIPLICATION SIGN}10^{int(power)}^".replace("-", MINUS)

    def tex(self) -> str:
        """Return the number as TeX between dollars, with a power of ten if it has one; "?" without digits."""
        mantissa, _, power = self.digits.lower().partition("e")
        mantissa = mantissa or "?"
        return f"${mantissa}$" if not int(power or 0) else rf"${mantissa}\times 10^{{{int(power)}}}$"


def room(text: str) -> float:
    """Return the width of a number's text in widths of a digit; points and thin spaces count 0.5, minus signs 1.4."""
    return sum({".": 0.5, THIN: 0.5, MINUS: 1.4}.get(character, 1.0) for character in text)


def significant(text: str) -> int:
    """Return the number of significant digits in the text of a number, such as 3 for "-0.0120e5"."""
    return len(re.sub(r"e.*|[-.]", "", text).lstrip("0"))


def plain(value: float) -> str:
    """Return the shortest digits that read back as the float, in ASCII."""
    return repr(float(value)).removesuffix(".0")


def markdown_of(value: Any) -> str:
    """Return an input as Markdown: floats with minus signs and powers of ten, vectors in brackets, others by `str`."""
    if isinstance(value, tuple | list):
        return f"({', '.join(markdown_of(component) for component in value)})"
    if isinstance(value, bool) or not isinstance(value, float | int):
        return str(value)
    mantissa, _, power = plain(value).partition("e")
    raised = f"\N{MULTIPLICATION SIGN}10^{int(power)}^".replace("-", MINUS) if power else ""
    return mantissa.replace("-", MINUS) + raised


def spaced(number: str) -> str:
    """Return a typed number as read in a title: "1.2 µm" for "1.2um", "30°" for "30deg"."""
    text = re.sub(r"^([-+.\d()]+(?:e[-+]?\d+)?+)(?=[a-zA-Z])", r"\1 ", number)
    return re.sub(" deg$", "\N{DEGREE SIGN}", re.sub(" u(?=[a-zA-Z])", " \N{MICRO SIGN}", text))
