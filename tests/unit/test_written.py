"""Files of commands stand whole in their place, or not at all; a failure is one line."""

import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests_support import names

import atlas
from atlas import files
from atlas.book.building.publish import replace
from atlas.cli import main

REPORT = """
name = "small"
title = "A Small Report"
[parameters]
bodies.shell = { title = "shell", ratio = 1.5 }
fields.oblique = { title = "oblique field", prime = [1.0, 2.0] }
[[pages]]
slug = "index"
title = "The page"
blocks = [
  { kind = "table", table = "points", body = "shell", field = "oblique", parameters = { omega2 = [0.7] } },
]
"""
WRITERS = {
    "page --ratio 1.3 --field 1 2 --omega2 0.7": "your_body-9c28476c.md",
    "tex small.toml": "small",
    "data small.toml": "small",
    "animate trochoids --over turns=1:3:2 --dpi 20": "trochoids.gif",
    "figure trochoids --for aps --format svg": "trochoids-aps.svg",
}
"""Commands, each with the first thing that it puts into its folder."""

LONG = ("page", "tex", "fit")
"""Those that take seconds."""


def marked(words: str, *words_more: str) -> Any:
    """Return a command as a case, slow where it takes long."""
    return pytest.param(
        words, *words_more, id=words.split(maxsplit=1)[0], marks=[pytest.mark.slow] * words.startswith(LONG)
    )


def run(folder: Path, words: str, program: str = "", **variables: str) -> subprocess.CompletedProcess[str]:
    """Run a command in a folder that has the report, in a process of its own."""
    (folder / "small.toml").write_text(REPORT, encoding="utf-8")
    surroundings = os.environ | {"ATLAS_CACHE": str(folder / "cache"), "PYTHONDONTWRITEBYTECODE": "1"} | variables
    command = [sys.executable, "-c", f"{program}\nimport sys; from atlas.cli import main; main(sys.argv[1:])"]
    return subprocess.run(
        [*command, *words.split(), "--out", "out"],
        cwd=folder, env=surroundings, capture_output=True, text=True, check=False,
    )  # fmt: skip


def one_line(done: subprocess.CompletedProcess[str], status: int, *words: str) -> None:
    """Check an answer against the law of every refusal; on a busy machine a line may tell its progress before."""
    lines = [line for line in done.stderr.splitlines() if not re.search(r" after \d+ s$", line)]
    assert (done.returncode, done.stdout, len(lines)) == (status, "", 1), done.stderr
    assert all(word in done.stderr for word in words), done.stderr


@pytest.mark.slow
@pytest.mark.parametrize(("words", "name"), [marked(*case) for case in WRITERS.items()])
def test_existing_files_are_kept(tmp_path: Path, words: str, name: str) -> None:
    """A link to nothing, a folder in the place of a file, a disk without room: one line that names the place."""
    (tmp_path / "out").symlink_to("nowhere")
    one_line(run(tmp_path, words), 2, "'out' is a link to nothing")
    (tmp_path / "out").unlink()
    (tmp_path / "out" / name).mkdir(parents=True)
    (tmp_path / "out" / name / "own.txt").write_text("mine")
    done = run(tmp_path, words)
    if name == "small":
        assert done.returncode == 0, done.stderr
    else:
        one_line(done, 2, f"out/{name}")
    assert names(tmp_path / "out") == [name]
    assert (tmp_path / "out" / name / "own.txt").read_text() == "mine"


LONE = {
    "figure trochoids --format csv --set speeds={}": "out/trochoids.csv",
    "animate trochoids --over turns=1:{}:2 --dpi 20": "out/trochoids.gif",
    "sweep ball --set inertia=1 larmor={} m2=1 m3=1 --quantity gamma --out out/t.csv": "out/t.csv",
    "check run2.csv --threshold {} --figure out/c.svg": "out/c.svg",
    "fit run{}.csv --family elementary --figure out/f.svg": "out/f.svg",
}
"""Commands that write one file, with a number that changes it."""


