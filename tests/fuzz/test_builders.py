"""Commands that write files or serve, on any words: the result, or one line with status 2 and no file."""

import re
import shutil
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from test_commands import BASES, BUILDERS, EXAMPLES, bad, number, ran
from values import share

from atlas.cli.explorer.server import Explorer

RANGES = ["turns=1:3:2", "turns=1:3:3", "t=0:1:2", "turns=1:1e13:9" + "9" * 12, "turns=1:3:\u0663", "turns=1,2:3:2"]
LINES = {
    "page": [f"{name} {words}" for name, lines in EXAMPLES.items() for words in lines if "--times" not in words]
    + ["--ratio 1.3 --field 1 2 --omega2 0.7", "--shape ring --radius 1e-6 --mass 1e-15 --charge 2e-15 --field 1 2"]
    + ["--fit no_such.csv --sigma 0.1 --fix ratio=1.5 --predict 1", "fit no_such.csv"],
    "animate": [f"trochoids --dpi 20 --over {over}" for over in RANGES] + ["trochoids --dpi 20", "no_such"],
    "explore": ["--no-browser", "top --no-browser", "trochoids --no-browser", "no_such --no-browser"],
    "plot": ["no_such.csv t x", "/dev/null t x"],
    "tex": ["no_such", "no_such.toml"],
    "data": ["no_such", "no_such.toml"],
    "figure": [f"trochoids --for {target}" for target in ("aps", "poster", "elsevier-middle", "none", "", "beamer-x")],
}
"""Words of each command before they are changed; tex and data build reports, which test_reports changes."""

OPTIONS = {
    "page": ["--digits", "--title", "--times", "--only"],
    "animate": ["--fps", "--dpi", "--format", "--set", "--style", "--over"],
    "explore": ["--port"],
    "plot": ["--for", "--style"],
    "tex": ["--jobs"],
    "data": ["--jobs"],
    "figure": ["--format", "--set", "--style", "--for"],
}
WORDS = st.one_of(number, st.sampled_from(["gif", "svg", "pdf", "turns=2.5", "turns=1e400", "x=1", "99999", "-1", "2"]))


def test_every_builder_is_fuzzed() -> None:
    """A command that writes is drawn here, or has a file of its own in this folder."""
    assert set(LINES) - set(BASES) == BUILDERS - {"report", "sweep"}


@st.composite
def lines(draw: Any) -> list[str]:
    """Draw a command with its usual words, one in four numbers changed, and up to two options."""
    name = draw(st.sampled_from(list(LINES)))
    words = [name, *draw(st.sampled_from(LINES[name])).split(" ")]
    for i in range(1, len(words)):
        if re.fullmatch(r"-?\d[\d.e-]*", words[i]) and draw(st.integers(0, 3)) == 0:
            words[i] = draw(number)
    for option in draw(st.lists(st.sampled_from(OPTIONS[name]), max_size=2)):
        words += [option, draw(WORDS)]
    if draw(st.integers(0, 9)) == 0:
        words[draw(st.integers(1, len(words) - 1))] = draw(bad)
    return words


@share(0.01, 6)
@given(words=lines())
def test_any_words_give_files_or_a_one_line_error(tmp_path_factory: pytest.TempPathFactory, words: list[str]) -> None:
    """Files whole, in the folder that was named; a server that has an address."""
    out = Path(tmp_path_factory.mktemp("made"))
    if words[0] != "explore":
        words = [*words, "--out", str(out)]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Explorer, "serve_forever", lambda _: None)
        patch.setattr("webbrowser.open", lambda _: True)
        status, printed, err = ran(words)
    report = (words, status, printed[-300:], err)
    sizes = [path.stat().st_size for path in out.rglob("*") if path.is_file()]
    shutil.rmtree(out)
    assert status in {0, 2}, report
    assert "Traceback" not in err, report
    if status:
        assert err.count("\n") == 1, report
        assert len(err) < 1500, report
        assert not re.search(r"object at 0x|<class|Error:|errno|\x1b", err), report
        assert not sizes, report
    elif words[0] == "explore":
        assert printed.startswith("http://127.0.0.1:"), report
    else:
        assert sizes, report
        assert all(sizes), report
