"""The report of one object: its properties, figures, neighbours, and how to get the same numbers, as a report file."""

import inspect
import re
import shlex
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from dataclasses import field as attribute
from fractions import Fraction
from hashlib import sha256
from itertools import chain
from math import pi
from types import MappingProxyType
from typing import Any

from atlas.book.body_and_field import Body, Field, body_and_field
from atlas.book.digits import plain
from atlas.book.files import RULE
from atlas.book.markdown import written
from atlas.book.schema import convert
from atlas.book.tables import compute
from atlas.book.tables.properties import Thing
from atlas.book.tables.table import Request
from atlas.errors import AtlasError, DomainError
from atlas.motions.register import FAMILIES, Family

MAX_NAME_LENGTH = 48
"""Largest length of the name of a page; longer names end with a digest."""


@dataclass(frozen=True)
class Asked:
    """Request of a page.

    options   the options that say which object it is, each with the typed words, by name
    body, field   their records in a report file, where the family has them; `time` is the unit of time
    units     the system of units, si or gaussian, of a family whose parameters have different units
    values    the other parameters of the family; `exact` those that no floats hold, as fractions in text
    called    the name of its files, if it has one of its own
    note      a sentence on its axes
    deviations   quantity, symbol, value with its standard deviation, unit: rows, where inputs have an uncertainty;
              `deviation_notes` say how they were found, `sigma` has the standard deviations of the numbers of a card
    """

    family: Family
    options: Mapping[str, tuple[str, ...]]
    values: Mapping[str, Any]
    body: Mapping[str, Any] | None = None
    field: Mapping[str, Any] | None = None
    time: str = "time"
    units: str = ""
    digits: int = 10
    title: str = ""
    called: str = ""
    note: str = ""
    deviations: Sequence[Sequence[str]] = ()
    deviation_notes: Sequence[str] = ()
    sigma: Mapping[str, float] | None = None
    exact: Mapping[str, Sequence[str]] = attribute(default_factory=dict)

    @property
    def words(self) -> list[str]:
        """Words of the command: its name and options, as typed."""
        command = self.family.command.name if self.family.command else self.family.name
        return [command, *chain.from_iterable((f"--{name}", *texts) for name, texts in self.options.items())]

    @property
    def exact_values(self) -> dict[str, Any]:
        """Parameters by name, with fractions in the place of floats that would be rounded."""
        return {**self.values, **self.exact}

    @property
    def command(self) -> str:
        """The command that makes the page."""
        digits = ["--digits", str(self.digits)] if self.digits != 10 else []
        name_option = ["--name", self.called] if self.called else []
        return shlex.join(["atlas", "page", *self.words, *digits, *name_option])

    @property
    def name(self) -> str:
        """Name of its files, from the typed words."""
        return self.called or name_of(self.words)

    def sources(self, exists: Callable[[str], bool]) -> dict[str, str]:
        """Return {file name: text} of the report file; `exists` says which other pages lie in its folder."""
        return {f"{self.name}.md": headed(self, written(definition(self, exists)))}

    def changed(self, family: str, **options: Any) -> "Asked":
        """Return the request for a neighbouring object; an option with value None is removed."""
        new = {name: _texts(value) for name, value in options.items() if value is not None}
        kept_options = {
            name: new.get(name, texts) for name, texts in self.options.items() if name in new or name not in options
        }
        ratio = {name: new[name] for name in new if name == "ratio"}  # in the place of a shape
        return replace(
            self,
            called="",
            family=FAMILIES[family],
            options=kept_options | new if "ratio" in kept_options else ratio | kept_options | new,
        )


def _texts(value: Any) -> tuple[str, ...]:
    return tuple(plain(x + 0.0) for x in (value if isinstance(value, list | tuple) else (value,)))


MIN_PRECESSION = 1e-3
"""Angle of precession in a period of nutation below which figures show nothing of it, in rad."""

WITHOUT = {"energy_momentum": "the steady motions with this spin lie far outside its frame."}
"""Why a figure is left out, where its recipe names parameters that the reader did not give."""
FIGURES = "## Figures"
SETTING = {"kind": "table", "table": "body_and_field", "id": "setting", "body": "body", "field": "field"}
HEAD = (
    "# Made by `{command}`, digest {digest}.\n"
    "# Change it as you like, and build it by `atlas report {name}.md --format single pdf`.\n\n"
)


