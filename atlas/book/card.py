"""The card of a body: six numbers with their digits, or the reason why there is none."""

import math
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from atlas.arithmetic.certified_digits import MARK
from atlas.book.digits import significant
from atlas.book.parts import ReportRequest, case_of
from atlas.book.tables.properties import FamilyObject
from atlas.book.tables.table import Request, certified, quantity
from atlas.errors import AtlasError, DomainError
from atlas.motions.register import FAMILIES, Family


@dataclass(frozen=True)
class Entry:
    """A number of the card: its key, meaning in words, letter in TeX, unit of the register ("" for a pure number).

    `equation` is the entry of the ledger that it is computed by, or "".
    """

    key: str
    says: str
    letter: str
    unit: str
    equation: str


ENTRIES = (
    Entry("ratio", "ratio of the moments", "$I=I_3/I_2$", "", "(33)"),
    Entry("larmor", "field as a rate", r"$|\mathbf{B}'|$", "1/time", "(27)"),
    Entry("tilt", "angle between axis and B\N{PRIME} at the start", r"$\theta_0$", "rad", ""),
    Entry("turn", "time of one turn about the field", "$T$", "time", "(79)"),
    Entry("spin", "rate about the body's axis", r"$\phi$", "1/time", "(72)"),
    Entry(
        "nutation", "period of nutation, or of the angular velocity in the body", "$T_n$", "time", "theorem-stability"
    ),
    Entry("f1", "first frequency of the torus", "$f_1$", "1/time", ""),
    Entry("f2", "second frequency of the torus", "$f_2$", "1/time", ""),
    Entry("f3", "frequency about the field", "$f_3$", "1/time", ""),
)
"""The numbers of the card, the same for every body."""
FREQUENCIES = ("f1", "f2", "f3")
"""Keys of the three frequencies of a torus, in whose place other motions have a period and two rates."""
NO_FIELD, NO_START, THREE = "there is no field", "no start was given", "the body has three moments"
ONE_PERIOD = "it has one period and two rates"
"""Why most motions have no frequencies of a torus."""


def has_card(family: Family) -> bool:
    """Return whether objects of a family are bodies with an axis, in a field or free: not a particle, nor a flight."""
    return any(p.name == "ratio" or (p.name == "inertia" and p.columns) for p in family.parameters)


def numbers(family: Family, arguments: Mapping[str, Any]) -> dict[str, float]:
    """Return the numbers of the card that this motion has, in doubles, by key; `arguments` are the family's inputs.

    Rates are in rad/time, times in time, angles in rad. A number that the motion does not have is left out.
    """
    motion = family.kernels()(*arguments.values())
    values = {entry.key: _in_doubles(entry.key, family, motion, arguments)[0] for entry in ENTRIES}
    return {key: value for key, value in values.items() if value is not None}


def _in_doubles(key: str, family: Family, motion: Any, arguments: Mapping[str, Any]) -> tuple[float | None, str]:
    """Return (value, "") of the card's number `key`, or (None, reason in words why there is none).

    `key` is one of `ENTRIES`, unchecked. The value is computed in doubles, in rad, time or rad/time; `arguments`
    are the family's inputs by name. `motion` is the object in doubles. The reason is that of a DomainError, or of a
    division by zero or an overflow; other errors are raised.
    """
    try:
        value = float(_number(key, family, motion, arguments, math))
    except DomainError as reason:
        return None, str(reason).rstrip(".")
    except ZeroDivisionError:
        return None, "the axis does not go round"
    except OverflowError:
        return None, "it is beyond the largest double"
    return (value, "") if math.isfinite(value) else (None, "the motion has no period")


def _number(key: str, family: Family, motion: Any, arguments: Mapping[str, Any], functions: Any) -> Any:
    """Return the card's number `key` from a motion, in doubles if `functions` is `math`, in balls if it is `Balls`.

    `arguments` are the family's inputs by name. Raises DomainError, with the reason, where the motion has no such
    number.
    """
    if not has_card(family):
        raise DomainError(f"it has the numbers of a body with an axis, and this is the {family.says}")
    if key == "ratio":
        return _ratio(arguments)
    if key in {"larmor", "tilt"}:
        return _of_field(key, arguments, functions)
    if key in FREQUENCIES:
        return _frequency(FREQUENCIES.index(key), family, motion, arguments)
    if not family.sampled:
        raise DomainError(NO_START)
    if key == "nutation":
        return _nutation(family, motion, functions)
    return _turn(key, family, motion, arguments, functions)


