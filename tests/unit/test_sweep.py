import ast
import csv
import gc
import re
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from tests_support import dask_client, names

import atlas
from atlas.cli.app import atlas as program
from atlas.cli.app import main
from atlas.errors import DomainError
from atlas.motions.elementary.kernel import ElementaryMotion
from atlas.sweeps.families import FAMILIES, NAME
from atlas.sweeps.tables import csv_part

GRID = {"ratio": np.linspace(0.1, 2, 7), "B2": 1.0, "B3": [0.5, 1.5], "omega2": np.linspace(-0.9, 3, 11)}
NAMES = ("omega3", "k", "phi", "case", "R12")


def sweep(out: Path, **options: Any) -> bytes:
    """Sweep the grid in parts of 20 rows and return the bytes of the table."""
    atlas.sweep("elementary", GRID, NAMES, out, rows=20, **options)
    return out.read_bytes()


def test_a_grid_has_every_combination_once_and_its_quantities() -> None:
    """The last parameter varies fastest, and each row has the values of the motion of its parameters."""
    table = atlas.sweep("elementary", GRID, NAMES)
    assert list(table) == [*GRID, *NAMES]
    grid = np.meshgrid(*(np.atleast_1d(x) for x in GRID.values()), indexing="ij")
    for name, values in zip(GRID, grid, strict=True):
        assert np.array_equal(table[name], values.ravel())
    motion = ElementaryMotion(table["ratio"], (table["B2"], table["B3"]), table["omega2"])
    for name in ("omega3", "k", "phi", "case"):
        assert np.array_equal(table[name], getattr(motion, name))


def test_matrices_and_vectors_are_requested_by_one_name() -> None:
    """R is its nine entries, and Omega its three, in their order."""
    table = atlas.sweep(
        "elementary", {"ratio": 1.5, "B2": 1.0, "B3": 2.0, "omega2": 0.7, "t": [0.0, 2.0]}, ["Omega", "R"]
    )
    entries = [f"R{i}{j}" for i in "123" for j in "123"]
    assert list(table)[5:] == ["Omega1", "Omega2", "Omega3", *entries]
    R = ElementaryMotion(1.5, (1.0, 2.0), 0.7).rotation([0.0, 2.0])
    assert np.abs(np.column_stack([table[name] for name in entries]) - R.reshape(2, 9)).max() <= 8 * 2.0**-53


@pytest.mark.parametrize("suffix", [".csv", ".npz"])
def test_bytes_of_a_sweep_do_not_depend_on_its_processes(tmp_path: Path, suffix: str) -> None:
    """One process, two processes and threads of the user write the same file, and leave nothing beside it."""
    content = sweep(tmp_path / f"a{suffix}", jobs=1)
    assert sweep(tmp_path / f"b{suffix}", jobs=2) == content
    with ThreadPoolExecutor(2) as pool:
        assert sweep(tmp_path / f"c{suffix}", executor=pool) == content
    assert len(names(tmp_path)) == 3


@pytest.mark.slow
def test_dask_writes_the_same_bytes(tmp_path: Path) -> None:
    """A local cluster of two workers writes the bytes of the single process."""
    with dask_client(2) as client:
        assert sweep(tmp_path / "d.csv", executor=client) == sweep(tmp_path / "a.csv", jobs=1)


def plain(heading: str) -> list[str]:
    """Return the names in the heading of a CSV file, without their units."""
    return [name.partition(" [")[0] for name in heading.strip().split(",")]


def test_a_single_quantity_may_be_given_as_a_word() -> None:
    """Its letters are not taken for the names of quantities."""
    parameters = {"ratio": 1.5, "B2": 1.0, "B3": 2.0, "omega2": [0.3, 0.7]}
    assert [*atlas.sweep("elementary", parameters, "period")] == [*parameters, "period"]


