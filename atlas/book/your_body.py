"""The report of a reader's own body: the numbers of its card, its title and verdict in words, and what it leaves out.

`templates/report/your_body.md` has the prose; it sees the values that `values_of` returns, and decides nothing.
"""

import json
import math
import re
import shlex
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from hashlib import sha256
from typing import Any

from atlas.arithmetic.certified_digits import MARK
from atlas.arithmetic.uncertainty import concise
from atlas.bodies.formula_shapes import SHAPES
from atlas.bodies.laboratory import Disturbance, Spinning, disturbances
from atlas.book import toml
from atlas.book.digits import Number, plain
from atlas.book.expansion import expanded
from atlas.book.files import RULE
from atlas.book.markdown import fenced
from atlas.book.page import (
    Asked,
    case_of,
    closed_of,
    deviations_of,
    figures_of,
    headed,
    other_families,
    table_of,
    too_slow,
)
from atlas.book.tables.properties import Thing
from atlas.book.tables.table import Request, certified, quantity
from atlas.book.templates import versions
from atlas.errors import AtlasError, DomainError
from atlas.motions.register import Family
from atlas.places import folder

REPORTED = ("elementary", "general", "asymmetric", "top", "quadric")
"""Families of bodies that have this report."""
NAME = "your_body"
"""Name of the report, before the digest of its inputs."""
RATES = {"elementary": ("k", "phi")}
"""Names of the rates about the field and about the axis; of other families precession_rate and spin_rate."""
THREE_MOMENTS = "asymmetric"
"""Name of the family of motions with three frequencies."""
NEEDLE = 0.1
"""I = I3/I2 below which a body is called a needle."""
NEAR_BALL = 0.01
"""|I - 1| below which a body is called nearly a ball."""


@dataclass(frozen=True)
class Entry:
    """A number of the card: its key, words, letter in TeX, unit of the register, equations."""

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
TEMPLATES = folder("templates") / "report"
"""Folder of the prose, and of the recipe of the body's picture."""
NO_FIELD, NO_START, THREE = "there is no field", "no start was given", "the body has three moments"


def numbers(family: Family, arguments: Mapping[str, Any]) -> dict[str, float]:
    """Return the numbers of the card that a body has, in doubles, by key."""
    motion = family.kernels()(*arguments.values())
    found = dict[str, float]()
    for one in ENTRIES:
        try:
            found[one.key] = float(_number(one.key, family, motion, arguments, math))
        except (DomainError, ZeroDivisionError, OverflowError):
            continue
    return {key: value for key, value in found.items() if math.isfinite(value)}


def _number(key: str, family: Family, motion: Any, arguments: Mapping[str, Any], functions: Any) -> Any:
    """Return a number of the card by functions of doubles, `math`, or of balls. Raises DomainError with the reason."""
    if key == "ratio":
        return _ratio(arguments)
    if key in {"larmor", "tilt"}:
        return _of_field(key, arguments, functions)
    if not family.sampled:
        raise DomainError(NO_START)
    if key in FREQUENCIES:
        return _frequency(FREQUENCIES.index(key), family, motion, arguments)
    pi = functions.pi
    if key == "nutation":
        return _nutation(family, motion, functions, pi)
    name = RATES.get(family.name, ("precession_rate", "spin_rate"))[key == "spin"]
    rate = getattr(motion, name)
    if key == "spin":
        return rate
    if rate == 0:
        raise DomainError("the axis does not go round")
    return 2 * pi / abs(rate)


def _of_field(key: str, arguments: Mapping[str, Any], functions: Any) -> Any:
    """Return |B'|, or the angle between field and axis at the start. Raises DomainError where there is no field."""
    *across, along = map(Fraction, arguments.get("field") or arguments.get("direction") or (0.0,))
    if not any((*across, along)):
        raise DomainError(NO_FIELD)
    if key == "tilt":
        return functions.atan2(functions.sqrt(sum(x * x for x in across)), along)
    if "field" not in arguments:
        raise DomainError("a top has its weight and coupling in the place of a field")
    return functions.sqrt(sum(x * x for x in (*across, along)))


def _frequency(place: int, family: Family, motion: Any, arguments: Mapping[str, Any]) -> Any:
    """Return a frequency of the torus, f1 at place 0. Raises DomainError for a motion with a period and two rates."""
    if family.name != THREE_MOMENTS or not any(arguments["field"]):
        raise DomainError("it has one period and two rates")
    return motion.frequencies[place]


