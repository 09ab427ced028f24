"""``python -m atlas`` and the program ``atlas``: the command line, and the signals that end it."""

import _signal as signal  # type: ignore[import-not-found]
import os
import sys
from types import FrameType

import atlas  # noqa: F401  lets Ctrl-C end the process at once while the imports below run

signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})  # the program of a checkout blocks it while Python starts
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # matrices are small: more threads double a fit's processor time
os.environ.setdefault("ARROW_DEFAULT_MEMORY_POOL", "system")  # pyarrow's own pool holds a third more for Parquet

from atlas.cli import main as run  # noqa: E402

ENDING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
"""Signals that end a command in order, unless the process that started it had them ignored."""


DELAY, delays = 0.001, iter(range(2000))
"""Seconds for which a signal waits while a module is loaded, and how often at most."""


def interrupt(number: int, frame: FrameType | None) -> None:
    """Raise KeyboardInterrupt with the number of the signal: a signal handler.

    While a module is loaded, code of a library might catch the exception: the signal is then sent again after DELAY
    seconds, at most 2000 times.
    """
    while frame is not None and "importlib" not in frame.f_code.co_filename:
        frame = frame.f_back
    if frame is None or next(delays, None) is None:
        raise KeyboardInterrupt(number)
    signal.signal(signal.SIGALRM, lambda *_: signal.raise_signal(number))
    signal.setitimer(signal.ITIMER_REAL, DELAY)


def main() -> None:
    """Run the command line; a signal of ENDING raises KeyboardInterrupt in it, and the exit status is 128 + its number.

    If Python was told to read file names in ASCII, the program is started again in UTF-8.
    """
    if os.environ.get("PYTHONUTF8") == "0" and sys.getfilesystemencoding() == "ascii":
        os.environ["PYTHONUTF8"] = "1"  # a name with a letter like é would have no text
        os.execv(sys.executable, sys.orig_argv)  # noqa: S606  without a shell
    heeded = [number for number in ENDING if signal.getsignal(number) is signal.SIG_DFL]
    try:
        for number in heeded:
            signal.signal(number, interrupt)
        run()
    except KeyboardInterrupt as error:  # in the first or last instructions of the command line
        sys.exit(128 + error.args[0])
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        for number in heeded:
            signal.signal(number, signal.SIG_DFL)


if __name__ == "__main__":
    main()
