"""Do the tests notice a slip? One token of the code is changed at a time, in a copy, and the tests that reach it run.

`python tests/mutants.py core exact figures --count 60 --seed 0` draws so many changes, evenly over the tokens of these
packages of `atlas` and of the recipes, and lists those that survive. Which tests run a line, a run of the unchanged
tests records first, by the text of the line (in build/mutants; renewed for the test files that have changed, and for
all when that folder is deleted: what is stale there can only hide a test that would notice). The cheapest run first, up
to SECONDS in all, until one fails; one that takes more than LIMIT seconds of the processor has noticed, however busy
the machine is. Changes that make no difference stand in equivalent.toml, each with its reason, and are not drawn.

Why not mutmut or cosmic-ray: they put calls in the place of functions, which the recipes and the digests of sources,
read as text here, take for other code; and a sample with a seed is all that is wanted.
"""

import argparse
import ast
import hashlib
import io
import json
import multiprocessing
import os
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import tokenize
import tomllib
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from queue import SimpleQueue
from typing import Any

import coverage
import pytest

ROOT = Path(__file__).resolve().parents[1]
SEEN = ROOT / "build" / "mutants"
EQUIVALENT = ROOT / "tests" / "equivalent.toml"
LIMIT, SECONDS = 300, (2, 10, 40)
"""Seconds of the processor: of one run; and, by the record, of the tests of one change, run in so many groups."""

PATIENCE = 1800
"""Seconds that a run may wait, for the processor or for ever."""

RAN = 10
"""What is added to the exit status of pytest, so that it is known to have run."""

LATE = ("test_build", "test_proof", "test_guide", "test_loading", "test_agreement_register", "test_bench_peers")
"""Whole builds notice much, late: laws should notice first."""

PRELOADED = "numpy pytest hypothesis lxml.html flint mpmath scipy.integrate matplotlib.figure click".split()
CONTEXT = multiprocessing.get_context("forkserver")
"""Each run is forked from a process that has these libraries, and nothing of `atlas`."""

SWAPS = {
    "+": "-", "-": "+", "*": "/", "/": "*", "<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==",
    "and": "or", "or": "and", "True": "False", "False": "True", "not": "", "min": "max", "max": "min",
    "sin": "cos", "cos": "sin", "all": "any", "any": "all", "+=": "-=", "-=": "+=", "//": "/", "<<": ">>", ">>": "<<",
}  # fmt: skip


@dataclass(frozen=True)
class Mutant:
    """A change of one token: in which file, line and columns, from what to what."""

    path: str
    line: int
    start: int
    end: int
    old: str
    new: str

    def applied(self, text: str) -> str:
        """Return the source with the change."""
        lines = text.splitlines(keepends=True)
        row = lines[self.line - 1]
        lines[self.line - 1] = row[: self.start] + self.new + row[self.end :]
        return "".join(lines)

    @property
    def change(self) -> str:
        """What becomes what."""
        return f"{self.old} -> {self.new or 'nothing'}"

    def __str__(self) -> str:
        return f"{self.path}:{self.line}:{self.start}: {self.change}"


def mutants(path: Path, root: Path) -> Iterator[Mutant]:
    """Yield every change of a file below the root."""
    text = path.read_text(encoding="utf-8")
    skipped = set(_skipped(ast.parse(text)))
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if (token.start in skipped) or token.start[0] != token.end[0]:
            continue
        new = SWAPS.get(token.string)
        if token.type == tokenize.NUMBER:
            new = f"({token.string} * 1.5 + 0.5)" if any(c in token.string for c in ".ej") else f"({token.string} + 1)"
        if new is None or token.type not in {tokenize.OP, tokenize.NAME, tokenize.NUMBER}:
            continue
        relative = path.relative_to(root).as_posix()
        yield Mutant(relative, token.start[0], token.start[1], token.end[1], token.string, new)


def is_python(mutant: Mutant, root: Path) -> bool:
    """Tell whether a change leaves Python."""
    try:
        ast.parse(mutant.applied((root / mutant.path).read_text(encoding="utf-8")))
    except SyntaxError:
        return False
    return True


