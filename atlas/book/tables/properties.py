"""Tables of one object: all that the register has of it, in proven digits; a body in a field as it was given."""

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from atlas.arithmetic.certified_inputs import rational
from atlas.arithmetic.given import exact_number
from atlas.book.body_and_field import DIMENSIONS, GAUSSIAN_UNITS, BodyAndField
from atlas.book.digits import MINUS, Number, plain, significant
from atlas.book.tables.elementary import NONE
from atlas.book.tables.table import RATE, Data, Request, certified, heads, quantity
from atlas.errors import AtlasError, DomainError, unknown
from atlas.motions.register import FAMILIES, Family, Quantity
from atlas.trial.ledger import EQUATIONS

SPARE_BITS = 1 << 12
"""Extra bits of precision up to which certified digits are sought: a zero may have no proof."""
_LETTERS = re.compile(
    r"(?<![\w\\'])(?:(B)(')?(?![\w'])|(omega|Omega|alpha|beta|nu|mu|[A-Zcekmn])('?)_?(\d|(?<=_)i)(?!\w)"
    r"|(omega|Omega|alpha|beta|nu|mu|pi|prod|[A-Zb-z])(?![\w']))|(?<!\w)(-)(?= |\w)"
)
"""Letters in plain words: a vector B or B', one with an index, a Greek one, a single one; a minus."""
SPACE = "\\ "
"""A space that breaks no line, in Markdown."""
Row = tuple[str, str, str | Number, str, str, str]


@dataclass(frozen=True)
class FamilyObject:
    """An object of a family: parameters as given, and arguments of its classes in floats and in exact numbers.

    `numbers` holds numbers for the table by the parameter's name; `floats` and `exact` are the arguments in the
    family's order. `units` maps the register's units to others, and `described` is true if the inputs stand in a table.
    """

    family: Family
    numbers: Mapping[str, Any]
    floats: tuple[Any, ...]
    exact: tuple[Any, ...]
    units: Mapping[str, str]
    described: bool

    @classmethod
    def from_request(cls, request: Request) -> "FamilyObject":
        """Return the object of a request, whose parameters hold the family's name and its inputs, "time" or "units".

        Raises AtlasError for unknown or missing families and parameters.
        """
        surplus = dict(request.parameters)
        name, described = surplus.pop("family", None), surplus.pop("given", True)
        units = {"time": str(surplus.pop("time", "time"))} | _units(surplus.pop("units", None))
        if name not in FAMILIES:
            raise unknown("family", str(name), FAMILIES)
        family, case = FAMILIES[name], request.case
        numbers: dict[str, Any] = {}
        floats, exact = [], []
        for p in family.parameters:
            value: Any
            if p.name == "ratio":
                value, balls = case.body, case.exact
                numbers[p.name] = (
                    Number(plain(case.ratio)) if case.body_record and case.body_record.shape else case.ratio
                )
            elif p.name == "field" and not p.option:
                value = balls = case.exact_components
                numbers[p.name] = case.components
            else:
                if p.needed and p.name not in surplus:
                    raise AtlasError(f"parameters: the family {name!r} lacks {p.name!r}.")
                omitted = p.omitted if not p.columns else (p.omitted,) * len(p.names)
                numbers[p.name] = value = surplus.pop(p.name, omitted)
                if isinstance(value, list) and any(isinstance(x, str) for x in value):  # fractions
                    value = tuple(exact_number(rational(x, p.name)) for x in value)
                    numbers[p.name] = [*map(float, value)]
                balls = value
            floats.append(value)
            exact.append(balls)
        if surplus:
            raise unknown("parameter", next(iter(surplus)), [p.name for p in family.parameters], f"of {name!r}")
        return cls(family, numbers, tuple(floats), tuple(exact), units, bool(described))

    @property
    def says(self) -> str:
        """Description of the object as the beginning of a sentence; a body with a field of zeros is called free."""
        says = self.family.says
        if not any(self.numbers.get("field", (1.0,))):
            says = says.replace("charged ", "free ")
        return says[:1].upper() + says[1:]

    def kernels(self) -> Any:
        """Return the object, an instance of the family's class in doubles, made of its parameters as floats."""
        return self.family.kernels()(*self.floats)

    def balls(self) -> Any:
        """Return the object, an instance of the family's certified class, in balls, made of its exact parameters."""
        return self.family.balls()(*self.exact)

    def unit(self, unit: str) -> str:
        """Return a unit of the register as Markdown, with this object's names of units, such as "s^−1^" for 1/time."""
        words = unit
        for name, name_of_unit in self.units.items():
            words = words.replace(name, name_of_unit)
        if words.startswith("1/"):
            base, _, power = words[2:].partition("^")
            return f"{base}^{MINUS}{power or 1}^"
        return re.sub(r"\^(\d)", r"^\1^", words) or "1"


