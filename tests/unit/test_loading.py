"""Modules loaded by each entry point: of the heavy libraries only the necessary ones, in any process it starts."""

import math
import os
import subprocess
import sys
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

import pytest

from atlas import gl
from atlas.cli.app import atlas as command_line

CHECKOUT = Path(__file__).resolve().parents[2]
HEAVY: Mapping[str, str] = {
    "numpy": "numpy",
    "scipy": "scipy",
    "sympy": "sympy",
    "mpmath": "mpmath",
    "python-flint": "flint",
    "matplotlib": "matplotlib",
    "contourpy": "contourpy",
    "pyvista": "pyvista",
    "vtk": "vtkmodules",
    "jinja2": "jinja2",
    "typst": "typst",
    "pypandoc_binary": "pypandoc",
    "ziamath": "ziamath",
    "fonttools": "fontTools",
    "rich": "rich",
    "msgspec": "msgspec",
    "pylatexenc": "pylatexenc",
    "lmfit": "lmfit",
    "heyoka": "heyoka",
}
"""The libraries of pyproject.toml but the smallest, and the modules that show their use."""
WATCHED = (*HEAVY.values(), "multiprocessing", "matplotlib.pyplot", "pandas", "pint", "astropy", "IPython")

WATCH = f'''
import atexit, os, sys
log, told = os.open(os.environ["LOADED"], os.O_WRONLY | os.O_APPEND | os.O_CREAT), set()
class Watch:
    @staticmethod
    def find_spec(name="", path=None, target=None):
        """Find nothing, and write down what is there by now."""
        new = [name for name in {WATCHED} if name in sys.modules and name not in told]
        told.update(new)
        os.write(log, "".join(name + "\\n" for name in new).encode())
sys.meta_path.insert(0, Watch)
atexit.register(Watch.find_spec)
'''
"""Runs first in every Python process: a library imports modules of its own, so it is seen however the process ends."""


class Case(NamedTuple):
    """A command line, the heavy modules that it loads, no more and no less, its exit status, and if it takes long."""

    words: str
    loads: str
    status: int = 0
    slow: bool = False


MOTION = "--ratio 1.5 --field 1 2 --omega2 0.7"
GENERAL = "--ratio 1.5 --field 1 2 --omega 0.3 0.7 0.2"
BALL = "--larmor 0.5 --momentum 0.3 -0.7 --times 1"
PARTICLE = "--mu 1 --magnetic 0 0 1 --velocity 1 0 0 --times 1"
DRAWING = "matplotlib contourpy fontTools numpy flint multiprocessing"  # Matplotlib itself loads Pillow and fontTools
SHADING = "pyvista vtkmodules matplotlib.pyplot"  # PyVista itself loads the last

CASES = [
    Case("classify --ratio 1.5 --field 1 2", "flint rich"),
    Case("classify --ratio 1.5 --field 1 2 --json", "flint numpy", slow=True),
    Case("classify --ratio 1.5 --field 1 2 --json --digits 30", "flint", slow=True),
    Case("classify --shape ring --radius 1 --field 1 2", "flint rich numpy"),
    Case("hyperbola --ratio 1.5 --field 1 2", "flint rich numpy"),
    Case("hyperbola --ratio 1.5 --field 1 2 --omega2 1 2", "flint rich", slow=True),
    Case("hyperbola --ratio 1.5 --field 1 2 --json", "flint numpy", slow=True),
    Case("motion --inertia 0.8 1 1.3 --field 0.2 1 0.6 --omega 0.3 0.7 0.2 --json", "flint numpy", slow=True),
    Case("elliptic --inertia 0.8 1 1.3 --field 0.2 1 0.6 --z 1.7 --json", "flint numpy"),
    Case("top --inertia 1 0.5 --direction 0.6 0.8 --omega 0.1 0.2 5 --linear 3 --json", "flint numpy"),
    Case(f"motion {MOTION} --times 1", "flint rich"),
    Case(f"motion {MOTION} --grid 0 1 9 --json", "flint numpy"),
    Case(f"motion {GENERAL} --grid 0 1 9 --json", "flint numpy"),
    Case(f"ball {BALL} --json", "flint numpy"),
    Case(f"particle {PARTICLE} --json", "flint numpy"),
    Case("list", ""),
    Case("list --json", ""),
    Case(f"check true.csv {MOTION}", "flint msgspec numpy"),
    Case(
        f"check true.csv {MOTION} --json --figure error.svg",
        "flint msgspec matplotlib contourpy fontTools numpy",
        slow=True,
    ),
    Case(
        "fit turns.csv --sigma 0.01",
        "flint msgspec numpy scipy",
    ),
    Case("verify 71", "sympy mpmath flint rich pylatexenc multiprocessing numpy"),  # SymPy itself loads the next two
    Case(
        "sweep ball --set inertia=1,2 --set larmor=1 --set m2=1 --set m3=1 --quantity k2 -j1 --out t.csv", "flint numpy"
    ),
    Case("figure hyperbola --format svg", DRAWING),
    Case("plot turns.csv t w --out w.svg", "matplotlib fontTools numpy", slow=True),
    Case("figure flight --renderer shaded", f"{DRAWING} {SHADING}", slow=True),
    Case("figure trochoids --renderer shaded", DRAWING),
    Case("animate hyperbola --over ratio=0.5:1.5:2 --dpi 30", DRAWING.replace(" multiprocessing", ""), slow=True),
    Case("explore nosuchthing", "numpy flint", status=2),
    Case("report nosuchreport", "msgspec", status=2),
    Case("page --ratio 1.3 --field 1", "", status=2),
    Case("page --ratio 3 --field 1 2", "numpy flint msgspec", status=2),
    Case("tex prose.toml", "msgspec numpy flint multiprocessing jinja2"),
    Case("data prose.toml", "msgspec numpy flint pylatexenc multiprocessing"),
]

