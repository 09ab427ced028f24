"""A sweep of any words: a whole table of numbers, or one line and no file."""

from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from test_commands import number, ran
from values import share

from atlas.files import WRITTEN
from atlas.sweeps.families import FAMILIES as KNOWN

FAMILIES = {
    name: {
        key: f"{x:g}" for p in swept.family.parameters if p.needed for key, x in zip(p.names, p.default, strict=True)
    }
    for name, swept in KNOWN.items()
    if swept.family.at_once > 1  # a row alone takes seconds
}
"""Every family with its required parameters, at their defaults."""

value_word = st.one_of(number, st.tuples(number, number).map(":".join), st.tuples(number, number).map(",".join))
ranges = st.one_of(
    value_word,
    st.tuples(number, number, st.sampled_from(["2", "3", "0", "-1", "1.5", "x", ""])).map(":".join),
    st.tuples(number, number, st.sampled_from(["2:log", "3:log", "2:exp"])).map(":".join),
)


@st.composite
def command_words(draw: Any) -> list[str]:
    """Draw a sweep of a family with some of its parameters changed, left out or foreign, and its quantities."""
    family = draw(st.sampled_from(list(FAMILIES)))
    defaults = dict(FAMILIES[family])
    more = [*defaults, *KNOWN[family].optional, "nosuch"]
    for name in draw(st.lists(st.sampled_from(more), max_size=2, unique=True)):
        defaults[name] = draw(ranges)
        if draw(st.integers(0, 5)) == 0:
            del defaults[name]
    words = [family, *(word for name, value in defaults.items() for word in ("--set", f"{name}={value}"))]
    names = draw(st.lists(st.sampled_from([*KNOWN[family].quantities, "nosuch"]), min_size=1, max_size=3))
    words += [word for name in names for word in ("--quantity", name)]
    if draw(st.integers(0, 4)) == 0:
        words += ["--digits", draw(st.sampled_from(["1", "20", "0", "x", "1000"]))]
    return words


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder for the tables."""
    return tmp_path_factory.mktemp("sweeps")


@pytest.mark.slow
@share(0.03, 25)
@given(words=command_words(), kind=st.sampled_from(["csv", "csv", "csv", "npz", "txt"]))
def test_any_sweep_is_a_table_or_a_line(folder: Path, words: list[str], kind: str) -> None:
    """Ranges that are none, names of others, extreme numbers: all rows or no file."""
    out = folder / f"mine.{kind}"
    for before in folder.iterdir():
        before.unlink()
    status, _, err = ran(["sweep", *words, "-j", "1", "--out", str(out)])
    report = (words, err)
    assert "Traceback" not in err, report
    if status:
        assert status == 2, report
        assert err.count("\n") == 1, report
        assert len(err) < 1500, report
        assert not out.exists(), report
    else:
        assert out.stat().st_size, report
    assert {path.name for path in folder.iterdir()} <= {out.name, WRITTEN}, report
