"""The place of a table and its parts: on this machine or at any address that fsspec knows, for one sweep at a time.

The name of a part has its rows, the key of its sweep, and the digest of its bytes. By its name a part that is cut,
altered or of another sweep is recognised.
"""

import fcntl
import hashlib
import json
import os
import re
import socket
import time
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from datetime import datetime
from functools import partial
from pathlib import Path
from tempfile import gettempdir
from typing import IO, Any

from atlas import files
from atlas.arithmetic.lazy import cached_property
from atlas.errors import AtlasError
from atlas.places import own_folder
from atlas.sweeps.tables import check_format

PART = re.compile(r"part-(\d{12})-(\d{12})-([0-9a-f]{16})-([0-9a-f]{32})\.(csv|npz|parquet)", re.ASCII)
"""Name of a part: first row, row after the last, key of the sweep, digest of these and of the contents."""
MARK = "atlas sweep"
MEMORY = "memory://"
Span = tuple[int, int]
"""Half-open range of rows (start, stop)."""


def span_of(name: str) -> Span:
    """Return the row range (start, stop) of a part from its name."""
    _, start, stop, *_ = name.split("-")
    return int(start), int(stop)


@dataclass(frozen=True)
class Folder:
    """A folder that holds only parts of a table, made from its path or fsspec address.

    Raises AtlasError where fsspec does not know the address.
    """

    address: str

    def __post_init__(self) -> None:
        try:
            _ = self._place
        except (ImportError, ValueError) as error:
            raise AtlasError(f"{self.address} cannot be reached: {error}.") from error

    @cached_property
    def is_local(self) -> bool:
        """Whether the folder is a path of this machine, not an address with "://"."""
        return "://" not in self.address

    @property
    def _place(self) -> tuple[Any, str]:
        import fsspec

        if self.is_local:
            return fsspec.filesystem("file"), self.address
        system, path = fsspec.core.url_to_fs(self.address)
        return system, str(path).rstrip("/")

    def names(self) -> set[str]:
        """Return the file names of the parts in the folder; the empty set if there is no folder.

        Hidden files are not counted. Raises AtlasError for a file that is no part, a symbolic link, a file in the
        folder's place, and an address out of reach.
        """
        path = Path(self.address)
        if self.is_local and (path.is_symlink() or (path.exists() and not path.is_dir())):
            kind = "a symbolic link" if path.is_symlink() else "no folder"
            raise AtlasError(f"{path} is {kind}; a sweep keeps its files in a folder of its own.")
        system, path_there = self._place
        system.invalidate_cache()
        try:
            names = {str(name).rsplit("/", 1)[-1] for name in system.ls(path_there, detail=False)}
        except FileNotFoundError:
            return set()
        except Exception as error:
            if self.is_local:
                raise
            reason = " ".join(str(error).split()).removesuffix(".") or type(error).__name__
            raise AtlasError(f"{self.address} cannot be reached: {reason}.") from error
        part_names = {name for name in names if PART.fullmatch(name)}
        strangers = [name for name in names - part_names if not name.startswith(".")]
        if strangers:
            raise AtlasError(
                f"{self.address} holds {min(strangers)}, which no sweep wrote: move it away, or choose another --out."
            )
        return part_names

    def holds(self, name: str) -> bool:
        """Return whether a part with this file name exists and its content has the digest in the name."""
        rows, _, digest = name.rpartition(".")[0].rpartition("-")
        with suppress(OSError), self.open(name) as file:
            return hashlib.file_digest(file, partial(hashlib.sha256, rows.encode())).hexdigest()[:32] == digest  # type: ignore[arg-type]  # a file
        return False

    def open(self, name: str) -> IO[bytes]:
        """Return the file `name` of the folder, open for reading bytes. Raises FileNotFoundError if it is missing."""
        system, path = self._place
        file: IO[bytes] = system.open(f"{path}/{name}", "rb")
        return file

    def write(self, name: str, data: bytes) -> None:
        """Write bytes into the file `name` of the folder, which is made if missing. An OSError names that file."""
        system, path = self._place
        system.makedirs(path, exist_ok=True)
        with files.named(Path(path, name)):
            system.pipe_file(f"{path}/{name}", data)

    def delete(self, name: str) -> None:
        """Delete the file `name` of the folder; nothing happens if it does not exist."""
        system, path = self._place
        with suppress(FileNotFoundError):
            system.rm_file(f"{path}/{name}")

    def move(self, name: str, to: "Folder") -> None:
        """Move the file `name` into another folder of the same file system; a file of that name is overwritten."""
        system, path = self._place
        target = to._place[1]  # noqa: SLF001  of its own kind
        system.makedirs(target, exist_ok=True)
        system.mv(f"{path}/{name}", f"{target}/{name}")

    def clear(self, names: Iterable[str]) -> None:
        """Delete the named files where they exist, then the folder if that is empty."""
        for name in names:
            self.delete(name)
        system, path = self._place
        with suppress(OSError):
            system.rmdir(path)