def _ratio(arguments: Mapping[str, Any]) -> Any:
    """Return I3/I2 of a symmetric body. Raises DomainError for three moments."""
    if "ratio" in arguments:
        return getattr(arguments["ratio"], "ratio", arguments["ratio"])
    moments = arguments["inertia"]
    if len(moments) == 3:
        raise DomainError(THREE)
    return moments[1] / moments[0]


def _nutation(family: Family, motion: Any, functions: Any, pi: Any) -> Any:
    """Return the period of nutation, of small ones about a steady motion. Raises DomainError where there is none."""
    if not family.takes("omega2"):
        return motion.period
    square = next(q for q in family.quantities if q.name == "stability").value(motion, exact=functions is not math)
    if not square > 0:
        raise DomainError("small nutations do not swing back: the motion is not stable")
    return 2 * pi / functions.sqrt(square)


class Balls:
    """Functions of balls and exact fractions in the place of those of `math`."""

    def __init__(self) -> None:
        from flint import arb

        self.pi = arb.pi()

    @staticmethod
    def ball(x: Any) -> Any:
        """Return a fraction or a ball as a ball."""
        from flint import arb, fmpq

        return arb(fmpq(x.numerator, x.denominator)) if isinstance(x, Fraction | int) else arb(x)

    def sqrt(self, x: Any) -> Any:
        """Return the square root."""
        return self.ball(x).sqrt()

    def atan2(self, y: Any, x: Any) -> Any:
        """Return the angle of the point (x, y)."""
        return self.ball(y).atan2(self.ball(y), self.ball(x))


def card(request: Asked) -> dict[str, dict[str, Any]]:
    """Return the card: of each key value, digits as text, unit, sigma, proven digits, equation; or the reason.

    A double that is not within its proven digits gives way to them: squares of tiny or huge rates are no doubles.
    """
    item = thing_of(request)
    names = [p.name for p in request.family.parameters]
    exact, floats = dict(zip(names, item.exact, strict=True)), dict(zip(names, item.floats, strict=True))
    there, motion = numbers(request.family, floats), request.family.kernels()(*item.floats)
    centre = centre_of(request)
    made = dict[str, dict[str, Any]]()
    for one in ENTRIES:
        text = _proven(one.key, item, exact, request.digits)
        equation = one.equation if request.family.takes("ratio") else ""
        entry: dict[str, Any] = {
            "says": one.says.replace("the field", centre), "letter": one.letter,
            "value": _value(there.get(one.key), text), "unit": _unit(one.unit, request.time),
            "sigma": (request.sigma or {}).get(one.key), "digits": None, "proven_digits": 0,
            "equation": equation or None, "reason": None,
        }  # fmt: skip
        if entry["value"] is None:
            entry |= {"unit": None, "reason": reason_of(one.key, request.family, motion, floats)}
        else:
            entry |= {"digits": text or f"{entry['value']:.10g}", "proven_digits": significant(text)}
        if entry["sigma"] == math.inf:
            entry |= {"sigma": None, "proven_digits": 0, "reason": "the errors of the inputs tell no deviation of it"}
        made[one.key] = entry
    return made


def _value(value: float | None, text: str) -> float | None:
    """Return a double, or that of its proven digits where they differ."""
    if text and not (value and math.isclose(value, float(text), rel_tol=10.0 ** (1 - significant(text)))):
        return float(text)
    return value


def significant(text: str) -> int:
    """Return the number of significant digits in a text."""
    return len(text.partition("e")[0].replace("-", "").replace(".", "").lstrip("0"))


def _unit(unit: str, time: str) -> str:
    """Return a unit of the register by the unit of time that the inputs have."""
    return unit.replace("time", "s" if time in {"s", "1/s"} else time)


def reason_of(key: str, family: Family, motion: Any, arguments: Mapping[str, Any]) -> str:
    """Return why the card lacks a number."""
    try:
        _number(key, family, motion, arguments, math)
    except DomainError as reason:
        return str(reason).rstrip(".")
    except ZeroDivisionError:
        return "the axis does not go round"
    except OverflowError:
        return "it is beyond the largest double"
    return "the motion has no period"


