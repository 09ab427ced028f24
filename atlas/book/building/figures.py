"""Figures with their dependencies, taken from the cache or drawn by worker processes in parallel."""

import json
import os
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Future, as_completed
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any

from atlas import files, processes
from atlas.arithmetic.machine import processors
from atlas.book.building import worker
from atlas.book.building.cache import Cache
from atlas.book.building.publish import publish
from atlas.errors import AtlasError
from atlas.libraries import versions
from atlas.places import cache_folder, folder, settle_matplotlib
from atlas.sources import PACKAGE, Sources, digest

MAX_WORKERS = 8
"""As many workers as there may be when the user does not say how many."""
Progress = Callable[[int, int, str], None]


@dataclass(eq=False)
class FigureBuild:
    """A figure to be drawn in several kinds of files, and its result, filled in by `find` and `draw`.

    recipe, parameters  name of a recipe or path of its file, and the values that it is called with, by name
    renderer            vector or shaded
    kinds               svg, pdf, png, pgf, csv, csv.gz, and three that may be empty files: narrow, an SVG for a narrow
                        screen (a PNG where shaded) if the figure itself is too wide; scene, a script for the viewer of
                        the pages; moves, a script of its motion
    style               style sheet of Matplotlib, a name or a file; None for the package's own
    targets             names of media; the first that is wide enough is used, see `atlas.pictures.arrange.suited`
    parts               digests of all that the figure depends on, by name (see `parts_of`)
    keys, contents      keys in the cache, and contents of the files, both by kind
    facts               title, caption, size in millimetres, cost and others, as `worker.draw` stores them
    new, why            whether it was drawn by this build, and the cause in words
    failure             reason why it could not be drawn, or ""
    """

    recipe: str
    parameters: Mapping[str, Any]
    renderer: str
    kinds: tuple[str, ...]
    style: str | None = None
    targets: tuple[str, ...] = ()
    parts: Mapping[str, str] = field(default_factory=dict)
    keys: Mapping[str, str] = field(default_factory=dict)
    contents: dict[str, bytes] = field(default_factory=dict)
    facts: Mapping[str, Any] = field(default_factory=dict)
    new: bool = False
    why: str = "nothing it depends on has changed"
    failure: str = ""

    @property
    def stem(self) -> str:
        """Name of the recipe, without folder and suffix."""
        return Path(self.recipe).stem

    @property
    def name(self) -> str:
        """Title of this figure for messages, such as ``stem(key=value) shaded for A or B``.

        It has "shaded" if that is the renderer, and "for" with the names of `targets` if there are any.
        """
        from atlas.book.digits import markdown_of

        settings = ", ".join(f"{key}={markdown_of(value)}" for key, value in self.parameters.items())
        targets = f" for {' or '.join(self.targets)}" if self.targets else ""
        return f"{self.stem}({settings})" + (" shaded" if self.renderer == "shaded" else "") + targets

    @property
    def reason(self) -> str:
        """Text on the result: "failed: ...", "drawn: ..." or "taken: ...", with the cause."""
        return f"failed: {self.failure}" if self.failure else f"{'drawn' if self.new else 'taken'}: {self.why}"

    def missing_keys(self) -> dict[str, str]:
        """Return the keys in the cache by kind of file while the figure's files are not loaded, else {}."""
        return {} if self.contents else dict(self.keys)

    def take(self, cache: Cache) -> None:
        """Set `contents` and `facts` from the cache if the files of all kinds are there; otherwise change nothing."""
        entries = {kind: entry for kind, key in self.missing_keys().items() if (entry := cache.get(key)) is not None}
        if entries.keys() == self.keys.keys():
            for kind, entry in entries.items():
                self.facts, self.contents[kind] = worker.read(entry)


def parts_of(figure: FigureBuild, sources: Sources, gl: str | None) -> dict[str, str]:
    """Return the digests of everything on which a figure depends, by name: "parameters", "recipe and kernels", ....

    `gl` names the library that draws shaded pictures; it counts for a shaded figure alone. A recipe that can't be
    loaded gets no records. `sources` digests files of code.
    """
    from atlas.pictures import recipes

    drawing = [path for path in (PACKAGE / "pictures" / "drawing").rglob("*") if path.suffix not in {".py", ".pyc"}]
    try:
        records = recipes.load(figure.recipe).records
    except AtlasError:
        records = ()  # it can't be drawn, which is told when that is tried
    return {
        "parameters": digest(figure.parameters),
        "recipe and kernels": sources.closure([recipes.source(figure.recipe)]),
        "records": sources.closure(folder("reports") / "data" / name for name in records),
        "drawing code": sources.closure([PACKAGE / "book" / "building" / "worker.py", *filter(Path.is_file, drawing)]),
        "style": sources.named(figure.style),
        "target": digest(figure.targets),
        "libraries": digest(sys.version_info[:2], versions()),
        "renderer": digest(figure.renderer, gl if figure.renderer == "shaded" else None),
    }


