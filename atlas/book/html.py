"""The pages: plain HTML with MathML, one stylesheet, embedded fonts, small scripts; nothing from the network."""

import json
import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache, partial
from html import escape as escaped
from html import unescape
from io import BytesIO
from itertools import pairwise
from typing import Any, NamedTuple
from unicodedata import normalize
from xml.etree import ElementTree as ET

from markupsafe import Markup, escape

from atlas.book.blocks.equation import EquationView
from atlas.book.blocks.figure import FigureView
from atlas.book.blocks.ledger import LedgerView
from atlas.book.definition import Thumbnail
from atlas.book.document import Document, PageView
from atlas.book.fonts import FACES
from atlas.book.scripts import script
from atlas.book.templates import templates
from atlas.book.texts import title_words
from atlas.errors import AtlasError, unknown
from atlas.pictures.style import STYLES
from atlas.trial.ledger.equation import slug
from atlas.trial.ledger.plain import plain

SCRIPTS = ("page.js", "minisearch.js", "scene.js", "motion.js", "sliders.js", "explorer.js", "gallery.js")
"""The page's own, the library of its search box, vendored so that a page opened from disk needs no network, what
turns figures in space, what lets figures move in time, motions with sliders, and the keys of the gallery."""
CARD = (400, 250)
"""The size of a small picture in pixels."""


class Card(NamedTuple):
    """A figure that represents a page on the front page; `cut` is the detail that is shown, by default its centre."""

    page: PageView
    figure: FigureView
    cut: Thumbnail = Thumbnail()

    @property
    def file(self) -> str:
        """Path of the card's picture in the report, "cards/SLUG.webp"."""
        return f"cards/{self.page.slug}.webp"


def pages(document: Document) -> dict[str, str]:
    """Return the files of a document, texts by name: its HTML pages, stylesheet, scripts and search index.

    The texts must be typeset before. A page's section links are added only to a report of one page.
    """
    environment = templates("html", plain=plain, title_words=title_words)
    texts = [Markup(with_unbroken_options(text)) for text in document.typeset_texts["html"]]  # noqa: S704  from pandoc
    template = environment.get_template("page.html")
    common: dict[str, Any] = {
        "document": document,
        "texts": texts,
        "report": document.report,
        "cover": document.report.cover and _card_of(document, document.report.cover, "cover"),
        "still": partial(_card_of, document, key="still"),
        "cards": cards(document),
    }
    views = document.pages
    set_pages = {
        page.file: anchored(template.render(page=page, before=before, after=after, **common))
        for before, page, after in zip([None, *views], views, [*views[1:], None], strict=False)
    }
    if document.gallery:
        gallery = template.render(page=document.gallery, before=None, after=None, **common)
        set_pages[document.gallery.file] = anchored(gallery)
    if len(set_pages) == 1:
        set_pages = {name: _with_sections(page) for name, page in set_pages.items()}
    style = environment.get_template("style.css").render(faces=FACES, looks=STYLES)
    scripts = {name: script(name) for name in SCRIPTS}
    return {"style.css": style, **scripts, "index.js": index(document, set_pages, texts), **set_pages}


def with_unbroken_options(text: str) -> str:
    """Return HTML in which each option of inline code, such as --out, is a span that is not broken at hyphens."""
    option = re.compile(r"(?<![\w-])--?[A-Za-z][\w-]*")
    return re.sub("<code>[^<]*</code>", lambda code: option.sub(r'<span class="option">\g<0></span>', code[0]), text)


def anchored(page: str) -> str:
    """Return a page's HTML in which each heading h2 and h3 has an anchor made of its words, and a link to it.

    An anchor that the page has already gets a number.
    """
    counts: Counter[str] = Counter(re.findall(r' id="([^"]+)"', page))

    def heading(match: re.Match[str]) -> str:
        words = unescape(re.sub(r"<math.*?</math>|<[^>]+>", " ", match[2], flags=re.DOTALL))
        name = "-".join(re.findall(r"[a-z0-9]+", words.lower())) or "section"
        counts[name] += 1
        name = name if counts[name] == 1 else f"{name}-{counts[name]}"
        link = f'<a class="anchor" href="#{name}" aria-label="Link to {escape(" ".join(words.split()))}">#</a>'
        return f'<h{match[1]} id="{name}">{match[2]} {link}</h{match[1]}>'

    return re.sub(r"<h([23])>(.*?)</h\1>", heading, page, flags=re.DOTALL)


def _with_sections(page: str) -> str:
    """Return a page's HTML with links to its sections h2 below its own entry in the contents."""
    sections = re.findall(r'<h2 id="([^"]+)">(.*?) <a class="anchor"', page)
    items = "\n".join(f'<li><span></span><a href="#{anchor}">{words}</a></li>' for anchor, words in sections)
    return re.sub(
        r'(<li class="here">.*?</li>\n)', lambda matched: f"{matched[1]}{items}\n", page, count=1, flags=re.DOTALL
    )


def _figures(document: Document) -> list[Card]:
    """Return a `Card` for each figure of the document, in order."""
    return [Card(page, block) for page in document.pages for block in page.blocks if isinstance(block, FigureView)]


