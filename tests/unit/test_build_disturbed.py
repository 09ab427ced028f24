"""Builds whose processes are killed, starved or moved: whole or not at all, and the same bytes in the end.

Killed themselves, and two at once: `tests/fuzz/test_builds_killed.py`.
"""

import hashlib
import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path

import pytest

REPORT = r"""
name = "small"
title = "A Small Report"
authors = ["A. Author"]
abstract = "A formula, $R(t)$."

[parameters]
bodies.shell = { title = "shell", ratio = 1.5 }
fields.oblique = { title = "oblique field", prime = [1.0, 2.0] }

[[pages]]
slug = "index"
title = "The page"
blocks = [
  { kind = "prose", text = "The vector $\\mathbf{B}'$ and @(71)." },
  { kind = "equation", name = "(71)" },
  { kind = "figure", recipe = "hyperbola", body = "shell", field = "oblique" },
  { kind = "figure", recipe = "trochoids" },
  { kind = "table", table = "points", body = "shell", field = "oblique", parameters = { omega2 = [0.7] } },
]
"""


def command(folder: Path, *words: str) -> list[str]:
    """Write the report's file into a folder and return the command that builds it there."""
    folder.mkdir(exist_ok=True)
    (folder / "small.toml").write_text(REPORT)
    program = ["env", f"ATLAS_CACHE={folder / 'cache'}", sys.executable, "-m", "atlas"]
    return [*program, "report", str(folder / "small.toml"), "--out", str(folder / "out"), *words]


def run(words: list[str], **options: object) -> subprocess.CompletedProcess[str]:
    """Run a build to its end."""
    return subprocess.run(words, capture_output=True, text=True, check=False, **options)  # type: ignore[call-overload,no-any-return]


def content(folder: Path) -> dict[str, str]:
    """Return the digests of the reader's files: the pages, the figures, the fonts, the PDF."""
    out = folder / "out"
    files = [path for path in [*(out / "small").rglob("*"), out / "small.pdf"] if path.is_file()]
    return {path.relative_to(out).as_posix(): hashlib.sha256(path.read_bytes()).hexdigest() for path in files}


