"""Figures drawn once: each under a key of all that it depends on, taken from the store or drawn, side by side.

The key of a plate holds the recipe's code and that of every module of ours that it reaches, the drawing code, the data
files it reads, its parameters, the renderer, and the versions of the libraries that draw.
"""

import multiprocessing
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from dataclasses import dataclass, field
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from atlas.build.drawing import make
from atlas.build.sources import PACKAGE, Sources, digest
from atlas.build.store import Store, place
from atlas.places import folder
from atlas.report.gallery import Gallery
from atlas.report.numbers import shown

DRAWERS = {"vector": ("numpy", "matplotlib"), "shaded": ("numpy", "matplotlib", "pyvista", "vtk")}


@dataclass(frozen=True, eq=False)
class Request:
    """A figure that is wanted: a recipe, its parameters, a renderer."""

    recipe: str
    renderer: str
    parameters: Mapping[str, Any]

    @property
    def name(self) -> str:
        """The recipe's name and what distinguishes this plate, for people."""
        settings = ", ".join(f"{key}={shown(value)}" for key, value in self.parameters.items())
        return f"{self.recipe}({settings})" + (" shaded" if self.renderer == "shaded" else "")


@dataclass(frozen=True)
class Made:
    """A figure that was made: where its files are, what was noted, whether it is new; or why it failed."""

    request: Request
    folder: Path | None = None
    facts: Mapping[str, Any] = field(default_factory=dict)
    new: bool = False
    why: str = ""
    failure: str = ""

    @property
    def reason(self) -> str:
        """Say whether it was drawn or taken, and why."""
        if self.failure:
            return f"failed: {self.failure}"
        return f"{'drawn' if self.new else 'taken'}: {self.why}"

    @property
    def note(self) -> str:
        """A line to tell the user, or nothing."""
        return str(self.facts.get("note", ""))

    def file(self, target: str) -> Path:
        """Return the path of the file for a target, html or pdf."""
        if self.folder is None:
            raise FileNotFoundError(self.request.name)
        return self.folder / str(self.facts["files"][target])


def key_of(request: Request, sources: Sources, gl: str | None) -> tuple[str, dict[str, str]]:
    """Return the key of a plate and the parts that it is made of, by name."""
    used = request.renderer if request.renderer == "vector" or gl else "vector"
    roots = [PACKAGE / "build" / "drawing.py", PACKAGE / "scene" / "style.py", PACKAGE / "render" / f"{used}.py"]
    other = [PACKAGE / "render" / "shaded.py"] if used == "vector" else []  # the door to both imports both
    parts = {
        "parameters": digest(request.parameters),
        "recipe and kernels": sources.closure([folder("figures") / f"{request.recipe}.py"]),
        "data": sources.closure(data_files(request.recipe)),
        "drawing code": sources.closure(roots, without=other),
        "libraries": digest([[name, _version(name)] for name in DRAWERS[used]]),
        "renderer": digest([request.renderer, gl if request.renderer == "shaded" else None]),
    }
    return digest(request.recipe, parts), parts


def data_files(recipe: str) -> list[Path]:
    """Return the files that a recipe reads: those of reports/data that its source names."""
    data = folder("reports") / "data"
    text = (folder("figures") / f"{recipe}.py").read_text(encoding="utf-8")
    return [path for path in sorted(data.glob("*.json")) if path.name in text or path.stem in text]


def draw_gallery(
    gallery: Gallery, folder: Path, store: Store, sources: Sources, jobs: int, tell: Callable[[int, str], None]
) -> list[Made]:
    """Draw or take every plate of a gallery, put its files into ``folder``/figures, and fill in what is known of it."""
    from atlas.render import gl

    wanted = {Request(plate.recipe, plate.renderer, plate.parameters): plate for plate in gallery.values()}
    made = []
    requests = [request for request, plate in wanted.items() if not plate.failure]
    for one in plates(requests, store, sources, gl=gl.library(), jobs=jobs):
        made.append(one)
        tell(len(made), one.request.recipe)
        plate = wanted[one.request]
        if one.failure:
            plate.failure = one.failure
            continue
        for target in ("html", "pdf"):
            source = one.file(target)
            name = f"figures/{plate.stem}{source.suffix}"
            place(source, folder / name)
            plate.files[target] = name
        plate.caption, plate.alt = one.facts["caption"], one.facts["alt"]
        width, height = one.facts["size"]
        plate.size, plate.settings = (width, height), one.facts["parameters"]
        if one.facts["renderer"] != plate.renderer and one.note:
            plate.remark = "Drawn by the vector renderer."
    order = {request: index for index, request in enumerate(requests)}
    return sorted(made, key=lambda one: order[one.request])


def plates(
    requests: Sequence[Request], store: Store, sources: Sources, *, gl: str | None, jobs: int = 1
) -> Iterator[Made]:
    """Go through the plates of the requests as they are ready, each taken from the store or drawn.

    With ``jobs`` > 1 they are drawn side by side, by processes that live as long as there is work, so that each loads
    the drawing libraries once. A plate that fails is returned with the reason and does not stop the others.
    """
    waiting: list[tuple[Request, str, str]] = []
    for request in requests:
        key, parts = key_of(request, sources, gl)
        entry = store.take(key)
        if entry is None:
            waiting.append((request, key, store.changed(request.name, parts)))
        else:
            yield Made(request, entry.folder, entry.facts, new=False, why="nothing it depends on has changed")
        store.remember(request.name, parts)
    yield from _drawn(waiting, store, jobs)


def _drawn(waiting: list[tuple[Request, str, str]], store: Store, jobs: int) -> Iterator[Made]:
    """Draw what is not in the store: here, or in processes of their own; shaded plates first, they take longest."""
    waiting.sort(key=lambda item: item[0].renderer != "shaded")
    if jobs == 1 or len(waiting) < 2:
        for request, key, why in waiting:
            yield _made(request, why, _into_store(store.root, key, request))
        return
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(min(jobs, len(waiting)), mp_context=context) as pool:
        running: dict[Future[Any], tuple[Request, str]] = {
            pool.submit(_into_store, store.root, key, request): (request, why) for request, key, why in waiting
        }
        while running:
            finished, _ = wait(running, return_when=FIRST_COMPLETED)
            for future in finished:
                request, why = running.pop(future)
                try:
                    outcome = future.result()
                except Exception as error:  # noqa: BLE001  a process that died takes its figure along, not the build
                    outcome = f"{type(error).__name__}: {error}"
                yield _made(request, why, outcome)


def _into_store(root: Path, key: str, request: Request) -> Any:
    """Draw one plate into the store; return its folder and facts, or in one sentence why it failed."""
    try:
        entry = Store(root).make(
            key, lambda into: make(request.recipe, request.renderer, dict(request.parameters), into)
        )
    except OSError:
        raise  # no room, or no leave to write: that is not the figure's fault
    except Exception as error:  # noqa: BLE001  one figure's failure must not stop the others; it is reported
        return f"{type(error).__name__}: {error}"
    return entry.folder, entry.facts


def _made(request: Request, why: str, outcome: Any) -> Made:
    if isinstance(outcome, str):
        return Made(request, failure=" ".join(outcome.split()))
    where, facts = outcome
    return Made(request, where, facts, new=True, why=why)


def _version(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return "absent"
