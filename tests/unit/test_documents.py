"""README and CONTRIBUTING say what there is."""

import json
import re
import shlex
import tomllib
from pathlib import Path
from typing import get_args

import click
import pytest

from atlas.cli.app import atlas as command_line
from atlas.places import folder
from atlas.report.blocks import KINDS, Block

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
    listed = text[text.index("A block's `kind` is") : text.index("`atlas/report/blocks`")]
    assert set(re.findall(r"`(\w+)`", listed)) - {"kind"} == set(KINDS)


def test_the_table_of_blocks_is_what_a_page_may_hold() -> None:
    """Each kind has its record under the name that is written in a file, and its templates; there is no other."""
    assert {kind: one.record for kind, one in KINDS.items()} == {
        block.__struct_config__.tag: block for block in get_args(Block)
    }
    for one in KINDS.values():
        for place in ("html", "typst"):
            assert list((folder("templates") / place / "blocks").glob(f"{one.template}.*"))


def test_every_document_names_the_same_version_and_licence() -> None:
    """CITATION.cff, codemeta.json and the changelog agree with pyproject.toml."""
    project = tomllib.loads((CHECKOUT / "pyproject.toml").read_text("utf-8"))["project"]
    cited = dict(re.findall(r"^(\w+): (.+)$", (CHECKOUT / "CITATION.cff").read_text("utf-8"), re.MULTILINE))
    meta = json.loads((CHECKOUT / "codemeta.json").read_text("utf-8"))
    assert cited["version"] == meta["version"] == project["version"]
    assert cited["license"] == meta["license"].rpartition("/")[2] == project["license"]
    assert f"## {project['version']}" in (CHECKOUT / "CHANGELOG.md").read_text("utf-8")
