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
    """Return the installed version of a library, named as pip does; None where it is not installed."""
    try:
        return version(library)
    except PackageNotFoundError:
        return None


def package_file(package: str, pattern: str) -> Path | None:
    """Return the first file of an installed package that matches the glob `pattern`, None if there is none.

    The package is not imported, which would take longer.
    """
    spec = find_spec(package)
    folders = (spec.submodule_search_locations or ()) if spec else ()
    return next((file for folder in folders for file in Path(folder).glob(pattern)), None)


def versions() -> dict[str, str]:
    """Return versions by name of the LIBRARIES that are installed."""
    return {name: version for name in LIBRARIES if (version := release(name)) is not None}


def of_sweeps(module: str, feature: str) -> ModuleType:
    """Return an imported module of the optional libraries of sweeps, such as "pandas"; a checkout installs them first.

    Raises AtlasError, which says that `feature` ("A data frame") needs the library, where it is missing and was not
    installed.
    """
    try:
        return import_module(module)
    except ImportError as error:
        library = module.partition(".")[0]
        if release(library) is None and _brought(f"{feature} needs {library}"):
            return import_module(module)
        raise AtlasError(f"{feature} needs {library}: pip install 'atlas-charged-body[sweep]'.") from error


def _brought(why: str) -> bool:
    """Install the libraries of sweeps by `make` in the environment of a checkout; return whether that succeeded.

    `why` is the sentence shown before; at a terminal the user is asked first. False in any other environment, or if
    the user declines.
    """
    import subprocess

    checkout = Path(__file__).resolve().parent.parent
    if Path(sys.prefix).resolve() != checkout / ".venv" or not (checkout / ".venv" / ".ready").exists():
        return False
    count = (checkout / "requirements-sweep.lock").read_text(encoding="utf-8").count("==")
    message = f"{why}: {count} libraries of requirements-sweep.lock go into {checkout / '.venv'}"
    if sys.stdin is not None and sys.stdin.isatty() and sys.stderr.isatty():
        import click

        if not click.confirm(f"{message}. Install them now?", default=True, err=True):
            return False
    else:
        print(f"{message}.", file=sys.stderr)  # noqa: T201
    done = subprocess.run(["make", "-s", "-C", checkout, ".venv/.sweep"], stdout=sys.stderr, check=False)  # noqa: S603, S607
    invalidate_caches()
    release.cache_clear()
    return done.returncode == 0
