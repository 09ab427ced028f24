"""The command line on any words: JSON or a table, or one line with status 2; no traceback, no NaN without reason."""

import json
import re
import sys
from pathlib import Path
from typing import Any

import click
import pytest
from click.testing import CliRunner
from hypothesis import given
from hypothesis import strategies as st
from values import share, watched

from atlas.cli.app import atlas, main
from atlas.motions.register import FAMILIES

BUILDERS = {"animate", "data", "explore", "page", "plot", "report", "sweep", "tex"}
"""Commands that write files or run for long: they have tests of their own."""

COMMANDS: dict[str, click.Command] = {
    name: command.loaded() for name, command in atlas.commands.items() if name not in BUILDERS
}
ordinary = st.sampled_from(
    ["1", "1.5", "0.5", "2", "-1", "-2", "0", "0.7", "3/2", "1e-3", "0x1.8p0", "-0", "12", "1e3"]
)
extreme = st.sampled_from(
    ["1e308", "-1e308", "1e-308", "5e-324", "1e160", "1e-160", "1e200", "-1e-200", "1e15", "1e30", "4e9"]
)
words = "nan inf -inf 1e999 1e-9999 1e-99999 1_0 x 1,2 -- - 1/0 0x \\d 1e $HOME ../.. {} --json=1 None é \u0661".split()
bad = st.sampled_from([*words, "", " ", "9" * 5000, "\x1b[2J", "a\nb"])
number = st.one_of(ordinary, ordinary, ordinary, ordinary, extreme, extreme, bad)
EXAMPLES: dict[str, list[str]] = {}
for f in FAMILIES.values():
    if f.command and f.at_once > 1:  # a motion alone takes seconds: test_asymmetric has its command
        EXAMPLES.setdefault(f.command.name, []).extend(
            example.removeprefix(f"atlas {f.command.name} ") for example in f.command.examples
        )
"""Every family's command, as its help shows it."""

BASES = EXAMPLES | {
    "hyperbola": ["--ratio 1.5 --field 1 2"],
    "check": ["FILE --ratio 1.5 --field 1 2 --omega2 0.7"],
    "fit": ["FILE"],
    "figure": [""],
    "list": [""],
    "verify": ["999"],
}
NEVER = {
    "--out",
    "--page",
    "--figure",
    "--store",
    "--record",
    "--all",
    "--explain",
    "--jobs",
    "-j",
    "--anew",
}
"""Options that write or start processes: they have tests of their own."""


@st.composite
def lines(draw: Any) -> list[str]:
    """Draw a command with its usual words, some of them changed, and options of its own or of others."""
    name = draw(st.sampled_from([*BASES, *EXAMPLES]))
    words = [name, *draw(st.sampled_from(BASES[name])).split()]
    for i in range(1, len(words)):
        if re.fullmatch(r"-?\d[\d.e-]*", words[i]) and draw(st.integers(0, 3)) == 0:
            words[i] = draw(number)
    options = [option for option in COMMANDS[name].params if isinstance(option, click.Option)]
    for option in draw(st.lists(st.sampled_from(options), max_size=3)):
        if set(option.opts) & NEVER:
            continue
        words.append(option.opts[0])
        if not option.is_flag:
            kinds = option.type.choices if isinstance(option.type, click.Choice) else None
            value = st.one_of(st.sampled_from(kinds), number) if kinds else number
            words += draw(st.lists(value, min_size=max(0, option.nargs - 1), max_size=option.nargs + 1))
    if draw(st.integers(0, 9)) == 0:
        words[draw(st.integers(0, len(words) - 1))] = draw(bad)
    if draw(st.integers(0, 2)) == 0:
        words.append("--json")
    return words


def ran(words: list[str]) -> tuple[int, str, str]:
    """Run the program inside this process, as a terminal would; return status, standard output and error."""
    with CliRunner().isolation() as (out, err, _), watched(), pytest.MonkeyPatch.context() as patch:
        patch.setattr(sys, "argv", ["atlas"])
        try:
            main(words)
        except SystemExit as end:
            status = int(end.code or 0)
        sys.stdout.flush()
        sys.stderr.flush()
        return status, out.getvalue().decode(), err.getvalue().decode()


def test_a_command_that_never_ends_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    """The program turns errors into lines, but not this one."""

    def never(**_: Any) -> None:
        while True:
            pass

    monkeypatch.setattr("values.SECONDS", 0.05)
    monkeypatch.setattr(COMMANDS["list"], "callback", never)
    with pytest.raises(AssertionError, match="ran for more than"):
        ran(["list"])


