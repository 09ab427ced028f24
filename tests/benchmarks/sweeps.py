"""Rows a second of a sweep against its workers, its memory, and the same table through Dask.

The question: how long does a table of ten million motions take, on one process, on two, on Dask's workers?

Each sweep is a process of its own, `python -m benchmarks.sweeps`, which prints seconds, those of the processors, the
largest memory of the sweeping process and of its largest worker, and the digest of the table: the same bytes wherever
it was computed. On a machine with other work two processes may get no more of it than one does: compare the processors'
seconds then.
"""

import argparse
import hashlib
import json
import resource
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path
from time import perf_counter
from typing import Any

import atlas

GENERAL, OF_FIELD = ("kind", "period", "spin_per_period", "R13"), ("ratio", "B3", "omega2")
TOP = {"I2": 1.0, "k2": 1.0, "n2": 0.6, "n3": 0.8, "linear": 1.5, "t": 7.0, "omega1": 0.3, "omega3": 0.2}
FAMILIES = {
    "elementary": ({"B2": 1.0, "t": 7.0}, OF_FIELD, ("omega3", "k", "phi", "R13")),
    "general": ({"B2": 1.0, "t": 7.0, "omega1": 0.3, "omega3": 0.2}, OF_FIELD, GENERAL),
    "top": (TOP, ("I3", "k3", "omega2"), GENERAL),
}
"""A family's constant parameters, swept parameters and computed quantities."""
RATIOS, FIELDS = 20, 50


def swept(family: str, rows: int, jobs: int, dask: bool) -> dict[str, Any]:
    """Sweep at least so many rows in this process and return the seconds."""
    count = -(-rows // (RATIOS * FIELDS))
    same, names, quantities = FAMILIES[family]
    values = _even(0.1, 2.0, RATIOS), _even(0.1, 3.0, FIELDS), _even(-0.9, 3.0, count)
    parameters = dict(zip(names, values, strict=True))
    with tempfile.TemporaryDirectory() as folder, _executor(jobs, dask) as executor:
        out, start = Path(folder) / "table.npz", perf_counter()
        atlas.sweep(family, same | parameters, quantities, out, jobs=jobs, executor=executor)
        seconds, digest = perf_counter() - start, hashlib.sha256()
        with out.open("rb") as file:
            while block := file.read(1 << 20):
                digest.update(block)
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    own_memory, largest = (who.ru_maxrss / 1024 for who in used)
    return {
        "rows": RATIOS * FIELDS * count,
        "seconds": seconds,
        "cpu": sum(who.ru_utime + who.ru_stime for who in used),
        "own": own_memory,
        "worker": largest,
        "digest": digest.hexdigest()[:12],
    }


@contextmanager
def _executor(jobs: int, dask: bool) -> Iterator[Any]:
    """Give a client of a local cluster of Dask, or nothing."""
    if not dask:
        yield None
        return
    from distributed import Client, LocalCluster

    with (
        LocalCluster(n_workers=jobs, threads_per_worker=1, processes=True, dashboard_address="127.0.0.1:0") as cluster,
        Client(cluster) as client,
    ):
        yield client


def _even(low: float, high: float, count: int) -> list[float]:
    return [low + (high - low) * i / max(count - 1, 1) for i in range(count)]


def main() -> None:
    """Measure each way in a process of its own, and print."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.sweeps", description=__doc__)
    parser.add_argument("--rows", type=int, default=10_000_000)
    parser.add_argument("--family", choices=FAMILIES, default="elementary")
    parser.add_argument("--way", nargs=2, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.way:
        print(json.dumps(swept(options.family, options.rows, int(options.way[0]), options.way[1] == "dask")))  # noqa: T201
        return
    ways = [("1", "alone"), ("2", "processes"), *([("2", "dask")] if find_spec("distributed") else [])]
    digests = set()
    for way in ways:
        command = [sys.executable, "-m", "benchmarks.sweeps", "--family", options.family]
        command += ["--rows", str(options.rows), "--way", *way]
        ended = subprocess.run(command, capture_output=True, text=True, check=True)
        answer = json.loads(ended.stdout.splitlines()[-1])
        digests.add(answer["digest"])
        print(  # noqa: T201  asked for
            f"{way[0]} {way[1]:10} {answer['rows']} rows in {answer['seconds']:6.1f} s, cpu {answer['cpu']:6.1f} s, "
            f"{answer['rows'] / answer['seconds']:9.0f} rows/s, {answer['own']:5.0f} MB, largest worker "
            f"{answer['worker']:5.0f} MB, {answer['digest']}",
            flush=True,
        )
    print("the same bytes" if len(digests) == 1 else "THE TABLES DIFFER")  # noqa: T201  the same
    sys.exit(len(digests) != 1)


if __name__ == "__main__":
    main()
