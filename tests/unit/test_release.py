"""Releases are refused while an address is a placeholder; workflows and hooks run the commands that people run."""

import re
import shutil
import subprocess
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
TAG = "v7.8.9"


def release(folder: Path) -> subprocess.CompletedProcess[str]:
    """Commit and tag a folder, and make the release of the tag with the programs of this checkout."""
    git = ["git", "-c", "user.name=a", "-c", "user.email=a", "-c", "init.defaultBranch=main"]
    for words in (["init", "-q"], ["add", "-A"], ["commit", "-q", "-m", "a"], ["tag", "-f", TAG]):
        subprocess.run([*git, *words], cwd=folder, check=True, capture_output=True)
    command = ["make", "-s", "-o", ".venv/.test", "release", f"TAG={TAG}"]
    return subprocess.run(command, cwd=folder, check=False, capture_output=True, text=True)


@pytest.fixture
def small_checkout(tmp_path: Path) -> Path:
    """Copy the files that a release reads, with a package and data folders that hold next to nothing."""
    for name in ("Makefile", "pyproject.toml", "SECURITY.md", "README.md", "LICENSE", "NOTICE"):
        shutil.copy(ROOT / name, tmp_path / name)
    for name in ("atlas/__init__.py", "figures/a.py", "templates/a.html", "reports/a.md"):
        (tmp_path / name).parent.mkdir()
        (tmp_path / name).write_text(f'__version__ = "{TAG[1:]}"\n', encoding="utf-8")
    (tmp_path / ".gitignore").write_text("/.venv\n/build/\n/dist/\n", encoding="utf-8")
    (tmp_path / ".venv").symlink_to(ROOT / ".venv")
    return tmp_path


@pytest.mark.skipif(not (ROOT / ".venv" / "bin" / "hatchling").exists(), reason="this checkout was not set up by make")
@pytest.mark.parametrize("placeholders", [("pyproject.toml",), ("SECURITY.md",), ()], ids=str)
def test_placeholders_stop_a_release(small_checkout: Path, placeholders: tuple[str, ...]) -> None:
    """An address that nobody filled in is named with its file and line; nothing is built."""
    for name in ("pyproject.toml", "SECURITY.md"):
        text = (ROOT / name).read_text("utf-8")
        host = "atlas.invalid" if name in placeholders else "a.example"
        filled = re.sub(r"https://[^/\"]+(?=[/\"])", f"https://{host}", text)
        (small_checkout / name).write_text(filled, encoding="utf-8")
    done = release(small_checkout)
    suffixes = sorted(path.suffix for path in (small_checkout / "dist").glob("*"))
    if placeholders:
        assert (done.returncode, suffixes) == (2, [])
        assert re.findall(r"^(\S+?):\d+:.*atlas\.invalid", done.stderr, re.MULTILINE)[0] == placeholders[0]
    else:
        assert (done.returncode, suffixes) == (0, [".gz", ".whl"]), done.stderr


def test_the_workflow_runs_the_two_commands_on_the_oldest_and_newest_python() -> None:
    """README names two commands, pyproject.toml the versions of Python."""
    workflow = (ROOT / ".github" / "workflows" / "check.yml").read_text("utf-8")
    section = (ROOT / "README.md").read_text("utf-8").partition("## Two commands")[2].partition("\n## ")[0]
    commands = re.findall(r"^    (make \w+)", section, re.MULTILINE)
    assert len(commands) == 2
    assert re.findall(r"^ *- run: (make .*)$", workflow, re.MULTILINE) == commands
    (versions,) = re.findall(r"^ *python: \[(.*)\]$", workflow, re.MULTILINE)
    pythons = re.findall(r"3\.\d+", versions)
    supported = [line.rpartition(" ")[2] for line in PROJECT["classifiers"] if re.search(r":: 3\.\d+$", line)]
    assert len(pythons) == 3
    assert (pythons[0], pythons[-1]) == (supported[0], supported[-1])
    assert PROJECT["requires-python"] == f">={pythons[0]}"


def test_hooks_before_a_commit_are_the_parts_of_make_lint() -> None:
    """Each part is run by one hook, and nothing else is."""
    (line_of_lint,) = re.findall(r"^lint: (.+)$", (ROOT / "Makefile").read_text("utf-8"), re.MULTILINE)
    hooks = re.findall(r"^ *entry: make -s (.+)$", (ROOT / ".pre-commit-config.yaml").read_text("utf-8"), re.MULTILINE)
    assert hooks == line_of_lint.split()


def test_the_changelog_of_a_release_has_at_most_forty_lines() -> None:
    """CONTRIBUTING says so: the changelog is for users, the rest belongs to commits."""
    sections = re.split(r"^## ", (ROOT / "CHANGELOG.md").read_text("utf-8"), flags=re.MULTILINE)
    lengths = {section.split()[0]: len(section.splitlines()) for section in sections if section[0].isdigit()}
    assert len(lengths) > 2
    assert max(lengths.values()) <= 40
