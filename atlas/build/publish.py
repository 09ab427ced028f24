"""The files of a report into their places: all are written before the first takes its own."""

import fcntl
import os
import shutil
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from tempfile import mkdtemp

from atlas.files import exchange, named

UNFINISHED = ".atlas-"
"""How the folder begins that files stand in until all of them are written, on the disk that they are for."""


def publish(made: Mapping[str, Mapping[str, bytes]], out: Path, name: str) -> None:
    """Write the files of each format, all of them before the first takes its place.

    The pages take theirs at once: they are a folder that is exchanged with the one before, if the system can do that
    and it is no link. So a build that is killed leaves the pages of one build, and a PDF of this one or the one before;
    what else it leaves is removed by the next one. Two builds at once take turns.
    """
    files = {path: content for contents in made.values() for path, content in contents.items()}
    with _written(files, out) as work:
        if "html" in made and exchange(work / name, out / name):
            _place(work, out, [path for path in files if not path.startswith(f"{name}/")])
            return
        _place(work, out, files)
        if "html" in made:
            _remove_others(out, out / name, files)


def replace(place: Path, files: Mapping[str, bytes]) -> None:
    """Put a folder with these files in the place of the one that is there, at once if the system can do that.

    Two processes at once take turns. An OSError names the folder where it would name nothing.
    """
    with named(place), _written({f"new/{path}": content for path, content in files.items()}, place.parent) as work:
        if not exchange(work / "new", place):
            place.rename(work / "old")
            (work / "new").rename(place)


@contextmanager
def _written(files: Mapping[str, bytes], out: Path) -> Iterator[Path]:
    """Give a folder with these files, on the disk of `out` and in its turn; what a killed process left is removed."""
    out.mkdir(parents=True, exist_ok=True)
    with _turn(out):
        for left in out.glob(f"{UNFINISHED}*"):
            shutil.rmtree(left, ignore_errors=True)
        work = Path(mkdtemp(dir=out, prefix=UNFINISHED))
        try:
            for path, content in files.items():
                (work / path).parent.mkdir(parents=True, exist_ok=True)
                (work / path).write_bytes(content)
            yield work
        finally:
            shutil.rmtree(work, ignore_errors=True)


def _place(work: Path, out: Path, files: Iterable[str]) -> None:
    """Put files into their places, one by one."""
    for path in files:
        (out / path).parent.mkdir(parents=True, exist_ok=True)
        (work / path).replace(out / path)


def _remove_others(out: Path, folder: Path, files: Mapping[str, bytes]) -> None:
    """Remove what a folder holds beside these files."""
    for old in sorted(folder.rglob("*"), reverse=True):
        if old.is_dir() and not any(old.iterdir()):
            old.rmdir()
        elif not old.is_dir() and old.relative_to(out).as_posix() not in files:
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
