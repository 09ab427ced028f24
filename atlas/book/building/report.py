"""One report from its file to pages and PDF: only changed parts are made, and each format is written whole.

The order: is anything new at all; which figures are missing; draw them; compute the tables and set the texts; set the
pages and the PDF; write them beside their places, and rename them.
"""

import hashlib
import os
import sys
import time
from collections.abc import Callable, Container, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import lru_cache, partial
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import msgspec

from atlas.book.beside import Outline, RelatedReports
from atlas.book.building.cache import Cache
from atlas.book.building.formats import LANGUAGES, files_of, set_texts
from atlas.book.building.publish import publish
from atlas.book.files import find, related_to
from atlas.book.inputs import evaluated, name_of
from atlas.errors import AtlasError
from atlas.files import digest_of
from atlas.libraries import versions
from atlas.places import cache_folder, folder
from atlas.sources import DISTURBED, PACKAGE, Sources, digest

if TYPE_CHECKING:
    from atlas.book.appendices import Described
    from atlas.book.blocks.figure import Picture
    from atlas.book.building.figures import FigureBuild
    from atlas.book.definition import Report
    from atlas.book.document import Document

FORMATS = ("html", "pdf")
Progress = Callable[[int, int, str], None]


@dataclass(frozen=True)
class Built:
    """Result of a build: name, paths of the first page and the PDF, counts of pages and figures drawn, and failures.

    `failures` are pairs (stem of the figure, reason), `notes` lines for the user, `reasons` tuples (part, name,
    reason why it was made or taken), `costs` the path of the JSON file with the figures' costs, None where nothing
    was built.
    """

    name: str
    index: Path
    pdf: Path
    pages: int
    figures: int
    failures: tuple[tuple[str, str], ...] = ()
    notes: tuple[str, ...] = ()
    reasons: tuple[tuple[str, str, str], ...] = ()
    costs: Path | None = None

    @property
    def single(self) -> Path:
        """Path of the report as one file, NAME.html beside the PDF; it exists only if that format was asked for."""
        return self.pdf.with_name(f"{self.name}.html")

    @property
    def ok(self) -> bool:
        """Whether no figure failed."""
        return not self.failures


def build_report(
    name: str | Path,
    out: Path,
    progress: Progress = lambda _done, _total, _what: None,
    *,
    formats: Sequence[str] = FORMATS,
    style: str | None = None,
    jobs: int | None = None,
    inputs: Mapping[str, str] = MappingProxyType({}),
) -> Built:
    """Build the report of that name or file into `out`: NAME/index.html and its pages, and NAME.pdf.

    `progress` is called with steps done, their number, name of the next step; `formats` may leave out the pages or
    the PDF, which then stay as they are, or ask for `single`, NAME.html, one page with all its files; `style` is a
    style sheet of Matplotlib for the figures, a file or a name, which replaces that of the report's file; `jobs`
    workers draw them, one a core when it is not given; `inputs` are texts by name, and where they differ from the
    defaults NAME ends with a digest of their values. A report that is unchanged is not built again. A figure that
    fails leaves a framed note in its place and an entry in `failures`. The pages are in their place before the PDF
    is set. Raises AtlasError, in one sentence, for anything wrong with the file, and OSError when something can't
    be written; then the files of the last report stay that were not yet replaced.
    """
    file, formats = find(str(name)), [form for form in LANGUAGES if form in formats]
    cache = Cache(cache_folder(out))
    sources, values = Sources(cache), evaluated(file, inputs)
    name = name_of(file, values)
    try:
        key = key_of(file, sources, style, values) if cache.load(_noted(name, out)) else None
        unchanged = None if key is None else _unchanged(file, name, out, formats, cache, sources, key)
        return unchanged or _build(file, name, values, out, formats, style, jobs, cache, sources, key, progress)
    except OSError as error:
        place = f": {error.filename}" if error.filename else ""
        raise OSError(f"the build in {out} stopped: {error.strerror or error}{place}.") from error


