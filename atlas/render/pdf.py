"""A page as a PDF file, in hundredths of a printer's point: the letters stay letters, of fonts cut to what is used."""

import zlib
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from atlas.render.letters import Letters
from atlas.render.paper import Box, Marks, Page, Picture, Shape, Words
from atlas.render.text import HALO, setting

FloatArray = NDArray[np.float64]

_FINE = 100.0
_ROUND = 0.5522847498307936
_CURVE, _CLOSE = 3, 79
_STEPS = {1: 1, 2: 1, _CURVE: 2, 4: 3, _CLOSE: 1}
_COMMANDS = {1: "m", 2: "l", _CURVE: "c", 4: "c", _CLOSE: "h"}
_CAPS, _JOINS = {"butt": 0, "round": 1}, {"miter": 0, "round": 1}


def write(page: Page, path: Path, title: str) -> None:
    """Write a page into a file; its title travels inside."""
    path.write_bytes(_Writer(page).file(title))


class _Writer:
    """The objects of a file so far, by number from 1, and what the page refers to."""

    def __init__(self, page: Page) -> None:
        self.page = page
        self.objects: list[bytes] = []
        self.letters = Letters()
        self.veils: dict[float, str] = {}
        self.pictures: dict[str, int] = {}

    def file(self, title: str) -> bytes:
        """Return the bytes of the file."""
        ground = f"1 g 0 0 {self.page.width * _FINE:.0f} {self.page.height * _FINE:.0f} re f"
        lines = [
            f"{1 / _FINE:g} 0 0 {1 / _FINE:g} 0 0 cm",
            ground,
            *(line for item in self.page for line in self._drawn(item)),
        ]
        content = self._stream("", "\n".join(lines).encode("ascii"))
        fonts = " ".join(f"/{name} {number} 0 R" for name, number in self.letters.write(self._add, self._stream))
        veils = " ".join(f"/{name} <</ca {opacity:g}>>" for opacity, name in self.veils.items())
        pictures = " ".join(f"/{name} {number} 0 R" for name, number in self.pictures.items())
        pages = len(self.objects) + 2
        box = f"0 0 {self.page.width:.2f} {self.page.height:.2f}"
        resources = f"<</Font <<{fonts}>> /ExtGState <<{veils}>> /XObject <<{pictures}>>>>"
        sheet = self._add(
            f"<</Type /Page /Parent {pages} 0 R /MediaBox [{box}] /Contents {content} 0 R /Resources {resources} "
            "/Group <</Type /Group /S /Transparency /CS /DeviceRGB>>>>"
        )
        self._add(f"<</Type /Pages /Kids [{sheet} 0 R] /Count 1>>")
        catalog = self._add(f"<</Type /Catalog /Pages {pages} 0 R>>")
        words = title.encode("utf-16-be").hex()
        info = self._add(f"<</Title <FEFF{words}>>>")
        return _bound(self.objects, f"/Root {catalog} 0 R /Info {info} 0 R")

    def _add(self, body: str | bytes) -> int:
        self.objects.append(body if isinstance(body, bytes) else body.encode("ascii"))
        return len(self.objects)

    def _stream(self, entries: str, data: bytes) -> int:
        packed = zlib.compress(data, 6)
        head = f"<<{entries} /Filter /FlateDecode /Length {len(packed)}>>\nstream\n"
        return self._add(head.encode("ascii") + packed + b"\nendstream")

    def _drawn(self, item: Shape | Marks | Words | Picture) -> Iterator[str]:
        yield "q"
        if isinstance(item, Shape):
            yield from self._shape(item)
        elif isinstance(item, Marks):
            yield from _marks(item)
        elif isinstance(item, Words):
            yield from self._words(item)
        else:
            yield self._picture(item)
        yield "Q"

    def _shape(self, shape: Shape) -> Iterator[str]:
        yield from _clip(shape.clip)
        if shape.face:
            yield f"{_colour(shape.face)} rg"
        if shape.opacity != 1.0:
            yield f"/{self.veils.setdefault(shape.opacity, f'V{len(self.veils)}')} gs"
        if shape.edge:
            dash = " ".join(f"{_FINE * length:.0f}" for length in shape.dash)
            yield f"{_colour(shape.edge)} RG {shape.width * _FINE:.0f} w {_CAPS[shape.cap]} J {_JOINS[shape.join]} j"
            yield f"[{dash}] 0 d"
        for line in shape.lines:
            (x, y), *rest = _fine(line).tolist()
            yield f"{x} {y} m " + " ".join([f"{x} {y} l" for x, y in rest]) + (" h" if shape.closed else "")
        yield ("B" if shape.face else "S") if shape.edge else "f"

    def _words(self, words: Words) -> Iterator[str]:
        line, size = setting(words.text), words.size * _FINE
        (x, y) = _fine(np.array([words.at]))[0].tolist()
        yield f"0 1 -1 0 {x} {y} cm" if words.turned else f"1 0 0 1 {x} {y} cm"
        text = [
            f"/{self.letters.font(glyph.font)} {glyph.scale * size:.0f} Tf 1 0 0 1 {glyph.x * size:.0f} "
            f"{glyph.y * size:.0f} Tm <{self.letters.number(glyph):04X}> Tj"
            for glyph in line.glyphs
        ]
        outlines = [] if line.glyphs else list(_outlines(line.points * size, line.codes))
        rules = [" ".join(f"{size * length:.0f}" for length in rule) + " re" for rule in line.rules]
        for colour, width in ((("#ffffff", HALO),) if words.halo else ()) + ((words.colour, 0.0),):
            yield f"{_colour(colour)} rg {_colour(colour)} RG {width * _FINE:.0f} w 1 j"
            yield from ("BT", f"{2 if width else 0} Tr", *text, "ET")
            if rules or outlines:
                yield " ".join([*rules, *outlines, "B" if width else "f"])

    def _picture(self, picture: Picture) -> str:
        rows, columns = picture.pixels.shape[:2]
        entries = (
            f"/Type /XObject /Subtype /Image /Width {columns} /Height {rows} /ColorSpace /DeviceRGB "
            f"/BitsPerComponent 8 /DecodeParms <</Predictor 15 /Colors 3 /Columns {columns}>>"
        )
        pixels = np.ascontiguousarray(picture.pixels[..., :3]).reshape(rows, 3 * columns)
        above = np.concatenate([np.zeros_like(pixels[:1]), pixels[:-1]])
        name = f"P{len(self.pictures)}"
        filtered = np.concatenate([np.full((rows, 1), 2, dtype=np.uint8), pixels - above], axis=1)
        self.pictures[name] = self._stream(entries, filtered.tobytes())
        left, bottom, right, top = picture.box
        (x, y), (end, high) = _fine(np.array([[left, bottom], [right, top]])).tolist()
        return f"{end - x} 0 0 {high - y} {x} {y} cm /{name} Do"


