"""Is a report up to date? Decided from its sources and its files, without loading what would build it."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from atlas.build import notes
from atlas.build.sources import PACKAGE, Sources, digest, release
from atlas.places import folder

LIBRARIES = (
    "numpy",
    "python-flint",
    "matplotlib",
    "pyvista",
    "vtk",
    "jinja2",
    "typst",
    "pypandoc_binary",
    "ziamath",
    "fonttools",
    "brotli",
    "pillow",
)
RECORDS = tuple(PACKAGE / name for name in ("proof/verdicts.json", "proof/mutants.json", "study/ratchet.json"))
"""The recorded results that lie beside the code; those of reports/data are found by their folder."""


def key(file: Path, sources: Sources) -> str:
    """Return the key of a whole report: all code and templates that may take part, its file, the data, the versions."""
    roots = [
        *PACKAGE.glob("*.py"),
        *(path for floor in ("build", "report", "render", "scene", "core", "exact", "paper") for path in _code(floor)),
        *folder("figures").glob("*.py"),
        *(path for path in folder("templates").rglob("*") if path.is_file()),
        *(path for path in (folder("reports") / "data").glob("*") if path.is_file()),
        *RECORDS,
        file,
    ]
    found = sources.closure(roots)
    sources.save()
    from atlas.render import gl

    return digest(found, [[name, release(name)] for name in LIBRARIES], gl.library())


def read(out: Path, name: str, wanted: str, formats: Sequence[str]) -> dict[str, Any] | None:
    """Return what was noted of a report that is up to date: its key is the one wanted and its files are untouched."""
    note = _read(out, name, wanted)
    try:
        stamps = {file: stamp for one in formats for file, stamp in note["files"][one].items()}
        same = all(_stamp(out / file) == stamp for file, stamp in stamps.items())
    except (OSError, KeyError):
        return None
    return note if same else None


def write(out: Path, name: str, made: str, files: Mapping[str, Sequence[str]], **facts: Any) -> None:
    """Note a report that was built whole, with the state of its files of each format."""
    stamps = {one: {file: _stamp(out / file) for file in names} for one, names in files.items()}
    stamps = _read(out, name, made).get("files", {}) | stamps
    notes.write(noted(out, name), {"key": made, "files": stamps, **facts})


def _read(out: Path, name: str, wanted: str) -> dict[str, Any]:
    """Return the note of a report of that key, or an empty one."""
    note = notes.read(noted(out, name))
    return note if note.get("key") == wanted else {}


def _code(floor: str) -> list[Path]:
    return [path for path in (PACKAGE / floor).rglob("*.py") if "__pycache__" not in path.parts]


def _stamp(path: Path) -> list[int]:
    state = path.stat()
    return [state.st_mtime_ns, state.st_size]


def noted(out: Path, name: str) -> Path:
    """Return the note of a report that was built whole."""
    return out / f".{name}.made.json"
