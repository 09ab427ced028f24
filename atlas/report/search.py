"""What the search box of a report looks through, and the equations that stand behind their numbers."""

import json
import re
from collections.abc import Iterator, Mapping, Sequence
from html import escape, unescape
from itertools import pairwise
from unicodedata import normalize
from xml.etree import ElementTree as ET

from atlas.paper.equation import slug
from atlas.report.blocks.equation import EquationView
from atlas.report.blocks.ledger import LedgerView
from atlas.report.document import Document

_START = re.compile(
    r'<(?:h[23]|figure|section)\b[^>]*? id="([^"]+)"[^>]*>|<div class="equation" id="([^"]+)">'
    r'|<main id="([^"]+)">|</main>'
)
_TITLE = re.compile(r"<h[123][^>]*>(.*?)</h[123]>|(?:<figcaption[^>]*>)<b>(.*?)</b>", re.DOTALL)
_REST_OF_HEADING = re.compile(r"(.*?)</h[23]>", re.DOTALL)
_MARKUP = re.compile(r"<[^>]+>")
_INLINE = re.compile(r"</?(?:a|b|i|em|strong|span|code|sup|sub)\b[^>]*>")
_RELATION = re.compile(r"\s*([=≤≥≈≠])\s*")
_ACCENTS = {"′": "'", "−": "-", "\u2061": "", "\u2062": "", "⃗": ""}
_TAG = re.compile(r'<div class="tag">(.*?)</div>', re.DOTALL)


def index(document: Document, pages: Mapping[str, str], texts: Sequence[str]) -> str:
    """Return the index of a report as a script, which a page opened from disk can load: ``atlasIndex({...})``.

    ``sections`` holds rows (page, anchor, title, words) of its sections, figures, tables and equations in the order of
    the pages, ``equations`` the formula of each name as HTML. Formulas are words on one line: Ω3=ω1B'2, I=3/2.
    """
    rows = [
        row for page in document.pages for row in sections(page.file, f"{page.number} {page.title}", pages[page.file])
    ]
    content = json.dumps({"sections": rows, "equations": _equations(document, texts)}, ensure_ascii=False)
    return f"atlasIndex({content});\n"


def sections(file: str, page: str, html: str) -> Iterator[tuple[str, str, str, str]]:
    """Cut a page at its anchors."""
    starts = list(_START.finditer(html))
    for start, end in pairwise(starts):
        anchor = next(filter(None, start.groups()))
        content = html[start.end() : end.start()]
        tag = _TAG.search(content)
        title = _REST_OF_HEADING.match(content) if start[0].startswith("<h") else _TITLE.search(content)
        if anchor.startswith("eq-") and tag:
            yield file, anchor, f"Equation {_words(tag[1])}", page
        else:
            head = _words(next(filter(None, title.groups()), "")).removesuffix(".") if title else page
            yield file, anchor, page if anchor.startswith("page-") else f"{head} — {page}", _words(content)


def _equations(document: Document, texts: Sequence[str]) -> dict[str, str]:
    """Return the formulas by the names in their anchors: of the ledger, of the displays, and others that are cited."""
    found = {slug(name): texts[number] for name, number in document.formulas.items()}
    for page in document.pages:
        for block in page.blocks:
            if isinstance(block, EquationView):
                found[slug(block.name)] = texts[block.text]
            elif isinstance(block, LedgerView):
                found |= {slug(entry.name): texts[entry.formula] for entry in block.entries}
    return found


def _words(html: str) -> str:
    """Return the words of a piece of HTML, its formulas on one line."""
    html = re.sub(r'<a class="anchor".*?</a>', " ", html, flags=re.DOTALL)
    html = re.sub(r"<math.*?</math>", lambda found: escape(linear(found[0])), html, flags=re.DOTALL)
    return _joined(" ".join(unescape(_MARKUP.sub(" ", _INLINE.sub("", html))).split()))


def linear(mathml: str) -> str:
    """Return a formula on one line, in plain letters: ω'2 for an index, x^2 for a power, 3/2 for a fraction."""
    return _joined("".join(_line(ET.fromstring(mathml)).split()))  # noqa: S314  what pandoc has written


def _line(node: ET.Element) -> str:
    """Return what a node of MathML says."""
    tag = node.tag.rpartition("}")[2]
    if tag in {"annotation", "annotation-xml", "mspace"}:
        return ""
    parts = [_line(child) for child in node]
    text = "".join(_ACCENTS.get(letter, letter) for letter in normalize("NFKC", node.text or ""))
    if tag == "mfrac":
        return "/".join(part if part.isalnum() else f"({part})" for part in parts)
    if tag in {"msup", "mover"}:
        base, above = parts
        return base + above if above in {"'", "''", "˙", "^", "¨", "~", "¯", ""} else f"{base}^{above}"
    if tag == "msubsup":
        base, below, above = parts
        return f"{base}'{below}" if above == "'" else f"{base}{below}^{above}"
    if tag == "msqrt":
        return f"sqrt({''.join(parts)})"
    return " ".join(parts) if tag in {"mtr", "mtable"} else text + "".join(parts)


def _joined(text: str) -> str:
    """Take out the space around signs of a relation: I = 3/2 is I=3/2."""
    return _RELATION.sub(r"\1", text)
