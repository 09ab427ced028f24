"""The records that a report shows: verdicts of the trial, the benchmark, worst errors, systems that were tried.

They are read, never made anew: `make verify`, `make bench`, `make stress` and `tests/machines` make them.
"""

import csv
import inspect
import json
import math
import re
from collections import Counter, defaultdict
from collections.abc import Callable, Mapping
from itertools import groupby
from typing import Any

import atlas
from atlas.book.appendices import Appendices, Described, Finding
from atlas.book.blocks.ledger import Errata, Ledger
from atlas.book.blocks.reference import Reference
from atlas.book.blocks.table import Recorded
from atlas.book.definition import Report
from atlas.book.digits import Number
from atlas.book.tables.table import Data, heads
from atlas.places import folder
from atlas.sources import PACKAGE
from atlas.trial.ledger import EQUATIONS
from atlas.trial.ledger.citation import cited

_DOCSTRING = re.compile(r'r?"""(.*?)"""', re.DOTALL)
_POWER = re.compile(r"(?<![\d.])1e\+?(-?)0*(\d+)")
MIN_ULPS, MAX_PLAIN, MIN_PLAIN = 0.5, 1e3, 1e-2
"""Half an ulp is as good as a rounded number can be; beyond the other two a power of ten is written."""
_LETTERS = re.compile(r"(k_hat|Omega|omega|gamma|beta|phi|a(?=\d)|[RIBKkmtyvn])(\d*)|1e(-?\d+)")
_FORMULA = re.compile(rf"(?:{_LETTERS.pattern}|[-\d()|/^=<])+")
_NAMED = {"k_hat": r"\hat{\mathbf{k}}", "Omega": r"\boldsymbol{\Omega}"} | {x: rf"\mathbf{{{x}}}" for x in "Kmyv"}
_SECTIONS = {"VII": "Appendix", "Atlas": "Atlas"}


def gather(report: Report, reference: "Callable[[], Mapping[str, Described]] | None" = None) -> Appendices:
    """Return the `Appendices` with those records that the blocks of a report show, and nothing else.

    `reference` returns the public names, by default `described`.
    """
    blocks = [block for page in report.pages for block in page.blocks]
    trial = any(isinstance(block, Ledger | Errata) for block in blocks)
    requests = {block.source for block in blocks if isinstance(block, Recorded)}
    tables: dict[str, Data] = {}
    for source, read in {"trial": _trial, "bench": _bench, "stress": _stress, "machines": _machines}.items():
        if source in requests:
            tables |= {f"{source}: {name}": data for name, data in read().items()}
    names = (reference or described)() if any(isinstance(block, Reference) for block in blocks) else {}
    return Appendices(_findings() if trial else {}, tables, names)


def _findings() -> dict[str, Finding]:
    """Return the trial's `Finding` on each entry of the ledger, by name."""
    from atlas.trial.proofs import recorded

    modules, scripts = _modules(), recorded.scripts()
    return {
        name: Finding(
            verdict.verdict,
            verdict.method,
            verdict.follows,
            verdict.corrected_tex,
            verdict.corrected_verdict,
            verdict.counterexample,
            verdict.note,
            modules.get(name, ()),
            verdict.grade,
            verdict.slip,
            verdict.false if verdict.false_verdict == "refuted" else "",
            scripts.get(name, ""),
            verdict.said,
            verdict.not_read,
            verdict.outside,
        )
        for name, verdict in recorded.load().items()
    }


PHYSICS = ("arithmetic", "bodies", "surfaces", "motions", "maps")
"""Folders with kernels and balls."""


def _modules() -> dict[str, tuple[str, ...]]:
    """Return, by name of an entry of the ledger, the modules of `PHYSICS` whose docstrings cite it, as paths.

    The paths are relative to the package, such as "motions/base.py", in the order of `PHYSICS`; entries that none cites
    are absent.
    """
    modules: defaultdict[str, list[str]] = defaultdict(list)
    files = [path for place in PHYSICS for path in sorted((PACKAGE / place).rglob("*.py"))]
    for path in files:
        if not path.stem.startswith(("family", "formula")):
            text = " ".join(_DOCSTRING.findall(path.read_text("utf-8")))
            for name in cited(text):
                modules[name].append(path.relative_to(PACKAGE).as_posix())
    return {name: tuple(paths) for name, paths in modules.items()}


