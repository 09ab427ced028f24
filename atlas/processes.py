"""Worker processes, where the system lets us have any."""

import os
import sys
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from signal import SIG_BLOCK, SIG_DFL, SIG_SETMASK, SIGHUP, SIGINT, SIGTERM, getsignal, pthread_sigmask, signal
from threading import Thread, Timer, current_thread, main_thread
from typing import Any

SAFE = "PYTHONSAFEPATH"
"""As the option -P of Python, which a process inherits."""
ENDING = (SIGINT, SIGTERM, SIGHUP)
"""Signals that end a command in order."""
PATIENCE = 1.0
"""Seconds for which calls in progress are waited for after an error or Ctrl-C, before their processes are ended."""
DRAWING = "atlas.book.building.loaded"
"""Module that imports the libraries that draw figures."""


def pool(workers: int, begin: Callable[[], Any] | None = None, context: str = "spawn") -> ProcessPoolExecutor | None:
    """Return an executor with `workers` processes, each of which calls `begin` (if given) before its first work.

    `context` is the start method of multiprocessing. A worker ends with its parent, and SIGINT is blocked in it:
    the parent alone handles Ctrl-C. Leaving the executor's `with` block cancels the calls that have not begun.
    Return None where the system has no semaphores, as with a /dev/shm that cannot be written: then do the work in
    this process.
    """
    from multiprocessing import get_context

    try:
        with _as_worker():
            return _Pool(workers, get_context(context), _begin, (begin,))
    except (OSError, ImportError, NotImplementedError):
        return None


def prepare(module: str) -> str:
    """Start multiprocessing's fork server, which imports `module` for its workers; return the start method for `pool`.

    That is "forkserver"; or "spawn" where the server cannot be started, as without a folder for its socket: then
    each worker imports the module itself.
    """
    from multiprocessing import forkserver

    try:
        with _as_worker():
            forkserver.set_forkserver_preload([module])
            forkserver.ensure_running()
    except (OSError, ImportError):
        return "spawn"
    return "forkserver"


def _begin(initializer: Callable[[], Any] | None) -> None:
    """Set up this worker process: default signal handlers, an end when its parent ends; then call `initializer`."""
    for number in ENDING:  # a fork has the handlers of the command line
        if callable(getsignal(number)):
            signal(number, SIG_DFL)
    Thread(target=_wait_for_parent, daemon=True).start()
    if initializer is not None:
        initializer()


def _wait_for_parent() -> None:
    from multiprocessing import parent_process

    parent = parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


class _Pool(ProcessPoolExecutor):
    """A ProcessPoolExecutor whose workers do not import the main program, which may lack a guard; see `pool`."""

    def submit(self, function: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Return the future of ``function(*args, **kwargs)`` in a worker, started if needed.

        Raises BrokenProcessPool if the fork server has ended.
        """
        try:
            with _as_worker():
                return super().submit(function, *args, **kwargs)
        except (EOFError, ConnectionError) as error:  # the process that it would be a fork of has ended
            raise BrokenProcessPool from error

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """End the workers, see ProcessPoolExecutor; of a broken pool all are killed first, since CPython would wait."""
        if self._broken:
            for process in list((self._processes or {}).values()):
                process.kill()
        super().shutdown(wait, cancel_futures=cancel_futures)

    def __exit__(self, fault: type[BaseException] | None, *_: object) -> None:
        """Cancel the calls that have not begun, and wait for the others; after an exception at most PATIENCE seconds.

        The executor's thread cancels these calls: `Future.cancel` called from here while a worker dies would stop
        that thread by an InvalidStateError, and the waiting would not end.
        """
        end = Timer(PATIENCE, self._kill, ([*(self._processes or {}).values()], vars(self)["_call_queue"]))
        if fault is not None:
            end.start()
        self.shutdown(cancel_futures=True)
        end.cancel()

    @staticmethod
    def _kill(running: Sequence[Any], calls: Any) -> None:
        """Kill the worker processes `running` in the midst of their calls, and leave the queue `calls` unread."""
        calls.cancel_join_thread()
        for process in running:
            process.kill()


@contextmanager
def _as_worker() -> Iterator[None]:
    """Context in which processes are started that do not import the main program and have SIGINT blocked."""
    from multiprocessing import resource_tracker

    with _without_main():
        resource_tracker.ensure_running()  # its start lets SIGINT through again
        with _without_interrupts():
            yield


@contextmanager
def _without_interrupts() -> Iterator[None]:
    """Context in which SIGINT is blocked, also in processes started meanwhile; other ENDING signals come at its end.

    A process that is half started when this one raises KeyboardInterrupt would print a traceback.
    """
    came, heeded = list[int](), dict[int, Callable[[int, Any], Any]]()
    if current_thread() is main_thread():
        heeded = {number: done for number in ENDING if callable(done := getsignal(number))}
    for number in heeded:
        signal(number, lambda number, _: came.append(number))
    before = pthread_sigmask(SIG_BLOCK, {SIGINT})
    try:
        yield
    finally:
        pthread_sigmask(SIG_SETMASK, before)
        for number, done in heeded.items():
            signal(number, done)
        for number in came:
            heeded[number](number, None)


@contextmanager
def _without_main() -> Iterator[None]:
    """Context in which a process that is started finds no file of the main program, and so does not import it.

    Nor does the process look for modules in the working folder, where a user may have a ``signal.py``, before it is
    told this process's module path.
    """
    main = sys.modules["__main__"]
    spec, file, safe = main.__spec__, getattr(main, "__file__", None), os.environ.get(SAFE)
    main.__spec__, main.__file__, os.environ[SAFE] = None, None, "1"
    try:
        yield
    finally:
        main.__spec__, main.__file__ = spec, file
        os.environ.pop(SAFE)
        if safe is not None:
            os.environ[SAFE] = safe
