"""`atlas page`: parts of the report of one object, its numbers, one file that asks for nothing, its refusals."""

import base64
import hashlib
import re
import shutil
from collections.abc import Callable, Iterator
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
import pytest
from click import ClickException
from click.testing import CliRunner
from lxml import html as reader
from pypdf import PdfReader
from tests_support import few_figures

from atlas import processes
from atlas.book.body_and_field import Body, Field, body_and_field
from atlas.book.building.formats import single
from atlas.book.card import object_of
from atlas.book.markdown import read
from atlas.book.parts import ReportRequest
from atlas.book.tables import compute
from atlas.book.tables.closed import convergents
from atlas.book.tables.properties import lettered
from atlas.book.tables.table import Request
from atlas.cli.app import atlas as command
from atlas.cli.app import main
from atlas.cli.body_request import COMMANDS, best, report_request
from atlas.cli.words import Words
from atlas.errors import AtlasError
from atlas.motions.elementary.kernel import ElementaryMotion
from atlas.motions.elementary.kernel_hyperbola import Hyperbola
from atlas.motions.register import FAMILIES
from atlas.pictures.recipes import load

MOTION = "--ratio 1.3 --field 1 2 --omega2 0.7"
BALL = "ball --larmor 0.5 --momentum 0.3 -0.7"


@pytest.fixture(scope="module", autouse=True)
def one_figure() -> Iterator[None]:
    """Leave pages one figure; all are drawn in the reports."""
    with few_figures(elementary="motion", quadric="stability"):
        yield


