"""The files of a report into their places: all are written before the first takes its own."""

import fcntl
import hashlib
import os
import shutil
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from tempfile import mkdtemp

from atlas.errors import AtlasError
from atlas.files import exchange, named

UNFINISHED = ".atlas-"
"""How the folder begins that files stand in until all of them are written, on the disk that they are for."""


WRITTEN = ".written"
"""The list of a folder's files as they were written, in it: lines of digest and name, as `sha256sum` has them."""


def publish(made: Mapping[str, Mapping[str, bytes]], out: Path, name: str, known: Iterable[str] = ()) -> None:
    """Write the files of each format, all of them before the first takes its place.

    Those below `name`/ take theirs at once: they are a folder that is exchanged with the one before, if the system can
    do that and it is no link. So a build that is killed leaves the pages of one build, and a PDF of this one or the one
    before; what else it leaves is removed by the next one. Two builds at once take turns.

    Only files that are still as they were written are replaced or removed; `known` are lines of such a list, by names
    in `out`, for a folder without one. Raises AtlasError, with all written, where a file was edited: the new one is
    beside it.
    """
    files = {path: content for contents in made.values() for path, content in contents.items()}
    inside = {path.removeprefix(f"{name}/"): content for path, content in files.items() if path.startswith(f"{name}/")}
    lone = {path: content for path, content in files.items() if not path.startswith(f"{name}/")}
    known = {*known}
    edited: dict[str, str] = {}
    with named(out / name), _work(out) as work:
        if inside:
            place, inner = out / name, f"{name}/"
            of_pages = {f"{line[:66]}{line[66:].removeprefix(inner)}" for line in known if line[66:].startswith(inner)}
            before = _lines(place) | of_pages
            inside, beside = _beside(inside, place, before)
            edited |= {f"{inner}{old}": new for old, new in beside.items()}
            foreign = _foreign(place, before, inside)
            _list(inside, before, beside)
            _write(inside, work / name)
            whole = not place.is_symlink()
            for path in foreign if whole else ():
                (work / name / path).parent.mkdir(parents=True, exist_ok=True)
                os.link(place / path, work / name / path, follow_symlinks=False)
            if not (whole and exchange(work / name, place)):
                place.mkdir(parents=True, exist_ok=True)
                lines = before | {*inside[WRITTEN].decode().splitlines()}
                (place / WRITTEN).write_text("".join(f"{line}\n" for line in sorted(lines)), encoding="utf-8")
                _place(work / name, place, inside)
                _remove_others(place, {*inside, *foreign})
        if lone:
            before = _lines(out) | {line for line in known if line[66:] in lone}
            lone, beside = _beside(lone, out, before)
            edited |= beside
            before = {line for line in before if line[66:] not in lone or not _edited(out, line[66:], {line})}
            _list(lone, before, {line[66:]: beside.get(line[66:]) for line in before})
            _write(lone, work)
            _place(work, out, sorted(lone, key=lambda path: path != WRITTEN))
    if edited:
        told = "; ".join(f"{out / old} was edited: the new text is {Path(new).name}" for old, new in edited.items())
        raise AtlasError(f"{told}.")


def replace(place: Path, files: Mapping[str, bytes]) -> None:
    """Put these files into a folder, see `publish`."""
    publish({"folder": {f"{place.name}/{path}": content for path, content in files.items()}}, place.parent, place.name)


def _line(path: str, content: bytes) -> str:
    return f"{hashlib.sha256(content).hexdigest()}  {path}"


def _lines(place: Path) -> set[str]:
    """Return the list of a folder, nothing where there is none."""
    try:
        return {*(place / WRITTEN).read_text(encoding="utf-8").splitlines()}
    except OSError:
        return set()


def _list(files: dict[str, bytes], before: set[str], stay: Mapping[str, str | None]) -> None:
    """Put the list of files among them: their lines, and those before it of names that stay."""
    lines = {_line(path, content) for path, content in files.items()} | {line for line in before if line[66:] in stay}
    lines |= {_line(path, files[new]) for path, new in stay.items() if new}
    files[WRITTEN] = "".join(f"{line}\n" for line in sorted(lines)).encode()


def _edited(place: Path, name: str, lines: set[str]) -> bool:
    """Whether something stands there that is no folder, and no file as it was written."""
    path = place / name
    if path.is_symlink():
        return True
    return path.exists() and not path.is_dir() and not (path.is_file() and _line(name, path.read_bytes()) in lines)


def _foreign(place: Path, lines: set[str], files: Mapping[str, bytes]) -> list[str]:
    """Return what a folder holds beside these files that is not ours."""
    there = (path.relative_to(place).as_posix() for path in place.rglob("*"))
    return sorted(name for name in there if name not in {WRITTEN, *files} and _edited(place, name, lines))


def _beside(files: Mapping[str, bytes], place: Path, lines: set[str]) -> tuple[dict[str, bytes], dict[str, str]]:
    """Return the files under names that are free, and of those that were edited the new name."""
    found, edited = {}, {}
    for path, content in files.items():
        free = path
        while _edited(place, free, lines) and ((place / free).is_symlink() or (place / free).read_bytes() != content):
            free = str(Path(free).with_suffix(f".new{Path(free).suffix}"))
        found[free] = content
        if free != path:
            edited[path] = free
    return found, edited


@contextmanager
def _work(out: Path) -> Iterator[Path]:
    """Give a folder to write to, on the disk of `out` and in its turn; what a killed process left is removed."""
    out.mkdir(parents=True, exist_ok=True)
    with _turn(out):
        for left in out.glob(f"{UNFINISHED}*"):
            shutil.rmtree(left, ignore_errors=True)
        work = Path(mkdtemp(dir=out, prefix=UNFINISHED))
        try:
            yield work
        finally:
            shutil.rmtree(work, ignore_errors=True)


def _write(files: Mapping[str, bytes], folder: Path) -> None:
    """Write files into a folder that is made."""
    for path, content in files.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_bytes(content)


def _place(work: Path, out: Path, files: Iterable[str]) -> None:
    """Put files into their places, one by one."""
    for path in files:
        (out / path).parent.mkdir(parents=True, exist_ok=True)
        (work / path).replace(out / path)


def _remove_others(folder: Path, stay: set[str]) -> None:
    """Remove what a folder holds beside these files."""
    for old in sorted(folder.rglob("*"), reverse=True):
        if old.is_dir() and not old.is_symlink():
            if not any(old.iterdir()):
                old.rmdir()
        elif old.relative_to(folder).as_posix() not in stay:
            old.unlink()


@contextmanager
def _turn(folder: Path) -> Iterator[None]:
    """Wait for one's turn in a folder; the lock is on the folder itself, so that nothing is left in it."""
    opened = os.open(folder, os.O_RDONLY)
    try:
        fcntl.flock(opened, fcntl.LOCK_EX)
        yield
    finally:
        os.close(opened)
