"""A composed report in each format: its texts set, its pages, the one file, the PDF."""

import re
from base64 import b64encode
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from atlas.book.building.cache import Cache
from atlas.book.texts import title_words
from atlas.errors import AtlasError
from atlas.files import digest_of
from atlas.libraries import versions
from atlas.sources import PACKAGE, Sources, digest

if TYPE_CHECKING:
    from atlas.book.blocks.figure import Picture
    from atlas.book.building.figures import FigureBuild
    from atlas.book.document import Document
    from atlas.book.pandoc import Target


MANIFEST = "manifest.json"
"""By it a folder is known to be of a report, which may be built anew."""
LANGUAGES: Mapping[str, "Target"] = {"html": "html", "pdf": "typst", "single": "html"}
"""In which language the texts of each format are set; `single` is one page as one file, if it is asked for."""


TYPES = {
    "svg": "image/svg+xml", "png": "image/png", "pdf": "application/pdf", "gz": "application/gzip",
    "woff": "font/woff",
}  # fmt: skip
HANDED_OVER = """
// What this page would fetch by a script element stands in it as a block of data.
document.head.append = (...nodes) => {
  for (const node of nodes) {
    const inside = node.localName === "script" && document.querySelector(`script[data-file="${node.getAttribute("src")}"]`);
    if (inside) { node.removeAttribute("src"); node.text = inside.textContent; }
  }
  Element.prototype.append.apply(document.head, nodes);
};
"""  # noqa: E501  a line of a script
INDEX = "index.html"
_SCRIPT = re.compile(r'<script src="([^"]+)" defer></script>\n?')


def set_texts(document: "Document", formats: Sequence[str], cache: Cache, sources: Sources) -> None:
    """Typeset a document's texts for these formats ("html", "pdf", "single") into `document.written`, in place.

    Texts that an earlier build has set come from the cache. `sources` digests the code of the texts.
    """
    # pages of one object have most of their texts in common
    group = "a page" if len(document.pages) == 1 else document.report.name
    name = f"texts of {group} by {sources.closure([PACKAGE / 'book' / 'texts.py'])}"
    document.texts.memory = cache.load(name)
    document.set(*dict.fromkeys(LANGUAGES[form] for form in formats))
    cache.save(name, document.texts.used)


def manifest_of(document: "Document") -> bytes:
    """Return the manifest of a report as JSON: its name, its title in plain words, and versions by library."""
    from atlas.book.templates import versions

    report = document.report
    manifest = {"report": report.name, "title": title_words(report.title), "versions": versions()}
    return msgspec.json.format(msgspec.json.encode(manifest), indent=1) + b"\n"


def _pages(
    document: "Document", figures: "dict[FigureBuild, Picture]", cache: Cache, sources: Sources
) -> dict[str, bytes]:
    """Return the HTML pages of a report and all files beside them (figures, cards, fonts, manifest), contents by path.

    A path begins with the report's name. `figures` are the drawn figures with their pictures; thumbnails and fonts
    that an earlier build has made come from the cache. `sources` digests the code of both.
    """
    from atlas.book import fonts, html

    code = sources.closure([PACKAGE / "book" / "fonts.py"])
    pages = html.pages(document)
    contents = {
        name: figure.contents[kind]
        for figure, picture in figures.items()
        for kind, name in (*picture.files.items(), *picture.beside.items())
    }
    files = {name: page.encode() for name, page in pages.items()} | contents
    cutting = sources.closure([PACKAGE / "book" / "html.py"])
    if len(cards := html.cards(document)) > 1:
        for card in cards:
            png = contents[card.figure.pictures[0].files["png"]]
            files[card.file] = cache.recall(
                digest("card", cutting, png, card.cut), partial(html.thumbnail, png, card.cut)
            )
    texts = (text for name, text in pages.items() if name.endswith(".html"))
    files |= fonts.all_subsets(texts, lambda pieces, make: cache.recall(digest("font", code, pieces), make))
    files[MANIFEST] = manifest_of(document)
    return {f"{document.report.name}/{name}": content for name, content in files.items()}


def _single(
    document: "Document", figures: "dict[FigureBuild, Picture]", cache: Cache, sources: Sources
) -> dict[str, bytes]:
    """Return {"NAME.html": content}: the page of a one-page report as one file with everything that it needs.

    The parameters are those of `_pages`. Raises AtlasError for a report of several pages.
    """
    name = document.report.name
    files = _pages(document, figures, cache, sources)
    return {f"{name}.html": single({place.removeprefix(f"{name}/"): files[place] for place in files}, name)}