@pytest.fixture(scope="module")
def page_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Make the page of an elementary motion, once."""
    return Path(page(MOTION, tmp_path_factory.mktemp("pages"))[0])


def page(words: str, out: Path) -> list[str]:
    """Make a page and return the printed lines."""
    result = CliRunner().invoke(command, ["page", *words.split(), "--out", str(out)], catch_exceptions=False)
    assert result.exit_code == 0, result.output
    return result.stdout.splitlines()


def test_the_pdf_begins_with_its_title_and_its_numbers(page_file: Path) -> None:
    """No cover, no contents, no lists: the first pages have the title, the card, the inputs and omega3."""
    pages = [page.extract_text() for page in PdfReader(page_file.with_suffix(".pdf")).pages]
    text_first = " ".join(" ".join(pages[:2]).split())
    assert text_first.startswith(
        "A body with I = 1.3 turns about the field once in 4.014 units of time; precession, stable"
    )
    assert all(words in text_first for words in ("--ratio 1.3 --field 1 2 --omega2 0.7", "omega3 0.886", "Table 2"))
    numbered = re.compile(r"^Contents|^Figures 1|^\d(\.\d)? (Properties|Neighbours)", re.MULTILINE)
    assert not any(numbered.search(text) for text in pages)
    assert "How this was made" in pages[-1]
    *_, match_last = re.finditer(r"^(Figure|Table) \d+", text := "\n".join(pages), re.MULTILINE)
    assert match_last.start() < text.index("How this was made")


def rows(file: Path, table: str) -> dict[str, list[str]]:
    """Return the rows of a table of a page by the name in their second cell, the cells as plain text."""
    elements = reader.fromstring(file.read_bytes()).get_element_by_id(f"tab-{table}").xpath(".//tbody/tr")
    texts = [[cell.text_content().strip() for cell in row.xpath("./td")] for row in elements]
    return {cells[1]: cells for cells in texts}


def number(text: str) -> mpmath.mpf:
    """Read a number of a table."""
    return mpmath.mpf(re.sub(r"[\s\u202f]", "", text).replace("\N{MINUS SIGN}", "-").replace("×10", "e"))


def test_numbers_of_a_page_agree_with_the_formulas(page_file: Path) -> None:
    """Eight numbers of the page agree with the formulas at 40 digits, to the last one shown."""
    cells = rows(page_file, "properties-elementary")
    with mpmath.workdps(40):
        I, B2, B3, w2 = (mpmath.mpf(x) for x in (1.3, 1, 2, 0.7))
        w3 = B3 * w2 * (w2 + (2 - I) * B2) / (I * B2 * (w2 + B2))
        k = w2 * mpmath.sqrt(B2**2 + B3**2) / B2
        expected = {
            "omega3": w3,
            "k": k,
            "phi": w3 - B3 / B2 * w2,
            "period": 2 * mpmath.pi / k,
            "energy": w2**2 + I * w3**2,
            "field_squared": B2**2 + B3**2,
            "c3": w3 + B3,
            "along_field": w2 * B2 + I * w3 * B3,
        }
        for name, value in expected.items():
            assert abs(number(cells[name][2]) - value) <= abs(value) * mpmath.mpf("6e-10"), name
            assert cells[name][5] == "10\N{NO-BREAK SPACE}digits"
    assert cells["case"][2] == "precession"
    assert cells["nutation"][2] == "stable"
    assert [cells[name][5] for name in ("case", "nutation", "ratio")] == ["exactly", "exactly", "given"]


def test_the_nearest_closed_motions_are_convergents(page_file: Path) -> None:
    """Each fraction is a convergent of phi/k, and the motion at its omega2 has that ratio of frequencies."""
    table = reader.fromstring(page_file.read_bytes()).get_element_by_id("tab-closed-elementary")
    with mpmath.workdps(40):
        for row in table.xpath(".//tbody/tr"):
            cells = [cell.text_content().strip() for cell in row.xpath("./td")]
            p, q = map(int, cells[0].replace("\N{MINUS SIGN}", "-").split("/"))
            I, B2, B3, w2 = mpmath.mpf(1.3), mpmath.mpf(1), mpmath.mpf(2), number(cells[1])
            w3 = B3 * w2 * (w2 + (2 - I) * B2) / (I * B2 * (w2 + B2))
            assert abs((w3 - 2 * w2) / (w2 * mpmath.sqrt(5)) - mpmath.mpf(p) / q) < mpmath.mpf("1e-8")
            assert abs(number(cells[2]) - (w2 - mpmath.mpf(0.7))) < mpmath.mpf("1e-9")


def test_a_page_is_one_file_without_requests(page_file: Path) -> None:
    """Nothing is fetched: shown and saved parts are inside, links are anchors, and each script is allowed."""
    tree = reader.fromstring(page_file.read_bytes())
    addresses = [*tree.xpath("//@src"), *tree.xpath("//@srcset"), *tree.xpath("//link/@href")]
    assert addresses
    assert all(place.startswith("data:") for place in addresses)
    assert not re.findall(r"url\((?!\"data:)", page_file.read_text("utf-8"))
    anchors = {node.get("id") for node in tree.xpath("//*[@id]")}
    for link in tree.xpath("//a"):
        place = link.get("href")
        assert (place.startswith("#") and place[1:] in anchors) or re.match(
            r"data:|https://|\w[\w.+-]*\.(pdf|html)$", place
        )
        assert not place.startswith("data:") or link.get("download")
    policy = tree.xpath("//meta[@http-equiv]/@content")[0]
    assert "default-src 'none'" in policy
    script = re.search(r"script-src ([^;]*)", policy)
    assert script
    assert "unsafe" not in script[1]
    scripts = tree.xpath("//script")
    assert len(scripts) >= 3
    for one in scripts:
        digest = base64.b64encode(hashlib.sha256((one.text or "").encode()).digest()).decode()
        assert f"'sha256-{digest}'" in script[1]


@pytest.fixture(scope="module")
def ball(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    """Make page and PDF of a ball, once."""
    return [Path(x) for x in page(BALL, tmp_path_factory.mktemp("ball"))]


@pytest.mark.slow
def test_a_body_without_a_start_has_all_parts(tmp_path: Path) -> None:
    """Figures of its surface and its curve, commands of its neighbours, and why a figure is missing."""
    tree = reader.fromstring(Path(page("--ratio 1.5 --field 0 2", tmp_path)[0]).read_bytes())
    (neighbours,) = tree.xpath("//figure[@id='tab-neighbours']")
    assert "atlas page --ratio 1 --field 0 2" in neighbours.text_content()
    left_out = "".join(tree.xpath("//main//li//text()"))
    assert "stability: with B2 = 0" in left_out


def test_the_code_of_a_page_gives_its_numbers(page_file: Path) -> None:
    """The lines of Python print doubles that round to the digits of the table."""
    (code,) = reader.fromstring(page_file.read_bytes()).xpath("//main//pre[contains(., 'import atlas')]")
    with redirect_stdout(StringIO()) as out:
        exec(code.text_content(), {})  # noqa: S102  the page's own code
    cells = rows(page_file, "properties-elementary")
    printed = dict(zip(("case", "omega3", "k", "phi", "period"), out.getvalue().splitlines(), strict=True))
    for name in ("omega3", "k", "phi", "period"):
        assert float(printed[name]) == pytest.approx(float(number(cells[name][2])), rel=1e-9)


@pytest.mark.slow
def test_the_code_of_a_page_requests_existing_numbers_only(tmp_path: Path) -> None:
    """At rest the mean rates are zero; there are no angles of a period, no modulus and no nome."""
    page_made = Path(page("--ratio 1.5 --field 0 0 --omega 0 0 0", tmp_path)[0])
    (code,) = reader.fromstring(page_made.read_bytes()).xpath("//main//pre[contains(., 'import atlas')]")
    with redirect_stdout(StringIO()) as out:
        exec(code.text_content(), {})  # noqa: S102  the page's own code
    assert out.getvalue().splitlines() == ["at rest", "(0.0, 0.0)", "inf", "0.0", "0.0"]


@pytest.mark.slow
def test_a_report_file_that_was_changed_is_not_overwritten(
    ball: list[Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The page names the remedy, in one line with status 2, and the good page stays."""
    page_copy = shutil.copytree(ball[0].parent, tmp_path, dirs_exist_ok=True) / ball[0].name
    content, file = page_copy.read_bytes(), page_copy.parent / f"{page_copy.name.removesuffix('.html')}.md"
    assert file.read_text("utf-8").startswith("+++\n# Made by `atlas page --larmor 0.5 --momentum 0.3 -0.7`")
    file.write_text(file.read_text("utf-8").replace("This report was made by", "This is my ball, by"), "utf-8")
    with pytest.raises(SystemExit) as ended:
        main(["page", *BALL.split(), "--out", str(tmp_path)])
    assert ended.value.code == 2
    captured = capsys.readouterr()
    assert "was changed since it was made" in captured.err
    assert captured.err.count("\n") == 1
    assert page_copy.read_bytes() == content
    words = ["report", str(file), "--format", "single", "--out", str(tmp_path)]
    assert CliRunner().invoke(command, words, catch_exceptions=False).exit_code == 0
    assert b"my ball" in page_copy.read_bytes()


