"""The atlas, the paper on trial and the guide: a citation of one that only another has is found there."""

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from lxml import html
from pypdf import PdfReader

from atlas.book import bibliography
from atlas.book.beside import RelatedReports
from atlas.book.blocks.explorer import Explorer
from atlas.book.building.report import build_report
from atlas.book.compose import compose
from atlas.book.document import THEOREMS, Document
from atlas.book.files import find, names, related_to
from atlas.book.load import load
from atlas.book.pictures import pictures
from atlas.book.texts import Link, citations
from atlas.errors import AtlasError
from atlas.places import folder
from atlas.trial.ledger import EQUATIONS
from atlas.trial.ledger.equation import slug

VOLUMES = ("atlas", "trial", "guide")


def outline(name: str, *related: Document) -> Document:
    """Return a report in outline."""
    report = load(find(name))
    return compose(
        report, pictures(report), related=RelatedReports(document.outline for document in related), outline=True
    )


@pytest.fixture(scope="module")
def volumes() -> dict[str, Document]:
    """Return the volumes, each with the others beside it."""
    outlines_alone = {name: outline(name) for name in VOLUMES}
    return {
        name: outline(name, *(outlines_alone[name_linked] for name_linked in VOLUMES if name_linked != name))
        for name in VOLUMES
    }


def cited(document: Document) -> Iterator[Link]:
    """Yield where each citation leads, but for works, and for cells, whose numbers are not computed here."""
    for text in document.texts.texts:
        for name in citations(text.markdown):
            if (name in EQUATIONS or ":" in name) and not name.startswith("cell:"):
                yield document.cite("html")(name, text.place)


def anchors(document: Document) -> set[tuple[str, str]]:
    """Return the places of a document that may be cited, as (file, anchor)."""
    places = {(file, anchor) for file, anchor, _ in document.targets.values()}
    return places | {(f"{page}.html", f"ledger-{slug(name)}") for name, page in document.ledger.items()}


def test_citations_across_the_volumes_lead_somewhere(volumes: dict[str, Document]) -> None:
    """Each link to another volume is to a page and an anchor that are there."""
    for name in ("atlas", "trial"):  # the guide has reports as examples, with citations of their own
        links_out = [link for link in cited(volumes[name]) if link.page.startswith("../")]
        assert links_out or name == "trial"
        for link in links_out:
            volume, _, file = link.page.removeprefix("../").partition("/")
            assert (file, link.anchor) in anchors(volumes[volume]), link


def test_every_equation_of_the_paper_has_its_entry_in_the_trial(volumes: dict[str, Document]) -> None:
    """A display in the atlas leads to the ledger of the trial, and the entry knows the display."""
    atlas, trial = volumes["atlas"], volumes["trial"]
    names = [name for name in atlas.targets if name in EQUATIONS and EQUATIONS[name].number]
    assert len(names) > 10
    for label in names:
        assert atlas.entry(label) == f"../trial/{trial.ledger[label]}"
        assert any(use.file.startswith("../atlas/") and use.words == "display" for use in trial.uses[label]), label


def test_references_to_other_volumes_are_words_in_print(volumes: dict[str, Document]) -> None:
    """The PDF of one volume names the other where its pages have a link."""
    assert volumes["atlas"].cite("typst")("page:slips", "") == Link("Slips found in the paper")
    assert volumes["trial"].cite("typst")("fig:lssc", "").words == "Figure 1 of An Atlas of Turning Bodies"
    assert volumes["atlas"].cite("html")("report:trial", "")[:3] == (
        "The Paper on Trial",
        "../trial/index.html",
        "page-index",
    )


def test_the_summary_has_the_steps_of_the_front_page_on_two_sides(tmp_path: Path) -> None:
    """Its heads are the titles of the five steps, and its PDF has two pages."""
    steps = next(block.steps for block in load(find("atlas")).pages[0].blocks if isinstance(block, Explorer))
    summary = (folder("reports") / "summary.md").read_text("utf-8")
    assert re.findall(r"^## (.*)$", summary, re.MULTILINE) == [step.title for step in steps]
    build_report(find("summary"), tmp_path, formats=("pdf",))
    assert len(PdfReader(tmp_path / "summary.pdf").pages) == 2


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
    """Trials of the paper and the program stand in the second volume; no sources of records in the first."""
    text = find("atlas").read_text(encoding="utf-8")
    assert not re.search(r'kind = "(recorded|errata)"', text)