def test_every_command_is_fuzzed() -> None:
    """A new command joins by itself if it is a family's, and is named here else."""
    assert set(BASES) == set(COMMANDS)
    assert all(EXAMPLES.values())


def checked(words: list[str]) -> None:
    """Check an answer against the laws of every answer."""
    status, out, err = ran(words)
    report = (words, out[-300:], err)
    assert "Traceback" not in err, report
    assert status in {0, 1, 2}, report
    if status == 2:
        assert out == "", report
        assert err.count("\n") == 1 or err.startswith("Usage:"), report
        assert len(err) < 1500 or err.startswith("Usage: atlas [OPTIONS] COMMAND"), report  # the list of all commands
        assert "\x1b" not in err, report
        assert not re.search(r"object at 0x|<class|Error:|errno", err), report
    elif "--json" in words and out:
        record = json.loads(out, parse_constant=lambda name: pytest.fail(f"{name} in JSON: {report}"))
        nulls = json.dumps(record).count("null")
        assert (
            nulls == 0 or "missing" in record or '"drift": null' in out or words[0] in {"check", "hyperbola", "list"}
        ), report
    assert "nan" not in out.lower(), report


@pytest.mark.slow
@share(0.7, 60)
@given(lines())
def test_any_words_get_an_answer_or_one_line(words: list[str]) -> None:
    """Numbers, their absence, and options in any order."""
    checked([word.replace("FILE", "nosuch.csv") for word in words])


cells = st.one_of(number, st.sampled_from(["0", "1", "0.5", "-1", "1."]))
NAMES = [
    "t",
    "T",
    "time",
    "R11",
    "r_12",
    "R33",
    "Omega1",
    "omega_2",
    "Omega3",
    "w",
    "x",
    "y",
    "z",
    "q0",
    "R44",
    "",
    "'R13'",
]
HEADS = """# ratio = 1.5|# field = 1 2|# field: 1, 2|# omega2 = 0.7|# inertia = 2 3|# ratio: see||# field = 1|#
|# omega3 = x|# ratio = 1e999|\ufeff|# omega2 = -1|# field = 1e200 1e200""".split("|")


@st.composite
def files(draw: Any) -> bytes:
    """Draw a CSV file: parameters, names, rows, and misplaced content."""
    head = draw(
        st.lists(
            st.sampled_from(HEADS),
            max_size=5,
        )
    )
    names = draw(
        st.one_of(st.just(["t", "R11", "Omega1"]), st.just(["t", "w", "x", "y", "z"]), st.lists(st.sampled_from(NAMES)))
    )
    comma = draw(st.sampled_from([",", ";", " ", "\t"]))
    count = st.just(len(names)) if draw(st.integers(0, 3)) else st.integers(0, 5)
    rows = [comma.join(draw(cells) for _ in range(draw(count))) for _ in range(draw(st.integers(0, 5)))]
    text = draw(st.sampled_from(["\n", "\r\n", "\r"])).join([*head, comma.join(names), *rows])
    encoding = draw(st.sampled_from(["utf-8"] * 8 + ["utf-16", "utf-8-sig"]))
    return text.encode(encoding, errors="replace") + draw(st.sampled_from([b"", b"\n", b"\xff", b"\x00"]))


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder for the files."""
    return tmp_path_factory.mktemp("fuzz")


@pytest.mark.slow
@share(0.2, 40)
@given(content=files(), given_too=st.booleans(), as_json=st.booleans())
def test_any_file_is_graded_or_refused(folder: Path, content: bytes, *, given_too: bool, as_json: bool) -> None:
    """A CSV file of any content."""
    file = folder / "mine.csv"
    file.write_bytes(content)
    options = "--ratio 1.5 --field 1 2 --omega2 0.7".split() if given_too else []
    checked(["check", str(file), *options, *(["--json"] if as_json else [])])


@share(0.1, 15)
@given(
    st.lists(
        st.one_of(
            st.sampled_from(sorted(set(BASES) - {"verify"})),
            bad,
            st.sampled_from(["--help", "-h", "--version"]),
        )
    )
)
def test_any_command_line_has_an_answer(words: list[str]) -> None:
    """Commands that are none, help anywhere, nothing at all."""
    checked(words)
