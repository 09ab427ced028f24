"""Folders that hold the files of a table: on this machine, or at any address that fsspec knows."""

import hashlib
import io
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any

from atlas import files
from atlas.errors import AtlasError
from atlas.libraries import of_sweeps


@dataclass(frozen=True)
class Local:
    """A folder on this machine."""

    path: Path

    def __str__(self) -> str:
        return str(self.path)

    def beside(self, name: str) -> "Local":
        """Return the folder that has this name and more."""
        return Local(self.path.with_name(self.path.name + name))

    def check(self) -> None:
        """Raise AtlasError for what is no folder or leads to another one."""
        if self.path.is_symlink() or (self.path.exists() and not self.path.is_dir()):
            kind = "a symbolic link" if self.path.is_symlink() else "no folder"
            raise AtlasError(f"{self} is {kind}; a sweep keeps its files in a folder of its own.")

    def names(self) -> set[str]:
        """Return the names of what it holds."""
        return {file.name for file in self.path.iterdir()} if self.path.exists() else set()

    def open(self, name: str) -> IO[bytes]:
        """Return a file to be read. Raises FileNotFoundError."""
        return (self.path / name).open("rb")

    def write(self, name: str, data: bytes) -> None:
        """Write a file in place of one of that name; the folder is there."""
        self.delete(name)
        with files.named(self.path / name), (self.path / name).open("xb") as file:  # never through a link
            file.write(data)

    def append(self, name: str, data: bytes) -> None:
        """Write more at the end of a file; the folder is made for the first."""
        self.path.mkdir(parents=True, exist_ok=True)
        with files.named(self.path / name), (self.path / name).open("ab") as file:
            file.write(data)

    def delete(self, name: str) -> None:
        """Delete a file, if it is there."""
        (self.path / name).unlink(missing_ok=True)

    def move(self, name: str, to: Any) -> None:
        """Move a file into another folder of the same kind."""
        to.path.mkdir(parents=True, exist_ok=True)
        (self.path / name).replace(to.path / name)

    def remove(self) -> None:
        """Delete the folder if it is empty."""
        with suppress(OSError):
            self.path.rmdir()


@dataclass(frozen=True)
class Remote:
    """A folder at an address, as s3://bucket/table.parquet. Raises AtlasError where fsspec has no way there."""

    address: str

    def __post_init__(self) -> None:
        fsspec = of_sweeps("fsspec", "An address")
        try:
            fsspec.core.url_to_fs(self.address)
        except (ImportError, ValueError) as error:
            raise AtlasError(f"{self.address} cannot be reached: {error}.") from error

    def __str__(self) -> str:
        return self.address

    @property
    def _place(self) -> tuple[Any, str]:
        import fsspec

        system, path = fsspec.core.url_to_fs(self.address)
        return system, str(path).rstrip("/")

    def beside(self, name: str) -> "Remote":
        """Return the folder that has this name and more."""
        return Remote(self.address.rstrip("/") + name)

    def check(self) -> None:
        """Accept: there are no links, and folders need not be made."""

    def names(self) -> set[str]:
        """Return the names of what it holds."""
        system, path = self._place
        system.invalidate_cache()
        try:
            return {str(name).rsplit("/", 1)[-1] for name in system.ls(path, detail=False)}
        except FileNotFoundError:
            return set()

    def open(self, name: str) -> IO[bytes]:
        """Return a file to be read. Raises FileNotFoundError."""
        system, path = self._place
        file: IO[bytes] = system.open(f"{path}/{name}", "rb")
        return file

    def write(self, name: str, data: bytes) -> None:
        """Write a file in place of one of that name."""
        system, path = self._place
        system.makedirs(path, exist_ok=True)
        system.pipe_file(f"{path}/{name}", data)

    def append(self, name: str, data: bytes) -> None:
        """Write a file again with more at its end: object stores know no other way."""
        self.write(name, (read(self, name) or b"") + data)

    def delete(self, name: str) -> None:
        """Delete a file, if it is there."""
        system, path = self._place
        with suppress(FileNotFoundError):
            system.rm_file(f"{path}/{name}")

    def move(self, name: str, to: Any) -> None:
        """Move a file into another folder of the same kind."""
        system, path = self._place
        target = to._place[1]  # noqa: SLF001  of its own kind
        system.makedirs(target, exist_ok=True)
        system.mv(f"{path}/{name}", f"{target}/{name}")

    def remove(self) -> None:
        """Delete the folder if it is empty, where there are such."""
        system, path = self._place
        with suppress(OSError):
            system.rmdir(path)


Folder = Local | Remote


def read(folder: Folder, name: str) -> bytes | None:
    """Return what a file holds, None if there is none."""
    try:
        with folder.open(name) as file:
            return file.read()
    except FileNotFoundError:
        return None


def digest(folder: Folder, name: str) -> str | None:
    """Return the digest of a file, None if there is none."""
    try:
        with folder.open(name) as file:
            # of no more than a piece at a time
            found = hashlib.sha256()
            while piece := file.read(io.DEFAULT_BUFFER_SIZE * 64):
                found.update(piece)
    except (FileNotFoundError, IsADirectoryError):
        return None
    return found.hexdigest()
