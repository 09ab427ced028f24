"""`atlas data`: each table and each drawn point of a report, described, the same bytes each time."""

import csv
import hashlib
import json
import sys
from dataclasses import replace
from decimal import Decimal
from io import StringIO
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from atlas.arithmetic.certified_digits import certified
from atlas.book.building.composed import build_data, composed
from atlas.book.building.publish import WRITTEN
from atlas.book.data_package import ascii_name, package
from atlas.cli.app import atlas as program
from atlas.errors import AtlasError
from atlas.motions.elementary.certified import ElementaryMotion as Balls
from atlas.motions.elementary.kernel import ElementaryMotion
from atlas.pictures import recipes
from atlas.pictures.data import table
from atlas.trial.ledger.plain import words

REPORT = r"""
name = "small"
title = "Small"
abstract = "One body, $I=3/2$."
[parameters]
bodies.short = { title = "A short solenoid", ratio = 1.5 }
fields.up = { title = "up", prime = [1.0, 2.0] }
sets.one = { omega2 = 0.7 }
sets.two = { omega2 = 0.7, times = [0, 2.5] }
[[pages]]
slug = "index"
title = "T"
blocks = [
  { kind = "table", table = "motion", id = "numbers", body = "short", field = "up", digits = 20, sets = ["one"] },
  { kind = "table", table = "samples", id = "samples", body = "short", field = "up", digits = 12, sets = ["two"] },
  { kind = "listing", id = "words", columns = ["$\\omega_2$", "What"], rows = [
    ["1", "a"],
    ["$x$", "b"],
  ], caption = "Words after @(71)." },
  { kind = "figure", recipe = "frequencies", id = "curves", parameters.ratio = 1.5 },
]
"""


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of the data of a small report."""
    place = tmp_path_factory.mktemp("data")
    (place / "small.toml").write_text(REPORT, encoding="utf-8")
    return build_data(place / "small.toml", place / "out").parent


@pytest.fixture(scope="module")
def described(data: Path) -> dict[str, Any]:
    """Return the description of each file."""
    text = (data / "datapackage.json").read_text("utf-8")
    record = json.loads(text)
    assert f"{json.dumps(record, indent=1, ensure_ascii=False)}\n" == text  # for people, too
    return record | {"resources": {resource["path"]: resource for resource in record["resources"]}}


def read(path: Path) -> list[dict[str, str]]:
    """Read a CSV file."""
    return list(csv.DictReader(StringIO(path.read_text("utf-8"))))


def test_each_file_is_described_and_nothing_else_is_there(data: Path, described: dict[str, Any]) -> None:
    """Paths, sizes, digests and columns are those of the files, and no file is left out."""
    files = {str(path.relative_to(data)) for path in data.rglob("*") if path.is_file()}
    assert files == {*described["resources"], "datapackage.json", WRITTEN}
    for path, resource in described["resources"].items():
        content = (data / path).read_bytes()
        assert resource["bytes"] == len(content)
        assert resource["hash"] == f"sha256:{hashlib.sha256(content).hexdigest()}"
        assert resource["format"] == path.rpartition(".")[2]
        assert resource["name"].endswith("-parquet") == (resource["format"] == "parquet")
        if resource["format"] == "csv":
            assert content.decode().splitlines()[0].split(",") == [
                field["name"] for field in resource["schema"]["fields"]
            ]
    assert described["description"] == "One body, I=3/2."


def test_numbers_have_all_digits_that_are_printed(data: Path, described: dict[str, Any]) -> None:
    """The frequency k of the table is the ball's, to its last digit; the description counts the digits."""
    rows = {row["Symbol"]: row for row in read(data / "tables" / "numbers.csv")}
    k = certified(lambda: {"k": Balls(1.5, (1.0, 2.0), 0.7).k}, 30)["k"]
    printed = Decimal(rows["k"]["Value"])
    assert abs(printed - Decimal(k)) <= Decimal(1).scaleb(int(printed.as_tuple().exponent))
    assert rows["k"]["Unit"] == "s^-1"
    value = next(f for f in described["resources"]["tables/numbers.csv"]["schema"]["fields"] if f["name"] == "Value")
    assert (value["type"], value["digits"]) == ("string", 20)  # there are words in it, too
    samples = described["resources"]["tables/samples.csv"]["schema"]["fields"]
    assert {field["type"] for field in samples} == {"number"}


