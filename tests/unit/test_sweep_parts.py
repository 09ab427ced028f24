"""The parts of a sweep: kept, taken up, made again where they are damaged, and never anybody else's."""

import os
import signal
import subprocess
import sys
import time
from concurrent.futures import CancelledError, Future, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from tests_support import names

import atlas
from atlas.cli.app import atlas as program
from atlas.errors import AtlasError
from atlas.sweeps import run, store
from atlas.sweeps.plan import MAX_ROWS, Plan
from atlas.sweeps.store import Table

GRID = {"ratio": np.linspace(0.1, 2, 7), "B2": 1.0, "B3": [0.5, 1.5], "omega2": np.linspace(-0.9, 3, 11)}
NAMES = ("omega3", "k", "phi", "case", "R12")
ROWS = Plan.rows
STARTS = list(range(0, 154, 20))


class Stopped(BaseException):
    """The signal that ends a sweep in the middle."""


def sweep(out: Path | str, **options: Any) -> Any:
    """Sweep the grid in parts of 20 rows."""
    return atlas.sweep("elementary", GRID, NAMES, out, **({"rows": 20, "jobs": 1} | options))


def starts_of(monkeypatch: pytest.MonkeyPatch, stop: int | None = None) -> list[int]:
    """Return a list that gets the first rows of the parts that are made from now on; `stop` of them are."""
    starts: list[int] = []

    def counted(plan: Plan, start: int = 0, end: int | None = None) -> Any:
        if len(starts) == stop:
            raise Stopped
        starts.append(plan.first_row + start)
        return ROWS(plan, start, end)

    monkeypatch.setattr(Plan, "rows", counted)
    return starts


