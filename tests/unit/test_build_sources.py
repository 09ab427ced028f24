"""Digests of the code that a figure reaches."""

import os
from pathlib import Path

import pytest

from atlas.build.sources import PACKAGE, Sources, digest

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
