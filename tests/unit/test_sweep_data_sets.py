"""Tables of a sweep as Parquet data sets, here, at an address, and on Dask."""

import gc
import json
import subprocess
import sys
import time
from collections.abc import Iterator
from concurrent.futures import Future, ProcessPoolExecutor, ThreadPoolExecutor
from contextlib import contextmanager
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests_support import dask_client

import atlas
from atlas.errors import AtlasError
from atlas.sweeps.plan import Plan

pytest.importorskip("pyarrow")

GRID = {"ratio": np.linspace(0.1, 2, 7), "B2": 1.0, "B3": [0.5, 1.5], "omega2": np.linspace(-0.9, 3, 11)}
NAMES = ("omega3", "k", "phi", "case", "R12")


def same(table_read: Any) -> None:
    """Check a data frame against the table."""
    table = atlas.sweep("elementary", GRID, NAMES)
    assert isinstance(table, dict)
    assert list(table_read) == list(table)
    for name, column in table.items():
        assert np.array_equal(table_read[name].to_numpy(), column), name


def test_a_data_set_is_read_as_one_table(tmp_path: Path) -> None:
    """Pandas and pyarrow read the files of all parts as the rows of the sweep, in their order."""
    pandas = pytest.importorskip("pandas")
    for jobs, name in ((1, "a.parquet/"), (2, "b.parquet/")):
        out = atlas.sweep("elementary", GRID, NAMES, f"{tmp_path}/{name}", rows=20, jobs=jobs)
        assert len(list(Path(str(out)).glob("part-*.parquet"))) == 8
        same(pandas.read_parquet(out))
    assert {path.name for path in tmp_path.iterdir()} == {"a.parquet", "b.parquet"}
    part_files = [sorted((tmp_path / name).glob("part-*")) for name in ("a.parquet", "b.parquet")]
    assert [path.read_bytes() for path in part_files[0]] == [path.read_bytes() for path in part_files[1]]


def test_a_new_data_set_replaces_only_an_old_one(tmp_path: Path) -> None:
    """Of an old table no file is left; a folder with other files is refused."""
    pandas = pytest.importorskip("pandas")
    out = tmp_path / "t.parquet"
    atlas.sweep("elementary", GRID | {"B2": 2.0}, NAMES, f"{out}/", rows=10, jobs=1)
    atlas.sweep("elementary", GRID, NAMES, out, rows=20, jobs=1)
    same(pandas.read_parquet(out))
    assert len(list(out.iterdir())) == 8
    atlas.sweep("elementary", GRID, NAMES, out, rows=40, jobs=1)
    same(pandas.read_parquet(out))
    assert len(list(out.iterdir())) == 4
    atlas.sweep("elementary", GRID, NAMES, out, rows=20, jobs=1)
    (out / "mine.parquet").touch()
    with pytest.raises(AtlasError, match=r"mine\.parquet, which no sweep wrote"):
        atlas.sweep("elementary", GRID, NAMES, out, rows=20, jobs=1)
    assert len(list(out.iterdir())) == 9


@pytest.mark.slow
def test_a_data_set_at_an_address_is_read_from_there() -> None:
    """Addresses that fsspec knows are written and read as a folder is, and nothing is left beside it."""
    fsspec, pandas = pytest.importorskip("fsspec"), pytest.importorskip("pandas")
    memory = fsspec.filesystem("memory")
    with ProcessPoolExecutor(1, get_context("spawn")) as pool:  # which has a memory of its own
        for B2, executor in ((2.0, pool), (1.0, None)):
            parameters, place = GRID | {"B2": B2}, "memory://sweeps/t.parquet"
            address = atlas.sweep("elementary", parameters, NAMES, place, rows=20, jobs=1, executor=executor)
            assert len(memory.ls("/sweeps/t.parquet")) == 8
    assert address == "memory://sweeps/t.parquet"
    same(
        pandas.concat(
            pandas.read_parquet(f"memory:/{name}") for name in sorted(memory.glob("/sweeps/t.parquet/*.parquet"))
        )
    )
    assert [name.rsplit("/", 1)[-1] for name in memory.ls("/sweeps", detail=False)] == ["t.parquet"]
    memory.rm("/sweeps", recursive=True)


