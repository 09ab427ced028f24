"""Figures by themselves, in the formats asked for: drawn, or taken from the store beside them."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from atlas.build.drawers import Drawers, many
from atlas.build.plates import Plate, Request, survey, tasks
from atlas.build.sources import Sources
from atlas.build.store import STORE, Store, place
from atlas.build.whole import room
from atlas.errors import AtlasError

OUT = Path("build/figures")
FORMATS = ("svg", "pdf", "png")


@dataclass(frozen=True)
class Figure:
    """What became of a figure: its files, what drew them, a line to tell the user, and why; or why it failed."""

    name: str
    files: tuple[Path, ...] = ()
    renderer: str = ""
    note: str = ""
    reason: str = ""
    failure: str = ""


def build_figures(
    names: Sequence[str],
    formats: Sequence[str] = FORMATS,
    out: Path = OUT,
    *,
    renderer: str = "vector",
    parameters: Mapping[str, Any] | None = None,
    jobs: int | None = None,
    progress: Callable[[int, int, str], None] = lambda _done, _total, _name: None,
) -> Iterator[Figure]:
    """Put each of the recipes into out/NAME.FORMAT for each format, each file whole or not at all.

    `jobs` of them are drawn at once, one a core when it is not given; they are returned in their order. What the store
    in `out` has under the same key, of the recipe with all code that it reaches, its parameters and the rest, is not
    drawn again. A figure that fails does not stop the others. Raises AtlasError for a shaded figure that is no PNG.
    """
    other = [one for one in formats if one != "png"]
    if renderer == "shaded" and other:
        raise AtlasError(f"a shaded figure is a PNG; {other[0]!r} is drawn by the vector renderer")
    from atlas.render import gl

    store = Store(out / STORE)
    sources = Sources(store.root / "sources.json")
    store.sweep()
    requests = [Request(name, renderer, parameters or {}, tuple(formats)) for name in names]
    plates = survey(requests, store, sources, gl.library())
    sources.save()
    absent = sum(bool(plate.missing) for plate in plates)
    with Drawers(min(absent, jobs or many())) as drawers:
        drawers.load([renderer] * absent)
        waiting = {}
        for plate, task in tasks(plates, store):
            waiting[task] = plate
            drawers.give(task)
        done = len(plates) - len(waiting)
        for task, outcome in drawers.outcomes():
            waiting[task].settle(outcome)
            done += 1
            progress(done, len(plates), waiting[task].request.recipe)
    with room(out) as beside:
        yield from (_placed(plate, out, beside) for plate in plates)


def _placed(plate: Plate, out: Path, beside: Path) -> Figure:
    """Put the files of a plate in their places."""
    name = plate.request.recipe
    if plate.failure:
        return Figure(name, reason=plate.reason, failure=plate.failure)
    files = tuple(out / f"{name}.{target}" for target in plate.request.targets)
    for target, file in zip(plate.request.targets, files, strict=True):
        place(plate.file(target), file, beside)
    return Figure(name, files, plate.facts["renderer"], plate.note, plate.reason)
