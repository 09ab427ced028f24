"""A store of what was built, each thing under a digest of everything it depends on.

An entry is a folder of files, written beside and renamed, so that it is there whole or not at all; two builds that make
the same entry at once do no harm. An entry is checked when it is taken: a file that is not the one that was put there
is made again.
"""

import hashlib
import json
import os
import shutil
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

STORE = ".store"
"""The name of a store beside what is built from it."""
CONTENTS = "contents.json"
STALE = 24 * 3600.0  # seconds after which a half-written entry belongs to a build that was killed
UNUSED = 90 * 24 * 3600.0  # seconds after which an entry that nobody has taken makes room


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
            contents = json.loads((folder / CONTENTS).read_text())
            whole = all(_digest(folder / name) == value for name, value in contents["files"].items())
            if whole and time.time() - (folder / CONTENTS).stat().st_mtime > STALE:
                os.utime(folder / CONTENTS)  # so that it is known to be of use
        except (OSError, ValueError, KeyError):
            return None
        return Entry(folder, contents["facts"], new=False) if whole else None

    def make(self, key: str, maker: Callable[[Path], dict[str, Any]]) -> Entry:
        """Make the entry of that key: ``maker`` writes files into an empty folder and returns facts to note."""
        with self.room() as beside:
            facts = maker(beside)
            files = {path.name: _digest(path) for path in sorted(beside.iterdir())}
            (beside / CONTENTS).write_text(json.dumps({"files": files, "facts": facts}))
            folder = self._folder(key)
            folder.parent.mkdir(parents=True, exist_ok=True)
            self._settle(beside, folder)
        return Entry(folder, facts, new=True)

    @contextmanager
    def room(self) -> Iterator[Path]:
        """Give an empty folder to work in; it is gone afterwards, whatever happens."""
        waiting = self.root / "unfinished"
        waiting.mkdir(parents=True, exist_ok=True)
        if not (self.root / ".gitignore").exists():
            (self.root / ".gitignore").write_text("*\n")
        folder = Path(tempfile.mkdtemp(dir=waiting))
        try:
            yield folder
        finally:
            shutil.rmtree(folder, ignore_errors=True)

    def changed(self, name: str, parts: Mapping[str, str]) -> str:
        """Say in words which parts of a thing's key differ from those remembered under its name."""
        before = self._remembered(name)
        different = [part for part, value in parts.items() if before.get(part) != value]
        if not before:
            return "it was never made here"
        return f"changed: {', '.join(different)}" if different else "its files were lost or damaged"

    def remember(self, name: str, parts: Mapping[str, str]) -> None:
        """Remember the parts of a thing's key under its name."""
        if self._remembered(name) == parts:
            return
        note = self._note(name)
        note.parent.mkdir(parents=True, exist_ok=True)
        beside = note.with_name(f"{note.name}.{os.getpid()}")
        beside.write_text(json.dumps(dict(parts)))
        beside.replace(note)

    def _remembered(self, name: str) -> dict[str, str]:
        try:
            found: dict[str, str] = json.loads(self._note(name).read_text())
        except (OSError, ValueError):
            return {}  # nothing remembered, or not readable
        return found

    def sweep(self) -> None:
        """Remove what killed builds left half-written, and what nobody has taken for a long time."""
        now = time.time()
        for left in (self.root / "unfinished").glob("*"):
            with suppress(FileNotFoundError):
                if now - left.stat().st_mtime > STALE:
                    shutil.rmtree(left, ignore_errors=True)
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


def place(source: Path, target: Path) -> bool:
    """Put a copy of a file at ``target``, whole or not at all; return whether anything had to be written."""
    if target.is_file() and target.stat().st_size == source.stat().st_size and _digest(target) == _digest(source):
        return False
    target.parent.mkdir(parents=True, exist_ok=True)
    beside = target.with_name(f".{target.name}.{os.getpid()}")
    try:
        shutil.copyfile(source, beside)
        beside.replace(target)
    finally:
        beside.unlink(missing_ok=True)
    return True


def _digest(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()
