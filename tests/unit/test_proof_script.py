"""Proofs as scripts of plain SymPy: they run without atlas, repeat the record, and notice a changed sign."""

import io
import re
import statistics
import subprocess
import sys
from contextlib import redirect_stdout
from dataclasses import replace
from pathlib import Path

import pytest
from click.testing import CliRunner

from atlas.cli.app import atlas as command
from atlas.trial.proofs import recorded, script_of

RECORDED, SCRIPTS = recorded.load(), recorded.scripts()
SAMPLE = ("(2)", "(34)", "(48)", "(72)", "(97)", "text-two-sheets", "theorem-bracket", "theorem-involution")


def run(script: str) -> tuple[int, str]:
    """Run a script here; return its exit status and the last line that it prints, or that it ends with."""
    printed = io.StringIO()
    try:
        with redirect_stdout(printed):
            exec(compile(script, "script", "exec"), {})  # noqa: S102  our own script
    except SystemExit as end:
        return 1, str(end.code)
    return 0, printed.getvalue().splitlines()[-1]


@pytest.mark.parametrize("name", SAMPLE)
def test_a_script_repeats_the_recorded_verdict(name: str) -> None:
    """It exits with 0, and its last line has the recorded verdict on the printed form and on the corrected one."""
    verdict = RECORDED[name]
    status, line_last = run(SCRIPTS[name])
    says = {"definition": "is a definition that holds", "refuted": "as printed is refuted", "proved": "is proved"}
    corrected = ", its corrected form is proved" if verdict.corrected else ""
    assert (status, line_last) == (0, f"{name} {says[verdict.verdict]}{corrected}")


def test_a_script_runs_without_atlas() -> None:
    """Python's isolated mode, with SymPy alone: no script imports anything else."""
    every = "\n".join(SCRIPTS.values())
    assert {line.split()[1] for line in every.splitlines() if re.match("import |from ", line)} == {"sympy"}
    command = [sys.executable, "-I", "-c", SCRIPTS["(72)"]]
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=60)
    assert done.stdout == "(72) is proved\n"


@pytest.mark.parametrize("name", ["(34)", "(48)", "(72)", "theorem-larmor"])
def test_a_script_with_a_changed_sign_fails(name: str) -> None:
    """Each sign in the formulas of the claim, turned round, is found out: the script says so and exits with 1."""
    script = SCRIPTS[name]
    start, end = script.rindex("\ncheck("), script.rindex("\nprint(")
    signs = [start + sign.start() for sign in re.finditer(r"(?<= )[+-](?= )", script[start:end])]
    assert signs
    for place in signs:
        sign_opposite = {"+": "-", "-": "+"}[script[place]]
        status, line_last = run(script[:place] + sign_opposite + script[place + 1 :])
        assert (status, line_last[:7]) == (1, "not so:"), script[place - 20 : place + 20]


def test_a_point_that_refutes_nothing_is_found_out() -> None:
    """For I3 = I2 the slip in (48) makes no difference: a script with that point fails."""
    script = SCRIPTS["(48)"]
    assert script.count("I3: 2") == 1
    assert run(script.replace("I3: 2", "I3: 1"))[0] == 1


def test_every_entry_has_a_short_script() -> None:
    """Each is of a verdict on record; half of them have thirty lines or less."""
    assert set(SCRIPTS) == set(RECORDED)
    assert all(text.startswith(f"# {name}, from ") for name, text in SCRIPTS.items())
    assert statistics.median(len(text.splitlines()) for text in SCRIPTS.values()) <= 30


def test_without_a_verdict_one_line_says_why_there_is_no_script() -> None:
    """An undecided entry has none."""
    text = script_of(replace(RECORDED["(72)"], verdict="undecided", method="out of time"))
    assert text == "No script: it is undecided (out of time) before anything is computed."


@pytest.mark.parametrize("name", SAMPLE)
def test_a_recorded_script_equals_that_of_the_proof(name: str) -> None:
    """Scripts on the pages were made from the line that is tried now; `atlas verify --record` makes them anew."""
    assert script_of(RECORDED[name]) == SCRIPTS[name]


def test_the_command_prints_the_script_and_nothing_else() -> None:
    """``atlas verify 72 --script`` can be piped into Python; of several equations, or of none, it is refused."""
    assert CliRunner().invoke(command, ["verify", "72", "--script"]).stdout == SCRIPTS["(72)"]
    for names in (["72", "48"], []):
        assert "name one equation" in CliRunner().invoke(command, ["verify", *names, "--script"]).stderr


def test_the_command_shows_both_sides() -> None:
    """Of an equation that is named, the sides stand as one function of free parameters."""
    output = CliRunner().invoke(command, ["verify", "(39)"]).stdout
    assert "d(K1) = Omega3*K2 - Omega2*K3: each side is K2*Omega3 - K3*Omega2" in output


def test_the_command_shows_no_tex() -> None:
    """Sentences beside the relations of a formula stand in plain letters, with their verdict."""
    output = CliRunner().invoke(command, ["verify", "71"]).stdout
    assert "also says:      if ω_2≠-B'_2: supposed, or tried in a further line" in output
    assert "\\" not in output


def test_the_command_keeps_its_trials_in_the_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A trial leaves nothing in the folder where one stands, which may be read-only."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("ATLAS_CACHE", str(tmp_path / "cache"))
    assert CliRunner().invoke(command, ["verify", "39"]).exit_code == 0
    assert [path.name for path in tmp_path.iterdir()] == ["cache"]
    assert len([*tmp_path.glob("cache/??/*")]) == 1
