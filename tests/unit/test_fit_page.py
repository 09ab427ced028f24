"""`atlas page --fit`: the page of a fit, its numbers and words, the commands on it, and its refusals."""

import json
import re
import runpy
import shlex
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from lxml import html as reader
from pypdf import PdfReader
from scipy.spatial.transform import Rotation
from tests_support import few_figures

import atlas
from atlas.book.fit_report import MEANINGS
from atlas.book.markdown import read
from atlas.cli.app import atlas as command
from atlas.cli.app import main
from atlas.cli.page import motion_of
from atlas.errors import AtlasError
from atlas.fitting.models import MODELS

NOISE = 0.01
NAMES = ",".join(f"R{i}{j}" for i in "123" for j in "123")


@pytest.fixture(scope="module", autouse=True)
def one_figure() -> Iterator[None]:
    """Leave the motion one figure."""
    with few_figures(general="general_motion", elementary="motion"):
        yield


def data_file(path: Path, motion: Any, slower: float = 0.0) -> Path:
    """Write 80 attitudes of a motion, with noise; time may slow down."""
    rng = np.random.default_rng(1)
    t = np.sort(rng.uniform(0.0, 15.0, 80))
    noise = Rotation.from_rotvec(rng.normal(0.0, NOISE, (t.size, 3))).as_matrix()
    R = noise @ motion.rotation(t - slower * t**2 / 2)
    header = f"# sigma = {NOISE}\nt,{NAMES}"
    np.savetxt(path, np.column_stack([t, R.reshape(-1, 9)]), delimiter=",", header=header, comments="")
    return path


def nutating() -> Any:
    """Return the motion that was measured."""
    return atlas.GeneralMotion(1.3, (0.4, 1.1), omega=(0.9, 0.3, 0.7))


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with data and their page, made once."""
    place = tmp_path_factory.mktemp("fit")
    file = data_file(place / "mine.csv", nutating())
    assert run_page(file, place / "out", "--predict", "20").exit_code == 0
    return place


def run_page(file: Path, out: Path, *words: str) -> Any:
    """Make the page of a file."""
    words = ("page", "--fit", str(file), "--out", str(out), *words)
    return CliRunner().invoke(command, words, catch_exceptions=False)


def rows(page: Path, table: str) -> list[list[str]]:
    """Return the rows of a table of a page, as plain text with plain spaces and signs."""
    rows_found = reader.fromstring(page.read_bytes()).get_element_by_id(f"tab-{table}").xpath(".//tbody/tr")
    texts = [[cell.text_content() for cell in row.xpath("./td")] for row in rows_found]
    return [[cell.replace("\xa0", " ").replace("\N{MINUS SIGN}", "-").strip() for cell in row] for row in texts]


@pytest.mark.slow
def test_numbers_of_a_fit_page_agree_with_the_fit(folder: Path) -> None:
    """Parameters and errors to the digits shown, correlations, horizons and a prediction, as `atlas fit` has them."""
    page = folder / "out" / "fit-mine-predict-20.html"
    text = CliRunner().invoke(
        command, ["fit", str(folder / "mine.csv"), "--horizon", "0.1", "--predict", "20", "--json"]
    )
    record = json.loads(text.stdout)
    for name, _, value, _ in rows(page, "parameters"):
        number, error = map(float, value.split(" ± "))
        p = record["params"][name]
        assert abs(number - p["value"]) <= p["stderr"] / 10
        assert abs(error - p["stderr"]) <= p["stderr"] / 10
    size = np.sqrt(np.diag(record["covariance"]))
    for pair, value in rows(page, "correlations"):
        i, j = (record["names"].index(name) for name in pair.split(", "))
        assert float(value) == pytest.approx(record["covariance"][i][j] / size[i] / size[j], abs=6e-4)
        assert abs(float(value)) >= 0.5
    horizons = rows(page, "horizon")
    assert [row[0] for row in horizons] == ["0.01 rad", "0.1 rad"]
    assert float(horizons[1][2]) == pytest.approx(record["horizon"], rel=1e-5)
    assert "at t = 20: " in page.read_text("utf-8")


def test_the_pdf_and_the_file_have_the_pictures(folder: Path) -> None:
    """Data, curve and residuals, then the motion; both stand in one file, which asks for nothing."""
    page = folder / "out" / "fit-mine-predict-20.html"
    tree = reader.fromstring(page.read_bytes())
    captions = [caption.text_content() for caption in tree.xpath("//figure[contains(@id, 'fig-')]//figcaption")]
    assert ["residuals in standard errors" in caption for caption in captions] == [True, False]
    assert all(place.startswith("data:") for place in tree.xpath("//img/@src"))
    text = "".join(page_pdf.extract_text() for page_pdf in PdfReader(page.with_suffix(".pdf")).pages)
    assert all(
        words in text for words in ("The motion in mine.csv", "Figure 1", "reduced chi square", "Range of predictions")
    )


@pytest.mark.slow
def test_commands_on_a_fit_page_make_the_page_again(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The first one the same files; the one of the motion is a page of the motion that was measured."""
    out = folder / "out"
    before = {file.name: file.read_bytes() for file in out.glob("fit-mine*") if "costs" not in file.name}
    assert {Path(name).suffix for name in before} == {".md", ".py", ".html", ".pdf"}
    texts = reader.fromstring((out / "fit-mine-predict-20.html").read_bytes()).xpath("//main//pre")
    (command_first,) = (
        line for text in texts for line in text.text_content().splitlines() if line.startswith("$ atlas page --fit")
    )
    monkeypatch.chdir(folder)
    again = CliRunner().invoke(command, [*shlex.split(command_first)[2:], "--out", "out"], catch_exceptions=False)
    assert again.exit_code == 0
    assert {file.name: file.read_bytes() for file in out.glob("fit-mine*") if "costs" not in file.name} == before


