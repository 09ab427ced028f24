"""The parts of a table, kept in a folder with a manifest until the table is whole, so that a sweep can go on.

The manifest, one JSON value a line, begins with the sweep that the parts belong to. Every file is entered twice: before
it is written, so that only files are ever deleted that a sweep has put there, and after it with its digest, so that a
part that is missing, cut or altered is known and made again. A line that was cut off by the end of a process says
nothing.
"""

import hashlib
import json
import re
from collections.abc import Mapping
from typing import Any
from uuid import uuid4

from atlas.errors import AtlasError
from atlas.study.sweep.storage import Folder, digest, read

MANIFEST = "_sweep.jsonl"
"""Readers of Parquet pass over names that begin so."""
FORMAT = "atlas sweep 1"
BEGIN = json.dumps({"format": FORMAT}).encode()[:-1]
OURS = re.compile(r"part-\d{8}\.(csv|npz|parquet)|whole\.(csv|npz|parquet)", re.ASCII)


class Parts:
    """A folder of parts: what its manifest says. Raises AtlasError for a folder that is not of a sweep."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self.header: Mapping[str, Any] = {}
        self.files: dict[str, str | None] = {}
        folder.check()
        text = read(folder, MANIFEST)
        first, *lines = (text or b"").split(b"\n")
        header = _value(first) if lines else None
        if isinstance(header, dict) and header.get("format") == FORMAT:
            self.header = header
            for line in lines:
                entry = _value(line)
                if isinstance(entry, dict) and OURS.fullmatch(str(entry.get("file"))):
                    self.files[entry["file"]] = entry.get("sha256")
            if lines[-1]:
                folder.append(MANIFEST, b"\n")
        elif text is not None and not lines and BEGIN.startswith(text[: len(BEGIN)]) and folder.names() == {MANIFEST}:
            folder.delete(MANIFEST)
        self._refuse(folder.names() - ({MANIFEST, *self.files} if self.header else set()))

    def _refuse(self, strangers: set[str]) -> None:
        """Raise AtlasError for files that are not ours, but for such in our own folder as do no harm."""
        wrong = {name for name in strangers if not self.header or OURS.fullmatch(name) or name.endswith(".parquet")}
        if wrong:
            raise AtlasError(
                f"{self.folder} holds {min(wrong)}, which is of no sweep: move it away, or choose another --out."
            )

    @property
    def sizes(self) -> dict[str, int]:
        """Rows of the first parts, and the most that a part has."""
        return {name: self.header[name] for name in ("rows", "most")}

    def begin(self, key: str, rows: int, most: int) -> None:
        """Take up the sweep of a key in parts of so many rows, if it is the one whose parts are here; else begin it."""
        same = {"key": key, "rows": rows, "most": most}
        if all(self.header.get(name) == value for name, value in same.items()):
            for name, expected in self.files.items():
                if expected is not None and digest(self.folder, name) != expected:
                    self.files[name] = None
            return
        self.clear()
        self.header = {"format": FORMAT, **same, "id": uuid4().hex}
        self.folder.append(MANIFEST, self.mark)

    @property
    def mark(self) -> bytes:
        """First line of the manifest, by which a worker on another machine knows whether it sees the same folder."""
        return json.dumps(self.header).encode() + b"\n"

    def announce(self, *names: str) -> None:
        """Enter files that will be written."""
        self._enter(dict.fromkeys(names))

    def note(self, digests: Mapping[str, str]) -> None:
        """Enter the digests of files that are written."""
        self._enter(digests)

    def keep(self, name: str, made: str | bytes) -> None:
        """Enter a part by its digest, or write it here where its worker could not."""
        if isinstance(made, bytes):
            self.folder.write(name, made)
            made = hashlib.sha256(made).hexdigest()
        self.note({name: made})

    def _enter(self, files: Mapping[str, str | None]) -> None:
        self.files |= files
        lines = [json.dumps({"file": name} | ({"sha256": x} if x else {})) for name, x in files.items()]
        self.folder.append(MANIFEST, "".join(f"{line}\n" for line in lines).encode())

    def clear(self) -> None:
        """Delete the files that the manifest lists, and then itself; what else is in the folder stays there."""
        for name in self.files:
            self.folder.delete(name)
        if self.header:
            self.folder.delete(MANIFEST)
        self.files, self.header = {}, {}
        self.folder.remove()


def _value(line: bytes) -> Any:
    try:
        return json.loads(line)
    except ValueError:
        return None