@pytest.mark.slow
def test_several_reports_are_built_at_once(tmp_path: Path) -> None:
    """Each is told by its place, in their order."""
    for name in ("one", "two"):
        (tmp_path / f"{name}.toml").write_text(
            f"name = '{name}'\ntitle = 'T'\n[[pages]]\nslug = 'index'\ntitle = 'P'\nblocks = []\n"
        )
    words = [
        "report",
        *(str(tmp_path / f"{name}.toml") for name in ("two", "one")),
        "--out",
        str(tmp_path),
        "--format",
        "html",
    ]
    outcome = CliRunner().invoke(command, words, catch_exceptions=False)
    assert outcome.exit_code == 0
    assert outcome.stdout.split() == [str(tmp_path / name / "index.html") for name in ("two", "one")]


@pytest.mark.parametrize(
    ("words", "name"),
    [
        (MOTION, "motion"),
        ("--ratio 1.3 --field 1 2", "classify"),
        ("--ratio 1.3 --field 1 2 --omega 0.3 0.7 0.2", "general"),
        ("--shape ring --radius=1 --mass 1 --charge 1 --magnetic 1 2 --omega 1 2 3", "general"),
        ("--inertia 0.8 1 1.3 --field 0.2 1 0.6 --z 1.7", "elliptic"),
        ("--inertia 0.8 1 1.3 --field 0.2 1 0.6 --omega 1 2 3", "asymmetric"),
        ("--inertia 1 1.5 --field 1 2 --omega 1 2 3", "general"),
        ("--inertia 1 0.5 --direction 0 1 --omega 0 0 1", "top"),
        ("--inertia 1 0.5 --heavy 9.81 0.1 --mass 1 --direction 0 1 --omega 0 0 1", "top"),
        ("--larmor 0.5 --momentum 0.3 -0.7", "ball"),
        ("--mu 1 --velocity 1 0 0", "particle"),
    ],
)
def test_the_options_of_a_page_choose_the_family(words: str, name: str) -> None:
    """Options that only one family takes choose it, by their names and by how many numbers they have."""
    assert best(Words(words.split())) == name