def key_of(file: Path, sources: Sources, style: str | None = None, values: Mapping[str, Any] | None = None) -> str:
    """Return the digest of all that a report depends on, but for the answers of its related reports, see `outlines`.

    That is its file, inputs, style, recipes and bibliographies, the code, templates and libraries. `style` is a
    style sheet of Matplotlib, a file or a name, and `values` are the report's inputs by name; None for none.
    `sources` digests files of code.
    """
    return digest(
        _sources_digest(file, sources), related_to(file), values or {}, sources.named(style), _program(sources)
    )


def _sources_digest(file: Path, sources: Sources) -> str:
    """Return the digest of a report's file and of the files in its folder that it names: recipes, styles, Markdown.

    All BibTeX files of the folder count too, and for a report with a gallery all its recipes.
    """
    text = file.read_bytes()
    neighbours = (path for kind in ("*.py", "*.md", "*.mplstyle") for path in file.absolute().parent.glob(kind))
    sources_beside = (
        path for path in neighbours if os.fsencode(path.name) in text or (b"gallery" in text and path.suffix == ".py")
    )
    return sources.closure([file, *file.parent.glob("*.bib"), *sources_beside])


@lru_cache(maxsize=1)
def _program(sources: Sources) -> str:
    """Return the digest of what every report depends on: code, recipes, templates, records, libraries."""
    from atlas import gl

    code = [PACKAGE / "book" / "building" / "report.py", *folder("figures").glob("*.py")]
    places = folder("templates"), folder("reports") / "data", PACKAGE
    extra = (path for place in places for path in place.rglob("*") if path.suffix not in {".py", ".pyc"})
    content = sources.closure([*code, *filter(Path.is_file, extra)])
    sources.save()
    return digest(content, sys.version_info[:2], versions(), gl.library())


def _unchanged(
    file: Path, name: str, out: Path, formats: Sequence[str], cache: Cache, sources: Sources, key: str
) -> Built | None:
    """Return the `Built` of the existing report if each of its `formats` was built with this key, else None.

    None also where its files were edited, and where its related reports answer differently now than at that build, see
    `RelatedReports`. `name` is that of its folder in `out`.
    """
    record_before = cache.load(_noted(name, out))
    for form in formats:
        record = record_before.get(form, {"key": None})
        if record["key"] != key or any(digest_of(out / file) != digest for file, digest in record["files"].items()):
            return None
    related = outlines(file, cache, sources)
    if not all(related.agrees(record_before[form]["beside"]) for form in formats):
        return None
    reasons = (("report", name, "taken: nothing it depends on has changed"),)
    return Built(name, *_places(out, name), record_before["pages"], record_before["figures"], reasons=reasons)


def _noted(name: str, out: Path) -> str:
    """Return the name under which the cache holds the record of the builds of a report in the folder `out`."""
    return f"report {name} in {out.resolve()}"


