"""The nearest body to typed moments that no body has, by less than a unit of their last digits."""

import math
from collections.abc import Sequence
from fractions import Fraction
from typing import Any

import click

from atlas.cli.typed import Typed
from atlas.measured import split

SINGLE = 3e-7
"""Part of the largest number up to which digits beyond single precision are no digits."""

LARGEST = 0.02
"""Part of the largest moment beyond which it is not a matter of digits that there is no body."""

ROUNDED = 1e-6
"""Relative excess of a tensor over those of bodies, above which rounding does not explain it."""


def nearest_moments(_: click.Context, param: click.Parameter, value: Any) -> Any:
    """Return typed moments (I2, I3) or (I1, I2, I3), or a ratio, moved to those of a plane body if they exceed these.

    Moments exceed them if the largest is above the sum of the others, I3 above 2 I2, or the ratio above 2. A
    callback of click's option `param`. They are moved only if each moves by less than the unit of its last digit,
    in proportion to it, and a line on standard error says so; otherwise they are returned unchanged, and refused
    later. None is returned as it is.
    """
    if value is None:
        return None
    numbers = value if isinstance(value, tuple) else (value,)
    sizes = [_exact(x) for x in numbers]
    if min(sizes) <= 0:
        return value
    factors = [1 if x < max(sizes) else -1 for x in sizes] if len(numbers) == 3 else [2, -1][-len(numbers) :]
    beyond = -sum((c * x for c, x in zip(factors, sizes, strict=True)), Fraction()) - (2 if len(numbers) == 1 else 0)
    units = [max(_unit(x), Fraction(SINGLE) * max(sizes)) for x in numbers]
    reach = sum((abs(c) * u for c, u in zip(factors, units, strict=True)), Fraction())
    if not 0 < beyond < min(reach, Fraction(LARGEST) * max(sizes)):
        return value
    shift = beyond / reach
    moved_sizes = [x + (u if c > 0 else -u) * shift for c, x, u in zip(factors, sizes, units, strict=True)]
    doubles = [float(x) for x in moved_sizes]
    largest_place = factors.index(-1)
    limit = sum(Fraction(x) * c for x, c in zip(doubles, factors, strict=True) if c > 0) or Fraction(2)
    while Fraction(doubles[largest_place]) > limit:
        doubles[largest_place] = math.nextafter(doubles[largest_place], 0.0)
    new = tuple(_with_value(x, d, f) for x, d, f in zip(numbers, doubles, moved_sizes, strict=True))
    _tell(
        param,
        numbers,
        new,
        "no body has such moments",
        "the plane body next to them" if len(numbers) > 1 else "the largest",
    )
    return new if isinstance(value, tuple) else new[0]


def nearest_tensor(_: click.Context, param: click.Parameter, value: Any) -> Any:
    """Return a typed tensor I11 I22 I33 I12 I13 I23, moved to that of a plane body if just beyond it.

    Beyond it the largest principal moment exceeds the sum of the others. A callback of click's option `param`. The
    tensor is moved only if each number changes by less than the unit of its last digit; None and other tensors are
    returned unchanged. Raises click.UsageError for a tensor of no body that another order or sign of the numbers
    makes that of a body.
    """
    if value is None:
        return None
    import numpy as np

    spread, axes = _principal_spread(value)
    beyond = -spread[0] * (1 + 1e-9)
    change = beyond * (np.eye(3) - np.outer(axes[:, 0], axes[:, 0]))
    moves = [change[i, j] for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))]
    size = max(abs(float(x)) for x in value)
    units = [max(float(_unit(x)), SINGLE * size) for x in value]
    is_near = all(abs(move) < unit for move, unit in zip(moves, units, strict=True))
    if not (1e-14 * size < beyond < LARGEST * size and is_near):
        if beyond > ROUNDED * size:
            _ask_for_order(param, value)
        return value
    new = tuple(_with_value(x, float(x) + move, None) for x, move in zip(value, moves, strict=True))
    _tell(param, value, new, "no body has such a tensor", "the plane body next to it")
    return new