@pytest.fixture
def unbuilt(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[str], dict[str, Any]]:
    """Return a function that gives the report file of a page, which is not built."""

    def build(*_: object, **__: object) -> None:
        raise AtlasError("not built here")

    def record(words: str) -> dict[str, Any]:
        with pytest.raises(AtlasError, match="not built here"):
            CliRunner().invoke(command, ["page", *words.split(), "--out", str(tmp_path)], catch_exceptions=False)
        (file,) = tmp_path.glob("*.md")
        return read(file.read_text("utf-8"))[0]

    monkeypatch.setattr("atlas.book.building.report.build_report", build)
    return record


def table_of(record: dict[str, Any]) -> dict[str, Any]:
    """Return the block of the properties of a page."""
    blocks = record["pages"][0]["blocks"]
    return next(block for block in blocks if block.get("table") == "properties")


def test_a_negative_field_keeps_its_sign_in_si(unbuilt: Callable[[str], dict[str, Any]]) -> None:
    """B' against e2 stays there, though the report's own frame would turn it round; rates are in 1/s."""
    record = unbuilt("--ratio 1.5 --mass 2 --charge -3 --magnetic 1 2")
    assert record["parameters"]["fields"]["field"]["prime"] == [-0.75, -1.5]
    assert table_of(record)["parameters"]["time"] == "s"


@pytest.mark.parametrize("charge", ["5000e", "-5000e"])
def test_neglected_effects_have_numbers_for_either_charge(
    unbuilt: Callable[[str], dict[str, Any]], charge: str
) -> None:
    """A shape with its mass in a field in SI has them, also where B' is written against e2."""
    record = unbuilt(f"--shape disk --radius 1um --mass 1pg --magnetic 0.8T 0.1T --spin 20 --charge {charge}")
    blocks = record["pages"][0]["blocks"]
    (table,) = (block for block in blocks if block.get("columns", [""])[0] == "Effect")
    assert table["rows"]
    assert "[" not in record["parameters"]["fields"]["field"]["title"]


def test_a_field_may_be_a_rate_with_a_unit(unbuilt: Callable[[str], dict[str, Any]]) -> None:
    """Where B' itself is typed with a unit of 1/time there is no B to show."""
    record = unbuilt("--ratio 1.5 --field 5/s 3/s --omega2 1/s")
    assert record["parameters"]["fields"]["field"]["prime"] == [5.0, 3.0]


def test_a_page_carries_uncertainties(unbuilt: Callable[[str], dict[str, Any]]) -> None:
    """omega3 = B2/(...) of (71) has the standard deviation of its slope in I; k, (79), which has no I in it, none."""
    record = unbuilt("--ratio 1.5(1) --field 1 2 --omega2 0.7")
    (block,) = (block for block in record["pages"][0]["blocks"] if block.get("id") == "deviations")
    values = {row[1].strip("`"): row[2] for row in block["rows"]}
    slope = (Hyperbola(1.501, (1, 2)).omega3(0.7) - Hyperbola(1.499, (1, 2)).omega3(0.7)) / 0.002
    assert float(values["omega3"].split("(")[1].strip(")")) / 1000 == pytest.approx(0.1 * abs(slope), rel=0.02)
    assert values["k"] == f"{ElementaryMotion(1.5, (1, 2), 0.7).k:.10g}"


@pytest.mark.parametrize(
    ("units", "names"), [("si", "C/kg V/m T m m/s 1"), ("gaussian", "statC/g statV/cm G cm cm/s cm/s")]
)
def test_a_point_charge_keeps_the_given_units(unbuilt: Callable[[str], dict[str, Any]], units: str, names: str) -> None:
    """Each parameter has its own unit, and the velocity in the figure."""
    record = unbuilt(f"particle --mu 5 --electric 0.1 0 0 --magnetic 0 0 2 --velocity 1 0 0 --units {units}")
    table, figure = (block["parameters"] for block in record["pages"][0]["blocks"] if "parameters" in block)
    units_of = {row[1]: row[3] for row in compute("properties", Request([body_and_field(None, None)], table, 8)).rows}
    assert [units_of[f"`{name}`"] for name in ("mu", "E1", "B1", "y1", "v1", "c")] == names.split()
    assert f"{figure['length']}/{figure['unit']}" == names.split()[4]