def _skipped(tree: ast.Module) -> Iterator[tuple[int, int]]:
    """Yield the places of what a result cannot show: annotations, imports, stars and slashes, how a record is made.

    Neither can the size of the number for the free dimension of `reshape`: NumPy takes any negative one.
    """
    nodes: list[ast.AST] = []
    for node in ast.walk(tree):
        if isinstance(node, ast.arg | ast.AnnAssign) and node.annotation is not None:
            nodes.append(node.annotation)
        if isinstance(node, ast.FunctionDef):
            nodes += [node.returns] if node.returns else []
            yield from (
                (line, column) for line in range(node.lineno, node.body[0].lineno) for column in _stars(node, line)
            )
        if isinstance(node, (ast.Import | ast.ImportFrom, ast.Raise)):
            nodes.append(node)
        if isinstance(node, ast.keyword) and node.arg in {"frozen", "slots", "eq", "strict"}:
            nodes.append(node)
        if isinstance(node, ast.Call) and ast.unparse(node.func).endswith(".reshape"):
            nodes += [size.operand for size in node.args if isinstance(size, ast.UnaryOp)]
    for node in nodes:
        for line in range(node.lineno, node.end_lineno + 1):
            first = node.col_offset if line == node.lineno else 0
            last = node.end_col_offset if line == node.end_lineno else 400
            yield from ((line, column) for column in range(first, last))


def _stars(node: ast.FunctionDef, line: int) -> range:
    """Return the columns of a signature's line that hold no default."""
    held = any(
        default is not None and default.lineno == line for default in [*node.args.defaults, *node.args.kw_defaults]
    )
    return range(0) if held else range(400)


