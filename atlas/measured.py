"""Numbers with a unit, at the shell 1.2um, 0.8T, 5000e, 1850kg/m3, 2MHz, 30deg, in a heading t [ms]; they are in SI.

Not by pint: it takes 0.8 s to load, thrice the whole command, knows neither m3 nor turns in Hz, and has a rounded pi.
"""

import math
import re
from collections import Counter
from fractions import Fraction
from functools import cache

from atlas.errors import AtlasError

PREFIXES = {"f": -15, "p": -12, "n": -9, "u": -6, "µ": -6, "μ": -6, "m": -3, "c": -2, "k": 3, "M": 6, "G": 9}
UNITS: dict[str, tuple[str, str]] = {
    "m": ("1", "m"), "g": ("1e-3", "kg"), "u": ("1.66053906892e-27", "kg"),
    "s": ("1", "s"), "min": ("60", "s"), "h": ("3600", "s"), "Hz": ("1", "s-1 turn"),
    "rpm": ("1/60", "s-1 turn"), "rev": ("1", "turn"),
    "C": ("1", "C"), "e": ("1.602176634e-19", "C"), "A": ("1", "C s-1"), "V": ("1", "kg m2 s-2 C-1"),
    "T": ("1", "kg s-1 C-1"), "G": ("1e-4", "kg s-1 C-1"), "N": ("1", "kg m s-2"), "J": ("1", "kg m2 s-2"),
    "rad": ("1", ""), "deg": ("1", "degree"),
}  # fmt: skip
"""Units by name: how many of those after it they are. A turn is 2 pi, a degree pi/180."""

ANGLES = {"turn": 2 * math.pi, "degree": math.pi / 180}
RATE = "rad/s"
WANTED: dict[str, str | tuple[str, ...]] = {
    **dict.fromkeys(("field", "omega", "omega2", "omega3", "spin", "larmor"), RATE),
    "radius": "m", "height": "m", "equatorial": "m", "polar": "m", "position": "m", "velocity": "m/s", "mass": "kg",
    "charge": "C", "mu": "C/kg", "magnetic": "T", "electric": "V/m", "momentum": "kg m2/s", "times": "s", "grid": "s",
    "predict": "s", "epoch": "s",
    "inertia": "kg m2", "tensor": "kg m2", "density": "kg/m3", "angle": "rad", "sigma": "rad", "heavy": ("m/s2", "m"),
    "coupling": "kg m2/s", "linear": "J", "quadratic": "J", "charged": "C m2", "moment": "A m2",
    "polarizability": "A m2/T",
}  # fmt: skip
"""The unit of SI in which an option is, by its name; of each of its numbers, where they are not alike."""

FACTOR = re.compile(r"([*/ ]?)([^\W\d]+)(?:(?:\^|\*\*)?(-?\d))?")
NUMBER = re.compile(
    r"([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?(?:/\d+)?)"
    r"(?![eE][+-]?\d|[xX][\da-fA-F])([*/ ]?[^\W\d_].*)"
)


def split(text: str) -> tuple[str, str] | None:
    """Return the number and the unit of a word such as "1.2um", as texts; None without a unit, as in 1e-3 and 0x1p0."""
    match = NUMBER.fullmatch(text)
    return (match[1], match[2]) if match else None


def in_si(number: Fraction, unit: str, option: str, place: int = 0) -> tuple[float, Fraction | None]:
    """Return `number` units in the SI unit of a command-line option, as a float, and exactly (None if pi is a factor).

    `unit` is a text such as "um"; `option` the option's name without dashes; `place` the index of the number among
    those of the option. Raises AtlasError for an unknown unit, or one of another dimension.
    """
    factor, powers = _parsed(unit)
    option = "omega" if option == "sigma" and powers["s"] else option  # a standard error of rates
    units = WANTED.get(option, ())
    expected_units = (units,) if isinstance(units, str) else units
    expected_powers = _parsed(expected_units[min(place, len(expected_units) - 1)])[1] if expected_units else None
    angle = {name: powers.pop(name) for name in ANGLES if powers.get(name)}
    allowed = {"turn": WANTED.get(option) == RATE or option == "times", "degree": option in ("angle", *WANTED)}
    if powers != expected_powers or not all(allowed[name] for name in angle):
        expectation = (
            f"--{option} is in {' and '.join(expected_units)}" if expected_units else f"--{option} has no unit"
        )
        alike = (name for name, units in WANTED.items() if isinstance(units, str) and _parsed(units)[1] == powers)
        alternative = next(alike, None)
        hint = f"; --{alternative} takes {unit.strip()!r}" if alternative and not angle else ""
        raise AtlasError(f"{expectation}, or a unit that converts to it, not in {unit.strip()!r}{hint}.")
    value = number * factor
    exact = float(value)
    for name, power in angle.items():
        exact *= ANGLES[name] ** power
    return exact, None if angle else value