def find(figures: Sequence[FigureBuild], cache: Cache, sources: Sources, gl: str | None) -> None:
    """Set each figure's `parts`, `keys` and, from the cache, `contents`; set `why` where the figure must be drawn.

    `gl` names the library that draws shaded pictures, None where there is none. The parts are saved in the cache
    for the next comparison. `sources` digests files of code.
    """
    for figure in figures:
        figure.parts = parts_of(figure, sources, gl)
        figure.keys = {kind: digest(figure.stem, figure.parts, kind) for kind in figure.kinds}
        figure.take(cache)
        if figure.missing_keys():
            figure.why = _why(figure, cache)
        cache.save(figure.name, figure.parts)
    for figure in figures:
        cache.save(f"inputs of {figure.stem}", _inputs(figure))
    sources.save()


def _why(figure: FigureBuild, cache: Cache) -> str:
    """Return why a figure without all its files must be drawn, as words.

    These are "changed: PARTS", "a file of it was not there, or damaged" where no part changed, and, for a figure
    without a record, "changed inputs: NAMES" or "it was never drawn here".
    """
    if before := cache.load(figure.name):
        changed = [name for name, value in figure.parts.items() if before.get(name) != value]
        return f"changed: {', '.join(changed)}" if changed else "a file of it was not there, or damaged"
    previous, inputs = cache.load(f"inputs of {figure.stem}"), _inputs(figure)
    changed = [name for name in {**previous, **inputs} if previous.get(name) != inputs.get(name)]
    return f"changed inputs: {', '.join(changed)}" if previous and changed else "it was never drawn here"


def _inputs(figure: FigureBuild) -> dict[str, str]:
    """Return the digest of each of a figure's parameters by name, and under "target" that of its targets."""
    return {name: digest(value) for name, value in figure.parameters.items()} | {"target": digest(figure.targets)}


def draw(figures: Sequence[FigureBuild], cache: Cache, jobs: int, progress: Progress) -> None:
    """Draw the missing files of some figures: a single one in this process, several by up to `jobs` worker processes.

    Sets `new`, `failure`, `contents` and `facts` of those figures. Shaded figures are drawn first, since they take
    longest. `progress` is called after each with (figures done, number of figures, stem); cached ones count as done.
    Raises OSError when the cache can't be written.
    """
    queue = sorted((build for build in figures if build.missing_keys()), key=lambda build: build.renderer != "shaded")
    for done, (figure, failure) in enumerate(_finished_figures(queue, cache, jobs), len(figures) - len(queue) + 1):
        figure.new, figure.failure = True, failure
        figure.take(cache)
        if figure.missing_keys() and not failure:
            raise OSError(f"what was drawn is not in {cache.folder}; was it removed?")
        progress(done, len(figures), figure.stem)


def _finished_figures(figures: Sequence[FigureBuild], cache: Cache, jobs: int) -> Iterator[tuple[FigureBuild, str]]:
    """Draw figures into the cache; yield pairs (figure, reason of its failure or "") as each is finished.

    At most `jobs` processes draw at once. If one dies, unfinished figures are drawn again one by one in a fresh
    process, so that the figure that kills its process is identified and reported as failed; the others are drawn.
    """
    settle_matplotlib()
    waiting = {
        build: worker.Task(
            build.recipe,
            build.parameters,
            build.renderer,
            build.style,
            build.missing_keys(),
            cache.folder,
            build.targets,
        )
        for build in figures
    }
    has_several, workers = len(figures) > 1, min(jobs, len(waiting))
    begin, context = partial(worker.begin, {**os.environ}), processes.prepare(processes.DRAWING) if has_several else ""
    while waiting:
        pool = processes.pool(workers, begin, context) if has_several else None
        if pool is None:
            yield from ((figure, worker.draw(task)) for figure, task in waiting.items())
            return
        broken = False
        try:
            futures: dict[Future[str], FigureBuild] = {}
            try:
                for figure, task in waiting.items():
                    futures[pool.submit(worker.draw, task)] = figure
            except BrokenProcessPool:
                broken = True
            for future in as_completed(futures):
                try:
                    failure = future.result()
                except BrokenProcessPool:
                    broken = True
                else:
                    del waiting[futures[future]]
                    yield futures[future], failure
        finally:
            pool.shutdown(cancel_futures=True)
        if broken and workers == 1 and context == "spawn":
            figure = next(iter(waiting))
            del waiting[figure]
            yield figure, "the process that drew it came to a sudden end"
        workers, context = 1, "spawn"


def cores() -> int:
    """Return the default number of worker processes: that of the processors, at most MAX_WORKERS."""
    return min(processors(), MAX_WORKERS)


@dataclass(frozen=True)
class Files:
    """Result of one figure: stem of its recipe, its files, their renderer, a line for the user, and the reason.

    `reason` says why it was drawn or taken; `failure` why it could not be drawn, with no files. `left_out` is a
    sentence that names the panels without room at the target's size, or "". `edited` is a sentence on the new files
    that stand beside files which the user wrote or edited, or "".
    """

    name: str
    files: tuple[Path, ...] = ()
    renderer: str = ""
    note: str = ""
    reason: str = ""
    failure: str = ""
    edited: str = ""
    left_out: str = ""


