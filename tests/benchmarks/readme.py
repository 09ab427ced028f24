"""README's section "Against the alternatives", from the record: `python -m benchmarks.readme` writes it.

The section holds a table, ratios on two kinds of processor, and the limits that the record misses, with reasons.
"""

import re
from pathlib import Path

from atlas import files
from atlas.checking import benchmark

README = Path(__file__).resolve().parents[2] / "README.md"

SECTION = "## Against the alternatives\n"

HORIZON = 1e4
"""Times reach from 0 to here."""

ROWS = (
    ("`ElementaryMotion.rotation`", "ours", None),
    ("the formula in plain NumPy", "plain", None),
    ("heyoka, Taylor series, tolerance 1e-14", "heyoka", 1e-14),
    ("heyoka, its own tolerance, 2.2e-16", "heyoka_own", 2.22e-16),
    ("heyoka, in long double", "heyoka_long", 1.084e-19),
    ("SciPy, DOP853, tolerance 1e-9", "DOP853", 1e-9),
    ("SciPy, LSODA, tolerance 1e-12", "LSODA", 1e-12),
)
"""Words, method and tolerance of each row: of SciPy the smallest errors that the record holds at this horizon."""

WHY = {
    "uniform grid of 1e4, a matrix (ns)": "35 µs of each call are checks and constants; from 1e5 matrices on, 17",
    "ours over the plain formula, below N = 1000, at worst": "a call's fixed 30 µs are twice those of the formula",
    "uniform grid over the same times one by one, at worst": "the grid's fixed 35 µs, which count below N = 1000",
    "R of the general motion on a grid (ns)": "each matrix needs two theta functions",
    "derivatives in six parameters, over R": "one derivative costs about as much as R",
    "R of the general motion at any times, heyoka's dense output over ours": "4 % short, less than such timings decide",
    "R of the general motion on a grid, heyoka's dense output over ours": "15 would take 14 ns; R = R_B R_z needs 17",
}
"""Reason for each limit that the record misses, by its words; the trial's page on speed explains them."""

TEXT = """
1024 rotation matrices of an elementary motion up to t = 10 000, from `reports/data/bench.json` (`make bench`, on an
{processor}):

| | largest error | time |
|---|---|---|
{table}

1e-14 is the tightest tolerance on heyoka's list; of SciPy's integrators the rows with the smallest errors on record.
The formula in C, `tests/benchmarks/compiled.c`, has the accuracy of `rotation` in {compiled:.2f} of its time. It would
need a compiler or a wheel for each machine, and a second error bound for each kernel; so the package has NumPy only.
NumPy's tangent is slower on a processor without AVX-512. In times of the formula in plain NumPy:

| | as recorded above | without AVX-512 |
|---|---|---|
{ratios}

Of the {count} limits of speed that `make bench` checks, the record misses {missed}:

{list}
"""


def section() -> str:
    """Return the section of README, as it follows from the record."""
    record = benchmark.read()
    runs = {
        (run.method, run.tolerance): run for run in record.runs if (run.case, run.horizon) == ("elementary", HORIZON)
    }
    rows = [(words, runs[method, tolerance]) for words, method, tolerance in ROWS]
    both = [{run.method: run.seconds for run in part} for part in (runs.values(), record.narrow)]
    missed = [limit for limit in record.limits if limit.verdict != "met"]
    return TEXT.format(
        processor=re.sub(r"\(\w+\)", "", record.machine.processor),
        table="\n".join(
            f"| {words} | {run.error:.1e} | {float(f'{1e3 * run.seconds:.2g}'):g} ms |" for words, run in rows
        ),
        compiled=runs["compiled", None].seconds / runs["ours", None].seconds,
        ratios="\n".join(
            f"| {words} | " + " | ".join(f"{times[method] / times['plain']:.2f}" for times in both) + " |"
            for words, method in (ROWS[0][:2], ("the formula in C", "compiled"))
        ),
        count=len(record.limits),
        missed=len(missed),
        list="\n".join(
            f"- {limit.says}: {limit.found:.3g}, wanted {limit.wanted} ({WHY[limit.says]})" for limit in missed
        ),
    )


def main() -> None:
    """Write the section into README."""
    before, _, after = README.read_text("utf-8").partition(SECTION)
    files.write(README, before + SECTION + section() + "\n## " + after.partition("\n## ")[2])


if __name__ == "__main__":
    main()
