"""Do the tests notice a slip? One token of the code is changed at a time, in a copy, and the tests that concern it run.

`python tests/mutants.py core exact figures --count 60 --seed 0` draws so many changes, evenly over the tokens of these
packages of `atlas` and of the recipes, and lists those that survive. The tests that concern a file import it, or import
what imports it, nearest first; what is loaded by name is in LOADED. They stop at the first failure. A test that runs
for more than LIMIT seconds has noticed.

Why not mutmut or cosmic-ray: they put calls in the place of functions, which the recipes and the digests of sources,
read as text here, take for other code; and a sample with a seed is all that is wanted.
"""

import argparse
import ast
import io
import os
import random
import shutil
import subprocess
import sys
import tempfile
import tokenize
from collections.abc import Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cache
from itertools import islice
from pathlib import Path
from queue import SimpleQueue

ROOT = Path(__file__).resolve().parents[1]
LIMIT, FILES, DISTANCE = 600, 5, 3
"""Seconds, test files and imports between a test and what it concerns, at most."""

FIGURES = ("test_snapshots", "test_figures_general", "test_figures_2d", "test_figures_3d", "test_curves")
LOADED = {
    "figures/": FIGURES,
    "atlas/scene/": FIGURES,
    "atlas/draw/": ("test_draw_figure", "test_draw_shaded"),
    "atlas/report/": ("test_report_tables", "test_report_records", "test_report_formulas"),
    "atlas/study/": ("test_stress", "test_bench_results", "test_bench_figures"),
}
"""The tests of what no test imports, since it is loaded by its name."""

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

    def __str__(self) -> str:
        return f"{self.path}:{self.line}:{self.start}: {self.old} -> {self.new or 'nothing'}"


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
    """Yield the places of what does nothing at run time: annotations, imports, signatures' stars and slashes."""
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


@cache
def imports(path: Path) -> frozenset[str]:
    """Return the modules of `atlas` that a file imports by itself, public names by their homes."""
    found: set[str] = set()
    text = path.read_text(encoding="utf-8")
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("atlas"):
            found |= {str(node.module)} | {f"{node.module}.{alias.name}" for alias in node.names}
        elif isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names if alias.name.startswith("atlas")}
    if "atlas" in found and path.name != "__init__.py":
        import atlas

        found |= {home for name, home in atlas._HOMES.items() if f"atlas.{name}" in text}
    return frozenset(found)


@cache
def concerned(path: str, root: Path) -> tuple[str, ...]:
    """Return the tests that concern a file, nearest first."""
    module = path.removesuffix(".py").replace("/", ".").removesuffix(".__init__")
    above = {"report", "build", "draw", "figures", "cli"} - {Path(path).parts[1]}
    slow = tuple(f"test_{name}" for name in above)  # whole builds notice much, late: laws should notice first
    tests = [test for folder in ("unit", "fuzz") for test in sorted((root / "tests" / folder).glob("test_*.py"))]
    tests = [test for test in tests if not test.name.startswith(slow)]
    sources = list((root / "atlas").rglob("*.py"))
    reached, found = {module}, list[Path]()
    for _ in range(DISTANCE):
        near = [test for test in tests if test not in found and imports(test) & reached]
        own = f"test_{Path(path).stem}.py"
        found += sorted(near, key=lambda test: (test.name != own, test.stat().st_size))
        users = [source for source in sources if imports(source) & reached]
        reached |= {source.relative_to(root).as_posix().removesuffix(".py").replace("/", ".") for source in users}
    names = [test.relative_to(root).as_posix() for test in found[:FILES]]
    loaded = [f"tests/unit/{name}.py" for start, tests in LOADED.items() if path.startswith(start) for name in tests]
    return tuple(dict.fromkeys([*names, *loaded]))


def tested(copy: Path, tests: Iterable[str], *words: str) -> tuple[bool, str]:
    """Run tests in a copy; return whether all pass, and what pytest says. One that takes too long has not passed."""
    command = [sys.executable, "-m", "pytest", "-n0", "-q", *words, *tests]
    environment = os.environ | {"PYTHONPATH": str(copy), "PYTHONDONTWRITEBYTECODE": "1", "OPENBLAS_NUM_THREADS": "1"}
    try:
        done = subprocess.run(
            command, cwd=copy, env=environment, capture_output=True, text=True, timeout=LIMIT, check=False
        )
    except subprocess.TimeoutExpired:
        return False, ""
    return done.returncode == 0, done.stdout


def failing(copy: Path, tests: Iterable[str]) -> set[str]:
    """Return the test files that fail without any change: they can notice nothing."""
    found = {test for test in tests if not tested(copy, [test], "-x")[0]}
    for test in sorted(found):
        print(f"{test} fails without any change and is left out", flush=True)
    return found


def copied(folder: Path) -> Path:
    """Copy what is under version control into a folder."""
    listed = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True).stdout.split(
        "\n"
    )
    for name in filter(None, listed):
        if (ROOT / name).is_file():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, folder / name)
    return folder


def survivors(packages: list[str], count: int, seed: int, jobs: int) -> tuple[int, list[Mutant]]:
    """Return how many mutants were tried, and those that no test noticed."""
    with tempfile.TemporaryDirectory() as temporary:
        clean = copied(Path(temporary) / "clean")
        places = [clean / "figures" if package == "figures" else clean / "atlas" / package for package in packages]
        files = [file for place in places for file in ([place] if place.is_file() else sorted(place.rglob("*.py")))]
        every = [mutant for path in files for mutant in mutants(path, clean)]
        random.Random(seed).shuffle(every)  # noqa: S311  reproducible, not secret
        sample = list(islice((mutant for mutant in every if is_python(mutant, clean)), count))
        print(f"{len(every)} mutants in {', '.join(packages)}; {len(sample)} are tried, seed {seed}", flush=True)
        copies: SimpleQueue[Path] = SimpleQueue()
        for i in range(jobs):
            copies.put(copied(Path(temporary) / str(i)))

        def survives(mutant: Mutant) -> bool:
            copy, tests = copies.get(), [test for test in concerned(mutant.path, clean) if test not in broken]
            place = copy / mutant.path
            text = place.read_text(encoding="utf-8")
            try:
                place.write_text(mutant.applied(text), encoding="utf-8")
                noticed = bool(tests) and not tested(copy, tests, "-x")[0]
            finally:
                place.write_text(text, encoding="utf-8")
                copies.put(copy)
            print("noticed " if noticed else "SURVIVES", mutant, flush=True)
            return not noticed

        wanted = {test for mutant in sample for test in concerned(mutant.path, clean)}
        with ThreadPoolExecutor(jobs) as pool:
            broken = set().union(*pool.map(lambda test: failing(clean, [test]), sorted(wanted)))
        with ThreadPoolExecutor(jobs) as pool:
            return len(sample), [
                mutant for mutant, alive in zip(sample, pool.map(survives, sample), strict=True) if alive
            ]


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
    tried, alive = survivors(given.packages, given.count, given.seed, given.jobs)
    print(f"{tried} tried, {len(alive)} survive ({100 * len(alive) / tried:.0f} %)")
    for mutant in alive:
        print(mutant)
    sys.exit(len(alive) > tried / 20)


if __name__ == "__main__":
    main()
