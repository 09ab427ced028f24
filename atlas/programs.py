"""Programs that are run to their end: they have limits, and end with this process, however that ends."""

import ctypes
import os
import signal
import subprocess
import sys
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from typing import Any

PATIENCE_FACTOR = 20
"""How much longer than its seconds of a processor a program may take, on a machine that has other things to do."""

PR_SET_PDEATHSIG = 1
"""The option of Linux' prctl(2) that names the signal which a process gets when its parent ends."""

_LIBC = ctypes.CDLL(None) if sys.platform == "linux" else None


LOCALE = "en_US.UTF-8" if sys.platform == "darwin" else "C.UTF-8"
"""The locale of a program that is run: names of files and texts are UTF-8, whatever the user's locale is."""


def environment() -> dict[str, str]:
    """Return this process's environment variables by name, with LC_ALL set to a UTF-8 locale, for a child program."""
    return os.environ | {"LC_ALL": LOCALE}


def run(command: Sequence[str], seconds: int, text: str = "", **options: Any) -> subprocess.CompletedProcess[str]:
    """Run a program with `text` on its standard input, in a UTF-8 locale; return its CompletedProcess, output as text.

    `options` are further arguments of subprocess.run. The program is killed when this process ends. Raises
    TimeoutExpired after `seconds` of processor time, or PATIENCE_FACTOR times that of waiting. A failure is seen by
    its return code only.
    """
    started = partial(_bound, os.getpid(), seconds)
    with ThreadPoolExecutor(1) as thread:  # an interrupt in the midst of a fork would leave locks held for ever
        call = thread.submit(
            lambda: subprocess.run(  # noqa: S603  each caller runs a program of ours
                command,
                input=text,
                capture_output=True,
                encoding="utf-8",
                check=False,
                timeout=PATIENCE_FACTOR * seconds,
                preexec_fn=started if os.name == "posix" else None,
                **{"env": environment()} | options,
            )
        )
        answer = call.result()
    if -answer.returncode in {signal.SIGXCPU, signal.SIGKILL} if os.name == "posix" else False:
        raise subprocess.TimeoutExpired(command, seconds)
    return answer


def _bound(parent: int, seconds: int) -> None:
    """Limit the calling child process, before it runs a program, to `seconds` of processor time.

    On Linux it is also killed when the process with number `parent` ends.
    """
    import resource

    hard = resource.getrlimit(resource.RLIMIT_CPU)[1]
    limit = seconds if hard == resource.RLIM_INFINITY else min(seconds, hard)
    resource.setrlimit(resource.RLIMIT_CPU, (limit, hard))
    if _LIBC is not None:
        _LIBC.prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
        if os.getppid() != parent:
            os._exit(1)