def _trial() -> dict[str, Data]:
    """Return two tables: "totals", counts of verdicts for each section, and "slips", the entries with one by grade."""
    from atlas.trial.proofs import recorded
    from atlas.trial.proofs.verdict import slips

    verdicts = recorded.load()
    kinds = ("proved", "definition", "refuted", "supported", "undecided")
    totals: defaultdict[str, Counter[str]] = defaultdict(Counter)
    for name, entry in EQUATIONS.items():
        for key in (entry.section, "all"):
            totals[key]["entries"] += 1
            totals[key][verdicts[name].verdict if name in verdicts else "undecided"] += 1
    totals["All"] = totals.pop("all")
    columns = heads("Section", "Entries", *(kind.capitalize() for kind in kinds))
    rows: list[tuple[str | Number, ...]] = []
    for key, count in totals.items():
        numbers = (Number(str(count[name])) for name in ("entries", *kinds))
        rows.append((_SECTIONS.get(key, key), *numbers))
    return {
        "totals": Data(columns, tuple(rows), "The trial in numbers."),
        "slips": Data(
            heads("Slip", "Slips", "Entries"),
            tuple(
                (
                    grade.capitalize(),
                    Number(str(len(names))),
                    ", ".join(
                        f"@{name}" for name, verdict in verdicts.items() if verdict.grade and grade == verdict.grade
                    ),
                )
                for grade, names in slips(verdicts.values()).items()
            ),
            "Distinct slips by grade; several entries may share one.",
        ),
    }


def _bench() -> dict[str, Data]:
    """Return the tables of the stored benchmark by title: "Limits of speed", and for each case errors by time."""
    from atlas.checking import benchmark

    stored = benchmark.read()
    line = f"{benchmark.measured(stored, stored.versions)} {stored.machine.system}, `{stored.command}`."
    rows: tuple[tuple[str | Number, ...], ...]
    rows = tuple(
        (_words(x.says), _words(x.wanted), _three(x.found), ": ".join(filter(None, (x.verdict, _words(x.why)))))
        for x in stored.limits
    )
    limits = Data(heads("What", "Wanted", "Found", "Verdict"), rows, "Limits of speed.", (line,))
    tables = {"Limits of speed": limits}
    for case in dict.fromkeys(run.case for run in stored.runs):
        best: defaultdict[str, dict[float, float]] = defaultdict(dict)
        for run in benchmark.runs_of(stored, case):
            best[run.method][run.horizon] = min(best[run.method].get(run.horizon, math.inf), run.error or 0.0)
        times = sorted({time for errors in best.values() for time in errors})
        columns = heads("Largest error to t =", *(_words(f"{time:.0e}") for time in times))
        rows = tuple(
            (_words(benchmark.title(method)), *(_three(errors.get(time)) for time in times))
            for method, errors in best.items()
        )
        title = f"Error against horizon: {case}"
        note = "For an integrator, the best tolerance that finished in time."
        tables[title] = Data(columns, rows, f"{title}.", (note, line))
    return tables


def _stress() -> dict[str, Data]:
    """Return {"worst errors": table}: each quantity's worst recorded error and its limit in ulps, and the regime."""
    from atlas.motions.register import FAMILIES

    limits = {name: ulps for family in FAMILIES.values() for name, ulps in family.promises.items()}
    record = json.loads((folder("reports") / "data" / "worst_errors.json").read_text(encoding="utf-8"))
    errors = record["worst"]
    order = [*(name for name in limits if name in errors), *(name for name in errors if name not in limits)]
    rows: list[tuple[str | Number, ...]] = []
    for name in order:
        ulps, regime = errors[name]
        broken = "**limit exceeded:** " if ulps > limits.get(name, math.inf) else ""
        limit = Number(f"{limits[name]:g}") if name in limits else "none"
        rows.append((title(name), _ulps(ulps), limit, broken + title(regime) if ulps > MIN_ULPS else ""))
    above = sum(errors[name][0] > limits.get(name, math.inf) for name in order)
    note = (
        f"Of {len(order)} quantities, {len(limits.keys() & order)} with a limit, {above or 'none'} exceeded it. "
        f"Worst of {record['values']:,} values on {len(record['processors'])} kinds of x86 processors, rounded up. "
        "Errors below half a unit are recorded as half a unit."
    )
    columns = heads("Quantity", ("Worst error", "ulp"), ("Limit", "ulp"), "Found at")
    return {"worst errors": Data(columns, tuple(rows), "Worst errors on record.", (note,))}