def test_the_example_in_si_of_its_help_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """No row of it is the pole of (71), where no motion starts."""
    monkeypatch.chdir(tmp_path)
    help_text = " ".join(CliRunner().invoke(program, ["sweep", "--help"]).output.split())
    (example,) = re.findall(r"atlas (sweep elementary --shape .*? --out ring.csv)", help_text)
    with pytest.raises(SystemExit) as end:
        main(example.split())
    assert end.value.code == 0
    assert len((tmp_path / "ring.csv").read_text().splitlines()) == 272


def test_the_heading_of_a_csv_file_names_units_and_is_read_back(tmp_path: Path) -> None:
    """A rate has its unit, a pure number and a name have none; a list may have units in its heading."""
    parameters = {"ratio": 1.5, "B2": 1.0, "B3": 2.0, "omega2": [0.3, 0.7]}
    out = atlas.sweep("elementary", parameters, ["case", "period", "stability", "R11"], tmp_path / "t.csv", jobs=1)
    assert isinstance(out, Path)
    *conventions, heading = out.read_text().splitlines()[:3]
    assert all(line.startswith("# ") and "laboratory" in line for line in conventions)
    rates = "B2 [1/time],B3 [1/time],omega2 [1/time]"
    assert heading == f"ratio,{rates},case,period [time],stability [1/time^2],R11"
    (tmp_path / "list.csv").write_text(f"# two rows\nratio,{rates}\n1.5,1,2,0.3\n1.5,1,2,0.7\n")
    quantity_words = [word for name in ("case", "period", "stability", "R11") for word in ("--quantity", name)]
    places = "--list", tmp_path / "list.csv", "--out", tmp_path / "u.csv"
    words = ["sweep", "elementary", *places, *quantity_words, "--jobs", "1"]
    with pytest.raises(SystemExit) as end:
        main([str(word) for word in words])
    assert end.value.code == 0
    assert (tmp_path / "u.csv").read_bytes() == out.read_bytes()


def listed(place: Path, family: str, heading: str, row: str, quantity: str) -> tuple[int, list[str]]:
    """Return the status of a sweep over a list of one row, and its table, or the message."""
    (place / "l.csv").write_text(f"{heading}\n{row}\n")
    words = ["sweep", family, "--list", place / "l.csv", "--quantity", quantity, "--out", place / "t.csv", "-j1"]
    result = CliRunner().invoke(program, [str(word) for word in words])
    output = (place / "t.csv").read_text() if result.exit_code == 0 else result.output + str(result.exception)
    return result.exit_code, output.splitlines()


@pytest.mark.parametrize(
    ("unit", "factor", "time"),
    [
        ("Hz", 2 * np.pi, "s"), ("1/ms", 1e3, "s"), ("rad/s", 1, "s"), ("1/s", 1, "s"), ("1/time", 1, "time"),
        ("", 1, "time"), ("1", 1, "time"),
    ],
)  # fmt: skip
def test_a_unit_in_the_heading_of_a_list_applies_to_its_column(
    tmp_path: Path, unit: str, factor: float, time: str
) -> None:
    """A rate in Hz is turns a second, and the table is in seconds then; files of the atlas are taken as they are."""
    status, lines = listed(tmp_path, "elementary", f"ratio,B2,B3,omega2 [{unit}]", "1.5,1,2,0.5", "k")
    assert (status, lines[0]) == (0, "ratio,B2 [1/time],B3 [1/time],omega2 [1/time],k [1/time]".replace("time", time))
    assert float(lines[1].split(",")[3]) == 0.5 * factor


def test_the_heading_of_a_list_of_particles_is_in_si_or_as_it_is_written(tmp_path: Path) -> None:
    """Its B is the magnetic field itself, in T; a table that was written in seconds is a list again."""
    status, lines = listed(tmp_path, "particle", "mu [e/u],B3 [mT],v1 [km/s],t [us]", "1,1.5,2,4", "radius")
    assert status == 0
    assert [float(x) for x in lines[1].split(",")[1:4]] == [1.5e-3, 2e3, 4e-6]
    assert listed(tmp_path, "particle", lines[0].rpartition(",")[0], lines[1].rpartition(",")[0], "radius") == (
        0,
        lines,
    )