def _units(name: Any) -> dict[str, str]:
    """Return the units of a system by the register's names of dimensions, such as {"time": "s"}; {} for None.

    Raises AtlasError for an unknown system.
    """
    if name is None:
        return {}
    from atlas.bodies.units import system

    units = system(name)
    return {
        "time": "s", "length": units.length_unit, "charge/mass": units.mu_unit, "electric field": units.E_unit,
        "magnetic field": units.B_unit, "speed of light": "1" if units.c == 1 else f"{units.length_unit}/s",
    }  # fmt: skip


def properties(request: Request, item: FamilyObject) -> Data:
    """Return the table of parameters and quantities of one object of a `family`; `time` is its unit of time.

    A row has six cells: meaning, name, value, unit, equation, and what is proven. With ``given = false`` the inputs are
    left out. Why a quantity has no value stands below the table.
    """
    rows = [*_rows_given(item)] if item.described else []
    rows += [row for q in item.family.quantities for row in rows_of(item, q, request.digits)]
    names: dict[str, list[str]] = {}
    for _, name, value, _, _, reason in rows:
        if value is NONE:
            names.setdefault(reason, []).append(name)
    reasons = [f"{', '.join(symbols)}: {reason}." for reason, symbols in names.items()]
    rows = [(*row[:5], "") if row[2] is NONE else row for row in rows]
    heading = "what is given, and what follows" if rows else "what follows"
    return Data(
        heads("Quantity", "Name", "Value", "Unit", "Equation", "Proven"),
        tuple(rows),
        f"{lettered(item.says)}: {heading}.",
        ("Given numbers are rounded to doubles, then exact.", *reasons),
    )  # fmt: skip


def _rows_given(item: FamilyObject) -> Iterator[Row]:
    """Yield six cells for each component of each input: words, name, value, unit, "", "given"."""
    for p in item.family.parameters:
        value = item.numbers[p.name]
        components = value if p.columns else (value,)
        for place, (name, component) in enumerate(zip(p.names, components, strict=True)):
            if component is not None:
                number = component if isinstance(component, Number) else Number.as_given(component)
                says = "" if place else re.split("[.;]", p.says)[0]
                yield lettered(says), f"`{name}`", number, item.unit(p.unit), "", "given"


def rows_of(item: FamilyObject, q: Quantity, digits: int) -> Iterator[Row]:
    """Yield six cells for each component of a quantity: meaning, name, value, unit, equation, what is proven.

    A quantity without a value has one row with a dash and the reason in the last cell. `item` is the object,
    `digits` the number of significant digits.
    """
    try:
        texts = _texts(item, q, digits)
    except DomainError as reason:
        yield lettered(q.says), f"`{q.name}`", NONE, "", cited(q.equation), str(reason).removesuffix(".")
        return
    if texts is None:
        yield lettered(q.says), f"`{q.name}`", "none", "", cited(q.equation), "exactly"
        return
    case = item.family.case(item.kernels()) if q.cases else ""
    says, equation = q.cases.get(case, (q.says, q.equation))
    says = f"{q.name} {says}" if says.startswith("of ") else says
    for place, (name, words, text) in enumerate(_components(q, texts)):
        value, certainty = _printed(item, q, text, place if isinstance(texts, list | tuple) else None, digits)
        unit = item.unit(q.unit) if isinstance(value, Number) else ""
        yield (
            lettered(words or ("" if place else says)),
            f"`{name}`",
            value,
            unit,
            "" if place else cited(equation),
            certainty,
        )


