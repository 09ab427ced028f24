"""After a change exactly the figures that depend on it are drawn again. And failures of drawing."""

import gzip
import os
import shutil
import signal
import subprocess
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import pytest

import atlas.book.building.figures as figures_module
import atlas.book.building.report as report_module
import atlas.sources as sources_module
from atlas import AtlasError, places, processes
from atlas.book.blocks.figure import Picture
from atlas.book.building import worker
from atlas.book.building.cache import Cache
from atlas.book.building.figures import FigureBuild, build_figures, draw, find, parts_of
from atlas.book.building.report import describe, key_of
from atlas.sources import PACKAGE, Sources, digest

ROOT = PACKAGE.parent
WANTED = {
    "hyperbola": FigureBuild("hyperbola", {"ratio": 1.5}, "vector", ("svg",)),
    "frequencies": FigureBuild("frequencies", {}, "vector", ("svg",)),
    "trochoids": FigureBuild("trochoids", {}, "vector", ("svg",)),
    "quadric": FigureBuild("quadric", {"ratio": 0.5}, "shaded", ("png",)),
    "work_precision": FigureBuild("work_precision", {}, "vector", ("svg",)),
}


@pytest.fixture(scope="module")
def pristine(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Copy the checkout's sources once."""
    copy = tmp_path_factory.mktemp("checkout")
    for name in ("atlas", "figures", "templates", "reports"):
        shutil.copytree(ROOT / name, copy / name, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(ROOT / "pyproject.toml", copy)
    return copy


def use(copy: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Let the keys be made from a copy of the sources."""
    for module in (sources_module, figures_module, report_module):
        monkeypatch.setattr(module, "PACKAGE", copy / "atlas")
    monkeypatch.setattr(places, "_PACKAGE", copy / "atlas")


@pytest.fixture
def checkout(pristine: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Give a fresh copy of the sources and let the keys be made from it."""
    copy = tmp_path / "checkout"
    shutil.copytree(pristine, copy)
    use(copy, monkeypatch)
    return copy


def figure(recipe: str, *kinds: str, renderer: str = "vector", **parameters: Any) -> FigureBuild:
    """Return a figure that is wanted, as SVG if nothing else is said."""
    return FigureBuild(recipe, parameters, renderer, kinds or ("svg",))


def drawn_builds(figures: list[FigureBuild], cache: Cache, jobs: int = 1) -> list[FigureBuild]:
    """Take or draw figures."""
    find(figures, cache, Sources(), None)
    draw(figures, cache, jobs, lambda _done, _total, _name: None)
    return figures


Keys = Callable[..., dict[str, str]]


@pytest.fixture
def keys(pristine: Path) -> Keys:
    """Give a function that makes the keys of the wanted figures and of a report from the sources as they are then."""

    def keys_of(gl: str | None = "egl", **changed: FigureBuild) -> dict[str, str]:
        sources = Sources(Cache(pristine / "cache"))
        keys_now = {name: digest(parts_of(build, sources, gl)) for name, build in (WANTED | changed).items()}
        return keys_now | {"report": key_of(places.folder("reports") / "atlas.md", sources)}

    return keys_of


def different(before: dict[str, str], after: dict[str, str]) -> set[str]:
    """Return the names whose keys differ."""
    return {name for name in before if before[name] != after[name]}


def edit(path: Path, old: str, new: str) -> None:
    """Replace a text that must be there."""
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new, 1), encoding="utf-8")


EVERY = set(WANTED)
CHANGES = [
    (
        "a comment in a kernel",
        "atlas/motions/elementary/kernel_hyperbola.py",
        "\nclass",
        "\n# said again\nclass",
        set(),
    ),
    ("a line break in a recipe", "figures/hyperbola.py", "def scene(", "def scene(\n ", set()),
    ("the code of a recipe", "figures/hyperbola.py", "def scene(", "NEW = 1\n\n\ndef scene(", {"hyperbola"}),
    ("the title of a recipe", "figures/trochoids.py", '"""', '"""New: ', {"trochoids"}),
    (
        "a kernel that two reach",
        "atlas/motions/elementary/kernel_hyperbola.py",
        "\nclass",
        "\nNEW = 1\n\n\nclass",
        {"hyperbola", "frequencies"},
    ),
    (
        "a kernel that one reaches",
        "atlas/motions/particle/rows.py",
        "\nclass",
        "\nNEW = 1\n\n\nclass",
        {"trochoids"},
    ),
    ("the style", "atlas/pictures/style.py", '"""', '"""New: ', EVERY),
    ("the vector renderer", "atlas/pictures/drawing/plane.py", '"""', '"""New: ', EVERY),
    ("the shaded renderer", "atlas/pictures/drawing/shaded.py", '"""', '"""New: ', EVERY),
    ("a stored record", "reports/data/bench.json", '"date"', '"date" ', {"work_precision"}),
    ("the prose", "reports/atlas.md", "title", "title ", set()),
    ("a template", "templates/html/page.html", "<", " <", set()),
    ("code that no figure reaches", "atlas/book/html.py", "\ndef pages", "\nNEW = 1\n\n\ndef pages", set()),
]


@pytest.mark.parametrize(("file", "old", "new", "again"), [c[1:] for c in CHANGES], ids=[c[0] for c in CHANGES])
def test_a_change_redraws_exactly_the_dependent_figures(
    checkout: Path, keys: Keys, file: str, old: str, new: str, again: set[str]
) -> None:
    """Each kind of change makes new the keys of exactly those figures that it can alter."""
    before = keys()
    edit(checkout / file, old, new)
    after = keys()
    changed = different(before, after)
    assert changed - {"report"} == again
    cosmetic = file.endswith(".py") and not again and "NEW" not in new
    assert ("report" in changed) is not cosmetic


def test_a_changed_parameter_redraws_its_figure(checkout: Path, keys: Keys) -> None:
    """One figure's parameter makes that figure new and no other, down to the last bit."""
    assert checkout.is_dir()
    changed = figure("hyperbola", ratio=1.5000000000000002)
    assert different(keys(), keys(hyperbola=changed)) == {"hyperbola"}


@pytest.mark.slow
def test_another_gl_library_redraws_shaded_figures(checkout: Path, keys: Keys) -> None:
    """Another GL library, or none, makes only the shaded figures new."""
    assert checkout.is_dir()
    assert different(keys("egl"), keys("osmesa")) == {"quadric"}
    assert different(keys("egl"), keys(None)) == {"quadric"}


@pytest.mark.parametrize("library", ["matplotlib", "vtk", "python-flint"])
def test_another_version_of_a_library_redraws_all_figures(
    library: str, keys: Keys, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Another version of any library makes every figure and every report new."""
    before = keys()
    for module in (figures_module, report_module):
        monkeypatch.setattr(module, "versions", lambda: {"numpy": "2.4.6", library: "99"})
    assert different(before, keys()) == {*EVERY, "report"}


def test_the_place_of_the_checkout_does_not_matter(checkout: Path, keys: Keys, monkeypatch: pytest.MonkeyPatch) -> None:
    """The same sources in another folder have the same keys."""
    before = keys()
    elsewhere = checkout.with_name("another name")
    checkout.rename(elsewhere)
    use(elsewhere, monkeypatch)
    assert not different(before, keys())


@pytest.mark.slow
def test_a_figure_is_drawn_once_and_then_taken_from_the_cache(tmp_path: Path) -> None:
    """The first time a figure is drawn, the second time it is taken; both have the same files and facts."""
    cache = Cache(tmp_path)
    builds = drawn_builds([figure("trochoids"), figure("trochoids", speeds=(0.5, 1.0))], cache)
    again = drawn_builds([figure("trochoids"), figure("trochoids", speeds=(0.5, 1.0))], cache)
    for build, two in zip(builds, again, strict=True):
        assert build.reason == "drawn: it was never drawn here"
        assert two.reason == "taken: nothing it depends on has changed"
        assert build.contents == two.contents
        assert build.facts == two.facts
        assert two.contents["svg"].startswith(b"<?xml")
    assert builds[0].contents != builds[1].contents


@pytest.mark.slow
def test_changes_that_cause_a_redraw_are_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A figure that is drawn again names its changed dependencies, or a lost file."""
    cache = Cache(tmp_path)
    drawn_builds([figure("lssc")], cache)
    for entry in tmp_path.glob("??/*"):
        if b"<svg" in entry.read_bytes():
            entry.write_bytes(b"spoiled")
    (build_lost,) = drawn_builds([figure("lssc")], cache)
    assert build_lost.reason == "drawn: a file of it was not there, or damaged"
    monkeypatch.setattr(figures_module, "versions", dict)
    (new,) = drawn_builds([figure("lssc")], cache)
    assert new.reason == "drawn: changed: libraries"


@pytest.mark.slow
def test_a_damaged_cache_entry_is_drawn_again_as_a_whole(tmp_path: Path) -> None:
    """Any one entry of a drawing removed, or all but one, it is drawn as a whole, with its moving parts."""
    kinds, cache = ("svg", "narrow", "scene", "moves"), Cache(tmp_path)
    (build,) = drawn_builds([figure("film_strip", *kinds)], cache)
    picture = Picture("film_strip", "film_strip", "vector", {})
    describe(build, picture)
    assert {"scene", "moves"} <= {*picture.beside}
    keys = list(build.keys.values())
    for keys_lost in (keys[:1], keys[2:3], keys[3:], keys[1:]):
        for key in keys_lost:
            (cache.folder / key[:2] / key).unlink()
        (again,) = drawn_builds([figure("film_strip", *kinds)], cache)
        picture_again = Picture("film_strip", "film_strip", "vector", {})
        describe(again, picture_again)
        assert picture_again == picture
        assert again.contents == build.contents


@pytest.mark.slow
@pytest.mark.parametrize("jobs", [1, 2])
def test_a_figure_that_fails_does_not_stop_the_others(tmp_path: Path, jobs: int) -> None:
    """A recipe that raises is returned with its reason, and the others are drawn."""
    failed, build_drawn = drawn_builds([figure("trochoids", mu=0.0), figure("magn")], Cache(tmp_path), jobs)
    assert "mu" in failed.failure
    assert "Error" not in failed.failure
    assert build_drawn.contents


@pytest.mark.slow
def test_a_build_survives_a_worker_that_dies(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """When a worker is killed, the figures that were not finished are drawn by another."""
    cache, killed = Cache(tmp_path), list[int]()
    builds = [figure("trochoids"), figure("magn"), figure("lssc"), figure("work_precision")]
    find(builds, cache, Sources(), None)
    pool_of = processes.pool

    def pool(*arguments: Any) -> Any:
        new_pool = pool_of(*arguments)
        if not killed:
            monkeypatch.setattr(new_pool, "submit", _killing(new_pool, killed))
        return new_pool

    monkeypatch.setattr(processes, "pool", pool)
    draw(builds, cache, 2, lambda _done, _total, _name: None)
    assert killed
    assert [bool(build.contents) for build in builds] == [True] * 4


def _killing(pool: Any, killed: list[int]) -> Any:
    submit = pool.submit

    def call(*arguments: Any) -> Any:
        future = submit(*arguments)
        if not killed and len(pool._processes) == 2:  # both are there: none is started while the pool breaks
            killed.extend(pool._processes)
            os.kill(killed[0], signal.SIGKILL)
        return future

    return call


class Deadly:
    """Ends the process that reads it from another one."""

    def __reduce__(self) -> tuple[Any, ...]:
        return os._exit, (9,)


@pytest.mark.slow
def test_compressed_data_read_back_the_same(tmp_path: Path) -> None:
    """The file of gzip holds the CSV, and in its header no date and no system, so that its bytes are the same."""
    (build,) = drawn_builds([figure("trochoids", "csv", "csv.gz")], Cache(tmp_path))
    assert gzip.decompress(build.contents["csv.gz"]) == build.contents["csv"]
    assert build.contents["csv.gz"][:10] == b"\x1f\x8b\x08\0\0\0\0\0\0\xff"


@pytest.mark.slow
@pytest.mark.parametrize("jobs", [1, 2])
def test_a_figure_that_kills_its_process_fails_alone(tmp_path: Path, jobs: int) -> None:
    """A scene that ends the process that draws it is told of; the rest is drawn."""
    cache = Cache(tmp_path)
    builds = [figure("magn"), figure("trochoids"), figure("lssc")]
    find(builds, cache, Sources(), None)
    builds[1].parameters = {"mu": Deadly()}
    draw(builds, cache, jobs, lambda _done, _total, _name: None)
    assert builds[1].failure == "the process that drew it came to a sudden end"
    assert [bool(build.contents) for build in builds] == [True, False, True]


@pytest.mark.slow
def test_a_library_that_cannot_be_loaded_is_reported(tmp_path: Path) -> None:
    """An error of Matplotlib while it is loaded is a failure of each figure, in a line."""
    broken = tmp_path / "broken" / "contourpy"
    broken.mkdir(parents=True)
    (broken / "__init__.py").write_text('raise ImportError("nonsense")\n', encoding="utf-8")
    command = [sys.executable, "-m", "atlas", "figure", "magn", "lssc", "--out", str(tmp_path), "--jobs", "2"]
    done = subprocess.run(
        command,
        env=os.environ | {"ATLAS_CACHE": str(tmp_path / "cache"), "PYTHONPATH": f"{broken.parent}{os.pathsep}{ROOT}"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 1
    assert "Traceback" not in done.stderr
    assert done.stderr.count("nonsense") >= 2


@pytest.mark.slow
def test_a_script_without_a_guard_builds(tmp_path: Path) -> None:
    """Workers do not run the script that started them: one that builds at its top level is run once."""
    script = tmp_path / "script.py"
    script.write_text(
        "from pathlib import Path; from atlas.book.building.figures import build_figures\n"
        "print([one.failure for one in build_figures(['magn', 'lssc'], ['svg'], Path('out'), jobs=2)])\n"
    )
    done = subprocess.run(
        [sys.executable, str(script)],
        cwd=tmp_path,
        env=os.environ | {"PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.stdout, done.stderr) == ("['', '']\n", "")


def test_an_error_of_the_disk_is_raised(tmp_path: Path) -> None:
    """If the cache can't be written, that is no failure of a figure."""
    (tmp_path / "file").write_text("")
    with pytest.raises(OSError, match="file"):
        worker.draw(worker.Task("lssc", {}, "vector", None, {"svg": digest("key")}, tmp_path / "file"))


@pytest.mark.slow
def test_the_costs_of_a_figure_are_recorded(tmp_path: Path) -> None:
    """The points and faces of the scene are counted, and time, memory and bytes noted."""
    plane, space = drawn_builds([figure("hyperbola"), figure("cone")], Cache(tmp_path))
    assert plane.facts["cost"]["points"] > 50
    assert plane.facts["cost"]["faces"] == 0
    assert space.facts["cost"]["faces"] > 50
    assert plane.facts["cost"]["bytes"] == len(plane.contents["svg"])
    assert min(plane.facts["cost"].values()) >= 0


MISBEHAVING = '''"""A recipe that does what it should not."""

from atlas.pictures import recipes


def scene(*, wrong: str = ""):
    """Draw what another recipe draws."""
    print("found it")
    if wrong == "exit":
        raise SystemExit(3)
    return recipes.load("magn").scene()
'''


@pytest.mark.parametrize(("misdeed", "complaint"), [("exit", "SystemExit: 3"), ("", "")])
def test_a_recipe_that_misbehaves_fails_alone(
    checkout: Path, capfd: pytest.CaptureFixture[str], misdeed: str, complaint: str
) -> None:
    """A recipe that ends the program is reported; its printed output is no result."""
    (checkout / "figures" / "misbehaving.py").write_text(MISBEHAVING)
    (build,) = drawn_builds([figure("misbehaving", wrong=misdeed)], Cache(checkout / "cache"))
    assert complaint in build.failure
    assert bool(build.failure) is bool(complaint)
    assert capfd.readouterr().out == ""


@pytest.mark.slow
def test_figures_keep_their_order_and_fail_alone(tmp_path: Path) -> None:
    """The results come in the order asked for, and one that fails has the reason and no files."""
    builds = list(build_figures(["trochoids", "lssc"], ("svg",), tmp_path, parameters={"mu": 0.0}, jobs=2))
    assert [build.name for build in builds] == ["trochoids", "lssc"]
    assert all(build.failure and not build.files for build in builds)
    assert "no parameter 'mu'" in builds[1].failure


def test_a_shaded_figure_is_a_png(tmp_path: Path) -> None:
    """Any other format of it is refused before anything is drawn."""
    with pytest.raises(AtlasError, match="a shaded figure is a PNG; 'svg'"):
        list(build_figures(["cone"], ("png", "svg"), tmp_path, renderer="shaded"))
    assert not list(tmp_path.iterdir())


def test_a_worker_has_the_environment_variables_of_its_caller(monkeypatch: pytest.MonkeyPatch) -> None:
    """One that was set after the process was started of which workers are forks counts, such as ATLAS_GL."""
    context = processes.prepare(processes.DRAWING)
    monkeypatch.setenv("ATLAS_GL", "set late")
    workers = processes.pool(1, partial(worker.begin, {**os.environ}), context)
    assert workers is not None
    with workers:
        assert workers.submit(os.getenv, "ATLAS_GL").result() == "set late"
