"""Inputs of a report: declared in its head, set by a call, filled in by a sandbox, refused before anything is drawn."""

import json
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from atlas.book.expansion import ExpansionError, expanded
from atlas.book.inputs import declared, evaluated, name_of
from atlas.book.load import load
from atlas.cli.app import main
from atlas.cli.report import command
from atlas.errors import AtlasError, FaultsError

REPORT = """+++
name = "paper"
title = "A body with the ratio <$ ratio $>"

[inputs.ratio]
kind = "number"
range = [0.0, 2.0]
default = 0.5
help = "I3/I2"

[inputs]
height = { kind = "number", unit = "um", help = "its height" }
colour = { kind = "choice", choices = ["red", "blue"], default = "red" }
rates = { kind = "numbers", count = 2, default = [1.0, 2.0] }

[parameters.bodies.body]
title = "body"
ratio = "<$ ratio $>"
+++

Abstract.

# Page

A height of <$ height $> micrometres.

<% for rate in rates %>
The rate <$ rate $>.

<% endfor %>
<% if colour == "red" %>
```{listing}
id = "heights"
caption = "Of the height <$ height $>."
columns = ["Height"]
rows = [["<$ height $>"]]
```

<% endif %>
$x<1$ and %.
"""


@pytest.fixture
def paper(tmp_path: Path) -> Path:
    """Write a report with inputs."""
    file = tmp_path / "paper.md"
    file.write_text(REPORT)
    return file


def test_inputs_are_in_head_prose_loops_tables_and_captions(paper: Path) -> None:
    """A number of the head stays a number; text, a loop, a condition and a caption have the values."""
    values = evaluated(paper, {"ratio": "3/2", "height": "1200nm"})
    report = load(paper, values)
    assert report.title == "A body with the ratio 1.5"
    assert report.parameters.bodies["body"].ratio == 1.5
    text_first, listing, text_last = report.pages[0].blocks
    assert "A height of 1.2 micrometres." in text_first.text  # type: ignore[attr-defined]
    assert "The rate 1.0.\n\nThe rate 2.0." in text_first.text  # type: ignore[attr-defined]
    assert (listing.caption, listing.rows) == ("Of the height 1.2.", (("1.2",),))  # type: ignore[attr-defined]
    assert text_last.text == "$x<1$ and %."  # type: ignore[attr-defined]
    assert len(load(paper, values | {"colour": "blue"}).pages[0].blocks) == 1


