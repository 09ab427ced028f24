"""The GL library that draws, and the message when none can."""

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from atlas import gl


@pytest.fixture
def fresh(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Iterator[Path]:
    """No answer remembered, neither here nor in the user's folder, and no choice made."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.delenv(gl.CHOICE, raising=False)
    monkeypatch.delenv(gl.VARIABLE, raising=False)
    gl.library.cache_clear()
    yield tmp_path
    gl.library.cache_clear()


def test_the_first_library_that_draws_is_cached(fresh: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """EGL is asked before OSMesa; the next process reads the answer and asks nobody."""
    drivers_tried = []
    monkeypatch.setattr(gl, "_draws", lambda name: drivers_tried.append(name) or name == "osmesa")
    assert gl.library() == "osmesa"
    assert drivers_tried == ["egl", "osmesa"]
    (note,) = (fresh / "atlas").iterdir()
    assert json.loads(note.read_text(encoding="utf-8")) == {note.stem: "osmesa"}
    gl.library.cache_clear()
    assert gl.library() == "osmesa"
    assert drivers_tried == ["egl", "osmesa"]
    note.write_text(json.dumps({"gl-elsewhere": "egl"}), encoding="utf-8")  # the answer of another machine
    gl.library.cache_clear()
    assert gl.library() == "osmesa"
    assert len(drivers_tried) == 4


def test_a_search_without_result_is_remembered_until_libraries_are_installed(
    fresh: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nobody is asked again until a dependency of the answer has changed; then installed libraries are found."""
    drivers, drivers_tried = fresh / "dri", list[str]()
    monkeypatch.setattr(gl, "DRIVERS", (str(drivers),))
    monkeypatch.setattr(gl, "_draws", lambda name: drivers_tried.append(name) or drivers.exists())
    assert gl.library() is None
    gl.library.cache_clear()
    assert gl.library() is None
    assert drivers_tried == ["egl", "osmesa"]
    drivers.mkdir()
    gl.library.cache_clear()
    assert gl.library() == "egl"
    assert gl.prepare() == "egl"
    assert os.environ[gl.VARIABLE] == gl.WINDOWS["egl"]


def test_a_folder_that_cannot_be_written_does_no_harm(fresh: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The answer is then found again each time."""
    (fresh / "file").write_text("", encoding="utf-8")
    monkeypatch.setenv("XDG_CACHE_HOME", str(fresh / "file"))
    monkeypatch.setattr(sys, "prefix", str(fresh / "file"))
    monkeypatch.setattr(gl, "_draws", lambda name: name == "egl")
    assert gl.library() == "egl"


@pytest.mark.usefixtures("fresh")
def test_a_crashing_probe_means_no_library(monkeypatch: pytest.MonkeyPatch) -> None:
    """A crash of the trial is an answer, not a crash of ours."""
    monkeypatch.setattr(gl, "_PROBE", "import os; os.abort()")
    assert gl.library() is None


def test_without_gl_one_line_names_the_omission_and_the_remedy() -> None:
    """The command ends well: the first report says it, too."""
    done = subprocess.run(
        [sys.executable, "-m", "atlas.gl"],
        env=dict(os.environ, **{gl.CHOICE: "none"}),
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stderr, len(done.stdout.splitlines())) == (0, "", 1)
    assert "drawn by the vector renderer" in done.stdout
    assert "libegl1 libgl1-mesa-dri" in done.stdout


@pytest.mark.parametrize("module", ["atlas.gl", "atlas"])
def test_an_unknown_gl_library_is_refused(module: str, tmp_path: Path) -> None:
    """A misspelt ATLAS_GL is one sentence that names the known values, and exit status 2; nothing is drawn."""
    words = ["figure", "ball", "--renderer", "shaded", "--out", str(tmp_path)] if module == "atlas" else []
    done = subprocess.run(
        [sys.executable, "-m", module, *words],
        env=dict(os.environ, **{gl.CHOICE: "bogus"}),
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == "atlas: ATLAS_GL=bogus names no GL library; known: egl, osmesa, native, none\n"
    assert list(tmp_path.iterdir()) == []


@pytest.mark.usefixtures("fresh")
def test_without_vtk_the_line_names_the_missing_package(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """No VTK, no trial: the command is pip's."""
    monkeypatch.setattr(gl, "_vtk", lambda: None)
    assert gl.main() == 0
    (line,) = capsys.readouterr().out.splitlines()
    assert "pip install pyvista vtk" in line


@pytest.mark.parametrize(
    ("answer", "apt", "says"),
    [
        ("no GL library: sudo apt-get install", "true", "installed libegl1 libgl1-mesa-dri for the shaded figures\n"),
        (
            "no GL library: sudo apt-get install",
            "echo 'E: no network today'; false",
            "atlas: apt-get could not install libegl1 libgl1-mesa-dri:\nE: no network today\n",
        ),
        ("egl", "echo never asked; false", ""),
    ],
)
def test_set_up_installs_missing_libraries_where_permitted(tmp_path: Path, answer: str, apt: str, says: str) -> None:
    """As root on Debian `make setup` brings the libraries and says so; where it can't it says why, and goes on."""
    for name, text in {"python": f"echo '{answer}'", "id": "echo 0", "apt-get": apt}.items():
        (tmp_path / name).write_text(f"#!/bin/sh\n{text}\n", encoding="utf-8")
        (tmp_path / name).chmod(0o755)
    variables = {
        name: value for name, value in os.environ.items() if not name.startswith(("MAKE", "MFLAGS", gl.CHOICE))
    }
    done = subprocess.run(
        ["make", "-s", "gl", f"BIN={tmp_path}"],  # noqa: S607  whichever make there is
        cwd=Path(__file__).parents[2],
        env=variables | {"PATH": f"{tmp_path}{os.pathsep}{os.environ['PATH']}"},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stdout) == (0, says)