def test_parquet_holds_the_nearest_doubles(data: Path, described: dict[str, Any]) -> None:
    """Read back by pyarrow it has the same columns and the doubles nearest to the digits; heads and units go along."""
    parquet = pytest.importorskip("pyarrow.parquet")
    for path in [path for path in described["resources"] if path.endswith(".parquet")]:
        table, rows = parquet.read_table(data / path), read(data / path.replace(".parquet", ".csv"))
        for field in described["resources"][path]["schema"]["fields"]:
            cells = table.column(field["name"]).to_pylist()
            texts = [row[field["name"]] for row in rows]
            convert = {"number": float, "integer": int, "string": str}[field["type"]]
            assert cells == [convert(x) if x or convert is str else None for x in texts]
        units = {f.name: (f.metadata or {}).get(b"unit", b"").decode() for f in table.schema}
        assert units == {f["name"]: f.get("unit", "") for f in described["resources"][path]["schema"]["fields"]}


def test_without_pyarrow_there_is_csv_and_a_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The line has the words of `atlas sweep`, and the description names the files."""
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    (tmp_path / "small.toml").write_text(REPORT, encoding="utf-8")
    ended = CliRunner().invoke(program, ["data", str(tmp_path / "small.toml"), "--out", str(tmp_path)])
    assert ended.exit_code == 0
    assert ended.stderr.startswith("atlas: CSV alone: Parquet needs pyarrow: pip install 'atlas-charged-body[sweep]'")
    place = tmp_path / "small"
    described = json.loads((place / "datapackage.json").read_text("utf-8"))["resources"]
    assert {resource["path"] for resource in described} == {str(x.relative_to(place)) for x in place.glob("*/*")}
    with pytest.raises(AtlasError, match="Parquet needs pyarrow"):
        build_data(tmp_path / "small.toml", tmp_path)


def test_samples_agree_with_the_motion(data: Path) -> None:
    """R13 at each time is that of the kernel."""
    motion = ElementaryMotion(1.5, (1.0, 2.0), 0.7)
    for row in read(data / "tables" / "samples.csv"):
        assert float(row["R_13"]) == pytest.approx(motion.rotation(float(row["t"]))[0, 2], abs=1e-11)


def test_a_column_of_words_and_numbers_is_one_of_words(data: Path, described: dict[str, Any]) -> None:
    """Cells of a table of words are text; its heads become names, its caption's equations are named."""
    resource = described["resources"]["tables/words.csv"]
    assert [(f["name"], f["type"]) for f in resource["schema"]["fields"]] == [("omega2", "string"), ("What", "string")]
    assert resource["equations"] == ["(71)"]
    assert read(data / "tables" / "words.csv")[1] == {"omega2": "x", "What": "b"}


def test_a_figure_gives_the_points_that_it_draws(data: Path, described: dict[str, Any]) -> None:
    """They are those of the scene, and the description names axes, parameters and the command."""
    scene = recipes.load("frequencies").scene(ratio=1.5)
    expected = "".join(line for line in table(scene).splitlines(keepends=True) if not line.startswith("#"))
    assert (data / "figures" / "curves.csv").read_text("utf-8") == expected
    resource = described["resources"]["figures/curves.csv"]
    assert resource["command"].startswith("atlas figure frequencies --set ratio=1.5")
    assert resource["axes"][0].startswith("panel 1: ")


