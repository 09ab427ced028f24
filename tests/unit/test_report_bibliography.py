"""The works that a report cites: by key from the prose, by author and year on the page and in print, listed once."""

from pathlib import Path

import pytest
from lxml import html
from pypdf import PdfReader

from atlas.build.report import build_report
from atlas.errors import AtlasError
from atlas.places import folder
from atlas.report import bibliography
from atlas.report.load import load
from atlas.report.texts import citations
from atlas.report.toml import find, names

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


def _write(where: Path, report: str = REPORT, works: str = WORKS) -> Path:
    (where / "works.bib").write_text(works, encoding="utf-8")
    (where / "cited.toml").write_text(report, encoding="utf-8")
    return where / "cited.toml"


def test_page_and_print_cite_alike(tmp_path: Path) -> None:
    """Author and year, in brackets or in the sentence, and the list holds what is cited and nothing else."""
    built = build_report(_write(tmp_path), tmp_path / "out")
    said = "As Klein (1897) says, tops spin (Euler 1765; Klein 1897, p. 3)."
    first, second = (html.parse(built.index.parent / name).getroot() for name in ("index.html", "sources.html"))
    assert said in " ".join(first.text_content().split())
    printed = " ".join(" ".join(page.extract_text() for page in PdfReader(built.pdf).pages).split())
    assert said in printed
    leads = [a.get("href") for a in first.iterfind(".//main//a")]
    assert leads == [f"sources.html#work-{key}" for key in ("klein1897", "euler1765", "klein1897")]
    assert [one.get("id") for one in second.iterfind(".//main//li")] == ["work-euler1765", "work-klein1897"]
    for words in (second.text_content(), printed):
        assert "Über den Kreisel" in words
        assert "Never" not in words


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("@klein1897 says", "@kelin1897 says", "klein1897"),
        ('kind = "bibliography"', 'kind = "prose", text = "None."', "'bibliography'"),
        ('bibliography = "works.bib"', 'bibliography = "work.bib"', "no file"),
        ('bibliography = "works.bib"\n', "", "BibTeX"),
        ("[@euler1765;", "[@(16);", "brackets of their own"),
        ("[@euler1765;", "[see @euler1765;", "lost in print"),
    ],
)
def test_what_is_wrong_with_a_citation_is_said(tmp_path: Path, old: str, new: str, says: str) -> None:
    """One sentence: the nearest key, the list that is missing, the file that is not there."""
    assert old in REPORT
    with pytest.raises(AtlasError, match=says):
        build_report(_write(tmp_path, REPORT.replace(old, new)), tmp_path / "out", formats=("html",))


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
