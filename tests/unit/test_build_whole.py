"""Whole or not at all: whatever happens to a build, the last good files stay."""

import shutil
import signal
import subprocess
import sys
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path
from typing import Any
from unittest.mock import Mock

import pytest

from atlas import processes
from atlas.book import typesetting
from atlas.book.building import publish as publishing
from atlas.book.building.formats import MANIFEST
from atlas.book.building.publish import WRITTEN, publish, replace
from atlas.book.building.report import build_report
from atlas.errors import AtlasError

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
from atlas.book.building.report import build_report
def tell(done, total, what):
    if what == "pages":
        os.kill(os.getpid(), signal.SIGKILL)
build_report(sys.argv[1], __import__("pathlib").Path(sys.argv[2]), tell)
"""


def state(folder: Path) -> dict[str, bytes]:
    """Return the reader's files: all but hidden ones and the times that a build took."""
    names = (path.relative_to(folder) for path in folder.rglob("*") if path.is_file())
    names_shown = (
        name
        for name in names
        if not any(segment.startswith(".") for segment in name.parts) and "costs" not in name.name
    )
    return {str(name): (folder / name).read_bytes() for name in names_shown}


def report(folder: Path, title: str) -> Path:
    """Write a small report file."""
    file = folder / "plain.toml"
    file.write_text(PLAIN.format(title), encoding="utf-8")
    return file