def _proven(key: str, item: Thing, exact: Mapping[str, Any], digits: int) -> str:
    """Return the proven digits of a number of the card, none where there is no proof."""
    try:
        made = item.balls()
        if key == "ratio" and hasattr(exact.get("ratio"), "I2"):
            from atlas.bodies.certified_body import ratio_of

            number = quantity(certified(lambda: ratio_of(exact["ratio"]), digits), digits)
        else:
            number = quantity(certified(lambda: _number(key, item.family, made, exact, Balls()), digits), digits)
    except (AtlasError, TypeError, AttributeError, ZeroDivisionError):
        return ""
    return number.digits.removesuffix(MARK) if number.proven else ""


def thing_of(request: Asked) -> Thing:
    """Return the object of a request. Raises AtlasError where there is no such object."""
    return Thing.of(
        Request([case_of(request)], {"family": request.family.name, **request.exact_values}, request.digits)
    )


def stands(ratio: float) -> str:
    """Return where a body stands between a needle and a disk, in words."""
    if ratio == 1.0:
        return "a ball: every axis is like every other"
    if ratio == 2.0:
        return "as flat as a body can be, a disk or a loop"
    if abs(ratio - 1.0) < NEAR_BALL:
        return "nearly a ball"
    if ratio < NEEDLE:
        return "nearly a needle"
    return "longer than a ball" if ratio < 1.0 else "flatter than a ball"


def verdict(item: Thing) -> str:
    """Return what kind of motion it is, and whether a small push stays small, in words."""
    family, motion = item.family, item.kernels()
    if not family.sampled:
        return "no start was given, so that all motions are shown and none is followed"
    if family.takes("omega2"):
        nutation = str(next(q for q in family.quantities if q.name == "nutation").value(motion))
        return f"{motion.case}, {nutation} against small nutations"
    kind = str(motion.kind)
    if kind == "ball":
        kind = "it turns as a ball does, about its momentum"
    says = "its axis nods" if kind.startswith("nutation") else kind.replace("on a torus", "with three frequencies")
    stable = is_stable(item)
    return says if stable is None else f"{says}, {'stable' if stable else 'unstable'} against small nutations"


def is_stable(item: Thing) -> bool | None:
    """Return whether a motion whose axis keeps its angle stays so after a push; None where no push is decided on."""
    family, motion = item.family, item.kernels()
    if family.takes("coupling"):
        return getattr(motion, "stable", None)
    if motion.kind == "spin about an axis":
        return spins_on(*(list(map(Fraction, values)) for values in item.exact))
    if not family.takes("ratio"):
        return None
    ratio, field, (omega1, omega2, omega3) = item.floats
    if motion.kind == "spin along the field":
        I, b = Fraction(getattr(ratio, "ratio", ratio)), Fraction(field[1])
        gap = I * I * (Fraction(omega3) + b) ** 2 + 4 * (1 - I) * b * b
        return gap > 0 if gap else None
    if motion.kind == "precession":
        from atlas.motions.elementary.certified_hyperbola import Hyperbola

        if not omega1 and field[0] and omega2 != -field[0]:
            return bool(Hyperbola(*item.exact[:2]).stable(omega2))
    return None


def spins_on(moments: Sequence[Fraction], field: Sequence[Fraction], omega: Sequence[Fraction]) -> bool | None:
    """Return whether a spin about a principal axis, along the field if there is one, is linearly stable.

    With W = Omega + K along axis 3, pushes obey W1' = r1 (W W2 - K K2), W2' = r2 (W W1 - K K1), K1' = W K2 - K W2,
    K2' = K W1 - W K1, where r1 = (I2 - I3)/I1 and r2 = (I3 - I1)/I2. Solutions exp(s t) have s^4 + p s^2 + q = 0: they
    stay small where both s^2 are negative and different. None at a border, where the linear equations do not decide.
    """
    axis = next(i for i in range(3) if omega[i])
    I1, I2, I3 = (moments[(axis + i) % 3] for i in (1, 2, 3))
    W, K, r1, r2 = omega[axis] + field[axis], field[axis], (I2 - I3) / I1, (I3 - I1) / I2
    if not K:
        return r1 * r2 < 0 if r1 * r2 else None
    p, q = (1 - r1 * r2) * W * W + (r1 - r2) * K * K, -r1 * r2 * (W * W - K * K) ** 2
    gaps = p, q, p * p - 4 * q
    return all(x > 0 for x in gaps) if all(gaps) else None


