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
from functools import cache
from pathlib import Path
from typing import Literal

_PACKAGE = Path(__file__).resolve().parent


def folder(kind: Literal["figures", "templates", "reports"]) -> Path:
    """Return the path of figures/, templates/ or reports/: of the checkout if there is one, else of the package."""
    checkout = _PACKAGE.parent
    if (checkout / "pyproject.toml").is_file() and (checkout / kind).is_dir():
        return checkout / kind
    return _PACKAGE / "_data" / kind


def own_folder() -> Path | None:
    """Return a folder of atlas that can be written, made if missing; None if there is none.

    That is the folder "atlas" in the user's cache, else in the Python environment.
    """
    from platformdirs import user_cache_path

    places = [Path(sys.prefix) / "atlas"]
    with suppress(RuntimeError):  # there is no home
        places.insert(0, user_cache_path("atlas", appauthor=False))
    for folder in filter(Path.is_absolute, places):
        with suppress(OSError):
            folder.mkdir(parents=True, exist_ok=True)
            if os.access(folder, os.W_OK):
                return folder
    return None


def cache_folder(out: Path) -> Path:
    """Return the folder that keeps intermediate results between builds of the output folder `out`.

    That is the folder of the variable ATLAS_CACHE; ``build/.cache`` of the checkout if `out` is in its ``build``;
    else one in the user's cache. If none can be written, a temporary folder that is removed with this process.
    """
    chosen, build = os.environ.get("ATLAS_CACHE"), _PACKAGE.parent / "build"
    if chosen:
        return Path(chosen)
    if (build.parent / "pyproject.toml").is_file() and out.resolve().is_relative_to(build):
        return build / ".cache"
    user_folder = own_folder()
    return _passing() if user_folder is None else user_folder / "built"


@cache
def _passing() -> Path:
    """Return a temporary folder, made at the first call, the same at each, that is removed when this process ends."""
    folder = Path(tempfile.mkdtemp(prefix="atlas-"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder


def settle_matplotlib() -> None:
    """Set the environment for Matplotlib; call this before Matplotlib is imported.

    Where its own folders cannot be written, MPLCONFIGDIR names one of atlas, so that the list of fonts is kept.
    MPLBACKEND and SOURCE_DATE_EPOCH are removed: wrong values would end the process. Its messages about fonts and
    films are silenced.
    """
    for name in ("MPLBACKEND", "SOURCE_DATE_EPOCH"):
        os.environ.pop(name, None)
    logging.getLogger("matplotlib.font_manager").setLevel(logging.ERROR)
    logging.getLogger("matplotlib.animation").setLevel(logging.CRITICAL)  # what it says is in what it raises
    home = os.path.expanduser("~")  # noqa: PTH111  Path.home raises without HOME
    its = (os.environ.get(name) or home for name in ("XDG_CONFIG_HOME", "XDG_CACHE_HOME"))
    if "MPLCONFIGDIR" in os.environ or all(os.access(folder, os.W_OK) for folder in its):
        return
    os.environ["MPLCONFIGDIR"] = str((own_folder() or _passing()) / "matplotlib")
