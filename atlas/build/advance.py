"""A PDF set in advance, while its figures are still being drawn.

Typst remembers what it has laid out. Once it has set the text with stand-ins for the missing pictures, setting it again
with the pictures themselves takes a fraction of the time.
"""

from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor, wait
from pathlib import Path
from threading import Event, Lock
from typing import Literal

from atlas.build.whole import write
from atlas.report.pdf import Press

_STAND_IN = "#set page(width: {}mm, height: {}mm, margin: 0mm)\n"
_PPI = 18.0
_MOMENT = 0.15  # seconds: to wait longer would cost more than to begin


class Advance:
    """A PDF under way: `missing` are the pictures that are not there yet, with their sizes in millimetres."""

    def __init__(self, folder: Path, typst_source: str, missing: Mapping[str, tuple[float, float]]) -> None:
        self._press = Press(folder)
        self._drawn, self._writing = Event(), Lock()
        self._thread = ThreadPoolExecutor(1)
        self._first = [self._thread.submit(self._rehearse, folder, typst_source, missing)] if missing else []

    def make_way(self) -> None:
        """Write no stand-in any more: the pictures come into their places."""
        with self._writing:
            self._drawn.set()

    def finish(self, typst_source: str) -> bytes:
        """Set the PDF, now that all pictures are there."""
        self.make_way()
        wait(self._first)  # if it went wrong, so does what follows, and that is told
        self._thread.shutdown()
        return self._press.set(typst_source)

    def _rehearse(self, folder: Path, typst_source: str, missing: Mapping[str, tuple[float, float]]) -> None:
        """Set the source with blank pictures, unless the pictures are there in a moment."""
        if self._drawn.wait(_MOMENT):
            return
        import typst

        for name, size in missing.items():
            kind: Literal["png", "svg"] = "png" if name.endswith(".png") else "svg"
            blank = typst.compile(_STAND_IN.format(*size).encode(), format=kind, ppi=_PPI, ignore_system_fonts=True)
            with self._writing:
                if self._drawn.is_set():
                    return
                write(folder / name, blank)
        self._press.set(typst_source)
