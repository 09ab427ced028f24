"""Texts that would take pandoc for ever, or Python too deep, end at once in a sentence; code is printed as it is."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from click.testing import CliRunner

from atlas import programs
from atlas.book import pandoc, toml
from atlas.book.load import load
from atlas.book.texts import MAX_DEPTH, Link, Texts, deepest
from atlas.cli.app import atlas
from atlas.errors import AtlasError


def set_in_typst(*texts: str) -> list[str]:
    """Return texts as Typst."""
    made = Texts()
    for text in texts:
        made.add(text, "here")
    return made.set({"typst": lambda name, _: Link(name)})["typst"]


def test_a_text_may_be_nested_ten_deep() -> None:
    """A formula with ten levels of braces is set, one with eleven refused."""
    ten, eleven = (f"${'x^{' * count}x{'}' * count}$" for count in (10, 11))
    assert set_in_typst(ten)
    with pytest.raises(AtlasError, match=r"nested more than 10 deep"):
        set_in_typst(eleven)


@pytest.mark.parametrize(
    "text",
    [
        "[" * 22,
        "a [" * 22 + "]" * 22,
        "$" + "x^{" * 22 + "x" + "}" * 22 + "$",
        ">" * 3000 + " a",
        "> " * 300 + "a",
        "\n".join("    " * n + "- a" for n in range(300)),
    ],
)
def test_a_text_nested_too_deeply_is_refused_at_once(text: str) -> None:
    """Pandoc's time doubles with each level: beyond ten the text is refused, with its place."""
    with pytest.raises(AtlasError, match=rf"^here: .* {MAX_DEPTH} deep"):
        set_in_typst(text)


def test_ordinary_nesting_is_accepted() -> None:
    """Escaped brackets, brackets of other paragraphs, and a handful of levels are no matter."""
    assert deepest("\\[" * 30) == deepest("") == 0
    assert deepest("[0, 1)\n\n" * 30) == 1
    assert deepest("> > a\n> > > b") == 3
    assert deepest("- a\n    - b\n        1. c") == 2
    assert deepest("$x^{y^{z}}$ and $" + "{a}" * 50 + "$") == 2


@pytest.mark.slow
def test_a_text_that_pandoc_cannot_finish_ends_in_a_sentence(monkeypatch: pytest.MonkeyPatch) -> None:
    """Thirty open brackets, unless they are refused before: pandoc is ended after its seconds, or with its memory."""
    monkeypatch.setattr(pandoc, "SECONDS", 1)
    with pytest.raises(AtlasError, match="1 seconds"):
        pandoc.read([("[" * 30, False)])
    monkeypatch.setattr(pandoc, "MEMORY", "64m")
    with pytest.raises(AtlasError, match="64 MB"):
        pandoc.run(["-f", "markdown", "-t", "json"], "a *b* " * 100_000)


@pytest.mark.skipif(sys.platform != "linux", reason="prctl(2) is Linux'")
def test_a_program_that_we_start_ends_when_we_are_killed(tmp_path: Path) -> None:
    """A process that runs another by `programs.run` is killed: the other is gone, too."""
    file = tmp_path / "pid"
    inner = f"import os, pathlib, time; pathlib.Path({str(file)!r}).write_text(str(os.getpid())); time.sleep(60)"
    outer = f"import sys; from atlas import programs; programs.run([sys.executable, '-c', {inner!r}], 30)"
    parent = subprocess.Popen([sys.executable, "-c", outer])
    deadline = time.monotonic() + 60
    while not (file.exists() and file.read_text()) and time.monotonic() < deadline:
        time.sleep(0.02)
    child = int(file.read_text())
    parent.send_signal(signal.SIGKILL)
    parent.wait()
    while _runs(child) and time.monotonic() < deadline:
        time.sleep(0.02)
    assert not _runs(child)


def _runs(process: int) -> bool:
    """Whether a process runs, and is not only waiting to be collected."""
    try:
        return "\nState:\tZ" not in Path(f"/proc/{process}/status").read_text()
    except (FileNotFoundError, ProcessLookupError):
        return False


@pytest.mark.slow
def test_a_program_has_no_more_than_its_seconds() -> None:
    """One that computes without end is ended after a second of a processor; one that ends well names its files."""
    with pytest.raises(subprocess.TimeoutExpired):
        programs.run([sys.executable, "-c", "while True: pass"], 1)
    assert programs.run([sys.executable, "-c", "print(input())"], 30, "word").stdout == f"word{os.linesep}"


def test_toml_nested_too_deeply_is_a_mistake_in_one_line(tmp_path: Path) -> None:
    """3000 brackets: a report says so in one line, and `toml.loads` raises the error of any other mistake."""
    file = tmp_path / "deep.toml"
    file.write_text("a = " + "[" * 3000 + "]" * 3000)
    with pytest.raises(ValueError, match="too deeply"):
        toml.loads(file.read_text())
    with pytest.raises(AtlasError, match="too deeply"):
        load(file)
    outcome = CliRunner().invoke(atlas, ["report", str(file)])
    assert not isinstance(outcome.exception, RecursionError)


def test_code_is_printed_as_it_stands() -> None:
    """The repair of bars and spaces of formulas leaves code and words alone, and still mends formulas beside them."""
    span, words, block, formula = set_in_typst(
        r"`grep 'a\|b\|c'` and `#h(0em)`",
        r"#h(0em) and \\\| a \\\|",
        "```\ngrep 'a\\|b\\|' #h(-1em)\n```",
        r"$a\;b\!c$",
    )
    assert span == r"`grep 'a\|b\|c'` and `#h(0em)`"
    assert words == r"\#h(0em) and \\| a \\|"
    assert block == "```\ngrep 'a\\|b\\|' #h(-1em)\n```"
    assert formula == "$a #h(0.278em) b #h(-0.167em) c$"
