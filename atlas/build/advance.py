"""A PDF set in advance, while its text is still being read and its figures drawn.

Typst remembers what it has laid out. Once it has set the PDF of the last build, or this one with stand-ins for the
pictures that are not there yet, setting what is wanted takes a fraction of the time.
"""

import json
import os
from collections.abc import Mapping
from concurrent.futures import Future, ThreadPoolExecutor, wait
from contextlib import ExitStack
from functools import cached_property
from pathlib import Path
from typing import Literal, Self

from atlas.build.store import Store
from atlas.build.whole import write
from atlas.report.press import Press

_STAND_IN = "#set page(width: {}mm, height: {}mm, margin: 0mm)\n"
_PPI = 18.0


class Advance:
    """The PDF of a report under way, in a room of the store; pictures go by the names that the source gives them."""

    def __init__(self, store: Store, name: str) -> None:
        self._store = store
        self._last = store.root / f"{name}.press.json"
        self._exit = ExitStack()
        self._hung: dict[str, Path] = {}

    def __enter__(self) -> Self:
        self._room = self._exit.enter_context(self._store.room())
        self._thread = self._exit.enter_context(ThreadPoolExecutor(1))
        self._first: list[Future[None]] = []
        if self._last.exists():
            self._first.append(self._thread.submit(self._repeat))
        return self

    def __exit__(self, *_: object) -> None:
        self._exit.close()

    def rehearse(self, source: str, missing: Mapping[str, tuple[float, float]]) -> None:
        """Set a source with blank pictures of these sizes in millimetres, unless the last PDF is being set already."""
        if missing and not self._first:
            self._first.append(self._thread.submit(self._blank, source, missing))

    def finish(self, source: str, pictures: Mapping[str, Path]) -> bytes:
        """Set the PDF, now that all pictures are there."""
        wait(self._first)  # if that went wrong, so does what follows, and then it is told
        self._hang(pictures)
        pdf = self._press.set(source)
        root = self._store.root
        kept = {"source": source, "pictures": {name: str(path.relative_to(root)) for name, path in pictures.items()}}
        beside = self._last.with_name(f"{self._last.name}.{os.getpid()}")
        beside.write_text(json.dumps(kept), encoding="utf-8")
        beside.replace(self._last)
        return pdf

    @cached_property
    def _press(self) -> Press:
        return Press(self._room)

    def _hang(self, pictures: Mapping[str, Path]) -> None:
        """Put pictures in their places."""
        for name, path in pictures.items():
            if self._hung.get(name) != path:
                write(self._room / name, path.read_bytes())
                self._hung[name] = path

    def _repeat(self) -> None:
        """Set the PDF of the last build once more."""
        last = json.loads(self._last.read_text(encoding="utf-8"))
        self._hang({name: self._store.root / path for name, path in last["pictures"].items()})
        self._press.set(last["source"])

    def _blank(self, source: str, missing: Mapping[str, tuple[float, float]]) -> None:
        """Set the source with blank pictures."""
        import typst

        for name, size in missing.items():
            kind: Literal["png", "pdf"] = "png" if name.endswith(".png") else "pdf"
            blank = typst.compile(_STAND_IN.format(*size).encode(), format=kind, ppi=_PPI, ignore_system_fonts=True)
            write(self._room / name, blank)
        self._press.set(source)
