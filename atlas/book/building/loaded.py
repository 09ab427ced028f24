"""Modules that multiprocessing's fork server imports once for all workers that draw figures."""

import gc
import sys
from contextlib import suppress
from importlib import import_module

from atlas.places import settle_matplotlib

# A worker that can't start is missed by its pool; where there is none any more, after Ctrl-C, nobody is to be told.
sys.excepthook = lambda *_: None
settle_matplotlib()
for name in (
    "atlas.book.building.worker",
    "atlas.motions.elementary.kernel",
    "atlas.pictures.drawing.files",
    "atlas.pictures.drawing.moves",
    "fontTools.subset",
    "fontTools.ttLib.tables.otTables",
    "matplotlib._constrained_layout",
    "matplotlib.backends.backend_pdf",
    "matplotlib.backends.backend_svg",
    "matplotlib.style",
):
    with suppress(Exception):  # what can't be loaded is told by the worker that needs it
        import_module(name)
gc.freeze()  # what all of them have is not searched for garbage again by each
gc.set_threshold(100_000)  # a picture's objects live until it is saved: to search for garbage more often takes 6 %
