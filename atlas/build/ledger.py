"""The cost ledger of a build: for each scene what was computed, sampled and drawn, its time and memory."""

import json
import os
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from atlas.build.plates import Plate


def write(path: Path, name: str, made: Sequence[Plate], ends: Mapping[str, float], began: float, jobs: int) -> Path:
    """Write the ledger of a build as JSON; `ends` are the clock's readings at the end of each step."""
    steps: dict[str, float] = {}
    before = began
    for step, end in ends.items():
        steps[step], before = round(end - before, 4), end
    record = {
        "report": name,
        "jobs": jobs,
        "seconds": round(time.perf_counter() - began, 4),
        "steps": steps,
        "scenes": [scene(one) for one in made],
    }
    write_whole(path, record)
    return path


def write_whole(path: Path, record: Mapping[str, Any]) -> None:
    """Write a record whole or not at all."""
    beside = path.with_name(f".{path.name}.{os.getpid()}")
    beside.write_text(json.dumps(record, ensure_ascii=False, indent=1) + "\n", encoding="utf-8")
    beside.replace(path)


def keep(path: Path, data: Path | None = None) -> Path:
    """Keep the ledger of a build as the record of which the figure `build_cost` is drawn, with the machine."""
    from atlas.places import folder
    from atlas.study.bench.record import machine, today, versions

    here = machine()
    found = json.loads(path.read_text(encoding="utf-8"))
    found["machine"] = f"{here.processor}, {here.cores} cores, {here.system}"
    found["versions"] = {name: number for name, number in versions().items() if name in {"python", "numpy"}}
    found["date"] = today()
    kept = data or folder("reports") / "data" / "build_costs.json"
    write_whole(kept, found)
    return kept


def scene(made: Plate) -> dict[str, Any]:
    """Return the entry of one scene; what it cost when it was made, if it comes from the store."""
    if made.failure:
        return {"scene": made.request.name, "from": "failed", "reason": made.failure}
    cost = made.facts["cost"]
    return {"scene": made.request.name, "from": "drawn" if made.new else "store", "reason": made.reason, **cost}


def table(path: Path) -> tuple[tuple[str, ...], list[list[str]]]:
    """Return heading and rows of a ledger for people."""
    heading = ("scene", "from", "quantities", "points", "faces", "compute [ms]", "draw [ms]", "peak [MB]", "kB")
    rows = []
    for entry in json.loads(path.read_text(encoding="utf-8"))["scenes"]:
        if entry["from"] == "failed":
            rows.append([entry["scene"], "failed", *[""] * 7])
            continue
        asked = sum(entry["quantities"].values())
        rows.append(
            [
                entry["scene"],
                entry["from"],
                f"{asked} of {len(entry['quantities'])} kinds",
                str(entry["points"]),
                str(entry["faces"]),
                f"{1e3 * entry['compute_s']:.0f}",
                f"{1e3 * entry['draw_s']:.0f}",
                f"{entry['memory_mb']:.0f}",
                f"{entry['bytes'] / 1024:.0f}",
            ]
        )
    return heading, rows
