"""Inputs of a report: declared in the table [inputs] of its head, given as text, read by their kinds."""

import math
import re
from collections.abc import Iterator, Mapping
from fractions import Fraction
from hashlib import sha256
from pathlib import Path
from typing import Any, Literal

import msgspec

from atlas.book import files, toml
from atlas.book.expansion import ExpansionError, expanded
from atlas.book.schema import StrictStruct, TwoNumbers, faults_of
from atlas.errors import AtlasError, FaultsError, unknown
from atlas.measured import in_unit, split

TRUTH = {"true": True, "false": False}
"""Texts of an input that is true or false."""


class Input(StrictStruct, frozen=True):
    """An input of a report: its kind, unit, range or choices, default (required without one), and a line of help.

    `range` has its least and largest value, in its `unit` ("" for none); `choices` are the texts that a "choice"
    may be; `count` is how many numbers an input of the kind "numbers" takes, None for any number.
    """

    kind: Literal["number", "integer", "numbers", "text", "choice", "truth"]
    help: str = ""
    unit: str = ""
    range: TwoNumbers | None = None
    choices: tuple[str, ...] = ()
    count: int | None = None
    default: Any = None

    @property
    def takes(self) -> str:
        """Text of the kind, unit, range and choices, such as "number, in T, from 0 to 2"."""
        phrases = [self.kind if self.count is None else f"{self.count} numbers"]
        phrases += [f"in {self.unit}"] * bool(self.unit)
        phrases += [f"from {self.range[0]:g} to {self.range[1]:g}"] if self.range else []
        phrases += [f"one of {', '.join(self.choices)}"] * bool(self.choices)
        return ", ".join(phrases)


def declared(path: Path) -> dict[str, Input]:
    """Return the `Input` declarations of a report by name; {} where its head declares none.

    Raises
    ------
    AtlasError
        For a head that is no TOML; and for all malformed declarations, and names that are no words or that templates
        use, each in a line.
    """
    tables = files.head(path).get("inputs", {})
    if not isinstance(tables, dict):
        raise AtlasError(
            f"{path}, line {line_of(path, 'inputs')}: inputs: write a table [inputs], a line for each input."
        )
    faults = [
        (name, f"{str(fault).removesuffix('.')}.")
        for name, table in tables.items()
        for fault in faults_of(table, Input, f"inputs {name!r}")
    ]
    faults += [
        (name, f"the input {name!r} must be a word of letters, digits and _ that templates do not use themselves.")
        for name in tables
        if not name.isidentifier() or name in {"true", "false", "none", "loop", "self", "range"}
    ]
    if faults:
        raise FaultsError(f"{path}, line {line_of(path, key)}: {says}" for key, says in faults)
    return msgspec.convert(tables, dict[str, Input])


def evaluated(path: Path, texts: Mapping[str, str]) -> dict[str, Any]:
    """Return the value of each input of a report by name: from its text in `texts`, or else its default.

    Values are as `read` returns them.

    Raises
    ------
    AtlasError
        For all unknown names, missing inputs, and wrong kinds, units and ranges at once, each in a line.
    """
    inputs, values = declared(path), dict[str, Any]()
    faults = [(name, str(unknown("input", name, inputs))) for name in texts if name not in inputs]
    for name, declaration in inputs.items():
        default = text_of(declaration.default) if declaration.default is not None else None
        text = texts.get(name, default)
        if text is None:
            faults.append((name, f"it is required; give it by --set {name}=VALUE, {declaration.takes}."))
            continue
        try:
            values[name] = read(declaration, text)
        except AtlasError as fault:
            faults.append((name, f"{text!r} {fault}" if str(fault).startswith("is") else f"{text!r}: {fault}"))
    if faults:
        raise FaultsError(f"{path}, line {line_of(path, name)}: input {name}: {says}" for name, says in faults)
    return values


def read(declaration: Input, text: str) -> Any:
    """Return the value of a text for an input: a float, int, list of floats, text or boolean, by its kind.

    Raises AtlasError for a text that does not suit the kind, unit, range or choices.
    """
    if declaration.kind == "text":
        if not text.isprintable():
            raise AtlasError("is no text of one line; leave out its control characters.")
        return text
    if declaration.kind in {"truth", "choice"}:
        choices = declaration.choices or tuple(TRUTH)
        if text not in choices:
            raise unknown("choice", text, choices)
        return text if declaration.choices else TRUTH[text]
    if declaration.kind == "numbers":
        words = re.split(r"[,\s]+", text.strip(" ()[]"))
        if declaration.count not in {None, len(words)}:
            raise AtlasError(f"is {len(words)} numbers; write {declaration.count}, as 1,2,3.")
        return [number(declaration, word) for word in words]
    value = number(declaration, text)
    if declaration.kind == "integer":
        if not value.is_integer():
            raise AtlasError("is no integer; write it without a fraction.")
        return int(value)
    return value


