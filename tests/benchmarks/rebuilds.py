"""How long a change takes: edits of many kinds in a copy of the sources, what each makes anew, and in what time.

`make rebuilds` measures, prints, and keeps the record where a report shows it.
"""

import argparse
import hashlib
import json
import os
import shutil
import statistics
import subprocess
import sys
import time
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from atlas import files
from atlas.build.cache import digest
from atlas.build.sources import PACKAGE
from atlas.errors import AtlasError
from atlas.places import folder
from benchmarks.changes import BUILD, CHANGES, Change


@dataclass(frozen=True)
class Taken:
    """What a change took: what was made anew, and the seconds of each run."""

    name: str
    command: str
    figures: int
    pages: int
    pdf: bool
    seconds: tuple[float, ...]


class Checkout:
    """A copy of the sources, in which commands run as a user would run them."""

    def __init__(self, place: Path) -> None:
        self.place, self.out = place, place / "out"
        for source in (folder("figures"), folder("templates"), folder("reports")):
            shutil.copytree(source, place / source.name)
        shutil.copytree(PACKAGE, place / "atlas", ignore=shutil.ignore_patterns("__pycache__", "_data"))
        (place / "pyproject.toml").touch()  # it is a checkout

    def run(self, command: Sequence[str], number: int = 0, cores: set[int] | None = None) -> float:
        """Run a command of the atlas and return its seconds."""
        words = [sys.executable, "-m", "atlas", *(word.format(out=self.out, number=number) for word in command)]
        environment = {key: value for key, value in os.environ.items() if key != "PYTHONDONTWRITEBYTECODE"}
        began = time.perf_counter()
        done = subprocess.run(
            words,
            cwd=self.place,
            env=environment | {"PYTHONPATH": str(self.place)},
            capture_output=True,
            text=True,
            check=False,
            preexec_fn=(lambda: os.sched_setaffinity(0, cores)) if cores else None,
        )
        seconds = time.perf_counter() - began
        if done.returncode:
            raise AtlasError(f"atlas {' '.join(words[3:])} ended with {done.returncode}: {done.stderr.strip()}")
        return seconds

    def scenes(self) -> list[dict[str, Any]]:
        """Return the entries of the cost ledger of the last build."""
        found: list[dict[str, Any]] = json.loads(self._ledger.read_text())["scenes"]
        return found

    def drawn(self, since: float) -> int:
        """Return how many figures were drawn since a time, if anything was built since then."""
        built = self._ledger.stat().st_mtime > since
        return sum(scene["from"] == "drawn" for scene in self.scenes()) if built else 0

    @property
    def _ledger(self) -> Path:
        return self.out / "atlas.costs.json"

    def state(self) -> dict[str, str]:
        """Return the digests of what a reader sees."""
        files = [*self.out.glob("atlas/*.html"), *self.out.glob("atlas/figures/*"), *self.out.glob("*.pdf")]
        files += self.out.glob("plots/*.svg")
        return {str(file.relative_to(self.out)): hashlib.sha256(file.read_bytes()).hexdigest() for file in files}

    def measure(self, change: Change, runs: int) -> Taken:
        """Make a change some times over, each time another one, and run its command; then undo it."""
        path = self.place / change.file
        original = path.read_text(encoding="utf-8")
        seconds, made, figures = [], list[str](), 0
        for number in range(runs + 1):
            before, began = self.state(), time.time()
            path.write_text(change.edit(original, number), encoding="utf-8")
            elapsed = self.run(change.command, number)
            if number:  # the first one loads what was not used for long
                seconds.append(elapsed)
                made = [name for name, key in self.state().items() if before.get(name) != key]
                figures = self.drawn(began) if change.command[0] == "report" else len(made)
        path.write_text(original, encoding="utf-8")
        said = " ".join(("atlas", *change.command)).replace(" --out {out}/plots", "").replace(" --out {out}", "")
        said = said.format(number=0)
        return Taken(change.name, said, figures, *kinds(made), tuple(seconds))


def kinds(made: Iterable[str]) -> tuple[int, bool]:
    """Return how many pages are among files, and whether the report's PDF is, which stands beside their folder."""
    paths = [Path(name) for name in made]
    return sum(path.suffix == ".html" for path in paths), Path("atlas.pdf") in paths


def measure(runs: int = 5) -> Iterator[Taken]:
    """Measure every change in a warm checkout."""
    with TemporaryDirectory() as place:
        checkout = Checkout(Path(place))
        checkout.run(BUILD)
        for change in CHANGES:
            taken = checkout.measure(change, runs)
            checkout.run(BUILD)
            yield taken


@dataclass(frozen=True)
class Cold:
    """Medians in seconds: the whole atlas from nothing on one core and on two, and its drawings alone, on one core."""

    one: float
    two: float
    drawings: float


def cold(runs: int = 3) -> Cold:
    """Build the whole atlas from nothing on one core and on two; compare with the bare time of its drawings."""
    available = sorted(os.sched_getaffinity(0))
    whole: list[list[float]] = [[], []]
    drawings = []
    for _ in range(runs):
        for number in (1, 2):
            with TemporaryDirectory() as place:
                checkout = Checkout(Path(place))
                seconds = checkout.run((*BUILD, "--jobs", str(number)), cores=set(available[:number]))
                whole[number - 1].append(seconds)
                if number == 1:
                    drawings.append(sum(one["compute_s"] + one["draw_s"] for one in checkout.scenes()))
    one, two = map(statistics.median, whole)
    return Cold(one, two, statistics.median(drawings))


def stored() -> Path:
    """Return where the record of the repository lies."""
    return folder("reports") / "data" / "rebuilds.json"


def code() -> str:
    """Return the digest of what is measured, comments aside: the code that builds, and the kinds of changes."""
    files = [*sorted((PACKAGE / "build").glob("*.py")), Path(__file__).with_name("changes.py")]
    lines = (line.strip() for path in files for line in path.read_text(encoding="utf-8").splitlines())
    return digest([line for line in lines if line and not line.startswith("#")])


def store(changes: Sequence[Taken], whole: Cold) -> None:
    """Keep what was measured, with machine and date, whole or not at all."""
    from atlas.study.bench.results import machine, today

    here = machine()
    record = {
        "command": "make rebuilds",
        "code": code(),
        "date": today(),
        "machine": f"{here.processor}, {here.cores} cores, {here.system}",
        "changes": [asdict(one) for one in changes],
        "cold": asdict(whole),
    }
    files.write(stored(), json.dumps(record, ensure_ascii=False, indent=1) + "\n")


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.rebuilds", description=__doc__)
    parser.add_argument("--runs", type=int, default=5, help="how often each change is made")
    parser.add_argument("--store", action="store_true", help=f"keep the record as {stored().name} in reports/data")
    options = parser.parse_args()
    taken = []
    for one in measure(options.runs):
        taken.append(one)
        made = f"{one.figures} figures, {one.pages} pages{', PDF' if one.pdf else ''}"
        print(f"{statistics.median(one.seconds):6.2f} s  {one.name:42}{made:32}{one.command}", flush=True)  # noqa: T201
    whole = cold(min(3, options.runs))
    print(f"from nothing: {whole.one:.2f} s on one core, {whole.two:.2f} s on two")  # noqa: T201  what was asked for
    if options.store:
        store(taken, whole)


if __name__ == "__main__":
    main()