@pytest.mark.parametrize(
    ("heading", "says"),
    [
        (
            "ratio,B2,B3,omega2 [banana]",
            "'0.3' under omega2 [banana] is not a number in rad/s, or a unit that converts to it",
        ),
        ("ratio,B2,B3 [mT],omega2", "B3 [mT] is not a number in rad/s"),
        ("ratio [m],B2,B3,omega2", "ratio [m] is not a number without a unit"),
    ],
)
def test_a_unit_of_something_else_in_a_heading_is_refused(tmp_path: Path, heading: str, says: str) -> None:
    """With status 2, and the remedy."""
    status, output = listed(tmp_path, "elementary", heading, "1.5,1,2,0.3", "k")
    assert (status, says in " ".join(output)) == (2, True), output


@pytest.mark.parametrize(
    ("words", "says"),
    [
        ("elementary --set ratio=1.5 B2=1 B3=2 omega2=x --quantity k", "'omega2': 'x' is not"),
        ("elementary --set ratio=1.5 B2=1 B3=2T omega2=1 --quantity k", "'B3': --field is in rad/s"),
        ("particle --set mu=1 B3=1V v1=1 --quantity radius", "'B3': --magnetic is in T"),
        ("particle --set mu=1 B3=1.5mT E1=2V/m v1=1km/s t=4us --quantity radius", "1.0,0.0015,2.0,1000.0,4e-06,"),
    ],
)
def test_a_parameter_has_its_name_and_the_unit_of_its_option(tmp_path: Path, words: str, says: str) -> None:
    """Of a particle B is the magnetic field itself; t is a time."""
    out = tmp_path / "t.csv"
    result = CliRunner().invoke(program, ["sweep", *words.split(), "--out", str(out), "-j1"])
    assert says in (result.output if result.exit_code else out.read_text())


@pytest.mark.parametrize("place", ["/proc/x.csv", "/proc/y/x.csv"])
def test_an_unwritable_destination_is_named_as_typed(place: str, capsys: Any) -> None:
    """With status 2, and none of the files that a sweep has beside its table."""
    words = f"sweep elementary --set ratio=1.5 B2=1 B3=2 omega2=1 --quantity k --out {place}"
    with pytest.raises(SystemExit) as end:
        main(words.split())
    message = capsys.readouterr().err
    assert (end.value.code, place in message, "cannot be written" in message, ".lock" in message) == (
        2,
        True,
        True,
        False,
    )


def test_a_row_outside_the_domain_ends_a_sweep_as_its_help_says() -> None:
    """It has no empty cell, as beta for B = 0: its number and the reason are told."""
    help_text = " ".join(CliRunner().invoke(program, ["sweep", "--help"]).output.split())
    assert (
        "A row outside the domain, such as a pole, ends the sweep with status 2; the error names the row" in help_text
    )
    with pytest.raises(DomainError, match=r"In row 1 of the table, .*no angle beta"):
        atlas.sweep("quadric", {"ratio": 1.5, "B2": [0, 1], "B3": [0, 1]}, ["beta"])


def test_every_format_holds_the_same_table(tmp_path: Path) -> None:
    """CSV, NPZ and Parquet read back as the columns that were computed, to the bit."""
    pytest.importorskip("pyarrow")
    from pyarrow import parquet

    table = atlas.sweep("elementary", GRID, NAMES)
    for suffix in (".csv", ".npz", ".parquet"):
        sweep(tmp_path / f"t{suffix}", jobs=1)
    with np.load(tmp_path / "t.npz") as arrays:
        table_read = parquet.read_table(tmp_path / "t.parquet")
        heading, *lines = (tmp_path / "t.csv").read_text().splitlines()[2:]
        columns = dict(zip(plain(heading), zip(*(line.split(",") for line in lines), strict=True), strict=True))
        for name, values in table.items():
            assert np.array_equal(arrays[name], values)
            assert table_read[name].to_pylist() == values.tolist()
            text = columns[name]
            assert list(text if values.dtype.kind == "U" else map(float, text)) == values.tolist()