def place_of(family: Family, motion: Any) -> str:
    """Return where the start lies beside the curve of motions without nutation, in words."""
    if not family.sampled:
        return "Any other start makes the axis nod."
    if family.takes("omega2"):
        return "The given start lies on it: the axis keeps its angle with the field."
    if motion.kind == "ball":
        return "All axes of a ball are alike: the drawn one turns about the angular momentum, and that about the field."
    nods = str(motion.kind).startswith("nutation")
    return (
        "The given start lies off it, so that the axis nods." if nods else "From the given start the axis does not nod."
    )


def body_named(request: Asked, made: Mapping[str, Any]) -> str:
    """Return the body in words, with its size or its moments as they were typed."""
    options = request.options
    if "shape" in options:
        shape = options["shape"][0].replace("-", " ").replace("_", " ")
        for name in ("radius", "length", "equatorial", "polar"):
            if name in options:
                size = options[name][0]
                unit = " m" if re.fullmatch(r"[\d.e+-]+", size) and request.time == "s" else ""
                return f"{shape} of {name}{' radius' if name in {'equatorial', 'polar'} else ''} {size}{unit}"
        return shape
    if made["ratio"]["value"] is not None:
        return f"body with I = {made['ratio']['value']:.8g}"
    return f"body with the moments {', '.join(map(plain, request.values['inertia']))}"


def title_of(request: Asked, made: Mapping[str, Any], says: str) -> str:
    """Return the title of a report: the body, the time of one turn, and the verdict."""
    turn, body = made["turn"], body_named(request, made)
    subject = f"{'An' if body[0] in 'aeiou' else 'A'} {body}"
    if turn["value"] is None:
        return f"{subject}: {says}"
    unit = turn["unit"].replace("time", "units of time")
    time = concise(turn["value"], turn["sigma"]) if turn["sigma"] else f"{turn['value']:.4g}"
    return f"{subject} turns about {centre_of(request)} once in {time} {unit}; {says}"


def centre_of(request: Asked) -> str:
    """Return the direction that the axis goes round, in words."""
    if request.family.takes("coupling"):
        return "the vertical"
    components = case_of(request).components if request.body else request.values.get("field", ())
    return "the field" if any(components) else "its momentum"


def sign_of(request: Asked) -> str:
    """Return a sentence on the field of a negative charge, none for another."""
    record = {**(request.body or {}), **(request.field or {})}
    if not any(Fraction(record.get(name) or 0) < 0 for name in ("charge", "charge_to_mass")):
        return ""
    return "The charge is negative: B\N{PRIME} points against B, and arrows named B in the figures show B\N{PRIME}."


def shape_of(request: Asked) -> dict[str, Any] | None:
    """Return radius and height of the body for its picture, None where it is no cylinder and no ball."""
    body = request.body or {}
    if "shape" not in body or body["shape"] == "spheroid":
        return None
    if "sphere" in body["shape"] or "spherical" in body["shape"]:
        return {"is_ball": True}
    return {"radius": body.get("radius", 0.0), "height": body.get("height", body.get("length", 0.0))}


def maps_of(request: Asked) -> dict[str, dict[str, Any]]:
    """Return the parameters of the figures of all motions of a symmetric body in its field, by recipe."""
    if not request.body:
        return {}
    case = case_of(request)
    b = math.hypot(*case.components)
    spin = request.values.get("omega", (0.0, 0.0, 0.0))[2]
    maps: dict[str, dict[str, Any]] = {"quadric": {}, "hyperbola": {}, "frequencies": {}, "stability": {}}
    if all(case.components):
        maps["motion_map"] = {"ratios": [case.ratio], "field": list(case.components), "cells": 60}
    return (
        maps | {"energy_momentum": {"ratios": [case.ratio], "b": [b], "M3": case.ratio * spin or 0.25 * b}} if b else {}
    )


def evaluated(request: Asked) -> dict[str, Any]:
    """Return the inputs as they are evaluated, by name: two ways to type one body have the same."""
    records = {"body": request.body, "field": request.field}
    bare = {name: {k: v for k, v in one.items() if k != "title"} for name, one in records.items() if one}
    sigma = {"sigma": {key: float(f"{x:.6g}") for key, x in request.sigma.items()}} if request.sigma else {}
    return {"family": request.family.name, "time": request.time, **bare, "values": dict(request.values), **sigma}


