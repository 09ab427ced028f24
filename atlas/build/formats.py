"""A composed report in each format: its texts set, its pages, the one file, the PDF."""

from collections.abc import Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING

import msgspec

from atlas.build.cache import Cache
from atlas.sources import PACKAGE, Sources, digest

if TYPE_CHECKING:
    from atlas.build.figures import FigureBuild
    from atlas.report.blocks.figure import Picture
    from atlas.report.document import Document
    from atlas.report.pandoc import Target


MANIFEST = "manifest.json"
"""By it a folder is known to be of a report, which may be built anew."""
LANGUAGES: Mapping[str, "Target"] = {"html": "html", "pdf": "typst", "single": "html"}
"""In which language the texts of each format are set; `single` is one page as one file, if it is asked for."""


def set_texts(document: "Document", formats: Sequence[str], cache: Cache, sources: Sources) -> None:
    """Set the texts of a document; those that were set before are in the cache."""
    # pages of one object have most of their texts in common
    which = "a page" if len(document.pages) == 1 else document.report.name
    name = f"texts of {which} by {sources.closure([PACKAGE / 'report' / 'texts.py'])}"
    document.texts.memory = cache.load(name)
    document.set(*dict.fromkeys(LANGUAGES[form] for form in formats))
    cache.save(name, document.texts.used)


def manifest_of(document: "Document") -> bytes:
    """Return the manifest of a report as JSON; it depends on the report and on the versions alone."""
    from atlas.report.templates import versions

    report = document.report
    manifest = {"report": report.name, "title": report.title, "versions": versions()}
    return msgspec.json.format(msgspec.json.encode(manifest), indent=1) + b"\n"


def _pages(
    document: "Document", figures: "dict[FigureBuild, Picture]", cache: Cache, sources: Sources
) -> dict[str, bytes]:
    """Return the pages of a report with what belongs to them, by their places."""
    from atlas.report import fonts, html

    code = sources.closure([PACKAGE / "report" / "fonts.py"])
    pages = html.pages(document)
    drawn = {
        name: figure.contents[kind]
        for figure, picture in figures.items()
        for kind, name in (*picture.files.items(), *picture.beside.items())
    }
    files = {name: page.encode() for name, page in pages.items()} | drawn
    cutting = sources.closure([PACKAGE / "report" / "html.py"])
    if len(cards := html.cards(document)) > 1:
        for card in cards:
            png = drawn[card.figure.pictures[0].files["png"]]
            files[card.file] = cache.recall(
                digest("card", cutting, png, card.cut), partial(html.thumbnail, png, card.cut)
            )
    texts = (text for name, text in pages.items() if name.endswith(".html"))
    files |= fonts.all_subsets(texts, lambda parts, make: cache.recall(digest("font", code, parts), make))
    files[MANIFEST] = manifest_of(document)
    return {f"{document.report.name}/{name}": content for name, content in files.items()}


def _single(
    document: "Document", figures: "dict[FigureBuild, Picture]", cache: Cache, sources: Sources
) -> dict[str, bytes]:
    """Return the page of a report with all that belongs to it in one file."""
    from atlas.report.single import single

    name = document.report.name
    files = _pages(document, figures, cache, sources)
    return {f"{name}.html": single({place.removeprefix(f"{name}/"): files[place] for place in files}, name)}


def _pdf(
    document: "Document", figures: "dict[FigureBuild, Picture]", cache: Cache, _sources: Sources
) -> dict[str, bytes]:
    """Return the PDF of a report."""
    from atlas.report import bibliography, pdf

    with cache.temporary() as work:
        (work / "figures").mkdir()
        for figure, picture in figures.items():
            if not picture.failure:
                (work / picture.printed).write_bytes(figure.contents[picture.printed.rpartition(".")[2]])
        (work / bibliography.NAME).write_text(document.bibliography.source, encoding="utf-8")
        source = pdf.source(document)
        return {f"{document.report.name}.pdf": pdf.Compiler(work).compile(source)}


MAKERS = {"html": _pages, "pdf": _pdf, "single": _single}
