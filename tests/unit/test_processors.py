"""What is promised holds on every kind of processor: OpenBLAS multiplies matrices in another way on each."""

import math
import os
import subprocess
import sys
from pathlib import Path

import pytest

from atlas.study.stress import PROCESSORS, PROMISES, SHORT, as_on, read_record, record_name

OTHERS = pytest.mark.parametrize("processor", ["Prescott", "Haswell"])
"""Without a fused multiply-add and with one; the machine's own kind is what all other tests run on."""


@OTHERS
def test_kernels_and_balls_agree_as_on_another_processor(processor: str) -> None:
    """The tests of agreement at the defaults of every family pass there too, but for three moments, which is slow."""
    assert processor in PROCESSORS
    words = [
        "-m",
        "pytest",
        "-n",
        "0",
        "-k",
        "agree and not asymmetric",
        str(Path(__file__).with_name("test_families.py")),
    ]
    environment = os.environ | {"OPENBLAS_CORETYPE": processor}
    found = subprocess.run([sys.executable, *words], env=environment, capture_output=True, text=True, check=False)
    assert found.returncode == 0, found.stdout


@OTHERS
def test_extreme_motions_keep_the_promises_as_on_another_processor(processor: str) -> None:
    """One motion of every regime keeps them, and the worst errors on record."""
    found, record = as_on(processor, 1, SHORT[1]), read_record()
    assert found
    assert [w for w in found if w.ulps > min(PROMISES.get(w.quantity, math.inf), record[record_name(w)])] == []
