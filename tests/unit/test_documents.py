"""README and CONTRIBUTING say what there is."""

import json
import re
import shlex
import tomllib
from pathlib import Path
from typing import Any, get_args

import click
import pytest
from packaging.version import Version

import atlas
from atlas.cli.app import atlas as command_line
from atlas.draw import animation
from atlas.places import folder
from atlas.report.blocks import KINDS, Block

CHECKOUT = Path(__file__).resolve().parents[2]
README = (CHECKOUT / "README.md").read_text("utf-8")
GUIDE = (CHECKOUT / "reports" / "guide.toml").read_text("utf-8")
EXAMPLES = [
    *re.findall(r"^    atlas (.+?)(?:\s{2,}#.*|\s+# .*)?$", README, re.MULTILINE),
    *re.findall(r'^  \["`atlas ([^`]+)`"', GUIDE, re.MULTILINE),
]


@pytest.mark.parametrize("words", EXAMPLES)
def test_the_documents_type_what_the_command_line_takes(
    words: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each command line of the README, and of the list in the guide, is read without complaint."""
    monkeypatch.chdir(tmp_path)
    for name in ("mine", "coarse", "fine"):
        (tmp_path / f"{name}.csv").touch()
    name, *arguments = shlex.split(words)
    parent = click.Context(command_line, info_name="atlas")
    assert command_line.commands[name].make_context(name, arguments, parent).params is not None


def test_every_command_has_an_example() -> None:
    """It stands in the README or in the list in the guide."""
    assert {words.split()[0] for words in EXAMPLES} == set(command_line.commands)


def test_the_readme_in_python_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What the README types in Python runs as it stands; its animation has few frames here."""
    monkeypatch.setattr(animation, "FRAMES", 4)
    monkeypatch.chdir(tmp_path)
    (lines,) = re.findall(r"^```python\n(.*?)^```", README, re.MULTILINE | re.DOTALL)
    names: dict[str, Any] = {}
    exec(lines, names)  # noqa: S102  our own document
    assert names["R"].shape == (1_000_000, 3, 3)
    assert (tmp_path / "portrait.pdf").stat().st_size > 1000


@pytest.mark.parametrize(
    ("line", "method", "tolerance"),
    [
        ("`ElementaryMotion.rotation`", "ours", None),
        ("the formula in plain NumPy", "plain", None),
        ("heyoka, Taylor series, tolerance 1e-14", "heyoka", 1e-14),
        ("SciPy, DOP853, tolerance 1e-7", "DOP853", 1e-7),
    ],
)
def test_the_readme_quotes_the_benchmark(line: str, method: str, tolerance: float | None) -> None:
    """Errors and times of the README are those on record, to a factor of two."""
    record = json.loads((CHECKOUT / "reports" / "data" / "bench.json").read_text("utf-8"))
    (run,) = [
        one
        for one in record["runs"]
        if (one["case"], one["method"], one["horizon"], one.get("tolerance")) == ("elementary", method, 1e4, tolerance)
    ]
    ((error, milliseconds),) = re.findall(rf"^\| {re.escape(line)} \| (\S+) \| (\S+) ms \|$", README, re.MULTILINE)
    assert 0.5 < float(error) / run["error"] < 2
    assert 0.5 < float(milliseconds) / (1e3 * run["seconds"]) < 2


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
    """CITATION.cff and codemeta.json agree with the package, whose version hatchling takes; a release has its heading.

    What comes after one has a later version, of development.
    """
    project = tomllib.loads((CHECKOUT / "pyproject.toml").read_text("utf-8"))["project"]
    cited = dict(re.findall(r"^(\w+): (.+)$", (CHECKOUT / "CITATION.cff").read_text("utf-8"), re.MULTILINE))
    meta = json.loads((CHECKOUT / "codemeta.json").read_text("utf-8"))
    assert project["dynamic"] == ["version"]
    assert cited["version"] == meta["version"] == atlas.__version__
    assert cited["license"] == meta["license"].rpartition("/")[2] == project["license"]
    newest, *_ = re.findall(
        r"^## (?=.*\d)(.+?)(?: \(.*)?$", (CHECKOUT / "CHANGELOG.md").read_text("utf-8"), re.MULTILINE
    )
    current = Version(atlas.__version__)
    assert current > Version(newest) if current.is_devrelease else current == Version(newest)
