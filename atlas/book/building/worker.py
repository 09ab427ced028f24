"""Work of one process: it computes the scene of a figure, draws it, and puts the files into the cache."""

import gzip
import json
import os
import resource
import sys
import time
import warnings
from collections.abc import Mapping
from contextlib import redirect_stdout
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import Any

from atlas.book.building.cache import Cache
from atlas.errors import AtlasError
from atlas.pictures import Curve, Image, Points, Region, Scene, Surface, data, recipes
from atlas.pictures.arrange import arranged, narrowed, suited
from atlas.places import settle_matplotlib
from atlas.targets import find


@dataclass(frozen=True)
class Task:
    """A figure to be drawn by one process: an order that can be pickled.

    `recipe` is a name or a path, `parameters` are its values by name, `renderer` is vector or shaded, `style` a
    style sheet of Matplotlib or None, `keys` holds the key in the cache of each kind of file to be made, `cache` is
    the cache's folder, and the first of the `targets`, names of media, that is wide enough is drawn for.
    """

    recipe: str
    parameters: Mapping[str, Any]
    renderer: str
    style: str | None
    keys: Mapping[str, str]
    cache: Path
    targets: tuple[str, ...] = ()


def draw(task: Task) -> str:
    """Draw a figure's files into the cache; return "", or the reason of its failure as a sentence.

    Any exception of the recipe is a failure; only OSError is raised, when the cache can't be written: that is no
    fault of the figure. What the recipe prints goes to standard error.
    """
    try:
        with redirect_stdout(sys.stderr):  # what a recipe or a library prints is no result
            _draw(task)
    except OSError:
        raise
    except AtlasError as error:
        return " ".join(str(error).split())
    except Exception as error:  # noqa: BLE001  one figure's failure must not stop the others; it is reported
        return f"{type(error).__name__}: {error}"
    return ""


def _draw(task: Task) -> None:
    settle_matplotlib()
    from atlas.pictures.drawing.files import FORMATS, choose, save

    start = time.process_time()
    scene = recipes.load(task.recipe).scene(**task.parameters)
    computed = time.process_time()
    cache = Cache(task.cache)
    renderer, note = choose(scene, task.renderer)
    target = suited(scene, [find(name) for name in task.targets]) if task.targets else None
    with cache.temporary() as folder:
        paths = {kind: folder / f"figure.{kind}" for kind in task.keys if kind in FORMATS}
        small, files = narrowed(scene), {}
        if paths:
            kinds = {path: kind for kind, path in paths.items()}
            files[scene] = save(scene, kinds, task.renderer, task.style, target)
        if "narrow" in task.keys:
            paths["narrow"] = folder / "narrow"
            paths["narrow"].touch()
            if small:
                kind = "png" if renderer == "shaded" else "svg"
                files[small] = save(small, {paths["narrow"]: kind}, renderer, task.style)
        contents = {kind: path.read_bytes() for kind, path in paths.items()}
    figure = not target and {*files} >= {version for version in (scene, small) if version}
    figures = list(files.values()) if figure else []
    contents |= _page_files(task, scene, figures)
    placed = arranged(scene, target) if target else scene
    facts = {
        "title": scene.title,
        "caption": scene.caption,
        "commands": list(scene.commands),
        "alt": scene.alt,
        "left_out": placed.caption.removeprefix(scene.caption).strip(),
        "size": placed.size,
        "parameters": scene.parameters,
        "renderer": renderer,
        "note": note,
        "cost": {
            **counted(scene),
            "compute_s": computed - start,
            "draw_s": time.process_time() - computed,
            "memory_mb": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024,
            "bytes": sum(map(len, contents.values())),
        },
    }
    for kind, key in task.keys.items():
        cache.put(key, json.dumps(facts).encode() + b"\n" + contents[kind])


def _page_files(task: Task, scene: Scene, figures: list[Any]) -> dict[str, bytes]:
    """Return the files that are no pictures, bytes by kind, of those that the task asks for.

    The kinds are the scripts "scene" and "moves" for a page, "csv" and "csv.gz". `figures` are the drawn Matplotlib
    figures of the scene, from which the scripts read places; [] if there are none.
    """
    contents = {}
    if "scene" in task.keys:
        from atlas.pictures.drawing import viewer

        contents["scene"] = viewer.script(scene, task.style, figures).encode()
    if "moves" in task.keys:
        from atlas.pictures.drawing import moves

        contents["moves"] = moves.script(scene, task.style, figures).encode()
    if "csv" in task.keys:
        contents["csv"] = data.table(scene).encode()
    if "csv.gz" in task.keys:
        contents["csv.gz"] = _compressed(data.table(scene).encode())
    return contents


def _compressed(content: bytes) -> bytes:
    """Return bytes compressed as gzip, equal with every Python: `gzip.compress` writes another header from 3.13 on."""
    buffer = BytesIO()
    with gzip.GzipFile(fileobj=buffer, mode="wb", compresslevel=6, mtime=0) as file:
        file.write(content)
    return buffer.getvalue()


def counted(scene: Scene) -> dict[str, int]:
    """Return {"points": n, "faces": m} of a scene: points of lines, regions and marks; cells of surfaces and maps."""
    points = faces = 0
    for layer in (layer for panel in scene.panels for layer in panel.layers):
        if isinstance(layer, Curve | Points | Region):
            points += len(layer.points)
        elif isinstance(layer, Surface):
            points += sum(map(len, (*layer.wires, *layer.rims)))
            faces += sum((grid.shape[0] - 1) * (grid.shape[1] - 1) for grid in layer.grids)
        elif isinstance(layer, Image):
            faces += int(layer.values.size)
    return {"points": points, "faces": faces}


def read(entry: bytes) -> tuple[dict[str, Any], bytes]:
    """Return (facts, content) from a cache entry: a dict with title, caption, size, cost, ..., and the file's bytes."""
    facts, _, content = entry.partition(b"\n")
    return json.loads(facts), content


def begin(environment: Mapping[str, str]) -> None:
    """Replace the environment of a worker process by the caller's, and let its standard output go to standard error.

    The environment may have changed since the fork server was started. Unless Python was started with -W,
    RuntimeWarning is ignored.
    """
    os.environ.clear()
    os.environ.update(environment)
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
    if not sys.warnoptions:  # as on the command line: a float that overflows is told by what shows it
        warnings.simplefilter("ignore", RuntimeWarning)
