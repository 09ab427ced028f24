"""Digests of the code that a figure reaches."""

import os
import time
from pathlib import Path

import pytest

from atlas.build import notes
from atlas.build import sources as sources_module
from atlas.build.sources import PACKAGE, TICK, Sources, digest
from atlas.places import folder

RECIPE = '''"""A title."""

import numpy as np

from atlas.core.hyperbola import Hyperbola


def scene():
    from atlas.core import rotation

    return Hyperbola, np, rotation
'''


def write(path: Path, text: str) -> Path:
    """Write a file whose time differs from the last one's."""
    stamp = path.stat().st_mtime_ns + 10**9 if path.exists() else None
    path.write_text(text)
    if stamp is not None:
        os.utime(path, ns=(stamp, stamp))
    return path


def test_a_recipe_reaches_what_it_imports_and_nothing_else(tmp_path: Path) -> None:
    """Imports are followed at any depth, also inside functions; modules that are not imported stay out."""
    recipe = write(tmp_path / "recipe.py", RECIPE)
    reached = {path.relative_to(PACKAGE).as_posix() for path in Sources().reached([recipe]) if path != recipe}
    assert {"__init__.py", "core/__init__.py", "core/hyperbola.py", "core/rotation.py", "core/body.py"} <= reached
    assert not {name for name in reached if name.startswith(("cli", "render", "report", "proof", "study"))}
    assert "core/particle.py" not in reached


@pytest.mark.parametrize(
    ("old", "new", "same"),
    [
        ("import numpy as np\n", "import numpy as np  # arrays\n", True),
        ("return Hyperbola, np, rotation", "return (\n        Hyperbola,\n        np,\n        rotation,\n    )", True),
        ("return Hyperbola, np, rotation", "return Hyperbola, np, 1", False),
        ("A title.", "Another title.", False),
        ("core.hyperbola import Hyperbola", "core.quadric import Quadric as Hyperbola", False),
    ],
)
def test_comments_and_formatting_change_no_digest(tmp_path: Path, old: str, new: str, same: bool) -> None:
    """Comments and line breaks leave the digest alone; code, titles and imports do not."""
    recipe = tmp_path / "recipe.py"
    before = Sources().closure([write(recipe, RECIPE)])
    assert old in RECIPE
    after = Sources().closure([write(recipe, RECIPE.replace(old, new))])
    assert (before == after) is same


def test_the_memory_is_not_stale(tmp_path: Path) -> None:
    """A changed file is digested anew although its old digest is remembered."""
    recipe, memory = write(tmp_path / "recipe.py", RECIPE), tmp_path / "memory.json"
    sources = Sources(memory)
    before = sources.closure([recipe])
    sources.save()
    assert Sources(memory).closure([recipe]) == before
    write(recipe, RECIPE.replace("np, rotation", "np, 2"))
    assert Sources(memory).closure([recipe]) != before


def test_a_broken_memory_does_no_harm(tmp_path: Path) -> None:
    """Half a memory file is as good as none."""
    recipe, memory = write(tmp_path / "recipe.py", RECIPE), tmp_path / "memory.json"
    memory.write_text('{"half')
    assert Sources(memory).closure([recipe]) == Sources().closure([recipe])


def test_a_digest_knows_values_from_one_another() -> None:
    """Values that differ in type, order or last bit have different digests; equal dictionaries have the same."""
    values = [1, 1.5, "1.5", [1.5], [1.5, 2], [2, 1.5], 1.5000000000000002, None, True, {"a": 1}, {"b": 1}]
    assert len({digest(value) for value in values}) == len(values)
    assert digest({"a": 1, "b": 2}) == digest({"b": 2, "a": 1})


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
        ("from atlas import Hyperbola", "core/hyperbola.py"),
        ("from atlas import *", "core/quadric.py"),
        ("import atlas", "core/flight.py"),
        ("import atlas.core.phase", "core/flight.py"),
        ("import atlas as a", "core/particle.py"),
        ("from atlas import simulate", "study/simulate.py"),
    ],
)
def test_public_names_reach_the_modules_that_they_come_from(tmp_path: Path, statement: str, module: str) -> None:
    """The package loads its public names when they are used; a recipe that uses one depends on its kernel."""
    recipe = write(tmp_path / "recipe.py", f"{statement}\n")
    assert PACKAGE / module in Sources().reached([recipe])


