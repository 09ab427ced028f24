"""The request of a report of one object, and the blocks of its tables and figures."""

import re
import shlex
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from dataclasses import field as attribute
from hashlib import sha256
from math import pi
from typing import Any

from atlas.book import toml
from atlas.book.body_and_field import Body, Field, body_and_field
from atlas.book.digits import Number, plain
from atlas.book.expansion import expanded
from atlas.book.files import RULE
from atlas.book.schema import convert
from atlas.book.tables import compute
from atlas.book.tables.table import Request
from atlas.errors import AtlasError
from atlas.motions.register import FAMILIES, Family
from atlas.places import folder


@dataclass(frozen=True)
class ReportRequest:
    """Request of a report of one object.

    family    the family of the object
    options   the options that say which object it is, each with the typed words, by name
    body, field   their records in a report file, where the family has them; `time` is the unit of time
    magnetic  charge-to-mass ratio in C/kg and strength of B in T, where B was given in SI
    units     the system of units, si or gaussian, of a family whose parameters have different units
    values    the other parameters of the family by name; `exact` those that no floats hold, as fractions in text
    digits    significant digits of the tables; `title` that was asked for, "" for one made from the object
    file_name the name of its files, if it has one of its own
    parts     the parts that the report has; `only`, the same as typed, "" for all
    is_page   whether the command is that of a page
    note      a sentence on its axes
    deviations   rows (quantity, symbol, value with its standard deviation, unit) where inputs have an uncertainty;
              `deviation_notes` say how they were found, `sigma` has the standard deviations of the numbers of a card
    """

    family: Family
    options: Mapping[str, tuple[str, ...]]
    values: Mapping[str, Any]
    body: Mapping[str, Any] | None = None
    field: Mapping[str, Any] | None = None
    magnetic: tuple[float, float] | None = None
    time: str = "time"
    units: str = ""
    digits: int = 10
    title: str = ""
    file_name: str = ""
    parts: Sequence[str] = ()
    only: str = ""
    is_page: bool = False
    note: str = ""
    deviations: Sequence[Sequence[str]] = ()
    deviation_notes: Sequence[str] = ()
    sigma: Mapping[str, float] | None = None
    exact: Mapping[str, Sequence[str]] = attribute(default_factory=dict)

    @property
    def option_words(self) -> list[str]:
        """Words of the options of the object, each "--name" followed by its texts."""
        return [word for name, texts in self.options.items() for word in (f"--{name}", *texts)]

    @property
    def words(self) -> list[str]:
        """Words of the command that makes the report: options of the object, title, name, digits, parts.

        The page's family stands first for tops only, whose options do not tell it; defaults are left out.
        """
        settings = {"title": self.title, "name": self.file_name, "digits": self.digits if self.digits != 10 else "",
               "only": self.only}  # fmt: skip
        options = [word for name, value in settings.items() if value for word in (f"--{name}", str(value))]
        return [*[self.family.page] * self.family.takes("coupling"), *self.option_words, *options]

    @property
    def exact_values(self) -> dict[str, Any]:
        """Parameters by name, with fractions as text in the place of floats that would be rounded."""
        return {**self.values, **self.exact}

    @property
    def command(self) -> str:
        """The shell command that makes the report: "atlas page ..." or "atlas report your_body ...", quoted."""
        if self.is_page:
            return shlex.join(["atlas", "page", *replace(self, only="").words])
        return shlex.join(["atlas", "report", "your_body", *self.words])

    def changed(self, family: str, **options: Any) -> "ReportRequest":
        """Return the request of a family for a neighbouring object, without title and file name.

        `options` are values of options by name, numbers or tuples; one with the value None is removed.
        """
        new = {name: _texts(value) for name, value in options.items() if value is not None}
        kept_options = {
            name: new.get(name, texts) for name, texts in self.options.items() if name in new or name not in options
        }
        ratio = {name: new[name] for name in new if name == "ratio"}  # in the place of a shape
        return replace(
            self,
            file_name="",
            title="",
            family=FAMILIES[family],
            options=kept_options | new if "ratio" in kept_options else ratio | kept_options | new,
        )