def _machines() -> dict[str, Data]:
    """Return {"systems": table} of the systems on which a fresh checkout was tried, with user and results."""
    with (folder("reports") / "data" / "machines.csv").open(encoding="utf-8", newline="") as file:
        _, *rows = csv.reader(file)
    columns = heads("System", "Python", "User", "GL", "Set-up", "`make report`", "`make test`", "Works", "Tried")
    return {"systems": Data(columns, tuple(map(tuple, rows)), "Systems on which a fresh checkout was tried.", ())}


def title(name: str) -> str:
    """Return the name of a quantity or of a regime of the stress runs as Markdown, with letters and numbers as TeX."""
    pieces = re.split(r"(, | )", name)
    formulas = [bool(_FORMULA.fullmatch(piece)) for piece in pieces]
    heading = ""
    for formula, group in groupby(zip(pieces, formulas, strict=True), lambda pair: pair[1] or pair[0] == " "):
        text = "".join(piece for piece, _ in group)
        core = text.strip()
        if formula and core and not core.isdecimal():
            tex = _LETTERS.sub(lambda match: _tex(*match.groups()), core)
            text = text.replace(core, f"${tex}$")
        heading += text
    return heading


def _tex(letter: str, index: str, power: str) -> str:
    """Return the TeX of a letter with its index ("" if none); of 10 to `power` where that is not empty."""
    if power:
        return f"10^{{{power}}}"
    text = _NAMED.get(letter, f"\\{letter}" if len(letter) > 1 else letter)
    return f"{text}_{{{index}}}" if len(index) > 1 else f"{text}_{index}" if index else text


def _ulps(error: float) -> Number:
    """Return an error in ulps as a `Number` with three decimals, from 1000 on with one and a power of ten; 0 as "0"."""
    if not error:
        return Number("0")
    return Number(f"{error:.3f}" if error < MAX_PLAIN else f"{error:.1e}")


def _three(value: float | None) -> str | Number:
    """Return a `Number` of three digits, of two if its magnitude is below 0.01 (MIN_PLAIN); "–" for None."""
    if value is None:
        return "–"
    return Number(f"{value:.1e}" if 0 < abs(value) < MIN_PLAIN else f"{value:.3g}")


def _words(text: str) -> str:
    """Return a text of the terminal as Markdown: "(us" becomes "(µs", a power "1e+05" becomes $10^{5}$."""
    text = re.sub(r"\(us\b", "(µs", text)
    return _POWER.sub(lambda match: f"$10^{{{match[1]}{match[2]}}}$", text)


def described() -> dict[str, Described]:
    """Return the `Described` of each public name: arguments, docstring, and members of a class, own and inherited."""
    names = [name for name in atlas.__all__ if not name.startswith("_")]
    return {name: _described(getattr(atlas, name), _members(getattr(atlas, name))) for name in names}


def _members(owner: Any) -> Mapping[str, Described]:
    """Return the public functions, methods and properties of a class of this package by name, own before inherited.

    {} for an object that is no class; members that are not functions are left out. `owner` is any public object of
    the package.
    """
    members: dict[str, Described] = {}
    for cls in inspect.getmro(owner) if inspect.isclass(owner) else ():
        for name, member in vars(cls).items() if cls.__module__.startswith("atlas") else ():
            is_callable = not hasattr(member, "fget") and not hasattr(member, "func")  # no property, no cached property
            inner = (getattr(member, attribute, None) for attribute in ("fget", "func", "__func__"))
            code = next(filter(None, inner), member)
            if not name.startswith("_") and inspect.isfunction(code) and name not in members:
                members[name] = _described(code, {}, is_callable=is_callable)
    return members


def _described(member: Any, members: Mapping[str, Described], *, is_callable: bool = True) -> Described:
    return Described(_arguments(member) if is_callable else "", inspect.getdoc(member) or "", members)


def _arguments(member: Any) -> str:
    """Return the arguments of a class or function as "(a, b=1)", without annotations and self; "" for an exception."""
    if inspect.isclass(member) and issubclass(member, BaseException):
        return ""
    signature = inspect.signature(member)
    plain = [
        parameter.replace(annotation=inspect.Parameter.empty)
        for name, parameter in signature.parameters.items()
        if name not in {"self", "cls"}
    ]
    text = str(signature.replace(parameters=plain, return_annotation=inspect.Signature.empty))
    return text.replace("<factory>", "...")
