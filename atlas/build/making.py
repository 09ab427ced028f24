"""A report in the making: from its file to what is published, the figures drawn beside everything else."""

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from atlas.build import fresh, ledger
from atlas.build.advance import Advance
from atlas.build.appendices import gather
from atlas.build.compiled import Compiled
from atlas.build.drawers import Drawers
from atlas.build.drawing import Drawn, Task
from atlas.build.memory import Memory
from atlas.build.plates import Plate, tasks
from atlas.build.record import RECORD, record_of
from atlas.build.showing import Showing
from atlas.build.sources import PACKAGE, Sources, digest
from atlas.build.store import Store
from atlas.build.whole import publish, staging, write
from atlas.errors import AtlasError
from atlas.report import html, pdf
from atlas.report.appendices import Appendices
from atlas.report.colophon import colophon
from atlas.report.compose import Document, compose
from atlas.report.formulas import Target
from atlas.report.records import Report

TARGETS: Mapping[str, Target] = {"html": "html", "pdf": "typst"}
"""In which language the texts of each format are set."""


class Making:
    """One build of a report; afterwards what was made: the `plates`, the number of `pages`, `files` by format."""

    def __init__(
        self, report: Report, showing: Showing, out: Path, formats: tuple[str, ...], store: Store, sources: Sources
    ) -> None:
        self.report, self.out, self.formats = report, out, formats
        self.plates = showing.plates
        self.pages = 0
        self.files: dict[str, list[str]] = {}
        self._showing, self._store = showing, store
        setter = sources.closure([PACKAGE / "report" / "formulas.py"])
        self._memory = Memory(store.root / f"{report.name}.texts.json", setter)
        self._colophon = colophon(report)
        self._code = sources.alone([PACKAGE / "report" / f"{one}.py" for one in ("fonts", "html", "pdf")])
        self._compiled = Compiled(store, self._code)
        self._times: dict[str, float] = {}

    @property
    def failures(self) -> list[Plate]:
        """The plates that could not be made."""
        return [plate for plate in self.plates if plate.failure]

    def run(self, drawers: Drawers, tell: Callable[[int, int, str], None]) -> None:
        """Make and publish it."""
        name, showing, steps = self.report.name, self._showing, len(self.plates) + 1
        self._refuse_foreign()
        with staging(self.out) as stage:
            folder = stage / name
            self._store.sweep()
            drawn = self._begin(drawers)
            outcomes = drawers.outcomes()
            recorded = gather(self.report)
            document = self._compose(recorded)
            source = self._source(document)
            advance = Advance(folder, source, showing.missing()) if source else None
            pages = self._pages(document)
            self._lap("pages")
            failed = False
            for done, plate in enumerate(self._finished(outcomes, drawn), steps - 1 - len(drawn)):
                tell(done, steps, plate.request.recipe)
                failed |= bool(plate.failure)
            if failed:
                document = self._compose(recorded)
                source = self._source(document)
                pages = self._pages(document)
            if advance:
                advance.make_way()
            for plate in self.plates:
                showing.put(plate, folder)
            self._lap("figures")
            tell(steps - 1, steps, "PDF" if advance else "pages")
            with ThreadPoolExecutor(1) as thread:
                fonts = thread.submit(html.fonts, pages, self._recall) if pages else None
                if advance:
                    write(stage / f"{name}.pdf", advance.finish(source))
                    self.files["pdf"] = [f"{name}.pdf"]
            if fonts:
                for page, content in (set_pages := fonts.result() | pages).items():
                    write(folder / page, content)
                write(folder / RECORD, record_of(document, self._colophon, folder))  # by it a report is known as one
                figures = dict.fromkeys(view.file for view in showing.gallery.values() if view.file)
                self.files["html"] = [f"{name}/{one}" for one in (RECORD, *figures, *set_pages)]
            self._memory.save()
            self.pages = len(document.pages)
            publish(stage, self.out, [file for files in self.files.values() for file in files], [name] if pages else [])
        self._lap("PDF")
        tell(steps, steps, "done")

    def ledger(self, began: float, jobs: int) -> Path:
        """Write down what the build cost, and return the file."""
        path = self.out / f"{self.report.name}.costs.json"
        return ledger.write(path, self.report.name, self.plates, self._times, began, jobs)

    def _refuse_foreign(self) -> None:
        """Refuse a folder for the pages that holds something else: what is no page would be removed from it."""
        folder = self.out / self.report.name
        known = (folder / RECORD).exists() or fresh.noted(self.out, self.report.name).exists()
        if "html" in self.formats and not known and folder.is_dir() and any(folder.iterdir()):
            raise AtlasError(f"{folder} holds files that are of no report; move them, or choose another --out.")

    def _begin(self, drawers: Drawers) -> dict[Task, Plate]:
        """Compute the scenes of what must be drawn, and let the drawers begin."""
        drawn = {}
        for plate, task in tasks(self.plates, self._store):
            drawn[task] = plate
            drawers.give(task)
        for plate in self.plates:
            self._showing.words(plate)
        self._lap("scenes")
        return drawn

    def _finished(self, outcomes: Iterator[tuple[Task, Drawn | str]], drawn: Mapping[Task, Plate]) -> Iterator[Plate]:
        """Go through the plates as they are drawn."""
        for task, outcome in outcomes:
            plate = drawn[task]
            plate.settle(outcome)
            self._showing.words(plate)
            yield plate

    def _compose(self, recorded: Appendices) -> Document:
        """Compute the tables and set the texts; what is misspelt is told here."""
        document = compose(self.report, self._showing.gallery, recorded)
        document.manuscript.memory = self._memory
        self._lap("tables")
        document.set(*(TARGETS[one] for one in self.formats))
        self._lap("texts")
        return document

    def _pages(self, document: Document) -> dict[str, str]:
        """Set the pages, if they are wanted."""
        return html.pages(document, self._colophon, self._compiled) if "html" in self.formats else {}

    def _source(self, document: Document) -> str:
        """Write the source of the PDF, if that is wanted."""
        return pdf.source(document, self._colophon, self._compiled) if "pdf" in self.formats else ""

    def _recall(self, parts: Sequence[str], make: Callable[[], bytes]) -> bytes:
        """Return what was made from the same parts before, or make and keep it."""
        key = digest("made", self._code, list(parts))
        return self._store.recall(key) or self._store.keep(key, make())

    def _lap(self, step: str) -> None:
        """Note the time at the end of a step."""
        self._times[step] = time.perf_counter()