def number(declaration: Input, text: str) -> float:
    """Return a typed number, such as "1.5", "3/2" or "2mT", as a float in the unit of an input.

    A number without a unit is in that unit. Raises AtlasError for a text that is no finite number, for a unit of
    another dimension, and for a number out of the input's range.
    """
    amount, unit = split(text) or (text, declaration.unit)
    try:
        size = Fraction(amount)
        value = in_unit(size, unit, declaration.unit) if unit != declaration.unit else float(size)
    except AtlasError:
        raise
    except (ValueError, ZeroDivisionError, OverflowError):
        raise AtlasError("is no finite number; write 1.5, 3/2 or 1e-3, and a unit behind it.") from None
    if not math.isfinite(value):
        raise AtlasError("is beyond the largest float; write a smaller number.")
    if declaration.range and not declaration.range[0] <= value <= declaration.range[1]:
        low, high = declaration.range
        raise AtlasError(f"is out of range; write a number from {low:g} to {high:g} {declaration.unit}".rstrip() + ".")
    return value


def text_of(value: Any) -> str:
    """Return an input's value or default as the text that would be typed for it: "1,2" for a list, "true" for True."""
    if isinstance(value, list):
        return ",".join(map(text_of, value))
    return str(value).lower() if isinstance(value, bool) else str(value)


def line_of(path: Path, name: str) -> int:
    """Return the line, from 1, where a head declares an input; for an unknown one the line of [inputs], else 1."""
    lines = files.text_of(path).split("\n")
    patterns = (rf"\s*(\[inputs\.{re.escape(name)}\]|{re.escape(name)}\s*=)", r"\s*\[?inputs\b")
    matches = (k for pattern in patterns for k, line in enumerate(lines, 1) if re.match(pattern, line))
    return next(matches, 1)


def digest(values: Mapping[str, Any]) -> str:
    """Return eight hexadecimal digits of the SHA-256 of the inputs' values by name, in whatever order."""
    return sha256("".join(toml.lines(dict(sorted(values.items())))).encode()).hexdigest()[:8]


def name_of(path: Path, values: Mapping[str, Any]) -> str:
    """Return the report's name: that of its file, with "-" and the digest of the values unless all are defaults.

    `values` are those of all inputs, by name.
    """
    inputs = declared(path)
    defaults = {
        name: read(declaration, text_of(declaration.default))
        for name, declaration in inputs.items()
        if declaration.default is not None
    }
    return path.stem if dict(values) == defaults else f"{path.stem}-{digest(values)}"


def filled(text: str, values: Mapping[str, Any], *, markdown: bool) -> tuple[dict[str, Any], str, list[int]]:
    """Return (head, text, lines) of a report with the inputs' `values`, by name, filled in.

    `head` is a dict, the text the whole file if `markdown`, and `lines` holds the line in the file of each line of
    text.

    Raises
    ------
    LineError
        For a mistake in a template, with its line in the file.
    """
    from atlas.book.markdown import LineError

    head = toml.loads(files.head_of(text) if markdown else text)
    inputs = head.pop("inputs")
    end = text.index(f"\n{files.RULE}", 1) + 1 if markdown else len(text)
    above, body = text[:end], text[end:]
    start = above.count("\n")
    try:
        head, body, lines = expanded(values, head, body)
    except ExpansionError as error:
        line = start + error.line if error.line else text[: max(text.find(error.text), 0)].count("\n") + 1
        raise LineError(line, f"{str(error).removesuffix('.')}.") from error
    return {**head, "inputs": inputs}, above + body, [*range(1, start + 1), *(start + line for line in lines)]


def records(path: Path) -> Iterator[dict[str, Any]]:
    """Yield a dict for each input of a report, with name, kind, unit, range, choices, default and help."""
    for name, declaration in declared(path).items():
        yield {"name": name} | {key: getattr(declaration, key) for key in declaration.__struct_fields__}
