"""The set-up of the Makefile on machines that lack something: one line names it, and the reason stands below it."""

import fcntl
import hashlib
import os
import shutil
import subprocess
import sys
from pathlib import Path
from zipfile import ZipFile

import pytest

ROOT = Path(__file__).resolve().parents[2]
OLD = "#!/bin/sh\necho 3.9.2\nexit 1\n"
SAYS = f'#!/bin/sh\ncase "$*" in *hexversion*) echo 3.12.1;; *flock*) exec {sys.executable} "$@";; '
BROKEN = f'{SAYS} *) echo "a sitecustomize ended it" >&2; exit 1;; esac\n'
BARE = f"{SAYS} *) echo \"No module named 'ensurepip'\" >&2; exit 1;; esac\n"
NO_NETWORK = "#!/bin/sh\necho 'E: no network today' >&2\nexit 100\n"
LOCK = "nosuch-library==1.0 --hash=sha256:" + 64 * "0" + "\n"


def set_up(tmp_path: Path, programs: dict[str, str], lock: str = "", **variables: str) -> tuple[int, str]:
    """Run `make setup` as `begin` has it; return its status and its message."""
    with begin(tmp_path, programs, lock, **variables) as done:
        output, _ = done.communicate()
        return done.returncode, output


def begin(tmp_path: Path, programs: dict[str, str], lock: str = "", **variables: str) -> subprocess.Popen[str]:
    """Start `make setup` in a folder with an apostrophe, with these programs before those of the system."""
    checkout, programs_folder = tmp_path / "it's é", tmp_path / "first"
    checkout.mkdir(exist_ok=True)
    programs_folder.mkdir(exist_ok=True)
    for name, text in programs.items():
        (programs_folder / name).write_text(text, encoding="utf-8")
        (programs_folder / name).chmod(0o755)
    for name in ("Makefile", "pyproject.toml"):
        shutil.copy(ROOT / name, checkout / name)
    (checkout / "requirements.lock").write_text(lock, encoding="utf-8")
    (checkout / "random.py").write_text("raise SystemExit('a module of the user ran')\n", encoding="utf-8")
    own = {name: value for name, value in os.environ.items() if not name.startswith(("MAKE", "MFLAGS"))}
    environment = own | {"PATH": f"{programs_folder}{os.pathsep}{os.environ['PATH']}", **variables}
    return subprocess.Popen(
        ["make", "setup"],  # noqa: S607  whichever make there is
        cwd=checkout,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )


@pytest.mark.parametrize(
    ("programs", "says"),
    [
        ({"python3": OLD}, "atlas needs Python 3.11 or newer; python3 says: 3.9.2."),
        ({"python3": BROKEN}, "atlas: python3 does not start:\na sitecustomize ended it"),
        (
            {"python3": BARE, "id": "#!/bin/sh\necho 0\n", "apt-get": NO_NETWORK},
            "atlas: apt-get could not install python3-venv:\nE: no network today",
        ),
        (
            {"python3": BARE, "id": "#!/bin/sh\necho 1000\n"},
            "atlas: this Python has no venv; install it: sudo apt-get install python3-venv",
        ),
    ],
    ids=["old", "broken", "no venv, no network", "no venv, a user"],
)
def test_an_unsuitable_python_is_named(tmp_path: Path, programs: dict[str, str], says: str) -> None:
    """Its version, or its own message, or that of the installer."""
    status, message = set_up(tmp_path, programs)
    assert status == 2
    assert says in message
    assert "a module of the user ran" not in message


@pytest.mark.slow
def test_the_error_of_pip_is_shown(tmp_path: Path) -> None:
    """The reason is pip's own, and no half-made environment counts as ready."""
    hidden = {"PYTHONPATH": str(tmp_path), "PYTHONHOME": str(tmp_path), "PIP_NO_INDEX": "1", "PIP_FIND_LINKS": ""}
    python = f'#!/bin/sh\nexec "{sys.executable}" "$@"\n'
    status, message = set_up(tmp_path, {"python3": python, "uv": "#!/bin/sh\nexit 1\n"}, LOCK, **hidden)
    assert status == 2
    assert "atlas: pip could not install the libraries:\n" in message
    assert "No matching distribution found for nosuch-library==1.0" in message
    assert not (tmp_path / "it's é" / ".venv" / ".ready").exists()


