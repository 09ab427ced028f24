"""Compiled templates: kept under all that makes them what they are."""

from pathlib import Path

import pytest
from jinja2 import DictLoader, Environment

from atlas.build import compiled as compiled_module
from atlas.build.compiled import Compiled
from atlas.build.store import Store


def rendered(store: Store, code: str, *, trim: bool = False) -> str:
    """Fill a template whose text does not tell how it is to be read."""
    cache = Compiled(store, code)
    environment = Environment(loader=DictLoader({"page": "{% if 1 %}\nx{% endif %}"}), bytecode_cache=cache)  # noqa: S701  no HTML
    environment.trim_blocks = trim
    return environment.get_template("page").render()


def entries(store: Store) -> int:
    """Count what is in a store."""
    return len(list(store.root.glob("??/*")))


def test_a_template_is_compiled_once(tmp_path: Path) -> None:
    """The same text, set by the same code, is compiled once."""
    store = Store(tmp_path)
    assert rendered(store, "code") == rendered(store, "code") == "\nx"
    assert entries(store) == 1


def test_the_code_that_sets_a_template_is_part_of_it(tmp_path: Path) -> None:
    """Options are set in code: when that changes, what was compiled before is not taken."""
    store = Store(tmp_path)
    assert rendered(store, "code") == "\nx"
    assert rendered(store, "new code", trim=True) == "x"


def test_another_release_compiles_anew(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Another release of Jinja2 may compile the same text to something else."""
    store = Store(tmp_path)
    rendered(store, "code")
    monkeypatch.setattr(compiled_module, "release", lambda _name: "99")
    rendered(store, "code")
    assert entries(store) == 2


def test_damaged_code_is_not_run(tmp_path: Path) -> None:
    """Compiled code that is not what was kept is made again."""
    store = Store(tmp_path)
    rendered(store, "code")
    (content,) = store.root.glob("??/*/content")
    content.write_bytes(content.read_bytes().replace(b"x", b"y"))
    assert rendered(store, "code") == "\nx"