@pytest.mark.parametrize("name", [name for name, swept in FAMILIES.items() if swept.family.at_once > 1])
def test_finished_rows_leave_nothing_to_the_garbage_collector(name: str) -> None:
    """Objects of many rows are free as soon as these are done: a garbage collector, slow beside Dask, has no work."""
    swept, count = FAMILIES[name], 16
    required = [p for p in swept.family.parameters if p.needed]
    parameters = {key: [value] * count for p in required for key, value in zip(p.names, p.default, strict=True)}
    rising = np.linspace(1.0, 2.0, count).tolist()
    parameters |= {"t": rising} if "t" in swept.optional else {}
    parameters |= {"B3": rising} if name == "particle" else {}
    atlas.sweep(
        name, parameters, swept.quantities, listed=True
    )  # what is loaded with the first row is no garbage of rows
    gc.collect()
    gc.freeze()
    gc.disable()
    try:
        atlas.sweep(name, parameters, swept.quantities, listed=True)
        assert gc.collect() == 0
    finally:
        gc.enable()


def test_a_value_that_comes_again_is_written_alike() -> None:
    """A number is written with its shortest digits and the sign of its zero, however often it comes; NaN is empty."""
    few, many = [0.0, -0.0, 0.1 + 0.2, np.nan, -np.inf] * 3, np.linspace(1, 2, 15).tolist()
    lines = csv_part({"few": np.array(few), "many": np.array(many)}).decode().splitlines()
    assert lines == [f"{'' if np.isnan(x) else repr(x)},{y!r}" for x, y in zip(few, many, strict=True)]


def test_a_name_with_a_comma_is_one_cell(tmp_path: Path) -> None:
    """A CSV file reads back as the table, whatever its cases are called."""
    parameters = {"ratio": 0.5, "B2": 1.0, "B3": [0.0, 0.3], "omega2": [-1.0, 0.4], "omega1": 0.1, "omega3": 0.2}
    out = atlas.sweep("general", parameters, ["kind", "period"], tmp_path / "a.csv", listed=True, jobs=1)
    assert isinstance(out, Path)
    with out.open(newline="") as file:
        rows = list(csv.DictReader(file, plain(next(file))))
    table = atlas.sweep("general", parameters, ["kind", "period"], listed=True)
    assert isinstance(table, dict)
    assert [row["kind"] for row in rows] == table["kind"].tolist()
    assert any("," in row["kind"] for row in rows)
    assert [float(row["period"]) for row in rows] == table["period"].tolist()


def separatrices() -> dict[str, Any]:
    """Return a list of rows, of which some are on a separatrix and one on that of a triple root."""
    I, B2, B3, w1, w2, w3 = zip(
        (1.5, 1.0, 2.0, 0.3, 0.7, 0.2),
        (0.75, 20.0, 15.0, 6.0, -24.5, -7.0),
        (0.5, 1.0, -3.0, 0.0, 1.5, 2.0),
        (0.5, 1.0, 0.25, 0.1, -0.4, 0.3),
        (2.0, 1.0, 0.5, 1.0, -1.0, -0.5),
        strict=True,
    )
    return {"ratio": I, "B2": B2, "B3": B3, "omega1": w1, "omega2": w2, "omega3": w3}


ANGLES = ("kind", "period", "nome", "spin_per_period")
REASONS = ["", "no period", "no period, triple root", "", "no period"]


