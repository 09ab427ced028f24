"""The two volumes, the atlas and the paper on trial: what one cites and only the other has is found there."""

import re
from collections.abc import Iterator

import pytest

from atlas.paper import EQUATIONS
from atlas.paper.equation import slug
from atlas.report.compose import compose
from atlas.report.document import THEOREMS, Document
from atlas.report.load import load
from atlas.report.pictures import pictures
from atlas.report.texts import Link, citations
from atlas.report.toml import find, related_to

VOLUMES = ("atlas", "trial")


def outline(name: str, **related: Document) -> Document:
    """Return a report in outline."""
    report = load(find(name))
    return compose(report, pictures(report), related=related, outline=True)


@pytest.fixture(scope="module")
def volumes() -> dict[str, Document]:
    """Return both volumes, each with the other beside it."""
    alone = {name: outline(name) for name in VOLUMES}
    return {name: outline(name, **{one: alone[one] for one in VOLUMES if one != name}) for name in VOLUMES}


def cited(document: Document) -> Iterator[Link]:
    """Yield where each citation leads, but for works, and for cells, whose numbers are not computed here."""
    for text in document.texts.texts:
        for name in citations(text.markdown):
            if (name in EQUATIONS or ":" in name) and not name.startswith("cell:"):
                yield document.cite("html")(name, text.where)


def anchors(document: Document) -> set[tuple[str, str]]:
    """Return the places of a document that may be cited, as (file, anchor)."""
    places = {(file, anchor) for file, anchor, _ in document.targets.values()}
    return places | {(f"{page}.html", f"ledger-{slug(name)}") for name, page in document.ledger.items()}


def test_citations_across_the_volumes_lead_somewhere(volumes: dict[str, Document]) -> None:
    """Each link to the other volume is to a page and an anchor that are there."""
    for name, other in (VOLUMES, VOLUMES[::-1]):
        across = [link for link in cited(volumes[name]) if link.page.startswith("../")]
        assert across or name == "trial"
        for link in across:
            folder, _, file = link.page.removeprefix("../").partition("/")
            assert folder == other
            assert (file, link.anchor) in anchors(volumes[other]), link


def test_every_equation_of_the_paper_has_its_entry_in_the_trial(volumes: dict[str, Document]) -> None:
    """A display in the atlas leads to the ledger of the trial, and the entry knows the display."""
    atlas, trial = (volumes[name] for name in VOLUMES)
    shown = [name for name in atlas.targets if name in EQUATIONS and EQUATIONS[name].number]
    assert len(shown) > 10
    for label in shown:
        assert atlas.entry(label) == f"../trial/{trial.ledger[label]}"
        assert any(use.file.startswith("../atlas/") and use.words == "display" for use in trial.uses[label]), label


def test_what_stands_elsewhere_is_words_in_print(volumes: dict[str, Document]) -> None:
    """The PDF of one volume names the other where its pages have a link."""
    assert volumes["atlas"].cite("typst")("page:slips", "") == Link("Slips found in the paper")
    assert (
        volumes["trial"].cite("typst")("fig:lssc", "").words
        == "Figure 1 of An Atlas of a Charged Body in a Magnetic Field"
    )
    assert volumes["atlas"].cite("html")("report:trial", "")[:3] == (
        "The Paper on Trial",
        "../trial/index.html",
        "page-index",
    )


def test_a_theorem_has_one_number_in_all_reports(volumes: dict[str, Document]) -> None:
    """The theorems are numbered in the order of the ledger, whatever a report shows of them."""
    assert list(THEOREMS.values()) == [f"(T{number})" for number in range(1, len(THEOREMS) + 1)]
    for document in volumes.values():
        assert {label: document.number(label) for label in THEOREMS} == THEOREMS


def test_an_equation_that_is_cited_can_be_shown(volumes: dict[str, Document]) -> None:
    """The formula behind each number of the atlas is at hand, though its entry stands in the other volume."""
    atlas = volumes["atlas"]
    names = {name for text in atlas.texts.texts for name in citations(text.markdown) if name in EQUATIONS}
    assert names <= {*atlas.targets, *atlas.ledger, *atlas.formulas}
    assert not atlas.formulas.keys() & {*atlas.targets, *atlas.ledger}
    assert set(atlas.formulas) & set(volumes["trial"].ledger)


def test_the_volumes_are_built_from_one_another() -> None:
    """A build looks at the files beside its own."""
    assert "trial" in related_to(find("atlas"))
    assert "atlas" in related_to(find("trial"))


def test_the_atlas_is_about_physics() -> None:
    """What tries the paper and the program stands in the second volume; no sources of records in the first."""
    text = find("atlas").read_text(encoding="utf-8")
    assert not re.search(r'kind = "(recorded|errata)"', text)