@pytest.fixture(scope="module")
def peace(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Build once in peace."""
    folder = tmp_path_factory.mktemp("peace")
    result = run(command(folder))
    assert result.returncode == 0, result.stderr
    return folder


@pytest.fixture(scope="module")
def undisturbed(peace: Path) -> dict[str, str]:
    """Return the files of an undisturbed build."""
    files = content(peace)
    assert {"small/index.html", "small/manifest.json", "small.pdf"} <= files.keys()
    return files


@pytest.fixture
def copy(peace: Path, tmp_path: Path) -> Path:
    """Return a copy of an undisturbed build, with its cache."""
    return shutil.copytree(peace, tmp_path / "copy")


@pytest.mark.slow
def test_a_killed_build_leaves_no_process_behind(tmp_path: Path) -> None:
    """When the build alone is killed, the processes that draw for it come to an end by themselves."""
    chance = random.Random(5)  # noqa: S311  reproducible, not secret
    with subprocess.Popen(
        command(tmp_path, "-j", "2"), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True
    ) as build:
        deadline = time.monotonic() + 30.0
        while not (workers := _workers(build.pid)) and time.monotonic() < deadline:
            time.sleep(0.01)
        assert workers
        time.sleep(chance.uniform(0.0, 0.5))
        build.kill()
    while _alive(build.pid):
        assert time.monotonic() < deadline, "a process of a killed build lives on"
        time.sleep(0.05)


def _alive(group: int) -> bool:
    """Whether a process of a group runs; one that has ended stays a zombie where process 1 does not wait for it."""
    for stat in Path("/proc").glob("[0-9]*/stat"):
        with suppress(OSError):  # gone meanwhile
            state, _, its_group, *_ = stat.read_text().rpartition(")")[2].split()
            if state != "Z" and int(its_group) == group:
                return True
    return False


@pytest.mark.slow
@pytest.mark.parametrize("loading", [True, False])
def test_a_build_survives_workers_killed_at_random(
    undisturbed: dict[str, str], tmp_path: Path, *, loading: bool
) -> None:
    """When the processes that draw are killed, the build draws their figures again, and ends in the same bytes."""
    chance = random.Random(7)  # noqa: S311  reproducible, not secret
    with subprocess.Popen(
        command(tmp_path, "-j", "2"), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
    ) as build:
        deadline = time.monotonic() + 30.0
        while not (workers := _workers(build.pid, loading=loading)) and time.monotonic() < deadline:
            time.sleep(0.01)
        time.sleep(chance.uniform(0.0, 0.2 if loading else 1.0))
        for worker in workers:
            with suppress(ProcessLookupError):
                os.kill(worker, signal.SIGKILL)
        _, complaint = build.communicate()
    assert workers
    assert build.returncode == 0, complaint
    assert content(tmp_path) == undisturbed


def _workers(parent: int, *, loading: bool = False) -> list[int]:
    """Return the processes that draw for a build: the one that loads the libraries, and its forks once there are."""
    servers = [child for child in _children(parent) if b"forkserver" in Path(f"/proc/{child}/cmdline").read_bytes()]
    forks = [fork for server in servers for fork in _children(server)]
    return [*servers, *forks] if loading or forks else []


def _children(parent: int) -> list[int]:
    return [int(child) for child in Path(f"/proc/{parent}/task/{parent}/children").read_text().split()]


@pytest.mark.slow
def test_damaged_entries_of_the_cache_are_made_again(undisturbed: dict[str, str], copy: Path) -> None:
    """Whatever is altered, cut or removed in the cache, the next build ends in the same bytes."""
    words, chance = command(copy), random.Random(3)  # noqa: S311  reproducible, not secret
    for entry in sorted((copy / "cache").glob("??/*")):
        damaged = bytearray(entry.read_bytes())
        damaged[chance.randrange(len(damaged))] ^= 1 << chance.randrange(8)
        match chance.randrange(4):
            case 0:
                entry.unlink()
            case 1:
                entry.write_bytes(bytes(damaged[: chance.randrange(len(damaged))]))
            case 2:
                entry.write_bytes(bytes(damaged))
    (copy / "out" / "small" / "index.html").unlink()
    result = run(words)
    assert result.returncode == 0, result.stderr
    assert content(copy) == undisturbed


@pytest.mark.slow
def test_folder_jobs_locale_and_time_zone_change_no_byte(undisturbed: dict[str, str], tmp_path: Path) -> None:
    """Elsewhere, one figure at a time, in another language and time zone, the bytes are the same."""
    folder = tmp_path / "another place"
    abroad = os.environ | {"LC_ALL": "C", "TZ": "Pacific/Apia", "LANG": "de_DE.UTF-8", "PYTHONHASHSEED": "7"}
    assert run(command(folder, "-j", "1"), env=abroad, cwd=tmp_path).returncode == 0
    assert content(folder) == undisturbed


@pytest.mark.slow
def test_a_full_disk_is_reported_in_one_line_and_the_last_good_report_kept(
    undisturbed: dict[str, str], copy: Path
) -> None:
    """When a file cannot be written in full, the command says so in one line and leaves the old file."""
    words = command(copy)
    (copy / "small.toml").write_text(REPORT.replace("A Small Report", "Another Title"))

    def starve() -> None:
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, 20_000))

    result = run(words, preexec_fn=starve)
    assert result.returncode == 1, result.stderr
    assert result.stderr.count("\n") == 1
    assert "Traceback" not in result.stderr
    assert content(copy) == undisturbed


def test_a_folder_that_cannot_be_made_is_reported_in_one_line(tmp_path: Path) -> None:
    """Where a file stands in the place of the folder, the command says so in one line."""
    words = command(tmp_path)
    (tmp_path / "out").write_text("in the way")
    result = run(words)
    assert result.returncode in {1, 2}
    assert result.stderr.count("\n") == 1
    assert str(tmp_path / "out") in result.stderr
    assert (tmp_path / "out").read_text() == "in the way"


@pytest.mark.slow
def test_an_unchanged_report_is_not_built_again(copy: Path) -> None:
    """A second build takes the report as it is; a lost file is made again, an edited one stays, the new beside it."""
    words = command(copy)
    assert run(words).returncode == 0
    before = {path: path.stat().st_mtime_ns for path in (copy / "out").rglob("*") if path.is_file()}
    again = run([*words, "--explain"])
    assert "nothing it depends on has changed" in again.stdout
    after = {path: path.stat().st_mtime_ns for path in (copy / "out").rglob("*") if path.is_file()}
    assert {path for path in before if before[path] != after.get(path)} == set()
    victim = copy / "out" / "small" / "index.html"
    content_before = victim.read_bytes()
    victim.unlink()
    assert run(words).returncode == 0
    assert victim.read_bytes() == content_before
    victim.write_text("mine")
    assert run(words).returncode == 2
    assert victim.read_text() == "mine"
    assert victim.with_name("index.new.html").read_bytes() == content_before
