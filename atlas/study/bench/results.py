"""What a benchmark run leaves behind: one JSON file with machine, versions, command, date and every pair measured.

Figures and pages are drawn from the stored file, never from a fresh run, so they rebuild the same.
"""

import platform
import re
from datetime import UTC, datetime
from pathlib import Path
from typing import Literal, TypeAlias

import msgspec

from atlas import __version__, files
from atlas.core.arithmetic.threads import processors
from atlas.errors import AtlasError
from atlas.libraries import release
from atlas.places import folder

FORMAT = 1
PEERS = ("numpy", "scipy", "sympy", "python-flint", "heyoka")
Status: TypeAlias = Literal["done", "failed", "timed out", "skipped"]


class Item(msgspec.Struct, frozen=True, forbid_unknown_fields=True, omit_defaults=True):
    """A row of the record; a key that it does not have is an error."""


class Machine(Item, frozen=True):
    """What ran: the processor's name, the cores this process may use, whether NumPy finds AVX-512, the system."""

    processor: str
    cores: int
    avx512: bool
    system: str


class Run(Item, frozen=True):
    """One method on one case up to one horizon: its largest error and its time, always both, or why there is none.

    ``error`` is the largest over all samples, ``seconds`` the time for all samples once the method is set up, and
    ``to_plain`` the median ratio to the plain NumPy formula, timed beside it.
    """

    case: str
    method: str
    horizon: float
    samples: int
    status: Status
    tolerance: float | None = None
    error: float | None = None
    seconds: float | None = None
    to_plain: float | None = None
    note: str = ""


class Setup(Item, frozen=True):
    """What a method costs once, before its first value: building, compiling, simplifying. Imports are not counted.

    ``seconds`` is the first time in the process, ``again`` the median of a few later ones, where they were measured.
    """

    case: str
    method: str
    status: Status
    tolerance: float | None = None
    seconds: float | None = None
    again: float | None = None
    note: str = ""


class Cost(Item, frozen=True):
    """Time for ``count`` rotation matrices: nanoseconds each, over filling the same memory, over the plain formula.

    ``error`` is the largest found among a few of them. All ratios are to one thread. ``to_times``, of a grid, is to
    `rotation` at the same times.
    """

    method: str
    count: int
    threads: int
    status: Status
    error: float | None = None
    nanoseconds: float | None = None
    to_fill: float | None = None
    to_plain: float | None = None
    to_times: float | None = None
    note: str = ""


class Rows(Item, frozen=True):
    """Nanoseconds a row for a quantity of ``count`` motions, and the largest error in ulps among a few of them."""

    quantity: str
    method: str
    count: int
    error: float
    nanoseconds: float
    to_plain: float


class ReferenceCheck(Item, frozen=True):
    """The reference on trial: its largest distance from a Taylor integration in ball arithmetic up to ``until``."""

    case: str
    until: float
    distance: float


class Results(Item, frozen=True):
    """One run of the benchmark."""

    format: int
    command: str
    date: str
    quick: bool
    elapsed: float
    machine: Machine
    versions: dict[str, str]
    parameters: dict[str, dict[str, float | list[float]]]
    checks: list[ReferenceCheck]
    runs: list[Run]
    setups: list[Setup]
    costs: list[Cost]
    rows: list[Rows] = []


def stored() -> Path:
    """Return where the record of the repository lies."""
    return folder("reports") / "data" / "bench.json"


def read(path: Path | None = None) -> Results:
    """Read a record, the repository's own by default; one that does not have the form is an AtlasError."""
    path = path or stored()
    try:
        return msgspec.json.decode(path.read_bytes(), type=Results)
    except FileNotFoundError as error:
        raise AtlasError(f"There is no benchmark record {path.name}: run atlas bench first.") from error
    except msgspec.MsgspecError as error:
        raise AtlasError(f"{path.name} is not a benchmark record: {error}.") from error


def write(record: Results, path: Path) -> None:
    """Write a record, a row a line, whole or not at all."""
    parts = []
    for name, value in msgspec.to_builtins(record).items():
        many = isinstance(value, list)
        rows = ",\n".join(f"  {msgspec.json.encode(item).decode()}" for item in value) if many else ""
        parts.append(f' "{name}": [\n{rows}\n ]' if many else f' "{name}": {msgspec.json.encode(value).decode()}')
    files.write(path, "{\n" + ",\n".join(parts) + "\n}\n")


def machine() -> Machine:
    """Describe this machine without its name."""
    import numpy as np

    found = np.show_config(mode="dicts")["SIMD Extensions"]
    extensions = [*found.get("baseline", ()), *found.get("found", ())]
    return Machine(
        processor=_processor(),
        cores=processors(),
        avx512=any(name == "X86_V4" or name.startswith("AVX512") for name in extensions),
        system=f"{platform.system()} {platform.machine()}",
    )


def versions() -> dict[str, str]:
    """Versions of Python, of the atlas and of every peer; one that is not installed is said to be absent."""
    found = {"python": platform.python_version(), "atlas": __version__}
    return found | {name: release(name) or "absent" for name in PEERS}


def today() -> str:
    """Return the date, in universal time."""
    return datetime.now(UTC).date().isoformat()


def said(error: Exception) -> str:
    """Return what a peer raised, in one line."""
    return " ".join(f"{type(error).__name__}: {error}".split())


def _processor() -> str:
    """Return the processor's name as Linux gives it, elsewhere as Python does."""
    info = Path("/proc/cpuinfo")
    match = re.search(r"^model name\s*:\s*(.+)$", info.read_text(), re.MULTILINE) if info.is_file() else None
    return match[1].strip() if match else platform.processor() or platform.machine()
