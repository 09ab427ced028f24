"""The pages: plain HTML with MathML, one stylesheet, embedded fonts; no script, nothing from the network."""

from collections.abc import Mapping, Sequence
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

from atlas.places import folder
from atlas.report.compose import Document
from atlas.report.fonts import FACES, Recall, all_subsets, anew
from atlas.report.versions import versions


def pages(document: Document) -> dict[str, str]:
    """Set a document, whose texts are set, as pages; the keys are file names, the stylesheet among them."""
    environment = Environment(
        loader=FileSystemLoader(folder("templates") / "html"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    texts = [Markup(text) for text in document.written["html"]]  # noqa: S704  from pandoc
    template = environment.get_template("page.html")
    common: dict[str, Any] = {"document": document, "texts": texts, "versions": versions(), "report": document.report}
    set_pages = {
        page.file: template.render(page=page, before=before, after=after, **common)
        for before, page, after in _neighbours(document.pages)
    }
    style = environment.get_template("style.css").render(faces=FACES)
    return {"style.css": style, **set_pages}


def fonts(set_pages: Mapping[str, str], recall: Recall = anew) -> dict[str, bytes]:
    """Cut the fonts for the letters of some pages; the keys are file names."""
    texts = (text for name, text in set_pages.items() if name.endswith(".html"))
    return {f"fonts/{name}": content for name, content in all_subsets(texts, recall).items()}


def _neighbours(pages: Sequence[Any]) -> list[tuple[Any, Any, Any]]:
    """Pair each page with the one before and the one after it."""
    return list(zip([None, *pages[:-1]], pages, [*pages[1:], None], strict=True))
