"""What is built again when something changes: exactly what depends on it."""

import shutil
from pathlib import Path

import pytest

import atlas.build.drawers as drawers_module
import atlas.build.plates as plates_module
import atlas.build.sources as sources_module
from atlas import places
from atlas.build import fresh
from atlas.build.drawers import Drawers
from atlas.build.plates import Plate, Request, parts_of, survey, tasks
from atlas.build.sources import Sources, digest
from atlas.build.store import Store

ROOT = Path(sources_module.PACKAGE).parent
WANTED = {
    "hyperbola": Request("hyperbola", "vector", {"ratio": 1.5}),
    "frequencies": Request("frequencies", "vector", {}),
    "trochoids": Request("trochoids", "vector", {}),
    "quadric": Request("quadric", "shaded", {"ratio": 0.5}),
    "horizon": Request("horizon", "vector", {}),
}


@pytest.fixture(scope="module")
def pristine(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Copy the checkout's sources once."""
    copy = tmp_path_factory.mktemp("checkout")
    for name in ("atlas", "figures", "templates", "reports"):
        shutil.copytree(ROOT / name, copy / name, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(ROOT / "pyproject.toml", copy)
    return copy


@pytest.fixture
def checkout(pristine: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Give a fresh copy of the sources and let the keys be made from it."""
    copy = tmp_path / "checkout"
    shutil.copytree(pristine, copy)
    for module in (sources_module, plates_module, fresh):
        monkeypatch.setattr(module, "PACKAGE", copy / "atlas")
    monkeypatch.setattr(places, "_PACKAGE", copy / "atlas")
    sources_module._files.cache_clear()
    yield copy  # type: ignore[misc]
    sources_module._files.cache_clear()


def made(requests: list[Request], store: Store, jobs: int = 1) -> dict[Request, Plate]:
    """Take or draw plates."""
    plates = survey(requests, store, Sources(), None)
    with Drawers(jobs) as drawers:
        waiting = {}
        for plate, task in tasks(plates, store):
            waiting[task] = plate
            drawers.give(task)
        for task, outcome in drawers.outcomes():
            waiting[task].settle(outcome)
    return {plate.request: plate for plate in plates}


def keys(gl: str | None = "egl", **changed: Request) -> dict[str, str]:
    """Return the keys of the wanted plates and of a report, made from the sources as they are now."""
    sources = Sources()
    found = {name: digest(parts_of(request, sources, gl)) for name, request in (WANTED | changed).items()}
    return found | {"report": fresh.key(places.folder("reports") / "atlas.toml", sources)}


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
    ("a comment in a kernel", "atlas/core/hyperbola.py", "\nclass", "\n# said again\nclass", set()),
    ("a line break in a recipe", "figures/hyperbola.py", "def scene(", "def scene(\n ", set()),
    ("the code of a recipe", "figures/hyperbola.py", "def scene(", "NEW = 1\n\n\ndef scene(", {"hyperbola"}),
    ("the title of a recipe", "figures/trochoids.py", '"""', '"""New: ', {"trochoids"}),
    (
        "a kernel that two reach",
        "atlas/core/hyperbola.py",
        "\nclass",
        "\nNEW = 1\n\n\nclass",
        {"hyperbola", "frequencies"},
    ),
    ("a kernel that one reaches", "atlas/core/charge.py", "\nclass", "\nNEW = 1\n\n\nclass", {"trochoids"}),
    ("the style", "atlas/scene/style.py", '"""', '"""New: ', EVERY),
    ("the vector renderer", "atlas/render/vector.py", '"""', '"""New: ', EVERY),
    ("the shaded renderer", "atlas/render/shaded.py", '"""', '"""New: ', {"quadric"}),
    ("a stored record", "reports/data/bench.json", '"date"', '"date" ', {"horizon"}),
    ("the prose", "reports/atlas.toml", "title", "title ", set()),
    ("a template", "templates/html/page.html", "<", " <", set()),
    ("a kernel that no figure reaches", "atlas/exact/digits.py", 'MARK = "?"', 'MARK = NEW = "?"', set()),
]


@pytest.mark.parametrize(("file", "old", "new", "again"), [c[1:] for c in CHANGES], ids=[c[0] for c in CHANGES])
def test_a_change_draws_again_what_depends_on_it(
    checkout: Path, file: str, old: str, new: str, again: set[str]
) -> None:
    """Each kind of change makes new the keys of exactly those plates that it can alter."""
    before = keys()
    edit(checkout / file, old, new)
    after = keys()
    changed = different(before, after)
    assert changed - {"report"} == again
    cosmetic = file.endswith(".py") and not again and "NEW" not in new
    assert ("report" in changed) is not cosmetic


def test_a_parameter_draws_again_its_figure(checkout: Path) -> None:
    """One figure's parameter makes that plate new and no other, down to the last bit."""
    assert checkout.is_dir()
    changed = Request("hyperbola", "vector", {"ratio": 1.5000000000000002})
    assert different(keys(), keys(hyperbola=changed)) == {"hyperbola"}


def test_the_gl_library_draws_again_what_is_shaded(checkout: Path) -> None:
    """Another GL library, or none, makes only the shaded plates new."""
    assert checkout.is_dir()
    assert different(keys("egl"), keys("osmesa")) == {"quadric"}
    assert different(keys("egl"), keys(None)) == {"quadric"}


def test_a_library_that_draws_draws_all_again(checkout: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Another Matplotlib makes every plate new; another VTK the shaded ones."""
    assert checkout.is_dir()
    before = keys()
    for library, again in (("matplotlib", EVERY), ("vtk", {"quadric"})):
        with monkeypatch.context() as patch:
            patch.setattr(plates_module, "release", lambda name, new=library: "99" if name == new else _known(name))
            assert different(before, keys()) - {"report"} == again


_known = plates_module.release


def test_the_place_of_the_checkout_does_not_matter(checkout: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The same sources in another folder have the same keys."""
    before = keys()
    elsewhere = checkout.with_name("another name")
    checkout.rename(elsewhere)
    for module in (sources_module, plates_module, fresh):
        monkeypatch.setattr(module, "PACKAGE", elsewhere / "atlas")
    monkeypatch.setattr(places, "_PACKAGE", elsewhere / "atlas")
    sources_module._files.cache_clear()
    assert not different(before, keys())


def test_a_plate_is_drawn_once_and_says_why(tmp_path: Path) -> None:
    """The first time a plate is drawn, the second time it is taken; both have the same files and facts."""
    store = Store(tmp_path)
    requests = [Request("trochoids", "vector", {}), Request("trochoids", "vector", {"speeds": (0.5, 1.0)})]
    first, again = made(requests, store), made(requests, store)
    for request in requests:
        assert first[request].new
        assert first[request].why == "it was never made here"
        assert not again[request].new
        assert again[request].facts["caption"] == first[request].facts["caption"]
        assert again[request].facts["cost"] == first[request].facts["cost"]
        assert again[request].file("picture").read_bytes().startswith(b"<?xml")
    assert first[requests[0]].file("picture").read_bytes() != first[requests[1]].file("picture").read_bytes()


def test_only_what_a_target_lacks_is_drawn(tmp_path: Path) -> None:
    """A figure that is there as SVG is drawn as PDF alone when that is wanted too."""
    store = Store(tmp_path)
    (first,) = made([Request("magn", "vector", {}, ("svg",))], store).values()
    assert first.entries.keys() == {"svg"}
    (both,) = survey([Request("magn", "vector", {}, ("svg", "pdf"))], store, Sources(), None)
    assert both.missing.keys() == {"pdf"}
    (drawn,) = made([Request("magn", "vector", {}, ("svg", "pdf"))], store).values()
    assert {target: entry.new for target, entry in drawn.entries.items()} == {"svg": False, "pdf": True}
    assert drawn.file("pdf").read_bytes().startswith(b"%PDF")


def test_both_renderers_share_a_scene(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A recipe with the same parameters is computed once for the shaded plate and the line drawing."""
    counted = []
    whole = plates_module._scene
    monkeypatch.setattr(plates_module, "_scene", lambda request: counted.append(request) or whole(request))
    requests = [
        Request("cone", "shaded", {}),
        Request("cone", "vector", {}),
        Request("cone", "vector", {"field": (2, 1)}),
    ]
    plates = survey(requests, Store(tmp_path), Sources(), None)
    found = [task for _, task in tasks(plates, Store(tmp_path))]
    assert len(found) == 3
    assert found[0].scene is found[1].scene
    assert [request.parameters for request in counted] == [{}, {"field": (2, 1)}]


def test_a_plate_that_fails_does_not_stop_the_others(tmp_path: Path) -> None:
    """A recipe that raises is returned with its reason, and the others are drawn."""
    requests = [Request("trochoids", "vector", {"mu": 0.0}), Request("magn", "vector", {})]
    for jobs in (1, 2):
        failed, drawn = made(requests, Store(tmp_path / str(jobs)), jobs).values()
        assert failed.failure
        assert "Error" not in failed.failure
        assert drawn.new


def test_a_process_that_dies_takes_its_plate_along_and_no_other(tmp_path: Path) -> None:
    """A drawing process that is killed leaves the reason in its plate; the rest is drawn by those that live."""
    requests = [Request("trochoids", "vector", {}), Request("magn", "vector", {}), Request("lssc", "vector", {})]
    plates = survey(requests, Store(tmp_path), Sources(), None)
    with Drawers(2) as drawers:
        drawers.load(["vector"] * 3)
        waiting = {}
        for plate, task in tasks(plates, Store(tmp_path)):
            drawers.give(task)
            if not waiting:
                drawers._busy[0].process.kill()
            waiting[task] = plate
        for task, outcome in drawers.outcomes():
            waiting[task].settle(outcome)
    assert "ended with status -9" in plates[0].failure
    assert [plate.new for plate in plates[1:]] == [True, True]


def test_another_process_takes_the_place_of_one_that_died(tmp_path: Path) -> None:
    """Also if there was but one process, and that has died, what was waiting is drawn."""
    plates = survey([Request("magn", "vector", {}), Request("lssc", "vector", {})], Store(tmp_path), Sources(), None)
    with Drawers(1) as drawers:
        waiting = {}
        for plate, task in tasks(plates, Store(tmp_path)):
            waiting[task] = plate
            drawers.give(task)
        drawers._busy[0].process.kill()
        for task, outcome in drawers.outcomes():
            waiting[task].settle(outcome)
    assert [plate.failure for plate in plates] == ["the process that drew it ended with status -9", ""]
    assert plates[1].new


def test_what_goes_wrong_with_the_processes_is_raised(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """If no other process can be started, that is raised instead of waited for without end."""

    def fail() -> None:
        raise MemoryError("no room for a process")

    plates = survey([Request("magn", "vector", {}), Request("lssc", "vector", {})], Store(tmp_path), Sources(), None)
    with Drawers(1) as drawers:
        for _, task in tasks(plates, Store(tmp_path)):
            drawers.give(task)
        monkeypatch.setattr(drawers_module, "_Drawer", fail)
        drawers._busy[0].process.kill()
        with pytest.raises(MemoryError, match="no room"):
            list(drawers.outcomes())


def test_the_quantities_asked_for_are_counted(tmp_path: Path) -> None:
    """The ledger names what the recipe asked the kernels for, and nothing else."""
    (plate,) = made([Request("hyperbola", "vector", {})], Store(tmp_path)).values()
    asked = plate.facts["cost"]["quantities"]
    assert "Hyperbola.omega3" in asked
    assert not any(name.startswith(("ElementaryMotion", "Quadric", "ParticleMotion")) for name in asked)
    assert plate.facts["cost"]["points"] > 0


def test_a_library_that_writes_one_format_makes_that_one_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Typst sets the PDF of a figure and nothing else of it, and it is named as the reason."""
    request, store = Request("magn", "vector", {}, ("svg", "pdf")), Store(tmp_path)
    made([request], store)
    monkeypatch.setattr(plates_module, "release", lambda name: "99" if name == "typst" else _known(name))
    (plate,) = survey([request], store, Sources(), None)
    assert plate.missing.keys() == {"pdf"}
    assert plate.why == "changed: pdf writer"


MISBEHAVING = '''"""A recipe that does what it should not."""

from dataclasses import replace

from atlas.scene import recipes


def scene(*, wrong: str = ""):
    """Draw what another recipe draws."""
    print("found it")
    if wrong == "exit":
        raise SystemExit(3)
    drawn = recipes.load("magn").scene()
    return replace(drawn, caption=lambda: "") if wrong == "function" else drawn
'''


@pytest.mark.parametrize(
    ("wrong", "complaint"), [("exit", "exit status 3"), ("function", "what no other process can read"), ("", "")]
)
def test_a_recipe_that_misbehaves_fails_alone(
    checkout: Path, capfd: pytest.CaptureFixture[str], wrong: str, complaint: str
) -> None:
    """A recipe that ends the program, or makes what cannot be drawn, is told of; what it prints is no result."""
    (checkout / "figures" / "misbehaving.py").write_text(MISBEHAVING)
    requests = [Request("misbehaving", "vector", {"wrong": wrong}), Request("trochoids", "vector", {})]
    plate, other = made(requests, Store(checkout / "store")).values()
    assert complaint in plate.failure
    assert bool(plate.failure) is bool(complaint)
    assert other.new
    assert capfd.readouterr().out == ""
