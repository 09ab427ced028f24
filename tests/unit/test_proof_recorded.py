"""Recorded verdicts: they are written whole, read back the same, and go stale when a proof changes."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from atlas.cli.app import atlas as command
from atlas.errors import AtlasError
from atlas.trial import proofs as proof
from atlas.trial.proofs import recorded, run

VERDICT = recorded.load()["(72)"]


def test_saved_records_are_read_back(tmp_path: Path) -> None:
    """A record is the same after the way through the file, and others of the file stay."""
    path = tmp_path / "verdicts.json"
    recorded.save([VERDICT, recorded.load()["(48)"]], path)
    assert recorded.load(path) == {"(48)": recorded.load()["(48)"], "(72)": VERDICT}
    changed = replace(VERDICT, verdict="undecided")
    recorded.save([changed], path)
    assert recorded.load(path)["(72)"].verdict == "undecided"
    assert set(recorded.load(path)) == {"(48)", "(72)"}


def test_the_command_saves_its_verdicts(monkeypatch: pytest.MonkeyPatch) -> None:
    """``atlas verify --record`` saves all that the trial gave."""
    scripts_saved, verdicts = list[Any](), [*recorded.load().values()]
    monkeypatch.setattr(run, "verify", lambda *_labels, **_options: verdicts)
    monkeypatch.setattr(recorded, "save", lambda *saved: scripts_saved.extend(saved))
    monkeypatch.setattr(recorded, "save_scripts", lambda scripts: scripts_saved.append([*scripts]))
    monkeypatch.setattr(proof, "script_of", lambda verdict: verdict.name)
    result = CliRunner().invoke(command, ["verify", "--record"], catch_exceptions=False)
    assert result.exit_code == 0
    assert scripts_saved == [verdicts, [verdict.name for verdict in verdicts]]


def test_scripts_of_some_entries_keep_the_others(tmp_path: Path) -> None:
    """The record of one entry stays when another is recorded."""
    path = tmp_path / "scripts.json"
    recorded.save_scripts({"(72)": "one", "(48)": "two"}, path)
    recorded.save_scripts({"(48)": "three"}, path)
    assert recorded.scripts(path) == {"(48)": "three", "(72)": "one"}


def test_seconds_change_only_with_the_proof(tmp_path: Path) -> None:
    """A second run of the same proofs leaves the file as it is."""
    path = tmp_path / "verdicts.json"
    recorded.save([VERDICT], path)
    before = path.read_bytes()
    recorded.save([replace(VERDICT, seconds=99.0)], path)
    assert path.read_bytes() == before
    recorded.save([replace(VERDICT, seconds=99.0, source="another")], path)
    assert recorded.load(path)["(72)"].seconds == 99.0


def test_a_missing_record_is_empty_and_a_spoilt_one_is_an_error(tmp_path: Path) -> None:
    """Nothing is made up in place of a record that can't be read."""
    spoilt = tmp_path / "spoilt.json"
    spoilt.write_text("[{", "utf-8")
    for read in (recorded.load, recorded.scripts):
        assert not read(tmp_path / "none.json")
        with pytest.raises(AtlasError, match=r"spoilt\.json.*delete it and run `atlas verify --record`"):
            read(spoilt)


@pytest.mark.parametrize("field", ["tex", "says", "assumptions", "outside"])
def test_a_verdict_goes_stale_with_all_that_its_entry_says(field: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its formula, its words and each of its assumptions are in the fingerprint."""
    before, entry = recorded.source("(72)"), recorded.equation("(72)")
    value = getattr(entry, field)
    entry_changed = replace(entry, **{field: ("$B'_2 < 0$", *value[1:]) if isinstance(value, tuple) else f"{value} "})
    monkeypatch.setattr(recorded, "equation", lambda _name: entry_changed)
    assert recorded.source("(72)") != before


def test_a_changed_verdict_differs() -> None:
    """Both the verdict and that on the corrected form count; a new name is not recorded."""
    verdicts = recorded.load()
    assert recorded.differs(verdicts.values(), verdicts) == []
    assert recorded.differs([replace(VERDICT, verdict="refuted")], verdicts) == [("(72)", "proved", "refuted")]
    slip = replace(verdicts["(48)"], corrected_verdict="undecided")
    assert recorded.differs([slip], verdicts)[0][0] == "(48)"
    assert recorded.differs([VERDICT], {}) == [("(72)", "not recorded", "proved")]


def test_the_fingerprint_follows_the_dependencies_of_a_proof(monkeypatch: pytest.MonkeyPatch) -> None:
    """A change in the machinery touches every proof, a change in a topic those that build on it, a comment none."""
    before = {name: recorded.source(name) for name in ("(72)", "(84)", "(4)", "(51)")}
    normal = recorded._normal

    def changed_in(stem: str) -> dict[str, str]:
        recorded._fingerprint.cache_clear()
        monkeypatch.setattr(recorded, "_normal", lambda name: normal(name) + ("\nx = 1" if name == stem else ""))
        sources_found = {name: recorded.source(name) for name in before}
        recorded._fingerprint.cache_clear()
        return sources_found

    touched = {
        stem: {name for name, source in changed_in(stem).items() if source != before[name]}
        for stem in ("decide", "quadric")
    }
    monkeypatch.setattr(recorded, "_normal", normal)
    assert touched == {"decide": set(before), "quadric": {"(72)", "(84)", "(51)"}}
    assert recorded.source("(72)") == before["(72)"]
