"""The ledger and the errata in a report: every entry with its verdict, every use linked both ways."""

import json
import re
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import unquote

import pytest
from lxml import html as reader
from pypdf import PdfReader

from atlas.book.appendices import Appendices, Finding
from atlas.book.blocks import ledger as trial
from atlas.book.building import records as appendices
from atlas.book.building.records import gather
from atlas.book.building.report import Built, build_report
from atlas.book.compose import compose
from atlas.book.load import load
from atlas.book.tables.table import Data
from atlas.errors import AtlasError
from atlas.trial.ledger import EQUATIONS
from atlas.trial.ledger.equation import slug
from atlas.trial.proofs import recorded
from atlas.trial.proofs.verdict import GRADES

HEAD = r"""
name = "mine"
title = "A Small Report"

[parameters]
bodies.ball = { title = "ball", ratio = 1.0 }
fields.up = { title = "oblique field", prime = [1.0, 2.0] }
sets.one = { omega2 = [0.7] }

[[pages]]
slug = "index"
title = "The first page"
blocks = [
  { kind = "prose", text = "By @(72) and again @(72), the theorem @theorem-points, in words @text-ball-limit." },
  { kind = "equation", name = "(71)" },
  { kind = "equation", name = "theorem-ball-line" },
  { kind = "note", text = "See @theorem-ball-line and `@(89)`." },
  { kind = "table", table = "points", id = "points", body = "ball", field = "up", caption = "@(67)", sets = ["one"] },
]

[[pages]]
slug = "slips"
title = "Slips"
blocks = [
  { kind = "errata" },
]
"""
LEDGER = "\n".join(
    f'[[pages]]\nslug = "ledger-{section.lower()}"\ntitle = "Section {section}"\npart = "Ledger"\n'
    f'blocks = [{{ kind = "ledger", section = "{section}" }}]\n'
    for section in ("II", "III", "IV", "V", "VII", "Atlas")
)
RECORDED = """
[[pages]]
slug = "records"
title = "Records"
blocks = [
  { kind = "recorded", source = "trial", table = "totals" },
  { kind = "recorded", source = "bench", table = "Limits of speed" },
  { kind = "recorded", source = "stress", table = "worst errors" },
]
"""


