"""A store of what was built, each thing under a digest of everything it depends on.

An entry is a folder of files, written beside and renamed, so that it is there whole or not at all; two builds that make
the same entry at once do no harm. An entry is checked when it is taken: a file that is not the one that was put there
is made again.
"""

import hashlib
import os
import shutil
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from atlas.build import notes
from atlas.build.whole import room

STORE = ".store"
"""The name of a store beside what is built from it."""
CONTENTS, CONTENT = "contents.json", "content"
DAY = 24 * 3600.0
UNUSED = 90 * DAY  # seconds after which an entry that nobody has taken makes room


@dataclass(frozen=True)
class Entry:
    """What is stored under a key: a folder of files and the facts that were noted when it was made."""

    folder: Path
    facts: dict[str, Any]
    new: bool

    def file(self, name: str) -> Path:
        """Return the path of one of its files."""
        return self.folder / name


class Store:
    """A folder of entries by key."""

    def __init__(self, root: Path) -> None:
        self.root = root.absolute()

    def take(self, key: str) -> Entry | None:
        """Return the entry of that key if it is there and whole."""
        folder = self._folder(key)
        try:
            contents = notes.read(folder / CONTENTS)
            whole = all(_digest(folder / name) == value for name, value in contents["files"].items())
            if whole and time.time() - (folder / CONTENTS).stat().st_mtime > DAY:
                os.utime(folder / CONTENTS)  # so that it is known to be of use
        except (OSError, KeyError):
            return None
        return Entry(folder, contents["facts"], new=False) if whole else None

    def make(self, key: str, maker: Callable[[Path], dict[str, Any]]) -> Entry:
        """Make the entry of that key: ``maker`` writes files into an empty folder and returns facts to note."""
        with self.room() as beside:
            facts = maker(beside)
            files = {path.name: _digest(path) for path in sorted(beside.iterdir())}
            notes.put(beside / CONTENTS, {"files": files, "facts": facts})
            folder = self._folder(key)
            folder.parent.mkdir(parents=True, exist_ok=True)
            self._settle(beside, folder)
        return Entry(folder, facts, new=True)

    def recall(self, key: str) -> bytes | None:
        """Return the bytes that were kept under that key."""
        entry = self.take(key)
        return None if entry is None else entry.file(CONTENT).read_bytes()

    def keep(self, key: str, content: bytes) -> bytes:
        """Keep bytes under that key, and return them."""

        def maker(folder: Path) -> dict[str, Any]:
            (folder / CONTENT).write_bytes(content)
            return {}

        self.make(key, maker)
        return content

    @contextmanager
    def room(self) -> Iterator[Path]:
        """Give an empty folder to work in; it is gone afterwards, whatever happens."""
        self.root.mkdir(parents=True, exist_ok=True)
        if not (self.root / ".gitignore").exists():
            (self.root / ".gitignore").write_text("*\n")
        with room(self.root / "unfinished") as folder:
            yield folder

    def changed(self, name: str, parts: Mapping[str, str]) -> str:
        """Say in words which parts of a thing's key differ from those remembered under its name."""
        before = notes.read(self._note(name))
        different = [part for part, value in parts.items() if before.get(part) != value]
        if not before:
            return "it was never made here"
        return f"changed: {', '.join(different)}" if different else "its files were lost or damaged"

    def remember(self, name: str, parts: Mapping[str, str]) -> None:
        """Remember the parts of a thing's key under its name."""
        if notes.read(self._note(name)) != parts:
            notes.write(self._note(name), parts)

    def sweep(self) -> None:
        """Remove what nobody has taken for a long time."""
        now = time.time()
        for contents in self.root.glob(f"??/*/{CONTENTS}"):
            with suppress(FileNotFoundError):  # another build has removed it
                if now - contents.stat().st_mtime > UNUSED:
                    shutil.rmtree(contents.parent, ignore_errors=True)

    def _settle(self, beside: Path, folder: Path) -> None:
        """Rename a finished folder to its place; a broken entry there makes way, a whole one is as good."""
        for _ in range(3):
            try:
                beside.rename(folder)
            except OSError:
                if self.take(folder.name) is not None:
                    return
                broken = beside.with_name(beside.name + ".broken")
                if folder.exists():
                    folder.rename(broken)
                    shutil.rmtree(broken, ignore_errors=True)
            else:
                return
        raise OSError(f"the store could not write {folder}")

    def _note(self, name: str) -> Path:
        return self.root / "names" / f"{hashlib.sha256(name.encode()).hexdigest()[:24]}.json"

    def _folder(self, key: str) -> Path:
        return self.root / key[:2] / key


def place(source: Path, target: Path, beside: Path) -> bool:
    """Put a copy of a file at ``target`` by way of a folder beside it; return whether anything had to be written."""
    if target.is_file() and target.stat().st_size == source.stat().st_size and _digest(target) == _digest(source):
        return False
    target.parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(source, beside / f".{target.name}")
    (beside / f".{target.name}").replace(target)
    return True


def _digest(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()
