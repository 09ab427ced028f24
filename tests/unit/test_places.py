"""Strange machines: no home, nothing that can be written, an encoding without the letters."""

import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest

from atlas import places
from atlas.cli.app import NEAR

ROOT = Path(__file__).resolve().parents[2]


def test_cached_records_lie_in_the_users_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """XDG_CACHE_HOME comes first, then ~/.cache."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    assert places.own_folder() == tmp_path / "cache" / "atlas"
    monkeypatch.delenv("XDG_CACHE_HOME")
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    assert places.own_folder() == tmp_path / "home" / ".cache" / "atlas"


def test_without_a_home_the_cache_lies_in_the_environment(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where there is no home, or none that can be written, the environment's folder is taken, or none at all."""
    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    monkeypatch.setattr(sys, "prefix", str(tmp_path / "venv"))
    monkeypatch.setattr(os.path, "expanduser", lambda path: path)  # as without HOME and without an entry in passwd
    assert places.own_folder() == tmp_path / "venv" / "atlas"
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    assert places.own_folder() == tmp_path / "venv" / "atlas"
    monkeypatch.setattr(sys, "prefix", str(tmp_path / "file"))
    assert places.own_folder() is None


def test_built_figures_are_cached_in_the_checkout_or_the_users_cache(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Never in a paper's folder; the variable ATLAS_CACHE comes first, and where nothing can be written it goes."""
    assert places.cache_folder(tmp_path) == Path(os.environ["ATLAS_CACHE"])
    monkeypatch.delenv("ATLAS_CACHE")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    assert places.cache_folder(ROOT / "build" / "figures") == ROOT / "build" / ".cache"
    monkeypatch.chdir(ROOT)
    assert places.cache_folder(Path("build/report")) == ROOT / "build" / ".cache"
    monkeypatch.chdir(tmp_path)
    assert places.cache_folder(Path("build/report")) == tmp_path / "cache" / "atlas" / "built"
    monkeypatch.setattr(places, "own_folder", lambda: None)
    assert places.cache_folder(tmp_path).parent == Path(tempfile.gettempdir())


def test_a_figure_for_a_manuscript_leaves_no_other_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """`atlas figure --out .` leaves only the figure and the record of its files, and draws nothing twice."""
    from atlas.book.building.figures import build_figures

    monkeypatch.chdir(tmp_path)
    (build,) = build_figures(["magn"], ("svg",), Path())
    (again,) = build_figures(["magn"], ("svg",), Path("elsewhere"))
    assert build.reason.startswith("drawn")
    assert again.reason.startswith("taken")
    assert sorted(path.name for path in tmp_path.iterdir()) == [".written", "elsewhere", "magn.svg"]


@pytest.mark.slow
@pytest.mark.parametrize("cache", [None, "/proc/none"])
def test_matplotlib_has_a_folder_where_it_cannot_write_its_own(tmp_path: Path, cache: str | None) -> None:
    """No process says a word about it, nor of a backend and a date that are none."""
    folder = tmp_path / "no" / "home" if cache is None else tmp_path
    environment = {key: value for key, value in os.environ.items() if key not in {"MPLCONFIGDIR", "XDG_CACHE_HOME"}}
    variables = {"MPLBACKEND": "none", "SOURCE_DATE_EPOCH": "none"} | ({"XDG_CACHE_HOME": cache} if cache else {})
    done = subprocess.run(
        [sys.executable, "-m", "atlas", "figure", "magn", "lssc", "--format", "pdf", "--out", str(tmp_path / "out")],
        env=environment | variables | {"HOME": str(folder), "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        check=False,
    )
    lines = [line for line in done.stderr.splitlines() if not re.search(r" after \d+ s$", line)]  # on a busy machine
    assert (done.returncode, lines) == (0, [])
    assert len(list((tmp_path / "out").glob("*.pdf"))) == 2


@pytest.mark.parametrize("encoding", ["ascii", "latin-1", "utf-8"])
def test_characters_that_the_encoding_lacks_become_ascii(encoding: str) -> None:
    """Characters that the terminal's encoding lacks are written in ASCII, as near as it gets; JSON keeps its turn."""
    program = (
        "import json, sys; from atlas.cli.app import write_plainly; from atlas.cli.present import dump\n"
        "write_plainly(); print('\u2212\u00d7\u2192\u03c9 \u00e9\u2075'); dump({'a': '\u03c9'})"
    )
    done = subprocess.run(
        [sys.executable, "-c", program],
        env=os.environ | {"PYTHONIOENCODING": encoding, "PYTHONUNBUFFERED": "", "PYTHONPATH": str(ROOT)},
        capture_output=True,
        check=True,
    )
    expected = {"ascii": "-x->? e5", "latin-1": "-×->? é5", "utf-8": "−×→ω é⁵"}[encoding]
    line, output = done.stdout.decode(encoding).splitlines()
    assert line == expected
    assert output == ('{"a": "ω"}' if encoding == "utf-8" else r'{"a": "\u03c9"}')
    assert all(neighbour.isascii() for neighbour in NEAR.values())
