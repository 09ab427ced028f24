"""One report from its TOML file to pages and PDF: nothing is made twice, and everything is written whole.

A report whose sources have not changed is not built at all; a plate whose key is in the store is taken from there, and
so is the text that pandoc made from the same prose.
"""

import os
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, TypeAlias

from atlas.build import fresh
from atlas.build.memory import Memory
from atlas.build.sources import Sources, digest
from atlas.build.store import Store
from atlas.build.whole import publish, staging, write
from atlas.errors import AtlasError
from atlas.report.load import find, load

OUT = Path("build/report")
STORE = ".store"
Progress: TypeAlias = Callable[[int, int, str], None]


@dataclass(frozen=True)
class Built:
    """What a build made or found, which figures failed and why, lines to tell the user, and why each part was made."""

    name: str
    index: Path
    pdf: Path
    pages: int
    figures: int
    failures: tuple[tuple[str, str], ...] = ()
    notes: tuple[str, ...] = ()
    reasons: tuple[tuple[str, str, str], ...] = ()
    ledger: Path | None = None

    @property
    def ok(self) -> bool:
        """Whether every figure is there."""
        return not self.failures


def build_report(
    name: str | Path,
    out: Path = OUT,
    progress: Progress | None = None,
    *,
    jobs: int | None = None,
    store: Path | None = None,
) -> Built:
    """Build the report of that name or file into `out`: NAME/index.html and its pages, and NAME.pdf.

    `progress` is called with the steps done, their number, and what comes next; `jobs` figures are drawn at once, one a
    core when it is not given; `store` is the folder of what was built before, `out`/.store when it is not given. A
    figure that fails leaves a framed note in its place and an entry in `failures`. Raises AtlasError, in one sentence,
    for anything wrong with the file.
    """
    began = time.perf_counter()
    file = find(str(name))
    kept = Store(store or out / STORE)
    sources = Sources(kept.root / "sources.json")
    key = fresh.key(file, sources)
    found = fresh.read(out, file.stem, key)
    if found is not None:
        return Built(
            file.stem,
            out / file.stem / "index.html",
            out / f"{file.stem}.pdf",
            found["pages"],
            found["figures"],
            reasons=(("report", file.stem, "taken: nothing it depends on has changed"),),
        )
    return _build(file, out, key, kept, sources, progress or _silent, jobs or os.cpu_count() or 1, began)


def _silent(_done: int, _total: int, _what: str) -> None:
    """Show no progress."""


def _build(
    file: Path, out: Path, key: str, store: Store, sources: Sources, tell: Progress, jobs: int, began: float
) -> Built:
    """Build a report that is not up to date."""
    from atlas.build import ledger
    from atlas.build.appendices import gather
    from atlas.build.plates import draw_gallery
    from atlas.build.record import RECORD, record_of
    from atlas.report import html, pdf
    from atlas.report.colophon import colophon
    from atlas.report.compose import compose
    from atlas.report.gallery import gallery

    report = load(file)
    if report.name != file.stem:
        raise AtlasError(f"{file}: the report's name is {report.name!r}, but its file is called {file.stem!r}.")
    wanted, recorded = gallery(report), gather(report)
    draft = compose(report, wanted, recorded)  # what is misspelt is told before anything is drawn
    draft.manuscript.check(draft.cite("html"))
    total = len(wanted) + 3
    with staging(out) as stage:
        store.sweep()
        folder = stage / report.name
        made = draw_gallery(wanted, folder, store, sources, jobs, lambda done, what: tell(done, total, what))
        sources.save()
        tell(total - 3, total, "tables")
        times = {"figures": time.perf_counter()}
        document = compose(report, wanted, recorded)
        document.manuscript.memory = memory = Memory(store.root / f"{report.name}.texts.json")
        described = colophon(report)
        tell(total - 2, total, "pages")
        times["tables"] = time.perf_counter()
        pages = html.pages(document, described, partial(_recall, store))
        for page, content in pages.items():
            write(folder / page, content)
        tell(total - 1, total, "PDF")
        times["pages"] = time.perf_counter()
        write(stage / f"{report.name}.pdf", pdf.compile_pdf(pdf.source(document, described), folder))
        times["PDF"] = time.perf_counter()
        memory.save()
        write(folder / RECORD, record_of(document, described, folder))
        figures = [f"{report.name}/{plate.files['html']}" for plate in wanted.values() if plate.files]
        files = [*figures, *(f"{report.name}/{one}" for one in (*pages, RECORD)), f"{report.name}.pdf"]
        publish(stage, out, files, [report.name])
    tell(total, total, "done")
    failures = tuple((plate.recipe, plate.failure) for plate in wanted.values() if plate.failure)
    if not failures:
        fresh.write(out, report.name, key, files, pages=len(document.pages), figures=len(wanted))
    costs = ledger.write(out / f"{report.name}.costs.json", report.name, made, times, began, jobs)
    return Built(
        report.name,
        out / report.name / "index.html",
        out / f"{report.name}.pdf",
        len(document.pages),
        len(wanted) - len(failures),
        failures,
        tuple(dict.fromkeys(one.note for one in made if one.note)),
        tuple(("figure", one.request.name, one.reason) for one in made),
        costs,
    )


def _recall(store: Store, parts: Sequence[str], make: Callable[[], bytes]) -> bytes:
    """Return what was made from the same parts before, or make and keep it."""
    key = digest("made", list(parts))
    entry = store.take(key)
    if entry is None:

        def maker(folder: Path) -> dict[str, Any]:
            (folder / "content").write_bytes(make())
            return {}

        entry = store.make(key, maker)
    return entry.file("content").read_bytes()