def test_all_wrong_inputs_are_refused_at_once(paper: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Each in a line with file, line of its declaration, input and remedy; status 2, and nothing is written."""
    with pytest.raises(SystemExit) as end:
        main(["report", str(paper), "--set", "ratoi=1", "ratio=5", "height=1kg", "colour=green", "rates=1",
              "--out", str(paper.parent / "out")])  # fmt: skip
    assert end.value.code == 2
    lines = capsys.readouterr().err.splitlines()
    assert [line.partition("input ")[0] for line in lines] == [
        f"atlas: {paper}, line {n}: " for n in (5, 5, 12, 13, 14)
    ]
    for line, words in zip(
        lines, ("ratoi: there is no input 'ratoi' (did you mean 'ratio'?)", "from 0 to 2", "the unit is um",
                "'green'; known: ", "write 2, as 1,2,3"), strict=True,
    ):  # fmt: skip
        assert words in line
    assert not (paper.parent / "out").exists()


def test_an_input_without_a_default_is_required(paper: Path) -> None:
    """The message names the option that gives it; a report is not loaded without."""
    with pytest.raises(FaultsError, match=r"line 12: input height: it is required; give it by --set height=VALUE"):
        load(paper)


@pytest.mark.parametrize("text", ["nan", "1e999", "abc", "1/0", "", "1 2"])
def test_non_numbers_are_refused_as_inputs(paper: Path, text: str) -> None:
    """Neither nan nor a number beyond floats nor a word is a height."""
    with pytest.raises(FaultsError, match="input height"):
        evaluated(paper, {"height": text})


def test_equal_values_have_one_name(paper: Path) -> None:
    """1200nm is 1.2um; another height has another name; the defaults alone bear no digest."""
    names = [name_of(paper, evaluated(paper, {"height": text})) for text in ("1200nm", "1.2um", "1.2", "1.3")]
    assert names[0] == names[1] == names[2] != names[3]
    paper.write_text(REPORT.replace('unit = "um",', 'unit = "um", default = "1.2um",'))
    assert name_of(paper, evaluated(paper, {"height": "1200nm"})) == "paper"


def test_inputs_are_listed_and_nothing_is_drawn(paper: Path) -> None:
    """By --help and as JSON."""
    output = CliRunner().invoke(command, [str(paper), "--help"]).output
    assert "ratio=0.5" in output
    assert "number, in um, its height" in output
    records = json.loads(CliRunner().invoke(command, [str(paper), "--inputs", "json"]).output)[str(paper)]
    assert [(record["name"], record["default"]) for record in records][:2] == [("ratio", 0.5), ("height", None)]
    assert [*paper.parent.iterdir()] == [paper]
    of_body = json.loads(CliRunner().invoke(command, ["your_body", "--inputs", "json"]).output)["your_body"]
    assert {one["name"]: (one["kind"], one["unit"], one["count"]) for one in of_body}.items() >= {
        ("ratio", ("number", "", 1)), ("field", ("numbers", "rad/s", None)), ("omega", ("numbers", "rad/s", 3)),
    }  # fmt: skip
    assert {*of_body[0]} == {*records[0]}
    assert "--field B2 B3 or B1 B2 B3" in CliRunner().invoke(command, ["your_body", "--help"]).output


def test_all_malformed_declarations_are_refused_at_once(paper: Path) -> None:
    """Each with the line of its input."""
    paper.write_text(REPORT.replace('kind = "choice"', 'kind = "chioce"').replace("count = 2", "cuont = 2"))
    with pytest.raises(FaultsError) as refused:
        declared(paper)
    one, other = refused.value.sentences
    assert f"{paper}, line 13: inputs 'colour', kind: must be one of" in one
    assert f"{paper}, line 14: inputs 'rates': there is no key 'cuont' here (did you mean 'count'?)" in other
    paper.write_text("+++\nname = 'paper'\ninputs = 5\n+++\n")
    with pytest.raises(AtlasError, match="line 3: inputs: write a table"):
        declared(paper)


@pytest.mark.slow
def test_a_mistake_has_the_line_of_the_file(paper: Path) -> None:
    """Below a loop that makes lines, and in a template."""
    values = evaluated(paper, {"height": "1"})
    for old, new, line, words in (
        ("columns", "colums", 35, "colums"),
        ("<$ rate $>", "<$ speed $>", 28, "'speed' is undefined"),
        ("<$ rate $>", "<$ rate.__class__ $>", 28, "__class__"),
        ("<% endfor %>", "", 40, "endfor"),
        ("ratio <$ ratio $>", "ratio <$ ratios $>", 3, "'ratios' is undefined"),
    ):
        paper.write_text(REPORT.replace(old, new, 1))
        with pytest.raises(AtlasError, match=rf"paper\.md, line {line}: .*{words}"):
            load(paper, values)


@pytest.mark.parametrize(
    "template",
    [
        "<$ x.__class__.__mro__ $>", "<$ ''.__class__ $>", "<$ cycler.__init__.__globals__ $>",
        "<$ x|attr('__class__') $>", "<$ '{0.__class__}'.format(x) $>", "<% include '/etc/passwd' %>",
        "<% import 'os' as os %>", "<$ range(10**9) $>", "<$ [].append(1) $><$ values.update({'a': 1}) $>",
        "<$ 'x' * 10**10 $>", "<% for i in range(99999) %><$ 'x' * 999 $><% endfor %>",
    ],
)  # fmt: skip
def test_a_template_reaches_no_object_and_grows_no_further(template: str) -> None:
    """Attributes of Python, files, changed values, and texts of gigabytes are refused."""
    with pytest.raises(ExpansionError):
        expanded({"x": 1.0, "values": {}}, {}, template)


@pytest.mark.slow
def test_a_template_does_not_run_for_ever() -> None:
    """A loop in a loop ends by the time of its process."""
    endless = "<% for i in range(99999) %><% for j in range(99999) %><% endfor %><% endfor %>"
    with pytest.raises(ExpansionError, match="5 s"):
        expanded({}, {}, endless)


def test_texts_of_inputs_are_no_templates() -> None:
    """A value with tags stays as it was typed."""
    wild: dict[str, Any] = {"x": "<$ 7 * 7 $>"}
    assert expanded(wild, {"title": "<$ x $>"}, "<$ x $>")[:2] == ({"title": "<$ 7 * 7 $>"}, "<$ 7 * 7 $>")


@pytest.mark.parametrize("kind", ["data", "tex"])
def test_data_and_latex_have_the_inputs_of_a_report(kind: str, paper: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Their folder bears the name that the report itself has with these inputs; a wrong one is refused alike."""
    out, words = paper.parent / "out", [kind, str(paper), "--set", "ratio=3/2", "height=1200nm"]
    with pytest.raises(SystemExit) as end:
        main([*words, "--out", str(out)])
    place = Path(capsys.readouterr().out.strip())
    assert end.value.code == 0
    assert place.parent.name == name_of(paper, evaluated(paper, {"ratio": "3/2", "height": "1200nm"}))
    assert any("1.2" in file.read_text() for file in place.parent.rglob("*.*") if file.suffix in {".csv", ".tex"})
    with pytest.raises(SystemExit) as end:
        main([kind, str(paper), "--set", "hieght=1um", "--out", str(out)])
    assert end.value.code == 2
    assert "did you mean 'height'" in capsys.readouterr().err
