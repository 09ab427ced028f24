"""A report definition of any content: whole pages in which text is text, or one line that names the culprit."""

import copy
import json
import shutil
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from lxml import html
from test_commands import ran
from values import share

SHELL = {"title": "silica shell", "shape": "cylindrical_shell", "mass": 1.5e-15, "radius": 1e-6, "height": 1.2e-6}
TABLES = {
    "body_and_field": {},
    "quadric": {},
    "points": {"omega2": [-3.0, 0.7]},
    "motion": {"omega2": 0.7},
    "flight": {"omega2": 0.7, "velocity": [3e-6, 0.0, 0.0], "point": [0.0, 1e-6, 0.0], "times": [0.0, 0.5]},
    "particle": {"velocity": [0.3, 0.0, 0.0], "times": [0.0, 0.5]},
    "charges": {},
    "sheet": {"omega2": 0.7},
}
REPORT: dict[str, Any] = {
    "name": "mine",
    "title": "A title",
    "authors": ["A. Author"],
    "abstract": "Of $x$.",
    "parameters": {
        "bodies": {"shell": {**SHELL, "charge": 2e-15}, "ball": {"title": "b", "ratio": 1.0}},
        "fields": {
            "magnet": {"title": "field", "system": "SI", "B": [0.0, 0.75, 1.3], "E": [5e-7, 0.0, 0.0]},
            "rates": {"title": "field", "prime": [1.0, 2.0]},
        },
    },
    "pages": [
        {
            "slug": "index",
            "title": "First",
            "blocks": [
                {"kind": "prose", "text": "See @(51), @tab:one and [a link](https://example.org)."},
                {"kind": "equation", "name": "(71)"},
            ],
        }
    ],
}
MARKUP = (
    "<script>alert(1)</script>",
    "[a](javascript:alert(1))",
    '<img src=x onerror="alert(1)">',
    "`#panic()`{=typst}",
    "```{=html}\n<script>1</script>\n```",
    "$x",
    "@nosuch",
    "@tab:nosuch",
    "$\\frac{1$",
    "---\na: b\n---",
    "{{ 7*7 }}",
    "../../etc/passwd",
    "index",
    "a b",
    "",
    "é\u202e\u0000",
    "x" * 5000,
)
texts = st.sampled_from(MARKUP)
numbers = st.one_of(
    st.sampled_from([0, 1, -1, 0.0, 1e308, -1e-308, 5e-324, 1e200, float("nan"), float("inf"), 10**30, True]),
    st.floats(-1e3, 1e3),
    st.floats(allow_nan=False),
)
values = st.one_of(texts, numbers, st.sampled_from([[], {}, [[]], ["x", 1], [0.0, 0.0, 0.0], [1.0, 2.0], {"a": 1}]))


def places(value: Any, path: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    """Return the way to each value within nested tables and lists."""
    inner = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    return [path] * bool(path) + [branch for key, item in inner for branch in places(item, (*path, key))]


def block(table: str, name: str) -> dict[str, Any]:
    """Return a table of the shell in the magnet."""
    who = {"bodies": ["shell"]} if table in {"charges", "sheet"} else {"body": "shell"}
    parameters = {"parameters": copy.deepcopy(TABLES[table])} if TABLES[table] else {}
    return {"kind": "table", "table": table, "id": name, "field": "magnet", **who, **parameters}


@st.composite
def reports(draw: Any) -> dict[str, Any]:
    """Draw a report with one or two tables, in which up to three values are changed, taken out or added."""
    report = copy.deepcopy(REPORT)
    blocks = report["pages"][0]["blocks"]
    for k, table in enumerate(draw(st.lists(st.sampled_from(list(TABLES)), min_size=1, max_size=2))):
        blocks.append(block(table, ("one", "two")[k]))
    for _ in range(draw(st.integers(0, 3))):
        way = draw(st.sampled_from(places(report)))
        holder = report
        for key in way[:-1]:
            holder = holder[key]
        change = draw(st.integers(0, 4))
        if change == 0:
            del holder[way[-1]]
        elif change == 1 and isinstance(holder, dict):
            holder[draw(st.sampled_from(["nosuch", "E", "digits", "times", "caption", "note", "system"]))] = (
                copy.deepcopy(draw(values))
            )
        else:
            old = holder[way[-1]]
            alike = texts if isinstance(old, str) else numbers if isinstance(old, int | float) else values
            holder[way[-1]] = copy.deepcopy(draw(alike if change < 4 else values))
    return report


def toml(value: Any) -> str:
    """Return a value as TOML, tables inline."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{json.dumps(key)} = {toml(item)}" for key, item in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml, value)) + "]"
    if isinstance(value, str):
        return json.dumps(value).replace("\x7f", "\\u007f")
    return json.dumps(value).replace("NaN", "nan").replace("Infinity", "inf")


def toml_of(report: dict[str, Any]) -> str:
    """Return a report as TOML."""
    return "\n".join(f"{json.dumps(key)} = {toml(value)}" for key, value in report.items())


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder for the definitions and their pages."""
    return tmp_path_factory.mktemp("reports")


@pytest.mark.slow
def test_the_report_that_is_changed_is_a_good_one(folder: Path) -> None:
    """The unchanged report becomes pages, with each of the tables."""
    names = ("one", *(table.replace("_", "-") for table in TABLES))  # the prose cites the first
    blocks = [*REPORT["pages"][0]["blocks"], *map(block, TABLES, names)]
    report = {**REPORT, "pages": [{**REPORT["pages"][0], "blocks": blocks}]}
    file = folder / "mine.toml"
    file.write_text(toml_of(report), encoding="utf-8")
    status, _, err = ran(["report", str(file), "--format", "html", "--out", str(folder / "out")])
    assert status == 0, err


@pytest.mark.slow
@share(0.05, 5)
@given(report=reports())
def test_any_report_becomes_pages_or_a_line_a_fault(folder: Path, report: dict[str, Any]) -> None:
    """Wrong types, missing and foreign keys, extreme numbers, markup: nothing runs, nothing is half written."""
    file, out = folder / "mine.toml", folder / "out"
    file.write_text(toml_of(report), encoding="utf-8")
    shutil.rmtree(out / "mine", ignore_errors=True)
    status, _, err = ran(["report", str(file), "--format", "html", "--out", str(out)])
    report_and_message = (report, err)
    assert "Traceback" not in err, report_and_message
    pages = list(out.rglob("*.html"))
    if status == 2:
        faults = err.splitlines()
        assert faults, report_and_message
        assert all(line.startswith(f"atlas: {file}") or len(faults) == 1 for line in faults), report_and_message
        assert all(len(line) < 1500 for line in faults), report_and_message
        assert not pages, report_and_message
        return
    assert status == 0, report_and_message
    assert pages, report_and_message
    for page in pages:
        root = html.fromstring(page.read_bytes())
        assert "alert(1)" not in " ".join(root.xpath("//script//text()")), report_and_message
        assert not root.xpath("//@onerror | //@onclick | //*[starts-with(@href, 'javascript:')]"), report_and_message
        assert not [cell for cell in root.xpath("//td//text()") if cell.strip().lower() in {"nan", "inf"}], (
            report_and_message
        )
    assert not {path.name for path in folder.iterdir()} - {"mine.toml", "out"}, report_and_message