def single(files: Mapping[str, bytes], name: str) -> bytes:
    """Return a one-page report's files joined into one page, as UTF-8. Raises AtlasError for a report of several pages.

    `files` has the page, index.html, and the files that belong to it, by path; `name` is that of the
    report, whose PDF may lie beside the page. Figures can be saved from it; its policy lets it run its own
    scripts, by their digests.
    """
    pages = [file for file in files if file.endswith(".html")]
    if pages != [INDEX]:
        raise AtlasError(f"one file holds one page, but the report has {len(pages)}: leave out the format 'single'.")

    def data(place: str) -> str:
        kind = TYPES[place.rpartition(".")[2]]
        return f"data:{kind};base64,{b64encode(files[place]).decode()}"

    page = files[INDEX].decode()
    style = re.sub(r'url\("?([^")]+)"?\)', lambda matched: f'url("{data(matched[1])}")', files["style.css"].decode())
    sources = _SCRIPT.findall(page)
    later = [file for file in files if file.endswith(".js") and file not in sources]
    scripts = {file: _inline(files[file].decode()) for file in (*later, *sources)}
    scripts |= {"index.js": scripts["index.js"].replace(f'"{INDEX}"', '""')}
    page = _SCRIPT.sub("", page)
    page = page.replace('<link rel="stylesheet" href="style.css">', f"<style>\n{style}</style>")
    # a browser saves the picture itself: no second copy of it
    page = re.sub(r'<a href="figures/[^"]+\.svg" aria-label[^>]*>SVG</a> ', "", page)
    page = re.sub(r'(<figure id="([^"]+)">\s*<div class="pictures">\s*<a href=")[^"]+', r"\1#\2", page)
    page = re.sub(r'<a href="(figures/([^"]+))"', lambda x: f'<a download="{x[2]}" href="{data(x[1])}"', page)
    page = re.sub(r'(src|srcset)="(figures/[^"]+\.(?:svg|png))"', lambda x: f'{x[1]}="{data(x[2])}"', page)
    page = re.sub(rf'href="{INDEX}(#[^"]*)?"', lambda matched: f'href="{matched[1] or "#page-index"}"', page)
    page = page.replace(f'href="../{name}.pdf"', f'href="{name}.pdf"')
    run = [HANDED_OVER, *(scripts[file] for file in sources)]
    blocks = [f'<script type="text/plain" data-file="{file}">{scripts[file]}</script>' for file in later]
    blocks += [f"<script>{text}</script>" for text in run]
    page = page.replace("</body>", "\n".join([*blocks, "</body>"]))
    allowed = (sha256(text.encode()).digest() for text in (*run, *(scripts[file] for file in later)))
    digests = " ".join(f"'sha256-{b64encode(digest).decode()}'" for digest in allowed)
    policy = (
        f"default-src 'none'; img-src data:; font-src data:; style-src 'unsafe-inline'; script-src {digests}; "
        "base-uri 'none'; form-action 'none'"
    )
    return re.sub(r'(http-equiv="Content-Security-Policy" content=")[^"]*', rf"\g<1>{policy}", page).encode()


def _inline(script: str) -> str:
    """Return a script in which "</script" and "<!--", which would end its HTML element, have a backslash."""
    return script.replace("</script", r"<\/script").replace("<!--", r"<\!--")


def files_of(
    document: "Document",
    formats: Sequence[str],
    figures: "dict[FigureBuild, Picture]",
    cache: Cache,
    sources: Sources,
) -> Iterator[tuple[str, dict[str, bytes]]]:
    """Yield (format, files) of the wanted `formats`, files as contents by path: pages first, while Typst sets the PDF.

    `figures` are the drawn figures with their pictures. The cache holds the last PDF of each report, which is taken
    where nothing in it has changed. Typst never gives memory back: a process of its own, where there can be one,
    ends with the report. Raises AtlasError if that process is ended, and for the format "single" of a report of
    several pages. `sources` digests the code that an entry depends on.
    """
    from concurrent.futures.process import BrokenProcessPool

    from atlas import processes
    from atlas.book import fonts, typesetting

    name, printed = document.report.name, None
    with cache.temporary() as work, processes.pool(1) or ThreadPoolExecutor(1) as executor:
        if "pdf" in formats:
            files = [*map(fonts.source, fonts.FACES.values())]
            source = _typst_source(document, figures, work)
            entry, key = digest("PDF", name), _pdf_key(source, work, files, sources).encode()
            key_before, _, content = (cache.get(entry) or b"").partition(b"\n")
            if key_before != key:
                printed = executor.submit(typesetting.compiled, source, work, files)
        for form, make in (("html", _pages), ("single", _single)):
            if form in formats:
                yield form, make(document, figures, cache, sources)
        if printed is not None:
            try:
                content = printed.result()
            except BrokenProcessPool:
                reason = "the process that sets it was ended; is there enough memory?"
                raise AtlasError(f"{name}.pdf: {reason}") from None
            cache.put(entry, key + b"\n" + content)
        if "pdf" in formats:
            yield "pdf", {f"{name}.pdf": content}


def _pdf_key(source: str, folder: Path, faces: Sequence[Path], sources: Sources) -> str:
    """Return the digest of all that a PDF depends on: its Typst `source`, files in `folder`, fonts, code and Typst.

    `faces` are the paths of the fonts; `sources` digests the code.
    """
    folder_digests = {
        path.relative_to(folder).as_posix(): digest_of(path) for path in folder.rglob("*") if path.is_file()
    }
    code = sources.closure([PACKAGE / "book" / "typesetting.py"])
    return digest(source, folder_digests, [digest_of(face) for face in faces], code, versions())


def _typst_source(document: "Document", figures: "dict[FigureBuild, Picture]", folder: Path) -> str:
    """Return the Typst source of a report, and write the figures and the bibliography that it names into `folder`.

    `figures` are the drawn figures with their pictures; those that failed are left out.
    """
    from atlas.book import bibliography, pdf

    (folder / "figures").mkdir()
    for figure, picture in figures.items():
        if not picture.failure:
            (folder / picture.printed).write_bytes(figure.contents[picture.printed.rpartition(".")[2]])
    (folder / bibliography.NAME).write_text(document.bibliography.source, encoding="utf-8")
    return pdf.source(document)