def stopped(out: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Sweep until three parts are kept, and return their folder."""
    starts = starts_of(monkeypatch, 3)
    with pytest.raises(Stopped):
        sweep(f"{out}/" if out.suffix == ".parquet" else out)
    assert starts == STARTS[:3]
    assert not out.exists()
    return out.with_name(f"{out.name}.parts")


@pytest.fixture(scope="module")
def table_bytes(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """Return the table of one go."""
    out = tmp_path_factory.mktemp("whole") / "t.csv"
    sweep(out)
    return out.read_bytes()


def test_a_stopped_sweep_resumes(tmp_path: Path, table_bytes: bytes, monkeypatch: pytest.MonkeyPatch) -> None:
    """Parts that were kept are not computed again, no row is lost or doubled, and nothing is left beside the table."""
    stopped(tmp_path / "t.csv", monkeypatch)
    starts = starts_of(monkeypatch)
    sweep(tmp_path / "t.csv")
    assert starts == STARTS[3:]
    assert (tmp_path / "t.csv").read_bytes() == table_bytes
    assert names(tmp_path) == ["t.csv"]


def test_any_rows_agree_with_the_table() -> None:
    """A part that is sent gives the rows of the whole."""
    for listed in (False, True):
        parameters = GRID if not listed else {name: np.resize(x, 154) for name, x in GRID.items()}
        plan = Plan.of("elementary", parameters, ["k"], listed=listed)
        table = plan.rows()
        for start, stop in [(0, 154), (0, 1), (153, 154), (21, 23), (22, 44), (5, 90), (11, 12), (100, 120)]:
            for name, column in plan.list_of(start, stop).rows(0, stop - start).items():
                assert np.array_equal(column, table[name][start:stop])


@pytest.mark.parametrize("kind", ["csv", "npz", "parquet"])
@pytest.mark.parametrize(
    "damage",
    [
        lambda file: file.write_bytes(file.read_bytes()[:-7]),
        lambda file: file.write_bytes(b""),
        lambda file: file.write_bytes(file.read_bytes().replace(b"1", b"2", 1)),
        lambda file: file.unlink(),
    ],
    ids=["cut", "emptied", "altered", "gone"],
)
def test_a_damaged_part_is_made_again(
    tmp_path: Path, table_bytes: bytes, monkeypatch: pytest.MonkeyPatch, damage: Any, kind: str
) -> None:
    """A part whose content is not that of its name is no part: the table is that of an undisturbed sweep."""
    if kind == "parquet":
        pytest.importorskip("pyarrow")
    out = tmp_path / f"t.{kind}"
    parts_folder = stopped(out, monkeypatch)
    damage(sorted(parts_folder.iterdir())[1])
    starts = starts_of(monkeypatch)
    sweep(f"{out}/" if kind == "parquet" else out)
    assert starts == [STARTS[1], *STARTS[3:]]
    if kind == "csv":
        assert out.read_bytes() == table_bytes


def test_parts_under_wrong_names_are_not_taken(
    tmp_path: Path, table_bytes: bytes, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A part named as if it held other rows or were of another sweep, rows twice, or between others: one of each."""
    for rows in ("000000000020-000000000040", "000000000030-000000000050", "000000000000-000000000154"):
        parts_folder = stopped(tmp_path / "t.csv", monkeypatch)
        part_first, second, _ = sorted(parts_folder.iterdir())
        second.unlink()
        (parts_folder / f"part-{rows}-{part_first.name[31:]}").write_bytes(part_first.read_bytes())
        (parts_folder / f"{part_first.name[:31]}{'0' * 16}{part_first.name[47:]}").write_bytes(part_first.read_bytes())
        starts_of(monkeypatch)
        sweep(tmp_path / "t.csv")
        assert (tmp_path / "t.csv").read_bytes() == table_bytes
        assert names(tmp_path) == ["t.csv"]
        (tmp_path / "t.csv").unlink()


def test_rows_that_are_in_two_parts_are_taken_once(
    tmp_path: Path, table_bytes: bytes, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A worker that nobody waited for may leave a part whose rows are in others: the table has each row once."""
    parts_folder = stopped(tmp_path / "t.csv", monkeypatch)
    table = Table(tmp_path / "t.csv", next(parts_folder.iterdir()).name.split("-")[3])
    monkeypatch.setattr(Plan, "rows", ROWS)
    with table.hold():
        for start, stop in ((0, 30), (10, 45), (130, 154)):
            run.make(Plan.of("elementary", GRID, NAMES), start, stop, table)
    sweep(tmp_path / "t.csv")
    assert (tmp_path / "t.csv").read_bytes() == table_bytes
    assert names(tmp_path) == ["t.csv"]


def test_parts_of_another_sweep_or_another_program_are_not_taken(
    tmp_path: Path, table_bytes: bytes, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Other parameters, another size of the parts or other code: all parts are made."""
    grid_other = GRID | {"B2": 2.0}
    stopped(tmp_path / "t.csv", monkeypatch)
    starts_of(monkeypatch)
    atlas.sweep("elementary", grid_other, NAMES, tmp_path / "t.csv", rows=20, jobs=1)
    atlas.sweep("elementary", grid_other, NAMES, tmp_path / "o.csv", rows=20, jobs=1)
    assert (tmp_path / "t.csv").read_bytes() == (tmp_path / "o.csv").read_bytes() != table_bytes
    (tmp_path / "t.csv").unlink()
    stopped(tmp_path / "t.csv", monkeypatch)
    starts = starts_of(monkeypatch)
    monkeypatch.setattr(run, "code", lambda: "another")
    sweep(tmp_path / "t.csv")
    assert starts == STARTS
    assert (tmp_path / "t.csv").read_bytes() == table_bytes


def test_the_key_of_a_part_depends_on_the_computing_code(monkeypatch: pytest.MonkeyPatch) -> None:
    """A changed kernel changes it, the drawing of a figure does not."""
    read, keys = Path.read_bytes, {run.code.__wrapped__()}
    changed = [
        "arithmetic/double_double",
        "motions/nutation/certified_general",
        "arithmetic/numbers",
        "sweeps/tables",
        "pictures/drawing/plane",
    ]
    for name in changed:
        monkeypatch.setattr(Path, "read_bytes", lambda path, name=name: read(path) + b"#" * (f"{name}.py" in str(path)))
        keys.add(run.code.__wrapped__())
    assert len(keys) == len(changed)


def foreign_key(folder: Path) -> None:
    """Make a folder as sweeps had it once, with more in it."""
    folder.mkdir()
    (folder / "key").write_text("mine")
    (folder / "precious").write_text("mine")


def link(folder: Path) -> None:
    """Make a link to a folder."""
    (folder.parent / "elsewhere").mkdir()
    folder.symlink_to(folder.parent / "elsewhere")


def planted(folder: Path) -> None:
    """Make a part that leads to another file."""
    folder.mkdir()
    (folder.parent / "precious").write_text("mine")
    (folder / "part-00000000.csv").symlink_to(folder.parent / "precious")


@pytest.mark.parametrize("plant", [foreign_key, link, planted, lambda folder: folder.write_text("mine")])
def test_files_of_no_sweep_are_refused_and_kept(tmp_path: Path, plant: Any) -> None:
    """A folder of the user's own, a symbolic link, a file: one line, status 2, and everything as it was."""
    plant(tmp_path / "t.csv.parts")
    before = {path: path.read_bytes() if path.is_file() else b"" for path in tmp_path.rglob("*")}
    with pytest.raises(AtlasError, match=r"which no sweep wrote|folder of its own"):
        sweep(tmp_path / "t.csv")
    assert {path: path.read_bytes() if path.is_file() else b"" for path in tmp_path.rglob("*")} == before


def test_a_user_file_among_the_parts_is_kept(
    tmp_path: Path, table_bytes: bytes, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It is named before the sweep goes on; one that is put there meanwhile is left where it is."""
    parts_folder = stopped(tmp_path / "t.csv", monkeypatch)
    (parts_folder / "notes.txt").write_text("mine")
    starts_of(monkeypatch)
    with pytest.raises(AtlasError, match=r"holds notes\.txt, which no sweep wrote"):
        sweep(tmp_path / "t.csv")
    assert len(list(parts_folder.iterdir())) == 4
    (parts_folder / "notes.txt").rename(parts_folder / ".notes")
    sweep(tmp_path / "t.csv")
    assert (tmp_path / "t.csv").read_bytes() == table_bytes
    assert [(path.name, path.read_text()) for path in parts_folder.iterdir()] == [(".notes", "mine")]


@pytest.mark.parametrize("name", ["t.csv", "t.parquet/"])
def test_a_sweep_stopped_in_its_last_steps_heals(tmp_path: Path, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Stopped before any file is deleted or moved, the next sweep, the same or another, ends with its table."""
    if name.endswith("/"):
        pytest.importorskip("pyarrow")
    done = []
    for step in ("delete", "move", "clear", "write"):
        real = getattr(store.Folder, step)

        def counted(self: Any, *arguments: Any, real: Any = real) -> None:
            if len(done) == limit:
                raise Stopped
            done.append(real)
            real(self, *arguments)

        monkeypatch.setattr(store.Folder, step, counted)
    limit, grid_other = 0, GRID | {"B2": 2.0}
    while True:
        done.clear()
        try:
            sweep(f"{tmp_path}/{name}", rows=80)
            break
        except Stopped:
            limit, before = 10**9, limit
            grid, rows = [(GRID, 80), (grid_other, 80), (GRID, 154)][before % 3]
            atlas.sweep("elementary", grid, NAMES, f"{tmp_path}/{name}", rows=rows, jobs=1)
            assert names(tmp_path) == [name.rstrip("/")]
            limit = before + 1
    assert limit > 3


class Lost(ThreadPoolExecutor):
    """An executor that loses its calls from the fifth on, as a client without its scheduler, or a pool that broke."""

    reason: BaseException = CancelledError()
    calls = 0

    def submit(self, *call: Any, **options: Any) -> Future[Any]:
        """Call, or give back a lost future."""
        self.calls += 1
        if self.calls < 5:
            return super().submit(*call, **options)
        future = Future[Any]()
        future.set_exception(self.reason)
        return future


@pytest.mark.parametrize("reason", [CancelledError(""), BrokenProcessPool("A process was terminated abruptly.")])
def test_lost_workers_are_reported_and_a_second_call_resumes(
    tmp_path: Path, table_bytes: bytes, reason: BaseException, monkeypatch: pytest.MonkeyPatch
) -> None:
    """In one sentence; finished parts are not made again."""
    message = str(reason).removesuffix(".") or "CancelledError"
    with Lost(1) as executor:
        executor.reason = reason
        with pytest.raises(
            AtlasError, match=rf"sudden end \({message}\); .* a call with a new executor or client goes on"
        ):
            sweep(tmp_path / "t.csv", executor=executor)
    starts = starts_of(monkeypatch)
    sweep(tmp_path / "t.csv")
    assert starts == STARTS[4:]
    assert (tmp_path / "t.csv").read_bytes() == table_bytes


def test_a_second_sweep_names_the_process_of_the_first(tmp_path: Path) -> None:
    """While one sweep writes a table another one ends with status 2, names its process, and leaves all as it is."""
    out = tmp_path / "t.csv"
    words = f"sweep ball --set inertia=1 --set larmor=1 --set m2=1 --set m3=1 --quantity gamma --out {out}"
    with Table(out, "").hold():
        run_two = subprocess.run(
            [sys.executable, "-m", "atlas", *words.split()], capture_output=True, text=True, check=False
        )
        assert run_two.returncode == 2
        assert f"(process {os.getpid()} on " in run_two.stderr
        assert run_two.stderr.count("\n") == 1
        with pytest.raises(AtlasError, match="another sweep"):
            sweep(out)
        assert (tmp_path / ".t.csv.lock").exists()
    assert not list(tmp_path.iterdir())
    assert CliRunner().invoke(program, words.split()).exit_code == 0


def test_the_lock_of_a_killed_sweep_is_no_hindrance_and_no_other_file_is_taken_for_one(tmp_path: Path) -> None:
    """Leftovers of a killed process count for nothing; a file of the user's own is not written over."""
    lock = tmp_path / ".t.csv.lock"
    kill = "import os, signal; from atlas.sweeps.store import Table\n"
    kill += f"with Table({str(tmp_path / 't.csv')!r}, '').hold(): os.kill(os.getpid(), signal.SIGKILL)"
    assert subprocess.run([sys.executable, "-c", kill], check=False).returncode == -signal.SIGKILL
    assert lock.exists()
    sweep(tmp_path / "t.csv")
    assert names(tmp_path) == ["t.csv"]
    lock.write_text("mine")
    with pytest.raises(AtlasError, match="something else"):
        sweep(tmp_path / "t.csv")
    assert lock.read_text() == "mine"


@pytest.mark.slow
def test_a_killed_sweep_resumes(tmp_path: Path) -> None:
    """After SIGKILL the same command ends with the table of a sweep that nobody disturbed."""
    arguments = [
        "sweep", "elementary", "--set", "ratio=0.1:2:40", "--set", "B2=1", "--set", "B3=0.2", "--set",
        "omega2=-0.9:3:50", "--quantity", "k", "--digits", "20", "--rows", "50", "-j", "1", "--out",
    ]  # fmt: skip
    start = [sys.executable, "-m", "atlas", *arguments]
    killed = subprocess.Popen([*start, tmp_path / "k.csv"])
    parts_folder = tmp_path / "k.csv.parts"
    while not list(parts_folder.glob("part-*")) and killed.poll() is None:
        time.sleep(0.01)
    killed.send_signal(signal.SIGKILL)
    killed.wait()
    assert list(parts_folder.glob("part-*"))
    assert not (tmp_path / "k.csv").exists()
    for name in ("k.csv", "a.csv"):
        assert subprocess.run([*start, tmp_path / name], check=False, capture_output=True).returncode == 0
    assert (tmp_path / "k.csv").read_bytes() == (tmp_path / "a.csv").read_bytes()


@pytest.mark.parametrize("digits", [None, 20])
@pytest.mark.parametrize("pace", [1e-4, 1e3, *(pytest.param(x, marks=pytest.mark.slow) for x in (1e-9, 0.05, 1.0))])
def test_a_table_is_divided_into_hundreds_of_parts(pace: float, digits: int | None) -> None:
    """A row that seems to take up to a thousand seconds: every row is in one part, few are lost with it."""
    for count in (1, 4097, 10**6, 10**8):
        plan = Plan.of("elementary", {"ratio": 1.5, "B2": 1, "B3": 2, "omega2": np.zeros(count)}, ["k"], digits=digits)
        spans, row_counts = run.Spans(plan, [(7, 9)] * (count > 9), None, 2), []
        for start, stop in spans:
            assert 0 < stop - start <= 2**18
            assert digits is None or len(row_counts) >= 64 or stop - start <= max(1, 2.0 / pace)
            row_counts.append((start, stop))
            spans.learn((start, stop), pace * (stop - start))
        rows = sorted(row_counts + [(7, 9)] * (count > 9))
        assert [start for start, _ in rows] == [0, *(stop for _, stop in rows[:-1])]
        assert rows[-1][1] == count
        assert len(rows) <= 1600


def test_a_sweep_resumes_with_other_part_sizes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Another measure of the time of a row, on a busier machine, does not begin it anew: missing parts are made."""
    parts_before = set[str]()
    for seconds in (1e-3, 5e-3, 1e-9):
        monkeypatch.setattr(run, "PART_SECONDS", seconds)
        starts_of(monkeypatch, 2)
        with pytest.raises(Stopped):
            atlas.sweep("elementary", GRID, ["k"], tmp_path / "t.csv", jobs=1, digits=20)
        parts_now = {path.name for path in (tmp_path / "t.csv.parts").iterdir()}
        assert parts_before < parts_now
        parts_before = parts_now


def test_a_table_beyond_all_disks_is_refused() -> None:
    """Ranges whose combinations nobody can keep end before any work is done."""
    many = np.linspace(1.0, 2.0, 10**5)
    with pytest.raises(AtlasError, match="1e\\+11"):
        Plan.of("elementary", GRID | {"B2": many, "omega2": many}, ["k"])
    assert MAX_ROWS == 10**11


def test_the_number_of_processes_follows_the_remaining_work() -> None:
    """Each process of a sweep has a second of work or more, and no more are started than were asked for."""
    rows = 100_000
    plan = Plan.of("elementary", {"ratio": 1.5, "B2": 1.0, "B3": 2.0, "omega2": np.linspace(0.5, 0.7, rows)}, ["k"])
    spans = run.Spans(plan, [], None, 8)
    for seconds, count in ((0.9, 0), (3.5, 3), (1000.0, 8)):
        spans.learn((0, rows), seconds)
        assert spans.processes == count
