"""Extreme values, and the law of every answer: numbers, or one line with the reason."""

import math
import os
import signal
import subprocess
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
from hypothesis import settings
from hypothesis import strategies as st

from atlas.errors import AtlasError

EXAMPLES = int(os.environ.get("FUZZ_EXAMPLES", "0"))
"""Cases in all, shared out among the tests; without it the few of `make test`."""

SECONDS = int(os.environ.get("FUZZ_SECONDS", "60"))
"""Of the processor, after which a call hangs: a busy machine makes none hang."""

Process = subprocess.Popen[str]


def ended(process: Process) -> tuple[int, str]:
    """Return the exit status of a command and its message."""
    message = process.communicate()[1]
    return process.returncode, message


SPECIAL = [0.0, -0.0, 1.0, -1.0, 2.0, 0.5, 1.5, -2.0, math.nextafter(1.0, 2.0), math.nextafter(-1.0, 0.0), math.pi]
FAR = [
    1e140,
    -1e-140,
    1e160,
    -1e160,
    1e200,
    1e-200,
    1e308,
    -1e308,
    5e-324,
    2.2250738585072014e-308,
    2.0**50,
    -(2.0**60),
]

numbers = st.one_of(
    st.sampled_from(SPECIAL),
    st.sampled_from(SPECIAL + FAR),
    st.floats(-10, 10),
    st.floats(allow_nan=False, allow_infinity=False),
)
no_numbers = st.sampled_from(
    [math.nan, math.inf, -math.inf, None, "1", b"1", True, 1j, [], {}, object, "x" * 5000, 10**400, [[1.0, 2.0], [3.0]]]
)
ratios = st.one_of(st.sampled_from([1.0, 2.0, 0.5, 1.5]), st.floats(1e-300, 2.0), numbers)


def share(fraction: float, few: int) -> Any:
    """Return settings for a test that gets this part of all examples, or a few."""
    return settings(max_examples=max(1, round(EXAMPLES * fraction)) if EXAMPLES else few)


def arrays(elements: Any) -> Any:
    """Return numbers, or arrays of them of shapes that may meet or not."""
    shapes = st.sampled_from([(2,), (3,), (2, 1), (1, 3), (0,), (1,)])
    filled = shapes.flatmap(
        lambda shape: st.lists(elements, min_size=math.prod(shape), max_size=math.prod(shape)).map(
            lambda values: np.array(values, dtype=float).reshape(shape)
        )
    )
    masked = filled.map(lambda array: np.ma.masked_array(array, np.arange(array.size).reshape(array.shape) % 2 == 0))
    return st.one_of(elements, elements, elements, filled, masked)


class Hang(BaseException):
    """The signal that ends a call that hangs; no Exception, which the program would turn into a line."""


@contextmanager
def watched() -> Iterator[None]:
    """Fail where something runs for longer than SECONDS."""

    def alarm(_signal: int, _frame: Any) -> None:
        raise Hang

    before = signal.signal(signal.SIGPROF, alarm)
    signal.setitimer(signal.ITIMER_PROF, SECONDS)
    try:
        yield
    except Hang as hang:
        raise AssertionError(f"ran for more than {SECONDS} s of the processor") from hang
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        signal.signal(signal.SIGPROF, before)


def answered(call: Callable[[], Any], place: str = "") -> Any:
    """Return the answer of a call, or None for an error of one line; never NaN."""
    try:
        with watched():
            answer = call()
    except AtlasError as reason:
        sentence = str(reason)
        assert sentence.strip(), place
        assert "\n" not in sentence, place
        assert "Error" not in sentence, (place, sentence)
        assert len(sentence) < 600, (place, sentence)
        return None
    for value in (
        answer if isinstance(answer, tuple | list) else answer.values() if isinstance(answer, dict) else [answer]
    ):
        array = np.asarray(value)
        if array.dtype.kind == "f":
            assert not np.isnan(array).any(), (place, answer)
    return answer