@pytest.mark.parametrize("digits", [None, 20])
def test_a_row_without_a_number_gives_a_reason_and_the_table_continues(tmp_path: Path, digits: int | None) -> None:
    """On a separatrix the angle a period is an empty cell of CSV, NaN in NPZ, null in Parquet, with a reason."""
    pytest.importorskip("pyarrow")
    from pyarrow import parquet

    names, rows = ANGLES[digits is not None :], separatrices()
    table = atlas.sweep("general", rows, names, listed=True, digits=digits)
    assert isinstance(table, dict)
    assert list(table) == [*rows, *names, "missing"]
    assert table["missing"].tolist() == REASONS
    assert [float(x) for x in table["period"]][1:3] == [np.inf, np.inf]
    has_no_value = dict.fromkeys(names, [False] * len(REASONS))
    has_no_value |= {"spin_per_period": [bool(reason) for reason in REASONS], "nome": ["root" in x for x in REASONS]}
    for suffix in (".csv", ".npz", ".parquet"):
        atlas.sweep("general", rows, names, tmp_path / f"t{suffix}", listed=True, digits=digits, rows=2, jobs=1)
    with (tmp_path / "t.csv").open(newline="") as file:
        text = list(csv.DictReader(file, plain(next(file))))
    table_read = parquet.read_table(tmp_path / "t.parquet")
    with np.load(tmp_path / "t.npz") as arrays:
        for name in names:
            none = arrays[name] == "" if digits or name == "kind" else np.isnan(arrays[name])
            assert none.tolist() == has_no_value[name]
            assert np.array_equal(arrays[name], table[name], equal_nan=not (digits or name == "kind"))
            texts = [str(x) for x in table[name].tolist()]
            cells = ["" if gone else x for gone, x in zip(has_no_value[name], texts, strict=True)]
            assert [row[name] for row in text] == cells
            values = [None if gone else x for gone, x in zip(has_no_value[name], table[name].tolist(), strict=True)]
            assert table_read[name].to_pylist() == values
        assert arrays["missing"].tolist() == [row["missing"] for row in text] == REASONS
    assert table_read["missing"].to_pylist() == [reason or None for reason in REASONS]


@pytest.mark.parametrize("listed", [False, True])
@pytest.mark.parametrize("rows", [None, 1, 4])
def test_the_first_row_outside_the_domain_is_named(tmp_path: Path, listed: bool, rows: int | None) -> None:
    """By its number in the whole table, in whichever part it is, and its parameters; finished rows are kept."""
    parameters: dict[str, Any] = {"ratio": [0.5, 1.5], "B2": 1, "B3": 1, "omega2": [1, 3, 4, -1, 2, -1]}
    if listed:
        parameters["ratio"] = 6 * [0.5]
    row_words = r"In row 4 of the table, ratio = 0.5, B2 = 1.0, B3 = 1.0, omega2 = -1.0: .*pole"
    with pytest.raises(DomainError, match=row_words):
        atlas.sweep("elementary", parameters, ["k"], tmp_path / "a.csv", jobs=1, rows=rows, listed=listed)
    with pytest.raises(DomainError, match=row_words):
        atlas.sweep("elementary", parameters, ["k"], listed=listed)
    assert bool(list(tmp_path.iterdir())) is (rows == 1)


@pytest.mark.slow
@pytest.mark.parametrize("family", FAMILIES)
def test_every_quantity_of_every_family_has_a_value_a_row(family: str) -> None:
    """All quantities of a list of two rows are finite, NaN with a reason, or names that fit."""
    family_swept = FAMILIES[family]
    parameters = {name: [0.3 + 0.1 * i, 0.7 + 0.1 * i] for i, name in enumerate(family_swept.needed)}
    names_fixed = {"inertia", "omega3", "c", "branch"}
    parameters |= {
        name: [0.2 + 0.1 * i, -0.4] for i, name in enumerate(family_swept.optional) if name not in names_fixed
    }
    table = atlas.sweep(family, parameters, list(family_swept.quantities), listed=True)
    for name in family_swept.quantities:
        assert table[name].shape == (2,)
        is_missing = np.isnan(table[name]) if family_swept.quantities[name].missing else False
        assert table[name].dtype == np.dtype(NAME) or (is_missing | np.isfinite(table[name])).all()


