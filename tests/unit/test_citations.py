"""Equations are cited by the number that they have in print, everywhere, and the number leads to what computes them."""

import io
import re
import runpy
import tokenize
from collections.abc import Iterator
from pathlib import Path

import pytest
from agreement import Floor, Tie

from atlas.paper import EQUATIONS, topic
from atlas.paper.citation import cited, marked
from atlas.places import folder
from atlas.report.texts import citations

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
    """What the ledger does not have stays as it is written."""
    assert (
        marked("the hyperbola (67), $f (67)$, panel (105)", EQUATIONS) == "the hyperbola @(67), $f (67)$, panel (105)"
    )


def test_every_citation_of_the_sources_is_in_the_ledger() -> None:
    """Docstrings, messages, captions and comments of the package and of the recipes."""
    found = [(path.name, line, name) for path in SOURCES for line, text in words(path) for name in cited(text)]
    assert len({name for _, _, name in found}) > 150
    css = {"text-align"}
    assert [place for place in found if place[2] not in {*EQUATIONS, *css}] == []


@pytest.mark.parametrize("path", sorted((ROOT / "reports").glob("*.toml")), ids=lambda path: path.stem)
def test_every_equation_that_a_report_cites_is_in_the_ledger(path: Path) -> None:
    """What stands after the sign of citation and begins as the names of the ledger do."""
    names = {name for name in citations(path.read_text("utf-8")) if name.startswith(("(", "text-", "theorem-"))}
    assert names
    assert names <= set(EQUATIONS)


def test_no_label_of_the_source_stands_outside_the_ledger() -> None:
    """The aliases in `atlas/paper` and the test of these are the only places."""
    places = ["README.md", "CHANGELOG.md", "CONTRIBUTING.md", "Makefile"]
    files = [path for place in ("atlas", "figures", "reports", "templates") for path in (ROOT / place).rglob("*.*")]
    files += [ROOT / name for name in places]
    texts = {
        path: path.read_text("utf-8")
        for path in files
        if path.suffix in {".py", ".toml", ".md", ".html", ".typ", ".js", ".json"}
    }
    assert len(texts) > 300
    assert {path.name for path, text in texts.items() if LABEL.search(re.sub(r"alias=\S+", "", text))} == set()


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
    for floor in {floor for found, floor, _ in CASES if found == name}:
        homes = {home(floor, quantity) for found, at, quantity in CASES if (found, at) == (name, floor)}
        assert any(name in path.read_text("utf-8") for path in homes), (floor, homes)
    for floor in ("paper", "proof"):
        assert f'name="{name}"' in (ROOT / "atlas" / floor / f"{topic(name)}.py").read_text("utf-8")
