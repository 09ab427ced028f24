"""Digests of the code that a figure reaches."""

import ast
import os
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest

from atlas import sources as sources_module
from atlas.book.building.cache import Cache
from atlas.pictures import recipes
from atlas.places import folder
from atlas.sources import PACKAGE, Sources

RECIPE = '''"""A title."""

import numpy as np

from atlas.motions.elementary.kernel_hyperbola import Hyperbola


def scene():
    from atlas.arithmetic import rotation

    return Hyperbola, np, rotation
'''


@pytest.fixture(scope="module")
def memory(tmp_path_factory: pytest.TempPathFactory) -> Cache:
    """Remember the files of the package, which are parsed once."""
    folder = tmp_path_factory.mktemp("memory")
    sources = Sources(Cache(folder / "cache"))
    sources.closure([write(folder / "recipe.py", "import atlas\n")])
    sources.save()
    return Cache(folder / "cache")


def write(path: Path, text: str) -> Path:
    """Write a file whose time differs from the last one's."""
    stamp = path.stat().st_mtime_ns + 10**9 if path.exists() else None
    path.write_text(text)
    if stamp is not None:
        os.utime(path, ns=(stamp, stamp))
    return path


@pytest.mark.parametrize(
    ("old", "new", "same"),
    [
        ("import numpy as np\n", "import numpy as np  # arrays\n", True),
        ("return Hyperbola, np, rotation", "return (\n        Hyperbola,\n        np,\n        rotation,\n    )", True),
        ("return Hyperbola, np, rotation", "return Hyperbola, np, 1", False),
        ("A title.", "Another title.", False),
        ("motions.elementary.kernel_hyperbola import Hyperbola", "surfaces.kernel import Quadric as Hyperbola", False),
    ],
)
def test_comments_and_formatting_change_no_digest(
    tmp_path: Path, memory: Cache, old: str, new: str, same: bool
) -> None:
    """Comments and line breaks leave the digest alone; code, titles and imports do not."""
    recipe = tmp_path / "recipe.py"
    before = Sources(memory).closure([write(recipe, RECIPE)])
    assert old in RECIPE
    after = Sources(memory).closure([write(recipe, RECIPE.replace(old, new))])
    assert (before == after) is same


def test_cached_sources_are_never_stale(tmp_path: Path) -> None:
    """A changed file is read anew, also one that was changed within a moment and keeps its time and size."""
    recipe, cache = write(tmp_path / "recipe.py", "x = 1\n"), Cache(tmp_path / "cache")
    times = recipe.stat().st_atime_ns, recipe.stat().st_mtime_ns
    sources = Sources(cache)
    before = sources.closure([recipe])
    sources.save()
    assert Sources(cache).closure([recipe]) == before
    recipe.write_text("x = 2\n")
    os.utime(recipe, ns=times)
    assert Sources(cache).closure([recipe]) != before


@pytest.mark.parametrize("text", ["def scene(:\n", "x = '\x00'\n"])
def test_a_file_that_is_no_python_has_a_digest(tmp_path: Path, text: str) -> None:
    """A slip in one recipe stops no other figure: its digest is that of its bytes, and changes with them."""
    recipe = write(tmp_path / "recipe.py", text)
    assert Sources().reached([recipe]) == (recipe,)
    before = Sources().closure([recipe])
    assert Sources().closure([write(recipe, text + "# mended?\n")]) != before


@pytest.mark.parametrize(
    ("statement", "module"),
    [
        ("from atlas import Hyperbola", "motions/elementary/kernel_hyperbola.py"),
        ("from atlas import *", "surfaces/kernel.py"),
        ("import atlas", "motions/particle/flight.py"),
        ("import atlas.arithmetic.phase", "motions/particle/flight.py"),
        ("import atlas as a", "motions/particle/kernel.py"),
        ("from atlas import simulate", "checking/simulate.py"),
        (
            "def scene():\n    from atlas.motions.elementary.kernel_hyperbola import Hyperbola",
            "motions/elementary/kernel_hyperbola.py",
        ),
    ],
)
def test_public_names_reach_the_modules_that_they_come_from(
    tmp_path: Path, memory: Cache, statement: str, module: str
) -> None:
    """The package loads its public names when they are used; a recipe that uses one depends on its kernel."""
    recipe = write(tmp_path / "recipe.py", f"{statement}\n")
    assert PACKAGE / module in Sources(memory).reached([recipe])


def test_one_public_name_reaches_no_other(tmp_path: Path, memory: Cache) -> None:
    """A recipe that uses one public name does not depend on the kernels of the others."""
    recipe = write(tmp_path / "recipe.py", "from atlas import ParticleMotion, __version__\n")
    reached = {path.relative_to(PACKAGE).as_posix() for path in Sources(memory).reached([recipe]) if path != recipe}
    assert "motions/particle/kernel.py" in reached
    assert "motions/elementary/kernel_hyperbola.py" not in reached


def test_sources_of_a_recipe_include_an_imported_recipe(tmp_path: Path, memory: Cache) -> None:
    """Code that a recipe borrows from another one is part of it."""
    recipe = write(tmp_path / "recipe.py", "from figures.hyperbola import caption\n")
    assert folder("figures") / "hyperbola.py" in Sources(memory).reached([recipe])


def test_a_module_that_became_a_package_is_found(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The target of an import is looked up anew, even if the file with the import is remembered."""
    package, cache = tmp_path / "atlas", Cache(tmp_path / "cache")
    (package / "motions").mkdir(parents=True)
    for name in ("__init__.py", "motions/__init__.py", "motions/ball.py"):
        (package / name).write_text("")
    monkeypatch.setattr(sources_module, "PACKAGE", package)
    recipe = write(tmp_path / "recipe.py", "from atlas.motions import ball\n")
    sources = Sources(cache)
    assert package / "motions/ball.py" in sources.reached([recipe])
    sources.save()
    (package / "motions/ball").mkdir()
    (package / "motions/ball.py").rename(package / "motions/ball/__init__.py")
    assert package / "motions/ball/__init__.py" in Sources(cache).reached([recipe])


def test_one_thread_parses_at_a_time(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Who reads recipes waits for who digests: before Python 3.11.8 two of them end in a SystemError now and then."""
    inside, together = list[str](), list[int]()
    parse = ast.parse

    def slow(*arguments: Any) -> ast.Module:
        inside.append("")
        together.append(len(inside))
        time.sleep(0.02)
        inside.pop()
        return parse(*arguments)

    files = [tmp_path / f"recipe_{i}.py" for i in range(4)]
    for i, file in enumerate(files):
        file.write_text(f'"""Title {i}."""\n\n\ndef scene() -> None: ...\n', encoding="utf-8")
    monkeypatch.setattr(ast, "parse", slow)
    with ThreadPoolExecutor(4) as threads:
        digests = [threads.submit(Sources().closure, [file]) for file in files[:2]]
        titles = [threads.submit(recipes.load, str(file)) for file in files[2:]]
        assert len({future.result() for future in digests}) == 2
        assert [future.result().title for future in titles] == ["Title 2", "Title 3"]
    assert len(together) >= 4
    assert max(together) == 1
