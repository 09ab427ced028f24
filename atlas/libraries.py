"""The libraries that the program runs on, by the names under which they are installed, and their versions.

The one list of them: versions are part of what a figure or a report depends on, and reports and records print them.
"""

from functools import cache
from importlib import import_module
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
    """Return an imported module of the optional libraries of sweeps, such as "pandas".

    Raises AtlasError, which says that `feature` ("A data frame") needs the library and how to install it, where it is
    missing.
    """
    try:
        return import_module(module)
    except ImportError as error:
        library = module.partition(".")[0]
        remedy = "pip install 'atlas-charged-body[sweep]', or make sweep in a checkout"
        raise AtlasError(f"{feature} needs {library}: {remedy}.") from error
