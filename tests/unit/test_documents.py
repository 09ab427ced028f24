"""README and CONTRIBUTING agree with the code."""

import io
import json
import re
import runpy
import shlex
import tokenize
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any, get_args

import click
import numpy as np
import pytest
from agreement import Floor, Tie
from benchmarks.readme import section
from packaging.version import Version

import atlas
from atlas.book.blocks import KINDS, Block
from atlas.book.files import files
from atlas.book.texts import citations
from atlas.cli.app import atlas as command_line
from atlas.pictures.drawing import animation
from atlas.places import folder
from atlas.trial.ledger import EQUATIONS, topic
from atlas.trial.ledger.citation import cited, marked

CHECKOUT = Path(__file__).resolve().parents[2]
README = (CHECKOUT / "README.md").read_text("utf-8")
GUIDE = (CHECKOUT / "reports" / "guide.md").read_text("utf-8")
EXAMPLES = [
    *re.findall(r"^    atlas (.+?)(?:\s{2,}#.*|\s+# .*)?$", README, re.MULTILINE),
    *re.findall(r'^  \["`atlas ([^`]+)`"', GUIDE, re.MULTILINE),
]


@pytest.mark.parametrize("words", EXAMPLES)
def test_command_lines_in_the_documents_are_valid(words: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each command line of the README, and of the list in the guide, is read without complaint."""
    monkeypatch.chdir(tmp_path)
    for file in re.findall(r"\w+\.csv", words):
        (tmp_path / file).touch()
    name, *arguments = shlex.split(words)
    parent = click.Context(command_line, info_name="atlas")
    assert command_line.commands[name].make_context(name, arguments, parent).params is not None


def test_every_command_has_an_example() -> None:
    """It stands in the README or in the list in the guide."""
    assert {words.split()[0] for words in EXAMPLES} == set(command_line.commands)


@pytest.mark.slow
def test_the_readme_in_python_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Python in the README runs as it stands; its animation has few frames here."""
    monkeypatch.setattr(animation, "FRAMES", 4)
    monkeypatch.chdir(tmp_path)
    (lines,) = re.findall(r"^```python\n(.*?)^```", README, re.MULTILINE | re.DOTALL)
    names: dict[str, Any] = {}
    exec(lines, names)  # noqa: S102  our own document
    assert names["R"].shape == (1_000_000, 3, 3)
    assert (tmp_path / "portrait.pdf").stat().st_size > 1000
    (animated,) = re.findall(r"^(\w+)\.animate\(", lines, re.MULTILINE)
    motion = names[animated]
    assert np.abs(motion.rotation(motion.period) - np.eye(3)).max() < 1e-14  # its last frame goes on to the first


def test_the_readme_quotes_the_benchmark() -> None:
    """Its section on alternatives is the one that follows from the record: `python -m benchmarks.readme` writes it."""
    assert section() in README


def test_every_kind_of_block_has_its_name() -> None:
    """CONTRIBUTING lists the kinds of blocks that stand in fences, and no other."""
    text = (CHECKOUT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    listed = text[text.index("The word in braces is") : text.index("`atlas/book/blocks`")]
    assert set(re.findall(r"`(\w+)`", listed)) == set(KINDS) - {"prose"}


def test_the_table_of_blocks_lists_all_block_kinds() -> None:
    """Each kind has its record under the name that is written in a file, and its templates; there is no other."""
    assert {kind: record_kind.record for kind, record_kind in KINDS.items()} == {
        block.__struct_config__.tag: block for block in get_args(Block)
    }
    for one in KINDS.values():
        for place in ("html",) if one.template == "ledger" else ("html", "typst"):  # the PDF has no ledger
            assert list((folder("templates") / place / "blocks").glob(f"{one.template}.*"))


def test_every_document_names_the_same_version_and_licence() -> None:
    """CITATION.cff and codemeta.json agree with the package, whose version hatchling takes; a release has its heading.

    Commits after one have a later version, of development.
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


ROOT = folder("figures").parent
SOURCES = [path for place in ("atlas", "figures") for path in sorted((ROOT / place).rglob("*.py"))]
LABEL = re.compile(r"\b(?:mf\d|The\.1\b|Aff100)")
TIES: list[Tie] = [
    tie
    for path in sorted(Path(__file__).parent.glob("test_agreement_*.py"))
    if not path.stem.endswith("register")
    for tie in runpy.run_path(str(path))["TIES"]
]


def words(path: Path) -> Iterator[tuple[int, str]]:
    """Go through the texts and comments of a module, each with its line."""
    with io.StringIO(path.read_text("utf-8")) as lines:
        for token in tokenize.generate_tokens(lines.readline):
            if token.type in {tokenize.STRING, tokenize.COMMENT}:
                yield token.start[0], token.string


def numbered(names: str) -> list[str]:
    """Return those of some names that are printed numbers."""
    return [name for name in names.split() if name.startswith("(")]


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ('"""Frequency of proper rotation phi(omega2), (72)."""', ["(72)"]),
        ("by (36) to (41), theorem-pair, and (36) again", ["(36)", "(41)", "theorem-pair"]),
        ("R(0) = 1, y'(0), f(x)(3), a[1](2), shape (3,) and (2, 3), (a), in 2024 (1234)", []),
        ("$x^{(2)} (3)$ and `value (4)`", []),
    ],
)
def test_a_citation_is_a_number_in_brackets_that_belongs_to_nothing(text: str, names: list[str]) -> None:
    """Arguments, shapes, powers, years, formulas and code cite nothing."""
    assert cited(text) == names


def test_a_caption_is_marked_where_the_ledger_has_the_number() -> None:
    """Names that the ledger lacks stay as written."""
    assert (
        marked("the hyperbola (67), $f (67)$, panel (105)", EQUATIONS) == "the hyperbola @(67), $f (67)$, panel (105)"
    )


@pytest.mark.slow
def test_every_citation_of_the_sources_is_in_the_ledger() -> None:
    """Docstrings, messages, captions and comments of the package and of the recipes."""
    citations = [(path.name, line, name) for path in SOURCES for line, text in words(path) for name in cited(text)]
    assert len({name for _, _, name in citations}) > 150
    css = {"text-align"}
    assert [place for place in citations if place[2] not in {*EQUATIONS, *css}] == []


@pytest.mark.parametrize("path", sorted(files().values()), ids=lambda path: path.stem)
def test_every_equation_that_a_report_cites_is_in_the_ledger(path: Path) -> None:
    """Words after the sign of citation that begin as the names of the ledger do."""
    names = {name for name in citations(path.read_text("utf-8")) if name.startswith(("(", "text-", "theorem-"))}
    assert names
    assert names <= set(EQUATIONS)


def test_no_label_of_the_source_stands_outside_the_ledger() -> None:
    """The aliases in `atlas/trial/ledger` and the test of these are the only places."""
    places = ["README.md", "CHANGELOG.md", "CONTRIBUTING.md", "Makefile"]
    files = [path for place in ("atlas", "figures", "reports", "templates") for path in (ROOT / place).rglob("*.*")]
    files += [ROOT / name for name in places]
    texts = {
        path: path.read_text("utf-8")
        for path in files
        if path.suffix in {".py", ".toml", ".md", ".html", ".typ", ".js", ".json"}
    }
    assert len(texts) > 300
    assert {path.name for path, text in texts.items() if LABEL.search(re.sub(r"alias = \S+", "", text))} == set()


def home(floor: str, quantity: str) -> Path:
    """Return the file of a floor in which a quantity is defined."""
    owner = quantity.partition(".")[0]
    try:
        module = Floor(floor).module(owner)
    except KeyError:
        return Path(str(getattr(Floor(floor), owner).__file__))
    return Path(str(module.__file__))


CASES = sorted({(name, floor, tie.quantity) for tie in TIES for floor in tie.floors for name in numbered(tie.names)})


@pytest.mark.parametrize("name", sorted({name for name, _, _ in CASES}, key=lambda name: int(name[1:-1])))
def test_the_number_leads_to_kernel_ball_entry_and_proof(name: str) -> None:
    """A search for the number finds a file of each floor that computes it, its entry, and its proof."""
    for floor in {floor for case_name, floor, _ in CASES if case_name == name}:
        homes = {
            home(floor, quantity)
            for case_name, case_floor, quantity in CASES
            if (case_name, case_floor) == (name, floor)
        }
        assert any(name in path.read_text("utf-8") for path in homes), (floor, homes)
    trial = ROOT / "atlas" / "trial"
    assert name in tomllib.loads((trial / "ledger" / f"{topic(name)}.toml").read_text("utf-8"))
    assert f'    "{name}": ' in (trial / "proofs" / f"{topic(name)}.py").read_text("utf-8")
