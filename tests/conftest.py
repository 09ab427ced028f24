"""How property tests run: the same examples each time and no clock, or, for a hunt, other examples each time.

And the folder of the tests' builds: none finds leftovers of another.
"""

import gc
import os
import signal
from collections.abc import Iterator

import pytest
from hypothesis import given, settings, strategies

settings.register_profile("test", deadline=None, derandomize=True)
settings.register_profile("hunt", deadline=None, print_blob=True)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "test"))

CACHE = "ATLAS_CACHE"

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # as the program does; xdist's workers take the cores

gc.disable()  # while tests are collected, which leaves no garbage


def pytest_collection_finish() -> None:
    """Freeze the objects that exist after collection: the garbage collector would visit them in each of its rounds.

    Before its first example Hypothesis asks the collector who holds its random numbers, and warns where nobody does.
    With the oldest Hypothesis, or from Python 3.14 on, that is among the frozen objects, so an example comes first.
    """
    given(strategies.none())(lambda _: None)()
    gc.freeze()
    gc.enable()


@pytest.fixture(scope="session", autouse=True)
def _cache_of_all(tmp_path_factory: pytest.TempPathFactory) -> None:
    """Give fixtures that several tests share a cache of their own."""
    os.environ[CACHE] = str(tmp_path_factory.mktemp("cache"))


@pytest.fixture(autouse=True)
def _cache(tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch) -> None:
    """Give each test an empty cache."""
    monkeypatch.setenv(CACHE, str(tmp_path_factory.getbasetemp() / "caches" / os.urandom(8).hex()))


@pytest.fixture
def interrupts() -> Iterator[None]:
    """Let programs that a test starts heed Ctrl-C, which a script's jobs in the background, and theirs, ignore."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)