def test_the_code_of_a_page_has_the_names_of_the_class(unbuilt: Callable[[str], dict[str, Any]]) -> None:
    """Those of a particle in Python are not those of its options."""
    record = unbuilt("particle --mu -1 --electric 0 0.5 0 --magnetic 0 0 1 --velocity 1 0 0")
    (code,) = re.findall(
        r"```python\n(.*?)```", "".join(b.get("text", "") for b in record["pages"][0]["blocks"]), re.DOTALL
    )
    with redirect_stdout(StringIO()) as out:
        exec(code, {})  # noqa: S102  the page's own code
    assert out.getvalue().split() == ["-1.0", "0.5"]


def test_without_closed_motions_a_page_has_no_heading_for_them(unbuilt: Callable[[str], dict[str, Any]]) -> None:
    """The axis of a body without a field goes round a circle: there is no fraction, and a sentence says why."""
    texts = [
        block.get("text", "") for block in unbuilt("--ratio 1.5 --field 0 0 --omega 0.3 0.7 0.2")["pages"][0]["blocks"]
    ]
    assert "## Nearest closed motions" not in texts
    assert "The nearest closed motions: Without a field the axis goes round a circle" in texts[-1]


@pytest.mark.parametrize(
    "body", ["--points FILE", "--inertia 2 4 --mu 1", "--shape ring --radius 1 --mass 4 --charge 4"]
)
def test_the_code_of_a_page_makes_any_body(unbuilt: Callable[[str], dict[str, Any]], tmp_path: Path, body: str) -> None:
    """Four masses on a circle are a ring; its two moments, its shape and its points make the same motion."""
    points = "x,y,z,mass,charge\n1,0,0,1,1\n0,1,0,1,1\n-1,0,0,1,1\n0,-1,0,1,1\n"
    (tmp_path / "ring.csv").write_text(points, "utf-8")
    record = unbuilt(f"{body.replace('FILE', str(tmp_path / 'ring.csv'))} --magnetic 0.75 1.3 --omega2 0.35")
    texts = "".join(block.get("text", "") for block in record["pages"][0]["blocks"])
    code = re.search(r"```python\n(.*?)```", texts, re.DOTALL)
    assert code
    with redirect_stdout(StringIO()) as out:
        exec(code[1], {})  # noqa: S102  the page's own code
    motion = ElementaryMotion(2.0, (0.375, 0.65), 0.35)
    assert float(out.getvalue().split()[1]) == pytest.approx(motion.omega3, rel=1e-14, abs=0.0)