def _build(
    file: Path,
    name: str,
    values: Mapping[str, Any],
    out: Path,
    formats: Sequence[str],
    style: str | None,
    jobs: int | None,
    cache: Cache,
    sources: Sources,
    key: str | None,
    progress: Progress,
) -> Built:
    """Build a report whose inputs have these `values`, by name, and return its `Built`.

    `file` is the report's, `name` that of its folder in `out`; `formats`, `style`, `jobs` and `progress` are those
    of `build_report`. `key` is that of `key_of`; if None, it is computed while the figures are drawn. Raises
    AtlasError for a mistake in the report, and at the end for files that the user edited. `cache` holds what
    earlier builds made, `sources` digests files of code.
    """
    from atlas import gl
    from atlas.book.building import figures
    from atlas.book.load import load
    from atlas.book.pictures import on_cards, pictures

    times = {"start": time.perf_counter()}
    sources.closure([file])  # as it is read now
    report = load(file, values)
    _check(report.name, file)
    report = msgspec.structs.replace(report, name=name)
    check_style(style := style or report.style or None)
    cache.prune()
    drawings = pictures(report)
    cards = on_cards(report) if "html" in formats and len(report.pages) > 1 else ()
    builds = _figures(drawings, formats, style, gl.library(), cards)
    figures.find(list(builds), cache, sources, gl.library())
    times["look"] = time.perf_counter()
    steps, jobs = len(builds) + 2, jobs or figures.cores()
    with ThreadPoolExecutor(1) as pool:
        found_out = pool.submit(lambda: key or key_of(file, sources, style, values))
        if DISTURBED:  # by Matplotlib, which parses its style sheets
            found_out.result()
        figures.draw(list(builds), cache, jobs, lambda done, _, stem: progress(done, steps, stem))
    key = found_out.result()
    times["figures"] = time.perf_counter()
    progress(steps - 2, steps, "texts")
    document = document_of(report, file, drawings, builds, cache, sources)
    times["tables"] = time.perf_counter()
    set_texts(document, formats, cache, sources)
    times["texts"] = time.perf_counter()
    progress(steps - 1, steps, "pages")
    failures = [figure for figure in builds if figure.failure]
    counts = {"pages": len(document.pages), "figures": len(builds) - len(failures)}
    edited: list[str] = []
    for form, files in files_of(document, formats, builds, cache, sources):
        try:
            _publish(document, out, form, files, None if failures else key, counts, cache)
            if form == "html" and "pdf" in formats:
                progress(steps - 1, steps, f"{_places(out, name)[0]} is ready; the PDF follows.")
        except AtlasError as error:  # of files that a user has edited, which stay
            edited.append(str(error))
    if edited:
        raise AtlasError(" ".join(edited))
    times["pages"] = time.perf_counter()
    progress(steps, steps, "done")
    return Built(
        report.name,
        *_places(out, report.name),
        counts["pages"],
        counts["figures"],
        failures=tuple((figure.stem, figure.failure) for figure in failures),
        notes=tuple(dict.fromkeys(note for figure in builds if (note := figure.facts.get("note")))),
        reasons=tuple(("figure", figure.name, figure.reason) for figure in builds),
        costs=figures.write_costs(out / f"{report.name}.costs.json", report.name, list(builds), times, jobs),
    )


def _publish(
    document: "Document",
    out: Path,
    form: str,
    files: Mapping[str, bytes],
    key: str | None,
    counts: dict[str, int],
    cache: Cache,
) -> None:
    """Write the files of the format `form`, contents by path, into `out`; save digests, key and counts in the cache.

    The answers of the `RelatedReports` are saved too. `key` is None if a figure failed, so that the next build starts
    anew; `counts` are the numbers of pages and figures. Raises AtlasError for files that the user edited.
    """
    name = document.report.name
    record: dict[str, Any] = cache.load(_noted(name, out))
    before = [item for form in LANGUAGES for item in record.get(form, {"files": {}})["files"].items()]
    publish({form: files}, out, name, [f"{digest_before}  {path}" for path, digest_before in before])
    digests = {path: hashlib.sha256(content).hexdigest() for path, content in files.items()}
    record[form] = {"key": key, "files": digests, "beside": document.related.answers}
    cache.save(_noted(name, out), {**record, **counts})


def document_of(
    report: "Report",
    file: Path,
    drawings: "Mapping[str, Picture]",
    builds: "Mapping[FigureBuild, Picture]",
    cache: Cache,
    sources: Sources,
) -> "Document":
    """Return the `Document` of a report, with computed tables; `builds` gives the drawn figures their captions.

    `file` is the report's file, beside which its bibliography lies; `drawings` are all its pictures by key. The
    pictures of `builds` are changed in place, see `describe`.
    """
    from atlas.book import bibliography
    from atlas.book.building.records import gather
    from atlas.book.compose import compose

    for figure, picture in builds.items():
        describe(figure, picture)
    works = bibliography.read(file.parent / report.bibliography) if report.bibliography else None
    appendices = gather(report, partial(_reference, cache, sources))
    return compose(report, drawings, appendices, works, outlines(file, cache, sources))


def _reference(cache: Cache, sources: Sources) -> "dict[str, Described]":
    """Return `atlas.book.building.records.described`, which loads the whole package, from the cache if that has it."""
    from atlas.book.appendices import Described
    from atlas.book.building.records import described

    key = digest("reference", _program(sources))
    content = cache.recall(key, lambda: msgspec.json.encode(described()))
    return msgspec.json.decode(content, type=dict[str, Described])