WORKS = """
@article{klein1897, author={Klein, Felix}, title={Über den Kreisel}, journal={Annalen}, year={1897}, langid={german}}
@book{euler1765, author={Euler, Leonhard}, title={Theoria motus}, publisher={Röse}, year={1765}, langid={latin}}
@book{unread1900, author={Unread, U.}, title={Never}, publisher={Nobody}, year={1900}}
"""
REPORT = """
name = "cited"
title = "Cited"
bibliography = "works.bib"

[[pages]]
slug = "index"
title = "One"
blocks = [
  { kind = "prose", text = "As @klein1897 says, tops spin [@euler1765; @klein1897, p. 3]." },
]

[[pages]]
slug = "sources"
title = "Two"
blocks = [
  { kind = "bibliography" },
]
"""


def _write(folder: Path, report: str = REPORT, works: str = WORKS) -> Path:
    (folder / "works.bib").write_text(works, encoding="utf-8")
    (folder / "cited.toml").write_text(report, encoding="utf-8")
    return folder / "cited.toml"


@pytest.mark.slow
def test_page_and_print_cite_alike(tmp_path: Path) -> None:
    """Author and year, in brackets or in the sentence, and the list holds the cited works and nothing else."""
    built = build_report(_write(tmp_path), tmp_path / "out")
    citation = "As Klein (1897) says, tops spin (Euler 1765; Klein 1897, p. 3)."
    first, second = (html.parse(built.index.parent / name).getroot() for name in ("index.html", "sources.html"))
    assert citation in " ".join(first.text_content().split())
    printed = " ".join(" ".join(page.extract_text() for page in PdfReader(built.pdf).pages).split())
    assert citation in printed
    leads = [a.get("href") for a in first.iterfind(".//main//a")]
    assert leads == [f"sources.html#work-{key}" for key in ("klein1897", "euler1765", "klein1897")]
    assert [element.get("id") for element in second.iterfind(".//main//li")] == ["work-euler1765", "work-klein1897"]
    for words in (second.text_content(), printed):
        assert "Über den Kreisel" in words
        assert "Never" not in words


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        pytest.param("@klein1897 says", "@kelin1897 says", "klein1897", marks=pytest.mark.slow),
        ('kind = "bibliography"', 'kind = "prose", text = "None."', "'bibliography'"),
        ('bibliography = "works.bib"', 'bibliography = "work.bib"', "no file"),
        pytest.param('bibliography = "works.bib"\n', "", "BibTeX", marks=pytest.mark.slow),
        pytest.param("[@euler1765;", "[@(16);", "brackets of their own", marks=pytest.mark.slow),
        ("[@euler1765;", "[see @euler1765;", "lost in print"),
    ],
)
def test_faults_of_a_citation_are_reported(tmp_path: Path, old: str, new: str, says: str) -> None:
    """One sentence: the nearest key, the list that is missing, the file that is not there."""
    assert old in REPORT
    with pytest.raises(AtlasError, match=says):
        build_report(_write(tmp_path, REPORT.replace(old, new)), tmp_path / "out", formats=("html",))


@pytest.mark.slow
def test_a_file_that_is_no_bibliography_is_refused(tmp_path: Path) -> None:
    """Nothing in it, or an entry that breaks off."""
    for works in ("", "@article{x, author="):
        with pytest.raises(AtlasError):
            build_report(_write(tmp_path, works=works), tmp_path / "out", formats=("html",))


def test_every_work_of_the_atlas_is_cited() -> None:
    """The file holds no entry that no report cites, and each has an author, a title and a year."""
    works = bibliography.read(folder("reports") / "references.bib")
    reports = [load(find(name)) for name in names()]
    texts = [getattr(block, "text", "") for report in reports for page in report.pages for block in page.blocks]
    cited = {key for text in texts for key in citations(text)}
    assert set(works.named) <= cited
    assert all(any(character.isdigit() for character in words) for words in works.bracketed.values())
