"""One report from its TOML file to pages and PDF: nothing is made twice, and everything is written whole.

A report whose sources have not changed is not built at all; a plate whose key is in the store is taken from there, and
so is the text that pandoc made from the same prose. While processes of their own draw what is missing, the pages are
set from what the scenes already tell, and the PDF in advance.
"""

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeAlias

from atlas.build import fresh
from atlas.build.sources import Sources
from atlas.build.store import STORE, Store
from atlas.errors import AtlasError
from atlas.report.load import find, load
from atlas.report.records import Figure

OUT = Path("build/report")
FORMATS = ("html", "pdf")
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
    formats: Sequence[str] = FORMATS,
    jobs: int | None = None,
    store: Path | None = None,
) -> Built:
    """Build the report of that name or file into `out`: NAME/index.html and its pages, and NAME.pdf.

    `progress` is called with the steps done, their number, and what comes next; `formats` may leave out the pages or
    the PDF, which then stay as they are; `jobs` processes draw figures, one a core when it is not given; `store` is the
    folder of what was built before, `out`/.store when it is not given. A figure that fails leaves a framed note in its
    place and an entry in `failures`. Raises AtlasError, in one sentence, for anything wrong with the file.
    """
    began = time.perf_counter()
    file = find(str(name))
    results = out / file.stem / "index.html", out / f"{file.stem}.pdf"
    wanted = tuple(one for one in FORMATS if one in formats)
    kept = Store(store or out / STORE)
    sources = Sources(kept.root / "sources.json")
    before = kept.root.exists() or fresh.noted(out, file.stem).exists()
    key = fresh.key(file, sources) if before else ""
    found = fresh.read(out, file.stem, key, wanted)
    if found is not None:
        reasons = (("report", file.stem, "taken: nothing it depends on has changed"),)
        return Built(file.stem, *results, found["pages"], found["figures"], reasons=reasons)
    from atlas.build.drawers import Drawers, many

    with Drawers(jobs or many()) as drawers:
        report = load(file)
        if report.name != file.stem:
            raise AtlasError(f"{file}: the report's name is {report.name!r}, but the file is called {file.stem!r}.")
        if report.name.startswith("."):
            raise AtlasError(f"{file}: the report's name {report.name!r} must not begin with a dot.")
        if not before:
            figures = sum(isinstance(block, Figure) for page in report.pages for block in page.blocks)
            drawers.load(["vector"] * figures)  # all will have to be drawn
            key = fresh.key(file, sources)
        from atlas.build.showing import Showing

        showing = Showing(report, kept, sources, drawers)
        from atlas.build.making import Making  # here, while the drawers load what they need

        made = Making(report, showing, out, wanted, kept, sources)
        made.run(drawers, progress or _silent)
    if not made.failures:
        fresh.write(out, file.stem, key, made.files, pages=made.pages, figures=len(made.plates))
    return Built(
        file.stem,
        *results,
        made.pages,
        len(made.plates) - len(made.failures),
        tuple((plate.request.recipe, plate.failure) for plate in made.failures),
        tuple(dict.fromkeys(plate.note for plate in made.plates if plate.note)),
        tuple(("figure", plate.request.name, plate.reason) for plate in made.plates),
        made.ledger(began, drawers.count),
    )


def _silent(_done: int, _total: int, _what: str) -> None:
    """Show no progress."""