def outlines(file: Path, cache: Cache, sources: Sources) -> RelatedReports:
    """Return the `RelatedReports` of the report in `file`: outlines with links, ledger entries and uses.

    No table of theirs is computed. An outline that an earlier build has made comes from the cache; `sources`
    digests the code that it depends on.
    """

    def outline(file: Path) -> bytes:
        from atlas.book.compose import compose
        from atlas.book.load import load
        from atlas.book.pictures import pictures

        report = load(file)
        return msgspec.json.encode(compose(report, pictures(report), outline=True).outline)

    def remembered(file: Path) -> Outline:
        key = digest("outline", _sources_digest(file, sources), _program(sources))
        answers: Outline = msgspec.json.decode(cache.recall(key, partial(outline, file)))
        return answers

    return RelatedReports(remembered(find(name)) for name in related_to(file))


def _places(out: Path, name: str) -> tuple[Path, Path]:
    """Return (path of a report's first page, path of its PDF)."""
    return out / name / "index.html", out / f"{name}.pdf"


def _check(name: str, file: Path) -> None:
    """Raise AtlasError for a report's name that is not that of its file, without suffix, or that begins with a dot."""
    if name.startswith("."):
        raise AtlasError(f"{file}: the report's name {name!r} must not begin with a dot.")
    if name != file.stem:
        raise AtlasError(f"{file}: the report's name is {name!r}, and must be that of its file, {file.stem!r}.")


def check_style(style: str | None) -> None:
    """Raise AtlasError for a style sheet, a file or a name, that Matplotlib can't use; None is allowed."""
    if style is not None:
        from atlas.pictures.drawing.style import context

        with context(style):
            pass


def _figures(
    pictures: "Mapping[str, Picture]",
    formats: Sequence[str],
    style: str | None,
    library: str | None,
    cards: Container[str] = (),
) -> "dict[FigureBuild, Picture]":
    """Return {build: picture}, the figures of a report to be drawn: shaded ones as PNG, others as SVG and PDF.

    Pictures whose recipe failed are left out. The SVG is for the pages (``html`` or ``single`` among the
    `formats`), which offer each figure as PDF too, and its data as CSV; they stack its panels on a narrow screen,
    and turn panels in space. Pictures that front-page `cards` show, by key, are drawn as PNG as well. `library`
    draws shaded pictures; without one (None) they are drawn as the others. `style` is a style sheet of Matplotlib
    or None.
    """
    from atlas.book.building.figures import FigureBuild

    html_kinds = ("csv.gz", "narrow", "scene", "moves") if {"html", "single"} & set(formats) else ()

    def kinds(key: str, renderer: str) -> tuple[str, ...]:
        if renderer == "shaded" and library:
            return "png", *html_kinds
        return *(("svg",) if html_kinds else ()), "pdf", *(("png",) if key in cards else ()), *html_kinds

    return {
        FigureBuild(picture.recipe, picture.parameters, picture.renderer, kinds(key, picture.renderer), style): picture
        for key, picture in pictures.items()
        if not picture.failure
    }


def describe(figure: "FigureBuild", picture: "Picture") -> None:
    """Set caption, alternative text, size in millimetres, file names and remark of a picture from a drawn figure.

    Of a figure that failed only `failure` is set.
    """
    from atlas.book.digits import markdown_of

    picture.failure = figure.failure
    if not figure.failure:
        facts = figure.facts
        picture.tables = tuple(facts["commands"])
        picture.caption, picture.alt, picture.size = facts["caption"], facts["alt"], tuple(facts["size"])
        picture.given = {name: markdown_of(value) for name, value in facts["parameters"].items()}
        kind, place = "svg" if "pdf" in figure.kinds else "png", f"figures/{picture.stem}"
        picture.file = f"{place}.{kind}"
        side_files = {"narrow": f"{place}-narrow.{kind}", "scene": f"{place}.js", "moves": f"{place}-moves.js"}
        picture.beside = {name: file for name, file in side_files.items() if figure.contents.get(name)}
        picture.files = {name: f"{place}.{name}" for name in figure.kinds if name not in side_files}
        picture.remark = "Drawn by the vector renderer." if facts["note"] else ""