class Lines:
    """A plugin of pytest: which lines of the code each test runs, by their text, and in how many seconds.

    Written as {"seconds": {test: seconds}, "lines": {file: {line: [test, ...]}}}, without the tests that fail.
    """

    def __init__(self, out: str) -> None:
        self.out, self.seconds, self.failed = Path(out), dict[str, float](), set[str]()
        self.coverage = coverage.Coverage(data_file=None, config_file=False, include=["atlas/*", "figures/*"])
        self.coverage.set_option("run:disable_warnings", ["no-data-collected"])

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> Iterator[None]:
        """Watch a test and the fixtures that it is the first to ask for; what is loaded with the file is no test's."""
        start = sum(os.times()[:4])
        self.coverage.start()
        self.coverage.switch_context(item.nodeid)
        try:
            return (yield)
        finally:
            self.coverage.stop()
            self.seconds[item.nodeid] = sum(os.times()[:4]) - start

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Note a failure."""
        if report.failed:
            self.failed.add(report.nodeid)

    def pytest_sessionfinish(self) -> None:
        """Write what was seen."""
        for test in self.failed:
            print(f"{test} fails without any change and is left out", file=sys.__stderr__)
        passed = {test: seconds for test, seconds in self.seconds.items() if test not in self.failed}
        data, found = self.coverage.get_data(), dict[str, dict[str, set[str]]]()
        for file in data.measured_files():
            rows = Path(file).read_text(encoding="utf-8").splitlines()
            texts = found.setdefault(Path(file).relative_to(Path.cwd()).as_posix(), {})
            for line, tests in data.contexts_by_lineno(file).items():
                texts.setdefault(rows[line - 1].strip(), set()).update(passed.keys() & tests)
        lines = {file: {text: sorted(tests) for text, tests in texts.items()} for file, texts in found.items()}
        self.out.write_text(json.dumps({"seconds": passed, "lines": lines}), encoding="utf-8")


def _run(copy: str, out: str, tests: list[str]) -> None:
    """Run tests in a copy, in a process of its own, to the first failure, or whole if there is something to write."""
    os.setsid()
    resource.setrlimit(resource.RLIMIT_CPU, (LIMIT, LIMIT))
    os.chdir(copy)
    os.environ["PYTHONPATH"] = copy
    sys.path.insert(0, copy)
    sys.dont_write_bytecode = not out
    with Path(os.devnull).open("w", encoding="utf-8") as nothing:
        os.dup2(nothing.fileno(), 1)
        if not out:
            os.dup2(nothing.fileno(), 2)
    words = ["-p", "no:xdist", "-W", "ignore::pytest.PytestAssertRewriteWarning", *([] if out else ["-x"])]
    os._exit(RAN + pytest.main([*words, *tests], plugins=[Lines(out)] if out else []))


def passed(copy: Path, tests: list[str], out: str = "") -> bool:
    """Tell whether tests pass in a copy; those that take too long or bring the process down do not."""
    process = CONTEXT.Process(target=_run, args=(str(copy), out, tests))
    process.start()
    process.join(PATIENCE)
    if process.is_alive():
        os.killpg(process.pid or 0, signal.SIGKILL)
        process.join()
    code = (process.exitcode or 0) - RAN
    if process.exitcode in {0, 1}:
        raise SystemExit("the tests could not be started")
    files = list(dict.fromkeys(test.partition("::")[0] for test in tests))
    if code == pytest.ExitCode.USAGE_ERROR and files != tests:  # the change has given a test another name
        return passed(copy, files)
    return code == pytest.ExitCode.OK


@dataclass
class Record:
    """What the tests run: how long each takes, and which run a line of a file."""

    seconds: dict[str, float]
    lines: dict[str, dict[str, list[str]]]


def recorded(clean: Path, pool: ThreadPoolExecutor) -> Record:
    """Return what the tests run, from the record of each file of tests that has not changed since."""
    tests = [test for folder in ("unit", "fuzz") for test in sorted((clean / "tests" / folder).glob("test_*.py"))]
    SEEN.mkdir(parents=True, exist_ok=True)

    def seen(test: Path) -> Any:
        record, now = SEEN / f"{test.parent.name}-{test.stem}.json", hashlib.sha256(test.read_bytes()).hexdigest()
        before = json.loads(record.read_text(encoding="utf-8")) if record.exists() else {}
        if before.get("digest") == now:
            return before
        with tempfile.NamedTemporaryFile("r", encoding="utf-8") as out:
            passed(clean, [test.relative_to(clean).as_posix()], out.name)
            found = {"seconds": {}, "lines": {}} | json.loads(out.read() or "{}")
        print(f"{test.name}: {len(found['seconds'])} tests are watched", flush=True)
        record.write_text(json.dumps(found | {"digest": now}), encoding="utf-8")
        return found

    every = Record({}, {})
    for found in pool.map(seen, [test for test in tests if not test.name.startswith(LATE)]):
        every.seconds |= found["seconds"]
        for file, lines in found["lines"].items():
            for text, runs in lines.items():
                every.lines.setdefault(file, {}).setdefault(text, []).extend(runs)
    return every


def shown(mutant: Mutant, root: Path) -> Iterator[tuple[str, str]]:
    """Yield the file and the text of each line that shows the change when it runs.

    They are those of the statement; for a signature, those of the function; outside of functions, those that name what
    is defined there.
    """
    lines = (root / mutant.path).read_text(encoding="utf-8").splitlines()
    around = [
        node
        for node in ast.walk(ast.parse("\n".join(lines)))
        if isinstance(node, ast.stmt)
        and min([node.lineno, *(part.lineno for part in getattr(node, "decorator_list", []))]) <= mutant.line
        and mutant.line <= (node.end_lineno or 0)
    ]
    statement = around[-1]  # walked from the outermost inwards
    body = getattr(statement, "body", [])
    if isinstance(statement, ast.FunctionDef):
        yield from ((mutant.path, text.strip()) for text in lines[body[0].lineno - 1 : statement.end_lineno])
    elif any(isinstance(node, ast.FunctionDef) for node in around):
        last = max(statement.lineno, body[0].lineno - 1) if body else statement.end_lineno
        yield from ((mutant.path, text.strip()) for text in lines[statement.lineno - 1 : last])
    else:
        names = {
            node.id for node in ast.walk(statement) if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)
        }
        word = re.compile(rf"\b(?:{'|'.join(names | {getattr(statement, 'name', Path(mutant.path).stem)})})\b")
        for path in [*(root / "atlas").rglob("*.py"), *(root / "figures").glob("*.py")]:
            texts = path.read_text(encoding="utf-8").splitlines()
            yield from ((path.relative_to(root).as_posix(), text.strip()) for text in texts if word.search(text))


def picked(mutant: Mutant, record: Record, root: Path) -> Iterator[list[str]]:
    """Yield the tests that run the changed line, then those that run another of its file or name it.

    The cheapest first. What stands outside all functions is read by tests that need not run any.
    """
    word = re.compile(rf"\b{Path(mutant.path).stem}\b")
    files = {test.partition("::")[0] for test in record.seconds}
    named = {file for file in files if word.search((root / file).read_text(encoding="utf-8"))}
    near = {test for file, text in shown(mutant, root) for test in record.lines.get(file, {}).get(text, [])}
    far = {test for tests in record.lines.get(mutant.path, {}).values() for test in tests}
    far |= {test for test in record.seconds if test.partition("::")[0] in named}
    spent, group, limits = 0.0, list[str](), list(SECONDS)
    for test in sorted(near | far, key=lambda test: (test not in near, record.seconds[test], test)):
        spent += record.seconds[test]
        while limits and spent > limits[0]:
            del limits[0]
            yield group
            group = []
        if not limits:
            return
        group.append(test)
    yield group


def equivalent(root: Path) -> dict[Mutant, str]:
    """Return the changes that make no difference, with their reasons; each entry must still be there once."""
    known = dict[Mutant, str]()
    for entry in tomllib.loads(EQUIVALENT.read_text(encoding="utf-8"))["equivalent"]:
        path = root / entry["path"]
        lines = path.read_text(encoding="utf-8").splitlines()
        alike = [mutant for mutant in mutants(path, root) if lines[mutant.line - 1].strip() == entry["line"]]
        for change in entry["changes"]:
            of, _, nth = change.partition(" #")
            found = [mutant for mutant in alike if mutant.change == of][int(nth or 1) - 1 :]
            if not found:
                raise SystemExit(f"{EQUIVALENT.name}: {entry['path']} has no longer {change} in: {entry['line']}")
            known[found[0]] = entry["reason"]
    return known


def copied(folder: Path) -> Path:
    """Copy what is under version control into a folder."""
    listed = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    for name in filter(None, listed.split("\n")):
        if (ROOT / name).is_file():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, folder / name)
    return folder


def survivors(packages: list[str], count: int, seed: int, jobs: int) -> tuple[int, list[Mutant]]:
    """Return how many mutants were tried, and those that no test noticed."""
    with tempfile.TemporaryDirectory() as temporary, ThreadPoolExecutor(jobs) as pool:
        clean = copied(Path(temporary) / "clean")
        places = [clean / "figures" if package == "figures" else clean / "atlas" / package for package in packages]
        files = [file for place in places for file in ([place] if place.is_file() else sorted(place.rglob("*.py")))]
        known = equivalent(clean)
        every = [mutant for path in files for mutant in mutants(path, clean) if mutant not in known]
        random.Random(seed).shuffle(every)  # noqa: S311  reproducible, not secret
        sample = list(islice((mutant for mutant in every if is_python(mutant, clean)), count))
        print(f"{len(every)} mutants in {', '.join(packages)}; {len(sample)} are tried, seed {seed}", flush=True)
        record = recorded(clean, pool)
        copies: SimpleQueue[Path] = SimpleQueue()
        for i in range(jobs):
            copies.put(copied(Path(temporary) / str(i)))

        def survives(mutant: Mutant) -> bool:
            copy = copies.get()
            place = copy / mutant.path
            text = place.read_text(encoding="utf-8")
            groups = [group for group in picked(mutant, record, clean) if group]
            try:
                place.write_text(mutant.applied(text), encoding="utf-8")
                noticed = not all(passed(copy, group) for group in groups)
            finally:
                place.write_text(text, encoding="utf-8")
                copies.put(copy)
            tried = f" ({sum(map(len, groups))} tests reach it)" * (not noticed)
            print("noticed " if noticed else "SURVIVES", mutant, tried, flush=True)
            return not noticed

        alive = [mutant for mutant, found in zip(sample, pool.map(survives, sample), strict=True) if found]
        return len(sample), alive


def main() -> None:
    """Run from the command line; status 1 if more than a twentieth survives."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0] if __doc__ else "")
    parser.add_argument(
        "packages", nargs="+", help="packages or files of atlas, or figures: core study/check.py figures ..."
    )
    parser.add_argument("--count", type=int, default=60)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--jobs", type=int, default=2)
    given = parser.parse_args()
    os.nice(10)
    CONTEXT.set_forkserver_preload(["__main__", *PRELOADED])
    tried, alive = survivors(given.packages, given.count, given.seed, given.jobs)
    print(f"{tried} tried, {len(alive)} survive ({100 * len(alive) / tried:.0f} %)")
    for mutant in alive:
        print(mutant)
    sys.exit(len(alive) > tried / 20)


if __name__ == "__main__":
    main()
