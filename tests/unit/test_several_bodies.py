"""`atlas.report`, reports for each row of a table, and two cards side by side."""

import csv
import json
import re
import tomllib
from pathlib import Path

import pytest

import atlas
from atlas.book.card import card
from atlas.book.several_bodies import against, as_words, difference, value_of
from atlas.cli.app import main
from atlas.cli.several_bodies import rows_of
from atlas.cli.your_body import request_of, words_of
from atlas.errors import AtlasError
from atlas.places import folder


def run(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, str, str]:
    """Run a command; return its exit status, its output and its messages."""
    with pytest.raises(SystemExit) as end:
        main(["report", "your_body", *words])
    captured = capsys.readouterr()
    return int(str(end.value.code)), captured.out, captured.err


def test_a_column_is_an_option_with_the_unit_of_its_head(tmp_path: Path) -> None:
    """A unit in a cell goes before that of the head, an empty cell leaves the option out, spaces part numbers."""
    (file := tmp_path / "bodies.csv").write_text(
        "shape,radius [um],height,magnetic [mT],omega,inertia\n"
        "disk,1.20(5),,1 2,1 2 3,\nsolid-cylinder,900nm,1e-6,3 -4,,\n,,,,,1 2 2.5\n"
    )
    assert [*rows_of(file)] == [
        (2, "--shape disk --radius 1.20(5)um --magnetic 1mT 2mT --omega 1 2 3".split()),
        (3, "--shape solid-cylinder --radius 900nm --height 1e-6 --magnetic 3mT -4mT".split()),
        (4, "--inertia 1 2 2.5".split()),
    ]


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("", "it needs a line of names"),
        ("ratio,field\n", "must have a heading"),
        ("ratoi,field\n0.7,1 2\n", "column ratoi: there is no option 'ratoi' of a body (did you mean 'ratio'?)"),
        ("ratio,ratio\n0.7,0.8\n", "a heading of different names"),
        ("ratio,field\n0.7\n", "line 2: 1 cells where the line of names has 2"),
    ],
)
def test_a_malformed_table_of_bodies_is_refused_in_a_line(
    text: str, fault: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Status 2, nothing built."""
    (file := tmp_path / "bodies.csv").write_text(text)
    status, _, message = run(capsys, "--each", str(file), "--out", str(tmp_path / "out"))
    assert (status, message.count("\n")) == (2, 1)
    assert fault in message
    assert not (tmp_path / "out").exists()


@pytest.mark.slow
def test_rows_that_fail_are_listed_and_the_others_built(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Equal bodies have one folder; the index has a row for each line, its CSV the numbers of the cards."""
    (file := tmp_path / "bodies.csv").write_text("ratio,title\n0.7,$[*a_b\n3,\n0.70,\n")
    status, out, message = run(
        capsys, "--each", str(file), "--field", "1", "2", "--omega2", "0.7", "--out", str(tmp_path)
    )
    index, _, table = map(Path, out.split())
    rows = [*csv.DictReader(table.read_text().splitlines())]
    assert status == 1
    assert "line 3: column ratio: --ratio: No body has I" in message
    assert [row["line"] for row in rows] == ["2", "3", "4"]
    assert rows[0]["name"] == rows[2]["name"] != ""
    assert rows[1]["name"] == "" != rows[1]["fault"]
    result = json.loads((tmp_path / f"{rows[0]['name']}.card.json").read_text())
    assert float(rows[0]["turn"]) == result["turn"]["value"]
    page = index.read_text()
    assert page.count(f'href="{rows[0]["name"]}/index.html"') == 2
    assert (tmp_path / rows[0]["name"] / "index.html").is_file()
    assert 'class="words sorts"' in page
    assert "$[*a_b</a>" in page


def test_differences_have_the_digits_that_both_numbers_have() -> None:
    """No digit of a difference is beyond those of its terms; sigmas add in quadrature; other units have none."""
    entry = {"value": 1.25, "digits": "1.250", "sigma": None, "unit": "s"}
    assert difference(entry, entry | {"value": 1.5, "digits": "1.50000"}) == "0.250"
    assert difference(entry, entry) == "0"
    assert difference(entry, entry | {"unit": "time"}) == difference(entry, entry | {"value": None}) == "\N{EN DASH}"
    uncertain = entry | {"sigma": 0.03}
    assert difference(uncertain, uncertain | {"value": 1.5, "sigma": 0.04}) == "0.250(50)"


def test_two_bodies_stand_side_by_side() -> None:
    """Each number of both cards has a row with its values, and a missing one its reason."""
    pair = [
        request_of(words.split())[0] for words in ("--ratio 0.7 --field 1 2 --omega2 0.7", "--ratio 0.7 --field 2 0")
    ]
    name, files = against(*pair)
    text = files[f"{name}.md"]
    assert all(entry["letter"].replace("\\", "\\\\") in text or entry["letter"] in text
               for entry in card(pair[0]).values() if entry["value"] is not None)  # fmt: skip
    assert "4.014179846" in text
    assert "no start was given" in text


def test_keywords_are_the_options_of_the_command() -> None:
    """Numbers in Python are typed with all their digits, with their standard deviation if they have one."""

    class Uncertain(float):
        nominal_value, std_dev = 2e-7, 1e-9

    assert words_of("omega", (0.1, 1, -2e-30)) == ["--omega", "0.1", "1", "-2e-30"]
    assert words_of("radius", "1.2um") == ["--radius", "1.2um"]
    assert words_of("charge_to_mass", Uncertain()) == ["--charge-to-mass", "0.0000002±1e-09"]
    with pytest.raises(AtlasError, match="did you mean 'omega2'"):
        words_of("omega_2", 0.7)


@pytest.mark.slow
def test_python_makes_the_files_of_the_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The same names and bytes, and the card as a table in a notebook."""
    body = atlas.SymmetricBody(1.0, 0.7)
    report = atlas.report("your_body", body=body, field=(1, 2), omega2=0.7, out=tmp_path / "one")
    words = "--inertia 1.0 0.7 --field 1 2 --omega2 0.7"
    status, out, _ = run(capsys, *words.split(), "--out", str(tmp_path / "two"))
    assert status == 0
    for file, path in zip(report.files, map(Path, out.split()), strict=True):
        assert file.name == path.name
        assert file.read_bytes() == path.read_bytes()
    assert report.card["turn"]["value"] == pytest.approx(4.014179846)
    assert "4.014179846 time" in report._repr_html_()


def test_python_builds_reports_with_inputs(tmp_path: Path) -> None:
    """A file of one's own with the inputs that it declares; an unknown one is refused."""
    head = '+++\nname = "mine"\ntitle = "Mine"\n[inputs.ratio]\nkind = "number"\ndefault = 1.5\n+++\n'
    (file := tmp_path / "mine.md").write_text(f"{head}\n# One\n\nI is <$ ratio $>.\n")
    report = atlas.report(file, ratio=0.7, out=tmp_path)
    assert "I is 0.7" in report.files[0].read_text()
    with pytest.raises(AtlasError, match="there is no input 'ratoi'"):
        atlas.report(file, ratoi=0.7, out=tmp_path)


BODIES = folder("reports") / "bodies"


@pytest.mark.parametrize("name", [row[0] for row in csv.reader((BODIES / "gallery.csv").read_text().splitlines()[1:])])
def test_the_guide_has_the_card_of_each_body_of_the_gallery(name: str) -> None:
    """Its numbers are computed from the file of inputs, which names a source and its assumptions."""
    result = card(request_of(["--from", name])[0])
    row = [value_of(result[key]) for key in ("ratio", "tilt", "turn", "spin", "nutation")]
    guide = (folder("reports") / "guide.md").read_text("utf-8")
    assert ", ".join(f'"{cell}"' for cell in (f"`{name}`", *row)) in guide
    record = tomllib.loads((BODIES / f"{name}.inputs.toml").read_text("utf-8"))
    assert all(as_words(record[key]) in guide.replace("\\\\", "\\") for key in ("source", "cited", "assumed"))


def test_toutatis_turns_with_the_periods_that_were_cited() -> None:
    """7.35 days of precession and 5.41 days about its long axis, in seconds."""
    result = card(request_of(["--from", "toutatis"])[0])
    assert result["turn"]["value"] == pytest.approx(7.35 * 86400, rel=1e-6)
    assert result["nutation"]["value"] == pytest.approx(5.41 * 86400, rel=1e-6)


def test_an_unknown_body_of_the_gallery_is_refused() -> None:
    """The nearest name is offered."""
    with pytest.raises(AtlasError, match="did you mean 'toutatis'"):
        request_of(["--from", "toutatus"])


@pytest.mark.slow
def test_another_start_redraws_and_names_the_dependent_figures(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Surfaces of the body in its field are taken from the cache; the figures of the motion name omega2."""
    words = ["--ratio", "0.7", "--field", "1", "2", "--explain", "--out", str(tmp_path / "build" / "report")]
    run(capsys, *words, "--omega2", "0.7")
    _, out, _ = run(capsys, *words, "--omega2", "0.8")
    reasons = {
        match[1]: (match[2], match[3])
        for match in re.finditer(r"^ *figure +(\w+)\(.*\) +(drawn|taken): (.*?) *$", out, re.MULTILINE)
    }
    assert reasons["motion"] == reasons["motion_sphere"] == ("drawn", "changed inputs: omega2")
    assert all(
        reasons[name][0] == "taken" for name in ("quadric", "hyperbola", "frequencies", "stability", "motion_map")
    )
