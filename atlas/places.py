"""Where figures/, templates/ and reports/ are: in the checkout when there is one, else inside the installed package.

And where a few things are remembered from run to run, without which all goes on.
"""

import atexit
import logging
import os
import shutil
import sys
import tempfile
from contextlib import suppress
from pathlib import Path
from typing import Literal

_PACKAGE = Path(__file__).resolve().parent


def folder(kind: Literal["figures", "templates", "reports"]) -> Path:
    """Return the folder of that kind that belongs to the code that runs."""
    checkout = _PACKAGE.parent
    if (checkout / "pyproject.toml").is_file() and (checkout / kind).is_dir():
        return checkout / kind
    return _PACKAGE / "_data" / kind


def own_folder() -> Path | None:
    """Return a folder of ours that can be written, in the user's cache or in the environment; None if there is none."""
    home = os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")  # noqa: PTH111  Path.home raises without HOME
    for place in (Path(home), Path(sys.prefix)):
        folder = place / "atlas"
        if place.is_absolute():
            with suppress(OSError):
                folder.mkdir(parents=True, exist_ok=True)
                if os.access(folder, os.W_OK):
                    return folder
    return None


def settle_matplotlib() -> None:
    """Give Matplotlib a folder, where it can't write its own: else each process warns and makes one of its own.

    Its list of fonts is kept there, and nothing is said of its being made. To be called before it is loaded.
    """
    logging.getLogger("matplotlib.font_manager").setLevel(logging.ERROR)
    if "MPLCONFIGDIR" in os.environ or os.access(os.path.expanduser("~"), os.W_OK):  # noqa: PTH111
        return
    own = own_folder()
    if own is None:
        own = Path(tempfile.mkdtemp(prefix="atlas-"))
        atexit.register(shutil.rmtree, own, ignore_errors=True)
    os.environ["MPLCONFIGDIR"] = str(own / "matplotlib")
