"""The store of what was built: whole or not at all, and never the wrong thing."""

import json
import multiprocessing
import os
import random
import signal
import time
from pathlib import Path

import pytest

from atlas.build.memory import Memory
from atlas.build.store import Store, place
from atlas.build.whole import PREFIX

KEY = "ab" * 32
OTHER = "cd" * 32


def writer(text: str):  # type: ignore[no-untyped-def]  # noqa: ANN201  a maker for the store
    """Return a maker that writes one file and notes its length."""

    def make(folder: Path) -> dict[str, int]:
        (folder / "plate.svg").write_text(text)
        return {"length": len(text)}

    return make


def test_what_is_put_is_what_is_taken(tmp_path: Path) -> None:
    """An entry holds the files and the facts of its maker, under its key only."""
    store = Store(tmp_path)
    made = store.make(KEY, writer("one"))
    taken = store.take(KEY)
    assert made.new
    assert taken is not None
    assert not taken.new
    assert taken.file("plate.svg").read_text() == "one"
    assert taken.facts == {"length": 3}
    assert store.take(OTHER) is None


@pytest.mark.parametrize("damage", ["changed", "emptied", "removed", "contents"])
def test_a_damaged_entry_is_not_taken_and_heals(tmp_path: Path, damage: str) -> None:
    """An entry whose files are not those that were put there counts as missing, and is made again."""
    store = Store(tmp_path)
    entry = store.make(KEY, writer("one"))
    victim = entry.file("contents.json" if damage == "contents" else "plate.svg")
    if damage == "removed":
        victim.unlink()
    else:
        victim.write_text("" if damage != "changed" else "two")
    assert store.take(KEY) is None
    store.make(KEY, writer("one"))
    healed = store.take(KEY)
    assert healed is not None
    assert healed.file("plate.svg").read_text() == "one"


def test_a_maker_that_fails_leaves_nothing(tmp_path: Path) -> None:
    """When a maker raises, no entry and no half-written folder stays behind."""

    def fail(folder: Path) -> dict[str, int]:
        (folder / "plate.svg").write_text("half")
        raise ZeroDivisionError

    store = Store(tmp_path)
    with pytest.raises(ZeroDivisionError):
        store.make(KEY, fail)
    assert store.take(KEY) is None
    assert not list((tmp_path / "unfinished").glob(f"{PREFIX}*"))


def _slow(root: str) -> None:
    def make(folder: Path) -> dict[str, int]:
        for index in range(200):
            with (folder / "plate.svg").open("a") as file:
                file.write("x" * 100)
                file.flush()
            if index % 20 == 0:
                time.sleep(0.001)
        return {"length": 20000}

    Store(Path(root)).make(KEY, make)


def test_a_maker_killed_at_any_moment_leaves_no_wrong_entry(tmp_path: Path) -> None:
    """Killed at random moments, a build leaves the entry whole or absent, never half."""
    context = multiprocessing.get_context("fork")
    chance = random.Random(5)  # noqa: S311  reproducible, not secret
    for _ in range(25):
        child = context.Process(target=_slow, args=(str(tmp_path),))
        child.start()
        time.sleep(chance.uniform(0, 0.03))
        if child.pid is not None:
            os.kill(child.pid, signal.SIGKILL)
        child.join()
        entry = Store(tmp_path).take(KEY)
        assert entry is None or entry.file("plate.svg").stat().st_size == 20000
    _slow(str(tmp_path))
    assert Store(tmp_path).take(KEY) is not None


def test_two_makers_of_the_same_entry_do_no_harm(tmp_path: Path) -> None:
    """Several processes that make the same entry at once all succeed, and one whole entry is there."""
    context = multiprocessing.get_context("fork")
    children = [context.Process(target=_slow, args=(str(tmp_path),)) for _ in range(4)]
    for child in children:
        child.start()
    for child in children:
        child.join()
    assert [child.exitcode for child in children] == [0] * 4
    entry = Store(tmp_path).take(KEY)
    assert entry is not None
    assert entry.file("plate.svg").stat().st_size == 20000


def test_what_changed_is_told_by_name(tmp_path: Path) -> None:
    """The store says which parts of a key are different from the last time."""
    store = Store(tmp_path)
    assert store.changed("fig", {"a": "1", "b": "2"}) == "it was never made here"
    store.remember("fig", {"a": "1", "b": "2"})
    assert store.changed("fig", {"a": "1", "b": "3"}) == "changed: b"
    assert "lost" in store.changed("fig", {"a": "1", "b": "2"})


def test_placing_writes_only_what_differs(tmp_path: Path) -> None:
    """A file that is already there with the same bytes is left alone, times and all."""
    source, target = tmp_path / "a", tmp_path / "folder" / "b"
    source.write_text("text")
    assert place(source, target, tmp_path)
    before = target.stat().st_mtime_ns
    assert not place(source, target, tmp_path)
    assert target.stat().st_mtime_ns == before
    source.write_text("next")
    assert place(source, target, tmp_path)
    assert target.read_text() == "next"
    assert json.dumps(sorted(path.name for path in target.parent.iterdir())) == '["b"]'


@pytest.mark.parametrize("text", ["[]", "null", '{"files": {}, "facts": {}}', '{"plate.svg": "x"}'])
def test_contents_of_another_kind_count_as_missing(tmp_path: Path, text: str) -> None:
    """What was not noted by the store itself, as by an older one, is not taken."""
    store = Store(tmp_path)
    store.make(KEY, writer("one")).file("contents.json").write_text(text)
    assert store.take(KEY) is None
    assert store.make(KEY, writer("one")).new


def test_altered_facts_are_not_taken(tmp_path: Path) -> None:
    """One letter that is changed in the facts of an entry makes it count as damaged."""
    store = Store(tmp_path)
    contents = store.make(KEY, writer("one")).file("contents.json")
    contents.write_bytes(contents.read_bytes().replace(b'"length": 3', b'"length": 4'))
    assert store.take(KEY) is None


def test_altered_texts_are_set_anew(tmp_path: Path) -> None:
    """A remembered text that was changed by somebody else is forgotten, and so are the rest."""
    file = tmp_path / "texts.json"
    memory = Memory(file, "setter")
    memory["$x$"] = "<math>x</math>"
    assert memory["$x$"]
    memory.save()
    assert "$x$" in Memory(file, "setter")
    file.write_bytes(file.read_bytes().replace(b"<math>x", b"<math>y"))
    assert "$x$" not in Memory(file, "setter")


def test_what_is_kept_is_recalled(tmp_path: Path) -> None:
    """Bytes are recalled under their key only."""
    store = Store(tmp_path)
    assert store.recall(KEY) is None
    assert store.keep(KEY, b"bytes") == b"bytes"
    assert store.recall(KEY) == b"bytes"
    assert store.recall(OTHER) is None
