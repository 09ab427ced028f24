"""One plate drawn into a folder, and what there is to note about it: its words, its files, what it cost."""

import resource
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from atlas.report.numbers import shown

STEM = "plate"
KINDS: Mapping[str, tuple[str, ...]] = {"shaded": ("png",), "vector": ("svg", "pdf")}


def make(recipe: str, renderer: Any, parameters: dict[str, Any], into: Path) -> dict[str, Any]:
    """Make the scene, draw it into a folder, and return what there is to note about it."""
    from atlas.build import meter
    from atlas.render.drawing import choose, draw_all
    from atlas.scene import recipes

    start = time.perf_counter()
    loaded = recipes.load(recipe)
    with meter.counting() as counts:
        scene = loaded.scene(**parameters)
    computed = time.perf_counter()
    used, note = choose(scene, renderer)
    drawn = draw_all(scene, {into / f"{STEM}.{kind}": kind for kind in KINDS[used]}, used)
    files = {"html": drawn[0].path.name, "pdf": drawn[-1].path.name}
    return {
        "title": scene.title,
        "caption": scene.caption,
        "alt": scene.alt,
        "size": list(scene.size),
        "parameters": {name: shown(value) for name, value in scene.parameters.items()},
        "renderer": used,
        "note": note,
        "files": files,
        "cost": {
            "quantities": dict(sorted(counts.items())),
            "points": meter.points(scene),
            "faces": meter.faces(scene),
            "compute_s": computed - start,
            "draw_s": time.perf_counter() - computed,
            "memory_mb": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024,
            "bytes": sum((into / name).stat().st_size for name in set(files.values())),
        },
    }