@pytest.mark.slow
def test_settings_of_pip_reach_the_index_and_nothing_else(tmp_path: Path) -> None:
    """Where the index is stands in the user's file; that file and variables would also lead pip astray."""
    wheels, home = tmp_path / "wheels", tmp_path / "home"
    wheel = wheels / "tiny-1.0-py3-none-any.whl"
    (home / ".config" / "pip").mkdir(parents=True)
    wheels.mkdir()
    with ZipFile(wheel, "w") as file:
        file.writestr("tiny.py", "")
        file.writestr("tiny-1.0.dist-info/METADATA", "Metadata-Version: 2.1\nName: tiny\nVersion: 1.0\n")
        file.writestr("tiny-1.0.dist-info/WHEEL", "Wheel-Version: 1.0\nRoot-Is-Purelib: true\nTag: py3-none-any\n")
        file.writestr("tiny-1.0.dist-info/RECORD", "")
    (home / ".config" / "pip" / "pip.conf").write_text(
        f"[global]\nno-index = true\nrequire-virtualenv = true\n[install]\nfind-links = {wheels}\nuser = true\n"
        f"constraint = {tmp_path}/nosuch\n"
    )
    astray = {"PIP_TARGET": f"{tmp_path}/t", "PIP_CONSTRAINT": f"{tmp_path}/nosuch", "PIP_REQUIRE_VIRTUALENV": "1"}
    astray |= {
        "PIP_USER": "1",
        "PIP_PREFIX": f"{tmp_path}/p",
        "PIP_ONLY_BINARY": "none",
        "PIP_NO_BINARY": ":all:",
        "PIP_FIND_LINKS": "",
    }
    lock = f"tiny==1.0 --hash=sha256:{hashlib.sha256(wheel.read_bytes()).hexdigest()}\n"
    python = f'#!/bin/sh\nexec "{sys.executable}" "$@"\n'
    programs = {"python3": python, "uv": "#!/bin/sh\nexit 1\n"}
    _, message = set_up(tmp_path, programs, lock, HOME=str(home), XDG_CONFIG_HOME=str(home / ".config"), **astray)
    assert "could not install" not in message
    assert [*(tmp_path / "it's é" / ".venv" / "lib").glob("python3*/site-packages/tiny-1.0.dist-info")], message


def test_two_set_ups_wait_for_each_other_and_check_the_disk_first(tmp_path: Path) -> None:
    """One that finds the folder locked says so and waits; before anything is made, the disk is asked."""
    folder = tmp_path / "it's é"
    folder.mkdir()
    lock = os.open(folder, os.O_RDONLY)
    try:
        fcntl.flock(lock, fcntl.LOCK_EX)
        with begin(tmp_path, {}, PYTHON=sys.executable, MB="999999999") as second:
            assert second.stdout is not None
            assert second.stdout.readline() == "another make sets up .venv: this one waits for it\n"
            fcntl.flock(lock, fcntl.LOCK_UN)
            output, _ = second.communicate()
    finally:
        os.close(lock)
    assert second.returncode == 2
    assert f"atlas: setting up needs 999999999 MB on the disk of {folder}, where" in output
    assert not (folder / ".venv").exists()


@pytest.mark.skipif(not (ROOT / ".venv" / ".ready").exists(), reason="this checkout was not set up by make")
def test_the_program_of_the_checkout_uses_its_own_libraries_alone(tmp_path: Path) -> None:
    """Neither PYTHONPATH nor PYTHONHOME nor the working folder leads it to others."""
    for name in ("numpy", "json", "random"):
        (tmp_path / f"{name}.py").write_text("raise SystemExit('a module of the user ran')\n", encoding="utf-8")
    done = subprocess.run(
        [ROOT / ".venv" / "bin" / "atlas", *"classify --ratio 1.5 --field 1 2 --json".split()],
        cwd=tmp_path,
        env=os.environ | {"PYTHONPATH": str(tmp_path), "PYTHONHOME": str(tmp_path), "LC_ALL": "C"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert "two-sheet hyperboloid" in done.stdout