def in_unit(number: Fraction, unit: str, target: str) -> float:
    """Return `number` times `unit` expressed in the unit `target`, both texts such as "km/h"; angles may be left out.

    Raises AtlasError for an unknown unit, or one of another dimension.
    """
    (factor, powers), (size, target_powers) = _parsed(unit), _parsed(target)
    value = number * factor / size
    angles = {name: powers.pop(name, 0) - target_powers.pop(name, 0) for name in ANGLES}
    if powers != target_powers:
        raise AtlasError(f"the unit is {target or 'none'}, or a unit that converts to it, not {unit.strip()!r}.")
    return math.prod((ANGLES[name] ** power for name, power in angles.items() if power), start=float(value))


def heading(cell: str) -> tuple[str, str]:
    """Return (name, unit) of a column's heading: ("t", "s") for "t [s]" and "t (s)"; the unit is "" if there is none.

    A degree sign becomes "deg".
    """
    name, _, unit = cell.replace("(", "[").partition("[")
    return name.strip(" \t\"'\N{NO-BREAK SPACE}"), unit.strip(" \"')]").replace("\N{DEGREE SIGN}", "deg")


@cache
def size(unit: str, option: str) -> Fraction | float:
    """Return the factor from `unit` to the SI unit of a command-line option: a Fraction, or a float if pi is in it.

    Raises AtlasError for an unknown unit, or one of another dimension.
    """
    value, exact = in_si(Fraction(1), unit.removeprefix("1"), option)
    return value if exact is None else exact


def is_unit(text: str) -> bool:
    """Return whether a text is a known unit, such as "deg/s"; False for the empty text."""
    try:
        return bool(text) and bool(_parsed(text))
    except AtlasError:
        return False


def _parsed(unit: str) -> tuple[Fraction, Counter[str]]:
    """Return a unit as (factor to SI, powers by name of base unit, "turn" and "degree" included), zero powers left out.

    Raises AtlasError for an unknown unit.
    """
    factor, powers, place = Fraction(1), Counter[str](), 0
    while place < len(unit):
        factor_of_unit = FACTOR.match(unit, place)
        if factor_of_unit is None:
            raise AtlasError(f"there is no unit {unit.strip()!r}; write 1.2um, 0.8T, 5000e, 1850kg/m3, 2MHz or 30deg.")
        power = int(factor_of_unit[3] or 1) * (-1 if factor_of_unit[1] == "/" else 1)
        size, base = _unit(factor_of_unit[2], unit)
        factor *= size**power
        for name, count in base.items():
            powers[name] += count * power
        place = factor_of_unit.end()
    return factor, Counter({name: count for name, count in powers.items() if count})


def _unit(name: str, text: str) -> tuple[Fraction, dict[str, int]]:
    for prefix, symbol in (("", name), (name[:1], name[1:])):
        if symbol in UNITS and (not prefix or prefix in PREFIXES):
            size, base = UNITS[symbol]
            powers = {
                power.rstrip("-123456789"): int(power.lstrip("abcdefghijklmnopqrstuvwxyzCT") or 1)
                for power in base.split()
            }
            return Fraction(size) * Fraction(10) ** PREFIXES.get(prefix, 0), powers
    raise AtlasError(f"there is no unit {name!r} in {text.strip()!r}; known: {', '.join(UNITS)}, with prefixes.")
