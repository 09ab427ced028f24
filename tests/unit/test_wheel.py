"""A wheel, used in a folder where there is nothing of the checkout, and much that could be mistaken for a library."""

import os
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from zipfile import ZipFile

import pytest

ROOT = Path(__file__).resolve().parents[2]
Run = Callable[..., subprocess.CompletedProcess[str]]
GUIDE = (ROOT / "reports" / "guide.md").read_text(encoding="utf-8")
RECIPE = re.search(r"^```python\n# (my_precession\.py)\n(.*?)^```$", GUIDE, re.MULTILINE | re.DOTALL)
COMMAND = re.search(r"^\$ (atlas figure \./my_precession\.py .*)\n((?:build/.*\n)+)", GUIDE, re.MULTILINE)
REPORT = """
name = "mine"
title = "Mine"
[[pages]]
slug = "index"
title = "T"
blocks = [
  { kind = "figure", recipe = "my_precession.py", parameters = { ratio = 0.5 } },
]
"""


@pytest.fixture(scope="module")
def program(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Build the wheel, unpack it and write the program that an installer makes of its entry point."""
    place = tmp_path_factory.mktemp("wheel")
    build = [sys.executable, "-P", "-m", "hatchling", "build", "-t", "wheel", "-d", str(place)]
    subprocess.run(build, cwd=ROOT, check=True, capture_output=True)
    (wheel,) = place.glob("*.whl")
    with ZipFile(wheel) as archive:
        archive.extractall(place / "site")
    script = place / "bin" / "atlas"
    script.parent.mkdir()
    script.write_text("from atlas.cli import main\nmain()\n", encoding="utf-8")
    return script


@pytest.fixture
def run(program: Path, tmp_path: Path) -> Run:
    """Return a function that runs the wheel's program in an empty folder."""
    environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
    environment |= {"PYTHONPATH": str(program.parents[1] / "site"), "ATLAS_CACHE": str(tmp_path.parent / "cache")}

    def run(*words: str) -> subprocess.CompletedProcess[str]:
        command = [sys.executable, str(program), *words]
        return subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)

    return run


def message_of(done: subprocess.CompletedProcess[str]) -> list[str]:
    """Return standard error without the progress that a busy machine tells: 1 of 2 (50 %) after."""
    return [line for line in done.stderr.splitlines() if not re.search(r": \d+ of \d+ \(\d+ %\) after \d", line)]


def test_the_types_are_in_the_wheel(program: Path) -> None:
    """A type checker reads them only of a package that says so."""
    place = program.parents[1] / "site" / "atlas"
    assert (place / "py.typed").exists()
    assert (place / "__init__.pyi").exists()


@pytest.mark.slow
def test_modules_of_the_user_are_not_loaded(run: Run, tmp_path: Path) -> None:
    """A folder may hold a signal.py and a struct.py: neither the workers nor the probe for GL load them."""
    for name in ("signal", "struct", "multiprocessing", "numpy", "vtkmodules"):
        (tmp_path / f"{name}.py").write_text("raise SystemExit('a module of the user ran')\n", encoding="utf-8")
    done = run("figure", "magn", "trochoids", "--format", "svg", "--jobs", "2")
    assert (done.returncode, message_of(done)) == (0, [])
    assert done.stdout.split() == ["build/figures/magn.svg", "build/figures/trochoids.svg"]


@pytest.mark.slow
def test_the_guides_own_recipe_works_anywhere(run: Run, tmp_path: Path) -> None:
    """The guide's words, one for one, in an empty folder, and every other format too."""
    assert RECIPE
    assert COMMAND
    (tmp_path / RECIPE[1]).write_text(RECIPE[2], encoding="utf-8")
    done = run(*COMMAND[1].split()[1:])
    assert (done.returncode, done.stdout, message_of(done)) == (0, COMMAND[2], [])
    done = run("figure", f"./{RECIPE[1]}", "ball", "--format", "svg", "pdf", "png", "pgf", "csv", "--out", "out")
    assert (done.returncode, message_of(done)) == (0, [])
    kinds = {"csv", "pdf", "pgf", "png", "svg"}
    assert {path.suffix[1:] for path in (tmp_path / "out").glob("my_precession.*")} == kinds
    assert sorted(path.name for path in tmp_path.iterdir()) == ["build", "my_precession.py", "out"]
    assert "field=1,2" in run("figure", RECIPE[1], "--help").stdout
    assert run("figure", RECIPE[1], "--set", "ratoi=1").stderr.startswith("atlas: there is no parameter 'ratoi'")
    (tmp_path / "ball.py").write_text(RECIPE[2], encoding="utf-8")
    assert run("figure", "ball", "./ball.py").returncode == 2


@pytest.mark.slow
def test_a_report_names_a_recipe_beside_its_file(run: Run, tmp_path: Path) -> None:
    """From another folder, too; the page tells the command, and a changed recipe is drawn again."""
    assert RECIPE
    folder = tmp_path / "paper"
    folder.mkdir()
    (folder / "my_precession.py").write_text(RECIPE[2], encoding="utf-8")
    (folder / "mine.toml").write_text(REPORT, encoding="utf-8")
    page = tmp_path / "build" / "report" / "mine" / "index.html"
    for caption in ("Frequencies of precession", "Frequencies of nutation"):
        (folder / "my_precession.py").write_text(RECIPE[2].replace("Frequencies of precession", caption))
        done = run("report", "paper/mine.toml", "--format", "html")
        assert (done.returncode, message_of(done)) == (0, [])
        assert caption in page.read_text(encoding="utf-8")
    assert "atlas figure my_precession.py --set ratio=0.5" in page.read_text(encoding="utf-8")
    assert str(tmp_path) not in page.read_text(encoding="utf-8")
    assert sorted(path.name for path in folder.iterdir()) == ["mine.toml", "my_precession.py"]


@pytest.mark.parametrize(
    "recipe",
    [
        "../paper/my_precession.py",
        pytest.param("none.py", marks=pytest.mark.slow),
        pytest.param("/my_precession.py", marks=pytest.mark.slow),
    ],
)
def test_a_recipe_that_is_not_beside_the_report_is_refused(run: Run, tmp_path: Path, recipe: str) -> None:
    """One line says where it would have to be."""
    (tmp_path / "my_precession.py").write_text('"""Mine."""\n', encoding="utf-8")
    (tmp_path / "mine.toml").write_text(REPORT.replace("my_precession.py", recipe), encoding="utf-8")
    done = run("report", "mine.toml")
    assert done.returncode == 2
    assert re.fullmatch(rf"atlas: .*recipe = '{re.escape(recipe)}' is no file beside the report; .*\n", done.stderr)
