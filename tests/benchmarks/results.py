"""Settings that a run measures beside the record, and the machine it ran on."""

import platform
import re
from datetime import UTC, datetime
from pathlib import Path

import msgspec
import numpy as np

from atlas import __version__, files
from atlas.arithmetic.machine import processors
from atlas.checking.benchmark import Item, Machine, Results, Status
from atlas.libraries import release

PEERS = ("numpy", "scipy", "sympy", "python-flint", "heyoka")

SCALARS, SURFACE, MATRIX = "omega3, k, phi of a curve", "quadric with its axes", "R at one time of each motion"
NUTATION, TURNED = "period, angles, moduli of each general motion", "R at one time of each general motion"
ANY, EVEN = "R of the general motion at any times", "R of the general motion on a grid"
SLOPES = "derivatives of R of the general motion in six parameters"
FITTED = "a fit of 500 attitudes, its error in standard errors"
FRESH = "R of the elementary motion in a fresh process"
ONE = {
    "elementary": ("R at one time of the elementary motion", 15.0),
    "general": ("R at one time of the general motion", 40.0),
    "asymmetric": ("R at one time of three moments", 120.0),
}
"""Quantities of many rows, of many matrices of one motion, of one matrix (with microseconds), and of what is made."""


class Setup(Item, frozen=True):
    """The seconds of a method before its first value: building, compiling, simplifying. Imports are not counted.

    ``seconds`` is the first time in the process, ``again`` the median of a few later ones, where they were measured.
    """

    case: str
    method: str
    status: Status
    tolerance: float | None = None
    seconds: float | None = None
    again: float | None = None
    note: str = ""


class Rows(Item, frozen=True):
    """Nanoseconds a row for a quantity of ``count`` motions, and the largest error in ulps among a few of them."""

    quantity: str
    method: str
    count: int
    error: float
    nanoseconds: float
    to_plain: float


def spread(count: int, few: int) -> list[int]:
    """Return a few indices, evenly from the first to the last."""
    return sorted({round(i) for i in np.linspace(0, count - 1, few).tolist()})


def machine() -> Machine:
    """Describe this machine without its name."""
    simd = np.show_config(mode="dicts")["SIMD Extensions"]
    extensions = [*simd.get("baseline", ()), *simd.get("found", ())]
    return Machine(
        processor=_processor(),
        cores=processors(),
        avx512=any(name == "X86_V4" or name.startswith("AVX512") for name in extensions),
        system=f"{platform.system()} {platform.machine()}",
    )


def versions() -> dict[str, str]:
    """Versions of Python, of the atlas and of every peer; one that is not installed is said to be absent."""
    return {"python": platform.python_version(), "atlas": __version__} | {
        name: release(name) or "absent" for name in PEERS
    }


def today() -> str:
    """Return the date, in universal time."""
    return datetime.now(UTC).date().isoformat()


def write(record: Results, path: Path) -> None:
    """Write a record, a row a line, whole or not at all."""
    items = []
    for name, value in msgspec.to_builtins(record).items():
        many = isinstance(value, list)
        rows = ",\n".join(f"  {msgspec.json.encode(item).decode()}" for item in value) if many else ""
        items.append(f' "{name}": [\n{rows}\n ]' if many else f' "{name}": {msgspec.json.encode(value).decode()}')
    files.write(path, "{\n" + ",\n".join(items) + "\n}\n")


def sentence(error: Exception) -> str:
    """Return a peer's error in one line."""
    return " ".join(f"{type(error).__name__}: {error}".split())


def _processor() -> str:
    """Return the processor's name as Linux gives it, elsewhere as Python does."""
    info = Path("/proc/cpuinfo")
    match = re.search(r"^model name\s*:\s*(.+)$", info.read_text(), re.MULTILINE) if info.is_file() else None
    return match[1].strip() if match else platform.processor() or platform.machine()