@pytest.fixture
def unbuilt(monkeypatch: pytest.MonkeyPatch) -> None:
    """Stop pages when their sources are written."""

    def build(*_: object, **__: object) -> None:
        raise AtlasError("not built here")

    monkeypatch.setattr("atlas.book.building.report.build_report", build)


@pytest.mark.slow
@pytest.mark.usefixtures("unbuilt")
def test_undetermined_parameters_are_reported(tmp_path: Path) -> None:
    """An elementary motion does not tell the ratio and the field apart: there are no numbers, and a sentence."""
    file = data_file(tmp_path / "steady.csv", atlas.ElementaryMotion(1.5, (1.0, 2.0), omega2=0.7))
    with pytest.raises(AtlasError, match="not built here"):
        run_page(file, tmp_path)
    blocks = read((tmp_path / "fit-steady.md").read_text("utf-8"))[0]["pages"][0]["blocks"]
    assert "What the data do not determine:\n\n- No nutation is seen" in blocks[0]["text"]
    assert "are not determined apart" in blocks[0]["text"]
    assert "Nothing in the residuals speaks against" in blocks[0]["text"]
    values = {name.strip("`"): value for name, _, value, _ in blocks[1]["rows"]}
    assert {values[name] for name in ("ratio", "B2", "B3", "b")} == {"not determined"}
    assert "±" in values["omega3"]


FEW = """t,w,x,y,z
0.074684841,0.94532646,0.1009094,-0.11847039,0.28660068
0.10357732,0.94130034,0.0972205,-0.11617228,0.30167174
0.10530609,0.93771899,0.10040544,-0.11579682,0.31175782
0.23588051,0.92068762,0.10400322,-0.042480233,0.37378211
0.50393742,0.84970219,0.15176408,0.069674442,0.5001193
0.60700589,0.80794439,0.17624708,0.11820047,0.54971945
"""
"""Attitudes that determine neither body nor field, so that a fit from the values of one ends elsewhere."""


@pytest.mark.slow
@pytest.mark.usefixtures("unbuilt")
def test_the_picture_is_of_the_fit_in_the_table(tmp_path: Path) -> None:
    """The recipe finds the standard error that the page tells."""
    file = tmp_path / "few.csv"
    file.write_text(FEW, encoding="utf-8")
    with pytest.raises(AtlasError, match="not built here"):
        run_page(file, tmp_path)
    caption = runpy.run_path(str(tmp_path / "fit-few.py"))["scene"]().caption
    sigma = re.search(r"sigma (\S+) found", caption)
    assert sigma
    assert f"is {sigma[1]}." in (tmp_path / "fit-few.md").read_text("utf-8")