@pytest.mark.slow
@pytest.mark.parametrize(
    ("error", "message"),
    [(AtlasError("no PDF today."), "no PDF today"), (BrokenProcessPool(), r"plain\.pdf: .*enough memory\?")],
)
def test_a_failing_pdf_leaves_the_last_good_one(
    error: Exception, message: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The pages come first, whole; if the PDF can't be set, the last one stays, and the next build makes it."""
    out = tmp_path / "out"
    old = build_report(report(tmp_path, "Old"), out).pdf.read_bytes()
    with monkeypatch.context() as patch:
        patch.setattr(processes, "pool", lambda _: None)  # in this process, where the PDF can be made to fail
        patch.setattr(typesetting, "compiled", Mock(side_effect=error))
        with pytest.raises(AtlasError, match=message):
            build_report(report(tmp_path, "New"), out)
    files = state(out)
    assert b"New" in files["plain/index.html"]
    assert files["plain.pdf"] == old
    assert build_report(tmp_path / "plain.toml", out).pdf.read_bytes() != old


@pytest.mark.slow
def test_a_pdf_with_the_same_content_is_not_typeset_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A report whose file changed, but nothing in its PDF, gets the PDF of the last build, wherever it is built."""
    file = report(tmp_path, "Old")
    before = build_report(file, tmp_path / "out").pdf.read_bytes()
    file.write_text(f"{file.read_text()}# a remark\n")
    monkeypatch.setattr(processes, "pool", lambda _: None)
    monkeypatch.setattr(typesetting, "compiled", Mock(side_effect=AtlasError("it is set again")))
    assert build_report(file, tmp_path / "other").pdf.read_bytes() == before


@pytest.mark.slow
def test_edited_pages_do_not_stop_the_pdf(tmp_path: Path) -> None:
    """An edited page is told of, and the PDF is new all the same."""
    built = build_report(report(tmp_path, "Old"), tmp_path)
    old = built.pdf.read_bytes()
    built.index.write_text("mine")
    with pytest.raises(AtlasError, match=r"index\.html is not as atlas wrote it"):
        build_report(report(tmp_path, "New"), tmp_path)
    assert built.index.read_text() == "mine"
    assert built.pdf.read_bytes() != old


@pytest.mark.slow
def test_a_killed_build_leaves_the_last_good_report(tmp_path: Path) -> None:
    """SIGKILL before the pages are made changes no file; the next build succeeds."""
    out = tmp_path / "out"
    build_report(report(tmp_path, "Old"), out)
    before = state(out)
    killed = subprocess.run([sys.executable, "-c", KILLED, str(report(tmp_path, "New")), str(out)], check=False)
    assert killed.returncode == -signal.SIGKILL
    assert state(out) == before
    made = build_report(tmp_path / "plain.toml", out)
    assert "New" in made.index.read_text(encoding="utf-8")


@pytest.mark.slow
def test_stale_pages_are_removed_and_user_files_are_kept(tmp_path: Path) -> None:
    """Pages that a report no longer has are removed from its folder; files of the user stay, in it and beside it."""
    out, file = tmp_path / "out", report(tmp_path, "T")
    second = '\n[[pages]]\nslug = "second"\ntitle = "U"\nblocks = []\n'
    file.write_text(file.read_text() + second)
    build_report(file, out)
    (out / "mine.txt").write_text("mine")
    (out / "plain" / "old").mkdir()
    (out / "plain" / "old" / "page.html").write_text("old")
    assert (out / "plain" / "second.html").is_file()
    build_report(report(tmp_path, "T"), out)
    names = state(out).keys()
    assert {"mine.txt", "plain/index.html", "plain.pdf", "plain/old/page.html"} <= names
    assert "plain/second.html" not in names


@pytest.mark.slow
def test_a_folder_with_the_users_files_is_kept(tmp_path: Path) -> None:
    """Where a folder of the report's name holds the user's own files, they stay."""
    file_mine = tmp_path / "out" / "plain" / "notes" / "thesis.tex"
    file_mine.parent.mkdir(parents=True)
    file_mine.write_text("mine")
    build_report(report(tmp_path, "T"), tmp_path / "out")
    assert file_mine.read_text() == "mine"


@pytest.mark.parametrize("link", [False, True])
def test_an_edited_file_is_kept_and_the_new_file_is_written_beside_it(tmp_path: Path, *, link: bool) -> None:
    """It is told each time until it is as written; stale edited files stay, the new one of before goes."""
    place = tmp_path / "d"
    if link:
        (tmp_path / "there").mkdir()
        place.symlink_to(tmp_path / "there")
    replace(place, {"a.tex": b"1", "b.tex": b"1", "s/c.tex": b"1"})
    (place / "a.tex").write_text("mine")
    (place / "s" / "c.tex").write_text("mine")
    (place / "a.new.tex").write_text("mine too")
    for version in (b"2", b"3"):
        with pytest.raises(AtlasError, match=r"a\.tex is not as atlas wrote it: the new one is a\.new\.new\.tex"):
            replace(place, {"a.tex": version, "b.tex": version})
        files = {name: content for name, content in state(place).items() if name != WRITTEN}
        assert files == {
            "a.tex": b"mine", "a.new.tex": b"mine too", "a.new.new.tex": version, "b.tex": version, "s/c.tex": b"mine",
        }  # fmt: skip
    (place / "a.new.new.tex").replace(place / "a.tex")
    replace(place, {"a.tex": b"4"})
    assert {name for name in state(place) if name != WRITTEN} == {"a.tex", "a.new.tex", "s/c.tex"}


def test_a_pdf_or_a_page_beside_the_folder_is_kept_by_the_same_rule(tmp_path: Path) -> None:
    """A file that was edited, or is none of ours, stays; the new one is beside it, and its neighbours are as before."""
    (tmp_path / "other.pdf").write_text("of somebody")
    publish(files_of("1", "c.html"), tmp_path, "plain")
    publish({"single": {"page.html": b"1"}}, tmp_path, "page")
    publish(files_of("2", "c.html"), tmp_path, "plain")
    assert (tmp_path / "plain.pdf").read_bytes() == b"2"
    (tmp_path / "plain.pdf").write_text("mine")
    for version in ("3", "4"):
        with pytest.raises(AtlasError, match=r"plain\.pdf is not as atlas wrote it: the new one is plain\.new\.pdf"):
            publish(files_of(version, "c.html"), tmp_path, "plain")
        assert (tmp_path / "plain.pdf").read_text() == "mine"
        assert (tmp_path / "plain.new.pdf").read_text() == (tmp_path / "plain" / "a.html").read_text() == version
    with pytest.raises(AtlasError, match=r"other\.new\.pdf"):
        publish({"pdf": {"other.pdf": b"1"}}, tmp_path, "other")
    (tmp_path / "plain.new.pdf").replace(tmp_path / "plain.pdf")
    publish(files_of("5", "c.html"), tmp_path, "plain")
    publish({"single": {"page.html": b"2"}}, tmp_path, "page")
    assert (tmp_path / "plain.pdf").read_bytes() == b"5"
    assert (tmp_path / "page.html").read_bytes() == b"2"
    assert (tmp_path / "other.pdf").read_text() == "of somebody"


@pytest.mark.slow
def test_a_report_that_lost_its_record_is_built_again(tmp_path: Path) -> None:
    """Any file of a built report may be lost, also the one by which it is known as a report."""
    out = tmp_path / "out"
    build_report(report(tmp_path, "T"), out)
    before = state(out)
    (out / "plain" / MANIFEST).unlink()
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


class Killed(BaseException):
    """The end of a process."""


def files_of(version: str, extra: str) -> dict[str, dict[str, bytes]]:
    """Return the files of a report in two formats."""
    pages = {f"plain/{name}": version.encode() for name in ("a.html", "figures/b.svg", extra, "z.html")}
    return {"html": pages, "pdf": {"plain.pdf": version.encode()}}


def test_pages_take_their_places_at_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Killed before any step of publishing, a build leaves the pages of one build, and the next one heals it."""
    steps, limit, killed = [0], 0, True
    named = {b"old": "plain/c.html", b"new": "plain/d.html"}

    def counted(function: Any) -> Any:
        def step(*arguments: Any) -> Any:
            if steps[0] == limit:
                raise Killed
            steps[0] += 1
            return function(*arguments)

        return step

    publish(files_of("old", "c.html"), tmp_path, "plain")
    old = state(tmp_path)
    while killed:
        with monkeypatch.context() as patched:
            patched.setattr(Path, "replace", counted(Path.replace))
            patched.setattr(publishing, "exchange", counted(publishing.exchange))
            patched.setattr(shutil, "rmtree", lambda *_, **__: None)
            steps[0] = 0
            try:
                publish(files_of("new", "d.html"), tmp_path, "plain")
            except Killed:
                limit += 1
            else:
                killed = False
        files = {name: content for name, content in state(tmp_path).items() if name != "plain.pdf"}
        (version,) = set(files.values())
        assert files.keys() & set(named.values()) == {named[version]}
        publish(files_of("old", "c.html"), tmp_path, "plain")
        assert state(tmp_path) == old
        assert {path.name for path in tmp_path.iterdir()} == {WRITTEN, "plain", "plain.pdf"}
    assert limit >= 2


def test_pages_behind_a_link_are_written_there(tmp_path: Path) -> None:
    """Where the folder of the pages is a link it stays one, and stale files behind it go."""
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "plain").symlink_to(tmp_path / "elsewhere")
    for version, extra in (("old", "c.html"), ("new", "d.html")):
        publish(files_of(version, extra), tmp_path / "out", "plain")
    assert (tmp_path / "out" / "plain").is_symlink()
    assert {path.name for path in (tmp_path / "elsewhere").iterdir()} == {
        "a.html",
        "d.html",
        "figures",
        "z.html",
        WRITTEN,
    }
    assert (tmp_path / "elsewhere" / "a.html").read_bytes() == b"new"