def _marks(marks: Marks) -> Iterator[str]:
    yield from _clip(marks.clip)
    yield f"{_colour(marks.face)} rg {_colour(marks.edge)} RG {marks.width * _FINE:.0f} w"
    half = 0.5 * marks.size * _FINE
    if marks.shape == "D":
        corners = half * 2.0**0.5 * np.array([[1, 0], [0, 1], [-1, 0], [0, -1]])
        commands = ("m", "l", "l", "l h")
    else:
        a, b = half, half * _ROUND
        corners = np.array(
            [
                [a, 0],
                [a, b],
                [b, a],
                [0, a],
                [-b, a],
                [-a, b],
                [-a, 0],
                [-a, -b],
                [-b, -a],
                [0, -a],
                [b, -a],
                [a, -b],
                [a, 0],
            ]
        )
        commands = ("m", *("", "", "c") * 3, "", "", "c h")
    for place in marks.places * _FINE:
        found = np.round(corners + place).astype(np.int64).tolist()
        yield " ".join([f"{x} {y} {command}" for (x, y), command in zip(found, commands, strict=True)])
    yield "B"


def _outlines(points: FloatArray, codes: NDArray[np.uint8]) -> Iterator[str]:
    """Yield the commands of an outline; a curve of second order is written as one of third."""
    here, i = points[:1], 0
    while i < len(codes):
        code = int(codes[i])
        ahead = points[i : i + _STEPS[code]]
        if code == _CURVE:
            ahead = np.stack([(here[-1] + 2.0 * ahead[0]) / 3.0, (ahead[1] + 2.0 * ahead[0]) / 3.0, ahead[1]])
        numbers = "" if code == _CLOSE else " ".join(map(str, np.round(ahead).astype(np.int64).ravel().tolist()))
        yield f"{numbers} {_COMMANDS[code]}"
        here, i = ahead if code != _CLOSE else here, i + _STEPS[code]


def _clip(box: Box | None) -> Iterator[str]:
    """Yield what keeps all that follows inside a box."""
    if box:
        (x, y), (right, top) = _fine(np.array([box[:2], box[2:]])).tolist()
        yield f"{x} {y} {right - x} {top - y} re W n"


def _fine(points: FloatArray) -> NDArray[np.int64]:
    """Return places in hundredths of a point."""
    return np.round(points * _FINE).astype(np.int64)


def _colour(colour: str) -> str:
    """Return red, green and blue of six hexadecimal digits."""
    return " ".join(f"{int(colour[i : i + 2], 16) / 255.0:.4g}" for i in (1, 3, 5))


def _bound(objects: list[bytes], entries: str) -> bytes:
    """Return a file of these objects."""
    parts, places, at = [b"%PDF-1.5\n%\xe2\xe3\xcf\xd3\n"], [], 0
    for number, body in enumerate(objects, 1):
        at += len(parts[-1])
        places.append(at)
        parts.append(b"%d 0 obj\n%s\nendobj\n" % (number, body))
    at += len(parts[-1])
    table = "".join(f"{place:010} 00000 n \n" for place in places)
    size = len(objects) + 1
    tail = f"xref\n0 {size}\n0000000000 65535 f \n{table}trailer\n<</Size {size} {entries}>>\nstartxref\n{at}\n%%EOF\n"
    return b"".join(parts) + tail.encode("ascii")
