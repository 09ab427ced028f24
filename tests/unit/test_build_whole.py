"""Whole or not at all: whatever happens to a build, the last good files stay."""

import signal
import subprocess
import sys
from pathlib import Path
from threading import Event

import pytest
import typst

from atlas.build import advance as advance_module
from atlas.build.record import RECORD
from atlas.build.report import build_report
from atlas.build.whole import PREFIX, publish, room, staging, write
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
from atlas.build import advance as advance_module
from atlas.build.record import RECORD
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


def test_a_folder_of_something_else_is_left_alone(tmp_path: Path) -> None:
    """Where a folder of the report's name holds the user's own files, nothing is built over them."""
    mine = tmp_path / "out" / "plain" / "notes" / "thesis.tex"
    mine.parent.mkdir(parents=True)
    mine.write_text("mine")
    with pytest.raises(AtlasError, match="files that are of no report"):
        build_report(report(tmp_path, "T"), tmp_path / "out")
    assert [path for path in (tmp_path / "out" / "plain").rglob("*") if path.is_file()] == [mine]


def test_a_report_that_lost_its_record_is_built_again(tmp_path: Path) -> None:
    """Any file of a built report may be lost, also the one by which it is known as a report."""
    out = tmp_path / "out"
    build_report(report(tmp_path, "T"), out)
    before = state(out)
    (out / "plain" / RECORD).unlink()
    build_report(tmp_path / "plain.toml", out)
    assert state(out) == before


def test_a_report_is_not_named_after_the_folder_above(tmp_path: Path) -> None:
    """A name such as `..` would put the pages, and sweep, outside the folder for the files."""
    file = tmp_path / "...toml"
    file.write_text(PLAIN.format("T").replace('"plain"', '".."'))
    (tmp_path / "mine").write_text("mine")
    with pytest.raises(AtlasError, match="must not begin with a dot"):
        build_report(file, tmp_path / "out")
    assert (tmp_path / "mine").read_text() == "mine"


def test_the_folder_of_a_killed_process_is_swept_up_at_once(tmp_path: Path) -> None:
    """A folder that no living process holds goes when the next one is given, one that is held stays."""
    program = "import os, sys; from pathlib import Path; from atlas.build.whole import room\n"
    program += "with room(Path(sys.argv[1])): os.kill(os.getpid(), 9)"
    subprocess.run([sys.executable, "-c", program, str(tmp_path)], check=False)
    assert len(list(tmp_path.glob(f"{PREFIX}*"))) == 1
    with room(tmp_path) as first, room(tmp_path) as second:
        assert sorted(tmp_path.glob(f"{PREFIX}*")) == sorted([first.parent, second.parent])
    assert not list(tmp_path.glob(f"{PREFIX}*"))


def test_a_stand_in_never_takes_the_place_of_a_picture(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A blank picture that is late is not written over the one that has been drawn in the meantime."""
    began, drawn = Event(), Event()

    def slow(*_: object, **__: object) -> bytes:
        began.set()
        drawn.wait(10.0)
        return b"blank"

    monkeypatch.setattr(typst, "compile", slow)
    monkeypatch.setattr(advance_module, "_MOMENT", 0.0)
    advance = advance_module.Advance(tmp_path, "text", {"plate.svg": (10.0, 10.0)})
    assert began.wait(10.0)
    advance.make_way()
    (tmp_path / "plate.svg").write_text("drawn")
    drawn.set()
    assert advance.finish("text").startswith(b"%PDF")
    assert (tmp_path / "plate.svg").read_text() == "drawn"
