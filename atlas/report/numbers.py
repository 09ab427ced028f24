"""Numbers in print: a string of proven digits cut at its decimal point, so that a column can be aligned on it."""

from dataclasses import dataclass
from typing import Any

MINUS = "\N{MINUS SIGN}"
THIN = "\N{NARROW NO-BREAK SPACE}"


@dataclass(frozen=True)
class Number:
    """A number as digits, such as ``-1.25e-7``, and whether each of them is proven."""

    digits: str
    proven: bool = True

    def parts(self) -> tuple[str, str, str]:
        """Return what stands before the point, the point and what follows, and the power of ten.

        The digits after the point are grouped in threes where there are more than four.
        """
        mantissa, _, power = self.digits.lower().partition("e")
        whole, point, fraction = mantissa.replace("-", MINUS).partition(".")
        step = 3 if len(fraction) > 4 else 4
        grouped = THIN.join(fraction[i : i + step] for i in range(0, len(fraction), step))
        return whole, point + grouped, str(int(power)).replace("-", MINUS) if power else ""

    def tex(self) -> str:
        """Return the number as a formula."""
        mantissa, _, power = self.digits.lower().partition("e")
        return f"${mantissa}$" if not power else rf"${mantissa}\times 10^{{{int(power)}}}$"


def room(text: str, thin: float = 0.5) -> float:
    """Return the width of digits, points, spaces and minus signs in widths of a digit, as in STIXGeneral.

    That face has no narrow space: `thin` is the width of what stands for it, at most a half in a browser.
    """
    return sum({".": 0.5, THIN: thin, MINUS: 1.37}.get(character, 1.0) for character in text)


def plain(value: float) -> str:
    """Write an input as it was given, in ASCII: the shortest digits that read back the same."""
    return repr(float(value)).removesuffix(".0")


def shown(value: Any) -> str:
    """Write an input for a line of small print, in Markdown: with a true minus sign, and a power of ten as such."""
    if isinstance(value, tuple | list):
        return f"({', '.join(shown(part) for part in value)})"
    if isinstance(value, bool) or not isinstance(value, float | int):
        return str(value)
    mantissa, _, power = plain(value).partition("e")
    raised = f"\N{MULTIPLICATION SIGN}10^{int(power)}^".replace("-", MINUS) if power else ""
    return mantissa.replace("-", MINUS) + raised
