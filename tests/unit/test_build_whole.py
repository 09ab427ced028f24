"""Whole or not at all: whatever happens to a build, the last good files stay."""

import signal
import subprocess
import sys
from pathlib import Path

import pytest

from atlas.build.report import build_report
from atlas.build.whole import PREFIX, publish, staging, write
from atlas.errors import AtlasError
from atlas.report import pdf

PLAIN = """
name = "plain"
title = "{}"
[[pages]]
slug = "index"
title = "T"
[[pages.blocks]]
kind = "prose"
text = "x"
"""
KILLED = """
import os, signal, sys
from atlas.build.report import build_report
def tell(done, total, what):
    if what == "PDF":
        os.kill(os.getpid(), signal.SIGKILL)
build_report(sys.argv[1], __import__("pathlib").Path(sys.argv[2]), tell)
"""


def state(folder: Path) -> dict[str, bytes]:
    """Return what a reader gets: all files but hidden ones and the times that a build took."""
    names = (path.relative_to(folder) for path in folder.rglob("*") if path.is_file())
    shown = (
        name for name in names if not any(part.startswith(".") for part in name.parts) and "costs" not in name.name
    )
    return {str(name): (folder / name).read_bytes() for name in shown}


def report(folder: Path, title: str) -> Path:
    """Write a small report file."""
    file = folder / "plain.toml"
    file.write_text(PLAIN.format(title), encoding="utf-8")
    return file


def test_a_failing_pdf_leaves_the_last_good_report(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """If the PDF can't be set, no page is replaced either, and nothing is left lying about."""
    out = tmp_path / "out"
    build_report(report(tmp_path, "Old"), out)
    before = state(out)

    def fail(_press: pdf.Press, _source: str) -> bytes:
        raise AtlasError("no PDF today.")

    monkeypatch.setattr(pdf.Press, "set", fail)
    with pytest.raises(AtlasError, match="no PDF today"):
        build_report(report(tmp_path, "New"), out)
    assert state(out) == before
    assert not list(out.glob(f"{PREFIX}*"))


def test_a_killed_build_leaves_the_last_good_report_and_the_next_one_sweeps(tmp_path: Path) -> None:
    """SIGKILL between pages and PDF changes no file; the next build removes what was left and succeeds."""
    out = tmp_path / "out"
    build_report(report(tmp_path, "Old"), out)
    before = state(out)
    killed = subprocess.run([sys.executable, "-c", KILLED, str(report(tmp_path, "New")), str(out)], check=False)
    assert killed.returncode == -signal.SIGKILL
    assert state(out) == before
    assert list(out.glob(f"{PREFIX}*"))
    made = build_report(tmp_path / "plain.toml", out)
    assert not list(out.glob(f"{PREFIX}*"))
    assert "New" in made.index.read_text(encoding="utf-8")


def test_what_is_stale_goes_and_what_is_foreign_stays(tmp_path: Path) -> None:
    """Pages that a report no longer has are removed from its folder; files beside the folder are not touched."""
    with staging(tmp_path) as stage:
        for name in ("r/index.html", "r/old.html", "r/figures/1.svg", "r.pdf"):
            write(stage / name, name)
        publish(stage, tmp_path, ["r/index.html", "r/old.html", "r/figures/1.svg", "r.pdf"], ["r"])
    (tmp_path / "mine.txt").write_text("mine", encoding="utf-8")
    with staging(tmp_path) as stage:
        write(stage / "r/index.html", "new")
        publish(stage, tmp_path, ["r/index.html"], ["r"])
    assert state(tmp_path) == {"r/index.html": b"new", "r.pdf": b"r.pdf", "mine.txt": b"mine"}
    assert not (tmp_path / "r" / "figures").exists()


def test_the_staging_folder_of_a_living_build_is_left_alone(tmp_path: Path) -> None:
    """A second build at the same time does not sweep away what the first is making."""
    with staging(tmp_path) as first:
        write(first / "a", "a")
        with staging(tmp_path) as second:
            assert first != second
            assert (first / "a").is_file()
    assert not list(tmp_path.glob(f"{PREFIX}*"))


def test_a_place_that_cannot_be_written_is_told(tmp_path: Path) -> None:
    """Where a file stands in the way of the output folder, one sentence says so."""
    (tmp_path / "file").write_text("", encoding="utf-8")
    with pytest.raises(AtlasError, match="nothing can be written"), staging(tmp_path / "file" / "out"):
        pass
