"""The few letters of a TrueType font that a page uses, as a font of its own."""

import struct
from collections.abc import Sequence
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

_WORDS, _SCALE, _MORE, _TWO_SCALES, _MATRIX = 0x1, 0x8, 0x20, 0x40, 0x80
_KEPT = ("cvt ", "fpgm", "prep")


class Font(NamedTuple):
    """The tables of a font, and the outlines and widths of its glyphs by number."""

    name: str
    tables: dict[str, bytes]
    outlines: tuple[bytes, ...]
    widths: tuple[tuple[int, int], ...]
    unit: int


@cache
def font(path: str) -> Font:
    """Return a font file taken apart; a width is (advance, left side bearing), in the font's units to an em."""
    data = Path(path).read_bytes()
    tables = {}
    for i in range(struct.unpack_from(">H", data, 4)[0]):
        tag, _, start, length = struct.unpack_from(">4sLLL", data, 12 + 16 * i)
        tables[tag.decode("ascii")] = data[start : start + length]
    (count,) = struct.unpack_from(">H", tables["maxp"], 4)
    (unit,) = struct.unpack_from(">H", tables["head"], 18)
    (long,) = struct.unpack_from(">h", tables["head"], 50)
    places = struct.unpack(f">{count + 1}{'L' if long else 'H'}", tables["loca"][: (count + 1) * (4 if long else 2)])
    places = places if long else tuple(2 * place for place in places)
    outlines = tuple(tables["glyf"][a:b] for a, b in pairwise(places))
    (metrics,) = struct.unpack_from(">H", tables["hhea"], 34)
    pairs = [struct.unpack_from(">Hh", tables["hmtx"], 4 * i) for i in range(metrics)]
    bearings = struct.unpack_from(f">{count - metrics}h", tables["hmtx"], 4 * metrics)
    pairs += [(pairs[-1][0], bearing) for bearing in bearings]
    return Font(Path(path).stem, tables, outlines, tuple(pairs), unit)


def subset(whole: Font, glyphs: Sequence[int]) -> bytes:
    """Return a font with only these glyphs, numbered from 0 in their order; what they are made of comes after them."""
    order = list(glyphs)
    outlines = [_renumbered(whole.outlines[glyph], order) for glyph in order]  # which grows while it is gone through
    padded = [outline + b"\0" * (-len(outline) % 4) for outline in outlines]
    places = [0]
    for outline in padded:
        places.append(places[-1] + len(outline))
    tables = {tag: whole.tables[tag] for tag in _KEPT if tag in whole.tables}
    head, hhea, maxp = (bytearray(whole.tables[tag]) for tag in ("head", "hhea", "maxp"))
    struct.pack_into(">L", head, 8, 0)
    struct.pack_into(">h", head, 50, 1)
    struct.pack_into(">H", hhea, 34, len(order))
    struct.pack_into(">H", maxp, 4, len(order))
    tables |= {"head": bytes(head), "hhea": bytes(hhea), "maxp": bytes(maxp), "glyf": b"".join(padded)}
    tables["loca"] = struct.pack(f">{len(places)}L", *places)
    tables["hmtx"] = b"".join(struct.pack(">Hh", *whole.widths[glyph]) for glyph in order)
    return _file(tables)


def _renumbered(outline: bytes, order: list[int]) -> bytes:
    """Return an outline whose parts, if it is made of other glyphs, have their new numbers; add them to the order."""
    if len(outline) < 10 or struct.unpack_from(">h", outline)[0] >= 0:
        return outline
    new, at, flags = bytearray(outline), 10, _MORE
    while flags & _MORE:
        flags, part = struct.unpack_from(">HH", new, at)
        if part not in order:
            order.append(part)
        struct.pack_into(">H", new, at + 2, order.index(part))
        at += 8 if flags & _WORDS else 6
        at += 2 if flags & _SCALE else 4 if flags & _TWO_SCALES else 8 if flags & _MATRIX else 0
    return bytes(new)


def _file(tables: dict[str, bytes]) -> bytes:
    """Return the file of a font with these tables."""
    count = len(tables)
    power = count.bit_length() - 1
    head = struct.pack(">LHHHH", 0x00010000, count, 16 << power, power, 16 * count - (16 << power))
    at, entries, bodies = 12 + 16 * count, [], []
    for tag, table in sorted(tables.items()):
        body = table + b"\0" * (-len(table) % 4)
        total = sum(struct.unpack(f">{len(body) // 4}L", body)) & 0xFFFFFFFF
        entries.append(struct.pack(">4sLLL", tag.encode("ascii"), total, at, len(table)))
        bodies.append(body)
        at += len(body)
    return head + b"".join(entries) + b"".join(bodies)
