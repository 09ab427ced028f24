"""One plate drawn into the store, and what there is to note about it: its words, its files, what it cost."""

import resource
import shutil
import time
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

from atlas.build.store import Entry, Store

if TYPE_CHECKING:
    from atlas.render.drawing import Renderer
    from atlas.scene import Scene

Drawn: TypeAlias = dict[str, Entry]
STEM = "plate"
PICTURE = "picture"
KINDS: Mapping[str, Mapping[str, str]] = {
    "vector": {PICTURE: "svg", "svg": "svg", "pdf": "pdf", "png": "png"},
    "shaded": {PICTURE: "png", "png": "png"},
}
"""The kind of file that a renderer makes for a target: the picture in a report, or a file of a certain format."""


@dataclass(frozen=True, eq=False)
class Task:
    """A scene to be drawn by a renderer, a key of the store for each target, and what is known of the plate already."""

    scene: "Scene"
    renderer: "Renderer"
    keys: Mapping[str, str]
    store: Path
    facts: Mapping[str, Any]

    def draw(self) -> Drawn:
        """Draw the scene once, and put a file for each target into the store."""
        from atlas.render.drawing import draw_all

        start = time.perf_counter()
        store, kinds = Store(self.store), {target: KINDS[self.renderer][target] for target in self.keys}
        with store.room() as folder:
            files = {kind: folder / f"{STEM}.{kind}" for kind in kinds.values()}
            draw_all(self.scene, {path: kind for kind, path in files.items()}, self.renderer)
            cost = {
                **self.facts["cost"],
                "draw_s": time.perf_counter() - start,
                "memory_mb": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024,
                "bytes": sum(path.stat().st_size for path in files.values()),
            }
            facts = {**self.facts, "cost": cost}
            return {
                target: store.make(self.keys[target], _copying(files[kind], facts)) for target, kind in kinds.items()
            }


def _copying(file: Path, facts: Mapping[str, Any]) -> Any:
    """Return a maker of the store that takes over a file."""

    def make(into: Path) -> dict[str, Any]:
        shutil.copyfile(file, into / file.name)
        return {**facts, "file": file.name}

    return make
