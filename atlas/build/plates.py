"""Plates made once: each under a key of all that it depends on, taken from the store or drawn.

The key of a plate holds the recipe's code and that of every module of ours that it reaches, the drawing code, the data
files it reads, its parameters, the renderer, the target, and the versions of the libraries that draw.
"""

import sys
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import redirect_stdout
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from atlas.build.drawing import PICTURE, Drawn, Task
from atlas.build.sources import PACKAGE, Sources, digest, release
from atlas.build.store import Entry, Store
from atlas.errors import AtlasError
from atlas.places import folder
from atlas.report.numbers import shown

if TYPE_CHECKING:
    from atlas.scene import Scene

DRAWERS = {
    "vector": ("numpy", "matplotlib", "pillow"),
    "shaded": ("numpy", "matplotlib", "pillow", "pyvista", "vtk"),
}
WRITERS = {"pdf": "typst"}
"""The library that writes the files for a target alone."""
TAKEN = "nothing it depends on has changed"


@dataclass(frozen=True, eq=False)
class Request:
    """A plate that is wanted: a recipe, its parameters, a renderer, and what for (`atlas.build.drawing.KINDS`)."""

    recipe: str
    renderer: str
    parameters: Mapping[str, Any]
    targets: tuple[str, ...] = (PICTURE,)

    @property
    def name(self) -> str:
        """The recipe's name and what distinguishes this plate, for people."""
        settings = ", ".join(f"{key}={shown(value)}" for key, value in self.parameters.items())
        return f"{self.recipe}({settings})" + (" shaded" if self.renderer == "shaded" else "")


@dataclass(eq=False)
class Plate:
    """What became of a request: what the store has for each target, what is missing and why; or why it failed."""

    request: Request
    why: str
    missing: dict[str, str] = field(default_factory=dict)
    """The keys of what must be drawn, by target."""
    entries: dict[str, Entry] = field(default_factory=dict)
    facts: Mapping[str, Any] = field(default_factory=dict)
    """What is known of the plate, as soon as its scene is there."""
    failure: str = ""

    @property
    def new(self) -> bool:
        """Whether any of its files was drawn just now."""
        return any(entry.new for entry in self.entries.values())

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
        """Return the path of the file for a target."""
        entry = self.entries[target]
        return entry.file(str(entry.facts["file"]))

    def settle(self, outcome: Drawn | str) -> None:
        """Take in what was drawn, or why it was not."""
        if isinstance(outcome, str):
            self.failure = " ".join(outcome.split())
        else:
            self.entries |= outcome
            self.facts = next(iter(outcome.values())).facts


def survey(requests: Sequence[Request], store: Store, sources: Sources, gl: str | None) -> list[Plate]:
    """Look up in the store what there is of each plate, and say why the rest must be drawn."""
    plates = []
    for request in requests:
        parts = parts_of(request, sources, gl)
        plate = Plate(request, TAKEN)
        writers = {f"{target} writer": release(WRITERS[target]) for target in request.targets if target in WRITERS}
        for target in request.targets:
            key = digest(request.recipe, parts, target, writers.get(f"{target} writer"))
            entry = store.take(key)
            if entry is None:
                plate.missing[target] = key
            else:
                plate.entries[target] = entry
                plate.facts = entry.facts
        if plate.missing:
            plate.why = store.changed(request.name, parts | writers)
        store.remember(request.name, parts | writers)
        plates.append(plate)
    return plates


def parts_of(request: Request, sources: Sources, gl: str | None) -> dict[str, str]:
    """Return what a plate depends on, each part as a digest under its name."""
    used = request.renderer if request.renderer == "vector" or gl else "vector"
    roots = [PACKAGE / "build" / "drawing.py", PACKAGE / "scene" / "style.py", PACKAGE / "render" / f"{used}.py"]
    other = [PACKAGE / "render" / "shaded.py"] if used == "vector" else []  # the door to both imports both
    return {
        "parameters": digest(request.parameters),
        "recipe and kernels": sources.closure([folder("figures") / f"{request.recipe}.py"]),
        "data": sources.closure(data_files(request.recipe)),
        "drawing code": sources.closure(roots, without=other),
        "libraries": digest([[name, release(name)] for name in DRAWERS[used]]),
        "renderer": digest([request.renderer, gl if request.renderer == "shaded" else None]),
    }


def data_files(recipe: str) -> list[Path]:
    """Return the files that a recipe reads: those of reports/data that its source names."""
    data = folder("reports") / "data"
    text = (folder("figures") / f"{recipe}.py").read_text(encoding="utf-8")
    return [path for path in sorted(data.glob("*")) if path.name in text or path.stem in text]


def tasks(plates: Sequence[Plate], store: Store) -> Iterator[tuple[Plate, Task]]:
    """Compute the scenes of the plates that must be drawn, what is shaded first, for it takes longest to draw.

    Plates of one recipe with the same parameters share their scene. A recipe that raises leaves the reason in its plate
    and does not stop the others.
    """
    scenes: dict[str, tuple[Scene, dict[str, Any]]] = {}
    for plate in sorted((one for one in plates if one.missing), key=lambda one: one.request.renderer != "shaded"):
        same = digest(plate.request.recipe, plate.request.parameters)
        try:
            if same not in scenes:
                scenes[same] = _scene(plate.request)
            yield plate, _task(plate, *scenes[same], store)
        except AtlasError as error:
            plate.settle(str(error))
        except SystemExit as error:
            plate.settle(f"its recipe ended with exit status {error}")


def _scene(request: Request) -> "tuple[Scene, dict[str, Any]]":
    """Compute a scene; return it and what that cost."""
    from atlas.build import meter
    from atlas.scene import recipes

    start = time.perf_counter()
    recipe = recipes.load(request.recipe)
    with meter.counting() as counts, redirect_stdout(sys.stderr):
        scene = recipe.scene(**request.parameters)
    cost = {
        "quantities": dict(sorted(counts.items())),
        "points": meter.points(scene),
        "faces": meter.faces(scene),
        "compute_s": time.perf_counter() - start,
    }
    return scene, cost


def _task(plate: Plate, scene: "Scene", cost: Mapping[str, Any], store: Store) -> Task:
    """Note what is known of a plate when its scene is there, and return what is left to do."""
    from atlas.render.drawing import choose

    renderer, note = choose(scene, plate.request.renderer)
    plate.facts = {
        "title": scene.title,
        "caption": scene.caption,
        "alt": scene.alt,
        "size": list(scene.size),
        "parameters": {name: shown(value) for name, value in scene.parameters.items()},
        "renderer": renderer,
        "note": note,
        "cost": cost,
    }
    return Task(scene, renderer, plate.missing, store.root, plate.facts)
