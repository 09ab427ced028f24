"""README and CONTRIBUTING say what there is."""

import re
import shlex
from pathlib import Path
from typing import get_args

import click
import pytest

from atlas.cli.app import atlas as command_line
from atlas.report.records import Block

CHECKOUT = Path(__file__).resolve().parents[2]
EXAMPLES = re.findall(
    r"^    atlas (.+?)(?:\s{2,}#.*|\s+# .*)?$", (CHECKOUT / "README.md").read_text("utf-8"), re.MULTILINE
)


@pytest.mark.parametrize("words", EXAMPLES)
def test_the_readme_types_what_the_command_line_takes(
    words: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each command line of the README is read without complaint."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.csv").touch()
    name, *arguments = shlex.split(words)
    parent = click.Context(command_line, info_name="atlas")
    assert command_line.commands[name].make_context(name, arguments, parent).params


def test_there_are_examples_in_the_readme() -> None:
    """Every command but those that `make` runs has one."""
    assert {words.split()[0] for words in EXAMPLES} == set(command_line.commands) - {"list", "bench", "stress"}


def test_every_kind_of_block_has_its_name() -> None:
    """CONTRIBUTING lists the kinds of blocks that a report may have, and no other."""
    text = (CHECKOUT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    listed = text[text.index("A block's `kind` is") : text.index("`atlas/report/records.py`")]
    kinds = {block.__struct_config__.tag for block in get_args(Block)}
    assert set(re.findall(r"`(\w+)`", listed)) - {"kind"} == kinds
