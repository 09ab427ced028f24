"""Report files in Markdown: a head in TOML, a page below each ``#`` heading, fenced blocks.

All else is text, which reaches pandoc letter by letter. The file is split line by line and not by pandoc, whose trees
of this Markdown hold neither the lines that a message has to name nor the text as it was typed.
"""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from atlas.book import toml
from atlas.book.blocks import KINDS
from atlas.book.files import RULE
from atlas.errors import AtlasError, unknown

FENCED = [kind for kind in KINDS if kind != "prose"]
"""The kinds of blocks that stand in fences; all other text is prose."""
_FENCE = re.compile(r" {0,3}(`{3,})([^`]*)")
_KIND = re.compile(r"\{([\w-]+)\}")
_PAGE = re.compile(r"#[ \t]+(.*)")


class LineError(AtlasError):
    """Error LineError(line, sentence) about a line of the file; the field `line`, not in the text, counts from 1."""

    def __init__(self, line: int, sentence: str) -> None:
        super().__init__(sentence)
        self.line = line


@dataclass(frozen=True)
class Piece:
    """A run of lines: a text (kind ""), a heading ("#"), a block of some kind, or the head.

    `line` counts from 1: the first line, or the opening fence of a block or head, which is not among `lines`.
    """

    kind: str
    line: int
    lines: tuple[str, ...]

    @property
    def text(self) -> str:
        """The lines as one text, without empty lines before and after."""
        return "\n".join(self.lines).strip("\n")

    def values(self) -> dict[str, Any]:
        """Return the lines parsed as TOML, values by key.

        Raises LineError, with the line in the file, if they are not TOML.
        """
        try:
            return toml.loads("\n" * self.line + "\n".join(self.lines))
        except ValueError as error:
            values = re.fullmatch(r"(.*) \(at (?:line (\d+), column \d+|end of document)\)", str(error))
            reason, line = values.groups() if values else (str(error), None)
            line = int(line or self.line + len(self.lines))
            raise LineError(line, f"this is not TOML: {reason}.") from error


def split(text: str) -> tuple[Piece, Iterator[Piece]]:
    """Return (head of a report in Markdown, iterator over the pieces below), all of them `Piece`s.

    Raises LineError for a head or block that does not end.
    """
    lines = text.split("\n")
    end = next((number for number, line in enumerate(lines[1:], 1) if line.rstrip() == RULE), None)
    if lines[0].rstrip() != RULE or end is None:
        raise LineError(1, f"a report begins with its head, lines of TOML between two lines {RULE}.")
    return Piece("head", 1, tuple(lines[1:end])), _pieces(lines, end + 1)


def _pieces(lines: list[str], start: int) -> Iterator[Piece]:
    """Yield the `Piece`s of `lines` from the index `start` on: headings, texts and blocks.

    A fence without a kind in braces is code and belongs to the text. Raises LineError for a fence that does not end.
    """
    number, begin, text = start, start, list[str]()
    while number < len(lines):
        mark, heading = _FENCE.fullmatch(lines[number]), _PAGE.fullmatch(lines[number])
        named, end = (_KIND.fullmatch(mark[2].strip()), _end(lines, number, mark[1])) if mark else (None, number)
        if heading or named:
            yield Piece("", begin, tuple(text))
            text = []
        if heading:
            yield Piece("#", number + 1, (heading[1],))
        elif named:
            yield Piece(named[1], number + 1, tuple(lines[number + 1 : end]))
        else:
            begin = begin if any(text) else number + 1
            text += lines[number : end + 1]
        number = end + 1
    yield Piece("", begin, tuple(text))


def _end(lines: list[str], opening: int, fence: str) -> int:
    """Return the index, from 0, of the line that closes the fence which the line `opening` begins with `fence`.

    Raises LineError if a block begins before that line, or if none closes it.
    """
    for number, line in enumerate(lines[opening + 1 :], opening + 1):
        mark = _FENCE.fullmatch(line)
        if mark and mark[1].startswith(fence) and not mark[2].strip():
            return number
        if mark and mark[1].startswith(fence) and _KIND.fullmatch(mark[2].strip()):
            break
    raise LineError(opening + 1, f"{lines[opening].strip()} does not end: close it with a line {fence}.")