def test_one_public_name_reaches_no_other(tmp_path: Path) -> None:
    """A recipe that uses one public name does not depend on the kernels of the others."""
    recipe = write(tmp_path / "recipe.py", "from atlas import ParticleMotion, __version__\n")
    reached = {path.relative_to(PACKAGE).as_posix() for path in Sources().reached([recipe]) if path != recipe}
    assert "core/particle.py" in reached
    assert "core/hyperbola.py" not in reached


def test_a_recipe_reaches_another_that_it_imports(tmp_path: Path) -> None:
    """What a recipe borrows from another one is part of it."""
    recipe = write(tmp_path / "recipe.py", "from figures.hyperbola import caption\n")
    assert folder("figures") / "hyperbola.py" in Sources().reached([recipe])


def test_an_edit_that_keeps_time_and_size_is_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A file that was put in place of another of the same size with the same time has another digest."""
    recipe, memory = tmp_path / "recipe.py", tmp_path / "memory.json"
    recipe.write_text("x = 1\n")
    stamp = recipe.stat().st_mtime_ns
    monkeypatch.setattr(sources_module, "TICK", -1)  # as if it had been written long ago
    sources = Sources(memory)
    before = sources.closure([recipe])
    sources.save()
    recipe.write_text("x = 2\n")
    os.utime(recipe, ns=(stamp, stamp))
    assert Sources(memory).closure([recipe]) != before


def test_a_file_written_just_now_is_not_remembered(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Two edits within one tick of the clock can't be told apart by the file's times: the first is not remembered."""
    recipe, memory = write(tmp_path / "recipe.py", "x = 1\n"), tmp_path / "memory.json"
    sources = Sources(memory)
    sources.closure([recipe])
    sources.save()
    assert str(recipe) not in notes.read(memory)
    monkeypatch.setattr(time, "time_ns", lambda: recipe.stat().st_ctime_ns + TICK + 1)
    sources = Sources(memory)
    sources.closure([recipe])
    sources.save()
    assert str(recipe) in notes.read(memory)


def test_a_module_that_became_a_package_is_found(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What an import leads to is looked up anew, even if the file with the import is remembered."""
    package, memory = tmp_path / "atlas", tmp_path / "memory.json"
    (package / "core").mkdir(parents=True)
    for name in ("__init__.py", "core/__init__.py", "core/ball.py"):
        (package / name).write_text("")
    monkeypatch.setattr(sources_module, "PACKAGE", package)
    monkeypatch.setattr(sources_module, "TICK", -1)
    recipe = write(tmp_path / "recipe.py", "from atlas.core import ball\n")
    sources_module._files.cache_clear()
    sources = Sources(memory)
    assert package / "core/ball.py" in sources.reached([recipe])
    sources.save()
    (package / "core/ball").mkdir()
    (package / "core/ball.py").rename(package / "core/ball/__init__.py")
    sources_module._files.cache_clear()
    assert package / "core/ball/__init__.py" in Sources(memory).reached([recipe])
    sources_module._files.cache_clear()


@pytest.mark.parametrize("text", ["[]", "null", '{"a": 1}', '"x"', "\xff"])
def test_a_memory_of_another_kind_does_no_harm(tmp_path: Path, text: str) -> None:
    """What is no memory of ours is as good as none."""
    recipe, memory = write(tmp_path / "recipe.py", RECIPE), tmp_path / "memory.json"
    memory.write_text(text)
    assert Sources(memory).closure([recipe]) == Sources().closure([recipe])


def test_a_memory_that_cannot_be_written_is_done_without(tmp_path: Path) -> None:
    """Where nothing can be noted, everything is digested anew, to the same digests."""
    recipe = write(tmp_path / "recipe.py", RECIPE)
    (tmp_path / "file").write_text("")
    sources = Sources(tmp_path / "file" / "memory.json")
    digests = sources.closure([recipe])
    sources.save()
    assert Sources().closure([recipe]) == digests
