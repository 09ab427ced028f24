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

RATIOS = {
    "`ElementaryMotion.rotation`": ("elementary", "ours"),
    "`GeneralMotion.rotation`": ("general", "ours"),
    "`AsymmetricMotion.rotation`, after its first time": ("asymmetric", "ours"),
    "the formula in C": ("elementary", "compiled"),
}
"""Case and method of the rows with and without AVX-512, by their words: those rows that the record holds for both."""

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
    closed = [
        [run for run in runs_of_table if run.horizon == HORIZON and not run.tolerance]
        for runs_of_table in (record.runs, record.narrow)
    ]
    timings = [{(run.case, run.method): run.seconds / run.samples for run in part} for part in closed]
    missed = [limit for limit in record.limits if limit.verdict != "met"]
    return TEXT.format(
        processor=re.sub(r"\(\w+\)", "", record.machine.processor),
        table="\n".join(
            f"| {words} | {run.error:.1e} | {float(f'{1e3 * run.seconds:.2g}'):g} ms |" for words, run in rows
        ),
        compiled=runs["compiled", None].seconds / runs["ours", None].seconds,
        ratios="\n".join(
            f"| {words} | " + " | ".join(f"{times[of] / times['elementary', 'plain']:.2f}" for times in timings) + " |"
            for words, of in RATIOS.items()
            if all(of in times for times in timings)
        ),
        count=len(record.limits),
        missed=len(missed),
        list="\n".join(f"- {limit.says}: {limit.found:.3g}, wanted {limit.wanted} ({limit.why})" for limit in missed),
    )


def main() -> None:
    """Write the section into README."""
    before, _, after = README.read_text("utf-8").partition(SECTION)
    files.write(README, before + SECTION + section() + "\n## " + after.partition("\n## ")[2])


if __name__ == "__main__":
    main()
