"""The libraries that the program runs on, by the names under which they are installed, and their versions.

The one list of them: versions are part of what a figure or a report depends on, and reports and records print them.
"""

import sys
from functools import cache
from importlib import import_module, invalidate_caches
from importlib.metadata import PackageNotFoundError, version
from importlib.util import find_spec
from pathlib import Path
from types import ModuleType

from atlas.errors import AtlasError

LIBRARIES = (
    "numpy",
    "scipy",
    "python-flint",
    "mpmath",
    "sympy",
    "matplotlib",
    "contourpy",
    "pyvista",
    "vtk",
    "jinja2",
    "typst",
    "pypandoc_binary",
    "ziamath",
    "fonttools",
    "click",
    "rich",
    "msgspec",
    "pylatexenc",
    "lmfit",
)
"""The dependencies in pyproject.toml; a test compares the two."""


@cache
def release(library: str) -> str | None:
    """Return the version of a library, None where it is not installed."""
    try:
        return version(library)
    except PackageNotFoundError:
        return None


def carried(package: str, pattern: str) -> Path | None:
    """Return a file that a package carries, None without it; the package itself, which takes longer, is not loaded."""
    spec = find_spec(package)
    folders = (spec.submodule_search_locations or ()) if spec else ()
    return next((file for folder in folders for file in Path(folder).glob(pattern)), None)


def versions() -> dict[str, str]:
    """Return the versions of those libraries that are installed."""
    return {name: version for name in LIBRARIES if (version := release(name)) is not None}


def of_sweeps(module: str, what: str) -> ModuleType:
    """Return a module of the libraries that sweeps need beside; the environment of a checkout gets them first.

    Raises AtlasError, which says that `what` needs it, where it is not there and can't be had.
    """
    try:
        return import_module(module)
    except ImportError as error:
        library = module.partition(".")[0]
        if release(library) is None and _brought(f"{what} needs {library}"):
            return import_module(module)
        raise AtlasError(f"{what} needs {library}: pip install 'atlas-charged-body[sweep]'.") from error


def _brought(why: str) -> bool:
    """Let `make` bring the libraries of sweeps into the environment that it made, if this is the one.

    It is said why and where to, and at a terminal it is asked first.
    """
    import subprocess

    checkout = Path(__file__).resolve().parent.parent
    if Path(sys.prefix).resolve() != checkout / ".venv" or not (checkout / ".venv" / ".ready").exists():
        return False
    count = (checkout / "requirements-sweep.lock").read_text(encoding="utf-8").count("==")
    said = f"{why}: {count} libraries of requirements-sweep.lock go into {checkout / '.venv'}"
    if sys.stdin is not None and sys.stdin.isatty() and sys.stderr.isatty():
        import click

        if not click.confirm(f"{said}. Install them now?", default=True, err=True):
            return False
    else:
        print(f"{said}.", file=sys.stderr)  # noqa: T201
    done = subprocess.run(["make", "-s", "-C", checkout, ".venv/.sweep"], stdout=sys.stderr, check=False)  # noqa: S603, S607
    invalidate_caches()
    release.cache_clear()
    return done.returncode == 0