def _texts(item: FamilyObject, q: Quantity, digits: int) -> Any:
    """Return the certified values of a quantity as texts, nested as the quantity is; None where it has none.

    A quantity without certified digits is returned in doubles. Raises DomainError where it is not defined. `item`
    is the object, `digits` the number of significant digits.
    """
    from atlas.arithmetic.certified_digits import certified

    if not (q.certified or q.printed or q.checked):
        return q.value(item.kernels())  # of kernels alone
    exact = item.balls()
    return certified(lambda: q.value(exact, exact=True), digits, spare=SPARE_BITS)


def _components(q: Quantity, values: Any) -> Iterable[tuple[str, str, Any]]:
    """Return (name, further words, text) for each component of a quantity from its `values`; one for a scalar."""
    if not isinstance(values, list | tuple):
        return [(q.name, "", values)]
    numbered = [f"{q.name}[{i}]" for i in range(len(values))]
    if q.name == "roots" or (values and isinstance(values[0], list | tuple)):
        components = [q.text(component if q.lines else [component]) for component in values] or [q.text(values)]
        symbols = [symbol for symbol, _ in q.lines] or numbered or [q.name]
        return [(name, "", component) for name, component in zip(symbols, components, strict=True)]
    names, subject = q.columns or numbered, q.symbol or q.says
    words = [says for _, says in q.lines] or [f"{subject}: {name}" if q.columns else "" for name in names]
    return zip(names, words, values, strict=True)


def _printed(item: FamilyObject, q: Quantity, text: Any, place: int | None, digits: int) -> tuple[str | Number, str]:
    """Return (value as a `Number` or text, words on its certainty) of a component's certified text.

    A value whose digits are not certified comes from the class in doubles. `place` is its index in the quantity, or
    None. `item` is the object, `digits` the number of significant digits asked for.
    """
    from atlas.arithmetic.certified_digits import MARK, NOT_CERTIFIED, ZERO_WITHIN

    if text == NOT_CERTIFIED:
        value = q.value(item.kernels())
        value = value if place is None else value[place]
        value = value[0] if q.name == "roots" else value  # real, or its text would have an i
        promise = item.family.promises.get(q.checked)
        promised = f"{promise:g} ulp promised" if promise else "not certified"
        return Number(plain(value), proven=False), f"float, {promised}"
    if not re.fullmatch(r"-?\d[\d.]*(e[+-]\d+)?\??", text):
        certainty = NOT_CERTIFIED if NOT_CERTIFIED in text else f"{digits}{SPACE}digits each"
        certainty = "proven" if text.startswith(ZERO_WITHIN) else certainty
        return re.sub(r"-(?=\d)", MINUS, text), certainty if re.search(r"\d", text) else "exactly"
    proven = text.removesuffix(MARK)
    if text == "0":
        return Number("0"), "exactly"
    count = significant(proven)
    return Number(proven), f"{count}{SPACE}digits" + ", no more" * (MARK in text and count < digits)


def lettered(words: str) -> str:
    """Return plain words of the register in Markdown, letters such as omega'_3, B2, beta as formulas."""
    return re.sub(rf"\^({MINUS}?\d)", r"^\1^", _LETTERS.sub(_letter, words))