def _texts(value: Any) -> tuple[str, ...]:
    return tuple(plain(x + 0.0) for x in (value if isinstance(value, list | tuple) else (value,)))


MIN_PRECESSION = 1e-3
"""Angle of precession in a period of nutation below which figures show nothing of it, in rad."""

WITHOUT = {"energy_momentum": "the steady motions with this spin lie far outside its frame.",
           "motion_map": "it needs a field that is neither along the axis nor across it."}  # fmt: skip
"""Why a figure is left out, where its recipe names parameters that the reader did not give."""
HEAD = (
    "# Made by `{command}`, digest {digest}.\n"
    "# Change it as you like, and build it by `atlas report {name}.md --format single pdf`.\n\n"
)


def templated(name: str, template: str, head: Mapping[str, Any], values: Mapping[str, Any], command: str) -> str:
    """Return a report in Markdown: ``head`` as TOML, then a template of templates/report with ``values`` filled in.

    `name` is the report's, `template` the template's file, `command` the one that makes the report, for a comment
    on top.
    """
    source = (folder("templates") / "report" / template).read_text(encoding="utf-8")
    lines = "".join(toml.lines({"name": name, **head}))
    return headed(name, f"{RULE}\n{lines}{RULE}\n\n{expanded(values, {}, source)[1]}", command)


def headed(name: str, content: str, command: str) -> str:
    """Return a file's content with two comment lines (#): the command that makes it, its digest, how to build it.

    `name` is the report in the command to build. The lines stand above the content, but in a head of TOML below
    its opening +++. The digest (12 hex digits) is of all that follows the two lines and a blank one.
    """
    start = f"{RULE}\n" * content.startswith(RULE)
    content = content.removeprefix(start)
    digest = sha256(content.encode()).hexdigest()[:12]
    return start + HEAD.format(command=command.replace("\n", " "), digest=digest, name=name) + content


def edited(file: str) -> bool:
    """Return whether the content of a report's file differs from the digest in its head; True without a digest."""
    head, _, content = file.partition("\n\n")
    matched = re.search(r"digest (\w+)\.", head)
    return matched is None or sha256(content.encode()).hexdigest()[:12] != matched[1]


def setting_of(request: ReportRequest) -> Iterator[dict[str, Any]]:
    """Yield a table block, a dict, of the body and the field B, if the request has a field given by B; else nothing."""
    if request.field and "B" in request.field:
        yield {"kind": "table", "table": "body_and_field", "id": "setting", "body": "body", "field": "field"}


def deviations_of(request: ReportRequest) -> Iterator[dict[str, Any]]:
    """Yield a listing block, a dict, of standard deviations, if inputs have uncertainties; otherwise nothing."""
    if request.deviations:
        yield {
            "kind": "listing", "id": "deviations",
            "rows": [[says, symbol, _typeset(value), unit] for says, symbol, value, unit in request.deviations],
            "columns": ["Quantity", "Symbol", "Value", "Unit"],
            "caption": " ".join(["The same with the uncertainties of the inputs, which are independent.",
                                 *request.deviation_notes]),
        }  # fmt: skip


def _typeset(value: str) -> str:
    """Return a text of numbers in which powers of ten are written out as Markdown."""
    return re.sub(r"-?[\d.]+(\(\d+\))?e[-+]?\d+", lambda number: Number(number[0]).words(), value)


def other_families(family: Family) -> list[Family]:
    """Return the families with a ratio and a field all of whose parameters this family has too, without itself."""
    names = {p.name for p in family.parameters}
    parameters = {f.name: {p.name for p in f.parameters} for f in FAMILIES.values() if f is not family}
    return [FAMILIES[name] for name, inputs in parameters.items() if {"ratio", "field"} <= inputs <= names]


def _calls(request: ReportRequest, family: Family) -> dict[str, str]:
    """Return {"body": "body", "field": "field"}, keys by which a block refers to the report's body and field.

    A key is left out where the family has no such parameter or takes it as an option; {} without a body.
    """
    return {
        key: key
        for key, name in (("body", "ratio"), ("field", "field"))
        if request.body and any(p.name == name and not p.option for p in family.parameters)
    }


