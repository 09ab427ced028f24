"""The libraries that the program runs on, by the names under which they are installed, and their versions.

The one list of them: versions are part of what a figure or a report depends on, and reports and records print them.
"""

from functools import cache
from importlib.metadata import PackageNotFoundError, version

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
)
"""The dependencies in pyproject.toml; a test compares the two."""


@cache
def release(library: str) -> str | None:
    """Return the version of a library, None where it is not installed."""
    try:
        return version(library)
    except PackageNotFoundError:
        return None


def versions() -> dict[str, str]:
    """Return the versions of those libraries that are installed."""
    return {name: found for name in LIBRARIES if (found := release(name)) is not None}
