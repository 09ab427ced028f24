"""Files written whole or not at all, and the one list of libraries."""

import os
import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from tests_support import names

from atlas import files
from atlas.book.building import publish
from atlas.libraries import LIBRARIES, release, versions

ROOT = Path(__file__).resolve().parents[2]


def test_files_are_written_whole_and_alone(tmp_path: Path) -> None:
    """Text is written as UTF-8, bytes as they are, in folders that are made, and nothing else is left."""
    files.write(tmp_path / "a" / "b.txt", "é")
    assert (tmp_path / "a" / "b.txt").read_bytes() == "é".encode()
    files.write(tmp_path / "a" / "b.txt", b"\xff")
    assert (tmp_path / "a" / "b.txt").read_bytes() == b"\xff"
    assert [path.name for path in (tmp_path / "a").iterdir()] == ["b.txt"]


def test_a_write_that_fails_leaves_the_old_file(tmp_path: Path) -> None:
    """When an error stops the writing, the old file stands and no other is left beside it."""
    path = tmp_path / "b.txt"
    path.write_text("old")
    with pytest.raises(ZeroDivisionError), files.replacing(path) as unfinished:
        unfinished.write_text(str(unfinished.write_text("half") / 0))
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_an_error_names_the_file_that_was_meant(tmp_path: Path) -> None:
    """A folder in the place of the file, or of a folder above it a file, is told by the name that was given."""
    (tmp_path / "folder").mkdir()
    with pytest.raises(OSError, match="folder") as caught:
        files.write(tmp_path / "folder", "text")
    assert caught.value.filename == str(tmp_path / "folder")
    (tmp_path / "file").write_text("")
    with pytest.raises(OSError, match="file"):
        files.write(tmp_path / "file" / "b.txt", "text")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["file", "folder"]


def test_a_full_disk_names_the_file_that_was_meant(tmp_path: Path) -> None:
    """The name of the unfinished file stands in no message."""
    program = (
        "import resource, signal, sys; from pathlib import Path; from atlas import files\n"
        "signal.signal(signal.SIGXFSZ, signal.SIG_IGN); resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))\n"
        "try: files.write(Path(sys.argv[1]), 'x' * 1000)\n"
        "except OSError as error: print(error.filename)"
    )
    path = tmp_path / "b.txt"
    output = subprocess.check_output([sys.executable, "-c", program, str(path)], text=True)
    assert output.strip() == str(path)
    assert not list(tmp_path.iterdir())


def test_a_process_that_has_ended_does_not_run() -> None:
    """One is alive until it has ended, and not while it waits for a parent that does not ask."""
    with subprocess.Popen(
        [sys.executable, "-c", "input()"], stdin=subprocess.PIPE, stderr=subprocess.DEVNULL
    ) as process:
        assert files.alive(process.pid)
        process.kill()
        os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOWAIT)
        assert not files.alive(process.pid)
    assert not files.alive(process.pid)


SWEEP = "sweep quadric --set ratio=0.5:2:99 --set B2=1 --set B3=2 --quantity beta -j 1 --out t.csv"


@pytest.mark.slow
@pytest.mark.parametrize(("words", "name"), [(SWEEP, "t.csv.parts"), ("report mine.toml --out out", "cache")])
def test_a_full_disk_is_reported_with_the_file(tmp_path: Path, words: str, name: str) -> None:
    """One line, which says where there is no room: beside the output or in the cache."""
    (tmp_path / "mine.toml").write_text(
        'name = "mine"\ntitle = "T"\n[[pages]]\nslug = "index"\ntitle = "T"\n'
        '[[pages.blocks]]\nkind = "prose"\ntext = "A text."\n',
        encoding="utf-8",
    )
    program = (
        "import resource, sys; from atlas.cli import main\n"
        "resource.setrlimit(resource.RLIMIT_FSIZE, (300, 300)); main(sys.argv[1:])"
    )
    done = subprocess.run(
        [sys.executable, "-c", program, *words.split()],
        cwd=tmp_path,
        env=os.environ | {"ATLAS_CACHE": str(tmp_path / "cache"), "PYTHONDONTWRITEBYTECODE": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stdout, done.stderr.count("\n")) == (1, "", 1), done.stderr
    assert re.search(rf"File too large: .*{name}", done.stderr), done.stderr


def test_the_libraries_agree_with_the_project() -> None:
    """The list holds the dependencies in pyproject.toml that results depend on, in versions of the ranges there."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    ranges = {requirement.name: requirement.specifier for requirement in map(Requirement, project["dependencies"])}
    assert {*LIBRARIES} == {*ranges} - {"platformdirs", "fsspec", "uncertainties"}
    assert versions().keys() == {*LIBRARIES}
    assert all(ranges[name].contains(version) for name, version in versions().items())
    assert release("no-such-library") is None


def test_the_locks_have_every_dependency_in_its_range() -> None:
    """Libraries of sweeps, tests and the benchmark stand apart; no range is a single version, which few could share."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    extras = project["optional-dependencies"]
    for name in ("", "-sweep", "-test", "-bench"):
        lines = (ROOT / f"requirements{name}.lock").read_text(encoding="utf-8").splitlines()
        locked = dict(line.split(" ")[0].split("==") for line in lines if "==" in line.split(" ")[0])
        for requirement in map(Requirement, extras[name[1:]] if name else project["dependencies"]):
            assert requirement.specifier.contains(locked[requirement.name.replace("_", "-")]), requirement
            assert all(clause.operator == ">=" for clause in requirement.specifier), requirement
        assert name == "-test" or "mypy" not in locked


def test_git_sees_requested_files_and_no_internal_records(tmp_path: Path) -> None:
    """In a repository of the user's and a worktree of it, beside a .gitignore of their own; nothing else is made."""
    theirs, tree, plain = (tmp_path / name for name in ("theirs", "tree", "plain"))
    git = [str(shutil.which("git")), "-c", "user.name=A", "-c", "user.email=a@b", "-C"]

    def said(folder: Path, *words: str) -> str:
        return subprocess.run([*git, folder, *words], check=True, capture_output=True, text=True).stdout

    (theirs / "own").mkdir(parents=True)
    said(theirs, "init", "-q")
    (theirs / "own" / ".gitignore").write_text("*.log\n")
    said(theirs, "add", ".")
    said(theirs, "commit", "-qm", "first")
    said(theirs, "worktree", "add", "-q", str(tree))
    for _ in range(2):
        for top in (theirs, tree):
            for folder in (top, top / "made", top / "own", plain):
                with files.keeping(folder / "t.csv") as unfinished:
                    unfinished.write_text("1")
                files.write(folder / "t.costs.json", "{}")
            publish.replace(top / "pages", {"index.html": b"page", "s/a.css": b""})
            names_listed = {line.split()[1] for line in said(top, "status", "--short", "-uall").splitlines()}
            assert names_listed == {"t.csv", "own/t.csv", "made/t.csv", "pages/index.html", "pages/s/a.css"}
    assert names(plain) == ["t.costs.json", "t.csv"]
    assert (theirs / "own" / ".gitignore").read_text() == "*.log\n"
