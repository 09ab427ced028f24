"""Processes that draw, side by side: each loads what it needs once and lives until the build ends.

The first is there from the start, so that it can load the drawing libraries while the build still reads and computes.
Each has a pipe of its own: one that dies takes along the plate that it was drawing and no other, for another process
comes in its place; and one whose build is gone comes to an end by itself.
"""

import os
import signal
import subprocess
import sys
import warnings
from collections.abc import Iterator, Sequence
from contextlib import suppress
from importlib import import_module
from multiprocessing.connection import Connection, Pipe, wait
from pickle import PickleError
from queue import SimpleQueue
from threading import Thread
from typing import Any, Self

from atlas.build.drawing import Drawn, Task
from atlas.errors import AtlasError

MOST = 8
STDERR = 2
"""What a recipe or a library prints while it draws is no result."""
_PROGRAM = "import sys; sys.path[:] = {!r}; from atlas.build.drawers import serve; serve({})"


def many() -> int:
    """Return how many processes draw when the user does not say: one a core, within reason."""
    return min(os.cpu_count() or 1, MOST)


class Drawers:
    """Up to `count` processes for as long as the context lasts."""

    def __init__(self, count: int) -> None:
        self.count = count
        self._free = [_Drawer()] if count else []
        self._busy: list[_Drawer] = []
        self._waiting: list[Task] = []
        self._done: list[tuple[Task, Any]] = []
        self._thread: Thread | None = None
        self._leaving = False

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._leaving = True
        for drawer in self._free + self._busy:
            drawer.process.terminate()
        if self._thread:
            self._thread.join()
        for drawer in self._free + self._busy:
            drawer.stop()

    def load(self, renderers: Sequence[str]) -> None:
        """Start as many processes as there are plates, and let each load what it will need; idle ones only.

        What is shaded is left to one of them as long as possible.
        """
        self._free += [_Drawer() for _ in range(len(self._free), min(self.count, len(renderers)))]
        wanted = sorted(renderers, key=lambda renderer: renderer != "shaded")
        if "vector" in wanted:
            wanted = [wanted[0], *wanted[:0:-1]]
        for drawer, renderer in zip(self._free, wanted, strict=False):
            drawer.load(renderer)

    def give(self, task: Task) -> None:
        """Take in a task; it is drawn as soon as a process is free."""
        self._waiting.append(task)
        self._turn(0.0)

    def outcomes(self) -> Iterator[tuple[Task, Drawn | str]]:
        """Have all tasks drawn from now on, whatever the caller does, and go through them as they are finished.

        Each comes with what was drawn, or in a sentence why it was not. Raises OSError when a process could not write:
        that is not the plate's fault.
        """
        found: SimpleQueue[tuple[Task, Any] | Exception | None] = SimpleQueue()
        self._thread = Thread(target=self._hand_out, args=(found,), daemon=True)
        self._thread.start()
        return _told(found)

    def _hand_out(self, found: "SimpleQueue[tuple[Task, Any] | Exception | None]") -> None:
        """Hand out tasks and take in what becomes of them until all are done."""
        try:
            while not self._leaving and (self._waiting or self._busy or self._done):
                if not self._done:
                    self._turn(None)
                for outcome in self._done:
                    found.put(outcome)
                self._done.clear()
        except Exception as error:  # noqa: BLE001  it is raised where the outcomes are awaited
            found.put(error)
        found.put(None)

    def _turn(self, patience: float | None) -> None:
        """Take in what has been finished, after waiting for it so many seconds, and hand out what is waiting."""
        self._assign()
        for pipe in wait([drawer.pipe for drawer in self._busy], patience):
            drawer = next(one for one in self._busy if one.pipe is pipe)
            self._busy.remove(drawer)
            self._done.append(drawer.answer())
            if drawer.process.poll() is not None and not self._leaving:
                drawer.stop()
                drawer = _Drawer()
            self._free.append(drawer)
        self._assign()

    def _assign(self) -> None:
        """Give tasks to free processes, such as have what they need where there is a choice."""
        while self._free and self._waiting:
            pairs = [(drawer, task) for task in self._waiting for drawer in self._free]
            drawer, task = min(pairs, key=lambda pair: pair[0].fits(pair[1]))
            self._waiting.remove(task)
            try:
                drawer.draw(task)
            except (PickleError, AttributeError, TypeError) as error:
                self._done.append((task, f"its scene holds what no other process can read: {error}"))
                continue
            self._free.remove(drawer)
            self._busy.append(drawer)


