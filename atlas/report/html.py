"""The pages: plain HTML with MathML, one stylesheet, embedded fonts, small scripts; nothing from the network."""

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from html import unescape
from typing import Any, NamedTuple

from markupsafe import Markup, escape

from atlas.errors import AtlasError, unknown
from atlas.places import folder
from atlas.plain import plain
from atlas.report.blocks.figure import FigureView
from atlas.report.definition import Thumbnail
from atlas.report.document import Document, PageView
from atlas.report.fonts import FACES, Recall, all_subsets, anew
from atlas.report.search import index
from atlas.report.templates import templates
from atlas.report.versions import versions

SCRIPTS = ("page.js", "minisearch.js", "scene.js", "motion.js", "explorer.js")
"""The page's own, the library of its search box, vendored so that a page opened from disk needs no network, what
turns figures in space, what lets figures move in time, and what moves an elementary motion."""


class Card(NamedTuple):
    """A figure that stands for a page on the front page, and how it is cut."""

    page: PageView
    figure: FigureView
    thumbnail: Thumbnail = Thumbnail()


def pages(document: Document) -> dict[str, str]:
    """Set a document, whose texts are set, as pages; the keys are file names, stylesheet and scripts among them."""
    environment = templates(plain=plain)
    texts = [Markup(whole(text)) for text in document.written["html"]]  # noqa: S704  from pandoc
    template = environment.get_template("page.html")
    figures = [
        Card(page, block)
        for page in document.pages
        for block in page.blocks
        if isinstance(block, FigureView) and not block.failure
    ]
    common: dict[str, Any] = {
        "document": document,
        "texts": texts,
        "versions": versions(),
        "report": document.report,
        "cover": _cover(document, figures),
        "cards": [cut(card, document) for card in {card.page.slug: card for card in reversed(figures)}.values()][::-1],
    }
    set_pages = {
        page.file: anchored(template.render(page=page, before=before, after=after, **common))
        for before, page, after in _neighbours(document.pages)
    }
    if len(set_pages) == 1:
        set_pages = {name: _with_sections(page) for name, page in set_pages.items()}
    style = environment.get_template("style.css").render(faces=FACES)
    scripts = {name: (folder("templates") / "html" / name).read_text(encoding="utf-8") for name in SCRIPTS}
    return {"style.css": style, **scripts, "index.js": index(document, set_pages, texts), **set_pages}


def fonts(set_pages: Mapping[str, str], recall: Recall = anew) -> dict[str, bytes]:
    """Cut the fonts for the letters of some pages; the keys are file names."""
    texts = (text for name, text in set_pages.items() if name.endswith(".html"))
    return {f"fonts/{name}": content for name, content in all_subsets(texts, recall).items()}


def whole(text: str) -> str:
    """Keep the options in inline code on one line: a browser breaks them behind their hyphens."""
    option = re.compile(r"(?<![\w-])--?[A-Za-z][\w-]*")
    return re.sub("<code>[^<]*</code>", lambda code: option.sub(r'<span class="option">\g<0></span>', code[0]), text)


def anchored(page: str) -> str:
    """Give each heading inside a page an anchor made of its words, and a link to it."""
    seen: Counter[str] = Counter(re.findall(r' id="([^"]+)"', page))

    def heading(match: re.Match[str]) -> str:
        words = unescape(re.sub(r"<math.*?</math>|<[^>]+>", " ", match[2], flags=re.DOTALL))
        name = "-".join(re.findall(r"[a-z0-9]+", words.lower())) or "section"
        seen[name] += 1
        name = name if seen[name] == 1 else f"{name}-{seen[name]}"
        link = f'<a class="anchor" href="#{name}" aria-label="Link to {escape(" ".join(words.split()))}">#</a>'
        return f'<h{match[1]} id="{name}">{match[2]} {link}</h{match[1]}>'

    return re.sub(r"<h([23])>(.*?)</h\1>", heading, page, flags=re.DOTALL)


def _with_sections(page: str) -> str:
    """Let the contents of a report of one page be its sections."""
    sections = re.findall(r'<h2 id="([^"]+)">(.*?) <a class="anchor"', page)
    items = "\n".join(f'<li><span></span><a href="#{anchor}">{words}</a></li>' for anchor, words in sections)
    return re.sub(
        r'(<li class="here">.*?</li>\n)', lambda found: f"{found[1]}{items}\n", page, count=1, flags=re.DOTALL
    )


def cut(card: Card, document: Document) -> Card:
    """Return the card of a page with the figure and the cut that the report asks for."""
    wanted = next(page for page in document.report.pages if page.slug == card.page.slug).thumbnail
    figures = (block for block in card.page.blocks if isinstance(block, FigureView) and not block.failure)
    chosen = card.figure if not wanted.figure else next((f for f in figures if f.id == f"fig-{wanted.figure}"), None)
    if chosen is None:
        raise AtlasError(f"page {card.page.slug!r}, thumbnail: no figure {wanted.figure!r} is drawn on this page.")
    return Card(card.page, chosen, wanted)


def _cover(document: Document, figures: Sequence[Card]) -> Card | None:
    """Return the figure of the front page: the one that the report names."""
    if document.report.cover is None:
        return None
    anchor = f"fig-{document.report.cover}"
    if f"fig:{document.report.cover}" not in document.targets:
        raise AtlasError(f"cover: {unknown('figure', document.report.cover, document.citable)}")
    return next((card for card in figures if card.figure.id == anchor), None)


def _neighbours(pages: Sequence[Any]) -> list[tuple[Any, Any, Any]]:
    """Pair each page with the one before and the one after it."""
    return list(zip([None, *pages[:-1]], pages, [*pages[1:], None], strict=True))