def digest_of(request: Asked) -> str:
    """Return eight characters that stand for the evaluated inputs."""
    return sha256(json.dumps(evaluated(request), sort_keys=True).encode()).hexdigest()[:8]


def name_of(request: Asked) -> str:
    """Return the name of the report: the given one, or your_body, and the digest of the inputs."""
    return f"{request.called or NAME}-{digest_of(request)}"


def words_of(request: Asked) -> list[str]:
    """Return the words that make the report, after `atlas report your_body`."""
    own = (
        ("title", request.title),
        ("name", request.called),
        ("digits", request.digits if request.digits != 10 else ""),
    )
    options = dict(request.options) | {name: (str(value),) for name, value in own if value}
    words = [word for name, texts in options.items() for word in (f"--{name}", *texts)]
    return [*[request.family.page] * request.family.takes("coupling"), *words]


def command_of(request: Asked) -> str:
    """Return the command that makes the report."""
    return shlex.join(["atlas", "report", "your_body", *words_of(request)])


def inputs_of(request: Asked) -> str:
    """Return the file NAME.inputs.toml: inputs as typed and as evaluated, defaults marked, versions, no clock."""
    omitted = [
        p.name
        for p in request.family.parameters
        if p.option and p.omitted is not None and p.name in request.values and p.name not in request.options
    ]
    content = {"typed": words_of(request), "defaults": omitted, "digest": digest_of(request),
               "evaluated": evaluated(request), "versions": versions()}  # fmt: skip
    return f"# {command_of(request)}\n" + "".join(toml.lines(content))


def files_of(request: Asked) -> dict[str, str]:
    """Return the files of a report by name: its Markdown, its card, its inputs, the recipe of its picture.

    Raises
    ------
    AtlasError
        Where there is no such object, or where its family has no such report.
    """
    if request.family.name not in REPORTED:
        name = request.family.page
        raise AtlasError(f"your_body is the report of a body that turns; atlas page {name} is the page of this {name}.")
    name, made, command = name_of(request), card(request), command_of(request)
    values, parameters = template_values(request, made), records_of(request)
    head = {"name": name, "title": values["title"], "front_matter": False} | parameters
    source = (TEMPLATES / "your_body.md").read_text(encoding="utf-8")
    content = f"{RULE}\n{''.join(toml.lines(head))}{RULE}\n\n{expanded(values, {}, source)[1]}"
    same = replace(request, called=name)
    made_files = {
        f"{name}.md": headed(same, content, command),
        f"{name}.card.json": json.dumps(made, indent=1, ensure_ascii=False) + "\n",
        f"{name}.inputs.toml": inputs_of(request),
    }
    if shape_of(request):
        recipe = (TEMPLATES / "body.py.txt").read_text(encoding="utf-8")
        made_files[f"{name}.py"] = headed(same, recipe, command)
    return made_files


def records_of(request: Asked) -> dict[str, Any]:
    """Return the parameters of a report's head: its body and its field, where there are records of them."""
    records = (("bodies", "body", request.body), ("fields", "field", request.field))
    parameters = {kind: {name: record} for kind, name, record in records if record}
    return {"parameters": parameters} if parameters else {}


