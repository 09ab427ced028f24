"""One report from its TOML file to pages and PDF: figures drawn once, what fails told, everything written whole."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TypeAlias

from atlas.build.whole import publish, staging, write
from atlas.report import html, pdf
from atlas.report.colophon import colophon
from atlas.report.compose import Document, compose
from atlas.report.load import find, load
from atlas.report.views import Plate

OUT = Path("build/report")
Progress: TypeAlias = Callable[[int, int, str], None]


@dataclass(frozen=True)
class Built:
    """What a build made, which figures failed and why, and lines to tell the user."""

    name: str
    index: Path
    pdf: Path
    pages: int
    figures: int
    failures: tuple[tuple[str, str], ...] = ()
    notes: tuple[str, ...] = ()

    @property
    def ok(self) -> bool:
        """Whether every figure is there."""
        return not self.failures


def build_report(name: str | Path, out: Path = OUT, progress: Progress | None = None) -> Built:
    """Build the report of that name or file into `out`: NAME/index.html and its pages, and NAME.pdf.

    `progress` is called with the steps done, their number, and what comes next. A figure that fails leaves a framed
    note in its place and an entry in `failures`. Raises AtlasError, in one sentence, for anything wrong with the file.
    """
    report = load(find(str(name)))
    tell = progress or (lambda _done, _total, _what: None)
    tell(0, 1, "tables and scenes")
    document = compose(report)
    total = len(document.plates) + 3
    with staging(out) as stage:
        notes = _draw(document, stage / report.name, lambda done, what: tell(done + 1, total, what))
        made = colophon(report)
        tell(total - 2, total, "pages")
        pages = html.pages(document, made)
        for file, content in pages.items():
            write(stage / report.name / file, content)
        tell(total - 1, total, "PDF")
        source = pdf.source(document, made)
        write(stage / f"{report.name}.pdf", pdf.compile_pdf(source, stage / report.name))
        figures = [
            f"{report.name}/{kept}"
            for plate in document.plates.values()
            if (kept := plate.files.get("html")) is not None
        ]
        files = [*figures, *(f"{report.name}/{file}" for file in pages), f"{report.name}.pdf"]
        publish(stage, out, files, [report.name])
    tell(total, total, "done")
    failures = tuple((plate.recipe, plate.failure) for plate in document.plates.values() if plate.failure)
    return Built(
        report.name,
        out / report.name / "index.html",
        out / f"{report.name}.pdf",
        len(document.pages),
        len(document.plates) - len(failures),
        failures,
        tuple(dict.fromkeys(notes)),
    )


def _draw(document: Document, folder: Path, tell: Callable[[int, str], None]) -> list[str]:
    """Draw every plate in the formats that the pages and the PDF take; return what the user should know."""
    notes: list[str] = []
    for done, plate in enumerate(document.plates.values()):
        tell(done, f"figure {plate.recipe}")
        if plate.failure or plate.scene is None:
            continue
        try:
            notes += _drawn(plate, folder)
        except Exception as error:  # noqa: BLE001  one figure's failure must not stop the others; it is reported
            plate.failure = f"{type(error).__name__}: {error}"
    return notes


def _drawn(plate: Plate, folder: Path) -> list[str]:
    """Draw one plate: shaded as one PNG for both, else as SVG for the pages and as PDF for print."""
    from atlas.render import draw

    if plate.scene is None:
        return []
    if plate.renderer == "shaded":
        drawn = draw(plate.scene, folder / "figures" / f"{plate.stem}.png", renderer="shaded")
        if drawn.renderer == "shaded":
            plate.files = {"html": f"figures/{plate.stem}.png", "pdf": f"figures/{plate.stem}.png"}
            return []
        drawn.path.unlink()
        plate.remark = "Drawn by the vector renderer."
        plate.files = _vector(plate, folder)
        return [drawn.note] if drawn.note else []
    plate.files = _vector(plate, folder)
    return []


def _vector(plate: Plate, folder: Path) -> dict[str, str]:
    """Draw a plate on paper, for the pages and for print."""
    from atlas.render import draw

    names = {"html": f"figures/{plate.stem}.svg", "pdf": f"figures/{plate.stem}.pdf"}
    for name in names.values():
        if plate.scene is not None:
            draw(plate.scene, folder / name, renderer="vector")
    return names
