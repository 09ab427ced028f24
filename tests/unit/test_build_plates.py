"""What is built again when something changes: exactly what depends on it."""

import shutil
from pathlib import Path

import pytest

import atlas.build.plates as plates_module
import atlas.build.sources as sources_module
from atlas import places
from atlas.build import fresh
from atlas.build.plates import Request, key_of, plates
from atlas.build.sources import Sources
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


def keys(gl: str | None = "egl", **changed: Request) -> dict[str, str]:
    """Return the keys of the wanted plates and of a report, made from the sources as they are now."""
    sources = Sources()
    found = {name: key_of(request, sources, gl)[0] for name, request in (WANTED | changed).items()}
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
    ("the vector renderer", "atlas/render/vector.py", "DPI = 300.0", "DPI = 301.0", EVERY),
    ("the shaded renderer", "atlas/render/shaded.py", "_OVER = 2", "_OVER = 3", {"quadric"}),
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
            patch.setattr(plates_module, "_version", lambda name, new=library: "99" if name == new else _known(name))
            assert different(before, keys()) - {"report"} == again


_known = plates_module._version


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
    store, sources = Store(tmp_path), Sources()
    requests = [Request("trochoids", "vector", {}), Request("trochoids", "vector", {"speeds": (0.5, 1.0)})]
    first = {plate.request: plate for plate in plates(requests, store, sources, gl=None)}
    again = {plate.request: plate for plate in plates(requests, store, sources, gl=None)}
    for request in requests:
        assert first[request].new
        assert first[request].why == "it was never made here"
        assert not again[request].new
        assert again[request].facts == first[request].facts
        assert again[request].file("html").read_bytes().startswith(b"<?xml")
        assert again[request].file("pdf").read_bytes().startswith(b"%PDF")
    assert first[requests[0]].file("html").read_bytes() != first[requests[1]].file("html").read_bytes()


def test_a_plate_that_fails_does_not_stop_the_others(tmp_path: Path) -> None:
    """A recipe that raises is returned with its reason, in this process and in processes of their own."""
    requests = [Request("trochoids", "vector", {"mu": 0.0}), Request("magn", "vector", {})]
    for jobs in (1, 2):
        found = {
            p.request.recipe: p for p in plates(requests, Store(tmp_path / str(jobs)), Sources(), gl=None, jobs=jobs)
        }
        assert found["trochoids"].failure.startswith("DomainError: ")
        assert found["magn"].new


def test_the_quantities_asked_for_are_counted(tmp_path: Path) -> None:
    """The ledger names what the recipe asked the kernels for, and nothing else."""
    (plate,) = plates([Request("hyperbola", "vector", {})], Store(tmp_path), Sources(), gl=None)
    asked = plate.facts["cost"]["quantities"]
    assert "Hyperbola.omega3" in asked
    assert not any(name.startswith(("ElementaryMotion", "Quadric", "ParticleMotion")) for name in asked)
    assert plate.facts["cost"]["points"] > 0
