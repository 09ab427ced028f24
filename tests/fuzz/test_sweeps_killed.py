"""Sweeps that are killed while they run, and two at once on one table: all rows of one recipe, or a line."""

import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from values import EXAMPLES, Process, ended

from atlas.files import WRITTEN

pytestmark = pytest.mark.skipif(not EXAMPLES, reason="seconds for each kill: in make stress, a few in CI")

KILLS = max(1, EXAMPLES // 100)
PAIRS = max(1, EXAMPLES // 200)
ASKED = "--quantity k --quantity phi --digits 30 --rows 100 -j 2 --out t.csv".split()


def start(folder: Path, B2: float) -> Process:
    """Start a sweep of 2000 rows in 20 parts on two processes."""
    settings = {"ratio": "0.1:2:40", "B2": str(B2), "B3": "0.2", "omega2": "0.1:3:50"}
    set_words = [word for item in settings.items() for word in ("--set", "=".join(item))]
    words = [sys.executable, "-m", "atlas", "sweep", "elementary", *set_words, *ASKED]
    return subprocess.Popen(words, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)


@pytest.fixture(scope="module")
def tables(tmp_path_factory: pytest.TempPathFactory) -> dict[float, bytes]:
    """Return the tables of both recipes, each of a sweep that nobody disturbed."""
    table_bytes = {}
    for B2 in (1.0, 2.0):
        folder = tmp_path_factory.mktemp("whole")
        assert ended(start(folder, B2)) == (0, "")
        table_bytes[B2] = (folder / "t.csv").read_bytes()
    return table_bytes


def finished_parts(parts: Path) -> set[str]:
    """Return the names of the parts that are there."""
    return {path.name for path in parts.glob("part-*")}


def test_a_sweep_killed_at_any_moment_can_be_finished(tmp_path: Path, tables: dict[float, bytes]) -> None:
    """Killed at any moment from a new part on, with the recipe changed now and then, the last one ends whole."""
    chance, killed, folder = random.Random(os.getpid()), 0, tmp_path / "t.csv.parts"  # noqa: S311
    print(f"seed {os.getpid()}")  # noqa: T201  shown if the test fails
    B2, longest = 1.0, 1.0
    while killed < KILLS:
        before, process = finished_parts(folder), start(tmp_path, B2)
        while process.poll() is None and finished_parts(folder) <= before:
            time.sleep(0.005)
        started = time.monotonic()
        while process.poll() is None and time.monotonic() < started + chance.random() * longest:
            time.sleep(0.005)
        process.send_signal(signal.SIGKILL)
        status, message = ended(process)
        killed += status == -signal.SIGKILL
        if status != -signal.SIGKILL:  # it was faster
            assert (status, message) == (0, "")
            assert (tmp_path / "t.csv").read_bytes() == tables[B2]
            longest = max(0.05, 0.7 * longest)
        if chance.random() < 0.1:
            B2 = 3.0 - B2
    assert ended(start(tmp_path, B2)) == (0, "")
    assert (tmp_path / "t.csv").read_bytes() == tables[B2]
    assert {path.name for path in tmp_path.iterdir()} == {"t.csv", WRITTEN}
    print(f"{killed} sweeps killed")  # noqa: T201  the count of a hunt: pytest -s


def test_two_sweeps_at_once_make_one_table(tmp_path: Path, tables: dict[float, bytes]) -> None:
    """The same recipe or two, started together: one writes, the other says who does; the table is one recipe's."""
    for pair in range(PAIRS):
        recipes = (1.0, 1.0 + pair % 2)
        processes = [start(tmp_path, B2) for B2 in recipes]
        (status, message), (two, second) = map(ended, processes)
        assert sorted((status, two)) == [0, 2], (message, second)
        assert message + second == (second if two else message)
        assert f"(process {processes[bool(status)].pid} on " in message + second
        assert (message + second).count("\n") == 1
        assert (tmp_path / "t.csv").read_bytes() == tables[recipes[bool(status)]]
        assert {path.name for path in tmp_path.iterdir()} == {"t.csv", WRITTEN}
        (tmp_path / "t.csv").unlink()
    print(f"{PAIRS} pairs of sweeps ended well")  # noqa: T201
