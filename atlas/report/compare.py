"""Two built reports compared by what their builds recorded: numbers, words, figures, and what came or went.

Numbers are decimal texts and are compared exactly, whatever signs and spaces they are printed with; prose is compared
by its digest, pictures by theirs.
"""

import re
from collections.abc import Hashable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from decimal import MAX_EMAX, MIN_EMIN, Context, Decimal
from itertools import takewhile
from pathlib import Path
from typing import Any

import msgspec

from atlas.report.manifest import BuiltReport, FigureEntry, TableEntry, read

SPACES = dict.fromkeys(map(ord, "\u00a0\u2007\u2009\u200a\u202f"))
NUMBER = re.compile(
    r"(?P<digits>[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+))"
    r"(?:e(?P<e>[+-]?[0-9]{1,15})| *[×·] *10(?:\^\{?(?P<ten>[+-]?[0-9]{1,15})\}?|(?P<raised>[⁺⁻]?[⁰¹²³⁴⁵⁶⁷⁸⁹]{1,15})))?"
    r"(?P<mark>\??)",
    re.IGNORECASE,
)
"""A decimal with a power of ten that Decimal can hold, and the mark of a number that lacks proven digits."""
LOWERED = str.maketrans("⁺⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "+-0123456789")


@dataclass(frozen=True)
class Amount:
    """By how much a number changed.

    `difference` is new - old, exact unless the two are many powers of ten apart; `relative` is its size over that of
    old, None for old = 0. `digits` counts the leading digits, of those that both print, in which they agree: they are
    the same or, across a carry such as 0.9999 and 1.0001, the numbers lie within half a unit of the last of them.
    """

    difference: Decimal
    relative: Decimal | None
    digits: int


@dataclass(frozen=True)
class ChangedCell:
    """A cell of a table that changed; with an amount when both are numbers."""

    table: str
    page: str
    row: str
    column: str
    unit: str
    old: str
    new: str
    amount: Amount | None


@dataclass(frozen=True)
class Change:
    """Anything else that changed: what it belongs to, what it is, and both texts where there are any."""

    where: str
    what: str
    old: str = ""
    new: str = ""


@dataclass(frozen=True)
class Drawing:
    """A figure that changed, came or went."""

    id: str
    old: FigureEntry | None
    new: FigureEntry | None
    changes: tuple[Change, ...]


@dataclass(frozen=True)
class Comparison:
    """All that differs between two reports."""

    old: BuiltReport
    new: BuiltReport
    cells: tuple[ChangedCell, ...]
    figures: tuple[Drawing, ...]
    others: tuple[Change, ...]

    @property
    def numbers(self) -> tuple[ChangedCell, ...]:
        """The cells that are numbers in both reports."""
        return tuple(cell for cell in self.cells if cell.amount is not None)

    @property
    def words(self) -> tuple[ChangedCell, ...]:
        """The cells that are not."""
        return tuple(cell for cell in self.cells if cell.amount is None)

    @property
    def changed(self) -> bool:
        """Whether anything differs."""
        return bool(self.cells or self.figures or self.others)

    @property
    def extent(self) -> str:
        """How much was compared, in words."""
        manifest = self.new.manifest
        counts = {"table": len(manifest.tables), "figure": len(manifest.figures), "page": len(manifest.pages)}
        return ", ".join(f"{count} {name}{'s' * (count != 1)}" for name, count in counts.items())

    @property
    def notes(self) -> tuple[str, ...]:
        """What the reader should know of the two folders."""
        return tuple(note for note in (self.old.damage(), self.new.damage()) if note)


def compare(old: Path, new: Path) -> Comparison:
    """Compare two built reports; raise AtlasError, in one sentence, where there is none."""
    one, two = read(old), read(new)
    a, b = one.manifest, two.manifest
    cells: list[ChangedCell] = []
    others = [*_changes("report", _facts(a, "title", "name"), _facts(b, "title", "name"))]
    for slug, page, after in _paired(a.pages, b.pages):
        others += _changes(f"page {slug}", _facts(page, "title"), _facts(after, "title"))
        if page and after and page.text != after.text:
            others.append(Change(f"page {slug}", "text"))
    for name, table, then in _paired(a.tables, b.tables):
        others += _changes(name, _facts(table, "caption", "page"), _facts(then, "caption", "page"))
        if table and then:
            others += _columns(name, table, then)
            found, moved = _rows(name, table, then)
            cells += found
            others += moved
    others += _changes("versions", a.versions, b.versions)
    figures = [
        Drawing(name, figure, then, changes)
        for name, figure, then in _paired(a.figures, b.figures)
        if (changes := tuple(_figure(name, figure, then)))
    ]
    return Comparison(one, two, tuple(cells), tuple(figures), tuple(others))


def number(text: str) -> tuple[Decimal, bool] | None:
    """Return a printed number exactly, and whether it lacks proven digits; None for words."""
    plain = text.translate(SPACES).replace("\N{MINUS SIGN}", "-").replace(r"\times", "×").strip().strip("$")
    match = NUMBER.fullmatch(plain)
    if match is None:
        return None
    power = match["e"] or match["ten"] or (match["raised"] or "0").translate(LOWERED)
    return Decimal(f"{match['digits']}e{power}"), bool(match["mark"])


def amount(old: Decimal, new: Decimal) -> Amount:
    """Measure the change of a number."""
    digits, others = old.as_tuple().digits, new.as_tuple().digits
    printed = min(len(digits), len(others))
    context = Context(prec=len(digits) + len(others) + 30, Emin=MIN_EMIN, Emax=MAX_EMAX)
    difference = context.subtract(new, old)
    if not difference:
        return Amount(difference, difference if old else None, printed)
    same = 0
    if old.is_signed() == new.is_signed() and old.adjusted() == new.adjusted():
        same = agreeing(digits, others)
    size = context.abs(difference)
    near = context.max_mag(old, new).adjusted() - context.add(size, size).adjusted()
    relative = context.divide(size, context.abs(old)) if old else None
    return Amount(difference, relative, min(max(same, near, 0), printed))


def agreeing(old: Iterable[Any], new: Iterable[Any]) -> int:
    """Count the leading items that are the same."""
    return sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], zip(old, new, strict=False)))


