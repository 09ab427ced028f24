"""Writing whole or not at all: every file is made beside its place and renamed into it.

A build that is killed leaves the files of the last good one as they were; what it left behind is swept up by the next.
"""

import fcntl
import os
import shutil
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from tempfile import mkdtemp

from atlas.errors import AtlasError

PREFIX = ".making-"
LOCK = ".lock"


@contextmanager
def staging(out: Path) -> Iterator[Path]:
    """Give a folder beside `out`'s files to make new ones in; it is gone afterwards, whatever happens."""
    with ExitStack() as stack:
        try:
            folder = stack.enter_context(room(out))
        except OSError as error:
            raise AtlasError(f"nothing can be written to {out}: {error.strerror}.") from error
        try:
            yield folder
        except OSError as error:
            raise OSError(f"the build in {out} stopped: {error.strerror or error}.") from error


@contextmanager
def room(where: Path) -> Iterator[Path]:
    """Give an empty folder below `where`; it is gone afterwards, whatever happens, or swept up when the next is given.

    It holds a lock for as long as its process lives. Folders are given and swept up in turns, so that none is swept
    up before it is locked.
    """
    where.mkdir(parents=True, exist_ok=True)
    with ExitStack() as held:
        with _turn(where):
            _sweep(where)
            folder = Path(mkdtemp(prefix=PREFIX, dir=where))
            fcntl.flock(held.enter_context((folder / LOCK).open("w")), fcntl.LOCK_EX)
        try:
            (folder / "new").mkdir()
            yield folder / "new"
        except OSError as error:
            if error.errno and not error.filename:
                raise OSError(error.errno, error.strerror, str(where)) from error
            raise
        finally:
            shutil.rmtree(folder, ignore_errors=True)


def publish(stage: Path, out: Path, files: list[str], owned: list[str]) -> None:
    """Rename files from the staging folder into their places in `out`, in this order, then remove what is stale.

    `owned` are the folders of `out` that hold nothing but this build's files: what else is in them goes.
    Two builds at once take turns here.
    """
    with _turn(out):
        for name in files:
            place = out / name
            place.parent.mkdir(parents=True, exist_ok=True)
            (stage / name).replace(place)
        kept = {out / name for name in files}
        for folder in owned:
            for path in sorted((out / folder).rglob("*"), reverse=True):
                if path.is_dir() and not any(path.iterdir()):
                    path.rmdir()
                elif not path.is_dir() and path not in kept:
                    path.unlink()


def write(path: Path, content: str | bytes) -> None:
    """Write a file of the staging folder, with its folders."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content.encode() if isinstance(content, str) else content)


@contextmanager
def _turn(where: Path) -> Iterator[None]:
    """Wait for one's turn in a folder; the lock is on the folder itself, so that nothing is left in it."""
    folder = os.open(where, os.O_RDONLY)
    try:
        fcntl.flock(folder, fcntl.LOCK_EX)
        yield
    finally:
        os.close(folder)


def _sweep(where: Path) -> None:
    """Remove what killed builds left: folders that no living process holds."""
    for folder in where.glob(f"{PREFIX}*"):
        try:
            with (folder / LOCK).open("r") as lock:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                shutil.rmtree(folder, ignore_errors=True)
        except (FileNotFoundError, NotADirectoryError):
            shutil.rmtree(folder, ignore_errors=True)
        except BlockingIOError:
            continue
