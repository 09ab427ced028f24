"""How long a change takes: edits of many kinds in a copy of the sources, what each makes anew, and in what time.

`python -m atlas.build.rebuilds` measures and prints; with ``--store`` the record goes to where a report shows it.
"""

import argparse
import hashlib
import json
import os
import re
import shutil
import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, TypeAlias

from atlas.build.sources import PACKAGE
from atlas.errors import AtlasError
from atlas.places import folder

Edit: TypeAlias = Callable[[str, int], str]
RECORD = "rebuilds.json"
REPORT = "reports/atlas.toml"
BUILD = ("report", "--out", "{out}")
PAGES = (*BUILD, "--format", "html")
DRAW = ("figure", "hyperbola", "--format", "svg", "--out", "{out}/plots", "--set")


def parameter(block: str, key: str, value: float) -> Edit:
    """Return the edit that gives a parameter of a report's block another value each time."""

    def edit(text: str, number: int) -> str:
        found = re.search(rf'^id = "{block}"$.*?(?=^\n)', text, re.MULTILINE | re.DOTALL)
        if found is None:
            raise AtlasError(f"{REPORT} has no block with the id {block!r}.")
        entry = f"{key} = {value + 0.001 * number:.3f}"
        body, known = re.subn(r"^parameters = \{[^}]*\}", f"parameters = {{ {entry} }}", found[0], flags=re.MULTILINE)
        return text.replace(found[0], body if known else f"{body}parameters = {{ {entry} }}\n")

    return edit


def line(after: str, new: str) -> Edit:
    """Return the edit that adds a line, another one each time, after the first one that begins so."""

    def edit(text: str, number: int) -> str:
        found = re.search(rf"^{re.escape(after)}.*\n", text, re.MULTILINE)
        if found is None:
            raise AtlasError(f"no line begins with {after!r}.")
        return text[: found.end()] + new.format(number) + "\n" + text[found.end() :]

    return edit


def blank(text: str, number: int) -> str:
    """Add blank lines at the end."""
    return text + "\n" * (number + 1)


def nothing(text: str, _number: int) -> str:
    """Change nothing."""
    return text


@dataclass(frozen=True)
class Change:
    """A kind of change: what is said of it, the command that follows, and the edit of a file."""

    name: str
    command: tuple[str, ...]
    file: str = REPORT
    edit: Edit = nothing


CHANGES = (
    Change("nothing", BUILD),
    Change("a comment in a kernel", BUILD, "atlas/core/hyperbola.py", line("from typing", "# {}")),
    Change("a sentence", BUILD, REPORT, line("The right branch of @fig:loop", "It was measured {} times.")),
    Change("a sentence, pages only", PAGES, REPORT, line("The right branch of @fig:loop", "It was seen {} times.")),
    Change("a template of the pages", BUILD, "templates/html/style.css", line("body", "--number: {};")),
    Change("a number of a table", BUILD, REPORT, parameter("loop-points", "omega2", 0.7)),
    Change("a parameter of a 2-D figure", BUILD, REPORT, parameter("loop-hyperbola", "reach", 2.5)),
    Change("the same, pages only", PAGES, REPORT, parameter("loop-hyperbola", "reach", 2.3)),
    Change("a parameter of a line drawing in space", BUILD, REPORT, parameter("loop-motion", "omega2", 0.8)),
    Change("a parameter of a shaded figure", BUILD, REPORT, parameter("short-sphere", "omega2", 0.8)),
    Change("the same, pages only", PAGES, REPORT, parameter("short-sphere", "omega2", 0.9)),
    Change("the code of a recipe", BUILD, "figures/stability.py", line("import numpy", "NEW = {}")),
    Change("a kernel", BUILD, "atlas/core/charge.py", line("import numpy", "NEW = {}")),
    Change("a record that a figure shows", BUILD, "reports/data/build_costs.json", blank),
    Change("a figure by itself, drawn", (*DRAW, "reach=2.5{number:03d}")),
    Change("a figure by itself, taken", (*DRAW, "reach=2.5")),
    Change("the style of all figures", BUILD, "atlas/scene/style.py", line("from typing", "NEW = {}")),
)


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
        began = time.perf_counter()
        done = subprocess.run(  # noqa: S603  our own program
            words,
            cwd=self.place,
            env=os.environ | {"PYTHONPATH": str(self.place)},
            capture_output=True,
            text=True,
            check=False,
            preexec_fn=(lambda: os.sched_setaffinity(0, cores)) if cores else None,
        )
        seconds = time.perf_counter() - began
        if done.returncode:
            raise AtlasError(f"atlas {' '.join(words[3:])} ended with {done.returncode}: {done.stderr.strip()}")
        return seconds

    def costs(self) -> dict[str, Any]:
        """Return the cost ledger of the last build."""
        found: dict[str, Any] = json.loads((self.out / "atlas.costs.json").read_text())
        return found

    def state(self) -> dict[str, str]:
        """Return the digests of what a reader sees."""
        files = [*self.out.glob("atlas/*.html"), *self.out.glob("atlas/figures/*"), *self.out.glob("*.pdf")]
        files += self.out.glob("plots/*.svg")
        return {str(file.relative_to(self.out)): hashlib.sha256(file.read_bytes()).hexdigest() for file in files}

    def measure(self, change: Change, runs: int) -> Taken:
        """Make a change some times over, each time another one, and build."""
        path = self.place / change.file
        original = path.read_text(encoding="utf-8")
        seconds, drawn = [], {}
        for number in range(runs + 1):
            before = self.state()
            path.write_text(change.edit(original, number), encoding="utf-8")
            elapsed = self.run(change.command, number)
            if number:  # the first one loads what was not used for long
                seconds.append(elapsed)
                drawn = {name: key for name, key in self.state().items() if before.get(name) != key}
        path.write_text(original, encoding="utf-8")
        self.run(BUILD)
        kinds = [Path(name).suffix for name in drawn]
        figures = sum(kind in {".svg", ".png"} for kind in kinds)
        said = " ".join(("atlas", *change.command)).replace(" --out {out}/plots", "").replace(" --out {out}", "")
        said = said.format(number=0)
        return Taken(change.name, said, figures, kinds.count(".html"), ".pdf" in kinds, tuple(seconds))


