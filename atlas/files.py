"""Files written whole or not at all: under another name beside their place first, then renamed."""

import ctypes
import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from glob import escape
from pathlib import Path

HERE, EXCHANGE = -100, 2
"""AT_FDCWD and RENAME_EXCHANGE of Linux."""


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Give a name beside ``path`` to write to. The file takes the place of ``path`` at the end, if nothing is raised.

    Missing folders are made; what a process on this machine has left that was killed while it wrote is removed. The
    other name ends in the same suffix. An OSError names ``path``, not the other name.
    """
    part = _unfinished(path, os.getpid())
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        for left in path.parent.glob(f".unfinished-*-{escape(path.name)}"):
            pid = left.name.split("-")[1]
            if left == _unfinished(path, pid) and pid.isdecimal() and not alive(int(pid)):
                left.unlink(missing_ok=True)
        yield part
        part.replace(path)
    except OSError as error:
        if error.errno is None or Path(error.filename or part) != part:
            raise
        raise OSError(error.errno, error.strerror, str(path)) from error
    finally:
        with suppress(OSError):
            part.unlink(missing_ok=True)


def _unfinished(path: Path, pid: int | str) -> Path:
    return path.with_name(f".unfinished-{pid}-{path.name}")


def alive(pid: int) -> bool:
    """Return whether there is a process of that number on this machine."""
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    except (PermissionError, OverflowError):
        return True  # another user's, or no number of a process
    return True


def exchange(new: Path, old: Path) -> bool:
    """Let two folders change places at once, or put the new one where none is; False if this system cannot do that.

    Nor is it done where the place is a link or no folder. Both are on one file system.
    """
    if not old.exists() and not old.is_symlink():
        new.rename(old)
        return True
    if old.is_symlink() or not old.is_dir():
        return False
    try:
        rename = ctypes.CDLL(None).renameat2
    except (AttributeError, OSError, TypeError):
        return False
    return bool(rename(HERE, os.fsencode(new.absolute()), HERE, os.fsencode(old.absolute()), EXCHANGE) == 0)


@contextmanager
def named(path: Path) -> Iterator[None]:
    """Give an OSError the file's name that has none: one of writing, as on a full disk."""
    try:
        yield
    except OSError as error:
        if error.filename or error.errno is None:
            raise
        raise OSError(error.errno, error.strerror, str(path)) from error


def check(path: Path) -> None:
    """Raise OSError if no file can be written there; what is there stays as it is."""
    part = _unfinished(path, os.getpid())
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        part.touch()
        part.unlink()
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(path)) from error


def write(path: Path, content: str | bytes) -> None:
    """Write a file, text as UTF-8."""
    with replacing(path) as part:
        part.write_bytes(content.encode() if isinstance(content, str) else content)
