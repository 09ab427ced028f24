"""Small things that several test files need."""

import math
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from atlas.files import WRITTEN
from atlas.motions.register import FAMILIES
from atlas.trial.ledger import EQUATIONS
from atlas.trial.proofs import recorded
from atlas.trial.proofs.verdict import Verdict


def names(folder: Path) -> list[str]:
    """Return the names in a folder, without the list of written files."""
    return sorted(path.name for path in folder.iterdir() if path.name != WRITTEN)


@contextmanager
def dask_client(workers: int) -> Iterator[Any]:
    """Give a client of a local cluster of Dask, in threads of this process; skip the test where there is no Dask."""
    distributed = pytest.importorskip("distributed")
    place = {"processes": False, "dashboard_address": "127.0.0.1:0"}
    with (
        distributed.LocalCluster(n_workers=workers, threads_per_worker=1, **place) as cluster,
        distributed.Client(cluster) as client,
    ):
        yield client


def ulps_apart(computed: float, certified: str, size: float) -> float:
    """Return the distance of a float from a decimal text, in units in the last place of a number of that size."""
    if size == 0:
        return 0.0 if computed == 0 else math.inf
    return abs(float(Fraction(computed) - Fraction(certified))) / math.ulp(size)


def stale(records: Mapping[str, Verdict]) -> list[str]:
    """Return the names of the ledger without a record, or whose proof has changed since it was recorded."""
    return [name for name in EQUATIONS if name not in records or records[name].source != recorded.source(name)]


@contextmanager
def few_figures(**figures_of: str) -> Iterator[None]:
    """Leave each of these families one figure on its pages, for each takes half a second."""
    figures_before = {name: FAMILIES[name].figures for name in figures_of}
    for name, figure in figures_of.items():
        object.__setattr__(FAMILIES[name], "figures", (figure,))
    yield
    for name, figures in figures_before.items():
        object.__setattr__(FAMILIES[name], "figures", figures)