def name_of(words: Iterable[str]) -> str:
    """Return a file name made of the words of a command, with a digest if it is long."""
    name = "-".join(re.sub(r"[^\w.+-]+", "_", word.removeprefix("--"), flags=re.ASCII) for word in words)
    return name if len(name) <= MAX_NAME_LENGTH else f"{name[:MAX_NAME_LENGTH]}-{sha256(name.encode()).hexdigest()[:8]}"


def headed(request: Any, content: str, command: str = "") -> str:
    """Return a file's content below a head with its digest and the command that makes it."""
    start = f"{RULE}\n" * content.startswith(RULE)
    content = content.removeprefix(start)
    digest = sha256(content.encode()).hexdigest()[:12]
    return (
        start
        + HEAD.format(command=(command or request.command).replace("\n", " "), digest=digest, name=request.name)
        + content
    )


def edited(file: str) -> bool:
    """Whether the content of a page's file differs from the digest in its head."""
    head, _, content = file.partition("\n\n")
    matched = re.search(r"digest (\w+)\.", head)
    return matched is None or sha256(content.encode()).hexdigest()[:12] != matched[1]


def definition(request: Asked, exists: Callable[[str], bool]) -> dict[str, Any]:
    """Return the report as a dict of values for its file. Raises AtlasError where the object does not exist."""
    family, left_out = request.family, list[str]()
    thing = Thing.of(Request([case_of(request)], {"family": family.name, **request.exact_values}, request.digits))
    motion, _ = thing.kernels(), thing.balls()
    parameters = ", ".join(f"{name} {' '.join(texts)}" for name, texts in request.options.items())
    figures = list(figures_of(request, left_out))
    left_out += too_slow(motion, request.time)
    blocks = [
        table_of(request, "properties", family.name, request.exact_values),
        *deviations_of(request),
        *figures[:1],
        *([SETTING] if request.field and "B" in request.field else []),
        *(
            table_of(request, "properties", neighbour_family.name, {"given": False})
            for neighbour_family in other_families(family)
        ),
        *([{"kind": "prose", "text": FIGURES}, *figures[1:]] if figures[1:] else []),
        *closed_of(request, left_out),
        *_neighbours(request, exists),
        {"kind": "prose", "text": _reproduce(request, motion)},
        *([{"kind": "prose", "text": "\n- ".join(["## Left out\n", *left_out])}] if left_out else []),
    ]
    case = thing.says
    records = (("bodies", "body", request.body), ("fields", "field", request.field))
    return {
        "name": request.name,
        "title": request.title or case,
        "subtitle": parameters,
        "abstract": f"{request.note} All digits of the tables are proven unless they say otherwise; figures are drawn "
        "to a fraction of a pixel. The report file beside this page can be changed and built again.".lstrip(),
        "parameters": {kind: {name: record} for kind, name, record in records if record},
        "pages": [{"slug": "index", "title": "Properties", "blocks": blocks}],
    }  # fmt: skip


def deviations_of(request: Asked) -> Iterator[dict[str, Any]]:
    """Yield the table of standard deviations, if inputs have uncertainties."""
    if request.deviations:
        yield {
            "kind": "listing", "id": "deviations", "rows": [list(row) for row in request.deviations],
            "columns": ["Quantity", "Symbol", "Value", "Unit"],
            "caption": " ".join(["The same with the uncertainties of the inputs, which are independent.",
                                 *request.deviation_notes]),
        }  # fmt: skip


def other_families(family: Family) -> list[Family]:
    """Return the other families of a body in a field that need no further inputs."""
    names = {p.name for p in family.parameters}
    parameters = {other.name: {p.name for p in other.parameters} for other in FAMILIES.values() if other is not family}
    return [FAMILIES[name] for name, inputs in parameters.items() if {"ratio", "field"} <= inputs <= names]


def _calls(request: Asked, family: Family) -> dict[str, str]:
    """Return the keys by which a block names the body and the field, if the family takes them."""
    return {
        key: key
        for key, name in (("body", "ratio"), ("field", "field"))
        if request.body and any(p.name == name and not p.option for p in family.parameters)
    }


def table_of(request: Asked, table: str, family: str, values: Mapping[str, Any]) -> dict[str, Any]:
    """Return the block of a computed table of a family, with its parameters' values."""
    unit = {"units": request.units} if request.units else {"time": request.time} if request.time != "time" else {}
    return {
        "kind": "table", "table": table, "id": f"{table}-{family}", **_calls(request, FAMILIES[family]),
        "digits": request.digits, "parameters": {"family": family, **values, **unit},
    }  # fmt: skip