TURNS = "t,w,x,y,z\n" + "".join(f"{t},{math.cos(t / 2)},0,0,{math.sin(t / 2)}\n" for t in range(9))
"""A turn about the third axis."""
PROSE = """
name = "prose"
title = "A Report"
authors = ["A. Author"]
abstract = "None."
[[pages]]
slug = "index"
title = "The page"
[[pages.blocks]]
kind = "prose"
text = "The rotation matrix $R(t)$ and @(71)."
[[pages.blocks]]
kind = "equation"
name = "(71)"
"""
FIGURES = """
[[pages.blocks]]
kind = "figure"
recipe = "hyperbola"
parameters = { ratio = 1.5 }
[[pages.blocks]]
kind = "figure"
recipe = "flight"
renderer = "shaded"
"""
PAGES = "msgspec numpy flint jinja2 typst multiprocessing pylatexenc"
FONTS = "fontTools"


class Step(NamedTuple):
    """A change in a report that was built, and the heavy modules that its next build loads in any process."""

    what: str
    old: str
    new: str
    loads: str


STEPS = [
    Step("nothing: the first build", "", "", f"{PAGES} {FONTS} {DRAWING} {SHADING}"),
    Step("nothing", "", "", "msgspec"),
    Step("a comment", "[[pages]]", "# the only one\n[[pages]]", PAGES.replace("typst", "")),
    Step("a formula", "$R(t)$", "$R(t^2)$", PAGES),
    Step("a parameter of the figure in the plane", "1.5", "1.6", f"{PAGES} {FONTS} {DRAWING}"),
]