class Table:
    """Destination of a table: a file .csv, .npz or .parquet, or a folder of Parquet files that is read as one table.

    Made from the path or address `out` and the digest `key` of its sweep. `place` is that path or address, `ending`
    the suffix of its parts, `parts` their folder until the table is complete, `lock` the path of its lock file.
    `table_folder` is the folder of a table made of files, else None. Raises AtlasError for an unknown format, one that
    cannot be written here, and an address out of reach.
    """

    def __init__(self, out: str | os.PathLike[str], key: str) -> None:
        text = os.fspath(out)
        remote, path = "://" in text, Path(text)
        self.key, self.mark = key, ""
        self.table_folder: Folder | None = None
        self.place: Path | str = text if remote else path
        if remote and not all(part.strip("/") for part in text.split("://")):
            raise AtlasError(f"{text} is no address: name its protocol and its path, as s3://bucket/table.parquet.")
        if remote or text.endswith(("/", os.sep)) or path.is_dir():
            if path.suffix not in {"", ".parquet"}:
                raise AtlasError(f"A table in a folder is of Parquet, as table.parquet/, not {text}.")
            self.table_folder = Folder(text.rstrip("/") if remote else str(path.absolute()))
            self.table_folder.names()  # an address out of reach is refused before libraries are installed for it
            check_format(Path("table.parquet"))
        else:
            check_format(path)
        address = self.table_folder.address if self.table_folder else str(path.absolute())
        self.ending = "parquet" if self.table_folder else path.suffix[1:]
        self.parts = Folder(f"{address}.parts")
        self.lock = path.absolute().with_name(f".{path.name}.lock")
        if remote:  # it holds for the sweeps of this machine
            name = hashlib.sha256(text.encode()).hexdigest()[:16]
            self.lock = (own_folder() or Path(gettempdir())) / f"sweep-{name}.lock"

    def name(self, span: Span, data: bytes) -> str:
        """Return the file name of a part: its row range (start, stop), its `key`, the digest of its bytes `data`."""
        rows = f"part-{span[0]:012d}-{span[1]:012d}-{self.key}"
        return f"{rows}-{hashlib.sha256(rows.encode() + data).hexdigest()[:32]}.{self.ending}"

    def path(self, name: str) -> Path:
        """Return the path of the part `name` of a table on this machine."""
        return Path(self.parts.address, name)

    def whole_parts(self) -> dict[Span, str]:
        """Return the file names of the undamaged parts of this sweep by row range (start, stop), in order of rows.

        Other files in the folder of parts are removed. Parts of a data set may already be in its place, if a sweep
        was stopped in its last steps.
        """
        parts_by_rows: dict[Span, str] = {}
        end = 0
        places = {name: folder for folder in (self.table_folder, self.parts) if folder for name in folder.names()}
        for name in sorted(places):
            span = span_of(name)
            if f"-{self.key}-" in name and name.endswith(self.ending) and span[0] >= end and places[name].holds(name):
                parts_by_rows[span], end = name, span[1]
        self.parts.clear(self.parts.names() - {*parts_by_rows.values()})
        return parts_by_rows

    def move(self, names: list[str]) -> None:
        """Move the named parts of a data set to its folder, after other parts there are deleted.

        A table in one file is left as it is.
        """
        if self.table_folder is not None:
            self.table_folder.clear(self.table_folder.names() - {*names})
            for name in sorted(self.parts.names() & {*names}):
                self.parts.move(name, self.table_folder)

    def is_seen(self) -> bool:
        """Return whether this process sees the folder that the sweep sees: the lock file has the same text.

        For files at memory:// that is so in the process of the sweep alone, at other addresses always.
        """
        if self.parts.address.startswith(MEMORY):
            return bool(json.loads(self.mark)["pid"] == os.getpid())
        try:
            return not self.parts.is_local or self.lock.read_text(encoding="utf-8") == self.mark
        except OSError:
            return False

    @contextmanager
    def hold(self) -> Iterator[None]:
        """Hold the table's lock, a lock of the system that ends with this process; `mark` is the text of its file.

        The file is removed at the end; one left behind by a killed sweep is ignored. Raises AtlasError that says which
        process holds the lock, that the file is of another kind, or that none can be written there.
        """
        if self.lock.is_symlink() or self._record() is None:
            raise AtlasError(f"{self.lock} would be the lock of the sweep, but is something else: move it away.")
        try:
            self.lock.parent.mkdir(parents=True, exist_ok=True)
            lock = self._locked()
        except OSError as error:
            raise AtlasError(f"{self.place} cannot be written: {error.strerror}.") from error
        try:
            since = datetime.now().astimezone().isoformat(" ", "seconds")
            record = {MARK: str(self.place), "pid": os.getpid(), "host": socket.gethostname(), "since": since}
            self.mark = json.dumps(record)
            self.lock.write_text(self.mark, encoding="utf-8")
            yield
        finally:
            with suppress(OSError):  # while it is held, so that nobody holds another file of this name
                self.lock.unlink()
            os.close(lock)

    def _locked(self) -> int:
        """Return the file descriptor of the lock, opened and locked; a file removed meanwhile is made again.

        Raises AtlasError that names the holder, if another sweep holds the lock.
        """
        while True:
            lock = os.open(self.lock, os.O_RDWR | os.O_CREAT, 0o644)
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError as error:
                os.close(lock)
                raise AtlasError(f"{self.place} is being written by another sweep{self._holder()}.") from error
            if os.fstat(lock).st_nlink:
                return lock
            os.close(lock)

    def _record(self) -> dict[str, Any] | None:
        """Return the record that the lock's holder wrote: table, process number, host, time since.

        {"atlas sweep": ""} for no file or an empty one; None for a file of another kind.
        """
        try:
            record = json.loads(self.lock.read_text(encoding="utf-8") or json.dumps({MARK: ""}))
        except FileNotFoundError:
            return {MARK: ""}
        except (OSError, ValueError):
            return None
        return record if isinstance(record, dict) and MARK in record else None

    def _holder(self) -> str:
        """Return the process that holds the lock, as " (process N on HOST, since TIME)".

        "" if its record is missing or not yet written after half a second.
        """
        for _ in range(10):
            record = self._record() or {}
            is_local = record.get("host") == socket.gethostname() and os.name == "posix"
            if "pid" in record and (not is_local or files.alive(int(record["pid"]))):
                return f" (process {record['pid']} on {record['host']}, since {record['since']})"
            time.sleep(0.05)
        return ""