def _turn(key: str, family: Family, motion: Any, arguments: Mapping[str, Any], functions: Any) -> Any:
    """Return the rate about the body's axis in rad/time for the key "spin", the time of one turn for "turn".

    The rate has a sign, the time is positive; the turn is that of the axis about the field. `arguments` are the
    family's inputs by name, `functions` is `math` or `Balls`. Raises DomainError for "turn" where the axis does not
    go round. `motion` is the object in doubles or in balls.
    """
    if (rate := _spin_of_free_body(arguments)) is not None:
        if key == "spin":
            return rate
        raise DomainError("the axis does not go round")
    if _is_steady(motion, arguments):  # which has rates also where it has no period, as it is not stable
        family = FAMILIES["elementary"]
        steady = family.kernels() if functions is math else family.balls()
        motion = steady(arguments["ratio"], arguments["field"], arguments["omega"][1])
    names = ("precession_rate", "spin_rate") if family.quantity("precession_rate") else ("k", "phi")
    rate = getattr(motion, names[key == "spin"])
    if key == "spin":
        return rate
    if rate == 0:
        raise DomainError("the axis does not go round")
    return 2 * functions.pi / abs(rate)


def _spin_of_free_body(arguments: Mapping[str, Any]) -> Any:
    """Return the rate, in rad/time, of a free body's spin about its symmetry axis or a principal axis; else None.

    The rate is the only component of its angular velocity that is not 0. None also for a body at rest, in a field, or
    without a start. `arguments` are the family's inputs by name.
    """
    omega = arguments.get("omega")
    if omega is None or any(arguments.get("field", (1.0,))):
        return None
    moving = [rate for rate in omega if rate]
    return moving[0] if len(moving) == 1 and (omega[2] or "ratio" not in arguments) else None


def _is_steady(motion: Any, arguments: Mapping[str, Any]) -> bool:
    """Return whether a start by all three rates is an elementary motion whose omega3 follows from omega2 by (67).

    `arguments` are the family's inputs by name; False for other inputs, where B2 = 0, and at the pole omega2 = -B2.
    """
    if not {"ratio", "omega"} <= arguments.keys() or motion.kind != "precession":
        return False
    return bool(arguments["field"][0]) and arguments["omega"][1] != -arguments["field"][0]


def _of_field(key: str, arguments: Mapping[str, Any], functions: Any) -> Any:
    """Return |B'| in rad/time, or for the key "tilt" the angle in [0, pi] rad between field and axis at t = 0.

    Of a top the field's direction counts for the angle. `functions` is `math` or `Balls`. Raises DomainError
    without a field, and for |B'| of a top. `arguments` are the family's inputs by name.
    """
    *transverse, axial = map(Fraction, arguments.get("field") or arguments.get("direction") or (0.0,))
    if not any((*transverse, axial)):
        raise DomainError(NO_FIELD)
    if key == "tilt":
        return functions.atan2(functions.sqrt(sum(x * x for x in transverse)), axial)
    if "field" not in arguments:
        raise DomainError("a top has its weight and coupling in the place of a field")
    return functions.sqrt(sum(x * x for x in (*transverse, axial)))


def _words(entry: Entry, centre: str, motion: Any) -> str:
    """Return the words of an entry, "the field" replaced by `centre`, the direction about which the axis precesses.

    For a free body of three moments "body's axis" becomes the axis of the motion's mode, "long axis" or "short
    axis". `motion` is the object in doubles.
    """
    says = entry.says.replace("the field", centre)
    if centre == "the vertical":
        says = says.replace("B\N{PRIME}", centre)
    with suppress(AtlasError, AttributeError):
        says = says.replace("body's axis", f"body's {motion.mode}" if "axis" in motion.mode else "body's axis")
    return says


def _pole(key: str, arguments: Mapping[str, Any]) -> str:
    """Return a clause for "turn" and "spin" of motions whose axis passes through the field's direction, "" for others.

    It says that the rate is the mean of those on both sides of the pole. `arguments` are the family's inputs by name.
    """
    *transverse, axial = arguments.get("field") or arguments.get("direction") or (0.0,)
    W1, W2, *_ = arguments.get("omega") or (0.0, 0.0)
    symmetric = "ratio" in arguments or "direction" in arguments
    through = key in {"turn", "spin"} and symmetric and axial and not any(transverse) and any((W1, W2))
    return ", by the mean of the rates on both sides of the pole, through which the axis goes" * bool(through)


def _frequency(place: int, family: Family, motion: Any, arguments: Mapping[str, Any]) -> Any:
    """Return a frequency of a motion on a torus in rad/time: f1, f2 or f3 for `place` 0, 1, 2.

    They are defined at `AsymmetricMotion.frequencies`: momentum and field in the body turn with f1 and f2, and the
    rotation matrix about the field with f3 besides. Raises DomainError for a family without such frequencies, or
    without a field. `arguments` are the family's inputs by name.
    """
    if not (family.quantity("frequencies") and any(arguments["field"])):
        raise DomainError(ONE_PERIOD)
    return motion.frequencies[place]


def _ratio(arguments: Mapping[str, Any]) -> Any:
    """Return I3/I2 of a symmetric body, from the inputs by name. Raises DomainError for three moments."""
    if "ratio" in arguments:
        return getattr(arguments["ratio"], "ratio", arguments["ratio"])
    moments = arguments["inertia"]
    if len(moments) == 3:
        raise DomainError(THREE)
    return moments[1] / moments[0]