def _told(found: "SimpleQueue[tuple[Task, Any] | Exception | None]") -> Iterator[tuple[Task, Drawn | str]]:
    """Go through what was found, up to the end; an error of the machine ends it."""
    for item in iter(found.get, None):
        if isinstance(item, Exception):
            raise item
        task, outcome = item
        if isinstance(outcome, OSError):
            raise outcome
        yield task, outcome


class _Drawer:
    """One process, this end of its pipe, what it has loaded, and what it is drawing."""

    def __init__(self) -> None:
        self.pipe, there = Pipe()
        with there:
            program = _PROGRAM.format(sys.path, there.fileno())
            self.process = subprocess.Popen(  # noqa: S603  our own program, in our own interpreter
                [sys.executable, "-c", program], pass_fds=[there.fileno()], stdin=subprocess.DEVNULL, stdout=STDERR
            )
        self._loaded = ""
        self._task: Task | None = None

    def stop(self) -> None:
        """Let it come to its end, and wait for that."""
        self.process.terminate()
        self.pipe.close()
        self.process.wait()

    def load(self, renderer: str) -> None:
        """Let it load what a renderer needs."""
        self._send(renderer)
        self._loaded = renderer

    def draw(self, task: Task) -> None:
        """Let it draw."""
        self._send(task)
        self._task = task
        self._loaded = "shaded" if "shaded" in {self._loaded, task.renderer} else "vector"

    def fits(self, task: Task) -> int:
        """Say how well a task suits: best what is loaded and no more, worst what must be loaded first."""
        if task.renderer == "shaded":
            return 0 if self._loaded == "shaded" else 3
        return 1 if self._loaded == "vector" else 2

    def answer(self) -> tuple[Task, Any]:
        """Return its task and what became of it."""
        task, self._task = self._task, None
        if task is None:
            raise AssertionError("a process that was not asked has no answer")
        try:
            return task, self.pipe.recv()
        except (EOFError, ConnectionError):
            return task, f"the process that drew it ended with status {self.process.wait()}"

    def _send(self, what: str | Task) -> None:
        """Send something; if the process is gone, that is found out when its answer is awaited."""
        with suppress(ConnectionError):
            self.pipe.send(what)


def serve(number: int) -> None:
    """Do what comes through the pipe with that file descriptor until its other end is closed.

    The build decides what an interrupt means.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    if not sys.warnoptions:  # as on the command line: a float that overflows is told by what shows it
        warnings.simplefilter("ignore", RuntimeWarning)
    import_module("numpy")  # whatever there will be to draw
    pipe: Connection[Any, Any] = Connection(number)
    try:
        while True:
            asked = pipe.recv()
            if isinstance(asked, Task):
                pipe.send(_outcome(asked))
            else:
                _prepare(asked)
    except (EOFError, ConnectionError):
        return


def _prepare(renderer: Any) -> None:
    """Load what a renderer draws with."""
    from atlas.render import drawing

    with suppress(Exception):  # what can't be loaded now fails again, and is reported, when something is to be drawn
        drawing.prepare(renderer)


def _outcome(task: Task) -> Drawn | str | OSError:
    """Draw a plate, or say in a sentence why it can't be."""
    try:
        return task.draw()
    except OSError as error:
        return error
    except AtlasError as error:
        return str(error)
    except Exception as error:  # noqa: BLE001  one figure's failure must not stop the others; it is reported
        return f"{type(error).__name__}: {error}"