@pytest.mark.slow
def test_a_precession_too_slow_to_draw_is_reported(
    unbuilt: Callable[[str], dict[str, Any]], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A cylinder that spins at 2 MHz precesses at 2 mHz: eight minutes a turn, and nutates within a microsecond."""
    body = "--shape solid-cylinder --radius 1.2um --height 3um --density 1850kg/m3 --charge 5000e"
    monkeypatch.chdir(tmp_path)
    report = unbuilt(f"motion {body} --magnetic 0.4T 0.6928T --spin 2MHz")
    prose = "".join(block.get("text", "") for block in report["pages"][0]["blocks"])
    assert "followed for the precession" in prose
    assert "a whole turn takes 492 s" in prose
    assert r"$7.71 \times 10^{-7}$ s" in prose
    (listing,) = (block for block in report["pages"][0]["blocks"] if block.get("id") == "neighbours")
    assert report["parameters"]["fields"]["field"]["title"] == "field of (0.4, 0.6928) T"
    for _, line in listing["rows"]:  # no start stands twice, and no density without its shape
        words = re.sub(r"^`atlas page |`$", "", line).split()
        assert not {"--omega", "--omega2"} & set(words) or "--spin" not in words
        assert "--density" not in words or "--shape" in words
        with pytest.raises(AtlasError, match="not built here"):
            CliRunner().invoke(command, ["page", *words], catch_exceptions=False)


def test_neighbours_agree_with_their_description(unbuilt: Callable[[str], dict[str, Any]]) -> None:
    """The pair turns with phi of the other sign, (80); the one that turns as a whole has phi = 0; at rest R is 1."""
    record = unbuilt("--ratio 1.3 --field 1 2 --omega2 0.7")
    (rows,) = (block["rows"] for block in record["pages"][0]["blocks"] if block.get("id") == "neighbours")
    neighbours = {words.split()[1 if words.startswith("the") else 0]: cells for words, cells in rows}
    motions = {
        word: ElementaryMotion(1.3, (1, 2), float(cells.split("--omega2 ")[1].strip("`")))
        for word, cells in neighbours.items()
        if word in {"pair", "at", "$\\phi=0$:"}
    }
    assert motions["pair"].phi == pytest.approx(-ElementaryMotion(1.3, (1, 2), 0.7).phi, rel=1e-14, abs=0.0)
    assert motions["$\\phi=0$:"].phi == 0
    assert (motions["at"].rotation(3.0) == np.eye(3)).all()


def test_figures_of_a_family_take_its_parameters() -> None:
    """Each recipe of the register is there, and takes parameters of its family."""
    for family in FAMILIES.values():
        for name in family.figures:
            assert set(load(name).parameters) & {p.name for p in family.parameters}


@pytest.mark.parametrize(
    "words", ["--ratio 1.5 --field 1 2 --omega2 -1", "--ratio 2.5 --field 1 2", "particle --mu inf", "ball --inertia 0"]
)
def test_a_page_of_an_unknown_object_is_refused_at_once(
    words: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Before anything is loaded for its figures, in the background or here."""
    monkeypatch.setattr(processes, "prepare", pytest.fail)
    with pytest.raises((AtlasError, ClickException)):
        command.main(["page", *words.split(), "--out", str(tmp_path)], standalone_mode=False)
    assert not list(tmp_path.iterdir())


def test_a_report_of_several_pages_is_not_one_file() -> None:
    """It is an error that says so."""
    with pytest.raises(AtlasError, match="the report has 2"):
        single({"index.html": b"", "more.html": b""}, "x")


@pytest.mark.slow
def test_a_body_without_a_field_is_free_and_its_times_have_a_unit() -> None:
    """No caption and no heading calls it charged, or says how strong no field is; a time is never a bare number."""
    request = ReportRequest(FAMILIES["asymmetric"], {}, {
        "inertia": [1.0, 3.0836, 3.235], "field": [0.0, 0.0, 0.0], "omega": [-1.7, 0.25, 0.588],
    }, time="s")  # fmt: skip
    assert object_of(request).says == "Any motion of a free body of any three moments"
    for unit, words in (("s", "over 20.8 s,"), ("time", "over 20.8 units of time,")):
        scene = load("asymmetric_motion").scene(
            inertia=(1.0, 3.0836, 3.235), field=(0.0, 0.0, 0.0), omega=(-1.7, 0.25, 0.588), unit=unit
        )
        assert words in scene.caption
        assert "A free body" in scene.caption
        assert "B" not in scene.caption


def test_a_field_at_an_angle_is_shown_as_typed() -> None:
    """In the options, and so in the name and the commands, and in words; the components are nowhere but in values."""
    words = "--ratio 1.5 --magnetic 0.8T --angle 30deg --mu 1C/kg --omega2 0.3"
    context = COMMANDS["motion"].make_context("motion", words.split())
    with context:
        request = report_request(FAMILIES["elementary"], context.params)
    assert request.command == f"atlas report your_body {words}"
    assert request.field["title"] == "field of 0.8 T at 30\N{DEGREE SIGN}"


def test_properties_mark_unproven_numbers() -> None:
    """All numbers of a body in a field are proven, a zero is exact, and a parameter that is missing is an error."""
    case = [body_and_field(Body("b", ratio=1.5), Field("f", prime=(1.0, 2.0)))]
    data = compute("properties", Request(case, {"family": "hyperbola", "given": False}, 8))
    assert {row[5].replace("\\ ", " ") for row in data.rows} == {"8 digits", "exactly"}
    data = compute("properties", Request(case, {"family": "elementary", "omega2": -2.0}, 8))
    assert {row[1]: row[5] for row in data.rows}["`phi`"] == "exactly"
    for parameters, tells in (({}, "lacks 'omega2'"), ({"omega2": 1.0, "omega4": 1.0}, "omega4")):
        with pytest.raises(AtlasError, match=tells):
            compute("properties", Request(case, {"family": "elementary", **parameters}, 8))
    with pytest.raises(AtlasError, match="nix"):
        compute("properties", Request(case, {"family": "nix"}, 8))


def test_why_a_quantity_has_no_value_stands_below() -> None:
    """A spin about the middle axis has no frequencies: a dash in the table, the reason among its notes."""
    inputs = {"inertia": [0.8, 1.0, 1.3], "field": [0.0, 0.0, 0.0], "omega": [0.0, 3.0, 0.0]}
    data = compute("properties", Request([body_and_field(None, None)], {"family": "asymmetric", **inputs}, 6))
    assert {row[1]: (row[2], row[5]) for row in data.rows}["`frequencies`"] == ("–", "")
    assert any("frequencies" in note and "separatrix" in note for note in data.notes)
    inputs = {"inertia": [1.0, 0.5], "direction": [0.0, 1.0], "omega": [0.0, 0.0, 0.2], "linear": 3.0}
    data = compute("properties", Request([body_and_field(None, None)], {"family": "top", **inputs}, 6))
    without = "`precession_per_period`, `spin_per_period`, `precession_rate`, `spin_rate`: "
    assert [note.startswith(without) for note in data.notes if "no period" in note] == [True]


def test_each_root_has_a_row_of_its_own() -> None:
    """Real ones are numbers with a unit, a complex one is a text with its i."""
    for ratio, complex_ones in ((1.3, 0), (0.5, 2)):
        case = [body_and_field(Body("b", ratio=ratio), Field("f", prime=(1.0, 2.0)))]
        data = compute("properties", Request(case, {"family": "general", "omega": (3.0, 1.0, 2.0)}, 8))
        rows = {row[1]: row[2:4] for row in data.rows if str(row[1]).startswith("`roots")}
        assert list(rows) == [f"`roots[{i}]`" for i in range(4)]
        assert [unit for _, unit in rows.values()].count("") == complex_ones
        assert [str(value).endswith(" i") for value, _ in rows.values()].count(True) == complex_ones


def test_a_neighbour_has_no_negative_zero() -> None:
    """A link to it has the text that one would type."""
    neighbour = ReportRequest(FAMILIES["general"], {"ratio": ("1.5",), "omega": ("1", "2", "3")}, {}).changed(
        "general", omega=(-0.0, -1.0, 2.0)
    )
    assert neighbour.options["omega"] == ("0", "-1", "2")


def test_convergents_are_best_fractions() -> None:
    """Those of pi are the known ones, and a fraction ends with itself; the sign is kept; six at most, to 10 000."""
    from flint import arb, fmpq

    assert list(convergents(arb.pi())) == [(3, 1), (22, 7), (333, 106), (355, 113)]
    assert list(convergents(arb(fmpq(-5, 4)))) == [(-1, 1), (-5, 4)]
    golden = (1 + arb(5).sqrt()) / 2
    assert list(convergents(golden)) == [(1, 1), (2, 1), (3, 2), (5, 3), (8, 5), (13, 8)]
    assert list(convergents(1 / arb(10_000.5))) == [(0, 1), (1, 10_000)]
    assert list(convergents(1 / arb(10_001.5))) == [(0, 1)]


def test_letters_in_plain_words_become_formulas() -> None:
    """Letters of the register's words become formulas, powers are raised, and other words stay."""
    assert lettered("semi-axis along omega'_2, 1/B2^2") == r"semi-axis along $\omega'_2$, 1/$B_2$^2^"
    assert lettered("Components of B' = mu B/(2c)") == r"Components of $\mathbf{B}'$ = $\mu$ $\mathbf{B}$/(2c)"
    assert lettered("v^2 = prod(z + D/I_i)") == r"$v$^2^ = $\prod$($z$ + $D$/$I_i$)"
    assert lettered("-B', I^-1 (1 - c3)") == r"−$\mathbf{B}'$, $I$^−1^ (1 − $c_3$)"
    assert lettered("number of a body's semi-axis") == "number of a body's semi-axis"