def cards(document: Document) -> list[Card]:
    """Return a `Card` for each page with a drawn figure: the figure of its thumbnail, else its first one.

    Raises AtlasError for a thumbnail whose figure is not drawn in this report.
    """
    figures, cards = _figures(document), []
    cuts = {card.slug: card.thumbnail for card in document.report.pages}
    for page in document.pages:
        cut = cuts.get(page.slug, Thumbnail())
        fits = (
            card for card in figures if (card.figure.id == f"fig-{cut.figure}" if cut.figure else card.page is page)
        )
        chosen = next(fits, None)
        if chosen and not chosen.figure.failure:
            cards.append(Card(page, chosen.figure, cut))
        elif cut.figure:
            raise AtlasError(f"page {page.slug!r}, thumbnail: no figure {cut.figure!r} is drawn in this report.")
    return cards


def thumbnail(png: bytes, cut: Thumbnail) -> bytes:
    """Return a detail of a PNG, on white, as the bytes of a WebP of 400 by 250 pixels.

    `cut` has its centre and zoom.
    """
    from PIL import Image

    with Image.open(BytesIO(png)) as picture:
        scale = cut.zoom * max(want / size for want, size in zip(CARD, picture.size, strict=True))
        extent = [want / scale for want in CARD]
        left, top = (place * (size - share) for place, size, share in zip(cut.at, picture.size, extent, strict=True))
        white = Image.new("RGBA", picture.size, "white")
        white.alpha_composite(picture.convert("RGBA"))
        box = (left, top, left + extent[0], top + extent[1])
        small = white.convert("RGB").resize(CARD, Image.Resampling.LANCZOS, box, reducing_gap=3.0)
    out = BytesIO()
    small.save(out, "webp", quality=82, method=4)
    return out.getvalue()


def _card_of(document: Document, name: str, key: str) -> Card | None:
    """Return the `Card` of the figure with the id `name`; None if the figure failed.

    Raises AtlasError, which begins with `key`, if there is no such figure.
    """
    if f"fig:{name}" not in document.targets:
        raise AtlasError(f"{key}: {unknown('figure', name, document.citable)}")
    candidates = (card for card in _figures(document) if card.figure.id == f"fig-{name}" and not card.figure.failure)
    return next(candidates, None)


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

    ``sections`` holds rows (page, anchor, title, words) of its sections, figures, tables and equations in the order
    of the pages, ``equations`` the formula of each name as HTML. Formulas are words on one line: Ω3=ω1B'2, I=3/2.
    `pages` are the HTML by file name, `texts` the document's, typeset in HTML.
    """
    rows = [
        row for page in document.pages for row in sections(page.file, f"{page.number} {page.title}", pages[page.file])
    ]
    content = json.dumps({"sections": rows, "equations": _equations(document, texts)}, ensure_ascii=False)
    return f"atlasIndex({content});\n"


def sections(file: str, page: str, html: str) -> Iterator[tuple[str, str, str, str]]:
    """Yield (file, anchor, title, text) for the search: the HTML of one page split at its anchors.

    `page` is the page's number and title, which end the titles. For a displayed equation the title is "Equation" with
    its number, and the text is `page`.
    """
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
    """Return the HTML of formulas by the slug of the equation: those in the ledger, displayed, or only cited.

    `texts` are the document's, typeset in HTML.
    """
    equations = {slug(name): texts[number] for name, number in document.formulas.items()}
    for page in document.pages:
        for block in page.blocks:
            if isinstance(block, EquationView):
                equations[slug(block.name)] = texts[block.text]
            elif isinstance(block, LedgerView):
                equations |= {slug(entry.name): texts[entry.formula] for entry in block.entries}
    return equations


def _words(html: str) -> str:
    """Return the plain words of a piece of HTML as one line of text, formulas as `linear` writes them.

    Links of class "anchor" are left out, and spaces around signs of a relation.
    """
    html = re.sub(r'<a class="anchor".*?</a>', " ", html, flags=re.DOTALL)
    html = re.sub(r"<math.*?</math>", lambda matched: escaped(linear(matched[0])), html, flags=re.DOTALL)
    return _joined(" ".join(unescape(_MARKUP.sub(" ", _INLINE.sub("", html))).split()))


@lru_cache(maxsize=4096)
def linear(mathml: str) -> str:
    """Return a formula in MathML as a line of plain letters: ω'2 for an index, (x^2)/2 for a power and a fraction."""
    return _joined("".join(_line(ET.fromstring(mathml)).split()))  # noqa: S314  what pandoc has written


def _line(node: ET.Element) -> str:
    """Return a node of MathML as plain text: "(a+b)/2" for a fraction, "x^2" for a power, "sqrt(x)" for a root.

    Numerators and denominators of other signs than letters and digits are put in brackets.
    """
    tag = node.tag.rpartition("}")[2]
    if tag in {"annotation", "annotation-xml", "mspace"}:
        return ""
    children = [_line(child) for child in node]
    text = "".join(_ACCENTS.get(letter, letter) for letter in normalize("NFKC", node.text or ""))
    if tag == "mfrac":
        return "/".join(factor if factor.isalnum() else f"({factor})" for factor in children)
    if tag in {"msup", "mover"}:
        base, above = children
        return base + above if above in {"'", "''", "˙", "^", "¨", "~", "¯", ""} else f"{base}^{above}"
    if tag == "msubsup":
        base, below, above = children
        return f"{base}'{below}" if above == "'" else f"{base}{below}^{above}"
    if tag == "msqrt":
        return f"sqrt({''.join(children)})"
    return " ".join(children) if tag in {"mtr", "mtable"} else text + "".join(children)


def _joined(text: str) -> str:
    """Return a text without spaces around signs of a relation: I = 3/2 becomes I=3/2."""
    return _RELATION.sub(r"\1", text)