def read(text: str) -> tuple[dict[str, Any], dict[tuple[int, ...], Piece]]:
    """Return (values of a Markdown report, a dict as that of a report in TOML; its pieces).

    Keys of the pieces are () for the head, (page,) and (page, block), from 0. Raises LineError for a mistake.
    """
    head, remainder = split(text)
    report, places = head.values(), dict[tuple[int, ...], Piece]({(): head})
    pages: list[dict[str, Any]] = []
    if "pages" in report:
        raise LineError(1, "the head holds no pages: each begins with a heading of its own, a line '# Title'.")
    for piece in remainder:
        page = (len(pages) - 1,)
        if piece.kind == "#":
            slug = re.sub(r"[^a-z0-9]+", "-", piece.text.lower()).strip("-") if pages else "index"
            places[len(pages),] = piece
            pages.append({"slug": slug, "title": piece.text, "blocks": []})
        elif not piece.kind and not piece.text.strip():
            continue
        elif not pages and not piece.kind:
            if "abstract" in report:
                raise LineError(piece.line, "the text above the first page is the abstract, which the head has too.")
            report["abstract"] = piece.text
        elif not pages:
            raise LineError(piece.line, "a block stands on a page: put a line '# Title' above it.")
        elif piece.kind == "page":
            if pages[-1]["blocks"] or places[page].kind == "page":
                raise LineError(piece.line, "the block 'page' comes once, directly below the heading of its page.")
            pages[-1] |= _without(piece.values(), piece, "title", "blocks")
            places[page] = piece
        else:
            places[*page, len(pages[-1]["blocks"])] = piece
            pages[-1]["blocks"].append(_block(piece))
    return {**report, "pages": pages}, places


def _block(piece: Piece) -> dict[str, Any]:
    """Return the values of a block by key: "kind", those of its TOML, and of a kind with text "text", the text below.

    Raises LineError for an unknown kind, for wrong TOML or one without end, and for "kind", or "text" of a kind with
    text, in the TOML.
    """
    kind, lines = piece.kind or "prose", piece.lines
    if piece.kind and piece.kind not in FENCED:
        hint = str(unknown("block kind", kind, FENCED)).rstrip(".")
        raise LineError(piece.line, f"{hint}; the language of code has no braces about it.")
    if "text" not in KINDS[kind].record.__struct_fields__:
        return {"kind": kind, **_without(piece.values(), piece, "kind")}
    if not piece.kind or lines[:1] != (RULE,):
        return {"kind": kind, "text": piece.text}
    if RULE not in lines[1:]:
        raise LineError(piece.line, f"the head of this block does not end: close it with a line {RULE}.")
    end = lines.index(RULE, 1)
    values = _without(Piece("", piece.line + 1, lines[1:end]).values(), piece, "kind", "text")
    return {"kind": kind, **values, "text": Piece("", 0, lines[end + 1 :]).text}


def _without(values: dict[str, Any], piece: Piece, *keys: str) -> dict[str, Any]:
    """Return the values unchanged. Raises LineError, with the line of `piece`, if one of `keys` is among them."""
    for key in values.keys() & {*keys}:
        raise LineError(piece.line, f"this block takes no key {key!r}: the file says it outside of the TOML.")
    return values


def fenced(block: Mapping[str, Any]) -> str:
    """Return the Markdown of a block: TOML in a fence ```{kind}, and its text below; values None are left out."""
    keys = {key: value for key, value in block.items() if key not in {"kind", "text"} and value is not None}
    lines = "".join(f"{key} = {toml.source(value)}\n" for key, value in keys.items())
    if "text" in block:
        lines = f"{RULE}\n{lines}{RULE}\n{block['text']}\n"
    return f"```{{{block['kind']}}}\n{lines}```\n"
