"""The words of captions: numbers, vectors and bodies as text, with TeX for captions and without it for alt texts."""

import re
from collections.abc import Iterable, Sequence
from typing import Any

from atlas.bodies.body import moments, shape_name

DIGITS = 6
MINUS = "\N{MINUS SIGN}"


def tex(value: float) -> str:
    r"""Return a number as TeX with at most six digits, such as "-0.5" or r"1.5 \times 10^{-7}"."""
    mantissa, _, exponent = f"{value + 0.0:.{DIGITS}g}".partition("e")
    if not exponent:
        return mantissa
    power = f"10^{{{int(exponent)}}}"
    return power if mantissa == "1" else rf"{mantissa} \times {power}"


def tex_equals(value: float) -> str:
    r"""Return "=" or r"\approx" and the number by `tex`: r"=0.5", or r"\approx 0.658824" if six digits are too few."""
    return f"={tex(value)}" if float(f"{value:.{DIGITS}g}") == value else rf"\approx {tex(value)}"


def spelt(count: float) -> str:
    """Return a number of periods as text: "one period" for 1, else with digits, such as "2 periods" or "2.5 periods".

    There are at most six digits, as in `plain`.
    """
    return "one period" if count == 1.0 else f"{plain(count)} periods"


def plain(value: float) -> str:
    """Return a number as plain text with at most six digits and a true minus sign."""
    return f"{value + 0.0:.{DIGITS}g}".replace("-", MINUS)


def tex_vector(components: Iterable[float]) -> str:
    """Return the components as TeX in brackets, such as "(0, 1, -2)"."""
    return "(" + ", ".join(map(tex, components)) + ")"


def plain_vector(components: Iterable[float]) -> str:
    """Return the components as plain text in brackets, such as "(0, 1, 2)", each as `plain` writes it."""
    return "(" + ", ".join(map(plain, components)) + ")"


def listed(items: Sequence[str], conjunction: str = "and") -> str:
    """Return one or more items as one text: "a", "a and b", "a, b and c", with another `conjunction` if given."""
    return items[0] if len(items) == 1 else f"{', '.join(items[:-1])} {conjunction} {items[-1]}"


def quotient(ratio: Any) -> float:
    """Return I = I3/I2, (33), of a number (which is I itself) or a body, as a float rounded from the exact quotient."""
    I2, I3 = moments(ratio)
    return float(I3 / I2)


def body_role(ratio: Any) -> str:
    """Return the role of a body's layers where bodies are compared, by its ratio I, a number or that of a body.

    It is "loop_body" for I3 = 2 I2, "ball_body" for I3 = I2, else "short_body" (I3 > I2) or "long_body"; the
    comparison is exact.
    """
    I2, I3 = moments(ratio)
    if I3 == 2 * I2:
        return "loop_body"
    if I3 == I2:
        return "ball_body"
    return "short_body" if I3 > I2 else "long_body"


def body_name(ratio: Any) -> str:
    """Return a body's shape in words, such as "spheroid"; "body" for a number I = I3/I2 and for given moments."""
    return shape_name(ratio).replace("_", " ") or "body"


def with_body_name(text: str, name: str) -> str:
    """Return a caption or alternative text with a body's name, such as "disk", in the place of the word "body".

    Only the words of `tex_setting` and `plain_setting` change: "a body with I = 2" becomes "a disk with I = 2".
    """
    return re.sub(r"\bbody(?= with (\$I=|I = ))", name, text)


def tex_setting(ratio: Any, field: Sequence[float], *, article: str = "a") -> str:
    """Return TeX such as 'a disk with I = 2 in the field B' = (0, 1, 2)' for a caption, from field = (B2, B3).

    `ratio` is I = I3/I2 or a body; see `body_name`. Without a field the text is 'a free disk with I = 2'. ``article``
    is the first word, 'A' at a sentence's beginning.
    """
    body = f"{body_name(ratio)} with $I={tex(quotient(ratio))}$"
    if not any(field):
        return f"{article} free {body}"
    return rf"{article} {body} in the field $\mathbf{{B}}'={tex_vector((0.0, *field))}$"


def plain_setting(ratio: Any, field: Sequence[float]) -> str:
    """Return "a disk with I = 2 in the field B' = (0, 1, 2)", for an alternative text, from field = (B2, B3).

    `ratio` is I = I3/I2 or a body. Without a field the text is "a free disk with I = 2".
    """
    body = f"{body_name(ratio)} with I = {plain(quotient(ratio))}"
    return f"a {body} in the field B' = {plain_vector((0.0, *field))}" if any(field) else f"a free {body}"


def lasting(time: float, unit: str) -> str:
    """Return a time with its unit for a caption: '2.21 s', or '2.21 units of time' for the unit "time".

    It has three digits; an exponent is written in TeX.
    """
    number = f"{time:.3g}"
    return f"{f'${tex(float(number))}$' if 'e' in number else number} {'units of time' if unit == 'time' else unit}"
