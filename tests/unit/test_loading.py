"""What each door of the package pulls in."""

import subprocess
import sys

import pytest

DRAWING = {"matplotlib", "pyvista", "vtkmodules", "vtk", "typst", "pypandoc", "fontTools", "jinja2"}
HEAVY = DRAWING | {"sympy", "scipy", "mpmath", "heyoka"}


def loaded_by(statement: str) -> set[str]:
    """Return the top-level modules that a fresh interpreter has after the statement."""
    code = f"import sys\n{statement}\nprint(*sorted({{name.split('.')[0] for name in sys.modules}}))"
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return set(result.stdout.splitlines()[-1].split())


@pytest.mark.parametrize(
    "statement",
    [
        "import atlas",
        "import atlas.core",
        "import atlas.paper",
        "import atlas.cli",
        "import atlas.scene",
        "from atlas import Quadric, Hyperbola, ElementaryMotion, BallMotion, ParticleMotion, Flight, Field",
    ],
)
def test_numbers_load_no_heavy_module(statement: str) -> None:
    """Loading the package, its kernels or its command line pulls in neither drawing libraries nor SymPy nor SciPy."""
    assert not loaded_by(statement) & HEAVY


@pytest.mark.parametrize("statement", ["import atlas", "import atlas.cli", "import atlas.paper"])
def test_the_door_itself_does_not_load_numpy(statement: str) -> None:
    """The package, the command line and the ledger load without NumPy."""
    assert "numpy" not in loaded_by(statement)


@pytest.mark.parametrize("command", ["", "classify", "motion", "ball", "particle", "figure", "report", "verify"])
def test_help_loads_no_numpy(command: str) -> None:
    """``--help`` of any command is printed without NumPy."""
    statement = (
        "from atlas.cli import main\n"
        "try:\n"
        f"    main([*{command.split()!r}, '--help'])\n"
        "except SystemExit as end:\n"
        "    assert end.code in (0, None), end.code"
    )
    assert not loaded_by(statement) & (HEAVY | {"numpy", "rich", "flint"})