def build_figures(
    names: Sequence[str],
    formats: Sequence[str],
    out: Path,
    *,
    renderer: str = "vector",
    parameters: Mapping[str, Any] | None = None,
    style: str | None = None,
    target: str | None = None,
    jobs: int | None = None,
    progress: Progress = lambda _done, _total, _name: None,
) -> list[Files]:
    """Write each recipe's figure to out/NAME.FORMAT for each format; return the `Files` of each figure.

    With a target, see `atlas.targets`, each is laid out anew for it and written to out/NAME-TARGET.FORMAT.

    A name with the ending .py is the path of a recipe's file. `renderer` is "vector" or "shaded"; `parameters`, by
    name, are those of all recipes. `style` is a style sheet of Matplotlib, a file or a name, applied on top of the
    package's own. `jobs` figures are drawn at once, by default one a core; `progress` is called with (figures done,
    their number, name). Figures in the cache are not drawn again. The format csv is the data of the figure, see
    `atlas.pictures.data`. A figure that fails does not stop the others. Raises AtlasError for a shaded figure in a
    format other than PNG or CSV.
    """
    vector_kinds = [kind for kind in formats if kind not in {"png", "csv"}]
    if renderer == "shaded" and vector_kinds:
        raise AtlasError(f"a shaded figure is a PNG; {vector_kinds[0]!r} is drawn by the vector renderer")
    from atlas import gl

    cache = Cache(cache_folder(out))
    cache.prune()
    places = [str(Path(name).absolute()) if name.endswith(".py") else name for name in names]
    targets = () if target is None else (target,)
    figures = [FigureBuild(place, parameters or {}, renderer, tuple(formats), style, targets) for place in places]
    find(figures, cache, Sources(cache), gl.library())
    draw(figures, cache, jobs or cores(), progress)
    return [_put(figure, out) for figure in figures]


def _put(figure: FigureBuild, out: Path) -> Files:
    """Write the files of a drawn figure to `out` and return its `Files`; of a failed one only the `Files`.

    Where the user has edited a file, it stays and the new one is written beside it.
    """
    name = figure.stem
    if figure.failure:
        return Files(name, reason=figure.reason, failure=figure.failure)
    stem = "-".join([name, *figure.targets])
    files = {"": {f"{stem}.{kind}": figure.contents[kind] for kind in figure.kinds}}
    paths, edited = tuple(out / path for path in files[""]), ""
    try:
        publish(files, out, stem)
    except AtlasError as error:
        edited = str(error)
    renderer, note, left_out = (str(figure.facts[fact]) for fact in ("renderer", "note", "left_out"))
    return Files(name, paths, renderer, note, figure.reason, edited=edited, left_out=left_out)


HEADING = ("scene", "from", "points", "faces", "compute [CPU ms]", "draw [CPU ms]", "peak [MB]", "kB")


def write_costs(path: Path, name: str, figures: Sequence[FigureBuild], times: Mapping[str, float], jobs: int) -> Path:
    """Write the costs of the build of the report `name` as JSON into the file `path`, and return the path.

    `times` are the clock's readings in seconds at the end of each step, by the step's name and in order; the first
    is the start. `jobs` is the number of workers. `figures` are those of the report, drawn or failed.
    """
    steps = {
        step: round(end - start, 4) for (step, end), start in zip([*times.items()][1:], times.values(), strict=False)
    }
    record = {
        "report": name,
        "jobs": jobs,
        "seconds": round(sum(steps.values()), 4),
        "steps": steps,
        "scenes": [_costs(figure) for figure in figures],
    }
    files.write(path, json.dumps(record, ensure_ascii=False, indent=1) + "\n")
    return path


def rows_of_costs(path: Path) -> list[list[str]]:
    """Return a row for each figure of a file by `write_costs`: eight texts in the order of `HEADING`.

    They are name, "drawn" or "cache", counts of points and faces, times of computing and drawing in ms, memory in MB,
    and size in kB. The row of a failed figure has "failed" in the second place and "" from the third on.
    """
    return [
        [entry["scene"], "failed", *[""] * 6]
        if entry["from"] == "failed"
        else [
            entry["scene"],
            entry["from"],
            str(entry["points"]),
            str(entry["faces"]),
            f"{1e3 * entry['compute_s']:.0f}",
            f"{1e3 * entry['draw_s']:.0f}",
            f"{entry['memory_mb']:.0f}",
            f"{entry['bytes'] / 1024:.0f}",
        ]
        for entry in json.loads(path.read_text(encoding="utf-8"))["scenes"]
    ]


def _costs(figure: FigureBuild) -> dict[str, Any]:
    """Return the cost record of one figure, {"scene": name, "from": "drawn" or "cache", "reason": ..., costs}.

    The costs are counts, seconds, MB and bytes; for a cached figure those when it was drawn, for a failed one none.
    """
    if figure.failure:
        return {"scene": figure.name, "from": "failed", "reason": figure.failure}
    origin = "drawn" if figure.new else "cache"
    return {"scene": figure.name, "from": origin, "reason": figure.reason, **figure.facts["cost"]}