def _principal_spread(numbers: Sequence[float]) -> tuple[Any, Any]:
    """Return principal values (3,), ascending, and axes (3, 3), in columns, of the mass matrix sum m x x^T, (8).

    `numbers` are those of the inertia tensor, I11 I22 I33 I12 I13 I23.
    """
    import numpy as np

    a, b, c, d, e, f = map(float, numbers)
    tensor = np.array([[a, d, e], [d, b, f], [e, f, c]])
    return np.linalg.eigh(np.trace(tensor) / 2 * np.eye(3) - tensor)


def _ask_for_order(param: click.Parameter, value: Sequence[Typed]) -> None:
    """Raise click.UsageError if a tensor of no body is that of a body in URDF's order or with products reversed.

    `value` are six typed numbers of the option `param`. The message has the words to type.
    """
    a, b, c, d, e, f = value
    urdf, solidworks = "the order of URDF, ixx ixy ixz iyy iyz izz", "products +sum m x y, as SolidWorks has"
    readings = (
        (urdf, (a, d, f, b, c, e), 1),
        (solidworks, (a, b, c, d, e, f), -1),
        (f"{urdf}, with {solidworks}", (a, d, f, b, c, e), -1),
    )
    for reading, numbers, sign in readings:
        if _principal_spread([*numbers[:3], *(sign * x for x in numbers[3:])])[0][0] > 0:
            texts = [x.text for x in numbers[:3]] + [_signed(x.text, sign) for x in numbers[3:]]
            raise click.UsageError(
                f"--{param.name} {' '.join(x.text for x in value)}: no body has this tensor I11 I22 I33 I12 I13 I23; "
                f"did you mean {reading}? Then type --{param.name} {' '.join(texts)}"
            )


def _signed(text: str, sign: int) -> str:
    """Return a typed number as text, with its sign reversed for a negative `sign`."""
    if sign > 0:
        return text
    return text[1:] if text.startswith("-") else f"-{text.removeprefix('+')}"


def _exact(x: Typed) -> Fraction:
    """Return a typed number in SI as a fraction: exact, except if it involves pi or a standard deviation."""
    return Fraction(float(x)) if x.sigma or (x.unit and x.exact is None) else x.exactly()


def _unit(x: Typed) -> Fraction:
    """Return the unit of the last digit that was typed, in SI.

    0 for a fraction, a hexadecimal number, a zero, and a number with a standard deviation.
    """
    text = (split(x.text) or (x.text, ""))[0].lower()
    digits, _, exponent = text.partition("e")
    if x.sigma or not digits.lstrip("+-").replace(".", "", 1).isdecimal() or not float(digits):
        return Fraction(0)
    unit = Fraction(10) ** (int(exponent or 0) - len(digits.partition(".")[2]))
    return unit * _exact(x) / Fraction(text)


def _with_value(x: Typed, value: float, exact: Fraction | None) -> Typed:
    """Return a typed number with the value `value` and no unit.

    Its text is the fraction `exact`, or of the float if None.
    """
    exact = Fraction(value) if exact is None else exact
    return x.with_value(value, text=f"{exact.numerator}/{exact.denominator}", unit="")


def _tell(param: click.Parameter, numbers: Sequence[Typed], new: Sequence[Typed], fault: str, remedy: str) -> None:
    """Print on standard error that the numbers `new` are used in the place of the typed ``numbers`` of an option.

    ``fault`` says why the typed ones are none, ``remedy`` what is taken instead, both as clauses.
    """
    was, text = " ".join(x.text for x in numbers), " ".join(f"{float(x):.10g}" for x in new)
    click.echo(f"atlas: --{param.name} {was}: {fault}, by the last digits; used instead is {remedy}, {text}", err=True)