def test_the_same_report_gives_the_same_bytes(data: Path) -> None:
    """Made again in its place, every file has the same bytes, and files of the user stay."""
    before = {path: path.read_bytes() for path in data.rglob("*") if path.is_file()}
    (data / "tables" / "own.csv").write_text("own\n", encoding="utf-8")
    build_data(data.parents[1] / "small.toml", data.parent)
    assert (data / "tables" / "own.csv").read_text() == "own\n"
    (data / "tables" / "own.csv").unlink()
    assert {path: path.read_bytes() for path in data.rglob("*") if path.is_file()} == before
    assert [path.name for path in data.parent.iterdir()] == ["small"]


@pytest.mark.parametrize("kind", ["folder", "link"])
def test_files_of_the_user_are_kept(data: Path, tmp_path: Path, kind: str) -> None:
    """Existing files stay; so do targets of a link."""
    place, theirs = tmp_path / "small", tmp_path / "theirs"
    theirs.mkdir()
    (theirs / "thesis.tex").write_text("x", encoding="utf-8")
    if kind == "link":
        place.symlink_to(theirs)
    else:
        theirs.rename(place)
    build_data(data.parents[1] / "small.toml", tmp_path)
    assert (place / "thesis.tex").read_text("utf-8") == "x"


def test_a_failing_figure_keeps_existing_files(data: Path, tmp_path: Path) -> None:
    """The reason is told in a line, and the status is 2."""
    report_wrong = REPORT.replace("parameters.ratio = 1.5", "parameters.ratio = 7.5")
    assert report_wrong != REPORT
    (tmp_path / "small.toml").write_text(report_wrong, encoding="utf-8")
    done = CliRunner().invoke(program, ["data", str(tmp_path / "small.toml"), "--out", str(data.parent)])
    assert isinstance(done.exception, AtlasError)
    assert "frequencies" in str(done.exception)
    assert (data / "datapackage.json").is_file()


def test_heads_become_names() -> None:
    """Greek letters are spelt out, a prime is named, characters without a name in ASCII fall away."""
    assert [ascii_name(head) for head in ("ω_2", "Ω_3", "B'_2", "ϕ/k", "E′", "What it is", "𝕀", "ν_n^2")] == [
        "omega2", "Omega3", "B_prime2", "phi_k", "E_prime", "What_it_is", "I", "nu_n_2",
    ]  # fmt: skip


def test_unproven_numbers_are_marked_in_a_second_column(data: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A column with one number that is not proven has another, which tells them apart; the rest has none."""
    document, *_ = composed(data.parents[1] / "small.toml", data.parent, lambda _: ("csv.gz",), lambda *_: None, 1)
    (table, *_) = [table_listed for table_listed in document.listed("table") if table_listed.id == "tab-samples"]
    (time, cell, *cells), row_last = table.rows
    rows = (time, replace(cell, proven=False), *cells), row_last
    monkeypatch.setattr(document, "listed", lambda kind: [replace(table, rows=rows)] if kind == "table" else [])
    content = package(document, {})["tables/samples.csv"].decode()
    names = content.splitlines()[0].split(",")
    (name_proven,) = [name for name in names if name.endswith("_proven")]
    assert name_proven == f"{names[1]}_proven"
    assert [row[name_proven] for row in csv.DictReader(StringIO(content))] == ["false", "true"]


@pytest.mark.parametrize(
    ("markdown", "plainly"),
    [
        ("s^\N{MINUS SIGN}1^", "s^-1"),
        ("(inertia/s)^2^", "(inertia/s)^2"),
        ("$\\omega_2$ (m $s^{-1}$)", "\N{GREEK SMALL LETTER OMEGA}_2 (m s^-1)"),
        ("$x^2 + y^2$, `f`", "x^2 + y^2, f"),
    ],
)
def test_units_and_heads_are_plain_text(markdown: str, plainly: str) -> None:
    """Powers stand behind one circumflex with a hyphen for minus, whether they were Markdown or TeX."""
    assert words(markdown) == plainly