@pytest.mark.slow
def test_evidence_against_the_family_is_reported(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A body that slows down: chi square and correlated residuals on the page and on the terminal, with status 1."""
    file = data_file(tmp_path / "mine.csv", nutating(), slower=2e-3)
    with pytest.raises(SystemExit) as ended:
        main(["page", "--fit", str(file), "--out", str(tmp_path / "out")])
    assert ended.value.code == 1
    assert "atlas: The reduced chi square is" in capsys.readouterr().err
    page = reader.fromstring((tmp_path / "out" / "fit-mine.html").read_bytes()).xpath("//main")[0].text_content()
    assert "What speaks against this motion:" in page
    assert "Neighbouring residuals are correlated" in page
    assert "Nothing in the residuals" not in page
    assert "Range of predictions" not in page
    assert "by params (--start)" in page


@pytest.mark.slow
def test_a_bad_file_or_a_changed_one_leaves_the_page(folder: Path, tmp_path: Path) -> None:
    """Files without data, an edited recipe and a folder that is read-only are refused; existing files stay."""
    place = shutil.copytree(folder, tmp_path / "copy")
    contents = {file.name: file.read_bytes() for file in (place / "out").iterdir()}
    recipe, file = place / "out" / "fit-mine-predict-20.py", place / "mine.csv"
    recipe.write_text(recipe.read_text("utf-8").replace("Fit again", "Fit once more"), "utf-8")
    with pytest.raises(AtlasError, match=r"predict-20.py was changed since it was made"):
        run_page(file, place / "out", "--predict", "20")
    recipe.write_bytes(contents[recipe.name])
    file.write_text("t,R11\n0,1\n", "utf-8")
    with pytest.raises(AtlasError, match="5 times or more"):
        run_page(file, place / "out", "--predict", "20")
    assert {file.name: file.read_bytes() for file in (place / "out").iterdir()} == contents


TURN = Rotation.from_rotvec([0.3, -0.2, 0.4]).as_matrix()
MOTIONS = {
    "general": atlas.GeneralMotion.in_laboratory(1.3, TURN @ (0.0, 0.4, 1.1), TURN, TURN @ (0.9, 0.3, 0.7)),
    "ball": atlas.GeneralMotion.in_laboratory(1.0, TURN @ (0.0, 0.4, 1.1), TURN, TURN @ (0.9, 0.3, 0.7)),
    "free": atlas.motion(1.3, (0.0, 0.0, 0.0), (0.9, 0.3, 0.7)),
    "elementary": atlas.motion(1.5, (0.3, 1.0, 2.0), (0.0, 0.0, 0.3)),
    "top": atlas.TopMotion.in_laboratory(
        (1.0, 0.5), (0.0, 0.0, 1.0), TURN, (0.1, 0.2, 5.0), coupling=(0.1, 0.2), linear=3.0
    ),
    "elliptic": atlas.EllipticMotion.in_laboratory((0.8, 1.0, 1.3), (0.2, 1.0, 0.6), np.eye(3), z=1.7),
    "asymmetric": atlas.motion((1.3, 1.0, 0.8), (0.2, 1.0, 0.6), (0.3, 0.7, 0.2)),
}


@pytest.mark.slow
@pytest.mark.parametrize("family", MODELS)
def test_the_figures_are_of_the_motion(family: str) -> None:
    """In other axes, and without the attitude, the motion of each family turns as fast at each time."""
    motion = MOTIONS[family]
    result, t = motion_of(motion), np.linspace(0.0, 9.0, 7)
    values = dict(result.values)
    if result.body:
        values |= {"ratio": result.body["ratio"], "field": result.field["prime"]}
    motion_kernel = result.family.kernels()(**values)
    fast = [np.linalg.norm(motion_each.angular_velocity(t), axis=-1) for motion_each in (motion, motion_kernel)]
    assert np.abs(fast[0] - fast[1]).max() < 1e-12


def test_each_parameter_is_explained() -> None:
    """Every parameter of every family has its words and its unit on the page."""
    names = {name for model in MODELS.values() for name in model.names} | {"b"}
    assert all(name in MEANINGS or name.rstrip("123") in MEANINGS for name in names)
