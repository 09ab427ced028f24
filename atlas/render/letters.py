"""The fonts of a PDF file: which letters of which font are used, under which numbers."""

from collections.abc import Callable, Iterator

from atlas.render.text import Glyph
from atlas.render.truetype import font, subset

_EM = 1000.0
_NO_LETTER = 0


class Letters:
    """The glyphs that have been used, font by font, numbered in the order of their first use."""

    def __init__(self) -> None:
        self._fonts: dict[str, dict[int, tuple[int, str]]] = {}

    def font(self, path: str) -> str:
        """Return the name of a font in the file."""
        self._fonts.setdefault(path, {_NO_LETTER: (0, "")})
        return f"F{list(self._fonts).index(path)}"

    def number(self, glyph: Glyph) -> int:
        """Return the number of a glyph in its cut font."""
        used = self._fonts[glyph.font]
        return used.setdefault(glyph.number, (len(used), glyph.letter))[0]

    def write(self, add: Callable[[str], int], stream: Callable[[str, bytes], int]) -> Iterator[tuple[str, int]]:
        """Write the fonts as objects of a file, and yield the name of each with the number of its object."""
        for index, (path, used) in enumerate(self._fonts.items()):
            whole = font(path)
            data, scale = subset(whole, list(used)), _EM / whole.unit
            name = f"{'ABCDEFGHIJKLMNOPQRSTUVWXYZ'[index] * 6}+{whole.name}"
            file = stream(f"/Length1 {len(data)}", data)
            descriptor = add(
                f"<</Type /FontDescriptor /FontName /{name} /Flags 4 /FontBBox [-500 -500 1500 1200] /ItalicAngle 0 "
                f"/Ascent 750 /Descent -250 /CapHeight 660 /StemV 80 /FontFile2 {file} 0 R>>"
            )
            widths = " ".join(f"{whole.widths[glyph][0] * scale:.0f}" for glyph in used)
            cut = add(
                f"<</Type /Font /Subtype /CIDFontType2 /BaseFont /{name} /CIDToGIDMap /Identity /W [0 [{widths}]] "
                f"/CIDSystemInfo <</Registry (Adobe) /Ordering (Identity) /Supplement 0>> "
                f"/FontDescriptor {descriptor} 0 R>>"
            )
            letters = stream("", _meaning(used).encode("ascii"))
            yield (
                f"F{index}",
                add(
                    f"<</Type /Font /Subtype /Type0 /BaseFont /{name} /Encoding /Identity-H "
                    f"/DescendantFonts [{cut} 0 R] /ToUnicode {letters} 0 R>>"
                ),
            )


def _meaning(used: dict[int, tuple[int, str]]) -> str:
    """Return the table from numbers to letters, by which a reader finds and copies words."""
    pairs = [f"<{number:04X}> <{letter.encode('utf-16-be').hex()}>" for number, letter in used.values() if letter]
    blocks = [pairs[i : i + 100] for i in range(0, len(pairs), 100)]
    lines = "\n".join(f"{len(block)} beginbfchar\n" + "\n".join(block) + "\nendbfchar" for block in blocks)
    return (
        "/CIDInit /ProcSet findresource begin 12 dict begin begincmap\n"
        "/CIDSystemInfo <</Registry (Adobe) /Ordering (UCS) /Supplement 0>> def\n"
        "/CMapName /Adobe-Identity-UCS def /CMapType 2 def\n"
        "1 begincodespacerange <0000> <FFFF> endcodespacerange\n"
        f"{lines}\nendcmap CMapName currentdict /CMap defineresource pop end end\n"
    )
