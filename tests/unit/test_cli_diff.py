"""``atlas diff`` as it is typed: what it prints, where, and how it ends."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from unit.test_report_compare import Change, report, rows

from atlas.cli import app
from atlas.cli.diff import command

Run = Callable[..., tuple[int, str, str]]


@pytest.fixture
def run(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Run:
    """Return a function that runs the program and gives its status, standard output and standard error."""
    monkeypatch.setitem(app.atlas.commands, "diff", command)

    def runner(*words: object) -> tuple[int, str, str]:
        with pytest.raises(SystemExit) as end:
            app.main(["diff", *map(str, words)])
        out, err = capsys.readouterr()
        assert isinstance(end.value.code, int)
        return end.value.code, out, err

    return runner


@pytest.fixture
def pair(tmp_path: Path) -> Callable[..., tuple[Path, Path]]:
    """Return a function that writes the sample and the sample after a change."""
    return lambda change=lambda _: None, bowl="one": (
        report(tmp_path / "old"),
        report(tmp_path / "new", change, bowl),
    )


def moved(record: dict[str, Any]) -> None:
    """Change a number, a word, a caption and a figure."""
    rows(record)[2][2] = "0.6588235301"
    rows(record)[3][3] = "unstable"
    record["tables"]["tab-points"]["caption"] = "Points of the hyperbola @mf72, " + "far too long to print " * 20
    record["figures"]["fig-bowl"]["parameters"]["ratio"] = 1.5


def test_the_same_reports_print_one_line(run: Run, pair: Callable[..., tuple[Path, Path]]) -> None:
    """Nothing changed: one line, status 0, silence on standard error."""
    assert run(*pair()) == (0, "The two reports are the same: 1 table, 2 figures, 2 pages.\n", "")


def test_changes_are_tables_on_the_terminal(run: Run, pair: Callable[..., tuple[Path, Path]]) -> None:
    """Each kind of change has its table, and the status is 1."""
    status, out, err = run(*pair(moved, "two"))
    assert (status, err) == (1, "")
    lines = {line.split()[0]: " ".join(line.split()) for line in out.splitlines() if line.strip()}
    number = next(line for line in out.splitlines() if "0.6588235301" in line)
    assert number.split()[-3:] == ["7e\N{MINUS SIGN}10", "1.06e\N{MINUS SIGN}9", "8"]
    assert "fig-bowl loop hyp_a ratio 2 → 1.5; picture" in lines["fig-bowl"]
    assert any(line.split() == ["tab-points", "1.5", "Nutation", "marginal", "unstable"] for line in out.splitlines())
    assert "…" in lines["tab-points"]
    assert max(map(len, out.splitlines())) < 250
    for title in ("numbers", "figures", "words in tables"):
        assert f"{title} that changed: 1" in out


def test_json_is_alone_and_has_every_digit(run: Run, pair: Callable[..., tuple[Path, Path]]) -> None:
    """With --json, numbers come as exact texts, the relative difference as a float, figures with all they are."""
    status, out, err = run(*pair(moved, "two"), "--json")
    assert (status, err) == (1, "")
    found = json.loads(out)
    assert found["changed"] is True
    assert found["numbers"] == [
        {
            "table": "tab-points",
            "row": "0.7",
            "column": r"$\omega_3$",
            "unit": r"s$^{-1}$",
            "old": "0.658\u202f823\u202f529\u202f4",
            "new": "0.6588235301",
            "difference": "7e-10",
            "relative": 7 / 6588235294,
            "digits": 8,
        }
    ]
    (word,) = found["words"]
    assert (word["old"], word["new"]) == ("marginal", "unstable")
    (figure,) = found["figures"]
    assert (figure["old"]["parameters"]["ratio"], figure["new"]["parameters"]["ratio"]) == (2, 1.5)
    assert figure["old"]["sha256"] != figure["new"]["sha256"]
    assert [change["what"] for change in found["others"]] == ["caption"]


def test_json_of_the_same_reports_is_empty(run: Run, pair: Callable[..., tuple[Path, Path]]) -> None:
    """Nothing changed: the lists are there and empty."""
    status, out, _ = run(*pair(), "--json")
    found = json.loads(out)
    assert status == 0
    assert found["changed"] is False
    assert [found[key] for key in ("numbers", "words", "figures", "others", "notes")] == [[]] * 5


def test_json_has_null_where_no_double_will_do(run: Run, pair: Callable[..., tuple[Path, Path]]) -> None:
    """A change relative to zero, or beyond a double, is null; the exact texts are there."""

    def change(record: dict[str, Any]) -> None:
        rows(record)[0][2] = "1e-400"
        rows(record)[3][2] = "1e400"

    _, out, _ = run(*pair(change), "--json")
    first, last = json.loads(out)["numbers"]
    assert (first["difference"], first["relative"]) == ("1e-400", None)
    assert (last["new"], last["relative"]) == ("1e400", None)


def test_the_page_is_written_only_when_asked_for(
    run: Run, pair: Callable[..., tuple[Path, Path]], tmp_path: Path
) -> None:
    """Without --page nothing is written; with it one file, and nothing is left beside it."""
    folders = pair(moved, "two")
    before = sorted(tmp_path.rglob("*"))
    run(*folders)
    assert sorted(tmp_path.rglob("*")) == before
    page = tmp_path / "pages" / "diff.html"
    assert run(*folders, "--page", page)[0] == 1
    assert sorted(page.parent.iterdir()) == [page]
    assert page.read_text(encoding="utf-8").endswith("</html>")
    assert page.read_text(encoding="utf-8").count("<img") == 2


def test_a_page_that_cannot_be_finished_leaves_the_old_one(
    run: Run, pair: Callable[..., tuple[Path, Path]], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """When writing stops half-way, the page of before stands, nothing is left beside it, and one line says why."""
    page = tmp_path / "pages" / "diff.html"
    page.parent.mkdir()
    page.write_text("the page of before")

    def full(part: Path, content: bytes) -> None:
        with part.open("wb") as file:
            file.write(content[:100])
        raise OSError(28, "No space left on device")

    reports = pair(moved)
    monkeypatch.setattr(Path, "write_bytes", full)
    status, _, err = run(*reports, "--page", page)
    assert status == 1
    assert "No space left on device" in err
    assert len(err.splitlines()) == 1
    assert page.read_text() == "the page of before"
    assert sorted(page.parent.iterdir()) == [page]


def test_lost_pictures_are_noted_on_standard_error(run: Run, pair: Callable[..., tuple[Path, Path]]) -> None:
    """A lost picture is one line on standard error and no change."""
    old, new = pair()
    (new / "figures/02-hyp-a.png").unlink()
    status, out, err = run(old, new, "--json")
    assert status == 0
    assert json.loads(out)["notes"] == [f"{new}: lost or altered since the build: figures/02-hyp-a.png."]
    assert err == f"atlas: {new}: lost or altered since the build: figures/02-hyp-a.png.\n"


@pytest.mark.parametrize("words", [("old", "nowhere"), ("nowhere", "new")])
def test_a_wrong_folder_is_one_line(
    run: Run, pair: Callable[..., tuple[Path, Path]], tmp_path: Path, words: tuple[str, str]
) -> None:
    """A folder that is not there ends with status 2 and one line that names it."""
    pair()
    status, out, err = run(*(tmp_path / word for word in words))
    assert (status, out) == (2, "")
    assert err.startswith(f"atlas: {tmp_path / 'nowhere'} is not a built report")
    assert len(err.splitlines()) == 1


def test_words_in_brackets_are_printed_as_they_are(run: Run, pair: Callable[..., tuple[Path, Path]]) -> None:
    """Cells that look like markup of the terminal are words like any other."""
    change: Change = lambda record: rows(record)[3].__setitem__(3, "[bold]☄[/bold] ünïcode")  # noqa: E731  a change
    _, out, _ = run(*pair(change))
    assert "[bold]☄[/bold] ünïcode" in out


def test_the_help_tells_the_exit_status(run: Run) -> None:
    """The three ways to end are in the help."""
    status, out, _ = run("--help")
    assert status == 0
    assert "The exit status is 0 if nothing changed, 1 if something did, 2 if" in " ".join(out.split())
