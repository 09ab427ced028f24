"""Two built reports compared by what their builds wrote down: numbers, figures, words and versions."""

from collections.abc import Iterator, Mapping
from decimal import MAX_EMAX, MIN_EMIN, Context, Decimal, InvalidOperation
from typing import Any, NamedTuple

from atlas.report.manifest import FigureEntry, Manifest

SPACES = {**dict.fromkeys(map(ord, "\u00a0\u2007\u2009\u200a\u202f")), ord("\N{MINUS SIGN}"): "-"}


class Change(NamedTuple):
    """What changed: of which kind it is, where it stands, and both texts where there are any.

    Of a number `difference` is new - old, and `relative` its size over that of old, None for old = 0.
    """

    kind: str
    where: str
    old: str = ""
    new: str = ""
    difference: Decimal | None = None
    relative: Decimal | None = None


def compare(old: Manifest, new: Manifest) -> list[Change]:
    """Return all that changed, numbers first."""
    found: list[Change] = []
    for table, before, after in _paired(old.numbers, new.numbers):
        cells = (_number(f"{table}: {cell}", x, y) for cell, x, y in _paired(before or {}, after or {}))
        found += (cell for cell in cells if cell.old != cell.new)
    for name, one, two in _paired(old.figures, new.figures):
        found += _figure(name, one, two)
    for where, x, y in _paired({"title": old.title, **old.words}, {"title": new.title, **new.words}):
        if x != y:
            found.append(Change("words", where + " (added)" * (x is None) + " (removed)" * (y is None)))
    found += (Change("version", name, x or "", y or "") for name, x, y in _paired(old.versions, new.versions) if x != y)
    return found


def _figure(name: str, old: FigureEntry | None, new: FigureEntry | None) -> Iterator[Change]:
    """Go through what changed about a figure; its picture alone may, with the code that draws it."""
    if old is None or new is None:
        yield Change("figure", name, old.recipe if old else "", new.recipe if new else "")
        return
    given = ({"recipe": one.recipe, "renderer": one.renderer, **one.parameters} for one in (old, new))
    for key, x, y in _paired(*given):
        if x != y:
            yield Change("figure", f"{name}: {key}", _text(x), _text(y))
    if old.sha256 != new.sha256:
        before, after = ("drawn" if one.sha256 else "failed" for one in (old, new))
        yield Change("figure", f"{name}: picture", before, after)


def _number(where: str, old: str | None, new: str | None) -> Change:
    """Compare two numbers as printed, exactly; signs and spaces of another kind are no difference."""
    one, two = (None if text is None else text.translate(SPACES) for text in (old, new))
    try:
        x, y = (Decimal((text or "").rstrip("?")) for text in (one, two))
    except InvalidOperation:  # one of them came, went, or has no proven digit
        return Change("number", where, one or "", two or "")
    context = Context(prec=len(x.as_tuple().digits) + len(y.as_tuple().digits) + 30, Emin=MIN_EMIN, Emax=MAX_EMAX)
    difference = context.subtract(y, x)
    relative = context.abs(context.divide(difference, x)) if x else None
    return Change("number", where, str(one), str(two), difference, relative)


def _paired(old: Mapping[str, Any], new: Mapping[str, Any]) -> Iterator[tuple[str, Any, Any]]:
    """Go through the names of both, with None where there is no such name."""
    for name in {**old, **new}:
        yield name, old.get(name), new.get(name)


def _text(value: Any) -> str:
    return "" if value is None else str(value)
