"""A report in the making: from its file to what is published, the figures drawn beside everything else."""

import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from atlas.build import ledger
from atlas.build.advance import Advance
from atlas.build.appendices import gather
from atlas.build.drawers import Drawers
from atlas.build.drawing import Task
from atlas.build.memory import Memory
from atlas.build.plates import Plate, survey, tasks
from atlas.build.record import RECORD, record_of
from atlas.build.showing import Showing
from atlas.build.sources import Sources, digest
from atlas.build.store import Store
from atlas.build.whole import publish, staging, write
from atlas.errors import AtlasError
from atlas.render import gl
from atlas.report import html, pdf
from atlas.report.appendices import Appendices
from atlas.report.colophon import colophon
from atlas.report.compose import Document, compose
from atlas.report.gallery import Gallery, gallery
from atlas.report.load import load


class Making:
    """One build of a report; afterwards what was made: `plates`, `failures`, the number of `pages`, `files`."""

    def __init__(
        self,
        file: Path,
        out: Path,
        formats: tuple[str, ...],
        store: Store,
        sources: Sources,
        drawers: Drawers,
        tell: Callable[[int, int, str], None],
    ) -> None:
        self.report = load(file)
        if self.report.name != file.stem:
            raise AtlasError(
                f"{file}: the report's name is {self.report.name!r}, but its file is called {file.stem!r}."
            )
        self.out, self.formats, self.store, self.sources = out, formats, store, sources
        self.drawers, self.tell = drawers, tell
        self.plates: list[Plate] = []
        self.pages = 0
        self.files: dict[str, list[str]] = {}
        self._times: dict[str, float] = {}
        self._memory = Memory(store.root / f"{self.report.name}.texts.json")
        self._colophon = colophon(self.report)

    @property
    def failures(self) -> list[Plate]:
        """The plates that could not be made."""
        return [plate for plate in self.plates if plate.failure]

    def run(self) -> "Making":
        """Make and publish it."""
        name = self.report.name
        with staging(self.out) as stage:
            folder = stage / name
            self.store.sweep()
            wanted = gallery(self.report)
            showing = Showing(wanted, self.formats)
            drawn = self._begin(showing)
            recorded = gather(self.report)
            document = self._compose(wanted, recorded)
            self._lap("tables")
            source = pdf.source(document, self._colophon) if "pdf" in self.formats else ""
            advance = Advance(folder, source, showing.missing(self.plates, "pdf")) if source else None
            pages = self._pages(document)
            self._lap("pages")
            if self._finish(drawn, showing):
                document = self._compose(wanted, recorded)
                source = pdf.source(document, self._colophon) if source else ""
                pages = self._pages(document)
            for plate in self.plates:
                showing.put(plate, folder)
            self._lap("figures")
            self.pages = len(document.pages)
            self.tell(len(self.plates), len(self.plates) + 1, "PDF" if advance else "publishing")
            if advance:
                write(stage / f"{name}.pdf", advance.finish(source))
                self.files["pdf"] = [f"{name}.pdf"]
            if pages:
                for page, content in pages.items():
                    write(folder / page, content)
                write(folder / RECORD, record_of(document, self._colophon, folder))
                figures = [view.files["html"] for view in wanted.values() if view.files]
                self.files["html"] = [f"{name}/{one}" for one in (*dict.fromkeys(figures), *pages, RECORD)]
            self._memory.save()
            publish(stage, self.out, [file for files in self.files.values() for file in files], [name] if pages else [])
        self._lap("PDF")
        self.tell(len(self.plates) + 1, len(self.plates) + 1, "done")
        return self

    def ledger(self, began: float, jobs: int) -> Path:
        """Write down what the build cost, and return the file."""
        path = self.out / f"{self.report.name}.costs.json"
        return ledger.write(path, self.report.name, self.plates, self._times, began, jobs)

    def _begin(self, showing: Showing) -> dict[Task, Plate]:
        """Find out which plates must be drawn, compute their scenes, and let the drawers begin."""
        found = gl.library()
        self.plates = survey(showing.requests, self.store, self.sources, found)
        self.sources.save()
        self.drawers.load([plate.request.renderer if found else "vector" for plate in self.plates if plate.missing])
        drawn = {}
        for plate, task in tasks(self.plates, self.store):
            drawn[task] = plate
            self.drawers.give(task)
        for plate in self.plates:
            showing.words(plate)
        self._lap("scenes")
        return drawn

    def _finish(self, drawn: Mapping[Task, Plate], showing: Showing) -> bool:
        """Wait until all is drawn; return whether a plate failed that the pages take to be there."""
        done = len(self.plates) - len(drawn)
        failed = False
        self.tell(done, len(self.plates) + 1, "figures")
        for task, outcome in self.drawers.outcomes():
            plate = drawn[task]
            plate.settle(outcome)
            if plate.failure:
                showing.words(plate)
                failed = True
            done += 1
            self.tell(done, len(self.plates) + 1, plate.request.recipe)
        return failed

    def _compose(self, wanted: Gallery, recorded: Appendices) -> Document:
        """Compute the tables and collect the texts; what is misspelt is told here."""
        document = compose(self.report, wanted, recorded)
        document.manuscript.memory = self._memory
        document.manuscript.check(document.cite("html"))
        self.drawers.turn()
        return document

    def _pages(self, document: Document) -> dict[str, str | bytes]:
        """Set the pages, if they are wanted."""
        self.drawers.turn()
        return html.pages(document, self._colophon, self._recall) if "html" in self.formats else {}

    def _recall(self, parts: Sequence[str], make: Callable[[], bytes]) -> bytes:
        """Return what was made from the same parts before, or make and keep it."""
        key = digest("made", list(parts))
        entry = self.store.take(key)
        if entry is None:

            def maker(folder: Path) -> dict[str, Any]:
                (folder / "content").write_bytes(make())
                return {}

            entry = self.store.make(key, maker)
        return entry.file("content").read_bytes()

    def _lap(self, step: str) -> None:
        """Note the time at the end of a step."""
        self._times[step] = time.perf_counter()