def too_slow(motion: Any, time: str) -> Iterator[str]:
    """Yield sentences on rotations too slow or too small to be seen in a figure of some periods of nutation."""
    from atlas.pictures.any_motion import slow_turn
    from atlas.pictures.captions import lasting

    unit = "s" if time in {"s", "1/s"} else time
    try:
        period, angle, rate = float(motion.period), float(motion.precession_per_period), float(motion.precession_rate)
    except (AttributeError, AtlasError):
        return
    turn = f"a whole turn takes {lasting(2 * pi / abs(rate), unit)}" if rate else ""
    if angle and slow_turn(motion, 5 * period):
        yield (
            f"The nutation, of the period {lasting(period, unit)}, which is too small to be seen: the axis is followed "
            f"for the precession, by {angle:.3g} rad in that time; {turn}."
        )
    elif 0 < abs(angle) < MIN_PRECESSION:
        yield (
            f"The precession about the field: in a period of nutation, {lasting(period, unit)}, the axis turns by "
            f"{angle:.3g} rad, so that figures of some periods show none of it; {turn}."
        )


def figures_of(
    request: Asked, left_out: list[str], maps: Mapping[str, Mapping[str, Any]] = MappingProxyType({})
) -> Iterator[dict[str, Any]]:
    """Yield the blocks of the family's figures and of the `maps`; add to `left_out` why figures are missing.

    A figure is left out where its recipe refuses the parameters.
    """
    from atlas.bodies.units import system
    from atlas.pictures import recipes

    case = case_of(request)
    for name in dict.fromkeys((*request.family.figures, *maps)):
        recipe = recipes.load(name)
        values = {key: value for key, value in request.values.items() if key in recipe.parameters} | dict(
            maps.get(name, {})
        )
        if recipe.parameters.get("unit") == "time":
            values["unit"] = request.time
        if request.units and "length" in recipe.parameters:
            values["length"] = system(request.units).length_unit
        parameters = {"ratio": case.ratio, "field": case.components} if request.body else {}
        try:
            recipe.scene(**{key: value for key, value in parameters.items() if key in recipe.parameters} | values)
        except AtlasError as reason:
            text = WITHOUT.get(name, str(reason).removeprefix(f"figure {name}: "))
            left_out.append(f"The figure `{name}`: {text}".replace(f": figure {name} ", " "))
        else:
            calls = _calls(request, request.family) if "ratio" in recipe.parameters else {}
            yield {"kind": "figure", "recipe": name, "id": name.replace("_", "-"), **calls, "parameters": values}


def case_of(request: Asked) -> Any:
    """Return the request's `BodyAndField`."""
    body = convert(request.body, Body) if request.body else None
    return body_and_field(body, convert(request.field, Field) if request.field else None)


def closed_of(request: Asked, left_out: list[str]) -> Iterator[dict[str, Any]]:
    """Yield the table of the nearest closed motions, if there are any; else add the reason to `left_out`."""
    if {"phi", "precession_per_period"} & {q.name for q in request.family.quantities}:
        block = table_of(request, "closed", request.family.name, request.exact_values)
        try:
            compute("closed", Request([case_of(request)], block["parameters"], request.digits))
        except AtlasError as reason:
            left_out.append(f"The nearest closed motions: {reason}")
        else:
            yield {"kind": "prose", "text": "## Nearest closed motions"}
            yield block


def _neighbours(request: Asked, exists: Callable[[str], bool]) -> Iterator[dict[str, Any]]:
    """Yield the heading "Neighbours" and a table: for each neighbour the command of its page, or a link."""
    rows = [
        [
            words,
            f"[`{near_by.command}`]({near_by.name}.html)" if exists(near_by.name) else f"`{near_by.command}`",
        ]
        for words, near_by in near(request)
    ]
    if rows:
        yield {"kind": "prose", "text": "## Neighbours"}
        yield {
            "kind": "listing", "id": "neighbours", "rows": rows,
            "columns": ["Neighbour", "Command that makes its page"],
            "caption": "Objects near by. A page that lay beside this one when this one was made is linked.",
        }  # fmt: skip