def _columns(name: str, old: TableEntry, new: TableEntry) -> Iterator[Change]:
    """Go through the columns that came, went or changed their unit or place."""
    before, after = _heads(old), _heads(new)
    for key, i, j in _paired(before, after):
        if i is None or j is None:
            yield Change(name, "column added", "", key[0]) if i is None else Change(name, "column removed", key[0])
        elif old.units[i] != new.units[j]:
            yield Change(name, f"unit of {key[0]}", old.units[i], new.units[j])
    if [key for key in before if key in after] != [key for key in after if key in before]:
        yield Change(name, "order of columns")


def _rows(name: str, old: TableEntry, new: TableEntry) -> tuple[list[ChangedCell], list[Change]]:
    """Compare the rows of a table in the columns that both have."""
    before, after = _heads(old), _heads(new)
    shared = [key for key in before if key in after]
    left = [[row[before[key]] for key in shared] for row in old.rows]
    right = [[row[after[key]] for key in shared] for row in new.rows]
    pairs = _matched(left, right)
    cells = [
        ChangedCell(name, new.page, label, key[0], new.units[after[key]], x, y, found)
        for i, (j, depth) in sorted(pairs.items())
        for label in [", ".join(filter(None, left[i][:depth])) or next(filter(None, left[i]), f"row {i + 1}")]
        for key, x, y in zip(shared, left[i], right[j], strict=True)
        for differs, found in [_cell(x, y)]
        if differs
    ]
    taken = [j for _, (j, _) in sorted(pairs.items())]
    moved = [Change(name, "row removed", " | ".join(row)) for i, row in enumerate(old.rows) if i not in pairs]
    moved += [Change(name, "row added", "", " | ".join(row)) for j, row in enumerate(new.rows) if j not in taken]
    return cells, moved + [Change(name, "order of rows")] * (taken != sorted(taken))


