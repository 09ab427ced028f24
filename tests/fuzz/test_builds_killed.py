"""Builds that are killed while they run, and two at once in one folder: files whole, pages of one build at any time."""

import hashlib
import os
import random
import shutil
import signal
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path

import pytest
from values import EXAMPLES, Process, ended

pytestmark = pytest.mark.skipif(not EXAMPLES, reason="seconds for each kill: in make stress, a few in CI")

KILLS = max(1, EXAMPLES * 120 // 20_000)
PAIRS = max(1, EXAMPLES * 25 // 20_000)
REPORT = """
name = "small"
title = "A Small Report, {version}"
authors = ["A. Author"]
abstract = "A formula, $R(t)$."

[[pages]]
slug = "index"
title = "The page"
blocks = [
  {{ kind = "equation", name = "(71)" }},
  {{ kind = "figure", recipe = "trochoids", parameters.turns = {version}.5 }},
]
"""
Content = dict[str, str]


def start(folder: Path, version: int) -> Process:
    """Start a build of one version of a report, as the leader of a group of processes."""
    file = folder / str(version) / "small.toml"
    file.parent.mkdir(exist_ok=True)
    file.write_text(REPORT.format(version=version))
    return begun(folder, "cache", "report", str(file), "--out", "out", "-j", "2")


def begun(folder: Path, cache: str, *words: str) -> Process:
    """Start a command in a folder, with a cache of this name, as the leader of a group of processes."""
    return subprocess.Popen(
        [sys.executable, "-m", "atlas", *words],
        cwd=folder,
        env=os.environ | {"ATLAS_CACHE": str(folder / cache)},
        start_new_session=True,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
    )


def content(folder: Path) -> Content:
    """Return the digests of the reader's files: the pages, the figures, the PDF."""
    out = folder / "out"
    files = [path for path in [*(out / "small").rglob("*"), out / "small.pdf"] if path.is_file()]
    return {path.relative_to(out).as_posix(): hashlib.sha256(path.read_bytes()).hexdigest() for path in files}


@pytest.fixture(scope="module")
def versions(tmp_path_factory: pytest.TempPathFactory) -> dict[int, Content]:
    """Return the undisturbed builds of both versions."""
    contents = {}
    for version in (1, 2):
        folder = tmp_path_factory.mktemp("peace")
        assert ended(start(folder, version)) == (0, "")
        contents[version] = content(folder)
    assert (
        contents[1].keys() == contents[2].keys() >= {"small/index.html", "small/figures/01-trochoids.svg", "small.pdf"}
    )
    for name in ("small/index.html", "small/figures/01-trochoids.svg", "small.pdf"):
        assert contents[1][name] != contents[2][name]
    return contents


def complete_files(folder: Path, place: str) -> set[Path]:
    """Return the files in a build's cache, or at the top of its folder, unfinished ones too."""
    return set((folder / place).rglob("*") if place == "cache" else (folder / place).glob("*"))


def wait_until_alone(group: int) -> None:
    """Wait until no process of a group lives."""
    deadline = time.monotonic() + 60.0
    while True:
        try:
            os.killpg(group, 0)
        except ProcessLookupError:
            return
        assert time.monotonic() < deadline, "a process of a killed build lives on"
        time.sleep(0.02)


def test_builds_that_are_killed_leave_whole_files_and_heal(tmp_path: Path, versions: dict[int, Content]) -> None:
    """Killed after a new entry in the cache, or while files take their places, the last one ends as in peace."""
    chance, killed, finished, version = random.Random(os.getpid()), 0, 0, 1  # noqa: S311
    longest = {"cache": 1.0, "out": 0.05}
    print(f"seed {os.getpid()}")  # noqa: T201  shown if the test fails
    files_of_both = versions[1].items() | versions[2].items()
    while killed < KILLS:
        place = chance.choice(list(longest))
        before, process = complete_files(tmp_path, place), start(tmp_path, version)
        while process.poll() is None and complete_files(tmp_path, place) <= before:
            time.sleep(0.002)
        end = time.monotonic() + chance.random() * longest[place]
        while process.poll() is None and time.monotonic() < end:
            time.sleep(0.002)
        process.send_signal(signal.SIGKILL)
        status, message = ended(process)
        wait_until_alone(process.pid)
        files_after = content(tmp_path)
        pages = {item for item in files_after.items() if item[0].startswith("small/")}
        assert files_after.items() <= files_of_both
        assert any(pages <= files.items() for files in versions.values())
        if status == -signal.SIGKILL:
            killed, longest[place] = killed + 1, 1.1 * longest[place]
            continue
        assert (status, message) == (0, "")  # it was faster
        assert content(tmp_path) == versions[version]
        finished, longest[place], version = finished + 1, max(0.01, 0.7 * longest[place]), 3 - version
        shutil.rmtree(tmp_path / "cache")
    assert ended(start(tmp_path, version)) == (0, "")
    assert content(tmp_path) == versions[version]
    print(f"{killed} builds killed, {finished} between them ended")  # noqa: T201  the count of a hunt: pytest -s


@pytest.mark.usefixtures("interrupts")
def test_pages_that_are_ended_leave_no_process(tmp_path: Path) -> None:
    """At any moment, by Ctrl-C, of which one line is said, or killed: the workers end, too."""
    interrupted = "atlas: interrupted"
    print(f"seed {os.getpid()}")  # noqa: T201  shown if the test fails
    chance = random.Random(os.getpid())  # noqa: S311
    page = ("page", "--ratio", "1.3", "--field", "1", "2", "--omega2", "0.7", "--out", "out")
    for count in range(KILLS):
        with begun(tmp_path, f"cache{count}", *page) as process:
            time.sleep(0.3 + 4 * chance.random())
            killed = chance.random() < 0.5
            with suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGINT) if not killed else process.kill()
            message = process.communicate(timeout=60)[1].strip()
        # the status is the signal's where Python was about to make a dataclass, whose `exec` asks for it once more, and
        # where Python itself starts and ends
        ends = {(0, ""), (130, interrupted), (-signal.SIGINT, interrupted), (-signal.SIGINT, "")}
        end = (process.returncode, message)
        assert end[0] in {0, -signal.SIGKILL} if killed else end in ends, "\n".join(map(str, end))
        wait_until_alone(process.pid)


def test_two_builds_at_once_do_no_harm(tmp_path: Path, versions: dict[int, Content]) -> None:
    """The same report or two versions of it, started together in one folder: both end well, in the bytes of one."""
    for pair in range(PAIRS):
        processes = [start(tmp_path, version) for version in (1, 1 + pair % 2)]
        assert [ended(process) for process in processes] == [(0, ""), (0, "")]
        assert content(tmp_path) in ([versions[1]] if pair % 2 == 0 else list(versions.values()))
        shutil.rmtree(tmp_path / "cache")
        shutil.rmtree(tmp_path / "out")
    print(f"{PAIRS} pairs of builds ended well")  # noqa: T201