@pytest.mark.filterwarnings("ignore:The inplace keyword")  # Dask reads so with pandas
def test_dask_workers_continue_a_stopped_data_set(tmp_path: Path) -> None:
    """No part that is there is made again, and Dask reads the folder as one table."""
    frames = pytest.importorskip("dask.dataframe")
    out, times_written = tmp_path / "t.parquet", dict[str, int]()

    def until_four(done: int, _: int) -> None:
        if done >= 80:
            folder = tmp_path / "t.parquet.parts"
            times_written.update({path.name: path.stat().st_mtime_ns for path in sorted(folder.iterdir())[:4]})
            raise KeyboardInterrupt

    with dask_client(2) as client:
        with pytest.raises(KeyboardInterrupt):
            atlas.sweep("elementary", GRID, NAMES, f"{out}/", rows=20, executor=client, progress=until_four)
        assert not out.exists()
        atlas.sweep("elementary", GRID, NAMES, f"{out}/", rows=20, executor=client)
    same(frames.read_parquet(out).compute(scheduler="synchronous"))
    assert {name: (out / name).stat().st_mtime_ns for name in times_written} == times_written
    assert [path.name for path in tmp_path.iterdir()] == ["t.parquet"]


@pytest.mark.parametrize("out", ["t.npz", "t.parquet/"])
def test_dask_keeps_no_parameters_of_parts_that_are_done(tmp_path: Path, out: str) -> None:
    """It keeps its last messages, which would be the whole last axis in each: 300 MB of a client at 1e8 rows."""

    def plans() -> int:
        gc.collect()
        return sum(type(x) is Plan for x in gc.get_objects())

    before = plans()
    with dask_client(1) as client:
        atlas.sweep("elementary", GRID, NAMES, f"{tmp_path}/{out}", rows=8, executor=client)
        assert plans() < before + 5


@contextmanager
def scheduler_and_worker(folder: Path) -> Iterator[tuple[Any, str]]:
    """Give a scheduler of Dask in a process of its own, with a worker, and its address."""
    file = folder / "scheduler.json"
    begin = [sys.executable, "-m"]
    common = ["--scheduler-file", str(file), "--no-dashboard"]
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    with (
        subprocess.Popen([*begin, "distributed.cli.dask_scheduler", "--port", "0", *common], **quiet) as scheduler,
        subprocess.Popen([*begin, "distributed.cli.dask_worker", "--no-nanny", *common], **quiet) as worker,
    ):
        try:
            while not file.exists() or not file.read_text():
                time.sleep(0.05)
            yield scheduler, json.loads(file.read_text())["address"]
        finally:
            scheduler.kill()
            worker.kill()


def test_a_client_closed_without_a_result_is_reported(tmp_path: Path) -> None:
    """As a Dask client does whose scheduler is lost while a result is on its way."""

    class Client:
        status = "running"

        def ncores(self) -> dict[str, int]:
            return {"worker": 1}

        def get_executor(self, **_: Any) -> "Client":
            return self

        def submit(self, *_: Any, **__: Any) -> Future[Any]:
            self.status = "closed"
            return Future()

    with pytest.raises(AtlasError, match=r"sudden end .the client is closed.; .* a new executor or client goes on"):
        atlas.sweep("elementary", GRID, NAMES, tmp_path / "t.csv", rows=8, executor=Client())


@pytest.mark.slow
def test_a_lost_scheduler_is_reported_and_another_client_continues(tmp_path: Path) -> None:
    """Lost in the midst of the table, and before it: one sentence each, and no part is made again."""
    distributed = pytest.importorskip("distributed")
    out, rows_done = tmp_path / "t.csv", list[int]()

    def lose(done: int, _: int) -> None:
        rows_done.append(done)
        if len(rows_done) == 3:
            scheduler.kill()

    message = "came to a sudden end .*a call with a new executor or client goes on"
    with scheduler_and_worker(tmp_path) as (scheduler, address), distributed.Client(address, timeout=5) as client:
        for _ in range(2):  # at the second call the scheduler is gone
            with pytest.raises(AtlasError, match=message):
                atlas.sweep("elementary", GRID, NAMES, out, rows=8, executor=client, progress=lose)
    with dask_client(1) as client:
        client.close()
        with pytest.raises(AtlasError, match=message):
            atlas.sweep("elementary", GRID, NAMES, out, rows=8, executor=client)
    with ThreadPoolExecutor(1) as ended:
        ended.shutdown()
        with pytest.raises(AtlasError, match=message):
            atlas.sweep("elementary", GRID, NAMES, out, rows=8, executor=ended)
    rows_first = list[int]()
    atlas.sweep("elementary", GRID, NAMES, out, rows=8, progress=lambda done, _: rows_first.append(done))
    assert rows_first[0] > 8 * 3
    assert out.read_bytes() == atlas.sweep("elementary", GRID, NAMES, tmp_path / "u.csv").read_bytes()
