"""How long changes take: the edits can be made, and what is measured is what happened."""

import ast
import json
import tomllib
from pathlib import Path

import pytest
from benchmarks import changes, rebuilds

from atlas import AtlasError
from atlas.build import appendices
from atlas.build.sources import PACKAGE
from atlas.report.numbers import Number


@pytest.mark.parametrize("change", changes.CHANGES, ids=lambda change: change.name)
def test_each_edit_can_be_made_and_leaves_a_whole_file(change: changes.Change) -> None:
    """An edit fits the sources as they are, is another one each time, and breaks no file."""
    text = (PACKAGE.parent / change.file).read_text(encoding="utf-8")
    edited = [change.edit(text, number) for number in range(3)]
    if change.edit is not changes.nothing:
        assert len({text, *edited}) == 4
    for one in edited:
        if change.file.endswith(".toml"):
            tomllib.loads(one)
        elif change.file.endswith(".py"):
            ast.parse(one)
        elif change.file.endswith(".json"):
            json.loads(one)


@pytest.mark.parametrize("change", [one for one in changes.CHANGES if "parameter" in one.edit.__qualname__])
def test_a_changed_parameter_is_that_of_a_figure(change: changes.Change) -> None:
    """What is said to be a parameter of a figure changes one block, and that is a figure."""
    text = (PACKAGE.parent / change.file).read_text(encoding="utf-8")
    before, after = (
        [block for page in tomllib.loads(one)["pages"] for block in page["blocks"]]
        for one in (text, change.edit(text, 1))
    )
    assert [one["kind"] for one, other in zip(before, after, strict=True) if one != other] == ["figure"]


def test_the_pdf_of_a_figure_is_not_that_of_the_report() -> None:
    """Pages are counted, and of the PDFs only the one beside their folder."""
    assert rebuilds.kinds(["atlas/index.html", "atlas/ball.html", "atlas/figures/01-ball.pdf"]) == (2, False)
    assert rebuilds.kinds(["atlas.pdf"]) == (0, True)


def test_an_edit_that_does_not_fit_is_told() -> None:
    """A block or a line that is not there is an error that names it."""
    with pytest.raises(AtlasError, match="no block with the id 'nowhere'"):
        changes.parameter("nowhere", "ratio", 1.0)('id = "here"\n\n', 0)
    with pytest.raises(AtlasError, match="no line begins with 'import'"):
        changes.line("import", "x")("from os import path\n", 0)
    with pytest.raises(AtlasError, match="'old' is not there"):
        changes.swap("old", "new")("text", 0)


def test_what_is_measured_is_what_happened(tmp_path: Path) -> None:
    """In a copy of the sources a figure is drawn once for each new parameter, and not again for the same."""
    checkout = rebuilds.Checkout(tmp_path)
    drawn, taken = (change for change in changes.CHANGES if change.command[0] == "figure")
    found = [checkout.measure(change, 2) for change in (drawn, taken)]
    assert [one.figures for one in found] == [1, 0]
    assert all(len(one.seconds) == 2 and min(one.seconds) > 0.0 for one in found)
    assert "{" not in found[0].command
    assert str(tmp_path) not in found[0].command


def test_a_command_that_fails_is_told(tmp_path: Path) -> None:
    """What went wrong in the copy stands in the error."""
    with pytest.raises(AtlasError, match=r"ended with 2.*no figure 'hyperbole'"):
        rebuilds.Checkout(tmp_path).run(("figure", "hyperbole"))


def test_the_record_becomes_a_table(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each change is a row with its median; the build from nothing stands in the note; without a record it is told."""
    (tmp_path / "data").mkdir()
    monkeypatch.setattr(rebuilds, "stored", lambda: tmp_path / "data" / "rebuilds.json")
    monkeypatch.setattr(appendices, "folder", lambda _kind: tmp_path)
    with pytest.raises(AtlasError, match=r"There is no record rebuilds\.json"):
        appendices._rebuilds()
    taken = rebuilds.Taken("a sentence", "atlas report", 0, 1, True, (1.3, 1.1, 1.2))
    rebuilds.store([taken], rebuilds.Cold(10.0, 5.0, 8.0))
    table = appendices._rebuilds()["changes"]
    assert table.rows == (("A sentence", "`atlas report`", Number("0"), Number("1"), "set", Number("1.20")),)
    assert "5.0 s on two cores and 10.0 s on one, 2.00 times as long" in " ".join(table.notes)
    assert "1.25 times that" in " ".join(table.notes)


def test_the_record_is_of_this_code() -> None:
    """The stored times are those of the code that builds and of the changes as they are; its command renews it."""
    found = json.loads(rebuilds.stored().read_text(encoding="utf-8"))
    assert found["command"] == "make rebuilds"
    assert found["code"] == rebuilds.code()
    assert {change["name"] for change in found["changes"]} == {change.name for change in changes.CHANGES}
