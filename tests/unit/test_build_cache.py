"""The cache: each entry whole or not at all, and never the wrong thing."""

import multiprocessing
import os
import random
import signal
import time
from pathlib import Path

import pytest

from atlas.book.building.cache import Cache
from atlas.sources import digest

KEY, OTHER, RECENT = digest("key"), digest("other"), digest("recent")
DAY, UNUSED = 86_400.0, 90 * 86_400.0
LARGE = b"x" * 2_000_000


def path_of(cache: Cache, key: str) -> Path:
    """Return the file of an entry."""
    (path,) = cache.folder.glob(f"*/{key}")
    return path


@pytest.mark.parametrize("damage", [b"", b"x", b"one", b"\n", b"[]", None])
def test_a_damaged_entry_is_missing_and_heals(tmp_path: Path, damage: bytes | None) -> None:
    """A changed entry counts as missing, and can be put again."""
    cache = Cache(tmp_path)
    cache.put(KEY, b"one")
    path = path_of(cache, KEY)
    path.write_bytes(path.read_bytes().replace(b"one", b"two") if damage is None else damage)
    assert cache.get(KEY) is None
    assert cache.recall(KEY, lambda: b"one") == b"one"
    assert cache.get(KEY) == b"one"


def test_the_entry_of_another_key_is_missing(tmp_path: Path) -> None:
    """Two entries that were exchanged, by a copy or by hand, are no entries; new entries stay."""
    cache = Cache(tmp_path)
    cache.put(KEY, b"one")
    cache.put(OTHER, b"two")
    entry, entry_other = path_of(cache, KEY), path_of(cache, OTHER)
    content = entry.read_bytes()
    entry.write_bytes(entry_other.read_bytes())
    entry_other.write_bytes(content)
    assert cache.get(KEY) is cache.get(OTHER) is None
    assert cache.recall(KEY, lambda: b"one") == cache.get(KEY) == b"one"


def put(folder: str) -> None:
    """Put a large entry, a few times over."""
    for _ in range(5):
        Cache(Path(folder)).put(KEY, LARGE)


@pytest.mark.slow
def test_a_process_killed_at_any_moment_leaves_no_wrong_entry(tmp_path: Path) -> None:
    """Killed at random moments, a process leaves the entry whole or absent, never half."""
    context, chance = multiprocessing.get_context("fork"), random.Random(5)  # noqa: S311  reproducible, not secret
    for _ in range(25):
        child = context.Process(target=put, args=(str(tmp_path),))
        child.start()
        time.sleep(chance.uniform(0, 0.03))
        if child.pid is not None:
            os.kill(child.pid, signal.SIGKILL)
        child.join()
        assert Cache(tmp_path).get(KEY) in {None, LARGE}
    put(str(tmp_path))
    assert Cache(tmp_path).get(KEY) == LARGE


def test_two_processes_that_put_the_same_do_no_harm(tmp_path: Path) -> None:
    """Several processes that put the same entry at once all succeed, and it is whole."""
    context = multiprocessing.get_context("fork")
    children = [context.Process(target=put, args=(str(tmp_path),)) for _ in range(4)]
    for child in children:
        child.start()
    for child in children:
        child.join()
    assert [child.exitcode for child in children] == [0] * 4
    assert Cache(tmp_path).get(KEY) == LARGE


def test_unused_cache_entries_are_removed(tmp_path: Path) -> None:
    """Entries that nobody read for long go, and so do leftovers of a killed build; entries in use stay."""
    cache, now = Cache(tmp_path), time.time()
    for key in (KEY, OTHER):
        cache.put(key, b"x")
        os.utime(path_of(cache, key), (now - UNUSED - 10, now - UNUSED - 10))
    assert cache.get(OTHER) == b"x"
    cache.put(RECENT, b"x")
    fresh = path_of(cache, RECENT).with_name(".fresh.part")
    fresh.write_text("half")
    for path, age in ((path_of(cache, RECENT), UNUSED), (fresh, DAY)):
        os.utime(path, (now - age + 60, now - age + 60))
    leftovers = [tmp_path / "tmp" / "killed" / "file", path_of(cache, OTHER).with_name(".half.part")]
    for path in leftovers:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("half")
    for path in (leftovers[0].parent, leftovers[1]):
        os.utime(path, (now - DAY - 10, now - DAY - 10))
    with cache.temporary() as folder:
        cache.prune()
        assert folder.is_dir()
    assert not folder.exists()
    assert (tmp_path / ".gitignore").read_text() == "*\n"
    assert cache.get(OTHER) == b"x"
    assert not list(tmp_path.glob(f"*/{KEY}"))
    assert not any(path.exists() for path in leftovers)
    assert fresh.exists()
    assert path_of(cache, RECENT).exists()


def test_different_values_have_different_digests() -> None:
    """Values that differ in type, order or last bit have different digests; equal dictionaries have the same."""
    values = [1, 1.5, "1.5", [1.5], [1.5, 2], [2, 1.5], 1.5000000000000002, None, True, {"a": 1}, {"b": 1}]
    assert len({digest(value) for value in values}) == len(values)
    assert digest({"a": 1, "b": 2}) == digest({"b": 2, "a": 1})
