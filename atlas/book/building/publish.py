"""The files of a report into their places: all are written before the first takes its own."""

import hashlib
import os
import shutil
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from tempfile import mkdtemp

from atlas import files
from atlas.files import WRITTEN, exchange, named

UNFINISHED = ".atlas-"
"""How the folder begins that files stand in until all of them are written, on the disk that they are for."""


def publish(pages: Mapping[str, Mapping[str, bytes]], out: Path, name: str, lines_before: Iterable[str] = ()) -> None:
    """Write the files of each format into `out`, all of them before the first takes its place.

    `pages` holds for each format its files, contents by path. Files below `name`/ are replaced at once: their
    folder is exchanged with the previous one, if the system can do that and it is no link. So a killed build leaves
    the pages of one build, and a PDF of this build or the previous one; other files that it leaves are removed by
    the next build. Two builds at once take turns.

    Only files that are unchanged since they were written are replaced or removed. A folder holds a list of the
    files that builds wrote, lines "digest  path"; `lines_before` are such lines, with paths in `out`, for a folder
    without a list. An edited file stays, the new one is written beside it, and AtlasError is raised after
    everything is written.
    """
    contents = {path: content for page in pages.values() for path, content in page.items()}
    inner = f"{name}/"
    inside = {path.removeprefix(inner): content for path, content in contents.items() if path.startswith(inner)}
    lone = {path: content for path, content in contents.items() if not path.startswith(inner)}
    lines_before, edited = {*lines_before}, dict[str, str]()
    with named(out / name), _work(out) as work:
        _write(lone, work)
        if inside:
            of_pages = {
                f"{line[:66]}{line[66:].removeprefix(inner)}" for line in lines_before if line[66:].startswith(inner)
            }
            renamed = _pages(inside, out / name, of_pages, work / name)
            edited |= {f"{inner}{old}": new for old, new in renamed.items()}
        if lone:
            edited |= files.settle({path: work / path for path in lone}, out, lines_before)
    files.tell(out, edited)


def _pages(inside: Mapping[str, bytes], place: Path, lines_before: set[str], work: Path) -> dict[str, str]:
    """Replace the files of the folder `place` by those of `inside`, contents by path, at once.

    Returns {path: new path} of the files that are written beside an edited one, which is kept. `lines_before` are
    lines "digest  path" of files that a build wrote before; `work` is the folder on the same disk where all are
    written first.
    """
    before = files.lines(place) | lines_before
    digests = {path: hashlib.sha256(content).hexdigest() for path, content in inside.items()}
    places = files.free_names(digests, place, before)
    renamed = {path: new for path, new in places.items() if new != path}
    foreign_paths = _user_files(place, before, {*places.values()})
    lines = {line for line in before if line[66:] in renamed}
    lines |= {f"{digests[path]}  {name}" for path, new in places.items() for name in (path, new)}
    content = {new: inside[path] for path, new in places.items()}
    _write(content | {WRITTEN: files.listed(lines).encode()}, work)
    is_folder = not place.is_symlink()
    for path in foreign_paths if is_folder else ():
        (work / path).parent.mkdir(parents=True, exist_ok=True)
        os.link(place / path, work / path, follow_symlinks=False)
    if not (is_folder and exchange(work, place)):
        place.mkdir(parents=True, exist_ok=True)
        (place / WRITTEN).write_text(files.listed(before | lines), encoding="utf-8")
        stay = [*content, WRITTEN]
        _place(work, place, stay)
        _remove_others(place, {*stay, *foreign_paths})
    files.hide_notes(place)
    return renamed


def replace(place: Path, contents: Mapping[str, bytes]) -> None:
    """Write files, contents by path, into the folder `place`, and remove others there that a build wrote.

    Files that the user wrote or edited stay; for an edited one AtlasError is raised at the end, see `publish`.
    """
    inside = {f"{place.name}/{path}": content for path, content in contents.items()}
    publish({"folder": inside}, place.parent, place.name)


def _user_files(place: Path, lines: set[str], names: set[str]) -> list[str]:
    """Return the sorted paths in the folder `place`, except `names`, of files that no build wrote or that were edited.

    `lines` are the lines "digest  path" of the files that builds wrote.
    """
    paths = (path.relative_to(place).as_posix() for path in place.rglob("*"))
    return sorted(name for name in paths if name not in {WRITTEN, *names} and files.edited(place, name, lines))


@contextmanager
def _work(out: Path) -> Iterator[Path]:
    """Yield an empty folder to write to, on the disk of `out`, under a lock of `out`; it is removed at the end.

    Such folders of killed processes are removed at the beginning.
    """
    out.mkdir(parents=True, exist_ok=True)
    with files.turn(out):
        for remaining in out.glob(f"{UNFINISHED}*"):
            shutil.rmtree(remaining, ignore_errors=True)
        work = Path(mkdtemp(dir=out, prefix=UNFINISHED))
        try:
            yield work
        finally:
            shutil.rmtree(work, ignore_errors=True)


def _write(contents: Mapping[str, bytes], folder: Path) -> None:
    """Write files, contents by path, into a folder, over existing ones; missing folders are made."""
    for path, content in contents.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_bytes(content)


def _place(work: Path, out: Path, names: Iterable[str]) -> None:
    """Move the files `names`, paths in the folder `work`, to the folder `out`, one by one.

    Existing ones are replaced.
    """
    for path in names:
        (out / path).parent.mkdir(parents=True, exist_ok=True)
        (work / path).replace(out / path)


def _remove_others(folder: Path, stay: set[str]) -> None:
    """Remove from a folder, at any depth, all files whose path is not in `stay`, then the empty folders."""
    for old in sorted(folder.rglob("*"), reverse=True):
        if old.is_dir() and not old.is_symlink():
            if not any(old.iterdir()):
                old.rmdir()
        elif old.relative_to(folder).as_posix() not in stay:
            old.unlink()
