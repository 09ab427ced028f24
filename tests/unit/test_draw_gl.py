"""Which GL library can draw, and what is said when none can."""

import json
import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from atlas.draw import gl


@pytest.fixture
def fresh(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Iterator[Path]:
    """No answer remembered, neither here nor in the user's folder, and no choice made."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.delenv(gl.CHOICE, raising=False)
    monkeypatch.delenv(gl.VARIABLE, raising=False)
    gl.library.cache_clear()
    yield tmp_path
    gl.library.cache_clear()


def test_the_first_that_draws_is_taken_and_remembered(fresh: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """EGL is asked before OSMesa; the next process reads the answer and asks nobody."""
    asked = []
    monkeypatch.setattr(gl, "_draws", lambda name: asked.append(name) or name == "osmesa")
    assert gl.library() == "osmesa"
    assert asked == ["egl", "osmesa"]
    (note,) = (fresh / "atlas").iterdir()
    assert json.loads(note.read_text(encoding="utf-8")) == {"library": "osmesa"}
    gl.library.cache_clear()
    assert gl.library() == "osmesa"
    assert asked == ["egl", "osmesa"]


def test_a_no_is_remembered_until_libraries_are_installed(fresh: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Nobody is asked again until what the answer depends on has changed; then what was installed is found."""
    drivers, asked = fresh / "dri", list[str]()
    monkeypatch.setattr(gl, "DRIVERS", (str(drivers),))
    monkeypatch.setattr(gl, "_draws", lambda name: asked.append(name) or drivers.exists())
    assert gl.library() is None
    gl.library.cache_clear()
    assert gl.library() is None
    assert asked == ["egl", "osmesa"]
    drivers.mkdir()
    gl.library.cache_clear()
    assert gl.library() == "egl"
    assert gl.prepare() == "egl"
    assert os.environ[gl.VARIABLE] == gl.WINDOWS["egl"]


def test_a_folder_whose_name_is_no_text_is_remembered_like_any(fresh: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A name in Latin-1 where all else is UTF-8, or any letter with accents in a plain locale."""
    monkeypatch.setattr(sys, "prefix", os.fsdecode(b"/tmp/\xe9"))
    monkeypatch.setattr(gl, "_draws", lambda name: name == "egl")
    assert gl.library() == "egl"
    assert len(list((fresh / "atlas").iterdir())) == 1


@pytest.mark.parametrize("text", ["", "{", "[]", '{"library": "glide"}', '{"library": null}'])
def test_a_damaged_note_is_asked_again(fresh: Path, monkeypatch: pytest.MonkeyPatch, text: str) -> None:
    """Half a note, or one that makes no sense, is as good as none."""
    monkeypatch.setattr(gl, "_draws", lambda name: name == "egl")
    gl.library()
    (note,) = (fresh / "atlas").iterdir()
    note.write_text(text, encoding="utf-8")
    gl.library.cache_clear()
    assert gl.library() == "egl"


def test_a_folder_that_cannot_be_written_does_no_harm(fresh: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The answer is then found again each time."""
    (fresh / "file").write_text("", encoding="utf-8")
    monkeypatch.setenv("XDG_CACHE_HOME", str(fresh / "file"))
    monkeypatch.setattr(sys, "prefix", str(fresh / "file"))
    monkeypatch.setattr(gl, "_draws", lambda name: name == "egl")
    assert gl.library() == "egl"


@pytest.mark.usefixtures("fresh")
def test_a_child_that_dies_means_no(monkeypatch: pytest.MonkeyPatch) -> None:
    """A crash of the trial is an answer, not a crash of ours."""
    monkeypatch.setattr(gl, "_PROBE", "import os; os.abort()")
    assert gl.library() is None


@pytest.mark.usefixtures("fresh")
def test_a_child_that_opens_another_window_means_no(monkeypatch: pytest.MonkeyPatch) -> None:
    """VTK may fall back to a window that needs a screen: what counts is the one asked for."""
    monkeypatch.setattr(gl, "_PROBE", "print('vtkXOpenGLRenderWindow')")
    assert gl.library() is None


def run(*words: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """Run the command as at set-up."""
    return subprocess.run(
        [sys.executable, "-m", "atlas.draw.gl", *words],
        env=dict(os.environ, **environment),
        capture_output=True,
        text=True,
        check=False,
    )


def test_without_gl_one_line_says_what_is_left_out_and_what_brings_it() -> None:
    """The command ends well, and set-up is quiet: the first report says it. 'none' is the user's choice: no install."""
    quiet, done = run("--install", **{gl.CHOICE: "none"}), run(**{gl.CHOICE: "none"})
    assert (quiet.returncode, quiet.stdout, quiet.stderr) == (0, "", "")
    assert done.returncode == 0
    assert done.stderr == ""
    assert len(done.stdout.splitlines()) == 1
    assert "drawn by the vector renderer" in done.stdout
    assert "libegl1 libgl1-mesa-dri" in done.stdout


@pytest.mark.parametrize("module", ["atlas.draw.gl", "atlas"])
def test_a_choice_that_is_no_library_is_told(module: str, tmp_path: Path) -> None:
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


def test_with_gl_nothing_is_said_at_set_up() -> None:
    """Set-up is quiet where there is nothing to tell."""
    done = run("--install", **{gl.CHOICE: "egl"})
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


@pytest.mark.usefixtures("fresh")
def test_without_vtk_the_line_names_what_is_missing(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """No VTK, no trial: the command is pip's."""
    monkeypatch.setattr(gl, "_vtk", lambda: None)
    assert gl.main([]) == 0
    (line,) = capsys.readouterr().out.splitlines()
    assert "pip install pyvista vtk" in line


def installing(
    monkeypatch: pytest.MonkeyPatch, answers: Callable[[list[Any]], bool], complaint: str = ""
) -> list[list[str]]:
    """Pretend to be root on Debian; what apt-get is told is returned; it fails if it has a complaint."""
    told = []

    def apt(command: list[str], **_options: Any) -> subprocess.CompletedProcess[str]:
        told.append(command[1:])
        return subprocess.CompletedProcess(command, 100 if complaint else 0, "", complaint)

    monkeypatch.setattr(gl, "_may_install", lambda: True)
    monkeypatch.setattr(gl, "_draws", lambda _name: answers(told))
    monkeypatch.setattr(gl.subprocess, "run", apt)
    return told


@pytest.mark.usefixtures("fresh")
def test_as_root_on_debian_what_is_missing_is_installed(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """After that it draws, and one line says so."""
    told = installing(monkeypatch, answers=lambda told: len(told) == 2)
    assert gl.main(["--install"]) == 0
    assert told[1][-2:] == ["libegl1", "libgl1-mesa-dri"]
    (line,) = capsys.readouterr().out.splitlines()
    assert line.startswith("installed libegl1 libgl1-mesa-dri")


@pytest.mark.usefixtures("fresh")
def test_an_installation_that_does_not_help_is_no_failure(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Nothing is said to be installed; the first report says what it lacks."""
    installing(monkeypatch, answers=lambda _told: False)
    assert gl.main(["--install"]) == 0
    assert capsys.readouterr().out == ""
    assert gl.library() is None


@pytest.mark.usefixtures("fresh")
def test_why_apt_get_failed_is_told(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    """One line with its last word; the set-up goes on without GL."""
    installing(monkeypatch, answers=lambda _told: False, complaint="W: a warning\nE: no network today\n")
    assert gl.main(["--install"]) == 0
    told = "atlas: apt-get could not install libegl1 libgl1-mesa-dri: E: no network today\n"
    assert capsys.readouterr().err == told
