"""One sweep at a time for a table: a lock of the operating system, which ends with the process that holds it."""

import json
import os
import socket
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from datetime import datetime
from pathlib import Path
from typing import Any

from atlas.errors import AtlasError

MARK = "atlas sweep"


@contextmanager
def held(path: Path, table: str) -> Iterator[None]:
    """Hold the lock of a table. Raises AtlasError that says who holds it, or that the file is of another kind.

    The file is removed at the end. One that a killed sweep left behind is no hindrance: what counts is the lock.
    """
    from filelock import FileLock, Timeout

    if path.is_symlink() or (path.exists() and not (path.is_file() and _ours(path))):
        raise AtlasError(f"{path} is needed for the lock of the sweep, but is something else.")
    path.parent.mkdir(parents=True, exist_ok=True)
    lock = FileLock(path)
    try:
        lock.acquire(timeout=0)
    except Timeout as error:
        raise AtlasError(f"{table} is being written by another sweep{_holder(path)}.") from error
    try:
        since = datetime.now().astimezone().isoformat(" ", "seconds")
        path.write_text(
            json.dumps({MARK: table, "pid": os.getpid(), "host": socket.gethostname(), "since": since}),
            encoding="utf-8",
        )
        yield
    finally:
        with suppress(OSError):  # while it is held, so that nobody holds another file of this name
            path.unlink()
        lock.release()


def _record(path: Path) -> dict[str, Any] | None:
    """Return what a file says of its holder, None if it is not ours; of an empty one that is not known."""
    try:
        text = path.read_text(encoding="utf-8")
        record = json.loads(text) if text else {MARK: ""}
    except FileNotFoundError:
        return {MARK: ""}
    except (OSError, ValueError):
        return None
    return record if isinstance(record, dict) and MARK in record else None


def _ours(path: Path) -> bool:
    """Return whether a file is a lock of ours; a holder that has just begun may be writing it."""
    for _ in range(4):
        if _record(path) is not None:
            return True
        time.sleep(0.05)
    return False


def _holder(path: Path) -> str:
    """Return who holds a lock, as far as it is known: its record is written a moment after it is taken."""
    for _ in range(10):
        record = _record(path) or {}
        if "pid" in record and _runs(record):
            return f" (process {record['pid']} on {record['host']}, since {record['since']})"
        time.sleep(0.05)
    return ""


def _runs(record: dict[str, Any]) -> bool:
    """Return whether the process of a record is there; where that cannot be seen, it is believed."""
    if os.name != "posix" or record["host"] != socket.gethostname():
        return True
    try:
        os.kill(int(record["pid"]), 0)
    except (ProcessLookupError, ValueError):
        return False
    except PermissionError:
        return True
    return True