def _matched(left: list[list[str]], right: list[list[str]]) -> dict[int, tuple[int, int]]:
    """Pair rows: for a row of the left one on the right, and how many of its first cells tell it apart.

    A row is known by its first cell; where several share it, by as many of the cells that follow as are needed. What
    is left is paired where it stands at the same place.
    """
    pairs: dict[int, tuple[int, int]] = {}
    width = len(left[0]) if left else 0
    for depth in range(1, width + 1):
        ours = _places(left, depth, set(pairs))
        theirs = _places(right, depth, {j for j, _ in pairs.values()})
        for key, places in ours.items():
            others = theirs.get(key, [])
            if depth == width or len(places) == len(others) == 1:
                pairs |= {i: (j, depth) for i, j in zip(places, others, strict=False)}
    taken = {j for j, _ in pairs.values()}
    return pairs | {i: (i, 1) for i in range(min(len(left), len(right))) if i not in pairs and i not in taken}


def _places(rows: list[list[str]], depth: int, without: set[int]) -> dict[Hashable, list[int]]:
    """Return where the rows with the same first cells stand."""
    places: dict[Hashable, list[int]] = {}
    for i, row in enumerate(rows):
        if i not in without:
            key = tuple(found[0] if (found := number(cell)) else cell for cell in row[:depth])
            places.setdefault(key, []).append(i)
    return places


def _cell(old: str, new: str) -> tuple[bool, Amount | None]:
    """Tell whether two cells differ, and by how much; signs and spaces of another kind are no difference."""
    one, two = number(old), number(new)
    if one is None or two is None:
        return old != new, None
    same = one[0].as_tuple() == two[0].as_tuple() and one[1] == two[1]
    return not same, amount(one[0], two[0])


def _heads(table: TableEntry) -> dict[tuple[str, int], int]:
    """Return the place of each column by its head and by how many columns before it have the same."""
    return {(head, table.columns[:i].count(head)): i for i, head in enumerate(table.columns)}


def _figure(name: str, old: FigureEntry | None, new: FigureEntry | None) -> Iterator[Change]:
    """Go through what changed about a figure."""
    names = ("caption", "page", "recipe", "renderer")
    yield from _changes(name, _facts(old, *names), _facts(new, *names))
    if old and new:
        yield from _changes(name, old.parameters, new.parameters)
        if old.sha256 != new.sha256:
            states = ["drawn" if figure.file else "failed" for figure in (old, new)]
            yield Change(name, "picture", *(states if "failed" in states else ()))


def _changes(where: str, old: Mapping[str, Any] | None, new: Mapping[str, Any] | None) -> Iterator[Change]:
    """Go through the values that differ; without one of the two, the thing was added or removed, with its first."""
    if old is None or new is None:
        first = str(next(iter((old or new or {}).values())))
        yield Change(where, "added", "", first) if old is None else Change(where, "removed", first)
        return
    for what, x, y in _paired(old, new):
        if x != y:
            yield Change(where, what, _text(x), _text(y))


def _facts(thing: Any, *names: str) -> dict[str, Any] | None:
    return None if thing is None else {name: getattr(thing, name) for name in names}


def _paired(old: Mapping[Any, Any], new: Mapping[Any, Any]) -> Iterator[tuple[Any, Any, Any]]:
    """Go through the keys of both, with None where there is no such key."""
    for key in {**old, **new}:
        yield key, old.get(key), new.get(key)


def _text(value: Any) -> str:
    if value is None or isinstance(value, str):
        return value or ""
    return msgspec.json.encode(value).decode()