def measure(runs: int = 5) -> Iterator[Taken]:
    """Measure every change in a warm checkout."""
    with TemporaryDirectory() as place:
        checkout = Checkout(Path(place))
        checkout.run(BUILD)
        for change in CHANGES:
            yield checkout.measure(change, runs)


def cold(runs: int = 3) -> dict[str, float]:
    """Build the whole atlas from nothing on one core and on two; compare with the bare time of its drawings."""
    available = sorted(os.sched_getaffinity(0))
    found: dict[str, list[float]] = {"one": [], "two": [], "drawings": []}
    for _ in range(runs):
        for name, cores in (("one", set(available[:1])), ("two", set(available[:2]))):
            with TemporaryDirectory() as place:
                checkout = Checkout(Path(place))
                jobs = ("--jobs", str(len(cores)))
                found[name].append(checkout.run((*BUILD, *jobs), cores=cores))
                if name == "one":
                    scenes = checkout.costs()["scenes"]
                    found["drawings"].append(sum(scene["compute_s"] + scene["draw_s"] for scene in scenes))
    return {name: statistics.median(times) for name, times in found.items()}


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(prog="python -m atlas.build.rebuilds", description=__doc__)
    parser.add_argument("--runs", type=int, default=5, help="how often each change is made")
    parser.add_argument("--store", action="store_true", help=f"keep the record as reports/data/{RECORD}")
    options = parser.parse_args()
    taken = []
    for one in measure(options.runs):
        taken.append(one)
        made = f"{one.figures} figures, {one.pages} pages{', PDF' if one.pdf else ''}"
        print(f"{statistics.median(one.seconds):6.2f} s  {one.name:42}{made:32}{one.command}", flush=True)  # noqa: T201
    whole = cold()
    print(  # noqa: T201  what was asked for
        f"{whole['two']:6.2f} s  everything, on two cores; {whole['one']:.2f} s on one, "
        f"{whole['one'] / whole['two']:.2f} times as long; its drawings alone {whole['drawings']:.2f} s"
    )
    if options.store:
        from atlas.study.bench.record import machine, today

        here = machine()
        record: dict[str, Any] = {"date": today(), "machine": f"{here.processor}, {here.cores} cores, {here.system}"}
        record |= {"changes": [asdict(one) for one in taken], "cold": whole}
        path = folder("reports") / "data" / RECORD
        beside = path.with_name(f".{path.name}.{os.getpid()}")
        beside.write_text(json.dumps(record, indent=1) + "\n", encoding="utf-8")
        beside.replace(path)


if __name__ == "__main__":
    main()
