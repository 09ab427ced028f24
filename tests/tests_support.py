"""Small things that several test files need."""

import math
from collections.abc import Mapping
from fractions import Fraction
from pathlib import Path

from atlas.files import WRITTEN
from atlas.paper import EQUATIONS
from atlas.proof import recorded
from atlas.proof.verdict import Verdict


def names(folder: Path) -> list[str]:
    """Return the names in a folder, without the list of what was written there."""
    return sorted(path.name for path in folder.iterdir() if path.name != WRITTEN)


def ulps_apart(found: float, certified: str, size: float) -> float:
    """Return the distance of a float from a decimal text, in units in the last place of a number of that size."""
    if size == 0:
        return 0.0 if found == 0 else math.inf
    return abs(float(Fraction(found) - Fraction(certified))) / math.ulp(size)


def stale(records: Mapping[str, Verdict]) -> list[str]:
    """Return the names of the ledger without a record, or whose proof has changed since it was recorded."""
    return [name for name in EQUATIONS if name not in records or records[name].source != recorded.source(name)]
