"""Worker processes, where the system lets us have any."""

import os
import sys
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from threading import Thread
from typing import Any

SAFE = "PYTHONSAFEPATH"
"""As the option -P of Python, which a process inherits."""
DRAWING = "atlas.build.loaded"
"""The module that loads what figures are drawn with."""


def pool(workers: int, begin: Callable[[], Any] | None = None, context: str = "spawn") -> ProcessPoolExecutor | None:
    """Return an executor with so many processes, each of which calls `begin` first.

    None where the system has no semaphores, as with a /dev/shm that can't be written: then the work is to be done here.
    """
    from multiprocessing import get_context

    try:
        with _without_main():
            return _Pool(workers, get_context(context), begin)
    except (OSError, ImportError, NotImplementedError):
        return None


def prepare(module: str) -> str:
    """Start multiprocessing's fork server, which imports a module for its workers; return the start method for `pool`.

    Where it can't be started, as without a folder for its socket, workers are spawned and import what they need.
    """
    from multiprocessing import forkserver, resource_tracker

    try:
        with _without_main():
            resource_tracker.ensure_running()
            forkserver.set_forkserver_preload([module])
            with _without_interrupts():
                forkserver.ensure_running()
    except (OSError, ImportError):
        return "spawn"
    return "forkserver"


def end_with_parent() -> None:
    """Let this process end as soon as the one that started it has ended, however that was."""
    Thread(target=_wait_for_parent, daemon=True).start()


def _wait_for_parent() -> None:
    from multiprocessing import parent_process

    parent = parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


class _Pool(ProcessPoolExecutor):
    """An executor whose processes do not run the main program: they need nothing of it, and it may lack a guard."""

    def submit(self, function: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Start a process if one is wanted, and hand over the call."""
        try:
            with _without_main():
                return super().submit(function, *args, **kwargs)
        except (EOFError, ConnectionError) as error:  # the process that it would be a fork of has ended
            raise BrokenProcessPool from error

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """End the processes; of a broken pool also one that was started while the others were ended (CPython waits)."""
        if self._broken:
            for process in list((self._processes or {}).values()):
                process.kill()
        super().shutdown(wait, cancel_futures=cancel_futures)


@contextmanager
def _without_interrupts() -> Iterator[None]:
    """Block SIGINT in a process that is started meanwhile: what Ctrl-C means is decided by this one."""
    from signal import SIG_BLOCK, SIG_SETMASK, SIGINT, pthread_sigmask

    before = pthread_sigmask(SIG_BLOCK, {SIGINT})
    try:
        yield
    finally:
        pthread_sigmask(SIG_SETMASK, before)


@contextmanager
def _without_main() -> Iterator[None]:
    """Let a process that is started meanwhile believe that the main program is no file.

    Nor does it look for modules in the working folder, where a user may have a ``signal.py``, before it is told the
    path of this one.
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