class Room:
    """A folder to run the command line in, and a log of the modules that its processes load."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.log = folder / "loaded"
        self.first = folder / "first"
        self.first.mkdir()
        (self.first / "sitecustomize.py").write_text(WATCH, encoding="utf-8")

    def run(self, words: str, status: int, cache: str = "cache") -> set[str]:
        """Run a command line and return the heavy modules that were loaded in any process."""
        self.log.write_text("", encoding="utf-8")
        path = os.pathsep.join([str(self.first), str(CHECKOUT)])
        result = subprocess.run(
            [sys.executable, "-m", "atlas", *words.split()],
            cwd=self.folder,
            env={**os.environ, "PYTHONPATH": path, "LOADED": str(self.log), "ATLAS_CACHE": str(self.folder / cache)},
            capture_output=True,
            text=True,
            check=False,
        )
        assert result.returncode == status, result.stderr
        return set(self.log.read_text(encoding="utf-8").split())


@pytest.fixture(scope="module")
def room(tmp_path_factory: pytest.TempPathFactory) -> Room:
    """Prepare the files that the command lines read: a trajectory and a report."""
    room = Room(tmp_path_factory.mktemp("room"))
    (room.folder / "true.csv").write_text("t,R11\n0,1\n", encoding="utf-8")
    (room.folder / "turns.csv").write_text(TURNS, encoding="utf-8")
    (room.folder / "prose.toml").write_text(PROSE, encoding="utf-8")
    return room


def test_every_library_is_watched() -> None:
    """Each library that the package depends on is small or counts as heavy."""
    project = tomllib.loads((CHECKOUT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    libraries = {line.split(">=")[0] for line in [*project["dependencies"], *project["optional-dependencies"]["bench"]]}
    assert libraries == {*HEAVY, "click", "platformdirs", "fsspec", "uncertainties"}


def test_every_command_has_a_case() -> None:
    """No command is left out."""
    assert {case.words.split()[0] for case in CASES} == set(command_line.commands)


@pytest.mark.parametrize(
    "case", [pytest.param(case, id=case.words, marks=[pytest.mark.slow] * case.slow) for case in CASES]
)
def test_a_command_loads_its_listed_modules_alone(room: Room, case: Case) -> None:
    """A real run loads exactly the heavy modules on its list: a number no drawing library, a 2-D figure no VTK."""
    if "shaded" in case.words and gl.library() is None:
        pytest.skip("no GL library can draw off-screen here")
    lists = set(case.loads.split())
    assert room.run(case.words, case.status) | ({"fontTools"} & lists) == lists  # Matplotlib before 3.11 does without


@pytest.mark.slow
def test_a_figure_from_the_store_loads_no_drawing_library(room: Room) -> None:
    """ReportRequest for again, also in another format that is there, a figure is taken as it is."""
    room.run("figure lssc --format svg pdf --out twice", 0)
    assert room.run("figure lssc --format svg --out twice", 0) == {"numpy", "flint", "multiprocessing"}


@pytest.mark.slow
def test_a_page_with_other_digits_loads_no_drawing_library(room: Room) -> None:
    """Its figures are there, so the process that workers are forks of is not started."""
    room.run("page --ratio 1.5 --field 1 2 --omega2 0.7", 0)
    assert room.run("page --ratio 1.5 --field 1 2 --omega2 0.7 --digits 12", 0) == set(PAGES.split())


@pytest.mark.slow
@pytest.mark.skipif(gl.library() is None, reason="no GL library can draw off-screen here")
def test_a_report_loads_only_modules_its_change_needs(room: Room) -> None:
    """A page rebuilt without changed figures loads no drawing library in any process, a 2-D figure no VTK or SymPy."""
    text = PROSE.replace('"prose"', '"mixed"', 1) + FIGURES
    for step in STEPS:
        assert step.old in text
        text = text.replace(step.old, step.new, 1)
        (room.folder / "mixed.toml").write_text(text, encoding="utf-8")
        assert room.run("report mixed.toml --jobs 2", 0, "cache of the report") == set(step.loads.split()), step.what


def loaded_by(statement: str) -> set[str]:
    """Return the modules that a statement adds to a fresh interpreter."""
    code = f"import sys\nbare = {{*sys.modules}}\n{statement}\nprint(*sorted({{*sys.modules}} - bare))"
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return set(result.stdout.splitlines()[-1].split())


def test_help_loads_no_heavy_library() -> None:
    """``--help`` of every command, one after the other in one process, is printed without any library but click."""
    lines = "from atlas.cli.app import atlas\n" + "\n".join(
        f"atlas.main(['{name}', '--help'], standalone_mode=False)" for name in command_line.commands
    )
    assert {name.split(".")[0] for name in loaded_by(lines)} & set(WATCHED) == set()


def test_help_loads_few_modules() -> None:
    """``atlas --help`` loads few modules of ours, the register and click, and little that these do not need."""
    modules = loaded_by(
        "from atlas.cli import main\n"
        "try:\n"
        "    main(['--help'])\n"
        "except SystemExit as end:\n"
        "    assert not end.code, end.code"
    )
    foreign_modules = {name for name in modules if name.split(".")[0] not in sys.stdlib_module_names}
    ours = {name for name in foreign_modules if name.split(".")[0] != "click"}
    families = {name for name in ours if name.rpartition(".")[2].startswith("family")}
    assert families
    assert ours - families <= {
        "atlas",
        "atlas.cli",
        "atlas.cli.app",
        "atlas.errors",
        "atlas.families",
        "atlas.families.parameters",
        "atlas.motions",
        *(f"atlas.motions.{name}" for name in ("elementary", "nutation", "particle", "register", "torus")),
        "atlas.surfaces",
        "atlas.viewers",
    }
    # click asks shutil how wide the terminal is
    modules_click = loaded_by("import click, dataclasses, difflib, shutil, textwrap")
    assert len(modules - foreign_modules - modules_click) <= 5


@pytest.mark.slow
@pytest.mark.parametrize(
    ("statement", "loads"),
    [
        ("import atlas", ""),
        ("import atlas.cli", ""),
        ("import atlas.trial.ledger", ""),
        ("import atlas.motions", ""),
        ("import atlas.pictures", ""),
        ("from atlas.pictures import recipes; recipes.load('quadric').scene()", "numpy flint"),
        ("from atlas.pictures import recipes; recipes.load('motion_sphere').scene()", "numpy flint"),
        ("import atlas; print(atlas.GeneralMotion(1.5, (1, 2), (0.3, 0.7, 0.2)))", "numpy flint"),
        ("from atlas import Quadric, Hyperbola, ElementaryMotion, BallMotion, ParticleMotion, Flight", "numpy flint"),
    ],
)
def test_an_import_loads_its_listed_modules_alone(statement: str, loads: str) -> None:
    """The package, the command line and the ledger load without NumPy; the kernels need it and flint."""
    assert {name.split(".")[0] for name in loaded_by(statement)} & set(WATCHED) == set(loads.split())