def template_values(request: Asked, made: Mapping[str, Any]) -> dict[str, Any]:
    """Return the values that the template sees: words, rows, and blocks in their fences."""
    family, left_out, shape = request.family, list[str](), shape_of(request)
    item, ratio = thing_of(request), made["ratio"]["value"]
    motion, beside = item.kernels(), list(disturbances_of(request, made))
    figures = {block["recipe"]: fenced(block) for block in figures_of(request, left_out, maps_of(request))}
    if shape:
        recipe = f"{name_of(request)}.py"
        figures["body"] = fenced({"kind": "figure", "recipe": recipe, "id": "body", "parameters": shape})
    says = verdict(item)
    closed = [fenced(block) for block in closed_of(request, left_out) if block["kind"] == "table"]
    reasons = dict[str, list[str]]()
    has_torus = family.name == THREE_MOMENTS and any(request.values["field"])
    for key, entry in made.items():
        if entry["reason"] and (has_torus or key not in FREQUENCIES):
            reasons.setdefault(entry["reason"], []).append(entry["says"])
    sentences = [f"{', '.join(names)}: {reason}." for reason, names in reasons.items()]
    left_out += [text[:1].upper() + text[1:] for text in sentences]  # but B stays B
    left_out += [*too_slow(motion, request.time), *_absent(request, shape, bool(beside))]
    others = [table_of(request, "properties", one.name, {"given": False}) for one in other_families(family)]
    return {
        "name": name_of(request), "title": request.title or title_of(request, made, says), "verdict": says,
        "place": place_of(family, motion), "sign": sign_of(request), "command": command_of(request),
        "note": request.note, "family": family.name,
        "card": list(_rows(made)), "outweighed": outweighed(beside), "disturbances": [*map(_row_of, beside)],
        "ratio": ratio, "stands": "" if ratio is None else stands(ratio),
        "figures": figures, "left_out": left_out, "symmetric": bool(request.body), "others": [*map(fenced, others)],
        "deviations": "".join(map(fenced, deviations_of(request))), "closed": "".join(closed),
        "properties": fenced(table_of(request, "properties", family.name, request.exact_values)),
    }  # fmt: skip


def _rows(made: Mapping[str, Mapping[str, Any]]) -> Iterator[list[str]]:
    """Yield the rows of the card: words, letter, value with its error, unit, proven digits, equation."""
    for key, entry in made.items():
        if key in FREQUENCIES and entry["value"] is None:
            continue
        value = "–" if entry["value"] is None else Number(entry["digits"]).words()
        unknown_error = entry["value"] is not None and entry["reason"]
        if entry["sigma"] or unknown_error:
            value = Number(concise(entry["value"], math.inf if unknown_error else entry["sigma"])).words()
        proven = str(entry["proven_digits"] or "") if not entry["sigma"] else ""
        equation = f"@{entry['equation']}" if entry["equation"] and entry["value"] is not None else ""
        yield [entry["says"], entry["letter"], value, entry["unit"] or "", proven, equation]


def disturbances_of(request: Asked, made: Mapping[str, Mapping[str, Any]]) -> Iterator[Disturbance]:
    """Yield what is left out, in numbers, of a body whose shape, mass and field B in SI were given."""
    body, field = request.body or {}, request.field or {}
    if "shape" not in body or not {"mass", "density"} & request.options.keys() or field.get("system") != "SI":
        return
    case = case_of(request)
    turn = made["turn"]["value"]
    yield from disturbances(Spinning(
        body["shape"], {name: body[name] for name in SHAPES[body["shape"]][0] if name != "mass"}, body["mass"],
        float(case.physical.mu), (float(case.body.I2), float(case.body.I3)), math.hypot(*field["B"]),
        math.hypot(*request.values.get("omega", (request.values.get("omega2", 0.0),))),
        2 * math.pi / turn if turn else made["larmor"]["value"] or 0.0,
    ))  # fmt: skip


def outweighed(beside: Sequence[Disturbance]) -> str:
    """Return a sentence on the effects that outweigh what is shown, none where there is none."""
    names = [one.says.partition(",")[0] for one in beside if one.outweighs]
    return f"What is shown is outweighed by {' and by '.join(names)}." if names else ""


def _row_of(one: Disturbance) -> list[str]:
    """Return the row of an effect that is left out: words, letter, number, unit, formula, verdict."""
    return [one.says, one.letter, Number(f"{one.value:.2e}").words(), one.unit, one.formula, one.verdict]


def _absent(request: Asked, shape: Mapping[str, Any] | None, is_told: bool) -> Iterator[str]:
    """Yield sentences on parts that this report does not have, with the reason."""
    is_top = request.family.takes("coupling")
    if not shape and not is_top:
        yield "A picture of the body: no cylinder, ring, disk, rod or ball was given as its shape."
    if not request.deviations:
        yield "Errors of the numbers: the inputs have none; type 1.20(5)um for one."
    if not request.body:
        yield "Quadric, hyperbola and the map of all motions: they are those of a symmetric body in a field."
    if not is_told:
        missing = "; in numbers for a shape with its mass or density and a field --magnetic in SI" * bool(request.body)
        yield f"{'D' if is_top else 'Gravity, d'}rag, radiation, induced magnetism, eddy currents{missing}."
