"""A folder of built files, each in a file named after the digest of everything it depends on.

An entry begins with the digest of its key and content. It is written whole or not at all, and checked when it
is read: one that was damaged, or that is the entry of another key, counts as missing and is made again. Two processes
that write the same entry do no harm. The folder may be deleted at any time.

It is not diskcache, which has had no release since 2023 and unpickles its files (CVE-2025-69872), nor
joblib.Memory, which pickles too: nothing that is read here can run code.
"""

import hashlib
import json
import os
import shutil
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from tempfile import mkdtemp
from typing import Any

from atlas import files
from atlas.sources import digest

DAY = 24 * 3600.0
UNUSED = 90 * DAY
"""Seconds after which an unread entry is removed; files of a killed build are removed after a day."""


class Cache:
    """Byte strings by key, a hexadecimal digest, each in a file of `folder`, which is made when first written to."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder.absolute()

    def get(self, key: str) -> bytes | None:
        """Return the bytes stored under a key; None where the file is missing or damaged.

        An entry unread for a day gets a new time, so that `prune` keeps it.
        """
        path = self._path(key)
        try:
            expected, _, content = path.read_bytes().partition(b"\n")
            if time.time() - path.stat().st_mtime > DAY:
                os.utime(path)  # it is in use
        except OSError:
            return None
        return content if _hash(key, content) == expected else None

    def put(self, key: str, content: bytes) -> bytes:
        """Store `content` under a key and return it; an earlier entry is replaced. Raises OSError if that fails."""
        files.write(self._path(key), _hash(key, content) + b"\n" + content)
        return content

    def recall(self, key: str, make: Callable[[], bytes]) -> bytes:
        """Return the bytes stored under a key; if missing or damaged, store and return those of `make()`."""
        entry = self.get(key)
        return self.put(key, make()) if entry is None else entry

    def load(self, name: str) -> Any:
        """Return the JSON value that `save` stored under a name; an empty dictionary if there is none."""
        content = self.get(digest("name", name))
        return {} if content is None else json.loads(content)

    def save(self, name: str, value: Any) -> None:
        """Store a JSON value under a name, which need be no digest; the previous value is replaced."""
        content = json.dumps(value).encode()
        if self.get(digest("name", name)) != content:
            self.put(digest("name", name), content)

    @contextmanager
    def temporary(self) -> Iterator[Path]:
        """Yield a new empty folder below the cache's folder; it is removed with its files when the context ends."""
        (self.folder / "tmp").mkdir(parents=True, exist_ok=True)
        if not (self.folder / ".gitignore").exists():
            files.write(self.folder / ".gitignore", "*\n")
        folder = Path(mkdtemp(dir=self.folder / "tmp"))
        try:
            yield folder
        finally:
            shutil.rmtree(folder, ignore_errors=True)

    def prune(self) -> None:
        """Remove entries unread for 90 days (`UNUSED`), and what a killed build left unfinished over a day ago."""
        now = time.time()
        for path in (*self.folder.glob("??/*"), *self.folder.glob("??/.*"), *self.folder.glob("tmp/*")):
            with suppress(FileNotFoundError):  # another build has removed it
                unfinished = path.parent.name == "tmp" or path.name.startswith(".")
                if now - path.stat().st_mtime > (DAY if unfinished else UNUSED):
                    shutil.rmtree(path) if path.is_dir() else path.unlink()

    def _path(self, key: str) -> Path:
        return self.folder / key[:2] / key


def _hash(key: str, content: bytes) -> bytes:
    return hashlib.sha256(key.encode() + b"\n" + content).hexdigest().encode()
