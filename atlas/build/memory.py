"""Texts that were set before, by a digest of what they were set from; one note beside the store."""

import hashlib
from pathlib import Path

from atlas.build import notes


class Memory:
    """A mapping from the source of a text to the text, read from a file and written back whole.

    ``setter`` is the digest of the code that sets them. What is not asked for any more is forgotten when it is saved.
    """

    def __init__(self, file: Path, setter: str) -> None:
        self._file = file
        self._setter = setter
        self._known: dict[str, str] = notes.read(file)
        self._used: dict[str, str] = {}

    def __contains__(self, source: str) -> bool:
        return self._key(source) in self._known

    def __getitem__(self, source: str) -> str:
        key = self._key(source)
        self._used[key] = self._known[key]
        return self._used[key]

    def __setitem__(self, source: str, text: str) -> None:
        self._known[self._key(source)] = text

    def save(self) -> None:
        """Write down what was used."""
        notes.write(self._file, self._used)

    def _key(self, source: str) -> str:
        return hashlib.sha256(f"{self._setter}{source}".encode()).hexdigest()