@pytest.mark.parametrize(
    ("family", "names"),
    [("elementary", ["omega3", "k", "phi"]), ("general", ["period", "nome", "spin_per_period", "least", "largest"])],
)
def test_certified_digits_round_to_the_floats(family: str, names: list[str]) -> None:
    """With digits the quantities are text, whose nearest doubles are those of the kernels."""
    parameters = {"ratio": [0.5, 1.5], "B2": [1.0, 2.0], "B3": [0.3, 0.4], "omega2": [0.7, 0.9]}
    if family == "general":
        parameters |= {"omega1": [0.3, 0.1], "omega3": [0.2, -0.4]}
    texts, floats = (atlas.sweep(family, parameters, names, listed=True, digits=n) for n in (30, None))
    for name in names:
        assert [float(text) for text in texts[name]] == floats[name].tolist()


def test_a_list_and_options_give_the_same_table(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The same rows from flags and from a CSV list give the same table."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "rows.csv").write_text("inertia,larmor,m2,m3\n1,0.5,0.2,0.1\n1,0.5,0.2,0.3\n")
    flags = "ball --set inertia=1 --set larmor=0.5 --set m2=0.2 --set m3=0.1,0.3 --quantity gamma --out flags.csv -j1"
    for line in (flags, "ball --list rows.csv --quantity gamma --out list.csv -j1"):
        result = CliRunner().invoke(program, ["sweep", *line.split()])
        assert not result.exit_code, result.output + str(result.exception)
    assert Path("flags.csv").read_bytes() == Path("list.csv").read_bytes()


@pytest.mark.slow
def test_no_field_of_a_record_shadows_a_name_in_the_annotations_beside_it() -> None:
    """From Python 3.14 on annotations are evaluated late, when a field `list` would be the meaning of `list`."""
    shadows = []
    for path in Path(atlas.__file__).parent.rglob("*.py"):
        for record in (node for node in ast.walk(ast.parse(path.read_text())) if isinstance(node, ast.ClassDef)):
            fields = [node for node in record.body if isinstance(node, ast.AnnAssign)]
            names = {node.target.id for node in fields if isinstance(node.target, ast.Name) and node.value is not None}
            used = {x.id for node in fields for x in ast.walk(node.annotation) if isinstance(x, ast.Name)}
            shadows += [f"{path.name}: {record.name}.{name}" for name in names & used]
    assert not shadows


def test_the_log_of_a_batch_job_shows_a_sweep(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without a terminal there is a line a minute on standard error; a sweep of less than a minute says nothing."""
    words = "sweep ball --set inertia=1 --set larmor=1 --set m2=1 --set m3=1:2:3 --quantity gamma --rows 1 -j 1 --out"
    for minutes, log in ((0.4, ["sweep: 3 of 3 (100 %) after 1 min"]), (0.1, [])):
        clock = iter(60 * minutes * i for i in range(10))
        monkeypatch.setattr("atlas.cli.present.monotonic", lambda clock=clock: next(clock))
        ended = CliRunner().invoke(program, [*words.split(), str(tmp_path / "t.csv")])
        assert ended.stderr.splitlines() == log


def test_ranges_have_units_and_starts_are_options(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """In hertz a range is of turns a second, its rates are in 1/s; a spin and omega2 stand for their components."""
    monkeypatch.chdir(tmp_path)
    words = "--ratio 1.5 --field 1rad/s 2rad/s --quantity precession_rate --out"
    for start, out in (("--set omega1=0 omega2=0 omega3=1Hz:2Hz:2", "a.csv"), ("--spin 1Hz", "b.csv")):
        assert CliRunner().invoke(program, f"sweep motion {words} {out} {start}".split()).exit_code == 0
    rows_first, second = (
        [line.split(",") for line in Path(name).read_text().splitlines()] for name in ("a.csv", "b.csv")
    )
    assert rows_first[:2] == second
    assert "omega3 [1/s]" in rows_first[0]
    assert [float(row[rows_first[0].index("omega3 [1/s]")]) for row in rows_first[1:]] == pytest.approx(
        [2 * np.pi, 4 * np.pi]
    )
    words = "sweep motion --ratio 1.5 --field 1 2 --quantity k --out c.csv --omega2 0.7"
    assert CliRunner().invoke(program, words.split()).exit_code == 0
    assert Path("c.csv").read_text().startswith("ratio,B2 [1/time],B3 [1/time],omega2 [1/time]")
