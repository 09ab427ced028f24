"""What a table depends on, as a key: the sweep that is asked for, the code that computes it, and its libraries."""

import hashlib
import json
from functools import cache

import numpy as np

from atlas.libraries import release
from atlas.sources import PACKAGE, Sources, digest
from atlas.study.sweep.plan import Plan


def key(plan: Plan) -> str:
    """Return the digest of everything that the rows of a plan depend on."""
    told = [code(), plan.family, plan.quantities, plan.listed, plan.digits, list(plan.parameters)]
    found = hashlib.sha256(json.dumps(told).encode())
    for array in plan.parameters.values():
        found.update(np.ascontiguousarray(array).tobytes())
        found.update(b"|")
    return found.hexdigest()


@cache
def code() -> str:
    """Return the digest of what computes the rows and writes them: the code of this process, and its libraries."""
    computed = Sources().closure([PACKAGE / "study" / "sweep" / f"{name}.py" for name in ("plan", "tables")])
    return digest(computed, [release(name) for name in ("numpy", "scipy", "python-flint")])
