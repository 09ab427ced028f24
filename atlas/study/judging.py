"""What every judge needs: the accuracy of the truth, the words for an input, the record of refusals."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
from flint import ctx, fmpq

from atlas.core.body import SymmetricBody
from atlas.core.inputs import FloatArray
from atlas.errors import AtlasError
from atlas.study import hostile
from atlas.study.ulps import ONE, Refusal, Tally

BITS = 80
"""Relative accuracy of the truth: a 2^-27th of a double's."""


@contextmanager
def judging(tally: Tally, quantity: str, regime: str, inputs: Any) -> Iterator[None]:
    """Judge at the precision of the truth, and keep what a kernel says when it will not answer."""
    try:
        with ctx.workprec(BITS + 16):
            yield
    except AtlasError as reason:
        tally.refusals.append(Refusal(quantity, regime, str(reason), inputs))


def described(record: Any) -> dict[str, Any]:
    """Return an input without its times, as hexadecimal text."""
    return {
        name: [x.hex() for x in value] if isinstance(value, tuple) else value.hex()
        for name, value in vars(record).items()
        if name != "times" and value is not None
    }


def with_more(inputs: dict[str, Any], **more: Any) -> Callable[[int], dict[str, Any]]:
    """Return the description of an input with more of it, whichever of the values was the worst."""
    return lambda _: inputs | more


def rigidity(R: FloatArray) -> tuple[list[float], list[float]]:
    """Return by how much R^T R and det R of matrices (m, 3, 3) differ from 1, in ulps of 1, in extended precision."""
    long = R.astype(np.longdouble)
    defect = np.abs(np.swapaxes(long, 1, 2) @ long - np.eye(3, dtype=np.longdouble)).max(axis=(1, 2))
    determinant = np.abs(np.einsum("ni,ni->n", long[:, 0], np.cross(long[:, 1], long[:, 2])) - 1)
    return (defect / ONE).astype(float).tolist(), (determinant / ONE).astype(float).tolist()


def ratio_of(motion: hostile.Motion) -> Any:
    """Return the float I where I2 = 1, and a body otherwise."""
    return motion.I3 if motion.I2 == 1.0 else SymmetricBody(motion.I2, motion.I3)


def exact_ratio(motion: hostile.Motion) -> fmpq:
    """Return I3/I2 as the rational number that it is."""
    return fmpq(*motion.I3.as_integer_ratio()) / fmpq(*motion.I2.as_integer_ratio())