def _letter(matched: re.Match[str]) -> str:
    vector, prime, name, primed, place, symbol, minus = matched.groups()
    if minus:
        return MINUS
    if vector:
        return rf"$\mathbf{{{vector}}}{prime or ''}$"
    letter = name or symbol
    return f"${'' if len(letter) == 1 else chr(92)}{letter}{primed or ''}{f'_{place}' if place else ''}$"


def cited(equations: str) -> str:
    """Return equations, names separated by commas, as citations in Markdown.

    Names that the ledger lacks are left out.
    """
    return ", ".join(f"@{name}" for name in equations.split(", ") if name in EQUATIONS)


def body_and_field(request: Request) -> Data:
    """Return the table of a body: dimensions, mass, charge, fields; I, moments, mu and B' from these, (32), (33).

    A row has words, letter, value, unit, and "given" or "follows". Raises AtlasError without a body or without a field.
    """
    case = request.case
    body, field = case.body_record, case.field_record
    if body is None or field is None:
        raise AtlasError("this table needs a body and a field.")
    rows = [(words, symbol, Number.as_given(value), unit, "given") for words, symbol, value, unit in _described(case)]
    rows += [
        (words, symbol, quantity(value, request.digits), unit, "follows")
        for words, symbol, value, unit in _derived(case, request.digits)
    ]
    return Data(
        heads("Quantity", "Symbol", "Value", "Unit", ""),
        tuple(rows),
        f"The {body.title} in the {field.title}, and what follows from them by @(32) and @(33).",
        (
            "The moments and $I$ are proven to the last digit printed.",
            r"$\mu$ and $\mathbf{B}'$ are rounded once, to the nearest double.",
            "All further numbers of this report take that double as exact.",
        ),
    )


def _described(case: BodyAndField) -> Iterator[tuple[str, str, float, str]]:
    """Yield (words, symbol, value, unit) of each given dimension of the body, and of the components of B and E.

    The field only where it is given as B; words stand at the first of three components.
    """
    for key, (words, symbol, unit) in DIMENSIONS.items():
        value = getattr(case.body_record, key)
        if value is not None:
            yield words, symbol, value, _unit_of(case, unit)
    if case.physical is not None and case.units is not None:
        for words, letter, vector, unit in (
            ("magnetic field", "B", case.physical.B, case.units.B_unit),
            ("electric field", "E", case.physical.E, case.units.E_unit),
        ):
            for j, component in enumerate(vector, 1):
                yield words if j == 1 else "", f"${letter}_{j}$", float(component), unit


def _unit_of(case: BodyAndField, unit: str) -> str:
    """Return a unit of a body's dimension, given in SI, or the Gaussian one of a charged body in a Gaussian field."""
    is_charged = case.body_record is not None and case.body_record.charge is not None
    is_gaussian = is_charged and case.units is not None and case.units.mu_unit == "statC/g"
    return GAUSSIAN_UNITS[unit] if is_gaussian else unit


def _derived(case: BodyAndField, digits: int) -> Iterator[tuple[str, str, Any, str]]:
    """Yield (words, symbol, value, unit) of moments, their ratio, the charge-to-mass ratio and B'.

    The moments, balls, only for a body given by its shape; the ratio mu only for a field given as B. The moments
    have radii for `digits` digits.
    """
    from atlas.bodies.certified_body import ratio_of

    exact = case.exact
    if case.body_record is not None and case.body_record.shape:
        I2, I3 = certified(lambda: (exact.I2, exact.I3), digits)
        unit = _unit_of(case, "kg m$^2$")
        yield "moment of inertia", "$I_2$", I2, unit
        yield "", "$I_3$", I3, unit
    yield "ratio of the moments", "$I=I_3/I_2$", certified(lambda: ratio_of(exact), digits), "1"
    if case.physical is not None and case.units is not None:
        yield "charge-to-mass ratio", r"$\mu$", case.physical.mu, case.units.mu_unit
    B2, B3 = case.components
    yield "field as a frequency", "$B'_2$", B2, RATE
    yield "", "$B'_3$", B3, RATE
