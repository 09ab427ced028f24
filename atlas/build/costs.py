"""What a build cost: for each figure the points and faces of its scene, its processor times, memory and bytes."""

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from atlas import files

if TYPE_CHECKING:
    from atlas.build.figures import FigureBuild

HEADING = ("scene", "from", "points", "faces", "compute [CPU ms]", "draw [CPU ms]", "peak [MB]", "kB")


def write(path: Path, name: str, figures: Sequence["FigureBuild"], times: Mapping[str, float], jobs: int) -> Path:
    """Write the costs of a build as JSON; `times` are the clock's readings at the end of each step, in order."""
    steps = {
        step: round(end - start, 4) for (step, end), start in zip([*times.items()][1:], times.values(), strict=False)
    }
    record = {
        "report": name,
        "jobs": jobs,
        "seconds": round(sum(steps.values()), 4),
        "steps": steps,
        "scenes": [_scene(figure) for figure in figures],
    }
    files.write(path, json.dumps(record, ensure_ascii=False, indent=1) + "\n")
    return path


def rows(path: Path) -> list[list[str]]:
    """Return the rows of a table of the costs, below `HEADING`."""
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


def _scene(figure: "FigureBuild") -> dict[str, Any]:
    """Return the entry of one figure; what it cost when it was drawn, if it comes from the cache."""
    if figure.failure:
        return {"scene": figure.name, "from": "failed", "reason": figure.failure}
    drawn = "drawn" if figure.new else "cache"
    return {"scene": figure.name, "from": drawn, "reason": figure.reason, **figure.facts["cost"]}