def table_of(request: ReportRequest, table: str, family: str, values: Mapping[str, Any]) -> dict[str, Any]:
    """Return the block of the computed `table` of a family, a dict by key of the report file.

    `values` are the family's parameters by name.
    """
    unit = {"units": request.units} if request.units else {"time": request.time} if request.time != "time" else {}
    return {
        "kind": "table", "table": table, "id": f"{table}-{family}", **_calls(request, FAMILIES[family]),
        "digits": request.digits, "parameters": {"family": family, **values, **unit},
    }  # fmt: skip


def too_slow(motion: Any, time: str) -> Iterator[str]:
    """Yield at most one sentence, on a precession or nutation too small to be seen in a figure of some periods.

    `time` is the unit of time of the request. Nothing for a motion without a period.
    """
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
    request: ReportRequest, recipes_of: Mapping[str, Mapping[str, Any]], left_out: list[str]
) -> Iterator[dict[str, Any]]:
    """Yield a figure block, a dict by key of the report file, for each recipe of ``recipes_of``.

    ``recipes_of`` holds for each recipe its own parameters by name. Parameters that the request has are added. A recipe
    that refuses the parameters yields none, and a sentence with the reason is added to ``left_out``.
    """
    from atlas.bodies.units import system
    from atlas.pictures import recipes

    case, reasons = case_of(request), dict[str, list[str]]()
    for name, overrides in recipes_of.items():
        recipe = recipes.load(name)
        values = {key: value for key, value in request.values.items() if key in recipe.parameters} | dict(overrides)
        if recipe.parameters.get("unit") == "time":
            values["unit"] = request.time
        if request.units and "length" in recipe.parameters:
            values["length"] = system(request.units).length_unit
        parameters = {"ratio": case.ratio, "field": case.components} if request.body else {}
        try:
            recipe.scene(**{key: value for key, value in parameters.items() if key in recipe.parameters} | values)
        except AtlasError as reason:
            text = WITHOUT.get(name, str(reason).removeprefix(f"figure {name}: "))
            if text.startswith(f"figure {name} "):
                text = text.replace(f"figure {name}", f"The figure `{name}`")
            reasons.setdefault(text, []).append(f"`{name}`")
        else:
            calls = _calls(request, request.family) if "ratio" in recipe.parameters else {}
            yield {"kind": "figure", "recipe": name, "id": name.replace("_", "-"), **calls, "parameters": values}
    left_out += [
        text if text.startswith("The figure") else f"No figure {' and '.join(names)}: {text[:1].lower()}{text[1:]}"
        for text, names in reasons.items()
    ]


def case_of(request: ReportRequest) -> Any:
    """Return the `BodyAndField` of a request, its body and field with their units; both are None where it has none.

    Raises AtlasError for records that make no body or field.
    """
    body = convert(request.body, Body) if request.body else None
    return body_and_field(body, convert(request.field, Field) if request.field else None)


def closed_of(request: ReportRequest, left_out: list[str]) -> Iterator[dict[str, Any]]:
    """Yield the table block of the nearest closed motions; if they can't be computed add the reason to ``left_out``.

    Nothing is yielded for a family that has neither phi nor a precession per period.
    """
    if {"phi", "precession_per_period"} & {q.name for q in request.family.quantities}:
        block = table_of(request, "closed", request.family.name, request.exact_values)
        try:
            compute("closed", Request([case_of(request)], block["parameters"], request.digits))
        except AtlasError as reason:
            left_out.append(f"The nearest closed motions: {reason}")
        else:
            yield block


def records_of(request: ReportRequest) -> dict[str, Any]:
    """Return the table "parameters" of a report's head: its body and its field by kind, those that the request has.

    It is {"parameters": {"bodies": {"body": ...}, "fields": {"field": ...}}}, or {} without records.
    """
    records = (("bodies", "body", request.body), ("fields", "field", request.field))
    parameters = {kind: {name: record} for kind, name, record in records if record}
    return {"parameters": parameters} if parameters else {}