def near(request: Asked) -> Iterator[tuple[str, Asked]]:
    """Yield (words, request) for neighbouring objects."""
    values, name = request.values, request.family.name
    if not request.body:
        return
    B2, B3 = case_of(request).components
    if "omega2" in values:
        w2 = values["omega2"]
        without_third = {"omega3": None} if "omega3" in values else {}
        starts = {
            r"the pair $-2\mathbf{B}'-\boldsymbol\omega$, @theorem-pair": -2 * B2 - w2,
            "at rest": 0.0,
            r"$\phi=0$: it turns as a whole": -2 * B2,
        }
        for words, omega2 in starts.items():
            if B2 and omega2 not in {w2, -B2}:
                yield words, request.changed(name, omega2=omega2, **without_third)
    if "omega" in values:
        w1, w2, w3 = values["omega"]
        pair = (-w1, -2 * B2 - w2, -2 * B3 - w3)
        yield r"the pair $-2\mathbf{B}'-\boldsymbol\omega$, @theorem-pair", request.changed(name, omega=pair, spin=None)
        if B2 and w2 != -B2:
            same = request.changed("elementary", omega2=w2, omega=None, spin=None)
            yield r"the motion without nutation with this $\omega_2$", same
    yield from _of_other_bodies(request)
    if request.family.sampled:
        yield (
            "all motions of this body in this field",
            request.changed("quadric", omega2=None, omega3=None, omega=None, spin=None),
        )


def _of_other_bodies(request: Asked) -> Iterator[tuple[str, Asked]]:
    """Yield (words, request) of the same motion for a ball, and for a disk or loop."""
    ratio = case_of(request).ratio
    shape: dict[str, Any] = dict.fromkeys(("inertia", "shape", "points", "radius", "height", "equatorial", "polar"))
    if request.body and "density" in request.options:
        shape |= {"density": None, "mass": request.body["mass"]}
    for border, words in ((1.0, "the same in a ball, $I=1$"), (2.0, "the same in a disk or loop, $I=2$")):
        if ratio != border and "points" not in request.options:
            yield words, request.changed(request.family.name, **shape, ratio=border)


def _reproduce(request: Asked, motion: Any) -> str:
    """Say how to get the same numbers from the command line and from Python."""
    family = request.family
    kernels = family.kernels()
    values = zip(
        inspect.signature(kernels).parameters, (_python(request, p.name) for p in family.parameters), strict=True
    )
    arguments = ", ".join(f"{name}={value}" for name, value in values if value)
    lines = ["import atlas", "", f"it = atlas.{kernels.__name__}({arguments})"]
    lines += [f"print(it.{q.name})" for q in family.quantities if _is_printed(q, motion)]
    digits = [] if request.deviations else ["--digits", str(request.digits)]
    return "\n".join(
        [
            "## The same numbers elsewhere", "", "On the command line:", "", "```console",
            f"$ {shlex.join(['atlas', *request.words, *digits])}", "```", "",
            "In Python, as doubles next to them:", "", "```python", *lines, "```",
        ]
    )  # fmt: skip


def _is_printed(quantity: Any, motion: Any) -> bool:
    """Return whether a quantity of the motion, without its own getter, has digits to print."""
    if quantity.get or not (quantity.certified or quantity.printed):
        return False
    try:
        getattr(motion, quantity.name)
    except DomainError:
        return False
    return True


def _python(request: Asked, name: str) -> str:
    """Return a parameter as it is written in Python, nothing for one that is left out."""
    body, field = request.body or {}, request.field or {}
    if name == "ratio":
        if "shape" in body:
            sizes = ", ".join(f"{key}={plain(body[key])}" for key in body if key not in {"title", "shape", "charge"})
            return f"atlas.SymmetricBody.{body['shape']}({sizes})"
        return (
            plain(body["ratio"])
            if "ratio" in body
            else f"atlas.SymmetricBody{tuple(float(Fraction(x)) for x in body['inertia'])}"
        )
    if name == "field" and field:
        if "prime" in field:
            return str(tuple(float(Fraction(x)) for x in field["prime"]))
        mu = field.get("charge_to_mass", 0.0)
        mu = float(Fraction(mu)) if mu else f"{body['charge']!r} / {body['mass']!r}"
        return f"atlas.Field.{field['system'].lower()}(B={tuple(field['B'])}, mu={mu}).pair"
    value = request.values.get(name)
    return "" if value is None else repr(tuple(value) if isinstance(value, list | tuple) else value)