@pytest.mark.slow
@pytest.mark.parametrize(("words", "name"), LONE.items(), ids=[words.split()[0] for words in LONE])
def test_an_edited_or_user_file_is_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, words: str, name: str) -> None:
    """A command replaces its own files; files of others stay, the new one is beside them, status 2."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("ATLAS_CACHE", str(tmp_path / "cache"))
    t, motion = np.linspace(0, 9, 40), atlas.ElementaryMotion(1.5, (1, 2), 0.7)
    noise = np.random.default_rng(0).normal(0, 0.01, (40, 9))
    head = "# ratio = 1.5\n# field = 1 2\n# omega2 = 0.7\nt," + ",".join(f"R{i}{j}" for i in "123" for j in "123")
    for number in (2, 3):
        table = np.column_stack([t, motion.rotation(t).reshape(-1, 9) + number * noise])
        np.savetxt(f"run{number}.csv", table, delimiter=",", header=head, comments="")
    file, new = Path(name), Path(name).with_suffix(f".new{Path(name).suffix}")
    options = ["--out", "out"] if "out/" not in words else []

    def status_of(number: int) -> int:
        with pytest.raises(SystemExit) as ended:
            main([*words.format(number).split(), *options])
        return int(ended.value.code or 0)

    file.parent.mkdir()
    file.write_text("foreign")
    assert status_of(2) == 2
    assert (file.read_text(), new.exists()) == ("foreign", True)
    content = new.read_bytes()
    file.unlink()
    assert status_of(2) in {0, 1}
    assert file.read_bytes() == content
    assert status_of(3) in {0, 1}
    assert file.read_bytes() != content
    with file.open("ab") as stream:
        stream.write(b" ")
    edited = file.read_bytes()
    assert status_of(2) == 2
    assert file.read_bytes() == edited
    assert new.read_bytes() == content


@pytest.mark.slow
@pytest.mark.parametrize("words", [marked(words) for words in WRITERS if not words.startswith("figure")])
def test_a_full_disk_keeps_existing_files(tmp_path: Path, words: str) -> None:
    """One line names the file or the folder; a figure is in the cache by then, and the system copies it from there."""
    assert run(tmp_path, words).returncode == 0
    before = {path: path.read_bytes() for path in (tmp_path / "out").rglob("*") if path.is_file()}
    limit = "import resource; resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))"
    one_line(run(tmp_path, words.replace("turns=1", "turns=2"), limit), 1, "File too large: out/")
    assert {path: path.read_bytes() for path in (tmp_path / "out").rglob("*") if path.is_file()} == before


@pytest.mark.parametrize("reads", ["", pytest.param("cat >/dev/null; ", marks=pytest.mark.slow)])
def test_a_failure_of_ffmpeg_is_reported_in_one_line(tmp_path: Path, reads: str) -> None:
    """Its message is passed on, whether it goes at once or after the last frame."""
    program = tmp_path / "ffmpeg"
    program.write_text(f"#!/bin/sh\n{reads}echo 'No space left on device' >&2\nexit 1\n")
    program.chmod(0o755)
    words = "animate cone --over azimuth=0:80:2 --dpi 20 --format mp4"
    done = run(tmp_path, words, PATH=f"{tmp_path}:{os.environ['PATH']}")
    one_line(done, 1, "ffmpeg could not write out/cone.mp4: No space left on device")
    assert not list((tmp_path / "out").iterdir())


def test_leftovers_of_a_killed_process_are_removed(tmp_path: Path) -> None:
    """The next one that writes the same file removes it, but nothing of one that lives or of another file."""
    program = (
        "import sys, time; from pathlib import Path; from atlas import files\n"
        "with files.replacing(Path(sys.argv[1])) as part:\n"
        "    part.write_text('half'); print('there', flush=True); time.sleep(60)"
    )
    path = tmp_path / "a[1].gif"

    def half_done() -> subprocess.Popen[str]:
        process = subprocess.Popen([sys.executable, "-c", program, str(path)], stdout=subprocess.PIPE, text=True)
        assert process.stdout
        assert process.stdout.readline() == "there\n"
        return process

    path_user = tmp_path / f".unfinished-999999999-b-{path.name}"
    path_user.write_text("of the user")
    with half_done() as dead, half_done() as alive:
        dead.kill()
        dead.wait()
        assert len(list(tmp_path.iterdir())) == 3
        files.write(path, "whole")
        assert {path.name for path in tmp_path.iterdir()} == {
            path.name,
            path_user.name,
            f".unfinished-{alive.pid}-{path.name}",
        }
        alive.kill()
    assert path.read_text() == "whole"


def test_folders_take_turns_and_are_whole_at_any_moment(tmp_path: Path) -> None:
    """Two processes write one folder over and over: a reader finds it there, with the files of one of them."""
    program = (
        "import sys; from pathlib import Path; from atlas.book.building.publish import replace\n"
        "for _ in range(60): replace(Path('out/x'), {name: sys.argv[1].encode() for name in ('a', 'b/c')})"
    )
    replace(tmp_path / "out" / "x", {"a": b"0", "b/c": b"0"})
    processes = [subprocess.Popen([sys.executable, "-c", program, word], cwd=tmp_path) for word in "12"]
    contents = set()
    while any(process.poll() is None for process in processes):
        assert (tmp_path / "out" / "x").is_dir()
        contents.add((tmp_path / "out" / "x" / "a").read_bytes())
        time.sleep(0.001)
    assert [process.returncode for process in processes] == [0, 0]
    assert contents <= {b"0", b"1", b"2"}
    assert len(contents) > 1
    contents_after = {(tmp_path / "out" / "x" / name).read_bytes() for name in ("a", "b/c")}
    assert len(contents_after) == 1
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["x"]


def test_a_folder_that_was_being_written_is_cleared_by_the_next(tmp_path: Path) -> None:
    """Killed between its files, it leaves the folder as it was; the next one clears leftovers beside it."""
    program = (
        "import os, signal; from pathlib import Path; from atlas.book.building.publish import replace\n"
        "def killed(*_): os.kill(os.getpid(), signal.SIGKILL)\n"
        "import atlas.book.building.publish as publish; publish.exchange = killed\n"
        "replace(Path('out/x'), {'a': b'new'})"
    )
    replace(tmp_path / "out" / "x", {"a": b"old"})
    done = subprocess.run([sys.executable, "-c", program], cwd=tmp_path, check=False)
    assert done.returncode == -signal.SIGKILL
    assert (tmp_path / "out" / "x" / "a").read_bytes() == b"old"
    assert len(list((tmp_path / "out").iterdir())) == 2
    replace(tmp_path / "out" / "x", {"a": b"new"})
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["x"]
    assert (tmp_path / "out" / "x" / "a").read_bytes() == b"new"
