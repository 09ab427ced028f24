"""Cost of a build, scene by scene.

Drawn from a stored ledger of a build: the time to compute the quantities of each scene, and the time to draw it.
"""

import json
from collections import Counter
from typing import Any

import numpy as np

from atlas import places
from atlas.errors import AtlasError
from atlas.scene import Layer, Plane, Points, Region, Scene
from atlas.scene.words import title

RECORDS = ("build_costs.json",)
ROW, THICK, THIN = 4.2, 0.38, 0.17
MOST = 15
"""As many scenes are shown, those that cost most."""


def scene() -> Scene:
    """Draw two bars a scene, the most expensive on top."""
    record = read()
    drawn = [entry for entry in record["scenes"] if entry["from"] != "failed"]
    names = named([entry["scene"] for entry in drawn])
    rows = sorted(zip(names, drawn, strict=True), key=lambda row: row[1]["compute_s"] + row[1]["draw_s"])[-MOST:]
    shown = f" Shown are the {len(rows)} that cost most." if len(rows) < len(drawn) else ""
    computed, drawing = (sum(entry[key] for entry in drawn) for key in ("compute_s", "draw_s"))
    taken = sum(entry["from"] != "drawn" for entry in drawn)
    store = f" Circles mark the {taken} scenes that were taken from the store: their cost is that of making them."
    return Scene(
        title=title(__doc__),
        caption=(
            f"Cost of a build of {len(drawn)} scenes, which took {record['seconds']:.1f} s on {record['jobs']} "
            f"{'cores' if record['jobs'] > 1 else 'core'}: the time to compute what a scene shows, {computed:.1f} s in "
            f"all, and the time to draw and write it, {drawing:.1f} s.{shown}{store if taken else ''} Measured on "
            f"{record['machine']}, on {record['date']}."
        ),
        alt=(
            f"Two horizontal bars for each of {len(rows)} scenes on a logarithmic scale of milliseconds, the time to "
            f"compute and the time to draw. The dearest scene is {rows[-1][0]}, the cheapest of them {rows[0][0]}."
        ),
        panels=(panel([name for name, _ in rows], [entry for _, entry in rows]),),
        size=(150.0, 22.0 + ROW * len(rows)),
    )


def read() -> dict[str, Any]:
    """Read the stored ledger."""
    path = places.folder("reports") / "data" / "build_costs.json"
    try:
        found: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError as error:
        raise AtlasError(f"There is no ledger of a build, {path.name}: run atlas report --keep-costs.") from error
    return found


def named(scenes: list[str]) -> list[str]:
    """Return the recipes of the scenes, shaded ones marked and those of one recipe counted."""
    names = [scene.partition("(")[0] + (", shaded" if scene.endswith(" shaded") else "") for scene in scenes]
    many, seen = Counter(names), Counter[str]()
    counted = []
    for name in names:
        seen[name] += 1
        counted.append(f"{name} ({seen[name]})" if many[name] > 1 else name)
    return counted


def panel(names: list[str], entries: list[dict[str, Any]]) -> Plane:
    """Draw the bars from the left edge: drawing is the wide one, computing the narrow one in it."""
    times = np.array([[1e3 * entry["compute_s"], 1e3 * entry["draw_s"]] for entry in entries])
    left, right = 10.0 ** np.floor(np.log10(times.min())), 2.0 * times.max()
    layers: list[Layer] = []
    for column, role, half, label in ((1, "surface", THICK, "drawing"), (0, "body", THIN, "computing")):
        for row, end in enumerate(times[:, column], 1):
            corners = np.array([(left, row - half), (end, row - half), (end, row + half), (left, row + half)])
            layers.append(Region(corners, role, label if row == 1 else ""))
    taken = [(time, row) for row, (time, entry) in enumerate(zip(times[:, 1], entries, strict=True), 1)
             if entry["from"] != "drawn"]  # fmt: skip
    if taken:
        layers.append(Points(np.array(taken), "rest", "from the store"))
    return Plane(
        tuple(layers),
        x_label="time (ms)",
        y_label="",
        x_limits=(float(left), float(right)),
        y_limits=(0.3, len(names) + 0.7),
        x_scale="log",
        legend=True,
        y_names=tuple(names),
    )
