"""Closed forms as other libraries have them: a product of turns about fixed axes, (85) and (28)."""

import ctypes
import os
import subprocess
import tempfile
from collections.abc import Sequence
from functools import reduce
from operator import mul
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np

from benchmarks.case import FloatArray, Solve

AxisAndRate: TypeAlias = tuple[tuple[float, float, float], float]
"""A unit vector and the frequency of the turn about it."""


def lambdified(turns: Sequence[AxisAndRate]) -> Solve:
    """Compile the product from SymPy, with common subexpressions taken out."""
    import sympy

    t = sympy.symbols("t", real=True)
    product = reduce(mul, (_symbolic(sympy, axis, frequency * t) for axis, frequency in turns))
    entries = sympy.lambdify(t, list(product), "numpy", cse=True)
    return lambda times: np.stack(entries(times), axis=-1).reshape(-1, 3, 3)


def composed(turns: Sequence[AxisAndRate]) -> Solve:
    """Compose SciPy's rotations."""
    from scipy.spatial.transform import Rotation

    rates = [frequency * np.array(axis) for axis, frequency in turns]

    def solve(times: FloatArray) -> FloatArray:
        return np.asarray(reduce(mul, (Rotation.from_rotvec(times[:, None] * rate) for rate in rates)).as_matrix())

    return solve


def compiled(constants: Sequence[float]) -> Solve:
    """Compile compiled.c for this machine: k and phi in two words each, and the components of the axis."""
    with tempfile.TemporaryDirectory() as folder:
        library = Path(folder) / "compiled.so"
        narrow = ["-mno-avx512f"] if "NPY_DISABLE_CPU_FEATURES" in os.environ else []  # as NumPy in this process
        flags = "-O3", "-march=native", "-fno-math-errno", "-fno-trapping-math", "-shared", "-fPIC", *narrow
        subprocess.run(["cc", *flags, str(Path(__file__).with_name("compiled.c")), "-lm", "-o", library], check=True)  # noqa: S607  whatever compiler there is
        rotations = ctypes.CDLL(str(library)).rotations
    words, floats = np.array(constants), np.ctypeslib.ndpointer(np.float64, flags="C")
    rotations.argtypes, rotations.restype = (floats, ctypes.c_size_t, floats, floats), None

    def solve(times: FloatArray) -> FloatArray:
        out = np.empty((len(times), 3, 3))
        rotations(times, len(times), words, out)
        return out

    return solve


def _symbolic(sympy: Any, axis: tuple[float, float, float], angle: Any) -> Any:
    """Return the matrix of a turn, by Rodrigues' formula."""
    x, y, z = axis
    n = sympy.Matrix(axis)
    hat = sympy.Matrix([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return sympy.cos(angle) * sympy.eye(3) + sympy.sin(angle) * hat + (1 - sympy.cos(angle)) * n * n.T