def _nutation(family: Family, motion: Any, functions: Any) -> Any:
    """Return the period of nutation, in time; of an elementary motion the period of small nutations about it.

    `functions` is `math` for doubles, or `Balls`. Raises DomainError where small nutations do not oscillate.
    `motion` is the object of `family`, in doubles or balls.
    """
    stability = family.quantity("stability") if family.takes("omega2") else None
    if stability is None:
        return motion.period
    square = stability.value(motion, exact=functions is not math)
    if not square > 0:
        raise DomainError("small nutations do not swing back: the motion is not stable")
    return 2 * functions.pi / functions.sqrt(square)


class Balls:
    """Stand-ins for `pi` and functions of `math` that take balls and exact fractions and return balls."""

    def __init__(self) -> None:
        from flint import arb

        self.pi = arb.pi()

    @staticmethod
    def ball(x: Any) -> Any:
        """Return an int, a Fraction or a ball as a ball, at the current precision."""
        from flint import arb, fmpq

        return arb(fmpq(x.numerator, x.denominator)) if isinstance(x, Fraction | int) else arb(x)

    def sqrt(self, x: Any) -> Any:
        """Return the square root of a ball or an exact fraction as a ball, without digits for a negative number."""
        return self.ball(x).sqrt()

    def atan2(self, y: Any, x: Any) -> Any:
        """Return the angle of the point (x, y) in (-pi, pi] rad, as a ball."""
        return self.ball(y).atan2(self.ball(y), self.ball(x))


def card(request: ReportRequest) -> dict[str, dict[str, Any]]:
    """Return the card: for each key of `ENTRIES` a dict with the number, or the reason why there is none.

    The keys of a dict are says, letter, value, unit, sigma (standard deviation or None), digits as text,
    proven_digits (their count), equation and reason; value, unit and digits are None without a number. A value is
    the double nearest to the proven number; one that is not proven is computed in doubles, with proven_digits 0 and
    ten digits.
    """
    item = object_of(request)
    names = [p.name for p in request.family.parameters]
    exact, floats = dict(zip(names, item.exact, strict=True)), dict(zip(names, item.floats, strict=True))
    motion, centre, records = item.kernels(), centre_of(request), dict[str, dict[str, Any]]()
    try:
        twin = item.balls()
    except AtlasError:
        twin = None
    for entry in ENTRIES:
        value, text = _proven(entry.key, item, twin, exact, request.digits)
        reason = None
        if value is None:
            value, reason = _in_doubles(entry.key, request.family, motion, floats)
        equation = entry.equation if request.family.takes("ratio") else ""
        record: dict[str, Any] = {
            "says": _words(entry, centre, motion) + _pole(entry.key, floats), "letter": entry.letter,
            "value": value, "unit": _unit(entry.unit, request.time),
            "sigma": (request.sigma or {}).get(entry.key), "digits": None, "proven_digits": 0,
            "equation": equation or None, "reason": None,
        }  # fmt: skip
        if value is None:
            record |= {"unit": None, "reason": reason}
        else:
            record |= {"digits": text or f"{value:.10g}", "proven_digits": significant(text)}
        if record["sigma"] == math.inf:
            record |= {"sigma": None, "proven_digits": 0, "reason": "the errors of the inputs tell no deviation of it"}
        records[entry.key] = record
    return records


def _unit(unit: str, time: str) -> str:
    """Return a unit of the register, such as "1/time", with "time" replaced by the inputs' unit of time, `time`.

    A unit of rates, "1/s", counts as s.
    """
    return unit.replace("time", "s" if time in {"s", "1/s"} else time)


def _proven(key: str, item: FamilyObject, twin: Any, exact: Mapping[str, Any], digits: int) -> tuple[float | None, str]:
    """Return the double nearest to a number of the card, and its proven digits as text; (None, "") without a proof.

    `twin` is the certified motion, None where there is none; `exact` holds the inputs by name. `key` is that of the
    number in `ENTRIES`, `item` the object.
    """

    def number() -> Any:
        if key == "ratio" and hasattr(exact.get("ratio"), "I2"):
            from atlas.bodies.certified_body import ratio_of

            return ratio_of(exact["ratio"])
        return _number(key, item.family, twin, exact, Balls())

    try:
        value = certified(number, digits)
    except (AtlasError, TypeError, AttributeError, ZeroDivisionError):
        return None, ""
    from atlas.arithmetic.numbers import nearest

    decimal = quantity(value, digits)
    return (nearest(Balls.ball(value)), decimal.digits.removesuffix(MARK)) if decimal.proven else (None, "")


def object_of(request: ReportRequest) -> FamilyObject:
    """Return the object of a request: its family with its inputs. Raises AtlasError for inputs that make no object."""
    return FamilyObject.from_request(
        Request([case_of(request)], {"family": request.family.name, **request.exact_values}, request.digits)
    )


def centre_of(request: ReportRequest) -> str:
    """Return "the vertical", "the field" or "its momentum": the direction about which the body's axis precesses."""
    if request.family.takes("coupling"):
        return "the vertical" if "heavy" in request.options or "magnetic" not in request.options else "the field"
    components = case_of(request).components if request.body else request.values.get("field", ())
    return "the field" if any(components) else "its momentum"
