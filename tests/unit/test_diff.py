"""``atlas diff``: two built reports are compared number by number and figure by figure, and nothing is passed over."""

import json
from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import Any

import msgspec
import pytest
from click.testing import CliRunner

from atlas.build.report import build_report
from atlas.cli.app import atlas as program
from atlas.errors import AtlasError
from atlas.report.compare import SPACES, Change, compare
from atlas.report.manifest import FigureEntry, Manifest, read

THIN, MINUS = "\N{NARROW NO-BREAK SPACE}", "\N{MINUS SIGN}"
REPORT = """
name = "small"
title = "Small"
[parameters]
bodies.short = {{ title = "A short solenoid", ratio = {ratio} }}
fields.up = {{ title = "up", prime = [1.0, 2.0] }}
[[pages]]
slug = "index"
title = "T"
blocks = [
  {{ kind = "prose", text = "{words}" }},
  {{ kind = "table", table = "quadric", body = "short", field = "up", id = "quadric" }},
  {{ kind = "figure", recipe = "lssc", id = "body", parameters = {{ ratio = {ratio} }} }},
]
"""


def manifest(**other: Any) -> Manifest:
    """Return the manifest of a report, with what is other in it."""
    bowl = FigureEntry("hyp_a", "vector", {"ratio": 2, "field": [1, 2]}, "0" * 64)
    numbers = {"tab-points": {"0.7 | omega3": f"{MINUS}0.658{THIN}823{THIN}529{THIN}4", "1.5 | omega3": "1.2e-07"}}
    same = Manifest(2, "An Atlas", numbers, {"fig-bowl": bowl}, {"page 'loop'": "a"}, {"numpy": "2.4.6"})
    return msgspec.structs.replace(same, **other)


def number(text: str) -> list[Change]:
    """Return what is told when a number becomes this text."""
    return compare(
        manifest(), manifest(numbers={"tab-points": {**manifest().numbers["tab-points"], "0.7 | omega3": text}})
    )


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Callable[..., Path]:
    """Return a function that builds a small report and gives its folder."""

    def make(ratio: float, words: str = "words") -> Path:
        place = tmp_path_factory.mktemp("report")
        (place / "small.toml").write_text(REPORT.format(ratio=ratio, words=words), encoding="utf-8")
        assert build_report(place / "small.toml", place / "out", formats=("html",)).ok
        return place / "out" / "small"

    return make


def test_a_built_report_is_compared_with_another(built: Callable[..., Path]) -> None:
    """With another body its numbers, its figure and its words differ; all three are told, with status 1, else 0."""
    one, two = built(1.5), built(1.6)
    assert compare(read(one), read(one)) == []
    kinds = {change.kind: change for change in compare(read(one), read(two))}
    assert set(kinds) == {"number", "figure", "words"}
    assert compare(read(one), read(built(1.5, "others"))) == [Change("words", "page 'index'")]
    done = CliRunner().invoke(program, ["diff", str(one), str(two / "index.html")], standalone_mode=False)
    assert done.return_value == 1
    assert "fig-body: ratio" in done.output
    assert "semi-axis, C_3 | Value" in done.output
    assert "$" not in done.output  # a terminal sets no TeX
    same = CliRunner().invoke(program, ["diff", str(one), str(one), "--json"], standalone_mode=False)
    assert same.return_value == 0
    assert json.loads(same.stdout) == {"changed": False, "changes": []}


def test_a_number_is_named_by_its_row_and_column(built: Callable[..., Path]) -> None:
    """By the first cell of its row, and by the next where several rows share that; words are no numbers."""
    numbers = read(built(1.5)).numbers["tab-quadric"]
    assert numbers["ratio of the moments (33) | Value"] == f"1.500{THIN}000{THIN}000"
    assert numbers["semi-axis, $C_3$ | Value"] == f"0.666{THIN}666{THIN}666{THIN}7"
    assert all(text.translate(SPACES).replace(".", "").lstrip("-").isdigit() for text in numbers.values())


def test_the_difference_is_exact() -> None:
    """New less old, and its size over that of old, to the last digit."""
    (found,) = number("-0.6588235301")
    assert (found.where, found.old, found.new) == ("tab-points: 0.7 | omega3", "-0.6588235294", "-0.6588235301")
    assert found.difference == Decimal("-7e-10")
    assert abs(Fraction(found.relative or 0) / Fraction(7, 6588235294) - 1) < Fraction(1, 10**30)


@pytest.mark.parametrize("text", ["-0.6588235294", f"{MINUS}0.658823{THIN}5294"])
def test_signs_and_spaces_of_another_kind_are_no_change(text: str) -> None:
    """A hyphen for a minus sign and digits in other groups leave a number the same."""
    assert number(text) == []


@pytest.mark.parametrize("text", ["-0.658823529", "-0.65882352940", "-0.6588235294?", "?", "1e-400", "9e999999"])
def test_other_digits_are_a_change(text: str) -> None:
    """More or fewer of them, less proven ones, none at all, and numbers that no double holds."""
    (found,) = number(text)
    assert found.new == text
    assert (found.difference is None) == (text == "?")


def test_what_came_or_went_is_told() -> None:
    """Numbers, figures, pages and libraries in only one of the reports; parameters and pictures that changed."""
    bowl = manifest().figures["fig-bowl"]
    new = manifest(
        numbers={"tab-points": {"1.5 | omega3": "1.2e-07"}, "tab-new": {"row | k": "1"}},
        figures={
            "fig-bowl": msgspec.structs.replace(bowl, parameters={"ratio": 2.0, "field": [1, 3]}, sha256=None),
            "fig-cup": bowl,
        },
        words={"page 'ball'": "b"},
        versions={},
    )
    assert compare(manifest(), new) == [
        Change("number", "tab-points: 0.7 | omega3", "-0.6588235294", ""),
        Change("number", "tab-new: row | k", "", "1"),
        Change("figure", "fig-bowl: field", "[1, 2]", "[1, 3]"),
        Change("figure", "fig-bowl: picture", "drawn", "failed"),
        Change("figure", "fig-cup", "", "hyp_a"),
        Change("words", "page 'loop' (removed)"),
        Change("words", "page 'ball' (added)"),
        Change("version", "numpy", "2.4.6", ""),
    ]


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        (None, "is not a built report"),
        ("{", "is not the manifest of a report"),
        ('{"format": 1}', "has format 1; this atlas reads format 2: build the report anew"),
        ('{"format": 2}', "is not the manifest of a report"),
    ],
)
def test_what_is_no_built_report_is_one_sentence(tmp_path: Path, text: str | None, complaint: str) -> None:
    """It names the folder and what is wrong there."""
    if text is not None:
        (tmp_path / "manifest.json").write_bytes(text.encode("utf-8", "surrogateescape"))
    with pytest.raises(AtlasError, match=complaint) as caught:
        read(tmp_path)
    assert str(tmp_path) in str(caught.value).splitlines()[-1]