@pytest.fixture(scope="module")
def toml(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Write the report's file."""
    file = tmp_path_factory.mktemp("source") / "mine.toml"
    file.write_text(HEAD + LEDGER + RECORDED, encoding="utf-8")
    return file


@pytest.fixture(scope="module")
def built(toml: Path, tmp_path_factory: pytest.TempPathFactory) -> Built:
    """Build the report once."""
    return build_report(toml, tmp_path_factory.mktemp("out"))


@pytest.fixture(scope="module")
def pages(built: Built) -> dict[str, reader.HtmlElement]:
    """Parse each page."""
    return {
        path.name: reader.fromstring(path.read_text(encoding="utf-8")) for path in built.index.parent.glob("*.html")
    }


def entries(pages: dict[str, reader.HtmlElement]) -> Iterator[tuple[str, str, reader.HtmlElement]]:
    """Go through the entries of the ledger: name, page, element."""
    for name, page in pages.items():
        for element in page.xpath("//section[starts-with(@id, 'ledger-')]"):
            anchor = element.get("id").removeprefix("ledger-")
            yield f"({anchor})" if anchor.isdecimal() else anchor, name, element


def links(element: reader.HtmlElement, page: str) -> list[tuple[str, str]]:
    """Return the file and anchor of each link inside an element."""
    targets = [unquote(link).partition("#") for link in element.xpath(".//@href")]
    return [(file or page, anchor) for file, _, anchor in targets]


def test_every_entry_stands_once_with_its_verdict(pages: dict[str, reader.HtmlElement]) -> None:
    """All entries of the ledger are there, each with the verdict on record and the number in print."""
    verdicts = recorded.load()
    elements = {name: element for name, _, element in entries(pages)}
    assert Counter(name for name, _, _ in entries(pages)) == Counter(list(EQUATIONS))
    for name, element in elements.items():
        (verdict_span,) = element.xpath(".//h2/span[contains(@class, 'verdict')]")
        assert verdict_span.text_content() == ", ".join(filter(None, (verdicts[name].verdict, verdicts[name].grade)))
        heading = element.xpath("string(.//h2)")
        assert name in heading
        assert element.xpath(".//*[local-name()='math']")


def test_every_entry_repeats_the_paper_and_the_record(pages: dict[str, reader.HtmlElement]) -> None:
    """Claim, quotation, assumptions, method and note of each entry stand in it, each at its place, to the first markup.

    So does the verdict of a corrected form, where there is one.
    """
    verdicts = recorded.load()
    for name, _, element in entries(pages):
        entry, verdict = EQUATIONS[name], verdicts[name]
        how = verdict.method + (f", from {verdict.follows}" if verdict.follows else "")
        places = {
            "string(./p[@class='says'])": entry.says,
            "string(./p[@class='quote'])": f"“{entry.quote}" if entry.quote else "",
            "string(./dl/dd[1])": "; ".join(entry.assumptions) or "no assumptions of its own.",
            "string(./dl/dd[2])": how,
            "substring-after(./dl/dd[2], '. ')": verdict.note,
        }
        for place, text in places.items():
            beginning = re.split(r"[$*`@\[_^<'\"]", text)[0].strip()
            assert element.xpath(place).replace("\N{NO-BREAK SPACE}", " ").startswith(beginning), (name, place)
        corrected = element.xpath("./dl/dt[.='Corrected']/following-sibling::dd[1]")
        assert len(corrected) == bool(verdict.corrected_tex), name
        assert all(paragraph.text.startswith(verdict.corrected_verdict) for paragraph in corrected), name


def test_the_script_of_an_entry_stands_under_a_fold(pages: dict[str, reader.HtmlElement]) -> None:
    """Each entry has its recorded script, letter by letter, in a fold; or the line that says why there is none."""
    scripts = recorded.scripts()
    for name, _, element in entries(pages):
        folds = element.xpath("./details[@class='script'][summary]/pre/code | ./p[@class='script']")
        assert [fold.text_content() for fold in folds] == [scripts[name]], name
        assert (folds[0].tag == "code") == scripts[name].startswith("#"), name


def test_every_use_and_its_entry_link_to_each_other(pages: dict[str, reader.HtmlElement]) -> None:
    """From the entry to the place that uses it, and from there back to the entry; no use is forgotten."""
    uses = set()
    for name, page, element in entries(pages):
        for file, anchor in links(element.xpath(".//dl")[0], page):
            if file != "index.html":
                continue
            (place,) = pages[file].xpath(f"//*[@id='{anchor}']")
            assert (page, f"ledger-{slug(name)}") in links(place, file)
            uses.add(name)
    assert uses == {"(72)", "theorem-points", "text-ball-limit", "(71)", "theorem-ball-line", "(67)"}
    cited = {anchor for _, anchor in links(pages["index.html"], "index.html") if anchor.startswith("ledger-")}
    assert cited == {f"ledger-{slug(name)}" for name in uses}


def test_modules_that_cite_an_entry_are_named(pages: dict[str, reader.HtmlElement]) -> None:
    """The frequency of proper rotation is computed where the docstrings say so."""
    (found,) = [element for name, _, element in entries(pages) if name == "(72)"]
    assert "motions/elementary/kernel_hyperbola.py" in found.xpath(".//code/text()")


def test_every_refuted_claim_is_in_the_errata_with_its_counterexample(pages: dict[str, reader.HtmlElement]) -> None:
    """As many errata as entries with a slip, the grave ones first; each with both forms and the counterexample.

    A remark common to several is made once.
    """
    refuted = {name: verdict for name, verdict in recorded.load().items() if verdict.grade}
    anchors = {f"erratum-{slug(name)}": name for name in refuted}
    sections = {anchors[e.get("id")]: e for e in pages["slips.html"].xpath("//section[@id]")}
    assert sorted(sections) == sorted(refuted)
    grades = [GRADES.index(refuted[name].grade) for name in sections]
    assert grades == sorted(grades)
    headings = pages["slips.html"].xpath("//h2[@class='grade']/text()")
    assert headings == [grade.capitalize() for grade in GRADES]
    notes = [" ".join(element.xpath("string(./p[@class='says'])").split(".")[1:]) for element in sections.values()]
    assert [note for note in notes if note.strip() and notes.count(note) > 1] == []
    for name, element in sections.items():
        assert element.xpath("./div[contains(@class, 'sides')]/div[2]//*[@class='changed']"), name
        quote = element.xpath("string(.//p[@class='quote'])")
        assert EQUATIONS[name].quote.partition("$")[0][:20] in quote
        sides = element.xpath("./div[contains(@class, 'sides')]/div")
        assert [len(side.xpath(".//*[local-name()='math']")) > 0 for side in sides] == [True, True]
        assert refuted[name].corrected_verdict in sides[1].xpath("string(./p)")
        if refuted[name].verdict != "refuted":
            continue
        (example,) = element.xpath("./div[contains(@class, 'counterexample')]/p[2]")
        counter = refuted[name].counterexample
        assert counter.get("reason", f"right {counter['right'].replace('-', '−')}.") in example.text_content()
        assert len(example.xpath(".//*[local-name()='math']")) >= len(counter) - ("reason" in counter)
        back = {anchor for _, anchor in links(element.xpath("./h3")[0], "slips.html")}
        shared = {f"erratum-{slug(refuted[name].slip)}"} if refuted[name].slip else set()
        assert back == {f"ledger-{slug(name)}"} | shared


def test_links_lead_somewhere_and_no_markup_is_left(pages: dict[str, reader.HtmlElement]) -> None:
    """Every anchor exists, no id stands twice, and no TeX or Markdown is left outside code."""
    anchors = {name: page.xpath("//@id") for name, page in pages.items()}
    for name, page in pages.items():
        assert len(anchors[name]) == len(set(anchors[name]))
        for file, anchor in links(page, name):
            assert not anchor or anchor in anchors[file], (name, file, anchor)
        text = " ".join(page.xpath("//main//text()[not(ancestor::code)]"))
        assert not re.search(r"\\[a-zA-Z]+|\$|\{\{|\}\}|\{%|@\w|\*\*|\{#", text), name


@pytest.mark.slow
def test_the_pdf_holds_every_slip_and_names_the_ledger(built: Built) -> None:
    """Every refuted name is printed with a counterexample; of pages with a ledger only the title is printed."""
    pages = [page.extract_text() for page in PdfReader(built.pdf).pages]
    text = re.sub(r"\s+", "", "".join(pages)).replace("\xad", "")
    refuted = [name for name, verdict in recorded.load().items() if verdict.verdict == "refuted"]
    assert [name for name in refuted if name not in text] == []
    assert text.count("Counterexample") >= len(refuted)
    assert text.count("SectionVII") == 1  # in the contents


def test_grades_are_ordered_as_in_the_trial() -> None:
    """The report names the grades itself, since it does not load the proofs; they are the same."""
    assert trial.GRADES == GRADES


def test_totals_agree_with_the_record(pages: dict[str, reader.HtmlElement]) -> None:
    """The last row of the totals counts all verdicts."""
    verdicts = Counter(verdict.verdict for verdict in recorded.load().values())
    (row,) = pages["records.html"].xpath("//figure[@id='tab-2']//tr[td[1]='All']")
    numbers = [int(cell.text_content()) for cell in row.xpath("td")[1:]]
    kinds = ("proved", "definition", "refuted", "supported", "undecided")
    assert numbers == [len(EQUATIONS), *(verdicts[kind] for kind in kinds)]


def test_a_worst_error_beyond_its_limit_is_marked(monkeypatch: pytest.MonkeyPatch, tmp_path: Path, toml: Path) -> None:
    """An error on record that breaks a promise says so in its row; one that keeps it does not."""
    errors = {"R": (5.0, "ordinary"), "beta": (1.25, "I near 1"), "k": (0.5, "ordinary")}
    (tmp_path / "data").mkdir()
    (tmp_path / "data" / "worst_errors.json").write_text(json.dumps({"values": 1, "processors": [], "worst": errors}))
    monkeypatch.setattr(appendices, "folder", lambda _: tmp_path)
    data = gather(load(toml)).tables["stress: worst errors"]
    assert isinstance(data, Data)
    met = {str(row[0]): str(row[3]) for row in data.rows}
    assert met == {"$R$": "**limit exceeded:** ordinary", r"$\beta$": "$I$ near 1", "$k$": ""}


def test_an_entry_without_a_verdict_is_undecided(toml: Path) -> None:
    """An entry outside the record is not passed off as proved."""
    document = compose(load(toml), {}, _with(Finding("supported", "1000 samples", "(71)")))
    entries_shown = [
        entry for page in document.pages for block in page.blocks for entry in getattr(block, "entries", ())
    ]
    assert {entry.name: entry.finding.verdict for entry in entries_shown} == dict.fromkeys(EQUATIONS, "undecided") | {
        "(72)": "supported"
    }


def test_a_report_without_a_ledger_reads_no_record(tmp_path: Path) -> None:
    """Nothing is read that no block shows, and citations lead to the displayed equation."""
    file = tmp_path / "mine.toml"
    file.write_text(HEAD.partition('[[pages]]\nslug = "slips"')[0], encoding="utf-8")
    report = load(file)
    assert gather(report) == Appendices()
    document = compose(report, {})
    says = "(71): The hyperbola resolved for ω_3"
    assert document.cite("html")("(71)", "")[:4] == ("(71)", "index.html", "eq-71", says)
    assert document.cite("html")("(72)", "")[:4] == ("(72)", "", "", "")


@pytest.mark.parametrize(
    ("line_wrong", "line_right"),
    [('section = "II"', "IIX"), ('table = "totals"', "total"), ('source = "bench"', "benches")],
)
def test_a_misspelt_record_is_an_error(tmp_path: Path, line_wrong: str, line_right: str) -> None:
    """A section, table or source that there is not is told with the nearest name."""
    key, _, name = line_wrong.partition(" = ")
    file = tmp_path / "mine.toml"
    file.write_text((HEAD + LEDGER + RECORDED).replace(line_wrong, f'{key} = "{line_right}"', 1), encoding="utf-8")
    with pytest.raises(AtlasError, match=name.strip('"')):
        compose(report := load(file), {}, gather(report))


@pytest.mark.slow
def test_pages_of_recorded_results_load_no_algebra(tmp_path: Path) -> None:
    """A report never waits for a proof or an integrator: neither SymPy nor SciPy is loaded."""
    file = tmp_path / "mine.toml"
    file.write_text(HEAD + LEDGER.partition('[[pages]]\nslug = "ledger-iii"')[0] + RECORDED, encoding="utf-8")
    script = (
        "import sys; from pathlib import Path; from atlas.book.building.report import build_report;"
        f"build_report(Path({str(file)!r}), Path({str(tmp_path)!r}));"
        "print([name for name in ('sympy', 'scipy', 'mpmath', 'vtk') if name in sys.modules])"
    )
    assert subprocess.check_output([sys.executable, "-c", script], text=True).strip() == "[]"


def _with(finding: Finding) -> Appendices:
    """Return appendices with one finding and empty tables."""
    names = ("trial: totals", "bench: Limits of speed", "stress: worst errors")
    return Appendices({"(72)": finding}, {name: Data((), (), name) for name in names})
